//! The motion as a first-order system `z' = f(t, z, p)`.

use crate::error::OrbitError;
use crate::units::Units;
use chetaev_mechanics::{ConstraintKind, MotionTerms, Selection, System};
use chetaev_motion::functions::Functions;
use chetaev_motion::turns::{outside_angles, Turns};
use chetaev_motion::Binding;
use chetaev_stability::eigenvalues::{balanced, power_of_two};
use chetaev_stability::problem::LinearizationError;
use chetaev_stability::reduction::{ClosedSystem, OperatingPoint, Speeds};
use chetaev_stability::singular::least;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};
use nalgebra::DMatrix;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A first-order system with values of its parameters.
#[derive(Clone, Debug)]
pub struct Flow {
    /// Where all expressions live.
    pub graph: Arc<Graph>,
    /// Names of the variables.
    pub names: Vec<String>,
    /// z.
    pub variables: Vec<Symbol>,
    /// f, functions of the time, z and the parameters.
    pub rates: Vec<Expr>,
    /// The parameters that occur or may be varied, with their values.
    pub parameters: Vec<(Symbol, f64)>,
    /// z as functions of coordinates and velocities.
    pub definitions: Vec<Expr>,
    /// The velocities of all coordinates as functions of z; they may contain coordinates that are no variables.
    pub velocities: Vec<Expr>,
    /// Functions of z that vanish on admissible states.
    pub finite: Vec<Expr>,
    /// Functions of z that may be integrals, with their names.
    pub conserved: Vec<(String, Expr)>,
    /// Variables that are angles: a whole turn more changes nothing.
    pub is_turning: Vec<bool>,
    /// What the equations were divided by.
    pub divisors: Divisors,
    /// The units of the variables and of the time.
    pub units: Units,
}

/// Matrices of functions of z by which accelerations and velocities are determined.
#[derive(Clone, Debug, Default)]
pub struct Divisors {
    /// The mass matrix in quasi-velocities, row by row.
    pub mass: Vec<Vec<Expr>>,
    /// The gradients of the independent constraints by the velocities, row by row.
    pub gradients: Vec<Vec<Expr>>,
    /// The velocities by the quasi-velocities, which have poles where these do not serve.
    pub slopes: Vec<Vec<Expr>>,
}

/// How far a state is from where the equations say nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// The smallest singular value of the mass matrix, in the units of its entries; 1 where there is none.
    pub mass: f64,
    /// The same of the gradients of the constraints.
    pub gradients: f64,
    /// The largest slope of a velocity by a quasi-velocity; infinite where one has no value.
    pub slope: f64,
}

/// Which coordinates are variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// Those on which the equations depend.
    NotIgnorable,
    /// All.
    All,
}

impl Flow {
    /// A system that is given by its rates.
    pub fn of_rates(
        graph: Arc<Graph>,
        variables: Vec<Symbol>,
        rates: Vec<Expr>,
        parameters: Vec<(Symbol, f64)>,
    ) -> Flow {
        let own: Vec<Expr> = variables.iter().map(|&s| graph.symbol_expr(s)).collect();
        Flow {
            names: variables.iter().map(|&s| graph.symbol_text(s)).collect(),
            is_turning: vec![false; variables.len()],
            divisors: Divisors::default(),
            units: Units::ones(variables.len()),
            definitions: own,
            velocities: Vec::new(),
            finite: Vec::new(),
            conserved: Vec::new(),
            variables,
            rates,
            parameters,
            graph,
        }
    }

    /// The motion of a system in coordinates and quasi-velocities that serve at a state; `point` has values of coordinates, velocities and
    /// parameters there.
    ///
    /// # Errors
    /// [`OrbitError`] where there are no explicit equations, or a parameter has no value.
    pub fn of_system(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        (which, point): (Coordinates, &[(Symbol, f64)]),
    ) -> Result<Flow, OrbitError> {
        let g = &system.graph;
        let operating = OperatingPoint {
            numbers: point,
            open: &[],
        };
        let closed = ClosedSystem::about(system, terms, selection, (Speeds::Suitable, operating))?;
        let c = &closed.characteristics;
        if !c.manifold.implicit.is_empty() {
            return Err(OrbitError::Implicit);
        }
        let (coordinates, of_coordinates) = match which {
            Coordinates::NotIgnorable => (closed.coordinates.clone(), closed.rates.clone()),
            Coordinates::All => ((0..system.n()).collect(), c.velocities.clone()),
        };
        let of_speeds = closed.equations.rates(g).ok_or(OrbitError::Singular)?;
        let plain = |es: &[Expr]| plain(system, es);
        let coordinate = |&j: &usize| &system.coordinates[j];
        let symbols = coordinates.iter().map(|j| coordinate(j).q_symbol);
        let variables: Vec<Symbol> = symbols
            .chain(c.parameters.iter().map(|p| p.symbol))
            .collect();
        let names = coordinates.iter().map(|j| coordinate(j).name.clone());
        let positions = coordinates.iter().map(|j| coordinate(j).q);
        let definitions: Vec<Expr> = positions
            .chain(c.parameters.iter().map(|p| p.definition))
            .collect();
        let mut flow = Flow {
            graph: g.clone(),
            names: names
                .chain(c.parameters.iter().map(|p| p.name.clone()))
                .collect(),
            rates: plain(&[of_coordinates, of_speeds].concat()),
            parameters: Vec::new(),
            definitions: plain(&definitions),
            velocities: plain(&c.velocities),
            finite: Vec::new(),
            conserved: Vec::new(),
            is_turning: Vec::new(),
            divisors: Divisors::default(),
            units: Units::ones(variables.len()),
            variables,
        };
        let finite = selection.rows.iter();
        let finite = finite.map(|&row| &system.constraints[terms.constraint_index[row]]);
        let finite = finite.filter(|own| own.kind == ConstraintKind::Holonomic);
        let finite: Vec<Expr> = finite.map(|own| own.stated).collect();
        let is_closed = |e: &Expr| flow.is_closed(system, *e);
        let finite: Vec<Expr> = plain(&finite).into_iter().filter(is_closed).collect();
        // Ignorable coordinates may stand in a function that does not depend on them; whether it is constant is looked at where it is used.
        let others = (0..system.n()).filter(|j| !coordinates.contains(j));
        let somewhere = g.number(Rational::from_parts_signed(377.into(), 1000.into()));
        let somewhere: Vec<(Expr, Expr)> = others
            .map(|j| (system.coordinates[j].q, somewhere))
            .collect();
        let conserved: Vec<(String, Expr)> = candidates(system)
            .into_iter()
            .map(|(name, e)| (name, plain(&c.restrict(system, &[e]))[0]))
            .map(|(name, e)| (name, g.substitute(e, &somewhere)))
            .filter(|(_, e)| flow.is_closed(system, *e))
            .collect();
        (flow.finite, flow.conserved) = (finite, conserved);
        let at_place = |rows: Vec<Vec<Expr>>| -> Vec<Vec<Expr>> {
            let put = |row: Vec<Expr>| g.substitute_all(&plain(&row), &somewhere);
            rows.into_iter().map(put).collect()
        };
        let gradients = selection.rows.iter();
        let gradients = gradients.map(|&row| c.restrict(system, &terms.jacobian[row]));
        flow.divisors = Divisors {
            mass: at_place(closed.equations.mass.clone()),
            gradients: at_place(gradients.collect()),
            slopes: at_place(c.basis.clone()),
        };
        flow.parameters = values(system, &flow)?;
        flow.is_turning = turning(system, &flow);
        Ok(flow)
    }

    /// The motion of a system in coordinates and all velocities, with accelerations by multipliers: `W a − Jᵀ λ = b`, `J a = g`. No velocity is
    /// solved for, so that it goes on where those that were chosen as dependent are no longer determined by the others, as those of a pendulum in
    /// Cartesian coordinates. Constraints stay satisfied to rounding.
    ///
    /// # Errors
    /// [`OrbitError`] where there are no explicit equations, or a parameter has no value.
    pub fn in_all_velocities(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        which: Coordinates,
    ) -> Result<Flow, OrbitError> {
        let (g, n) = (&system.graph, system.n());
        if terms.order > 1 {
            return Err(LinearizationError::OrderTooHigh { order: terms.order }.into());
        }
        let found = terms
            .solved(system, &selection.rows)
            .map_err(|_| OrbitError::Singular)?;
        let accelerations = plain(system, &found.0);
        let rows = selection.rows.iter();
        let stated = rows.clone();
        let stated = stated.map(|&row| &system.constraints[terms.constraint_index[row]]);
        let positions = stated.filter(|own| own.kind == ConstraintKind::Holonomic);
        let on_velocities = rows.map(|&row| terms.constraints[row]);
        let finite: Vec<Expr> = positions
            .map(|own| own.stated)
            .chain(on_velocities)
            .collect();
        let finite = plain(system, &finite);
        let all = [accelerations.clone(), finite.clone()].concat();
        let is_variable = |j: &usize| {
            let symbol = [system.coordinates[*j].q_symbol];
            which == Coordinates::All || g.any_contains_any(&all, &symbol)
        };
        let kept: Vec<_> = (0..n)
            .filter(is_variable)
            .map(|j| &system.coordinates[j])
            .collect();
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let positions = kept.iter();
        let symbols = positions.clone().map(|c| c.q_symbol);
        let rates = positions.clone().map(|c| c.v);
        let names = positions.clone().map(|c| c.name.clone());
        let of_velocities = system.coordinates.iter().map(|c| format!("{}'", c.name));
        let mut flow = Flow::of_rates(
            g.clone(),
            symbols.chain(system.velocity_symbols()).collect(),
            rates.chain(accelerations).collect(),
            Vec::new(),
        );
        flow.names = names.chain(of_velocities).collect();
        flow.velocities = velocities;
        let is_closed = |e: &Expr| flow.is_closed(system, *e);
        let finite: Vec<Expr> = finite.into_iter().filter(is_closed).collect();
        let conserved = candidates(system).into_iter();
        let conserved = conserved.map(|(name, e)| (name, plain(system, &[e])[0]));
        let conserved = conserved
            .filter(|(_, e)| flow.is_closed(system, *e))
            .collect();
        (flow.finite, flow.conserved) = (finite, conserved);
        flow.parameters = values(system, &flow)?;
        flow.is_turning = turning(system, &flow);
        Ok(flow)
    }

    /// Whether an expression contains no coordinate or velocity that is not a variable, and not the time.
    fn is_closed(&self, system: &System, e: Expr) -> bool {
        let time = self.time();
        self.graph.symbols_in(&[e]).into_iter().all(|s| {
            let mut jet = system.coordinates.iter();
            let is_of_jet = jet.any(|c| c.q_symbol == s || c.v_symbol == s);
            s != time && (self.variables.contains(&s) || !is_of_jet)
        })
    }

    /// The variables that are neither coordinates nor velocities of one, as texts: `speed along x' y' = x' cos(phi) + y' sin(phi)`.
    pub fn defined(&self) -> Vec<String> {
        let g = &self.graph;
        let own = self.names.iter().zip(&self.definitions);
        own.map(|(name, &e)| (name, g.text(e)))
            .filter(|(name, text)| *name != text)
            .map(|(name, text)| format!("{name} = {text}"))
            .collect()
    }

    /// Units in which variables and rates are of the size of one near a state. Angles stay as they are, and so does the time where it is
    /// explicit.
    pub fn units_near(&self, state: &[f64]) -> Units {
        let n = self.n();
        let parameters: Vec<f64> = self.parameters.iter().map(|own| own.1).collect();
        let Some(slopes) = self.slopes(state, &parameters) else {
            return Units::ones(n);
        };
        if n == 0 || !slopes.iter().all(|x| x.is_finite()) {
            return Units::ones(n);
        }
        let own = balanced(&slopes);
        let turning = (0..n).find(|&i| self.is_turning[i]);
        let size = match turning {
            Some(i) => own.scale[i].recip(),
            None => {
                let sizes = state.iter().zip(&own.scale);
                sizes.map(|(x, d)| x.abs() / d).fold(0.0, f64::max)
            }
        };
        let size = power_of_two(size);
        let scale = |i: usize| {
            if self.is_turning[i] {
                1.0
            } else {
                power_of_two(size * own.scale[i])
            }
        };
        let largest = own.matrix.amax() * own.unit;
        Units {
            scale: (0..n).map(scale).collect(),
            rate: if self.is_autonomous() {
                power_of_two(largest)
            } else {
                1.0
            },
        }
    }

    /// The same in other units.
    pub fn in_units(&self, units: &Units) -> Flow {
        let g = &self.graph;
        let number = |x: f64| g.number(Rational::try_from(x).unwrap_or(Rational::ONE));
        let variables = self.variables.iter().zip(&units.scale);
        let variables = variables.map(|(&s, &scale)| (g.symbol_expr(s), scale));
        let time = (g.symbol_expr(self.time()), units.rate.recip());
        let put: Vec<(Expr, Expr)> = variables
            .chain([time])
            .filter(|own| own.1 != 1.0)
            .map(|(e, scale)| (e, g.mul(&[number(scale), e])))
            .collect();
        let in_units = |es: &[Expr]| g.substitute_all(es, &put);
        let over = |(e, scale): (Expr, f64)| g.mul(&[number(scale.recip()), e]);
        let rates = in_units(&self.rates).into_iter().zip(&units.scale);
        let definitions = self.definitions.iter().copied().zip(&units.scale);
        let rows = |rows: &[Vec<Expr>]| rows.iter().map(|row| in_units(row)).collect();
        let conserved = self.conserved.iter();
        let conserved = conserved.map(|(name, e)| (name.clone(), in_units(&[*e])[0]));
        Flow {
            rates: rates.map(|(e, s)| over((e, s * units.rate))).collect(),
            definitions: definitions.map(|(e, &s)| over((e, s))).collect(),
            velocities: in_units(&self.velocities),
            finite: in_units(&self.finite),
            conserved: conserved.collect(),
            divisors: Divisors {
                mass: rows(&self.divisors.mass),
                gradients: rows(&self.divisors.gradients),
                slopes: rows(&self.divisors.slopes),
            },
            units: units.clone(),
            ..self.clone()
        }
    }

    /// The symbol of the time.
    pub fn time(&self) -> Symbol {
        self.graph.intern_symbol("t", 0)
    }

    /// The number of variables.
    pub fn n(&self) -> usize {
        self.variables.len()
    }

    /// Whether the rates do not contain the time.
    pub fn is_autonomous(&self) -> bool {
        !self.graph.any_contains_any(&self.rates, &[self.time()])
    }

    /// The periods of the trigonometric functions of the time in the rates, ascending, at a state and these values of the parameters; none where the
    /// rates depend on the time otherwise too.
    pub fn periods(&self, z: &[f64], parameters: &[f64]) -> Vec<f64> {
        let (g, time) = (&self.graph, self.time());
        let (free, angles) = outside_angles(g, &self.rates);
        let slopes: Vec<Expr> = angles.iter().map(|&e| g.diff(e, time)).collect();
        if free.contains(&time) || g.any_contains_any(&slopes, &[time]) {
            return Vec::new();
        }
        let value = self.values_at(z, parameters);
        let rates = g.evaluate_f64(&slopes, &value).unwrap_or_default();
        let rates = rates.into_iter().filter(|own| *own != 0.0);
        let mut found: Vec<f64> = rates.map(|own| TAU / own.abs()).collect();
        found.sort_by(f64::total_cmp);
        found.dedup_by(|a, b| (*a - *b).abs() <= 1e-12 * *b);
        found
    }

    /// The values of variables and parameters at a state, by their symbols.
    pub(crate) fn values_at<'a>(
        &'a self,
        z: &'a [f64],
        parameters: &'a [f64],
    ) -> impl Fn(Symbol) -> Option<f64> + 'a {
        move |s| {
            let variable = self.variables.iter().position(|own| *own == s);
            let variable = variable.map(|i| z[i]);
            variable.or_else(|| Some(parameters[self.place(s)?]))
        }
    }

    /// The place of a parameter.
    pub fn place(&self, parameter: Symbol) -> Option<usize> {
        self.parameters
            .iter()
            .position(|(own, _)| *own == parameter)
    }

    pub(crate) fn binding(&self) -> Binding {
        Binding {
            parameters: self.parameters.clone(),
            controls: Vec::new(),
            variables: [vec![self.time()], self.variables.clone()].concat(),
        }
    }

    /// Groups of functions of (t, z) and the parameters, compiled.
    pub(crate) fn functions(&self, groups: &[(&str, Vec<Expr>)]) -> Result<Functions, OrbitError> {
        let binding = self.binding();
        Ok(Functions::new(
            &self.graph,
            &binding,
            &binding.variables,
            groups,
        )?)
    }

    /// ∂f/∂z at a state, for these values of the parameters; `None` where it has no value.
    pub fn slopes(&self, z: &[f64], parameters: &[f64]) -> Option<DMatrix<f64>> {
        let g = &self.graph;
        let entries = g.jacobian(&self.rates, &self.variables).concat();
        let value = self.values_at(z, parameters);
        let found = g.evaluate_f64(&entries, &value).ok()?;
        Some(DMatrix::from_row_slice(self.n(), self.n(), &found))
    }

    /// How far a state is from where the equations say nothing, for these values of the parameters.
    pub fn margins(&self, z: &[f64], parameters: &[f64]) -> Margins {
        let value = self.values_at(z, parameters);
        let numbers = |rows: &[Vec<Expr>]| {
            let found = self.graph.evaluate_f64(&rows.concat(), &value);
            let columns = rows.first().map_or(0, Vec::len);
            found.map(|own| DMatrix::from_row_slice(rows.len(), columns, &own))
        };
        let part = |rows: &[Vec<Expr>]| match rows {
            [] => 1.0,
            rows => numbers(rows).map_or(0.0, |own| least(&own)),
        };
        let is_finite = |own: &DMatrix<f64>| own.iter().all(|x| x.is_finite());
        let slopes = numbers(&self.divisors.slopes).ok().filter(is_finite);
        Margins {
            mass: part(&self.divisors.mass),
            gradients: part(&self.divisors.gradients),
            slope: slopes.map_or(f64::INFINITY, |own| {
                own.iter().fold(0.0, |a, x| x.abs().max(a))
            }),
        }
    }

    /// z at a state of coordinates and velocities.
    ///
    /// # Errors
    /// [`OrbitError::NoValue`] where one of them is needed and has none.
    pub fn state(&self, point: &[(Symbol, f64)]) -> Result<Vec<f64>, OrbitError> {
        let value = |s: Symbol| {
            let mut known = point.iter().chain(&self.parameters);
            known.find(|(own, _)| *own == s).map(|(_, value)| *value)
        };
        let missing = |s: &Symbol| value(*s).is_none() && *s != self.time();
        let mut symbols = self.graph.symbols_in(&self.definitions).into_iter();
        if let Some(s) = symbols.find(missing) {
            let name = self.graph.symbol_text(s);
            return Err(OrbitError::NoValue { name });
        }
        let at = |s: Symbol| value(s).or(Some(0.0));
        let found = self.graph.evaluate_f64(&self.definitions, &at);
        found.map_err(|_| OrbitError::NoValue {
            name: self.names.join(", "),
        })
    }
}

/// Expressions with definitions of parameters and laws of controls put in; a control without law is zero.
pub(crate) fn plain(system: &System, es: &[Expr]) -> Vec<Expr> {
    let g = &system.graph;
    let law = |s: Symbol| {
        let name = g.symbol_name(s);
        let control = system.controls.iter().find(|c| c.name == name)?;
        let law = control.law.unwrap_or_else(|| g.zero());
        let rate = |e: Expr| g.total_derivative(e, &|_| false);
        Some((
            g.symbol_expr(s),
            (0..g.symbol_order(s)).fold(law, |e, _| rate(e)),
        ))
    };
    let laws: Vec<(Expr, Expr)> = g.symbols_in(es).into_iter().filter_map(law).collect();
    let es = g.substitute_all(es, &laws);
    es.into_iter().map(|e| system.with_definitions(e)).collect()
}

/// Functions that often are integrals.
fn candidates(system: &System) -> Vec<(String, Expr)> {
    let g = &system.graph;
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let mut all = vec![("the energy".to_owned(), system.energy())];
    for (c, momentum) in system.coordinates.iter().zip(momenta) {
        all.push((format!("the momentum of {}", c.name), momentum));
    }
    let stated = system.integrals.iter();
    all.extend(stated.map(|(name, e)| (format!("the integral {name}"), *e)));
    all
}

/// All parameters that have a value and are not defined by others; an error for a symbol that occurs and has none.
fn values(system: &System, flow: &Flow) -> Result<Vec<(Symbol, f64)>, OrbitError> {
    let g = &system.graph;
    let is_defined = |e: Expr| system.definitions.iter().any(|(own, _)| *own == e);
    let stated = system.parameters.iter().filter(|p| !is_defined(p.expr));
    let found: Vec<(Symbol, f64)> = stated
        .filter_map(|p| {
            let value = g.evaluate_f64(&[p.value?], &|_| None).ok()?[0];
            Some((g.as_symbol(p.expr)?, value))
        })
        .collect();
    let all = [flow.rates.clone(), flow.finite.clone()].concat();
    let is_known = |s: &Symbol| {
        *s == flow.time() || flow.variables.contains(s) || found.iter().any(|(own, _)| own == s)
    };
    match g.symbols_in(&all).into_iter().find(|s| !is_known(s)) {
        Some(s) => Err(OrbitError::NoValue {
            name: g.symbol_text(s),
        }),
        None => Ok(found),
    }
}

/// Coordinates that a whole turn more does not change the rates.
fn turning(system: &System, flow: &Flow) -> Vec<bool> {
    let turns = Turns::of(&flow.graph, &flow.variables, &flow.rates);
    let is_coordinate = |i: usize| {
        let mut all = system.coordinates.iter();
        all.any(|c| c.q_symbol == flow.variables[i])
    };
    let all = 0..flow.n();
    all.map(|i| is_coordinate(i) && turns.is_turning(i))
        .collect()
}
