//! The order of factors and terms on the page, which depends on names and structure alone, never on the history of
//! the graph.
//!
//! Factors: numbers, parameters, coordinates, sums without derivatives, velocities, accelerations, functions, sums
//! with derivatives. Terms: higher derivatives first, then higher degrees in them; what remains is ordered as a
//! person writes 1 + a², x² + 2x + 1, J + m a².

use super::share::Plan;
use super::Options;
use crate::graph::Graph;
use crate::node::{Expr, Function, Node, Symbol};
use crate::rational;
use crate::syntax::names::greek_letter;
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;

/// Place of a name among all names of the document.
type Rank = u32;

const NO_RANK: Rank = u32::MAX;

/// Where a factor stands in a product.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct FactorKey {
    class: Class,
    order: u32,
    rank: Rank,
    is_composite: bool,
    function: Option<Function>,
    digest: u128,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    Radical,
    Pi,
    Parameter,
    Named,
    Coordinate,
    PlainSum,
    Derivative,
    Irrational,
    Function,
    Sum,
}

/// A symbol, function or group with its degree, in the order in which terms are compared.
type Seen = (Rank, Reverse<i64>);

/// Where a term stands in a sum.
#[derive(PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct TermKey {
    top_order: Reverse<u32>,
    top_degree: Reverse<i64>,
    derivatives: Vec<(Reverse<u32>, Rank, Reverse<i64>)>,
    coordinate_degree: Reverse<i64>,
    coordinates: Vec<Seen>,
    functions: i64,
    parameter_degree: i64,
    parameters: Vec<Seen>,
    names_in_functions: Vec<(Rank, Option<Function>)>,
    digest: u128,
}

impl TermKey {
    /// Whether two terms are of one kind, so that their order may be exchanged for the sake of a sign.
    pub(crate) fn is_exchangeable_with(&self, other: &TermKey) -> bool {
        self.top_order.0 == 0
            || (self.top_order == other.top_order && self.top_degree == other.top_degree)
    }
}

/// How an expression moves.
#[derive(Clone, Copy)]
struct Lead {
    /// 0 for parameters, 1 where coordinates or the time occur, k + 1 where k-th derivatives occur.
    grade: u32,
    /// Degree in the symbols of this grade, functions counting one.
    degree: i64,
    /// First of the symbols of this grade.
    rank: Rank,
    /// Whether it is a function of what moves, and no polynomial in it.
    is_function: bool,
}

const CONSTANT: Lead = Lead {
    grade: 0,
    degree: 0,
    rank: NO_RANK,
    is_function: false,
};

/// The order for one document.
pub(crate) struct Order<'a> {
    g: &'a Graph,
    ranks: FxHashMap<Symbol, Rank>,
    leads: FxHashMap<Expr, Lead>,
}

impl<'a> Order<'a> {
    pub(crate) fn new(g: &'a Graph, roots: &[Expr], options: &Options) -> Order<'a> {
        let nodes = g.reachable(roots);
        let symbols = g.symbols_in(roots);
        let mut names: Vec<&str> = symbols.iter().map(|&s| g.symbol_name(s)).collect();
        names.dedup();
        let mut moving: FxHashSet<&str> = options.coordinates.iter().map(String::as_str).collect();
        moving.insert("t");
        let differentiated = symbols.iter().filter(|&&s| g.symbol_order(s) > 0);
        moving.extend(differentiated.map(|&s| g.symbol_name(s)));
        names.sort_by_cached_key(|name| name_key(name, options));
        let mut rank_of_name = FxHashMap::default();
        for (rank, name) in names.into_iter().enumerate() {
            rank_of_name.insert(name, rank as Rank);
        }
        let mut order = Order {
            g,
            ranks: FxHashMap::default(),
            leads: FxHashMap::default(),
        };
        for &symbol in &symbols {
            order
                .ranks
                .insert(symbol, rank_of_name[g.symbol_name(symbol)]);
        }
        for e in nodes {
            let lead = match g.node(e) {
                Node::Symbol(s) => Lead {
                    grade: match g.symbol_order(*s) {
                        0 => u32::from(moving.contains(g.symbol_name(*s))),
                        k => k.saturating_add(1),
                    },
                    degree: 1,
                    rank: order.rank(*s),
                    is_function: false,
                },
                _ => order.lead_of_node(e),
            };
            order.leads.insert(e, lead);
        }
        order
    }

    fn lead_of_node(&self, e: Expr) -> Lead {
        let mut lead = CONSTANT;
        let adds_degrees = matches!(self.g.node(e), Node::Product { .. });
        self.g.node(e).for_each_child(|child| {
            let own = self.lead(child);
            if own.grade > lead.grade {
                lead = own;
            } else if own.grade == lead.grade {
                lead.rank = lead.rank.min(own.rank);
                lead.is_function |= own.is_function;
                lead.degree = match adds_degrees {
                    true => lead.degree.saturating_add(own.degree),
                    false => lead.degree.max(own.degree),
                };
            }
        });
        match self.g.node(e) {
            Node::Power { exponent, .. } => {
                let n = self.g.as_number(*exponent).and_then(rational::to_i64);
                lead.degree = n.map_or(1, |n| lead.degree.saturating_mul(n));
            }
            Node::Apply { .. } => {
                lead.degree = 1;
                lead.is_function = true;
            }
            _ => {}
        }
        lead
    }

    fn lead(&self, e: Expr) -> Lead {
        self.leads.get(&e).copied().unwrap_or(CONSTANT)
    }

    fn grade(&self, e: Expr) -> u32 {
        self.lead(e).grade
    }

    fn rank(&self, symbol: Symbol) -> Rank {
        self.ranks.get(&symbol).copied().unwrap_or(NO_RANK)
    }

    /// Base and degree of a factor; no degree where the exponent is not an integer.
    fn base(&self, factor: Expr, plan: &Plan) -> (Expr, Option<i64>) {
        if plan.is_named(factor) {
            return (factor, Some(1));
        }
        let (base, exponent) = self.g.base_exponent(factor);
        let degree = self.g.as_number(exponent).and_then(rational::to_i64);
        (base, degree)
    }

    /// Rank of the symbol that a function is applied to.
    fn argument_rank(&self, arguments: &[Expr]) -> Rank {
        match arguments {
            [x] => self.g.as_symbol(*x).map_or(NO_RANK, |s| self.rank(s)),
            _ => NO_RANK,
        }
    }

    pub(crate) fn factor_key(&self, factor: Expr, plan: &Plan) -> FactorKey {
        let (base, degree) = self.base(factor, plan);
        let grade = self.grade(base);
        let mut key = FactorKey {
            class: Class::Irrational,
            order: 0,
            rank: NO_RANK,
            is_composite: false,
            function: None,
            digest: self.g.digest(factor),
        };
        key.class = match self.g.node(base) {
            _ if plan.is_named(base) && grade <= 1 => Class::Named,
            _ if plan.is_named(base) => Class::Sum,
            Node::Number(_) if self.grade(factor) == 0 => Class::Radical,
            Node::Pi | Node::Algebraic(_) if degree.is_some() => Class::Pi,
            _ if degree.is_none() => Class::Irrational,
            Node::Symbol(s) => {
                key.rank = self.rank(*s);
                key.order = self.g.symbol_order(*s);
                match grade {
                    0 => Class::Parameter,
                    1 => Class::Coordinate,
                    _ => Class::Derivative,
                }
            }
            Node::Entry { index, .. } => {
                key.order = *index;
                Class::Named
            }
            Node::Apply {
                function,
                arguments,
            } => {
                key.rank = self.argument_rank(arguments);
                key.function = Some(*function);
                Class::Function
            }
            // A sum of parameters stands where its first parameter would.
            Node::Sum { .. } if grade == 0 => {
                key.rank = self.lead(base).rank;
                key.is_composite = true;
                Class::Parameter
            }
            _ if grade <= 1 => Class::PlainSum,
            _ => Class::Sum,
        };
        key
    }

    pub(crate) fn term_key(&self, term: Expr, plan: &Plan) -> TermKey {
        let mut key = TermKey {
            digest: self.g.digest(term),
            ..TermKey::default()
        };
        match self.g.node(term) {
            Node::Product { factors, .. } if !plan.is_named(term) => {
                factors.iter().for_each(|&f| self.see(f, plan, &mut key));
            }
            _ => self.see(term, plan, &mut key),
        }
        key.derivatives.sort_unstable();
        key.coordinates.sort_unstable();
        key.parameters.sort_unstable();
        key.names_in_functions.sort_unstable();
        if let Some((top, _, _)) = key.derivatives.first() {
            key.top_order = *top;
            let of_top_order = key.derivatives.iter().filter(|seen| seen.0 == *top);
            let degree = of_top_order.fold(0i64, |sum, seen| sum.saturating_add(seen.2 .0));
            key.top_degree = Reverse(degree);
        }
        key
    }

    fn see(&self, factor: Expr, plan: &Plan, key: &mut TermKey) {
        let (base, degree) = self.base(factor, plan);
        let count = degree.unwrap_or(1);
        let lead = self.lead(base);
        let total = lead.degree.saturating_mul(count);
        match self.g.node(base) {
            _ if lead.grade >= 2 && count > 0 => {
                let order = Reverse(lead.grade - 1);
                key.derivatives.push((order, lead.rank, Reverse(total)));
            }
            Node::Apply {
                function,
                arguments,
            } => {
                key.functions = key.functions.saturating_add(count.saturating_abs());
                key.names_in_functions
                    .push((self.argument_rank(arguments), Some(*function)));
            }
            _ if degree.is_none() || lead.is_function => {
                key.functions = key.functions.saturating_add(1);
                key.names_in_functions.push((lead.rank, None));
            }
            _ if lead.grade == 0 => {
                key.parameter_degree = key.parameter_degree.saturating_add(total.saturating_abs());
                key.parameters.push((lead.rank, Reverse(total)));
            }
            _ => {
                key.coordinate_degree.0 = key.coordinate_degree.0.saturating_add(total);
                key.coordinates.push((lead.rank, Reverse(total)));
            }
        }
    }
}

/// Numbers inside names compare as numbers: q_2 before q_10.
type NaturalKey = Vec<(String, u64)>;

/// The names given by the caller come first, in the caller's order; then masses and moments of inertia, then Latin,
/// then Greek letters.
fn name_key(name: &str, options: &Options) -> (usize, u8, NaturalKey, String) {
    let listed = options.parameters.iter().chain(&options.coordinates);
    let place = listed.into_iter().position(|own| own == name);
    let head: &str = name.split('_').next().unwrap_or(name);
    let head = head.trim_end_matches(|c: char| c.is_ascii_digit());
    let class = match head {
        "m" | "M" => 0,
        "I" | "J" => 1,
        "g" => 2,
        _ if greek_letter(head).is_some() => 4,
        _ => 3,
    };
    (
        place.unwrap_or(usize::MAX),
        class,
        natural(&name.to_lowercase()),
        name.to_string(),
    )
}

fn natural(name: &str) -> NaturalKey {
    let mut key = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let letters = rest
            .find(|c: char| c.is_ascii_digit())
            .unwrap_or(rest.len());
        let (word, after) = rest.split_at(letters);
        let digits = after
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(after.len());
        let number = after[..digits].parse().unwrap_or(0);
        key.push((word.to_string(), number));
        rest = &after[digits..];
    }
    key
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_compare_as_numbers() {
        assert!(natural("q_2") < natural("q_10"));
        assert!(natural("a") < natural("b"));
        assert!(natural("q") < natural("q_1"));
    }
}
