//! A field that is known on a curved piece of the boundary: what follows for its derivatives there, by formulas of differential geometry.

use crate::table::{decided, read_text, studied_text};
use chetaev_model::Style;

/// A membrane or a plate with the edge S, on which the field vanishes.
fn model(density: &str, interior: &str, edge: &str) -> String {
    format!(
        r#"
kind = "functional"
name = "edge"
density = "{density}"
imposed = ["zero"]
yields = ["interior", "edge"]
[domain]
coordinates = ["x", "y"]
boundary = ["S"]
[parameters]
nu = "1/3"
[fields]
w = "scalar"
[data]
f = "scalar"
[boundary]
S = {{ fixed = ["w"] }}
[equations]
interior = "{interior}"
zero = {{ equation = "w = 0", on = "S" }}
edge = {{ equation = "{edge}", on = "S" }}
"#
    )
}

fn verdict(text: &str) -> (String, String) {
    let study = studied_text("p4p", text, &[]);
    let verdict = decided(&study, "functional.euler");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

#[test]
fn laplaces_operator_on_an_edge_is_split_into_the_normal_and_the_curvature() {
    // Δw = ∂²w/∂n² + H ∂w/∂n + Δ_S w = −f, with any load f; on the edge w = 0.
    let membrane = |edge: &str| verdict(&model("1/2 w,i w,i - f w", "w,ii + f = 0", edge));
    let (word, detail) = membrane("n_i n_j w,ij + curvature_kk n_i w,i + f = 0");
    assert_eq!(word, "proved", "{detail}");
    for wrong in [
        "n_i n_j w,ij + 2 curvature_kk n_i w,i + f = 0",
        "n_i n_j w,ij + f = 0",
        "n_i w,i = 0",
    ] {
        assert_eq!(membrane(wrong).0, "refuted", "{wrong}");
    }
    // The slope along the edge vanishes.
    let (word, detail) = membrane("epsilon_ij n_i w,j = 0");
    assert_eq!(word, "proved", "{detail}");
}

#[test]
fn the_moment_at_a_curved_edge_of_a_plate_contains_the_curvature() {
    // Timoshenko, Woinowsky-Krieger 1959, § 22, with the curvature of the normal.
    let plate = |edge: &str| {
        let density = "1/2 ((w,xx + w,yy)^2 - 2 (1 - nu) (w,xx w,yy - w,xy^2)) - f w";
        verdict(&model(density, "w,iijj = f", edge))
    };
    let (word, detail) = plate("w,ii - (1 - nu) curvature_kk n_i w,i = 0");
    assert_eq!(word, "proved", "{detail}");
    assert_eq!(
        plate("w,ii + (1 - nu) curvature_kk n_i w,i = 0").0,
        "refuted"
    );
    assert_eq!(plate("w,ii = 0").0, "refuted");
}

#[test]
fn what_two_equations_say_together_is_no_counterexample() {
    // w = 0 along the edge and Δw = 0 give w,yy = 0 there.
    let text = model("1/2 w,i w,i", "w,ii = 0", "w,yy = 0")
        .replace("boundary = [\"S\"]", "intervals = { x = [0, 1], y = [0, 1] }")
        .replace("S = { fixed", "S = { at = \"y = 1\", fixed")
        .replace("[equations]", "\"x = 0\" = \"0\"\n\"x = 1\" = \"0\"\n\"y = 0\" = \"0\"\n[equations]\na = { equation = \"w,x = 0\", on = \"x = 0\" }\nb = { equation = \"w,x = 0\", on = \"x = 1\" }\nc = { equation = \"w,y = 0\", on = \"y = 0\" }")
        .replace("\"edge\"]", "\"edge\", \"a\", \"b\", \"c\"]");
    let (word, detail) = verdict(&text);
    assert_eq!(word, "proved", "{detail}");
}

#[test]
fn a_name_never_means_a_component_of_another_field() {
    for (own, taken) in [("n_1", "n"), ("w", "w"), ("curvature_11", "curvature")] {
        let text =
            model("1/2 w,i w,i", "w,ii = 0", "w,ii = 0").replace("nu = ", &format!("{own} = "));
        let said = read_text("p4p", &text, &[])
            .diagnostics
            .render(Style::Plain);
        assert!(
            said.contains("declared-twice") && said.contains(&format!("`{taken}`")),
            "{said}"
        );
    }
}

/// ∫ of a density of second derivatives over a plane region with the free curved edge S, with two conditions stated on it.
fn free_edge(field: &str, density: &str, interior: &str, edge: [&str; 2]) -> (String, String) {
    let [moment, force] = edge;
    verdict(&format!(
        r#"
kind = "functional"
name = "free-edge"
density = "{density}"
yields = ["interior", "moment", "force"]
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
u = "{field}"
[data]
f = "{field}"
[boundary]
S = "0"
[equations]
interior = "{interior}"
moment = {{ equation = "{moment}", on = "S" }}
force = {{ equation = "{force}", on = "S" }}
"#
    ))
}

#[test]
fn conditions_on_a_free_curved_edge_that_lead_back_to_each_other_are_refuted() {
    let laplacian = |force: &str| {
        let density = "1/2 u,ii u,jj - f u";
        free_edge("scalar", density, "u,iijj = f", ["u,ii = 0", force])
    };
    let (word, detail) = laplacian("n_j u,iij = 0");
    assert_eq!(word, "proved", "{detail}");
    let wrong = [
        laplacian("n_j u,iij + u = 0"),
        // Right where the edge is straight: ∂/∂s (n_i t_j u,ij) contains the curvature.
        free_edge(
            "scalar",
            "1/2 u,ij u,ij - f u",
            "u,iijj = f",
            [
                "n_i n_j u,ij = 0",
                "n_j u,iij + (n_i delta_jk - n_i n_j n_k) u,ijk = 0",
            ],
        ),
        // The derivative along the edge is missing.
        free_edge(
            "vector",
            "1/2 u_i,jk u_i,jk - f_i u_i",
            "u_i,jjkk = f_i",
            ["n_k n_j u_i,jk = 0", "n_j u_k,iij = 0"],
        ),
    ];
    for (word, detail) in wrong {
        assert_eq!(word, "refuted", "{detail}");
    }
}

#[test]
fn what_is_false_where_the_edge_is_straight_is_false() {
    // Nothing says that w vanishes along the edge, only that it is given there: w,ii has a part along it.
    let text = model(
        "1/2 w,ij w,ij - f w",
        "w,iijj = f",
        "w,ii - curvature_ii n_j w,j = 0",
    )
    .replace("imposed = [\"zero\"]\n", "");
    let (word, detail) = verdict(&text);
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("(edge)"), "{detail}");
    let (word, detail) = verdict(&text.replace("w,ii - curvature_ii n_j w,j", "n_i n_j w,ij"));
    assert_eq!(word, "proved", "{detail}");
}

/// A membrane with surface tension on S_s, whose edge ends where the displacement is given: the energy ½ (|∇u|² − (∂u/∂n)²) of its slope along S_s has
/// the condition ∂u/∂n − Δ_S u = P there and none at the ends, where u is not varied. Δ_S u = Δu − ∂²u/∂n² − H ∂u/∂n. Where nothing is given at
/// the ends the slopes along both pieces have to cancel, which is not stated.
#[test]
fn what_is_given_on_one_piece_is_not_varied_where_another_ends() {
    let text = |held: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 u,i u,i - q u\"\nyields = [\"e\", \"s\", \"o\"]\n[sizes]\nd = 2\n[domain]\n\
             coordinates = \"x_i\"\nboundary = [\"S_u\", \"S_s\"]\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n\
             P = {{ kind = \"scalar\", on = \"S_s\" }}\n[boundary]\n\"S_u\" = {held}\n\"S_s\" = \"1/2 u,i u,i - 1/2 (n_i u,i)^2 - P u\"\n\
             [equations]\ne = \"u,ii + q = 0\"\n\
             s = {{ equation = \"n_i u,i - u,ii + n_i n_j u,ij + curvature_ii n_j u,j = P\", on = \"S_s\" }}\n\
             o = {{ equation = \"n_i u,i = n_i u,i\", on = \"S_u\" }}\n"
        )
    };
    let study = studied_text("p4p", &text("{ fixed = [\"u\"] }"), &[]);
    let own = decided(&study, "functional.euler");
    assert_eq!(own.word(), "proved", "{}", own.detail());
    assert!(own.detail().contains("smooth"), "{}", own.detail());
    let free = text("\"0\"").replace(
        "o = { equation = \"n_i u,i = n_i u,i\"",
        "o = { equation = \"n_i u,i = 0\"",
    );
    let study = studied_text("p4p", &free, &[]);
    let own = decided(&study, "functional.euler");
    assert_ne!(own.word(), "proved", "{}", own.detail());
}

/// Normals are one where two pieces meet smoothly, and at the corner of a half disc they are not: what is proved there says so.
#[test]
fn what_is_proved_where_curved_pieces_meet_says_how() {
    let text = "kind = \"functional\"\nname = \"m\"\ndensity = \"1/2 u,i u,i - q u\"\nyields = [\"e\", \"a\", \"b\", \"v\"]\n[sizes]\nd = 2\n\
                [domain]\ncoordinates = \"x_i\"\nboundary = [\"S_u\", \"S_s\"]\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n\
                P = { kind = \"scalar\", on = \"S_u\" }\n[boundary]\n\"S_u\" = \"-P u\"\n\"S_s\" = \"0\"\n[equations]\ne = \"u,ii + q = 0\"\n\
                a = { equation = \"n_i u,i = P\", on = \"S_u\" }\nb = { equation = \"n_i u,i = 0\", on = \"S_s\" }\n\
                v = { equation = \"P = 0\", on = \"S_u, S_s\" }\n";
    let study = studied_text("p4p", text, &[]);
    let own = decided(&study, "functional.euler");
    let is_named = own.detail().contains("meet with a common tangent plane");
    assert!(own.word() != "proved" || is_named, "{}", own.detail());
}
