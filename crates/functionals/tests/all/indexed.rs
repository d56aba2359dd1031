//! Euler equations and natural conditions in index notation: what T4 §4 and §5 state, and agreement with the components.

use crate::table::{decided, loaded_text, row_text, studied_text, ROWS};
use chetaev_functionals::notation::equations::{euler, natural, Indexed};
use chetaev_functionals::notation::written;
use chetaev_functionals::variation::variation;
use chetaev_symbolic::print::Format;

fn equations(row: &str, set: &[(&str, &str)]) -> Vec<String> {
    let functional = loaded_text(row, &row_text(row), set).functional;
    let variation = variation(&functional).unwrap();
    let inside = euler(&functional, &variation).into_iter().flatten();
    let on = functional.pieces.iter().flat_map(|piece| {
        let own = natural(&functional, piece).unwrap_or_default().into_iter();
        own.map(|one| (piece.name.clone(), one))
    });
    let text =
        |node: &chetaev_functionals::notation::Node| written(node, &functional.scope, Format::Text);
    inside
        .map(|own| format!("{}: {}", own.of, text(&own.value)))
        .chain(on.map(|(piece, own)| format!("{piece} {}: {}", own.of, text(&own.value))))
        .collect()
}

#[test]
fn the_equations_of_hu_and_washizu_read_as_in_the_literature() {
    let own = equations("p3p1", &[("d", "3"), ("nonlinear", "0")]);
    let wanted = [
        "s_ij: D_ij - e_ij",
        "e_ij: A'_ij(e) - s_ij",
        "u_k: -F_k - s_ik,i",
        "S_u P_k: ubar_k - u_k",
        "S_s u_k: n_i s_ik - Pbar_k",
    ];
    for line in wanted {
        assert!(
            own.iter().any(|o| same(o, line)),
            "{line} is not among {own:#?}"
        );
    }
}

#[test]
fn geometry_enters_equilibrium_and_traction() {
    // E4 of the theory.
    let own = equations("p3p1", &[("d", "2")]);
    let line = "u_k: -F_k - (s_ik + s_ij u_k,j),i";
    assert!(own.iter().any(|o| same(o, line)), "{own:#?}");
    let line = "S_s u_k: n_i s_ik + n_i s_ij u_k,j - Pbar_k";
    assert!(own.iter().any(|o| same(o, line)), "{own:#?}");
}

/// The same up to the order of terms and the name of summed letters.
fn same(a: &str, b: &str) -> bool {
    let key = |text: &str| {
        let mut own: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
        own.sort_unstable();
        own
    };
    a.split(':').next() == b.split(':').next() && key(a) == key(b)
}

#[test]
fn every_row_has_its_equations_in_index_notation() {
    for row in ROWS {
        let functional = loaded_text(row, &row_text(row), &[("d", "2")]).functional;
        let variation = variation(&functional).unwrap();
        let all = euler(&functional, &variation);
        assert!(all.iter().all(Option::is_some), "{row}: {all:?}");
        for piece in &functional.pieces {
            let own = natural(&functional, piece);
            assert!(own.is_some(), "{row} on {}", piece.name);
        }
    }
}

#[test]
fn where_the_stress_is_the_gradient_of_the_energy_it_is_varied_as_a_whole() {
    // T4 §4: equilibrium from P1c; what P0c and Pc impose leaves nothing of the displacement in the interior.
    let cases = [("p1c", "u_k: L_k"), ("p0c", "u_k: 0"), ("pc", "u_k: 0")];
    for (row, line) in cases {
        for d in ["2", "3"] {
            let own = equations(row, &[("d", d)]);
            let is_there = own.iter().any(|o| same(o, line));
            assert!(is_there, "{row}: {line} is not among {own:#?}");
        }
    }
}

// T4 §5: on S_u, P1c and P0c yield (5), where the moduli let δP_k be free there; on S_s, P1c yields (6), and P0c (8) and (6).
#[test]
fn conditions_of_rows_whose_stress_is_a_gradient_are_those_of_the_theory() {
    let cases: [(&str, &[&str]); 3] = [
        ("p1c", &["S_u P_k: u_k - ubar_k", "S_s u_k: Pbar_k - P_k"]),
        (
            "p0c",
            &[
                "S_u P_k: u_k - ubar_k",
                "S_s P_k: u_k - ub_k",
                "S_s ub_k: Pbar_k - P_k",
            ],
        ),
        ("pc", &["S_u P_k: u_k - ubar_k"]),
    ];
    for (row, wanted) in cases {
        for d in ["1", "2", "3"] {
            let own = equations(row, &[("d", d)]);
            let on: Vec<&String> = own.iter().filter(|one| one.starts_with("S_")).collect();
            assert_eq!(on, wanted.iter().collect::<Vec<_>>(), "{row} at d = {d}");
        }
    }
}

// Pc at its solution: the strain B' is that of the displacement (2), the symmetric part of the gradient with half the square.
#[test]
fn a_coefficient_of_a_symmetric_field_is_its_symmetric_part_without_repeating_terms() {
    let own = equations("pc", &[("d", "2")]);
    let line = "s_ij: B'_ij(s) - 1/2 u_k,i u_k,j - 1/2 u_j,i - 1/2 u_i,j";
    assert!(own.iter().any(|o| same(o, line)), "{own:#?}");
}

/// The conditions on S_u of a density there in which a definition is varied as a whole.
fn on_held(d: &str, definition: &str, density: &str) -> Option<Vec<String>> {
    let text = format!(
        "kind = \"functional\"\nname = \"held\"\ndensity = \"s_ij s_ij/2 + p u_i,i\"\n[sizes]\nd = {d}\n[domain]\ncoordinates = \"x_i\"\n\
         boundary = [\"S\"]\n[fields]\np = \"scalar\"\nu = \"vector\"\ns = \"symmetric\"\n[data]\ng = \"vector\"\nh = \"symmetric\"\nf = \"scalar\"\n[define]\n\
         {definition}\n[boundary]\nS = \"{density}\"\n"
    );
    let functional = loaded_text("p4p", &text, &[]).functional;
    let own = natural(&functional, &functional.pieces[0])?;
    let line = |one: &Indexed| {
        let value = written(&one.value, &functional.scope, Format::Text);
        let only = if one.is_in_general { " in general" } else { "" };
        format!("{}: {value}{only}", one.of)
    };
    Some(own.iter().map(line).collect())
}

// δP_k = n_k δp has one free number, and n_i δs_ik has all, but not beside another coefficient of δs_ij.
#[test]
fn a_coefficient_vanishes_only_where_its_variation_is_free() {
    for d in ["2", "3"] {
        let stress = "P_k = \"n_i s_ik\"";
        let own = on_held(d, stress, "-P_k (u_k - g_k) - p n_k u_k").unwrap();
        assert!(own.contains(&"P_k: g_k - u_k".to_owned()), "{own:?}");
        assert_eq!(on_held(d, "P_k = \"p n_k\"", "-P_k (u_k - g_k)"), None);
        let beside = "-P_k (u_k - g_k) - p n_k u_k + h_ij s_ij";
        assert_eq!(on_held(d, stress, beside), None);
        // Where f vanishes nothing is said.
        let own = on_held(d, "P_k = \"f n_i s_ik\"", "-P_k (u_k - g_k) - p n_k u_k").unwrap();
        let line = "P_k: g_k - u_k in general".to_owned();
        assert!(own.contains(&line), "{own:?}");
    }
}

// In one dimension all components agree, also where a free letter is one of those that are summed over.
#[test]
fn letters_of_a_density_are_none_of_the_free_ones() {
    let text = "kind = \"functional\"\nname = \"letters\"\ndensity = \"s_ii s_jj s_kk\"\n[sizes]\nd = 1\n[domain]\ncoordinates = \"x_i\"\n\
                boundary = [\"S\"]\n[fields]\ns = \"symmetric\"\n[boundary]\nS = \"0\"\n";
    let functional = loaded_text("p4p", text, &[]).functional;
    let variation = variation(&functional).unwrap();
    let own = euler(&functional, &variation).into_iter().flatten();
    let lines: Vec<String> = own
        .map(|own| written(&own.value, &functional.scope, Format::Text))
        .collect();
    assert_eq!(lines, ["3 delta_ij s_kk s_ll"]);
}

/// Of ½ w,1j w,1j with j = 1, 2 the Euler equation is w,1111 + w,1122 = 0: a digit and a letter stand side by side as two letters do.
#[test]
fn a_digit_and_a_letter_are_two_indices_of_a_derivative() {
    let model = |density: &str, equation: &str| {
        format!(
            "kind = \"functional\"\nname = \"m\"\ndensity = \"{density}\"\nyields = [\"e\"]\n[sizes]\nd = 2\n[domain]\ncoordinates = \"x_i\"\n\
             boundary = [\"S\"]\n[fields]\nw = \"scalar\"\n[boundary]\nS = {{ fixed = [\"w\", \"w,n\"] }}\n[equations]\ne = \"{equation}\"\n"
        )
    };
    for density in ["1/2 w,1j w,1j", "1/2 w,j1 w,1j", "1/2 (w,j),1 (w,1),j"] {
        let study = studied_text("p4p", &model(density, "w,1111 + w,11j2 delta_j2 = 0"), &[]);
        let verdict = decided(&study, "functional.euler");
        assert_eq!(verdict.word(), "proved", "{density}: {}", verdict.detail());
    }
    let study = studied_text("p4p", &model("1/2 w,1j w,1j", "w,iijj = 0"), &[]);
    assert_ne!(decided(&study, "functional.euler").word(), "proved");
}

/// `w,n` is a derivative by a letter, not the one along the normal.
#[test]
fn a_derivative_along_the_normal_is_written_with_the_normal() {
    let text = "kind = \"functional\"\nname = \"m\"\ndensity = \"w,i w,i\"\n[sizes]\nd = 2\n[domain]\ncoordinates = \"x_i\"\nboundary = [\"S\"]\n\
        [fields]\nw = \"scalar\"\n[boundary]\nS = \"w,n\"\n";
    let loaded = crate::table::read_text("p4p", text, &[]);
    let said = loaded.diagnostics.render(chetaev_model::Style::Plain);
    assert!(said.contains("`n_i w,i`"), "{said}");
}
