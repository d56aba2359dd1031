//! What a description says, whatever its format.

use std::collections::BTreeSet;

use roxmltree::Node;

use crate::numbers::{Rotation, Vector};
use crate::Note;

/// A body; nothing but its name where it has no mass.
#[derive(Clone, Debug, Default)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) mass: f64,
    pub(crate) center: Vector,
    /// xx, yy, zz, xy, xz, yz about the centre of mass.
    pub(crate) inertia: [f64; 6],
    /// The axes of the inertia in those of the body.
    pub(crate) inertia_axes: Option<Rotation>,
    /// The word of a shape, with its sizes.
    pub(crate) shape: Option<Shape>,
}

/// A homogeneous solid.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) word: &'static str,
    /// Keys and values.
    pub(crate) sizes: Vec<(&'static str, String)>,
}

/// What a joint lets move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Fixed,
    Revolute,
    Prismatic,
    Planar,
    Spherical,
    Free,
}

impl Kind {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Kind::Fixed => "fixed",
            Kind::Revolute => "revolute",
            Kind::Prismatic => "prismatic",
            Kind::Planar => "planar",
            Kind::Spherical => "spherical",
            Kind::Free => "free",
        }
    }
}

/// A joint. The axes of the child stand in those of the parent as `rotation` says while the joint is at its zero.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) parent: String,
    pub(crate) child: String,
    pub(crate) at: Vector,
    pub(crate) rotation: Rotation,
    /// The place on the child.
    pub(crate) child_at: Vector,
    pub(crate) axis: Vector,
    pub(crate) limits: Option<[f64; 2]>,
    pub(crate) damping: f64,
    /// Stiffness, and the value at rest.
    pub(crate) spring: Option<[f64; 2]>,
}

impl Joint {
    /// A fixed joint at the origin of its parent.
    pub(crate) fn fixed(name: String, parent: String, child: String) -> Joint {
        Joint {
            name,
            kind: Kind::Fixed,
            parent,
            child,
            at: [0.0; 3],
            rotation: crate::numbers::STILL,
            child_at: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            limits: None,
            damping: 0.0,
            spring: None,
        }
    }
}

/// Two coordinates in a ratio: driven = ratio driving + offset.
#[derive(Clone, Debug)]
pub(crate) struct Gear {
    pub(crate) name: String,
    pub(crate) driving: String,
    pub(crate) driven: String,
    pub(crate) ratio: f64,
    pub(crate) offset: f64,
}

/// A description.
#[derive(Clone, Debug, Default)]
pub(crate) struct Robot {
    pub(crate) name: String,
    /// The format, for the first line.
    pub(crate) format: &'static str,
    /// The acceleration of gravity, where it is stated.
    pub(crate) gravity: Option<f64>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) gears: Vec<Gear>,
    pub(crate) notes: Vec<Note>,
    taken: BTreeSet<String>,
}

/// Names that mean something else in expressions.
const RESERVED: &[&str] = &[
    "t", "g", "pi", "e", "ground", "sin", "cos", "tan", "exp", "log", "ln", "sqrt", "abs", "sign",
    "min", "max", "asin", "acos", "atan", "atan2",
];

impl Robot {
    /// Nothing but a name.
    pub(crate) fn new(name: Option<&str>, format: &'static str) -> Robot {
        Robot {
            name: name.unwrap_or("robot").to_owned(),
            format,
            ..Robot::default()
        }
    }

    pub(crate) fn note(&mut self, node: Node<'_, '_>, message: String) {
        let line = line(node);
        self.notes.push(Note { line, message });
    }

    /// Loads and limits belong to joints with one coordinate; those of others are noted.
    pub(crate) fn add_joint(&mut self, mut joint: Joint, node: Node<'_, '_>) {
        let is_single = matches!(joint.kind, Kind::Revolute | Kind::Prismatic);
        let has_any = joint.damping != 0.0 || joint.spring.is_some() || joint.limits.is_some();
        if has_any && !is_single {
            (joint.damping, joint.spring, joint.limits) = (0.0, None, None);
            let message = format!("damping, stiffness and limits of `{}` are not taken over: it has not one coordinate", joint.name);
            self.note(node, message);
        }
        self.joints.push(joint);
    }

    /// A name that a model may have: letters, digits and underscores, no two alike.
    pub(crate) fn name(&mut self, wished: &str, node: Node<'_, '_>) -> String {
        let letters = wished.chars().map(|c| match c {
            c if c.is_ascii_alphanumeric() => c,
            _ => '_',
        });
        let mut name: String = letters.collect();
        let begins = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic());
        if !begins || RESERVED.contains(&name.as_str()) {
            name = format!("n_{name}");
        }
        let mut own = name.clone();
        let mut number = 2;
        while !self.taken.insert(own.clone()) {
            own = format!("{name}_{number}");
            number += 1;
        }
        if own != wished {
            self.note(node, format!("`{wished}` is called `{own}`"));
        }
        own
    }
}

/// The line of an element.
pub(crate) fn line(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}
