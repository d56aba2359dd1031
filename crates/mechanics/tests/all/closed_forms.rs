//! Accelerations and multipliers against closed forms derived by hand (T1 §1).
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_mechanics::characteristics;
use chetaev_mechanics::formulations::Basis;
use chetaev_mechanics::sample::admissible_point;
use chetaev_mechanics::{
    Characteristics, Equations, Formulation, MotionTerms, System, SystemParts,
};
use chetaev_symbolic::{Expr, Graph};
use std::sync::Arc;

struct Jet<'g>(&'g Graph);

impl Jet<'_> {
    fn s(&self, name: &str) -> Expr {
        let order = name.chars().filter(|&c| c == '\'').count() as u32;
        self.0.symbol(name.trim_end_matches('\''), order)
    }
    fn half_squares(&self, mass: Expr, names: &[&str]) -> Expr {
        let squares: Vec<Expr> = names.iter().map(|n| self.0.powi(self.s(n), 2)).collect();
        let half = self.0.div(mass, self.0.integer(2));
        self.0.mul(&[half, self.0.add(&squares)])
    }
}

fn parts(coordinates: &[&str], lagrangian: Expr, constraints: &[(&str, Expr)]) -> SystemParts {
    SystemParts {
        coordinates: coordinates.iter().map(|c| c.to_string()).collect(),
        lagrangian: Some(lagrangian),
        constraints: constraints
            .iter()
            .map(|(n, f)| (n.to_string(), *f))
            .collect(),
        ..SystemParts::default()
    }
}

fn skate(g: &Graph) -> SystemParts {
    let j = Jet(g);
    let (m, inertia) = (j.s("m"), j.s("J"));
    let slope = g.mul(&[m, j.s("G"), j.s("x")]);
    let lagrangian = g.add(&[
        j.half_squares(m, &["x'", "y'"]),
        j.half_squares(inertia, &["phi'"]),
        slope,
    ]);
    let f = g.sub(
        g.mul(&[j.s("x'"), g.sin(j.s("phi"))]),
        g.mul(&[j.s("y'"), g.cos(j.s("phi"))]),
    );
    parts(&["x", "y", "phi"], lagrangian, &[("blade", f)])
}

fn appell_hamel(g: &Graph) -> SystemParts {
    let j = Jet(g);
    let m = j.s("m");
    let lagrangian = g.sub(
        j.half_squares(m, &["x'", "y'", "z'"]),
        g.mul(&[m, j.s("g"), j.s("z")]),
    );
    let rho = g.sqrt(g.add(&[g.powi(j.s("x'"), 2), g.powi(j.s("y'"), 2)]));
    let f = g.sub(j.s("z'"), g.mul(&[j.s("a"), rho]));
    parts(&["x", "y", "z"], lagrangian, &[("cone", f)])
}

fn derive(system: &System, formulation: &dyn Formulation) -> (MotionTerms, Equations) {
    let terms = MotionTerms::new(system);
    let selection = characteristics::select(system, &terms).unwrap();
    let basis = Basis {
        system,
        terms: &terms,
        selection: &selection,
        characteristics: None,
    };
    let equations = formulation.equations(&basis).unwrap();
    (terms, equations)
}

/// Largest difference between `a` and `b` at ten admissible states.
fn gap(system: &System, terms: &MotionTerms, a: &[Expr], b: &[Expr]) -> f64 {
    let g = &system.graph;
    let mut largest: f64 = 0.0;
    for seed in 0..10 {
        let point = admissible_point(system, terms, seed).unwrap();
        let value = |e: &[Expr]| g.evaluate_f64(e, &|s| point.get(&s).copied()).unwrap();
        for (x, y) in value(a).iter().zip(value(b)) {
            largest = largest.max((x - y).abs() / (1.0 + y.abs()));
        }
    }
    largest
}

#[test]
fn skate_multiplier_is_minus_m_u_phi_rate() {
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), skate(&g)).unwrap();
    let (terms, equations) = derive(&system, &chetaev_mechanics::formulations::Routh);
    let j = Jet(&g);
    let u = g.add(&[
        g.mul(&[j.s("x'"), g.cos(j.s("phi"))]),
        g.mul(&[j.s("y'"), g.sin(j.s("phi"))]),
    ]);
    let gravity = g.mul(&[j.s("m"), j.s("G"), g.sin(j.s("phi"))]);
    let expected = g.neg(g.add(&[g.mul(&[j.s("m"), u, j.s("phi'")]), gravity]));
    assert!(gap(&system, &terms, &[equations.multipliers[0].1], &[expected]) < 1e-12);
}

#[test]
fn appell_hamel_multiplier_is_constant() {
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), appell_hamel(&g)).unwrap();
    let (terms, equations) = derive(&system, &chetaev_mechanics::formulations::Routh);
    let j = Jet(&g);
    let slope = g.add(&[g.one(), g.powi(j.s("a"), 2)]);
    let expected = g.div(g.mul(&[j.s("m"), j.s("g")]), slope);
    assert!(gap(&system, &terms, &[equations.multipliers[0].1], &[expected]) < 1e-12);
}

#[test]
fn maggi_agrees_with_routh_in_every_chart() {
    for build in [skate as fn(&Graph) -> SystemParts, appell_hamel] {
        let g = Arc::new(Graph::new());
        let system = System::new(g.clone(), build(&g)).unwrap();
        let (terms, routh) = derive(&system, &chetaev_mechanics::formulations::Routh);
        for dependent in 0..2 {
            let selection = chetaev_mechanics::Selection {
                rows: vec![0],
                dependent: vec![dependent],
            };
            let chart =
                Characteristics::independent_velocities(&system, &terms, &selection).unwrap();
            let basis = Basis {
                system: &system,
                terms: &terms,
                selection: &selection,
                characteristics: Some(chart),
            };
            let maggi = chetaev_mechanics::formulations::Maggi
                .equations(&basis)
                .unwrap();
            assert!(gap(&system, &terms, &maggi.accelerations, &routh.accelerations) < 1e-11);
        }
    }
}

#[test]
fn quasi_velocities_give_the_skate_in_blade_form() {
    let g = Arc::new(Graph::new());
    let j = Jet(&g);
    let mut parts = skate(&g);
    let u = g.add(&[
        g.mul(&[j.s("x'"), g.cos(j.s("phi"))]),
        g.mul(&[j.s("y'"), g.sin(j.s("phi"))]),
    ]);
    parts.quasi_velocities = vec![("u".into(), u), ("w".into(), j.s("phi'"))];
    let system = System::new(g.clone(), parts).unwrap();
    let (_, equations) = derive(&system, &chetaev_mechanics::formulations::Maggi);
    // u' = G cos(phi), w' = 0 (T1 S1).
    let point = |s| match g.symbol_text(s).as_str() {
        "phi" => Some(0.7),
        "G" => Some(3.0),
        "u" => Some(1.3),
        "w" => Some(-0.4),
        _ => Some(1.7),
    };
    let values = g.evaluate_f64(&equations.rates(), &point).unwrap();
    assert!((values[0] - 3.0 * 0.7f64.cos()).abs() < 1e-12);
    assert!(values[1].abs() < 1e-12);
}

/// The factor of the root varies by nine orders of magnitude from place to place, and with it the gradient.
#[test]
fn states_are_found_where_gradients_are_of_usual_size_nowhere() {
    let g = Arc::new(Graph::new());
    let j = Jet(&g);
    let lagrangian = j.half_squares(g.one(), &["x'", "y'", "z'"]);
    let steep = g.powi(g.mul(&[g.integer(8), j.s("x")]), 10);
    let squares = ["x'", "y'"].map(|name| g.powi(j.s(name), 2));
    let root = g.sqrt(g.add(&[squares[0], squares[1], g.one()]));
    let factor = g.add(&[g.one(), steep]);
    let f = g.sub(j.s("z'"), g.mul(&[factor, root]));
    let system = System::new(
        g.clone(),
        parts(&["x", "y", "z"], lagrangian, &[("steep", f)]),
    )
    .unwrap();
    let terms = MotionTerms::new(&system);
    let size = g.mul(&[factor, root]);
    for seed in 0..10 {
        let point = admissible_point(&system, &terms, seed).unwrap();
        let values = g
            .evaluate_f64(&[f, size], &|s| point.get(&s).copied())
            .unwrap();
        assert!(values[0].abs() <= 1e-10 * values[1], "{values:?}");
    }
}
