//! Proofs by parts speak of smooth densities and fields on the whole body, its boundary included: each model here is stationary by its
//! equations alone, and has an admissible variation, which the test names, that changes it to the first order.

use crate::table::{decided, read_text, studied_text};
use chetaev_functionals::Study;
use chetaev_model::Style;

/// A functional of u over an interval whose ends are held, with the equation that it is said to yield and a field that is said to solve it.
fn on_line((lower, upper): (&str, &str), density: &str, equation: &str, field: &str) -> Study {
    let text = format!(
        "kind = \"functional\"\nname = \"line\"\ndensity = \"{density}\"\nyields = [\"a\"]\n\
         [domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [\"{lower}\", \"{upper}\"] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\
         \"x = {lower}\" = {{ fixed = [\"u\"] }}\n\"x = {upper}\" = {{ fixed = [\"u\"] }}\n\
         [equations]\na = \"{equation}\"\n[solutions.s.fields]\nu = \"{field}\"\n"
    );
    studied_text("p4p", &text, &[])
}

fn word(study: &Study, claim: &str) -> String {
    decided(study, claim).word().to_owned()
}

/// u' jumps at a place inside, so that δJ = ∫ u' v' is the jump times v there.
#[test]
fn a_stated_field_with_a_kink_is_no_solution() {
    for (ends, field) in [
        (("-1", "1"), "asin(sin(3 x))"),
        (("-1", "1"), "acos(cos(3 x))"),
        (("-1", "1"), "acosh(cosh(x))"),
        (("0", "1"), "atan(tan(3 x))"),
        (("-1", "1"), "abs(x)"),
    ] {
        let study = on_line(ends, "u,x^2/2", "u,xx = 0", field);
        assert_eq!(word(&study, "functional.euler"), "proved");
        assert_ne!(word(&study, "functional.solution"), "proved", "{field}");
    }
    // The same functions where they are smooth.
    for (ends, field) in [
        (("-1/2", "1/2"), "asin(sin(3 x))"),
        (("1", "2"), "acosh(cosh(x))"),
        (("1", "2"), "abs(x)"),
    ] {
        let study = on_line(ends, "u,x^2/2", "u,xx = 0", field);
        assert_eq!(word(&study, "functional.solution"), "proved", "{field}");
    }
}

/// The field, and with it the functional, is infinite at an end or inside.
#[test]
fn a_stated_field_that_is_infinite_is_no_solution() {
    let density = "u,x^2/2 + u^2 + u^4/2";
    let equation = "u,xx = 2 u + 2 u^3";
    let pole = on_line(("0", "2"), density, equation, "tan(x)");
    assert_eq!(word(&pole, "functional.euler"), "proved");
    assert_ne!(word(&pole, "functional.solution"), "proved");
    let before = on_line(("0", "1"), density, equation, "tan(x)");
    assert_eq!(word(&before, "functional.solution"), "proved");
    let at_end = on_line(("0", "1"), "x u,x^2/2", "(x u,x),x = 0", "log(x)");
    assert_ne!(word(&at_end, "functional.solution"), "proved");
    assert_ne!(word(&at_end, "functional.second-variation"), "proved");
}

/// ∫ |u'| with u = x² − x: v = u is admissible, and J((1 + ε) u) = (1 + ε)/2.
#[test]
fn a_density_with_a_kink_at_the_stated_field_proves_nothing() {
    for (density, field) in [
        ("abs(u,x)", "x^2 - x"),
        ("(u,x^2)^(1/2)", "x^2 - x"),
        ("u,x^2/2 + sign(u)", "x - 1/2"),
        ("u,x^2/2 + abs(u)", "0"),
    ] {
        let study = on_line(("0", "1"), density, "u,xx = 0", field);
        assert_ne!(word(&study, "functional.solution"), "proved", "{density}");
    }
}

/// A bar of two materials: u = x solves u'' = 0 on both sides, and δJ = ∫ (2 + sign(x − ½)) v' = −2 v(½).
#[test]
fn coefficients_that_jump_inside_are_said() {
    for (ends, density, equation) in [
        (("0", "1"), "(2 + sign(x - 1/2)) u,x^2/2", "u,xx = 0"),
        (("0", "1"), "sign(x - 1/2) u,x + u,x^2/2", "u,xx = 0"),
        (("0", "1"), "abs(x - 1/2) u,xx + u^2/2", "u = 0"),
        (("0", "2"), "atan(tan(x)) u,x + u,x^2/2", "u,xx = -1"),
        // The sign of cos 7x, which is zero at π/14, and its absolute value.
        (
            ("0", "1"),
            "(2 + cos(7 x)/sqrt(cos(7 x)^2)) u,x^2/2",
            "((2 + cos(7 x)/sqrt(cos(7 x)^2)) u,x),x = 0",
        ),
        (
            ("0", "1"),
            "(2 + sqrt(1 - sin(7 x)^2)) u,x^2/2",
            "((2 + sqrt(1 - sin(7 x)^2)) u,x),x = 0",
        ),
        (
            ("0", "1"),
            "(4 + acos(cos(7 x))) u,x^2/2",
            "((4 + acos(cos(7 x))) u,x),x = 0",
        ),
    ] {
        let study = on_line(ends, density, equation, "x");
        assert_ne!(word(&study, "functional.euler"), "proved", "{density}");
    }
    // Off the jump, and where it is not known whether the body has it.
    let beside = on_line(("1", "2"), "(2 + sign(x - 1/2)) u,x^2/2", "u,xx = 0", "x");
    assert_eq!(word(&beside, "functional.euler"), "proved");
    assert_eq!(word(&beside, "functional.solution"), "proved");
    // ∫ v'² − 6 v(½)² is −1/2 for the tent of slopes ±1.
    let form = on_line(("0", "1"), "u,x^2 + 6 sign(x - 1/2) u u,x", "u,xx = 0", "0");
    assert_ne!(word(&form, "functional.second-variation"), "proved");
}

/// A body of any shape, put on the unit square: w = x y has the twisting 1, and δJ of J = ½ ∫ w,ij w,ij is 2 for v = w by the corners.
#[test]
fn a_body_that_is_put_on_a_box_has_its_corners() {
    let plate = |boundary: &str, pieces: &str, density: &str, field: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"c\"\ndensity = \"{density}\"\n\
             [domain]\ncoordinates = [\"x\", \"y\"]\nboundary = [\"S\", \"R\"]\n[fields]\nw = \"scalar\"\n[boundary]\n{boundary}\n\
             [solutions.a]\nintervals = {{ x = [0, 1], y = [0, 1] }}\npieces = {{ {pieces} }}\n\
             [solutions.a.fields]\nw = \"{field}\"\n"
        );
        word(&studied_text("p4p", &text, &[]), "functional.solution")
    };
    let two = "S = [\"x = 0\", \"y = 0\"], R = [\"x = 1\", \"y = 1\"]";
    let bent = "1/2 w,ij w,ij";
    assert_eq!(plate("S = \"0\"\nR = \"0\"", two, bent, "x y"), "refuted");
    let held = "S = { fixed = [\"w\"] }\nR = \"0\"";
    assert_eq!(plate(held, two, bent, "x y"), "refuted");
    assert_eq!(
        plate("S = \"0\"\nR = \"0\"", two, bent, "x + 2 y"),
        "proved"
    );
    // On x = 0 the density is −w,y: δJ = −∫ v,y dy = v(0, 0) − v(0, 1).
    let one = "S = \"x = 0\", R = [\"x = 1\", \"y = 0\", \"y = 1\"]";
    let along = "S = \"epsilon_ij n_i w,j\"\nR = \"0\"";
    assert_eq!(plate(along, one, "1/2 w,i w,i", "3"), "refuted");
}

/// A harmonic field that is infinite at a corner where the boundary is free: an arc around it takes −π v(0, 0).
#[test]
fn a_corner_at_which_the_field_is_infinite_is_seen() {
    let text = |lower: &str| {
        format!(
            "kind = \"functional\"\nname = \"r\"\ndensity = \"1/2 u,i u,i\"\n[domain]\ncoordinates = [\"x\", \"y\"]\n\
             intervals = {{ x = [\"{lower}\", 2], y = [0, 2] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\
             \"x = {lower}\" = {{ fixed = [\"u\"] }}\n\"x = 2\" = {{ fixed = [\"u\"] }}\n\"y = 0\" = \"0\"\n\"y = 2\" = {{ fixed = [\"u\"] }}\n\
             [solutions.a.fields]\nu = \"log(x^2 + y^2)\"\n"
        )
    };
    let at_corner = studied_text("p4p", &text("0"), &[]);
    assert_ne!(word(&at_corner, "functional.solution"), "proved");
    let away = studied_text("p4p", &text("1"), &[]);
    assert_eq!(word(&away, "functional.solution"), "proved");
}

/// What is printed is read back as what it says, with coordinates of one letter and of several.
#[test]
fn derivatives_by_coordinates_with_long_names() {
    let model = |coordinates: [&str; 2], density: &str, equation: &str| {
        let [one, other] = coordinates;
        format!(
            "kind = \"functional\"\nname = \"n\"\ndensity = \"{density}\"\nyields = [\"a\"]\n[domain]\n\
             coordinates = [\"{one}\", \"{other}\"]\nboundary = [\"S\"]\n[fields]\nu = \"scalar\"\n[boundary]\n\
             S = {{ fixed = [\"u\"] }}\n[equations]\na = \"{equation} = 0\"\n"
        )
    };
    let said = |text: &str| word(&studied_text("p4p", text, &[]), "functional.euler");
    let two = model(["ab", "b"], "u,ab^2 + u,b^2", "-2 u,abab - 2 u,bb");
    assert_eq!(said(&two), "proved");
    let polar = "r/2 u,r^2 + 1/(2 r) u,theta^2";
    let polar = model(["r", "theta"], polar, "r u,rr + u,r + u,thetatheta/r");
    assert_eq!(said(&polar), "proved");
    let told = |text: &str| {
        let loaded = read_text("p4p", text, &[]);
        assert!(loaded.problem.is_none());
        loaded.diagnostics.render(Style::Plain)
    };
    let twice = told(&model(["a", "aa"], "u,aa^2", "u"));
    assert!(twice.contains("two readings"), "{twice}");
    let index = told(&model(["x", "y"], "u_x^2", "u"));
    assert!(index.contains("behind a comma: u,x"), "{index}");
}

#[test]
fn keys_and_names_that_mean_nothing_are_told() {
    let model = |field: &str, function: &str, multipliers: &str| {
        format!(
            "kind = \"functional\"\nname = \"n\"\ndensity = \"A(u,x)\"\nyields = [\"a\"]\n[domain]\ncoordinates = [\"x\"]\n\
             boundary = [\"S\"]\n[fields]\nu = {{ kind = \"scalar\"{field} }}\n[functions]\n\
             A = {{ of = \"scalar\"{function} }}\n[multipliers]\n{multipliers}\n[boundary]\nS = {{ fixed = [\"u\"] }}\n\
             [equations]\na = \"(A'(u,x)),x = 0\"\n"
        )
    };
    let told = |text: &str| {
        let loaded = read_text("p4p", text, &[]);
        loaded.diagnostics.render(Style::Plain)
    };
    assert_eq!(told(&model("", "", "")), "");
    for (text, wanted) in [
        (model(", foo = 1", "", ""), "`foo` is not a key"),
        (model("", ", valeu = \"X^2\"", ""), "did you mean `value`"),
        (model("", ", conjugate = \"A\"", ""), "its own conjugate"),
        (model("", "", "nope = \"u\""), "there is no equation `nope`"),
        (model("", "", "a = \"u\""), "is not imposed"),
    ] {
        let said = told(&text);
        assert!(said.contains(wanted), "{said}");
    }
}

/// Without equations that are stated the Euler equations are only printed, and it is said where they are not all.
#[test]
fn equations_that_are_only_printed_are_printed_with_what_is_missing() {
    let text = "kind = \"functional\"\nname = \"s\"\ndensity = \"u,x^2/(x - 1/2)\"\n[domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n\
        [fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = { fixed = [\"u\"] }\n\"x = 1\" = { fixed = [\"u\"] }\n";
    let study = studied_text("p4p", text, &[]);
    let own = decided(&study, "functional.euler");
    assert!(
        own.detail().contains("not smooth in the body"),
        "{}",
        own.detail()
    );
}
