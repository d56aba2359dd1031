//! A sweep on the disk: batches of trajectories as they end, a journal of them, and at the end one archive.
//!
//! ```text
//! sweep.lock      held by the process that computes; empty
//! sweep.json      what was asked for; another sweep is refused
//! sweep.data      trajectories that have ended, in the order in which they ended
//! sweep.journal   which bytes of it those are
//! failures.csv    the trajectories that ended early or did not begin
//! sweep.npz       all columns; when it is there and no journal is, the sweep is complete
//! sweep.sha256    checksums of both, as `sha256sum` writes and checks them; a sweep is believed to be complete by these only
//! ```

use crate::files;
use chetaev_ensemble::pool::{self, Batch};
use chetaev_ensemble::{archive, Columns, Journal, Outcome, Record};
use chetaev_study::sweep::Sweep;
use serde_json::{json, Map, Value};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

mod lock;

/// Why a sweep is not kept in a folder.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotKept {
    /// A file of it.
    #[error("{} cannot be {what}: {problem}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// What was tried.
        what: &'static str,
        /// What the system says.
        problem: std::io::Error,
    },
    /// A file that was to be written whole.
    #[error(transparent)]
    NotWritten(#[from] files::Unwritten),
    /// Another process has the folder.
    #[error("another process computes a sweep in {}: wait until it has ended, or choose another folder with --out", folder.display())]
    Taken {
        /// The folder.
        folder: PathBuf,
    },
    /// Trajectories without a record of which sweep they are.
    #[error("{} holds {name} but no {RECORD} that says of which sweep: choose another folder with --out, or delete it", folder.display())]
    NoRecord {
        /// The folder.
        folder: PathBuf,
        /// What it holds.
        name: &'static str,
    },
    /// Another sweep.
    #[error("{} holds another sweep: {what}; choose another folder with --out, or delete it", folder.display())]
    Other {
        /// The folder.
        folder: PathBuf,
        /// What differs.
        what: String,
    },
    /// What was changed since it was written.
    #[error("{0} holds {ARCHIVE} and {FAILURES} that are not what a sweep wrote there: their checksums are not those of {SUMS}; choose another folder with --out, or delete {0}", folder.display())]
    Changed {
        /// The folder.
        folder: PathBuf,
    },
    /// Less than all.
    #[error("some trajectories are missing")]
    Missing,
}

/// What was written is brought to the disk at least so often; a process that is killed loses nothing in between, only a
/// machine that fails does.
const SYNC: Duration = Duration::from_millis(500);

/// The file that says what was asked for.
const RECORD: &str = "sweep.json";
const DATA: &str = "sweep.data";
const JOURNAL: &str = "sweep.journal";
const SUMS: &str = "sweep.sha256";
/// The file of the results.
pub const ARCHIVE: &str = "sweep.npz";
/// The file of the reasons.
pub const FAILURES: &str = "failures.csv";

/// The archive is made of stretches of trajectories of which no column has more than so many numbers, and `failures.csv` of
/// stretches of so many trajectories: no more is in memory.
const STRETCH: u64 = 1 << 22;

/// A trajectory that ended early or did not begin, and why.
pub type Failure = (u64, String);

/// What a folder holds.
#[derive(Debug)]
pub enum Opened {
    /// The whole sweep; its first failure.
    Complete(Option<Failure>),
    /// Some of its trajectories, or none.
    Begun(Box<Store>),
}

/// How a computation ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// All trajectories are there.
    Complete,
    /// Somebody interrupted.
    Interrupted,
    /// A trajectory failed and the sweep was to end at the first.
    Failed(Failure),
}

/// How many trajectories ended in which way, by the number of the column `stop`.
pub type Stops = BTreeMap<i64, u64>;

/// The trajectories of a sweep that have ended.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    columns: Columns,
    count: u64,
    data: File,
    journal: File,
    known: Journal,
    /// For each record the smallest range that holds its trajectories.
    spans: Vec<Range<u64>>,
    written: Written,
    failure: Option<Failure>,
    synced: Instant,
    /// What is to be said of the lock.
    note: Option<String>,
    /// Released when this ends, or the process does, however it ends.
    _lock: File,
}

/// Which trajectories are written: one bit for each.
#[derive(Debug, Default)]
struct Written {
    bits: Vec<u64>,
    number: u64,
}

impl Written {
    fn of(count: u64) -> Written {
        Written {
            bits: vec![0; count.div_ceil(64) as usize],
            number: 0,
        }
    }

    fn has(&self, index: u64) -> bool {
        let word = self.bits.get((index / 64) as usize);
        word.is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    fn add(&mut self, index: u64) {
        if let Some(word) = self.bits.get_mut((index / 64) as usize) {
            self.number += u64::from(*word >> (index % 64) & 1 == 0);
            *word |= 1 << (index % 64);
        }
    }
}

/// What a sweep is.
struct Asked<'a> {
    /// What makes it another than others.
    description: &'a [(&'static str, String)],
    /// Its columns.
    columns: &'a Columns,
    /// Number of trajectories.
    count: u64,
    /// What the numbers of the column `stop` mean.
    stops: &'a [(i64, String)],
}

/// What the numbers of the column `stop` mean.
pub fn stops_in_words(sweep: &Sweep) -> Vec<(i64, String)> {
    let mut words = vec![
        (0, "the end of the time span was reached".to_owned()),
        (1, "ended early; the reason is in failures.csv".to_owned()),
        (2, "did not begin; the reason is in failures.csv".to_owned()),
    ];
    let events = sweep.events();
    let events = (10..)
        .zip(events)
        .map(|(number, name)| (number, format!("event {name}")));
    words.extend(events);
    words
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
            "columns": names,
            "stop": stops,
            "read": format!("numpy.load(\"{ARCHIVE}\")"),
            "asked": asked,
        });
        serde_json::to_string_pretty(&record).unwrap_or_default() + "\n"
    }
}

fn at(path: &Path, what: &'static str) -> impl Fn(std::io::Error) -> NotKept {
    let path = path.to_owned();
    move |problem| NotKept::File {
        path: path.clone(),
        what,
        problem,
    }
}

/// Opens the folder of a sweep, a new one or one in which the same sweep was begun.
///
/// # Errors
/// Another process that computes in the folder, another sweep in it, or a file that cannot be read or written.
pub fn open(folder: &Path, sweep: &Sweep) -> Result<Opened, NotKept> {
    let (description, stops) = (sweep.description(), stops_in_words(sweep));
    let asked = Asked {
        description: &description,
        columns: sweep.columns(),
        count: sweep.count(),
        stops: &stops,
    };
    opened(folder, &asked)
}

fn opened(folder: &Path, asked: &Asked<'_>) -> Result<Opened, NotKept> {
    std::fs::create_dir_all(folder).map_err(at(folder, "made"))?;
    let path = |name: &str| folder.join(name);
    let is_complete = || path(RECORD).exists() && path(ARCHIVE).exists() && !path(JOURNAL).exists();
    // What is complete stays as it is, and may lie where nothing can be written.
    if is_complete() {
        check_record(folder, asked)?;
        check_sums(folder)?;
        return Ok(Opened::Complete(first_of_file(&path(FAILURES))));
    }
    let (lock, note) = lock::folder(folder)?;
    check_record(folder, asked)?;
    if is_complete() {
        check_sums(folder)?;
        return Ok(Opened::Complete(first_of_file(&path(FAILURES))));
    }
    let editable = |name: &str| {
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create(true).truncate(false);
        files::not_followed(options);
        options.open(path(name)).map_err(at(&path(name), "opened"))
    };
    let mut store = Store {
        folder: folder.to_owned(),
        columns: asked.columns.clone(),
        count: asked.count,
        data: editable(DATA)?,
        journal: editable(JOURNAL)?,
        known: Journal::default(),
        spans: Vec::new(),
        written: Written::of(asked.count),
        failure: None,
        synced: Instant::now(),
        note,
        _lock: lock,
    };
    store.take_over()?;
    Ok(Opened::Begun(Box::new(store)))
}

/// The record in the folder is of this sweep; where there is none, and nothing else, it is written.
fn check_record(folder: &Path, asked: &Asked<'_>) -> Result<(), NotKept> {
    let path = |name: &str| folder.join(name);
    match std::fs::read_to_string(path(RECORD)) {
        Ok(text) => compare(folder, &text, asked),
        Err(problem) if problem.kind() == std::io::ErrorKind::NotFound => {
            let mut names = [ARCHIVE, DATA, JOURNAL].into_iter();
            if let Some(name) = names.find(|name| path(name).exists()) {
                return Err(NotKept::NoRecord {
                    folder: folder.to_owned(),
                    name,
                });
            }
            replace(&path(RECORD), |file| {
                file.write_all(asked.record().as_bytes())
            })
        }
        Err(problem) => Err(at(&path(RECORD), "read")(problem)),
    }
}

/// The files that a complete sweep consists of, as `sha256sum` lists them.
fn sums(folder: &Path) -> Result<String, NotKept> {
    let line = |name: &str| {
        let path = folder.join(name);
        let unread = || at(&path, "read")(std::io::ErrorKind::InvalidData.into());
        let sum = files::checksum_of(&path).ok_or_else(unread)?;
        Ok(format!("{sum}  {name}\n"))
    };
    [ARCHIVE, FAILURES].into_iter().map(line).collect()
}

/// What lies in the folder is what a sweep wrote.
fn check_sums(folder: &Path) -> Result<(), NotKept> {
    let stated = std::fs::read_to_string(folder.join(SUMS)).unwrap_or_default();
    if sums(folder)? == stated {
        Ok(())
    } else {
        Err(NotKept::Changed {
            folder: folder.to_owned(),
        })
    }
}

/// The first failure in `failures.csv`, as [`Store::write_failures`] writes it.
fn first_of_file(path: &Path) -> Option<Failure> {
    let file = std::io::BufReader::new(File::open(path).ok()?);
    let line = std::io::BufRead::lines(file).nth(1)?.ok()?;
    let (index, reason) = line.split_once(',')?;
    let reason = reason.strip_prefix('"')?.strip_suffix('"')?;
    Some((index.parse().ok()?, reason.replace("\"\"", "\"")))
}

/// The record of the folder and what is asked for are of one sweep.
fn compare(folder: &Path, text: &str, asked: &Asked<'_>) -> Result<(), NotKept> {
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
    Err(NotKept::Other {
        folder: folder.to_owned(),
        what,
    })
}

/// Writes a file completely or not at all, and brings it to the disk.
fn replace(
    path: &Path,
    write: impl FnOnce(&mut File) -> std::io::Result<()>,
) -> Result<(), NotKept> {
    files::replace(path, write)?;
    sync_folder(path.parent()).map_err(at(path, "written"))
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
    /// Takes what was written before, but for batches whose bytes are not those that were written.
    fn take_over(&mut self) -> Result<(), NotKept> {
        let mut text = Vec::new();
        let read = self.journal.read_to_end(&mut text);
        read.map_err(at(&self.folder.join(JOURNAL), "read"))?;
        let said = Journal::read(&text);
        for &record in &said.records {
            let Ok(bytes) = self.batch(&record) else {
                continue;
            };
            let indices = Columns::indices(record.count as usize, &bytes);
            let is_new = |&index: &u64| index < self.count && !self.written.has(index);
            if indices.len() as u64 == record.count && indices.iter().all(is_new) {
                let failures = self.columns.failures(indices.len(), &bytes);
                self.take(record, &indices, failures);
            }
        }
        let is_whole = self.known.records.len() == said.records.len();
        if !is_whole {
            let lines: String = self.known.records.iter().map(Record::line).collect();
            let path = self.folder.join(JOURNAL);
            replace(&path, |file| file.write_all(lines.as_bytes()))?;
            let file = OpenOptions::new().read(true).write(true).open(&path);
            self.journal = file.map_err(at(&path, "opened"))?;
            self.known.whole = lines.len() as u64;
        } else {
            self.known.whole = said.whole;
        }
        let cut = (self.journal.set_len(self.known.whole))
            .and_then(|()| self.data.set_len(self.known.end))
            .and_then(|()| self.journal.seek(SeekFrom::End(0)));
        cut.map(|_| ()).map_err(at(&self.folder, "written to"))
    }

    /// Notes what is written.
    fn take(&mut self, record: Record, indices: &[u64], failures: Vec<Failure>) {
        if !self.known.add(record) {
            return;
        }
        let first = indices.iter().min().copied().unwrap_or_default();
        let last = indices.iter().max().copied().unwrap_or_default();
        self.spans.push(first..last + 1);
        for &index in indices {
            self.written.add(index);
        }
        let all = failures.into_iter().chain(self.failure.take());
        self.failure = all.min_by_key(|(index, _)| *index);
    }

    fn bytes(&mut self, offset: u64, length: u64) -> std::io::Result<Vec<u8>> {
        let mut bytes = vec![0; length as usize];
        self.data.seek(SeekFrom::Start(offset))?;
        self.data.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// The bytes of a batch, which are those that were written.
    fn batch(&mut self, record: &Record) -> std::io::Result<Vec<u8>> {
        let damaged = || {
            let end = record.offset.saturating_add(record.length);
            std::io::Error::other(format!(
                "bytes {} to {end} of {DATA}, {} trajectories, are damaged: their checksum is not that of what was written; the same \
                 command computes these trajectories again",
                record.offset, record.count
            ))
        };
        // Before memory is asked for.
        if record.offset.saturating_add(record.length) > self.data.metadata()?.len() {
            return Err(damaged());
        }
        let bytes = self.bytes(record.offset, record.length)?;
        match Record::new(record.count, record.offset, &bytes) == *record {
            true => Ok(bytes),
            false => Err(damaged()),
        }
    }

    /// How many trajectories are written.
    pub fn written(&self) -> u64 {
        self.written.number
    }

    /// The failure of the lowest number among what is written.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// The trajectories that are not written, in ascending ranges.
    fn missing(&self) -> Vec<Range<u64>> {
        let mut missing: Vec<Range<u64>> = Vec::new();
        for index in (0..self.count).filter(|&index| !self.written.has(index)) {
            match missing.last_mut() {
                Some(last) if last.end == index => last.end = index + 1,
                _ => missing.push(index..index + 1),
            }
        }
        missing
    }

    /// Writes a batch, each trajectory with its values, then its line.
    fn append(&mut self, rows: &[(u64, Vec<f64>, Outcome)]) -> Result<(), NotKept> {
        let bytes = self.columns.encode(rows);
        let record = Record::new(rows.len() as u64, self.known.end, &bytes);
        self.write(record, &bytes)
            .map_err(at(&self.folder, "written to"))?;
        let indices: Vec<u64> = rows.iter().map(|(index, ..)| *index).collect();
        let failures = self.columns.failures(rows.len(), &bytes);
        self.take(record, &indices, failures);
        Ok(())
    }

    fn write(&mut self, record: Record, bytes: &[u8]) -> std::io::Result<()> {
        self.data.seek(SeekFrom::Start(record.offset))?;
        self.data.write_all(bytes)?;
        self.journal.write_all(record.line().as_bytes())?;
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

    /// Computes what is missing, until all is there, somebody interrupts, or, where that is wanted, a trajectory fails. `tell` is called after each
    /// batch with how many are written and how many of those that were computed now have failed.
    ///
    /// # Errors
    /// A batch cannot be written.
    pub fn compute(
        &mut self,
        sweep: &Sweep,
        (threads, ends_at_failure): (usize, bool),
        interrupt: &AtomicBool,
        tell: &mut dyn FnMut(u64, usize),
    ) -> Result<Ended, NotKept> {
        let (work, missing) = (sweep.work(), self.missing());
        let mut failures = 0;
        let mut ended = Ok(Ended::Complete);
        let sink = |batch: Batch| {
            let rows = batch.into_iter();
            let rows: Vec<_> = rows.map(|(i, o)| (i, sweep.values(i), o)).collect();
            if let Err(problem) = self.append(&rows) {
                ended = Err(problem);
                return ControlFlow::Break(());
            }
            failures += rows.iter().filter(|(.., o)| o.stop.is_failure()).count();
            tell(self.written(), failures);
            match self.failure().filter(|_| ends_at_failure) {
                Some(failure) => {
                    ended = Ok(Ended::Failed(failure.clone()));
                    ControlFlow::Break(())
                }
                None => ControlFlow::Continue(()),
            }
        };
        pool::run(&*work, (&missing, threads), interrupt, sink);
        match ended? {
            Ended::Complete if self.written() < self.count => Ok(Ended::Interrupted),
            ended => Ok(ended),
        }
    }

    /// What is to be said to whoever started this: that nothing keeps others out of the folder.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// All that is written as one batch in the order of the numbers, as [`Columns::encode`] makes it, and of how many trajectories.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn batches(&mut self) -> Result<(usize, Vec<u8>), NotKept> {
        let read = at(&self.folder, "read");
        self.joined().map_err(read)
    }

    fn joined(&mut self) -> std::io::Result<(usize, Vec<u8>)> {
        let mut rows: Vec<(u64, usize, usize)> = Vec::new();
        let mut parts: Vec<(usize, Vec<u8>)> = Vec::new();
        for record in self.known.records.clone() {
            let (bytes, count) = (self.batch(&record)?, record.count as usize);
            let indices = Columns::indices(count, &bytes).into_iter().enumerate();
            rows.extend(indices.map(|(row, index)| (index, parts.len(), row)));
            parts.push((count, bytes));
        }
        rows.sort_unstable();
        let mut all: Vec<u8> = Vec::new();
        all.extend(rows.iter().flat_map(|(index, ..)| index.to_le_bytes()));
        for (column, own) in self.columns.list.iter().enumerate() {
            let width = 8 * own.width();
            for &(_, part, row) in &rows {
                let (count, bytes) = &parts[part];
                let first = self.columns.range(column, *count).start + row * width;
                all.extend_from_slice(&bytes[first..first + width]);
            }
        }
        // Failures stand behind the columns, each with its number.
        for (count, bytes) in &parts {
            let end = 8 * (1 + self.columns.width()) * count;
            all.extend_from_slice(bytes.get(end..).unwrap_or_default());
        }
        Ok((rows.len(), all))
    }

    /// Ends a sweep that is not complete.
    ///
    /// # Errors
    /// What was computed does not come to the disk.
    pub fn leave(mut self) -> Result<(), NotKept> {
        self.sync().map_err(at(&self.folder, "written to"))
    }

    /// Makes the archive of all trajectories, and deletes the batches.
    ///
    /// # Errors
    /// Trajectories are missing or damaged, or a file cannot be written.
    pub fn finish(self) -> Result<Stops, NotKept> {
        self.finished()
    }

    fn finished(mut self) -> Result<Stops, NotKept> {
        let folder = self.folder.clone();
        self.sync().map_err(at(&folder, "written to"))?;
        if self.written.number != self.count {
            return Err(NotKept::Missing);
        }
        let mut stops = Stops::new();
        replace(&folder.join(FAILURES), |file| self.write_failures(file))?;
        replace(&folder.join(ARCHIVE), |file| {
            self.write_archive(file, &mut stops)?;
            // After what was read was read: damage does not mend itself.
            for record in self.known.records.clone() {
                self.batch(&record)?;
            }
            Ok(())
        })?;
        let sums = sums(&folder)?;
        replace(&folder.join(SUMS), |file| file.write_all(sums.as_bytes()))?;
        // A sweep without journal is complete: it goes first.
        for name in [JOURNAL, DATA] {
            let path = folder.join(name);
            std::fs::remove_file(&path).map_err(at(&path, "deleted"))?;
        }
        Ok(stops)
    }

    /// The records that hold trajectories of a stretch, perhaps.
    fn records(&self, stretch: &Range<u64>) -> Vec<Record> {
        let all = self.known.records.iter().zip(&self.spans);
        all.filter(|(_, span)| span.start < stretch.end && stretch.start < span.end)
            .map(|(record, _)| *record)
            .collect()
    }

    fn stretches(&self, length: u64) -> impl Iterator<Item = Range<u64>> {
        let count = self.count;
        (0..count.div_ceil(length)).map(move |k| k * length..((k + 1) * length).min(count))
    }

    fn write_failures(&mut self, file: &mut File) -> std::io::Result<()> {
        let mut file = BufWriter::new(file);
        writeln!(file, "trajectory,reason")?;
        for stretch in self.stretches(STRETCH) {
            let mut failures: Vec<Failure> = Vec::new();
            for record in self.records(&stretch) {
                let bytes = self.batch(&record)?;
                let own = self.columns.failures(record.count as usize, &bytes);
                failures.extend(own.into_iter().filter(|(index, _)| stretch.contains(index)));
            }
            failures.sort_by_key(|(index, _)| *index);
            for (index, reason) in failures {
                let reason = reason.replace('"', "\"\"").replace('\n', " ");
                writeln!(file, "{index},\"{reason}\"")?;
            }
        }
        file.flush()
    }

    fn write_archive(&mut self, file: &mut File, stops: &mut Stops) -> std::io::Result<()> {
        let (columns, count) = (self.columns.clone(), self.count);
        let widest = columns.list.iter().map(|c| c.width()).max();
        let length = (STRETCH / widest.unwrap_or(1).max(1) as u64).max(1);
        let stretches: Vec<Range<u64>> = self.stretches(length).collect();
        let part = |stretch: u64, column: usize| {
            let bytes = self.part(&stretches[stretch as usize], column)?;
            if columns.list[column].name == "stop" {
                let words = bytes.chunks_exact(8);
                for number in words.filter_map(|c| <[u8; 8]>::try_from(c).ok()) {
                    *stops.entry(i64::from_le_bytes(number)).or_default() += 1;
                }
            }
            Ok(bytes)
        };
        let target = BufWriter::new(file);
        archive::write(&columns, (count, stretches.len() as u64), part, target)?.flush()
    }

    /// The numbers of a column for a stretch of trajectories, in order.
    fn part(&mut self, stretch: &Range<u64>, column: usize) -> std::io::Result<Vec<u8>> {
        let width = 8 * self.columns.list[column].width();
        let mut bytes = vec![0; (stretch.end - stretch.start) as usize * width];
        for record in self.records(stretch) {
            let count = record.count as usize;
            let indices = self.bytes(record.offset, 8 * record.count)?;
            let range = self.columns.range(column, count);
            let offset = record.offset + range.start as u64;
            let own = self.bytes(offset, (range.end - range.start) as u64)?;
            let rows = Columns::indices(count, &indices).into_iter();
            for (index, row) in rows.zip(own.chunks_exact(width)) {
                if stretch.contains(&index) {
                    let place = (index - stretch.start) as usize * width;
                    bytes[place..place + width].copy_from_slice(row);
                }
            }
        }
        Ok(bytes)
    }
}
