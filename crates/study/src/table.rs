//! The trajectory as CSV and NPZ.

use crate::study::{Motion, Study};
use std::fmt::Write as _;
use std::io::{Cursor, Write};

/// Named columns of equal length, the time first.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names: `t`, coordinates, velocities, accelerations, `lambda_NAME`, `energy`, integrals.
    pub names: Vec<String>,
    /// Columns.
    pub columns: Vec<Vec<f64>>,
}

impl Table {
    /// The table of a motion.
    pub fn new(study: &Study, motion: &Motion) -> Table {
        let run = &motion.evidence.run;
        let mut table = Table {
            names: vec!["t".into()],
            columns: vec![run.times.clone()],
        };
        let column = |i: usize| (0..run.len()).map(|j| run.row(j)[i]).collect::<Vec<f64>>();
        let coordinates = &study.system.coordinates;
        for (primes, range) in [
            ("", run.layout.q()),
            ("'", run.layout.v()),
            ("''", run.layout.a()),
        ] {
            for (c, i) in coordinates.iter().zip(range) {
                table.push(format!("{}{primes}", c.name), column(i));
            }
        }
        if run.formulation == "routh" {
            for (&l, i) in study
                .prepared
                .terms
                .constraint_index
                .iter()
                .zip(run.layout.lambda())
            {
                table.push(
                    format!("lambda_{}", study.system.constraints[l].name),
                    column(i),
                );
            }
        }
        table.push("energy".into(), motion.evidence.energy.values.clone());
        for followed in &motion.evidence.integrals {
            table.push(
                format!("integral_{}", followed.name),
                followed.values.clone(),
            );
        }
        table
    }

    fn push(&mut self, name: String, column: Vec<f64>) {
        self.names.push(name);
        self.columns.push(column);
    }

    /// Comma-separated values with a header line; shortest decimals that read back exactly.
    pub fn to_csv(&self) -> String {
        let mut text = self.names.join(",");
        text.push('\n');
        for j in 0..self.columns.first().map_or(0, Vec::len) {
            for (i, column) in self.columns.iter().enumerate() {
                if i > 0 {
                    text.push(',');
                }
                // Writing to a string does not fail.
                let _ = write!(text, "{}", column[j]);
            }
            text.push('\n');
        }
        text
    }

    /// A NumPy archive with one array per column; `x'` is stored as `x_d`, `x''` as `x_dd`.
    ///
    /// # Errors
    /// What the archive writer reports.
    pub fn to_npz(&self) -> std::io::Result<Vec<u8>> {
        use npyz::WriterBuilder;
        let mut archive = npyz::npz::NpzWriter::new(Cursor::new(Vec::new()));
        for (name, column) in self.names.iter().zip(&self.columns) {
            // No clock: the same run gives the same bytes.
            let options = npyz::zip::write::FileOptions::default()
                .last_modified_time(npyz::zip::DateTime::default());
            let mut writer = archive
                .array(&array_name(name), options)?
                .default_dtype()
                .shape(&[column.len() as u64])
                .begin_nd()?;
            writer.extend(column)?;
            writer.finish()?;
        }
        let mut buffer = archive
            .zip_writer()
            .finish()
            .map_err(std::io::Error::other)?;
        buffer.flush()?;
        Ok(buffer.into_inner())
    }
}

fn array_name(name: &str) -> String {
    let order = name.chars().filter(|&c| c == '\'').count();
    let base = name.trim_end_matches('\'');
    if order == 0 {
        base.to_string()
    } else {
        format!("{base}_{}", "d".repeat(order))
    }
}
