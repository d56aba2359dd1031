//! What a report says, as plain data: the only input of [`render`](crate::render).
//!
//! Nothing here knows mechanics. Formulas arrive already printed (MathML, text, LaTeX), numbers
//! arrive already computed. Every struct has a [`Default`], every field may be left out of the
//! JSON, and whatever is empty leaves no trace on the page. Numbers that are not finite are
//! written to JSON as `null` and read back as NaN.

use serde::{Deserialize, Serialize};

pub use crate::scene::{Animation, Element, Shape, Tint};

/// Everything one page says about one system.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Report {
    /// Title of the page: the name of the system.
    pub title: String,
    /// One line under the title.
    pub subtitle: Option<String>,
    /// The system in words, one paragraph each.
    pub description: Vec<String>,
    /// History of the problem, one paragraph each.
    pub history: Vec<String>,
    /// Where the problem and the expected results come from.
    pub sources: Vec<Source>,
    /// What was found, in sentences.
    pub found: Vec<Found>,
    /// n, r, k, the classification and the like.
    pub facts: Vec<Fact>,
    /// Parameters with their values.
    pub parameters: Vec<Parameter>,
    /// Assumptions that the proofs use.
    pub assumptions: Vec<Assumption>,
    /// The state at the initial time.
    pub initial: Vec<InitialValue>,
    /// Tables that introduce the system, one section for each.
    pub tables: Vec<Table>,
    /// Lagrangian, constraints, equations of motion, one section for each.
    pub sections: Vec<EquationSection>,
    /// Statements with verdict and evidence, in any order; the page groups them by the part of
    /// the id before the first dot, in the order of first appearance.
    pub claims: Vec<Claim>,
    /// The computed motion.
    pub trajectory: Option<Trajectory>,
    /// Further figures, not functions of the time of the trajectory (orders of convergence,
    /// variations of an action, …).
    pub figures: Vec<Figure>,
    /// Pictures of functions of two variables.
    pub maps: Vec<Map>,
    /// The motion beside another curve.
    pub comparison: Option<Comparison>,
    /// The moving picture.
    pub animation: Option<Animation>,
    /// The model file.
    pub model: Option<ModelSource>,
    /// Diagnostics a reader must see (warnings, early stop, budget exhausted), shown on top.
    pub notices: Vec<String>,
    /// How to get this page again.
    pub reproducibility: Reproducibility,
}

/// A table with a heading of its own.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Table {
    /// Anchor on the page.
    pub id: String,
    /// Its heading.
    pub title: String,
    /// What it shows, one paragraph each.
    pub explanation: Vec<String>,
    /// The headings of its columns.
    pub headings: Vec<String>,
    /// Its rows.
    pub rows: Vec<TableRow>,
    /// Figures under it.
    pub figures: Vec<Figure>,
    /// Pictures of functions of two variables under it.
    pub maps: Vec<Map>,
    /// Moving pictures under it.
    pub album: Option<Album>,
}

/// Moving pictures of which the reader chooses one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Album {
    /// Heading.
    pub title: String,
    /// What they show, one paragraph each.
    pub explanation: Vec<String>,
    /// What the reader chooses among, in a word.
    pub choice: String,
    /// The pictures, the first of which is shown at first.
    pub pictures: Vec<Shown>,
}

/// A moving picture of an album.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shown {
    /// Its name in the list.
    pub name: String,
    /// What it shows, a sentence.
    pub explanation: String,
    /// The picture.
    pub animation: Animation,
}

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct TableRow {
    /// One cell for each column.
    pub cells: Vec<Cell>,
    /// The row that the page is about.
    pub is_marked: bool,
}

/// What stands in a cell of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Cell {
    /// A text.
    pub text: String,
    /// Formulas behind it, separated by commas.
    pub formulas: Vec<Formula>,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Cell {
        Cell {
            text: text.to_owned(),
            formulas: Vec::new(),
        }
    }
}

/// A function of two variables on a rectangle, drawn in shades.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Map {
    /// Heading.
    pub title: String,
    /// What it shows, one paragraph each.
    pub explanation: Vec<String>,
    /// Name and ends of the horizontal variable.
    pub horizontal: (String, f64, f64),
    /// Name and ends of the vertical variable.
    pub vertical: (String, f64, f64),
    /// Number of columns.
    pub columns: usize,
    /// Values at the middles of cells, the lowest row first.
    #[serde(with = "crate::number::vector")]
    pub values: Vec<f64>,
    /// What it means where there is no value.
    pub absent: Option<String>,
    /// Curves drawn over it.
    pub outlines: Vec<Outline>,
    /// Both variables do not compare, so that the sides of the picture are not theirs.
    pub is_unscaled: bool,
}

/// A curve over a map.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Outline {
    /// What it is, written under the map once for all of this name.
    pub name: String,
    /// Its color.
    pub tint: Tint,
    /// Its points, in the variables of the map.
    pub points: Vec<(f64, f64)>,
}

/// A labelled value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Fact {
    /// What it is, for example "Independent velocities".
    pub label: String,
    /// Its value in words or digits.
    pub value: String,
    /// Formulas after the value, separated by commas.
    pub formulas: Vec<Formula>,
    /// The letter used for it, for example "k" (shown in italics).
    pub symbol: Option<String>,
    /// One explaining sentence.
    pub note: Option<String>,
    /// Full id of the claim that establishes it ("model.chaplygin", "formulation.equivalent#maggi").
    pub claim: Option<String>,
}

/// What was found about a subject.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Found {
    /// A word: "energy".
    pub subject: String,
    /// Sentences, each in a line of its own; subscripts as `λ_{blade}`.
    pub sentences: Vec<String>,
    /// Full ids of the claims that say more.
    pub claims: Vec<String>,
}

/// A bibliographic reference.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Source {
    /// The reference as printed.
    pub text: String,
    /// An `https:` or `http:` address; other schemes are shown as text. Never loaded by the page.
    pub link: Option<String>,
}

/// One formula in three notations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Formula {
    /// Presentation MathML: either a whole `<math>` element or its content. Elements and
    /// attributes that are not presentation MathML are shown as text.
    pub mathml: Option<String>,
    /// Plain text, as in a model file; shown where there is no MathML.
    pub text: String,
    /// LaTeX, for the copy button; without it the button is absent.
    pub latex: Option<String>,
}

/// A parameter of the model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Parameter {
    /// Its name.
    pub name: Formula,
    /// Its value as written or computed ("3/2", "0.25").
    pub value: Option<String>,
    /// The expression that it is the value of, if the model states one.
    pub stated: Option<Formula>,
    /// Its unit, if stated.
    pub unit: Option<String>,
    /// Its range, if stated.
    pub range: Option<String>,
    /// What it means.
    pub description: Option<String>,
}

/// An assumption on parameters or coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Assumption {
    /// The inequality.
    pub formula: Formula,
    /// Where it is used or why it is made.
    pub note: Option<String>,
}

/// One component of the initial state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct InitialValue {
    /// The coordinate or velocity.
    pub name: Formula,
    /// The value used by the computation.
    #[serde(with = "crate::number::scalar")]
    pub value: f64,
    /// The value as the model states it (W, π/6), when it is not the number itself.
    pub stated: Option<Formula>,
    /// Its unit, if known.
    pub unit: Option<String>,
    /// Who chose it.
    pub origin: Origin,
}

/// Where an initial value comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Stated by the model.
    #[default]
    Given,
    /// Not stated, zero by default and unchanged by the projection.
    Default,
    /// Completed or changed by projection onto the constraints.
    Projected,
}

/// A titled group of typeset equations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EquationSection {
    /// Anchor on the page; letters, digits, `.`, `-`. Empty: made from the title.
    pub id: String,
    /// Its heading.
    pub title: String,
    /// Name of the formulation the equations belong to ("Maggi"), if any.
    pub formulation: Option<String>,
    /// What the reader sees here, one paragraph each.
    pub explanation: Vec<String>,
    /// The equations, numbered by the page.
    pub equations: Vec<Equation>,
    /// Abbreviations used by all equations of the section.
    pub definitions: Vec<Definition>,
    /// Full id of the claim that proves the section, if any.
    pub claim: Option<String>,
    /// What stands open above a section that is shown closed: an exercise, whose solution the section is.
    pub exercise: Option<String>,
    /// Shown closed, opened by the reader; for long material.
    pub collapsed: bool,
    /// Whether the page leaves out its own numbers, as the equations have numbers of theirs.
    pub is_unnumbered: bool,
}

/// One typeset equation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Equation {
    /// The equation.
    pub formula: Formula,
    /// What it belongs to: a coordinate, a constraint's name.
    pub label: Option<String>,
    /// The label as a formula, shown in its place.
    pub name: Option<Formula>,
    /// A heading above the equation, where another part of the section begins.
    pub heading: Option<String>,
    /// A sentence shown in place of a formula that is not printed.
    pub omitted: Option<String>,
    /// A sentence under the equation.
    pub caption: Option<String>,
    /// The "where …" list of this equation.
    pub definitions: Vec<Definition>,
}

/// An entry of a "where" list.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Definition {
    /// The symbol or its defining equation.
    pub formula: Formula,
    /// What it is, in words.
    pub text: Option<String>,
}

/// A statement about the system with its verdict and evidence.
///
/// The fields are those of a verdict in `study.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Claim {
    /// Stable id without subject, for example `formulation.equivalent`.
    pub claim: String,
    /// What follows `#`, for example `maggi`.
    pub subject: Option<String>,
    /// The statement itself in words ("Maggi's equations give the accelerations of Routh's").
    pub title: Option<String>,
    /// The verdict.
    pub verdict: Verdict,
    /// How it was obtained: `exact`, `modular`, `structural`, `sampled`, …
    pub method: Option<String>,
    /// Where it holds: everywhere, on the constraint manifold, on a branch, off a singular set.
    pub on: Option<String>,
    /// One sentence a person understands.
    pub detail: String,
    /// What belongs to the sentence and stands in lines of its own, for example each family that was searched.
    pub lines: Vec<String>,
    /// How it was computed, for those who check it.
    pub computed: Option<String>,
    /// Proven bound on the probability of error, for example "2^-104".
    pub error_bound: Option<String>,
    /// Number of samples.
    pub samples: Option<u64>,
    /// Seed of the samples.
    pub seed: Option<u64>,
    /// Largest scaled residual, as text.
    pub residual: Option<String>,
    /// A counterexample, as text; line breaks are kept.
    pub counterexample: Option<String>,
    /// The equations of the subset on which a conditional claim holds, or the hypothesis that
    /// fails for a claim that does not apply.
    pub condition: Option<String>,
    /// Formulas that belong to the evidence.
    pub formulas: Vec<Equation>,
    /// Full ids of the claims this one rests on.
    pub requires: Vec<String>,
    /// The verdict the model declares as expected, if it does.
    pub expected: Option<Verdict>,
    /// Time spent.
    pub seconds: Option<f64>,
}

impl Claim {
    /// The full id, `claim#subject`: the anchor of the claim on the page.
    #[must_use]
    pub fn id(&self) -> String {
        match &self.subject {
            Some(subject) => format!("{}#{subject}", self.claim),
            None => self.claim.clone(),
        }
    }
}

/// The six answers to a question about a system.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Holds, by a proof.
    Proved,
    /// Holds at every sample; no proof.
    Numerical,
    /// Fails at a verified counterexample.
    Refuted,
    /// Fails in general, holds exactly on a stated subset.
    Conditional,
    /// A hypothesis fails.
    NotApplicable,
    /// No answer within the budget.
    #[default]
    Undecided,
}

impl Verdict {
    /// The six verdicts in the order of the legend.
    pub const ALL: [Verdict; 6] = [
        Verdict::Proved,
        Verdict::Numerical,
        Verdict::Refuted,
        Verdict::Conditional,
        Verdict::NotApplicable,
        Verdict::Undecided,
    ];

    /// The identifier used in `study.json` and in style sheets.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Verdict::Proved => "proved",
            Verdict::Numerical => "numerical",
            Verdict::Refuted => "refuted",
            Verdict::Conditional => "conditional",
            Verdict::NotApplicable => "not-applicable",
            Verdict::Undecided => "undecided",
        }
    }
}

/// A computed motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Trajectory {
    /// Times of the samples, increasing.
    #[serde(with = "crate::number::vector")]
    pub times: Vec<f64>,
    /// Unit of the times, "s" where the model has units.
    pub time_unit: Option<String>,
    /// What was recorded; each as long as `times`.
    pub series: Vec<Series>,
    /// What should keep its value, in the order of the table.
    pub conserved: Vec<Conserved>,
    /// Why the run ended.
    pub stop: Stop,
    /// Method, tolerances, steps, evaluations, estimated global error, ….
    pub statistics: Vec<Fact>,
    /// Where the independent velocities were chosen anew.
    pub chart_switches: Vec<ChartSwitch>,
    /// Events met, in the order of time along the run.
    pub events: Vec<EventMet>,
    /// Pairs of series drawn against each other.
    pub portraits: Vec<Portrait>,
    /// Names of the files with the full data ("trajectory.csv").
    pub files: Vec<String>,
}

/// A quantity that should keep its value along the motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Conserved {
    /// Its number or name.
    pub name: String,
    /// What it is.
    pub formula: Formula,
    /// The formula is too long to be printed.
    pub omitted: bool,
    /// What it belongs to, for example a symmetry, in words.
    pub origin: Option<String>,
    /// Its value at the start.
    #[serde(with = "crate::number::scalar")]
    pub start: f64,
    /// Name of the series with its drift, which then stands in this table and not in that of the other drifts.
    pub drift: Option<String>,
    /// The computation itself gave it its value, so that its drift says nothing.
    pub is_enforced: bool,
    /// Full id of the claim that states it.
    pub claim: Option<String>,
}

/// An event along the motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EventMet {
    /// Its time.
    pub time: f64,
    /// What happened, a sentence.
    pub detail: String,
}

/// One recorded quantity.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Series {
    /// Its name, unique in the trajectory, as in the model file (`x'`, `lambda_blade`).
    pub name: String,
    /// How it is shown, for example "λ_{blade}", where `_{…}` stands for a subscript; the name
    /// where absent.
    pub label: Option<String>,
    /// Its unit, if known.
    pub unit: Option<String>,
    /// The plot it belongs to.
    pub group: SeriesGroup,
    /// The values. Drifts may have either sign; their magnitude is drawn.
    #[serde(with = "crate::number::vector")]
    pub values: Vec<f64>,
    /// One explaining sentence.
    pub description: Option<String>,
    /// The bound that the magnitude is measured against, drawn as a line (drifts).
    pub tolerance: Option<f64>,
    /// Full id of the claim whose verdict is shown beside the largest magnitude (drifts); without
    /// it the magnitude is compared with the bound.
    pub claim: Option<String>,
}

/// Which plot a series belongs to; within a group, series of different unit are drawn apart.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum SeriesGroup {
    /// Generalized coordinates.
    Coordinates,
    /// Generalized velocities and quasi-velocities.
    Velocities,
    /// Accelerations.
    Accelerations,
    /// Multipliers and reactions.
    Multipliers,
    /// Energy and its parts.
    Energy,
    /// Integrals, stated and found.
    Integrals,
    /// Drifts of constraints, energy and integrals (logarithmic scale).
    Drifts,
    /// Estimated errors (logarithmic scale).
    Errors,
    /// Anything else.
    #[default]
    Other,
}

/// Why a run ended.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Stop {
    /// One sentence.
    pub reason: String,
    /// The run did not reach the end of the time span.
    pub early: bool,
    /// An early end that the model declares as expected.
    pub expected: bool,
}

/// A change of the independent velocities during a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ChartSwitch {
    /// When.
    #[serde(with = "crate::number::scalar")]
    pub time: f64,
    /// From what to what, and why.
    pub detail: String,
}

/// Two series drawn against each other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Portrait {
    /// Name of the series on the horizontal axis.
    pub horizontal: String,
    /// Name of the series on the vertical axis.
    pub vertical: String,
    /// Heading; made from the two names where absent.
    pub title: Option<String>,
    /// Same scale on both axes, for paths in a plane.
    pub equal: bool,
    /// Names of two series for a second curve in the same drawing, horizontal then vertical.
    pub beside: Option<(String, String)>,
}

/// A figure with its own horizontal axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Figure {
    /// Heading.
    pub title: String,
    /// What it shows, one paragraph each.
    pub explanation: Vec<String>,
    /// Name of the horizontal quantity.
    pub horizontal: String,
    /// Its unit.
    pub horizontal_unit: Option<String>,
    /// Its values.
    #[serde(with = "crate::number::vector")]
    pub abscissae: Vec<f64>,
    /// The curves; each as long as `abscissae`.
    pub series: Vec<Series>,
    /// Names of the axes of a plane in which the curves are drawn instead, with `abscissae` as their parameter: the series are then pairs,
    /// the horizontal and the vertical part of a curve, which has the name of the first.
    pub plane: Option<(String, String)>,
    /// Logarithmic horizontal axis.
    pub logarithmic_horizontal: bool,
    /// Logarithmic vertical axis.
    pub logarithmic_vertical: bool,
    /// Draw a mark at every value.
    pub marks: bool,
    /// Full id of the claim it illustrates.
    pub claim: Option<String>,
}

/// The motion beside another curve from the same state: a story with its figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Comparison {
    /// Heading.
    pub title: String,
    /// What is compared and what follows, one paragraph each.
    pub paragraphs: Vec<String>,
    /// What chooses the other curve, and how far apart both run.
    pub facts: Vec<Fact>,
    /// Full ids of the claims that the story rests on.
    pub claims: Vec<String>,
    /// The distance over the time.
    pub figures: Vec<Figure>,
    /// Show the first portrait of the trajectory here.
    pub has_path: bool,
}

/// The model file as the study read it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ModelSource {
    /// The file and its includes, the main file first.
    pub files: Vec<SourceFile>,
    /// Overrides given on the command line ("a=0.3").
    pub overrides: Vec<String>,
}

/// One file of a model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SourceFile {
    /// Its name as the user gave it.
    pub name: String,
    /// Its text (TOML).
    pub text: String,
}

/// What is needed to produce the page again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Reproducibility {
    /// Version of Chetaev.
    pub version: String,
    /// Seed of every random choice.
    pub seed: Option<u64>,
    /// The command, copied by a button.
    pub command: Option<String>,
    /// Further lines (machine-independent: revision, schema, budget, …).
    pub details: Vec<Fact>,
}
