//! Work that another thread watches: it stops when somebody interrupts, or when it takes far more time than it should.

use crate::options::Hooks;
use chetaev_symbolic::meter::{within, Stopped, Work};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::time::Duration;

/// How often the watcher looks.
const LOOKS: Duration = Duration::from_millis(20);

/// Ends the watching also where what is watched unwinds.
struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Does something while another thread stops `work` when it is interrupted, or when the clock passes `deadline`. Where no thread can be
/// made, as in a browser, nobody watches.
pub(crate) fn watched<T>(
    hooks: &mut Hooks<'_>,
    work: &Arc<Work>,
    deadline: Option<f64>,
    what: impl FnOnce(&mut Hooks<'_>) -> T,
) -> T {
    watched_patiently(hooks, work, deadline, 0, what)
}

/// [`watched`], where an interruption stops the work only after so many further looks: what ends by itself then has ended.
fn watched_patiently<T>(
    hooks: &mut Hooks<'_>,
    work: &Arc<Work>,
    deadline: Option<f64>,
    patience: u32,
    what: impl FnOnce(&mut Hooks<'_>) -> T,
) -> T {
    let (clock, interrupt) = (hooks.clock, hooks.interrupt);
    let ended = AtomicBool::new(false);
    let watch = || {
        let mut looks = 0;
        while !ended.load(Ordering::Relaxed) {
            if interrupt.is_some_and(|i| i.load(Ordering::Relaxed)) {
                if looks >= patience {
                    work.stop(Stopped::Interrupted);
                }
                looks += 1;
            }
            if deadline.is_some_and(|deadline| clock() > deadline) {
                work.stop(Stopped::Late);
            }
            std::thread::park_timeout(LOOKS);
        }
    };
    std::thread::scope(|scope| {
        let watcher = std::thread::Builder::new().spawn_scoped(scope, watch);
        let watcher = watcher.ok();
        let end = Ended(&ended);
        let found = what(hooks);
        drop(end);
        if let Some(watcher) = watcher {
            watcher.thread().unpark();
        }
        found
    })
}

/// Does something that only an interruption ends.
///
/// # Errors
/// That it was interrupted.
pub fn interruptible<T>(
    hooks: &mut Hooks<'_>,
    what: impl FnOnce(&mut Hooks<'_>) -> T,
) -> Result<T, Stopped> {
    let work = Work::unlimited();
    watched(hooks, &work, None, |hooks| within(&work, || what(hooks)))
}

/// [`interruptible`] for what looks at the interruption itself and ends then with what it has: it is stopped only where it does not.
///
/// # Errors
/// That it was interrupted and did not end.
pub(crate) fn ending<T>(
    hooks: &mut Hooks<'_>,
    what: impl FnOnce(&mut Hooks<'_>) -> T,
) -> Result<T, Stopped> {
    let work = Work::unlimited();
    watched_patiently(hooks, &work, None, PATIENCE, |hooks| {
        within(&work, || what(hooks))
    })
}

/// Looks before what does not end is stopped.
const PATIENCE: u32 = 5;

/// Does something after an interruption for which little time is left: seconds of the clock, or as long as it takes where nobody
/// interrupted. `None` where that was not enough.
pub fn in_time<T>(hooks: &mut Hooks<'_>, seconds: f64, what: impl FnOnce() -> T) -> Option<T> {
    if !is_interrupted(hooks) {
        return Some(what());
    }
    let work = Work::unlimited();
    let deadline = (hooks.clock)() + seconds;
    // The interruption is known.
    let interrupt = hooks.interrupt.take();
    let found = watched(hooks, &work, Some(deadline), |_| within(&work, what));
    hooks.interrupt = interrupt;
    found.ok()
}

/// Whether somebody interrupted.
pub(crate) fn is_interrupted(hooks: &Hooks<'_>) -> bool {
    hooks.interrupt.is_some_and(|i| i.load(Ordering::Relaxed))
}
