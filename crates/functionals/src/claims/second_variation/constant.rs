//! Jacobi's field in closed form, for one field and constant coefficients: a zero exactly at the right end.

use super::form::Form;
use super::is_not_negative;
use crate::signs::enclosure;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::{Expr, Function};
use std::cmp::Ordering;

/// The field for which the second variation vanishes while it is nowhere negative: Jacobi's field, where it satisfies the condition at the
/// right end exactly and has no zero before. `None` where that is not so, or not known.
pub(super) fn degenerate(form: &Form<'_>) -> Option<Expr> {
    let space = &*form.functional.space;
    let g = &space.graph;
    if form.count() != 1 {
        return None;
    }
    let (p, q, r) = (form.p[0][0], form.q[0][0], form.r[0][0]);
    let x = space.coordinates.first()?.expr;
    if g.contains_any(g.add(&[p, q, r]), &[g.as_symbol(x)?]) {
        return None;
    }
    let (lower, upper) = (form.interval.lower, form.interval.upper);
    let [left, right] = &form.ends;
    // 2 q v v' is a divergence, and goes to the ends.
    let at_left = g.sub(left.b[0][0], q);
    let at_right = g.add(&[right.b[0][0], q]);
    let field = Field::new(form, g.div(r, p))?;
    let distance = g.sub(x, lower);
    let value = if left.fixed[0] {
        field.sine(distance)
    } else {
        let slope = g.div(at_left, p);
        g.add(&[
            field.cosine(distance),
            g.mul(&[slope, field.sine(distance)]),
        ])
    };
    let at_end = |e: Expr| g.substitute(e, &[(x, upper)]);
    let momentum = g.mul(&[p, space.total(value, 0)]);
    let condition = if right.fixed[0] {
        value
    } else {
        g.add(&[momentum, g.mul(&[at_right, value])])
    };
    if !space.vanish(&[at_end(condition)]) {
        return None;
    }
    // Zeros are π/ω apart, so that there is none before, or one that the sign at the end shows.
    if let Some(omega) = field.frequency {
        let angle = g.mul(&[omega, g.sub(upper, lower)]);
        if !is_not_negative(space, g.sub(g.pi(), angle)) {
            return None;
        }
    }
    let is_positive =
        enclosure(space, at_end(value)).and_then(|own| own.sign()) == Some(Ordering::Greater);
    (right.fixed[0] || is_positive).then_some(value)
}

/// The solutions of `v'' = κ v` with v = 1, v' = 0 and with v = 0, v' = 1.
struct Field<'a, 'f> {
    form: &'a Form<'f>,
    /// √−κ where κ is negative.
    frequency: Option<Expr>,
    /// √κ where it is positive.
    growth: Option<Expr>,
}

impl<'a, 'f> Field<'a, 'f> {
    fn new(form: &'a Form<'f>, ratio: Expr) -> Option<Field<'a, 'f>> {
        let space = &*form.functional.space;
        let g = &space.graph;
        let mut own = Field {
            form,
            frequency: None,
            growth: None,
        };
        if g.is_zero(ratio) {
            return Some(own);
        }
        let root = |e: Expr| simplify(g, g.sqrt(e), &Options::default());
        match enclosure(space, ratio)?.sign()? {
            Ordering::Less => own.frequency = Some(root(g.neg(ratio))),
            Ordering::Equal => {}
            Ordering::Greater => own.growth = Some(root(ratio)),
        }
        Some(own)
    }

    fn cosine(&self, x: Expr) -> Expr {
        let g = &self.form.functional.space.graph;
        match (self.frequency, self.growth) {
            (Some(w), _) => g.apply(Function::Cos, &[g.mul(&[w, x])]),
            (_, Some(k)) => g.apply(Function::Cosh, &[g.mul(&[k, x])]),
            _ => g.one(),
        }
    }

    fn sine(&self, x: Expr) -> Expr {
        let g = &self.form.functional.space.graph;
        match (self.frequency, self.growth) {
            (Some(w), _) => g.div(g.apply(Function::Sin, &[g.mul(&[w, x])]), w),
            (_, Some(k)) => g.div(g.apply(Function::Sinh, &[g.mul(&[k, x])]), k),
            _ => x,
        }
    }
}
