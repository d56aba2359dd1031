//! Derivatives and formulas, each computed once: the same are asked for on every piece of the boundary and at each step of an elimination.

use super::Space;
use chetaev_symbolic::{Expr, Symbol};
use rustc_hash::FxHashMap;
use std::cell::{Cell, RefCell};

/// What is asked of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Asked {
    /// Its partial derivative by a jet.
    Partial(Expr, Symbol),
    /// Its total derivative by an independent variable.
    Total(Expr, usize),
    /// The expression with the formulas of functions.
    Explicit(Expr),
}

/// What is known of expressions, as long as nothing else is stated of functions.
#[derive(Debug, Default)]
pub(super) struct Cache {
    found: RefCell<FxHashMap<Asked, Expr>>,
    /// Questions about functions that are being decided: what is found meanwhile takes their functions for unknown.
    open: Cell<usize>,
}

impl Cache {
    /// Forgets everything, as more is stated of functions.
    pub(super) fn clear(&self) {
        self.found.borrow_mut().clear();
    }

    /// What `decide` finds while functions are taken for unknown.
    pub(super) fn while_open<T>(&self, decide: impl FnOnce() -> T) -> T {
        let _open = Opened::new(&self.open);
        decide()
    }
}

/// A question that is open until this is dropped, also where a budget ends it.
struct Opened<'c>(&'c Cell<usize>);

impl Opened<'_> {
    fn new(count: &Cell<usize>) -> Opened<'_> {
        count.set(count.get() + 1);
        Opened(count)
    }
}

impl Drop for Opened<'_> {
    fn drop(&mut self) {
        self.0.set(self.0.get().saturating_sub(1));
    }
}

impl Space {
    /// What `compute` finds, computed once.
    pub(super) fn once(&self, asked: Asked, compute: impl FnOnce() -> Expr) -> Expr {
        if self.cache.open.get() > 0 {
            return compute();
        }
        if let Some(&known) = self.cache.found.borrow().get(&asked) {
            return known;
        }
        let found = compute();
        self.cache.found.borrow_mut().insert(asked, found);
        found
    }
}
