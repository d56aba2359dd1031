//! Systems of equations with their conditions as wholes: what does not follow at one place may follow from conditions at several, and what
//! is divided by may vanish where conditions are.

use crate::table::{decided, studied_text};

/// A functional on [0, 1], on [0, l] or on the unit square. Fields, data and boundary fields are scalars, `m on x = 0` lives on a face; an
/// equation on a piece is `on: equation`; a face without a density has u fixed.
#[derive(Clone, Copy, Default)]
struct Model<'a> {
    density: &'a str,
    fields: &'a [&'a str],
    data: &'a [&'a str],
    parameters: &'a [&'a str],
    assumed: &'a [&'a str],
    faces: &'a [(&'a str, &'a str)],
    imposed: &'a [&'a str],
    stated: &'a [&'a str],
}

impl Model<'_> {
    /// The verdict in a word, and what is said.
    fn euler(&self) -> (String, String) {
        verdict_on(&self.text())
    }

    fn text(&self) -> String {
        let is_plane = self.faces.iter().any(|(face, _)| face.starts_with('y'));
        let last = self
            .faces
            .iter()
            .rev()
            .find_map(|(face, _)| face.strip_prefix("x = "));
        let (coordinates, intervals) = if is_plane {
            ("\"x\", \"y\"", "x = [0, 1], y = [0, 1]".to_owned())
        } else {
            ("\"x\"", format!("x = [0, {}]", last.unwrap_or("1")))
        };
        let scalar = |own: &&str| match own.split_once(" on ") {
            Some((name, on)) => format!("{name} = {{ kind = \"scalar\", on = \"{on}\" }}\n"),
            None => format!("{own} = \"scalar\"\n"),
        };
        let scalars = |list: &[&str]| list.iter().map(scalar).collect::<String>();
        let boundary = |(face, density): &(&str, &str)| {
            if density.is_empty() {
                format!("\"{face}\" = {{ fixed = [\"u\"] }}\n")
            } else {
                format!("\"{face}\" = \"{density}\"\n")
            }
        };
        let names = |mark: &str, list: &[&str]| {
            let all = (0..list.len()).map(|i| format!("\"{mark}{i}\""));
            all.collect::<Vec<_>>().join(", ")
        };
        let equation = |mark: &str, (i, text): (usize, &&str)| match text.split_once(": ") {
            Some((on, text)) => format!("{mark}{i} = {{ equation = \"{text}\", on = \"{on}\" }}\n"),
            None => format!("{mark}{i} = \"{text}\"\n"),
        };
        let equations: String = [("i", self.imposed), ("s", self.stated)]
            .into_iter()
            .flat_map(|(mark, list)| list.iter().enumerate().map(move |own| equation(mark, own)))
            .collect();
        let parameters = self.parameters.iter();
        let parameters: String = parameters.map(|own| format!("{own} = {{}}\n")).collect();
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"{}\"\nimposed = [{}]\nyields = [{}]\nassumptions = {:?}\n[domain]\n\
             coordinates = [{coordinates}]\nintervals = {{ {intervals} }}\n[fields]\n{}[data]\n{}[parameters]\n{parameters}[boundary]\n{}[equations]\n{equations}",
            self.density,
            names("i", self.imposed),
            names("s", self.stated),
            self.assumed,
            scalars(self.fields),
            scalars(self.data),
            self.faces.iter().map(boundary).collect::<String>(),
        )
    }
}

fn verdict_on(text: &str) -> (String, String) {
    let study = studied_text("p4p", text, &[]);
    let verdict = decided(&study, "functional.euler");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

/// The same of the fields u, v and p that occur.
fn euler(
    density: &str,
    faces: &[(&str, &str)],
    imposed: &[&str],
    stated: &[&str],
) -> (String, String) {
    let occurs = |field: &&str| {
        stated
            .iter()
            .chain([&density])
            .any(|text| text.contains(*field))
    };
    let fields: Vec<&str> = ["u", "v", "p"].into_iter().filter(occurs).collect();
    let model = Model {
        density,
        fields: &fields,
        faces,
        imposed,
        stated,
        ..Model::default()
    };
    model.euler()
}

const FREE: [(&str, &str); 2] = [("x = 0", "0"), ("x = 1", "0")];
const HELD: [(&str, &str); 2] = [("x = 0", ""), ("x = 1", "0")];
const SQUARE: [(&str, &str); 4] = [
    ("x = 0", "0"),
    ("x = 1", "0"),
    ("y = 0", "0"),
    ("y = 1", "0"),
];

/// x u' = u has u = x besides zero, and u u' = x has u = −x besides x: a quotient with something below that vanishes at an end says nothing
/// there.
#[test]
fn nothing_is_carried_from_an_end_where_the_equations_are_singular() {
    let conditions = ["x = 1: p = 0"];
    for (density, faces, imposed, inside) in [
        ("p (x u,x - u)", FREE, &[][..], ["u = 0", "x p,x + 2 p = 0"]),
        (
            "p (x u,x - u)",
            HELD,
            &["x = 0: u = 0"][..],
            ["u = 0", "x p,x + 2 p = 0"],
        ),
        // A coefficient that is singular at the end: u = x.
        (
            "p (u,x - u/x)",
            HELD,
            &["x = 0: u = 0"][..],
            ["u = 0", "p,x + p/x = 0"],
        ),
        (
            "p (u u,x - x)",
            HELD,
            &["x = 0: u = 0"][..],
            ["u = x", "x p,x = 0"],
        ),
        (
            "p (u u,x - u)",
            HELD,
            &["x = 0: u = 0"][..],
            ["u = x", "x p,x + p = 0"],
        ),
    ] {
        let stated: Vec<&str> = inside.iter().chain(&conditions).copied().collect();
        let (word, detail) = euler(density, &faces, imposed, &stated);
        assert_ne!(word, "proved", "{density}: {detail}");
    }
    // Where the factor does not vanish the same is true.
    let (word, detail) = euler(
        "p ((1 + x) u,x - u)",
        &HELD,
        &["x = 0: u = 0"],
        &["u = 0", "p = 0"],
    );
    assert_eq!(word, "proved", "{detail}");
}

const GIVEN: [(&str, &str); 2] = [("x = 0", ""), ("x = 1", "")];

/// Fields that begin alike part where the equations have roots of them: u'' = 12 √|u| has u = x⁴ besides 0, u'' = 6 u^(2/3) has x⁶/125, and
/// u'' = u^(1/3) has 6^(−3/2) x³. Where the right side changes at most in proportion to u they do not.
#[test]
fn nothing_is_carried_along_equations_that_are_not_lipschitz() {
    let start = ["x = 0: u = 0", "x = 0: u,x = 0"];
    let word = |energy: &str| {
        let density = format!("1/2 u,x^2 + {energy}");
        euler(&density, &GIVEN, &start, &["u = 0"])
    };
    for energy in [
        "8 abs(u)^(3/2)",
        "18/5 u^(5/3)",
        "3/4 abs(u)^(4/3)",
        "3/4 u^(4/3)",
        "1/2 u^2 + 18/5 u^(5/3)",
    ] {
        let (word, detail) = word(energy);
        assert_eq!(word, "undecided", "{energy}: {detail}");
    }
    for energy in ["u^4", "1/2 u^2", "sqrt(1 + u^2)", "cos(u)"] {
        let (word, detail) = word(energy);
        assert_eq!(word, "proved", "{energy}: {detail}");
    }
    let (word, detail) = euler(
        "1/2 u,y^2 + 18/5 u^(5/3)",
        &[("x = 0", ""), ("x = 1", ""), ("y = 0", ""), ("y = 1", "")],
        &["y = 0: u = 0", "y = 0: u,y = 0"],
        &["u = 0"],
    );
    assert_eq!(word, "undecided", "{detail}");
}

/// With u' = 1 and u(0) = 0 the field is x: its square vanishes at the end with its rate 2 u u', and nowhere else.
#[test]
fn a_power_is_not_carried_along_by_its_own_rate() {
    let stated = |last| ["u,x = 1", "p,x = 0", last];
    for (last, expected) in [("u^2 = 0", "refuted"), ("u = x", "proved")] {
        let (word, detail) = euler("p (u,x - 1)", &GIVEN, &["x = 0: u = 0"], &stated(last));
        assert_eq!(word, expected, "{last}: {detail}");
    }
    // What a square says of its base is carried along.
    let start = ["x = 0: u = 0", "x = 0: u,x = 0"];
    let (word, detail) = euler("1/2 u,x^2 + 1/2 u^2", &GIVEN, &start, &["u^2 = 0"]);
    assert_eq!(word, "proved", "{detail}");
}

/// Each of these systems has one solution, or those that are stated, by what its ends enforce together: no jet refutes them.
#[test]
fn what_conditions_enforce_together_is_not_refuted() {
    let at_rest = ["x = 0: u = 0", "x = 1: u = 0"];
    for (density, faces, imposed, stated) in [
        (
            "1/2 u,x^2 - u",
            HELD,
            &["x = 0: u = 0"][..],
            &["u = x - x^2/2"][..],
        ),
        ("1/2 u,x^2 - u", HELD, &[], &["u,xx = -1", "x = 0: u,x = 1"]),
        (
            "p u u,x",
            HELD,
            &["x = 0: u = 0"],
            &["u = 0", "p u,x - (p u),x = 0"],
        ),
        (
            "x/2 u,x^2",
            [("x = 0", "0"), ("x = 1", "")],
            &[],
            &["u,x = 0"],
        ),
        (
            "1/2 u,x^2",
            [("x = 0", "1/4 u^4 - 1/2 u^2"), ("x = 1", "0")],
            &[],
            &["u^3 = u"],
        ),
        (
            "1/2 u,x^2 + 1/2 v,x^2 + 1/2 u^2 + v^2 + u v",
            FREE,
            &[],
            &["u = 0", "v = 0"],
        ),
    ] {
        let (word, detail) = euler(density, &faces, imposed, stated);
        assert_ne!(word, "refuted", "{density}: {detail}");
    }
    for (density, imposed, stated) in [
        ("1/2 u,i u,i + u^2", &[][..], &["u = 0"][..]),
        ("1/2 u,i u,i", &at_rest[..], &["u = 0"]),
        ("1/2 u,i u,i", &[], &["u,x = 0", "u,y = 0"]),
    ] {
        let (word, detail) = euler(density, &SQUARE, imposed, stated);
        assert_ne!(word, "refuted", "{density}: {detail}");
    }
}

/// What is false of the systems is refuted by polynomials that satisfy one of them, in the body and at its ends.
#[test]
fn polynomials_that_satisfy_one_system_alone_refute() {
    for (density, faces, imposed, stated) in [
        ("1/2 u,x^2", FREE, &[][..], &["u = 0"][..]),
        ("1/2 u,x^2 - u", HELD, &["x = 0: u = 0"], &["u = x + x^2/2"]),
        ("1/2 u,xx^2", FREE, &[], &["u,x = 0"]),
        ("1/2 u,x^2", FREE, &[], &["u,xx = 0", "x = 0: u,x = 1"]),
    ] {
        let (word, detail) = euler(density, &faces, imposed, stated);
        assert_eq!(word, "refuted", "{density}: {detail}");
        // Of what is stated without conditions any jet is that of a solution, and so is any of u,x = 0, which a square without loads says.
        let is_local =
            detail.contains("the Euler equation") || detail.contains("natural condition");
        let is_square = ["1/2 u,x^2", "1/2 u,xx^2"].contains(&density);
        assert!(is_local || is_square || detail.contains("u = "), "{detail}");
    }
    let (word, detail) = euler("1/2 u,i u,i", &SQUARE, &[], &["u,ii = 0", "x = 1: u = 0"]);
    assert_eq!(word, "refuted", "{detail}");
}

/// Conditions along a face are equations of their own: u'' = 0 along x = 1 with u' = 0 at its ends gives u' = 0, whatever the load; and on a curved
/// piece what is divided by is said.
#[test]
fn conditions_along_a_face_are_no_data() {
    let text = |faces: &str, density: &str, stated: &str, labels: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\nyields = [{labels}]\n[domain]\ncoordinates = [\"x\", \"y\"]\n\
             {faces}[equations]\n{stated}"
        )
    };
    let square = "intervals = { x = [0, 1], y = [0, 1] }\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n[boundary]\n\
                  \"x = 0\" = \"0\"\n\"x = 1\" = \"1/2 u,y^2\"\n\"y = 0\" = \"0\"\n\"y = 1\" = \"0\"\n";
    let stated = "e = \"u,yy + q = 0\"\na = { equation = \"u,y = 0\", on = \"x = 1\" }\nb = { equation = \"u,y = 0\", on = \"y = 0\" }\n\
                  c = { equation = \"u,y = 0\", on = \"y = 1\" }\n";
    let along = text(
        square,
        "1/2 u,y^2 - q u",
        stated,
        "\"e\", \"a\", \"b\", \"c\"",
    );
    let study = studied_text("p4p", &along, &[]);
    assert_ne!(decided(&study, "functional.euler").word(), "refuted");
    let disc = "boundary = [\"S\"]\n[parameters]\nk = {}\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n[boundary]\nS = \"0\"\n";
    let stated = "e = \"k u,ii + q = 0\"\na = { equation = \"u,i n_i = 0\", on = \"S\" }\n";
    let free = text(disc, "k/2 u,i u,i - q u", stated, "\"e\", \"a\"");
    let study = studied_text("p4p", &free, &[]);
    let verdict = decided(&study, "functional.euler");
    assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
    assert!(verdict.detail().contains("k ≠ 0"), "{}", verdict.detail());
}

/// What holds of a model, where only some of its verdicts would be false.
fn is_not(false_words: &[&str], model: Model<'_>) {
    let (word, detail) = model.euler();
    assert!(!false_words.contains(&word.as_str()), "{word}: {detail}");
}

/// A string under the load f, free at both ends.
const LOADED: Model<'static> = Model {
    density: "1/2 u,x^2 - f u",
    fields: &["u"],
    data: &["f"],
    parameters: &[],
    assumed: &[],
    faces: &FREE,
    imposed: &[],
    stated: &["u,xx + f = 0", "x = 0: u,x = 0", "x = 1: u,x = 0"],
};

/// With w(0) = −1 and w(1) = 1 the slope is 2 at both ends, although it is zero wherever w has one sign.
#[test]
fn a_sign_at_one_place_is_none_at_another() {
    let model = Model {
        density: "1/2 u,x^2",
        fields: &["u"],
        data: &["w"],
        faces: &[
            ("x = 0", "(abs(w)^3 - w^3) u"),
            ("x = 1", "-(abs(w)^3 + w^3) u"),
        ],
        stated: &[
            "u,xx = 0",
            "x = 0: u,x = abs(w)^3 - w^3",
            "x = 1: u,x = abs(w)^3 + w^3",
            "u,x = 0",
        ],
        ..Model::default()
    };
    is_not(&["proved", "refuted"], model);
}

/// u'' = |g| with u' = 0 at both ends gives ∫|g| = 0, so that u' = 0 follows, and no jet with a load refutes it.
#[test]
fn a_load_of_one_sign_on_a_free_body_is_none() {
    let model = Model {
        density: "1/2 u,x^2 + u abs(g)",
        data: &["g"],
        stated: &[
            "u,xx = abs(g)",
            "x = 0: u,x = 0",
            "x = 1: u,x = 0",
            "u,x = 0",
        ],
        ..LOADED
    };
    is_not(&["refuted"], model);
}

/// What grows everywhere and is zero at both ends is zero.
#[test]
fn what_is_assumed_everywhere_binds_the_whole() {
    let model = Model {
        fields: &["u", "m on x = 0", "k on x = 1"],
        assumed: &["u,x >= 0"],
        faces: &[("x = 0", "m u"), ("x = 1", "k u")],
        stated: &[
            "u,xx + f = 0",
            "x = 0: u = 0",
            "x = 1: u = 0",
            "x = 0: m = u,x",
            "x = 1: k = -u,x",
            "u = 0",
        ],
        ..LOADED
    };
    is_not(&["refuted"], model);
}

/// v u' = v (u² + 1) on a body longer than π leaves v = 0 alone.
#[test]
fn a_solution_that_ends_before_the_body_is_none() {
    let model = Model {
        density: "p v (u,x - u^2 - 1) + r v,x",
        fields: &["u", "v", "p", "r"],
        data: &["P on x = 0", "R on x = 0", "Q on x = 100", "S on x = 100"],
        faces: &[("x = 0", "-P u - R v"), ("x = 100", "-Q u - S v")],
        stated: &[
            "v (u,x - u^2 - 1) = 0",
            "v,x = 0",
            "(p v),x + 2 p v u = 0",
            "p (u,x - u^2 - 1) = r,x",
            "x = 0: p v = -P",
            "x = 100: p v = Q",
            "x = 0: r = -R",
            "x = 100: r = S",
            "v = 0",
        ],
        ..Model::default()
    };
    is_not(&["refuted"], model);
}

/// Where |a| is largest a' = 0, so that b a' = a gives a = 0 there.
#[test]
fn a_quotient_of_fields_is_no_free_field() {
    let model = Model {
        density: "0 a",
        fields: &["a", "b"],
        faces: &FREE,
        imposed: &["b a,x = a", "x = 0: a = 0", "x = 1: a = 0"],
        stated: &["a = 0"],
        ..Model::default()
    };
    is_not(&["refuted"], model);
}

/// With the conjugate of s⁴/4 stress and displacement leave zero together: s = c³ x³, u = 3 c³ x² for c² = 1/6.
#[test]
fn an_energy_without_a_formula_may_be_a_root() {
    let (word, detail) = verdict_on(
        r#"kind = "functional"
name = "AB3"
density = "s_11 u,1 - B(s) + 1/2 u^2 - r_11 v,1 + B(r) - 1/2 v^2"
yields = ["a", "b", "c", "d", "e", "f", "g", "z"]
[sizes]
d = 1
[domain]
coordinates = "x_i"
intervals = { x_1 = [0, 1] }
[fields]
u = "scalar"
v = "scalar"
s = "symmetric"
r = "symmetric"
m = { kind = "scalar", on = "x_1 = 0" }
[boundary]
"x_1 = 0" = "m (u - v)"
"x_1 = 1" = { fixed = ["u", "v"] }
[equations]
a = "u,1 = B'_11(s)"
b = "s_11,1 = u"
c = "v,1 = B'_11(r)"
d = "r_11,1 = v"
e = { equation = "u = v", on = "x_1 = 0" }
f = { equation = "m = s_11", on = "x_1 = 0" }
g = { equation = "s_11 = r_11", on = "x_1 = 0" }
z = "u = v"
[functions]
A = { of = "symmetric", conjugate = "B", value = "1/4 X_11^4" }
B = { of = "symmetric", conjugate = "A", description = "b" }
"#,
    );
    assert!(word != "proved", "{word}: {detail}");
}

/// a = 0 and b = 1 + x satisfy what is imposed.
#[test]
fn what_was_divided_by_may_vanish() {
    let model = Model {
        density: "0 a",
        fields: &["a", "b", "c"],
        faces: &FREE,
        imposed: &["b a,x = a", "b,x = 1", "x = 0: a = 0", "x = 0: b = 1"],
        stated: &["a = 0"],
        ..Model::default()
    };
    let (word, detail) = model.euler();
    assert!(!detail.contains("never so"), "{word}: {detail}");
}

/// P = 3 at the end x = 1, and P is one number, so that (P − 3) u = 0 follows.
#[test]
fn a_parameter_that_a_condition_fixes_is_fixed_everywhere() {
    let model = Model {
        fields: &["u", "m on x = 1"],
        parameters: &["P"],
        faces: &[("x = 0", "0"), ("x = 1", "m (P - 3)")],
        stated: &[
            "u,xx + f = 0",
            "x = 0: u,x = 0",
            "x = 1: u,x = 0",
            "x = 1: P = 3",
            "(P - 3) u = 0",
        ],
        ..LOADED
    };
    is_not(&["refuted"], model);
}

/// u'' = 0 with u'(0) = P and u'(1) = −P leaves P = 0.
#[test]
fn a_parameter_in_conditions_at_both_ends_is_one_number() {
    let model = Model {
        density: "1/2 u,x^2",
        fields: &["u"],
        parameters: &["P"],
        faces: &[("x = 0", "P u"), ("x = 1", "P u")],
        stated: &[
            "u,xx = 0",
            "x = 0: u,x = P",
            "x = 1: u,x = -P",
            "x = 0: u,x = 0",
        ],
        ..Model::default()
    };
    is_not(&["refuted"], model);
}

/// u' <= 1 and u(0) = 0 leave u(1) = 0 of u (u − 3) = 0.
#[test]
fn what_is_assumed_excludes_a_branch_of_a_condition() {
    let model = Model {
        fields: &["u", "m on x = 1", "k on x = 0"],
        assumed: &["u,x <= 1"],
        faces: &[("x = 0", "k u"), ("x = 1", "m u (u - 3)")],
        stated: &[
            "u,xx + f = 0",
            "x = 0: u = 0",
            "x = 1: u,x + m (2 u - 3) = 0",
            "x = 1: u (u - 3) = 0",
            "x = 0: k = u,x",
            "x = 1: u = 0",
        ],
        ..LOADED
    };
    is_not(&["refuted"], model);
}

/// g' >= 1 and 0 <= g <= 1 on the unit interval leave g = x.
#[test]
fn what_is_assumed_of_a_slope_and_of_values_binds() {
    let model = Model {
        density: "1/2 (u - g)^2",
        data: &["g"],
        assumed: &["g,x >= 1", "g >= 0", "g <= 1"],
        stated: &["u = g", "u = x"],
        ..LOADED
    };
    is_not(&["refuted"], model);
}

/// w (w − 1) (2 w − 1) = 0 with w(0) = 0: a continuous field stays on its branch.
#[test]
fn a_branch_of_a_product_goes_on() {
    let model = Model {
        density: "1/2 u,x^2 - f u + 1/2 w^2 (w - 1)^2",
        fields: &["u", "w", "m on x = 0"],
        faces: &[("x = 0", "m w"), ("x = 1", "0")],
        stated: &[
            "u,xx + f = 0",
            "x = 0: u,x = 0",
            "x = 1: u,x = 0",
            "w (w - 1) (2 w - 1) = 0",
            "x = 0: w = 0",
            "x = 0: m = 0",
            "w = 0",
        ],
        ..LOADED
    };
    is_not(&["refuted"], model);
}

/// exp(P) < 1 says P < 0, so that (P + |P|) u = 0 is true.
#[test]
fn numbers_keep_to_what_is_assumed() {
    let model = Model {
        density: "1/2 u,x^2",
        data: &[],
        parameters: &["P"],
        assumed: &["exp(P) < 1"],
        stated: &[
            "u,xx = 0",
            "x = 0: u,x = 0",
            "x = 1: u,x = 0",
            "(P + abs(P)) u = 0",
        ],
        ..LOADED
    };
    is_not(&["refuted"], model);
}
