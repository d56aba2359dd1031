//! Which nodes become local variables, and the order in which they are computed.

use super::power::PowerForm;
use super::CodeError;
use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::print::order::{Order, TermKey};
use crate::print::share::Plan;
use crate::print::Options;
use crate::rational::Rational;
use rustc_hash::{FxHashMap, FxHashSet};

/// Most names and numbers in a part that is written where it is used.
const SHORT: usize = 12;

/// Most terms or factors in one statement.
pub(super) const LONGEST_STATEMENT: usize = 16;

#[derive(Clone, Default)]
struct Info {
    /// How often it would be written.
    uses: usize,
    /// Whether it is written several times where it is used once, as the base of a square is.
    is_repeated: bool,
    /// Names and numbers to be written where it is not a local variable.
    size: usize,
    is_local: bool,
}

/// The decisions for the outputs of one function.
pub(super) struct Locals<'a> {
    pub(super) g: &'a Graph,
    plan: Plan,
    order: Order<'a>,
    nodes: FxHashMap<Expr, Info>,
    /// The nodes sin x, cos x, tan x by function and argument.
    trigonometric: FxHashMap<(Function, Expr), Expr>,
    /// The nodes √x by x.
    square_roots: FxHashMap<Expr, Expr>,
    /// What is needed, in the order of computation.
    pub(super) sequence: Vec<Expr>,
}

impl<'a> Locals<'a> {
    /// Decides for `outputs`; `function` is named in errors.
    pub(super) fn new(
        g: &'a Graph,
        outputs: &[Expr],
        function: &str,
    ) -> Result<Locals<'a>, CodeError> {
        let options = Options::default();
        let mut locals = Locals {
            g,
            plan: Plan::new(g, outputs, u64::MAX),
            order: Order::new(g, outputs, &options),
            nodes: FxHashMap::default(),
            trigonometric: FxHashMap::default(),
            square_roots: FxHashMap::default(),
            sequence: Vec::new(),
        };
        locals.find_common(outputs, function)?;
        locals.arrange(outputs);
        for &output in outputs {
            locals.add_uses(output, 1, false);
        }
        for place in 0..locals.sequence.len() {
            locals.count_uses(locals.sequence[place]);
        }
        let outputs: FxHashSet<Expr> = outputs.iter().copied().collect();
        for place in 0..locals.sequence.len() {
            let e = locals.sequence[place];
            locals.decide(e, outputs.contains(&e));
        }
        Ok(locals)
    }

    /// Whether `e` is computed in a statement of its own.
    pub(super) fn is_local(&self, e: Expr) -> bool {
        self.nodes.get(&e).is_some_and(|info| info.is_local)
    }

    /// Finds what other functions can be computed from, and refuses what is no numeric function.
    fn find_common(&mut self, outputs: &[Expr], function: &str) -> Result<(), CodeError> {
        if outputs.iter().any(|&e| is_array(self.g, e)) {
            return Err(CodeError::NotScalar {
                function: function.to_string(),
            });
        }
        for e in self.g.reachable(outputs) {
            check(self.g, e, function)?;
            match self.g.node(e) {
                Node::Apply {
                    function,
                    arguments,
                } if matches!(function, Function::Sin | Function::Cos | Function::Tan) => {
                    self.trigonometric.insert((*function, arguments[0]), e);
                }
                Node::Power { base, exponent }
                    if PowerForm::new(self.g, *exponent).is_some_and(PowerForm::is_square_root) =>
                {
                    self.square_roots.insert(*base, e);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Sorts what is needed: each part shortly before its first use.
    fn arrange(&mut self, outputs: &[Expr]) {
        enum Step {
            Enter(Expr),
            Leave(Expr),
        }
        let mut stack: Vec<Step> = outputs.iter().rev().map(|&e| Step::Enter(e)).collect();
        while let Some(step) = stack.pop() {
            match step {
                Step::Leave(e) => self.sequence.push(e),
                Step::Enter(e) if self.nodes.contains_key(&e) => {}
                Step::Enter(e) => {
                    self.nodes.insert(e, Info::default());
                    stack.push(Step::Leave(e));
                    let first = stack.len();
                    self.for_each_part(e, |part, _| stack.push(Step::Enter(part)));
                    stack[first..].reverse();
                }
            }
        }
    }

    fn add_uses(&mut self, e: Expr, count: u32, is_repeated: bool) {
        if let Some(info) = self.nodes.get_mut(&e) {
            info.uses += count as usize;
            info.is_repeated |= is_repeated;
        }
    }

    fn count_uses(&mut self, e: Expr) {
        let mut parts = Vec::new();
        self.for_each_part(e, |part, count| parts.push((part, count)));
        for (part, count) in parts {
            self.add_uses(part, count, count > 1);
        }
    }

    fn decide(&mut self, e: Expr, is_output: bool) {
        let g = self.g;
        let mut size = 0usize;
        self.for_each_part(e, |part, count| {
            let own = match &self.nodes[&part] {
                info if info.is_local => 1,
                info => info.size,
            };
            size = size.saturating_add(own.saturating_mul(count as usize));
        });
        let info = &self.nodes[&e];
        let repeated = info.is_repeated || info.uses > 1;
        let (size, is_local) = match g.node(e) {
            Node::Number(_)
            | Node::Pi
            | Node::Algebraic(_)
            | Node::Symbol(_)
            | Node::Entry { .. } => (1, false),
            Node::Matrix { .. } | Node::Solve { .. } => (size, true),
            Node::Product {
                coefficient,
                factors,
            } => {
                let size = size + usize::from(!is_unit(coefficient));
                // The negative of a name is as short as a name of its own.
                let trivial = size == 1 && factors.len() == 1 && !info.is_repeated;
                let long = factors.len() > LONGEST_STATEMENT;
                let worth = repeated || (size > SHORT && !is_output);
                (size, long || (worth && !trivial))
            }
            node => {
                let (terms, own) = match node {
                    Node::Sum { constant, terms } => {
                        let scaled = terms.iter().filter(|(_, c)| !is_unit(c)).count();
                        (terms.len(), scaled + usize::from(!constant.is_zero()))
                    }
                    _ => (1, 1),
                };
                let size = size + own;
                let long = terms >= LONGEST_STATEMENT;
                (size, long || repeated || (size > SHORT && !is_output))
            }
        };
        if let Some(info) = self.nodes.get_mut(&e) {
            (info.size, info.is_local) = (size, is_local);
        }
    }

    /// Calls `visit` for each node that the text of `e` refers to, with how often; in the order of the text.
    fn for_each_part(&self, e: Expr, mut visit: impl FnMut(Expr, u32)) {
        let g = self.g;
        match g.node(e) {
            Node::Sum { terms, .. } => {
                for (term, _) in self.sorted_terms(terms) {
                    visit(term, 1);
                }
            }
            Node::Product { factors, .. } => {
                for factor in self.sorted_factors(factors) {
                    visit(factor, 1);
                }
            }
            Node::Power { base, exponent } => self.visit_power(e, *base, *exponent, &mut visit),
            Node::Apply {
                function,
                arguments,
            } => match self.divisor(*function, arguments) {
                Some(divisor) => visit(divisor, 1),
                None => arguments.iter().for_each(|&a| visit(a, 1)),
            },
            node => node.for_each_child(|child| visit(child, 1)),
        }
    }

    fn visit_power(&self, e: Expr, base: Expr, exponent: Expr, visit: &mut impl FnMut(Expr, u32)) {
        let Some(form) = PowerForm::new(self.g, exponent) else {
            visit(base, 1);
            if self.g.as_number(exponent).is_none() {
                visit(exponent, 1);
            }
            return;
        };
        let root = self
            .square_root(base)
            .filter(|&root| form.has_root && root != e);
        let uses = form.uses_of_base() - u32::from(root.is_some());
        if uses > 0 {
            visit(base, uses);
        }
        if let Some(root) = root {
            visit(root, 1);
        }
    }

    /// The node √base if it is computed anyway.
    pub(super) fn square_root(&self, base: Expr) -> Option<Expr> {
        self.square_roots.get(&base).copied()
    }

    /// The node whose reciprocal a secant, cosecant or cotangent is, if it is computed anyway.
    pub(super) fn divisor(&self, function: Function, arguments: &[Expr]) -> Option<Expr> {
        let (function, argument) = (reciprocal(function)?, *arguments.first()?);
        self.trigonometric.get(&(function, argument)).copied()
    }

    /// The terms of a sum in the order in which they are written.
    pub(super) fn sorted_terms<'t>(
        &self,
        terms: &'t [(Expr, Rational)],
    ) -> Vec<(Expr, &'t Rational)> {
        let mut sorted: Vec<(TermKey, Expr, &Rational)> = terms
            .iter()
            .map(|(term, c)| (self.order.term_key(*term, &self.plan), *term, c))
            .collect();
        sorted.sort_by(|a, b| a.0.cmp(&b.0));
        sorted.into_iter().map(|(_, term, c)| (term, c)).collect()
    }

    /// The factors of a product in the order in which they are written.
    pub(super) fn sorted_factors(&self, factors: &[Expr]) -> Vec<Expr> {
        let mut sorted = factors.to_vec();
        sorted.sort_by_cached_key(|&factor| self.order.factor_key(factor, &self.plan));
        sorted
    }
}

/// The function of which `function` is the reciprocal.
pub(super) fn reciprocal(function: Function) -> Option<Function> {
    match function {
        Function::Sec => Some(Function::Cos),
        Function::Csc => Some(Function::Sin),
        Function::Cot => Some(Function::Tan),
        _ => None,
    }
}

fn is_unit(coefficient: &Rational) -> bool {
    coefficient.is_one() || *coefficient == Rational::NEG_ONE
}

fn is_array(g: &Graph, e: Expr) -> bool {
    matches!(g.node(e), Node::Matrix { .. } | Node::Solve { .. })
}

/// Refuses wrong numbers of arguments, and arrays where a number is needed.
fn check(g: &Graph, e: Expr, function: &str) -> Result<(), CodeError> {
    let not_scalar = || CodeError::NotScalar {
        function: function.to_string(),
    };
    let is_scalar = |e: &Expr| !is_array(g, *e);
    let fits = match g.node(e) {
        Node::Apply {
            function: applied,
            arguments,
        } => {
            if arguments.len() != applied.arity() {
                return Err(CodeError::UnknownFunction {
                    function: function.to_string(),
                    applied: applied.name().to_string(),
                    arguments: arguments.len(),
                });
            }
            arguments.iter().all(is_scalar)
        }
        Node::Entry { of, index } => match g.node(*of) {
            Node::Solve { rhs, .. } => (*index as usize) < rhs.len(),
            _ => false,
        },
        Node::Solve { matrix, rhs } => match g.node(*matrix) {
            Node::Matrix { entries, .. } => {
                entries.len() == rhs.len() * rhs.len() && rhs.iter().all(is_scalar)
            }
            _ => false,
        },
        node => {
            let mut all = true;
            node.for_each_child(|child| all &= is_scalar(&child));
            all
        }
    };
    fits.then_some(()).ok_or_else(not_scalar)
}
