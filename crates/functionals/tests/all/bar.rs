//! The closed solution of the bar (T4 §5, E1; reference case S-F13) in every row of the table.

use crate::table::{decided, row_text, studied, studied_text, ROWS};

const LINEAR: &[(&str, &str)] = &[("d", "1"), ("nonlinear", "0")];

fn verdict(study: &chetaev_functionals::Study) -> (String, String) {
    let verdict = decided(study, "functional.solution");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

#[test]
fn the_bar_makes_every_row_stationary_and_gives_the_stated_value() {
    for row in ROWS {
        let (word, detail) = verdict(&studied(row, LINEAR));
        assert_eq!(word, "proved", "{row}: {detail}");
        let is_p = !row.contains('c');
        assert_eq!(detail.contains("the value is -("), is_p, "{row}: {detail}");
        // With everything imposed there is little left to vary.
        match *row {
            "pp" => assert!(
                detail.contains("(1 of 4 coefficients is free: δu_1 = c x_1)"),
                "{detail}"
            ),
            "pc" => assert!(detail.contains("which does not vary s_11"), "{detail}"),
            _ => {}
        }
    }
}

#[test]
fn a_bar_that_is_none_is_refuted() {
    let mutants = [
        ("p3pb", "beta A(e) - beta", "beta A(e) + beta"),
        ("p4pb", "- F_k u_k", "+ F_k u_k"),
        ("p1p", "(u_k - ubar_k)", "u_k"),
        ("pp", "A(D)", "2 A(D)"),
    ];
    for (row, from, to) in mutants {
        let text = row_text(row);
        assert!(text.contains(from), "{row}");
        let (word, detail) = verdict(&studied_text(row, &text.replace(from, to), LINEAR));
        assert_eq!(word, "refuted", "{row}: {detail}");
    }
    // Another value is none.
    let text = row_text("p3p1") + "\n[solutions.bar]\nvalue = \"-pull^2 l/(2 E)\"\n";
    assert_eq!(verdict(&studied_text("p3p1", &text, LINEAR)).0, "refuted");
}
