//! Laws on random expressions: reading what is printed gives the expression; output is well formed.

use super::{options, read_document};
use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::number::random::Random;
use crate::print::{Document, Format, Options};
use crate::rational::{self, ratio, Rational};

struct Generator<'a> {
    g: &'a Graph,
    random: Random,
}

impl Generator<'_> {
    fn number(&mut self) -> Rational {
        ratio(self.random.between(-6, 6), self.random.between(1, 4)).unwrap()
    }

    fn leaf(&mut self) -> Expr {
        const NAMES: [&str; 9] = ["x", "y", "phi", "m", "a", "g", "q_1", "e", "lambda_blade"];
        match self.random.below(8) {
            0 => {
                let value = self.number();
                self.g.number(value)
            }
            1 => self.g.pi(),
            _ => {
                let name = NAMES[self.random.below(NAMES.len() as u64) as usize];
                self.g
                    .symbol(name, self.random.below(4).saturating_sub(1) as u32)
            }
        }
    }

    fn exponent(&mut self) -> Expr {
        match self.random.below(6) {
            0 => self.leaf(),
            1 => self.g.number(ratio(1, 2).unwrap()),
            2 => self.g.number(ratio(self.random.between(-5, 5), 3).unwrap()),
            _ => self.g.integer(self.random.between(-3, 3)),
        }
    }

    fn expression(&mut self, depth: u32) -> Expr {
        if depth == 0 {
            return self.leaf();
        }
        let g = self.g;
        let several = |this: &mut Self| -> Vec<Expr> {
            (0..this.random.between(2, 4))
                .map(|_| this.expression(depth - 1))
                .collect()
        };
        match self.random.below(9) {
            0..=2 => g.add(&several(self)),
            3..=5 => g.mul(&several(self)),
            6 | 7 => {
                let base = self.expression(depth - 1);
                let exponent = self.exponent();
                g.pow(base, exponent)
            }
            _ => {
                let all = Function::ALL;
                let function = all[self.random.below(all.len() as u64) as usize];
                let arguments: Vec<Expr> = (0..function.arity())
                    .map(|_| self.expression(depth - 1))
                    .collect();
                g.apply(function, &arguments)
            }
        }
    }
}

/// Whether a part is no real number, which the parser refuses.
fn is_undefined(g: &Graph, e: Expr) -> bool {
    let negative = |e: Expr| g.as_number(e).is_some_and(rational::is_negative);
    g.reachable(&[e]).into_iter().any(|n| match g.node(n) {
        Node::Power { base, exponent } => {
            g.is_zero(*base) || (negative(*base) && g.as_number(*exponent).is_some())
        }
        Node::Apply {
            function: Function::Log,
            arguments,
        } => g.is_zero(arguments[0]) || negative(arguments[0]),
        _ => false,
    })
}

/// Parse(print(e)) = e.
#[test]
fn reading_what_is_printed_gives_the_expression() {
    let mut read_back = 0;
    for seed in 0..3000 {
        let g = Graph::new();
        let mut generator = Generator {
            g: &g,
            random: Random::new(seed),
        };
        let e = generator.expression(1 + (seed % 4) as u32);
        if is_undefined(&g, e) {
            continue;
        }
        read_back += 1;
        for max_nodes in [u64::MAX, 20] {
            let options = Options {
                max_nodes,
                ..options(&["x", "q_1"])
            };
            let document = Document::expressions(&g, &[e], &options);
            let again = read_document(&g, &document);
            assert_eq!(again, [e], "seed {seed}: {}", document.render(Format::Text));
        }
    }
    assert!(read_back > 2500, "{read_back}");
}

/// Depth of nesting; panics where tags do not match.
pub(super) fn depth_of_tags(source: &str) -> usize {
    let mut open: Vec<&str> = Vec::new();
    let mut deepest = 0;
    for part in source.split('<').skip(1) {
        let (tag, text) = part.split_once('>').unwrap();
        assert!(!text.contains(['"', '\'']), "{source}");
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name), "{source}"),
            None => open.push(tag.split(' ').next().unwrap()),
        }
        deepest = deepest.max(open.len());
    }
    assert!(open.is_empty(), "{source}");
    deepest
}

/// Number of children that each element has to have (MathML Core §3).
fn check_arity(source: &str) {
    let mut children: Vec<(String, usize)> = vec![(String::new(), 0)];
    for part in source.split('<').skip(1) {
        let (tag, _) = part.split_once('>').unwrap();
        if let Some(name) = tag.strip_prefix('/') {
            let (_, count) = children.pop().unwrap();
            let needed = match name {
                "mfrac" | "msup" | "msub" | "mover" | "mroot" => 2,
                "msubsup" => 3,
                _ => continue,
            };
            assert_eq!(count, needed, "{name} in {source}");
        } else {
            children.last_mut().unwrap().1 += 1;
            children.push((tag.to_string(), 0));
        }
    }
}

#[test]
fn typeset_output_is_well_formed() {
    for seed in 0..500 {
        let g = Graph::new();
        let mut generator = Generator {
            g: &g,
            random: Random::new(seed),
        };
        let e = generator.expression(3);
        let mathml = g.mathml(e);
        depth_of_tags(&mathml);
        check_arity(&mathml);
        let latex = g.latex(e);
        for (open, close) in [("{", "}"), ("(", ")"), ("\\left", "\\right")] {
            assert_eq!(
                latex.matches(open).count(),
                latex.matches(close).count(),
                "{latex}"
            );
        }
        let sympy = g.sympy(e);
        assert!(!sympy.contains('\'') && !sympy.contains('^'), "{sympy}");
        assert_eq!(sympy.matches('(').count(), sympy.matches(')').count());
    }
}
