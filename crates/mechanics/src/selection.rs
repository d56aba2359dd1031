//! Which constraints are independent, and which velocities to solve them for.

use crate::characteristics::CharacteristicsError;
use crate::components;
use crate::constraint::ConstraintKind;
use crate::sample;
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words::quoted;
use chetaev_symbolic::{Expr, Symbol};

/// The rows of independent constraints and the dependent velocities to solve them for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Independent rows of the terms.
    pub rows: Vec<usize>,
    /// Dependent velocities, one per row.
    pub dependent: Vec<usize>,
}

impl Selection {
    /// No constraint.
    pub fn none() -> Selection {
        Selection {
            rows: Vec::new(),
            dependent: Vec::new(),
        }
    }

    /// The independent velocities of n coordinates.
    pub fn independent(&self, n: usize) -> Vec<usize> {
        (0..n).filter(|i| !self.dependent.contains(i)).collect()
    }
}

/// What it costs to solve for a velocity that does not occur in every factor of a constraint: more than a root.
const LOSES_COMPONENTS: usize = 200_000;

/// Chooses independent rows and dependent velocities: those the user wants independent stay so where possible, then
/// pivots that are numbers are preferred to parameters, parameters to functions of the state.
///
/// The choice is heuristic (one sampled state, of a motion where highest derivatives are restricted nonlinearly); that it is regular is a
/// claim of its own.
///
/// # Errors
/// [`CharacteristicsError::NoAdmissibleState`].
pub fn select(system: &System, terms: &MotionTerms) -> Result<Selection, CharacteristicsError> {
    let n = system.n();
    let r = terms.constraints.len();
    if r == 0 {
        return Ok(Selection::none());
    }
    let point = sample::admissible_point(system, terms, sample::SEED).ok_or_else(|| {
        CharacteristicsError::NoAdmissibleState {
            names: constraint_names(system, terms),
        }
    })?;
    let point = sample::on_motion(system, terms, &point).unwrap_or(point);
    let values_at = |point: &sample::Point| {
        let values = system
            .graph
            .evaluate_f64(&terms.jacobian.concat(), &|s| point.get(&s).copied());
        values.unwrap_or_else(|_| vec![f64::NAN; n * r])
    };
    let cost: Vec<Vec<usize>> = (0..r)
        .map(|row| {
            let factors = components::factors_of(system, terms, row);
            let lacks = |v: Symbol| move |&factor: &Expr| !system.graph.contains_any(factor, &[v]);
            let cost = |j: usize| {
                let highest = terms.jets[j].v_symbol;
                let lost = match factors.iter().any(lacks(highest)) {
                    true => LOSES_COMPONENTS,
                    false => 0,
                };
                lost + cost_of(system, terms.jacobian[row][j], j, Some(highest))
            };
            (0..n).map(cost).collect()
        })
        .collect();
    let constraints = terms.constraint_index.iter();
    let mut all = constraints.map(|&l| &system.constraints[l]);
    let least = if all.all(|constraint| constraint.is_affine_in_velocities()) {
        AT_EXACT_STATES
    } else {
        AT_SOLVED_STATES
    };
    let values = values_at(&point);
    let chosen = eliminate_beyond(least, values.clone(), cost.clone(), n);
    let is_finite = |row: usize| {
        system.constraints[terms.constraint_index[row]].kind == ConstraintKind::Holonomic
    };
    let finite = |own: &Selection| own.rows.iter().filter(|&&row| is_finite(row)).count();
    if finite(&chosen) == (0..r).filter(|&row| is_finite(row)).count() {
        return Ok(chosen);
    }
    // Of a finite constraint and its derivative, both stated, the finite one says more.
    let behind = |(row, line): (usize, Vec<usize>)| -> Vec<usize> {
        let more = if is_finite(row) { 0 } else { BEHIND_FINITE };
        line.into_iter().map(|own| own + more).collect()
    };
    let cost: Vec<Vec<usize>> = cost.into_iter().enumerate().map(behind).collect();
    let other = eliminate_beyond(least, values, cost, n);
    Ok(if finite(&other) > finite(&chosen) {
        other
    } else {
        chosen
    })
}

/// More than any entry of a finite constraint costs.
const BEHIND_FINITE: usize = 100_000_000;

fn constraint_names(system: &System, terms: &MotionTerms) -> String {
    quoted(
        terms
            .constraint_index
            .iter()
            .map(|&l| &system.constraints[l].name),
    )
}

pub(crate) fn pivot_cost(system: &System, entry: Expr, j: usize) -> usize {
    let own = system.coordinates.get(j).map(|c| c.v_symbol);
    cost_of(system, entry, j, own)
}

fn cost_of(system: &System, entry: Expr, j: usize, own: Option<Symbol>) -> usize {
    let g = &system.graph;
    let wanted = if system.independent.contains(&j) {
        1_000_000
    } else {
        0
    };
    let size = g.reachable(&[entry]).len().min(900);
    let kind = if g.as_number(entry).is_some() {
        0
    } else if g.is_free_of(entry, &|s| {
        system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t"
    }) {
        1000
    } else {
        2000
    };
    // A velocity in which the constraint is affine can always be solved for; a root may not be real.
    let nonlinear = if own.is_some_and(|v| g.contains_any(entry, &[v])) {
        100_000
    } else {
        0
    };
    wanted + nonlinear + kind + size
}

/// The part of its terms below which a pivot counts as zero where the state is known to some eleven digits, as one at which
/// constraints nonlinear in the velocities were solved.
const AT_SOLVED_STATES: f64 = 1e-9;
/// The same at states that are exact: what rounding leaves of terms that cancel.
const AT_EXACT_STATES: f64 = 1e-13;

/// Gaussian elimination that takes, among pivots that are not small, the cheapest, at a state that is known to some digits.
pub(crate) fn eliminate(a: Vec<f64>, cost: Vec<Vec<usize>>, n: usize) -> Selection {
    eliminate_beyond(AT_SOLVED_STATES, a, cost, n)
}

/// The same where pivots up to the part `least` of the terms of which they were made count as zero, whatever the units of rows and
/// columns.
fn eliminate_beyond(least: f64, mut a: Vec<f64>, cost: Vec<Vec<usize>>, n: usize) -> Selection {
    let r = cost.len();
    let mut sizes: Vec<f64> = a.iter().map(|x| x.abs()).collect();
    let largest = |row: &[f64]| row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let scale: Vec<f64> = a.chunks(n.max(1)).map(largest).collect();
    let mut selection = Selection {
        rows: Vec::new(),
        dependent: Vec::new(),
    };
    let mut open: Vec<usize> = (0..r).collect();
    while !open.is_empty() {
        let mut best: Option<(usize, usize, usize)> = None;
        for &i in &open {
            for j in (0..n).filter(|j| !selection.dependent.contains(j)) {
                let entry = a[i * n + j].abs();
                let usable = entry > least * sizes[i * n + j] && entry > least * scale[i];
                let better = best.is_none_or(|(c, _, _)| cost[i][j] < c);
                if usable && better {
                    best = Some((cost[i][j], i, j));
                }
            }
        }
        let Some((_, i, j)) = best else { break };
        selection.rows.push(i);
        selection.dependent.push(j);
        open.retain(|&o| o != i);
        for &o in &open {
            let factor = a[o * n + j] / a[i * n + j];
            for c in 0..n {
                a[o * n + c] -= factor * a[i * n + c];
                sizes[o * n + c] += factor.abs() * sizes[i * n + c];
            }
            a[o * n + j] = 0.0;
        }
    }
    sort_pairs(&mut selection);
    selection
}

/// Rows ascending, so that output follows the order of the model.
fn sort_pairs(selection: &mut Selection) {
    let mut pairs: Vec<(usize, usize)> = selection
        .rows
        .iter()
        .copied()
        .zip(selection.dependent.iter().copied())
        .collect();
    pairs.sort_unstable();
    (selection.rows, selection.dependent) = pairs.into_iter().unzip();
}
