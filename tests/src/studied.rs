//! Every model file of the gallery, loaded from disk or studied by the program.

use crate::places;
use crate::program::{self, Finished};
use crate::words::in_parallel;
use chetaev::model::{load, Files, Loaded};
use std::path::{Path, PathBuf};

/// The file system, for included files.
#[derive(Debug)]
pub struct Disk;

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        std::fs::read_to_string(path).map_err(|e| e.to_string())
    }
}

/// A model file as the command line reads it.
///
/// # Panics
/// When the file cannot be read.
pub fn loaded(path: &Path, overrides: &[(&str, &str)]) -> Loaded {
    let text = std::fs::read_to_string(path).expect("the model file is there");
    let overrides: Vec<(String, String)> = overrides
        .iter()
        .map(|&(name, value)| (name.into(), value.into()))
        .collect();
    load(program::text(path), &text, &Disk, &overrides)
}

/// All model files of the gallery that are right, as `NAME/FILE.toml` relative to it, in order.
///
/// # Panics
/// When the gallery cannot be read.
pub fn model_files() -> Vec<String> {
    let mut files = Vec::new();
    for model in places::gallery() {
        let folder = model.parent().expect("a model is in a folder");
        let name = folder.file_name().expect("the folder has a name");
        for entry in std::fs::read_dir(folder).expect("the folder can be read") {
            let path = entry.expect("the folder can be read").path();
            if path.extension().is_some_and(|e| e == "toml") {
                let file = path.file_name().expect("a file has a name");
                files.push(format!(
                    "{}/{}",
                    name.to_string_lossy(),
                    file.to_string_lossy()
                ));
            }
        }
    }
    files.sort();
    files
}

/// Path of a file of the gallery given as `NAME/FILE.toml`.
pub fn gallery_path(file: &str) -> PathBuf {
    places::root().join("gallery").join(file)
}

/// One model of the gallery studied by the program.
#[derive(Clone, Debug)]
pub struct Studied {
    /// `NAME/FILE.toml`.
    pub file: String,
    /// Folder written into.
    pub folder: PathBuf,
    /// How the program ended.
    pub finished: Finished,
}

impl Studied {
    /// `study.json` as text.
    ///
    /// # Panics
    /// When it was not written.
    pub fn text(&self) -> String {
        std::fs::read_to_string(self.folder.join("study.json"))
            .unwrap_or_else(|e| panic!("{}: {e}\n{}", self.file, self.finished.both()))
    }

    /// `study.json` as data.
    ///
    /// # Panics
    /// When it was not written or is not JSON.
    pub fn record(&self) -> serde_json::Value {
        serde_json::from_str(&self.text()).expect("study.json is JSON")
    }
}

/// Studies all models of the gallery into scratch folders below `name`.
pub fn study_gallery(name: &str) -> Vec<Studied> {
    let scratch = places::scratch(name);
    in_parallel(&model_files(), |file| {
        let folder = scratch.join(file.replace('/', "-").replace(".toml", ""));
        let model = format!("gallery/{file}");
        let arguments = ["study", &model, "--out", program::text(&folder)];
        let finished = program::run(&arguments);
        Studied {
            file: file.clone(),
            folder,
            finished,
        }
    })
}

/// `id#subject` of a verdict of a record.
///
/// # Panics
/// When it has no claim.
pub fn full_id(verdict: &serde_json::Value) -> String {
    let claim = verdict["claim"].as_str().expect("a verdict has a claim");
    match verdict["subject"].as_str() {
        Some(subject) => format!("{claim}#{subject}"),
        None => claim.to_string(),
    }
}

/// Verdicts of a record.
///
/// # Panics
/// When it has none.
pub fn verdicts(record: &serde_json::Value) -> &Vec<serde_json::Value> {
    record["verdicts"]
        .as_array()
        .expect("a record has verdicts")
}
