//! The ordinary sections that the lowering writes, as a tree of values at the places of the objects they come from.

use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;

/// A key or value of the lowering: it stands where its object stands.
pub(crate) fn word(content: impl Into<String>, place: Place) -> Text {
    Text::of_toml(&content.into(), "", place)
}

/// A text as a value.
pub(crate) fn text(content: impl Into<String>, place: Place) -> Raw {
    let kind = Kind::Text(word(content, place));
    Raw { place, kind }
}

/// Texts as an array.
pub(crate) fn array(items: Vec<Raw>, place: Place) -> Raw {
    let kind = Kind::Array(items);
    Raw { place, kind }
}

/// Keys with values.
pub(crate) fn table(entries: Vec<(&str, Raw)>, place: Place) -> Raw {
    let entries = entries
        .into_iter()
        .map(|(key, raw)| (word(key, place), raw))
        .collect();
    let kind = Kind::Table(Table { entries });
    Raw { place, kind }
}

/// What is written, section by section.
#[derive(Debug, Default)]
pub(crate) struct Written {
    pub(crate) coordinates: Table,
    pub(crate) parameters: Table,
    pub(crate) define: Table,
    pub(crate) assumptions: Vec<Raw>,
    pub(crate) constraints: Table,
    pub(crate) forces: Table,
    /// Forces along displacements, by their power.
    pub(crate) power: Vec<Raw>,
    pub(crate) events: Table,
    pub(crate) sensors: Table,
    /// Names or terms of the kinetic energy, the potential energy and Rayleigh's function.
    pub(crate) kinetic: Vec<String>,
    pub(crate) potential: Vec<String>,
    pub(crate) dissipation: Vec<String>,
    /// Elements of the drawing.
    pub(crate) elements: Vec<Raw>,
}

impl Written {
    /// Lays what is written below the sections of the user's own tree.
    pub(crate) fn merge(self, root: &mut Table, place: Place) {
        let Written {
            coordinates,
            parameters,
            define,
            assumptions,
            constraints,
            mut forces,
            power,
            events,
            sensors,
            kinetic,
            potential,
            dissipation,
            elements,
        } = self;
        named(root, "coordinates", coordinates, place);
        named(root, "parameters", parameters, place);
        extend(root, "define", define, place);
        extend_list(root, "assumptions", assumptions, place);
        extend_constraints(root, constraints, place);
        if !power.is_empty() {
            let all = array(power, place);
            forces.entries.push((word("power", place), all));
        }
        extend(root, "forces", forces, place);
        extend(root, "events", events, place);
        extend(root, "sensors", sensors, place);
        add_dissipation(root, dissipation, place);
        add_energies(root, kinetic, potential, place);
        draw(root, elements, place);
    }
}

fn section<'r>(root: &'r mut Table, key: &str, place: Place) -> Option<&'r mut Raw> {
    if root.get(key).is_none() {
        root.entries
            .push((word(key, place), table(Vec::new(), place)));
    }
    root.get_mut(key)
}

/// Adds entries to a table; what is no table is reported later, where sections are read.
fn extend(root: &mut Table, key: &str, more: Table, place: Place) {
    if more.entries.is_empty() {
        return;
    }
    if let Some(Kind::Table(own)) = section(root, key, place).map(|raw| &mut raw.kind) {
        own.entries.extend(more.entries);
    }
}

/// The same for a section that may be an array of names.
fn named(root: &mut Table, key: &str, more: Table, place: Place) {
    if let Some(raw) = root.get_mut(key) {
        if let Kind::Array(items) = &raw.kind {
            let names = items.iter().filter_map(|item| match &item.kind {
                Kind::Text(name) => Some((name.clone(), table(Vec::new(), item.place))),
                _ => None,
            });
            let entries: Vec<(Text, Raw)> = names.collect();
            if entries.len() == items.len() {
                raw.kind = Kind::Table(Table { entries });
            }
        }
    }
    extend(root, key, more, place);
}

fn extend_list(root: &mut Table, key: &str, more: Vec<Raw>, place: Place) {
    if more.is_empty() {
        return;
    }
    match root.get_mut(key).map(|raw| &mut raw.kind) {
        Some(Kind::Array(own)) => own.extend(more),
        Some(_) => {}
        None => root.entries.push((word(key, place), array(more, place))),
    }
}

/// Constraints may be an array, whose items then carry their names.
fn extend_constraints(root: &mut Table, more: Table, place: Place) {
    let Some(Kind::Array(own)) = root.get_mut("constraints").map(|raw| &mut raw.kind) else {
        return extend(root, "constraints", more, place);
    };
    for (key, mut raw) in more.entries {
        if let Kind::Table(item) = &mut raw.kind {
            let name = text(key.content.clone(), key.place);
            item.entries.push((word("name", key.place), name));
        }
        own.push(raw);
    }
}

/// A user's own expression that others are added to, as a definition; its text keeps its place.
fn stated(root: &mut Table, name: &str, raw: Raw) -> String {
    let entry = (word(name, raw.place), raw);
    let place = entry.1.place;
    if let Some(Kind::Table(own)) = section(root, "define", place).map(|raw| &mut raw.kind) {
        own.entries.push(entry);
    }
    name.to_owned()
}

fn add_energies(
    root: &mut Table,
    mut kinetic: Vec<String>,
    mut potential: Vec<String>,
    place: Place,
) {
    if kinetic.is_empty() && potential.is_empty() {
        return;
    }
    let mut own = match root.remove("lagrangian") {
        None => Table::default(),
        Some(Raw {
            kind: Kind::Table(own),
            ..
        }) => own,
        Some(whole) => Table {
            entries: vec![(word("L", whole.place), whole)],
        },
    };
    // As without bodies, an energy that is stated is that of the particles too.
    if !kinetic.is_empty() && own.get("T").is_none() && own.get("L").is_none() {
        kinetic.extend(of_particles(root));
    }
    let whole = own.remove("L").map(|raw| stated(root, "stated_L", raw));
    kinetic.extend(own.remove("T").map(|raw| stated(root, "stated_T", raw)));
    potential.extend(own.remove("V").map(|raw| stated(root, "stated_V", raw)));
    let sum = |terms: &[String]| terms.join(" + ").replace("+ -", "- ");
    match whole {
        Some(whole) => {
            let minus = if potential.is_empty() {
                String::new()
            } else {
                format!(" - ({})", sum(&potential))
            };
            let total = [vec![whole], kinetic].concat();
            let total = format!("{}{minus}", sum(&total));
            own.entries.push((word("L", place), text(total, place)));
        }
        None => {
            for (key, terms) in [("T", kinetic), ("V", potential)] {
                if !terms.is_empty() {
                    own.entries
                        .push((word(key, place), text(sum(&terms), place)));
                }
            }
        }
    }
    let kind = Kind::Table(own);
    root.entries
        .push((word("lagrangian", place), Raw { place, kind }));
}

/// The kinetic energies of particles, whose masses and places become definitions. What is no particle is reported where particles are read.
fn of_particles(root: &mut Table) -> Vec<String> {
    let particles = root.get("particles").and_then(Raw::table).cloned();
    let mut terms = Vec::new();
    for (key, raw) in particles.into_iter().flat_map(|table| table.entries) {
        let parts = raw
            .table()
            .map(|own| (own.get("mass"), own.get("position")));
        let Some((Some(mass), Some(position))) = parts else {
            continue;
        };
        let Kind::Array(components) = &position.kind else {
            continue;
        };
        let name = &key.content;
        let mass = stated(root, &format!("{name}_m"), mass.clone());
        let mut squares = Vec::new();
        for (number, component) in components.iter().enumerate() {
            let place = format!("{name}_r_{}", number + 1);
            squares.push(stated(root, &place, component.clone()) + "'^2");
        }
        terms.push(format!("1/2 {mass} ({})", squares.join(" + ")));
    }
    terms
}

fn add_dissipation(root: &mut Table, mut terms: Vec<String>, place: Place) {
    if terms.is_empty() {
        return;
    }
    let own = match root.get_mut("forces").map(|raw| &mut raw.kind) {
        Some(Kind::Table(forces)) => forces.remove("rayleigh"),
        _ => None,
    };
    terms.extend(own.map(|raw| stated(root, "stated_rayleigh", raw)));
    let entry = (
        word("rayleigh", place),
        text(terms.join(" + ").replace("+ -", "- "), place),
    );
    let more = Table {
        entries: vec![entry],
    };
    extend(root, "forces", more, place);
}

/// A drawing of the user's own stands as it is.
fn draw(root: &mut Table, elements: Vec<Raw>, place: Place) {
    if root.get("drawing").is_some() || elements.is_empty() {
        return;
    }
    let truth = Raw {
        place,
        kind: Kind::Truth(true),
    };
    let description = "The bodies, drawn from their shapes, and the tracks of their contacts.";
    let drawing = table(
        vec![
            ("view", text("space", place)),
            ("ground", truth),
            ("description", text(description, place)),
            ("element", array(elements, place)),
        ],
        place,
    );
    root.entries.push((word("drawing", place), drawing));
}
