//! The arguments of every command.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

const EXIT: &str = "\
Exit status:
  0  done (also when an early stop was declared as expected, and when redundant constraints were reduced)
  1  a claim that the model declares as expected is not met, `verify` disagrees, or the
     witness of a principle refutes along the motion what is proved of the system
  2  the input is wrong: syntax, contradictory or rank-deficient constraints, a singular system
  3  the run stopped early or was interrupted
The highest of 2, 3, 1 in that order wins.";

/// From a model of a nonholonomic system to proved equations, a checked motion and a report.
#[derive(Parser, Debug)]
#[command(name = "chetaev", version, after_help = EXIT, propagate_version = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Decide every claim, compute the motion, write report.html, study.json and the trajectory
    Study(Study),
    /// Derive the equations of motion, or the Euler equations of a functional, and print them
    Derive(Derive),
    /// Tell what the variational principles say of a system; compare its motion with the constrained extremum
    Principles(Principles),
    /// Compute the motion only and write the trajectory
    Simulate(Simulate),
    /// Draw the motion as a picture: SVG, PNG, or scene.json
    Plot(Plot),
    /// Draw the motion as a film: GIF
    Film(Film),
    /// Find all steady motions: equilibria, and motions along which everything that matters is constant
    Steady(Steady),
    /// Linearize about a steady motion: exact matrices, characteristic polynomial, eigenvalues
    Linearize(Linearize),
    /// Decide the stability of a steady motion, also over a range of a parameter, with enclosed boundaries
    Stability(Stability),
    /// Follow steady motions or periodic orbits over a range of a parameter, with folds, branch points, Hopf points and multipliers
    Follow(Follow),
    /// Compute thousands of motions: parameters and initial values over ranges, from rows of a file, or at random
    Sweep(Sweep),
    /// Read a model and report everything wrong or doubtful in it
    Check(Check),
    /// Say what a claim states and how it is decided
    Explain(Explain),
    /// Replay the verdicts of a study.json by other random choices
    Verify(Verify),
    /// Write a commented model to start from
    New(New),
    /// Make a model of bodies and joints of a robot description: URDF or MJCF
    Import(Import),
    /// List, describe or copy the models that come with Chetaev
    Gallery(Gallery),
    /// Print a completion script for a shell
    Completions(Completions),
}

/// What every command that reads a model takes.
#[derive(Args, Debug)]
pub(crate) struct ModelArguments {
    /// The model file
    pub(crate) model: PathBuf,
    /// Override a parameter or a size, exactly: --set a=0.3 --set n=8
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev study gallery/chaplygin-sleigh/model.toml
  chetaev study gallery/trailer/model.toml --set n=8 --out out/trailer-8
  chetaev study gallery/elasticity/p4p/model.toml --set d=2
  chetaev study model.toml --claims model,formulations --budget 10
  chetaev study model.toml --show integrals
  chetaev study model.toml --t-end 100 --tolerance 1e-12 --json")]
pub(crate) struct Study {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Folder to write into [default: out/NAME, NAME of the model's folder or file]
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Groups (model, formulations, motion, principles, integrals, stability) and claim ids, separated by commas
    #[arg(long)]
    pub(crate) claims: Option<String>,
    /// Work for all claims together, in seconds of a usual machine (the same work everywhere; the clock stops what takes twice as long);
    /// more than 60 also make searches for integrals look at more
    #[arg(long, default_value_t = 60.0, allow_hyphen_values = true, value_parser = seconds)]
    pub(crate) budget: f64,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
    /// Print every claim with its verdict and evidence
    #[arg(long, conflicts_with = "json")]
    pub(crate) all: bool,
    /// Print the claims of a group (model, formulations, motion, principles, integrals, stability; again for several)
    #[arg(long, value_name = "GROUP", value_parser = group_names(), conflicts_with_all = ["all", "json"])]
    pub(crate) show: Vec<String>,
    /// Print study.json instead of the overview
    #[arg(long)]
    pub(crate) json: bool,
}

/// How the motion is computed.
#[derive(Args, Debug)]
pub(crate) struct MotionArguments {
    /// End of the run, an exact expression: --t-end 100 --t-end "20 pi/3" --t-end="-2 pi"
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub(crate) t_end: Option<String>,
    /// Relative tolerance
    #[arg(long, allow_hyphen_values = true)]
    pub(crate) tolerance: Option<f64>,
    /// Fixed step, an exact expression, required by runge-kutta-4: --step 0.01 --step "pi/400"
    #[arg(long, value_name = "H", allow_negative_numbers = true)]
    pub(crate) step: Option<String>,
    /// dormand-prince-853 (dop853), taylor, tsitouras-5 (tsit5) or runge-kutta-4 (rk4, with --step)
    #[arg(long)]
    pub(crate) method: Option<String>,
    /// Arithmetic of the motion: double-double has about 31 digits, for tolerances down to 1e-28 with the method taylor
    #[arg(long, value_enum)]
    pub(crate) precision: Option<Precision>,
    /// The formulation whose equations are integrated, in its own state; routh when left out
    #[arg(long, value_name = "NAME", value_parser = formulation_names())]
    pub(crate) formulation: Option<String>,
    /// Move inadmissible initial data to the nearest admissible state
    #[arg(long)]
    pub(crate) project: bool,
    /// Keep the first integrals that are found, by projection after each step of Routh's equations
    #[arg(long)]
    pub(crate) keep_integrals: bool,
    /// Which branch of the motion to follow where constraints of order two and more admit several, as they are listed
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub(crate) branch: Option<usize>,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev linearize gallery/whipple-bicycle/model.toml
  chetaev linearize gallery/double-pendulum/model.toml --about hanging
  chetaev linearize gallery/falling-rolling-disc/model.toml --about rolling --symbolic
  chetaev linearize gallery/whipple-bicycle/model.toml --outputs phi,delta --save bicycle.mat
  chetaev linearize gallery/chaplygin-sleigh/model.toml --all --outputs x
  chetaev linearize model.toml --about rest --json")]
pub(crate) struct Linearize {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// A motion of [steady.NAME], the number of one that `chetaev steady` finds, rest (at the initial positions), or start (the initial state)
    #[arg(long, value_name = "NAME")]
    pub(crate) about: Option<String>,
    /// Values of controls without a law and of parameters of a family: --at u=1/2,theta_0=0.3
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub(crate) at: Option<String>,
    /// Independent speeds of choice: velocities, or functions linear in them
    #[arg(long, value_name = "SPEED,...")]
    pub(crate) speeds: Option<String>,
    /// Outputs: functions of coordinates, velocities and controls; without it all variables
    #[arg(long, value_name = "OUTPUT,...")]
    pub(crate) outputs: Option<String>,
    /// Leave all parameters as symbols
    #[arg(long)]
    pub(crate) symbolic: bool,
    /// Put in the values of all parameters, that of the family of motions too: exact numbers alone
    #[arg(long, conflicts_with = "symbolic")]
    pub(crate) numbers: bool,
    /// Also in all variables, E z' = A z + B u with coordinates, velocities and multipliers; outputs may be functions of all coordinates
    #[arg(long)]
    pub(crate) all: bool,
    /// Write to a file in the format of its end: .npz (NumPy), .mat (MATLAB), .py (python-control), .tex, .json or .txt
    #[arg(long, value_name = "FILE")]
    pub(crate) save: Option<PathBuf>,
    /// Linearize along the motion from the initial state: A(t), the transition matrix and its exponents
    #[arg(long, conflicts_with_all = ["about", "at", "speeds", "outputs", "symbolic", "all", "save"])]
    pub(crate) along: bool,
    /// Print JSON: matrices as exact text, eigenvalues as pairs
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev steady gallery/double-pendulum/model.toml
  chetaev steady gallery/falling-rolling-disc/model.toml --symbolic
  chetaev stability gallery/double-pendulum/model.toml --about 2")]
pub(crate) struct Steady {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Leave all parameters as symbols, in general position
    #[arg(long)]
    pub(crate) symbolic: bool,
    /// Print JSON: values as exact text with their enclosures, families with their equations
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev follow gallery/watt-governor/model.toml --over eps=0.1:1 --plot governor.svg
  chetaev follow gallery/kapitza-pendulum/model.toml --about rest --set push=0 --orbit --period \"2 pi/Omega\" --over Omega=90:110
  chetaev follow gallery/double-pendulum/model.toml --about 1 --over g=1:20
  chetaev follow model.toml --orbit")]
pub(crate) struct Follow {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// A motion of [steady.NAME], the number of one that `chetaev steady` finds, rest or start: what is near it is searched
    #[arg(long, value_name = "NAME")]
    pub(crate) about: Option<String>,
    /// A parameter with a range, exact numbers: --over eps=0.1:1; without it one motion is found at the values of the model
    #[arg(long, value_name = "NAME=FROM:TO", allow_hyphen_values = true)]
    pub(crate) over: Option<String>,
    /// Follow periodic orbits, from the initial state or a named motion
    #[arg(long)]
    pub(crate) orbit: bool,
    /// The period, an expression of parameters; a guess of it where the equations do not contain the time
    #[arg(long, value_name = "T", requires = "orbit")]
    pub(crate) period: Option<String>,
    /// At most so many points on each side of the start
    #[arg(long, value_name = "N", default_value_t = 500)]
    pub(crate) points: usize,
    /// The longest step along the curve, in parts of the range: --step 0.001 makes a thousand points of it
    #[arg(long, value_name = "PART", default_value_t = 0.05)]
    pub(crate) step: f64,
    /// Write a picture: the motion and its eigenvalues over the parameter, special points named
    #[arg(long, value_name = "FILE.svg", requires = "over", value_parser = drawing, value_hint = clap::ValueHint::FilePath)]
    pub(crate) plot: Option<PathBuf>,
    /// Print JSON: points with their eigenvalues or multipliers, and special points
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev stability gallery/whipple-bicycle/model.toml --over v=0:10
  chetaev stability gallery/whipple-bicycle/model.toml --over v=0:10 --plot bicycle.svg
  chetaev stability gallery/whipple-bicycle/model.toml --over v=0:10,c=0.02:0.14 --plot map.svg
  chetaev stability gallery/chaplygin-sleigh/model.toml --over u=-2:2
  chetaev stability model.toml --about upright --json")]
pub(crate) struct Stability {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// A motion of [steady.NAME], the number of one that `chetaev steady` finds, rest (at the initial positions), or start (the initial state)
    #[arg(long, value_name = "NAME")]
    pub(crate) about: Option<String>,
    /// Values of controls without a law and of parameters of a family: --at u=1/2,theta_0=0.3
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub(crate) at: Option<String>,
    /// A parameter of the model, or of a family, with a range, exact numbers: --over v=0:10; two make a map: --over v=0:10,c=0:1
    #[arg(long, value_name = "NAME=FROM:TO", allow_hyphen_values = true)]
    pub(crate) over: Option<String>,
    /// Write a picture: eigenvalues over one parameter, regions of stability over two
    #[arg(long, value_name = "FILE.svg", requires = "over", value_parser = drawing, value_hint = clap::ValueHint::FilePath)]
    pub(crate) plot: Option<PathBuf>,
    /// Print JSON: regions, and critical values with their enclosures
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev derive gallery/skate-level/model.toml
  chetaev derive model.toml --formulation voronets --as latex
  chetaev derive model.toml --steps
  chetaev derive model.toml --formulation canonical --as c > canonical.c
  chetaev derive model.toml --compare voronets gibbs-appell
  chetaev derive gallery/fields/plate/model.toml
  chetaev derive model.toml --all")]
pub(crate) struct Derive {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// A formulation by its name (again for several); when left out routh and maggi, or reduced for a function of arrays and a count
    #[arg(long, value_name = "NAME", value_parser = formulation_names())]
    pub(crate) formulation: Vec<String>,
    /// Every formulation; those that do not apply say why
    #[arg(long, conflicts_with_all = ["formulation", "compare"])]
    pub(crate) all: bool,
    /// Two formulations: what differs between their equations, and why it vanishes
    #[arg(long, num_args = 2, value_names = ["A", "B"], conflicts_with = "formulation", value_parser = formulation_names())]
    pub(crate) compare: Vec<String>,
    /// Notation; comparisons are text
    #[arg(long = "as", value_enum, default_value_t = Notation::Text, conflicts_with = "compare")]
    pub(crate) notation: Notation,
    /// Write the derivation step by step, as on a board; each step is proved as it is written (text and latex; routh, maggi, reduced, voronets, chaplygin)
    #[arg(long, conflicts_with_all = ["compare", "count"])]
    pub(crate) steps: bool,
    /// The operations of the printed equations (+ − × ÷, powers, roots, functions) in their place
    #[arg(long, conflicts_with_all = ["compare", "notation"])]
    pub(crate) count: bool,
    /// Say on standard error how long deriving, proving and writing took
    #[arg(long)]
    pub(crate) time: bool,
}

/// The names of all formulations, for parsing and completion.
fn formulation_names() -> Vec<&'static str> {
    chetaev::mechanics::FORMULATIONS
        .iter()
        .map(|f| f.card().name)
        .collect()
}

/// The words of all groups of claims, for parsing and completion.
fn group_names() -> Vec<&'static str> {
    chetaev::mechanics::Group::ALL.map(|g| g.word()).to_vec()
}

/// Arithmetic of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Precision {
    /// About 16 digits
    Double,
    /// About 31 digits
    DoubleDouble,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Notation {
    Text,
    Latex,
    Mathml,
    Sympy,
    Json,
    Rust,
    C,
    /// NumPy functions for SciPy
    Python,
    Matlab,
    Julia,
}

impl From<Notation> for chetaev::study::written::Notation {
    fn from(own: Notation) -> Self {
        match own {
            Notation::Text => Self::Text,
            Notation::Latex => Self::Latex,
            Notation::Mathml => Self::Mathml,
            Notation::Sympy => Self::Sympy,
            Notation::Json => Self::Json,
            Notation::Rust => Self::Rust,
            Notation::C => Self::C,
            Notation::Python => Self::Python,
            Notation::Matlab => Self::Matlab,
            Notation::Julia => Self::Julia,
        }
    }
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev principles gallery/particle-y-dx/model.toml
  chetaev principles gallery/skate-incline/model.toml --compare
  chetaev principles gallery/skate-incline/model.toml --compare --kappa kappa_blade=0.5 --t-end 5")]
pub(crate) struct Principles {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Compute the motion and the constrained extremum from the same state, and write both into a report
    #[arg(long)]
    pub(crate) compare: bool,
    /// Initial value of a multiplier of the extremum (again for several): --kappa kappa_blade=0.5; else what the model states, what
    /// makes every motion an extremal, or zero
    #[arg(long, value_name = "NAME=VALUE", requires = "compare")]
    pub(crate) kappa: Vec<String>,
    /// Folder to write the report of --compare into
    #[arg(long, requires = "compare")]
    pub(crate) out: Option<PathBuf>,
    /// Work for all claims together, in seconds of a usual machine (the same work everywhere; the clock stops what takes twice as long);
    /// more than 60 also make searches for integrals look at more
    #[arg(long, default_value_t = 60.0, allow_hyphen_values = true, value_parser = seconds)]
    pub(crate) budget: f64,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
    /// Tell each principle with its formulas and evidence
    #[arg(long, conflicts_with = "json")]
    pub(crate) all: bool,
    /// Print the record of study.json instead of the story
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev simulate gallery/skate-incline/model.toml --t-end 50
  chetaev simulate model.toml --formulation maggi --out run1")]
pub(crate) struct Simulate {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Folder to write trajectory.csv and trajectory.npz into
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Write sensitivity.csv beside: derivatives of coordinates and velocities by parameters and given initial values
    #[arg(long, value_name = "NAME,...")]
    pub(crate) sensitivity: Option<String>,
    /// Write the second derivatives too
    #[arg(long, requires = "sensitivity")]
    pub(crate) second: bool,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
    /// Print a record of the run as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev plot gallery/chaplygin-sleigh/model.toml --ghosts 8
  chetaev plot model.toml --at 2.5 --out sleigh.png
  chetaev plot model.toml --out scene.json
  chetaev plot scene.json --width 1600 --out large.svg")]
pub(crate) struct Plot {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// The file to write, .svg, .png or .json [default: out/NAME/picture.svg]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// The time that is shown [default: the end]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub(crate) at: Option<f64>,
    /// Show the bodies at so many earlier times too
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub(crate) ghosts: u32,
    /// Width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 960)]
    pub(crate) width: u32,
    /// Greatest height in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 540)]
    pub(crate) height: u32,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev film gallery/chaplygin-sleigh/model.toml
  chetaev film model.toml --seconds 6 --width 480 --out motion.gif")]
pub(crate) struct Film {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// The file to write, .gif [default: out/NAME/film.gif]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// How long the film is [default: as long as the motion, from 2 to 20 seconds]
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub(crate) seconds: Option<f64>,
    /// Width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 640)]
    pub(crate) width: u32,
    /// Greatest height in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 360)]
    pub(crate) height: u32,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev sweep gallery/chaplygin-sleigh/model.toml --vary a=0.1:0.5:50 --vary W=1:4:log:10
  chetaev sweep model.toml --initial \"theta=0:pi/2:100\" --initial \"theta'=-1,0,1\" --t-end 20
  chetaev sweep model.toml --vary a=0:1:11 --vary b=0:2:11 --zip
  chetaev sweep model.toml --vary a=0.1:0.5:uniform --vary b=1:2:uniform --count 10000 --seed 7
  chetaev sweep model.toml --rows cases.csv --samples 200 --out out/cases

Ranges make a product: the first varies slowest. --zip walks them together. A name in --rows is that of a parameter, a coordinate
or a velocity; a line of numbers follows for each trajectory. Values are in the unit of the parameter.

Results, one row for each trajectory, in sweep.npz; in Python:
  import numpy; r = numpy.load(\"out/NAME-sweep/sweep.npz\"); r[\"vary_a\"], r[\"end_x\"], r[\"stop\"]
Columns: vary_NAME; stop (0 the end was reached, 1 ended early, 2 did not begin, 10 + k event k); t_start, t, t_stop; steps, rejected;
start_NAME, end_NAME (x' is x_d); drift_energy, drift_integral_NAME, drift_constraints; count_EVENT, first_EVENT; with --samples N
sample_t and sample_NAME, N for each trajectory. Reasons of early ends are in failures.csv.

A sweep that was interrupted, or killed, goes on where it was when the same command is given again.")]
pub(crate) struct Sweep {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Values of a parameter: NAME=FROM:TO:COUNT, NAME=FROM:TO:log:COUNT, NAME=FROM:TO:uniform, NAME=V1,V2,V3 (again for several)
    #[arg(long, value_name = "NAME=RANGE")]
    pub(crate) vary: Vec<String>,
    /// Initial values of a coordinate or a velocity, in the same way: --initial \"x'=0:1:20\"
    #[arg(long, value_name = "NAME=RANGE")]
    pub(crate) initial: Vec<String>,
    /// A file of values: a line of names, then a line of numbers for each trajectory, separated by commas
    #[arg(long, value_name = "FILE")]
    pub(crate) rows: Option<PathBuf>,
    /// Walk the ranges together instead of making their product
    #[arg(long)]
    pub(crate) zip: bool,
    /// How many random values are drawn for ranges that are `uniform`
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub(crate) count: Option<u64>,
    /// What the random values follow from: the same seed, the same values
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        allow_hyphen_values = true
    )]
    pub(crate) seed: u64,
    /// Keep so many states of each trajectory, at equal intervals with both ends
    #[arg(long, value_name = "N", default_value_t = 0, allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub(crate) samples: u32,
    /// Threads [default: as many as the machine runs at once]; the results do not depend on them
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = at_least_one)]
    pub(crate) threads: Option<usize>,
    /// End at the first trajectory that ends early or does not begin
    #[arg(long)]
    pub(crate) stop_on_failure: bool,
    /// Folder to write into [default: out/NAME-sweep]
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
    /// Print counts as JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && seconds >= 0.0 => Ok(seconds),
        _ => Err("a number of seconds is needed, zero or more".into()),
    }
}

/// A file of a picture in lines.
fn drawing(text: &str) -> Result<PathBuf, NoDrawing> {
    let path = PathBuf::from(text);
    let is_drawing = path
        .extension()
        .is_some_and(|own| own.eq_ignore_ascii_case("svg"));
    if is_drawing {
        Ok(path)
    } else {
        Err(NoDrawing)
    }
}

/// The ending of a file is that of no picture in lines.
#[derive(Debug, thiserror::Error)]
#[error("the picture is written as .svg")]
struct NoDrawing;

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads) if (1..=4096).contains(&threads) => Ok(threads),
        _ => Err("a whole number from 1 to 4096 is needed".into()),
    }
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev check model.toml
  chetaev check model.toml --json
  chetaev check model.toml --lowered > plain.toml")]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Print the model with its bodies, joints and contacts written out as coordinates, energies and constraints
    #[arg(long, conflicts_with = "json")]
    pub(crate) lowered: bool,
    /// Print the diagnostics as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev explain                     list all claims
  chetaev explain energy.integral
  chetaev explain energy.integral --json")]
pub(crate) struct Explain {
    /// A claim id; all are listed when left out
    pub(crate) claim: Option<String>,
    /// Print id, title, group, explanation and requirements as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Example:
  chetaev verify out/chaplygin-sleigh/study.json
  chetaev verify out/chaplygin-sleigh/study.json --independent")]
pub(crate) struct Verify {
    /// A study.json
    pub(crate) record: PathBuf,
    /// Work allowed for each of the two replays, in seconds of the budget of a study, whatever the record asks for
    #[arg(long, default_value_t = 120.0, allow_hyphen_values = true, value_parser = seconds)]
    pub(crate) budget: f64,
    /// Let a checker that shares nothing with this program examine the record, instead of a replay; it needs Python 3.11
    #[arg(long)]
    pub(crate) independent: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev new my-robot && chetaev study my-robot/model.toml
  chetaev new my-robot --from bodies
  chetaev new my-plate --from functional")]
pub(crate) struct New {
    /// Folder to create
    pub(crate) folder: PathBuf,
    /// What the model is stated by; asked for on a terminal, `lagrangian` elsewhere
    #[arg(long, value_enum)]
    pub(crate) from: Option<Beginning>,
}

#[derive(Args, Debug)]
#[command(
    after_help = "What is not taken over is named line by line on standard error.
Examples:
  chetaev import robot.urdf
  chetaev import robot.xml --out my-robot/model.toml"
)]
pub(crate) struct Import {
    /// The description: URDF (<robot>) or MJCF (<mujoco>)
    pub(crate) description: PathBuf,
    /// Model file to write; standard output where left out
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
}

/// What a new model is stated by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Beginning {
    /// Bodies, joints and contacts
    Bodies,
    /// Coordinates, energies and constraints
    Lagrangian,
    /// Fields over space and densities, of which the Euler equations are sought
    Functional,
}

#[derive(Args, Debug)]
#[command(after_help = "Examples:
  chetaev gallery
  chetaev gallery describe snakeboard
  chetaev gallery copy snakeboard my-snakeboard
  chetaev gallery copy elasticity/p4p
  chetaev gallery list --json")]
pub(crate) struct Gallery {
    #[command(subcommand)]
    pub(crate) action: Option<GalleryAction>,
    /// Print names, titles, texts and files as JSON
    #[arg(long, global = true)]
    pub(crate) json: bool,
}

#[derive(Subcommand, Debug)]
pub(crate) enum GalleryAction {
    /// List the models
    List,
    /// Print the description of a model
    Describe {
        /// Its name
        name: String,
    },
    /// Copy a model into a folder of your own
    Copy {
        /// Its name
        name: String,
        /// Folder to create [default: NAME]
        folder: Option<PathBuf>,
    },
}

#[derive(Args, Debug)]
#[command(after_help = "Example:
  chetaev completions bash > ~/.local/share/bash-completion/completions/chetaev")]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}
