//! The equations of a formulation on a jet for one selection of dependent derivatives: derived, compiled, and what makes them
//! singular.

use crate::chart::{self, Chart, DEGRADED};
use crate::formulation_flow::{rates_of_state, FlowError};
use crate::functions::Functions;
use crate::initial::jets::JetStart;
use crate::initial::ConsistentState;
use crate::least_norm::least_squares;
use crate::numeric::Binding;
use crate::series::RateSeries;
use crate::watch::{masses_and_speeds, vanishing_parts, Watch, Watched};
use chetaev_mechanics::words::quoted;
use chetaev_mechanics::{Basis, Equations, Formulation, MotionTerms, Selection, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// Determinants of larger systems are not watched.
const LARGEST_WATCHED: usize = 5;

/// The equations for one selection of dependent derivatives, compiled.
#[derive(Clone, Debug)]
pub(super) struct Compiled {
    pub(super) selection: Selection,
    /// The state: coordinates, masses with a law of their own, then the variables.
    pub(super) symbols: Vec<Symbol>,
    pub(super) names: Vec<String>,
    /// (t, state) → q', rates of the variables, derivatives of orders 2 to m, rates of the masses.
    pub(super) motion: Functions,
    /// (t, state) → what vanishes, and its gradient by the state.
    pub(super) invariants: Functions,
    pub(super) pivot: f64,
    /// The rates of the state, and their Taylor recurrences, made when first asked for.
    pub(super) rates: Vec<Expr>,
    pub(super) series: Option<RateSeries>,
}

/// What a flow is made of.
#[derive(Clone, Copy)]
pub struct Parts<'a> {
    /// The formulation.
    pub formulation: &'static dyn Formulation,
    /// The system.
    pub system: &'a System,
    /// Its terms.
    pub terms: &'a MotionTerms,
    /// Values of parameters.
    pub binding: &'a Binding,
}

impl Parts<'_> {
    /// The equations of the formulation for a selection, and compiled.
    pub(super) fn compile(
        self,
        selection: Selection,
        pivot: f64,
    ) -> Result<(Equations, Compiled), FlowError> {
        let (system, g) = (self.system, &self.system.graph);
        let basis = Basis {
            system,
            terms: self.terms,
            selection: &selection,
            characteristics: None,
        };
        let equations = self.formulation.equations(&basis)?;
        let mut symbols = system.coordinate_symbols();
        symbols.extend(system.masses.iter().map(|m| m.symbol));
        symbols.extend(equations.variables.iter().map(|x| x.symbol));
        let mut names: Vec<String> = system.coordinates.iter().map(|c| c.name.clone()).collect();
        names.extend(system.masses.iter().map(|m| m.name.clone()));
        names.extend(equations.variables.iter().map(|x| x.name.clone()));
        let variables = with_time(g, &symbols);
        let mut higher = Vec::new();
        for order in 2..self.terms.order {
            higher.extend(system.coordinates.iter().map(|c| g.symbol(&c.name, order)));
        }
        higher.extend(match self.terms.order {
            1 => &equations.accelerations,
            _ => &equations.highest,
        });
        let groups = [
            ("velocities", equations.velocities.clone()),
            ("rates", equations.rates()),
            ("higher", higher),
            (
                "masses",
                equations.masses.iter().map(|(_, rate)| *rate).collect(),
            ),
        ];
        let vanishing = equations.conditions.iter().map(|c| c.value);
        let implicit = equations.relations.iter().map(|(f, _)| *f);
        let invariants: Vec<Expr> = vanishing.chain(implicit).collect();
        let gradient = g.jacobian(&invariants, &symbols).concat();
        let invariants = [("invariants", invariants), ("gradient", gradient)];
        let compiled = Compiled {
            motion: Functions::new(g, self.binding, &variables, &groups)?,
            invariants: Functions::new(g, self.binding, &variables, &invariants)?,
            selection,
            symbols,
            names,
            pivot,
            rates: rates_of_state(&equations),
            series: None,
        };
        Ok((equations, compiled))
    }

    /// The values of symbols of the state at the start: those that are known, and parameters that the user's formulas introduce, which are solved
    /// for.
    ///
    /// # Errors
    /// [`FlowError::MissingData`] for what the derivatives do not depend on; [`FlowError::Start`] where no solution is found.
    pub fn at_start(
        self,
        equations: &Equations,
        t: f64,
        known: &[(Symbol, f64)],
        symbols: &[Symbol],
    ) -> Result<Vec<f64>, FlowError> {
        let value = |s: &Symbol| known.iter().find(|(own, _)| own == s).map(|(_, x)| *x);
        let own = symbols.iter().copied();
        let open: Vec<Symbol> = own.filter(|s| value(s).is_none()).collect();
        let mut found = Vec::new();
        if !open.is_empty() {
            found = self.parameters(equations, t, known, &open)?;
        }
        let of = |s: &Symbol| {
            let own = open.iter().position(|o| o == s).map(|place| found[place]);
            value(s).or(own).unwrap_or(0.0)
        };
        Ok(symbols.iter().map(of).collect())
    }

    /// The derivatives of the highest order as functions of the state, q' for order one.
    fn characteristics(self, equations: &Equations) -> &[Expr] {
        if self.terms.order == 1 {
            return &equations.velocities;
        }
        let stated = equations.on_characteristics.as_ref();
        stated.map_or(&equations.highest, |(own, _)| &own.velocities)
    }

    /// Parameters P with `φ(t, …, P) = q^(m)` at the start, by Newton's method from several starting points.
    fn parameters(
        self,
        equations: &Equations,
        t: f64,
        known: &[(Symbol, f64)],
        open: &[Symbol],
    ) -> Result<Vec<f64>, FlowError> {
        let g = &self.system.graph;
        let formulation = self.formulation.card().name;
        let phi = self.characteristics(equations).to_vec();
        let present = g.symbols_in(&phi);
        let missing: Vec<Symbol> = (open.iter().copied())
            .filter(|s| !present.contains(s))
            .collect();
        if !missing.is_empty() {
            return Err(FlowError::MissingData {
                formulation,
                names: quoted(missing.into_iter().map(|s| g.symbol_text(s))),
            });
        }
        let value = |s: Symbol| known.iter().find(|(own, _)| *own == s).map(|(_, x)| *x);
        let jets = self.terms.jets.iter();
        let targets: Vec<f64> = jets.map(|c| value(c.v_symbol).unwrap_or(0.0)).collect();
        let (symbols, numbers): (Vec<Symbol>, Vec<f64>) = known.iter().copied().unzip();
        let variables = with_time(g, &[&symbols[..], open].concat());
        let gradient = g.jacobian(&phi, open).concat();
        let groups = [("phi", phi), ("gradient", gradient)];
        let mut functions = Functions::new(g, self.binding, &variables, &groups)?;
        let mut evaluate = |x: &[f64]| {
            functions.evaluate(t, &[&numbers, x]).ok()?;
            Some((functions.group(0).to_vec(), functions.group(1).to_vec()))
        };
        solved(&mut evaluate, &targets, open.len()).ok_or(FlowError::Start { formulation })
    }

    /// w and A as functions of t, masses, q, …, q^(m) (and q'' for m = 1).
    pub(super) fn reactions(self) -> Result<Functions, FlowError> {
        let (system, g) = (self.system, &self.system.graph);
        let highest = self.terms.order.max(2);
        let mut symbols: Vec<Symbol> = system.masses.iter().map(|m| m.symbol).collect();
        symbols.extend((0..=highest).flat_map(|order| {
            let own = system.coordinates.iter();
            own.map(move |c| g.intern_symbol(&c.name, order))
        }));
        let groups = [
            ("w", system.motion_left_sides()),
            ("gradient", self.terms.jacobian.concat()),
        ];
        let variables = with_time(g, &symbols);
        Ok(Functions::new(g, self.binding, &variables, &groups)?)
    }

    /// The derivatives of order m, in quotes.
    pub(super) fn unknowns(self) -> String {
        let jets = self.terms.jets.iter();
        quoted(jets.map(|c| self.system.graph.symbol_text(c.v_symbol)))
    }

    pub(super) fn watch(
        self,
        equations: &Equations,
        compiled: &Compiled,
    ) -> Result<Watch, FlowError> {
        let variables = with_time(&self.system.graph, &compiled.symbols);
        let watched = self.watched(equations, compiled);
        Ok(Watch::of_state(
            self.system,
            self.binding,
            &variables,
            watched,
        )?)
    }

    /// The selection wanted, unless another one is much better conditioned at the start.
    pub(super) fn selection_at(
        self,
        reactions: &mut Functions,
        wanted: &Selection,
        start: &ConsistentState,
        jets: &JetStart,
    ) -> Selection {
        let (system, terms) = (self.system, self.terms);
        let (n, r) = (system.n(), terms.constraints.len());
        let value = |symbol: Symbol| {
            jets.values
                .iter()
                .find(|(s, _)| *s == symbol)
                .map(|(_, x)| *x)
        };
        let mut state = [&start.q[..], &start.v[..]].concat();
        for order in 2..=terms.order.max(2) {
            let own = system.coordinates.iter();
            state.extend(own.map(|c| {
                let symbol = system.graph.intern_symbol(&c.name, order);
                value(symbol).unwrap_or(0.0)
            }));
        }
        if r == 0 || reactions.evaluate(start.t, &[&state]).is_err() {
            return wanted.clone();
        }
        let (a, unit) = (reactions.group(1), vec![1.0; n]);
        let best = chart::choose(a, (r, n), &unit, chart::Floor::Along(1.0));
        let present = Chart {
            rows: wanted.rows.clone(),
            dependent: wanted.dependent.clone(),
            independent: Vec::new(),
            pivot: 1.0,
            gap: f64::INFINITY,
        };
        let poor = chart::quality(&present, a, n, |_| 1.0) < DEGRADED * best.pivot;
        match poor && best.rank() == wanted.rows.len() {
            true => Selection {
                rows: best.rows,
                dependent: best.dependent,
            },
            false => wanted.clone(),
        }
    }

    /// `det A Aᵀ`, zero where the rank of the constraints falls. The equations may hide it: where their right sides vanish,
    /// the determinant of their matrix is gone from the solution.
    fn gram(self, rows: &[usize]) -> Option<Expr> {
        let g = &self.system.graph;
        if rows.is_empty() || rows.len() > LARGEST_WATCHED {
            return None;
        }
        let product = |a: &[Expr], b: &[Expr]| {
            let pairs = a.iter().zip(b);
            g.add(&pairs.map(|(&a, &b)| g.mul(&[a, b])).collect::<Vec<_>>())
        };
        let jacobian = &self.terms.jacobian;
        let matrix: Vec<Vec<Expr>> = rows
            .iter()
            .map(|&i| {
                let others = rows.iter();
                others
                    .map(|&j| product(&jacobian[i], &jacobian[j]))
                    .collect()
            })
            .collect();
        Some(determinant(g, &matrix))
    }

    /// Determinants of the linear systems of the equations, the rank of the constraints, and what can vanish in constraints and Lagrangian.
    fn watched(self, equations: &Equations, compiled: &Compiled) -> Vec<(Watched, Expr)> {
        let (system, g, state) = (self.system, &self.system.graph, &compiled.symbols);
        let unknowns = self.unknowns();
        let mut found: Vec<(Watched, Expr)> = Vec::new();
        for e in g.reachable(&equations.rates()) {
            let Node::Solve { matrix, rhs } = g.node(e) else {
                continue;
            };
            let Node::Matrix { entries, .. } = g.node(*matrix) else {
                continue;
            };
            if rhs.len() > LARGEST_WATCHED {
                continue;
            }
            let rows: Vec<Vec<Expr>> = entries.chunks(rhs.len()).map(<[Expr]>::to_vec).collect();
            let square = g.powi(determinant(g, &rows), 2);
            let what = Watched::Structure {
                unknowns: unknowns.clone(),
            };
            if found.iter().all(|(_, own)| *own != square) {
                found.push((what, square));
            }
        }
        if let Some(gram) = self.gram(&compiled.selection.rows) {
            found.push((Watched::Structure { unknowns }, gram));
        }
        found.extend(masses_and_speeds(system));
        found.extend(vanishing_parts(system, &self.terms.constraints));
        let of_state = |e: &Expr| {
            let symbols = g.symbols_in(&[g.substitute(*e, &self.binding.controls)]);
            let known = |s: &Symbol| {
                state.contains(s)
                    || g.symbol_name(*s) == "t"
                    || self.binding.parameters.iter().any(|(own, _)| own == s)
            };
            symbols.iter().all(known)
                && symbols
                    .iter()
                    .any(|s| state.contains(s) || g.symbol_name(*s) == "t")
        };
        found.retain(|(_, value)| of_state(value));
        found
    }
}

pub(super) fn with_time(g: &Graph, symbols: &[Symbol]) -> Vec<Symbol> {
    let mut variables = vec![g.intern_symbol("t", 0)];
    variables.extend(symbols);
    variables
}

/// f and its gradient by rows, where they have numbers.
type Values = Option<(Vec<f64>, Vec<f64>)>;

/// Solves `f(x) = targets` by Newton's method from several starting points; `evaluate` gives f with its gradient.
fn solved(
    evaluate: &mut dyn FnMut(&[f64]) -> Values,
    targets: &[f64],
    size: usize,
) -> Option<Vec<f64>> {
    let all: Vec<usize> = (0..size).collect();
    let mut generator = chetaev_mechanics::sample::Generator::new(3);
    let reach = targets.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for attempt in 0..60 {
        let width = if attempt % 2 == 0 { reach } else { 3.2 };
        let mut x: Vec<f64> = (0..size).map(|_| generator.between(0.0, width)).collect();
        for _ in 0..60 {
            let Some((values, gradient)) = evaluate(&x) else {
                break;
            };
            let f: Vec<f64> = values.iter().zip(targets).map(|(a, b)| a - b).collect();
            if f.iter().all(|f| f.abs() <= 1e-12 * reach) {
                return Some(x);
            }
            let step = least_squares(&gradient, &f, size, &all);
            x.iter_mut().zip(&step).for_each(|(x, d)| *x -= d);
        }
    }
    None
}
