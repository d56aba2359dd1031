//! A study that is done: its page, its record, its columns.

use chetaev::study::picture::{self, View};
use chetaev::study::summary::Style;
use chetaev::study::table::Table;
use chetaev::study::{functional, page, record, summary, Study};
use serde_json::json;
use wasm_bindgen::prelude::*;

/// What was studied.
enum Studied {
    Motion(Box<Study>, Option<Table>),
    Functional(Box<chetaev::functionals::Study>),
}

/// A study that is done.
#[wasm_bindgen]
pub struct Outcome(Studied);

impl std::fmt::Debug for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Outcome")
    }
}

impl Outcome {
    pub(crate) fn of_motion(study: Study) -> Outcome {
        let table = study
            .motion
            .as_ref()
            .map(|motion| Table::new(&study, motion));
        Outcome(Studied::Motion(Box::new(study), table))
    }

    pub(crate) fn of_functional(study: chetaev::functionals::Study) -> Outcome {
        Outcome(Studied::Functional(Box::new(study)))
    }

    fn table(&self) -> Option<&Table> {
        match &self.0 {
            Studied::Motion(_, table) => table.as_ref(),
            Studied::Functional(_) => None,
        }
    }
}

#[wasm_bindgen]
impl Outcome {
    /// The report, one HTML page.
    pub fn page(&self) -> String {
        match &self.0 {
            Studied::Motion(study, _) => page::page(study, None, &[]),
            Studied::Functional(study) => functional::page(study, None),
        }
    }

    /// The record of the study, as `study.json` has it.
    pub fn record(&self) -> String {
        let text = match &self.0 {
            Studied::Motion(study, _) => serde_json::to_string_pretty(&record::record(study, &[])),
            Studied::Functional(study) => {
                serde_json::to_string_pretty(&functional::record(study, &[], &[]))
            }
        };
        text.unwrap_or_default()
    }

    /// The summary as the command prints it.
    pub fn summary(&self) -> String {
        match &self.0 {
            Studied::Motion(study, _) => summary::summary(study, Style::Plain),
            Studied::Functional(study) => functional::summary(study, Style::Plain),
        }
    }

    /// What a reader must know, as JSON.
    pub fn notices(&self) -> String {
        match &self.0 {
            Studied::Motion(study, _) => json!(study.notices).to_string(),
            Studied::Functional(_) => "[]".to_owned(),
        }
    }

    /// Names of the columns, as JSON; none without a motion.
    #[wasm_bindgen(js_name = columnNames)]
    pub fn column_names(&self) -> String {
        json!(self.table().map(|table| &table.names)).to_string()
    }

    /// The columns, one after the other.
    pub fn columns(&self) -> Vec<f64> {
        self.table()
            .map_or_else(Vec::new, |table| table.columns.concat())
    }

    /// The trajectory as CSV; empty without a motion.
    pub fn csv(&self) -> String {
        self.table().map_or_else(String::new, Table::to_csv)
    }

    /// The trajectory as a NumPy archive; empty without a motion.
    pub fn npz(&self) -> Vec<u8> {
        let archive = self.table().and_then(|table| table.to_npz().ok());
        archive.unwrap_or_default()
    }

    /// The moving picture as JSON, as `chetaev plot --json` describes it; empty where nothing is drawn.
    pub fn scene(&self) -> String {
        self.drawn()
            .map_or_else(String::new, |scene| picture::to_json(&scene))
    }

    /// The moving picture as a GIF file of this size and length; empty where nothing is drawn.
    pub fn film(&self, width: u32, height: u32, seconds: f64) -> Vec<u8> {
        let view = View {
            width,
            height,
            ..View::default()
        };
        let film = self
            .drawn()
            .map(|scene| picture::gif(&scene, &view, seconds));
        film.and_then(Result::ok).unwrap_or_default()
    }

    /// The picture at the end as an SVG document; empty where nothing is drawn.
    pub fn picture(&self, width: u32, height: u32) -> String {
        let view = View {
            width,
            height,
            ..View::default()
        };
        let drawn = self.drawn().map(|scene| picture::svg(&scene, &view));
        drawn.and_then(Result::ok).unwrap_or_default()
    }
}

impl Outcome {
    fn drawn(&self) -> Option<picture::Scene> {
        match &self.0 {
            Studied::Motion(study, _) => picture::scene(study),
            Studied::Functional(_) => None,
        }
    }
}
