//! Every frame and body is put in its place, after what it hangs on.

use chetaev_symbolic::Expr;

use super::algebra::{Turn, Vector};
use super::joints::{Freedom, Motion};
use super::lowering::{FrameId, Lowering, Step, GROUND};
use super::reading::Object;
use super::sections::word;
use super::shapes::Outline;
use super::springs::Spring;
use super::tree::{JointStated, Tree};
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::source::Place;
use crate::text::Text;

/// How a contact is built into the coordinates of the body that everything else hangs on.
#[derive(Clone, Debug)]
pub(crate) struct Built {
    /// The body whose place it is built into.
    pub(crate) body: String,
    /// The contact by its number.
    pub(crate) contact: usize,
    /// The frame that turns with the heading only, its origin at the point of contact.
    pub(crate) heading: FrameId,
    /// The frame that leans, before anything turns about the axle.
    pub(crate) leaning: FrameId,
}

/// What hangs by a joint, or on a contact alone.
enum Hanging<'a, 't> {
    Frame(Object<'t>),
    Joint(&'a JointStated<'t>),
    Contact(usize),
}

impl<'r> Lowering<'r> {
    /// Places everything; what cannot be placed is reported.
    pub(crate) fn place_all(&mut self, tree: &Tree<'r>) -> Vec<Built> {
        let mut built = Vec::new();
        let frames = tree.frames.keys().cloned();
        let joined = tree.joints.iter().map(|joint| joint.child.clone());
        let others = self.bodies.iter().map(|body| body.name.clone());
        let all: Vec<String> = frames.chain(joined).chain(others).collect();
        for name in all {
            self.place_with_parents(&name, tree, &mut built);
        }
        built
    }

    fn place_with_parents(&mut self, name: &str, tree: &Tree<'r>, built: &mut Vec<Built>) {
        let mut chain: Vec<(String, Hanging<'_, 'r>)> = Vec::new();
        let mut at = name.to_owned();
        while !self.placed.contains_key(&at) {
            if chain.iter().any(|(own, _)| *own == at) {
                let names: Vec<&str> = chain.iter().map(|(own, _)| own.as_str()).collect();
                let message = format!(
                    "{} hang on each other: none of them hangs on the ground",
                    names.join(", ")
                );
                let place = self.place_of(&at, tree);
                self.error("circular-definition", place, message);
                // Placed at rest, they give no second diagnostic.
                self.placed
                    .extend(chain.into_iter().map(|(own, _)| (own, GROUND)));
                return;
            }
            let Some((hanging, parent)) = self.hanging(&at, tree) else {
                self.placed.insert(at, GROUND);
                return;
            };
            chain.push((at, hanging));
            at = parent;
        }
        let mut parent = self.placed[&at];
        for (name, hanging) in chain.into_iter().rev() {
            let place = self.place_of(&name, tree);
            parent = match hanging {
                Hanging::Frame(object) => self.place_frame(&object, parent),
                Hanging::Joint(joint) => match self.builds(&name, Some(joint), tree) {
                    Some(contact) => self.build(&name, Some(joint), contact, tree, parent, built),
                    None => self.place_joint(joint, parent),
                },
                Hanging::Contact(contact) => self.build(&name, None, contact, tree, parent, built),
            };
            self.frames[parent].is_kept |= tree.contacts.iter().any(|contact| contact.on == name);
            if self.frames[parent].name != name && !self.placed.values().any(|own| *own == parent) {
                self.frames[parent].name = name.clone();
                self.frames[parent].place = place;
            }
            self.placed.insert(name, parent);
        }
    }

    fn place_of(&self, name: &str, tree: &Tree<'r>) -> Place {
        let body = self.bodies.iter().find(|body| body.name == name);
        let frame = || tree.frames.get(name).map(|object| object.place);
        body.map(|body| body.place)
            .or_else(frame)
            .unwrap_or_default()
    }

    /// How something hangs, and on what; a body that hangs nowhere is reported.
    fn hanging<'a>(&mut self, name: &str, tree: &'a Tree<'r>) -> Option<(Hanging<'a, 'r>, String)> {
        if let Some(object) = tree.frames.get(name) {
            let parent = self.word(object, "parent");
            let parent = parent.map_or("ground".to_owned(), |text| text.content.clone());
            return Some((Hanging::Frame(*object), parent));
        }
        if let Some(joint) = tree.placing.get(name) {
            let joint = &tree.joints[*joint];
            return Some((Hanging::Joint(joint), joint.parent.clone()));
        }
        let body = self.bodies.iter().find(|body| body.name == name)?;
        let place = body.place;
        if let Some(contact) = self.builds(name, None, tree) {
            return Some((Hanging::Contact(contact), tree.contacts[contact].on.clone()));
        }
        let message = format!("the body `{name}` hangs nowhere: no joint has it as its child, and no wheel or ball of it rolls or slides on a plane");
        self.problems.push(
            Diagnostic::error("hangs-nowhere", place, message).hint(format!(
                "add a line under [joints], as in {name} = {{ type = \"free\" }}"
            )),
        );
        None
    }

    // ---- frames of the user

    fn place_frame(&mut self, object: &Object<'r>, parent: FrameId) -> FrameId {
        let name = object.name();
        let at = self
            .vector(object, "at", "m", true)
            .unwrap_or(self.algebra.zero());
        let turns = self.turns(object, "turn", true);
        let shifted = self.step(parent, Step::Shift(at), name, object.place);
        let turned = self.turned(shifted, &turns, name, object.place);
        let own = if turned == parent {
            self.add(parent, Step::Shift(self.algebra.zero()), name, object.place)
        } else {
            turned
        };
        self.frames[own].is_kept = true;
        own
    }

    // ---- joints

    fn place_joint(&mut self, joint: &JointStated<'r>, parent: FrameId) -> FrameId {
        let object = &joint.object;
        let (name, place) = (self.step_name(object), object.place);
        let at = self
            .vector(object, "at", "m", false)
            .unwrap_or(self.algebra.zero());
        let back = self
            .vector(object, "child_at", "m", false)
            .unwrap_or(self.algebra.zero());
        let tilt = self.turns(object, "tilt", false);
        let mut frame = self.step(parent, Step::Shift(at), &name, place);
        frame = self.turned(frame, &tilt, &name, place);
        let coordinates = self.coordinates(object, &joint.motions, object.name());
        for (motion, q) in joint.motions.iter().zip(coordinates) {
            frame = self.moved(frame, *motion, q, &name, place);
        }
        frame = self.turned_back(frame, &tilt, &name, place);
        let minus = self.algebra.minus(self.algebra.zero(), back);
        self.step(frame, Step::Shift(minus), &name, place)
    }

    /// How the frames between two bodies are called: not as a body.
    fn step_name(&self, object: &Object<'r>) -> String {
        let name = object.name();
        let is_body = self.bodies.iter().any(|body| body.name == name);
        if is_body {
            format!("{name}_{}", object.what)
        } else {
            name.to_owned()
        }
    }

    fn moved(
        &mut self,
        frame: FrameId,
        motion: Motion,
        q: Expr,
        name: &str,
        place: Place,
    ) -> FrameId {
        let signed = if motion.is_backward {
            self.algebra.graph.neg(q)
        } else {
            q
        };
        let step = match motion.freedom {
            Freedom::Turn => Step::Turn(Turn {
                axis: motion.axis,
                angle: signed,
            }),
            Freedom::Slide => {
                Step::Shift(self.algebra.times(signed, self.algebra.unit(motion.axis)))
            }
        };
        self.step(frame, step, name, place)
    }

    /// The coordinates of a joint, named by the user or after the joint; those with a prescribed motion are definitions.
    fn coordinates(&mut self, object: &Object<'r>, motions: &[Motion], owner: &str) -> Vec<Expr> {
        let names = self.coordinate_names(object, motions, owner);
        let mut all = Vec::new();
        for (motion, name) in motions.iter().zip(names) {
            let (unit, word) = match motion.freedom {
                Freedom::Slide => ("m", "length"),
                Freedom::Turn => ("rad", "angle"),
            };
            let word = if motion.word.is_empty() {
                word
            } else {
                motion.word
            };
            let prescribed = self.prescribed(object, &name, motions.len());
            all.push(match prescribed {
                Some(raw) => self.define(&name.content, raw.clone(), true),
                None => self.coordinate(&name, unit, format!("{word} of {}", object.words())),
            });
        }
        if let ([motion], [q]) = (motions, all.as_slice()) {
            self.loads(object, *motion, *q);
        }
        all
    }

    /// What `motion` says of a coordinate.
    fn prescribed(&mut self, object: &Object<'r>, name: &Text, count: usize) -> Option<&'r Raw> {
        let raw = object.get("motion")?;
        match (&raw.kind, count) {
            (Kind::Table(table), _) => table.get(&name.content),
            (_, 1) => Some(raw),
            _ => {
                let what = format!("`motion` of {}", object.words());
                self.wrong_kind(raw, &what, "a table of expressions by coordinate");
                None
            }
        }
    }

    fn coordinate_names(
        &mut self,
        object: &Object<'r>,
        motions: &[Motion],
        owner: &str,
    ) -> Vec<Text> {
        let usual: Vec<Text> = motions
            .iter()
            .map(|motion| match motion.word {
                "" => word(owner, object.place),
                end => word(format!("{owner}_{end}"), object.place),
            })
            .collect();
        let stated = object
            .get("coordinates")
            .or_else(|| object.get("coordinate"));
        let Some(raw) = stated else { return usual };
        let items: Vec<&Raw> = match &raw.kind {
            Kind::Array(items) => items.iter().collect(),
            _ => vec![raw],
        };
        let names: Option<Vec<Text>> = items
            .iter()
            .map(|item| match &item.kind {
                Kind::Text(name) => Some(name.clone()),
                _ => None,
            })
            .collect();
        match names {
            Some(names) if names.len() == motions.len() => names,
            Some(names) => {
                let words: Vec<&str> = motions.iter().map(|motion| motion.word).collect();
                let message = format!(
                    "{} has {} coordinates, not {}",
                    object.words(),
                    motions.len(),
                    names.len()
                );
                let problem = Diagnostic::error("wrong-length", raw.place, message);
                self.problems.push(match words.len() {
                    0 | 1 => problem,
                    _ => problem.hint(format!("they are, in this order: {}", words.join(", "))),
                });
                usual
            }
            None => {
                let what = format!("the coordinates of {}", object.words());
                self.wrong_kind(raw, &what, "an array of names");
                usual
            }
        }
    }

    /// Spring, damper, and force or torque of a joint with one coordinate.
    fn loads(&mut self, object: &Object<'r>, motion: Motion, q: Expr) {
        let (stiffness, damping, load) = match motion.freedom {
            Freedom::Turn => ("N m/rad", "N m s/rad", "torque"),
            Freedom::Slide => ("N/m", "N s/m", "force"),
        };
        let friction = match motion.freedom {
            Freedom::Turn => ["N m", "rad/s", damping],
            Freedom::Slide => ["N", "m/s", damping],
        };
        let unit = match motion.freedom {
            Freedom::Turn => "rad",
            Freedom::Slide => "m",
        };
        let half = self.algebra.ratio(1, 2);
        if let Some(Spring { stiffness, rest }) = self.spring(object, [stiffness, unit]) {
            let graph = &self.algebra.graph;
            let away = graph.sub(q, rest.unwrap_or(graph.zero()));
            let energy = graph.mul(&[half, stiffness, graph.powi(away, 2)]);
            self.store(energy);
        }
        self.limit(object, q, unit);
        let rate = self.algebra.rate(q);
        self.rub_joint(object, rate, friction);
        if let Some(raw) = object.get("damper") {
            if let Some(c) = self.number(&object.slot("damper", damping), raw) {
                let graph = &self.algebra.graph;
                let power = graph.mul(&[half, c, graph.powi(rate, 2)]);
                self.written
                    .dissipation
                    .push(self.algebra.graph.text(power));
            }
        }
        for key in ["torque", "force"] {
            let Some(raw) = object.get(key) else { continue };
            let Some(name) = self.algebra.graph.as_symbol(q) else {
                continue;
            };
            let name = self.algebra.graph.symbol_name(name).to_owned();
            if key != load || object.get("motion").is_some() {
                let message = if key == load {
                    format!(
                        "the motion of {} is prescribed: a {key} on it has no effect",
                        object.words()
                    )
                } else {
                    format!(
                        "a {key} does not act on the {} of {}",
                        if load == "torque" { "angle" } else { "length" },
                        object.words()
                    )
                };
                self.error("not-allowed-here", raw.place, message);
                continue;
            }
            if let Some(value) = self.function(&object.slot(key, friction[0]), raw) {
                let value = super::sections::text(self.algebra.graph.text(value), raw.place);
                self.written
                    .forces
                    .entries
                    .push((word(name, raw.place), value));
            }
        }
    }

    // ---- contacts that are built into coordinates

    /// The contact that is built into the place of a body which is free otherwise.
    fn builds(
        &self,
        name: &str,
        joint: Option<&JointStated<'r>>,
        tree: &Tree<'r>,
    ) -> Option<usize> {
        if let Some(joint) = joint {
            let has_place = ["at", "child_at", "tilt", "motion"]
                .iter()
                .any(|key| joint.object.get(key).is_some());
            if joint.kind.word != "free" || has_place {
                return None;
            }
        }
        let parent = joint.map(|joint| joint.parent.as_str());
        let on = |contact: usize| tree.contacts[contact].on.as_str();
        (0..tree.contacts.len()).find(|&contact| {
            parent.is_none_or(|parent| parent == on(contact)) && self.is_hub_of(name, contact, tree)
        })
    }

    /// Whether the rim or sphere of a contact is the body's own, or a wheel turns about its own axle at it.
    fn is_hub_of(&self, name: &str, contact: usize, tree: &Tree<'r>) -> bool {
        let stated = &tree.contacts[contact];
        if ["at", "axis", "radius", "taper", "figure", "surface"]
            .iter()
            .any(|key| stated.object.get(key).is_some())
        {
            return false;
        }
        let Some(body) = self.bodies.iter().find(|body| body.name == stated.body) else {
            return false;
        };
        let Some((shape, sizes)) = &body.shape else {
            return false;
        };
        match shape.outline {
            Outline::Sphere => stated.body == name,
            Outline::Rim if sizes.axis == self.up.axis => false,
            Outline::Rim if stated.body == name => true,
            Outline::Rim => tree.placing.get(&stated.body).is_some_and(|joint| {
                let joint = &tree.joints[*joint];
                joint.parent == name
                    && joint.kind.word == "revolute"
                    && joint.motions[0].axis == sizes.axis
                    && joint.object.get("tilt").is_none()
                    && joint.object.get("child_at").is_none()
                    && self.algebra.is_along(self.outline_center(body), sizes.axis)
            }),
            _ => false,
        }
    }

    /// Where the middle of a shape lies in the axes of its body: at the centre of mass where the body is homogeneous, else at the
    /// origin.
    pub(crate) fn outline_center(&self, body: &super::lowering::Body) -> Vector {
        if body.is_homogeneous {
            body.center
        } else {
            self.algebra.zero()
        }
    }

    /// The vertical of a plane as a vector.
    pub(crate) fn up_vector(&self) -> Vector {
        let unit = self.algebra.unit(self.up.axis);
        if self.up.is_backward {
            self.algebra.minus(self.algebra.zero(), unit)
        } else {
            unit
        }
    }

    /// Heading, lean and pitch of a rim that touches, or the angles of a ball, from the point of contact.
    fn build(
        &mut self,
        name: &str,
        joint: Option<&JointStated<'r>>,
        contact: usize,
        tree: &Tree<'r>,
        parent: FrameId,
        built: &mut Vec<Built>,
    ) -> FrameId {
        let stated = &tree.contacts[contact];
        let object = joint.map_or(stated.object, |joint| joint.object);
        let owner = joint.map_or(name, |joint| joint.object.name()).to_owned();
        let (place, between) = (object.place, self.step_name(&object));
        let Some(body) = self.bodies.iter().find(|body| body.name == stated.body) else {
            return parent;
        };
        let Some((outline, axle, radius)) = body
            .shape
            .as_ref()
            .map(|(s, n)| (s.outline, n.axis, n.lengths[0]))
        else {
            return parent;
        };
        let mut hub = self.outline_center(body);
        if stated.body != name {
            if let Some(joint) = tree.placing.get(&stated.body) {
                let at = self.vector(&tree.joints[*joint].object, "at", "m", false);
                hub = self.algebra.plus(hub, at.unwrap_or(self.algebra.zero()));
            }
        }
        let up = self.up.axis;
        let slides = [(0, "x"), (1, "y"), (2, "z")]
            .into_iter()
            .filter(|(axis, _)| *axis != up);
        let mut motions: Vec<Motion> = slides
            .map(|(axis, word)| Motion::slide(axis, word))
            .collect();
        match outline {
            Outline::Sphere => {
                let sequence = joint.map(|joint| joint.motions[3..].to_vec());
                motions.extend(sequence.unwrap_or_else(|| {
                    [(2, "yaw"), (0, "lean"), (1, "pitch")]
                        .map(|(axis, word)| Motion::turn(axis, word))
                        .to_vec()
                }));
            }
            _ => motions.extend([
                Motion::turn(up, "yaw"),
                Motion::turn(3 - up - axle, "lean"),
                Motion::turn(axle, "pitch"),
            ]),
        }
        let q = self.coordinates(&object, &motions, &owner);
        let mut at = parent;
        let rise = self.algebra.times(radius, self.up_vector());
        let (mut heading, mut leaning) = (parent, parent);
        for (number, (motion, q)) in motions.iter().zip(q).enumerate() {
            if number == 2 && outline == Outline::Sphere {
                (heading, leaning) = (at, at);
            }
            let is_risen = number == if outline == Outline::Sphere { 2 } else { 4 };
            if is_risen {
                at = self.step(at, Step::Shift(rise), &between, place);
            }
            at = self.moved(at, *motion, q, &between, place);
            match number {
                2 if outline == Outline::Rim => heading = at,
                3 if outline == Outline::Rim => leaning = at,
                _ => {}
            }
        }
        built.push(Built {
            body: name.to_owned(),
            contact,
            heading,
            leaning,
        });
        let minus = self.algebra.minus(self.algebra.zero(), hub);
        self.step(at, Step::Shift(minus), &between, place)
    }
}
