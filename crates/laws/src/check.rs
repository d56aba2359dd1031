//! Holding systems to the laws, several at a time.

use crate::generate::{generate, Family};
use crate::laws::{self, Expected, Sampled, Trial};
use chetaev_mechanics::{Context, Prepared, Prover, Registry};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How one system fared.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The family.
    pub family: Family,
    /// The seed.
    pub seed: u64,
    /// The model as text.
    pub text: String,
    /// Every law tried; empty when the system could not be built.
    pub trials: Vec<Trial>,
    /// Why it could not be built.
    pub problem: Option<String>,
    /// Distinct nodes of the difference between Routh's and Maggi's accelerations.
    pub nodes: usize,
    /// Wall time.
    pub seconds: f64,
}

impl Outcome {
    /// Trials whose verdict is not the expected one.
    pub fn failed(&self) -> impl Iterator<Item = &Trial> {
        self.trials.iter().filter(|trial| !trial.holds())
    }

    /// Whether every law holds.
    pub fn holds(&self) -> bool {
        self.problem.is_none() && self.failed().next().is_none()
    }

    /// How many trials expected this verdict, and how many got it.
    pub fn tally(&self, expected: Expected) -> (usize, usize) {
        let asked = || self.trials.iter().filter(|t| t.expected == expected);
        (asked().count(), asked().filter(|t| t.holds()).count())
    }
}

/// Holds the system with this seed to every law.
pub fn check(family: Family, seed: u64) -> Outcome {
    let start = Instant::now();
    let mut outcome = Outcome {
        family,
        seed,
        text: String::new(),
        trials: Vec::new(),
        problem: None,
        nodes: 0,
        seconds: 0.0,
    };
    if let Err(problem) = fill(&mut outcome) {
        outcome.problem = Some(problem);
    }
    outcome.seconds = start.elapsed().as_secs_f64();
    outcome
}

fn fill(outcome: &mut Outcome) -> Result<(), String> {
    let random = generate(outcome.family, outcome.seed).map_err(|p| p.to_string())?;
    outcome.text.clone_from(&random.text);
    let prepared = Prepared::new(&random.system).map_err(|p| p.to_string())?;
    let registry = Registry::new(laws::CLAIMS);
    let cx = Context::new(
        &random.system,
        &prepared.terms,
        &prepared.selection,
        &registry,
        Prover::default(),
    );
    if random.system.order() > 1 {
        outcome.trials = laws::all_of_order(&cx, outcome.seed).map_err(|p| p.to_string())?;
        return Ok(());
    }
    let sampled = Sampled::new(&cx, outcome.seed).map_err(|p| p.to_string())?;
    if !random.system.integrals.is_empty() {
        outcome.trials = laws::all_of_integrals(sampled).map_err(|p| p.to_string())?;
        return Ok(());
    }
    (outcome.trials, outcome.nodes) = laws::all(sampled).map_err(|p| p.to_string())?;
    Ok(())
}

/// Holds the first `count` systems of each family to every law, on all processors. The outcomes come in order, whatever
/// finished first; `done` is told of each as it ends, with the wall time so far.
pub fn check_all(
    families: &[Family],
    count: u64,
    done: &(dyn Fn(&Outcome, Duration) + Sync),
) -> Vec<Outcome> {
    let jobs: Vec<(Family, u64)> = families
        .iter()
        .flat_map(|&family| (0..count).map(move |seed| (family, seed)))
        .collect();
    let (next, start) = (AtomicUsize::new(0), Instant::now());
    let found: Mutex<Vec<(usize, Outcome)>> = Mutex::new(Vec::with_capacity(jobs.len()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| loop {
                let job = next.fetch_add(1, Ordering::Relaxed);
                let Some(&(family, seed)) = jobs.get(job) else {
                    break;
                };
                let outcome = check(family, seed);
                done(&outcome, start.elapsed());
                if let Ok(mut found) = found.lock() {
                    found.push((job, outcome));
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|(job, _)| *job);
    found.into_iter().map(|(_, outcome)| outcome).collect()
}
