//! What is zero, and of which sign, in a space: under its assumptions, modulo what is known to vanish, on the unit sphere of normals.

use super::Space;
use chetaev_symbolic::verdict::{Counterexample, PointValue};
use chetaev_symbolic::zero::assumptions::{Assumption, Assumptions, Relation, SignSet};
use chetaev_symbolic::zero::{decide_zero, known_sign, Options, ZeroTest};
use chetaev_symbolic::{Expr, Rational, Verdict};

impl Space {
    /// Assumes a comparison of fields, data and parameters.
    pub fn assume(&self, own: Assumption) {
        let mut all = self.assumptions.borrow_mut();
        if !all.list().contains(&own) {
            all.assume(own.left, own.relation, own.right);
            self.vanishing.borrow_mut().clear();
        }
    }

    /// Assumes these comparisons, and nothing else.
    pub(crate) fn assume_only(&self, assumed: Assumptions) {
        *self.assumptions.borrow_mut() = assumed;
        self.vanishing.borrow_mut().clear();
    }

    /// What is assumed.
    pub fn assumptions(&self) -> Assumptions {
        self.assumptions.borrow().clone()
    }

    /// The signs that an expression can have where what is assumed holds, as far as its structure tells.
    pub fn sign(&self, e: Expr) -> SignSet {
        if self.is_slope_of_undone(e) {
            return SignSet::POSITIVE.or(SignSet::NEGATIVE);
        }
        known_sign(&self.graph, e, &self.assumptions.borrow())
    }

    /// Whether an expression is the second derivative of a function of one argument whose conjugate undoes its gradient: of
    /// `B'(A'(x)) = x` follows `B''(A'(x)) A''(x) = 1`.
    fn is_slope_of_undone(&self, e: Expr) -> bool {
        let symbol = self.graph.as_symbol(e);
        let own = symbol.and_then(|s| self.applications.borrow().get(&s).cloned());
        own.is_some_and(|own| {
            own.by.len() == 2 && own.arguments.len() == 1 && self.undoing(own.function).is_some()
        })
    }

    /// Whether an expression vanishes at random points of prime fields, so that a proof of it is worth its time.
    pub(crate) fn seems_to_vanish(&self, e: Expr) -> bool {
        let (residuals, assumptions) = ([e], Assumptions::new());
        let test = ZeroTest {
            options: Options {
                refute: false,
                exact: false,
                ..Options::default()
            },
            ..ZeroTest::everywhere(&residuals, &assumptions)
        };
        matches!(decide_zero(&self.graph, &test), Verdict::Proved(_))
    }

    /// Whether all expressions are proved to vanish identically in the symbols that occur.
    pub fn vanish(&self, residuals: &[Expr]) -> bool {
        residuals.iter().all(|&e| self.vanishes(e))
    }

    /// Whether an expression is proved to vanish identically. The same is asked on every piece of the boundary and for every solution that
    /// is tried, so that it is kept until more is assumed.
    pub(crate) fn vanishes(&self, e: Expr) -> bool {
        if self.graph.is_zero(e) {
            return true;
        }
        if let Some(&known) = self.vanishing.borrow().get(&e) {
            return known;
        }
        let found = matches!(self.vanishing(&[e], false), Verdict::Proved(_));
        self.vanishing.borrow_mut().insert(e, found);
        found
    }

    /// Whether all expressions vanish identically, with the evidence. The normal n is a unit vector.
    pub fn vanishing(&self, residuals: &[Expr], refute: bool) -> Verdict {
        self.vanishing_where(residuals, refute, &[])
    }

    /// The same where other expressions are not negative.
    pub fn vanishing_where(&self, residuals: &[Expr], refute: bool, known: &[Expr]) -> Verdict {
        let mut assumptions = self.assumptions();
        for &e in known {
            assumptions.assume(e, Relation::GreaterOrEqual, self.graph.zero());
        }
        self.vanishing_under(residuals, refute, &assumptions)
    }

    /// The same under these assumptions alone. What holds for all functions is proved so, else by their formulas; values are drawn for
    /// functions without a formula only, which may be any.
    pub fn vanishing_under(
        &self,
        residuals: &[Expr],
        refute: bool,
        assumed: &Assumptions,
    ) -> Verdict {
        let explicit: Vec<Expr> = residuals.iter().map(|&e| self.explicit(e)).collect();
        if explicit == residuals {
            return self.vanishing_by_formulas(residuals, refute, assumed);
        }
        match self.vanishing_as_written(residuals, false, assumed) {
            Verdict::Proved(proof) => Verdict::Proved(proof),
            _ => self.vanishing_by_formulas(&explicit, refute, assumed),
        }
    }

    fn vanishing_by_formulas(
        &self,
        residuals: &[Expr],
        refute: bool,
        assumed: &Assumptions,
    ) -> Verdict {
        let mut unsettled = residuals.iter().filter_map(|&e| self.unsettled(e));
        let unsettled = unsettled.next().filter(|_| refute);
        let found = self.vanishing_as_written(residuals, refute && unsettled.is_none(), assumed);
        match (found, unsettled) {
            (Verdict::Proved(proof), _) => Verdict::Proved(proof),
            (_, Some(function)) => Verdict::undecided(not_sought(&function)),
            (found, None) => found,
        }
    }

    /// The same with every application of a function as a symbol of its own.
    fn vanishing_as_written(
        &self,
        residuals: &[Expr],
        refute: bool,
        assumed: &Assumptions,
    ) -> Verdict {
        let mut assumptions = Assumptions::new();
        for own in assumed.list() {
            let [left, right] = [own.left, own.right].map(|e| self.on_sphere(self.explicit(e)));
            assumptions.assume(left, own.relation, right);
        }
        let test = |residuals: &[Expr], refute: bool| {
            let test = ZeroTest {
                options: Options {
                    refute,
                    ..Options::default()
                },
                ..ZeroTest::everywhere(residuals, &assumptions)
            };
            decide_zero(&self.graph, &test)
        };
        let on_sphere: Vec<Expr> = residuals.iter().map(|&e| self.on_sphere(e)).collect();
        if on_sphere == residuals {
            return test(residuals, refute);
        }
        match test(residuals, false) {
            Verdict::Proved(proof) => Verdict::Proved(proof),
            _ => match test(&on_sphere, refute) {
                Verdict::Refuted(found) => Verdict::Refuted(self.with_normal(found)),
                other => other,
            },
        }
    }

    /// A counterexample with the components of the normal in the place of the coordinates on the sphere.
    fn with_normal(&self, mut found: Counterexample) -> Counterexample {
        let names: Vec<String> = (2..=self.dimensions()).map(on_chart).collect();
        let (chart, mut point): (Vec<PointValue>, Vec<PointValue>) = found
            .point
            .drain(..)
            .partition(|own| names.contains(&own.name));
        let value = |name: &String| {
            let own = chart.iter().find(|own| own.name == *name);
            own.and_then(|own| own.exact.clone())
                .unwrap_or(Rational::ZERO)
        };
        let at: Vec<Rational> = names.iter().map(value).collect();
        let one = Rational::ONE;
        let square = at.iter().fold(Rational::ZERO, |sum, a| sum + a * a);
        let below = &one + &square;
        let first = (&one - &square) / &below;
        let others = at.iter().map(|a| Rational::from(2) * a / &below);
        let normal = std::iter::once(first).chain(others);
        let normal = self.normal.iter().zip(normal);
        point.extend(normal.map(|(&symbol, value)| PointValue {
            name: self.graph.symbol_text(symbol),
            exact: Some(value),
            enclosure: None,
        }));
        found.point = point;
        found
    }

    /// The normal as a point of the unit sphere, by stereographic projection; in one dimension it is forward.
    pub(crate) fn on_sphere(&self, e: Expr) -> Expr {
        let g = &self.graph;
        let d = self.dimensions();
        let normals = &self.normal;
        let occurring = self.symbols_in(&[e]);
        if normals.iter().all(|n| !occurring.contains(n)) {
            return e;
        }
        let at: Vec<Expr> = (2..=d).map(|i| g.symbol(&on_chart(i), 0)).collect();
        let square: Vec<Expr> = at.iter().map(|&a| g.powi(a, 2)).collect();
        let square = g.add(&square);
        let below = g.powi(g.add(&[g.one(), square]), -1);
        self.replace(e, &|symbol| {
            let place = normals.iter().position(|&n| n == symbol)?;
            Some(match place {
                0 => g.mul(&[g.sub(g.one(), square), below]),
                i => g.mul(&[g.integer(2), at[i - 1], below]),
            })
        })
    }
}

/// The name of a coordinate on the sphere of normals, from the second on.
fn on_chart(i: usize) -> String {
    format!("normal_{i}")
}

/// Why no counterexample is sought where a function occurs whose values are neither free nor given by a formula.
pub(crate) fn not_sought(function: &str) -> String {
    format!(
        "the values of {function} are known through its conjugate or its gradient alone, so that no counterexample was sought"
    )
}
