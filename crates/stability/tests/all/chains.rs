//! Chains of links, whose linear equations must not grow beyond their size, and the constraints that say where a motion may be.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::Case;
use chetaev_stability::characteristic::Characteristic;
use chetaev_stability::eigenvalues::eigenvalues;
use chetaev_stability::hurwitz::determinants;
use chetaev_stability::linearization::LinearizationError;
use chetaev_stability::spectrum::Spectrum;
use chetaev_symbolic::meter::{within, Work};
use nalgebra::DMatrix;
use std::fmt::Write as _;

/// Links on blades, each hinge a ahead of a blade and b behind the one before; nothing is assumed of a and b. With `steering` each blade turns
/// against its link.
fn chain(n: usize, steering: bool) -> Case {
    let all = |name: &str| -> Vec<String> { (1..=n).map(|i| format!("{name}_{i}")).collect() };
    let mut names: Vec<String> = vec!["x".into(), "y".into()];
    names.extend(all("th"));
    if steering {
        names.extend(all("ph"));
    }
    let mut text = format!("coordinates = {names:?}\nparameters = {{ m = 0.5, J = 0.01, I = 0.002, a = 0.25, b = 0.15, k = 0.3, u = 1 }}\n");
    text.push_str("[define]\nX_1 = \"x\"\nY_1 = \"y\"\n");
    let (mut kinetic, mut blades) = (Vec::new(), String::new());
    let mut straight = String::from("\"x'\" = \"u\"\n");
    for i in 1..=n {
        if i > 1 {
            let before = i - 1;
            for (axis, of) in [("X", "cos"), ("Y", "sin")] {
                let _ = writeln!(
                    text,
                    "{axis}_{i} = \"{axis}_{before} - b {of}(th_{before}) - a {of}(th_{i})\""
                );
            }
        }
        kinetic.push(format!("1/2 m (X_{i}'^2 + Y_{i}'^2) + 1/2 J th_{i}'^2"));
        let mut along = format!("th_{i}");
        let _ = writeln!(straight, "th_{i} = 0");
        if steering {
            kinetic.push(format!("1/2 I (th_{i}' + ph_{i}')^2 - 1/2 k ph_{i}^2"));
            along = format!("th_{i} + ph_{i}");
            let _ = writeln!(straight, "ph_{i} = 0");
        }
        let _ = writeln!(
            blades,
            "blade_{i} = \"X_{i}' sin({along}) = Y_{i}' cos({along})\""
        );
    }
    let lagrangian = kinetic.join(" + ");
    Case::new(&format!("{text}[lagrangian]\nL = \"{lagrangian}\"\n[constraints]\n{blades}[steady.straight]\n{straight}"))
}

/// The deviation of each heading on a straight run, by what the blade demands: a θᵢ' = u (θᵢ₋₁ − θᵢ) − b θᵢ₋₁', from link to link.
#[test]
fn the_links_of_a_chain_follow_each_other() {
    let n = 8;
    let case = chain(n, false);
    let motion = case.system.steady[0].clone();
    let linear = || case.linear(&motion, "u").unwrap();
    let linear = within(&Work::of_seconds(1.0), linear).expect("little work");
    let (a, b, u) = (0.25, 0.15, 0.7);
    let right = case.numbers(&linear.right, &[("u", u)]);
    for i in 1..n {
        for (column, name) in linear.names.iter().enumerate() {
            let of = |j: usize| f64::from(u8::from(*name == format!("th_{}", j + 1)));
            let expected = (u * (of(i - 1) - of(i)) - b * right[i - 1][column]) / a;
            assert!(
                (right[i][column] - expected).abs() < 1e-9 * (1.0 + expected.abs()),
                "{i} {name}"
            );
        }
    }
}

/// Blades that are steered leave no speeds without singular places; the equations are small all the same.
#[test]
fn a_chain_of_steered_links_takes_little_work() {
    let case = chain(5, true);
    let motion = case.system.steady[0].clone();
    let linear = || case.linear(&motion, "u").unwrap();
    let linear = within(&Work::of_seconds(1.0), linear).expect("little work");
    assert_eq!(linear.names.len(), 2 * 5 + 7);
}

/// A rod that is stated with its derivative beside it: the place of the bob is that of the rod, and the motion that is refused is told how it accelerates.
#[test]
fn a_finite_constraint_counts_before_its_derivative() {
    for rods in [
        "rod = \"x^2 + y^2 = l^2\"\nrate = \"x x' + y y' = 0\"",
        "rate = \"x x' + y y' = 0\"\nrod = \"x^2 + y^2 = l^2\"",
    ] {
        let case = Case::new(&format!(
            r#"
coordinates = ["x", "y"]
parameters = {{ m = 3, l = 2, g = 9.81 }}
[lagrangian]
L = "1/2 m (x'^2 + y'^2) - m g y"
[constraints]
{rods}
"#
        ));
        let at = |x: &str, y: &str| case.motion(&[("x", x), ("y", y), ("x'", "0"), ("y'", "0")]);
        let hanging = case.linear(&at("0", "-l"), "").unwrap();
        assert_eq!(hanging.names, ["x", "x'"]);
        assert_eq!(hanging.family, 0);
        match case.linear(&at("0", "-1"), "") {
            Err(LinearizationError::NotAdmissible {
                constraint,
                residual,
                ..
            }) => {
                assert_eq!((&*constraint, &*residual), ("rod", "-3"));
            }
            other => panic!("{other:?}"),
        }
        match case.linear(&at("l", "0"), "") {
            // The bob falls freely there, whatever its mass.
            Err(LinearizationError::NotSteady { quantity, rate, .. }) => {
                assert_eq!((&*quantity, &*rate), ("y'", "-981/100"));
            }
            other => panic!("{other:?}"),
        }
    }
}

/// Where two constraints touch, as a bob on a rod that also slides on one of two crossing planes at their line, nothing moves by the equations, and that is
/// what is said: the motion is not called unsteady.
#[test]
fn a_singular_place_is_called_one() {
    let case = Case::new(
        r#"
coordinates = ["x", "y", "z"]
parameters = { m = 1, l = 1, g = 10 }
[lagrangian]
L = "1/2 m (x'^2 + y'^2 + z'^2) - m g z"
[constraints]
rod = "x^2 + y^2 + z^2 = l^2"
planes = "x y = 0"
"#,
    );
    let at = |x: &str, z: &str| {
        let still = [("x'", "0"), ("y'", "0"), ("z'", "0")];
        let place = [("x", x), ("y", "0"), ("z", z)];
        case.motion(&[&place[..], &still[..]].concat())
    };
    let singular = case.linear(&at("0", "-l"), "");
    assert!(
        matches!(singular, Err(LinearizationError::Singular { .. })),
        "{singular:?}"
    );
    // Aside of the line the bob falls.
    let falling = case.linear(&at("3/5", "-4/5"), "");
    assert!(
        matches!(falling, Err(LinearizationError::NotSteady { .. })),
        "{falling:?}"
    );
}

/// Seventeen variables in numbers: the polynomial has the values of the determinant of λE − F, whose three zeros are the speed, the heading and the yaw
/// rate, and by Hurwitz's determinants the zeros that are left lie where those in double precision lie.
#[test]
fn a_long_chain_has_its_polynomial_in_numbers() {
    let case = chain(15, false);
    let g = &case.system.graph;
    let motion = case.system.steady[0].clone();
    let linear = case.linear(&motion, "").unwrap();
    assert!(linear.variables.len() > chetaev_stability::characteristic::LARGEST);
    let polynomial = Characteristic::of(g, &linear).expect("a polynomial");
    let zeros = polynomial.zeros + polynomial.further_zeros;
    assert_eq!((zeros, polynomial.degree()), (3, 14));
    let coefficients: Vec<f64> = polynomial
        .coefficients
        .iter()
        .map(|&e| case.number(e, &[]))
        .collect();
    let (left, right) = (
        case.numbers(&linear.left, &[]),
        case.numbers(&linear.right, &[]),
    );
    for at in [-2.5, 0.3, 1.0, 7.0] {
        let n = left.len();
        let matrix = DMatrix::from_fn(n, n, |r, c| at * left[r][c] - right[r][c]);
        let value = coefficients.iter().rev().fold(0.0, |sum, c| sum * at + c);
        let value = value * at.powi(zeros as i32);
        let expected = matrix.determinant();
        assert!(
            (value / expected - 1.0).abs() < 1e-9,
            "{at}: {value} {expected}"
        );
    }
    let found = eigenvalues(&left, &right).unwrap();
    let are_left = found.iter().filter(|l| l.norm() > 0.1).all(|l| l.re < 0.0);
    let spectrum = Spectrum::of(g, &polynomial);
    let list = spectrum.deciding(g).into_iter();
    let all = list.flat_map(|own| determinants(g, &own.coefficients));
    let are_positive = all.map(|e| case.number(e, &[])).all(|x| x > 0.0);
    assert_eq!(are_positive, are_left);
}
