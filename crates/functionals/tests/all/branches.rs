//! Roots and absolute values: what is true for one sign of what is under them is not called true.

use crate::table::{decided, studied_text};
use chetaev_symbolic::Verdict;

/// ∫ density over a line, with equations that are stated to follow; all are yielded.
fn verdict(density: &str, equations: &[&str]) -> Verdict {
    let labels: Vec<String> = (0..equations.len()).map(|k| format!("\"e{k}\"")).collect();
    let stated: Vec<String> = equations
        .iter()
        .enumerate()
        .map(|(k, e)| format!("e{k} = \"{e}\""))
        .collect();
    let text = format!(
        r#"
kind = "functional"
name = "branch"
density = "{density}"
yields = [{}]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 2] }}
[fields]
u = "scalar"
v = "scalar"
[boundary]
"x = 0" = {{ fixed = ["u", "v"] }}
"x = 2" = {{ fixed = ["u", "v"] }}
[equations]
{}
"#,
        labels.join(", "),
        stated.join("\n")
    );
    let study = studied_text("p4p", &text, &[]);
    study.verdicts[0].finding.verdict.clone()
}

const STRING: &str = "1/2 u,x^2 + 1/2 v^2";

#[test]
fn what_holds_on_one_side_only_is_conditional() {
    // (the equation, where it says u'' = 0, whether it says so nowhere else)
    let cases = [
        ("sqrt(u,xx^2) = u,xx", "u,xx <= 0"),
        ("abs(u,xx) = u,xx", "u,xx <= 0"),
        ("u,xx + sqrt(4 u,xx^2)/2 = 0", "u,xx >= 0"),
        ("(u,xx^2)^(3/2) = u,xx^3", "u,xx <= 0"),
        ("abs(u,xx) = -u,xx", "u,xx >= 0"),
    ];
    for (equation, condition) in cases {
        match verdict(STRING, &[equation, "v = 0"]) {
            Verdict::Conditional {
                condition: own,
                counterexample,
                ..
            } => {
                assert_eq!(own, condition, "{equation}");
                assert!(counterexample.is_some());
            }
            other => panic!("{equation}: {} {}", other.word(), other.detail()),
        }
    }
}

#[test]
fn what_holds_on_both_sides_is_proved() {
    let cases: [(&str, &[&str]); 8] = [
        (STRING, &["u,xx = 2 sqrt(u,xx^2)", "v = 0"]),
        (STRING, &["u,xx^2 = 0", "v^3 = 0"]),
        (STRING, &["u,xx^2 + 3 v^2 = 0"]),
        (STRING, &["sqrt(u,xx) = 0", "v = 0"]),
        (STRING, &["u,xx (u,xx^2 + 1) = 0", "v = 0"]),
        ("abs(u)^3 + 1/2 v^2", &["u abs(u) = 0", "v = 0"]),
        (
            "1/3 (u,x^2)^(3/2) + 1/2 v^2",
            &["abs(u,x) u,xx = 0", "v = 0"],
        ),
        // A factor without fields, of both signs.
        (
            STRING,
            &[
                "(x - 3) sin(u,xx) = 0 + (x - 3) sin(u,xx)",
                "u,xx = 0",
                "v = 0",
            ],
        ),
    ];
    for (density, equations) in cases {
        let own = verdict(density, equations);
        assert_eq!(own.word(), "proved", "{equations:?}: {}", own.detail());
    }
}

#[test]
fn where_a_root_has_no_slope_it_is_said() {
    match verdict("sqrt(u,x^2) + 1/2 v^2", &["v = 0"]) {
        Verdict::Proved(proof) => assert!(proof.on.contains("u,x^2 > 0"), "{}", proof.on),
        other => panic!("{} {}", other.word(), other.detail()),
    }
}

#[test]
fn a_product_vanishes_with_any_of_its_factors() {
    for equations in [
        ["(u,xx - 1) u,xx = 0", "v = 0"],
        ["u,xx^2 - u,xx = 0", "v = 0"],
        ["(u,xx - u) (u,xx + v) = 0", "v = 0"],
        ["u,xx^3 = u,xx", "v = 0"],
    ] {
        let own = verdict(STRING, &equations);
        assert_eq!(own.word(), "refuted", "{equations:?}: {}", own.detail());
    }
}

#[test]
fn equations_that_nothing_satisfies_prove_nothing() {
    assert_eq!(verdict("u + v", &["1 = 2"]).word(), "not-applicable");
    assert_eq!(verdict("u + v^2", &["v = 0"]).word(), "refuted");
}

/// Fields on 0 < x < 1, all given at both ends.
fn on_a_line(
    density: &str,
    fields: &[&str],
    given: &str,
    equations: &[&str],
    more: &str,
) -> String {
    let declared: Vec<String> = fields.iter().map(|f| format!("{f} = \"scalar\"")).collect();
    let fixed: Vec<String> = fields.iter().map(|f| format!("\"{f}\"")).collect();
    let fixed = format!("{{ fixed = [{}] }}", fixed.join(", "));
    let labels: Vec<String> = (0..equations.len()).map(|k| format!("\"e{k}\"")).collect();
    let stated: Vec<String> = equations
        .iter()
        .enumerate()
        .map(|(k, e)| format!("e{k} = \"{e}\""))
        .collect();
    format!(
        "kind = \"functional\"\nname = \"line\"\ndensity = \"{density}\"\nyields = [{}]\n{more}\n\
         [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\n{}\n[data]\n{given}\n\
         [boundary]\n\"x = 0\" = {fixed}\n\"x = 1\" = {fixed}\n[equations]\n{}\n",
        labels.join(", "),
        declared.join("\n"),
        stated.join("\n")
    )
}

fn word(text: &str, claim: &str) -> (String, String) {
    let study = studied_text("p4p", text, &[]);
    let verdict = decided(&study, claim);
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

/// A product vanishes where any of its factors does: none is divided by. Of each refuted case the state that shows it is in the comment.
#[test]
fn a_product_keeps_all_of_its_branches() {
    let data = "f = \"scalar\"\ng = \"scalar\"";
    let obstacle = "u,x^2 - f u - 1/2 q^2 (u - g)";
    let cases: &[(&str, &[&str], &[&str], &str)] = &[
        // q = 0: a string off the obstacle.
        (
            obstacle,
            &["u", "q"],
            &["2 u,xx + f + q^2/2 = 0", "u = g"],
            "refuted",
        ),
        (
            obstacle,
            &["u", "q"],
            &["2 u,xx + f + q^2/2 = 0", "q = 0"],
            "refuted",
        ),
        (
            obstacle,
            &["u", "q"],
            &["2 u,xx + f + q^2/2 = 0", "q (u - g) = 0"],
            "proved",
        ),
        // u = 0.
        ("1/4 u^4 - f/2 u^2", &["u"], &["u^2 = f"], "refuted"),
        ("1/4 u^4 - f/2 u^2", &["u"], &["u (u^2 - f) = 0"], "proved"),
        // u = -x.
        (
            "1/2 u,x^2 + f u",
            &["u"],
            &["(1 + u,x) (u,xx - f) = 0"],
            "refuted",
        ),
        ("1/2 u,x^2 + f u", &["u"], &["u,xx - f = 0"], "proved"),
        (
            "1/2 u,x^2 + f u",
            &["u"],
            &["(1 + u,x^2) (u,xx - f) = 0"],
            "proved",
        ),
        // v = 1, p = 0.
        ("p v v,x", &["p", "v"], &["v = 0", "v p,x = 0"], "refuted"),
        (
            "p v v,x",
            &["p", "v"],
            &["v v,x = 0", "v p,x = 0"],
            "proved",
        ),
        // v = x.
        (
            "p v (v,x - 1)",
            &["p", "v"],
            &["v = 0", "p,x v + p = 0"],
            "refuted",
        ),
        (
            "p v (v,x - 1)",
            &["p", "v"],
            &["v (v,x - 1) = 0", "p,x v + p = 0"],
            "proved",
        ),
    ];
    for (density, fields, equations, wanted) in cases {
        let text = on_a_line(density, fields, data, equations, "");
        let (word, detail) = word(&text, "functional.euler");
        assert_eq!(word, *wanted, "{density}, {equations:?}: {detail}");
    }
}

/// v = 1, p = x²/2 solves the equations, and the current is x v²/2 there.
#[test]
fn a_current_is_closed_on_all_branches() {
    let text = on_a_line(
        "p v v,x + x/2 v^2",
        &["p", "v"],
        "",
        &["v v,x = 0", "x v - v p,x = 0"],
        "symmetries = [\"translations\"]",
    );
    let (word, detail) = word(&text, "functional.noether");
    assert_ne!(word, "proved", "{detail}");
}

/// The area of a surface of revolution: u u'' = 1 + u'² excludes u = 0, so that u u' = 0 at a free end is u' = 0.
#[test]
fn a_factor_that_the_equations_exclude_is_no_case() {
    let surface = |free: &str| {
        format!(
            "kind = \"functional\"\nname = \"surface\"\ndensity = \"u sqrt(1 + u,x^2)\"\nyields = [\"a\", \"b\"]\n\
             [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 2] }}\n[fields]\nu = \"scalar\"\n\
             [boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 2\" = \"0\"\n\
             [equations]\na = \"u u,xx = 1 + u,x^2\"\nb = {{ equation = \"{free}\", on = \"x = 2\" }}\n"
        )
    };
    for (free, wanted) in [
        ("u u,x = 0", "proved"),
        ("u,x = 0", "proved"),
        // No polynomial solves the equation, and that a solution reaches the other end is not known here.
        ("u = 0", "undecided"),
        ("u,x = 1", "undecided"),
    ] {
        let (word, detail) = word(&surface(free), "functional.euler");
        assert_eq!(word, wanted, "{free}: {detail}");
    }
}

/// On a line u'' = 0 with E u' = P at the end is E u' = P everywhere.
#[test]
fn what_is_constant_and_holds_at_an_end_holds() {
    let bar = |force: &str| {
        format!(
            "kind = \"functional\"\nname = \"bar\"\ndensity = \"E/2 u,x^2\"\nyields = [\"a\"]\n\
             [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n\
             [parameters]\nE = {{}}\nP = {{}}\n[boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = \"-P u\"\n\
             [equations]\na = \"E u,x = {force}\"\n"
        )
    };
    let (right, detail) = word(&bar("P"), "functional.euler");
    assert_eq!(right, "proved", "{detail}");
    assert_eq!(word(&bar("2 P"), "functional.euler").0, "refuted");
}
