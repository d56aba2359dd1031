//! What a verdict says of a density: in which variables it is one, which, and where it ends.

use super::edges::Edges;
use super::{density_letter, Measure};
use chetaev_mechanics::claims::{Context, Formula};
use chetaev_mechanics::equations::unused_letter;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Graph};

/// Longer densities are shown as formulas only.
const LONGEST: usize = 160;

/// The density with a caption that names its variables.
pub(super) fn formula(cx: &Context<'_>, measure: &Measure, density: Expr) -> Formula {
    let (n, form, with) = variables(cx, measure, density);
    Formula {
        caption: format!("the density {n} of the invariant measure {form}, {with}"),
        left: None,
        right: density,
    }
}

/// Says in a proof which density is one, and where.
pub(super) fn tell(cx: &Context<'_>, measure: &Measure, density: Expr, proof: &mut Proof) {
    let g = &cx.system.graph;
    let (n, form, with) = variables(cx, measure, density);
    let text = g.text(density);
    let what = match text.chars().count() <= LONGEST {
        true => format!("for {n} = {text}"),
        false => format!("for the {n} stated{}", measure.words),
    };
    proof.detail = format!("{form}, {with}, is invariant {what}; {}", proof.detail);
    within(g, proof, &measure.edges, &n);
    if is_of_time_only(cx, density) {
        proof.detail.push_str(&format!(
            "; {n} changes with the time only: it tells at which rate the motion contracts volumes"
        ));
    }
    if !measure.unrolled.is_empty() {
        proof.detail.push_str(&format!(
            "; {} counted as of the whole line: as an angle, which unit = \"rad\" says, the density would have to return after a turn",
            listed(&measure.unrolled)
        ));
    }
}

/// The letter of a density, its measure, and what the variables of this are.
fn variables(cx: &Context<'_>, measure: &Measure, density: Expr) -> (String, String, String) {
    let masses: Vec<&str> = cx.system.masses.iter().map(|m| m.name.as_str()).collect();
    let n = density_letter(cx);
    let m = unused_letter(cx.system, &["M", "µ"]);
    let time = if is_of_time(cx, density) { " dt" } else { "" };
    let (d_eta, eta) = match measure.velocities.is_empty() {
        true => ("", "where no velocities are independent".to_owned()),
        false => (
            " dη",
            format!("with η = ({})", measure.velocities.join(", ")),
        ),
    };
    let (d_m, with) = match masses.is_empty() {
        true => (String::new(), String::new()),
        false => (
            format!(" d{m}"),
            format!(" and {m} = ({})", masses.join(", ")),
        ),
    };
    let all = match cx.system.fixed_functions().is_empty() {
        true => "",
        false => " and dq that of all coordinates, without the holonomic constraints, whose derivatives alone are imposed",
    };
    (
        n.clone(),
        format!("{n}{time} dq{d_eta}{d_m}"),
        format!("{eta}{with}{all}"),
    )
}

/// Whether a density contains the time, or controls, which are functions of it.
fn is_of_time(cx: &Context<'_>, density: Expr) -> bool {
    let g = &cx.system.graph;
    let controls = &cx.system.controls;
    let changes = |name: &str| name == "t" || controls.iter().any(|u| u.name == name);
    let own = g.symbols_in(&[density]);
    own.into_iter().any(|s| changes(g.symbol_name(s)))
}

/// Whether nothing changes a density but the time.
fn is_of_time_only(cx: &Context<'_>, density: Expr) -> bool {
    let g = &cx.system.graph;
    let controls = &cx.system.controls;
    let stays = |name: &str| {
        name == "t" || controls.iter().any(|u| u.name == name) || !cx.system.moves(name)
    };
    let own = g.symbols_in(&[density]);
    is_of_time(cx, density) && own.into_iter().all(|s| stays(g.symbol_name(s)))
}

/// Names with their verb.
fn listed(names: &[String]) -> String {
    let verb = if names.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", names.join(", "))
}

/// Says in a proof outside which set a density is one.
fn within(g: &Graph, proof: &mut Proof, edges: &Edges, n: &str) {
    let all = edges.all();
    if all.is_empty() {
        return;
    }
    if Edges::texts(g, &all, "=", "").chars().count() > LONGEST {
        proof.on = format!("on the constraint manifold, where {n} is neither zero nor infinite");
        return;
    }
    proof.on = format!(
        "on the constraint manifold, where {}",
        Edges::texts(g, &all, "≠", " and ")
    );
    let mut say = |edges: &[Expr], sentence: &dyn Fn(String) -> String| {
        if !edges.is_empty() {
            let told = sentence(Edges::texts(g, edges, "=", " or "));
            proof.detail.push_str(&format!("; {told}"));
        }
    };
    say(&edges.of_masses, &|at| {
        format!("where {at} the mass matrices are singular or infinite and do not determine the motion, whatever {n} is there")
    });
    say(&edges.of_chart, &|at| {
        format!("where {at} these variables do not determine the motion; in others {n} is neither zero nor infinite there wherever the mass matrices are regular")
    });
    let each = "it is a measure on each of the parts into which this divides the states, and whether another one is smooth and positive across is not decided";
    say(&edges.of_variables, &|at| {
        format!("not where {at}, as these variables end there: in others that do not {n} is zero or infinite, {each}")
    });
    say(&edges.of_density, &|at| {
        format!("not where {at}, as {n} is zero or infinite there: {each}")
    });
    say(&edges.of_formula, &|at| {
        format!("not where {at}, as a function in {n} has a pole or jumps there: {each}")
    });
}
