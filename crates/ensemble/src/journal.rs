//! Which blocks were written before a process ended, however it ended.
//!
//! Blocks are appended to one file, in the order in which they are finished. When the bytes of a block were written, a line is
//! appended to the journal:
//!
//! ```text
//! BLOCK OFFSET LENGTH CHECKSUM CHECK
//! ```
//!
//! CHECKSUM is that of the bytes of the block, CHECK that of the line before it. A process killed at any moment leaves a
//! journal of whole lines, and perhaps a torn last one, which is passed over; bytes behind the last block of a line are
//! overwritten. So a block counts exactly when its line does, and its bytes were written before the line. Where the machine
//! failed, and not the process, a line may be on the disk whose bytes are not: their checksum tells it.

use std::fmt::Write as _;

/// A block on the disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// Number of the block.
    pub block: u64,
    /// Where its bytes begin.
    pub offset: u64,
    /// How many they are.
    pub length: u64,
    /// Their checksum.
    pub checksum: u64,
}

/// The blocks on the disk.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Journal {
    records: Vec<Option<Record>>,
    /// Bytes of the journal that are whole lines.
    pub whole: u64,
    /// Where the next block is to be written.
    pub end: u64,
}

impl Journal {
    /// A journal of an ensemble of `blocks` blocks, from the text of its file: everything up to the first line that is not
    /// whole or not possible.
    pub fn read(blocks: u64, text: &[u8]) -> Journal {
        let mut journal = Journal {
            records: vec![None; blocks as usize],
            ..Journal::default()
        };
        let lines = text.split_inclusive(|&byte| byte == b'\n');
        for line in lines {
            let Some(record) = parse(line) else { break };
            if record.offset != journal.end || !journal.add(record) {
                break;
            }
            journal.whole += line.len() as u64;
        }
        journal
    }

    /// Takes a block for written; false where there is no such block, or it was written before.
    pub fn add(&mut self, record: Record) -> bool {
        match self.records.get_mut(record.block as usize) {
            Some(place @ None) => {
                *place = Some(record);
                self.end = record.offset + record.length;
                true
            }
            _ => false,
        }
    }

    /// Where a block is.
    pub fn record(&self, block: u64) -> Option<&Record> {
        self.records.get(block as usize)?.as_ref()
    }

    /// The blocks that are not written.
    pub fn missing(&self) -> Vec<u64> {
        let missing = self.records.iter().enumerate().filter(|(_, r)| r.is_none());
        missing.map(|(block, _)| block as u64).collect()
    }

    /// All blocks, in order; `None` while some are missing.
    pub fn complete(&self) -> Option<Vec<Record>> {
        self.records.iter().copied().collect()
    }
}

impl Record {
    /// The record of a block with these bytes.
    pub fn new(block: u64, offset: u64, bytes: &[u8]) -> Record {
        Record {
            block,
            offset,
            length: bytes.len() as u64,
            checksum: checksum(bytes),
        }
    }

    /// Its line.
    pub fn line(&self) -> String {
        let mut line = format!(
            "{} {} {} {:016x}",
            self.block, self.offset, self.length, self.checksum
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
    let (block, offset, length) = (number()?, number()?, number()?);
    let checksum = u64::from_str_radix(words.next()?, 16).ok()?;
    Some(Record {
        block,
        offset,
        length,
        checksum,
    })
}

/// A checksum that tells a torn or exchanged block: FNV-1a of 64 bits (Fowler, Noll, Vo) over words of eight bytes, the last
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
        let two = text(&records[..2]).len();
        for cut in 0..=whole.len() {
            let journal = Journal::read(3, &whole[..cut]);
            let lines = whole[..cut].iter().filter(|&&b| b == b'\n').count();
            let written = 3 - journal.missing().len();
            assert_eq!(written, lines, "{cut}");
            assert_eq!(journal.whole, text(&records[..lines]).len() as u64);
            assert_eq!(journal.complete().is_some(), lines == 3);
        }
        assert_eq!(Journal::read(3, &whole[..two]).missing(), [1]);
        assert_eq!(Journal::read(3, &whole).end, 12);
    }

    #[test]
    fn a_changed_byte_ends_the_journal() {
        let whole = text(&three());
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 1;
            let journal = Journal::read(3, &changed);
            assert!(journal.complete().is_none(), "{place}");
        }
    }

    #[test]
    fn a_block_counts_once() {
        let [first, ..] = three();
        let again = Record { offset: 3, ..first };
        let journal = Journal::read(3, &text(&[first, again]));
        assert_eq!(journal.missing(), [0, 1]);
        assert_eq!(journal.end, 3);
        assert!(!Journal::read(1, &[]).add(first));
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
