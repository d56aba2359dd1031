//! The moving frame: fields X_s and a drift X_0, from which the quasi-velocities η of v = X_0 + Σ η^s X_s follow.

use std::rc::Rc;

use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::{parse_expression, Parsed, Severity};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{generic_rank, Options, RankTest};
use chetaev_symbolic::{Expr, Verdict};

use super::declare::{Index, Instance};
use super::define::{joined, Define, DefineKind, State};
use super::formula::{Expected, Formula};
use super::scope::{Context, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::FrameFields;
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;

/// Operations spent on the question whether the fields depend on each other; a frame of 32 sparse fields takes far fewer.
const RANK_BUDGET: u64 = 50_000_000;

/// More fields than this are not examined, as elimination takes the third power of their number. A frame that is
/// singular all the same has quasi-velocities that cannot be evaluated.
const MOST_EXAMINED_FIELDS: usize = 64;

/// The keys of the section, and how it is called.
const KEYS: &[&str] = &["drift", "fields"];
const OF: &str = "of [moving_frame]";

/// The component of a field or of the drift along one coordinate.
#[derive(Clone, Debug)]
struct Component {
    coordinate: usize,
    key: Place,
    text: Text,
    parsed: Rc<Parsed>,
    bindings: Bindings,
    state: State,
}

/// A field, or the drift, while the model is being read.
#[derive(Clone, Debug)]
struct FieldStated {
    /// The quasi-velocity of a field; none for the drift.
    define: Option<usize>,
    components: Vec<Component>,
}

/// The frame while the model is being read.
#[derive(Clone, Debug)]
pub(crate) struct FrameStated {
    place: Place,
    /// Whether everything could be read, and the fields are as many as the coordinates.
    sound: bool,
    /// The fields in the order of the file, and the drift at the end.
    all: Vec<FieldStated>,
    solved: Option<FrameFields>,
}

impl FrameStated {
    /// The fields with all components, where the frame has its quasi-velocities.
    pub(crate) fn solved(self) -> Option<FrameFields> {
        self.solved
    }
}

impl Resolver {
    // ---- declaration

    /// Declares the quasi-velocities that the fields name; their values follow later.
    pub(crate) fn declare_frame(&mut self, root: &Table) {
        let Some(raw) = root.get("moving_frame") else {
            return;
        };
        let Some(table) = self.section(root, "moving_frame") else {
            return;
        };
        let before = self.errors();
        if let Some(quasi) = root.get("quasi_velocities") {
            let message =
                "quasi-velocities are stated by [quasi_velocities] or by [moving_frame], not by both";
            let diagnostic = Diagnostic::error("stated-twice", raw.place, message);
            self.push(diagnostic.related(quasi.place, "the other statement"));
        }
        let mut all = self.declare_fields(table, raw.place);
        let drift = table
            .get("drift")
            .map(|raw| self.components(raw, "the drift", &Vec::new()));
        all.push(FieldStated {
            define: None,
            components: drift.unwrap_or_default(),
        });
        self.frame = Some(FrameStated {
            place: raw.place,
            sound: self.errors() == before,
            all,
            solved: None,
        });
    }

    fn declare_fields(&mut self, frame: &Table, place: Place) -> Vec<FieldStated> {
        let mut all = Vec::new();
        let misplaced = self.misplaced_fields(frame);
        match frame.get("fields").map(|raw| (raw, &raw.kind)) {
            None if misplaced.entries.is_empty() => {
                self.known_keys(frame, KEYS, OF);
                let message = "a frame needs its `fields`";
                self.push(Diagnostic::error("missing-value", place, message).hint(
                    "add [moving_frame.fields] with one line for each coordinate, as in w = { phi = 1 }",
                ));
            }
            None => {
                for (key, raw) in &misplaced.entries {
                    self.declare_field(key, raw, &mut all);
                }
            }
            Some((_, Kind::Table(fields))) => {
                self.known_keys(frame, KEYS, OF);
                let mut named = true;
                for (key, raw) in &fields.entries {
                    named &= self.declare_field(key, raw, &mut all);
                }
                if named {
                    self.count_fields(place, fields, all.len());
                }
            }
            Some((raw, _)) => {
                self.known_keys(frame, KEYS, OF);
                self.wrong_kind(raw, "`fields`", "a table of fields");
            }
        }
        all
    }

    /// Fields that stand in `[moving_frame]` itself, where there is no `[moving_frame.fields]`: one problem, and their names are known.
    fn misplaced_fields(&mut self, frame: &Table) -> Table {
        let is_field = |key: &Text, raw: &Raw| key.content != "drift" && raw.table().is_some();
        let mut misplaced = Table::default();
        if frame.get("fields").is_some() {
            return misplaced;
        }
        let others = frame.entries.iter().filter(|(key, raw)| is_field(key, raw));
        misplaced.entries.extend(others.cloned());
        if let Some((key, _)) = misplaced.entries.first() {
            let message = format!("`{}` is no key {OF}", key.content);
            self.push(
                Diagnostic::error("unknown-key", key.place, message)
                    .label("not known")
                    .hint(match key.content.as_str() {
                        "forms" => "forms are written as quasi-velocities: put them under [quasi_velocities]",
                        _ => "fields stand under [moving_frame.fields]",
                    }),
            );
        }
        // What stands under `forms` is no field, whatever is in it.
        misplaced.entries.retain(|(key, _)| key.content != "forms");
        misplaced
    }

    /// Errors until now; a warning is no reason to give something up.
    fn errors(&self) -> usize {
        self.diagnostics
            .iter()
            .filter(|own| own.severity == Severity::Error)
            .count()
    }

    /// Declares a field or a family of them; false where its name cannot be taken.
    fn declare_field(&mut self, key: &Text, raw: &Raw, all: &mut Vec<FieldStated>) -> bool {
        let what = "a quasi-velocity";
        let before = self.errors();
        let instances = self.instances(key, what, &[]);
        let mut named = self.errors() == before;
        for instance in instances {
            if instance.order > 0 {
                let message = format!("`{}` has a prime and cannot name {what}", key.content);
                self.push(Diagnostic::error("bad-name", key.place, message));
                return false;
            }
            let components = self.components(raw, "a field", &instance.bindings);
            let number = self.defines.len();
            if !self.declare(key, &instance.name, NamedKind::Define(number)) {
                named = false;
                continue;
            }
            self.defines.push(Define {
                name: instance.name,
                kind: DefineKind::FrameVelocity,
                text: Text::verbatim(
                    written(&self.coordinates, &components),
                    key.place.source,
                    key.place.span.start,
                ),
                parsed: Rc::new(parse_expression("0")),
                bindings: instance.bindings,
                unit: None,
                description: String::new(),
                place: key.place,
                state: State::Open,
                by_masses: None,
                rank: 0,
            });
            all.push(FieldStated {
                define: Some(number),
                components,
            });
        }
        named
    }

    /// The components of a field by coordinate; the indices of the field's own name are fixed by `outer`.
    fn components(&mut self, raw: &Raw, what: &str, outer: &Bindings) -> Vec<Component> {
        let mut components: Vec<Component> = Vec::new();
        let Kind::Table(table) = &raw.kind else {
            let wanted = "a table of components by coordinate, as in { x = \"cos(phi)\" }";
            self.wrong_kind(raw, what, wanted);
            return components;
        };
        let fixed: Vec<Index> = outer
            .iter()
            .map(|(name, value)| Index {
                name: name.clone(),
                first: *value,
                last: *value,
            })
            .collect();
        for (key, raw) in &table.entries {
            let Some(text) = self.expression_text(raw, "a component") else {
                continue;
            };
            let parsed = self.parse(&text, parse_expression);
            for Instance {
                name,
                order,
                bindings,
            } in self.instances(key, "a component", &fixed)
            {
                let because = format!("{what} has components along the coordinates");
                let Some(coordinate) = self.coordinate_named(key, &name, order, &because) else {
                    break;
                };
                if let Some(earlier) = components.iter().find(|own| own.coordinate == coordinate) {
                    let message = format!("the component along `{name}` is stated twice");
                    let diagnostic = Diagnostic::error("stated-twice", key.place, message);
                    self.push(diagnostic.related(earlier.key, "first here"));
                    break;
                }
                components.push(Component {
                    coordinate,
                    key: key.place,
                    text: text.clone(),
                    parsed: Rc::clone(&parsed),
                    bindings: outer.iter().cloned().chain(bindings).collect(),
                    state: if parsed.has_errors() {
                        State::Failed
                    } else {
                        State::Open
                    },
                });
            }
        }
        components
    }

    /// A frame spans all velocities: it has as many fields as there are coordinates.
    fn count_fields(&mut self, place: Place, fields: &Table, given: usize) {
        let n = self.coordinates.len();
        if n == given || n == 0 {
            return;
        }
        let at = fields.entries.last().map_or(place, |(key, _)| key.place);
        let plural =
            |count: usize, one: &str| format!("{count} {one}{}", if count == 1 { "" } else { "s" });
        let message = format!(
            "a frame has as many fields as there are coordinates, and for {} there {} {}",
            plural(n, "coordinate"),
            if given == 1 { "is" } else { "are" },
            plural(given, "field"),
        );
        let hint = if given < n {
            "add fields until every velocity is a combination of them, or state some quasi-velocities by expressions under [quasi_velocities]"
        } else {
            "a field that is a combination of the others does not belong to the frame"
        };
        self.push(Diagnostic::error("wrong-length", at, message).hint(hint));
    }

    // ---- values

    /// Gives all quasi-velocities of the frame their values, or says which definitions its fields need first.
    pub(crate) fn resolve_frame(&mut self, rank: &mut usize) -> Vec<usize> {
        let Some(mut frame) = self.frame.take() else {
            return Vec::new();
        };
        let mut wanted = Vec::new();
        for field in &mut frame.all {
            for component in &mut field.components {
                wanted.extend(self.resolve_component(component, field.define));
            }
        }
        if wanted.is_empty() {
            let speeds = self.solve_frame(&mut frame);
            let defines = frame.all.iter().filter_map(|field| field.define);
            for (at, number) in defines.enumerate() {
                *rank += 1;
                let value = speeds.as_ref().map(|speeds| speeds[at]);
                self.defines[number].rank = *rank;
                self.defines[number].state = value.map_or(State::Failed, State::Known);
            }
        }
        self.frame = Some(frame);
        wanted
    }

    fn resolve_component(&mut self, component: &mut Component, field: Option<usize>) -> Vec<usize> {
        if component.state != State::Open {
            return Vec::new();
        }
        let Component {
            text,
            parsed,
            bindings,
            ..
        } = component.clone();
        let context = Context::position(match field {
            Some(_) => "a field of a frame",
            None => "the drift of a frame",
        });
        let (value, wanted) = self.lower_wanting(&text, &parsed, parsed.root(), &bindings, context);
        if !wanted.is_empty() {
            return wanted;
        }
        component.state = value.map_or(State::Failed, State::Known);
        if value.is_some() {
            let coordinate = self.coordinates[component.coordinate].name.clone();
            let expected = match field {
                Some(define) => Expected::FieldComponent { define, coordinate },
                None => Expected::Quantity(coordinate, 1),
            };
            self.formulas.push(Formula {
                text,
                parsed,
                bindings,
                expected,
                define: None,
            });
        }
        Vec::new()
    }

    /// Solves X η = v − X_0 for the quasi-velocities.
    fn solve_frame(&mut self, frame: &mut FrameStated) -> Option<Vec<Expr>> {
        let n = self.coordinates.len();
        let mut rows = Vec::with_capacity(n + 1);
        for field in &frame.all {
            let mut row = vec![self.graph.zero(); n];
            for component in &field.components {
                let State::Known(value) = component.state else {
                    return None;
                };
                row[component.coordinate] = value;
            }
            rows.push(row);
        }
        let drift = rows.pop().filter(|_| frame.sound)?;
        if self.is_no_frame(frame, &rows) {
            return None;
        }
        let graph = &self.graph;
        let matrix: Vec<Vec<Expr>> = (0..n)
            .map(|i| rows.iter().map(|row| row[i]).collect())
            .collect();
        let right: Vec<Expr> = self
            .coordinates
            .iter()
            .zip(&drift)
            .map(|(own, &drift)| graph.sub(graph.symbol(&own.name, 1), drift))
            .collect();
        let Ok(inverse) = inverse(graph, &matrix) else {
            let all: Vec<usize> = (0..n).collect();
            self.dependent_fields(frame, &all, "the matrix of their components is singular");
            return None;
        };
        let along = |row: &Vec<Expr>| {
            let pairs = row.iter().zip(&right);
            let parts: Vec<Expr> = pairs.map(|(&e, &v)| graph.mul(&[e, v])).collect();
            graph.add(&parts)
        };
        let speeds = inverse.iter().map(along).collect();
        frame.solved = Some(FrameFields {
            fields: rows,
            drift,
            place: frame.place,
        });
        Some(speeds)
    }

    /// Whether fields are certain not to span all velocities, which is reported.
    fn is_no_frame(&mut self, frame: &FrameStated, rows: &[Vec<Expr>]) -> bool {
        let n = rows.len();
        let before = self.errors();
        for (s, row) in rows.iter().enumerate() {
            if row.iter().all(|&entry| self.graph.is_zero(entry)) {
                let (name, place) = self.field_name(frame, s);
                let message = format!(
                    "the field {name} vanishes: none of its components is different from 0"
                );
                self.push(Diagnostic::error("no-frame", place, message));
            }
        }
        for i in 0..n {
            if rows.iter().all(|row| self.graph.is_zero(row[i])) {
                let names: Vec<String> = (0..n).map(|s| self.field_name(frame, s).0).collect();
                let message = format!(
                    "none of the fields {} moves the coordinate `{}`",
                    joined(&names),
                    self.coordinates[i].name
                );
                self.push(Diagnostic::error("no-frame", frame.place, message));
            }
        }
        if self.errors() > before {
            return true;
        }
        let Some((rank, others)) = self.fields_left_out(rows) else {
            return false;
        };
        let why = format!("the rank of their components is {rank}, and {n} is needed");
        self.dependent_fields(frame, &others, &why);
        true
    }

    /// The rank of the fields and those that are combinations of the ones before, where that is proved.
    fn fields_left_out(&self, rows: &[Vec<Expr>]) -> Option<(usize, Vec<usize>)> {
        if rows.len() > MOST_EXAMINED_FIELDS {
            return None;
        }
        let entries = rows.concat();
        let test = RankTest {
            rows: rows.len(),
            columns: rows.len(),
            entries: &entries,
            solved: &[],
            implicit: &[],
            assumptions: &Assumptions::new(),
            options: Options {
                budget: RANK_BUDGET,
                ..Options::default()
            },
        };
        let found = generic_rank(&self.graph, &test).ok()?;
        if found.maximum >= rows.len() || !matches!(found.at_most, Verdict::Proved(_)) {
            return None;
        }
        let others = (0..rows.len()).filter(|row| !found.pivots.rows.contains(row));
        Some((found.maximum, others.collect()))
    }

    fn dependent_fields(&mut self, frame: &FrameStated, which: &[usize], why: &str) {
        let names: Vec<String> = which.iter().map(|&s| self.field_name(frame, s).0).collect();
        let place = which
            .last()
            .map_or(frame.place, |&s| self.field_name(frame, s).1);
        let verb = if names.len() == 1 { "field" } else { "fields" };
        let depends = if names.len() == 1 {
            "depends"
        } else {
            "depend"
        };
        let message = format!(
            "the {verb} {} {depends} on the others: {why}",
            joined(&names)
        );
        self.push(
            Diagnostic::error("no-frame", place, message)
                .hint("every velocity has to be a combination of the fields in one way only"),
        );
    }

    fn field_name(&self, frame: &FrameStated, s: usize) -> (String, Place) {
        let define = frame.all[s].define.map(|number| &self.defines[number]);
        define.map_or_else(
            || (String::new(), frame.place),
            |define| (format!("`{}`", define.name), define.place),
        )
    }
}

/// A field as one line, whichever way it was laid out in the file.
fn written(coordinates: &[crate::model::Coordinate], components: &[Component]) -> String {
    let parts: Vec<String> = components
        .iter()
        .map(|own| {
            let name = &coordinates[own.coordinate].name;
            format!("{name} = \"{}\"", own.text.content)
        })
        .collect();
    format!("{{ {} }}", parts.join(", "))
}
