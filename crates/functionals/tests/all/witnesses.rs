//! Fields that refute must be fields for which everything is defined: at u = 0 neither 1/u' nor an equation that has it says anything.

use crate::table::{decided, studied_text};

/// The verdict on a functional of u over the unit interval with values given at the ends, and of w without.
fn euler(density: &str, equation: &str) -> (&'static str, String) {
    let text = format!(
        "kind = \"functional\"\nname = \"m\"\ndensity = \"{density} - q u + w,x^2/2 - w^2\"\nyields = [\"e\", \"w\"]\n\
         [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\nw = \"scalar\"\n[data]\nq = \"scalar\"\n\
         [boundary]\n\"x = 0\" = {{ fixed = [\"u\"] }}\n\"x = 1\" = {{ fixed = [\"u\"] }}\n\
         [equations]\ne = \"{equation}\"\nw = \"w = 0\"\n"
    );
    let study = studied_text("p4p", &text, &[]);
    let own = decided(&study, "functional.euler");
    (own.word(), own.detail().to_owned())
}

/// The equations are right, and those of w, −w'' − 2 w = 0 with w' = 0 at the ends, have the solution 0 alone, as √2 is no multiple of π.
#[test]
fn fields_at_which_nothing_is_defined_refute_nothing() {
    for (density, equation) in [
        ("1/u,x + u,x^2/2", "u,xx (1 + 2/u,x^3) + q = 0"),
        ("-log(u,x) + u,x^2/2", "u,xx (1 + 1/u,x^2) + q = 0"),
        (
            "tanh(1/u,x) + u,x^2/2",
            "u,xx (1 - 2 tanh(1/u,x) (1 - tanh(1/u,x)^2)/u,x^4 + 2 (1 - tanh(1/u,x)^2)/u,x^3) + q = 0",
        ),
    ] {
        let (word, detail) = euler(density, equation);
        assert_ne!(word, "refuted", "{density}: {detail}");
    }
}

/// Where the equation is wrong, what refutes it is a field with a slope: u = 2 + x has u'' = 0, so that q = 0 and not 1.
#[test]
fn another_field_refutes_what_is_wrong() {
    let (word, detail) = euler("1/u,x + u,x^2/2", "u,xx (1 + 2/u,x^3) + q = 1");
    assert_eq!(word, "refuted", "{detail}");
    assert!(!detail.contains("u = 0"), "{detail}");
    let (word, detail) = euler("1/u,x + u,x^2/2", "u,xx (1 + 3/u,x^3) + q = 0");
    assert!(!detail.contains("u = 0"), "{word}: {detail}");
}
