//! A thousand model files with mistakes that nobody thought of (five thousand in a full run): each is read or refused with
//! diagnostics at places inside the file, in a moment, and without a panic.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::model::{load, Diagnostics, Files, Loaded, Style};
use chetaev::study::{study, ClaimSelection, Hooks, StudyOptions};
use chetaev_tests::extent::Extent;
use chetaev_tests::places;
use chetaev_tests::words::in_parallel;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

const MUTANTS: u64 = 1000;
/// In a full run.
const MANY_MUTANTS: u64 = 5000;
/// Every so many of the mutants that are still models go through their claims and a short motion as well.
const STUDIED: u64 = 4;
/// Reading takes milliseconds; the limit leaves room for a busy machine.
const LIMIT: Duration = Duration::from_secs(5);
/// A study is told to stop after its budget.
const STUDY_LIMIT: Duration = Duration::from_secs(60);

/// Pieces that people type by mistake, and some that nobody does.
const PIECES: &[&str] = &[
    "'",
    "''",
    "\"",
    "\"\"\"",
    "=",
    "==",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    ",",
    ".",
    "^",
    "**",
    "-",
    "+",
    "*",
    "/",
    "<",
    "!=",
    "#",
    "\\",
    "\n",
    "\t",
    "\r\n",
    "\u{0}",
    "\u{7f}",
    "\u{feff}",
    "\u{202e}",
    "θ",
    "φ'",
    "′",
    "″",
    "ẍ",
    "x̂",
    "é",
    "质量",
    "🛹",
    "²",
    "½",
    "×",
    "−",
    "∞",
    "x'",
    "x''",
    "x''''''''",
    "t",
    "pi",
    "e",
    "lambda_blade",
    "sum(i = 1..n, ",
    "1..0",
    "0..99999",
    "1e999",
    "1e-999",
    "1e99999999",
    "0/0",
    "1/0",
    "0.1.2",
    "99999999999999999999",
    "-0",
    "nan",
    "inf",
    "true",
    "2^2^2^2^2",
    "10^10^10",
    "sqrt(-1)",
    "log(0)",
    "sin(",
    "atan2(1)",
    "abs(x)",
    "theta_{i}",
    "{n}",
    "{",
    "kg m^2",
    "[[drawing.element]]",
    "[expect]",
    "include = \"../trailer/model.toml\"\n",
    "include = \"model.toml\"\n",
    "project = true\n",
    "\"x''\" = 1\n",
];

/// Marsaglia's xorshift64*, so that every mutant can be made again from its number.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let x = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33;
        if n == 0 {
            0
        } else {
            x as usize % n
        }
    }

    fn of<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.below(list.len())]
    }
}

/// Models of the gallery, right and wrong: path and text.
fn seeds() -> Vec<(String, String)> {
    places::gallery()
        .into_iter()
        .chain(places::wrong())
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("a model");
            (path.to_string_lossy().into_owned(), text)
        })
        .collect()
}

/// Words, numbers, blanks and single signs.
fn tokens(text: &str) -> Vec<&str> {
    let class = |c: char| match c {
        'a'..='z' | 'A'..='Z' | '_' => 0,
        '0'..='9' | '.' => 1,
        ' ' => 2,
        _ => 3,
    };
    let mut found = Vec::new();
    let mut start = 0;
    let mut previous = 4;
    for (i, c) in text.char_indices() {
        let now = class(c);
        if i > start && (now != previous || now == 3) {
            found.push(&text[start..i]);
            start = i;
        }
        previous = now;
    }
    found.push(&text[start..]);
    found
}

/// One change of a list of pieces.
fn change(pieces: &mut Vec<String>, random: &mut Random, seeds: &[(String, String)]) {
    let i = random.below(pieces.len());
    let j = random.below(pieces.len());
    match random.below(6) {
        0 if pieces.len() > 1 => {
            pieces.remove(i);
        }
        1 => pieces.insert(i, pieces[j].clone()),
        2 => pieces.swap(i, j),
        3 => pieces.insert(i, random.of(PIECES).to_owned()),
        4 => pieces[i] = random.of(PIECES).to_owned(),
        _ => {
            // A piece of another model.
            let (_, other) = &seeds[random.below(seeds.len())];
            let lines: Vec<&str> = other.lines().collect();
            let line = random.of(&lines);
            pieces[i] = format!("\n{line}\n");
        }
    }
}

/// The same model with other numbers, most of which are still a model.
fn with_other_numbers(text: &str, random: &mut Random) -> String {
    const NUMBERS: &[&str] = &[
        "0", "1", "-1", "2", "7", "1/3", "1e-9", "1e9", "1e300", "0.1", "-0.5", "100000",
    ];
    let mut pieces: Vec<&str> = tokens(text);
    let numbers: Vec<usize> = (0..pieces.len())
        .filter(|&i| pieces[i].starts_with(|c: char| c.is_ascii_digit()))
        .collect();
    for _ in 0..=random.below(2) {
        if let Some(&i) = numbers.get(random.below(numbers.len())) {
            pieces[i] = random.of(NUMBERS);
        }
    }
    pieces.concat()
}

/// Mutant with this number: its path and text.
fn mutant(number: u64, seeds: &[(String, String)]) -> (String, String) {
    let mut random = Random::new(number);
    let (path, text) = &seeds[random.below(seeds.len())];
    let mut text = text.clone();
    if random.below(3) == 0 {
        return (path.clone(), with_other_numbers(&text, &mut random));
    }
    for _ in 0..=random.below(3) {
        let mut pieces: Vec<String> = match random.below(4) {
            0 => text.split_inclusive('\n').map(str::to_owned).collect(),
            1 => text.chars().map(String::from).collect(),
            _ => tokens(&text).into_iter().map(str::to_owned).collect(),
        };
        change(&mut pieces, &mut random, seeds);
        text = pieces.concat();
    }
    (path.clone(), text)
}

struct Disk;

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        std::fs::read_to_string(path).map_err(|e| e.to_string())
    }
}

/// Diagnostics at places that exist, in both renderings.
fn placed(diagnostics: &Diagnostics) -> Result<(), String> {
    for d in &diagnostics.list {
        let related = d.related.iter().map(|(place, _)| *place);
        let suggested = d.suggestion.iter().map(|s| s.place);
        for place in std::iter::once(d.place).chain(related).chain(suggested) {
            let source = diagnostics.sources.get(place.source);
            let (start, end) = (place.span.start, place.span.end);
            if start > end || source.text.get(start..end).is_none() {
                return Err(format!(
                    "{}: bytes {start}..{end} of {}",
                    d.message,
                    source.text.len()
                ));
            }
        }
        if d.message.trim().is_empty() {
            return Err(format!("{} says nothing", d.code));
        }
    }
    let rendered = diagnostics.render(Style::Plain);
    let data = diagnostics.to_data();
    if data.len() != diagnostics.list.len() || (rendered.trim().is_empty() && !data.is_empty()) {
        return Err("a diagnostic is not rendered".into());
    }
    Ok(())
}

/// What came of one mutant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Fate {
    Refused,
    Read,
    Studied,
}

/// Reads a mutant, and studies it where that is asked and it is still a model.
fn examined(path: &str, text: &str, is_studied: bool) -> Result<Fate, String> {
    let began = Instant::now();
    let Loaded {
        model, diagnostics, ..
    } = load(path, text, &Disk, &[]);
    placed(&diagnostics)?;
    let spent = began.elapsed();
    if spent > LIMIT {
        return Err(format!("reading takes {spent:?}"));
    }
    let Some(model) = model else {
        return match diagnostics.has_errors() {
            true => Ok(Fate::Refused),
            false => Err("refused without an error".into()),
        };
    };
    if !is_studied {
        return Ok(Fate::Read);
    }
    let stop = AtomicBool::new(false);
    let clock = || {
        let seconds = began.elapsed().as_secs_f64();
        stop.store(seconds > 6.0, std::sync::atomic::Ordering::Relaxed);
        seconds
    };
    let mut progress = |_: &str, _: Option<f64>| {
        clock();
    };
    let mut hooks = Hooks {
        clock: &clock,
        interrupt: Some(&stop),
        progress: &mut progress,
    };
    let options = StudyOptions {
        claims: ClaimSelection::all(),
        budget: 3.0,
        t_end: Some(0.05),
        tolerance: Some(1e-6),
        global_error: false,
        ..StudyOptions::default()
    };
    if let Err(error) = study(model, options, &mut hooks) {
        if error.to_string().trim().is_empty() {
            return Err("an error without words".into());
        }
    }
    let spent = began.elapsed();
    if spent > STUDY_LIMIT {
        return Err(format!("the study takes {spent:?}"));
    }
    Ok(Fate::Studied)
}

#[test]
fn mutated_models_give_diagnostics_and_never_a_panic() {
    let seeds = seeds();
    let numbers: Vec<u64> = match std::env::var("MUTANT").ok().and_then(|n| n.parse().ok()) {
        Some(number) => vec![number],
        None if Extent::of_run(&places::root()) == Extent::Full => (0..MANY_MUTANTS).collect(),
        None => (0..MUTANTS).collect(),
    };
    let results = in_parallel(&numbers, |&number| {
        let (path, text) = mutant(number, &seeds);
        let result = catch_unwind(AssertUnwindSafe(|| {
            examined(&path, &text, number.is_multiple_of(STUDIED))
        }));
        let result = result.unwrap_or_else(|panic| {
            let words = panic.downcast_ref::<String>().cloned();
            let words = words.or_else(|| panic.downcast_ref::<&str>().map(|w| (*w).to_owned()));
            Err(format!("panic: {}", words.unwrap_or_default()))
        });
        result.map_err(|problem| format!("mutant {number} of {path}: {problem}"))
    });
    let failures: Vec<&String> = results.iter().filter_map(|r| r.as_ref().err()).collect();
    assert!(
        failures.is_empty(),
        "{} of {} (MUTANT=number runs one)\n{}",
        failures.len(),
        numbers.len(),
        failures
            .iter()
            .map(|f| f.as_str())
            .collect::<Vec<_>>()
            .join("\n")
    );
    if numbers.len() > 1 {
        let count = |fate| {
            results
                .iter()
                .filter(|r| r.as_ref().ok() == Some(&fate))
                .count()
        };
        println!(
            "{} refused, {} read, {} studied",
            count(Fate::Refused),
            count(Fate::Read),
            count(Fate::Studied)
        );
        assert!(count(Fate::Refused) > 300 && count(Fate::Read) > 100 && count(Fate::Studied) > 30);
    }
}

#[test]
fn mutants_are_the_same_in_every_run_and_differ_from_their_seeds() {
    let seeds = seeds();
    let again: Vec<(String, String)> = (0..50).map(|n| mutant(n, &seeds)).collect();
    assert_eq!(
        again,
        (0..50).map(|n| mutant(n, &seeds)).collect::<Vec<_>>()
    );
    let changed = again.iter().filter(|m| !seeds.contains(m)).count();
    assert!(changed > 40, "{changed} of 50 are changed");
}

/// Slips of one letter that would keep a program busy for ever, or fill its memory.
#[test]
fn hostile_models_are_answered_in_a_moment() {
    let base = "name = \"hostile\"\ncoordinates = [\"x\", \"y\"]\n[lagrangian]\n";
    let deep = |open: &str, close: &str| {
        let depth = 50_000;
        format!(
            "{base}L = \"x'^2/2 + {}x{}\"\n",
            open.repeat(depth),
            close.repeat(depth)
        )
    };
    let trailer = std::fs::read_to_string(places::root().join("gallery/trailer/model.toml"))
        .expect("the trailer");
    let hostile = [
        ("a family too large", trailer.replace("n = 3", "n = 100000")),
        (
            "a sum too large",
            format!("{base}L = \"x'^2/2 + sum(i = 1..1000000000, x^i)\"\n"),
        ),
        (
            "sums in sums",
            format!("{base}L = \"x'^2/2 + sum(i = 1..3000, sum(j = 1..3000, x/(i + j)))\"\n"),
        ),
        (
            "a power tower",
            format!("{base}L = \"x'^2/2 + 10^10^10^10\"\n"),
        ),
        (
            "a power of a sum",
            format!("{base}L = \"x'^2/2 + (x + y + 1)^100000\"\n"),
        ),
        (
            "a large exponent",
            format!("{base}L = \"x'^2/2 + 1e99999999 x\"\n"),
        ),
        (
            "a large factorial of primes",
            format!("{base}L = \"x{}^2\"\n", "'".repeat(20_000)),
        ),
        ("parentheses", deep("(", ")")),
        ("unclosed parentheses", deep("(", "")),
        ("functions", deep("sin(", ")")),
        ("signs", deep("-", "")),
        ("powers", deep("x^", "")),
        ("brackets", format!("coordinates = {}", "[".repeat(50_000))),
        (
            "a long line",
            format!("{base}L = \"x'^2{}\"\n", " + x".repeat(100_000)),
        ),
        (
            "many errors",
            format!("{base}L = \"x'^2{}\"\n", " + q".repeat(2_000)),
        ),
    ];
    let answered: Vec<Result<String, String>> = in_parallel(&hostile, |(name, text)| {
        let (name, text) = ((*name).to_owned(), text.clone());
        let (send, receive) = std::sync::mpsc::channel();
        // A thread of its own: one that does not end must not keep the test.
        let _ = std::thread::Builder::new().spawn(move || {
            let loaded = load("hostile.toml", &text, &Disk, &[]);
            let _ = send.send(placed(&loaded.diagnostics));
        });
        match receive.recv_timeout(LIMIT) {
            Ok(Ok(())) => Ok(name),
            Ok(Err(problem)) => Err(format!("{name}: {problem}")),
            Err(problem) => Err(format!("{name}: {problem}")),
        }
    });
    let failures: Vec<&String> = answered.iter().filter_map(|a| a.as_ref().err()).collect();
    assert!(failures.is_empty(), "{failures:#?}");
}
