//! The figures that may only fall, each with its ceiling in `xtask/ceilings.toml`.

use super::Measured;
use std::path::{Path, PathBuf};

/// A figure that may only fall, with its name in the file.
type Held = (&'static str, usize);

/// The figures of the whole tree that are held.
pub(crate) fn held(measured: &Measured) -> Vec<Held> {
    let crates = measured.crates.iter();
    vec![
        (
            "largest-circle",
            crates.clone().map(|c| c.largest()).max().unwrap_or(0),
        ),
        (
            "largest-wider-circle",
            crates.clone().map(|c| c.widest()).max().unwrap_or(0),
        ),
        (
            "modules-in-circles",
            crates.clone().map(|c| c.in_circles()).sum(),
        ),
        ("text-errors", crates.map(|c| c.text_errors).sum()),
        ("unresolved-citations", measured.unresolved.len()),
    ]
}

/// Where the ceilings are.
fn file(root: &Path) -> PathBuf {
    root.join("xtask/ceilings.toml")
}

/// What is above its ceiling, or has none; empty when all is well.
///
/// # Errors
/// The file cannot be read.
pub(crate) fn exceeded(root: &Path, measured: &Measured) -> std::io::Result<Vec<String>> {
    let text = std::fs::read_to_string(file(root))?;
    Ok(held(measured)
        .into_iter()
        .filter_map(|(name, value)| match ceiling(&text, name) {
            Some(ceiling) if value <= ceiling => None,
            Some(ceiling) => Some(format!("{name} is {value}, above its ceiling {ceiling}")),
            None => Some(format!("{name} has no ceiling")),
        })
        .collect())
}

/// Lowers the ceilings to the present figures; none is raised.
///
/// # Errors
/// The file cannot be read or written.
pub(crate) fn lower(root: &Path, measured: &Measured) -> std::io::Result<()> {
    let held = held(measured);
    let text = std::fs::read_to_string(file(root))?;
    std::fs::write(file(root), lowered(&text, &held))
}

fn lowered(text: &str, held: &[Held]) -> String {
    let line = |line: &str| {
        let (name, ceiling, rest) = entry(line)?;
        let (_, value) = held.iter().find(|(held, _)| *held == name)?;
        (*value < ceiling).then(|| format!("{name} = {value}{rest}"))
    };
    let lines = text
        .lines()
        .map(|l| line(l).unwrap_or_else(|| l.to_owned()));
    lines.map(|line| line + "\n").collect()
}

fn ceiling(text: &str, name: &str) -> Option<usize> {
    let mut entries = text.lines().filter_map(entry);
    entries.find_map(|(found, ceiling, _)| (found == name).then_some(ceiling))
}

/// `name = number`, with what follows.
fn entry(line: &str) -> Option<(&str, usize, &str)> {
    let (name, rest) = line.split_once(" = ")?;
    let end = rest
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(rest.len());
    Some((name, rest[..end].parse().ok()?, &rest[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ceiling_is_lowered_and_never_raised() {
        let text = "# comments stay = 1\na = 12 # goal 6\nb = 3\n";
        let after = lowered(text, &[("a", 7), ("b", 4)]);
        assert_eq!(after, "# comments stay = 1\na = 7 # goal 6\nb = 3\n");
        assert_eq!((ceiling(text, "a"), ceiling(text, "c")), (Some(12), None));
    }

    /// The present tree is below its ceilings.
    #[test]
    fn the_figures_of_the_house_do_not_rise() {
        let root = super::super::root();
        let measured = super::super::measured(&root).unwrap();
        assert_eq!(exceeded(&root, &measured).unwrap(), Vec::<String>::new());
    }
}
