//! A functional studied within a budget, while another thread looks at the clock and at Ctrl-C.

use crate::options::Hooks;
use crate::watch::watched;
use chetaev_functionals::functional::Problem;
use chetaev_functionals::{study_at, Pace, Study};
use chetaev_symbolic::meter::Work;

/// How much more time than its budget the work may take on a slow machine.
const LATE: f64 = 2.0;

/// Decides the claims that `wants` accepts; `budget` is the work of all of them in seconds.
pub fn studied(
    problem: Problem,
    wants: &dyn Fn(&str) -> bool,
    budget: f64,
    hooks: &mut Hooks<'_>,
) -> Study {
    let work = Work::of_seconds(budget);
    let deadline = (hooks.clock)() + LATE * budget;
    watched(hooks, &work, Some(deadline), |hooks| {
        let clock = hooks.clock;
        let tell = &mut *hooks.progress;
        let pace = Pace {
            budget,
            work: work.clone(),
            clock,
            progress: &mut |what| tell(what, None),
        };
        study_at(problem, wants, pace)
    })
}
