//! Propagation along a variable: expressions that the equations of a body carry along, so that conditions at its ends decide whether they
//! vanish.
//!
//! Equations are compared at one place, and there `E I u'' = P (1 − x)` does not follow from `E I u''' = −P`. But along x the difference obeys
//! a linear equation of its own, with the equations of the body: where it vanishes at an end with as many of its derivatives as are needed,
//! it vanishes everywhere (the theorem of uniqueness, Lipschitz 1876). So no jet inside refutes it. Fields may stand in the equation, as in
//! u'' = u³, where it grows at most in proportion to what vanishes.

use super::comparison::{AtEnd, Comparison};
use crate::elimination::{Group, Solved};
use crate::functional::{Piece, Side};
use crate::smoothness::guard_of;
use crate::variation::OnPiece;
use chetaev_symbolic::zero::assumptions::is_implied;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Function, Node, Rational};

/// So many derivatives are tried.
const MOST: usize = 4;

impl<'f> Comparison<'f> {
    /// Whether expressions that do not vanish at each place where a system holds follow from it all the same, as it carries them along from
    /// an end at which they vanish; `at_end` is what holds on a piece of the boundary.
    pub(super) fn is_carried(
        &self,
        es: &[Expr],
        inside: &Solved<'f>,
        at_end: &AtEnd<'_, 'f>,
        on: Option<&str>,
    ) -> bool {
        let side = on.and_then(|on| self.functional.piece(on));
        let side = side.map(|piece| &piece.side);
        let is_zero = |e: Expr| inside.follows(&[e]) || self.vanishes_along(e, inside, at_end);
        let vanish = |&e: &Expr| {
            is_zero(e)
                || side.is_some_and(|side| self.continued(e, inside, side).is_some_and(is_zero))
        };
        // A branch knows a sign at one place, and not along the way.
        self.derived.nonnegative().is_empty() && es.iter().all(vanish)
    }

    /// A function in the body that is an expression on a face: the series of Taylor back to the face, `Σ (a − x)ᵏ/k! Dᵏ e`, where that ends.
    /// With u'' = −q and a number q, what is u' + q at x = 1 is u' + q x everywhere.
    fn continued(&self, e: Expr, inside: &Solved<'f>, side: &Side) -> Option<Expr> {
        let Side::Flat { axis, at, .. } = side else {
            return None;
        };
        let space = &*self.functional.space;
        let g = &space.graph;
        let step = g.sub(*at, space.coordinates.get(*axis)?.expr);
        let mut rate = inside.normal(e);
        let mut sum = vec![rate];
        let mut factor = g.one();
        for k in 1..=MOST as i64 {
            rate = inside.normal(space.total(rate, *axis));
            if space.vanishes(rate) {
                return Some(g.add(&sum));
            }
            factor = g.mul(&[factor, step, g.number(rational::ratio(1, k)?)]);
            sum.push(g.mul(&[factor, rate]));
        }
        None
    }

    /// Whether a system carries an expression along one of the variables from a face on which it vanishes.
    fn vanishes_along(&self, e: Expr, inside: &Solved<'f>, at_end: &AtEnd<'_, 'f>) -> bool {
        let mut axes = 0..self.functional.space.coordinates.len();
        axes.any(|axis| {
            let Some(chain) = self.chain(e, inside, axis) else {
                return false;
            };
            let mut ends = self.ends_across(axis);
            ends.any(|(on, piece)| {
                let there = at_end(on, piece);
                let is_zero = there.follows(&chain) && !there.is_divided_by_jets_in_a_case();
                if is_zero {
                    self.divided_by(&there);
                }
                is_zero
            })
        })
    }

    /// Whether neither fields nor data occur in what was divided by, which vanishes nowhere on the body: a quotient of fields that vanish at
    /// an end says nothing of them there.
    pub(super) fn is_regular_everywhere(&self, solved: &Solved<'f>) -> bool {
        !solved.is_divided_by_jets_in_a_case() && self.is_regular(solved)
    }

    /// What vanishes with an expression and with its derivatives along an axis: jets less their values, whose rates along the axis vanish where
    /// these do, at most in proportion to them.
    fn chain(&self, e: Expr, inside: &Solved<'f>, axis: usize) -> Option<Vec<Expr>> {
        let space = &*self.functional.space;
        self.is_regular_everywhere(inside).then_some(())?;
        let mut chain = vec![inside.normal(e)];
        // A first integral needs no theorem.
        let is_constant = space.vanishes(inside.normal(space.total(chain[0], axis)));
        if is_constant && self.has_fields(chain[0]) {
            return Some(chain);
        }
        for _ in 0..MOST {
            let group = Group {
                label: "an expression that is carried along".into(),
                equations: chain.clone(),
            };
            let closed = inside.with_at_point(&[group]);
            let carried = closed.beyond(inside);
            // A restriction of data is none that conditions enforce.
            carried.iter().all(|&e| self.has_fields(e)).then_some(())?;
            let rates = carried.iter().map(|&e| space.total(e, axis));
            let rates: Vec<Expr> = rates.map(|e| inside.normal(e)).collect();
            let open = rates.iter().copied().filter(|&e| !closed.follows(&[e]));
            let open: Vec<Expr> = open.collect();
            if !open.is_empty() {
                chain.extend(open);
                continue;
            }
            let are_solved = closed.jets_beyond(inside).len() == carried.len();
            let mut all = carried.iter().chain(&rates);
            let is_proportional = are_solved && all.all(|&e| self.is_lipschitz(e));
            return (is_proportional && self.is_regular_everywhere(&closed)).then(|| {
                self.divided_by(&closed);
                carried
            });
        }
        None
    }

    /// Whether a function changes at most in proportion to the fields in it: no root of a field, as in u'' = √u, of which u = 0 and
    /// u = x⁴/144 begin alike, and no quotient by one. A function without a formula may be such a root.
    fn is_lipschitz(&self, e: Expr) -> bool {
        let space = &*self.functional.space;
        let g = &space.graph;
        if space.has_applications(space.explicit(e)) {
            return false;
        }
        let nodes = g.reachable(&[space.explicit(e)]).into_iter();
        let mut of_jets = nodes.filter(|&node| !space.jets_in(&[node]).is_empty());
        of_jets.all(|node| {
            let is_kink = matches!(
                g.node(node),
                Node::Apply {
                    function: Function::Abs,
                    ..
                }
            );
            let is_high = match g.node(node) {
                Node::Power { exponent, .. } => {
                    let power = g.as_number(*exponent);
                    power.is_some_and(|own| *own >= Rational::ONE)
                }
                _ => false,
            };
            is_kink
                || is_high
                || guard_of(g, node).is_none_or(|(inner, relation)| {
                    is_implied(relation, known_sign(g, inner, &space.assumptions()))
                })
        })
    }

    fn has_fields(&self, e: Expr) -> bool {
        let space = &*self.functional.space;
        let jets = space.jets_in(&[e]);
        let mut all = self.functional.interior();
        all.any(|field| {
            jets.iter()
                .any(|jet| field.components.contains(&jet.component))
        })
    }

    /// The faces across an axis.
    fn ends_across(&self, axis: usize) -> impl Iterator<Item = (&'f OnPiece, &'f Piece)> + '_ {
        let pieces = self.variation.pieces.iter();
        pieces.filter_map(move |on| {
            let piece = self.functional.piece(&on.piece)?;
            let is_across = matches!(piece.side, Side::Flat { axis: own, .. } if own == axis);
            is_across.then_some((on, piece))
        })
    }
}
