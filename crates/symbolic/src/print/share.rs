//! Which sub-expressions are named, so that no formula is larger or deeper than a reader can bear.
//!
//! A graph of n nodes may be a tree of 2ⁿ; naming what is used more than once keeps the output in proportion to
//! the graph.

use crate::graph::Graph;
use crate::node::{Expr, Node};
use rustc_hash::FxHashMap;

/// Greatest depth of one printed formula. Browsers stop at 512 nested elements and Python at 200 nested
/// parentheses; readers stop much earlier.
const DEEPEST: u32 = 40;

/// Sizes from which repeated parts are named, tried from left to right until the whole is small enough.
const THRESHOLDS: [u64; 5] = [64, 32, 16, 10, 6];

#[derive(Clone, Default)]
struct Info {
    /// How often it would be written if every repeated part were named.
    uses: u64,
    /// Nodes to be written, parts that are named counting one.
    size: u64,
    height: u32,
    named: bool,
}

/// The decision for a set of expressions.
pub(crate) struct Plan {
    nodes: FxHashMap<Expr, Info>,
}

impl Plan {
    /// Decides for `roots`; `budget` is the number of nodes up to which nothing needs a name.
    pub(crate) fn new(g: &Graph, roots: &[Expr], budget: u64) -> Plan {
        let order = g.reachable(roots);
        let mut plan = Plan {
            nodes: order.iter().map(|&e| (e, Info::default())).collect(),
        };
        plan.count_uses(g, roots, &order);
        let mut total = plan.name_from(g, roots, &order, u64::MAX);
        for threshold in THRESHOLDS {
            if total <= budget {
                break;
            }
            total = plan.name_from(g, roots, &order, threshold);
        }
        for &root in roots {
            if let Some(info) = plan.nodes.get_mut(&root) {
                // A root that nothing else refers to is written where it stands.
                info.named &= info.uses > 1;
            }
        }
        plan
    }

    pub(crate) fn is_named(&self, e: Expr) -> bool {
        self.nodes.get(&e).is_some_and(|info| info.named)
    }

    fn count_uses(&mut self, g: &Graph, roots: &[Expr], order: &[Expr]) {
        for &root in roots {
            self.add_uses(root, 1);
        }
        for &e in order.iter().rev() {
            // A shared power, such as a denominator, is never named itself: its base is.
            let passed_on = if is_plain_power(g, e) {
                self.nodes[&e].uses
            } else {
                1
            };
            g.node(e)
                .for_each_child(|child| self.add_uses(child, passed_on));
        }
    }

    fn add_uses(&mut self, e: Expr, count: u64) {
        if let Some(info) = self.nodes.get_mut(&e) {
            info.uses = info.uses.saturating_add(count);
        }
    }

    /// Names what is repeated and has at least `threshold` nodes, and what is too deep. Returns the size of all that
    /// will be written.
    fn name_from(&mut self, g: &Graph, roots: &[Expr], order: &[Expr], threshold: u64) -> u64 {
        let mut total = 0u64;
        for &e in order {
            let (mut size, mut height) = (1u64, 0);
            g.node(e).for_each_child(|child| {
                let info = &self.nodes[&child];
                let (own_size, own_height) = info.written();
                size = size.saturating_add(own_size);
                height = height.max(own_height);
            });
            let (size, height, nameable) = match g.node(e) {
                Node::Number(_) | Node::Pi | Node::Algebraic(_) | Node::Symbol(_) => (1, 0, false),
                Node::Entry { .. } => (1, 0, false),
                // Written once, in the statement of the linear system.
                Node::Matrix { .. } | Node::Solve { .. } => {
                    total = total.saturating_add(size);
                    (0, 0, false)
                }
                _ => (size, height + 1, true),
            };
            let repeated = threshold <= size && self.nodes[&e].uses > 1 && !is_plain_power(g, e);
            let named = nameable && (repeated || height >= DEEPEST);
            if named {
                total = total.saturating_add(size);
            }
            if let Some(info) = self.nodes.get_mut(&e) {
                (info.size, info.height, info.named) = (size, height, named);
            }
        }
        roots.iter().fold(total, |sum, root| {
            sum.saturating_add(self.nodes[root].written().0)
        })
    }
}

impl Info {
    /// Size and height where it is used.
    fn written(&self) -> (u64, u32) {
        if self.named {
            (1, 0)
        } else {
            (self.size, self.height)
        }
    }
}

/// A power with a number for its exponent.
fn is_plain_power(g: &Graph, e: Expr) -> bool {
    matches!(g.node(e), Node::Power { exponent, .. } if g.as_number(*exponent).is_some())
}

impl Graph {
    /// The number of nodes of `e` written out as a tree, at most `u64::MAX`.
    ///
    /// May be exponential in the size of the graph; the cost of computing it is proportional to the graph. The
    /// matrix of a solve counts once for each of its uses.
    pub fn tree_size(&self, e: Expr) -> u64 {
        let order = self.reachable(&[e]);
        let mut sizes: FxHashMap<Expr, u64> = FxHashMap::default();
        let mut last = 0;
        for e in order {
            let mut size = 1u64;
            self.node(e)
                .for_each_child(|child| size = size.saturating_add(sizes[&child]));
            sizes.insert(e, size);
            last = size;
        }
        last
    }
}
