//! `chetaev gallery`: the models built into the program.

use super::error;
use crate::arguments::{Gallery as Arguments, GalleryAction};
use crate::{files, terminal, DONE, INPUT};
use std::path::{Path, PathBuf};

/// Name and files (name, content) of a model.
struct Entry {
    name: &'static str,
    files: &'static [(&'static str, &'static str)],
}

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));

pub(crate) fn run(arguments: &Arguments) -> u8 {
    match &arguments.action {
        None | Some(GalleryAction::List) => list(),
        Some(GalleryAction::Describe { name }) => match find(name) {
            Some(entry) => {
                let readme = entry.files.iter().find(|(file, _)| *file == "README.md");
                terminal::out(readme.map_or("no description\n", |(_, text)| text));
                DONE
            }
            None => unknown(name),
        },
        Some(GalleryAction::Copy { name, folder }) => match find(name) {
            Some(entry) => copy(
                entry,
                &folder.clone().unwrap_or_else(|| PathBuf::from(name)),
            ),
            None => unknown(name),
        },
    }
}

fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|e| e.name == name)
}

fn list() -> u8 {
    for entry in ENTRIES {
        let readme = entry
            .files
            .iter()
            .find(|(file, _)| *file == "README.md")
            .map_or("", |(_, text)| text);
        let title = readme
            .lines()
            .next()
            .unwrap_or("")
            .trim_start_matches('#')
            .trim();
        terminal::out(&format!("{:<24} {title}\n", entry.name));
    }
    DONE
}

fn unknown(name: &str) -> u8 {
    let names: Vec<&str> = ENTRIES.iter().map(|e| e.name).collect();
    error(format!(
        "there is no model `{name}` in the gallery; there are {}",
        names.join(", ")
    ));
    INPUT
}

fn copy(entry: &Entry, folder: &Path) -> u8 {
    if folder.exists() {
        error(format!(
            "{} exists already; nothing was written",
            folder.display()
        ));
        return INPUT;
    }
    for (name, text) in entry.files {
        if let Err(problem) = files::write(&folder.join(name), text.as_bytes()) {
            error(problem);
            return INPUT;
        }
    }
    terminal::out(&format!("wrote {}\n", folder.display()));
    DONE
}
