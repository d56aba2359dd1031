//! `second-kind.identity`: the pointwise identity behind the integral principles.

use super::{decided, identities, requirements, StateCurve};
use crate::words::formula;
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Group};
use chetaev_symbolic::Verdict;

/// `second-kind.identity`.
#[derive(Clone, Copy, Debug)]
pub struct PointwiseIdentity;

impl Claim for PointwiseIdentity {
    fn id(&self) -> &'static str {
        "second-kind.identity"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The principle of the second kind is δZ + Σ Q δq less a total derivative"
    }

    fn explanation(&self) -> &'static str {
        "With Z = L + Σ (Dq − v) ∂L/∂v: Σ (∂L/∂q + Q − D(∂L/∂v)) δq + Σ (Dq − v) δ(∂L/∂v) = δZ + Σ Q δq − D(Σ ∂L/∂v δq) for arbitrary \
         curves (q(t), v(t)) and arbitrary variations, δ(Dq) = D(δq). For particles the generalized relations of \
         Lagrange are proved too. Without constraints and forces ∫Z dt is stationary: the principle of Livens, and in momenta the \
         modified principle of Hamilton. With constraints it is not, as δq is restricted by Chetaev's condition and δ is a partial variation. \
         Example: L = v²/2 has Z = v Dq − v²/2, and δZ − D(v δq) = (Dq − v) δv − Dv δq."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        let mut hypotheses = requirements();
        hypotheses.push("model.hessian-regular".into());
        hypotheses
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let list = match identities(cx, &["Σ (L_q", "D(∂r"]) {
            Ok(list) => list,
            Err(problem) => return Verdict::from(&problem).into(),
        };
        let mut verdict =
            decided(cx, &list).unwrap_or_else(|| Verdict::undecided("no identity was stated"));
        if matches!(verdict, Verdict::Proved(_)) {
            let livens = match cx.selection.rows.is_empty()
                && cx.system.forces.iter().all(|&q| cx.system.graph.is_zero(q))
            {
                true => "; without constraints and forces this is the principle of Livens, ∫Z dt stationary",
                false => "",
            };
            verdict.prefix(&format!(
                "Σ (L_q + Q − D L_v) δq + Σ (Dq − v) δL_v = δZ + Σ Q δq − D(Σ L_v δq){livens}"
            ));
        }
        let density = StateCurve::new(cx).density(cx);
        Finding {
            verdict,
            formulas: formula(cx, "the integrand Z of the second kind", None, density)
                .into_iter()
                .collect(),
        }
    }
}
