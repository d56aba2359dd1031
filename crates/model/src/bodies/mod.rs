//! Bodies, joints and contacts, lowered to the ordinary sections of a model.
//!
//! `[frames]`, `[bodies]`, `[joints]` and `[contacts]` of the tree of a file become coordinates, parameters, definitions, energies,
//! constraints and a drawing, each at the place of the object that it comes from. What follows (names, dimensions, derivations, the
//! record) reads these sections as if a person had written them.
//!
//! `tree` reads what hangs on what, `placing` puts it in its place, `kinematics` goes from frame to frame, `solids` has the
//! energies, `touching`, `closing`, `couplings` and `ropes` the constraints, `forces` what acts, `sensing` what is measured, `look` the drawing; `ball_contacts` and
//! `tangency` those on surfaces that are no planes, which `grounds` reads; `shapes`, `joints`, `contacts` and `surfaces` are registries, of which `kinds` tells forms and menus.

mod algebra;
mod ball_contacts;
mod closing;
mod contacts;
mod couplings;
mod families;
mod figures;
mod forces;
mod grounds;
mod joints;
mod keeping;
pub mod kinds;
mod kinematics;
mod look;
mod lowering;
pub(crate) mod objects;
mod placing;
mod pruning;
mod reading;
mod ropes;
mod sections;
mod sensors;
mod shapes;
mod solids;
mod springs;
mod surfaces;
mod tangency;
mod touching;
mod tree;

use std::collections::BTreeSet;

use chetaev_symbolic::Expr;

use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw, Table};
use crate::resolve::Override;
use crate::source::Place;
use crate::units::quantity;
use lowering::{Lowering, Up};
use objects::Kept;
use reading::Slot;
use sensors::Whole;

/// The sections that are lowered.
const SECTIONS: &[&str] = &["frames", "bodies", "joints", "contacts"];

/// What is to be said differently of objects than of what they became, by place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Conditions {
    /// Numbers of objects: a body may have moments about which it never turns.
    numbers: BTreeSet<Place>,
    touching: Vec<(Place, String)>,
    closing: Vec<(Place, String)>,
    /// The objects themselves.
    pub(crate) kept: Option<Kept>,
}

impl Conditions {
    /// Leaves out that a number of an object occurs nowhere.
    pub(crate) fn excuse(&self, unused: &mut Vec<Diagnostic>) {
        unused.retain(|diagnostic| !self.numbers.contains(&diagnostic.place));
    }

    /// Says of a violated assumption of the lowering what it means for the object it comes from.
    pub(crate) fn explain(&self, found: &mut [Diagnostic]) {
        for diagnostic in found.iter_mut().filter(|d| d.code == "assumption-violated") {
            let words = |all: &[(Place, String)]| {
                let mut own = all.iter().filter(|(place, _)| *place == diagnostic.place);
                own.next().map(|(_, words)| words.clone())
            };
            if let Some(words) = words(&self.touching) {
                diagnostic.code = "not-touching";
                diagnostic.message = format!(
                    "{words} does not touch its plane for the values of the parameters: {}",
                    diagnostic.message
                );
            } else if let Some(words) = words(&self.closing) {
                diagnostic.code = "cannot-close";
                diagnostic.message = format!(
                    "{words} cannot close the chain for the values of the parameters: {}",
                    diagnostic.message
                );
            }
        }
    }
}

/// Lowers the bodies of a tree; a tree without any stays as it is.
pub(crate) fn lower(
    root: &mut Table,
    file: Place,
    overrides: &[Override],
    problems: &mut Vec<Diagnostic>,
) -> Conditions {
    if !SECTIONS.iter().any(|section| root.get(section).is_some()) {
        return Conditions::default();
    }
    families::expand(root, SECTIONS, overrides, problems);
    families::expand(root, &["particles", "sensors"], overrides, problems);
    if states(root, "forces", forces::acts_on_body) {
        families::expand(root, &["forces"], overrides, problems);
    }
    let own = std::mem::take(root);
    let place = SECTIONS
        .iter()
        .find_map(|section| own.get(section).map(|raw| raw.place))
        .unwrap_or(file);
    let mut lowering = Lowering::new(&own, place);
    let mut kept = lowering.run();
    let Lowering {
        mut written,
        problems: found,
        touching,
        closing,
        ..
    } = lowering;
    problems.extend(found);
    let numbers = written.parameters.entries.iter();
    let numbers = numbers.map(|(key, _)| key.place).collect();
    pruning::prune(&mut written, &own, &mut kept);
    *root = own;
    for section in SECTIONS.iter().chain(&["gravity"]) {
        root.remove(section);
    }
    leave_out(root, "forces", forces::acts_on_body);
    leave_out(root, "sensors", sensors::is_ready);
    written.merge(root, place);
    Conditions {
        numbers,
        touching,
        closing,
        kept: Some(kept),
    }
}

impl Lowering<'_> {
    fn run(&mut self) -> Kept {
        self.has_units = states_units(self.root);
        let gravity = self.gravity();
        for object in self.objects("bodies", "body") {
            match object.name() {
                "ground" => self.error(
                    "reserved-name",
                    object.place,
                    "`ground` is the frame at rest",
                ),
                _ => self.read_body(&object),
            }
        }
        let tree = self.read_tree();
        let built = self.place_all(&tree);
        let before = self.written.potential.len();
        for number in 0..self.bodies.len() {
            self.energies(number, gravity.acceleration);
        }
        let is_heavy = self.written.potential.len() > before;
        let mut weight = gravity.acceleration;
        if let Some(usual) = gravity.usual {
            if is_heavy || pruning::is_named(self.root, &usual.0.name) {
                self.number(&usual.0, &usual.1);
            } else {
                // It changes no motion, and is no parameter of it; reactions feel it.
                weight = Some(self.algebra.ratio(981, 100));
            }
        }
        self.name_motions();
        self.touch_all(&tree, &built);
        self.close_all(&tree);
        for object in &tree.couplings {
            self.couple(object);
        }
        self.load_all();
        self.sense_all(Whole {
            tree: &tree,
            built: &built,
            gravity: weight,
        });
        self.draw_all(&tree, &built);
        self.keep_all(&tree, &built, weight)
    }

    /// Angular velocity, velocity, axes and position of every body and frame have names, which the user may write.
    fn name_motions(&mut self) {
        let placed: Vec<(String, usize, Place)> = self
            .placed
            .iter()
            .filter(|(name, _)| *name != "ground")
            .map(|(name, frame)| (name.clone(), *frame, self.frames[*frame].place))
            .collect();
        for (name, frame, place) in placed {
            let rates = self.rates(lowering::GROUND, frame);
            let [x, y, z] = self.axes(lowering::GROUND, frame);
            let position = self.position(lowering::GROUND, frame);
            let all = [
                ("omega", rates.omega),
                ("v", rates.velocity),
                ("p", position),
                ("X", x),
                ("Y", y),
                ("Z", z),
            ];
            for (what, vector) in all {
                for (e, axis) in vector.into_iter().zip(["x", "y", "z"]) {
                    self.alias(&format!("{name}_{what}_{axis}"), e, place);
                }
            }
        }
    }

    /// A name for what is short or has another name; it stays only where somebody writes it.
    fn alias(&mut self, name: &str, e: Expr, place: Place) {
        if !self.taken.contains(name) {
            let value = sections::text(self.algebra.graph.text(e), place);
            self.define(name, value, !self.algebra.is_constant(e));
        }
    }

    /// `gravity`: an acceleration, a table with `value` and `up`, or nothing for 9.81 m/s².
    fn gravity(&mut self) -> Gravity {
        let place = self.frames[0].place;
        let slot = Slot {
            name: "g".to_owned(),
            unit: "m/s^2",
            about: "gravity".to_owned(),
        };
        let raw = self.root.get("gravity");
        let mut value = raw;
        if let Some(Kind::Table(table)) = raw.map(|raw| &raw.kind) {
            if let Some(Kind::Text(text)) = table.get("up").map(|raw| &raw.kind) {
                if let Some((axis, is_backward)) = self.axis_of(text) {
                    self.up = Up { axis, is_backward };
                }
            }
            value = table.get("value");
        }
        if let Some(value) = value {
            let read = self.number(&slot, value);
            let acceleration = read.filter(|g| !self.algebra.graph.is_zero(*g));
            return Gravity {
                acceleration,
                usual: None,
            };
        }
        let acceleration = Some(self.algebra.symbol("g"));
        let usual = Raw {
            place,
            kind: Kind::Number(sections::word("9.81", place)),
        };
        let usual = (!self.taken.contains("g")).then_some((slot, usual));
        Gravity {
            acceleration,
            usual,
        }
    }
}

/// The acceleration of gravity, and its usual value where the user gives none.
struct Gravity {
    acceleration: Option<Expr>,
    usual: Option<(Slot, Raw)>,
}

/// Whether a section has an entry of some kind.
fn states(root: &Table, section: &str, is_own: fn(&Raw) -> bool) -> bool {
    let table = root.get(section).and_then(Raw::table);
    table.is_some_and(|table| table.entries.iter().any(|(_, raw)| is_own(raw)))
}

/// Leaves out the entries of a section that were lowered.
fn leave_out(root: &mut Table, section: &str, is_own: fn(&Raw) -> bool) {
    if let Some(Kind::Table(table)) = root.get_mut(section).map(|raw| &mut raw.kind) {
        table.entries.retain(|(_, raw)| !is_own(raw));
    }
}

/// Whether a unit is stated anywhere.
fn states_units(root: &Table) -> bool {
    let mut open: Vec<(bool, &Raw)> = Vec::new();
    for (key, raw) in &root.entries {
        match key.content.as_str() {
            "coordinates" => {
                if let Some(table) = raw.table() {
                    if table
                        .entries
                        .iter()
                        .any(|(_, raw)| raw.expression().is_some())
                    {
                        return true;
                    }
                }
                open.push((false, raw));
            }
            "parameters" | "controls" | "define" | "masses" => open.push((false, raw)),
            "gravity" => open.push((true, raw)),
            section if SECTIONS.contains(&section) => open.push((true, raw)),
            "forces" => {
                let own = raw.table().into_iter().flat_map(|own| &own.entries);
                open.extend(
                    own.filter(|(_, raw)| forces::acts_on_body(raw))
                        .map(|(_, raw)| (true, raw)),
                );
            }
            _ => {}
        }
    }
    while let Some((is_object, raw)) = open.pop() {
        match &raw.kind {
            Kind::Text(text) if is_object && quantity(&text.content).is_some() => return true,
            Kind::Table(table) if table.get("unit").is_some() => return true,
            Kind::Table(table) => {
                let own = table.entries.iter();
                // In a formula of a shape `2 s` is no time.
                let own = own.filter(|(key, _)| !grounds::FORMULAS.contains(&key.content.as_str()));
                open.extend(own.map(|(_, raw)| (is_object, raw)))
            }
            Kind::Array(items) => open.extend(items.iter().map(|raw| (is_object, raw))),
            _ => {}
        }
    }
    false
}
