//! Data that depend on some variables only, `of = [...]`: their other derivatives vanish in proofs, in counterexamples and in values.

use crate::table::{decided, read_text, studied_text};
use chetaev_model::Style;

/// A load on a string 0 < x < 1 that is free at x = 0 and held at x = 1.
fn string(of: &str, end: &str) -> String {
    format!(
        "kind = \"functional\"\nname = \"string\"\ndensity = \"u,x^2/2 - q u\"\nyields = [\"a\", \"l\", \"k\"]\n[domain]\n\
         coordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nq = {{ kind = \"scalar\"{of} }}\n\
         [boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = {{ fixed = [\"u\"] }}\n[equations]\na = \"u,xx + q = 0\"\n\
         l = {{ equation = \"u,x = 0\", on = \"x = 0\" }}\nk = {{ equation = \"{end}\", on = \"x = 1\" }}\n"
    )
}

const CONSTANT: &str = ", of = []";

fn euler(text: &str) -> (&'static str, String) {
    let study = studied_text("p4p", text, &[]);
    let own = decided(&study, "functional.euler");
    (own.word(), own.detail().to_owned())
}

/// With a constant load u' = −q x: at x = 1 it is −q.
#[test]
fn a_constant_load_is_constant_in_a_counterexample() {
    let (word, detail) = euler(&string(CONSTANT, "u,x + q = 0"));
    assert_eq!(word, "proved", "{detail}");
    let (word, detail) = euler(&string(CONSTANT, "u,x + 2 q = 0"));
    assert_eq!(word, "refuted", "{detail}");
    let load = detail
        .split("q = ")
        .nth(1)
        .and_then(|rest| rest.split(',').next());
    assert!(load.is_some_and(|load| !load.contains('x')), "{detail}");
    // Of a load that varies it is not so: q = −6 − 12 x gives u' = 6 x + 6 x².
    let (word, detail) = euler(&string("", "u,x + q = 0"));
    assert_eq!(word, "refuted", "{detail}");
}

/// Free at both ends a constant load is zero, and so is u'.
#[test]
fn conditions_at_both_ends_bind_a_constant() {
    let text = string(CONSTANT, "u,x = 0")
        .replace("\"x = 1\" = { fixed = [\"u\"] }", "\"x = 1\" = \"0\"")
        .replace("[\"a\", \"l\", \"k\"]", "[\"a\", \"l\", \"k\", \"m\"]");
    let (word, detail) = euler(&format!("{text}m = \"u,x = 0\"\n"));
    assert_ne!(word, "refuted", "{detail}");
    // A constant that a condition makes zero at one end is zero at the other.
    let text = "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2 - p u + (v - r)^2/2\"\n\
        yields = [\"a\", \"b\", \"n\", \"m\", \"k\"]\n[domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n\
        [fields]\nu = \"scalar\"\nv = \"scalar\"\n[data]\np = \"scalar\"\nr = \"scalar\"\nq = { kind = \"scalar\", of = [] }\n\
        [boundary]\n\"x = 0\" = \"q v\"\n\"x = 1\" = { fixed = [\"u\", \"v\"] }\n[equations]\na = \"u,xx + p = 0\"\n\
        b = \"v = r\"\nn = { equation = \"u,x = 0\", on = \"x = 0\" }\nm = { equation = \"q = 0\", on = \"x = 0\" }\n\
        k = { equation = \"q = 0\", on = \"x = 1\" }\n";
    let (word, detail) = euler(text);
    assert_ne!(word, "refuted", "{detail}");
}

#[test]
fn a_value_that_depends_on_another_variable_is_refused() {
    let base = |of: &str| {
        let text = string(of, "u,x + q = 0");
        text.replace("\"x = 0\" = \"0\"", "\"x = 0\" = { fixed = [\"u\"] }")
    };
    let solution = "[solutions.s.fields]\nu = \"x^3\"\nq = \"-6 x\"\n";
    let ritz = "[ritz]\nvalues = { q = \"x\" }\n";
    for (more, value) in [(solution, "\"-6 x\""), (ritz, "\"x\" }")] {
        let text = base(CONSTANT) + more;
        let loaded = read_text("p4p", &text, &[]);
        let told = loaded.diagnostics.render(Style::Plain);
        assert!(loaded.problem.is_none(), "{more}");
        assert!(told.contains("`q` does not depend on x"), "{told}");
        let before = &text[..text.rfind(value).unwrap()];
        let line = before.matches('\n').count() + 1;
        let column = before.len() - before.rfind('\n').unwrap();
        assert!(told.contains(&format!(":{line}:{column}")), "{told}");
        // The same of data that may vary.
        assert!(
            read_text("p4p", &(base("") + more), &[]).problem.is_some(),
            "{more}"
        );
    }
}
