//! `hamilton.kerner`: the motions and the constrained extremum are one system exactly where the constraints are integrable.

use crate::variations::Displacements;
use crate::words::for_general_controls;
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Group};
use chetaev_mechanics::words::quoted;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::Verdict;

/// `hamilton.kerner`.
#[derive(Clone, Copy, Debug)]
pub struct Kerner;

/// The claim that both systems have the same solutions.
const SYSTEMS: &str = "formulation.vakonomic-coincides#system";

impl Claim for Kerner {
    fn id(&self) -> &'static str {
        "hamilton.kerner"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Motion and constrained extremum are one system exactly where the constraints are integrable (Kerner)"
    }

    fn explanation(&self) -> &'static str {
        "Kerner's theorem is about constraints linear or affine in the velocities: the equations of motion and those of the constrained \
         extremum have the same curves as solutions, for all initial data and all κ(0), if and only if the constraints are completely \
         integrable. Both sides are decided by themselves for this system: integrability by the curvature coefficients A = 0, \
         the systems by their accelerations (formulation.vakonomic-coincides#system). It is not a statement about \
         inclusion: a rolling disc is not integrable, and yet each of its motions is an extremal. For constraints nonlinear in the velocities \
         it is false (Appell–Hamel), and then not applicable. \
         Example: z' = y x' + x y' is integrable, z − x y is constant, and κ does not act on the curves. z' = y x' \
         is not: its extremum has y'' = −κ x', with κ = x' = 1 that is −1, and the motion has y'' = 0."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        [
            "model.forces-absent",
            "model.accelerations-unique",
            "model.masses-of-time",
            "model.constrained-extremum-regular",
        ]
        .map(String::from)
        .to_vec()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.selection.rows.is_empty() {
            let detail = "there are no constraints, and the extremals are the motions";
            return Verdict::Proved(Proof::structural("for every motion", detail)).into();
        }
        let rows = cx.selection.rows.iter();
        let constraints = rows.map(|&row| &cx.system.constraints[cx.terms.constraint_index[row]]);
        let nonlinear: Vec<&str> = constraints
            .filter(|c| !c.is_affine_in_velocities())
            .map(|c| c.name.as_str())
            .collect();
        if !nonlinear.is_empty() {
            let names = quoted(&nonlinear);
            let detail = format!("nonlinear in the velocities: {names}; Kerner's theorem is about linear and affine constraints only");
            return Verdict::not_applicable("model.constraints-linear", detail).into();
        }
        compared(cx).into()
    }
}

fn compared(cx: &Context<'_>) -> Verdict {
    let d = match Displacements::new(cx) {
        Ok(d) => d,
        Err(problem) => return Verdict::from(&problem),
    };
    let flat = cx.prover.identity(
        cx.system,
        &d.curvature().concat(),
        d.manifold(),
        "at all admissible states",
    );
    let systems = cx.finding(SYSTEMS).verdict.clone();
    match (flat, systems) {
        (flat @ Verdict::Proved(_), systems @ Verdict::Proved(_)) => {
            let mut verdict = flat.and(systems);
            verdict
                .prefix("A = 0, the constraints are integrable, and the extremals are the motions");
            verdict
        }
        (Verdict::Refuted(curved), Verdict::Refuted(different)) => {
            // Each side is settled by a point, exactly.
            let mut proof = Proof::exact(
                "on the constraint manifold",
                format!("{}; {}", curved.detail, different.detail),
            );
            proof.detail = format!(
                "A ≠ 0, the constraints are not integrable, and for some κ(0) the extremals are other curves than the motions; \
                 each was shown at a state, see variation.hoelder and {SYSTEMS}{}",
                for_general_controls(cx)
            );
            Verdict::Proved(proof)
        }
        (Verdict::Refuted(found), Verdict::Proved(_))
        | (Verdict::Proved(_), Verdict::Refuted(found)) => {
            let mut verdict = Verdict::Refuted(found);
            verdict.prefix("one of both holds without the other");
            verdict
        }
        (flat, systems) => Verdict::undecided(format!(
            "whether A = 0 is {}, whether the systems are one is {}",
            flat.word(),
            systems.word()
        )),
    }
}
