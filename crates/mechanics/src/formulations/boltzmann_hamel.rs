//! The embedded equations in a moving frame: Boltzmann–Hamel, for linear and nonlinear constraints.
//!
//! On the constraint manifold `η^α = F^α(t, q, η^i)`, with `C^α_i = ∂_iF^α`, `Y_0 = X_0 + (F^α - C^α_i η^i) X_α`,
//! `Y_i = X_i + C^α_i X_α` and the brackets `[Y_0 + η^j Y_j, Y_i] = K^l_i Y_l + G^α_i X_α` (η frozen),
//!
//! `X̄(p_i) - K^l_i p_l - Y_i L̄ - ( G^α_i + A^j ∂_jC^α_i ) L_α = P_i`, `p_i = ∂_iL̄`, `L_α = (∂_αL)|_N`
//!
//! (T3 (8)–(10); Boltzmann 1902, Hamel 1904). In an adapted frame F = 0: Hamel's equations.

use super::poincare_chetaev::frame_objects;
use super::{bare, Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::linear::dot;
use crate::system::System;
use chetaev_symbolic::Expr;

/// Embedded form in the frame of the model; without one, in independent velocities and constraint functions.
#[derive(Clone, Copy, Debug)]
pub struct BoltzmannHamel;

static CARD: Card = Card {
    name: "boltzmann-hamel",
    title: "Equations of Boltzmann and Hamel",
    statement: "The equations of motion in k independent quasi-velocities of a moving frame, from the Lagrangian restricted to the constraints and the brackets of the restricted fields.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.frame-regular", "model.masses-free-of-velocity"],
    identity: Some("the coefficients K and G of the brackets of the restricted fields are those given by the structure coefficients of the frame"),
    unknowns: "rates of the k independent quasi-velocities",
    highest_order: 1,
    sources: &[
        Source { key: "boltzmann1902", place: "" },
        Source { key: "hamel1904", place: "" },
        Source { key: "zhao", place: "(8)–(10)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D(p_i) − K^l_i p_l − Y_i L̄ − (G^α_i + A^j ∂C^α_i/∂η^j) L_α = P_i,  p_i = ∂L̄/∂η^i",
    latex: r"\frac{d}{dt} p_i - K^l_i p_l - Y_i \bar L - \Bigl( G^\alpha_i + A^j \frac{\partial C^\alpha_i}{\partial \eta^j} \Bigr) L_\alpha = P_i, \quad p_i = \frac{\partial \bar L}{\partial \eta^i}",
};

impl Formulation for BoltzmannHamel {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let embedding = Embedding::of(basis)?;
        let terms = embedding.terms();
        let system = basis.system;
        let zero = system.graph.zero();
        let left: Vec<Expr> = (0..embedding.k())
            .map(|i| embedding.left(&terms, i))
            .collect();
        let rates = embedding.chart.rates_from(system, &left)?;
        let motion = embedding
            .chart
            .parameters
            .iter()
            .zip(&left)
            .map(|(p, &left)| Equation {
                label: p.name.clone(),
                left,
                right: zero,
            })
            .collect();
        let chart = &embedding.chart;
        Ok(
            Equations::in_characteristics(CARD.name, system, chart, &rates)
                .with_group("equations of motion", Some(SCHEMA), motion)
                .with_group("kinematics", None, basis.kinematics(chart))
                .with_objects(frame_objects(system, &chart.frame))
                .with_objects(embedding.objects(&terms)),
        )
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let embedding = Embedding::of(basis)?;
        Ok(vec![Identity {
            statement: "[Y_0 + η^jY_j, Y_i] = K^l_i Y_l + G^α_i X_α with K and G from the structure coefficients".into(),
            residuals: embedding.bracket_residuals(),
            manifold: embedding.chart.manifold.clone(),
            on: "on the constraint manifold, for all quasi-velocities",
        }])
    }
}

/// The constraint manifold in a moving frame, with its fields and their brackets (T3 §5).
#[derive(Debug)]
pub struct Embedding<'a> {
    system: &'a System,
    /// Independent quasi-velocities η^i and the solved or implicit F^α.
    pub chart: Characteristics,
    /// `C[α][i] = ∂F^α/∂η^i`, r × k.
    pub slopes: Vec<Vec<Expr>>,
}

/// The parts of the embedded equations.
#[derive(Debug)]
pub struct Terms {
    /// L̄.
    pub lagrangian: Expr,
    /// p_i = ∂_iL̄.
    pub momenta: Vec<Expr>,
    /// L_α = (∂_αL)|_N.
    pub dependent_momenta: Vec<Expr>,
    /// `K[i][l]`.
    pub k: Vec<Vec<Expr>>,
    /// `G[i][α]`.
    pub g: Vec<Vec<Expr>>,
    /// `Σ_j A^j ∂_jC^α_i` with A^j the symbols η^j', as `[α][i]`.
    pub turning: Vec<Vec<Expr>>,
    /// X̄(p_i) on the jet (t, q, η, η').
    pub moved: Vec<Expr>,
    /// Y_iL̄.
    pub slopes: Vec<Expr>,
    /// P_i = Q_i + C^α_i Q_α.
    pub forces: Vec<Expr>,
}

impl<'a> Embedding<'a> {
    /// In the adapted frame of a model.
    ///
    /// # Errors
    /// [`DeriveError`] where the constraints do not determine the dependent quasi-velocities.
    pub fn of(basis: &Basis<'a>) -> Result<Embedding<'a>, DeriveError> {
        let chart = match &basis.characteristics {
            Some(given) => given.clone(),
            None => Characteristics::adapted(basis.system, basis.terms, basis.selection)?,
        };
        let slopes = chart.by_parameters(basis.system, &chart.solved);
        Ok(Embedding {
            system: basis.system,
            chart,
            slopes,
        })
    }

    /// k, the number of independent quasi-velocities.
    pub fn k(&self) -> usize {
        self.chart.k()
    }

    /// The components of Y_i along the coordinates: column i of B.
    pub fn field(&self, i: usize) -> Vec<Expr> {
        let g = &self.system.graph;
        let frame = &self.chart.frame;
        let mut field = frame.fields[self.chart.independent[i]].clone();
        for (&alpha, row) in self.chart.dependent.iter().zip(&self.slopes) {
            for (entry, &x) in field.iter_mut().zip(&frame.fields[alpha]) {
                *entry = g.add(&[*entry, g.mul(&[row[i], x])]);
            }
        }
        field
    }

    /// `[Y_0 + η^jY_j, Y_i]` with frozen η along the coordinates, split into components (K^l_i, G^α_i).
    pub fn brackets(&self, i: usize) -> (Vec<Expr>, Vec<Expr>) {
        let g = &self.system.graph;
        let field = self.field(i);
        let forward = self.chart.frozen_derivative(self.system, &field);
        let backward = self
            .chart
            .by_coordinates(self.system, &self.chart.velocities, &field);
        let bracket: Vec<Expr> = forward
            .into_iter()
            .zip(backward)
            .map(|(a, b)| g.sub(a, b))
            .collect();
        let along = self.chart.frame.components(self.system, &bracket);
        let k: Vec<Expr> = self.chart.independent.iter().map(|&l| along[l]).collect();
        let rest = self
            .chart
            .dependent
            .iter()
            .zip(&self.slopes)
            .map(|(&alpha, row)| g.sub(along[alpha], dot(g, row, &k)))
            .collect();
        (k, rest)
    }

    /// All parts of the equations.
    pub fn terms(&self) -> Terms {
        let (system, g, chart) = (self.system, &self.system.graph, &self.chart);
        let lagrangian = chart.restrict(system, &[system.lagrangian])[0];
        let momenta = chart.by_parameters(system, &[lagrangian]).swap_remove(0);
        // ∂_αL of the full Lagrangian is its derivative along X_α in the velocities, taken before the restriction.
        let full = g.gradient(system.lagrangian, &system.velocity_symbols());
        let full = chart.restrict(system, &full);
        let frame = &chart.frame;
        let dependent_momenta = chart
            .dependent
            .iter()
            .map(|&alpha| dot(g, &frame.fields[alpha], &full))
            .collect();
        let (k, rest): (Vec<_>, Vec<_>) = (0..self.k()).map(|i| self.brackets(i)).unzip();
        let forces = chart.restrict(system, &system.forces);
        let fields: Vec<Vec<Expr>> = (0..self.k()).map(|i| self.field(i)).collect();
        Terms {
            moved: chart.total_derivative(system, &momenta),
            slopes: fields
                .iter()
                .map(|field| chart.by_coordinates(system, &[lagrangian], field)[0])
                .collect(),
            forces: fields.iter().map(|field| dot(g, field, &forces)).collect(),
            turning: self.turning(),
            lagrangian,
            momenta,
            dependent_momenta,
            k,
            g: rest,
        }
    }

    /// `Σ_j η^j' ∂_jC^α_i`.
    fn turning(&self) -> Vec<Vec<Expr>> {
        let g = &self.system.graph;
        let rates: Vec<Expr> = self.chart.parameters.iter().map(|p| p.rate).collect();
        self.slopes
            .iter()
            .map(|row| {
                let derivatives = self.chart.by_parameters(self.system, row);
                derivatives.iter().map(|d| dot(g, d, &rates)).collect()
            })
            .collect()
    }

    /// Left side of (10) minus P_i.
    fn left(&self, terms: &Terms, i: usize) -> Expr {
        let g = &self.system.graph;
        let mut parts = vec![
            terms.moved[i],
            g.neg(dot(g, &terms.k[i], &terms.momenta)),
            g.neg(terms.slopes[i]),
            g.neg(terms.forces[i]),
        ];
        parts.push(g.neg(self.curvature_term(terms, i)));
        g.add(&parts)
    }

    /// `(G^α_i + A^j ∂_jC^α_i) L_α`.
    fn curvature_term(&self, terms: &Terms, i: usize) -> Expr {
        let g = &self.system.graph;
        let momenta = terms.dependent_momenta.iter().enumerate();
        let parts = momenta.map(|(alpha, &momentum)| {
            let curvature = g.add(&[terms.g[i][alpha], terms.turning[alpha][i]]);
            g.mul(&[curvature, momentum])
        });
        g.add(&parts.collect::<Vec<_>>())
    }

    /// K and G by `K^l_i = Γ^l_i + C^β_iΓ^l_β`, `G^α_i = Γ^α_i + C^β_iΓ^α_β - C^α_lK^l_i + (Y_0+η^jY_j)C^α_i - Y_iF^α`
    /// (T3 §5), minus those of the brackets; Γ from the structure coefficients of the whole frame.
    fn bracket_residuals(&self) -> Vec<Expr> {
        let (system, g, chart) = (self.system, &self.system.graph, &self.chart);
        let gamma = self.gamma();
        let column = |i: usize, w: usize| {
            let mut parts = vec![gamma[chart.independent[i]][w]];
            for (&beta, row) in chart.dependent.iter().zip(&self.slopes) {
                parts.push(g.mul(&[row[i], gamma[beta][w]]));
            }
            g.add(&parts)
        };
        let mut residuals = Vec::new();
        for i in 0..self.k() {
            let (bracket_k, bracket_g) = self.brackets(i);
            let k: Vec<Expr> = chart.independent.iter().map(|&l| column(i, l)).collect();
            residuals.extend(k.iter().zip(bracket_k).map(|(&a, b)| g.sub(a, b)));
            let field = self.field(i);
            let slope = chart.by_coordinates(system, &chart.solved, &field);
            for (a, &alpha) in chart.dependent.iter().enumerate() {
                let moved = chart.frozen_derivative(system, &[self.slopes[a][i]])[0];
                let formula = g.add(&[
                    column(i, alpha),
                    g.neg(dot(g, &self.slopes[a], &k)),
                    moved,
                    g.neg(slope[a]),
                ]);
                residuals.push(g.sub(formula, bracket_g[a]));
            }
        }
        residuals.retain(|&e| !g.is_zero(e));
        residuals
    }

    /// `Γ^w_s = C^w_0s + C^w_us η^u` as `[s][w]`, with η on the constraint manifold.
    fn gamma(&self) -> Vec<Vec<Expr>> {
        let (system, g, chart) = (self.system, &self.system.graph, &self.chart);
        let n = system.n();
        let mut speeds: Vec<Expr> = chart.frame.speeds.iter().map(|s| s.value).collect();
        for (&s, &value) in chart.dependent.iter().zip(&chart.solved) {
            speeds[s] = value;
        }
        let mut gamma = vec![vec![Vec::new(); n]; n];
        for (w, s, u, c) in chart.frame.structure_coefficients(system) {
            if s == 0 {
                gamma[u - 1][w - 1].push(c);
                continue;
            }
            gamma[u - 1][w - 1].push(g.mul(&[c, speeds[s - 1]]));
            gamma[s - 1][w - 1].push(g.neg(g.mul(&[c, speeds[u - 1]])));
        }
        gamma
            .into_iter()
            .map(|row| row.into_iter().map(|parts| g.add(&parts)).collect())
            .collect()
    }

    fn objects(&self, terms: &Terms) -> Vec<NamedExpr> {
        let g = &self.system.graph;
        let chart = &self.chart;
        let name = |s: usize| bare(&chart.frame.speeds[s].name).to_string();
        let independent: Vec<String> = chart.independent.iter().map(|&s| name(s)).collect();
        let dependent: Vec<String> = chart.dependent.iter().map(|&s| name(s)).collect();
        let mut objects = vec![NamedExpr::new(
            "Lbar",
            terms.lagrangian,
            "the Lagrangian on the constraints",
        )];
        for (a, alpha) in dependent.iter().enumerate() {
            objects.push(NamedExpr::new(
                format!("L_{alpha}"),
                terms.dependent_momenta[a],
                format!("∂L/∂{alpha} on the constraints"),
            ));
        }
        for (i, own) in independent.iter().enumerate() {
            objects.push(NamedExpr::new(
                format!("p_{own}"),
                terms.momenta[i],
                format!("∂L̄/∂{own}"),
            ));
            for (l, other) in independent.iter().enumerate() {
                let meaning =
                    format!("component of the bracket of the motion and Y_{own} along Y_{other}");
                let object =
                    NamedExpr::component(format!("K_{other}_{own}"), terms.k[i][l], meaning);
                objects.push(object.with_indices("K", &[other], &[own]));
            }
            for (a, alpha) in dependent.iter().enumerate() {
                let meaning = format!("∂F_{alpha}/∂{own}");
                let slope =
                    NamedExpr::component(format!("C_{alpha}_{own}"), self.slopes[a][i], meaning);
                let meaning =
                    format!("component of the bracket of the motion and Y_{own} along X_{alpha}");
                let across =
                    NamedExpr::component(format!("G_{alpha}_{own}"), terms.g[i][a], meaning);
                objects.push(slope.with_indices("C", &[alpha], &[own]));
                objects.push(across.with_indices("G", &[alpha], &[own]));
            }
            objects.push(NamedExpr::new(
                format!("Dp_{own}"),
                terms.moved[i],
                format!("D(p_{own})"),
            ));
            objects.push(NamedExpr::component(
                format!("Kp_{own}"),
                dot(g, &terms.k[i], &terms.momenta),
                format!("Σ K p, the term of the brackets along Y for {own}"),
            ));
            objects.push(NamedExpr::component(
                format!("GL_{own}"),
                self.curvature_term(terms, i),
                format!("Σ (G + A ∂C/∂η) ∂L/∂η, the term across the constraints for {own}"),
            ));
        }
        objects.retain(|o| o.name.starts_with("Lbar") || !g.is_zero(o.value));
        objects
    }
}
