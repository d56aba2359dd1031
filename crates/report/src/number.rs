//! Numbers in JSON (what is not finite is written as `null` and read back as NaN) and in words.

/// A number as people read it: at most six significant digits, `1.5 × 10⁻⁷` where it is far
/// from one.
pub(crate) fn readable(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "—".to_owned();
    }
    let scientific = format!("{value:.5e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-4..6).contains(&exponent) {
        let decimals = usize::try_from(5 - exponent).unwrap_or(0);
        trimmed(&format!("{value:.decimals$}"))
    } else {
        let exponent = exponent.to_string();
        let raised: String = exponent.chars().map(superscript).collect();
        match trimmed(mantissa).as_str() {
            "1" => format!("10{raised}"),
            "-1" => format!("-10{raised}"),
            mantissa => format!("{mantissa} × 10{raised}"),
        }
    };
    text.replace('-', "−")
}

/// Three significant digits: for what is compared by its order of magnitude.
pub(crate) fn brief(value: f64) -> String {
    match format!("{value:.2e}").parse() {
        Ok(rounded) => readable(rounded),
        Err(_) => readable(value),
    }
}

/// Numbers written with `e` set as in print: `1.07e-10` becomes `1.07 × 10⁻¹⁰`. What is part of a
/// name stays.
pub(crate) fn printed_powers(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    let mut before = ' ';
    while let Some(c) = rest.chars().next() {
        let is_word = before.is_alphanumeric() || matches!(before, '_' | '.');
        match scientific(rest).filter(|_| !is_word) {
            Some((mantissa, exponent, length)) => {
                let raised: String = exponent.chars().map(superscript).collect();
                match (trimmed(mantissa).as_str(), exponent) {
                    ("0", _) => out.push('0'),
                    (mantissa, _) if plain(mantissa, exponent).is_some() => {
                        out.push_str(&plain(mantissa, exponent).unwrap_or_default());
                    }
                    ("1", _) => out.push_str(&format!("10{raised}")),
                    (mantissa, _) => out.push_str(&format!("{mantissa} × 10{raised}")),
                }
                before = '0';
                rest = &rest[length..];
            }
            None => {
                out.push(c);
                before = c;
                rest = &rest[c.len_utf8()..];
            }
        }
    }
    out
}

/// The number without a power where that is as short: all digits stay as they are.
fn plain(mantissa: &str, exponent: &str) -> Option<String> {
    let exponent: i32 = exponent.parse().ok()?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let places = i32::try_from(whole.len()).ok()? + exponent;
    if !(-3..=5).contains(&exponent) {
        return None;
    }
    let digits = format!("{whole}{fraction}");
    let shifted = match usize::try_from(places) {
        Ok(0) | Err(_) => {
            let zeros = "0".repeat(usize::try_from(-places).unwrap_or(0));
            format!("0.{zeros}{digits}")
        }
        Ok(places) if places >= digits.len() => {
            format!("{digits}{}", "0".repeat(places - digits.len()))
        }
        Ok(places) => format!("{}.{}", &digits[..places], &digits[places..]),
    };
    Some(trimmed(&shifted))
}

/// Mantissa, exponent and length in bytes of a number like `1.07e-10` at the start.
fn scientific(text: &str) -> Option<(&str, &str, usize)> {
    let digits = |s: &str| s.bytes().take_while(u8::is_ascii_digit).count();
    let mut end = digits(text);
    if end == 0 {
        return None;
    }
    if text[end..].starts_with('.') {
        let decimals = digits(&text[end + 1..]);
        if decimals == 0 {
            return None;
        }
        end += 1 + decimals;
    }
    let mantissa = &text[..end];
    let exponent = text[end..].strip_prefix('e')?;
    let sign = usize::from(exponent.starts_with('-'));
    let count = digits(&exponent[sign..]);
    let after = exponent[sign + count..].chars().next();
    if count == 0 || after.is_some_and(|c| c.is_alphanumeric() || c == '_') {
        return None;
    }
    Some((mantissa, &exponent[..sign + count], end + 1 + sign + count))
}

/// Powers written with a caret set as in print: `2^-104` becomes `2⁻¹⁰⁴`.
pub(crate) fn raised(text: &str) -> String {
    let mut is_exponent = false;
    let mut out = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        is_exponent = match c {
            '^' => rest
                .peek()
                .is_some_and(|next| next.is_ascii_digit() || *next == '-'),
            _ => is_exponent && (c.is_ascii_digit() || c == '-'),
        };
        match c {
            '^' if is_exponent => {}
            c if is_exponent => out.push(superscript(c)),
            c => out.push(c),
        }
    }
    out
}

/// Without the zeros that end a fraction.
fn trimmed(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

fn superscript(c: char) -> char {
    match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4'..='9' => char::from_u32('⁰' as u32 + (c as u32 - '0' as u32)).unwrap_or(c),
        _ => '⁰',
    }
}

/// A single number, for `#[serde(with = …)]`.
pub(crate) mod scalar {
    use serde::{Deserialize, Deserializer, Serializer};

    pub(crate) fn serialize<S: Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
        if value.is_finite() {
            to.serialize_f64(*value)
        } else {
            to.serialize_none()
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        Ok(Option::<f64>::deserialize(from)?.unwrap_or(f64::NAN))
    }
}

/// A vector of numbers, for `#[serde(with = …)]`.
pub(crate) mod vector {
    use serde::{Deserialize, Deserializer, Serializer};

    pub(crate) fn serialize<S: Serializer>(values: &[f64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(values.iter().map(|v| v.is_finite().then_some(*v)))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
        let values = Vec::<Option<f64>>::deserialize(from)?;
        Ok(values.into_iter().map(|v| v.unwrap_or(f64::NAN)).collect())
    }
}

/// A vector of numbers rounded to what a drawing can show, for `#[serde(serialize_with = …)]`.
pub(crate) mod rounded {
    use serde::Serializer;

    /// Nine significant digits: enough to zoom into a curve a million times.
    pub(crate) fn fine<S: Serializer>(values: &[f64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(values.iter().map(|v| round(*v, 8)))
    }

    /// Six significant digits: less than a pixel.
    pub(crate) fn coarse<S: Serializer>(values: &[f64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(values.iter().map(|v| round(*v, 5)))
    }

    fn round(value: f64, decimals: usize) -> Option<f64> {
        if !value.is_finite() {
            return None;
        }
        format!("{value:.decimals$e}").parse().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::{printed_powers, raised, readable};
    use crate::data::{Report, Series, Trajectory};

    #[test]
    fn what_is_not_finite_goes_through_json_as_null() -> Result<(), serde_json::Error> {
        let report = Report {
            trajectory: Some(Trajectory {
                times: vec![0.0, 1.0, 2.0, 3.0],
                series: vec![Series {
                    values: vec![0.1, f64::NAN, f64::INFINITY, -2.5e-300],
                    ..Series::default()
                }],
                ..Trajectory::default()
            }),
            ..Report::default()
        };
        let text = serde_json::to_string(&report)?;
        assert!(text.contains("[0.1,null,null,-2.5e-300]"), "{text}");
        let back: Report = serde_json::from_str(&text)?;
        let values = &back.trajectory.unwrap_or_default().series[0].values;
        assert_eq!((values[0], values[3]), (0.1, -2.5e-300));
        assert!(values[1].is_nan() && values[2].is_nan());
        Ok(())
    }

    #[test]
    fn a_report_may_leave_out_everything() -> Result<(), serde_json::Error> {
        assert_eq!(serde_json::from_str::<Report>("{}")?, Report::default());
        Ok(())
    }

    #[test]
    fn numbers_read_as_in_print() {
        for (value, expected) in [
            (0.0, "0"),
            (-0.25, "−0.25"),
            (100.0, "100"),
            (1.2048374, "1.20484"),
            (123456.0, "123456"),
            (1.5e-7, "1.5 × 10⁻⁷"),
            (1e-9, "10⁻⁹"),
            (-1e12, "−10¹²"),
            (-2e14, "−2 × 10¹⁴"),
            (f64::NAN, "—"),
        ] {
            assert_eq!(readable(value), expected);
        }
    }

    #[test]
    fn numbers_with_an_exponent_are_set_as_in_print() {
        for (text, expected) in [
            (
                "drift 1.07e-10, asked 1e-11",
                "drift 1.07 × 10⁻¹⁰, asked 10⁻¹¹",
            ),
            ("0.00e0 and 2.50e0", "0 and 2.5"),
            ("-5.98e10", "-5.98 × 10¹⁰"),
            ("3.535533905e-1", "0.3535533905"),
            ("7.5e-2, 1e-3, 1e-4", "0.075, 0.001, 10⁻⁴"),
            ("2.5e3 and 1.25e1", "2500 and 12.5"),
            ("x1e5 1e5x 1e 2.e3", "x1e5 1e5x 1e 2.e3"),
        ] {
            assert_eq!(printed_powers(text), expected);
        }
    }

    #[test]
    fn powers_are_raised_and_nothing_else() {
        assert_eq!(raised("below 2^-104, 10^3 x^a"), "below 2⁻¹⁰⁴, 10³ x^a");
    }
}
