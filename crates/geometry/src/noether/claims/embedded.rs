//! `noether.embedded`: the motion on the constraint manifold is the kernel of the embedded 2-form.

use super::{on_manifold, requirements};
use crate::noether::embedded::Embedded;
use crate::noether::motion::Motion;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_symbolic::{Expr, Verdict};

/// `noether.embedded`.
#[derive(Clone, Copy, Debug)]
pub struct EmbeddedField;

impl Claim for EmbeddedField {
    fn id(&self) -> &'static str {
        "noether.embedded"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "The motion on the constraint manifold is the kernel of the embedded 2-form"
    }

    fn explanation(&self) -> &'static str {
        "On the constraint manifold the fields that annihilate the constraints have dimension 2k + 1. The 2-form Ω̄ on them has rank \
         2k, so its kernel is a line, and the field X̄ of the motion, with dt(X̄) = 1, spans it: X̄ ⌟ Ω̄ = 0. The components of X̄ are taken from \
         Routh's equations with multipliers, so the claim tests both. It follows (Zhao's Lemma 2) that Ȳ ⌟ Ω̄ = β has a \
         solution exactly when β(X̄) = 0, unique up to multiples of X̄: every first integral has a field. The rank is 2k exactly \
         where the restricted mass matrix W̄ is regular, whether the constraints are linear or not."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let parts = Embedded::of(cx).and_then(|n| Ok((n, Motion::of(cx)?)));
        let (n, motion) = match parts {
            Ok(parts) => parts,
            Err(why) => return Verdict::undecided(why).into(),
        };
        let g = &cx.system.graph;
        let k = n.k();
        if k == 0 {
            return Verdict::not_applicable(
                "model.constraints-independent",
                "the constraints leave no velocity free",
            )
            .into();
        }
        let definitions: Vec<Expr> = n
            .embedding
            .chart
            .parameters
            .iter()
            .map(|p| p.definition)
            .collect();
        let rates: Vec<Expr> = motion
            .derivatives(&definitions)
            .into_iter()
            .map(|rate| n.restricted(rate))
            .collect();
        let (time, along, speeds) = n.contraction(g.one(), &vec![g.zero(); k], &rates);
        let mut residuals = vec![time];
        residuals.extend(along);
        residuals.extend(speeds);
        let kernel = on_manifold(cx, &n, &residuals);
        let rank = cx.prover.nonsingular(
            cx.system,
            &n.mass,
            n.manifold(),
            "the determinant of the restricted mass matrix W̄",
        );
        let sentence = format!(
            "X̄ ⌟ Ω̄ = 0 in every component, and the rank of Ω̄ is {} of {}",
            2 * k,
            2 * k + 1
        );
        kernel.and(rank).prefixed(&sentence).into()
    }
}
