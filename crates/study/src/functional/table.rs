//! The table of levels: what each functional of the family imposes and what it yields.

use chetaev_functionals::functional::{Functional, Relative, Role};
use chetaev_functionals::Problem;
use chetaev_report::data::{Table, TableRow};

/// The headings of the columns.
pub(super) const HEADINGS: [&str; 5] = ["Level", "Functional", "Fields", "Imposed", "Yields"];

/// A row of the table.
pub(super) struct Row {
    /// One text for each heading.
    pub(super) cells: [String; 5],
    /// Whether it is the functional under study.
    pub(super) is_own: bool,
}

/// The family; where none is stated, the functional alone.
pub(super) fn rows(problem: &Problem) -> Vec<Row> {
    let own = &problem.functional;
    if problem.family.is_empty() {
        return vec![row(&relative(own), true)];
    }
    let members = problem.family.iter();
    members
        .map(|member| row(member, member.name == own.name))
        .collect()
}

fn relative(own: &Functional) -> Relative {
    let labels = |role: Role| own.with_role(role).map(|e| e.label.clone()).collect();
    Relative {
        name: own.name.clone(),
        level: own.level.clone(),
        density: own.written.clone(),
        fields: own
            .fields
            .iter()
            .map(|field| match &field.on {
                Some(on) => format!("{} on {on}", field.name),
                None => field.name.clone(),
            })
            .collect(),
        imposed: labels(Role::Imposed),
        yields: labels(Role::Yielded),
    }
}

fn row(own: &Relative, is_own: bool) -> Row {
    let labels = |all: &[String]| -> String {
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

/// The table of the report.
pub(super) fn table(problem: &Problem) -> Table {
    Table {
        id: "levels".into(),
        title: "Levels".into(),
        explanation: vec![
            "Each level imposes one more group of equations before the variation, and so has one field less; what is not imposed follows \
             from the functional. The numbers are those of the field equations below."
                .into(),
        ],
        headings: HEADINGS.map(str::to_owned).to_vec(),
        rows: rows(problem)
            .into_iter()
            .map(|row| TableRow {
                cells: row.cells.to_vec(),
                is_marked: row.is_own,
            })
            .collect(),
    }
}
