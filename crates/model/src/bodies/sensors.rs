//! Ready sensors: what a point, a body, a joint or a contact does, as named expressions.
//!
//! The place of a point against a frame A is the vector from the origin of A along its axes; velocity and acceleration are its
//! derivatives. The reaction of a contact, or of a joint that closes a chain, follows from the multipliers of its constraints; that of a joint by
//! which a part of the mechanism hangs from the balances of momentum and of moment of momentum of that part
//! (J. Wittenburg, Dynamics of Multibody Systems, 2008, §§ 3.1, 5.4).

use chetaev_symbolic::{Expr, Function};

use super::algebra::Vector;
use super::forces::End;
use super::lowering::{FrameId, Lowering, GROUND};
use super::objects::KeptReaction;
use super::placing::Built;
use super::reading::Object;
use super::sections::{table, text, word};
use super::tree::Tree;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::source::Place;

const KEYS: &[&str] = &[
    "type",
    "body",
    "at",
    "in",
    "against",
    "axis",
    "to_axis",
    "of",
    "description",
];

/// The mechanism that sensors look at.
#[derive(Clone, Copy)]
pub(crate) struct Whole<'a, 't> {
    pub(crate) tree: &'a Tree<'t>,
    pub(crate) built: &'a [Built],
    /// The acceleration of gravity.
    pub(crate) gravity: Option<Expr>,
}

/// What a sensor looks at: a point of a body, against a frame, along the axes of one.
#[derive(Clone, Copy)]
struct Probe<'r> {
    end: End<'r>,
    against: FrameId,
    axes: FrameId,
}

/// The part of a mechanism that hangs by a joint.
struct Part {
    /// The joint, or the contact on which it stands.
    object: String,
    /// Where that is stated.
    place: Place,
    /// Its bodies by number.
    bodies: Vec<usize>,
}

/// Whether an entry of `[sensors]` is a ready one.
pub(crate) fn is_ready(raw: &Raw) -> bool {
    raw.table().is_some_and(|own| own.get("type").is_some())
}

/// The words of ready sensors.
const WORDS: &[&str] = &[
    "position",
    "velocity",
    "acceleration",
    "angular-velocity",
    "angle",
    "kinetic-energy",
    "potential-energy",
    "energy",
    "reaction",
];

impl<'r> Lowering<'r> {
    /// Writes the ready sensors as named expressions.
    pub(crate) fn sense_all(&mut self, whole: Whole<'_, 'r>) {
        for object in self.objects_where("sensors", "sensor", is_ready) {
            self.known_keys(&object, KEYS);
            for (end, value) in self.sense(&object, whole).unwrap_or_default() {
                let name = match end.as_str() {
                    "" => object.name().to_owned(),
                    end => format!("{}_{end}", object.name()),
                };
                let value = text(self.algebra.graph.text(value), object.place);
                let mut entries = vec![("value", value)];
                if let Some(raw) = object.get("description") {
                    entries.push(("description", raw.clone()));
                }
                let value = table(entries, object.place);
                let key = word(name, object.place);
                self.written.sensors.entries.push((key, value));
            }
        }
    }

    /// The ends of the names, and what is measured.
    fn sense(&mut self, object: &Object<'r>, whole: Whole<'_, 'r>) -> Option<Vec<(String, Expr)>> {
        let kind = self.word(object, "type")?;
        if !WORDS.contains(&kind.content.as_str()) {
            self.no_such_word(kind, "type", WORDS);
            return None;
        }
        if kind.content == "reaction" {
            return self.sense_reaction(object, whole);
        }
        let probe = self.probe(object)?;
        match kind.content.as_str() {
            "angle" => self.sense_angle(object, probe),
            "kinetic-energy" | "potential-energy" | "energy" => {
                self.sense_energy(object, &kind.content, probe, whole.gravity)
            }
            "angular-velocity" => {
                let v = self.angular_velocity(probe);
                Some(components("", v))
            }
            word => {
                let order = match word {
                    "position" => 0,
                    "velocity" => 1,
                    _ => 2,
                };
                let v = self.place_rate(probe, order);
                Some(components("", v))
            }
        }
    }

    fn probe(&mut self, object: &Object<'r>) -> Option<Probe<'r>> {
        if object.get("body").is_none() {
            let message = format!("{} needs the `body` that it looks at", object.words());
            self.error("missing-value", object.place, message);
            return None;
        }
        let end = self.end(object, ["body", "at"])?;
        let against = self.frame_under(object, "against")?;
        let axes = match object.get("in") {
            Some(_) => self.frame_under(object, "in")?,
            None => against,
        };
        Some(Probe { end, against, axes })
    }

    /// The place of a point against a frame, or a derivative of it.
    fn place_rate(&mut self, probe: Probe<'r>, order: usize) -> Vector {
        let Probe { end, against, axes } = probe;
        let mut own = if self.path(against, end.frame).is_some() {
            self.point(against, end.frame, end.at)
        } else {
            let point = self.point(GROUND, end.frame, end.at);
            let origin = self.position(GROUND, against);
            let apart = self.algebra.minus(point, origin);
            self.components(apart, GROUND, against)
        };
        for _ in 0..order {
            own = own.map(|e| self.algebra.rate(e));
        }
        self.components(own, against, axes)
    }

    fn angular_velocity(&mut self, probe: Probe<'r>) -> Vector {
        let [own, carried] = [probe.end.frame, probe.against].map(|frame| {
            let omega = self.rates(GROUND, frame).omega;
            self.components(omega, frame, probe.axes)
        });
        self.algebra.minus(own, carried)
    }

    /// The angle from 0 to π between an axis of a body and an axis of a frame; the vertical where none is stated.
    fn sense_angle(
        &mut self,
        object: &Object<'r>,
        probe: Probe<'r>,
    ) -> Option<Vec<(String, Expr)>> {
        let up = (self.up.axis, self.up.is_backward);
        let ends = [("axis", probe.end.frame), ("to_axis", probe.against)];
        let mut axes = [self.algebra.zero(); 2];
        for (own, (key, frame)) in axes.iter_mut().zip(ends) {
            let (axis, is_backward) = match self.word(object, key) {
                Some(text) => self.axis_of(text)?,
                None => up,
            };
            let column = self.axes(GROUND, frame).map(|row| row[axis]);
            *own = if is_backward {
                self.algebra.minus(self.algebra.zero(), column)
            } else {
                column
            };
        }
        let a = &self.algebra;
        let across = a.cross(axes[0], axes[1]);
        let sine = a.graph.sqrt(a.dot(across, across));
        let cosine = a.dot(axes[0], axes[1]);
        let angle = a.graph.apply(Function::Atan2, &[sine, cosine]);
        Some(vec![(String::new(), angle)])
    }

    fn sense_energy(
        &mut self,
        object: &Object<'r>,
        kind: &str,
        probe: Probe<'r>,
        gravity: Option<Expr>,
    ) -> Option<Vec<(String, Expr)>> {
        let mut own = self.bodies.iter();
        let Some(number) = own.position(|body| body.name == probe.end.name) else {
            let message = format!(
                "{} measures the energy of `{}`, which is no body",
                object.words(),
                probe.end.name
            );
            self.error("unknown-body", object.place, message);
            return None;
        };
        let mut parts = Vec::new();
        if kind != "potential-energy" {
            parts.push(self.kinetic(number));
        }
        let body = &self.bodies[number];
        if let (Some(mass), Some(g), true) = (body.mass, gravity, kind != "kinetic-energy") {
            let center = body.center;
            let axes = self.unturned(probe.end.frame, center);
            let height = self.height(axes, center);
            parts.push(self.algebra.graph.mul(&[mass, g, height]));
        }
        Some(vec![(String::new(), self.algebra.graph.add(&parts))])
    }

    // ---- reactions

    /// Force on the child, or on the body that touches, and torque about a point.
    fn sense_reaction(
        &mut self,
        object: &Object<'r>,
        whole: Whole<'_, 'r>,
    ) -> Option<Vec<(String, Expr)>> {
        let Some(of) = self.word(object, "of") else {
            let message = format!(
                "{} needs the joint or contact `of` which it measures the reaction",
                object.words()
            );
            self.error("missing-value", object.place, message);
            return None;
        };
        let axes = self.frame_under(object, "in")?;
        let part = self.part(&of.content, whole);
        let own: Vec<KeptReaction<Expr>> = self
            .reactions
            .iter()
            .filter(|own| own.object == of.content)
            .cloned()
            .collect();
        let usual = match (&part, own.first()) {
            (Some(part), _) => self.hinge_of(part, whole),
            (None, Some(own)) => own.point,
            (None, None) => {
                let message = format!(
                    "there is no joint or contact `{}` with a reaction",
                    of.content
                );
                self.error("unknown-name", of.place, message);
                return None;
            }
        };
        let about = match object.get("body") {
            Some(_) => {
                let end = self.end(object, ["body", "at"])?;
                self.point(GROUND, end.frame, end.at)
            }
            None => usual,
        };
        let wrench = match &part {
            Some(part) => self.balance(object, part, about, whole.gravity)?,
            None => {
                let mut sum = [self.algebra.zero(); 2];
                for own in &own {
                    let one = self.multiplied(object, own, about)?;
                    sum = [0, 1].map(|i| self.algebra.plus(sum[i], one[i]));
                }
                // Friction is a part of it.
                let place = own.first().map(|own| own.place);
                for load in self.loads.iter().filter(|load| Some(load.place) == place) {
                    let one = self.about(load, about);
                    sum = [0, 1].map(|i| self.algebra.plus(sum[i], one[i]));
                }
                sum
            }
        };
        let [force, torque] = wrench.map(|v| self.components(v, GROUND, axes));
        Some([components("force", force), components("torque", torque)].concat())
    }

    /// What hangs by a joint, or stands on a contact that is built into its coordinates.
    fn part(&self, name: &str, whole: Whole<'_, 'r>) -> Option<Part> {
        let tree = whole.tree;
        let mut built = whole.built.iter();
        let is_named = |own: &&Built| tree.contacts[own.contact].object.name() == name;
        let (root, place) = match built.find(is_named) {
            Some(built) => (
                built.body.clone(),
                tree.contacts[built.contact].object.place,
            ),
            None => {
                let mut placing = tree.placing.iter();
                let (body, joint) =
                    placing.find(|(_, joint)| tree.joints[**joint].object.name() == name)?;
                (body.clone(), tree.joints[*joint].object.place)
            }
        };
        // What hangs on itself is reported where it is placed.
        let most = self.bodies.len() + tree.frames.len();
        let bodies = (0..self.bodies.len()).filter(|&number| {
            let mut at = self.bodies[number].name.clone();
            for _ in 0..most {
                if at == root || at == "ground" {
                    break;
                }
                at = self.hangs_on(&at, tree, whole.built).0;
            }
            at == root
        });
        Some(Part {
            object: name.to_owned(),
            place,
            bodies: bodies.collect(),
        })
    }

    fn hinge_of(&mut self, part: &Part, whole: Whole<'_, 'r>) -> Vector {
        let root = part.bodies.iter().copied().find(|&number| {
            let name = &self.bodies[number].name;
            self.hangs_on(name, whole.tree, whole.built).1 == part.object
        });
        let name = root.map(|number| self.bodies[number].name.clone());
        match name.and_then(|name| Some((self.placed.get(&name).copied()?, name))) {
            Some((frame, name)) => self.hinge(&name, frame, whole.tree, whole.built),
            None => self.algebra.zero(),
        }
    }

    /// A reaction times its multiplier, about a point.
    fn multiplied(
        &mut self,
        sensor: &Object<'_>,
        own: &KeptReaction<Expr>,
        about: Vector,
    ) -> Option<[Vector; 2]> {
        if self.algebra.is_zero(own.force) && self.algebra.is_zero(own.torque) {
            return Some([self.algebra.zero(); 2]);
        }
        let mut written = self.written.constraints.entries.iter();
        if !written.any(|(key, _)| key.content == own.constraint) {
            let message = format!(
                "{} is not determined: what `{}` demands holds whatever the bodies do, so that other joints may carry any part of its reaction",
                sensor.words(),
                own.constraint
            );
            let problem = Diagnostic::error("not-determined", sensor.place, message);
            self.problems
                .push(problem.related(own.place, "stated here"));
            return None;
        }
        let multiplier = self.algebra.symbol(&format!("lambda_{}", own.constraint));
        let [force, torque] = self.about(own, about);
        Some([force, torque].map(|v| self.algebra.times(multiplier, v)))
    }

    /// Force and torque on the body, about a point.
    fn about(&self, own: &KeptReaction<Expr>, about: Vector) -> [Vector; 2] {
        let arm = self.algebra.minus(own.point, about);
        let turned = self.algebra.cross(arm, own.force);
        [own.force, self.algebra.plus(own.torque, turned)]
    }

    /// The force and the torque that a part of the mechanism needs from its joint: what momentum and moment of momentum gain, less all else that
    /// acts on it from outside.
    fn balance(
        &mut self,
        sensor: &Object<'_>,
        part: &Part,
        about: Vector,
        gravity: Option<Expr>,
    ) -> Option<[Vector; 2]> {
        self.only_bodies(sensor)?;
        let mut sum = [self.algebra.zero(); 2];
        for &number in &part.bodies {
            let gained = self.gained(number, about, gravity);
            sum = [0, 1].map(|i| self.algebra.plus(sum[i], gained[i]));
        }
        let names: Vec<String> = part
            .bodies
            .iter()
            .map(|&number| self.bodies[number].name.clone())
            .collect();
        let side =
            |own: &KeptReaction<Expr>| (names.contains(&own.body), names.contains(&own.other));
        for own in self
            .reactions
            .clone()
            .iter()
            .filter(|own| own.object != part.object)
        {
            let outside = side(own);
            if outside.0 != outside.1 {
                let one = self.multiplied(sensor, own, about)?;
                sum = self.less(sum, one, outside.0);
            }
        }
        let loads = self.loads.clone().into_iter();
        // The friction of the contact itself is a part of what it exerts.
        for own in loads.filter(|own| own.place != part.place) {
            let outside = side(&own);
            if outside.0 != outside.1 {
                let one = self.about(&own, about);
                sum = self.less(sum, one, outside.0);
            }
        }
        Some(sum)
    }

    /// A sum without what acts on it, or on its opposite side.
    fn less(&self, sum: [Vector; 2], own: [Vector; 2], is_on_it: bool) -> [Vector; 2] {
        [0, 1].map(|i| {
            if is_on_it {
                self.algebra.minus(sum[i], own[i])
            } else {
                self.algebra.plus(sum[i], own[i])
            }
        })
    }

    /// Balances need that all that acts is known at bodies.
    fn only_bodies(&mut self, sensor: &Object<'_>) -> Option<()> {
        let is_stated = |key: &str| {
            let own = self.root.get(key);
            own.is_some_and(|raw| match &raw.kind {
                Kind::Table(own) => own
                    .entries
                    .iter()
                    .any(|(_, raw)| !super::forces::acts_on_body(raw)),
                Kind::Array(items) => !items.is_empty(),
                _ => true,
            })
        };
        let keys = ["lagrangian", "forces", "constraints", "particles"];
        let Some(key) = keys.into_iter().find(|key| is_stated(key)) else {
            return Some(());
        };
        let message = format!(
            "{} is not determined: the model states `[{key}]` in coordinates, and nobody knows on which body that acts",
            sensor.words()
        );
        self.error("not-determined", sensor.place, message);
        None
    }

    /// The rates of momentum and of moment of momentum about a point at rest, less the weight.
    fn gained(&mut self, number: usize, about: Vector, gravity: Option<Expr>) -> [Vector; 2] {
        let body = &self.bodies[number];
        let (name, place) = (body.name.clone(), body.place);
        let (mass, center, inertia) = (body.mass, body.center, body.inertia);
        let zero = self.algebra.zero();
        let Some(&frame) = self.placed.get(&name) else {
            return [zero; 2];
        };
        let mut gained = [zero; 2];
        if let Some(mass) = mass {
            let still = self.unturned(frame, center);
            let at = self.point(GROUND, still, center);
            let at = self.name_vector(&format!("{name}_center_p"), at, place);
            let a = &self.algebra;
            let mut force = a.times(mass, at.map(|e| a.rate(a.rate(e))));
            if let Some(g) = gravity {
                let weight = a.graph.mul(&[mass, g]);
                force = a.plus(force, a.times(weight, self.up_vector()));
            }
            gained = [force, a.cross(a.minus(at, about), force)];
        }
        if let Some(inertia) = inertia {
            let axes = self.inertia_axes(frame, &inertia);
            let omega = self.turning(frame, &inertia, &name, place);
            let own = inertia.map(|row| self.algebra.dot(row, omega));
            let own = self.in_base(GROUND, axes, own);
            let own = self.name_vector(&format!("{name}_H"), own, place);
            let rate = own.map(|e| self.algebra.rate(e));
            gained[1] = self.algebra.plus(gained[1], rate);
        }
        gained
    }
}

/// Components with their names.
fn components(what: &str, v: Vector) -> Vec<(String, Expr)> {
    let between = if what.is_empty() { "" } else { "_" };
    let ends = ["x", "y", "z"].map(|axis| format!("{what}{between}{axis}"));
    ends.into_iter().zip(v).collect()
}
