//! Text to tokens. Never fails: a sign that means nothing becomes a diagnostic and is left out.

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

use super::ast::Relation;
use super::diagnostic::Diagnostic;
use super::names::{begins_name, continues_name, normalized, superscript_digit};
use super::span::Span;
use super::unknown::advice;

/// Largest absolute value of a decimal exponent. A larger one is a slip of the pen, and exact arithmetic would fill
/// the memory with its digits.
const LARGEST_EXPONENT: i64 = 10_000;

/// Kinds of tokens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// An exact number.
    Number(RBig),
    /// A name, Greek letters written out.
    Name(String),
    /// One or more primes.
    Primes(u32),
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Star,
    /// `/`
    Slash,
    /// `^` or `**`
    Caret,
    /// `(`
    Open,
    /// `)`
    Close,
    /// `{`
    OpenBrace,
    /// `}`
    CloseBrace,
    /// `,`
    Comma,
    /// `..`
    Dots,
    /// `=`, `<`, …
    Relation(Relation),
}

/// A token with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Where it is.
    pub span: Span,
}

/// Splits a text into tokens.
pub fn tokens(source: &str) -> (Vec<Token>, Vec<Diagnostic>) {
    let mut lexer = Lexer {
        source,
        at: 0,
        tokens: Vec::new(),
        diagnostics: Vec::new(),
    };
    while let Some(sign) = lexer.peek() {
        lexer.step(sign);
    }
    (lexer.tokens, lexer.diagnostics)
}

struct Lexer<'s> {
    source: &'s str,
    at: usize,
    tokens: Vec<Token>,
    diagnostics: Vec<Diagnostic>,
}

impl Lexer<'_> {
    fn peek(&self) -> Option<char> {
        self.source[self.at..].chars().next()
    }

    fn peek_after(&self, skip: usize) -> Option<char> {
        self.source[self.at..].chars().nth(skip)
    }

    fn push(&mut self, kind: TokenKind, length: usize) {
        self.tokens.push(Token {
            kind,
            span: Span::new(self.at, self.at + length),
        });
        self.at += length;
    }

    fn step(&mut self, sign: char) {
        if sign.is_whitespace() || sign == '\u{feff}' {
            self.at += sign.len_utf8();
        } else if sign.is_ascii_digit()
            || (sign == '.' && self.peek_after(1).is_some_and(|c| c.is_ascii_digit()))
        {
            self.number();
        } else if begins_name(sign) {
            self.name();
        } else if let Some(count) = primes(sign) {
            self.primes(count);
        } else if superscript_digit(sign).is_some() {
            self.superscript();
        } else if !self.operator(sign) {
            self.unknown(sign);
        }
    }

    fn name(&mut self) {
        let rest = &self.source[self.at..];
        let length = rest.find(|c| !continues_name(c)).unwrap_or(rest.len());
        let name = normalized(&rest[..length]);
        self.push(TokenKind::Name(name), length);
    }

    fn primes(&mut self, first: u32) {
        let start = self.at;
        let mut count = first;
        self.at += self.peek().map_or(0, char::len_utf8);
        while let Some(more) = self.peek().and_then(primes) {
            count = count.saturating_add(more);
            self.at += self.peek().map_or(0, char::len_utf8);
        }
        self.tokens.push(Token {
            kind: TokenKind::Primes(count),
            span: Span::new(start, self.at),
        });
    }

    /// `x²` is read as `x^2`.
    fn superscript(&mut self) {
        let rest = &self.source[self.at..];
        let length = rest
            .find(|c| superscript_digit(c).is_none())
            .unwrap_or(rest.len());
        let digits: String = rest[..length]
            .chars()
            .filter_map(superscript_digit)
            .collect();
        let span = Span::new(self.at, self.at + length);
        let value = digits.parse::<IBig>().map(RBig::from).unwrap_or(RBig::ONE);
        self.tokens.push(Token {
            kind: TokenKind::Caret,
            span,
        });
        self.tokens.push(Token {
            kind: TokenKind::Number(value),
            span,
        });
        self.at += length;
    }

    fn number(&mut self) {
        let rest = &self.source.as_bytes()[self.at..];
        let digits = |from: usize| {
            from + rest[from..]
                .iter()
                .take_while(|byte| byte.is_ascii_digit())
                .count()
        };
        let mut end = digits(0);
        // `1..n` is a range, not the number `1.` followed by `.n`.
        if rest.get(end) == Some(&b'.') && rest.get(end + 1) != Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(rest.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(rest.get(end + 1), Some(b'+' | b'-')));
            let last = digits(end + 1 + sign);
            if last > end + 1 + sign {
                end = last;
            }
        }
        let text = &self.source[self.at..self.at + end];
        let value = exact_number(text).unwrap_or_else(|| {
            let span = Span::new(self.at, self.at + end);
            self.diagnostics.push(
                Diagnostic::error(
                    "number-out-of-range",
                    span,
                    "the exponent of this number is too large",
                )
                .hint(format!(
                    "exponents up to {LARGEST_EXPONENT} are read exactly"
                )),
            );
            RBig::ONE
        });
        self.push(TokenKind::Number(value), end);
    }

    fn operator(&mut self, sign: char) -> bool {
        use TokenKind::*;
        let next = self.peek_after(1);
        let (kind, count) = match (sign, next) {
            ('*', Some('*')) => (Caret, 2),
            ('*' | '·' | '⋅' | '×' | '∙' | '∗', _) => (Star, 1),
            ('+', _) => (Plus, 1),
            ('-' | '−' | '–', _) => (Minus, 1),
            ('/' | '∕' | '⁄', _) => (Slash, 1),
            ('^', _) => (Caret, 1),
            ('(', _) => (Open, 1),
            (')', _) => (Close, 1),
            ('{', _) => (OpenBrace, 1),
            ('}', _) => (CloseBrace, 1),
            (',', _) => (Comma, 1),
            ('…', _) => (Dots, 1),
            ('.', Some('.')) => (Dots, 2),
            ('=', Some('=')) => (Relation(super::ast::Relation::Equal), 2),
            ('=', _) => (Relation(super::ast::Relation::Equal), 1),
            ('!', Some('=')) => (Relation(super::ast::Relation::NotEqual), 2),
            ('≠', _) => (Relation(super::ast::Relation::NotEqual), 1),
            ('<', Some('=')) => (Relation(super::ast::Relation::LessOrEqual), 2),
            ('≤' | '⩽', _) => (Relation(super::ast::Relation::LessOrEqual), 1),
            ('<', _) => (Relation(super::ast::Relation::Less), 1),
            ('>', Some('=')) => (Relation(super::ast::Relation::GreaterOrEqual), 2),
            ('≥' | '⩾', _) => (Relation(super::ast::Relation::GreaterOrEqual), 1),
            ('>', _) => (Relation(super::ast::Relation::Greater), 1),
            _ => return false,
        };
        let length = self.source[self.at..]
            .chars()
            .take(count)
            .map(char::len_utf8)
            .sum();
        self.push(kind, length);
        true
    }

    /// A sign without meaning. Brackets are still read as parentheses, so that one slip gives one diagnostic.
    fn unknown(&mut self, sign: char) {
        let span = Span::new(self.at, self.at + sign.len_utf8());
        let base = Diagnostic::error(
            "unexpected-character",
            span,
            format!("`{sign}` has no meaning here"),
        );
        let diagnostic = match sign {
            '[' => base.hint("use parentheses to group").suggest(span, "("),
            ']' => base.hint("use parentheses to group").suggest(span, ")"),
            '√' => base.hint("write sqrt(x) for the square root"),
            '"' => base
                .hint("write two primes, x'', for the second derivative")
                .suggest(span, "''"),
            '\u{307}' | '\u{308}' | 'ẋ' | 'ẏ' | 'ż' | 'ẍ' => {
                base.hint("write x' and x'' for derivatives")
            }
            '∫' | '∂' => {
                base.hint("only derivatives with respect to the time can be written, as x'")
            }
            '½' => base.hint("write 1/2").suggest(span, "(1/2)"),
            '°' => base.hint("write `deg` for degrees").suggest(span, " deg"),
            '|' => base.hint("write abs(x) for the absolute value"),
            '?' | ':' => base.hint(advice("if").unwrap_or_default()),
            '%' => base.hint(advice("mod").unwrap_or_default()),
            '.' => base.hint("write `*` for a product and x' for a derivative"),
            '\\' => base.hint("this is not TeX: write theta, sqrt(x), a/b"),
            _ if sign.is_alphabetic() => {
                base.hint("names are made of Latin and Greek letters, digits and underscores")
            }
            _ => base,
        };
        self.diagnostics.push(diagnostic);
        match sign {
            '[' => self.push(TokenKind::Open, 1),
            ']' => self.push(TokenKind::Close, 1),
            _ => self.at += sign.len_utf8(),
        }
    }
}

fn primes(sign: char) -> Option<u32> {
    match sign {
        '\'' | '′' | '’' | 'ʹ' => Some(1),
        '″' | 'ʺ' => Some(2),
        '‴' => Some(3),
        '⁗' => Some(4),
        _ => None,
    }
}

/// The exact value of a decimal number such as `12`, `0.1`, `.5`, `2.5e-3`, with an optional sign.
///
/// `None` where the text is not such a number or its exponent exceeds 10000 in absolute value.
pub fn exact_number(text: &str) -> Option<RBig> {
    let (negative, text) = match text.as_bytes().first()? {
        b'-' => (true, &text[1..]),
        b'+' => (false, &text[1..]),
        _ => (false, text),
    };
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], text[at + 1..].parse::<i64>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: String = [whole, fraction].concat();
    if digits.is_empty()
        || !digits.bytes().all(|byte| byte.is_ascii_digit())
        || exponent.abs() > LARGEST_EXPONENT
    {
        return None;
    }
    let value = digits.parse::<IBig>().ok()?;
    let scale = exponent - fraction.len() as i64;
    let power = UBig::from(10u8).pow(usize::try_from(scale.unsigned_abs()).ok()?);
    let value = if negative { -value } else { value };
    Some(if scale >= 0 {
        RBig::from(value * IBig::from(power))
    } else {
        RBig::from_parts(value, power)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: i64, denominator: u64) -> RBig {
        RBig::from_parts(IBig::from(numerator), UBig::from(denominator))
    }

    #[test]
    fn numbers_are_exact() {
        assert_eq!(exact_number("0.1"), Some(ratio(1, 10)));
        assert_eq!(exact_number("1e-3"), Some(ratio(1, 1000)));
        assert_eq!(exact_number("-2.50E+2"), Some(ratio(-250, 1)));
        assert_eq!(exact_number(".5"), Some(ratio(1, 2)));
        assert_eq!(exact_number("3."), Some(ratio(3, 1)));
        assert_eq!(
            exact_number("12345678901234567890")
                .map(|n| n.to_string())
                .as_deref(),
            Some("12345678901234567890")
        );
        assert_eq!(exact_number("1e10001"), None);
        assert_eq!(exact_number("."), None);
        assert_eq!(exact_number("0x10"), None);
        assert_eq!(exact_number(""), None);
    }

    fn kinds(source: &str) -> Vec<TokenKind> {
        tokens(source)
            .0
            .into_iter()
            .map(|token| token.kind)
            .collect()
    }

    #[test]
    fn a_letter_after_a_number_is_a_name() {
        let two = TokenKind::Number(ratio(2, 1));
        assert_eq!(kinds("2e"), [two.clone(), TokenKind::Name("e".into())]);
        assert_eq!(
            kinds("2e-x"),
            [
                two,
                TokenKind::Name("e".into()),
                TokenKind::Minus,
                TokenKind::Name("x".into())
            ]
        );
    }

    #[test]
    fn dots_between_numbers_are_a_range() {
        let one = TokenKind::Number(ratio(1, 1));
        assert_eq!(
            kinds("1..n"),
            [one, TokenKind::Dots, TokenKind::Name("n".into())]
        );
    }

    #[test]
    fn primes_of_every_kind_are_counted() {
        for source in ["x''", "x″", "x′′", "x'′"] {
            assert_eq!(
                kinds(source),
                [TokenKind::Name("x".into()), TokenKind::Primes(2)],
                "{source}"
            );
        }
    }

    #[test]
    fn signs_without_meaning_are_reported_and_left_out() {
        let (tokens, diagnostics) = tokens("x @ y ☃");
        assert_eq!(tokens.len(), 2);
        assert_eq!(diagnostics.len(), 2);
        assert_eq!(diagnostics[1].span, Span::new(6, 9));
    }
}
