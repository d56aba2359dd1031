//! `hamilton.constants`: how many constants the motion has, and how many the constrained extremum.

use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_mechanics::words::counted;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// `hamilton.constants`.
#[derive(Clone, Copy, Debug)]
pub struct Constants;

impl Claim for Constants {
    fn id(&self) -> &'static str {
        "hamilton.constants"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The motion has 2n − r constants, the constrained extremum 2n"
    }

    fn explanation(&self) -> &'static str {
        "A motion is determined by n positions and n − r admissible velocities. An extremal of the action under the constraints \
         needs beside them the initial values of its r multipliers κ, so its equations have 2n constants (where the matrix \
         [[L_vv + Σ κ f_vv, f_vᵀ], [f_v, 0]] is regular). The two systems are different systems wherever r > 0; whether every motion is an \
         extremal for some κ is hamilton.stationary. r counts independent constraints; one that holds positions themselves, x² + y² = 1, leaves one position less to both. \
         Example: a skate has n = 3, r = 1 and 5 constants: x, y, φ, its speed and its rate of turning; the \
         extremum has 6, with κ(0). A rolling disc with n = 4, r = 2 has 6, the extremum 8."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.accelerations-unique".into()]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let (n, r) = (cx.system.n(), cx.selection.rows.len());
        let held = match held_positions(cx) {
            Ok(held) => held,
            Err(open) => {
                return open
                    .prefixed("how many positions the constraints leave")
                    .into()
            }
        };
        let masses = cx.system.masses.len();
        let beside = match masses {
            0 => String::new(),
            count => format!(" and {}", counted(count, "mass", "masses")),
        };
        let own = format!(
            "the motion has {} constants: {}, {}{beside}",
            2 * n - r - held + masses,
            counted(n - held, "position", "positions"),
            counted(n - r, "velocity", "velocities"),
        );
        let regular = cx.finding("model.constrained-extremum-regular");
        let extremum = match (&regular.verdict, r) {
            (_, 0) => "; there are no constraints, and the extremum is the motion".to_string(),
            (Verdict::Proved(_), _) => format!(
                "; the constrained extremum has {}, with {} κ(0)",
                2 * n - held + masses,
                counted(r, "initial multiplier", "initial multipliers")
            ),
            (Verdict::Refuted(_), _) => {
                "; the constrained extremum determines no motion (model.constrained-extremum-regular)".into()
            }
            _ => "; whether the constrained extremum is an ordinary differential equation was not decided".into(),
        };
        let mut verdict = Verdict::Proved(Proof::structural(
            "where the accelerations are unique",
            "the equations of motion are solved for as many accelerations as there are independent velocities",
        ));
        if let (Verdict::Proved(proof), true) = (&regular.verdict, r > 0) {
            let mut proof = proof.clone();
            proof.on = "where the accelerations are unique".into();
            verdict = verdict.and(Verdict::Proved(proof));
        }
        verdict.prefix(&format!("{own}{extremum}"));
        verdict.into()
    }
}

/// How many positions are held by constraints on positions: the rank of their gradients.
fn held_positions(cx: &Context<'_>) -> Result<usize, Box<Verdict>> {
    let rows: Vec<Vec<Expr>> = (0..cx.terms.jacobian.len())
        .filter(|&row| {
            let constraint = &cx.system.constraints[cx.terms.constraint_index[row]];
            constraint.kind == ConstraintKind::Holonomic
        })
        .map(|row| cx.terms.jacobian[row].clone())
        .collect();
    if rows.is_empty() {
        return Ok(0);
    }
    match cx.prover.rank(cx.system, &rows, &manifold(cx)) {
        Ok(rank) if rank.minimum == rank.maximum => Ok(rank.maximum),
        Ok(_) => {
            let tried = "constraints on positions have different ranks on their components";
            Err(Box::new(Verdict::undecided(tried)))
        }
        Err(open) => Err(open),
    }
}
