//! Names as they are typeset: `theta_1` is θ with the subscript 1, `lambda_blade` λ with the subscript "blade".

use crate::syntax::names::greek_letter;

/// A piece of a name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Piece {
    /// One letter, set in italics.
    Letter(char),
    /// A Greek letter: its name and sign.
    Greek(String, char),
    /// Several letters, set upright.
    Word(String),
    /// Digits.
    Digits(String),
}

/// A name split into its letter and subscripts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct TypesetName {
    pub(crate) head: Piece,
    pub(crate) subscripts: Vec<Piece>,
}

fn piece(text: &str) -> Piece {
    if let Some(sign) = greek_letter(text) {
        return Piece::Greek(text.to_string(), sign);
    }
    if text.bytes().all(|byte| byte.is_ascii_digit()) && !text.is_empty() {
        return Piece::Digits(text.to_string());
    }
    let mut letters = text.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => Piece::Letter(letter),
        _ => Piece::Word(text.to_string()),
    }
}

/// Splits a name at underscores and before final digits: `q_1`, `q1` and `q_{1}` of a person's hand are the same.
pub(crate) fn typeset(name: &str) -> TypesetName {
    let mut parts = name.split('_').filter(|part| !part.is_empty());
    let Some(first) = parts.next() else {
        return TypesetName {
            head: Piece::Word(name.to_string()),
            subscripts: Vec::new(),
        };
    };
    let letters = first.trim_end_matches(|c: char| c.is_ascii_digit());
    let mut subscripts = Vec::new();
    let head = if letters.is_empty() {
        first
    } else {
        if letters.len() < first.len() {
            subscripts.push(piece(&first[letters.len()..]));
        }
        letters
    };
    subscripts.extend(parts.map(piece));
    TypesetName {
        head: piece(head),
        subscripts,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_split_into_letter_and_subscripts() {
        let theta = Piece::Greek("theta".into(), 'θ');
        let one = Piece::Digits("1".into());
        assert_eq!(typeset("theta_1").head, theta);
        assert_eq!(typeset("theta1"), typeset("theta_1"));
        assert_eq!(
            typeset("q_1_2").subscripts,
            [one, Piece::Digits("2".into())]
        );
        assert_eq!(
            typeset("lambda_blade").subscripts,
            [Piece::Word("blade".into())]
        );
        assert_eq!(typeset("mass").head, Piece::Word("mass".into()));
        assert_eq!(typeset("_").head, Piece::Word("_".into()));
    }
}
