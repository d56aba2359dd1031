//! Random systems: a family and a seed make one system, always the same.

mod constraints;
mod draw;
mod lagrangian;
mod text;

use chetaev_mechanics::system::{Assumption, Relation};
use chetaev_mechanics::{System, SystemError, SystemParts};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{Expr, Graph};
use constraints::Form;
use draw::{Draw, Kind};
use std::sync::Arc;

use crate::arguments::FAMILY_NAMES;

/// A kind of random systems. All have a positive definite Hessian, forces now and then, and n = 2..6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Polynomial L, constraints linear in the velocities with polynomial coefficients.
    PolynomialLinear,
    /// Trigonometric L and coefficients, constraints linear in the velocities.
    TrigonometricLinear,
    /// Polynomial L, a constraint nonlinear in the velocities.
    PolynomialNonlinear,
    /// Trigonometric L, a constraint nonlinear in the velocities.
    TrigonometricNonlinear,
    /// L not quadratic in the velocities; linear or nonlinear constraints.
    Nonquadratic,
    /// L, forces and constraints that depend on the time; constraints affine in the velocities.
    RheonomicAffine,
}

impl Family {
    /// All families, in the order of [`FAMILY_NAMES`].
    pub const ALL: [Family; 6] = [
        Family::PolynomialLinear,
        Family::TrigonometricLinear,
        Family::PolynomialNonlinear,
        Family::TrigonometricNonlinear,
        Family::Nonquadratic,
        Family::RheonomicAffine,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        FAMILY_NAMES[self as usize]
    }

    /// The family called `name`.
    pub fn named(name: &str) -> Option<Family> {
        Family::ALL.into_iter().find(|family| family.name() == name)
    }

    fn is_nonlinear(self) -> bool {
        matches!(
            self,
            Family::PolynomialNonlinear | Family::TrigonometricNonlinear
        )
    }
}

/// A system with where it came from.
#[derive(Debug)]
pub struct RandomSystem {
    /// The family.
    pub family: Family,
    /// The seed.
    pub seed: u64,
    /// The system.
    pub system: System,
    /// The same system as the text of a model file.
    pub text: String,
}

/// The system with this seed.
///
/// # Errors
/// [`SystemError`]; then the generator has made something that is no system.
pub fn generate(family: Family, seed: u64) -> Result<RandomSystem, SystemError> {
    let graph = Arc::new(Graph::new());
    let parts = parts(&graph, family, seed);
    let text = text::model(&graph, &parts);
    let system = System::new(graph, parts)?;
    Ok(RandomSystem {
        family,
        seed,
        system,
        text,
    })
}

fn parts(g: &Graph, family: Family, seed: u64) -> SystemParts {
    let mut random = Random::stream(seed, family as u64 + 1);
    // Small systems are as good as large ones at finding a slip, and faster.
    let n = [2, 2, 3, 3, 3, 4, 4, 5, 6][random.below(9) as usize];
    let kind = match family {
        Family::PolynomialLinear | Family::PolynomialNonlinear => Kind::Polynomial,
        Family::TrigonometricLinear | Family::TrigonometricNonlinear => Kind::Trigonometric,
        Family::Nonquadratic | Family::RheonomicAffine if random.below(2) == 0 => Kind::Polynomial,
        Family::Nonquadratic | Family::RheonomicAffine => Kind::Trigonometric,
    };
    let mut draw = Draw {
        g,
        random,
        kind,
        names: (1..=n).map(|i| format!("q_{i}")).collect(),
    };
    let masses: Vec<(String, Expr)> = (1..=draw.index(3))
        .map(|i| format!("m_{i}"))
        .map(|name| (name.clone(), g.symbol(&name, 0)))
        .collect();
    let lagrangian = whole_lagrangian(&mut draw, family, &masses);
    let driven = family == Family::RheonomicAffine;
    let forces = lagrangian::forces(&mut draw, driven);
    let constraints = all_constraints(&mut draw, family);
    SystemParts {
        name: format!("{} {seed}", family.name()),
        coordinates: draw.names.clone(),
        lagrangian: Some(lagrangian),
        forces,
        constraints: constraints
            .into_iter()
            .enumerate()
            .map(|(l, f)| (format!("c_{}", l + 1), f))
            .collect(),
        assumptions: masses.iter().map(|m| positive(g, m)).collect(),
        parameters: masses
            .into_iter()
            .map(|(name, _)| {
                let value = draw.positive();
                (name, Some(g.number(value)))
            })
            .collect(),
        ..SystemParts::default()
    }
}

fn whole_lagrangian(draw: &mut Draw<'_>, family: Family, masses: &[(String, Expr)]) -> Expr {
    let g = draw.g;
    let masses: Vec<Expr> = masses.iter().map(|(_, m)| *m).collect();
    let mut parts = vec![lagrangian::kinetic(draw, &masses)];
    parts.push(g.neg(lagrangian::potential(draw)));
    if draw.one_in(3) {
        parts.push(lagrangian::gyroscopic(draw));
    }
    if family == Family::Nonquadratic {
        parts.push(lagrangian::convex(draw));
    }
    if family == Family::RheonomicAffine {
        parts.push(lagrangian::moving(draw));
    }
    g.add(&parts)
}

fn all_constraints(draw: &mut Draw<'_>, family: Family) -> Vec<Expr> {
    if family.is_nonlinear() || (family == Family::Nonquadratic && draw.one_in(3)) {
        return constraints::nonlinear(draw);
    }
    let r = 1 + draw.index((draw.n() - 1).min(3));
    let form = match family {
        Family::RheonomicAffine => Form::Rheonomic,
        _ => Form::Linear,
    };
    constraints::linear(draw, r, form)
}

fn positive(g: &Graph, (name, value): &(String, Expr)) -> Assumption {
    Assumption {
        left: g.zero(),
        relation: Relation::Less,
        right: *value,
        text: format!("{name} > 0"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chetaev_mechanics::sample::admissible_point;
    use chetaev_mechanics::MotionTerms;

    #[test]
    fn a_seed_makes_the_same_system_again() {
        for family in Family::ALL {
            assert_eq!(Family::named(family.name()), Some(family));
            let text = |seed| generate(family, seed).unwrap().text;
            assert_eq!(text(3), text(3));
            assert_ne!(text(3), text(4));
        }
    }

    #[test]
    fn mass_matrices_are_positive_definite_at_sampled_states() {
        for family in Family::ALL {
            for seed in 0..20 {
                let random = generate(family, seed).unwrap();
                let (system, g) = (&random.system, &random.system.graph);
                let terms = MotionTerms::new(system);
                let point = admissible_point(system, &terms, 1)
                    .unwrap_or_else(|| panic!("no state of {}", random.text));
                let value = |s| point.get(&s).copied();
                let w = g.evaluate_f64(&terms.mass_matrix.concat(), &value).unwrap();
                assert!(is_positive_definite(w, system.n()), "{}", random.text);
            }
        }
    }

    /// Cholesky's factorization meets only positive pivots.
    fn is_positive_definite(mut w: Vec<f64>, n: usize) -> bool {
        for k in 0..n {
            if w[k * n + k] <= 0.0 {
                return false;
            }
            for i in k + 1..n {
                let factor = w[i * n + k] / w[k * n + k];
                for j in k..n {
                    w[i * n + j] -= factor * w[k * n + j];
                }
            }
        }
        true
    }
}
