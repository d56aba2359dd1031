//! The equations of every formulation in a record: what was derived, in the grammar of model files, for whoever checks it.

use crate::flat::options;
use crate::registry::registry;
use crate::study::Study;
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::{Context, Equations, Prover, System};
use chetaev_symbolic::print::{Document, Format};
use chetaev_symbolic::Expr;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Equations of more nodes than this are left out of the record: its size is that of a text which a person may still open.
const LARGEST: usize = 12_000;

/// The equations of motion in one formulation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EquationsRecord {
    /// Name of the formulation, the subject of `formulation.equivalent`.
    pub formulation: String,
    /// Why the equations are left out, or null.
    pub omitted: Option<String>,
    /// The variables beside the coordinates.
    pub state: Vec<StateRecord>,
    /// What the equations determine: rates of the variables, multipliers, other unknowns.
    pub unknowns: Vec<String>,
    /// Parts that the texts below share, `name = value`; linear systems whose unknowns are such parts, one equation each.
    pub definitions: Vec<String>,
    /// The equations, `left = right`.
    pub equations: Vec<String>,
    /// q' by coordinate, as functions of the coordinates and the state; their total derivatives are the accelerations.
    pub velocities: Vec<String>,
}

/// A variable of a formulation's state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StateRecord {
    /// Its name.
    pub name: String,
    /// What it is as a function of q, q', t; null for data of its own.
    pub definition: Option<String>,
}

/// The claim that decides which equations a record has.
pub(crate) const EQUIVALENCE: &str = "formulation.equivalent";

/// Whether a verdict says something of the equations.
pub(crate) fn is_decided(word: &str) -> bool {
    matches!(word, "proved" | "refuted" | "conditional" | "numerical")
}

/// The equations of all formulations whose equivalence the study decided.
pub fn stated_equations(study: &Study) -> Vec<EquationsRecord> {
    let known = registry();
    let cx = Context::of(&study.system, &study.prepared, &known, Prover::default());
    let decided = (study.verdicts.iter())
        .filter(|d| d.claim == EQUIVALENCE && is_decided(d.finding.verdict.word()));
    let names = decided.filter_map(|d| d.subject.as_deref());
    names
        .filter_map(|name| Some(one(&study.system, name, &derive(&cx, name).ok()?)))
        .collect()
}

fn one(system: &System, name: &str, equations: &Equations) -> EquationsRecord {
    let g = &system.graph;
    let laws = equations.laws_of_masses(system);
    let groups = equations.groups.iter().chain(&laws);
    let pairs: Vec<(Expr, Expr)> = groups
        .flat_map(|group| &group.equations)
        .map(|e| (e.left, e.right))
        .collect();
    let zero = g.zero();
    let others = equations.velocities.iter().map(|&e| (e, zero));
    let defined: Vec<(&str, Expr)> = (equations.variables.iter())
        .filter_map(|x| Some((x.name.as_str(), x.definition?)))
        .collect();
    let all: Vec<(Expr, Expr)> = pairs
        .iter()
        .copied()
        .chain(others)
        .chain(defined.iter().map(|&(_, e)| (e, zero)))
        .collect();
    let roots: Vec<Expr> = all.iter().flat_map(|&(l, r)| [l, r]).collect();
    let size = g.reachable(&roots).len();
    let mut record = EquationsRecord {
        formulation: name.into(),
        ..EquationsRecord::default()
    };
    if size > LARGEST {
        record.omitted = Some(format!("they have {size} parts, more than {LARGEST}"));
        return record;
    }
    let text = Document::equations(g, &all, &options(system)).parts(Format::Text);
    let (stated, rest) = text.statements.split_at(pairs.len());
    let (velocities, definitions) = rest.split_at(equations.velocities.len());
    let side = |text: &String| text.strip_suffix(" = 0").unwrap_or(text).to_owned();
    record.equations = stated.to_vec();
    record.velocities = velocities.iter().map(side).collect();
    record.definitions = text.definitions.clone();
    let mut definitions = definitions.iter().map(side);
    record.state = equations
        .variables
        .iter()
        .map(|x| StateRecord {
            name: x.name.clone(),
            definition: x.definition.and_then(|_| definitions.next()),
        })
        .collect();
    record.unknowns = unknowns(system, equations, &pairs);
    record
}

/// The symbols of the equations that are neither the time, parameters, coordinates, variables of the state nor controls.
fn unknowns(system: &System, equations: &Equations, pairs: &[(Expr, Expr)]) -> Vec<String> {
    let g = &system.graph;
    let roots: Vec<Expr> = pairs.iter().flat_map(|&(l, r)| [l, r]).collect();
    let mut known: BTreeSet<String> = equations.variables.iter().map(|x| x.name.clone()).collect();
    known.extend(system.coordinates.iter().map(|c| c.name.clone()));
    known.extend(system.parameters.iter().map(|p| p.name.clone()));
    known.extend(system.masses.iter().map(|m| m.name.clone()));
    known.insert("t".into());
    let symbols = g.symbols_in(&roots).into_iter().filter_map(|s| {
        let (name, order) = (g.symbol_name(s), g.symbol_order(s) as usize);
        let is_control = system.controls.iter().any(|u| u.name == name);
        (!is_control).then(|| format!("{name}{}", "'".repeat(order)))
    });
    symbols.filter(|name| !known.contains(name)).collect()
}
