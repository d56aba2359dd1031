//! Every trap of T6 §6.7.

use super::super::assumptions::{Assumptions, Relation};
use super::super::Options;
use super::*;
use crate::rational;
use crate::Rational;
use dashu_int::IBig;

#[test]
fn x_to_the_p_minus_x_for_a_small_prime() {
    let g = Graph::new();
    for p in [2, 3, 5, 7, 101, 65_537] {
        refuted(&g, &format!("x^{p} - x"));
    }
}

#[test]
fn a_machine_prime_times_x() {
    let g = Graph::new();
    for p in [2_147_483_647_i64, (1 << 61) - 1, 4_611_686_018_427_387_847] {
        let x = g.symbol("x", 0);
        let e = g.scale(&rational::integer(p), x);
        assert!(matches!(decide(&g, e), Verdict::Refuted(_)));
        let e = g.add(&[g.mul(&[e, x]), g.neg(e)]);
        assert!(matches!(decide(&g, e), Verdict::Refuted(_)));
    }
}

#[test]
fn root_of_a_square_is_no_identity_without_a_sign() {
    let g = Graph::new();
    let e = parse(&g, "sqrt(x^2) - x");
    let Verdict::Refuted(counterexample) = decide(&g, e) else {
        panic!()
    };
    assert!(rational::is_negative(
        counterexample.point[0].exact.as_ref().unwrap()
    ));
    let mut positive = Assumptions::new();
    positive.positive(&g, g.symbol("x", 0));
    assert_eq!(decide_under(&g, e, &positive).word(), "proved");
    let mut negative = Assumptions::new();
    negative.assume(g.symbol("x", 0), Relation::LessOrEqual, g.zero());
    assert_eq!(decide_under(&g, e, &negative).word(), "refuted");
    assert_eq!(
        decide_under(&g, parse(&g, "sqrt(x^2) + x"), &negative).word(),
        "proved"
    );
    proved(&g, "sqrt(x^2) - abs(x)");
    proved(&g, "sqrt(x^2)^2 - x^2");
    proved(&g, "sqrt(x^2 * y^4) - abs(x) * y^2");
}

/// 1/(1 + x) and x/(1 + x) have the sum 1: exponentials and angles of them are related.
#[test]
fn arguments_related_by_rational_functions() {
    let g = Graph::new();
    proved(&g, "exp(y/(1 + x)) * exp(x*y/(1 + x)) - exp(y)");
    proved(&g, "exp(1/(1 + x)) * exp(x/(1 + x)) - exp(1)");
    proved(&g, "cos(y/(1 + x) + x*y/(1 + x)) - cos(y)");
    proved(
        &g,
        "cosh(x - 2*y/(1 + 5*sin(x))) - cosh(x - 2*y + 10*y*sin(x)/(1 + 5*sin(x)))",
    );
    refuted(&g, "exp(y/(1 + x)) * exp(x*y/(1 + x)) - exp(2*y)");
    refuted(&g, "exp(y/(1 + x)) - exp(x*y/(1 + x))");
}

/// Numerators are compared modulo sin² + cos² = 1 after they are brought to one denominator, and an argument of many terms is one
/// unknown of the relations; by the modular proof alone, as in a large question.
#[test]
fn arguments_related_by_angles_and_of_many_terms() {
    let g = Graph::new();
    let d = "((16*sin(x + z) - 3)^2 + 36*(3 + sin(z))^2)";
    let squares = |shift: u32| {
        format!("y*sin(z)*(16*sin(x + z) - 3)^2/((3 + sin(z))*{d}) + 3*y*(16*sin(x + z) - 3)^2/((3 + sin(z))*{d}) + 36*y*({shift} + sin(z))^2/{d}")
    };
    let many = |last: u32| {
        format!("(x^2 + y + sin(z))^3*(y + z + 2)^2/(1 + x*cos(z)) + {last}*x*cos(z)*(x^2 + y + sin(z))^3*(y + z + 2)^2/(1 + x*cos(z)) - (x^2 + y + sin(z))^3*(y + z + 2)^2")
    };
    let word = |text: &str| {
        let assumptions = Assumptions::new();
        let residuals = [parse(&g, text)];
        let test = ZeroTest {
            options: Options {
                exact: false,
                ..Options::default()
            },
            ..ZeroTest::everywhere(&residuals, &assumptions)
        };
        decide_zero(&g, &test).word()
    };
    for (argument, sum) in [(squares(3), "y"), (many(1), "0")] {
        assert_eq!(word(&format!("cosh({argument}) - cosh({sum})")), "proved");
    }
    for (argument, sum) in [(squares(2), "y"), (many(2), "0")] {
        assert_eq!(word(&format!("cosh({argument}) - cosh({sum})")), "refuted");
    }
}

#[test]
fn products_of_roots() {
    let g = Graph::new();
    proved(&g, "sqrt(x) * sqrt(y) - sqrt(x*y)");
    proved(&g, "sqrt(x) * sqrt(x*y) - x * sqrt(y)");
    proved(&g, "sqrt(2) * sqrt(3) - sqrt(6)");
    proved(&g, "sqrt(x^(-3)) * sqrt(x^3) - 1");
    proved(&g, "sqrt(4*x^2 + 4*y^2) - 2*sqrt(x^2 + y^2)");
    proved(&g, "x^(1/3) * y^(1/3) - (x*y)^(1/3)");
    proved(&g, "x^(1/6) * x^(1/3) - sqrt(x)");
    refuted(&g, "sqrt(x) + sqrt(y) - sqrt(x + y)");
    refuted(&g, "sqrt(x) * sqrt(y) - sqrt(2*x*y)");
}

#[test]
fn logarithm_of_a_square() {
    let g = Graph::new();
    // Both sides are defined for x > 0 only, and the verdict says so.
    let Verdict::Proved(proof) = decide(&g, parse(&g, "log(x^2) - 2*log(x)")) else {
        panic!()
    };
    assert!(proof.on.contains("x > 0"), "{}", proof.on);
    refuted(&g, "log(x^2) - log(x)");
    refuted(&g, "log(x + y) - log(x) - log(y)");
    proved(&g, "log(6) - log(2) - log(3)");
}

#[test]
fn double_and_half_angles() {
    let g = Graph::new();
    proved(&g, "sin(2*theta) - 2*sin(theta)*cos(theta)");
    proved(&g, "sin(theta/2)^2 - (1 - cos(theta))/2");
    proved(&g, "sin(theta)^2 + cos(theta)^2 - 1");
    proved(&g, "tan(theta/2) - sin(theta)/(1 + cos(theta))");
    proved(&g, "cos(theta/3)^3 - 3/4*cos(theta/3) - cos(theta)/4");
    proved(&g, "sin(a*(b + 1)) - sin(a*b)*cos(a) - cos(a*b)*sin(a)");
    refuted(&g, "sin(2*theta) - 2*sin(theta)");
    refuted(&g, "sin(theta)^2 + cos(theta)^2 - 2");
}

#[test]
fn sum_of_arc_tangents_is_constant_on_one_side_only() {
    let g = Graph::new();
    let e = parse(&g, "atan(x) + atan(1/x) - pi/2");
    let Verdict::Refuted(counterexample) = decide(&g, e) else {
        panic!()
    };
    assert!(rational::is_negative(
        counterexample.point[0].exact.as_ref().unwrap()
    ));
    // For x > 0 it is true; nothing here can prove it, so it must not be called proved, nor refuted.
    let mut positive = Assumptions::new();
    positive.positive(&g, g.symbol("x", 0));
    assert_eq!(decide_under(&g, e, &positive).word(), "numerical");
}

#[test]
fn a_quotient_with_removable_poles() {
    let g = Graph::new();
    proved(&g, "(x - 1)*(x + 1)/(x^2 - 1) - 1");
    refuted(&g, "(x - 1)*(x + 1)/(x^2 + 1) - 1");
}

#[test]
fn exponentials() {
    let g = Graph::new();
    proved(&g, "exp(x + y) - exp(x)*exp(y)");
    proved(&g, "cosh(x)^2 - sinh(x)^2 - 1");
    proved(&g, "exp(x/2)^2 - exp(x)");
    proved(&g, "sinh(2*x) - 2*sinh(x)*cosh(x)");
    proved(&g, "x^(a + 1) - x^a * x");
    proved(&g, "exp(a*log(x)) - x^a");
    refuted(&g, "exp(x + y) - exp(x) - exp(y)");
    refuted(&g, "exp(x*y) - exp(x)*exp(y)");
}

/// Zero for |x| <= 1, which no generator knows: bits beyond those of the large factor would be asked for without end.
#[test]
fn large_exponentials_do_not_ask_for_as_many_bits() {
    let g = Graph::new();
    let begun = std::time::Instant::now();
    let e = parse(&g, "exp(a*q)*(asin(sin(x)/2) + acos(sin(x)/2) - pi/2)");
    assert!(!matches!(decide(&g, e), Verdict::Refuted(_)));
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
}

/// x squared 200 times.
fn tower(g: &Graph, x: Expr) -> Expr {
    (0..200).fold(x, |e, _| g.powi(g.add(&[e, g.one()]), 2))
}

/// The same, each square written as e² + 2e + 1.
fn tower_expanded(g: &Graph, x: Expr) -> Expr {
    (0..200).fold(x, |e, _| {
        g.add(&[g.powi(e, 2), g.scale(&rational::integer(2), e), g.one()])
    })
}

#[test]
fn repeated_squaring_of_depth_two_hundred() {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let power = |n: usize| Rational::from_parts(IBig::ONE, IBig::from(10).pow(n).into_parts().1);
    // The two are equal, but degree 2^200 allows no bound: anything but a refutation, and no proof without a bound.
    let difference = g.sub(tower(&g, x), tower_expanded(&g, x));
    let verdict = decide(&g, difference);
    assert!(!matches!(verdict, Verdict::Refuted(_)), "{verdict:?}");
    if let Verdict::Proved(proof) = verdict {
        assert!(proof.error_bound_log2.unwrap() <= -100.0);
    }
    for digits in [3, 30] {
        let off = g.add(&[difference, g.number(power(digits))]);
        let verdict = decide(&g, off);
        assert!(
            !matches!(verdict, Verdict::Proved(_) | Verdict::Numerical(_)),
            "{verdict:?}"
        );
    }
    // Without the sums the value at 1/2 is enclosed near zero, and the tiny rational is seen.
    let plain = (0..200).fold(x, |e, _| g.mul(&[g.powi(e, 2), g.symbol("y", 0)]));
    let other = (0..200).fold(x, |e, _| {
        g.div(g.mul(&[e, e]), g.powi(g.symbol("y", 0), -1))
    });
    for digits in [3, 30] {
        let off = g.add(&[g.sub(plain, other), g.number(power(digits))]);
        assert!(matches!(decide(&g, off), Verdict::Refuted(_)));
    }
}

#[test]
fn a_tiny_rational_is_not_zero() {
    let g = Graph::new();
    let tiny = g.number(Rational::from_parts(
        IBig::ONE,
        IBig::from(10).pow(30).into_parts().1,
    ));
    let zero = parse(&g, "(x + 1)^2 - x^2 - 2*x - 1");
    proved(&g, "(x + 1)^2 - x^2 - 2*x - 1");
    assert!(matches!(
        decide(&g, g.add(&[zero, tiny])),
        Verdict::Refuted(_)
    ));
}

#[test]
fn zero_over_zero_and_vanishing_denominators() {
    let g = Graph::new();
    let zero = g.zero();
    for e in [
        g.div(zero, zero),
        parse(&g, "x / (sin(x)^2 + cos(x)^2 - 1)"),
        parse(
            &g,
            "(y + (x + 1)^2 - x^2 - 2*x - 1) / ((x + 1)^2 - x^2 - 2*x - 1) - 1",
        ),
    ] {
        let Verdict::Undecided { tried } = decide(&g, e) else {
            panic!("{:?}", decide(&g, e))
        };
        assert!(tried.contains("nowhere defined"), "{tried}");
    }
    let singular = g
        .solve(
            &parse_all(&g, &["x", "y", "2*x", "2*y"]),
            &[g.one(), g.one()],
        )
        .unwrap();
    let Verdict::Undecided { tried } = decide(&g, singular[0]) else {
        panic!()
    };
    assert!(tried.contains("nowhere defined"), "{tried}");
}

fn parse_all(g: &Graph, texts: &[&str]) -> Vec<Expr> {
    texts.iter().map(|text| parse(g, text)).collect()
}

#[test]
fn multiples_of_pi_and_numerical_radicals() {
    let g = Graph::new();
    proved(&g, "cos(x + pi/3) - cos(x)/2 + sqrt(3)/2*sin(x)");
    proved(&g, "cos(pi/5) - (1 + sqrt(5))/4");
    proved(&g, "cos(pi/7)*cos(2*pi/7)*cos(4*pi/7) + 1/8");
    proved(&g, "sin(x + pi/4) - sqrt(2)/2*(sin(x) + cos(x))");
    refuted(&g, "cos(pi/5) - (1 - sqrt(5))/4");
    refuted(&g, "sin(x + pi/4) + sqrt(2)/2*(sin(x) + cos(x))");
    proved(&g, "(sqrt(2) + sqrt(3))^2 - 5 - 2*sqrt(6)");
    proved(&g, "sqrt(x^2 + 2*x*y + y^2) - abs(x + y)");
}

#[test]
fn inverse_functions_inside_of_angles() {
    let g = Graph::new();
    proved(&g, "cos(atan(x)) - 1/sqrt(1 + x^2)");
    proved(&g, "sin(2*atan(x)) - 2*x/(1 + x^2)");
    proved(&g, "sin(acos(x)) - sqrt(1 - x^2)");
    proved(&g, "cos(atan2(y, x)/2)^2 - (1 + x/sqrt(x^2 + y^2))/2");
    proved(&g, "asin(x) + acos(x) - pi/2");
}

#[test]
fn a_root_of_a_square_on_its_other_side() {
    let g = Graph::new();
    refuted(&g, "sqrt(x^2 + 2*x + 1) - x - 1");
    refuted(&g, "y*x'*(sqrt(x^2 + 2*x + 1) - (x + 1))");
    refuted(&g, "(x + 1)/sqrt(x^2 + 2*x + 1) - 1");
    refuted(&g, "sqrt((x + 50)^2) - x - 50");
    refuted(
        &g,
        "sqrt((x^2 - 100)^2) - 100 + x^2 + abs(x^2 - 100) - abs(100 - x^2)",
    );
}

#[test]
fn the_sign_of_zero_is_excluded() {
    let g = Graph::new();
    let Verdict::Proved(proof) = decide(&g, parse(&g, "sign(x)^2 - 1")) else {
        panic!()
    };
    assert!(proof.on.contains("x != 0"), "{}", proof.on);
}

/// √(9 v·v) = 3 √(v·v) where the components of 3v are the solution of a linear system too large for normal forms: the roots are
/// multiples of each other, and the sign is that of positive numbers.
#[test]
fn roots_of_proportional_radicands_hidden_in_a_linear_system() {
    let graph = Graph::new();
    let size = 9;
    let symbol = |name: String| graph.symbol(&name, 0);
    let v: Vec<Expr> = (0..size).map(|i| symbol(format!("v{i}"))).collect();
    let matrix: Vec<Expr> = (0..size * size).map(|i| symbol(format!("a{i}"))).collect();
    let three = graph.integer(3);
    let right: Vec<Expr> = matrix
        .chunks(size)
        .map(|row| {
            let terms = row.iter().zip(&v);
            let terms: Vec<Expr> = terms.map(|(&a, &v)| graph.mul(&[three, a, v])).collect();
            graph.add(&terms)
        })
        .collect();
    let solved = graph.solve(&matrix, &right).unwrap();
    let length = |x: &[Expr]| {
        let squares: Vec<Expr> = x.iter().map(|&x| graph.powi(x, 2)).collect();
        graph.sqrt(graph.add(&squares))
    };
    let (long, short) = (length(&solved), length(&v));
    let equal = decide(&graph, graph.sub(long, graph.mul(&[three, short])));
    let Verdict::Proved(proof) = &equal else {
        panic!("{equal:?}")
    };
    assert!(proof.error_bound_log2.is_some_and(|bound| bound <= -100.0));
    for wrong in [graph.integer(-3), graph.integer(2)] {
        let verdict = decide(&graph, graph.sub(long, graph.mul(&[wrong, short])));
        assert!(!matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
    }
}
