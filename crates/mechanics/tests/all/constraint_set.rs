//! Ranks and choices are those on the set where all constraints hold, finite ones included.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_mechanics::redundancy::Reactions;
use chetaev_mechanics::{Prepared, System, SystemParts};
use chetaev_symbolic::{Expr, Graph, Verdict};
use std::sync::Arc;

fn system(
    coordinates: &[&str],
    constraints: &dyn Fn(&Graph) -> Vec<(&'static str, Expr)>,
) -> System {
    let g = Arc::new(Graph::new());
    let squares = coordinates.iter().map(|c| g.powi(g.symbol(c, 1), 2));
    let lagrangian = g.div(g.add(&squares.collect::<Vec<_>>()), g.integer(2));
    let constraints = constraints(&g).into_iter();
    let parts = SystemParts {
        coordinates: coordinates.iter().map(|c| (*c).to_string()).collect(),
        lagrangian: Some(lagrangian),
        constraints: constraints.map(|(name, f)| (name.to_string(), f)).collect(),
        ..SystemParts::default()
    };
    System::new(g, parts).unwrap()
}

/// h = 0 and h (5 + s²) = 0: the second follows on the set of the first, and shares its reaction λ_flat + (5 + s²) λ_again.
#[test]
fn what_follows_on_the_set_alone_is_redundant() {
    let system = system(&["h", "s"], &|g| {
        let (h, s) = (g.symbol("h", 0), g.symbol("s", 0));
        let factor = g.add(&[g.integer(5), g.powi(s, 2)]);
        vec![("flat", h), ("again", g.mul(&[h, factor]))]
    });
    let prepared = Prepared::new(&system).unwrap();
    assert_eq!(prepared.selection.rows, vec![0]);
    let left_out = prepared.left_out(&system).unwrap().unwrap();
    assert!(
        matches!(left_out.follows, Verdict::Proved(_)),
        "{left_out:?}"
    );
    let reactions = Reactions::of(&system, &prepared.terms, &prepared.selection);
    assert_eq!(reactions.undetermined, vec![0, 1]);
    let g = &system.graph;
    let s = g.symbol("s", 0);
    let weight = g.diff(reactions.determined[0], g.intern_symbol("lambda_again", 0));
    let expected = g.add(&[g.integer(5), g.powi(s, 2)]);
    let gap = g
        .evaluate_f64(&[g.sub(weight, expected)], &|_| Some(0.7))
        .unwrap();
    assert!(gap[0].abs() < 1e-14, "{}", g.text(reactions.determined[0]));
}

/// Three cranks of length 1 at distances of 4 under a plank: |u| = |u + d| = |u + 2 d| forces d = 0, so five of six equations are
/// independent wherever they hold, and six are elsewhere.
#[test]
fn three_equal_cranks_have_rank_five() {
    let system = system(&["a", "b", "c", "x", "y", "p"], &|g| {
        let q = |name: &str| g.symbol(name, 0);
        let mut all = Vec::new();
        let names = [("ax", "ay"), ("bx", "by"), ("cx", "cy")];
        for (k, (angle, (nx, ny))) in ["a", "b", "c"].into_iter().zip(names).enumerate() {
            let far = g.integer(4 * k as i64);
            let (cos, sin) = (g.cos(q("p")), g.sin(q("p")));
            let along = g.mul(&[far, g.sub(cos, g.one())]);
            all.push((nx, g.add(&[q("x"), along, g.neg(g.cos(q(angle)))])));
            let up = g.mul(&[far, sin]);
            all.push((ny, g.add(&[q("y"), up, g.neg(g.sin(q(angle)))])));
        }
        all
    });
    let prepared = Prepared::new(&system).unwrap();
    assert_eq!(prepared.selection.rows.len(), 5);
    let left_out = prepared.left_out(&system).unwrap().unwrap();
    assert!(
        matches!(left_out.follows, Verdict::Proved(_)),
        "{left_out:?}"
    );
}

/// Six bars of a shaky frame, a square of sides 2 with both diagonals: five are enough, at every position.
#[test]
fn a_frame_with_one_bar_too_many_is_rigid_with_five() {
    let system = system(&["xA", "yA", "xB", "yB", "xC", "yC", "xD", "yD"], &|g| {
        let q = |name: &str| g.symbol(name, 0);
        let bar = |i: &str, j: &str, square: i64| {
            let dx = g.sub(q(&format!("x{i}")), q(&format!("x{j}")));
            let dy = g.sub(q(&format!("y{i}")), q(&format!("y{j}")));
            g.add(&[g.powi(dx, 2), g.powi(dy, 2), g.integer(-square)])
        };
        vec![
            ("ab", bar("A", "B", 4)),
            ("bc", bar("B", "C", 4)),
            ("cd", bar("C", "D", 4)),
            ("da", bar("D", "A", 4)),
            ("ac", bar("A", "C", 8)),
            ("bd", bar("B", "D", 8)),
        ]
    });
    let prepared = Prepared::new(&system).unwrap();
    assert_eq!(prepared.selection.rows.len(), 5);
    assert!(prepared.left_out(&system).is_ok());
}
