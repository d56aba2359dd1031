//! Ropes between two points: taut and inextensible, until they would have to push.

use super::lowering::{Lowering, GROUND};
use super::objects::KeptReaction;
use super::reading::Object;
use super::sections::{table, text, word};

const KEYS: &[&str] = &["type", "body", "at", "to", "to_at", "length", "description"];

impl<'r> Lowering<'r> {
    /// Writes the constraint that a rope has its length, and the event that it slackens: its multiplier is the tension with the other sign.
    pub(crate) fn tie(&mut self, object: &Object<'r>) {
        self.known_keys(object, KEYS);
        for key in ["body", "to", "length"] {
            if object.get(key).is_none() {
                let message = format!("{} needs its `{key}`", object.words());
                return self.error("missing-value", object.place, message);
            }
        }
        let ends = [["body", "at"], ["to", "to_at"]].map(|keys| self.end(object, keys));
        let ([Some(from), Some(to)], Some(raw)) = (ends, object.get("length")) else {
            return;
        };
        let Some(length) = self.number(&object.slot("length", "m"), raw) else {
            return;
        };
        self.assume_positive(length, raw.place);
        let (name, place) = (object.name(), object.place);
        let [start, end] = [from, to].map(|own| self.point(GROUND, own.frame, own.at));
        let line = self.algebra.minus(end, start);
        let line = self.name_vector(&format!("{name}_line"), line, place);
        let span = self.algebra.graph.sqrt(self.algebra.dot(line, line));
        let span = self.name(&format!("{name}_span"), span, place);
        let longer = self.algebra.graph.sub(span, length);
        let about = format!("{} is taut", object.words());
        self.constrain(name, longer, about, place);
        // One of the ends must be a body's; the other one may be anything.
        let is_body = self.bodies.iter().any(|body| body.name == from.name);
        let ((own, point), (other, other_point)) = if is_body {
            ((from, start), (to, end))
        } else {
            ((to, end), (from, start))
        };
        if !self.bodies.iter().any(|body| body.name == own.name) {
            let message = format!("{} is tied to no body", object.words());
            return self.error("unknown-body", place, message);
        }
        let away = self.algebra.minus(point, other_point);
        let force = away.map(|e| self.algebra.graph.div(e, span));
        self.keep_reaction(KeptReaction {
            constraint: name.to_owned(),
            object: name.to_owned(),
            place,
            body: own.name.to_owned(),
            other: other.name.to_owned(),
            force,
            point,
            other_point,
            torque: self.algebra.zero(),
        });
        let slack = vec![
            ("when", text(format!("lambda_{name}"), place)),
            ("direction", text("rising", place)),
            ("action", text("stop", place)),
            (
                "description",
                text(format!("{} slackens", object.words()), place),
            ),
        ];
        let event = word(format!("{name}_slack"), place);
        let slack = table(slack, place);
        self.written.events.entries.push((event, slack));
    }
}
