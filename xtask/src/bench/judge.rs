//! Whether an answer is right.

use serde_json::Value;

/// Relative deviation of accelerations that counts as wrong.
const ACCELERATIONS: f64 = 1e-9;
/// The end of a trajectory that has lost the motion. What is better is an error shown beside the time.
const TRAJECTORY: f64 = 1e-2;
/// The same of the members of an ensemble, whose tolerance is 1e-9.
const ENSEMBLE: f64 = 1e-4;

/// The values to compare with: rows of numbers; none where there is no reference.
pub(crate) fn expected(
    reference: &Value,
    kind: &str,
    form: &str,
    count: u64,
) -> Option<Vec<Vec<f64>>> {
    let value = match (kind, form) {
        ("derive" | "rhs", "hand") => reference["hand_rates"].clone(),
        ("derive" | "rhs", _) => reference["accelerations"].clone(),
        ("trajectory", _) => Value::Array(vec![reference.get("end")?.clone()]),
        ("ensemble", _) => reference["ensemble"].get(count.to_string())?.clone(),
        _ => return None,
    };
    rows(&value)
}

/// Rows of numbers.
pub(crate) fn rows(value: &Value) -> Option<Vec<Vec<f64>>> {
    let row =
        |row: &Value| -> Option<Vec<f64>> { row.as_array()?.iter().map(Value::as_f64).collect() };
    value.as_array()?.iter().map(row).collect()
}

/// Largest deviation of an answer: |x − y| over max(1, |y|), of accelerations over the largest |y| of the row, too.
/// `None` where the shapes differ or a number is none; an answer may have fewer rows.
pub(crate) fn deviation(kind: &str, answer: &Value, expected: &[Vec<f64>]) -> Option<f64> {
    let found = rows(answer)?;
    if found.is_empty() || found.len() > expected.len() {
        return None;
    }
    let whole = matches!(kind, "derive" | "rhs");
    let mut worst = 0.0_f64;
    for (x, y) in found.iter().zip(expected) {
        if x.len() != y.len() {
            return None;
        }
        let largest = y.iter().fold(1.0_f64, |m, y| m.max(y.abs()));
        for (x, y) in x.iter().zip(y) {
            let scale = if whole { largest } else { y.abs().max(1.0) };
            let off = (x - y).abs() / scale;
            if !off.is_finite() {
                return None;
            }
            worst = worst.max(off);
        }
    }
    Some(worst)
}

/// The deviation up to which an answer is right.
pub(crate) fn limit(kind: &str) -> f64 {
    match kind {
        "trajectory" => TRAJECTORY,
        "ensemble" => ENSEMBLE,
        _ => ACCELERATIONS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn deviations_are_relative_to_what_is_large() {
        let expected = [vec![1000.0, 0.0], vec![1.0, 2.0]];
        let answer = json!([[1000.0, 0.5], [1.0, 2.0]]);
        assert_eq!(deviation("rhs", &answer, &expected), Some(0.5e-3));
        assert_eq!(deviation("trajectory", &answer, &expected), Some(0.5));
    }

    #[test]
    fn an_answer_of_another_shape_has_no_deviation() {
        let expected = [vec![1.0, 2.0]];
        for answer in [json!([[1.0]]), json!(null), json!([]), json!([[1.0, null]])] {
            assert_eq!(deviation("rhs", &answer, &expected), None, "{answer}");
        }
    }

    #[test]
    fn hand_and_derived_forms_have_their_own_references() {
        let reference = json!({"hand_rates": [[1.0]], "accelerations": [[2.0]], "end": [3.0]});
        let of = |kind: &str, form: &str| expected(&reference, kind, form, 0);
        assert_eq!(of("rhs", "hand"), Some(vec![vec![1.0]]));
        assert_eq!(of("derive", "text"), Some(vec![vec![2.0]]));
        assert_eq!(of("trajectory", "hand"), Some(vec![vec![3.0]]));
        assert_eq!(of("ensemble", "hand"), None);
    }
}
