//! Files that are written completely or not at all, and their checksums.

use std::path::{Path, PathBuf};

/// A file cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("{} cannot be written: {problem}", path.display())]
pub struct Unwritten {
    /// Which.
    pub path: PathBuf,
    /// As the system says.
    pub problem: std::io::Error,
}

/// Writes a file completely or not at all: to a name of its own beside it, then renamed. What could not be written is removed. Another
/// process that writes the same file has another such name, and a link that somebody put there is replaced, not followed.
///
/// # Errors
/// [`Unwritten`].
pub fn write(path: &Path, content: &[u8]) -> Result<(), Unwritten> {
    replace(path, |file| std::io::Write::write_all(file, content))
}

/// [`write()`] for what is written piece by piece.
///
/// # Errors
/// As [`write()`].
pub fn replace(
    path: &Path,
    write: impl FnOnce(&mut std::fs::File) -> std::io::Result<()>,
) -> Result<(), Unwritten> {
    let describe = |problem| Unwritten {
        path: path.to_owned(),
        problem,
    };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(describe)?;
    }
    let (partial, mut file) = own_beside(path).map_err(describe)?;
    let written = write(&mut file)
        .and_then(|()| file.sync_all())
        .and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|problem| {
        // It may never have been there, and what went wrong is said already.
        let _ = std::fs::remove_file(&partial);
        describe(problem)
    })
}

/// A new file beside `path` that is nobody else's: `NAME.1234-0.partial`, with the number of the process.
fn own_beside(path: &Path) -> std::io::Result<(PathBuf, std::fs::File)> {
    use std::sync::atomic::{AtomicU64, Ordering};
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    let name = path.file_name().unwrap_or_default();
    let mut tries = 0;
    loop {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let mut own = name.to_owned();
        own.push(format!(".{}-{number}.partial", std::process::id()));
        let partial = path.with_file_name(own);
        // What is there already, a link also, is never opened.
        let made = std::fs::OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&partial);
        match made {
            Err(e) if e.kind() == std::io::ErrorKind::AlreadyExists && tries < 100 => tries += 1,
            made => return made.map(|file| (partial, file)),
        }
    }
}

/// A link in the place of the file is an error.
pub(crate) fn not_followed(options: &mut std::fs::OpenOptions) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits() as i32);
    }
    #[cfg(not(unix))]
    let _ = options;
}

/// The checksum of a file's content, SHA-256 (FIPS 180-4) in hexadecimal digits.
pub fn checksum(content: &[u8]) -> String {
    use sha2::{Digest, Sha256};
    let digest = Sha256::digest(content);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The checksum of a file; `None` where it cannot be read.
pub fn checksum_of(path: &Path) -> Option<String> {
    use sha2::{Digest, Sha256};
    let mut digest = Sha256::new();
    let mut file = std::fs::File::open(path).ok()?;
    std::io::copy(&mut file, &mut digest).ok()?;
    let digest = digest.finalize();
    Some(digest.iter().map(|byte| format!("{byte:02x}")).collect())
}
