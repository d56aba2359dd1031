//! Writing to the terminal without panicking on a closed pipe.

use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::OnceLock;

/// Why standard output could not be written.
static FAILURE: OnceLock<String> = OnceLock::new();

/// Writes to standard output. A reader that went away is no error; any other failure is kept for [`failure`].
pub(crate) fn out(text: &str) {
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    if let Err(problem) = written {
        if problem.kind() != ErrorKind::BrokenPipe {
            let _ = FAILURE.set(problem.to_string());
        }
    }
}

/// Why something was not written to standard output, as on a full disk.
pub(crate) fn failure() -> Option<&'static str> {
    FAILURE.get().map(String::as_str)
}

/// Writes a line to standard error.
pub(crate) fn err(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = writeln!(stderr, "{}", text.trim_end());
}

/// Whether standard output is a terminal that wants colours.
pub(crate) fn colours() -> bool {
    std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

/// Whether standard error is a terminal that wants colours.
pub(crate) fn error_colours() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}
