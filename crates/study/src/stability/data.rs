//! What was asked of a steady motion, as data for other programs: matrices in numbers, LaTeX, JSON.

use super::decimal::{enclosure, notation};
use super::{named_parts, Numbers, Stability};
use crate::state_space::{latex, Matrices};
use chetaev_stability::descriptor::Descriptor;
use chetaev_stability::hurwitz::Region;
use chetaev_stability::hurwitz::{Boundary, Crossing};
use chetaev_stability::question::Place;
use chetaev_symbolic::{Expr, Rational};
use serde_json::{json, Value};

impl Stability {
    /// All matrices in numbers, for other programs: those in all variables, with E, where they were asked for.
    pub fn matrices(&self) -> Matrices {
        let at = self.stated();
        let space = self.all.as_ref().map_or(&self.space, |own| &own.space);
        let (n, m) = (space.states.len(), space.inputs.len());
        let mut matrices: Vec<(String, Vec<Vec<f64>>, usize)> = [
            ("A", &space.a, n),
            ("B", &space.b, m),
            ("C", &space.c, n),
            ("D", &space.d, m),
        ]
        .into_iter()
        .map(|(name, rows, columns)| (name.to_owned(), self.numbers(rows, at), columns))
        .collect();
        if let Some(all) = &self.all {
            let left = self.numbers(&all.left, at);
            matrices.insert(0, ("E".into(), left, n));
        }
        for (name, rows) in self.parts.iter().flat_map(named_parts) {
            matrices.push((format!("{name}_second"), self.numbers(rows, at), rows.len()));
        }
        Matrices {
            matrices,
            names: vec![
                ("states".into(), space.states.clone()),
                ("inputs".into(), space.inputs.clone()),
                ("outputs".into(), space.outputs.clone()),
            ],
            title: format!(
                "{}, linear equations about the steady motion {}{}",
                self.system.name,
                self.motion.name,
                if self.all.is_some() {
                    ", in all variables: E z' = A z + B u"
                } else {
                    ""
                }
            ),
        }
    }

    /// The exact matrices as LaTeX.
    pub fn latex(&self) -> String {
        let (linear, space) = (&self.question.linear, &self.space);
        if let Some(Descriptor { left, space, .. }) = &self.all {
            let all: [(&str, &[Vec<Expr>]); 5] = [
                ("E", left),
                ("A", &space.a),
                ("B", &space.b),
                ("C", &space.c),
                ("D", &space.d),
            ];
            return latex(self.graph(), &all);
        }
        let mut all: Vec<(&str, &[Vec<Expr>])> = vec![
            ("E", &linear.left),
            ("F", &linear.right),
            ("A", &space.a),
            ("B", &space.b),
            ("C", &space.c),
            ("D", &space.d),
        ];
        all.extend(self.parts.iter().flat_map(named_parts));
        latex(self.graph(), &all)
    }

    /// The answer as JSON: variables, matrices as exact text, polynomial, eigenvalues, and over a range `critical` and `regions`.
    pub fn json(&self) -> Value {
        let g = self.graph();
        let linear = &self.question.linear;
        let exact = |rows: &[Vec<Expr>]| -> Value {
            let row = |row: &Vec<Expr>| row.iter().map(|&e| notation(g, e)).collect::<Vec<_>>();
            json!(rows.iter().map(row).collect::<Vec<_>>())
        };
        let pairs = |list: Vec<(f64, f64)>| {
            list.iter()
                .map(|(re, im)| json!([re, im]))
                .collect::<Vec<_>>()
        };
        let polynomial = self.question.polynomial.as_ref().map(|p| {
            json!({
                "coefficients": self.coefficients().iter().flatten().map(|&e| notation(g, e)).collect::<Vec<_>>(),
                "factors": self.question.spectrum.factors.iter().map(|(f, power)| json!({
                    "coefficients": f.iter().map(|&e| notation(g, e)).collect::<Vec<_>>(),
                    "multiplicity": power,
                })).collect::<Vec<_>>(),
                "zeros_of_family": p.zeros,
                "further_zeros": p.further_zeros,
            })
        });
        let mut value = json!({
            "system": self.system.name,
            "motion": self.motion.name,
            "variables": linear.names,
            "ignorable": linear.ignorable,
            "along": self.along.iter().map(|(name, e)| (name.clone(), json!(notation(g, *e)))).collect::<serde_json::Map<_, _>>(),
            "running": self.running.iter().map(|(name, e)| json!({"name": name, "rate": notation(g, *e)})).collect::<Vec<_>>(),
            "family": linear.family,
            "speeds": linear.speeds.iter().map(|(name, e)| json!({"name": name, "definition": notation(g, *e)})).collect::<Vec<_>>(),
            "E": exact(&linear.left),
            "F": exact(&linear.right),
            "inputs": self.space.inputs,
            "outputs": self.space.outputs,
            "A": exact(&self.space.a),
            "B": exact(&self.space.b),
            "C": exact(&self.space.c),
            "D": exact(&self.space.d),
            "second_order": self.parts.as_ref().map(|parts| {
                let parts = named_parts(parts).into_iter();
                parts.map(|(name, rows)| (name.to_owned(), exact(rows))).collect::<serde_json::Map<_, _>>()
            }),
            "characteristic_polynomial": polynomial,
            "eigenvalues": self.eigenvalues_at(self.stated_exactly()).map(|own| pairs(own.values)),
        });
        let enclosed = self.enclosed();
        if !enclosed.is_empty() {
            value["enclosed"] = json!(enclosed);
        }
        if let Some(all) = &self.all {
            value["all"] = json!({
                "variables": all.space.states,
                "inputs": all.space.inputs,
                "outputs": all.space.outputs,
                "E": exact(&all.left),
                "A": exact(&all.space.a),
                "B": exact(&all.space.b),
                "C": exact(&all.space.c),
                "D": exact(&all.space.d),
            });
        }
        if let Some(why) = self.numbers {
            value["numbers"] = json!(match why {
                Numbers::Asked => "asked",
                Numbers::TooLarge => "too large in symbols",
                Numbers::SteadyThere => "steady at these values alone",
            });
        }
        if let Some(range) = &self.range {
            value["parameter"] = json!(range.name);
            value["critical"] = match &self.ranges {
                None => Value::Null,
                Some(ranges) => ranges
                    .boundaries
                    .iter()
                    .map(|b| self.critical(&range.name, b))
                    .collect(),
            };
            value["regions"] = match &self.ranges {
                None => Value::Null,
                Some(ranges) => {
                    let region = |(r, is_absent): (&Region, &bool)| {
                        let place = match self.question.place_in(r) {
                            _ if *is_absent => "no motion",
                            Place::Left => "asymptotic",
                            Place::OnAxis => "spectral",
                            Place::Right => "unstable",
                            Place::NotLeft => "undecided",
                        };
                        let mut found = json!({"from": r.low.to_f64().value(), "to": r.high.to_f64().value(), "stability": place});
                        if place == "spectral" {
                            found["semisimple"] = json!(self.is_semisimple());
                        }
                        found
                    };
                    ranges
                        .regions
                        .iter()
                        .zip(&self.absent)
                        .map(region)
                        .collect()
                }
            };
            let table = self.table(range).into_iter();
            value["table"] = table
                .map(|(at, list)| json!({"value": at, "eigenvalues": list.map(|own| pairs(own.values))}))
                .collect();
        }
        value
    }

    /// Entries that are algebraic numbers, rounded in the matrices, with their enclosures.
    fn enclosed(&self) -> Vec<Value> {
        let (g, linear, space) = (self.graph(), &self.question.linear, &self.space);
        let all: [(&'static str, &[Vec<Expr>]); 6] = [
            ("E", &linear.left),
            ("F", &linear.right),
            ("A", &space.a),
            ("B", &space.b),
            ("C", &space.c),
            ("D", &space.d),
        ];
        let of_row = |name: &'static str, row: usize, entries: &[Expr]| -> Vec<Value> {
            let entries = entries.iter().enumerate();
            let found = entries.filter_map(|(column, &e)| Some((column, enclosure(g, e)?)));
            found
                .map(|(column, (low, high))| {
                    json!({"matrix": name, "row": row, "column": column, "enclosure": [low, high]})
                })
                .collect()
        };
        let of = |(name, rows): (&'static str, &[Vec<Expr>])| -> Vec<Value> {
            let rows = rows.iter().enumerate();
            rows.flat_map(|(at, row)| of_row(name, at, row)).collect()
        };
        all.into_iter().flat_map(of).collect()
    }

    fn critical(&self, name: &str, boundary: &Boundary) -> Value {
        let (low, high) = boundary.root.decimal_bounds();
        let kind = match boundary.crossing {
            Crossing::Zero => "zero",
            Crossing::ZeroTouching => "zero-touching",
            Crossing::Pair => "pair",
            Crossing::Pairs => "pairs",
            Crossing::Collision => "collision",
            Crossing::Infinity => "infinity",
            Crossing::Singular => "singular",
            Crossing::Touching => "touching",
        };
        let middle = (&boundary.root.low + &boundary.root.high) / Rational::from(2);
        let mut found = json!({"parameter": name, "value": middle.to_f64().value(), "enclosure": [low, high], "kind": kind});
        match self.first_lyapunov(boundary) {
            Some(Ok(own)) => {
                found["frequency"] = json!(own.frequency);
                found["first_lyapunov"] = json!(own.coefficient);
            }
            Some(Err(why)) => {
                found["first_lyapunov"] = Value::Null;
                found["undecided"] = json!(why.to_string());
            }
            None => {}
        }
        found
    }
}
