//! `distribution.growth`: the growth vector of the admissible velocities, and what can be reached.

use crate::flag::{horizontal, Directed, Flag, Obstacle};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::words::counted;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};

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
        "The displacements that the constraints admit at one time form the distribution D¹; brackets of its fields with those found before add directions, step by step. The ranks are the growth vector, (2, 3) for a knife edge. Where they reach the number of coordinates, every configuration near another one can be reached by an admissible path (Chow 1939, Rashevskii 1938), and the system is controllable as far as kinematics go; where they stop before, as many functions of the position keep their values as ranks are missing, and these are among the first integrals. The claim is refuted then. Where the constraints contain the time, or velocities that nobody chooses, such a function need not be one of the motion, as the displacements of another time lead off its values: then the fields are taken on space and time, with the field of what happens by itself, ∂/∂t and the velocities at which the independent ones vanish. Where their brackets generate every direction there, the places that can be reached at a time fill an open set and no function of position and time keeps its value. A system without constraints generates everything at the first step."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.frame-regular".into(),
        ]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match cx.system.constraints.is_empty() {
            true => Vec::new(),
            false => vec![None],
        }
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let chart = match basis(cx).characteristics() {
            Ok(chart) => chart,
            Err(problem) => return Verdict::undecided(problem.to_string()).into(),
        };
        let (fields, drift) = match horizontal(cx.system, &chart) {
            Ok(found) => found,
            Err(why) => return Verdict::not_applicable("model.constraints-linear", why).into(),
        };
        let mut flag = Flag::of(cx, &fields, false, false);
        let stops = |flag: &Flag| flag.growth.last() < Some(&cx.system.n());
        let drifts =
            matches!(&flag, Ok(flag) if stops(flag)) && moves_by_itself(cx, &fields, &drift);
        if drifts {
            let all = [&fields[..], &[drift]].concat();
            flag = Flag::of(cx, &all, true, false);
        }
        match flag {
            Ok(flag) => reached(cx, flag, drifts).into(),
            Err(Obstacle::Undecided(tried)) => Verdict::undecided(tried).into(),
            Err(Obstacle::Contradiction(verdict)) => (*verdict).into(),
        }
    }
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

fn reached(cx: &Context<'_>, flag: Flag, drifts: bool) -> Verdict {
    let n = cx.system.n();
    let rank = flag.growth.last().copied().unwrap_or(0);
    let growth: Vec<String> = flag.growth.iter().map(usize::to_string).collect();
    let fields = match drifts {
        true => " of the fields on space and time, with the one of what happens by itself,",
        false => "",
    };
    let growth = format!("the growth vector{fields} is ({})", growth.join(", "));
    let full = full_at(cx, &flag, drifts);
    let missing = n + usize::from(drifts) - rank;
    let sentence = match (missing, drifts) {
        (0, false) => format!("{growth}{full}: every configuration nearby can be reached"),
        (0, true) => format!(
            "{growth}{full}: the configurations that can be reached at a time fill an open set"
        ),
        _ => {
            let of = match drifts {
                true => "of position and time",
                false => "of the position",
            };
            let kept = counted(
                missing,
                &format!("function {of} keeps its value"),
                &format!("functions {of} keep their values"),
            );
            match drifts {
                true => {
                    format!("{growth} with {n} coordinates: {kept} under all admissible motions")
                }
                false => format!(
                    "{growth} with {n} coordinates: {kept} under all admissible displacements"
                ),
            }
        }
    };
    match (flag.verdict, missing) {
        (Verdict::Proved(mut proof), 0) => {
            proof.on = "outside the points where a rank falls".into();
            proof.detail = format!("{sentence}; {}", proof.detail);
            Verdict::Proved(proof)
        }
        (Verdict::Proved(proof), _) => {
            Verdict::Refuted(chetaev_symbolic::verdict::Counterexample {
                point: Vec::new(),
                quantity: "the rank that is reached".into(),
                residual: (rank.to_string(), rank.to_string()),
                detail: format!("{sentence}; {}", proof.detail),
            })
        }
        (other, _) => other,
    }
}
