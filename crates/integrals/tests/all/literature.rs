//! Darboux polynomials of the literature: each polynomial that a source gives is found, and what is found is one.

use crate::common::{expr, flow};
use chetaev_integrals::darboux::{pairs, Darboux, Pairs, Work};
use chetaev_integrals::flow::Flow;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Verdict};

fn is_zero(g: &Graph, e: Expr) -> bool {
    let verdict = decide_zero(g, &ZeroTest::everywhere(&[e], &Assumptions::new()));
    matches!(verdict, Verdict::Proved(_))
}

fn search(flow: &Flow<'_>, degree: u32) -> Pairs {
    let work = Work {
        degree,
        ..Work::default()
    };
    pairs(flow, work, 7)
}

/// The real polynomials, a conjugate pair by its product.
fn real(g: &Graph, found: &Pairs) -> Vec<Expr> {
    let product = |own: &Darboux| match *own {
        Darboux::One(e) => e,
        Darboux::Conjugate {
            first,
            second,
            square,
        } => g.sub(g.powi(first, 2), g.mul(&[square, g.powi(second, 2)])),
    };
    found.found.iter().map(product).collect()
}

/// Whether two functions are the same up to a factor that contains no variable.
fn are_proportional(flow: &Flow<'_>, a: Expr, b: Expr) -> bool {
    let g = flow.graph;
    let mut variables = flow.variables.iter();
    variables.all(|v| {
        let slope = |e: Expr, other: Expr| g.mul(&[g.diff(e, v.symbol), other]);
        is_zero(g, g.sub(slope(a, b), slope(b, a)))
    })
}

/// The polynomials stated are those found.
fn finds(rates: &[(&str, &str)], degree: u32, stated: &[&str]) {
    let g = Graph::new();
    let flow = flow(&g, rates);
    let found = search(&flow, degree);
    let own = real(&g, &found);
    let texts: Vec<String> = own.iter().map(|&e| g.text(e)).collect();
    for text in stated {
        let wanted = expr(&g, text);
        let is_found = own.iter().any(|&e| are_proportional(&flow, e, wanted));
        assert!(is_found, "{text} of {rates:?} among {texts:?}");
    }
    assert_eq!(own.len(), stated.len(), "of {rates:?}: {texts:?}");
    assert_eq!(found.open, 0, "of {rates:?}");
}

/// A limit cycle: Q = u² + v² has the cofactor 2(1 - Q), Q - 1 the cofactor -2Q.
#[test]
fn a_limit_cycle() {
    finds(
        &[
            ("u", "u - v - u (u^2 + v^2)"),
            ("v", "u + v - v (u^2 + v^2)"),
        ],
        4,
        &["u^2 + v^2", "u^2 + v^2 - 1"],
    );
}

/// Volterra's predators and prey: the axes alone for general constants (Goriely 2001, ch. 2).
#[test]
fn lotka_and_volterra() {
    finds(
        &[("x", "x (a - b y)"), ("y", "y (c x - d)")],
        4,
        &["x", "y"],
    );
    let third = [
        ("x", "x (1 + a y + b z)"),
        ("y", "y (1 + c x + d z)"),
        ("z", "z (1 + e x + f y)"),
    ];
    finds(&third, 2, &["x", "y", "z"]);
}

/// Lorenz's system has a Darboux polynomial of second degree for some constants (Kuś 1983; Goriely 2001, ch. 2): x² - 2 σ z for
/// b = 2 σ, y² + z² for b = 1, r = 0; none for general ones (Llibre and Zhang 2002).
#[test]
fn lorenz() {
    let rates = |b: &str, r: &str| {
        [
            ("x", "s (y - x)".to_owned()),
            ("y", format!("({r}) x - y - x z")),
            ("z", format!("x y - ({b}) z")),
        ]
    };
    let finds = |b: &str, r: &str, stated: &[&str]| {
        let own = rates(b, r);
        let own: Vec<(&str, &str)> = own.iter().map(|(name, rate)| (*name, &rate[..])).collect();
        finds(&own, 2, stated);
    };
    finds("b", "r", &[]);
    finds("2 s", "r", &["x^2 - 2 s z"]);
    finds("1", "0", &["y^2 + z^2"]);
}

/// Linear rates: the eigenvectors of the transposed matrix, `λ² - b λ - a = 0`, conjugate for general constants.
#[test]
fn linear_rates() {
    finds(
        &[("x", "y"), ("y", "a x + b y")],
        2,
        &["y^2 - b x y - a x^2"],
    );
    finds(&[("x", "y"), ("y", "2 x + y")], 2, &["y + x", "y - 2 x"]);
}

/// Prelle and Singer's and Man's standard example (Man, J. Symbolic Computation 16 (1993)): a Bernoulli-like field with an invariant
/// line and an invariant parabola.
#[test]
fn an_invariant_parabola() {
    finds(&[("x", "1"), ("y", "y - x^2 + 2 x")], 3, &["y - x^2"]);
}

/// Euler's top keeps the energy and the length of the momentum; it is the only source of polynomials without cofactor.
#[test]
fn eulers_top() {
    let g = Graph::new();
    let flow = flow(
        &g,
        &[
            ("u", "(B - C) v w/A"),
            ("v", "(C - A) w u/B"),
            ("w", "(A - B) u v/C"),
        ],
    );
    let found = search(&flow, 2);
    assert_eq!(found.integrals.len(), 2);
    let rates = flow.derivatives(&found.integrals);
    assert!(rates.into_iter().all(|rate| is_zero(&g, rate)));
}

/// Sines and cosines are letters: `u' = u tan φ φ'` keeps u cos φ, whose factors have the cofactors ±φ' tan φ.
#[test]
fn functions_of_an_angle() {
    let g = Graph::new();
    let flow = flow(
        &g,
        &[("phi", "w"), ("w", "0"), ("u", "u w sin(phi)/cos(phi)")],
    );
    let found = search(&flow, 2);
    let own = real(&g, &found);
    for wanted in ["u", "cos(phi)"] {
        assert!(own.contains(&expr(&g, wanted)), "{wanted}");
    }
}

/// Every polynomial has a cofactor: `X P/P` has no pole where P vanishes, which is `X P = K P` at one state of P = 0.
#[test]
fn zeros_are_invariant() {
    let g = Graph::new();
    let flow = flow(&g, &[("x", "x (2 - x - y)"), ("y", "y (1 - y/2 - 3 x/4)")]);
    let found = search(&flow, 3);
    assert!(found.families.iter().all(|family| family.exhausted));
    assert_eq!(real(&g, &found).len(), 2);
}
