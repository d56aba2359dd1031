//! Claims about the particles of a model: what formulations that are built from particles require.

use super::{Claim, Context, Finding, Group};
use crate::particles;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::Verdict;

/// `model.particles`.
#[derive(Clone, Copy, Debug)]
pub struct Particles;

/// `model.cartesian-coordinates`.
#[derive(Clone, Copy, Debug)]
pub struct CartesianCoordinates;

impl Claim for Particles {
    fn id(&self) -> &'static str {
        "model.particles"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The particles carry the whole inertia"
    }

    fn explanation(&self) -> &'static str {
        "The Lagrangian minus the kinetic energy Σ ½ m r'·r' of the particles is at most linear in the velocities: all its \
         second derivatives by the velocities vanish identically. Then the acceleration energy of Gibbs and Appell, Kane's \
         inertia forces and the Cartesian forms of Volterra's equations are built from the particles. Where it is refuted, \
         the model states inertia beside the particles, for example that of a rigid body."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        particles::carry_inertia(cx.system, &cx.prover).into()
    }
}

impl Claim for CartesianCoordinates {
    fn id(&self) -> &'static str {
        "model.cartesian-coordinates"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The positions of the particles are the coordinates"
    }

    fn explanation(&self) -> &'static str {
        "Every component of a particle's position is a coordinate itself, and every coordinate is such a component exactly \
         once. The Cartesian forms of Volterra's equations hold then only: holonomic conditions are stated as constraints, \
         not used up by the choice of coordinates. For a model that gives positions as functions of other coordinates there \
         are the forms in generalized coordinates."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match cx.system.particles.is_empty() {
            true => Vec::new(),
            false => vec![None],
        }
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.system.particles.is_empty() {
            return particles::no_particles().into();
        }
        match obstacle(cx) {
            None => {
                let detail = "each coordinate is one component of the position of one particle";
                Verdict::Proved(Proof::structural("everywhere", detail)).into()
            }
            Some(obstacle) => Verdict::Refuted(Counterexample {
                point: Vec::new(),
                quantity: "components that are no coordinate of their own, or coordinates that are no component, at least".into(),
                residual: ("1".into(), "1".into()),
                detail: obstacle,
            })
            .into(),
        }
    }
}

/// The first component that is no coordinate of its own, or the first coordinate that is no component.
fn obstacle(cx: &Context<'_>) -> Option<String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut owners: Vec<Option<&str>> = vec![None; system.n()];
    for particle in &system.particles {
        for &component in &particle.position {
            let Some(place) = system.coordinates.iter().position(|c| c.q == component) else {
                return Some(format!(
                    "{} in the position of `{}` is no coordinate",
                    g.text(component),
                    particle.name
                ));
            };
            if let Some(other) = owners[place].replace(&particle.name) {
                return Some(format!(
                    "the coordinate `{}` occurs in the positions of `{other}` and `{}`",
                    system.coordinates[place].name, particle.name
                ));
            }
        }
    }
    let place = owners.iter().position(Option::is_none)?;
    Some(format!(
        "the coordinate `{}` is in no particle's position",
        system.coordinates[place].name
    ))
}
