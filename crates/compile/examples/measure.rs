//! Measures lowering and evaluation: `cargo run --release -p chetaev-compile --example measure`.
//!
//! Right-hand sides are derived here from Lagrangian and constraints in two forms, reduced by the admissible
//! directions and with multipliers; times are the least of many runs, in nanoseconds per state.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // A program for people to read from.
#![allow(clippy::needless_range_loop)] // Matrices read best with their indices.

use chetaev_compile::{BlockEvaluator, Evaluator, Interpreter, Lanes, Lowering, LANES};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Graph, Symbol};
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

fn measure(model: &Model, form: &str, (variables, outputs): (Vec<Symbol>, Vec<Expr>)) {
    let lowering = Lowering::new(&model.graph)
        .variables(&variables)
        .parameters(&model.parameters)
        .positive_definite(&outputs)
        .output("rates", &outputs);
    let lower = least(|| drop(lowering.lower().unwrap()), 1, 20);
    let program = lowering.lower().unwrap();
    let (prologue, body) = (program.prologue.len(), program.body.len());
    let temporaries = program.layout.temporaries;
    if std::env::var_os("SHOW_PROGRAMS").is_some() {
        println!("{program}");
    }
    let interpreter = Interpreter::new(program).unwrap();
    let parameters: Vec<f64> = (0..model.parameters.len())
        .map(|i| 0.7 + 0.2 * i as f64)
        .collect();
    let point: Vec<f64> = (0..variables.len()).map(|i| 0.3 + 0.1 * i as f64).collect();
    let mut workspace = interpreter.workspace();
    interpreter.prepare(&parameters, &mut workspace).unwrap();
    let mut values = vec![0.0; outputs.len()];
    let repeats = 20_000 / (body + 100) + 1;
    let single = least(
        || {
            let point = std::hint::black_box(&point);
            interpreter
                .evaluate(point, &mut workspace, &mut values)
                .unwrap();
            std::hint::black_box(&values);
        },
        repeats,
        500,
    );
    let splat =
        |values: &[f64]| -> Vec<Lanes> { values.iter().map(|&v| Lanes::splat(v)).collect() };
    let mut workspace = interpreter.block_workspace();
    interpreter
        .prepare_block(&splat(&parameters), &mut workspace)
        .unwrap();
    let point: Vec<Lanes> = point
        .iter()
        .map(|&v| Lanes::from_fn(|l| v * (1.0 + 0.01 * l as f64)))
        .collect();
    let mut values = vec![Lanes::default(); outputs.len()];
    let block = least(
        || {
            let point = std::hint::black_box(&point);
            interpreter
                .evaluate_block(1, point, &mut workspace, &mut values)
                .unwrap();
            std::hint::black_box(&values);
        },
        repeats.div_ceil(4),
        500,
    );
    println!(
        "{:<10} {form:<9} {prologue:>5} {body:>6} {temporaries:>5} {:>10.1} {:>9.0} {:>9.1}",
        model.name,
        1e6 * lower,
        1e9 * single,
        1e9 * block / LANES as f64,
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
    println!("model      form      hoist   body temps  lower, us    single     block");
    for model in [disc(), chain(2), chain(4), chain(8), chain(16)] {
        measure(&model, "reduced", model.reduced());
        measure(&model, "bordered", model.bordered());
    }
    measure_lowering(100_000);
    measure_lowering(1_000_000);
}
