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

/// A model with a motion of rest at zero, without parameters unless given.
fn at_rest(coordinates: &[&str], rest: &str) -> Stability {
    let names: Vec<String> = coordinates.iter().map(|own| format!("{own:?}")).collect();
    let steady: Vec<String> = coordinates
        .iter()
        .map(|own| format!("{own} = 0\n\"{own}'\" = 0\n"))
        .collect();
    let text = format!(
        "name = \"own\"\ncoordinates = [{}]\n{rest}\n[steady.rest]\n{}",
        names.join(", "),
        steady.concat()
    );
    found(&text, &Wanted::default())
}

/// A chain of masses m, M, m with stiff springs between them runs freely: λ² is a factor, and its zeros are so to the last digit. The others are
/// λ² = −k/m, the middle at rest, and −k/m (1 + 2 m/M), the ends together.
#[test]
fn zeros_of_a_free_chain_are_exact() {
    for (m, big, k) in [
        ("1.99", "2.66", "1.6e9"),
        ("1.99e-26", "2.66e-26", "1.6e3"),
        ("1.6", "2.76", "1637"),
    ] {
        let own = at_rest(
            &["x", "y", "z"],
            &format!("parameters = {{ m = {m}, M = {big}, k = {k} }}\nlagrangian = \"1/2 m x'^2 + 1/2 M y'^2 + 1/2 m z'^2 - 1/2 k (y - x)^2 - 1/2 k (z - y)^2\""),
        );
        let list = own.eigenvalues_at(None).unwrap().values;
        let zeros = list.iter().filter(|l| **l == (0.0, 0.0)).count();
        assert_eq!(zeros, 2, "{list:?}");
        let [m, big, k] = [m, big, k].map(|text| text.parse::<f64>().unwrap());
        let expected = [(k / m).sqrt(), (k / m * (1.0 + 2.0 * m / big)).sqrt()];
        for omega in expected {
            let is_own = |l: &&(f64, f64)| (l.1 - omega).abs() < 1e-13 * omega;
            let near = list.iter().filter(is_own).count();
            assert_eq!(near, 1, "{omega}: {list:?}");
        }
        let largest = list.iter().map(|l| l.0.abs()).fold(0.0, f64::max);
        assert!(largest < 1e-13 * expected[1], "{list:?}");
        // Two zeros and one direction in which the chain stands at another place.
        let modes = own.modes();
        assert_eq!(
            modes
                .iter()
                .filter(|own| own.eigenvalue == (0.0, 0.0))
                .count(),
            1,
            "{modes:?}"
        );
        let still = modes
            .iter()
            .find(|own| own.eigenvalue == (0.0, 0.0))
            .unwrap();
        for (at, entry) in still.vector.iter().enumerate() {
            let expected = if at < 3 { 3.0_f64.sqrt().recip() } else { 0.0 };
            let distance = (entry.0 - expected).hypot(entry.1);
            assert!(distance < 1e-12, "{still:?}");
        }
    }
}

/// An eigenvalue has as many modes as it has independent vectors, and a Jordan block where these are fewer than its multiplicity. Two equal oscillators
/// move each alone: (1, 0, i, 0) and (0, 1, 0, i). With y pushing x there is one mode, (1, 0, i, 0). x'' = −2 x' − x has (λ + 1)² and the vector
/// (1, −1); two of them have two vectors of four.
#[test]
fn multiple_eigenvalues_have_all_their_modes() {
    let law = |x: &str, y: &str| {
        format!("lagrangian = \"1/2 x'^2 + 1/2 y'^2\"\nforces = {{ x = \"{x}\", y = \"{y}\" }}")
    };
    let half = 0.5_f64.sqrt();
    let cases = [
        (law("-x", "-y"), (0.0, 1.0), 2, "", 2),
        (
            law("-x + y", "-y"),
            (0.0, 1.0),
            1,
            "an imaginary pair has multiplicity 2 and 1 ",
            2,
        ),
        (
            law("-2 x' - x", "-2 y' - y"),
            (-1.0, 0.0),
            2,
            "the eigenvalue -1.000000 has multiplicity 4 and 2 eigenvectors",
            4,
        ),
    ];
    for (law, eigenvalue, count, said, multiplicity) in cases {
        let own = at_rest(&["x", "y"], &law);
        let modes = own.modes();
        assert_eq!(modes.len(), count, "{law}: {modes:?}");
        for (at, mode) in modes.iter().enumerate() {
            let (re, im) = mode.eigenvalue;
            assert!((re - eigenvalue.0).abs() + (im - eigenvalue.1).abs() < 1e-15);
            assert_eq!(mode.multiplicity, multiplicity);
            // The velocities are λ times the positions.
            let rate = [half * eigenvalue.0, half * eigenvalue.1];
            let mut expected = [[0.0; 2]; 4];
            let sign = if eigenvalue.0 < 0.0 { 1.0 } else { 0.0 };
            expected[at][0] = half;
            expected[at + 2] = rate;
            for (entry, expected) in mode.vector.iter().zip(expected) {
                // The largest entry is made positive: of two as large either one may be.
                let turned = [(1.0, 0.0), (0.0, -1.0), (-sign, 0.0)].iter().any(|turn| {
                    let re = turn.0 * expected[0] - turn.1 * expected[1];
                    let im = turn.0 * expected[1] + turn.1 * expected[0];
                    (entry.0 - re).abs() + (entry.1 - im).abs() < 1e-12
                });
                assert!(turned, "{law}: {modes:?}");
            }
        }
        let text = own.linear_text();
        assert_eq!(text.contains("A Jordan block"), !said.is_empty(), "{text}");
        assert!(text.contains(said), "{text}");
    }
}

/// Of two equal oscillators that one force moves together, the difference alone is not reached; of unlike ones each is.
#[test]
fn one_of_two_equal_modes_is_not_reached() {
    let own = |k: &str| {
        at_rest(
            &["x", "y"],
            &format!("parameters = {{ k = {k} }}\ncontrols = {{ u = {{}} }}\nlagrangian = \"1/2 x'^2 + 1/2 y'^2 - 1/2 x^2 - 1/2 k y^2\"\nforces = {{ x = \"u\", y = \"u\" }}"),
        )
        .linear_text()
    };
    let equal = own("1");
    assert!(
        equal.contains(
            "of the 2 independent modes with the eigenvalue 0.000000+1.000000i 1 is not reached"
        ),
        "{equal}"
    );
    assert!(!own("2").contains("not reached"));
}

/// The map says of a boundary what happens there. Of x'' = −k x and y'' = −q y eigenvalues are zero at k = 0 and at q = 0, where a pair of each passes to
/// the real axis; at k = q two pairs on the axis are the same, and nothing passes. Of two oscillators (λ² + c λ + k)² + 1/25 a pair passes where
/// c² k = 1/25; at c = 0, where λ² = −k ± i/5, two eigenvalues are opposite, and none is on the axis.
#[test]
fn a_map_says_what_passes() {
    let drawn = |forces: &str, parameters: &str, over: &str| {
        let text = format!("name = \"own\"\ncoordinates = [\"x\", \"y\"]\nparameters = {{ {parameters} }}\nlagrangian = \"1/2 x'^2 + 1/2 y'^2\"\nforces = {{ {forces} }}\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n");
        let over = Wanted {
            over: Some(over),
            ..Wanted::default()
        };
        map(&model(&text), &over, &mut |_| {}).unwrap()
    };
    let free = drawn(
        "x = \"-k x\", y = \"-q y\"",
        "k = 1, q = 2",
        "k=-1:2,q=-1:2",
    );
    assert!(!free.curves.is_empty());
    assert!(
        free.curves.iter().all(|own| own.kind == "zero"),
        "{}",
        free.text()
    );
    let mut kinds: Vec<&str> = free.equations.iter().map(|own| own.kind).collect();
    kinds.sort_unstable();
    assert_eq!(kinds, ["opposite", "zero", "zero"], "{:?}", free.equations);
    let turned = drawn(
        "x = \"-k x - c x' + y/5\", y = \"-k y - c y' - x/5\"",
        "k = 1, c = 0.1",
        "k=-1:5,c=0.01:1",
    );
    let of = |text: &str| {
        let mut all = turned.equations.iter();
        all.find(|own| own.function == text).map(|own| own.kind)
    };
    assert_eq!(of("c"), Some("opposite"), "{:?}", turned.equations);
    let passing = turned.equations.iter().filter(|own| own.kind == "pair");
    assert_eq!(passing.count(), 1, "{:?}", turned.equations);
    for own in turned.curves.iter().filter(|own| own.kind == "pair") {
        for (k, c) in &own.points {
            assert!((c * c * k - 0.04).abs() < 1e-9, "{k} {c}");
        }
    }
}

/// With x'' = −p x − c x' − y/2 and y'' = −y + x − y'/3 an eigenvalue is zero where p = −1/2, for every c, and a pair passes where Δ₃ = 0; each
/// boundary of the map lies on its own curve up to where both meet.
#[test]
fn boundaries_of_a_map_end_where_they_meet() {
    let text = "name = \"own\"\ncoordinates = [\"x\", \"y\"]\nparameters = { p = 1, c = 1 }\nlagrangian = \"1/2 x'^2 + 1/2 y'^2 - 1/2 p x^2 - 1/2 y^2\"\nforces = { x = \"-c x' - y/2\", y = \"x - y'/3\" }\n[steady.rest]\nx = 0\ny = 0\n";
    let over = Wanted {
        over: Some("p=-2:2,c=0.01:2"),
        ..Wanted::default()
    };
    let found = map(&model(text), &over, &mut |_| {}).unwrap();
    // λ⁴ + a λ³ + b λ² + d λ + e with e = p + 1/2.
    let pair = |p: f64, c: f64| {
        let (a, b, d, e) = (c + 1.0 / 3.0, p + 1.0 + c / 3.0, c + p / 3.0, p + 0.5);
        a * b * d - d * d - a * a * e
    };
    let mut meets = 0;
    for own in &found.curves {
        for &(p, c) in &own.points {
            let (zero, pair) = ((p + 0.5).abs() < 1e-9, pair(p, c).abs() < 1e-9);
            assert!(
                if own.kind == "zero" { zero } else { pair },
                "{} {p} {c}",
                own.kind
            );
            meets += usize::from(zero && pair);
        }
    }
    assert_eq!(meets, 2, "{}", found.text());
}

/// x'' + c x' + k x = 0 with c = 10⁸ + 10⁻⁹ and k = 1/10 has the eigenvalues −10⁸ and −10⁻⁹: each is printed, as it is enclosed.
#[test]
fn slow_eigenvalues_beside_fast_ones_are_printed() {
    let own = at_rest(
        &["x"],
        "lagrangian = \"x'^2/2 - x^2/20\"\nforces = { x = \"-(100000000 + 1/1000000000) x'\" }",
    );
    let found = own.eigenvalues_at(None).unwrap();
    assert!(found.are_enclosed);
    assert_eq!(found.values, [(-1e8, 0.0), (-1e-9, 0.0)]);
    assert_eq!(own.modes().len(), 2);
    let text = own.linear_text();
    for line in ["  -1.000000e8\n", "  -1.000000e-9\n"] {
        assert!(text.contains(line), "{text}");
    }
}

/// A motion at x = √(b − 3) is none where b < 3: the table says so, and has eigenvalues at the end b = 3 where it begins.
#[test]
fn a_table_says_where_there_is_no_motion() {
    let text = r#"
coordinates = ["x"]
parameters = { b = 5 }
lagrangian = "x'^2/2 - (x - sqrt(b - 3))^2/2"
forces = { x = "-x'" }
[steady.s]
x = "sqrt(b - 3)"
"x'" = 0
"#;
    let over = |range| {
        let wanted = Wanted {
            over: Some(range),
            ..Wanted::default()
        };
        found(text, &wanted).ranges_text()
    };
    let rows = |text: &str| -> Vec<bool> {
        let lines = text.lines().filter(|line| line.starts_with("  b = "));
        lines.map(|line| line.contains("no such motion")).collect()
    };
    let whole = over("b=0:10");
    let expected: Vec<bool> = (0..=10).map(|b| b < 3).collect();
    assert_eq!(rows(&whole), expected, "{whole}");
    let below = over("b=-7:3");
    let expected: Vec<bool> = (-7..=3).map(|b| b < 3).collect();
    assert_eq!(rows(&below), expected, "{below}");
}

/// √(10¹² + 1) − 10⁶ = 4.99999999999875·10⁻⁷ and √(10⁸⁰ + 1) − 10⁴⁰ = 5·10⁻⁴¹: matrices, polynomials and modes have these, where doubles lose all digits.
#[test]
fn numbers_of_large_parts_that_cancel_have_all_digits() {
    for (stiffness, value) in [
        ("sqrt(1000000000001) - 1000000", 4.99999999999875e-7_f64),
        ("sqrt(10^80 + 1) - 10^40", 5e-41),
    ] {
        let own = at_rest(
            &["x"],
            &format!("lagrangian = \"x'^2/2 - ({stiffness}) x^2/2\""),
        );
        let found = own.eigenvalues_at(None).unwrap().values;
        let rate = value.sqrt();
        assert!(found.iter().all(|l| l.0 == 0.0), "{found:?}");
        assert!((found[0].1.abs() - rate).abs() < 1e-14 * rate, "{found:?}");
        let all = own.matrices().matrices;
        let (_, a, _) = all.iter().find(|own| own.0 == "A").unwrap();
        assert!((a[1][0] + value).abs() < 1e-14 * value, "{a:?}");
    }
}

/// Two oscillators at rest over the parameter c.
fn over_c(head: &str, forces: [&str; 2], place: &str) -> String {
    format!(
        "coordinates = [\"x\", \"y\"]\n{head}\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\n[forces]\nx = \"{}\"\ny = \"{}\"\n\
         [steady.s]\nx = \"{place}\"\ny = 0\nover = \"c\"\n",
        forces[0], forces[1]
    )
}

/// Where eigenvalues are opposite for all values nothing is called unstable: λ² + √c λ + 2 and λ² + 1 − √c lie left of the axis and on it for c < 1.
#[test]
fn opposite_eigenvalues_are_no_instability() {
    let text = over_c(
        "parameters = { c = 0.5 }",
        ["-sqrt(c) x' - 2 x", "-(1 - sqrt(c)) y"],
        "0",
    );
    let own = found(
        &text,
        &Wanted {
            over: Some("c=0:3"),
            ..Wanted::default()
        },
    );
    let data = own.json();
    let places: Vec<&str> = data["regions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|region| region["stability"].as_str().unwrap())
        .collect();
    assert_eq!(places, ["spectral", "unstable"]);
}

/// A motion that the model excludes by an assumption, and one that is not real, is none: no boundary lies there, and its values are one region.
#[test]
fn what_is_assumed_bounds_the_regions() {
    let wanted = Wanted {
        over: Some("c=-1:4"),
        ..Wanted::default()
    };
    // x = √(c (c − 2)) is not real between 0 and 2; the stiffness c − 1 would vanish there.
    let unreal = over_c(
        "parameters = { c = 3 }",
        ["-(c - 1)^2 (x - sqrt(c (c - 2))) - x'", "-(c - 1) y - y'"],
        "sqrt(c (c - 2))",
    );
    let text = found(&unreal, &wanted).ranges_text();
    assert!(text.contains("0 < c < 2: no such motion"), "{text}");
    assert!(!text.contains("c = 1:"), "{text}");
    let assumed = over_c(
        "parameters = { c = 3 }\nassumptions = [\"c > 2\"]",
        ["-x - x'", "-(c - 1) y - y'"],
        "0",
    );
    let text = found(&assumed, &wanted).ranges_text();
    assert!(text.contains("-1 < c < 2: no such motion"), "{text}");
    assert!(text.contains("2 < c < 4: stable"), "{text}");
    assert!(!text.contains("c = 1:"), "{text}");
}

/// On the edge of a map where a pair lies on the axis for all values rounding makes no boundary: y'' = −q y' − y, x'' = −(p − 1/4) x' − x.
#[test]
fn the_axis_is_no_boundary_of_a_map() {
    let text = "coordinates = [\"x\", \"y\"]\nparameters = { p = 0.5, q = 0.3 }\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\n[forces]\n\
         x = \"-x'*(p - 1/4) - x*sqrt(p)\"\ny = \"-y'*sqrt(q) - y\"\n[steady.s]\nx = 0\ny = 0\n";
    let wanted = Wanted {
        over: Some("p=1/8:1,q=0:1"),
        ..Wanted::default()
    };
    let map = map(&model(text), &wanted, &mut |_| {}).unwrap();
    assert_eq!(map.curves.len(), 1, "{:?}", map.curves.len());
    assert!(map.curves[0]
        .points
        .iter()
        .all(|(p, _)| (p - 0.25).abs() < 1e-9));
    assert!(map.kinds[..=map.side].contains(&Kind::Stable));
}
