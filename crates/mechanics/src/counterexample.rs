//! Counterexamples are checked before they are stated, by substitution into the system as it is written.
//!
//! What is found by a chart, an elimination or a split may be wrong where these are. Here a point is nothing but names with numbers
//! between bounds; how it was found is not known. A violation is said only where the bounds prove it.

use crate::system::{Relation, System};
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::verdict::{Counterexample, PointValue};
use chetaev_symbolic::{Expr, Symbol};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Bits of the evaluation.
const BITS: usize = 256;

/// What a point violates, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Violation {
    /// A constraint does not vanish there.
    Constraint(String),
    /// An assumption of the model does not hold there.
    Assumption(String),
    /// A quantity named by the program is not what it is defined to be.
    Definition(String),
    /// Each quantity that is said not to vanish does.
    Residual,
}

impl std::fmt::Display for Violation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Violation::Constraint(name) => write!(f, "the constraint `{name}` does not hold"),
            Violation::Assumption(text) => write!(f, "the assumption {text} does not hold"),
            Violation::Definition(name) => write!(f, "{name} is not what it is defined to be"),
            Violation::Residual => write!(f, "the quantity vanishes"),
        }
    }
}

/// Whether a counterexample is one: some of the `residuals` does not vanish there, the assumptions and the definitions of named
/// quantities hold, and, where it speaks of states that satisfy them, the constraints on the velocities.
///
/// # Errors
/// The first violation.
pub fn check(
    system: &System,
    residuals: &[Expr],
    found: &Counterexample,
    is_admissible: bool,
) -> Result<(), Violation> {
    let point = Point::new(system, found);
    if !residuals.is_empty() && residuals.iter().all(|&e| point.is_zero(e)) {
        return Err(Violation::Residual);
    }
    for assumption in &system.assumptions {
        let difference = system.graph.sub(assumption.right, assumption.left);
        let sign = point.sign(difference);
        let is_violated = match assumption.relation {
            Relation::Less => matches!(sign, Some(Ordering::Less | Ordering::Equal)),
            Relation::LessOrEqual => sign == Some(Ordering::Less),
            Relation::NotEqual => sign == Some(Ordering::Equal),
        };
        if is_violated {
            return Err(Violation::Assumption(assumption.text.clone()));
        }
    }
    for (symbol, definition) in system.definitions_of_names() {
        if point.differs_from_zero(definition) {
            return Err(Violation::Definition(system.graph.symbol_text(symbol)));
        }
    }
    let constraints = system.constraints.iter().filter(|_| is_admissible);
    for constraint in constraints {
        if point.differs_from_zero(constraint.f) {
            return Err(Violation::Constraint(constraint.name.clone()));
        }
    }
    Ok(())
}

/// Names with numbers between bounds.
struct Point<'a> {
    system: &'a System,
    values: BTreeMap<&'a str, Ball>,
    precision: Precision,
}

impl<'a> Point<'a> {
    fn new(system: &'a System, found: &'a Counterexample) -> Point<'a> {
        let precision = Precision::new(BITS);
        let values = found.point.iter();
        let values = values
            .filter_map(|value| Some((value.name.as_str(), between(value, &precision)?)))
            .collect();
        Point {
            system,
            values,
            precision,
        }
    }

    /// `None` where a symbol has no value, or the expression none.
    fn enclose(&self, e: Expr) -> Option<Ball> {
        let g = &self.system.graph;
        let value = |s: Symbol| self.values.get(g.symbol_text(s).as_str()).cloned();
        g.enclose(&[e], &self.precision, &value).ok()?.pop()
    }

    fn sign(&self, e: Expr) -> Option<Ordering> {
        self.enclose(e)?.sign()
    }

    fn differs_from_zero(&self, e: Expr) -> bool {
        self.enclose(e).is_some_and(|value| value.excludes_zero())
    }

    fn is_zero(&self, e: Expr) -> bool {
        self.sign(e) == Some(Ordering::Equal)
    }
}

/// The numbers that a value may have.
fn between(value: &PointValue, precision: &Precision) -> Option<Ball> {
    if let Some(exact) = &value.exact {
        return Some(precision.rational(exact));
    }
    let (lower, upper) = value.enclosure.as_ref()?;
    let lower = Ball::from_f64(lower.parse::<f64>().ok()?.next_down())?;
    let upper = Ball::from_f64(upper.parse::<f64>().ok()?.next_up())?;
    precision.union(&lower, &upper).ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a panic is how a test fails

    use super::*;
    use crate::system::SystemParts;
    use chetaev_symbolic::{Graph, Rational};
    use std::sync::Arc;

    /// z' = y x', the blade of a plane curve.
    fn blade() -> System {
        let g = Arc::new(Graph::new());
        let v = |name: &str| g.symbol(name, 1);
        let f = g.sub(v("z"), g.mul(&[g.symbol("y", 0), v("x")]));
        let squares: Vec<Expr> = ["x", "y", "z"]
            .iter()
            .map(|name| g.powi(v(name), 2))
            .collect();
        let parts = SystemParts {
            name: "blade".into(),
            coordinates: ["x", "y", "z"].map(String::from).to_vec(),
            lagrangian: Some(g.add(&squares)),
            constraints: vec![("c".into(), f)],
            ..SystemParts::default()
        };
        System::new(g, parts).unwrap()
    }

    fn point(values: &[(&str, i64)]) -> Counterexample {
        let value = |&(name, n): &(&str, i64)| PointValue {
            name: name.into(),
            exact: Some(Rational::from(n)),
            enclosure: None,
        };
        Counterexample {
            point: values.iter().map(value).collect(),
            quantity: "q".into(),
            residual: ("1".into(), "1".into()),
            detail: String::new(),
        }
    }

    #[test]
    fn a_point_off_the_constraint_is_no_counterexample_for_motions() {
        let system = blade();
        let on = point(&[("y", 2), ("x'", 3), ("z'", 6)]);
        let off = point(&[("y", 2), ("x'", 3), ("z'", 5)]);
        assert_eq!(check(&system, &[], &on, true), Ok(()));
        assert_eq!(check(&system, &[], &off, false), Ok(()));
        let violation = Violation::Constraint("c".into());
        assert_eq!(check(&system, &[], &off, true), Err(violation));
    }

    #[test]
    fn a_residual_that_vanishes_and_a_name_that_is_not_kept_are_seen() {
        let system = blade();
        let g = &system.graph;
        let speed = system.named("u_x", g.div(g.symbol("x", 1), g.symbol("y", 0)));
        let name = g.symbol_text(speed);
        let right = point(&[("y", 2), ("x'", 6), (&name, 3)]);
        let wrong = point(&[("y", 2), ("x'", 6), (&name, 6)]);
        assert_eq!(check(&system, &[g.symbol("y", 0)], &right, false), Ok(()));
        let zero = g.sub(g.symbol("x", 1), g.integer(6));
        assert_eq!(
            check(&system, &[zero], &right, false),
            Err(Violation::Residual)
        );
        let violation = Violation::Definition(name.clone());
        assert_eq!(check(&system, &[], &wrong, false), Err(violation));
    }

    #[test]
    fn a_name_stands_for_one_quantity() {
        let system = blade();
        let g = &system.graph;
        let (a, b) = (g.symbol("x", 1), g.symbol("y", 1));
        let first = system.named("u_x", a);
        assert_eq!(system.named("u_x", a), first);
        assert_ne!(system.clone().named("u_x", b), first);
        assert_eq!(
            system.total_derivative(g.symbol_expr(first)),
            g.symbol("x", 2)
        );
    }
}
