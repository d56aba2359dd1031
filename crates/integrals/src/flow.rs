//! A motion as a vector field: variables with their rates.

use crate::motion::Motion;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Graph, Symbol};
use thiserror::Error;

/// A variable of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Variable {
    /// The variable.
    pub symbol: Symbol,
    /// Its rate, in variables and constants.
    pub rate: Expr,
}

/// The vector field `X = Σ rate ∂/∂variable`; every other symbol is a constant.
#[derive(Clone, Debug)]
pub struct Flow<'g> {
    /// Where the expressions live.
    pub graph: &'g Graph,
    /// The variables, each once.
    pub variables: Vec<Variable>,
}

/// Why a system has no flow in independent variables.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NoFlow {
    /// The characteristics of the velocities are not known.
    #[error("the independent velocities are not known: {0}")]
    Velocities(String),
    /// Velocities that the constraints determine only implicitly.
    #[error("the constraints determine velocities only implicitly")]
    Implicit,
    /// Controls, or functions with a rate that the model prescribes.
    #[error("the rates contain functions whose rates the model prescribes")]
    Prescribed,
}

impl<'g> Flow<'g> {
    /// The motion on the constraint manifold: the time, the coordinates, the independent (quasi-)velocities and the masses with a law
    /// of their own.
    ///
    /// # Errors
    /// [`NoFlow`].
    pub fn of(cx: &Context<'g>, motion: &Motion<'_>) -> Result<Flow<'g>, NoFlow> {
        let (system, g) = (cx.system, &cx.system.graph);
        let chart = basis(cx)
            .characteristics()
            .map_err(|problem| NoFlow::Velocities(problem.to_string()))?;
        if chart.implicit().next().is_some() {
            return Err(NoFlow::Implicit);
        }
        let definitions: Vec<Expr> = chart.parameters.iter().map(|p| p.definition).collect();
        let rates = chart.restrict(system, &motion.derivatives(&definitions));
        let coordinates = system.coordinate_symbols().into_iter();
        let time = g.as_symbol(g.symbol("t", 0)).map(|t| (t, g.one()));
        let pairs = coordinates
            .zip(chart.velocities.iter().copied())
            .chain(chart.parameters.iter().map(|p| p.symbol).zip(rates))
            .chain(system.mass_rates(&chart.velocities))
            .chain(time);
        let variables = pairs.map(|(symbol, rate)| Variable { symbol, rate });
        let flow = Flow {
            graph: g,
            variables: variables.collect(),
        };
        let rates: Vec<Expr> = flow.variables.iter().map(|v| v.rate).collect();
        let mut occurring = g.symbols_in(&rates).into_iter();
        if occurring.any(|s| !flow.moves(s) && system.prescribed_rate(s).is_some()) {
            Err(NoFlow::Prescribed)
        } else {
            Ok(flow)
        }
    }

    /// Whether a symbol is a variable.
    pub fn moves(&self, symbol: Symbol) -> bool {
        self.variables.iter().any(|v| v.symbol == symbol)
    }

    /// Whether an expression contains a variable.
    pub fn contains_variable(&self, e: Expr) -> bool {
        !self.graph.is_free_of(e, &|s| self.moves(s))
    }

    /// X of functions of the variables.
    pub fn derivatives(&self, functions: &[Expr]) -> Vec<Expr> {
        self.graph.derive(functions, &|s| {
            let own = self.variables.iter().find(|v| v.symbol == s);
            own.map(|v| v.rate)
        })
    }

    /// `div X = Σ ∂rate/∂variable`.
    pub fn divergence(&self) -> Expr {
        let g = self.graph;
        let parts = self.variables.iter().map(|v| g.diff(v.rate, v.symbol));
        g.add(&parts.collect::<Vec<Expr>>())
    }

    /// Sets of variables whose rates contain no others, each as places in [`variables`](Flow::variables): what each variable depends
    /// on, small sets first, then all together. A function of such a set is an integral of the whole where it is one of the set.
    pub fn closed_parts(&self) -> Vec<Vec<usize>> {
        let symbols = |i: usize| self.graph.symbols_in(&[self.variables[i].rate]);
        let closure = |first: usize| {
            let mut part = vec![first];
            let mut next = 0;
            while next < part.len() {
                let own = symbols(part[next]).into_iter();
                for s in own {
                    let place = self.variables.iter().position(|v| v.symbol == s);
                    if let Some(place) = place.filter(|i| !part.contains(i)) {
                        part.push(place);
                    }
                }
                next += 1;
            }
            part.sort_unstable();
            part
        };
        let mut parts: Vec<Vec<usize>> = (0..self.variables.len()).map(closure).collect();
        parts.push((0..self.variables.len()).collect());
        parts.sort_by_key(|part| (part.len(), part.clone()));
        parts.dedup();
        parts
    }

    /// The field on some of the variables, a set of [`closed_parts`](Flow::closed_parts).
    #[must_use]
    pub fn on(&self, part: &[usize]) -> Flow<'g> {
        Flow {
            graph: self.graph,
            variables: part.iter().map(|&i| self.variables[i]).collect(),
        }
    }
}
