//! Order conditions of the tableaus by rooted trees (Butcher; Hairer, Nørsett, Wanner 1993, II.2, theorem 2.13):
//! a method has order p iff Σ_i b_i Φ_i(τ) = 1/γ(τ) for all rooted trees τ with at most p vertices. A dense output
//! b_i(θ) has order p iff Σ_i b_i(θ) Φ_i(τ) = θ^|τ|/γ(τ).

use chetaev_integrate::methods::{
    ErrorEstimate, ExplicitRungeKutta, Row, DORMAND_PRINCE_853, RUNGE_KUTTA_4, TSITOURAS_5,
};

/// A rooted tree as the list of its root's subtrees, by index into the list of all trees.
struct Tree {
    children: Vec<usize>,
    vertices: u32,
    gamma: f64,
}

/// All rooted trees with at most `most` vertices: 1, 1, 2, 4, 9, 20, 48, 115, …
fn trees(most: u32) -> Vec<Tree> {
    let mut all: Vec<Tree> = Vec::new();
    for vertices in 1..=most {
        let mut forests = Vec::new();
        extend(&all, vertices - 1, 0, &mut Vec::new(), &mut forests);
        for children in forests {
            let gamma =
                f64::from(vertices) * children.iter().map(|c| all[*c].gamma).product::<f64>();
            all.push(Tree {
                children,
                vertices,
                gamma,
            });
        }
    }
    all
}

/// All multisets of trees with `left` vertices in total, as ascending lists.
fn extend(all: &[Tree], left: u32, from: usize, sofar: &mut Vec<usize>, out: &mut Vec<Vec<usize>>) {
    if left == 0 {
        out.push(sofar.clone());
        return;
    }
    for next in from..all.len() {
        if all[next].vertices <= left {
            sofar.push(next);
            extend(all, left - all[next].vertices, next, sofar, out);
            sofar.pop();
        }
    }
}

/// A with a row for every slope: stages, end of the step, extra slopes.
fn full_matrix(method: &ExplicitRungeKutta) -> Vec<Vec<f64>> {
    let t = &method.tableau;
    let size = t.c.len();
    t.a.iter()
        .chain(std::iter::once(&t.b))
        .chain(t.extra)
        .map(|row| dense_row(row, size))
        .collect()
}

fn dense_row(row: Row, size: usize) -> Vec<f64> {
    let mut full = vec![0.0; size];
    for (j, weight) in row {
        full[*j] += weight;
    }
    full
}

/// Φ_i(τ) for every tree, per slope.
fn elementary_weights(a: &[Vec<f64>], trees: &[Tree]) -> Vec<Vec<f64>> {
    let mut phi: Vec<Vec<f64>> = Vec::new();
    for tree in trees {
        let value = (0..a.len()).map(|i| {
            tree.children
                .iter()
                .map(|child| (0..a.len()).map(|j| a[i][j] * phi[*child][j]).sum::<f64>())
                .product()
        });
        let value: Vec<f64> = value.collect();
        phi.push(value);
    }
    phi
}

/// Largest violation of the conditions of exactly `vertices` vertices by the weights b, at θ.
fn defect(b: &[f64], theta: f64, vertices: u32, trees: &[Tree], phi: &[Vec<f64>]) -> f64 {
    trees
        .iter()
        .zip(phi)
        .filter(|(tree, _)| tree.vertices == vertices)
        .map(|(tree, phi)| {
            let sum: f64 = b.iter().zip(phi).map(|(b, p)| b * p).sum();
            (sum - theta.powi(vertices as i32) / tree.gamma).abs()
        })
        .fold(0.0, f64::max)
}

/// b_i(θ) of the alternating form: θ(b + (1−θ)(e_0 − b + θ(2b − e_s − e_0 + (1−θ)(d_0 + θ(d_1 + …))))).
fn dense_weights(method: &ExplicitRungeKutta, theta: f64) -> Vec<f64> {
    let t = &method.tableau;
    let size = t.c.len();
    let s = t.a.len();
    let b = dense_row(t.b, size);
    let unit = |k: usize| {
        (0..size)
            .map(|i| f64::from(u8::from(i == k)))
            .collect::<Vec<f64>>()
    };
    let (first, last) = (unit(0), unit(s));
    let mut rows = vec![b.clone()];
    rows.push((0..size).map(|i| first[i] - b[i]).collect());
    rows.push((0..size).map(|i| 2.0 * b[i] - last[i] - first[i]).collect());
    rows.extend(t.dense.iter().map(|row| dense_row(row, size)));
    let mut value = vec![0.0; size];
    for (j, row) in rows.iter().enumerate().rev() {
        let factor = if j % 2 == 0 { theta } else { 1.0 - theta };
        for i in 0..size {
            value[i] = factor * (row[i] + value[i]);
        }
    }
    value
}

/// The conditions hold up to `order` and fail for `order + 1`, which shows that the test can tell.
fn check_order(b: &[f64], theta: f64, order: u32, method: &ExplicitRungeKutta, tolerance: f64) {
    let trees = trees(order + 1);
    let phi = elementary_weights(&full_matrix(method), &trees);
    for vertices in 1..=order {
        let defect = defect(b, theta, vertices, &trees, &phi);
        assert!(
            defect < tolerance,
            "{vertices} vertices at {theta}: {defect:e}"
        );
    }
    let beyond = defect(b, theta, order + 1, &trees, &phi);
    assert!(beyond > 1e-9, "order {} at {theta}: {beyond:e}", order + 1);
}

const METHODS: [&ExplicitRungeKutta; 3] = [&DORMAND_PRINCE_853, &TSITOURAS_5, &RUNGE_KUTTA_4];

#[test]
fn there_are_as_many_trees_as_the_literature_says() {
    // Hairer, Nørsett, Wanner 1993, II.2, table 2.1.
    let all = trees(8);
    let count = |v: u32| all.iter().filter(|t| t.vertices == v).count();
    let counts: Vec<usize> = (1..=8).map(count).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
}

#[test]
fn rows_sum_to_the_abscissas() {
    for method in METHODS {
        let t = &method.tableau;
        for (i, row) in full_matrix(method).iter().enumerate() {
            let defect = row.iter().sum::<f64>() - t.c[i];
            let size: f64 = row.iter().map(|a| a.abs()).sum();
            assert!(
                defect.abs() < 2.0 * f64::EPSILON * size.max(1.0),
                "{} row {i}: {defect:e}",
                method.card.name
            );
        }
    }
}

#[test]
fn solutions_have_their_order() {
    for method in METHODS {
        let b = dense_row(method.tableau.b, method.tableau.c.len());
        check_order(&b, 1.0, method.card.order, method, 3e-14);
    }
}

#[test]
fn dense_outputs_have_their_order() {
    for method in METHODS {
        for theta in [0.1, 0.37, 0.5, 0.81] {
            let b = dense_weights(method, theta);
            check_order(&b, theta, method.card.dense_order, method, 1e-13);
        }
    }
}

#[test]
fn error_estimates_are_differences_of_methods_of_the_stated_orders() {
    let embedded = |method: &ExplicitRungeKutta, error: Row, order: u32| {
        let size = method.tableau.c.len();
        let b = dense_row(method.tableau.b, size);
        let e = dense_row(error, size);
        let lower: Vec<f64> = b.iter().zip(&e).map(|(b, e)| b - e).collect();
        check_order(&lower, 1.0, order, method, 3e-14);
    };
    match DORMAND_PRINCE_853.tableau.error {
        ErrorEstimate::FiveThree { five, three } => {
            embedded(&DORMAND_PRINCE_853, five, 5);
            embedded(&DORMAND_PRINCE_853, three, 3);
        }
        other => panic!("unexpected estimate {other:?}"),
    }
    match TSITOURAS_5.tableau.error {
        ErrorEstimate::Embedded(row) => embedded(&TSITOURAS_5, row, 4),
        other => panic!("unexpected estimate {other:?}"),
    }
}
