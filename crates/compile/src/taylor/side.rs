//! What a step asks of series that lie side by side: last orders, sums at its end and rates there, without the coefficients being
//! copied.

use super::{Abreast, Recurring, Taylor, ABREAST};
use crate::evaluate::EvaluateFailure;

impl Taylor {
    /// Which motions of the last [`expand_abreast`](Taylor::expand_abreast) have finite coefficients only, up to `order`.
    pub fn are_finite(&self, order: usize, abreast: &Abreast) -> [bool; ABREAST] {
        match &self.machine {
            Some(machine) if order <= Recurring::most() => {
                machine.finite_four(order, &abreast.running)
            }
            _ => [false; ABREAST],
        }
    }

    /// Writes the coefficients of one order, at least 1, of motion `lane`.
    ///
    /// # Errors
    /// [`EvaluateFailure::NotPrepared`] for an order or a lane that does not exist.
    pub fn coefficients_of_order(
        &self,
        (lane, order): (usize, usize),
        abreast: &Abreast,
        to: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        match &self.machine {
            Some(machine) if lane < ABREAST && (1..=Recurring::most()).contains(&order) => {
                machine.order_of(lane, order, &abreast.running, to);
                Ok(())
            }
            _ => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Sums the series of the last [`expand_abreast`](Taylor::expand_abreast) from order 1 to `order` and their derivatives, that
    /// of motion l at h_l behind its start: by Horner's scheme for both at once, a product rounded before it is added. They are read by
    /// [`ends`](Taylor::ends).
    ///
    /// # Errors
    /// [`EvaluateFailure::NotPrepared`] for an order that does not exist.
    pub fn sum_abreast(
        &self,
        order: usize,
        h: [f64; ABREAST],
        abreast: &mut Abreast,
    ) -> Result<(), EvaluateFailure> {
        match &self.machine {
            Some(machine) if order <= Recurring::most() => {
                machine.sum_four(order, h, &mut abreast.running);
                Ok(())
            }
            _ => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Writes what [`sum_abreast`](Taylor::sum_abreast) found for motion `lane`: the increments of the variables but the first,
    /// and the derivatives.
    pub fn ends(
        &self,
        lane: usize,
        abreast: &Abreast,
        (increments, slopes): (&mut [f64], &mut [f64]),
    ) {
        if let Some(machine) = &self.machine {
            machine.ends_of(lane, &abreast.running, (increments, slopes));
        }
    }

    /// The rates of up to four motions, which are the outputs at (t, z); what became of each. They are read by
    /// [`rates`](Taylor::rates), and not computed again where series start there next.
    ///
    /// # Errors
    /// As [`expand_abreast`](Taylor::expand_abreast).
    pub fn rates_abreast(
        &self,
        motions: [Option<&[f64]>; ABREAST],
        abreast: &mut Abreast,
    ) -> Result<[Result<(), EvaluateFailure>; ABREAST], EvaluateFailure> {
        match &self.machine {
            Some(machine) => machine.rates_four(self, motions, &mut abreast.running),
            None => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Writes the rates of motion `lane` of the last [`rates_abreast`](Taylor::rates_abreast).
    pub fn rates(&self, lane: usize, abreast: &Abreast, rates: &mut [f64]) {
        if let Some(machine) = &self.machine {
            machine.rates_of(lane, &abreast.running, rates);
        }
    }
}
