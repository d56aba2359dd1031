//! Linear systems, shared parts, and large expressions.

use super::laws::depth_of_tags;
use super::{options, read, read_document, read_side};
use crate::graph::Graph;
use crate::node::Expr;
use crate::print::{Document, Format, Options};
use std::collections::BTreeMap;

fn solved(g: &Graph) -> Vec<Expr> {
    let entry = |s: &str| read(g, s);
    let matrix = [
        entry("m + M"),
        entry("m l cos(phi)"),
        entry("m l cos(phi)"),
        entry("m l^2"),
    ];
    let rhs = [entry("F"), entry("-m g l sin(phi)")];
    g.solve(&matrix, &rhs).unwrap()
}

#[test]
fn a_solve_is_stated_once_as_its_system() {
    let g = Graph::new();
    let solution = solved(&g);
    let equations = [
        (g.symbol("x", 2), solution[0]),
        (g.symbol("phi", 2), solution[1]),
    ];
    let document = Document::equations(&g, &equations, &Options::default());
    assert_eq!(document.definition_count(), 1);
    let text = document.render(Format::Text);
    assert!(
        text.starts_with("x'' = s_1\nphi'' = s_2\nwhere\n"),
        "{text}"
    );
    let rows = document.parts(Format::Text).definitions;
    assert_eq!(rows.len(), 2);
    assert!(
        rows.iter().any(|row| row.ends_with("= -m g l sin(phi)")),
        "{rows:?}"
    );
    assert!(document
        .render(Format::Sympy)
        .contains("[s_1, s_2] = sp.Matrix([["));
    assert!(document
        .render(Format::Latex)
        .contains("\\begin{pmatrix}s_1 \\\\ s_2\\end{pmatrix}"));
}

/// The rows that are printed are those of A s = b, also where entries are fractions, sums or negative.
#[test]
fn rows_of_a_system_read_as_the_system() {
    let g = Graph::new();
    let entries: Vec<Expr> = [
        "a/b", "-a/(2 b)", "0", "1", "-1", "x - y", "1/2", "-x y/2", "a^(-n)",
    ]
    .iter()
    .map(|s| read(&g, s))
    .collect();
    let rhs: Vec<Expr> = ["0", "-x", "1/(a + b)"]
        .iter()
        .map(|s| read(&g, s))
        .collect();
    let matrix = g.matrix(3, 3, &entries).unwrap();
    let solution = g.solve_entries(matrix, &rhs);
    let document = Document::expressions(&g, &solution[2..], &options(&["x", "y"]));
    assert_eq!(document.parts(Format::Text).statements, ["s_3"]);
    let rows = document.parts(Format::Text).definitions;
    for (i, row) in rows.iter().enumerate() {
        let unknown = |j: usize| g.symbol(&format!("s_{}", j + 1), 0);
        let terms: Vec<Expr> = (0..3)
            .map(|j| g.mul(&[entries[3 * i + j], unknown(j)]))
            .collect();
        let mut none = BTreeMap::new();
        assert_eq!(read_side(&g, row, 0, &mut none), g.add(&terms), "{row}");
        assert_eq!(read_side(&g, row, 1, &mut none), rhs[i], "{row}");
    }
}

#[test]
fn a_large_system_is_written_row_by_row() {
    let g = Graph::new();
    let n = 8;
    let entries: Vec<Expr> = (0..n * n)
        .map(|k| match k % n == k / n {
            true => g.symbol("m", 0),
            false => g.symbol(&format!("c_{k}"), 0),
        })
        .collect();
    let matrix = g.matrix(n, n, &entries).unwrap();
    let solution = g.solve_entries(matrix, &vec![g.one(); n]);
    let document = Document::expressions(&g, &solution, &Options::default());
    assert_eq!(document.definition_count(), 1);
    for format in [Format::Text, Format::Latex, Format::Mathml, Format::Json] {
        assert_eq!(document.parts(format).definitions.len(), n);
    }
    assert_eq!(document.parts(Format::Sympy).definitions.len(), 1);
}

#[test]
fn names_of_definitions_avoid_the_names_of_the_model() {
    let g = Graph::new();
    let e = g.add(&[solved(&g)[0], g.symbol("s_7", 0)]);
    let document = Document::expressions(&g, &[e], &Options::default());
    assert_eq!(
        document.render(Format::Text).lines().next(),
        Some("s_7 + z_1")
    );
}

/// x ← x² + y x, repeated: the tree has more than 2^depth nodes.
fn iterated(g: &Graph, depth: usize) -> Expr {
    let (mut x, y) = (g.symbol("x", 0), g.symbol("y", 0));
    for _ in 0..depth {
        x = g.add(&[g.sin(x), g.mul(&[y, x])]);
    }
    x
}

#[test]
fn a_shared_graph_does_not_explode() {
    let g = Graph::new();
    let e = iterated(&g, 300);
    assert_eq!(g.tree_size(e), u64::MAX);
    for format in [
        Format::Text,
        Format::Latex,
        Format::Mathml,
        Format::Sympy,
        Format::Json,
    ] {
        let document = Document::expressions(&g, &[e], &Options::default());
        assert!(document.render(format).len() < 200_000, "{format:?}");
        assert!(document.definition_count() > 50);
    }
}

#[test]
fn deep_expressions_are_cut_into_pieces() {
    let g = Graph::new();
    let (mut e, y) = (g.symbol("x", 0), g.symbol("y", 0));
    for _ in 0..100_000 {
        e = g.sin(g.add(&[e, y]));
    }
    let document = Document::expressions(&g, &[e], &Options::default());
    for part in document.parts(Format::Mathml).definitions {
        assert!(depth_of_tags(&part) < 200);
    }
    assert_eq!(read_document(&g, &document), [e]);
}
