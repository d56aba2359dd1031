//! The parts on which the claims of a study are asked, and what is said of them together.
//!
//! A claim is decided in a [`Context`], for one system. What a user writes may be several: constraints that are products have
//! components, and values that the model states for parameters may be exceptional, so that another thing is true of them than of
//! others. Each part is a system with a context of its own, in which hypotheses are decided too; [`Verdict::union`] joins the
//! verdicts. Components are known beforehand. Values split where a test of a claim is answered otherwise at them
//! ([`Exceptional`](crate::prover::Exceptional)): the claim is then asked once more, and only then.
//!
//! Parameters that are stated to be zero, and those that others define, have these values for all claims.

use super::{full_id, Claim, Context, Finding, Formula, Group, Prepared, Registry, Scope};
use crate::components::{self, covered, Stratum};
use crate::prover::Prover;
use crate::system::System;
use chetaev_symbolic::verdict::Part;
use chetaev_symbolic::{Expr, Graph, Verdict};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// At most so many sets of exceptional values are looked at in a study: each derives the terms of a system anew.
const EXCEPTIONS: usize = 8;

/// Whether functions of the state vanish where a motion starts, for a system; `None` where the start is not known.
pub type VanishAtStart<'f> = dyn Fn(&System, &[Expr]) -> Option<bool> + 'f;

/// A system with its terms.
#[derive(Debug)]
struct Owned {
    system: System,
    prepared: Prepared,
}

impl Owned {
    fn of(system: Option<System>) -> Option<Owned> {
        let system = system?;
        let prepared = Prepared::new(&system).ok()?;
        Some(Owned { system, prepared })
    }
}

/// A component of the constraints with its terms.
#[derive(Debug)]
struct Component {
    on: Stratum,
    prepared: Prepared,
}

/// The systems for some values that the model states: the whole, and its components.
#[derive(Debug)]
struct Family {
    /// `None` where no value is stated, and the system is the one that was written.
    whole: Option<Owned>,
    /// The values, in words.
    values: Option<String>,
    components: Vec<Component>,
    /// The component of the start.
    start: usize,
    /// Whether one choice of independent velocities describes not all of them.
    is_covered_in_part: bool,
    /// Whether holonomic constraints are products.
    has_positions_apart: bool,
}

/// The systems that the claims of a study are asked of; contexts borrow from it.
#[derive(Debug)]
pub struct Grounds<'a> {
    written: (&'a System, &'a Prepared),
    /// For any controls first; with their laws last, where the model states some.
    families: Vec<Family>,
    exceptions: [OnceLock<Owned>; EXCEPTIONS],
}

impl<'a> Grounds<'a> {
    /// The systems for a model; `at_start` says whether functions of the state vanish where the motion starts, if that is known.
    pub fn new(
        system: &'a System,
        prepared: &'a Prepared,
        at_start: &VanishAtStart<'_>,
    ) -> Grounds<'a> {
        let written = (system, prepared);
        let family = |values: Vec<(Expr, Expr)>, own: Option<System>| {
            let whole = Owned::of(own);
            let values = whole.is_some().then(|| equations(&system.graph, &values));
            Family::new(written, whole, values, at_start)
        };
        let mut families = vec![family(system.stated_zeros(), system.for_stated_zeros())];
        if !system.laws_of_controls().is_empty() {
            families.push(family(system.stated_values(), system.for_stated_values()));
        }
        Grounds {
            written,
            families,
            exceptions: Default::default(),
        }
    }

    /// A system for exceptional values, as long as there is room.
    fn exception(&self, system: System) -> Option<&Owned> {
        let mut own = Owned::of(Some(system));
        for place in &self.exceptions {
            let Some(owned) = own.take() else { break };
            match place.set(owned) {
                Ok(()) => return place.get(),
                Err(back) => own = Some(back),
            }
        }
        None
    }
}

impl Family {
    fn new(
        written: (&System, &Prepared),
        whole: Option<Owned>,
        values: Option<String>,
        at_start: &VanishAtStart<'_>,
    ) -> Family {
        let (system, prepared) = match &whole {
            Some(owned) => (&owned.system, &owned.prepared),
            None => written,
        };
        let is_covered_in_part = covered(system, &prepared.terms, &prepared.selection).is_some();
        let has_positions_apart = system.has_positions_apart();
        let found = components::distinct(system, &Prover::default());
        let start = components::of_start(&found, |list| at_start(system, list));
        let components = found.into_iter();
        let components = components.map(|(on, prepared)| Component { on, prepared });
        Family {
            components: components.collect(),
            start,
            is_covered_in_part,
            has_positions_apart,
            whole,
            values,
        }
    }

    fn whole<'a>(&'a self, written: (&'a System, &'a Prepared)) -> (&'a System, &'a Prepared) {
        match &self.whole {
            Some(owned) => (&owned.system, &owned.prepared),
            None => written,
        }
    }

    /// Whether what has this scope is asked on each component by itself.
    fn splits(&self, scope: Scope) -> bool {
        let is_simpler = || matches!(&self.components[..], [one] if one.on.condition.is_none());
        !self.components.is_empty()
            && match scope {
                Scope::Functions => false,
                Scope::Equations => self.is_covered_in_part,
                Scope::Motions => {
                    self.is_covered_in_part || self.has_positions_apart || is_simpler()
                }
                Scope::Components | Scope::Run => true,
            }
    }
}

/// Of which system a context is: of the whole (`None`) or of a component.
type Place = (usize, Option<usize>);

/// Another context for a place and parameters with exceptional values; `None` where there is no system for them.
type Exception<'a> = ((Place, Vec<(Expr, Expr)>), Option<Arc<Context<'a>>>);

/// Where claims are asked.
pub struct Strata<'a> {
    grounds: &'a Grounds<'a>,
    contexts: Vec<(Place, Arc<Context<'a>>)>,
    make: Box<dyn Fn(&'a System, &'a Prepared) -> Context<'a> + 'a>,
    exceptions: Mutex<Vec<Exception<'a>>>,
}

impl<'a> Strata<'a> {
    /// The contexts for all systems; `with` adds data of a higher layer to each.
    pub fn new(
        grounds: &'a Grounds<'a>,
        registry: &'a Registry,
        prover: impl Fn() -> Prover + 'a,
        with: impl Fn(Context<'a>) -> Context<'a> + 'a,
    ) -> Strata<'a> {
        let make = move |system: &'a System, prepared: &'a Prepared| {
            let (terms, selection) = (&prepared.terms, &prepared.selection);
            let cx = Context::new(system, terms, selection, registry, prover());
            with(cx.where_degenerate(grounds.written.1))
        };
        let mut strata = Strata {
            grounds,
            contexts: Vec::new(),
            make: Box::new(make),
            exceptions: Mutex::default(),
        };
        let motions = strata.places(Scope::Motions, 0);
        let motions = (0, motions.get(grounds.families[0].start).copied().flatten());
        let last = grounds.families.len() - 1;
        for family in 0..=last {
            let components = 0..grounds.families[family].components.len();
            for own in [None].into_iter().chain(components.map(Some)) {
                let (system, prepared) = strata.system_at((family, own));
                let mut context = (strata.make)(system, prepared);
                if let Some(of) = strata.at(motions) {
                    context = context.with_motions_of(Arc::clone(of));
                }
                strata.contexts.push(((family, own), Arc::new(context)));
            }
        }
        strata
    }

    fn system_at(&self, (family, component): Place) -> (&'a System, &'a Prepared) {
        let own: &'a Family = &self.grounds.families[family];
        match component {
            Some(place) => {
                let own = &own.components[place];
                (&own.on.system, &own.prepared)
            }
            None => own.whole(self.grounds.written),
        }
    }

    fn at(&self, place: Place) -> Option<&Arc<Context<'a>>> {
        let own = self.contexts.iter().find(|(own, _)| *own == place);
        own.map(|(_, context)| context)
    }

    /// The components on which what has this scope is asked by itself; the whole alone where it is not.
    fn places(&self, scope: Scope, family: usize) -> Vec<Option<usize>> {
        let own = &self.grounds.families[family];
        match own.splits(scope) {
            true if scope == Scope::Run => vec![Some(own.start)],
            true => (0..own.components.len()).map(Some).collect(),
            false => vec![None],
        }
    }

    fn family(&self, claim: &dyn Claim) -> usize {
        if claim.is_for_any_controls() {
            0
        } else {
            self.grounds.families.len() - 1
        }
    }

    /// The context in which a claim is asked, where there is one alone; of the component of the start, where there are more.
    pub fn context(&self, claim: &dyn Claim) -> &Context<'a> {
        let family = self.family(claim);
        let places = self.places(claim.scope(), family);
        let own = places
            .iter()
            .find(|own| **own == Some(self.grounds.families[family].start));
        let own = own.or(places.first()).copied().flatten();
        self.at((family, own)).unwrap_or(&self.contexts[0].1)
    }

    /// Says that the time for claims is spent: what takes long is not begun any more.
    pub fn spend_time(&self) {
        for (_, context) in &self.contexts {
            context.spend_time();
        }
        let exceptions = self.exceptions.lock();
        let exceptions = exceptions.unwrap_or_else(PoisonError::into_inner);
        for context in exceptions
            .iter()
            .filter_map(|(_, context)| context.as_ref())
        {
            context.spend_time();
        }
    }

    /// Forgets what was being decided when that was stopped.
    pub fn abandon(&self) {
        for (_, context) in &self.contexts {
            context.abandon();
        }
        let exceptions = self.exceptions.lock();
        let exceptions = exceptions.unwrap_or_else(PoisonError::into_inner);
        for (_, context) in exceptions.iter() {
            if let Some(context) = context {
                context.abandon();
            }
        }
    }

    /// Decides a claim on all parts on which it is asked.
    pub fn finding(&self, claim: &dyn Claim, subject: Option<&str>) -> Finding {
        let family = self.family(claim);
        let own = &self.grounds.families[family];
        let first = self.context(claim);
        let places = self.places(claim.scope(), family);
        let is_alone = places.len() == 1;
        let parts = places.into_iter().filter_map(|component| {
            let there = self.at((family, component))?;
            let mut finding = self.for_values(claim, subject, (family, component), (first, there));
            let Some(component) = component else {
                return Some((String::new(), String::new(), finding));
            };
            let on = &own.components[component].on;
            let condition = on.condition.clone().unwrap_or_default();
            if is_alone && claim.group() != Group::Motion {
                finding.verdict.prefix(&on.sentence);
            }
            Some((format!("where {condition}"), condition, finding))
        });
        let mut finding = union(parts.collect());
        if let (Some(values), true) = (&own.values, claim.group() != Group::Motion) {
            let sentence = format!("for {values}, as the model states it");
            finding.verdict.prefix(&sentence);
        }
        finding
    }

    /// A claim at one place, for general values of the parameters and for those stated that are exceptional.
    fn for_values(
        &self,
        claim: &dyn Claim,
        subject: Option<&str>,
        place: Place,
        (first, there): (&Context<'a>, &Context<'a>),
    ) -> Finding {
        let decide = |there: &Context<'a>| {
            if std::ptr::eq(first, there) {
                Finding::clone(&there.finding(&full_id(claim.id(), subject)))
            } else {
                claim.decide_there(first, subject, there)
            }
        };
        let before = there.prover.exceptional.take();
        let general = decide(there);
        let noticed = there.prover.exceptional.take();
        there.prover.exceptional.add(before);
        if noticed.stated.is_empty() || !claim.is_asked_of_values() {
            return general;
        }
        let values = together(there.system, &noticed.stated);
        let Some(exception) = self.exception(place, &values) else {
            return general;
        };
        let stated = decide(&exception);
        if claim.scope() == Scope::Run {
            return stated;
        }
        let g = &there.system.graph;
        let equal = equations(g, &values);
        let mut elsewhere = vec![unlike(g, &values)];
        let mut parts = vec![(format!("for {equal}, as the model states"), equal, stated)];
        // Other values at which the general verdict does not hold.
        let others = noticed.others.iter().filter(|pair| !values.contains(pair));
        for pair in others {
            let Some(exception) = self.exception(place, &[*pair]) else {
                continue;
            };
            let own = decide(&exception);
            if own.verdict.word() != general.verdict.word() && !is_open(&own.verdict) {
                let equal = equations(g, &[*pair]);
                parts.push((format!("for {equal}"), equal, own));
                elsewhere.push(unlike(g, &[*pair]));
            }
        }
        let place = "for general values of the parameters";
        parts.push((place.into(), elsewhere.join(" and "), general));
        union(parts)
    }

    /// The context at a place for these values.
    fn exception(&self, place: Place, values: &[(Expr, Expr)]) -> Option<Arc<Context<'a>>> {
        let key = (place, values.to_vec());
        let known = || {
            self.exceptions
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
        };
        let recalled = known()
            .iter()
            .find(|(own, _)| *own == key)
            .map(|(_, c)| c.clone());
        if let Some(recalled) = recalled {
            return recalled;
        }
        let of = self.at(place)?;
        let system = of.system.with_parameters(values);
        let owned: Option<&'a Owned> = system.and_then(|system| self.grounds.exception(system));
        let context = owned.map(|own| {
            let mut context = (self.make)(&own.system, &own.prepared);
            let motions = of.of_motions.as_ref().unwrap_or(of);
            context.of_motions = Some(Arc::clone(motions));
            if of.is_out_of_time() {
                context.spend_time();
            }
            Arc::new(context)
        });
        known().push((key, context.clone()));
        context
    }
}

/// A part with what was found on it: the place in words, its condition, the finding.
type Asked = (String, String, Finding);

/// One finding for all parts, with the formulas of each; those that all share once.
fn union(parts: Vec<Asked>) -> Finding {
    let parts: Vec<Asked> = match <[Asked; 1]>::try_from(parts) {
        Ok([(_, _, finding)]) => return finding,
        Err(parts) => parts,
    };
    let mut formulas: Vec<Formula> = Vec::new();
    let same =
        |a: &Formula, b: &Formula| (a.left, a.right) == (b.left, b.right) && a.caption == b.caption;
    for (place, _, finding) in &parts {
        for formula in &finding.formulas {
            let has = |(_, _, other): &Asked| other.formulas.iter().any(|f| same(f, formula));
            let is_shared = parts.iter().all(has);
            if is_shared && formulas.iter().any(|f| same(f, formula)) {
                continue;
            }
            let caption = if is_shared {
                formula.caption.clone()
            } else {
                format!("{place}: {}", formula.caption)
            };
            formulas.push(Formula {
                caption,
                ..*formula
            });
        }
    }
    let parts = parts.into_iter().map(|(place, condition, finding)| Part {
        place,
        condition,
        verdict: finding.verdict,
    });
    Finding {
        verdict: Verdict::union(parts.collect()),
        formulas,
    }
}

fn is_open(verdict: &Verdict) -> bool {
    matches!(
        verdict,
        Verdict::Undecided { .. } | Verdict::NotApplicable { .. }
    )
}

/// The conditions under which values are exceptional, put in together: each parameter is given once, by what is not given itself; the
/// values stated where the conditions do not show this.
fn together(system: &System, stated: &BTreeSet<(Expr, Expr)>) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let given: BTreeSet<Expr> = stated.iter().map(|&(parameter, _)| parameter).collect();
    let is_free =
        |&(_, value): &(Expr, Expr)| given.iter().all(|&p| !g.reachable(&[value]).contains(&p));
    if given.len() == stated.len() && stated.iter().all(is_free) {
        return stated.iter().copied().collect();
    }
    let all: Vec<Expr> = stated.iter().flat_map(|&(p, value)| [p, value]).collect();
    let occurring = g.reachable(&all);
    let mut values = system.parameter_values();
    values.retain(|(parameter, _)| occurring.contains(parameter));
    values
}

/// Where a condition on parameters does not hold. Several values are exceptional together by a relation that is not known: of what else
/// satisfies it nothing is said.
fn unlike(g: &Graph, values: &[(Expr, Expr)]) -> String {
    match values {
        [_] => related(g, values, " ≠ ", " or "),
        _ => format!(
            "the parameters have general values, not {}",
            equations(g, values)
        ),
    }
}

/// `k = 1 and b = 2`.
fn equations(g: &Graph, values: &[(Expr, Expr)]) -> String {
    related(g, values, " = ", " and ")
}

/// The pairs related in this way, as `k ≠ 1 or b ≠ 2`.
fn related(g: &Graph, values: &[(Expr, Expr)], relation: &str, and: &str) -> String {
    let texts = values.iter();
    let texts = texts.map(|&(p, value)| format!("{}{relation}{}", g.text(p), g.text(value)));
    texts.collect::<Vec<String>>().join(and)
}
