//! `noether.moving-direction#j` and `noether.moving-axis#j`: momenta and moments of momentum that particles keep.

use super::parts::{parts, Part};
use super::values::by_values;
use super::{requirements, the_same_there};
use crate::noether::motion::Motion;
use crate::noether::moving::{axes, directions, masses_are_constant, Kept, Searched};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_symbolic::{Expr, Verdict};
use std::sync::Arc;

/// `noether.moving-direction#j`.
#[derive(Clone, Copy, Debug)]
pub struct MovingDirection;

/// `noether.moving-axis#j`.
#[derive(Clone, Copy, Debug)]
pub struct MovingAxis;

struct Directions(Result<Searched, String>);
struct Axes(Result<Searched, String>);

fn subjects(cx: &Context<'_>, id: &str, count: impl FnOnce() -> usize) -> Vec<Option<String>> {
    let claim = cx.registry().find(id);
    let obstacle = claim.is_none_or(|claim| cx.obstacle(claim, None).is_some());
    let applies = !cx.system.particles.is_empty() && masses_are_constant(cx);
    if !applies || obstacle || cx.is_out_of_time() {
        return Vec::new();
    }
    match count() {
        0 => vec![None],
        count => (1..=count).map(|j| Some(j.to_string())).collect(),
    }
}

/// What a claim tried.
struct Tried {
    /// The candidates, in words.
    candidates: &'static str,
    /// Everything else that is fixed.
    fixed: &'static str,
}

const DIRECTIONS: Tried = Tried {
    candidates: "directions of the axes, those that turn with an angle of the model or of the time, and those from particle to particle",
    fixed: "along any other fixed direction",
};

const AXES_IN_PLANE: Tried = Tried {
    candidates: "the axis across the plane through the origin, the particles, the centre of mass and the point that the coordinates carry along",
    fixed: "about any other fixed point",
};

const AXES: Tried = Tried {
    candidates: "axes along the coordinate axes, along directions that turn with an angle of the model or of the time and from particle to particle, through the origin, the particles, the centre of mass and the point that the coordinates carry along",
    fixed: "about any other fixed axis, screws among them",
};

fn decide(
    cx: &Context<'_>,
    searched: &Result<Searched, String>,
    subject: Option<&str>,
    tried: &Tried,
) -> Finding {
    let searched = match searched {
        Ok(searched) => searched,
        Err(why) => return Verdict::undecided(why.clone()).into(),
    };
    let number = subject.and_then(|s| s.parse::<usize>().ok()).unwrap_or(0);
    match number.checked_sub(1).and_then(|i| searched.kept.get(i)) {
        Some(kept) => proved(cx, kept),
        None => Verdict::undecided(none(cx, searched, tried)).into(),
    }
}

/// What is said where nothing is kept that the constraints do not make constant.
fn none(cx: &Context<'_>, searched: &Searched, tried: &Tried) -> String {
    let trivial = trivial(cx, searched);
    let (but, which) = match trivial.is_empty() {
        true => ("", String::new()),
        false => (
            ", other than those that are trivial",
            format!(
                "; trivial, as the constraints make it constant: {}",
                trivial.join(", ")
            ),
        ),
    };
    let fixed = match searched.all_fixed {
        true => format!("; nor is one {} for all values of parameters", tried.fixed),
        false => String::new(),
    };
    format!(
        "none of {} candidates is kept, in general or for the values of parameters that the model states{but}: {}{fixed}{which}",
        searched.tried, tried.candidates
    )
}

/// What the constraints make constant, with its value there.
fn trivial(cx: &Context<'_>, searched: &Searched) -> Vec<String> {
    let Ok(motion) = Motion::of(cx) else {
        return Vec::new();
    };
    let g = &cx.system.graph;
    let is_constant = |kept: &&Kept| {
        let slopes = motion.gradients(&[kept.value]).concat();
        let on = "on the constraint manifold";
        let verdict = cx.prover.identity(cx.system, &slopes, &motion.manifold, on);
        matches!(verdict, Verdict::Proved(_))
    };
    let named = |kept: &Kept| {
        let others = kept.also.iter().take(MOST_TRIVIAL);
        let others = others.map(|(e, a)| format!(", {}", words((e, a.as_deref()))));
        let others: String = others.collect();
        format!("{}{others} ({})", what(kept), g.text(kept.shown))
    };
    let all = searched.constant.iter().filter(is_constant);
    all.take(MOST_TRIVIAL).map(named).collect()
}

/// More of what is trivial is not named, nor more places for which it is the same.
const MOST_TRIVIAL: usize = 4;

fn what(kept: &Kept) -> String {
    let kind = match &kept.point {
        None => "the momentum",
        Some(_) => "the moment of momentum",
    };
    format!("{kind} {}", words(kept.names()))
}

fn words((direction, point): (&str, Option<&str>)) -> String {
    match point {
        None => format!("along {direction}"),
        Some(point) => format!("about {direction} through {point}"),
    }
}

fn proved(cx: &Context<'_>, kept: &Kept) -> Finding {
    let (system, g) = (cx.system, &cx.system.graph);
    let motion = match Motion::of(cx) {
        Ok(motion) => motion,
        Err(why) => return Verdict::undecided(why).into(),
    };
    let rate = motion.derivatives(&[kept.value]);
    let mut residuals: Vec<Expr> = rate.iter().map(|&rate| g.sub(rate, kept.rate)).collect();
    if !kept.as_stated {
        residuals.push(kept.rate);
    }
    let on = "on the constraint manifold";
    let balance = cx.prover.identity(system, &residuals, &motion.manifold, on);
    let verdict = match kept.as_stated {
        false => balance,
        true => match by_values(cx, &motion, kept.value) {
            Some(found) => found.verdict.and(balance),
            None => Verdict::undecided(
                "for the values stated its rate vanishes at the points drawn, which was not proved",
            ),
        },
    };
    let what = what(kept);
    let also = kept.also.iter();
    let also: Vec<String> = also.map(|(e, a)| words((e, a.as_deref()))).collect();
    let also = match also.is_empty() {
        true => String::new(),
        false => format!(
            ", on the constraints the same up to a constant factor {}",
            also.join(", ")
        ),
    };
    let trivial = match is_trivial(cx, &motion, kept) {
        true => " (trivial, as it vanishes on the holonomic constraints)",
        false => "",
    };
    let sentence = format!("{what} is kept: {}{trivial}{also}", g.text(kept.shown));
    Finding {
        verdict: verdict.prefixed(&sentence),
        formulas: vec![Formula {
            caption: what,
            left: None,
            right: kept.shown,
        }],
    }
}

/// Whether it vanishes wherever the holonomic constraints hold themselves, not only their derivatives.
fn is_trivial(cx: &Context<'_>, motion: &Motion<'_>, kept: &Kept) -> bool {
    if cx.system.fixed_functions().is_empty() {
        return false;
    }
    let resolved = |e: Expr| cx.system.with_definitions(e);
    let value = [resolved(kept.value)];
    let vanishes = |part: &Part| {
        let on = "on the holonomic constraints";
        let verdict = cx.prover.identity(cx.system, &value, &part.manifold, on);
        matches!(verdict, Verdict::Proved(_))
    };
    let parts = parts(cx, motion, &[], &resolved);
    parts.is_ok_and(|parts| !parts.is_empty() && parts.iter().all(vanishes))
}

impl Claim for MovingDirection {
    fn id(&self) -> &'static str {
        "noether.moving-direction"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "Particles keep their momentum along a direction, which may move"
    }

    fn explanation(&self) -> &'static str {
        "The momentum K of particles along a direction e, a function of the state, changes at the rate K·e' + F·e with all forces F on the particles, reactions among them. Where a translation along e is a virtual displacement, reactions do no work on it and active forces suffice; otherwise they are needed, and are taken from the motion. Directions are searched among the axes, those that turn with an angle whose sine or cosine occurs, of the place, the time or a control, and unit vectors from particle to particle; all fixed directions, oblique ones as (4, -3) too, follow from linear equations for the components of e, whose coefficients may contain parameters. What the constraints make constant, as m v where x' = v, is trivial and is named where nothing else is kept. `conditional` says that it is kept for the values of parameters that the model states, and which of them it takes."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx, self.id(), || {
            of_directions(cx).0.as_ref().map_or(0, |s| s.kept.len())
        })
    }

    fn decide_there(
        &self,
        cx: &Context<'_>,
        subject: Option<&str>,
        there: &Context<'_>,
    ) -> Finding {
        the_same_there((cx, there), (self, subject))
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        decide(cx, &of_directions(cx).0, subject, &DIRECTIONS)
    }
}

impl Claim for MovingAxis {
    fn id(&self) -> &'static str {
        "noether.moving-axis"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "Particles keep their moment of momentum about an axis, which may move"
    }

    fn explanation(&self) -> &'static str {
        "The moment of momentum of particles about an axis e through a point A, both functions of the state, changes at the rate K·(r_A' × e) + H_A·e' + M_A·e with the moment M_A of all forces, reactions among them. Axes are searched among those of the directions of `noether.moving-direction`, in the plane the one across it; points among the origin, the particles, the centre of mass and the point that the coordinates carry along, as that of contact of a blade. All fixed axes follow from linear equations: the combinations a·K + b·H_O with constant a and b that keep their values are moments about b through b × a/b² where a·b = 0, and in others a·b/b² times the momentum along b stands beside the moment, which is a screw. What the constraints make constant is trivial and is named where nothing else is kept."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx, self.id(), || {
            of_axes(cx).0.as_ref().map_or(0, |s| s.kept.len())
        })
    }

    fn decide_there(
        &self,
        cx: &Context<'_>,
        subject: Option<&str>,
        there: &Context<'_>,
    ) -> Finding {
        the_same_there((cx, there), (self, subject))
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let particles = cx.system.particles.iter();
        let dimension = particles.map(|p| p.position.len()).max();
        let tried = match dimension {
            Some(2) => &AXES_IN_PLANE,
            _ => &AXES,
        };
        decide(cx, &of_axes(cx).0, subject, tried)
    }
}

fn of_directions(cx: &Context<'_>) -> Arc<Directions> {
    cx.shared(|cx| Directions(directions(cx)))
}

fn of_axes(cx: &Context<'_>) -> Arc<Axes> {
    cx.shared(|cx| Axes(axes(cx)))
}
