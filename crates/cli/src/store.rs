//! A sweep on the disk: blocks as they are finished, a journal of them, and at the end one archive.
//!
//! ```text
//! sweep.json      what was asked for; another sweep is refused
//! sweep.data      finished blocks, in the order in which they were finished
//! sweep.journal   which blocks those are
//! failures.csv    the trajectories that ended early or did not begin
//! sweep.npz       all columns; when it is there and no journal is, the sweep is complete
//! ```

use chetaev::ensemble::{archive, pool, Columns, Journal, Record};
use serde_json::{json, Map, Value};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What was written is brought to the disk at least so often; a process that is killed loses nothing in between, only a
/// machine that fails does.
const SYNC: Duration = Duration::from_millis(500);

/// The file that says what was asked for.
const RECORD: &str = "sweep.json";
/// The results.
pub(crate) const ARCHIVE: &str = "sweep.npz";
/// The reasons.
pub(crate) const FAILURES: &str = "failures.csv";

/// What a folder holds.
pub(crate) enum Opened {
    /// The whole sweep.
    Complete,
    /// Some of its blocks, or none.
    Begun(Box<Store>),
}

/// How many trajectories ended in which way, by the number of the column `stop`.
pub(crate) type Stops = BTreeMap<i64, u64>;

/// The blocks of a sweep.
pub(crate) struct Store {
    folder: PathBuf,
    columns: Columns,
    count: u64,
    size: u64,
    data: File,
    journal: File,
    known: Journal,
    synced: Instant,
}

/// What a sweep is.
pub(crate) struct Asked<'a> {
    /// What makes it another than others.
    pub(crate) description: &'a [(&'static str, String)],
    /// Its columns.
    pub(crate) columns: &'a Columns,
    /// Number of trajectories, and of those in a block.
    pub(crate) count: u64,
    pub(crate) size: u64,
    /// What the numbers of the column `stop` mean.
    pub(crate) stops: &'a [(i64, String)],
}

impl Asked<'_> {
    fn record(&self) -> String {
        let asked: Map<String, Value> = self
            .description
            .iter()
            .map(|(key, value)| ((*key).to_owned(), json!(value)))
            .collect();
        let stops: Map<String, Value> = self
            .stops
            .iter()
            .map(|(number, words)| (number.to_string(), json!(words)))
            .collect();
        let names: Vec<&str> = self.columns.list.iter().map(|c| c.name.as_str()).collect();
        let record = json!({
            "trajectories": self.count,
            "block": self.size,
            "columns": names,
            "stop": stops,
            "read": format!("numpy.load(\"{ARCHIVE}\")"),
            "asked": asked,
        });
        serde_json::to_string_pretty(&record).unwrap_or_default() + "\n"
    }
}

fn at(path: &Path, what: &str) -> impl Fn(std::io::Error) -> String {
    let said = format!("{} cannot be {what}", path.display());
    move |problem| format!("{said}: {problem}")
}

/// Opens the folder of a sweep, a new one or one in which the same sweep was begun.
///
/// # Errors
/// Another sweep in the folder, or a file that cannot be read or written.
pub(crate) fn open(folder: &Path, asked: &Asked<'_>) -> Result<Opened, String> {
    std::fs::create_dir_all(folder).map_err(at(folder, "made"))?;
    let path = |name: &str| folder.join(name);
    match std::fs::read_to_string(path(RECORD)) {
        Ok(text) => compare(folder, &text, asked)?,
        Err(problem) if problem.kind() == std::io::ErrorKind::NotFound => {
            if let Some(name) = [ARCHIVE, "sweep.data", "sweep.journal"]
                .into_iter()
                .find(|name| path(name).exists())
            {
                return Err(format!(
                    "{} holds {name} but no {RECORD} that says of which sweep: choose another folder with --out, or delete it",
                    folder.display()
                ));
            }
            replace(&path(RECORD), |file| {
                file.write_all(asked.record().as_bytes())
            })?;
        }
        Err(problem) => return Err(at(&path(RECORD), "read")(problem)),
    }
    if path(ARCHIVE).exists() && !path("sweep.journal").exists() {
        return Ok(Opened::Complete);
    }
    let editable = |name: &str| {
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create(true).truncate(false);
        options.open(path(name)).map_err(at(&path(name), "opened"))
    };
    let mut store = Store {
        folder: folder.to_owned(),
        columns: asked.columns.clone(),
        count: asked.count,
        size: asked.size,
        data: editable("sweep.data")?,
        journal: editable("sweep.journal")?,
        known: Journal::default(),
        synced: Instant::now(),
    };
    store.take_over().map_err(at(folder, "read"))?;
    Ok(Opened::Begun(Box::new(store)))
}

/// The record of the folder and what is asked for are of one sweep.
fn compare(folder: &Path, text: &str, asked: &Asked<'_>) -> Result<(), String> {
    if text == asked.record() {
        return Ok(());
    }
    let found: Value = serde_json::from_str(text).unwrap_or_default();
    let mut differences: Vec<String> = Vec::new();
    for (key, value) in asked.description {
        let before = found["asked"][*key].as_str().unwrap_or("nothing");
        if before != value {
            let is_short = before.len() + value.len() < 200;
            let values = format!(" ({before}, now {value})");
            differences.push(format!(
                "{key}{}",
                if is_short { values } else { String::new() }
            ));
        }
    }
    let what = match differences.is_empty() {
        true => "its record is not that of this sweep".to_owned(),
        false => format!("what differs: {}", differences.join("; ")),
    };
    Err(format!(
        "{} holds another sweep: {what}; choose another folder with --out, or delete it",
        folder.display()
    ))
}

/// Writes a file completely or not at all, and brings it to the disk.
fn replace(
    path: &Path,
    write: impl FnOnce(&mut File) -> std::io::Result<()>,
) -> Result<(), String> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    let written = File::create(&partial).and_then(|mut file| {
        write(&mut file)?;
        file.sync_all()
    });
    written
        .and_then(|()| std::fs::rename(&partial, path))
        .and_then(|()| sync_folder(path.parent()))
        .map_err(at(path, "written"))
}

/// Brings the names in a folder to the disk, where the system can.
fn sync_folder(folder: Option<&Path>) -> std::io::Result<()> {
    match folder {
        #[cfg(unix)]
        Some(folder) => File::open(folder)?.sync_all(),
        _ => Ok(()),
    }
}

impl Store {
    /// Takes what was written before, up to the first block whose bytes are not those that were written.
    fn take_over(&mut self) -> std::io::Result<()> {
        let mut text = Vec::new();
        self.journal.read_to_end(&mut text)?;
        let blocks = pool::blocks(self.count, self.size);
        let said = Journal::read(blocks, &text);
        let mut records: Vec<Record> = (0..blocks)
            .filter_map(|b| said.record(b).copied())
            .collect();
        records.sort_by_key(|record| record.offset);
        let mut whole = String::new();
        for record in records {
            let bytes = self.bytes(record.offset, record.length);
            if bytes.map_or(true, |bytes| {
                Record::new(record.block, record.offset, &bytes) != record
            }) {
                break;
            }
            whole += &record.line();
        }
        self.known = Journal::read(blocks, whole.as_bytes());
        self.journal.set_len(self.known.whole)?;
        self.data.set_len(self.known.end)?;
        self.journal.seek(SeekFrom::End(0))?;
        Ok(())
    }

    fn bytes(&mut self, offset: u64, length: u64) -> std::io::Result<Vec<u8>> {
        let mut bytes = vec![0; length as usize];
        self.data.seek(SeekFrom::Start(offset))?;
        self.data.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// The blocks that are not written.
    pub(crate) fn missing(&self) -> Vec<u64> {
        self.known.missing()
    }

    /// Writes a finished block, then its line.
    pub(crate) fn append(&mut self, block: u64, bytes: &[u8]) -> Result<(), String> {
        let record = Record::new(block, self.known.end, bytes);
        self.write(record, bytes)
            .map_err(at(&self.folder, "written to"))
    }

    fn write(&mut self, record: Record, bytes: &[u8]) -> std::io::Result<()> {
        self.data.seek(SeekFrom::Start(record.offset))?;
        self.data.write_all(bytes)?;
        self.journal.write_all(record.line().as_bytes())?;
        self.known.add(record);
        if self.synced.elapsed() >= SYNC {
            self.sync()?;
        }
        Ok(())
    }

    /// Brings everything to the disk.
    fn sync(&mut self) -> std::io::Result<()> {
        self.synced = Instant::now();
        self.data.sync_data()?;
        self.journal.sync_data()
    }

    /// Ends a sweep that is not complete.
    pub(crate) fn leave(mut self) -> Result<(), String> {
        self.sync().map_err(at(&self.folder, "written to"))
    }

    /// Makes the archive of all blocks, and deletes the blocks.
    pub(crate) fn finish(mut self) -> Result<Stops, String> {
        let folder = self.folder.clone();
        self.sync().map_err(at(&folder, "written to"))?;
        let records = self.known.complete().ok_or("some blocks are missing")?;
        let mut stops = Stops::new();
        replace(&folder.join(FAILURES), |file| {
            self.write_failures(&records, file)
        })?;
        replace(&folder.join(ARCHIVE), |file| {
            self.write_archive(&records, file, &mut stops)
        })?;
        // A sweep without journal is complete: it goes first.
        for name in ["sweep.journal", "sweep.data"] {
            let path = folder.join(name);
            std::fs::remove_file(&path).map_err(at(&path, "deleted"))?;
        }
        Ok(stops)
    }

    fn trajectories(&self, block: u64) -> usize {
        let range = pool::range(block, self.count, self.size);
        (range.end - range.start) as usize
    }

    fn write_failures(&mut self, records: &[Record], file: &mut File) -> std::io::Result<()> {
        let mut file = BufWriter::new(file);
        writeln!(file, "trajectory,reason")?;
        for record in records {
            let bytes = self.bytes(record.offset, record.length)?;
            let count = self.trajectories(record.block);
            let mut text = String::new();
            for (index, reason) in self.columns.failures(count, &bytes) {
                // Writing to a string does not fail.
                let _ = writeln!(
                    text,
                    "{index},\"{}\"",
                    reason.replace('"', "\"\"").replace('\n', " ")
                );
            }
            file.write_all(text.as_bytes())?;
        }
        file.flush()
    }

    fn write_archive(
        &mut self,
        records: &[Record],
        file: &mut File,
        stops: &mut Stops,
    ) -> std::io::Result<()> {
        let columns = self.columns.clone();
        let (count, blocks) = (self.count, records.len() as u64);
        let part = |block: u64, column: usize| {
            let range = columns.range(column, self.trajectories(block));
            let offset = records[block as usize].offset + range.start as u64;
            let bytes = self.bytes(offset, (range.end - range.start) as u64)?;
            if columns.list[column].name == "stop" {
                for number in bytes
                    .chunks_exact(8)
                    .filter_map(|c| <[u8; 8]>::try_from(c).ok())
                {
                    *stops.entry(i64::from_le_bytes(number)).or_default() += 1;
                }
            }
            Ok(bytes)
        };
        let target = BufWriter::new(file);
        archive::write(&columns, (count, blocks), part, target)?.flush()
    }
}
