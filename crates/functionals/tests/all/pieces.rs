//! Fields and data of a piece of the boundary have no values anywhere else.

use crate::table::{read_text, studied_text};
use chetaev_model::Style;

/// ½|∇u|² in the plane with two pieces of boundary; λ lives on T, g on S.
fn text(density: &str, on_t: &str, equations: &str) -> String {
    format!(
        r#"kind = "functional"
name = "pieces"
density = "{density}"
yields = ["a"]
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S", "T"]
[fields]
u = "scalar"
lam = {{ kind = "scalar", on = "T" }}
[data]
g = {{ kind = "scalar", on = "S" }}
[define]
h = "2 g"
[boundary]
S = "-g u"
T = {on_t}
[equations]
a = "u,ii = 0"
{equations}
"#
    )
}

const DENSITY: &str = "1/2 u,i u,i";
const ON_T: &str = "\"-lam u\"";

#[test]
fn a_field_of_another_piece_is_shown_where_it_stands() {
    let cases = [
        (
            text("1/2 u,i u,i - lam u", ON_T, ""),
            "`lam` lives on T only, and has no values in the interior",
            ":3:26",
        ),
        (
            text("1/2 u,i u,i - h u", ON_T, ""),
            "`g` lives on S only, and has no values in the interior",
            ":3:",
        ),
        (
            text(DENSITY, "\"-g u\"", ""),
            "`g` lives on S only, and has no values on T",
            ":19:7",
        ),
        (
            text(DENSITY, ON_T, "b = \"u,i u,i = g\""),
            "`g` lives on S only, and has no values in the interior",
            ":22:16",
        ),
        (
            text(
                DENSITY,
                ON_T,
                "b = { equation = \"n_i u,i = lam\", on = \"S\" }",
            ),
            "`lam` lives on T only, and has no values on S",
            ":22:29",
        ),
        (
            text(DENSITY, "{ fixed = [\"u\"] }", "").replace(
                "S = \"-g u\"",
                "S = { density = \"-g u\", fixed = [\"lam\"] }",
            ),
            "`lam` lives on T only, and has no values on S",
            ":18:",
        ),
        (
            text(DENSITY, ON_T, "[multipliers]\na = \"lam\"").replace("yields", "imposed"),
            "`lam` lives on T only, and has no values in the interior",
            ":23:6",
        ),
        (
            text(DENSITY, ON_T, "").replace("on = \"S\"", "on = \"Q\""),
            "is not a piece of the boundary",
            ":14:29",
        ),
    ];
    for (text, words, place) in cases {
        let loaded = read_text("p4p", &text, &[]);
        let said = loaded.diagnostics.render(Style::Plain);
        assert!(loaded.problem.is_none(), "{words}: accepted");
        assert!(
            said.contains(words) && said.contains(place) && said.contains("help"),
            "{words}:\n{said}"
        );
    }
}

#[test]
fn a_field_of_a_piece_is_used_on_it() {
    let text = text(
        DENSITY,
        ON_T,
        "b = { equation = \"n_i u,i = g\", on = \"S\" }\nc = { equation = \"n_i u,i = lam\", on = \"T\" }\nd = { equation = \"u = 0\", on = \"T\" }",
    );
    let text = text.replace("[\"a\"]", "[\"a\", \"b\", \"c\", \"d\"]");
    let study = studied_text("p4p", &text, &[]);
    let verdict = &study.verdicts[0].finding.verdict;
    assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
}

/// A beam with a body at its free end: mass M and moment of inertia J (S. Timoshenko, Vibration Problems in Engineering, 1937, § 57).
fn loaded_beam(moment: &str, force: &str) -> String {
    format!(
        r#"kind = "functional"
name = "beam"
density = "rho/2 u,t^2 - EI/2 u,xx^2"
yields = ["a", "moment", "force"]
[domain]
coordinates = ["x"]
time = "t"
intervals = {{ x = [0, "l"] }}
[parameters]
l = "1"
rho = {{}}
EI = {{}}
J = {{}}
M = {{}}
[fields]
u = "scalar"
[boundary]
"x = 0" = {{ fixed = ["u", "u,n"] }}
"x = l" = "M/2 u,t^2 + J/2 u,xt^2"
[equations]
a = "rho u,tt + EI u,xxxx = 0"
moment = {{ equation = "{moment} = 0", on = "x = l" }}
force = {{ equation = "{force} = 0", on = "x = l" }}
"#
    )
}

#[test]
fn a_body_at_the_end_of_a_beam_has_two_conditions_with_accelerations() {
    let word = |moment: &str, force: &str| {
        let study = studied_text("p4p", &loaded_beam(moment, force), &[]);
        study.verdicts[0].finding.verdict.word().to_owned()
    };
    let (moment, force) = ("EI u,xx + J u,xtt", "EI u,xxx - M u,tt");
    assert_eq!(word(moment, force), "proved");
    assert_eq!(word("EI u,xx - J u,xtt", force), "refuted");
    assert_eq!(word(moment, "EI u,xxx + M u,tt"), "refuted");
}

#[test]
fn a_derivative_that_a_piece_has_no_condition_for_is_named() {
    let text = loaded_beam("u,xx", "u,xxx").replace("J/2 u,xt^2", "J/2 u,xx^2");
    let study = studied_text("p4p", &text, &[]);
    let detail = study.verdicts[0].finding.verdict.detail().to_owned();
    assert!(
        detail.contains("the density on `x = l` contains `u,xx`"),
        "{detail}"
    );
}

#[test]
fn mistakes_in_lists_and_numbers_are_shown() {
    let model = loaded_beam("u,xx", "u,xxx");
    let cases = [
        ("\"moment\", \"force\"]", "\"moment\", \"moment\"]", "`moment` stands twice under `yields`"),
        (
            "\"force\"]\n",
            "\"force\"]\nimposed = [\"a\"]\n",
            "`a` stands under `imposed` and under `yields`",
        ),
        ("l = \"1\"", "l = \"sqrt(-1)\"", "is no real number"),
        ("rho = {}", "rho = \"1/log(1)\"", "zero"),
        ("[\"u\", \"u,n\"]", "[\"u\", \"u,x\"]", "\"u,n\" the one along the normal"),
        ("coordinates = [\"x\"]", "coordinates = [\"x\", \"x\"]", "declared-twice"),
        ("l = \"1\"", "l = \"l\"", "`l`"),
        ("rho/2 u,t^2", "log(0) u,t^2", "`log(0)` is no real number"),
        (
            "[fields]",
            "[data]\nF = \"scalar\"\n[fields]",
            "",
        ),
        (
            "[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = { fixed = [\"u\", \"u,n\"] }",
            "[data]\nF = \"scalar\"\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = { fixed = [\"F\"] }",
            "`F` is data, which are given everywhere",
        ),
    ];
    for (from, to, words) in cases {
        assert!(model.contains(from), "{from}");
        let loaded = read_text("p4p", &model.replace(from, to), &[]);
        let said = loaded.diagnostics.render(Style::Plain);
        assert_eq!(loaded.problem.is_some(), words.is_empty(), "{to}: {said}");
        assert!(said.contains(words), "{to}: {said}");
    }
}

/// u = x y on −1 < x, y < 1 has the slope x y along the normal on all four faces, and the value −4/3: 4/3 inside, −8/3 on the faces.
#[test]
fn a_piece_may_be_several_faces_of_a_box() {
    let text = |pieces: &str, slope: &str, value: &str| {
        format!(
            "kind = \"functional\"\nname = \"faces\"\ndensity = \"1/2 u,i u,i\"\n[sizes]\nd = 2\n[domain]\ncoordinates = \"x_i\"\n\
             boundary = [\"S\", \"T\"]\n[fields]\nu = \"scalar\"\n[data]\ng = {{ kind = \"scalar\", on = \"S\" }}\n[boundary]\n\
             S = \"-g u\"\nT = {{ fixed = [\"u\"] }}\n[solutions.own]\nintervals = {{ x_1 = [-1, 1], x_2 = [-1, 1] }}\n\
             pieces = {{ {pieces} }}\nvalue = \"{value}\"\n[solutions.own.fields]\nu = \"x_1 x_2\"\ng = \"{slope}\"\n"
        )
    };
    let all = "S = [\"x_1 = -1\", \"x_1 = 1\", \"x_2 = -1\", \"x_2 = 1\"], T = []";
    let word = |text: &str| {
        let study = studied_text("p4p", text, &[]);
        let own = crate::table::decided(&study, "functional.solution");
        (own.word(), own.detail().to_owned())
    };
    let (own, detail) = word(&text(all, "x_1 x_2", "-4/3"));
    assert_eq!(own, "proved", "{detail}");
    assert!(detail.contains("the value is -4/3"), "{detail}");
    assert_eq!(word(&text(all, "x_1 x_2", "-2/3")).0, "refuted");
    // True on the faces x_1 = ±1 only, so that the second face must be looked at too.
    assert_eq!(word(&text(all, "x_1 x_2 + 1 - x_1^2", "-4/3")).0, "refuted");
    let refused = [
        (
            "S = [\"x_1 = -1\", \"x_1 = 1\", \"x_2 = -1\"], T = []",
            "the face x_2 = 1 of the box is no piece",
        ),
        (
            "S = [\"x_1 = -1\", \"x_1 = 1\", \"x_2 = -1\", \"x_2 = 1\"]",
            "where `T` lies is not stated",
        ),
        (
            "S = [\"x_1 = -1\", \"x_1 = 1\", \"x_2 = -1\", \"x_2 = 1\"], T = \"x_1 = 1\"",
            "`x_1 = 1` is a face of `S` already",
        ),
    ];
    for (pieces, words) in refused {
        let loaded = read_text("p4p", &text(pieces, "x_1 x_2", "-4/3"), &[]);
        assert!(loaded.problem.is_none(), "{pieces} is accepted");
        let said = loaded.diagnostics.render(Style::Plain);
        assert!(said.contains(words), "{said}");
    }
}

/// A field of a face has no derivative across it, and may have one along it.
#[test]
fn a_field_of_a_face_is_differentiated_along_it() {
    let told = |density: &str| {
        let text = format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 u,i u,i\"\n[domain]\ncoordinates = [\"x\", \"y\"]\nintervals = {{ x = [0, 1], y = [0, 1] }}\n\
             [fields]\nu = \"scalar\"\nv = {{ kind = \"scalar\", on = \"y = 1\" }}\n[boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = \"0\"\n\"y = 0\" = \"0\"\n\"y = 1\" = \"{density}\"\n"
        );
        read_text("p4p", &text, &[])
            .diagnostics
            .render(Style::Plain)
    };
    let said = told("1/2 v,y^2 + 1/2 (u - v)^2");
    assert!(
        said.contains("`v` lives on y = 1 only, and has no derivative across it"),
        "{said}"
    );
    let said = told("1/2 v,x^2 + 1/2 (u - v)^2");
    assert!(!said.contains("error"), "{said}");
}

/// On y = 3, z = 0 the condition 3 = 0 holds for no field, whatever else could be solved; and nothing that is printed is divided by zero.
#[test]
fn an_edge_on_which_nothing_can_hold_leaves_no_field() {
    let text = EDGES;
    let study = crate::table::studied_text("p4p", text, &[]);
    let own = crate::table::decided(&study, "functional.euler");
    assert_eq!(own.word(), "not-applicable", "{}", own.detail());
    assert!(own.detail().contains("no field"), "{}", own.detail());
    let open = text
        .replace("- 3*lam,z\"", "\"")
        .replace("\"3 = 0\"", "\"0 = 0\"");
    let open = open.replace("lam,t/3 - 3 = 0", "lam,t/3 = 0");
    let study = crate::table::studied_text("p4p", &open, &[]);
    let detail = crate::table::decided(&study, "functional.euler").detail();
    assert!(!detail.contains("1/0"), "{detail}");
    assert!(
        detail.matches("integrability of lam").count() < 2,
        "{detail}"
    );
}

/// A body whose edges have conditions of their own.
const EDGES: &str = r#"
kind = "functional"
name = "z"
density = "lam^2*lam,x^2 - lam*lam,z^2 - lam*load0 - lam,t^2/2 + 5*lam,t*lam,x^3/2 + lam,t*lam,y*lam,z^2*y/3 + lam,t*lam,y*lam,z^2*exp(y) - 2*lam,t*lam,y*lam,z^2 + lam,x^2/3 + 3*lam,y^2/2 + lam,z^2/6"
yields = ["e0", "e1", "e2", "e3", "e4", "e5", "e6", "e7", "e8", "e9", "e10", "e11", "e12", "e13", "e14", "e15"]
[domain]
coordinates = ["x", "y", "z"]
time = "t"
intervals = { x = ["0", "1"], y = ["0", "3"], z = ["0", "3/2"] }
[fields]
lam = "scalar"
[data]
load0 = "scalar"
[boundary]
"x = 0" = "lam,y*lam,z/2"
"x = 1" = "5*lam,y^2"
"y = 0" = "0"
"y = 3" = "5*lam,t - 3*lam,z"
"z = 0" = "-lam/2"
"z = 3/2" = "2*lam,t*lam,y/3"
[equations]
e0 = "-2*lam^2*lam,xx - 2*lam*lam,x^2 + 2*lam*lam,zz - 15*lam,t*lam,x*lam,xx - 2*lam,t*lam,y*lam,zz*y/3 - 2*lam,t*lam,y*lam,zz*exp(y) + 4*lam,t*lam,y*lam,zz - 4*lam,t*lam,yz*lam,z*y/3 - 4*lam,t*lam,yz*lam,z*exp(y) + 8*lam,t*lam,yz*lam,z - lam,t*lam,z^2*exp(y) - lam,t*lam,z^2/3 + lam,tt - 15*lam,tx*lam,x^2 - 2*lam,ty*lam,z^2*y/3 - 2*lam,ty*lam,z^2*exp(y) + 4*lam,ty*lam,z^2 - 4*lam,tz*lam,y*lam,z*y/3 - 4*lam,tz*lam,y*lam,z*exp(y) + 8*lam,tz*lam,y*lam,z - 2*lam,xx/3 - 3*lam,yy + lam,z^2 - lam,zz/3 - load0 = 0"
e1 = { equation = "-2*lam^2*lam,x - 15*lam,t*lam,x^2/2 - 2*lam,x/3 - lam,yz = 0", on = "x = 0" }
e2 = { equation = "2*lam^2*lam,x + 15*lam,t*lam,x^2/2 + 2*lam,x/3 - 10*lam,yy = 0", on = "x = 1" }
e3 = { equation = "-lam,t*lam,z^2*y/3 - lam,t*lam,z^2*exp(y) + 2*lam,t*lam,z^2 - 3*lam,y = 0", on = "y = 0" }
e4 = { equation = "lam,t*lam,z^2*y/3 + lam,t*lam,z^2*exp(y) - 2*lam,t*lam,z^2 + 3*lam,y = 0", on = "y = 3" }
e5 = { equation = "2*lam*lam,z - 2*lam,t*lam,y*lam,z*y/3 - 2*lam,t*lam,y*lam,z*exp(y) + 4*lam,t*lam,y*lam,z - lam,z/3 - 1/2 = 0", on = "z = 0" }
e6 = { equation = "-2*lam*lam,z + 2*lam,t*lam,y*lam,z*y/3 + 2*lam,t*lam,y*lam,z*exp(y) - 4*lam,t*lam,y*lam,z - 4*lam,ty/3 + lam,z/3 = 0", on = "z = 3/2" }
e7 = { equation = "-lam,z/2 + 1/7 = 0", on = "x = 0, y = 0" }
e8 = { equation = "lam,z/2 = 0", on = "x = 0, y = 3" }
e9 = { equation = "-lam,y/2 = 0", on = "x = 0, z = 0" }
e10 = { equation = "lam,y/2 = 0", on = "x = 0, z = 3/2" }
e11 = { equation = "-10*lam,y = 0", on = "x = 1, y = 0" }
e12 = { equation = "10*lam,y = 0", on = "x = 1, y = 3" }
e13 = { equation = "3 = 0", on = "y = 3, z = 0" }
e14 = { equation = "2*lam,t/3 - 3 = 0", on = "y = 3, z = 3/2" }
e15 = { equation = "-2*lam,t/3 = 0", on = "y = 0, z = 3/2" }
"#;
