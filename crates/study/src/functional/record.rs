//! `study.json` of a functional.

use super::{boundary, euler, Shown};
use crate::record::{
    of_verdict, ConditionRecord, FunctionalRecord, ModelRecord, OptionsRecord, Record,
    VerdictRecord, WorkRecord, SCHEMA,
};
use chetaev_functionals::functional::Role;
use chetaev_functionals::study::Decided;
use chetaev_functionals::Study;
use chetaev_symbolic::Graph;

/// The record of a study; `claims` are the words that selected them.
pub fn record(study: &Study, claims: &[String]) -> Record {
    Record {
        schema: SCHEMA.into(),
        chetaev: env!("CARGO_PKG_VERSION").into(),
        model: ModelRecord::of(&study.problem.text),
        verdicts: study.verdicts.iter().map(|d| verdict(study, d)).collect(),
        equations: Vec::new(),
        trajectory: None,
        notices: study.notices.clone(),
        options: OptionsRecord {
            claims: claims.to_vec(),
            ..OptionsRecord::default()
        },
        files: Vec::new(),
        work: WorkRecord::default(),
        functional: Some(functional(study)),
    }
}

fn verdict(study: &Study, decided: &Decided) -> VerdictRecord {
    let g = &study.problem.functional.space.graph;
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
            .map(|f| format!("{}: {}", f.caption, g.text(f.value)))
            .collect(),
        ..VerdictRecord::default()
    };
    of_verdict(&mut record, &decided.finding.verdict);
    record
}

fn functional(study: &Study) -> FunctionalRecord {
    let own = &study.problem.functional;
    let g = &own.space.graph;
    let labels = |role: Role| own.with_role(role).map(|e| e.label.clone()).collect();
    let mut conditions = Vec::new();
    for (piece, all) in boundary(study) {
        conditions.extend(all.iter().map(|shown| condition(g, Some(&piece), shown)));
    }
    FunctionalRecord {
        name: own.name.clone(),
        level: own.level.clone(),
        dimensions: own.space.dimensions() as u64,
        fields: own.fields.iter().map(|f| f.name.clone()).collect(),
        imposed: labels(Role::Imposed),
        yields: labels(Role::Yielded),
        euler: euler(study)
            .iter()
            .map(|shown| condition(g, None, shown))
            .collect(),
        boundary: conditions,
    }
}

fn condition(g: &Graph, on: Option<&str>, shown: &Shown) -> ConditionRecord {
    ConditionRecord {
        on: on.map(str::to_owned),
        of: shown.of.clone(),
        zero: g.text(shown.value),
    }
}
