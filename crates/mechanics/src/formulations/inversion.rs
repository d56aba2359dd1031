//! Velocities as closed functions of momenta.
//!
//! Two kinds of Lagrangians are inverted: those quadratic in the velocities, `v = W⁻¹ (p − L₁)`, and `L = F(u) + b·v` with
//! `u = v·G v`. For these `p − b = μ(u) G v`, so that u solves the scalar equation
//! `u μ(u)² = π` with `π = (p − b)·G⁻¹(p − b)`, and `v = G⁻¹(p − b)/μ`, `H = π/μ − F` (T1 §9.1: collect and make explicit).
//! The equation is solved where it is linear in u over a common denominator, as that of the relativistic particle is.

use crate::equations::unused_name;
use crate::linear::dot;
use crate::radicals::split_roots;
use crate::sample::radicands;
use crate::system::System;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::polynomial::normal_form::normal_form;
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// A Lagrangian, its derivatives by velocities, and the names of the momenta.
pub(crate) struct Transform<'a> {
    /// L, or L̄.
    pub(crate) lagrangian: Expr,
    /// v.
    pub(crate) velocities: &'a [Expr],
    /// `∂L/∂v`.
    pub(crate) definitions: &'a [Expr],
    /// `∂²L/∂v∂v`, row by row.
    pub(crate) hessian: &'a [Expr],
    /// p.
    pub(crate) momenta: &'a [Expr],
}

/// What a closed Legendre transform gives, as functions of (q, p, t).
pub(crate) struct Inverse {
    /// H.
    pub(crate) hamiltonian: Expr,
    /// `∂H/∂p`.
    pub(crate) velocities: Vec<Expr>,
}

/// Forms of more nodes than this are not looked at: no person would read their inverse.
const LARGEST: usize = 400;

impl Transform<'_> {
    /// The closed transform; `None` where none was found.
    ///
    /// # Errors
    /// [`SolveError`] where the Hessian of a quadratic Lagrangian is singular by its form.
    pub(crate) fn closed(&self, system: &System) -> Result<Option<Inverse>, SolveError> {
        let g = &system.graph;
        let symbols = self.symbols(g);
        if !g.any_contains_any(self.hessian, &symbols) {
            return self.quadratic(g).map(Some);
        }
        let size = g.reachable(self.definitions).len();
        Ok(match size <= LARGEST {
            true => self.radial(system),
            false => None,
        })
    }

    fn symbols(&self, g: &Graph) -> Vec<Symbol> {
        let symbols = self.velocities.iter();
        symbols.filter_map(|&v| g.as_symbol(v)).collect()
    }

    fn at_rest(&self, g: &Graph, es: &[Expr]) -> Vec<Expr> {
        let pairs: Vec<(Expr, Expr)> = self.velocities.iter().map(|&v| (v, g.zero())).collect();
        g.substitute_all(es, &pairs)
    }

    /// `H = ½ (p − L₁)·W⁻¹(p − L₁) − L₀`.
    fn quadratic(&self, g: &Graph) -> Result<Inverse, SolveError> {
        let kinetic = self.less_at_rest(g, self.momenta);
        let half = g.div(g.one(), g.integer(2));
        let mut parts = vec![g.neg(self.at_rest(g, &[self.lagrangian])[0])];
        for (&p, v) in kinetic.iter().zip(g.solve(self.hessian, &kinetic)?) {
            parts.push(g.mul(&[half, p, v]));
        }
        let hamiltonian = g.add(&parts);
        Ok(Inverse {
            velocities: g.gradient(hamiltonian, &self.momentum_symbols(g)),
            hamiltonian,
        })
    }

    fn momentum_symbols(&self, g: &Graph) -> Vec<Symbol> {
        let momenta = self.momenta.iter();
        momenta.filter_map(|&p| g.as_symbol(p)).collect()
    }

    /// Covectors less `b = ∂L/∂v` at v = 0.
    fn less_at_rest(&self, g: &Graph, es: &[Expr]) -> Vec<Expr> {
        let rest = self.at_rest(g, self.definitions);
        es.iter().zip(rest).map(|(&e, b)| g.sub(e, b)).collect()
    }

    fn radial(&self, system: &System) -> Option<Inverse> {
        let g = &system.graph;
        let kinetic = self.less_at_rest(g, self.definitions);
        if g.reachable(&kinetic).iter().any(|&e| is_pole(g, e)) {
            return None;
        }
        let mut forms = self.forms(system).into_iter();
        let form = forms.find(|form| self.is_radial(g, &kinetic, form))?;
        let scalar = Scalar::new(system, self, &kinetic, form.axis)?;
        let kinetic = self.less_at_rest(g, self.momenta);
        let directions = g.solve(&form.entries, &kinetic).ok()?;
        let square = dot(g, &kinetic, &directions);
        let at = [(scalar.square, square)];
        let hamiltonian = g.substitute(scalar.hamiltonian, &at);
        Some(Inverse {
            velocities: g.gradient(hamiltonian, &self.momentum_symbols(g)),
            hamiltonian,
        })
    }

    /// Quadratic forms of which L may be a function: that of L itself at small velocities, and those in its roots.
    fn forms(&self, system: &System) -> Vec<Form> {
        let g = &system.graph;
        let symbols = self.symbols(g);
        let mut forms = vec![self.at_rest(g, self.hessian)];
        for radicand in radicands(g, &[self.lagrangian]) {
            let slopes = g.gradient(radicand, &symbols);
            forms.push(g.jacobian(&slopes, &symbols).concat());
        }
        let is_usable = |form: &Vec<Expr>| {
            !g.any_contains_any(form, &symbols) && !g.reachable(form).iter().any(|&e| is_pole(g, e))
        };
        forms.retain(is_usable);
        let scaled = forms.iter();
        scaled.filter_map(|form| Form::new(system, form)).collect()
    }

    /// Whether `p − b` is parallel to `G v`, by exact arithmetic.
    fn is_radial(&self, g: &Graph, kinetic: &[Expr], form: &Form) -> bool {
        let rows: Vec<Expr> = form
            .entries
            .chunks(self.velocities.len())
            .map(|row| dot(g, row, self.velocities))
            .collect();
        let axis = form.axis;
        (0..rows.len()).filter(|&s| s != axis).all(|s| {
            let left = g.mul(&[kinetic[s], rows[axis]]);
            let right = g.mul(&[kinetic[axis], rows[s]]);
            let difference = normal_form(g, g.sub(left, right), &Budget::DISPLAY);
            difference.is_ok_and(|form| form.is_zero())
        })
    }
}

/// A quadratic form G with `G_aa = 1` for one axis a.
struct Form {
    axis: usize,
    /// Row by row.
    entries: Vec<Expr>,
}

impl Form {
    /// Divided by an entry of its diagonal, one that does not move if there is one; `None` where all of them vanish.
    fn new(system: &System, entries: &[Expr]) -> Option<Form> {
        let g = &system.graph;
        let size = (1..).find(|k| k * k >= entries.len())?;
        let moves = |s: Symbol| system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
        let mut axes: Vec<usize> = (0..size)
            .filter(|&s| !g.is_zero(entries[s * (size + 1)]))
            .collect();
        axes.sort_by_key(|&s| !g.is_free_of(entries[s * (size + 1)], &moves));
        let &axis = axes.first()?;
        let scale = entries[axis * (size + 1)];
        let scaled = entries.iter();
        Some(Form {
            axis,
            entries: scaled
                .map(|&e| simplify(g, g.div(e, scale), &Options::default()))
                .collect(),
        })
    }
}

/// A negative power of zero, or a root of it that was differentiated.
fn is_pole(g: &Graph, e: Expr) -> bool {
    matches!(g.node(e), Node::Power { base, .. } if g.is_zero(*base))
}

/// The scalar problem `u μ(u)² = π`, solved.
struct Scalar {
    /// π as a symbol.
    square: Expr,
    /// H(π).
    hamiltonian: Expr,
}

impl Scalar {
    /// Along the axis a of the form, `G_aa = 1`: u = v_a², μ = (p − b)_a/v_a and F = L − b_a v_a.
    fn new(
        system: &System,
        transform: &Transform<'_>,
        kinetic: &[Expr],
        axis: usize,
    ) -> Option<Scalar> {
        let g = &system.graph;
        let unknown = g.symbol(&unused_name(system, "u_"), 0);
        let square = g.symbol(&unused_name(system, "w_"), 0);
        let velocity = transform.velocities[axis];
        let shear = g.sub(transform.definitions[axis], kinetic[axis]);
        let rest = g.sub(transform.lagrangian, g.mul(&[shear, velocity]));
        let others = transform.velocities.iter().filter(|&&v| v != velocity);
        let others: Vec<(Expr, Expr)> = others.map(|&v| (v, g.zero())).collect();
        let on_axis = g.substitute_all(&[kinetic[axis], rest], &others);
        let factor = simplify(g, g.div(on_axis[0], velocity), &Options::default());
        let root = g.sqrt(unknown);
        let of_u = g.substitute_all(&[factor, on_axis[1]], &[(velocity, root)]);
        if g.reachable(&of_u).contains(&root) {
            return None;
        }
        let solution = solve(g, of_u[0], unknown, square)?;
        let at = g.substitute_all(&of_u, &[(unknown, solution)]);
        let at = split_roots(system, &at);
        let hamiltonian = g.sub(g.div(square, at[0]), at[1]);
        let hamiltonian = simplify(g, hamiltonian, &Options::default());
        Some(Scalar {
            square,
            hamiltonian,
        })
    }
}

/// u from `u μ(u)² = π`, where that is linear in u over a common denominator.
fn solve(g: &Graph, factor: Expr, unknown: Expr, square: Expr) -> Option<Expr> {
    let symbol = g.as_symbol(unknown)?;
    let left = factored(g, g.mul(&[unknown, factor, factor]))?;
    let side = |above: bool| {
        let own = left.factors.iter().filter(|(_, n)| (*n > 0) == above);
        let powers: Vec<Expr> = own.map(|&(f, n)| g.powi(f, n.abs())).collect();
        g.mul(&powers)
    };
    let above = g.scale(&left.coefficient, side(true));
    let equation = g.sub(above, g.mul(&[square, side(false)]));
    let slope = g.gradient(equation, &[symbol])[0];
    if g.contains_any(slope, &[symbol]) {
        // Of higher degree: which of its roots is the one in question is not known.
        return None;
    }
    let rest = g.substitute(equation, &[(unknown, g.zero())]);
    Some(g.neg(g.div(rest, slope)))
}
