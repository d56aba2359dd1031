//! Motions of which the closure for almost every motion says nothing: those on which the conditions on κ lose their rank.
//!
//! κ is solved for where it is unique. If what it is there has no poles, it satisfies (12) and (13) on all motions, by continuity;
//! where it has, the motions on the poles are looked at as cases of their own.

use super::cases::{where_multipliers, Leaf};
use super::closed_form::closed;
use super::motion::Motion;
use super::stationary::{alternatives, moving_first, not_followed, set_aside_unconfirmed};
use super::Closure;
use crate::words::listed;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::Expr;
use std::sync::Arc;

/// Of which motions it is said that they make the action stationary.
#[derive(Clone, Debug)]
pub(crate) struct Exceptions {
    /// "every motion", "every motion with phi' ≠ 0", "almost every motion".
    pub(crate) every: String,
    /// What is known of the others, as the end of a sentence.
    pub(crate) others: String,
}

impl Exceptions {
    /// For the context's system, found once for all claims.
    pub(crate) fn of(cx: &Context<'_>, closure: &Closure) -> Arc<Exceptions> {
        cx.shared(|cx| Exceptions::new(cx, closure))
    }

    fn new(cx: &Context<'_>, closure: &Closure) -> Exceptions {
        let of = |every: &str, others: String| Exceptions {
            every: every.into(),
            others,
        };
        if closure.conditions.is_empty() {
            return of("every motion", String::new());
        }
        let motion = Motion::of(cx);
        let poles = motion.as_ref().as_ref().ok();
        let poles = poles.and_then(|motion| Some((motion, poles_of(cx, motion, closure)?)));
        let Some((motion, poles)) = poles else {
            let others =
                "; whether those on which the conditions on κ lose their rank do was not looked at";
            return of("almost every motion", others.into());
        };
        let g = &cx.system.graph;
        let time = [g.intern_symbol("t", 0)];
        let (of_time, poles): (Vec<Expr>, Vec<Expr>) =
            poles.into_iter().partition(|&e| g.contains_any(e, &time));
        if !of_time.is_empty() {
            // Motions pass such a place at an instant: they are not on it.
            let texts: Vec<String> = of_time
                .iter()
                .map(|&e| format!("{} = 0", g.text(e)))
                .collect();
            let others = format!(
                "; κ has a pole where {}, and only intervals without it are spoken of",
                texts.join(" or ")
            );
            return of("almost every motion", others);
        }
        if poles.is_empty() {
            return of("every motion", String::new());
        }
        let texts: Vec<String> = poles
            .iter()
            .map(|&e| format!("{} ≠ 0", g.text(e)))
            .collect();
        let every = format!("every motion with {}", listed(&texts));
        of(&every, on_poles(cx, motion, &poles))
    }
}

/// Factors that κ, where it is unique, or its ties are divided by, and that may vanish on a motion; `None` where that is not had in
/// closed form.
fn poles_of(cx: &Context<'_>, motion: &Motion, closure: &Closure) -> Option<Vec<Expr>> {
    let g = &cx.system.graph;
    let (mut state, known) = (motion.state(), assumptions(cx.system));
    state.push(g.intern_symbol("t", 0));
    let mut poles: Vec<Expr> = Vec::new();
    for (_, condition) in closure.solved(cx).ok()? {
        for e in condition.coefficients.into_iter().chain([condition.right]) {
            let value = closed(g, motion.on_states(g, e)).ok()?;
            for (factor, power) in factored(g, value)?.factors {
                let may_vanish = power < 0
                    && g.contains_any(factor, &state)
                    && !known_sign(g, factor, &known).is_nonzero();
                if may_vanish && !motion.poles.contains(&factor) && !poles.contains(&factor) {
                    poles.push(factor);
                }
            }
        }
    }
    Some(poles)
}

/// Which motions on the poles make the action stationary, in words.
fn on_poles(cx: &Context<'_>, motion: &Motion, poles: &[Expr]) -> String {
    let mut all = super::cases::Found::default();
    for &pole in poles {
        let mut found = where_multipliers(cx, motion, &[pole]);
        set_aside_unconfirmed(cx, motion, &mut found);
        all.leaves.extend(found.leaves);
        all.open.extend(found.open);
    }
    let open = not_followed(&all);
    let leaves = moving_first(&all);
    let moving: Vec<&Leaf> = leaves
        .iter()
        .copied()
        .filter(|leaf| !leaf.at_rest)
        .collect();
    let only = if all.open.is_empty() { "only " } else { "" };
    match (leaves.is_empty(), moving.is_empty()) {
        (true, _) if all.open.is_empty() => "; of the others none does".into(),
        (true, _) => format!("; of the others none was found to{open}"),
        (false, true) => format!(
            "; of the others {only}rest where {}{open}",
            alternatives(&leaves)
        ),
        (false, false) => format!(
            "; of the others {only}those where {}{open}",
            alternatives(&leaves)
        ),
    }
}
