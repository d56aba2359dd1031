//! The constrained extremum beside the motion: another curve from the same state (T1 §4.1).

use crate::derivation::check_applies;
use crate::options::Hooks;
use crate::study::integrate;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::Vakonomic;
use chetaev_mechanics::{Context, Formulation};
use chetaev_motion::observe::Observer;
use chetaev_motion::{Run, RunSettings, Subject};
use chetaev_principles::stationarity::Closure;

/// A run of the constrained extremum.
#[derive(Clone, Debug)]
pub struct Beside {
    /// The run, at the times of the motion.
    pub run: Run,
    /// κ(0) by name.
    pub kappa: Vec<(String, f64)>,
    /// Whether κ(0) is that with which `hamilton.stationary` finds every motion to be an extremal.
    pub is_of_motion: bool,
    /// The largest distance of the two curves in coordinates, the coordinate, and when.
    pub distance: (f64, String, f64),
}

/// Integrates the extremum from the start of a run.
pub(crate) fn of(
    cx: &Context<'_>,
    subject: &Subject<'_>,
    motion: &Run,
    settings: &RunSettings,
    given: &[(String, f64)],
    hooks: &mut Hooks<'_>,
) -> Result<Beside, String> {
    check_applies(cx, Vakonomic.card()).map_err(|problem| problem.to_string())?;
    let system = cx.system;
    let known = at_start(cx, subject, motion);
    let names = system
        .constraints
        .iter()
        .map(|c| unused_name(system, &format!("kappa_{}", c.name)));
    let stated = |name: &String| {
        let all = given.iter().chain(&settings.own);
        all.clone().find(|(own, _)| own == name).map(|(_, x)| *x)
    };
    let names: Vec<String> = names.collect();
    if let Some((wrong, _)) = given.iter().find(|(name, _)| !names.contains(name)) {
        return Err(format!(
            "`{wrong}` is no multiplier of the extremum; these are {}",
            chetaev_mechanics::words::quoted(&names)
        ));
    }
    let is_of_motion = known.is_some() && names.iter().all(|name| stated(name).is_none());
    let kappa: Vec<(String, f64)> = names
        .into_iter()
        .enumerate()
        .map(|(l, name)| {
            let of_motion = known.as_ref().and_then(|known| known.get(&l).copied());
            let value = stated(&name).or(of_motion).unwrap_or(0.0);
            (name, value)
        })
        .collect();
    let settings = RunSettings {
        own: kappa.clone(),
        keep: Vec::new(),
        ..settings.clone()
    };
    let what = "integrating the constrained extremum";
    let run = integrate(subject, &Vakonomic, &settings, what, hooks)
        .map_err(|problem| problem.to_string())?;
    Ok(Beside {
        distance: distance(cx, motion, &run),
        run,
        kappa,
        is_of_motion,
    })
}

/// κ at the start where it is a unique function of the state for every motion, by index of the constraint.
fn at_start(
    cx: &Context<'_>,
    subject: &Subject<'_>,
    motion: &Run,
) -> Option<std::collections::BTreeMap<usize, f64>> {
    let closure = Closure::of(cx);
    let closure = closure.as_ref().as_ref().ok()?;
    let kappa: Option<Vec<_>> = closure.kappa.iter().copied().collect();
    let is_everywhere = matches!(closure.verdict, chetaev_symbolic::Verdict::Proved(_));
    let kappa = kappa.filter(|_| is_everywhere && !motion.is_empty())?;
    let mut observer = Observer::new(cx.system, cx.terms, subject.binding, &kappa).ok()?;
    let values = observer.at(motion.times[0], motion.row(0));
    let rows = cx.selection.rows.iter();
    let indices = rows.map(|&row| cx.terms.constraint_index[row]);
    let all = indices.zip(values).collect();
    Some(all)
}

fn distance(cx: &Context<'_>, a: &Run, b: &Run) -> (f64, String, f64) {
    let mut largest = (0.0, String::new(), a.times.first().copied().unwrap_or(0.0));
    for j in 0..a.asked().min(b.asked()) {
        let (x, y) = (a.row(j), b.row(j));
        for (c, i) in cx.system.coordinates.iter().zip(a.layout.q()) {
            let gap = (x[i] - y[i]).abs();
            if gap > largest.0 {
                largest = (gap, c.name.clone(), a.times[j]);
            }
        }
    }
    largest
}
