//! States at which the equations say less than the motion does: their determinant vanishes there, and that of the motion does not.

use super::{Expr, Question, Verdict};
use crate::claims::on_set::constraint_set;
use crate::prover::assumptions;
use crate::sample;
use chetaev_symbolic::factors::irreducible_factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::zero::{known_sign, refuted_near};
use chetaev_symbolic::Symbol;

/// Cofactors of a larger matrix are too many.
const LARGEST: usize = 7;

impl Question<'_, '_> {
    /// A proof holds but at states where the equations do not determine the accelerations and the motion is regular.
    pub(super) fn but_for_singular_states(
        &self,
        matrix: &[Vec<Expr>],
        verdict: Verdict,
    ) -> Verdict {
        let Verdict::Proved(mut proof) = verdict else {
            return verdict;
        };
        let g = &self.system().graph;
        let places: Vec<String> = self
            .singular_factors(matrix)
            .into_iter()
            .map(|f| g.text(f))
            .collect();
        if places.is_empty() {
            return Verdict::Proved(proof);
        }
        let (is_not, is) = (
            places.iter().map(|f| format!("{f} ≠ 0")),
            places.iter().map(|f| format!("{f} = 0")),
        );
        let (is_not, is): (Vec<String>, Vec<String>) = (is_not.collect(), is.collect());
        proof.detail = format!(
            "{}; where {} they do not determine the accelerations, although the motion does: what moves or rests there otherwise satisfies them too",
            proof.detail,
            is.join(" or ")
        );
        Verdict::Conditional {
            condition: is_not.join(" and "),
            proof,
            counterexample: None,
        }
    }

    /// The factors of the determinant of the equations that vanish at a real admissible state at which the motion is regular.
    fn singular_factors(&self, matrix: &[Vec<Expr>]) -> Vec<Expr> {
        let (system, g) = (self.system(), &self.system().graph);
        let size = matrix.len();
        if size > LARGEST || matrix.iter().any(|row| row.len() != size) {
            return Vec::new();
        }
        let set = constraint_set(self.cx);
        let solved: Vec<(Expr, Expr)> = set
            .solved
            .iter()
            .map(|&(s, e)| (g.symbol_expr(s), e))
            .collect();
        let own = g.substitute(determinant(g, matrix), &solved);
        let bordered = g.substitute(determinant(g, &self.bordered()), &solved);
        let moving = g.symbols_in(&[own]).into_iter();
        let moving: Vec<Symbol> = moving
            .filter(|&s| system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t")
            .collect();
        let Some(factors) = irreducible_factors(g, own, &moving) else {
            return Vec::new();
        };
        let stated = assumptions(system);
        let factors = factors.into_iter().map(|(f, _)| f);
        let factors = factors
            .filter(|&f| g.contains_any(f, &moving) && !known_sign(g, f, &stated).is_nonzero());
        factors
            .filter(|&f| self.vanishes_somewhere(f, bordered, &set.implicit))
            .collect()
    }

    /// [[W, −Jᵀ], [J, 0]].
    fn bordered(&self) -> Vec<Vec<Expr>> {
        let (g, terms, rows) = (&self.system().graph, self.cx.terms, &self.cx.selection.rows);
        let above = (0..self.system().n()).map(|i| {
            let mut line = terms.mass_matrix[i].clone();
            line.extend(rows.iter().map(|&row| g.neg(terms.jacobian[row][i])));
            line
        });
        self.with_constraints(above.collect(), rows.len())
    }

    /// Whether a function has a real zero on the constraint set at which another one is not zero.
    fn vanishes_somewhere(&self, factor: Expr, other: Expr, implicit: &[(Expr, Symbol)]) -> bool {
        let (system, g) = (self.system(), &self.system().graph);
        let stated = assumptions(system);
        let symbols = g.symbols_in(&[factor]).into_iter();
        let symbols: Vec<Symbol> = symbols
            .filter(|&s| {
                system.moves(g.symbol_name(s)) && !implicit.iter().any(|(_, own)| *own == s)
            })
            .collect();
        (0..8_u64).any(|seed| {
            let Some(point) = sample::admissible_point(system, self.cx.terms, 0x51_6e67 + seed)
            else {
                return false;
            };
            symbols.iter().any(|&s| {
                let value = |x: f64| {
                    let at = |symbol: Symbol| {
                        if symbol == s {
                            Some(x)
                        } else {
                            Some(point.get(&symbol).copied().unwrap_or(1.0))
                        }
                    };
                    g.evaluate_f64(&[factor], &at).ok()?.first().copied()
                };
                let Some(zero) = zero_of(&value) else {
                    return false;
                };
                let near = |symbol: Symbol| {
                    if symbol == s {
                        Some(zero)
                    } else {
                        Some(point.get(&symbol).copied().unwrap_or(1.0))
                    }
                };
                let mut constraints = implicit.to_vec();
                constraints.push((factor, s));
                refuted_near(g, other, &constraints, &stated, &near).is_some()
            })
        })
    }
}

/// A zero of a continuous function of one variable between two of some places.
fn zero_of(value: &dyn Fn(f64) -> Option<f64>) -> Option<f64> {
    let places = (-60..=60).map(|i| f64::from(i) / 8.0 + 0.013);
    let known: Vec<(f64, f64)> = places.filter_map(|x| Some((x, value(x)?))).collect();
    known.windows(2).find_map(|pair| {
        let [(mut low, at_low), (mut high, at_high)] = *pair else {
            return None;
        };
        let changes = at_low * at_high < 0.0;
        if !changes {
            return None;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if value(middle)? * at_low > 0.0 {
                low = middle
            } else {
                high = middle
            }
        }
        // A change of sign at a pole is none at a zero.
        let size = at_low.abs().max(at_high.abs());
        (value(low)?.abs() < 1e-6 * size.max(1.0)).then_some(low)
    })
}
