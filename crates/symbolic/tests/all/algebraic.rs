//! Algebraic numbers as expressions: exact by their polynomials, with signs by enclosures.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_symbolic::number::algebraic::zero_between;
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::polynomial::normal_form::normal_form;
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::separation::vanishes;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Verdict};

/// The only real zero of x⁵ − x − 1, 1.16730397826141868425604589985… (OEIS A160155).
fn zero_of_quintic(g: &Graph, low: (i64, i64), high: (i64, i64)) -> Expr {
    let polynomial = [-1, -1, 0, 0, 0, 1].map(Into::into);
    let [low, high] = [low, high].map(|(n, d)| ratio(n, d).unwrap());
    let (number, divisor) = zero_between(&polynomial, &low, &high).unwrap();
    assert_eq!(divisor, 1.into());
    g.algebraic(number)
}

fn closed(g: &Graph, e: Expr) -> Expr {
    normal_form(g, e, &Budget::PROOF).unwrap().to_expr()
}

#[test]
fn a_number_is_one_however_it_was_enclosed() {
    let g = Graph::new();
    let own = zero_of_quintic(&g, (1, 1), (2, 1));
    assert_eq!(own, zero_of_quintic(&g, (-7, 1), (11, 3)));
    assert!(g.holds_algebraic(g.sqrt(own)) && !g.holds_algebraic(g.pi()));
    assert!(g.symbols_in(&[own]).is_empty());
}

/// Powers are reduced by the polynomial, so that α⁵ − α − 1 = 0, 1/α = α⁴ − 1, and α¹⁰ = (α + 1)².
#[test]
fn calculation_is_exact() {
    let g = Graph::new();
    let own = zero_of_quintic(&g, (1, 1), (2, 1));
    let one = g.one();
    let vanishing = [
        g.sub(g.powi(own, 5), g.add(&[own, one])),
        g.sub(g.div(one, own), g.sub(g.powi(own, 4), one)),
        g.sub(g.powi(own, 10), g.powi(g.add(&[own, one]), 2)),
        // |α − 2| = 2 − α, √((α − 1)²) = α − 1.
        g.add(&[g.abs(g.sub(own, g.integer(2))), own, g.integer(-2)]),
        g.sub(g.sqrt(g.powi(g.sub(own, one), 2)), g.sub(own, one)),
    ];
    for e in vanishing {
        assert!(g.is_zero(closed(&g, e)), "{}", g.text(e));
    }
    let other = g.sub(g.powi(own, 4), g.add(&[own, one]));
    assert!(!g.is_zero(closed(&g, other)));
}

#[test]
fn values_have_all_digits_where_terms_cancel() {
    let g = Graph::new();
    let own = zero_of_quintic(&g, (1, 1), (2, 1));
    let small = g.number(ratio(1, 1_000_000_000_000_000_000).unwrap());
    let sum = g.add(&[
        g.powi(own, 5),
        g.scale(&(-1).into(), own),
        g.integer(-1),
        small,
    ]);
    assert_eq!(g.evaluate_f64(&[sum], &|_| None).unwrap(), [1e-18]);
    let precision = Precision::new(300);
    let ball = g.enclose(&[own], &precision, &|_| None).unwrap();
    let expected = [
        "1.16730397826141868425604589985",
        "1.16730397826141868425604589986",
    ];
    assert_eq!(
        <[String; 2]>::from(ball[0].to_decimal_interval(30)),
        expected
    );
}

#[test]
fn numbers_are_written_by_their_polynomials() {
    let g = Graph::new();
    let own = zero_of_quintic(&g, (1, 1), (2, 1));
    let twice = g.mul(&[g.integer(2), own]);
    assert_eq!(g.text(twice), "2 root(x^5 - x - 1, 1.1673039782614187)");
    assert_eq!(
        g.latex(own),
        "\\operatorname{root}(x^5 - x - 1, 1.1673039782614187)"
    );
    assert_eq!(
        g.sympy(own),
        "sp.CRootOf(sp.Poly([1, 0, 0, 0, -1, -1], sp.Dummy('x')), 0)"
    );
}

/// Each of these is zero by squaring, and no normal form shows it: √2 + √3 = √(5 + 2√6); Ramanujan's ∛(∛2 − 1) = ∛(1/9) − ∛(2/9) + ∛(4/9);
/// cos(π/7) cos(2π/7) cos(3π/7) = 1/8; and the zero of x⁵ − x − 1 is the fifth root of itself and one.
#[test]
fn numbers_that_are_zero_by_no_form_are_zero_by_their_separation() {
    let g = Graph::new();
    let number = |n: i64, d: i64| g.number(ratio(n, d).unwrap());
    let root = |e: Expr, k: i64| g.pow(e, number(1, k));
    let cosine = |n: i64| g.cos(g.mul(&[number(n, 7), g.pi()]));
    let own = zero_of_quintic(&g, (1, 1), (2, 1));
    let six = g.add(&[g.integer(5), g.scale(&2.into(), g.sqrt(g.integer(6)))]);
    let ramanujan = root(g.sub(root(g.integer(2), 3), g.one()), 3);
    let zeros = [
        g.add(&[
            g.sqrt(g.integer(2)),
            g.sqrt(g.integer(3)),
            g.neg(g.sqrt(six)),
        ]),
        g.sub(
            ramanujan,
            g.add(&[
                root(number(1, 9), 3),
                g.neg(root(number(2, 9), 3)),
                root(number(4, 9), 3),
            ]),
        ),
        g.sub(g.mul(&[cosine(1), cosine(2), cosine(3)]), number(1, 8)),
        g.sub(root(g.add(&[own, g.one()]), 5), own),
    ];
    let tiny = g.number(ratio(1, 10).unwrap().pow(200));
    for zero in zeros {
        assert_eq!(vanishes(&g, zero), Some(true), "{}", g.text(zero));
        // What lies beside it by 1e-200 is none.
        assert_eq!(vanishes(&g, g.add(&[zero, tiny])), Some(false));
        let residuals = [zero];
        let assumptions = Assumptions::default();
        let verdict = decide_zero(&g, &ZeroTest::everywhere(&residuals, &assumptions));
        assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
    }
}

/// √(n + 1) + √(n − 1) − 2 √n is about −n^(−3/2)/4, far below what doubles tell apart. A number that contains x, e or π is
/// no algebraic one.
#[test]
fn small_numbers_are_no_zeros_and_others_are_not_decided() {
    let g = Graph::new();
    let n = g.powi(g.integer(10), 40);
    let shifted = |by: i64| g.sqrt(g.add(&[n, g.integer(by)]));
    let small = g.add(&[shifted(1), shifted(-1), g.scale(&(-2).into(), shifted(0))]);
    assert_eq!(vanishes(&g, small), Some(false));
    for open in [g.symbol("x", 0), g.exp(g.one()), g.pi()] {
        assert_eq!(vanishes(&g, open), None);
        assert_eq!(vanishes(&g, g.sub(open, g.sqrt(g.integer(2)))), None);
    }
}
