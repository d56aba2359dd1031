//! `chaplygin.multiplier`: Chaplygin's reducing multiplier for two independent velocities (T1 §6.2; Chaplygin 1911).
//!
//! With `w^l' = a^l_1 q₁' + a^l_2 q₂'`, L free of the w, `c_l = ∂a^l_1/∂q₂ − ∂a^l_2/∂q₁` and the momenta θ_l of the dependent
//! velocities, linear in `P = ∂L*/∂v`, `θ_l = B^l_1 P_1 + B^l_2 P_2`, the time `dτ = N dt` makes the equations of motion
//! Hamilton's in (q, p, τ), p = N P, exactly where
//!
//! `∂ln N/∂q₁ = Σ B^l_2 c_l`, `∂ln N/∂q₂ = −Σ B^l_1 c_l` (T1 (27)).
//!
//! The mixed derivatives decide whether N exists; N is then searched as a product of powers of the factors that occur in the
//! denominators of (27) and in det G, G the matrix of L*.

use crate::words::{formula, readable};
use chetaev_mechanics::claims::formulation::{basis, derive, REFERENCE};
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::{ignorable, DeriveError};
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{Characteristics, Manifold};
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};

/// `chaplygin.multiplier`.
#[derive(Clone, Copy, Debug)]
pub struct Multiplier;

impl Claim for Multiplier {
    fn id(&self) -> &'static str {
        "chaplygin.multiplier"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Another time makes the reduced equations Hamilton's (Chaplygin's multiplier)"
    }

    fn explanation(&self) -> &'static str {
        "For two independent velocities q₁', q₂', constraints w' = a₁ q₁' + a₂ q₂' and a Lagrangian free of the w: the time τ with dτ = N dt \
         makes the equations of motion Lagrange's and Hamilton's for L* in (q, dq/dτ) exactly where ∂ln N/∂q₁ = Σ B₂ c, ∂ln N/∂q₂ = −Σ B₁ c, with the curvature c = ∂a₁/∂q₂ − ∂a₂/∂q₁ \
         and the momenta θ = B₁ P₁ + B₂ P₂ of the dependent velocities. `refuted`: the mixed derivatives disagree, at a state, so there is no multiplier. \
         `proved`: they agree; N is stated where it is a product of powers of the factors that occur, else it is a quadrature. Then N det G is the density of an \
         invariant measure in (q, v), and δ∫(T + U) N dt = 0 with ∫N dt fixed. It is another property than stationary action: a skate has the multiplier cos φ \
         in x and φ, a particle z' = y x' has 1/√(1 + y²)."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        [
            "model.accelerations-unique",
            "model.masses-of-time",
            "model.forces-absent",
            "model.chaplygin",
            "model.constraints-linear",
            "model.constraints-homogeneous",
            "model.constraints-scleronomic",
            "model.lagrangian-autonomous",
            "model.lagrangian-quadratic",
            "model.lagrangian-even",
        ]
        .map(String::from)
        .to_vec()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let r = cx.selection.rows.len();
        once_where(cx.terms.order == 1 && r > 0 && cx.system.n() == r + 2)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        Pair::new(cx).map_or_else(Finding::from, |pair| pair.decide(cx))
    }
}

/// A Chaplygin system of two independent velocities.
struct Pair {
    chart: Characteristics,
    /// q₁, q₂.
    coordinates: [Symbol; 2],
    /// `∂ln N/∂q₁`, `∂ln N/∂q₂`.
    form: [Expr; 2],
    /// det G.
    determinant: Expr,
}

impl Pair {
    fn new(cx: &Context<'_>) -> Result<Pair, DeriveError> {
        let (system, g) = (cx.system, &cx.system.graph);
        let chart = ignorable(&basis(cx))?;
        let coordinates = [0, 1].map(|s| system.coordinates[chart.independent[s]].q_symbol);
        let slopes: Vec<&Vec<Expr>> = chart.dependent.iter().map(|&d| &chart.basis[d]).collect();
        let curvature: Vec<Expr> = slopes
            .iter()
            .map(|a| g.sub(g.diff(a[0], coordinates[1]), g.diff(a[1], coordinates[0])))
            .collect();
        // W B: the rows of the dependent velocities are θ, and Bᵀ W B = G.
        let product = |i: usize, s: usize| {
            dot(
                g,
                &cx.terms.mass_matrix[i],
                chart.basis.iter().map(|row| &row[s]),
            )
        };
        let inertia: Vec<[Expr; 2]> = (0..system.n())
            .map(|i| [product(i, 0), product(i, 1)])
            .collect();
        let reduced = |u: usize, s: usize| {
            dot(
                g,
                chart.basis.iter().map(|row| &row[u]),
                inertia.iter().map(|row| &row[s]),
            )
        };
        let [a, b, d] = [reduced(0, 0), reduced(0, 1), reduced(1, 1)];
        let determinant = g.sub(g.mul(&[a, d]), g.mul(&[b, b]));
        let mut form = [Vec::new(), Vec::new()];
        for (&l, &c) in chart.dependent.iter().zip(&curvature) {
            let [x, y] = inertia[l];
            // (x, y) G⁻¹ = (B₁, B₂).
            let first = g.div(g.sub(g.mul(&[x, d]), g.mul(&[y, b])), determinant);
            let second = g.div(g.sub(g.mul(&[y, a]), g.mul(&[x, b])), determinant);
            form[0].push(g.mul(&[second, c]));
            form[1].push(g.neg(g.mul(&[first, c])));
        }
        let simple =
            |parts: &Vec<Expr>| simplify::simplify(g, g.add(parts), &simplify::Options::default());
        Ok(Pair {
            coordinates,
            form: [simple(&form[0]), simple(&form[1])],
            determinant: simplify::simplify(g, determinant, &simplify::Options::default()),
            chart,
        })
    }

    fn decide(&self, cx: &Context<'_>) -> Finding {
        let g = &cx.system.graph;
        let mixed = g.sub(
            g.diff(self.form[0], self.coordinates[1]),
            g.diff(self.form[1], self.coordinates[0]),
        );
        let on = "for all positions";
        let mut verdict = cx
            .prover
            .identity(cx.system, &[mixed], &Manifold::default(), on);
        match &verdict {
            Verdict::Proved(_) => self.multiplier(cx, verdict),
            Verdict::Refuted(_) => {
                verdict.prefix("there is no multiplier: the mixed derivatives of ln N disagree");
                Finding {
                    verdict,
                    formulas: self.stated(cx),
                }
            }
            _ => {
                verdict.prefix("the mixed derivatives of ln N");
                verdict.into()
            }
        }
    }

    /// `∂ln N/∂q`.
    fn stated(&self, cx: &Context<'_>) -> Vec<Formula> {
        let g = &cx.system.graph;
        let pairs = self.coordinates.iter().zip(self.form);
        pairs
            .filter_map(|(&q, e)| formula(cx, format!("∂ln N/∂{}", g.symbol_text(q)), None, e))
            .collect()
    }

    fn multiplier(&self, cx: &Context<'_>, closed: Verdict) -> Finding {
        let g = &cx.system.graph;
        let mut formulas = self.stated(cx);
        let Some(reducer) = self.integrated(cx) else {
            let mut verdict = closed;
            verdict.prefix("the mixed derivatives of ln N agree, so N exists near every position, by a quadrature; it is no product of powers of the factors that occur",
            );
            return Finding { verdict, formulas };
        };
        let mut verdict = closed.and(self.confirmed(cx, reducer));
        let shown = readable(cx, reducer).unwrap_or(reducer);
        verdict.prefix(&format!(
                "dτ = N dt with N = {} makes the equations of motion in {} and {} Hamilton's, and N det G is the density of an invariant measure",
                g.text(shown),
                g.symbol_text(self.coordinates[0]),
                g.symbol_text(self.coordinates[1])
            ),
        );
        formulas.extend(formula(cx, "the reducing multiplier N", None, shown));
        let measure = g.mul(&[shown, self.determinant]);
        formulas.extend(formula(
            cx,
            "density of the invariant measure in (q, v)",
            None,
            measure,
        ));
        Finding { verdict, formulas }
    }

    /// N as a product of powers of the factors that occur.
    fn integrated(&self, cx: &Context<'_>) -> Option<Expr> {
        let g = &cx.system.graph;
        let mut candidates: Vec<Expr> = Vec::new();
        for e in [self.form[0], self.form[1], self.determinant] {
            let e = crate::stationarity::by_sines(g, e);
            let parts = factored(g, e).map(|f| f.factors).unwrap_or_default();
            for (factor, _) in parts {
                if g.contains_any(factor, &self.coordinates) && !candidates.contains(&factor) {
                    candidates.push(factor);
                }
            }
        }
        let mut rest = self.form;
        let mut powers = Vec::new();
        for &factor in &candidates {
            if rest.iter().all(|&e| g.is_zero(e)) {
                break;
            }
            let exponent = self.exponent(cx, &rest, factor);
            let Some(exponent) = exponent else {
                continue;
            };
            let less = |s: usize| {
                let slope = g.div(g.diff(factor, self.coordinates[s]), factor);
                let left = g.sub(rest[s], g.mul(&[exponent, slope]));
                crate::stationarity::by_sines(g, left)
            };
            rest = [less(0), less(1)];
            powers.push(g.pow(factor, exponent));
        }
        rest.iter().all(|&e| g.is_zero(e)).then(|| g.mul(&powers))
    }

    /// The exponent of a factor in N: the residue of what is left where the factor vanishes, or the ratio of what is left to
    /// d ln(factor) where that is constant.
    fn exponent(&self, cx: &Context<'_>, rest: &[Expr; 2], factor: Expr) -> Option<Expr> {
        let g = &cx.system.graph;
        let is_constant = |e: Expr| !g.contains_any(e, &self.coordinates) && !g.is_zero(e);
        (0..2).find_map(|s| {
            let slope = g.diff(factor, self.coordinates[s]);
            if g.is_zero(slope) {
                return None;
            }
            let ratio = g.div(g.mul(&[rest[s], factor]), slope);
            let ratio = crate::stationarity::by_sines(g, ratio);
            if is_constant(ratio) {
                return Some(ratio);
            }
            let zero = [crate::stationarity::zero_of(g, factor, &self.coordinates)?];
            let has_pole = factored(g, ratio)?
                .factors
                .iter()
                .any(|&(pole, n)| n < 0 && g.is_zero(g.substitute(pole, &zero)));
            let residue = (!has_pole).then(|| g.substitute(ratio, &zero))?;
            let residue = crate::stationarity::by_sines(g, residue);
            is_constant(residue).then_some(residue)
        })
    }

    /// (27) for N, and `div(N det G · motion) = 0` in (q₁, q₂, v₁, v₂).
    fn confirmed(&self, cx: &Context<'_>, reducer: Expr) -> Verdict {
        let (system, g) = (cx.system, &cx.system.graph);
        let Ok(routh) = derive(cx, REFERENCE) else {
            return Verdict::undecided("the accelerations could not be derived");
        };
        let mut residuals: Vec<Expr> = (0..2)
            .map(|s| {
                let slope = g.diff(reducer, self.coordinates[s]);
                g.sub(slope, g.mul(&[reducer, self.form[s]]))
            })
            .collect();
        let density = g.mul(&[reducer, self.determinant]);
        let accelerations: Vec<Expr> = self
            .chart
            .independent
            .iter()
            .map(|&i| routh.accelerations[i])
            .collect();
        let accelerations = self.chart.restrict(system, &accelerations);
        let mut divergence = Vec::new();
        for (s, p) in self.chart.parameters.iter().enumerate() {
            divergence.push(g.mul(&[p.value, g.diff(density, self.coordinates[s])]));
            divergence.push(g.mul(&[density, g.diff(accelerations[s], p.symbol)]));
        }
        residuals.push(g.add(&divergence));
        let verdict = cx
            .prover
            .identity(system, &residuals, &self.chart.manifold, "where N > 0");
        match verdict {
            Verdict::Refuted(found) => Verdict::undecided(format!(
                "a multiplier was found that is none: {}",
                found.detail
            )),
            Verdict::Proved(proof) => Verdict::Proved(Proof { ..proof }),
            other => other,
        }
    }
}
