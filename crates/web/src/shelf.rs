//! The gallery as files that models may include.

use chetaev_gallery::{entries, models, Entry};
use std::collections::BTreeMap;

/// The folder that paths of the gallery begin with.
const FOLDER: &str = "gallery/";

/// The texts that a model at this path may include: those of its folder in the gallery, and of its group.
pub(crate) fn beside(path: &str) -> BTreeMap<String, String> {
    let inside = path.strip_prefix(FOLDER).unwrap_or_default();
    let folder = inside.split('/').next().unwrap_or_default();
    let is_near = |entry: &&Entry| entry.name.split('/').next() == Some(folder);
    let near = entries().filter(is_near);
    near.flat_map(|entry| {
        let files = entry.files.iter();
        files.map(|(file, text)| (format!("{FOLDER}{}/{file}", entry.name), (*text).to_owned()))
    })
    .collect()
}

/// The text of a file of the gallery.
pub(crate) fn text(folder: &str, file: &str) -> Option<&'static str> {
    let entry = entries().find(|entry| entry.name == folder)?;
    let found = entry.files.iter().find(|(name, _)| *name == file)?;
    Some(found.1)
}

/// Name, title and files of every model.
pub(crate) fn list() -> serde_json::Value {
    models().map(Entry::to_json).collect()
}
