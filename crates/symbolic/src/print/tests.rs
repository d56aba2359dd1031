use super::{Document, Format, Options};
use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::number::random::Random;
use crate::rational::{self, ratio, Rational};
use crate::syntax::{lower, parse_equation, parse_expression, Resolution, Scope};
use std::collections::BTreeMap;

/// Every name is a symbol, apart from those given an expression.
struct Names<'a> {
    g: &'a Graph,
    defined: BTreeMap<String, Expr>,
}

impl Scope for Names<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        let defined = self.defined.get(name).filter(|_| order == 0).copied();
        Resolution::Known(defined.unwrap_or_else(|| self.g.symbol(name, order)))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

fn read_side(g: &Graph, text: &str, side: usize, defined: &BTreeMap<String, Expr>) -> Expr {
    let parsed = if text.contains('=') {
        parse_equation(text)
    } else {
        parse_expression(text)
    };
    let mut diagnostics = parsed.diagnostics.clone();
    let scope = Names {
        g,
        defined: defined.clone(),
    };
    let e = lower(
        g,
        &parsed.tree,
        parsed.sides[side],
        &scope,
        &[],
        &mut diagnostics,
    );
    // Not even a warning: what is printed has one reading.
    assert!(diagnostics.is_empty(), "{text}\n{diagnostics:?}");
    e.unwrap()
}

fn read(g: &Graph, text: &str) -> Expr {
    read_side(g, text, 0, &BTreeMap::new())
}

fn options(coordinates: &[&str]) -> Options {
    Options {
        coordinates: coordinates.iter().map(|c| c.to_string()).collect(),
        ..Options::default()
    }
}

fn printed(source: &str, format: Format) -> String {
    let g = Graph::new();
    let e = read(&g, source);
    Document::expressions(&g, &[e], &options(&["x", "y", "phi", "theta"])).render(format)
}

/// Each line is what a person writes, and has to be printed as it stands.
#[test]
fn text_as_a_person_writes_it() {
    for line in [
        "0",
        "-3/4",
        "pi/2",
        "3 pi/4",
        "sqrt(3)/2",
        "x/2",
        "(x + y)^2/2",
        "1/2 m x'^2",
        "1/2 m (x'^2 + y'^2)^2",
        "m g/(1 + a^2)",
        "-m phi' (x' cos(phi) + y' sin(phi))",
        "(J + m a^2) phi''",
        "m x'' + m a phi'' sin(phi) + m a phi'^2 cos(phi) + k x",
        "x' sin(phi) - y' cos(phi)",
        "y' cos(phi) - x' sin(phi)",
        "1 - cos(theta)",
        "1/(2 a)",
        "m g/(2 (1 + a^2))",
        "1/sqrt(x'^2 + y'^2)",
        "a/(x'^2 + y'^2)^(3/2)",
        "x^2 + 2 x + 1",
        "x^n",
        "x^(-n)",
        "(x^n)^k",
        "x^(n^k)",
        "2*3^x",
        "2*3^(1/3) m",
        "(1/2)^x",
        "-x^2",
        "a cos(x)^2 + b sin(x)^2",
        "m g a (1 - cos(theta))",
        "atan2(y, x)",
        "exp(-k t)",
        "abs(x'')",
        "sqrt(x^2)",
        "x''''",
        "m_1 x + m_2 y + m_10",
        "-x - y",
        "-k (x - y)^3",
    ] {
        assert_eq!(printed(line, Format::Text), line);
    }
}

#[test]
fn latex_as_a_textbook_prints_it() {
    for (source, expected) in [
        ("1/2 m x'^2", r"\frac{1}{2} m \dot{x}^2"),
        ("theta_1''", r"\ddot{\theta}_1"),
        ("x''' + x''''", r"x^{(4)} + \dddot{x}"),
        ("x''''^2", r"(x^{(4)})^2"),
        ("lambda_blade", r"\lambda_{\mathrm{blade}}"),
        ("q_1_2 + mass", r"\mathrm{mass} + q_{1,2}"),
        ("sin(phi)^2 x", r"x \sin^2 \varphi"),
        (
            "m x' cos(phi) sin(phi)",
            r"m \dot{x} \sin \varphi \cos \varphi",
        ),
        ("sin(2 phi)", r"\sin(2 \varphi)"),
        ("sin(phi/2)", r"\sin\left(\frac{\varphi}{2}\right)"),
        (
            "-m cos(phi) (x' + y'')",
            r"-m \cos(\varphi) (\ddot{y} + \dot{x})",
        ),
        ("sqrt(x'^2 + y'^2)", r"\sqrt{\dot{x}^2 + \dot{y}^2}"),
        ("x^(3/2)", r"x^{3/2}"),
        ("x^(1/3)", r"\sqrt[3]{x}"),
        ("exp(-k t)", r"\mathrm{e}^{-k t}"),
        ("exp(-x^2/2)", r"\mathrm{e}^{-x^2/2}"),
        ("Q_theta_1", r"Q_{\theta_1}"),
        ("abs(x)", r"\left|x\right|"),
        ("m g/(1 + a^2)", r"\frac{m g}{1 + a^2}"),
        ("(x/(1+a))^n", r"\left(\frac{x}{1 + a}\right)^n"),
        ("2*3^x", r"2 \cdot 3^x"),
        ("asin(x)^2", r"(\arcsin x)^2"),
    ] {
        assert_eq!(printed(source, Format::Latex), expected, "{source}");
    }
}

#[test]
fn sympy_is_exact_and_hides_no_name() {
    for (source, expected) in [
        ("1/2 m x'^2", "sp.Rational(1, 2)*m*x.diff(t)**2"),
        ("x''", "x.diff(t, 2)"),
        ("lambda + I", "I + lambda_"),
        ("sqrt(3)/2", "sp.sqrt(3)/2"),
        ("2*3^(1/3)", "2*sp.root(3, 3)"),
        ("2^x", "sp.Integer(2)**x"),
        ("m g/(2 (1 + a^2))", "m*g/(2*(1 + a**2))"),
        ("-x^(-n)", "-x**(-n)"),
        ("abs(sin(t))", "sp.Abs(sp.sin(t))"),
    ] {
        assert_eq!(printed(source, Format::Sympy), expected);
    }
}

#[test]
fn json_is_a_tree() {
    assert_eq!(
        printed("-1/2 m x'^2 + sin(phi)/a", Format::Json),
        r#"["Add",["Negate",["Multiply",["Rational",1,2],"m",["Power",["Derivative","x",1],2]]],["Divide",["Sin","phi"],"a"]]"#
    );
}

#[test]
fn mathml_of_a_kinetic_energy() {
    let expected = concat!(
        "<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mrow>",
        "<mfrac><mn>1</mn><mn>2</mn></mfrac><mo>&#x2062;</mo><mi>m</mi><mo>&#x2062;</mo>",
        "<msup><mover accent=\"true\"><mi>x</mi><mo stretchy=\"false\">\u{2d9}</mo></mover><mn>2</mn></msup>",
        "</mrow></math>"
    );
    assert_eq!(printed("1/2 m x'^2", Format::Mathml), expected);
}

#[test]
fn names_are_escaped() {
    let g = Graph::new();
    let e = g.symbol("<b>&\"", 0);
    assert!(g.mathml(e).contains("<mi>&lt;b&gt;&amp;&quot;</mi>"));
    assert_eq!(g.latex(g.symbol("a%b", 0)), r"\mathrm{a\%b}");
    assert_eq!(g.sympy(g.symbol("a'b", 0)), "a_b");
}

#[test]
fn other_names_are_typeset_but_not_written_in_languages() {
    let g = Graph::new();
    let e = g.symbol("u_1", 1);
    let mut options = options(&["u_1"]);
    options.display.insert("u_1".into(), "omega_1".into());
    let document = Document::expressions(&g, &[e], &options);
    assert_eq!(document.render(Format::Latex), r"\dot{\omega}_1");
    assert_eq!(document.render(Format::Text), "u_1'");
}

#[test]
fn order_is_the_callers_where_one_is_given() {
    let g = Graph::new();
    let e = read(&g, "b a x + c a y");
    let options = Options {
        coordinates: vec!["y".into(), "x".into()],
        parameters: vec!["c".into(), "b".into()],
        ..Options::default()
    };
    let document = Document::expressions(&g, &[e], &options);
    assert_eq!(document.render(Format::Text), "c a y + b a x");
}

/// Two graphs built in different orders print the same.
#[test]
fn output_does_not_depend_on_history() {
    let sources = [
        "w (x + y)^2 (sin(x y) + cos(x z)) + sqrt(x z + y) + atan(x y z)",
        "(x + y)^3 / (y z + sin(x y)) + sin(x + y) cos(y + z) cos(x + y z)",
    ];
    let forwards = Graph::new();
    let first: Vec<String> = sources
        .iter()
        .map(|s| forwards.text(read(&forwards, s)))
        .collect();
    let backwards = Graph::new();
    for name in ["z", "y", "x"] {
        backwards.symbol(name, 0);
    }
    let second = sources
        .iter()
        .rev()
        .map(|s| backwards.text(read(&backwards, s)));
    assert!(first.into_iter().rev().eq(second));
}

#[test]
fn equations_are_aligned() {
    let g = Graph::new();
    let (x, y) = (g.symbol("x", 2), g.symbol("y", 2));
    let equations = [(x, g.symbol("F", 0)), (y, g.neg(g.symbol("g", 0)))];
    let document = Document::equations(&g, &equations, &Options::default());
    assert_eq!(document.render(Format::Text), "x'' = F\ny'' = -g");
    assert_eq!(
        document.render(Format::Latex),
        "\\begin{aligned}\n\\ddot{x} &= F \\\\\n\\ddot{y} &= -g\n\\end{aligned}"
    );
    assert_eq!(
        document.parts(Format::Sympy).statements,
        ["sp.Eq(x.diff(t, 2), F)", "sp.Eq(y.diff(t, 2), -g)"]
    );
}

#[test]
fn matrices_print_row_by_row() {
    let g = Graph::new();
    let entries = [g.symbol("a", 0), g.zero(), g.integer(-1), g.symbol("b", 0)];
    let document = Document::matrix(&g, 2, &entries, &Options::default());
    assert_eq!(document.render(Format::Text), "[a, 0; -1, b]");
    assert_eq!(
        document.render(Format::Latex),
        "\\begin{pmatrix}a & 0 \\\\ -1 & b\\end{pmatrix}"
    );
    assert_eq!(
        document.render(Format::Sympy),
        "sp.Matrix([[a, 0], [-1, b]])"
    );
}

fn solved(g: &Graph) -> Vec<Expr> {
    let entry = |s: &str| read(g, s);
    let matrix = [
        entry("m + M"),
        entry("m l cos(phi)"),
        entry("m l cos(phi)"),
        entry("m l^2"),
    ];
    let rhs = [entry("F"), entry("-m g l sin(phi)")];
    g.solve(&matrix, &rhs).unwrap()
}

#[test]
fn a_solve_is_stated_once_as_its_system() {
    let g = Graph::new();
    let solution = solved(&g);
    let equations = [
        (g.symbol("x", 2), solution[0]),
        (g.symbol("phi", 2), solution[1]),
    ];
    let document = Document::equations(&g, &equations, &Options::default());
    assert_eq!(document.definition_count(), 1);
    let text = document.render(Format::Text);
    assert!(
        text.starts_with("x'' = s_1\nphi'' = s_2\nwhere\n"),
        "{text}"
    );
    let rows = document.parts(Format::Text).definitions;
    assert_eq!(rows.len(), 2);
    assert!(
        rows.iter().any(|row| row.ends_with("= -m g l sin(phi)")),
        "{rows:?}"
    );
    assert!(document
        .render(Format::Sympy)
        .contains("[s_1, s_2] = sp.Matrix([["));
    assert!(document
        .render(Format::Latex)
        .contains("\\begin{pmatrix}s_1 \\\\ s_2\\end{pmatrix}"));
}

#[test]
fn names_of_definitions_avoid_the_names_of_the_model() {
    let g = Graph::new();
    let e = g.add(&[solved(&g)[0], g.symbol("s_7", 0)]);
    let document = Document::expressions(&g, &[e], &Options::default());
    assert_eq!(
        document.render(Format::Text).lines().next(),
        Some("s_7 + z_1")
    );
}

/// x ← x² + y x, repeated: the tree has more than 2^depth nodes.
fn iterated(g: &Graph, depth: usize) -> Expr {
    let (mut x, y) = (g.symbol("x", 0), g.symbol("y", 0));
    for _ in 0..depth {
        x = g.add(&[g.sin(x), g.mul(&[y, x])]);
    }
    x
}

#[test]
fn a_shared_graph_does_not_explode() {
    let g = Graph::new();
    let e = iterated(&g, 300);
    assert_eq!(g.tree_size(e), u64::MAX);
    for format in [
        Format::Text,
        Format::Latex,
        Format::Mathml,
        Format::Sympy,
        Format::Json,
    ] {
        let document = Document::expressions(&g, &[e], &Options::default());
        assert!(document.render(format).len() < 200_000, "{format:?}");
        assert!(document.definition_count() > 50);
    }
}

#[test]
fn deep_expressions_are_cut_into_pieces() {
    let g = Graph::new();
    let (mut e, y) = (g.symbol("x", 0), g.symbol("y", 0));
    for _ in 0..100_000 {
        e = g.sin(g.add(&[e, y]));
    }
    let document = Document::expressions(&g, &[e], &Options::default());
    for part in document.parts(Format::Mathml).definitions {
        assert!(depth_of_tags(&part) < 200);
    }
    assert_eq!(read_document(&g, &document), [e]);
}

/// Reads the definitions one after the other, then the statements.
fn read_document(g: &Graph, document: &Document) -> Vec<Expr> {
    let mut defined = BTreeMap::new();
    let parts = document.parts(Format::Text);
    for line in &parts.definitions {
        let (name, _) = line.split_once(" = ").unwrap();
        let value = read_side_of(g, line, 1, &mut defined);
        defined.insert(name.to_string(), value);
    }
    let statements = parts.statements.iter();
    statements
        .map(|text| read_side_of(g, text, 0, &mut defined))
        .collect()
}

/// As [`read_side`], without copying the definitions.
fn read_side_of(g: &Graph, text: &str, side: usize, defined: &mut BTreeMap<String, Expr>) -> Expr {
    let parsed = if text.contains('=') {
        parse_equation(text)
    } else {
        parse_expression(text)
    };
    let scope = Names {
        g,
        defined: std::mem::take(defined),
    };
    let mut diagnostics = parsed.diagnostics.clone();
    let e = lower(
        g,
        &parsed.tree,
        parsed.sides[side],
        &scope,
        &[],
        &mut diagnostics,
    );
    *defined = scope.defined;
    assert!(diagnostics.is_empty(), "{text}\n{diagnostics:?}");
    e.unwrap()
}

struct Generator<'a> {
    g: &'a Graph,
    random: Random,
}

impl Generator<'_> {
    fn number(&mut self) -> Rational {
        ratio(self.random.between(-6, 6), self.random.between(1, 4)).unwrap()
    }

    fn leaf(&mut self) -> Expr {
        const NAMES: [&str; 9] = ["x", "y", "phi", "m", "a", "g", "q_1", "e", "lambda_blade"];
        match self.random.below(8) {
            0 => {
                let value = self.number();
                self.g.number(value)
            }
            1 => self.g.pi(),
            _ => {
                let name = NAMES[self.random.below(NAMES.len() as u64) as usize];
                self.g
                    .symbol(name, self.random.below(4).saturating_sub(1) as u32)
            }
        }
    }

    fn exponent(&mut self) -> Expr {
        match self.random.below(6) {
            0 => self.leaf(),
            1 => self.g.number(ratio(1, 2).unwrap()),
            2 => self.g.number(ratio(self.random.between(-5, 5), 3).unwrap()),
            _ => self.g.integer(self.random.between(-3, 3)),
        }
    }

    fn expression(&mut self, depth: u32) -> Expr {
        if depth == 0 {
            return self.leaf();
        }
        let g = self.g;
        let several = |this: &mut Self| -> Vec<Expr> {
            (0..this.random.between(2, 4))
                .map(|_| this.expression(depth - 1))
                .collect()
        };
        match self.random.below(9) {
            0..=2 => g.add(&several(self)),
            3..=5 => g.mul(&several(self)),
            6 | 7 => {
                let base = self.expression(depth - 1);
                let exponent = self.exponent();
                g.pow(base, exponent)
            }
            _ => {
                let all = Function::ALL;
                let function = all[self.random.below(all.len() as u64) as usize];
                let arguments: Vec<Expr> = (0..function.arity())
                    .map(|_| self.expression(depth - 1))
                    .collect();
                g.apply(function, &arguments)
            }
        }
    }
}

/// Whether a part is no real number, which the parser refuses.
fn is_undefined(g: &Graph, e: Expr) -> bool {
    let negative = |e: Expr| g.as_number(e).is_some_and(rational::is_negative);
    g.reachable(&[e]).into_iter().any(|n| match g.node(n) {
        Node::Power { base, exponent } => {
            g.is_zero(*base) || (negative(*base) && g.as_number(*exponent).is_some())
        }
        Node::Apply {
            function: Function::Log,
            arguments,
        } => g.is_zero(arguments[0]) || negative(arguments[0]),
        _ => false,
    })
}

/// Parse(print(e)) = e.
#[test]
fn reading_what_is_printed_gives_the_expression() {
    let mut read_back = 0;
    for seed in 0..3000 {
        let g = Graph::new();
        let mut generator = Generator {
            g: &g,
            random: Random::new(seed),
        };
        let e = generator.expression(1 + (seed % 4) as u32);
        if is_undefined(&g, e) {
            continue;
        }
        read_back += 1;
        for max_nodes in [u64::MAX, 20] {
            let options = Options {
                max_nodes,
                ..options(&["x", "q_1"])
            };
            let document = Document::expressions(&g, &[e], &options);
            let again = read_document(&g, &document);
            assert_eq!(again, [e], "seed {seed}: {}", document.render(Format::Text));
        }
    }
    assert!(read_back > 2500, "{read_back}");
}

/// Depth of nesting; panics where tags do not match.
fn depth_of_tags(source: &str) -> usize {
    let mut open: Vec<&str> = Vec::new();
    let mut deepest = 0;
    for part in source.split('<').skip(1) {
        let (tag, text) = part.split_once('>').unwrap();
        assert!(!text.contains(['"', '\'']), "{source}");
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name), "{source}"),
            None => open.push(tag.split(' ').next().unwrap()),
        }
        deepest = deepest.max(open.len());
    }
    assert!(open.is_empty(), "{source}");
    deepest
}

/// Number of children that each element has to have (MathML Core §3).
fn check_arity(source: &str) {
    let mut children: Vec<(String, usize)> = vec![(String::new(), 0)];
    for part in source.split('<').skip(1) {
        let (tag, _) = part.split_once('>').unwrap();
        if let Some(name) = tag.strip_prefix('/') {
            let (_, count) = children.pop().unwrap();
            let needed = match name {
                "mfrac" | "msup" | "msub" | "mover" | "mroot" => 2,
                "msubsup" => 3,
                _ => continue,
            };
            assert_eq!(count, needed, "{name} in {source}");
        } else {
            children.last_mut().unwrap().1 += 1;
            children.push((tag.to_string(), 0));
        }
    }
}

#[test]
fn typeset_output_is_well_formed() {
    for seed in 0..500 {
        let g = Graph::new();
        let mut generator = Generator {
            g: &g,
            random: Random::new(seed),
        };
        let e = generator.expression(3);
        let mathml = g.mathml(e);
        depth_of_tags(&mathml);
        check_arity(&mathml);
        let latex = g.latex(e);
        for (open, close) in [("{", "}"), ("(", ")"), ("\\left", "\\right")] {
            assert_eq!(
                latex.matches(open).count(),
                latex.matches(close).count(),
                "{latex}"
            );
        }
        let sympy = g.sympy(e);
        assert!(!sympy.contains('\'') && !sympy.contains('^'), "{sympy}");
        assert_eq!(sympy.matches('(').count(), sympy.matches(')').count());
    }
}
