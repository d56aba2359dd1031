//! The tables of the page.

use super::results::{median, Results, Row, Status};
use super::targets::{targets, Target};
use super::words::{figure, megabytes, power, spread, time};
use std::fmt::Write;

/// A table in Markdown.
pub(crate) fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_string()).collect();
    let rule = vec!["---".to_string(); head.len()];
    let body: String = rows.iter().map(|row| line(row)).collect();
    format!("{}{}{body}\n", line(&head), line(&rule))
}

/// The targets with what was measured.
pub(crate) fn target_table(results: &Results) -> String {
    let row = |target: &Target| {
        let (measured, met) = match (&target.measured, target.met) {
            (Ok(measured), Some(true)) => (measured.clone(), "met"),
            (Ok(measured), _) => (measured.clone(), "**not met**"),
            (Err(why), _) => (why.clone(), "not measured"),
        };
        vec![
            target.what.clone(),
            target.limit.clone(),
            measured,
            met.into(),
        ]
    };
    let rows: Vec<Vec<String>> = targets(results).iter().map(row).collect();
    table(&["what", "target", "measured", ""], &rows)
}

/// Rows of one item and system, the fastest first, each with its ratio to our fastest.
fn ranked<'a>(results: &'a Results, item: &'a str, system: &'a str) -> Vec<&'a Row> {
    let mut rows: Vec<&Row> = results
        .of(item, system)
        .filter(|row| row.counts())
        .collect();
    let key = |row: &Row| {
        (
            row.tolerance.unwrap_or(0.0),
            row.time().unwrap_or(f64::INFINITY),
        )
    };
    rows.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    rows
}

/// Our fastest time at an item, system and tolerance.
fn our_time(results: &Results, item: &str, system: &str, tolerance: Option<f64>) -> Option<f64> {
    let ours = results.of(item, system).filter(|row| row.is_ours());
    let times = ours
        .filter(|row| row.tolerance == tolerance)
        .filter_map(Row::time);
    times.reduce(f64::min)
}

fn name(row: &Row) -> String {
    match row.is_ours() {
        true => format!("**{}**", row.who()),
        false => row.who(),
    }
}

/// How a row compares with our fastest.
fn against(results: &Results, row: &Row) -> String {
    let ours = our_time(results, &row.item, &row.system, row.tolerance);
    match (ours, row.time()) {
        (Some(ours), Some(time)) => figure(time / ours),
        _ => "–".into(),
    }
}

/// Derivation with native code, by system.
pub(crate) fn derivations(results: &Results) -> String {
    let mut text = String::new();
    for system in results.systems("derive") {
        let _ = writeln!(text, "### {system}\n");
        let row = |row: &&Row| {
            let part = |name: &str| row.part(name).map_or("–".into(), time);
            vec![
                name(row),
                spread(&row.seconds),
                part("derive"),
                part("compile"),
                against(results, row),
                row.deviation.map_or("–".into(), power),
            ]
        };
        let rows: Vec<Vec<String>> = ranked(results, "derive", system).iter().map(row).collect();
        let head = [
            "participant",
            "seconds",
            "derivation",
            "code and first value",
            "over our fastest",
            "deviation",
        ];
        text += &table(&head, &rows);
    }
    text
}

/// The right-hand side, by system.
pub(crate) fn right_hand_sides(results: &Results) -> String {
    let mut text = String::new();
    for system in results.systems("rhs") {
        let _ = writeln!(text, "### {system}\n");
        let row = |row: &&Row| {
            vec![
                name(row),
                spread(&row.seconds),
                against(results, row),
                row.deviation.map_or("–".into(), power),
            ]
        };
        let rows: Vec<Vec<String>> = ranked(results, "rhs", system).iter().map(row).collect();
        text += &table(
            &["participant", "one state", "over our fastest", "deviation"],
            &rows,
        );
    }
    text
}

/// Trajectories of one system.
pub(crate) fn trajectories(results: &Results, system: &str) -> String {
    let row = |row: &&Row| {
        let number = |key: &str| row.info[key].as_f64();
        vec![
            row.tolerance.map_or("–".into(), power),
            name(row),
            spread(&row.seconds),
            row.deviation.map_or("–".into(), power),
            number("steps").map_or("–".into(), |x| format!("{x:.0}")),
            number("compile").map_or("–".into(), time),
            against(results, row),
        ]
    };
    let rows: Vec<Vec<String>> = ranked(results, "trajectory", system)
        .iter()
        .map(row)
        .collect();
    let head = [
        "tolerance",
        "participant",
        "one trajectory",
        "error",
        "steps",
        "compilation",
        "over our fastest",
    ];
    table(&head, &rows)
}

/// The ensemble.
pub(crate) fn ensembles(results: &Results) -> String {
    let row = |row: &&Row| {
        vec![
            name(row),
            row.time().map_or("–".into(), |t| figure(1.0 / t)),
            spread(&row.seconds),
            row.deviation.map_or("–".into(), power),
        ]
    };
    let rows: Vec<Vec<String>> = ranked(results, "ensemble", "disc")
        .iter()
        .map(row)
        .collect();
    table(
        &[
            "participant",
            "trajectories in a second of the processor",
            "one trajectory",
            "worst error",
        ],
        &rows,
    )
}

/// The long runs.
pub(crate) fn long_runs(results: &Results) -> String {
    let mut rows = Vec::new();
    for system in results.systems("drift") {
        for row in ranked(results, "drift", system) {
            let part = |name: &str| row.part(name);
            rows.push(vec![
                system.to_string(),
                name(row),
                part("largest").map_or("–".into(), power),
                part("last").map_or("–".into(), power),
                part("time").map_or("–".into(), figure),
                row.time().map_or("–".into(), time),
            ]);
        }
    }
    let head = [
        "system",
        "participant",
        "largest error of the energy",
        "at the end",
        "time reached",
        "one step",
    ];
    table(&head, &rows)
}

/// Largest memory of the processes that derive.
pub(crate) fn memory(results: &Results) -> String {
    let mut rows = Vec::new();
    for system in results.systems("derive") {
        for row in ranked(results, "derive", system) {
            let before = match row.before {
                0 => "–".into(),
                bytes => megabytes(bytes),
            };
            rows.push(vec![
                system.to_string(),
                name(row),
                megabytes(row.memory),
                before,
            ]);
        }
    }
    table(
        &[
            "system",
            "participant",
            "largest",
            "with libraries loaded, before",
        ],
        &rows,
    )
}

/// Where somebody is faster than our fastest: item, system, who, by what factor.
pub(crate) fn losses(results: &Results) -> Vec<String> {
    let mut found = Vec::new();
    for row in results
        .rows
        .iter()
        .filter(|row| !row.is_ours() && row.item != "drift")
    {
        let ours = our_time(results, &row.item, &row.system, row.tolerance);
        let (Some(ours), Some(theirs)) = (ours, row.time()) else {
            continue;
        };
        if theirs < ours {
            let at = row
                .tolerance
                .map_or(String::new(), |t| format!(" at {}", power(t)));
            let factor = figure(ours / theirs);
            found.push(format!(
                "{}, {}{at}: {} is {factor} times as fast as our fastest ({}, {}).",
                super::page::item_name(&row.item),
                row.system,
                row.who(),
                time(theirs),
                time(ours)
            ));
        }
    }
    found
}

/// Wrong answers, refusals and time-outs.
pub(crate) fn excluded(results: &Results) -> String {
    let row = |row: &Row| {
        let what = match row.status {
            Status::Wrong => "wrong",
            Status::Late => "not finished",
            Status::Failed => "failed",
            Status::Unchecked => "not checked",
            Status::Right => return None,
        };
        Some(vec![
            super::page::item_name(&row.item).to_string(),
            row.system.clone(),
            row.tolerance.map_or("–".into(), power),
            row.who(),
            what.to_string(),
            row.reason.replace(['|', '\n'], " "),
        ])
    };
    let rows: Vec<Vec<String>> = results.rows.iter().filter_map(row).collect();
    match rows.is_empty() {
        true => "None.\n\n".into(),
        false => table(
            &["item", "system", "tolerance", "participant", "", "reason"],
            &rows,
        ),
    }
}

/// The figures that the README states.
pub(crate) fn claims(results: &Results) -> Vec<String> {
    let mut found = Vec::new();
    if let Some(ours) = our_time(results, "derive", "bicycle", None) {
        let mut line = format!(
            "The bicycle, from the text of its model to the first accelerations by native code: {}",
            time(ours)
        );
        let peers: Vec<String> = ["sympy", "casadi", "heyoka"]
            .iter()
            .filter_map(|peer| {
                let rows = results
                    .of("derive", "bicycle")
                    .filter(|row| row.peer == *peer);
                let theirs = rows.filter_map(Row::time).reduce(f64::min)?;
                Some(format!(
                    "{peer} takes {} times as long",
                    figure(theirs / ours)
                ))
            })
            .collect();
        if !peers.is_empty() {
            let _ = write!(line, "; {}", peers.join(", "));
        }
        found.push(line + ".");
    }
    let row = results.of("main-job", "sleigh").find(|row| row.counts());
    if let Some(row) = row {
        found.push(format!(
            "`chetaev study gallery/chaplygin-sleigh/model.toml --claims model,formulations,motion`, from the text to the report, as a whole process: {}. Without `--claims` everything is decided, which takes seconds.",
            time(median(&row.wall))
        ));
    }
    found
}
