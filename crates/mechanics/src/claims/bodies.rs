//! `model.bodies`: what formulations that are built from rigid bodies require.

use super::{Claim, Context, Finding, Group};
use crate::bodies;

/// The claim.
#[derive(Clone, Copy, Debug)]
pub struct Bodies;

impl Claim for Bodies {
    fn id(&self) -> &'static str {
        "model.bodies"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The bodies carry the whole inertia"
    }

    fn explanation(&self) -> &'static str {
        "The kinetic energy is the sum of ½ m v² + ½ ω·Jω of the bodies, and of ½ m v² of particles beside them. Then the balances \
         of Newton and Euler, Kane's inertia forces and the acceleration energy of Gibbs and Appell are built from the bodies. It \
         is not applicable where T or L is stated beside bodies: no force on a body corresponds to what these contain."
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        bodies::carry_inertia(cx.system, &cx.prover).into()
    }
}
