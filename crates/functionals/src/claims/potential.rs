//! Currents of which an expression is the divergence, whatever the fields are.
//!
//! An expression S without Euler expressions changes by δS = D_i W_i(δu), so that along t u, from t = 0 to t = 1, it is
//! `S(u) − S(0) = D_i ∫ W_i(u)/t dt` (the homotopy formula): of a part of W that is homogeneous of the degree k in the fields the integral is that part
//! divided by k.

use crate::polynomial::Polynomial;
use crate::space::Space;
use crate::variation::flux;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::Expr;

/// Higher degrees in the fields are not looked for.
const HIGHEST: i64 = 12;

/// A vector with this divergence, one component for each independent variable, where the expression is a polynomial in some components and their
/// derivatives: proved by the zero test.
pub(super) fn with_divergence(space: &Space, e: Expr, components: &[usize]) -> Option<Vec<Expr>> {
    let g = &space.graph;
    let e = space.explicit(e);
    let forms = flux(space, e, components).ok()?;
    let along_fields = forms.iter().map(|form| {
        let terms = form
            .iter()
            .map(|(jet, &value)| g.mul(&[value, space.jet(jet.component, &jet.by)]));
        by_degrees(space, g.add(&terms.collect::<Vec<_>>()), components)
    });
    let mut found: Vec<Expr> = along_fields.collect::<Option<_>>()?;
    let rest = Polynomial::of(space, at_rest(space, e, components))?;
    if let Some(first) = found.first_mut() {
        *first = g.add(&[*first, rest.primitive(0).expr(space)]);
    }
    let divergence = found.iter().enumerate();
    let divergence: Vec<Expr> = divergence.map(|(i, &own)| space.total(own, i)).collect();
    let difference = g.sub(g.add(&divergence), e);
    let short = |e: Expr| simplify(g, e, &Options::default());
    space
        .vanish(&[difference])
        .then(|| found.into_iter().map(short).collect())
}

/// An expression without the components and their derivatives.
fn at_rest(space: &Space, e: Expr, components: &[usize]) -> Expr {
    scaled(space, e, components, space.graph.zero())
}

fn scaled(space: &Space, e: Expr, components: &[usize], factor: Expr) -> Expr {
    let g = &space.graph;
    space.replace(e, &|symbol| {
        let jet = space.as_jet(symbol)?;
        let is_own = components.contains(&jet.component);
        is_own.then(|| g.mul(&[factor, g.symbol_expr(symbol)]))
    })
}

/// The sum of the parts of an expression by their degree in some components and derivatives, each divided by it: its Taylor series along t u; `None` where
/// that does not end.
fn by_degrees(space: &Space, e: Expr, components: &[usize]) -> Option<Expr> {
    let g = &space.graph;
    // No name in a model has a blank.
    let scale = g.symbol("a scale", 0);
    let by_scale = |e: Expr| space.derive(e, &|s| (g.as_symbol(scale) == Some(s)).then(|| g.one()));
    let mut parts = Vec::new();
    let mut slope = by_scale(scaled(space, e, components, scale));
    let mut factorial = 1;
    for degree in 1..=HIGHEST {
        if g.is_zero(slope) || space.vanish(&[slope]) {
            return Some(g.add(&parts));
        }
        factorial *= degree;
        let at_zero = g.substitute(slope, &[(scale, g.zero())]);
        parts.push(g.div(at_zero, g.integer(factorial * degree)));
        slope = by_scale(slope);
    }
    None
}
