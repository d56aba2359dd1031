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

/// The command that is running, as a person would write it again; where its output goes is left out.
pub(crate) fn command() -> String {
    written(std::env::args().skip(1))
}

fn written(mut arguments: impl Iterator<Item = String>) -> String {
    let mut command = String::from("chetaev");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--out" => {
                arguments.next();
            }
            "--json" => {}
            other if other.starts_with("--out=") => {}
            other => {
                command.push(' ');
                command.push_str(&quoted(other));
            }
        }
    }
    command
}

/// An argument for a shell.
fn quoted(argument: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_=./:,+@%^".contains(c);
    match !argument.is_empty() && argument.chars().all(is_plain) {
        true => argument.to_owned(),
        false => format!("'{}'", argument.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn commands_are_written_as_they_can_be_given_again() {
        let of = |arguments: &[&str]| written(arguments.iter().map(|a| a.to_string()));
        let given = [
            "principles",
            "a/model.toml",
            "--compare",
            "--out",
            "x",
            "--json",
        ];
        assert_eq!(of(&given), "chetaev principles a/model.toml --compare");
        let given = ["study", "it's.toml", "--set", "phi'=2 pi", "--out=x"];
        assert_eq!(
            of(&given),
            r"chetaev study 'it'\''s.toml' --set 'phi'\''=2 pi'"
        );
    }
}
