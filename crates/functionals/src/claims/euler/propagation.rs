//! Propagation along a variable: expressions that the equations of a body carry along, so that conditions at its ends decide whether they
//! vanish.
//!
//! Equations are compared at one place, and there `E I u'' = P (1 − x)` does not follow from `E I u''' = −P`. But along x the difference obeys
//! a linear equation of its own, with the equations of the body: where it vanishes at an end with as many of its derivatives as are needed,
//! it vanishes everywhere (the theorem of uniqueness, Lipschitz 1876). So no jet inside refutes it.

use super::comparison::{AtEnd, Comparison, Judged};
use crate::elimination::{Group, Solved};
use crate::functional::{Equation, Piece, Role, Side};
use crate::variation::OnPiece;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// So many derivatives are tried.
const MOST: usize = 4;

/// What is known of an expression that does not vanish at each place where equations hold.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Propagation {
    /// It is not carried along: a jet at one place refutes it.
    No,
    /// It is, and what holds at an end was not shown to make it vanish.
    Open,
    /// It is, and vanishes at an end.
    Vanishes,
}

impl<'f> Comparison<'f> {
    /// A refutation of expressions at one place stands only where none of them is carried along by the system.
    pub(super) fn where_propagated(
        &self,
        own: Judged,
        es: &[Expr],
        inside: &Solved<'f>,
        at_end: &AtEnd<'_, 'f>,
    ) -> Judged {
        if !matches!(own.verdict, Verdict::Refuted(_)) {
            return own;
        }
        let open = es.iter().filter(|&&e| !inside.follows(&[e]));
        let found: Vec<Propagation> = open.map(|&e| self.propagation(e, inside, at_end)).collect();
        if found.is_empty() || found.contains(&Propagation::No) {
            return own;
        }
        let verdict = if found.contains(&Propagation::Open) {
            Verdict::undecided(
                "it does not hold at each place, but the other system carries it along, so that it holds everywhere where conditions at the ends \
                 make it hold; whether they do together was not decided",
            )
        } else {
            Verdict::Proved(Proof::exact("", ""))
        };
        Judged {
            verdict,
            open: Vec::new(),
            ..own
        }
    }

    /// Whether a system carries an expression along one of the variables; `at_end` is what holds on a piece of the boundary.
    fn propagation(&self, e: Expr, inside: &Solved<'f>, at_end: &AtEnd<'_, 'f>) -> Propagation {
        // Values that are given at all ends, and are any, enforce nothing.
        let ends = self.ends_with_conditions();
        if ends.is_empty() {
            return Propagation::No;
        }
        let axes = 0..self.functional.space.coordinates.len();
        let mut found = Propagation::No;
        let mut is_solved = true;
        for axis in axes {
            let Some(chain) = self.chain(e, inside, axis) else {
                continue;
            };
            for (on, piece) in self.ends_across(axis) {
                let there = at_end(on, piece);
                if there.follows(&chain) {
                    self.divided_by(&there);
                    return Propagation::Vanishes;
                }
                is_solved &= there.left.is_empty();
                // What is another number there is no zero.
                if self.is_never_zero(there.normal(chain[0])) {
                    return Propagation::No;
                }
            }
            found = Propagation::Open;
        }
        // On a line with conditions at one end alone all solutions begin there, and nothing else enforces anything.
        let is_line = self.functional.space.coordinates.len() == 1;
        if is_line && is_solved && ends.len() == 1 {
            return Propagation::No;
        }
        found
    }

    /// The pieces on which more is said than that values are given.
    fn ends_with_conditions(&self) -> Vec<&'f str> {
        let pieces = self.variation.pieces.iter();
        let said = pieces.filter(|on| {
            let mut stated = self.functional.equations.iter();
            let is_here =
                |e: &Equation| e.role != Role::Other && e.on.as_deref() == Some(&on.piece);
            !on.conditions.is_empty() || stated.any(is_here)
        });
        said.map(|on| on.piece.as_str()).collect()
    }

    /// The same for what is said on a piece: what another piece enforces is not known at this one.
    pub(super) fn where_propagated_to(
        &self,
        piece: &str,
        own: Judged,
        es: &[Expr],
        (inside, at_end): (&Solved<'f>, &AtEnd<'_, 'f>),
    ) -> Judged {
        let here = self.variation.pieces.iter().find(|on| on.piece == piece);
        let here = here.and_then(|on| Some(at_end(on, self.functional.piece(piece)?)));
        let is_number =
            here.is_none_or(|here| es.iter().any(|&e| self.is_never_zero(here.normal(e))));
        let mut ends = self.ends_with_conditions().into_iter();
        if is_number || ends.all(|own| own == piece) {
            return own;
        }
        self.where_propagated(own, es, inside, at_end)
    }

    /// The expression and its derivatives along an axis, up to the one that vanishes where those before it do.
    fn chain(&self, e: Expr, inside: &Solved<'f>, axis: usize) -> Option<Vec<Expr>> {
        let space = &*self.functional.space;
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
            if closed.follows(&[next]) {
                self.divided_by(&closed);
                return Some(chain);
            }
            chain.push(next);
        }
        None
    }

    /// Whether an expression has no fields in it that could make it zero.
    pub(super) fn is_never_zero(&self, e: Expr) -> bool {
        !self.has_fields(e) && !self.functional.space.vanishes(e)
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
