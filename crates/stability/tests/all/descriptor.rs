//! Linear equations in all variables: what they have in common with those in independent ones, and what multipliers do in them.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::Case;
use chetaev_mechanics::SteadyMotion;
use chetaev_stability::descriptor::{Descriptor, DescriptorError};
use chetaev_stability::expansion::Expansion;
use chetaev_symbolic::Expr;
use nalgebra::DMatrix;

fn expansion<'c>(case: &'c Case, motion: &'c SteadyMotion) -> Expansion<'c> {
    let (terms, selection) = (&case.prepared.terms, &case.prepared.selection);
    Expansion::new(&case.system, terms, selection, motion, &case.values("")).unwrap()
}

fn outputs(case: &Case, texts: &[&str]) -> Vec<(String, Expr)> {
    let of = |&text: &&str| (text.to_owned(), case.read(text));
    texts.iter().map(of).collect()
}

fn in_all(
    case: &Case,
    motion: &SteadyMotion,
    texts: &[&str],
) -> Result<Descriptor, DescriptorError> {
    expansion(case, motion).descriptor(&outputs(case, texts))
}

/// C and D of outputs in independent coordinates and speeds.
fn in_independent(case: &Case, texts: &[&str]) -> [Vec<Vec<f64>>; 2] {
    let about = expansion(case, &case.system.steady[0]);
    let space = about.state_space(&about.linear(), &outputs(case, texts));
    let space = space.unwrap();
    [&space.c, &space.d].map(|rows| case.numbers(rows, &[]))
}

/// det(s E − A) at a number.
fn determinant(
    case: &Case,
    (left, right): (&[Vec<Expr>], &[Vec<Expr>]),
    free: &[(&str, f64)],
    s: f64,
) -> f64 {
    let (left, right) = (case.numbers(left, free), case.numbers(right, free));
    let n = left.len();
    DMatrix::from_fn(n, n, |r, c| s * left[r][c] - right[r][c]).determinant()
}

/// The finite eigenvalues are those of the independent variables and zeros: the two determinants differ by a power of s and a constant.
fn have_the_same_eigenvalues(
    case: &Case,
    motion: &SteadyMotion,
    free: &[(&str, f64)],
    zeros: usize,
) {
    let all = in_all(case, motion, &[]).unwrap();
    let linear = case.linear(motion, "").unwrap();
    assert_eq!(all.zeros, Some(zeros));
    let quotient = |s: f64| {
        let whole = determinant(case, (&all.left, &all.space.a), free, s);
        whole / determinant(case, (&linear.left, &linear.right), free, s) / s.powi(zeros as i32)
    };
    let first = quotient(0.7);
    assert!(first.abs() > 1e-9 && first.is_finite());
    for s in [-0.4, 1.3, 2.9] {
        assert!(
            (quotient(s) / first - 1.0).abs() < 1e-8,
            "{s}: {} {first}",
            quotient(s)
        );
    }
}

#[test]
fn eigenvalues_are_those_of_independent_variables() {
    let case = Case::gallery("double-pendulum");
    have_the_same_eigenvalues(&case, &case.system.steady[0].clone(), &[], 0);
    // The heading of the bicycle is ignorable, and in all variables it is one.
    let case = Case::gallery("whipple-bicycle");
    let heading = case.motion(&[("psi", "0.3")]).positions;
    let stated = case.system.steady[0].clone();
    let motion = SteadyMotion {
        positions: stated
            .positions
            .iter()
            .zip(heading)
            .map(|(own, other)| own.or(other))
            .collect(),
        ..stated
    };
    have_the_same_eigenvalues(&case, &motion, &[], 5);
    // The place of the sleigh, and its heading.
    let case = Case::gallery("chaplygin-sleigh");
    have_the_same_eigenvalues(&case, &case.system.steady[0].clone(), &[], 3);
}

/// A bob on a rod in Cartesian coordinates: x'' = λ x/m about the lowest place, with the force λ that carries it, so that λ = −m g/l and the square of
/// the frequency is g/l. The rod is stated twice, in other units, and its derivative beside it.
#[test]
fn what_carries_a_pendulum_draws_it_back() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
parameters = { m = 3, l = 2, g = 9.81 }
[lagrangian]
L = "1/2 m (x'^2 + y'^2) - m g y"
[constraints]
rod = "1/2 (x^2 + y^2 - l^2) = 0"
again = "1000 x^2 + 1000 y^2 = 4000"
rate = "x x' + y y' = 0"
"#,
    );
    let at = |x: &str, y: &str| case.motion(&[("x", x), ("y", y), ("x'", "0"), ("y'", "0")]);
    let all = in_all(&case, &at("0", "-l"), &["x", "y"]).unwrap();
    assert_eq!(all.space.states, ["x", "y", "x'", "y'", "lambda_rod"]);
    let a = case.numbers(&all.space.a, &[]);
    // m x'' = λ₀ δx, m y'' = λ₀ δy + y δλ, and −l δy = 0.
    assert!((a[2][0] + 3.0 * 9.81 / 2.0).abs() < 1e-12);
    assert_eq!((a[3][4], a[4][1]), (-2.0, -2.0));
    have_the_same_eigenvalues(&case, &at("0", "-l"), &[], 0);
    have_the_same_eigenvalues(&case, &at("0", "l"), &[], 0);
}

/// Outputs that depend on the place, which nothing else depends on.
#[test]
fn the_place_is_an_output() {
    let case = Case::gallery("chaplygin-sleigh");
    let stated = case.system.steady[0].clone();
    let given = |text: &[(&str, &str)]| SteadyMotion {
        positions: case.motion(text).positions,
        ..stated.clone()
    };
    match in_all(&case, &given(&[]), &[]) {
        Err(DescriptorError::PositionMissing { coordinate, .. }) => assert_eq!(coordinate, "phi"),
        other => panic!("{other:?}"),
    }
    let along = given(&[("phi", "0")]);
    let all = in_all(&case, &along, &["x + 2 y", "sin(y)"]);
    // The position y is missing for sin(y).
    assert!(
        matches!(all, Err(DescriptorError::PositionMissing { .. })),
        "{all:?}"
    );
    let placed = given(&[("phi", "0"), ("y", "0"), ("x", "0")]);
    let all = in_all(&case, &placed, &["x + 2 y", "sin(y)"]).unwrap();
    let c = case.numbers(&all.space.c, &[]);
    assert_eq!(
        (&c[0][..3], &c[1][..3]),
        (&[1.0, 2.0, 0.0][..], &[0.0, 1.0, 0.0][..])
    );
    // x runs on, and a function of it that is not linear changes its slope.
    match in_all(&case, &placed, &["x^2"]) {
        Err(DescriptorError::Runs { coordinate, .. }) => assert_eq!(coordinate, "x"),
        other => panic!("{other:?}"),
    }
}

/// A disc that goes round in a circle has no constant coefficients in Cartesian coordinates.
#[test]
fn circles_have_no_constant_coefficients() {
    let case = Case::gallery("falling-rolling-disc");
    let spinning = case
        .system
        .steady
        .iter()
        .find(|own| own.name == "spinning")
        .unwrap();
    let motion = SteadyMotion {
        positions: vec![Some(case.system.graph.zero()); case.system.n()],
        ..spinning.clone()
    };
    let found = in_all(&case, &motion, &[]);
    assert!(
        matches!(found, Err(DescriptorError::Runs { .. })),
        "{found:?}"
    );
}

/// Two masses side by side, y = x, on a spring 3 x²/2 with a force u on the first: 2 x'' = −3 x + u, and the reaction λ = y''.
#[test]
fn accelerations_and_reactions_are_outputs() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
V = "3/2 x^2"
[constraints]
c = "y = x"
[controls]
u = {}
[forces]
x = "u"
[steady.o]
x = 0
y = 0
"#,
    );
    let texts = ["lambda_c", "x''", "x'' + x"];
    let [c, d] = in_independent(&case, &texts);
    assert_eq!(c, [[-1.5, 0.0], [-1.5, 0.0], [-0.5, 0.0]]);
    assert_eq!(d, [[0.5], [0.5], [0.5]]);
    // In all variables (x, y, x', y', λ): x'' = −3 x + u − λ.
    let all = in_all(&case, &case.system.steady[0], &texts).unwrap();
    let numbers = |rows: &[Vec<Expr>]| case.numbers(rows, &[]);
    assert_eq!(
        numbers(&all.space.c),
        [
            [0.0, 0.0, 0.0, 0.0, 1.0],
            [-3.0, 0.0, 0.0, 0.0, -1.0],
            [-2.0, 0.0, 0.0, 0.0, -1.0]
        ]
    );
    assert_eq!(numbers(&all.space.d), [[0.0], [1.0], [1.0]]);
}

/// The reaction of a hanging pendulum of length 1 in Cartesian coordinates, y'' = −g + u + 2 y λ with y = −1: ∂λ/∂u = 1/2, whichever coordinate
/// comes first; and that of a sleigh's blade, which depends on no heading: m u w J/(J + m a²).
#[test]
fn reactions_are_outputs_in_any_coordinates() {
    for coordinates in ["\"x\", \"y\"", "\"y\", \"x\""] {
        let case = Case::new(&format!(
            "coordinates = [{coordinates}]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"9 y\"\n[constraints]\nrod = \"x^2 + y^2 = 1\"\n[controls]\nu = {{}}\n\
             [forces]\ny = \"u\"\n[steady.hang]\nx = 0\ny = -1\n"
        ));
        let [c, d] = in_independent(&case, &["lambda_rod"]);
        assert_eq!(
            (c, d),
            (vec![vec![0.0; 2]], vec![vec![0.5]]),
            "{coordinates}"
        );
    }
    let sleigh = Case::gallery("chaplygin-sleigh");
    let [c, _] = in_independent(&sleigh, &["lambda_blade"]);
    // u = 1, m = 3/2, J = 2/5, a = 1/4.
    let expected = 0.6 / 0.49375;
    assert!(
        c[0][0] == 0.0 && (c[0][1] - expected).abs() < 1e-14,
        "{c:?}"
    );
}

/// What has no slope at the motion has no linear form: a pole, the foot of a root, a corner.
#[test]
fn outputs_without_a_slope_are_refused() {
    let case = Case::new(
        "coordinates = [\"x\"]\n[lagrangian]\nL = \"1/2 x'^2 - 1/2 x^2\"\n[steady.o]\nx = 0\n",
    );
    let about = expansion(&case, &case.system.steady[0]);
    let of = |text: &str| about.state_space(&about.linear(), &outputs(&case, &[text]));
    for text in ["1/x", "sqrt(x)", "abs(x)", "log(x^2)"] {
        let said = of(text)
            .err()
            .map(|own| own.to_string())
            .unwrap_or_default();
        assert!(
            said.contains("has no derivative at the motion"),
            "{text}: {said}"
        );
    }
    assert!(of("sqrt(1 + x)").is_ok());
}
