//! The equations of the principle of d'Alembert and Lagrange.
//!
//! `Σ_i ( D(∂L/∂v^i) - ∂L/∂q^i - Q_i ) δq^i = 0` for every δq with `Σ_i ∂f^l/∂v^i δq^i = 0`, and `D f^l = 0` (T1 (1), (C)).
//! The basis of virtual displacements comes from the gradients ∂f/∂v alone, with the velocities as they are.

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::linear::{dot, solve_linear};
use crate::system::System;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Symbol};

/// The principle of d'Alembert and Lagrange with a basis of virtual displacements.
#[derive(Clone, Copy, Debug)]
pub struct LagrangeDalembert;

static CARD: Card = Card {
    name: "lagrange-dalembert",
    title: "D'Alembert–Lagrange equations",
    statement: "Lagrange's left sides minus forces do no work on a basis of the displacements that the constraint gradients allow.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique"],
    identity: None,
    unknowns: "accelerations of all coordinates",
    highest_order: 1,
    sources: &[
        Source { key: "chetaev1932", place: "§§1–3" },
        Source { key: "rumyantsev1982", place: "(1.1)–(1.2)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "Σ_i ( D(∂L/∂v^i) − ∂L/∂q^i − Q_i ) δq^i = 0,  Σ_i ∂f^l/∂v^i δq^i = 0",
    latex: r"\sum_i \Bigl( \frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} - Q_i \Bigr) \delta q^i = 0, \quad \sum_i \frac{\partial f^l}{\partial \dot q^i} \delta q^i = 0",
};

impl Formulation for LagrangeDalembert {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let displacements = VirtualDisplacements::new(basis)?;
        let motion = displacements.contract(system, &system.motion_left_sides());
        let mut determined = motion.clone();
        let constraints = basis.constraints();
        determined.extend(constraints.iter().map(|&f| system.total_derivative(f)));
        let accelerations = solve_for_accelerations(system, &determined)?;
        let labels = displacements.independent.iter();
        let motion = labels
            .zip(motion)
            .map(|(&s, left)| Equation {
                label: system.coordinates[s].name.clone(),
                left,
                right: g.zero(),
            })
            .collect();
        let mut equations = Equations::in_velocities(CARD.name, system, accelerations)
            .with_group("equations of motion", Some(SCHEMA), motion)
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects(displacements.objects(system));
        equations.relations = displacements.relations(system, &constraints);
        // The basis degenerates where the dependent displacements cannot be solved for; another choice then serves.
        equations.is_chart = !constraints.is_empty();
        Ok(equations)
    }
}

/// A basis of the virtual displacements at a state (q, v, t): `J δq = 0`.
pub(crate) struct VirtualDisplacements {
    /// The coordinates whose displacement is free.
    pub(crate) independent: Vec<usize>,
    /// The others, one per row.
    pub(crate) dependent: Vec<usize>,
    /// `columns[s][i]`: δq^i where the s-th independent displacement is 1 and the others vanish.
    pub(crate) columns: Vec<Vec<Expr>>,
}

impl VirtualDisplacements {
    pub(crate) fn new(basis: &Basis<'_>) -> Result<VirtualDisplacements, SolveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let dependent = match &basis.characteristics {
            Some(given) if given.frame.is_natural(system) => given.dependent.clone(),
            _ => basis.selection.dependent.clone(),
        };
        let jacobian = basis.jacobian();
        let block: Vec<Expr> = jacobian
            .iter()
            .flat_map(|row| dependent.iter().map(|&d| row[d]))
            .collect();
        let independent: Vec<usize> = (0..system.n()).filter(|i| !dependent.contains(i)).collect();
        let columns = independent
            .iter()
            .map(|&s| {
                let right: Vec<Expr> = jacobian.iter().map(|row| g.neg(row[s])).collect();
                let mut column = vec![g.zero(); system.n()];
                column[s] = g.one();
                if !dependent.is_empty() {
                    for (&d, value) in dependent.iter().zip(g.solve(&block, &right)?) {
                        column[d] = value;
                    }
                }
                Ok(column)
            })
            .collect::<Result<_, SolveError>>()?;
        Ok(VirtualDisplacements {
            independent,
            dependent,
            columns,
        })
    }

    /// `Σ_i w_i δq^i` for each displacement of the basis.
    pub(crate) fn contract(&self, system: &System, covector: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let columns = self.columns.iter();
        columns.map(|column| dot(g, covector, column)).collect()
    }

    /// The constraints with the dependent velocities they determine.
    pub(crate) fn relations(&self, system: &System, constraints: &[Expr]) -> Vec<(Expr, Symbol)> {
        let dependent = self.dependent.iter();
        let symbols = dependent.map(|&d| system.coordinates[d].v_symbol);
        constraints.iter().copied().zip(symbols).collect()
    }

    fn objects(&self, system: &System) -> Vec<NamedExpr> {
        let name = |i: usize| system.coordinates[i].name.as_str();
        let mut objects = Vec::new();
        for (&s, column) in self.independent.iter().zip(&self.columns) {
            for &d in &self.dependent {
                if !system.graph.is_zero(column[d]) {
                    objects.push(NamedExpr::new(
                        format!("delta_{}_{}", name(d), name(s)),
                        column[d],
                        format!(
                            "δ{} of the virtual displacement with δ{} = 1",
                            name(d),
                            name(s)
                        ),
                    ));
                }
            }
        }
        objects
    }
}

/// The accelerations from n equations `e = 0` that are linear in them.
pub(crate) fn solve_for_accelerations(
    system: &System,
    equations: &[Expr],
) -> Result<Vec<Expr>, SolveError> {
    let g = &system.graph;
    let symbols: Vec<Symbol> = system.coordinates.iter().map(|c| c.a_symbol).collect();
    solve_linear(g, equations, &symbols)
}
