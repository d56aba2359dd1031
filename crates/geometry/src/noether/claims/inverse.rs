//! `noether.inverse#NAME`: an integral that the model states is one, and its generator.

use super::controls::by_laws;
use super::domain::{lasting, nowhere, undefined_at_samples, where_defined, while_it_lasts};
use super::narrowed::{by_values_on_part, on_components};
use super::requirements;
use super::states::{on_part, on_positions, on_sides};
use super::symmetry::{symmetry, with_symmetry};
use super::trivial::{jumps, trivial, with_jumps};
use super::values::{by_definitions, by_values};
use crate::integrability::on_its_own;
use crate::noether::motion::Motion;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_symbolic::{Expr, Verdict};

/// `noether.inverse#NAME`.
#[derive(Clone, Copy, Debug)]
pub struct Inverse;

impl Claim for Inverse {
    fn id(&self) -> &'static str {
        "noether.inverse"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "An integral of the model is a first integral, with its symmetry"
    }

    fn explanation(&self) -> &'static str {
        "A function G stated under [integrals] keeps its value along every motion: X̄G = 0 on the constraint manifold. If so, the inverse of \
         Noether's theorem gives its field: χ = -W̄⁻¹ ∂G, here with δ = 0, and the gauge g = G + p χ; the Killing-type equations are \
         proved for them. `conditional` says that it is one for parameters as the model defines them by others, not for \
         independent ones, or for the values or the laws of controls that it states, or as long as the function does not jump, or on the part of the states that \
         the model states with `on`, which is proved to be invariant, or on one component of constraints that are products, or on one \
         side of the corners of constraints; the field is given and its equations are proved for these. `refuted` comes with an \
         admissible state at which G has a real value and its rate is not zero, or, where motions leave the part stated with `on`, its second or third \
         derivative in time; `not-applicable` says that G has no real value at any state, that no state is as `on` states, or that \
         motions leave such states, which says nothing of G. G is trivial where the constraints fix its value."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let stated = cx.system.integrals.iter();
        stated.map(|(name, _)| Some(name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let mut stated = cx.system.integrals.iter();
        let Some((_, value)) = stated.find(|(name, _)| Some(name.as_str()) == subject) else {
            return Verdict::undecided("the model states no integral of this name").into();
        };
        if let Some(foreign) = beside_state(cx, *value) {
            let detail = format!("`{foreign}` occurs in it, which is not of (t, q, v)");
            return Verdict::not_applicable("the function is one of the state", detail).into();
        }
        if let Some(verdict) = nowhere(cx, *value) {
            return verdict.into();
        }
        let motion = match Motion::of(cx) {
            Ok(motion) => motion,
            Err(why) => return Verdict::undecided(why).into(),
        };
        let jumps = jumps(cx, &motion, *value);
        let mut found = decided(cx, &motion, subject, *value, &jumps);
        if let Verdict::Refuted(_) = &found.verdict {
            let defined = decided_where_defined(cx, subject, *value, &jumps);
            found = defined.unwrap_or(found);
        }
        if !matches!(found.verdict, Verdict::Refuted(_)) {
            if let Some(verdict) = undefined_at_samples(cx, &motion, *value) {
                return verdict.into();
            }
        }
        Finding {
            verdict: with_jumps(found.verdict, &jumps),
            formulas: found.formulas,
        }
    }
}

/// The verdict under the assumption that the function has a real value; `None` where nothing has to be assumed for it. Its rate may
/// have a value where it has none, as that of log(x) has for x < 0, which refutes nothing.
fn decided_where_defined(
    cx: &Context<'_>,
    name: Option<&str>,
    value: Expr,
    jumps: &[String],
) -> Option<Finding> {
    let (system, condition) = where_defined(cx, value)?;
    let decided = on_its_own(cx, &system, |own| {
        let motion = Motion::of(own).ok()?;
        Some(decided(own, &motion, name, value, jumps))
    });
    let found = decided.flatten().unwrap_or_else(|| {
        Verdict::undecided("the motion under this assumption could not be computed").into()
    });
    Some(match found.verdict {
        Verdict::Refuted(_) => found,
        other => Finding {
            verdict: other.prefixed(&format!("it has a real value where {condition} only")),
            formulas: found.formulas,
        },
    })
}

/// The verdict on a function of the state, and its symmetry where it is an integral.
fn decided(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    name: Option<&str>,
    value: Expr,
    jumps: &[String],
) -> Finding {
    match motion.is_integral(cx, value) {
        Verdict::Proved(proof) => match trivial(cx, motion, value, &proof) {
            Some(verdict) => verdict.into(),
            None => {
                let lasting = lasting(cx, value);
                let words = match (&lasting, jumps.is_empty()) {
                    (_, false) => "it keeps its value on motions where it does not jump".into(),
                    (Some(lasting), _) => format!("it keeps its value while {lasting}"),
                    (None, _) => "it keeps its value on every motion".to_owned(),
                };
                let mut verdict = Verdict::Proved(proof).prefixed(&words);
                while_it_lasts(&mut verdict, lasting.as_ref());
                let (killing, formulas) = symmetry(cx, value);
                let killing = killing.prefixed("the Killing-type equations hold for its symmetry");
                Finding {
                    verdict: verdict.and(killing),
                    formulas,
                }
            }
        },
        // The constraints are a product.
        found @ Verdict::Conditional { .. } => {
            let words = "it keeps its value as long as the motion stays on one component of the constraints";
            with_symmetry(found.prefixed(words), Some(symmetry(cx, value)))
        }
        other => on_stated_part(cx, motion, name, value)
            .or_else(|| on_sides(cx, value))
            .or_else(|| on_components(cx, name))
            .or_else(|| by_definitions(cx, motion, value))
            .or_else(|| by_values(cx, motion, value))
            .or_else(|| on_positions(cx, motion, value))
            .or_else(|| by_laws(cx, name))
            .unwrap_or_else(|| {
                let words = match other {
                    Verdict::Refuted(_) => "it changes on motions",
                    _ => "whether the rate of the function vanishes on motions",
                };
                other.prefixed(words).into()
            }),
    }
}

/// The verdict on the part that the model states; where it is refuted there, for stated values or laws or on a component.
fn on_stated_part(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    name: Option<&str>,
    value: Expr,
) -> Option<Finding> {
    let own = on_part(cx, motion, name, value)?;
    if !matches!(own.verdict, Verdict::Refuted(_)) {
        return Some(own);
    }
    let narrowed = by_values_on_part(cx, motion, name, value)
        .or_else(|| by_laws(cx, name))
        .or_else(|| on_components(cx, name));
    Some(narrowed.unwrap_or(own))
}

/// What occurs in a function beside the state (t, q, v) and parameters: an acceleration, a reaction.
fn beside_state(cx: &Context<'_>, e: Expr) -> Option<String> {
    let g = &cx.system.graph;
    let known = |name: &str| {
        name == "t" || cx.system.moves(name) || cx.system.parameters.iter().any(|p| p.name == name)
    };
    let mut symbols = g.symbols_in(&[e]).into_iter();
    let foreign = symbols.find(|&s| !known(g.symbol_name(s)) || g.symbol_order(s) >= 2)?;
    Some(g.text(g.symbol_expr(foreign)))
}
