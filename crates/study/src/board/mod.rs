//! A derivation on the board: the steps that a formulation offers, simplified for reading, each checked by a zero test as it is written.
//!
//! What is not proved is not written as true: the step says so in its place.

mod page;
mod print;
mod words;

pub(crate) use page::section;

use crate::derivation::{check_applies, NotDerived};
use crate::typeset;
use crate::written::{NotWritten, Notation};
use chetaev_mechanics::card::Card;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::equations::NamedExpr;
use chetaev_mechanics::steps::{self, Ground, Step, StepKind, Steps};
use chetaev_mechanics::words::quoted;
use chetaev_mechanics::{formulation, Context, Formulation, System};
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::print::Options;
use chetaev_symbolic::{simplify, Expr, Verdict};
use std::sync::Arc;

/// Steps with more signs are not written: nobody copies them from a board.
const WRITTEN: u64 = 6_000;

/// Work for all steps that a command asks for, in counted seconds.
const SECONDS: f64 = 30.0;

/// A derivation, checked.
#[derive(Clone, Debug)]
pub struct Board {
    /// The formulation.
    pub card: &'static Card,
    /// Its steps.
    pub steps: Vec<BoardStep>,
    /// The names that are introduced.
    pub names: Vec<NamedExpr>,
}

/// A step as it is written.
#[derive(Clone, Debug)]
pub struct BoardStep {
    /// What it does.
    pub kind: StepKind,
    /// Left and right sides; of components those that do not vanish.
    pub pairs: Vec<(Expr, Expr)>,
    /// Whether it is true.
    pub checked: Checked,
}

/// What the zero test says of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Checked {
    /// The model states it.
    Stated,
    /// Every formula of it is proved.
    Proved,
    /// It is not: refuted, or not decided.
    NotProved(Box<Verdict>),
    /// Too long to be written, with the number of signs.
    TooLong(u64),
}

impl BoardStep {
    /// Whether it is written as true.
    pub fn is_written(&self) -> bool {
        matches!(self.checked, Checked::Stated | Checked::Proved)
    }
}

/// Derives a formulation step by step.
///
/// # Errors
/// [`NotWritten`] where it does not apply, gives nothing, or offers no steps of this system.
pub fn board(
    cx: &Context<'_>,
    formulation: &dyn Formulation,
    work: &Arc<Work>,
) -> Result<Board, NotWritten> {
    let card = formulation.card();
    check_applies(cx, card)?;
    let steps = steps::steps(card.name, &basis(cx));
    let steps = steps.map_err(|problem| NotDerived::Failed {
        name: card.name,
        problem,
    })?;
    let steps = steps.ok_or_else(|| NotWritten::NoSteps {
        name: card.name,
        known: offering(cx),
    })?;
    Ok(checked(cx, card, &steps, work))
}

/// The formulations that offer steps of this system, for a message.
fn offering(cx: &Context<'_>) -> String {
    let offers = |f: &&'static dyn Formulation| {
        let is_met = check_applies(cx, f.card()).is_ok();
        is_met && matches!(steps::steps(f.card().name, &basis(cx)), Ok(Some(_)))
    };
    let known = steps::formulations().filter_map(formulation).filter(offers);
    words::offering(&quoted(known.map(|f| f.card().name)))
}

/// Steps made short, and each of them decided as it is written, within an amount of work for all.
pub fn checked(cx: &Context<'_>, card: &'static Card, steps: &Steps, work: &Arc<Work>) -> Board {
    let written = steps.steps.iter().map(|step| {
        let done = within(work, || one(cx, steps, step));
        done.unwrap_or_else(|_| BoardStep {
            kind: step.kind,
            pairs: Vec::new(),
            checked: Checked::NotProved(Box::new(words::out_of_work())),
        })
    });
    Board {
        card,
        steps: written.collect(),
        names: steps.names.clone(),
    }
}

fn one(cx: &Context<'_>, all: &Steps, step: &Step) -> BoardStep {
    let (system, g) = (cx.system, &cx.system.graph);
    let written = |pairs, checked| BoardStep {
        kind: step.kind,
        pairs,
        checked,
    };
    let sides: Vec<Expr> = (step.formulas.iter())
        .flat_map(|f| [f.left, f.right])
        .collect();
    let is_stated = step
        .formulas
        .iter()
        .all(|f| matches!(f.ground, Ground::Stated));
    // Long solutions of linear systems are not even simplified.
    let signs = signs(system, &sides);
    if signs > WRITTEN.saturating_mul(4) {
        return written(Vec::new(), Checked::TooLong(signs));
    }
    let pairs: Vec<(Expr, Expr)> = (step.formulas.iter())
        .map(|f| match f.ground {
            Ground::Stated => (f.left, f.right),
            _ => short(system, all, (f.left, f.right)),
        })
        .collect();
    if is_stated {
        return written(pairs, Checked::Stated);
    }
    let residuals = step.formulas.iter().zip(&pairs);
    let residuals = residuals.filter_map(|(f, &(left, right))| f.ground.residual(g, left, right));
    let residuals: Vec<Expr> = residuals.chain(step.conditions.iter().copied()).collect();
    let verdict = (cx.prover).identity(system, &residuals, &all.manifold, "on the constraints");
    if !matches!(verdict, Verdict::Proved(_)) {
        return written(Vec::new(), Checked::NotProved(Box::new(verdict)));
    }
    let sides: Vec<Expr> = pairs.iter().flat_map(|&(l, r)| [l, r]).collect();
    let signs = self::signs(system, &sides);
    if signs > WRITTEN {
        return written(Vec::new(), Checked::TooLong(signs));
    }
    let shown = pairs.into_iter();
    let shown = shown.filter(|&(_, right)| !(step.kind.is_of_components() && g.is_zero(right)));
    written(shown.collect(), Checked::Proved)
}

fn signs(system: &System, es: &[Expr]) -> u64 {
    let lengths = es.iter().map(|&e| simplify::length(&system.graph, e));
    lengths.fold(0, u64::saturating_add)
}

/// Both sides simplified, the left one collected by rates.
fn short(system: &System, all: &Steps, (left, right): (Expr, Expr)) -> (Expr, Expr) {
    let g = &system.graph;
    let options = simplify::Options::default();
    let by: [&[Expr]; 2] = [&all.rates, &all.velocities];
    let left = match g.as_symbol(left) {
        Some(_) => left,
        None => simplify::collect(g, left, &by, &options),
    };
    (left, simplify::simplify(g, right, &options))
}

/// Printing with the indices of the names that are introduced; quasi-velocities that were chosen stand before velocities.
fn options(system: &System, board: &Board) -> Options {
    let mut options = typeset::print_options_with(system, &board.names);
    let chosen = board.steps.iter();
    let chosen = chosen.filter(|step| step.kind == StepKind::QuasiVelocities);
    let symbols = chosen.flat_map(|step| step.pairs.iter().map(|&(left, _)| left));
    let g = &system.graph;
    let names = symbols.filter_map(|e| g.as_symbol(e).map(|s| g.symbol_name(s).to_owned()));
    let names: Vec<String> = names
        .filter(|name| system.coordinate_index(name).is_none())
        .collect();
    options.coordinates.splice(0..0, names);
    options
}

/// The derivations of several formulations in a notation for reading.
///
/// # Errors
/// [`NotWritten`]; with `all` formulations one that has no steps is passed over.
pub fn written(
    cx: &Context<'_>,
    asked: &[&'static dyn Formulation],
    (notation, all): (Notation, bool),
) -> Result<String, NotWritten> {
    let mut boards = Vec::new();
    for formulation in asked {
        match board(cx, *formulation, &Work::of_seconds(SECONDS)) {
            Ok(found) => boards.push(found),
            Err(problem) if !all => return Err(problem),
            Err(_) => {}
        }
    }
    print::text(cx.system, &boards, notation)
}
