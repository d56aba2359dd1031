//! Classical functionals with fields put in, against values that were computed by other ways (reference cases S-F01 to S-F06): the value,
//! and the first and the second variation, each by its definition and by Euler expressions, natural conditions and corners.

use crate::reference::nodes;
use crate::table::{loaded_text, row_text};
use chetaev_functionals::functional::{Functional, Interval, Side};
use chetaev_functionals::integral::{over_box, over_face};
use chetaev_functionals::notation::parse;
use chetaev_functionals::variation::{variation, Trace};
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// A functional of the gallery with all its values.
struct Case {
    model: &'static str,
    parameters: &'static [(&'static str, &'static str)],
    /// The field, its value and its variation.
    field: [&'static str; 3],
    data: &'static [(&'static str, &'static str)],
    /// When it ends, where the time is a variable.
    until: &'static str,
}

const DIRICHLET: Case = Case {
    model: "dirichlet",
    parameters: &[("a", "1"), ("b", "2"), ("h", "1/2")],
    field: ["u", "x^2 y - y^2", "-x^2 + x y + 1"],
    data: &[("k", "x y + 1"), ("f", "x - y"), ("g", "y")],
    until: "",
};

const AREA: Case = Case {
    model: "minimal-surface",
    parameters: &[("a", "1"), ("b", "1")],
    field: ["u", "x^2 - y^2/2", "x y + 1"],
    data: &[],
    until: "",
};

const BEAM: Case = Case {
    model: "beam",
    parameters: &[
        ("l", "2"),
        ("P", "1/3"),
        ("kS", "3"),
        ("cT", "1/2"),
        ("m", "1/4"),
    ],
    field: ["w", "x^3 - 2 x", "x^2 - x + 1"],
    data: &[("EI", "x + 1"), ("q", "x^2 + 1")],
    until: "",
};

const PLATE: Case = Case {
    model: "plate",
    parameters: &[("a", "2"), ("b", "1"), ("D", "3"), ("nu", "3/10")],
    field: ["w", "x^3 y + x^2 y^2 - x y^2", "x y + x - y^2 + 1"],
    data: &[("q", "x y + 1")],
    until: "",
};

const STRING: Case = Case {
    model: "string",
    parameters: &[
        ("l", "1"),
        ("rho", "3"),
        ("T0", "2"),
        ("EA", "4"),
        ("k", "1/2"),
        ("M", "1/3"),
    ],
    field: ["u", "t x^2 - t^2 x", "t (2 - t) (x + 1)"],
    data: &[],
    until: "2",
};

const MEMBRANE: Case = Case {
    model: "membrane",
    parameters: &[
        ("a", "1"),
        ("b", "2"),
        ("rho", "2"),
        ("T0", "3"),
        ("k", "1/2"),
    ],
    field: ["u", "t x y + x^2", "t (1 - t) (x + y)"],
    data: &[],
    until: "1",
};

/// What is integrated, over the body or over a piece.
type Terms<'f> = Vec<(Expr, Option<&'f Side>)>;

struct Inserted {
    functional: Functional,
    intervals: Vec<Interval>,
    /// What is put in: the field with ε times its variation, and data.
    pairs: Vec<(Expr, Expr)>,
    varied: Expr,
    epsilon: Symbol,
}

impl Inserted {
    fn of(case: &Case) -> Inserted {
        let row = format!("../fields/{}", case.model);
        let functional = loaded_text(&row, &row_text(&row), case.parameters).functional;
        let (space, g) = (&*functional.space, &functional.space.graph);
        let component = |name: &str| space.jet(space.component_named(name).unwrap(), &[]);
        let epsilon = g.symbol("epsilon of the test", 0);
        let [name, value, varied] = case.field;
        let varied = written(&functional, varied);
        let along = g.mul(&[epsilon, varied]);
        let whole = g.add(&[written(&functional, value), along]);
        let data = case.data.iter();
        let data = data.map(|(name, value)| (component(name), written(&functional, value)));
        let pairs = data.chain([(component(name), whole)]).collect();
        let mut intervals = functional.intervals.clone();
        if let Some(axis) = space.coordinates.iter().position(|own| own.is_time) {
            intervals.push(Interval {
                axis,
                lower: g.zero(),
                upper: written(&functional, case.until),
            });
        }
        Inserted {
            intervals,
            pairs,
            varied,
            epsilon: g.as_symbol(epsilon).unwrap(),
            functional,
        }
    }

    /// The functional itself.
    fn whole(&self) -> Terms<'_> {
        let pieces = self.functional.pieces.iter();
        let pieces = pieces.map(|own| (own.density, Some(&own.side)));
        self.put([(self.functional.density, None)].into_iter().chain(pieces))
    }

    /// Its first variation without what stands at corners: conditions times what is varied in them.
    fn by_conditions(&self) -> Terms<'_> {
        let (space, g) = (&*self.functional.space, &self.functional.space.graph);
        let own = variation(&self.functional).unwrap();
        let mut terms = vec![(g.mul(&[own.euler[0].1, self.varied]), None)];
        for on in &own.pieces {
            let side = &self.functional.piece(&on.piece).unwrap().side;
            for condition in &on.conditions {
                let varied = match (&condition.trace, side) {
                    (Trace::Normal, Side::Flat { axis, .. }) => space.total(self.varied, *axis),
                    _ => self.varied,
                };
                terms.push((g.mul(&[condition.value, varied]), Some(side)));
            }
        }
        self.put(terms.into_iter())
    }

    /// The coefficients of the variation at corners, and what they add to the first variation.
    fn at_corners(&self) -> (BTreeMap<String, String>, Expr) {
        let (space, g) = (&*self.functional.space, &self.functional.space.graph);
        let mut coefficients = BTreeMap::new();
        let mut sum = g.zero();
        for corner in variation(&self.functional).unwrap().corners {
            let there = |e: Expr| {
                let names = [&corner.pieces.0, &corner.pieces.1];
                let own = space.put(e, &self.pairs);
                names.iter().fold(own, |e, name| {
                    match self.functional.piece(name).unwrap().side {
                        Side::Flat { axis, at, .. } => space.at(e, axis, at),
                        Side::Curved => unreachable!("a box"),
                    }
                })
            };
            let value = there(corner.value);
            let now = g.text(self.at_zero(value));
            coefficients.insert(corner.place(), now);
            sum = g.add(&[sum, g.mul(&[value, there(self.varied)])]);
        }
        (coefficients, sum)
    }

    fn put<'f>(&self, terms: impl Iterator<Item = (Expr, Option<&'f Side>)>) -> Terms<'f> {
        let space = &*self.functional.space;
        terms
            .map(|(e, side)| (space.put(e, &self.pairs), side))
            .collect()
    }

    fn exactly(&self, terms: &Terms<'_>) -> Expr {
        let (space, g) = (&*self.functional.space, &self.functional.space.graph);
        let own = terms.iter().map(|(e, side)| match side {
            Some(side) => over_face(space, *e, side, &self.intervals).unwrap(),
            None => over_box(space, *e, &self.intervals).unwrap(),
        });
        g.add(&own.collect::<Vec<_>>())
    }

    /// Over the unit square by Gauss's formula.
    fn nearly(&self, terms: &Terms<'_>, derivatives: usize) -> f64 {
        let g = &self.functional.space.graph;
        let mut sum = 0.0;
        for (e, side) in terms {
            let own = self.at_zero(self.derived(*e, derivatives));
            for (point, weight) in nodes(2, *side) {
                let values = g.evaluate_f64(&[own], &|symbol| match g.symbol_name(symbol) {
                    "x" => Some(point[0]),
                    "y" => Some(point[1]),
                    _ => None,
                });
                sum += weight * values.unwrap()[0];
            }
        }
        sum
    }

    fn derived(&self, e: Expr, derivatives: usize) -> Expr {
        let g = &self.functional.space.graph;
        (0..derivatives).fold(e, |e, _| g.diff(e, self.epsilon))
    }

    /// At ε = 0, with the values of the parameters.
    fn at_zero(&self, e: Expr) -> Expr {
        let g = &self.functional.space.graph;
        let mut pairs = self.functional.values();
        pairs.push((g.symbol_expr(self.epsilon), g.zero()));
        g.substitute(e, &pairs)
    }

    /// A derivative by ε at ε = 0.
    fn said(&self, e: Expr, derivatives: usize) -> String {
        let g = &self.functional.space.graph;
        g.text(self.at_zero(self.derived(e, derivatives)))
    }
}

fn written(functional: &Functional, text: &str) -> Expr {
    let node = parse(text, &functional.scope, &mut Vec::new()).unwrap();
    functional.scope.value(&node, &BTreeMap::new())
}

#[test]
fn values_and_variations_of_polynomials_are_exactly_those_of_the_references() {
    // S-F01, S-F03 to S-F06; for the first the second variation is stated too.
    for (case, value, first, second) in [
        (DIRICHLET, "152/15", "-212/45", Some("77/18")),
        (BEAM, "4027/30", "4831/60", None),
        (PLATE, "62851/225", "1237/90", None),
        (STRING, "-5783/1575", "416/35", None),
        (MEMBRANE, "-2903/360", "-31/16", None),
    ] {
        let own = Inserted::of(&case);
        let g = &own.functional.space.graph;
        let whole = own.exactly(&own.whole());
        let conditions = g.add(&[own.exactly(&own.by_conditions()), own.at_corners().1]);
        assert_eq!(own.said(whole, 0), value, "{}", case.model);
        assert_eq!(own.said(whole, 1), first, "{}", case.model);
        assert_eq!(own.said(conditions, 0), first, "{}", case.model);
        let twice = own.said(conditions, 1);
        assert_eq!(twice, own.said(whole, 2), "{}", case.model);
        assert!(second.is_none_or(|second| twice == second), "{twice}");
    }
}

/// S-F04: without the corners the first variation of the plate would be 756/5 less.
#[test]
fn a_plate_has_forces_at_its_corners() {
    let own = Inserted::of(&PLATE);
    let (coefficients, sum) = own.at_corners();
    assert_eq!(own.said(sum, 0), "756/5");
    let wanted = [
        ("x = a, y = b", "378/5"),
        ("x = a, y = 0", "-252/5"),
        ("x = 0, y = b", "42/5"),
        ("x = 0, y = 0", "0"),
    ];
    assert_eq!(coefficients.len(), wanted.len());
    for (place, value) in wanted {
        let (one, two) = place.split_once(", ").unwrap();
        let turned = format!("{two}, {one}");
        let found = coefficients.get(place).or(coefficients.get(&turned));
        assert_eq!(found.map(String::as_str), Some(value), "{place}");
    }
}

/// S-F02.
#[test]
fn the_area_of_a_surface_and_its_variations_are_those_of_the_reference() {
    let own = Inserted::of(&AREA);
    let (whole, conditions) = (own.whole(), own.by_conditions());
    for (terms, derivatives, wanted) in [
        (&whole, 0, 1.590207249140371),
        (&whole, 1, 0.1406809537044942),
        (&whole, 2, 0.3705547781418357),
        (&conditions, 0, 0.1406809537044942),
        (&conditions, 1, 0.3705547781418357),
    ] {
        let found = own.nearly(terms, derivatives);
        let off = (found / wanted - 1.0).abs();
        assert!(off < 1e-12, "{found} and not {wanted}");
    }
}

/// S-F02: Scherk 1834 and the helicoid; x² − y² is none.
#[test]
fn surfaces_of_least_area_are_those_of_the_literature() {
    let own = Inserted::of(&AREA);
    let (space, g) = (&*own.functional.space, &own.functional.space.graph);
    let (field, _) = *own.pairs.last().unwrap();
    let euler = variation(&own.functional).unwrap().euler[0].1;
    let residual = |surface: &str| space.put(euler, &[(field, written(&own.functional, surface))]);
    assert!(space.vanish(&[residual("log(cos(x)/cos(y))")]));
    assert!(space.vanish(&[residual("atan(y/x)")]));
    assert!(!space.vanish(&[residual("log(cos(x) cos(y))")]));
    // The left side −8 x² + 8 y² times the factor −(1 + u,x² + u,y²)^(−3/2).
    let wanted = written(
        &own.functional,
        "(8 x^2 - 8 y^2)/((1 + 4 x^2 + 4 y^2) sqrt(1 + 4 x^2 + 4 y^2))",
    );
    assert!(space.vanish(&[g.sub(residual("x^2 - y^2"), wanted)]));
}
