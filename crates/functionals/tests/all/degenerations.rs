//! What a functional becomes for special values is that functional exactly (T4 §3): not another one that has the same Euler equations.

use crate::table::{row_text, studied_text};

fn verdict(row: &str, claim: &str, replaced: &[(&str, &str)]) -> (String, String, Vec<String>) {
    let mut text = row_text(row);
    for (from, to) in replaced {
        assert!(text.contains(from), "{row} has no `{from}`");
        text = text.replace(from, to);
    }
    let study = studied_text(row, &text, &[("d", "2")]);
    let mut all = study.verdicts.iter();
    let found = all.find(|d| d.full_id() == claim).unwrap();
    let captions = found.finding.formulas.iter().map(|f| f.caption.clone());
    let verdict = &found.finding.verdict;
    (
        verdict.word().to_owned(),
        verdict.detail().to_owned(),
        captions.collect(),
    )
}

/// A row, its degeneration, and what is replaced in its text.
type Case<'a> = (&'a str, &'a str, &'a [(&'a str, &'a str)]);

#[test]
fn another_factor_does_not_become_the_row() {
    let cases: &[Case<'_>] = &[
        // β = 2 gives A + (A + B − e s) − e s + …, whose difference vanishes with the law of the material.
        (
            "p3pb",
            "beta=1",
            &[("at = { beta = \"1\" }", "at = { beta = \"2\" }")],
        ),
        (
            "p3pb",
            "beta=0",
            &[("at = { beta = \"0\" }", "at = { beta = \"1/2\" }")],
        ),
        (
            "p2pb",
            "beta=1",
            &[("at = { beta = \"1\" }", "at = { beta = \"0\" }")],
        ),
        (
            "p3cb",
            "beta=0",
            &[("at = { beta = \"0\" }", "at = { beta = \"3\" }")],
        ),
        (
            "p2cb",
            "beta=0",
            &[("at = { beta = \"0\" }", "at = { beta = \"-1\" }")],
        ),
        // Twice the work of the traction on S_u differs by a natural condition.
        (
            "p3pb",
            "beta=1",
            &[("S_u = \"-P_k (u_k", "S_u = \"-2 P_k (u_k")],
        ),
        // A conjugate with the wrong factor.
        (
            "p3p",
            "scalar-factor",
            &[("(1 - beta) B(X_ij/(1 - beta))", "B(X_ij/(1 - beta))")],
        ),
        ("p4p", "scalar-factor", &[("\"beta A(X)\"", "\"A(X)\"")]),
    ];
    for (row, name, replaced) in cases {
        let id = format!("functional.degeneration#{name}");
        let (word, detail, captions) = verdict(row, &id, replaced);
        assert_eq!(word, "refuted", "{row} {replaced:?}: {detail}");
        let is_shown = captions.iter().any(|c| c.starts_with("the difference "));
        assert!(is_shown, "{captions:?}");
    }
}

#[test]
fn the_rows_become_each_other_without_field_equations() {
    for (row, name) in [
        ("p4p", "scalar-factor"),
        ("p4c", "scalar-factor"),
        ("p3p", "scalar-factor"),
        ("p3c", "scalar-factor"),
        ("p2p", "scalar-factor"),
        ("p2c", "scalar-factor"),
        ("p3pb", "beta=1"),
        ("p2pb", "beta=1"),
        ("p2pb", "beta=0"),
    ] {
        let id = format!("functional.degeneration#{name}");
        let (word, detail, _) = verdict(row, &id, &[]);
        assert_eq!(word, "proved", "{row}: {detail}");
        assert!(
            detail.ends_with("b") || detail.ends_with("1") || detail.ends_with("0"),
            "{detail}"
        );
    }
}

#[test]
fn a_level_with_another_boundary_does_not_follow_from_the_one_above() {
    for (row, from, to) in [
        ("p2pb", "-Pm_k (u_k - ubar_k)", "-2 Pm_k (u_k - ubar_k)"),
        (
            "p2p1",
            "-P_k (u_k - ubar_k)",
            "-P_k (u_k - ubar_k) + (u_k - ubar_k) Ptest_k",
        ),
        (
            "p1p",
            "S_s = \"-Pbar_k u_k\"",
            "S_s = \"-2 Pbar_k u_k + P_k u_k\"",
        ),
        ("p1p", "A(D) - F_k", "A(D) + s_ik,i u_k + F_k u_k - F_k"),
    ] {
        let mut replaced = vec![(from, to)];
        if to.contains("Ptest") {
            replaced.push(("[boundary]", "Ptest_k = \"Pbar_k\"\n[boundary]"));
            replaced.push(("Ptest_k = \"Pbar_k\"", "Ptest_k = \"n_i s_ik\""));
        }
        let id = format!("functional.descent#{row}");
        let (word, detail, _) = verdict(row, &id, &replaced);
        assert_eq!(word, "refuted", "{row} with `{to}`: {detail}");
    }
    // The traction of the mixed stress differs from that of s by a product of two equations.
    let (word, detail, _) = verdict("p2pb", "functional.descent#p2pb", &[]);
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("on S_u modulo (3), of second order with (3) and (5)"),
        "{detail}"
    );
}

#[test]
fn every_row_becomes_that_of_the_linear_theory() {
    let id = "functional.degeneration#small-displacements";
    for row in crate::table::ROWS {
        let (word, detail, _) = verdict(row, id, &[]);
        assert_eq!(word, "proved", "{row}: {detail}");
        assert!(detail.contains("with nonlinear = 0"), "{row}: {detail}");
    }
    // Half of the displacements do not vanish with their products, and with them nothing of it does.
    let wrong = [
        (
            "p4p",
            "at = { nonlinear = \"0\" }",
            "at = { nonlinear = \"1\" }",
        ),
        ("p1c", "L_k u_k\"", "L_k u_k + u_k,i u_k,j s_ij\""),
        (
            "p2pb",
            "S_s = \"-Pbar_k u_k\"",
            "S_s = \"-Pbar_k u_k + nonlinear P_k u_k + P_k u_k\"",
        ),
    ];
    for (row, from, to) in wrong {
        let (word, detail, captions) = verdict(row, id, &[(from, to)]);
        assert_eq!(word, "refuted", "{row}: {detail}");
        let is_shown = captions.iter().any(|c| c.starts_with("the difference "));
        assert!(is_shown, "{captions:?}");
    }
}

#[test]
fn what_is_given_belongs_to_the_functional() {
    let id = "functional.degeneration#small-displacements";
    let free = [
        ("S_u = { fixed = [\"u\"] }", "S_u = \"0\""),
        ("\"4\", \"5\"]", "\"4\"]"),
    ];
    let (word, detail, _) = verdict("pp", id, &free);
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("(5) is imposed in pp-small"), "{detail}");
}

#[test]
fn a_size_keeps_the_number_of_dimensions() {
    let text = row_text("p4p").replace("{ nonlinear = \"0\" }", "{ d = \"3\" }");
    let told = crate::table::read_text("p4p", &text, &[("d", "2")]);
    assert!(told.problem.is_none());
    let said = told.diagnostics.render(chetaev_model::Style::Plain);
    assert!(said.contains("other-domain"), "{said}");
}
