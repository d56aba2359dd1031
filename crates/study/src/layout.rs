//! Words in lines of a terminal.

/// Characters of a line.
pub(crate) const WIDTH: usize = 100;

/// Words in lines of at most [`WIDTH`] characters: the first after `first`, the others below its end.
pub(crate) fn hanging(first: &str, words: &str) -> String {
    let indent = first.chars().count();
    let mut text = String::new();
    let (mut line, mut length) = (first.to_owned(), indent);
    let mut is_begun = false;
    for word in words.split_whitespace() {
        let size = word.chars().count();
        if is_begun && length + 1 + size > WIDTH {
            text.push_str(line.trim_end());
            text.push('\n');
            (line, length, is_begun) = (" ".repeat(indent), indent, false);
        }
        if is_begun {
            line.push(' ');
            length += 1;
        }
        line.push_str(word);
        length += size;
        is_begun = true;
    }
    text.push_str(line.trim_end());
    text.push('\n');
    text
}

/// Characters of a usual term within parentheses.
const TERM: usize = 28;

/// A formula in lines of about [`WIDTH`] characters: the first after `first`, the others a little behind its end. Terms stay
/// whole where they fit.
pub(crate) fn terms(first: &str, formula: &str) -> String {
    let room = WIDTH.saturating_sub(first.chars().count() + 2);
    let (mut whole, mut depth): (Vec<String>, i32) = (Vec::new(), 0);
    for word in formula.split_whitespace() {
        let is_sign = matches!(word, "+" | "-" | "=");
        match whole.last_mut() {
            Some(last) if !is_sign || depth > 0 && last.chars().count() + TERM < room => {
                last.push(' ');
                last.push_str(word);
            }
            _ => whole.push(word.to_owned()),
        }
        for sign in word.chars() {
            depth += match sign {
                '(' => 1,
                ')' => -1,
                _ => 0,
            };
        }
    }
    // A zero does not stand alone.
    if whole.len() > 1 && whole.last().is_some_and(|last| last == "= 0") {
        whole.pop();
        if let Some(last) = whole.last_mut() {
            last.push_str(" = 0");
        }
    }
    let indent = first.chars().count();
    let (mut text, mut line) = (String::new(), first.to_owned());
    let mut is_begun = false;
    for term in whole {
        if is_begun && line.chars().count() + 1 + term.chars().count() > WIDTH {
            text.push_str(line.trim_end());
            text.push('\n');
            line = " ".repeat(indent + 2);
        } else if is_begun {
            line.push(' ');
        }
        line.push_str(&term);
        is_begun = true;
    }
    text.push_str(line.trim_end());
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::{hanging, terms, WIDTH};

    #[test]
    fn formulas_are_broken_before_signs() {
        let sum = vec!["s_11 u_1,1"; 20].join(" + ");
        let text = terms("  δu_1  ", &format!("{sum} = 0"));
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].starts_with("  δu_1  s_11 u_1,1 + s_11"));
        assert!(lines[1].starts_with("          + s_11 u_1,1"));
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH));
        assert_eq!(terms("a ", "x = 0"), "a x = 0\n");
        // Parentheses stay together, and the zero with the last term.
        let long = format!("{} - (a + b) c = 0", "x".repeat(85));
        assert_eq!(
            terms("", &long).lines().collect::<Vec<_>>(),
            [&*"x".repeat(85), "  - (a + b) c = 0"]
        );
    }

    #[test]
    fn lines_hang_below_their_first_word() {
        let words = "word ".repeat(40);
        let text = hanging("  energy  ", &words);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.len() == 3 && lines[0].starts_with("  energy  word"));
        assert!(lines[1].starts_with("          word"));
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH));
        // A word longer than a line stays whole.
        assert_eq!(hanging("", &"x".repeat(120)).trim_end().len(), 120);
    }
}
