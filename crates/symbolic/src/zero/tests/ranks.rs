//! Generic ranks and regularity.

use super::super::{generic_determinant_nonzero, generic_rank, Options, RankTest};
use super::*;
use crate::node::Symbol;

struct Case {
    rows: usize,
    columns: usize,
    entries: Vec<Expr>,
    implicit: Vec<(Expr, Symbol)>,
    assumptions: Assumptions,
}

impl Case {
    fn new(g: &Graph, rows: usize, columns: usize, entries: &[&str]) -> Self {
        let entries = entries.iter().map(|text| parse(g, text)).collect();
        Self {
            rows,
            columns,
            entries,
            implicit: Vec::new(),
            assumptions: Assumptions::new(),
        }
    }

    fn test(&self) -> RankTest<'_> {
        RankTest {
            rows: self.rows,
            columns: self.columns,
            entries: &self.entries,
            solved: &[],
            implicit: &self.implicit,
            assumptions: &self.assumptions,
            options: Options::default(),
        }
    }
}

#[test]
fn rotations_and_dependent_rows() {
    let g = Graph::new();
    let rotation = Case::new(&g, 2, 2, &["cos(phi)", "sin(phi)", "-sin(phi)", "cos(phi)"]);
    assert_eq!(
        generic_determinant_nonzero(&g, &rotation.test()).word(),
        "proved"
    );
    // The third row is the second times x; the fourth is the sum of the first two.
    let rows = [
        "1",
        "x",
        "y",
        "sin(a)",
        "cos(a)",
        "x",
        "x*sin(a)",
        "x*cos(a)",
        "x^2",
        "1 + sin(a)",
        "x + cos(a)",
        "y + x",
    ];
    let rank = generic_rank(&g, &Case::new(&g, 4, 3, &rows).test()).unwrap();
    assert_eq!((rank.minimum, rank.maximum), (2, 2));
    assert_eq!(rank.pivots.rows, [0, 1]);
    let Verdict::Proved(at_most) = rank.at_most else {
        panic!()
    };
    assert!(at_most.error_bound_log2.unwrap() <= -100.0);
    assert_eq!(rank.at_least.word(), "proved");
}

#[test]
fn a_determinant_that_vanishes_by_an_identity() {
    let g = Graph::new();
    let zero = Case::new(&g, 2, 2, &["sin(a)^2", "1 - cos(a)^2", "1", "1"]);
    let verdict = generic_determinant_nonzero(&g, &zero.test());
    assert_eq!(verdict.word(), "undecided");
    assert_eq!(generic_rank(&g, &zero.test()).unwrap().maximum, 1);
}

#[test]
fn unknown_independence_is_settled_by_an_enclosure() {
    let g = Graph::new();
    // log 2 and log x might be related for all the field knows: the ball at a point decides.
    let case = Case::new(
        &g,
        2,
        2,
        &["log(x^2 + 1)", "atan(x)", "1", "exp(x) + log(2)"],
    );
    assert_eq!(
        generic_determinant_nonzero(&g, &case.test()).word(),
        "proved"
    );
    // atan x + atan 1/x is constant for x > 0; its derivative is not tested here, so the rank is not claimed.
    let mut hidden = Case::new(&g, 1, 1, &["atan(x) + atan(1/x) - pi/2"]);
    hidden.assumptions.positive(&g, g.symbol("x", 0));
    assert_eq!(
        generic_determinant_nonzero(&g, &hidden.test()).word(),
        "undecided"
    );
}

#[test]
fn rank_on_a_constraint_and_its_components() {
    let g = Graph::new();
    let y = g.intern_symbol("y", 1);
    // On x'² = y'² the matrix has rank 1 on either component, 2 off it.
    let mut case = Case::new(&g, 2, 2, &["x'", "y'", "y'", "x'"]);
    assert_eq!(generic_rank(&g, &case.test()).unwrap().minimum, 2);
    case.implicit = vec![(parse(&g, "x'^2 - y'^2"), y)];
    let rank = generic_rank(&g, &case.test()).unwrap();
    assert_eq!((rank.minimum, rank.maximum), (1, 1));
    let mut uneven = Case::new(&g, 1, 1, &["x' - y'"]);
    uneven.implicit = case.implicit.clone();
    let rank = generic_rank(&g, &uneven.test()).unwrap();
    assert_eq!(
        (rank.minimum, rank.maximum),
        (0, 1),
        "zero on one component"
    );
}

#[test]
fn a_wrong_shape_is_no_panic() {
    let g = Graph::new();
    let mut case = Case::new(&g, 2, 2, &["x", "y"]);
    assert!(generic_rank(&g, &case.test()).is_err());
    (case.rows, case.columns, case.entries) = (0, 3, Vec::new());
    assert_eq!(generic_rank(&g, &case.test()).unwrap().maximum, 0);
}
