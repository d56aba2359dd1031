//! The constrained extremum beside the motion: another curve from the same state (T1 §4.1).

mod words;

pub(crate) use words::{number, told};

use crate::derivation::check_applies;
use crate::options::Hooks;
use crate::study::integrate;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::Vakonomic;
use chetaev_mechanics::{Context, Formulation};
use chetaev_model::Model;
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
    /// Whether some κ(0) was stated, by the model or on the command line.
    pub is_stated: bool,
    /// How far the two curves are apart, coordinate by coordinate.
    pub gaps: Vec<Gap>,
}

/// The distance of the two curves in one coordinate.
#[derive(Clone, Debug)]
pub struct Gap {
    /// The coordinate, by its place in the system.
    pub coordinate: usize,
    /// |motion − extremum| at the times of the motion, as long as both go.
    pub values: Vec<f64>,
    /// The largest magnitude of the coordinate on either curve, and its natural size.
    pub size: f64,
}

impl Gap {
    /// The largest distance and its row.
    pub fn largest(&self) -> (usize, f64) {
        let rows = self.values.iter().copied().enumerate();
        rows.fold((0, 0.0), |most, (j, gap)| {
            match gap.total_cmp(&most.1).is_gt() {
                true => (j, gap),
                false => most,
            }
        })
    }
}

/// Whether a name is `kappa_` and the name of a constraint; where the model uses that name for something else, more follows.
pub fn is_multiplier(model: &Model, name: &str) -> bool {
    let own = name.strip_prefix("kappa_");
    own.is_some_and(|own| model.constraints.iter().any(|c| own.starts_with(&c.name)))
}

/// Tolerances that two runs of one curve may differ by, relative to the size of the coordinate.
const TOLERANCES: f64 = 1e3;

impl Beside {
    /// Whether the curves are one, as far as runs of this tolerance can tell: without a common time after the start they cannot.
    pub fn agree(&self, tolerance: f64) -> bool {
        let within = |gap: &Gap| gap.largest().1 <= TOLERANCES * tolerance * gap.size;
        !self.gaps.is_empty() && self.gaps.iter().all(within)
    }
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
    let is_stated = names.iter().any(|name| stated(name).is_some());
    let is_of_motion = known.is_some() && !is_stated;
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
        gaps: gaps(cx, motion, &run),
        run,
        kappa,
        is_of_motion,
        is_stated,
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

/// The distances at the times that both runs have; none where they have none after the start.
fn gaps(cx: &Context<'_>, a: &Run, b: &Run) -> Vec<Gap> {
    let shared = a.asked().min(b.asked());
    if a.times[..shared].first() == a.times[..shared].last() {
        return Vec::new();
    }
    let places = a.layout.q().take(cx.system.n()).enumerate();
    places
        .map(|(coordinate, i)| {
            let natural = a.scales.get(coordinate).copied().unwrap_or(1.0);
            let pairs = (0..shared).map(|j| (a.row(j)[i], b.row(j)[i]));
            Gap {
                coordinate,
                values: pairs.clone().map(|(x, y)| (x - y).abs()).collect(),
                size: pairs.fold(natural, |most, (x, y)| most.max(x.abs()).max(y.abs())),
            }
        })
        .collect()
}
