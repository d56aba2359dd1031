//! Comments: lines of text that cannot end the comment they stand in.

use super::language::Language;

/// The comment at the top of a file.
pub(super) fn file(lines: &[String], language: Language) -> String {
    match language {
        Language::C => block(lines),
        Language::Rust => lines.iter().map(|line| marked("//", line)).collect(),
    }
}

/// The comment above a function.
pub(super) fn function(lines: &[String], language: Language) -> String {
    match language {
        Language::C => block(lines),
        Language::Rust => lines.iter().map(|line| marked("///", line)).collect(),
    }
}

fn block(lines: &[String]) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let lines: String = lines.iter().map(|line| marked(" *", line)).collect();
    format!("/*\n{lines} */\n")
}

fn marked(mark: &str, line: &str) -> String {
    let text = harmless(line);
    format!("{}\n", format!("{mark} {text}").trim_end())
}

/// The line without what ends or nests a comment of C, begins a trigraph, or changes the direction of writing.
fn harmless(line: &str) -> String {
    let mut out = String::with_capacity(line.len());
    for sign in line.chars() {
        let sign = match sign {
            '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{2028}' | '\u{2029}' => ' ',
            sign if sign.is_control() => ' ',
            sign => sign,
        };
        let splits = matches!(
            (out.chars().next_back(), sign),
            (Some('*'), '/') | (Some('/'), '*') | (Some('?'), '?')
        );
        if splits {
            out.push(' ');
        }
        out.push(sign);
    }
    out
}
