//! All states of rest, and all steady motions, of a system.

use super::stated::refused;
use crate::parameter_values::{for_which, general_parameters, of_general, stated_functions};
use crate::steady_motions::{Found, SteadySet};
use crate::steady_set::{all_of, Sought};
use crate::steady_value::SteadySetError;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Graph, Verdict};

/// Seconds of work for a set.
const SECONDS: f64 = 0.25;

/// More signs of formulas are not written: `chetaev steady` prints them.
const LONGEST: usize = 2_000;

/// `equilibrium.states`: all states of rest are found.
#[derive(Clone, Copy, Debug)]
pub struct StatesOfRest;

/// `steady.motions`: all steady motions are found.
#[derive(Clone, Copy, Debug)]
pub struct SteadyMotions;

impl Claim for StatesOfRest {
    fn id(&self) -> &'static str {
        "equilibrium.states"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "All states of rest are found"
    }

    fn explanation(&self) -> &'static str {
        include_str!("states_of_rest.md")
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        verdict(cx, Sought::Rest).into()
    }
}

impl Claim for SteadyMotions {
    fn id(&self) -> &'static str {
        "steady.motions"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "All steady motions are found: along them everything that the equations of motion depend on is constant"
    }

    fn explanation(&self) -> &'static str {
        include_str!("steady_motions.md")
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        verdict(cx, Sought::SteadyMotions).into()
    }
}

fn verdict(cx: &Context<'_>, sought: Sought) -> Verdict {
    let (system, values) = (cx.system, cx.system.parameter_values());
    let of = (system, cx.terms, cx.selection);
    let found = within(&Work::of_seconds(SECONDS), || all_of(sought, of, &values));
    match found {
        Ok(Ok(set)) => {
            let g = &system.graph;
            let general = general_parameters(system, &stated_functions(system));
            let said = of_general(listed(g, &set, sought), &general);
            // States of the system at which no chart serves may be at rest all the same.
            let is_left_out = !set.is_complete();
            if is_left_out {
                let clauses = std::iter::once(said).chain(set.left_out(g));
                return Verdict::undecided(clauses.collect::<Vec<_>>().join("; "));
            }
            // Whether a family has real members is a part of which there are.
            if set.found.iter().all(|own| own.is_real) {
                Verdict::Proved(Proof::exact(on(g, &set, &general), said))
            } else {
                Verdict::undecided(said)
            }
        }
        Ok(Err(SteadySetError::System(problem))) => refused(system, *problem),
        Ok(Err(problem)) => Verdict::undecided(problem.to_string()),
        Err(_) => Verdict::undecided(format!(
            "their equations were not solved within the work of {SECONDS} s; `chetaev steady` has no such limit"
        )),
    }
}

/// For which values of parameters, and for which states.
fn on(g: &Graph, set: &SteadySet, general: &[String]) -> String {
    let parts = std::iter::once(for_which(general)).chain(set.left_out(g));
    parts.collect::<Vec<_>>().join("; ")
}

/// How many, and which.
fn listed(g: &Graph, set: &SteadySet, sought: Sought) -> String {
    let (one, many) = match sought {
        Sought::Rest => ("state of rest", "states of rest"),
        Sought::SteadyMotions => ("steady motion", "steady motions"),
    };
    let is_regular = |own: &&Found| !own.is_singular && own.is_assumed && own.is_real;
    let regular: Vec<&Found> = set.found.iter().filter(is_regular).collect();
    let without_real = set.found.iter().filter(|own| !own.is_real).count();
    let open = match without_real {
        0 => String::new(),
        1 => "; whether one more family has real members was not decided".into(),
        count => format!("; whether {count} more families have real members was not decided"),
    };
    let others = match set.found.len() - regular.len() - without_real {
        0 => String::new(),
        1 => "; one more lies where the mass matrix is singular, or outside of what the model assumes".into(),
        count => format!("; {count} more lie where the mass matrix is singular, or outside of what the model assumes"),
    };
    let others = format!("{others}{open}");
    if regular.is_empty() && without_real > 0 {
        return format!("no {one} is known{others}");
    }
    if regular.is_empty() {
        return format!("there is no {one}{others}");
    }
    let isolated = regular.iter().filter(|own| own.dimension() == 0).count();
    let counts = [
        counted(isolated, one, many),
        counted(regular.len() - isolated, "family", "families"),
    ];
    let counts: Vec<String> = counts.into_iter().flatten().collect();
    let anywhere = match set.ignorable.as_slice() {
        [] => String::new(),
        own => format!("; nothing depends on {}", own.join(", ")),
    };
    if set.variables.is_empty() {
        return format!("the system rests in every position{others}");
    }
    let said = regular.iter().map(|own| {
        let list = set.parts(g, own).join(", ");
        match own.dimension() {
            0 => list,
            n => format!("{list} (of dimension {n})"),
        }
    });
    let said = said.collect::<Vec<String>>().join("; ");
    let counts = counts.join(" and ");
    if said.len() > LONGEST {
        format!("{counts}{anywhere}{others}; `chetaev steady` writes them")
    } else {
        format!("{counts}: {said}{anywhere}{others}")
    }
}

/// `3 families`.
fn counted(count: usize, one: &str, many: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("one {one}")),
        _ => Some(format!("{count} {many}")),
    }
}
