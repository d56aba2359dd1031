//! The motion in closed form: rates of the state, and what (12) and (13) need along it, as expressions without linear solves.
//! Dependent velocities that stay implicit are symbols of the state, tied to the others by the constraints.

use super::closed_form::{closed, gram, short, zero_of};
use super::closure::Flow;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::characteristics::Selection;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{Characteristics, Manifold};
use chetaev_symbolic::factors::{factored, factors};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{simplify, Expr, Graph, Node, Symbol};
use std::sync::Arc;

/// Motions of more signs altogether are not looked at in cases.
const LARGEST: u64 = 4_000;

/// Motions of more nodes are not brought to closed form.
const MOST_NODES: usize = 600;

/// Among the velocities of the first so many coordinates dependent ones are looked for.
const MOST_COORDINATES: usize = 6;

/// The flow of the motion on the state (q, P), P the quasi-velocities of the model, or speeds along virtual displacements
/// without poles: of a skate the speed u with x' = u cos φ, y' = u sin φ.
pub(crate) struct Motion {
    /// The symbols of the state that move, with their rates.
    pub(crate) rates: Vec<(Symbol, Expr)>,
    /// The independent speeds.
    pub(crate) speeds: Vec<Symbol>,
    /// (12): the coefficients of κ, one row for each independent virtual displacement.
    pub(crate) conditions: Vec<Vec<Expr>>,
    /// Φ of `κ' = Φ κ − λ`.
    pub(crate) transport: Vec<Vec<Expr>>,
    /// λ of the selected constraints.
    pub(crate) multipliers: Vec<Expr>,
    /// Velocities by speeds that the model does not name, as pairs to be read with the equations.
    pub(crate) legend: Vec<(Expr, Expr)>,
    /// Factors by which the rates or the conditions are divided: the motion is looked at where none of them vanishes.
    pub(crate) poles: Vec<Expr>,
    /// Where the speeds do not describe all admissible velocities, in words.
    pub(crate) gaps: Vec<String>,
    /// Factors by which dependent velocities are divided although the motion need not be singular where they vanish.
    pub(crate) chart_poles: Vec<Expr>,
    /// The same of the dependent velocities of the system, also where the states keep all velocities.
    pub(crate) dependent_poles: Vec<Expr>,
    /// Constraints that stay implicit: they vanish on all states.
    pub(crate) implicit: Vec<Expr>,
    /// Velocities and speeds of the chart as functions of the state.
    replaced: Vec<(Expr, Expr)>,
}

/// The motion of a system, or why it is not had in closed form.
type Closed = Result<Motion, String>;

impl Motion {
    /// The motion of the context's system, found once for all claims.
    pub(crate) fn of(cx: &Context<'_>) -> Arc<Closed> {
        cx.shared(|cx| Motion::new(cx))
    }

    /// The motion of the context's system.
    ///
    /// # Errors
    /// Why it is not had in closed form, in words.
    fn new(cx: &Context<'_>) -> Closed {
        let underived = |problem: &dyn std::fmt::Display| {
            format!("the equations could not be derived: {problem}")
        };
        let flow = Flow::new(cx).map_err(|p| underived(&p))?;
        let chart = basis(cx).characteristics().map_err(|p| underived(&p))?;
        let mut builder = Builder { cx, flow, chart };
        builder.check_size()?;
        builder.choose_speeds();
        let poles = builder.velocity_poles();
        if poles.is_empty() {
            return builder.build();
        }
        // The constraints stay equations: they are solved case by case, so that nothing is lost where one solution has a pole.
        let own = builder.chart.clone();
        builder.keep_all_velocities();
        let built = builder.build().or_else(|_| {
            builder.chart = own;
            builder.build()
        });
        built.map(|motion| Motion {
            dependent_poles: poles,
            ..motion
        })
    }

    /// A function of (q, v, t) on the admissible states, simplified.
    pub(crate) fn on_states(&self, g: &Graph, e: Expr) -> Expr {
        short(g, g.substitute(e, &self.replaced))
    }

    fn closed(&self, g: &Graph, e: Expr) -> Result<Expr, String> {
        closed(g, g.substitute(e, &self.replaced))
    }

    /// The rate of a function of the state and the time along the motion.
    pub(crate) fn along(&self, cx: &Context<'_>, e: Expr) -> Expr {
        let rate = |s: Symbol| {
            let known = self.rates.iter().find(|(symbol, _)| *symbol == s);
            match known {
                Some((_, rate)) => Some(*rate),
                None => cx.system.prescribed_rate(s),
            }
        };
        cx.system.graph.derive(&[e], &rate)[0]
    }

    /// The rate of a symbol of the state.
    pub(crate) fn rate(&self, g: &Graph, symbol: Symbol) -> Expr {
        let known = self.rates.iter().find(|(s, _)| *s == symbol);
        known.map_or(g.zero(), |(_, rate)| *rate)
    }

    /// Rates, conditions and multipliers.
    pub(crate) fn functions(&self) -> Vec<Expr> {
        let rates = self.rates.iter().map(|(_, rate)| *rate);
        let matrices = self.conditions.iter().chain(&self.transport).flatten();
        let all = rates.chain(matrices.copied());
        all.chain(self.multipliers.iter().copied()).collect()
    }

    /// The symbols that move.
    pub(crate) fn state(&self) -> Vec<Symbol> {
        self.rates.iter().map(|(s, _)| *s).collect()
    }
}

/// The subsets of `size` of the numbers below n, in ascending order.
fn subsets(n: usize, size: usize) -> impl Iterator<Item = Vec<usize>> {
    (0..1_usize << n.min(MOST_COORDINATES))
        .filter(move |set| set.count_ones() as usize == size)
        .map(move |set| (0..n).filter(|i| set >> i & 1 == 1).collect())
}

struct Builder<'a, 'b> {
    cx: &'b Context<'a>,
    flow: Flow,
    chart: Characteristics,
}

/// A speed that takes the place of an independent velocity, `velocity = factor · speed + shift`.
struct Scaled {
    speed: Expr,
    symbol: Symbol,
    factor: Expr,
    shift: Expr,
}

impl Builder<'_, '_> {
    fn build(&self) -> Closed {
        let system = self.cx.system;
        let scaled = self.scaled()?;
        let to_speeds = self.to_speeds(&scaled);
        let velocities = self.velocities(&to_speeds)?;
        let pairs = system.coordinates.iter().zip(&velocities);
        let mut replaced: Vec<(Expr, Expr)> = pairs
            .map(|(c, &v)| (c.v, v))
            .filter(|(v, phi)| v != phi)
            .collect();
        for &(speed, value) in &to_speeds {
            if !replaced.iter().any(|(known, _)| *known == speed) {
                replaced.push((speed, value));
            }
        }
        let mut motion = Motion {
            rates: Vec::new(),
            speeds: Vec::new(),
            conditions: Vec::new(),
            transport: Vec::new(),
            multipliers: Vec::new(),
            legend: self.legend(&scaled, &velocities),
            poles: Vec::new(),
            gaps: self.gaps(&scaled, &velocities),
            chart_poles: self.velocity_poles(),
            dependent_poles: Vec::new(),
            implicit: self.implicit().map(|&(f, _)| f).collect(),
            replaced,
        };
        self.add_rates(&mut motion, &velocities, &scaled)?;
        self.add_conditions(&mut motion, &scaled)?;
        self.finish(motion)
    }

    /// The independent velocities by the speeds in their place.
    fn to_speeds(&self, scaled: &[Option<Scaled>]) -> Vec<(Expr, Expr)> {
        let g = &self.cx.system.graph;
        let velocity = |s: &Scaled| g.add(&[g.mul(&[s.factor, s.speed]), s.shift]);
        let parameters = self.chart.parameters.iter().zip(scaled);
        parameters
            .filter_map(|(p, s)| Some((p.value, velocity(s.as_ref()?))))
            .collect()
    }

    /// All velocities by the speeds.
    fn velocities(&self, to_speeds: &[(Expr, Expr)]) -> Result<Vec<Expr>, String> {
        let g = &self.cx.system.graph;
        let velocities = self.chart.velocities.iter();
        velocities
            .map(|&phi| closed(g, g.substitute(phi, to_speeds)))
            .collect()
    }

    /// Independent velocities whose speeds describe all admissible velocities, where those of the system do not.
    fn choose_speeds(&mut self) {
        let own = self.chart.clone();
        let is_implicit = self.implicit().next().is_some();
        if !own.frame.is_natural(self.cx.system) || is_implicit || self.has_no_gaps() {
            return;
        }
        let rows = &self.cx.selection.rows;
        for dependent in subsets(self.cx.system.n(), rows.len()) {
            let selection = Selection {
                rows: rows.clone(),
                dependent,
            };
            let (system, terms) = (self.cx.system, self.cx.terms);
            let other = Characteristics::independent_velocities(system, terms, &selection);
            let Ok(other) = other else {
                continue;
            };
            self.chart = other;
            if self.chart.manifold.implicit.is_empty() && self.has_no_gaps() {
                return;
            }
        }
        self.chart = own;
    }

    /// Factors with velocities that vanish where constraints cannot be solved for the dependent velocities; none where these stay
    /// symbols of the state.
    fn velocity_poles(&self) -> Vec<Expr> {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let jacobian = basis(self.cx).jacobian();
        let velocities = system.velocity_symbols();
        let is_implicit = self.implicit().next().is_some();
        if is_implicit || !g.any_contains_any(&jacobian.concat(), &velocities) {
            return Vec::new();
        }
        let columns = |row: &Vec<Expr>| self.chart.dependent.iter().map(|&d| row[d]).collect();
        let block: Vec<Vec<Expr>> = jacobian.iter().map(columns).collect();
        let list = factors(g, determinant(g, &block), &velocities).unwrap_or_default();
        let list = list.into_iter().map(|(factor, _)| factor);
        list.filter(|&factor| !self.never_zero(factor)).collect()
    }

    /// Takes the dependent velocities as symbols of the state, tied to the others by the constraints.
    fn keep_all_velocities(&mut self) {
        let coordinates = &self.cx.system.coordinates;
        if !self.chart.frame.is_natural(self.cx.system) {
            return;
        }
        let constraints = basis(self.cx).constraints().into_iter();
        let dependent = self.chart.dependent.iter();
        let dependent = dependent.map(|&d| coordinates[d].v_symbol);
        self.chart.manifold = Manifold {
            solved: Vec::new(),
            implicit: constraints.zip(dependent).collect(),
        };
        self.chart.velocities = coordinates.iter().map(|c| c.v).collect();
    }

    /// Constraints that stay implicit, each with its dependent velocity.
    fn implicit(&self) -> impl Iterator<Item = &(Expr, Symbol)> {
        self.chart.manifold.implicit.iter()
    }

    fn has_no_gaps(&self) -> bool {
        let gaps = || -> Result<bool, String> {
            let scaled = self.scaled()?;
            let velocities = self.velocities(&self.to_speeds(&scaled))?;
            Ok(self.gaps(&scaled, &velocities).is_empty())
        };
        gaps().unwrap_or(false)
    }

    /// Refuses what is large before anything is simplified.
    fn check_size(&self) -> Result<(), String> {
        let routh = &self.flow.routh;
        let mut all = routh.accelerations.clone();
        all.extend(&self.flow.multipliers);
        all.extend(self.flow.euler.iter().flatten());
        match self.cx.system.graph.reachable(&all).len() {
            0..=MOST_NODES => Ok(()),
            _ => Err("the equations of motion are too large for a distinction of cases".into()),
        }
    }

    /// The poles, where the motion is short enough.
    fn finish(&self, mut motion: Motion) -> Closed {
        let g = &self.cx.system.graph;
        let all = motion.functions();
        let length: u64 = all.iter().map(|&e| simplify::length(g, e)).sum();
        if length > LARGEST {
            return Err(format!("the conditions have {length} signs in closed form, and cases are distinguished up to {LARGEST}"));
        }
        let state = motion.state();
        // A root that vanishes is the edge of where the motion is defined and smooth.
        for e in g.reachable(&all) {
            let is_root = matches!(g.node(e), Node::Power { exponent, .. } if g.as_integer(*exponent).is_none());
            if is_root && g.contains_any(e, &state) && !self.never_zero(e) {
                let root = match g.node(e) {
                    Node::Power { base, .. } => g.sqrt(*base),
                    _ => e,
                };
                motion.poles.push(root);
            }
        }
        for e in all {
            let parts = factored(g, e)
                .map(|parts| parts.factors)
                .unwrap_or_default();
            for (factor, power) in parts {
                let known = motion.poles.contains(&factor);
                if power < 0 && !known && g.contains_any(factor, &state) && !self.never_zero(factor)
                {
                    motion.poles.push(factor);
                }
            }
        }
        Ok(motion)
    }

    /// Speeds in the place of independent velocities by which other velocities have poles; `None` for a velocity that stays.
    fn scaled(&self) -> Result<Vec<Option<Scaled>>, String> {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let k = self.chart.k();
        let none = || (0..k).map(|_| None).collect();
        if !self.chart.frame.is_natural(system) || self.implicit().next().is_some() {
            return Ok(none());
        }
        let factors: Vec<Option<Expr>> = (0..k).map(|s| self.poles(s)).collect();
        if factors.iter().all(Option::is_none) {
            return Ok(none());
        }
        let drift = self.drift()?;
        let independent = self.chart.independent.iter();
        let speeds = independent.zip(factors).map(|(&i, factor)| {
            let shift = drift[i];
            if factor.is_none() && g.is_zero(shift) {
                return None;
            }
            let (coordinate, factor) = (&system.coordinates[i], factor.unwrap_or(g.one()));
            let definition = g.div(g.sub(coordinate.v, shift), factor);
            let symbol = system.named(&format!("u_{}", coordinate.name), definition);
            Some(Scaled {
                speed: g.symbol_expr(symbol),
                symbol,
                factor,
                shift,
            })
        });
        Ok(speeds.collect())
    }

    /// The shortest admissible velocity, `−Jᵀ (J Jᵀ)⁻¹ f` at rest, of constraints affine in the velocities: it has no poles.
    fn drift(&self) -> Result<Vec<Expr>, String> {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let basis = basis(self.cx);
        let jacobian = basis.jacobian();
        let none = vec![g.zero(); system.n()];
        if g.any_contains_any(&jacobian.concat(), &system.velocity_symbols()) {
            return Ok(none);
        }
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        let right = g.substitute_all(&basis.constraints(), &at_rest);
        if right.iter().all(|&e| g.is_zero(e)) {
            return Ok(none);
        }
        let weights = g
            .solve(&gram(g, &jacobian), &right)
            .map_err(|e| e.to_string())?;
        (0..system.n())
            .map(|i| {
                closed(
                    g,
                    g.neg(dot(g, &weights, jacobian.iter().map(|row| &row[i]))),
                )
            })
            .collect()
    }

    /// Where the velocities by the scaled speeds lose rank, as far as one factor of them can be solved for.
    fn gaps(&self, scaled: &[Option<Scaled>], velocities: &[Expr]) -> Vec<String> {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let symbols: Vec<Symbol> = self
            .chart
            .parameters
            .iter()
            .zip(scaled)
            .map(|(p, s)| s.as_ref().map_or(p.symbol, |s| s.symbol))
            .collect();
        let matrix = g.jacobian(velocities, &symbols);
        let poles = self.velocity_poles().into_iter();
        let unsolved = |e: Expr| {
            let text = g.text(e);
            format!(
                "{text} = 0, where the constraints were not solved for the dependent velocities"
            )
        };
        let mut gaps: Vec<String> = poles.map(unsolved).collect();
        let coordinates = system.coordinate_symbols();
        for scaled in scaled.iter().flatten() {
            for (factor, _) in factors(g, scaled.factor, &coordinates).unwrap_or_default() {
                let text = g.text(factor);
                let regular = zero_of(g, factor, &coordinates).is_some_and(|zero| {
                    let on: Vec<Vec<Expr>> = matrix
                        .iter()
                        .map(|row| g.substitute_all(row, &[zero]))
                        .collect();
                    let rank = self.cx.prover.rank(system, &on, &Default::default());
                    rank.is_ok_and(|rank| rank.minimum == symbols.len())
                });
                if !regular {
                    gaps.push(format!(
                        "{text} = 0, where the speeds used do not describe all velocities"
                    ));
                }
            }
        }
        gaps.dedup();
        gaps
    }

    /// The common denominator of column s of B.
    fn poles(&self, s: usize) -> Option<Expr> {
        let g = &self.cx.system.graph;
        let mut powers: Vec<(Expr, i64)> = Vec::new();
        for entry in self.chart.column(s) {
            for (factor, power) in factored(g, closed(g, entry).ok()?)?.factors {
                if power >= 0 {
                    continue;
                }
                match powers.iter_mut().find(|(known, _)| *known == factor) {
                    Some((_, known)) => *known = (*known).max(-power),
                    None => powers.push((factor, -power)),
                }
            }
        }
        let coordinates = self.cx.system.coordinate_symbols();
        let factors: Vec<Expr> = powers
            .into_iter()
            .filter(|&(factor, _)| g.contains_any(factor, &coordinates))
            .filter(|&(factor, _)| !self.never_zero(factor))
            .map(|(factor, power)| g.powi(factor, power))
            .collect();
        (!factors.is_empty()).then(|| g.mul(&factors))
    }

    fn never_zero(&self, e: Expr) -> bool {
        let assumptions = chetaev_mechanics::prover::assumptions(self.cx.system);
        chetaev_symbolic::zero::known_sign(&self.cx.system.graph, e, &assumptions).is_nonzero()
    }

    fn legend(&self, scaled: &[Option<Scaled>], velocities: &[Expr]) -> Vec<(Expr, Expr)> {
        let g = &self.cx.system.graph;
        let speeds: Vec<Symbol> = scaled.iter().flatten().map(|s| s.symbol).collect();
        let pairs = self.cx.system.coordinates.iter().zip(velocities);
        pairs
            .filter(|(_, &v)| g.contains_any(v, &speeds))
            .map(|(c, &v)| (c.v, v))
            .collect()
    }

    /// Rates of coordinates, speeds and masses.
    fn add_rates(
        &self,
        motion: &mut Motion,
        velocities: &[Expr],
        scaled: &[Option<Scaled>],
    ) -> Result<(), String> {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let coordinates = system.coordinate_symbols().into_iter();
        motion.rates = coordinates.zip(velocities.iter().copied()).collect();
        let routh = &self.flow.routh;
        let symbols = system.velocity_symbols().into_iter();
        let accelerations: Vec<(Symbol, Expr)> =
            symbols.zip(routh.accelerations.iter().copied()).collect();
        let definitions: Vec<Expr> = self.chart.parameters.iter().map(|p| p.definition).collect();
        let moved = derive_along(
            system,
            &definitions,
            &routh.velocities,
            g.one(),
            &accelerations,
        );
        for ((p, rate), scaled) in self.chart.parameters.iter().zip(moved).zip(scaled) {
            let (symbol, rate) = match scaled {
                None => (p.symbol, rate),
                Some(s) => {
                    let moved = system.total_derivative(s.factor);
                    let shifted = system.total_derivative(s.shift);
                    let rest = g.sub(g.sub(rate, shifted), g.mul(&[moved, s.speed]));
                    (s.symbol, g.div(rest, s.factor))
                }
            };
            let rate = motion.closed(g, rate)?;
            motion.speeds.push(symbol);
            motion.rates.push((symbol, rate));
        }
        for &(_, dependent) in self.implicit() {
            let own = accelerations.iter().find(|(s, _)| *s == dependent);
            let &(_, rate) = own.ok_or("the quasi-velocities stay implicit")?;
            let rate = motion.closed(g, rate)?;
            motion.rates.push((dependent, rate));
        }
        for mass in &system.masses {
            motion
                .rates
                .push((mass.symbol, motion.on_states(g, mass.rate)));
        }
        Ok(())
    }

    /// (12), Φ and λ.
    fn add_conditions(&self, motion: &mut Motion, scaled: &[Option<Scaled>]) -> Result<(), String> {
        let g = &self.cx.system.graph;
        for column in self.displacements(scaled) {
            let rows = self.flow.euler.iter();
            let row = rows.map(|euler| motion.closed(g, dot(g, euler, &column)));
            let row = row.collect::<Result<_, _>>()?;
            motion.conditions.push(row);
        }
        let multipliers = self.flow.multipliers.iter();
        motion.multipliers = multipliers
            .map(|&e| motion.closed(g, e))
            .collect::<Result<_, _>>()?;
        let transport = self.transport()?;
        motion.transport = transport
            .into_iter()
            .map(|row| row.into_iter().map(|e| motion.closed(g, e)).collect())
            .collect::<Result<_, _>>()?;
        Ok(())
    }

    /// Virtual displacements that span all, wherever the motion is regular: the columns of B, or of the projection
    /// `1 − Jᵀ (J Jᵀ)⁻¹ J` where dependent velocities stay implicit, since B has poles where ∂f/∂v vanishes for one of them.
    fn displacements(&self, scaled: &[Option<Scaled>]) -> Vec<Vec<Expr>> {
        let g = &self.cx.system.graph;
        if self.implicit().next().is_none() {
            let columns = (0..self.chart.k()).zip(scaled).map(|(s, scaled)| {
                let factor = scaled.as_ref().map_or(g.one(), |scaled| scaled.factor);
                let column = self.chart.column(s).into_iter();
                column.map(|entry| g.mul(&[entry, factor])).collect()
            });
            return columns.collect();
        }
        let jacobian = basis(self.cx).jacobian();
        let (n, gram) = (self.cx.system.n(), gram(g, &jacobian));
        let unit = |i: usize, j: usize| if i == j { g.one() } else { g.zero() };
        let column = |j: usize| -> Option<Vec<Expr>> {
            let right: Vec<Expr> = jacobian.iter().map(|row| row[j]).collect();
            let weights = g.solve(&gram, &right).ok()?;
            let along = |i: usize| dot(g, &weights, jacobian.iter().map(|row| &row[i]));
            Some((0..n).map(|i| g.sub(unit(i, j), along(i))).collect())
        };
        (0..n).filter_map(column).collect()
    }

    /// Φ: `Σ_m ∂f^m/∂vⁱ Φ_ml = E_i[f^l]`, solved on the dependent velocities where that has no pole, else by `(J Jᵀ)⁻¹ J`.
    fn transport(&self) -> Result<Vec<Vec<Expr>>, String> {
        let g = &self.cx.system.graph;
        let jacobian = basis(self.cx).jacobian();
        let r = jacobian.len();
        let dependent = &self.cx.selection.dependent;
        let block: Vec<Expr> = dependent
            .iter()
            .flat_map(|&d| jacobian.iter().map(move |row| row[d]))
            .collect();
        let constant = block.iter().all(|&e| g.as_number(e).is_some());
        let (matrix, rights): (Vec<Expr>, Vec<Vec<Expr>>) = match constant {
            true => {
                let right = |euler: &Vec<Expr>| dependent.iter().map(|&d| euler[d]).collect();
                (block, self.flow.euler.iter().map(right).collect())
            }
            false => {
                let right =
                    |euler: &Vec<Expr>| jacobian.iter().map(|row| dot(g, row, euler)).collect();
                (
                    gram(g, &jacobian),
                    self.flow.euler.iter().map(right).collect(),
                )
            }
        };
        let columns: Vec<Vec<Expr>> = rights
            .iter()
            .map(|right| g.solve(&matrix, right).map_err(|e| e.to_string()))
            .collect::<Result<_, _>>()?;
        Ok((0..r)
            .map(|m| columns.iter().map(|column| column[m]).collect())
            .collect())
    }
}
