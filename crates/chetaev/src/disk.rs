//! Models on the disk. All other crates take texts, and included files through [`Files`].

use chetaev_model::Files;
use std::path::{Path, PathBuf};

/// Why a file cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Unreadable {
    /// As the system says.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// A folder, a pipe, a device.
    #[error("it is not a regular file")]
    NotRegular,
    /// No text of a model is so long.
    #[error("it has more than {} MiB", MOST_BYTES >> 20)]
    TooLong,
    /// Its bytes are no text.
    #[error("it is not UTF-8 text")]
    NotText,
}

/// The file system for included files: regular files below the folder of the model, or of the nearest `chetaev.toml` above it. What a
/// model includes ends up in records that are passed on, so that it may not be any file of the machine.
#[derive(Clone, Debug)]
pub struct Disk {
    root: PathBuf,
}

/// The file that says that models below its folder may include each other.
const PROJECT: &str = "chetaev.toml";

/// Most bytes of one text.
const MOST_BYTES: u64 = 16 << 20;

impl Disk {
    /// What a model at this path may include.
    pub fn beside(model: &Path) -> Disk {
        let folder = match model.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let project = folder
            .ancestors()
            .find(|above| above.join(PROJECT).is_file());
        Disk {
            root: project.unwrap_or(&folder).to_owned(),
        }
    }
}

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        let found = Path::new(path).canonicalize().map_err(|e| e.to_string())?;
        if !found.starts_with(&self.root) {
            return Err(format!(
                "it lies outside of {}, and a model includes what is below its own folder only; a file {PROJECT} in a folder above both allows what is below that",
                self.root.display()
            ));
        }
        text_of(&found, true).map_err(|e| e.to_string())
    }
}

/// The text of a file of at most 16 MiB. One that is no regular file may never end, or never begin, and is refused where a `regular` one
/// is needed.
///
/// # Errors
/// Why it cannot be read.
pub fn text_of(path: &Path, regular: bool) -> Result<String, Unreadable> {
    use std::io::Read;
    // Opening a pipe waits for whoever writes into it.
    if regular && !std::fs::metadata(path)?.is_file() {
        return Err(Unreadable::NotRegular);
    }
    let file = std::fs::File::open(path)?;
    let mut bytes = Vec::new();
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(Unreadable::TooLong);
    }
    String::from_utf8(bytes).map_err(|_| Unreadable::NotText)
}
