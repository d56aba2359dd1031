//! One line of progress on standard error for anything longer than a second.
//!
//! On a terminal a thread repaints the line, so that a single long step shows its seconds too; a log gets a line every
//! five seconds, when a step reports.

use std::cell::{Cell, RefCell};
use std::io::{IsTerminal, Write};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Nothing is shown before.
const QUIET: Duration = Duration::from_secs(1);
/// Between two states of the line.
const REPAINT: Duration = Duration::from_millis(100);
/// Between two lines of a log, in seconds.
const LOG: f64 = 5.0;

/// A progress line; it vanishes with this value.
pub(crate) struct ProgressLine {
    began: Instant,
    logged: Cell<f64>,
    /// What was begun last, and when.
    last: RefCell<(String, f64)>,
    painter: Option<Painter>,
}

impl ProgressLine {
    pub(crate) fn new() -> ProgressLine {
        let began = Instant::now();
        ProgressLine {
            began,
            logged: Cell::new(0.0),
            last: RefCell::default(),
            painter: std::io::stderr().is_terminal().then(|| Painter::new(began)),
        }
    }

    /// Seconds since the start.
    pub(crate) fn seconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Whether the line is painted again and again, on a terminal.
    pub(crate) fn is_painted(&self) -> bool {
        self.painter.is_some()
    }

    /// Says what is being done, and which part of it is done.
    pub(crate) fn show(&self, what: &str, fraction: Option<f64>) {
        let part = fraction.map_or(String::new(), |f| format!(" {:3.0} %", 100.0 * f));
        let said = format!("{what}{part}");
        if let Some(painter) = &self.painter {
            painter.shared.lock().what = said;
            return;
        }
        let now = self.seconds();
        let (before, since) = self.last.borrow().clone();
        if before != what {
            self.last.replace((what.to_owned(), now));
        }
        if now - self.logged.get() >= LOG {
            self.logged.set(now);
            // A step that reports at its end only took the time, not the one that begins.
            let took = match before.is_empty() || before == what {
                true => String::new(),
                false => format!("{before} took {:.1} s; ", now - since),
            };
            let _ = writeln!(std::io::stderr().lock(), "{now:6.1} s  {took}{said}");
        }
    }
}

/// The thread that paints the line on a terminal.
struct Painter {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct State {
    what: String,
    ended: bool,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    wake: Condvar,
}

impl Shared {
    /// The state; a thread that panicked leaves a text that can still be shown.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits, and says whether the work has ended.
    fn ended_within(&self, time: Duration) -> bool {
        let waited = self
            .wake
            .wait_timeout_while(self.lock(), time, |state| !state.ended);
        waited.map_or_else(|e| e.into_inner().0.ended, |(state, _)| state.ended)
    }
}

impl Painter {
    fn new(began: Instant) -> Painter {
        let shared = Arc::new(Shared::default());
        let own = Arc::clone(&shared);
        let paint = move || {
            let mut ended = own.ended_within(QUIET);
            let was_shown = !ended;
            while !ended {
                let said = own.lock().what.clone();
                let seconds = began.elapsed().as_secs_f64();
                let mut stderr = std::io::stderr().lock();
                let _ = write!(stderr, "\r\u{1b}[2K{seconds:6.1} s  {said}");
                let _ = stderr.flush();
                drop(stderr);
                ended = own.ended_within(REPAINT);
            }
            if was_shown {
                let mut stderr = std::io::stderr().lock();
                let _ = write!(stderr, "\r\u{1b}[2K");
                let _ = stderr.flush();
            }
        };
        // Without a thread there is no line, and the work goes on.
        let thread = std::thread::Builder::new().spawn(paint).ok();
        Painter { shared, thread }
    }
}

impl Drop for Painter {
    fn drop(&mut self) {
        self.shared.lock().ended = true;
        self.shared.wake.notify_all();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
