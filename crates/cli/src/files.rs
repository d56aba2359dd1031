//! Reading models and writing results.

use crate::arguments::ModelArguments;
use crate::terminal;
use chetaev::disk::{text_of, Disk};
pub(crate) use chetaev::files::{checksum, checksum_of};
use chetaev::functionals;
use chetaev::model::{self, Diagnostic, Diagnostics, Model, Sources, Style};
use chetaev::study::placed;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// A model with the texts it was read from.
pub(crate) struct Read {
    /// The model.
    pub(crate) model: Model,
    /// The texts.
    sources: Sources,
}

impl Read {
    /// Prints a problem of the mechanics at the places of what it names.
    pub(crate) fn refuse(&self, problem: impl Display) {
        self.refuse_all(vec![placed(&problem.to_string(), &self.model)]);
    }

    /// Prints problems that have their places.
    pub(crate) fn refuse_all(&self, list: Vec<Diagnostic>) {
        report(&Diagnostics {
            sources: self.sources.clone(),
            list,
        });
    }
}

/// Reads a model; prints all diagnostics and returns `None` when there are errors.
pub(crate) fn model(arguments: &ModelArguments) -> Option<Read> {
    let (model, diagnostics) = load(arguments)?;
    report(&diagnostics);
    Some(Read {
        model: model?,
        sources: diagnostics.sources,
    })
}

/// Prints diagnostics, if there are any.
pub(crate) fn report(diagnostics: &Diagnostics) {
    let style = if terminal::error_colours() {
        Style::Ansi
    } else {
        Style::Plain
    };
    if !diagnostics.list.is_empty() {
        terminal::err(&diagnostics.render(style));
    }
}

/// A functional of fields over space, where the file states one; what cannot be read is left to [`load`], which says so.
pub(crate) fn functional(arguments: &ModelArguments) -> Option<functionals::Loaded> {
    // A pipe can be read once only, and is a motion then.
    let text = text_of(&arguments.model, true).ok()?;
    let path = arguments.model.to_string_lossy().into_owned();
    let disk = Disk::beside(&arguments.model);
    let tables = model::tables(&path, &text, &disk, &[], Sources::default());
    if !tables.is_functional() {
        return None;
    }
    let overrides = overrides(&arguments.set)?;
    Some(functionals::load(&path, &text, &disk, &overrides))
}

/// Reads a model with its diagnostics; `None` when the file or an override cannot be read at all.
pub(crate) fn load(arguments: &ModelArguments) -> Option<(Option<Model>, Diagnostics)> {
    let overrides = overrides(&arguments.set)?;
    let path = arguments.model.to_string_lossy().into_owned();
    let text = match text_of(&arguments.model, false) {
        Ok(text) => text,
        Err(problem) => {
            terminal::err(&format!("error: {path} cannot be read: {problem}"));
            if arguments.model.is_dir() {
                terminal::err(&format!("help: give the file: {path}/model.toml"));
            }
            return None;
        }
    };
    let disk = Disk::beside(&arguments.model);
    let loaded = model::load(&path, &text, &disk, &overrides);
    Some((loaded.model, loaded.diagnostics))
}

/// The text of a model with its bodies written out; what is wrong is printed.
pub(crate) fn lowered(arguments: &ModelArguments) -> Option<String> {
    let overrides = overrides(&arguments.set)?;
    let path = arguments.model.to_string_lossy().into_owned();
    let text = text_of(&arguments.model, false).ok()?;
    let disk = Disk::beside(&arguments.model);
    match model::lowered(&path, &text, &disk, &overrides) {
        Ok(text) => Some(text),
        Err(problems) => {
            report(&problems);
            None
        }
    }
}

fn overrides(set: &[String]) -> Option<Vec<(String, String)>> {
    let mut pairs = Vec::new();
    for item in set {
        match item.split_once('=') {
            Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
                pairs.push((name.trim().to_string(), value.trim().to_string()));
            }
            _ => {
                terminal::err(&format!(
                    "error: --set {item}: write NAME=VALUE, for example --set a=0.3"
                ));
                return None;
            }
        }
    }
    Some(pairs)
}

/// `out/NAME`, where NAME is the folder of `model.toml` or the stem of another file.
pub(crate) fn default_folder(model: &Path) -> PathBuf {
    let stem = model
        .file_stem()
        .and_then(|s| s.to_str())
        .unwrap_or("study");
    let folder = model
        .parent()
        .and_then(Path::file_name)
        .and_then(|s| s.to_str())
        .filter(|_| stem == "model");
    Path::new("out").join(folder.unwrap_or(stem))
}

/// Writes a file completely or not at all; what went wrong is said in words.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<(), String> {
    chetaev::files::write(path, content).map_err(|problem| problem.to_string())
}
