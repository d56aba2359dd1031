//! `witness.hamilton-jacobi`: quadratures of a complete integral against the computed motion.

use super::claims::{elsewhere, numerical, refuted};
use super::evidence;
use super::quadratures::{self, Unmet};
use chetaev_mechanics::claims::{full_id, Claim, Context, Finding, Group, Scope};
use chetaev_mechanics::words;
use chetaev_symbolic::Verdict;

/// β that changes by less over the sizes of its terms is constant.
const CONSTANT: f64 = 1e-6;
/// β that changes by more is not.
const CHANGES: f64 = 1e-3;
/// What it rests on.
const APPLICABLE: &str = "hamilton-jacobi.applicable";

/// `witness.hamilton-jacobi#SUBJECT`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfQuadratures;

impl Claim for WitnessOfQuadratures {
    fn id(&self) -> &'static str {
        "witness.hamilton-jacobi"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "∂S/∂α of a complete integral is constant along the computed motion"
    }

    fn explanation(&self) -> &'static str {
        "The constants α of a complete integral S = action + Σ ∫g dq, separated or stated by the model, are taken from one state of the computed motion. Then β = ∂S/∂α is formed at other rows: ∂action/∂α, and the one-dimensional integrals \
         ∫∂g/∂α dq over each coordinate between its values, by Gauss's quadrature. Positions and times of the motion enter, velocities do not. By Jacobi's theorem every β is constant; the largest change over the sizes of its terms is stated, on the longest stretch on which \
         no momentum found by a quadrature vanishes (there the integrand has a pole). Example: of a rolling disc ∂S/∂a_x = x + ∫ … dφ says that x − R (θ'/φ') sin φ is constant."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        vec![full_id(APPLICABLE, subject)]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let is_small = cx.system.n() <= quadratures::COORDINATES;
        if evidence(cx).is_none() || cx.terms.order != 1 || !is_small {
            return Vec::new();
        }
        let stated = cx.system.complete_integral.is_some().then_some("stated");
        let subjects = [stated, Some("separated")].into_iter().flatten();
        subjects.map(|s| Some(s.to_string())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let subject = subject.unwrap_or("separated");
        let full = full_id(APPLICABLE, Some(subject));
        if !matches!(cx.finding(&full).verdict, Verdict::Proved(_)) {
            let detail = "there is no complete integral for every motion";
            return Verdict::not_applicable(full, detail).into();
        }
        match quadratures::of(cx, subject) {
            Ok(found) => of(&found).into(),
            Err(Unmet::NoIntegral) => {
                Verdict::undecided("the equation separates, but no quadratures were written").into()
            }
            Err(Unmet::NoMotion) => no_motion(cx),
            Err(Unmet::Failed(why)) => Verdict::undecided(why.to_string()).into(),
        }
    }
}

/// Curves of quadratures that are not proved to be motions: where the method does not integrate every motion, none of them.
fn no_motion(cx: &Context<'_>) -> Finding {
    let method = full_id(APPLICABLE, None);
    match cx.finding(&method).verdict {
        Verdict::Proved(_) => {
            Verdict::undecided("the curves of the quadratures were not proved to be motions")
        }
        _ => Verdict::not_applicable(
            method,
            "the curves that the quadratures give are no motions",
        ),
    }
    .into()
}

fn of(found: &quadratures::Quadratures) -> Verdict {
    let constants: Vec<String> = found
        .constants
        .iter()
        .map(|(name, value)| format!("{name} = {}", words::number(*value)))
        .collect();
    let sentence = format!(
        "∂S/∂α with {} changes by {:.1e} of the sizes of its terms from t = {} to {}",
        constants.join(", "),
        found.residual,
        words::number(found.interval.0),
        words::number(found.interval.1)
    );
    match found.residual {
        residual if residual <= CONSTANT => {
            numerical(found.rows, found.interval, residual, sentence)
        }
        residual if residual > CHANGES + 3.0 * found.open => {
            refuted("∂S/∂α", found.interval.1, residual, sentence)
        }
        _ => Verdict::undecided(format!(
            "{sentence}; the output is too coarse for a quadrature, or the motion not accurate enough for its constants, which leave {:.1e} open",
            found.open
        )),
    }
}
