//! The language of expressions, from text to graph.

use super::ast::{Binary, NamePart, Node, NodeId, Tree};
use super::lower::{lower, Resolution, Scope};
use super::parse::{parse_equation, parse_expression, parse_range, parse_relation};
use super::Relation;
use crate::graph::Graph;
use crate::node::Expr;

/// Fully parenthesised text of a tree; `?` where it could not be read.
fn shape(tree: &Tree, id: NodeId) -> String {
    let of = |id: &NodeId| shape(tree, *id);
    match tree.node(id) {
        Node::Number(value) => value.to_string(),
        Node::Name { parts, order, .. } => {
            let mut text = String::new();
            for part in parts {
                match part {
                    NamePart::Text(piece) => text += piece,
                    NamePart::Index(index) => text += &format!("{{{}}}", of(index)),
                }
            }
            text + &"'".repeat(*order as usize)
        }
        Node::Negate(operand) => format!("(-{})", of(operand)),
        Node::Binary {
            operation,
            left,
            right,
        } => {
            let sign = match operation {
                Binary::Add => "+",
                Binary::Subtract => "-",
                Binary::Multiply => "*",
                Binary::Divide => "/",
                Binary::Power => "^",
            };
            format!("({}{sign}{})", of(left), of(right))
        }
        Node::Call {
            function,
            arguments,
            power,
        } => {
            let arguments: Vec<String> = arguments.iter().map(of).collect();
            let power = power
                .as_ref()
                .map_or(String::new(), |power| format!("^{power}"));
            format!("{}{power}({})", function.name(), arguments.join(","))
        }
        Node::Sum {
            index,
            from,
            to,
            body,
        } => format!("sum({index}={}..{},{})", of(from), of(to), of(body)),
        Node::Error => "?".to_owned(),
    }
}

fn check(source: &str, expected: &str) {
    let parsed = parse_expression(source);
    assert_eq!(shape(&parsed.tree, parsed.root()), expected, "{source}");
    assert!(!parsed.has_errors(), "{source}: {:?}", parsed.diagnostics);
}

#[test]
fn precedence() {
    check("a+b*c", "(a+(b*c))");
    check("a-b-c", "((a-b)-c)");
    check("a/b/c", "((a/b)/c)");
    check("a^b^c", "(a^(b^c))");
    check("a**b**c", "(a^(b^c))");
    check("-x^2", "(-(x^2))");
    check("-x*y", "((-x)*y)");
    check("2^-x^2", "(2^(-(x^2)))");
    check("2^-x*y", "((2^(-x))*y)");
    check("a - -b", "(a-(-b))");
    check("+a", "a");
    check("1/2 m x'^2", "(((1/2)*m)*(x'^2))");
    check("2 m x'^2", "((2*m)*(x'^2))");
    check("a b^c d", "((a*(b^c))*d)");
    check("a (x+1)", "(a*(x+1))");
    check("a(x+1)(y-1)", "((a*(x+1))*(y-1))");
    check("a cos(theta)", "(a*cos(theta))");
    check("2(x+1)^2", "(2*((x+1)^2))");
    check("2x", "(2*x)");
    check("x''+y'", "(x''+y')");
    check("(x)", "x");
}

#[test]
fn quotients_and_implicit_products_associate_to_the_left_with_a_warning() {
    check("a/b c", "((a/b)*c)");
    let warned = |source: &str| {
        parse_expression(source)
            .diagnostics
            .iter()
            .map(|d| d.code)
            .collect::<Vec<_>>()
    };
    assert_eq!(warned("a/b c"), ["quotient-then-factor"]);
    assert_eq!(warned("a/(b+1) c"), ["quotient-then-factor"]);
    assert!(warned("1/2 m x'^2").is_empty());
    assert!(warned("(a/b) c").is_empty());
    assert!(warned("a/b*c").is_empty());
    assert!(warned("a/(b c)").is_empty());
}

#[test]
fn greek_subscripts_and_other_signs() {
    check("θ′² + ϑ", "((theta'^2)+theta)");
    check("q₁ + q_1", "(q_1+q_1)");
    check("2·x − 3×y", "((2*x)-(3*y))");
    check("x″", "x''");
    check("ω² r", "((omega^2)*r)");
    check("π/2", "(pi/2)");
}

#[test]
fn functions() {
    check("sin^2(x) + cos(x)^2", "(sin^2(x)+(cos(x)^2))");
    check("sin²(x)", "sin^2(x)");
    check("ln(x)", "log(x)");
    check("arctan2(y, x)", "atan2(y,x)");
    check("sqrt(2 x)", "sqrt((2*x))");
    check("e^x", "(e^x)");
    check("th x", "(th*x)");
}

#[test]
fn indexed_names_and_sums() {
    check("theta_{i-1}'^2", "(theta_{(i-1)}'^2)");
    check("a_{i,2 j}_x", "a_{i}_{(2*j)}_x");
    check(
        "sum(i = 1..n, l_{i} cos(theta_{i}))",
        "sum(i=1..n,(l_{i}*cos(theta_{i})))",
    );
    check(
        "sum(i = 1..n-1, sum(j = i+1..n, x_{i} x_{j}))",
        "sum(i=1..(n-1),sum(j=(i+1)..n,(x_{i}*x_{j})))",
    );
}

/// The codes of the diagnostics with the texts they point at.
fn problems(source: &str) -> Vec<(&'static str, &str)> {
    parse_expression(source)
        .diagnostics
        .iter()
        .map(|d| (d.code, d.span.text(source)))
        .collect()
}

#[test]
fn each_slip_gives_one_diagnostic_at_its_place() {
    assert_eq!(
        problems("m*(x'^2/2 - cos(x)"),
        [("unbalanced-parenthesis", "(")]
    );
    assert_eq!(problems("(x + 1))"), [("unbalanced-parenthesis", ")")]);
    assert_eq!(problems("sin(x, 2)"), [("wrong-arity", "2")]);
    assert_eq!(problems("sin()"), [("wrong-arity", "sin()")]);
    assert_eq!(problems("atan2(x)"), [("wrong-arity", "atan2(x)")]);
    assert_eq!(problems("sin x"), [("function-without-argument", "sin")]);
    assert_eq!(
        problems("sin^-1(x)"),
        [("function-without-argument", "sin")]
    );
    assert_eq!(problems("sin'(x)"), [("derivative-of-function", "sin'")]);
    assert_eq!(problems("(x+y)'"), [("stray-prime", "(x+y)'")]);
    assert_eq!(problems("x^2'"), [("stray-prime", "2'")]);
    assert_eq!(problems("x + "), [("missing-operand", "+")]);
    assert_eq!(problems("x + * y"), [("missing-operand", "*")]);
    assert_eq!(problems("x 2"), [("number-after-factor", "x 2")]);
    assert_eq!(problems("0,5 x"), [("stray-comma", ",")]);
    assert_eq!(problems("f(x, y)"), [("stray-comma", ",")]);
    assert_eq!(problems("x = y"), [("unexpected-relation", "=")]);
    assert_eq!(
        problems("2 [x + y]"),
        [("unexpected-character", "["), ("unexpected-character", "]")]
    );
    assert_eq!(problems("sum(x)"), [("malformed-sum", "sum")]);
    assert_eq!(problems("sum(i = 1, x)"), [("malformed-sum", ",")]);
    assert_eq!(problems("x(t)"), [("name-applied-to-time", "x(t)")]);
    assert_eq!(problems(""), [("empty-expression", "")]);
    assert_eq!(problems("1e99999"), [("number-out-of-range", "1e99999")]);
}

#[test]
fn several_slips_are_all_reported() {
    let codes: Vec<&str> = problems("sin(x, 2) + (x+y)' + cos y")
        .into_iter()
        .map(|problem| problem.0)
        .collect();
    assert_eq!(
        codes,
        ["wrong-arity", "stray-prime", "function-without-argument"]
    );
}

#[test]
fn suggestions_are_texts_that_read_well() {
    let suggested = |source: &str| {
        let suggestion = parse_expression(source).diagnostics[0]
            .suggestion
            .clone()
            .unwrap();
        let mut text = source.to_owned();
        text.replace_range(
            suggestion.span.start..suggestion.span.end,
            &suggestion.replacement,
        );
        assert!(!parse_expression(&text).has_errors(), "{text}");
        text
    };
    assert_eq!(suggested("sin x + 1"), "sin(x) + 1");
    assert_eq!(suggested("atan(y, x)"), "atan2(y, x)");
    assert_eq!(suggested("x(t) + 1"), "x + 1");
    assert_eq!(suggested("0,5 x"), "0.5 x");
    assert_eq!(suggested("2 (x + 1"), "2 (x + 1)");
}

#[test]
fn equations_ranges_and_chains() {
    let parsed = parse_equation("y' cos(phi) = x' sin(phi)");
    assert!(parsed.diagnostics.is_empty());
    assert_eq!(shape(&parsed.tree, parsed.sides[1]), "(x'*sin(phi))");
    assert_eq!(
        parse_equation("x + y").diagnostics[0].code,
        "missing-equals"
    );
    assert_eq!(
        parse_equation("x = y = z").diagnostics[0].code,
        "second-equals"
    );
    assert_eq!(parse_equation("x < y").diagnostics[0].code, "inequality");
    let parsed = parse_relation("0 < θ ≤ pi");
    assert!(parsed.diagnostics.is_empty());
    assert_eq!(parsed.sides.len(), 3);
    assert_eq!(
        parsed.relations.iter().map(|r| r.0).collect::<Vec<_>>(),
        [Relation::Less, Relation::LessOrEqual]
    );
    assert_eq!(parse_range("1..n").sides.len(), 2);
    assert_eq!(parse_range("n").diagnostics[0].code, "missing-range");
}

#[test]
fn depth_is_no_obstacle() {
    let depth = 100_000;
    let nested = format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    check(&nested, "x");
    let unclosed = parse_expression(&"(".repeat(depth));
    assert!(unclosed.has_errors() && unclosed.diagnostics.len() < 10);
    let graph = Graph::new();
    for source in [
        format!("{}x", "-".repeat(depth)),
        format!("{}x", "2^".repeat(depth)),
        format!("x{}", "+x".repeat(depth)),
    ] {
        let parsed = parse_expression(&source);
        assert!(!parsed.has_errors());
        let mut diagnostics = Vec::new();
        assert!(lower(
            &graph,
            &parsed.tree,
            parsed.root(),
            &Letters(&graph),
            &[],
            &mut diagnostics
        )
        .is_some());
    }
}

/// x, y and theta vary, m is a parameter, n is 3.
struct Letters<'g>(&'g Graph);

impl Scope for Letters<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        match name {
            "x" | "y" | "theta" | "t" | "q_1" | "q_2" | "q_3" => {
                Resolution::Known(self.0.symbol(name, order))
            }
            "n" => Resolution::Known(self.0.integer(3)),
            "m" if order == 0 => Resolution::Known(self.0.symbol(name, 0)),
            "m" => Resolution::Refused {
                code: "derivative-of-constant",
                message: "`m` is a parameter and has no derivative".into(),
                hint: String::new(),
            },
            _ => Resolution::Unknown,
        }
    }

    fn names(&self) -> Vec<String> {
        ["x", "y", "theta", "m", "n", "q_1", "q_2", "q_3"]
            .map(str::to_owned)
            .to_vec()
    }
}

fn lowered(graph: &Graph, source: &str) -> Result<Expr, Vec<super::Diagnostic>> {
    let parsed = parse_expression(source);
    let mut diagnostics = parsed.diagnostics.clone();
    lower(
        graph,
        &parsed.tree,
        parsed.root(),
        &Letters(graph),
        &[],
        &mut diagnostics,
    )
    .ok_or(diagnostics)
}

#[test]
fn lowering_gives_the_expression_built_by_hand() {
    let g = Graph::new();
    let (x, xd, y, m) = (
        g.symbol("x", 0),
        g.symbol("x", 1),
        g.symbol("y", 0),
        g.symbol("m", 0),
    );
    let half = g.div(g.one(), g.integer(2));
    assert_eq!(
        lowered(&g, "1/2 m x'^2"),
        Ok(g.mul(&[half, m, g.powi(xd, 2)]))
    );
    assert_eq!(
        lowered(&g, "x - y - 0.5"),
        Ok(g.add(&[x, g.neg(y), g.neg(half)]))
    );
    assert_eq!(lowered(&g, "sin^2(x)"), Ok(g.powi(g.sin(x), 2)));
    assert_eq!(
        lowered(&g, "x/(2 y) m"),
        Ok(g.mul(&[x, m, g.powi(g.mul(&[g.integer(2), y]), -1)]))
    );
    assert_eq!(lowered(&g, "sqrt(x)"), Ok(g.sqrt(x)));
    assert_eq!(lowered(&g, "θ"), Ok(g.symbol("theta", 0)));
}

#[test]
fn sums_expand_over_known_ranges() {
    let g = Graph::new();
    let q = |i: i64| g.symbol(&format!("q_{i}"), 0);
    let expected = g.add(&[
        q(1),
        g.mul(&[g.integer(2), q(2)]),
        g.mul(&[g.integer(3), q(3)]),
    ]);
    assert_eq!(lowered(&g, "sum(i = 1..n, i q_{i})"), Ok(expected));
    assert_eq!(lowered(&g, "sum(i = 1..0, x)"), Ok(g.zero()));
    let pairs = g.add(&[
        g.mul(&[q(1), q(2)]),
        g.mul(&[q(1), q(3)]),
        g.mul(&[q(2), q(3)]),
    ]);
    assert_eq!(
        lowered(&g, "sum(i = 1..n-1, sum(j = i+1..n, q_{i} q_{j}))"),
        Ok(pairs)
    );
    assert_eq!(
        lowered(&g, "sum(i = 1..x, i)").unwrap_err()[0].code,
        "bad-range"
    );
    assert_eq!(
        lowered(&g, "sum(i = 1..n, q_{x})").unwrap_err()[0].code,
        "bad-index"
    );
    assert_eq!(
        lowered(&g, "sum(i = 1..10^9, i)").unwrap_err()[0].code,
        "too-large"
    );
}

#[test]
fn names_without_meaning_are_all_reported_with_the_nearest_name() {
    let g = Graph::new();
    let problems =
        lowered(&g, "m*(x'^2 + thta'^2) + m' + mx + θym + sine(x) + 1/(2-2)").unwrap_err();
    let told: Vec<(&str, Option<&str>)> = problems
        .iter()
        .map(|d| {
            (
                d.code,
                d.suggestion.as_ref().map(|s| s.replacement.as_str()),
            )
        })
        .collect();
    assert_eq!(
        told,
        [
            ("unknown-name", Some("theta")),
            ("derivative-of-constant", None),
            ("unknown-name", Some("m x")),
            ("unknown-name", Some("theta y m")),
            ("unknown-name", Some("sin")),
            ("division-by-zero", None),
        ]
    );
    assert!(problems[1].message.contains("`m`"));
}

#[test]
fn values_that_are_not_real_are_refused() {
    let g = Graph::new();
    for source in ["sqrt(-2)", "log(0)", "log(-1)", "(-8)^(1/3)", "0^-1"] {
        assert!(lowered(&g, source).is_err(), "{source}");
    }
}

/// A pseudo-random sequence for mutations (xorshift, Marsaglia 2003).
fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

#[test]
fn mutated_expressions_never_panic() {
    let seeds = [
        "1/2 m (x'^2 + y'^2) - m*(x sin^2(theta) + 0.5e-3)",
        "sum(i = 1..n, q_{i} cos(θ)^-2/(x y))",
        "atan2(y', x') = π/2 < 3",
    ];
    let alphabet: Vec<char> = "xy'′²₁()[]{}+-*/^=<>.,eθπ_m0159 ☃\"\\".chars().collect();
    let g = Graph::new();
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    for round in 0..3000 {
        let mut text: Vec<char> = seeds[round % seeds.len()].chars().collect();
        for _ in 0..=next(&mut state) % 6 {
            let at = (next(&mut state) as usize) % text.len().max(1);
            let sign = alphabet[(next(&mut state) as usize) % alphabet.len()];
            match next(&mut state) % 3 {
                0 if !text.is_empty() => drop(text.remove(at)),
                1 => text.insert(at.min(text.len()), sign),
                _ if at < text.len() => text[at] = sign,
                _ => {}
            }
        }
        let source: String = text.into_iter().collect();
        for parsed in [
            parse_expression(&source),
            parse_equation(&source),
            parse_relation(&source),
            parse_range(&source),
        ] {
            for diagnostic in &parsed.diagnostics {
                assert!(
                    source
                        .get(diagnostic.span.start..diagnostic.span.end)
                        .is_some(),
                    "{source}: {diagnostic:?}"
                );
            }
            for side in &parsed.sides {
                let mut diagnostics = Vec::new();
                let value = lower(&g, &parsed.tree, *side, &Letters(&g), &[], &mut diagnostics);
                assert!(
                    value.is_some() || parsed.has_errors() || !diagnostics.is_empty(),
                    "{source}"
                );
            }
        }
    }
}
