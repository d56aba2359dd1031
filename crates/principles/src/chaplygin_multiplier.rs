//! `chaplygin.multiplier`: Chaplygin's reducing multiplier (T1 §6.2; Chaplygin 1911), for any number k ≥ 2 of independent velocities.
//!
//! With `w^l' = Σ a^l_s q_s'`, L = ½ G v v + U free of the w on the constraints, `c^l_us = ∂a^l_s/∂q_u − ∂a^l_u/∂q_s` and the momenta
//! `θ_l = Σ Θ_lw v_w`, the equations of motion are `D P_s − ∂L*/∂q_s = Σ S_s,uw v_u v_w`, `S_s,uw = Σ_l c^l_us Θ_lw`. In the time
//! `dτ = N dt`, N = e^φ(q), Lagrange's equations for L* in (q, dq/dτ) differ from them by what vanishes for all v exactly where
//!
//! `½ (S_s,uw + S_s,wu) = φ_s G_uw − ½ (φ_u G_sw + φ_w G_su)`, φ_s = ∂φ/∂q_s.
//!
//! Contracted with `G⁻¹_uw` this gives `(k − 1) φ_s = Σ_l Σ_u c^l_us B^l_u`, `B^l = G⁻¹ Θ_l`, which is T1 (27) for k = 2, where the
//! condition is an identity. For k > 2 it is one more condition: up to a part of S that is skew in all three places and does no
//! work in the equations it says that the gyroscopic tensor is `T(Y, Z) = Z[φ] Y − Y[φ] Z`, the sufficient condition of
//! García-Naranjo 2019 (φ-simple systems). Then the form φ_s dq_s must be closed.
//!
//! N is then searched as a product of powers of the factors that occur in the denominators of φ_s and in det G, times the exponential
//! of a polynomial in the coordinates.

mod powers;

use self::powers::{integrated, Product};
use crate::words::{formula, listed, readable};
use chetaev_mechanics::claims::formulation::{basis, derive, REFERENCE};
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::{ignorable, DeriveError};
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{Characteristics, Manifold};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{simplify, Expr, Graph, Symbol, Verdict};
use std::sync::Arc;

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
        "For constraints w' = Σ a q' and a Lagrangian free of the w: the time τ with dτ = N dt, N a function of the independent coordinates, makes the equations of motion Lagrange's and Hamilton's \
         for L* in (q, dq/dτ). Two independent velocities: exactly where ∂ln N/∂q₁ = Σ B₂ c, ∂ln N/∂q₂ = −Σ B₁ c, with the curvature c = ∂a₁/∂q₂ − ∂a₂/∂q₁ \
         and the momenta θ = B₁ P₁ + B₂ P₂ of the dependent velocities. k > 2 of them: the gyroscopic terms Σ S v v must be φ_s Σ v P − P_s Σ v φ, φ = ln N, as in the φ-simple systems of García-Naranjo; the trace of that gives φ_s, \
         the rest is a condition more. `refuted`: that condition fails, or the mixed derivatives disagree, at a position, so there is no multiplier in this form; other momenta or other times are not refuted by it. \
         `proved`: they hold; N is stated where it is found as a product of powers of the factors that occur and of the exponential of a polynomial in the coordinates, on a real branch and with where it is positive, else it is a quadrature. Then N^(k−1) det G is the density of an \
         invariant measure in (q, v), and δ∫(T + U) N dt = 0 with ∫N dt fixed. It is another property than stationary action: a skate has the multiplier cos φ \
         in x and φ, a particle z' = y x' has 1/√(1 + y²), and loses it when a further coordinate moves freely beside it. \
         Example: for z' = y x' the momentum of z is θ = y P₁/(1 + y²) and c = 1, so ∂ln N/∂x = 0, ∂ln N/∂y = −y/(1 + y²): \
         at y = 1 that is −1/2, and dt = √2 dτ there."
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
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        // c is skew in the independent velocities.
        if cx.selection.rows.is_empty() || cx.system.n() < cx.selection.rows.len() + 2 {
            let detail = "N = 1: without two independent velocities of a constraint there is no curvature, and the equations are Lagrange's for L*";
            return Verdict::Proved(Proof::structural("for every motion", detail)).into();
        }
        Reduced::new(cx).map_or_else(Finding::from, |reduced| reduced.decide(cx))
    }
}

/// N where it was written down.
struct Written(Option<Product>);

/// Chaplygin's multiplier with what it is one of.
#[derive(Clone, Debug)]
pub struct Reducer {
    /// N, up to its sign.
    pub multiplier: Expr,
    /// L*, the Lagrangian in the independent coordinates and velocities.
    pub lagrangian: Expr,
    /// Which coordinates are independent, length k.
    pub independent: Vec<usize>,
    /// Their symbols.
    pub coordinates: Vec<Symbol>,
    /// The symbols of their velocities.
    pub speeds: Vec<Symbol>,
}

/// The multiplier that `chaplygin.multiplier` states; `None` where it is not written as a product.
pub fn reducer(cx: &Context<'_>) -> Option<Reducer> {
    if cx.selection.rows.is_empty() || cx.system.n() < cx.selection.rows.len() + 2 {
        return None;
    }
    let reduced = Reduced::new(cx).ok()?;
    if reduced.form.is_empty() {
        return None;
    }
    let multiplier = reduced.product(cx).0.as_ref()?.value;
    let parameters = reduced.chart.parameters.iter();
    Some(Reducer {
        multiplier,
        lagrangian: reduced.chart.restrict(cx.system, &[cx.system.lagrangian])[0],
        independent: reduced.chart.independent.clone(),
        coordinates: reduced.coordinates.clone(),
        speeds: parameters.map(|p| p.symbol).collect(),
    })
}

/// More independent velocities are too many for determinants in closed form.
const VELOCITIES: usize = 5;

/// A Chaplygin system.
struct Reduced {
    chart: Characteristics,
    /// The independent coordinates, length k.
    coordinates: Vec<Symbol>,
    /// φ_s = `∂ln N/∂q_s`.
    form: Vec<Expr>,
    /// What vanishes, besides the mixed derivatives, where N exists; nothing for k = 2.
    condition: Vec<(String, Expr)>,
    /// det G.
    determinant: Expr,
}

impl Reduced {
    fn new(cx: &Context<'_>) -> Result<Reduced, DeriveError> {
        let (system, g) = (cx.system, &cx.system.graph);
        let chart = ignorable(&basis(cx))?;
        let k = chart.k();
        let coordinates: Vec<Symbol> = chart
            .independent
            .iter()
            .map(|&i| system.coordinates[i].q_symbol)
            .collect();
        let columns: Vec<Vec<Expr>> = (0..k).map(|s| chart.column(s)).collect();
        // W B: the rows of the dependent velocities are Θ, and Bᵀ W B = G.
        let inertia: Vec<Vec<Expr>> = cx
            .terms
            .mass_matrix
            .iter()
            .map(|row| columns.iter().map(|column| dot(g, row, column)).collect())
            .collect();
        let metric: Vec<Vec<Expr>> = columns
            .iter()
            .map(|column| {
                let along = |s: usize| dot(g, column, inertia.iter().map(|row| &row[s]));
                (0..k).map(along).collect()
            })
            .collect();
        let simple = |e: Expr| simplify::simplify(g, e, &simplify::Options::default());
        let determinant = determinant(g, &metric);
        let gyroscopic = Gyroscopic::new(g, &chart, &coordinates, &inertia);
        let form: Vec<Expr> = match k <= VELOCITIES {
            true => gyroscopic.traces(g, &metric, determinant),
            false => Vec::new(),
        };
        let form: Vec<Expr> = form.into_iter().map(simple).collect();
        Ok(Reduced {
            condition: match k {
                3..=VELOCITIES => gyroscopic.rest(g, &metric, &form, &coordinates),
                _ => Vec::new(),
            },
            coordinates,
            form,
            determinant: simple(determinant),
            chart,
        })
    }

    fn k(&self) -> usize {
        self.coordinates.len()
    }

    fn decide(&self, cx: &Context<'_>) -> Finding {
        let (system, g, k) = (cx.system, &cx.system.graph, self.k());
        if k > VELOCITIES {
            return Verdict::undecided(format!(
                "{k} independent velocities; the multiplier is looked for up to {VELOCITIES}"
            ))
            .into();
        }
        let on = "for all positions";
        let free = Manifold::default();
        let mut verdict = cx.prover.named_identity(system, &self.condition, &free, on);
        if k > 2 && !matches!(verdict, Verdict::Proved(_)) {
            let sentence = match &verdict {
                Verdict::Refuted(_) => "no time dτ = N(q) dt makes the equations Lagrange's for L* in (q, dq/dτ): the gyroscopic terms are not φ_s Σ v P − P_s Σ v φ with φ = ln N (other forms of Hamilton's equations are not refuted by that)",
                _ => "the gyroscopic terms as φ_s Σ v P − P_s Σ v φ",
            };
            verdict.prefix(sentence);
            return Finding {
                verdict,
                formulas: self.stated(cx),
            };
        }
        let mixed: Vec<Expr> = (0..k)
            .flat_map(|s| (s + 1..k).map(move |u| (s, u)))
            .map(|(s, u)| {
                g.sub(
                    g.diff(self.form[s], self.coordinates[u]),
                    g.diff(self.form[u], self.coordinates[s]),
                )
            })
            .collect();
        let mixed: Vec<(String, Expr)> = mixed
            .into_iter()
            .map(|e| {
                (
                    "the difference of two mixed derivatives of ln N".to_string(),
                    e,
                )
            })
            .collect();
        let closed = cx.prover.named_identity(system, &mixed, &free, on);
        match &closed {
            Verdict::Proved(_) => self.multiplier(
                cx,
                match k {
                    2 => closed,
                    _ => verdict.and(closed),
                },
            ),
            Verdict::Refuted(_) => Finding {
                verdict: closed
                    .prefixed("there is no multiplier: the mixed derivatives of ln N disagree"),
                formulas: self.stated(cx),
            },
            _ => closed.prefixed("the mixed derivatives of ln N").into(),
        }
    }

    /// `∂ln N/∂q`.
    fn stated(&self, cx: &Context<'_>) -> Vec<Formula> {
        let g = &cx.system.graph;
        let pairs = self.coordinates.iter().zip(&self.form);
        pairs
            .filter_map(|(&q, &e)| formula(cx, format!("∂ln N/∂{}", g.symbol_text(q)), None, e))
            .collect()
    }

    fn multiplier(&self, cx: &Context<'_>, closed: Verdict) -> Finding {
        let g = &cx.system.graph;
        let mut formulas = self.stated(cx);
        let product = self.product(cx);
        let Some(found) = &product.0 else {
            let mut verdict = closed;
            verdict.prefix("the mixed derivatives of ln N agree, so N exists near every position where they are defined, by a quadrature; as a product of powers of the factors that were found and of the exponential of a polynomial in the coordinates it could not be written",
            );
            return Finding { verdict, formulas };
        };
        let reducer = found.value;
        let mut verdict = closed.and(self.confirmed(cx, reducer));
        let shown = readable(cx, reducer).unwrap_or(reducer);
        let names: Vec<String> = self.coordinates.iter().map(|&q| g.symbol_text(q)).collect();
        let power = match self.k() {
            2 => String::new(),
            k => format!("^{}", k - 1),
        };
        verdict.prefix(&format!(
                "dτ = N dt with N = {}{} makes the equations of motion in {} Hamilton's, and N{power} det G is the density of an invariant measure",
                g.text(shown),
                positive(&found.conditions),
                listed(&names)
            ),
        );
        formulas.extend(formula(cx, "the reducing multiplier N", None, shown));
        let measure = self.density(g, shown);
        formulas.extend(formula(
            cx,
            "density of the invariant measure in (q, v)",
            None,
            measure,
        ));
        Finding { verdict, formulas }
    }

    /// N as a product, looked for once.
    fn product(&self, cx: &Context<'_>) -> Arc<Written> {
        cx.shared(|cx| {
            let found = integrated(cx, &self.form, self.determinant, &self.coordinates);
            Written(found)
        })
    }

    /// `N^(k−1) det G`: dq dp of the tau-momenta p = N G v, over N.
    fn density(&self, g: &Graph, reducer: Expr) -> Expr {
        g.mul(&[g.powi(reducer, self.k() as i64 - 1), self.determinant])
    }

    /// (27) for N; Lagrange's equations in τ along the motion; and `div(density · motion) = 0` in (q, v).
    fn confirmed(&self, cx: &Context<'_>, reducer: Expr) -> Verdict {
        let (system, g) = (cx.system, &cx.system.graph);
        let Ok(routh) = derive(cx, REFERENCE) else {
            return Verdict::undecided("the accelerations could not be derived");
        };
        let independent = self.chart.independent.iter();
        let accelerations: Vec<Expr> = independent.map(|&i| routh.accelerations[i]).collect();
        let accelerations = self.chart.restrict(system, &accelerations);
        let slopes = g.gradient(reducer, &self.coordinates);
        let mut residuals: Vec<Expr> = slopes
            .iter()
            .zip(&self.form)
            .map(|(&slope, &own)| g.sub(slope, g.mul(&[reducer, own])))
            .collect();
        residuals.extend(self.in_tau(cx, reducer, &accelerations));
        let density = self.density(g, reducer);
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
            other => other,
        }
    }

    /// `d p_s/dτ − ∂L^/∂q_s` along the motion, times N: L^(q, u) = L*(q, N u), `p_s = ∂L^/∂u_s = N P_s`, and `∂L^/∂q_s` at fixed u
    /// is `∂L*/∂q_s + ∂N/∂q_s Σ u P`, u = v/N.
    fn in_tau(&self, cx: &Context<'_>, reducer: Expr, accelerations: &[Expr]) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let restricted = self.chart.restrict(system, &[system.lagrangian])[0];
        let speeds: Vec<Symbol> = self.chart.parameters.iter().map(|p| p.symbol).collect();
        let values: Vec<Expr> = self.chart.parameters.iter().map(|p| p.value).collect();
        let momenta = g.gradient(restricted, &speeds);
        let moved: Vec<Expr> = momenta.iter().map(|&p| g.mul(&[reducer, p])).collect();
        let rate = |s: Symbol| {
            let place = |list: &[Symbol]| list.iter().position(|&own| own == s);
            let of_position = place(&self.coordinates).map(|i| values[i]);
            of_position.or_else(|| place(&speeds).map(|i| accelerations[i]))
        };
        let moved = g.derive(&moved, &rate);
        let work = dot(g, &values, &momenta);
        self.coordinates
            .iter()
            .zip(moved)
            .map(|(&q, rate)| {
                let slope = g.mul(&[reducer, g.diff(restricted, q)]);
                g.sub(rate, g.add(&[slope, g.mul(&[g.diff(reducer, q), work])]))
            })
            .collect()
    }
}

/// Where N is positive, in words.
fn positive(conditions: &[String]) -> String {
    match conditions {
        [] => String::new(),
        some => format!(
            ", where {} (N > 0 is needed, and N is unique up to a constant factor: for a factor of the other sign its opposite serves),",
            listed(some)
        ),
    }
}

/// `S_s,uw = Σ_l c^l_us Θ_lw`.
struct Gyroscopic {
    /// c^l_us by l, then k × k.
    curvature: Vec<Vec<Vec<Expr>>>,
    /// Θ_l.
    momenta: Vec<Vec<Expr>>,
}

impl Gyroscopic {
    fn new(
        g: &Graph,
        chart: &Characteristics,
        coordinates: &[Symbol],
        inertia: &[Vec<Expr>],
    ) -> Gyroscopic {
        let of = |&d: &usize| -> Vec<Vec<Expr>> {
            let slopes = g.jacobian(&chart.basis[d], coordinates);
            let entry = |u: usize, s: usize| g.sub(slopes[s][u], slopes[u][s]);
            let k = coordinates.len();
            (0..k)
                .map(|u| (0..k).map(|s| entry(u, s)).collect())
                .collect()
        };
        Gyroscopic {
            curvature: chart.dependent.iter().map(of).collect(),
            momenta: chart
                .dependent
                .iter()
                .map(|&d| inertia[d].clone())
                .collect(),
        }
    }

    fn entry(&self, g: &Graph, (s, u, w): (usize, usize, usize)) -> Expr {
        let pairs = self.curvature.iter().zip(&self.momenta);
        let terms: Vec<Expr> = pairs
            .map(|(c, momentum)| g.mul(&[c[u][s], momentum[w]]))
            .collect();
        g.add(&terms)
    }

    /// `φ_s = Σ_l Σ_u c^l_us B^l_u/(k − 1)`, B^l by Cramer's rule.
    fn traces(&self, g: &Graph, metric: &[Vec<Expr>], whole: Expr) -> Vec<Expr> {
        let k = metric.len();
        let solved = |right: &Vec<Expr>| -> Vec<Expr> {
            let with = |column: usize| {
                let mut matrix = metric.to_vec();
                matrix
                    .iter_mut()
                    .zip(right)
                    .for_each(|(row, &e)| row[column] = e);
                g.div(determinant(g, &matrix), whole)
            };
            (0..k).map(with).collect()
        };
        let raised: Vec<Vec<Expr>> = self.momenta.iter().map(solved).collect();
        let share = g.integer(k as i64 - 1);
        (0..k)
            .map(|s| {
                let pairs = self.curvature.iter().zip(&raised);
                let terms: Vec<Expr> = pairs
                    .map(|(c, b)| dot(g, c.iter().map(|row| &row[s]), b))
                    .collect();
                g.div(g.add(&terms), share)
            })
            .collect()
    }

    /// `S_s,uw + S_s,wu − 2 φ_s G_uw + φ_u G_sw + φ_w G_su`, u ≤ w, each with its name.
    fn rest(
        &self,
        g: &Graph,
        metric: &[Vec<Expr>],
        form: &[Expr],
        coordinates: &[Symbol],
    ) -> Vec<(String, Expr)> {
        let k = metric.len();
        let name = |(s, u, w): (usize, usize, usize)| {
            let [s, u, w] = [s, u, w].map(|i| g.symbol_text(coordinates[i]));
            format!(
                "the coefficient of {u}' {w}' in the equation of {s}, Σ S v v less φ_s Σ v P − P_s Σ v φ (twice, symmetrized),"
            )
        };
        let places = (0..k).flat_map(|s| (0..k).flat_map(move |u| (u..k).map(move |w| (s, u, w))));
        places
            .map(|(s, u, w)| {
                let rest = g.add(&[
                    self.entry(g, (s, u, w)),
                    self.entry(g, (s, w, u)),
                    g.mul(&[g.integer(-2), form[s], metric[u][w]]),
                    g.mul(&[form[u], metric[s][w]]),
                    g.mul(&[form[w], metric[s][u]]),
                ]);
                (name((s, u, w)), rest)
            })
            .collect()
    }
}
