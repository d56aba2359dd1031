//! What a file assumes of fields and parameters: proofs use it and name it, and counterexamples keep to it.

use crate::half_known::studied;
use crate::table::{decided, read_text, studied_text};
use chetaev_model::Style;

/// A field u on 0 < x < 1, given at both ends.
fn text(density: &str, stated: &str, assumptions: &str, parameters: &str) -> String {
    format!(
        "kind = \"functional\"\nname = \"assumed\"\ndensity = \"{density}\"\nyields = [\"a\"]\nassumptions = [{assumptions}]\n\
         [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nf = \"scalar\"\n\
         [parameters]\nk = {{ {parameters} }}\n[boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n\
         [equations]\na = \"{stated}\"\n"
    )
}

const STRING: &str = "1/2 u,x^2 + f u";

#[test]
fn a_factor_that_is_assumed_not_to_vanish_is_no_branch() {
    // Without the assumption u = −x is a counterexample.
    for (assumptions, word) in [("", "refuted"), ("\"u,x > -1\"", "proved")] {
        let study = studied_text(
            "p4p",
            &text(STRING, "(1 + u,x) (u,xx - f) = 0", assumptions, ""),
            &[],
        );
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), word, "{}", verdict.detail());
    }
}

#[test]
fn a_proof_names_what_is_assumed() {
    let study = studied_text(
        "p4p",
        &text("1/2 k u,x^2 + f u", "k u,xx = f", "\"k != 0\"", ""),
        &[],
    );
    match decided(&study, "functional.euler") {
        chetaev_symbolic::Verdict::Proved(proof) => {
            assert!(proof.on.contains("assuming k != 0"), "{}", proof.on);
            assert!(!proof.detail.contains("k ≠ 0"), "{}", proof.detail);
        }
        other => panic!("{} {}", other.word(), other.detail()),
    }
}

#[test]
fn a_counterexample_keeps_to_what_is_assumed() {
    // |u'| = u' where u' ≥ 0, and nowhere else but at 0.
    let stated = "abs(u,x) + u,xx = u,x + f";
    let word = |assumptions: &str| {
        let study = studied_text("p4p", &text(STRING, stated, assumptions, ""), &[]);
        decided(&study, "functional.euler").word().to_owned()
    };
    assert_eq!(word(""), "conditional");
    assert_eq!(word("\"u,x >= 0\""), "proved");
    assert_eq!(word("\"u,x < 0\""), "refuted");
}

#[test]
fn a_determinant_is_that_of_the_components() {
    let of = |d: &str, stated: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"det\"\ndensity = \"k det(delta_ij + u_i,j)\"\nyields = [\"a\"]\n[sizes]\nd = {d}\n\
             [domain]\ncoordinates = \"x_i\"\nboundary = [\"S\"]\n[fields]\nu = \"vector\"\nk = \"scalar\"\n[boundary]\n\
             S = {{ fixed = [\"u\", \"k\"] }}\n[equations]\na = \"{stated} = 0\"\n"
        );
        let study = studied_text("p4p", &text, &[]);
        let all: Vec<_> = study.variation.as_ref().unwrap().euler.clone();
        let space = &study.problem.functional.space;
        let k = space.component_named("k").unwrap();
        let own = all.iter().find(|(component, _)| *component == k).unwrap().1;
        let stated = study.problem.functional.equations[0].residuals[0];
        assert!(space.vanish(&[space.graph.sub(own, stated)]), "d = {d}");
    };
    of("1", "1 + u_1,1");
    of("2", "(1 + u_1,1) (1 + u_2,2) - u_1,2 u_2,1");
    // By the permutation symbol (Levi-Civita), which has as many indices as the space dimensions.
    of(
        "3",
        "epsilon_ijk (delta_1i + u_1,i) (delta_2j + u_2,j) (delta_3k + u_3,k)",
    );
}

#[test]
fn assumptions_that_say_nothing_or_are_false_are_refused() {
    let cases = [
        (
            "\"u,x = 1\"",
            "",
            "not-a-comparison",
            "named under `imposed`",
        ),
        (
            "\"k\"",
            "",
            "not-a-comparison",
            "an assumption is a comparison",
        ),
        (
            "\"k > 0\"",
            "value = \"-2\"",
            "false-assumption",
            "is false for the values",
        ),
        (
            "\"2 < 1\"",
            "",
            "false-assumption",
            "is false for the values",
        ),
        ("\"u,i > 0\"", "", "index-mismatch", "the free index i"),
        ("\"kk > 0\"", "", "unknown-name", "did you mean `k`?"),
        (
            "\"det'_ij(delta_ij) > 0\"",
            "",
            "prime-of-field",
            "no derivative written with primes",
        ),
    ];
    for (assumptions, parameters, code, words) in cases {
        let loaded = read_text(
            "p4p",
            &text(STRING, "u,xx = f", assumptions, parameters),
            &[],
        );
        assert!(loaded.problem.is_none(), "{assumptions} is accepted");
        let said = loaded.diagnostics.render(Style::Plain);
        assert!(
            said.contains(code) && said.contains(words),
            "{assumptions}:\n{said}"
        );
    }
}

/// Values that are put in keep to what is assumed, whoever puts them in: else nothing is claimed.
#[test]
fn values_that_violate_an_assumption_are_none_of_the_model() {
    let head = |density: &str, assumed: &str| {
        format!(
            "kind = \"functional\"\nname = \"own\"\ndensity = \"{density}\"\nassumptions = [\"{assumed}\"]\n[domain]\n\
             coordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n\
             [parameters]\nk = {{}}\n[boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n"
        )
    };
    let judged = |text: &str, claim: &str, is_fit: bool| {
        // What it becomes assumes nothing, and has no k.
        let other = text
            .split("\n[")
            .filter(|part| !part.starts_with("degenerations"));
        let other = other.collect::<Vec<_>>().join("\n[");
        let other = other.replace("+ k u^2", "").replace("\"own\"", "\"other\"");
        let is_assumption = |line: &&str| !line.starts_with("assumptions");
        let other: Vec<&str> = other.lines().filter(is_assumption).collect();
        let study = studied(text, &other.join("\n"));
        let verdict = decided(&study, claim);
        let is_refused = verdict.detail().contains("violate what the model assumes");
        assert_eq!(is_refused, !is_fit, "{claim}: {}", verdict.detail());
        let is_applicable = verdict.word() != "not-applicable";
        assert_eq!(is_applicable, is_fit, "{claim}: {}", verdict.detail());
    };
    for (assumed, is_fit) in [("k > 1", false), ("k < 1", true)] {
        let at = "[degenerations.z]\nbecomes = \"other.toml\"\nat = { k = \"0\" }\n";
        let text = head("1/2 u,x^2 + k u^2", assumed) + at;
        judged(&text, "functional.degeneration", is_fit);
    }
    for (assumed, is_fit) in [("k > 0", false), ("k < 0", true)] {
        let ritz = "[ritz]\ndegrees = [1, 2]\nvalues = { k = \"-1\", q = \"1\" }\n";
        judged(
            &(head("k u,x^2/2 - q u", assumed) + ritz),
            "functional.ritz",
            is_fit,
        );
    }
    // q = x − 1/2 is negative on half of the interval.
    for (assumed, is_fit) in [("q > 0", false), ("q > -1", true)] {
        let fields = "[solutions.s.fields]\nu = \"-x^3/6 + x^2/4\"\nq = \"x - 1/2\"\n";
        let text = head("u,x^2/2 - q u", assumed) + fields;
        judged(&text, "functional.solution", is_fit);
        judged(&text, "functional.second-variation", is_fit);
    }
}

/// Ritz's method finds u = q (x − x²)/2 between two ends that are held, and u = q (x − x²/2) with a free end at x = 1, where u,x = 0.
#[test]
fn what_is_found_by_ritz_is_as_assumed_on_the_body_and_its_boundary() {
    let held = "{ fixed = [\"u\"] }";
    let word = |assumed: &str, load: &str, end: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2 - q u\"\nassumptions = [\"{assumed}\"]\n[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n[boundary]\n\"x = 0\" = {held}\n\
             \"x = 1\" = {end}\n[ritz]\ndegrees = [1, 2]\nvalues = {{ q = \"{load}\" }}\n"
        );
        let study = studied_text("p4p", &text, &[]);
        let verdict = decided(&study, "functional.ritz");
        let refused = verdict
            .detail()
            .contains("is the solution, and violates what the model assumes");
        assert_eq!(
            refused,
            verdict.word() == "not-applicable",
            "{}",
            verdict.detail()
        );
        verdict.word().to_owned()
    };
    let free = "\"0\"";
    // (what is assumed, q, the end, whether it holds)
    let cases = [
        ("u >= 0", "-2", held, false),
        ("u >= 0", "2", held, true),
        ("u > 0", "2", held, false),
        ("u > -1/100", "2", held, true),
        // The largest value, at x = 1/2, is 1/4.
        ("(u - 1/4)^2 > 0", "2", held, false),
        ("(u - 26/100)^2 > 0", "2", held, true),
        // At the place x = 4/7, which no probe hits, u = 12/49.
        ("(u - 12/49)^2 > 0", "2", held, false),
        ("u,x >= 0", "2", free, true),
        ("u,x > 0", "2", free, false),
        ("u,x != 0", "2", free, false),
        ("u,x > -1/100", "2", free, true),
    ];
    for (assumed, load, end, holds) in cases {
        let wanted = if holds { "proved" } else { "not-applicable" };
        assert_eq!(
            word(assumed, load, end),
            wanted,
            "{assumed}, q = {load}, {end}"
        );
    }
}

/// u'' = 10⁴ (u − 1): u = 1 − cosh(100 (x − 1/2))/cosh(50) is nowhere above 1, though polynomials of low degree are.
#[test]
fn a_polynomial_that_is_no_solution_says_nothing_of_what_is_assumed() {
    let held = "{ fixed = [\"u\"] }";
    let text = format!(
        "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2 + 5000 u^2 - 10000 u\"\nassumptions = [\"1 - u >= 0\"]\n[domain]\n\
         coordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = {held}\n\"x = 1\" = {held}\n\
         [ritz]\ndegrees = [0, 2, 4]\n"
    );
    let study = studied_text("p4p", &text, &[]);
    let verdict = decided(&study, "functional.ritz");
    assert_eq!(verdict.word(), "undecided", "{}", verdict.detail());
}
