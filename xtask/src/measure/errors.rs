//! Functions whose error is a text.

use super::source::Source;

/// How many functions return `Result<_, String>`, `Result<_, &str>` or a result with such a one inside.
pub(crate) fn text_errors(source: &Source) -> usize {
    let code = &source.code;
    let starts = code.match_indices("fn ").filter(|(at, _)| {
        let before = code[..*at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
    });
    starts
        .filter(|(at, _)| returned(&code[*at..]).is_some_and(has_text_error))
        .count()
}

/// The type behind the arrow of a signature.
fn returned(signature: &str) -> Option<&str> {
    let parameters = signature.find('(')?;
    let mut depth = 0_usize;
    let end = signature[parameters..].char_indices().find_map(|(at, c)| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(parameters + at + 1)
    })?;
    let after = signature[end..].trim_start().strip_prefix("->")?;
    let end = after.find(['{', ';']).unwrap_or(after.len());
    let kind = &after[..end];
    Some(kind.split(" where").next().unwrap_or(kind))
}

/// Whether some `Result<…>` in a type ends in a text.
fn has_text_error(kind: &str) -> bool {
    kind.match_indices("Result<").any(|(at, opening)| {
        let arguments = arguments(&kind[at + opening.len()..]);
        arguments.len() == 2 && is_text(arguments[1])
    })
}

fn is_text(kind: &str) -> bool {
    let owner = kind.trim().trim_start_matches('&').trim_start();
    let name = match owner.strip_prefix('\'') {
        Some(after) => after.split_once(' ').map_or(after, |(_, name)| name),
        None => owner,
    };
    name == "String" || name == "str" && kind.trim().starts_with('&')
}

/// The arguments up to the closing bracket, split at commas outside of brackets.
fn arguments(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut depth = 0_usize;
    let mut start = 0;
    for (at, c) in text.char_indices() {
        match c {
            '<' | '(' | '[' => depth += 1,
            // The arrow of a function type closes nothing.
            '>' if text[..at].ends_with('-') => {}
            '>' | ')' | ']' if depth > 0 => depth -= 1,
            '>' => {
                found.push(&text[start..at]);
                break;
            }
            ',' if depth == 0 => {
                found.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    found.retain(|argument| !argument.trim().is_empty());
    found
}

#[cfg(test)]
mod tests {
    use super::super::source::read;
    use super::*;

    #[test]
    fn texts_in_the_place_of_errors_are_counted() {
        let text = "
            fn a() -> Result<(), String> { b() }
            pub(crate) fn b<T: Fn(u8) -> u8>(f: impl Fn(&str) -> Result<u8, E>) -> Result<Vec<(T, u8)>, &'static str> where T: Copy {}
            fn c(f: &dyn Fn() -> Result<u8, String>) -> Result<String, E> {}
            fn d() -> Result<Result<u8, String>, E> {}
            fn e() -> Option<Result<u8, &str>>;
            fn f() -> std::io::Result<String> {}
            fn g() -> Result<BTreeMap<String, String>, std::fmt::Error> {}
        ";
        assert_eq!(text_errors(&read(text).0), 4);
    }
}
