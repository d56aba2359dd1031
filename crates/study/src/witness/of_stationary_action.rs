//! `witness.action-stationary#…`: least action among curves that satisfy the constraints.

use super::claims::{elsewhere, is_fixed, nothing_varies, of_action};
use super::evidence;
use super::least_action::{among_admissible, Action};
use super::neighbours::COORDINATES;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group, Scope};
use chetaev_symbolic::Verdict;

/// The principles that are stated so.
const PRINCIPLES: [Action; 2] = [Action::Lagrange, Action::Jacobi];

/// `witness.action-stationary#PRINCIPLE`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfStationaryAction;

impl Claim for WitnessOfStationaryAction {
    fn id(&self) -> &'static str {
        "witness.action-stationary"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "Least action among admissible curves changes as hamilton.stationary says"
    }

    fn explanation(&self) -> &'static str {
        "Curves q + ε η beside the computed motion that satisfy the constraints to first order and have its ends, ∂f/∂q η + ∂f/∂v η' = 0, instead of virtual displacements: Lagrange's action ∫Σ p v dt at the energy of the motion and Jacobi's ∫P dτ are evaluated on them for ε on both sides of zero. \
         The derivative by ε, over the sizes of its terms, is stated with its change when the steps are doubled, and compared with hamilton.stationary, whose conditions on κ are those of the principles of least action too. On the longest stretch without rest. \
         Example: on a free motion of z' = y x' from rest in y the path is straight, and both actions are stationary; with x' = y' = 1 they are not, although both vanish for virtual displacements."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let principle = format!("action.{}", subject.unwrap_or_default());
        vec![principle, "model.constraints-scleronomic".into()]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if evidence(cx).is_none() || cx.terms.order != 1 || cx.system.n() > COORDINATES {
            return Vec::new();
        }
        PRINCIPLES.map(|a| Some(a.word().to_string())).to_vec()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let action = PRINCIPLES.into_iter().find(|a| Some(a.word()) == subject);
        let Some(action) = action else {
            return Verdict::undecided("there is no such principle").into();
        };
        if is_fixed(cx) {
            return nothing_varies("admissible neighbours with the same ends").into();
        }
        let quantity = match action {
            Action::Lagrange => "Δ∫Σ p v dt",
            _ => "δ∫P dτ",
        };
        match among_admissible(cx, action) {
            Ok(found) => of_action(cx, &found, quantity).into(),
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}
