//! The trajectory as CSV and NPZ.

use crate::motion_evidence::Followed;
use crate::record::zero_word;
use crate::study::{Motion, Study};
use chetaev_ensemble::columns::{array_names, numbered};
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::formulation;
use chetaev_mechanics::redundancy::Reactions;
use chetaev_motion::double_double::{self, decimal};
use chetaev_motion::observe::Observer;
use chetaev_motion::{DoubleDouble, PreciseRows, Run};
use chetaev_symbolic::Expr;
use std::fmt::Write as _;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Decimals of a number of a run in double-double arithmetic.
const DIGITS: usize = 32;

/// Named columns of equal length, the time first.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names: `t`, coordinates, masses with a law of their own, velocities, accelerations, `lambda_NAME`, variables of the formulation alone (momenta,
    /// quasi-velocities, `kappa_NAME`), sensors, `energy`, integrals.
    pub names: Vec<String>,
    /// Columns.
    pub columns: Vec<Vec<f64>>,
    /// The same with all their digits, of a run in double-double arithmetic; none otherwise.
    pub precise: Vec<Vec<DoubleDouble>>,
}

impl Table {
    /// The table of a motion.
    pub fn new(study: &Study, motion: &Motion) -> Table {
        let mut table = Table::of_rows(study, &motion.evidence.run);
        table.follow("energy".into(), &motion.evidence.energy);
        for followed in &motion.evidence.integrals {
            table.follow(format!("integral_{}", followed.name), followed);
        }
        table
    }

    /// What the rows of a run hold.
    fn of_rows(study: &Study, run: &Run) -> Table {
        let mut table = Table {
            names: vec!["t".into()],
            columns: vec![run.times.clone()],
            precise: Vec::new(),
        };
        let precise = run.precise.as_ref();
        table.precise.extend(precise.map(|own| own.times.clone()));
        let width = run.layout.len();
        let column = |i: usize| {
            let digits = |rows: &PreciseRows| {
                let places = (0..run.len()).map(|j| rows.rows[j * width + i]);
                places.collect::<Vec<DoubleDouble>>()
            };
            let doubles: Vec<f64> = (0..run.len()).map(|j| run.row(j)[i]).collect();
            (doubles, precise.map(digits))
        };
        let coordinates = &study.system.coordinates;
        for (c, i) in coordinates.iter().zip(run.layout.q()) {
            table.push(c.name.clone(), column(i));
        }
        for (mass, i) in study.system.masses.iter().zip(run.layout.masses()) {
            table.push(mass.name.clone(), column(i));
        }
        for (primes, range) in [("'", run.layout.v()), ("''", run.layout.a())] {
            for (c, i) in coordinates.iter().zip(range) {
                table.push(format!("{}{primes}", c.name), column(i));
            }
        }
        let is_other = formulation(run.formulation)
            .is_some_and(|f| f.card().relation == Relation::Coincidence);
        if !is_other {
            let (system, prepared) = (&study.system, &study.prepared);
            let reactions = Reactions::of(system, &prepared.terms, &prepared.selection);
            let rows = prepared.terms.constraint_index.iter().enumerate();
            for ((row, &l), i) in rows.zip(run.layout.lambda()) {
                if !reactions.undetermined.contains(&row) {
                    table.push(format!("lambda_{}", system.constraints[l].name), column(i));
                }
            }
            table.combinations(study, run, &reactions);
        }
        for (name, i) in run.own.iter().zip(run.layout.own()) {
            table.push(name.clone(), column(i));
        }
        table.sense(study, run, is_other);
        table
    }

    /// What the sensors of the model measure. Those of multipliers that are not determined one by one, or that belong to another motion,
    /// are left out.
    fn sense(&mut self, study: &Study, run: &Run, is_other: bool) {
        let (system, terms) = (&study.system, &study.prepared.terms);
        let Some(motion) = study
            .motion
            .as_ref()
            .filter(|_| !study.model.sensors.is_empty())
        else {
            return;
        };
        let g = &system.graph;
        let multiplier = |row: usize| {
            let constraint = &system.constraints[terms.constraint_index[row]];
            g.symbol(&format!("lambda_{}", constraint.name), 0)
        };
        let rows = if is_other {
            (0..terms.constraint_index.len()).collect()
        } else {
            Reactions::of(system, terms, &study.prepared.selection).undetermined
        };
        let unknown: Vec<Expr> = rows.into_iter().map(multiplier).collect();
        for sensor in &study.model.sensors {
            let held = g.symbols_in(&[sensor.value]);
            let mut held = held.into_iter().map(|symbol| g.symbol_expr(symbol));
            if held.any(|symbol| unknown.contains(&symbol)) {
                continue;
            }
            let value = [sensor.value];
            let parts = (system, terms, &motion.binding);
            let Ok(precise) = double_double::along(parts, run, &value) else {
                continue;
            };
            let precise = precise.and_then(|mut all| all.pop());
            let observer = Observer::with_own(system, terms, &motion.binding, &run.own, &value);
            let series = observer.ok().and_then(|mut own| own.along(run).pop());
            if let Some(values) = series {
                self.push(sensor.name.clone(), (values, precise));
            }
        }
    }

    /// The table of the events met, as CSV: the name of the event and how its function passes zero, then the columns of a
    /// trajectory but for energy and integrals. `None` where the model states no events.
    pub fn events(study: &Study, motion: &Motion) -> Option<String> {
        let stated = &motion.settings.events;
        if stated.is_empty() {
            return None;
        }
        let run = &motion.evidence.run;
        let happened = Run {
            times: run.events.iter().map(|met| met.t).collect(),
            rows: run.events.iter().flat_map(|met| met.row.clone()).collect(),
            precise: run.precise.as_ref().map(|own| PreciseRows {
                times: own.events.iter().map(|(t, _)| *t).collect(),
                rows: own.events.iter().flat_map(|(_, row)| row.clone()).collect(),
                ..own.clone()
            }),
            ..run.clone()
        };
        let table = Table::of_rows(study, &happened);
        let mut text = format!("event,zero,{}\n", table.names.join(","));
        for (j, met) in run.events.iter().enumerate() {
            let _ = write!(text, "{},{}", stated[met.event].name, zero_word(met.kind));
            for i in 0..table.columns.len() {
                text.push(',');
                table.write(&mut text, (i, j));
            }
            text.push('\n');
        }
        Some(text)
    }

    /// The determined ones among the combinations of multipliers that are not determined one by one.
    fn combinations(&mut self, study: &Study, run: &Run, reactions: &Reactions) {
        let (system, terms) = (&study.system, &study.prepared.terms);
        let Some(motion) = &study.motion else {
            return;
        };
        // With all digits they are not evaluated.
        if run.precise.is_some() {
            return;
        }
        for (text, value) in reactions.texts(system) {
            let observer = Observer::with_own(system, terms, &motion.binding, &run.own, &[value]);
            let Ok(mut observer) = observer else {
                continue;
            };
            if let Some(values) = observer.along(run).pop() {
                self.push(text.replace(',', ";"), (values, None));
            }
        }
    }

    fn push(&mut self, name: String, (column, precise): (Vec<f64>, Option<Vec<DoubleDouble>>)) {
        // A coordinate may be called `energy`, or as the multiplier of a constraint is: no two columns share a name.
        let name = numbered(name, |wish| self.names.iter().any(|own| own == wish));
        self.names.push(name);
        self.columns.push(column);
        self.precise.extend(precise);
    }

    fn follow(&mut self, name: String, followed: &Followed) {
        self.push(name, (followed.values.clone(), followed.precise.clone()));
    }

    /// Writes the number of column i and row j.
    fn write(&self, text: &mut String, (i, j): (usize, usize)) {
        match self.precise.get(i) {
            Some(column) => text.push_str(&decimal(column[j], DIGITS)),
            // Writing to a string does not fail.
            None => {
                let _ = write!(text, "{}", self.columns[i][j]);
            }
        }
    }

    /// Comma-separated values with a header line: shortest decimals that read back exactly, or 32 digits of a run in double-double
    /// arithmetic.
    pub fn to_csv(&self) -> String {
        let mut text = self.names.join(",");
        text.push('\n');
        for j in 0..self.columns.first().map_or(0, Vec::len) {
            for i in 0..self.columns.len() {
                if i > 0 {
                    text.push(',');
                }
                self.write(&mut text, (i, j));
            }
            text.push('\n');
        }
        text
    }

    /// A NumPy archive with one array per column; `x'` is stored as `x_d`, `x''` as `x_dd`. Of a run in double-double arithmetic
    /// what the doubles leave out is stored beside them, as `x_low`. Where another column has that name, a number is put behind
    /// it ([`array_names`]).
    ///
    /// # Errors
    /// What the archive writer reports.
    pub fn to_npz(&self) -> std::io::Result<Vec<u8>> {
        let low = self.precise.iter().map(|column| {
            let low: Vec<f64> = column.iter().map(|x| x.low()).collect();
            npy(&[low.len()], &low)
        });
        let arrays = self
            .columns
            .iter()
            .map(|column| npy(&[column.len()], column))
            .chain(low);
        archive(self.arrays().into_iter().zip(arrays))
    }

    /// The names of the arrays, no two the same: of the columns, then of what their doubles leave out.
    fn arrays(&self) -> Vec<String> {
        let mut names = array_names(&self.names);
        let low = self.precise.iter().zip(names.clone());
        let low: Vec<String> = low.map(|(_, name)| format!("{name}_low")).collect();
        for name in low {
            names.push(numbered(name, |wish| names.iter().any(|own| own == wish)));
        }
        names
    }
}

/// A NumPy archive of arrays in the NPY format.
///
/// # Errors
/// What the archive writer reports.
pub(crate) fn archive(arrays: impl Iterator<Item = (String, Vec<u8>)>) -> std::io::Result<Vec<u8>> {
    // No clock: the same run gives the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, array) in arrays {
        archive.start_file(format!("{name}.npy"), options)?;
        archive.write_all(&array)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// One array of doubles, row by row, in the NPY format, version 1.0 (NumPy, `numpy.lib.format`): the header is padded so that the
/// data begin at a multiple of 64 bytes.
pub(crate) fn npy(shape: &[usize], values: &[f64]) -> Vec<u8> {
    let shape: Vec<String> = shape.iter().map(|n| format!("{n},")).collect();
    let values: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    npy_of("<f8", &shape.concat(), &values)
}

/// An array of texts in the same format.
pub(crate) fn npy_texts(texts: &[String]) -> Vec<u8> {
    let width = texts
        .iter()
        .map(|t| t.chars().count())
        .max()
        .unwrap_or(0)
        .max(1);
    let padded = |t: &String| -> Vec<char> {
        let rest = width - t.chars().count();
        t.chars().chain(std::iter::repeat_n('\0', rest)).collect()
    };
    let values: Vec<u8> = texts
        .iter()
        .flat_map(padded)
        .flat_map(|c| (c as u32).to_le_bytes())
        .collect();
    npy_of(&format!("<U{width}"), &format!("{},", texts.len()), &values)
}

fn npy_of(kind: &str, shape: &str, values: &[u8]) -> Vec<u8> {
    const BEFORE: usize = 10;
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    let padded = (BEFORE + header.len() + 1).next_multiple_of(64) - BEFORE;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded as u16).to_le_bytes());
    bytes.extend(format!("{header:<0$}\n", padded - 1).as_bytes());
    bytes.extend(values);
    bytes
}
