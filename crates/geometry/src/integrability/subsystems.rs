//! Which sub-systems of several constraints are integrable by themselves.

use super::{decide, on_each_side, PfaffSystem, Strength};
use chetaev_mechanics::memo::Memo;
use chetaev_mechanics::{characteristics, Context, MotionTerms, Selection, System};
use chetaev_symbolic::Verdict;

/// The most sub-systems looked at.
const SUBSETS: usize = 64;

/// The most sub-systems named one by one.
const LISTED: usize = 6;

/// So many sub-systems are asked what they keep.
const ASKED: usize = 12;

/// Sub-systems by the verdict on each.
#[derive(Default)]
struct Sorted {
    integrable: Vec<String>,
    on_sides: Vec<String>,
    not: Vec<String>,
    open: Vec<String>,
}

/// In words; `None` where there is one constraint only.
pub(super) fn told(cx: &Context<'_>, strength: Strength) -> Option<String> {
    let rows = &cx.selection.rows;
    if rows.len() < 2 {
        return None;
    }
    let (subsets, looked) = subsets(rows);
    let all = subsets.len();
    let (mut sorted, mut done) = (Sorted::default(), 0);
    for subset in subsets {
        if cx.is_out_of_time() {
            break;
        }
        done += 1;
        let names = names(cx.system, cx.terms, &subset);
        let list = match verdict(cx, &subset, strength) {
            Verdict::Proved(_) => &mut sorted.integrable,
            Verdict::Conditional { .. } => &mut sorted.on_sides,
            Verdict::Refuted(_) => &mut sorted.not,
            _ => &mut sorted.open,
        };
        list.push(names);
    }
    let parts = [
        (sorted.integrable, "integrable by themselves"),
        (
            sorted.on_sides,
            "integrable by themselves on sides or components",
        ),
        (sorted.not, "not integrable by themselves"),
        (sorted.open, "not decided by themselves"),
    ];
    let parts = parts.into_iter().filter(|(names, _)| !names.is_empty());
    let mut parts: Vec<String> = parts
        .map(|(names, word)| format!("{word}: {}", listed(&names)))
        .collect();
    if let Some(looked) = looked {
        parts.insert(0, looked);
    }
    if done < all {
        parts.push(format!(
            "the time was spent after {done} of {all} sub-systems"
        ));
    }
    Some(parts.join("; "))
}

/// Terms and independent velocities of single constraints and of pairs, as many as are asked what they keep.
pub(super) fn small(cx: &Context<'_>) -> Vec<(MotionTerms, Selection)> {
    let rows = &cx.selection.rows;
    let all = of_size(rows, 2).into_iter();
    let proper = all.filter(|subset| subset.len() < rows.len()).take(ASKED);
    let terms = proper.map(|subset| restricted_terms(cx.terms, &subset));
    terms
        .filter_map(|own| {
            let selection = characteristics::select(cx.system, &own).ok()?;
            Some((own, selection))
        })
        .collect()
}

/// All proper subsets, single constraints first, while they are few; else single ones and pairs, or single ones alone, with a sentence
/// that says so.
fn subsets(rows: &[usize]) -> (Vec<Vec<usize>>, Option<String>) {
    let r = rows.len();
    let of_size = |most: usize| of_size(rows, most);
    if r < usize::BITS as usize && (1_usize << r) - 2 <= SUBSETS {
        return (of_size(r - 1), None);
    }
    if r + r * (r - 1) / 2 <= 2 * SUBSETS {
        let said = "of the sub-systems those of one and of two constraints were looked at";
        return (of_size(2), Some(said.into()));
    }
    let said = "of the sub-systems those of one constraint were looked at";
    (of_size(1), Some(said.into()))
}

/// Subsets of up to so many, in order of their size.
fn of_size(rows: &[usize], most: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = Vec::new();
    let mut last: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..most {
        let extended = last.iter().flat_map(|subset| {
            let next = rows.iter().filter(|&row| subset.last() < Some(row));
            next.map(|&row| [&subset[..], &[row]].concat())
        });
        last = extended.collect();
        all.extend(last.iter().cloned());
    }
    all
}

/// All names of a short list, the first few of a long one.
fn listed(names: &[String]) -> String {
    match names.get(..LISTED) {
        Some(first) if names.len() > LISTED + 1 => {
            let more = names.len() - LISTED;
            format!("{} and {more} more", first.join(", "))
        }
        _ => names.join(", "),
    }
}

fn names(system: &System, terms: &MotionTerms, rows: &[usize]) -> String {
    let names: Vec<String> = rows
        .iter()
        .map(|&row| format!("`{}`", system.constraints[terms.constraint_index[row]].name))
        .collect();
    if names.len() == 1 {
        names.concat()
    } else {
        format!("{{{}}}", names.join(", "))
    }
}

fn verdict(cx: &Context<'_>, rows: &[usize], strength: Strength) -> Verdict {
    // The others are not imposed: a state that refutes need not satisfy them.
    let mut system = cx.system.clone();
    let places = rows.iter().map(|&row| cx.terms.constraint_index[row]);
    system.constraints = places
        .map(|place| cx.system.constraints[place].clone())
        .collect();
    let terms = MotionTerms {
        constraint_index: (0..rows.len()).collect(),
        ..restricted_terms(cx.terms, rows)
    };
    match characteristics::select(&system, &terms) {
        Ok(selection) => {
            let pfaff = PfaffSystem::new(&system, &terms, selection);
            on_each_side(cx, rows, decide(cx, &pfaff, strength).verdict)
        }
        Err(problem) => Verdict::undecided(problem.to_string()),
    }
}

/// The terms with some of the constraints only.
fn restricted_terms(terms: &MotionTerms, rows: &[usize]) -> MotionTerms {
    MotionTerms {
        memo: Memo::default(),
        order: terms.order,
        jets: terms.jets.clone(),
        mass_matrix: terms.mass_matrix.clone(),
        force: terms.force.clone(),
        affine: rows.iter().map(|&row| terms.affine[row]).collect(),
        constraints: rows.iter().map(|&row| terms.constraints[row]).collect(),
        jacobian: rows
            .iter()
            .map(|&row| terms.jacobian[row].clone())
            .collect(),
        constraint_rate: rows.iter().map(|&row| terms.constraint_rate[row]).collect(),
        constraint_index: rows
            .iter()
            .map(|&row| terms.constraint_index[row])
            .collect(),
    }
}
