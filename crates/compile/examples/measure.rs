//! Measures lowering and evaluation: `cargo run --release -p chetaev-compile --example measure`.
//!
//! Right-hand sides are derived here from Lagrangian and constraints in two forms, reduced by the admissible
//! directions and with multipliers. Times are in nanoseconds per state: medians of rounds in which every back end
//! has its turn. gcc compiles the same program, with systems written out, and the sines of the C library.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // A program for people to read from.
#![allow(clippy::needless_range_loop)] // Matrices read best with their indices.

use chetaev_compile::program::{Binary, Factorization, Fused, Instruction, Register, Unary};
use chetaev_compile::{
    BlockEvaluator, Evaluator, Interpreter, Lanes, Lowering, Native, Program, LANES,
};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

struct Model {
    name: String,
    graph: Graph,
    coordinates: Vec<Symbol>,
    velocities: Vec<Symbol>,
    parameters: Vec<Symbol>,
    /// L = T − V.
    lagrangian: Expr,
    /// Constraints linear in the velocities, solved for the last ones: v_d = slope · v_i.
    slopes: Vec<Vec<Expr>>,
}

impl Model {
    fn new(name: &str, coordinates: &[String], parameters: &[&str]) -> Model {
        let graph = Graph::new();
        let symbols = |order| -> Vec<Symbol> {
            let symbols = coordinates.iter().map(|c| graph.intern_symbol(c, order));
            symbols.collect()
        };
        Model {
            name: name.to_string(),
            coordinates: symbols(0),
            velocities: symbols(1),
            parameters: parameters
                .iter()
                .map(|p| graph.intern_symbol(p, 0))
                .collect(),
            lagrangian: graph.zero(),
            slopes: Vec::new(),
            graph,
        }
    }

    fn time_derivative(&self, e: Expr) -> Expr {
        self.graph.total_derivative(e, &|name| {
            let is = |s: &Symbol| self.graph.symbol_name(*s) == name;
            self.coordinates.iter().any(is)
        })
    }

    fn independent(&self) -> usize {
        self.velocities.len() - self.slopes.len()
    }

    /// Variables: coordinates and independent velocities. Outputs: their rates.
    fn reduced(&self) -> (Vec<Symbol>, Vec<Expr>) {
        let g = &self.graph;
        let (n, k) = (self.velocities.len(), self.independent());
        let basis = |i: usize, s: usize| match i.checked_sub(k) {
            Some(d) => self.slopes[d][s],
            None if i == s => g.one(),
            None => g.zero(),
        };
        let dot = |a: &dyn Fn(usize) -> Expr, b: &dyn Fn(usize) -> Expr| {
            let terms: Vec<Expr> = (0..n).map(|i| g.mul(&[a(i), b(i)])).collect();
            g.add(&terms)
        };
        let (mass, force) = self.mass_and_force();
        let velocity: Vec<Expr> = (0..n)
            .map(|i| {
                let terms: Vec<Expr> = (0..k)
                    .map(|s| g.mul(&[basis(i, s), g.symbol_expr(self.velocities[s])]))
                    .collect();
                g.add(&terms)
            })
            .collect();
        // Accelerations at rest of the independent ones: the slopes' own rate times the velocities.
        let drift: Vec<Expr> = (0..n)
            .map(|i| {
                let terms: Vec<Expr> = (0..k)
                    .map(|s| {
                        let rate = self.time_derivative(basis(i, s));
                        g.mul(&[rate, g.symbol_expr(self.velocities[s])])
                    })
                    .collect();
                g.add(&terms)
            })
            .collect();
        let residual: Vec<Expr> = (0..n)
            .map(|i| g.sub(force[i], dot(&|j| mass[i][j], &|j| drift[j])))
            .collect();
        let mut entries = Vec::new();
        for s in 0..k {
            let row: Vec<Expr> = (0..n)
                .map(|j| dot(&|i| basis(i, s), &|i| mass[i][j]))
                .collect();
            entries.extend((0..k).map(|u| dot(&|j| row[j], &|j| basis(j, u))));
        }
        for s in 0..k {
            for u in 0..s {
                entries[s * k + u] = entries[u * k + s];
            }
        }
        let rhs: Vec<Expr> = (0..k)
            .map(|s| dot(&|i| basis(i, s), &|i| residual[i]))
            .collect();
        let rates = g.solve(&entries, &rhs).unwrap();
        let outputs: Vec<Expr> = velocity.iter().copied().chain(rates).collect();
        let dependent: Vec<(Expr, Expr)> = (k..n)
            .map(|i| (g.symbol_expr(self.velocities[i]), velocity[i]))
            .collect();
        let outputs = g.substitute_all(&outputs, &dependent);
        let variables = self.coordinates.iter().chain(&self.velocities[..k]);
        (variables.copied().collect(), outputs)
    }

    /// ∂²L/∂v∂v and b of M a = b + Jᵀ λ.
    fn mass_and_force(&self) -> (Vec<Vec<Expr>>, Vec<Expr>) {
        let g = &self.graph;
        let momenta = g.gradient(self.lagrangian, &self.velocities);
        let mut mass = g.jacobian(&momenta, &self.velocities);
        for i in 0..mass.len() {
            for j in 0..i {
                mass[i][j] = mass[j][i];
            }
        }
        let by_position = g.gradient(self.lagrangian, &self.coordinates);
        let force = (0..momenta.len())
            .map(|i| {
                // The part of dp/dt that does not contain accelerations.
                let rate = g.jacobian(&[momenta[i]], &self.coordinates);
                let terms: Vec<Expr> = rate[0]
                    .iter()
                    .zip(&self.velocities)
                    .map(|(&c, &v)| g.mul(&[c, g.symbol_expr(v)]))
                    .collect();
                g.sub(by_position[i], g.add(&terms))
            })
            .collect();
        (mass, force)
    }

    /// Variables: coordinates and velocities. Outputs: accelerations and multipliers from the bordered system.
    fn bordered(&self) -> (Vec<Symbol>, Vec<Expr>) {
        let g = &self.graph;
        let (n, k) = (self.velocities.len(), self.independent());
        let r = n - k;
        let (mass, force) = self.mass_and_force();
        let border = |l: usize, i: usize| match i.checked_sub(k) {
            Some(d) if d == l => g.one(),
            Some(_) => g.zero(),
            None => g.neg(self.slopes[l][i]),
        };
        let mut entries = Vec::new();
        for i in 0..n {
            entries.extend_from_slice(&mass[i]);
            entries.extend((0..r).map(|l| g.neg(border(l, i))));
        }
        for l in 0..r {
            entries.extend((0..n).map(|i| border(l, i)));
            entries.extend((0..r).map(|_| g.zero()));
        }
        let mut rhs = force;
        for l in 0..r {
            let terms: Vec<Expr> = (0..n)
                .map(|i| {
                    let rate = self.time_derivative(border(l, i));
                    g.mul(&[rate, g.symbol_expr(self.velocities[i])])
                })
                .collect();
            rhs.push(g.neg(g.add(&terms)));
        }
        let outputs = g.solve(&entries, &rhs).unwrap();
        let variables = self.coordinates.iter().chain(&self.velocities);
        (variables.copied().collect(), outputs)
    }
}

/// A thin disc rolling on a plane: heading, lean, roll, contact point.
fn disc() -> Model {
    let names = ["phi", "theta", "psi", "x", "y"].map(String::from);
    let mut model = Model::new("disc", &names, &["m", "R", "g", "I1", "I3"]);
    let g = &model.graph;
    let s = |name: &str| g.symbol(name, 0);
    let v = |name: &str| g.symbol(name, 1);
    let half = g.number(ratio(1, 2).unwrap());
    let (phi, theta) = (s("phi"), s("theta"));
    let reach = g.mul(&[s("R"), g.sin(theta)]);
    let center = [
        g.add(&[s("x"), g.mul(&[reach, g.sin(phi)])]),
        g.sub(s("y"), g.mul(&[reach, g.cos(phi)])),
        g.mul(&[s("R"), g.cos(theta)]),
    ];
    let squares: Vec<Expr> = center
        .iter()
        .map(|&c| g.powi(model.time_derivative(c), 2))
        .collect();
    let spin = g.add(&[v("psi"), g.mul(&[v("phi"), g.sin(theta)])]);
    let tilt = g.add(&[
        g.powi(v("theta"), 2),
        g.powi(g.mul(&[v("phi"), g.cos(theta)]), 2),
    ]);
    let lagrangian = g.add(&[
        g.mul(&[half, s("m"), g.add(&squares)]),
        g.mul(&[half, s("I1"), tilt]),
        g.mul(&[half, s("I3"), g.powi(spin, 2)]),
        g.neg(g.mul(&[s("m"), s("g"), center[2]])),
    ]);
    let slopes = [g.cos(phi), g.sin(phi)]
        .iter()
        .map(|&c| vec![g.zero(), g.zero(), g.mul(&[s("R"), c])])
        .collect();
    model.lagrangian = lagrangian;
    model.slopes = slopes;
    model
}

/// A chain of links, each with a wheel at its middle that does not slip sideways. The angles are independent up to
/// two of them in general; here the links' wheels are free but for the last two, which keeps slopes short.
fn chain(links: usize) -> Model {
    let mut names: Vec<String> = (1..=links).map(|i| format!("theta_{i}")).collect();
    names.extend(["x".to_string(), "y".to_string()]);
    let mut model = Model::new(&format!("chain {links}"), &names, &["m", "J", "l", "k"]);
    let g = &model.graph;
    let s = |name: &str| g.symbol(name, 0);
    let half = g.number(ratio(1, 2).unwrap());
    let (mut x, mut y) = (s("x"), s("y"));
    let mut parts = Vec::new();
    let mut previous = None;
    for name in &names[..links] {
        let theta = s(name);
        let step = |f: Expr| g.mul(&[half, s("l"), f]);
        let middle = [
            g.add(&[x, step(g.cos(theta))]),
            g.add(&[y, step(g.sin(theta))]),
        ];
        for c in middle {
            parts.push(g.mul(&[half, s("m"), g.powi(model.time_derivative(c), 2)]));
        }
        let rate = model.time_derivative(theta);
        parts.push(g.mul(&[half, s("J"), g.powi(rate, 2)]));
        if let Some(previous) = previous {
            let bend = g.sub(theta, previous);
            parts.push(g.neg(g.mul(&[half, s("k"), g.powi(bend, 2)])));
        }
        previous = Some(theta);
        x = g.add(&[x, g.mul(&[s("l"), g.cos(theta)])]);
        y = g.add(&[y, g.mul(&[s("l"), g.sin(theta)])]);
    }
    let turn = |f: Expr| {
        let mut row = vec![g.zero(); links];
        row[0] = g.mul(&[s("l"), f]);
        row[1] = g.mul(&[half, s("l"), f]);
        row
    };
    let slopes = vec![turn(g.cos(s("theta_1"))), turn(g.sin(s("theta_1")))];
    let lagrangian = g.add(&parts);
    model.lagrangian = lagrangian;
    model.slopes = slopes;
    model
}

fn least(mut run: impl FnMut(), repeats: usize, runs: usize) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..runs {
        let start = Instant::now();
        for _ in 0..repeats {
            run();
        }
        best = best.min(start.elapsed().as_secs_f64() / repeats as f64);
    }
    best
}

/// Seconds per run of each contestant: medians over rounds in which each has its turn, so that what disturbs the
/// machine disturbs all.
fn medians(contestants: &mut [Box<dyn FnMut() -> f64 + '_>]) -> Vec<f64> {
    const ROUNDS: usize = 15;
    let mut times = vec![Vec::with_capacity(ROUNDS); contestants.len()];
    for _ in 0..ROUNDS {
        for (times, run) in times.iter_mut().zip(contestants.iter_mut()) {
            times.push(run());
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    };
    times.into_iter().map(median).collect()
}

/// Single states, one after the other.
fn single<'a>(
    evaluator: &'a dyn Evaluator,
    parameters: &[f64],
    point: &[f64],
    repeats: usize,
) -> Box<dyn FnMut() -> f64 + 'a> {
    let mut workspace = evaluator.workspace();
    evaluator.prepare(parameters, &mut workspace).unwrap();
    let mut values = vec![0.0; evaluator.program().output_count()];
    let point = point.to_vec();
    let mut run = move || {
        let point = std::hint::black_box(&point);
        evaluator
            .evaluate(point, &mut workspace, &mut values)
            .unwrap();
        std::hint::black_box(&values);
    };
    Box::new(move || least(&mut run, repeats, 8))
}

fn block<'a>(
    evaluator: &'a (impl Evaluator + BlockEvaluator),
    parameters: &[f64],
    point: &[f64],
    repeats: usize,
) -> Box<dyn FnMut() -> f64 + 'a> {
    let splat =
        |values: &[f64]| -> Vec<Lanes> { values.iter().map(|&v| Lanes::splat(v)).collect() };
    let mut workspace = evaluator.block_workspace();
    evaluator
        .prepare_block(&splat(parameters), &mut workspace)
        .unwrap();
    let point: Vec<Lanes> = point
        .iter()
        .map(|&v| Lanes::from_fn(|l| v * (1.0 + 0.01 * l as f64)))
        .collect();
    let groups = evaluator.program().outputs.len();
    let mut values = vec![Lanes::default(); evaluator.program().output_count()];
    let mut run = move || {
        let point = std::hint::black_box(&point);
        evaluator
            .evaluate_block(groups, point, &mut workspace, &mut values)
            .unwrap();
        std::hint::black_box(&values);
    };
    Box::new(move || least(&mut run, repeats.div_ceil(16), 8) / LANES as f64)
}

/// The program as C, compiled by gcc if there is one; running it prints the seconds per evaluation.
fn gcc(program: &Program, parameters: &[f64], point: &[f64], repeats: usize) -> Option<PathBuf> {
    // Pivots cannot be written out.
    if program
        .matrices
        .iter()
        .any(|m| m.factorization == Factorization::Lu)
    {
        return None;
    }
    let folder = std::env::temp_dir().join(format!("chetaev-measure-{}", std::process::id()));
    std::fs::create_dir_all(&folder).ok()?;
    let (source, binary) = (folder.join("body.c"), folder.join("body"));
    std::fs::write(&source, c_text(program, parameters, point, repeats)).ok()?;
    let status = Command::new("gcc")
        .args(["-O3", "-march=native", "-o"])
        .args([&binary, &source])
        .arg("-lm")
        .status()
        .ok()?;
    status.success().then_some(binary)
}

fn c_text(program: &Program, parameters: &[f64], point: &[f64], repeats: usize) -> String {
    let layout = program.layout;
    let interpreter = Interpreter::new(program.clone()).unwrap();
    let mut workspace = interpreter.workspace();
    interpreter.prepare(parameters, &mut workspace).unwrap();
    let mut expected = vec![0.0; program.output_count()];
    interpreter
        .evaluate(point, &mut workspace, &mut expected)
        .unwrap();
    // What depends on parameters is computed in front, as the prologue does.
    let mut prologue = String::new();
    let mut body = String::new();
    for &instruction in &program.prologue {
        c_instruction(program, instruction, &mut prologue);
    }
    for &instruction in &program.body {
        c_instruction(program, instruction, &mut body);
    }
    let outputs = program.outputs.iter().flat_map(|group| &group.registers);
    for (i, r) in outputs.enumerate() {
        body += &format!("out[{i}] = r{};\n", r.index());
    }
    let name = |i: usize| format!("r{i}");
    let all: Vec<String> = (0..layout.len()).map(name).collect();
    let mut constants = String::new();
    for (i, constant) in program.constants.iter().enumerate() {
        constants += &format!("#define r{i} ({:?})\n", constant.value);
    }
    for (i, &value) in layout.parameter_range().zip(parameters) {
        constants += &format!("static volatile double p{i} = {value:?}; static double r{i};\n");
        prologue = format!("r{i} = p{i};\n{prologue}");
    }
    for i in layout.hoisted_range() {
        constants += &format!("static double r{i};\n");
    }
    let mut inputs = String::new();
    for (k, i) in layout.variable_range().enumerate() {
        inputs += &format!("double r{i} = in[{k}];\n");
    }
    let temporaries = format!("double {};", all[layout.temporary_range()].join(", "));
    let temporaries = if layout.temporaries == 0 {
        String::new()
    } else {
        temporaries
    };
    let start: Vec<String> = point.iter().map(|x| format!("{x:?}")).collect();
    let expected: Vec<String> = expected.iter().map(|x| format!("{x:?}")).collect();
    format!(
        "#define _GNU_SOURCE\n#include <math.h>\n#include <stdio.h>\n#include <time.h>\n{constants}
static __attribute__((noinline)) void prepare(void) {{ {temporaries}\n{prologue} }}
__attribute__((noinline)) void f(const double *in, double *out) {{\n{temporaries}\n{inputs}{body}}}
int main(void) {{
  double in[] = {{ {} }}, expected[] = {{ {} }}, out[{}]; double best = 1e9; struct timespec a, b; prepare();
  for (int run = 0; run < 40; run++) {{
    clock_gettime(CLOCK_MONOTONIC, &a);
    for (int i = 0; i < {repeats}; i++) {{ f(in, out); __asm__ volatile(\"\" : : \"r\"(in), \"r\"(out) : \"memory\"); }}
    clock_gettime(CLOCK_MONOTONIC, &b);
    double t = (b.tv_sec - a.tv_sec + 1e-9 * (b.tv_nsec - a.tv_nsec)) / {repeats};
    if (t < best) best = t;
  }}
  for (unsigned i = 0; i < sizeof out / sizeof *out; i++)
    if (fabs(out[i] - expected[i]) > 1e-9 * (1 + fabs(expected[i]))) return 1;
  printf(\"%g\\n\", best); return 0; }}",
        start.join(", "),
        expected.join(", "),
        program.output_count()
    )
}

fn c_instruction(program: &Program, instruction: Instruction, text: &mut String) {
    let r = |register: Register| format!("r{}", register.index());
    *text += &match instruction {
        Instruction::Unary { operation, out, a } => {
            let (out, a) = (r(out), r(a));
            match operation {
                Unary::Neg => format!("{out} = -{a};"),
                Unary::Square => format!("{out} = {a} * {a};"),
                Unary::Sqrt => format!("{out} = sqrt({a});"),
                Unary::Function(f) => format!("{out} = {}({a});", f.name()),
            }
        }
        Instruction::Binary {
            operation,
            out,
            a,
            b,
        } => {
            let (out, a, b) = (r(out), r(a), r(b));
            match operation {
                Binary::Add => format!("{out} = {a} + {b};"),
                Binary::Sub => format!("{out} = {a} - {b};"),
                Binary::Mul => format!("{out} = {a} * {b};"),
                Binary::Div => format!("{out} = {a} / {b};"),
                Binary::Pow => format!("{out} = pow({a}, {b});"),
                Binary::Atan2 => format!("{out} = atan2({a}, {b});"),
            }
        }
        Instruction::Fused {
            operation,
            out,
            a,
            b,
            c,
        } => {
            let (out, a, b, c) = (r(out), r(a), r(b), r(c));
            match operation {
                Fused::MulAdd => format!("{out} = {a} * {b} + {c};"),
                Fused::MulSub => format!("{out} = {a} * {b} - {c};"),
                Fused::NegMulAdd => format!("{out} = {c} - {a} * {b};"),
            }
        }
        Instruction::SinCos { sin, cos, a } => {
            format!(
                "{{ double s_, c_; sincos({}, &s_, &c_); {} = s_; {} = c_; }}",
                r(a),
                r(sin),
                r(cos)
            )
        }
        Instruction::Factor { matrix } => c_factor(program, matrix as usize),
        Instruction::Solve { solve } => c_solve(program, solve as usize),
    };
    *text += "\n";
}

/// L D Lᵀ written out.
fn c_factor(program: &Program, index: usize) -> String {
    let matrix = &program.matrices[index];
    let n = matrix.size;
    let zero = |i: usize, j: usize| {
        let at = matrix.entries[i * n + j].index();
        program.constants.get(at).is_some_and(|c| c.value == 0.0)
    };
    let mut known: Vec<bool> = (0..n * n).map(|k| zero(k / n, k % n)).collect();
    let mut text = String::new();
    for i in 0..n {
        for j in 0..=i {
            let mut sum = format!("r{}", matrix.entries[i * n + j].index());
            let mut is_zero = known[i * n + j];
            for k in 0..j {
                if !known[i * n + k] && !known[j * n + k] {
                    sum += &format!(" - u{index}_{i}_{k} * l{index}_{j}_{k}");
                    is_zero = false;
                }
            }
            known[i * n + j] = is_zero;
            if i == j {
                text += &format!("double d{index}_{i} = 1 / ({});\n", sum);
            } else if !is_zero {
                text += &format!("double u{index}_{i}_{j} = {sum}, l{index}_{i}_{j} = u{index}_{i}_{j} * d{index}_{j};\n");
            }
        }
    }
    for i in 0..n {
        for j in 0..i {
            if known[i * n + j] {
                text += &format!("const double l{index}_{i}_{j} = 0;\n");
            }
        }
    }
    text
}

fn c_solve(program: &Program, index: usize) -> String {
    let solve = &program.solves[index];
    let (n, m) = (solve.rhs.len(), solve.matrix);
    let mut text = String::new();
    for i in 0..n {
        text += &format!("double y{index}_{i} = r{}", solve.rhs[i].index());
        (0..i).for_each(|k| text += &format!(" - l{m}_{i}_{k} * y{index}_{k}"));
        text += ";\n";
    }
    for i in (0..n).rev() {
        text += &format!("double x{index}_{i} = y{index}_{i} * d{m}_{i}");
        (i + 1..n).for_each(|k| text += &format!(" - l{m}_{k}_{i} * x{index}_{k}"));
        text += ";\n";
    }
    for (i, out) in solve.out.iter().enumerate() {
        text += &format!("r{} = x{index}_{i};\n", out.index());
    }
    text
}

fn measure(model: &Model, form: &str, (variables, outputs): (Vec<Symbol>, Vec<Expr>)) {
    let lowering = Lowering::new(&model.graph)
        .variables(&variables)
        .parameters(&model.parameters)
        .positive_definite(&outputs)
        .output("rates", &outputs);
    let lower = least(|| drop(lowering.lower().unwrap()), 1, 20);
    let program = lowering.lower().unwrap();
    if std::env::var_os("SHOW_PROGRAMS").is_some() {
        println!("{program}");
    }
    let parameters: Vec<f64> = (0..model.parameters.len())
        .map(|i| 0.7 + 0.2 * i as f64)
        .collect();
    let point: Vec<f64> = (0..variables.len()).map(|i| 0.3 + 0.1 * i as f64).collect();
    compare(&model.name, form, lower, &program, &parameters, &point);
}

fn compare(
    name: &str,
    form: &str,
    lower: f64,
    program: &Program,
    parameters: &[f64],
    point: &[f64],
) {
    let repeats = 40_000 / (program.body.len() + 100) + 1;
    let interpreter = Interpreter::new(program.clone()).unwrap();
    let Some(native) = Native::new(program.clone()).unwrap() else {
        println!("no native code on this machine");
        return;
    };
    let compile = least(|| drop(Native::new(program.clone())), 1, 10);
    let gcc = gcc(program, parameters, point, repeats);
    let mut contestants = vec![
        single(&interpreter, parameters, point, repeats),
        single(&native, parameters, point, repeats),
        block(&interpreter, parameters, point, repeats),
        block(&native, parameters, point, repeats),
    ];
    if let Some(binary) = gcc {
        contestants.push(Box::new(move || {
            let output = Command::new(&binary).output().unwrap();
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            text.trim().parse().unwrap_or(f64::NAN)
        }));
    }
    let times: Vec<f64> = medians(&mut contestants).iter().map(|t| 1e9 * t).collect();
    let [a, b, c, d] = times[..4] else { return };
    let gcc = times.get(4).copied().unwrap_or(f64::NAN);
    let layout = program.layout;
    println!(
        "{name:<10} {form:<9} {:>5} {:>6} {:>5} {:>9.1} {:>9.1} {a:>9.0} {b:>9.1} {c:>9.1} {d:>9.1} {gcc:>9.1} {:>6.2} {:>6.2} {:>7}",
        program.prologue.len(),
        program.body.len(),
        layout.temporaries,
        1e6 * lower,
        1e6 * compile,
        b / gcc,
        d / b,
        native.code_size(),
    );
}

fn measure_lowering(nodes: usize) {
    let g = Graph::new();
    let (x, y) = (g.symbol("x", 0), g.symbol("y", 0));
    let mut e = x;
    while g.node_count() < nodes {
        e = g.add(&[g.mul(&[y, g.sin(e)]), g.mul(&[x, e]), g.one()]);
    }
    let symbols = [x, y].map(|e| g.as_symbol(e).unwrap());
    let lowering = Lowering::new(&g).variables(&symbols).output("e", &[e]);
    let time = least(|| drop(lowering.lower().unwrap()), 1, 5);
    println!("{} nodes lowered in {:.0} ms", g.node_count(), 1e3 * time);
}

fn main() {
    println!(
        "model      form      hoist   body temps lower, us  make, us    single    native     block    native       gcc  /gcc  block/   bytes"
    );
    for model in [disc(), chain(2), chain(4), chain(8), chain(16)] {
        measure(&model, "reduced", model.reduced());
        measure(&model, "bordered", model.bordered());
    }
    if std::env::args().any(|argument| argument == "--lowering") {
        measure_lowering(100_000);
        measure_lowering(1_000_000);
    }
}
