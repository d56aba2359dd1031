//! Whether two stated functions are Legendre conjugates.
//!
//! A and B are when their gradients undo each other, both ways: `B'(A'(e)) = e` and `A'(B'(s)) = s`, with
//! `A(e) + B(A'(e)) = A'(e) e`. One way alone is too little: for A = (tr e)²/2 and B = (tr s)²/8 in the plane `A'(B'(A'(e))) = A'(e)`
//! holds, and the deviator of e is lost. From one way the other follows where the gradient inside is one-to-one: of
//! `A'(B'(A'(e))) = A'(e)` it then cancels (R. T. Rockafellar, Convex Analysis, 1970, § 26). The gradient of a function whose Hessian
//! is definite at every place of the whole space is one-to-one.

use crate::signs::enclosure;
use crate::smoothness::guards;
use crate::space::Space;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::assumptions::{is_implied, SignSet};
use chetaev_symbolic::{Expr, Node, Rational, Symbol, Verdict};
use std::cmp::Ordering;

impl Space {
    /// Whether a function and its conjugate are that by their formulas, decided once; `None` where it has no conjugate, or where one of
    /// the two has no formula, so that the relation is what is known of it.
    pub fn conjugation(&self, function: usize) -> Option<Verdict> {
        let other = self.function_at(function).conjugate?;
        let pair = (function.min(other), function.max(other));
        if let Some(name) = self.without_conjugate(pair) {
            return Some(Verdict::not_applicable(
                "functional.legendre",
                format!(
                    "the gradient of `{name}` is linear, and the determinant of its matrix is zero: it is not one-to-one, so that `{name}` has no conjugate"
                ),
            ));
        }
        self.decided_once(pair, &|| {
            let both = (self.undone(pair.0, pair.1), self.undone(pair.1, pair.0));
            match both {
                (Some(there), Some(back)) => Some(self.both_ways(pair, &there, &back)),
                _ => self.folded(pair.0).or_else(|| self.folded(pair.1)),
            }
        })
    }

    /// That a function has no conjugate since its gradient is not one-to-one: the determinant of its Hessian has both signs. By the
    /// invariance of domain (L. E. J. Brouwer, 1912) a continuous map of a connected open set of `R^n` into `R^n` that is one-to-one is of
    /// one degree everywhere, so that its determinant has no two signs. Where fields are confined by assumptions nothing is said.
    fn folded(&self, function: usize) -> Option<Verdict> {
        let g = &self.graph;
        let slots = self.slots(function);
        let value = self.body(function, &[], &slots)?;
        let assumed = self.assumptions();
        let mut all = assumed.list().iter();
        let confines_fields = all.any(|own| !self.jets_in(&[own.left, own.right]).is_empty());
        if confines_fields || !self.is_smooth_everywhere(value) {
            return None;
        }
        let hessian = self.hessian(function)?;
        let mut known: Vec<(Vec<Expr>, Expr)> = Vec::new();
        for point in probes(slots.len()) {
            let point: Vec<Expr> = point.into_iter().map(|own| g.number(own)).collect();
            let rows: Vec<Vec<Expr>> = hessian
                .iter()
                .map(|row| {
                    row.iter()
                        .map(|&e| self.at_arguments(function, e, &point))
                        .collect()
                })
                .collect();
            let here = determinant(g, &rows);
            let is_opposite = |there: Expr| {
                let product = g.mul(&[here, there]);
                let enclosed = enclosure(self, product).and_then(|own| own.sign());
                enclosed == Some(Ordering::Less) || self.sign(product) == SignSet::NEGATIVE
            };
            if let Some((other, _)) = known.iter().find(|(_, there)| is_opposite(*there)) {
                return Some(self.without_inverse(function, other, &point));
            }
            known.push((point, here));
        }
        None
    }

    fn without_inverse(&self, function: usize, one: &[Expr], other: &[Expr]) -> Verdict {
        let name = self.function_at(function).name;
        let shown = |point: &[Expr]| {
            let all: Vec<String> = point.iter().map(|&e| self.graph.text(e)).collect();
            match all.as_slice() {
                [single] => single.clone(),
                all => format!("({})", all.join(", ")),
            }
        };
        Verdict::not_applicable(
            "functional.legendre",
            format!(
                "the determinant of the Hessian of `{name}` has opposite signs at {} and {}: its gradient is not one-to-one, so that \
                 `{name}` has no conjugate for all arguments",
                shown(one),
                shown(other)
            ),
        )
    }

    /// The conjugate that undoes the gradient of a function: where that is assumed, or proved.
    pub fn undoing(&self, function: usize) -> Option<usize> {
        let other = self.function_at(function).conjugate?;
        match self.conjugation(function) {
            None | Some(Verdict::Proved(_)) => Some(other),
            Some(_) => None,
        }
    }

    /// States the conjugate of a function with a formula whose gradient is linear, where the conjugate has none:
    /// `B(s) = s x − A(x)` with the x at which `A'(x) = s`.
    pub fn state_conjugate(&self, function: usize) {
        let Some(other) = self.function_at(function).conjugate else {
            return;
        };
        if !self.is_known_alone(function) {
            return;
        }
        let Some(gradient) = self.inverse_of_linear(function) else {
            return;
        };
        match self.conjugate_value(function, &gradient) {
            Some(value) => self.state_body(other, value),
            None => self.state_gradient(other, gradient),
        }
    }

    /// The one of two functions whose gradient is linear and not one-to-one.
    fn without_conjugate(&self, pair: (usize, usize)) -> Option<String> {
        let is_singular = |function: usize| {
            let own = self.determinant_of(function);
            own.is_some_and(|e| self.vanish(&[e]))
        };
        let mut both = [pair.0, pair.1].into_iter();
        let own = both.find(|&function| is_singular(function))?;
        Some(self.function_at(own).name)
    }

    /// The x at which `A'(x) = s`, in the place-holders, where the gradient is linear.
    fn inverse_of_linear(&self, function: usize) -> Option<Vec<Expr>> {
        let gradient = self.formula_of_gradient(function)?;
        let (determinant, inverse) = self.inverse_of(function, &gradient)?;
        self.note_determinant(function, determinant);
        inverse
    }

    /// The determinant of a linear gradient, and where it does not vanish the argument at which the gradient is in the place-holders.
    fn inverse_of(&self, function: usize, gradient: &[Expr]) -> Option<(Expr, Option<Vec<Expr>>)> {
        let g = &self.graph;
        let slots = self.slots(function);
        let symbols: Vec<Symbol> = slots.iter().filter_map(|&s| g.as_symbol(s)).collect();
        let mut matrix = Vec::new();
        for &e in gradient {
            for &symbol in &symbols {
                let slope = self.derive(e, &|s| (s == symbol).then_some(g.one()));
                if g.contains_any(slope, &symbols) {
                    return None;
                }
                matrix.push(slope);
            }
        }
        let rows: Vec<Vec<Expr>> = matrix.chunks(slots.len()).map(<[Expr]>::to_vec).collect();
        let determinant = determinant(g, &rows);
        if self.vanish(&[determinant]) {
            return Some((determinant, None));
        }
        let at_zero: Vec<(Expr, Expr)> = slots.iter().map(|&s| (s, g.zero())).collect();
        let rest = g.substitute_all(gradient, &at_zero);
        // A sign is constant beside its jumps: that the gradient is linear is proved of the whole.
        let whole = matrix.chunks(slots.len()).zip(gradient).zip(&rest);
        let is_linear = whole.into_iter().all(|((row, &e), &rest)| {
            let linear = row.iter().zip(&slots).map(|(&a, &x)| g.mul(&[a, x]));
            let linear: Vec<Expr> = linear.chain([rest]).collect();
            self.vanish(&[g.sub(e, g.add(&linear))])
        });
        if !is_linear {
            return None;
        }
        // The place-holders stand for the argument of the conjugate now.
        let right: Vec<Expr> = slots.iter().zip(rest).map(|(&s, r)| g.sub(s, r)).collect();
        Some((determinant, g.solve(&matrix, &right).ok()))
    }

    /// The conjugate of a value in the place-holders of a function, in those of the conjugate, where its gradient is linear.
    pub(crate) fn conjugate_of_value(&self, function: usize, value: Expr) -> Option<Expr> {
        let gradient = self.gradient_of_value(function, value);
        let (_, inverse) = self.inverse_of(function, &gradient)?;
        let x = inverse?;
        let at = self.at_arguments(function, value, &x);
        Some(self.legendre(function, at, &x))
    }

    /// Whether values in the place-holders of two functions are conjugates of each other: `V'(W'(x)) = x`, and both add up to `W'(x) x`.
    pub(crate) fn are_conjugates(&self, (function, value): (usize, Expr), other: Expr) -> Verdict {
        let g = &self.graph;
        let slots = self.slots(function);
        let image = self.gradient_of_value(function, value);
        let back = self.gradient_of_value(function, other).into_iter();
        let back = back.map(|e| self.at_arguments(function, e, &image));
        let mut residuals: Vec<Expr> = back.zip(&slots).map(|(e, &x)| g.sub(e, x)).collect();
        let there = self.at_arguments(function, other, &image);
        let multiplicities = self.function_at(function).multiplicities;
        let mut terms = vec![value, there];
        for ((&x, &y), &m) in slots.iter().zip(&image).zip(&multiplicities) {
            terms.push(g.neg(g.mul(&[g.integer(m), x, y])));
        }
        residuals.push(g.add(&terms));
        self.vanishing(&residuals, true)
    }

    /// `s x − A(x)` where A has a value.
    fn conjugate_value(&self, function: usize, x: &[Expr]) -> Option<Expr> {
        Some(self.legendre(function, self.body(function, &[], x)?, x))
    }

    /// `s x − a`, with s in the place-holders.
    fn legendre(&self, function: usize, a: Expr, x: &[Expr]) -> Expr {
        let g = &self.graph;
        let multiplicities = self.function_at(function).multiplicities;
        let mut terms = vec![g.neg(a)];
        for ((&y, &x), &m) in self.slots(function).iter().zip(x).zip(&multiplicities) {
            terms.push(g.mul(&[g.integer(m), x, y]));
        }
        g.add(&terms)
    }

    /// `B'(A'(X)) − X` and `A(X) + B(A'(X)) − A'(X) X`, with A and B in this order.
    fn undone(&self, function: usize, by: usize) -> Option<Vec<Expr>> {
        let g = &self.graph;
        let slots = self.slots(function);
        let multiplicities = self.function_at(function).multiplicities;
        let gradient: Option<Vec<Expr>> = (0..slots.len())
            .map(|k| self.body(function, &[k], &slots))
            .collect();
        let gradient = gradient?;
        let mut residuals = Vec::new();
        for (k, &slot) in slots.iter().enumerate() {
            residuals.push(g.sub(self.body(by, &[k], &gradient)?, slot));
        }
        let mut terms = vec![
            self.body(function, &[], &slots)?,
            self.body(by, &[], &gradient)?,
        ];
        for ((&x, &y), &m) in slots.iter().zip(&gradient).zip(&multiplicities) {
            terms.push(g.neg(g.mul(&[g.integer(m), x, y])));
        }
        residuals.push(g.add(&terms));
        Some(residuals)
    }

    fn both_ways(&self, (a, b): (usize, usize), there: &[Expr], back: &[Expr]) -> Verdict {
        let name = |function: usize| self.function_at(function).name;
        let one = |residuals: &[Expr], inner: usize, outer: usize| {
            let Some((sum, gradients)) = residuals.split_last() else {
                return Verdict::undecided("there is nothing to compare");
            };
            let verdict = self.vanishing(gradients, true);
            let Verdict::Proved(_) = verdict else {
                return verdict.prefixed(&format!(
                    "the gradient of {} does not undo that of {} by formula",
                    name(outer),
                    name(inner)
                ));
            };
            let whole = self.vanishing(std::slice::from_ref(sum), true);
            let Verdict::Proved(_) = whole else {
                return whole.prefixed(&format!(
                    "the gradients of {0} and {1} undo each other, but {0} and {1} do not add up to the product",
                    name(a),
                    name(b)
                ));
            };
            verdict.and(whole)
        };
        let (there, back) = (one(there, a, b), one(back, b, a));
        let detail = format!(
            "the gradients of {} and {} undo each other, and both functions add up to the product",
            name(a),
            name(b)
        );
        let on = "all arguments for which both functions are defined";
        match (there, back) {
            (Verdict::Proved(one), Verdict::Proved(other)) => {
                let both = Verdict::Proved(one).and(Verdict::Proved(other));
                match both {
                    Verdict::Proved(proof) => Verdict::Proved(Proof {
                        on: on.into(),
                        detail,
                        ..proof
                    }),
                    open => open,
                }
            }
            (Verdict::Refuted(found), _) | (_, Verdict::Refuted(found)) => Verdict::Refuted(found),
            (Verdict::Proved(proof), open) => self.with_convexity(b, proof, open, (on, &detail)),
            (open, Verdict::Proved(proof)) => self.with_convexity(a, proof, open, (on, &detail)),
            (one, other) => one.and(other),
        }
    }

    /// The proof of both ways from that of one, where the gradient inside of the other way is one-to-one.
    fn with_convexity(
        &self,
        inner: usize,
        proof: Proof,
        open: Verdict,
        (on, detail): (&str, &str),
    ) -> Verdict {
        if !self.has_definite_hessian(inner) {
            return open;
        }
        let name = self.function_at(inner).name;
        Verdict::Proved(Proof {
            on: on.into(),
            detail: format!(
                "{detail}; that of {name} is one-to-one, because its Hessian is definite everywhere"
            ),
            ..proof
        })
    }

    /// Whether the Hessian is definite on the whole space, by the signs of its leading minors.
    fn has_definite_hessian(&self, function: usize) -> bool {
        let g = &self.graph;
        let slots = self.slots(function);
        let is_smooth = self
            .body(function, &[], &slots)
            .is_some_and(|value| self.is_smooth_everywhere(value));
        if !is_smooth {
            return false;
        }
        let Some(hessian) = self.hessian(function) else {
            return false;
        };
        let is_positive = |factor: i64| {
            (1..=slots.len()).all(|n| {
                let minor: Vec<Vec<Expr>> = hessian[..n]
                    .iter()
                    .map(|row| {
                        let own = row[..n].iter();
                        own.map(|&e| g.mul(&[g.integer(factor), e])).collect()
                    })
                    .collect();
                self.sign(determinant(g, &minor)).is_positive()
            })
        };
        is_positive(1) || is_positive(-1)
    }

    /// The second derivatives of a function with a formula. Rows and columns of the derivatives by a tensor are scaled against those by
    /// its unknowns, which no sign of a minor tells.
    fn hessian(&self, function: usize) -> Option<Vec<Vec<Expr>>> {
        let slots = self.slots(function);
        let row = |k: usize| -> Option<Vec<Expr>> {
            (0..slots.len())
                .map(|l| self.body(function, &[k, l], &slots))
                .collect()
        };
        (0..slots.len()).map(row).collect()
    }

    /// Whether an expression is defined and smooth for all real values of its symbols, as far as its structure tells.
    fn is_smooth_everywhere(&self, e: Expr) -> bool {
        let g = &self.graph;
        let is_known = |e: Expr| match g.node(e) {
            Node::Symbol(symbol) => !self.is_application(*symbol),
            Node::Number(_) | Node::Pi | Node::Algebraic(_) => true,
            Node::Sum { .. } | Node::Product { .. } | Node::Power { .. } | Node::Apply { .. } => {
                true
            }
            _ => false,
        };
        let mut all = guards(g, e).into_iter();
        g.reachable(&[e]).into_iter().all(is_known)
            && all.all(|(inner, relation)| is_implied(relation, self.sign(inner)))
    }
}

/// How far from the origin signs are looked at: numerators and denominators.
const SIZES: [(i64, i64); 10] = [
    (1, 1),
    (-1, 1),
    (1, 2),
    (-1, 2),
    (4, 1),
    (-4, 1),
    (30, 1),
    (-30, 1),
    (1000, 1),
    (-1000, 1),
];

/// Points at which signs of a function of so many arguments are compared: the origin, and others on the axes and on the diagonal.
fn probes(arguments: usize) -> Vec<Vec<Rational>> {
    let mut found = vec![vec![Rational::ZERO; arguments]];
    for size in SIZES {
        let (over, under) = size;
        let value = Rational::from(over) / Rational::from(under);
        for k in 0..arguments {
            let mut point = vec![Rational::ZERO; arguments];
            point[k] = value.clone();
            found.push(point);
        }
        if arguments > 1 {
            found.push(vec![value; arguments]);
        }
    }
    found
}
