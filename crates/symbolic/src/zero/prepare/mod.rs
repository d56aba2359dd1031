//! From expressions to a program over the field of T6 §6.1: generators are collected, dependent ones rewritten.
//!
//! What makes the rewriting sound: each generator has, at every point where the expressions under test are defined and
//! the conditions listed hold, a true real value for which every operation of the program is true. So a program that is
//! identically zero proves an identity of functions. Missing a relation between generators can only make a proof
//! impossible.

mod angles;
mod discover;
mod radicals;
mod relations;
mod transcendental;

use std::collections::BTreeMap;

use dashu_int::IBig;
use rustc_hash::FxHashMap;

use super::assumptions::{Assumptions, SignSet};
use super::expand::LinearForm;
use super::program::{Constant, Generator, Operation, Program, Value};
use super::signs::Signs;
use crate::graph::Graph;
use crate::node::{Expr, Function, Node, Symbol};
use crate::rational::{self, Rational};

/// What a program is made of.
#[derive(Clone, Debug)]
pub(super) struct Question<'a> {
    /// The expressions under test.
    pub(super) outputs: &'a [Expr],
    /// Nonlinear constraints, each with the symbol it determines.
    pub(super) constraints: &'a [(Expr, Symbol)],
    /// What may be assumed.
    pub(super) assumptions: &'a Assumptions,
}

/// Builds the program.
pub(super) fn prepare(graph: &Graph, question: &Question<'_>) -> Program {
    let mut roots = question.outputs.to_vec();
    roots.extend(question.constraints.iter().map(|(f, _)| *f));
    let mut builder = Builder::new(graph, question);
    builder.relate(&roots);
    builder.discover(&roots);
    // Roots of numbers first: what is related to them can then be written as a multiple of them.
    for e in graph.reachable(&roots) {
        if is_root_of_number(graph, e) {
            builder.build(e);
        }
    }
    for root in &roots {
        builder.build(*root);
    }
    let value = |e: &Expr| builder.memo.get(e).copied().unwrap_or_default();
    builder.program.outputs = question.outputs.iter().map(value).collect();
    builder.program.constraints = question.constraints.iter().map(|(f, _)| value(f)).collect();
    builder.program.positive = builder.positive();
    builder.program.faithful &= builder.program.angles_stand_alone();
    builder.program.arranged()
}

fn is_root_of_number(graph: &Graph, e: Expr) -> bool {
    match graph.node(e) {
        Node::Power { base, exponent } => {
            let is_fraction = graph.as_number(*exponent).is_some_and(|r| !r.is_int());
            is_fraction && graph.as_number(*base).is_some()
        }
        _ => false,
    }
}

/// Expressions that must be built before the one asked for.
type Missing = Vec<Expr>;

struct Builder<'g> {
    graph: &'g Graph,
    signs: Signs<'g>,
    program: Program,
    /// What is known without the domain of the expressions: decides which conditions are worth stating.
    plain: Signs<'g>,
    memo: FxHashMap<Expr, Value>,
    constants: BTreeMap<Rational, Constant>,
    forms: FxHashMap<Expr, LinearForm>,
    /// Monomials of arguments that are combinations of others.
    relations: relations::Relations,
    dependent: FxHashMap<Symbol, u32>,
    /// Common denominators of the multiples in which an angle occurs, and of exponents.
    angle_parts: FxHashMap<Expr, u64>,
    exponent_parts: FxHashMap<Expr, u64>,
    circles: FxHashMap<(Expr, u64), (Value, Value)>,
    angles: FxHashMap<Expr, (Value, Value)>,
    exponentials: FxHashMap<(Expr, u64), Value>,
    transcendental: FxHashMap<Expr, Value>,
    logarithms: FxHashMap<Expr, Value>,
    roots: FxHashMap<(Expr, u32), Value>,
    odd_roots: FxHashMap<(Expr, u64), Value>,
    moduli: FxHashMap<Expr, Value>,
    lowered: FxHashMap<Expr, Expr>,
}

impl<'g> Builder<'g> {
    fn new(graph: &'g Graph, question: &Question<'_>) -> Self {
        // A further constraint on a symbol that has one holds besides.
        let mut dependent: FxHashMap<Symbol, u32> = FxHashMap::default();
        let mut determines = Vec::new();
        for (i, (_, symbol)) in question.constraints.iter().enumerate() {
            determines.push(!dependent.contains_key(symbol));
            dependent.entry(*symbol).or_insert(i as u32);
        }
        Self {
            graph,
            signs: Signs::new(graph, question.assumptions),
            program: Program {
                order_of_unity: 1,
                faithful: true,
                determines,
                ..Program::default()
            },
            plain: Signs::new(graph, question.assumptions),
            memo: FxHashMap::default(),
            constants: BTreeMap::new(),
            forms: FxHashMap::default(),
            relations: relations::Relations::default(),
            dependent,
            angle_parts: FxHashMap::default(),
            exponent_parts: FxHashMap::default(),
            circles: FxHashMap::default(),
            angles: FxHashMap::default(),
            exponentials: FxHashMap::default(),
            transcendental: FxHashMap::default(),
            logarithms: FxHashMap::default(),
            roots: FxHashMap::default(),
            odd_roots: FxHashMap::default(),
            moduli: FxHashMap::default(),
            lowered: FxHashMap::default(),
        }
    }

    /// Values of known sign, from which roots could be taken; of use only where several roots may be related.
    fn positive(&mut self) -> Vec<Value> {
        if self.program.radicals < 2 {
            return Vec::new();
        }
        let graph = self.graph;
        let built = self.memo.iter();
        let known = built
            .filter(|(&e, _)| graph.as_number(e).is_none() && self.signs.sign(e).is_positive());
        let mut positive: Vec<Value> = known.map(|(_, &value)| value).collect();
        positive.sort_unstable();
        positive.dedup();
        positive
    }

    /// Builds `e` and everything below it, on an explicit stack.
    fn build(&mut self, e: Expr) {
        let mut stack = vec![e];
        while let Some(&top) = stack.last() {
            if self.memo.contains_key(&top) {
                stack.pop();
                continue;
            }
            match self.compute(top) {
                Ok(value) => {
                    self.memo.insert(top, value);
                    stack.pop();
                }
                Err(missing) => stack.extend(missing),
            }
        }
    }

    /// The value of `e` from the values of its parts, or the parts still missing.
    fn compute(&mut self, e: Expr) -> Result<Value, Missing> {
        let graph = self.graph;
        match graph.node(e) {
            Node::Number(value) => Ok(self.number(value.clone())),
            Node::Pi => Ok(self.constant_generator(e, "pi")),
            // Its polynomial is not used: an identity that holds for all values holds for this one.
            Node::Algebraic(_) => Ok(self.opaque(e)),
            Node::Symbol(symbol) => Ok(self.symbol(*symbol)),
            Node::Sum { constant, terms } => {
                let values = self.values(terms.iter().map(|(term, _)| *term))?;
                let terms = values
                    .into_iter()
                    .zip(terms.iter().map(|(_, c)| c.clone()))
                    .collect();
                Ok(self.sum(constant, terms))
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let factors = self.values(factors.iter().copied())?;
                Ok(self.product(coefficient.clone(), factors))
            }
            Node::Power { base, exponent } => self.power(e, *base, *exponent),
            Node::Apply {
                function,
                arguments,
            } => self.apply(e, *function, arguments),
            Node::Matrix { rows, entries, .. } => {
                let entries = self.values(entries.iter().copied())?.into();
                Ok(self.push(Operation::Matrix {
                    size: *rows,
                    entries,
                }))
            }
            Node::Solve { matrix, rhs } => {
                let mut values =
                    self.values(std::iter::once(*matrix).chain(rhs.iter().copied()))?;
                let rhs = values.split_off(1).into();
                Ok(self.push(Operation::Solve {
                    matrix: values[0],
                    rhs,
                }))
            }
            Node::Entry { of, index } => {
                let of = self.value(*of)?;
                Ok(self.push(Operation::Entry { of, index: *index }))
            }
        }
    }

    fn power(&mut self, e: Expr, base: Expr, exponent: Expr) -> Result<Value, Missing> {
        match self.graph.as_number(exponent) {
            Some(n) if n.is_int() => {
                let base = self.value(base)?;
                Ok(self.power_of(base, n.numerator().clone()))
            }
            Some(r) => {
                let r = r.clone();
                self.rational_power(base, &r)
            }
            None => {
                let lowered = self.lower(e);
                self.value(lowered)
            }
        }
    }

    fn apply(&mut self, e: Expr, function: Function, arguments: &[Expr]) -> Result<Value, Missing> {
        let Some(&x) = arguments.first() else {
            return Ok(self.opaque(e));
        };
        match function {
            Function::Sin => Ok(self.angle(x)?.1),
            Function::Cos => Ok(self.angle(x)?.0),
            Function::Tan => self.ratio_of_angle(x, |(cos, sin)| (Some(sin), cos)),
            Function::Cot => self.ratio_of_angle(x, |(cos, sin)| (Some(cos), sin)),
            Function::Sec => self.ratio_of_angle(x, |(cos, _)| (None, cos)),
            Function::Csc => self.ratio_of_angle(x, |(_, sin)| (None, sin)),
            Function::Exp => self.exponential(x),
            Function::Sinh | Function::Cosh | Function::Tanh => self.hyperbolic(function, x),
            Function::Log => self.logarithm(x),
            Function::Abs => self.absolute(x),
            Function::Sign => self.sign(x),
            Function::Acos | Function::Asinh | Function::Acosh | Function::Atanh => {
                let lowered = self.lower(e);
                self.value(lowered)
            }
            Function::Asin | Function::Atan | Function::Atan2 => Ok(self.opaque(e)),
        }
    }

    /// An equal expression in simpler functions, where there is one.
    fn lower(&mut self, e: Expr) -> Expr {
        if let Some(&lowered) = self.lowered.get(&e) {
            return lowered;
        }
        let g = self.graph;
        let one = g.one();
        let log = |x: Expr| g.apply(Function::Log, &[x]);
        let lowered = match g.node(e) {
            Node::Power { base, exponent } if g.as_number(*exponent).is_none() => {
                g.exp(g.mul(&[*exponent, log(*base)]))
            }
            Node::Apply {
                function,
                arguments,
            } => match (function, &**arguments) {
                (Function::Acos, &[x]) => {
                    let quarter = g.scale(&half(), g.pi());
                    g.sub(quarter, g.apply(Function::Asin, &[x]))
                }
                (Function::Asinh, &[x]) => log(g.add(&[x, g.sqrt(g.add(&[g.powi(x, 2), one]))])),
                (Function::Acosh, &[x]) => {
                    let root = g.mul(&[g.sqrt(g.sub(x, one)), g.sqrt(g.add(&[x, one]))]);
                    log(g.add(&[x, root]))
                }
                (Function::Atanh, &[x]) => {
                    g.scale(&half(), g.sub(log(g.add(&[one, x])), log(g.sub(one, x))))
                }
                _ => e,
            },
            _ => e,
        };
        self.lowered.insert(e, lowered);
        lowered
    }

    fn value(&self, e: Expr) -> Result<Value, Missing> {
        self.memo.get(&e).copied().ok_or_else(|| vec![e])
    }

    fn values(&self, es: impl Iterator<Item = Expr>) -> Result<Vec<Value>, Missing> {
        let mut missing = Vec::new();
        let mut values = Vec::new();
        for e in es {
            match self.memo.get(&e) {
                Some(&value) => values.push(value),
                None => missing.push(e),
            }
        }
        if missing.is_empty() {
            Ok(values)
        } else {
            Err(missing)
        }
    }

    fn push(&mut self, operation: Operation) -> Value {
        self.program.operations.push(operation);
        (self.program.operations.len() - 1) as Value
    }

    fn number(&mut self, value: Rational) -> Value {
        let constant = self.constant(&value);
        self.push(Operation::Number(constant))
    }

    fn product(&mut self, coefficient: Rational, factors: Vec<Value>) -> Value {
        match factors[..] {
            [only] if coefficient.is_one() => only,
            _ => {
                let coefficient = self.constant(&coefficient);
                self.push(Operation::Product {
                    coefficient,
                    factors: factors.into(),
                })
            }
        }
    }

    fn sum(&mut self, constant: &Rational, terms: Vec<(Value, Rational)>) -> Value {
        let constant = self.constant(constant);
        let terms = terms
            .into_iter()
            .map(|(value, c)| (value, self.constant(&c)))
            .collect();
        self.push(Operation::Sum { constant, terms })
    }

    /// The number of a constant, stored once.
    fn constant(&mut self, value: &Rational) -> Constant {
        if let Some(&index) = self.constants.get(value) {
            return index;
        }
        let index = self.program.constants.len() as Constant;
        self.program.constants.push(value.clone());
        self.constants.insert(value.clone(), index);
        index
    }

    fn power_of(&mut self, base: Value, exponent: IBig) -> Value {
        if exponent.is_one() {
            return base;
        }
        self.push(Operation::Power { base, exponent })
    }

    /// A value that exists nowhere: the reciprocal of zero.
    fn nowhere(&mut self) -> Value {
        let zero = self.number(Rational::ZERO);
        self.power_of(zero, IBig::from(-1))
    }

    fn generator(&mut self, generator: Generator) -> Value {
        let index = self.program.generators.len() as u32;
        self.program.generators.push(generator);
        self.push(Operation::Generator(index))
    }

    fn symbol(&mut self, symbol: Symbol) -> Value {
        match self.dependent.get(&symbol) {
            Some(&constraint) => self.generator(Generator::Dependent(constraint)),
            None => self.generator(Generator::Symbol(symbol)),
        }
    }

    /// A transcendental number: independent only while it is the only one.
    fn constant_generator(&mut self, e: Expr, text: &str) -> Value {
        if let Some(&value) = self.transcendental.get(&e) {
            return value;
        }
        let value = self.generator(Generator::Transcendental {
            text: text.to_owned(),
            independent: true,
            of: e,
        });
        self.transcendental.insert(e, value);
        value
    }

    /// A free generator for an expression of which nothing is used but its equality with itself.
    fn opaque(&mut self, e: Expr) -> Value {
        if let Some(&value) = self.transcendental.get(&e) {
            return value;
        }
        let text = match self.graph.node(e) {
            Node::Apply { function, .. } => function.name().to_owned(),
            _ => "an expression".to_owned(),
        };
        self.program.faithful = false;
        let value = self.generator(Generator::Transcendental {
            text,
            independent: false,
            of: e,
        });
        self.transcendental.insert(e, value);
        value
    }

    fn form(&mut self, e: Expr) -> LinearForm {
        if let Some(form) = self.forms.get(&e) {
            return form.clone();
        }
        let form = self.reduced_form(e);
        self.forms.insert(e, form.clone());
        form
    }

    /// coefficient·Π base^exponent, with rational exponents; a factor that is no such power stands with exponent 1.
    fn factors(&self, e: Expr) -> (Rational, Vec<(Expr, Rational)>) {
        let power = |factor: Expr| {
            let (base, exponent) = self.graph.base_exponent(factor);
            match self.graph.as_number(exponent) {
                Some(r) => (base, r.clone()),
                None => (factor, Rational::ONE),
            }
        };
        match self.graph.node(e) {
            Node::Number(value) => (value.clone(), Vec::new()),
            Node::Product {
                coefficient,
                factors,
            } => (
                coefficient.clone(),
                factors.iter().map(|&factor| power(factor)).collect(),
            ),
            _ => (Rational::ONE, vec![power(e)]),
        }
    }

    /// The signs of base^exponent.
    fn sign_of_power(&mut self, base: Expr, exponent: &Rational) -> SignSet {
        if !exponent.is_int() {
            return SignSet::POSITIVE.or(SignSet::ZERO);
        }
        let sign = self.signs.sign(base);
        sign.power(is_even(exponent), rational::is_negative(exponent))
    }
}

/// Is the integer even?
fn is_even(n: &Rational) -> bool {
    n.numerator().trailing_zeros() != Some(0)
}

fn half() -> Rational {
    Rational::from_parts(IBig::ONE, 2_u8.into())
}
