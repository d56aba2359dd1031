//! A constrained mechanical system: coordinates, Lagrangian, generalized forces, constraints.
//!
//! Everything derived here is exact. Indices: `i, j` run over the `n` coordinates, `l` over the constraints.

use crate::constraint::Constraint;
use crate::mass::{self, NamedMasses};
use crate::names::Names;
use crate::particles;
use chetaev_model::mechanism::Mechanism;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A generalized coordinate with its jet.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// The name in the model, for example `phi`.
    pub name: String,
    /// q.
    pub q: Expr,
    /// q'.
    pub v: Expr,
    /// q''.
    pub a: Expr,
    /// The symbol of q.
    pub q_symbol: Symbol,
    /// The symbol of q'.
    pub v_symbol: Symbol,
    /// The symbol of q''.
    pub a_symbol: Symbol,
}

impl Coordinate {
    /// The coordinate called `name` in `graph`.
    pub fn new(graph: &Graph, name: &str) -> Coordinate {
        Coordinate::derivative(graph, name, 0)
    }

    /// The derivative of order `order` of the coordinate called `name` in the place of the coordinate, with the two next
    /// ones: what constraints of order `order + 1` are conditions on.
    pub fn derivative(graph: &Graph, name: &str, order: u32) -> Coordinate {
        Coordinate {
            name: name.to_string(),
            q: graph.symbol(name, order),
            v: graph.symbol(name, order + 1),
            a: graph.symbol(name, order + 2),
            q_symbol: graph.intern_symbol(name, order),
            v_symbol: graph.intern_symbol(name, order + 1),
            a_symbol: graph.intern_symbol(name, order + 2),
        }
    }
}

/// What a model says of a name to its reader; nothing is computed from it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NameNote {
    /// Its symbol in LaTeX, where stated.
    pub latex: Option<String>,
    /// Its unit as it is written; may be empty.
    pub unit: String,
    /// What it is; may be empty.
    pub description: String,
}

/// A parameter: a symbol that does not move.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name in the model.
    pub name: String,
    /// Its symbol as an expression.
    pub expr: Expr,
    /// Its exact value, an expression without free symbols; `None` for a purely symbolic parameter.
    pub value: Option<Expr>,
}

/// A control u(t): prescribed in time, never varied.
#[derive(Clone, Debug)]
pub struct ControlFunction {
    /// The name in the model.
    pub name: String,
    /// u as a function of t and parameters, where the model states it.
    pub law: Option<Expr>,
}

/// A quasi-velocity stated by the user, linear in the velocities.
#[derive(Clone, Debug)]
pub struct QuasiVelocity {
    /// The name in the model.
    pub name: String,
    /// Its definition in q, q', t.
    pub definition: Expr,
}

/// A moving frame stated by its fields, v = drift + Σ η^s X_s; its quasi-velocities are those of the system.
#[derive(Clone, Debug)]
pub struct FrameFields {
    /// `fields[s][i]`, component of X_s along coordinate i, functions of (q, t).
    pub fields: Vec<Vec<Expr>>,
    /// The components of X_0 along the coordinates.
    pub drift: Vec<Expr>,
}

/// Kinematic characteristics stated by formulas, `q^(m) = φ(t, q, …, q^(m-1), P)`, m the order of the constraints.
#[derive(Clone, Debug)]
pub struct CharacteristicFormulas {
    /// Names of the parameters P.
    pub parameters: Vec<String>,
    /// φ by coordinate.
    pub formulas: Vec<Expr>,
}

/// A form of a first integral, `a x'^2 + h(x)`, whose unknowns are to be solved for.
#[derive(Clone, Debug)]
pub struct IntegralForm {
    /// Its name.
    pub name: String,
    /// The form, with a symbol for each unknown.
    pub value: Expr,
    /// The unknown constants and functions.
    pub unknowns: Vec<Unknown>,
}

/// An unknown constant, or an unknown function.
#[derive(Clone, Debug)]
pub struct Unknown {
    /// Its symbol in the form.
    pub symbol: Expr,
    /// The coordinates and the time that a function depends on; none for a constant.
    pub arguments: Vec<Expr>,
}

/// A linear differential operator on virtual displacements for the variations of some velocities, δv = A(δq) (T1 (42)).
#[derive(Clone, Debug)]
pub struct VariationOperator {
    /// The name in the model.
    pub name: String,
    /// Pairs of a coordinate and δv of it, linear in symbols `delta_NAME` and their derivatives.
    pub relations: Vec<(usize, Expr)>,
}

/// A complete integral of the equation of Hamilton and Jacobi, `S = action + Σ ∫ g dq` (T1 §6.1).
#[derive(Clone, Debug)]
pub struct CompleteIntegral {
    /// The part of S in closed form, a function of (t, q) and the constants.
    pub action: Expr,
    /// Its constants.
    pub constants: Vec<Symbol>,
    /// Pairs of a coordinate and a function g of it and the constants that is integrated over it.
    pub quadratures: Vec<(usize, Expr)>,
    /// What constants are on the motions of the system, put in after S was differentiated by them.
    pub motion: Vec<(Symbol, Expr)>,
}

/// Equations that somebody states as the equations of motion.
#[derive(Clone, Debug)]
pub struct StatedEquations {
    /// Their name in the model.
    pub name: String,
    /// Unknowns of their own.
    pub unknowns: Vec<Symbol>,
    /// Triples (name, left, right), functions of (t, q, q', q''), of `lambda_NAME` and the unknowns.
    pub equations: Vec<(String, Expr, Expr)>,
}

/// Another system that is said to have the same motion.
#[derive(Clone, Debug)]
pub struct Twin {
    /// Its name in the model.
    pub name: String,
    /// The other system, on a graph of its own.
    pub system: Arc<System>,
    /// Its coordinates as functions of (q, t), by its coordinates.
    pub map: Vec<Expr>,
    /// Its parameters and controls by ours.
    pub symbols: Vec<(String, Expr)>,
}

/// A mass with a law of its own, M' = Φ(t, q, v, M): a state beside the coordinates.
#[derive(Clone, Debug)]
pub struct MassVariable {
    /// The name in the model.
    pub name: String,
    /// M.
    pub expr: Expr,
    /// Its symbol.
    pub symbol: Symbol,
    /// Φ.
    pub rate: Expr,
}

/// How the matter that a particle loses or gains leaves or arrives (Meshchersky; T2 (1)).
#[derive(Clone, Debug, Default)]
pub enum Thrust {
    /// With the velocity of the particle: R = 0.
    #[default]
    Isotropic,
    /// With the velocity u relative to the particle: R = μ' u.
    RelativeVelocity(Vec<Expr>),
    /// Against the velocity of the particle with the relative speed c: u = −c ξ'/|ξ'|.
    ExhaustSpeed(Expr),
    /// With the velocity w: R = μ' (w − ξ').
    AbsoluteVelocity(Vec<Expr>),
    /// R itself.
    Force(Vec<Expr>),
}

/// A particle: a mass at a place that the coordinates give, under an applied force.
#[derive(Clone, Debug)]
pub struct Particle {
    /// The name in the model.
    pub name: String,
    /// Its mass μ(t, q, v), in which masses with a law of their own may occur.
    pub mass: Expr,
    /// Its one to three Cartesian coordinates as functions of (q, t).
    pub position: Vec<Expr>,
    /// The components of the applied force, functions of (q, v, t).
    pub force: Vec<Expr>,
    /// The thrust of the matter that it loses or gains.
    pub thrust: Thrust,
}

/// A steady motion that the model names: what is given of it.
#[derive(Clone, Debug)]
pub struct SteadyMotion {
    /// Its name, the subject of claims.
    pub name: String,
    /// q, where given; length n.
    pub positions: Vec<Option<Expr>>,
    /// q', where given; length n.
    pub velocities: Vec<Option<Expr>>,
    /// Which of them are guesses, near which the motion is searched for: the coordinate, and the order of its derivative, 0 or 1.
    pub guesses: Vec<(usize, u32)>,
    /// The parameter over all of whose values it is spoken of, where the model names one.
    pub over: Option<Symbol>,
}

/// How a sign or range is assumed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `left < right`
    Less,
    /// `left <= right`
    LessOrEqual,
    /// `left != right`
    NotEqual,
}

/// An assumption of the model, `left REL right`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumption {
    /// The smaller side.
    pub left: Expr,
    /// The relation.
    pub relation: Relation,
    /// The larger side.
    pub right: Expr,
    /// As the model states it.
    pub text: String,
}

/// The plain content of a system, before anything is derived.
#[derive(Clone, Debug, Default)]
pub struct SystemParts {
    /// A name for people.
    pub name: String,
    /// Names of the coordinates, in order.
    pub coordinates: Vec<String>,
    /// Parameters with their exact values where known.
    pub parameters: Vec<(String, Option<Expr>)>,
    /// Controls with their laws where stated.
    pub controls: Vec<(String, Option<Expr>)>,
    /// Kinetic energy, when stated apart.
    pub kinetic: Option<Expr>,
    /// Potential V, when stated apart.
    pub potential: Option<Expr>,
    /// L.
    pub lagrangian: Option<Expr>,
    /// Generalized forces by coordinate name.
    pub forces: Vec<(String, Expr)>,
    /// Rayleigh's dissipation function R; the force is `-∂R/∂v`.
    pub rayleigh: Option<Expr>,
    /// Constraints as (name, left - right).
    pub constraints: Vec<(String, Expr)>,
    /// Velocities the user wants independent, by coordinate name.
    pub independent: Vec<String>,
    /// Quasi-velocities as (name, definition).
    pub quasi_velocities: Vec<(String, Expr)>,
    /// Fields of a moving frame, one for each quasi-velocity.
    pub frame: Option<FrameFields>,
    /// Where the motion starts, as far as it is stated: a coordinate, the order of its derivative, the value.
    pub start: Vec<(String, u32, Expr)>,
    /// Kinematic characteristics by formulas.
    pub characteristics: Option<CharacteristicFormulas>,
    /// Particles; their applied forces count beside the generalized forces.
    pub particles: Vec<Particle>,
    /// Bodies, joints and contacts from which the rest was made.
    pub mechanism: Option<Mechanism>,
    /// Masses with a law of their own, as (name, rate).
    pub masses: Vec<(String, Expr)>,
    /// Named masses that are functions of t, q, q' and other masses, as (name, value).
    pub mass_functions: Vec<(String, Expr)>,
    /// Reactive forces by coordinate name, beside those of the particles.
    pub reactive_forces: Vec<(String, Expr)>,
    /// The masses in a kinetic energy that is stated, where they change isotropically.
    pub named_masses: Option<NamedMasses>,
    /// Parameters that are defined by others, with their definitions.
    pub definitions: Vec<(String, Expr)>,
    /// Names of the coordinates that are angles by their unit.
    pub angles: Vec<String>,
    /// Equations (left, right) of the states on which such a function is one, with its name and their text.
    pub integral_conditions: Vec<(String, Expr, Expr, String)>,
    /// Functions of (t, q) for the families in which integrals are searched, beside those that occur.
    pub search_functions: Vec<Expr>,
    /// The degree in the velocities up to which integrals are searched, where it is more than usual.
    pub search_degree: Option<u32>,
    /// Functions that the user expects to be first integrals, as (name, G).
    pub integrals: Vec<(String, Expr)>,
    /// Forms of first integrals with unknown constants and functions.
    pub integral_forms: Vec<IntegralForm>,
    /// Operators for the variations of velocities.
    pub variations: Vec<VariationOperator>,
    /// A complete integral of the equation of Hamilton and Jacobi that the model states.
    pub complete_integral: Option<CompleteIntegral>,
    /// Steady motions that the model names.
    pub steady: Vec<SteadyMotion>,
    /// Equations that are compared with the equations of motion.
    pub equations: Vec<StatedEquations>,
    /// Systems that are said to have the same motion.
    pub twins: Vec<Twin>,
    /// What the model says of its names to a reader.
    pub notes: BTreeMap<String, NameNote>,
    /// Assumptions.
    pub assumptions: Vec<Assumption>,
}

/// Why plain content is no system.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SystemError {
    /// No coordinates.
    #[error("a system needs at least one coordinate")]
    NoCoordinates,
    /// No Lagrangian.
    #[error("a system needs a Lagrangian: `L`, or `T` with or without `V`")]
    NoLagrangian,
    /// A name that is no coordinate.
    #[error("`{name}` is no coordinate ({role})")]
    UnknownCoordinate {
        /// The name given.
        name: String,
        /// Where it was used.
        role: &'static str,
    },
    /// A constraint without coordinates.
    #[error("constraint `{name}` contains no coordinate, so it restricts nothing")]
    NoCoordinateInConstraint {
        /// The constraint.
        name: String,
    },
    /// A constraint with a repeated factor.
    #[error("constraint `{name}` contains the {power} of {factor}: its gradient vanishes wherever {factor} is zero, so it has no rank and no reaction there; write {factor} without the power")]
    RepeatedFactor {
        /// The constraint.
        name: String,
        /// The factor.
        factor: String,
        /// "square", "cube", "4th power".
        power: String,
    },
    /// A mass in a stated kinetic energy contains velocities.
    #[error("the mass `{mass}` contains `{symbol}`, and T is stated: where a mass depends on velocities the equations follow from the particle law; state [particles] in the place of T, or the forces of the change under [reactive_forces]")]
    MassWithVelocity {
        /// The mass.
        mass: String,
        /// A velocity in it.
        symbol: String,
    },
    /// A mass in a Lagrangian that is stated as a whole contains coordinates.
    #[error("the mass `{mass}` contains `{symbol}`, and L is stated as a whole: what belongs to the kinetic energy is not known; state T and V apart, or the forces of the change under [reactive_forces]")]
    MassInLagrangian {
        /// The mass.
        mass: String,
        /// A coordinate in it.
        symbol: String,
    },
    /// The Lagrangian contains accelerations.
    #[error("the {what} contains `{symbol}`; only coordinates and velocities may occur in it")]
    OrderTooHigh {
        /// Lagrangian, force or dissipation function.
        what: String,
        /// The offending symbol.
        symbol: String,
    },
}

/// A constrained system.
#[derive(Clone, Debug)]
pub struct System {
    /// The graph all expressions live in.
    pub graph: Arc<Graph>,
    /// A name for people.
    pub name: String,
    /// The `n` coordinates.
    pub coordinates: Vec<Coordinate>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The controls.
    pub controls: Vec<ControlFunction>,
    /// Kinetic energy, when stated apart from V.
    pub kinetic: Option<Expr>,
    /// Potential V, when stated apart.
    pub potential: Option<Expr>,
    /// L(q, v, t).
    pub lagrangian: Expr,
    /// Generalized forces Qᵢ, those of Rayleigh's function and of the particles included; one per coordinate. They contain
    /// the reactive forces Ψᵢ, unless these contain accelerations, as they do where a mass contains velocities.
    pub forces: Vec<Expr>,
    /// Reactive forces Ψᵢ on the jet (q, v, a, t), of the particles and those stated; one per coordinate.
    pub reactive_forces: Vec<Expr>,
    /// Masses with a law of their own.
    pub masses: Vec<MassVariable>,
    /// Named masses that are functions of t, q, q' and other masses, as (name, value).
    pub mass_functions: Vec<(String, Expr)>,
    /// Rayleigh's dissipation function.
    pub rayleigh: Option<Expr>,
    /// All constraints as stated, redundant ones included.
    pub constraints: Vec<Constraint>,
    /// Coordinates whose velocities the user wants independent.
    pub independent: Vec<usize>,
    /// Quasi-velocities of the user.
    pub quasi_velocities: Vec<QuasiVelocity>,
    /// Fields of the user's moving frame, one for each quasi-velocity.
    pub frame: Option<FrameFields>,
    /// Where the motion starts, as far as it is stated: coordinates and derivatives with their values, expressions of the parameters.
    pub start: Vec<(Symbol, Expr)>,
    /// Kinematic characteristics by formulas.
    pub characteristics: Option<CharacteristicFormulas>,
    /// Particles of the model; their applied forces are contained in [`forces`](System::forces).
    pub particles: Vec<Particle>,
    /// Bodies, joints and contacts of the model; all else was made from them already.
    pub mechanism: Option<Mechanism>,
    /// Parameters that are defined by others, with their definitions; free symbols wherever nothing else is said.
    pub definitions: Vec<(Expr, Expr)>,
    /// Names of the coordinates that are angles by their unit.
    pub angles: Vec<String>,
    /// Equations (left, right) of the states on which such a function is one, with its name and their text.
    pub integral_conditions: Vec<(String, Expr, Expr, String)>,
    /// Functions of (t, q) for the families in which integrals are searched, beside those that occur.
    pub search_functions: Vec<Expr>,
    /// The degree in the velocities up to which integrals are searched, where it is more than usual.
    pub search_degree: Option<u32>,
    /// Functions that the model states as first integrals, with their names.
    pub integrals: Vec<(String, Expr)>,
    /// Forms of first integrals with unknown constants and functions.
    pub integral_forms: Vec<IntegralForm>,
    /// Operators for the variations of velocities that the model states.
    pub variations: Vec<VariationOperator>,
    /// A complete integral of the equation of Hamilton and Jacobi that the model states.
    pub complete_integral: Option<CompleteIntegral>,
    /// Steady motions that the model names.
    pub steady: Vec<SteadyMotion>,
    /// Equations that are compared with the equations of motion.
    pub equations: Vec<StatedEquations>,
    /// Systems that are said to have the same motion.
    pub twins: Vec<Twin>,
    /// Assumptions of the model.
    pub assumptions: Vec<Assumption>,
    /// What the model says of its names to a reader.
    pub notes: BTreeMap<String, NameNote>,
    /// Places of the coordinates by name.
    places: BTreeMap<String, usize>,
    /// Quantities that the model does not name.
    pub(crate) names: Names,
}

impl System {
    /// Functions of the place and the time that the constraints fix: the left sides of the holonomic ones.
    pub fn fixed_functions(&self) -> Vec<Expr> {
        let holonomic = self.constraints.iter().filter(|c| c.order == 0);
        holonomic.map(|c| c.stated).collect()
    }

    /// Builds a system and classifies its constraints.
    ///
    /// # Errors
    /// [`SystemError`] for the first inconsistency.
    pub fn new(graph: Arc<Graph>, parts: SystemParts) -> Result<System, SystemError> {
        if parts.coordinates.is_empty() {
            return Err(SystemError::NoCoordinates);
        }
        let g = &*graph;
        let coordinates: Vec<Coordinate> = parts
            .coordinates
            .iter()
            .map(|name| Coordinate::new(g, name))
            .collect();
        let lagrangian = match (parts.lagrangian, parts.kinetic, parts.potential) {
            (Some(l), _, _) => l,
            (None, Some(t), Some(v)) => g.sub(t, v),
            (None, Some(t), None) => t,
            (None, None, _) => return Err(SystemError::NoLagrangian),
        };
        let index = |name: &str, role: &'static str| {
            parts
                .coordinates
                .iter()
                .position(|c| c == name)
                .ok_or_else(|| SystemError::UnknownCoordinate {
                    name: name.to_string(),
                    role,
                })
        };
        let by_coordinate = |stated: &[(String, Expr)], role| {
            let mut forces = vec![g.zero(); coordinates.len()];
            for (name, force) in stated {
                let i = index(name, role)?;
                forces[i] = g.add(&[forces[i], *force]);
            }
            Ok(forces)
        };
        let mut forces = by_coordinate(&parts.forces, "generalized force")?;
        let reactive_forces = by_coordinate(&parts.reactive_forces, "reactive force")?;
        let symbols: Vec<Symbol> = coordinates.iter().map(|c| c.q_symbol).collect();
        let applied = particles::generalized_forces(g, &symbols, &parts.particles);
        for (force, applied) in forces.iter_mut().zip(applied) {
            *force = g.add(&[*force, applied]);
        }
        if let Some(r) = parts.rayleigh {
            let velocities: Vec<Symbol> = coordinates.iter().map(|c| c.v_symbol).collect();
            for (force, slope) in forces.iter_mut().zip(g.gradient(r, &velocities)) {
                *force = g.sub(*force, slope);
            }
        }
        let independent = parts
            .independent
            .iter()
            .map(|name| index(name, "independent velocity"))
            .collect::<Result<_, _>>()?;
        let mut system = System {
            name: parts.name,
            parameters: parameters(g, parts.parameters),
            controls: parts
                .controls
                .into_iter()
                .map(|(name, law)| ControlFunction { name, law })
                .collect(),
            kinetic: parts.kinetic,
            potential: parts.potential,
            lagrangian,
            forces,
            reactive_forces,
            masses: masses(g, parts.masses),
            mass_functions: parts.mass_functions,
            rayleigh: parts.rayleigh,
            constraints: Vec::new(),
            independent,
            quasi_velocities: parts
                .quasi_velocities
                .into_iter()
                .map(|(name, definition)| QuasiVelocity { name, definition })
                .collect(),
            frame: parts.frame,
            start: (parts.start.into_iter())
                .map(|(name, order, value)| (g.intern_symbol(&name, order), value))
                .collect(),
            characteristics: parts.characteristics,
            particles: parts.particles,
            mechanism: parts.mechanism,
            definitions: parts
                .definitions
                .into_iter()
                .map(|(name, value)| (g.symbol(&name, 0), value))
                .collect(),
            angles: parts.angles,
            integral_conditions: parts.integral_conditions,
            search_functions: parts.search_functions,
            search_degree: parts.search_degree,
            integrals: parts.integrals,
            integral_forms: parts.integral_forms,
            variations: parts.variations,
            complete_integral: parts.complete_integral,
            steady: parts.steady,
            equations: parts.equations,
            twins: parts.twins,
            notes: parts.notes,
            assumptions: parts.assumptions,
            places: places(&parts.coordinates),
            names: Names::default(),
            coordinates,
            graph: graph.clone(),
        };
        system.add_reactive_forces(parts.named_masses.as_ref())?;
        system.check_orders()?;
        for (name, stated) in parts.constraints {
            let constraint = Constraint::classify(&system, name, stated)?;
            system.constraints.push(constraint);
        }
        Ok(system)
    }

    /// Completes Ψ by that of the particles and of isotropic change, and adds it to the forces where it has no accelerations.
    fn add_reactive_forces(&mut self, named: Option<&NamedMasses>) -> Result<(), SystemError> {
        let g = Arc::clone(&self.graph);
        let of_particles = mass::reactive_forces(self);
        let isotropic = named
            .map(|named| mass::isotropic_change(self, named))
            .transpose()?;
        let beside: Vec<Expr> = match isotropic {
            Some(isotropic) => sums(&g, &self.reactive_forces, &isotropic),
            None => self.reactive_forces.clone(),
        };
        self.reactive_forces = sums(&g, &beside, &of_particles);
        let free = mass::with_velocity(self).is_none();
        let added = if free { &self.reactive_forces } else { &beside };
        self.forces = sums(&g, &self.forces, added);
        Ok(())
    }

    fn check_orders(&self) -> Result<(), SystemError> {
        let mut stated = vec![("Lagrangian".to_string(), self.lagrangian)];
        stated.extend(
            self.coordinates
                .iter()
                .zip(&self.forces)
                .map(|(c, &q)| (format!("generalized force on `{}`", c.name), q)),
        );
        for (what, e) in stated {
            for symbol in self.graph.symbols_in(&[e]) {
                let moving = self
                    .coordinate_index(self.graph.symbol_name(symbol))
                    .is_some();
                if moving && self.graph.symbol_order(symbol) > 1 {
                    let symbol = self.graph.symbol_text(symbol);
                    return Err(SystemError::OrderTooHigh { what, symbol });
                }
            }
        }
        Ok(())
    }

    /// n, the number of coordinates.
    pub fn n(&self) -> usize {
        self.coordinates.len()
    }

    /// The index of the coordinate called `name`.
    pub fn coordinate_index(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    /// Whether the symbol called `name` moves: a coordinate, a control, or a mass with a law of its own.
    pub fn moves(&self, name: &str) -> bool {
        self.coordinate_index(name).is_some() || self.is_prescribed(name)
    }

    /// Whether the symbol called `name` changes but is never varied: a control, or a mass with a law of its own.
    fn is_prescribed(&self, name: &str) -> bool {
        self.controls.iter().any(|u| u.name == name) || self.masses.iter().any(|m| m.name == name)
    }

    /// The rate in time of a symbol that is never varied: 1 of t, u' of a control, Φ of a mass with a law of its own.
    pub fn prescribed_rate(&self, symbol: Symbol) -> Option<Expr> {
        let g = &self.graph;
        let (name, order) = (g.symbol_name(symbol), g.symbol_order(symbol));
        if name == "t" && order == 0 {
            return Some(g.one());
        }
        if let Some(mass) = self.masses.iter().find(|m| m.symbol == symbol) {
            return Some(mass.rate);
        }
        let is_control = self.controls.iter().any(|u| u.name == name);
        is_control.then(|| g.symbol(name, order + 1))
    }

    /// The rates of the masses with a law of their own where the velocities are `velocities`.
    pub fn mass_rates(&self, velocities: &[Expr]) -> Vec<(Symbol, Expr)> {
        let rates: Vec<Expr> = self.masses.iter().map(|m| m.rate).collect();
        let pairs: Vec<(Expr, Expr)> = self
            .coordinates
            .iter()
            .zip(velocities)
            .filter(|(c, v)| c.v != **v)
            .map(|(c, &v)| (c.v, v))
            .collect();
        let restricted = self.graph.substitute_all(&rates, &pairs);
        self.masses
            .iter()
            .map(|m| m.symbol)
            .zip(restricted)
            .collect()
    }

    /// The total time derivative D along the jets; masses with a law of their own change by it.
    pub fn total_derivative(&self, e: Expr) -> Expr {
        let g = &self.graph;
        let rate = |s| {
            let (name, order) = (g.symbol_name(s), g.symbol_order(s));
            match self.coordinate_index(name) {
                Some(_) => Some(g.symbol(name, order + 1)),
                None => self.prescribed_rate(s),
            }
        };
        g.derive(&[self.defined(e)], &rate).swap_remove(0)
    }

    /// The same along the jets of further symbols too, given by name: multipliers with their derivatives.
    pub fn total_derivative_with(&self, e: Expr, further: &[String]) -> Expr {
        let g = &self.graph;
        let rate = |s| {
            let (name, order) = (g.symbol_name(s), g.symbol_order(s));
            let moves = self.coordinate_index(name).is_some() || further.iter().any(|f| f == name);
            match moves {
                true => Some(g.symbol(name, order + 1)),
                false => self.prescribed_rate(s),
            }
        };
        g.derive(&[self.defined(e)], &rate).swap_remove(0)
    }

    /// The explicit time derivative ∂/∂t with q and all its derivatives frozen; controls and masses with a law of their own
    /// count as time.
    pub fn time_derivative(&self, e: Expr) -> Expr {
        let rate = |s| self.prescribed_rate(s);
        self.graph.derive(&[e], &rate).swap_remove(0)
    }

    /// The assumptions as the model states them, each once: a chain such as `0 < a < b` is two assumptions of one text.
    pub fn assumption_texts(&self) -> Vec<&str> {
        let mut texts: Vec<&str> = Vec::new();
        for assumption in &self.assumptions {
            if !texts.contains(&assumption.text.as_str()) {
                texts.push(&assumption.text);
            }
        }
        texts
    }

    /// Names of the quasi-velocities.
    pub fn quasi_names(&self) -> Vec<String> {
        self.quasi_velocities
            .iter()
            .map(|u| u.name.clone())
            .collect()
    }

    /// The symbols of q'.
    pub fn velocity_symbols(&self) -> Vec<Symbol> {
        self.coordinates.iter().map(|c| c.v_symbol).collect()
    }

    /// The symbols of q.
    pub fn coordinate_symbols(&self) -> Vec<Symbol> {
        self.coordinates.iter().map(|c| c.q_symbol).collect()
    }

    /// Whether `e` depends explicitly on the time (or on a control, or a mass with a law of its own).
    pub fn is_rheonomic(&self, e: Expr) -> bool {
        !self
            .graph
            .is_free_of(e, &|s| self.prescribed_rate(s).is_some())
    }

    /// m, the highest order of the constraints, at least 1.
    pub fn order(&self) -> u32 {
        self.constraints
            .iter()
            .map(|c| c.order)
            .max()
            .unwrap_or(1)
            .max(1)
    }

    /// Pairs (parameter, value) of all parameters with values, as a substitution.
    pub fn parameter_values(&self) -> Vec<(Expr, Expr)> {
        self.parameters
            .iter()
            .filter_map(|p| p.value.map(|value| (p.expr, value)))
            .collect()
    }

    /// A function with the parameters that others define replaced by their definitions.
    pub fn with_definitions(&self, e: Expr) -> Expr {
        // A definition may contain parameters with definitions of their own.
        let all = 0..self.definitions.len();
        all.fold(e, |e, _| self.graph.substitute(e, &self.definitions))
    }

    /// The value of a parameter when it is a rational number.
    pub fn parameter_rational(&self, name: &str) -> Option<Rational> {
        let parameter = self.parameters.iter().find(|p| p.name == name)?;
        self.graph.as_number(parameter.value?).cloned()
    }

    /// The energy `H = Σ pᵢ vⁱ - L` as a function of (q, v, t).
    pub fn energy(&self) -> Expr {
        let g = &self.graph;
        let momenta = g.gradient(self.lagrangian, &self.velocity_symbols());
        let mut parts: Vec<Expr> = self
            .coordinates
            .iter()
            .zip(momenta)
            .map(|(c, momentum)| g.mul(&[momentum, c.v]))
            .collect();
        parts.push(g.neg(self.lagrangian));
        g.add(&parts)
    }

    /// Q without Ψ.
    pub fn applied_forces(&self) -> Vec<Expr> {
        let g = &self.graph;
        let contained = match mass::with_velocity(self) {
            None => self.reactive_forces.clone(),
            // Those of the particles contain accelerations, and stand apart.
            Some(_) => {
                let apart = mass::reactive_forces(self).into_iter();
                let pairs = self.reactive_forces.iter().zip(apart);
                pairs.map(|(&all, own)| g.sub(all, own)).collect()
            }
        };
        let pairs = self.forces.iter().zip(contained);
        pairs.map(|(&force, own)| g.sub(force, own)).collect()
    }

    /// Q + Ψ on the jet (q, v, a, t), with accelerations where a mass contains velocities.
    pub fn all_forces(&self) -> Vec<Expr> {
        match mass::with_velocity(self) {
            None => self.forces.clone(),
            Some(_) => sums(&self.graph, &self.forces, &mass::reactive_forces(self)),
        }
    }

    /// Euler's operator with the sign of Lagrange's left side: `D(∂L/∂vⁱ) - ∂L/∂qⁱ` on the jet (q, v, a, t).
    pub fn lagrange_left_sides(&self) -> Vec<Expr> {
        self.left_sides_of(self.lagrangian)
    }

    /// `D(∂F/∂vⁱ) - ∂F/∂qⁱ` of a function of (q, v, t).
    pub(crate) fn left_sides_of(&self, f: Expr) -> Vec<Expr> {
        let g = &self.graph;
        let momenta = g.gradient(f, &self.velocity_symbols());
        let slopes = g.gradient(f, &self.coordinate_symbols());
        momenta
            .into_iter()
            .zip(slopes)
            .map(|(momentum, slope)| g.sub(self.total_derivative(momentum), slope))
            .collect()
    }

    /// What the reactions balance, `D(∂L/∂vⁱ) - ∂L/∂qⁱ - Qᵢ - Ψᵢ` on the jet (q, v, a, t): by the particle law where a mass
    /// contains velocities (T2 (5)).
    pub fn motion_left_sides(&self) -> Vec<Expr> {
        if mass::with_velocity(self).is_some() {
            return mass::left_sides(self);
        }
        let lefts = self.lagrange_left_sides().into_iter().zip(&self.forces);
        lefts
            .map(|(left, &force)| self.graph.sub(left, force))
            .collect()
    }
}

/// Places by name; the first of equal names counts.
fn places(names: &[String]) -> BTreeMap<String, usize> {
    let mut places = BTreeMap::new();
    for (i, name) in names.iter().enumerate() {
        places.entry(name.clone()).or_insert(i);
    }
    places
}

fn parameters(g: &Graph, stated: Vec<(String, Option<Expr>)>) -> Vec<Parameter> {
    stated
        .into_iter()
        .map(|(name, value)| Parameter {
            expr: g.symbol(&name, 0),
            name,
            value,
        })
        .collect()
}

fn masses(g: &Graph, stated: Vec<(String, Expr)>) -> Vec<MassVariable> {
    stated
        .into_iter()
        .map(|(name, rate)| MassVariable {
            expr: g.symbol(&name, 0),
            symbol: g.intern_symbol(&name, 0),
            name,
            rate,
        })
        .collect()
}

fn sums(g: &Graph, a: &[Expr], b: &[Expr]) -> Vec<Expr> {
    a.iter().zip(b).map(|(&a, &b)| g.add(&[a, b])).collect()
}
