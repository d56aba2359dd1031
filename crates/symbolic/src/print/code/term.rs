//! Pieces of source text that know how tightly they bind.

/// Stands where a long line may be broken, instead of a space.
pub(super) const BREAK: char = '\u{1}';

/// Longest line that is not broken.
const WIDTH: usize = 100;

/// How tightly a piece of source text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Strength {
    /// A sum, or anything with a leading minus.
    Sum,
    /// A product that contains a division.
    Quotient,
    /// A product.
    Product,
    /// A name, a literal or a call.
    Atom,
}

/// A piece of source text.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) strength: Strength,
    /// Whether it consists of literals alone.
    pub(super) is_literal: bool,
}

impl Text {
    pub(super) fn new(text: String, strength: Strength) -> Text {
        Text {
            text,
            strength,
            is_literal: false,
        }
    }

    pub(super) fn atom(text: impl Into<String>) -> Text {
        Text::new(text.into(), Strength::Atom)
    }

    pub(super) fn literal(self) -> Text {
        Text {
            is_literal: true,
            ..self
        }
    }

    pub(super) fn negative(&self) -> Text {
        Text {
            text: format!("-{}", self.grouped(Strength::Quotient)),
            strength: Strength::Sum,
            is_literal: self.is_literal,
        }
    }

    /// The text, in parentheses if it binds less tightly than `least`.
    pub(super) fn grouped(&self, least: Strength) -> String {
        if self.strength >= least {
            self.text.clone()
        } else {
            format!("({})", self.text)
        }
    }
}

/// `above[0]*above[1]*…/(below[0]*…)`.
pub(super) fn quotient(above: &[Text], below: &[Text]) -> Text {
    let top = match above {
        [] => Text::atom("1.0").literal(),
        above => product(above),
    };
    let bottom = match below {
        [] => return top,
        below => product(below),
    };
    let text = format!(
        "{}/{}",
        top.grouped(Strength::Product),
        bottom.grouped(Strength::Atom)
    );
    Text {
        text,
        strength: Strength::Quotient,
        is_literal: top.is_literal && bottom.is_literal,
    }
}

/// The product of some factors, at least one.
pub(super) fn product(factors: &[Text]) -> Text {
    if let [only] = factors {
        return only.clone();
    }
    let texts: Vec<String> = factors
        .iter()
        .map(|factor| factor.grouped(Strength::Product))
        .collect();
    Text {
        text: texts.join("*"),
        strength: Strength::Product,
        is_literal: factors.iter().all(|factor| factor.is_literal),
    }
}

/// The sum of terms, each with whether it is subtracted.
pub(super) fn sum(terms: &[(bool, Text)]) -> Text {
    if let [(false, only)] = terms {
        return only.clone();
    }
    let mut out = String::new();
    for (place, (negative, term)) in terms.iter().enumerate() {
        let sign = if *negative { '-' } else { '+' };
        match (place, negative) {
            (0, true) => out.push('-'),
            (0, false) => {}
            _ => out.extend([BREAK, sign, ' ']),
        }
        out.push_str(&term.grouped(Strength::Quotient));
    }
    Text::new(out, Strength::Sum)
}

/// Appends lines of text at an indentation; what does not fit in a line goes on in the next one.
pub(super) fn push_wrapped(text: &str, indentation: usize, out: &mut String) {
    out.push_str(&" ".repeat(indentation));
    let mut column = indentation;
    for (place, piece) in text.split(BREAK).enumerate() {
        let length = piece.chars().count();
        if place > 0 && column + 1 + length > WIDTH {
            out.push('\n');
            out.push_str(&" ".repeat(indentation + 4));
            column = indentation + 4;
        } else if place > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(piece);
        column += length;
    }
    out.push('\n');
}

/// A list, which may be broken after its commas.
pub(super) fn list(entries: &[String]) -> String {
    entries.join(&format!(",{BREAK}"))
}
