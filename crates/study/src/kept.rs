//! What a run kept by projection: which integrals, after how many steps, and by how large changes of the state.

use crate::study::Motion;
use chetaev_geometry::noether::search::Integral;
use chetaev_mechanics::words;
use chetaev_motion::keep::KeptReport;
use chetaev_symbolic::{Expr, Graph};

/// Integrals that a run was to keep, and what became of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kept<'a> {
    /// All that were found.
    found: &'a [Integral],
    /// Those that a projection can keep, in the order of what was counted of them.
    to_keep: &'a [Expr],
    /// What was counted along the run.
    pub(crate) report: &'a KeptReport,
}

impl Kept<'_> {
    /// What the run kept; `None` where it kept nothing by projection.
    pub(crate) fn of(motion: &Motion) -> Option<Kept<'_>> {
        let report = motion.evidence.run.kept.as_ref()?;
        Some(Kept {
            found: &motion.evidence.searched.integrals,
            to_keep: &motion.evidence.searched.to_keep,
            report,
        })
    }

    /// Each integral to keep with its number among those found, and after how many steps it has its value.
    pub(crate) fn integrals(&self) -> impl Iterator<Item = (usize, &Integral, u64)> + '_ {
        let place = |value: &Expr| self.found.iter().position(|own| own.value == *value);
        let all = self.to_keep.iter().zip(self.steps());
        all.filter_map(move |(value, steps)| {
            let place = place(value)?;
            Some((place + 1, &self.found[place], steps))
        })
    }

    /// After how many steps each has its value.
    fn steps(&self) -> impl Iterator<Item = u64> + '_ {
        let left_out = self.report.left_out.iter().map(|missed| missed.count);
        left_out.map(|count| {
            self.report.steps - (self.report.failed.count + count).min(self.report.steps)
        })
    }

    /// How often and how far the state was moved, a sentence.
    pub(crate) fn moves(&self) -> String {
        let report = self.report;
        match report.moved {
            0 => format!("none of {} steps had to be corrected", report.steps),
            moved => format!(
                "the state was moved after {moved} of {} steps, by {:.1e} at most, relative to 1 + its size (at t = {})",
                report.steps, report.largest.value, words::number(report.largest.t)
            ),
        }
    }
}

/// A formula, or the begin of a long one.
pub(crate) fn shortened(g: &Graph, value: Expr) -> String {
    let text = g.text(value);
    match text.chars().count() <= LONGEST {
        true => text,
        false => text.chars().take(LONGEST).chain(" …".chars()).collect(),
    }
}

/// Longer formulas do not belong into a sentence.
pub(crate) const LONGEST: usize = 120;
