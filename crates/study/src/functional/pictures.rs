//! Ritz's method in the report: how the values converge, and the field.

use super::typesetting::in_print;
use chetaev_functionals::polynomial::Polynomial;
use chetaev_functionals::ritz::{Approximation, Asked};
use chetaev_functionals::Study;
use chetaev_report::data::{Cell, Figure, Map, Series, Table, TableRow};
use chetaev_symbolic::rational::to_f64;

/// Points of a curve, and cells of a picture along a side.
const POINTS: usize = 101;
const CELLS: usize = 81;

fn approximations(study: &Study) -> Option<(&Asked, &[Approximation])> {
    let all = &study.approximations[..];
    let asked = study.problem.ritz.as_ref().filter(|_| !all.is_empty())?;
    Some((asked, all))
}

/// The convergence of the value and of the errors; in one dimension the field too.
pub(super) fn figures(study: &Study) -> Vec<Figure> {
    let Some((asked, all)) = approximations(study) else {
        return Vec::new();
    };
    let claim = Some(format!("functional.ritz#{}", study.problem.functional.name));
    let degrees: Vec<f64> = all.iter().map(|own| f64::from(own.degree)).collect();
    let mut found = Vec::new();
    let is_exact = asked
        .points
        .iter()
        .all(|point| all.iter().all(|own| error(own, point) == 0.0));
    if !is_exact && all.len() > 1 {
        let series = asked.points.iter().map(|point| Series {
            name: point.written.clone(),
            values: all.iter().map(|own| error(own, point).max(1e-17)).collect(),
            description: Some(format!("closed solution: {}", to_f64(&point.value))),
            ..Series::default()
        });
        found.push(Figure {
            title: "Convergence of Ritz's method".into(),
            explanation: vec![
                "The relative error at the stated points over the degree of the free polynomial by each variable; an error of zero is drawn as 1e-17.".into(),
            ],
            horizontal: "degree".into(),
            abscissae: degrees.clone(),
            series: series.collect(),
            logarithmic_vertical: true,
            marks: true,
            claim: claim.clone(),
            ..Figure::default()
        });
    }
    if study.problem.functional.space.coordinates.len() == 1 {
        found.extend(curve(study, all, claim));
    }
    found
}

/// The stationary polynomials, degree by degree, with their values at the stated points.
pub(super) fn table(study: &Study) -> Option<Table> {
    let (asked, all) = approximations(study)?;
    let mut headings = vec!["Degree".to_owned(), "Unknowns".to_owned()];
    for point in &asked.points {
        headings.push(point.written.clone());
        headings.push("Relative error".to_owned());
    }
    let rows = all.iter().map(|own| {
        let mut cells: Vec<Cell> = vec![
            own.degree.to_string().as_str().into(),
            own.unknowns.to_string().as_str().into(),
        ];
        for point in &asked.points {
            let known = own.fields.iter().find(|(c, _)| *c == point.component);
            let value = known.map(|(_, polynomial)| polynomial.exact(&point.at));
            let error = error(own, point);
            let value = value.map_or_else(String::new, |value| {
                if error == 0.0 {
                    value.to_string()
                } else {
                    format!("{:.9e}", to_f64(&value))
                }
            });
            cells.push(value.as_str().into());
            let error = if error == 0.0 {
                "0".to_owned()
            } else {
                format!("{error:.1e}")
            };
            cells.push(error.as_str().into());
        }
        TableRow {
            cells,
            is_marked: false,
        }
    });
    Some(Table {
        id: "ritz".into(),
        title: "Ritz's method".into(),
        explanation: vec![
            "For each degree by each variable: how many coefficients are determined, and the stationary polynomial at the stated \
             points, compared with the closed solution. Integrals and elimination are exact."
                .into(),
        ],
        headings,
        rows: rows.collect(),
        ..Table::default()
    })
}

fn error(own: &Approximation, point: &chetaev_functionals::ritz::Point) -> f64 {
    let known = own.fields.iter().find(|(c, _)| *c == point.component);
    known.map_or(f64::NAN, |(_, polynomial)| {
        let difference = to_f64(&(polynomial.exact(&point.at) - &point.value)).abs();
        let size = to_f64(&point.value).abs();
        if size > 0.0 {
            difference / size
        } else {
            difference
        }
    })
}

/// The ends of the box as numbers.
fn ends(study: &Study) -> Option<Vec<(String, f64, f64)>> {
    let f = &study.problem.functional;
    let asked = study.problem.ritz.as_ref()?;
    let number = |e| {
        let e = chetaev_functionals::ritz::with_values(f, asked, e);
        f.space.graph.as_number(e).map(to_f64)
    };
    let own = f.intervals.iter().map(|interval| {
        let name = f.space.coordinates.get(interval.axis)?.name.clone();
        Some((name, number(interval.lower)?, number(interval.upper)?))
    });
    own.collect()
}

fn name(study: &Study, component: usize) -> String {
    study.problem.functional.space.component_at(component).name
}

fn curve(study: &Study, all: &[Approximation], claim: Option<String>) -> Option<Figure> {
    let ends = ends(study)?;
    let [(variable, lower, upper)] = &ends[..] else {
        return None;
    };
    let at = |i: usize| lower + (upper - lower) * i as f64 / (POINTS - 1) as f64;
    let abscissae: Vec<f64> = (0..POINTS).map(at).collect();
    let series = all.iter().flat_map(|own| {
        own.fields.iter().map(|(component, polynomial)| Series {
            name: format!("{}, degree {}", name(study, *component), own.degree),
            values: abscissae.iter().map(|&x| polynomial.value(&[x])).collect(),
            ..Series::default()
        })
    });
    Some(Figure {
        title: "The field".into(),
        explanation: vec!["Ritz's polynomials along the interval.".into()],
        horizontal: variable.clone(),
        series: series.collect(),
        abscissae: abscissae.clone(),
        claim,
        ..Figure::default()
    })
}

/// The field of the highest degree on the rectangle.
pub(super) fn maps(study: &Study) -> Vec<Map> {
    let Some((_, all)) = approximations(study) else {
        return Vec::new();
    };
    let (Some(last), Some(ends)) = (all.last(), ends(study)) else {
        return Vec::new();
    };
    let [horizontal, vertical] = &ends[..] else {
        return Vec::new();
    };
    let values = |polynomial: &Polynomial| -> Vec<f64> {
        let at = |(_, lower, upper): &(String, f64, f64), i: usize| {
            lower + (upper - lower) * i as f64 / (CELLS - 1) as f64
        };
        let cells = (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| (i, j)));
        let all: Vec<f64> = cells
            .map(|(i, j)| polynomial.value(&[at(horizontal, i), at(vertical, j)]))
            .collect();
        // What is rounded off where the field is zero is no value of it.
        let most = all
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        all.into_iter()
            .map(|value| {
                if value.abs() < 1e-10 * most {
                    0.0
                } else {
                    value
                }
            })
            .collect()
    };
    let own = last.fields.iter().map(|(component, polynomial)| Map {
        title: in_print(&format!("{} by Ritz's method", name(study, *component))),
        explanation: vec![format!(
            "The stationary polynomial of degree {} by each variable, with {} unknowns.",
            last.degree, last.unknowns
        )],
        horizontal: horizontal.clone(),
        vertical: vertical.clone(),
        columns: CELLS,
        values: values(polynomial),
        ..Map::default()
    });
    own.collect()
}
