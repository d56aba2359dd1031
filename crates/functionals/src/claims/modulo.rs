//! Modulo which stated equations something vanishes: the fewest are named.

use crate::elimination::{Entries, Group, Solved};
use crate::functional::{Functional, Role};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// What is said of functionals over different bodies.
pub(super) fn other_body(functional: &Functional, other: &Functional) -> Option<Verdict> {
    let is_same = functional.is_over_the_body_of(other);
    (!is_same).then(|| {
        Verdict::undecided(format!(
            "{} and {} are stated over different bodies, which are not compared",
            functional.name, other.name
        ))
    })
}

/// All that is stated of a functional.
pub(super) const STATED: &[Role] = &[Role::Imposed, Role::Yielded, Role::Other];

/// The stated equations with these roles that may be used in the interior, or on a piece, by label.
pub(super) fn equations(functional: &Functional, on: Option<&str>, roles: &[Role]) -> Vec<Group> {
    functional
        .equations
        .iter()
        .filter(|e| e.on.is_none() || e.on.as_deref() == on)
        .filter(|e| roles.contains(&e.role))
        .map(|e| Group {
            label: e.label.clone(),
            equations: e.residuals.clone(),
        })
        .collect()
}

/// Equations that were needed, and where they say what was needed.
#[derive(Clone, Debug, Default)]
pub(super) struct Needed {
    /// The labels of the equations.
    labels: Vec<String>,
    /// What must be so that they can be solved: `E ≠ 0`.
    conditions: Vec<String>,
}

impl Needed {
    /// Whether nothing was needed.
    pub(super) fn is_empty(&self) -> bool {
        self.labels.is_empty()
    }

    fn of(solved: &Solved<'_>, groups: Vec<Group>) -> Needed {
        Needed {
            labels: groups.into_iter().map(|group| group.label).collect(),
            conditions: conditions(solved),
        }
    }
}

/// What must be so that equations can be solved as they were.
pub(super) fn conditions(solved: &Solved<'_>) -> Vec<String> {
    let g = &solved.space.graph;
    let nonzero = solved.nonzero.iter();
    let mut found: Vec<String> = nonzero.map(|&e| format!("{} ≠ 0", g.text(e))).collect();
    let pivots = solved.pivots.iter();
    // Cases in which fields or data vanish were looked at, and the normal does not vanish.
    let open = pivots.filter(|own| !matches!(own.entries, Entries::Fields | Entries::Normal));
    found.extend(open.map(|own| own.said().trim_start_matches(", where ").to_owned()));
    found
}

/// `(3) and (4) where E ≠ 0`.
impl std::fmt::Display for Needed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&labels(&self.labels))?;
        match &self.conditions[..] {
            [] => Ok(()),
            some => write!(f, " where {}", some.join(" and ")),
        }
    }
}

/// A refutation of what is said of fields that satisfy equations: one by other fields refutes nothing.
pub(super) fn among(
    functional: &Functional,
    es: &[Expr],
    held: &[Group],
    verdict: Verdict,
) -> Verdict {
    if held.is_empty() || !matches!(verdict, Verdict::Refuted(_)) {
        return verdict;
    }
    let solved = Solved::new(&functional.space).with(held);
    let refuted = es.iter().map(|&e| solved.verdict(e));
    let mut refuted = refuted.filter(|own| matches!(own, Verdict::Refuted(_)));
    let refuted = refuted.next().filter(|_| solved.left.is_empty());
    refuted.unwrap_or_else(|| {
        let all: Vec<String> = held.iter().map(|group| group.label.clone()).collect();
        let labels = labels(&all);
        Verdict::undecided(format!(
            "no fields were found that satisfy {labels} and for which it is false"
        ))
    })
}

/// A proof that expressions vanish modulo the fewest of the equations, with these; else the verdict without any.
pub(super) fn vanishing(
    functional: &Functional,
    es: &[Expr],
    available: &[Group],
) -> Result<(Proof, Needed), Box<Verdict>> {
    let space = &*functional.space;
    let nothing = Solved::new(space);
    let mut verdict = Verdict::Proved(Proof::exact("", ""));
    for &e in es {
        verdict = verdict.and(nothing.verdict(e));
    }
    if let Verdict::Proved(proof) = verdict {
        return Ok((proof, Needed::default()));
    }
    for count in 1..=available.len() {
        for chosen in subsets(available.len(), count) {
            let groups: Vec<Group> = chosen.iter().map(|&i| available[i].clone()).collect();
            let solved = nothing.with(&groups);
            if !solved.follows(es) {
                continue;
            }
            let mut verdict = Verdict::Proved(Proof::exact("", ""));
            for &e in es {
                verdict = verdict.and(solved.verdict(e));
            }
            if let Verdict::Proved(proof) = verdict {
                return Ok((proof, Needed::of(&solved, groups)));
            }
        }
    }
    Err(Box::new(verdict))
}

/// A proof that a difference of densities vanishes for all admitted fields; on the boundary it may be of second order in stated equations:
/// then it and its derivatives by all jets vanish where they hold, so that neither the value of the functional nor its first variation
/// there depends on it. With it what is to be said.
pub(super) fn vanishing_difference(
    functional: &Functional,
    difference: Expr,
    imposed: &[Group],
    stated: &[Group],
) -> Result<(Proof, Option<String>), Box<Verdict>> {
    let refused = match vanishing(functional, &[difference], imposed) {
        Ok((proof, needed)) if needed.is_empty() => return Ok((proof, None)),
        Ok((proof, needed)) => {
            let note = format!("modulo {needed}, which is imposed");
            return Ok((proof, Some(note)));
        }
        Err(verdict) => verdict,
    };
    if stated.is_empty() {
        return Err(refused);
    }
    let space = &*functional.space;
    let jets = space.jets_in(&[difference]);
    let slopes = jets.iter().map(|jet| space.partial(difference, jet));
    let slopes: Vec<Expr> = slopes.collect();
    let value = vanishing(functional, &[difference], stated);
    match (value, vanishing(functional, &slopes, stated)) {
        (Ok((one, of_value)), Ok((other, of_slopes))) => {
            let note = format!("modulo {of_value}, of second order with {of_slopes}");
            let both = Verdict::Proved(one).and(Verdict::Proved(other));
            match both {
                Verdict::Proved(proof) => Ok((proof, Some(note))),
                _ => Err(refused),
            }
        }
        _ => Err(refused),
    }
}

/// The subsets of 0, …, n − 1 with `count` members.
fn subsets(n: usize, count: usize) -> Vec<Vec<usize>> {
    let all = (0..1usize << n.min(12)).filter(|bits| bits.count_ones() as usize == count);
    all.map(|bits| (0..n).filter(|i| bits >> i & 1 == 1).collect())
        .collect()
}

/// All subsets, those with fewer members first.
pub(super) fn all_subsets(n: usize) -> Vec<Vec<usize>> {
    (0..=n).flat_map(|count| subsets(n, count)).collect()
}

/// `(3)`, `(3) and (4)`.
pub(super) fn labels(all: &[String]) -> String {
    let each: Vec<String> = all.iter().map(|label| format!("({label})")).collect();
    match each.split_last() {
        None => String::new(),
        Some((one, [])) => one.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}
