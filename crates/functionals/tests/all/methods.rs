//! Ritz's method, the second variation and Lagrange multipliers, against closed solutions and references (S-F16, S-F17).

use crate::table::{loaded_text, row_text, studied_text};
use chetaev_functionals::ritz::{approximation, RitzError};
use chetaev_functionals::Study;
use chetaev_symbolic::rational::to_f64;

fn text(name: &str) -> String {
    let path = format!(
        "{}/../../gallery/fields/{name}/model.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path).unwrap()
}

fn verdict(study: &Study, claim: &str) -> (String, String) {
    let found = study.verdicts.iter().find(|d| d.claim == claim);
    let verdict = &found
        .unwrap_or_else(|| panic!("no {claim}"))
        .finding
        .verdict;
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

/// The error at the only point for each degree; the value falls, as more polynomials are admitted.
fn errors(name: &str) -> Vec<f64> {
    let problem = loaded_text("p4p", &text(name), &[]);
    let asked = problem.ritz.unwrap();
    let point = &asked.points[0];
    let mut values = Vec::new();
    let mut found = Vec::new();
    for &degree in &asked.degrees {
        let own = approximation(&problem.functional, &asked, degree).unwrap();
        assert!(own.is_minimum);
        let (_, polynomial) = &own.fields[0];
        let difference = to_f64(&(polynomial.exact(&point.at) - &point.value)).abs();
        found.push(difference / to_f64(&point.value));
        values.push(own.value);
    }
    assert!(values.windows(2).all(|pair| pair[1] <= pair[0]), "{name}");
    found
}

#[test]
fn ritz_comes_to_the_series_of_the_plate_and_of_the_membrane() {
    // S-F16: 0.00406235266067505173 and 0.0736713532815138156.
    for (name, bound) in [("simply-supported-plate", 1e-5), ("loaded-membrane", 1e-4)] {
        let own = errors(name);
        assert!(own.last().unwrap() < &bound, "{name}: {own:?}");
        assert_eq!(
            verdict(&studied_text("p4p", &text(name), &[]), "functional.ritz").0,
            "numerical"
        );
    }
}

#[test]
fn ritz_finds_polynomial_solutions_exactly() {
    for name in ["bar", "beam-clamped"] {
        assert_eq!(errors(name).last(), Some(&0.0), "{name}");
        let study = studied_text("p4p", &text(name), &[]);
        let (word, detail) = verdict(&study, "functional.ritz");
        assert_eq!(word, "proved", "{detail}");
    }
    // A value that is not the solution's is not confirmed.
    let wrong = text("bar").replace(
        "value = \"(P l + F l^2/2)/E\"",
        "value = \"(P l + F l^2/3)/E\"",
    );
    let (word, _) = verdict(&studied_text("p4p", &wrong, &[]), "functional.ritz");
    assert_eq!(word, "undecided");
    // Minus the potential energy: −(P² l + P F l² + F² l³/3)/(2E) = −21/32, as in every row of the table (S-F13).
    let problem = loaded_text("p4p", &text("bar"), &[]);
    let own = approximation(&problem.functional, &problem.ritz.unwrap(), 2).unwrap();
    assert_eq!(own.value.to_string(), "-21/32");
}

#[test]
fn what_is_not_quadratic_is_refused() {
    let wrong = text("bar").replace("E/2 u,x^2", "E/2 u,x^4");
    let problem = loaded_text("p4p", &wrong, &[]);
    let found = approximation(&problem.functional, &problem.ritz.unwrap(), 1);
    assert_eq!(found.unwrap_err(), RitzError::NotQuadratic);
}

#[test]
fn jacobis_condition_has_the_conjugate_point_of_the_reference() {
    // S-F17.
    let model = text("conjugate-point");
    let (word, detail) = verdict(
        &studied_text("p4p", &model, &[("l", "2")]),
        "functional.second-variation",
    );
    assert_eq!(word, "numerical", "{detail}");
    let (word, detail) = verdict(
        &studied_text("p4p", &model, &[("l", "5/2")]),
        "functional.second-variation",
    );
    assert_eq!(word, "refuted", "{detail}");
    let point = detail
        .split("x = ")
        .nth(1)
        .unwrap()
        .split(',')
        .next()
        .unwrap();
    assert!(
        (point.parse::<f64>().unwrap() - 2.164_631_404_506_438_5).abs() < 1e-10,
        "{detail}"
    );
    // Without the attraction it is a sum of squares.
    let (word, _) = verdict(
        &studied_text(
            "p4p",
            &model
                .replace("- 1/2 (1 + x) u^2", "")
                .replace("u,xx + (1 + x) u", "u,xx"),
            &[],
        ),
        "functional.second-variation",
    );
    assert_eq!(word, "proved");
}

#[test]
fn multipliers_become_fields_and_fields_multipliers() {
    for (row, needed) in [
        ("p3pb", "(3)"),
        ("p2pb", "modulo (3)"),
        ("p2p1", "modulo (3)"),
        ("p1p", "modulo (3)"),
    ] {
        let study = studied_text(row, &row_text(row), &[("d", "2")]);
        let (word, detail) = verdict(&study, "functional.multipliers");
        assert_eq!(word, "proved", "{row}: {detail}");
        assert!(detail.contains(needed), "{row}: {detail}");
    }
    // Another multiplier is none.
    let text = row_text("p2p1").replace("multiplier = \"-s_ij\"", "multiplier = \"s_ij\"");
    let (word, _) = verdict(
        &studied_text("p2p1", &text, &[("d", "2")]),
        "functional.multipliers",
    );
    assert_eq!(word, "refuted");
}

#[test]
fn every_level_comes_from_the_one_above_by_a_multiplier() {
    // Courant's rule: where the multiplier is the field that the equation is conjugate to (T4 §3, §4).
    let ways = [
        ("p3p", "e_ij", "(3)"),
        ("p3cb", "-e_ij", "(3)"),
        ("p2p", "-beta_ijkl s_kl", "(3)"),
        ("p2c1", "s_ij", "(3)"),
        ("p1c", "0 s_ij", "(3)"),
        // Equilibrium has the multiplier 0 for p, as it is the Euler equation, and the displacement for c.
        ("p0p", "0 u_k", "(4)"),
        ("p0c", "u_k", ""),
        ("pp", "-Pb_k", "(7)"),
        ("pc", "-ub_k", "(8)"),
    ];
    for (row, multiplier, needed) in ways {
        let study = studied_text(row, &row_text(row), &[("d", "2")]);
        let (word, detail) = verdict(&study, "functional.multipliers");
        assert_eq!(word, "proved", "{row}: {detail}");
        assert!(
            detail.contains(&format!("multiplier {multiplier};")),
            "{row}: {detail}"
        );
        assert!(detail.contains(needed), "{row}: {detail}");
        assert!(
            detail.contains("the semi-inverse method builds it from"),
            "{row}: {detail}"
        );
        // With the opposite sign, or with something in the place of nothing, it is no multiplier.
        let other = match multiplier.strip_prefix("0 ") {
            Some(field) => field.to_owned(),
            None => format!("2 {multiplier}").replace("2 -", "-2 "),
        };
        let wrong = row_text(row).replace(
            &format!("multiplier = \"{multiplier}\""),
            &format!("multiplier = \"{other}\""),
        );
        let (word, detail) = verdict(
            &studied_text(row, &wrong, &[("d", "2")]),
            "functional.multipliers",
        );
        assert_eq!(word, "refuted", "{row} with {other}: {detail}");
    }
}
