//! First integrals of the gallery come out without hints: what the literature knows is a function of what is found.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::geometry::noether::found::{found, Found};
use chetaev::geometry::noether::motion::Motion;
use chetaev::mechanics::{Context, Prepared, Prover, System};
use chetaev::study::registry;
use chetaev::symbolic::{Expr, Verdict};
use chetaev_tests::studied::{gallery_path, loaded};
use chetaev_tests::words::{in_parallel, none};

/// Model, number of functionally independent integrals in its families, and stated integrals that hold for derived parameters only.
const SYSTEMS: &[(&str, usize, &[&str])] = &[
    // T3 §8.4: four, and t φ' - φ beside them.
    ("skate-level", 5, &[]),
    // T3 §8.4: four, and t φ' - φ beside them.
    ("skate-incline", 5, &[]),
    // T3 §8.5: the ratio, the energy, the one with the time.
    ("appell-hamel", 5, &[]),
    // T3 §8.2: y', sqrt(1 + y^2) x'.
    ("particle-y-dx", 4, &[]),
    // Chaplygin 1903: the moment of momentum about the contact, and the energy.
    ("chaplygin-sphere", 4, &[]),
    // Hypergeometric integrals are in no elementary family: the energy only.
    ("falling-rolling-disc", 1, &[]),
    ("sphere-on-turntable", 4, &["center_x", "center_y"]),
    ("suslov", 1, &[]),
    // Euler: the moment of momentum in space, and the energy.
    ("rigid-body", 4, &[]),
    // Lagrange's top.
    ("heavy-top", 3, &[]),
    ("vertical-rolling-disc", 6, &[]),
    ("charged-particle", 5, &[]),
    ("moving-knife-edge", 5, &[]),
];

fn with<T>(name: &str, ask: impl FnOnce(&Context<'_>, &Found) -> T) -> T {
    let model = loaded(&gallery_path(&format!("{name}/model.toml")), &[]).model;
    let system = System::from_model(&model.expect("the model is right")).expect("a system");
    let prepared = Prepared::new(&system).expect("independent velocities");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    let found = found(&cx);
    ask(&cx, found.as_ref().as_ref().expect("a search"))
}

/// The rank of the derivatives of functions along the constraint manifold.
fn rank(cx: &Context<'_>, functions: &[Expr]) -> usize {
    let motion = Motion::of(cx).expect("accelerations");
    let matrix = motion.gradients(functions);
    let rank = cx.prover.rank(cx.system, &matrix, &motion.manifold);
    rank.expect("a rank").maximum
}

#[test]
fn known_integrals_are_functions_of_those_found() {
    let failures = in_parallel(SYSTEMS, |&(name, count, except)| {
        with(name, |cx, found| {
            let mut wrong = Vec::new();
            let mut values: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
            if (found.integrals.len(), found.open) != (count, 0) {
                wrong.push(format!(
                    "{name}: {} integrals, {} open",
                    values.len(),
                    found.open
                ));
            }
            if found
                .integrals
                .iter()
                .any(|i| !matches!(i.verdict, Verdict::Proved(_)))
            {
                wrong.push(format!("{name}: an integral without proof"));
            }
            if rank(cx, &values) != count {
                wrong.push(format!("{name}: not independent"));
            }
            for (stated, value) in &cx.system.integrals {
                values.push(*value);
                if !except.contains(&stated.as_str()) && rank(cx, &values) != count {
                    wrong.push(format!("{name}: {stated} is not among those found"));
                }
                values.pop();
            }
            wrong
        })
    });
    none(failures.into_iter().flatten().collect());
}
