//! `chetaev gallery`: the models built into the program.

use super::error;
use crate::arguments::{Gallery as Arguments, GalleryAction};
use crate::{files, terminal, DONE, INPUT};
use chetaev::symbolic::syntax::names;
use chetaev_gallery::{find, models, Entry};
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
    for entry in models().filter(|entry| entry.group().is_none()) {
        terminal::out(&format!("{:<24} {}\n", entry.name, entry.title()));
    }
    let mut last = "";
    for entry in models() {
        let Some((group, _)) = entry.group() else {
            continue;
        };
        if group != last {
            terminal::out(&format!("\n{group}: functionals of fields over space\n"));
            last = group;
        }
        terminal::out(&format!("{:<24} {}\n", entry.name, entry.title()));
    }
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
        if let Some((_, member)) = entry.group() {
            let model = folder.join(member).join("model.toml");
            terminal::out(&format!("the model is {}\n", model.display()));
        }
    }
    DONE
}
