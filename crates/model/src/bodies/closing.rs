//! Closed chains: a joint between bodies that are placed already says which motions of the one against the other it forbids.

use super::algebra::Vector;
use super::joints::Freedom;
use super::lowering::{FrameId, Lowering, Step, GROUND};
use super::objects::KeptReaction;
use super::tree::{JointStated, Tree};
use crate::diagnostic::Diagnostic;

impl<'r> Lowering<'r> {
    /// Writes the constraints of all joints that close a chain.
    pub(crate) fn close_all(&mut self, tree: &Tree<'r>) {
        for number in &tree.closing {
            self.close(&tree.joints[*number]);
        }
    }

    fn close(&mut self, joint: &JointStated<'r>) {
        let object = &joint.object;
        for key in [
            "coordinate",
            "coordinates",
            "motion",
            "spring",
            "damper",
            "friction",
            "limits",
            "torque",
            "force",
        ] {
            if let Some(raw) = object.get(key) {
                let message = format!(
                    "{} closes a chain and has no coordinates of its own: `{key}` has no meaning",
                    object.words()
                );
                self.problems.push(
                    Diagnostic::error("not-allowed-here", raw.place, message)
                        .hint("state it for a joint that places a body"),
                );
            }
        }
        let (Some(&parent), Some(&child)) = (
            self.placed.get(&joint.parent),
            self.placed.get(&joint.child),
        ) else {
            return;
        };
        let (name, place) = (object.name().to_owned(), object.place);
        let tilt = self.turns(object, "tilt", false);
        let keys = if joint.is_reversed {
            ["child_at", "at"]
        } else {
            ["at", "child_at"]
        };
        let ends = [(parent, keys[0]), (child, keys[1])].map(|(frame, key)| {
            let at = self
                .vector(object, key, "m", false)
                .unwrap_or(self.algebra.zero());
            let shifted = self.step(frame, Step::Shift(at), &name, place);
            self.turned(shifted, &tilt, &name, place)
        });
        self.close_ends(joint, ends);
    }

    fn close_ends(&mut self, joint: &JointStated<'r>, ends: [FrameId; 2]) {
        let (name, place) = (joint.object.name().to_owned(), joint.object.place);
        let [rows, other] = ends.map(|end| self.axes(GROUND, end));
        let [from, to] = ends.map(|end| self.position(GROUND, end));
        let column = |rows: &[Vector; 3], k: usize| rows.map(|row| row[k]);
        let gap = self.algebra.minus(to, from);
        let slides: Vec<usize> = self.axes_of(joint, Freedom::Slide);
        let turns: Vec<usize> = self.axes_of(joint, Freedom::Turn);
        let words = joint.object.words();
        for axis in (0..3).filter(|axis| !slides.contains(axis)) {
            let apart = if slides.is_empty() {
                gap[axis]
            } else {
                self.algebra.dot(gap, column(&rows, axis))
            };
            let along = if slides.is_empty() {
                self.algebra.unit(axis)
            } else {
                column(&rows, axis)
            };
            let own = format!("{name}_{}", ["x", "y", "z"][axis]);
            let ends = if slides.is_empty() {
                [to, from]
            } else {
                [to, to]
            };
            self.react_at(joint, &own, ends, [along, self.algebra.zero()]);
            self.constrain_loop(&own, apart, &words, place);
        }
        let right = |lowering: &Self, i: usize, j: usize| {
            lowering.algebra.dot(column(&rows, i), column(&other, j))
        };
        let pairs: Vec<(usize, usize)> = match turns.as_slice() {
            [] => vec![(0, 1), (1, 2), (2, 0)],
            [k] => vec![((k + 1) % 3, *k), ((k + 2) % 3, *k)],
            [i, j] => vec![(*i, *j)],
            _ => Vec::new(),
        };
        for (i, j) in pairs {
            let cosine = right(self, i, j);
            let end = format!("{}{}", ["x", "y", "z"][i], ["x", "y", "z"][j]);
            // The rate of the cosine of two axes is the difference of the angular velocities along their vector product.
            let about = self.algebra.cross(column(&other, j), column(&rows, i));
            let own = format!("{name}_{end}");
            self.react_at(joint, &own, [to, to], [self.algebra.zero(), about]);
            self.constrain_loop(&own, cosine, &words, place);
        }
    }

    /// The force and the torque of a closing constraint, at the ends of the child and the parent.
    fn react_at(
        &mut self,
        joint: &JointStated<'_>,
        constraint: &str,
        ends: [Vector; 2],
        wrench: [Vector; 2],
    ) {
        let ([force, torque], [point, other_point]) = (wrench, ends);
        self.keep_reaction(KeptReaction {
            constraint: constraint.to_owned(),
            object: joint.object.name().to_owned(),
            place: joint.object.place,
            body: joint.child.clone(),
            other: joint.parent.clone(),
            force,
            point,
            other_point,
            torque,
        });
    }

    fn axes_of(&self, joint: &JointStated<'_>, freedom: Freedom) -> Vec<usize> {
        let own = joint
            .motions
            .iter()
            .filter(|motion| motion.freedom == freedom);
        own.map(|motion| motion.axis).collect()
    }

    fn constrain_loop(
        &mut self,
        name: &str,
        vanishes: chetaev_symbolic::Expr,
        words: &str,
        place: crate::Place,
    ) {
        let graph = &self.algebra.graph;
        if graph.is_zero(vanishes) {
            return;
        }
        if !self.algebra.is_constant(vanishes) {
            let about = format!("{words} closes the chain");
            return self.constrain(name, vanishes, about, place);
        }
        if graph.as_number(vanishes).is_some() {
            let message = format!(
                "{words} cannot close the chain: its two ends are {} apart, whatever the bodies do",
                graph.text(vanishes)
            );
            return self.error("cannot-close", place, message);
        }
        let zero = graph.zero();
        self.assume(vanishes, "=", zero, place);
        self.closing.push((place, words.to_owned()));
    }
}
