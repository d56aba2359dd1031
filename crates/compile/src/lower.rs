//! From expressions to a [`Program`].
//!
//! The order of instructions follows the expressions depth first from the first output to the last, so it depends
//! on the expressions only, not on how the graph was built. What is decided here, and nothing else:
//!
//! - common factors of the terms of a sum are taken out (`horner`);
//! - every node is computed once; equal instructions are one;
//! - what several sums begin with is added once (`sums`);
//! - a sum is folded with fused products in runs of eight terms, the runs are added pairwise;
//! - what several products have in common is multiplied first (`pairs`);
//! - in a product the factors that depend on parameters only are one hoisted factor; powers with negative
//!   exponent that occur nowhere else are gathered into one division;
//! - integer powers are chains of products, half-integer ones use one square root;
//! - sine and cosine of one angle are one instruction; tan, cot, sec, csc are quotients of them;
//! - a matrix is factorized once, before the first system that needs it.

use crate::allocate;
use crate::arithmetic::Exponent;
use crate::emit::{Emitter, Origin};
use crate::horner;
use crate::pairs::Pairs;
use crate::program::{Binary, Factorization, Program, Register, Unary};
use crate::sums::Sums;
use chetaev_symbolic::{rational, Expr, Function, Graph, Node, Rational, Symbol};
use rustc_hash::FxHashSet;

/// Why expressions cannot be lowered.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LowerError {
    /// A symbol is neither a variable nor a parameter.
    #[error("`{0}` is neither a variable nor a parameter of the program")]
    Unbound(String),
    /// A symbol was listed twice among variables and parameters.
    #[error("`{0}` is listed twice among variables and parameters")]
    Duplicate(String),
    /// An output, or an operand, is a matrix or a vector.
    #[error("output {index} of `{group}` contains a matrix or a vector where a number is needed")]
    NotScalar {
        /// Name of the group.
        group: String,
        /// Zero-based index in the group.
        index: usize,
    },
    /// A solve whose matrix is not square, whose right-hand side has another length, or whose entry does not exist.
    #[error("a linear system in output {index} of `{group}` has inconsistent sizes")]
    Malformed {
        /// Name of the group.
        group: String,
        /// Zero-based index in the group.
        index: usize,
    },
}

/// What is to be computed, from what; built up, then lowered.
#[derive(Clone, Debug)]
pub struct Lowering<'g> {
    graph: &'g Graph,
    variables: Vec<Symbol>,
    parameters: Vec<Symbol>,
    groups: Vec<(String, Vec<Expr>)>,
    definite: Vec<Expr>,
    names: Vec<(String, Vec<Expr>)>,
}

impl<'g> Lowering<'g> {
    /// A program of `graph` without outputs.
    pub fn new(graph: &'g Graph) -> Lowering<'g> {
        Lowering {
            graph,
            variables: Vec::new(),
            parameters: Vec::new(),
            groups: Vec::new(),
            definite: Vec::new(),
            names: Vec::new(),
        }
    }

    /// Appends variables: their values are given for every evaluation, in this order.
    #[must_use]
    pub fn variables(mut self, symbols: &[Symbol]) -> Self {
        self.variables.extend_from_slice(symbols);
        self
    }

    /// Appends parameters: their values are given once, in this order; what depends on them only is computed then.
    #[must_use]
    pub fn parameters(mut self, symbols: &[Symbol]) -> Self {
        self.parameters.extend_from_slice(symbols);
        self
    }

    /// Appends a group of outputs. A caller may later evaluate the first groups only, so put first what is needed
    /// most often.
    #[must_use]
    pub fn output(mut self, name: &str, values: &[Expr]) -> Self {
        self.groups.push((name.to_string(), values.to_vec()));
        self
    }

    /// States that the symmetric matrices of all linear systems occurring in `expressions` are positive definite.
    ///
    /// Those that are structurally symmetric are factorized as L D Lᵀ. The statement is not trusted: at a state
    /// where a pivot contradicts it, pivoted L U takes over. It decides speed, never the result beyond rounding.
    #[must_use]
    pub fn positive_definite(mut self, expressions: &[Expr]) -> Self {
        self.definite.extend_from_slice(expressions);
        self
    }

    /// Gives a name, for failures, to the matrices of all linear systems occurring in `expressions` that have none.
    #[must_use]
    pub fn name_matrices(mut self, name: &str, expressions: &[Expr]) -> Self {
        self.names.push((name.to_string(), expressions.to_vec()));
        self
    }

    /// The program.
    ///
    /// Costs time in proportion to the nodes below the outputs, without recursion.
    ///
    /// # Errors
    /// [`LowerError`] for a symbol that is not bound or bound twice, and for an output that is not a number.
    pub fn lower(&self) -> Result<Program, LowerError> {
        let lists = self.groups.iter().map(|(_, values)| values);
        let lists = lists.chain(self.names.iter().map(|(_, values)| values));
        let all: Vec<Expr> = lists.chain([&self.definite]).flatten().copied().collect();
        let is_variable = |s: Symbol| self.variables.contains(&s);
        let mut all = horner::factored(self.graph, &all, &is_variable).into_iter();
        let mut factored = self.clone();
        let lists = factored.groups.iter_mut().map(|(_, values)| values);
        let lists = lists.chain(factored.names.iter_mut().map(|(_, values)| values));
        for value in lists.chain([&mut factored.definite]).flatten() {
            *value = all.next().unwrap_or(*value);
        }
        factored.lower_factored()
    }

    fn lower_factored(&self) -> Result<Program, LowerError> {
        let mut lowerer = Lowerer::new(self)?;
        let mut outputs = Vec::with_capacity(self.groups.len());
        for (name, values) in &self.groups {
            let mut registers = Vec::with_capacity(values.len());
            for (index, &value) in values.iter().enumerate() {
                let register = lowerer.value(value).map_err(|fault| match fault {
                    Fault::Unbound(symbol) => LowerError::Unbound(self.graph.symbol_text(symbol)),
                    Fault::NotScalar => LowerError::NotScalar {
                        group: name.clone(),
                        index,
                    },
                    Fault::Malformed => LowerError::Malformed {
                        group: name.clone(),
                        index,
                    },
                })?;
                registers.push(register);
            }
            outputs.push(allocate::Group {
                name: name.clone(),
                registers,
                end: lowerer.emitter.body.len(),
            });
        }
        let text = |symbols: &[Symbol]| -> Vec<String> {
            let text = symbols.iter().map(|&s| self.graph.symbol_text(s));
            text.collect()
        };
        Ok(allocate::allocate(
            lowerer.emitter,
            text(&self.variables),
            text(&self.parameters),
            outputs,
        ))
    }
}

/// What went wrong below an output.
pub(crate) enum Fault {
    Unbound(Symbol),
    NotScalar,
    Malformed,
}

/// Not yet lowered.
/// Bits of algebraic numbers.
const BITS: usize = 256;
const ABSENT: u32 = u32::MAX;
const NEEDS_SIN: u8 = 1;
const NEEDS_COS: u8 = 2;

/// Tables over the nodes of the graph, and the tape.
pub(crate) struct Lowerer<'g> {
    pub(crate) graph: &'g Graph,
    pub(crate) emitter: Emitter,
    pub(crate) one: Rational,
    /// By node: its register; of a matrix or a solve its index; [`ABSENT`] before it is lowered.
    places: Vec<u32>,
    /// By node: how many parents and outputs refer to it, saturating.
    uses: Vec<u8>,
    /// By node: which of its sine and cosine are needed.
    trigonometry: Vec<u8>,
    /// By symbol expression, sorted: the register.
    inputs: Vec<(Expr, Register)>,
    definite: Vec<Expr>,
    /// The order in which factors are multiplied.
    pub(crate) pairs: Pairs,
    /// The order in which terms are added.
    pub(crate) sums: Sums,
    names: Vec<(Expr, usize)>,
    name_texts: Vec<String>,
}

impl<'g> Lowerer<'g> {
    fn new(lowering: &Lowering<'g>) -> Result<Lowerer<'g>, LowerError> {
        let graph = lowering.graph;
        let roots = || lowering.groups.iter().flat_map(|(_, values)| values);
        let size = roots().map(|e| e.index() + 1).max().unwrap_or(0);
        let mut lowerer = Lowerer {
            graph,
            emitter: Emitter::default(),
            one: rational::integer(1),
            places: vec![ABSENT; size],
            uses: vec![0; size],
            trigonometry: vec![0; size],
            inputs: Vec::new(),
            definite: matrices_in(graph, &lowering.definite),
            pairs: Pairs::default(),
            sums: Sums::default(),
            names: Vec::new(),
            name_texts: Vec::new(),
        };
        for (name, expressions) in &lowering.names {
            let index = lowerer.name_texts.len();
            let matrices = matrices_in(graph, expressions);
            lowerer
                .names
                .extend(matrices.into_iter().map(|m| (m, index)));
            lowerer.name_texts.push(name.clone());
        }
        lowerer.bind(&lowering.parameters, Origin::Parameter)?;
        lowerer.bind(&lowering.variables, Origin::Variable)?;
        lowerer.survey(roots().copied());
        lowerer.share(&roots().copied().collect::<Vec<_>>(), &lowering.variables);
        Ok(lowerer)
    }

    /// The orders of multiplication of factors that change with the state and stand above the fraction bar, and of addition of
    /// terms that change.
    fn share(&mut self, roots: &[Expr], variables: &[Symbol]) {
        let (graph, variables) = (self.graph, FxHashSet::from_iter(variables.iter().copied()));
        let mut moves = vec![false; self.uses.len()];
        for e in graph.reachable(roots) {
            let mut own = graph.as_symbol(e).is_some_and(|s| variables.contains(&s));
            let node = graph.node(e);
            node.for_each_child(|child| own |= moves[child.index()]);
            moves[e.index()] = own;
        }
        let is_factor = |e: Expr| moves[e.index()] && self.inlined_denominator(e).is_none();
        let pairs = Pairs::new(graph, roots, is_factor);
        self.sums = Sums::new(graph, roots, |e| moves[e.index()]);
        self.pairs = pairs;
    }

    fn bind(
        &mut self,
        symbols: &[Symbol],
        origin: impl Fn(u32) -> Origin,
    ) -> Result<(), LowerError> {
        for (slot, &symbol) in symbols.iter().enumerate() {
            let e = self.graph.symbol_expr(symbol);
            let register = self.emitter.register(origin(slot as u32));
            match self.inputs.binary_search_by_key(&e, |input| input.0) {
                Ok(_) => return Err(LowerError::Duplicate(self.graph.symbol_text(symbol))),
                Err(at) => self.inputs.insert(at, (e, register)),
            }
        }
        Ok(())
    }

    /// Counts the uses of every node and notes which angles need sine, cosine or both.
    fn survey(&mut self, roots: impl Iterator<Item = Expr>) {
        let mut stack = Vec::new();
        for root in roots {
            self.count_use(root, &mut stack);
        }
        while let Some(e) = stack.pop() {
            let node = self.graph.node(e);
            if let Node::Apply {
                function,
                arguments,
            } = node
            {
                if let Some(angle) = arguments.first() {
                    self.trigonometry[angle.index()] |= trigonometry(*function);
                }
            }
            node.for_each_child(|child| self.count_use(child, &mut stack));
        }
    }

    fn count_use(&mut self, e: Expr, stack: &mut Vec<Expr>) {
        let uses = &mut self.uses[e.index()];
        if *uses == 0 {
            stack.push(e);
        }
        *uses = uses.saturating_add(1);
    }

    /// Whether `e` has a single parent and is no output.
    fn is_single(&self, e: Expr) -> bool {
        self.uses[e.index()] == 1
    }

    /// Whether a term of a sum is multiplied into the sum instead of being a value of its own.
    pub(crate) fn is_inlined_product(&self, e: Expr) -> bool {
        self.is_single(e) && matches!(self.graph.node(e), Node::Product { .. })
    }

    /// The base and the positive exponent of a factor that goes below the fraction bar of its product.
    pub(crate) fn inlined_denominator(&self, e: Expr) -> Option<(Expr, Exponent)> {
        if !self.is_single(e) {
            return None;
        }
        match self.graph.node(e) {
            Node::Power { base, exponent } => {
                let exponent = Exponent::of(self.graph.as_number(*exponent)?)?;
                exponent.reciprocal().map(|exponent| (*base, exponent))
            }
            _ => None,
        }
    }

    /// Calls `visit` for the nodes whose values `e` is computed from.
    fn for_each_operand(&self, e: Expr, mut visit: impl FnMut(Expr)) {
        match self.graph.node(e) {
            Node::Sum { terms, .. } => {
                for (term, _) in terms {
                    if self.is_inlined_product(*term) {
                        self.for_each_factor(*term, &mut visit);
                    } else {
                        visit(*term);
                    }
                }
            }
            Node::Product { .. } => self.for_each_factor(e, &mut visit),
            Node::Power { base, exponent } => {
                visit(*base);
                if self.graph.as_number(*exponent).is_none() {
                    visit(*exponent);
                }
            }
            node => node.for_each_child(visit),
        }
    }

    fn for_each_factor(&self, product: Expr, visit: &mut impl FnMut(Expr)) {
        self.graph
            .node(product)
            .for_each_child(|factor| match self.inlined_denominator(factor) {
                Some((base, _)) => visit(base),
                None => visit(factor),
            });
    }

    /// The register of `root`, after everything below it has been emitted, depth first.
    fn value(&mut self, root: Expr) -> Result<Register, Fault> {
        let mut stack = vec![root];
        while let Some(&e) = stack.last() {
            if self.places[e.index()] != ABSENT {
                stack.pop();
                continue;
            }
            let before = stack.len();
            self.for_each_operand(e, |operand| {
                if self.places[operand.index()] == ABSENT {
                    stack.push(operand);
                }
            });
            if stack.len() == before {
                self.places[e.index()] = self.place(e)?;
                stack.pop();
            } else {
                stack[before..].reverse();
            }
        }
        self.scalar(root)
    }

    /// The register of a node that has been lowered and is a number.
    pub(crate) fn scalar(&self, e: Expr) -> Result<Register, Fault> {
        match self.graph.node(e) {
            Node::Matrix { .. } | Node::Solve { .. } => Err(Fault::NotScalar),
            _ => Ok(Register(self.places[e.index()])),
        }
    }

    fn place(&mut self, e: Expr) -> Result<u32, Fault> {
        let graph = self.graph;
        let register = match graph.node(e) {
            Node::Number(value) => self.emitter.number(value),
            Node::Pi => self.emitter.pi(),
            // Closer than any arithmetic here tells.
            Node::Algebraic(own) => self.emitter.number(&own.near(BITS)),
            Node::Symbol(symbol) => self.input(e, *symbol)?,
            Node::Sum { constant, terms } => self.sum(e, constant, terms)?,
            Node::Product { .. } => self.product(e)?,
            Node::Power { base, exponent } => self.power(*base, *exponent)?,
            Node::Apply {
                function,
                arguments,
            } => self.apply(*function, arguments)?,
            Node::Matrix { .. } => return self.factor(e),
            Node::Solve { matrix, rhs } => return self.solve(*matrix, rhs),
            Node::Entry { of, index } => self.entry(*of, *index)?,
        };
        Ok(register.0)
    }

    fn input(&self, e: Expr, symbol: Symbol) -> Result<Register, Fault> {
        let found = self.inputs.binary_search_by_key(&e, |input| input.0);
        found
            .map(|at| self.inputs[at].1)
            .map_err(|_| Fault::Unbound(symbol))
    }

    fn apply(&mut self, function: Function, arguments: &[Expr]) -> Result<Register, Fault> {
        let (a, second) = match arguments {
            [a] => (*a, None),
            [a, b] => (*a, Some(*b)),
            _ => return Err(Fault::Malformed),
        };
        let angle = self.trigonometry[a.index()];
        let a = self.scalar(a)?;
        if let Some(b) = second {
            let b = self.scalar(b)?;
            return Ok(self.emitter.binary(Binary::Atan2, a, b));
        }
        Ok(match function {
            Function::Sin => self.sin(a, angle),
            Function::Cos => self.cos(a, angle),
            Function::Tan | Function::Cot => {
                let (sin, cos) = self.emitter.sin_cos(a);
                let (above, below) = match function {
                    Function::Tan => (sin, cos),
                    _ => (cos, sin),
                };
                self.emitter.binary(Binary::Div, above, below)
            }
            Function::Sec | Function::Csc => {
                let below = match function {
                    Function::Sec => self.cos(a, angle),
                    _ => self.sin(a, angle),
                };
                let one = self.emitter.number(&self.one);
                self.emitter.binary(Binary::Div, one, below)
            }
            _ => self.emitter.unary(Unary::Function(function), a),
        })
    }

    fn sin(&mut self, a: Register, angle: u8) -> Register {
        if angle & NEEDS_COS != 0 {
            self.emitter.sin_cos(a).0
        } else {
            self.emitter.unary(Unary::Function(Function::Sin), a)
        }
    }

    fn cos(&mut self, a: Register, angle: u8) -> Register {
        if angle & NEEDS_SIN != 0 {
            self.emitter.sin_cos(a).1
        } else {
            self.emitter.unary(Unary::Function(Function::Cos), a)
        }
    }

    fn factor(&mut self, e: Expr) -> Result<u32, Fault> {
        let Node::Matrix {
            rows,
            columns,
            entries,
        } = self.graph.node(e)
        else {
            return Err(Fault::Malformed);
        };
        let size = *rows as usize;
        if rows != columns || entries.len() != size * size || size == 0 {
            return Err(Fault::Malformed);
        }
        let symmetric =
            || (0..size).all(|i| (0..i).all(|j| entries[i * size + j] == entries[j * size + i]));
        let factorization = if self.definite.binary_search(&e).is_ok() && symmetric() {
            Factorization::Ldlt
        } else {
            Factorization::Lu
        };
        let name = self.names.iter().find(|named| named.0 == e);
        let name = name.map_or_else(String::new, |named| self.name_texts[named.1].clone());
        let registers: Result<Vec<Register>, Fault> =
            entries.iter().map(|&entry| self.scalar(entry)).collect();
        Ok(self.emitter.factor(registers?, size, factorization, name))
    }

    fn solve(&mut self, matrix: Expr, rhs: &[Expr]) -> Result<u32, Fault> {
        let is_matrix = matches!(self.graph.node(matrix), Node::Matrix { .. });
        let matrix = self.places[matrix.index()];
        if !is_matrix || self.emitter.matrices[matrix as usize].size != rhs.len() {
            return Err(Fault::Malformed);
        }
        let rhs: Result<Vec<Register>, Fault> = rhs.iter().map(|&b| self.scalar(b)).collect();
        Ok(self.emitter.solve(matrix, rhs?))
    }

    fn entry(&self, of: Expr, index: u32) -> Result<Register, Fault> {
        if !matches!(self.graph.node(of), Node::Solve { .. }) {
            return Err(Fault::Malformed);
        }
        let solve = &self.emitter.solves[self.places[of.index()] as usize];
        solve
            .out
            .get(index as usize)
            .copied()
            .ok_or(Fault::Malformed)
    }
}

/// Which of sine and cosine a function is computed from.
fn trigonometry(function: Function) -> u8 {
    match function {
        Function::Sin | Function::Csc => NEEDS_SIN,
        Function::Cos | Function::Sec => NEEDS_COS,
        Function::Tan | Function::Cot => NEEDS_SIN | NEEDS_COS,
        _ => 0,
    }
}

/// The matrix nodes below `expressions`, ascending.
fn matrices_in(graph: &Graph, expressions: &[Expr]) -> Vec<Expr> {
    let mut matrices = graph.reachable(expressions);
    matrices.retain(|&e| matches!(graph.node(e), Node::Matrix { .. }));
    matrices
}
