//! `cargo xtask lines`: how many lines a person writes for each model of bodies.

use crate::lines_of_models::{lines, LONGEST, MOST};
use crate::{err, out, refuse};
use std::path::Path;

const HELP: &str = "\
The lines of the models of bodies in gallery/bodies: without comments, empty lines and [expect]

Usage: cargo xtask lines
";

/// Prints the figures; 1 where a model is longer than its bound.
pub(crate) fn run(rest: &[String]) -> u8 {
    match rest.first().map(String::as_str) {
        None => {}
        Some("--help" | "-h") => {
            out(HELP);
            return 0;
        }
        Some(other) => return refuse(&format!("`{other}` is no argument\n\n{HELP}")),
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../gallery/bodies");
    let mut status = 0;
    for (name, most) in MOST {
        let path = folder.join(format!("{name}.toml"));
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(problem) => {
                err(&format!("error: {}: {problem}\n", path.display()));
                status = 1;
                continue;
            }
        };
        let own = lines(&text);
        let longest = own
            .iter()
            .map(|line| line.chars().count())
            .max()
            .unwrap_or(0);
        let is_long = own.len() > *most || longest > LONGEST;
        let mark = if is_long { "  too long" } else { "" };
        out(&format!(
            "{name:<24} {:>3} of {most:>3} lines, the longest {longest:>3}{mark}\n",
            own.len()
        ));
        status |= u8::from(is_long);
    }
    status
}
