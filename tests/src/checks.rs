//! Evaluates what a published case expects.

use crate::cases::{Case, Check, Event, Expected, Named, Sample, Scalar, Statement};
use crate::runs::{again, along, ended, Ask, Ended};
use crate::words;
use chetaev::model::Style;
use chetaev::motion::Run;
use chetaev::study::Study;

/// Relative and absolute tolerance of the runs: below every tolerance of the file by a factor that accumulated error needs.
pub const TOLERANCE: f64 = 1e-12;
/// Rows at which what should stay constant is looked at, beside the times of the file.
const ROWS: u32 = 400;

/// A check that failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// `case: title of the check`.
    pub check: String,
    /// What was found.
    pub found: String,
}

/// A case with its motion.
#[derive(Debug)]
pub struct Session<'c> {
    case: &'c Case,
    study: Study,
}

/// Every covered check of a case, in order; empty when all is as published.
pub fn failures(case: &Case) -> Vec<Failure> {
    let failed = |check: &str, found: String| Failure {
        check: format!("{}: {check}", case.statement.id),
        found,
    };
    let session = match Session::new(case) {
        Ok(session) => session,
        Err(found) => return vec![failed("the model is studied", found)],
    };
    let mut failures: Vec<Failure> = session
        .ending()
        .err()
        .map(|found| failed("the end is reached", found))
        .into_iter()
        .collect();
    if case.statement.as_particles {
        let found = session.balance();
        failures.extend(found.err().map(|found| failed("mass.balance", found)));
    }
    for check in case
        .checks
        .iter()
        .filter(|check| check.not_covered().is_none())
    {
        if let Err(found) = session.evaluate(check) {
            failures.push(failed(&check.title, found));
        }
    }
    failures
}

fn float(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("`{text}` is no number"))
}

fn sample_times(case: &Case) -> Vec<f64> {
    let samples = case.checks.iter().flat_map(|check| match &check.expected {
        Expected::ClosedForm { at, .. } => at.as_slice(),
        Expected::Value {
            at, state: None, ..
        } => at.as_slice(),
        _ => &[],
    });
    samples.filter_map(|(t, _)| t.parse().ok()).collect()
}

fn output_times(case: &Case, t_end: f64) -> Vec<f64> {
    let mut times: Vec<f64> = (0..=ROWS)
        .map(|j| t_end * f64::from(j) / f64::from(ROWS))
        .collect();
    times.extend(sample_times(case));
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

impl<'c> Session<'c> {
    fn new(case: &'c Case) -> Result<Session<'c>, String> {
        let t_end = float(&case.statement.t_end)?;
        let ask = Ask {
            claims: vec![
                "model",
                "motion.constraint-drift",
                "formulation.equivalent",
                "mass.balance",
            ],
            times: output_times(case, t_end),
            tolerance: Some(TOLERANCE),
            formulation: case.statement.formulation(),
            ..Ask::default()
        };
        let Ended { text, study, .. } = ended(case.statement.model(&[], false), &ask);
        Ok(Session {
            case,
            study: study.ok_or(text)?,
        })
    }

    /// The run, and that by another formulation; the constrained extremum has none.
    fn runs(&self) -> Result<(&Run, Option<&Run>), String> {
        let motion = self
            .study
            .motion
            .as_ref()
            .ok_or_else(|| self.study.notices.join("\n"))?;
        let run = &motion.evidence.run;
        if self.case.statement.formulation().is_some() {
            return Ok((run, None));
        }
        let other = motion
            .evidence
            .comparison
            .as_ref()
            .ok_or("Maggi's equations were not integrated")?;
        Ok((run, Some(other)))
    }

    /// The reactive forces are proved to be those of the particle law, and every form that applies gives the same motion.
    fn balance(&self) -> Result<(), String> {
        let of = |claim: &str| -> Vec<_> {
            let verdicts = self.study.verdicts.iter();
            let words = verdicts.filter(|d| d.claim == claim);
            words
                .map(|d| (d.full_id(), d.finding.verdict.word()))
                .collect()
        };
        let balance = of("mass.balance");
        if balance.len() != 1 || balance[0].1 != "proved" {
            return Err(format!("not proved: {balance:?}"));
        }
        let equivalent = of("formulation.equivalent");
        let proved = equivalent.iter().filter(|(_, word)| *word == "proved");
        let sound = |word: &str| matches!(word, "proved" | "not-applicable");
        match equivalent.iter().all(|(_, word)| sound(word)) && proved.count() > 10 {
            true => Ok(()),
            false => Err(format!("{equivalent:?}")),
        }
    }

    fn is_stiff(&self) -> bool {
        self.case.needs.iter().any(|need| need == "stiff")
    }

    /// Both formulations reach the end; a stiff problem ends with advice instead.
    fn ending(&self) -> Result<(), String> {
        let (routh, maggi) = self.runs()?;
        let exit = self.study.outcome.exit_status();
        if self.is_stiff() {
            return match (exit, routh.ending.reason.contains("stiff")) {
                (3, true) => Ok(()),
                _ => Err(format!(
                    "no stop with advice: exit {exit}, {}",
                    routh.ending.reason
                )),
            };
        }
        let unfinished: Vec<String> = [Some(routh), maggi]
            .into_iter()
            .flatten()
            .filter(|run| !run.ending.finished)
            .map(|run| format!("{}: {}", run.formulation, run.ending.reason))
            .collect();
        if exit != 0 || !unfinished.is_empty() {
            return Err(format!("exit {exit}; {}", unfinished.join("; ")));
        }
        Ok(())
    }

    fn evaluate(&self, check: &Check) -> Result<(), String> {
        let tolerance = check.tol_abs;
        match &check.expected {
            Expected::ClosedForm { expr, at, formula } => {
                if let Some(formula) = formula {
                    self.formula(formula, at)?;
                }
                self.samples(expr, at, tolerance)
            }
            Expected::Value {
                expr,
                at,
                state: None,
            } => self.samples(expr, at, tolerance),
            Expected::Value {
                expr,
                at,
                state: Some(state),
            } => restarted(&self.case.statement, state, expr, at, tolerance),
            Expected::Invariant {
                expr,
                value,
                formula,
            } => {
                if let Some(formula) = formula {
                    self.formula(formula, &[("0".into(), value.clone())])?;
                }
                self.constant(expr, float(value)?, tolerance)
            }
            Expected::Identity { expr } => self.constant(expr, 0.0, tolerance),
            Expected::Scalar(scalar) => self.scalar(scalar, tolerance),
            Expected::Stop {
                at,
                exit,
                contains,
                vanishing,
            } => stops(
                &self.case.statement,
                float(at)?,
                *exit,
                contains,
                vanishing,
                tolerance,
            ),
            Expected::Claim { claim, verdict } => self.claim(claim, verdict),
            Expected::Eigenvalues {} | Expected::Matrix {} => {
                Err("linearization is not covered".into())
            }
        }
    }

    /// The expression along all runs.
    fn followed(&self, expr: &str) -> Result<Vec<(&Run, Vec<f64>)>, String> {
        let (routh, maggi) = self.runs()?;
        [Some(routh), maggi]
            .into_iter()
            .flatten()
            .map(|run| Ok((run, along(&self.study, run, expr)?)))
            .collect()
    }

    fn samples(&self, expr: &str, at: &[Sample], tolerance: f64) -> Result<(), String> {
        for (run, values) in self.followed(expr)? {
            for (t, expected) in at {
                let (t, expected) = (float(t)?, float(expected)?);
                if self.is_stiff() && t > run.t {
                    continue;
                }
                let row = run
                    .times
                    .iter()
                    .position(|&x| (x - t).abs() <= 1e-12 * (1.0 + t));
                let row = row.ok_or(format!("{}: no row at t = {t}", run.formulation))?;
                close(run.formulation, t, values[row], expected, tolerance)?;
            }
        }
        Ok(())
    }

    fn constant(&self, expr: &str, value: f64, tolerance: f64) -> Result<(), String> {
        for (run, values) in self.followed(expr)? {
            if values.is_empty() {
                return Err(format!("{}: no rows", run.formulation));
            }
            for (&t, &found) in run.times.iter().zip(&values) {
                close(run.formulation, t, found, value, tolerance)?;
            }
        }
        Ok(())
    }

    /// The closed form itself, read by the parser and evaluated, gives the published numbers.
    fn formula(&self, formula: &str, at: &[Sample]) -> Result<(), String> {
        let model = &self.study.model;
        let parsed = model
            .expression(formula)
            .map_err(|d| d.render(Style::Plain))?;
        let closed = model.graph.substitute(parsed, &model.parameter_values());
        for (t, expected) in at {
            let (t, expected) = (float(t)?, float(expected)?);
            let value = model
                .graph
                .evaluate_f64(&[closed], &|_| Some(t))
                .map_err(|e| e.to_string())?[0];
            close(
                "the closed form",
                t,
                value,
                expected,
                1e-11 * (1.0 + expected.abs()),
            )?;
        }
        Ok(())
    }

    fn scalar(&self, scalar: &Scalar, tolerance: f64) -> Result<(), String> {
        match scalar {
            Scalar::EventTime { event, expected } => {
                let (t, _) = self.event(event, "t")?;
                close("event", t, t, float(expected)?, tolerance)
            }
            Scalar::EventValue {
                event,
                expr,
                expected,
            } => {
                let (t, value) = self.event(event, expr)?;
                close("event", t, value, float(expected)?, tolerance)
            }
            Scalar::CriticalParameter {} | Scalar::Divergence {} => {
                Err("linearization is not covered".into())
            }
        }
    }

    /// Time of an event and a value there: rows are refined around the change of sign until a line is exact enough.
    fn event(&self, event: &Event, expr: &str) -> Result<(f64, f64), String> {
        let (run, _) = self.runs()?;
        let values = along(&self.study, run, &event.expr)?;
        let crossing = crossings(&values, &event.direction).nth(event.occurrence - 1);
        let j = crossing.ok_or(format!("`{}` has no such zero", event.expr))?;
        let (mut low, mut high) = (run.times[j], run.times[j + 1]);
        let mut finest = run.clone();
        for _ in 0..3 {
            let times = (0..=100)
                .map(|i| low + (high - low) * f64::from(i) / 100.0)
                .collect();
            finest = again(&self.study, times)?;
            let values = along(&self.study, &finest, &event.expr)?;
            let j = crossings(&values, &event.direction)
                .next()
                .ok_or("the zero was lost")?;
            (low, high) = (finest.times[j], finest.times[j + 1]);
        }
        let values = along(&self.study, &finest, &event.expr)?;
        let followed = along(&self.study, &finest, expr)?;
        let j = crossings(&values, &event.direction)
            .next()
            .ok_or("the zero was lost")?;
        let part = values[j] / (values[j] - values[j + 1]);
        let between = |a: f64, b: f64| a + part * (b - a);
        Ok((
            between(finest.times[j], finest.times[j + 1]),
            between(followed[j], followed[j + 1]),
        ))
    }

    /// The verdict of a claim with each of its subjects.
    fn claim(&self, claim: &str, verdict: &str) -> Result<(), String> {
        let of_claim: Vec<_> = self
            .study
            .verdicts
            .iter()
            .filter(|d| d.claim == claim || d.full_id() == claim)
            .collect();
        if of_claim.is_empty() {
            return Err(format!("no verdict of `{claim}`"));
        }
        match of_claim
            .iter()
            .find(|d| d.finding.verdict.word() != verdict)
        {
            Some(d) => Err(format!(
                "{}: {}: {}",
                d.full_id(),
                d.finding.verdict.word(),
                d.finding.verdict.detail()
            )),
            None => Ok(()),
        }
    }
}

/// Intervals in which the values change sign in a direction; a zero at the beginning of one does not count.
fn crossings<'v>(values: &'v [f64], direction: &'v str) -> impl Iterator<Item = usize> + 'v {
    let up = move |a: f64, b: f64| direction != "down" && a < 0.0 && b >= 0.0;
    let down = move |a: f64, b: f64| direction != "up" && a > 0.0 && b <= 0.0;
    (0..values.len().saturating_sub(1))
        .filter(move |&j| up(values[j], values[j + 1]) || down(values[j], values[j + 1]))
}

/// Whether a number is within the tolerance.
///
/// # Errors
/// By how much it is off.
pub fn close(what: &str, t: f64, found: f64, expected: f64, tolerance: f64) -> Result<(), String> {
    let error = (found - expected).abs();
    if error <= tolerance {
        Ok(())
    } else {
        Err(format!("{what}: at t = {t}: {found}, expected {expected}: off by {error:.2e}, allowed {tolerance:.0e}"))
    }
}

fn restarted(
    statement: &Statement,
    state: &[Named],
    expr: &str,
    at: &[Sample],
    tolerance: f64,
) -> Result<(), String> {
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        times: vec![0.0],
        t_end: Some(float(&statement.t_end)? * 1e-3),
        tolerance: Some(TOLERANCE),
        ..Ask::default()
    };
    let Ended { text, study, .. } = ended(statement.model(state, false), &ask);
    let study = study.ok_or(text)?;
    let motion = study.motion.as_ref().ok_or("no motion")?;
    let found = along(&study, &motion.evidence.run, expr)?;
    for (t, expected) in at {
        if float(t)? != 0.0 {
            return Err("a restart is looked at when it begins".into());
        }
        close("restarted", 0.0, found[0], float(expected)?, tolerance)?;
    }
    Ok(())
}

/// A run to 1.2 times `at` stops there with the exit status and the words, keeps its rows, and `vanishing` tends to zero.
///
/// # Errors
/// What is not so.
pub fn stops(
    statement: &Statement,
    at: f64,
    exit: u8,
    contains: &[String],
    vanishing: &str,
    tolerance: f64,
) -> Result<(), String> {
    let mut times: Vec<f64> = (0..20).map(|j| at * 0.9 * f64::from(j) / 20.0).collect();
    times.extend((1..=5).map(|k| at * (1.0 - 0.1_f64.powi(k))));
    let rows = times.len();
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        times,
        t_end: Some(1.2 * at),
        ..Ask::default()
    };
    let ended = ended(statement.model(&[], false), &ask);
    let study = ended.study.ok_or(ended.text.clone())?;
    let run = &study.motion.as_ref().ok_or("no motion")?.evidence.run;
    if ended.exit != exit || run.ending.finished {
        return Err(format!(
            "exit {} instead of {exit}: {}",
            ended.exit, ended.text
        ));
    }
    close("stop", at, run.ending.t, at, tolerance)?;
    let missing = words::missing(&ended.text, contains.iter().map(String::as_str));
    if !missing.is_empty() {
        return Err(format!("does not say {missing:?}: {}", ended.text));
    }
    if run.len() < rows {
        return Err(format!(
            "{} rows of {rows} before the singularity were kept",
            run.len()
        ));
    }
    let values = along(&study, run, vanishing)?;
    let tail: Vec<f64> = values[rows - 5..rows].iter().map(|x| x.abs()).collect();
    let vanishes = tail.windows(2).all(|w| w[1] < w[0]) && tail[4] < 0.3 * tail[0];
    vanishes
        .then_some(())
        .ok_or(format!("`{vanishing}` does not tend to zero: {tail:?}"))
}
