//! A complete integral of the equation of Hamilton and Jacobi: what it is read as, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused};

const THROWN: &str = r#"
coordinates = ["x", "y"]
parameters = { m = 1, g = 9.81, E = 2, a = 1 }
lagrangian = { L = "1/2 m (x'^2 + y'^2) - m g y" }
"#;

#[test]
fn parts_of_a_complete_integral() {
    let text = format!(
        "{THROWN}[complete_integral]\nS = \"a x - E t\"\nconstants = [\"E\", \"a\"]\nquadratures = {{ y = \"sqrt(2 m (E - m g y) - a^2)\" }}\nmotion = {{ a = \"g/2\" }}\n"
    );
    let model = model(&text);
    let g = &model.graph;
    let stated = model.complete_integral.unwrap();
    let names: Vec<String> = stated.constants.iter().map(|&s| g.symbol_text(s)).collect();
    assert_eq!(names, ["E", "a"]);
    assert_eq!(stated.quadratures[0].0, 1);
    assert_eq!(stated.motion.len(), 1);
    assert_eq!(
        g.diff(stated.action, g.intern_symbol("x", 0)),
        g.symbol("a", 0)
    );
    // Without the section there is none.
    assert!(crate::common::model(THROWN).complete_integral.is_none());
}

/// Each slip by its code.
#[test]
fn slips_are_named() {
    let constants = "constants = [\"E\", \"a\"]";
    for (section, code) in [
        (constants.to_owned(), "missing-value"),
        ("S = \"a x\"".into(), "missing-value"),
        ("S = \"x'\"\nconstants = [\"E\"]".into(), "order-too-high"),
        ("S = \"a x\"\nconstants = [\"b\"]".into(), "unknown-name"),
        ("S = \"a x\"\nconstants = \"a\"".into(), "wrong-kind"),
        (
            format!("S = \"a x\"\n{constants}\nquadratures = {{ z = \"a\" }}"),
            "not-a-coordinate",
        ),
        (
            format!("S = \"a x\"\n{constants}\nquadratures = {{ y = \"a x\" }}"),
            "not-separated",
        ),
        (
            format!("S = \"a x\"\n{constants}\nmotion = {{ g = 0 }}"),
            "unknown-name",
        ),
        (format!("S = \"a x\"\n{constants}\nW = 3"), "unknown-key"),
    ] {
        refused(
            &format!("{THROWN}[complete_integral]\n{section}\n"),
            1,
            &[code],
        );
    }
}
