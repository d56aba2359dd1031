//! What was measured: rows, and the conditions they were measured under.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// A run of the benchmark.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Results {
    /// Whether it was a short one: fewer systems, tolerances, repeats and steps.
    pub(crate) quick: bool,
    /// Day of its last part.
    pub(crate) date: String,
    /// The machine.
    pub(crate) machine: Machine,
    /// Versions of all tools.
    pub(crate) versions: BTreeMap<String, String>,
    /// By system, how its reference was computed.
    pub(crate) references: BTreeMap<String, String>,
    /// What was measured.
    pub(crate) rows: Vec<Row>,
}

/// Where it ran.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Machine {
    /// Name of the processor.
    pub(crate) processor: String,
    /// Its cores.
    pub(crate) cores: usize,
    /// Its vector units among AVX2, FMA, AVX-512.
    pub(crate) vectors: String,
    /// Memory in bytes.
    pub(crate) memory: u64,
    /// The operating system.
    pub(crate) system: String,
}

/// How a measurement ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Status {
    /// Measured, and the answer is right.
    #[default]
    Right,
    /// The answer is wrong: its time does not count.
    Wrong,
    /// The participant refused, or broke.
    Failed,
    /// It did not finish within its time.
    Late,
    /// Measured, but there is no reference to compare with.
    Unchecked,
}

/// One participant at one item.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Row {
    /// `derive`, `rhs`, `trajectory`, `ensemble`, `drift`, `main-job` or `table`.
    pub(crate) item: String,
    /// The system.
    pub(crate) system: String,
    /// The participant.
    pub(crate) peer: String,
    /// `text` of a model, `derived` or `hand`.
    pub(crate) form: String,
    /// Mode, method or formulation.
    pub(crate) variant: String,
    /// Tolerance asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) tolerance: Option<f64>,
    /// How it ended.
    pub(crate) status: Status,
    /// Why, where it is not right.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) reason: String,
    /// Largest relative deviation from the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) deviation: Option<f64>,
    /// Seconds of the processor for one unit, one for each repeat.
    #[serde(default)]
    pub(crate) seconds: Vec<f64>,
    /// The same of the wall.
    #[serde(default)]
    pub(crate) wall: Vec<f64>,
    /// Largest memory of the process, in bytes; that of programs it has run where that is more.
    #[serde(default)]
    pub(crate) memory: u64,
    /// Memory before the work began, with all libraries loaded.
    #[serde(default)]
    pub(crate) before: u64,
    /// Remarks of the participant.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub(crate) info: Value,
    /// What the seconds consist of, and other figures, at the last repeat.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub(crate) parts: Value,
    /// A curve that belongs to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) curve: Option<[Vec<f64>; 2]>,
    /// Load average of the last minute, before and after.
    pub(crate) load: [f64; 2],
}

impl Row {
    /// What distinguishes it from all others.
    pub(crate) fn key(&self) -> String {
        let tolerance = self.tolerance.map_or(String::new(), |t| format!("{t:e}"));
        let parts = [
            &self.item,
            &self.system,
            &self.peer,
            &self.form,
            &self.variant,
            &tolerance,
        ];
        parts.map(String::as_str).join("/")
    }

    /// Whether its time counts.
    pub(crate) fn counts(&self) -> bool {
        matches!(self.status, Status::Right | Status::Unchecked) && !self.seconds.is_empty()
    }

    /// Median of the seconds, where they count.
    pub(crate) fn time(&self) -> Option<f64> {
        self.counts().then(|| median(&self.seconds))
    }

    /// A figure among the parts.
    pub(crate) fn part(&self, name: &str) -> Option<f64> {
        self.parts.get(name)?.as_f64()
    }

    /// Who it is, in words.
    pub(crate) fn who(&self) -> String {
        let form = match self.form.as_str() {
            "text" => "",
            form => form,
        };
        let words = [self.peer.as_str(), form, self.variant.as_str()];
        let words: Vec<&str> = words.into_iter().filter(|w| !w.is_empty()).collect();
        words.join(", ")
    }

    /// Whether it is ours.
    pub(crate) fn is_ours(&self) -> bool {
        self.peer == "chetaev"
    }
}

/// The middle one of values.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[middle],
        _ => (sorted[middle - 1] + sorted[middle]) / 2.0,
    }
}

impl Results {
    /// Reads a file.
    pub(crate) fn read(path: &Path) -> Result<Results, String> {
        let text = std::fs::read_to_string(path);
        let text = text.map_err(|problem| format!("{}: {problem}", path.display()))?;
        serde_json::from_str(&text).map_err(|problem| format!("{}: {problem}", path.display()))
    }

    /// Writes it, completely or not at all.
    pub(crate) fn write(&self, path: &Path) -> Result<(), String> {
        write_whole(path, &self.text().map_err(|problem| problem.to_string())?)
    }

    /// As JSON with each row on its own line: the file is read by people and compared by lines.
    fn text(&self) -> serde_json::Result<String> {
        let head = Results {
            rows: Vec::new(),
            ..self.clone()
        };
        let head = serde_json::to_string_pretty(&head)?;
        let rows: Result<Vec<String>, _> = self.rows.iter().map(serde_json::to_string).collect();
        let rows = rows?.join(",\n    ");
        let whole = format!("\"rows\": [\n    {rows}\n  ]");
        Ok(head.replace("\"rows\": []", &whole) + "\n")
    }

    /// Puts a row in the place of the one with its key, or at the end.
    pub(crate) fn put(&mut self, row: Row) {
        match self.rows.iter_mut().find(|old| old.key() == row.key()) {
            Some(old) => *old = row,
            None => self.rows.push(row),
        }
    }

    /// The rows of an item and system.
    pub(crate) fn of<'a>(
        &'a self,
        item: &'a str,
        system: &'a str,
    ) -> impl Iterator<Item = &'a Row> + 'a {
        let rows = self.rows.iter();
        rows.filter(move |row| row.item == item && row.system == system)
    }

    /// Systems with rows of an item, in the order of the rows.
    pub(crate) fn systems(&self, item: &str) -> Vec<&str> {
        let mut found: Vec<&str> = Vec::new();
        for row in self.rows.iter().filter(|row| row.item == item) {
            if !found.contains(&row.system.as_str()) {
                found.push(&row.system);
            }
        }
        found
    }

    /// Smallest and largest load average over all rows.
    pub(crate) fn load(&self) -> Option<(f64, f64)> {
        let all = self.rows.iter().flat_map(|row| row.load);
        all.fold(None, |range, load| match range {
            None => Some((load, load)),
            Some((low, high)) => Some((low.min(load), high.max(load))),
        })
    }
}

/// Writes to a temporary name, then renames.
pub(crate) fn write_whole(path: &Path, text: &str) -> Result<(), String> {
    let said = |problem: std::io::Error| format!("{}: {problem}", path.display());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(said)?;
    }
    let temporary = path.with_extension("part");
    std::fs::write(&temporary, text).map_err(said)?;
    std::fs::rename(&temporary, path).map_err(said)
}
