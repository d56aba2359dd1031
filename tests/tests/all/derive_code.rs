//! The functions in Rust and C that `derive` writes: compiled, run, and held against the library's own values.
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

use chetaev::mechanics::claims::formulation::derive;
use chetaev::mechanics::{Context, Equations, Prepared, Prover, System};
use chetaev::model::ModelBuilder;
use chetaev::study::free::following;
use chetaev::study::registry;
use chetaev::symbolic::{Expr, Symbol};
use chetaev_tests::places::scratch;
use chetaev_tests::program::{run, text};
use chetaev_tests::studied::{gallery_path, loaded};
use std::path::Path;

/// A number for each name, the same wherever it is asked for: between 0.4 and 1.4, no two equal.
fn number(index: usize) -> f64 {
    let golden = 0.618_033_988_749_894_9;
    0.4 + (golden * (index + 1) as f64).fract()
}

/// Arrays of the functions that are written, with their numbers: q, z, p, v.
struct Numbers {
    q: Vec<f64>,
    z: Vec<f64>,
    p: Vec<f64>,
}

impl Numbers {
    fn new(system: &System, equations: &Equations) -> Numbers {
        let (n, k) = (system.coordinates.len(), equations.variables.len());
        Numbers {
            q: (0..n).map(number).collect(),
            z: (0..k).map(|i| number(n + i)).collect(),
            p: (0..system.parameters.len())
                .map(|i| number(n + k + i))
                .collect(),
        }
    }

    fn value(&self, system: &System, equations: &Equations, symbol: Symbol) -> Option<f64> {
        let g = &system.graph;
        let place = |symbols: &[Symbol], values: &[f64]| {
            let at = symbols.iter().position(|&s| s == symbol)?;
            Some(values[at])
        };
        let parameters: Vec<Symbol> = system
            .parameters
            .iter()
            .map(|p| g.intern_symbol(&p.name, 0))
            .collect();
        let state: Vec<Symbol> = equations.variables.iter().map(|x| x.symbol).collect();
        place(&system.coordinate_symbols(), &self.q)
            .or_else(|| place(&state, &self.z))
            .or_else(|| place(&parameters, &self.p))
            .or_else(|| (symbol == g.intern_symbol("t", 0)).then_some(TIME))
    }
}

const TIME: f64 = 0.3;

/// What the functions of one formulation must give at the numbers: q', z' and the multipliers.
fn expected(system: &System, equations: &Equations) -> (Numbers, Vec<f64>) {
    let g = &system.graph;
    let numbers = Numbers::new(system, equations);
    let mut roots = equations.velocities.clone();
    roots.extend(equations.rates());
    roots.extend(equations.multipliers.iter().map(|(_, value)| *value));
    // Laws of controls stand for their names.
    let laws: Vec<(Expr, Expr)> = system
        .controls
        .iter()
        .filter_map(|c| Some((g.symbol(&c.name, 0), c.law?)))
        .collect();
    let roots = g.substitute_all(&roots, &laws);
    let values = g
        .evaluate_f64(&roots, &|symbol| numbers.value(system, equations, symbol))
        .expect("the functions are defined there");
    (numbers, values)
}

/// A main program that prints what the functions give, in the order of `expected`.
fn rust_main(name: &str, numbers: &Numbers, multipliers: usize) -> String {
    let (n, k) = (numbers.q.len(), numbers.z.len());
    let reaction = match multipliers {
        0 => String::new(),
        r => format!("let mut l = [0.0; {r}]; {name}_multipliers({TIME:?}, &q, &z, &p, &mut l).unwrap(); for x in l {{ println!(\"{{x:e}}\"); }}"),
    };
    format!(
        "{{ let (q, z, p) = ({:?}, {:?}, {:?}); let mut dq = [0.0; {n}]; let mut dz = [0.0; {k}];\n\
         {name}_rates({TIME:?}, &q, &z, &p, &mut dq, &mut dz).unwrap();\n\
         for x in dq {{ println!(\"{{x:e}}\"); }} for x in dz {{ println!(\"{{x:e}}\"); }} {reaction} }}\n",
        numbers.q, numbers.z, numbers.p
    )
}

fn c_main(name: &str, numbers: &Numbers, multipliers: usize) -> String {
    let array = |values: &[f64]| {
        let texts: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
        format!("{{{}}}", texts.join(", "))
    };
    let (n, k) = (numbers.q.len(), numbers.z.len());
    let reaction = match multipliers {
        0 => String::new(),
        r => format!("double l[{r}]; if ({name}_multipliers({TIME:?}, q, z, p, l)) return 1;\nfor (int i = 0; i < {r}; i++) printf(\"%.17e\\n\", l[i]);\n"),
    };
    format!(
        "{{ const double q[] = {}, z[] = {}, p[] = {}; double dq[{n}], dz[{k}];\n\
         if ({name}_rates({TIME:?}, q, z, p, dq, dz)) return 1;\n\
         for (int i = 0; i < {n}; i++) printf(\"%.17e\\n\", dq[i]);\n\
         for (int i = 0; i < {k}; i++) printf(\"%.17e\\n\", dz[i]);\n{reaction} }}\n",
        array(&numbers.q),
        array(&numbers.z),
        array(&numbers.p)
    )
}

/// Compiles a program, runs it, and reads the numbers that it prints.
fn outcome(folder: &Path, compiler: &str, arguments: &[&str]) -> Vec<f64> {
    let built = std::process::Command::new(compiler)
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the compiler runs");
    let complaint = String::from_utf8_lossy(&built.stderr).into_owned();
    assert!(built.status.success(), "{}\n{complaint}", folder.display());
    let ran = std::process::Command::new(folder.join("program"))
        .output()
        .expect("the program runs");
    assert!(ran.status.success(), "{}", folder.display());
    String::from_utf8_lossy(&ran.stdout)
        .lines()
        .map(|line| line.parse().expect("a number"))
        .collect()
}

fn runs(command: &str) -> bool {
    let asked = std::process::Command::new(command)
        .arg("--version")
        .output();
    asked.is_ok_and(|p| p.status.success())
}

/// Holds the functions written for the formulations of a model against the library's own values.
fn functions_agree(path: &Path, formulations: &[&str], notations: &[&str]) {
    let model = loaded(path, &[]).model.expect("the model is right");
    let system = System::from_model(&model).expect("the model is regular");
    // Parameters that follow from others are no arguments; none occurs in these equations.
    let following = following(&model);
    let mut free = system.clone();
    free.parameters
        .retain(|p| following.iter().all(|own| own.0 != p.expr));
    let prepared = Prepared::new(&system).expect("the model is regular");
    let known = registry();
    let cx = Context::new(
        &system,
        &prepared.terms,
        &prepared.selection,
        &known,
        Prover::default(),
    );
    let mut wanted = Vec::new();
    let mut mains = [String::new(), String::new()];
    for name in formulations {
        let equations = derive(&cx, name).expect("the formulation applies");
        let (numbers, values) = expected(&free, &equations);
        let function = name.replace('-', "_");
        let count = equations.multipliers.len();
        mains[0].push_str(&rust_main(&function, &numbers, count));
        mains[1].push_str(&c_main(&function, &numbers, count));
        wanted.extend(values.into_iter().map(|value| (*name, value)));
    }
    for notation in notations {
        let compiler = if *notation == "rust" { "rustc" } else { "cc" };
        if !runs(compiler) {
            continue;
        }
        let mut arguments = vec!["derive", text(path), "--as", notation];
        for name in formulations {
            arguments.extend(["--formulation", name]);
        }
        let finished = run(&arguments);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let folder = scratch(&format!("derive-code-{}-{notation}", system.name));
        let found = match *notation {
            "rust" => {
                let program = format!("{}\nfn main() {{\n{}}}\n", finished.out, mains[0]);
                std::fs::write(folder.join("program.rs"), program).expect("a scratch file");
                let strict = ["-D", "warnings", "-A", "dead_code", "-A", "non_snake_case"];
                let arguments = [&strict[..], &["--edition", "2021", "program.rs"]].concat();
                outcome(&folder, compiler, &arguments)
            }
            _ => {
                let program = format!(
                    "{}\n#include <stdio.h>\nint main(void)\n{{\n{}return 0;\n}}\n",
                    finished.out, mains[1]
                );
                std::fs::write(folder.join("program.c"), program).expect("a scratch file");
                let arguments = [
                    "-std=c99",
                    "-Wall",
                    "-Wextra",
                    "-Werror",
                    "-pedantic",
                    "-o",
                    "program",
                    "program.c",
                    "-lm",
                ];
                outcome(&folder, compiler, &arguments)
            }
        };
        assert_eq!(found.len(), wanted.len(), "{}: {notation}", system.name);
        for ((name, value), found) in wanted.iter().zip(found) {
            let close = (found - value).abs() <= 1e-9 * value.abs().max(1.0);
            assert!(
                close,
                "{}: {name} as {notation} gives {found}, not {value}",
                system.name
            );
        }
    }
}

/// Linear solves, radicals, implicit constraints, momenta, parameters of the path and multipliers all occur.
#[test]
fn functions_in_rust_and_c_give_what_the_library_computes() {
    let every = [
        "routh",
        "voronets",
        "volterra-second",
        "nielsen",
        "gibbs-appell",
        "kane",
        "gauss",
        "boltzmann-hamel",
        "poincare-chetaev",
        "canonical",
        "state-space",
        "canonical-reduced",
        "parametric",
        "parametric-canonical",
        "vakonomic",
        "jacobi",
    ];
    let sleigh = gallery_path("chaplygin-sleigh/model.toml");
    functions_agree(&sleigh, &every, &["rust", "c"]);
    let cone = gallery_path("appell-hamel/model.toml");
    functions_agree(
        &cone,
        &[
            "routh",
            "maggi",
            "canonical",
            "canonical-reduced",
            "vakonomic",
        ],
        &["rust", "c"],
    );
}

/// Names that are words of the languages or of the functions themselves, and a control.
#[test]
fn functions_bear_awkward_names() {
    let system = ModelBuilder::new("awkward-code")
        .coordinates(["q", "fn", "int", "work"])
        .parameter("p", "1")
        .parameter("double", "2")
        .parameter("w1", "2")
        .control("return", "sin(t)")
        .lagrangian("1/2 p (q'^2 + fn'^2 + work'^2) + 1/2 double w1 int'^2")
        .force("q", "return fn'")
        .constraint("match", "fn' cos(int) = q' sin(int)")
        .quasi_velocity("dq", "q' cos(int) + fn' sin(int)")
        .quasi_velocity("struct", "int'")
        .quasi_velocity("z", "work'");
    let folder = scratch("derive-awkward-code");
    let path = folder.join("model.toml");
    std::fs::write(&path, system.to_toml()).expect("a scratch file");
    functions_agree(
        &path,
        &["routh", "maggi", "canonical", "voronets", "boltzmann-hamel"],
        &["rust", "c"],
    );
}
