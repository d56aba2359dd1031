//! Sets that differ by the branch of a constraint alone: `x' = −y'` with `z' = y'` and with `z' = −y'`, where the constraint gives
//! `z'² = y'²`, are the motions with `x' = −y'`. So it is said in the condition; κ is still told of each by itself.

use super::{Leaf, Search};
use crate::stationarity::closed_form::short;
use chetaev_symbolic::Expr;

/// Symbols with their values.
type Values = Vec<(Expr, Expr)>;

impl Search<'_, '_> {
    /// Finds what to say of sets whose constraints are there with all their branches.
    pub(super) fn join_branches(&self, leaves: &mut [Leaf]) {
        let pairs = (0..leaves.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let found = pairs.filter_map(|(i, j)| {
            let joined = self.joined_branches(&leaves[i], &leaves[j])?;
            Some((i, j, joined))
        });
        for (i, j, joined) in found.collect::<Vec<_>>() {
            leaves[j].without_branch = Some(joined.clone());
            leaves[i].without_branch = Some(joined);
        }
    }

    /// The equations that two sets share, where the constraints give what they do not.
    fn joined_branches(&self, a: &Leaf, b: &Leaf) -> Option<Vec<String>> {
        let is_plain =
            |l: &Leaf| l.implicit.is_empty() && l.roots.is_empty() && l.angles.is_empty();
        if !is_plain(a) || !is_plain(b) || a.nonzero != b.nonzero {
            return None;
        }
        let others = self.forms(b);
        self.forms(a).into_iter().find_map(|own| {
            let symbol = others.iter().find_map(|other| {
                let (symbol, values) = differing(&own, other)?;
                self.is_given(&own, symbol, values).then_some(symbol)
            })?;
            let shared = own.iter().filter(|(s, _)| *s != symbol);
            Some(
                shared
                    .map(|&(s, e)| Leaf::written(self.g, None, s, e))
                    .collect(),
            )
        })
    }

    /// The values of a set, and as they are with a dependent velocity solved for in the place of another.
    fn forms(&self, leaf: &Leaf) -> Vec<Values> {
        let g = self.g;
        let is_solved = |s: Expr| leaf.solved.iter().any(|(own, _)| *own == s);
        let velocities = self.cx.system.coordinates.iter().map(|c| c.v);
        let free: Vec<Expr> = velocities.filter(|&v| !is_solved(v)).collect();
        let exchanged = leaf.solved.iter().flat_map(|&(symbol, value)| {
            free.iter().filter_map(move |&other| {
                let slope = g.diff(value, g.as_symbol(other)?);
                let is_constant =
                    !g.is_zero(slope) && g.is_free_of(slope, &|s| self.state.contains(&s));
                let rest = g.substitute(value, &[(other, g.zero())]);
                let own = g.div(g.sub(symbol, rest), slope);
                let by = [(other, own)];
                let others = leaf.solved.iter().filter(|(s, _)| *s != symbol);
                let others = others.map(|&(s, e)| (s, short(g, g.substitute(e, &by))));
                is_constant.then(|| others.chain([(other, short(g, own))]).collect())
            })
        });
        [leaf.solved.clone()].into_iter().chain(exchanged).collect()
    }

    /// Whether a constraint that is not solved for a symbol gives these two values of it, and no others, with what else holds.
    fn is_given(&self, solved: &Values, symbol: Expr, [a, b]: [Expr; 2]) -> bool {
        let g = self.g;
        let others = solved.iter().filter(|(own, _)| *own != symbol);
        let others: Values = others.copied().collect();
        let product = g.mul(&[g.sub(symbol, a), g.sub(symbol, b)]);
        self.motion.implicit.iter().any(|&f| {
            let ratio = short(g, g.div(g.substitute(f, &others), product));
            g.as_number(ratio).is_some() && !g.is_zero(ratio)
        })
    }
}

/// The one symbol for which two sets have different values, with these.
fn differing(a: &Values, b: &Values) -> Option<(Expr, [Expr; 2])> {
    let value = |s: Expr| b.iter().find(|(own, _)| *own == s).map(|(_, e)| *e);
    let mut found = None;
    for &(symbol, own) in a {
        let other = value(symbol)?;
        if own != other && found.replace((symbol, [own, other])).is_some() {
            return None;
        }
    }
    (a.len() == b.len()).then_some(found)?
}
