//! Forces, outputs and inputs that have a corner: where it is smaller beside the motion than linear terms there are linear equations.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::Case;
use chetaev_stability::expansion::Expansion;
use chetaev_stability::state_space::StateSpace;

fn oscillator(place: &str, energy: &str, force: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x"]
[lagrangian]
L = "{energy}"
[forces]
x = "{force}"
[steady.s]
x = "{place}"
"x'" = 0
"#
    ))
}

/// x'' = −x' − x/2 − |x| is unstable to one side, and x'' = −x − x' + sign x to both: where forces have a corner or a jump there are no linear
/// equations. Beside it there are.
#[test]
fn a_corner_has_no_linear_equations() {
    for (energy, force) in [
        ("1/2 x'^2", "-x' - x/2 - abs(x)"),
        ("1/2 x'^2 - x^2/2 + abs(x)", "-x'"),
        ("1/2 x'^2", "-x - x' + sign(x)"),
        ("1/2 x'^2 - x^2/2", "-3 sign(x') - x'/10"),
        ("1/2 x'^2 - x^2/2", "-sign(x') sqrt(abs(x'))"),
        ("1/2 x'^2 - x^2/2", "-x' x/sqrt(x^2 + x'^2)"),
        ("1/2 x'^2 - x^2/2", "sign(x) x'^2 - x'"),
    ] {
        let case = oscillator("0", energy, force);
        for claim in ["asymptotic", "spectral", "linear", "nonlinear"] {
            let said = case.said(&format!("stability.{claim}"), "s");
            assert!(said.contains("have a corner or a jump"), "{force}: {said}");
        }
    }
    let beside = oscillator("2", "1/2 x'^2", "1 - x' - abs(x)/2");
    assert_eq!(beside.said("stability.asymptotic", "s"), "proved");
}

/// |x'| x', |x|^(5/3), sin(x) |x| and all that is smaller than any multiple of the distance have the slope 0, so that what is left is x'' = −2 x, or
/// x'' = −2 x − x' where there is such a force.
#[test]
fn what_is_smaller_than_linear_has_no_slope() {
    for small in [
        "-abs(x') x'",
        "-abs(x)^(5/3)",
        "-sin(x) abs(x)",
        "-sqrt(x^2 + x'^2) x'",
        "-x'^2 sign(x')",
        "-abs(x')^(3/2) sign(x')",
        "-abs(x x')^(2/3)",
        "-sqrt(abs(x)^3)",
        "sinh(abs(x) x)",
        "x' exp(-abs(x')) - x'",
        "3 cos(abs(x') x') - 3",
        "1 - 1/(1 + x' abs(x'))",
    ] {
        for (linear, damping) in [("", 0.0), (" - x'", -1.0)] {
            let case = oscillator("0", "1/2 x'^2 - x^2", &format!("{small}{linear}"));
            let found = case.linear(&case.system.steady[0], "").unwrap();
            let right = case.numbers(&found.right, &[]);
            assert_eq!(right, [[0.0, 1.0], [-2.0, damping]], "{small}{linear}");
            assert_eq!(case.said("stability.spectral", "s"), "proved", "{small}");
            let asymptotic = case.said("stability.asymptotic", "s");
            let expected = if damping < 0.0 { "proved" } else { "refuted" };
            assert!(
                asymptotic.starts_with(expected),
                "{small}{linear}: {asymptotic}"
            );
        }
    }
}

/// Quadratic resistance takes energy away, so that rest at a minimum of the potential is stable, though no eigenvalue says so; resistance that
/// drives, `+|x'| x'`, takes none.
#[test]
fn quadratic_resistance_keeps_rest_stable() {
    for force in ["-abs(x') x'", "-sqrt(abs(x')) x'", "-sign(x') x'^2"] {
        let case = oscillator("0", "1/2 x'^2 - x^2/2", force);
        assert_eq!(case.said("stability.nonlinear", "s"), "proved", "{force}");
    }
    let driven = oscillator("0", "1/2 x'^2 - x^2/2", "abs(x') x'");
    let said = driven.said("stability.nonlinear", "s");
    assert!(!said.starts_with("proved"), "{said}");
}

/// `|x|³` beside `x²/2` changes no second variation, and `|x|^(3/2)` has none.
#[test]
fn integrals_with_corners_are_expanded_as_far_as_they_have_derivatives() {
    let smooth = oscillator("0", "1/2 x'^2 - x^2/2 - abs(x)^3", "0");
    assert_eq!(smooth.said("stability.nonlinear", "s"), "proved");
    let unstable = oscillator("0", "1/2 x'^2 + x^2/2 - abs(x)^3", "0");
    let said = unstable.said("stability.nonlinear", "s");
    assert!(said.starts_with("refuted"), "{said}");
    let pointed = oscillator("0", "1/2 x'^2 - abs(x)^(3/2)", "0");
    let said = pointed.said("stability.nonlinear", "s");
    assert!(said.contains("have a corner or a jump"), "{said}");
}

/// Beside a family the theorem of Lyapunov and Malkin is for smooth equations.
#[test]
fn a_corner_beside_a_family_leaves_the_motion_undecided() {
    let sleigh = |torque: &str| {
        Case::new(&format!(
            r#"
coordinates = ["x", "y", "th"]
[lagrangian]
L = "1/2 (x'^2 + y'^2 + th'^2)"
[forces]
th = "{torque}"
[constraints]
knife = "y' cos(th) - x' sin(th) = 0"
[steady.s]
th = 0
"x'" = 1
"th'" = 0
"#
        ))
    };
    let smooth = sleigh("-th'");
    assert_eq!(smooth.said("stability.nonlinear", "s"), "proved");
    let cornered = sleigh("-th' - abs(th') th'");
    assert_eq!(cornered.said("stability.linear", "s"), "proved");
    let said = cornered.said("stability.nonlinear", "s");
    assert!(said.starts_with("undecided"), "{said}");
}

/// Outputs and inputs have slopes as forces have: that of `|x'| x'` is zero, and `|x|` and `|x''|` have none, in independent variables and in all.
#[test]
fn outputs_and_inputs_have_slopes_where_corners_are_small() {
    let case = Case::new(
        r#"
coordinates = ["x"]
[lagrangian]
L = "1/2 x'^2 - x^2/2"
[forces]
x = "3 u + abs(u) u - x'"
[controls]
u = {}
[steady.s]
x = 0
"x'" = 0
"#,
    );
    let (terms, selection) = (&case.prepared.terms, &case.prepared.selection);
    let motion = &case.system.steady[0];
    let about = Expansion::new(&case.system, terms, selection, motion, &[]).unwrap();
    let output = |text: &str| vec![(text.to_owned(), case.read(text))];
    let c_of = |space: &StateSpace| case.numbers(&space.c, &[]);
    let space = about.state_space(&about.linear(), &output("2 x' + abs(x') x'"));
    let space = space.unwrap();
    assert_eq!(c_of(&space), [[0.0, 2.0]]);
    assert_eq!(case.numbers(&space.b, &[]), [[0.0], [3.0]]);
    let all = about.descriptor(&output("2 x' + abs(x') x'")).unwrap();
    assert_eq!(c_of(&all.space), [[0.0, 2.0]]);
    for text in ["abs(x)", "abs(x'')", "x' + abs(x'')", "sign(x) x'"] {
        let independent = about.state_space(&about.linear(), &output(text));
        assert!(independent.is_err(), "{text}");
        assert!(about.descriptor(&output(text)).is_err(), "{text}");
    }
}
