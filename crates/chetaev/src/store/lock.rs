//! One process in a folder at a time.

use super::NotKept;
use std::fs::{File, OpenOptions};
use std::path::Path;

/// The file that is locked; it stays, since a file that is deleted while another process opens it protects nothing.
const LOCK: &str = "sweep.lock";

/// What came of the attempt to lock.
#[cfg_attr(
    not(any(unix, windows)),
    allow(dead_code, reason = "without files there are no locks to be had")
)]
enum Locked {
    Alone(File),
    Taken,
    /// The file system has no locks.
    Unknown(File),
}

/// Locks a folder for this process, until the file is dropped or the process ends, however it ends. Beside it what is to be said where the file
/// system has no locks.
///
/// # Errors
/// Another process has it, or the file cannot be made.
pub(super) fn folder(folder: &Path) -> Result<(File, Option<String>), NotKept> {
    let path = folder.join(LOCK);
    match lock(&path) {
        Ok(Locked::Alone(file)) => Ok((file, None)),
        Ok(Locked::Unknown(file)) => {
            let said = format!(
                "{} cannot be locked here: see to it that no other sweep runs in the same folder",
                folder.display()
            );
            Ok((file, Some(said)))
        }
        Ok(Locked::Taken) => Err(NotKept::Taken {
            folder: folder.to_owned(),
        }),
        Err(problem) => Err(NotKept::File {
            path,
            what: "opened",
            problem,
        }),
    }
}

fn options() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    crate::files::not_followed(&mut options);
    options
}

#[cfg(unix)]
fn lock(path: &Path) -> std::io::Result<Locked> {
    use rustix::fs::{flock, FlockOperation};
    use rustix::io::Errno;
    let file = options().open(path)?;
    match flock(&file, FlockOperation::NonBlockingLockExclusive) {
        Ok(()) => Ok(Locked::Alone(file)),
        Err(Errno::WOULDBLOCK) => Ok(Locked::Taken),
        Err(Errno::NOSYS | Errno::NOTSUP | Errno::NOLCK | Errno::INVAL) => {
            Ok(Locked::Unknown(file))
        }
        Err(problem) => Err(problem.into()),
    }
}

/// A file that is shared with nobody can be opened once.
#[cfg(windows)]
fn lock(path: &Path) -> std::io::Result<Locked> {
    use std::os::windows::fs::OpenOptionsExt;
    const SHARING_VIOLATION: i32 = 32;
    match options().share_mode(0).open(path) {
        Ok(file) => Ok(Locked::Alone(file)),
        Err(problem) if problem.raw_os_error() == Some(SHARING_VIOLATION) => Ok(Locked::Taken),
        Err(problem) => Err(problem),
    }
}

#[cfg(not(any(unix, windows)))]
fn lock(path: &Path) -> std::io::Result<Locked> {
    Ok(Locked::Unknown(options().open(path)?))
}
