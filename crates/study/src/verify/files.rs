//! The files of a record, which lie beside it, against their checksums.

use super::{Replay, Verified};
use crate::record::{Record, WrittenRecord};
use std::ffi::OsStr;
use std::path::Path;

/// Whether the files beside a record are those that were written with it; `checksum` gives the SHA-256 of the file of a name there, in hexadecimal
/// digits, and nothing where it cannot be read.
pub fn files(record: &Record, checksum: &mut dyn FnMut(&str) -> Option<String>) -> Vec<Verified> {
    let line = |file: &WrittenRecord| Verified {
        claim: file.name.clone(),
        recorded: "sha256".into(),
        replay: replay(file, checksum),
    };
    record.files.iter().map(line).collect()
}

fn replay(file: &WrittenRecord, checksum: &mut dyn FnMut(&str) -> Option<String>) -> Replay {
    // A record may come from anybody; it names files beside itself only.
    if Path::new(&file.name).file_name() != Some(OsStr::new(&file.name)) {
        return Replay::Differs {
            found: "no file name".into(),
            detail: "files of a record lie beside it".into(),
        };
    }
    match checksum(&file.name) {
        None => Replay::Remark {
            what: "it is not beside the record, or cannot be read".into(),
        },
        Some(found) if found == file.sha256 => Replay::Confirmed,
        Some(found) => Replay::Differs {
            found,
            detail: "the content is not what was written with this record".into(),
        },
    }
}
