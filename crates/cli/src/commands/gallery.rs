//! `chetaev gallery`: the models built into the program.

use super::error;
use crate::arguments::{Gallery as Arguments, GalleryAction};
use crate::{files, terminal, DONE, INPUT};
use chetaev::symbolic::syntax::names;
use std::path::{Path, PathBuf};

/// Name and files (name, content) of a model.
struct Entry {
    name: &'static str,
    files: &'static [(&'static str, &'static str)],
}

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));

impl Entry {
    /// The description.
    fn readme(&self) -> &'static str {
        let readme = self.files.iter().find(|(file, _)| *file == "README.md");
        readme.map_or("no description\n", |(_, text)| text)
    }

    /// The first line of the description.
    fn title(&self) -> &'static str {
        let first = self.readme().lines().next().unwrap_or("");
        first.trim_start_matches('#').trim()
    }

    /// Whether it has a model, and not only what others include.
    fn is_model(&self) -> bool {
        self.files.iter().any(|(file, _)| *file == "model.toml")
    }

    /// The group that it belongs to, and its name in it.
    fn group(&self) -> Option<(&'static str, &'static str)> {
        self.name.split_once('/')
    }

    fn as_json(&self) -> serde_json::Value {
        let files: Vec<&str> = self.files.iter().map(|(file, _)| *file).collect();
        serde_json::json!({"name": self.name, "title": self.title(), "files": files})
    }
}

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

fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|e| e.name == name && e.is_model())
}

fn list(json: bool) -> u8 {
    let models = || ENTRIES.iter().filter(|entry| entry.is_model());
    if json {
        let all: Vec<_> = models().map(Entry::as_json).collect();
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
        let mut data = entry.as_json();
        data["description"] = entry.readme().into();
        print(&data);
    } else {
        terminal::out(entry.readme());
    }
    DONE
}

fn unknown(name: &str) -> u8 {
    let models = ENTRIES.iter().filter(|e| e.is_model());
    let all: Vec<&str> = models.map(|e| e.name).collect();
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
    for (path, text) in copied(entry) {
        if let Err(problem) = files::write(&folder.join(path), text.as_bytes()) {
            error(problem);
            return INPUT;
        }
    }
    if json {
        let mut data = entry.as_json();
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

/// What is written for an entry: models of a group name each other's files, and so all of the group is.
fn copied(entry: &Entry) -> Vec<(String, &'static str)> {
    let Some((group, _)) = entry.group() else {
        let own = entry.files.iter();
        return own
            .map(|(name, text)| ((*name).to_owned(), *text))
            .collect();
    };
    let members = ENTRIES.iter().filter_map(|e| Some((e, e.group()?)));
    members
        .filter(|(_, (own, _))| *own == group)
        .flat_map(|(e, (_, member))| {
            e.files
                .iter()
                .map(move |(name, text)| (format!("{member}/{name}"), *text))
        })
        .collect()
}
