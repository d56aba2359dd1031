//! Names as they are typeset: `theta_1` is θ with the subscript 1, `lambda_blade` λ with the subscript "blade". A name made
//! by [`with_indices`] has upper indices too. Derivatives stand behind a comma, `u_1,12`, and a function of a tensor has primes and
//! its argument: `A'_11(e)`.

use super::symbol::StatedSymbol;
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
    /// The total derivative of an accented letter: `DLstar`.
    Derivative(Box<Piece>),
    /// Indices with derivatives behind a comma: `1,12`.
    Indices(String),
    /// How often a function is differentiated.
    Primes(usize),
    /// As the model states it.
    Stated(StatedSymbol),
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

/// A name split into its letter and indices.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct TypesetName {
    pub(crate) head: Piece,
    pub(crate) superscripts: Vec<Subscript>,
    pub(crate) subscripts: Vec<Subscript>,
    /// The name of what a function is taken of.
    pub(crate) argument: Option<Box<TypesetName>>,
}

impl TypesetName {
    /// Whether something stands where an exponent would: an upper index, a star or an argument.
    pub(crate) fn is_raised(&self) -> bool {
        let letter = match &self.head {
            Piece::Derivative(letter) => letter,
            head => head,
        };
        let is_function = self.argument.is_some();
        is_function
            || !self.superscripts.is_empty()
            || matches!(letter, Piece::Accented(_, Accent::Star))
            || matches!(letter, Piece::Stated(own) if own.is_raised())
    }
}

/// The typeset name of a component with upper and lower indices, each of which is a name: `A^{z}_{x}`. To be given as what
/// a name is displayed as ([`Options::display`](super::Options::display)).
pub fn with_indices(letter: &str, upper: &[&str], lower: &[&str]) -> String {
    let group = |sign: char, names: &[&str]| -> String {
        names
            .iter()
            .map(|name| format!("{sign}{{{name}}}"))
            .collect()
    };
    format!("{letter}{}{}", group('^', upper), group('_', lower))
}

/// What a name is displayed as whose symbol is stated in LaTeX ([`Options::display`](super::Options::display)).
pub fn as_stated(latex: &str) -> String {
    format!("${latex}$")
}

/// The symbol of [`as_stated`].
fn stated(name: &str) -> Option<TypesetName> {
    let latex = name.strip_prefix('$')?.strip_suffix('$')?;
    Some(TypesetName {
        head: Piece::Stated(StatedSymbol::read(latex).ok()?),
        superscripts: Vec::new(),
        subscripts: Vec::new(),
        argument: None,
    })
}

/// The Greek letter of a name that is cut short, as in `lam`, which is a word of Python.
fn short_greek(name: &str) -> Option<&'static str> {
    const SHORT: &[(&str, &str)] = &[
        ("lam", "lambda"),
        ("Lam", "Lambda"),
        ("eps", "epsilon"),
        ("gam", "gamma"),
        ("Gam", "Gamma"),
        ("sig", "sigma"),
        ("kap", "kappa"),
        ("omg", "omega"),
    ];
    let known = SHORT.iter().find(|(own, _)| *own == name);
    known.map(|(_, greek)| *greek)
}

/// A letter with another one as its index, one a capital and one not: `Cc`, `rR`.
fn two_letters(name: &str) -> Option<(char, char)> {
    let mut letters = name.chars();
    let (first, second) = (letters.next()?, letters.next()?);
    let is_pair = first.is_ascii_alphabetic() && second.is_ascii_alphabetic();
    let is_mixed = first.is_ascii_uppercase() != second.is_ascii_uppercase();
    (is_pair && is_mixed && letters.next().is_none()).then_some((first, second))
}

/// The groups `{…}` behind a sign.
fn group<'a>(indices: &'a str, sign: &'a str) -> impl Iterator<Item = &'a str> + 'a {
    let groups = indices.split('}');
    groups.filter_map(move |group| group.strip_prefix(sign)?.strip_prefix('{'))
}

/// A name of [`with_indices`], split.
fn with_groups(letter: &str, indices: &str) -> TypesetName {
    let split = |sign: &'static str| {
        let names = group(indices, sign).map(typeset);
        let own = |name: TypesetName| {
            let mut pieces = vec![Subscript {
                piece: name.head,
                digits: None,
            }];
            pieces.extend(name.subscripts);
            merged(pieces)
        };
        names.flat_map(own).collect()
    };
    TypesetName {
        head: piece(letter),
        superscripts: split("^"),
        subscripts: split("_"),
        argument: None,
    }
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
    if text.contains(',') {
        return Piece::Indices(text.to_string());
    }
    if let Some(accented) = accented(text) {
        return accented;
    }
    if let Some(accented) = text.strip_prefix('D').and_then(accented) {
        return Piece::Derivative(Box::new(accented));
    }
    let mut letters = text.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => Piece::Letter(letter),
        _ => Piece::Word(text.to_string()),
    }
}

/// An index: `w1` is the letter w with its number; a word keeps its digits.
fn numbered(part: &str) -> Vec<Piece> {
    let letters = part.trim_end_matches(|c: char| c.is_ascii_digit());
    match piece(letters) {
        own @ (Piece::Letter(_) | Piece::Greek(..)) if letters.len() < part.len() => {
            vec![own, piece(&part[letters.len()..])]
        }
        _ => vec![piece(part)],
    }
}

/// Splits a name at underscores and before final digits: `q_1`, `q1` and `q_{1}` of a person's hand are the same.
pub(crate) fn typeset(name: &str) -> TypesetName {
    if let Some(own) = stated(name) {
        return own;
    }
    if let Some(start) = name
        .find(['^', '_'])
        .filter(|&at| name[at + 1..].starts_with('{'))
    {
        return with_groups(&name[..start], &name[start..]);
    }
    if let Some(function) = function_of(name) {
        return function;
    }
    let mut parts = name.split('_').filter(|part| !part.is_empty());
    let Some(first) = parts.next() else {
        return TypesetName {
            head: Piece::Word(name.to_string()),
            superscripts: Vec::new(),
            subscripts: Vec::new(),
            argument: None,
        };
    };
    let letters = if first.contains(',') {
        first
    } else {
        first.trim_end_matches(|c: char| c.is_ascii_digit())
    };
    let mut pieces = Vec::new();
    let head = if letters.is_empty() { first } else { letters };
    let head = match two_letters(head) {
        Some((letter, index)) => {
            pieces.push(Piece::Letter(index));
            Piece::Letter(letter)
        }
        None => piece(short_greek(head).unwrap_or(head)),
    };
    if !letters.is_empty() && letters.len() < first.len() {
        pieces.push(piece(&first[letters.len()..]));
    }
    pieces.extend(parts.flat_map(numbered));
    TypesetName {
        head,
        superscripts: Vec::new(),
        subscripts: subscripts(pieces),
        argument: None,
    }
}

/// A function of a tensor with its primes: `A(e)`, `A'_11(e)`.
fn function_of(name: &str) -> Option<TypesetName> {
    let (front, argument) = name.strip_suffix(')')?.split_once('(')?;
    let bare = front.replace('\'', "");
    if bare.is_empty() || argument.is_empty() {
        return None;
    }
    let mut own = typeset(&bare);
    let primes = front.len() - bare.len();
    if primes > 0 {
        own.superscripts.push(Subscript {
            piece: Piece::Primes(primes),
            digits: None,
        });
    }
    own.argument = Some(Box::new(typeset(argument)));
    Some(own)
}

/// A number after letters is their subscript; numbers stand side by side.
fn subscripts(pieces: Vec<Piece>) -> Vec<Subscript> {
    let bare = |piece| Subscript {
        piece,
        digits: None,
    };
    merged(pieces.into_iter().map(bare).collect())
}

fn merged(pieces: Vec<Subscript>) -> Vec<Subscript> {
    let mut merged: Vec<Subscript> = Vec::new();
    for next in pieces {
        match (&next, merged.last_mut()) {
            (
                Subscript {
                    piece: Piece::Digits(own),
                    digits: None,
                },
                Some(Subscript {
                    piece:
                        Piece::Letter(_) | Piece::Greek(..) | Piece::Word(_) | Piece::Accented(..),
                    digits: digits @ None,
                }),
            ) => *digits = Some(own.clone()),
            _ => merged.push(next),
        }
    }
    merged
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
        // The index of `F_w1` is w₁; in `I_xx2` it is a word.
        assert_eq!(typeset("F_w1"), typeset("F_w_1"));
        assert_eq!(
            typeset("I_xx2").subscripts,
            [bare(Piece::Word("xx2".into()))]
        );
        assert_eq!(typeset("q_1_2").subscripts, [digits("1"), digits("2")]);
        assert_eq!(
            typeset("lambda_blade").subscripts,
            [bare(Piece::Word("blade".into()))]
        );
        assert_eq!(
            typeset("Q_theta_1").subscripts,
            [Subscript {
                piece: theta.clone(),
                digits: Some("1".into())
            }]
        );
        let theta_sign = theta;
        let tilde = Piece::Accented(Box::new(Piece::Letter('T')), Accent::Tilde);
        assert_eq!(typeset("Ttilde_x").head, tilde.clone());
        assert_eq!(
            typeset("DTtilde_x").head,
            Piece::Derivative(Box::new(tilde))
        );
        for word in ["star", "tilde", "bar", "mustard", "crossbar"] {
            assert_eq!(typeset(word).head, Piece::Word(word.into()));
        }
        let component = typeset(&with_indices("Gamma", &["w_1"], &["x", "theta2"]));
        assert_eq!(component.head, Piece::Greek("Gamma".into(), 'Γ'));
        let w = Subscript {
            piece: Piece::Letter('w'),
            digits: Some("1".into()),
        };
        assert_eq!(component.superscripts, [w]);
        let theta = Subscript {
            piece: theta_sign,
            digits: Some("2".into()),
        };
        assert_eq!(component.subscripts, [bare(Piece::Letter('x')), theta]);
        // Derivatives of a component, and the gradient of a function of a tensor.
        let jet = typeset(&with_indices("u", &[], &["1,12"]));
        assert_eq!(jet.subscripts, [bare(Piece::Indices("1,12".into()))]);
        let gradient = typeset("A'_11(e)");
        assert_eq!(gradient.head, Piece::Letter('A'));
        assert_eq!(gradient.superscripts, [bare(Piece::Primes(1))]);
        assert_eq!(gradient.subscripts, [digits("11")]);
        assert_eq!(gradient.argument, Some(Box::new(typeset("e"))));
        assert_eq!(typeset("lam_1").head, Piece::Greek("lambda".into(), 'λ'));
        for (pair, letter, index) in [("Cc", 'C', 'c'), ("rR", 'r', 'R')] {
            assert_eq!(typeset(pair).head, Piece::Letter(letter));
            assert_eq!(typeset(pair).subscripts, [bare(Piece::Letter(index))]);
        }
        assert_eq!(typeset("gs").head, Piece::Word("gs".into()));
        assert!(matches!(typeset(&as_stated("C_c")).head, Piece::Stated(_)));
        assert_eq!(typeset("mass").head, Piece::Word("mass".into()));
        assert_eq!(typeset("_").head, Piece::Word("_".into()));
    }
}
