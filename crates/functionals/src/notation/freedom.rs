//! Whether what is varied as a whole on a piece takes all values, so that its coefficient vanishes.
//!
//! `δP_k = n_i δt_ik` says that the coefficient of δP_k vanishes only where the variations of the fields make all δP_k: at a point of the piece
//! the values of fields, and their derivatives across it, are varied independently of each other, and what is shown is varied by as many
//! independent combinations of them where the matrix of its slopes has full rank. Derivatives along the piece follow from the values.

use crate::elimination::Solved;
use crate::functional::{Functional, Piece, Side};
use crate::read::on_side;
use crate::space::Jet;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::Expr;
use std::collections::BTreeSet;

/// Where variations take all values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Wherever what is assumed holds.
    Everywhere,
    /// Where a determinant does not vanish.
    InGeneral,
    /// Nowhere, as far as is seen.
    Unknown,
}

/// Larger matrices are not looked at.
const LARGEST: usize = 3;

/// Minors that are looked at.
const MOST_MINORS: usize = 200;

/// How the quantities that are shown on a piece are varied: each is a field of its own, or an expression.
pub(super) struct Varied<'f> {
    functional: &'f Functional,
    piece: &'f Piece,
    /// Quantities that are no fields, and fields, by component.
    wholes: Vec<Expr>,
    fields: Vec<usize>,
}

impl<'f> Varied<'f> {
    pub(super) fn new(
        functional: &'f Functional,
        piece: &'f Piece,
        wholes: &[Expr],
        fields: Vec<usize>,
    ) -> Varied<'f> {
        let placed = |&e: &Expr| on_side(&functional.scope, &piece.side, e);
        Varied {
            functional,
            piece,
            wholes: wholes.iter().map(placed).collect(),
            fields,
        }
    }

    /// Where all of them take all values together.
    pub(super) fn freedom(&self) -> Freedom {
        let Some(columns) = self.columns() else {
            return Freedom::Unknown;
        };
        let space = &*self.functional.space;
        let slopes = |e: Expr| -> Vec<Expr> { columns.iter().map(|c| self.slope(e, c)).collect() };
        let of_wholes: Vec<Vec<Expr>> = self.wholes.iter().map(|&e| slopes(e)).collect();
        // A field that is shown beside, and on whose value no whole depends, is varied by that alone.
        let used: Vec<usize> = (0..columns.len())
            .filter(|&c| of_wholes.iter().any(|row| !space.graph.is_zero(row[c])))
            .collect();
        let is_used = |&component: &usize| {
            let mut own = used.iter().map(|&c| &columns[c]);
            own.any(|own| own.component == component && !own.is_slope)
        };
        let beside = self.fields.iter().copied().filter(is_used);
        let beside = beside.map(|component| slopes(space.jet(component, &[])));
        let rows = of_wholes.iter().cloned().chain(beside);
        let rows = rows.map(|row| used.iter().map(|&c| row[c]).collect());
        self.rank(&rows.collect::<Vec<_>>(), used.len())
    }

    /// What is varied by itself at a point: components of which no derivative along the piece occurs, and derivatives across it.
    fn columns(&self) -> Option<Vec<Column>> {
        let space = &*self.functional.space;
        let jets = space.jets_in(&self.wholes);
        if jets.iter().any(|jet| jet.by.len() > 1) {
            return None;
        }
        let interior = self.functional.interior();
        let varied: BTreeSet<usize> = interior.flat_map(|f| f.components.clone()).collect();
        let d = space.dimensions();
        let is_along = |jet: &Jet| match (&self.piece.side, &jet.by[..]) {
            (_, []) => false,
            (_, &[axis]) if axis >= d => true,
            (Side::Flat { axis, .. }, own) => own != [*axis],
            (Side::Curved, _) => d > 1,
        };
        let mut found = Vec::new();
        for component in varied {
            let mut own = jets.iter().filter(|jet| jet.component == component);
            let is_given = |is_slope| self.piece.fixed.contains(&(component, is_slope));
            if !own.clone().any(is_along) && !is_given(false) {
                found.push(Column {
                    component,
                    is_slope: false,
                });
            }
            if own.any(|jet| !jet.by.is_empty()) && !is_given(true) {
                found.push(Column {
                    component,
                    is_slope: true,
                });
            }
        }
        Some(found)
    }

    /// The slope of an expression by a column.
    fn slope(&self, e: Expr, column: &Column) -> Expr {
        let space = &*self.functional.space;
        let g = &space.graph;
        let component = column.component;
        let by = |by: Vec<usize>| space.partial(e, &Jet { component, by });
        let value = match (&self.piece.side, column.is_slope) {
            (_, false) => by(Vec::new()),
            (Side::Flat { axis, .. }, true) => by(vec![*axis]),
            (Side::Curved, true) => {
                let normal = space.normal().into_iter().enumerate();
                let terms: Vec<Expr> = normal.map(|(i, n)| g.mul(&[n, by(vec![i])])).collect();
                g.add(&terms)
            }
        };
        let value = on_side(&self.functional.scope, &self.piece.side, value);
        if space.vanish(&[value]) {
            g.zero()
        } else {
            value
        }
    }

    /// Whether the rows are independent.
    fn rank(&self, rows: &[Vec<Expr>], columns: usize) -> Freedom {
        let space = &*self.functional.space;
        let count = rows.len();
        if count == 0 {
            return Freedom::Everywhere;
        }
        if count > LARGEST || columns < count {
            return Freedom::Unknown;
        }
        let solved = Solved::new(space);
        let mut found = Freedom::Unknown;
        let mut covered = BTreeSet::new();
        let normals: BTreeSet<_> = space.normals().iter().copied().collect();
        for chosen in crate::elimination::choices(columns, count)
            .into_iter()
            .take(MOST_MINORS)
        {
            let minor: Vec<Vec<Expr>> = rows
                .iter()
                .map(|row| chosen.iter().map(|&c| row[c]).collect())
                .collect();
            let minor = space.explicit(determinant(&space.graph, &minor));
            if space.vanish(&[minor]) {
                continue;
            }
            found = Freedom::InGeneral;
            match solved.open_factors(minor)[..] {
                [] => return Freedom::Everywhere,
                [only] => {
                    covered.extend(space.graph.as_symbol(only).filter(|s| normals.contains(s)))
                }
                _ => {}
            }
        }
        if !normals.is_empty() && covered == normals {
            return Freedom::Everywhere;
        }
        found
    }
}

/// The value of a component, or its derivative across the piece.
struct Column {
    component: usize,
    is_slope: bool,
}
