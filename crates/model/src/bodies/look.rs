//! A drawing from the shapes of the bodies, unless the user states one.

use super::algebra::Vector;
use super::lowering::{Lowering, Step, GROUND};
use super::placing::Built;
use super::sections::{array, table, text};
use super::shapes::Look;
use super::tree::Tree;
use crate::raw::Raw;
use crate::source::Place;

/// Colors of bodies, one after the other.
const COLORS: [&str; 5] = ["blue", "red", "green", "amber", "violet"];

impl<'r> Lowering<'r> {
    /// Writes the elements of the drawing.
    pub(crate) fn draw_all(&mut self, tree: &Tree<'r>, built: &[Built]) {
        if self.root.get("drawing").is_some() {
            return;
        }
        for own in built {
            let place = tree.contacts[own.contact].object.place;
            let at = self.position(GROUND, own.heading);
            let at = self.drawn(at, place);
            self.element("trail", "muted", "", vec![("at", at)], place);
        }
        for number in 0..self.bodies.len() {
            let color = COLORS[number % COLORS.len()];
            self.draw_body(number, color);
        }
        self.draw_links(tree);
    }

    /// The vertical of a drawing is its third axis.
    fn drawn(&mut self, v: Vector, place: Place) -> Raw {
        let up = self.up.axis;
        let mut turned: Vector = std::array::from_fn(|i| v[(i + up + 1) % 3]);
        if self.up.is_backward {
            // Half a turn about the first axis.
            turned = [
                turned[0],
                self.algebra.graph.neg(turned[1]),
                self.algebra.graph.neg(turned[2]),
            ];
        }
        let items = turned.map(|e| text(self.algebra.graph.text(e), place));
        array(items.to_vec(), place)
    }

    fn element(
        &mut self,
        kind: &str,
        color: &str,
        name: &str,
        values: Vec<(&str, Raw)>,
        place: Place,
    ) {
        let mut entries = vec![("kind", text(kind, place)), ("color", text(color, place))];
        if !name.is_empty() {
            entries.push(("name", text(name.replace('_', " "), place)));
        }
        entries.extend(values);
        self.written.elements.push(table(entries, place));
    }

    fn draw_body(&mut self, number: usize, color: &str) {
        let body = &self.bodies[number];
        let (name, place) = (body.name.clone(), body.place);
        let Some(&frame) = self.placed.get(&name) else {
            return;
        };
        let middle = self.outline_center(&self.bodies[number]);
        let Some((look, axis, lengths)) = self.bodies[number]
            .shape
            .as_ref()
            .map(|(shape, sizes)| (shape.look, sizes.axis, sizes.lengths.clone()))
        else {
            if self.bodies[number].mass.is_some() {
                let center = self.bodies[number].center;
                let at = self.point(GROUND, frame, center);
                let at = self.drawn(at, place);
                self.element("point", color, &name, vec![("at", at)], place);
            }
            return;
        };
        let size = |lowering: &Self, i: usize| text(lowering.algebra.graph.text(lengths[i]), place);
        match look {
            Look::Wheel => {
                let angle = match self.frames[self.unshifted(frame)].step {
                    Step::Turn(turn) if turn.axis == axis => turn.angle,
                    _ => self.algebra.graph.zero(),
                };
                let angle = text(self.algebra.graph.text(angle), place);
                let center = self.point(GROUND, frame, middle);
                let axle = self.axes(GROUND, frame).map(|row| row[axis]);
                let values = vec![
                    ("center", self.drawn(center, place)),
                    ("axis", self.drawn(axle, place)),
                    ("radius", size(self, 0)),
                    ("angle", angle),
                ];
                self.element("wheel", color, &name, values, place);
            }
            Look::Ball => {
                let center = self.point(GROUND, frame, middle);
                let pole = self.axes(GROUND, frame).map(|row| row[axis]);
                let center = self.drawn(center, place);
                let values = vec![("center", center.clone()), ("radius", size(self, 0))];
                self.element("sphere", color, &name, values, place);
                let values = vec![
                    ("center", center),
                    ("axis", self.drawn(pole, place)),
                    ("radius", size(self, 0)),
                ];
                self.element("circle", color, "", values, place);
            }
            Look::Rings => {
                let lengths = [lengths[0], lengths[1], lengths[2]];
                self.draw_rings(frame, middle, lengths, (&name, color, place));
            }
            Look::Bar => {
                let half = self.algebra.ratio(1, 2);
                let length = lengths[lengths.len() - 1];
                let reach = self.algebra.times(
                    self.algebra.graph.mul(&[half, length]),
                    self.algebra.unit(axis),
                );
                let ends = [
                    self.algebra.minus(middle, reach),
                    self.algebra.plus(middle, reach),
                ];
                let [from, to] = ends.map(|end| self.point(GROUND, frame, end));
                let values = vec![
                    ("from", self.drawn(from, place)),
                    ("to", self.drawn(to, place)),
                ];
                self.element("segment", color, &name, values, place);
            }
            Look::Edges => self.draw_box(
                frame,
                middle,
                [lengths[0], lengths[1], lengths[2]],
                (&name, color, place),
            ),
        }
    }

    /// The frame before shifts.
    fn unshifted(&self, mut frame: usize) -> usize {
        while let Step::Shift(_) = self.frames[frame].step {
            frame = self.frames[frame].parent;
        }
        frame
    }

    /// The ellipses in the planes of the axes, each of 24 chords.
    fn draw_rings(
        &mut self,
        frame: usize,
        middle: Vector,
        size: Vector,
        (name, color, place): (&str, &str, Place),
    ) {
        const CHORDS: i64 = 24;
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let mut points = Vec::new();
            for k in 0..=CHORDS {
                let graph = &self.algebra.graph;
                let angle = graph.mul(&[self.algebra.ratio(2 * k, CHORDS), graph.pi()]);
                let mut at = middle;
                for (axis, part) in [(i, graph.cos(angle)), (j, graph.sin(angle))] {
                    at[axis] = graph.add(&[at[axis], graph.mul(&[size[axis], part])]);
                }
                let at = self.point(GROUND, frame, at);
                points.push(self.drawn(at, place));
            }
            let values = vec![("points", array(points, place))];
            self.element(
                "polyline",
                color,
                if i == 0 { name } else { "" },
                values,
                place,
            );
        }
    }

    /// Two opposite faces, and the edges between them.
    fn draw_box(
        &mut self,
        frame: usize,
        middle: Vector,
        size: Vector,
        (name, color, place): (&str, &str, Place),
    ) {
        let half = self.algebra.ratio(1, 2);
        let mut corner = |signs: [bool; 3]| {
            let reach: Vector = std::array::from_fn(|i| {
                let own = self.algebra.graph.mul(&[half, size[i]]);
                if signs[i] {
                    own
                } else {
                    self.algebra.graph.neg(own)
                }
            });
            let at = self.algebra.plus(middle, reach);
            let at = self.point(GROUND, frame, at);
            self.drawn(at, place)
        };
        const ROUND: [[bool; 2]; 5] = [
            [false, false],
            [true, false],
            [true, true],
            [false, true],
            [false, false],
        ];
        let faces = [false, true].map(|z| ROUND.map(|[x, y]| corner([x, y, z])).to_vec());
        let points: Vec<Raw> = faces.concat();
        self.element(
            "polyline",
            color,
            name,
            vec![("points", array(points, place))],
            place,
        );
        let [lower, upper] = &faces;
        for (from, to) in lower.iter().zip(upper).take(4).skip(1) {
            let values = vec![("from", from.clone()), ("to", to.clone())];
            self.element("segment", color, "", values, place);
        }
    }

    /// Lines from each body without a shape to the bodies that hang on it.
    fn draw_links(&mut self, tree: &Tree<'r>) {
        for joint in &tree.joints {
            let has_shape = |name: &str| {
                self.bodies
                    .iter()
                    .any(|body| body.name == name && body.shape.is_some())
            };
            if joint.parent == "ground" || has_shape(&joint.parent) {
                continue;
            }
            let (Some(&parent), Some(&child)) = (
                self.placed.get(&joint.parent),
                self.placed.get(&joint.child),
            ) else {
                continue;
            };
            let place = joint.object.place;
            let from = self.position(GROUND, parent);
            let to = self.position(GROUND, child);
            if from == to {
                continue;
            }
            let values = vec![
                ("from", self.drawn(from, place)),
                ("to", self.drawn(to, place)),
            ];
            self.element("segment", "ink", "", values, place);
        }
    }
}
