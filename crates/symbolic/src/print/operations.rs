//! What is computed on the page: the operations of a document as it is printed, names that it shares counted once.

use super::document::{Definition, Document, Statement};
use super::formula::{Formula, Term};

/// How many operations of each kind are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// `+` and `−`, signs in front of a term included.
    pub sums: usize,
    /// Products of two factors.
    pub products: usize,
    /// Fractions, rational numbers among them.
    pub quotients: usize,
    /// Powers.
    pub powers: usize,
    /// Roots.
    pub roots: usize,
    /// Values of functions.
    pub functions: usize,
}

impl Operations {
    /// All together.
    pub fn total(&self) -> usize {
        self.sums + self.products + self.quotients + self.powers + self.roots + self.functions
    }

    fn count(&mut self, formula: &Formula) {
        let mut open = vec![formula];
        while let Some(formula) = open.pop() {
            match formula {
                Formula::Integer(_)
                | Formula::Pi
                | Formula::Algebraic(_)
                | Formula::Symbol { .. }
                | Formula::Reference(_) => {}
                Formula::Sum(terms) => {
                    self.sums += terms.len().saturating_sub(1);
                    self.sums += usize::from(terms.first().is_some_and(|term| term.negative));
                    open.extend(terms.iter().map(|Term { value, .. }| value));
                }
                Formula::Product(factors) => {
                    self.products += factors.len().saturating_sub(1);
                    open.extend(factors);
                }
                Formula::Fraction(top, bottom) => {
                    self.quotients += 1;
                    open.extend([&**top, &**bottom]);
                }
                Formula::Negative(inner) => {
                    self.sums += 1;
                    open.push(inner);
                }
                Formula::Power(base, exponent) => {
                    self.powers += 1;
                    open.extend([&**base, &**exponent]);
                }
                Formula::Root { radicand, .. } => {
                    self.roots += 1;
                    open.push(radicand);
                }
                Formula::Apply { arguments, .. } => {
                    self.functions += 1;
                    open.extend(arguments);
                }
                Formula::Matrix { entries, .. } => open.extend(entries),
            }
        }
    }
}

impl std::ops::AddAssign for Operations {
    fn add_assign(&mut self, other: Operations) {
        self.sums += other.sums;
        self.products += other.products;
        self.quotients += other.quotients;
        self.powers += other.powers;
        self.roots += other.roots;
        self.functions += other.functions;
    }
}

impl Document {
    /// The operations of all statements and of the definitions that they use, each definition once.
    pub fn operations(&self) -> Operations {
        let mut found = Operations::default();
        for statement in &self.statements {
            match statement {
                Statement::Expression(e) => found.count(e),
                Statement::Equation(left, right) => {
                    found.count(left);
                    found.count(right);
                }
            }
        }
        for definition in &self.definitions {
            match definition {
                Definition::Shared { value, .. } => found.count(value),
                Definition::System(system) => {
                    for (left, right) in system.rows() {
                        found.count(&left);
                        found.count(right);
                    }
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use crate::print::{Document, Options};
    use crate::Graph;

    /// `m u' = sqrt(1 + w) sin(w) - 1/2 m a w^2`, as it is printed: five products, a quotient, a power, a root, a function, a sum and a
    /// difference.
    #[test]
    fn operations_are_counted_as_they_are_printed() {
        let g = Graph::new();
        let [m, a, w, u] = [("m", 0), ("a", 0), ("w", 0), ("u", 1)].map(|(n, o)| g.symbol(n, o));
        let half = g.div(g.one(), g.integer(2));
        let first = g.neg(g.mul(&[half, m, a, g.powi(w, 2)]));
        let second = g.mul(&[g.sqrt(g.add(&[g.one(), w])), g.sin(w)]);
        let pair = (g.mul(&[m, u]), g.add(&[first, second]));
        let found = Document::equations(&g, &[pair], &Options::default()).operations();
        let kinds = (found.quotients, found.powers, found.roots, found.functions);
        assert_eq!(kinds, (1, 1, 1, 1));
        // m u', 1/2 m a w^2 and the root times the sine; the difference, and the sum below the root.
        let text = g.text(pair.1);
        assert!(!text.starts_with('-'), "{text}");
        assert_eq!((found.products, found.sums), (1 + 3 + 1, 1 + 1));
        assert_eq!(found.total(), 11);
    }
}
