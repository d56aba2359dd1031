//! A graph of more than a million nodes, as deep as it is large, from several threads.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_symbolic::{Expr, Graph};

/// x ← sin(x) + a x, three nodes a time.
fn chain(g: &Graph, name: &str, length: usize) -> Expr {
    let (start, a) = (g.symbol(name, 0), g.symbol("a", 0));
    (0..length).fold(start, |x, _| g.add(&[g.sin(x), g.mul(&[a, x])]))
}

#[test]
fn a_million_nodes_are_built_evaluated_differentiated_and_freed() {
    const LENGTH: usize = 170_000;
    let g = Graph::new();
    let chains: Vec<Expr> = std::thread::scope(|scope| {
        let started: Vec<_> = ["x", "y"]
            .map(|name| (name, &g))
            .into_iter()
            .map(|(name, g)| scope.spawn(move || chain(g, name, LENGTH)))
            .collect();
        started.into_iter().map(|t| t.join().unwrap()).collect()
    });
    assert!(g.reachable(&chains).len() > 6 * LENGTH - 10);
    let at = |name: &str, value: f64| {
        let value = move |s, n: &Graph| match n.symbol_name(s) {
            "a" => Some(0.5),
            _ => Some(value),
        };
        let e = chains[usize::from(name == "y")];
        g.evaluate_f64(&[e], &|s| value(s, &g)).unwrap()[0]
    };
    // The same recurrence in plain numbers.
    let expected = |start: f64| (0..LENGTH).fold(start, |x: f64, _| x.sin() + 0.5 * x);
    assert!((at("x", 0.7) - expected(0.7)).abs() < 1e-9);
    assert!((at("y", -1.2) - expected(-1.2)).abs() < 1e-9);
    // dx'/dx = cos(x) + a along the chain, multiplied up; the fixed point is attracting.
    let x = g.as_symbol(g.symbol("x", 0)).unwrap();
    let slope = g.gradient(chains[0], &[x])[0];
    let value = g.evaluate_f64(&[slope], &|s| {
        Some(if g.symbol_name(s) == "a" { 0.5 } else { 0.7 })
    });
    let plain = (0..LENGTH).fold((0.7_f64, 1.0_f64), |(x, slope), _| {
        (x.sin() + 0.5 * x, slope * (x.cos() + 0.5))
    });
    assert!((value.unwrap()[0] - plain.1).abs() < 1e-9);
    drop(g);
}
