//! Periodic orbits by shooting, their monodromy matrices, and the multipliers of Floquet (1883).
//!
//! `φ_T(z) = z`, up to whole turns of angles, with φ and its derivatives by Taylor series ([`Variational`]). Where the equations do not contain the
//! time the period is unknown as well, and the phase is fixed by `f(z₀) · (z − z₀) = 0` (Doedel 1981); where they do the period is given.

use crate::branch::{Equations, Kind, Linearized};
use crate::error::OrbitError;
use crate::flow::Flow;
use crate::multipliers::{split, Named, Spectrum};
use crate::subspace::complement;
use crate::variational::{Column, Extended, Order, Variational};
use chetaev_integrate::Output;
use chetaev_motion::functions::Functions;
use chetaev_symbolic::{Expr, Symbol};
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

/// The equations of periodic orbits; the unknowns are the start z, and the period where it is not given.
#[derive(Debug)]
pub struct Shooting<'f> {
    flow: &'f Flow,
    /// The place of the parameter that is varied.
    place: Option<usize>,
    variational: Variational,
    functions: Functions,
    values: Vec<f64>,
    is_forced: bool,
    /// A start with its rates, which fix the phase.
    phase: Option<(DVector<f64>, DVector<f64>)>,
    /// The last passage, with the unknowns and the parameter it belongs to.
    last: Option<(Vec<f64>, f64, Extended)>,
}

/// Groups of the functions.
const RATES: usize = 0;
const FINITE: usize = 1;
const SLOPES: usize = 2;
const BY_PARAMETER: usize = 3;
const GRADIENTS: usize = 4;
const PERIOD: usize = 5;

/// A gradient is that of an integral where a passage changes it by less, in parts of its size.
const INVARIANT: f64 = 1e-7;
/// Places beside an orbit at which rates of integrals are looked at, and how far they are, in parts of its size.
const PLACES: usize = 3;
const BESIDE: f64 = 1e-2;
/// A rate below this part of its terms vanishes.
const CONSTANT: f64 = 1e-9;
/// Rates that differ by less a period later, in parts of their size, are the same.
const REPEATED: f64 = 1e-7;
/// An orbit that runs a shorter way in a period, in parts of the size of its state, is a steady motion.
const AT_REST: f64 = 1e-6;
/// Test functions below this vanish by structure.
const STRUCTURAL: f64 = 1e-8;

impl<'f> Shooting<'f> {
    /// The periodic orbits of a flow, a parameter being varied; `period` is a function of the parameters where the equations contain the time.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn new(
        flow: &'f Flow,
        parameter: Option<Symbol>,
        period: Option<Expr>,
    ) -> Result<Shooting<'f>, OrbitError> {
        let g = &flow.graph;
        let is_forced = !flow.is_autonomous();
        if is_forced && period.is_none() {
            return Err(OrbitError::PeriodMissing);
        }
        let place = parameter.map(|s| {
            flow.place(s).ok_or_else(|| OrbitError::NoValue {
                name: g.symbol_text(s),
            })
        });
        let place = place.transpose()?;
        let by: Vec<Symbol> = parameter.into_iter().collect();
        let conserved: Vec<Expr> = flow.conserved.iter().map(|own| own.1).collect();
        let period: Vec<Expr> = period.filter(|_| is_forced).into_iter().collect();
        let of_period = [period.clone(), g.jacobian(&period, &by).concat()].concat();
        let groups = [
            ("rates", flow.rates.clone()),
            ("finite", flow.finite.clone()),
            ("slopes", g.jacobian(&flow.finite, &flow.variables).concat()),
            ("by parameter", g.jacobian(&flow.finite, &by).concat()),
            (
                "gradients",
                g.jacobian(&conserved, &flow.variables).concat(),
            ),
            ("period", of_period),
        ];
        let columns = (0..flow.n()).map(Column::Initial);
        let columns = columns.chain(by.iter().map(|&s| Column::Parameter(s)));
        Ok(Shooting {
            variational: Variational::new(flow, columns.collect(), Order::First)?,
            functions: flow.functions(&groups)?,
            values: flow.parameters.iter().map(|own| own.1).collect(),
            flow,
            place,
            is_forced,
            phase: None,
            last: None,
        })
    }

    /// The unknowns of a start and a guess of the period.
    pub fn unknowns(&self, start: &[f64], period: f64) -> Vec<f64> {
        let mut all = start.to_vec();
        if !self.is_forced {
            all.push(period);
        }
        all
    }

    fn set(&mut self, p: f64) -> Result<(), OrbitError> {
        if let Some(place) = self
            .place
            .filter(|&at| self.values[at].to_bits() != p.to_bits())
        {
            self.values[place] = p;
            self.functions.set_parameters(&self.values)?;
            self.variational.set(place, p)?;
        }
        Ok(())
    }

    /// The period, and its derivative by the parameter.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn period(&mut self, x: &[f64], p: f64) -> Result<(f64, f64), OrbitError> {
        if !self.is_forced {
            return Ok((x[self.flow.n()], 0.0));
        }
        self.set(p)?;
        self.functions.evaluate(0.0, &[&x[..self.flow.n()]])?;
        let own = self.functions.group(PERIOD);
        Ok((own[0], own.get(1).copied().unwrap_or(0.0)))
    }

    /// The motion through one period.
    ///
    /// # Errors
    /// [`OrbitError::EndsEarly`].
    pub fn passage(&mut self, x: &[f64], p: f64) -> Result<Extended, OrbitError> {
        if let Some((known, at, passage)) = &self.last {
            if known == x && at.to_bits() == p.to_bits() {
                return Ok(passage.clone());
            }
        }
        self.set(p)?;
        let (period, _) = self.period(x, p)?;
        let start = Extended::start(&x[..self.flow.n()], &self.variational);
        let found = self.variational.end((0.0, period), &start)?;
        self.last = Some((x.to_vec(), p, found.clone()));
        Ok(found)
    }

    /// The monodromy matrix ∂φ_T/∂z.
    ///
    /// # Errors
    /// [`OrbitError::EndsEarly`].
    pub fn monodromy(&mut self, x: &[f64], p: f64) -> Result<DMatrix<f64>, OrbitError> {
        let n = self.flow.n();
        Ok(self.passage(x, p)?.first.columns(0, n).into())
    }

    fn rates(&mut self, t: f64, z: &[f64]) -> Result<DVector<f64>, OrbitError> {
        self.functions.evaluate(t, &[z])?;
        Ok(DVector::from_column_slice(self.functions.group(RATES)))
    }

    /// Rows of the run through one period, at equal steps of the time.
    ///
    /// # Errors
    /// [`OrbitError::EndsEarly`].
    pub fn rows(
        &mut self,
        x: &[f64],
        p: f64,
        count: usize,
    ) -> Result<Vec<(f64, Vec<f64>)>, OrbitError> {
        self.set(p)?;
        let (period, _) = self.period(x, p)?;
        let start = Extended::start(&x[..self.flow.n()], &self.variational);
        let output = Output::Every(period / count.max(1) as f64);
        let rows = self.variational.run((0.0, period), &start, output)?;
        Ok(rows.into_iter().map(|(t, own)| (t, own.state)).collect())
    }
}

impl Shooting<'_> {
    /// Whether the rate of a candidate for an integral vanishes beside a state at several times: its gradient may be invariant at one value of the
    /// parameter alone, as where a multiplier passes 1. Off finite constraints that is not asked.
    fn is_constant(&mut self, k: usize, state: &[f64]) -> Result<bool, OrbitError> {
        let n = state.len();
        if !self.flow.finite.is_empty() {
            return Ok(true);
        }
        for at in 1..=PLACES {
            let step = |i: usize| BESIDE * ((i * 7 + at * 3) as f64).sin();
            let beside = state.iter().enumerate();
            let beside: Vec<f64> = beside.map(|(i, z)| z + step(i) * (1.0 + z.abs())).collect();
            let rates = self.rates(at as f64, &beside)?;
            let slopes = &self.functions.group(GRADIENTS)[k * n..(k + 1) * n];
            let terms: Vec<f64> = slopes.iter().zip(&rates).map(|(a, b)| a * b).collect();
            let size: f64 = terms.iter().map(|x| x.abs()).sum();
            if terms.iter().sum::<f64>().abs() > CONSTANT * size {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl Shooting<'_> {
    /// An error where the rates are not the same a period later: what closes after that time does not repeat.
    fn repeat(&mut self, z: &[f64], p: f64) -> Result<(), OrbitError> {
        let (period, _) = self.period(z, p)?;
        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for k in 1..=PLACES {
            // No whole part of the period.
            let t = period * (k as f64).sqrt().fract();
            let (now, later) = (self.rates(t, z)?, self.rates(t + period, z)?);
            change = change.max((&later - &now).amax());
            size = size.max(now.amax());
        }
        if change <= REPEATED * size {
            return Ok(());
        }
        Err(OrbitError::NotRepeated {
            period,
            own: self.flow.periods(z, &self.values),
        })
    }
}

impl Equations for Shooting<'_> {
    fn what(&self) -> &'static str {
        "periodic orbit"
    }

    fn evaluate(&mut self, x: &[f64], p: f64) -> Result<Linearized, OrbitError> {
        let n = self.flow.n();
        let end = self.passage(x, p)?;
        let (period, period_by_parameter) = self.period(x, p)?;
        let start = DVector::from_column_slice(&x[..n]);
        let at_end = self.rates(period, &end.state)?;
        let at_start = self.rates(0.0, &x[..n])?;
        let size = x[..n].iter().fold(1.0_f64, |a, x| a.max(x.abs()));
        if !self.is_forced && at_start.amax() * period.abs() < AT_REST * size {
            return Err(OrbitError::Steady);
        }
        let finite = self.functions.group(FINITE).to_vec();
        let slopes = self.functions.group(SLOPES).to_vec();
        let by_parameter = self.functions.group(BY_PARAMETER).to_vec();
        let has_phase = usize::from(!self.is_forced);
        let rows = n + finite.len() + has_phase;
        let mut own = Linearized {
            residual: DVector::zeros(rows),
            by_unknowns: DMatrix::zeros(rows, x.len()),
            by_parameter: DVector::zeros(rows),
        };
        for i in 0..n {
            let change = end.state[i] - x[i];
            let turns = if self.flow.is_turning[i] {
                (change / TAU).round()
            } else {
                0.0
            };
            own.residual[i] = change - turns * TAU;
            if self.place.is_some() {
                own.by_parameter[i] = end.first[(i, n)] + at_end[i] * period_by_parameter;
            }
        }
        let monodromy = end.first.columns(0, n) - DMatrix::identity(n, n);
        own.by_unknowns
            .view_mut((0, 0), (n, n))
            .copy_from(&monodromy);
        for (r, value) in finite.iter().enumerate() {
            own.residual[n + r] = *value;
            for c in 0..n {
                own.by_unknowns[(n + r, c)] = slopes[r * n + c];
            }
            own.by_parameter[n + r] = by_parameter.get(r).copied().unwrap_or(0.0);
        }
        if !self.is_forced {
            own.by_unknowns.view_mut((0, n), (n, 1)).copy_from(&at_end);
            let (anchor, along) = self
                .phase
                .get_or_insert_with(|| (start.clone(), at_start.clone()));
            // In units of the rates, so that slow motions do not make it singular.
            let along = along.normalize();
            own.residual[rows - 1] = along.dot(&(start - &*anchor));
            own.by_unknowns
                .view_mut((rows - 1, 0), (1, n))
                .copy_from(&along.transpose());
        }
        Ok(own)
    }

    fn spectrum(&mut self, x: &[f64], p: f64, family: usize) -> Result<Spectrum, OrbitError> {
        let n = self.flow.n();
        let monodromy = self.monodromy(x, p)?;
        let rates = self.rates(0.0, &x[..n])?;
        let slopes =
            DMatrix::from_row_slice(self.flow.finite.len(), n, self.functions.group(SLOPES));
        let gradients = self.functions.group(GRADIENTS).to_vec();
        let mut left: Vec<Named> = slopes
            .row_iter()
            .map(|row| ("a finite constraint".to_owned(), row.transpose()))
            .collect();
        // An integral is one on admissible states, and its gradient is known up to those of finite constraints.
        let admissible = complement(n, &slopes.transpose());
        for (k, (name, _)) in self.flow.conserved.iter().enumerate() {
            let gradient = DVector::from_column_slice(&gradients[k * n..(k + 1) * n]);
            let change = admissible.tr_mul(&(monodromy.tr_mul(&gradient) - &gradient));
            let is_invariant =
                change.norm() <= INVARIANT * gradient.norm() * (1.0 + monodromy.norm());
            if is_invariant && self.is_constant(k, &x[..n])? {
                left.push((name.clone(), gradient));
            }
        }
        let right: Vec<Named> = if self.is_forced {
            Vec::new()
        } else {
            vec![("the direction along the orbit".to_owned(), rates)]
        };
        let mut found = split(&monodromy, &left, &right)?;
        let of_integrals = found
            .trivial
            .iter()
            .filter(|name| !name.starts_with("the direction"));
        // What integrals do not explain is a family of orbits by another reason.
        for _ in of_integrals.count()..family {
            let nearest = found.values.iter().enumerate();
            let distance = |l: &Complex<f64>| (l - 1.0).norm();
            let nearest = nearest.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
            if let Some((place, _)) = nearest.filter(|(_, l)| distance(l) < 1e-4) {
                found.values.remove(place);
                found.trivial.push("the family of orbits".to_owned());
            }
        }
        Ok(found)
    }

    fn tests(&self, values: &[Complex<f64>], _: f64) -> Vec<f64> {
        let one = Complex::new(1.0, 0.0);
        let through = |at: Complex<f64>| -> Complex<f64> {
            let parts = values.iter().map(|l| (l - at) / (1.0 + l.norm()));
            parts.product()
        };
        let pairs: Complex<f64> = pairs(values).product();
        vec![through(one).re, through(-one).re, pairs.re]
    }

    fn vanish(&self, values: &[Complex<f64>]) -> Vec<bool> {
        let is_any = pairs(values).any(|own| own.norm() < STRUCTURAL);
        vec![false, false, is_any]
    }

    fn kind(
        &mut self,
        test: usize,
        _: (&[f64], f64),
        spectrum: &Spectrum,
        turns: bool,
    ) -> Result<Option<Kind>, OrbitError> {
        // Real multipliers whose product is 1 pass no circle.
        let is_pair = |l: &&Complex<f64>| l.im > 1e-6 && (l.norm() - 1.0).abs() < 1e-6;
        Ok(match test {
            0 if turns => Some(Kind::Fold),
            0 => Some(Kind::BranchPoint),
            1 => Some(Kind::PeriodDoubling),
            _ => spectrum
                .values
                .iter()
                .find(is_pair)
                .map(|l| Kind::Torus { angle: l.arg() }),
        })
    }

    /// The phase is fixed by the rates of the point before: beyond a steady motion they have the other sign.
    fn runs_back(
        &mut self,
        (x, p): (&[f64], f64),
        (y, q): (&[f64], f64),
    ) -> Result<bool, OrbitError> {
        if self.is_forced {
            return Ok(false);
        }
        let n = self.flow.n();
        self.set(p)?;
        let before = self.rates(0.0, &x[..n])?;
        self.set(q)?;
        let after = self.rates(0.0, &y[..n])?;
        Ok(before.dot(&after) < 0.0)
    }

    fn accepted(&mut self, x: &[f64], p: f64) -> Result<(), OrbitError> {
        self.set(p)?;
        if self.is_forced {
            self.repeat(x, p)?;
        } else {
            let n = self.flow.n();
            let along = self.rates(0.0, &x[..n])?;
            self.phase = Some((DVector::from_column_slice(&x[..n]), along));
        }
        Ok(())
    }
}

/// How far the products of two multipliers are from 1.
fn pairs(values: &[Complex<f64>]) -> impl Iterator<Item = Complex<f64>> + '_ {
    let beside = |i: usize| values[i + 1..].iter();
    let part = |a: &Complex<f64>, b: &Complex<f64>| (a * b - 1.0) / (1.0 + a.norm() * b.norm());
    let all = values.iter().enumerate();
    all.flat_map(move |(i, a)| beside(i).map(move |b| part(a, b)))
}

/// Rows in which a return is looked for.
const ROWS: f64 = 4000.0;
/// How near a return must be, in parts of the size of the motion.
const NEAR: f64 = 0.25;

/// The state at which a motion arrives.
///
/// # Errors
/// [`OrbitError::EndsEarly`].
pub fn arrival(flow: &Flow, start: &[f64], end: f64) -> Result<Vec<f64>, OrbitError> {
    let mut motion = Variational::new(flow, Vec::new(), Order::Motion)?;
    let from = Extended::start(start, &motion);
    Ok(motion.end((0.0, end), &from)?.state)
}

/// Steps of Newton's method to the time at which a motion is nearest to its start.
const REFINEMENTS: usize = 6;

/// A guess of the period of an orbit near a state: the time of the nearest of the first returns to it before `end`.
///
/// # Errors
/// [`OrbitError::NoReturn`].
pub fn period_guess(flow: &Flow, start: &[f64], end: f64) -> Result<f64, OrbitError> {
    let mut motion = Variational::new(flow, Vec::new(), Order::Motion)?;
    let from = Extended::start(start, &motion);
    let rows = motion.run((0.0, end), &from, Output::Every(end / ROWS))?;
    let away = |z: &[f64]| -> DVector<f64> {
        let parts = z.iter().zip(start).zip(&flow.is_turning);
        let own = parts.map(|((z, z0), &turns)| {
            let own = z - z0;
            if turns {
                own - (own / TAU).round() * TAU
            } else {
                own
            }
        });
        DVector::from_iterator(z.len(), own)
    };
    let distance = |(_, own): &(f64, Extended)| away(&own.state).norm();
    let all: Vec<f64> = rows.iter().map(distance).collect();
    let size = all.iter().copied().fold(0.0, f64::max);
    let minima = (1..all.len().saturating_sub(1))
        .filter(|&i| all[i] < all[i - 1] && all[i] <= all[i + 1] && all[i] < NEAR * size);
    let candidates: Vec<usize> = minima.collect();
    let nearest = candidates
        .iter()
        .map(|&i| all[i])
        .fold(f64::INFINITY, f64::min);
    // The first that is about as near as any: later ones are whole numbers of periods.
    let found = candidates
        .into_iter()
        .find(|&i| all[i] <= nearest + 0.02 * size);
    let found = found.ok_or(OrbitError::NoReturn { end })?;
    let [(t, before), (mut period, own), (last, _)] =
        [found - 1, found, found + 1].map(|i| rows[i].clone());
    // The time at which the motion is nearest, so that a start on an orbit belongs to the one that is found.
    let mut state = own.state;
    for _ in 0..REFINEMENTS {
        let values = flow
            .parameters
            .iter()
            .map(|own| own.1)
            .collect::<Vec<f64>>();
        let rates = {
            let value = flow.values_at(&state, &values);
            flow.graph.evaluate_f64(&flow.rates, &value)
        };
        let Ok(rates) = rates.map(DVector::from_vec) else {
            break;
        };
        let next = period - rates.dot(&away(&state)) / rates.norm_squared();
        if !(next > t && next < last) || next.to_bits() == period.to_bits() {
            break;
        }
        period = next;
        state = motion.end((t, period), &before)?.state;
    }
    Ok(period)
}
