//! Motions that begin near a steady one: a witness where theory decides nothing on stability, and no proof.

use crate::equilibria::Equilibria;
use crate::flow::{Coordinates, Flow};
use crate::multipliers::eigenvalues;
use crate::solution::solution;
use crate::variational::{Extended, Order, Variational};
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_stability::eigenvalues::{balanced, Balanced};
use chetaev_stability::guess::near;
use chetaev_stability::steady::numbers;

/// How far beside the motion the others begin, in one variable each: a part of its value, or of 1 where it is zero.
const NEAR: f64 = 1e-4;
/// How long is looked, in times of the slowest mode that moves.
const TIMES: f64 = 40.0;
/// Eigenvalues below this part of the matrix in suitable units may be zeros: those of a chain of length k are computed to the k-th root of rounding.
const ZERO: f64 = 1e-3;

/// What became of motions that begin near a steady one, for the values of parameters that the model states; `None` where they cannot be computed
/// or finite constraints tie the variables.
pub fn perturbed_runs(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    motion: &SteadyMotion,
) -> Option<String> {
    let values = system.parameter_values();
    // What is guessed is no steady motion: the one that it means is, in closed form or to rounding.
    let exact = near(system, terms, selection, (motion, &values)).ok();
    let known = exact.as_deref().unwrap_or(motion);
    let point = numbers(known, system, terms, (&selection.rows, &values)).ok()?;
    let which = (Coordinates::NotIgnorable, &point[..]);
    let flow = Flow::of_system(system, terms, selection, which).ok()?;
    let mut start = flow.state(&point).ok()?;
    if !flow.finite.is_empty() {
        return None;
    }
    if exact.is_none() {
        let mut equations = Equilibria::new(&flow, None).ok()?;
        start = solution(&mut equations, &start, 0.0).ok()?.0.unknowns;
    }
    let parameters: Vec<f64> = flow.parameters.iter().map(|own| own.1).collect();
    let slopes = flow.slopes(&start, &parameters)?;
    let found = eigenvalues(&slopes).ok()?;
    let Balanced { matrix, unit, .. } = balanced(&slopes);
    let size = matrix.norm() * unit;
    let moving = found.iter().map(|l| l.norm());
    let slowest = moving.filter(|own| *own > ZERO * size);
    let slowest = slowest.fold(f64::INFINITY, f64::min);
    let end = match (slowest.is_finite(), size > 0.0) {
        (true, _) => TIMES / slowest,
        // Nothing but zeros: motions run away, if at all, in times of the terms that couple them.
        (false, true) => TIMES / size,
        (false, false) => TIMES,
    };
    let mut runs = Variational::new(&flow, Vec::new(), Order::Motion).ok()?;
    let sizes = start.iter().map(|x| if *x == 0.0 { 1.0 } else { x.abs() });
    let sizes: Vec<f64> = sizes.collect();
    let mut farthest: Option<(f64, usize, usize)> = None;
    for moved in 0..flow.n() {
        for sign in [1.0, -1.0] {
            let mut state = start.clone();
            state[moved] += sign * NEAR * sizes[moved];
            let last = runs.end((0.0, end), &Extended::start(&state, &runs));
            // The equations may end there, or what they contain is not smooth.
            let Ok(last) = last else {
                return Some(format!(
                    "a numerical witness: a motion that begins {NEAR:e} of its size beside it in {} could not be computed up to t = {end:.3}",
                    flow.names[moved]
                ));
            };
            let apart = last.state.iter().zip(&start).zip(&sizes);
            let apart = apart.map(|((a, b), size)| (a - b).abs() / size);
            for (place, apart) in apart.enumerate() {
                if farthest.is_none_or(|known| apart > known.0) {
                    farthest = Some((apart, moved, place));
                }
            }
        }
    }
    let (apart, moved, place) = farthest?;
    let exponent = (apart / NEAR).ln() / end;
    Some(format!(
        "a numerical witness: of {} motions that begin {NEAR:e} beside it in one variable each, in parts of its values, the farthest is {apart:.2e} away in {} at t = {end:.3} (moved in {}), which is {:.0} times as far, a Lyapunov exponent of {exponent:.2e} over this time",
        2 * flow.n(),
        flow.names[place],
        flow.names[moved],
        apart / NEAR
    ))
}
