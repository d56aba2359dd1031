//! A model with everything resolved: plain data on one expression graph.

use std::collections::BTreeMap;
use std::sync::Arc;

use chetaev_symbolic::syntax::Relation;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};

use crate::drawing::Drawing;
use crate::mechanism::Mechanism;
use crate::source::{Place, Sources};
use crate::units::Unit;

/// A mechanical system as its author stated it.
///
/// All expressions belong to [`Model::graph`]. A coordinate `x` is the symbol `x` of order 0, its velocity the symbol
/// of order 1, and so on; controls likewise; parameters and the time `t` are symbols of order 0. Greek letters are
/// written out: `θ` is `theta`. Definitions stand in the expressions with their values, and are kept by name beside.
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph of all expressions below.
    pub graph: Arc<Graph>,
    /// Short name, usable as the name of a folder.
    pub name: String,
    /// One paragraph for a person; may be empty.
    pub description: String,
    /// Where the system comes from: one reference each.
    pub source: Vec<String>,
    /// Its short history; may be empty.
    pub history: String,
    /// The symbol `t`.
    pub time: Expr,
    /// Coordinates, in the order that numbers them everywhere.
    pub coordinates: Vec<Coordinate>,
    /// Parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// Functions u(t) prescribed from outside.
    pub controls: Vec<Control>,
    /// What may be taken for granted about signs and ranges; the ranges of parameters are not repeated here.
    pub assumptions: Vec<Assumption>,
    /// Named sub-expressions, each after those that it uses.
    pub defines: Vec<Definition>,
    /// Named masses, in the order of the file. Those that are definitions stand in the expressions with their values, and
    /// are among [`Model::defines`]; those with a law of their own are symbols of order 0, and their derivatives are rates.
    pub masses: Vec<Mass>,
    /// T, or L where T is not stated, with all named masses as symbols; `None` where the model names no masses or states
    /// neither.
    pub inertia_by_masses: Option<Expr>,
    /// Particles, in the order of the file.
    pub particles: Vec<Particle>,
    /// Whether [`Model::kinetic`] is the sum over the particles, because the model states neither T nor L.
    pub kinetic_from_particles: bool,
    /// Bodies, joints and contacts, where the model states any.
    pub mechanism: Option<Mechanism>,
    /// Kinetic energy T, where the model gives it or its particles.
    pub kinetic: Option<Expr>,
    /// Potential energy V, where the model gives it.
    pub potential: Option<Expr>,
    /// The Lagrangian L; T − V where these are given.
    pub lagrangian: Expr,
    /// Generalized forces Q_i that are not in L, at most one for each coordinate.
    pub forces: Vec<Force>,
    /// Reactive forces Ψ_s by coordinate, where the model states them.
    pub reactive_forces: Option<Vec<Force>>,
    /// Rayleigh's dissipation function R; it adds −∂R/∂v to the forces.
    pub rayleigh: Option<Expr>,
    /// Constraints f = left − right, in the order of the file.
    pub constraints: Vec<Constraint>,
    /// Coordinates whose velocities the author wants to be the independent ones.
    pub independent: Option<Vec<usize>>,
    /// Quasi-velocities by name, as expressions of q, v, t. The names may be used in every other expression.
    pub quasi_velocities: Vec<Definition>,
    /// The moving frame, where the model states its fields; field s belongs to quasi-velocity s.
    pub frame: Option<FrameFields>,
    /// Kinematic characteristics, where the model states them by formulas.
    pub characteristics: Option<CharacteristicFormulas>,
    /// Initial data.
    pub initial: Initial,
    /// How to compute the motion.
    pub simulation: Simulation,
    /// Steady motions, about which is linearized.
    pub steady: Vec<SteadyStated>,
    /// What is looked for along the motion.
    pub events: Vec<EventStated>,
    /// Candidate first integrals.
    pub integrals: Vec<Definition>,
    /// Quantities that are measured along a motion: functions of t, q, q', q'' and the multipliers. Nothing is claimed of them.
    pub sensors: Vec<Definition>,
    /// Forms of first integrals with unknown constants and functions.
    pub integral_forms: Vec<IntegralForm>,
    /// Operators for the variations of velocities.
    pub variations: Vec<Variation>,
    /// A complete integral of the equation of Hamilton and Jacobi.
    pub complete_integral: Option<CompleteIntegral>,
    /// Where such an integral holds on a part of the states only: the name of the integral, and an equation of the part.
    pub integral_conditions: Vec<IntegralCondition>,
    /// Equations of a paper, a student or another program, to be compared with the equations of motion.
    pub equations: Vec<StatedEquations>,
    /// Models that are said to have the same motion.
    pub twins: Vec<Twin>,
    /// Functions of (t, q) that may occur in first integrals and invariant measures, beside those that occur in the model.
    pub search: Vec<Definition>,
    /// The degree in the velocities up to which first integrals are searched, where it is more than usual.
    pub search_degree: Option<u32>,
    /// How to draw the system.
    pub drawing: Option<Drawing>,
    /// What the author expects to be found.
    pub expect: Expect,
    /// Integer sizes such as the number of links.
    pub sizes: Vec<(String, i64)>,
    /// Warnings of parameters and definitions that occur nowhere.
    pub unused: Vec<crate::Diagnostic>,
    /// Symbols in LaTeX by the names for which they are stated, as [`StatedSymbol`](chetaev_symbolic::print::StatedSymbol) reads them.
    pub symbols: BTreeMap<String, String>,
    /// Whether units are stated, and checked.
    pub has_units: bool,
    /// The texts it was read from, for diagnostics of later stages.
    pub sources: Sources,
    /// The same texts as they are embedded in a study.
    pub text: ModelText,
}

/// An equation of the states on which an integral holds.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegralCondition {
    /// The name of the integral.
    pub integral: String,
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
    /// As it is written.
    pub text: String,
}

/// A coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Its name.
    pub name: String,
    /// Its symbol of order 0.
    pub symbol: Expr,
    /// Its unit, where stated.
    pub unit: Option<Unit>,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is declared.
    pub place: Place,
}

/// A parameter: a constant of the system.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its symbol.
    pub symbol: Expr,
    /// What the model says it is, in terms of numbers, π and other parameters; in SI base units where units are stated.
    pub definition: Option<Expr>,
    /// The same with all other parameters replaced by their values: numbers, π and functions of them. None for a
    /// symbolic parameter and for one that depends on such a one.
    pub value: Option<Expr>,
    /// Closed range of values, each end free of symbols.
    pub range: Option<(Expr, Expr)>,
    /// Its unit, where stated.
    pub unit: Option<Unit>,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is declared.
    pub place: Place,
}

/// A function of the time that is prescribed from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Its name.
    pub name: String,
    /// Its symbol of order 0; its derivatives are the symbols of higher order.
    pub symbol: Expr,
    /// The function of t and the parameters, where stated.
    pub law: Option<Expr>,
    /// Its unit, where stated.
    pub unit: Option<Unit>,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is declared.
    pub place: Place,
}

/// A relation that holds by assumption.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumption {
    /// Left side.
    pub left: Expr,
    /// How the sides compare.
    pub relation: Relation,
    /// Right side.
    pub right: Expr,
    /// The whole statement as it is written; a chain `0 < a < b` gives two assumptions with the same text.
    pub text: String,
    /// Where it is stated.
    pub place: Place,
}

/// A named expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// Its name.
    pub name: String,
    /// What it stands for, free of other names.
    pub value: Expr,
    /// As it is written.
    pub text: String,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is stated.
    pub place: Place,
}

/// A form of a first integral, `a x'^2 + h(x)`, whose unknowns are to be solved for.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegralForm {
    /// The form, with a symbol for each unknown.
    pub form: Definition,
    /// What is unknown in it.
    pub unknowns: Vec<Unknown>,
}

/// An unknown constant, or an unknown function.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Its name, `h`.
    pub name: String,
    /// Its symbol in the form.
    pub symbol: Expr,
    /// What a function depends on: coordinates and the time; nothing for a constant.
    pub arguments: Vec<Expr>,
}

/// A linear differential operator for the variations of velocities, δv = A(δq).
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Its name.
    pub name: String,
    /// Pairs of a coordinate and the variation of its velocity, linear in symbols `delta_x` and their derivatives.
    pub relations: Vec<(usize, Expr)>,
    /// Where it is stated.
    pub place: Place,
}

/// A complete integral of the equation of Hamilton and Jacobi, `S = action + Σ ∫ g dq`.
#[derive(Clone, Debug, PartialEq)]
pub struct CompleteIntegral {
    /// The part of S in closed form, a function of (t, q) and the constants.
    pub action: Expr,
    /// The parameters that are its constants.
    pub constants: Vec<Symbol>,
    /// Pairs of a coordinate and a function g of it and the constants that is integrated over it.
    pub quadratures: Vec<(usize, Expr)>,
    /// What constants are on the motions of the system, put in after S was differentiated by them.
    pub motion: Vec<(Symbol, Expr)>,
    /// Where it is stated.
    pub place: Place,
}

/// Equations that somebody states as the equations of motion.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedEquations {
    /// Their name.
    pub name: String,
    /// Unknowns of their own beside accelerations and multipliers: symbols of order 0.
    pub unknowns: Vec<Symbol>,
    /// The equations, functions of t, q, q', q'', `lambda_NAME` and the unknowns.
    pub equations: Vec<StatedEquation>,
    /// A word about them; may be empty.
    pub description: String,
    /// Where they are stated.
    pub place: Place,
}

/// One equation of such.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedEquation {
    /// Its name, or its number from 1.
    pub name: String,
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
    /// As it is written.
    pub text: String,
}

/// Another model that is said to have the same motion.
#[derive(Clone, Debug)]
pub struct Twin {
    /// Its name.
    pub name: String,
    /// The other model, on a graph of its own.
    pub model: Box<Model>,
    /// Its coordinates as functions of ours and the time, in its order; on our graph.
    pub map: Vec<Expr>,
    /// Its parameters, and its controls where they have no law, by ours; on our graph.
    pub symbols: Vec<(String, Expr)>,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is stated.
    pub place: Place,
}

/// A named mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// Its name.
    pub name: String,
    /// Its symbol of order 0.
    pub symbol: Expr,
    /// How it changes.
    pub law: MassLaw,
    /// Its value or its rate as it is written.
    pub text: String,
    /// Its unit, where stated.
    pub unit: Option<Unit>,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is declared.
    pub place: Place,
}

/// How a named mass changes.
#[derive(Clone, Debug, PartialEq)]
pub enum MassLaw {
    /// It is this function of t, q, q' and other masses.
    Value(Expr),
    /// It is a state with this rate, a function of t, q, q' and masses.
    Rate {
        /// M'.
        rate: Expr,
        /// Its value at the start, an expression of parameters.
        initial: Expr,
    },
}

/// How the matter that a particle loses or gains leaves or arrives (Meshchersky).
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Thrust {
    /// With the velocity of the particle: no thrust.
    #[default]
    Isotropic,
    /// With this velocity u relative to the particle: R = μ' u.
    RelativeVelocity(Vec<Expr>),
    /// Against the velocity of the particle with this relative speed c: u = −c r'/|r'|.
    ExhaustSpeed(Expr),
    /// With this velocity w: R = μ' (w − r').
    AbsoluteVelocity(Vec<Expr>),
    /// The thrust R itself.
    Force(Vec<Expr>),
}

/// A particle: a point with a mass, moved by the coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Particle {
    /// Its name.
    pub name: String,
    /// Its mass μ(t, q, v), in which masses with a law of their own may occur.
    pub mass: Expr,
    /// Its Cartesian position r(q, t), one to three components; controls may occur.
    pub position: Vec<Expr>,
    /// The applied force F(q, v, t), as many components as the position has; zero where none is stated. It is not
    /// among [`Model::forces`].
    pub force: Vec<Expr>,
    /// The thrust of the matter that it loses or gains.
    pub thrust: Thrust,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is stated.
    pub place: Place,
}

/// A moving frame stated by its fields: v = X_0 + Σ η^s X_s, where η^s is the quasi-velocity s.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameFields {
    /// `fields[s][i]` is the component of the field X_s along coordinate i, a function of q and t. There are as many
    /// fields as coordinates.
    pub fields: Vec<Vec<Expr>>,
    /// The components of X_0, the velocity where all quasi-velocities vanish; functions of q and t.
    pub drift: Vec<Expr>,
    /// Where it is stated.
    pub place: Place,
}

/// Kinematic characteristics: q^(m) = φ(t, q, …, q^(m-1), P) for all coordinates, m the order of the constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct CharacteristicFormulas {
    /// Names of the parameters P.
    pub parameters: Vec<String>,
    /// m.
    pub order: u32,
    /// φ, by coordinate.
    pub formulas: Vec<Expr>,
    /// Where they are stated.
    pub place: Place,
}

/// A generalized force.
#[derive(Clone, Debug, PartialEq)]
pub struct Force {
    /// Number of the coordinate.
    pub coordinate: usize,
    /// The force Q as a function of q, v, t.
    pub value: Expr,
    /// As it is written.
    pub text: String,
    /// Where it is stated.
    pub place: Place,
}

/// A constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// Its name, or its number from 1 where it has none; its multiplier is `lambda_NAME`.
    pub name: String,
    /// f = left − right, exactly as stated: a holonomic constraint is not differentiated.
    pub f: Expr,
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
    /// The highest derivative of a coordinate in it; 0 for a holonomic constraint.
    pub order: u32,
    /// As it is written.
    pub text: String,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is stated.
    pub place: Place,
}

/// Initial data at the start of the run. What is given is fixed; everything else is free, with 0 as the first guess or the one stated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Initial {
    /// Given values by number of coordinate and order of derivative, free of coordinates and time.
    pub values: BTreeMap<(usize, u32), InitialValue>,
    /// Other data, such as `kappa_rolling` for the constrained extremum, or `lambda_law` for constraints of order 3.
    pub extra: Vec<ExtraInitialValue>,
    /// Whether a complete but inadmissible state may be changed by projection.
    pub project: bool,
    /// Which branch of the motion is followed where the constraints admit several, counted from 1.
    pub branch: Option<usize>,
}

/// A given initial value.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialValue {
    /// An expression of parameters.
    pub value: Expr,
    /// As it is written.
    pub text: String,
    /// Whether it is a first guess, near which the value is searched for, and not the value itself.
    pub is_guess: bool,
    /// Where it is stated.
    pub place: Place,
}

/// A given initial value of something that is not a coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtraInitialValue {
    /// Name, such as `kappa_rolling`.
    pub name: String,
    /// Order of differentiation.
    pub order: u32,
    /// An expression of parameters.
    pub value: Expr,
    /// Where it is stated.
    pub place: Place,
}

/// A steady motion that the model names.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyStated {
    /// Its name.
    pub name: String,
    /// Given values by number of coordinate and order of derivative (0 or 1), expressions of parameters.
    pub values: BTreeMap<(usize, u32), InitialValue>,
    /// The parameter over all of whose values it is spoken of.
    pub over: Option<Expr>,
    /// Where it is stated.
    pub place: Place,
}

/// Zeros of a function along the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct EventStated {
    /// Its name.
    pub name: String,
    /// The function, of t, q, q', q'', multipliers and parameters.
    pub value: Expr,
    /// As it is written.
    pub text: String,
    /// Which zeros count.
    pub zero: Zero,
    /// Whether the run ends at the first.
    pub stops: bool,
    /// A word about it; may be empty.
    pub description: String,
    /// Where it is stated.
    pub place: Place,
}

/// In which direction a function passes zero, along the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zero {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Either way.
    Both,
}

/// How to compute the motion. What the model leaves open is `None`, and the program decides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Simulation {
    /// Start of the run.
    pub t_start: Option<Expr>,
    /// End of the run; an expression of parameters.
    pub t_end: Option<Expr>,
    /// Relative tolerance.
    pub tolerance: Option<Rational>,
    /// Absolute tolerance.
    pub absolute_tolerance: Option<Rational>,
    /// Fixed step, for methods without an error estimate; an expression of parameters.
    pub step: Option<Expr>,
    /// Name of the method.
    pub method: Option<String>,
    /// The arithmetic of the run.
    pub precision: Option<Precision>,
    /// When to put out the state.
    pub output: Option<Output>,
    /// Most steps.
    pub max_steps: Option<u64>,
    /// Which variables are integrated.
    pub state: Option<StateKind>,
    /// Whether the state is projected on the constraints during the run.
    pub project: Option<bool>,
    /// Whether the first integrals that are found are kept by projection.
    pub keep_integrals: Option<bool>,
    /// The components on which the motion goes on where it is not determined: what vanishes there, with its text.
    pub crossings: Vec<(String, Expr)>,
    /// Where the value of each key stands that is given.
    pub places: Vec<(&'static str, Place)>,
}

impl Simulation {
    /// Where the value of a key stands.
    pub fn place(&self, key: &str) -> Option<Place> {
        let mut places = self.places.iter();
        places.find(|(own, _)| *own == key).map(|(_, place)| *place)
    }
}

/// When the state is put out.
#[derive(Clone, Debug, PartialEq)]
pub enum Output {
    /// At this many equal intervals.
    Points(u32),
    /// At these times, each an expression of parameters.
    Times(Vec<Expr>),
    /// At multiples of this time.
    Step(Expr),
}

/// The arithmetic of a run.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Doubles: about 16 digits.
    Double,
    /// Sums of two doubles: about 31 digits.
    DoubleDouble,
}

impl Precision {
    /// Every one, with its word in model files and on the command line.
    pub const WORDS: [(&'static str, Precision); 2] = [
        ("double", Precision::Double),
        ("double-double", Precision::DoubleDouble),
    ];

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Precision::Double => "double",
            Precision::DoubleDouble => "double-double",
        }
    }
}

/// Which variables are integrated.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum StateKind {
    /// Coordinates and independent velocities.
    Reduced,
    /// Coordinates and all velocities.
    Full,
}

/// What the author expects.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expect {
    /// Expected verdicts.
    pub verdicts: Vec<ExpectedVerdict>,
    /// An early stop that is expected.
    pub stop: Option<ExpectedStop>,
}

/// The expected verdict of a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedVerdict {
    /// Claim id without subject, such as `formulation.equivalent`.
    pub claim: String,
    /// What stands after `#`, such as `maggi`.
    pub subject: Option<String>,
    /// Verdicts that are accepted, as words of the catalogue; at least one.
    pub verdicts: Vec<String>,
    /// Where it is stated.
    pub place: Place,
}

/// An expected early stop.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedStop {
    /// About when; an expression of parameters.
    pub at: Option<Expr>,
    /// A word that the reason must contain; may be empty.
    pub reason: String,
    /// Where it is stated.
    pub place: Place,
}

/// The texts of a model, enough to read it again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ModelText {
    /// Path of the model file as it was given.
    pub path: String,
    /// The model file.
    pub text: String,
    /// Included files by path, in the order in which they were read.
    pub includes: Vec<(String, String)>,
    /// Overrides of parameters and sizes: name and value as they were given.
    pub overrides: Vec<(String, String)>,
}

impl Model {
    /// Number of coordinates, n.
    pub fn n(&self) -> usize {
        self.coordinates.len()
    }

    /// The coordinate of a number, differentiated `order` times.
    pub fn jet(&self, coordinate: usize, order: u32) -> Expr {
        self.graph.symbol(&self.coordinates[coordinate].name, order)
    }

    /// The number of the coordinate of a name; `θ` is found as `theta`.
    pub fn coordinate(&self, name: &str) -> Option<usize> {
        let name = chetaev_symbolic::syntax::names::normalized(name);
        self.coordinates
            .iter()
            .position(|coordinate| coordinate.name == name)
    }

    /// Whether a name varies with the time: a coordinate or a control.
    pub fn varies(&self, name: &str) -> bool {
        self.coordinates
            .iter()
            .any(|coordinate| coordinate.name == name)
            || self.controls.iter().any(|control| control.name == name)
    }

    /// The rate of a mass with a law of its own.
    pub fn mass_rate(&self, name: &str) -> Option<Expr> {
        self.masses.iter().find_map(|mass| match mass.law {
            MassLaw::Rate { rate, .. } if mass.name == name => Some(rate),
            _ => None,
        })
    }

    /// The initial value of a mass with a law of its own.
    pub fn initial_mass(&self, name: &str) -> Option<Expr> {
        self.masses.iter().find_map(|mass| match mass.law {
            MassLaw::Rate { initial, .. } if mass.name == name => Some(initial),
            _ => None,
        })
    }

    /// Symbols of the parameters with their values, where they have one: the input of a substitution.
    pub fn parameter_values(&self) -> Vec<(Expr, Expr)> {
        self.parameters
            .iter()
            .filter_map(|parameter| Some((parameter.symbol, parameter.value?)))
            .collect()
    }

    /// The name of a constraint's reaction multiplier.
    pub fn multiplier(&self, constraint: usize) -> String {
        format!("lambda_{}", self.constraints[constraint].name)
    }
}
