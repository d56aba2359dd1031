//! Long work on a thread of its own, while the thread of Python hears signals and shows progress.

use crate::annotations::Tell;
use chetaev::study::{interruptible, Hooks};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How often signals are looked at.
const LOOKS: Duration = Duration::from_millis(20);
/// As large as that of a usual main thread.
const STACK: usize = 8 << 20;

/// What was done, and whether Ctrl-C ended it.
pub(crate) struct Done<T> {
    /// What the work gave.
    pub(crate) result: T,
    /// Whether it was interrupted; what it gave is then what there was.
    pub(crate) interrupted: bool,
}

/// Does work of which nothing is kept where Ctrl-C came: it is stopped wherever it counts what it does, and what ended nevertheless is not given.
///
/// # Errors
/// `KeyboardInterrupt`, and as [`done`].
pub(crate) fn whole<T: Send>(
    py: Python<'_>,
    tell: Option<Tell<'_, '_>>,
    work: impl FnOnce(&mut Hooks<'_>) -> T + Send,
) -> PyResult<T> {
    let found = done(py, tell, |hooks| interruptible(hooks, work))?;
    let is_whole = !found.interrupted;
    let result = found.result.ok().filter(|_| is_whole);
    result.ok_or_else(|| PyKeyboardInterrupt::new_err(()))
}

/// Does `work` without holding the interpreter; what it gave until Ctrl-C is the caller's to keep. `tell` is called with what is being done and which part of it is done, in [0, 1] or `None`.
///
/// # Errors
/// An exception of `tell` or of a handler of signals, other than `KeyboardInterrupt`; a panic of the work.
pub(crate) fn done<T: Send>(
    py: Python<'_>,
    tell: Option<Tell<'_, '_>>,
    work: impl FnOnce(&mut Hooks<'_>) -> T + Send,
) -> PyResult<Done<T>> {
    let interrupt = AtomicBool::new(false);
    let told: Mutex<Option<(String, Option<f64>)>> = Mutex::new(None);
    let latest = || told.lock().unwrap_or_else(PoisonError::into_inner).take();
    let mut thrown = None;
    let mut interrupted = false;
    let result = std::thread::scope(|scope| {
        let (done, mut waits) = channel::<()>();
        let (interrupt, told) = (&interrupt, &told);
        let body = move || {
            let _done = done;
            let began = Instant::now();
            let clock = || began.elapsed().as_secs_f64();
            let mut progress = |what: &str, fraction: Option<f64>| {
                *told.lock().unwrap_or_else(PoisonError::into_inner) =
                    Some((what.to_owned(), fraction));
            };
            work(&mut Hooks {
                clock: &clock,
                interrupt: Some(interrupt),
                progress: &mut progress,
            })
        };
        let builder = std::thread::Builder::new().stack_size(STACK);
        let worker = builder.spawn_scoped(scope, body)?;
        let mut end = |problem: PyErr| {
            interrupt.store(true, Ordering::Relaxed);
            if problem.is_instance_of::<PyKeyboardInterrupt>(py) {
                interrupted = true
            } else {
                thrown = Some(problem)
            }
        };
        loop {
            let own = &mut waits;
            let ended = py.detach(move || own.recv_timeout(LOOKS));
            if ended != Err(RecvTimeoutError::Timeout) {
                break;
            }
            if let Err(problem) = py.check_signals() {
                end(problem);
            }
            if let (Some(tell), Some(said)) = (tell, latest()) {
                if let Err(problem) = tell.call1(said) {
                    end(problem);
                }
            }
        }
        worker
            .join()
            .map_err(|_| PyRuntimeError::new_err("the computation failed inside; please report it"))
    })?;
    match thrown {
        Some(problem) => Err(problem),
        None => Ok(Done {
            result,
            interrupted,
        }),
    }
}
