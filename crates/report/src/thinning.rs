//! Which samples of long records go into the page: those that a drawing can show.

/// The rows of a record to be drawn, at most about `limit`: of each block of rows those with the
/// smallest and the largest value of every curve, and one without a value if there is one, so that
/// neither a peak nor a gap is lost; `None` where all rows can stay.
pub(crate) fn rows(curves: &[&[f64]], limit: usize) -> Option<Vec<usize>> {
    let count = curves.iter().map(|c| c.len()).max().unwrap_or(0);
    if count <= limit || curves.is_empty() {
        return None;
    }
    let blocks = (limit / (2 * curves.len())).max(1);
    let mut kept = vec![0, count - 1];
    for block in 0..blocks {
        let rows = block * count / blocks..(block + 1) * count / blocks;
        for curve in curves {
            let known = |row: &usize| curve.get(*row).is_some_and(|v| v.is_finite());
            let by_value = |a: &usize, b: &usize| curve[*a].total_cmp(&curve[*b]);
            kept.extend(rows.clone().filter(known).min_by(by_value));
            kept.extend(rows.clone().filter(known).max_by(by_value));
            kept.extend(rows.clone().find(|row| !known(row)));
        }
    }
    kept.sort_unstable();
    kept.dedup();
    Some(kept)
}

/// Rows at equal distances, the first and the last among them.
pub(crate) fn even(count: usize, limit: usize) -> Vec<usize> {
    if count <= limit.max(2) {
        return (0..count).collect();
    }
    let parts = limit.max(2) - 1;
    (0..=parts).map(|i| i * (count - 1) / parts).collect()
}

/// The values at some rows.
pub(crate) fn pick(values: &[f64], rows: &[usize]) -> Vec<f64> {
    rows.iter()
        .map(|&row| values.get(row).copied().unwrap_or(f64::NAN))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{even, pick, rows};

    #[test]
    fn extremes_of_every_block_and_gaps_stay() {
        let mut curve: Vec<f64> = (0..10_000).map(|i| f64::from(i % 7)).collect();
        curve[1_234] = 99.0;
        curve[7_777] = -99.0;
        curve[5_000] = f64::NAN;
        let kept = rows(&[&curve], 1_000).unwrap_or_default();
        assert!(kept.len() <= 1_010, "{}", kept.len());
        for row in [0, 1_234, 5_000, 7_777, 9_999] {
            assert!(kept.contains(&row), "{row}");
        }
        // Every other block of 20 rows has a 0 and a 6.
        for block in kept.chunk_by(|a, b| a / 20 == b / 20) {
            let values = pick(&curve, block);
            let is_marked = [1_234, 7_777].iter().any(|row| row / 20 == block[0] / 20);
            assert!(is_marked || values.contains(&0.0) && values.contains(&6.0));
        }
    }

    #[test]
    fn a_short_record_stays_whole() {
        assert_eq!(rows(&[&[1.0, 2.0, 3.0]], 3), None);
        assert_eq!(rows(&[], 3), None);
        assert_eq!(even(3, 5), [0, 1, 2]);
        assert_eq!(even(101, 3), [0, 50, 100]);
    }
}
