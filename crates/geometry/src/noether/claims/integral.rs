//! `noether.integral#j`: a first integral that was found, with its generator.

use super::{generator, generator_formulas, integral, requirements, subjects};
use crate::noether::embedded::Embedded;
use crate::noether::generator::Generator;
use crate::noether::letters::ENERGY;
use crate::noether::shown::{is_constant, readable};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_symbolic::{Expr, Graph, Node, Verdict};

/// `noether.integral#j`.
#[derive(Clone, Copy, Debug)]
pub struct FirstIntegral;

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
         with δ = 1 for the energy and δ = 0 for the others."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let integral = match integral(cx, subject) {
            Ok(integral) => integral,
            Err(why) => return Verdict::undecided(why).into(),
        };
        let g = &cx.system.graph;
        let name = integral.name.as_deref();
        let named = name.map_or(String::new(), |name| format!(", {name}"));
        let mut formulas = vec![Formula {
            caption: format!("the first integral{named}"),
            left: None,
            right: integral.shown,
        }];
        let mut sentence = format!("{} keeps its value on every motion", g.text(integral.shown));
        if let Ok((_, n, generator)) = generator(cx, subject) {
            formulas.extend(generator_formulas(&n, &generator));
            sentence = format!("{sentence}; {}", symmetry(&n, &generator, name));
        }
        Finding {
            verdict: integral.verdict.prefixed(&sentence),
            formulas,
        }
    }
}

/// What the symmetry is, in words.
fn symmetry(n: &Embedded<'_>, generator: &Generator, name: Option<&str>) -> String {
    let (system, g) = (n.system, &n.system.graph);
    if name == Some(ENERGY) {
        return "it belongs to the symmetry under shifts of time".into();
    }
    let speeds = n.embedding.chart.parameters.iter().zip(&generator.xi);
    let along: Vec<(&str, Expr)> = speeds
        .map(|(speed, &xi)| (&speed.name[..], readable(g, xi)))
        .filter(|(_, xi)| !g.is_zero(*xi))
        .collect();
    if along.is_empty() {
        return match system.constraints.is_empty() {
            true => "no displacement belongs to it, as it contains no velocity".into(),
            false => "no displacement belongs to it, as it contains no velocity on the constraints"
                .into(),
        };
    }
    // ξ^i Y_i in the coordinates; shifts are what moves them by constants.
    let moved: Vec<(&str, Expr)> = system
        .coordinates
        .iter()
        .zip(&n.embedding.chart.basis)
        .map(|(c, row)| {
            let parts = row.iter().zip(&generator.xi);
            let parts: Vec<Expr> = parts.map(|(&b, &xi)| g.mul(&[b, xi])).collect();
            (&c.name[..], readable(g, g.add(&parts)))
        })
        .filter(|(_, e)| !g.is_zero(*e))
        .collect();
    match &moved[..] {
        [(coordinate, by)] if is_constant(system, *by) => {
            format!("it belongs to the symmetry under shifts of {coordinate}")
        }
        _ => match field(g, &moved) {
            text if text.chars().count() <= LONGEST => {
                format!("by Noether's theorem it belongs to the displacements along {text}")
            }
            _ => {
                let own = along.iter().map(|(speed, _)| *speed);
                format!(
                    "by Noether's theorem it belongs to displacements that change {} at once, with the components given below",
                    own.collect::<Vec<&str>>().join(", ")
                )
            }
        },
    }
}

/// A longer field is not written out in a sentence.
const LONGEST: usize = 120;

/// `x ∂/∂y - y ∂/∂x`.
fn field(g: &Graph, moved: &[(&str, Expr)]) -> String {
    let mut text = String::new();
    for (coordinate, e) in moved {
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
