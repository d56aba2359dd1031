//! How often each equation must be differentiated: the structure of a system of equations for derivatives of different
//! orders (J. D. Pryce, A simple structural analysis method for DAEs, BIT 41 (2001) 364–394).

/// Offsets of equations and unknowns: equation i, differentiated `equations[i]` times, contains derivatives up to
/// `unknowns[j]` of the unknown j, and these are as many as the equations can determine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Offsets {
    pub(super) equations: Vec<u32>,
    pub(super) unknowns: Vec<u32>,
}

/// The least offsets with `unknowns[j] ≥ least[j]` for a signature: `orders[i][j]` is the order of the highest derivative of
/// the unknown j in the equation i; `None` where the system is structurally singular.
pub(super) fn offsets(orders: &[Vec<Option<u32>>], least: &[u32]) -> Option<Offsets> {
    let partner = assignment(orders)?;
    let size = orders.len();
    let mut found = Offsets {
        equations: vec![0; size],
        unknowns: least.to_vec(),
    };
    // Each round raises an offset; more than so many rounds would mean that there are no least ones.
    for _ in 0..=size * size + size {
        for (row, &c) in orders.iter().zip(&found.equations) {
            for (d, order) in found.unknowns.iter_mut().zip(row) {
                if let Some(order) = order {
                    *d = (*d).max(order + c);
                }
            }
        }
        let mut changed = false;
        for (i, &j) in partner.iter().enumerate() {
            let c = found.unknowns[j] - orders[i][j]?;
            changed |= c != found.equations[i];
            found.equations[i] = c;
        }
        if !changed {
            return Some(found);
        }
    }
    None
}

/// The assignment of an unknown (a column, of which there may be more) to each equation (a row) with the largest sum of
/// orders, by successive shortest augmenting paths (Bellman and Ford); `None` where some equation is left without.
pub(crate) fn assignment(orders: &[Vec<Option<u32>>]) -> Option<Vec<usize>> {
    let size = orders.len();
    let columns = orders.first().map_or(0, Vec::len);
    let mut row_of: Vec<Option<usize>> = vec![None; columns];
    for start in 0..size {
        // gain[j]: the most that can be gained on a path from `start` that ends with the unknown j.
        let mut gain: Vec<Option<i64>> = vec![None; columns];
        let mut from: Vec<usize> = vec![start; columns];
        let mut open = vec![(start, 0i64)];
        for _ in 0..=size {
            let mut next: Vec<(usize, i64)> = Vec::new();
            for &(row, sum) in &open {
                for (j, order) in orders[row].iter().enumerate() {
                    let Some(order) = order else { continue };
                    let value = sum + i64::from(*order);
                    if gain[j].is_some_and(|known| known >= value) {
                        continue;
                    }
                    gain[j] = Some(value);
                    from[j] = row;
                    if let Some(owner) = row_of[j] {
                        let given_up = orders[owner][j].map_or(0, i64::from);
                        next.push((owner, value - given_up));
                    }
                }
            }
            open = next;
        }
        let free = (0..columns).filter(|&j| row_of[j].is_none());
        let mut end = free
            .max_by_key(|&j| gain[j])
            .filter(|&j| gain[j].is_some())?;
        loop {
            let row = from[end];
            let before = (0..columns).find(|&j| row_of[j] == Some(row));
            row_of[end] = Some(row);
            match before {
                Some(before) if row != start => end = before,
                _ => break,
            }
        }
    }
    let of_row = |row| row_of.iter().position(|&own| own == Some(row));
    (0..size).map(of_row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All assignments, for comparison.
    fn best(orders: &[Vec<Option<u32>>], row: usize, taken: &mut Vec<usize>) -> Option<u32> {
        if row == orders.len() {
            return Some(0);
        }
        let mut most = None;
        for j in 0..orders[row].len() {
            let Some(order) = orders[row][j].filter(|_| !taken.contains(&j)) else {
                continue;
            };
            taken.push(j);
            let rest = best(orders, row + 1, taken).map(|rest| rest + order);
            taken.pop();
            most = most.max(rest);
        }
        most
    }

    #[test]
    fn the_assignment_has_the_largest_sum() {
        let mut state = 1u64;
        let mut draw = |n: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(11);
            (state >> 33) % n
        };
        for _ in 0..2000 {
            let size = 1 + draw(5) as usize;
            let more = draw(3) as usize / 2;
            let orders: Vec<Vec<Option<u32>>> = (0..size)
                .map(|_| {
                    (0..size + more)
                        .map(|_| (draw(3) > 0).then(|| draw(5) as u32))
                        .collect()
                })
                .collect();
            let expected = best(&orders, 0, &mut Vec::new());
            let found = assignment(&orders);
            let sum = found.as_ref().map(|partner| {
                let mut seen = partner.clone();
                seen.sort_unstable();
                seen.dedup();
                assert_eq!(seen.len(), size);
                let pairs = partner.iter().enumerate();
                pairs
                    .map(|(i, &j)| orders[i][j].unwrap_or(100))
                    .sum::<u32>()
            });
            assert_eq!(sum, expected, "{orders:?}");
            if more > 0 {
                continue;
            }
            if let Some(offsets) = offsets(&orders, &vec![0; size]) {
                for (row, c) in orders.iter().zip(&offsets.equations) {
                    for (order, d) in row.iter().zip(&offsets.unknowns) {
                        assert!(order.is_none_or(|order| order + c <= *d), "{orders:?}");
                    }
                }
            } else {
                assert_eq!(expected, None, "{orders:?}");
            }
        }
    }

    /// The pendulum in Cartesian coordinates (Pryce 2001, example 1): the constraint is differentiated twice.
    #[test]
    fn the_pendulum() {
        let orders = [
            vec![Some(2), None, Some(0)],
            vec![None, Some(2), Some(0)],
            vec![Some(0), Some(0), None],
        ];
        let found = offsets(&orders, &[0, 0, 0]);
        let expected = Offsets {
            equations: vec![0, 0, 2],
            unknowns: vec![2, 2, 0],
        };
        assert_eq!(found, Some(expected));
    }
}
