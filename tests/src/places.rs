//! Where things are in the repository, and scratch folders outside it.

use std::path::{Path, PathBuf};

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Paths of the models of the gallery, in order of their names.
///
/// # Panics
/// When the gallery cannot be read.
pub fn gallery() -> Vec<PathBuf> {
    let folder = root().join("gallery");
    let mut models: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the gallery is in the repository")
        .filter_map(Result::ok)
        .map(|entry| entry.path().join("model.toml"))
        .filter(|path| path.is_file())
        .collect();
    models.sort();
    models
}

/// Paths of the models that are wrong on purpose, in order of their names.
///
/// # Panics
/// When the gallery cannot be read.
pub fn wrong() -> Vec<PathBuf> {
    let mut models: Vec<PathBuf> = std::fs::read_dir(root().join("gallery/wrong"))
        .expect("the wrong models are in the repository")
        .filter_map(Result::ok)
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    models.sort();
    models
}

/// An empty folder for one test, below the build directory.
///
/// # Panics
/// When it cannot be made.
pub fn scratch(name: &str) -> PathBuf {
    let folder = executable_folder().join("scratch").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a scratch folder");
    folder
}

/// `target/PROFILE`, where the running test was built.
///
/// # Panics
/// When the test does not know its own path.
pub fn executable_folder() -> PathBuf {
    let own = std::env::current_exe().expect("a test knows its own path");
    let deps = own.parent().expect("an executable is in a folder");
    match deps.file_name() {
        Some(name) if name == "deps" => deps.parent().unwrap_or(deps).to_path_buf(),
        _ => deps.to_path_buf(),
    }
}
