//! Any text is parsed without a panic, and what an expression prints is read again as the same expression.
#![no_main]

use chetaev_fuzz::expression;
use chetaev_symbolic::syntax::{parse_equation, parse_range, parse_relation};
use chetaev_symbolic::Graph;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    for parsed in [
        parse_equation(text),
        parse_relation(text),
        parse_range(text),
    ] {
        for diagnostic in &parsed.diagnostics {
            assert!(
                diagnostic.span.end <= text.len(),
                "{text:?}: {diagnostic:?}"
            );
        }
    }
    let graph = Graph::new();
    let Some(read) = expression(&graph, text) else {
        return;
    };
    let printed = graph.text(read);
    let again = expression(&graph, &printed);
    // Long formulas are not read a second time; what is read is the same.
    if let Some(again) = again {
        assert_eq!(read, again, "{text:?} is printed as {printed:?}");
    }
});
