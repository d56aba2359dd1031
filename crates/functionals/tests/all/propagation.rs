//! What the equations of a body carry along is decided at its ends: first integrals with their constants, and fields that conditions at the
//! ends make zero. No jet at one place refutes it.

use crate::table::{decided, studied_text};

/// A functional of u on [0, 1] with a free end at x = 1, its density there and one stated equation inside.
fn euler(density: &str, ends: [&str; 2], stated: &str) -> String {
    let [left, right] = ends;
    let text = format!(
        "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\nyields = [\"a\"]\n\
         assumptions = [\"k > 0\"]\n[parameters]\nP = {{}}\nk = {{}}\n\
         [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n\
         [boundary]\n\"x = 0\" = {left}\n\"x = 1\" = \"{right}\"\n[equations]\na = \"{stated}\"\n"
    );
    decided(&studied_text("p4p", &text, &[]), "functional.euler")
        .word()
        .to_owned()
}

const HELD: &str = "{ fixed = [\"u\"] }";
const CLAMPED: &str = "{ fixed = [\"u\", \"u,n\"] }";

#[test]
fn first_integrals_are_equivalent_to_the_equations_that_they_integrate() {
    for (density, ends, stated) in [
        // The force along a bar of changing stiffness, written in two ways.
        ("(1 + x) u,x^2/2", [HELD, "-P u"], "(1 + x) u,x = P"),
        ("(1 + x) u,x^2/2", [HELD, "-P u"], "u,x = P/(1 + x)"),
        ("k u,x^2/2", [HELD, "0"], "u,x = 0"),
        // The moment in a cantilever: E I u''' = −P, and u''(1) = 0.
        ("k u,xx^2/2", [CLAMPED, "-P u"], "k u,xx = P (1 - x)"),
    ] {
        assert_eq!(euler(density, ends, stated), "proved", "{stated}");
    }
    for (density, ends, stated) in [
        ("(1 + x) u,x^2/2", [HELD, "-P u"], "u,x = 2 P/(1 + x)"),
        ("k u,xx^2/2", [CLAMPED, "-P u"], "k u,xx = P (2 - x)"),
    ] {
        assert_ne!(euler(density, ends, stated), "proved", "{stated}");
    }
    // A condition that is not solved for u' is not taken for one that says nothing.
    let cubic = euler("u,x^4/4 + u,x^2/2", [HELD, "-P u"], "u,x^3 + u,x = P");
    assert_ne!(cubic, "refuted");
    // Values that are given at both ends are any, and enforce nothing.
    let text = "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2\"\nyields = [\"a\"]\n[domain]\ncoordinates = [\"x\"]\n\
         intervals = { x = [0, 1] }\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = { fixed = [\"u\"] }\n\
         \"x = 1\" = { fixed = [\"u\"] }\n[equations]\na = \"u,x = 0\"\n";
    let held = studied_text("p4p", text, &[]);
    assert_eq!(decided(&held, "functional.euler").word(), "refuted");
}

/// u'' = 0 with u' = 0 at one end and u = 0 at the other has u = 0 alone: what both ends enforce together is not refuted by a jet.
#[test]
fn what_both_ends_enforce_is_not_refuted() {
    let word = euler("u,x^2/2", ["\"0\"", "u^2/2"], "u = 0");
    assert_ne!(word, "refuted");
    // u' + u = 0 at x = 1, and u' is zero everywhere: u = 0 there.
    let text = |left: &str, held: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"u,x^2/2\"\nyields = [\"a\", {held} \"c\"]\n\
             [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n\
             [boundary]\n\"x = 0\" = {left}\n\"x = 1\" = \"u^2/2\"\n[equations]\na = \"u,xx = 0\"\n\
             b = {{ equation = \"u,x = 0\", on = \"x = 0\" }}\nc = {{ equation = \"u = 0\", on = \"x = 1\" }}\n"
        )
    };
    let said = |text: &str| {
        let study = studied_text("p4p", text, &[]);
        decided(&study, "functional.euler").word().to_owned()
    };
    assert_ne!(said(&text("\"0\"", "\"b\",")), "refuted");
    // With any value given at the left end it is false.
    assert_eq!(said(&text(HELD, "")), "refuted");
    // The same across a strip of threads, where no derivative by y occurs.
    let strip = |text: String| {
        text.replace("[\"x\"]", "[\"x\", \"y\"]")
            .replace("{ x = [0, 1] }", "{ x = [0, 1], y = [0, 1] }")
            .replace(
                "\"x = 1\" = \"u^2/2\"",
                "\"x = 1\" = \"u^2/2\"\n\"y = 0\" = \"0\"\n\"y = 1\" = \"0\"",
            )
    };
    assert_ne!(said(&strip(text("\"0\"", "\"b\","))), "refuted");
    assert_eq!(said(&strip(text(HELD, ""))), "refuted");
}

/// On a face the flux has the place of the face: ∫ (x v)' − v(1) = 0.
#[test]
fn a_flux_with_the_place_in_it_is_put_on_the_face() {
    let bar = |density: &str, end: &str, more: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\n[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nv = \"scalar\"\n[define]\nw_i = \"x delta_i1 v\"\n[boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = \"{end}\"\n{more}"
        )
    };
    let dual = bar("0 v", "0", "");
    let word = |end: &str| {
        let with = "[duality]\nwith = \"other.toml\"\nflux = \"w_i\"\n";
        let own = bar("x v,x + v", end, with);
        let study = crate::half_known::studied(&own, &dual);
        decided(&study, "functional.duality").word().to_owned()
    };
    assert_eq!(word("-v"), "proved");
    assert_eq!(word("v"), "refuted");
}

/// A density of a face that jumps inside of it: ∫ sign(y − ½) v,y dy = −2 v(½) on x = 1.
#[test]
fn a_jump_on_a_face_is_said() {
    let word = |shift: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 u,i u,i\"\nyields = [\"a\", \"b\"]\n[domain]\n\
             coordinates = [\"x\", \"y\"]\nintervals = {{ x = [0, 1], y = [0, 1] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\
             \"x = 0\" = {HELD}\n\"x = 1\" = \"sign(y - {shift}) u,y\"\n\"y = 0\" = {HELD}\n\"y = 1\" = {HELD}\n\
             [equations]\na = \"u,ii = 0\"\nb = {{ equation = \"u,x = 0\", on = \"x = 1\" }}\n"
        );
        let study = studied_text("p4p", &text, &[]);
        decided(&study, "functional.euler").word().to_owned()
    };
    assert_eq!(word("1/2"), "not-applicable");
    assert_eq!(word("2"), "proved");
}
