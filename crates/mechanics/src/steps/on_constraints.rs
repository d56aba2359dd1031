//! The equations of as many quasi-velocities as there are degrees of freedom: from the Lagrangian restricted to the constraints with
//! the curvature of these, and by Maggi's contraction.
//!
//! With φ and B = ∂φ/∂P of the characteristics, `L* = L(q, φ, t)`, `θ_i = ∂L/∂v^i` on the constraints and
//! `A^i_σ = D B_iσ − ∂φ^i/∂π_σ`,
//! `D(∂L*/∂P_σ) − ∂L*/∂π_σ − Σ_i θ_i A^i_σ = Σ_i ( D(∂L/∂v^i) − ∂L/∂q^i ) B_iσ` (Voronets 1901, Hamel 1904; T3 (11a)).

use super::lagrange::{state, with_multipliers};
use super::{Ground, Step, StepFormula, StepKind, Steps};
use crate::characteristics::Characteristics;
use crate::curvature::brackets;
use crate::equations::{unused_name, NamedExpr};
use crate::formulations::{
    bare, ignorable, maggi_left_sides, natural_characteristics, nielsen_left_sides,
    reduced_characteristics, solved_with_multipliers, Basis, DeriveError, Formulation, Reduced,
};
use crate::linear::dot;
use crate::mass;
use chetaev_symbolic::Expr;

/// Maggi's equations.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
pub(super) fn maggi(basis: &Basis<'_>) -> Result<Option<Steps>, DeriveError> {
    contracted(basis, basis.kinematic_characteristics()?)
}

/// Voronets' equations.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
pub(super) fn voronets(basis: &Basis<'_>) -> Result<Option<Steps>, DeriveError> {
    restricted(basis, natural_characteristics(basis)?, |steps, _| steps)
}

/// Chaplygin's equations.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
pub(super) fn chaplygin(basis: &Basis<'_>) -> Result<Option<Steps>, DeriveError> {
    restricted(basis, ignorable(basis)?, |steps, _| steps)
}

/// The equations in quasi-velocities; Lagrange's where nothing is constrained and the velocities are those of the coordinates.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
pub(super) fn reduced(basis: &Basis<'_>) -> Result<Option<Steps>, DeriveError> {
    let (c, _) = reduced_characteristics(basis)?;
    if basis.selection.rows.is_empty() && c.frame.is_natural(basis.system) {
        return with_multipliers(basis);
    }
    let equations = Reduced.equations(basis)?;
    let motion = equations.groups.iter().take(1).flat_map(|g| &g.equations);
    let motion: Vec<(Expr, Expr)> = motion.map(|e| (e.left, e.right)).collect();
    restricted(basis, c, |steps, rates| {
        steps.with_equations(StepKind::Shortened, motion, rates)
    })
}

/// From the restricted Lagrangian. `None` for constraints of higher order and where a mass contains velocities. With P' as found.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
fn restricted(
    basis: &Basis<'_>,
    c: Characteristics,
    further: impl FnOnce(Steps, &[(Expr, Expr)]) -> Steps,
) -> Result<Option<Steps>, DeriveError> {
    let Some(board) = Board::new(basis, c) else {
        return Ok(None);
    };
    let mut steps = board.begun();
    let parts = board.parts();
    board.write_restricted(&mut steps, &parts);
    let rates = board.rates(&parts.collected)?;
    let mut steps = further(steps, &rates);
    board.write_reactions(&mut steps, &rates)?;
    Ok(Some(steps))
}

/// By Maggi's contraction. `None` for constraints of higher order and where a mass contains velocities.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
fn contracted(basis: &Basis<'_>, c: Characteristics) -> Result<Option<Steps>, DeriveError> {
    let Some(board) = Board::new(basis, c) else {
        return Ok(None);
    };
    let mut steps = board.begun();
    let parts = board.parts();
    board.write_contracted(&mut steps, &parts);
    let rates = board.rates(&parts.collected)?;
    board.write_reactions(&mut steps, &rates)?;
    Ok(Some(steps))
}

/// What is written on.
struct Board<'a> {
    basis: &'a Basis<'a>,
    c: Characteristics,
}

/// The parts of the equations, each with its value on another way.
struct Parts {
    lagrangian: Expr,
    momenta: Both,
    rates: Both,
    slopes: Both,
    /// θ_i, length n.
    theta: Vec<Expr>,
    /// A^i_σ, n × k, row by row.
    brackets: Both,
    curvature: Both,
    forces: Vec<Expr>,
    /// `D p_σ − ∂L*/∂π_σ − C_σ`.
    left: Vec<Expr>,
    /// The same without the forces: what vanishes.
    collected: Vec<Expr>,
}

/// Values, and the same on another way.
struct Both {
    own: Vec<Expr>,
    other: Vec<Expr>,
}

impl<'a> Board<'a> {
    fn new(basis: &'a Basis<'a>, c: Characteristics) -> Option<Board<'a>> {
        let is_written = basis.terms.order == 1 && mass::with_velocity(basis.system).is_none();
        is_written.then_some(Board { basis, c })
    }

    /// What is stated, and the velocities on the constraints.
    fn begun(&self) -> Steps {
        let (basis, c) = (self.basis, &self.c);
        let (system, g) = (basis.system, &basis.system.graph);
        let mut steps = Steps {
            rates: c.parameters.iter().map(|p| p.rate).collect(),
            velocities: c.parameters.iter().map(|p| p.value).collect(),
            manifold: c.manifold.clone(),
            ..Steps::default()
        };
        state(&mut steps, basis);
        let chosen = c.parameters.iter().filter(|p| p.definition != p.value);
        let chosen = chosen.map(|p| (p.value, p.definition)).collect();
        steps.push(Step::stated(StepKind::QuasiVelocities, chosen));
        let kinematics = basis.kinematics(c).into_iter();
        let kinematics = kinematics.filter(|e| e.label != "constraint");
        let formulas = kinematics.map(|e| StepFormula {
            left: e.left,
            right: e.right,
            ground: Ground::Value(e.right),
        });
        // They satisfy the constraints, and are the velocities whose quasi-velocities are P.
        let mut conditions = c.restrict(system, &basis.constraints());
        let definitions: Vec<Expr> = c.parameters.iter().map(|p| p.definition).collect();
        let restricted = c.restrict(system, &definitions);
        let own = restricted.iter().zip(&c.parameters);
        conditions.extend(own.map(|(&e, p)| g.sub(e, p.value)));
        steps.push(Step {
            kind: StepKind::AdmissibleVelocities,
            formulas: formulas.collect(),
            conditions,
        });
        steps
    }

    fn parts(&self) -> Parts {
        let (basis, c) = (self.basis, &self.c);
        let (system, g) = (basis.system, &basis.system.graph);
        let theta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let theta = c.restrict(system, &theta);
        let lagrangian = c.restrict(system, &[system.lagrangian])[0];
        let momenta = Both {
            own: c.by_parameters(system, &[lagrangian]).concat(),
            other: c.contract(system, &theta),
        };
        let rates = Both {
            own: c.total_derivative(system, &momenta.own),
            other: c.total_derivative(system, &momenta.other),
        };
        let slopes = Both {
            own: c.by_quasi_coordinates(system, &[lagrangian]).concat(),
            other: self.slopes_by_chain_rule(&theta),
        };
        let brackets = Both {
            own: brackets(system, c).concat(),
            other: self.brackets_by_nielsen(),
        };
        let column = |all: &[Expr], s: usize| -> Vec<Expr> {
            all.iter().skip(s).step_by(c.k()).copied().collect()
        };
        let terms = |all: &[Expr]| -> Vec<Expr> {
            (0..c.k())
                .map(|s| dot(g, &theta, &column(all, s)))
                .collect()
        };
        let curvature = Both {
            own: terms(&brackets.own),
            other: terms(&brackets.other),
        };
        let forces = c.contract(system, &c.restrict(system, &system.forces));
        let left = |s: usize| {
            let further = [slopes.own[s], curvature.own[s]];
            g.sub(rates.own[s], g.add(&further))
        };
        let left: Vec<Expr> = (0..c.k()).map(left).collect();
        let collected = left.iter().zip(&forces);
        let collected = collected
            .map(|(&left, &force)| g.sub(left, force))
            .collect();
        Parts {
            lagrangian,
            momenta,
            rates,
            slopes,
            theta,
            brackets,
            curvature,
            forces,
            left,
            collected,
        }
    }

    /// `Σ_i B_iσ ∂L/∂q^i + Σ_j θ_j ∂φ^j/∂π_σ`.
    fn slopes_by_chain_rule(&self, theta: &[Expr]) -> Vec<Expr> {
        let (system, c) = (self.basis.system, &self.c);
        let g = &system.graph;
        let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
        let along = c.contract(system, &c.restrict(system, &slopes));
        let turning = c.by_quasi_coordinates(system, &c.velocities);
        let own = along.iter().enumerate();
        own.map(|(s, &along)| {
            let column = turning.iter().map(|row| &row[s]);
            g.add(&[along, dot(g, theta, column)])
        })
        .collect()
    }

    /// `∂(Dφ^i)/∂P_σ − 2 ∂φ^i/∂π_σ`, row by row.
    fn brackets_by_nielsen(&self) -> Vec<Expr> {
        let (system, c) = (self.basis.system, &self.c);
        let g = &system.graph;
        let slopes = c.by_parameters(system, &c.accelerations).concat();
        let turning = c.by_quasi_coordinates(system, &c.velocities).concat();
        let both = slopes.iter().zip(&turning);
        both.map(|(&a, &b)| g.sub(a, g.mul(&[g.integer(2), b])))
            .collect()
    }

    /// `letter_σ` of all parameters.
    fn names(
        &self,
        steps: &mut Steps,
        letter: &str,
        meaning: impl Fn(&str) -> String,
    ) -> Vec<Expr> {
        let system = self.basis.system;
        let name = |p: &crate::characteristics::Parameter| {
            let own = bare(&p.name);
            let name = unused_name(system, &format!("{letter}_{own}"));
            let symbol = system.graph.symbol(&name, 0);
            let named = NamedExpr::new(name, p.value, meaning(own));
            steps.names.push(named.with_indices(letter, &[], &[own]));
            symbol
        };
        self.c.parameters.iter().map(name).collect()
    }

    fn write_restricted(&self, steps: &mut Steps, parts: &Parts) {
        let (system, c) = (self.basis.system, &self.c);
        let g = &system.graph;
        let name = unused_name(system, "Lstar");
        let lagrangian = g.symbol(&name, 0);
        let named = NamedExpr::new(name, parts.lagrangian, "the Lagrangian on the constraints");
        steps.names.push(named.with_indices("L", &["*"], &[]));
        let own = [parts.lagrangian];
        steps.push(Step::values(
            StepKind::RestrictedLagrangian,
            &[lagrangian],
            &own,
            &own,
        ));
        let momenta = self.names(steps, "p", |own| format!("∂L*/∂{own}"));
        let (own, other) = (&parts.momenta.own, &parts.momenta.other);
        steps.push(Step::values(StepKind::Momenta, &momenta, own, other));
        let symbols = momenta.iter().filter_map(|&p| g.as_symbol(p));
        let rates: Vec<Expr> = symbols.map(|p| g.symbol(g.symbol_name(p), 1)).collect();
        let (own, other) = (&parts.rates.own, &parts.rates.other);
        steps.push(Step::values(StepKind::Rates, &rates, own, other));
        let slopes = self.names(steps, "S", |own| format!("∂L*/∂π of {own}"));
        let (own, other) = (&parts.slopes.own, &parts.slopes.other);
        steps.push(Step::values(StepKind::Slopes, &slopes, own, other));
        self.write_curvature(steps, parts);
        if !system.forces.iter().all(|&e| g.is_zero(e)) {
            let forces = self.names(steps, "R", |own| format!("force along {own}"));
            let own = &parts.forces;
            steps.push(Step::values(StepKind::ForcesAlong, &forces, own, own));
        }
        // Maggi's contraction, which knows neither L* nor brackets.
        let others = maggi_left_sides(system, c);
        let sides = parts.left.iter().zip(&parts.forces).zip(&others);
        let formula = |((&left, &right), &other)| StepFormula {
            left,
            right,
            ground: Ground::Difference(other),
        };
        steps.push(Step {
            kind: StepKind::Collected,
            formulas: sides.map(formula).collect(),
            conditions: Vec::new(),
        });
    }

    /// θ, A and their products, where there are constraints or quasi-velocities that are no rates.
    fn write_curvature(&self, steps: &mut Steps, parts: &Parts) {
        let (system, c) = (self.basis.system, &self.c);
        let g = &system.graph;
        let rows: Vec<usize> = (0..system.n())
            .filter(|i| {
                !parts.brackets.own[i * c.k()..(i + 1) * c.k()]
                    .iter()
                    .all(|&e| g.is_zero(e))
            })
            .collect();
        if rows.is_empty() {
            return;
        }
        let (mut theta, mut values) = (Vec::new(), Vec::new());
        let (mut names, mut own, mut other) = (Vec::new(), Vec::new(), Vec::new());
        for &i in &rows {
            let coordinate = &system.coordinates[i].name;
            let name = unused_name(system, &format!("theta_{coordinate}"));
            theta.push(g.symbol(&name, 0));
            values.push(parts.theta[i]);
            let meaning = format!("∂L/∂{coordinate}' on the constraints");
            let named = NamedExpr::new(name, parts.theta[i], meaning);
            steps
                .names
                .push(named.with_indices("theta", &[], &[coordinate]));
            for (s, p) in c.parameters.iter().enumerate() {
                let at = i * c.k() + s;
                if g.is_zero(parts.brackets.own[at]) {
                    continue;
                }
                let index = bare(&p.name);
                let name = unused_name(system, &format!("A_{coordinate}_{index}"));
                names.push(g.symbol(&name, 0));
                own.push(parts.brackets.own[at]);
                other.push(parts.brackets.other[at]);
                let meaning = format!("curvature of {coordinate}' by {index}");
                let named = NamedExpr::new(name, parts.brackets.own[at], meaning);
                steps
                    .names
                    .push(named.with_indices("A", &[coordinate], &[index]));
            }
        }
        steps.push(Step::values(
            StepKind::DependentMomenta,
            &theta,
            &values,
            &values,
        ));
        steps.push(Step::values(StepKind::Brackets, &names, &own, &other));
        let terms = self.names(steps, "C", |own| format!("curvature term of {own}"));
        let (own, other) = (&parts.curvature.own, &parts.curvature.other);
        steps.push(Step::values(StepKind::CurvatureTerms, &terms, own, other));
    }

    fn write_contracted(&self, steps: &mut Steps, parts: &Parts) {
        let (system, c) = (self.basis.system, &self.c);
        let g = &system.graph;
        let (mut names, mut values) = (Vec::new(), Vec::new());
        for (coordinate, row) in system.coordinates.iter().zip(&c.basis) {
            for (p, &value) in c.parameters.iter().zip(row).filter(|(_, &e)| !g.is_zero(e)) {
                let (i, index) = (&coordinate.name, bare(&p.name));
                let name = unused_name(system, &format!("B_{i}_{index}"));
                names.push(g.symbol(&name, 0));
                values.push(value);
                let meaning = format!("∂{i}'/∂{index}");
                let named = NamedExpr::new(name, value, meaning);
                steps.names.push(named.with_indices("B", &[i], &[index]));
            }
        }
        let virtual_ = Step::values(StepKind::VirtualDisplacements, &names, &values, &values);
        steps.push(virtual_.with_conditions(self.work_of_reactions()));
        let (mut names, lefts) = (Vec::new(), system.motion_left_sides());
        for coordinate in &system.coordinates {
            let i = &coordinate.name;
            let name = unused_name(system, &format!("E_{i}"));
            names.push(g.symbol(&name, 0));
            let named = NamedExpr::new(name, coordinate.v, format!("left side of {i}"));
            steps.names.push(named.with_indices("E", &[], &[i]));
        }
        let nielsen = nielsen_left_sides(system, 1)
            .into_iter()
            .zip(&system.forces);
        let nielsen: Vec<Expr> = nielsen.map(|(e, &force)| g.sub(e, force)).collect();
        steps.push(Step::values(StepKind::LeftSides, &names, &lefts, &nielsen));
        let sides = maggi_left_sides(system, c)
            .into_iter()
            .zip(&parts.collected);
        let formula = |(left, &other)| StepFormula {
            left,
            right: g.zero(),
            ground: Ground::Difference(other),
        };
        steps.push(Step {
            kind: StepKind::Contracted,
            formulas: sides.map(formula).collect(),
            conditions: Vec::new(),
        });
    }

    /// `Σ_i ∂f/∂v^i B_iσ` on the constraints: what the virtual displacements must satisfy.
    fn work_of_reactions(&self) -> Vec<Expr> {
        let (system, c) = (self.basis.system, &self.c);
        let rows = self.basis.jacobian().into_iter();
        rows.flat_map(|row| c.contract(system, &c.restrict(system, &row)))
            .collect()
    }

    /// P' from what is collected.
    fn rates(&self, collected: &[Expr]) -> Result<Vec<(Expr, Expr)>, DeriveError> {
        let rates = self.c.rates_from(self.basis.system, collected)?;
        let names = self.c.parameters.iter().map(|p| p.rate);
        Ok(names.zip(rates).collect())
    }

    /// The multipliers from the equations of the dependent coordinates.
    fn write_reactions(
        &self,
        steps: &mut Steps,
        rates: &[(Expr, Expr)],
    ) -> Result<(), DeriveError> {
        let (basis, c) = (self.basis, &self.c);
        let (system, g) = (basis.system, &basis.system.graph);
        let chosen = &basis.selection.dependent;
        if chosen.is_empty() {
            return Ok(());
        }
        let lambdas = basis.lambda_symbols();
        let lefts = c.on_jet(system, &system.motion_left_sides());
        let jacobian: Vec<Vec<Expr>> = (basis.jacobian().iter())
            .map(|row| c.restrict(system, row))
            .collect();
        let matrix: Vec<Vec<Expr>> = (chosen.iter())
            .map(|&d| jacobian.iter().map(|row| row[d]).collect())
            .collect();
        let formulas = chosen.iter().zip(&matrix).map(|(&d, slopes)| StepFormula {
            left: dot(g, &lambdas, slopes),
            right: lefts[d],
            ground: Ground::Value(lefts[d]),
        });
        steps.push(Step {
            kind: StepKind::ReactionEquations,
            formulas: formulas.collect(),
            conditions: Vec::new(),
        });
        let rights: Vec<Expr> = chosen.iter().map(|&d| lefts[d]).collect();
        let rights = g.substitute_all(&rights, rates);
        let values = g.solve(&matrix.concat(), &rights)?;
        // The bordered system of Routh's equations, which knows nothing of φ.
        let (_, others) = solved_with_multipliers(basis)?;
        let others = c.restrict(system, &others);
        steps.push(Step::values(
            StepKind::Reactions,
            &lambdas,
            &values,
            &others,
        ));
        Ok(())
    }
}
