//! Constraints whose gradients depend on those of the others: they follow from them, or contradict them.

use crate::characteristics::{Characteristics, CharacteristicsError, Selection};
use crate::positions;
use crate::prover::Prover;
use crate::sample;
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words::quoted;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::verdict::Evidence;
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

/// Longer combinations are not written out.
const LONGEST: usize = 160;
/// Residuals below this are rounding.
const ROUNDED: f64 = 1e-9;

/// Whether the constraints left out hold at computed points of the set where those kept do, if they do.
fn at_points(system: &System, terms: &MotionTerms, selection: &Selection) -> Option<Verdict> {
    let (residual, samples) = sample::left_out_residual(system, terms, &selection.rows)?;
    (residual <= ROUNDED).then(|| {
        Verdict::Numerical(Evidence {
            samples,
            region: "positions and velocities that satisfy the constraints".into(),
            digits: 16,
            residual,
            seed: None,
            why_no_proof: "the finite constraints are not solved one after the other".into(),
        })
    })
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
        let set = positions::of(system, terms, selection);
        let g = &system.graph;
        let on = |values: &[(Expr, Expr)]| {
            let manifold = set.joined(&manifold).substituted(g, values);
            let stated = g.substitute_all(&stated, values);
            prover.consequence(system, &stated, &manifold, "on the constraint manifold")
        };
        let mut follows = on(&[]);
        if !matches!(follows, Verdict::Proved(_)) {
            // A linkage may move by its measures alone.
            let values = system.parameter_values();
            if let (false, Verdict::Proved(proof)) = (values.is_empty(), on(&values)) {
                let sentence = "for the values of the parameters that the model states";
                follows = Verdict::Proved(proof).prefixed(sentence);
            } else if !set.is_whole {
                follows = at_points(system, terms, selection).unwrap_or_else(|| {
                    Verdict::undecided(
                        "no positions were found that satisfy the finite constraints",
                    )
                });
            }
        }
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

/// Which multipliers redundancy leaves undetermined, and what of them the motion determines.
#[derive(Clone, Debug, Default)]
pub struct Reactions {
    /// Rows of the constraints whose multipliers are not determined one by one.
    pub undetermined: Vec<usize>,
    /// Their combinations that are determined: with ∂f_l/∂v = Σ_i c_li ∂f_i/∂v for every constraint l left out, λ_i + Σ_l c_li λ_l.
    pub determined: Vec<Expr>,
}

impl Reactions {
    /// Of a system with these independent rows.
    pub fn of(system: &System, terms: &MotionTerms, selection: &Selection) -> Reactions {
        let g = &system.graph;
        let is_left_out = |row: &usize| !selection.rows.contains(row);
        let left_out: Vec<usize> = (0..terms.constraints.len()).filter(is_left_out).collect();
        if left_out.is_empty() {
            return Reactions::default();
        }
        let block = |row: &usize| -> Vec<Expr> {
            let entries = selection.dependent.iter();
            entries.map(|&d| terms.jacobian[*row][d]).collect()
        };
        let rows: Vec<Vec<Expr>> = selection.rows.iter().map(block).collect();
        let size = rows.len();
        let transposed: Vec<Expr> = (0..size)
            .flat_map(|d| rows.iter().map(move |row| row[d]))
            .collect();
        let set = positions::of(system, terms, selection);
        let mut parts: Vec<Vec<Expr>> = vec![Vec::new(); size];
        let lambda = |row: usize| {
            let name = &system.constraints[terms.constraint_index[row]].name;
            g.symbol(&format!("lambda_{name}"), 0)
        };
        for &l in &left_out {
            let Ok(weights) = g.solve(&transposed, &block(&l)) else {
                let undetermined = (0..terms.constraints.len()).collect();
                return Reactions {
                    undetermined,
                    determined: Vec::new(),
                };
            };
            for (part, weight) in parts.iter_mut().zip(set.put_in(system, &weights)) {
                let short = simplify(g, weight, &Options::default());
                if !g.is_zero(short) {
                    part.push(g.mul(&[short, lambda(l)]));
                }
            }
        }
        let mut found = Reactions {
            undetermined: left_out,
            determined: Vec::new(),
        };
        for (&row, mut parts) in selection.rows.iter().zip(parts) {
            if parts.is_empty() {
                continue;
            }
            parts.push(lambda(row));
            found.undetermined.push(row);
            found.determined.push(g.add(&parts));
        }
        found.undetermined.sort_unstable();
        found
    }

    /// The combinations that are short enough to read.
    pub fn texts(&self, system: &System) -> Vec<(String, Expr)> {
        let all = self.determined.iter().map(|&e| (system.graph.text(e), e));
        all.filter(|(text, _)| text.len() <= LONGEST && !text.contains('\n'))
            .collect()
    }
}
