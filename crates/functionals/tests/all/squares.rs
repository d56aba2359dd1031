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
        // Of several degrees: ∫ u'² + u⁴ = 0.
        ("u,x^2/2 + u^4/4", free, "u = 0", "proved"),
        ("1/2 (u,x + u)^2 + x^2 u^4", free, "u = 0", "proved"),
        ("u,x^4 + u^6 + 3", free, "u = 0", "proved"),
        (
            "u,x^2/2 + u^4/4",
            ["\"u^2\"", "\"3 u^6\""],
            "u = 0",
            "proved",
        ),
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
        // An odd power has both signs.
        ("1/2 u,x^2 + u^3", free),
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

/// A field that stands apart from another one is varied by itself: that of u has a load, that of w none.
#[test]
fn a_field_by_itself_is_a_sum_of_squares() {
    let text = "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2 - q u + w,x^2/2 + (1 + u^2) w^4/4\"\nyields = [\"a\", \"b\"]\n\
        [domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n[fields]\nu = \"scalar\"\nw = \"scalar\"\n[data]\nq = \"scalar\"\n\
        [boundary]\n\"x = 0\" = { fixed = [\"u\"] }\n\"x = 1\" = { fixed = [\"u\"] }\n\
        [equations]\na = \"u,xx + q = 0\"\nb = \"w = 0\"\n";
    let study = studied_text("p4p", text, &[]);
    let own = decided(&study, "functional.euler");
    assert_eq!(own.word(), "proved", "{}", own.detail());
    let held = text.replace("[\"u\"]", "[\"u\", \"w\"]");
    let study = studied_text("p4p", &held, &[]);
    let own = decided(&study, "functional.euler");
    assert_ne!(own.word(), "refuted", "{}", own.detail());
}
