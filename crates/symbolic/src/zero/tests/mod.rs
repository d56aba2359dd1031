//! The traps of T6 §6.7, random identities, planted errors, varieties and scale.

mod random;
mod ranks;
mod traps;
mod varieties;

use super::assumptions::Assumptions;
use super::{decide_zero, ZeroTest};
use crate::graph::Graph;
use crate::node::Expr;
use crate::verdict::Verdict;

/// The verdict on `e = 0` everywhere.
fn decide(graph: &Graph, e: Expr) -> Verdict {
    decide_under(graph, e, &Assumptions::new())
}

fn decide_under(graph: &Graph, e: Expr, assumptions: &Assumptions) -> Verdict {
    decide_zero(graph, &ZeroTest::everywhere(&[e], assumptions))
}

/// Parses an expression of the text format.
fn parse(graph: &Graph, text: &str) -> Expr {
    tiny_parser::parse(graph, text)
}

#[track_caller]
fn proved(graph: &Graph, text: &str) {
    let verdict = decide(graph, parse(graph, text));
    let Verdict::Proved(proof) = &verdict else {
        panic!("{text}: {verdict:?}")
    };
    assert!(
        proof.error_bound_log2.is_none_or(|bound| bound <= -100.0),
        "{proof:?}"
    );
}

#[track_caller]
fn refuted(graph: &Graph, text: &str) {
    let verdict = decide(graph, parse(graph, text));
    assert!(
        matches!(verdict, Verdict::Refuted(_)),
        "{text}: {verdict:?}"
    );
}

/// A parser for the tests alone, so that they do not depend on the text format.
mod tiny_parser {
    use crate::graph::Graph;
    use crate::node::{Expr, Function};
    use crate::rational;

    struct Parser<'a> {
        graph: &'a Graph,
        rest: &'a str,
    }

    pub(super) fn parse(graph: &Graph, text: &str) -> Expr {
        let mut parser = Parser { graph, rest: text };
        let e = parser.sum();
        assert!(parser.rest.trim().is_empty(), "unread: {}", parser.rest);
        e
    }

    impl Parser<'_> {
        fn peek(&mut self) -> Option<char> {
            self.rest = self.rest.trim_start();
            self.rest.chars().next()
        }

        fn take(&mut self, wanted: char) -> bool {
            let found = self.peek() == Some(wanted);
            if found {
                self.rest = &self.rest[wanted.len_utf8()..];
            }
            found
        }

        fn sum(&mut self) -> Expr {
            let mut parts = vec![self.product()];
            loop {
                if self.take('+') {
                    parts.push(self.product());
                } else if self.take('-') {
                    let part = self.product();
                    parts.push(self.graph.neg(part));
                } else {
                    return self.graph.add(&parts);
                }
            }
        }

        fn product(&mut self) -> Expr {
            let mut e = self.unary();
            loop {
                if self.take('*') {
                    let factor = self.unary();
                    e = self.graph.mul(&[e, factor]);
                } else if self.take('/') {
                    let divisor = self.unary();
                    e = self.graph.div(e, divisor);
                } else {
                    return e;
                }
            }
        }

        fn unary(&mut self) -> Expr {
            if self.take('-') {
                let e = self.unary();
                return self.graph.neg(e);
            }
            let base = self.atom();
            if self.take('^') {
                let exponent = self.unary();
                return self.graph.pow(base, exponent);
            }
            base
        }

        fn atom(&mut self) -> Expr {
            if self.take('(') {
                let e = self.sum();
                assert!(self.take(')'));
                return e;
            }
            self.peek();
            let end = self
                .rest
                .find(|c: char| !c.is_alphanumeric() && c != '_' && c != '\'')
                .unwrap_or(self.rest.len());
            let (word, rest) = self.rest.split_at(end);
            self.rest = rest;
            if let Ok(number) = word.parse::<i64>() {
                return self.graph.number(rational::integer(number));
            }
            if word == "pi" {
                return self.graph.pi();
            }
            if self.take('(') {
                let mut arguments = vec![self.sum()];
                while self.take(',') {
                    arguments.push(self.sum());
                }
                assert!(self.take(')'));
                if word == "sqrt" {
                    return self.graph.sqrt(arguments[0]);
                }
                let function = Function::ALL
                    .into_iter()
                    .find(|f| f.name() == word)
                    .unwrap();
                return self.graph.apply(function, &arguments);
            }
            let name = word.trim_end_matches('\'');
            self.graph.symbol(name, (word.len() - name.len()) as u32)
        }
    }
}
