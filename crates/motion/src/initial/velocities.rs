//! The velocities of consistent initial data, and why there are none.

use super::{advice, largest, pivot_column, InitialError, Search, STARTS};
use crate::least_norm::{least_step, norm};
use crate::nearest::{both, draw, perturb, Nearest, DRAWS};
use chetaev_mechanics::sample::add_weight;

impl Search<'_> {
    /// Moves free velocities until f = 0.
    pub(super) fn velocities(&mut self) -> Result<(), InitialError> {
        let movable = self.movable(&self.data.v_fixed);
        if let Err(singular) = self.evaluate() {
            // Where velocities that nobody gave are taken as zero, that is no reason to give up, where others were given.
            let mut given = self.data.q_fixed.iter().chain(&self.data.v_fixed);
            let is_asked = self.system.r > 0 && given.any(|&given| given);
            let is_found = is_asked && self.search_velocities(&movable);
            return if is_found { Ok(()) } else { Err(singular) };
        }
        if self.system.r == 0 {
            return Ok(());
        }
        let given = self.v.clone();
        if self.search_velocities(&movable) {
            return Ok(());
        }
        self.contradiction()?;
        self.evaluate()?;
        let rows: Vec<usize> = (0..self.system.r).collect();
        let worst = self.violations(&rows, self.system.residual());
        let all: Vec<usize> = (0..self.system.n).collect();
        if !self.search_velocities(&all) {
            return Err(self.no_real_velocity(&given));
        }
        let nearest = self.describe(&given, &self.v.clone(), "'");
        Err(InitialError::Inconsistent {
            kind: "velocity",
            constraint: worst.0,
            residual: worst.1,
            advice: advice(&nearest),
        })
    }

    /// Newton steps of least kinetic norm; false when they do not converge or leave the domain.
    fn newton_velocities(&mut self, movable: &[usize]) -> bool {
        let n = self.system.n;
        let mut best = f64::INFINITY;
        let mut stalled = 0;
        for step in 0..80 {
            if self.evaluate().is_err() {
                return false;
            }
            let residual = self.system.residual().to_vec();
            let size = largest(&residual);
            let jacobian = self.system.jacobian().to_vec();
            let scale = largest(&jacobian) * (1.0 + largest(&self.v));
            if size <= 4.0 * f64::EPSILON * scale.max(f64::MIN_POSITIVE) {
                // A state that is given may be singular and is diagnosed as such; one that is searched for must not be.
                return step == 0 || self.has_gradients();
            }
            stalled = if size < 0.9 * best { 0 } else { stalled + 1 };
            best = best.min(size);
            if stalled > 8 {
                break;
            }
            let metric = self.system.mass().to_vec();
            let change = least_step(&jacobian, &residual, n, movable, &metric);
            for (x, dx) in self.v.iter_mut().zip(&change) {
                *x -= dx;
            }
        }
        self.evaluate().is_ok()
            && self.has_gradients()
            && largest(self.system.residual()) <= 2e-12 * (1.0 + largest(&self.v))
    }

    /// Newton's steps halved until they help. Directions in which the gradients are seen to change count as heavier from then
    /// on, so that steps follow the ridge of a root of squares instead of crossing it to and fro.
    fn damped_velocities(&mut self, movable: &[usize]) -> bool {
        let n = self.system.n;
        if self.evaluate().is_err() {
            return false;
        }
        let mut metric = self.system.mass().to_vec();
        let weight = 10.0 * largest(&metric);
        for _ in 0..200 {
            let residual = self.system.residual().to_vec();
            if largest(&residual) < 1e-9 {
                return true;
            }
            let jacobian = self.system.jacobian().to_vec();
            let change = least_step(&jacobian, &residual, n, movable, &metric);
            let from = self.v.clone();
            let helps = (0..20).any(|halving| {
                let part = 0.5_f64.powi(halving);
                let shortened = from.iter().zip(&change).map(|(x, dx)| x - part * dx);
                self.v = shortened.collect();
                self.evaluate().is_ok() && norm(self.system.residual()) < norm(&residual)
            });
            if !helps {
                return false;
            }
            for (new, old) in self.system.jacobian().chunks(n).zip(jacobian.chunks(n)) {
                add_weight(&mut metric, new, old, weight);
            }
        }
        false
    }

    /// Newton from the start, and where that fails from several starting points, of whose solutions the nearest is taken;
    /// leaves v as it was when none converges.
    fn search_velocities(&mut self, movable: &[usize]) -> bool {
        let start = self.v.clone();
        if self.newton_velocities(movable) {
            return true;
        }
        self.v.clone_from(&start);
        if self.damped_velocities(movable) && self.newton_velocities(movable) {
            return true;
        }
        let searched = both(movable, &self.system.constrained_velocities);
        let mut generator = chetaev_mechanics::sample::Generator::new(7);
        let mut nearest = Nearest::default();
        for _ in 1..STARTS {
            self.v.clone_from(&start);
            perturb(&mut self.v, &searched, &mut generator);
            if !self.newton_velocities(movable) {
                continue;
            }
            nearest.offer(&start, &self.v);
            if self.draw_velocities_near(&start, movable) && self.newton_velocities(movable) {
                nearest.offer(&start, &self.v);
            }
        }
        let found = nearest.found.is_some();
        self.v = nearest.found.unwrap_or(start);
        found && self.evaluate().is_ok()
    }

    fn draw_velocities_near(&mut self, start: &[f64], movable: &[usize]) -> bool {
        let n = self.system.n;
        for _ in 0..DRAWS {
            if self.evaluate().is_err() {
                return false;
            }
            let jacobian = self.system.jacobian().to_vec();
            let residual = self.system.residual().to_vec();
            let metric = self.system.mass().to_vec();
            draw(&mut self.v, start, (&jacobian, &residual), |f| {
                least_step(&jacobian, f, n, movable, &metric)
            });
        }
        true
    }

    fn no_real_velocity(&mut self, given: &[f64]) -> InitialError {
        self.v = given.to_vec();
        let residual = match self.evaluate() {
            Ok(()) => largest(self.system.residual()),
            Err(error) => return error,
        };
        let names: Vec<String> = (0..self.system.r)
            .filter(|&row| self.system.residual()[row].abs() > 1e-9)
            .map(|row| format!("constraint `{}`", self.system.constraints[row]))
            .collect();
        InitialError::NoRealVelocity {
            names: names.join(" and "),
            residual,
            starts: STARTS,
        }
    }

    /// For affine rows: elimination that ends in `0 = c ≠ 0` is a contradiction.
    fn contradiction(&mut self) -> Result<(), InitialError> {
        self.evaluate()?;
        let n = self.system.n;
        let rows: Vec<usize> = (0..self.system.r)
            .filter(|&row| self.system.affine[row])
            .collect();
        let jacobian = self.system.jacobian();
        let mut reduced: Vec<(Vec<f64>, f64, Vec<f64>)> = Vec::new();
        for (position, &row) in rows.iter().enumerate() {
            let mut line = jacobian[row * n..(row + 1) * n].to_vec();
            let along: f64 = line.iter().zip(&self.v).map(|(a, v)| a * v).sum();
            let mut value = self.system.residual()[row] - along;
            let mut combination = vec![0.0; rows.len()];
            combination[position] = 1.0;
            let length = norm(&line).max(f64::MIN_POSITIVE);
            for (pivot_line, pivot_value, pivot_combination) in &reduced {
                let Some(column) = pivot_column(pivot_line) else {
                    continue;
                };
                let factor = line[column] / pivot_line[column];
                line.iter_mut()
                    .zip(pivot_line)
                    .for_each(|(a, b)| *a -= factor * b);
                line[column] = 0.0;
                value -= factor * pivot_value;
                combination
                    .iter_mut()
                    .zip(pivot_combination)
                    .for_each(|(a, b)| *a -= factor * b);
            }
            if norm(&line) <= 1e-10 * length {
                if value.abs() > 1e-9 * (1.0 + value.abs()) {
                    return Err(self.contradiction_of(&rows, &combination, value));
                }
            } else {
                reduced.push((line, value, combination));
            }
        }
        Ok(())
    }

    fn contradiction_of(&self, rows: &[usize], combination: &[f64], value: f64) -> InitialError {
        let mut names = Vec::new();
        let mut terms: Vec<(f64, &str)> = Vec::new();
        for (&row, &factor) in rows.iter().zip(combination) {
            if factor.abs() > 1e-12 {
                let name = &self.system.constraints[row];
                names.push(format!("`{name}`"));
                terms.push((factor, name));
            }
        }
        // Nobody begins with a minus.
        let sign = terms.first().map_or(1.0, |(factor, _)| factor.signum());
        terms.iter_mut().for_each(|(factor, _)| *factor *= sign);
        let sum = sum_in_words(&terms);
        InitialError::Contradiction {
            names: names.join(", "),
            combination: format!("{sum} gives 0 = {}", short(sign * value)),
        }
    }
}

/// `a - 2 b + 0.3333 c`.
pub(super) fn sum_in_words(terms: &[(f64, &str)]) -> String {
    let mut text = String::new();
    for &(factor, name) in terms {
        text.push_str(match (text.is_empty(), factor < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        match &short(factor.abs())[..] {
            "1" => text.push_str(name),
            number => text.push_str(&format!("{number} {name}")),
        }
    }
    text
}

/// A number with four places at most, and none that are zero at its end; small and large ones with a power of ten.
fn short(x: f64) -> String {
    let size = x.abs();
    if size > 0.0 && !(1e-3..1e7).contains(&size) {
        return format!("{x:.3e}");
    }
    let text = format!("{x:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::sum_in_words;

    #[test]
    fn sums_are_written_as_by_hand() {
        let terms = [(1.0, "a"), (-1.0, "b"), (0.5, "c"), (-1.0 / 3.0, "d")];
        assert_eq!(sum_in_words(&terms), "a - b + 0.5 c - 0.3333 d");
        assert_eq!(
            sum_in_words(&[(-2.0, "a"), (1e-5, "b")]),
            "-2 a + 1.000e-5 b"
        );
    }
}
