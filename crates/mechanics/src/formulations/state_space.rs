//! Zhu's closed equations in the state space of (q, v), where `q' = v` is derived.
//!
//! `Σ_s L_{v^j v^s} (Dq^s − v^s) = 0`, `D(∂L/∂v^s) − ∂L/∂q^s − Q_s = Σ λ_l ∂f^l/∂v^s`, `f^l(q, v, t) = 0` with D along
//! curves (q(t), v(t)) (T1 (34), (38)): one linear system for (Dq, Dv, λ), regular where W is. Where particles carry the
//! inertia, Newton's statement takes the place of Lagrange's.

mod newton;

use super::routh::multiplier_objects;
use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::{derive_along, Manifold};
use crate::equations::unused_name;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use crate::linear::{dot, solve_with_multipliers};
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// Zhu's closed state-space equations.
#[derive(Clone, Copy, Debug)]
pub struct StateSpace;

static CARD: Card = Card {
    name: "state-space",
    title: "Closed equations in state space",
    statement: "Coordinates and velocities are unknowns on the same footing; the kinematic law Dq = v follows from the regular Hessian together with the equations of motion.",
    principle: Principle::SecondKind,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.hessian-regular", "model.masses-free-of-velocity"],
    identity: Some("Zhu's differential principle equals δZ + Σ Q δq − D(Σ ∂L/∂v δq) for arbitrary curves and variations, and Dq = v follows from the closed equations"),
    unknowns: "rates of coordinates and velocities and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "zhu1998", place: "closed equations of the state space; T1 (34)–(38)" }],
};

const SCHEMA: Schema = Schema {
    text: "Σ_s L_{v^j v^s} (Dq^s − v^s) = 0, D(∂L/∂v^s) − ∂L/∂q^s − Q_s = Σ_l λ_l ∂f^l/∂v^s",
    latex: r"\sum_s \frac{\partial^2 L}{\partial v^j \partial v^s} (D q^s - v^s) = 0, \quad D\frac{\partial L}{\partial v^s} - \frac{\partial L}{\partial q^s} - Q_s = \sum_l \lambda_l \frac{\partial f^l}{\partial v^s}",
};

const NEWTON: Schema = Schema {
    text: "Σ_a m_a (Dr_a − u_a)·∂r_a/∂q^s = 0, Σ_a (m_a Du_a − F_a − R_a)·∂r_a/∂q^s − Σ_a m_a (Dr_a − u_a)·∂u_a/∂q^s = Σ_l λ_l ∂f^l/∂v^s",
    latex: r"\sum_a m_a (D r_a - u_a) \cdot \frac{\partial r_a}{\partial q^s} = 0, \quad \sum_a (m_a D u_a - F_a - R_a) \cdot \frac{\partial r_a}{\partial q^s} - \sum_a m_a (D r_a - u_a) \cdot \frac{\partial u_a}{\partial q^s} = \sum_l \lambda_l \frac{\partial f^l}{\partial v^s}",
};

impl Formulation for StateSpace {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let system = basis.system;
        let jet = StateJet::new(system);
        let rates = solve(basis, &jet)?;
        let variables = system
            .coordinates
            .iter()
            .zip(&rates.velocities)
            .map(|(c, &rate)| StateVariable::of_velocity(c, rate))
            .collect();
        let (stated, kinematic) = stated_equations(basis, &jet);
        let density = NamedExpr::new(
            unused_name(system, "Z"),
            second_kind_density(system, &jet),
            "integrand of the second-kind principle",
        );
        let mut equations = Equations::in_state(CARD.name, system, variables, rates.coordinates)
            .with_group("kinematics", None, kinematic)
            .with_group("equations of motion", Some(schema(basis)), stated)
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects([density])
            .with_objects(multiplier_objects(basis, &rates.multipliers));
        let indices = basis.constraint_indices().into_iter();
        equations.multipliers = indices.zip(rates.multipliers).collect();
        Ok(equations)
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let system = basis.system;
        let jet = StateJet::new(system);
        let rates = solve(basis, &jet)?;
        let law = system
            .coordinates
            .iter()
            .zip(rates.coordinates)
            .map(|(c, rate)| system.graph.sub(rate, c.v))
            .collect();
        let mut identities = vec![
            Identity {
                statement: "Σ (L_q + Q − D L_v) δq + Σ (Dq − v) δL_v = δZ + Σ Q δq − D(Σ L_v δq)"
                    .into(),
                residuals: vec![second_kind_residual(system, &jet)],
                manifold: Manifold::default(),
                on: "for all curves (q(t), v(t)) and all variations",
            },
            Identity {
                statement: "Dq = v follows".into(),
                residuals: law,
                manifold: Manifold::default(),
                on: "outside the singular set of the Hessian",
            },
        ];
        if newton::applies(system) {
            identities.extend(of_newton(system, &jet));
        }
        Ok(identities)
    }
}

/// Newton's statement is Lagrange's, by the generalized relations of Lagrange.
fn of_newton(system: &System, jet: &StateJet) -> [Identity; 2] {
    let (statements, relations) = newton::residuals(system, jet);
    let identity = |statement: &str, residuals| Identity {
        statement: statement.into(),
        residuals,
        manifold: Manifold::default(),
        on: "for all curves (q(t), v(t)) and all variations",
    };
    [
        identity("Newton's statement is Lagrange's", statements),
        identity(
            "D(∂r/∂q^s) = ∂u/∂q^s + Σ_j (Dq^j − v^j) ∂²r/∂q^s∂q^j (generalized relations of Lagrange)",
            relations,
        ),
    ]
}

/// The statement that the equations are built from.
fn schema(basis: &Basis<'_>) -> Schema {
    match newton::applies(basis.system) {
        true => NEWTON,
        false => SCHEMA,
    }
}

/// The symbols of the rates Dq, Dv of a curve (q(t), v(t)).
#[derive(Debug)]
pub struct StateJet {
    /// Dq.
    pub coordinates: Vec<Expr>,
    /// Dv.
    pub velocities: Vec<Expr>,
}

impl StateJet {
    /// The symbols of a system.
    pub fn new(system: &System) -> StateJet {
        let g = &system.graph;
        let symbols = |prefix: &str, order: u32| -> Vec<Expr> {
            let names = system.coordinates.iter();
            names
                .map(|c| g.symbol(&unused_name(system, &format!("{prefix}{}", c.name)), order))
                .collect()
        };
        StateJet {
            coordinates: symbols("Dq_", 0),
            velocities: symbols("Dv_", 0),
        }
    }

    /// D along the curve.
    pub fn derive(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let symbols = system.velocity_symbols().into_iter();
        let mut rates: Vec<(Symbol, Expr)> = symbols.zip(self.velocities.iter().copied()).collect();
        // The law of a mass is one of the state (q, v), also where Dq is not v.
        rates.extend(system.masses.iter().map(|m| (m.symbol, m.rate)));
        derive_along(system, es, &self.coordinates, system.graph.one(), &rates)
    }
}

/// Dq, Dv and λ.
struct Rates {
    coordinates: Vec<Expr>,
    velocities: Vec<Expr>,
    multipliers: Vec<Expr>,
}

/// The linear system for (Dq, Dv, λ), size 2n + r.
fn solve(basis: &Basis<'_>, jet: &StateJet) -> Result<Rates, DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let n = system.n();
    let (kinematic, motion, constraint) = residuals(basis, jet);
    let equations: Vec<Expr> = kinematic
        .into_iter()
        .chain(motion)
        .chain(constraint)
        .collect();
    let rates = jet.coordinates.iter().chain(&jet.velocities);
    let symbols: Vec<Symbol> = rates.filter_map(|&e| g.as_symbol(e)).collect();
    let kinematic_rows = vec![g.zero(); n];
    let jacobian = basis.jacobian();
    let reactions: Vec<Vec<Expr>> = jacobian
        .iter()
        .map(|row| [kinematic_rows.as_slice(), row].concat())
        .collect();
    let (mut coordinates, multipliers) =
        solve_with_multipliers(g, &equations, &symbols, &reactions)?;
    let velocities = coordinates.split_off(n);
    Ok(Rates {
        coordinates,
        velocities,
        multipliers,
    })
}

/// `W (Dq − v)`, `D(∂L/∂v) − ∂L/∂q − Q`, or both by Newton's statement, and `D f`, linear in (Dq, Dv).
fn residuals(basis: &Basis<'_>, jet: &StateJet) -> (Vec<Expr>, Vec<Expr>, Vec<Expr>) {
    let (system, g) = (basis.system, &basis.system.graph);
    let constraints = jet.derive(system, &basis.constraints());
    if newton::applies(system) {
        let newton = newton::of_particles(system, jet);
        return (newton.velocities, newton.coordinates, constraints);
    }
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let pairs = jet.coordinates.iter().zip(&system.coordinates);
    let lag: Vec<Expr> = pairs.map(|(&rate, c)| g.sub(rate, c.v)).collect();
    let kinematic = basis
        .terms
        .mass_matrix
        .iter()
        .map(|row| dot(g, row, &lag))
        .collect();
    let motion = jet
        .derive(system, &momenta)
        .into_iter()
        .enumerate()
        .map(|(s, rate)| g.add(&[rate, g.neg(slopes[s]), g.neg(system.forces[s])]))
        .collect();
    (kinematic, motion, constraints)
}

/// The equations of motion, and the kinematic ones.
fn stated_equations(basis: &Basis<'_>, jet: &StateJet) -> (Vec<Equation>, Vec<Equation>) {
    let (system, g) = (basis.system, &basis.system.graph);
    let (kinematic, motion, _) = residuals(basis, jet);
    let none = vec![g.zero(); system.n()];
    (
        Equation::of_coordinates(system, motion, basis.reactions()),
        Equation::of_coordinates(system, kinematic, none),
    )
}

/// `Z = L + Σ (Dq^s − v^s) ∂L/∂v^s` (T1 (35)).
pub fn second_kind_density(system: &System, jet: &StateJet) -> Expr {
    let g = &system.graph;
    let mut parts = vec![system.lagrangian];
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    for ((c, &rate), p) in system.coordinates.iter().zip(&jet.coordinates).zip(momenta) {
        parts.push(g.mul(&[g.sub(rate, c.v), p]));
    }
    g.add(&parts)
}

/// (34) minus `δZ + Σ Q δq − D(Σ ∂L/∂v δq)`, with δq, Dδq, δv as symbols.
fn second_kind_residual(system: &System, jet: &StateJet) -> Expr {
    let g = &system.graph;
    let named = |prefix: &str, order: u32| -> Vec<Expr> {
        let names = system.coordinates.iter();
        names
            .map(|c| g.symbol(&unused_name(system, &format!("{prefix}{}", c.name)), order))
            .collect()
    };
    let (dq, ddq, dv) = (
        named("delta_q_", 0),
        named("delta_q_", 1),
        named("delta_v_", 0),
    );
    let symbol_rates = |symbols: &[Expr], rates: &[Expr]| -> Vec<(Symbol, Expr)> {
        let pairs = symbols.iter().zip(rates);
        pairs
            .filter_map(|(&s, &rate)| Some((g.as_symbol(s)?, rate)))
            .collect()
    };
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let mut varied = symbol_rates(&velocities, &dv);
    varied.extend(symbol_rates(&jet.coordinates, &ddq));
    let vary = |es: &[Expr]| derive_along(system, es, &dq, g.zero(), &varied);
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let varied_momenta = vary(&momenta);
    let moved_momenta = jet.derive(system, &momenta);
    let mut parts = vec![g.neg(vary(&[second_kind_density(system, jet)]).swap_remove(0))];
    for (s, c) in system.coordinates.iter().enumerate() {
        let (p, force) = (momenta[s], system.forces[s]);
        let covector = g.add(&[slopes[s], force, g.neg(moved_momenta[s])]);
        parts.push(g.mul(&[covector, dq[s]]));
        parts.push(g.mul(&[g.sub(jet.coordinates[s], c.v), varied_momenta[s]]));
        parts.push(g.neg(g.mul(&[force, dq[s]])));
        // D(p δq)
        parts.push(g.mul(&[moved_momenta[s], dq[s]]));
        parts.push(g.mul(&[p, ddq[s]]));
    }
    g.add(&parts)
}
