//! The registry of claims: what the product states about a system (claims.md).
//!
//! A claim is a value with an id, the ids of its hypotheses, and a rule to decide it. Crates above contribute their
//! claims as slices; a [`Registry`] joins them, and hypotheses are resolved by id at run time, so that a formulation
//! may require a verdict of the geometry without the crates knowing each other.

pub use chetaev_model::decision::full_id;

pub mod bodies;
pub mod formulation;
pub mod gauss;
pub mod hypotheses;
pub mod mass;
pub mod metric;
pub mod model;
pub mod on_set;
pub mod order;
pub mod particles;
mod roots;
pub mod stated_equations;
pub mod strata;
pub mod twin;

use crate::card::Card;
use crate::characteristics::{self, Selection};
use crate::components;
use crate::formulations::DeriveError;
use crate::prover::{Noticed, Prover};
use crate::redundancy::LeftOut;
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words;
use chetaev_model::decision::Found;
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::{Expr, Verdict};
use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The groups that `--claims` selects, in the order they are decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Catalogue of claims, §1.
    Model,
    /// Catalogue of claims, §2.
    Formulations,
    /// Catalogue of claims, §8.
    Motion,
    /// Catalogue of claims, §3–4.
    Principles,
    /// Catalogue of claims, §6.
    Integrals,
    /// Catalogue of claims, §9.
    Stability,
}

impl Group {
    /// All groups, cheapest first.
    pub const ALL: [Group; 6] = [
        Group::Model,
        Group::Formulations,
        Group::Motion,
        Group::Principles,
        Group::Integrals,
        Group::Stability,
    ];

    /// The word on the command line.
    pub fn word(self) -> &'static str {
        match self {
            Group::Model => "model",
            Group::Formulations => "formulations",
            Group::Motion => "motion",
            Group::Principles => "principles",
            Group::Integrals => "integrals",
            Group::Stability => "stability",
        }
    }
}

/// What a claim is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The functions that the model states, as they are written.
    Functions,
    /// Equations on the admissible states: on all components at once, where one choice of independent velocities describes them.
    Equations,
    /// Motions: on all components at once too, where positions are not apart.
    Motions,
    /// Motions and the curves beside them: on each component by itself.
    Components,
    /// The motion that was computed: on the component on which it starts.
    Run,
}

/// A formula shown with a verdict.
#[derive(Clone, Debug)]
pub struct Formula {
    /// What it is.
    pub caption: String,
    /// Left side, when it is an equation.
    pub left: Option<Expr>,
    /// The expression, or the right side.
    pub right: Expr,
}

/// A verdict with the formulas that support it.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What is known.
    pub verdict: Verdict,
    /// Formulas to show.
    pub formulas: Vec<Formula>,
}

/// A claim about a system with its verdict.
pub type Decided = chetaev_model::decision::Decided<Arc<Finding>>;

impl Found for Finding {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }
}

impl From<&DeriveError> for Verdict {
    fn from(problem: &DeriveError) -> Verdict {
        Verdict::undecided(format!("the equations could not be derived: {problem}"))
    }
}

impl From<DeriveError> for Finding {
    fn from(problem: DeriveError) -> Finding {
        Verdict::from(&problem).into()
    }
}

impl From<Verdict> for Finding {
    fn from(verdict: Verdict) -> Finding {
        Finding {
            verdict,
            formulas: Vec::new(),
        }
    }
}

/// A statement about systems.
pub trait Claim: Sync {
    /// The stable id, without subject.
    fn id(&self) -> &'static str;

    /// Where it belongs.
    fn group(&self) -> Group;

    /// A short title for people.
    fn title(&self) -> &'static str;

    /// The title for a subject, where that is another statement.
    fn title_of(&self, subject: Option<&str>) -> &'static str {
        let _ = subject;
        self.title()
    }

    /// What is claimed, how it is decided, and what the verdicts mean: the page of `chetaev explain`.
    fn explanation(&self) -> &'static str;

    /// Ids (with subject) of the hypotheses: when one is refuted, the claim is not applicable.
    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let _ = subject;
        Vec::new()
    }

    /// The subjects for this system; `[None]` for a claim about the system as a whole, empty when it does not exist.
    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let _ = cx;
        vec![None]
    }

    /// The highest order of constraints that the rule of this claim takes into account. A system with constraints of
    /// higher order is another system without them: the claim is then not decided at all.
    fn highest_order(&self, subject: Option<&str>) -> u32 {
        let _ = subject;
        1
    }

    /// What it is about, and with that on which parts of the states it is asked.
    fn scope(&self) -> Scope {
        match self.group() {
            Group::Model | Group::Stability => Scope::Functions,
            Group::Formulations => Scope::Equations,
            Group::Integrals => Scope::Motions,
            Group::Principles => Scope::Components,
            Group::Motion => Scope::Run,
        }
    }

    /// Whether it speaks of all functions of the time that controls may be; else of the laws that the model states.
    fn is_for_any_controls(&self) -> bool {
        !matches!(
            self.group(),
            Group::Principles | Group::Motion | Group::Stability
        )
    }

    /// Whether it is asked once more for stated values of parameters that are seen to be exceptional.
    fn is_asked_of_values(&self) -> bool {
        !matches!(self.group(), Group::Integrals | Group::Stability)
    }

    /// Decides for another part of the states what it states of `subject` on this one, as of the integral with this number: by itself
    /// there, where the subjects are the same.
    fn decide_there(
        &self,
        cx: &Context<'_>,
        subject: Option<&str>,
        there: &Context<'_>,
    ) -> Finding {
        let _ = cx;
        Finding::clone(&there.finding(&full_id(self.id(), subject)))
    }

    /// Decides the claim; its hypotheses hold.
    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding;
}

/// All claims known to a program.
#[derive(Clone, Default)]
pub struct Registry {
    claims: Vec<&'static dyn Claim>,
}

impl std::fmt::Debug for Registry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list()
            .entries(self.claims.iter().map(|c| c.id()))
            .finish()
    }
}

impl Registry {
    /// Joins slices of claims.
    pub fn new(slices: &[&[&'static dyn Claim]]) -> Registry {
        Registry {
            claims: slices.concat(),
        }
    }

    /// All claims in order.
    pub fn claims(&self) -> &[&'static dyn Claim] {
        &self.claims
    }

    /// The claim with this id (without subject).
    pub fn find(&self, id: &str) -> Option<&'static dyn Claim> {
        self.claims.iter().copied().find(|c| c.id() == id)
    }
}

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[
    &model::HessianRegular,
    &model::ConstraintsIndependent,
    &model::AccelerationsUnique,
    &model::ConstraintsLinear,
    &model::ConstraintsHomogeneous,
    &model::ConstraintsScleronomic,
    &model::Chaplygin,
    &hypotheses::ConstraintsFirstOrder,
    &order::Lifting,
    &order::OrderCharacteristics,
    &order::OrderDetermined,
    &hypotheses::ForcesAbsent,
    &hypotheses::LagrangianAutonomous,
    &hypotheses::LagrangianQuadratic,
    &hypotheses::LagrangianEven,
    &metric::MetricPositive,
    &hypotheses::RestrictedHessianRegular,
    &hypotheses::ConstrainedExtremumRegular,
    &particles::Particles,
    &bodies::Bodies,
    &particles::CartesianCoordinates,
    &mass::MassesFreeOfVelocity,
    &mass::MassesOfTime,
    &model::FrameRegular,
    &formulation::Equivalent,
    &formulation::Identities,
    &mass::Balance,
    &gauss::Least,
    &stated_equations::Stated,
    &twin::SameMotion,
];

/// Everything a claim may look at while it is decided. Results are kept by id, so each is decided once.
pub struct Context<'a> {
    /// The system.
    pub system: &'a System,
    /// Its terms.
    pub terms: &'a MotionTerms,
    /// Independent constraints and dependent velocities.
    pub selection: &'a Selection,
    /// Zero tests.
    pub prover: Prover,
    registry: &'a Registry,
    decided: Mutex<BTreeMap<String, Known<Finding>>>,
    in_progress: Mutex<Vec<String>>,
    extensions: BTreeMap<TypeId, Arc<dyn Any + Send + Sync>>,
    shared: Mutex<BTreeMap<TypeId, Known<dyn Any + Send + Sync>>>,
    out_of_time: AtomicBool,
    work: f64,
    of_motions: Option<Arc<Context<'a>>>,
}

/// What is known, and values of parameters at which it is, or may be, otherwise.
struct Known<T: ?Sized> {
    value: Arc<T>,
    exceptional: Noticed,
}

impl<T: ?Sized> Clone for Known<T> {
    fn clone(&self) -> Known<T> {
        Known {
            value: Arc::clone(&self.value),
            exceptional: self.exceptional.clone(),
        }
    }
}

/// The components of the constraints that the chart covers, where it leaves out others.
struct Covered(Option<String>);

impl std::fmt::Debug for Context<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Context({})", self.system.name)
    }
}

/// Subjects of a claim that is made once where `holds`, and else not at all.
pub fn once_where(holds: bool) -> Vec<Option<String>> {
    match holds {
        true => vec![None],
        false => Vec::new(),
    }
}

/// The verdict, which says first what was proved where it is proved.
fn stating(verdict: Verdict, what: &str) -> Verdict {
    match verdict {
        Verdict::Proved(_) => verdict.prefixed(what),
        other => other,
    }
}

/// What is known of a component of the constraints, said of all motions.
fn on_component(verdict: Verdict, component: &str) -> Verdict {
    match verdict {
        Verdict::Proved(proof) => Verdict::Conditional {
            condition: component.to_string(),
            proof,
            counterexample: None,
        },
        Verdict::Conditional {
            condition,
            proof,
            counterexample,
        } => Verdict::Conditional {
            condition: format!("{condition}, where {component}"),
            proof,
            counterexample,
        },
        other => other,
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> Context<'a> {
    /// A context with nothing decided.
    pub fn new(
        system: &'a System,
        terms: &'a MotionTerms,
        selection: &'a Selection,
        registry: &'a Registry,
        prover: Prover,
    ) -> Context<'a> {
        Context {
            system,
            terms,
            selection,
            prover,
            registry,
            decided: Mutex::default(),
            in_progress: Mutex::default(),
            extensions: BTreeMap::new(),
            shared: Mutex::default(),
            out_of_time: AtomicBool::new(false),
            work: 1.0,
            of_motions: None,
        }
    }

    /// A context with nothing decided, of a system with its terms.
    pub fn of(
        system: &'a System,
        prepared: &'a Prepared,
        registry: &'a Registry,
        prover: Prover,
    ) -> Context<'a> {
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(system, terms, selection, registry, prover);
        cx.where_degenerate(prepared)
    }

    /// Says nothing but that, where the constraints of the system that was written determine no motion.
    #[must_use]
    pub fn where_degenerate(self, written: &Prepared) -> Context<'a> {
        match &written.degenerate {
            Some(degenerate) => self.with(Arc::new(degenerate.clone())),
            None => self,
        }
    }

    /// Adds the context of the system on which its motions are, where that is another one.
    #[must_use]
    pub fn with_motions_of(mut self, other: Arc<Context<'a>>) -> Context<'a> {
        self.of_motions = Some(other);
        self
    }

    /// The context in which integrals of the motions are sought: of the component on which they start, with the values that the model
    /// states for the parameters that are zero.
    pub fn of_motions(&self) -> &Context<'a> {
        self.of_motions.as_deref().unwrap_or(self)
    }

    /// Adds data of a higher layer (a computed motion, initial data), found again by its type.
    #[must_use]
    pub fn with<T: Any + Send + Sync>(mut self, data: Arc<T>) -> Context<'a> {
        self.extensions.insert(TypeId::of::<T>(), data);
        self
    }

    /// Data added by a higher layer.
    pub fn extension<T: Any + Send + Sync>(&self) -> Option<Arc<T>> {
        self.extensions
            .get(&TypeId::of::<T>())
            .and_then(|data| data.clone().downcast::<T>().ok())
    }

    /// Data that several claims need and one computes, found again by its type.
    pub fn shared<T: Any + Send + Sync>(&self, compute: impl FnOnce(&Self) -> T) -> Arc<T> {
        if let Some(known) = self.known::<T>() {
            return known;
        }
        let computed = self.noticing(|| Arc::new(compute(self)));
        let value = Arc::clone(&computed.value);
        let known = Known {
            value: computed.value as Arc<dyn Any + Send + Sync>,
            exceptional: computed.exceptional,
        };
        lock(&self.shared).insert(TypeId::of::<T>(), known);
        value
    }

    /// [`shared`](Context::shared) data, if some claim has computed them already.
    pub fn known<T: Any + Send + Sync>(&self) -> Option<Arc<T>> {
        let known = lock(&self.shared).get(&TypeId::of::<T>()).cloned()?;
        self.prover.exceptional.add(known.exceptional);
        known.value.downcast::<T>().ok()
    }

    /// What is computed, with the parameters that are noticed on the way; whoever asked depends on them too.
    fn noticing<T: ?Sized>(&self, compute: impl FnOnce() -> Arc<T>) -> Known<T> {
        let before = self.prover.exceptional.take();
        let value = compute();
        let exceptional = self.prover.exceptional.take();
        self.prover.exceptional.add(before);
        self.prover.exceptional.add(exceptional.clone());
        Known { value, exceptional }
    }

    /// Allows searches so many times the usual work, and no less than that.
    #[must_use]
    pub fn allowing(mut self, work: f64) -> Context<'a> {
        // Also where the number is none.
        self.work = work.max(1.0);
        self
    }

    /// How much work searches may do, as a multiple of the usual, at least 1. What they look at depends on this number and not on how fast a
    /// machine is, so that the same study says the same everywhere.
    pub fn work(&self) -> f64 {
        self.work
    }

    /// Says that the time for claims is spent: what takes long is not begun any more.
    pub fn spend_time(&self) {
        self.out_of_time.store(true, Ordering::Relaxed);
    }

    /// Forgets what was being decided when that was stopped.
    pub fn abandon(&self) {
        lock(&self.in_progress).clear();
    }

    /// Whether the time for claims is spent.
    pub fn is_out_of_time(&self) -> bool {
        self.out_of_time.load(Ordering::Relaxed)
    }

    /// The registry in use.
    pub fn registry(&self) -> &Registry {
        self.registry
    }

    /// Decides the claim `id#subject`, or recalls it. Unknown ids are undecided, never assumed.
    pub fn finding(&self, full: &str) -> Arc<Finding> {
        let recalled = lock(&self.decided).get(full).cloned();
        if let Some(found) = recalled {
            self.prover.exceptional.add(found.exceptional);
            return found.value;
        }
        let (id, subject) = match full.split_once('#') {
            Some((id, subject)) => (id, Some(subject)),
            None => (full, None),
        };
        let Some(claim) = self.registry.find(id) else {
            let verdict = Verdict::undecided(format!("the claim `{full}` is not registered"));
            return Arc::new(verdict.into());
        };
        if lock(&self.in_progress).iter().any(|name| name == full) {
            let verdict = Verdict::undecided(format!("the claim `{full}` requires itself"));
            return Arc::new(verdict.into());
        }
        lock(&self.in_progress).push(full.to_string());
        let finding = self.noticing(|| {
            Arc::new(match self.obstacle(claim, subject) {
                Some(verdict) => verdict.into(),
                None => self.on_components(claim, claim.decide(self, subject)),
            })
        });
        lock(&self.in_progress).retain(|name| name != full);
        lock(&self.decided).insert(full.to_string(), finding.clone());
        finding.value
    }

    /// What is proved of the motions in a chart of some components of the constraints is proved of these alone.
    fn on_components(&self, claim: &dyn Claim, mut finding: Finding) -> Finding {
        if matches!(claim.scope(), Scope::Functions | Scope::Run) {
            return finding;
        }
        let covered =
            self.shared(|cx| Covered(components::covered(cx.system, cx.terms, cx.selection)));
        let Some(covered) = &covered.0 else {
            return finding;
        };
        // What holds on a component that was found by itself may be another one.
        if matches!(&finding.verdict, Verdict::Conditional { proof, .. } if proof.on.starts_with("on the component "))
        {
            return finding;
        }
        let sentence = format!(
            "of the components of the constraints only that where {covered} was looked at, as no one velocity can be solved for on all"
        );
        finding.verdict = on_component(finding.verdict, covered);
        if !matches!(finding.verdict, Verdict::NotApplicable { .. }) {
            finding.verdict.prefix(&sentence);
        }
        finding
    }

    /// Why nothing else is said of a system whose constraints determine no motion.
    fn degenerate(&self) -> Option<Verdict> {
        let own = model::ConstraintsIndependent.id();
        let sentence = &self.extension::<Degenerate>()?.found.detail;
        let detail = format!("`{own}` is refuted: {sentence}");
        Some(Verdict::not_applicable(own, detail))
    }

    fn constraint_beyond(&self, order: u32) -> Option<Verdict> {
        let constraint = self.system.constraints.iter().find(|c| c.order > order)?;
        Some(Verdict::not_applicable(
            "model.constraints-first-order",
            format!(
                "the constraint `{}` is of order {}, and this is made for constraints up to order {order}: without it the system would be another one",
                constraint.name, constraint.order
            ),
        ))
    }

    /// Why a claim (without subject: of the system) cannot be decided at all: a constraint of too high an order, or the first
    /// hypothesis that fails.
    pub fn obstacle(&self, claim: &dyn Claim, subject: Option<&str>) -> Option<Verdict> {
        let is_asked = claim.id() == model::ConstraintsIndependent.id();
        let degenerate = if is_asked { None } else { self.degenerate() };
        degenerate
            .or_else(|| self.constraint_beyond(claim.highest_order(subject)))
            .or_else(|| self.failed_hypothesis(&claim.requires(subject)))
    }

    /// Why equations with these requirements cannot be derived.
    pub fn obstacle_of(&self, card: &Card) -> Option<Verdict> {
        let requires: Vec<String> = card.requires.iter().map(|&id| id.to_owned()).collect();
        self.degenerate()
            .or_else(|| self.constraint_beyond(card.highest_order))
            .or_else(|| self.failed_hypothesis(&requires))
    }

    fn failed_hypothesis(&self, hypotheses: &[String]) -> Option<Verdict> {
        hypotheses.iter().find_map(|hypothesis| {
            let finding = self.finding(hypothesis);
            let evidence = match &finding.verdict {
                // The point goes with the sentence, which may be all that is printed.
                Verdict::Refuted(found) => match &words::point(found, |_| true)[..] {
                    "" => found.detail.clone(),
                    point => found
                        .detail
                        .replace("at the point stated", &format!("at {point}")),
                },
                Verdict::NotApplicable { detail, .. } => detail.clone(),
                _ => return None,
            };
            let word = finding.verdict.word();
            let detail = format!("`{hypothesis}` is {word}: {evidence}");
            Some(Verdict::not_applicable(hypothesis.clone(), detail))
        })
    }

    /// A phrase for proofs: under which assumptions of the model.
    pub fn under_assumptions(&self) -> String {
        if self.system.assumptions.is_empty() {
            return String::new();
        }
        format!(", assuming {}", self.system.assumption_texts().join(", "))
    }
}

/// Terms and selection of a system, owned: what a [`Context`] borrows.
#[derive(Debug)]
pub struct Prepared {
    /// The terms.
    pub terms: MotionTerms,
    /// The selection.
    pub selection: Selection,
    /// Where the constraints were found to determine no motion at any state: nothing is said of the system but that.
    pub degenerate: Option<Degenerate>,
}

/// Constraints with dependent gradients at all states that satisfy them.
#[derive(Clone, Debug)]
pub struct Degenerate {
    /// The rank of the gradients there.
    pub rank: usize,
    /// What refutes their independence.
    pub found: Counterexample,
}

impl Degenerate {
    /// As what asks for a motion hears it.
    pub fn error(&self) -> characteristics::CharacteristicsError {
        characteristics::CharacteristicsError::Multiplicity {
            sentence: self.found.detail.clone(),
        }
    }
}

impl Prepared {
    /// Derives terms and chooses independent constraints and velocities.
    ///
    /// # Errors
    /// When no admissible state exists.
    pub fn new(system: &System) -> Result<Prepared, characteristics::CharacteristicsError> {
        let terms = MotionTerms::new(system);
        let selection = characteristics::select(system, &terms)?;
        Ok(Prepared {
            terms,
            selection,
            degenerate: None,
        })
    }

    /// Refuses a system whose constraints determine no motion.
    ///
    /// # Errors
    /// [`Multiplicity`](characteristics::CharacteristicsError::Multiplicity).
    pub fn has_motions(&self) -> Result<(), characteristics::CharacteristicsError> {
        self.degenerate
            .as_ref()
            .map_or(Ok(()), |own| Err(own.error()))
    }

    /// The constraints that are left out because they follow from the others.
    ///
    /// # Errors
    /// When they contradict the others.
    pub fn left_out(
        &self,
        system: &System,
    ) -> Result<Option<LeftOut>, characteristics::CharacteristicsError> {
        let left_out = LeftOut::find(system, &self.terms, &self.selection, &Prover::default());
        if let Some(left_out) = &left_out {
            left_out.check(system)?;
        }
        Ok(left_out)
    }
}
