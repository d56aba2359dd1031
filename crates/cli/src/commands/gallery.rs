//! `chetaev gallery`: the models built into the program.

use super::error;
use crate::arguments::{Gallery as Arguments, GalleryAction};
use crate::{files, terminal, DONE, INPUT};
use chetaev::symbolic::syntax::names;
use chetaev_gallery::{find, models, Entry, Kind};
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let json = arguments.json;
    match &arguments.action {
        None | Some(GalleryAction::List) => list(json),
        Some(GalleryAction::Describe { name }) => match find(name) {
            Some(entry) => describe(entry, json),
            None => unknown(name),
        },
        Some(GalleryAction::Copy { name, folder }) => match find(name) {
            Some(entry) => copy(
                entry,
                &folder
                    .clone()
                    .unwrap_or_else(|| PathBuf::from(name.rsplit('/').next().unwrap_or(name))),
                json,
            ),
            None => unknown(name),
        },
    }
}

fn print(data: &serde_json::Value) {
    let text = serde_json::to_string_pretty(data).unwrap_or_default();
    terminal::out(&format!("{text}\n"));
}

fn list(json: bool) -> u8 {
    if json {
        let all: Vec<_> = models().map(Entry::to_json).collect();
        print(&serde_json::json!(all));
        return DONE;
    }
    let width = models().map(|entry| entry.name.chars().count()).max();
    let width = width.unwrap_or(0);
    for (kind, heading) in [
        (
            Kind::Motion,
            "Motions: Chetaev derives the equations of motion and follows them",
        ),
        (
            Kind::Functional,
            "Functionals over space: Chetaev derives Euler equations and boundary conditions",
        ),
    ] {
        terminal::out(&format!("{heading}\n"));
        let mut last = None;
        // Those that stand alone, then group after group.
        let mut own: Vec<&Entry> = models().filter(|entry| entry.kind() == kind).collect();
        own.sort_by_key(|entry| entry.group().map(|(group, _)| group));
        for entry in own {
            let group = entry.group().map(|(group, _)| group);
            if last.is_some_and(|last| last != group) {
                terminal::out("\n");
            }
            last = Some(group);
            terminal::out(&format!("  {:<width$}  {}\n", entry.name, entry.title()));
        }
        if kind == Kind::Motion {
            terminal::out("\n");
        }
    }
    terminal::out("\nchetaev gallery copy NAME writes one into a folder of its own; describe NAME tells about it\n");
    DONE
}

fn describe(entry: &Entry, json: bool) -> u8 {
    if json {
        let mut data = entry.to_json();
        data["description"] = entry.readme().into();
        print(&data);
    } else {
        terminal::out(entry.readme());
    }
    DONE
}

fn unknown(name: &str) -> u8 {
    let all: Vec<&str> = models().map(|e| e.name).collect();
    let near = names::closest(name, all.iter().copied());
    error(format!(
        "there is no model `{name}` in the gallery; {}there are {}",
        near.map_or(String::new(), |near| format!("did you mean {near}? ")),
        all.join(", ")
    ));
    INPUT
}

fn copy(entry: &Entry, folder: &Path, json: bool) -> u8 {
    if folder.exists() {
        error(format!(
            "{} exists already; nothing was written",
            folder.display()
        ));
        return INPUT;
    }
    for (path, text) in entry.copied() {
        if let Err(problem) = files::write(&folder.join(path), text.as_bytes()) {
            error(problem);
            return INPUT;
        }
    }
    if json {
        let mut data = entry.to_json();
        data["folder"] = folder.display().to_string().into();
        print(&data);
    } else {
        terminal::out(&format!("wrote {}\n", folder.display()));
        let model = folder.join(entry.model_path());
        terminal::out(&format!("try:  chetaev study {}\n", model.display()));
    }
    DONE
}
