//! `formulation.gauss-least`: whether Gauss's constraint is least on the motion, or only stationary.

use super::{Claim, Context, Finding, Formula, Group};
use crate::claims::formulation::basis;
use crate::formulations::gauss::{kind, Kind};
use chetaev_symbolic::Verdict;

/// The claim.
#[derive(Clone, Copy, Debug)]
pub struct Least;

impl Claim for Least {
    fn id(&self) -> &'static str {
        "formulation.gauss-least"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "Gauss's constraint is least on the motion"
    }

    fn explanation(&self) -> &'static str {
        "The accelerations of the motion make Gauss's function Z = ½ (a − α)ᵀ W (a − α) stationary among those that the \
         constraints allow. It is least where W is positive on the virtual displacements, that is, where BᵀWB is positive \
         definite for a basis B of them. Refuted: a virtual displacement along which the second derivative of Z is negative \
         at a state; the motion is then a stationary point and no minimum, and its equations hold all the same."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        match kind(&basis(cx), &cx.prover) {
            Kind::Least(proof) => Verdict::Proved(proof).into(),
            Kind::Sampled(evidence) => Verdict::Numerical(evidence).into(),
            Kind::Unknown { tried } => Verdict::undecided(tried).into(),
            Kind::Stationary {
                direction,
                mut counterexample,
            } => {
                counterexample.quantity = "|δqᵀWδq| − δqᵀWδq".into();
                counterexample.detail = format!(
                    "Z is only stationary: its second derivative along a virtual displacement is negative at a state ({})",
                    counterexample.detail
                );
                let components = cx.system.coordinates.iter().zip(direction);
                Finding {
                    verdict: Verdict::Refuted(counterexample),
                    formulas: components
                        .map(|(c, right)| Formula {
                            caption: format!("δ{} of a displacement with δqᵀ W δq < 0", c.name),
                            left: None,
                            right,
                        })
                        .collect(),
                }
            }
        }
    }
}
