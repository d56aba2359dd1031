//! A splitting tensor that is a projector (T4 §5, E2; reference case S-F18): the whole energy of volume stays in the strains, that of shape
//! goes to the split-off stress, and neither part of the energy is regular.

use crate::table::{decided, loaded_text, row_text, studied_text};
use chetaev_functionals::notation::parse;
use chetaev_functionals::space::Jet;
use chetaev_functionals::variation::variation;
use chetaev_functionals::Functional;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

/// A part of a text from its heading to the next one; the heading alone where there is none.
fn section(text: &str, heading: &str) -> String {
    let Some(start) = text.find(heading) else {
        return format!("{heading}\n");
    };
    let own = &text[start..];
    own[..own.find("\n[").map_or(own.len(), |end| end + 1)].to_owned()
}

/// A row of the table in the plane with this split, for small displacements.
fn text(row: &str, imposed: &str, yields: &str) -> String {
    let text = row_text(row);
    let density = text.lines().find(|line| line.starts_with("density = "));
    let [fields, define, boundary] =
        ["[fields]", "[define]", "[boundary]"].map(|heading| section(&text, heading));
    format!(
        r#"
name = "{row}"
include = ["../common/body.toml"]
{}
imposed = [{imposed}]
yields = [{yields}]
{fields}
{define}beta_ijkl = "delta_ij delta_kl/2"
{boundary}
[parameters]
K2 = {{ description = "twice the modulus of compression in the plane" }}
G = {{ description = "shear modulus" }}
[functions]
A = {{ of = "symmetric", value = "K2/2 X_ii X_jj + G (X_ij X_ij - X_ii X_jj/2)" }}
Astar = {{ of = "symmetric", value = "K2/2 X_ii X_jj" }}
Bstar = {{ of = "symmetric", value = "(X_ij X_ij - X_ii X_jj/2)/(4 G)" }}
[equations]
1 = "sstar_ij = s_ij - s_kk delta_ij/2"
pressure = "s_ii = 2 K2 e_ii"
volume = "e_ii = D_ii"
shape = "s_ij - s_kk delta_ij/2 = 2 G (D_ij - D_kk delta_ij/2)"
none = "e_ii = 0"
trace = "sstar_ii = 0"
whole = "sstar_ij = s_ij"
"#,
        density.unwrap()
    )
}

const SMALL: &[(&str, &str)] = &[("d", "2"), ("nonlinear", "0")];

fn euler(row: &str, imposed: &str, yields: &str) -> (String, String) {
    let study = studied_text(row, &text(row, imposed, yields), SMALL);
    let verdict = decided(&study, "functional.euler");
    (verdict.word().to_owned(), verdict.detail().to_owned())
}

#[track_caller]
fn says(row: &str, imposed: &str, yields: &str, (word, part): (&str, &str)) {
    let (found, detail) = euler(row, imposed, yields);
    assert_eq!(found, word, "{detail}");
    assert!(detail.contains(part), "{detail}");
}

#[test]
fn on_level_three_the_strain_of_shape_is_not_determined() {
    says(
        "p3p",
        "\"1\"",
        r#""pressure", "volume", "shape", "4", "5", "6""#,
        (
            "proved",
            "e is not determined: 2 of its 3 components are left free",
        ),
    );
    says(
        "p3p",
        "\"1\"",
        r#""pressure", "2", "shape", "4", "5", "6""#,
        ("refuted", "(2) does not follow"),
    );
}

/// The conjugate of an energy of shape is there for stresses without a trace only: with it imposed every equation follows.
#[test]
fn on_level_four_the_stress_split_off_has_no_trace() {
    let all = r#""1", "2", "3", "4", "5", "6""#;
    says("p4p", "\"trace\"", all, ("proved", "(trace)"));
    let (_, detail) = euler("p4p", "\"trace\"", all);
    assert!(!detail.contains("left free"), "{detail}");
    // Without it the same formula for the conjugate is that of a body that keeps its volume.
    says("p4p", "", all, ("refuted", "(3) does not follow"));
    let rigid = r#""none", "whole", "shape", "2", "4", "5", "6""#;
    says("p4p", "", rigid, ("proved", ""));
}

/// What stands for the fields in S-F18: the strain of u is (1/10, −1/20, 3/100), and e has any strain of shape.
fn reference(f: &Functional, s_11: &str, e_11: &str) -> Vec<(Expr, Expr)> {
    let written = |text: &str| {
        let node = parse(text, &f.scope, &mut Vec::new()).unwrap();
        f.scope.value(&node, &BTreeMap::new())
    };
    [
        ("u_1", "x_1/10 + 3 x_2/100"),
        ("u_2", "3 x_1/100 - x_2/20"),
        ("s_11", s_11),
        ("s_22", "-1/5"),
        ("s_12", "9/50"),
        ("e_11", e_11),
        ("e_22", "1/40 - x_1"),
        ("e_12", "x_2"),
        ("K2", "5"),
        ("G", "3"),
    ]
    .map(|(name, value)| (written(name), written(value)))
    .to_vec()
}

#[test]
fn the_stresses_are_those_of_the_reference() {
    let f = loaded_text("p3p", &text("p3p", "\"1\"", ""), SMALL).functional;
    let space = &*f.space;
    let own = variation(&f).unwrap().euler.into_iter();
    // Equilibrium without a body force is left out: S-F18 has no displacements.
    let conditions: Vec<Expr> = own
        .filter(|(component, _)| !space.component_at(*component).name.starts_with('u'))
        .map(|(_, e)| space.explicit(e))
        .collect();
    let is_solution = |s_11: &str, e_11: &str| {
        let pairs = reference(&f, s_11, e_11);
        let put: Vec<Expr> = conditions.iter().map(|&e| space.put(e, &pairs)).collect();
        space.vanish(&put)
    };
    assert!(is_solution("7/10", "1/40 + x_1"));
    assert!(!is_solution("3/5", "1/40 + x_1"));
    assert!(!is_solution("7/10", "1/30 + x_1"));
    assert_eq!(rank(&f, &conditions), 4);
}

/// The rank of the six conditions in the six components of e and s.
fn rank(f: &Functional, conditions: &[Expr]) -> usize {
    let (space, g) = (&*f.space, &f.space.graph);
    let values = &reference(f, "0", "0")[8..];
    let names = ["e_11", "e_22", "e_12", "s_11", "s_22", "s_12"];
    let jets = names.map(|name| Jet {
        component: space.component_named(name).unwrap(),
        by: Vec::new(),
    });
    let of = |e: Expr| -> Vec<f64> {
        let slopes = jets.iter().map(|jet| space.partial(e, jet));
        let slopes: Vec<Expr> = slopes.map(|own| g.substitute(own, values)).collect();
        g.evaluate_f64(&slopes, &|_| None).unwrap()
    };
    let mut rows: Vec<Vec<f64>> = conditions.iter().map(|&e| of(e)).collect();
    assert_eq!(rows.len(), 6);
    let mut rank = 0;
    for column in 0..6 {
        let Some(pivot) = (rank..6).find(|&i| rows[i][column].abs() > 1e-12) else {
            continue;
        };
        rows.swap(rank, pivot);
        let (done, below) = rows.split_at_mut(rank + 1);
        for row in below {
            let factor = row[column] / done[rank][column];
            let pairs = row.iter_mut().zip(&done[rank]);
            pairs.for_each(|(own, by)| *own -= factor * by);
        }
        rank += 1;
    }
    rank
}
