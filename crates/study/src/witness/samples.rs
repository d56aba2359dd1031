//! Functions of the state at equally spaced rows of the run.

use super::evidence;
use crate::motion_evidence::MotionEvidence;
use chetaev_mechanics::Context;
use chetaev_motion::observe::Observer;
use chetaev_symbolic::Expr;
use std::sync::Arc;

/// Fewer intervals show nothing.
pub(super) const LEAST: usize = 48;

/// Groups of functions at equally spaced times.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub(super) times: Vec<f64>,
    /// By group, then by row.
    groups: Vec<Vec<Vec<f64>>>,
}

impl Samples {
    /// Values of groups of expressions in t, q, q', q'' at the rows of the computed motion.
    pub(super) fn new(cx: &Context<'_>, groups: &[&[Expr]]) -> Result<Samples, String> {
        let (evidence, count) = rows(cx)?;
        let run = evidence.rows();
        let times = run.times[..count].to_vec();
        let all = groups.concat();
        let mut observer = Observer::new(cx.system, cx.terms, &evidence.binding, &all)
            .map_err(|problem| problem.to_string())?;
        let rows: Vec<Vec<f64>> = (0..count)
            .map(|j| observer.at(times[j], run.row(j)))
            .collect();
        let mut start = 0;
        let groups = groups
            .iter()
            .map(|group| {
                let range = start..start + group.len();
                start = range.end;
                rows.iter().map(|row| row[range.clone()].to_vec()).collect()
            })
            .collect();
        Ok(Samples { times, groups })
    }

    /// A group at a row.
    pub(super) fn at(&self, group: usize, row: usize) -> &[f64] {
        &self.groups[group][row]
    }

    /// Adds a group, times a number at each row, to another of the same width.
    pub(super) fn add(&mut self, to: usize, from: usize, weight: &dyn Fn(usize) -> f64) {
        let moved = self.groups[from].clone();
        for (row, (values, moved)) in self.groups[to].iter_mut().zip(moved).enumerate() {
            let weight = weight(row);
            for (x, by) in values.iter_mut().zip(moved) {
                *x += weight * by;
            }
        }
    }

    /// How many intervals of `multiple` rows there are, as rows.
    pub(super) fn intervals(&self, multiple: usize) -> usize {
        (self.times.len() - 1) / multiple * multiple
    }
}

/// The motion and how many of [`MotionEvidence::rows`] there are, which are equally spaced.
///
/// # Errors
/// That there are too few.
pub(super) fn rows(cx: &Context<'_>) -> Result<(Arc<MotionEvidence>, usize), String> {
    let evidence = evidence(cx).ok_or("no motion was computed")?;
    let count = evidence.rows().asked();
    let is_equal = equally_spaced(&evidence.rows().times[..count]);
    match count > LEAST && is_equal {
        true => Ok((evidence, count)),
        false => Err(format!(
            "the motion has {} equally spaced output times; more than {LEAST} are needed",
            if is_equal { count } else { 0 }
        )),
    }
}

/// Whether the steps differ by rounding alone.
fn equally_spaced(times: &[f64]) -> bool {
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return false;
    };
    let step = (last - first) / (times.len().max(2) - 1) as f64;
    step != 0.0
        && times
            .windows(2)
            .all(|pair| ((pair[1] - pair[0]) - step).abs() <= 1e-6 * step.abs())
}
