//! Units of measurement: SI base and derived units with prefixes, and the dimensions behind them.

use std::fmt;

use chetaev_symbolic::syntax::ast::{Binary, Node, NodeId};
use chetaev_symbolic::syntax::{self, names, parse_expression, Diagnostic, Span};
use chetaev_symbolic::{rational, Rational};

/// Symbols of the SI base units, in the order of the exponents of a [`Dimension`].
const BASE: [&str; 7] = ["m", "kg", "s", "A", "K", "mol", "cd"];

/// A product of powers of the SI base units. Angles have no dimension.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dimension {
    exponents: [Rational; 7],
}

impl Dimension {
    /// The dimension of a pure number.
    pub fn none() -> Self {
        Dimension {
            exponents: std::array::from_fn(|_| Rational::ZERO),
        }
    }

    /// The dimension of time.
    pub fn time() -> Self {
        Self::integers([0, 0, 1, 0, 0, 0, 0])
    }

    fn integers(exponents: [i32; 7]) -> Self {
        Dimension {
            exponents: exponents.map(Rational::from),
        }
    }

    /// Whether it is that of a pure number.
    pub fn is_none(&self) -> bool {
        self.exponents.iter().all(Rational::is_zero)
    }

    /// The dimension of a product.
    #[must_use]
    pub fn times(&self, other: &Dimension) -> Dimension {
        Dimension {
            exponents: std::array::from_fn(|i| {
                rational::sum(&self.exponents[i], &other.exponents[i])
            }),
        }
    }

    /// The dimension of a quotient.
    #[must_use]
    pub fn over(&self, other: &Dimension) -> Dimension {
        Dimension {
            exponents: std::array::from_fn(|i| {
                rational::sum(&self.exponents[i], &-other.exponents[i].clone())
            }),
        }
    }

    /// The dimension of a power.
    #[must_use]
    pub fn power(&self, exponent: &Rational) -> Dimension {
        Dimension {
            exponents: std::array::from_fn(|i| rational::product(&self.exponents[i], exponent)),
        }
    }
}

impl fmt::Display for Dimension {
    /// In base units, as in `kg m^2/s^2`; `1` for a pure number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const ORDER: [usize; 7] = [1, 0, 2, 3, 4, 5, 6];
        let part = |i: usize, exponent: &Rational| match exponent {
            e if e.is_one() => BASE[i].to_owned(),
            e if e.is_int() => format!("{}^{e}", BASE[i]),
            e => format!("{}^({e})", BASE[i]),
        };
        let side = |above: bool| -> Vec<String> {
            ORDER
                .into_iter()
                .filter(|i| {
                    (self.exponents[*i] > Rational::ZERO) == above && !self.exponents[*i].is_zero()
                })
                .map(|i| {
                    if above {
                        part(i, &self.exponents[i])
                    } else {
                        part(i, &-self.exponents[i].clone())
                    }
                })
                .collect()
        };
        let (above, below) = (side(true), side(false));
        let above = if above.is_empty() {
            "1".to_owned()
        } else {
            above.join(" ")
        };
        match below.as_slice() {
            [] => write!(f, "{above}"),
            [one] => write!(f, "{above}/{one}"),
            many => write!(f, "{above}/({})", many.join(" ")),
        }
    }
}

/// A unit: a dimension with the exact factor to the coherent SI unit, `factor · π^pi`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// As it is written.
    pub text: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// Rational part of the factor to SI base units: 1/1000 for mm.
    pub factor: Rational,
    /// Power of π in the factor: 1 for degrees.
    pub pi: i32,
}

impl Unit {
    /// Whether values in this unit are values in SI base units.
    pub fn is_coherent(&self) -> bool {
        self.factor.is_one() && self.pi == 0
    }
}

/// A number with a unit behind it, as in `85 kg`: the two texts and what the unit is.
pub(crate) fn quantity(text: &str) -> Option<(&str, &str, Unit)> {
    let trimmed = text.trim();
    let at = trimmed.find(char::is_whitespace)?;
    let (number, unit) = (&trimmed[..at], trimmed[at..].trim_start());
    let is_number = number.parse::<f64>().is_ok() && number.contains(|c: char| c.is_ascii_digit());
    let unit_read = parse_unit(unit).ok().filter(|_| is_number)?;
    let has_name = unit.contains(|c: char| c.is_alphabetic() && c != 'e');
    has_name.then_some((number, unit, unit_read))
}

struct Named {
    symbol: &'static str,
    /// Exponents of m, kg, s, A, K, mol, cd.
    dimension: [i32; 7],
    /// Numerator and denominator of the factor.
    factor: (u32, u32),
    pi: i32,
    /// Whether prefixes are usual.
    prefixes: bool,
}

const fn named(
    symbol: &'static str,
    dimension: [i32; 7],
    factor: (u32, u32),
    pi: i32,
    prefixes: bool,
) -> Named {
    Named {
        symbol,
        dimension,
        factor,
        pi,
        prefixes,
    }
}

const NAMED: &[Named] = &[
    named("m", [1, 0, 0, 0, 0, 0, 0], (1, 1), 0, true),
    named("g", [0, 1, 0, 0, 0, 0, 0], (1, 1000), 0, true),
    named("s", [0, 0, 1, 0, 0, 0, 0], (1, 1), 0, true),
    named("A", [0, 0, 0, 1, 0, 0, 0], (1, 1), 0, true),
    named("K", [0, 0, 0, 0, 1, 0, 0], (1, 1), 0, true),
    named("mol", [0, 0, 0, 0, 0, 1, 0], (1, 1), 0, true),
    named("cd", [0, 0, 0, 0, 0, 0, 1], (1, 1), 0, true),
    named("rad", [0; 7], (1, 1), 0, true),
    named("sr", [0; 7], (1, 1), 0, false),
    named("deg", [0; 7], (1, 180), 1, false),
    named("rev", [0; 7], (2, 1), 1, false),
    named("rpm", [0, 0, -1, 0, 0, 0, 0], (1, 30), 1, false),
    named("Hz", [0, 0, -1, 0, 0, 0, 0], (1, 1), 0, true),
    named("N", [1, 1, -2, 0, 0, 0, 0], (1, 1), 0, true),
    named("J", [2, 1, -2, 0, 0, 0, 0], (1, 1), 0, true),
    named("W", [2, 1, -3, 0, 0, 0, 0], (1, 1), 0, true),
    named("Pa", [-1, 1, -2, 0, 0, 0, 0], (1, 1), 0, true),
    named("bar", [-1, 1, -2, 0, 0, 0, 0], (100_000, 1), 0, true),
    named("C", [0, 0, 1, 1, 0, 0, 0], (1, 1), 0, true),
    named("V", [2, 1, -3, -1, 0, 0, 0], (1, 1), 0, true),
    named("ohm", [2, 1, -3, -2, 0, 0, 0], (1, 1), 0, true),
    named("S", [-2, -1, 3, 2, 0, 0, 0], (1, 1), 0, true),
    named("F", [-2, -1, 4, 2, 0, 0, 0], (1, 1), 0, true),
    named("H", [2, 1, -2, -2, 0, 0, 0], (1, 1), 0, true),
    named("Wb", [2, 1, -2, -1, 0, 0, 0], (1, 1), 0, true),
    named("T", [0, 1, -2, -1, 0, 0, 0], (1, 1), 0, true),
    named("t", [0, 1, 0, 0, 0, 0, 0], (1000, 1), 0, false),
    named("L", [3, 0, 0, 0, 0, 0, 0], (1, 1000), 0, true),
    named("min", [0, 0, 1, 0, 0, 0, 0], (60, 1), 0, false),
    named("h", [0, 0, 1, 0, 0, 0, 0], (3600, 1), 0, false),
    named("d", [0, 0, 1, 0, 0, 0, 0], (86_400, 1), 0, false),
];

/// Prefixes with their powers of ten.
const PREFIXES: &[(&str, i32)] = &[
    ("da", 1),
    ("mu", -6),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("n", -9),
    ("p", -12),
];

fn unit_of_symbol(symbol: &str) -> Option<Unit> {
    let symbol = match symbol {
        "Omega" => "ohm",
        other => other,
    };
    let plain = |name: &str| NAMED.iter().find(|named| named.symbol == name);
    let (named, power) = match plain(symbol) {
        Some(named) => (named, 0),
        None => PREFIXES.iter().find_map(|(prefix, power)| {
            let named = plain(symbol.strip_prefix(prefix)?)?;
            named.prefixes.then_some((named, *power))
        })?,
    };
    let ten = Rational::from(10);
    let (above, below) = named.factor;
    let factor = Rational::from(above) / Rational::from(below) * raised(&ten, power);
    Some(Unit {
        text: symbol.to_owned(),
        dimension: Dimension::integers(named.dimension),
        factor,
        pi: named.pi,
    })
}

fn raised(base: &Rational, power: i32) -> Rational {
    let positive = (0..power.unsigned_abs()).fold(Rational::ONE, |product, _| product * base);
    if power < 0 {
        Rational::ONE / positive
    } else {
        positive
    }
}

/// Largest power of a unit.
const LARGEST_POWER: i64 = 24;

/// Reads a unit such as `kg m^2/s^2`, `N m`, `1/s`, `rad/s`, `deg`.
///
/// # Errors
/// The diagnostics, all of them, with spans of the text.
pub fn parse_unit(text: &str) -> Result<Unit, Vec<Diagnostic>> {
    let parsed = parse_expression(text);
    let mut diagnostics: Vec<Diagnostic> = parsed
        .diagnostics
        .iter()
        .filter(|diagnostic| diagnostic.code != "function-without-argument")
        .cloned()
        .collect();
    for diagnostic in &mut diagnostics {
        // `J/kg K` has two readings among people, so it has to be said which is meant.
        if diagnostic.code == "quotient-then-factor" {
            diagnostic.severity = syntax::Severity::Error;
        }
    }
    // Children come first, so one pass gives every node its unit.
    let mut values: Vec<Option<Unit>> = Vec::with_capacity(parsed.tree.len());
    for (id, node) in parsed.tree.iter() {
        let value = unit_of_node(node, parsed.tree.span(id), text, &values, &mut diagnostics);
        values.push(value);
    }
    let root = values.get(index(parsed.root())).cloned().flatten();
    match root {
        Some(unit) if diagnostics.iter().all(|diagnostic| !diagnostic.is_error()) => Ok(Unit {
            text: text.trim().to_owned(),
            ..unit
        }),
        _ => {
            if diagnostics.is_empty() {
                let whole = Span::new(0, text.len());
                diagnostics.push(
                    Diagnostic::error("bad-unit", whole, "this is not a unit")
                        .hint("for example \"kg m^2\" or \"rad/s\""),
                );
            }
            Err(diagnostics)
        }
    }
}

fn index(id: NodeId) -> usize {
    id.index()
}

fn unit_of_node(
    node: &Node,
    span: Span,
    text: &str,
    values: &[Option<Unit>],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Unit> {
    let of = |id: NodeId| values.get(index(id)).cloned().flatten();
    match node {
        Node::Number(value) if !value.is_zero() => {
            Some(combined(Dimension::none(), value.clone(), 0))
        }
        Node::Negate(operand) => of(*operand).map(|unit| Unit {
            factor: -unit.factor,
            ..unit
        }),
        Node::Name {
            order: 0, letters, ..
        } => named_unit(*letters, text, diagnostics),
        Node::Binary {
            operation: Binary::Multiply,
            left,
            right,
        } => {
            let (a, b) = (of(*left)?, of(*right)?);
            Some(combined(
                a.dimension.times(&b.dimension),
                a.factor * b.factor,
                a.pi + b.pi,
            ))
        }
        Node::Binary {
            operation: Binary::Divide,
            left,
            right,
        } => {
            let (a, b) = (of(*left)?, of(*right)?);
            Some(combined(
                a.dimension.over(&b.dimension),
                a.factor / b.factor,
                a.pi - b.pi,
            ))
        }
        Node::Binary {
            operation: Binary::Power,
            left,
            right,
        } => power(&of(*left)?, &of(*right)?, span, diagnostics),
        _ => {
            let message = "a unit is made of unit names, products, quotients and powers";
            diagnostics.push(Diagnostic::error("bad-unit", span, message));
            None
        }
    }
}

/// A unit without a name of its own.
fn combined(dimension: Dimension, factor: Rational, pi: i32) -> Unit {
    Unit {
        text: String::new(),
        dimension,
        factor,
        pi,
    }
}

/// The unit of a symbol; an unknown one is reported with the nearest.
fn named_unit(letters: Span, text: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Unit> {
    let written = names::normalized(letters.text(text));
    let found = unit_of_symbol(&written);
    if found.is_none() {
        let message = format!("unknown unit `{}`", letters.text(text));
        let mut diagnostic = Diagnostic::error("unknown-unit", letters, message);
        let symbols = NAMED.iter().map(|named| named.symbol);
        if let Some(near) = names::closest(&written, symbols.chain(["kg", "mm", "cm", "km"])) {
            diagnostic = diagnostic
                .hint(format!("did you mean `{near}`?"))
                .suggest(letters, near);
        }
        diagnostics.push(diagnostic);
    }
    found
}

fn power(
    base: &Unit,
    exponent: &Unit,
    span: Span,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Unit> {
    let whole = syntax::parse::integer_of(&exponent.factor)
        .filter(|power| power.abs() <= LARGEST_POWER && exponent.dimension.is_none());
    if let Some(whole) = whole {
        let whole = whole as i32;
        return Some(Unit {
            text: String::new(),
            dimension: base.dimension.power(&Rational::from(whole)),
            factor: raised(&base.factor, whole),
            pi: base.pi * whole,
        });
    }
    if exponent.dimension.is_none()
        && !exponent.factor.is_int()
        && base.factor.is_one()
        && base.pi == 0
    {
        return Some(Unit {
            text: String::new(),
            dimension: base.dimension.power(&exponent.factor),
            factor: Rational::ONE,
            pi: 0,
        });
    }
    diagnostics.push(Diagnostic::error(
        "bad-unit",
        span,
        "the power of a unit must be a small integer",
    ));
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, dimension: &str, factor: &str, pi: i32) {
        let unit = parse_unit(text).unwrap_or_else(|problems| panic!("{text}: {problems:?}"));
        assert_eq!(
            (
                unit.dimension.to_string().as_str(),
                unit.factor.to_string().as_str(),
                unit.pi
            ),
            (dimension, factor, pi),
            "{text}"
        );
    }

    #[test]
    fn units_have_the_dimensions_of_the_si_brochure() {
        check("kg m^2", "kg m^2", "1", 0);
        check("N m", "kg m^2/s^2", "1", 0);
        check("J", "kg m^2/s^2", "1", 0);
        check("W", "kg m^2/s^3", "1", 0);
        check("Pa", "kg/(m s^2)", "1", 0);
        check("V", "kg m^2/(s^3 A)", "1", 0);
        check("C", "s A", "1", 0);
        check("1/s", "1/s", "1", 0);
        check("rad/s", "1/s", "1", 0);
        check("m²", "m^2", "1", 0);
        check("m s^-2", "m/s^2", "1", 0);
        check("m^(1/2)", "m^(1/2)", "1", 0);
    }

    #[test]
    fn prefixes_and_other_units_have_exact_factors() {
        check("mm", "m", "1/1000", 0);
        check("km/h", "m/s", "5/18", 0);
        check("deg", "1", "1/180", 1);
        check("rpm", "1/s", "1/30", 1);
        check("g", "kg", "1/1000", 0);
        check("µm", "m", "1/1000000", 0);
        check("kN", "kg m/s^2", "1000", 0);
        check("min", "s", "60", 0);
        check("cm^2", "m^2", "1/10000", 0);
    }

    #[test]
    fn what_is_no_unit_is_said_so() {
        let code = |text: &str| parse_unit(text).unwrap_err()[0].code;
        assert_eq!(code("kilo"), "unknown-unit");
        assert_eq!(code("kg + m"), "bad-unit");
        assert_eq!(code("J/kg K"), "quotient-then-factor");
        assert_eq!(code(""), "empty-expression");
        assert_eq!(code("m^1000"), "bad-unit");
        assert_eq!(code("m'"), "bad-unit");
        assert_eq!(
            parse_unit("Kg").unwrap_err()[0]
                .suggestion
                .as_ref()
                .unwrap()
                .replacement,
            "kg"
        );
    }
}
