//! Steady motions in words, a paragraph for each.

use chetaev_stability::steady_set::{Found, SteadySet};
use chetaev_symbolic::Graph;

/// One paragraph for each motion that can be meant: not where the mass matrix is singular or what is assumed does not hold, if there are others.
pub(crate) fn lines(g: &Graph, set: &SteadySet) -> String {
    let is_meant = |own: &&Found| own.is_assumed && !own.is_singular;
    let meant: Vec<&Found> = set.found.iter().filter(is_meant).collect();
    let all = || set.found.iter().collect();
    let listed = if meant.is_empty() { all() } else { meant };
    listed.iter().map(|own| paragraph(g, set, own)).collect()
}

/// One motion with its number.
pub(super) fn paragraph(g: &Graph, set: &SteadySet, own: &Found) -> String {
    let parts = set.parts(g, own);
    match own.dimension() {
        0 => format!("  {}  {}\n", own.name, parts.join(", ")),
        count => {
            let s = if count == 1 { "" } else { "s" };
            format!(
                "  {}  a family with {count} parameter{s}\n       {}\n",
                own.name,
                parts.join("\n       ")
            )
        }
    }
}

/// A clause with a capital letter.
pub(super) fn sentence(clause: &str) -> String {
    let (first, rest) = clause.split_at(clause.chars().next().map_or(0, char::len_utf8));
    format!("{}{rest}", first.to_uppercase())
}
