//! From the tree of values to a [`Model`]: names are declared, expressions lowered, everything checked.
//!
//! Every section is read even where an earlier one has errors, so that all problems are reported at once; a value
//! that could not be understood is known as such, and what uses it gives no second diagnostic.

pub(crate) mod advice;
mod characteristics;
mod complete_integral;
mod declare;
mod define;
mod drawing;
mod equations;
mod events;
pub(crate) mod formula;
pub(crate) mod frame;
mod integrals;
mod masses;
mod mechanism;
mod parameters;
mod particles;
mod run;
pub(crate) mod scope;
mod sections;
mod steady;
mod system;
mod twin;
mod unknowns;
mod variation;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use chetaev_symbolic::syntax::{names, Span};
use chetaev_symbolic::Graph;

use crate::bodies::objects::Kept;
use crate::diagnostic::{Diagnostic, Known};
use crate::dimension;
use crate::model::{Control, Coordinate, Definition, Model, ModelText, Parameter};
use crate::raw::{Kind, Raw, Table};
use crate::source::{Place, Sources};
use crate::text::Text;

use formula::Formula;
use scope::{Contents, Named};

/// A parameter or size set from outside: name and value.
#[derive(Clone, Debug)]
pub(crate) struct Override {
    pub(crate) name: Text,
    pub(crate) value: Text,
    pub(crate) used: bool,
}

/// What the file says about a parameter, before it is given a meaning.
#[derive(Clone, Debug)]
pub(crate) struct Stated {
    pub(crate) value: Option<Text>,
    pub(crate) range: Option<Raw>,
    pub(crate) bindings: chetaev_symbolic::syntax::lower::Bindings,
}

/// Everything known while a model is being read.
pub(crate) struct Resolver {
    pub(crate) graph: Arc<Graph>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    known: Known,
    pub(crate) overrides: Vec<Override>,
    pub(crate) sizes: Vec<(String, i64)>,
    pub(crate) indices: Vec<declare::Index>,
    pub(crate) names: BTreeMap<String, Named>,
    pub(crate) coordinates: Vec<Coordinate>,
    pub(crate) parameters: Vec<Parameter>,
    /// What is stated about each parameter, in the same order.
    pub(crate) stated: Vec<Stated>,
    pub(crate) controls: Vec<Control>,
    /// Definitions and quasi-velocities; both may be used by name.
    pub(crate) defines: Vec<define::Define>,
    /// Named masses, whose values and rates are among the definitions.
    pub(crate) masses: Vec<masses::MassStated>,
    /// The frame, whose quasi-velocities are among the definitions.
    pub(crate) frame: Option<frame::FrameStated>,
    /// Names of the parameters of the user's characteristics.
    pub(crate) characteristic_parameters: Vec<String>,
    /// Derivatives of definitions that were taken, by number and order.
    pub(crate) contents: RefCell<BTreeMap<(usize, u32), Contents>>,
    /// Every expression with what its dimension should be.
    pub(crate) formulas: Vec<Formula>,
    /// Keys of quantities that have no unit and are not blamed for it: it is stated, but wrong, or their values are angles in degrees.
    pub(crate) without_blame: Vec<Place>,
    /// Names that occur in expressions other than assumptions.
    pub(crate) used: RefCell<BTreeSet<String>>,
    /// Unknowns of the equations that are being read.
    pub(crate) unknowns: Vec<String>,
    /// Symbols in LaTeX by the names for which they are stated.
    pub(crate) symbols: BTreeMap<String, String>,
    /// The models of twins by the place of the text that names them; none where one could not be read.
    pub(crate) others: BTreeMap<Place, Option<Model>>,
}

/// The keys of the file, in the order in which the documentation explains them.
const SECTIONS: &[&str] = &[
    "name",
    "description",
    "source",
    "history",
    "include",
    "sizes",
    "indices",
    "coordinates",
    "parameters",
    "assumptions",
    "define",
    "lagrangian",
    "masses",
    "particles",
    "forces",
    "reactive_forces",
    "constraints",
    "velocities",
    "quasi_velocities",
    "moving_frame",
    "characteristics",
    "controls",
    "initial",
    "steady",
    "simulation",
    "events",
    "integrals",
    "sensors",
    "variation",
    "complete_integral",
    "equations",
    "twin",
    "search",
    "drawing",
    "expect",
];

/// Gives a meaning to a file. No model where there is an error.
pub(crate) fn resolve(
    root: &Table,
    file: Place,
    sources: Sources,
    text: ModelText,
    overrides: Vec<Override>,
    others: BTreeMap<Place, Option<Model>>,
    kept: Option<Kept>,
) -> (Option<Model>, Vec<Diagnostic>) {
    let mut resolver = Resolver {
        graph: Arc::new(Graph::new()),
        diagnostics: Vec::new(),
        known: Known::default(),
        overrides,
        sizes: Vec::new(),
        indices: Vec::new(),
        names: BTreeMap::new(),
        coordinates: Vec::new(),
        parameters: Vec::new(),
        stated: Vec::new(),
        controls: Vec::new(),
        defines: Vec::new(),
        masses: Vec::new(),
        frame: None,
        characteristic_parameters: Vec::new(),
        contents: RefCell::default(),
        formulas: Vec::new(),
        without_blame: Vec::new(),
        used: RefCell::default(),
        unknowns: Vec::new(),
        symbols: BTreeMap::new(),
        others,
    };
    resolver.known_keys(root, SECTIONS, "of a model file");
    let model = resolver.model(root, file, sources, text, kept);
    let failed = resolver
        .diagnostics
        .iter()
        .any(|d| d.severity == chetaev_symbolic::syntax::Severity::Error);
    (model.filter(|_| !failed), resolver.diagnostics)
}

impl Resolver {
    fn model(
        &mut self,
        root: &Table,
        file: Place,
        sources: Sources,
        text: ModelText,
        kept: Option<Kept>,
    ) -> Option<Model> {
        self.names_and_values(root, file, kept.as_ref());
        let assumptions = self.assumptions(root);
        self.check_assumptions(&assumptions);
        let particles = self.particles(root);
        let lagrangian = self.lagrangian(root, file, &particles);
        let (forces, rayleigh) = self.forces(root);
        let reactive_forces = self.reactive_forces(root);
        let constraints = self.constraints(root);
        let characteristics = self.characteristics(root, &constraints);
        let independent = self.independent_velocities(root);
        let initial = self.initial(root, &constraints);
        let steady = self.steady(root);
        let simulation = self.simulation(root);
        let events = self.events(root, &constraints);
        let stated = self.integrals(root);
        let sensors = self.sensors(&constraints);
        let (search, search_degree) = self.search(root);
        let variations = self.variations(root);
        let complete_integral = self.complete_integral(root);
        let equations = self.stated_equations(root, &constraints);
        let twins = self.twins(root);
        let drawing = self.drawing(root);
        let expect = self.expect(root);
        let has_units = dimension::check(self);
        let name = self
            .optional_text(root, "name")
            .map_or_else(|| name_of_path(&text.path), |text| text.content);
        let description = self.prose(root, "description");
        let history = self.prose(root, "history");
        let source = self.references(root);
        let unused = self.unused(&twins);
        let mechanism = kept.and_then(|kept| self.mechanism(&kept));
        let lagrangian = lagrangian?;
        let masses = self.masses();
        Some(Model {
            time: self.graph.symbol("t", 0),
            graph: Arc::clone(&self.graph),
            name,
            description,
            source,
            history,
            coordinates: std::mem::take(&mut self.coordinates),
            parameters: std::mem::take(&mut self.parameters),
            controls: std::mem::take(&mut self.controls),
            assumptions,
            defines: self.definitions(false),
            masses,
            inertia_by_masses: lagrangian.by_masses,
            particles,
            kinetic_from_particles: lagrangian.from_particles,
            mechanism,
            kinetic: lagrangian.kinetic,
            potential: lagrangian.potential,
            lagrangian: lagrangian.total,
            forces,
            reactive_forces,
            rayleigh,
            constraints,
            independent,
            quasi_velocities: self.definitions(true),
            frame: self.frame.take().and_then(frame::FrameStated::solved),
            characteristics,
            initial,
            steady,
            simulation,
            events,
            integrals: stated.integrals,
            integral_forms: stated.forms,
            sensors,
            variations,
            complete_integral,
            integral_conditions: stated.conditions,
            equations,
            twins,
            search,
            search_degree,
            drawing,
            expect,
            sizes: std::mem::take(&mut self.sizes),
            unused,
            has_units,
            symbols: std::mem::take(&mut self.symbols),
            sources,
            text,
        })
    }

    /// Parameters and definitions that occur nowhere.
    fn unused(&self, twins: &[crate::model::Twin]) -> Vec<Diagnostic> {
        let used = self.used.borrow();
        let of_twins = |name: &str| {
            twins
                .iter()
                .any(|t| t.symbols.iter().any(|(n, _)| n == name))
        };
        let is_definition = |number: usize| {
            matches!(
                self.defines.get(number).map(|d| d.kind),
                Some(define::DefineKind::Definition)
            )
        };
        let mut found: Vec<Diagnostic> = Vec::new();
        for (name, named) in &self.names {
            let what = match named.kind {
                scope::NamedKind::Parameter => "the parameter",
                scope::NamedKind::Define(number) if is_definition(number) => "the definition",
                _ => continue,
            };
            if used.contains(name) || of_twins(name) {
                continue;
            }
            let message = format!("{what} `{name}` occurs nowhere");
            found.push(
                Diagnostic::warning("unused", named.place, message)
                    .hint("leave it out, or see whether a formula lacks it"),
            );
        }
        found
    }

    /// Declares every name and gives it its value.
    fn names_and_values(&mut self, root: &Table, file: Place, kept: Option<&Kept>) {
        self.declare_sizes(root);
        self.declare_coordinates(root, file);
        self.declare_controls(root);
        self.declare_parameters(root);
        self.declare_masses(root);
        self.declare_defines(root);
        self.declare_objects(kept);
        self.declare_frame(root);
        self.declare_characteristics(root);
        self.resolve_parameters();
        self.resolve_defines();
        self.resolve_masses();
        self.resolve_controls(root);
        self.unused_overrides();
    }

    /// Definitions in the order of their use, or quasi-velocities in the order of the file.
    fn definitions(&self, quasi: bool) -> Vec<Definition> {
        let mut chosen: Vec<&define::Define> = self
            .defines
            .iter()
            .filter(|define| define.is_quasi_velocity() == quasi)
            .filter(|define| {
                ![
                    define::DefineKind::MassRate,
                    define::DefineKind::Object,
                    define::DefineKind::Sensor,
                ]
                .contains(&define.kind)
            })
            .collect();
        chosen.sort_by_key(|define| if quasi { 0 } else { define.rank });
        chosen
            .into_iter()
            .filter_map(define::Define::definition)
            .collect()
    }

    /// A text for people; empty where there is none.
    pub(crate) fn prose(&mut self, table: &Table, key: &str) -> String {
        self.optional_text(table, key)
            .map_or_else(String::new, |text| text.content.trim().to_owned())
    }

    pub(crate) fn push(&mut self, diagnostic: Diagnostic) {
        if self.known.is_new(&diagnostic) {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Reports every key that is none of those known, with the nearest one.
    pub(crate) fn known_keys(&mut self, table: &Table, known: &[&str], of: &str) {
        for (key, _) in &table.entries {
            if known.contains(&key.content.as_str()) {
                continue;
            }
            let mut diagnostic = Diagnostic::error(
                "unknown-key",
                key.place,
                format!("`{}` is no key {of}", key.content),
            )
            .label("not known");
            let near = if self.diagnostics.len() < GUESSED {
                near_key(&key.content, known)
            } else {
                None
            };
            diagnostic = match near {
                Some(near) => diagnostic
                    .hint(format!("did you mean `{near}`?"))
                    .suggest(key.place, near),
                None => diagnostic.hint(format!("known keys: {}", known.join(", "))),
            };
            self.push(diagnostic);
        }
    }

    /// The table under a key of the file; a value of another kind is reported.
    pub(crate) fn section<'t>(&mut self, root: &'t Table, key: &str) -> Option<&'t Table> {
        let raw = root.get(key)?;
        let table = raw.table();
        if table.is_none() {
            self.wrong_kind(raw, &format!("`{key}`"), "a table");
        }
        table
    }

    pub(crate) fn wrong_kind(&mut self, raw: &Raw, what: &str, wanted: &str) {
        let message = format!("{what} must be {wanted}, not {}", raw.kind.word());
        self.push(Diagnostic::error("wrong-kind", raw.place, message));
    }

    pub(crate) fn optional_text(&mut self, table: &Table, key: &str) -> Option<Text> {
        let raw = table.get(key)?;
        match &raw.kind {
            Kind::Text(text) => {
                self.control_characters(text);
                Some(text.clone())
            }
            _ => {
                self.wrong_kind(raw, &format!("`{key}`"), "a text");
                None
            }
        }
    }

    /// Refuses what terminals and browsers would obey instead of showing.
    fn control_characters(&mut self, text: &Text) {
        let obeyed = |c: &char| c.is_control() && !matches!(c, '\n' | '\t' | '\r');
        if let Some(sign) = text.content.chars().find(obeyed) {
            let message = format!(
                "the text contains the control character U+{:04X}",
                sign as u32
            );
            let diagnostic = Diagnostic::error("control-character", text.place, message);
            self.push(
                diagnostic
                    .hint("leave it out: terminals obey such characters instead of showing them"),
            );
        }
    }

    pub(crate) fn optional_truth(&mut self, table: &Table, key: &str) -> Option<bool> {
        let raw = table.get(key)?;
        match raw.kind {
            Kind::Truth(truth) => Some(truth),
            _ => {
                self.wrong_kind(raw, &format!("`{key}`"), "true or false");
                None
            }
        }
    }

    fn references(&mut self, root: &Table) -> Vec<String> {
        let Some(raw) = root.get("source") else {
            return Vec::new();
        };
        match &raw.kind {
            Kind::Text(text) => {
                self.control_characters(text);
                vec![text.content.trim().to_owned()]
            }
            Kind::Array(items) => {
                let mut list = Vec::new();
                for item in items {
                    match &item.kind {
                        Kind::Text(text) => {
                            self.control_characters(text);
                            list.push(text.content.trim().to_owned());
                        }
                        _ => self.wrong_kind(item, "a reference", "a text"),
                    }
                }
                list
            }
            _ => {
                self.wrong_kind(raw, "`source`", "a text or an array of texts");
                Vec::new()
            }
        }
    }
}

/// For the names and keys after so many problems nothing is guessed: nobody reads that many guesses, and each takes time in
/// proportion to what there is to choose from.
pub(crate) const GUESSED: usize = 200;

/// The nearest key, also where the words or the number of a noun differ.
fn near_key<'k>(key: &str, known: &[&'k str]) -> Option<&'k str> {
    const OTHER_WORDS: &[(&str, &str)] = &[
        ("constants", "parameters"),
        ("definitions", "define"),
        ("defines", "define"),
        ("let", "define"),
        ("kinetic", "T"),
        ("potential", "V"),
        ("dissipation", "rayleigh"),
        ("quasi-velocities", "quasi_velocities"),
        ("points", "particles"),
        ("vectors", "fields"),
        ("vector_fields", "fields"),
        ("r", "position"),
        ("m", "mass"),
        ("F", "force"),
        ("u", "relative_velocity"),
        ("w", "absolute_velocity"),
        ("R", "force"),
        ("law", "rate"),
        ("start", "initial"),
        ("reactive", "reactive_forces"),
        ("X_0", "drift"),
        ("inputs", "controls"),
        ("initial_conditions", "initial"),
        ("solver", "simulation"),
        ("first_integrals", "integrals"),
        ("event", "events"),
        ("expression", "when"),
        ("crossing", "direction"),
        ("variations", "variation"),
        ("animation", "drawing"),
        ("title", "name"),
        ("rtol", "tolerance"),
        ("atol", "absolute_tolerance"),
        ("t_final", "t_end"),
        ("duration", "t_end"),
        ("expected", "expect"),
        ("qs", "coordinates"),
    ];
    let known_word = |word: &'static str| known.iter().copied().find(|own| *own == word);
    names::closest(key, known.iter().copied())
        .or_else(|| {
            OTHER_WORDS
                .iter()
                .find(|(other, _)| *other == key)
                .and_then(|(_, word)| known_word(word))
        })
        .or_else(|| {
            known
                .iter()
                .copied()
                .find(|own| own.len() > 2 && (key.starts_with(own) || own.starts_with(key)))
        })
}

/// A name for a model that states none: the folder, or the file where it is not called `model.toml`.
#[must_use]
pub fn name_of_path(path: &str) -> String {
    let mut parts = path.rsplit(['/', '\\']).filter(|part| !part.is_empty());
    let file = parts.next().unwrap_or("model");
    let stem = file.strip_suffix(".toml").unwrap_or(file);
    match parts.next() {
        Some(folder) if stem == "model" && folder != "." && folder != ".." => folder.to_owned(),
        _ => stem.to_owned(),
    }
}

/// The first byte of a file: where something is missing, it is missing there.
pub(crate) fn start_of(file: Place) -> Place {
    Place {
        source: file.source,
        span: Span::empty(0),
    }
}
