//! Claims on the stability of the steady motions that a model names; the subject is the name of the motion.
//!
//! Where one parameter occurs in the motion and not in the equations of the system, as the speed of a bicycle, the verdict speaks of
//! all its values: it is proved, refuted, or conditional on the ranges. Else it speaks of the values that the model states.

use crate::hurwitz::{Ranges, Region};
use crate::linearization::LinearizationError;
use crate::question::{Place, Question};
use crate::real_roots::{decimal, Root};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::{SteadyMotion, System};
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::verdict::{Counterexample, PointValue, Proof};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[&Stated, &Asymptotic, &Spectral];

/// `steady.stated#j`: the motion that the model names is admissible and steady.
#[derive(Clone, Copy, Debug)]
pub struct Stated;

/// `stability.asymptotic#j`: all transversal eigenvalues lie left of the axis.
#[derive(Clone, Copy, Debug)]
pub struct Asymptotic;

/// `stability.spectral#j`: no eigenvalue lies right of the axis.
#[derive(Clone, Copy, Debug)]
pub struct Spectral;

impl Claim for Asymptotic {
    fn id(&self) -> &'static str {
        "stability.asymptotic"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "All eigenvalues of the linear equations about the steady motion, but the zeros of its family, lie left of the imaginary axis"
    }

    fn explanation(&self) -> &'static str {
        include_str!("claims/asymptotic.md")
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx)
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        requires(subject)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        decided(cx, subject, Asked::Left)
    }
}

impl Claim for Spectral {
    fn id(&self) -> &'static str {
        "stability.spectral"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "No eigenvalue of the linear equations about the steady motion lies right of the imaginary axis"
    }

    fn explanation(&self) -> &'static str {
        include_str!("claims/spectral.md")
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx)
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        requires(subject)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        decided(cx, subject, Asked::NotRight)
    }
}

/// Which of the two is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Left,
    NotRight,
}

impl Asked {
    fn holds(self, place: Place) -> bool {
        match self {
            Asked::Left => place == Place::Left,
            Asked::NotRight => place != Place::Right,
        }
    }
}

fn subjects(cx: &Context<'_>) -> Vec<Option<String>> {
    cx.system
        .steady
        .iter()
        .map(|s| Some(s.name.clone()))
        .collect()
}

fn requires(subject: Option<&str>) -> Vec<String> {
    vec![format!("steady.stated#{}", subject.unwrap_or_default())]
}

/// The question of a motion: for all values of the parameter of the motion where that is steady for all of them, else for the stated values.
fn asked_of(
    cx: &Context<'_>,
    subject: Option<&str>,
) -> Option<Result<Question, LinearizationError>> {
    let system = cx.system;
    let motion = system
        .steady
        .iter()
        .find(|s| Some(s.name.as_str()) == subject)?;
    let of = |over| Question::new(system, cx.terms, cx.selection, motion, over);
    let general = parameter_of_motion(system, motion).map(|symbol| of(Some(symbol)));
    Some(match general {
        Some(Ok(question)) => Ok(question),
        _ => of(None),
    })
}

fn decided(cx: &Context<'_>, subject: Option<&str>, asked: Asked) -> Finding {
    match asked_of(cx, subject) {
        Some(Ok(question)) => verdict(cx.system, &question, asked).into(),
        Some(Err(problem)) => Verdict::undecided(problem.to_string()).into(),
        None => Verdict::undecided(UNKNOWN).into(),
    }
}

/// What is said of a subject that the model does not name.
const UNKNOWN: &str = "the model names no such steady motion";

impl Claim for Stated {
    fn id(&self) -> &'static str {
        "steady.stated"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "The motion is admissible, and everything that the equations of motion depend on is constant along it"
    }

    fn explanation(&self) -> &'static str {
        include_str!("claims/stated.md")
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        match asked_of(cx, subject) {
            Some(Ok(question)) => {
                Verdict::Proved(Proof::exact(on(&question), steadiness(&question))).into()
            }
            Some(Err(problem)) => refused(problem).into(),
            None => Verdict::undecided(UNKNOWN).into(),
        }
    }
}

/// For which values of the parameters.
fn on(question: &Question) -> &'static str {
    match question.over {
        Some(_) => "for all values of the parameter of the motion, the others as stated",
        None => "for the values of the parameters that are stated",
    }
}

/// What was found of a steady motion.
fn steadiness(question: &Question) -> String {
    let linear = &question.linear;
    let family = match linear.family {
        0 => String::new(),
        1 => "; it belongs to a family of dimension 1".into(),
        n => format!("; it belongs to a family of dimension {n}"),
    };
    let ignorable = match linear.ignorable.as_slice() {
        [] => String::new(),
        names => format!("; nothing depends on {}", names.join(", ")),
    };
    format!(
        "all constraints hold, and the rates of {} vanish{ignorable}{family}",
        linear.names.join(", ")
    )
}

/// What a motion that is not admissible or not steady comes to.
fn refused(problem: LinearizationError) -> Verdict {
    let sentence = problem.to_string();
    match problem {
        LinearizationError::NotAdmissible {
            enclosure: Some(residual),
            constraint,
            ..
        } => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: format!("the constraint {constraint}, left side minus right side"),
            residual,
            detail: sentence,
        }),
        LinearizationError::NotSteady {
            enclosure: Some(residual),
            quantity,
            ..
        } => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: format!("what changes {quantity}"),
            residual,
            detail: sentence,
        }),
        LinearizationError::OrderTooHigh { .. } => {
            Verdict::not_applicable("model.constraints-first-order", sentence)
        }
        LinearizationError::NotAutonomous => {
            Verdict::not_applicable("model.lagrangian-autonomous", sentence)
        }
        _ => Verdict::undecided(sentence),
    }
}

/// The parameter that occurs in the motion and not in the equations of the system, where there is exactly one.
pub fn parameter_of_motion(system: &System, motion: &SteadyMotion) -> Option<Symbol> {
    let g = &system.graph;
    let given: Vec<_> = motion
        .positions
        .iter()
        .chain(&motion.velocities)
        .flatten()
        .copied()
        .collect();
    let mut equations = vec![system.lagrangian];
    equations.extend(&system.forces);
    equations.extend(system.constraints.iter().map(|c| c.stated));
    equations.extend(system.definitions.iter().map(|(_, e)| *e));
    equations.extend(system.controls.iter().filter_map(|c| c.law));
    let used = g.symbols_in(&equations);
    let of_motion = g.symbols_in(&given).into_iter();
    let mut free = of_motion.filter(|s| !used.contains(s));
    free.next().filter(|_| free.next().is_none())
}

fn verdict(system: &System, question: &Question, asked: Asked) -> Verdict {
    let g = &system.graph;
    let Some(polynomial) = &question.polynomial else {
        return Verdict::undecided(format!(
            "the system has {} variables, more than an exact characteristic polynomial is made for",
            question.linear.variables.len()
        ));
    };
    if asked == Asked::Left && polynomial.further_zeros > 0 {
        return Verdict::undecided("an eigenvalue is zero and belongs to no family of steady motions that was found: the linear equations decide nothing");
    }
    if polynomial.degree() == 0 {
        let detail = "all eigenvalues are zeros of the family of steady motions; there is no other";
        return Verdict::Proved(Proof::exact("at the steady motion", detail));
    }
    match question.over {
        Some(symbol) => over(g, question, asked, symbol),
        None => at_values(system, question, asked),
    }
}

/// The verdict for the values that the model states.
fn at_values(system: &System, question: &Question, asked: Asked) -> Verdict {
    let g = &system.graph;
    let Some(signs) = question.signs(g, None) else {
        return Verdict::undecided("the signs of Hurwitz's determinants were not decided");
    };
    let all = signs.iter().all(|s| *s == Ordering::Greater);
    let place = question.place(g, all);
    if all && asked.holds(place) {
        let detail = match place {
            Place::Left => "Hurwitz's determinants are all positive",
            _ => "the characteristic polynomial is even, and its zeros are imaginary and simple by Hermite's and Biehler's theorem",
        };
        return Verdict::Proved(Proof::exact(
            "for the values of the parameters that are stated",
            detail,
        ));
    }
    let is_strict = signs.iter().all(|s| *s != Ordering::Equal);
    if is_strict || asked == Asked::Left {
        Verdict::Refuted(counterexample(question, &signs, stated_values(system)))
    } else {
        Verdict::undecided("a Hurwitz determinant vanishes: eigenvalues lie on the axis, or are mirror images of each other")
    }
}

/// What contradicts the claim: the first determinant that is not positive.
fn counterexample(
    question: &Question,
    signs: &[Ordering],
    point: Vec<PointValue>,
) -> Counterexample {
    // All positive, and yet refuted: what was decided is that the eigenvalues are on the axis.
    let is_even = signs.iter().all(|s| *s == Ordering::Greater);
    let negative = signs.iter().filter(|s| **s == Ordering::Less).count();
    let motion = "the linear equations about the steady motion";
    let (quantity, count, detail) = match (is_even, negative) {
        (true, _) => (
            "the number of eigenvalues on the imaginary axis",
            question.polynomial.as_ref().map_or(0, crate::characteristic::Characteristic::degree),
            format!("{motion} have an even characteristic polynomial: with λ, −λ is an eigenvalue, and none is left of the axis alone"),
        ),
        (false, 0) => (
            "the number of Hurwitz's determinants that vanish",
            signs.iter().filter(|s| **s == Ordering::Equal).count(),
            format!("{motion} have an eigenvalue on the axis, or two that are mirror images of each other"),
        ),
        (false, count) => (
            "the number of Hurwitz's determinants that are negative",
            count,
            format!("{motion} have an eigenvalue that does not lie left of the axis"),
        ),
    };
    Counterexample {
        point,
        quantity: quantity.into(),
        residual: (count.to_string(), count.to_string()),
        detail,
    }
}

/// The parameters with the values that the model states, exact where they are rational.
fn stated_values(system: &System) -> Vec<PointValue> {
    let g = &system.graph;
    let value = |(symbol, value): &(Expr, Expr)| {
        let exact = g.as_number(*value).cloned();
        let enclosure = match exact {
            Some(_) => None,
            None => {
                let ball = g
                    .enclose(&[*value], &Precision::new(128), &|_| None)
                    .ok()?
                    .pop()?;
                Some(ball.to_decimal_interval(20))
            }
        };
        Some(PointValue {
            name: g.text(*symbol),
            exact,
            enclosure,
        })
    };
    system.parameter_values().iter().filter_map(value).collect()
}

/// The verdict over all values of a parameter.
fn over(g: &Graph, question: &Question, asked: Asked, symbol: Symbol) -> Verdict {
    let found = question.bound(g).and_then(|bound| {
        let low = -bound.clone();
        Some((question.ranges(g, &low, &bound)?, bound))
    });
    let Some((ranges, bound)) = found else {
        return Verdict::undecided(format!(
            "the boundaries of stability in {} were not enclosed",
            g.symbol_text(symbol)
        ));
    };
    let holds = |region: &&Region| asked.holds(question.place(g, region.is_asymptotic));
    let name = g.symbol_text(symbol);
    let kept: Vec<&Region> = ranges.regions.iter().filter(holds).collect();
    let detail = "between zeros of Hurwitz's determinants, which are enclosed, the signs of all of them are decided at one value";
    if kept.is_empty() {
        let Some(region) = ranges.regions.first() else {
            return Verdict::undecided("no interval is left between the boundaries");
        };
        let Some(signs) = question.signs(g, Some(&region.sample)) else {
            return Verdict::undecided("the signs of Hurwitz's determinants were not decided");
        };
        let point = vec![PointValue {
            name,
            exact: Some(region.sample.clone()),
            enclosure: None,
        }];
        return Verdict::Refuted(counterexample(question, &signs, point));
    }
    let proof = Proof::exact("at the steady motion", detail);
    if kept.len() == ranges.regions.len() && ranges.boundaries.is_empty() {
        return Verdict::Proved(proof);
    }
    Verdict::Conditional {
        condition: condition(&name, &kept, &bound, asked),
        proof: Proof {
            detail: format!("{detail}; {}", enclosures(&name, &ranges)),
            ..proof
        },
        counterexample: None,
    }
}

/// The regions in words: `4.29 < v < 6.02 or v > 8`. Where eigenvalues on the axis are allowed the boundaries belong to them, by continuity.
fn condition(name: &str, kept: &[&Region], bound: &RBig, asked: Asked) -> String {
    let less = match asked {
        Asked::Left => "<",
        Asked::NotRight => "<=",
    };
    let low = -bound.clone();
    let text = |region: &&Region| {
        let (from, to) = (region.low != low, region.high != *bound);
        match (from, to) {
            (true, true) => format!(
                "{} {less} {name} {less} {}",
                decimal(&region.low),
                decimal(&region.high)
            ),
            (true, false) => format!("{name} {} {}", less.replace('<', ">"), decimal(&region.low)),
            (false, true) => format!("{name} {less} {}", decimal(&region.high)),
            (false, false) => format!("{name} is any number"),
        }
    };
    kept.iter().map(text).collect::<Vec<_>>().join(" or ")
}

/// Every boundary with its enclosure.
fn enclosures(name: &str, ranges: &Ranges) -> String {
    let text = |root: &Root| {
        if root.low == root.high {
            format!("{name} = {}", root.low)
        } else {
            format!("{name} in {}", root.text())
        }
    };
    let roots = ranges.boundaries.iter().map(|b| text(&b.root));
    roots.collect::<Vec<_>>().join(", ")
}
