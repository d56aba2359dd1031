//! Random expressions: the interpreters against the evaluation of the graph, which shares no code with them, and
//! native code against the interpreters.
#![allow(clippy::unwrap_used)] // A failure here is a failed test.

use chetaev_compile::{BlockEvaluator, Evaluator, Interpreter, Lanes, Lowering, Program, LANES};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Function, Graph, Symbol};

/// A linear congruential generator (Knuth 1997, 3.3.4, MMIX), so that a failing seed can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n
    }

    fn unit(&mut self) -> f64 {
        self.below(1 << 24) as f64 / f64::from(1 << 24)
    }
}

struct Sample {
    graph: Graph,
    variables: Vec<Symbol>,
    parameters: Vec<Symbol>,
    roots: Vec<Expr>,
}

/// Functions defined and tame everywhere.
const TAME: [Function; 9] = [
    Function::Sin,
    Function::Cos,
    Function::Atan,
    Function::Tanh,
    Function::Asinh,
    Function::Abs,
    Function::Sec,
    Function::Tan,
    Function::Sin,
];

fn sample(seed: u64, size: usize) -> Sample {
    let mut random = Random(seed);
    let graph = Graph::new();
    let symbols = |names: &[&str]| -> Vec<Symbol> {
        names
            .iter()
            .map(|name| graph.intern_symbol(name, 0))
            .collect()
    };
    let variables = symbols(&["x", "y", "z", "u", "v"]);
    let parameters = symbols(&["m", "a", "g"]);
    let mut pool: Vec<Expr> = variables
        .iter()
        .chain(&parameters)
        .map(|&s| graph.symbol_expr(s))
        .collect();
    pool.push(graph.pi());
    for _ in 0..size {
        let e = grow(&graph, &mut random, &pool);
        pool.extend(e);
    }
    let roots = pool.split_off(pool.len() - size.min(12));
    Sample {
        graph,
        variables,
        parameters,
        roots,
    }
}

fn grow(g: &Graph, random: &mut Random, pool: &[Expr]) -> Vec<Expr> {
    let pick = |random: &mut Random| pool[random.below(pool.len())];
    let number = |random: &mut Random| {
        let numerator = random.below(13) as i64 - 6;
        g.number(ratio(numerator, 1 + random.below(5) as i64).unwrap())
    };
    let positive = |e: Expr| g.add(&[g.integer(1), g.powi(e, 2)]);
    vec![match random.below(9) {
        0 | 1 => {
            let count = 2 + random.below(12);
            let terms: Vec<Expr> = (0..count)
                .map(|_| g.mul(&[number(random), pick(random), g.sin(pick(random))]))
                .collect();
            g.add(&terms)
        }
        2 | 3 => g.mul(&[
            number(random),
            pick(random),
            pick(random),
            g.cos(pick(random)),
        ]),
        4 => g.div(pick(random), positive(pick(random))),
        5 => {
            let exponent = ratio(random.below(9) as i64 - 4, 2).unwrap();
            g.pow(positive(pick(random)), g.number(exponent))
        }
        6 => {
            let exponent = g.number(ratio(random.below(7) as i64 - 3, 3).unwrap());
            g.mul(&[pick(random), g.pow(positive(pick(random)), exponent)])
        }
        7 => {
            let argument = g.apply(Function::Tanh, &[pick(random)]);
            g.apply(TAME[random.below(TAME.len())], &[argument])
        }
        _ => return solve(g, random, pool),
    }]
}

/// A system with a dominant diagonal; half of them symmetric.
fn solve(g: &Graph, random: &mut Random, pool: &[Expr]) -> Vec<Expr> {
    let n = 2 + random.below(4);
    let is_symmetric = random.below(2) == 0;
    let small = |random: &mut Random| g.sin(pool[random.below(pool.len())]);
    let mut entries = vec![g.zero(); n * n];
    for i in 0..n {
        for j in 0..n {
            if i == j {
                entries[i * n + j] = g.add(&[g.integer(n as i64 + 1), small(random)]);
            } else if is_symmetric && j < i {
                entries[i * n + j] = entries[j * n + i];
            } else {
                entries[i * n + j] = small(random);
            }
        }
    }
    let rhs: Vec<Expr> = (0..n).map(|_| pool[random.below(pool.len())]).collect();
    g.solve(&entries, &rhs).unwrap()
}

fn lowering(sample: &Sample) -> Lowering<'_> {
    Lowering::new(&sample.graph)
        .variables(&sample.variables)
        .parameters(&sample.parameters)
}

fn point(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| 2.0 * random.unit() - 0.7).collect()
}

fn values(interpreter: &dyn Evaluator, parameters: &[f64], variables: &[f64]) -> Vec<f64> {
    let mut workspace = interpreter.workspace();
    interpreter.prepare(parameters, &mut workspace).unwrap();
    let mut outputs = vec![0.0; interpreter.program().output_count()];
    interpreter
        .evaluate(variables, &mut workspace, &mut outputs)
        .unwrap();
    outputs
}

#[test]
fn the_interpreter_agrees_with_the_graph() {
    for seed in 0..400 {
        let sample = sample(seed, 4 + (seed as usize % 60));
        let program = lowering(&sample)
            .output("f", &sample.roots)
            .positive_definite(&sample.roots)
            .lower()
            .unwrap();
        let interpreter = Interpreter::new(program).unwrap();
        let mut random = Random(seed + 1000);
        let parameters = point(&mut random, sample.parameters.len());
        let variables = point(&mut random, sample.variables.len());
        let at = |scale: f64| {
            let point = |s| {
                let find = |list: &[Symbol]| list.iter().position(|&t| t == s);
                find(&sample.variables)
                    .map(|i| variables[i] * scale)
                    .or_else(|| find(&sample.parameters).map(|i| parameters[i]))
            };
            sample.graph.evaluate_f64(&sample.roots, &point).unwrap()
        };
        let expected = at(1.0);
        // What a relative change of 1e-13 in the variables does bounds what rounding may do.
        let perturbed = at(1.0 + 1e-13);
        let found = values(&interpreter, &parameters, &variables);
        for (i, (e, f)) in expected.iter().zip(&found).enumerate() {
            let tolerance = 1e-11 * e.abs().max(1.0) + 10.0 * (e - perturbed[i]).abs();
            let agree = (e - f).abs() <= tolerance || e.to_bits() == f.to_bits();
            assert!(agree, "seed {seed}, output {i}: {e} {f}");
        }
    }
}

/// Native code with all vectors that this machine has.
#[cfg(all(unix, target_arch = "x86_64"))]
fn natives(program: &Program) -> Vec<chetaev_compile::Native> {
    use chetaev_compile::{Native, Vectors};
    let of = |vectors| Native::with_vectors(program.clone(), vectors).unwrap();
    let all = [Vectors::Avx2, Vectors::Avx512];
    all.into_iter().filter_map(of).collect()
}

#[cfg(not(all(unix, target_arch = "x86_64")))]
fn natives(_: &Program) -> Vec<Interpreter> {
    Vec::new()
}

/// Native code if this machine runs it.
#[cfg(all(unix, target_arch = "x86_64"))]
fn native(program: &Program) -> Option<chetaev_compile::Native> {
    chetaev_compile::Native::new(program.clone()).unwrap()
}

#[cfg(not(all(unix, target_arch = "x86_64")))]
fn native(_: &Program) -> Option<Interpreter> {
    None
}

#[test]
fn native_code_agrees_with_the_interpreter() {
    let mut compared = 0;
    for seed in 0..400 {
        let sample = sample(seed, 4 + (seed as usize * 3 % 200));
        let program = lowering(&sample)
            .output("f", &sample.roots)
            .positive_definite(&sample.roots)
            .lower()
            .unwrap();
        let Some(native) = native(&program) else {
            return;
        };
        let interpreter = Interpreter::new(program).unwrap();
        let mut random = Random(seed + 1000);
        let parameters = point(&mut random, sample.parameters.len());
        let variables = point(&mut random, sample.variables.len());
        let scaled = |scale: f64| -> Vec<f64> { variables.iter().map(|x| x * scale).collect() };
        let expected = values(&interpreter, &parameters, &variables);
        // What relative changes in the last places of the variables do bounds what rounding may do.
        let nudges = [1.0 + 1e-14, 1.0 - 1e-14, 1.0 + 3e-14];
        let nudged = nudges.map(|nudge| values(&interpreter, &parameters, &scaled(nudge)));
        let found = values(&native, &parameters, &variables);
        for (i, (e, f)) in expected.iter().zip(&found).enumerate() {
            let change = nudged.iter().map(|n| (n[i] - e).abs()).fold(0.0, f64::max);
            let tolerance = 1e-13 * e.abs().max(1.0) + 10.0 * change;
            let agree = (e - f).abs() <= tolerance || e.to_bits() == f.to_bits();
            assert!(agree, "seed {seed}, output {i}: {e} {f}");
            compared += 1;
        }
    }
    assert!(compared > 3_000);
}

#[test]
fn a_block_computes_bit_for_bit_what_single_states_compute() {
    for seed in 0..60 {
        let sample = sample(seed, 50);
        let program = lowering(&sample)
            .output("f", &sample.roots)
            .positive_definite(&sample.roots[..6])
            .lower()
            .unwrap();
        for native in natives(&program) {
            compare_block_with_states(seed, &sample, &native);
        }
        compare_block_with_states(seed, &sample, &Interpreter::new(program).unwrap());
    }
}

fn compare_block_with_states(
    seed: u64,
    sample: &Sample,
    interpreter: &(impl Evaluator + BlockEvaluator),
) {
    let mut random = Random(seed + 5);
    let states: Vec<(Vec<f64>, Vec<f64>)> = (0..LANES)
        .map(|_| {
            let parameters = point(&mut random, sample.parameters.len());
            // Far apart, so that states differ in pivots and in quadrants.
            let mut variables = point(&mut random, sample.variables.len());
            variables.iter_mut().for_each(|x| *x *= 7.0);
            (parameters, variables)
        })
        .collect();
    let lanes = |count: usize, value: &dyn Fn(usize, usize) -> f64| -> Vec<Lanes> {
        (0..count)
            .map(|i| Lanes::from_fn(|l| value(l, i)))
            .collect()
    };
    let parameters = lanes(sample.parameters.len(), &|l, i| states[l].0[i]);
    let variables = lanes(sample.variables.len(), &|l, i| states[l].1[i]);
    let mut workspace = interpreter.block_workspace();
    let mut outputs = vec![Lanes::default(); sample.roots.len()];
    interpreter
        .prepare_block(&parameters, &mut workspace)
        .unwrap();
    interpreter
        .evaluate_block(1, &variables, &mut workspace, &mut outputs)
        .unwrap();
    assert!(workspace.failures().is_empty());
    for (l, (parameters, variables)) in states.iter().enumerate() {
        let single = values(interpreter, parameters, variables);
        for (output, single) in outputs.iter().zip(single) {
            assert_eq!(
                output.as_slice()[l].to_bits(),
                single.to_bits(),
                "seed {seed}"
            );
        }
    }
}

#[test]
fn the_order_of_unrelated_outputs_does_not_change_values() {
    for seed in 0..60 {
        let sample = sample(seed, 40);
        let mut reversed = sample.roots.clone();
        reversed.reverse();
        let run = |roots: &[Expr]| {
            let program = lowering(&sample).output("f", roots).lower().unwrap();
            let interpreter = Interpreter::new(program).unwrap();
            values(&interpreter, &[0.3, 1.2, 0.9], &[0.1, -0.4, 0.7, 1.1, 0.6])
        };
        let (forward, mut backward) = (run(&sample.roots), run(&reversed));
        backward.reverse();
        let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
        assert_eq!(bits(forward), bits(backward), "seed {seed}");
    }
}

#[test]
fn lowering_does_not_depend_on_the_history_of_the_graph() {
    let build = |is_reversed: bool| {
        let g = Graph::new();
        let mut names = ["x", "y", "m"];
        if is_reversed {
            names.reverse();
            g.sin(g.add(&[g.symbol("y", 0), g.symbol("m", 0)]));
        }
        names.iter().for_each(|name| _ = g.symbol(name, 0));
        let (x, y, m) = (g.symbol("x", 0), g.symbol("y", 0), g.symbol("m", 0));
        let energy = g.add(&[
            g.mul(&[m, g.powi(x, 2), g.cos(y)]),
            g.div(g.sin(g.add(&[y, m])), g.add(&[x, y])),
        ]);
        let symbol = |e| g.as_symbol(e).unwrap();
        let program = Lowering::new(&g)
            .variables(&[symbol(x), symbol(y)])
            .parameters(&[symbol(m)])
            .output("energy", &[energy, g.sin(y)])
            .lower()
            .unwrap();
        program.to_string()
    };
    assert_eq!(build(false), build(true));
}

#[test]
fn a_large_program_reuses_its_registers() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let y = g.symbol("y", 0);
    // A chain with ever more values alive at once, summed at the end.
    let mut e = x;
    let mut alive = Vec::new();
    for i in 0..60_000 {
        // A product of sums is not expanded, so the graph grows by a few nodes each time.
        e = g.add(&[
            g.mul(&[g.number(ratio(1, 2).unwrap()), g.sin(e)]),
            g.mul(&[y, e, x]),
            g.integer(i % 7),
        ]);
        if i % 600 == 0 {
            alive.push(g.mul(&[e, y]));
        }
    }
    alive.push(e);
    let total = g.add(&alive);
    let symbols = [g.as_symbol(x).unwrap(), g.as_symbol(y).unwrap()];
    let program = Lowering::new(&g)
        .variables(&symbols)
        .output("total", &[total])
        .output("last", &[e, alive[3]])
        .lower()
        .unwrap();
    assert!(program.body.len() > 100_000);
    let native = native(&program);
    assert!(
        program.layout.temporaries < 400,
        "{}",
        program.layout.temporaries
    );
    let interpreter = Interpreter::new(program).unwrap();
    let found = values(&interpreter, &[], &[0.3, -0.8]);
    let expected = g
        .evaluate_f64(&[total, e, alive[3]], &|s| {
            Some(if s == symbols[0] { 0.3 } else { -0.8 })
        })
        .unwrap();
    for (e, f) in expected.iter().zip(&found) {
        assert!((e - f).abs() <= 1e-11 * e.abs(), "{e} {f}");
    }
    if let Some(native) = native {
        let found = values(&native, &[], &[0.3, -0.8]);
        for (e, f) in expected.iter().zip(&found) {
            assert!((e - f).abs() <= 1e-11 * e.abs(), "{e} {f}");
        }
    }
}
