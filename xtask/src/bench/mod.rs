//! `cargo xtask bench`: the benchmark, and the pages made of its results.

mod judge;
mod machine;
mod measure;
mod page;
mod plan;
mod plot;
mod results;
mod tables;
mod talk;
mod targets;
mod words;
mod workplace;

use crate::{err, out, refuse};
use plan::{Extent, Item, Participant};
use results::{Results, Row, Status};
use workplace::{root, Workplace};

const HELP: &str = "\
The benchmark

Usage: cargo xtask bench [--peers] [--quick] [--only TEXT] [--again] [--references] [--page]

Measures our side, and with --peers the others, in one run: participants take turns, each bound to one processor, and
answers are checked before times count. What is measured already is not measured again. At the end bench/results.json,
docs/book/benchmark.md with its plots, and the figures in README.md are written from what was measured.

  --peers        also the peers; makes a Python environment with pinned versions in the build folder
  --quick        under an hour: fewer tolerances, repeats and peers of large systems, but all targets
  --only TEXT    items whose name ITEM/SYSTEM/PEER contains TEXT
  --again        measures again what is measured already
  --references   computes all references again
  --page         measures nothing: writes the pages from bench/results.json
  --help         this text

The exit status is 0 when every participant was measured or has its reason, 1 when the benchmark could not be made,
and 2 for wrong arguments.
";

#[derive(Default)]
struct Arguments {
    peers: bool,
    quick: bool,
    again: bool,
    references: bool,
    page: bool,
    only: Option<String>,
}

fn parse(words: &[String]) -> Result<Arguments, String> {
    let mut asked = Arguments::default();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--peers" => asked.peers = true,
            "--quick" => asked.quick = true,
            "--again" => asked.again = true,
            "--references" => asked.references = true,
            "--page" => asked.page = true,
            "--only" => match words.next() {
                Some(text) => asked.only = Some(text.clone()),
                None => return Err("--only needs a text, as in --only trajectory/disc".into()),
            },
            other => {
                return Err(format!(
                    "unknown argument `{other}`; see `cargo xtask bench --help`"
                ))
            }
        }
    }
    Ok(asked)
}

/// Runs the task.
pub(crate) fn run(words: &[String]) -> u8 {
    if words.iter().any(|word| word == "--help" || word == "-h") {
        out(HELP);
        return 0;
    }
    let asked = match parse(words) {
        Ok(asked) => asked,
        Err(slip) => return refuse(&slip),
    };
    let done = match asked.page {
        true => Results::read(&root().join("bench/results.json")).and_then(|r| page::write(&r)),
        false => bench(&asked),
    };
    match done {
        Ok(()) => 0,
        Err(problem) => {
            err(&format!("error: {problem}\n"));
            1
        }
    }
}

fn bench(asked: &Arguments) -> Result<(), String> {
    let mut place = Workplace::new()?;
    place.build()?;
    let items = plan::items(Extent {
        quick: asked.quick,
        peers: asked.peers,
    });
    if asked.peers || asked.references {
        place.environment()?;
        // A row of the table has no motion.
        let of_motion = items.iter().filter(|item| item.kind != "table");
        let mut systems: Vec<&str> = of_motion.map(|item| item.system).collect();
        systems.sort_unstable();
        systems.dedup();
        place.compute_references(&systems, asked.references)?;
    }
    let kept = place.bench().join(match asked.quick {
        true => "quick.json",
        false => "full.json",
    });
    let mut results = Results::read(&kept).unwrap_or_default();
    results.quick = asked.quick;
    results.date = machine::said("date", &["-u", "+%Y-%m-%d"]).unwrap_or_default();
    results.machine = machine::machine();
    results.versions.extend(place.versions(asked.peers));
    results.references = place.reference_words();
    for (number, item) in items.iter().enumerate() {
        let wanted = wanted(item, &results, asked);
        if wanted.is_empty() {
            continue;
        }
        let name = name(item);
        err(&format!("[{}/{}] {name}\n", number + 1, items.len()));
        for row in measure::measure(&place, item, &wanted) {
            report(&row);
            results.put(row);
        }
        results.write(&kept)?;
    }
    results.write(&root().join("bench/results.json"))?;
    page::write(&results)
}

fn name(item: &Item) -> String {
    let tolerance = item.tolerance.map_or(String::new(), |t| format!("/{t:e}"));
    format!("{}/{}{tolerance}", item.kind, item.system)
}

/// Participants that are asked for and not measured yet.
fn wanted<'a>(item: &'a Item, results: &Results, asked: &Arguments) -> Vec<&'a Participant> {
    let is_done = |participant: &Participant| {
        let known = Row {
            item: item.kind.into(),
            system: item.system.into(),
            peer: participant.peer.into(),
            form: participant.form.into(),
            variant: participant.variant.into(),
            tolerance: item.tolerance,
            ..Row::default()
        };
        let key = known.key();
        results.rows.iter().any(|row| row.key() == key)
    };
    let is_named = |participant: &Participant| {
        let whole = format!("{}/{}", name(item), participant.peer);
        asked
            .only
            .as_ref()
            .is_none_or(|text| whole.contains(text.as_str()))
    };
    let participants = item.participants.iter();
    participants
        .filter(|p| is_named(p) && (asked.again || !is_done(p)))
        .collect()
}

fn report(row: &Row) {
    let what = match (row.status, row.time()) {
        (Status::Right | Status::Unchecked, Some(time)) => words::time(time),
        _ => format!("{:?}: {}", row.status, row.reason),
    };
    let off = row
        .deviation
        .map_or(String::new(), |d| format!(", off by {d:.1e}"));
    err(&format!("    {}: {what}{off}\n", row.who()));
}

#[cfg(test)]
mod tests;
