//! Kinematic characteristics: a parametrization of the admissible velocities, and with it the virtual displacements.
//!
//! `v = φ(q, P, t)` with `f(q, φ, t) ≡ 0`, `B = ∂φ/∂P` (n × k), `J B = 0`; for constraints of order m they parametrize the
//! derivatives of that order, `q^(m) = φ(t, q, …, q^(m-1), P)` (T2 §2). The parameters P are k independent quasi-velocities of
//! a frame; in the natural frame, independent velocities, or derivatives of order m. Where the constraints are affine
//! in the dependent velocities, φ is explicit, however the others occur; else the dependent ones stay symbols, tied to the
//! others by f = 0 (implicit embedding, T1 §9.6), and every derivative of a function on the constraint manifold is taken
//! through [`Characteristics::along`].
//!
//! The words of the first order are kept for all: `velocities` are the derivatives of order m, `coordinates` those of order
//! m - 1; lower ones move with the time.

use crate::equations::Equation;
use crate::frame::{Frame, FrameOrigin, Speed};
use crate::linear::{dot, solve_linear};
use crate::sample;
use crate::selection::{eliminate, pivot_cost};
use crate::system::{Coordinate, System};
use crate::terms::MotionTerms;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Graph, Symbol};
use rustc_hash::FxHashMap;

pub use crate::selection::{select, Selection};

/// A parameter P of the admissible velocities: an independent quasi-velocity.
pub type Parameter = Speed;

/// The constraint manifold as exact data for a zero test.
#[derive(Clone, Debug, Default)]
pub struct Manifold {
    /// Symbols given exactly by the others.
    pub solved: Vec<(Symbol, Expr)>,
    /// Pairs (f, dependent velocity) of constraints that stay implicit.
    pub implicit: Vec<(Expr, Symbol)>,
}

impl Manifold {
    /// What symbols are given by, and the functions that stay implicit.
    pub fn expressions(&self) -> Vec<Expr> {
        let solved = self.solved.iter().map(|&(_, e)| e);
        solved
            .chain(self.implicit.iter().map(|&(f, _)| f))
            .collect()
    }

    /// The manifold for these values of parameters.
    pub fn substituted(&self, g: &Graph, values: &[(Expr, Expr)]) -> Manifold {
        let solved = self.solved.iter();
        let implicit = self.implicit.iter();
        Manifold {
            solved: solved
                .map(|&(symbol, e)| (symbol, g.substitute(e, values)))
                .collect(),
            implicit: implicit
                .map(|&(f, symbol)| (g.substitute(f, values), symbol))
                .collect(),
        }
    }
}

/// A direction on the constraint manifold with coordinates (t, q, …, q^(m-1), P).
#[derive(Clone, Debug)]
pub struct Direction {
    /// The rate of t; derivatives of orders below m - 1 move with it.
    pub time: Expr,
    /// The rates of q^(m-1), length n.
    pub coordinates: Vec<Expr>,
    /// The rates of P, length k.
    pub parameters: Vec<Expr>,
}

/// A parametrization of the admissible velocities.
#[derive(Clone, Debug)]
pub struct Characteristics {
    /// m.
    pub order: u32,
    /// The coordinates with q^(m-1), q^(m), q^(m+1) in the places of q, v, a.
    pub jets: Vec<Coordinate>,
    /// The frame whose quasi-velocities they are.
    pub frame: Frame,
    /// P, length k.
    pub parameters: Vec<Parameter>,
    /// Indices in the frame of the independent quasi-velocities P.
    pub independent: Vec<usize>,
    /// Indices in the frame of the dependent quasi-velocities, one per row.
    pub dependent: Vec<usize>,
    /// The dependent quasi-velocities on the constraint manifold: F^α(q, P, t), or their symbols where they stay implicit.
    pub solved: Vec<Expr>,
    /// φ, the velocities as functions of (q, P, t); length n.
    pub velocities: Vec<Expr>,
    /// B = ∂φ/∂P, n × k, row by row.
    pub basis: Vec<Vec<Expr>>,
    /// Dφ on the jet (q, P, P', t), length n.
    pub accelerations: Vec<Expr>,
    /// The part of the accelerations free of P': `a = B P' + a*`; length n.
    pub acceleration_offset: Vec<Expr>,
    /// Rows of the terms that were used (independent constraints).
    pub rows: Vec<usize>,
    /// What ties the symbols used here to each other: nothing, or the implicit constraints; in the natural frame also the
    /// dependent velocities as functions of the independent ones.
    pub manifold: Manifold,
    /// Implicit constraints in the variables (q, η, t), and their gradients by the dependent η; empty where F is explicit.
    implicit: Vec<Expr>,
    gradient: Vec<Expr>,
}

/// Why no characteristics can be formed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CharacteristicsError {
    /// The dependent velocities chosen cannot be solved for.
    #[error("the velocities {dependent} cannot be solved from the constraints: {source}")]
    NotSolvable {
        /// The velocities.
        dependent: String,
        /// Why.
        source: SolveError,
    },
    /// No state satisfies the constraints.
    #[error("no real state was found that satisfies the constraints {names} with gradients that do not vanish: they contradict each other, or hold where nothing moves only")]
    NoAdmissibleState {
        /// The constraints.
        names: String,
    },
    /// Constraints with dependent gradients that do not follow from the others.
    #[error("the constraints contradict each other, or hide a condition that is not stated: the gradients of {names} depend on those of the others, and where the others hold {names} demand{s} {demands}; state that as a constraint of its own, or leave {names} out", s = if names.contains(',') { "" } else { "s" })]
    Contradiction {
        /// Names in quotes.
        names: String,
        /// What they demand, as equations.
        demands: String,
    },
    /// Constraints whose gradients are dependent wherever they hold.
    #[error("{sentence}")]
    Multiplicity {
        /// What holds, with simpler constraints.
        sentence: String,
    },
    /// The wrong number of parameters.
    #[error("{found} parameters of the characteristics are stated, and the system has {expected} degrees of freedom in the derivatives they parametrize")]
    WrongNumber {
        /// k.
        expected: usize,
        /// Given.
        found: usize,
    },
}

impl Characteristics {
    /// Characteristics by independent velocities.
    ///
    /// # Errors
    /// [`CharacteristicsError::NotSolvable`] when the dependent velocities are structurally no unknowns.
    pub fn independent_velocities(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<Characteristics, CharacteristicsError> {
        let frame = Frame::natural_of(system, &terms.jets);
        Characteristics::in_frame(system, terms, &selection.rows, frame, &selection.dependent)
    }

    /// Characteristics by the quasi-velocities of the model; `None` when they do not fit: there are neither k nor n, or they
    /// are not affine in the velocities.
    ///
    /// # Errors
    /// [`CharacteristicsError`].
    pub fn quasi_velocities(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Option<Result<Characteristics, CharacteristicsError>> {
        // Quasi-velocities parametrize velocities.
        let (frame, origin) =
            match Frame::stated(system, terms, selection).filter(|_| terms.order == 1)? {
                Ok(found) => found,
                Err(source) => return Some(Err(not_solvable(&system.quasi_names(), source))),
            };
        Some(Characteristics::of_frame(
            system, terms, selection, frame, origin,
        ))
    }

    /// Characteristics in an adapted frame: the quasi-velocities of the model, or independent velocities beside the
    /// constraint functions ([`Frame::adapted`]).
    ///
    /// # Errors
    /// [`CharacteristicsError`].
    pub fn adapted(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<Characteristics, CharacteristicsError> {
        match Frame::adapted(system, terms, selection) {
            Ok((frame, FrameOrigin::Natural)) => {
                let (rows, dependent) = (&selection.rows, &selection.dependent);
                Characteristics::in_frame(system, terms, rows, frame, dependent)
            }
            Ok((frame, origin)) => {
                Characteristics::of_frame(system, terms, selection, frame, origin)
            }
            Err(source) => Err(not_solvable(&system.quasi_names(), source)),
        }
    }

    /// Characteristics by the formulas of the model; `None` where it states none. That they satisfy the constraints is a claim,
    /// `order.characteristics`.
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongNumber`] where there are not k parameters.
    pub fn stated(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Option<Result<Characteristics, CharacteristicsError>> {
        let stated = system.characteristics.as_ref()?;
        let (expected, found) = (system.n() - selection.rows.len(), stated.parameters.len());
        if expected != found {
            return Some(Err(CharacteristicsError::WrongNumber { expected, found }));
        }
        let g = &system.graph;
        let parameter = |name: &String| Speed {
            name: name.clone(),
            value: g.symbol(name, 0),
            rate: g.symbol(name, 1),
            symbol: g.intern_symbol(name, 0),
            rate_symbol: g.intern_symbol(name, 1),
            definition: g.symbol(name, 0),
        };
        let parameters = stated.parameters.iter().map(parameter).collect();
        let (rows, formulas) = (&selection.rows, stated.formulas.clone());
        let made = Characteristics::by_formulas(system, terms, rows, parameters, formulas);
        Some(Ok(made))
    }

    /// Characteristics by formulas that satisfy the constraints of `rows`.
    pub(crate) fn by_formulas(
        system: &System,
        terms: &MotionTerms,
        rows: &[usize],
        parameters: Vec<Parameter>,
        velocities: Vec<Expr>,
    ) -> Characteristics {
        let mut characteristics = Characteristics {
            order: terms.order,
            jets: terms.jets.clone(),
            parameters,
            velocities,
            independent: Vec::new(),
            dependent: Vec::new(),
            solved: Vec::new(),
            basis: Vec::new(),
            accelerations: Vec::new(),
            acceleration_offset: Vec::new(),
            rows: rows.to_vec(),
            manifold: Manifold::default(),
            implicit: Vec::new(),
            gradient: Vec::new(),
            frame: Frame::natural_of(system, &terms.jets),
        };
        characteristics.finish(system);
        characteristics
    }

    fn of_frame(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        frame: Frame,
        origin: FrameOrigin,
    ) -> Result<Characteristics, CharacteristicsError> {
        let rows = &selection.rows;
        if frame.adapted.len() == rows.len() {
            let dependent: Vec<usize> = rows
                .iter()
                .filter_map(|row| frame.adapted.iter().find(|(known, _)| known == row))
                .map(|&(_, s)| s)
                .collect();
            return Characteristics::in_frame(system, terms, rows, frame, &dependent);
        }
        let kept = match origin {
            FrameOrigin::Stated => 0,
            _ => system.quasi_velocities.len(),
        };
        let dependent = choose_dependent(system, terms, rows, &frame, kept)?;
        Characteristics::in_frame(system, terms, rows, frame, &dependent)
    }

    /// Characteristics by the quasi-velocities of `frame` other than `dependent`, one of which belongs to each of `rows`.
    ///
    /// # Errors
    /// [`CharacteristicsError::NotSolvable`] when the dependent quasi-velocities are structurally no unknowns.
    pub fn in_frame(
        system: &System,
        terms: &MotionTerms,
        rows: &[usize],
        frame: Frame,
        dependent: &[usize],
    ) -> Result<Characteristics, CharacteristicsError> {
        let names: Vec<String> = dependent
            .iter()
            .map(|&s| frame.speeds[s].name.clone())
            .collect();
        Builder {
            system,
            terms,
            rows,
            frame,
            dependent,
        }
        .build()
        .map_err(|source| not_solvable(&names, source))
    }

    /// k, the number of independent velocities.
    pub fn k(&self) -> usize {
        self.parameters.len()
    }

    /// The rates of functions of (t, q, P) along a direction on the constraint manifold; P', P'' and multipliers are
    /// constants. Through it implicit dependent quasi-velocities change as f = 0 demands (T1 (54)).
    pub fn along(&self, system: &System, es: &[Expr], direction: &Direction) -> Vec<Expr> {
        let g = &system.graph;
        let mut rates: Vec<(Symbol, Expr)> = self
            .parameters
            .iter()
            .zip(&direction.parameters)
            .map(|(p, &rate)| (p.symbol, rate))
            .collect();
        // A mass with a law of its own changes with the motion, whatever the direction of q.
        rates.extend(mass_rates(system, &self.velocities, direction.time));
        if !self.implicit.is_empty() {
            let of_f = self.derive(system, &self.implicit, direction, &rates);
            let right: Vec<Expr> = of_f.into_iter().map(|e| g.neg(e)).collect();
            // The matrix is nonsingular by form: `build` has solved with it.
            let dependent = g.solve(&self.gradient, &right).unwrap_or_default();
            let speeds = self.dependent.iter().map(|&s| self.frame.speeds[s].symbol);
            rates.extend(speeds.zip(dependent));
        }
        self.derive(system, es, direction, &rates)
    }

    fn derive(
        &self,
        system: &System,
        es: &[Expr],
        direction: &Direction,
        further: &[(Symbol, Expr)],
    ) -> Vec<Expr> {
        let mut rates = match self.order {
            1 => masses_along(system, &direction.coordinates, direction.time),
            _ => {
                let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
                mass_rates(system, &velocities, direction.time)
            }
        };
        rates.extend(further);
        let symbols = self.jets.iter().map(|c| c.q_symbol);
        rates.extend(symbols.zip(direction.coordinates.iter().copied()));
        derive_with(system, es, direction.time, self.order - 1, &rates)
    }

    /// The partial derivatives `∂e/∂P_σ` on the constraint manifold: one row per expression, one column per parameter.
    pub fn by_parameters(&self, system: &System, es: &[Expr]) -> Vec<Vec<Expr>> {
        let columns: Vec<Vec<Expr>> = (0..self.k())
            .map(|sigma| self.along(system, es, &self.parameter_direction(system, sigma)))
            .collect();
        transposed(es.len(), &columns)
    }

    /// The derivatives `Σ_i w_i ∂e/∂q^i` on the constraint manifold with P and t frozen.
    pub fn by_coordinates(&self, system: &System, es: &[Expr], weights: &[Expr]) -> Vec<Expr> {
        let zero = system.graph.zero();
        let direction = Direction {
            time: zero,
            coordinates: weights.to_vec(),
            parameters: vec![zero; self.k()],
        };
        self.along(system, es, &direction)
    }

    /// `∂e/∂π_σ = Σ_s B_sσ ∂e/∂q^s` with P frozen (T2 (10)): one row per expression, one column per parameter.
    pub fn by_quasi_coordinates(&self, system: &System, es: &[Expr]) -> Vec<Vec<Expr>> {
        let columns: Vec<Vec<Expr>> = (0..self.k())
            .map(|sigma| self.by_coordinates(system, es, &self.column(sigma)))
            .collect();
        transposed(es.len(), &columns)
    }

    /// The total derivatives D along the jet (t, q, P, P').
    pub fn total_derivative(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let direction = Direction {
            time: system.graph.one(),
            coordinates: self.velocities.clone(),
            parameters: self.parameters.iter().map(|p| p.rate).collect(),
        };
        self.along(system, es, &direction)
    }

    /// The total derivatives with P' = 0: along the velocities with frozen quasi-velocities.
    pub fn frozen_derivative(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let direction = Direction {
            time: system.graph.one(),
            coordinates: self.velocities.clone(),
            parameters: vec![system.graph.zero(); self.k()],
        };
        self.along(system, es, &direction)
    }

    /// Column σ of B.
    pub fn column(&self, sigma: usize) -> Vec<Expr> {
        self.basis.iter().map(|row| row[sigma]).collect()
    }

    /// `Σ_i w_i B_iσ` for σ = 1..k.
    pub fn contract(&self, system: &System, covector: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        (0..self.k())
            .map(|sigma| dot(g, covector, self.basis.iter().map(|row| &row[sigma])))
            .collect()
    }

    /// Replaces the velocities by φ and leaves the rest.
    pub fn restrict(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let pairs: Vec<(Expr, Expr)> = self
            .jets
            .iter()
            .zip(&self.velocities)
            .filter(|(c, phi)| c.v != **phi)
            .map(|(c, phi)| (c.v, *phi))
            .collect();
        system.graph.substitute_all(es, &pairs)
    }

    /// Replaces velocities and accelerations by φ and Dφ: functions on the jet (t, q, P, P').
    pub fn on_jet(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let mut pairs = Vec::new();
        for (i, c) in self.jets.iter().enumerate() {
            pairs.push((c.v, self.velocities[i]));
            pairs.push((c.a, self.accelerations[i]));
        }
        system.graph.substitute_all(es, &pairs)
    }

    /// P' from k equations `e = 0` that are linear in P'.
    ///
    /// # Errors
    /// [`SolveError`] where they are structurally dependent.
    pub fn rates_from(&self, system: &System, equations: &[Expr]) -> Result<Vec<Expr>, SolveError> {
        let g = &system.graph;
        let symbols: Vec<Symbol> = self.parameters.iter().map(|p| p.rate_symbol).collect();
        solve_linear(g, equations, &symbols)
    }

    /// P' from equations of motion that are linear in it.
    ///
    /// # Errors
    /// [`SolveError`] where they are structurally dependent.
    pub fn rates_of(&self, system: &System, motion: &[Equation]) -> Result<Vec<Expr>, SolveError> {
        let sides = motion.iter();
        let residuals: Vec<Expr> = sides.map(|e| system.graph.sub(e.left, e.right)).collect();
        self.rates_from(system, &residuals)
    }

    /// The implicit constraints with the dependent quasi-velocities they determine, as they are kept along a motion.
    pub fn implicit(&self) -> impl Iterator<Item = (Expr, &Speed)> {
        let speeds = self.dependent.iter().map(|&s| &self.frame.speeds[s]);
        self.implicit.iter().copied().zip(speeds)
    }

    fn parameter_direction(&self, system: &System, sigma: usize) -> Direction {
        let g = &system.graph;
        let mut parameters = vec![g.zero(); self.k()];
        parameters[sigma] = g.one();
        Direction {
            time: g.zero(),
            coordinates: vec![g.zero(); system.n()],
            parameters,
        }
    }
}

fn transposed(rows: usize, columns: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    (0..rows)
        .map(|i| columns.iter().map(|column| column[i]).collect())
        .collect()
}

/// The rates of the masses with a law of their own where t changes at the rate `time`, at given velocities.
pub(crate) fn mass_rates(system: &System, velocities: &[Expr], time: Expr) -> Vec<(Symbol, Expr)> {
    let g = &system.graph;
    if system.masses.is_empty() || g.is_zero(time) {
        return Vec::new();
    }
    let rates = system.mass_rates(velocities).into_iter();
    rates
        .map(|(symbol, rate)| (symbol, g.mul(&[time, rate])))
        .collect()
}

/// The rates of functions when q moves along `coordinates`, t at the rate `time`, and further symbols at the rates given;
/// every other symbol is a constant. A mass with a law of its own changes as at the velocities `coordinates`/`time`, unless
/// its rate is among those given, and not at all where t does not.
pub fn derive_along(
    system: &System,
    es: &[Expr],
    coordinates: &[Expr],
    time: Expr,
    further: &[(Symbol, Expr)],
) -> Vec<Expr> {
    let rates = coordinates.iter().copied();
    let symbols = system.coordinates.iter().map(|c| c.q_symbol);
    let mut all = masses_along(system, coordinates, time);
    all.extend(further);
    all.extend(symbols.zip(rates));
    derive_with(system, es, time, 0, &all)
}

/// The rates of the masses with a law of their own when q moves along `coordinates` and t at the rate `time`.
fn masses_along(system: &System, coordinates: &[Expr], time: Expr) -> Vec<(Symbol, Expr)> {
    let g = &system.graph;
    if system.masses.is_empty() || g.is_zero(time) {
        return Vec::new();
    }
    let velocities: Vec<Expr> = coordinates.iter().map(|&v| g.div(v, time)).collect();
    mass_rates(system, &velocities, time)
}

/// The rates of functions when t moves at the rate `time`, derivatives of coordinates of orders below `lower` with it, and
/// further symbols at the rates given; every other symbol is a constant.
fn derive_with(
    system: &System,
    es: &[Expr],
    time: Expr,
    lower: u32,
    rates: &[(Symbol, Expr)],
) -> Vec<Expr> {
    let g = &system.graph;
    let rates: FxHashMap<Symbol, Expr> = rates.iter().copied().collect();
    let known = |rate: Expr| (!g.is_zero(rate)).then_some(rate);
    g.derive(es, &|s| {
        if let Some(&rate) = rates.get(&s) {
            return known(rate);
        }
        if system.masses.iter().any(|m| m.symbol == s) {
            return None;
        }
        let (name, order) = (g.symbol_name(s), g.symbol_order(s));
        match order < lower && system.coordinate_index(name).is_some() {
            true => known(g.mul(&[time, g.symbol(name, order + 1)])),
            false => known(g.mul(&[time, system.prescribed_rate(s)?])),
        }
    })
}

fn not_solvable(names: &[String], source: SolveError) -> CharacteristicsError {
    CharacteristicsError::NotSolvable {
        dependent: names.join(", "),
        source,
    }
}

/// Dependent quasi-velocities of a frame, by the pivots of ∂f/∂η at a sampled state; the first `kept` stay independent where
/// possible.
fn choose_dependent(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    frame: &Frame,
    kept: usize,
) -> Result<Vec<usize>, CharacteristicsError> {
    let (g, n) = (&system.graph, system.n());
    let gradient: Vec<Vec<Expr>> = rows
        .iter()
        .map(|&row| speed_gradient(system, &terms.jacobian[row], frame))
        .collect();
    let names = || CharacteristicsError::NoAdmissibleState {
        names: crate::words::quoted(
            rows.iter()
                .map(|&row| &system.constraints[terms.constraint_index[row]].name),
        ),
    };
    let point = sample::admissible_point(system, terms, 0x0c4e_7ae5).ok_or_else(names)?;
    let values = g
        .evaluate_f64(&gradient.concat(), &|s| point.get(&s).copied())
        .map_err(|_| names())?;
    let cost: Vec<Vec<usize>> = gradient
        .iter()
        .map(|row| {
            let penalty = |s| if s < kept { 10_000_000 } else { 0 };
            (0..n)
                .map(|s| penalty(s) + pivot_cost(system, row[s], usize::MAX))
                .collect()
        })
        .collect();
    let chosen = eliminate(values, cost, n);
    match chosen.dependent.len() == rows.len() {
        true => Ok(chosen.dependent),
        false => Err(names()),
    }
}

/// `∂f/∂η^s = Σ_i ∂f/∂v^i X_s^i`, as a function of (q, v, t).
fn speed_gradient(system: &System, by_velocities: &[Expr], frame: &Frame) -> Vec<Expr> {
    let g = &system.graph;
    let fields = frame.fields.iter();
    fields.map(|field| dot(g, by_velocities, field)).collect()
}

struct Builder<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    rows: &'a [usize],
    frame: Frame,
    dependent: &'a [usize],
}

impl Builder<'_> {
    fn build(self) -> Result<Characteristics, SolveError> {
        let (system, g) = (self.system, &self.system.graph);
        let n = system.n();
        let independent: Vec<usize> = (0..n).filter(|s| !self.dependent.contains(s)).collect();
        let is_natural = self.frame.is_natural_of(&self.terms.jets);
        let is_adapted = self
            .rows
            .iter()
            .zip(self.dependent)
            .all(|(&row, &s)| self.frame.adapted.contains(&(row, s)));
        let in_frame = self.constraints_in_frame();
        let gradient = self.dependent_gradient(&in_frame);
        let is_explicit = self.is_affine_in_dependent(&gradient);
        let solved = if is_adapted {
            vec![g.zero(); self.dependent.len()]
        } else if is_explicit {
            self.solved(&in_frame, &gradient)?
        } else {
            let speeds = self.dependent.iter();
            speeds.map(|&s| self.frame.speeds[s].value).collect()
        };
        let mut speeds: Vec<Expr> = self.frame.speeds.iter().map(|s| s.value).collect();
        for (&s, &value) in self.dependent.iter().zip(&solved) {
            speeds[s] = value;
        }
        let symbol = |s: usize| self.frame.speeds[s].symbol;
        let mut manifold = Manifold::default();
        let mut implicit = Vec::new();
        if !is_adapted && !is_explicit {
            // A first solution shows that the matrix is nonsingular by form.
            g.solve(&gradient, &vec![g.one(); self.dependent.len()])?;
            let pairs = in_frame.iter().copied().zip(self.dependent);
            manifold.implicit = pairs.map(|(f, &s)| (f, symbol(s))).collect();
            implicit = in_frame;
        } else if is_natural {
            let pairs = self.dependent.iter().zip(&solved);
            manifold.solved = pairs.map(|(&s, &value)| (symbol(s), value)).collect();
        }
        let mut characteristics = Characteristics {
            order: self.terms.order,
            jets: self.terms.jets.clone(),
            parameters: independent
                .iter()
                .map(|&s| self.frame.speeds[s].clone())
                .collect(),
            velocities: self.frame.velocities(system, &speeds),
            independent,
            dependent: self.dependent.to_vec(),
            solved,
            basis: Vec::new(),
            accelerations: Vec::new(),
            acceleration_offset: Vec::new(),
            rows: self.rows.to_vec(),
            manifold,
            implicit,
            gradient,
            frame: self.frame,
        };
        characteristics.finish(system);
        Ok(characteristics)
    }

    /// f(q, X_0 + η^s X_s, t) of the rows.
    fn constraints_in_frame(&self) -> Vec<Expr> {
        let system = self.system;
        let stated: Vec<Expr> = self
            .rows
            .iter()
            .map(|&row| self.terms.constraints[row])
            .collect();
        if self.frame.is_natural_of(&self.terms.jets) {
            return stated;
        }
        let speeds: Vec<Expr> = self.frame.speeds.iter().map(|s| s.value).collect();
        let velocities = self.frame.velocities(system, &speeds);
        let pairs: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(velocities)
            .map(|(c, v)| (c.v, v))
            .collect();
        system.graph.substitute_all(&stated, &pairs)
    }

    /// ∂f/∂η^α, r × r, row by row.
    fn dependent_gradient(&self, in_frame: &[Expr]) -> Vec<Expr> {
        let symbols: Vec<Symbol> = self
            .dependent
            .iter()
            .map(|&s| self.frame.speeds[s].symbol)
            .collect();
        self.system.graph.jacobian(in_frame, &symbols).concat()
    }

    /// Whether the constraints give the dependent quasi-velocities in closed form: they may be nonlinear in the independent
    /// ones, as `z' = a sqrt(x'^2 + y'^2)` is.
    fn is_affine_in_dependent(&self, gradient: &[Expr]) -> bool {
        let symbols = self.dependent.iter().map(|&s| self.frame.speeds[s].symbol);
        let symbols: Vec<Symbol> = symbols.collect();
        !self.system.graph.any_contains_any(gradient, &symbols)
    }

    /// F^α from constraints affine in η^α: `∂f/∂η^α F^α = -f` at η^α = 0.
    fn solved(&self, in_frame: &[Expr], gradient: &[Expr]) -> Result<Vec<Expr>, SolveError> {
        let g = &self.system.graph;
        let at_rest: Vec<(Expr, Expr)> = self
            .dependent
            .iter()
            .map(|&s| (self.frame.speeds[s].value, g.zero()))
            .collect();
        let right: Vec<Expr> = g
            .substitute_all(in_frame, &at_rest)
            .into_iter()
            .map(|f| g.neg(f))
            .collect();
        g.solve(gradient, &right)
    }
}

impl Characteristics {
    /// B, Dφ and its part free of P'.
    fn finish(&mut self, system: &System) {
        let g = &system.graph;
        self.basis = self.by_parameters(system, &self.velocities);
        self.acceleration_offset = self.frozen_derivative(system, &self.velocities);
        self.accelerations = self
            .basis
            .iter()
            .zip(&self.acceleration_offset)
            .map(|(row, &offset)| {
                let mut parts = vec![offset];
                for (&entry, p) in row.iter().zip(&self.parameters) {
                    if !g.is_zero(entry) {
                        parts.push(g.mul(&[entry, p.rate]));
                    }
                }
                g.add(&parts)
            })
            .collect();
    }
}
