//! Random systems: a family and a seed make one system, always the same.

mod change;
mod constraints;
mod draw;
mod frames;
mod lagrangian;
mod masses;
mod particles;
mod singular;
mod sparse;
mod symmetric;
mod text;

pub(crate) use change::change;
use chetaev_mechanics::system::{Assumption, Relation};
use chetaev_mechanics::{System, SystemError, SystemParts};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{Expr, Graph};
use constraints::Form;
use draw::{Draw, Kind};
use std::sync::Arc;

use crate::arguments::FAMILY_NAMES;

/// A kind of random systems. All but the singular ones have a positive definite Hessian; forces occur now and then. n = 2..6 in
/// the first six families, n = 2..4 in the others.
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
    /// A velocity given by a root of a quadratic form of others.
    Radicals,
    /// Quasi-velocities by n forms, by k forms or by the fields of a frame that may move.
    MovingFrame,
    /// The Hessian is singular everywhere; mostly the constraints make up for it.
    Singular,
    /// T is that of particles; Cartesian coordinates or others.
    Particles,
    /// Neither L nor the constraints contain the coordinates of the dependent velocities.
    Chaplygin,
    /// Particles whose masses are functions of t and q, or have laws of their own, with every mode of thrust.
    VariableMass,
    /// The same with masses that contain velocities.
    VelocityMass,
    /// Constraints of second order, linear in the accelerations.
    SecondOrderLinear,
    /// A constraint of second order, nonlinear in the accelerations.
    SecondOrderNonlinear,
    /// Constraints of third order, linear in the highest derivatives.
    ThirdOrderLinear,
    /// A constraint of third order, nonlinear in the highest derivatives.
    ThirdOrderNonlinear,
    /// Constraints that are derivatives of functions of q and t, mixed and multiplied by functions; no forces.
    Integrable,
    /// A first integral is known, and stated: a momentum, a moment of momentum or a part of the energy, after a change of
    /// coordinates.
    Symmetric,
    /// Few terms: some motions make the action stationary, and others do not.
    Sparse,
}

/// Seeds below it make larger systems too.
const LARGER: u64 = 50;

impl Family {
    /// All families, in the order of [`FAMILY_NAMES`].
    pub const ALL: [Family; 20] = [
        Family::PolynomialLinear,
        Family::TrigonometricLinear,
        Family::PolynomialNonlinear,
        Family::TrigonometricNonlinear,
        Family::Nonquadratic,
        Family::RheonomicAffine,
        Family::Radicals,
        Family::MovingFrame,
        Family::Singular,
        Family::Particles,
        Family::Chaplygin,
        Family::VariableMass,
        Family::VelocityMass,
        Family::SecondOrderLinear,
        Family::SecondOrderNonlinear,
        Family::ThirdOrderLinear,
        Family::ThirdOrderNonlinear,
        Family::Integrable,
        Family::Symmetric,
        Family::Sparse,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        FAMILY_NAMES[self as usize]
    }

    /// The family called `name`.
    pub fn named(name: &str) -> Option<Family> {
        Family::ALL.into_iter().find(|family| family.name() == name)
    }

    /// The order of its constraints and whether they are nonlinear, where it is made for constraints of order two and more.
    fn higher_order(self) -> Option<(u32, bool)> {
        match self {
            Family::SecondOrderLinear => Some((2, false)),
            Family::SecondOrderNonlinear => Some((2, true)),
            Family::ThirdOrderLinear => Some((3, false)),
            Family::ThirdOrderNonlinear => Some((3, true)),
            _ => None,
        }
    }

    /// Which functions occur; the others take either.
    fn kind(self) -> Option<Kind> {
        match self {
            Family::PolynomialLinear | Family::PolynomialNonlinear => Some(Kind::Polynomial),
            Family::TrigonometricLinear | Family::TrigonometricNonlinear => {
                Some(Kind::Trigonometric)
            }
            _ => None,
        }
    }

    /// The numbers of coordinates, the frequent ones several times: small systems are as good as large ones at finding a
    /// slip, and faster; after the first systems only few are larger, so that a thousand take minutes.
    fn sizes(self, seed: u64) -> &'static [usize] {
        match self {
            Family::Symmetric => &[3, 3, 3, 4],
            _ if seed >= LARGER => &[2, 2, 2, 2, 2, 3, 3, 4],
            Family::Radicals | Family::MovingFrame | Family::Singular => &[2, 2, 3, 3, 3, 4],
            Family::VariableMass | Family::VelocityMass => &[2, 2, 2, 3],
            _ if self.higher_order().is_some() => &[2, 2, 2, 3],
            Family::Sparse => &[3, 3, 3, 4],
            Family::Particles | Family::Chaplygin | Family::Integrable => &[2, 3, 3, 4],
            _ => &[2, 2, 3, 3, 3, 4, 4, 5, 6],
        }
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
    let sizes = family.sizes(seed);
    let n = sizes[random.below(sizes.len() as u64) as usize];
    let kind = family.kind().unwrap_or_else(|| match random.below(2) {
        0 => Kind::Polynomial,
        _ => Kind::Trigonometric,
    });
    let mut draw = Draw {
        g,
        random,
        kind,
        names: (1..=n).map(|i| format!("q_{i}")).collect(),
        visible: (0..n).collect(),
    };
    let masses: Vec<(String, Expr)> = (1..=draw.index(3))
        .map(|i| format!("m_{i}"))
        .map(|name| (name.clone(), g.symbol(&name, 0)))
        .collect();
    let values: Vec<Expr> = masses.iter().map(|(_, m)| *m).collect();
    let mut parts = match family {
        Family::Singular => singular_system(&mut draw),
        Family::Particles => particle_system(&mut draw, &values),
        Family::VariableMass => variable_mass_system(&mut draw, &values, false),
        Family::VelocityMass => variable_mass_system(&mut draw, &values, true),
        Family::Symmetric => symmetric::system(&mut draw, &values),
        Family::Sparse => sparse::system(&mut draw, &values),
        Family::Chaplygin => chaplygin_system(&mut draw, &values),
        Family::Integrable => SystemParts {
            forces: Vec::new(),
            ..usual_system(&mut draw, family, &values)
        },
        _ if family.higher_order().is_some() => higher_order_system(&mut draw, family, &values),
        _ => usual_system(&mut draw, family, &values),
    };
    if family == Family::MovingFrame {
        state_frame(&mut draw, &mut parts);
    }
    parts.name = format!("{} {seed}", family.name());
    parts.coordinates.clone_from(&draw.names);
    parts.assumptions = masses.iter().map(|m| positive(g, m)).collect();
    parts.parameters = masses
        .into_iter()
        .map(|(name, _)| {
            let value = draw.positive();
            (name, Some(g.number(value)))
        })
        .collect();
    parts
}

/// L with a positive definite Hessian, forces and constraints of the family.
fn usual_system(draw: &mut Draw<'_>, family: Family, masses: &[Expr]) -> SystemParts {
    SystemParts {
        lagrangian: Some(whole_lagrangian(draw, family, masses)),
        forces: lagrangian::forces(draw, family == Family::RheonomicAffine),
        constraints: named(all_constraints(draw, family)),
        ..SystemParts::default()
    }
}

fn singular_system(draw: &mut Draw<'_>) -> SystemParts {
    let (lagrangian, rows) = singular::system(draw);
    SystemParts {
        lagrangian: Some(lagrangian),
        forces: lagrangian::forces(draw, false),
        constraints: named(rows),
        ..SystemParts::default()
    }
}

fn particle_system(draw: &mut Draw<'_>, masses: &[Expr]) -> SystemParts {
    let found = particles::particles(draw, masses);
    of_particles(draw, found)
}

/// Particles with masses that vary, some of them by laws of their own.
fn variable_mass_system(draw: &mut Draw<'_>, masses: &[Expr], velocities: bool) -> SystemParts {
    let mut found = particles::particles(draw, masses);
    let laws = masses::vary(draw, &mut found.particles, velocities);
    SystemParts {
        masses: laws,
        ..of_particles(draw, found)
    }
}

fn of_particles(draw: &mut Draw<'_>, found: particles::Particles) -> SystemParts {
    let g = draw.g;
    let kinetic = particles::kinetic(g, &draw.names, &found.particles);
    let mut rows = found.holonomic;
    if rows.is_empty() {
        rows = match draw.between(0, 3) {
            0 => constraints::nonlinear(draw),
            1 => constraints::linear(draw, 1, Form::Rheonomic),
            _ => constraints::linear(draw, 1, Form::Linear),
        };
    }
    SystemParts {
        lagrangian: Some(g.sub(kinetic, lagrangian::potential(draw))),
        forces: lagrangian::forces(draw, false),
        constraints: named(rows),
        particles: found.particles,
        ..SystemParts::default()
    }
}

/// The last r coordinates occur nowhere, and their velocities can be solved for.
fn chaplygin_system(draw: &mut Draw<'_>, masses: &[Expr]) -> SystemParts {
    let n = draw.n();
    let r = 1 + draw.index((n - 1).min(2));
    draw.visible.truncate(n - r);
    let mut parts = usual_system(draw, Family::Chaplygin, masses);
    let (g, first) = (draw.g, draw.n() - r);
    let rows = (0..r).map(|l| {
        let curved = draw.one_in(4);
        let mut row = vec![draw.v(first + l)];
        for i in 0..first {
            let slope = draw.function(1);
            let power = if curved && i == 0 { 2 } else { 1 };
            row.push(g.neg(g.mul(&[slope, g.powi(draw.v(i), power)])));
        }
        g.add(&row)
    });
    parts.constraints = named(rows.collect());
    parts
}

/// The constraints are those of first order with higher derivatives in the place of velocities, and lower derivatives in the
/// place of some coordinates.
fn higher_order_system(draw: &mut Draw<'_>, family: Family, masses: &[Expr]) -> SystemParts {
    let (order, nonlinear) = family.higher_order().unwrap_or((2, false));
    let mut parts = usual_system(draw, family, masses);
    // Nonlinear ones with derivatives above the velocities are so large that their proofs take minutes.
    let (rows, lower) = match nonlinear {
        true => (constraints::nonlinear(draw), 1),
        false => (constraints::linear(draw, 1, Form::Linear), order - 1),
    };
    parts.constraints = named(constraints::raised(draw, &rows, order, lower));
    parts
}

/// A frame in which the last velocities are left to the constraints, where k forms are stated.
fn state_frame(draw: &mut Draw<'_>, parts: &mut SystemParts) {
    let r = parts.constraints.len();
    let dependent: Vec<usize> = (draw.n() - r..draw.n()).collect();
    let stated = frames::frame(draw, &dependent);
    parts.quasi_velocities = stated.quasi_velocities;
    parts.frame = stated.frame;
}

fn named(rows: Vec<Expr>) -> Vec<(String, Expr)> {
    let numbered = rows.into_iter().enumerate();
    numbered.map(|(l, f)| (format!("c_{}", l + 1), f)).collect()
}

fn whole_lagrangian(draw: &mut Draw<'_>, family: Family, masses: &[Expr]) -> Expr {
    let g = draw.g;
    let mut parts = vec![lagrangian::kinetic(draw, masses)];
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
    let nonlinear = match family {
        Family::Radicals => return constraints::radicals(draw),
        Family::Integrable => return constraints::integrable(draw),
        Family::PolynomialNonlinear | Family::TrigonometricNonlinear => true,
        Family::Nonquadratic => draw.one_in(3),
        Family::MovingFrame => draw.one_in(4),
        _ => false,
    };
    if nonlinear {
        return constraints::nonlinear(draw);
    }
    let r = 1 + draw.index((draw.n() - 1).min(3));
    let form = match family {
        Family::RheonomicAffine => Form::Rheonomic,
        Family::MovingFrame if draw.one_in(3) => Form::Rheonomic,
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
                // The matrix of a mass that contains velocities is not even symmetric.
                if matches!(family, Family::Singular | Family::VelocityMass) {
                    continue;
                }
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
