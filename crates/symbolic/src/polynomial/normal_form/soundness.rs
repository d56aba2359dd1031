//! The form has the value of the expression wherever both are defined: random expressions with every kind of generator,
//! at points of all signs.

use super::*;
use crate::number::random::Random;
use crate::rational::ratio;
use crate::simplify::{self, simplify};
use crate::Function;

fn leaf(g: &Graph, random: &mut Random) -> Expr {
    match random.below(7) {
        0 => g.integer(random.between(-3, 3)),
        1 => g.scale(&ratio(random.between(-4, 4), 6).unwrap(), g.pi()),
        n => g.symbol(["x", "y", "z"][n as usize % 3], 0),
    }
}

fn expression(g: &Graph, random: &mut Random, depth: u32) -> Expr {
    use Function::*;
    if depth == 0 {
        return leaf(g, random);
    }
    let child = |random: &mut Random| expression(g, random, depth - 1);
    match random.below(12) {
        0..=2 => {
            let (a, b) = (child(random), child(random));
            g.add(&[a, b])
        }
        3 | 4 => {
            let (a, b) = (child(random), child(random));
            g.mul(&[a, b])
        }
        5 => {
            let (a, b) = (child(random), child(random));
            g.div(a, b)
        }
        6 | 7 => {
            let exponents = [
                (1, 2),
                (-1, 2),
                (3, 2),
                (1, 3),
                (2, 3),
                (1, 4),
                (2, 1),
                (-2, 1),
            ];
            let (p, q) = exponents[random.below(8) as usize];
            let a = child(random);
            g.pow(a, g.number(ratio(p, q).unwrap()))
        }
        8 | 9 => {
            let a = child(random);
            let function = [Sin, Cos, Tan, Sec, Csc, Cot][random.below(6) as usize];
            g.apply(function, &[a])
        }
        _ => {
            let a = child(random);
            let function = [Exp, Log, Abs, Sign, Atan, Sinh, Cosh, Tanh][random.below(8) as usize];
            g.apply(function, &[a])
        }
    }
}

fn value(g: &Graph, e: Expr, point: &[f64; 3]) -> f64 {
    let at = |s| match g.symbol_name(s) {
        "x" => Some(point[0]),
        "y" => Some(point[1]),
        _ => Some(point[2]),
    };
    g.evaluate_f64(&[e], &at).map_or(f64::NAN, |v| v[0])
}

#[test]
fn forms_keep_values() {
    let mut random = Random::new(2024);
    let budget = Budget {
        terms: 300,
        degree: 60,
        bits: 400,
        work: 100_000,
    };
    let (mut compared, mut converted) = (0, 0);
    for _ in 0..1500 {
        let g = Graph::new();
        let e = expression(&g, &mut random, 4);
        let small = simplify::Options {
            budget,
            ..simplify::Options::default()
        };
        let mut others = vec![simplify(&g, e, &small)];
        match normal_form(&g, e, &budget) {
            Ok(form) => others.push(form.to_expr()),
            Err(NormalFormError::TooLarge(_)) => {}
            Err(NormalFormError::Undefined) => others.push(g.powi(g.zero(), -1)),
        }
        converted += others.len() - 1;
        for _ in 0..6 {
            let point = [(); 3].map(|()| random.between(-300, 300) as f64 / 97.0);
            // Infinities and huge parts may cancel in floating point where nothing is defined.
            let defined = g
                .reachable(&[e])
                .iter()
                .all(|&part| value(&g, part, &point).abs() <= 1e6);
            let expected = value(&g, e, &point);
            if !defined {
                continue;
            }
            for &other in &others {
                let found = value(&g, other, &point);
                if found.is_nan() && other != others[0] {
                    continue; // expanded forms may split powers of negative numbers
                }
                compared += 1;
                let close = (found - expected).abs() <= 1e-6 * (1.0 + expected.abs());
                assert!(
                    close,
                    "{} = {expected} but {} = {found} at {point:?}",
                    g.text(e),
                    g.text(other)
                );
            }
        }
    }
    assert!(compared > 3000 && converted > 900, "{compared} {converted}");
}
