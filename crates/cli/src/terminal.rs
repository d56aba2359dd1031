//! Writing to the terminal without panicking on a closed pipe.

use chetaev::study::summary::Style;
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::OnceLock;

/// Why standard output could not be written.
static FAILURE: OnceLock<String> = OnceLock::new();

/// What is printed, with a picture in the place of every control character that is not ours: names in a model or a record may
/// contain any. Ours are the codes for colours.
fn shown(text: &str) -> std::borrow::Cow<'_, str> {
    let is_obeyed = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(is_obeyed) {
        return text.into();
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(sign) = rest.chars().next() {
        if let Some(length) = colour(rest) {
            out.push_str(&rest[..length]);
            rest = &rest[length..];
            continue;
        }
        match sign {
            '\0'..='\u{1f}' if is_obeyed(sign) => {
                out.push(char::from_u32(0x2400 + sign as u32).unwrap_or('\u{fffd}'));
            }
            sign if is_obeyed(sign) => out.push('\u{fffd}'),
            sign => out.push(sign),
        }
        rest = &rest[sign.len_utf8()..];
    }
    out.into()
}

/// The length of a code for a colour, bold or dim letters, or their end, at the beginning of a text.
fn colour(text: &str) -> Option<usize> {
    let code = text.strip_prefix("\u{1b}[")?;
    let end = code.find('m').filter(|&end| end <= 5)?;
    let is_one = |number: &str| matches!(number.parse::<u8>(), Ok(0..=2 | 30..=37 | 90..=97));
    code[..end].split(';').all(is_one).then_some(end + 3)
}

/// Writes to standard output. A reader that went away is no error; any other failure is kept for [`failure`].
pub(crate) fn out(text: &str) {
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(shown(text).as_bytes())
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
    let _ = writeln!(stderr, "{}", shown(text.trim_end()));
}

/// Whether standard output is a terminal that wants colours.
pub(crate) fn colours() -> bool {
    std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

/// Colours on standard output, or none.
pub(crate) fn style() -> Style {
    if colours() {
        Style::Ansi
    } else {
        Style::Plain
    }
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
    use super::{shown, written};

    #[test]
    fn control_characters_are_shown_and_not_obeyed() {
        let red = "\u{1b}[1;31merror\u{1b}[0m: x\n\ty";
        assert_eq!(shown(red), red);
        assert_eq!(
            shown("A\u{1b}]0;x\u{7}\u{1b}[2J\u{9b}1m"),
            "A␛]0;x␇␛[2J\u{fffd}1m"
        );
        // Letters that are hidden are none of ours.
        assert_eq!(shown("\u{1b}[8m"), "␛[8m");
    }

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
