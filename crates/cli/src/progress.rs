//! One line of progress on standard error for anything longer than a second.

use std::cell::Cell;
use std::io::{IsTerminal, Write};
use std::time::Instant;

/// A progress line.
pub(crate) struct ProgressLine {
    began: Instant,
    last: Cell<f64>,
    shown: Cell<bool>,
    terminal: bool,
}

impl ProgressLine {
    pub(crate) fn new() -> ProgressLine {
        ProgressLine {
            began: Instant::now(),
            last: Cell::new(0.0),
            shown: Cell::new(false),
            terminal: std::io::stderr().is_terminal(),
        }
    }

    /// Seconds since the start.
    pub(crate) fn seconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Shows what is done, at most ten times a second and not within the first second; a log gets a line every five.
    pub(crate) fn show(&self, what: &str, fraction: Option<f64>) {
        let now = self.seconds();
        let interval = if self.terminal { 0.1 } else { 5.0 };
        if now < 1.0 || now - self.last.get() < interval {
            return;
        }
        self.last.set(now);
        let part = fraction.map_or(String::new(), |f| format!(" {:3.0} %", 100.0 * f));
        let mut stderr = std::io::stderr().lock();
        if self.terminal {
            self.shown.set(true);
            let _ = write!(stderr, "\r\u{1b}[2K{now:6.1} s  {what}{part}");
        } else {
            let _ = writeln!(stderr, "{now:6.1} s  {what}{part}");
        }
        let _ = stderr.flush();
    }

    /// Removes the line.
    pub(crate) fn clear(&self) {
        if self.shown.replace(false) {
            let mut stderr = std::io::stderr().lock();
            let _ = write!(stderr, "\r\u{1b}[2K");
            let _ = stderr.flush();
        }
    }
}
