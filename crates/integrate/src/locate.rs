//! Search for the zeros of switching functions inside one step.

use crate::dense::DenseStep;
use crate::event::Event;
use crate::integrate::Options;
use crate::method::State;
use crate::problem::System;
use crate::solution::{Solution, Stop};

/// Working storage of the search.
pub(crate) struct Locator {
    evaluations: u64,
}

impl Locator {
    pub(crate) fn new(_n: usize, _events: usize, _options: &Options<'_>) -> Locator {
        Locator { evaluations: 0 }
    }

    pub(crate) fn evaluations(&self) -> u64 {
        self.evaluations
    }

    pub(crate) fn locate(
        &mut self,
        _system: &mut dyn System,
        _events: &mut [Event<'_>],
        _step: (&State, &mut State, &DenseStep),
        _t_end: f64,
        _solution: &mut Solution,
    ) -> Result<Option<Stop>, Stop> {
        Ok(None)
    }
}
