//! `study.json` of a functional.

use super::equations::{boundary, euler, indexed_euler, indexed_natural, Indexed, Shown};
use super::flat::flat;
use super::substitution::substituted;
use crate::record::{
    of_verdict, ConditionRecord, FunctionalRecord, ModelRecord, OptionsRecord, PutInRecord, Record,
    ValueRecord, VerdictRecord, WorkRecord, WrittenRecord, SCHEMA,
};
use chetaev_functionals::functional::{Functional, Role};
use chetaev_functionals::notation::written;
use chetaev_functionals::study::Decided;
use chetaev_functionals::Study;
use chetaev_symbolic::meter::UNITS_PER_SECOND;
use chetaev_symbolic::print::Format;
use chetaev_symbolic::Graph;

/// The record of a study; `claims` are the words that selected them, `files` what was written beside it.
pub fn record(study: &Study, claims: &[String], files: &[WrittenRecord]) -> Record {
    Record {
        schema: SCHEMA.into(),
        chetaev: env!("CARGO_PKG_VERSION").into(),
        model: ModelRecord {
            flat: Some(flat(&study.problem)),
            ..ModelRecord::of(&study.problem.text)
        },
        verdicts: study.verdicts.iter().map(|d| verdict(study, d)).collect(),
        equations: Vec::new(),
        trajectory: None,
        notices: study.notices.clone(),
        options: OptionsRecord {
            claims: claims.to_vec(),
            budget: Some(study.budget),
            ..OptionsRecord::default()
        },
        files: files.to_vec(),
        work: WorkRecord {
            units_per_second: UNITS_PER_SECOND,
        },
        functional: Some(functional(study)),
    }
}

fn verdict(study: &Study, decided: &Decided) -> VerdictRecord {
    let g = &study.problem.of_claims().functional.space.graph;
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
            .map(|f| match &f.indexed {
                Some(own) => format!("{}: {}", f.caption, own.text),
                None => format!("{}: {}", f.caption, g.text(f.value)),
            })
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
    let (mut inside, mut conditions, mut indexed) = (Vec::new(), Vec::new(), Vec::new());
    if let Ok(variation) = &study.variation {
        let all = euler(own, variation);
        inside.extend(all.iter().map(|shown| condition(g, None, shown)));
        let all = indexed_euler(own, variation);
        indexed.extend(all.iter().map(|shown| in_indices(own, None, shown)));
        for (piece, all) in boundary(own, variation) {
            conditions.extend(all.iter().map(|shown| condition(g, Some(&piece), shown)));
            let all = indexed_natural(own, &piece).unwrap_or_default();
            indexed.extend(all.iter().map(|shown| in_indices(own, Some(&piece), shown)));
        }
    }
    FunctionalRecord {
        name: own.name.clone(),
        level: own.level.clone(),
        dimensions: own.space.dimensions() as u64,
        fields: own.fields.iter().map(|f| f.name.clone()).collect(),
        imposed: labels(Role::Imposed),
        yields: labels(Role::Yielded),
        euler: inside,
        boundary: conditions,
        indexed,
        put_in: put_in(own),
    }
}

/// What is put in because it is imposed, with what follows then.
fn put_in(functional: &Functional) -> Option<PutInRecord> {
    let own = substituted(functional)?;
    let g = &own.functional.space.graph;
    let values = own.named().into_iter();
    let values = values.map(|(of, value)| ValueRecord { of, value });
    let on_pieces = own.boundary.iter().flat_map(|(piece, all)| {
        all.iter()
            .map(move |shown| condition(g, Some(piece), shown))
    });
    Some(PutInRecord {
        values: values.collect(),
        euler: own
            .euler
            .iter()
            .map(|shown| condition(g, None, shown))
            .collect(),
        boundary: on_pieces.collect(),
    })
}

fn in_indices(functional: &Functional, on: Option<&str>, shown: &Indexed) -> ConditionRecord {
    ConditionRecord {
        on: on.map(str::to_owned),
        of: shown.of.clone(),
        zero: written(&shown.value, &functional.scope, Format::Text),
        only_where: shown.only_where.clone(),
    }
}

fn condition(g: &Graph, on: Option<&str>, shown: &Shown) -> ConditionRecord {
    ConditionRecord {
        on: on.map(str::to_owned),
        of: shown.of.clone(),
        zero: g.text(shown.value),
        only_where: None,
    }
}
