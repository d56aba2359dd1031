//! The sources of a crate as text to be counted: what is only for tests is cut away, comments and string literals are blanked,
//! and the literals are kept apart.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A file of a crate, which is a module of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Source {
    /// Lines that are not only for tests.
    pub(crate) lines: usize,
    /// The code; comments and the insides of literals are blanks, and tests are gone.
    pub(crate) code: String,
    /// What stands in string literals outside tests and attributes.
    pub(crate) literals: Vec<String>,
}

/// The path of a module inside its crate; empty for the root.
pub(crate) type ModulePath = Vec<String>;

/// The modules of a crate by their paths.
pub(crate) type Modules = BTreeMap<ModulePath, Source>;

/// Reads all modules below `src` that are not only for tests.
pub(crate) fn modules(src: &Path) -> std::io::Result<Modules> {
    let mut found = BTreeMap::new();
    let mut tests: Vec<ModulePath> = Vec::new();
    for file in rust_files(src)? {
        let path = module_path(src, &file);
        let (source, of_tests) = read(&std::fs::read_to_string(&file)?);
        let inside = of_tests.into_iter().map(|name| joined(&path, &name));
        tests.extend(inside);
        found.insert(path, source);
    }
    found.retain(|path, _| !tests.iter().any(|test| path.starts_with(test)));
    Ok(found)
}

fn joined(path: &[String], name: &str) -> ModulePath {
    path.iter().cloned().chain([name.to_owned()]).collect()
}

/// All `.rs` files below a folder, in order.
fn rust_files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

/// `src/a/b.rs` and `src/a/b/mod.rs` are `a::b`; `src/lib.rs` is the root.
fn module_path(src: &Path, file: &Path) -> ModulePath {
    let below = file.strip_prefix(src).unwrap_or(file).with_extension("");
    let mut path: ModulePath = below
        .iter()
        .map(|part| part.to_string_lossy().into_owned())
        .collect();
    let is_root = path.len() == 1 && path.iter().all(|name| name == "lib" || name == "main");
    if is_root || path.last().is_some_and(|name| name == "mod") {
        path.pop();
    }
    path
}

/// A source from its text, and the names of modules that it declares for tests only.
pub(crate) fn read(text: &str) -> (Source, Vec<String>) {
    let (mut code, literals) = blanked(text);
    let mut of_tests = Vec::new();
    let mut lines = text.lines().count();
    for marker in ["#[cfg(test)]", "#[cfg(all(test"] {
        while let Some(start) = code.find(marker) {
            let end = end_of_item(&code, start);
            let item = &code[start..end];
            lines = lines.saturating_sub(item.lines().count());
            of_tests.extend(declared_module(item));
            let blank: String = item.chars().map(blank_of).collect();
            code.replace_range(start..end, &blank);
        }
    }
    let in_code = |at: &usize| code[*at..].starts_with('"');
    let kept = literals.into_iter().filter(|(at, _)| in_code(at));
    let kept = kept.filter(|(at, _)| !is_in_attribute(&code, *at));
    let literals = kept.map(|(_, literal)| literal).collect();
    (
        Source {
            lines,
            code,
            literals,
        },
        of_tests,
    )
}

/// `NAME` of an item `mod NAME;`.
fn declared_module(item: &str) -> Option<String> {
    let (_, rest) = item.split_once("mod ")?;
    let name = rest.trim().strip_suffix(';')?;
    Some(name.trim().to_owned())
}

/// Whether a place is inside `#[…]`: the last attribute before it is still open there.
fn is_in_attribute(code: &str, at: usize) -> bool {
    let before = &code[..at];
    let opened = before.rfind("#[").or_else(|| before.rfind("#!["));
    opened.is_some_and(|start| {
        let mut depth = 0_usize;
        let closes = |c: char| {
            match c {
                '[' => depth += 1,
                ']' => depth = depth.saturating_sub(1),
                _ => return false,
            }
            depth == 0
        };
        !before[start..].chars().any(closes)
    })
}

/// Where the item ends that begins at `start` with an attribute: after its braces, or its semicolon.
fn end_of_item(code: &str, start: usize) -> usize {
    let mut depth = 0_usize;
    for (at, c) in code[start..].char_indices() {
        let after = start + at + c.len_utf8();
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => {
                depth = depth.saturating_sub(1);
                if depth == 0 && c == '}' {
                    return after;
                }
            }
            ';' if depth == 0 => return after,
            _ => {}
        }
    }
    code.len()
}

/// A blank of the same length in bytes would need several; places in bytes are kept by as many blanks as bytes.
fn blank_of(c: char) -> char {
    if c == '\n' {
        '\n'
    } else {
        ' '
    }
}

/// The text with comments and the insides of literals as blanks, byte for byte, and the string literals with their places (of
/// the opening quote).
fn blanked(text: &str) -> (String, Vec<(usize, String)>) {
    let bytes = text.as_bytes();
    let mut code = bytes.to_vec();
    let mut literals = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text.as_bytes()[at..];
        let (inside, end) = match rest {
            [b'/', b'/', ..] => (at, at + line_comment(rest)),
            [b'/', b'*', ..] => (at, at + block_comment(rest)),
            [b'"', ..] => {
                let end = at + string(rest);
                literals.push((
                    at,
                    text_of(&bytes[at + 1..end.saturating_sub(1).max(at + 1)]),
                ));
                (at + 1, end)
            }
            [b'r', ..] if !follows_a_word(bytes, at) => match raw_string(rest) {
                Some((opening, length)) => {
                    let closing = opening - 1;
                    let text = text_of(&bytes[at + opening..at + length - closing]);
                    literals.push((at + opening - 1, text));
                    (at + opening, at + length)
                }
                None => (at + 1, at + 1),
            },
            [b'\'', ..] => match character(rest) {
                Some(length) => (at + 1, at + length),
                None => (at + 1, at + 1),
            },
            _ => (at + 1, at + 1),
        };
        for byte in &mut code[inside..end] {
            if *byte != b'\n' && *byte != b'"' {
                *byte = b' ';
            }
        }
        at = end;
    }
    // What is left outside literals and comments may be any text; what was blanked is ASCII.
    (String::from_utf8_lossy(&code).into_owned(), literals)
}

fn text_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn follows_a_word(bytes: &[u8], at: usize) -> bool {
    at.checked_sub(1)
        .and_then(|before| bytes.get(before))
        .is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_')
}

fn line_comment(rest: &[u8]) -> usize {
    rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len())
}

/// Block comments nest.
fn block_comment(rest: &[u8]) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while at < rest.len() {
        match &rest[at..] {
            [b'/', b'*', ..] => {
                depth += 1;
                at += 2;
            }
            [b'*', b'/', ..] => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    return at;
                }
            }
            _ => at += 1,
        }
    }
    rest.len()
}

fn string(rest: &[u8]) -> usize {
    let mut at = 1;
    while at < rest.len() {
        match rest[at] {
            b'\\' => at += 2,
            b'"' => return at + 1,
            _ => at += 1,
        }
    }
    rest.len()
}

/// Length of `r##"` and of the whole raw string.
fn raw_string(rest: &[u8]) -> Option<(usize, usize)> {
    let hashes = rest[1..].iter().take_while(|b| **b == b'#').count();
    (rest.get(1 + hashes) == Some(&b'"')).then_some(())?;
    let opening = hashes + 2;
    let mut closing = vec![b'"'];
    closing.extend(std::iter::repeat_n(b'#', hashes));
    let inside = &rest[opening..];
    let end = inside
        .windows(closing.len())
        .position(|window| window == closing);
    Some((
        opening,
        end.map_or(rest.len(), |end| opening + end + closing.len()),
    ))
}

/// Length of a character literal; a lifetime is none.
fn character(rest: &[u8]) -> Option<usize> {
    let text = std::str::from_utf8(&rest[1..rest.len().min(16)]);
    let text = match text {
        Ok(text) => text,
        Err(problem) => std::str::from_utf8(&rest[1..=problem.valid_up_to()]).unwrap_or_default(),
    };
    let mut chars = text.char_indices();
    match chars.next()?.1 {
        '\\' => text[2..].find('\'').map(|end| end + 4),
        _ => {
            let (end, closing) = chars.next()?;
            (closing == '\'').then_some(end + 2)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_literals_and_tests_are_told_from_code() {
        let text = "//! crate::a\nfn f<'a>(c: char) -> &'a str {\n  /* crate::b /* */ crate::c */\n  if c == '\"' { r#\"raw \"x\"\"# } else { \"a // b\" }\n}\n#[cfg(test)]\nmod tests {\n  use super::*; // }\n  const T: &str = \"}\";\n}\nfn g() {}\n#[cfg(test)]\nmod more;\n";
        let (source, of_tests) = read(text);
        assert_eq!(source.literals, ["raw \"x\"", "a // b"]);
        assert_eq!(of_tests, ["more"]);
        assert_eq!(source.lines, 6);
        for gone in ["crate", "super", "more", "tests"] {
            assert!(!source.code.contains(gone), "{gone}: {}", source.code);
        }
        assert!(source.code.contains("fn g() {}"));
        assert!(source.code.contains("<'a>(c: char) -> &'a str"));
    }

    #[test]
    fn words_in_attributes_are_no_literals() {
        let (source, _) = read("#[allow(dead_code, reason = \"no one asks for it\")]\nconst A: [&str; 1] = [\"one of them\"];\n");
        assert_eq!(source.literals, ["one of them"]);
    }

    #[test]
    fn files_are_modules() {
        let src = Path::new("src");
        for (file, path) in [
            ("src/lib.rs", vec![]),
            ("src/a.rs", vec!["a"]),
            ("src/a/mod.rs", vec!["a"]),
            ("src/a/b.rs", vec!["a", "b"]),
        ] {
            assert_eq!(module_path(src, Path::new(file)), path);
        }
    }
}
