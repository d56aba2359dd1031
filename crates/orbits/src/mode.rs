//! Motions of the linear equations about a steady motion, in all coordinates.
//!
//! The variables deviate by `Re(s e^{λ(t − t₀)} v)`. Coordinates that finite constraints determine follow by their slopes; those on which nothing
//! depends follow from the variables by their rates, which are taken as they are and not linearized, so that a heading that has turned leads
//! elsewhere.

use crate::error::OrbitError;
use chetaev_integrate::{integrate, try_from_fn, EvaluationFailure, Options, Output, Stop};
use chetaev_mechanics::{ConstraintKind, MotionTerms, Selection, SteadyMotion, System};
use chetaev_motion::functions::Functions;
use chetaev_motion::turns::Turns;
use chetaev_motion::Binding;
use chetaev_stability::linearization::{Linearization, Variable};
use chetaev_stability::reduction::{ClosedSystem, OperatingPoint, Speeds};
use chetaev_stability::steady::numbers;
use chetaev_symbolic::{Expr, Symbol};

/// A motion of the linear equations: `Re(s e^{λ(t − t₀)} v)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// λ, real and imaginary part.
    pub eigenvalue: (f64, f64),
    /// v, one complex number for each variable of the linear equations.
    pub vector: Vec<(f64, f64)>,
    /// s.
    pub size: f64,
    /// t₀.
    pub from: f64,
}

impl Deviation {
    /// The deviation of each variable at a time.
    pub fn at(&self, t: f64) -> Vec<f64> {
        let (re, im) = self.eigenvalue;
        let elapsed = t - self.from;
        let size = self.size * (re * elapsed).exp();
        let (sin, cos) = (im * elapsed).sin_cos();
        let real = |&(a, b): &(f64, f64)| size * (a * cos - b * sin);
        self.vector.iter().map(real).collect()
    }
}

/// A steady motion with what follows from deviations of its variables.
#[derive(Debug)]
pub struct LinearMotion {
    /// The number of coordinates.
    n: usize,
    /// Coordinates, then quasi-velocities, along the steady motion at t = 0.
    state: Vec<f64>,
    /// Where each variable of the linear equations stands among them.
    places: Vec<usize>,
    /// Coordinates that finite constraints determine, each with its slopes by the variables.
    dependent: Vec<(usize, Vec<f64>)>,
    /// Coordinates that move by their rates.
    moving: Vec<usize>,
    /// Coordinates that are angles of the equations.
    is_angle: Vec<bool>,
    velocities: Functions,
}

/// The largest residual of a constraint at the steady motion.
const ADMISSIBLE: f64 = 1e-9;
/// The error of positions that follow from rates: no eye sees it.
const TOLERANCE: f64 = 1e-9;

impl LinearMotion {
    /// The motions beside `motion`, whose linear equations in suitable speeds are `linear`. Coordinates on which nothing depends begin at zero, or
    /// where `motion` says.
    ///
    /// # Errors
    /// [`OrbitError`] where the equations are not explicit in these speeds, or something has no value.
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        (motion, linear): (&SteadyMotion, &Linearization),
    ) -> Result<LinearMotion, OrbitError> {
        let g = &system.graph;
        let zero = Some(g.zero());
        let motion = SteadyMotion {
            positions: motion.positions.iter().map(|own| own.or(zero)).collect(),
            ..motion.clone()
        };
        let values = system.parameter_values();
        let point = numbers(&motion, system, terms, (&selection.rows, &values))?;
        let operating = OperatingPoint {
            numbers: &point,
            open: &[],
        };
        let closed = ClosedSystem::about(system, terms, selection, (Speeds::Suitable, operating))?;
        let c = &closed.characteristics;
        let own = c.parameters.iter().map(|p| (p.name.clone(), p.definition));
        if !c.manifold.implicit.is_empty() || !own.eq(linear.speeds.iter().cloned()) {
            return Err(OrbitError::Implicit);
        }
        let place = |name: &str| system.coordinates.iter().position(|c| c.name == name);
        let known =
            |name: &String| place(name).ok_or_else(|| OrbitError::NoValue { name: name.clone() });
        let n = system.n();
        let variables = linear.variables.iter().map(|own| match own {
            Variable::Coordinate(j) => *j,
            Variable::Speed(s) => n + s,
        });
        let slopes = linear.dependent.iter().map(|(name, slopes)| {
            let found = slopes.iter().map(|&e| value(system, &point, e));
            Ok((known(name)?, found.collect::<Result<Vec<f64>, _>>()?))
        });
        let moving = linear.ignorable.iter().map(known);
        let positions = system.coordinates.iter().map(|c| c.q);
        let state: Vec<Expr> = positions
            .chain(c.parameters.iter().map(|p| p.definition))
            .collect();
        let state = state.iter().map(|&e| value(system, &point, e));
        let mut of_motion = vec![g.intern_symbol("t", 0)];
        of_motion.extend(system.coordinate_symbols());
        of_motion.extend(c.parameters.iter().map(|p| p.symbol));
        let binding = Binding::new(system).map_err(|problem| OrbitError::NoValue {
            name: problem.to_string(),
        })?;
        let groups = [("velocities", c.velocities.clone())];
        let turning = [closed.equations.entries(), c.velocities.clone()].concat();
        let angles = Turns::of(g, &system.coordinate_symbols(), &turning);
        let found = LinearMotion {
            n,
            state: state.collect::<Result<_, _>>()?,
            places: variables.collect(),
            dependent: slopes.collect::<Result<_, OrbitError>>()?,
            moving: moving.collect::<Result<_, _>>()?,
            is_angle: (0..n).map(|j| angles.is_turning(j)).collect(),
            velocities: Functions::new(g, &binding, &of_motion, &groups)?,
        };
        admissible(system, terms, (&selection.rows, &point))?;
        Ok(found)
    }

    /// Whether the equations see a coordinate as an angle: by sines and cosines only.
    pub fn is_angle(&self, coordinate: usize) -> bool {
        self.is_angle.get(coordinate).copied().unwrap_or(false)
    }

    /// Coordinates and velocities at these times, ascending from 0 on: along the steady motion, or deviating from it.
    ///
    /// # Errors
    /// [`OrbitError`] where rates have no value.
    pub fn rows(
        &mut self,
        times: &[f64],
        deviation: Option<&Deviation>,
    ) -> Result<Vec<Vec<f64>>, OrbitError> {
        let moving = self.moving.clone();
        let begin: Vec<f64> = moving.iter().map(|&j| self.state[j]).collect();
        let end = times.last().copied().unwrap_or(0.0);
        let places = if begin.is_empty() || end <= 0.0 {
            vec![begin; times.len()]
        } else {
            let mut rates = try_from_fn(begin.len(), |t, y: &[f64], out: &mut [f64]| {
                let velocities = self.velocities(t, y, deviation)?.1;
                for (rate, &j) in out.iter_mut().zip(&moving) {
                    *rate = velocities[j];
                }
                Ok(())
            });
            let options = Options::tolerance(TOLERANCE).output(Output::Times(times.to_vec()));
            let run = integrate(&mut rates, (0.0, end), &begin, &mut [], options)?;
            if run.stop != Stop::Finished {
                let (t, stop) = (run.t, run.stop);
                return Err(OrbitError::EndsEarly { t, end, stop });
            }
            run.rows.chunks(run.width).map(<[f64]>::to_vec).collect()
        };
        let rows = times.iter().zip(&places).map(|(&t, y)| {
            let (mut row, velocities) = self.velocities(t, y, deviation)?;
            row.truncate(self.n);
            row.extend(velocities);
            Ok(row)
        });
        rows.collect()
    }

    /// Coordinates and quasi-velocities at a time, and the velocities there; `y` are the coordinates that move by their rates.
    fn velocities(
        &mut self,
        t: f64,
        y: &[f64],
        deviation: Option<&Deviation>,
    ) -> Result<(Vec<f64>, Vec<f64>), EvaluationFailure> {
        let mut state = self.state.clone();
        for (&j, &value) in self.moving.iter().zip(y) {
            state[j] = value;
        }
        if let Some(own) = deviation {
            let moved = own.at(t);
            for (&place, by) in self.places.iter().zip(&moved) {
                state[place] += by;
            }
            for (place, slopes) in &self.dependent {
                state[*place] += slopes.iter().zip(&moved).map(|(a, b)| a * b).sum::<f64>();
            }
        }
        self.velocities.evaluate(t, &[&state])?;
        let found = self.velocities.group(0).to_vec();
        Ok((state, found))
    }
}

/// The value of an expression at a state.
fn value(system: &System, point: &[(Symbol, f64)], e: Expr) -> Result<f64, OrbitError> {
    let g = &system.graph;
    let find = |s: Symbol| point.iter().find(|own| own.0 == s).map(|own| own.1);
    let found = g.evaluate_f64(&[e], &find).ok();
    let found = found.and_then(|all| all.first().copied());
    found
        .filter(|x| x.is_finite())
        .ok_or_else(|| OrbitError::NoValue { name: g.text(e) })
}

/// Whether a state satisfies the finite constraints and those on velocities.
fn admissible(
    system: &System,
    terms: &MotionTerms,
    (rows, point): (&[usize], &[(Symbol, f64)]),
) -> Result<(), OrbitError> {
    for &row in rows {
        let own = &system.constraints[terms.constraint_index[row]];
        let finite = (own.kind == ConstraintKind::Holonomic).then_some(own.stated);
        for e in finite.into_iter().chain([terms.constraints[row]]) {
            let e = system.with_definitions(e);
            if value(system, point, e)?.abs() > ADMISSIBLE {
                let names = system.coordinates.iter().map(|c| c.name.clone());
                let names = names.collect::<Vec<_>>().join(", ");
                return Err(OrbitError::NotDetermined { names });
            }
        }
    }
    Ok(())
}
