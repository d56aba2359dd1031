//! Liouville's theorem: n independent integrals in involution integrate a Lagrangian motion of n coordinates by quadratures.
//!
//! With `p = ∂L/∂v`, `W = ∂p/∂v`, `C = ∂p/∂q` and `u = W⁻¹ ∂f/∂v`, `w = W⁻¹ ∂g/∂v` Poisson's bracket of functions of (q, v) is
//! `{f, g} = (∂f/∂q - Cᵀu)·w - u·(∂g/∂q - Cᵀw)`, as `∂f/∂p = u` and `∂f/∂q - Cᵀu` is the derivative by q at fixed p.

use crate::noether::found::found;
use chetaev_mechanics::words::counted;
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// Of more integrals no sets are formed.
const MOST: usize = 12;

/// What the theorem says.
pub(super) enum Involution {
    /// So many integrals are free of the time and in involution.
    Suffice(Box<Verdict>),
    /// How many more would do, in words.
    Missing(String),
}

/// What the integrals found give; `None` where there are too many, and for motions that are not those of a Lagrangian free of the time alone.
pub(super) fn in_involution(cx: &Context<'_>) -> Option<Involution> {
    let (system, g) = (cx.system, &cx.system.graph);
    let n = system.n();
    let has_others = system.forces.iter().any(|&e| !g.is_zero(e)) || !system.masses.is_empty();
    if !system.constraints.is_empty() || has_others || system.is_rheonomic(system.lagrangian) {
        return None;
    }
    let found = found(cx);
    let found = found.as_ref().as_ref().ok()?;
    let all = found.integrals.iter();
    let all: Vec<_> = all.filter(|i| !system.is_rheonomic(i.value)).collect();
    if all.len() > MOST {
        return None;
    }
    let slopes = all.iter().map(|i| Slopes::of(cx, i.value));
    let slopes: Vec<Slopes> = slopes.collect::<Option<_>>()?;
    let proof = |i: usize, j: usize| {
        let bracket = slopes[i].bracket(cx, &slopes[j]);
        let verdict = cx
            .prover
            .identity(system, &[bracket], &Manifold::default(), "");
        match verdict {
            Verdict::Proved(proof) => Some(proof),
            _ => None,
        }
    };
    let brackets: Vec<Vec<Option<Proof>>> = (0..all.len())
        .map(|i| (0..i).map(|j| proof(i, j)).collect())
        .collect();
    let sizes = (1..=n.min(all.len())).rev();
    let set = sizes.filter_map(|size| commuting(&brackets, size)).next();
    let set = set.unwrap_or_default();
    let texts: Vec<String> = set.iter().map(|&i| g.text(all[i].shown)).collect();
    if set.len() < n {
        let more = counted(n - set.len(), "integral more", "integrals more");
        let with = match texts.is_empty() {
            true => String::new(),
            false => format!(" with {}", texts.join(", ")),
        };
        return Some(Involution::Missing(format!(
            "by Liouville's theorem {more}, in involution{with}, would do"
        )));
    }
    let detail = format!(
        "{n} independent integrals are in involution, as many as there are coordinates, and L is free of the time (Liouville's theorem): {}",
        texts.join(", ")
    );
    let own = Verdict::Proved(Proof::exact("where the integrals are independent", detail));
    let pairs = set.iter().flat_map(|&i| set.iter().map(move |&j| (i, j)));
    let proofs = pairs.filter(|(i, j)| j < i);
    let proofs = proofs.filter_map(|(i, j)| brackets[i][j].clone());
    let verdict = proofs.map(Verdict::Proved).fold(own, Verdict::and);
    Some(Involution::Suffice(Box::new(verdict)))
}

/// The derivatives of a function of (q, v) by p at fixed q, and by q at fixed p.
struct Slopes {
    by_momenta: Vec<Expr>,
    by_places: Vec<Expr>,
}

impl Slopes {
    fn of(cx: &Context<'_>, e: Expr) -> Option<Slopes> {
        let (system, g) = (cx.system, &cx.system.graph);
        let places = system.coordinate_symbols();
        let velocities = system.velocity_symbols();
        let momenta = g.gradient(system.lagrangian, &velocities);
        let mass = cx.terms.mass_matrix.concat();
        let by_momenta = g.solve(&mass, &g.gradient(e, &velocities)).ok()?;
        let at_fixed = |(&slope, q): (&Expr, &Symbol)| {
            let own = momenta.iter().zip(&by_momenta);
            let parts = own.map(|(&p, &u)| g.mul(&[g.diff(p, *q), u]));
            g.sub(slope, g.add(&parts.collect::<Vec<Expr>>()))
        };
        let slopes = g.gradient(e, &places);
        Some(Slopes {
            by_places: slopes.iter().zip(&places).map(at_fixed).collect(),
            by_momenta,
        })
    }

    fn bracket(&self, cx: &Context<'_>, other: &Slopes) -> Expr {
        let g = &cx.system.graph;
        let dot = |a: &[Expr], b: &[Expr]| {
            let parts = a.iter().zip(b).map(|(&a, &b)| g.mul(&[a, b]));
            g.add(&parts.collect::<Vec<Expr>>())
        };
        g.sub(
            dot(&self.by_places, &other.by_momenta),
            dot(&self.by_momenta, &other.by_places),
        )
    }
}

/// So many whose brackets with each other all vanish; the first ones in the order of the list.
fn commuting(brackets: &[Vec<Option<Proof>>], count: usize) -> Option<Vec<usize>> {
    let commute = |i: usize, j: usize| brackets[i.max(j)][i.min(j)].is_some();
    let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
    for next in 0..brackets.len() {
        let with: Vec<Vec<usize>> = sets
            .iter()
            .filter(|set| set.iter().all(|&i| commute(i, next)))
            .map(|set| [&set[..], &[next]].concat())
            .collect();
        sets.extend(with);
        if let Some(found) = sets.iter().find(|set| set.len() == count) {
            return Some(found.clone());
        }
    }
    None
}
