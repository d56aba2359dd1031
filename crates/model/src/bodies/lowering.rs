//! What the lowering knows while it reads, and how it names what it finds.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use chetaev_symbolic::syntax::names;
use chetaev_symbolic::Expr;

use super::algebra::{Algebra, Turn, Vector};
use super::objects::KeptReaction;
use super::sections::{table, text, word, Written};
use super::shapes::{Shape, Sizes};
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;

/// A frame by its number; 0 is the ground.
pub(crate) type FrameId = usize;

/// The ground.
pub(crate) const GROUND: FrameId = 0;

/// Expressions of at most so many nodes need no name of their own.
const SHORT: usize = 3;

/// How a frame stands against the one before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// It is the ground.
    Ground,
    /// Its origin is moved by a vector.
    Shift(Vector),
    /// It is turned.
    Turn(Turn),
}

/// A frame: one elementary step from another.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) parent: FrameId,
    pub(crate) step: Step,
    /// How what is computed in it is called.
    pub(crate) name: String,
    /// The object it comes from.
    pub(crate) place: Place,
    /// Whether planes of contacts may lie in it, so that it stays a frame of its own.
    pub(crate) is_kept: bool,
}

/// A body as it is stated, and where it is placed.
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) place: Place,
    pub(crate) mass: Option<Expr>,
    /// The centre of mass in its own axes.
    pub(crate) center: Vector,
    /// About the centre of mass, in its own axes.
    pub(crate) inertia: Option<[Vector; 3]>,
    pub(crate) shape: Option<(&'static Shape, Sizes)>,
    /// Whether its inertia follows from its shape.
    pub(crate) is_homogeneous: bool,
}

/// The vertical: a coordinate axis of the ground, and the normal of planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Up {
    pub(crate) axis: usize,
    pub(crate) is_backward: bool,
}

/// Angular velocity and velocity of the origin of a frame against another one, in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    pub(crate) omega: Vector,
    pub(crate) velocity: Vector,
}

/// Everything known while bodies are lowered.
pub(crate) struct Lowering<'r> {
    pub(crate) root: &'r Table,
    pub(crate) algebra: Algebra,
    pub(crate) problems: Vec<Diagnostic>,
    pub(crate) written: Written,
    /// Whether units are stated anywhere; if so, all that is written has its unit.
    pub(crate) has_units: bool,
    /// Names of parameters and sizes, the user's own and those written.
    pub(crate) parameters: BTreeSet<String>,
    /// All names that are taken.
    pub(crate) taken: BTreeSet<String>,
    pub(crate) frames: Vec<Frame>,
    /// Frames by the name of their object.
    pub(crate) placed: BTreeMap<String, FrameId>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) up: Up,
    /// Contacts and joints that touch or close for some values of the parameters only, with their words.
    pub(crate) touching: Vec<(Place, String)>,
    pub(crate) closing: Vec<(Place, String)>,
    /// Springs, as terms of the potential energy.
    pub(crate) springs: Vec<String>,
    /// Reactions of the constraints of contacts and closing joints.
    pub(crate) reactions: Vec<KeptReaction<Expr>>,
    /// Forces and torques that are stated at points of bodies.
    pub(crate) loads: Vec<KeptReaction<Expr>>,
    /// Numbers that were read, by their names and places.
    pub(crate) read: HashMap<(String, Place), Expr>,
    named: HashMap<Expr, Expr>,
    assumed: BTreeSet<String>,
    pub(crate) rates: HashMap<(FrameId, FrameId), Rates>,
    pub(crate) axes: HashMap<(FrameId, FrameId), [Vector; 3]>,
    pub(crate) positions: HashMap<(FrameId, FrameId), Vector>,
}

/// The sections in which a user declares names.
const DECLARING: &[&str] = &[
    "sizes",
    "coordinates",
    "parameters",
    "controls",
    "define",
    "masses",
    "quasi_velocities",
    "sensors",
];

impl<'r> Lowering<'r> {
    pub(crate) fn new(root: &'r Table, place: Place) -> Self {
        let ground = Frame {
            parent: GROUND,
            step: Step::Ground,
            name: "ground".to_owned(),
            place,
            is_kept: true,
        };
        let mut lowering = Lowering {
            root,
            algebra: Algebra::default(),
            problems: Vec::new(),
            written: Written::default(),
            has_units: false,
            parameters: BTreeSet::new(),
            taken: BTreeSet::new(),
            frames: vec![ground],
            placed: BTreeMap::from([("ground".to_owned(), GROUND)]),
            bodies: Vec::new(),
            up: Up {
                axis: 2,
                is_backward: false,
            },
            touching: Vec::new(),
            closing: Vec::new(),
            springs: Vec::new(),
            reactions: Vec::new(),
            loads: Vec::new(),
            read: HashMap::new(),
            named: HashMap::new(),
            assumed: BTreeSet::new(),
            rates: HashMap::new(),
            axes: HashMap::new(),
            positions: HashMap::new(),
        };
        for section in DECLARING {
            lowering.declared(section);
        }
        lowering
    }

    /// Notes the names that the user declares in a section.
    fn declared(&mut self, section: &str) {
        let found = match self.root.get(section).map(|raw| &raw.kind) {
            Some(Kind::Table(table)) => table.entries.iter().map(|(key, _)| key).collect(),
            Some(Kind::Array(items)) => items
                .iter()
                .filter_map(Raw::expression)
                .collect::<Vec<&Text>>(),
            _ => Vec::new(),
        };
        for name in found {
            let name = names::normalized(&name.content);
            match section {
                "parameters" | "sizes" => drop(self.parameters.insert(name.clone())),
                _ => drop(self.algebra.varying.insert(name.clone())),
            }
            self.taken.insert(name);
        }
    }

    pub(crate) fn error(&mut self, code: &'static str, place: Place, message: impl Into<String>) {
        self.problems.push(Diagnostic::error(code, place, message));
    }

    // ---- what is written

    /// Gives an expression a name by a definition, unless it is short or has one.
    pub(crate) fn name(&mut self, wanted: &str, e: Expr, place: Place) -> Expr {
        if self.algebra.graph.reachable(&[e]).len() <= SHORT {
            return e;
        }
        if let Some(known) = self.named.get(&e) {
            return *known;
        }
        let value = text(self.algebra.graph.text(e), place);
        let symbol = self.define(wanted, value, !self.algebra.is_constant(e));
        self.named.insert(e, symbol);
        symbol
    }

    /// The same expressions in which what is written more than once has a name, so that no text is longer than what it says.
    pub(crate) fn share(&mut self, wanted: &str, roots: &[Expr], place: Place) -> Vec<Expr> {
        const WORTH_A_NAME: u64 = 8;
        let order = self.algebra.graph.reachable(roots);
        let mut uses: HashMap<Expr, usize> = HashMap::new();
        for e in &order {
            let node = self.algebra.graph.node(*e);
            node.for_each_child(|child| *uses.entry(child).or_default() += 1);
        }
        let mut named: Vec<(Expr, Expr)> = Vec::new();
        for e in order {
            if uses.get(&e).is_none_or(|count| *count < 2) {
                continue;
            }
            let value = self.algebra.graph.substitute(e, &named);
            if self.algebra.graph.tree_size(value) >= WORTH_A_NAME {
                named.push((e, self.name(wanted, value, place)));
            }
        }
        self.algebra.graph.substitute_all(roots, &named)
    }

    /// Writes a definition; its name is changed where it is taken.
    pub(crate) fn define(&mut self, wanted: &str, value: Raw, varies: bool) -> Expr {
        let mut name = wanted.to_owned();
        let mut number = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{wanted}_{number}");
            number += 1;
        }
        if varies {
            self.algebra.varying.insert(name.clone());
        }
        let key = word(name.clone(), value.place);
        self.written.define.entries.push((key, value));
        self.algebra.symbol(&name)
    }

    /// Names the components of a vector.
    pub(crate) fn name_vector(&mut self, wanted: &str, v: Vector, place: Place) -> Vector {
        let [x, y, z] = v;
        let mut name = |end, e| self.name(&format!("{wanted}_{end}"), e, place);
        [name("x", x), name("y", y), name("z", z)]
    }

    /// Writes a coordinate.
    pub(crate) fn coordinate(&mut self, name: &Text, unit: &str, about: String) -> Expr {
        let own = names::normalized(&name.content);
        let mut entries = vec![("description", text(about, name.place))];
        if self.has_units {
            entries.push(("unit", text(unit, name.place)));
        }
        let value = table(entries, name.place);
        self.written.coordinates.entries.push((name.clone(), value));
        self.algebra.varying.insert(own.clone());
        self.taken.insert(own.clone());
        self.algebra.symbol(&own)
    }

    /// Writes an assumption.
    pub(crate) fn assume(&mut self, left: Expr, relation: &str, right: Expr, place: Place) {
        let graph = &self.algebra.graph;
        if graph.as_number(graph.sub(left, right)).is_some() {
            return;
        }
        let words = format!("{} {relation} {}", graph.text(left), graph.text(right));
        if self.assumed.insert(words.clone()) {
            self.written.assumptions.push(text(words, place));
        }
    }

    pub(crate) fn assume_positive(&mut self, e: Expr, place: Place) {
        self.assume(e, ">", self.algebra.graph.zero(), place);
    }
}
