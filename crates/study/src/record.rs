//! `study.json`: the record of a study, which `verify` replays.

use crate::flat::flat;
use crate::kept::Kept;
use crate::stated_equations::{stated_equations, EquationsRecord};
use crate::study::{Decided, Motion, Study};
use chetaev_integrate::EventKind;
use chetaev_model::model::{ModelText, Precision};
use chetaev_symbolic::meter::UNITS_PER_SECOND;
use chetaev_symbolic::verdict::{Counterexample, Evidence, Proof};
use chetaev_symbolic::{Expr, Graph, Verdict};
use serde::{Deserialize, Serialize};

/// Version of the schema; fields may be added, none renamed.
pub const SCHEMA: &str = "chetaev-study-1";

/// The record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program.
    pub chetaev: String,
    /// Enough to read the model again.
    pub model: ModelRecord,
    /// Verdicts.
    pub verdicts: Vec<VerdictRecord>,
    /// The equations of the formulations decided about.
    #[serde(default)]
    pub equations: Vec<EquationsRecord>,
    /// The motion; `null` when none was computed.
    pub trajectory: Option<TrajectoryRecord>,
    /// Things a reader must know.
    #[serde(default)]
    pub notices: Vec<String>,
    /// Options that change verdicts.
    #[serde(default)]
    pub options: OptionsRecord,
    /// The files written beside the record, with their checksums.
    #[serde(default)]
    pub files: Vec<WrittenRecord>,
    /// How work is counted, which budgets are.
    #[serde(default)]
    pub work: WorkRecord,
    /// A functional of fields over space, where the model states one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub functional: Option<FunctionalRecord>,
}

/// A file written beside the record.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WrittenRecord {
    /// Its name in the folder of the record.
    pub name: String,
    /// SHA-256 of its content, in hexadecimal digits.
    pub sha256: String,
}

/// Work by which the budget is counted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WorkRecord {
    /// Units that count as a second of the budget.
    pub units_per_second: f64,
}

/// What a functional is stationary for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FunctionalRecord {
    /// Its name.
    pub name: String,
    /// Its level in a hierarchy, if stated.
    pub level: Option<String>,
    /// Dimensions of space.
    pub dimensions: u64,
    /// Fields that are varied.
    pub fields: Vec<String>,
    /// Labels of equations imposed before the variation.
    pub imposed: Vec<String>,
    /// Labels of equations stated to follow.
    pub yields: Vec<String>,
    /// Euler equations.
    pub euler: Vec<ConditionRecord>,
    /// Conditions on pieces of the boundary, and where they meet.
    pub boundary: Vec<ConditionRecord>,
    /// The same in index notation, where it has a short form.
    #[serde(default)]
    pub indexed: Vec<ConditionRecord>,
    /// What imposed equations were solved for and put in, with what follows then; `null` where nothing was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub put_in: Option<PutInRecord>,
}

/// Fields for which something is put in because of what is imposed, and what the functional of the others is stationary for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PutInRecord {
    /// What is put in for what.
    pub values: Vec<ValueRecord>,
    /// Euler equations of the fields that are left.
    pub euler: Vec<ConditionRecord>,
    /// Their conditions on pieces of the boundary, and where they meet.
    pub boundary: Vec<ConditionRecord>,
}

/// A field, or a component of one, with what stands for it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ValueRecord {
    /// The field.
    pub of: String,
    /// What stands for it.
    pub value: String,
}

/// A coefficient of the first variation, which vanishes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConditionRecord {
    /// The piece of the boundary; `null` in the interior.
    pub on: Option<String>,
    /// The variation that it is the coefficient of.
    pub of: String,
    /// The expression.
    pub zero: String,
    /// Where it is known to vanish; everywhere, if nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only_where: Option<String>,
}

/// The texts of the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelRecord {
    /// Path as given.
    pub path: String,
    /// The model file.
    pub text: String,
    /// Included files.
    pub includes: Vec<FileRecord>,
    /// Overrides as given.
    pub overrides: Vec<OverrideRecord>,
    /// The model lowered to coordinates, L, Q and constraints, as a model file; null where a mass contains velocities. Of a functional:
    /// the same in one file, with the functionals it is related to under `[others.NAME]`.
    #[serde(default)]
    pub flat: Option<String>,
}

impl ModelRecord {
    /// The texts that were kept with a model.
    pub fn of(text: &ModelText) -> ModelRecord {
        ModelRecord {
            path: text.path.clone(),
            text: text.text.clone(),
            includes: text
                .includes
                .iter()
                .map(|(path, text)| FileRecord {
                    path: path.clone(),
                    text: text.clone(),
                })
                .collect(),
            overrides: text
                .overrides
                .iter()
                .map(|(name, value)| OverrideRecord {
                    name: name.clone(),
                    value: value.clone(),
                })
                .collect(),
            flat: None,
        }
    }
}

/// An included file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Path.
    pub path: String,
    /// Content.
    pub text: String,
}

/// An override.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OverrideRecord {
    /// Parameter or size.
    pub name: String,
    /// Value as given.
    pub value: String,
}

/// Options that change verdicts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OptionsRecord {
    /// Groups and ids asked for; empty for all.
    #[serde(default)]
    pub claims: Vec<String>,
    /// Seconds for all claims.
    pub budget: Option<f64>,
    /// End of the run where it was given on the command line.
    pub t_end: Option<f64>,
    /// Tolerance, likewise.
    pub tolerance: Option<f64>,
    /// Fixed step, likewise.
    #[serde(default)]
    pub step: Option<f64>,
    /// Method, likewise.
    pub method: Option<String>,
    /// Arithmetic of the motion, likewise: `double` or `double-double`.
    #[serde(default)]
    pub precision: Option<String>,
    /// Formulation, likewise.
    pub formulation: Option<String>,
    /// Whether inadmissible initial data were projected.
    #[serde(default)]
    pub project: bool,
    /// Whether the integrals found were kept by projection, where it was asked for on the command line.
    #[serde(default)]
    pub keep_integrals: bool,
    /// Branch of the motion, where it was given on the command line.
    #[serde(default)]
    pub branch: Option<usize>,
}

impl OptionsRecord {
    /// The arithmetic of the motion, where it was asked for.
    pub fn precision(&self) -> Option<Precision> {
        let word = self.precision.as_deref()?;
        let mut known = Precision::WORDS.into_iter();
        known.find(|(known, _)| *known == word).map(|(_, own)| own)
    }
}

/// One verdict.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct VerdictRecord {
    /// Claim id without subject.
    pub claim: String,
    /// Subject, or null.
    pub subject: Option<String>,
    /// One of the six words.
    pub verdict: String,
    /// `exact`, `modular`, `structural`, or null.
    pub method: Option<String>,
    /// Where it holds.
    pub on: Option<String>,
    /// Proven bound on the probability of error, as `2^-n`; null for a proof without error.
    pub error_bound: Option<String>,
    /// Number of random points or states.
    pub samples: Option<u64>,
    /// Seed of the random choices.
    pub seed: Option<u64>,
    /// Largest residual of a numerical verdict.
    pub residual: Option<f64>,
    /// A counterexample.
    pub counterexample: Option<CounterexampleRecord>,
    /// Equations of the subset of a conditional verdict; the failing hypothesis of one that is not applicable.
    pub condition: Option<String>,
    /// One sentence a person understands.
    pub detail: String,
    /// Time spent.
    pub seconds: f64,
    /// Formulas in the text notation.
    #[serde(default)]
    pub formulas: Vec<String>,
    /// Verdicts the model accepts, when it states any.
    #[serde(default)]
    pub expected: Vec<String>,
}

impl VerdictRecord {
    /// Whether the clock or a person ended what was decided, which says nothing of the claim.
    pub fn is_stopped(&self) -> bool {
        self.verdict == "undecided"
            && (self.detail.starts_with(LATE) || self.detail.starts_with(INTERRUPTED))
    }
}

/// What the details of verdicts begin with that the clock, or a person, ended.
pub(crate) const LATE: &str = "time: ";
pub(crate) const INTERRUPTED: &str = "interrupted ";

/// A counterexample.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CounterexampleRecord {
    /// Data, independent first.
    pub point: Vec<PointRecord>,
    /// What was evaluated.
    pub quantity: String,
    /// Lower and upper bound of the residual.
    pub residual: [String; 2],
}

/// A value at a counterexample.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// Symbol.
    pub name: String,
    /// Exact value as "p/q", or null.
    pub exact: Option<String>,
    /// Lower and upper bound of dependent data, or null.
    pub enclosure: Option<[String; 2]>,
}

/// A zero of the function of an event.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EventRecord {
    /// Name of the event.
    pub event: String,
    /// Time.
    pub t: f64,
    /// `rising`, `falling`, or `grazing` where the function touches zero without a change of sign.
    pub zero: String,
    /// Coordinates and velocities there.
    pub state: Vec<NamedValue>,
}

/// The motion in numbers; rows are in the CSV and NPZ files.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryRecord {
    /// Formulation integrated.
    pub formulation: String,
    /// Method.
    pub method: String,
    /// Relative tolerance.
    pub tolerance: f64,
    /// Arithmetic: `double` or `double-double`.
    #[serde(default)]
    pub precision: String,
    /// Start.
    pub t_start: f64,
    /// End asked for.
    pub t_end: f64,
    /// Last time reached.
    pub t: f64,
    /// Whether the end was reached.
    pub finished: bool,
    /// Why the run ended.
    pub reason: String,
    /// Time of the end, or the extrapolated time of the singularity it met.
    pub stop_time: Option<f64>,
    /// Number of rows.
    pub rows: u64,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
    /// Changes of chart.
    pub chart_switches: u64,
    /// Names of the initial state.
    pub initial: Vec<NamedValue>,
    /// Values at the last row.
    #[serde(rename = "final")]
    pub last: Vec<NamedValue>,
    /// Estimated global error, relative to 1 + the size of each component.
    pub global_error: Option<f64>,
    /// Largest drifts: constraints, energy, integrals.
    pub drifts: Vec<NamedValue>,
    /// What was kept by projection; `null` where nothing was.
    #[serde(default)]
    pub kept: Option<KeptRecord>,
    /// Events met, in the order of time along the run.
    #[serde(default)]
    pub events: Vec<EventRecord>,
    /// Files written beside the record.
    pub files: Vec<String>,
}

impl TrajectoryRecord {
    /// Whether a person ended the run.
    pub fn is_interrupted(&self) -> bool {
        !self.finished && self.reason.starts_with("interrupted")
    }
}

/// First integrals whose values a run kept by projection.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptRecord {
    /// The integrals, by their numbers.
    pub integrals: Vec<KeptIntegralRecord>,
    /// Steps after which the state was moved.
    pub moved: u64,
    /// The largest change of a coordinate or velocity after a step, over 1 + its size.
    pub largest_change: f64,
}

/// One of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptIntegralRecord {
    /// Its number, as in `noether.integral#1`.
    pub integral: String,
    /// The integral; `…` where it is too long to be read.
    pub formula: String,
    /// Steps after which it has its value.
    pub steps: u64,
}

/// A name with a number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NamedValue {
    /// Name.
    pub name: String,
    /// Value; null when it is not finite.
    pub value: Option<f64>,
}

impl NamedValue {
    fn new(name: impl Into<String>, value: f64) -> NamedValue {
        NamedValue {
            name: name.into(),
            value: value.is_finite().then_some(value),
        }
    }
}

/// The record of a study.
pub fn record(study: &Study, files: &[String]) -> Record {
    let text = &study.model.text;
    Record {
        schema: SCHEMA.into(),
        chetaev: env!("CARGO_PKG_VERSION").into(),
        model: ModelRecord {
            flat: flat(&study.model, &study.system),
            ..ModelRecord::of(text)
        },
        verdicts: study
            .verdicts
            .iter()
            .map(|d| verdict_record(study, d))
            .collect(),
        equations: stated_equations(study),
        trajectory: study
            .motion
            .as_ref()
            .map(|m| trajectory_record(study, m, files)),
        notices: study.notices.clone(),
        options: OptionsRecord {
            claims: study.options.claims.words.clone(),
            budget: Some(study.options.budget),
            t_end: study.options.t_end,
            tolerance: study.options.tolerance,
            step: study.options.step,
            method: study.options.method.clone(),
            precision: study.options.precision.map(|own| own.word().into()),
            formulation: study.options.formulation.clone(),
            project: study.options.project,
            keep_integrals: study.options.keep_integrals,
            branch: study.options.branch,
        },
        files: Vec::new(),
        work: WorkRecord {
            units_per_second: UNITS_PER_SECOND,
        },
        functional: None,
    }
}

/// The motion of a study with its notices, as data; null where there is none.
pub fn run(study: &Study, files: &[String]) -> serde_json::Value {
    let motion = study.motion.as_ref();
    let mut run = serde_json::json!(motion.map(|m| trajectory_record(study, m, files)));
    if let Some(fields) = run.as_object_mut() {
        fields.insert("notices".into(), study.notices.clone().into());
    }
    run
}

/// `2^-n`, rounded to the safe side.
pub fn bound_text(log2: f64) -> String {
    format!("2^{}", log2.ceil() as i64)
}

fn verdict_record(study: &Study, decided: &Decided) -> VerdictRecord {
    let g = &study.model.graph;
    let mut record = VerdictRecord {
        claim: decided.claim.into(),
        subject: decided.subject.clone(),
        verdict: decided.finding.verdict.word().into(),
        detail: decided.finding.verdict.detail().into(),
        seconds: (decided.seconds * 1e6).round() / 1e6,
        expected: decided.expected.clone(),
        formulas: decided
            .finding
            .formulas
            .iter()
            .map(|f| {
                let right = legible(g, f.right);
                match f.left {
                    Some(left) => format!("{} = {right}", g.text(left)),
                    None => right,
                }
            })
            .collect(),
        ..VerdictRecord::default()
    };
    of_verdict(&mut record, &decided.finding.verdict);
    record
}

/// The evidence of a verdict.
pub(crate) fn of_verdict(record: &mut VerdictRecord, verdict: &Verdict) {
    match verdict {
        Verdict::Proved(proof) => with_proof(record, proof),
        Verdict::Numerical(evidence) => with_evidence(record, evidence),
        Verdict::Refuted(counterexample) => {
            record.counterexample = Some(counterexample_record(counterexample))
        }
        Verdict::Conditional {
            condition,
            proof,
            counterexample,
        } => {
            with_proof(record, proof);
            record.condition = Some(condition.clone());
            record.counterexample = counterexample.as_ref().map(counterexample_record);
        }
        Verdict::NotApplicable { hypothesis, .. } => record.condition = Some(hypothesis.clone()),
        Verdict::Undecided { .. } => {}
    }
}

/// A formula, unless it is too long to be read.
fn legible(g: &Graph, e: Expr) -> String {
    match crate::typeset::is_legible(g, e) {
        true => g.text(e),
        false => "…".to_owned(),
    }
}

fn with_proof(record: &mut VerdictRecord, proof: &Proof) {
    record.method = Some(proof.method.word().into());
    record.on = Some(proof.on.clone());
    record.error_bound = proof.error_bound_log2.map(bound_text);
    record.samples = (proof.samples > 0).then_some(u64::from(proof.samples));
    record.seed = proof.seed;
}

fn with_evidence(record: &mut VerdictRecord, evidence: &Evidence) {
    record.on = Some(evidence.region.clone());
    record.samples = Some(u64::from(evidence.samples));
    record.seed = evidence.seed;
    record.residual = evidence.residual.is_finite().then_some(evidence.residual);
}

fn counterexample_record(counterexample: &Counterexample) -> CounterexampleRecord {
    CounterexampleRecord {
        point: counterexample
            .point
            .iter()
            .map(|p| PointRecord {
                name: p.name.clone(),
                exact: p.exact.as_ref().map(|r| r.to_string()),
                enclosure: p.enclosure.clone().map(|(low, high)| [low, high]),
            })
            .collect(),
        quantity: counterexample.quantity.clone(),
        residual: [
            counterexample.residual.0.clone(),
            counterexample.residual.1.clone(),
        ],
    }
}

fn trajectory_record(study: &Study, motion: &Motion, files: &[String]) -> TrajectoryRecord {
    let evidence = &motion.evidence;
    let run = &evidence.run;
    let names: Vec<String> = evidence
        .start
        .iter()
        .map(|(name, _)| name.clone())
        .collect();
    let last = match run.len().checked_sub(1) {
        Some(j) => names
            .iter()
            .zip(&run.row(j)[..run.layout.v().end])
            .map(|(name, &x)| NamedValue::new(name.clone(), x))
            .collect(),
        None => Vec::new(),
    };
    let mut drifts: Vec<NamedValue> = evidence
        .residuals
        .iter()
        .map(|f| NamedValue::new(format!("constraint {}", f.name), f.drift.value))
        .collect();
    drifts.push(NamedValue::new("energy", evidence.energy.drift.value));
    drifts.extend(
        evidence
            .integrals
            .iter()
            .map(|f| NamedValue::new(format!("integral {}", f.name), f.drift.value)),
    );
    TrajectoryRecord {
        formulation: run.formulation.into(),
        method: run.method.into(),
        tolerance: motion.settings.tolerance,
        precision: match motion.settings.precise {
            Some(_) => Precision::DoubleDouble.word().into(),
            None => Precision::Double.word().into(),
        },
        t_start: motion.start.t,
        t_end: motion.settings.t_end,
        t: run.t,
        finished: run.ending.finished,
        reason: run.ending.reason.clone(),
        stop_time: run.ending.t.is_finite().then_some(run.ending.t),
        rows: run.len() as u64,
        steps: run.statistics.steps,
        rejected: run.statistics.rejected,
        evaluations: run.statistics.evaluations,
        chart_switches: run.statistics.chart_switches,
        initial: evidence
            .start
            .iter()
            .map(|(n, x)| NamedValue::new(n.clone(), *x))
            .collect(),
        last,
        global_error: evidence.global_error.filter(|e| e.is_finite()),
        drifts,
        kept: Kept::of(motion).map(|kept| kept_record(&study.model.graph, &kept)),
        events: events(motion, &names),
        files: files.to_vec(),
    }
}

fn kept_record(g: &Graph, kept: &Kept<'_>) -> KeptRecord {
    KeptRecord {
        integrals: kept
            .integrals()
            .map(|(number, integral, steps)| KeptIntegralRecord {
                integral: number.to_string(),
                formula: legible(g, integral.shown),
                steps,
            })
            .collect(),
        moved: kept.report.moved,
        largest_change: kept.report.largest.value,
    }
}

/// The events met, with coordinates and velocities by name.
fn events(motion: &Motion, names: &[String]) -> Vec<EventRecord> {
    let run = &motion.evidence.run;
    let met = run.events.iter().map(|met| EventRecord {
        event: motion.settings.events[met.event].name.clone(),
        t: met.t,
        zero: zero_word(met.kind).into(),
        state: names
            .iter()
            .zip(&met.row[..run.layout.v().end])
            .map(|(name, &x)| NamedValue::new(name.clone(), x))
            .collect(),
    });
    met.collect()
}

/// How a function passes zero, in a word.
pub(crate) fn zero_word(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Up => "rising",
        EventKind::Down => "falling",
        EventKind::Grazing => "grazing",
    }
}
