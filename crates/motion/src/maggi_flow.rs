//! The motion by Maggi's equations: the reduced equations of one chart, compiled; another chart is derived and compiled
//! when the present one degrades.
//!
//! State (q, P); for constraints nonlinear in the velocities (q, v), the dependent velocities brought back to f = 0
//! after each step.

use crate::chart;
use crate::follow::Follow;
use crate::functions::{Functions, FunctionsError};
use crate::initial::ConsistentState;
use crate::least_norm::least_step;
use crate::leaving::Anchor;
use crate::numeric::{Binding, NumericSystem};
use crate::row::RowLayout;
use chetaev_integrate::{ChartChange, Control, EvaluationFailure, HaltReason, System as Flow};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::{
    formulations, Basis, Characteristics, Formulation, MotionTerms, Selection, System,
};
use chetaev_symbolic::{Expr, Symbol};

/// Why Maggi's equations cannot be integrated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaggiError {
    /// The equations cannot be derived.
    #[error(transparent)]
    Derive(#[from] DeriveError),
    /// The equations cannot be compiled.
    #[error(transparent)]
    Functions(#[from] FunctionsError),
}

/// The equations in one chart, compiled.
#[derive(Clone, Debug)]
struct ChartFunctions {
    selection: Selection,
    /// (t, q, P) → velocities, accelerations, rates.
    motion: Functions,
    /// (t, q, v) → P.
    parameters: Functions,
    pivot: f64,
}

/// Maggi's equations as a first-order system.
#[derive(Debug)]
pub struct MaggiFlow<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    binding: &'a Binding,
    numeric: NumericSystem,
    current: ChartFunctions,
    charts: Vec<ChartFunctions>,
    quasi: bool,
    implicit: bool,
    chart_number: u32,
    q: Vec<f64>,
    v: Vec<f64>,
    anchor: Anchor,
    /// Quantities followed at accepted steps.
    pub follow: Option<Follow>,
}

const DEGRADED: f64 = 0.1;
const HYSTERESIS: f64 = 3.0;

impl<'a> MaggiFlow<'a> {
    /// The flow from a consistent state, in the user's quasi-velocities where they fit, else in the independent
    /// velocities of the chart of the start.
    ///
    /// # Errors
    /// [`MaggiError`].
    pub fn new(
        system: &'a System,
        terms: &'a MotionTerms,
        binding: &'a Binding,
        numeric: NumericSystem,
        start: &ConsistentState,
    ) -> Result<MaggiFlow<'a>, MaggiError> {
        let selection = Selection {
            rows: start.chart.rows.clone(),
            dependent: start.chart.dependent.clone(),
        };
        let quasi =
            Characteristics::quasi_velocities(system, terms, &selection).is_some_and(|c| c.is_ok());
        let current = compile(system, terms, binding, selection, start.chart.pivot, quasi)?;
        let mut flow = MaggiFlow {
            follow: None,
            anchor: Anchor::default(),
            implicit: !numeric.is_affine(),
            q: start.q.clone(),
            v: start.v.clone(),
            chart_number: 0,
            charts: Vec::new(),
            system,
            terms,
            binding,
            numeric,
            current,
            quasi,
        };
        flow.settle(start.t);
        Ok(flow)
    }

    /// The state vector of (q, v) at time t.
    ///
    /// # Errors
    /// When P has no finite value.
    pub fn pack(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<Vec<f64>, EvaluationFailure> {
        let mut y = q.to_vec();
        if self.implicit {
            y.extend_from_slice(v);
        } else {
            self.current.parameters.evaluate(t, &[q, v])?;
            y.extend_from_slice(self.current.parameters.group(0));
        }
        Ok(y)
    }

    fn evaluate(&mut self, t: f64, y: &[f64]) -> Result<(), EvaluationFailure> {
        let n = self.numeric.n;
        self.current.motion.evaluate(t, &[&y[..n], &y[n..]])?;
        self.q.copy_from_slice(&y[..n]);
        if self.implicit {
            self.v.copy_from_slice(&y[n..]);
        } else {
            self.v.copy_from_slice(self.current.motion.group(0));
        }
        Ok(())
    }

    /// Chooses a chart at (t, q, v) and enters it when it is better than `worst` by the hysteresis.
    fn rechoose(&mut self, t: f64, y: &mut [f64], factor: f64) -> Control {
        if self.quasi || self.numeric.r == 0 {
            return Control::Continue;
        }
        let (q, v) = (self.q.clone(), self.v.clone());
        if self.numeric.evaluate(t, &q, &v).is_err() {
            return Control::Continue;
        }
        let (numeric, diagonal) = (&self.numeric, self.numeric.mass_diagonal());
        let present = chart::Chart {
            rows: self.current.selection.rows.clone(),
            dependent: self.current.selection.dependent.clone(),
            independent: Vec::new(),
            pivot: self.current.pivot,
            gap: f64::INFINITY,
        };
        let before = chart::quality(
            &present,
            numeric.jacobian(),
            numeric.r,
            numeric.n,
            &diagonal,
        );
        if factor > 1.0 && before >= DEGRADED * self.current.pivot {
            return Control::Continue;
        }
        let next = chart::choose(numeric.jacobian(), numeric.r, numeric.n, &diagonal);
        if next.rank() < present.rank() {
            let constraint = (0..numeric.r)
                .find(|row| !next.rows.contains(row))
                .unwrap_or(0);
            return Control::Stop(HaltReason::RankDrop {
                from: present.rank(),
                to: next.rank(),
                constraint,
            });
        }
        if next.pivot < factor * before || next.dependent == present.dependent {
            return Control::Continue;
        }
        self.enter(t, y, next, before)
    }

    fn enter(&mut self, t: f64, y: &mut [f64], next: chart::Chart, before: f64) -> Control {
        let selection = Selection {
            rows: next.rows.clone(),
            dependent: next.dependent.clone(),
        };
        let known = self.charts.iter().position(|c| c.selection == selection);
        let entered = match known {
            Some(index) => Ok(self.charts.swap_remove(index)),
            None => compile(
                self.system,
                self.terms,
                self.binding,
                selection,
                next.pivot,
                false,
            ),
        };
        let Ok(mut entered) = entered else {
            return Control::Continue;
        };
        entered.pivot = next.pivot;
        let left = std::mem::replace(&mut self.current, entered);
        self.charts.push(left);
        let (q, v) = (self.q.clone(), self.v.clone());
        let Ok(packed) = self.pack(t, &q, &v) else {
            return Control::Continue;
        };
        y.copy_from_slice(&packed);
        self.chart_number += 1;
        Control::ChartSwitched(ChartChange {
            from: self.chart_number - 1,
            to: self.chart_number,
            pivot_before: before,
            pivot_after: next.pivot,
        })
    }

    /// Takes the present (q, v) for a state of the motion, from which constraints with jumps do not jump.
    fn settle(&mut self, t: f64) {
        if !self.numeric.jumps || self.numeric.evaluate(t, &self.q, &self.v).is_err() {
            return;
        }
        let _ = self.numeric.evaluate_positions(t, &self.q, &self.v);
        self.anchor.settle(&self.numeric, t, &self.q, &self.v);
    }

    /// The row of a constraint that lies apart from the last accepted state.
    fn left(&mut self, t: f64) -> Option<usize> {
        let apart = if self.implicit {
            self.numeric.evaluate(t, &self.q, &self.v).ok()?;
            self.anchor.left(&self.numeric, &self.v)
        } else {
            let selection = &self.current.selection;
            self.anchor
                .left_velocity(&self.v, &selection.dependent)
                .map(|index| selection.rows[index])
        };
        if apart.is_some() || self.numeric.holonomic.is_empty() {
            return apart;
        }
        self.numeric.evaluate_positions(t, &self.q, &self.v).ok()?;
        self.anchor.left_position(&self.numeric, &self.q)
    }

    /// Newton on the dependent velocities; true when y changed.
    fn project(&mut self, t: f64, y: &mut [f64]) -> bool {
        let n = self.numeric.n;
        let dependent = self.current.selection.dependent.clone();
        let metric = vec![0.0; n * n];
        let mut changed = false;
        for _ in 0..10 {
            let (q, v) = (self.q.clone(), self.v.clone());
            if self.numeric.evaluate(t, &q, &v).is_err() {
                return false;
            }
            let scale: f64 = v.iter().fold(1e-300, |m, x| m.max(x.abs()));
            if self
                .numeric
                .residual()
                .iter()
                .all(|f| f.abs() <= 8.0 * f64::EPSILON * scale)
            {
                break;
            }
            let step = least_step(
                self.numeric.jacobian(),
                self.numeric.residual(),
                n,
                &dependent,
                &metric,
            );
            self.v.iter_mut().zip(&step).for_each(|(v, dv)| *v -= dv);
            changed = true;
        }
        if changed {
            y[n..].copy_from_slice(&self.v);
        }
        changed
    }
}

fn compile(
    system: &System,
    terms: &MotionTerms,
    binding: &Binding,
    selection: Selection,
    pivot: f64,
    quasi: bool,
) -> Result<ChartFunctions, MaggiError> {
    let characteristics = match Characteristics::quasi_velocities(system, terms, &selection) {
        Some(Ok(found)) if quasi => found,
        _ => Characteristics::independent_velocities(system, terms, &selection)
            .map_err(DeriveError::from)?,
    };
    let basis = Basis {
        system,
        terms,
        selection: &selection,
        characteristics: Some(characteristics.clone()),
    };
    let equations = formulations::Maggi.equations(&basis)?;
    let g = &system.graph;
    let implicit = !characteristics.manifold.implicit.is_empty();
    let mut variables: Vec<Symbol> = vec![g.intern_symbol("t", 0)];
    variables.extend(system.coordinate_symbols());
    if implicit {
        variables.extend(system.velocity_symbols());
    } else {
        variables.extend(characteristics.parameters.iter().map(|p| p.symbol));
    }
    let groups = [
        ("velocities", characteristics.velocities.clone()),
        ("accelerations", equations.accelerations.clone()),
        ("rates", equations.rates.clone()),
    ];
    let definitions: Vec<Expr> = characteristics
        .parameters
        .iter()
        .map(|p| p.definition)
        .collect();
    Ok(ChartFunctions {
        motion: Functions::new(g, binding, &variables, &groups)?,
        parameters: Functions::new(
            g,
            binding,
            &binding.variables,
            &[("parameters", definitions)],
        )?,
        selection,
        pivot,
    })
}

impl Flow for MaggiFlow<'_> {
    fn dimension(&self) -> usize {
        let n = self.numeric.n;
        if self.implicit {
            2 * n
        } else {
            2 * n - self.current.selection.rows.len()
        }
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluate(t, y)?;
        if self.numeric.jumps {
            if let Some(constraint) = self.left(t) {
                return Err(EvaluationFailure::LeftConstraint { constraint });
            }
        }
        let n = self.numeric.n;
        dy[..n].copy_from_slice(&self.v);
        let group = if self.implicit { 1 } else { 2 };
        dy[n..].copy_from_slice(self.current.motion.group(group));
        Ok(())
    }

    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.evaluate(t, y).is_err() {
            return Control::Continue;
        }
        let modified = self.implicit && self.project(t, y);
        let control = match self.rechoose(t, y, HYSTERESIS) {
            Control::Continue if modified => Control::StateModified,
            other => other,
        };
        if let Some(follow) = &mut self.follow {
            follow.record(t, &self.q, &self.v);
        }
        self.settle(t);
        control
    }

    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.evaluate(t, y).is_err() {
            return Control::Continue;
        }
        self.rechoose(t, y, 1.0)
    }

    fn output_dimension(&self) -> usize {
        RowLayout::new(self.numeric.n, self.numeric.r).len()
    }

    fn output(&mut self, t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluate(t, y)?;
        let layout = RowLayout::new(self.numeric.n, self.numeric.r);
        row.fill(0.0);
        row[layout.q()].copy_from_slice(&self.q);
        row[layout.v()].copy_from_slice(&self.v);
        row[layout.a()].copy_from_slice(self.current.motion.group(1));
        Ok(())
    }
}
