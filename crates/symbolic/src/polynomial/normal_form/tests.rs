//! Identities of trigonometry, radicals and exponentials are zero; planted differences are not; the traps of T6 §6.7.

use super::*;
use crate::rational::ratio;
use crate::syntax::lower::{lower, Resolution, Scope};
use crate::syntax::parse::parse_expression;
use crate::Function;

struct AnyName<'g>(&'g Graph);

impl Scope for AnyName<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        Resolution::Known(self.0.symbol(name, order))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The expression that a text means, every unknown name a symbol.
pub(crate) fn read(g: &Graph, text: &str) -> Expr {
    let parsed = parse_expression(text);
    assert!(!parsed.has_errors(), "{text}");
    let mut diagnostics = Vec::new();
    lower(
        g,
        &parsed.tree,
        parsed.root(),
        &AnyName(g),
        &Vec::new(),
        &mut diagnostics,
    )
    .unwrap_or_else(|| panic!("{text}: {diagnostics:?}"))
}

fn is_zero(text: &str) -> Result<bool, NormalFormError> {
    let g = Graph::new();
    normal_form(&g, read(&g, text), &Budget::PROOF).map(|form| form.is_zero())
}

fn check_zero(texts: &[&str]) {
    for text in texts {
        assert_eq!(is_zero(text), Ok(true), "{text}");
    }
}

fn check_not_zero(texts: &[&str]) {
    for text in texts {
        assert_eq!(is_zero(text), Ok(false), "{text}");
    }
}

#[test]
fn rational_identities() {
    check_zero(&[
        "(x + y)^3 - x^3 - 3 x^2 y - 3 x y^2 - y^3",
        "(x - 1)(x + 1)/(x^2 - 1) - 1",
        "1/(x (x + 1)) - 1/x + 1/(x + 1)",
        "(x^6 - 1)/(x^2 - 1) - x^4 - x^2 - 1",
        "1/(1/x + 1/y) - x y/(x + y)",
        "pi x/(2 pi) - x/2",
    ]);
    check_not_zero(&[
        "(x + y)^3 - x^3 - y^3",
        "x^7 - x",
        "11 x",
        "x - y",
        "pi - 22/7",
    ]);
}

#[test]
fn trigonometric_identities() {
    check_zero(&[
        "sin(x)^2 + cos(x)^2 - 1",
        "sin(2 x) - 2 sin(x) cos(x)",
        "sin(x/2)^2 - (1 - cos(x))/2",
        "cos(3 x) - 4 cos(x)^3 + 3 cos(x)",
        "sin(x + y) - sin(x) cos(y) - cos(x) sin(y)",
        "cos(x - y) - cos(x) cos(y) - sin(x) sin(y)",
        "tan(x + y) - (tan(x) + tan(y))/(1 - tan(x) tan(y))",
        "sec(x)^2 - tan(x)^2 - 1",
        "csc(x)^2 - cot(x)^2 - 1",
        "(1 - cos(x))/sin(x) - sin(x)/(1 + cos(x))",
        "tan(x/2) - sin(x)/(1 + cos(x))",
        "sin(x + pi/2) - cos(x)",
        "sin(x + pi/3) - sin(x)/2 - sqrt(3)/2 cos(x)",
        "cos(x + y + z) + cos(x + y - z) - 2 cos(x + y) cos(z)",
        "sin(x)/3 - sin(3 (x/2 - x/6))/3",
        "sin(2 pi/5)^2 + cos(2 pi/5)^2 - 1",
        "sin(x/3 + x/2) - sin(x/3) cos(x/2) - cos(x/3) sin(x/2)",
        "sin((x + 1)^2) - sin(x^2 + 2 x + 1)",
        "sin(1/(x (x+1))) - sin(1/x) cos(1/(x+1)) + cos(1/x) sin(1/(x+1))",
        "sin(1 + x) - sin(1) cos(x) - cos(1) sin(x)",
    ]);
    check_not_zero(&[
        "sin(x)^2 - cos(x)^2 - 1",
        "sin(2 x) - sin(x) cos(x)",
        "cos(x + y) - cos(x) cos(y)",
        "sin(x) - x",
        "1/(sin(x) + 1)",
    ]);
}

#[test]
fn exponentials_and_hyperbolic_functions() {
    check_zero(&[
        "exp(x + y) - exp(x) exp(y)",
        "exp(x/2)^2 - exp(x)",
        "exp(x) exp(-x) - 1",
        "cosh(x)^2 - sinh(x)^2 - 1",
        "sinh(2 x) - 2 sinh(x) cosh(x)",
        "tanh(x) - (exp(2 x) - 1)/(exp(2 x) + 1)",
        "exp(2 log(x)) - x^2",
        "x^(a + 1) - x x^a",
        "x^(2 a) - (x^a)^2",
        "exp(y + 3 log(x + 1)) - (x + 1)^3 exp(y)",
    ]);
    check_not_zero(&[
        "exp(x + y) - exp(x) - exp(y)",
        "exp(x) - 1",
        "log(x^2) - 2 log(x)",
        "atan(x) + atan(1/x) - pi/2",
    ]);
}

#[test]
fn radicals() {
    check_zero(&[
        "sqrt(x) sqrt(y) - sqrt(x y)",
        "sqrt(x)^2 - x",
        "sqrt(x^2 + y^2)^2 - x^2 - y^2",
        "1/(sqrt(x) - sqrt(y)) - (sqrt(x) + sqrt(y))/(x - y)",
        "sqrt(2) sqrt(3) - sqrt(6)",
        "sqrt(12) - 2 sqrt(3)",
        "sqrt(x^2) - abs(x)",
        "sqrt(4 x^2 y) - 2 abs(x) sqrt(y)",
        "sqrt(x/y) - sqrt(x y)/abs(y)",
        "x^(3/2) - x sqrt(x)",
        "x^(1/2) x^(1/3) - x^(5/6)",
        "sqrt(1 - cos(x)^2) - abs(sin(x))",
        "sqrt(sin(x)^2 + cos(x)^2) - 1",
        "sqrt(x + sqrt(y))^2 - x - sqrt(y)",
        "abs(x)^2 - x^2",
        "abs(x y) - abs(x) abs(y)",
        "abs(exp(x)) - exp(x)",
        "sqrt(x^2 + 2 x y + y^2) - abs(x + y)",
        "(x^2)^(1/4) - sqrt(abs(x))",
        "sqrt(x + y) sqrt(x - y) - sqrt(x^2 - y^2)",
        "sqrt((1 - cos(x))/2) - abs(sin(x/2))",
    ]);
    check_not_zero(&[
        "sqrt(x^2) - x",
        "sqrt(x) + sqrt(y) - sqrt(x + y)",
        "sqrt(2) - 7/5",
        "sqrt(x^2 + y^2) - x - y",
        "abs(x) - x",
    ]);
}

/// At x = y = z = -1 the left side is 1 and the right side -1: roots of products must not be split factor by factor.
#[test]
fn roots_of_products_keep_their_sign() {
    check_not_zero(&["sqrt(x y) sqrt(y z) sqrt(x z) - x y z"]);
    check_zero(&["sqrt(x y) sqrt(y z) sqrt(x z) - abs(x y z)"]);
}

#[test]
fn nowhere_defined_expressions_are_refused() {
    let g = Graph::new();
    let quotient = g.div(g.zero(), g.zero());
    assert!(matches!(
        normal_form(&g, quotient, &Budget::PROOF),
        Err(NormalFormError::Undefined)
    ));
    for text in [
        "1/((x + 1)^2 - x^2 - 2 x - 1)",
        "x/(sin(x)^2 + cos(x)^2 - 1)",
        "1/(sqrt(x) sqrt(y) - sqrt(x y))",
    ] {
        assert_eq!(is_zero(text), Err(NormalFormError::Undefined), "{text}");
    }
}

#[test]
fn positive_symbols_leave_roots() {
    let g = Graph::new();
    let m = g.symbol("m", 0);
    let difference = read(&g, "sqrt(m^2 x) - m sqrt(x)");
    let options = |positive| Options {
        positive,
        ..Options::proof(Budget::PROOF)
    };
    let zero = |positive| {
        normal_forms(&g, &[difference], &options(positive))
            .unwrap()
            .1[0]
            .is_zero()
    };
    assert!(zero(vec![m]));
    assert!(!zero(vec![]));
}

#[test]
fn repeated_squaring_stops_at_the_budget() {
    let g = Graph::new();
    let mut e = g.add(&[g.symbol("x", 0), g.one()]);
    for _ in 0..200 {
        e = g.add(&[g.powi(e, 2), g.one()]);
    }
    let difference = g.sub(
        g.powi(e, 2),
        g.add(&[g.mul(&[e, e]), g.number(ratio(1, 1000).unwrap())]),
    );
    assert!(normal_form(&g, difference, &Budget::PROOF).is_ok_and(|form| !form.is_zero()));
    assert!(matches!(
        normal_form(&g, e, &Budget::PROOF),
        Err(NormalFormError::TooLarge(_))
    ));
}

#[test]
fn solves_are_worked_out() {
    let g = Graph::new();
    let [a, b, c, d, u, v] = ["a", "b", "c", "d", "u", "v"].map(|n| g.symbol(n, 0));
    let x = g.solve(&[a, b, c, d], &[u, v]).unwrap();
    let first = g.sub(g.add(&[g.mul(&[a, x[0]]), g.mul(&[b, x[1]])]), u);
    assert!(normal_form(&g, first, &Budget::PROOF).unwrap().is_zero());
    let cramer = g.div(read(&g, "d u - b v"), read(&g, "a d - b c"));
    assert!(normal_form(&g, g.sub(x[0], cramer), &Budget::PROOF)
        .unwrap()
        .is_zero());
    let singular = g
        .solve(
            &[
                a,
                b,
                g.scale(&ratio(2, 1).unwrap(), a),
                g.scale(&ratio(2, 1).unwrap(), b),
            ],
            &[u, v],
        )
        .unwrap();
    assert!(matches!(
        normal_form(&g, singular[0], &Budget::PROOF),
        Err(NormalFormError::Undefined)
    ));
}

#[test]
fn back_conversion_keeps_the_value() {
    let g = Graph::new();
    for text in [
        "sin(x + y)^2/(1 + x)",
        "sqrt(x + 1)^3 exp(2 x)/(cosh(y) + 1)",
        "x^(3/2) + tan(x)/2",
        "m (x' cos(phi) + y' sin(phi))/(J + m a^2)",
    ] {
        let e = read(&g, text);
        let back = normal_form(&g, e, &Budget::PROOF).unwrap().to_expr();
        let value = |e| {
            g.evaluate_f64(&[e], &|s| {
                Some(
                    0.3 + 0.1 * g.symbol_name(s).len() as f64 + 0.07 * f64::from(g.symbol_order(s)),
                )
            })
            .unwrap()[0]
        };
        assert!((value(e) - value(back)).abs() < 1e-12, "{text}");
    }
}

/// Numbering of generators, and with it every printed form, must not depend on how the graph came about.
#[test]
fn forms_do_not_depend_on_history() {
    let text = "atan(y) sin(b x + c)/(log(a) + sqrt(z))";
    let (g, h) = (Graph::new(), Graph::new());
    for earlier in ["sqrt(z)", "log(a)", "sin(c + b x)", "z + y"] {
        read(&h, earlier);
    }
    let form = |g: &Graph| {
        format!(
            "{:?}",
            normal_form(g, read(g, text), &Budget::PROOF)
                .unwrap()
                .value()
        )
    };
    assert_eq!(form(&g), form(&h));
    assert_eq!(g.apply(Function::Log, &[g.one()]), g.zero());
}
