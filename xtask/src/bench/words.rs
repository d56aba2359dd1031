//! Numbers as a reader sees them.

/// Three significant digits.
pub(crate) fn figure(x: f64) -> String {
    if !x.is_finite() {
        return "–".into();
    }
    if x == 0.0 {
        return "0".into();
    }
    let size = x.abs().log10().floor() as i32;
    match size {
        -3..=-1 => format!("{x:.*}", (2 - size) as usize),
        0 => format!("{x:.2}"),
        1 => format!("{x:.1}"),
        2..=5 => format!("{x:.0}"),
        _ => format!("{x:.1e}"),
    }
}

/// Seconds in a unit that suits them.
pub(crate) fn time(seconds: f64) -> String {
    let (factor, unit) = match seconds.abs() {
        s if s >= 1.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e3, "ms"),
        s if s >= 1e-6 => (1e6, "µs"),
        _ => (1e9, "ns"),
    };
    format!("{} {unit}", figure(seconds * factor))
}

/// Seconds with their spread.
pub(crate) fn spread(values: &[f64]) -> String {
    let middle = super::results::median(values);
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    match values.len() {
        0 => "–".into(),
        1 => time(middle),
        _ => format!("{} ({}…{})", time(middle), time(low), time(high)),
    }
}

/// Bytes in megabytes.
pub(crate) fn megabytes(bytes: u64) -> String {
    format!("{} MB", figure(bytes as f64 / 1e6))
}

/// A ratio below one as a fraction of one: `1/300`.
pub(crate) fn ratio(x: f64) -> String {
    match x {
        x if x > 0.0 && x <= 0.1 => {
            let whole = (1.0 / x).round();
            match (whole * x - 1.0).abs() < 1e-12 {
                true => format!("1/{whole}"),
                false => format!("1/{}", figure(1.0 / x)),
            }
        }
        x => figure(x),
    }
}

/// A power of ten as in `1e-9`.
pub(crate) fn power(x: f64) -> String {
    format!("{x:.1e}").replace(".0e", "e")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let cases = [
            (0.0, "0"),
            (1.0, "1.00"),
            (12.34, "12.3"),
            (123.4, "123"),
            (0.0123, "0.0123"),
            (1e9, "1.0e9"),
        ];
        for (x, text) in cases {
            assert_eq!(figure(x), text);
        }
        assert_eq!(figure(f64::NAN), "–");
        assert_eq!(time(2.5e-8), "25.0 ns");
        assert_eq!(time(0.25), "250 ms");
        assert_eq!(ratio(1.0 / 320.0), "1/320");
        assert_eq!(ratio(1.0 / 20.0), "1/20");
        assert_eq!(ratio(0.5), "0.500");
        assert_eq!(power(1e-15), "1e-15");
    }
}
