//! Special values at which the motion found for all others says nothing: velocities chosen as independent are tied there, a root has
//! no value, letters fall together. They are put into the system, which is then searched as any other.

use super::ties::leaves_no_motion;
use super::{families_at, in_words, Special, Tie};
use crate::integrability::on_its_own;
use crate::noether::found::{in_families, is_independent};
use crate::noether::letters::Letters;
use crate::noether::motion::Motion;
use crate::noether::search::Integral;
use chetaev_mechanics::{Context, Prepared};
use chetaev_symbolic::Expr;

/// So many systems are searched.
const SYSTEMS: usize = 6;

/// Special values that were put into the system, and the families that were searched there, in words.
#[derive(Clone, Debug)]
pub struct PutIn {
    /// The values.
    pub tie: Tie,
    /// The families.
    pub families: Vec<String>,
}

/// What there is more of at these values, where this was searched, and what is left of those that have motions. As many families as for so
/// many values.
pub(super) fn put_in(
    cx: &Context<'_>,
    ties: Vec<Tie>,
    integrals: &[Integral],
    count: usize,
) -> (Vec<Special>, Vec<PutIn>, Vec<Tie>) {
    let (mut found, mut searched, mut left) = (Vec::new(), Vec::new(), Vec::new());
    for tie in ties.into_iter().filter(|tie| has_motions(cx, tie)) {
        let within = searched.len() < SYSTEMS && !cx.is_out_of_time();
        match within.then(|| at(cx, &tie, integrals, count)).flatten() {
            Some((families, integrals)) => {
                if !integrals.is_empty() {
                    let tie = tie.clone();
                    found.push(Special { tie, integrals });
                }
                searched.push(PutIn { tie, families });
            }
            None => left.push(tie),
        }
    }
    (found, searched, left)
}

/// Whether there are motions at special values: a mass matrix that is not singular, and a system as far as one can be made, as y'² = a x'² says
/// nothing definite at a = 0.
pub(super) fn has_motions(cx: &Context<'_>, tie: &Tie) -> bool {
    if leaves_no_motion(cx, tie) {
        return false;
    }
    let system = cx.system.with_parameters(&tie.pairs(&cx.system.graph));
    match &system {
        Some(system) => Prepared::new(system).is_ok_and(|own| own.left_out(system).is_ok()),
        None => cx.system.has_varying_masses(),
    }
}

/// The families searched in the system with the values, and the integrals there that are no functions of those for all values; `None`
/// where it is no system, or no search was made.
fn at(
    cx: &Context<'_>,
    tie: &Tie,
    integrals: &[Integral],
    count: usize,
) -> Option<(Vec<String>, Vec<Expr>)> {
    let g = &cx.system.graph;
    let pairs = tie.pairs(g);
    let system = cx.system.with_parameters(&pairs)?;
    let general = integrals.iter().map(|i| g.substitute(i.value, &pairs));
    let general: Vec<Expr> = general.collect();
    on_its_own(cx, &system, |own| further(own, &general, count))?
}

fn further(cx: &Context<'_>, general: &[Expr], count: usize) -> Option<(Vec<String>, Vec<Expr>)> {
    let motion = Motion::of(cx).ok()?;
    let letters = Letters::of(cx).without_stated();
    let letters = letters
        .without_zeros(&motion, cx.prover.points_seed())
        .ok()?;
    let families = families_at(cx, &letters, count);
    if families.is_empty() {
        return None;
    }
    let found = in_families(cx, &motion, &letters, &families).ok()?;
    let mut known = general.to_vec();
    let mut new = Vec::new();
    for integral in found {
        if is_independent(cx, &motion, &known, integral.value)? {
            known.push(integral.value);
            new.push(integral.shown);
        }
    }
    Some((families.iter().map(in_words).collect(), new))
}
