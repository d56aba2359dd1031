//! Ritz's method, the second variation and Lagrange multipliers, against closed solutions and references (S-F16, S-F17).

use crate::table::{loaded_text, read_text, row_text, studied_text};
use chetaev_functionals::ritz::{approximation, RitzError};
use chetaev_functionals::{study_at, Pace, Study};
use chetaev_model::Style;
use chetaev_symbolic::meter::{Work, UNITS_PER_SECOND};
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
    let (word, detail) = verdict(&studied_text("p4p", &wrong, &[]), "functional.ritz");
    assert_eq!(word, "refuted");
    // (P l + F l²/2)/E = (3/4 + 9/8)/2.
    assert!(detail.contains("is 15/16"), "{detail}");
    // Minus the potential energy: −(P² l + P F l² + F² l³/3)/(2E) = −21/32, as in every row of the table (S-F13).
    let problem = loaded_text("p4p", &text("bar"), &[]);
    let own = approximation(&problem.functional, &problem.ritz.unwrap(), 2).unwrap();
    assert_eq!(own.value.to_string(), "-21/32");
}

/// A beam that is clamped and guided, 360 x − 264 on it: w = 3 x⁵ − 11 x⁴ + 14 x³ − 13/2 x², so that w(1) = −1/2.
#[test]
fn slopes_are_given_without_the_values() {
    let text = |ends: [&str; 2], more: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 w,xx^2 - (360 x - 264) w\"\n[domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n\
             [fields]\nw = \"scalar\"\n[boundary]\n\"x = 0\" = {{ fixed = [{}] }}\n\"x = 1\" = {{ fixed = [{}] }}\n[ritz]\ndegrees = [3]\n{more}",
            ends[0], ends[1]
        )
    };
    let (clamped, guided) = ("\"w\", \"w,n\"", "\"w,n\"");
    let end = |value: &str| {
        format!("[ritz.points]\nend = {{ field = \"w\", at = {{ x = \"1\" }}, value = {value} }}\n")
    };
    let told = |text: &str| verdict(&studied_text("p4p", text, &[]), "functional.ritz");
    let (word, detail) = told(&text([clamped, guided], &end("\"-1/2\"")));
    assert_eq!(word, "proved", "{detail}");
    let (word, detail) = told(&text([clamped, guided], &end("\"0\"")));
    assert_eq!(word, "refuted", "{detail}");
    // w(1/2) = −0.46875: digits that are cut off or rounded are no other value.
    for (digits, expected) in [
        ("-0.4687", "proved"),
        ("-0.4688", "proved"),
        ("-0.4689", "refuted"),
    ] {
        let middle =
            end(&format!("\"{digits}\", exact = \"false\"")).replace("x = \"1\"", "x = \"1/2\"");
        let (word, detail) = told(&text([clamped, guided], &middle));
        assert_eq!(word, expected, "{digits}: {detail}");
    }
    // Guided at both ends and held nowhere: the load has a mean, and nothing carries it.
    let (word, detail) = told(&text([guided, guided], ""));
    assert_eq!(word, "undecided", "{detail}");
    let said = "no polynomial of degree 3 is stationary: the functional of these changes in proportion to c when c times w = 1 is added";
    assert!(detail.contains(said), "{detail}");
    // A load without a mean does no work on w = 1.
    let balanced = text([guided, guided], "").replace("(360 x - 264)", "(360 x - 180)");
    let (word, detail) = told(&balanced);
    assert_eq!(word, "undecided", "{detail}");
    let said = "no polynomial of degree 3 is the only stationary one: the functional of these does not change when w = 1 is added";
    assert!(detail.contains(said), "{detail}");
}

/// u'' + 10 u + f = 0 between two ends: 10 = k² π² for no k, so that u = x − x³ is alone for f = 6 x − 10 (x − x³), though the polynomial of degree
/// 0 costs nothing: ∫ ((1 − 2 x)² − 10 (x − x²)²) dx = 1/3 − 10/30.
#[test]
fn a_degree_without_one_stationary_polynomial_is_passed_over() {
    let held = "{ fixed = [\"u\"] }";
    let told = |degrees: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2 - 5 u^2 - (6 x - 10 (x - x^3)) u\"\n[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = {held}\n\"x = 1\" = {held}\n[ritz]\ndegrees = {degrees}\n"
        );
        verdict(&studied_text("p4p", &text, &[]), "functional.ritz")
    };
    let (word, detail) = told("[0]");
    assert_eq!(word, "undecided", "{detail}");
    assert!(detail.contains("no polynomial of degree 0"), "{detail}");
    let (word, detail) = told("[0, 1, 2]");
    assert_eq!(word, "proved", "{detail}");
}

#[test]
fn values_of_ritz_are_none_of_what_is_varied_or_stated() {
    let text = |values: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"k/2 u,x^2 - u\"\n[domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n\
             [parameters]\nk = \"1\"\n[boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = \"0\"\n[ritz]\ndegrees = [2]\nvalues = {{ {values} }}\n"
        )
    };
    let (word, detail) = verdict(
        &studied_text("p4p", &text("k = \"2\""), &[]),
        "functional.ritz",
    );
    assert_eq!(
        (&word[..], detail.contains("k = 1 is stated")),
        ("not-applicable", true),
        "{detail}"
    );
    let told = read_text("p4p", &text("u = \"2\""), &[])
        .diagnostics
        .render(Style::Plain);
    assert!(told.contains("`u` is varied"), "{told}");
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
    assert_eq!(word, "proved", "{detail}");
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
        let own = study.verdicts.iter();
        let own = own.filter(|own| own.full_id().starts_with("functional.multipliers"));
        let formulas = own.flat_map(|own| &own.finding.formulas);
        for (at, formula) in formulas.enumerate() {
            let number = format!("{}. ", at + 1);
            assert!(formula.caption.starts_with(&number), "{row}: {formula:?}");
            assert!(formula.indexed.is_some(), "{row}: {formula:?}");
        }
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

/// A clamped membrane in a box of so many dimensions, under a load, with one degree asked for.
fn box_of(dimensions: usize, degree: u32) -> String {
    let names = ["x", "y", "z"];
    let own = &names[..dimensions];
    let list = |each: &dyn Fn(&&str) -> String, between: &str| {
        let all: Vec<String> = own.iter().map(each).collect();
        all.join(between)
    };
    format!(
        "kind = \"functional\"\nname = \"box\"\ndensity = \"1/2 ({}) - u\"\n[domain]\ncoordinates = [{}]\nintervals = {{ {} }}\n[fields]\nu = \"scalar\"\n[boundary]\n{}\n[ritz]\ndegrees = [{degree}]\n",
        list(&|x| format!("u,{x}^2"), " + "),
        list(&|x| format!("\"{x}\""), ", "),
        list(&|x| format!("{x} = [0, 1]"), ", "),
        list(
            &|x| format!("\"{x} = 0\" = {{ fixed = [\"u\"] }}\n\"{x} = 1\" = {{ fixed = [\"u\"] }}"),
            "\n"
        ),
    )
}

/// A study with so many seconds of counted work, and what it spent of it.
fn within_seconds(text: &str, budget: f64) -> (Study, u64) {
    let work = Work::of_seconds(budget);
    let pace = Pace {
        budget,
        work: work.clone(),
        clock: &|| 0.0,
        progress: &mut |_| {},
    };
    let study = study_at(loaded_text("p4p", text, &[]), &|_| true, pace);
    (study, work.spent())
}

#[test]
fn ritz_of_a_high_degree_in_the_plane_is_little_work() {
    let (study, spent) = within_seconds(&box_of(2, 12), 20.0);
    let own = &study.approximations[0];
    assert_eq!(own.unknowns, 169);
    assert!(own.is_minimum);
    assert!(spent as f64 <= 10.0 * UNITS_PER_SECOND, "{spent}");
    // −∫ u/2 of the square: Σ over odd m, n of −32/(π⁶ m² n² (m² + n²)) = −0.01757212…; the torsion constant of the square
    // is 0.1405770… (Timoshenko and Goodier, Theory of Elasticity, §109), which is −8 times this value.
    let torsion = -8.0 * to_f64(&own.value);
    assert!((torsion - 0.140_577_0).abs() < 1e-6, "{torsion}");
}

#[test]
fn work_that_is_too_much_is_counted_and_said() {
    let (study, spent) = within_seconds(&box_of(3, 12), 1.0);
    let (word, detail) = verdict(&study, "functional.ritz");
    assert_eq!(word, "undecided");
    assert!(
        detail.contains("the work of the budget was spent"),
        "{detail}"
    );
    assert!((spent as f64) < 1.5 * UNITS_PER_SECOND, "{spent}");
    assert!(study.approximations.is_empty());
    // A low degree is decided.
    let (study, _) = within_seconds(&box_of(3, 1), 20.0);
    assert_eq!(study.approximations[0].unknowns, 8);
}

#[test]
fn an_indefinite_functional_has_no_minimum_among_polynomials() {
    // u v: the matrix has zeros on its diagonal, so that rows are exchanged; elimination then meets positive pivots only.
    let text = "kind = \"functional\"\nname = \"saddle\"\ndensity = \"u v - u - v\"\n[domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n[fields]\nu = \"scalar\"\nv = \"scalar\"\n[boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = \"0\"\n[ritz]\ndegrees = [0]\n";
    let problem = loaded_text("p4p", text, &[]);
    let own = approximation(&problem.functional, &problem.ritz.unwrap(), 0).unwrap();
    assert!(!own.is_minimum);
    assert_eq!(own.value.to_string(), "-1");
}

#[test]
fn ritz_says_what_it_lacks() {
    let bar = |from: &str, to: &str| {
        let text = text("bar");
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    };
    // Data without a value are not zero.
    let without =
        bar("[fields]", "[data]\ng = \"scalar\"\n[fields]").replace("- F u", "- F u - g u");
    let study = studied_text("p4p", &without, &[]);
    let (word, detail) = verdict(&study, "functional.ritz");
    assert_eq!(word, "undecided");
    assert!(detail.contains("`g` has no value"), "{detail}");
    // A point beyond the end is none of the bar.
    let beyond = bar("at = { x = \"l\" }", "at = { x = \"2 l\" }");
    let told = crate::table::read_text("p4p", &beyond, &[]);
    let said = told.diagnostics.render(chetaev_model::Style::Plain);
    assert!(said.contains("the point lies outside of the box"), "{said}");
}
