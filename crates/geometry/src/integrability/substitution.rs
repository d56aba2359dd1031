//! One form `dw = Σ a_i dx_i` integrated in another variable, or by a symmetry.
//!
//! It is linear in u = φ(w) where `φ' a_i = p_i u + q_i`: so is Bernoulli's equation in a power of w. Where functions η of the variables have
//! `X_i η = (∂a_i/∂w) η` for the fields `X_i = ∂_i + a_i ∂_w`, they are the symmetries of the form, and it has the integrating factor 1/η
//! (Lie 1874). For a field ξ they are `η = ξ^w - Σ a_i ξ^i`; fields are looked for whose components are linear functions of the variables,
//! which are linear equations for their coefficients. Homogeneous equations, with any weights, and functions of a linear combination have
//! such fields.

use super::primitive::tidy;
use super::quadrature::{Fields, Form, Quadrature, Variable};
use super::solved::solved;
use crate::noether::ansatz::Ansatz;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Function, Node, Symbol};

/// The most functions of w that are tried.
const FUNCTIONS: usize = 16;

/// The most unknown coefficients of a symmetry.
const UNKNOWN: usize = 40;

/// For larger equations, in nodes, there is no search.
const NODES: usize = 3000;

/// The most symmetries that are tried.
const SYMMETRIES: usize = 6;

impl Fields<'_> {
    /// `du = (p_i u + q_i) dx_i` for u = φ(w).
    pub(super) fn linear_in_function(
        &self,
        form: &Form,
        w: Symbol,
        value: Expr,
    ) -> Option<Quadrature> {
        let g = &self.system().graph;
        let u = g.symbol("part[w]", 0);
        let symbol = g.as_symbol(u)?;
        self.functions_of(form, w).into_iter().find_map(|phi| {
            let by = g.diff(phi, w);
            let slopes = form.slopes.iter().map(|&(x, a)| {
                let s = tidy(g, g.mul(&[by, a]));
                let p = tidy(g, g.div(g.diff(s, w), by));
                let q = tidy(g, g.sub(s, g.mul(&[p, phi])));
                let is_linear = !g.contains_any(p, &[w]) && !g.contains_any(q, &[w]);
                is_linear.then(|| (x, g.add(&[g.mul(&[p, u]), q])))
            });
            let linear = Form {
                of: form.of,
                slopes: slopes.collect::<Option<_>>()?,
            };
            let found = self.exact_or_linear(&linear, symbol, value)?;
            let function = g.substitute(found.functions[0], &[(u, phi)]);
            let own = found
                .solved
                .and_then(|own| solved(g, phi, w, own.values[0]));
            Some(Quadrature::one(form.of, function, value, own))
        })
    }

    /// Powers of w, and functions of it that occur.
    fn functions_of(&self, form: &Form, w: Symbol) -> Vec<Expr> {
        let g = &self.system().graph;
        let own = g.symbol_expr(w);
        let slopes: Vec<Expr> = form.slopes.iter().map(|&(_, a)| a).collect();
        let mut found: Vec<Expr> = [-1, 2, -2, 3, -3].map(|n| g.powi(own, n)).to_vec();
        for e in g.reachable(&slopes) {
            match g.node(e) {
                Node::Power { base, exponent } if *base == own => {
                    let rest = g.sub(g.one(), *exponent);
                    found.push(g.pow(own, rest));
                }
                Node::Apply {
                    function,
                    arguments,
                } if self.is_of_symbol(arguments, w) => {
                    let more: &[Function] = match function {
                        Function::Sin | Function::Cos | Function::Tan => {
                            &[Function::Sin, Function::Cos, Function::Tan]
                        }
                        _ => &[*function],
                    };
                    found.extend(more.iter().map(|&f| g.apply(f, arguments)));
                    found.push(g.powi(e, -1));
                }
                _ => {}
            }
        }
        let mut seen: Vec<Expr> = Vec::new();
        for e in found {
            if e != own && !g.is_one(e) && !seen.contains(&e) {
                seen.push(e);
            }
        }
        seen.truncate(FUNCTIONS);
        seen
    }

    /// Whether of what moves the symbol alone occurs in a function's arguments.
    fn is_of_symbol(&self, arguments: &[Expr], w: Symbol) -> bool {
        let g = &self.system().graph;
        let symbols = g.symbols_in(arguments);
        let moves = |s: Symbol| self.system().moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
        symbols.contains(&w) && symbols.iter().all(|&s| s == w || !moves(s))
    }

    /// `(dw - Σ a_i dx_i)/η` integrated for a symmetry η.
    pub(super) fn by_symmetry(&self, form: &Form, w: Symbol, value: Expr) -> Option<Quadrature> {
        let g = &self.system().graph;
        self.symmetries(form, w).into_iter().find_map(|eta| {
            let eta = tidy(g, eta);
            let over = |e: Expr| tidy(g, g.div(e, eta));
            let slopes = form.slopes.iter().map(|&(x, a)| (x, over(g.neg(a))));
            let own = (form.of, over(g.one()));
            let all: Vec<(Variable, Expr)> = [own].into_iter().chain(slopes).collect();
            let function = self.potential(&all)?;
            Some(self.as_solved(form.of, function, w, value))
        })
    }

    /// The symmetries of fields with linear components.
    fn symmetries(&self, form: &Form, w: Symbol) -> Vec<Expr> {
        let system = self.system();
        let g = &system.graph;
        let own = g.symbol_expr(w);
        let places = form.slopes.iter().map(|&(x, _)| x.expr(g));
        let linear: Vec<Expr> = [g.one(), own].into_iter().chain(places).collect();
        let mut basis = linear.clone();
        for &(_, a) in &form.slopes {
            basis.extend(linear.iter().map(|&e| g.mul(&[a, e])));
        }
        if basis.len() > UNKNOWN {
            return Vec::new();
        }
        let column = |&eta: &Expr| -> Vec<Expr> {
            let slopes = form.slopes.iter();
            let own = slopes.map(|&(x, a)| {
                let along = g.mul(&[a, g.diff(eta, w)]);
                let scaled = g.mul(&[g.diff(a, w), eta]);
                g.sub(g.add(&[self.derivative(eta, x), along]), scaled)
            });
            own.collect()
        };
        let columns: Vec<Vec<Expr>> = basis.iter().map(column).collect();
        if g.reachable(&columns.concat()).len() > NODES {
            return Vec::new();
        }
        let whole = Manifold::default();
        let ansatz = Ansatz::new(self.motion, &columns, &whole, &[], self.seed);
        let solutions = ansatz.ok().and_then(|own| own.up_to(SYMMETRIES));
        let combined = |solution: Vec<Expr>| {
            let parts = solution.iter().zip(&basis).map(|(&c, &e)| g.mul(&[c, e]));
            g.add(&parts.collect::<Vec<Expr>>())
        };
        let all = solutions.unwrap_or_default().into_iter().map(combined);
        all.filter(|&e| !g.is_zero(tidy(g, e))).collect()
    }
}
