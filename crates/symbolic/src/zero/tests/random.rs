//! Random identities, random errors planted in them, replays, and graphs of a size that expansion would never manage.

use super::super::{Options, ZeroTest};
use super::*;
use crate::number::random::Random;
use crate::rational;

/// A random expression of elementary functions.
fn random_expression(g: &Graph, random: &mut Random, depth: u32) -> Expr {
    if depth == 0 {
        return match random.below(5) {
            0 => g.number(rational::ratio(random.between(-9, 9), random.between(1, 7)).unwrap()),
            1 => g.symbol("x", 0),
            2 => g.symbol("x", 1),
            3 => g.symbol("y", 0),
            _ => g.symbol("theta", 0),
        };
    }
    let mut part = || random_expression(g, random, depth - 1);
    let (a, b) = (part(), part());
    match random.below(9) {
        0..=2 => g.add(&[a, b]),
        3..=5 => g.mul(&[a, b]),
        6 => g.sin(a),
        7 => g.div(a, g.add(&[g.powi(b, 2), g.one()])),
        _ => g.sqrt(g.add(&[g.powi(a, 2), g.one()])),
    }
}

/// The expression written otherwise: sines by half angles, products distributed, quotients turned.
fn rewritten(g: &Graph, e: Expr, random: &mut Random) -> Expr {
    let half = rational::ratio(1, 2).unwrap();
    let choice = random.below(4);
    let other = g.symbol("z", 0);
    let shifted = g.add(&[e, other]);
    match choice {
        // (e + z)² − z² − 2 e z = e², halved against e once more
        0 => {
            let square = g.powi(shifted, 2);
            let rest = g.add(&[g.powi(other, 2), g.mul(&[g.integer(2), e, other])]);
            let e_squared = g.sub(square, rest);
            g.div(
                g.mul(&[e_squared, g.add(&[g.powi(e, 2), g.one()])]),
                g.add(&[g.powi(e, 3), e]),
            )
        }
        // e (sin² + cos²)
        1 => g.mul(&[
            e,
            g.add(&[g.powi(g.sin(other), 2), g.powi(g.cos(other), 2)]),
        ]),
        // sin e from half angles, over sin e / e
        2 => {
            let h = g.scale(&half, e);
            let double = g.mul(&[g.integer(2), g.sin(h), g.cos(h)]);
            g.mul(&[e, g.div(double, g.sin(e))])
        }
        // the solution of a linear system: z a + b = …
        _ => {
            let solution = g
                .solve(&[other, g.one(), g.one(), other], &[g.mul(&[e, other]), e])
                .unwrap();
            solution[0]
        }
    }
}

#[test]
fn random_identities_are_proved_and_planted_errors_refuted() {
    let g = Graph::new();
    let mut random = Random::new(2026);
    let (mut proved, mut refuted) = (0, 0);
    for round in 0..60 {
        let e = random_expression(&g, &mut random, 2 + round % 3);
        if g.as_number(e).is_some() {
            continue;
        }
        let other = rewritten(&g, e, &mut random);
        let verdict = decide(&g, g.sub(e, other));
        assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
        proved += 1;
        let error = match random.below(3) {
            0 => g.number(rational::ratio(1, 1_000_000_007).unwrap()),
            1 => g.mul(&[
                g.number(rational::ratio(1, 1000).unwrap()),
                g.symbol("x", 1),
            ]),
            _ => g.add(&[other, other]),
        };
        let verdict = decide(&g, g.add(&[e, g.neg(other), error]));
        if g.is_zero(error) {
            continue;
        }
        assert!(!matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
        refuted += u32::from(matches!(verdict, Verdict::Refuted(_)));
    }
    assert!(
        proved >= 50 && refuted >= 45,
        "{proved} proved, {refuted} refuted"
    );
}

#[test]
fn a_replay_uses_other_points_and_agrees() {
    let g = Graph::new();
    let e = parse(
        &g,
        "sin(2*theta)/(1 + cos(2*theta)) - tan(theta) + sqrt(x^2 + 1)^2 - x^2 - 1",
    );
    let assumptions = Assumptions::new();
    let first = Options {
        exact: false,
        ..Options::default()
    };
    let again = first.replay();
    assert_ne!(first.seed, again.seed);
    assert!(again.rotation.is_some());
    for options in [first, again, again.replay()] {
        let residuals = [e];
        let verdict = decide_zero(
            &g,
            &ZeroTest {
                options,
                ..ZeroTest::everywhere(&residuals, &assumptions)
            },
        );
        let Verdict::Proved(proof) = verdict else {
            panic!("{verdict:?}")
        };
        assert_eq!(proof.seed, Some(options.seed));
        let wrong = [g.add(&[e, g.symbol("x", 0)])];
        let verdict = decide_zero(
            &g,
            &ZeroTest {
                options,
                ..ZeroTest::everywhere(&wrong, &assumptions)
            },
        );
        assert_eq!(verdict.word(), "refuted");
    }
}

#[test]
fn the_same_question_has_the_same_answer() {
    let text = "(x + sin(theta))^3 - x^3 - sin(theta)^3 - 3*x*sin(theta)*(x + sin(theta)) + y/7";
    let answers: Vec<Verdict> = (0..2)
        .map(|_| {
            let g = Graph::new();
            decide(&g, parse(&g, text))
        })
        .collect();
    assert_eq!(answers[0], answers[1]);
    assert_eq!(answers[0].word(), "refuted");
}

/// A chain of rotations and products: q_{k+1} = q_k cos x_k + r_k sin x_k, r_{k+1} = r_k cos x_k − q_k sin x_k, so
/// that q² + r² is preserved. Expanded it would have 2^n terms.
fn rotations(g: &Graph, count: usize) -> (Expr, Expr) {
    let (mut q, mut r) = (g.symbol("q", 0), g.symbol("r", 0));
    for k in 0..count {
        let angle = g.symbol(&format!("x_{}", k % 40), 0);
        let (c, s) = (g.cos(angle), g.sin(angle));
        (q, r) = (
            g.add(&[g.mul(&[q, c]), g.mul(&[r, s])]),
            g.sub(g.mul(&[r, c]), g.mul(&[q, s])),
        );
    }
    (q, r)
}

#[test]
fn large_graphs_cost_a_few_evaluations() {
    let g = Graph::new();
    let (q, r) = rotations(&g, 20_000);
    let square = |e: Expr| g.powi(e, 2);
    let e = g.add(&[
        square(q),
        square(r),
        g.neg(square(g.symbol("q", 0))),
        g.neg(square(g.symbol("r", 0))),
    ]);
    assert!(g.reachable(&[e]).len() > 100_000);
    let Verdict::Proved(proof) = decide(&g, e) else {
        panic!()
    };
    assert!(proof.samples <= 8, "{} evaluations", proof.samples);
    let wrong = g.add(&[e, g.number(rational::ratio(1, 1000).unwrap())]);
    assert_eq!(decide(&g, wrong).word(), "refuted");
}

#[test]
fn a_linear_solve_of_order_sixty_is_one_node() {
    let g = Graph::new();
    let n = 60;
    let entry = |i: usize, j: usize| {
        let (a, b) = (
            g.symbol(&format!("a_{}", i.max(j)), 0),
            g.symbol(&format!("a_{}", i.min(j)), 0),
        );
        let coupling = g.cos(g.sub(a, b));
        if i == j {
            g.add(&[coupling, g.symbol(&format!("m_{i}"), 0)])
        } else {
            coupling
        }
    };
    let matrix: Vec<Expr> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
    let rhs: Vec<Expr> = (0..n)
        .map(|i| g.sin(g.symbol(&format!("a_{i}"), 0)))
        .collect();
    let x = g.solve(&matrix, &rhs).unwrap();
    // A x − b = 0, and for the symmetric A: bᵀ (A⁻¹ c) = cᵀ (A⁻¹ b).
    let c: Vec<Expr> = (0..n).map(|i| g.symbol(&format!("c_{i}"), 0)).collect();
    let y = g.solve(&matrix, &c).unwrap();
    let dot = |u: &[Expr], v: &[Expr]| {
        g.add(
            &u.iter()
                .zip(v)
                .map(|(a, b)| g.mul(&[*a, *b]))
                .collect::<Vec<_>>(),
        )
    };
    let row = g.sub(dot(&matrix[5 * n..6 * n], &x), rhs[5]);
    for e in [row, g.sub(dot(&rhs, &y), dot(&c, &x))] {
        let Verdict::Proved(proof) = decide(&g, e) else {
            panic!("{:?}", decide(&g, e))
        };
        assert!(
            proof.error_bound_log2.unwrap() <= -100.0 && proof.samples <= 12,
            "{proof:?}"
        );
    }
    let e = g.sub(dot(&rhs, &y), dot(&c, &y));
    assert_eq!(decide(&g, e).word(), "refuted");
}
