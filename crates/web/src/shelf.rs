//! The gallery as files that models may include.

use chetaev::model::Files;
use chetaev_gallery::{models, Entry};

/// The texts of the gallery below the folder `gallery`.
pub(crate) struct Shelf;

/// The folder that paths of the gallery begin with.
const FOLDER: &str = "gallery/";

impl Files for Shelf {
    fn read(&self, path: &str) -> Result<String, String> {
        let absent = || {
            "a model in the browser can include the files of the gallery beside it only".to_owned()
        };
        let inside = path.strip_prefix(FOLDER).ok_or_else(absent)?;
        let (folder, file) = inside.rsplit_once('/').ok_or_else(absent)?;
        text(folder, file).map(str::to_owned).ok_or_else(absent)
    }
}

/// The text of a file of the gallery.
pub(crate) fn text(folder: &str, file: &str) -> Option<&'static str> {
    let entry = chetaev_gallery::entries().find(|entry| entry.name == folder)?;
    let found = entry.files.iter().find(|(name, _)| *name == file)?;
    Some(found.1)
}

/// Name, title and files of every model.
pub(crate) fn list() -> serde_json::Value {
    models().map(Entry::to_json).collect()
}
