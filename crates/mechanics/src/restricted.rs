//! By which independent velocities the restricted Lagrangian L̄ is regular.
//!
//! `∂²L̄/∂v^s∂v^u = (Bᵀ W B)_su + Σ_d p_d ∂²φ_d/∂v^s∂v^u` with `p = ∂L/∂v` (T1 §5.4). For constraints affine in the
//! velocities the second term is zero, and another choice of independent velocities changes the matrix by a congruence. For
//! others regularity depends on the choice: for L = x'²/2 on y' = x'² it is regular by x' and L̄ = y'/2 is not by y'.

use crate::characteristics::{Characteristics, CharacteristicsError};
use crate::sample::{self, Point};
use crate::selection::{eliminate, Selection};
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::Expr;

/// The characteristics for the momenta of L̄, and what else was looked at.
pub(crate) struct RegularChoice {
    /// By the first choice of independent velocities that is regular at a sampled state, else by the usual one.
    pub(crate) characteristics: Characteristics,
    /// Whether they are not those of the selection, by which the matrix was seen to be singular.
    pub(crate) is_another: bool,
    /// The other choices, where each of them was seen to be singular as the usual one is.
    pub(crate) singular: Vec<Characteristics>,
}

/// Choices of dependent velocities tried at most.
const CHOICES: usize = 20;
/// Entries below this share of their summands are rounding.
const CANCELLED: f64 = 1e-10;

/// The usual independent velocities where L̄ is regular by them, else the first others by which it is.
///
/// The choice is heuristic (one sampled state); that it is regular is the claim `model.restricted-hessian-regular`.
///
/// # Errors
/// [`CharacteristicsError`] where not even the usual dependent velocities can be solved for.
pub(crate) fn regular_choice(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
) -> Result<RegularChoice, CharacteristicsError> {
    let usual = Characteristics::independent_velocities(system, terms, selection)?;
    let mut choice = RegularChoice {
        characteristics: usual,
        is_another: false,
        singular: Vec::new(),
    };
    if selection.rows.iter().all(|&row| terms.affine[row]) {
        return Ok(choice);
    }
    // The state at which the usual velocities were selected.
    let Some(point) = sample::admissible_point(system, terms, 0x0c4e_7ae5) else {
        return Ok(choice);
    };
    if is_regular(system, terms, &choice.characteristics, &point) != Some(false) {
        return Ok(choice);
    }
    let mut others = other_choices(system, terms, selection, &point);
    match others
        .iter()
        .position(|other| is_regular(system, terms, other, &point) == Some(true))
    {
        Some(found) => {
            choice.characteristics = others.swap_remove(found);
            choice.is_another = true;
        }
        None => choice.singular = others,
    }
    Ok(choice)
}

/// `∂²L̄/∂v^s∂v^u` on the constraint manifold, k × k.
pub(crate) fn restricted_hessian(
    system: &System,
    characteristics: &Characteristics,
) -> Vec<Vec<Expr>> {
    let lagrangian = characteristics.restrict(system, &[system.lagrangian]);
    let momenta = characteristics.by_parameters(system, &lagrangian).concat();
    characteristics.by_parameters(system, &momenta)
}

/// Characteristics by other velocities than those of the selection for which the constraints can be solved at a state.
fn other_choices(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    point: &Point,
) -> Vec<Characteristics> {
    let (n, r) = (system.n(), selection.rows.len());
    let mut usual = selection.dependent.clone();
    usual.sort_unstable();
    combinations(n, r)
        .into_iter()
        .filter(|dependent| *dependent != usual)
        .filter(|dependent| can_be_solved(system, terms, &selection.rows, dependent, point))
        .filter_map(|dependent| {
            let other = Selection {
                rows: selection.rows.clone(),
                dependent,
            };
            Characteristics::independent_velocities(system, terms, &other).ok()
        })
        .take(CHOICES)
        .collect()
}

/// The subsets of r of the numbers below n, each ascending.
fn combinations(n: usize, r: usize) -> Vec<Vec<usize>> {
    let mut found: Vec<Vec<usize>> = vec![Vec::new()];
    for missing in (0..r).rev() {
        found = found
            .into_iter()
            .flat_map(|chosen| {
                let first = chosen.last().map_or(0, |last| last + 1);
                (first..n.saturating_sub(missing)).map(move |next| {
                    let mut longer = chosen.clone();
                    longer.push(next);
                    longer
                })
            })
            // More than enough, as a few of them cannot be solved for.
            .take(1000)
            .collect();
    }
    found
}

/// Whether ∂f/∂v by the dependent velocities has full rank at a state.
fn can_be_solved(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    dependent: &[usize],
    point: &Point,
) -> bool {
    let entries: Vec<Expr> = rows
        .iter()
        .flat_map(|&row| dependent.iter().map(move |&d| terms.jacobian[row][d]))
        .collect();
    let values = evaluated(system, &entries, point);
    values.is_some_and(|values| has_full_rank(values, rows.len()))
}

/// Whether ∂²L̄/∂v∂v is nonsingular at a state; `None` where it has no value.
fn is_regular(
    system: &System,
    terms: &MotionTerms,
    characteristics: &Characteristics,
    point: &Point,
) -> Option<bool> {
    let g = &system.graph;
    let (n, k) = (system.n(), characteristics.k());
    let slopes = g.gradient(system.lagrangian, &system.velocity_symbols());
    let metric = evaluated(system, &terms.mass_matrix.concat(), point)?;
    let basis = evaluated(system, &characteristics.basis.concat(), point)?;
    let mut parts = vec![Vec::new(); k * k];
    for i in 0..n {
        for j in 0..n {
            for (place, parts) in parts.iter_mut().enumerate() {
                let weight = basis[i * k + place / k] * basis[j * k + place % k];
                parts.push(weight * metric[i * n + j]);
            }
        }
    }
    for &d in &characteristics.dependent {
        let momentum = evaluated(system, &[slopes[d]], point)?[0];
        let second = characteristics.by_parameters(system, &characteristics.basis[d]);
        let values = evaluated(system, &second.concat(), point)?;
        for (parts, value) in parts.iter_mut().zip(values) {
            parts.push(momentum * value);
        }
    }
    Some(has_full_rank(parts.iter().map(|p| sum(p)).collect(), k))
}

/// A sum, zero where nothing but rounding is left of its summands.
fn sum(parts: &[f64]) -> f64 {
    let (sum, size) = parts
        .iter()
        .fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
    if sum.abs() < CANCELLED * size {
        0.0
    } else {
        sum
    }
}

fn has_full_rank(matrix: Vec<f64>, size: usize) -> bool {
    let chosen = eliminate(matrix, vec![vec![0; size]; size], size);
    chosen.rows.len() == size
}

fn evaluated(system: &System, es: &[Expr], point: &Point) -> Option<Vec<f64>> {
    let values = system
        .graph
        .evaluate_f64(es, &|s| point.get(&s).copied())
        .ok()?;
    values.iter().all(|x| x.is_finite()).then_some(values)
}

#[cfg(test)]
mod tests {
    use super::combinations;

    #[test]
    fn subsets() {
        assert_eq!(combinations(3, 2), [[0, 1], [0, 2], [1, 2]]);
        assert_eq!(combinations(2, 2), [[0, 1]]);
        assert_eq!(combinations(2, 0), [[0_usize; 0]]);
        assert_eq!(combinations(60, 30).len(), 1000);
    }
}
