//! `second-kind.differential-newton`: Newton's statement of Zhu's differential principle, for particles.

use super::{decided, identities, requirements};
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Group};
use chetaev_symbolic::Verdict;

/// `second-kind.differential-newton`.
#[derive(Clone, Copy, Debug)]
pub struct DifferentialNewton;

impl Claim for DifferentialNewton {
    fn id(&self) -> &'static str {
        "second-kind.differential-newton"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Newton's statement with r and u varied independently is Lagrange's"
    }

    fn explanation(&self) -> &'static str {
        "For particles: Σ (F − m Du)·δr + Σ m (Dr − u)·δu = 0 for arbitrary δu and virtual δr, with positions r and velocities u \
         varied independently, is equivalent to Newton's law with ideal reactions together with Dr = u. In generalized coordinates, u = ∂r/∂t + Σ ∂r/∂q v, the \
         generalized relations of Lagrange ∂u/∂v = ∂r/∂q and D(∂r/∂q) = ∂u/∂q + Σ (Dq − v) ∂²r/∂q∂q turn it into Lagrange's \
         statement; second derivatives of r cancel. Both are proved for arbitrary curves and variations. \
         Example: a mass of 2 on a line, pulled by 6: (6 − 2 Du) δr + 2 (Dr − u) δu = 0 gives Du = 3 and Dr = u."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        let mut hypotheses = requirements();
        hypotheses.extend([
            "model.particles".into(),
            "model.masses-of-time".into(),
            "model.hessian-regular".into(),
        ]);
        hypotheses
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        match identities(cx, &["Newton", "D(∂r"]) {
            Ok(list) => {
                let mut verdict = decided(cx, &list).unwrap_or_else(|| {
                    Verdict::not_applicable(
                        "model.particles",
                        "Newton's statement is made for particles that carry the whole inertia",
                    )
                });
                if matches!(verdict, Verdict::Proved(_)) {
                    verdict.prefix("Newton's statement is Lagrange's, by the generalized relations of Lagrange");
                }
                verdict.into()
            }
            Err(problem) => Verdict::from(&problem).into(),
        }
    }
}
