//! Parameters that are free, and those that follow from them: functions of a model have the free ones as arguments, and compute the others.

use crate::sweep::recipe;
use chetaev_model::Model;
use chetaev_symbolic::{Expr, Symbol};

/// The parameters that are defined by others, each with what it is in terms of free ones alone, as `J` in `J = "m l^2"`.
pub fn following(model: &Model) -> Vec<(Expr, Expr)> {
    let g = &*model.graph;
    let all = model.parameters.iter();
    let free = all.filter(|p| {
        p.definition
            .is_none_or(|own| g.symbols_in(&[own]).is_empty())
    });
    let mut known_to_move: Vec<Symbol> = free.filter_map(|p| g.as_symbol(p.symbol)).collect();
    let mut found: Vec<(Expr, Expr)> = Vec::new();
    for at in recipe::following(model, &mut known_to_move) {
        let own = &model.parameters[at];
        if let Some(definition) = own.definition {
            let in_free_ones = g.substitute(definition, &found);
            found.push((own.symbol, in_free_ones));
        }
    }
    found
}
