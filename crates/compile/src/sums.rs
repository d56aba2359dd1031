//! In which order the terms of sums are added, so that several sums share what they begin with: terms that occur in more sums
//! come first, and sums that begin with the same terms have the sum of these in common (the tree of prefixes of Han, Pei and Yin
//! 2000). Along a chain of bodies the velocity of one is that of the body before it and a little more, and so its cost is that of
//! the little.

use chetaev_symbolic::{Expr, Graph, Node, Rational};
use rustc_hash::FxHashMap;
use std::cmp::Reverse;

/// The order of addition of sums.
#[derive(Debug, Default)]
pub(crate) struct Sums {
    /// By sum that shares something: its terms by their places, in parts that are added one after the other.
    parts: FxHashMap<Expr, Vec<Vec<u32>>>,
}

impl Sums {
    /// For all sums below the roots, as far as `is_term` takes their terms into account.
    pub(crate) fn new(graph: &Graph, roots: &[Expr], is_term: impl Fn(Expr) -> bool) -> Sums {
        let mut known: FxHashMap<(Expr, &Rational), u32> = FxHashMap::default();
        let mut counts: Vec<u32> = Vec::new();
        // By sum: the numbers of its terms, with their places.
        let mut lists: Vec<(Expr, Vec<(u32, u32)>)> = Vec::new();
        for e in graph.reachable(roots) {
            let Node::Sum { terms, .. } = graph.node(e) else {
                continue;
            };
            let mut list = Vec::new();
            for (place, (term, coefficient)) in terms.iter().enumerate() {
                if !is_term(*term) {
                    continue;
                }
                let number = *known.entry((*term, coefficient)).or_insert_with(|| {
                    counts.push(0);
                    counts.len() as u32 - 1
                });
                counts[number as usize] += 1;
                list.push((number, place as u32));
            }
            lists.push((e, list));
        }
        for (_, list) in &mut lists {
            list.retain(|(number, _)| counts[*number as usize] > 1);
            list.sort_by_key(|&(number, _)| (Reverse(counts[number as usize]), number));
        }
        lists.retain(|(_, list)| list.len() > 1);
        let tree = Tree::of(&lists);
        let parts = lists.iter().filter_map(|(e, list)| {
            let Node::Sum { terms, .. } = graph.node(*e) else {
                return None;
            };
            Some((*e, tree.parts(list, terms.len())?))
        });
        Sums {
            parts: parts.collect(),
        }
    }

    /// The places of the terms of a sum in parts to be added one after the other; `None` where it shares nothing.
    pub(crate) fn parts(&self, sum: Expr) -> Option<&[Vec<u32>]> {
        self.parts.get(&sum).map(Vec::as_slice)
    }
}

/// All beginnings of sums; the first is the empty one.
struct Tree {
    /// How many sums begin so.
    counts: Vec<u32>,
    /// By beginning and the term that follows.
    next: FxHashMap<(u32, u32), u32>,
}

impl Tree {
    fn of(lists: &[(Expr, Vec<(u32, u32)>)]) -> Tree {
        let (mut counts, mut next) = (vec![0], FxHashMap::default());
        for (_, list) in lists {
            let mut here = 0;
            for &(number, _) in list {
                here = *next.entry((here, number)).or_insert_with(|| {
                    counts.push(0);
                    counts.len() as u32 - 1
                });
                counts[here as usize] += 1;
            }
        }
        Tree { counts, next }
    }

    /// Ends a part wherever fewer sums go on than came so far.
    fn parts(&self, list: &[(u32, u32)], all: usize) -> Option<Vec<Vec<u32>>> {
        let (mut parts, mut part) = (Vec::new(), Vec::new());
        let (mut here, mut taken) = (0, vec![false; all]);
        for &(number, place) in list {
            let next = *self.next.get(&(here, number))?;
            let count = self.counts[next as usize];
            let fewer = count < self.counts[here as usize];
            // One term alone is no sum that could be shared.
            if fewer && parts.len() + part.len() > 1 {
                parts.push(std::mem::take(&mut part));
            }
            if count < 2 {
                break;
            }
            part.push(place);
            taken[place as usize] = true;
            here = next;
        }
        if parts.is_empty() && part.len() < 2 {
            return None;
        }
        if !part.is_empty() {
            parts.push(part);
        }
        let rest: Vec<u32> = (0..all as u32).filter(|&i| !taken[i as usize]).collect();
        if !rest.is_empty() {
            parts.push(rest);
        }
        Some(parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sums of the first two, three and four terms of a chain, and one of other terms.
    #[test]
    fn sums_share_what_they_begin_with() {
        let g = Graph::new();
        let [a, b, c, d, e] = ["a", "b", "c", "d", "e"].map(|name| g.symbol(name, 0));
        let sums = [&[a, b][..], &[c, b, a], &[a, d, b, c], &[e, a]].map(|terms| g.add(terms));
        let found = Sums::new(&g, &sums, |_| true);
        let parts = |sum: Expr| -> Option<Vec<Vec<Expr>>> {
            let Node::Sum { terms, .. } = g.node(sum) else {
                return None;
            };
            let of = |part: &Vec<u32>| {
                let mut own: Vec<Expr> = part.iter().map(|&i| terms[i as usize].0).collect();
                own.sort_unstable();
                own
            };
            Some(found.parts(sum)?.iter().map(of).collect())
        };
        assert_eq!(parts(sums[0]), Some(vec![vec![a, b]]));
        assert_eq!(parts(sums[1]), Some(vec![vec![a, b], vec![c]]));
        assert_eq!(parts(sums[2]), Some(vec![vec![a, b], vec![c], vec![d]]));
        assert_eq!(parts(sums[3]), None);
    }

    #[test]
    fn terms_with_other_numbers_are_others() {
        let g = Graph::new();
        let [a, b, c] = ["a", "b", "c"].map(|name| g.symbol(name, 0));
        let twice = g.scale(&chetaev_symbolic::rational::integer(2), b);
        let sums = [g.add(&[a, b, c]), g.add(&[a, twice])];
        let found = Sums::new(&g, &sums, |_| true);
        assert!(sums.iter().all(|&sum| found.parts(sum).is_none()));
    }
}
