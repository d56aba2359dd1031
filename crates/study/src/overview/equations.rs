//! The equations of motion in the form that is shortest to read.

use crate::derivation::{check_applies, derivation, options_of, Derivation, Readings};
use crate::layout::{hanging, WIDTH};
use crate::registry::registry;
use crate::study::Study;
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::{formulation, Context, Prover};
use chetaev_symbolic::print::{Document, Format};
use chetaev_symbolic::simplify;

/// The forms that are compared: in quasi-velocities, in the independent velocities, and with multipliers. The last is taken only where the
/// others are longer by more than half: a reader wants the motion and not the reactions.
const FORMS: [(&str, f64); 3] = [("reduced", 1.0), ("maggi", 1.0), ("routh", 1.5)];

/// Equations of more signs than these are not worked on: they would fill the screen however they are written.
const SIGNS: u64 = 6_000;

/// Lines that equations of motion may fill.
const LINES: usize = 12;

/// The shortest of the forms, or how long it is.
pub(super) fn lines(study: &Study) -> String {
    let known = registry();
    let cx = Context::of(&study.system, &study.prepared, &known, Prover::default());
    if study.prepared.degenerate.is_some() {
        return hanging(
            "  ",
            "multipliers determine none (model.constraints-independent)",
        );
    }
    let readings = Readings::default();
    let written = FORMS.iter().filter_map(|(name, factor)| {
        let form = formulation(name)?;
        let is_reference = *name == "routh";
        if !is_reference && check_applies(&cx, form.card()).is_err() {
            return None;
        }
        if signs(&cx, name)? > SIGNS {
            return None;
        }
        let found = derivation(&cx, form, Some(&readings)).ok()?;
        let all = statements(study, &found);
        let weight = factor * length(&all) as f64;
        Some((weight, all))
    });
    let Some((_, shortest)) = written.min_by(|(a, _), (b, _)| a.total_cmp(b)) else {
        return hanging(
            "  ",
            "too long for a terminal: the report and `chetaev derive` have them",
        );
    };
    let text: String = shortest.iter().map(|e| broken(e)).collect();
    if text.lines().count() <= LINES {
        return text;
    }
    let words = format!(
        "{} equations of {} characters, too long for a terminal: the report and `chetaev derive` have them",
        shortest.len(),
        length(&shortest)
    );
    hanging("  ", &words)
}

fn length(equations: &[String]) -> usize {
    equations.iter().map(|e| e.chars().count()).sum()
}

/// The length of a formulation's equations.
fn signs(cx: &Context<'_>, name: &str) -> Option<u64> {
    let derived = derive(cx, name).ok()?;
    let g = &cx.system.graph;
    let equations = derived.groups.iter().flat_map(|group| &group.equations);
    let sides = equations.flat_map(|e| [e.left, e.right]);
    Some(sides.fold(0, |sum, e| u64::saturating_add(sum, simplify::length(g, e))))
}

/// The equations as text, with the names that they share.
fn statements(study: &Study, found: &Derivation) -> Vec<String> {
    let pairs: Vec<_> = (found.groups.iter())
        .flat_map(|group| group.pairs.iter().copied())
        .collect();
    let options = options_of(&study.system, found);
    let parts = Document::equations(&study.system.graph, &pairs, &options).parts(Format::Text);
    let mut all = parts.statements;
    let shared = parts.definitions.iter();
    all.extend(shared.map(|definition| format!("with {definition}")));
    all
}

/// What stands before an equation, and before what follows in further lines.
const MARGINS: [&str; 2] = ["  ", "      "];

/// An equation in lines that end between its terms where they can.
fn broken(equation: &str) -> String {
    let (mut text, mut line) = (String::new(), MARGINS[0].to_owned());
    for term in terms(equation) {
        let is_begun = line.trim() != "";
        if is_begun && line.chars().count() + 1 + term.chars().count() > WIDTH {
            text.push_str(&line);
            text.push('\n');
            line = MARGINS[1].to_owned();
        } else if is_begun {
            line.push(' ');
        }
        line.push_str(term);
    }
    text.push_str(&line);
    text.push('\n');
    if text.lines().all(|line| line.chars().count() <= WIDTH) {
        text
    } else {
        hanging(MARGINS[0], equation)
    }
}

/// The terms of an equation with their signs, as they stand outside brackets.
fn terms(equation: &str) -> Vec<&str> {
    let (mut depth, mut begin, mut terms) = (0_usize, 0, Vec::new());
    for (at, sign) in equation.char_indices() {
        match sign {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            // A sign that belongs to what follows it is no beginning of a term.
            ' ' if depth == 0
                && ["+ ", "- ", "= "]
                    .iter()
                    .any(|s| equation[at + 1..].starts_with(s)) =>
            {
                terms.push(&equation[begin..at]);
                begin = at + 1;
            }
            _ => {}
        }
    }
    terms.push(&equation[begin..]);
    terms
}

#[cfg(test)]
mod tests {
    use super::{broken, terms};

    #[test]
    fn equations_break_between_terms() {
        assert_eq!(
            terms("m (a - b) x' - c = -d + e"),
            ["m (a - b) x'", "- c", "= -d", "+ e"]
        );
        let term = "(a - b) x'' + ".repeat(20);
        let text = broken(&format!("{term}c = 0"));
        assert!(text.lines().count() > 2);
        assert!(text
            .lines()
            .skip(1)
            .all(|line| line.starts_with("      + (a - b)")));
        assert!(text.lines().all(|line| line.chars().count() <= 100));
    }
}
