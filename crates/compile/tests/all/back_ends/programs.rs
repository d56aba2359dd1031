// What lowering produces, read in the text form; groups, lengths, and what is refused.

use chetaev_compile::program::{Binary, Instruction, Unary};
use chetaev_compile::{
    Backend, EvaluateFailure, Evaluator, LowerError, Lowering, Program, VerifyError,
};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Function, Graph, Symbol};

fn symbols(g: &Graph, names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|name| g.intern_symbol(name, 0)).collect()
}

/// Lowers outputs of x, y, z with parameters m, k.
fn lower(g: &Graph, outputs: &[Expr]) -> Program {
    let program = Lowering::new(g)
        .variables(&symbols(g, &["x", "y", "z"]))
        .parameters(&symbols(g, &["m", "k"]))
        .output("f", outputs)
        .lower()
        .unwrap();
    program.verify().unwrap();
    program
}

fn body(program: &Program) -> Vec<String> {
    section(program, "body")
}

fn section(program: &Program, name: &str) -> Vec<String> {
    let text = program.to_string();
    let lines = text.lines().skip_while(|line| *line != name).skip(1);
    let lines = lines.take_while(|line| line.starts_with("  "));
    lines.map(|line| line.trim().to_string()).collect()
}

fn evaluate(program: &Program, parameters: &[f64], variables: &[f64]) -> Vec<f64> {
    let interpreter = make(program.clone());
    let mut workspace = interpreter.workspace();
    interpreter.prepare(parameters, &mut workspace).unwrap();
    let mut outputs = vec![0.0; program.output_count()];
    interpreter
        .evaluate(variables, &mut workspace, &mut outputs)
        .unwrap();
    outputs
}

fn xyz(g: &Graph) -> (Expr, Expr, Expr) {
    (g.symbol("x", 0), g.symbol("y", 0), g.symbol("z", 0))
}

#[test]
fn the_text_form_shows_everything() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let (m, k) = (g.symbol("m", 0), g.symbol("k", 0));
    let force = g.mul(&[g.integer(-3), k, g.powi(m, -1), x]);
    let solution = g.solve(&[m, x, x, g.integer(2)], &[g.one(), x]).unwrap();
    let program = Lowering::new(&g)
        .variables(&symbols(&g, &["x"]))
        .parameters(&symbols(&g, &["m", "k"]))
        .output("force", &[force])
        .output("angle", &[g.sin(x), g.cos(x), g.pi()])
        .output("solution", &solution)
        .positive_definite(&solution)
        .lower()
        .unwrap();
    let expected = "\
constant c0 = -3
constant c1 = pi
constant c2 = 2
constant c3 = 1
parameter p0 = m
parameter p1 = k
variable x0 = x
prologue
  t0 = p1 * c0
  h0 = t0 / p0
body
  t0 = x0 * h0
  output force = t0
  t0 t1 = sincos x0
  output angle = t0 t1 c1
  A0 = ldlt [p0 x0; x0 c2]
  t1 t0 = solve A0 [c3 x0]
  output solution = t1 t0
";
    assert_eq!(program.to_string(), expected);
}

#[test]
fn common_subexpressions_are_computed_once() {
    let g = Graph::new();
    let (x, y, z) = xyz(&g);
    let shared = g.sin(g.mul(&[x, y]));
    let program = lower(
        &g,
        &[g.mul(&[shared, z]), g.add(&[shared, z]), g.powi(shared, 2)],
    );
    let lines = body(&program);
    assert_eq!(lines.iter().filter(|line| line.contains("sin ")).count(), 1);
    assert_eq!(lines.len(), 6, "{lines:?}");
}

#[test]
fn products_of_parameters_leave_one_multiplication() {
    let g = Graph::new();
    let (x, y, _) = xyz(&g);
    let (m, k) = (g.symbol("m", 0), g.symbol("k", 0));
    let coefficient = g.mul(&[
        g.integer(2),
        g.powi(m, 3),
        g.sqrt(k),
        g.powi(g.add(&[m, k]), -1),
    ]);
    let program = lower(&g, &[g.mul(&[coefficient, x]), g.mul(&[coefficient, y])]);
    assert_eq!(body(&program).len(), 3, "{program}");
    assert_eq!(program.layout.hoisted, 1, "{program}");
}

#[test]
fn what_depends_on_parameters_only_is_not_in_the_body() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let (m, k) = (g.symbol("m", 0), g.symbol("k", 0));
    let constant = g.exp(g.add(&[g.sin(m), g.mul(&[k, g.cos(m)])]));
    let program = lower(
        &g,
        &[g.add(&[g.mul(&[x, constant]), constant, m, g.integer(5)])],
    );
    assert_eq!(body(&program).len(), 2, "{program}");
    let program = lower(&g, &[constant]);
    assert_eq!(body(&program), ["output f = h0"]);
}

#[test]
fn negative_powers_are_one_division() {
    let g = Graph::new();
    let (x, y, z) = xyz(&g);
    let quotient = g.mul(&[
        x,
        g.powi(y, -2),
        g.powi(g.sin(z), -1),
        g.pow(z, g.number(ratio(-1, 2).unwrap())),
    ]);
    let program = lower(&g, &[quotient]);
    let divisions = body(&program)
        .iter()
        .filter(|line| line.contains(" / "))
        .count();
    assert_eq!(divisions, 1, "{program}");
    let value = evaluate(&program, &[1.0, 1.0], &[3.0, 2.0, 0.25]);
    assert!((value[0] - 3.0 / (4.0 * 0.25f64.sin() * 0.5)).abs() < 1e-14);
}

#[test]
fn a_reciprocal_used_often_is_computed_once() {
    let g = Graph::new();
    let (x, y, z) = xyz(&g);
    let below = g.powi(g.add(&[x, y]), -1);
    let program = lower(
        &g,
        &[g.mul(&[x, below]), g.mul(&[y, below]), g.mul(&[z, below])],
    );
    let divisions = body(&program)
        .iter()
        .filter(|line| line.contains(" / "))
        .count();
    assert_eq!(divisions, 1, "{program}");
}

#[test]
fn powers_are_chains() {
    let g = Graph::new();
    let (x, _, _) = xyz(&g);
    for (numerator, denominator, instructions) in [
        (2, 1, 1),
        (3, 1, 2),
        (8, 1, 3),
        (-1, 1, 1),
        (-4, 1, 3),
        (1, 2, 1),
        (3, 2, 2),
        (-3, 2, 3),
        (1, 3, 1),
        (65, 1, 1),
    ] {
        let exponent = ratio(numerator, denominator).unwrap();
        let program = lower(&g, &[g.pow(x, g.number(exponent))]);
        assert_eq!(body(&program).len(), instructions + 1, "{program}");
        let expected = 1.7f64.powf(numerator as f64 / denominator as f64);
        let found = evaluate(&program, &[0.0, 0.0], &[1.7, 0.0, 0.0])[0];
        assert!(
            (found / expected - 1.0).abs() < 1e-14,
            "{numerator}/{denominator}"
        );
    }
}

#[test]
fn quotients_of_sine_and_cosine_share_them() {
    let g = Graph::new();
    let (x, _, _) = xyz(&g);
    let functions = [Function::Tan, Function::Cot, Function::Sec, Function::Csc];
    let outputs: Vec<Expr> = functions.iter().map(|&f| g.apply(f, &[x])).collect();
    let program = lower(&g, &outputs);
    assert_eq!(body(&program).len(), 1 + 4 + 1, "{program}");
    let found = evaluate(&program, &[0.0, 0.0], &[0.8, 0.0, 0.0]);
    let (sin, cos) = 0.8f64.sin_cos();
    for (found, expected) in found
        .iter()
        .zip([sin / cos, cos / sin, 1.0 / cos, 1.0 / sin])
    {
        assert!((found - expected).abs() < 1e-15);
    }
}

#[test]
fn sums_use_fused_products() {
    let g = Graph::new();
    let (x, y, z) = xyz(&g);
    let sum = g.add(&[
        g.mul(&[x, y]),
        g.neg(g.mul(&[y, z])),
        g.mul(&[g.integer(-2), x]),
        z,
    ]);
    let program = lower(&g, &[sum]);
    assert_eq!(body(&program).len(), 3 + 1, "{program}");
    assert_eq!(
        evaluate(&program, &[0.0, 0.0], &[3.0, 5.0, 7.0]),
        [15.0 - 35.0 - 6.0 + 7.0]
    );
    let negative = g.sub(g.mul(&[g.integer(-1), x, y]), z);
    let found = evaluate(&lower(&g, &[negative]), &[0.0, 0.0], &[3.0, 5.0, 7.0]);
    assert_eq!(found, [-22.0]);
}

#[test]
fn the_first_groups_are_evaluated_alone() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    // The second group is singular at x = 1 and must not matter to the first.
    let bad = g.solve(&[x, g.one(), g.one(), x], &[x, g.one()]).unwrap();
    let program = Lowering::new(&g)
        .variables(&symbols(&g, &["x"]))
        .output("rate", &[g.powi(x, 2)])
        .output("reaction", &bad)
        .lower()
        .unwrap();
    assert_eq!(program.group("reaction"), Some((1, 1..3)));
    assert_eq!(program.group("energy"), None);
    let interpreter = make(program);
    let mut workspace = interpreter.workspace();
    interpreter.prepare(&[], &mut workspace).unwrap();
    let mut rate = [0.0];
    interpreter
        .evaluate_groups(1, &[1.0], &mut workspace, &mut rate)
        .unwrap();
    assert_eq!(rate, [1.0]);
    let all = interpreter.evaluate(&[1.0], &mut workspace, &mut [0.0; 3]);
    assert!(matches!(all, Err(EvaluateFailure::Singular { .. })));
    // A failure is not remembered.
    let mut all = [0.0; 3];
    interpreter
        .evaluate(&[3.0], &mut workspace, &mut all)
        .unwrap();
    assert_eq!(all[..2], [9.0, 1.0]);
    assert!(all[2].abs() < 1e-15, "{}", all[2]);
}

#[test]
fn misuse_is_an_error() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let interpreter = make(lower(&g, &[x]));
    let mut workspace = interpreter.workspace();
    let unprepared = interpreter.evaluate(&[1.0; 3], &mut workspace, &mut [0.0]);
    assert_eq!(unprepared, Err(EvaluateFailure::NotPrepared));
    let length = |what, expected, found| {
        Err(EvaluateFailure::Length {
            what,
            expected,
            found,
        })
    };
    assert_eq!(
        interpreter.prepare(&[1.0], &mut workspace),
        length("parameters", 2, 1)
    );
    interpreter.prepare(&[1.0, 1.0], &mut workspace).unwrap();
    let short = interpreter.evaluate(&[1.0; 2], &mut workspace, &mut [0.0]);
    assert_eq!(short, length("variables", 3, 2));
    let short = interpreter.evaluate(&[1.0; 3], &mut workspace, &mut []);
    assert_eq!(short, length("outputs", 1, 0));
    let other = make(lower(&g, &[g.sin(x)]));
    let foreign = other.evaluate(&[1.0; 3], &mut workspace, &mut [0.0]);
    assert_eq!(foreign, Err(EvaluateFailure::NotPrepared));
}

#[test]
fn symbols_must_be_bound_once() {
    let g = Graph::new();
    let w = g.symbol("w", 2);
    let lowering = Lowering::new(&g)
        .variables(&symbols(&g, &["x"]))
        .output("f", &[w]);
    assert_eq!(
        lowering.lower(),
        Err(LowerError::Unbound("w''".to_string()))
    );
    let twice = Lowering::new(&g)
        .variables(&symbols(&g, &["x"]))
        .parameters(&symbols(&g, &["x"]));
    assert_eq!(twice.lower(), Err(LowerError::Duplicate("x".to_string())));
    let matrix = g.matrix(1, 1, &[w]).unwrap();
    let not_scalar = Lowering::new(&g)
        .variables(&[g.as_symbol(w).unwrap()])
        .output("f", &[w, matrix]);
    let expected = LowerError::NotScalar {
        group: "f".to_string(),
        index: 1,
    };
    assert_eq!(not_scalar.lower(), Err(expected));
}

#[test]
fn a_program_that_is_not_well_formed_is_refused() {
    let g = Graph::new();
    let (x, y, z) = xyz(&g);
    let solution = g.solve(&[x, y, y, z], &[x, g.sin(x)]).unwrap();
    let program = lower(&g, &[solution[0], g.mul(&[g.cos(y), g.symbol("m", 0), z])]);
    let refused = |change: &dyn Fn(&mut Program)| {
        let mut program = program.clone();
        change(&mut program);
        Backend::interpreter(program).err().unwrap()
    };
    let is_factor = |i: &Instruction| matches!(i, Instruction::Factor { .. });
    assert!(matches!(
        refused(&|p| p.layout.temporaries -= 1),
        VerifyError::OutOfRange { .. }
    ));
    assert!(matches!(
        refused(&|p| p.body.reverse()),
        VerifyError::Undefined { .. } | VerifyError::FactorOrder(_)
    ));
    assert!(matches!(
        refused(&|p| {
            p.body.retain(|i| !is_factor(i));
            p.outputs[0].end -= 1;
        }),
        VerifyError::FactorOrder(_)
    ));
    assert!(matches!(
        refused(&|p| p.outputs[0].end += 1),
        VerifyError::GroupOrder(_)
    ));
    assert!(matches!(
        refused(&|p| p.layout.constants += 1),
        VerifyError::Layout { .. }
    ));
    assert!(matches!(
        refused(&|p| p.matrices[0].size = 3),
        VerifyError::System(_)
    ));
    assert!(matches!(
        refused(&|p| p.solves.clear()),
        VerifyError::System(_)
    ));
    assert!(matches!(
        refused(&|p| _ = p.solves[0].out.pop()),
        VerifyError::System(_)
    ));
    let tangent = |p: &mut Program| {
        for instruction in &mut p.body {
            if let Instruction::Unary { operation, .. } = instruction {
                *operation = Unary::Function(Function::Tan);
            }
        }
    };
    assert!(matches!(
        refused(&tangent),
        VerifyError::NotAnInstruction { .. }
    ));
    let overwrite = |p: &mut Program| {
        let x = p.matrices[0].entries[0];
        p.body.push(Instruction::Binary {
            operation: Binary::Add,
            out: x,
            a: x,
            b: x,
        });
        p.outputs[0].end += 1;
    };
    assert!(matches!(refused(&overwrite), VerifyError::ReadOnly { .. }));
}

#[test]
fn a_long_chain_needs_no_stack() {
    let g = Graph::new();
    let (x, y, _) = xyz(&g);
    let mut e = x;
    for _ in 0..200_000 {
        e = g.add(&[g.mul(&[y, g.sin(e)]), g.one()]);
    }
    let program = lower(&g, &[e]);
    assert_eq!(program.body.len(), 400_000);
    assert!(program.layout.temporaries <= 2);
}
