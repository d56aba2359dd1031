//! Motions of constraints that are products: on the component on which they start.
//!
//! `(y − x²)(y + x) = 0` holds on two curves, and a motion stays on the one on which it starts as long as its state lies on no other. So
//! it is computed with the factor that vanishes, whose gradient does not where the curves cross: no method and no tolerance takes
//! another branch. The multiplier of the constraint as stated is that of the factor over what the factor is multiplied by. Where a state
//! of the motion lies on another component too, both contain the motion so far, and it is not determined beyond: the other factor
//! is zero there, and with it its rate, where it is a function of the place alone (velocities are continuous).

use crate::chart::{self, Floor};
use crate::factors::{on_component, Factor};
use crate::follow;
use crate::initial::{consistent_state, ConsistentState, InitialData};
use crate::numeric::{Binding, NumericSystem};
use crate::run::{Run, Subject};
use chetaev_mechanics::{MotionTerms, Selection, System};
use chetaev_symbolic::{Expr, Symbol};

/// Rounding of a state, as a part of its natural size.
const ROUNDED: f64 = 1e-13;
/// A system on the component of its constraints on which a motion starts.
#[derive(Clone, Debug)]
pub struct Component {
    system: System,
    terms: MotionTerms,
    selection: Selection,
    numeric: NumericSystem,
    start: ConsistentState,
    factors: Vec<Factor>,
}

impl Component {
    /// That of a subject; `None` where no constraint is a product, where the start lies on more than one component, and for constraints of order
    /// two and more.
    pub fn of_start(subject: &Subject<'_>) -> Option<Component> {
        if subject.terms.order > 1 {
            return None;
        }
        let vanishes = |e: Expr| vanishes(subject, e);
        let (system, factors) = on_component(subject.system, &vanishes)?;
        let (terms, mut numeric) = numeric(&system, subject.binding)?;
        let start = subject.start;
        numeric.evaluate(start.t, &start.q, &start.v).ok()?;
        let chart = chart::choose(
            numeric.jacobian(),
            (numeric.r, numeric.n),
            &numeric.mass_diagonal(),
            Floor::Along(1.0),
        );
        let is_same = chart.rank() == start.chart.rank() && numeric.r == subject.numeric.r;
        let start = ConsistentState {
            chart,
            ..start.clone()
        };
        is_same.then(|| Component::new(system, (terms, numeric), start, factors))
    }

    fn new(
        system: System,
        (terms, numeric): (MotionTerms, NumericSystem),
        start: ConsistentState,
        factors: Vec<Factor>,
    ) -> Component {
        let selection = Selection {
            rows: start.chart.rows.clone(),
            dependent: start.chart.dependent.clone(),
        };
        Component {
            system,
            terms,
            selection,
            numeric,
            start,
            factors,
        }
    }

    /// A system on a component, from the last state of a run on.
    pub(crate) fn from_last(
        system: System,
        subject: &Subject<'_>,
        run: &Run,
        factors: Vec<Factor>,
    ) -> Option<Component> {
        let (terms, mut numeric) = numeric(&system, subject.binding)?;
        let row = run.row(run.len().checked_sub(1)?);
        // What is rounding beside the natural sizes is zero: else it would be taken for a size.
        let sizes = run.scales.iter();
        let state = row[..run.layout.v().end].iter().zip(sizes);
        let state = state.map(|(&x, size)| if x.abs() <= ROUNDED * size { 0.0 } else { x });
        let state: Vec<f64> = state.collect();
        let data = InitialData {
            t: *run.times.last()?,
            q: state.get(run.layout.positions())?.to_vec(),
            v: state.get(run.layout.v())?.to_vec(),
            q_fixed: vec![false; numeric.n],
            v_fixed: vec![false; numeric.n],
            project: true,
        };
        let start = consistent_state(&mut numeric, &data).ok()?;
        Some(Component::new(system, (terms, numeric), start, factors))
    }

    /// The subject on the component.
    pub fn subject<'a>(&'a self, binding: &'a Binding) -> Subject<'a> {
        Subject {
            system: &self.system,
            terms: &self.terms,
            selection: &self.selection,
            binding,
            numeric: &self.numeric,
            start: &self.start,
            factors: &self.factors,
        }
    }

    /// The system on it, with its terms and selection.
    pub fn into_system(self) -> (System, MotionTerms, Selection) {
        (self.system, self.terms, self.selection)
    }

    /// What is said of it: the component by constraint.
    pub fn in_words(&self) -> String {
        let g = &self.system.graph;
        let all = self.factors.iter().map(|own| {
            let name = &self.system.constraints[own.constraint].name;
            format!("{} = 0 of `{name}`", g.text(own.function))
        });
        all.collect::<Vec<String>>().join(" and ")
    }
}

fn numeric(system: &System, binding: &Binding) -> Option<(MotionTerms, NumericSystem)> {
    let terms = MotionTerms::new(system);
    let numeric = NumericSystem::new(system, &terms, binding).ok()?;
    Some((terms, numeric))
}

/// Whether a function vanishes at the start beside its terms.
pub(crate) fn vanishes(subject: &Subject<'_>, e: Expr) -> Option<bool> {
    let (system, start) = (subject.system, subject.start);
    let g = &system.graph;
    let e = g.substitute(system.defined(e), &subject.binding.controls);
    let variables = subject.binding.variables.iter().copied();
    let values = std::iter::once(start.t).chain(start.q.iter().chain(&start.v).copied());
    let known: Vec<(Symbol, f64)> = variables.zip(values).collect();
    let parameters = &subject.binding.parameters;
    let value = |s: Symbol| {
        let mut all = known.iter().chain(parameters);
        all.find(|own| own.0 == s).map(|own| own.1)
    };
    follow::vanishes(g, e, &value)
}
