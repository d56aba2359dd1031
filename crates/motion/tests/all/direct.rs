//! Accelerations without multipliers, by quasi-velocities without singular places.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_compile::{backend, Evaluator};
use chetaev_mechanics::{MotionTerms, System, SystemParts};
use chetaev_motion::{Binding, NumericSystem};
use chetaev_symbolic::{Expr, Graph};
use std::sync::Arc;

/// L = ½ (x'² + y'²) + ½ φ'² + 4 x with the blade x' sin φ = y' cos φ.
fn skate(g: &Graph) -> SystemParts {
    let [x, phi] = ["x", "phi"].map(|name| g.symbol(name, 0));
    let [vx, vy, w] = ["x", "y", "phi"].map(|name| g.symbol(name, 1));
    let squares: Vec<Expr> = [vx, vy, w].iter().map(|&v| g.powi(v, 2)).collect();
    let kinetic = g.div(g.add(&squares), g.integer(2));
    let blade = g.sub(g.mul(&[vx, g.sin(phi)]), g.mul(&[vy, g.cos(phi)]));
    SystemParts {
        coordinates: ["x", "y", "phi"].map(String::from).to_vec(),
        lagrangian: Some(g.add(&[kinetic, g.mul(&[g.integer(4), x])])),
        constraints: vec![("blade".into(), blade)],
        ..SystemParts::default()
    }
}

/// The speed u along the blade grows as u' = 4 cos φ, and the heading turns evenly: x'' = u' cos φ − u φ' sin φ. Neither x' nor
/// y' serves as an independent velocity for every heading.
#[test]
fn a_skate_has_accelerations_at_every_heading() {
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), skate(&g)).unwrap();
    let terms = MotionTerms::new(&system);
    let binding = Binding::new(&system).unwrap();
    let numeric = NumericSystem::new(&system, &terms, &binding).unwrap();
    let program = numeric.rates_program(&[0]).unwrap();
    assert!(!program.to_string().contains("solve"), "{program}");
    let code = backend(program).unwrap();
    let mut workspace = code.workspace();
    code.prepare(&[], &mut workspace).unwrap();
    let quarter = std::f64::consts::FRAC_PI_2;
    for phi in [0.0, 0.7, quarter, -2.0 * quarter, 5.0] {
        let (u, w) = (1.5, -0.4);
        let (sin, cos) = f64::sin_cos(phi);
        let inputs = [0.0, 0.3, -0.2, phi, u * cos, u * sin, w];
        let mut rates = [0.0; 6];
        code.evaluate(&inputs, &mut workspace, &mut rates).unwrap();
        let gain = 4.0 * cos;
        let expected = [gain * cos - u * w * sin, gain * sin + u * w * cos, 0.0];
        for (found, expected) in rates[3..].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{phi}: {rates:?}");
        }
    }
}

/// ½ (x'² + y'² + z'²) − x − 2 y − 4 z under two constraints with constant coefficients.
fn held(g: &Graph, rows: [[i64; 3]; 2]) -> SystemParts {
    let places = ["x", "y", "z"].map(|name| g.symbol(name, 0));
    let velocities = ["x", "y", "z"].map(|name| g.symbol(name, 1));
    let along = |row: [i64; 3], of: [Expr; 3]| {
        let terms = row.iter().zip(of);
        let terms: Vec<Expr> = terms.map(|(&c, e)| g.mul(&[g.integer(c), e])).collect();
        g.add(&terms)
    };
    let squares = g.add(&velocities.map(|v| g.powi(v, 2)));
    let kinetic = g.div(squares, g.integer(2));
    let [a, b] = rows.map(|row| along(row, velocities));
    SystemParts {
        coordinates: ["x", "y", "z"].map(String::from).to_vec(),
        lagrangian: Some(g.sub(kinetic, along([1, 2, 4], places))),
        constraints: vec![("a".into(), a), ("b".into(), b)],
        ..SystemParts::default()
    }
}

/// What two constraints leave is the direction d = a × b, so that the accelerations are d (F·d)/(d·d), whichever speeds are taken:
/// also where one constraint makes two velocities equal and the other contains both.
#[test]
fn two_constraints_leave_the_direction_across_both() {
    let all = (0..27).map(|k| [k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1]);
    let all: Vec<[i64; 3]> = all.filter(|row| *row != [0; 3]).collect();
    for &a in &all {
        for &b in &all {
            let d = [0, 1, 2]
                .map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
            if d == [0; 3] {
                continue;
            }
            let g = Arc::new(Graph::new());
            let system = System::new(g.clone(), held(&g, [a, b])).unwrap();
            let terms = MotionTerms::new(&system);
            let binding = Binding::new(&system).unwrap();
            let numeric = NumericSystem::new(&system, &terms, &binding).unwrap();
            let code = backend(numeric.rates_program(&[0, 1]).unwrap()).unwrap();
            let mut workspace = code.workspace();
            code.prepare(&[], &mut workspace).unwrap();
            let [vx, vy, vz] = d.map(|x| x as f64);
            let mut rates = [0.0; 6];
            let inputs = [0.0, 0.3, -0.2, 0.7, vx, vy, vz];
            code.evaluate(&inputs, &mut workspace, &mut rates).unwrap();
            let work: i64 = -(d[0] + 2 * d[1] + 4 * d[2]);
            let square: i64 = d.iter().map(|x| x * x).sum();
            for (found, own) in rates[3..].iter().zip(d) {
                let expected = (work * own) as f64 / square as f64;
                assert!((found - expected).abs() < 1e-13, "{a:?} {b:?}: {rates:?}");
            }
        }
    }
}
