//! Propagation along a variable: expressions that the equations of a body carry along, so that conditions at its ends decide whether they
//! vanish.
//!
//! Equations are compared at one place, and there `E I u'' = P (1 − x)` does not follow from `E I u''' = −P`. But along x the difference obeys
//! a linear equation of its own, with the equations of the body: where it vanishes at an end with as many of its derivatives as are needed,
//! it vanishes everywhere (the theorem of uniqueness, Lipschitz 1876). So no jet inside refutes it.

use super::comparison::{AtEnd, Comparison};
use crate::elimination::{Entries, Group, Pivot, Solved};
use crate::functional::{Piece, Side};
use crate::variation::OnPiece;
use chetaev_symbolic::Expr;

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
    ) -> bool {
        let vanish = |&e: &Expr| inside.follows(&[e]) || self.vanishes_along(e, inside, at_end);
        es.iter().all(vanish)
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
                let is_zero = there.follows(&chain) && self.is_regular_at(&there);
                if is_zero {
                    self.divided_by(&there);
                }
                is_zero
            })
        })
    }

    /// Whether fields occur in nothing that was divided by, which vanishes nowhere on the body: a quotient of fields that vanish at an end
    /// says nothing of them there.
    fn is_regular_everywhere(&self, solved: &Solved<'f>) -> bool {
        self.is_regular_at(solved) && self.is_regular(solved)
    }

    fn is_regular_at(&self, solved: &Solved<'f>) -> bool {
        let is_free = |e: &Expr| !self.has_fields(*e);
        let of_fields = |pivot: &Pivot| pivot.entries == Entries::Fields;
        solved.divisors.iter().all(is_free) && !solved.pivots.iter().any(of_fields)
    }

    /// The expression and its derivatives along an axis, up to the one that vanishes where those before it do.
    fn chain(&self, e: Expr, inside: &Solved<'f>, axis: usize) -> Option<Vec<Expr>> {
        let space = &*self.functional.space;
        self.is_regular_everywhere(inside).then_some(())?;
        let mut chain = vec![inside.normal(e)];
        for _ in 0..MOST {
            let last = *chain.last()?;
            // A restriction of data is none that conditions enforce.
            self.has_fields(last).then_some(())?;
            let next = inside.normal(space.total(last, axis));
            let group = Group {
                label: "an expression that is carried along".into(),
                equations: chain.clone(),
            };
            let closed = inside.with_at_corner(&[group]);
            if closed.follows(&[next]) && self.is_regular_everywhere(&closed) {
                self.divided_by(&closed);
                return Some(chain);
            }
            chain.push(next);
        }
        None
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
