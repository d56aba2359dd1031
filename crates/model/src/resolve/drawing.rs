//! The section `drawing`.

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::Expr;

use super::declare::{all_bindings, Index};
use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::drawing::{Drawing, Element, Point, Shape};
use crate::raw::{Kind, Raw, Table};

const KINDS: &[&str] = &[
    "point", "segment", "arrow", "circle", "sphere", "wheel", "blade", "polyline", "polygon",
    "trail", "label",
];
const COLORS: &[&str] = &["ink", "muted", "blue", "red", "green", "amber", "violet"];

/// Most elements that one table stands for.
const MOST_COPIES: i64 = 10_000;

const CONTEXT: Context = Context::jet("the drawing");

/// An element being read: its table, the dimension of the picture, and the values of its indices.
struct ElementTable<'t> {
    table: &'t Table,
    raw: &'t Raw,
    kind: &'static str,
    dimension: usize,
    bindings: Bindings,
}

/// The keys of a kind of element, beside those that all have.
fn keys_of(kind: &str) -> &'static [&'static str] {
    match kind {
        "segment" | "arrow" => &["from", "to"],
        "circle" => &["center", "axis", "radius"],
        "sphere" => &["center", "radius"],
        "wheel" => &["center", "axis", "radius", "angle"],
        "blade" => &["at", "angle", "direction", "length"],
        "polyline" => &["points", "closed", "filled"],
        "polygon" => &["points"],
        "label" => &["at", "text"],
        _ => &["at"],
    }
}

impl Resolver {
    pub(crate) fn drawing(&mut self, root: &Table) -> Option<Drawing> {
        let table = self.section(root, "drawing")?;
        self.known_keys(
            table,
            &[
                "view",
                "ground",
                "camera",
                "bounds",
                "description",
                "element",
            ],
            "of [drawing]",
        );
        let spatial = self.word_of(table, "view", &["plane", "space"]) == Some("space");
        let mut drawing = Drawing {
            spatial,
            ground: self.optional_truth(table, "ground").unwrap_or(false),
            camera: table
                .get("camera")
                .and_then(|raw| self.pair(raw, "the camera")),
            bounds: table
                .get("bounds")
                .and_then(|raw| self.bounds(raw, if spatial { 3 } else { 2 })),
            description: self
                .optional_text(table, "description")
                .map_or_else(String::new, |text| text.content.trim().to_owned()),
            elements: Vec::new(),
        };
        let Some(raw) = table.get("element") else {
            return Some(drawing);
        };
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(
                raw,
                "`element`",
                "an array of tables, each headed [[drawing.element]]",
            );
            return None;
        };
        for item in items {
            self.elements(item, spatial, &mut drawing.elements);
        }
        Some(drawing)
    }

    fn pair(
        &mut self,
        raw: &Raw,
        what: &'static str,
    ) -> Option<(chetaev_symbolic::Rational, chetaev_symbolic::Rational)> {
        match &raw.kind {
            Kind::Array(items) if items.len() == 2 => Some((
                self.rational(&items[0], what)?,
                self.rational(&items[1], what)?,
            )),
            _ => {
                self.wrong_kind(raw, what, "an array of two numbers");
                None
            }
        }
    }

    fn bounds(
        &mut self,
        raw: &Raw,
        length: usize,
    ) -> Option<Vec<(chetaev_symbolic::Rational, chetaev_symbolic::Rational)>> {
        match &raw.kind {
            Kind::Array(items) if items.len() == length => items
                .iter()
                .map(|item| self.pair(item, "a bound"))
                .collect(),
            _ => {
                self.wrong_kind(
                    raw,
                    "`bounds`",
                    &format!("an array of {length} pairs of numbers"),
                );
                None
            }
        }
    }

    /// The elements that one table stands for: one for each value of the index under `for`.
    fn elements(&mut self, raw: &Raw, spatial: bool, elements: &mut Vec<Element>) {
        let Some(table) = raw.table() else {
            self.wrong_kind(raw, "a drawing element", "a table");
            return;
        };
        let Some(kind) = self.kind_of_element(table, raw) else {
            return;
        };
        let known = [&["kind", "name", "color", "for"], keys_of(kind)].concat();
        self.known_keys(table, &known, &format!("of a {kind}"));
        let name = self
            .optional_text(table, "name")
            .map_or_else(String::new, |text| text.content);
        let color = self
            .word_of(table, "color", COLORS)
            .unwrap_or("ink")
            .to_owned();
        let Some(indices) = self.element_indices(table) else {
            return;
        };
        let too_many = indices
            .iter()
            .any(|index| index.last.saturating_sub(index.first) > MOST_COPIES);
        if too_many {
            let message = format!("an element is drawn {MOST_COPIES} times at most");
            self.push(Diagnostic::error("too-large", raw.place, message));
            return;
        }
        for bindings in all_bindings(&indices) {
            let dimension = if spatial { 3 } else { 2 };
            let element = ElementTable {
                table,
                raw,
                kind,
                dimension,
                bindings,
            };
            if let Some(shape) = self.shape(&element) {
                elements.push(Element {
                    name: name.clone(),
                    color: color.clone(),
                    shape,
                });
            }
        }
    }

    fn kind_of_element(&mut self, table: &Table, raw: &Raw) -> Option<&'static str> {
        let kind = self.word_of(table, "kind", KINDS);
        if table.get("kind").is_none() {
            let message = "a drawing element needs its `kind`";
            let diagnostic = Diagnostic::error("missing-value", raw.place, message);
            self.push(diagnostic.hint(format!("one of {}", KINDS.join(", "))));
        }
        kind
    }

    /// `for = "i"` takes the range of the index from [indices], `for = "i = 1..n"` states it here.
    fn element_indices(&mut self, table: &Table) -> Option<Vec<Index>> {
        let Some(text) = self.optional_text(table, "for") else {
            return table.get("for").is_none().then(Vec::new);
        };
        let (name, range) = match text.content.split_once('=') {
            Some((name, range)) => (name.trim().to_owned(), Some(range.to_owned())),
            None => (text.content.trim().to_owned(), None),
        };
        if let Some(range) = range {
            let at = text.content.len() - range.len();
            let part = text.part(at, range);
            let (first, last) = self.range(&part)?;
            return Some(vec![Index { name, first, last }]);
        }
        let found = self
            .indices
            .iter()
            .find(|index| index.name == name)
            .cloned();
        if found.is_none() {
            let message = format!("there is no index `{name}`");
            self.push(
                Diagnostic::error("unknown-name", text.place, message)
                    .hint("write for = \"i = 1..n\", or state the index under [indices]"),
            );
        }
        found.map(|index| vec![index])
    }

    fn shape(&mut self, element: &ElementTable<'_>) -> Option<Shape> {
        Some(match element.kind {
            "segment" => Shape::Segment {
                from: self.point(element, "from")?,
                to: self.point(element, "to")?,
            },
            "arrow" => Shape::Arrow {
                from: self.point(element, "from")?,
                to: self.point(element, "to")?,
            },
            "circle" => Shape::Circle {
                center: self.point(element, "center")?,
                axis: self.axis(element)?,
                radius: self.number(element, "radius")?,
            },
            "sphere" => Shape::Sphere {
                center: self.point(element, "center")?,
                radius: self.number(element, "radius")?,
            },
            "wheel" => Shape::Wheel {
                center: self.point(element, "center")?,
                axis: self.axis(element)?,
                radius: self.number(element, "radius")?,
                angle: self.number(element, "angle")?,
            },
            "blade" => self.blade(element)?,
            "polyline" => {
                let truth = |resolver: &mut Self, key: &str| {
                    resolver.optional_truth(element.table, key) == Some(true)
                };
                Shape::Polyline {
                    points: self.points(element)?,
                    closed: truth(self, "closed"),
                    filled: truth(self, "filled"),
                }
            }
            "polygon" => Shape::Polyline {
                points: self.points(element)?,
                closed: true,
                filled: true,
            },
            "trail" => Shape::Trail {
                at: self.point(element, "at")?,
            },
            "label" => {
                let text = self
                    .optional_text(element.table, "text")
                    .map_or_else(String::new, |text| text.content);
                Shape::Label {
                    at: self.point(element, "at")?,
                    text,
                }
            }
            _ => Shape::Point {
                at: self.point(element, "at")?,
            },
        })
    }

    /// In the plane its direction is an angle.
    fn blade(&mut self, element: &ElementTable<'_>) -> Option<Shape> {
        let direction = if element.dimension == 2 {
            vec![self.number(element, "angle")?]
        } else {
            self.point(element, "direction")?
        };
        Some(Shape::Blade {
            at: self.point(element, "at")?,
            direction,
            length: self.number(element, "length")?,
        })
    }

    fn required<'t>(&mut self, element: &ElementTable<'t>, key: &str) -> Option<&'t Raw> {
        let found = element.table.get(key);
        if found.is_none() {
            let message = format!("a {} needs `{key}`", element.kind);
            self.push(Diagnostic::error(
                "missing-value",
                element.raw.place,
                message,
            ));
        }
        found
    }

    fn point(&mut self, element: &ElementTable<'_>, key: &str) -> Option<Point> {
        let raw = self.required(element, key)?;
        self.vector(
            raw,
            element.dimension,
            "a point",
            &element.bindings,
            CONTEXT,
        )
    }

    fn points(&mut self, element: &ElementTable<'_>) -> Option<Vec<Point>> {
        let raw = self.required(element, "points")?;
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(raw, "`points`", "an array of points");
            return None;
        };
        if items.len() < 2 {
            self.push(Diagnostic::error(
                "wrong-length",
                raw.place,
                "a broken line has at least two points",
            ));
            return None;
        }
        let points: Vec<Option<Point>> = items
            .iter()
            .map(|item| {
                self.vector(
                    item,
                    element.dimension,
                    "a point",
                    &element.bindings,
                    CONTEXT,
                )
            })
            .collect();
        points.into_iter().collect()
    }

    /// The axis of a circle or wheel: needed in space, meaningless in the plane.
    #[allow(clippy::option_option)] // the outer one is failure, the inner one is the plane
    fn axis(&mut self, element: &ElementTable<'_>) -> Option<Option<Point>> {
        if element.dimension == 2 {
            if let Some(raw) = element.table.get("axis") {
                self.push(Diagnostic::warning(
                    "unused-value",
                    raw.place,
                    "an axis has no meaning in the plane",
                ));
            }
            return Some(None);
        }
        self.point(element, "axis").map(Some)
    }

    fn number(&mut self, element: &ElementTable<'_>, key: &str) -> Option<Expr> {
        let raw = self.required(element, key)?;
        let text = self.expression_text(raw, &format!("`{key}`"))?;
        self.expression(&text, &element.bindings, CONTEXT, Expected::Anything)
    }
}
