//! What is imposed without a multiplier restricts the variations: expected equations by Lagrange's multipliers or by putting in, on paper.

use crate::table::{decided, row_text, studied_text};
use chetaev_functionals::Study;

/// Two fields on a line; `ends` says what stands at both ends.
fn studied(density: &str, stated: &[&str], imposed: &[(&str, &str)], ends: [&str; 2]) -> Study {
    let mut labels = (Vec::new(), Vec::new());
    let mut equations = String::new();
    for (k, equation) in stated.iter().enumerate() {
        labels.0.push(format!("\"a{k}\""));
        equations.push_str(&format!("a{k} = \"{equation}\"\n"));
    }
    for (k, (equation, on)) in imposed.iter().enumerate() {
        labels.1.push(format!("\"b{k}\""));
        equations.push_str(&match *on {
            "" => format!("b{k} = \"{equation}\"\n"),
            on => format!("b{k} = {{ equation = \"{equation}\", on = \"{on}\" }}\n"),
        });
    }
    let text = format!(
        r#"
kind = "functional"
name = "restricted"
density = "{density}"
yields = [{}]
imposed = [{}]
symmetries = ["translations"]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 2] }}
[fields]
u = "scalar"
v = "scalar"
[data]
f = "scalar"
[boundary]
"x = 0" = {}
"x = 2" = {}
[equations]
{equations}
"#,
        labels.0.join(", "),
        labels.1.join(", "),
        ends[0],
        ends[1]
    );
    studied_text("p4p", &text, &[])
}

const HELD: &str = "{ fixed = [\"u\", \"v\"] }";

#[test]
fn a_field_that_is_imposed_is_put_in() {
    let cases: [(&str, &str, &str, &str); 14] = [
        // ½u'² + u² for v = u.
        ("1/2 u,x^2 + u v", "v = u", "u,xx = 2 u", "proved"),
        ("1/2 u,x^2 + u v", "v = u", "u = 0", "refuted"),
        ("1/2 u,x^2 + u v", "2 u - 2 v = 0", "u,xx = 2 u", "proved"),
        // A field that is given is not varied.
        (
            "1/2 u,x^2 + 1/2 v,x^2 - f u + u v",
            "v = 3",
            "u,xx + f = 3",
            "proved",
        ),
        (
            "1/2 u,x^2 + 1/2 v,x^2 - f u + u v",
            "v = 3",
            "u = 0",
            "refuted",
        ),
        ("1/2 u,x^2 + 1/2 v,x^2 + u v", "v = f", "u,xx = f", "proved"),
        // (u + v)'' / 2 for u − v = f.
        (
            "1/4 u,x^2 + 1/4 v,x^2",
            "u - v = f",
            "2 u,xx - f,xx = 0",
            "proved",
        ),
        // ½u'² + ½u''² for v = u', whose ends hold u and u'.
        (
            "1/2 u,x^2 + 1/2 v,x^2",
            "u,x = v",
            "u,xxxx = u,xx",
            "proved",
        ),
        ("1/2 u,x^2 + 1/2 v,x^2", "u,x = v", "v,xxx = v,x", "proved"),
        ("1/2 u,x^2 + 1/2 v,x^2", "u,x = v", "u,xx = 0", "refuted"),
        ("1/2 u,x^2 + 1/2 v,x^2", "u,x = v", "v,xx = v", "refuted"),
        // ½u² + ½u''²: the fourth derivative plus u.
        (
            "1/2 u^2 + 1/2 v,x^2",
            "u,x - v = 0",
            "u,xxxx + u = 0",
            "proved",
        ),
        ("1/2 u^2 + 1/2 v,x^2", "u,x - v = 0", "v,xx = u", "refuted"),
        // No field can be solved for: the multiplier is not known.
        (
            "1/2 u,x^2 + 1/2 v,x^2",
            "u,x = v,x",
            "u,xx = 0",
            "undecided",
        ),
    ];
    for (density, imposed, stated, word) in cases {
        let study = studied(density, &[stated], &[(imposed, "")], [HELD, HELD]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(
            verdict.word(),
            word,
            "{density}, {imposed}: {}",
            verdict.detail()
        );
        if word == "undecided" {
            assert!(
                verdict.detail().contains("[multipliers]"),
                "{}",
                verdict.detail()
            );
        }
    }
}

#[test]
fn what_is_imposed_on_an_end_is_not_varied_there() {
    // u = f at x = 0, and u' = 0 is natural at x = 2 only.
    let ends = ["{ fixed = [\"v\"] }", HELD];
    let study = studied(
        "1/2 u,x^2 + 1/2 v^2",
        &["u,xx = 0", "v = 0"],
        &[("u = f", "x = 0")],
        ends,
    );
    let verdict = decided(&study, "functional.euler");
    assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
}

/// A bar with a traction P of its own at its left end, of which something is imposed.
fn with_traction(density: &str, imposed: &str, stated: &str) -> Study {
    let text = format!(
        r#"
kind = "functional"
name = "traction"
density = "1/2 u,x^2 - f u"
imposed = ["z"]
yields = ["e", "h", "g"]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 2] }}
[fields]
u = "scalar"
P = {{ kind = "scalar", on = "x = 0" }}
[data]
f = "scalar"
a = {{ kind = "scalar", on = "x = 0" }}
[boundary]
"x = 0" = "{density}"
"x = 2" = "0"
[equations]
e = "u,xx + f = 0"
z = {{ equation = "{imposed}", on = "x = 0" }}
h = {{ equation = "{stated}", on = "x = 0" }}
g = {{ equation = "u,x = 0", on = "x = 2" }}
"#
    );
    studied_text("p4p", &text, &[])
}

/// By hand: with b the density at x = 0 in which P is put in, −u' δu + δb = 0 there.
#[test]
fn what_is_imposed_on_a_field_of_the_boundary_restricts_its_variations() {
    for (density, imposed, stated, word) in [
        // P = 0: b = 0, the end is free, and u is not given there.
        ("P u", "P = 0", "u,x = 0", "proved"),
        ("P u", "P = 0", "u = 0", "refuted"),
        // P = a is a load: −u' + a = 0.
        ("P u", "P = a", "u,x = a", "proved"),
        ("P u", "2 P - 2 a = 0", "u,x = a", "proved"),
        ("P (u - a)", "P = a", "u = a", "refuted"),
        // P = u': b = u u', −u' δu + u δu' + u' δu = u δu'.
        ("P u", "P = u,x", "u = 0", "proved"),
        ("P u", "P = u,x", "u,x = 0", "refuted"),
        // P is another name of u: b = −3 u, u' = −3.
        ("-3 P", "u = P", "u,x = -3", "proved"),
        ("-3 P", "u = P", "u = 0", "refuted"),
        // P² = a² is solved for no field.
        ("P u", "P^2 = a^2", "u = 0", "undecided"),
    ] {
        let study = with_traction(density, imposed, stated);
        let verdict = decided(&study, "functional.euler");
        let said = verdict.detail();
        assert_eq!(
            verdict.word(),
            word,
            "{density}, {imposed}, {stated}: {said}"
        );
    }
}

/// P0p without equilibrium imposed, with the traction on S_u a field of its own: δP_k gives u_k = ubar_k there (T4 §4), but not where P is
/// imposed to vanish; then S_u is free.
#[test]
fn a_traction_that_is_imposed_to_vanish_gives_no_displacement() {
    let text = row_text("p0p");
    let rows = [
        ("yields = [\"4\", \"5\", \"6\", \"7\"]", false),
        ("yields = [\"4\", \"5\", \"6\"]", false),
        ("yields = [\"4\", \"6\", \"11\"]", true),
    ];
    for (yields, is_true) in rows {
        let text = text
            .replace(
                "imposed = [\"2\", \"3\", \"4\"]\nsolvable = [\"4\"]",
                "imposed = [\"2\", \"3\", \"10\"]",
            )
            .replace("yields = [\"5\", \"6\", \"7\"]", yields)
            .replace(
                "[equations]\n",
                "[equations]\n10 = { equation = \"Pb_k = 0\", on = \"S_u\" }\n11 = { equation = \"P_k = 0\", on = \"S_u\" }\n",
            );
        let study = studied_text("p0p", &text, &[("d", "2")]);
        let verdict = decided(&study, "functional.euler");
        let is_proved = verdict.word() == "proved";
        assert_eq!(is_proved, is_true, "{yields}: {}", verdict.detail());
    }
}

/// In a plane body with the energy e_ij e_ij of the strain the traction is 2 n_i e_ij: where u_1 alone is held on x_1 = 0,
/// u_1,2 + u_2,1 = 0 is natural there, and nothing else; where u_2 alone is, u_1,1 = 0.
#[test]
fn on_rollers_the_other_component_is_free() {
    let on_rollers = |held: &str, stated: &str| {
        let text = format!(
            r#"
kind = "functional"
name = "rollers"
density = "1/2 (u_i,j + u_j,i) u_i,j - f_i u_i"
yields = ["e", "h"]
[sizes]
d = 2
[domain]
coordinates = "x_i"
intervals = {{ x_1 = [0, 2], x_2 = [0, 1] }}
[fields]
u = "vector"
[data]
f = "vector"
[boundary]
"x_1 = 0" = {{ fixed = ["{held}"] }}
"x_1 = 2" = {{ fixed = ["u"] }}
"x_2 = 0" = {{ fixed = ["u"] }}
"x_2 = 1" = {{ fixed = ["u_1", "u_2"] }}
[equations]
e = "u_i,jj + u_j,ji + f_i = 0"
h = {{ equation = "{stated}", on = "x_1 = 0" }}
"#
        );
        let study = studied_text("p4p", &text, &[]);
        decided(&study, "functional.euler").word().to_owned()
    };
    for (held, stated, word) in [
        ("u_1", "u_1,2 + u_2,1 = 0", "proved"),
        ("u_1", "u_2,1 = 0", "refuted"),
        ("u_1", "u_1,1 = 0", "refuted"),
        ("u_1", "u_2 = 0", "refuted"),
        ("u_2", "u_1,1 = 0", "proved"),
        ("u_2", "u_1,2 + u_2,1 = 0", "refuted"),
    ] {
        assert_eq!(on_rollers(held, stated), word, "{held}: {stated}");
    }
}

/// ∫ (½ u''² − f u) dx with u' = 0 imposed at x = 0: u''' = 0 is natural there, and u'' = 0 is not.
#[test]
fn a_slope_that_is_imposed_is_not_varied() {
    for (stated, word) in [("u,xxx = 0", "proved"), ("u,xx = 0", "refuted")] {
        let text = format!(
            r#"
kind = "functional"
name = "slope"
density = "1/2 u,xx^2 - f u"
imposed = ["z"]
yields = ["e", "h"]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 2] }}
[fields]
u = "scalar"
[data]
f = "scalar"
[boundary]
"x = 0" = "0"
"x = 2" = {{ fixed = ["u", "u,n"] }}
[equations]
e = "u,xxxx = f"
z = {{ equation = "u,x = 0", on = "x = 0" }}
h = {{ equation = "{stated}", on = "x = 0" }}
"#
        );
        let study = studied_text("p4p", &text, &[]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), word, "{stated}: {}", verdict.detail());
    }
}

#[test]
fn a_current_needs_the_multiplier_of_what_is_imposed() {
    let study = studied(
        "1/2 u,x^2 + 1/2 v,x^2",
        &["u,xx = 0"],
        &[("u,x = v", "")],
        [HELD, HELD],
    );
    let own = study
        .verdicts
        .iter()
        .find(|d| d.claim == "functional.noether");
    assert_eq!(own.unwrap().finding.verdict.word(), "undecided");
}

/// The verdict on a stated solution.
fn solution(text: &str) -> (String, String) {
    let study = studied_text("p4p", text, &[]);
    let verdict = decided(&study, "functional.solution");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

#[test]
fn conditions_on_a_piece_whose_place_is_not_stated_are_not_taken_for_true() {
    let text = r#"
kind = "functional"
name = "curved"
density = "1/2 u,i u,i"
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
u = "scalar"
[boundary]
S = "0"
[solutions.tilted]
fields = { u = "x_1" }
"#;
    let (word, detail) = solution(text);
    assert_eq!(word, "undecided", "{detail}");
    assert!(detail.contains("where S lies is not stated"), "{detail}");
}

#[test]
fn a_force_at_the_corners_of_a_plate_is_a_condition() {
    // Twisted by w = x y, a free plate bears forces 2 (1 − ν) at its corners (Kirchhoff 1850); edges and interior are free.
    let plate = |field: &str| {
        format!(
            r#"
kind = "functional"
name = "plate"
density = "1/2 (u,xx + u,yy)^2 + (1 - nu) (u,xy^2 - u,xx u,yy)"
[domain]
coordinates = ["x", "y"]
intervals = {{ x = [0, 1], y = [0, 1] }}
[fields]
u = "scalar"
[parameters]
nu = "1/3"
[boundary]
"x = 0" = "0"
"x = 1" = "0"
"y = 0" = "0"
"y = 1" = "0"
[solutions.own]
fields = {{ u = "{field}" }}
"#
        )
    };
    let (word, detail) = solution(&plate("x y"));
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("meet"), "{detail}");
    let (word, detail) = solution(&plate("2 x - y + 3"));
    assert_eq!(word, "proved", "{detail}");
}

#[test]
fn stated_values_may_need_each_other() {
    // u'' + f = 0, where f is stated too; an order of statements does not matter.
    let text = |fields: &str| {
        format!(
            r#"
kind = "functional"
name = "string"
density = "1/2 u,x^2 - f u"
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 1] }}
[fields]
u = "scalar"
[data]
f = "scalar"
[boundary]
"x = 0" = {{ fixed = ["u"] }}
"x = 1" = {{ fixed = ["u"] }}
[solutions.own]
fields = {fields}
"#
        )
    };
    for (fields, word) in [
        (r#"{ f = "2", u = "f x (1 - x)/2" }"#, "proved"),
        (r#"{ u = "f x (1 - x)/2", f = "2" }"#, "proved"),
        (r#"{ f = "-u,xx", u = "x^4 - x" }"#, "proved"),
        (r#"{ f = "u,xx", u = "x^4 - x" }"#, "refuted"),
        (r#"{ f = "3", u = "f x (1 - x)" }"#, "refuted"),
        (r#"{ f = "u", u = "f x" }"#, "undecided"),
        // ∫ (u'²/2 − f u) dx = −f²/24, in which f is what it is stated to be.
        (
            "{ f = \"2\", u = \"f x (1 - x)/2\" }\nvalue = \"-f^2/24\"",
            "proved",
        ),
        (
            "{ f = \"2\", u = \"f x (1 - x)/2\" }\nvalue = \"-f^2/12\"",
            "refuted",
        ),
    ] {
        let (own, detail) = solution(&text(fields));
        assert_eq!(own, word, "{fields}: {detail}");
    }
}

/// Where u,x = 0 is imposed, δu is a constant: of ∫ (u²/2 − x u) dx on 0 < x < 1 the field u = 1/2 is stationary, and u = 1/4 is not.
#[test]
fn a_stated_field_is_stationary_for_the_variations_that_are_admitted() {
    let word = |value: &str, more: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"u^2/2 - x u\"\nimposed = [\"b\"]\n[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nm = \"scalar\"\n[boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = \"0\"\n\
             [equations]\nb = \"u,x = 0\"\n{more}[solutions.a.fields]\nu = \"{value}\"\nm = \"x^2/2 - x/2\"\n"
        );
        let study = studied_text("p4p", &text, &[]);
        decided(&study, "functional.solution").word().to_owned()
    };
    assert_eq!(word("1/2", ""), "undecided");
    assert_eq!(word("1/4", ""), "refuted");
    // With the multiplier m: u − x − m' = 0 inside, and m = 0 at both ends.
    let multiplier = "[multipliers]\nb = \"-m\"\n";
    assert_eq!(word("1/2", multiplier), "proved");
}

/// Of ∫ (½ u,xy² − q u) with x = 1 and y = 1 free follows u,xy = 0 at their corner (by parts twice), and nothing where u is imposed there.
#[test]
fn what_is_imposed_at_a_corner_is_not_varied_there() {
    let word = |imposed: &str, stated: &str| {
        let text = format!(
            r#"
kind = "functional"
name = "corner"
density = "1/2 u,xy^2 - q u"
imposed = [{imposed}]
yields = ["e", "r", "t"{stated}]
[domain]
coordinates = ["x", "y"]
intervals = {{ x = [0, 1], y = [0, 1] }}
[fields]
u = "scalar"
[data]
q = "scalar"
[boundary]
"x = 0" = {{ fixed = ["u"] }}
"x = 1" = "0"
"y = 0" = {{ fixed = ["u"] }}
"y = 1" = "0"
[equations]
e = "u,xxyy = q"
r = {{ equation = "u,xyy = 0", on = "x = 1" }}
t = {{ equation = "u,xxy = 0", on = "y = 1" }}
c = {{ equation = "u,xy = 0", on = "x = 1, y = 1" }}
z = {{ equation = "2 u = 3", on = "x = 1, y = 1" }}
s = {{ equation = "u^2 = 1", on = "x = 1, y = 1" }}
"#
        );
        let study = studied_text("p4p", &text, &[]);
        decided(&study, "functional.euler").word().to_owned()
    };
    let at_corner = ", \"c\"";
    assert_eq!(word("", at_corner), "proved");
    assert_eq!(word("", ""), "refuted");
    assert_eq!(word("\"z\"", ""), "proved");
    assert_eq!(word("\"z\"", at_corner), "refuted");
    // What is not solved for the field restricts it in a way that is not known.
    assert_eq!(word("\"s\"", ""), "undecided");
}
