//! `chetaev new`.

use std::io::{BufRead, IsTerminal};

use super::error;
use crate::arguments::{Beginning, New as Arguments};
use crate::{files, terminal, DONE, INPUT};

const TEMPLATE: &str = include_str!("template.toml");
const BODIES: &str = include_str!("bodies.toml");
const FUNCTIONAL: &str = include_str!("functional.toml");

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let path = arguments.folder.join("model.toml");
    if path.exists() {
        error(format!(
            "{} exists already; nothing was written",
            path.display()
        ));
        return INPUT;
    }
    let name = arguments
        .folder
        .file_name()
        .and_then(|n| n.to_str())
        .unwrap_or("my-system");
    let name = in_quotation_marks(name);
    let is_asked = std::io::stdin().is_terminal() && std::io::stderr().is_terminal();
    let beginning = match arguments.from {
        Some(beginning) => beginning,
        None if is_asked => match asked(&mut std::io::stdin().lock(), &mut terminal::err) {
            Some(beginning) => beginning,
            None => {
                error("no kind of model was chosen; nothing was written");
                return INPUT;
            }
        },
        None => Beginning::Lagrangian,
    };
    let template = match beginning {
        Beginning::Bodies => BODIES,
        Beginning::Functional => FUNCTIONAL,
        Beginning::Lagrangian => TEMPLATE,
    };
    match files::write(&path, template.replace("MY-SYSTEM", &name).as_bytes()) {
        Ok(()) => {
            terminal::out(&format!(
                "wrote {}\ntry:  chetaev study {}\n",
                path.display(),
                path.display()
            ));
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

const QUESTION: &str = "\
What is the model stated by?
  1  bodies, joints and contacts
  2  coordinates, energies and constraints
  3  fields over space and densities
1, 2 or 3, bodies where nothing is said: ";

/// What a person answers to the question; it is asked again until it is answered, and nothing comes back where the input ends.
fn asked(answers: &mut dyn BufRead, say: &mut dyn FnMut(&str)) -> Option<Beginning> {
    loop {
        say(QUESTION);
        let mut answer = String::new();
        if answers.read_line(&mut answer).ok()? == 0 {
            return None;
        }
        match answer.trim() {
            "" | "1" | "bodies" => return Some(Beginning::Bodies),
            "2" | "lagrangian" => return Some(Beginning::Lagrangian),
            "3" | "functional" => return Some(Beginning::Functional),
            _ => {}
        }
    }
}

/// The text as it stands between the quotation marks of a TOML string.
fn in_quotation_marks(name: &str) -> String {
    name.chars()
        .map(|c| match c {
            '"' => "\\\"".to_owned(),
            '\\' => "\\\\".to_owned(),
            c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
            c => c.to_string(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(text: &str) -> (Option<Beginning>, usize) {
        let mut questions = 0;
        let answer = asked(&mut text.as_bytes(), &mut |_| questions += 1);
        (answer, questions)
    }

    #[test]
    fn bodies_are_offered_first() {
        assert_eq!(answered("\n"), (Some(Beginning::Bodies), 1));
        assert_eq!(answered("2\n"), (Some(Beginning::Lagrangian), 1));
        assert_eq!(answered("wheel\n 3 \n"), (Some(Beginning::Functional), 2));
        assert_eq!(answered(""), (None, 1));
        let first = QUESTION.find("bodies").unwrap_or(usize::MAX);
        assert!(QUESTION.find("coordinates").is_some_and(|at| first < at));
    }
}
