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
    /// A letter with a sign above or beside it: `Ltilde`, `Lbar`, `Lstar`.
    Accented(Box<Piece>, Accent),
}

/// A sign that belongs to a letter.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Accent {
    Tilde,
    Bar,
    Star,
}

/// A letter with the name of its sign written after it.
fn accented(text: &str) -> Option<Piece> {
    let accents = [
        ("tilde", Accent::Tilde),
        ("bar", Accent::Bar),
        ("star", Accent::Star),
    ];
    let (letter, accent) = accents
        .into_iter()
        .find_map(|(word, accent)| Some((text.strip_suffix(word)?, accent)))?;
    match piece(letter) {
        own @ (Piece::Letter(_) | Piece::Greek(..)) => Some(Piece::Accented(Box::new(own), accent)),
        _ => None,
    }
}

/// A name split into its letter and subscripts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct TypesetName {
    pub(crate) head: Piece,
    pub(crate) subscripts: Vec<Subscript>,
}

/// A subscript, which may have a number as its own: Q with the subscript θ₁.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Subscript {
    pub(crate) piece: Piece,
    pub(crate) digits: Option<String>,
}

fn piece(text: &str) -> Piece {
    if let Some(sign) = greek_letter(text) {
        return Piece::Greek(text.to_string(), sign);
    }
    if text.bytes().all(|byte| byte.is_ascii_digit()) && !text.is_empty() {
        return Piece::Digits(text.to_string());
    }
    if let Some(accented) = accented(text) {
        return accented;
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
    let mut pieces = Vec::new();
    let head = if letters.is_empty() {
        first
    } else {
        if letters.len() < first.len() {
            pieces.push(piece(&first[letters.len()..]));
        }
        letters
    };
    pieces.extend(parts.map(piece));
    TypesetName {
        head: piece(head),
        subscripts: subscripts(pieces),
    }
}

/// A number after letters is their subscript; numbers stand side by side.
fn subscripts(pieces: Vec<Piece>) -> Vec<Subscript> {
    let mut subscripts: Vec<Subscript> = Vec::new();
    for piece in pieces {
        match (&piece, subscripts.last_mut()) {
            (
                Piece::Digits(own),
                Some(Subscript {
                    piece:
                        Piece::Letter(_) | Piece::Greek(..) | Piece::Word(_) | Piece::Accented(..),
                    digits: digits @ None,
                }),
            ) => *digits = Some(own.clone()),
            _ => subscripts.push(Subscript {
                piece,
                digits: None,
            }),
        }
    }
    subscripts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_split_into_letter_and_subscripts() {
        let theta = Piece::Greek("theta".into(), 'θ');
        let bare = |piece| Subscript {
            piece,
            digits: None,
        };
        let digits = |text: &str| bare(Piece::Digits(text.into()));
        assert_eq!(typeset("theta_1").head, theta.clone());
        assert_eq!(typeset("theta1"), typeset("theta_1"));
        assert_eq!(typeset("q_1_2").subscripts, [digits("1"), digits("2")]);
        assert_eq!(
            typeset("lambda_blade").subscripts,
            [bare(Piece::Word("blade".into()))]
        );
        assert_eq!(
            typeset("Q_theta_1").subscripts,
            [Subscript {
                piece: theta,
                digits: Some("1".into())
            }]
        );
        let tilde = Piece::Accented(Box::new(Piece::Letter('T')), Accent::Tilde);
        assert_eq!(typeset("Ttilde_x").head, tilde);
        for word in ["star", "tilde", "bar", "mustard", "crossbar"] {
            assert_eq!(typeset(word).head, Piece::Word(word.into()));
        }
        assert_eq!(typeset("mass").head, Piece::Word("mass".into()));
        assert_eq!(typeset("_").head, Piece::Word("_".into()));
    }
}
