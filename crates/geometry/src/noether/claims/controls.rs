//! What the laws that a model states for its controls add: the search and the verdicts are for any functions u(t) else.

use super::narrowed::in_system;
use crate::integrability::on_its_own;
use crate::noether::found::found;
use chetaev_mechanics::claims::{Context, Finding};
use chetaev_symbolic::Expr;

/// `u = sin(3 t)`, for the laws that a model states; `None` where it states none.
fn laws(cx: &Context<'_>) -> Option<String> {
    let g = &cx.system.graph;
    let laws = cx.system.laws_of_controls().into_iter();
    let laws = laws.map(|(control, law)| format!("{} = {}", g.text(control), g.text(law)));
    let laws: Vec<String> = laws.collect();
    (!laws.is_empty()).then(|| laws.join(", "))
}

/// The verdict on a stated integral where it is one for the laws that the model states, and not for all functions of the time.
pub(super) fn by_laws(cx: &Context<'_>, name: Option<&str>) -> Option<Finding> {
    let laws = laws(cx)?;
    let system = cx.system.for_laws_of_controls()?;
    let words = "it keeps its value on motions for the laws of the controls that the model states, not for all functions of the time";
    in_system(cx, name, &system, (&laws, words))
}

/// Which integrals there are for the laws stated that are not among those for all functions of the time, in words.
pub(super) fn for_laws(cx: &Context<'_>, general: &[Expr]) -> Option<String> {
    let all = for_any_functions(cx)?;
    let Some(laws) = laws(cx) else {
        return Some(all);
    };
    let system = cx.system.for_laws_of_controls()?;
    let g = &cx.system.graph;
    let own = on_its_own(cx, &system, |own| {
        let found = found(own);
        let found = found.as_ref().as_ref().ok()?;
        let shown = found.integrals.iter().map(|i| i.shown);
        Some(
            shown
                .filter(|e| !general.contains(e))
                .collect::<Vec<Expr>>(),
        )
    });
    let own: Vec<String> = own??.into_iter().map(|e| g.text(e)).collect();
    let more = match own.is_empty() {
        true => "no more".to_owned(),
        false => own.join(", "),
    };
    Some(format!("{all}; for {laws}, as the model states: {more}"))
}

/// That the controls that occur are any functions of the time.
fn for_any_functions(cx: &Context<'_>) -> Option<String> {
    let names: Vec<&str> = cx.system.controls.iter().map(|u| &u.name[..]).collect();
    match &names[..] {
        [] => None,
        [one] => Some(format!("this is for any function {one}(t)")),
        all => Some(format!(
            "this is for any functions {} of the time",
            all.join(", ")
        )),
    }
}
