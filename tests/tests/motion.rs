//! Claims about computed motions, on systems made up for the ways in which they could go wrong.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev::model::{load, Files};
use chetaev_tests::runs::{ended, Ask, Ended};

struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str) -> Result<String, String> {
        Err("no files here".into())
    }
}

fn study(text: &str, claims: &[&'static str]) -> Ended {
    let ask = Ask {
        claims: claims.to_vec(),
        ..Ask::default()
    };
    ended(load("motion.toml", text, &NoFiles, &[]), &ask)
}

/// The word and the sentence of a verdict.
fn verdict(ended: &Ended, claim: &str) -> (String, String) {
    let study = ended
        .study
        .as_ref()
        .unwrap_or_else(|| panic!("{}", ended.text));
    let decided = study.verdicts.iter().find(|d| d.full_id() == claim);
    let verdict = &decided
        .unwrap_or_else(|| panic!("no verdict of {claim}"))
        .finding
        .verdict;
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

/// Coordinates, Lagrangian, and the rest of the file.
const ANALYTIC: [(&str, &str, &str); 22] = [
    ("x", "x'^2/2 + cos(x) + x sin(t)", "[initial]\nx = 1"),
    (
        "x, y, z",
        "(x'^2 + y'^2 + z'^2)/2 + x y' - y x' + t z'",
        "constraints = [\"z' = y x'\"]\n[initial]\ny = 1\n\"x'\" = 1",
    ),
    ("x", "x'^2/2 + cos(x)", "[initial]\nx = 1"),
    ("x", "x'^2/2 + cos(x)", "[initial]\nx = 3\n\"x'\" = 0.5"),
    (
        "x",
        "x'^2/2 - x^4/4 + x^2/2 + x cos(2 t)",
        "[initial]\nx = 0.5",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)",
        "[initial]\nx = 0.5\n\"y'\" = 1.7",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2 y + y^3/3",
        "[initial]\nx = 0.1\ny = 0.2\n\"x'\" = 0.3",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 + x y' - y x' - (x^2 + 2 y^2)/2",
        "[initial]\nx = 1\n\"y'\" = 1",
    ),
    (
        "x, y, z",
        "(x'^2 + y'^2 + z'^2)/2",
        "constraints = [\"z' = y x'\"]\n[initial]\ny = 1\n\"x'\" = 1\n\"y'\" = 1",
    ),
    (
        "x, y, p",
        "(x'^2 + y'^2 + p'^2)/2 + x",
        "constraints = [\"x' sin(p) = y' cos(p)\"]\n[initial]\n\"p'\" = 1.3",
    ),
    (
        "a, b",
        "a'^2 + b'^2/2 + a' b' cos(a - b) + 2 cos(a) + cos(b)",
        "[initial]\na = 2\nb = 1",
    ),
    ("x", "x'^2/2 - (1 - exp(-x))^2", "[initial]\nx = 1"),
    (
        "x, y, z",
        "(x'^2 + y'^2 + z'^2)/2 - z",
        "constraints = [\"z' = sqrt(x'^2 + y'^2)\"]\n[initial]\n\"x'\" = 1\n\"y'\" = 0.5",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 - y",
        "constraints = [\"x^2 + y^2 = 1\"]\n[initial]\nx = 1",
    ),
    (
        "a, b, c",
        "(a'^2 + b'^2 sin(a)^2)/2 + (c' + b' cos(a))^2/2 - cos(a)",
        "[initial]\na = 1\n\"b'\" = 0.3\n\"c'\" = 3",
    ),
    ("x", "x'^2/2 - x^2/2", "[initial]\nx = 1"),
    ("x", "x'^2/2 - x", "[initial]\n\"x'\" = 1"),
    (
        "x, y",
        "(x'^2 + y'^2)/2 - y",
        "constraints = [\"y' = x cos(t)\"]\n[initial]\nx = 1\n\"x'\" = 1",
    ),
    ("x", "-sqrt(1 - x'^2) - x^2/2", "[initial]\nx = 1"),
    ("x", "x'^2/2 - 50 x^2 + x sin(10 t)", "[initial]\nx = 1"),
    (
        "x",
        "x'^2/2 - x^2/2",
        "[initial]\nx = 2\n[forces]\nx = \"(1 - x^2) x'\"",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 (2 + sin(x)) - cos(x + y)",
        "[initial]\nx = 2\n\"y'\" = 1",
    ),
];

/// Motions that are polynomials of a degree which the methods integrate without error show no order.
const POLYNOMIAL: [usize; 2] = [12, 16];

fn file(coordinates: &str, lagrangian: &str, rest: &str) -> String {
    let names: Vec<String> = coordinates
        .split(", ")
        .map(|c| format!("\"{c}\""))
        .collect();
    format!(
        "coordinates = [{}]\nlagrangian = \"{lagrangian}\"\n{rest}\n",
        names.join(", ")
    )
}

/// The order of a Runge–Kutta method on analytic equations is its nominal one (Hairer, Nørsett, Wanner 1993, II.3).
#[test]
fn the_order_of_a_method_is_never_refuted_on_analytic_equations() {
    for method in ["dop853", "tsit5", "rk4"] {
        let step = if method == "rk4" { "step = 0.02\n" } else { "" };
        for (i, (coordinates, lagrangian, rest)) in ANALYTIC.iter().enumerate() {
            let text = file(coordinates, lagrangian, rest);
            let text = format!("{text}[simulation]\nmethod = \"{method}\"\n{step}");
            let (word, detail) = verdict(
                &study(&text, &["motion.method-order"]),
                "motion.method-order",
            );
            let allowed: &[&str] = match POLYNOMIAL.contains(&i) {
                true => &["undecided"],
                false => &["numerical"],
            };
            assert!(
                allowed.contains(&word.as_str()),
                "{method}, {lagrangian}: {word}, {detail}"
            );
        }
    }
}

/// Across a corner of the force the error of a step is of order 3 at best, whatever the method, and the claim says where.
#[test]
fn a_corner_that_is_crossed_refutes_the_order() {
    let claim = "motion.method-order";
    let body = |force: &str| {
        let text = file("x", "x'^2/2 - x^2/2", "[initial]\nx = 1\n[forces]\n");
        format!("{text}x = \"{force}\"\n")
    };
    // x'' = -x - |x| from rest at 1 reaches 0 at t = pi/(2 sqrt(2)).
    let (word, detail) = verdict(&study(&body("-abs(x)"), &[claim]), claim);
    assert_eq!(word, "refuted", "{detail}");
    assert!(
        detail.contains("abs(x)") && detail.contains("t = 1.1107"),
        "{detail}"
    );
    // Where x > -9 that is x'' = -2 x, an oscillation between -1 and 1, which never comes to the corner.
    let (word, detail) = verdict(&study(&body("-abs(x + 9) + 9"), &[claim]), claim);
    assert_eq!(word, "numerical", "{detail}");
}
