//! Functionals with one mistake are refuted, and mistakes in the text are shown at their place with what to do.

use crate::table::{decided, loaded_text, read_text, row_text, studied_text, ROWS};
use chetaev_functionals::study;
use chetaev_model::Style;

/// The verdict on a row after a replacement in its text; tractions have values on the whole boundary.
fn mutated(row: &str, claim: &str, from: &str, to: &str) -> (String, String) {
    let text = row_text(row);
    assert!(text.contains(from), "{row} has no `{from}`");
    let mut text = text.replace(from, to);
    if to.contains("-Pbar_k (") {
        text.push_str("\n[data]\nPbar = \"vector\"\n");
    }
    let study = studied_text(row, &text, &[("d", "2")]);
    let verdict = decided(&study, claim);
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

#[test]
fn a_mistake_in_a_functional_is_refuted() {
    let mutants = [
        // A wrong sign.
        ("p3p1", "functional.euler", "A(e) - (e_ij", "A(e) + (e_ij"),
        (
            "p1p",
            "functional.euler",
            "A(D) - F_k u_k",
            "A(D) + F_k u_k",
        ),
        // The factor 1 - beta is missing.
        ("p3pb", "functional.euler", "(1 - beta) B(s)", "B(s)"),
        ("p2pb", "functional.euler", "- (1 - beta) B(s)", "- B(s)"),
        ("p3pb", "functional.duality", "(1 - beta) B(s)", "B(s)"),
        // P-bar in the place of P on S_u.
        (
            "p3pb",
            "functional.euler",
            "-P_k (u_k - ubar_k)",
            "-Pbar_k (u_k - ubar_k)",
        ),
        (
            "p3p1",
            "functional.euler",
            "-P_k (u_k - ubar_k)",
            "-Pbar_k (u_k - ubar_k)",
        ),
    ];
    for (row, claim, from, to) in mutants {
        let (word, detail) = mutated(row, claim, from, to);
        assert_eq!(word, "refuted", "{row} with `{to}`: {detail}");
    }
}

/// All rows with what stands on their pieces of the boundary replaced, where it occurs.
fn on_every_row(from: &str, to: &str) -> usize {
    let rows = ROWS.iter().filter(|row| row_text(row).contains(from));
    let mut count = 0;
    for row in rows {
        let (word, detail) = mutated(row, "functional.euler", from, to);
        assert_eq!(word, "refuted", "{row} with `{to}`: {detail}");
        count += 1;
    }
    count
}

#[test]
fn a_displacement_or_a_traction_that_is_missing_on_the_boundary_is_refuted_in_every_row() {
    // The displacement given on S_u is missing.
    assert_eq!(on_every_row("(u_k - ubar_k)\"", "u_k\""), 12);
    assert_eq!(on_every_row("S_u = \"-ubar_k", "S_u = \"-0 ubar_k"), 13);
    // The traction given in the place of the traction.
    let tractions = ["-P_k (u_k", "-Pm_k (u_k", "-Pb_k (u_k"];
    let counts = tractions.map(|own| on_every_row(own, "-Pbar_k (u_k"));
    assert_eq!(counts.iter().sum::<usize>(), 12);
    // The traction given on S_s is missing.
    assert_eq!(on_every_row("S_s = \"-Pbar_k u_k\"", "S_s = \"0\""), 13);
    assert_eq!(on_every_row("(P_k - Pbar_k)", "P_k"), 12);
}

#[test]
fn a_displacement_that_vanishes_on_a_curved_piece_is_proved() {
    for (row, from, to) in [
        ("p3p1", "(u_k - ubar_k)", "u_k"),
        ("p1p", "(u_k - ubar_k)", "u_k"),
    ] {
        let text = row_text(row)
            .replace(from, to)
            .replace("\"5\"", "\"clamped\"")
            + "\n[equations.clamped]\nequation = \"u_k = 0\"\non = \"S_u\"\n";
        let study = studied_text(row, &text, &[("d", "2")]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), "proved", "{row}: {}", verdict.detail());
    }
}

#[test]
fn on_level_two_the_traction_of_the_stress_alone_needs_the_law_of_the_material() {
    let (word, detail) = mutated(
        "p2pb",
        "functional.euler",
        "-Pm_k (u_k - ubar_k)",
        "-P_k (u_k - ubar_k)",
    );
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("on S_u and S_s with the trace of (3)"),
        "{detail}"
    );
    // With the mixed stress nothing is needed on S_u.
    let (word, detail) = mutated("p2pb", "functional.euler", "density", "density");
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("on S_s with the trace of (3)"), "{detail}");
    // The functionals then cancel identically; with the mixed stress they do so modulo (3) only.
    let (word, detail) = mutated(
        "p2pb",
        "functional.duality",
        "-Pm_k (u_k - ubar_k)",
        "-P_k (u_k - ubar_k)",
    );
    assert_eq!(word, "proved");
    assert!(detail.contains("identically"), "{detail}");
    let (word, detail) = mutated("p2pb", "functional.duality", "density", "density");
    assert_eq!(word, "proved");
    assert!(detail.contains("on S_u modulo (3)"), "{detail}");
}

/// What is said of a text with a mistake.
fn said(row: &str, from: &str, to: &str) -> String {
    let text = row_text(row);
    assert!(text.contains(from), "{row} has no `{from}`");
    let loaded = read_text(row, &text.replacen(from, to, 1), &[]);
    assert!(loaded.problem.is_none(), "`{to}` is accepted");
    loaded.diagnostics.render(Style::Plain)
}

#[test]
fn mistakes_in_a_text_are_shown_with_what_to_do() {
    let mistakes = [
        (
            "D_ij s_ij - F_k",
            "D_ij s_ij s_ij - F_k",
            "index-thrice",
            "the index `i` is used 3 times in one product",
        ),
        (
            "(sstar_ij - s_ij) e_ij",
            "(sstar_ij - s_ik) e_ij",
            "index-mismatch",
            "did you mean `j` in place of `k`?",
        ),
        (
            "F_k u_k\"",
            "F_k u_kk\"",
            "wrong-rank",
            "`u` has one index, not 2",
        ),
        (
            "D_ij s_ij - F_k",
            "D_ij sigma_ij - F_k",
            "unknown-name",
            "`sigma` is not declared",
        ),
        (
            "S_s = \"-Pbar_k u_k\"",
            "",
            "missing-piece",
            "nothing is said of the piece `S_s` of the boundary",
        ),
        (
            "S_s = ",
            "S_t = ",
            "unknown-piece",
            "`S_t` is not a piece of the boundary",
        ),
        (
            "D_ij s_ij - F_k",
            "D_ij s_ij + n_k u_k - F_k",
            "normal-inside",
            "a meaning on the boundary only",
        ),
        (
            "D_ij s_ij - F_k",
            "D_ij s_ij/0 - F_k",
            "division-by-zero",
            "division by zero",
        ),
        (
            "D_ij s_ij - F_k",
            "u_a u_a u_b u_b u_c u_c u_f u_f u_g u_g u_h u_h u_i u_i u_j u_j u_l u_l u_m u_m u_o u_o u_p u_p u_q u_q u_r u_r u_v u_v u_w u_w u_s u_s - F_k",
            "too-many-terms",
            "the sum over 17 indices",
        ),
        (
            "[boundary]\n",
            "[define]\nG_ij = \"H_ij\"\nH_ij = \"2 G_ij\"\n[boundary]\n",
            "recursive-definition",
            "is defined by itself, or by definitions that use it",
        ),
        (
            "-P_k (u_k - ubar_k)",
            "-Pbar_k (u_k - ubar_k)",
            "lives-elsewhere",
            "`Pbar` lives on S_s only, and has no values on S_u",
        ),
        (
            "D_ij s_ij - F_k",
            "D_i4 s_i4 - F_k",
            "index-out-of-range",
            "the space has 2 dimensions",
        ),
        (
            "imposed",
            "imposd",
            "unknown-key",
            "did you mean `imposed`?",
        ),
        (
            "D_ij s_ij - F_k u_k",
            "D_ij s_ij + u_k,t u_k,t/2 - F_k u_k",
            "bad-index",
            "[domain] time = \"t\" declares it",
        ),
        (
            "D_ij s_ij - F_k u_k",
            "D_ij s_ij + u_k,yy u_k - F_k u_k",
            "bad-index",
            "`y` reads as a coordinate",
        ),
        (
            "Bstar(sstar)",
            "Bstar(t)",
            "not-symmetric",
            "is not symmetric",
        ),
    ];
    for (from, to, code, words) in mistakes {
        let row = if from == "imposed" { "p3p" } else { "p4p" };
        let said = said(row, from, to);
        assert!(
            said.contains(code) && said.contains(words),
            "`{to}`:\n{said}"
        );
        assert!(said.contains(".toml:"), "no place:\n{said}");
    }
}

#[test]
fn overrides_that_mean_nothing_are_refused() {
    for (name, value, words) in [
        ("d", "4", "must be 1, 2 or 3"),
        ("d", "x", "must be a whole number"),
        ("dimension", "2", "neither a parameter nor a size"),
    ] {
        let loaded = read_text("p4p", &row_text("p4p"), &[(name, value)]);
        assert!(loaded.problem.is_none());
        let said = loaded.diagnostics.render(Style::Plain);
        assert!(said.contains(words), "{said}");
    }
}

/// ∫ l_i (u,i − g_i) with g = (w,1 + h,1², w,2): that g is a gradient follows by differentiation and elimination only.
fn gradient(stated: &str) -> (String, String) {
    let text = format!(
        r#"
kind = "functional"
name = "gradient"
density = "l_i (u,i - g_i)"
yields = ["gradient", "stated", "divergence"]
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
l = "vector"
u = "scalar"
[data]
w = "scalar"
h = "scalar"
[define]
g_i = "delta_i1 (w,1 + h,1^2) + delta_i2 w,2"
[boundary]
S = {{ fixed = ["u"] }}
[equations]
gradient = "u,i = g_i"
stated = "{stated}"
divergence = "l_i,i = 0"
"#
    );
    let study = studied_text("p4p", &text, &[]);
    let verdict = decided(&study, "functional.euler");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

#[test]
fn what_follows_by_differentiation_and_elimination_is_not_refuted() {
    let (word, detail) = gradient("h,1 h,12 = 0");
    assert_ne!(word, "refuted", "{detail}");
    let (word, detail) = gradient("h,2 h,12 = 0");
    assert_ne!(word, "proved", "{detail}");
}

/// `q(x)` is the load at x for who writes it, and would be read as q times x.
#[test]
fn what_depends_on_the_place_is_written_without_it() {
    let text = |load: &str| {
        format!(
            "kind = \"functional\"\nname = \"string\"\ndensity = \"1/2 u,x^2 - {load} u\"\n[domain]\ncoordinates = [\"x\"]\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[data]\nq = \"scalar\"\n[boundary]\n\"x = 0\" = \"0\"\n\
             \"x = 1\" = \"0\"\n"
        )
    };
    let loaded = read_text("p4p", &text("q(x)"), &[]);
    assert!(loaded.problem.is_none());
    let said = loaded.diagnostics.render(Style::Plain);
    assert!(said.contains("`q(x)` would be a product"), "{said}");
    assert!(said.contains("write q, or q * (x)"), "{said}");
    for load in ["q", "q * (x)", "q (1 + x)", "q x"] {
        assert!(
            read_text("p4p", &text(load), &[]).problem.is_some(),
            "{load}"
        );
    }
}

#[test]
fn a_gradient_is_that_of_the_value_and_of_some_function() {
    let text = |function: &str| {
        format!(
            "kind = \"functional\"\nname = \"g\"\ndensity = \"W(u) + 1/2 u_i,j u_i,j\"\n[sizes]\nd = 2\n[domain]\n\
             coordinates = \"x_i\"\nboundary = [\"S\"]\n[fields]\nu = \"vector\"\n[functions]\nW = {{ of = \"vector\", {function} }}\n\
             [boundary]\nS = \"0\"\n"
        )
    };
    let refused = [
        (
            "value = \"X_i X_i\", gradient = \"3 X_i\"",
            "not the gradient of the value",
        ),
        (
            "gradient = \"epsilon_ij X_j\"",
            "the gradient of no function",
        ),
    ];
    for (function, words) in refused {
        let loaded = read_text("p4p", &text(function), &[]);
        assert!(loaded.problem.is_none(), "{function} is accepted");
        let said = loaded.diagnostics.render(Style::Plain);
        assert!(
            said.contains("bad-gradient") && said.contains(words),
            "{said}"
        );
    }
    for function in [
        "value = \"X_i X_i\", gradient = \"2 X_i\"",
        "gradient = \"X_k X_k X_i\"",
    ] {
        assert!(
            read_text("p4p", &text(function), &[]).problem.is_some(),
            "{function}"
        );
    }
}

/// The load of a plate bends it near one place alone, so that a wrong condition on a free edge is refuted whatever holds at the corners.
#[test]
fn wrong_conditions_of_a_free_plate_are_refuted() {
    let path = format!(
        "{}/../../gallery/fields/plate/model.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).unwrap();
    let right = "shear-right = { equation = \"w,xxx + (2 - nu) w,xyy = 0\"";
    let wrong = [
        "shear-right = { equation = \"w,xxx + w,xyy = 0\"",
        "shear-right = { equation = \"w,xxx + (2 + nu) w,xyy = 0\"",
    ];
    for wrong in wrong {
        assert!(text.contains(right));
        let study = studied_text("p4p", &text.replace(right, wrong), &[]);
        let verdict = crate::table::decided(&study, "functional.euler");
        assert_eq!(verdict.word(), "refuted", "{wrong}: {}", verdict.detail());
    }
}

/// What restricts the variations without a multiplier leaves a refutation by fields and by an admitted variation.
#[test]
fn a_mistake_where_equilibrium_is_imposed_is_refuted() {
    let mut open = Vec::new();
    for (row, from, to) in [
        ("p0p", "A(D) - F_k u_k", "A(D) + F_k u_k"),
        ("pp", "A(D) - F_k u_k", "A(D) + F_k u_k"),
        ("p0p", "A(D) - F_k u_k", "A(D) - 2 F_k u_k"),
        ("pp", "A(D) - F_k u_k", "A(D) - 2 F_k u_k"),
        ("p0p", "S_s = \"-Pbar_k u_k\"", "S_s = \"-P_k u_k\""),
        ("pp", "S_s = \"-Pbar_k u_k\"", "S_s = \"-P_k u_k\""),
    ] {
        let text = row_text(row);
        assert!(text.contains(from), "{row} has no `{from}`");
        for d in ["1", "2", "3"] {
            for nonlinear in ["0", "1"] {
                let set = [("d", d), ("nonlinear", nonlinear)];
                let problem = loaded_text(row, &text.replace(from, to), &set);
                let study = study(problem, &|id| id == "functional.euler", &|| 0.0);
                let own = decided(&study, "functional.euler");
                if own.word() != "refuted" {
                    let detail = own.detail();
                    open.push(format!("{row} with `{to}`, {set:?}: {detail}"));
                }
            }
        }
    }
    assert!(open.is_empty(), "{}", open.join("\n"));
}
