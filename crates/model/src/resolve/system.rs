//! What makes the system: Lagrangian, forces, constraints, velocities, assumptions.

use std::rc::Rc;

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::{parse_equation, parse_relation, Parsed};
use chetaev_symbolic::{Expr, Symbol};

use super::declare::{all_bindings, Instance};
use super::formula::{Expected, Formula};
use super::scope::Context;
use super::{start_of, Resolver};
use crate::diagnostic::Diagnostic;
use crate::model::{Assumption, Constraint, Force, Particle};
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;

/// The Lagrangian with its parts.
pub(crate) struct Lagrangian {
    pub(crate) kinetic: Option<Expr>,
    pub(crate) potential: Option<Expr>,
    pub(crate) total: Expr,
    pub(crate) from_particles: bool,
    /// T, or L where T is not stated, with named masses as symbols.
    pub(crate) by_masses: Option<Expr>,
}

impl Lagrangian {
    /// L stated by itself.
    fn whole(total: Expr, by_masses: Option<Expr>) -> Self {
        Lagrangian {
            kinetic: None,
            potential: None,
            total,
            from_particles: false,
            by_masses,
        }
    }
}

/// Derivatives of constraints beyond this order are refused.
const MOST_LIFTED: u64 = 8;

impl Resolver {
    // ---- the Lagrangian

    /// As it is stated; the kinetic energy that a model does not state is that of its particles.
    pub(crate) fn lagrangian(
        &mut self,
        root: &Table,
        file: Place,
        particles: &[Particle],
    ) -> Option<Lagrangian> {
        let has_particles = root
            .get("particles")
            .and_then(Raw::table)
            .is_some_and(|table| !table.entries.is_empty());
        let Some(raw) = root.get("lagrangian") else {
            if has_particles {
                return Some(self.of_particles(particles, None));
            }
            let message = "the model has no Lagrangian";
            let diagnostic = Diagnostic::error("missing-section", start_of(file), message);
            self.push(diagnostic.hint(
                "add [lagrangian] with `T` and `V`, or with `L`; or state [particles] with `mass` and `position`",
            ));
            return None;
        };
        if raw.expression().is_some() {
            let total = self.energy(raw, "the Lagrangian")?;
            let by_masses = self.by_masses(raw, Context::state("the Lagrangian"));
            return Some(Lagrangian::whole(total, by_masses));
        }
        let Some(table) = raw.table() else {
            self.wrong_kind(
                raw,
                "`lagrangian`",
                "a table with `T` and `V` or `L`, or the expression of L",
            );
            return None;
        };
        self.stated_lagrangian(table, raw, has_particles.then_some(particles))
    }

    /// By `T` and `V`, by `L`, or by `V` and the particles.
    fn stated_lagrangian(
        &mut self,
        table: &Table,
        raw: &Raw,
        particles: Option<&[Particle]>,
    ) -> Option<Lagrangian> {
        self.known_keys(table, &["T", "V", "L"], "of [lagrangian]");
        let of = |resolver: &mut Self, key: &str, what| {
            table.get(key).map(|raw| resolver.energy(raw, what))
        };
        let kinetic = of(self, "T", "the kinetic energy");
        let potential = of(self, "V", "the potential energy");
        let whole = of(self, "L", "the Lagrangian");
        if let (Some(raw), true) = (table.get("L"), kinetic.is_some() || potential.is_some()) {
            self.push(Diagnostic::error(
                "stated-twice",
                raw.place,
                "the Lagrangian is stated by `T` and `V`, or by `L`, not by both",
            ));
            return None;
        }
        let inertia = table.get("T").or_else(|| table.get("L"));
        let by_masses =
            inertia.and_then(|raw| self.by_masses(raw, Context::state("the kinetic energy")));
        match (whole, kinetic, potential, particles) {
            (Some(whole), ..) => Some(Lagrangian::whole(whole?, by_masses)),
            (None, None, None, None) => {
                self.push(
                    Diagnostic::error("missing-section", raw.place, "[lagrangian] is empty")
                        .hint("state `T` and `V`, or `L`"),
                );
                None
            }
            (None, None, None, Some(particles)) => Some(self.of_particles(particles, None)),
            (None, None, Some(potential), Some(particles)) => {
                Some(self.of_particles(particles, Some(potential?)))
            }
            (None, kinetic, potential, _) => {
                let (kinetic, potential) = (or_none(kinetic)?, or_none(potential)?);
                let zero = self.graph.zero();
                let total = self
                    .graph
                    .sub(kinetic.unwrap_or(zero), potential.unwrap_or(zero));
                Some(Lagrangian {
                    kinetic,
                    potential,
                    total,
                    from_particles: false,
                    by_masses,
                })
            }
        }
    }

    fn of_particles(&self, particles: &[Particle], potential: Option<Expr>) -> Lagrangian {
        let kinetic = self.kinetic_of(particles);
        Lagrangian {
            kinetic: Some(kinetic),
            potential,
            total: potential.map_or(kinetic, |potential| self.graph.sub(kinetic, potential)),
            from_particles: true,
            by_masses: None,
        }
    }

    fn energy(&mut self, raw: &Raw, what: &'static str) -> Option<Expr> {
        let text = self.expression_text(raw, what)?;
        self.expression(&text, &Vec::new(), Context::state(what), Expected::Energy)
    }

    // ---- forces

    pub(crate) fn forces(&mut self, root: &Table) -> (Vec<Force>, Option<Expr>) {
        let mut forces: Vec<Force> = Vec::new();
        let mut rayleigh = None;
        let Some(table) = self.section(root, "forces") else {
            return (forces, rayleigh);
        };
        for (key, raw) in &table.entries {
            if key.content == "rayleigh" && !self.names.contains_key("rayleigh") {
                let Some(text) = self.expression_text(raw, "Rayleigh's function") else {
                    continue;
                };
                rayleigh = self.expression(
                    &text,
                    &Vec::new(),
                    Context::state("Rayleigh's function"),
                    Expected::Power,
                );
                continue;
            }
            if key.content == "power" && !self.names.contains_key("power") {
                self.works(raw, key.place, &mut forces);
                continue;
            }
            self.force(key, raw, "a generalized force", &mut forces);
        }
        forces.sort_by_key(|force| force.coordinate);
        (forces, rayleigh)
    }

    /// `power = [{ force = "F", along = "w" }]`: forces F along displacements that have the rates w. Each adds F ∂w/∂q'.
    fn works(&mut self, raw: &Raw, place: Place, forces: &mut Vec<Force>) {
        let Kind::Array(items) = &raw.kind else {
            let wanted = "an array of tables with `force` and `along`";
            self.wrong_kind(raw, "`power`", wanted);
            return;
        };
        for item in items {
            let Some((force, slopes)) = self.work(item) else {
                continue;
            };
            for (coordinate, slope) in slopes.into_iter().enumerate() {
                if self.graph.is_zero(slope) {
                    continue;
                }
                let value = self.graph.mul(&[force, slope]);
                let own = forces.iter_mut().find(|own| own.coordinate == coordinate);
                match own {
                    Some(own) => {
                        own.value = self.graph.add(&[own.value, value]);
                        own.text = self.graph.text(own.value);
                    }
                    None => forces.push(Force {
                        coordinate,
                        value,
                        text: self.graph.text(value),
                        place,
                    }),
                }
            }
        }
    }

    /// The force, and the slopes of the rate in the velocities.
    fn work(&mut self, item: &Raw) -> Option<(Expr, Vec<Expr>)> {
        let Some(table) = item.table() else {
            self.wrong_kind(
                item,
                "an entry of `power`",
                "a table with `force` and `along`",
            );
            return None;
        };
        self.known_keys(table, &["force", "along"], "of an entry of `power`");
        let mut read = |key: &str, what: &'static str| {
            let Some(raw) = table.get(key) else {
                let message = format!("an entry of `power` needs `{key}`");
                self.push(Diagnostic::error("missing-value", item.place, message));
                return None;
            };
            let text = self.expression_text(raw, what)?;
            let value =
                self.expression(&text, &Vec::new(), Context::state(what), Expected::Anything)?;
            Some((value, text.content))
        };
        let (force, of_force) = read("force", "a force")?;
        let (along, of_along) = read("along", "the rate of a displacement")?;
        // The product has the dimension of a power.
        let product = Text::of_toml(&format!("({of_force}) ({of_along})"), "", item.place);
        self.expression(
            &product,
            &Vec::new(),
            Context::state("a power"),
            Expected::Power,
        )?;
        let velocities: Vec<Symbol> = (self.coordinates.iter())
            .map(|own| self.graph.intern_symbol(&own.name, 1))
            .collect();
        let slopes = self.graph.gradient(along, &velocities);
        Some((force, slopes))
    }

    /// The reactive forces Ψ_s by coordinate; none where the section is left out.
    pub(crate) fn reactive_forces(&mut self, root: &Table) -> Option<Vec<Force>> {
        let table = self.section(root, "reactive_forces")?;
        let mut forces = Vec::new();
        for (key, raw) in &table.entries {
            self.force(key, raw, "a reactive force", &mut forces);
        }
        forces.sort_by_key(|force| force.coordinate);
        Some(forces)
    }

    /// The forces of one key, which names a coordinate or a family of them.
    fn force(&mut self, key: &Text, raw: &Raw, what: &'static str, forces: &mut Vec<Force>) {
        let Some(text) = self.expression_text(raw, what) else {
            return;
        };
        for Instance {
            name,
            order,
            bindings,
        } in self.instances(key, what, &[])
        {
            let Some(coordinate) =
                self.coordinate_named(key, &name, order, "a force acts on a coordinate")
            else {
                break;
            };
            if let Some(earlier) = forces.iter().find(|force| force.coordinate == coordinate) {
                let message = format!("the force on `{name}` is stated twice");
                self.push(
                    Diagnostic::error("stated-twice", key.place, message)
                        .related(earlier.place, "first here"),
                );
                break;
            }
            let expected = Expected::Force(name);
            if let Some(value) = self.expression(&text, &bindings, Context::state(what), expected) {
                forces.push(Force {
                    coordinate,
                    value,
                    text: text.content.clone(),
                    place: key.place,
                });
            }
        }
    }

    /// The number of a coordinate that a key names without primes; else a diagnostic.
    pub(crate) fn coordinate_named(
        &mut self,
        key: &Text,
        name: &str,
        order: u32,
        because: &str,
    ) -> Option<usize> {
        let found = self
            .coordinates
            .iter()
            .position(|coordinate| coordinate.name == name);
        if found.is_some() && order == 0 {
            return found;
        }
        if found.is_some() {
            let message = format!("`{}` has a prime, and {because}", key.content);
            self.push(
                Diagnostic::error("not-a-coordinate", key.place, message).suggest(key.place, name),
            );
        } else {
            self.no_coordinate(key, name, because);
        }
        None
    }

    pub(crate) fn no_coordinate(&mut self, key: &Text, name: &str, because: &str) {
        let message = match self.names.get(name) {
            Some(named) => format!("`{name}` is {}, and {because}", named.kind.word()),
            None => format!("there is no coordinate `{}`, and {because}", key.content),
        };
        let mut diagnostic = Diagnostic::error("not-a-coordinate", key.place, message);
        let known = self
            .coordinates
            .iter()
            .map(|coordinate| coordinate.name.as_str());
        if let Some(near) = chetaev_symbolic::syntax::names::closest(name, known) {
            diagnostic = diagnostic.hint(format!("did you mean `{near}`?"));
        }
        self.push(diagnostic);
    }

    // ---- constraints

    pub(crate) fn constraints(&mut self, root: &Table) -> Vec<Constraint> {
        let mut constraints = Vec::new();
        let Some(raw) = root.get("constraints") else {
            return constraints;
        };
        match &raw.kind {
            Kind::Table(table) => {
                for (key, raw) in &table.entries {
                    self.named_constraint(key, raw, &mut constraints);
                }
            }
            Kind::Array(items) => {
                for (at, item) in items.iter().enumerate() {
                    let name = match &item.kind {
                        Kind::Table(table) => self.optional_text(table, "name"),
                        _ => None,
                    };
                    match name {
                        Some(name) => self.named_constraint(&name, item, &mut constraints),
                        None => {
                            let instance = Instance {
                                name: (at + 1).to_string(),
                                order: 0,
                                bindings: Vec::new(),
                            };
                            self.constraint(item, &[instance], &mut constraints);
                        }
                    }
                }
            }
            _ => self.wrong_kind(
                raw,
                "`constraints`",
                "a table of named equations, or an array of equations",
            ),
        }
        constraints
    }

    fn named_constraint(&mut self, key: &Text, raw: &Raw, constraints: &mut Vec<Constraint>) {
        // A number is a name too: it is what an unnamed constraint is called.
        let numbered =
            !key.content.is_empty() && key.content.bytes().all(|byte| byte.is_ascii_digit());
        let instances = if numbered {
            vec![Instance {
                name: key.content.clone(),
                order: 0,
                bindings: Vec::new(),
            }]
        } else {
            self.own_names(key, "a constraint")
        };
        for instance in &instances {
            if let Some(earlier) = constraints
                .iter()
                .find(|constraint| constraint.name == instance.name)
            {
                let message = format!("two constraints are called `{}`", instance.name);
                self.push(
                    Diagnostic::error("declared-twice", key.place, message)
                        .related(earlier.place, "first here"),
                );
                return;
            }
        }
        self.constraint(raw, &instances, constraints);
    }

    /// Constraints, integrals and particles have their own names: one may be called like a coordinate, or like a function.
    pub(crate) fn own_names(&mut self, key: &Text, what: &str) -> Vec<Instance> {
        let plain = chetaev_symbolic::syntax::names::normalized(&key.content);
        if !plain.is_empty()
            && plain
                .bytes()
                .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        {
            return vec![Instance {
                name: plain,
                order: 0,
                bindings: Vec::new(),
            }];
        }
        let mut instances = self.instances(key, what, &[]);
        if instances.iter().any(|instance| instance.order > 0) {
            let message = format!("`{}` has a prime and cannot name {what}", key.content);
            self.push(Diagnostic::error("bad-name", key.place, message));
            instances.clear();
        }
        instances
    }

    fn constraint(&mut self, raw: &Raw, instances: &[Instance], constraints: &mut Vec<Constraint>) {
        let Some((value, description)) = self.equation_and_description(raw) else {
            return;
        };
        let wanted = match &raw.kind {
            Kind::Table(table) => table.get("lifted"),
            _ => None,
        };
        let lifted = wanted.and_then(|raw| Some((raw.place, self.count(raw, "an order")?)));
        let Kind::Text(text) = &value.kind else {
            self.wrong_kind(value, "a constraint", "a text, the equation `left = right`");
            return;
        };
        let parsed = self.parse(text, parse_equation);
        if parsed.has_errors() {
            return;
        }
        for instance in instances {
            let context = Context::jet("a constraint").without_masses();
            let side = |resolver: &mut Self, at: usize| {
                resolver.lower(text, &parsed, parsed.sides[at], &instance.bindings, context)
            };
            let (left, right) = (side(self, 0), side(self, 1));
            let (Some(left), Some(right)) = (left, right) else {
                continue;
            };
            let f = self.graph.sub(left, right);
            let Some(order) = self.order_of(f) else {
                self.empty_constraint(&instance.name, f, text);
                continue;
            };
            let Some(times) = self.liftings(order, lifted) else {
                continue;
            };
            let [left, right, f] = [left, right, f].map(|e| self.differentiated(e, times));
            let order = order + times;
            self.formulas.push(Formula {
                text: text.clone(),
                parsed: parsed.clone(),
                bindings: instance.bindings.clone(),
                expected: Expected::EqualSides,
                define: None,
            });
            constraints.push(Constraint {
                name: instance.name.clone(),
                f,
                left,
                right,
                order,
                text: text.content.clone(),
                description: description.clone(),
                place: text.place,
            });
        }
    }

    /// How often a constraint is to be differentiated to be of the order wanted.
    fn liftings(&mut self, order: u32, wanted: Option<(Place, u64)>) -> Option<u32> {
        let Some((place, wanted)) = wanted else {
            return Some(0);
        };
        if wanted > MOST_LIFTED {
            let message = format!("constraints are lifted up to order {MOST_LIFTED}");
            self.push(Diagnostic::error("out-of-range", place, message));
            return None;
        }
        match (wanted as u32).checked_sub(order) {
            Some(times) => Some(times),
            None => {
                let message = format!(
                    "the constraint is of order {order} already; `lifted` is the order of its derivative that takes its place, at least {order}"
                );
                self.push(Diagnostic::error("out-of-range", place, message));
                None
            }
        }
    }

    fn differentiated(&self, e: Expr, times: u32) -> Expr {
        (0..times).fold(e, |e, _| self.total_derivative(e))
    }

    /// A constraint is its equation, or a table with that.
    fn equation_and_description<'r>(&mut self, raw: &'r Raw) -> Option<(&'r Raw, String)> {
        let Kind::Table(table) = &raw.kind else {
            return Some((raw, String::new()));
        };
        let known = ["name", "equation", "lifted", "description"];
        self.known_keys(table, &known, "of a constraint");
        let description = self
            .optional_text(table, "description")
            .map_or_else(String::new, |text| text.content.trim().to_owned());
        let equation = table.get("equation");
        if equation.is_none() {
            let message = "a constraint needs its `equation`";
            self.push(Diagnostic::error("missing-value", raw.place, message));
        }
        equation.map(|equation| (equation, description))
    }

    fn empty_constraint(&mut self, name: &str, f: Expr, text: &Text) {
        let diagnostic = if self.graph.is_zero(f) {
            let message = format!("the constraint `{name}` says nothing: both sides are the same");
            Diagnostic::error("constraint-without-coordinate", text.place, message)
        } else {
            let message = format!("no coordinate occurs in the constraint `{name}`");
            Diagnostic::error("constraint-without-coordinate", text.place, message)
                .hint("a constraint relates coordinates and their derivatives; a relation among parameters belongs under assumptions")
        };
        self.push(diagnostic);
    }

    // ---- velocities

    pub(crate) fn independent_velocities(&mut self, root: &Table) -> Option<Vec<usize>> {
        let table = self.section(root, "velocities")?;
        self.known_keys(table, &["independent"], "of [velocities]");
        let raw = table.get("independent")?;
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(
                raw,
                "`independent`",
                "an array of velocities such as \"x'\"",
            );
            return None;
        };
        let mut chosen = Vec::new();
        for item in items {
            let Kind::Text(key) = &item.kind else {
                self.wrong_kind(item, "an independent velocity", "a text such as \"x'\"");
                continue;
            };
            for Instance { name, .. } in self.instances(key, "a velocity", &[]) {
                match self
                    .coordinates
                    .iter()
                    .position(|coordinate| coordinate.name == name)
                {
                    Some(number) if chosen.contains(&number) => {
                        let message = format!("`{}` is chosen twice", key.content);
                        self.push(Diagnostic::error("stated-twice", key.place, message));
                    }
                    Some(number) => chosen.push(number),
                    None => {
                        self.no_coordinate(key, &name, "the velocity of a coordinate is chosen")
                    }
                }
            }
        }
        Some(chosen)
    }

    // ---- assumptions

    pub(crate) fn assumptions(&mut self, root: &Table) -> Vec<Assumption> {
        let mut assumptions = Vec::new();
        let Some(raw) = root.get("assumptions") else {
            return assumptions;
        };
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(
                raw,
                "`assumptions`",
                "an array of comparisons such as \"m > 0\"",
            );
            return assumptions;
        };
        for item in items {
            let Kind::Text(text) = &item.kind else {
                self.wrong_kind(item, "an assumption", "a text such as \"m > 0\"");
                continue;
            };
            let parsed = self.parse(text, parse_relation);
            let indices = self.free_indices(&parsed);
            if parsed.has_errors() || !self.is_small_family(&indices, text) {
                continue;
            }
            for bindings in all_bindings(&indices) {
                self.assumption(text, &parsed, bindings, &mut assumptions);
            }
        }
        assumptions
    }

    fn assumption(
        &mut self,
        text: &Text,
        parsed: &Rc<Parsed>,
        bindings: Bindings,
        assumptions: &mut Vec<Assumption>,
    ) {
        let context = Context::jet("an assumption").with_characteristics(u32::MAX);
        let sides: Vec<Option<Expr>> = parsed
            .sides
            .iter()
            .map(|side| self.lower(text, parsed, *side, &bindings, context))
            .collect();
        for (pair, (relation, _)) in sides.windows(2).zip(&parsed.relations) {
            if let [Some(left), Some(right)] = *pair {
                let (relation, words) = (*relation, text.content.clone());
                assumptions.push(Assumption {
                    left,
                    relation,
                    right,
                    text: words,
                    place: text.place,
                });
            }
        }
        let (text, parsed) = (text.clone(), Rc::clone(parsed));
        self.formulas.push(Formula {
            text,
            parsed,
            bindings,
            expected: Expected::EqualSides,
            define: None,
        });
    }
}

/// What is not stated is none; what could not be read ends the matter.
fn or_none(stated: Option<Option<Expr>>) -> Option<Option<Expr>> {
    stated.map_or(Some(None), |value| value.map(Some))
}
