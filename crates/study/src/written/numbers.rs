//! The numbers of a model that stand beside its functions in a program: free parameters with their values, and the start of the motion.

use crate::derivation::Derivation;
use crate::free::following;
use crate::start::{own_values, start_state, without_open_controls, StartState};
use crate::StudyError;
use chetaev_mechanics::equations::StateVariable;
use chetaev_mechanics::{formulation, Context, MotionTerms, System};
use chetaev_model::Model;
use chetaev_motion::{jet_flow, Binding};
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// What functions of a system take beside the state, and the numbers that the model states for it.
pub(super) struct Numbers<'a> {
    pub(super) system: &'a System,
    terms: &'a MotionTerms,
    /// The parameters that are arguments.
    pub(super) parameters: Vec<Symbol>,
    /// Those that follow from them.
    following: Vec<(Expr, Expr)>,
    /// Values of parameters, and of all that moves at the start.
    known: BTreeMap<Symbol, f64>,
    /// The start of the motion, where it is known.
    start: Option<StartState>,
    /// Why there is no start.
    pub(super) no_start: Option<String>,
}

impl<'a> Numbers<'a> {
    pub(super) fn of(model: &Model, cx: &Context<'a>) -> Numbers<'a> {
        let (system, g) = (cx.system, &cx.system.graph);
        let following = following(model);
        let is_free = |e: Expr| following.iter().all(|own| own.0 != e);
        let all = system.parameters.iter().filter(|p| is_free(p.expr));
        let mut own = Numbers {
            system,
            terms: cx.terms,
            parameters: all.filter_map(|p| g.as_symbol(p.expr)).collect(),
            following,
            known: BTreeMap::new(),
            start: None,
            no_start: None,
        };
        for p in &system.parameters {
            let value = p.value.and_then(|e| own.number(e));
            own.known.extend(g.as_symbol(p.expr).zip(value));
        }
        match start_state(model, system, (cx.terms, cx.selection)) {
            Ok(start) => {
                own.known.insert(g.intern_symbol("t", 0), start.t);
                own.known
                    .extend(start.state.iter().chain(&start.beyond).copied());
                // Data of a form itself, as the multipliers of an extremum; what has no value stays unknown.
                let stated = own_values(model, system).unwrap_or_default();
                let stated = stated.into_iter();
                own.known
                    .extend(stated.map(|(name, value)| (g.intern_symbol(&name, 0), value)));
                own.start = Some(start);
            }
            // Without constraints the start is what is stated, whatever the other parameters are.
            Err(StudyError::MissingValues { .. }) if system.constraints.is_empty() => own.stated(),
            Err(problem) => own.no_start = Some(problem.to_string()),
        }
        own
    }

    /// Takes what is stated of the start; coordinates and velocities of which nothing is said are zero.
    fn stated(&mut self) {
        let system = self.system;
        self.known.insert(system.graph.intern_symbol("t", 0), 0.0);
        for &(symbol, e) in &system.start {
            let value = self.number(e).unwrap_or(f64::NAN);
            self.known.insert(symbol, value);
        }
        for c in &system.coordinates {
            self.known.entry(c.q_symbol).or_insert(0.0);
            self.known.entry(c.v_symbol).or_insert(0.0);
        }
    }

    fn number(&self, e: Expr) -> Option<f64> {
        let values = self
            .system
            .graph
            .evaluate_f64(&[e], &|s| self.known.get(&s).copied());
        values.ok()?.first().copied().filter(|x| x.is_finite())
    }

    /// The value of a parameter, or of a coordinate or mass at the start.
    pub(super) fn value(&self, symbol: Symbol) -> Option<f64> {
        self.known.get(&symbol).copied().filter(|x| x.is_finite())
    }

    /// Controls without a law, with their derivatives up to the second; they stay as they are along a step.
    pub(super) fn controls(&self) -> Vec<Symbol> {
        let open = self.system.controls.iter().filter(|u| u.law.is_none());
        open.flat_map(|u| (0..=2).map(|order| self.system.graph.intern_symbol(&u.name, order)))
            .collect()
    }

    /// What stands in the place of controls with a law and their derivatives, and of parameters that follow from others.
    pub(super) fn laws(&self) -> Vec<(Expr, Expr)> {
        let g = &self.system.graph;
        let mut laws = self.following.clone();
        for control in &self.system.controls {
            let Some(law) = control.law else { continue };
            let law = g.substitute(law, &self.following);
            for order in 0..=2 {
                let rate = (0..order).fold(law, |e, _| g.total_derivative(e, &|_| false));
                laws.push((g.symbol(&control.name, order), rate));
            }
        }
        laws
    }

    /// `J = m l^2`, a line for each parameter that follows from others and occurs in the expressions.
    pub(super) fn said_to_follow(&self, occurring: &[Expr]) -> Vec<String> {
        let g = &self.system.graph;
        let present = g.symbols_in(occurring);
        let occurs = |e: Expr| g.as_symbol(e).is_some_and(|s| present.contains(&s));
        let own = self.following.iter().filter(|own| occurs(own.0));
        own.map(|&(symbol, value)| format!("{} = {}", g.text(symbol), g.text(value)))
            .collect()
    }

    /// The variables of a form of the equations at the start: by their definitions, else those with which `simulate` starts; none for what the
    /// model does not determine.
    pub(super) fn variables(&self, one: &Derivation) -> Vec<Option<f64>> {
        let variables = &one.equations.variables;
        if self.no_start.is_some() {
            return vec![None; variables.len()];
        }
        let defined: Vec<Option<f64>> = variables.iter().map(|x| self.variable(x)).collect();
        if defined.iter().all(Option::is_some) {
            return defined;
        }
        let solved = self.parameters_of_characteristics(one);
        solved.map_or(defined, |all| all.into_iter().map(Some).collect())
    }

    fn variable(&self, own: &StateVariable) -> Option<f64> {
        self.value(own.symbol)
            .or_else(|| own.definition.and_then(|e| self.number(e)))
    }

    /// The variables where the model states characteristics with parameters of its own: those of the motion that `simulate` computes.
    fn parameters_of_characteristics(&self, one: &Derivation) -> Option<Vec<f64>> {
        let start = self.start.as_ref()?;
        let system = without_open_controls(self.system, self.terms);
        let binding = Binding::new(&system).ok()?;
        let parts = jet_flow::Parts {
            formulation: formulation(one.card.name)?,
            system: &system,
            terms: self.terms,
            binding: &binding,
        };
        let mut known = [&start.state[..], &start.beyond[..]].concat();
        let variables = one.equations.variables.iter();
        let symbols: Vec<Symbol> = variables.map(|x| x.symbol).collect();
        let stated = symbols
            .iter()
            .filter(|s| known.iter().all(|own| own.0 != **s));
        let stated: Vec<(Symbol, f64)> =
            stated.filter_map(|&s| Some((s, self.value(s)?))).collect();
        known.extend(stated);
        parts
            .at_start(&one.equations, start.t, &known, &symbols)
            .ok()
    }
}
