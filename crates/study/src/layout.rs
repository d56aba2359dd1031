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

#[cfg(test)]
mod tests {
    use super::{hanging, WIDTH};

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
