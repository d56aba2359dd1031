//! `noether.integral#j`: a first integral that was found, with its generator.

use super::domain::{lasting, while_it_lasts};
use super::{generator, generator_formulas, on_manifold};
use super::{of_subject, of_subject_there, requirements, subjects};
use crate::noether::cyclic::cyclic;
use crate::noether::embedded::Embedded;
use crate::noether::generator::Generator;
use crate::noether::letters::ENERGY;
use crate::noether::motion::Motion;
use crate::noether::search::Integral;
use crate::noether::shown::{is_constant, readable};
use crate::noether::written::in_quasi_velocities;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::{words, Manifold};
use chetaev_symbolic::{Expr, Node, Symbol, Verdict};

/// `noether.integral#j`.
#[derive(Clone, Copy, Debug)]
pub struct FirstIntegral;

/// What stands between an integral and its symmetry in the sentence of the verdict.
const BELONGS: &str = "it belongs to ";

/// What stands there where no displacement belongs to it.
const BELONGS_NOT: &str = "no displacement belongs to it";

/// The symmetry in the sentence of a verdict on an integral, and why there is none; `None` where it is not named.
pub fn symmetry_named(detail: &str) -> Option<&str> {
    let mut parts = detail.split("; ");
    parts.find_map(|part| match part.starts_with(BELONGS_NOT) {
        true => Some(part),
        false => part.split_once(BELONGS).map(|(_, symmetry)| symmetry),
    })
}

impl Claim for FirstIntegral {
    fn id(&self) -> &'static str {
        "noether.integral"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "A first integral, found by the search"
    }

    fn explanation(&self) -> &'static str {
        "A function G of the time, the coordinates and the velocities that keeps its value along every motion: its derivative \
         along the field of the motion, X̄G, vanishes on the constraint manifold, with the accelerations of Routh's \
         equations. By Noether's theorem it belongs to a field Ȳ = δ Y_0 + ξ Y + ζ ∂/∂η and a gauge function g with \
         G = g - L̄ δ - p (ξ - η δ); δ may be prescribed, as multiples of the motion itself change nothing. The field is shown \
         with δ = 1 for the energy and δ = 0 for the others. Noether's theorem asks for virtual displacements, which need not map \
         motions into motions: shifts are called a symmetry where neither the constraints nor the accelerations contain what is \
         shifted, else it is said which of them does."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        of_subject(cx, subject, decide)
    }

    fn decide_there(
        &self,
        cx: &Context<'_>,
        subject: Option<&str>,
        there: &Context<'_>,
    ) -> Finding {
        of_subject_there((cx, there), (self, subject), decide)
    }
}

fn decide(cx: &Context<'_>, integral: &Integral) -> Finding {
    let g = &cx.system.graph;
    let name = integral.name.as_deref();
    let named = name.map_or(String::new(), |name| format!(", {name}"));
    let mut formulas = vec![Formula {
        caption: format!("the first integral{named}"),
        left: None,
        right: integral.shown,
    }];
    let lasting = lasting(cx, integral.value);
    let always = match &lasting {
        Some(lasting) => format!("while {lasting}"),
        None => "on every motion".to_owned(),
    };
    let mut sentence = format!("{} keeps its value {always}", g.text(integral.shown));
    if let Ok((n, generator)) = generator(cx, integral) {
        formulas.extend(generator_formulas(cx, &n, &generator));
        sentence = format!("{sentence}; {}", symmetry(cx, &n, &generator, name));
        if let Some(speed) = momentum_of_cyclic(cx, &n, &generator) {
            sentence = format!("{sentence}; up to a factor it is the momentum of the cyclic independent velocity {speed}, which nothing drives");
        }
    }
    let mut verdict = integral.verdict.clone().prefixed(&sentence);
    while_it_lasts(&mut verdict, lasting.as_ref());
    Finding { verdict, formulas }
}

/// The cyclic velocity whose momentum the integral is, up to a factor.
fn momentum_of_cyclic<'a>(
    cx: &Context<'_>,
    n: &'a Embedded<'_>,
    generator: &Generator,
) -> Option<&'a str> {
    let (system, g) = (n.system, &n.system.graph);
    let shown: Vec<Expr> = generator.xi.iter().map(|&xi| readable(g, xi)).collect();
    let moved: Vec<usize> = (0..n.k()).filter(|&i| !g.is_zero(shown[i])).collect();
    let without_gauge = || {
        let verdict = on_manifold(cx, n, &[generator.gauge]);
        matches!(verdict, Verdict::Proved(_))
    };
    match moved[..] {
        [i] if g.is_zero(generator.delta)
            && is_constant(system, shown[i])
            && without_gauge()
            && cyclic(cx, n).is_ok_and(|all| all.contains(&i)) =>
        {
            Some(&n.embedding.chart.parameters[i].name)
        }
        _ => None,
    }
}

/// What the symmetry is, in words.
fn symmetry(
    cx: &Context<'_>,
    n: &Embedded<'_>,
    generator: &Generator,
    name: Option<&str>,
) -> String {
    let (system, g) = (n.system, &n.system.graph);
    if name == Some(ENERGY) {
        let time = g.as_symbol(g.symbol("t", 0));
        return time.map_or(String::new(), |t| under_shifts(cx, "time", t));
    }
    let speeds = n.embedding.chart.parameters.iter().zip(&generator.xi);
    let along: Vec<&str> = speeds
        .filter(|(_, &xi)| !g.is_zero(readable(g, xi)))
        .map(|(speed, _)| &speed.name[..])
        .collect();
    if along.is_empty() {
        return match system.constraints.is_empty() {
            true => format!("{BELONGS_NOT}, as it contains no velocity"),
            false => format!("{BELONGS_NOT}, as it contains no velocity on the constraints"),
        };
    }
    let moved = displacements(cx, n, generator);
    match &moved[..] {
        [(place, by)] if is_constant(system, *by) => {
            let moved = &system.coordinates[*place];
            under_shifts(cx, &moved.name, moved.q_symbol)
        }
        _ => match field(cx, &moved) {
            text if text.chars().count() <= LONGEST => {
                format!("by Noether's theorem {BELONGS}the displacements along {text}")
            }
            _ => format!(
                "by Noether's theorem {BELONGS}displacements along the directions of {} at once, whose components ξ stand with the formulas",
                along.join(", ")
            ),
        },
    }
}

/// ξ^i Y_i in the coordinates, by their places, without what is zero; shifts are what moves them by constants.
fn displacements(cx: &Context<'_>, n: &Embedded<'_>, generator: &Generator) -> Vec<(usize, Expr)> {
    let g = &n.system.graph;
    let all = n.embedding.chart.basis.iter().map(|row| {
        let parts = row.iter().zip(&generator.xi);
        let parts: Vec<Expr> = parts.map(|(&b, &xi)| g.mul(&[b, xi])).collect();
        readable(g, g.add(&parts))
    });
    let all: Vec<Expr> = all.collect();
    let shown = in_quasi_velocities(cx, &all);
    let numbered = shown.into_iter().enumerate();
    numbered.filter(|(_, e)| !g.is_zero(*e)).collect()
}

/// Shifts of the time or of a coordinate are a symmetry where neither the constraints nor the motion contain it. L may keep its form under
/// them though constraints do not: displacements are virtual, so that Noether's theorem asks nothing of the constraints.
fn under_shifts(cx: &Context<'_>, name: &str, symbol: Symbol) -> String {
    let (system, g) = (cx.system, &cx.system.graph);
    let Ok(motion) = Motion::of(cx) else {
        return format!("by Noether's theorem {BELONGS}shifts of {name}");
    };
    // Controls are functions of the time; masses with a law of their own are states.
    let is_control = |s: Symbol| system.controls.iter().any(|u| u.name == g.symbol_name(s));
    let along_time = |s| (s == symbol || is_control(s)).then(|| system.prescribed_rate(s))?;
    let slope = |e: Expr| match name {
        "time" => g.derive(&[e], &along_time).swap_remove(0),
        _ => g.diff(e, symbol),
    };
    let contains = |es: &[Expr], manifold: &Manifold| {
        let slopes: Vec<Expr> = es.iter().map(|&e| slope(e)).collect();
        let verdict = cx.prover.identity(system, &slopes, manifold, "");
        !matches!(verdict, Verdict::Proved(_))
    };
    // Holonomic constraints hold themselves too, not only their derivatives.
    let constraints = cx.terms.constraint_index.iter().zip(&cx.terms.constraints);
    let changed: Vec<&str> = constraints
        .map(|(&l, &f)| (&system.constraints[l], f))
        .filter(|(c, f)| {
            let own = [*f, c.stated];
            let count = if c.order == 0 { 2 } else { 1 };
            contains(&own[..count], &motion.manifold)
        })
        .map(|(c, _)| &c.name[..])
        .collect();
    if changed.is_empty() && !contains(&motion.accelerations, &motion.manifold) {
        return format!("{BELONGS}the symmetry under shifts of {name}");
    }
    let mut active = system.forces.clone();
    active.push(system.lagrangian);
    let kept = match contains(&active, &Manifold::default()) {
        true => "",
        false => ", which change neither L nor the forces",
    };
    let what = match name {
        "time" => "shifts of time".to_owned(),
        _ => format!("the virtual displacements along {name}"),
    };
    let which = match &changed[..] {
        [] => "the accelerations contain".to_owned(),
        [one] => format!("the constraint `{one}` contains"),
        all => format!("the constraints {} contain", words::quoted(all)),
    };
    let shifted = match name {
        "time" if !system.controls.is_empty() => "the time or a control".to_owned(),
        _ => g.symbol_text(symbol),
    };
    format!("by Noether's theorem {BELONGS}{what}{kept}; {which} {shifted}, so that the system has no symmetry under shifts of {name}")
}

/// A longer field is not written out in a sentence.
const LONGEST: usize = 120;

/// `x ∂/∂y - y ∂/∂x`.
fn field(cx: &Context<'_>, moved: &[(usize, Expr)]) -> String {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut text = String::new();
    for (place, e) in moved {
        let coordinate = &system.coordinates[*place].name;
        let negative = g.neg(*e);
        let begins_with_minus = |e: Expr| g.text(e).starts_with('-');
        let is_sum = |e: Expr| matches!(g.node(e), Node::Sum { .. });
        let (sign, size) = match begins_with_minus(*e) && !is_sum(*e) {
            true => ("-", negative),
            false => ("+", *e),
        };
        text.push_str(match (text.is_empty(), sign) {
            (true, "+") => "",
            (true, _) => "-",
            (false, "+") => " + ",
            (false, _) => " - ",
        });
        match (g.is_one(size), is_sum(size)) {
            (true, _) => {}
            (false, true) => text.push_str(&format!("({}) ", g.text(size))),
            (false, false) => text.push_str(&format!("{} ", g.text(size))),
        }
        text.push_str(&format!("∂/∂{coordinate}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::symmetry_named;

    #[test]
    fn the_symmetry_is_read_from_the_sentence() {
        for (detail, expected) in [
            ("x' keeps its value on every motion; it belongs to the symmetry under shifts of x; zero at 3 points", Some("the symmetry under shifts of x")),
            ("f keeps its value; by Noether's theorem it belongs to shifts of time; `c` contains t", Some("shifts of time")),
            ("x keeps its value; no displacement belongs to it, as it contains no velocity", Some("no displacement belongs to it, as it contains no velocity")),
            ("x' keeps its value on every motion", None),
        ] {
            assert_eq!(symmetry_named(detail), expected);
        }
    }
}
