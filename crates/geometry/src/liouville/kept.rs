//! The measure that the count of Euler and Jacobi asks for: one of the motion without what is left out.

use super::turns::Turn;
use super::{vanishes, Reduced};
use crate::measure::{free_of, measure, Measure};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::words::counted;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// The measure of the reduced motion.
pub(super) struct Kept {
    evidence: Verdict,
    /// What is said where it suffices, and where integrals are missing.
    suffices: &'static str,
    known: String,
}

impl Kept {
    /// What `measure.invariant` found, where that is one of the reduced motion, or whatever brackets tell of one.
    ///
    /// # Errors
    /// A sentence that says why the motion is not known.
    pub(super) fn of(
        cx: &Context<'_>,
        reduced: &Reduced,
        values: &[Expr],
        counts: &dyn Fn(Expr) -> bool,
    ) -> Result<Kept, String> {
        let measure = measure(cx);
        let measure = measure.as_ref().as_ref().map_err(Clone::clone)?;
        if let Some(evidence) = with_formula(cx, reduced, measure, counts) {
            let known = match &evidence {
                Verdict::Conditional { condition, .. } => {
                    format!("an invariant measure is known where {condition}")
                }
                _ => "the invariant measure is known".into(),
            };
            // A density that does not return after the turn of an angle is one near every place.
            let is_whole = matches!(
                measure.verdict,
                Verdict::Proved(_) | Verdict::Conditional { .. }
            );
            return Ok(Kept {
                evidence,
                suffices: match is_whole {
                    true => "the measure of `measure.invariant` is kept",
                    false => "a measure near every place is kept, for whose density `measure.invariant` says why it is none of all states",
                },
                known,
            });
        }
        let local = measure.local.as_ref().filter(|_| reduced.near_states);
        let local = local.filter(|(density, _)| is_of_reduced(cx, reduced, *density, counts));
        if let Some((_, proof)) = local {
            return Ok(Kept {
                evidence: proof.clone(),
                suffices: "a measure near almost every state is kept, whose density is zero or infinite elsewhere (`measure.invariant`)",
                known: "an invariant measure near almost every state is known".into(),
            });
        }
        // A density that changes with the time is one where the time is a variable.
        if let (None, Some((density, proof)), true) =
            (measure.density, &measure.with_time, reduced.timed)
        {
            if counts(*density) && reduced.turns.is_empty() {
                return Ok(Kept {
                    evidence: proof.clone(),
                    suffices: "the measure N dt dq dη of `measure.invariant` is kept",
                    known: "the invariant measure N dt dq dη is known".into(),
                });
            }
        }
        Kept::without_formula(cx, reduced, values)
    }

    /// A density without a formula may contain what is left out: then another one is asked for, which is a quadrature. Quadratures go
    /// from place to place, so a density near each serves, also where none returns to its values on a circle.
    fn without_formula(
        cx: &Context<'_>,
        reduced: &Reduced,
        values: &[Expr],
    ) -> Result<Kept, String> {
        let g = &cx.system.graph;
        let turns = reduced.turns.iter();
        let turns = turns.map(|turn| (turn.coordinates.clone(), g.neg(turn.divergence)));
        let turns: Vec<(Vec<Expr>, Expr)> = turns.collect();
        let evidence = free_of(cx, &reduced.ignorable, &turns, values)?;
        let place = match &evidence {
            Verdict::Conditional { condition, .. } => format!(" where {condition}"),
            _ => String::new(),
        };
        Ok(Kept {
            evidence,
            suffices: "a measure near every place is kept, whose density is a quadrature",
            known: format!(
                "an invariant measure of the reduced motion exists near almost every place{place}, without a formula here"
            ),
        })
    }

    /// The verdict with so many integrals too few.
    pub(super) fn concluded(self, about: &str, missing: usize) -> Verdict {
        let Kept {
            evidence,
            suffices,
            known,
        } = self;
        // Where rates jump the quadratures go on from one side to the other.
        let usable = matches!(evidence, Verdict::Proved(_) | Verdict::Conditional { .. });
        match (missing, evidence) {
            (
                0,
                Verdict::Conditional {
                    condition,
                    mut proof,
                    counterexample,
                },
            ) => {
                proof.detail = format!("{about}; {suffices}; {}", proof.detail);
                Verdict::Conditional {
                    condition,
                    proof,
                    counterexample,
                }
            }
            (0, evidence @ Verdict::Proved(_)) => {
                let on = "where the integrals are independent";
                let detail = format!("{about}; {suffices}");
                Verdict::Proved(Proof::exact(on, detail)).and(evidence)
            }
            (0, _) => Verdict::undecided(format!(
                "{about}; no invariant measure of the reduced motion is known whose density is a formula or a quadrature (`measure.invariant` says whether one exists)"
            )),
            (missing, _) => {
                let measure = match usable {
                    true => known,
                    false => "an invariant measure of the reduced motion is not known either".into(),
                };
                let more = counted(missing, "further integral is", "further integrals are");
                Verdict::undecided(format!("{about}; {more} missing; {measure}"))
            }
        }
    }
}

/// The proof that the density found is kept, where it is one of the reduced motion: free of what is left out, and carried along by turns.
fn with_formula(
    cx: &Context<'_>,
    reduced: &Reduced,
    measure: &Measure,
    counts: &dyn Fn(Expr) -> bool,
) -> Option<Verdict> {
    // One for the values that the model states is none for arbitrary ones.
    let (density, proof) = measure.density.zip(measure.kept.clone())?;
    let is_one = !measure.as_stated && is_of_reduced(cx, reduced, density, counts);
    is_one.then_some(proof)
}

/// Whether a density is free of what is left out, and carried along by turns.
fn is_of_reduced(
    cx: &Context<'_>,
    reduced: &Reduced,
    density: Expr,
    counts: &dyn Fn(Expr) -> bool,
) -> bool {
    let g = &cx.system.graph;
    let is_carried = |turn: &Turn| {
        let rate = reduced.turned(cx, &[density], turn)[0];
        let defect = g.add(&[rate, g.mul(&[density, turn.divergence])]);
        vanishes(cx, &reduced.chart, defect)
    };
    counts(density) && reduced.turns.iter().all(is_carried)
}
