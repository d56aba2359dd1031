//! `distribution.growth`: the growth vector of the admissible velocities, and what can be reached.

use crate::flag::{horizontal, Flag, Obstacle};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::words::counted;
use chetaev_symbolic::Verdict;

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
        "The displacements that the constraints admit at one time form the distribution D¹; brackets of its fields with those found before add directions, step by step. The ranks are the growth vector, (2, 3) for a knife edge. Where they reach the number of coordinates, every configuration near another one can be reached by an admissible path (Chow 1939, Rashevskii 1938), and the system is controllable as far as kinematics go; where they stop before, as many functions of the position keep their values as ranks are missing, and these are among the first integrals. The claim is refuted then; a system without constraints generates everything at the first step."
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
        let fields = match horizontal(cx.system, &chart) {
            Ok((fields, _)) => fields,
            Err(why) => return Verdict::not_applicable("model.constraints-linear", why).into(),
        };
        match Flag::of(cx, &fields, false, false) {
            Ok(flag) => reached(cx, flag).into(),
            Err(Obstacle::Undecided(tried)) => Verdict::undecided(tried).into(),
            Err(Obstacle::Contradiction(verdict)) => (*verdict).into(),
        }
    }
}

fn reached(cx: &Context<'_>, flag: Flag) -> Verdict {
    let n = cx.system.n();
    let rank = flag.growth.last().copied().unwrap_or(0);
    let growth: Vec<String> = flag.growth.iter().map(usize::to_string).collect();
    let growth = format!("the growth vector is ({})", growth.join(", "));
    let missing = n - rank;
    let sentence = match missing {
        0 => format!("{growth}: every configuration nearby can be reached"),
        _ => {
            let kept = counted(
                missing,
                "function of the position keeps its value",
                "functions of the position keep their values",
            );
            format!("{growth} with {n} coordinates: at each time {kept} under all admissible displacements")
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
