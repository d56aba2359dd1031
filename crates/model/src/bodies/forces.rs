//! Forces and torques at points of bodies, springs and dampers between two points, and friction.
//!
//! A force F at a point that moves with the velocity v, and a torque M on a body that turns with ω, have the power F·v + M·ω; their
//! generalized forces are F·∂v/∂q' + M·∂ω/∂q' (E. T. Whittaker, Analytical Dynamics, 1937, § 26). Friction under the load N is
//! −μ N v/√(v² + s²), which differs from Coulomb's law where v is not large against s.

use chetaev_symbolic::Expr;

use super::algebra::Vector;
use super::figures::Found;
use super::lowering::{FrameId, Lowering, GROUND};
use super::objects::KeptReaction;
use super::reading::Object;
use super::sections::{table, text};
use super::springs::Spring;
use super::tree::ContactStated;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::source::Place;

const KEYS: &[&str] = &[
    "body",
    "at",
    "to",
    "to_at",
    "in",
    "force",
    "torque",
    "spring",
    "damper",
    "description",
];
const FRICTION_KEYS: &[&str] = &["coefficient", "load", "speed", "viscous"];

/// A point of a body or frame.
#[derive(Clone, Copy)]
pub(crate) struct End<'r> {
    pub(crate) name: &'r str,
    pub(crate) frame: FrameId,
    pub(crate) at: Vector,
}

/// A law of friction: −(c + μ N/√(v² + s²)) v.
struct Friction {
    viscous: Option<Expr>,
    /// μ N, and s.
    dry: Option<[Expr; 2]>,
}

/// Whether an entry of `[forces]` acts on a body.
pub(crate) fn acts_on_body(raw: &Raw) -> bool {
    raw.table().is_some_and(|own| own.get("body").is_some())
}

impl<'r> Lowering<'r> {
    /// Writes the forces at points of bodies.
    pub(crate) fn load_all(&mut self) {
        for object in self.objects_where("forces", "force", acts_on_body) {
            self.known_keys(&object, KEYS);
            let Some(end) = self.end(&object, ["body", "at"]) else {
                continue;
            };
            if !self.bodies.iter().any(|body| body.name == end.name) {
                let message = format!(
                    "{} acts on `{}`, which is no body",
                    object.words(),
                    end.name
                );
                self.error("unknown-body", object.place, message);
            } else if object.get("to").is_some() {
                self.pull(&object, end);
            } else {
                self.press(&object, end);
            }
        }
    }

    /// The point that two keys of an object state.
    pub(crate) fn end(&mut self, object: &Object<'r>, keys: [&'static str; 2]) -> Option<End<'r>> {
        let name = self.word(object, keys[0])?;
        let Some(&frame) = self.placed.get(&name.content) else {
            let message = format!(
                "{} names `{}`, and there is no such body or frame",
                object.words(),
                name.content
            );
            self.error("unknown-body", name.place, message);
            return None;
        };
        let at = self.vector(object, keys[1], "m", false)?;
        Some(End {
            name: &name.content,
            frame,
            at,
        })
    }

    /// The frame under a key; the ground where none is stated.
    pub(crate) fn frame_under(&mut self, object: &Object<'r>, key: &str) -> Option<FrameId> {
        let Some(name) = self.word(object, key) else {
            return Some(GROUND);
        };
        let found = self.placed.get(&name.content).copied();
        if found.is_none() {
            let message = format!("there is no body or frame `{}`", name.content);
            self.error("unknown-body", name.place, message);
        }
        found
    }

    // ---- vectors from frame to frame

    /// The components along the axes of `to` of a vector along those of `from`.
    pub(crate) fn components(&mut self, v: Vector, from: FrameId, to: FrameId) -> Vector {
        if from == to {
            return v;
        }
        let v = self.in_base(GROUND, from, v);
        if to == GROUND {
            return v;
        }
        let rows = self.axes(GROUND, to);
        [0, 1, 2].map(|axis| self.algebra.dot(rows.map(|row| row[axis]), v))
    }

    /// The velocity of a point against the ground, along the axes of a frame.
    pub(crate) fn velocity_of(&mut self, end: End<'_>, axes: FrameId) -> Vector {
        let own = if axes == end.frame {
            end.frame
        } else {
            self.unturned(end.frame, end.at)
        };
        let rates = self.rates(GROUND, own);
        let carried = self.algebra.cross(rates.omega, end.at);
        let velocity = self.algebra.plus(rates.velocity, carried);
        self.components(velocity, own, axes)
    }

    // ---- what is written

    /// A force along a displacement with this rate.
    fn work(&mut self, force: Expr, along: Expr, place: Place) {
        let graph = &self.algebra.graph;
        if graph.is_zero(force) || graph.is_zero(along) {
            return;
        }
        let entries = [("force", force), ("along", along)];
        let entries = entries.map(|(key, e)| (key, text(graph.text(e), place)));
        self.written.power.push(table(entries.to_vec(), place));
    }

    /// A force and a torque in a frame at a point of a body.
    fn press(&mut self, object: &Object<'r>, end: End<'r>) {
        let Some(axes) = self.frame_under(object, "in") else {
            return;
        };
        let force = self.vector(object, "force", "N", true);
        let torque = self.vector(object, "torque", "N m", true);
        let (Some(force), Some(torque)) = (force, torque) else {
            return;
        };
        let velocity = self.velocity_of(end, axes);
        let omega = self.rates(GROUND, end.frame).omega;
        let omega = self.components(omega, end.frame, axes);
        for i in 0..3 {
            self.work(force[i], velocity[i], object.place);
            self.work(torque[i], omega[i], object.place);
        }
        let [force, torque] = [force, torque].map(|v| self.in_base(GROUND, axes, v));
        let point = self.point(GROUND, end.frame, end.at);
        let other = "ground".to_owned();
        self.keep_load(
            object,
            [end.name.to_owned(), other],
            [point; 2],
            [force, torque],
        );
    }

    /// Spring, damper and force along the line between two points.
    fn pull(&mut self, object: &Object<'r>, from: End<'r>) {
        let Some(to) = self.end(object, ["to", "to_at"]) else {
            return;
        };
        let (name, place) = (object.name().to_owned(), object.place);
        let points = [from, to].map(|end| self.point(GROUND, end.frame, end.at));
        let apart = self.algebra.minus(points[1], points[0]);
        let apart = self.name_vector(&format!("{name}_line"), apart, place);
        let square = self.algebra.dot(apart, apart);
        let length = self.algebra.graph.sqrt(square);
        let length = self.name(&format!("{name}_length"), length, place);
        // A pull towards each other over the length.
        let mut pulls = Vec::new();
        if let Some(Spring { stiffness, rest }) = self.spring(object, ["N/m", "m"]) {
            let graph = &self.algebra.graph;
            let (squared, over) = match rest {
                None => (square, graph.one()),
                Some(rest) => {
                    let longer = graph.sub(length, rest);
                    (graph.powi(longer, 2), graph.div(longer, length))
                }
            };
            let energy = graph.mul(&[self.algebra.ratio(1, 2), stiffness, squared]);
            pulls.push(graph.mul(&[stiffness, over]));
            self.store(energy);
        }
        let rate = self.algebra.rate(length);
        let damper = object.get("damper");
        if let Some(c) = damper.and_then(|raw| self.number(&object.slot("damper", "N s/m"), raw)) {
            let graph = &self.algebra.graph;
            let pull = graph.mul(&[c, rate]);
            pulls.push(graph.div(pull, length));
            self.work(graph_neg(self, pull), rate, place);
        }
        let force = object.get("force");
        if let Some(push) = force.and_then(|raw| self.function(&object.slot("force", "N"), raw)) {
            let over = self.algebra.graph.div(push, length);
            pulls.push(graph_neg(self, over));
            self.work(push, rate, place);
        }
        if let Some(raw) = object.get("torque") {
            let message = "between two points there is no torque; it acts on a body alone";
            self.error("not-allowed-here", raw.place, message);
        }
        let pull = self.algebra.graph.add(&pulls);
        let force = self.algebra.times(pull, apart);
        let names = [from.name.to_owned(), to.name.to_owned()];
        let wrench = [force, self.algebra.zero()];
        self.keep_load(object, names, points, wrench);
    }

    /// An elastic energy.
    pub(crate) fn store(&mut self, energy: Expr) {
        let energy = self.algebra.graph.text(energy);
        self.springs.push(energy.clone());
        self.written.potential.push(energy);
    }

    fn keep_load(
        &mut self,
        object: &Object<'_>,
        [body, other]: [String; 2],
        [point, other_point]: [Vector; 2],
        [force, torque]: [Vector; 2],
    ) {
        self.loads.push(KeptReaction {
            constraint: String::new(),
            object: object.name().to_owned(),
            place: object.place,
            body,
            other,
            force,
            point,
            other_point,
            torque,
        });
    }

    // ---- laws

    /// `spring`: a stiffness, or a table with `stiffness` and `rest`; with their units.
    pub(crate) fn spring(
        &mut self,
        object: &Object<'r>,
        units: [&'static str; 2],
    ) -> Option<Spring> {
        let raw = object.get("spring")?;
        let (stated, rest) = match raw.table() {
            Some(own) if own.get("stiffness").is_some() => (own.get("stiffness"), own.get("rest")),
            _ => (Some(raw), None),
        };
        let stiffness = self.number(&object.slot("spring", units[0]), stated?)?;
        let rest = rest.and_then(|raw| self.number(&object.slot("rest", units[1]), raw));
        let rest = rest.filter(|rest| !self.algebra.graph.is_zero(*rest));
        Some(Spring { stiffness, rest })
    }

    /// `friction`: `viscous`, and `coefficient` with `load` and `speed`; with the units of a force, a velocity and the viscous coefficient.
    fn friction(&mut self, object: &Object<'r>, units: [&'static str; 3]) -> Option<Friction> {
        let raw = object.get("friction")?;
        let Some(own) = raw.table() else {
            let wanted = "a table, as in { coefficient = 0.3, load = \"m g\", speed = 0.01 }";
            self.wrong_kind(raw, &format!("the friction of {}", object.words()), wanted);
            return None;
        };
        let inner = Object {
            table: own,
            ..*object
        };
        self.known_keys(&inner, FRICTION_KEYS);
        let slot = |key: &str, unit| object.slot(&format!("friction_{key}"), unit);
        let viscous = own.get("viscous");
        let viscous = viscous.and_then(|raw| self.number(&slot("viscous", units[2]), raw));
        let Some(coefficient) = own.get("coefficient") else {
            return Some(Friction { viscous, dry: None });
        };
        let (Some(load), Some(speed)) = (own.get("load"), own.get("speed")) else {
            let message = format!(
                "dry friction of {} needs its `load` and the `speed` below which it is smoothed",
                object.words()
            );
            self.error("missing-value", raw.place, message);
            return None;
        };
        if matches!(&load.kind, Kind::Text(own) if own.content.contains("lambda_")) {
            let message = format!(
                "the load of {} is a reaction, which is known with the motion only: this law of friction is not solved",
                object.words()
            );
            self.problems.push(
                Diagnostic::error("unknown-reaction", load.place, message)
                    .hint("state the load as an expression of the state, as in \"m g\""),
            );
            return None;
        }
        let coefficient = self.number(&slot("coefficient", "1"), coefficient)?;
        let load = self.function(&slot("load", units[0]), load)?;
        let speed = self.number(&slot("speed", units[1]), speed)?;
        self.assume_positive(speed, raw.place);
        let most = self.algebra.graph.mul(&[coefficient, load]);
        Some(Friction {
            viscous,
            dry: Some([most, speed]),
        })
    }

    /// What a law of friction multiplies a velocity with.
    fn resistance(
        &mut self,
        law: &Friction,
        velocities: &[Expr],
        name: &str,
        place: Place,
    ) -> Expr {
        let graph = &self.algebra.graph;
        let mut parts: Vec<Expr> = law.viscous.into_iter().collect();
        if let Some([most, speed]) = law.dry {
            let all = velocities.iter().chain([&speed]);
            let squares: Vec<Expr> = all.map(|e| graph.powi(*e, 2)).collect();
            parts.push(graph.div(most, graph.sqrt(graph.add(&squares))));
        }
        let whole = graph.neg(graph.add(&parts));
        self.name(&format!("{name}_resistance"), whole, place)
    }

    /// Friction along the coordinate of a joint.
    pub(crate) fn rub_joint(&mut self, object: &Object<'r>, rate: Expr, units: [&'static str; 3]) {
        let Some(law) = self.friction(object, units) else {
            return;
        };
        let resistance = self.resistance(&law, &[rate], object.name(), object.place);
        let force = self.algebra.graph.mul(&[resistance, rate]);
        self.work(force, rate, object.place);
    }

    /// Friction where a contact slides.
    pub(crate) fn rub_contact(&mut self, contact: &ContactStated<'r>, found: &Found) {
        let object = &contact.object;
        if object.get("friction").is_some() && contact.kind.word != "sliding" {
            let message = format!("{} does not slide: it has no friction", object.words());
            return self.error("not-allowed-here", object.place, message);
        }
        let Some(law) = self.friction(object, ["N", "m/s", "N s/m"]) else {
            return;
        };
        let [along, across, _] = found.velocities;
        let slip = [along, across, self.algebra.graph.zero()];
        let [along, across, _] =
            self.name_vector(&format!("{}_slip", object.name()), slip, object.place);
        let resistance = self.resistance(&law, &[along, across], object.name(), object.place);
        let mut force = self.algebra.zero();
        for (velocity, direction) in [along, across].into_iter().zip(found.directions) {
            let own = self.algebra.graph.mul(&[resistance, velocity]);
            self.work(own, velocity, object.place);
            force = self.algebra.plus(force, self.algebra.times(own, direction));
        }
        let force = self.in_base(GROUND, found.axes, force);
        let point = self.point(GROUND, found.axes, found.point);
        let names = [contact.body.clone(), contact.on.clone()];
        let wrench = [force, self.algebra.zero()];
        self.keep_load(object, names, [point; 2], wrench);
    }

    /// `limits = [least, most]` of a coordinate: assumptions, and events that stop.
    pub(crate) fn limit(&mut self, object: &Object<'r>, q: Expr, unit: &'static str) {
        let Some(raw) = object.get("limits") else {
            return;
        };
        let Kind::Array(items) = &raw.kind else {
            let what = format!("`limits` of {}", object.words());
            return self.wrong_kind(raw, &what, "an array of the least and the greatest value");
        };
        if items.len() != 2 {
            let message = format!(
                "{} has two limits, the least and the greatest value",
                object.words()
            );
            return self.error("wrong-length", raw.place, message);
        }
        let ends = [("least", ">=", "falling"), ("most", "<=", "rising")];
        for ((end, relation, direction), item) in ends.into_iter().zip(items) {
            let slot = object.slot(end, unit);
            let Some(limit) = self.number(&slot, item) else {
                continue;
            };
            self.assume(q, relation, limit, raw.place);
            let when = self.algebra.graph.text(self.algebra.graph.sub(q, limit));
            let about = format!("{} reaches its limit", object.words());
            let entries = vec![
                ("when", text(when, raw.place)),
                ("direction", text(direction, raw.place)),
                ("action", text("stop", raw.place)),
                ("description", text(about, raw.place)),
            ];
            let name = super::sections::word(format!("{}_{end}", object.name()), raw.place);
            let event = table(entries, raw.place);
            self.written.events.entries.push((name, event));
        }
    }
}

fn graph_neg(lowering: &Lowering<'_>, e: Expr) -> Expr {
    lowering.algebra.graph.neg(e)
}
