//! Which trajectories were written before a process ended, however it ended.
//!
//! Batches of trajectories are appended to one file, as they end. When the bytes of a batch were written, a line is
//! appended to the journal:
//!
//! ```text
//! COUNT OFFSET LENGTH CHECKSUM CHECK
//! ```
//!
//! COUNT is the number of trajectories in the batch; which they are is said by its bytes ([`crate::Columns::indices`]).
//! CHECKSUM is that of the bytes of the batch, CHECK that of the line before it. A process killed at any moment leaves a
//! journal of whole lines, and perhaps a torn last one, which is passed over; bytes behind the last batch of a line are
//! overwritten. So a batch counts exactly when its line does, and its bytes were written before the line. Where the machine
//! failed, and not the process, a line may be on the disk whose bytes are not: their checksum tells it.

use std::fmt::Write as _;

/// A batch on the disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// Number of its trajectories.
    pub count: u64,
    /// Where its bytes begin.
    pub offset: u64,
    /// How many they are.
    pub length: u64,
    /// Their checksum.
    pub checksum: u64,
}

/// The batches on the disk.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Journal {
    /// In the order in which they were written.
    pub records: Vec<Record>,
    /// Bytes of the journal that are whole lines.
    pub whole: u64,
    /// Where the next batch is to be written.
    pub end: u64,
}

impl Journal {
    /// A journal from the text of its file: everything up to the first line that is not whole or not possible.
    pub fn read(text: &[u8]) -> Journal {
        let mut journal = Journal::default();
        let lines = text.split_inclusive(|&byte| byte == b'\n');
        for line in lines {
            match parse(line) {
                Some(record) if journal.add(record) => journal.whole += line.len() as u64,
                _ => break,
            }
        }
        journal
    }

    /// Takes a batch for written; false where its bytes would lie on those of another, or nowhere.
    pub fn add(&mut self, record: Record) -> bool {
        let Some(end) = record.offset.checked_add(record.length) else {
            return false;
        };
        if record.offset < self.end {
            return false;
        }
        self.end = end;
        self.records.push(record);
        true
    }
}

impl Record {
    /// The record of a batch of `count` trajectories with these bytes.
    pub fn new(count: u64, offset: u64, bytes: &[u8]) -> Record {
        Record {
            count,
            offset,
            length: bytes.len() as u64,
            checksum: checksum(bytes),
        }
    }

    /// Its line.
    pub fn line(&self) -> String {
        let mut line = format!(
            "{} {} {} {:016x}",
            self.count, self.offset, self.length, self.checksum
        );
        let check = checksum(line.as_bytes());
        // Writing to a string does not fail.
        let _ = writeln!(line, " {check:016x}");
        line
    }
}

fn parse(line: &[u8]) -> Option<Record> {
    let line = std::str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (said, check) = line.rsplit_once(' ')?;
    if u64::from_str_radix(check, 16).ok()? != checksum(said.as_bytes()) {
        return None;
    }
    let mut words = said.split(' ');
    let mut number = || words.next()?.parse().ok();
    let (count, offset, length) = (number()?, number()?, number()?);
    let checksum = u64::from_str_radix(words.next()?, 16).ok()?;
    Some(Record {
        count,
        offset,
        length,
        checksum,
    })
}

/// A checksum that tells a torn or exchanged batch: FNV-1a of 64 bits (Fowler, Noll, Vo) over words of eight bytes, the last
/// filled up with zeros, and the length; each word is mixed by a shift, since a product alone moves bits only upwards.
pub fn checksum(bytes: &[u8]) -> u64 {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    let mut take = |word: u64| {
        hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^= hash >> 29;
    };
    let mut chunks = bytes.chunks_exact(8);
    for chunk in &mut chunks {
        let mut word = [0; 8];
        word.copy_from_slice(chunk);
        take(u64::from_le_bytes(word));
    }
    let mut last = [0; 8];
    last[..chunks.remainder().len()].copy_from_slice(chunks.remainder());
    take(u64::from_le_bytes(last));
    take(bytes.len() as u64);
    hash
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(records: &[Record]) -> Vec<u8> {
        records.iter().flat_map(|r| r.line().into_bytes()).collect()
    }

    fn three() -> [Record; 3] {
        [
            Record::new(2, 0, b"two"),
            Record::new(0, 3, b"nought"),
            Record::new(1, 9, b"one"),
        ]
    }

    #[test]
    fn a_journal_is_read_up_to_the_line_that_is_torn() {
        let records = three();
        let whole = text(&records);
        for cut in 0..=whole.len() {
            let journal = Journal::read(&whole[..cut]);
            let lines = whole[..cut].iter().filter(|&&b| b == b'\n').count();
            assert_eq!(journal.records, records[..lines], "{cut}");
            assert_eq!(journal.whole, text(&records[..lines]).len() as u64);
        }
        assert_eq!(Journal::read(&whole).end, 12);
    }

    #[test]
    fn a_changed_byte_ends_the_journal() {
        let whole = text(&three());
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 1;
            let journal = Journal::read(&changed);
            assert!(journal.records.len() < 3, "{place}");
        }
    }

    #[test]
    fn batches_do_not_lie_on_each_other() {
        let [first, second, _] = three();
        let journal = Journal::read(&text(&[
            first,
            Record {
                offset: 2,
                ..second
            },
        ]));
        assert_eq!((journal.records, journal.end), (vec![first], 3));
        // Between them may lie one that was damaged.
        let journal = Journal::read(&text(&[
            first,
            Record {
                offset: 7,
                ..second
            },
        ]));
        assert_eq!((journal.records.len(), journal.end), (2, 13));
        let nowhere = Record {
            offset: u64::MAX,
            ..first
        };
        assert!(!Journal::default().add(nowhere));
    }

    #[test]
    fn the_checksum_sees_every_bit_and_the_length() {
        let bytes: Vec<u8> = (0..37).collect();
        let sum = checksum(&bytes);
        for place in 0..bytes.len() {
            for bit in 0..8 {
                let mut changed = bytes.clone();
                changed[place] ^= 1 << bit;
                assert_ne!(checksum(&changed), sum);
            }
        }
        assert_ne!(checksum(&bytes[..36]), sum);
        assert_ne!(checksum(&[&bytes[..], &[0]].concat()), sum);
    }
}
