//! A pair of imaginary eigenvalues in a reversible system (Devaney 1976; Arnold and Sevryuk 1986).
//!
//! A change of one sign among the variables turns all motions round in time and leaves the steady one as it is. The variables are the two of the pair and
//! those of the family of steady motions, which is left as it is. Near the family a motion turns about it, so that it meets the mirror, the
//! set that the change leaves as it is, after each half turn; and a motion that meets the mirror twice is closed. All near motions are closed, and
//! the steady one is stable.

use crate::about::About;
use crate::question::Place;
use crate::theorem::{Answer, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;

/// The motion is a centre by reversal.
pub(crate) struct Reversal;

impl Method for Reversal {
    fn answer(&self, about: &About<'_>, place: Place, _: Option<&RBig>) -> Answer {
        let question = &about.question;
        let is_pair = question
            .spectrum
            .paired
            .as_ref()
            .is_some_and(|own| own.len() == 3);
        let polynomial = question.polynomial.as_ref();
        let is_whole = polynomial.is_some_and(|own| own.degree() == 2 && own.further_zeros == 0);
        if place != Place::OnAxis || !is_pair || !is_whole {
            return Answer::NotApplicable;
        }
        let mirror = about.once(|| mirror(about));
        match mirror.as_ref() {
            Some(name) => Answer::Stable(format!("by reversal: the equations stay as they are where {name} and the time change their signs, and the only eigenvalues besides the zeros of the family are a pair on the axis, so that all near motions are closed (Devaney)")),
            None => Answer::NotApplicable,
        }
    }
}

/// The variable whose change of sign turns all motions round.
fn mirror(about: &About<'_>) -> Option<String> {
    let (g, own) = (about.graph(), &about.expansion);
    let characteristics = &own.own.characteristics;
    // With finite constraints a change of one coordinate alone leaves their manifold.
    if !own.finite().is_empty() || !characteristics.manifold.implicit.is_empty() || !own.is_smooth()
    {
        return None;
    }
    let rates = [own.own.rates.clone(), own.own.equations.rates(g)?].concat();
    let rates = g.substitute_all(&rates, &own.controls(&rates));
    let rates = g.substitute_all(&rates, &own.values);
    let variables = own.variables();
    let values = own.values_of_variables();
    let is_mirror = |&turned: &usize| {
        let symbol = g.symbol_expr(variables[turned]);
        // About the value at the motion: 2 z⁰ − z.
        let image = g.sub(g.mul(&[g.integer(2), values[turned]]), symbol);
        let there = g.substitute_all(&rates, &[(symbol, image)]);
        let sums = there.iter().zip(&rates).enumerate();
        let residuals: Vec<Expr> = sums
            .map(|(place, (&there, &here))| {
                if place == turned {
                    g.sub(there, here)
                } else {
                    g.add(&[there, here])
                }
            })
            .collect();
        own.vanish(&residuals)
    };
    let found = (0..variables.len()).find(is_mirror)?;
    Some(own.name_of(found, variables[found]))
}
