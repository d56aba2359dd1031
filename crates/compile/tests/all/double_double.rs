//! Programs and series in double-double arithmetic.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_compile::double_double::{from_rational, DoubleDouble, PreciseProgram};
use chetaev_compile::{Lowering, PreciseTaylor, Program, Taylor};
use chetaev_symbolic::{rational, Expr, Function, Graph, Symbol};

/// 31 digits, a few of them lost by what is added up.
const CLOSE: f64 = 1e-29;

/// Functions of t, with the parameter p, at which every kind of recurrence occurs.
fn functions(g: &Graph, t: Expr, p: Expr) -> Vec<Expr> {
    let half = g.number(rational::ratio(1, 2).unwrap());
    let apply = |function: Function, x: Expr| g.apply(function, &[x]);
    let inside = g.mul(&[half, t]);
    let above = g.add(&[g.one(), g.mul(&[t, t])]);
    let mut all: Vec<Expr> = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Asinh,
        Function::Atanh,
        Function::Exp,
    ]
    .map(|function| apply(function, inside))
    .to_vec();
    all.extend([
        apply(Function::Log, above),
        apply(Function::Acosh, above),
        apply(Function::Abs, g.neg(above)),
        g.apply(Function::Atan2, &[t, g.neg(above)]),
        g.div(t, above),
        g.pow(above, g.div(g.one(), g.integer(3))),
        g.pow(above, half),
        g.pow(above, p),
        g.pow(above, t),
        g.mul(&[p, t, t, apply(Function::Sin, t)]),
        g.sub(g.div(t, p), g.mul(&[t, apply(Function::Exp, t)])),
    ]);
    all
}

/// The unknowns of a system that is symmetric and definite, and of one that is not.
fn solutions(g: &Graph, t: Expr) -> Vec<Expr> {
    let two = g.integer(2);
    let sin = g.apply(Function::Sin, &[t]);
    let definite = [g.add(&[two, t]), sin, sin, two];
    let general = [sin, two, g.add(&[two, t]), t];
    let right = [g.one(), t];
    let solve = |matrix: &[Expr]| g.solve(matrix, &right).unwrap();
    [solve(&definite), solve(&general)].concat()
}

fn program(g: &Graph, rates: &[Expr], t: Symbol, p: Symbol) -> Program {
    let mut variables = vec![t];
    variables.extend((0..rates.len()).map(|i| g.intern_symbol(&format!("x_{i}"), 0)));
    let lowering = Lowering::new(g).variables(&variables).parameters(&[p]);
    lowering.output("rates", rates).lower().unwrap()
}

#[test]
fn series_add_up_to_the_functions() {
    let g = Graph::new();
    let (t, p) = (g.intern_symbol("t", 0), g.intern_symbol("p", 0));
    let mut rates = functions(&g, g.symbol_expr(t), g.symbol_expr(p));
    rates.extend(solutions(&g, g.symbol_expr(t)));
    let (m, program) = (rates.len(), program(&g, &rates, t, p));
    let third = from_rational(&rational::ratio(1, 3).unwrap());
    let start = from_rational(&rational::ratio(7, 10).unwrap());
    let (mut taylor, mut direct) = (
        PreciseTaylor::new(&program).unwrap(),
        PreciseProgram::new(&program).unwrap(),
    );
    taylor.prepare(&[third]).unwrap();
    direct.prepare(&[third]).unwrap();
    let mut at = vec![DoubleDouble::ZERO; m + 1];
    at[0] = start;
    let order = 24;
    let mut coefficients = vec![DoubleDouble::ZERO; (order + 1) * m];
    taylor.expand(&at, order, &mut coefficients).unwrap();
    // The next term is below (1/30)²⁴ times a constant of order one.
    let h = DoubleDouble::from(2f64.powi(-6));
    at[0] = start + h;
    let expected = direct.evaluate(&at).unwrap();
    for (i, expected) in expected.iter().enumerate() {
        let mut sum = DoubleDouble::ZERO;
        for j in (0..order).rev() {
            let own = coefficients[(j + 1) * m + i] * (j + 1) as f64;
            sum = sum * h + own;
        }
        let error = (sum - *expected).abs().high() / expected.abs().high().max(1.0);
        assert!(error < CLOSE, "{i}: {error:e}");
    }
}

#[test]
fn series_agree_with_those_of_doubles() {
    let g = Graph::new();
    let (t, p) = (g.intern_symbol("t", 0), g.intern_symbol("p", 0));
    let mut rates = functions(&g, g.symbol_expr(t), g.symbol_expr(p));
    rates.extend(solutions(&g, g.symbol_expr(t)));
    let (m, program) = (rates.len(), program(&g, &rates, t, p));
    let order = 12;
    let mut plain = vec![0.0; (order + 1) * m];
    let mut at = vec![0.0; m + 1];
    at[0] = 0.7;
    let taylor = Taylor::interpreter(&program).unwrap();
    let mut workspace = taylor.workspace(order);
    taylor.prepare(&[0.3], &mut workspace).unwrap();
    taylor
        .expand(&at, order, &mut workspace, &mut plain)
        .unwrap();
    let mut precise = PreciseTaylor::new(&program).unwrap();
    precise.prepare(&[DoubleDouble::from(0.3)]).unwrap();
    let at: Vec<DoubleDouble> = at.into_iter().map(DoubleDouble::from).collect();
    let mut found = vec![DoubleDouble::ZERO; plain.len()];
    precise.expand(&at, order, &mut found).unwrap();
    for (i, (&plain, found)) in plain.iter().zip(&found).enumerate() {
        let error = (found.high() - plain).abs() / (1.0 + plain.abs());
        assert!(error < 1e-12, "{i}: {plain:e} {error:e}");
    }
}

#[test]
fn constants_and_parameters_are_exact() {
    let g = Graph::new();
    let (t, p) = (g.intern_symbol("t", 0), g.intern_symbol("p", 0));
    // 1/10 as a constant, and π, less the same as a parameter.
    let tenth = rational::ratio(1, 10).unwrap();
    let e = g.sub(g.mul(&[g.number(tenth.clone()), g.pi()]), g.symbol_expr(p));
    let mut found = PreciseProgram::new(&program(&g, &[e], t, p)).unwrap();
    let parameter = from_rational(&tenth) * DoubleDouble::PI;
    found.prepare(&[parameter]).unwrap();
    let zero = DoubleDouble::ZERO;
    assert!(found.evaluate(&[zero, zero]).unwrap()[0].abs().high() < 1e-31);
    found
        .prepare(&[DoubleDouble::from(0.1) * DoubleDouble::PI])
        .unwrap();
    let off = found.evaluate(&[zero, zero]).unwrap()[0].abs().high();
    // The double next to 1/10 is off by 5.55e-18.
    assert!((off / (5.551115123125783e-18 * std::f64::consts::PI) - 1.0).abs() < 1e-9);
}

#[test]
fn what_has_no_series_or_solution_says_so() {
    use chetaev_compile::EvaluateFailure;
    let g = Graph::new();
    let (t, p) = (g.intern_symbol("t", 0), g.intern_symbol("p", 0));
    let root = g.pow(g.symbol_expr(t), g.number(rational::ratio(1, 2).unwrap()));
    let mut taylor = PreciseTaylor::new(&program(&g, &[root], t, p)).unwrap();
    let zero = DoubleDouble::ZERO;
    let mut coefficients = [zero; 3];
    let early = taylor.expand(&[zero, zero], 2, &mut coefficients);
    assert_eq!(early, Err(EvaluateFailure::NotPrepared));
    taylor.prepare(&[zero]).unwrap();
    let failure = taylor.expand(&[zero, zero], 2, &mut coefficients);
    assert!(
        matches!(
            failure,
            Err(EvaluateFailure::NotAnalytic {
                operation: "sqrt",
                ..
            })
        ),
        "{failure:?}"
    );
    let x = g.symbol_expr(t);
    let matrix = [x, g.one(), g.one(), x];
    let singular = g.solve(&matrix, &[g.one(), x]).unwrap();
    let mut solve = PreciseProgram::new(&program(&g, &singular, t, p)).unwrap();
    solve.prepare(&[zero]).unwrap();
    let one = DoubleDouble::ONE;
    let failure = solve.evaluate(&[one, zero, zero]).map(<[_]>::to_vec);
    assert!(
        matches!(failure, Err(EvaluateFailure::Singular { .. })),
        "{failure:?}"
    );
    // A pivot of 10⁻²⁰ is no zero here, as it is in doubles.
    let near = one + DoubleDouble::from(1e-20);
    assert!(solve.evaluate(&[near, zero, zero]).is_ok());
}
