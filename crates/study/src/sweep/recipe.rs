//! What the parameters and data of one trajectory are made of, worked out exactly for its values.
//!
//! A value that varies stands for the shortest decimal that reads as it, as if it were written in the model file: with it,
//! what the model makes of it by formulas is exact before it is rounded, and a trajectory has the bits of a single run. The
//! formulas are worked out on a graph that lives as long as one trajectory, so that memory does not grow with the sweep.

use super::together::Variations;
use super::vary::{decimal, Target};
use chetaev_model::model::Model;
use chetaev_symbolic::{Expr, Graph, Node, Symbol};
use std::collections::BTreeMap;

/// Formulas of parameters.
#[derive(Debug)]
pub(crate) struct Recipe {
    /// The formulas alone.
    graph: Graph,
    /// Parameters that vary: their symbols, with the place of the value and the unit it is given in.
    varied: Vec<(Expr, usize, usize, Expr)>,
    /// Parameters that follow from those: their symbols, numbers and definitions, each after those that it uses.
    following: Vec<(Expr, usize, Expr)>,
    /// Symbols and values of all others.
    others: Vec<(Expr, Expr)>,
    /// Values of all parameters where nothing varies; NaN where there is none.
    base: Vec<f64>,
    /// What is made of parameters that vary, by place in the list asked for.
    targets: Vec<(usize, Expr)>,
}

/// The numbers of one trajectory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers {
    /// Values of all parameters.
    pub(crate) parameters: Vec<f64>,
    /// Values of the targets, by place; those that do not vary are left out.
    pub(crate) targets: Vec<(usize, Option<f64>)>,
}

impl Recipe {
    /// The recipe of `targets`, expressions of parameters of the model; `None` where they contain what is no formula.
    pub(crate) fn new(model: &Model, variations: &Variations, targets: &[Expr]) -> Option<Recipe> {
        let g = &*model.graph;
        let numbers = |at: usize| {
            variations
                .list()
                .iter()
                .position(|v| v.target == Target::Parameter(at))
        };
        let mut moving: Vec<Symbol> = Vec::new();
        let symbol = |at: usize| g.as_symbol(model.parameters[at].symbol);
        let varied: Vec<(usize, usize)> = (0..model.parameters.len())
            .filter_map(|at| Some((at, numbers(at)?)))
            .collect();
        moving.extend(varied.iter().filter_map(|&(at, _)| symbol(at)));
        let following = following(model, &mut moving);
        let own = Graph::new();
        let mut copied = BTreeMap::new();
        let mut copy = |e: Expr| copy(g, e, &own, &mut copied);
        let varied: Option<Vec<_>> = varied
            .into_iter()
            .map(|(at, value)| {
                let unit = model.parameters[at].unit.as_ref();
                let scale = unit.map_or_else(|| own.one(), |unit| unit_of(&own, unit));
                Some((copy(model.parameters[at].symbol)?, at, value, scale))
            })
            .collect();
        let following: Option<Vec<_>> = following
            .into_iter()
            .map(|at| {
                let parameter = &model.parameters[at];
                Some((copy(parameter.symbol)?, at, copy(parameter.definition?)?))
            })
            .collect();
        let (varied, following) = (varied?, following?);
        let is_other = |at: &usize| {
            !varied.iter().any(|v| v.1 == *at) && !following.iter().any(|f| f.1 == *at)
        };
        let others: Option<Vec<_>> = (0..model.parameters.len())
            .filter(is_other)
            .filter_map(|at| Some((model.parameters[at].symbol, model.parameters[at].value?)))
            .map(|(symbol, value)| Some((copy(symbol)?, copy(value)?)))
            .collect();
        let targets: Option<Vec<_>> = targets
            .iter()
            .enumerate()
            .filter(|(_, &e)| g.contains_any(e, &moving))
            .map(|(place, &e)| Some((place, copy(e)?)))
            .collect();
        let value = |at: usize| {
            let values = g.evaluate_f64(&[model.parameters[at].value?], &|_| None);
            values.ok().map(|values| values[0])
        };
        Some(Recipe {
            base: (0..model.parameters.len())
                .map(|at| value(at).unwrap_or(f64::NAN))
                .collect(),
            varied,
            following,
            others: others?,
            targets: targets?,
            graph: own,
        })
    }

    /// Whether any parameter varies.
    pub(crate) fn has_parameters(&self) -> bool {
        !self.varied.is_empty()
    }

    /// The numbers of a trajectory with these values.
    ///
    /// # Errors
    /// The number of the parameter that has no finite value.
    pub(crate) fn numbers(&self, values: &[f64]) -> Result<Numbers, usize> {
        let mut parameters = self.base.clone();
        let own = Graph::new();
        let mut copied = BTreeMap::new();
        let mut copy =
            |e: Expr| copy(&self.graph, e, &own, &mut copied).unwrap_or_else(|| own.zero());
        let mut known: Vec<(Expr, Expr)> = Vec::new();
        for &(symbol, at, place, unit) in &self.varied {
            let number = own.number(decimal(values[place]).ok_or(at)?);
            let value = own.mul(&[number, copy(unit)]);
            parameters[at] = closed(&own, value).ok_or(at)?;
            known.push((copy(symbol), value));
        }
        if self.following.is_empty() && self.targets.is_empty() {
            let targets = Vec::new();
            return Ok(Numbers {
                parameters,
                targets,
            });
        }
        known.extend(self.others.iter().map(|&(s, v)| (copy(s), copy(v))));
        for &(symbol, at, definition) in &self.following {
            let value = own.substitute(copy(definition), &known);
            parameters[at] = closed(&own, value).ok_or(at)?;
            known.push((copy(symbol), value));
        }
        let target =
            |&(place, e): &(usize, Expr)| (place, closed(&own, own.substitute(copy(e), &known)));
        let targets = self.targets.iter().map(target).collect();
        Ok(Numbers {
            parameters,
            targets,
        })
    }
}

/// The finite value of an expression without symbols.
fn closed(g: &Graph, e: Expr) -> Option<f64> {
    let value = g.evaluate_f64(&[e], &|_| None).ok()?[0];
    value.is_finite().then_some(value)
}

/// What a number in a unit is multiplied by.
pub(crate) fn unit_of(g: &Graph, unit: &chetaev_model::units::Unit) -> Expr {
    let pi = g.pow(g.pi(), g.integer(i64::from(unit.pi)));
    g.mul(&[g.number(unit.factor.clone()), pi])
}

/// The parameters that are made of those that move, each after those that it uses; they move too.
pub(crate) fn following(model: &Model, moving: &mut Vec<Symbol>) -> Vec<usize> {
    let g = &*model.graph;
    let own: Vec<Symbol> = moving.clone();
    let mut found: Vec<usize> = Vec::new();
    let definition = |at: usize| {
        let symbol = g.as_symbol(model.parameters[at].symbol)?;
        (!own.contains(&symbol)).then_some((symbol, model.parameters[at].definition?))
    };
    // Which parameters follow, in any order; then in an order in which each stands behind those that it uses.
    let mut open: Vec<(usize, Symbol, Expr)> = Vec::new();
    let mut grows = true;
    while std::mem::take(&mut grows) {
        for at in 0..model.parameters.len() {
            let Some((symbol, value)) = definition(at) else {
                continue;
            };
            if !moving.contains(&symbol) && g.contains_any(value, moving) {
                moving.push(symbol);
                open.push((at, symbol, value));
                grows = true;
            }
        }
    }
    while !open.is_empty() {
        let waiting: Vec<Symbol> = open.iter().map(|o| o.1).collect();
        let ready = |o: &(usize, Symbol, Expr)| !g.contains_any(o.2, &waiting);
        let (now, later): (Vec<_>, Vec<_>) = open.into_iter().partition(ready);
        if now.is_empty() {
            break; // a circle, which the model refuses
        }
        found.extend(now.iter().map(|o| o.0));
        open = later;
    }
    found
}

/// The same expression on another graph; `None` for what is no formula.
fn copy(from: &Graph, e: Expr, to: &Graph, known: &mut BTreeMap<Expr, Expr>) -> Option<Expr> {
    if let Some(&copy) = known.get(&e) {
        return Some(copy);
    }
    for part in from.reachable(&[e]) {
        if known.contains_key(&part) {
            continue;
        }
        let of = |child: &Expr| known.get(child).copied();
        let all = |children: &[Expr]| children.iter().map(of).collect::<Option<Vec<Expr>>>();
        let copy = match from.node(part) {
            Node::Number(value) => to.number(value.clone()),
            Node::Pi => to.pi(),
            Node::Algebraic(own) => to.algebraic((**own).clone()),
            Node::Symbol(symbol) => {
                to.symbol(from.symbol_name(*symbol), from.symbol_order(*symbol))
            }
            Node::Sum { constant, terms } => {
                let constant = to.number(constant.clone());
                let terms = terms.iter().map(|(term, c)| Some(to.scale(c, of(term)?)));
                let terms: Option<Vec<Expr>> =
                    std::iter::once(Some(constant)).chain(terms).collect();
                to.add(&terms?)
            }
            Node::Product {
                coefficient,
                factors,
            } => to.scale(coefficient, to.mul(&all(factors)?)),
            Node::Power { base, exponent } => to.pow(of(base)?, of(exponent)?),
            Node::Apply {
                function,
                arguments,
            } => to.apply(*function, &all(arguments)?),
            Node::Matrix { .. } | Node::Solve { .. } | Node::Entry { .. } => return None,
        };
        known.insert(part, copy);
    }
    known.get(&e).copied()
}
