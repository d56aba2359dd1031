//! `functional.legendre`: stated constitutive functions are Legendre conjugates.

use super::{Claim, Context, Finding};
use crate::functional::Constitutive;
use crate::space::Space;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// `functional.legendre#B`.
pub(super) struct Legendre;

impl Claim for Legendre {
    fn id(&self) -> &'static str {
        "functional.legendre"
    }

    fn title(&self) -> &'static str {
        "Two constitutive functions are Legendre conjugates"
    }

    fn explanation(&self) -> &'static str {
        "For functions A(e) and B(s) stated by formulas: B'(A'(e)) = e and A(e) + B(A'(e)) = A'(e) e, by exact arithmetic. All other \
         proofs use of the two functions nothing but this relation. Where one of them has no formula, the relation is an \
         assumption of the model and there is nothing to decide."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let stated = cx
            .functional()
            .functions
            .iter()
            .filter(|f| f.conjugate.is_some());
        stated.map(|f| Some(f.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let functional = cx.functional();
        let space = &*functional.space;
        let g = &space.graph;
        let own = functional
            .functions
            .iter()
            .find(|f| Some(f.name.as_str()) == subject);
        let Some(own) = own else {
            return Verdict::undecided("there is no such function").into();
        };
        let dual = space.function_at(own.function);
        let Some(other) = dual.conjugate else {
            return Verdict::undecided("it has no conjugate").into();
        };
        let slots = space.slots(own.function);
        let body = |function: usize, by: &[usize], at: &[Expr]| space.body(function, by, at);
        let gradient: Option<Vec<Expr>> = (0..slots.len())
            .map(|k| body(other, &[k], &slots))
            .collect();
        let (Some(gradient), Some(value)) = (gradient, body(other, &[], &slots)) else {
            return assumed(space.function_at(other).name.as_str(), &own.name);
        };
        let Some(image) = body(own.function, &[], &gradient) else {
            return assumed(&own.name, &own.name);
        };
        let mut residuals: Vec<Expr> = Vec::new();
        for (k, &slot) in slots.iter().enumerate() {
            residuals.extend(body(own.function, &[k], &gradient).map(|e| g.sub(e, slot)));
        }
        let mut terms = vec![value, image];
        for ((&x, &y), &m) in slots.iter().zip(&gradient).zip(&dual.multiplicities) {
            terms.push(g.neg(g.mul(&[g.integer(m), x, y])));
        }
        residuals.push(g.add(&terms));
        let (verdict, on) = match space.vanishing(&residuals, true) {
            proved @ Verdict::Proved(_) => (
                proved,
                "all arguments for which both functions are defined".to_owned(),
            ),
            open => on_image(space, own, &residuals).map_or((open, String::new()), |proof| {
                let on = format!(
                    "all arguments that are values of the gradient of {}",
                    own.name
                );
                (Verdict::Proved(proof), on)
            }),
        };
        match verdict {
            Verdict::Proved(proof) => Verdict::Proved(Proof {
                on,
                detail: format!(
                    "the gradients of {} and {} undo each other, and both functions add up to the product",
                    space.function_at(other).name,
                    own.name
                ),
                ..proof
            }),
            other => other,
        }
        .into()
    }
}

/// The proof at arguments that are values of the function's own gradient: inverse functions undo each other there.
fn on_image(space: &Space, own: &Constitutive, residuals: &[Expr]) -> Option<Proof> {
    let g = &space.graph;
    let slots = space.slots(own.function);
    let image: Option<Vec<Expr>> = (0..slots.len())
        .map(|k| space.body(own.function, &[k], &slots))
        .collect();
    let image = image?;
    let moved: Vec<Expr> = residuals
        .iter()
        .map(|&e| {
            space.replace(e, &|symbol| {
                let at = slots.iter().position(|&s| g.as_symbol(s) == Some(symbol))?;
                image.get(at).copied()
            })
        })
        .collect();
    match space.vanishing(&moved, true) {
        Verdict::Proved(proof) => Some(proof),
        _ => None,
    }
}

fn assumed(without: &str, subject: &str) -> Finding {
    Verdict::not_applicable(
        format!("functional.legendre#{subject}"),
        format!("`{without}` has no formula, so the relation is assumed by the model"),
    )
    .into()
}
