//! Constraints of order two and more: Maggi's and Volterra's equations are the same, the lemmas between them hold, and the
//! slips that are made with them are found.
//!
//! Volterra's left sides are formed here once more, from the kinetic energy and the characteristics alone, with what may be
//! got wrong in them.

use super::{Expected, Kind, Trial};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::formulations::{formulation, DeriveError};
use chetaev_mechanics::order::determined::with_multipliers;
use chetaev_mechanics::order::lifting::derivative;
use chetaev_mechanics::sample::{self, Generator};
use chetaev_mechanics::{Characteristics, Context};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Graph, Node, Symbol, Verdict};
use std::time::Instant;

/// What is done to Volterra's equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slip {
    /// Nothing.
    None,
    /// 1 in the place of m.
    FactorDropped,
    /// ∂/∂π taken before the derivatives of order m are replaced, as if these were fixed and not P.
    NotFrozen,
    /// The first form as in Cartesian coordinates, without the slopes of the kinetic energy.
    WithoutSlopes,
}

/// All trials on a system with constraints of order two and more.
///
/// # Errors
/// [`DeriveError`] where no characteristics can be formed.
pub(crate) fn all(cx: &Context<'_>, seed: u64) -> Result<Vec<Trial>, DeriveError> {
    let mut trials = Vec::new();
    for claim in ["order.lifting", "order.characteristics"] {
        trials.push(claimed(cx, Kind::Other, "", claim));
    }
    let mut determined = claimed(cx, Kind::Other, "", "order.determined");
    if is_determined(cx, seed) {
        trials.push(determined);
        trials.extend(formulations(cx));
    } else {
        determined.expected = Expected::Refuted;
        trials.push(determined);
    }
    let c = basis(cx).characteristics()?;
    let maggi = c.contract(
        cx.system,
        &c.on_jet(cx.system, &cx.system.motion_left_sides()),
    );
    for slip in [
        Slip::None,
        Slip::FactorDropped,
        Slip::NotFrozen,
        Slip::WithoutSlopes,
    ] {
        trials.extend(compared(cx, &c, &maggi, slip, seed));
    }
    Ok(trials)
}

/// What is claimed of the formulations.
fn formulations(cx: &Context<'_>) -> Vec<Trial> {
    let mut trials = Vec::new();
    for name in ["maggi", "volterra-first", "volterra-second"] {
        let claim = format!("formulation.equivalent#{name}");
        trials.push(claimed(cx, Kind::Formulation, name, &claim));
    }
    for name in ["routh", "maggi", "volterra-first", "volterra-second"] {
        trials.push(closed(cx, name));
    }
    for name in ["volterra-first", "volterra-second"] {
        for special in ["", "-special"] {
            let claim = format!("formulation.identity#{name}{special}");
            trials.push(claimed(cx, Kind::Identity, name, &claim));
        }
    }
    trials
}

/// The rates of a formulation are functions of its own state: an unknown that only seems to be solved for is left in them.
fn closed(cx: &Context<'_>, name: &'static str) -> Trial {
    let start = Instant::now();
    let (system, g) = (cx.system, &cx.system.graph);
    let derived = formulation(name).map(|f| f.equations(&basis(cx)));
    let verdict = match derived {
        Some(Ok(equations)) => {
            let mut known = system.coordinate_symbols();
            known.extend(system.masses.iter().map(|m| m.symbol));
            known.extend(equations.variables.iter().map(|x| x.symbol));
            let free = |s: &Symbol| known.contains(s) || !system.moves(g.symbol_name(*s));
            let foreign: Vec<String> = g
                .symbols_in(&equations.rates())
                .into_iter()
                .filter(|s| {
                    !free(s) || g.symbol_name(*s).starts_with("lambda_") && !known.contains(s)
                })
                .map(|s| g.symbol_text(s))
                .collect();
            match foreign.is_empty() {
                true => Verdict::Proved(Proof::structural("everywhere", "no other symbols occur")),
                false => Verdict::undecided(format!("{} in the rates", foreign.join(", "))),
            }
        }
        Some(Err(problem)) => Verdict::undecided(problem.to_string()),
        None => Verdict::undecided("there is no such formulation"),
    };
    Trial {
        kind: Kind::Other,
        law: "its rates are functions of its state",
        formulation: name,
        about: String::new(),
        expected: Expected::Proved,
        verdict,
        seconds: start.elapsed().as_secs_f64(),
    }
}

/// Whether the equations seem to determine the derivatives of order m: the Jacobian has full rank in double precision at some
/// admissible jet with any multipliers. A homogeneous constraint of third order, for example, does not: with the third
/// derivatives it admits their multiples, and the equations of motion give the direction of the reaction only.
fn is_determined(cx: &Context<'_>, seed: u64) -> bool {
    let (g, determined) = (&cx.system.graph, with_multipliers(&basis(cx)));
    let size = determined.unknowns.len();
    let entries = g
        .jacobian(&determined.equations, &determined.unknowns)
        .concat();
    let mut generator = Generator::new(seed ^ 0x0dd5);
    (0..4).any(|draw| {
        let Some(mut point) = sample::admissible_point(cx.system, cx.terms, seed + draw) else {
            return false;
        };
        for symbol in g.symbols_in(&entries) {
            point
                .entry(symbol)
                .or_insert_with(|| generator.between(0.4, 1.3));
        }
        let values = g.evaluate_f64(&entries, &|s| point.get(&s).copied());
        values.is_ok_and(|values| is_regular(values, size))
    })
}

/// Gaussian elimination with partial pivoting meets no small pivot.
fn is_regular(mut a: Vec<f64>, n: usize) -> bool {
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let mut open: Vec<usize> = (0..n).collect();
    for column in 0..n {
        let size = |i: &usize| a[i * n + column].abs();
        let pivot = open
            .iter()
            .copied()
            .max_by(|i, j| size(i).total_cmp(&size(j)));
        let Some(pivot) = pivot.filter(|i| size(i) > 1e-9 * largest) else {
            return false;
        };
        open.retain(|&i| i != pivot);
        for &i in &open {
            let factor = a[i * n + column] / a[pivot * n + column];
            for j in column..n {
                a[i * n + j] -= factor * a[pivot * n + j];
            }
        }
    }
    true
}

fn claimed(cx: &Context<'_>, kind: Kind, formulation: &'static str, claim: &str) -> Trial {
    let start = Instant::now();
    let verdict = cx.finding(claim).verdict.clone();
    Trial {
        kind,
        law: match kind {
            Kind::Formulation => "its equations are those with multipliers",
            Kind::Identity => "its identity holds",
            _ => "what is said of the order of the constraints",
        },
        formulation,
        about: claim.to_string(),
        expected: Expected::Proved,
        verdict,
        seconds: start.elapsed().as_secs_f64(),
    }
}

/// Volterra's second form, or the first without slopes, against Maggi's equations; `None` where the slip changes nothing.
fn compared(
    cx: &Context<'_>,
    c: &Characteristics,
    maggi: &[Expr],
    slip: Slip,
    seed: u64,
) -> Option<Trial> {
    let start = Instant::now();
    let (system, g) = (cx.system, &cx.system.graph);
    let left = match slip {
        Slip::WithoutSlopes => first_form(cx, c),
        _ => second_form(cx, c, slip),
    };
    let forces = c.contract(system, &c.restrict(system, &system.forces));
    let residuals: Vec<Expr> = left
        .into_iter()
        .zip(forces)
        .zip(maggi)
        .map(|((left, force), &maggi)| g.add(&[left, g.neg(force), g.neg(maggi)]))
        .collect();
    if slip != Slip::None && !differs(cx, &residuals, seed) {
        return None;
    }
    let verdict: Verdict = cx
        .prover
        .identity(system, &residuals, &c.manifold, "on the jet");
    let (kind, expected) = match slip {
        Slip::None => (Kind::Pair, Expected::Proved),
        _ => (Kind::Mutant, Expected::Refuted),
    };
    Some(Trial {
        kind,
        law: match slip {
            Slip::None => "Volterra's equations, formed once more, are Maggi's",
            Slip::FactorDropped => "a dropped factor m is found",
            Slip::NotFrozen => "∂/∂π with P not frozen is found",
            Slip::WithoutSlopes => "missing slopes of the kinetic energy are found",
        },
        formulation: "",
        about: String::new(),
        expected,
        verdict,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// `m D ∂T̃/∂P_σ - ∂T̃/∂π_σ - Σ_s p_s ( m D B_sσ - ∂q^s(m)/∂π_σ )` with L in the place of T.
fn second_form(cx: &Context<'_>, c: &Characteristics, slip: Slip) -> Vec<Expr> {
    let (system, g, k) = (cx.system, &cx.system.graph, c.k());
    let m = g.integer(match slip {
        Slip::FactorDropped => 1,
        _ => i64::from(c.order),
    });
    let function = derivative(system, system.lagrangian, c.order - 1);
    let restricted = c.restrict(system, &[function]);
    let rates = c.total_derivative(system, &c.by_parameters(system, &restricted).concat());
    let lower: Vec<Symbol> = c.jets.iter().map(|c| c.q_symbol).collect();
    let slopes = match slip {
        Slip::NotFrozen => c.contract(system, &c.restrict(system, &g.gradient(function, &lower))),
        _ => c.by_quasi_coordinates(system, &restricted).concat(),
    };
    let momenta = c.restrict(
        system,
        &g.gradient(system.lagrangian, &system.velocity_symbols()),
    );
    let turning = c.total_derivative(system, &c.basis.concat());
    let bending = c.by_quasi_coordinates(system, &c.velocities);
    (0..k)
        .map(|sigma| {
            let mut parts = vec![g.mul(&[m, rates[sigma]]), g.neg(slopes[sigma])];
            for (s, &p) in momenta.iter().enumerate() {
                parts.push(g.neg(g.mul(&[m, p, turning[s * k + sigma]])));
                parts.push(g.mul(&[p, bending[s][sigma]]));
            }
            g.add(&parts)
        })
        .collect()
}

/// `D ∂T̃/∂P_σ - Σ_s p_s D B_sσ`, which is right in Cartesian coordinates only.
fn first_form(cx: &Context<'_>, c: &Characteristics) -> Vec<Expr> {
    let (system, g, k) = (cx.system, &cx.system.graph, c.k());
    let function = derivative(system, system.lagrangian, c.order - 1);
    let restricted = c.restrict(system, &[function]);
    let rates = c.total_derivative(system, &c.by_parameters(system, &restricted).concat());
    let momenta = c.restrict(
        system,
        &g.gradient(system.lagrangian, &system.velocity_symbols()),
    );
    let turning = c.total_derivative(system, &c.basis.concat());
    (0..k)
        .map(|sigma| {
            let mut parts = vec![rates[sigma]];
            for (s, &p) in momenta.iter().enumerate() {
                parts.push(g.neg(g.mul(&[p, turning[s * k + sigma]])));
            }
            g.add(&parts)
        })
        .collect()
}

/// Whether some residual is clearly not zero at an admissible jet in double precision.
fn differs(cx: &Context<'_>, residuals: &[Expr], seed: u64) -> bool {
    let g = &cx.system.graph;
    let mut generator = Generator::new(seed ^ 0x5a5a);
    (0..3).any(|draw| {
        let Some(mut point) = sample::admissible_point(cx.system, cx.terms, seed + draw) else {
            return false;
        };
        for symbol in g.symbols_in(residuals) {
            point
                .entry(symbol)
                .or_insert_with(|| generator.between(-1.3, 1.3));
        }
        residuals.iter().any(|&residual| {
            // Near a zero of a denominator the summands are large, and so is what rounding leaves of their sum.
            let all = [vec![residual], summands(g, residual)].concat();
            let values = g.evaluate_f64(&all, &|s| point.get(&s).copied());
            values.is_ok_and(|values| {
                let scale = values.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
                values[0].abs() > 1e-6 * scale && scale < 1e9
            })
        })
    })
}

fn summands(g: &Graph, e: Expr) -> Vec<Expr> {
    match g.node(e) {
        Node::Sum { terms, .. } => terms.iter().map(|(e, c)| g.scale(c, *e)).collect(),
        _ => vec![e],
    }
}
