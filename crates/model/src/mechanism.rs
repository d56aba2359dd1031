//! What a model states by bodies, joints and contacts, kept beside what it became.
//!
//! All expressions belong to the graph of the model. Vectors are given along the axes of the ground unless another system of axes is
//! named. The axes of a body turn with it, but for turns about an axis of symmetry of its inertia, in which they need not follow.

use chetaev_symbolic::Expr;

use crate::source::Place;

/// Three components.
pub type Vector = [Expr; 3];

/// The bodies of a model, and what holds them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Bodies, and frames of the user that something touches; each after the one it hangs on.
    pub bodies: Vec<Body>,
    /// What contacts and closing joints do to bodies, one for each constraint that comes from them.
    pub reactions: Vec<Reaction>,
    /// Forces and torques that the user states at points of bodies, and friction of contacts; each acts as it stands and belongs to no
    /// constraint. Their generalized forces, and the energies of springs among them, are those of the model.
    pub loads: Vec<Reaction>,
    /// The part of the potential energy that is no weight: springs, and the V of the user.
    pub potential: Expr,
    /// What the user states of the Lagrangian beside bodies, for which there is no force on a body: `T` or `L`.
    pub beside: Option<&'static str>,
}

/// A rigid body as it is placed.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Where it is stated.
    pub place: Place,
    /// Its mass; zero for a massless body.
    pub mass: Expr,
    /// Its inertia about the centre of mass, row by row, constant in its axes; zero for a point.
    pub inertia: [Vector; 3],
    /// Where its centre of mass is.
    pub center: Vector,
    /// The velocity of the centre of mass along orthonormal axes in which it is short; only its square is of interest.
    pub velocity: Vector,
    /// The rotation from its axes to those of the ground: row i holds the axis i of the ground.
    pub rotation: [Vector; 3],
    /// The angular velocity of its axes, along them.
    pub turning: Vector,
    /// Its angular velocity, along its axes.
    pub omega: Vector,
    /// Its weight, which acts at the centre of mass.
    pub weight: Vector,
    /// What it hangs on, by number; `None` for the ground.
    pub parent: Option<usize>,
    /// The joint or contact by which it hangs.
    pub joint: String,
    /// On which body the force and the torque of that joint act: itself, or the wheel on which it stands.
    pub hinged: usize,
    /// The point of that joint, about which its torque is counted.
    pub point: Vector,
}

/// A force and a torque on a body, opposite on another one, for each unit of the multiplier of a constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// The constraint.
    pub constraint: String,
    /// The contact or joint.
    pub object: String,
    /// The body, by number.
    pub body: usize,
    /// The other one; `None` for the ground.
    pub other: Option<usize>,
    /// The direction of the force.
    pub force: Vector,
    /// Where it acts on the body.
    pub point: Vector,
    /// Where the opposite force acts on the other one: the same place, where the constraints hold.
    pub other_point: Vector,
    /// The torque beside it.
    pub torque: Vector,
}

impl Mechanism {
    /// All expressions, for substitutions.
    pub fn expressions(&mut self) -> Vec<&mut Expr> {
        let mut all = vec![&mut self.potential];
        for body in &mut self.bodies {
            all.push(&mut body.mass);
            all.extend(body.inertia.iter_mut().flatten());
            all.extend(body.rotation.iter_mut().flatten());
            let vectors = [
                &mut body.center,
                &mut body.velocity,
                &mut body.turning,
                &mut body.omega,
                &mut body.weight,
                &mut body.point,
            ];
            all.extend(vectors.into_iter().flatten());
        }
        for own in self.reactions.iter_mut().chain(&mut self.loads) {
            let vectors = [
                &mut own.force,
                &mut own.point,
                &mut own.other_point,
                &mut own.torque,
            ];
            all.extend(vectors.into_iter().flatten());
        }
        all
    }

    /// The reaction that belongs to a constraint.
    pub fn reaction(&self, constraint: &str) -> Option<&Reaction> {
        self.reactions
            .iter()
            .find(|own| own.constraint == constraint)
    }
}
