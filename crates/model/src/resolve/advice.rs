//! What other programs write, and how it is written here: `dx/dt`, `diff(x, t)`, `1 kg`.

use chetaev_symbolic::syntax::Diagnostic;

use crate::units::parse_unit;

/// Functions of other programs that differentiate.
const DIFFERENTIATES: &[&str] = &[
    "diff",
    "Derivative",
    "derivative",
    "der",
    "deriv",
    "ddt",
    "Dt",
];

/// Words for degrees of an angle.
const DEGREES: &[&str] = &["deg", "degree", "degrees"];

/// Whether a name that nothing is called is the unit of an angle, 1/180 of π.
pub(crate) fn is_degree(name: &str) -> bool {
    DEGREES.contains(&name)
}

/// Whether a text has a degree in it.
pub(crate) fn names_a_degree(text: &str) -> bool {
    let mut words = text.split(|sign: char| !(sign.is_alphanumeric() || sign == '_'));
    // In `30deg` the number and the name are read apart.
    words.any(|word| is_degree(word.trim_start_matches(|sign: char| sign.is_ascii_digit())))
}

/// The diagnostic with what to write in place of the notation of another program; `known` tells the names of the model.
pub(crate) fn improved(
    diagnostic: &Diagnostic,
    text: &str,
    known: &dyn Fn(&str) -> bool,
) -> Diagnostic {
    let own = diagnostic.clone();
    let (Some(name), Some(after)) = (
        text.get(own.span.start..own.span.end),
        text.get(own.span.end..),
    ) else {
        return own;
    };
    let is_unknown = own.code == "unknown-name";
    if is_unknown && is_a_quantity(text, name) {
        return Diagnostic {
            hints: vec![format!(
                "state the unit beside the number, as in m = {{ value = 1, unit = \"{name}\" }}"
            )],
            suggestion: None,
            ..own
        };
    }
    if own.code == "no-such-function" && DIFFERENTIATES.contains(&name) {
        return match differentiated(after, known) {
            Some((length, written)) => {
                let span =
                    chetaev_symbolic::syntax::Span::new(own.span.start, own.span.end + length);
                own.suggest(span, written)
            }
            None => own,
        };
    }
    match by_dt(after).filter(|_| is_unknown) {
        Some(length) => of_quotient(own, name, (after, length), known),
        None => own,
    }
}

/// `dx` of dx/dt, or `d` of d/dt x.
fn of_quotient(
    own: Diagnostic,
    name: &str,
    (after, length): (&str, usize),
    known: &dyn Fn(&str) -> bool,
) -> Diagnostic {
    let Some(stem) = name.strip_prefix('d') else {
        return own;
    };
    if stem.is_empty() {
        return own.hint("primes are derivatives with respect to the time: write x' for d/dt x");
    }
    // What is differentiated in dx/dt^2 is not said.
    let is_plain = !after[length..].trim_start().starts_with(['^', '*']);
    if !known(stem) || !is_plain {
        return own;
    }
    let span = chetaev_symbolic::syntax::Span::new(own.span.start, own.span.end + length);
    own.suggest(span, format!("{stem}'"))
}

/// The length of `/dt` at the beginning of a text.
fn by_dt(after: &str) -> Option<usize> {
    let rest = after.trim_start().strip_prefix('/')?.trim_start();
    let rest = rest.strip_prefix("dt")?;
    let goes_on = rest.starts_with(|sign: char| sign.is_alphanumeric() || sign == '_');
    (!goes_on).then(|| after.len() - rest.len())
}

/// The length of `(x, t)` or `(x, t, 2)` at the beginning of a text, and what is meant.
fn differentiated(after: &str, known: &dyn Fn(&str) -> bool) -> Option<(usize, String)> {
    let inside = after.strip_prefix('(')?;
    let end = inside.find(')')?;
    let parts: Vec<&str> = inside[..end].split(',').map(str::trim).collect();
    let order = match parts.as_slice() {
        [_] | [_, "t"] => 1,
        [_, "t", "t"] | [_, "t", "2"] => 2,
        _ => return None,
    };
    let bare = parts[0].strip_suffix("(t").unwrap_or(parts[0]);
    // `x(t)` inside closes the first parenthesis found.
    if bare != parts[0] || !known(bare) {
        return None;
    }
    Some((end + 2, format!("{bare}{}", "'".repeat(order))))
}

/// Whether a text is a number with this unit behind it.
fn is_a_quantity(text: &str, name: &str) -> bool {
    let number = text.trim().strip_suffix(name).map(str::trim_end);
    let is_number = number.is_some_and(|number| number.parse::<f64>().is_ok());
    is_number && parse_unit(name).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_and_calls_are_measured() {
        let known = |name: &str| name == "x";
        assert_eq!(by_dt(" / dt)^2"), Some(5));
        assert_eq!(by_dt("/dtau"), None);
        assert_eq!(differentiated("(x, t)^2", &known), Some((6, "x'".into())));
        assert_eq!(differentiated("(x, t, 2)", &known), Some((9, "x''".into())));
        assert_eq!(differentiated("(y, t)", &known), None);
        assert!(names_a_degree("2*30deg") && names_a_degree("30 deg"));
        assert!(!names_a_degree("degrade + 1"));
    }
}
