//! The interner: every structurally distinct expression is stored once.
//!
//! A graph only grows; it is freed as a whole when dropped. It may be read and extended from several threads.
//! The canonical constructors are in [`construct`](crate::construct) and [`functions`](crate::functions).

use crate::digest;
use crate::meter;
use crate::node::{Expr, Node, Symbol};
use crate::number::algebraic::AlgebraicInteger;
use crate::rational::{self, Rational};
use crate::simplify;
use hashbrown::HashTable;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

const SHARDS: usize = 16;

struct Stored {
    node: Node,
    digest: u128,
    /// Whether a sum is its own primitive part, once that has been asked.
    primitive: OnceLock<bool>,
}

struct SymbolData {
    name: Box<str>,
    order: u32,
    digest: u128,
}

/// An append-only, hash-consed expression graph.
pub struct Graph {
    nodes: boxcar::Vec<Stored>,
    shards: [Mutex<HashTable<u32>>; SHARDS],
    symbols: boxcar::Vec<SymbolData>,
    symbol_table: Mutex<HashTable<u32>>,
    /// The numbers 0 and 1, which are asked for most.
    units: [OnceLock<Expr>; 2],
    /// What was simplified before: reports, claims and equations ask for the same expressions again and again.
    simplified: Mutex<FxHashMap<(Expr, simplify::Options), Expr>>,
}

impl Default for Graph {
    fn default() -> Self {
        Graph::new()
    }
}

impl std::fmt::Debug for Graph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Graph({} nodes)", self.nodes.count())
    }
}

/// Units of [`meter`] for making or finding a node, and for passing one.
const INTERNING: u64 = 30;
const REACHING: u64 = 3;

/// A poisoned lock only means that another thread stopped between two consistent states.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Graph {
        Graph {
            nodes: boxcar::Vec::new(),
            shards: std::array::from_fn(|_| Mutex::new(HashTable::new())),
            symbols: boxcar::Vec::new(),
            symbol_table: Mutex::new(HashTable::new()),
            units: [const { OnceLock::new() }; 2],
            simplified: Mutex::default(),
        }
    }

    pub(crate) fn known_simplified(&self, e: Expr, options: &simplify::Options) -> Option<Expr> {
        lock(&self.simplified).get(&(e, options.clone())).copied()
    }

    pub(crate) fn keep_simplified(&self, e: Expr, options: &simplify::Options, simple: Expr) {
        lock(&self.simplified).insert((e, options.clone()), simple);
    }

    /// The number of distinct nodes stored.
    pub fn node_count(&self) -> usize {
        self.nodes.count()
    }

    /// The node behind a handle of this graph.
    pub fn node(&self, e: Expr) -> &Node {
        &self.nodes[e.0 as usize].node
    }

    /// What `decide` says of the node, asked once.
    pub(crate) fn primitive(&self, e: Expr, decide: impl FnOnce() -> bool) -> bool {
        *(self.nodes[e.0 as usize].primitive).get_or_init(decide)
    }

    /// The structural digest, which orders expressions independently of how and when they were built.
    pub fn digest(&self, e: Expr) -> u128 {
        self.nodes[e.0 as usize].digest
    }

    /// The canonical order of expressions; it depends on nothing but their structure.
    pub fn compare(&self, a: Expr, b: Expr) -> Ordering {
        if a == b {
            return Ordering::Equal;
        }
        self.digest(a).cmp(&self.digest(b)).then(a.cmp(&b))
    }

    /// Stores `node` as it is, or finds it. Callers guarantee canonical form.
    pub(crate) fn intern(&self, node: Node) -> Expr {
        // Before any lock is taken.
        meter::spend(INTERNING);
        let digest = digest::of_node(
            &node,
            |child| self.digest(child),
            |symbol| self.symbols[symbol.0 as usize].digest,
        );
        let hash = digest as u64;
        let shard = &self.shards[(digest >> 64) as usize % SHARDS];
        let mut table = lock(shard);
        let found = table.find(hash, |&id| self.nodes[id as usize].node == node);
        if let Some(&id) = found {
            return Expr(id);
        }
        let id = self.nodes.push(Stored {
            node,
            digest,
            primitive: OnceLock::new(),
        }) as u32;
        table.insert_unique(hash, id, |&id| self.nodes[id as usize].digest as u64);
        Expr(id)
    }

    /// The symbol `name` differentiated `order` times, as an expression.
    pub fn symbol(&self, name: &str, order: u32) -> Expr {
        let symbol = self.intern_symbol(name, order);
        self.intern(Node::Symbol(symbol))
    }

    /// The symbol handle of `name` differentiated `order` times.
    pub fn intern_symbol(&self, name: &str, order: u32) -> Symbol {
        let mut digest = digest::Digest::new(u64::from(order));
        digest.bytes(name.as_bytes());
        let digest = digest.finish();
        let hash = digest as u64;
        let mut table = lock(&self.symbol_table);
        let same = |&id: &u32| {
            let data = &self.symbols[id as usize];
            data.order == order && &*data.name == name
        };
        if let Some(&id) = table.find(hash, same) {
            return Symbol(id);
        }
        let data = SymbolData {
            name: name.into(),
            order,
            digest,
        };
        let id = self.symbols.push(data) as u32;
        table.insert_unique(hash, id, |&id| self.symbols[id as usize].digest as u64);
        Symbol(id)
    }

    /// The expression consisting of a symbol.
    pub fn symbol_expr(&self, symbol: Symbol) -> Expr {
        self.intern(Node::Symbol(symbol))
    }

    /// The name of a symbol, without primes.
    pub fn symbol_name(&self, symbol: Symbol) -> &str {
        &self.symbols[symbol.0 as usize].name
    }

    /// How often the symbol is differentiated.
    pub fn symbol_order(&self, symbol: Symbol) -> u32 {
        self.symbols[symbol.0 as usize].order
    }

    /// The symbol with primes, as in the text format: `x''`.
    pub fn symbol_text(&self, symbol: Symbol) -> String {
        let mut text = self.symbol_name(symbol).to_string();
        text.extend(std::iter::repeat_n(
            '\'',
            self.symbol_order(symbol) as usize,
        ));
        text
    }

    /// The symbol if the expression is one.
    pub fn as_symbol(&self, e: Expr) -> Option<Symbol> {
        match self.node(e) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        }
    }

    /// The number if the expression is one.
    pub fn as_number(&self, e: Expr) -> Option<&Rational> {
        match self.node(e) {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Whether the expression is the number zero, structurally.
    pub fn is_zero(&self, e: Expr) -> bool {
        self.as_number(e).is_some_and(Rational::is_zero)
    }

    /// Whether the expression is the number one, structurally.
    pub fn is_one(&self, e: Expr) -> bool {
        self.as_number(e).is_some_and(Rational::is_one)
    }

    /// A number.
    pub fn number(&self, value: Rational) -> Expr {
        self.intern(Node::Number(value))
    }

    /// An integer.
    pub fn integer(&self, value: i64) -> Expr {
        self.number(rational::integer(value))
    }

    /// The number 0.
    pub fn zero(&self) -> Expr {
        *self.units[0].get_or_init(|| self.integer(0))
    }

    /// The number 1.
    pub fn one(&self) -> Expr {
        *self.units[1].get_or_init(|| self.integer(1))
    }

    /// The constant π.
    pub fn pi(&self) -> Expr {
        self.intern(Node::Pi)
    }

    /// A real algebraic integer.
    pub fn algebraic(&self, number: AlgebraicInteger) -> Expr {
        self.intern(Node::Algebraic(Box::new(number)))
    }

    /// All nodes below and including `roots`, ascending: children before parents.
    ///
    /// Costs time in proportion to the nodes found, without recursion.
    pub fn reachable(&self, roots: &[Expr]) -> Vec<Expr> {
        // Children have smaller handles than their parents: one bit for each handle up to the largest root.
        let Some(largest) = roots.iter().max() else {
            return Vec::new();
        };
        let mut seen = vec![0_u64; largest.index() / 64 + 1];
        let mut is_new = |e: Expr| {
            let (word, bit) = (&mut seen[e.index() / 64], 1 << (e.index() % 64));
            let new = *word & bit == 0;
            *word |= bit;
            new
        };
        let mut stack: Vec<Expr> = roots.iter().copied().filter(|&e| is_new(e)).collect();
        let mut found = Vec::new();
        while let Some(e) = stack.pop() {
            found.push(e);
            self.node(e).for_each_child(|child| {
                if is_new(child) {
                    stack.push(child);
                }
            });
        }
        found.sort_unstable();
        meter::spend(REACHING * found.len() as u64 + seen.len() as u64 / 8);
        found
    }

    /// The symbols occurring in `roots`, ordered by name and order of differentiation.
    pub fn symbols_in(&self, roots: &[Expr]) -> Vec<Symbol> {
        let mut symbols: Vec<Symbol> = self
            .reachable(roots)
            .into_iter()
            .filter_map(|e| self.as_symbol(e))
            .collect();
        symbols.sort_by(|&a, &b| {
            (self.symbol_name(a), self.symbol_order(a))
                .cmp(&(self.symbol_name(b), self.symbol_order(b)))
        });
        symbols
    }

    /// Whether an algebraic number without a closed form occurs in `e`.
    pub fn holds_algebraic(&self, e: Expr) -> bool {
        let mut parts = self.reachable(&[e]).into_iter();
        parts.any(|part| matches!(self.node(part), Node::Algebraic(_)))
    }

    /// Whether any of `symbols` occurs in `e`.
    pub fn contains_any(&self, e: Expr, symbols: &[Symbol]) -> bool {
        self.reachable(&[e])
            .into_iter()
            .any(|n| self.as_symbol(n).is_some_and(|s| symbols.contains(&s)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_structure_is_one_node() {
        let g = Graph::new();
        assert_eq!(g.symbol("x", 1), g.symbol("x", 1));
        assert_ne!(g.symbol("x", 1), g.symbol("x", 0));
        assert_eq!(g.symbol_text(g.intern_symbol("x", 2)), "x''");
    }

    #[test]
    fn order_does_not_depend_on_history() {
        let (g, h) = (Graph::new(), Graph::new());
        let (gx, gy) = (g.symbol("x", 0), g.symbol("y", 0));
        let (hy, hx) = (h.symbol("y", 0), h.symbol("x", 0));
        assert_eq!(g.compare(gx, gy), h.compare(hx, hy));
        assert_eq!(g.digest(g.add(&[gx, gy])), h.digest(h.add(&[hy, hx])));
    }

    #[test]
    fn threads_share_a_graph() {
        let g = Graph::new();
        let sums: Vec<Expr> = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..4)
                .map(|_| {
                    scope.spawn(|| {
                        let mut e = g.zero();
                        for i in 0..500 {
                            let x = g.symbol(&format!("x_{i}"), 0);
                            e = g.add(&[e, g.powi(x, 2)]);
                        }
                        e
                    })
                })
                .collect();
            workers.into_iter().map(|w| w.join().unwrap()).collect()
        });
        assert!(sums.windows(2).all(|pair| pair[0] == pair[1]));
    }
}
