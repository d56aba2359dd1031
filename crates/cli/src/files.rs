//! Reading models and writing results.

use crate::arguments::ModelArguments;
use crate::terminal;
use chetaev::functionals;
use chetaev::model::{self, Diagnostic, Diagnostics, Files, Model, Sources, Style};
use chetaev::study::placed;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// The file system for included files.
pub(crate) struct Disk;

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        std::fs::read_to_string(path).map_err(|e| e.to_string())
    }
}

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
    let text = std::fs::read_to_string(&arguments.model).ok()?;
    let path = arguments.model.to_string_lossy().into_owned();
    let tables = model::tables(&path, &text, &Disk, &[], Sources::default());
    if !tables.is_functional() {
        return None;
    }
    let overrides = overrides(&arguments.set)?;
    Some(functionals::load(&path, &text, &Disk, &overrides))
}

/// Reads a model with its diagnostics; `None` when the file or an override cannot be read at all.
pub(crate) fn load(arguments: &ModelArguments) -> Option<(Option<Model>, Diagnostics)> {
    let overrides = overrides(&arguments.set)?;
    let path = arguments.model.to_string_lossy().into_owned();
    let text = match std::fs::read(&arguments.model) {
        Ok(bytes) => match String::from_utf8(bytes) {
            Ok(text) => text,
            Err(_) => {
                terminal::err(&format!("error: {path} is not UTF-8 text"));
                return None;
            }
        },
        Err(problem) => {
            terminal::err(&format!("error: {path} cannot be read: {problem}"));
            if arguments.model.is_dir() {
                terminal::err(&format!("help: give the file: {path}/model.toml"));
            }
            return None;
        }
    };
    let loaded = model::load(&path, &text, &Disk, &overrides);
    Some((loaded.model, loaded.diagnostics))
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

/// Writes a file completely or not at all: to a temporary name, then renamed. What could not be written is removed.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<(), String> {
    let describe = |e: std::io::Error| format!("{} cannot be written: {e}", path.display());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(describe)?;
    }
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let written = std::fs::write(&partial, content).and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|problem| {
        // It may never have been there, and what went wrong is said already.
        let _ = std::fs::remove_file(&partial);
        describe(problem)
    })
}
