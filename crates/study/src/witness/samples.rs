//! Functions of the state at equally spaced rows of the run.

use super::evidence;
use crate::motion_evidence::MotionEvidence;
use chetaev_mechanics::words::number;
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
/// That there are too few: fewer than `LEAST`, or so few that the motion bends between them.
pub(super) fn rows(cx: &Context<'_>) -> Result<(Arc<MotionEvidence>, usize), String> {
    let evidence = evidence(cx).ok_or("no motion was computed")?;
    let count = evidence.rows().asked();
    let is_equal = equally_spaced(&evidence.rows().times[..count]);
    if count <= LEAST || !is_equal {
        return Err(format!(
            "the motion has {} equally spaced output times; more than {LEAST} are needed",
            if is_equal { count } else { 0 }
        ));
    }
    if let Some(t) = unresolved(&evidence, count, cx.system.n()) {
        return Err(format!(
            "the {count} output times are too few to follow the motion near t = {}, where it changes within less than their distance; a larger `output` under [simulation] tells more",
            number(t)
        ));
    }
    Ok((evidence, count))
}

/// The part of the changes of a velocity that Simpson's rule over the accelerations may miss.
const MISSED: f64 = 1e-2;

/// Where equally spaced rows do not follow the motion, if they do not: the changes of a velocity from row to row are not the integrals of
/// its acceleration, as near the pericentre of a long ellipse. Integrals over such rows have no value that refinement would show.
fn unresolved(evidence: &MotionEvidence, count: usize, n: usize) -> Option<f64> {
    let run = evidence.rows();
    let (v, a) = (run.layout.v().start, run.layout.a().start);
    let length = run.times[count - 1] - run.times[0];
    let h = length / (count - 1) as f64;
    (0..n).find_map(|i| {
        let fastest = (0..count).fold(0.0, |m: f64, j| m.max(run.row(j)[v + i].abs()));
        let natural = run.scales.get(i).copied().unwrap_or(1.0) / length.abs();
        let accuracy = evidence.tolerance * (fastest + natural);
        let (mut missed, mut moved, mut worst) = (0.0, 0.0, (0.0, 0.0));
        for j in 1..count - 1 {
            let [before, here, after] = [j - 1, j, j + 1].map(|row| run.row(row));
            let parts = [before[a + i], 4.0 * here[a + i], after[a + i]].map(|x| h / 3.0 * x);
            let gap = (after[v + i] - before[v + i] - parts.iter().sum::<f64>()).abs();
            missed += (gap - accuracy).max(0.0);
            moved += parts.iter().map(|x| x.abs()).sum::<f64>();
            if gap > worst.0 {
                worst = (gap, run.times[j]);
            }
        }
        (missed > MISSED * moved).then_some(worst.1)
    })
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
