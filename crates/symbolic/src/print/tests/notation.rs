//! The notation, format by format.

use super::{options, read};
use crate::graph::Graph;
use crate::print::{Document, Format, Options};

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
        "<msup><mover><mi>x</mi><mo lspace=\"0\" rspace=\"0\" stretchy=\"false\">\u{2d9}</mo></mover><mn>2</mn></msup>",
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
        [
            "sp.Eq(x.diff(t, 2), F, evaluate=False)",
            "sp.Eq(y.diff(t, 2), -g, evaluate=False)"
        ]
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
