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
