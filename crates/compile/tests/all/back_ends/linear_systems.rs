// Linear systems: solutions, and the reasons why there is none.

use chetaev_compile::program::Factorization;
use chetaev_compile::{
    BlockEvaluator, EvaluateFailure, Evaluator, Backend, Lanes, Lowering, LANES,
};
use chetaev_symbolic::{Expr, Graph, Symbol};

/// A program for A x = b with all entries of A and b as variables, row by row.
fn system(n: usize, is_symmetric: bool) -> Backend {
    let g = Graph::new();
    let name = |i: usize, j: usize| {
        let (i, j) = if is_symmetric {
            (i.max(j), i.min(j))
        } else {
            (i, j)
        };
        g.symbol(&format!("a_{i}_{j}"), 0)
    };
    let entries: Vec<Expr> = (0..n * n).map(|k| name(k / n, k % n)).collect();
    let rhs: Vec<Expr> = (0..n).map(|i| g.symbol(&format!("b_{i}"), 0)).collect();
    let x = g.solve(&entries, &rhs).unwrap();
    let mut inputs: Vec<Expr> = entries.into_iter().chain(rhs).collect();
    if is_symmetric {
        inputs.sort_unstable();
        inputs.dedup();
        inputs.sort_by_key(|&e| {
            let text = g.symbol_text(g.as_symbol(e).unwrap());
            let indices: Vec<usize> = text[2..].split('_').map(|i| i.parse().unwrap()).collect();
            (text.starts_with('b'), indices)
        });
    }
    let symbols: Vec<Symbol> = inputs.iter().map(|&e| g.as_symbol(e).unwrap()).collect();
    let program = Lowering::new(&g)
        .variables(&symbols)
        .output("x", &x)
        .positive_definite(&x)
        .name_matrices("mass matrix", &x)
        .lower()
        .unwrap();
    let expected = if is_symmetric {
        Factorization::Ldlt
    } else {
        Factorization::Lu
    };
    assert_eq!(program.matrices[0].factorization, expected);
    assert_eq!(program.matrices[0].name, "mass matrix");
    make(program)
}

fn solve(interpreter: &Backend, input: &[f64]) -> Result<Vec<f64>, EvaluateFailure> {
    let mut workspace = interpreter.workspace();
    interpreter.prepare(&[], &mut workspace)?;
    let mut x = vec![0.0; interpreter.program().output_count()];
    interpreter.evaluate(input, &mut workspace, &mut x)?;
    Ok(x)
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (f, e) in found.iter().zip(expected) {
        assert!(
            (f - e).abs() <= 1e-14 * e.abs().max(1.0),
            "{found:?} {expected:?}"
        );
    }
}

#[test]
fn a_system_that_needs_pivoting_is_solved() {
    // Rows 0 2 1; 1 1 0; 3 0 1, and x = (1, 2, 3): b = (7, 3, 6).
    let system = system(3, false);
    let input = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0, 7.0, 3.0, 6.0];
    assert_close(&solve(&system, &input).unwrap(), &[1.0, 2.0, 3.0]);
}

#[test]
fn a_definite_system_is_solved_without_pivoting() {
    // Hilbert's matrix of order 3 times (1, 1, 1): row sums 11/6, 13/12, 47/60.
    let system = system(3, true);
    let (h2, h3, h4, h5) = (1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0);
    let input = [
        1.0,
        h2,
        h3,
        h3,
        h4,
        h5,
        11.0 / 6.0,
        13.0 / 12.0,
        47.0 / 60.0,
    ];
    let x = solve(&system, &input).unwrap();
    assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-13), "{x:?}");
}

#[test]
fn an_indefinite_matrix_promised_definite_is_still_solved() {
    let system = system(2, true);
    // 0 1; 1 0 has no L D Lᵀ without pivoting.
    assert_close(
        &solve(&system, &[0.0, 1.0, 0.0, 5.0, 7.0]).unwrap(),
        &[7.0, 5.0],
    );
    // 1e-20 1; 1 1 has a useless one: x = (1, 1) up to 1e-20 for b = (1, 2).
    assert_close(
        &solve(&system, &[1e-20, 1.0, 1.0, 1.0, 2.0]).unwrap(),
        &[1.0, 1.0],
    );
    // −2 0; 0 −3, negative definite.
    assert_close(
        &solve(&system, &[-2.0, 0.0, -3.0, 4.0, 9.0]).unwrap(),
        &[-2.0, -3.0],
    );
}

#[test]
fn a_singular_matrix_is_named_with_its_pivot() {
    let general = system(2, false);
    match solve(&general, &[1.0, 2.0, 2.0, 4.0, 1.0, 1.0]) {
        Err(EvaluateFailure::Singular {
            matrix: 0,
            pivot: 1,
            value,
            smallest,
            largest,
            ..
        }) => assert_eq!((value, smallest, largest), (0.0, 0.0, 2.0)),
        other => panic!("{other:?}"),
    }
    let zero = solve(&general, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
    assert!(
        matches!(zero, Err(EvaluateFailure::Singular { pivot: 0, .. })),
        "{zero:?}"
    );
    let zero_column = solve(&general, &[0.0, 3.0, 0.0, 4.0, 1.0, 1.0]);
    assert!(matches!(
        zero_column,
        Err(EvaluateFailure::Singular { pivot: 0, .. })
    ));
}

#[test]
fn a_matrix_singular_up_to_rounding_is_refused() {
    // Third row = first + second, with entries that are not exact in binary.
    let singular = system(3, false);
    let (r1, r2) = ([0.1, 0.7, 0.3], [1.1, 0.2, 0.9]);
    let r3: Vec<f64> = r1.iter().zip(&r2).map(|(a, b)| a + b).collect();
    for scale in [1.0, 1e-150, 1e150] {
        let rows = [&r1[..], &r2[..], &r3[..]].concat();
        let mut input: Vec<f64> = rows.iter().map(|a| a * scale).collect();
        input.extend([1.0, 2.0, 4.0]);
        let failure = solve(&singular, &input);
        assert!(
            matches!(failure, Err(EvaluateFailure::Singular { pivot: 2, .. })),
            "{failure:?}"
        );
    }
    let symmetric = system(2, true);
    let failure = solve(&symmetric, &[0.01, 0.1, 1.0, 1.0, 2.0]);
    assert!(
        matches!(failure, Err(EvaluateFailure::Singular { .. })),
        "{failure:?}"
    );
}

#[test]
fn units_do_not_make_a_matrix_singular() {
    // diag(1e-20, 1, 1e20) times a rotation-like coupling in scaled units: regular.
    let scales = [1e-20, 1.0, 1e20];
    let core = [[2.0, 1.0, 0.5], [1.0, 3.0, 1.0], [0.5, 1.0, 2.0]];
    let b = [3.5, 5.0, 3.5];
    for (system, is_symmetric) in [(system(3, false), false), (system(3, true), true)] {
        let mut input = Vec::new();
        for i in 0..3 {
            let columns = if is_symmetric { 0..i + 1 } else { 0..3 };
            input.extend(columns.map(|j| scales[i] * core[i][j] * scales[j]));
        }
        input.extend((0..3).map(|i| scales[i] * b[i]));
        let x = solve(&system, &input).unwrap();
        let unscaled: Vec<f64> = x.iter().zip(scales).map(|(x, s)| x * s).collect();
        assert_close(&unscaled, &[1.0, 1.0, 1.0]);
    }
}

/// c x + b z = p, c y + b z = q, b (x + y) = r has x − y = (p − q)/c and x + y = r/b: a stiff direction bordered by a condition, whose
/// largest entries say nothing of its rank. With c = 0 it is singular.
#[test]
fn a_small_part_bordered_by_large_entries_is_regular() {
    let (general, p, q, r) = (system(3, false), 5.0, 2.0, 4.0);
    for (c, b) in [(1e-40, 1e-8), (1e-15, 1.0), (1e-100, 1e100), (1.0, 1e20)] {
        let matrix = [c, 0.0, b, 0.0, c, b, b, b, 0.0];
        let x = solve(&general, &[&matrix[..], &[p, q, r]].concat()).unwrap();
        let (sum, difference) = (r / b, (p - q) / c);
        let right = [0.5 * (sum + difference), 0.5 * (sum - difference)];
        assert_close(&x[..2].iter().zip(right).map(|(x, r)| x / r).collect::<Vec<f64>>(), &[1.0, 1.0]);
        let singular = [0.0, 0.0, b, 0.0, 0.0, b, b, b, 0.0];
        let found = solve(&general, &[&singular[..], &[p, q, r]].concat());
        assert!(matches!(found, Err(EvaluateFailure::Singular { .. })), "{found:?}");
    }
}

#[test]
fn an_infinite_entry_is_told_apart_from_a_singular_matrix() {
    for (n, is_symmetric) in [(2, false), (2, true)] {
        let system = system(n, is_symmetric);
        let count = system.program().variables.len();
        for bad in [f64::NAN, f64::INFINITY] {
            let mut input = vec![1.0; count];
            input[0] = bad;
            let failure = solve(&system, &input);
            assert_eq!(failure, Err(EvaluateFailure::NotFinite { matrix: 0 }));
        }
    }
}

#[test]
fn pivots_are_available_after_an_evaluation() {
    let system = system(2, true);
    let mut workspace = system.workspace();
    system.prepare(&[], &mut workspace).unwrap();
    let mut x = [0.0; 2];
    // 4 2; 2 3 = L diag(4, 2) Lᵀ.
    let input = [4.0, 2.0, 3.0, 1.0, 1.0];
    system.evaluate(&input, &mut workspace, &mut x).unwrap();
    let pivots = workspace.pivots(0).unwrap();
    assert_eq!((pivots.smallest, pivots.largest), (2.0, 4.0));
    assert!(workspace.pivots(1).is_none());
}

#[test]
fn a_singular_state_does_not_disturb_its_block() {
    for is_symmetric in [false, true] {
        let system = system(2, is_symmetric);
        let state = |l: usize| -> Vec<f64> {
            let off = if l % 5 == 3 { 1.0 } else { 0.25 * l as f64 };
            let matrix = if is_symmetric {
                vec![1.0, off, 1.0]
            } else {
                vec![1.0, off, off, 1.0]
            };
            [matrix, vec![1.0, 2.0 + l as f64]].concat()
        };
        let count = system.program().variables.len();
        let inputs: Vec<Lanes> = (0..count)
            .map(|i| Lanes::from_fn(|l| state(l)[i]))
            .collect();
        let mut workspace = system.block_workspace();
        let mut x = [Lanes::default(); 2];
        system.prepare_block(&[], &mut workspace).unwrap();
        for _ in 0..2 {
            system
                .evaluate_block(1, &inputs, &mut workspace, &mut x)
                .unwrap();
            for l in 0..LANES {
                let failed = workspace.failures().iter().find(|failure| failure.0 == l);
                match solve(&system, &state(l)) {
                    Ok(single) => {
                        assert!(failed.is_none(), "state {l}: {failed:?}");
                        let found = [x[0].as_slice()[l], x[1].as_slice()[l]];
                        assert_eq!(single, found, "state {l}");
                    }
                    Err(failure) => assert_eq!(failed, Some(&(l, failure))),
                }
            }
        }
        // The matrix 1 off; off 1 is singular for off = 1 only.
        let expected = (0..LANES).filter(|l| l % 5 == 3 || *l == 4).count();
        assert_eq!(workspace.failures().len(), expected);
    }
}

#[test]
fn a_matrix_of_parameters_is_factorized_once() {
    let g = Graph::new();
    let symbols: Vec<Expr> = ["a", "b", "c", "x"]
        .iter()
        .map(|s| g.symbol(s, 0))
        .collect();
    let [a, b, c, x] = symbols[..] else { panic!() };
    let first = g.solve(&[a, b, b, c], &[x, g.sin(x)]).unwrap();
    let second = g.solve(&[a, b, b, c], &[g.one(), x]).unwrap();
    let names: Vec<Symbol> = symbols.iter().map(|&e| g.as_symbol(e).unwrap()).collect();
    let program = Lowering::new(&g)
        .parameters(&names[..3])
        .variables(&names[3..])
        .output("first", &first)
        .output("second", &second)
        .lower()
        .unwrap();
    assert_eq!((program.matrices.len(), program.solves.len()), (1, 2));
    assert_eq!(program.prologue.len(), 1);
    let interpreter = make(program);
    let mut workspace = interpreter.workspace();
    // 2 1; 1 1, inverse 1 −1; −1 2.
    interpreter
        .prepare(&[2.0, 1.0, 1.0], &mut workspace)
        .unwrap();
    let mut outputs = [0.0; 4];
    interpreter
        .evaluate(&[0.5], &mut workspace, &mut outputs)
        .unwrap();
    let sin = 0.5f64.sin();
    assert_close(&outputs, &[0.5 - sin, 2.0 * sin - 0.5, 0.5, 0.0]);
    let failure = interpreter.prepare(&[1.0, 1.0, 1.0], &mut workspace);
    assert!(matches!(
        failure,
        Err(EvaluateFailure::Singular { pivot: 1, .. })
    ));
    let failure = interpreter.evaluate(&[0.5], &mut workspace, &mut outputs);
    assert_eq!(failure, Err(EvaluateFailure::NotPrepared));
    // A state of a block whose parameters are singular fails in every evaluation.
    let mut block = interpreter.block_workspace();
    let lanes = |f: &dyn Fn(usize) -> f64| Lanes::from_fn(f);
    let parameters = [
        lanes(&|l| if l == 6 { 1.0 } else { 2.0 }),
        Lanes::splat(1.0),
        Lanes::splat(1.0),
    ];
    interpreter.prepare_block(&parameters, &mut block).unwrap();
    let mut outputs = [Lanes::default(); 4];
    for _ in 0..2 {
        interpreter
            .evaluate_block(2, &[Lanes::splat(0.5)], &mut block, &mut outputs)
            .unwrap();
        let failed: Vec<usize> = block.failures().iter().map(|failure| failure.0).collect();
        assert_eq!(failed, [6]);
        assert_close(&[outputs[2].as_slice()[7]], &[0.5]);
    }
}

/// Diagonally dominant, with zeros in a pattern, and x = (1, 2, …).
fn regular(n: usize, is_symmetric: bool, shift: usize) -> Vec<f64> {
    let entry = |i: usize, j: usize| {
        let (i, j) = if is_symmetric { (i.max(j), i.min(j)) } else { (i, j) };
        match (i * 7 + j * 3 + shift) % 5 {
            _ if i == j => 3.0 + n as f64 + (i % 3) as f64,
            0 => 0.0,
            k => 0.3 * k as f64 - 0.7,
        }
    };
    let mut input = Vec::new();
    for i in 0..n {
        let columns = if is_symmetric { 0..i + 1 } else { 0..n };
        input.extend(columns.map(|j| entry(i, j)));
    }
    input.extend((0..n).map(|i| (0..n).map(|j| entry(i, j) * (j + 1) as f64).sum::<f64>()));
    input
}

#[test]
fn systems_of_every_size_are_solved_alone_and_in_blocks() {
    for n in [2, 3, 4, 5, 8, 13, 19, 20, 21, 24, 33] {
        for is_symmetric in [true, false] {
            let system = system(n, is_symmetric);
            let inputs: Vec<Vec<f64>> = (0..LANES).map(|l| regular(n, is_symmetric, l)).collect();
            let lanes: Vec<Lanes> = (0..inputs[0].len())
                .map(|i| Lanes::from_fn(|l| inputs[l][i]))
                .collect();
            let mut workspace = system.block_workspace();
            let mut x = vec![Lanes::default(); n];
            system.prepare_block(&[], &mut workspace).unwrap();
            system
                .evaluate_block(1, &lanes, &mut workspace, &mut x)
                .unwrap();
            for (l, input) in inputs.iter().enumerate() {
                let alone = solve(&system, input).unwrap();
                let together: Vec<f64> = x.iter().map(|x| x.as_slice()[l]).collect();
                assert_eq!(alone, together, "size {n}, state {l}");
                let expected: Vec<f64> = (1..=n).map(|i| i as f64).collect();
                assert_close(&alone, &expected);
            }
        }
    }
}

#[test]
fn pivots_of_a_block_are_those_of_its_states() {
    for is_symmetric in [true, false] {
        let system = system(5, is_symmetric);
        let inputs: Vec<Vec<f64>> = (0..LANES).map(|l| regular(5, is_symmetric, l)).collect();
        let lanes: Vec<Lanes> = (0..inputs[0].len())
            .map(|i| Lanes::from_fn(|l| inputs[l][i]))
            .collect();
        let mut block = system.block_workspace();
        let mut x = vec![Lanes::default(); 5];
        system.prepare_block(&[], &mut block).unwrap();
        system.evaluate_block(1, &lanes, &mut block, &mut x).unwrap();
        for (l, input) in inputs.iter().enumerate() {
            let mut single = system.workspace();
            system.prepare(&[], &mut single).unwrap();
            system.evaluate(input, &mut single, &mut [0.0; 5]).unwrap();
            assert_eq!(block.pivots(0, l), single.pivots(0));
            assert!(single.pivots(0).unwrap().smallest > 1.0);
        }
    }
}
