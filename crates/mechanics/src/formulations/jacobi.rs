//! The equations of Jacobi's principle of least action at fixed energy, changed back to the time.
//!
//! `P(q, q') = √(2(h + L₀)) √(2F) + L₁(q, q')`, `F = L₂(q, q')`, ' = d/dτ, and
//! `d/dτ(∂P/∂q'ⁱ) − ∂P/∂qⁱ = Σ μ_l ∂f^l(q, q')/∂q'ⁱ`, `f^l(q, q') = 0` (T1 (21), (22)). Their contraction with q' vanishes, so
//! τ is free; it is fixed here as the arc length, `F(q, q') = ½`, by an unknown more that this identity makes zero. Back to
//! time by `dτ/dt = √((h + L₀)/F)` (T1 (20)). On the path `h + L₀ > 0` and `F > 0` are needed, where the roots are real.
//! The root `S = √(2F)` is a symbol with `dS = dF/S` while P is differentiated, and 1 when that is done: along a path in arc
//! length no root of a square is left whose sign had to be guessed.

use super::parametric::{mu_objects, mu_symbols, ParameterRate};
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::derive_along;
use crate::equations::unused_name;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use crate::linear::solve_with_multipliers;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// The equations of Jacobi's principle.
#[derive(Clone, Copy, Debug)]
pub struct Jacobi;

static CARD: Card = Card {
    name: "jacobi",
    title: "Equations of Jacobi's principle",
    statement: "Equations of the path at fixed energy h, with the arc length of the kinetic metric as parameter, changed back to the time; where h + L₀ > 0 and the metric is positive along the path.",
    principle: Principle::Jacobi,
    relation: Relation::Equivalent,
    requires: &[
        "model.accelerations-unique",
        "model.forces-absent",
        "model.lagrangian-autonomous",
        "model.lagrangian-quadratic",
        "model.constraints-homogeneous",
        "model.constraints-scleronomic",
        "model.masses-free-of-velocity",
        "model.metric-positive",
    ],
    identity: None,
    unknowns: "second derivatives of the coordinates by the arc length and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "rumyantsev1982", place: "the principle of Jacobi, (4.12)" }],
};

const SCHEMA: Schema = Schema {
    text: "d/dτ(∂P/∂q'^i) − ∂P/∂q^i = Σ_l μ_l ∂f^l/∂q'^i, P = √(2(h + L_0)) √(2F) + L_1, F = 1/2",
    latex: r"\frac{d}{d\tau}\frac{\partial P}{\partial q'^i} - \frac{\partial P}{\partial q^i} = \sum_l \mu_l \frac{\partial f^l}{\partial q'^i}, \quad P = \sqrt{2(h + L_0)}\sqrt{2F} + L_1, \quad F = \tfrac12",
};

impl Formulation for Jacobi {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let path = Path::new(basis);
        let (seconds, multipliers) = path.solve(system)?;
        // dτ/dt = √((h + L₀)/F) with F = ½.
        let speed = path.kinetic;
        let velocities: Vec<Expr> = path
            .rates
            .iter()
            .map(|w| g.mul(&[w.value, speed]))
            .collect();
        let variables = path.state(system, &seconds, speed);
        let mut equations = Equations::in_state(CARD.name, system, variables, velocities)
            .with_group("equations of motion", Some(SCHEMA), path.stated(basis))
            .with_group("parameter", None, vec![path.gauge(system)])
            .with_group("constraints", None, basis.constraints_as(&path.constraints))
            .with_objects(path.objects(system))
            .with_objects(mu_objects(basis, &multipliers));
        // For constraints of degree one in the velocities ∂f/∂v is that of the path, and λ = μ dτ/dt.
        let indices = basis.constraint_indices();
        let is_of_degree_one = |&l: &usize| system.constraints[l].is_affine_in_velocities();
        if indices.iter().all(is_of_degree_one) {
            let lambdas = multipliers.iter().map(|&mu| g.mul(&[speed, mu]));
            equations.multipliers = indices.into_iter().zip(lambdas).collect();
        }
        Ok(equations)
    }
}

/// Jacobi's integrand and constraints on the jet (q, q', q'').
struct Path {
    /// q'.
    rates: Vec<ParameterRate>,
    /// h.
    energy_name: String,
    energy: Expr,
    /// L₀.
    potential_part: Expr,
    /// F.
    metric: Expr,
    /// `√(2(h + L₀))`.
    kinetic: Expr,
    /// `L₁(q, q')`.
    linear: Expr,
    /// The symbol of S.
    length: Expr,
    /// f(q, q') of the selected rows.
    constraints: Vec<Expr>,
}

impl Path {
    fn new(basis: &Basis<'_>) -> Path {
        let (system, g) = (basis.system, &basis.system.graph);
        let names = system.coordinates.iter();
        let rates: Vec<ParameterRate> =
            names.map(|c| ParameterRate::new(system, &c.name)).collect();
        let energy_name = unused_name(system, "h");
        let energy = g.symbol(&energy_name, 0);
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        let mut functions = vec![system.lagrangian];
        functions.extend(g.gradient(system.lagrangian, &system.velocity_symbols()));
        let mut mass: Vec<Expr> = g.substitute_all(&basis.terms.mass_matrix.concat(), &at_rest);
        let functions = g.substitute_all(&functions, &at_rest);
        let linear: Vec<Expr> = rates
            .iter()
            .zip(&functions[1..])
            .map(|(w, &slope)| g.mul(&[slope, w.value]))
            .collect();
        let half = g.div(g.one(), g.integer(2));
        for (place, entry) in mass.iter_mut().enumerate() {
            let (i, j) = (place / rates.len(), place % rates.len());
            *entry = g.mul(&[half, *entry, rates[i].value, rates[j].value]);
        }
        let metric = g.add(&mass);
        let potential_part = functions[0];
        let twice = g.mul(&[g.integer(2), g.add(&[energy, potential_part])]);
        let along: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&rates)
            .map(|(c, w)| (c.v, w.value))
            .collect();
        Path {
            constraints: g.substitute_all(&basis.constraints(), &along),
            rates,
            energy_name,
            energy,
            potential_part,
            metric,
            kinetic: g.sqrt(twice),
            linear: g.add(&linear),
            length: g.symbol(&unused_name(system, "S"), 0),
        }
    }

    /// d/dτ on the jet.
    fn derive(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let rate = self.in_arc_length(system, &[self.metric]);
        let further = self.length_rate(system, rate[0]);
        self.derive_with(system, es, further)
    }

    /// The same where F, and with it S, keeps its value.
    fn in_arc_length(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        self.derive_with(system, es, None)
    }

    fn derive_with(
        &self,
        system: &System,
        es: &[Expr],
        length_rate: Option<(Symbol, Expr)>,
    ) -> Vec<Expr> {
        let directions: Vec<Expr> = self.rates.iter().map(|w| w.value).collect();
        let own = self.rates.iter().map(|w| (w.symbol, w.second));
        let rates: Vec<(Symbol, Expr)> = own.chain(length_rate).collect();
        derive_along(system, es, &directions, system.graph.zero(), &rates)
    }

    /// `S' = F'/S`.
    fn length_rate(&self, system: &System, metric_rate: Expr) -> Option<(Symbol, Expr)> {
        let g = &system.graph;
        Some((g.as_symbol(self.length)?, g.div(metric_rate, self.length)))
    }

    fn by_rates(&self, system: &System, es: &[Expr]) -> Vec<Vec<Expr>> {
        let symbols: Vec<Symbol> = self.rates.iter().map(|w| w.symbol).collect();
        system.graph.jacobian(es, &symbols)
    }

    /// `∂P/∂q'ⁱ = √(2(h + L₀)) F_i/S + ∂L₁/∂q'ⁱ`.
    fn momenta(&self, system: &System) -> Vec<Expr> {
        let g = &system.graph;
        let rows = self.by_rates(system, &[self.metric, self.linear]);
        rows[0]
            .iter()
            .zip(&rows[1])
            .map(|(&metric, &linear)| {
                let quotient = g.div(g.mul(&[self.kinetic, metric]), self.length);
                g.add(&[quotient, linear])
            })
            .collect()
    }

    /// `∂P/∂qⁱ`.
    fn slopes(&self, system: &System) -> Vec<Expr> {
        let g = &system.graph;
        let parts = [self.kinetic, self.metric, self.linear];
        let rows = g.jacobian(&parts, &system.coordinate_symbols());
        (0..system.n())
            .map(|i| {
                g.add(&[
                    g.mul(&[rows[0][i], self.length]),
                    g.div(g.mul(&[self.kinetic, rows[1][i]]), self.length),
                    rows[2][i],
                ])
            })
            .collect()
    }

    /// Left sides with S as a symbol.
    fn left_sides(&self, system: &System) -> Vec<Expr> {
        self.less_slopes(system, self.derive(system, &self.momenta(system)))
    }

    fn less_slopes(&self, system: &System, moved: Vec<Expr>) -> Vec<Expr> {
        let pairs = moved.into_iter().zip(self.slopes(system));
        pairs
            .map(|(moved, slope)| system.graph.sub(moved, slope))
            .collect()
    }

    /// `S = √(2F)`.
    fn with_length(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let length = g.sqrt(g.mul(&[g.integer(2), self.metric]));
        g.substitute_all(es, &[(self.length, length)])
    }

    /// q'' and μ; the last unknown beside q'' is the one that the identity makes zero.
    fn solve(&self, system: &System) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
        let g = &system.graph;
        let in_arc_length = [(self.length, g.one())];
        // F' = 0 is an equation of the system, and without it the matrix of q'' is that of the masses, which is regular by itself.
        let moved = self.in_arc_length(system, &self.momenta(system));
        let left = self.less_slopes(system, moved);
        let mut equations = g.substitute_all(&left, &in_arc_length);
        equations.extend(self.derive(system, &[self.metric]));
        equations.extend(self.derive(system, &self.constraints));
        let symbols: Vec<Symbol> = self.rates.iter().map(|w| w.second_symbol).collect();
        let mut borders = self.by_rates(system, &[self.metric]);
        borders.extend(self.by_rates(system, &self.constraints));
        let (seconds, mut rest) = solve_with_multipliers(g, &equations, &symbols, &borders)?;
        let multipliers = rest.split_off(1);
        Ok((seconds, multipliers))
    }

    /// The state (q', h): q' = v/√(2 L₂(q, v)) in arc length, `h = L₂ − L₀`.
    fn state(&self, system: &System, seconds: &[Expr], speed: Expr) -> Vec<StateVariable> {
        let g = &system.graph;
        let along: Vec<(Expr, Expr)> = self
            .rates
            .iter()
            .zip(&system.coordinates)
            .map(|(w, c)| (w.value, c.v))
            .collect();
        let kinetic = g.substitute(self.metric, &along);
        let length = g.sqrt(g.mul(&[g.integer(2), kinetic]));
        let mut variables: Vec<StateVariable> = self
            .rates
            .iter()
            .zip(seconds)
            .zip(&system.coordinates)
            .map(|((w, &second), c)| StateVariable {
                name: w.name.clone(),
                value: w.value,
                symbol: w.symbol,
                rate: g.mul(&[second, speed]),
                definition: Some(g.div(c.v, length)),
            })
            .collect();
        variables.push(StateVariable {
            name: self.energy_name.clone(),
            value: self.energy,
            symbol: g.intern_symbol(&self.energy_name, 0),
            rate: g.zero(),
            definition: Some(g.sub(kinetic, self.potential_part)),
        });
        variables
    }

    fn stated(&self, basis: &Basis<'_>) -> Vec<Equation> {
        let (system, g) = (basis.system, &basis.system.graph);
        let multipliers = mu_symbols(basis);
        let gradients = self.by_rates(system, &self.constraints);
        self.with_length(system, &self.left_sides(system))
            .into_iter()
            .enumerate()
            .map(|(i, left)| {
                let terms = multipliers.iter().zip(&gradients);
                let right: Vec<Expr> = terms.map(|(&mu, row)| g.mul(&[mu, row[i]])).collect();
                Equation {
                    label: system.coordinates[i].name.clone(),
                    left,
                    right: g.add(&right),
                }
            })
            .collect()
    }

    fn gauge(&self, system: &System) -> Equation {
        let g = &system.graph;
        Equation {
            label: "arc length".into(),
            left: self.metric,
            right: g.div(g.one(), g.integer(2)),
        }
    }

    fn objects(&self, system: &System) -> Vec<NamedExpr> {
        let named =
            |name: &str, value, meaning| NamedExpr::new(unused_name(system, name), value, meaning);
        let g = &system.graph;
        let integrand = g.add(&[g.mul(&[self.kinetic, self.length]), self.linear]);
        let integrand = self.with_length(system, &[integrand])[0];
        vec![
            named("P", integrand, "integrand of Jacobi's principle"),
            named(
                "F",
                self.metric,
                "half the square of the arc length element",
            ),
        ]
    }
}
