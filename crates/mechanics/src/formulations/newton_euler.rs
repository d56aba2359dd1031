//! The equations of Newton and Euler.
//!
//! For every body the balance of momentum and that of moment of momentum about the centre of mass,
//!
//! `m r'' = F + Σ R`, `J ω̊ + Ω × Jω = M + Σ (ρ × R + C)`,
//!
//! with the force R and the torque C of the joint by which it hangs, opposite on what it hangs on. Each constraint of a contact or a closing
//! joint has a multiplier. A joint is smooth: along each of its motions the force and the torque have
//! the power of the force that is stated for the coordinate, and no other (J. Wittenburg, Dynamics of Multibody Systems, 2008,
//! §§ 3.1, 5.4). The Lagrangian is not used.

use super::{Basis, DeriveError, Formulation};
use crate::bodies::{self, cross, image, minus, plus};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{unused_name, Equation, Equations, NamedExpr, Schema};
use crate::linear::solve_linear;
use crate::mass;
use crate::particles;
use crate::system::System;
use chetaev_model::mechanism::{Mechanism, Vector};
use chetaev_symbolic::{Expr, Graph, Symbol};

/// Newton and Euler.
#[derive(Clone, Copy, Debug)]
pub struct NewtonEuler;

static CARD: Card = Card {
    name: "newton-euler",
    title: "The equations of Newton and Euler",
    statement: "Momentum and moment of momentum of every body change by its weight and by the reactions of its joints and contacts.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &[
        "model.bodies",
        "model.accelerations-unique",
        "model.constraints-linear",
    ],
    identity: None,
    unknowns: "accelerations of all coordinates, force and torque of every joint, and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "wittenburg2008", place: "§§ 3.1, 5.4" }],
};

const SCHEMA: Schema = Schema {
    text: "m r'' = F + Σ R,  J ω' + ω × J ω = M + Σ (ρ × R + C)",
    latex: r"m \ddot r = F + \sum R, \quad J \dot\omega + \omega \times J \omega = M + \sum (\rho \times R + C)",
};

impl Formulation for NewtonEuler {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let system = basis.system;
        let mechanism = system
            .mechanism
            .as_ref()
            .ok_or(DeriveError::NotStated("bodies"))?;
        let balances = Balances::new(basis, mechanism);
        let unknowns = balances.unknowns(basis);
        let residuals: Vec<Expr> = balances
            .all()
            .map(|e| system.graph.sub(e.left, e.right))
            .collect();
        let mut found = solve_linear(&system.graph, &residuals, &unknowns)?;
        let mut reactions = found.split_off(system.n());
        let multipliers = reactions.split_off(reactions.len() - basis.selection.rows.len());
        let objects = balances.objects(basis, &reactions, &multipliers);
        let equations = Equations::in_velocities(CARD.name, system, found)
            .with_group("momentum", Some(SCHEMA), balances.momentum)
            .with_group("moment of momentum", None, balances.moment)
            .with_group("smooth joints", None, balances.smooth)
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects(objects);
        Ok(equations.with_multipliers(basis.constraint_indices(), multipliers))
    }
}

/// The force and the torque of a joint as unknowns, and the point about which the torque is counted.
struct Joint {
    name: String,
    force: Vector,
    torque: Vector,
    point: Vector,
}

/// Force and torque about the centre of mass.
#[derive(Clone)]
struct Load {
    forces: [Vec<Expr>; 3],
    torques: [Vec<Expr>; 3],
}

impl Load {
    fn new() -> Load {
        Load {
            forces: Default::default(),
            torques: Default::default(),
        }
    }

    /// Adds a force at an arm from the centre, and a torque.
    fn add(&mut self, g: &Graph, force: Vector, arm: Vector, torque: Vector) {
        let torque = plus(g, torque, cross(g, arm, force));
        for i in 0..3 {
            self.forces[i].push(force[i]);
            self.torques[i].push(torque[i]);
        }
    }
}

/// All equations beside the constraints.
struct Balances {
    joints: Vec<Joint>,
    /// The forces on the particles that their guides exert.
    guides: Vec<(String, Vec<Expr>)>,
    momentum: Vec<Equation>,
    moment: Vec<Equation>,
    smooth: Vec<Equation>,
    constraints: Vec<Equation>,
}

/// Symbols of the components of a vector that nothing else is called.
fn symbols(system: &System, letter: &str, name: &str) -> Vector {
    ["x", "y", "z"].map(|axis| {
        let own = unused_name(system, &format!("{letter}_{name}_{axis}"));
        system.graph.symbol(&own, 0)
    })
}

impl Balances {
    fn new(basis: &Basis<'_>, mechanism: &Mechanism) -> Balances {
        let system = basis.system;
        let joints = mechanism.bodies.iter().map(|body| Joint {
            // A body has one joint by which it hangs, and two bodies may not have joints of one name.
            name: body.joint.clone(),
            force: symbols(system, "R", &body.joint),
            torque: symbols(system, "C", &body.joint),
            point: body.point,
        });
        let guides = system.particles.iter().map(|own| {
            let axes = ["x", "y", "z"].iter().zip(&own.position);
            let symbol = |axis: &str| {
                let name = unused_name(system, &format!("R_{}_{axis}", own.name));
                system.graph.symbol(&name, 0)
            };
            let force = axes.map(|(axis, _)| symbol(axis)).collect();
            (own.name.clone(), force)
        });
        let mut all = Balances {
            joints: joints.collect(),
            guides: guides.collect(),
            momentum: Vec::new(),
            moment: Vec::new(),
            smooth: Vec::new(),
            constraints: Vec::new(),
        };
        all.balance(basis, mechanism);
        all.guide(system);
        all.smooth(basis, mechanism);
        all.constrain(basis);
        all
    }

    fn all(&self) -> impl Iterator<Item = &Equation> {
        let balances = self.momentum.iter().chain(&self.moment);
        balances.chain(&self.smooth).chain(&self.constraints)
    }

    fn unknowns(&self, basis: &Basis<'_>) -> Vec<Symbol> {
        let g = &basis.system.graph;
        let accelerations = basis.system.coordinates.iter().map(|c| c.a);
        let joints = self
            .joints
            .iter()
            .flat_map(|j| j.force.into_iter().chain(j.torque));
        let guides = self.guides.iter().flat_map(|(_, force)| force.clone());
        accelerations
            .chain(joints)
            .chain(guides)
            .chain(basis.lambda_symbols())
            .filter_map(|e| g.as_symbol(e))
            .collect()
    }

    /// Newton's and Euler's equations of every body.
    fn balance(&mut self, basis: &Basis<'_>, mechanism: &Mechanism) {
        let (system, g) = (basis.system, &basis.system.graph);
        let loads = self.loads(basis, mechanism);
        for (body, load) in mechanism.bodies.iter().zip(loads) {
            let velocities = bodies::velocities(system, body);
            let rate = |v: Vector| v.map(|e| system.total_derivative(e));
            let accelerations = rate(velocities.center);
            let momentum = image(g, &body.inertia, velocities.omega);
            let turned = cross(g, velocities.turning, momentum);
            let changed = plus(g, image(g, &body.inertia, rate(velocities.omega)), turned);
            let changed = image(g, &body.rotation, changed);
            for (i, axis) in ["x", "y", "z"].iter().enumerate() {
                let label = format!("{}, {axis}", body.name);
                self.momentum.push(Equation {
                    label: label.clone(),
                    left: g.mul(&[body.mass, accelerations[i]]),
                    right: g.add(&load.forces[i]),
                });
                self.moment.push(Equation {
                    label,
                    left: changed[i],
                    right: g.add(&load.torques[i]),
                });
            }
        }
    }

    /// What acts on every body: its weight, its own joint, those of what hangs on it, stated forces, contacts and closing joints.
    fn loads(&self, basis: &Basis<'_>, mechanism: &Mechanism) -> Vec<Load> {
        let g = &basis.system.graph;
        let zero = [g.zero(); 3];
        let opposite = |v: Vector| v.map(|e| g.neg(e));
        let mut loads = vec![Load::new(); mechanism.bodies.len()];
        for (number, (body, joint)) in mechanism.bodies.iter().zip(&self.joints).enumerate() {
            loads[number].add(g, body.weight, zero, zero);
            let arm = minus(g, joint.point, mechanism.bodies[body.hinged].center);
            loads[body.hinged].add(g, joint.force, arm, joint.torque);
            if let Some(parent) = body.parent {
                let arm = minus(g, joint.point, mechanism.bodies[parent].center);
                loads[parent].add(g, opposite(joint.force), arm, opposite(joint.torque));
            }
        }
        let stated = mechanism
            .loads
            .iter()
            .map(|own| (own, own.force, own.torque));
        let names = basis.constraint_names().into_iter();
        let constrained = names.zip(basis.lambda_symbols());
        let constrained = constrained.filter_map(|(name, lambda)| {
            let own = mechanism.reaction(name)?;
            let times = |v: Vector| v.map(|e| g.mul(&[lambda, e]));
            Some((own, times(own.force), times(own.torque)))
        });
        for (own, force, torque) in stated.chain(constrained) {
            let arm = minus(g, own.point, mechanism.bodies[own.body].center);
            loads[own.body].add(g, force, arm, torque);
            if let Some(other) = own.other {
                let arm = minus(g, own.other_point, mechanism.bodies[other].center);
                loads[other].add(g, opposite(force), arm, opposite(torque));
            }
        }
        loads
    }

    /// Newton's equations of the particles.
    fn guide(&mut self, system: &System) {
        let g = &system.graph;
        for (particle, (_, guide)) in system.particles.iter().zip(&self.guides) {
            let velocity = particles::velocity(system, particle);
            let applied = mass::force_with_thrust(system, particle);
            for (i, rate) in velocity.into_iter().enumerate() {
                self.momentum.push(Equation {
                    label: format!("{}, {}", particle.name, ["x", "y", "z"][i]),
                    left: g.mul(&[particle.mass, system.total_derivative(rate)]),
                    right: g.add(&[applied[i], guide[i]]),
                });
            }
        }
    }

    /// Joints and guides are smooth: their power along each coordinate is that of the force which is stated for it, and of the
    /// constraints that the user states in coordinates.
    fn smooth(&mut self, basis: &Basis<'_>, mechanism: &Mechanism) {
        let (system, g) = (basis.system, &basis.system.graph);
        let symbols = system.velocity_symbols();
        let mut powers: Vec<Vec<Expr>> = vec![Vec::new(); symbols.len()];
        let mut add = |velocity: &[Expr], force: &[Expr]| {
            for (row, &component) in g.jacobian(velocity, &symbols).iter().zip(force) {
                for (own, &slope) in powers.iter_mut().zip(row) {
                    own.push(g.mul(&[component, slope]));
                }
            }
        };
        for (body, joint) in mechanism.bodies.iter().zip(&self.joints) {
            let own = Some(body.hinged);
            let [v, omega] = velocity_at(system, mechanism, own, joint.point);
            let [carried, turning] = velocity_at(system, mechanism, body.parent, joint.point);
            add(&minus(g, v, carried), &joint.force);
            add(&minus(g, omega, turning), &joint.torque);
        }
        // The forces of the coordinates contain those that are stated at points of bodies.
        for own in &mechanism.loads {
            let opposite = |v: Vector| v.map(|e| g.neg(e));
            let [v, omega] = velocity_at(system, mechanism, Some(own.body), own.point);
            let [carried, turning] = velocity_at(system, mechanism, own.other, own.other_point);
            add(&v, &own.force);
            add(&carried, &opposite(own.force));
            add(&minus(g, omega, turning), &own.torque);
        }
        for (particle, (_, guide)) in system.particles.iter().zip(&self.guides) {
            add(&particles::velocity(system, particle), guide);
        }
        let forces = bodies::further_forces(system, mechanism);
        let names = basis.constraint_names();
        let rows = basis.jacobian();
        let lambdas = basis.lambda_symbols();
        for (i, (own, force)) in powers.iter().zip(forces).enumerate() {
            // What moves no body, as a point of contact with coordinates of its own, has no power: there all multipliers balance.
            let is_idle = g.is_zero(g.add(own));
            let stated = names.iter().zip(&rows).zip(&lambdas);
            let stated =
                stated.filter(|((name, _), _)| is_idle || mechanism.reaction(name).is_none());
            let mut right: Vec<Expr> = stated
                .map(|((_, row), &lambda)| g.mul(&[lambda, row[i]]))
                .collect();
            right.push(force);
            self.smooth.push(Equation {
                label: system.coordinates[i].name.clone(),
                left: g.add(own),
                right: g.add(&right),
            });
        }
    }

    /// The constraints, differentiated.
    fn constrain(&mut self, basis: &Basis<'_>) {
        let (system, g) = (basis.system, &basis.system.graph);
        for &row in &basis.selection.rows {
            let accelerations: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
            let jacobian = &basis.terms.jacobian[row];
            self.constraints.push(Equation {
                label: String::new(),
                left: crate::linear::dot(g, jacobian, &accelerations),
                right: basis.terms.constraint_rate[row],
            });
        }
    }

    /// The reactions as named objects; where constraints are redundant they are not determined, and none is named.
    fn objects(&self, basis: &Basis<'_>, found: &[Expr], multipliers: &[Expr]) -> Vec<NamedExpr> {
        if basis.selection.rows.len() < basis.terms.constraints.len() {
            return Vec::new();
        }
        let g = &basis.system.graph;
        let joints = self.joints.iter().flat_map(|joint| {
            let force = joint.force.map(|e| (e, "force", joint.name.clone()));
            let torque = joint.torque.map(|e| (e, "torque", joint.name.clone()));
            force.into_iter().chain(torque)
        });
        let guides = self.guides.iter().flat_map(|(name, force)| {
            let all = force.iter();
            all.map(|&e| (e, "force of the guide", name.clone()))
        });
        let mut objects: Vec<NamedExpr> = joints
            .chain(guides)
            .zip(found)
            .filter(|(_, &value)| !g.is_zero(value))
            .map(|((symbol, what, name), &value)| {
                NamedExpr::component(g.text(symbol), value, format!("{what} of `{name}`"))
            })
            .collect();
        objects.extend(super::routh::multiplier_objects(basis, multipliers));
        objects
    }
}

/// The velocity of the point of a body that is at a place, and the angular velocity, along the axes of the ground.
fn velocity_at(
    system: &System,
    mechanism: &Mechanism,
    body: Option<usize>,
    point: Vector,
) -> [Vector; 2] {
    let g = &system.graph;
    let Some(body) = body.map(|number| &mechanism.bodies[number]) else {
        return [[g.zero(); 3]; 2];
    };
    let velocities = bodies::velocities(system, body);
    let omega = image(g, &body.rotation, velocities.omega);
    let arm = minus(g, point, body.center);
    [plus(g, velocities.center, cross(g, omega, arm)), omega]
}
