//! `hamilton.endpoints`: the points that motions reach.

use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::words::counted;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::Verdict;

/// `hamilton.endpoints`.
#[derive(Clone, Copy, Debug)]
pub struct Endpoints;

impl Claim for Endpoints {
    fn id(&self) -> &'static str {
        "hamilton.endpoints"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Motions from one point reach a set of dimension n − r"
    }

    fn explanation(&self) -> &'static str {
        "Fixed ends are no matter of course: from a given position, with all admissible velocities, the motions reach at a time t₁ \
         shortly after t₀ a set of dimension k = n − r only, even where any two positions can be joined by admissible curves. The \
         derivative of q(t₁) by the k admissible initial velocities is (t₁ − t₀) B + O((t₁ − t₀)²), where the columns of B span the \
         virtual displacements; so its rank is that of B. The statement is about small t₁ − t₀: over longer times the rank \
         may drop at focal times. Example: a skate reaches, from one position, a surface of positions (x, y, φ), by its forward speed and its rate of turning. \
         On a level plane with the speed u and the rate w it is at t = 1 at x = (u/w) sin w, y = (u/w)(1 − cos w), \
         φ = w: two parameters for three coordinates."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.accelerations-unique".into()]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let chart = match basis(cx).independent_velocities() {
            Ok(chart) => chart,
            Err(problem) => return Verdict::undecided(problem.to_string()).into(),
        };
        let (n, k) = (cx.system.n(), chart.k());
        if k == 0 {
            let detail =
                "there is one admissible velocity at each position, and one motion from it";
            return Verdict::Proved(Proof::structural("everywhere", detail)).into();
        }
        let rank = match cx.prover.rank(cx.system, &chart.basis, &chart.manifold) {
            Ok(rank) => rank,
            Err(verdict) => return (*verdict).into(),
        };
        if rank.minimum != k {
            let tried = format!("the rank of B was found to be {}, not {k}", rank.minimum);
            return Verdict::undecided(tried).into();
        }
        let mut verdict = rank.at_least;
        if let Verdict::Proved(proof) = &mut verdict {
            proof.on = "for small t₁ − t₀, at almost every initial state".into();
        }
        let whole = match k == n {
            true => ", all positions nearby".to_string(),
            false => format!(" in the space of {n} coordinates"),
        };
        let sentence = format!(
            "the motions from one position reach a set of {}{whole}: the rank of B",
            counted(k, "dimension", "dimensions")
        );
        verdict.prefix(&sentence);
        verdict.into()
    }
}
