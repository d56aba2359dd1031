//! Which components of constraints there are: none that is empty, or lies in another one.

use super::Stratum;
use crate::characteristics::Characteristics;
use crate::claims::Prepared;
use crate::prover::Prover;
use crate::system::System;
use chetaev_symbolic::{Expr, Verdict};

/// The components of constraints that are products or functions of simpler ones, each with its terms. With `x' + y' = 0` the
/// constraint `(x' + y')(z' + 1) = 0` says nothing more, and `z' = -1` is no component. None where there are no such constraints, or too
/// many components.
pub fn distinct(system: &System, prover: &Prover) -> Vec<(Stratum, Prepared)> {
    let all = system.components().into_iter();
    let mut all: Vec<(Stratum, Prepared)> = all
        .filter_map(|on| {
            let prepared = prepared(&on)?;
            Some((on, prepared))
        })
        .collect();
    let many = all.len();
    let lies_in = |i: usize, j: usize| lies_in(prover, &all[i], &all[j].1);
    let is_within = |i: usize, j: usize| i != j && lies_in(i, j) && (j < i || !lies_in(j, i));
    let is_own = |i: usize| !(0..many).any(|j| is_within(i, j));
    let mut own = (0..many).map(is_own).collect::<Vec<bool>>().into_iter();
    all.retain(|_| own.next().unwrap_or(false));
    all
}

/// The place of the component on which a motion starts: of the only one whose factors vanish there, else the first.
pub fn of_start(
    all: &[(Stratum, Prepared)],
    vanish_at_start: impl Fn(&[Expr]) -> Option<bool>,
) -> usize {
    let contains = |on: &Stratum| vanish_at_start(&on.equations) == Some(true);
    let places = (0..all.len()).filter(|&place| contains(&all[place].0));
    match places.collect::<Vec<usize>>().as_slice() {
        &[place] => place,
        _ => 0,
    }
}

/// `None` where no velocities are admissible.
fn prepared(on: &Stratum) -> Option<Prepared> {
    let prepared = Prepared::new(&on.system).ok()?;
    prepared.left_out(&on.system).ok()?;
    Some(prepared)
}

/// Whether all constraints of another component hold on one.
fn lies_in(prover: &Prover, (on, own): &(Stratum, Prepared), outer: &Prepared) -> bool {
    let chart = Characteristics::independent_velocities(&on.system, &own.terms, &own.selection);
    let Ok(chart) = chart else {
        return false;
    };
    let others = &outer.terms.constraints;
    let verdict = prover.identity(&on.system, others, &chart.manifold, "");
    matches!(verdict, Verdict::Proved(_))
}
