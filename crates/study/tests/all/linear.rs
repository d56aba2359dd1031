//! Linear equations in symbols and in numbers, and what is said where there are none.
#![allow(clippy::unwrap_used)] // a panic is how a test fails

use chetaev_model::{load, Model, NoFiles};
use chetaev_study::stability::map::{map, Kind};
use chetaev_study::stability::{stability, Numbers, Stability, Wanted};

const BICYCLE: &str = include_str!("../../../../gallery/whipple-bicycle/model.toml");
const ROD: &str = r#"
name = "rod"
coordinates = ["x", "y"]
parameters = { m = 3, l = 2, weight = "9 m" }
[lagrangian]
L = "1/2 m (x'^2 + y'^2) - weight y"
[constraints]
rod = "x^2 + y^2 = l^2"
[steady.hanging]
x = 0
y = "-l"
"#;

fn model(text: &str) -> Model {
    load("model.toml", text, &NoFiles, &[])
        .into_result()
        .unwrap()
        .0
}

fn found(text: &str, wanted: &Wanted<'_>) -> Stability {
    stability(&model(text), wanted).unwrap()
}

/// In numbers the equations are those in symbols at the values stated, whether they were asked for or symbols took too much work, and the answer says
/// which.
#[test]
fn numbers_are_the_symbols_at_their_values() {
    let symbols = found(BICYCLE, &Wanted::default());
    assert_eq!(symbols.numbers, None);
    let (expected, at) = (symbols.matrices(), symbols.eigenvalues(Some(5.0)).unwrap());
    let asked = Wanted {
        numbers: true,
        ..Wanted::default()
    };
    let spent = Wanted {
        work: Some(1e-4),
        ..Wanted::default()
    };
    let ways = [
        (asked, Numbers::Asked, "Numbers, exact for v = 5,"),
        (spent, Numbers::TooLarge, "too large to be printed"),
    ];
    for (wanted, why, said) in ways {
        let numbers = found(BICYCLE, &wanted);
        assert_eq!(numbers.numbers, Some(why));
        assert!(
            numbers.linear_text().contains(said),
            "{}",
            numbers.linear_text()
        );
        assert_eq!(numbers.question.over, None);
        for (own, expected) in numbers.matrices().matrices.iter().zip(&expected.matrices) {
            assert_eq!(own.0, expected.0);
            let pairs = own.1.iter().flatten().zip(expected.1.iter().flatten());
            for (own, expected) in pairs {
                assert!((own - expected).abs() <= 1e-12 * (1.0 + expected.abs()));
            }
        }
        for (own, expected) in numbers.eigenvalues(None).unwrap().iter().zip(&at) {
            let size = (own.0 - expected.0).hypot(own.1 - expected.1);
            assert!(size < 1e-9, "{own:?} {expected:?}");
        }
    }
}

/// A chain of 32 links on blades is linearized in symbols within the work that is allowed.
#[test]
fn a_chain_of_32_links_stays_in_symbols() {
    let text = include_str!("../../../../bench/models/snake.toml");
    let text = text.replace("n = 2\n", "n = 32\n");
    let text = text.replace("k = 0.3\n", "k = 0.3\nu = 1\n");
    let text = format!("{text}\n[steady.straight]\n\"x'\" = \"u\"\n\"th_{{i}}\" = 0\n");
    let own = found(&text, &Wanted::default());
    assert_eq!(own.numbers, None);
    assert_eq!(own.space.a.len(), 34);
}

#[test]
fn what_is_wrong_is_said_once() {
    let said = |text: &str, wanted: &Wanted<'_>| {
        let problem = stability(&model(text), wanted).unwrap_err();
        problem.to_string()
    };
    let over = |over| Wanted {
        over: Some(over),
        ..Wanted::default()
    };
    // A parameter of the model that is one of the motion too.
    let known = said(ROD, &over("speed=0:1"));
    assert!(
        known.ends_with("its parameters are m, l, weight"),
        "{known}"
    );
    // The time in the equations, and no motion named.
    let shaken = ROD.replace("- weight y", "- weight y cos(t)");
    let shaken = shaken.split("[steady").next().unwrap();
    let known = said(shaken, &Wanted::default());
    assert!(known.contains("--along"), "{known}");
    // Values over a range are those that a person would write.
    let table = found(ROD, &over("l=1:3")).ranges_text();
    for value in ["l = 1.2 ", "l = 1.8 ", "l = 2.6 "] {
        assert!(table.contains(value), "{table}");
    }
}

/// The pictures in the chapter of the book are those that the program draws.
#[test]
fn the_book_has_the_pictures_of_the_program() {
    let eigenvalues = include_str!("../../../../docs/book/stability/bicycle.svg");
    let over = |over| Wanted {
        over: Some(over),
        ..Wanted::default()
    };
    let drawn = found(BICYCLE, &over("v=0:10")).picture().unwrap();
    assert!(drawn == eigenvalues);
    let regions = include_str!("../../../../docs/book/stability/map.svg");
    let two = over("v=0:10,c=0.02:0.14");
    let drawn = map(&model(BICYCLE), &two, &mut |_| {}).unwrap();
    assert!(drawn.picture() == regions);
}

/// What the ranges of a parameter of three oscillators say.
fn oscillators(forces: &str, over: &str) -> String {
    let text = format!(
        "name = \"oscillators\"\ncoordinates = [\"x\", \"y\", \"z\"]\nparameters = {{ c = 2 }}\n\
         lagrangian = \"1/2 (x'^2 + y'^2 + z'^2) - 1/2 (x^2 + y^2 + c^2 z^2)\"\n[forces]\n{forces}\n[steady.rest]\nx = 0\ny = 0\nz = 0\n"
    );
    let wanted = Wanted {
        over: Some(over),
        ..Wanted::default()
    };
    found(&text, &wanted).ranges_text()
}

/// A force along x that y exerts makes a Jordan block of the two equal frequencies: x'' + x = y has solutions t cos t.
#[test]
fn motions_beside_a_jordan_block_are_not_called_bounded() {
    let own = oscillators("x = \"y\"", "c=2:3");
    assert!(
        own.contains("fewer eigenvectors than its multiplicity"),
        "{own}"
    );
    assert!(!own.contains("stay bounded"), "{own}");
    let own = oscillators("x = \"0\"", "c=2:3");
    assert!(own.contains("linear motions stay bounded"), "{own}");
}

/// x'' + x = (c − 2) x' passes c = 2 with all motions periodic: the first Lyapunov coefficient is zero, and says nothing.
#[test]
fn a_lyapunov_coefficient_that_vanishes_says_nothing() {
    let text = "name = \"own\"\ncoordinates = [\"x\"]\nparameters = { c = 1 }\nlagrangian = \"1/2 x'^2 - 1/2 x^2\"\n[forces]\n\
                x = \"(c - 2) x'\"\n[steady.rest]\nx = 0\n";
    let wanted = Wanted {
        over: Some("c=1:3"),
        ..Wanted::default()
    };
    let own = found(text, &wanted).ranges_text();
    assert!(own.contains("a pair of eigenvalues passes"), "{own}");
    assert!(own.contains("vanish"), "{own}");
}

/// A bead on a hoop that turns at the rate W about its vertical diameter stands aside where cos θ = k/W², which is an angle only for W² ≥ k: the map
/// has no motion below the parabola k = W², and stability above it.
#[test]
fn a_map_leaves_out_where_there_is_no_motion() {
    let bead = model(
        r#"
name = "bead"
coordinates = ["th"]
parameters = { W = 2, k = 1 }
[lagrangian]
L = "1/2 (th'^2 + W^2 sin(th)^2) + k cos(th)"
[steady.aside]
th = "acos(k/W^2)"
"#,
    );
    let over = Wanted {
        over: Some("W=1/10:2,k=1/10:2"),
        ..Wanted::default()
    };
    let drawn = map(&bead, &over, &mut |_| {}).unwrap();
    let part = |at: usize| 0.1 + 1.9 * at as f64 / drawn.side as f64;
    for (at, kind) in drawn.kinds.iter().enumerate() {
        let (w, k) = (part(at % (drawn.side + 1)), part(at / (drawn.side + 1)));
        let expected = if k > w * w + 1e-9 {
            Kind::NoMotion
        } else {
            Kind::Stable
        };
        if (k - w * w).abs() > 1e-9 {
            assert_eq!(*kind, expected, "W = {w}, k = {k}");
        }
    }
    let edge: Vec<_> = drawn
        .curves
        .iter()
        .filter(|own| own.kind == "end")
        .collect();
    assert!(!edge.is_empty());
    for (w, k) in edge.iter().flat_map(|own| &own.points) {
        assert!((k - w * w).abs() < 1e-9, "W = {w}, k = {k}");
    }
}
