//! The equations of Poincaré and Chetaev in a moving frame, with multipliers.
//!
//! `X(∂_sL) - Γ^w_s ∂_wL - X_sL = Q_s + λ_l ∂_s f^l`, `f^l = 0`, with L and f as functions of (t, q, η), `∂_s = ∂/∂η^s` and
//! `Γ^w_s = C^w_0s + C^w_us η^u` (T3 (2), (7); Poincaré 1901, Chetaev 1941). Linear in (η', λ).

use super::routh::multiplier_objects;
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::derive_along;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use crate::frame::{Frame, FrameOrigin};
use crate::linear::{dot, solve_with_multipliers};
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// Multiplier form in the frame of the model; without one, in the natural frame.
#[derive(Clone, Copy, Debug)]
pub struct PoincareChetaev;

static CARD: Card = Card {
    name: "poincare-chetaev",
    title: "Equations of Poincaré and Chetaev",
    statement: "Lagrange's equations in the quasi-velocities of a moving frame: the brackets of its fields add terms, the reactions are λ ∂f/∂η.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.frame-regular", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "rates of the n quasi-velocities and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[
        Source { key: "poincare1901", place: "" },
        Source { key: "chetaev1941", place: "" },
        Source { key: "zhao", place: "(7)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D(∂L/∂η^s) − Γ^w_s ∂L/∂η^w − X_s L = Q_s + Σ_l λ_l ∂f^l/∂η^s",
    latex: r"\frac{d}{dt}\frac{\partial L}{\partial \eta^s} - \Gamma^w_s \frac{\partial L}{\partial \eta^w} - X_s L = Q_s + \sum_l \lambda_l \frac{\partial f^l}{\partial \eta^s}",
};

impl Formulation for PoincareChetaev {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let form = InFrame::new(basis)?;
        let (rates, multipliers) = form.solve()?;
        let objects = multiplier_objects(basis, &multipliers);
        let indices = basis.constraint_indices();
        let mut equations = form
            .state(rates)
            .with_group("equations of motion", Some(SCHEMA), form.stated())
            .with_group("constraints", None, form.constraints())
            .with_group("kinematics", None, form.kinematics())
            .with_objects(frame_objects(basis.system, &form.frame))
            .with_objects(form.momenta())
            .with_objects(form.turning())
            .with_objects(objects);
        equations.multipliers = indices.into_iter().zip(multipliers).collect();
        Ok(equations)
    }
}

/// The fields of a frame and its structure coefficients, those that do not vanish; nothing for the natural frame, and no
/// coefficients where they are too many to read.
pub(super) fn frame_objects(system: &System, frame: &Frame) -> Vec<NamedExpr> {
    let g = &system.graph;
    if frame.is_natural(system) {
        return Vec::new();
    }
    let label = |s: usize| match s {
        0 => "0".to_string(),
        s => super::bare(&frame.speeds[s - 1].name).to_string(),
    };
    let mut objects = Vec::new();
    for (s, field) in std::iter::once(&frame.drift)
        .chain(&frame.fields)
        .enumerate()
    {
        for (c, &component) in system.coordinates.iter().zip(field) {
            if !g.is_zero(component) {
                let (s, i) = (label(s), &c.name);
                let meaning = format!("component of the field X_{s} along {i}");
                let object = NamedExpr::component(format!("X_{s}_{i}"), component, meaning);
                objects.push(object.with_indices("X", &[i], &[&s]));
            }
        }
    }
    if system.n() <= MOST_BRACKETS {
        for (w, s, u, c) in frame.structure_coefficients(system) {
            let (s, u, w) = (label(s), label(u), label(w));
            let meaning = format!("component of the bracket [X_{s}, X_{u}] along X_{w}");
            // The lower indices first: a number after a name would be read as the name's own index.
            let object = NamedExpr::component(format!("C_{s}_{u}_{w}"), c, meaning);
            objects.push(object.with_indices("C", &[&w], &[&s, &u]));
        }
    }
    objects
}

/// Brackets of more fields than these are not written out.
const MOST_BRACKETS: usize = 8;

/// L, f and Q as functions of (t, q, η).
struct InFrame<'a> {
    basis: &'a Basis<'a>,
    frame: Frame,
    lambdas: Vec<Expr>,
    /// X_0 + η^s X_s.
    velocities: Vec<Expr>,
    /// ∂L/∂η^s.
    momenta: Vec<Expr>,
    constraints: Vec<Expr>,
    /// ∂f^l/∂η^s, r × n.
    gradient: Vec<Vec<Expr>>,
    /// Left side minus Q_s on the jet (t, q, η, η').
    left: Vec<Expr>,
    forces: Vec<Expr>,
}

impl<'a> InFrame<'a> {
    fn new(basis: &'a Basis<'a>) -> Result<InFrame<'a>, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let (frame, origin) = match Frame::stated(system, basis.terms, basis.selection) {
            Some(stated) => stated?,
            None => (Frame::natural(system), FrameOrigin::Natural),
        };
        let speeds: Vec<Expr> = frame.speeds.iter().map(|s| s.value).collect();
        let symbols: Vec<Symbol> = frame.speeds.iter().map(|s| s.symbol).collect();
        let velocities = frame.velocities(system, &speeds);
        let pairs: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&velocities)
            .filter(|(c, v)| c.v != **v)
            .map(|(c, &v)| (c.v, v))
            .collect();
        let lagrangian = g.substitute(system.lagrangian, &pairs);
        let forces = g.substitute_all(&system.forces, &pairs);
        let constraints: Vec<Expr> = match origin {
            // An adapted frame has the constraint functions among its quasi-velocities.
            FrameOrigin::CompletedByConstraints | FrameOrigin::AdaptedVelocities => frame
                .adapted
                .iter()
                .map(|&(_, s)| frame.speeds[s].value)
                .collect(),
            _ => g.substitute_all(&basis.constraints(), &pairs),
        };
        let mut form = InFrame {
            momenta: g.gradient(lagrangian, &symbols),
            gradient: g.jacobian(&constraints, &symbols),
            forces: frame
                .fields
                .iter()
                .map(|field| dot(g, field, &forces))
                .collect(),
            lambdas: basis.lambda_symbols(),
            left: Vec::new(),
            basis,
            frame,
            velocities,
            constraints,
        };
        form.left = form.left_sides(lagrangian);
        Ok(form)
    }

    /// `X(∂_sL) - Γ^w_s ∂_wL - X_sL`, where Γ^w_s are the components of the bracket of the motion, with frozen η, and X_s.
    fn left_sides(&self, lagrangian: Expr) -> Vec<Expr> {
        let (system, g) = (self.basis.system, &self.basis.system.graph);
        let rates: Vec<(Symbol, Expr)> = self
            .frame
            .speeds
            .iter()
            .map(|s| (s.symbol, s.rate))
            .collect();
        let moved = derive_along(system, &self.momenta, &self.velocities, g.one(), &rates);
        let is_natural = self.frame.is_natural(system);
        self.frame
            .fields
            .iter()
            .zip(moved)
            .map(|(field, moved)| {
                let slope = derive_along(system, &[lagrangian], field, g.zero(), &[])[0];
                let mut parts = vec![moved, g.neg(slope)];
                if !is_natural {
                    let gamma = self.bracket_with_motion(field);
                    parts.push(g.neg(dot(g, &gamma, &self.momenta)));
                }
                g.add(&parts)
            })
            .collect()
    }

    /// The components along the frame of `[X_0 + η^u X_u, X_s]`, η frozen.
    fn bracket_with_motion(&self, field: &[Expr]) -> Vec<Expr> {
        let (system, g) = (self.basis.system, &self.basis.system.graph);
        let forward = derive_along(system, field, &self.velocities, g.one(), &[]);
        let backward = derive_along(system, &self.velocities, field, g.zero(), &[]);
        let bracket: Vec<Expr> = forward
            .into_iter()
            .zip(backward)
            .map(|(a, b)| g.sub(a, b))
            .collect();
        self.frame.components(system, &bracket)
    }

    /// Γ^w_s, those that do not vanish; nothing where they are too many to read.
    fn turning(&self) -> Vec<NamedExpr> {
        let (system, g) = (self.basis.system, &self.basis.system.graph);
        if self.frame.is_natural(system) || system.n() > MOST_BRACKETS {
            return Vec::new();
        }
        let label = |s: usize| super::bare(&self.frame.speeds[s].name).to_string();
        let mut objects = Vec::new();
        for (s, field) in self.frame.fields.iter().enumerate() {
            for (w, value) in self.bracket_with_motion(field).into_iter().enumerate() {
                if !g.is_zero(value) {
                    let (s, w) = (label(s), label(w));
                    let meaning =
                        format!("component of the bracket of the motion and X_{s} along X_{w}");
                    // The lower index first, as in the structure coefficients.
                    let object = NamedExpr::component(format!("Gamma_{s}_{w}"), value, meaning);
                    objects.push(object.with_indices("Gamma", &[&w], &[&s]));
                }
            }
        }
        objects
    }

    /// η' and λ from the equations and `X f = 0`.
    fn solve(&self) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
        let (system, g) = (self.basis.system, &self.basis.system.graph);
        let speeds = &self.frame.speeds;
        let frozen = derive_along(system, &self.constraints, &self.velocities, g.one(), &[]);
        let rates: Vec<Expr> = speeds.iter().map(|s| s.rate).collect();
        let pairs = self.left.iter().zip(&self.forces);
        let mut equations: Vec<Expr> = pairs.map(|(&left, &force)| g.sub(left, force)).collect();
        let rows = self.gradient.iter().zip(frozen);
        equations.extend(rows.map(|(row, frozen)| g.add(&[dot(g, row, &rates), frozen])));
        let symbols: Vec<Symbol> = speeds.iter().map(|s| s.rate_symbol).collect();
        Ok(solve_with_multipliers(
            g,
            &equations,
            &symbols,
            &self.gradient,
        )?)
    }

    fn state(&self, rates: Vec<Expr>) -> Equations {
        let variables = self
            .frame
            .speeds
            .iter()
            .zip(rates)
            .map(|(speed, rate)| StateVariable::of_speed(speed, rate))
            .collect();
        let system = self.basis.system;
        Equations::in_state(CARD.name, system, variables, self.velocities.clone())
    }

    fn stated(&self) -> Vec<Equation> {
        let g = &self.basis.system.graph;
        (0..self.left.len())
            .map(|s| {
                let mut right = vec![self.forces[s]];
                for (&lambda, row) in self.lambdas.iter().zip(&self.gradient) {
                    right.push(g.mul(&[lambda, row[s]]));
                }
                Equation {
                    label: self.frame.speeds[s].name.clone(),
                    left: self.left[s],
                    right: g.add(&right),
                }
            })
            .collect()
    }

    fn constraints(&self) -> Vec<Equation> {
        self.basis.constraints_as(&self.constraints)
    }

    fn kinematics(&self) -> Vec<Equation> {
        let coordinates = self.basis.system.coordinates.iter();
        coordinates
            .zip(&self.velocities)
            .filter(|(c, v)| c.v != **v)
            .map(|(c, &right)| Equation {
                label: c.name.clone(),
                left: c.v,
                right,
            })
            .collect()
    }

    fn momenta(&self) -> Vec<NamedExpr> {
        let speeds = self.frame.speeds.iter();
        speeds
            .zip(&self.momenta)
            .map(|(speed, &value)| {
                NamedExpr::new(
                    format!("p_{}", super::bare(&speed.name)),
                    value,
                    format!("∂L/∂({})", speed.name),
                )
            })
            .collect()
    }
}
