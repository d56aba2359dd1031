//! Names of quantities that no model states: each carries its definition into every question that is asked later.

use crate::characteristics::Manifold;
use crate::equations::unused_name;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};
use std::borrow::Cow;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Symbols with their definitions; systems that were made of one another share them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names(Arc<Mutex<Vec<(Symbol, Expr)>>>);

impl Names {
    fn lock(&self) -> MutexGuard<'_, Vec<(Symbol, Expr)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl System {
    /// The symbol of a quantity with this definition: `wanted`, with underscores behind it where the name is used, or stands for another
    /// quantity already.
    pub fn named(&self, wanted: &str, definition: Expr) -> Symbol {
        let g = &self.graph;
        let mut known = self.names.lock();
        let mut wanted = wanted.to_owned();
        loop {
            let symbol = g.intern_symbol(&unused_name(self, &wanted), 0);
            match known.iter().find(|(own, _)| *own == symbol) {
                Some(&(_, own)) if own == definition => return symbol,
                Some(_) => wanted = format!("{}_", g.symbol_name(symbol)),
                None => {
                    known.push((symbol, definition));
                    return symbol;
                }
            }
        }
    }

    /// An expression in which definitions stand for the quantities that the model does not name.
    pub fn defined(&self, e: Expr) -> Expr {
        let g = &self.graph;
        let known = self.names.lock();
        let pairs = known.iter().map(|&(s, own)| (g.symbol_expr(s), own));
        let pairs: Vec<(Expr, Expr)> = pairs.collect();
        if pairs.is_empty() {
            e
        } else {
            g.substitute(e, &pairs)
        }
    }

    /// The manifold with the definitions of named quantities that occur beside what defines them: where a quantity stands for itself, as
    /// in the state of a flow, it is as free as what it is defined by.
    pub(crate) fn with_names<'m>(&self, es: &[Expr], manifold: &'m Manifold) -> Cow<'m, Manifold> {
        let known = self.names.lock();
        if known.is_empty() {
            return Cow::Borrowed(manifold);
        }
        let g = &self.graph;
        let occurring = g.symbols_in(es);
        let beside = g.symbols_in(&[es, &manifold.expressions()[..]].concat());
        let moves = |s: &Symbol| g.symbol_order(*s) > 0 && beside.contains(s);
        let meets = |&&(symbol, definition): &&(Symbol, Expr)| {
            let is_solved = manifold.solved.iter().any(|(own, _)| *own == symbol);
            let own = g.symbols_in(&[definition]);
            occurring.contains(&symbol) && !is_solved && own.iter().any(moves)
        };
        let own: Vec<(Symbol, Expr)> = known.iter().filter(meets).copied().collect();
        if own.is_empty() {
            return Cow::Borrowed(manifold);
        }
        let mut manifold = manifold.clone();
        manifold.solved.extend(own);
        Cow::Owned(manifold)
    }

    /// The definitions of named quantities, each as a function that vanishes.
    pub(crate) fn definitions_of_names(&self) -> Vec<(Symbol, Expr)> {
        let g = &self.graph;
        let known = self.names.lock();
        let vanishing = known.iter().map(|&(s, e)| (s, g.sub(g.symbol_expr(s), e)));
        vanishing.collect()
    }
}
