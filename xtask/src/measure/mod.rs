//! `cargo xtask measure`: figures of the house, read from the sources.

mod ceilings;
mod circles;
mod errors;
mod sentences;
mod source;

use crate::citations;
use crate::{err, out, refuse};
use circles::{circles, Edges};
use serde_json::{json, Value};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Figures of the house, read from the sources

Usage: cargo xtask measure [--json] [--lower]

For each crate: lines that are not only for tests; modules (a file is one), how many of them stand in circles of imports (every
`crate::` and `super::` path is an edge), how many circles there are, and how many modules the largest has, and has where paths
to modules inside the own one are edges as well (wider); functions of libraries that return a text as their error; sentences for users (string literals of four words and more) outside modules
called `words`. For the tree: citations of the theory that resolve to nothing. `xtask/ceilings.toml` holds the ceilings of what may
only fall; a test compares.

  --json    as JSON, with the members of all circles
  --lower   lowers the ceilings to the present figures where these are below
  --help    this text
";

/// Crates that are programs: their errors end on a terminal.
const PROGRAMS: [&str; 3] = ["bench", "cli", "laws"];

/// What is measured of a crate.
pub(crate) struct Measures {
    name: String,
    lines: usize,
    modules: usize,
    circles: Vec<Vec<String>>,
    /// Where paths to modules inside the own one are edges as well.
    wider: Vec<Vec<String>>,
    text_errors: usize,
    sentences: usize,
    characters: usize,
}

impl Measures {
    fn in_circles(&self) -> usize {
        self.circles.iter().map(Vec::len).sum()
    }

    fn largest(&self) -> usize {
        self.circles.first().map_or(0, Vec::len)
    }

    fn widest(&self) -> usize {
        self.wider.first().map_or(0, Vec::len)
    }
}

/// What is measured of the tree.
pub(crate) struct Measured {
    crates: Vec<Measures>,
    /// Citations that resolve to nothing, with their places.
    unresolved: Vec<String>,
}

/// Runs the task.
pub(crate) fn run(words: &[String]) -> u8 {
    let (mut as_json, mut lower) = (false, false);
    for word in words {
        match word.as_str() {
            "--json" => as_json = true,
            "--lower" => lower = true,
            "--help" | "-h" => {
                out(HELP);
                return 0;
            }
            _ => return refuse(&format!("unknown argument `{word}`\n\n{HELP}")),
        }
    }
    match shown(as_json, lower) {
        Ok(text) => {
            out(&text);
            0
        }
        Err(problem) => {
            err(&format!("error: the tree cannot be measured: {problem}\n"));
            1
        }
    }
}

fn shown(as_json: bool, lower: bool) -> std::io::Result<String> {
    let root = root();
    let measured = measured(&root)?;
    if lower {
        ceilings::lower(&root, &measured)?;
    }
    if as_json {
        Ok(format!("{:#}\n", data(&measured)))
    } else {
        table(&root, &measured)
    }
}

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn measured(root: &Path) -> std::io::Result<Measured> {
    let mut folders: Vec<PathBuf> = std::fs::read_dir(root.join("crates"))?
        .filter_map(Result::ok)
        .map(|entry| entry.path())
        .filter(|path| path.join("src").is_dir())
        .collect();
    folders.sort();
    let crates = folders.iter().map(|folder| measures(folder));
    Ok(Measured {
        crates: crates.collect::<std::io::Result<_>>()?,
        unresolved: citations::unresolved(root)?.1,
    })
}

fn measures(folder: &Path) -> std::io::Result<Measures> {
    let name = folder.file_name().unwrap_or_default();
    let name = name.to_string_lossy().into_owned();
    let modules = source::modules(&folder.join("src"))?;
    let text_errors = if PROGRAMS.contains(&name.as_str()) {
        0
    } else {
        modules.values().map(errors::text_errors).sum()
    };
    let (sentences, characters) = sentences::outside(&modules);
    Ok(Measures {
        name,
        lines: modules.values().map(|source| source.lines).sum(),
        modules: modules.len(),
        circles: circles(&modules, Edges::Outwards),
        wider: circles(&modules, Edges::All),
        text_errors,
        sentences,
        characters,
    })
}

fn table(root: &Path, measured: &Measured) -> std::io::Result<String> {
    let mut text = String::new();
    let heads = [
        "lines",
        "modules",
        "in circles",
        "circles",
        "largest",
        "text errors",
        "sentences",
    ];
    let _ = write!(text, "{:<14}", "crate");
    for head in heads {
        let _ = write!(text, "{head:>12}");
    }
    text.push('\n');
    let mut sums = [0; 8];
    for of in &measured.crates {
        let values = [
            of.lines,
            of.modules,
            of.in_circles(),
            of.circles.len(),
            of.largest(),
            of.widest(),
            of.text_errors,
            of.sentences,
        ];
        row(&mut text, &of.name, &values);
        for (i, (sum, value)) in sums.iter_mut().zip(values).enumerate() {
            *sum = if i == 4 || i == 5 {
                value.max(*sum)
            } else {
                *sum + value
            };
        }
    }
    row(&mut text, "all", &sums);
    let characters: usize = measured.crates.iter().map(|c| c.characters).sum();
    let _ = writeln!(text, "\n{characters} characters in these sentences");
    let _ = writeln!(text, "{} unresolved citations", measured.unresolved.len());
    let largest = measured.crates.iter().max_by_key(|c| c.largest());
    if let Some((of, circle)) = largest.and_then(|c| Some((c, c.circles.first()?))) {
        let _ = writeln!(text, "largest circle, in {}: {}", of.name, circle.join(" "));
    }
    for problem in ceilings::exceeded(root, measured)? {
        let _ = writeln!(text, "{problem}");
    }
    Ok(text)
}

fn row(text: &mut String, name: &str, values: &[usize]) {
    let _ = write!(text, "{name:<14}");
    for value in values {
        let _ = write!(text, "{value:>12}");
    }
    text.push('\n');
}

fn data(measured: &Measured) -> Value {
    let crates: Vec<Value> = measured
        .crates
        .iter()
        .map(|of| {
            json!({
                "crate": of.name,
                "lines": of.lines,
                "modules": of.modules,
                "circles": of.circles,
                "wider_circles": of.wider,
                "text_errors": of.text_errors,
                "sentences": of.sentences,
                "characters": of.characters,
            })
        })
        .collect();
    let held: serde_json::Map<String, Value> = ceilings::held(measured)
        .into_iter()
        .map(|(name, value)| (name.to_owned(), value.into()))
        .collect();
    json!({ "crates": crates, "held": held, "unresolved_citations": measured.unresolved })
}
