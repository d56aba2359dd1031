//! `chetaev sweep`.

use super::{error, listen, options, with_hooks, INTERRUPTED};
use crate::arguments::Sweep as Arguments;
use crate::files::Read;
use crate::progress::ProgressLine;
use crate::store::{self, Asked, Opened, Stops, Store, ARCHIVE, FAILURES};
use crate::{files, terminal, DONE, INPUT, STOPPED};
use chetaev::ensemble::pool::{self, Block};
use chetaev::model::Diagnostics;
use chetaev::study::diagnostics;
use chetaev::study::sweep::together::{Together, Variations};
use chetaev::study::sweep::vary::{rows, Variation};
use chetaev::study::sweep::{Sweep, SweepOptions};
use serde_json::{json, Map, Value};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::Ordering;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let Some(study) = options(&arguments.motion, &read.model) else {
        return INPUT;
    };
    let Some(variations) = variations(arguments, &read) else {
        return INPUT;
    };
    let options = SweepOptions {
        study,
        samples: arguments.samples,
    };
    let made = with_hooks(|hooks| Sweep::new(&read.model, variations, options, hooks));
    let sweep = match made {
        Ok(sweep) => sweep,
        Err(problem) => {
            read.refuse_all(diagnostics(&problem, &read.model));
            return INPUT;
        }
    };
    let folder = arguments.out.clone().unwrap_or_else(|| {
        let mut folder = files::default_folder(&arguments.model.model).into_os_string();
        folder.push("-sweep");
        folder.into()
    });
    match in_folder(arguments, &sweep, &folder) {
        Ok(status) => status,
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

/// What varies; prints what is wrong with it.
fn variations(arguments: &Arguments, read: &Read) -> Option<Variations> {
    let model = &read.model;
    let mut ranges: Vec<Variation> = Vec::new();
    let mut problems: Vec<Diagnostics> = Vec::new();
    let given = [
        ("--vary", false, &arguments.vary),
        ("--initial", true, &arguments.initial),
    ];
    for (label, initial, texts) in given {
        for text in texts {
            match Variation::parse(model, (label, text), initial) {
                Ok(variation) => ranges.push(variation),
                Err(problem) => problems.push(problem),
            }
        }
    }
    let mut from_file = Vec::new();
    if let Some(path) = &arguments.rows {
        let label = path.to_string_lossy();
        match std::fs::read_to_string(path) {
            Ok(text) => match rows(model, &label, &text) {
                Ok(list) => from_file = list,
                Err(problem) => problems.push(problem),
            },
            Err(problem) => {
                error(format!("{label} cannot be read: {problem}"));
                return None;
            }
        }
    }
    if !problems.is_empty() {
        problems.iter().for_each(files::report);
        return None;
    }
    let together = Together {
        zip: arguments.zip,
        count: arguments.count,
        seed: arguments.seed,
    };
    match Variations::new(from_file, ranges, together) {
        Ok(variations) => Some(variations),
        Err(problem) => {
            error(problem);
            None
        }
    }
}

/// How many trajectories are a block: enough to write seldom, few enough to lose little.
fn block_size(count: u64) -> u64 {
    (count / 200).clamp(8, 512).max(count / 100_000)
}

fn in_folder(arguments: &Arguments, sweep: &Sweep, folder: &Path) -> Result<u8, String> {
    let (count, size) = (sweep.count(), block_size(sweep.count()));
    let description = sweep.description();
    let stops = stops_in_words(sweep);
    let asked = Asked {
        description: &description,
        columns: sweep.columns(),
        count,
        size,
        stops: &stops,
    };
    let mut store = match store::open(folder, &asked)? {
        Opened::Complete => {
            say(
                arguments,
                &format!("{} is complete; nothing was computed", folder.display()),
            );
            return Ok(DONE);
        }
        Opened::Begun(store) => store,
    };
    let missing = store.missing();
    let taken = count - missing.iter().map(|&b| length(b, count, size)).sum::<u64>();
    if taken > 0 && !arguments.json {
        terminal::err(&format!(
            "{taken} of {count} trajectories were computed before"
        ));
    }
    let threads = arguments.threads.unwrap_or_else(|| {
        std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get)
    });
    listen();
    let ended = super::with_progress(|line| {
        compute(
            sweep,
            &mut store,
            (size, &missing, threads),
            taken,
            arguments.stop_on_failure,
            line,
        )
    });
    match ended {
        Ended::Complete => {
            let stops = store.finish()?;
            summary(arguments, sweep, folder, &stops, taken);
            Ok(DONE)
        }
        Ended::Interrupted => {
            let left = store
                .missing()
                .iter()
                .map(|&b| length(b, count, size))
                .sum::<u64>();
            store.leave()?;
            terminal::err(&format!(
                "interrupted; {} of {count} trajectories are kept, and the same command goes on",
                count - left
            ));
            Ok(STOPPED)
        }
        Ended::Failed(index, reason) => {
            store.leave()?;
            error(format!(
                "trajectory {index} ({}): {reason}; what was computed is kept",
                values_in_words(sweep, index)
            ));
            Ok(STOPPED)
        }
        Ended::Disk(problem) => Err(problem),
    }
}

fn length(block: u64, count: u64, size: u64) -> u64 {
    let range = pool::range(block, count, size);
    range.end - range.start
}

/// How the computation ended.
enum Ended {
    Complete,
    Interrupted,
    /// A trajectory failed and the sweep was to end at the first.
    Failed(u64, String),
    /// A block cannot be written.
    Disk(String),
}

fn compute(
    sweep: &Sweep,
    store: &mut Store,
    (size, missing, threads): (u64, &[u64], usize),
    taken: u64,
    stop_on_failure: bool,
    line: &ProgressLine,
) -> Ended {
    let (count, began) = (sweep.count(), line.seconds());
    let (mut done, mut failures) = (0, 0);
    let mut ended = Ended::Complete;
    let work = sweep.work();
    line.show(&format!("computing {count} trajectories"), None);
    pool::run(
        &*work,
        (size, missing, threads),
        &INTERRUPTED,
        |block: Block| {
            let rows: Vec<_> = block
                .range
                .clone()
                .map(|index| sweep.values(index))
                .zip(block.outcomes)
                .collect();
            let bytes = sweep.columns().encode(block.range.start, &rows);
            if let Err(problem) = store.append(block.number, &bytes) {
                ended = Ended::Disk(problem);
                return ControlFlow::Break(());
            }
            done += rows.len() as u64;
            failures += rows.iter().filter(|(_, o)| o.stop.is_failure()).count();
            let told = match line.is_painted() {
                true => told((done, taken, count), failures, line.seconds() - began),
                false => format!("computing {count} trajectories"),
            };
            line.show(&told, Some((done + taken) as f64 / count as f64));
            let failed = rows.iter().position(|(_, o)| o.stop.is_failure());
            if let Some(at) = failed.filter(|_| stop_on_failure) {
                let reason = rows[at].1.reason.clone().unwrap_or_default();
                ended = Ended::Failed(block.range.start + at as u64, reason);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        },
    );
    match ended {
        Ended::Complete if INTERRUPTED.load(Ordering::Relaxed) && !store.missing().is_empty() => {
            Ended::Interrupted
        }
        ended => ended,
    }
}

/// Trajectories, their rate, and the time that is left.
fn told((done, taken, count): (u64, u64, u64), failures: usize, seconds: f64) -> String {
    let rate = done as f64 / seconds.max(1e-3);
    let left = (count - taken - done) as f64 / rate.max(1e-9);
    let failed = match failures {
        0 => String::new(),
        _ => format!(", {failures} without an end"),
    };
    format!(
        "{} of {count} trajectories, {rate:.0} per second, {left:.0} s left{failed}",
        done + taken
    )
}

/// What the numbers of the column `stop` mean.
fn stops_in_words(sweep: &Sweep) -> Vec<(i64, String)> {
    let mut words = vec![
        (0, "the end of the time span was reached".to_owned()),
        (1, "ended early; the reason is in failures.csv".to_owned()),
        (2, "did not begin; the reason is in failures.csv".to_owned()),
    ];
    let events = sweep.events();
    let events = (10..)
        .zip(events)
        .map(|(number, name)| (number, format!("event {name}")));
    words.extend(events);
    words
}

fn values_in_words(sweep: &Sweep, index: u64) -> String {
    let names = sweep.variations().list().iter().map(|v| &v.name);
    let values = names.zip(sweep.values(index));
    let words: Vec<String> = values
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    words.join(", ")
}

fn say(arguments: &Arguments, text: &str) {
    match arguments.json {
        true => terminal::err(text),
        false => terminal::out(&format!("{text}\n")),
    }
}

fn summary(arguments: &Arguments, sweep: &Sweep, folder: &Path, stops: &Stops, taken: u64) {
    let words = stops_in_words(sweep);
    let number = |key: i64| stops.get(&key).copied().unwrap_or(0);
    let archive = folder.join(ARCHIVE);
    if arguments.json {
        let events: Map<String, Value> = (10..)
            .zip(sweep.events())
            .map(|(key, name)| (name.to_owned(), json!(number(key))))
            .collect();
        let said = json!({
            "trajectories": sweep.count(),
            "taken_over": taken,
            "finished": number(0),
            "events": events,
            "ended_early": number(1),
            "not_started": number(2),
            "archive": archive.to_string_lossy(),
            "columns": sweep.columns().list.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(),
        });
        terminal::out(&serde_json::to_string_pretty(&said).unwrap_or_default());
        terminal::out("\n");
        return;
    }
    let mut text = format!("{} trajectories\n", sweep.count());
    for (key, words) in words.iter().filter(|(key, _)| number(*key) > 0) {
        let words = words.split(';').next().unwrap_or(words);
        text += &format!("{:>9}  {words}\n", number(*key));
    }
    if number(1) + number(2) > 0 {
        text += &format!("reasons: {}\n", folder.join(FAILURES).display());
    }
    text += &format!(
        "results: {0}\nread it: numpy.load(\"{0}\")\n",
        archive.display()
    );
    terminal::out(&text);
}
