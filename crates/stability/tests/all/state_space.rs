//! Inputs, outputs and transfer functions of linear equations, and the speeds in which they are written.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands; values have the digits of their source"
)]

use crate::common::Case;
use chetaev_mechanics::Selection;
use chetaev_stability::eigenvalues::eigenvalues;
use chetaev_stability::expansion::Expansion;
use chetaev_stability::reduction::Speeds;

/// The pole on a cart in state space: `(M + m) g/(M l)`, `1/M`, `−1/(M l)` (Åström and Murray 2008), and its transfer function.
#[test]
fn the_pole_on_a_cart() {
    let case = Case::new(
        r#"
coordinates = ["x", "th"]
parameters = { M = 1, m = 0.2, l = 0.5, g = 9.81 }
[lagrangian]
T = "1/2 M x'^2 + 1/2 m ((x' + l th' cos(th))^2 + l^2 th'^2 sin(th)^2)"
V = "m g l cos(th)"
[forces]
x = "F"
[controls]
F = {}
[steady.up]
x = 0
th = 0
"x'" = 0
"th'" = 0
"#,
    );
    let (system, prepared) = (&case.system, &case.prepared);
    let values = case.values("");
    let about = Expansion::new(
        system,
        &prepared.terms,
        &prepared.selection,
        &system.steady[0],
        &values,
    )
    .unwrap();
    let linear = about.linear();
    assert_eq!(linear.names, ["th", "x'", "th'"]);
    let output = (
        "tip".to_owned(),
        case.model.expression("x' + l th' cos(th)").unwrap(),
    );
    let space = about.state_space(&linear, &[output]).unwrap();
    let numbers = |rows: &[Vec<chetaev_symbolic::Expr>]| case.numbers(rows, &[]);
    assert_eq!(
        numbers(&space.a),
        [[0.0, 0.0, 1.0], [-1.962, 0.0, 0.0], [23.544, 0.0, 0.0]]
    );
    assert_eq!(numbers(&space.b), [[0.0], [1.0], [-2.0]]);
    assert_eq!(numbers(&space.c), [[0.0, 1.0, 0.5]]);
    assert_eq!(space.ranks(&system.graph), (3, 3));
    // The tip moves by −m g l sin θ alone: (s² x + l s² θ) m = …, so tip'/F = −g/(M l s³ − (M + m) g s) · 1.
    let g = &system.graph;
    let transfer = space.transfer(g).unwrap()[0][0];
    let at = g.evaluate_f64(&[transfer], &|_| Some(2.0)).unwrap()[0];
    let expected = -9.81 / (0.5 * 8.0 - 1.2 * 9.81 * 2.0);
    assert!((at - expected).abs() < 1e-14, "{at} {expected}");
}

/// x'' = u' + u − x − x' has x/u = (s + 1)/(s² + s + 1): a control and its rate are one input.
#[test]
fn the_rate_of_a_control_is_no_input_of_its_own() {
    let case = Case::new(
        r#"
coordinates = ["x"]
[controls]
u = {}
[lagrangian]
T = "1/2 x'^2"
[forces]
x = "u' + u - x - x'"
[steady.o]
x = 0
"x'" = 0
"#,
    );
    let (system, prepared) = (&case.system, &case.prepared);
    let (motion, values) = (&system.steady[0], case.values(""));
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let about = Expansion::new(system, terms, selection, motion, &values).unwrap();
    let output = ("place".to_owned(), case.model.expression("x").unwrap());
    let space = about.state_space(&about.linear(), &[output]).unwrap();
    assert_eq!(space.inputs, ["u", "u'"]);
    assert_eq!(space.controls(), ["u"]);
    let g = &system.graph;
    let transfer = space.transfer(g).unwrap();
    assert_eq!(transfer[0].len(), 1);
    // At s = 2.
    let at = g.evaluate_f64(&transfer[0], &|_| Some(2.0)).unwrap()[0];
    assert!((at - 3.0 / 7.0).abs() < 1e-15, "{at}");
}

/// Independent speeds of choice do not change the eigenvalues.
#[test]
fn speeds_of_choice() {
    let case = Case::gallery("whipple-bicycle");
    let (system, prepared) = (&case.system, &case.prepared);
    let values = case.values("");
    let of = |dependent: Vec<usize>| {
        let selection = Selection {
            rows: prepared.selection.rows.clone(),
            dependent,
        };
        let about = Expansion::in_speeds(
            system,
            &prepared.terms,
            &selection,
            &system.steady[0],
            (&values, Speeds::Independent),
        )
        .unwrap();
        let linear = about.linear();
        eigenvalues(
            &case.numbers(&linear.left, &[]),
            &case.numbers(&linear.right, &[]),
        )
        .unwrap()
    };
    let place = |name: &str| {
        system
            .coordinates
            .iter()
            .position(|c| c.name == name)
            .unwrap()
    };
    let own = of(prepared.selection.dependent.clone());
    // The front wheel in the place of the rear one.
    let chosen = ["phi", "delta", "thF"].map(place);
    let other = of((0..system.n()).filter(|j| !chosen.contains(j)).collect());
    for (a, b) in own.iter().zip(&other) {
        assert!((a - b).norm() < 1e-9, "{own:?} {other:?}");
    }
}
