//! What is kept of a body and of a force between two, in the names of the lowered model.

use crate::raw::{Raw, Table};
use crate::source::Place;

/// A body with its vectors, in the graph of the lowering or as texts.
#[derive(Clone, Debug)]
pub(crate) struct KeptBody<E> {
    pub(crate) name: String,
    pub(crate) place: Place,
    pub(crate) mass: E,
    pub(crate) inertia: [[E; 3]; 3],
    pub(crate) rotation: [[E; 3]; 3],
    pub(crate) center: [E; 3],
    pub(crate) velocity: [E; 3],
    pub(crate) turning: [E; 3],
    pub(crate) omega: [E; 3],
    pub(crate) weight: [E; 3],
    pub(crate) point: [E; 3],
    pub(crate) parent: Option<usize>,
    pub(crate) joint: String,
    /// The body on which the joint acts, by name.
    pub(crate) hinged: String,
}

/// A force and a torque between two bodies, which are given by their names until all are known.
#[derive(Clone, Debug)]
pub(crate) struct KeptReaction<E> {
    pub(crate) constraint: String,
    pub(crate) object: String,
    pub(crate) place: Place,
    pub(crate) body: String,
    pub(crate) other: String,
    pub(crate) force: [E; 3],
    pub(crate) point: [E; 3],
    pub(crate) other_point: [E; 3],
    pub(crate) torque: [E; 3],
}

/// All objects, their expressions as texts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kept {
    /// Definitions that nothing but the objects names.
    pub(crate) define: Table,
    pub(crate) bodies: Vec<KeptBody<String>>,
    pub(crate) reactions: Vec<KeptReaction<String>>,
    /// Forces and torques at points of bodies; they belong to no constraint.
    pub(crate) loads: Vec<KeptReaction<String>>,
    /// Terms of the potential energy of springs.
    pub(crate) springs: Vec<String>,
    /// The V of the user.
    pub(crate) stated: Option<Raw>,
    pub(crate) beside: Option<&'static str>,
}

impl<E: Copy> KeptBody<E> {
    pub(crate) fn texts(self, text: &impl Fn(E) -> String) -> KeptBody<String> {
        let all = |v: [E; 3]| v.map(text);
        KeptBody {
            mass: text(self.mass),
            inertia: self.inertia.map(all),
            rotation: self.rotation.map(all),
            center: all(self.center),
            velocity: all(self.velocity),
            turning: all(self.turning),
            omega: all(self.omega),
            weight: all(self.weight),
            point: all(self.point),
            name: self.name,
            place: self.place,
            parent: self.parent,
            joint: self.joint,
            hinged: self.hinged,
        }
    }
}

impl<E: Copy> KeptReaction<E> {
    pub(crate) fn texts(&self, text: &impl Fn(E) -> String) -> KeptReaction<String> {
        KeptReaction {
            constraint: self.constraint.clone(),
            object: self.object.clone(),
            place: self.place,
            body: self.body.clone(),
            other: self.other.clone(),
            force: self.force.map(text),
            point: self.point.map(text),
            other_point: self.other_point.map(text),
            torque: self.torque.map(text),
        }
    }
}
