//! Routh's equations for many starts and many values of the parameters: derived and compiled once.

use crate::follow::Follow;
use crate::functions::FunctionsError;
use crate::keep::Keep;
use crate::multiplier_flow::{MultiplierFlow, StateKind};
use crate::numeric::NumericSystem;
use crate::projection::Projection;
use crate::run::{End, Looking, Run, RunError, RunSettings, Subject, Watcher};
use crate::stop;
use crate::watch::Watch;
use chetaev_integrate::method;

/// Routh's equations with all that a run of them needs, compiled; a copy for each thread.
///
/// A run from it has the bits of [`Subject::routh`], whichever runs went before.
#[derive(Clone, Debug)]
pub struct CompiledRouth {
    pub(crate) flow: MultiplierFlow,
    pub(crate) looking: Looking,
}

impl CompiledRouth {
    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`] where they make a linear system singular.
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.flow.set_parameters(values)?;
        let mut observers = self.looking.observers.iter_mut();
        observers.try_for_each(|observer| observer.set_parameters(values))
    }

    /// The numeric system with the present parameters, to look for consistent states with.
    pub fn numeric(&mut self) -> &mut NumericSystem {
        self.flow.system_mut()
    }
}

impl Subject<'_> {
    /// Compiles Routh's equations, the watch on their singular set, events, and what is followed and kept; the start of the
    /// subject does not matter.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn compile_routh(&self, settings: &RunSettings) -> Result<CompiledRouth, RunError> {
        let watch = Watch::new(self.system, self.terms, self.binding)?;
        let mut flow = MultiplierFlow::idle(self.numeric.clone(), watch);
        let residuals = self.residuals();
        if !settings.follow.is_empty() {
            let followed = [settings.follow.clone(), residuals.clone()].concat();
            let variables = &self.binding.variables;
            let follow = Follow::compile(self.system, self.binding, variables, &followed)?;
            flow.follow = Some(follow);
        }
        if !settings.keep.is_empty() {
            let quantities = (&residuals[..], &settings.keep[..]);
            flow.keep = Some(Keep::new(self.system, self.binding, quantities)?);
        }
        Ok(CompiledRouth {
            flow,
            looking: self.looking(settings, &[])?,
        })
    }

    /// Which variables are integrated. Independent velocities alone hide the error of the others, which is larger by the
    /// inverse of a pivot where a step comes near a singular place of their chart; and a step of the Taylor method is so long
    /// that it may pass one, while the series of all velocities are known anyway. So all velocities are integrated, and
    /// constraints are kept by projection. Those that jump are followed in charts.
    pub(crate) fn variables(&self, settings: &RunSettings) -> StateKind {
        let has_series = method(&settings.method).is_ok_and(|method| method.card().needs_series);
        let needs_all = has_series || !settings.keep.is_empty();
        match settings.state {
            _ if needs_all && !self.numeric.jumps => StateKind::Full,
            Some(stated) => stated,
            None if self.numeric.jumps => StateKind::Reduced,
            None => StateKind::Full,
        }
    }

    /// Integrates Routh's equations.
    ///
    /// # Errors
    /// [`RunError`] when the run cannot begin; what happens later is in [`Run::ending`].
    pub fn routh(
        &self,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let mut compiled = self.compile_routh(settings)?;
        self.routh_by(&mut compiled, settings, watcher)
    }

    /// Integrates Routh's equations, compiled before with the same settings but for times, span, tolerances and steps.
    ///
    /// # Errors
    /// As [`routh`](Subject::routh).
    pub fn routh_by(
        &self,
        compiled: &mut CompiledRouth,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let CompiledRouth { flow, looking } = compiled;
        flow.begin(
            self.start,
            self.variables(settings),
            Projection::of(settings),
        );
        let watched = flow.watch.quantities.clone();
        let y0 = flow.pack(&self.start.q, &self.start.v);
        let (pieces, end) = self.watched(flow, &watched, y0, settings, (looking, watcher))?;
        let ending = match end {
            End::Vanished(ending) | End::Happened(ending) => ending,
            End::Stopped(stop, t, y) => {
                let pivot = flow.pivot_ratio(t, &y);
                let (kind, chart) = (flow.kind(), flow.chart());
                let names = stop::Names {
                    coordinates: &self.numeric.coordinates,
                    constraints: &self.numeric.constraints,
                    state: stop::component_names(self.numeric, kind, chart),
                    unknowns: None,
                    matrix: None,
                };
                stop::ending(&stop, &names, pivot)
            }
        };
        let measured = flow.kind() == StateKind::Full || !self.numeric.holonomic.is_empty();
        let drift = (self.numeric.r > 0 && measured).then(|| flow.drift.clone());
        let kept = flow.keep.as_ref().map(|keep| keep.report().clone());
        let run = self.collect(
            "routh",
            (flow.layout(), Vec::new()),
            settings,
            (pieces, watched.len()),
            ending,
            (drift, flow.follow.as_ref()),
        );
        Ok(Run { kept, ..run })
    }
}
