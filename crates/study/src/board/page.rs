//! A derivation on the page: an exercise with the solution folded.

use super::{board, options, print::said, words, Board};
use crate::typeset::Typesetter;
use chetaev_mechanics::{formulation, Context};
use chetaev_report::data::{Equation, EquationSection};
use chetaev_symbolic::meter::Work;

/// Work for the whole derivation, in counted seconds.
const SECONDS: f64 = 2.0;

/// The derivation of a formulation; `None` where it offers none of this system, a step of it is not proved, or it takes long.
pub(crate) fn section(
    cx: &Context<'_>,
    name: &str,
    set: &Typesetter<'_>,
) -> Option<EquationSection> {
    let known = formulation(name)?;
    let board = board(cx, known, &Work::of_seconds(SECONDS)).ok()?;
    if board.steps.is_empty() || !board.steps.iter().all(super::BoardStep::is_written) {
        return None;
    }
    Some(EquationSection {
        id: format!("steps-{name}"),
        title: words::SOLUTION.into(),
        exercise: Some(words::exercise(board.card.title)),
        explanation: vec![words::checked(&board)],
        equations: equations(&board, set),
        collapsed: true,
        ..EquationSection::default()
    })
}

fn equations(board: &Board, set: &Typesetter<'_>) -> Vec<Equation> {
    let options = options(set.system(), board);
    let mut all = Vec::new();
    for (number, step) in board.steps.iter().enumerate() {
        let own = words::of(step.kind);
        let form = own.schema.map(|schema| schema.text.to_owned());
        let mut lines = match said(step) {
            Some(sentence) => vec![Equation {
                omitted: Some(sentence),
                ..Equation::default()
            }],
            None => set.equations_with(&step.pairs, &options),
        };
        if let Some(first) = lines.first_mut() {
            let title = format!("{}. {}", number + 1, own.title);
            first.heading = Some(match form {
                Some(form) => format!("{title}: {form}"),
                None => title,
            });
        }
        if let Some(last) = lines.last_mut() {
            last.caption = Some(own.reason.into());
        }
        all.extend(lines);
    }
    all
}
