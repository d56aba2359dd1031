//! Legendre's and Jacobi's conditions, with values that follow from closed solutions of Jacobi's equation.

use crate::table::{read_text, studied_text};
use chetaev_model::Style;
use chetaev_symbolic::Verdict;

/// A density of u and v on 0 < x < l, where `held` names what is given at each end; densities at the ends may be added.
fn text(density: &str, length: &str, ends: [&str; 2], stated: &str) -> String {
    let fields = if density.contains('v') || ends.iter().any(|end| end.contains('v')) {
        (
            "u = \"scalar\"\nv = \"scalar\"",
            "fields = { u = \"0\", v = \"0\" }",
        )
    } else {
        ("u = \"scalar\"", "fields = { u = \"0\" }")
    };
    format!(
        r#"
kind = "functional"
name = "form"
density = "{density}"
[domain]
coordinates = ["x"]
intervals = {{ x = [0, "l"] }}
[parameters]
l = "{length}"
[fields]
{}
[boundary]
"x = 0" = {}
"x = l" = {}
[solutions.rest]
{}
{stated}
"#,
        fields.0, ends[0], ends[1], fields.1
    )
}

const HELD: &str = "{ fixed = [\"u\"] }";
const BOTH_HELD: &str = "{ fixed = [\"u\", \"v\"] }";
const FREE: &str = "\"0\"";

fn verdict(density: &str, length: &str, ends: [&str; 2]) -> Verdict {
    let study = studied_text("p4p", &text(density, length, ends, ""), &[]);
    let mut all = study.verdicts.iter();
    let own = all.find(|d| d.claim == "functional.second-variation");
    own.unwrap().finding.verdict.clone()
}

fn words(cases: &[(&str, &str, [&str; 2], &str)]) {
    for (density, length, ends, word) in cases {
        let own = verdict(density, length, *ends);
        assert_eq!(
            own.word(),
            *word,
            "{density}, l = {length}, {ends:?}: {}",
            own.detail()
        );
    }
}

#[test]
fn a_conjugate_point_is_inside_at_the_end_or_beyond() {
    // v'' + v = 0: sin x, cos x, and k l = 1 for a spring that pushes.
    let string = "1/2 u,x^2 - 1/2 u^2";
    words(&[
        (string, "3", [HELD, HELD], "proved"),
        (string, "314/100", [HELD, HELD], "proved"),
        (string, "pi", [HELD, HELD], "conditional"),
        (string, "22/7", [HELD, HELD], "refuted"),
        (string, "4", [HELD, HELD], "refuted"),
        (string, "3/2", [HELD, FREE], "proved"),
        (string, "pi/2", [HELD, FREE], "conditional"),
        (string, "pi/2", [FREE, HELD], "conditional"),
        (string, "8/5", [HELD, FREE], "refuted"),
        (string, "8/5", [FREE, HELD], "refuted"),
        (string, "1/10", [FREE, FREE], "refuted"),
        ("1/2 u,x^2", "1", [FREE, FREE], "conditional"),
        ("1/2 u,x^2 + 1/2 u^2", "1", [FREE, FREE], "proved"),
        ("1/2 u,x^2", "1/2", [HELD, "\"-1/2 u^2\""], "proved"),
        ("1/2 u,x^2", "1", [HELD, "\"-1/2 u^2\""], "conditional"),
        ("1/2 u,x^2", "2", [HELD, "\"-1/2 u^2\""], "refuted"),
        // The same by a divergence in the density.
        ("1/2 u,x^2 - u u,x", "1/2", [HELD, FREE], "proved"),
        ("1/2 u,x^2 - u u,x", "1", [HELD, FREE], "conditional"),
        ("1/2 u,x^2 - u u,x", "2", [HELD, FREE], "refuted"),
        ("1/2 u,x^2 - u u,x", "2", [HELD, HELD], "proved"),
    ]);
    match verdict(string, "pi", [HELD, HELD]) {
        Verdict::Conditional { condition, .. } => {
            assert!(condition.contains("sin(x)"), "{condition}")
        }
        other => panic!("{}", other.word()),
    }
}

/// Of ∫ (v'² − v²) dx a constant makes −1 on 0 < x < 1: the second variation as it is defined, and the variation.
#[test]
fn a_refutation_shows_its_variation() {
    let Verdict::Refuted(found) = verdict("1/2 u,x^2 - 1/2 u^2", "1", [FREE, FREE]) else {
        panic!("not refuted");
    };
    assert!(
        found
            .detail
            .contains("as for the variation of u: 1, the second variation is -1.0"),
        "{}",
        found.detail
    );
}

#[test]
fn the_sign_of_the_leading_coefficient_is_that_of_the_whole_interval() {
    words(&[
        ("-1/2 u,x^2", "1", [HELD, HELD], "refuted"),
        ("-1/2 u,x^2 + 10 u^2", "1", [HELD, FREE], "refuted"),
        ("1/2 (x - 1) u,x^2", "2", [HELD, HELD], "refuted"),
        // Negative on a thousandth of the interval only.
        (
            "1/2 (x - 1/3) (x - 334/1001) u,x^2",
            "1",
            [HELD, HELD],
            "refuted",
        ),
        (
            "1/2 ((x - 1/3)^2 + 1/1000000) u,x^2",
            "1",
            [HELD, HELD],
            "proved",
        ),
        // A zero inside, beside which it is positive: no second variation vanishes for v that does not.
        ("1/2 (x - 1)^2 u,x^2", "2", [HELD, HELD], "proved"),
        ("exp(x) u,x^2/2 - 1/2 u^2", "1", [HELD, HELD], "proved"),
        ("(cos(x) - 99/100) u,x^2", "1", [HELD, HELD], "refuted"),
    ]);
}

#[test]
fn several_fields_have_a_determinant() {
    let pair = "1/2 u,x^2 + 1/2 v,x^2";
    let coupled = format!("{pair} - 2 u v");
    words(&[
        // u = v: v'' + 2 v = 0, conjugate at π/√2 = 2.2214…
        (&coupled, "3", [BOTH_HELD, BOTH_HELD], "refuted"),
        (&coupled, "2", [BOTH_HELD, BOTH_HELD], "numerical"),
        // A double zero of the determinant, which has no change of sign.
        (
            &format!("{pair} - 1/2 u^2 - 1/2 v^2"),
            "4",
            [BOTH_HELD, BOTH_HELD],
            "refuted",
        ),
        (
            &format!("{pair} - 1/2 u^2 - 1/2 v^2"),
            "3",
            [BOTH_HELD, BOTH_HELD],
            "numerical",
        ),
        (pair, "1", [BOTH_HELD, FREE], "proved"),
        (
            &format!("{pair} + 1/2 u^2 + 1/2 v^2 + 1/2 u v"),
            "9",
            [FREE, FREE],
            "proved",
        ),
        (
            "1/2 u,x^2 - 1/2 v,x^2",
            "1",
            [BOTH_HELD, BOTH_HELD],
            "refuted",
        ),
        (
            &format!("{pair} + 3/2 u,x v,x"),
            "1",
            [BOTH_HELD, BOTH_HELD],
            "refuted",
        ),
        // One field free at the right end: conjugate at π/2.
        (
            &format!("{pair} - 1/2 u^2"),
            "2",
            [BOTH_HELD, "{ fixed = [\"v\"] }"],
            "refuted",
        ),
        (
            &format!("{pair} - 1/2 u^2"),
            "3/2",
            [BOTH_HELD, "{ fixed = [\"v\"] }"],
            "numerical",
        ),
    ]);
    let own = verdict(&coupled, "3", [BOTH_HELD, BOTH_HELD]);
    let place = own
        .detail()
        .split("x = ")
        .nth(1)
        .unwrap()
        .split(',')
        .next()
        .unwrap()
        .to_owned();
    let exact = std::f64::consts::PI / 2_f64.sqrt();
    assert!(
        (place.parse::<f64>().unwrap() - exact).abs() < 1e-9,
        "{place}"
    );
}

#[test]
fn two_fields_may_have_one_conjugate_point() {
    // Two strings side by side: det V = sin² x touches zero at π and does not change its sign.
    let strings = "1/2 u,x^2 + 1/2 v,x^2 - 1/2 u^2 - 1/2 v^2";
    // The same in sums and differences.
    let mixed = "1/2 u,x^2 + 1/2 v,x^2 + 1/2 u,x v,x - 1/2 u^2 - 1/2 v^2 - 1/2 u v";
    for density in [strings, mixed] {
        words(&[
            (density, "3", [BOTH_HELD, BOTH_HELD], "numerical"),
            (density, "pi", [BOTH_HELD, BOTH_HELD], "undecided"),
            (density, "4", [BOTH_HELD, BOTH_HELD], "refuted"),
            (density, "9", [BOTH_HELD, BOTH_HELD], "refuted"),
        ]);
        let own = verdict(density, "4", [BOTH_HELD, BOTH_HELD]);
        assert!(own.detail().contains("3.14159"), "{}", own.detail());
    }
}

#[test]
fn where_the_conditions_do_not_apply_it_is_said() {
    for (text, words) in [
        (
            text("1/2 u,xx^2", "1", [HELD, HELD], ""),
            "second derivative of u",
        ),
        (text("1/2 u^2", "1", [HELD, HELD], ""), "no derivative of u"),
        (
            text("1/2 u,x^2", "1", [HELD, HELD], "[equations]\nb = \"u = 0\"")
                .replace("[domain]", "[dom]")
                .replacen("density", "imposed = [\"b\"]\ndensity", 1)
                .replace("[dom]", "[domain]"),
            "(b) is imposed",
        ),
        (
            text("1/2 u,x^2", "1", [HELD, "\"u u,x\""], ""),
            "a derivative of u",
        ),
        (
            text("1/2 u,x^2", "1", [FREE, HELD], "").replace("u = \"0\" }", "u = \"x^2\" }"),
            "not proved to make the functional stationary",
        ),
    ] {
        let study = studied_text("p4p", &text, &[]);
        let mut all = study.verdicts.iter();
        let own = all
            .find(|d| d.claim == "functional.second-variation")
            .unwrap();
        let verdict = &own.finding.verdict;
        assert_eq!(
            verdict.word(),
            "not-applicable",
            "{words}: {}",
            verdict.detail()
        );
        assert!(
            verdict.detail().contains(words),
            "{words}: {}",
            verdict.detail()
        );
    }
}

#[test]
fn an_interval_without_length_is_refused() {
    for length in ["-1", "0", "1 - sqrt(2)", "sin(pi)"] {
        let loaded = read_text("p4p", &text("1/2 u,x^2", length, [HELD, HELD], ""), &[]);
        let said = loaded.diagnostics.render(Style::Plain);
        assert!(loaded.problem.is_none(), "{length}");
        assert!(
            said.contains("has no positive length") && said.contains(":7:"),
            "{said}"
        );
    }
}

#[test]
fn a_parameter_without_a_value_has_no_conjugate_point() {
    let text = text("1/2 u,x^2 - k/2 u^2", "1", [HELD, HELD], "")
        .replace("[parameters]", "[parameters]\nk = {}");
    let study = studied_text("p4p", &text, &[]);
    let mut all = study.verdicts.iter();
    let own = all.find(|d| d.claim == "functional.second-variation");
    let verdict = &own.unwrap().finding.verdict;
    assert_eq!(verdict.word(), "undecided");
    assert!(
        verdict.detail().contains("no numbers"),
        "{}",
        verdict.detail()
    );
}

/// A form without a positive square among the first polynomials, or with an end that is no rational number, is negative all the same: 1 − x for
/// 2 u u' on both free ends, x for v'' + v = 0 on (0, π).
#[test]
fn negative_values_are_found_where_first_squares_vanish() {
    let string = "1/2 u,x^2 - 1/2 u^2";
    words(&[
        ("1/2 u,x^2 + 2 u u,x", "1", [FREE, FREE], "refuted"),
        (string, "1", [HELD, "\"-1/3 u^2\""], "refuted"),
        (string, "pi", [HELD, FREE], "refuted"),
        (string, "pi", [FREE, FREE], "refuted"),
        (
            "1/2 u,x^2 + 1/2 v,x^2 - 4 u v",
            "1",
            [FREE, FREE],
            "refuted",
        ),
        // The ends are held for one field, and free for the other one.
        (
            "1/2 u,x^2 + 1/2 v,x^2 - 1/2 v^2",
            "pi",
            [HELD, HELD],
            "refuted",
        ),
    ]);
}

/// With a small P a basis oscillates fast, and what refutes is found before it is followed: ∫ (P v'² − v²) is P/3 − 1/30 for v = x (1 − x).
#[test]
fn a_small_leading_coefficient_is_refuted_at_once() {
    let start = std::time::Instant::now();
    words(&[
        ("1/10^20 u,x^2 - u^2", "1", [HELD, HELD], "refuted"),
        // R is negative on a thousandth of the interval: the variation is zero elsewhere.
        (
            "1/10^20 u,x^2 + (x - 1/1000) u^2",
            "1",
            [HELD, HELD],
            "refuted",
        ),
        (
            "1/10^20 (u,x^2 + v,x^2) - u v",
            "1",
            [BOTH_HELD, BOTH_HELD],
            "refuted",
        ),
    ]);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
    let own = verdict("1/10^20 u,x^2 + (x - 1/1000) u^2", "1", [HELD, HELD]);
    assert!(
        own.detail().contains("outside of the part between"),
        "{}",
        own.detail()
    );
}

/// u'⁴ at u = 0 has no second variation, which is positive for no variation.
#[test]
fn what_vanishes_is_not_positive() {
    words(&[
        ("1/4 u,x^4", "1", [HELD, HELD], "refuted"),
        ("1/4 u,x^4", "1", [HELD, "\"u^2\""], "undecided"),
    ]);
    let own = verdict("1/2 (x - 1/2)^2 u,x^2", "1", [HELD, HELD]);
    assert_eq!(own.word(), "proved");
    assert!(!own.detail().contains("is positive"), "{}", own.detail());
}
