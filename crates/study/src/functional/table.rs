//! The table of levels: what each functional of the family imposes and what it yields.

use super::typesetting::field_name;
use chetaev_functionals::functional::{Functional, Relative};
use chetaev_functionals::Problem;
use chetaev_report::data::{Cell, Table, TableRow};
use std::collections::BTreeMap;

/// The headings of the columns.
pub(super) const HEADINGS: [&str; 5] = ["Level", "Functional", "Fields", "Imposed", "Yields"];

/// A row of the table.
pub(super) struct Row {
    /// One text for each heading.
    pub(super) cells: [String; 5],
    /// Whether it is the functional under study.
    pub(super) is_own: bool,
}

/// The column of the fields.
const FIELDS: usize = 2;

/// The family.
pub(super) fn rows(problem: &Problem) -> Vec<Row> {
    let own = &problem.functional;
    let members = problem.family.iter();
    members
        .map(|member| row(member, member.name == own.name))
        .collect()
}

fn row(own: &Relative, is_own: bool) -> Row {
    let labels = |all: &[String]| -> String {
        let mut all: Vec<&String> = all.iter().collect();
        all.sort_by_key(|label| super::equations::number(label));
        let each: Vec<String> = all.iter().map(|label| format!("({label})")).collect();
        if each.is_empty() {
            "–".to_owned()
        } else {
            each.join(" ")
        }
    };
    Row {
        cells: [
            own.level.clone().unwrap_or_else(|| "–".to_owned()),
            own.name.clone(),
            own.fields.join(", "),
            labels(&own.imposed),
            labels(&own.yields),
        ],
        is_own,
    }
}

/// The table of the report, where the functional belongs to a family.
pub(super) fn table(problem: &Problem) -> Option<Table> {
    if problem.family.is_empty() {
        return None;
    }
    let own = &problem.functional;
    Some(Table {
        id: "levels".into(),
        title: "Levels".into(),
        explanation: vec![
            "Each level imposes one more group of equations before the variation, and so has one field less; what is not imposed follows \
             from the functional."
                .into(),
            format!("The numbers are those of the field equations above{}.", others(problem)),
        ],
        headings: HEADINGS.map(str::to_owned).to_vec(),
        rows: rows(problem)
            .into_iter()
            .map(|row| TableRow {
                cells: cells(own, &row),
                is_marked: row.is_own,
            })
            .collect(),
        ..Table::default()
    })
}

/// Numbers in the table that this functional does not state so, with the members of the family that do.
fn others(problem: &Problem) -> String {
    let own = &problem.functional.equations;
    let is_own = |label: &str, statement: &str| {
        let mut all = own.iter();
        all.any(|e| e.label == label && e.statement() == statement)
    };
    let mut found: BTreeMap<(u64, &str), Vec<&str>> = BTreeMap::new();
    for member in &problem.family {
        for label in member.imposed.iter().chain(&member.yields) {
            let stated = member.equations.iter().find(|(key, _)| key == label);
            if stated.is_some_and(|(_, statement)| !is_own(label, statement)) {
                let key = (super::equations::number(label), label.as_str());
                found.entry(key).or_default().push(&member.name);
            }
        }
    }
    let told = found
        .into_iter()
        .map(|((_, label), names)| format!("; ({label}) of {} is stated there", names.join(", ")));
    told.collect()
}

/// The texts of a row, with the names of the fields typeset.
fn cells(own: &Functional, row: &Row) -> Vec<Cell> {
    let mut cells: Vec<Cell> = row.cells.iter().map(|text| text.as_str().into()).collect();
    let fields = row.cells[FIELDS].split(", ");
    cells[FIELDS] = Cell {
        text: String::new(),
        formulas: fields.map(|field| field_name(own, field)).collect(),
    };
    cells
}
