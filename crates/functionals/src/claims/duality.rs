//! `functional.duality`: two functionals add up to a divergence, and to nothing with their boundary terms.

use super::flux;
use super::modulo::{among, equations, other_body, vanishing, vanishing_difference, STATED};
use super::{Claim, Context, Finding, Formula};
use crate::elimination::Group;
use crate::functional::{Functional, Relation, Role, Side};
use crate::read::on_side;
use crate::space::Space;
use crate::variation::euler_expression;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};
use std::collections::BTreeSet;

/// `functional.duality#NAME`.
pub(super) struct Duality;

impl Claim for Duality {
    fn id(&self) -> &'static str {
        "functional.duality"
    }

    fn title(&self) -> &'static str {
        "The densities of a functional and of its dual add up to a divergence, and both functionals to zero"
    }

    fn explanation(&self) -> &'static str {
        "The sum of the two densities of the interior is a divergence if its Euler expressions vanish identically. A flux W of it is stated, or \
         found where the sum is a polynomial in the fields (by parts along the way from zero to these, H. Poincaré's lemma). With the flux W \
         the sum is proved to be D_i W_i, and on every piece n_i W_i and the two boundary densities must add up to zero, which makes the \
         sum of the functionals zero for all fields that both admit. Where it vanishes on a piece only because of field equations, or as a \
         product of two conditions, the verdict names the fewest that are needed. A flux that was found is one of many: where it does not cancel \
         on a piece the claim is refuted only where no other one does, which is so where what is left depends on values of fields alone."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let is = |r: &Relation| matches!(r, Relation::Duality { .. });
        let has_none = cx.missing(self.id()).next().is_some();
        if has_none || cx.problem.relations.iter().any(is) {
            vec![cx.own()]
        } else {
            Vec::new()
        }
    }

    fn differentiates(&self) -> bool {
        true
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        if let Some(verdict) = cx.not_defined(self.id(), None) {
            return verdict.into();
        }
        let found = cx.problem.relations.iter().find_map(|r| match r {
            Relation::Duality { own, other, flux } => Some((own, other, flux.as_ref())),
            _ => None,
        });
        let bodies = found.and_then(|(own, other, _)| other_body(own, other));
        if let Some(verdict) = bodies {
            return verdict.into();
        }
        match found {
            Some((own, other, Some((written, flux)))) => {
                let flux = Flux {
                    written: written.clone(),
                    components: flux.clone(),
                    is_stated: true,
                };
                with_flux(own, other, &flux)
            }
            Some((own, other, None)) => without_flux(own, other),
            None => Verdict::undecided("no dual functional is stated").into(),
        }
    }
}

/// A vector whose divergence the sum of two densities is.
struct Flux {
    written: String,
    components: Vec<Expr>,
    /// Whether it was stated, and not found.
    is_stated: bool,
}

fn without_flux(functional: &Functional, other: &Functional) -> Finding {
    let space = &*functional.space;
    let sum = space.graph.add(&[functional.density, other.density]);
    let jets = space.jets_in(&[sum]);
    let components: BTreeSet<usize> = jets.into_iter().map(|jet| jet.component).collect();
    // What depends on some variables only need not have a vanishing Euler expression, as `∫ q x dx` shows with a number q.
    let (free, bound): (Vec<usize>, Vec<usize>) = components
        .into_iter()
        .partition(|&component| space.varies_everywhere(component));
    let of = |all: &[usize]| -> Vec<Expr> {
        let own = all.iter();
        own.map(|&component| euler_expression(space, sum, component))
            .collect()
    };
    let proof = match space.vanishing(&of(&free), true) {
        Verdict::Proved(proof) if space.vanish(&of(&bound)) => proof,
        Verdict::Proved(_) => {
            return Verdict::undecided(
                "whether the sum of the densities is a divergence was not decided, as it contains data of some variables only",
            )
            .into()
        }
        verdict => return verdict.prefixed("the sum of the densities is not a divergence").into(),
    };
    if let Some(components) = flux::of(space, sum) {
        let texts = components.iter().map(|&e| space.graph.text(e));
        let flux = Flux {
            written: format!("({})", texts.collect::<Vec<_>>().join(", ")),
            components,
            is_stated: false,
        };
        return with_flux(functional, other, &flux);
    }
    Verdict::Conditional {
        condition: "its flux through the boundary and the densities there cancel".into(),
        proof: Proof {
            on: "all fields".into(),
            detail: format!(
                "the sum of the densities of {} and {} has no Euler expression, so that it is a divergence; no flux is stated, and none was found",
                functional.name, other.name
            ),
            ..proof
        },
        counterexample: None,
    }
    .into()
}

/// What is known where a flux that was found and boundary densities do not cancel on a piece. Another flux of the same divergence differs from it
/// by what is no function of values of fields alone, and a constant at one end may be taken off at another.
fn not_cancelled(space: &Space, flux: &Flux, sum: Expr, verdict: Verdict) -> Verdict {
    let jets = space.jets_in(&[sum]);
    let is_of_values = !jets.is_empty() && jets.iter().all(|jet| jet.by.is_empty());
    if !matches!(verdict, Verdict::Refuted(_)) {
        return verdict;
    }
    if jets.is_empty() {
        return Verdict::undecided("without fields in it, their sum may cancel with that on another piece, which was not compared");
    }
    if flux.is_stated || is_of_values {
        return verdict;
    }
    Verdict::undecided("no flux is stated, and with another one than that which was found they may")
}

fn with_flux(functional: &Functional, other: &Functional, flux: &Flux) -> Finding {
    let space = &*functional.space;
    let written = &flux.written;
    let through = &flux::without_constants(space, &flux.components);
    let g = &space.graph;
    let mut terms = vec![functional.density, other.density];
    for (axis, &w) in through.iter().enumerate() {
        terms.push(g.neg(space.total(w, axis)));
    }
    let mut notes = Vec::new();
    // Both functionals are of fields that both admit.
    let own = equations(functional, None, &[Role::Imposed]);
    let imposed = together(own, equations(other, None, &[Role::Imposed]));
    let mut all = match vanishing(functional, &[g.add(&terms)], &imposed) {
        Ok((proof, needed)) => {
            if !needed.is_empty() {
                notes.push(format!("in the interior modulo {needed}"));
            }
            Verdict::Proved(proof)
        }
        Err(verdict) => {
            let what = format!("the sum of the densities is not the divergence of {written}");
            let verdict = among(functional, &[g.add(&terms)], &imposed, *verdict);
            return verdict.prefixed(&what).into();
        }
    };
    let mut formulas = Vec::new();
    for piece in &functional.pieces {
        let Some(dual) = other.piece(&piece.name) else {
            return Verdict::undecided(format!("`{}` has no piece {}", other.name, piece.name))
                .into();
        };
        let mut terms: Vec<Expr> = match piece.side {
            Side::Curved => {
                let own = space.normal().into_iter().zip(through);
                own.map(|(n, &w)| g.mul(&[n, w])).collect()
            }
            Side::Flat { axis, is_upper, .. } => match through.get(axis) {
                Some(&w) if is_upper => vec![w],
                Some(&w) => vec![g.neg(w)],
                None => Vec::new(),
            },
        };
        terms.extend([piece.density, dual.density]);
        let sum = on_side(&functional.scope, &piece.side, g.add(&terms));
        match on_piece(functional, other, &piece.name, sum) {
            Ok((proof, note)) => {
                if let Some(note) = note {
                    notes.push(format!("on {} {note}", piece.name));
                    let caption = format!("the sum on {}, which vanishes {note}", piece.name);
                    formulas.push(Formula::new(caption, sum));
                }
                all = all.and(Verdict::Proved(proof));
            }
            Err(verdict) => {
                let what = format!(
                    "on {} the flux and the boundary densities do not cancel",
                    piece.name
                );
                let imposed = |own| equations(own, Some(&piece.name), &[Role::Imposed]);
                let held = together(imposed(functional), imposed(other));
                let verdict = among(functional, &[sum], &held, *verdict);
                let verdict = not_cancelled(space, flux, sum, verdict);
                let verdict = match verdict {
                    Verdict::Refuted(_) if flux::leaves_edges_only(space, &piece.side, sum) => {
                        Verdict::undecided(match piece.side {
                            Side::Flat { .. } => "their sum is a divergence along it, and what that leaves where faces meet was not compared",
                            Side::Curved => "whether their sum is a divergence along it was not decided, as it contains derivatives",
                        })
                    }
                    other => other,
                };
                return verdict.prefixed(&what).into();
            }
        }
    }
    let at_ends = at_ends_of_time(functional, through, &imposed);
    let verdict = match (all, at_ends) {
        (Verdict::Proved(proof), Some(condition)) => Verdict::Conditional {
            condition,
            proof: Proof {
                on: "all fields".into(),
                detail: format!(
                    "the densities of {} and {} add up to the divergence of {written}, and the functionals to what its last component is at the last time less that at the first",
                    functional.name, other.name
                ),
                ..proof
            },
            counterexample: None,
        },
        (Verdict::Proved(proof), None) => Verdict::Proved(Proof {
            on: if notes.is_empty() {
                "all fields".into()
            } else {
                format!("all fields; {}", notes.join(", "))
            },
            detail: if notes.is_empty() {
                format!(
                    "the densities of {} and {} add up to the divergence of {written}, and the functionals to zero identically",
                    functional.name, other.name
                )
            } else {
                format!(
                    "the densities of {} and {} add up to the divergence of {written}, and the functionals to zero {}",
                    functional.name,
                    other.name,
                    notes.join(", ")
                )
            },
            ..proof
        }),
        (other, _) => other,
    };
    Finding { verdict, formulas }
}

/// What must hold at the first and at the last time: the boundary has no pieces there.
fn at_ends_of_time(functional: &Functional, flux: &[Expr], imposed: &[Group]) -> Option<String> {
    let space = &*functional.space;
    let axis = space.coordinates.iter().position(|c| c.is_time)?;
    let through = *flux.get(axis)?;
    let vanishes =
        matches!(vanishing(functional, &[through], imposed), Ok((_, needed)) if needed.is_empty());
    (!vanishes).then(|| {
        format!(
            "the integral of {} over the body is the same at both ends of the time",
            space.graph.text(through)
        )
    })
}

/// A proof that a sum vanishes on a piece: with equations of the interior, or with what is imposed there; else as a product of what
/// conditions say is zero. With one condition of the piece alone the sum would vanish for any multiple of it.
fn on_piece(
    functional: &Functional,
    other: &Functional,
    piece: &str,
    sum: Expr,
) -> Result<(Proof, Option<String>), Box<Verdict>> {
    let inside = equations(functional, None, STATED);
    let own = equations(functional, Some(piece), &[Role::Imposed]);
    let of_dual = equations(other, Some(piece), &[Role::Imposed]);
    let inside = together(together(inside, own), of_dual);
    match vanishing(functional, &[sum], &inside) {
        Ok((proof, needed)) if needed.is_empty() => Ok((proof, None)),
        Ok((proof, needed)) => Ok((proof, Some(format!("modulo {needed}")))),
        Err(_) => {
            let own = equations(functional, Some(piece), STATED);
            let all = together(own, equations(other, Some(piece), STATED));
            vanishing_difference(functional, sum, &[], &all)
        }
    }
}

/// Both; what one label names in either is one group: where one functional defines a field, an equation of the other's says nothing.
fn together(mut one: Vec<Group>, other: Vec<Group>) -> Vec<Group> {
    for group in other {
        match one.iter_mut().find(|own| own.label == group.label) {
            Some(own) if own.equations != group.equations => own.equations.extend(group.equations),
            Some(_) => {}
            None => one.push(group),
        }
    }
    one
}
