//! Taylor series of the motion: the coefficients of a state whose rates are expressions.

use crate::functions::{failure, FunctionsError};
use crate::numeric::Binding;
use chetaev_compile::{Abreast, Lowering, Program, Taylor, TaylorWorkspace, ABREAST};
use chetaev_integrate::EvaluationFailure;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// The program of rates over the time and a state.
///
/// # Errors
/// [`FunctionsError`].
pub(crate) fn program(
    g: &Graph,
    binding: &Binding,
    variables: &[Symbol],
    rates: &[Expr],
) -> Result<Program, FunctionsError> {
    let symbols: Vec<Symbol> = binding.parameters.iter().map(|own| own.0).collect();
    let lowering = Lowering::new(g).variables(variables).parameters(&symbols);
    let lowering = lowering.output("rates", &g.substitute_all(rates, &binding.controls));
    Ok(lowering.lower()?)
}

/// What one order of a series costs, in sums: a convolution as many as a series of usual order has.
///
/// # Errors
/// [`FunctionsError`].
pub(crate) fn cost(program: &Program) -> Result<usize, FunctionsError> {
    let (convolutions, others) = Taylor::interpreter(program)?.counts();
    Ok(12 * convolutions + others)
}

/// The rates of a state (z₁, …, z_m), functions of (t, z), by their Taylor recurrences.
#[derive(Clone, Debug)]
pub struct RateSeries {
    taylor: Taylor,
    workspace: TaylorWorkspace,
    parameters: Vec<f64>,
    /// t and the state.
    inputs: Vec<f64>,
    ahead: Ahead,
    /// The rates at the end of the step.
    end: Ahead,
}

/// A series that was made before it is asked for, together with those of other motions.
#[derive(Clone, Debug, Default)]
struct Ahead {
    /// t and the state.
    inputs: Vec<f64>,
    order: usize,
    /// Orders 1 and higher, behind those of order 0.
    coefficients: Vec<f64>,
    /// Whether its coefficients will be asked for.
    is_whole: bool,
    is_wanted: bool,
    is_known: bool,
}

impl Ahead {
    /// Whether it is the series of that order there.
    fn is(&self, inputs: &[f64], order: usize) -> bool {
        let mut pairs = self.inputs.iter().zip(inputs);
        self.is_known && self.order == order && pairs.all(|(a, b)| a.to_bits() == b.to_bits())
    }
}

impl RateSeries {
    /// The recurrences of `rates` over `variables`, the first of which is the time and the others the state.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        g: &Graph,
        binding: &Binding,
        variables: &[Symbol],
        rates: &[Expr],
    ) -> Result<RateSeries, FunctionsError> {
        let parameters = binding.parameters.iter().map(|&(_, value)| value).collect();
        RateSeries::of(&program(g, binding, variables, rates)?, parameters)
    }

    /// The recurrences of a program of rates, with values of its parameters.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn of(
        program: &Program,
        parameters: Vec<f64>,
    ) -> Result<RateSeries, FunctionsError> {
        let taylor = Taylor::new(program)?;
        let mut series = RateSeries {
            workspace: taylor.workspace(0),
            inputs: vec![0.0; program.variables.len()],
            ahead: Ahead::default(),
            end: Ahead::default(),
            taylor,
            parameters,
        };
        series.make_room(24)?;
        Ok(series)
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.parameters.clear();
        self.parameters.extend_from_slice(values);
        (self.ahead, self.end) = (Ahead::default(), Ahead::default());
        Ok(self.taylor.prepare(values, &mut self.workspace)?)
    }

    fn make_room(&mut self, order: usize) -> Result<(), FunctionsError> {
        self.workspace = self.taylor.workspace(order);
        Ok(self.taylor.prepare(&self.parameters, &mut self.workspace)?)
    }

    /// Writes `z_[0], …, z_[order]` through (t, z), one after the other.
    ///
    /// # Errors
    /// Why the rates have no Taylor series there.
    pub fn expand(
        &mut self,
        t: f64,
        z: &[f64],
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        if order > self.workspace.capacity() && self.make_room(order).is_err() {
            return Err(EvaluationFailure::NoSeries);
        }
        self.inputs[0] = t;
        self.inputs[1..].copy_from_slice(z);
        let coefficients = &mut coefficients[..(order + 1) * z.len()];
        let ahead = if order == 1 { &self.end } else { &self.ahead };
        if ahead.is(&self.inputs, order) {
            coefficients.copy_from_slice(&ahead.coefficients[..coefficients.len()]);
            coefficients[..z.len()].copy_from_slice(z);
            return Ok(());
        }
        let workspace = &mut self.workspace;
        self.taylor
            .expand(&self.inputs, order, workspace, coefficients)
            .map_err(failure)
    }
}

impl RateSeries {
    /// Says that the series of this order through (t, z) will be asked for next, or only what the end of the step needs of it
    /// where it is not wanted as a whole. That of order 1 gives the rates at this end.
    pub(crate) fn announce(&mut self, t: f64, z: &[f64], (order, is_whole): (usize, bool)) {
        let ahead = if order == 1 {
            &mut self.end
        } else {
            &mut self.ahead
        };
        ahead.inputs.clear();
        ahead.inputs.push(t);
        ahead.inputs.extend_from_slice(z);
        (ahead.order, ahead.is_whole) = (order, is_whole);
        ahead.coefficients.resize((order + 1) * z.len(), 0.0);
        (ahead.is_wanted, ahead.is_known) = (true, false);
    }
}

/// Makes series of several motions at once, each with the bits that it has alone.
#[derive(Clone, Debug)]
pub(crate) struct SideBySide {
    taylor: Taylor,
    abreast: Abreast,
    /// The parameters set for each place.
    parameters: [Option<Vec<f64>>; ABREAST],
    /// The order of the series made last.
    order: usize,
    /// What a step of one motion adds, and its derivative at the end.
    increments: Vec<f64>,
    slopes: Vec<f64>,
}

impl SideBySide {
    /// For motions whose series are those of `series`; `None` where there is no machine code for several.
    pub(crate) fn of(series: &RateSeries) -> Option<SideBySide> {
        Some(SideBySide {
            abreast: series.taylor.abreast()?,
            taylor: series.taylor.clone(),
            parameters: Default::default(),
            order: 0,
            increments: vec![0.0; series.taylor.output_count()],
            slopes: vec![0.0; series.taylor.output_count()],
        })
    }

    /// Makes the series that were announced, and says which of them lie here, so that steps may be made of them; they are copied
    /// where they are wanted as a whole. What cannot be made here is made when it is asked for, with its failure.
    pub(crate) fn make<'s>(
        &mut self,
        motions: impl Iterator<Item = Option<&'s mut RateSeries>>,
    ) -> [bool; ABREAST] {
        let mut lie_here = [false; ABREAST];
        let mut wanted: [Option<&mut RateSeries>; ABREAST] = Default::default();
        for (lane, motion) in motions.enumerate().take(ABREAST) {
            wanted[lane] = motion.filter(|own| {
                own.ahead.is_wanted
                    && own.taylor.is_same_code(&self.taylor)
                    && own.ahead.order <= Taylor::most()
            });
            if let Some(own) = &mut wanted[lane] {
                own.ahead.is_wanted = false;
                if !self.prepare(lane, &own.parameters) {
                    wanted[lane] = None;
                }
            }
        }
        let order = wanted.iter().flatten().map(|own| own.ahead.order).max();
        // One alone is as quick by itself.
        let Some(order) = order.filter(|_| wanted.iter().flatten().count() > 1) else {
            return lie_here;
        };
        let mut inputs = [None; ABREAST];
        for (input, own) in inputs.iter_mut().zip(&wanted) {
            *input = own.as_ref().map(|own| &own.ahead.inputs[..]);
        }
        let Ok(outcome) = self.taylor.expand_abreast(inputs, order, &mut self.abreast) else {
            return lie_here;
        };
        let are_finite = self.taylor.are_finite(order, &self.abreast);
        self.order = order;
        for (lane, own) in wanted.into_iter().enumerate() {
            if let Some(RateSeries { ahead, .. }) = own.filter(|_| outcome[lane].is_ok()) {
                lie_here[lane] = are_finite[lane] && ahead.order == order;
                if lie_here[lane] && !ahead.is_whole {
                    continue;
                }
                let (order, to) = (ahead.order, &mut ahead.coefficients);
                let read = self.taylor.coefficients(lane, order, &self.abreast, to);
                ahead.is_known = read.is_ok();
            }
        }
        lie_here
    }

    /// Writes the coefficients of one order of the series of a place, at least 1.
    pub(crate) fn row(&self, lane: usize, order: usize, to: &mut [f64]) {
        let place = (lane, order);
        let written = self.taylor.coefficients_of_order(place, &self.abreast, to);
        if written.is_err() {
            to.fill(f64::NAN);
        }
    }

    /// Sums the series that lie here at the ends of steps of these lengths.
    pub(crate) fn sum(&mut self, h: [f64; ABREAST]) {
        let order = self.order;
        // The order is one of a series that was made.
        let _ = self.taylor.sum_abreast(order, h, &mut self.abreast);
    }

    /// What [`sum`](SideBySide::sum) found at a place: the increments, and the derivatives.
    pub(crate) fn end(&mut self, lane: usize) -> (&[f64], &[f64]) {
        let to = (&mut self.increments[..], &mut self.slopes[..]);
        self.taylor.ends(lane, &self.abreast, to);
        (&self.increments, &self.slopes)
    }

    /// Computes the rates that were announced at the ends of steps.
    pub(crate) fn rates<'s>(&mut self, motions: impl Iterator<Item = Option<&'s mut RateSeries>>) {
        let mut wanted: [Option<&mut Ahead>; ABREAST] = Default::default();
        for (wanted, motion) in wanted.iter_mut().zip(motions) {
            *wanted = motion.map(|own| &mut own.end).filter(|end| end.is_wanted);
            if let Some(end) = wanted {
                end.is_wanted = false;
            }
        }
        let mut inputs = [None; ABREAST];
        for (input, own) in inputs.iter_mut().zip(&wanted) {
            *input = own.as_ref().map(|own| &own.inputs[..]);
        }
        let Ok(outcome) = self.taylor.rates_abreast(inputs, &mut self.abreast) else {
            return;
        };
        for (lane, own) in wanted.into_iter().enumerate() {
            if let Some(end) = own.filter(|_| outcome[lane].is_ok()) {
                let rates = end.inputs.len() - 1;
                let to = &mut end.coefficients[rates..];
                self.taylor.rates(lane, &self.abreast, to);
                end.is_known = true;
            }
        }
    }

    /// Sets the parameters of a place where they are others; false where they cannot be.
    fn prepare(&mut self, lane: usize, parameters: &[f64]) -> bool {
        let set = &mut self.parameters[lane];
        if set.as_deref() == Some(parameters) {
            return true;
        }
        let done = self
            .taylor
            .prepare_abreast(lane, parameters, &mut self.abreast);
        *set = done.is_ok().then(|| parameters.to_vec());
        done.is_ok()
    }
}
