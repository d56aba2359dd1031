//! Sentences with measured numbers in them, compared.

/// How two sentences agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Agreement {
    /// Letter by letter.
    Same,
    /// In the words, and in the numbers up to the accuracy of their computation.
    Near,
    /// Not.
    Other,
}

/// Compares word by word; numbers agree up to `tolerance` relative to 1 + their size.
pub(super) fn compare(a: &str, b: &str, tolerance: f64) -> Agreement {
    if a == b {
        return Agreement::Same;
    }
    let (a, b) = (pieces(a), pieces(b));
    let agree = a.len() == b.len() && a.iter().zip(&b).all(|(x, y)| piece(x, y, tolerance));
    if agree {
        Agreement::Near
    } else {
        Agreement::Other
    }
}

/// Words, without the signs that close a sentence or a list.
fn pieces(text: &str) -> Vec<&str> {
    text.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':' | '(' | ')'))
        .filter(|word| !word.is_empty())
        .collect()
}

fn piece(a: &str, b: &str, tolerance: f64) -> bool {
    if a == b {
        return true;
    }
    // A whole number counts something.
    let measured = |text: &str| match text.contains(['.', 'e']) {
        true => text.parse::<f64>().ok().filter(|x| x.is_finite()),
        false => None,
    };
    match (measured(a), measured(b)) {
        (Some(x), Some(y)) => (x - y).abs() <= tolerance * (1.0 + x.abs()),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{compare, Agreement};

    #[test]
    fn numbers_agree_up_to_their_accuracy_and_words_letter_by_letter() {
        let with = |text: &str| {
            compare(
                "initial data completed from the constraints: y' = 0.3, 2 left",
                text,
                1e-6,
            )
        };
        let near = "initial data completed from the constraints: y' = 0.30000000000000004, 2 left";
        let far = "initial data completed from the constraints: y' = 0.31, 2 left";
        let name = "initial data completed from the constraints: x' = 0.3, 2 left";
        let count = "initial data completed from the constraints: y' = 0.3, 3 left";
        assert_eq!(with(near), Agreement::Near);
        assert_eq!(with(far), Agreement::Other);
        assert_eq!(with(name), Agreement::Other);
        assert_eq!(with(count), Agreement::Other);
    }
}
