//! Constraints whose gradients depend on those of the others: they follow from them, or contradict them.

use crate::characteristics::{Characteristics, CharacteristicsError, Selection};
use crate::prover::Prover;
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words::quoted;
use chetaev_symbolic::{Expr, Verdict};

/// The constraints that the selection of independent rows leaves out.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// Their names.
    pub names: Vec<String>,
    /// What each demands where the others hold, `residual = 0`.
    pub residuals: Vec<Expr>,
    /// Whether they hold wherever the others do.
    pub follows: Verdict,
}

impl LeftOut {
    /// The rows that `selection` leaves out; `None` if all constraints are independent.
    pub fn find(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        prover: &Prover,
    ) -> Option<LeftOut> {
        let rows: Vec<usize> = (0..terms.constraints.len())
            .filter(|row| !selection.rows.contains(row))
            .collect();
        if rows.is_empty() {
            return None;
        }
        let names = rows
            .iter()
            .map(|&row| system.constraints[terms.constraint_index[row]].name.clone())
            .collect();
        let stated: Vec<Expr> = rows.iter().map(|&row| terms.constraints[row]).collect();
        let characteristics = Characteristics::independent_velocities(system, terms, selection);
        let (manifold, residuals) = match &characteristics {
            Ok(c) => (c.manifold.clone(), c.restrict(system, &stated)),
            Err(_) => Default::default(),
        };
        let follows = prover.identity(system, &stated, &manifold, "on the constraint manifold");
        Some(LeftOut {
            names,
            residuals,
            follows,
        })
    }

    /// The names in quotes.
    pub fn quoted(&self) -> String {
        quoted(&self.names)
    }

    /// Refuses constraints that do not hold where the others do: no motion satisfies them all, or only one on which a
    /// further condition holds that nobody stated.
    ///
    /// # Errors
    /// [`CharacteristicsError::Contradiction`].
    pub fn check(&self, system: &System) -> Result<(), CharacteristicsError> {
        if !matches!(self.follows, Verdict::Refuted(_)) {
            return Ok(());
        }
        let g = &system.graph;
        let demands: Vec<String> = self
            .residuals
            .iter()
            .filter(|&&residual| !g.is_zero(residual))
            .map(|&residual| format!("{} = 0", g.text(residual)))
            .collect();
        Err(CharacteristicsError::Contradiction {
            names: self.quoted(),
            demands: demands.join(", "),
        })
    }
}
