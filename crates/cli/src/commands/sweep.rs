//! `chetaev sweep`.

use super::{error, listen, options, refuse, with_hooks, INTERRUPTED};
use crate::arguments::Sweep as Arguments;
use crate::files::Read;
use crate::progress::ProgressLine;
use crate::{files, terminal, DONE, INPUT, STOPPED};
use chetaev::model::Diagnostics;
use chetaev::store::{
    self, stops_in_words, Ended, Failure, NotKept, Opened, Stops, Store, ARCHIVE, FAILURES,
};
use chetaev::study::sweep::together::{Together, Variations};
use chetaev::study::sweep::vary::{rows, Variation};
use chetaev::study::sweep::{Sweep, SweepOptions};
use chetaev::study::{interruptible, StudyError};
use serde_json::{json, Map, Value};
use std::path::Path;

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
    let made = with_hooks(|hooks| {
        let made = interruptible(hooks, |hooks| {
            Sweep::new(&read.model, variations, options, hooks)
        });
        made.unwrap_or(Err(StudyError::Interrupted))
    });
    let sweep = match made {
        Ok(sweep) => sweep,
        Err(problem) => return refuse(&problem, &arguments.motion, &read),
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
        Ok(variations) => match set_and_varied(arguments, &variations) {
            None => Some(variations),
            Some(name) => {
                error(format!(
                    "`{name}` is varied, and --set gives it one value: leave one of the two out"
                ));
                None
            }
        },
        Err(problem) => {
            error(problem);
            None
        }
    }
}

/// A name that varies and has a value by --set, which no trajectory would have.
fn set_and_varied<'v>(arguments: &Arguments, variations: &'v Variations) -> Option<&'v str> {
    let set = arguments.model.set.iter();
    let set: Vec<&str> = set
        .filter_map(|text| Some(text.split_once('=')?.0.trim()))
        .collect();
    let mut names = variations.list().iter().map(|v| v.name.as_str());
    names.find(|name| set.contains(name))
}

fn in_folder(arguments: &Arguments, sweep: &Sweep, folder: &Path) -> Result<u8, NotKept> {
    let count = sweep.count();
    let mut store = match store::open(folder, sweep)? {
        Opened::Complete(failure) => {
            let told = format!("{} is complete; nothing was computed", folder.display());
            say(arguments, &told);
            let failure = failure.filter(|_| arguments.stop_on_failure);
            return Ok(failure.map_or(DONE, |failure| failed(sweep, &failure)));
        }
        Opened::Begun(store) => store,
    };
    if let Some(note) = store.note() {
        terminal::err(note);
    }
    let taken = store.written();
    if taken > 0 && !arguments.json {
        terminal::err(&format!(
            "{taken} of {count} trajectories were computed before"
        ));
    }
    let before = store.failure().filter(|_| arguments.stop_on_failure);
    if let Some(failure) = before {
        return Ok(failed(sweep, failure));
    }
    let threads = arguments.threads.unwrap_or_else(|| {
        std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get)
    });
    listen();
    let ended = super::with_progress(|line| {
        let with = (threads, arguments.stop_on_failure);
        compute(sweep, &mut store, with, line)
    })?;
    match ended {
        Ended::Complete => {
            let stops = store.finish()?;
            summary(arguments, sweep, folder, &stops, taken);
            Ok(DONE)
        }
        Ended::Interrupted => {
            let kept = store.written();
            store.leave()?;
            terminal::err(&format!(
                "interrupted; {kept} of {count} trajectories are kept, and the same command goes on"
            ));
            Ok(STOPPED)
        }
        Ended::Failed(failure) => {
            store.leave()?;
            Ok(failed(sweep, &failure))
        }
    }
}

/// Says which trajectory failed, of a sweep that was to end at the first.
fn failed(sweep: &Sweep, (index, reason): &Failure) -> u8 {
    error(format!(
        "trajectory {index} ({}): {reason}; what was computed is kept",
        values_in_words(sweep, *index)
    ));
    STOPPED
}

fn compute(
    sweep: &Sweep,
    store: &mut Store,
    with: (usize, bool),
    line: &ProgressLine,
) -> Result<Ended, NotKept> {
    let (count, taken, began) = (sweep.count(), store.written(), line.seconds());
    line.show(&format!("computing {count} trajectories"), None);
    store.compute(sweep, with, &INTERRUPTED, &mut |written, failures| {
        let done = (written - taken, taken, count);
        let told = if line.is_painted() {
            told(done, failures, line.seconds() - began)
        } else {
            format!("computing {count} trajectories")
        };
        line.show(&told, Some(written as f64 / count as f64));
    })
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
