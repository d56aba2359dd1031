//! What is lowered is a valid program, and a state has the same bits alone and in a block, by the interpreter and by native code.
#![no_main]

use chetaev_compile::{Backend, BlockEvaluator, Evaluator, Lanes, Lowering, Program, LANES};
use chetaev_fuzz::expression;
use chetaev_symbolic::Graph;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let graph = Graph::new();
    let Some(e) = expression(&graph, text) else {
        return;
    };
    let symbols = graph.symbols_in(&[e]);
    let lowering = Lowering::new(&graph).variables(&symbols).output("f", &[e]);
    let Ok(program) = lowering.lower() else {
        return;
    };
    compare(&program, symbols.len());
});

fn compare(program: &Program, count: usize) {
    let interpreter = Backend::interpreter(program.clone()).expect("a valid program");
    let native = chetaev_compile::backend(program.clone()).expect("a valid program");
    for backend in [interpreter, native] {
        match &backend {
            Backend::Interpreter(one) => same_bits(&**one, count),
            #[cfg(all(unix, target_arch = "x86_64"))]
            Backend::Native(one) => same_bits(&**one, count),
            _ => {}
        }
    }
}

fn same_bits(backend: &(impl Evaluator + BlockEvaluator), count: usize) {
    let at = |lane: usize| -> Vec<f64> {
        let place = |i: usize| 0.3 + 0.7 * i as f64 - 0.45 * lane as f64;
        (0..count).map(place).collect()
    };
    let mut block = backend.block_workspace();
    if backend.prepare_block(&[], &mut block).is_err() {
        return;
    }
    let variables: Vec<Lanes> = (0..count)
        .map(|i| Lanes::from_fn(|lane| at(lane)[i]))
        .collect();
    let mut together = [Lanes::splat(0.0)];
    let ended = backend.evaluate_block(1, &variables, &mut block, &mut together);
    let mut workspace = backend.workspace();
    backend.prepare(&[], &mut workspace).expect("as the block");
    for lane in 0..LANES {
        let mut alone = [0.0];
        let own = backend.evaluate(&at(lane), &mut workspace, &mut alone);
        if own.is_ok() && ended.is_ok() {
            let other = together[0].as_slice()[lane];
            assert!(alone[0].to_bits() == other.to_bits() || (alone[0].is_nan() && other.is_nan()));
        }
    }
}
