//! The motions of the gallery: machine code and interpreter agree on Taylor coefficients and on rates, and blocks of
//! states on those of each.
#![cfg(all(unix, target_arch = "x86_64"))]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev::compile::{
    BlockEvaluator, Evaluator, Interpreter, Lanes, Lowering, Native, Program, Taylor, Vectors,
    LANES,
};
use chetaev::mechanics::formulations::Routh;
use chetaev::mechanics::{Basis, Formulation, Prepared, System};
use chetaev::motion::{chart, Binding, NumericSystem};
use chetaev_tests::studied::{gallery_path, loaded, model_files};

/// The highest order compared.
const ORDER: usize = 24;
/// By how much more the back ends may differ than the interpreter differs from itself where every number of the state is
/// changed by its own rounding: a sum of many rounded products stands against one rounded number each. Measured: at most 2.1,
/// for the rattleback, whose coefficients are the least well conditioned.
const TIMES: f64 = 8.0;

/// The rates of (q, v) as a function of (t, q, v), the parameters, and a state without any symmetry.
struct Rates {
    program: Program,
    parameters: Vec<f64>,
    state: Vec<f64>,
}

/// The rates by Routh's equations; `None` for a model that is none.
fn rates(file: &str) -> Option<Rates> {
    let (model, _) = loaded(&gallery_path(file), &[]).into_result().ok()?;
    let system = System::from_model(&model).ok()?;
    let prepared = Prepared::new(&system).ok()?;
    let binding = Binding::new(&system).ok()?;
    let spread = |i: usize, least: f64| least + 0.37 * ((i + 1) as f64).sin().abs();
    let (program, state) = match prepared.terms.order {
        1 => {
            let mut numeric = NumericSystem::new(&system, &prepared.terms, &binding).ok()?;
            let q: Vec<f64> = (0..numeric.positions()).map(|i| spread(i, 0.4)).collect();
            // Slower where the speed has a limit.
            let velocities = |scale: f64| (0..numeric.n).map(move |i| scale * spread(i, 0.5));
            let mut speeds = [1.0, 0.2]
                .map(|scale| velocities(scale).collect::<Vec<_>>())
                .into_iter();
            let v = speeds.find(|v| numeric.evaluate(0.3, &q, v).is_ok())?;
            let chart = chart::choose(
                numeric.jacobian(),
                (numeric.r, numeric.n),
                &numeric.mass_diagonal(),
                chart::Floor::Along(1.0),
            );
            let program = numeric.rates_program(&chart.rows).unwrap();
            (program, [&[0.3][..], &q, &v].concat())
        }
        _ => {
            let program = rates_on_jets(&system, &prepared, &binding);
            let jets = (1..program.variables.len()).map(|i| spread(i, 0.5));
            let state = std::iter::once(0.3).chain(jets).collect();
            (program, state)
        }
    };
    let parameters: Vec<f64> = binding.parameters.iter().map(|own| own.1).collect();
    Some(Rates {
        program,
        parameters,
        state,
    })
}

/// The rates of coordinates, masses and what else is the state under constraints of order two and more.
fn rates_on_jets(system: &System, prepared: &Prepared, binding: &Binding) -> Program {
    let basis = Basis {
        system,
        terms: &prepared.terms,
        selection: &prepared.selection,
        characteristics: None,
    };
    let equations = Routh.equations(&basis).unwrap();
    let g = &system.graph;
    let mut variables = vec![g.intern_symbol("t", 0)];
    variables.extend(system.coordinate_symbols());
    variables.extend(system.masses.iter().map(|m| m.symbol));
    variables.extend(equations.variables.iter().map(|x| x.symbol));
    let mut rates = equations.velocities.clone();
    rates.extend(equations.masses.iter().map(|(_, rate)| *rate));
    rates.extend(equations.rates());
    let symbols: Vec<_> = binding.parameters.iter().map(|own| own.0).collect();
    let lowering = Lowering::new(g).variables(&variables).parameters(&symbols);
    let rates = g.substitute_all(&rates, &binding.controls);
    lowering.output("rates", &rates).lower().unwrap()
}

/// Coefficients of (q, v): by machine code, by the interpreter, and by the interpreter where every number of the state is
/// changed by its rounding, up or down.
fn expansions(file: &str) -> Option<[Vec<f64>; 3]> {
    let Rates {
        program,
        parameters,
        state,
    } = rates(file)?;
    let changed: Vec<f64> = state
        .iter()
        .zip([1.0, -1.0, -1.0].iter().cycle())
        .map(|(x, sign)| x * (1.0 + sign * f64::EPSILON))
        .collect();
    let expand = |taylor: &Taylor, state: &[f64]| {
        let mut workspace = taylor.workspace(ORDER);
        let mut coefficients = vec![0.0; (ORDER + 1) * (state.len() - 1)];
        taylor.prepare(&parameters, &mut workspace).unwrap();
        let outcome = taylor.expand(state, ORDER, &mut workspace, &mut coefficients);
        outcome.map(|()| coefficients)
    };
    let native = Taylor::new(&program).unwrap();
    native.code_size()?;
    let interpreter = Taylor::interpreter(&program).unwrap();
    let found = [
        expand(&native, &state),
        expand(&interpreter, &state),
        expand(&interpreter, &changed),
    ];
    match found {
        [Ok(native), Ok(interpreted), Ok(changed)] => Some([native, interpreted, changed]),
        [a, b, _] => {
            assert_eq!(a.is_err(), b.is_err(), "{file}: {a:?} {b:?}");
            None
        }
    }
}

/// The largest difference over all orders, each over the largest coefficient that a series of this radius can have there.
fn difference(other: &[f64], interpreted: &[f64]) -> f64 {
    let m = interpreted.len() / (ORDER + 1);
    let largest = |j: usize| {
        let row = &interpreted[j * m..(j + 1) * m];
        row.iter()
            .fold(1e-300, |largest: f64, c| largest.max(c.abs()))
    };
    // The growth of the coefficients from one order to the next.
    let growth = (1..=ORDER).map(|j| (largest(j) / largest(0).max(1.0)).powf(1.0 / j as f64));
    let growth = growth.fold(0.0, f64::max);
    let mut worst: f64 = 0.0;
    for j in 1..=ORDER {
        let scale = largest(0).max(1.0) * growth.powi(j as i32) * j as f64;
        for k in 0..m {
            let gap = (other[j * m + k] - interpreted[j * m + k]).abs();
            worst = worst.max(gap / scale);
        }
    }
    worst / f64::EPSILON
}

#[test]
fn back_ends_agree_on_the_series_of_every_model() {
    if !is_x86_feature_detected!("avx2") || !is_x86_feature_detected!("fma") {
        return;
    }
    let mut compared = 0;
    for file in model_files() {
        let Some([native, interpreted, changed]) = expansions(&file) else {
            continue;
        };
        compared += 1;
        let between = difference(&native, &interpreted);
        let by_rounding = difference(&changed, &interpreted).max(1.0);
        assert!(
            between <= TIMES * by_rounding,
            "{file}: {between} units in the last place, {by_rounding} by a rounding of the state"
        );
    }
    assert!(compared >= 20, "{compared} models compared");
}

/// The rates of one state; `None` where it has none.
fn alone(evaluator: &dyn Evaluator, rates: &Rates, state: &[f64]) -> Option<Vec<f64>> {
    let mut workspace = evaluator.workspace();
    evaluator
        .prepare(&rates.parameters, &mut workspace)
        .unwrap();
    let mut found = vec![0.0; evaluator.program().output_count()];
    let outcome = evaluator.evaluate(state, &mut workspace, &mut found);
    outcome.is_ok().then_some(found)
}

/// The rates of the states of a block.
fn together(
    evaluator: &dyn BlockEvaluator,
    rates: &Rates,
    states: &[Vec<f64>],
) -> Vec<Option<Vec<f64>>> {
    let splat = |&parameter: &f64| Lanes::splat(parameter);
    let parameters: Vec<Lanes> = rates.parameters.iter().map(splat).collect();
    let column = |i: usize| Lanes::from_fn(|l| states[l][i]);
    let variables: Vec<Lanes> = (0..rates.state.len()).map(column).collect();
    let mut workspace = evaluator.block_workspace();
    evaluator
        .prepare_block(&parameters, &mut workspace)
        .unwrap();
    let mut found = vec![Lanes::default(); rates.program.output_count()];
    let groups = rates.program.outputs.len();
    evaluator
        .evaluate_block(groups, &variables, &mut workspace, &mut found)
        .unwrap();
    let has_failed = |l: usize| workspace.failures().iter().any(|failure| failure.0 == l);
    let of = |l: usize| found.iter().map(|lanes| lanes.as_slice()[l]).collect();
    (0..LANES)
        .map(|l| (!has_failed(l)).then(|| of(l)))
        .collect()
}

/// States far enough apart for some angles to lie in other quadrants; their numbers are changed by the parts of `nudge` in turn.
fn states(rates: &Rates, nudge: &[f64]) -> Vec<Vec<f64>> {
    let own = |l: usize| 1.0 + 0.11 * l as f64;
    let moved = |l: usize, (x, part): (&f64, &f64)| x * own(l) * (1.0 + part);
    (0..LANES)
        .map(|l| {
            let pairs = rates.state.iter().zip(nudge.iter().cycle());
            pairs.map(|pair| moved(l, pair)).collect()
        })
        .collect()
}

/// By how many units in the last place rates may differ: of the largest rate, or of 1 if that is larger, and as much again for
/// every unit by which the interpreter's own rate moves where all numbers of the state move by one, up or down (by 45 units, over
/// 45, so that it is no rounding).
const UNITS: f64 = 64.0;
/// That change of the state.
const NUDGE: f64 = 1e-14;

/// The difference between rates of a state by machine code and by the interpreter, as a part of what is allowed.
fn gap(found: &[f64], expected: &[f64], nudged: &[Option<&Vec<f64>>]) -> f64 {
    let largest = expected.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    let mut worst: f64 = 0.0;
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        if f.to_bits() == e.to_bits() {
            continue;
        }
        let change = |other: &Option<&Vec<f64>>| match other {
            Some(other) => (other[i] - e).abs(),
            None => f64::INFINITY,
        };
        let change = nudged.iter().map(change).fold(0.0, f64::max);
        let unit = f64::EPSILON * (largest + change / NUDGE);
        worst = worst.max((f - e).abs() / (UNITS * unit));
    }
    worst
}

/// A block by every back end: the states have the bits of each alone, by four and by eight the same, and those of the
/// interpreter up to rounding.
#[test]
fn back_ends_agree_on_the_rates_of_every_model() {
    let (mut compared, mut left_out) = (0, Vec::new());
    for file in model_files() {
        let Some(rates) = rates(&file) else {
            left_out.push(file);
            continue;
        };
        let given = states(&rates, &[0.0]);
        let interpreter = Interpreter::new(rates.program.clone()).unwrap();
        let expected = together(&interpreter, &rates, &given);
        let signs: [&[f64]; 4] = [
            &[1.0],
            &[1.0, -1.0],
            &[1.0, -1.0, -1.0],
            &[1.0, 1.0, 1.0, -1.0],
        ];
        let nudged = signs.map(|signs| {
            let nudge: Vec<f64> = signs.iter().map(|sign| sign * NUDGE).collect();
            together(&interpreter, &rates, &states(&rates, &nudge))
        });
        for vectors in [Vectors::Avx2, Vectors::Avx512] {
            let native = Native::with_vectors(rates.program.clone(), vectors).unwrap();
            let Some(native) = native else { continue };
            compared += 1;
            let found = together(&native, &rates, &given);
            let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
            for l in 0..LANES {
                let what = format!("{file}: {vectors:?}, state {l}");
                let single = alone(&native, &rates, &given[l]);
                let (one, block) = (single.as_deref().map(bits), found[l].as_deref().map(bits));
                assert_eq!(one, block, "{what}");
                assert_eq!(found[l].is_some(), expected[l].is_some(), "{what}");
                if let (Some(found), Some(expected)) = (&found[l], &expected[l]) {
                    let nudged = nudged.each_ref().map(|block| block[l].as_ref());
                    let gap = gap(found, expected, &nudged);
                    assert!(gap <= 1.0, "{what}: {gap} of what is allowed");
                }
            }
        }
    }
    assert_eq!(left_out, Vec::<String>::new(), "every model is compared");
    let all = [Vectors::Avx2, Vectors::Avx512];
    let widths = all.iter().filter(|vectors| vectors.are_available());
    assert_eq!(compared, model_files().len() * widths.count());
}
