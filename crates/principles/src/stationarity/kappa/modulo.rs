//! Functions of states that constraints tie which stay implicit: polynomials in the dependent velocities, reduced modulo these.

use crate::stationarity::closed_form::short;
use crate::stationarity::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_symbolic::factors::{coefficients, factored};
use chetaev_symbolic::{Expr, Graph, Symbol};

/// Of a higher degree nothing is reduced.
const DEGREE: usize = 12;

/// `s^d = −Σ c_j s^j`: constraints as monic polynomials in their dependent velocities.
#[derive(Clone, Debug, Default)]
pub(super) struct Ties(Vec<(Symbol, Vec<Expr>)>);

impl Ties {
    /// Of the constraints that stay implicit those that are polynomials with a leading coefficient that does not move.
    pub(super) fn new(cx: &Context<'_>, motion: &Motion) -> Ties {
        let (system, g) = (cx.system, &cx.system.graph);
        let moving = motion.state();
        let velocity = |&f: &Expr| {
            let dependent = cx.selection.dependent.iter();
            let mut symbols = dependent.filter_map(|&d| Some(system.coordinates.get(d)?.v_symbol));
            symbols.find_map(|s| {
                let list = coefficients(g, f, s)?;
                let (&lead, rest) = list.split_last()?;
                let fits = !rest.is_empty() && rest.len() <= DEGREE;
                let monic = || rest.iter().map(|&c| g.div(c, lead)).collect();
                (fits && !g.contains_any(lead, &moving)).then(|| (s, monic()))
            })
        };
        Ties(motion.implicit.iter().filter_map(velocity).collect())
    }

    /// An equal function on the states, simplified: above and below the line of lower degree than the constraints.
    pub(super) fn reduced(&self, g: &Graph, e: Expr) -> Expr {
        self.0.iter().fold(short(g, e), |e, (symbol, monic)| {
            match g.contains_any(e, &[*symbol]) {
                true => quotient(g, e, (*symbol, monic)).unwrap_or(e),
                false => e,
            }
        })
    }
}

/// A quotient of polynomials in a symbol, both reduced; `None` where it is none.
fn quotient(g: &Graph, e: Expr, tie: (Symbol, &[Expr])) -> Option<Expr> {
    let parts = factored(g, e)?;
    let of = |sign: i64| -> Expr {
        let own = parts.factors.iter().filter(|(_, n)| n * sign > 0);
        let powers: Vec<Expr> = own.map(|&(f, n)| g.powi(f, n * sign)).collect();
        g.mul(&powers)
    };
    let above = g.scale(&parts.coefficient, polynomial(g, of(1), tie)?);
    Some(short(g, g.div(above, polynomial(g, of(-1), tie)?)))
}

/// The remainder of a polynomial in the division by a monic one.
fn polynomial(g: &Graph, e: Expr, (symbol, monic): (Symbol, &[Expr])) -> Option<Expr> {
    if !g.contains_any(e, &[symbol]) {
        return Some(e);
    }
    let mut list = coefficients(g, e, symbol)?;
    if list.len() > DEGREE + 1 {
        return None;
    }
    while list.len() > monic.len() {
        let lead = list.pop()?;
        let first = list.len() - monic.len();
        for (place, &c) in monic.iter().enumerate() {
            list[first + place] = g.sub(list[first + place], g.mul(&[lead, c]));
        }
    }
    let at = g.symbol_expr(symbol);
    let terms = (0_i64..)
        .zip(&list)
        .map(|(j, &c)| g.mul(&[c, g.powi(at, j)]));
    Some(g.add(&terms.collect::<Vec<Expr>>()))
}
