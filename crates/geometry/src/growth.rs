//! `distribution.growth`: the growth vector of the admissible velocities, and what can be reached.

mod poles;

use crate::flag::{derived, horizontal, Directed, Flag, Obstacle};
use crate::integrability::components::{are_apart, components};
use crate::integrability::{integral, on_its_own};
use crate::parameters;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group, Scope};
use chetaev_mechanics::components::Stratum;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::words::counted;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};
use poles::without_poles;
use std::sync::Arc;

/// `distribution.growth`.
#[derive(Clone, Copy, Debug)]
pub struct Growth;

impl Claim for Growth {
    fn id(&self) -> &'static str {
        "distribution.growth"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "Admissible displacements generate all directions by their brackets"
    }

    fn explanation(&self) -> &'static str {
        "The displacements that the constraints admit at one time form the distribution D¹; brackets of its fields with those found before add directions, step by step. The ranks are the growth vector, (2, 3) for a knife edge. Where they reach the number of coordinates, every configuration near another one can be reached by an admissible path (Chow 1939, Rashevskii 1938), and the system is controllable as far as kinematics go; where they stop before, as many functions of the position keep their values as ranks are missing, and these are among the first integrals. The claim is refuted then, and the functions are named as far as they were found. The derived flag takes the brackets of all fields found with each other at each step; what its ranks leave are the ranks of the derived systems of the constraints' Pfaff system. Where abs and sign make corners in the place, each side is looked at by itself; where constraints are products of linear ones, each of these is. Where the constraints contain the time, or velocities that nobody chooses, such a function need not be one of the motion, as the displacements of another time lead off its values: then the fields are taken on space and time, with the field of what happens by itself, ∂/∂t and the velocities at which the independent ones vanish. Where their brackets generate every direction there, the places that can be reached at a time fill an open set and no function of position and time keeps its value. A system without constraints generates everything at the first step."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.frame-regular".into(),
        ]
    }

    fn scope(&self) -> Scope {
        // Components are looked at one by one here.
        Scope::Functions
    }

    fn is_for_any_controls(&self) -> bool {
        false
    }

    fn is_asked_of_values(&self) -> bool {
        true
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match cx.system.constraints.is_empty() {
            true => Vec::new(),
            false => vec![None],
        }
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        parameters::with_definitions(cx, decided)
    }
}

/// What admissible displacements generate, on the positions; where that is not everything and something moves by itself, on positions
/// and the time with the field of that.
#[derive(Debug)]
pub(crate) struct Generated {
    pub(crate) generators: Vec<Directed>,
    pub(crate) flag: Result<Flag, Obstacle>,
    /// Whether the fields are those on positions and the time.
    pub(crate) with_time: bool,
}

impl Generated {
    /// How many functions of the position, and of the time where the fields are on it, keep their values; `None` where it is not proved.
    pub(crate) fn kept(&self, cx: &Context<'_>) -> Option<usize> {
        let flag = self.flag.as_ref().ok()?;
        let all = cx.system.n() + usize::from(self.with_time);
        matches!(flag.verdict, Verdict::Proved(_)).then(|| all.saturating_sub(flag.fields.len()))
    }
}

/// [`Generated`], once for all claims, or the verdict that there are no such fields.
pub(crate) fn generated(cx: &Context<'_>) -> Arc<Result<Generated, Box<Verdict>>> {
    cx.shared(|cx| {
        let chart = basis(cx).characteristics();
        let chart = chart.map_err(|problem| Box::new(Verdict::undecided(problem.to_string())))?;
        let (fields, drift) = horizontal(cx.system, &chart).map_err(|why| {
            let hypothesis = "model.constraints-linear";
            Box::new(Verdict::not_applicable(hypothesis, why))
        })?;
        let flag = Flag::of(cx, &fields, false, false);
        let stops = |flag: &Flag| flag.growth.last() < Some(&cx.system.n());
        let with_time =
            matches!(&flag, Ok(flag) if stops(flag)) && moves_by_itself(cx, &fields, &drift);
        Ok(match with_time {
            true => {
                let generators = [&fields[..], &[drift]].concat();
                Generated {
                    flag: Flag::of(cx, &generators, true, false),
                    generators,
                    with_time,
                }
            }
            false => Generated {
                generators: fields,
                flag,
                with_time,
            },
        })
    })
}

fn decided(cx: &Context<'_>) -> Finding {
    let (system, g) = (cx.system, &cx.system.graph);
    let constraints = system.constraints.iter().map(|c| c.f);
    let corners = system.corners_of(&constraints.collect::<Vec<Expr>>());
    // Where absolute values of velocities stand, admissible displacements form no linear space.
    if g.any_contains_any(&corners, &system.velocity_symbols()) {
        return smooth(cx);
    }
    let sides = system.all_sides();
    match (sides.is_empty(), corners.is_empty()) {
        (true, true) => smooth(cx),
        (true, false) => with_corners_left(),
        (false, _) => apart(cx, sides, "where ", on_side),
    }
}

/// On one side of the corners.
fn on_side(cx: &Context<'_>) -> Finding {
    match cx.system.all_sides().is_empty() {
        true => smooth(cx),
        false => with_corners_left(),
    }
}

fn with_corners_left() -> Finding {
    let tried = "the constraints have more corners than are looked at one by one";
    Verdict::undecided(tried).into()
}

/// Where the constraints are smooth: one system, or the components of constraints that are products.
fn smooth(cx: &Context<'_>) -> Finding {
    if are_apart(cx) {
        let why = "the constraints are not affine in the velocities";
        return on_components(cx, Verdict::not_applicable("model.constraints-linear", why));
    }
    let generated = generated(cx);
    let generated = match &*generated {
        Ok(generated) => generated,
        Err(none) if matches!(**none, Verdict::NotApplicable { .. }) => {
            return on_components(cx, Verdict::clone(none));
        }
        Err(other) => return Verdict::clone(other).into(),
    };
    let flag = match &generated.flag {
        Ok(flag) => flag,
        Err(Obstacle::Undecided(tried)) => return Verdict::undecided(tried.clone()).into(),
        Err(Obstacle::Contradiction(verdict)) => return Verdict::clone(verdict).into(),
    };
    let finding = reached(cx, flag, generated);
    let own = vector(flag, generated.with_time);
    parameters::notice(cx, &own, |own| match &*self::generated(own) {
        Ok(generated) => {
            let flag = generated.flag.as_ref().ok()?;
            Some(vector(flag, generated.with_time))
        }
        Err(_) => None,
    });
    finding
}

/// What is said of several systems in the place of one: of sides of corners, each by itself. Near a place of one side only that side counts.
fn apart(
    cx: &Context<'_>,
    systems: Vec<Stratum>,
    words: &str,
    decide: impl Fn(&Context<'_>) -> Finding,
) -> Finding {
    let mut all = Vec::new();
    for on in systems {
        let own = on_its_own(cx, &on.system, &decide);
        let none = || Verdict::undecided("it has no independent velocities").into();
        all.push((
            on.condition.unwrap_or(on.sentence),
            own.unwrap_or_else(none),
        ));
    }
    let is = |word: &str| all.iter().filter(|(_, f)| f.verdict.word() == word).count();
    let sentence = said_of(&all, words);
    let formulas = all.iter().flat_map(|(_, f)| f.formulas.clone()).collect();
    let (proved, refuted) = (is("proved"), is("refuted"));
    let holds = all.iter().filter(|(_, f)| f.verdict.word() == "proved");
    let places: Vec<&str> = holds.map(|(place, _)| place.as_str()).collect();
    let condition = places.join(" or ");
    let among = "paths from one side to another may join more than those on one side do";
    let first = all.iter().map(|(_, f)| f.verdict.clone());
    let verdict = match first.reduce(Verdict::and) {
        Some(Verdict::Proved(proof)) => Verdict::Proved(Proof {
            detail: sentence,
            ..proof
        }),
        Some(Verdict::Refuted(found)) if refuted == all.len() => Verdict::Refuted(Counterexample {
            detail: format!("{among}; {sentence}"),
            ..found
        }),
        Some(Verdict::Refuted(found)) if proved > 0 && proved + refuted == all.len() => {
            Verdict::Conditional {
                condition,
                proof: Proof::exact("on each side by itself", format!("{among}; {sentence}")),
                counterexample: Some(found),
            }
        }
        _ => Verdict::undecided(sentence),
    };
    Finding { verdict, formulas }
}

/// What is said of several places, once where it is the same.
fn said_of(all: &[(String, Finding)], words: &str) -> String {
    let mut said: Vec<(String, &str)> = Vec::new();
    for (place, finding) in all {
        let detail = finding.verdict.detail();
        match said.iter_mut().find(|(_, known)| *known == detail) {
            Some((places, _)) => *places = format!("{places}, and {words}{place}"),
            None => said.push((format!("{words}{place}"), detail)),
        }
    }
    let texts = said
        .iter()
        .map(|(places, detail)| format!("{places}: {detail}"));
    texts.collect::<Vec<String>>().join("; ")
}

/// On the components of constraints that are products, where these are affine: what all of them generate each of them does; where one
/// does not, paths that go over from one to another may. Constraints that are functions of affine ones are replaced by these.
fn on_components(cx: &Context<'_>, none: Verdict) -> Finding {
    let components = components(cx);
    if let [only] = components.as_slice() {
        let own = on_its_own(cx, &only.system, decided);
        let known = own.filter(|own| !matches!(own.verdict, Verdict::NotApplicable { .. }));
        return known.map_or(none.into(), |mut own| {
            own.verdict.prefix(&only.sentence);
            own
        });
    }
    if components.is_empty() {
        return none.into();
    }
    let words = "on the component ";
    let mut finding = apart(cx, components, words, decided);
    if !matches!(finding.verdict, Verdict::Proved(_)) {
        let said = finding.verdict.detail().to_owned();
        let said = said.replacen("one side", "one component", 2);
        let why = format!("{}; component by component: {said}", none.detail());
        finding.verdict = Verdict::not_applicable("model.constraints-linear", why);
    }
    finding
}

/// The growth vector in words.
fn vector(flag: &Flag, with_time: bool) -> String {
    let growth: Vec<String> = flag.growth.iter().map(usize::to_string).collect();
    let fields = match with_time {
        true => " of the fields on space and time, with the one of what happens by itself,",
        false => "",
    };
    format!("the growth vector{fields} is ({})", growth.join(", "))
}

/// The derived flag in words, where it was found.
fn derived_flag(cx: &Context<'_>, flag: &Flag, generated: &Generated) -> Option<String> {
    // After one step of brackets both flags are the same.
    let ranks = match flag.growth.len() {
        1 | 2 => flag.growth.clone(),
        _ => derived(cx, &generated.generators, generated.with_time).ok()?,
    };
    let all = cx.system.n() + usize::from(generated.with_time);
    let listed = |ranks: Vec<usize>| {
        let texts: Vec<String> = ranks.iter().map(usize::to_string).collect();
        texts.join(", ")
    };
    let forms = ranks.iter().map(|rank| all.saturating_sub(*rank)).collect();
    Some(format!(
        "the derived flag, with all brackets at each step, has the ranks ({}), that of the Pfaff system ({})",
        listed(ranks),
        listed(forms)
    ))
}

/// Whether something moves at rest of the independent velocities, or the admissible displacements change with the time.
fn moves_by_itself(cx: &Context<'_>, fields: &[Directed], drift: &Directed) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let timed = |&e: &Expr| system.is_rheonomic(e);
    drift.place.iter().any(|&e| !g.is_zero(e))
        || fields.iter().any(|field| field.place.iter().any(timed))
}

/// The longest condition that is printed, in signs.
const SHOWN: u64 = 60;
/// Of more fields no determinant is formed.
const MOST: usize = 6;

/// Where the fields that were found are independent, as a part of the sentence: nothing where that is so wherever they are defined.
/// Where it is not so, further brackets may be.
fn full_at(cx: &Context<'_>, flag: &Flag, with_time: bool) -> String {
    let g = &cx.system.graph;
    let almost = || " at almost every place".to_string();
    let rows = flag.fields.iter().map(|field| {
        let time = with_time.then_some(field.time);
        time.into_iter()
            .chain(field.place.iter().copied())
            .collect()
    });
    let matrix: Vec<Vec<Expr>> = rows.collect();
    if matrix.len() > MOST || matrix.iter().any(|row| row.len() != matrix.len()) {
        return almost();
    }
    let minor = simplify::simplify(g, determinant(g, &matrix), &simplify::Options::default());
    let Some(parts) = factored(g, minor) else {
        return almost();
    };
    let moves = |s: Symbol| cx.system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
    let may_vanish = |&&(factor, power): &&(Expr, i64)| {
        let is_known = known_sign(g, factor, &assumptions(cx.system)).is_nonzero();
        power > 0 && !g.is_free_of(factor, &moves) && !is_known
    };
    let vanishing = parts.factors.iter().filter(may_vanish);
    let conditions: Vec<Expr> = vanishing.map(|&(factor, _)| factor).collect();
    if conditions.iter().any(|&e| simplify::length(g, e) > SHOWN) {
        return almost();
    }
    let texts: Vec<String> = conditions
        .iter()
        .map(|&e| format!("{} ≠ 0", g.text(e)))
        .collect();
    match texts.is_empty() {
        true => String::new(),
        false => format!(
            " where {} (elsewhere it was not looked at)",
            texts.join(" and ")
        ),
    }
}

/// Where everything is generated, as a part of the sentence.
fn everywhere_at(cx: &Context<'_>, flag: &Flag, generated: &Generated) -> String {
    let with_time = generated.with_time;
    match without_poles(cx, &generated.generators) {
        None => full_at(cx, flag, with_time),
        Some(fields) => match Flag::of(cx, &fields, with_time, false) {
            Ok(flag) => full_at(cx, &flag, with_time),
            Err(_) => " at almost every place".into(),
        },
    }
}

fn reached(cx: &Context<'_>, flag: &Flag, generated: &Generated) -> Finding {
    let (n, drifts) = (cx.system.n(), generated.with_time);
    let rank = flag.growth.last().copied().unwrap_or(0);
    let growth = vector(flag, drifts);
    let missing = n + usize::from(drifts) - rank;
    let full = match missing {
        0 => everywhere_at(cx, flag, generated),
        _ => String::new(),
    };
    let mut sentence = match (missing, drifts) {
        (0, false) => format!("{growth}{full}: every configuration nearby can be reached"),
        (0, true) => format!(
            "{growth}{full}: the configurations that can be reached at a time fill an open set"
        ),
        (_, true) => format!(
            "{growth}, of {} dimensions, {} and the time: {}",
            n + 1,
            counted(n, "coordinate", "coordinates"),
            keeping(missing, drifts)
        ),
        (_, false) => format!(
            "{growth} with {}: {}",
            counted(n, "coordinate", "coordinates"),
            keeping(missing, drifts)
        ),
    };
    let mut formulas = Vec::new();
    if missing > 0 {
        let (said, shown) = integral::named(cx, missing);
        sentence = format!("{sentence}: {said}");
        formulas = shown;
    }
    if let Some(derived) = derived_flag(cx, flag, generated) {
        sentence = format!("{sentence}; {derived}");
    }
    let verdict = match (flag.verdict.clone(), missing) {
        (Verdict::Proved(mut proof), 0) => {
            proof.on = "outside the points where a rank falls".into();
            proof.detail = format!("{sentence}; {}", proof.detail);
            Verdict::Proved(proof)
        }
        (Verdict::Proved(proof), _) => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "the rank that is reached".into(),
            residual: (rank.to_string(), rank.to_string()),
            detail: format!("{sentence}; {}", proof.detail),
        }),
        (other, _) => other,
    };
    Finding { verdict, formulas }
}

/// How many functions are kept, in words.
fn keeping(missing: usize, with_time: bool) -> String {
    let (of, under) = match with_time {
        true => ("of position and time", "motions"),
        false => ("of the position", "displacements"),
    };
    let kept = counted(
        missing,
        &format!("function {of} keeps its value"),
        &format!("functions {of} keep their values"),
    );
    format!("{kept} under all admissible {under}")
}
