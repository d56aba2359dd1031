//! What is touched, as it is stated: a plane, a sphere, a cylinder, heights over a plane, a surface with an equation, a rail.

use chetaev_symbolic::syntax::names;
use chetaev_symbolic::{Expr, Symbol};

use super::algebra::Vector;
use super::lowering::Lowering;
use super::reading::Object;
use super::sections::word;
use super::surfaces::{Away, Figure, Form, SURFACES};
use super::tree::ContactStated;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::text::Text;

const KEYS: &[&str] = &[
    "shape",
    "radius",
    "axis",
    "at",
    "inside",
    "height",
    "equation",
    "curve",
    "coordinate",
    "coordinates",
];

/// Keys under which a shape is stated by formulas.
pub(crate) const FORMULAS: &[&str] = &["height", "equation", "curve"];

/// What is touched, in the frame of the contact.
pub(crate) enum Ground {
    Plane,
    /// A sphere or a cylinder about the origin.
    Round {
        away: Away,
        figure: Figure,
        is_sphere: bool,
    },
    /// A height over the plane as a function of two level coordinates, with their names.
    Heights {
        height: Expr,
        variables: [Symbol; 2],
        names: [Text; 2],
    },
    /// A function that vanishes on the surface and grows towards the body, and its three variables.
    Equation {
        value: Expr,
        variables: [Symbol; 3],
    },
    /// A rail, with the radius of its head where it has one.
    Line {
        line: Line,
        head: Option<Expr>,
    },
}

/// The line of a rail.
pub(crate) enum Line {
    /// Through a point along an axis.
    Straight { at: Vector, axis: usize },
    /// A curve as a function of its coordinate, with its name.
    Curve {
        points: Vector,
        variable: Symbol,
        name: Text,
    },
}

impl<'r> Lowering<'r> {
    /// The table `surface` of a contact.
    pub(crate) fn surface_stated(&mut self, object: &Object<'r>) -> Option<Object<'r>> {
        let raw = object.get("surface")?;
        let Some(table) = raw.table() else {
            let wanted = "a table, as in { shape = \"sphere\", radius = 1, inside = true }";
            self.wrong_kind(raw, &format!("the surface of {}", object.words()), wanted);
            return None;
        };
        let stated = Object { table, ..*object };
        self.known_keys(&stated, KEYS);
        Some(stated)
    }

    /// What is touched.
    pub(crate) fn ground_of(&mut self, contact: &ContactStated<'r>) -> Option<Ground> {
        let object = &contact.object;
        if object.get("surface").is_none() {
            return Some(Ground::Plane);
        }
        let stated = self.surface_stated(object)?;
        let place = object.get("surface").map_or(object.place, |raw| raw.place);
        if let Some(height) = stated.get("height") {
            return self.heights_stated(&stated, height);
        }
        if let Some(raw) = stated.get("equation") {
            let (value, variables) = self.function_of_three(&stated, raw, "surface")?;
            return Some(Ground::Equation { value, variables });
        }
        if let Some(raw) = stated.get("curve") {
            return self.curve_stated(&stated, raw);
        }
        let surface = self.choice(&stated, "shape", SURFACES, |own| own.word);
        let Some(surface) = surface else {
            if stated.get("shape").is_none() {
                let message = format!(
                    "the surface of {} needs its `shape`, its `height`, its `curve` or its `equation`",
                    object.words()
                );
                self.error("missing-value", place, message);
            }
            return None;
        };
        match surface.form {
            Form::Round(away) => {
                let figure = self.surface_figure(&stated)?;
                let is_sphere = surface.word == "sphere";
                Some(Ground::Round {
                    away,
                    figure,
                    is_sphere,
                })
            }
            Form::Line => {
                let at = self.surface_vector(&stated)?;
                let axis = match self.word(&stated, "axis") {
                    Some(text) => self.axis_of(text)?.0,
                    None => 0,
                };
                let head = self.head_of(&stated)?;
                let line = Line::Straight { at, axis };
                Some(Ground::Line { line, head })
            }
        }
    }

    /// The place `at` of a rail.
    fn surface_vector(&mut self, stated: &Object<'r>) -> Option<Vector> {
        match stated.get("at") {
            Some(raw) => self.vector_of(&stated.slot("surface_at", "m"), raw, false),
            None => Some(self.algebra.zero()),
        }
    }

    /// The radius of the head of a rail: nothing for a sharp one; the outer nothing where it cannot be read.
    fn head_of(&mut self, stated: &Object<'r>) -> Option<Option<Expr>> {
        let Some(raw) = stated.get("radius") else {
            return Some(None);
        };
        let radius = self.number(&stated.slot("surface_radius", "m"), raw)?;
        self.assume_positive(radius, raw.place);
        Some(Some(radius))
    }

    fn curve_stated(&mut self, stated: &Object<'r>, raw: &'r Raw) -> Option<Ground> {
        let name = match self.word(stated, "coordinate") {
            Some(text) => text.clone(),
            None => word(format!("{}_u", stated.name()), stated.place),
        };
        let own = self.algebra.symbol(&names::normalized(&name.content));
        let variable = self.algebra.graph.as_symbol(own)?;
        let items: Vec<&Raw> = match &raw.kind {
            Kind::Array(items) if items.len() == 3 => items.iter().collect(),
            _ => {
                let what = format!("the curve of {}", stated.words());
                self.wrong_kind(raw, &what, "an array of three expressions");
                return None;
            }
        };
        let mut points = self.algebra.zero();
        for (point, item) in points.iter_mut().zip(items) {
            *point = match &item.kind {
                Kind::Number(_) => self.rational_of(item)?,
                _ => self.shape_function(stated, item, &[own])?,
            };
        }
        if points
            .iter()
            .all(|e| !self.algebra.graph.contains_any(*e, &[variable]))
        {
            let message = format!(
                "the curve of {} does not depend on its coordinate `{}`",
                stated.words(),
                name.content
            );
            self.error("not-allowed-here", raw.place, message);
            return None;
        }
        let head = self.head_of(stated)?;
        let line = Line::Curve {
            points,
            variable,
            name,
        };
        Some(Ground::Line { line, head })
    }

    /// A bare number in a shape stands for itself.
    fn rational_of(&mut self, raw: &Raw) -> Option<Expr> {
        let Kind::Number(number) = &raw.kind else {
            return None;
        };
        self.read_symbols(&number.clone())
    }

    fn heights_stated(&mut self, stated: &Object<'r>, raw: &'r Raw) -> Option<Ground> {
        let names = self.contact_names(stated)?;
        let own = names
            .clone()
            .map(|name| self.algebra.symbol(&names::normalized(&name.content)));
        let height = self.shape_function(stated, raw, &own)?;
        let [Some(u), Some(w)] = own.map(|e| self.algebra.graph.as_symbol(e)) else {
            return None;
        };
        Some(Ground::Heights {
            height,
            variables: [u, w],
            names,
        })
    }

    /// The names of the two coordinates of the point of contact, by the user or after the contact.
    pub(crate) fn contact_names(&mut self, stated: &Object<'r>) -> Option<[Text; 2]> {
        let name = stated.name();
        let Some(raw) = stated.get("coordinates") else {
            return Some(["u", "w"].map(|end| word(format!("{name}_{end}"), stated.place)));
        };
        let items = match &raw.kind {
            Kind::Array(items) => items.iter().filter_map(Raw::expression).collect(),
            _ => Vec::new(),
        };
        let [first, second] = items[..] else {
            self.wrong_kind(raw, "`coordinates` of a surface", "an array of two names");
            return None;
        };
        Some([first.clone(), second.clone()])
    }

    /// The figure of a body by its equation: `{ equation = "…", coordinates = ["u", "v", "w"] }`.
    pub(crate) fn stated_figure(
        &mut self,
        contact: &ContactStated<'r>,
        raw: &'r Raw,
    ) -> Option<(Expr, [Symbol; 3])> {
        let object = &contact.object;
        let equation = raw
            .table()
            .and_then(|table| Some((table, table.get("equation")?)));
        let Some((table, equation)) = equation else {
            let wanted = "a table, as in { equation = \"u^2 + v^2 + w^4 - 1\", coordinates = [\"u\", \"v\", \"w\"] }";
            self.wrong_kind(raw, &format!("the figure of {}", object.words()), wanted);
            return None;
        };
        let stated = Object { table, ..*object };
        self.known_keys(&stated, &["equation", "coordinates"]);
        self.function_of_three(&stated, equation, "figure")
    }

    /// A function of the three `coordinates` of a table, x, y and z where it names none, and of parameters.
    fn function_of_three(
        &mut self,
        stated: &Object<'r>,
        raw: &'r Raw,
        what: &str,
    ) -> Option<(Expr, [Symbol; 3])> {
        let mut names = ["x", "y", "z"].map(str::to_owned);
        if let Some(own) = stated.get("coordinates") {
            let items: Vec<&Text> = match &own.kind {
                Kind::Array(items) => items.iter().filter_map(Raw::expression).collect(),
                _ => Vec::new(),
            };
            let [u, v, w] = items[..] else {
                let about = format!("`coordinates` of the {what} of {}", stated.words());
                self.wrong_kind(own, &about, "an array of three names");
                return None;
            };
            names = [u, v, w].map(|name| names::normalized(&name.content));
        }
        let own = names.map(|name| self.algebra.symbol(&name));
        let value = self.shape_function(stated, raw, &own)?;
        let graph = &self.algebra.graph;
        let [Some(u), Some(v), Some(w)] = own.map(|e| graph.as_symbol(e)) else {
            return None;
        };
        if !graph.contains_any(value, &[u, v, w]) {
            let message = format!(
                "the equation of the {what} of {} contains none of its coordinates",
                stated.words()
            );
            self.error("not-allowed-here", raw.place, message);
            return None;
        }
        Some((value, [u, v, w]))
    }

    /// A function that states a shape: of coordinates of its own, the time and parameters. It is differentiated here, so that all that moves in it
    /// must be seen.
    pub(crate) fn shape_function(
        &mut self,
        stated: &Object<'r>,
        raw: &Raw,
        own: &[Expr],
    ) -> Option<Expr> {
        let Some(text) = raw.expression() else {
            let about = format!("what states a surface or a figure of {}", stated.words());
            self.wrong_kind(raw, &about, "an expression");
            return None;
        };
        let value = self.read_symbols(text)?;
        let graph = &self.algebra.graph;
        let strange = graph.symbols_in(&[value]).into_iter().find(|&symbol| {
            let name = names::normalized(graph.symbol_name(symbol));
            let is_own = own.contains(&graph.symbol_expr(symbol));
            !is_own && name != "t" && !self.parameters.contains(&name)
        });
        let Some(strange) = strange else {
            return Some(value);
        };
        let own: Vec<String> = own.iter().map(|e| graph.text(*e)).collect();
        let message = format!(
            "the shape that {} touches may depend on {}, the time and parameters, not on `{}`",
            stated.words(),
            own.join(", "),
            graph.symbol_text(strange)
        );
        let problem = Diagnostic::error("not-allowed-here", raw.place, message);
        let hint = "other names for the coordinates of a shape are stated by its `coordinates`, that of a curve by its `coordinate`";
        self.problems.push(problem.hint(hint));
        None
    }
}
