//! The rate of the energy against closed forms derived by hand, and the verdicts (T1 §5.1).

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::text;
use crate::common::{admissible, expr, finding, system, values, with_context, Text};
use chetaev_mechanics::formulations::{Basis, Routh};
use chetaev_mechanics::{Formulation, Prepared};
use chetaev_principles::energy::{energy_rate, force_power};

struct Case {
    name: &'static str,
    text: Text,
    /// dH/dt on the constraint manifold, by hand.
    rate: &'static str,
    /// What the detail has to say.
    says: &'static str,
}

const CASES: &[Case] = &[
    Case {
        name: "free fall",
        text: Text {
            coordinates: "x y",
            lagrangian: "m/2 (x'^2 + y'^2) - m g y",
            forces: &[],
            constraints: &[],
        },
        rate: "0",
        says: "Q = 0",
    },
    Case {
        name: "rheonomic and homogeneous",
        text: Text {
            coordinates: "x y",
            lagrangian: "1/2 (x'^2 + y'^2)",
            forces: &[],
            constraints: &[("turning", "y' - t x'")],
        },
        rate: "0",
        says: "although the time occurs there",
    },
    Case {
        name: "affine",
        text: Text {
            coordinates: "x y z",
            lagrangian: "1/2 (x'^2 + y'^2 + z'^2)",
            forces: &[],
            constraints: &[("c", "z' - y x' - b")],
        },
        rate: "b x' y'/(1 + y^2)",
        says: "∂f/∂v · v does not vanish for `c`",
    },
    Case {
        name: "appell-hamel",
        text: Text {
            coordinates: "x y z",
            lagrangian: "m/2 (x'^2 + y'^2 + z'^2) - m g z",
            forces: &[],
            constraints: &[("cone", "z' - a sqrt(x'^2 + y'^2)")],
        },
        rate: "0",
        says: "∂f/∂v · v = 0 where f = 0 for `cone`",
    },
    Case {
        name: "appell-hamel, quadratic",
        text: Text {
            coordinates: "x y z",
            lagrangian: "m/2 (x'^2 + y'^2 + z'^2) - m g z",
            forces: &[],
            constraints: &[("cone", "z'^2 - a^2 (x'^2 + y'^2)")],
        },
        rate: "0",
        says: "the energy is conserved",
    },
    Case {
        name: "a cone that opens",
        text: Text {
            coordinates: "x y z",
            lagrangian: "m/2 (x'^2 + y'^2 + z'^2) - m g z",
            forces: &[],
            constraints: &[("cone", "z' - (1 + t^2) sqrt(x'^2 + y'^2)")],
        },
        rate: "0",
        says: "although the time occurs there",
    },
    Case {
        name: "constant speed in gravity",
        text: Text {
            coordinates: "x y",
            lagrangian: "m/2 (x'^2 + y'^2) - m g y",
            forces: &[],
            constraints: &[("speed", "x'^2 + y'^2 - c^2")],
        },
        rate: "m g y'",
        says: "∂f/∂v · v does not vanish for `speed`",
    },
    Case {
        name: "skate on an incline",
        text: Text {
            coordinates: "x y phi",
            lagrangian: "m/2 (x'^2 + y'^2) + J/2 phi'^2 + m G x",
            forces: &[],
            constraints: &[("blade", "x' sin(phi) - y' cos(phi)")],
        },
        rate: "0",
        says: "the energy is conserved",
    },
    Case {
        name: "friction",
        text: Text {
            coordinates: "x y",
            lagrangian: "m/2 (x'^2 + y'^2)",
            forces: &[("x", "-c x'"), ("y", "-c y'")],
            constraints: &[],
        },
        rate: "-c (x'^2 + y'^2)",
        says: "the forces Q do work",
    },
    Case {
        name: "gyroscopic forces",
        text: Text {
            coordinates: "x y",
            lagrangian: "m/2 (x'^2 + y'^2)",
            forces: &[("x", "B y'"), ("y", "-B x'")],
            constraints: &[],
        },
        rate: "0",
        says: "the forces Q do no work",
    },
    Case {
        name: "a swinging support",
        text: Text {
            coordinates: "x",
            lagrangian: "1/2 x'^2 - x sin(t)",
            forces: &[],
            constraints: &[],
        },
        rate: "x cos(t)",
        says: "L depends on the time",
    },
    Case {
        name: "a lift as a position constraint",
        text: Text {
            coordinates: "x y",
            lagrangian: "1/2 (x'^2 + y'^2) - g y",
            forces: &[],
            constraints: &[("lift", "y - t^2")],
        },
        rate: "2 t (2 + g)",
        says: "so the reaction can do work",
    },
    Case {
        name: "a reaction that is not needed",
        text: Text {
            coordinates: "x y",
            lagrangian: "1/2 (x'^2 + y'^2)",
            forces: &[],
            constraints: &[("walk", "x' - 1")],
        },
        rate: "0",
        says: "although not every hypothesis holds",
    },
    Case {
        name: "not quadratic, with a metric and gyroscopic terms",
        text: Text {
            coordinates: "r th",
            lagrangian: "1/4 r'^4 + 1/2 r'^2 + 1/2 r^2 th'^2 + B r^2 th' - k/2 r^2",
            forces: &[],
            constraints: &[],
        },
        rate: "0",
        says: "the energy is conserved",
    },
];

#[test]
fn the_rate_of_the_energy_is_the_closed_form() {
    for case in CASES {
        let system = system(&case.text);
        let g = &system.graph;
        let prepared = Prepared::new(&system).unwrap();
        let basis = Basis {
            system: &system,
            terms: &prepared.terms,
            selection: &prepared.selection,
            characteristics: None,
        };
        let equations = Routh.equations(&basis).unwrap();
        let pair = [
            energy_rate(&system, &equations.accelerations),
            expr(g, case.rate),
        ];
        for seed in 1..6 {
            let mut point = admissible(&system, &prepared, seed);
            let mut others = chetaev_mechanics::sample::Generator::new(seed);
            for symbol in g.symbols_in(&pair) {
                point
                    .entry(symbol)
                    .or_insert_with(|| others.between(0.4, 1.6));
            }
            let found = values(g, &pair, &point);
            let gap = (found[0] - found[1]).abs();
            assert!(
                gap < 1e-9 * (1.0 + found[1].abs()),
                "{}: {found:?}",
                case.name
            );
        }
    }
}

#[test]
fn verdicts_and_their_reasons() {
    for case in CASES {
        let system = system(&case.text);
        let found = finding(&system, "energy.integral");
        let expected = if case.rate == "0" {
            "proved"
        } else {
            "refuted"
        };
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), expected, "{}: {detail}", case.name);
        assert!(detail.contains(case.says), "{}: {detail}", case.name);
    }
}

#[test]
fn the_power_balance_is_the_rate() {
    for case in CASES.iter().filter(|case| case.rate != "0") {
        let system = system(&case.text);
        let g = &system.graph;
        let prepared = Prepared::new(&system).unwrap();
        let found = finding(&system, "energy.integral");
        let last = found.formulas.last().unwrap().right;
        let pair = [last, expr(g, case.rate)];
        for seed in 1..4 {
            let point = admissible(&system, &prepared, seed);
            let found = values(g, &pair, &point);
            let gap = (found[0] - found[1]).abs();
            assert!(
                gap < 1e-9 * (1.0 + found[1].abs()),
                "{}: {found:?}",
                case.name
            );
        }
    }
}

#[test]
fn gyroscopic_forces_have_no_power() {
    let case = CASES
        .iter()
        .find(|case| case.name == "gyroscopic forces")
        .unwrap();
    let system = system(&case.text);
    assert!(system.graph.is_zero(force_power(&system)));
}

/// H is written with T as it is stated: T + V − L₁ has as few signs as L, and is Σ v ∂L/∂v − L.
#[test]
fn the_energy_as_it_is_read() {
    let stated = text(
        "x y phi",
        "1/2 m ((x' - a sin(phi) phi')^2 + (y' + a cos(phi) phi')^2) + J/2 phi'^2 + B (x y' - y x') - m g y + k (x' + 1)^2",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
    );
    let stated = system(&stated);
    let found = finding(&stated, "energy.integral");
    let g = &stated.graph;
    let written = found.formulas[0].right;
    let expected = expr(
        g,
        "1/2 m ((x' - a sin(phi) phi')^2 + (y' + a cos(phi) phi')^2) + J/2 phi'^2 + m g y + k (x'^2 - 1)",
    );
    let difference = [g.sub(written, expected)];
    let verdict = with_context(&stated, |cx| {
        cx.prover
            .identity(&stated, &difference, &Default::default(), "")
    });
    assert_eq!(verdict.word(), "proved", "{}", g.text(written));
    let length = |e| chetaev_symbolic::simplify::length(g, e);
    assert!(
        length(written) < length(stated.energy()) * 2 / 3,
        "{}",
        g.text(written)
    );
}
