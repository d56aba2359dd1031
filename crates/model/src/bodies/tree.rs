//! What hangs on what: frames, joints and contacts as they are stated, before anything is placed.

use std::collections::BTreeMap;

use chetaev_symbolic::syntax::names;

use super::contacts::{Contact, CONTACTS};
use super::couplings::is_coupling;
use super::joints::{Axes, Direction, Joint, Motion, JOINTS};
use super::lowering::Lowering;
use super::reading::Object;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::source::Place;
use crate::text::Text;

/// A joint as it is stated.
pub(crate) struct JointStated<'t> {
    pub(crate) object: Object<'t>,
    pub(crate) kind: &'static Joint,
    pub(crate) motions: Vec<Motion>,
    pub(crate) parent: String,
    pub(crate) child: String,
    /// Whether the body is stated as the parent, and what is at rest or a frame as the child: such a joint closes a chain.
    pub(crate) is_reversed: bool,
}

/// A contact as it is stated.
pub(crate) struct ContactStated<'t> {
    pub(crate) object: Object<'t>,
    pub(crate) kind: &'static Contact,
    pub(crate) body: String,
    pub(crate) on: String,
}

/// Everything that is stated.
#[derive(Default)]
pub(crate) struct Tree<'t> {
    pub(crate) frames: BTreeMap<String, Object<'t>>,
    pub(crate) joints: Vec<JointStated<'t>>,
    pub(crate) contacts: Vec<ContactStated<'t>>,
    /// The joint that places a body: the first of which it is the child.
    pub(crate) placing: BTreeMap<String, usize>,
    /// Joints between bodies that others have placed.
    pub(crate) closing: Vec<usize>,
    /// Gears, differentials and ropes.
    pub(crate) couplings: Vec<Object<'t>>,
}

const JOINT_KEYS: &[&str] = &[
    "type",
    "parent",
    "child",
    "axis",
    "sequence",
    "at",
    "child_at",
    "tilt",
    "coordinate",
    "coordinates",
    "motion",
    "spring",
    "damper",
    "friction",
    "limits",
    "torque",
    "force",
    "description",
];
const CONTACT_KEYS: &[&str] = &[
    "type",
    "body",
    "on",
    "surface",
    "at",
    "axis",
    "radius",
    "taper",
    "figure",
    "direction",
    "angle",
    "coordinates",
    "friction",
    "description",
];
const FRAME_KEYS: &[&str] = &["parent", "at", "turn", "description"];

impl<'r> Lowering<'r> {
    /// Reads what hangs on what.
    pub(crate) fn read_tree(&mut self) -> Tree<'r> {
        let mut tree = Tree::default();
        for object in self.objects("frames", "frame") {
            self.known_keys(&object, FRAME_KEYS);
            if self.is_new_name(&object) {
                tree.frames.insert(object.name().to_owned(), object);
            }
        }
        for object in self.objects("joints", "joint") {
            if is_coupling(&object) {
                tree.couplings.push(object);
                continue;
            }
            self.known_keys(&object, JOINT_KEYS);
            if let Some(joint) = self.read_joint(object, &tree) {
                let number = tree.joints.len();
                if joint.is_reversed || tree.placing.contains_key(&joint.child) {
                    tree.closing.push(number);
                } else {
                    tree.placing.insert(joint.child.clone(), number);
                }
                tree.joints.push(joint);
            }
        }
        for object in self.objects("contacts", "contact") {
            self.known_keys(&object, CONTACT_KEYS);
            let contact = self.read_contact(object);
            tree.contacts.extend(contact);
        }
        self.find_parents(&tree);
        tree
    }

    /// A frame is called like no body, and not like the ground.
    fn is_new_name(&mut self, object: &Object<'_>) -> bool {
        let name = object.name();
        if name == "ground" {
            self.error(
                "reserved-name",
                object.place,
                "`ground` is the frame at rest",
            );
            return false;
        }
        let earlier = self.bodies.iter().find(|body| body.name == name);
        if let Some(earlier) = earlier.map(|body| body.place) {
            let message = format!("`{name}` is a body already, and cannot name a frame too");
            let problem = Diagnostic::error("declared-twice", object.place, message);
            self.problems.push(problem.related(earlier, "first here"));
            return false;
        }
        true
    }

    fn read_joint(&mut self, object: Object<'r>, tree: &Tree<'r>) -> Option<JointStated<'r>> {
        let usual = JOINTS.iter().find(|joint| joint.word == "revolute");
        let kind = match object.get("type") {
            Some(_) => self.choice(&object, "type", JOINTS, |joint| joint.word)?,
            None => usual?,
        };
        let directions = self.directions(&object, kind)?;
        let parent = match self.word(&object, "parent") {
            Some(text) => text.content.clone(),
            None => "ground".to_owned(),
        };
        let child = match self.word(&object, "child") {
            Some(text) => text.content.clone(),
            None => object.name().to_owned(),
        };
        let place = object.get("child").map_or(object.place, |raw| raw.place);
        let is_body = |name: &str| self.bodies.iter().any(|body| body.name == name);
        let is_frame = child == "ground" || tree.frames.contains_key(&child);
        let is_reversed = is_frame && is_body(&parent);
        let (parent, child) = if is_reversed {
            (child, parent)
        } else {
            (parent, child)
        };
        if !self.bodies.iter().any(|body| body.name == child) {
            self.no_such_body(&child, place, &object);
            return None;
        }
        Some(JointStated {
            object,
            kind,
            motions: (kind.motions)(&directions),
            parent,
            child,
            is_reversed,
        })
    }

    fn directions(&mut self, object: &Object<'r>, kind: &Joint) -> Option<Vec<Direction>> {
        let direction = |(axis, is_backward): (usize, bool)| Direction { axis, is_backward };
        let stated = match kind.axes {
            Axes::None => return Some(Vec::new()),
            Axes::One => self.word(object, "axis"),
            Axes::Sequence(_) => self.word(object, "sequence"),
        };
        let usual = Text::of_toml(kind.usual, "", object.place);
        let text = stated.unwrap_or(&usual);
        let Axes::Sequence(length) = kind.axes else {
            return Some(vec![direction(self.axis_of(text)?)]);
        };
        let letters: Vec<Option<usize>> = text
            .content
            .chars()
            .map(|own| ['x', 'y', 'z'].iter().position(|axis| *axis == own))
            .collect();
        let axes: Option<Vec<usize>> = letters.into_iter().collect();
        let is_sequence =
            |axes: &Vec<usize>| axes.len() == length && axes.windows(2).all(|w| w[0] != w[1]);
        match axes.filter(is_sequence) {
            Some(axes) => Some(
                axes.into_iter()
                    .map(|axis| direction((axis, false)))
                    .collect(),
            ),
            None => {
                let message = format!("`{}` is no sequence of {length} axes", text.content);
                let hint = "for example \"zxz\": neighbours are different";
                self.problems
                    .push(Diagnostic::error("unknown-value", text.place, message).hint(hint));
                None
            }
        }
    }

    fn read_contact(&mut self, object: Object<'r>) -> Option<ContactStated<'r>> {
        if object.get("type").is_none() {
            let words: Vec<&str> = CONTACTS.iter().map(|contact| contact.word).collect();
            let message = format!("{} needs its `type`", object.words());
            let hint = format!("one of {}", words.join(", "));
            self.problems
                .push(Diagnostic::error("missing-value", object.place, message).hint(hint));
            return None;
        }
        let kind = self.choice(&object, "type", CONTACTS, |contact| contact.word)?;
        let body = match self.word(&object, "body") {
            Some(text) => text.content.clone(),
            None => object.name().to_owned(),
        };
        let on = match self.word(&object, "on") {
            Some(text) => text.content.clone(),
            None => "ground".to_owned(),
        };
        let place = object.get("body").map_or(object.place, |raw| raw.place);
        if !self.bodies.iter().any(|own| own.name == body) {
            self.no_such_body(&body, place, &object);
            return None;
        }
        Some(ContactStated {
            object,
            kind,
            body,
            on,
        })
    }

    fn no_such_body(&mut self, name: &str, place: Place, object: &Object<'_>) {
        let message = format!(
            "{} names the body `{name}`, and there is none",
            object.words()
        );
        let problem = Diagnostic::error("unknown-body", place, message);
        let known = self.bodies.iter().map(|body| body.name.as_str());
        let near = names::closest(name, known);
        let problem = match near {
            Some(near) => problem.hint(format!("did you mean `{near}`?")),
            None => problem.hint("state it under [bodies]"),
        };
        self.problems.push(problem);
    }

    /// Reports parents and planes that do not exist.
    fn find_parents(&mut self, tree: &Tree<'r>) {
        let mut wanted: Vec<(Object<'r>, &str, Option<&Raw>)> = Vec::new();
        for joint in &tree.joints {
            wanted.push((joint.object, &joint.parent, joint.object.get("parent")));
        }
        for contact in &tree.contacts {
            wanted.push((contact.object, &contact.on, contact.object.get("on")));
        }
        for object in tree.frames.values() {
            let raw = object.get("parent");
            if let Some(Kind::Text(text)) = raw.map(|raw| &raw.kind) {
                wanted.push((*object, &text.content, raw));
            }
        }
        for (object, name, raw) in wanted {
            let is_body = self.bodies.iter().any(|body| body.name == name);
            if name == "ground" || is_body || tree.frames.contains_key(name) {
                continue;
            }
            let place = raw.map_or(object.place, |raw| raw.place);
            let message = format!(
                "{} names `{name}`, and there is no such body or frame",
                object.words()
            );
            let known = self.bodies.iter().map(|body| body.name.as_str());
            let known = known
                .chain(tree.frames.keys().map(String::as_str))
                .chain(["ground"]);
            let problem = Diagnostic::error("unknown-body", place, message);
            let near = names::closest(name, known).map(|near| format!("did you mean `{near}`?"));
            self.problems.push(match near {
                Some(near) => problem.hint(near),
                None => problem.hint(
                    "state it under [bodies] or [frames]; what is at rest is called `ground`",
                ),
            });
        }
    }
}
