//! The linear equations about a steady motion, `E δz' = F δz`, exact in the parameters.
//!
//! With `q' = φ(q, P)` and `M P' = b` a steady motion has φ = 0 for the coordinates that are not ignorable and b = 0, so that
//! `δq' = φ_q δq + φ_P δP` and `M δP' = b_q δq + b_P δP`, M at the motion. Finite constraints h(q) = 0 are kept by these equations, and
//! `h_q δq = 0` takes the dependent coordinates out of them.

use crate::expansion::Expansion;
use crate::steady::{closed, echelon};
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::Expr;

pub use crate::problem::LinearizationError;

/// A variable of the linear equations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Variable {
    /// The deviation of a coordinate.
    Coordinate(usize),
    /// The deviation of quasi-velocity σ.
    Speed(usize),
}

/// Linear equations about a steady motion.
#[derive(Clone, Debug)]
pub struct Linearization {
    /// The variables: independent coordinates that are not ignorable, then the quasi-velocities.
    pub variables: Vec<Variable>,
    /// Their names, in the same order.
    pub names: Vec<String>,
    /// The quasi-velocities as functions of the velocities, by name.
    pub speeds: Vec<(String, Expr)>,
    /// E, row by row.
    pub left: Vec<Vec<Expr>>,
    /// F, row by row.
    pub right: Vec<Vec<Expr>>,
    /// Coordinates on which nothing depends.
    pub ignorable: Vec<String>,
    /// Coordinates that finite constraints determine, each with its deviation by the variables.
    pub dependent: Vec<(String, Vec<Expr>)>,
    /// The dimension of the family of steady motions through this one that was proved.
    pub family: usize,
}

/// The linear equations about `motion`. `values` are the values of parameters that are put in, others stay as they are.
///
/// # Errors
/// [`LinearizationError`].
pub fn linearize(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    motion: &SteadyMotion,
    values: &[(Expr, Expr)],
) -> Result<Linearization, LinearizationError> {
    Ok(Expansion::new(system, terms, selection, motion, values)?.linear())
}

/// Coordinates, by their places among those that are not ignorable.
pub(crate) struct Reduction {
    /// Those that stay variables.
    pub(crate) kept: Vec<usize>,
    /// Those that finite constraints determine, each with the slopes of its deviation by the others.
    pub(crate) dependent: Vec<(usize, Vec<Expr>)>,
}

impl Expansion<'_> {
    /// The linear equations about the motion.
    pub fn linear(&self) -> Linearization {
        let g = self.graph();
        let (places, k) = (&self.own.coordinates, self.own.characteristics.k());
        let right = self.slopes();
        let mass = self.at_rows(&self.own.equations.mass);
        let reduction = self.reduction();
        let (tangent, kept) = (&reduction.dependent, &reduction.kept);
        let rows = kept.iter().copied().chain(places.len()..places.len() + k);
        let reduced = |row: &[Expr]| self.reduced(&reduction, row);
        let size = kept.len() + k;
        let mut left = vec![vec![g.zero(); size]; size];
        for (at, row) in left.iter_mut().enumerate() {
            match at.checked_sub(kept.len()) {
                None => row[at] = g.one(),
                Some(s) => row[kept.len()..].copy_from_slice(&mass[s]),
            }
        }
        let name_of = |at: usize| self.system.coordinates[places[at]].name.clone();
        let speeds = &self.own.characteristics.parameters;
        let mut found = Linearization {
            variables: kept
                .iter()
                .map(|&at| Variable::Coordinate(places[at]))
                .chain((0..k).map(Variable::Speed))
                .collect(),
            names: kept
                .iter()
                .map(|&at| name_of(at))
                .chain(speeds.iter().map(|p| p.name.clone()))
                .collect(),
            speeds: speeds
                .iter()
                .map(|p| (p.name.clone(), p.definition))
                .collect(),
            left,
            right: rows.map(|row| reduced(&right[row])).collect(),
            ignorable: self
                .own
                .ignorable(self.system)
                .into_iter()
                .map(|j| self.system.coordinates[j].name.clone())
                .collect(),
            dependent: tangent
                .iter()
                .map(|(own, slopes)| {
                    let of_kept = kept.iter().map(|&at| slopes[at]);
                    (name_of(*own), of_kept.collect())
                })
                .collect(),
            family: 0,
        };
        found.family = self.family(&right);
        found
    }

    /// What the finite constraints leave of the coordinates that are not ignorable.
    pub(crate) fn reduction(&self) -> Reduction {
        let dependent = self.tangent();
        let is_dependent = |at: &usize| dependent.iter().any(|(own, _)| own == at);
        let all = 0..self.own.coordinates.len();
        Reduction {
            kept: all.filter(|at| !is_dependent(at)).collect(),
            dependent,
        }
    }

    /// Derivatives by all variables as derivatives by those that are independent.
    pub(crate) fn reduced(&self, reduction: &Reduction, row: &[Expr]) -> Vec<Expr> {
        let g = self.graph();
        let column = |&at: &usize| {
            let through = reduction.dependent.iter();
            let through = through.map(|(own, slopes)| g.mul(&[row[*own], slopes[at]]));
            let all: Vec<Expr> = std::iter::once(row[at]).chain(through).collect();
            closed(g, g.add(&all))
        };
        let of_kept = reduction.kept.iter().map(column);
        let speeds = row[self.own.coordinates.len()..].iter().copied();
        of_kept.chain(speeds).collect()
    }

    /// The coordinates that finite constraints determine, by their places among those that are not ignorable, each with the slopes of
    /// its deviation by the others.
    fn tangent(&self) -> Vec<(usize, Vec<Expr>)> {
        let g = self.graph();
        let rows = self.selection.rows.iter();
        let constraints =
            rows.map(|&row| &self.system.constraints[self.terms.constraint_index[row]]);
        let finite = constraints.filter(|c| c.kind == ConstraintKind::Holonomic);
        let ignorable = self.own.ignorable(self.system);
        let order: Vec<usize> = ignorable
            .iter()
            .chain(&self.own.coordinates)
            .copied()
            .collect();
        let symbols = self.system.coordinate_symbols();
        let gradients = finite.map(|c| g.gradient(c.stated, &symbols));
        let gradients = self.at_rows(&gradients.collect::<Vec<_>>());
        let in_order = |row: &Vec<Expr>| order.iter().map(|&j| row[j]).collect();
        let mut gradients: Vec<Vec<Expr>> = gradients.iter().map(in_order).collect();
        // Ignorable coordinates are solved for first: what is left restricts the others.
        let solved = echelon(g, &mut gradients, ignorable.len()).columns.len();
        let mut rest: Vec<Vec<Expr>> = gradients[solved..]
            .iter()
            .map(|row| row[ignorable.len()..].to_vec())
            .collect();
        let count = self.own.coordinates.len();
        let preferred = self.dependent_last(&mut rest);
        let pivots = echelon(g, &mut rest, count).columns;
        let place = |at: usize| preferred[at];
        pivots
            .iter()
            .zip(&rest)
            .map(|(&pivot, row)| {
                let mut slopes = vec![g.zero(); count];
                for (at, &e) in row
                    .iter()
                    .enumerate()
                    .filter(|(at, _)| !pivots.contains(at))
                {
                    slopes[place(at)] = g.neg(e);
                }
                (place(pivot), slopes)
            })
            .collect()
    }

    /// Orders the columns so that coordinates with dependent velocities are solved for where they can be; the places of the columns.
    fn dependent_last(&self, rows: &mut [Vec<Expr>]) -> Vec<usize> {
        let is_dependent = |at: &usize| {
            self.selection
                .dependent
                .contains(&self.own.coordinates[*at])
        };
        let mut order: Vec<usize> = (0..self.own.coordinates.len()).collect();
        order.sort_by_key(|at| !is_dependent(at));
        for row in rows {
            *row = order.iter().map(|&at| row[at]).collect();
        }
        order
    }
}
