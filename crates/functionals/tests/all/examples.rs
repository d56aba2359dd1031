//! The acceptance examples of T4 §5; E2 is in `projector`.

use crate::table::{decided, loaded_text, read_text, row_text, studied_text, ROWS};
use chetaev_functionals::notation::parse;
use chetaev_functionals::variation::variation;
use chetaev_functionals::Problem;
use std::collections::BTreeMap;

/// Whether the Euler expression of a component is the given one.
fn is_euler(problem: &Problem, component: &str, wanted: &str) -> bool {
    let f = &problem.functional;
    let found = variation(f).unwrap();
    let at = f.space.component_named(component).unwrap();
    let (_, own) = found.euler.iter().find(|(c, _)| *c == at).unwrap();
    let node = parse(wanted, &f.scope, &mut Vec::new()).unwrap();
    let wanted = f.scope.value(&node, &BTreeMap::new());
    let own = f.space.explicit(*own);
    f.space
        .vanish(&[f.space.graph.sub(own, f.space.explicit(wanted))])
}

/// A row with a density of its own.
fn bar(row: &str, energy: &str) -> Problem {
    let text = row_text(row).replace("energy-abstract", energy);
    loaded_text(row, &text, &[("d", "1")])
}

#[test]
fn e1_the_equations_of_the_bar() {
    let own = bar("p3pb", "energy-abstract");
    assert!(is_euler(&own, "e_11", "beta (A'_11(e) - s_11)"));
    assert!(is_euler(
        &own,
        "s_11",
        "-beta e_11 - (1 - beta) B'_11(s) + u_1,1 + u_1,1^2/2"
    ));
    assert!(is_euler(&own, "u_1", "-(s_11 (1 + u_1,1)),1 - F_1"));
    assert!(!is_euler(&own, "u_1", "-(s_11 (1 - u_1,1)),1 - F_1"));
    let own = bar("p4pb", "energy-abstract");
    assert!(is_euler(&own, "e_11", "beta A'_11(e) + sstar_11 - s_11"));
    assert!(is_euler(
        &own,
        "sstar_11",
        "e_11 - B'_11(X)"
            .replace("(X)", "(sstar_ij/(1 - beta))")
            .as_str()
    ));
}

#[test]
fn e3_an_energy_that_is_not_quadratic() {
    for row in ROWS
        .iter()
        .filter(|row| row_text(row).contains("energy-abstract"))
    {
        let text = row_text(row).replace("energy-abstract", "energy-cosh");
        let problem = read_text(row, &text, &[("d", "1")]).problem;
        assert!(problem.is_some(), "{row}");
    }
    // Sums over all components are conjugates too: asinh undoes sinh wherever a stress is that of a strain.
    let text = row_text("p3p1").replace("energy-abstract", "energy-cosh");
    let study = studied_text("p3p1", &text, &[("d", "2")]);
    let conjugate = study
        .verdicts
        .iter()
        .filter(|d| d.claim == "functional.legendre");
    assert!(conjugate.clone().count() == 2);
    for own in conjugate {
        assert_eq!(
            own.finding.verdict.word(),
            "proved",
            "{}",
            own.finding.verdict.detail()
        );
    }
    let own = bar("p3p1", "energy-cosh");
    assert!(is_euler(&own, "e_11", "sinh(e_11) - s_11"));
    let own = bar("p3p0", "energy-cosh");
    assert!(is_euler(&own, "s_11", "u_1,1 + u_1,1^2/2 - asinh(s_11)"));
}

#[test]
fn e4_equilibrium_in_the_plane_with_large_displacements() {
    let own = loaded_text("p3p1", &row_text("p3p1"), &[("d", "2")]);
    for k in [1, 2] {
        let wanted = format!("-(s_ij (delta_{k}j + u_{k},j)),i - F_{k}");
        assert!(is_euler(&own, &format!("u_{k}"), &wanted), "{wanted}");
    }
}

#[test]
fn what_is_left_free_is_what_no_equation_speaks_of() {
    let text = |density: &str, field: &str, stated: &str| {
        format!(
            r#"
kind = "functional"
name = "algebraic"
density = "{density}"
yields = ["a"]
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[data]
f = "scalar"
[fields]
{field}
[boundary]
S = "0"
[equations]
a = "{stated}"
"#
        )
    };
    for (density, field, stated, free) in [
        ("1/2 w^2 - f w", "w = \"scalar\"", "w = f", None),
        (
            "1/2 s_ii s_jj - s_ii f",
            "s = \"symmetric\"",
            "s_ii = f",
            Some("2 of its 3"),
        ),
        (
            "1/2 s_ij s_ij - s_ii f",
            "s = \"symmetric\"",
            "s_ij = f delta_ij",
            None,
        ),
    ] {
        let study = studied_text("p4p", &text(density, field, stated), &[]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), "proved", "{density}: {}", verdict.detail());
        match free {
            Some(count) => assert!(verdict.detail().contains(count), "{}", verdict.detail()),
            None => assert!(
                !verdict.detail().contains("left free"),
                "{}",
                verdict.detail()
            ),
        }
    }
}

#[test]
fn what_is_divided_by_is_said() {
    let text = |value: &str| {
        format!(
            r#"
kind = "functional"
name = "string"
density = "k/2 u,x^2 - k f u"
yields = ["a"]
[domain]
coordinates = ["x"]
intervals = {{ x = [0, 1] }}
[fields]
u = "scalar"
[data]
f = "scalar"
[parameters]
k = {value}
[boundary]
"x = 0" = {{ fixed = ["u"] }}
"x = 1" = {{ fixed = ["u"] }}
[equations]
a = "u,xx + f = 0"
"#
        )
    };
    for (value, said) in [("{}", true), ("\"3\"", false)] {
        let study = studied_text("p4p", &text(value), &[]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
        assert_eq!(
            verdict.detail().contains("k ≠ 0"),
            said,
            "{}",
            verdict.detail()
        );
    }
    let study = studied_text("p4p", &text("\"0\""), &[]);
    assert_eq!(decided(&study, "functional.euler").word(), "refuted");
}
