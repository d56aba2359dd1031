//! Generated C and Rust, compiled and run, against the evaluation of the graph.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_symbolic::print::{source_code, CodeError, CodeFunction, Language};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::syntax::{lower, parse_expression, Resolution, Scope};
use chetaev_symbolic::{Expr, Function, Graph, Symbol};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Every name is a symbol.
struct AnyName<'a>(&'a Graph);

impl Scope for AnyName<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        Resolution::Known(self.0.symbol(name, order))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

fn read(g: &Graph, text: &str) -> Expr {
    let parsed = parse_expression(text);
    let mut diagnostics = parsed.diagnostics.clone();
    let root = parsed.sides[0];
    let e = lower(g, &parsed.tree, root, &AnyName(g), &[], &mut diagnostics);
    e.unwrap_or_else(|| panic!("{text}: {diagnostics:?}"))
}

/// A function of the entries of one array, with the points at which it is tried.
struct Case {
    name: &'static str,
    inputs: Vec<Symbol>,
    outputs: Vec<Expr>,
    points: Vec<Vec<f64>>,
}

impl Case {
    fn new(g: &Graph, name: &'static str, outputs: Vec<Expr>, points: &[&[f64]]) -> Case {
        Case {
            name,
            inputs: g.symbols_in(&outputs),
            outputs,
            points: points.iter().map(|point| point.to_vec()).collect(),
        }
    }

    /// The array of outputs is called `out`, that of inputs `q` as often happens in mechanics.
    fn function(&self) -> CodeFunction<'_> {
        CodeFunction {
            name: self.name,
            documentation: vec![format!("The case {} */ /* ??/", self.name)],
            time: None,
            inputs: vec![("q", self.inputs.clone())],
            outputs: vec![("out", self.outputs.clone())],
        }
    }

    /// The values by the graph; `None` where a matrix is singular.
    fn expected(&self, g: &Graph, point: &[f64]) -> Option<Vec<f64>> {
        let value = |symbol| {
            let place = self.inputs.iter().position(|&input| input == symbol)?;
            Some(point[place])
        };
        g.evaluate_f64(&self.outputs, &value).ok()
    }
}

fn every_function(g: &Graph) -> Case {
    let (x, y) = (g.symbol("x", 0), g.symbol("y", 0));
    let mut outputs: Vec<Expr> = Function::ALL
        .into_iter()
        .map(|f| match f {
            Function::Atan2 => g.apply(f, &[x, y]),
            Function::Acosh => g.apply(f, &[read(g, "1 + x^2")]),
            _ => g.apply(f, &[x]),
        })
        .collect();
    outputs.push(read(g, "sec(x*y) + csc(x - y)*cot(y)/sec(y)^3"));
    outputs.push(read(g, "sign(x - y)*abs(y) - exp(-x)*log(y^2)"));
    outputs.push(read(g, "sin(pi*x/7) + atan2(2, x) + asin(1/3) + 2^x"));
    let points: [&[f64]; 3] = [&[0.3, 0.8], &[0.9, -0.4], &[0.02, 2.5]];
    Case::new(g, "functions", outputs, &points)
}

fn powers(g: &Graph) -> Case {
    let (x, y) = (g.symbol("x", 0), g.symbol("y", 0));
    let exponents = (-8..=8).chain([31, -40, 63, 64, 65, -70]);
    let mut outputs: Vec<Expr> = exponents.map(|n| g.powi(x, n)).collect();
    for (p, q) in [
        (1, 2),
        (3, 2),
        (5, 2),
        (7, 2),
        (9, 2),
        (1, 3),
        (2, 3),
        (7, 5),
    ] {
        for sign in [1, -1] {
            let exponent = g.number(ratio(sign * p, q).unwrap());
            outputs.push(g.pow(y, exponent));
            outputs.push(g.pow(read(g, "x + y"), exponent));
        }
    }
    let more = [
        "x^y",
        "y^(x - 1/3)",
        "(x^2 + y)^2*(x^2 + y)^(-1/2)",
        "sqrt(2)*x/sqrt(3) + pi^2*y/pi^3",
        "x/3 + 2*y/7 - 5*x*y/(6*sqrt(y)) + 0.1*x - 9.81*y",
        "123456789012345678901234*x/98765432109876543217 - 10^30*y + x*10^(-25)",
        "-x/y - 1/(x + 1) + 1/3",
        "(1/3)^x + (-x)*y^2 + (2/5)^(1/2)*x + (1/7)^(1/3)",
        "1 - x - y",
    ];
    outputs.extend(more.iter().map(|text| read(g, text)));
    Case::new(
        g,
        "powers",
        outputs,
        &[&[1.3, 0.8], &[0.6, 1.9], &[2.25, 3.5]],
    )
}

fn shared_parts(g: &Graph) -> Case {
    let names: Vec<Expr> = (0..40).map(|k| g.symbol(&format!("z{k:02}"), 0)).collect();
    let waves: Vec<Expr> = names.iter().map(|&z| g.mul(&[z, g.sin(z)])).collect();
    let sum = g.add(&waves);
    let ones: Vec<Expr> = names.iter().map(|&z| g.add(&[z, g.one()])).collect();
    let product = g.mul(&ones);
    let mut outputs = vec![
        sum,
        product,
        g.add(&[g.powi(sum, 2), g.neg(product), g.cos(sum)]),
        g.div(sum, g.sqrt(product)),
        g.mul(&[sum, names[3], g.powi(product, -3)]),
        g.neg(names[0]),
        g.mul(&[g.neg(names[0]), names[1], g.exp(g.neg(names[0]))]),
        names[2],
        g.integer(-3),
    ];
    outputs.push(outputs[2]);
    let at = |scale: f64| -> Vec<f64> {
        (0..40)
            .map(|k| scale * (1.0 + 0.1 * f64::from(k)))
            .collect()
    };
    Case::new(g, "shared", outputs, &[&at(0.2), &at(0.35)])
}

/// Names that are words of the languages, of the generated code, or of each other.
fn awkward_names(g: &Graph) -> Case {
    let names = [
        "type",
        "in",
        "fn",
        "double",
        "register",
        "q",
        "out",
        "q_",
        "sin",
        "PI",
        "w1",
        "w2",
        "work",
        "main",
        "matrix1",
        "self",
        "Self",
        "None",
        "_",
        "__a",
        "_B",
        "lambda",
        "θ₁",
        "x_d",
        "R",
        "sin_x",
        "é",
        "è",
        "f64",
        "gamma",
        "HUGE_VAL",
        "Ok",
        "chetaev_sign",
    ];
    let mut symbols: Vec<Expr> = names.iter().map(|name| g.symbol(name, 0)).collect();
    symbols.extend((0..4).map(|order| g.symbol("x", order)));
    let weighted: Vec<Expr> = symbols
        .iter()
        .zip(1..)
        .map(|(&s, k)| g.mul(&[g.integer(k * k), g.sin(s)]))
        .collect();
    let sum = g.add(&weighted);
    let sign = g.apply(Function::Sign, &[g.symbol("q", 0)]);
    let solution = g.solve(
        &[symbols[0], symbols[1], symbols[2], symbols[3]],
        &[sum, sign],
    );
    let mut outputs = vec![sum, g.mul(&[sum, g.pi(), sign])];
    outputs.extend(solution.unwrap());
    let point: Vec<f64> = (0..symbols.len())
        .map(|k| (k as f64 * 1.7).cos() + 0.1)
        .collect();
    Case::new(g, "awkward", outputs, &[&point])
}

/// One solve within another, two with the same matrix; singular where a = b.
fn solves(g: &Graph) -> Case {
    let texts = |texts: &[&str]| -> Vec<Expr> { texts.iter().map(|text| read(g, text)).collect() };
    let matrix = texts(&["a", "b", "b", "a"]);
    let first = g.solve(&matrix, &texts(&["1", "c"])).unwrap();
    let second = g.solve(&matrix, &[first[0], first[1]]).unwrap();
    let mut large = texts(&[
        "0", "a + c", "1", "sin(b)", "0", "c", "2", "a", "b", "1", "1", "c^2", "c", "a", "7", "b",
        "0", "3", "c", "1", "2", "1", "a*b", "0", "5",
    ]);
    large[4] = second[0];
    let right: Vec<Expr> = (0..5)
        .map(|k| g.mul(&[g.integer(k + 1), second[1]]))
        .collect();
    let third = g.solve(&large, &right).unwrap();
    let outputs = [first, second, third].concat();
    let points: [&[f64]; 4] = [
        &[2.0, 0.5, 1.5],
        &[0.0, 1.0, -0.7],
        &[1.0, 1.0, 0.3],
        &[-3.0, 0.1, 0.9],
    ];
    Case::new(g, "solves", outputs, &points)
}

/// A directory that is removed when the test ends, however it ends.
struct Workshop(PathBuf);

impl Workshop {
    fn new(name: &str) -> Workshop {
        let path = std::env::temp_dir().join(format!("chetaev-code-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Workshop(path)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Workshop {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn compile(compiler: &str, arguments: &[&str], files: &[&Path], program: &Path) {
    let output = Command::new(compiler)
        .args(arguments)
        .args(files)
        .arg("-o")
        .arg(program)
        .args(if compiler == "cc" { &["-lm"][..] } else { &[] })
        .output()
        .unwrap_or_else(|error| panic!("this test needs the compiler `{compiler}`: {error}"));
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && messages.is_empty(), "{messages}");
}

/// What the program prints: for each call the status, then the outputs.
fn run(program: &Path) -> Vec<Vec<f64>> {
    let output = Command::new(program).output().unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let line = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect();
    text.lines().map(line).collect()
}

fn literals(point: &[f64]) -> String {
    let literals: Vec<String> = point.iter().map(|x| format!("{x:?}")).collect();
    literals.join(", ")
}

fn check(g: &Graph, cases: &[Case], printed: &[Vec<f64>]) {
    let mut printed = printed.iter();
    let mut failures = 0;
    for case in cases {
        for point in &case.points {
            let line = printed.next().unwrap();
            let Some(expected) = case.expected(g, point) else {
                failures += 1;
                assert_eq!(line[0], 1.0, "{} is singular at {point:?}", case.name);
                continue;
            };
            assert_eq!(line[0], 0.0, "{} is regular at {point:?}", case.name);
            assert_eq!(line.len(), expected.len() + 1);
            for (place, (got, want)) in line[1..].iter().zip(&expected).enumerate() {
                assert!(
                    want.is_finite() && *want != 0.0 || case.name == "functions",
                    "{} {place}",
                    case.name
                );
                let close = (got - want).abs() <= 1e-13 * want.abs();
                let text = g.text(case.outputs[place]);
                assert!(
                    close || (got.is_nan() && want.is_nan()),
                    "{}[{place}] = {text} at {point:?}: {got:?} and not {want:?}",
                    case.name
                );
            }
        }
    }
    assert!(printed.next().is_none());
    assert_eq!(failures, 1, "one point is singular");
}

fn cases(g: &Graph) -> Vec<Case> {
    vec![
        every_function(g),
        powers(g),
        shared_parts(g),
        awkward_names(g),
        solves(g),
    ]
}

/// Nothing in, nothing out, nothing used.
fn idle(g: &Graph) -> CodeFunction<'static> {
    CodeFunction {
        name: "idle",
        documentation: Vec::new(),
        time: Some(g.intern_symbol("t", 0)),
        inputs: vec![("x", vec![g.intern_symbol("x", 0)]), ("p", Vec::new())],
        outputs: vec![("out", Vec::new())],
    }
}

fn generated(g: &Graph, cases: &[Case], language: Language) -> String {
    let title = ["Written by a test. */ \u{202e}".to_string()];
    let mut functions: Vec<CodeFunction<'_>> = cases.iter().map(Case::function).collect();
    functions.push(idle(g));
    source_code(g, &title, &functions, language).unwrap()
}

#[test]
fn c_computes_what_the_graph_does() {
    let g = Graph::new();
    let cases = cases(&g);
    let mut main = String::from("#include <stdio.h>\n#include \"code.c\"\nint main(void) {\n");
    main.push_str("if (idle(0.0, 0, 0, 0) != 0) return 1;\n");
    for case in &cases {
        let (name, n) = (case.name, case.outputs.len());
        for point in &case.points {
            writeln!(
                main,
                "{{ const double in[] = {{{}}}; double out[{n}] = {{0}};",
                literals(point)
            )
            .unwrap();
            writeln!(main, "printf(\"%d\", {name}(in, out));").unwrap();
            writeln!(
                main,
                "for (int i = 0; i < {n}; i++) printf(\" %.17g\", out[i]);"
            )
            .unwrap();
            main.push_str("printf(\"\\n\"); }\n");
        }
    }
    main.push_str("return 0; }\n");
    let workshop = Workshop::new("c");
    workshop.write("code.c", &generated(&g, &cases, Language::C));
    let main = workshop.write("main.c", &main);
    let program = workshop.0.join("program");
    let arguments = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-pedantic",
        "-ffp-contract=off",
    ];
    compile("cc", &arguments, &[&main], &program);
    check(&g, &cases, &run(&program));
}

#[test]
fn rust_computes_what_the_graph_does() {
    let g = Graph::new();
    let cases = cases(&g);
    let mut main = String::from("pub mod code;\nfn main() {\n");
    main.push_str("assert_eq!(code::idle(0.0, &[0.0], &[], &mut []), Ok(()));\n");
    for case in &cases {
        let (name, n) = (case.name, case.outputs.len());
        for point in &case.points {
            writeln!(main, "let mut out = [0.0; {n}];").unwrap();
            writeln!(
                main,
                "let status = code::{name}(&[{}], &mut out);",
                literals(point)
            )
            .unwrap();
            main.push_str("print!(\"{}\", i32::from(status == Err(code::Singular)));\n");
            main.push_str("for x in out { print!(\" {x:?}\"); }\nprintln!();\n");
        }
    }
    main.push_str("}\n");
    let workshop = Workshop::new("rust");
    workshop.write("code.rs", &generated(&g, &cases, Language::Rust));
    let main = workshop.write("main.rs", &main);
    let program = workshop.0.join("program");
    compile("rustc", &["--edition", "2021"], &[&main], &program);
    check(&g, &cases, &run(&program));
}

/// The code for a pendulum as a person would write it.
#[test]
fn code_can_be_read() {
    let g = Graph::new();
    let function = CodeFunction {
        name: "rates",
        documentation: vec!["The rates of a pendulum.".into()],
        time: None,
        inputs: vec![
            ("q", vec![g.intern_symbol("phi", 0)]),
            ("v", vec![g.intern_symbol("phi", 1)]),
            ("p", vec![g.intern_symbol("g", 0), g.intern_symbol("l", 0)]),
        ],
        outputs: vec![
            ("dq", vec![read(&g, "phi'")]),
            ("dv", vec![read(&g, "-g*sin(phi)/l - phi'*sin(phi)/3")]),
        ],
    };
    let text = |language| source_code(&g, &[], std::slice::from_ref(&function), language).unwrap();
    let expected = "\
#include <math.h>

/*
 * The rates of a pendulum.
 */
int rates(const double q[1], const double v[1], const double p[2], double dq[1], double dv[1])
{
    const double phi = q[0];
    const double phi_d = v[0];
    const double g = p[0];
    const double l = p[1];
    const double sin_phi = sin(phi);
    dq[0] = phi_d;
    dv[0] = -phi_d*sin_phi/3.0 - g*sin_phi/l;
    return 0;
}
";
    assert_eq!(text(Language::C), expected);
    let rust = text(Language::Rust);
    assert!(rust.contains("    let sin_phi = phi.sin();\n"), "{rust}");
    assert!(
        !rust.contains("chetaev_solve") && !rust.contains("allow"),
        "{rust}"
    );
}

#[test]
fn the_code_does_not_depend_on_the_history_of_the_graph() {
    let texts = [
        "sin(x)*y + x*y*z^2",
        "exp(x*y)/(z + sin(x))",
        "sqrt(z + sin(x))",
    ];
    let code = |order: [usize; 3]| {
        let g = Graph::new();
        let mut outputs = [g.zero(); 3];
        for place in order {
            outputs[place] = read(&g, texts[place]);
        }
        let case = Case::new(&g, "f", outputs.to_vec(), &[]);
        source_code(&g, &[], &[case.function()], Language::C).unwrap()
    };
    assert_eq!(code([0, 1, 2]), code([2, 1, 0]));
    assert_eq!(code([0, 1, 2]), code([1, 0, 2]));
}

/// The reciprocal functions use the sine and cosine that are computed anyway, and roots the square root.
#[test]
fn sines_cosines_and_roots_are_computed_once() {
    let g = Graph::new();
    let texts = [
        "sin(x) + csc(x)",
        "cos(x)*sec(x)^2 + csc(x)",
        "sqrt(y) + 1/sqrt(y)",
        "y^(3/2)*x",
    ];
    let outputs: Vec<Expr> = texts.iter().map(|text| read(&g, text)).collect();
    let case = Case::new(&g, "f", outputs, &[]);
    let code = source_code(&g, &[], &[case.function()], Language::C).unwrap();
    for call in ["sin(x)", "cos(x)", "sqrt(y)"] {
        assert_eq!(code.matches(call).count(), 1, "{code}");
    }
    assert!(!code.contains("pow"), "{code}");
}

#[test]
fn what_cannot_be_computed_is_an_error() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let error = |inputs: Vec<Symbol>, output: Expr| {
        let function = CodeFunction {
            name: "f",
            documentation: Vec::new(),
            time: None,
            inputs: vec![("x", inputs)],
            outputs: vec![("y", vec![output])],
        };
        source_code(&g, &[], &[function], Language::Rust).unwrap_err()
    };
    let symbol = g.intern_symbol("x", 0);
    assert_eq!(
        error(vec![symbol], g.add(&[x, g.symbol("x", 2)])),
        CodeError::SymbolWithoutInput {
            function: "f".into(),
            symbol: "x''".into()
        }
    );
    assert_eq!(
        error(vec![symbol], g.apply(Function::Sin, &[x, x])),
        CodeError::UnknownFunction {
            function: "f".into(),
            applied: "sin".into(),
            arguments: 2
        }
    );
    let matrix = g.matrix(1, 2, &[x, x]).unwrap();
    let not_scalar = CodeError::NotScalar {
        function: "f".into(),
    };
    assert_eq!(error(vec![symbol], matrix), not_scalar);
    assert_eq!(error(vec![symbol], g.add(&[x, matrix])), not_scalar);
}

/// A chain as deep as it is long, with a sum as wide: the text is proportional to it, and no statement is long.
#[test]
fn deep_and_wide_graphs_take_linear_time() {
    let size = |length: i64| {
        let g = Graph::new();
        let (start, a) = (g.symbol("x", 0), g.symbol("a", 0));
        let chain = (0..length).fold(start, |x, _| g.add(&[g.sin(x), g.mul(&[a, x])]));
        let terms: Vec<Expr> = (1..length)
            .map(|k| g.sin(g.mul(&[g.integer(k), a])))
            .collect();
        let case = Case::new(&g, "f", vec![chain, g.add(&terms)], &[]);
        let code = source_code(&g, &[], &[case.function()], Language::C).unwrap();
        assert!(code.split(';').all(|statement| statement.len() < 1000));
        code.len() as f64
    };
    let (once, four_times) = (size(10_000), size(40_000));
    assert!(
        (3.5..5.0).contains(&(four_times / once)),
        "{once} {four_times}"
    );
}
