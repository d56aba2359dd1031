//! The numbers of a model that stand beside its functions in a program: free parameters with their values, and the start of the motion.

use crate::derivation::Derivation;
use crate::free::following;
use crate::start::{start_state, StartState};
use crate::StudyError;
use chetaev_mechanics::equations::StateVariable;
use chetaev_mechanics::{Context, System};
use chetaev_model::Model;
use chetaev_motion::least_squares;
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// What functions of a system take beside the state, and the numbers that the model states for it.
pub(super) struct Numbers<'a> {
    pub(super) system: &'a System,
    /// The parameters that are arguments.
    pub(super) parameters: Vec<Symbol>,
    /// Those that follow from them.
    following: Vec<(Expr, Expr)>,
    /// Values of parameters, and of all that moves at the start.
    known: BTreeMap<Symbol, f64>,
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
            parameters: all.filter_map(|p| g.as_symbol(p.expr)).collect(),
            following,
            known: BTreeMap::new(),
            no_start: None,
        };
        for p in &system.parameters {
            let value = p.value.and_then(|e| own.number(e));
            own.known.extend(g.as_symbol(p.expr).zip(value));
        }
        match start_state(model, system, (cx.terms, cx.selection)) {
            Ok(StartState { t, state, beyond }) => {
                own.known.insert(g.intern_symbol("t", 0), t);
                own.known.extend(state.into_iter().chain(beyond));
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

    /// The variables of a form of the equations at the start: by their definitions, else those with the velocities of the start.
    pub(super) fn variables(&self, one: &Derivation) -> Vec<Option<f64>> {
        let variables = &one.equations.variables;
        let missing = || vec![None; variables.len()];
        if self.no_start.is_some() {
            return missing();
        }
        let defined: Vec<Option<f64>> = variables.iter().map(|x| self.variable(x)).collect();
        if defined.iter().all(Option::is_some) {
            return defined;
        }
        let solved = self.speeds(one);
        solved.map_or_else(missing, |all| all.into_iter().map(Some).collect())
    }

    fn variable(&self, own: &StateVariable) -> Option<f64> {
        self.value(own.symbol)
            .or_else(|| own.definition.and_then(|e| self.number(e)))
    }

    /// The speeds whose velocities are nearest to those of the start: what no velocity depends on is zero.
    fn speeds(&self, one: &Derivation) -> Option<Vec<f64>> {
        let (g, system, equations) = (&self.system.graph, self.system, &one.equations);
        let symbols: Vec<Symbol> = equations.variables.iter().map(|x| x.symbol).collect();
        let mut lookup = self.known.clone();
        lookup.extend(symbols.iter().map(|&s| (s, 0.0)));
        let value = |es: &[Expr]| {
            let values = g.evaluate_f64(es, &|s| lookup.get(&s).copied()).ok()?;
            values.iter().all(|x| x.is_finite()).then_some(values)
        };
        let slopes = g.jacobian(&equations.velocities, &symbols);
        if g.any_contains_any(&slopes.concat(), &symbols) {
            return None;
        }
        let rest = value(&equations.velocities)?;
        let given = system.coordinates.iter().map(|c| self.value(c.v_symbol));
        let given: Vec<f64> = given.collect::<Option<_>>()?;
        let right: Vec<f64> = given.iter().zip(rest).map(|(v, rest)| v - rest).collect();
        let all: Vec<usize> = (0..symbols.len()).collect();
        let matrix = value(&slopes.concat())?;
        Some(least_squares(&matrix, &right, symbols.len(), &all))
    }
}
