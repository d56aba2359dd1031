//! Two formulations held against each other.

use super::NotWritten;
use crate::derivation::{derivation, Derivation, ReadableGroup};
use crate::typeset;
use chetaev_mechanics::claims::formulation::{equivalence, manifold};
use chetaev_mechanics::{formulation, Context, Equations};
use chetaev_symbolic::print::{Document, Format};
use chetaev_symbolic::{simplify, Expr, Verdict};

/// Differences of the two forms and why they vanish, or where they do not.
pub(super) fn text(
    cx: &Context<'_>,
    a: &str,
    b: &str,
    progress: &dyn Fn(&str),
) -> Result<String, NotWritten> {
    let derive = |name: &str| -> Result<Derivation, NotWritten> {
        progress(&format!("deriving {name}"));
        let known = formulation(name).ok_or_else(|| NotWritten::Unknown(name.to_owned()))?;
        Ok(derivation(cx, known, None)?)
    };
    let (first, second) = (derive(a)?, derive(b)?);
    progress("comparing");
    let mut text = format!("{} and {}\n", first.card.title, second.card.title);
    let of = (&first.equations, &second.equations);
    let verdict = match cx.terms.order {
        1 => equivalence(cx, of.0, of.1),
        _ => on_the_jet(cx, a, b),
    };
    match cx.terms.order {
        1 => text.push_str(&accelerations(cx, of, &verdict)),
        order => text.push_str(&format!(
            "\nequations of order {order}, compared on the jet, where their variables differ:\n{}\n",
            said(&verdict)
        )),
    }
    text.push_str(&left_sides(cx, &first, &second, &verdict));
    Ok(text)
}

/// Constraints of order two and more: accelerations are data there, so that both forms are held against the equations with
/// multipliers.
fn on_the_jet(cx: &Context<'_>, a: &str, b: &str) -> Verdict {
    let of = |name: &str| {
        let finding = cx.finding(&format!("formulation.equivalent#{name}"));
        finding.verdict.clone()
    };
    let (first, second) = (of(a), of(b));
    let is_proved = |verdict: &Verdict| matches!(verdict, Verdict::Proved(_));
    match (is_proved(&first), is_proved(&second)) {
        (true, true) => first.and(second),
        (true, false) => second,
        (false, true) => first,
        (false, false) => Verdict::undecided(format!(
            "neither `{a}` ({}) nor `{b}` ({}) is proved equal to the equations with multipliers",
            first.word(),
            second.word()
        )),
    }
}

/// The difference of the accelerations, before and after the constraints are used.
fn accelerations(
    cx: &Context<'_>,
    (first, second): (&Equations, &Equations),
    verdict: &Verdict,
) -> String {
    let (system, g) = (cx.system, &cx.system.graph);
    let a = first.in_natural_state(system, &first.accelerations);
    let b = second.in_natural_state(system, &second.accelerations);
    let differences: Vec<Expr> = a.iter().zip(&b).map(|(&a, &b)| g.sub(b, a)).collect();
    let mut text = String::from("\naccelerations, second minus first, at any state (q, v):\n");
    let shown: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .zip(differences)
        .map(|(c, difference)| (c.a, readable(cx, difference)))
        .collect();
    text.push_str(&written(cx, &shown));
    text.push_str(&format!("\n{}\n", said(verdict)));
    if shown.iter().any(|(_, d)| !g.is_zero(*d)) && matches!(verdict, Verdict::Proved(_)) {
        text.push_str("It vanishes only where the constraints hold: ");
        let solved: Vec<String> = manifold(cx)
            .solved
            .iter()
            .map(|(s, e)| format!("{} = {}", g.symbol_text(*s), g.text(*e)))
            .collect();
        let implicit: Vec<String> = manifold(cx)
            .implicit
            .iter()
            .map(|(f, _)| format!("{} = 0", g.text(*f)))
            .collect();
        text.push_str(&[solved, implicit].concat().join(", "));
        text.push_str(".\n");
    }
    text
}

/// Where both state as many equations for the same things, the difference of their left minus right sides.
fn left_sides(
    cx: &Context<'_>,
    first: &Derivation,
    second: &Derivation,
    equivalent: &Verdict,
) -> String {
    let (system, g) = (cx.system, &cx.system.graph);
    let names = |group: &ReadableGroup| -> Vec<String> {
        let labels = group.labels.iter();
        labels
            .map(|l| l.trim_end_matches('\'').to_owned())
            .collect()
    };
    let same = first.groups.iter().find_map(|a| {
        let of_motion =
            |group: &&ReadableGroup| !matches!(group.title.as_str(), "kinematics" | "constraints");
        let partner = second.groups.iter().filter(of_motion);
        let mut partner = partner.filter(|b| names(a) == names(b));
        Some(a).filter(of_motion).zip(partner.next())
    });
    let same_variables = first.equations.variables.len() == second.equations.variables.len()
        && first
            .equations
            .variables
            .iter()
            .zip(&second.equations.variables)
            .all(|(x, y)| x.symbol == y.symbol);
    let Some((a, b)) = same.filter(|_| same_variables) else {
        return "\nThe two forms have different unknowns; their equations are compared by what they give.\n".into();
    };
    let residual = |(l, r): &(Expr, Expr)| g.sub(*l, *r);
    let differences: Vec<Expr> = a
        .pairs
        .iter()
        .zip(&b.pairs)
        .map(|(x, y)| g.sub(residual(y), residual(x)))
        .collect();
    let verdict = cx.prover.identity(
        system,
        &differences,
        &Default::default(),
        "for all accelerations",
    );
    let mut text = String::from("\nequations, second minus first, accelerations free:\n");
    let shown: Vec<(Expr, Expr)> = a
        .labels
        .iter()
        .zip(&differences)
        .map(|(label, &d)| (g.symbol(label.trim_end_matches('\''), 0), readable(cx, d)))
        .collect();
    text.push_str(&written(cx, &shown));
    let conclusion = match (&verdict, equivalent) {
        (Verdict::Refuted(_), Verdict::Proved(_)) => format!(
            "not equal term by term ({}), and equivalent all the same: with the accelerations above both hold, so each set \
             of equations is a regular combination of the other where the constraints hold",
            verdict.detail()
        ),
        _ => said(&verdict),
    };
    text.push_str(&format!("\n{conclusion}\n"));
    text
}

/// More signs than this are not simplified.
const READABLE: u64 = 8_000;

fn readable(cx: &Context<'_>, e: Expr) -> Expr {
    match simplify::length(&cx.system.graph, e) <= READABLE {
        true => typeset::simplified(cx.system, &[e])[0],
        false => e,
    }
}

fn written(cx: &Context<'_>, pairs: &[(Expr, Expr)]) -> String {
    let options = typeset::print_options(cx.system);
    let document = Document::equations(&cx.system.graph, pairs, &options);
    document.render(Format::Text).trim_end().to_string()
}

fn said(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Proved(proof) => format!("proved equal {}: {}", proof.on, proof.detail),
        other => format!("{}: {}", other.word(), other.detail()),
    }
}
