//! `functional.duality`: two functionals add up to a divergence, and to nothing with their boundary terms.

use super::modulo::{equations, labels, other_body, vanishing, vanishing_difference, STATED};
use super::{Claim, Context, Finding, Formula};
use crate::elimination::Group;
use crate::functional::{Functional, Relation, Role, Side};
use crate::read::on_side;
use crate::variation::euler_expression;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

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
        "The sum of the two densities of the interior is a divergence if its Euler expressions vanish identically. With a stated flux W \
         the sum is proved to be D_i W_i, and on every piece n_i W_i and the two boundary densities must add up to zero, which makes the \
         sum of the functionals zero for all fields that both admit. Where it vanishes on a piece only because of field equations, or as a \
         product of two conditions, the verdict names the fewest that are needed."
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
            Some((own, other, Some((written, flux)))) => with_flux(own, other, written, flux),
            Some((own, other, None)) => without_flux(own, other).into(),
            None => Verdict::undecided("no dual functional is stated").into(),
        }
    }
}

fn without_flux(functional: &Functional, other: &Functional) -> Verdict {
    let space = &*functional.space;
    let sum = space.graph.add(&[functional.density, other.density]);
    let jets = space.jets_in(&[sum]);
    let mut components: Vec<usize> = jets.into_iter().map(|jet| jet.component).collect();
    components.dedup();
    let own: Vec<Expr> = components
        .iter()
        .map(|&c| euler_expression(space, sum, c))
        .collect();
    match space.vanishing(&own, true) {
        Verdict::Proved(proof) => Verdict::Proved(Proof {
            on: "all fields".into(),
            detail: format!(
                "the sum of the densities of {} and {} has no Euler expression, so that it is a divergence; the boundary was not compared, as no flux is stated",
                functional.name, other.name
            ),
            ..proof
        }),
        verdict => verdict.prefixed("the sum of the densities is not a divergence"),
    }
}

fn with_flux(functional: &Functional, other: &Functional, written: &str, flux: &[Expr]) -> Finding {
    let space = &*functional.space;
    let g = &space.graph;
    let mut terms = vec![functional.density, other.density];
    for (axis, &w) in flux.iter().enumerate() {
        terms.push(g.neg(space.total(w, axis)));
    }
    let mut notes = Vec::new();
    // Both functionals are of fields that both admit.
    let own = equations(functional, None, &[Role::Imposed]);
    let imposed = together(own, equations(other, None, &[Role::Imposed]));
    let mut all = match vanishing(functional, &[g.add(&terms)], &imposed) {
        Ok((proof, needed)) => {
            if !needed.is_empty() {
                notes.push(format!("in the interior modulo {}", labels(&needed)));
            }
            Verdict::Proved(proof)
        }
        Err(verdict) => {
            let what = format!("the sum of the densities is not the divergence of {written}");
            return (*verdict).prefixed(&what).into();
        }
    };
    let mut formulas = Vec::new();
    for piece in &functional.pieces {
        let Some(dual) = other.piece(&piece.name) else {
            return Verdict::undecided(format!("`{}` has no piece {}", other.name, piece.name))
                .into();
        };
        let through = match piece.side {
            Side::Curved => {
                let own = space.normal().into_iter().zip(flux);
                own.map(|(n, &w)| g.mul(&[n, w])).collect()
            }
            Side::Flat { axis, is_upper, .. } => match flux.get(axis) {
                Some(&w) if is_upper => vec![w],
                Some(&w) => vec![g.neg(w)],
                None => Vec::new(),
            },
        };
        let mut terms: Vec<Expr> = through;
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
                return (*verdict).prefixed(&what).into();
            }
        }
    }
    let verdict = match all {
        Verdict::Proved(proof) => Verdict::Proved(Proof {
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
        other => other,
    };
    Finding { verdict, formulas }
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
        Ok((proof, needed)) => Ok((proof, Some(format!("modulo {}", labels(&needed))))),
        Err(_) => {
            let own = equations(functional, Some(piece), STATED);
            let all = together(own, equations(other, Some(piece), STATED));
            vanishing_difference(functional, sum, &[], &all)
        }
    }
}

/// Both, what has the same label once.
fn together(mut one: Vec<Group>, other: Vec<Group>) -> Vec<Group> {
    for group in other {
        if one.iter().all(|own| own.label != group.label) {
            one.push(group);
        }
    }
    one
}
