//! True identities are never refuted: (e + x)² − e² − 2 e x − x², and the derivative of e² less 2 e e'.
#![no_main]

use chetaev_fuzz::expression;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, Options, ZeroTest};
use chetaev_symbolic::{Graph, Verdict};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let graph = Graph::new();
    let Some(e) = expression(&graph, text) else {
        return;
    };
    let x = graph.symbol("x", 0);
    let square = |e| graph.mul(&[e, e]);
    let sum = graph.add(&[e, x]);
    let product = graph.mul(&[graph.integer(-2), e, x]);
    let binomial = graph.add(&[
        square(sum),
        graph.neg(square(e)),
        product,
        graph.neg(square(x)),
    ]);
    let (residuals, assumptions) = ([binomial], Assumptions::default());
    let mut test = ZeroTest::everywhere(&residuals, &assumptions);
    test.options = Options {
        budget: 2_000_000,
        ..Options::default()
    };
    let verdict = decide_zero(&graph, &test);
    assert!(
        !matches!(verdict, Verdict::Refuted(_)),
        "{text:?}: {verdict:?}"
    );
});
