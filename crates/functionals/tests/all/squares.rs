//! Functionals that are sums of squares, with free ends: stationary fields make each square vanish.

use crate::table::{decided, studied_text};

fn euler(density: &str, data: &str, ends: [&str; 2], stated: &str) -> (&'static str, String) {
    let text = format!(
        "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\nyields = [\"a\"]\n[domain]\ncoordinates = [\"x\"]\n\
         intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\n{data}[boundary]\n\"x = 0\" = {}\n\"x = 1\" = {}\n\
         [equations]\na = \"{stated}\"\n",
        ends[0], ends[1]
    );
    let study = studied_text("p4p", &text, &[]);
    let own = decided(&study, "functional.euler");
    (own.word(), own.detail().to_owned())
}

/// −u'' + u = 0 with u' = 0 at both ends has the solution 0 alone (multiplied by u and integrated: ∫ u'² + u² = 0), and −u'' = 0 the constants alone.
#[test]
fn stationary_fields_make_squares_vanish() {
    let free = ["\"0\""; 2];
    let held = ["{ fixed = [\"u\"] }"; 2];
    for (density, ends, stated, expected) in [
        ("1/2 u,x^2 + 1/2 u^2", free, "u = 0", "proved"),
        ("1/2 u,x^2", free, "u,x = 0", "proved"),
        // The constants are stationary.
        ("1/2 u,x^2", free, "u = 0", "refuted"),
        // exp(x) satisfies the equation, and no condition at the ends.
        ("1/2 u,x^2 + 1/2 u^2", free, "u,xx - u = 0", "refuted"),
        // With values that are given at the ends u = 1 + x is stationary.
        ("1/2 u,x^2", held, "u,x = 0", "refuted"),
    ] {
        let (word, detail) = euler(density, "", ends, stated);
        assert_eq!(word, expected, "{density}, {stated}: {detail}");
    }
    // True for other reasons: no sum of squares, as 10 is no eigenvalue n² π², and a spring at one end.
    for (density, ends) in [
        ("1/2 u,x^2 - 5 u^2", free),
        ("1/2 u,x^2", ["\"u^2\"", "\"0\""]),
    ] {
        let (word, detail) = euler(density, "", ends, "u = 0");
        assert_ne!(word, "refuted", "{density}: {detail}");
    }
    // With a load, which is free, it does not vanish.
    let (word, detail) = euler(
        "1/2 u,x^2 + 1/2 u^2 - q u",
        "q = \"scalar\"\n",
        free,
        "u = 0",
    );
    assert_eq!(word, "refuted", "{detail}");
}

/// ∫ ½ u'² dx + ½ (u(0) − g)² has u' = u − g at x = 0 and u' = 0 at x = 1, so that u = g: with two springs, to g and to h, u' = (h − g)/3 is
/// stationary, and nothing is a square of the field alone.
#[test]
fn data_on_the_boundary_are_no_fields() {
    let data =
        "g = { kind = \"scalar\", on = \"x = 0\" }\nh = { kind = \"scalar\", on = \"x = 1\" }\n";
    let springs = ["\"1/2 (u - g)^2\"", "\"1/2 (u - h)^2\""];
    let (word, detail) = euler("1/2 u,x^2", data, springs, "u,x = 0");
    assert_eq!(word, "refuted", "{detail}");
}
