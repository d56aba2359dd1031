//! Values of a parameter at which stability changes.

use crate::decision::about;
use crate::evidence::motions;
use crate::hurwitz::{Boundary, Crossing, Ranges};
use crate::question::{parameter_of_motion, Place, Question};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::Verdict;
use std::collections::BTreeMap;

/// `stability.critical#p`: the values of p at which the stability of a motion that contains it changes.
#[derive(Clone, Copy, Debug)]
pub struct Critical;

impl Claim for Critical {
    fn id(&self) -> &'static str {
        "stability.critical"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "The values of the parameter at which the stability of steady motions changes are enclosed, all of them"
    }

    fn explanation(&self) -> &'static str {
        include_str!("critical.md")
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        parameters(cx).into_keys().map(Some).collect()
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        Vec::new()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let all = parameters(cx);
        let Some(names) = subject.and_then(|own| all.get(own)) else {
            return Verdict::undecided("no steady motion contains this parameter").into();
        };
        let said: Option<Vec<String>> = names.iter().map(|name| changes(cx, name)).collect();
        match said {
            Some(said) => Verdict::Proved(Proof::exact("for all values of the parameter, the others as stated", said.join("; "))).into(),
            None => Verdict::undecided("a motion is not steady for all values of the parameter, or the boundaries were not enclosed").into(),
        }
    }
}

/// The parameters of motions, each with the names of the motions that contain it.
fn parameters(cx: &Context<'_>) -> BTreeMap<String, Vec<String>> {
    let g = &cx.system.graph;
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let named: Vec<String> = motions(cx).into_iter().flatten().collect();
    for (motion, name) in cx.system.steady.iter().zip(named) {
        if let Some(symbol) = parameter_of_motion(cx.system, motion) {
            found.entry(g.symbol_text(symbol)).or_default().push(name);
        }
    }
    found
}

/// Where the stability of a motion changes, and how.
fn changes(cx: &Context<'_>, name: &str) -> Option<String> {
    let about = about(cx, Some(name))?.ok()?;
    let (g, question) = (about.graph(), &about.question);
    let symbol = question.over?;
    let bound = question.bound(g)?;
    let ranges = question.ranges(g, &-bound.clone(), &bound)?.joined();
    let parameter = g.symbol_text(symbol);
    let listed = listed(question, &ranges, &parameter);
    Some(match listed.as_slice() {
        [] => format!("the stability of {name} is the same for all {parameter}"),
        list => format!("the stability of {name} changes at {}", list.join(", at ")),
    })
}

fn listed(question: &Question, ranges: &Ranges, parameter: &str) -> Vec<String> {
    let place = |side: Option<bool>| side.map(|is_left| question.place(is_left));
    let text = |boundary: &Boundary| {
        let root = &boundary.root;
        let before = ranges.regions.iter().rfind(|r| r.high <= root.low);
        let after = ranges.regions.iter().find(|r| r.low >= root.high);
        let (before, after) = (
            place(before.map(|r| r.is_left)),
            place(after.map(|r| r.is_left)),
        );
        let changes = before != after || boundary.crossing != Crossing::Touching;
        changes.then(|| {
            format!(
                "{parameter} in {} ({}{})",
                root.text(),
                how(boundary.crossing),
                towards(before, after)
            )
        })
    };
    ranges.boundaries.iter().filter_map(text).collect()
}

/// What happens at a boundary, in words.
fn how(crossing: Crossing) -> &'static str {
    match crossing {
        Crossing::Zero => "an eigenvalue passes through zero",
        Crossing::Pair => "a pair passes the imaginary axis",
        Crossing::Infinity => "an eigenvalue goes to infinity",
        Crossing::Collision => "two imaginary pairs meet",
        Crossing::Touching => "two eigenvalues are opposite",
    }
}

/// What the motion becomes with a growing parameter.
fn towards(before: Option<Place>, after: Option<Place>) -> &'static str {
    match (before, after) {
        (Some(a), Some(b)) if a == b => "",
        (_, Some(Place::Right)) => ", unstable above",
        (Some(Place::Right), _) => ", unstable below",
        _ => "",
    }
}
