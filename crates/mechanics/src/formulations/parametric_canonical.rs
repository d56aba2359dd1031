//! Equations in the extended phase space of x = (q, t) and y = (p, p_t).
//!
//! The momenta `y_a = ∂Λ/∂x'_a` satisfy one relation `K(x, y) = 0`; with `K = p_t + H(q, p, t)`
//! `x'_a = ∂K/∂y_a`, `y'_a = −∂K/∂x_a + Q_a + Σ μ_l ∂F^l/∂x'_a` (T1 (30), (31)). Then t' = 1 and μ = λ. K keeps its value for
//! arbitrary μ, since F is homogeneous of degree zero in x'.

use super::canonical::{with_constraints, with_reactions, MultiplierFlow};
use super::legendre::Legendre;
use super::parametric::{mu_objects, mu_symbols, Extended};
use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Manifold;
use crate::equations::unused_name;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use chetaev_symbolic::Expr;

/// Canonical equations in extended phase space.
#[derive(Clone, Copy, Debug)]
pub struct ParametricCanonical;

static CARD: Card = Card {
    name: "parametric-canonical",
    title: "Canonical equations in extended phase space",
    statement: "Time is a coordinate with the momentum p_t = −H; the relation K = p_t + H = 0 among the momenta takes the place of the Hamiltonian.",
    principle: Principle::Hamilton,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.hessian-regular", "model.masses-free-of-velocity"],
    identity: Some("K keeps its value, DK = 0, for arbitrary multipliers"),
    unknowns: "rates of the n + 1 momenta and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "rumyantsev1982", place: "canonical equations of extended phase space; T1 (30)–(31)" }],
};

const SCHEMA: Schema = Schema {
    text: "x'_a = ∂K/∂y_a, y'_a = −∂K/∂x_a + Q_a + Σ_l μ_l ∂F^l/∂x'_a, K = y_{n+1} + H = 0",
    latex: r"x'_a = \frac{\partial K}{\partial y_a}, \quad y'_a = -\frac{\partial K}{\partial x_a} + Q_a + \sum_l \mu_l \frac{\partial F^l}{\partial x'_a}, \quad K = y_{n+1} + H = 0",
};

impl Formulation for ParametricCanonical {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let space = PhaseSpace::new(basis)?;
        let legendre = &space.legendre;
        let flow = MultiplierFlow::new(basis, legendre, &legendre.by_momenta, &space.reactions)?;
        let time_rate = space.time_rate(basis, &flow.multipliers);
        let multipliers = flow.multipliers.clone();
        let mut equations = flow.into_equations(CARD.name, basis, legendre);
        equations.variables.push(StateVariable {
            name: space.time_name.clone(),
            value: g.symbol(&space.time_name, 0),
            symbol: g.intern_symbol(&space.time_name, 0),
            rate: time_rate,
            definition: Some(g.neg(system.energy())),
        });
        let equations = equations
            .with_group("equations of motion", Some(SCHEMA), space.stated(basis))
            .with_group("relation of the momenta", None, vec![space.relation(basis)])
            .with_objects([NamedExpr::new(
                unused_name(system, "K"),
                space.relation(basis).left,
                "relation among the momenta of extended phase space",
            )])
            .with_objects(mu_objects(basis, &multipliers));
        Ok(with_constraints(basis, legendre, equations))
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let g = &basis.system.graph;
        let space = PhaseSpace::new(basis)?;
        let legendre = &space.legendre;
        let multipliers = mu_symbols(basis);
        let mut parts = vec![legendre.by_time, space.time_rate(basis, &multipliers)];
        let momenta = space.momentum_rates(basis, &multipliers);
        for (i, &velocity) in legendre.by_momenta.iter().enumerate() {
            parts.push(g.mul(&[legendre.by_coordinates[i], velocity]));
            parts.push(g.mul(&[velocity, momenta[i]]));
        }
        let definitions: Vec<(Expr, Expr)> = legendre
            .momenta
            .iter()
            .map(|p| (p.value, p.definition))
            .collect();
        let rate = g.add(&parts);
        Ok(vec![Identity {
            statement: "DK = 0 for arbitrary multipliers".into(),
            residuals: vec![match legendre.is_explicit {
                true => rate,
                false => g.substitute(rate, &definitions),
            }],
            manifold: Manifold::default(),
            on: "on the whole extended phase space",
        }])
    }
}

/// The extended phase space of a system.
struct PhaseSpace {
    legendre: Legendre,
    /// `p_t`.
    time_name: String,
    /// `∂F^l/∂q'^i` at x' = ∂K/∂y, one covector per selected row.
    reactions: Vec<Vec<Expr>>,
    /// `∂F^l/∂t'` there.
    time_reactions: Vec<Expr>,
    /// Q_a there, a = 1..n+1.
    forces: Vec<Expr>,
}

impl PhaseSpace {
    fn new(basis: &Basis<'_>) -> Result<PhaseSpace, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let legendre = Legendre::new(system)?;
        let extended = Extended::new(basis);
        let rates = legendre.by_momenta.iter().copied().chain([g.one()]);
        let on_flow: Vec<(Expr, Expr)> = extended.rates().map(|w| w.value).zip(rates).collect();
        let gradients = extended.by_rates(system, &extended.constraints);
        let mut reactions = Vec::new();
        let mut time_reactions = Vec::new();
        for row in gradients {
            let mut row = g.substitute_all(&row, &on_flow);
            time_reactions.extend(row.pop());
            reactions.push(row);
        }
        Ok(PhaseSpace {
            forces: g.substitute_all(&extended.forces, &on_flow),
            time_name: unused_name(system, "p_t"),
            reactions,
            time_reactions,
            legendre,
        })
    }

    /// `p' = −∂K/∂q + Q + Σ μ ∂F/∂q'`.
    fn momentum_rates(&self, basis: &Basis<'_>, multipliers: &[Expr]) -> Vec<Expr> {
        let g = &basis.system.graph;
        let slopes = self.legendre.by_coordinates.iter();
        let free: Vec<Expr> = slopes
            .zip(&self.forces)
            .map(|(&slope, &force)| g.sub(force, slope))
            .collect();
        with_reactions(basis.system, &free, &self.reactions, multipliers)
    }

    /// `p_t' = −∂K/∂t − Σ Q q' + Σ μ ∂F/∂t'`.
    fn time_rate(&self, basis: &Basis<'_>, multipliers: &[Expr]) -> Expr {
        let g = &basis.system.graph;
        let mut parts = vec![g.neg(self.legendre.by_time)];
        parts.extend(self.forces.last());
        for (&mu, &slope) in multipliers.iter().zip(&self.time_reactions) {
            parts.push(g.mul(&[mu, slope]));
        }
        g.add(&parts)
    }

    /// The 2n + 2 equations, those that say `q' = q'` left out.
    fn stated(&self, basis: &Basis<'_>) -> Vec<Equation> {
        let (system, g) = (basis.system, &basis.system.graph);
        let multipliers = mu_symbols(basis);
        let mut stated: Vec<Equation> = system
            .coordinates
            .iter()
            .zip(&self.legendre.by_momenta)
            .filter(|(c, v)| c.v != **v)
            .map(|(c, &right)| Equation {
                label: c.name.clone(),
                left: c.v,
                right,
            })
            .collect();
        let rates = self.momentum_rates(basis, &multipliers);
        let momenta = self.legendre.momenta.iter().zip(rates);
        stated.extend(momenta.map(|(p, right)| Equation {
            label: p.name.clone(),
            left: p.rate,
            right,
        }));
        stated.push(Equation {
            label: self.time_name.clone(),
            left: g.symbol(&self.time_name, 1),
            right: self.time_rate(basis, &multipliers),
        });
        stated
    }

    /// `K = p_t + H = 0`.
    fn relation(&self, basis: &Basis<'_>) -> Equation {
        let g = &basis.system.graph;
        let time = g.symbol(&self.time_name, 0);
        Equation {
            label: "K".into(),
            left: g.add(&[time, self.legendre.hamiltonian]),
            right: g.zero(),
        }
    }
}
