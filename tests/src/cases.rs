//! The published cases as data (`tests/published/reference-cases.json`), and the one adapter from a case to a model.

use crate::places;
use chetaev::model::{Loaded, ModelBuilder};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// The whole file.
#[derive(Clone, Debug, Deserialize)]
pub struct Published {
    /// Models with expected results.
    pub cases: Vec<Case>,
    /// Models that must be refused, stopped or warned about.
    pub rejections: Vec<Rejection>,
}

/// A name with an expression.
#[derive(Clone, Debug, Deserialize)]
pub struct Named {
    /// Name, with primes where it is a derivative.
    pub name: String,
    /// Expression as text.
    pub value: String,
}

/// A generalized force.
#[derive(Clone, Debug, Deserialize)]
pub struct Force {
    /// Coordinate.
    pub coordinate: String,
    /// Expression.
    pub value: String,
}

/// A named constraint.
#[derive(Clone, Debug, Deserialize)]
pub struct Constraint {
    /// Name.
    pub name: String,
    /// `left = right`.
    pub equation: String,
}

/// What case and rejection have in common: the system.
#[derive(Clone, Debug, Deserialize)]
pub struct Statement {
    /// Name of the case.
    pub id: String,
    /// `chetaev` or `vakonomic`.
    pub dynamics: String,
    /// Coordinates.
    pub coordinates: Vec<String>,
    /// Parameters, each after those it uses.
    pub parameters: Vec<Named>,
    /// Definitions, each after those it uses.
    pub define: Vec<Named>,
    /// L.
    pub lagrangian: String,
    /// Generalized forces.
    pub forces: Vec<Force>,
    /// Constraints.
    pub constraints: Vec<Constraint>,
    /// Initial values.
    pub initial: Vec<Named>,
    /// End of the run.
    pub t_end: String,
    /// The same system a second time, as particles of variable mass.
    #[serde(default)]
    pub particles: Vec<PublishedParticle>,
    /// Whether the model states them in the place of Lagrangian and forces.
    #[serde(skip)]
    pub as_particles: bool,
}

/// A particle of a case.
#[derive(Clone, Debug, Deserialize)]
pub struct PublishedParticle {
    /// Name.
    pub name: String,
    /// Mass.
    pub mass: String,
    /// Components of its position.
    pub position: Vec<String>,
    /// Components of the applied force.
    pub force: Vec<String>,
    /// How matter leaves or arrives: one key of a thrust with its components.
    pub mass_exchange: Option<BTreeMap<String, Vec<String>>>,
}

/// A model with expected results.
#[derive(Clone, Debug, Deserialize)]
pub struct Case {
    /// The system.
    #[serde(flatten)]
    pub statement: Statement,
    /// What a program must be able to do for the model.
    pub needs: Vec<String>,
    /// What is expected.
    pub checks: Vec<Check>,
}

/// One expectation.
#[derive(Clone, Debug, Deserialize)]
pub struct Check {
    /// In words.
    pub title: String,
    /// What a program must be able to do in addition.
    #[serde(default)]
    pub needs: Vec<String>,
    /// Absolute tolerance.
    pub tol_abs: f64,
    /// Expected.
    #[serde(flatten)]
    pub expected: Expected,
}

/// A time with a value, as texts.
pub type Sample = (String, String);

/// What is expected.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Expected {
    /// `expr` along the motion equals the values at the times.
    ClosedForm {
        /// Followed.
        expr: String,
        /// Times and values.
        at: Vec<Sample>,
        /// A closed form in parameters and t.
        formula: Option<String>,
    },
    /// The same; with `state`, at t = 0 of the model restarted with these initial values changed.
    Value {
        /// Followed.
        expr: String,
        /// Times and values.
        at: Vec<Sample>,
        /// Changed initial values.
        state: Option<Vec<Named>>,
    },
    /// `expr` keeps its value.
    Invariant {
        /// Followed.
        expr: String,
        /// Kept.
        value: String,
        /// A closed form in parameters.
        formula: Option<String>,
    },
    /// `expr` vanishes.
    Identity {
        /// Followed.
        expr: String,
    },
    /// A number of the motion as a whole.
    Scalar(Scalar),
    /// A run to 1.2 times `at` must stop there.
    Stop {
        /// When.
        at: String,
        /// Exit status.
        exit: u8,
        /// Words of the reason.
        contains: Vec<String>,
        /// Tends to zero there.
        vanishing: String,
    },
    /// The verdict of a claim.
    Claim {
        /// Its id.
        claim: String,
        /// The word.
        verdict: String,
    },
    /// Eigenvalues of a linearization.
    Eigenvalues {},
    /// Matrices of a linearization.
    Matrix {},
}

/// A number of the motion as a whole.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "quantity", rename_all = "snake_case")]
pub enum Scalar {
    /// When an expression vanishes.
    EventTime {
        /// Event.
        event: Event,
        /// Time.
        expected: String,
    },
    /// The value of an expression there.
    EventValue {
        /// Event.
        event: Event,
        /// Evaluated there.
        expr: String,
        /// Value.
        expected: String,
    },
    /// A parameter at which a linearization loses stability.
    CriticalParameter {},
    /// Divergence of the flow with a density.
    Divergence {},
}

/// The occurrence-th zero of `expr` after t = 0 in a direction.
#[derive(Clone, Debug, Deserialize)]
pub struct Event {
    /// Vanishes.
    pub expr: String,
    /// `up`, `down` or `any`.
    pub direction: String,
    /// Counted from 1.
    pub occurrence: usize,
}

/// A model that must be refused, stopped or warned about.
#[derive(Clone, Debug, Deserialize)]
pub struct Rejection {
    /// The system.
    #[serde(flatten)]
    pub statement: Statement,
    /// How.
    pub expect: Expectation,
    /// What happens when the initial state may be projected.
    pub with_projection: Option<WithProjection>,
}

/// How a rejection ends.
#[derive(Clone, Debug, Deserialize)]
pub struct Expectation {
    /// `error`, `stop` or `warning`.
    pub outcome: String,
    /// Exit status.
    pub exit: u8,
    /// Each must occur in the message; `a|b` means one of them.
    pub contains: Vec<String>,
    /// Time of a stop.
    pub at: Option<String>,
    /// Its tolerance.
    pub tol_abs: Option<f64>,
    /// Tends to zero there.
    pub vanishing: Option<String>,
}

/// What happens when the initial state may be projected.
#[derive(Clone, Debug, Deserialize)]
pub struct WithProjection {
    /// Exit status.
    pub exit: u8,
    /// Values of the projected state.
    pub state: Vec<Named>,
}

impl Published {
    /// Reads the published file.
    ///
    /// # Panics
    /// When it is not what its schema says.
    pub fn read() -> Published {
        let path = places::root().join("tests/published/reference-cases.json");
        let text =
            std::fs::read_to_string(path).expect("the published cases are in the repository");
        serde_json::from_str(&text).expect("the published cases follow their schema")
    }

    /// All cases, and behind each that states particles the same system as particles.
    pub fn with_particles(&self) -> Vec<Case> {
        let twice = |case: &Case| {
            let second = (!case.statement.particles.is_empty()).then(|| case.as_particles());
            std::iter::once(case.clone()).chain(second)
        };
        self.cases.iter().flat_map(twice).collect()
    }
}

impl Statement {
    /// The model of the statement, as a user of the library would state it; `changed` replaces initial values.
    pub fn model(&self, changed: &[Named], project: bool) -> Loaded {
        let mut builder = ModelBuilder::new(&self.id).coordinates(&self.coordinates);
        for item in &self.parameters {
            builder = builder.parameter(&item.name, &item.value);
        }
        for item in &self.define {
            builder = builder.define(&item.name, &item.value);
        }
        builder = match self.as_particles {
            true => self.particles.iter().fold(builder, particle),
            false => self.by_lagrangian(builder),
        };
        for constraint in &self.constraints {
            builder = builder.constraint(&constraint.name, &constraint.equation);
        }
        for item in self.initial.iter().chain(changed) {
            builder = builder.initial(&item.name, &item.value);
        }
        if project {
            builder = builder.project_initial(true);
        }
        builder.end(&self.t_end).build()
    }
}

impl Statement {
    fn by_lagrangian(&self, builder: ModelBuilder) -> ModelBuilder {
        let forces = self.forces.iter();
        forces.fold(builder.lagrangian(&self.lagrangian), |builder, force| {
            builder.force(&force.coordinate, &force.value)
        })
    }
}

fn particle(builder: ModelBuilder, of: &PublishedParticle) -> ModelBuilder {
    let builder = builder
        .particle(&of.name, &of.mass, &of.position)
        .particle_force(&of.name, &of.force);
    let exchange = of.mass_exchange.iter().flatten();
    exchange.fold(builder, |builder, (mode, components)| {
        builder.particle_thrust(&of.name, &format!("{{ {mode} = {components:?} }}"))
    })
}

/// What a program must be able to do for a case or a check, with why it cannot yet.
pub const NOT_COVERED: &[(&str, &str)] = &[
    ("controls", "no published case has controls"),
    (
        "linearization",
        "linearization about a steady motion is a later part of the motion",
    ),
];

impl Statement {
    /// The formulation by which the motion of the case is computed, where it is not that of the system.
    pub fn formulation(&self) -> Option<&'static str> {
        (self.dynamics == "vakonomic").then_some("vakonomic")
    }
}

impl Case {
    /// The same case, stated by its particles.
    fn as_particles(&self) -> Case {
        let mut case = self.clone();
        case.statement.as_particles = true;
        case.statement.id += " as particles";
        case
    }

    /// Why the case is not covered.
    pub fn not_covered(&self) -> Option<&'static str> {
        reason(&self.needs)
    }
}

impl Check {
    /// Why the check is not covered although its case is.
    pub fn not_covered(&self) -> Option<&'static str> {
        reason(&self.needs)
    }
}

fn reason(needs: &[String]) -> Option<&'static str> {
    let needs: BTreeSet<&str> = needs.iter().map(String::as_str).collect();
    NOT_COVERED
        .iter()
        .find(|(need, _)| needs.contains(need))
        .map(|(_, why)| *why)
}
