//! The velocities of consistent initial data, and why there are none.

use super::{advice, largest, InitialError, Search, EXACT, MOST_NAMED, SATISFIED, STARTS};
use super::{DEPENDENT, DEPENDENT_BY_ROUNDING};
use crate::chart::scale;
use crate::least_norm::{identity, least_step, least_step_of, norm};
use crate::nearest::{both, draw, perturb, reach, Nearest, DRAWS};
use chetaev_compile::rounding::Rounded;
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
        let is_found = if self.moves_data(&self.data.v_fixed) && !self.system.is_affine() {
            self.nearest_velocities(&movable)
        } else {
            self.search_velocities(&movable)
        };
        if is_found {
            return Ok(());
        }
        self.contradiction()?;
        self.evaluate()?;
        let rows: Vec<usize> = (0..self.system.r).collect();
        let worst = self.violations(&rows, &self.system.rounded());
        let cannot_hold = self.wrong_velocities(&movable);
        let all: Vec<usize> = (0..self.system.n).collect();
        let is_found = if self.system.is_affine() {
            self.search_velocities(&all)
        } else {
            self.nearest_velocities(&all)
        };
        if !is_found {
            return Err(self.no_real_velocity(&given));
        }
        let nearest = self.describe(&given, &self.v.clone(), "'");
        Err(InitialError::Inconsistent {
            kind: "velocity",
            constraint: worst.0,
            residual: worst.1,
            advice: advice(&nearest, &cannot_hold, self.system.is_affine()),
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
            let at = self.system.rounded();
            if at.are_met(EXACT) {
                // A state that is given may be singular and is diagnosed as such; one that is searched for must not be.
                return step == 0 || self.has_gradients();
            }
            // Relative to the terms: residuals of different constraints have different units.
            let size = relative(&at.residual);
            stalled = if size < 0.9 * best { 0 } else { stalled + 1 };
            best = best.min(size);
            if stalled > 8 {
                break;
            }
            let of = (self.system.jacobian(), self.system.residual());
            let change = least_step_of(of, n, movable, self.system.mass(), self.dependent);
            for (x, dx) in self.v.iter_mut().zip(&change) {
                *x -= dx;
            }
        }
        if self.evaluate().is_ok()
            && self.has_gradients()
            && self.system.rounded().are_met(SATISFIED)
        {
            return true;
        }
        self.is_met_without_remains(movable)
    }

    /// Whether the constraints are met once velocities that are nothing but rounding are zero: against the others they carry no
    /// kinetic energy, but where all terms of a constraint are such remains, its residual is as large as these.
    fn is_met_without_remains(&mut self, movable: &[usize]) -> bool {
        let found = self.v.clone();
        let mass = self.system.mass_diagonal();
        let speeds: Vec<f64> = mass
            .iter()
            .zip(&found)
            .map(|(m, v)| m.abs().sqrt() * v.abs())
            .collect();
        let remains = f64::EPSILON * largest(&speeds);
        for &i in movable.iter().filter(|&&i| speeds[i] < remains) {
            self.v[i] = 0.0;
        }
        let is_met = self.v != found
            && self.evaluate().is_ok()
            && self.has_gradients()
            && self.system.rounded().are_met(SATISFIED);
        if !is_met {
            self.v = found;
        }
        is_met
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
            if relative(&self.system.rounded().residual) < 1e-9 {
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
        for dependent in [DEPENDENT, DEPENDENT_BY_ROUNDING] {
            self.dependent = dependent;
            if self.newton_velocities(movable) {
                return true;
            }
            self.v.clone_from(&start);
        }
        self.dependent = DEPENDENT;
        if self.damped_velocities(movable) && self.newton_velocities(movable) {
            return true;
        }
        self.nearest_velocities(movable)
    }

    /// The nearest of the solutions that several starting points lead to, each moved to where the distance is least; leaves v as it was when
    /// none is found.
    fn nearest_velocities(&mut self, movable: &[usize]) -> bool {
        let start = self.v.clone();
        let searched = both(movable, &self.system.constrained_velocities);
        let mut generator = chetaev_mechanics::sample::Generator::new(7);
        let (metric, step) = match self.evaluate() {
            Ok(()) => {
                let metric = self.system.metric();
                let of = (self.system.jacobian(), self.system.residual());
                let step = least_step_of(of, self.system.n, movable, &metric, self.dependent);
                (metric, step)
            }
            // Where there is none at the start, as at a root of zero, velocities count alike.
            Err(_) => (identity(self.system.n), vec![0.0; self.system.n]),
        };
        let reach = reach(&start, &step, &metric);
        let mut nearest = Nearest::to(&start, &metric);
        for count in 0..STARTS {
            self.v.clone_from(&start);
            if count > 0 {
                perturb(&mut self.v, &searched, &reach, &mut generator);
            }
            if !self.newton_velocities(movable) {
                continue;
            }
            nearest.offer(&self.v);
            if self.draw_velocities_near((&start, &metric), movable)
                && self.newton_velocities(movable)
            {
                nearest.offer(&self.v);
            }
        }
        let found = nearest.found.clone();
        let is_found = found.is_some();
        self.v = found.unwrap_or(start);
        is_found && self.evaluate().is_ok()
    }

    /// Given velocities of which each may be the wrong one: with it free the others can hold.
    fn wrong_velocities(&mut self, movable: &[usize]) -> Vec<String> {
        let (mut wrong, given) = (Vec::new(), self.v.clone());
        for i in (0..self.system.n).filter(|i| !movable.contains(i)) {
            if wrong.len() == MOST_NAMED || !self.system.constrained_velocities[i] {
                continue;
            }
            let with: Vec<usize> = movable.iter().copied().chain([i]).collect();
            if self.newton_velocities(&with) {
                wrong.push(format!("{}'", self.system.coordinates[i]));
            }
            self.v.clone_from(&given);
        }
        wrong
    }

    fn draw_velocities_near(
        &mut self,
        (start, metric): (&[f64], &[f64]),
        movable: &[usize],
    ) -> bool {
        let n = self.system.n;
        for _ in 0..DRAWS {
            if self.evaluate().is_err() {
                return false;
            }
            let jacobian = self.system.jacobian().to_vec();
            let residual = self.system.residual().to_vec();
            draw(&mut self.v, start, (&jacobian, &residual), |f| {
                least_step(&jacobian, f, n, movable, metric)
            });
        }
        true
    }

    fn no_real_velocity(&mut self, given: &[f64]) -> InitialError {
        self.v = given.to_vec();
        if let Err(error) = self.evaluate() {
            return error;
        }
        let rows: Vec<usize> = (0..self.system.r).collect();
        let (names, residual) = self.violations(&rows, &self.system.rounded());
        InitialError::NoRealVelocity {
            names,
            residual,
            starts: STARTS,
        }
    }

    /// For affine rows: elimination that ends in `0 = c ≠ 0`, beyond rounding, is a contradiction.
    fn contradiction(&mut self) -> Result<(), InitialError> {
        self.evaluate()?;
        let (n, at) = (self.system.n, self.system.rounded());
        let scales: Vec<f64> = self.system.mass_diagonal().into_iter().map(scale).collect();
        let rows: Vec<usize> = (0..self.system.r)
            .filter(|&row| self.system.affine[row])
            .collect();
        let mut reduced: Vec<Line> = Vec::new();
        for (position, &row) in rows.iter().enumerate() {
            let entries = at.gradient[row * n..(row + 1) * n].to_vec();
            let speeds = self.v.iter().map(|&v| Rounded::exact(v));
            let along = entries.iter().zip(speeds).map(|(&a, v)| a * v);
            let mut combination = vec![Rounded::default(); rows.len()];
            combination[position] = Rounded::exact(1.0);
            let mut line = Line {
                value: along.fold(at.residual[row], |sum, part| sum - part),
                entries,
                combination,
            };
            for known in &reduced {
                line.reduce(known, &scales);
            }
            match line.entries.iter().all(|a| a.is_zero(EXACT)) {
                false => reduced.push(line),
                true if line.value.is_zero(SATISFIED) => {}
                true => {
                    let factors: Vec<f64> = line.combination.iter().map(|c| c.value).collect();
                    return Err(self.contradiction_of(&rows, &factors, line.value.value));
                }
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

/// `Σ aⱼ vⱼ + c = 0` with the multiples of the constraints of which it was made.
struct Line {
    entries: Vec<Rounded>,
    value: Rounded,
    combination: Vec<Rounded>,
}

impl Line {
    /// Takes out the velocity that is heaviest in another line.
    fn reduce(&mut self, other: &Line, scales: &[f64]) {
        let size = |j: &usize| other.entries[*j].value.abs() / scales[*j];
        let columns = (0..scales.len()).filter(|&j| !other.entries[j].is_zero(EXACT));
        let Some(column) = columns.max_by(|i, j| size(i).total_cmp(&size(j))) else {
            return;
        };
        let factor = self.entries[column] / other.entries[column];
        let parts = self.entries.iter_mut().chain(&mut self.combination);
        let others = other.entries.iter().chain(&other.combination);
        parts.zip(others).for_each(|(a, &b)| *a = *a - factor * b);
        self.value = self.value - factor * other.value;
        self.entries[column] = Rounded::default();
    }
}

/// The largest residual relative to the size of its terms.
fn relative(residual: &[Rounded]) -> f64 {
    let parts = residual.iter().map(|f| match f.value.abs() {
        size if size > 0.0 => size / f.size(),
        // Infinite for what is not a number.
        size if size.is_nan() => f64::INFINITY,
        _ => 0.0,
    });
    parts.fold(0.0, f64::max)
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
