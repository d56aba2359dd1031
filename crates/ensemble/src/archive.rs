//! All columns of an ensemble as one NumPy archive, written column by column, part by part.

use crate::columns::{Columns, Kind};
use std::io::{Seek, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Writes an archive (`.npz`) of `count` trajectories into `target`: one array for each column, of `count` numbers or of
/// `count` × samples. `part` gives the bytes of a column for one of `parts` stretches of trajectories that follow each other: number of
/// the stretch, place of the column.
///
/// The same columns give the same bytes: nothing is compressed, and no time is written. Archives beyond four gigabytes are
/// written as such (ZIP64), which NumPy reads.
///
/// # Errors
/// What `part` or the target reports.
pub fn write<W: Write + Seek>(
    columns: &Columns,
    (count, parts): (u64, u64),
    mut part: impl FnMut(u64, usize) -> std::io::Result<Vec<u8>>,
    target: W,
) -> std::io::Result<W> {
    let mut archive = ZipWriter::new(target);
    for (index, column) in columns.list.iter().enumerate() {
        let bytes = 8 * count * column.width() as u64;
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default())
            .large_file(bytes >= u64::from(u32::MAX) - 1024);
        archive.start_file(format!("{}.npy", column.name), options)?;
        archive.write_all(&header(column.kind, count, column.samples))?;
        for stretch in 0..parts {
            archive.write_all(&part(stretch, index)?)?;
        }
    }
    Ok(archive.finish()?)
}

/// The head of an array in the NPY format, version 1.0 (NumPy, `numpy.lib.format`), padded so that the data begin at a
/// multiple of 64 bytes.
fn header(kind: Kind, count: u64, samples: Option<usize>) -> Vec<u8> {
    const BEFORE: usize = 10;
    let letter = match kind {
        Kind::Float => 'f',
        Kind::Integer => 'i',
    };
    let shape = samples.map_or(format!("({count},)"), |s| format!("({count}, {s})"));
    let said = format!("{{'descr': '<{letter}8', 'fortran_order': False, 'shape': {shape}, }}");
    let padded = (BEFORE + said.len() + 1).next_multiple_of(64) - BEFORE;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded as u16).to_le_bytes());
    bytes.extend(format!("{said:<0$}\n", padded - 1).as_bytes());
    bytes
}
