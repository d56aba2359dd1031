//! The constraint manifold N in the adapted frame of a model, with its fields and the embedded 2-form Ω̄ (T3 §5).
//!
//! On the module V̄ of fields on N that annihilate the Pfaff system, with basis {Y_0, Y_i, ∂_i} and dual forms {dt, θ^i, dη^i},
//!
//! `Ω̄ = W̄_ij dη^j∧θ^i + (Z p_i - N_i) dt∧θ^i + ½ (Y_j p_i - Y_i p_j - S_ji) θ^j∧θ^i`,
//!
//! `Z = Y_0 + η^i Y_i`, `W̄_ij = ∂_i∂_jL̄ - (∂_jC^α_i) L_α`, `N_i = K^l_i p_l + Y_iL̄ + G^α_i L_α + P_i`, `S_ji = K^l_ji p_l +
//! G^α_ji L_α` with the components of `[Y_j, Y_i] = K^l_ji Y_l + G^α_ji X_α` (T3 (9), (11)).

use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::formulations::boltzmann_hamel::{Embedding, Terms};
use chetaev_mechanics::{Basis, Characteristics, Context, Manifold, System};
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Graph};

/// N with everything that Noether's theorem needs.
#[derive(Debug)]
pub struct Embedded<'a> {
    /// The system.
    pub system: &'a System,
    /// Fields, brackets and the chart (t, q, η).
    pub embedding: Embedding<'a>,
    /// L̄, p, L_α, K, G, P.
    pub terms: Terms,
    /// W̄, row by row.
    pub mass: Vec<Vec<Expr>>,
    /// `∂_i∂_jL̄`, row by row.
    pub hessian: Vec<Vec<Expr>>,
    /// `L_α ∂_jC^α_i` as `[i][j]`.
    pub turning: Vec<Vec<Expr>>,
    /// `Y_j p_i` as `[j][i]`.
    pub momenta_along: Vec<Vec<Expr>>,
    /// `Z p_i`.
    pub momenta_drift: Vec<Expr>,
    /// `K^l_ji p_l + G^α_ji L_α` as `[j][i]`.
    pub gyro: Vec<Vec<Expr>>,
    /// `K^l_0i p_l + G^α_0i L_α`.
    pub gyro_time: Vec<Expr>,
    /// `N_i`.
    pub right: Vec<Expr>,
}

/// `Σ a b`, terms with a factor zero left out.
pub(super) fn dot<'a>(
    g: &Graph,
    a: impl IntoIterator<Item = &'a Expr>,
    b: impl IntoIterator<Item = &'a Expr>,
) -> Expr {
    let pairs = a.into_iter().zip(b);
    let parts: Vec<Expr> = pairs
        .filter(|(&a, &b)| !g.is_zero(a) && !g.is_zero(b))
        .map(|(&a, &b)| g.mul(&[a, b]))
        .collect();
    g.add(&parts)
}

impl<'a> Embedded<'a> {
    /// The constraint manifold of the context's system.
    ///
    /// # Errors
    /// A sentence that says why it has no chart.
    pub fn of(cx: &Context<'a>) -> Result<Embedded<'a>, String> {
        Embedded::by(cx, None)
    }

    /// The constraint manifold in a chart of choice.
    ///
    /// # Errors
    /// A sentence that says why it has no chart.
    pub fn by(cx: &Context<'a>, chart: Option<Characteristics>) -> Result<Embedded<'a>, String> {
        let basis = Basis {
            characteristics: chart,
            ..basis(cx)
        };
        let embedding = Embedding::of(&basis).map_err(|problem| problem.to_string())?;
        let terms = embedding.terms();
        let mut embedded = Embedded {
            system: cx.system,
            hessian: embedding.chart.by_parameters(cx.system, &terms.momenta),
            turning: Vec::new(),
            mass: Vec::new(),
            momenta_along: Vec::new(),
            momenta_drift: embedding.chart.frozen_derivative(cx.system, &terms.momenta),
            gyro: Vec::new(),
            gyro_time: Vec::new(),
            right: Vec::new(),
            terms,
            embedding,
        };
        embedded.fill();
        Ok(embedded)
    }

    fn fill(&mut self) {
        let (g, k) = (&self.system.graph, self.k());
        let chart = &self.embedding.chart;
        let bends: Vec<Vec<Vec<Expr>>> = self
            .embedding
            .slopes
            .iter()
            .map(|row| chart.by_parameters(self.system, row))
            .collect();
        let turning = |i: usize, j: usize| {
            let column: Vec<Expr> = bends.iter().map(|bend| bend[i][j]).collect();
            dot(g, &self.terms.dependent_momenta, &column)
        };
        let turning: Vec<Vec<Expr>> = (0..k)
            .map(|i| (0..k).map(|j| turning(i, j)).collect())
            .collect();
        let mass = (0..k).map(|i| {
            (0..k)
                .map(|j| g.sub(self.hessian[i][j], turning[i][j]))
                .collect()
        });
        let mass = mass.collect();
        let fields: Vec<Vec<Expr>> = (0..k).map(|i| self.embedding.field(i)).collect();
        let momenta_along = fields
            .iter()
            .map(|field| chart.by_coordinates(self.system, &self.terms.momenta, field))
            .collect();
        let gyro: Vec<Vec<Expr>> = (0..k)
            .map(|j| {
                (0..k)
                    .map(|i| self.bracket_momentum(&fields[j], &fields[i]))
                    .collect()
            })
            .collect();
        let full: Vec<Expr> = (0..k).map(|i| self.full_momentum(i)).collect();
        let speeds = self.speeds();
        let gyro_time = (0..k)
            .map(|i| {
                let column: Vec<Expr> = gyro.iter().map(|row| row[i]).collect();
                g.sub(full[i], dot(g, &speeds, &column))
            })
            .collect();
        let right = (0..k)
            .map(|i| g.add(&[full[i], self.terms.slopes[i], self.terms.forces[i]]))
            .collect();
        (self.turning, self.mass, self.momenta_along) = (turning, mass, momenta_along);
        (self.gyro, self.gyro_time, self.right) = (gyro, gyro_time, right);
    }

    /// `K^l_i p_l + G^α_i L_α`.
    fn full_momentum(&self, i: usize) -> Expr {
        let g = &self.system.graph;
        g.add(&[
            dot(g, &self.terms.k[i], &self.terms.momenta),
            dot(g, &self.terms.g[i], &self.terms.dependent_momenta),
        ])
    }

    /// The bracket of two of the fields Y contracted with p and L_α.
    fn bracket_momentum(&self, a: &[Expr], b: &[Expr]) -> Expr {
        let (g, chart) = (&self.system.graph, &self.embedding.chart);
        let forward = chart.by_coordinates(self.system, b, a);
        let backward = chart.by_coordinates(self.system, a, b);
        let bracket: Vec<Expr> = forward
            .into_iter()
            .zip(backward)
            .map(|(x, y)| g.sub(x, y))
            .collect();
        let along = chart.frame.components(self.system, &bracket);
        let k: Vec<Expr> = chart.independent.iter().map(|&l| along[l]).collect();
        let rest: Vec<Expr> = chart
            .dependent
            .iter()
            .zip(&self.embedding.slopes)
            .map(|(&alpha, row)| g.sub(along[alpha], dot(g, row, &k)))
            .collect();
        g.add(&[
            dot(g, &k, &self.terms.momenta),
            dot(g, &rest, &self.terms.dependent_momenta),
        ])
    }

    /// k, the number of independent quasi-velocities.
    pub fn k(&self) -> usize {
        self.embedding.k()
    }

    /// The symbols η^i.
    pub fn speeds(&self) -> Vec<Expr> {
        let parameters = self.embedding.chart.parameters.iter();
        parameters.map(|p| p.value).collect()
    }

    /// What ties the symbols used here.
    pub fn manifold(&self) -> &Manifold {
        &self.embedding.chart.manifold
    }

    /// A function of (t, q, v) as a function on N.
    pub fn restricted(&self, e: Expr) -> Expr {
        let restricted = self.embedding.chart.restrict(self.system, &[e]);
        restricted.first().copied().unwrap_or(e)
    }

    /// `∂_i` of functions on N: one row for each function.
    pub fn by_speeds(&self, es: &[Expr]) -> Vec<Vec<Expr>> {
        self.embedding.chart.by_parameters(self.system, es)
    }

    /// `Z = Y_0 + η^i Y_i` of functions on N.
    pub fn drift(&self, es: &[Expr]) -> Vec<Expr> {
        self.embedding.chart.frozen_derivative(self.system, es)
    }

    /// `Y_i` of functions on N: one row for each i.
    pub fn along_fields(&self, es: &[Expr]) -> Vec<Vec<Expr>> {
        let chart = &self.embedding.chart;
        (0..self.k())
            .map(|i| chart.by_coordinates(self.system, es, &self.embedding.field(i)))
            .collect()
    }

    /// `Y_0` of functions on N.
    pub fn along_time(&self, es: &[Expr]) -> Vec<Expr> {
        let g = &self.system.graph;
        let speeds = self.speeds();
        let fields = self.along_fields(es);
        let drift = self.drift(es).into_iter().enumerate();
        drift
            .map(|(place, z)| {
                let column: Vec<Expr> = fields.iter().map(|row| row[place]).collect();
                g.sub(z, dot(g, &speeds, &column))
            })
            .collect()
    }

    /// `W̄⁻¹ b`.
    ///
    /// # Errors
    /// Where W̄ is singular by its form.
    pub fn solve(&self, right: &[Expr]) -> Result<Vec<Expr>, SolveError> {
        self.system.graph.solve(&self.mass.concat(), right)
    }

    /// The components of `Ȳ ⌟ Ω̄` along dt, θ^i and dη^i for `dt(Ȳ) = δ`, `θ^i(Ȳ) = χ^i`, `dη^i(Ȳ) = ζ^i`.
    pub fn contraction(
        &self,
        delta: Expr,
        chi: &[Expr],
        zeta: &[Expr],
    ) -> (Expr, Vec<Expr>, Vec<Expr>) {
        let (g, k) = (&self.system.graph, self.k());
        let push: Vec<Expr> = (0..k)
            .map(|i| g.sub(self.momenta_drift[i], self.right[i]))
            .collect();
        let time = g.neg(dot(g, &push, chi));
        let along = (0..k)
            .map(|i| {
                let turn: Vec<Expr> = (0..k)
                    .map(|j| {
                        g.add(&[
                            self.momenta_along[j][i],
                            g.neg(self.momenta_along[i][j]),
                            g.neg(self.gyro[j][i]),
                        ])
                    })
                    .collect();
                g.add(&[
                    dot(g, &self.mass[i], zeta),
                    g.mul(&[push[i], delta]),
                    dot(g, &turn, chi),
                ])
            })
            .collect();
        let speeds = (0..k)
            .map(|j| {
                let column: Vec<Expr> = self.mass.iter().map(|row| row[j]).collect();
                g.neg(dot(g, &column, chi))
            })
            .collect();
        (time, along, speeds)
    }
}
