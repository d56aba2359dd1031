//! Constraints whose gradients are dependent wherever they hold, and others that only look so.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_mechanics::characteristics::select;
use chetaev_mechanics::multiplicity::Multiplicity;
use chetaev_mechanics::{MotionTerms, Prover, System};
use chetaev_model::load;
use std::collections::BTreeMap;

/// A point mass with these constraints.
fn system(constraints: &[&str]) -> System {
    let lines = constraints.iter().enumerate();
    let lines: Vec<String> = lines.map(|(i, c)| format!("c{i} = \"{c}\"\n")).collect();
    let text = format!(
        "coordinates = [\"x\", \"y\", \"z\"]\nassumptions = [\"a > 0\"]\n[parameters]\na = 2\n[lagrangian]\n\
         T = \"1/2 (x'^2 + y'^2 + z'^2)\"\n[constraints]\n{}",
        lines.concat()
    );
    let (model, _) = load("model.toml", &text, &BTreeMap::new(), &[])
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    System::from_model(&model).unwrap()
}

fn found(system: &System) -> Option<Multiplicity> {
    Multiplicity::find(system, &MotionTerms::new(system), &Prover::default())
}

/// One part with these values of the state, which the simpler functions have as regular zeros: the rank of their gradients by `by` is their
/// number. Gradients by central differences.
#[track_caller]
fn simple_at(constraints: &[&str], rank: usize, by: &[(&str, u32)], states: &[[f64; 7]]) {
    let system = system(constraints);
    let g = &system.graph;
    let multiplicity = found(&system).unwrap();
    assert_eq!(multiplicity.rank, rank, "{multiplicity:?}");
    let [simpler] = &multiplicity.simpler[..] else {
        panic!("{}", multiplicity.sentence(&system));
    };
    let names = [
        ("x", 0),
        ("y", 0),
        ("z", 0),
        ("x", 1),
        ("y", 1),
        ("z", 1),
        ("a", 0),
    ];
    for state in states {
        let values = |state: &[f64; 7]| -> Vec<f64> {
            let value = |s| {
                let own = (g.symbol_name(s), g.symbol_order(s));
                names.iter().position(|n| *n == own).map(|i| state[i])
            };
            g.evaluate_f64(simpler, &value).unwrap()
        };
        let at = values(state);
        assert!(
            at.iter().all(|f| f.abs() < 1e-12),
            "{at:?}: {}",
            multiplicity.sentence(&system)
        );
        let columns = by.iter().map(|own| {
            let i = names.iter().position(|n| n == own).unwrap();
            let moved = |by: f64| {
                let mut state = *state;
                state[i] += by;
                values(&state)
            };
            let (plus, minus) = (moved(1e-5), moved(-1e-5));
            plus.iter()
                .zip(&minus)
                .map(|(p, m)| (p - m) / 2e-5)
                .collect()
        });
        let columns: Vec<Vec<f64>> = columns.collect();
        assert_eq!(
            rank_of(columns),
            by.len(),
            "{}",
            multiplicity.sentence(&system)
        );
    }
}

/// The number of pivots of columns, by elimination.
fn rank_of(mut columns: Vec<Vec<f64>>) -> usize {
    let mut rank = 0;
    while let Some(own) = columns.pop() {
        let Some(row) = own.iter().position(|x| x.abs() > 1e-6) else {
            continue;
        };
        rank += 1;
        for other in &mut columns {
            let factor = other[row] / own[row];
            other
                .iter_mut()
                .zip(&own)
                .for_each(|(x, y)| *x -= factor * y);
        }
    }
    rank
}

const Z: f64 = 0.0;

#[test]
fn surfaces_that_touch_have_simpler_equations() {
    let on_plane = [("x", 0), ("y", 0)];
    // Circles of one radius that touch, for every radius.
    let circles = ["x^2 + y^2 = a^2", "(x - 2 a)^2 + y^2 = a^2"];
    simple_at(
        &circles,
        1,
        &on_plane,
        &[[2.0, Z, 5.0, Z, Z, Z, 2.0], [3.0, Z, 5.0, Z, Z, Z, 3.0]],
    );
    // A sphere in a tube touches it along a circle.
    let tube = ["x^2 + y^2 + z^2 = 1", "x^2 + y^2 = 1"];
    simple_at(
        &tube,
        1,
        &[("x", 0), ("z", 0)],
        &[[0.6, 0.8, Z, Z, Z, Z, 1.0]],
    );
    simple_at(
        &tube,
        1,
        &[("y", 0), ("z", 0)],
        &[[Z, -1.0, Z, Z, Z, Z, 1.0]],
    );
    // x² + y² = 2 x y is (x - y)² = 0.
    let sheets = ["z = x^2 + y^2", "z = 2 x y"];
    simple_at(
        &sheets,
        1,
        &[("x", 0), ("z", 0)],
        &[[3.0, 3.0, 18.0, Z, Z, Z, 1.0]],
    );
    // A plane touches a sphere at a point; over the complex numbers at more.
    let plane = ["x^2 + y^2 + z^2 = 1", "z = 1"];
    let all = [("x", 0), ("y", 0), ("z", 0)];
    simple_at(&plane, 1, &all, &[[Z, Z, 1.0, Z, Z, Z, 1.0]]);
}

#[test]
fn sums_of_squares_are_their_terms() {
    simple_at(
        &["x^2 + y^2 = 0"],
        0,
        &[("x", 0), ("y", 0)],
        &[[Z, Z, 4.0, Z, Z, Z, 1.0]],
    );
    let slide = ["(x' - y)^2 + y'^2 = 0"];
    simple_at(
        &slide,
        0,
        &[("x", 1), ("y", 1)],
        &[[1.0, 3.0, 4.0, 3.0, Z, 7.0, 1.0]],
    );
    simple_at(
        &["exp(x'^2 + y'^2) = 1"],
        0,
        &[("x", 1), ("y", 1)],
        &[[1.0, 3.0, 4.0, Z, Z, 7.0, 1.0]],
    );
    let speed = ["x'^2 + y'^2 = 1", "x' = 1"];
    simple_at(
        &speed,
        1,
        &[("x", 1), ("y", 1)],
        &[[1.0, 3.0, 4.0, 1.0, Z, 7.0, 1.0]],
    );
}

/// Constraints that hold where a condition on the positions holds alone, which is kept: without a reaction along its gradient a force would leave it.
#[test]
fn conditions_on_positions_may_be_hidden() {
    let said = |constraints: &[&str]| {
        let system = system(constraints);
        found(&system).unwrap().sentence(&system)
    };
    let still = ["x' = 0", "y x' = z"];
    simple_at(
        &still,
        1,
        &[("x", 1), ("z", 0)],
        &[[1.0, 3.0, Z, Z, 5.0, Z, 2.0]],
    );
    assert_eq!(
        said(&still),
        "`c0`, `c1` hold only where z = 0, which is more than they state of the positions, and their gradients have the rank 1 there, and \
         multipliers determine no motion; the same states satisfy z = 0, x' = 0, which can be stated instead"
    );
    // The hidden condition hides a further one by its rate: z = x', and z' = y.
    let chain = ["x' = 0", "y x' = z", "z' = y"];
    simple_at(
        &chain,
        2,
        &[("x", 1), ("y", 0), ("z", 0)],
        &[[1.0, Z, Z, Z, Z, Z, 2.0]],
    );
    let timed = ["x' = y", "x = t"];
    assert!(
        said(&timed).contains("hold only where t - x = 0, y - 1 = 0, which is more"),
        "{}",
        said(&timed)
    );
    // The rate contradicts the third one: there are no states, which is said by others.
    assert_eq!(found(&system(&["x' = 0", "y x' = z", "z' = 1"])), None);
}

/// Circles of radius 1 with centres at the distance a touch for a = 2 alone, which the model states.
#[test]
fn values_that_are_stated_count() {
    let system = system(&["x^2 + y^2 = 1", "(x - a)^2 + y^2 = 1"]);
    let g = &system.graph;
    let multiplicity = found(&system).unwrap();
    assert_eq!(multiplicity.rank, 1);
    let said = multiplicity.sentence(&system);
    assert!(said.starts_with("for a = 2, "), "{said}");
    let [simpler] = &multiplicity.simpler[..] else {
        panic!("{said}");
    };
    let texts: Vec<String> = simpler.iter().map(|&e| g.text(e)).collect();
    assert_eq!(texts, ["x - 1", "y"]);
}

/// Where an angle takes its largest cosine.
#[test]
fn angles_count_as_one_unknown() {
    let top = ["y = cos(x)", "y = 1"];
    simple_at(
        &top,
        1,
        &[("x", 0), ("y", 0)],
        &[[Z, 1.0, 4.0, Z, Z, Z, 1.0]],
    );
}

/// Surfaces that cross, a constraint that follows from another one, and one whose gradient vanishes at single points only.
#[test]
fn simple_zeros_are_left_alone() {
    let all: [&[&str]; 6] = [
        &["x^2 + y^2 + z^2 = 4", "x^2 + y^2 = 1"],
        &["x = 0", "x (1 + y^2) = 0"],
        &["x^2 + y^2 = z^2"],
        &["x' sin(z) = y' cos(z)", "z' = x'"],
        &["x y = 0"],
        &["x^2 + y^2 = 1", "x' = 0"],
    ];
    for constraints in all {
        assert_eq!(found(&system(constraints)), None, "{constraints:?}");
    }
}

/// The length of a rod stands in no derivative: states that satisfy the constraints are looked at all the same, where z = 0 leaves z (1 + y²) nothing
/// to add.
#[test]
fn a_parameter_of_positions_alone_has_a_value() {
    let system = system(&["x^2 + y^2 = a^2", "z = 0", "z + z y^2 = 0"]);
    let chosen = select(&system, &MotionTerms::new(&system)).unwrap();
    assert_eq!(chosen.rows.len(), 2, "{chosen:?}");
}
