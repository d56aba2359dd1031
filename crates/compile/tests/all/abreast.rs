//! Series of four motions side by side: each has the bits that it has alone, whatever the others do.
#![allow(clippy::unwrap_used)] // A failure here is a failed test.

use chetaev_compile::{EvaluateFailure, Lowering, Program, Taylor, ABREAST};
use chetaev_symbolic::{Function, Graph, Symbol};

const ORDER: usize = 24;

/// x' = v, y' = w with forces of every kind of recurrence, and accelerations from a linear system with parameters a and b.
fn program() -> Program {
    let g = Graph::new();
    let symbols = ["t", "x", "y", "v", "w", "a", "b"].map(|name| g.intern_symbol(name, 0));
    let [t, x, y, v, w, a, b] = symbols.map(|symbol| g.symbol_expr(symbol));
    let one = g.one();
    let spread = g.sqrt(g.add(&[one, g.powi(y, 2)]));
    let mass = [
        g.add(&[a, g.powi(g.cos(x), 2)]),
        g.sin(g.sub(x, y)),
        g.sin(g.sub(x, y)),
        g.add(&[b, g.exp(g.neg(g.powi(x, 2)))]),
    ];
    let force = [
        g.add(&[
            g.neg(g.mul(&[v, w])),
            g.div(a, x),
            g.apply(Function::Log, &[spread]),
        ]),
        g.add(&[g.sin(t), g.mul(&[b, spread]), g.neg(y)]),
    ];
    let mut rates = vec![v, w];
    rates.extend(g.solve(&mass, &force).unwrap());
    let (variables, parameters): (&[Symbol], &[Symbol]) = (&symbols[..5], &symbols[5..]);
    let lowering = Lowering::new(&g)
        .variables(variables)
        .parameters(parameters);
    lowering.output("rates", &rates).lower().unwrap()
}

/// Parameters and (t, x, y, v, w).
type Motion = ([f64; 2], [f64; 5]);

const MOTIONS: [Motion; 5] = [
    ([2.0, 3.0], [0.0, 0.4, -0.3, 1.0, 0.2]),
    ([2.5, 3.5], [1.0, -1.4, 0.7, -0.2, 5.0]),
    ([4.0, 1.9], [-2.0, 900.0, 2.0, 0.0, 0.0]),
    ([2.0, 3.0], [0.3, 1e-3, 12.0, 3.0, -1.0]),
    ([7.0, 2.0], [0.0, 2.0, 0.0, -40.0, 0.5]),
];

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

fn alone(taylor: &Taylor, (parameters, state): Motion) -> Vec<u64> {
    let mut workspace = taylor.workspace(ORDER);
    taylor.prepare(&parameters, &mut workspace).unwrap();
    let mut found = vec![0.0; 4 * (ORDER + 1)];
    taylor
        .expand(&state, ORDER, &mut workspace, &mut found)
        .unwrap();
    bits(&found[4..])
}

/// Places without a motion are `None`.
fn side_by_side(
    taylor: &Taylor,
    motions: [Option<Motion>; ABREAST],
) -> Vec<Option<Result<Vec<u64>, EvaluateFailure>>> {
    let mut abreast = taylor.abreast().unwrap();
    for (lane, motion) in motions.iter().enumerate() {
        let parameters = motion.map_or([1.0, 1.0], |motion| motion.0);
        taylor
            .prepare_abreast(lane, &parameters, &mut abreast)
            .unwrap();
    }
    let states = motions.map(|motion| motion.map(|motion| motion.1));
    let states = [0, 1, 2, 3].map(|lane| states[lane].as_ref().map(|state| &state[..]));
    let outcome = taylor.expand_abreast(states, ORDER, &mut abreast).unwrap();
    let series = |lane: usize| {
        let mut found = vec![0.0; 4 * (ORDER + 1)];
        let read = taylor.coefficients(lane, ORDER, &abreast, &mut found);
        read.unwrap();
        bits(&found[4..])
    };
    (0..ABREAST)
        .map(|lane| motions[lane].map(|_| outcome[lane].map(|()| series(lane))))
        .collect()
}

/// Increments and slopes at h, by Horner's scheme, from coefficients of four variables of orders 1 and higher.
fn ends(coefficients: &[u64], h: f64) -> Vec<u64> {
    let value = |j: usize, k: usize| f64::from_bits(coefficients[4 * (j - 1) + k]);
    let end = |k: usize| {
        let (mut sum, mut slope) = (0.0, 0.0);
        for j in (1..=ORDER).rev() {
            (sum, slope) = (value(j, k) + h * sum, sum + h * slope);
        }
        [h * sum, sum + h * slope]
    };
    let both = [0, 1, 2, 3].map(end);
    bits(&[both.map(|end| end[0]), both.map(|end| end[1])].concat())
}

/// What a step needs is that of the coefficients of each motion, and rates are those of order 1 of a motion alone, also when
/// they are asked for again, with other parameters or another motion beside.
#[test]
fn ends_of_steps_and_rates_have_the_bits_of_each() {
    let Some(taylor) = taylor() else { return };
    let mut abreast = taylor.abreast().unwrap();
    let steps = [0.1, -0.02, 1e-5, 0.0];
    for round in 0..3 {
        // Another parameter at the same states, and then another state.
        let motions = [0, 1, 2, 3].map(|lane| {
            let (mut parameters, state) = MOTIONS[lane + usize::from(lane + round == 5)];
            parameters[0] += if round > 0 { 0.25 } else { 0.0 };
            (parameters, state)
        });
        for (lane, motion) in motions.iter().enumerate() {
            let prepared = taylor.prepare_abreast(lane, &motion.0, &mut abreast);
            prepared.unwrap();
        }
        let states = [0, 1, 2, 3].map(|lane| Some(&motions[lane].1[..]));
        let rates = taylor.rates_abreast(states, &mut abreast).unwrap();
        assert_eq!(rates, [Ok(()); ABREAST]);
        let made = taylor.expand_abreast(states, ORDER, &mut abreast);
        assert_eq!(made, Ok([Ok(()); ABREAST]));
        taylor.sum_abreast(ORDER, steps, &mut abreast).unwrap();
        assert_eq!(taylor.are_finite(ORDER, &abreast), [true; ABREAST]);
        for lane in 0..ABREAST {
            let coefficients = alone(&taylor, motions[lane]);
            let (mut rates, mut found) = ([0.0; 4], [0.0; 8]);
            taylor.rates(lane, &abreast, &mut rates);
            assert_eq!(bits(&rates), coefficients[..4], "{lane}");
            let (sums, slopes) = found.split_at_mut(4);
            taylor.ends(lane, &abreast, (sums, slopes));
            assert_eq!(bits(&found), ends(&coefficients, steps[lane]), "{lane}");
            for j in [1, ORDER] {
                let place = (lane, j);
                let read = taylor.coefficients_of_order(place, &abreast, &mut rates);
                assert_eq!(read, Ok(()));
                assert_eq!(bits(&rates), coefficients[4 * (j - 1)..4 * j]);
            }
        }
    }
    let missing = taylor.coefficients_of_order((0, 0), &abreast, &mut [0.0; 4]);
    assert_eq!(missing, Err(EvaluateFailure::NotPrepared));
}

/// A doubt about a motion is cleared up although another one was at the same state before, whose doubt nobody asked about.
#[test]
fn a_place_that_was_empty_is_not_taken_for_known() {
    let Some(taylor) = taylor() else { return };
    let mut abreast = taylor.abreast().unwrap();
    let pole = ([2.0, 3.0], [0.0, 0.0, 1.0, 1.0, 1.0]);
    for lane in 0..ABREAST {
        taylor.prepare_abreast(lane, &pole.0, &mut abreast).unwrap();
    }
    let state = Some(&pole.1[..]);
    let mut outcome = |motions| taylor.rates_abreast(motions, &mut abreast).unwrap();
    assert!(outcome([state, None, None, None])[0].is_err());
    assert!(outcome([state; ABREAST]).iter().all(Result::is_err));
}

fn taylor() -> Option<Taylor> {
    let taylor = Taylor::new(&program()).unwrap();
    taylor.abreast().map(|_| taylor)
}

#[test]
fn each_has_the_bits_that_it_has_alone() {
    let Some(taylor) = taylor() else { return };
    for shift in 0..MOTIONS.len() {
        let motions = [0, 1, 2, 3].map(|lane| Some(MOTIONS[(lane + shift) % MOTIONS.len()]));
        let found = side_by_side(&taylor, motions);
        for (motion, found) in motions.iter().flatten().zip(found) {
            assert_eq!(
                found.unwrap().unwrap(),
                alone(&taylor, *motion),
                "{motion:?}"
            );
        }
    }
}

#[test]
fn places_may_be_empty() {
    let Some(taylor) = taylor() else { return };
    for lane in 0..ABREAST {
        let mut motions = [None; ABREAST];
        motions[lane] = Some(MOTIONS[1]);
        let found = side_by_side(&taylor, motions);
        assert_eq!(found[lane], Some(Ok(alone(&taylor, MOTIONS[1]))));
    }
    assert_eq!(side_by_side(&taylor, [None; ABREAST]), vec![None; ABREAST]);
}

/// At x = 0 the force has no series; with a = −cos² x, b = −exp(−x²) and x = y the matrix is zero.
#[test]
fn one_without_a_series_leaves_the_others_alone() {
    let Some(taylor) = taylor() else { return };
    let pole = ([2.0, 3.0], [0.0, 0.0, 1.0, 1.0, 1.0]);
    let singular = (
        [-0.5f64.cos().powi(2), -(-0.25f64).exp()],
        [0.0, 0.5, 0.5, 0.0, 1.0],
    );
    for lane in 0..ABREAST {
        for (bad, is_pole) in [(pole, true), (singular, false)] {
            let mut motions = [0, 1, 2, 3].map(|lane| Some(MOTIONS[lane]));
            motions[lane] = Some(bad);
            for (other, found) in side_by_side(&taylor, motions).into_iter().enumerate() {
                let found = found.unwrap();
                match other == lane {
                    true if is_pole => {
                        let is_named = matches!(found, Err(EvaluateFailure::NotAnalytic { .. }));
                        assert!(is_named, "{found:?}");
                    }
                    true => {
                        let is_named = matches!(found, Err(EvaluateFailure::Singular { .. }));
                        assert!(is_named, "{found:?}");
                    }
                    false => assert_eq!(found, Ok(alone(&taylor, MOTIONS[other]))),
                }
            }
        }
    }
}
