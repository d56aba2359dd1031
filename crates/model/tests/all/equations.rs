//! Equations that somebody states, and other models: what they are read as, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused, same};
use chetaev_model::{load, reload};
use std::collections::BTreeMap;

const DISC: &str = r#"
coordinates = ["x", "psi"]
parameters = { m = 2, r = 0.5, J = 1 }
lagrangian = { T = "1/2 m x'^2 + 1/2 J psi'^2" }
[constraints]
rolling = "x' = r psi'"
"#;

#[test]
fn equations_have_multipliers_and_unknowns_of_their_own() {
    let text = format!(
        "{DISC}[equations]\nshort = [\"m x'' = lambda_rolling\"]\n[equations.long]\nunknowns = [\"F\"]\nequations = {{ pull = \"m x'' = F\", turn = \"J psi'' = -F r\" }}\nsource = \"a book\"\n"
    );
    let model = model(&text);
    let [short, long] = &model.equations[..] else {
        panic!("{:?}", model.equations);
    };
    assert_eq!(
        (short.name.as_str(), short.equations[0].name.as_str()),
        ("short", "1")
    );
    assert_eq!(long.equations[1].name, "turn");
    assert_eq!(long.description, "a book");
    let unknown = model.graph.symbol_expr(long.unknowns[0]);
    assert_eq!(long.equations[0].right, unknown);
    same(&model, long.equations[1].left, "J psi''");
}

#[test]
fn slips_are_named() {
    for (section, words) in [
        (
            "[equations.a]\nequations = [\"m x''\"]",
            &["missing-equals"][..],
        ),
        (
            "[equations.a]\nequations = [\"m x''' = 0\"]",
            &["order-too-high"],
        ),
        (
            "[equations.a]\nequations = [\"m x'' = N\"]",
            &["unknown-name"],
        ),
        (
            "[equations.a]\nequations = [\"m x'' = lambda_b\"]",
            &["no constraint `b`"],
        ),
        (
            "[equations.a]\nunknowns = [\"N\"]",
            &["needs its `equations`"],
        ),
        (
            "[equations.a]\nunknowns = [\"m\"]\nequations = [\"x'' = 0\"]",
            &["a parameter already"],
        ),
        (
            "[equations.a]\nunknowns = [\"N\"]\nequations = [\"x'' = N'\"]",
            &["no derivative", "[define]"],
        ),
        ("[equations]\na = 3", &["wrong-kind"]),
        ("[twin.a]\nmap = { x = \"x\" }", &["needs `model`"]),
    ] {
        refused(&format!("{DISC}{section}\n"), 1, words);
    }
}

#[test]
fn a_twin_is_kept_with_the_texts_of_the_model() {
    let other = DISC
        .replace("psi", "chi")
        .replace("m = 2", "M = 2")
        .replace("m x'", "M x'");
    let files = BTreeMap::from([("other.toml".to_owned(), other)]);
    let text = format!("{DISC}[twin.other]\nmodel = \"other.toml\"\nmap = {{ chi = \"psi\" }}\nparameters = {{ M = \"m\" }}\n");
    let (model, _) = load("model.toml", &text, &files, &[])
        .into_result()
        .unwrap();
    let twin = &model.twins[0];
    same(&model, twin.map[0], "x");
    same(&model, twin.map[1], "psi");
    assert_eq!(twin.model.coordinates[1].name, "chi");
    assert_eq!(model.text.includes.len(), 1);
    let again = reload(&model.text).model.unwrap();
    assert_eq!(again.twins.len(), 1);
}
