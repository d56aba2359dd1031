//! Values and first variations of functionals for given fields, against values that were computed by two other ways: central
//! differences of the functional, and Euler expressions written by hand (reference cases S-F07 to S-F12).

use crate::table::{loaded_text, row_text};
use chetaev_functionals::functional::{Functional, Side};
use chetaev_functionals::notation::parse;
use chetaev_functionals::variation::{variation, Trace};
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

struct Case {
    id: &'static str,
    row: &'static str,
    d: &'static str,
    nonlinear: &'static str,
    beta: &'static str,
    fields: &'static [(&'static str, &'static str)],
    variation: &'static [(&'static str, &'static str)],
    traction: &'static [(&'static str, &'static [&'static str])],
    value: f64,
    variation_value: f64,
    dual: (&'static str, f64),
}

const CASES: &[Case] = &[
    Case {
        id: "S-F07",
        row: "p3pb",
        d: "1",
        nonlinear: "1",
        beta: "2/5",
        fields: &[
            ("u_1", "x_1^2/10 + x_1/5 + 1/20"),
            ("s_11", "1/4 - x_1/8"),
            ("e_11", "x_1/12 + 1/6"),
            ("sstar_11", "x_1/20 + 1/10"),
            ("F_1", "1 - x_1/2"),
            ("ubar_1", "1/30"),
        ],
        variation: &[
            ("u_1", "x_1^2 - x_1 + 1"),
            ("s_11", "x_1 - 1/3"),
            ("e_11", "x_1 + 1"),
            ("sstar_11", "2 - x_1"),
        ],
        traction: &[("S_s", &["1/5"])],
        value: -0.14505600782135017,
        variation_value: -0.48593022463688396,
        dual: ("p3cb", 0.14505600782135017),
    },
    Case {
        id: "S-F08",
        row: "p2pb",
        d: "1",
        nonlinear: "1",
        beta: "2/5",
        fields: &[
            ("u_1", "x_1^2/10 + x_1/5 + 1/20"),
            ("s_11", "1/4 - x_1/8"),
            ("e_11", "x_1/12 + 1/6"),
            ("sstar_11", "x_1/20 + 1/10"),
            ("F_1", "1 - x_1/2"),
            ("ubar_1", "1/30"),
        ],
        variation: &[
            ("u_1", "x_1^2 - x_1 + 1"),
            ("s_11", "x_1 - 1/3"),
            ("e_11", "x_1 + 1"),
            ("sstar_11", "2 - x_1"),
        ],
        traction: &[("S_s", &["1/5"])],
        value: -0.13827663775313445,
        variation_value: -0.5049702557649132,
        dual: ("p2cb", 0.13805086948363404),
    },
    Case {
        id: "S-F09",
        row: "p3p0",
        d: "2",
        nonlinear: "0",
        beta: "0",
        fields: &[
            ("u_1", "x_1 x_2/5 + x_1/10 + 1/20"),
            ("u_2", "x_1^2/20 - 3 x_2/20 - 1/10"),
            ("s_11", "x_1/10 - x_2/20 + 1/5"),
            ("s_22", "x_1 x_2/5 - 1/10"),
            ("s_12", "-x_1/10 + 3 x_2/20"),
            ("e_11", "x_1/10 + 1/20"),
            ("e_22", "x_2/10 - 1/5"),
            ("e_12", "x_1 x_2/10"),
            ("sstar_11", "x_2/20 + 1/10"),
            ("sstar_22", "x_1/20 - 1/10"),
            ("sstar_12", "1/20"),
            ("F_1", "1/2"),
            ("ubar_1", "1/50"),
            ("F_2", "-x_1"),
            ("ubar_2", "x_2/50"),
        ],
        variation: &[
            ("u_1", "x_1 x_2 + 1"),
            ("u_2", "x_1 - x_2^2"),
            ("s_11", "x_1 + x_2"),
            ("s_22", "1 - x_1"),
            ("s_12", "x_2"),
            ("e_11", "x_2"),
            ("e_22", "x_1 x_2"),
            ("e_12", "1 - x_2"),
            ("sstar_11", "x_1^2"),
            ("sstar_22", "x_2 + 1"),
            ("sstar_12", "x_1 - x_2"),
        ],
        traction: &[
            ("S_s", &["1/5", "x_2/10"]),
            ("low", &["1/10", "-1/20"]),
            ("high", &["x_1/5", "1/10"]),
        ],
        value: -0.19743401436944893,
        variation_value: -0.785402861624978,
        dual: ("p3c0", 0.19743401436944893),
    },
    Case {
        id: "S-F10",
        row: "p3p1",
        d: "2",
        nonlinear: "1",
        beta: "1",
        fields: &[
            ("u_1", "x_1 x_2/5 + x_1/10 + 1/20"),
            ("u_2", "x_1^2/20 - 3 x_2/20 - 1/10"),
            ("s_11", "x_1/10 - x_2/20 + 1/5"),
            ("s_22", "x_1 x_2/5 - 1/10"),
            ("s_12", "-x_1/10 + 3 x_2/20"),
            ("e_11", "x_1/10 + 1/20"),
            ("e_22", "x_2/10 - 1/5"),
            ("e_12", "x_1 x_2/10"),
            ("sstar_11", "x_2/20 + 1/10"),
            ("sstar_22", "x_1/20 - 1/10"),
            ("sstar_12", "1/20"),
            ("F_1", "1/2"),
            ("ubar_1", "1/50"),
            ("F_2", "-x_1"),
            ("ubar_2", "x_2/50"),
        ],
        variation: &[
            ("u_1", "x_1 x_2 + 1"),
            ("u_2", "x_1 - x_2^2"),
            ("s_11", "x_1 + x_2"),
            ("s_22", "1 - x_1"),
            ("s_12", "x_2"),
            ("e_11", "x_2"),
            ("e_22", "x_1 x_2"),
            ("e_12", "1 - x_2"),
            ("sstar_11", "x_1^2"),
            ("sstar_22", "x_2 + 1"),
            ("sstar_12", "x_1 - x_2"),
        ],
        traction: &[
            ("S_s", &["1/5", "x_2/10"]),
            ("low", &["1/10", "-1/20"]),
            ("high", &["x_1/5", "1/10"]),
        ],
        value: -0.17309805814678406,
        variation_value: -0.5566389283194172,
        dual: ("p3c1", 0.17309805814678406),
    },
    Case {
        id: "S-F11",
        row: "p3pb",
        d: "2",
        nonlinear: "1",
        beta: "2/5",
        fields: &[
            ("u_1", "x_1 x_2/5 + x_1/10 + 1/20"),
            ("u_2", "x_1^2/20 - 3 x_2/20 - 1/10"),
            ("s_11", "x_1/10 - x_2/20 + 1/5"),
            ("s_22", "x_1 x_2/5 - 1/10"),
            ("s_12", "-x_1/10 + 3 x_2/20"),
            ("e_11", "x_1/10 + 1/20"),
            ("e_22", "x_2/10 - 1/5"),
            ("e_12", "x_1 x_2/10"),
            ("sstar_11", "x_2/20 + 1/10"),
            ("sstar_22", "x_1/20 - 1/10"),
            ("sstar_12", "1/20"),
            ("F_1", "1/2"),
            ("ubar_1", "1/50"),
            ("F_2", "-x_1"),
            ("ubar_2", "x_2/50"),
        ],
        variation: &[
            ("u_1", "x_1 x_2 + 1"),
            ("u_2", "x_1 - x_2^2"),
            ("s_11", "x_1 + x_2"),
            ("s_22", "1 - x_1"),
            ("s_12", "x_2"),
            ("e_11", "x_2"),
            ("e_22", "x_1 x_2"),
            ("e_12", "1 - x_2"),
            ("sstar_11", "x_1^2"),
            ("sstar_22", "x_2 + 1"),
            ("sstar_12", "x_1 - x_2"),
        ],
        traction: &[
            ("S_s", &["1/5", "x_2/10"]),
            ("low", &["1/10", "-1/20"]),
            ("high", &["x_1/5", "1/10"]),
        ],
        value: -0.18279463188038297,
        variation_value: -0.6195472883027536,
        dual: ("p3cb", 0.18279463188038297),
    },
    Case {
        id: "S-F12",
        row: "p4pb",
        d: "2",
        nonlinear: "0",
        beta: "3/4",
        fields: &[
            ("u_1", "x_1 x_2/5 + x_1/10 + 1/20"),
            ("u_2", "x_1^2/20 - 3 x_2/20 - 1/10"),
            ("s_11", "x_1/10 - x_2/20 + 1/5"),
            ("s_22", "x_1 x_2/5 - 1/10"),
            ("s_12", "-x_1/10 + 3 x_2/20"),
            ("e_11", "x_1/10 + 1/20"),
            ("e_22", "x_2/10 - 1/5"),
            ("e_12", "x_1 x_2/10"),
            ("sstar_11", "x_2/20 + 1/10"),
            ("sstar_22", "x_1/20 - 1/10"),
            ("sstar_12", "1/20"),
            ("F_1", "1/2"),
            ("ubar_1", "1/50"),
            ("F_2", "-x_1"),
            ("ubar_2", "x_2/50"),
        ],
        variation: &[
            ("u_1", "x_1 x_2 + 1"),
            ("u_2", "x_1 - x_2^2"),
            ("s_11", "x_1 + x_2"),
            ("s_22", "1 - x_1"),
            ("s_12", "x_2"),
            ("e_11", "x_2"),
            ("e_22", "x_1 x_2"),
            ("e_12", "1 - x_2"),
            ("sstar_11", "x_1^2"),
            ("sstar_22", "x_2 + 1"),
            ("sstar_12", "x_1 - x_2"),
        ],
        traction: &[
            ("S_s", &["1/5", "x_2/10"]),
            ("low", &["1/10", "-1/20"]),
            ("high", &["x_1/5", "1/10"]),
        ],
        value: -0.21212922496170206,
        variation_value: -0.48124172130091875,
        dual: ("p4cb", 0.21212922496170206),
    },
];

/// A row on the unit interval or square: S_u is x_1 = 0, tractions are given on the other faces.
fn on_a_box(row: &str, case: &Case) -> Functional {
    let mut text = row_text(row).replace("energy-abstract", "energy-cosh");
    let two = case.d == "2";
    let others = if two {
        "intervals = { x_1 = [0, 1], x_2 = [0, 1] }"
    } else {
        "intervals = { x_1 = [0, 1] }"
    };
    // The tractions are given on several faces.
    text.push_str(&format!(
        "\n[domain]\n{others}\n[data]\nPbar = \"vector\"\n"
    ));
    let density = |name: &str| {
        let line = text
            .lines()
            .find(|line| line.starts_with(&format!("{name} = ")))
            .unwrap();
        line.split_once(" = ").unwrap().1.to_owned()
    };
    let (on_u, on_s) = (density("S_u"), density("S_s"));
    let faces = [
        ("S_u", &on_u, "x_1 = 0"),
        ("S_s", &on_s, "x_1 = 1"),
        ("low", &on_s, "x_2 = 0"),
        ("high", &on_s, "x_2 = 1"),
    ];
    let mut boundary = String::from("[boundary]\n");
    for (name, own, at) in faces.iter().take(if two { 4 } else { 2 }) {
        boundary.push_str(&format!("{name} = {{ at = \"{at}\", density = {own} }}\n"));
    }
    let start = text.find("[boundary]").unwrap();
    let end = text[start + 1..].find("\n[").unwrap() + start + 1;
    text.replace_range(start..end, &boundary);
    // Relations to other rows have no box.
    for section in ["[duality]", "[descent]", "[degenerations"] {
        while let Some(start) = text.find(section) {
            let end = text[start + 1..]
                .find("\n[")
                .map_or(text.len(), |at| at + start + 2);
            text.replace_range(start..end, "");
        }
    }
    loaded_text(row, &text, &[("d", case.d), ("nonlinear", case.nonlinear)]).functional
}

fn polynomial(functional: &Functional, text: &str) -> Expr {
    let node = parse(text, &functional.scope, &mut Vec::new()).unwrap();
    functional.scope.value(&node, &BTreeMap::new())
}

struct Inserted<'f> {
    functional: &'f Functional,
    case: &'f Case,
    fields: BTreeMap<String, Expr>,
}

impl Inserted<'_> {
    /// The value of an expression at a point, on a piece where its tractions are wanted.
    fn at(&self, e: Expr, piece: Option<&str>, point: &[f64]) -> f64 {
        let space = &*self.functional.space;
        let g = &space.graph;
        let traction =
            piece.and_then(|name| self.case.traction.iter().find(|(own, _)| *own == name));
        let put = space.replace(space.explicit(e), &|symbol| {
            let jet = space.as_jet(symbol)?;
            let name = space.component_at(jet.component).name;
            let value = match (name.strip_prefix("Pbar_"), traction) {
                (Some(k), Some((_, all))) => {
                    polynomial(self.functional, all[k.parse::<usize>().unwrap() - 1])
                }
                _ => *self.fields.get(&name)?,
            };
            Some(space.totals(value, &jet.by))
        });
        let beta = polynomial(self.functional, self.case.beta);
        let values = g.evaluate_f64(&[put, beta], &|symbol| match g.symbol_name(symbol) {
            "x_1" => Some(point[0]),
            "x_2" => Some(point[1]),
            "beta" => Some(self.case.beta.split_once('/').map_or(0.0, |(a, b)| {
                a.parse::<f64>().unwrap() / b.parse::<f64>().unwrap()
            })),
            _ => None,
        });
        values.unwrap_or_else(|e| panic!("{e}"))[0]
    }

    /// Over the box, or over a piece.
    fn integral(&self, e: Expr, piece: Option<&str>) -> f64 {
        let side = piece
            .and_then(|name| self.functional.piece(name))
            .map(|piece| &piece.side);
        nodes(self.functional.space.dimensions(), side)
            .iter()
            .map(|(point, weight)| weight * self.at(e, piece, point))
            .sum()
    }

    fn value(&self) -> f64 {
        let pieces = self.functional.pieces.iter();
        self.integral(self.functional.density, None)
            + pieces
                .map(|p| self.integral(p.density, Some(&p.name)))
                .sum::<f64>()
    }

    /// The first variation by the Euler expressions, the natural conditions and the corners.
    fn first_variation(&self) -> f64 {
        let space = &*self.functional.space;
        let g = &space.graph;
        let own = variation(self.functional).unwrap();
        let of = |component: usize| {
            let component = space.component_at(component);
            let found = self
                .case
                .variation
                .iter()
                .find(|(name, _)| *name == component.name);
            let value = polynomial(self.functional, found.unwrap().1);
            g.mul(&[g.integer(component.multiplicity), value])
        };
        let mut sum = 0.0;
        for (component, value) in &own.euler {
            sum += self.integral(g.mul(&[*value, of(*component)]), None);
        }
        for on in &own.pieces {
            for condition in &on.conditions {
                let mut varied = of(condition.component);
                if let (Trace::Normal, Side::Flat { axis, .. }) = (
                    &condition.trace,
                    &self.functional.piece(&on.piece).unwrap().side,
                ) {
                    varied = space.total(varied, *axis);
                }
                sum += self.integral(g.mul(&[condition.value, varied]), Some(&on.piece));
            }
        }
        for corner in &own.corners {
            let mut point = vec![0.0; 2];
            for name in [&corner.pieces.0, &corner.pieces.1] {
                if let Side::Flat {
                    axis,
                    is_upper: true,
                    ..
                } = self.functional.piece(name).unwrap().side
                {
                    point[axis] = 1.0;
                }
            }
            let multiplicity = g.integer(space.component_at(corner.component).multiplicity);
            let varied = g.div(of(corner.component), multiplicity);
            sum += self.at(
                g.mul(&[corner.value, varied]),
                Some(&corner.pieces.0),
                &point,
            );
        }
        sum
    }
}

impl Inserted<'_> {
    /// The sum of cosh e − 1 − e s + s asinh s − √(1 + s²) + 1 over all components at a point.
    fn gap(&self, point: &[f64]) -> f64 {
        let of = |name: &str, component: &str| {
            let field = self.fields.get(&format!("{name}_{component}"));
            field.map(|value| self.at(*value, None, point))
        };
        let all = [("11", 1.0), ("22", 1.0), ("12", 2.0)];
        let own = all.into_iter().filter_map(|(component, count)| {
            let (e, s) = (of("e", component)?, of("s", component)?);
            Some(count * (e.cosh() - e * s + s * s.asinh() - s.hypot(1.0)))
        });
        own.sum()
    }
}

/// Nodes and weights over the unit square, or over a side of it.
pub(crate) fn nodes(dimensions: usize, side: Option<&Side>) -> Vec<(Vec<f64>, f64)> {
    let on_one = gauss();
    let mut points = vec![(vec![0.0; 2], 1.0)];
    if let Some(Side::Flat { axis, is_upper, .. }) = side {
        points[0].0[*axis] = if *is_upper { 1.0 } else { 0.0 };
    }
    let is_constant = |i: usize| matches!(side, Some(Side::Flat { axis, .. }) if *axis == i);
    for axis in (0..dimensions).filter(|i| !is_constant(*i)) {
        points = points
            .into_iter()
            .flat_map(|(point, weight)| {
                on_one.iter().map(move |(x, w)| {
                    let mut own = point.clone();
                    own[axis] = *x;
                    (own, weight * w)
                })
            })
            .collect();
    }
    points
}

/// Gauss's nodes and weights on the unit interval.
fn gauss() -> Vec<(f64, f64)> {
    const COUNT: usize = 16;
    let n = COUNT as f64;
    (0..COUNT)
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..50 {
                let (mut before, mut own) = (1.0, x);
                for k in 2..=COUNT {
                    let k = k as f64;
                    (before, own) = (own, ((2.0 * k - 1.0) * x * own - (k - 1.0) * before) / k);
                }
                slope = n * (x * own - before) / (x * x - 1.0);
                x -= own / slope;
            }
            ((1.0 + x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

fn inserted<'f>(functional: &'f Functional, case: &'f Case) -> Inserted<'f> {
    let fields = case.fields.iter();
    Inserted {
        functional,
        case,
        fields: fields
            .map(|(name, text)| (name.to_string(), polynomial(functional, text)))
            .collect(),
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-11 * (1.0 + b.abs())
}

#[test]
fn values_and_first_variations_are_those_of_the_references() {
    for case in CASES {
        let functional = on_a_box(case.row, case);
        let own = inserted(&functional, case);
        assert!(
            close(own.value(), case.value),
            "{}: {} against {}",
            case.id,
            own.value(),
            case.value
        );
        let varied = own.first_variation();
        assert!(
            close(varied, case.variation_value),
            "{}: {varied} against {}",
            case.id,
            case.variation_value
        );
        let dual = on_a_box(case.dual.0, case);
        let value = inserted(&dual, case).value();
        assert!(
            close(value, case.dual.1),
            "{}: {value} against {}",
            case.dual.0,
            case.dual.1
        );
    }
}

/// T4 §3: off solutions the value depends on β, by ∫ (A(e) − e:s + B(s)) where it is a factor of the density alone; where s = A'(e) that vanishes.
#[test]
fn the_value_depends_on_the_factor_off_solutions() {
    let with = |case: &Case, beta| Case { beta, ..*case };
    for case in CASES.iter().filter(|case| case.row == "p3pb") {
        let functional = on_a_box("p3pb", case);
        let value = |beta| inserted(&functional, &with(case, beta)).value();
        let own = inserted(&functional, case);
        let gap: f64 = nodes(functional.space.dimensions(), None)
            .iter()
            .map(|(point, weight)| weight * own.gap(point))
            .sum();
        assert!(gap > 1e-3, "{}", case.id);
        // From 2/5 to 3/4.
        assert!(
            close(value("3/4") - case.value, 7.0 / 20.0 * gap),
            "{}",
            case.id
        );
    }
}
