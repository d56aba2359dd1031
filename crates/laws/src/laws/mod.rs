//! The laws: statements that hold for every system, and wrong equations that hold for none.

mod coordinates;
mod counterexample;
mod digits;
mod equal;
mod exterior;
mod extremals;
mod frames;
mod hypotheses;
mod integrals;
mod masses;
mod mutants;
mod numbers;
mod order;
mod power;
mod precise;
mod principles;
mod reduced;
mod regular;
mod rewrite;
mod series;
mod sets;
mod wrong;

use chetaev_mechanics::claims::formulation::{self, derive, residuals};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::sample::Point;
use chetaev_mechanics::{Characteristics, Claim, Context, Equations};
use chetaev_symbolic::verdict::Verdict;
use chetaev_symbolic::Expr;
use hypotheses::Seen;
use std::ops::Deref;
use std::time::Instant;

/// What a law demands of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// The statement is true.
    Proved,
    /// The statement is false.
    Refuted,
    /// A hypothesis of the statement fails.
    NotApplicable,
}

impl Expected {
    /// The word of the verdict.
    pub fn word(self) -> &'static str {
        match self {
            Expected::Proved => "proved",
            Expected::Refuted => "refuted",
            Expected::NotApplicable => "not-applicable",
        }
    }
}

/// What a trial is about, for the summary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A formulation is compared with the reference.
    Formulation,
    /// What a formulation claims identically.
    Identity,
    /// Two formulations are compared.
    Pair,
    /// Wrong equations.
    Mutant,
    /// Anything else.
    Other,
}

/// One law tried on one system.
#[derive(Clone, Debug)]
pub struct Trial {
    /// What it is about.
    pub kind: Kind,
    /// The law, in a few words.
    pub law: &'static str,
    /// The formulation in question; empty where there is none.
    pub formulation: &'static str,
    /// What was done to the equations, where they are wrong.
    pub about: String,
    /// What the verdict must be.
    pub expected: Expected,
    /// What it is.
    pub verdict: Verdict,
    /// Wall time, the search for a slip that makes a difference included.
    pub seconds: f64,
}

impl Trial {
    /// The formulation in question and the law.
    pub fn title(&self) -> String {
        match self.formulation {
            "" => self.law.to_string(),
            name => format!("{name}: {}", self.law),
        }
    }

    /// Whether the verdict is the expected one.
    pub fn holds(&self) -> bool {
        self.verdict.word() == self.expected.word()
    }
}

/// One system with states of it: what hypotheses are seen from.
pub(crate) struct Sampled<'a> {
    pub(crate) cx: &'a Context<'a>,
    /// Independent velocities, whatever quasi-velocities the model states.
    natural: Characteristics,
    /// Admissible states.
    states: Vec<Point>,
    /// States that satisfy no constraint.
    free_states: Vec<Point>,
    /// Distinguishes the random choices of the laws from those of the generator.
    pub(crate) seed: u64,
}

impl<'a> Sampled<'a> {
    pub(crate) fn new(cx: &'a Context<'a>, seed: u64) -> Result<Sampled<'a>, DeriveError> {
        let states = numbers::states(cx);
        Ok(Sampled {
            cx,
            natural: formulation::basis(cx).independent_velocities()?,
            free_states: numbers::freed(cx, &states),
            states,
            seed,
        })
    }
}

/// A system whose accelerations are determined, with both forms of the equations the laws start from.
pub(crate) struct Subject<'a> {
    sampled: Sampled<'a>,
    pub(crate) routh: Equations,
    pub(crate) maggi: Equations,
    /// The parameters of Maggi's equations.
    pub(crate) chart: Characteristics,
}

impl<'a> Deref for Subject<'a> {
    type Target = Sampled<'a>;

    fn deref(&self) -> &Sampled<'a> {
        &self.sampled
    }
}

impl<'a> Subject<'a> {
    pub(crate) fn new(sampled: Sampled<'a>) -> Result<Subject<'a>, DeriveError> {
        let cx = sampled.cx;
        Ok(Subject {
            routh: derive(cx, "routh")?,
            maggi: derive(cx, "maggi")?,
            chart: formulation::basis(cx).characteristics()?,
            sampled,
        })
    }

    /// Distinct nodes of the difference between the two forms.
    pub(crate) fn size(&self) -> usize {
        let difference = residuals(self.cx, &self.routh, &self.maggi);
        self.cx.system.graph.reachable(&difference).len()
    }

    /// Indices of the independent velocities.
    fn independent(&self) -> Vec<usize> {
        self.cx.selection.independent(self.cx.system.n())
    }

    /// Replaces velocities and accelerations by those of independent velocities.
    fn on_jet(&self, es: &[Expr]) -> Vec<Expr> {
        self.natural.on_jet(self.cx.system, es)
    }

    /// Whether other equations give the accelerations of Routh's; a refutation is looked at again.
    fn compared(&self, other: &Equations) -> Verdict {
        let verdict = formulation::equivalence(self.cx, &self.routh, other);
        counterexample::looked_at_again(self, other, verdict)
    }

    /// The accelerations that k equations on the jet of `chart` give, linear in P'; `None` where they do not determine P'.
    fn motion_of(&self, chart: &Characteristics, equations: &[Expr]) -> Option<Equations> {
        let system = self.cx.system;
        let rates = chart.rates_from(system, equations).ok()?;
        let motion = Equations::in_characteristics("maggi", system, chart, &rates);
        Some(motion)
    }
}

/// The claims in question: those of mechanics, integrability, and the variational principles.
pub(crate) const CLAIMS: &[&[&dyn Claim]] = &[
    chetaev_mechanics::claims::CLAIMS,
    chetaev_geometry::CLAIMS,
    chetaev_principles::CLAIMS,
];

/// A law: a trial on the subject, or `None` where there is nothing to try.
type Law = fn(&Subject<'_>) -> Option<Trial>;

const LAWS: [Law; 12] = [
    power::balance,
    masses::balance,
    masses::thrust_alone,
    coordinates::invariance,
    coordinates::same_verdicts,
    wrong::dropped_term,
    wrong::wrong_sign,
    reduced::lagrange_of_restricted,
    reduced::momenta_of_full,
    frames::without_brackets,
    exterior::identities,
    regular::accelerations,
];

/// Tries the laws of systems that state an integral.
pub(crate) use integrals::all as all_of_integrals;

pub use integrals::CONTAINED;

/// Tries the laws of constraints of order two and more.
pub(crate) use order::all as all_of_order;

/// Tries every law; where the accelerations are not determined, what is said of the formulations only.
///
/// # Errors
/// [`DeriveError`] where the accelerations are determined, but could not be derived.
pub(crate) fn all(sampled: Sampled<'_>) -> Result<(Vec<Trial>, usize), DeriveError> {
    let mut trials = equal::formulations(&sampled);
    if hypotheses::seen(&sampled, "model.accelerations-unique") == Seen::Fails {
        return Ok((trials, 0));
    }
    let subject = Subject::new(sampled)?;
    trials.extend(equal::pairs(&subject));
    trials.extend(mutants::slips(&subject));
    trials.extend(principles::all(&subject));
    for law in LAWS {
        let start = Instant::now();
        let trial = law(&subject);
        let seconds = start.elapsed().as_secs_f64();
        trials.extend(trial.map(|trial| Trial { seconds, ..trial }));
    }
    Ok((trials, subject.size()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{generate, Family};
    use chetaev_mechanics::claims::CLAIMS;
    use chetaev_mechanics::{Prepared, Prover, Registry, System, SystemParts};
    use chetaev_principles::stationarity::StationarySets;
    use chetaev_symbolic::verdict::Counterexample;
    use chetaev_symbolic::Graph;
    use std::sync::Arc;

    /// Looks at a system after something was spoilt in it.
    fn spoilt(family: Family, spoil: impl Fn(&mut Subject<'_>), look: impl Fn(&Subject<'_>)) {
        let random = generate(family, 1).unwrap();
        let prepared = Prepared::new(&random.system).unwrap();
        let registry = Registry::new(&[CLAIMS]);
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let prover = Prover::default();
        let cx = Context::new(&random.system, terms, selection, &registry, prover);
        let mut subject = Subject::new(Sampled::new(&cx, 1).unwrap()).unwrap();
        spoil(&mut subject);
        look(&subject);
    }

    /// Adds the square of a coordinate to the accelerations of Routh's equations.
    fn shift(subject: &mut Subject<'_>) {
        let g = &subject.cx.system.graph;
        let extra = g.powi(subject.cx.system.coordinates[0].q, 2);
        for a in &mut subject.routh.accelerations {
            *a = g.add(&[*a, extra]);
        }
    }

    #[test]
    fn true_laws_fail_for_wrong_accelerations() {
        for family in [Family::PolynomialLinear, Family::TrigonometricNonlinear] {
            spoilt(family, shift, |subject| {
                for law in [power::balance, coordinates::invariance] {
                    let trial = law(subject).unwrap();
                    assert_eq!(trial.verdict.word(), "refuted", "{}", trial.law);
                    assert!(!trial.holds());
                }
            });
        }
    }

    #[test]
    fn accelerations_without_multipliers_are_compared() {
        let unspoilt = |_: &mut Subject<'_>| {};
        spoilt(Family::Chaplygin, unspoilt, |subject| {
            assert!(regular::accelerations(subject).unwrap().holds());
        });
        spoilt(Family::Chaplygin, shift, |subject| {
            let trial = regular::accelerations(subject).unwrap();
            assert_eq!(trial.verdict.word(), "refuted");
        });
    }

    #[test]
    fn a_multiplier_of_the_wrong_sign_breaks_the_law_of_coordinates() {
        let flip = |subject: &mut Subject<'_>| {
            let g = &subject.cx.system.graph;
            for (_, lambda) in &mut subject.routh.multipliers {
                *lambda = g.neg(*lambda);
            }
        };
        spoilt(Family::RheonomicAffine, flip, |subject| {
            let trial = coordinates::invariance(subject).unwrap();
            assert_eq!(trial.verdict.word(), "refuted");
        });
    }

    /// 1 beside 10^40 q²: no digit of the difference is left in double precision.
    #[test]
    fn a_counterexample_lost_in_double_precision_stands() {
        let drown = |subject: &mut Subject<'_>| {
            let g = &subject.cx.system.graph;
            let square = g.powi(subject.cx.system.coordinates[0].q, 2);
            let large = g.mul(&[g.powi(g.integer(10), 40), g.add(&[square, g.one()])]);
            for a in &mut subject.routh.accelerations {
                *a = g.add(&[*a, large]);
            }
        };
        for family in [Family::PolynomialLinear, Family::TrigonometricNonlinear] {
            spoilt(family, drown, |subject| {
                let g = &subject.cx.system.graph;
                let mut wrong = subject.routh.clone();
                for a in &mut wrong.accelerations {
                    *a = g.add(&[*a, g.one()]);
                }
                assert_eq!(subject.compared(&wrong).word(), "refuted");
            });
        }
    }

    /// z' = y x' with L = v·v/2 is stationary where x' = 0 or y' = 0, and κ = 0 there; elsewhere, or with another κ(0), the extremal
    /// leaves the motion.
    #[test]
    fn a_state_off_the_sets_printed_is_found() {
        let registry = Registry::new(super::CLAIMS);
        let system = particle();
        let prepared = Prepared::new(&system).unwrap();
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&system, terms, selection, &registry, Prover::default());
        let subject = Subject::new(Sampled::new(&cx, 1).unwrap()).unwrap();
        let printed = StationarySets::of(&cx).unwrap();
        let holds = |sets: &StationarySets| sets::from_sets(&subject, sets).unwrap().holds();
        assert_eq!(printed.sets.len(), 2);
        assert!(holds(&printed));
        let g = &system.graph;
        let mut elsewhere = printed.clone();
        elsewhere.sets[0].solved[0].1 = g.one();
        assert!(!holds(&elsewhere));
        let mut other = printed.clone();
        other.sets[0].conditions[0].right = g.one();
        assert!(!holds(&other));
        // Off both sets there is no other; one that is not printed is found.
        let none_beside = |sets: &StationarySets| sets::off_sets(&subject, sets).unwrap().holds();
        assert!(printed.complete && none_beside(&printed));
        let mut missing = printed.clone();
        missing.vanishing.remove(0);
        assert!(!none_beside(&missing));
    }

    fn particle() -> System {
        let g = Arc::new(Graph::new());
        let s = |name: &str, order: u32| g.symbol(name, order);
        let squares = ["x", "y", "z"].map(|name| g.powi(s(name, 1), 2));
        let product = g.mul(&[s("y", 0), s("x", 1)]);
        let parts = SystemParts {
            coordinates: ["x", "y", "z"].map(String::from).to_vec(),
            lagrangian: Some(g.div(g.add(&squares), g.integer(2))),
            constraints: vec![("c".into(), g.sub(s("z", 1), product))],
            ..SystemParts::default()
        };
        System::new(g, parts).unwrap()
    }

    #[test]
    fn a_counterexample_that_does_not_stand_is_found() {
        let false_one = || {
            Verdict::Refuted(Counterexample {
                point: Vec::new(),
                quantity: "the residual".into(),
                residual: ("0.25".into(), "0.26".into()),
                detail: "said to differ".into(),
            })
        };
        spoilt(
            Family::PolynomialLinear,
            |_| (),
            |subject| {
                let seen = counterexample::looked_at_again(subject, &subject.routh, false_one());
                assert_eq!(seen.word(), "undecided");
            },
        );
    }
}
