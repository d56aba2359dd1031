//! Equations in the extended configuration space x = (q, t) with a parameter τ.
//!
//! `Λ(x, x') = L(q, q'/t', t) t'`, `F^l(x, x') = f^l(q, q'/t', t)`, ' = d/dτ, and
//! `d/dτ(∂Λ/∂x'_a) − ∂Λ/∂x_a = Q_a + Σ μ_l ∂F^l/∂x'_a`, `F^l = 0`, a = 1..n+1 (T1 (28), (29)), with the forces
//! `(t' Qᵢ, −Σ Qᵢ q'ⁱ)` of extended space. The n + 1 equations satisfy Euler's identity `Σ x'_a (left − right)_a ≡ 0`, so τ is
//! free; it is fixed here by `d²t/dτ² = 0`, and the equation of t is left to the identity. `μ_l = t'² λ_l`.

use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::{derive_along, Manifold};
use crate::equations::unused_name;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use crate::linear::solve_with_multipliers;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// The n + 1 parametric equations.
#[derive(Clone, Copy, Debug)]
pub struct Parametric;

static CARD: Card = Card {
    name: "parametric",
    title: "Parametric equations in extended configuration space",
    statement: "Coordinates and time are functions of a parameter τ: n + 1 equations with one identity among them; τ is fixed by d²t/dτ² = 0.",
    principle: Principle::Hamilton,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.masses-free-of-velocity"],
    identity: Some("The left sides minus the right sides, contracted with x', vanish for arbitrary curves and arbitrary multipliers"),
    unknowns: "second derivatives of coordinates and time by the parameter and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "rumyantsev1982", place: "parametric form of the equations; T1 (28)–(29)" }],
};

const SCHEMA: Schema = Schema {
    text: "d/dτ(∂Λ/∂x'_a) − ∂Λ/∂x_a = Q_a + Σ_l μ_l ∂F^l/∂x'_a, Λ = L(q, q'/t', t) t', t'' = 0",
    latex: r"\frac{d}{d\tau}\frac{\partial \Lambda}{\partial x'_a} - \frac{\partial \Lambda}{\partial x_a} = Q_a + \sum_l \mu_l \frac{\partial F^l}{\partial x'_a}, \quad \Lambda = L(q, q'/t', t)\, t', \quad t'' = 0",
};

impl Formulation for Parametric {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let system = basis.system;
        let extended = Extended::new(basis);
        let (seconds, multipliers) = solve(system, &extended)?;
        let equations = Equations::in_state(
            CARD.name,
            system,
            state(system, &extended, &seconds),
            extended.velocities(system),
        )
        .with_group(
            "equations of motion",
            Some(SCHEMA),
            stated_equations(basis, &extended),
        )
        .with_group("parameter", None, gauge(system, &extended))
        .with_group(
            "constraints",
            None,
            basis.constraints_as(&extended.constraints),
        )
        .with_objects(extended.objects(basis))
        .with_objects(mu_objects(basis, &multipliers));
        let scale = system.graph.powi(extended.time.value, -2);
        let lambdas = multipliers.iter().map(|&mu| system.graph.mul(&[scale, mu]));
        Ok(equations.with_multipliers(basis.constraint_indices(), lambdas.collect()))
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let g = &basis.system.graph;
        let extended = Extended::new(basis);
        let parts: Vec<Expr> = stated_equations(basis, &extended)
            .iter()
            .zip(extended.rates())
            .map(|(equation, rate)| g.mul(&[rate.value, g.sub(equation.left, equation.right)]))
            .collect();
        Ok(vec![Identity {
            statement: "Σ x'_a (left − right)_a = 0".into(),
            residuals: vec![g.add(&parts)],
            manifold: Manifold::default(),
            on: "for arbitrary curves and arbitrary multipliers",
        }])
    }
}

/// A derivative by τ, with its own derivative by τ.
#[derive(Clone, Debug)]
pub(crate) struct ParameterRate {
    pub(crate) name: String,
    pub(crate) value: Expr,
    pub(crate) symbol: Symbol,
    pub(crate) second: Expr,
    pub(crate) second_symbol: Symbol,
}

impl ParameterRate {
    pub(crate) fn new(system: &System, coordinate: &str) -> ParameterRate {
        let g = &system.graph;
        let name = unused_name(system, &format!("w_{coordinate}"));
        ParameterRate {
            value: g.symbol(&name, 0),
            symbol: g.intern_symbol(&name, 0),
            second: g.symbol(&name, 1),
            second_symbol: g.intern_symbol(&name, 1),
            name,
        }
    }
}

/// Lagrangian, constraints and forces as functions of (x, x').
pub(crate) struct Extended {
    pub(crate) coordinates: Vec<ParameterRate>,
    pub(crate) time: ParameterRate,
    /// Λ.
    pub(crate) lagrangian: Expr,
    /// F^l of the selected rows.
    pub(crate) constraints: Vec<Expr>,
    /// Q_a, a = 1..n+1.
    pub(crate) forces: Vec<Expr>,
}

impl Extended {
    pub(crate) fn new(basis: &Basis<'_>) -> Extended {
        let (system, g) = (basis.system, &basis.system.graph);
        let names = system.coordinates.iter();
        let coordinates: Vec<ParameterRate> =
            names.map(|c| ParameterRate::new(system, &c.name)).collect();
        let time = ParameterRate::new(system, "t");
        let velocities: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&coordinates)
            .map(|(c, w)| (c.v, g.div(w.value, time.value)))
            .collect();
        let lagrangian = g.substitute(system.lagrangian, &velocities);
        let constraints = g.substitute_all(&basis.constraints(), &velocities);
        let applied = g.substitute_all(&system.forces, &velocities);
        let power: Vec<Expr> = applied
            .iter()
            .zip(&coordinates)
            .map(|(&force, w)| g.mul(&[force, w.value]))
            .collect();
        let mut forces: Vec<Expr> = applied
            .iter()
            .map(|&force| g.mul(&[time.value, force]))
            .collect();
        forces.push(g.neg(g.add(&power)));
        Extended {
            lagrangian: g.mul(&[lagrangian, time.value]),
            constraints,
            forces,
            coordinates,
            time,
        }
    }

    /// x'_a, a = 1..n+1.
    pub(crate) fn rates(&self) -> impl Iterator<Item = &ParameterRate> {
        self.coordinates.iter().chain([&self.time])
    }

    /// `q'/t'`.
    fn velocities(&self, system: &System) -> Vec<Expr> {
        let coordinates = self.coordinates.iter();
        coordinates
            .map(|w| system.graph.div(w.value, self.time.value))
            .collect()
    }

    /// d/dτ on the jet (x, x', x'').
    fn derive(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let directions: Vec<Expr> = self.coordinates.iter().map(|w| w.value).collect();
        let seconds: Vec<(Symbol, Expr)> = self.rates().map(|w| (w.symbol, w.second)).collect();
        derive_along(system, es, &directions, self.time.value, &seconds)
    }

    /// `∂e/∂x'_a`: one row per expression.
    pub(crate) fn by_rates(&self, system: &System, es: &[Expr]) -> Vec<Vec<Expr>> {
        let symbols: Vec<Symbol> = self.rates().map(|w| w.symbol).collect();
        system.graph.jacobian(es, &symbols)
    }

    /// `d/dτ(∂Λ/∂x'_a) − ∂Λ/∂x_a`.
    fn left_sides(&self, system: &System) -> Vec<Expr> {
        let g = &system.graph;
        let momenta = self.by_rates(system, &[self.lagrangian]).concat();
        let mut slopes = g.gradient(self.lagrangian, &system.coordinate_symbols());
        let still = vec![g.zero(); system.n()];
        slopes.extend(derive_along(
            system,
            &[self.lagrangian],
            &still,
            g.one(),
            &system.mass_rates(&self.velocities(system)),
        ));
        self.derive(system, &momenta)
            .into_iter()
            .zip(slopes)
            .map(|(moved, slope)| g.sub(moved, slope))
            .collect()
    }

    fn objects(&self, basis: &Basis<'_>) -> Vec<NamedExpr> {
        let name = unused_name(basis.system, "Lambda");
        let mut objects = vec![NamedExpr::new(
            name,
            self.lagrangian,
            "Lagrangian in extended configuration space",
        )];
        for (name, &f) in basis.constraint_names().iter().zip(&self.constraints) {
            let meaning = format!("`{name}` in extended configuration space");
            let name = unused_name(basis.system, &format!("F_{name}"));
            objects.push(NamedExpr::new(name, f, meaning));
        }
        objects
    }
}

/// x'' and μ from the equations of the coordinates, t'' = 0 and DF = 0.
fn solve(system: &System, extended: &Extended) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
    let (g, n) = (&system.graph, system.n());
    let mut equations: Vec<Expr> = extended
        .left_sides(system)
        .into_iter()
        .zip(&extended.forces)
        .take(n)
        .map(|(left, &force)| g.sub(left, force))
        .collect();
    equations.push(extended.time.second);
    equations.extend(extended.derive(system, &extended.constraints));
    let symbols: Vec<Symbol> = extended.rates().map(|w| w.second_symbol).collect();
    let gradients = extended.by_rates(system, &extended.constraints);
    let reactions: Vec<Vec<Expr>> = gradients.iter().map(|row| row[..n].to_vec()).collect();
    Ok(solve_with_multipliers(g, &equations, &symbols, &reactions)?)
}

/// The state x' with rates by t, `x''/t'`.
fn state(system: &System, extended: &Extended, seconds: &[Expr]) -> Vec<StateVariable> {
    let g = &system.graph;
    let velocities = system.coordinates.iter().map(|c| c.v).chain([g.one()]);
    extended
        .rates()
        .zip(seconds)
        .zip(velocities)
        .map(|((w, &second), definition)| StateVariable {
            name: w.name.clone(),
            value: w.value,
            symbol: w.symbol,
            rate: g.div(second, extended.time.value),
            definition: Some(definition),
        })
        .collect()
}

/// The n + 1 equations with the multipliers μ as symbols.
fn stated_equations(basis: &Basis<'_>, extended: &Extended) -> Vec<Equation> {
    let (system, g) = (basis.system, &basis.system.graph);
    let multipliers = mu_symbols(basis);
    let gradients = extended.by_rates(system, &extended.constraints);
    let names = system.coordinates.iter().map(|c| c.name.as_str());
    let labels = names.chain(["t"]);
    extended
        .left_sides(system)
        .into_iter()
        .zip(labels)
        .enumerate()
        .map(|(a, (left, label))| {
            let mut right = vec![extended.forces[a]];
            for (&mu, row) in multipliers.iter().zip(&gradients) {
                right.push(g.mul(&[mu, row[a]]));
            }
            Equation {
                label: label.to_string(),
                left,
                right: g.add(&right),
            }
        })
        .collect()
}

fn gauge(system: &System, extended: &Extended) -> Vec<Equation> {
    vec![Equation {
        label: "t".into(),
        left: extended.time.second,
        right: system.graph.zero(),
    }]
}

/// The symbols `mu_NAME` of the selected rows.
pub(crate) fn mu_symbols(basis: &Basis<'_>) -> Vec<Expr> {
    let (system, names) = (basis.system, basis.constraint_names().into_iter());
    names
        .map(|name| {
            system
                .graph
                .symbol(&unused_name(system, &format!("mu_{name}")), 0)
        })
        .collect()
}

/// The multipliers μ as named objects.
pub(crate) fn mu_objects(basis: &Basis<'_>, values: &[Expr]) -> Vec<NamedExpr> {
    let names = basis.constraint_names().into_iter().zip(values);
    names
        .map(|(name, &value)| {
            NamedExpr::new(
                unused_name(basis.system, &format!("mu_{name}")),
                value,
                format!("multiplier of `{name}` along the parameter τ"),
            )
        })
        .collect()
}
