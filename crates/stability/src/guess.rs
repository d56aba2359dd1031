//! Motions of which guesses are given: among all steady motions the one with the values that are given, nearest to those that are guessed.
//!
//! All steady motions with the values that are given are solved for exactly ([`with_given`]), algebraic numbers among them, so that what is found is
//! exact and no other is nearer. A free parameter of a family takes the value that is guessed for the variable that it stands for. Where the mass matrix is singular no
//! motion is meant if there is another.

use crate::problem::LinearizationError;
use crate::steady_set::{with_given, Found, SteadySet, Value};
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::{Expr, Symbol};
use std::borrow::Cow;

/// Values that differ by less are the same.
const SAME: f64 = 1e-9;

/// The steady motion that is meant by one with guesses; the motion itself where it has none.
///
/// # Errors
/// [`LinearizationError::NotFound`] where the steady motions cannot be solved for exactly, none has the values that are given, or the nearest has
/// no closed form.
pub fn near<'m>(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    (motion, values): (&'m SteadyMotion, &[(Expr, Expr)]),
) -> Result<Cow<'m, SteadyMotion>, LinearizationError> {
    if motion.guesses.is_empty() {
        return Ok(Cow::Borrowed(motion));
    }
    let not_found = |why: String| LinearizationError::NotFound {
        motion: motion.name.clone(),
        why,
    };
    let given = given(system, motion);
    let set = with_given((system, terms, selection), values, &given);
    let set = set.map_err(|problem| not_found(problem.to_string()))?;
    let known = known(system, values);
    let asked = Asked {
        system,
        motion,
        known: &known,
    };
    let member = |own: &Found| {
        let (distance, found) = asked.member(&set, own)?;
        Some((own.is_singular, distance, found))
    };
    let nearest = set.found.iter().filter_map(member);
    let nearest = nearest.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    if let Some((_, distance, found)) = nearest {
        // One without an exact form is at least as far as those of its variables that are enclosed.
        let enclosed = set.found.iter().filter(|own| own.motion.is_none());
        let mut enclosed = enclosed.map(|own| asked.least_distance(&set, own));
        if enclosed.any(|least| least <= distance) {
            return Err(not_found(
                "one without an exact form is as near, or nearer".into(),
            ));
        }
        return Ok(Cow::Owned(found));
    }
    let are_all_compared = set.found.iter().all(|own| own.motion.is_some());
    Err(not_found(if are_all_compared {
        "none of the steady motions has the values that are given".into()
    } else {
        "those without a closed form were not compared, and no other has the values that are given"
            .into()
    }))
}

/// What a motion gives of positions and velocities.
fn given(system: &System, motion: &SteadyMotion) -> Vec<(Expr, Expr)> {
    let coordinates = system.coordinates.iter().enumerate();
    let sides = coordinates.flat_map(|(j, c)| {
        let position = (c.q, (j, 0), motion.positions[j]);
        [position, (c.v, (j, 1), motion.velocities[j])]
    });
    let is_given = |own: &(Expr, (usize, u32), Option<Expr>)| !motion.guesses.contains(&own.1);
    let sides = sides.filter(is_given);
    sides
        .filter_map(|(e, _, value)| Some((e, value?)))
        .collect()
}

/// Parameters in numbers: those that are put in, others as the model states them.
fn known(system: &System, values: &[(Expr, Expr)]) -> Vec<(Symbol, f64)> {
    let g = &system.graph;
    let stated = system.parameter_values();
    let all = values.iter().chain(&stated);
    all.filter_map(|&(symbol, value)| {
        let number = g.evaluate_f64(&[value], &|_| None).ok()?;
        Some((g.as_symbol(symbol)?, *number.first()?))
    })
    .collect()
}

/// A motion with guesses.
struct Asked<'a> {
    system: &'a System,
    motion: &'a SteadyMotion,
    known: &'a [(Symbol, f64)],
}

impl Asked<'_> {
    fn number(&self, e: Expr) -> Option<f64> {
        let value = |s: Symbol| self.known.iter().find(|own| own.0 == s).map(|own| own.1);
        let found = self.system.graph.evaluate_f64(&[e], &value).ok()?;
        found.first().copied().filter(|x| x.is_finite())
    }

    /// What is given or guessed of positions and velocities, velocities that are not being zero.
    fn stated(&self) -> Vec<(Expr, Expr)> {
        let zero = self.system.graph.zero();
        let coordinates = self.system.coordinates.iter();
        let positions = coordinates.clone().zip(&self.motion.positions);
        let velocities = coordinates.zip(&self.motion.velocities);
        let positions = positions.filter_map(|(c, q)| Some((c.q, (*q)?)));
        let velocities = velocities.map(|(c, v)| (c.v, v.unwrap_or(zero)));
        positions.chain(velocities).collect()
    }

    /// A lower bound of the square of the distance of a motion from the guesses, by the variables that are enclosed.
    fn least_distance(&self, set: &SteadySet, own: &Found) -> f64 {
        let coordinates = self.system.coordinates.iter().enumerate();
        let places = coordinates.flat_map(|(j, c)| [((j, 0), c.q), ((j, 1), c.v)]);
        let guessed = places.filter(|(place, _)| self.motion.guesses.contains(place));
        let guessed: Vec<Expr> = guessed.map(|own| own.1).collect();
        let stated = self.stated();
        let apart = |(name, value): (&String, &Value)| {
            let Value::Number { ball, .. } = value else {
                return None;
            };
            let variable = self.variable(set, name).filter(|e| guessed.contains(e))?;
            let guess = stated.iter().find(|own| own.0 == variable)?;
            Some(ball.to_f64() - self.number(guess.1)?)
        };
        let all = set.variables.iter().zip(&own.values).filter_map(apart);
        all.map(|apart| apart * apart * (1.0 - SAME)).sum()
    }

    /// The coordinate or speed of a name.
    fn variable(&self, set: &SteadySet, name: &str) -> Option<Expr> {
        let coordinate = self.system.coordinates.iter().find(|c| c.name == name);
        let speed = set.speeds.iter().find(|(speed, _)| speed == name);
        coordinate.map(|c| c.q).or(speed.map(|(_, e)| *e))
    }

    /// The motion with the values of a steady motion, or of the member of a family that has the stated values for its free parameters, and the
    /// square of its distance from the guesses; `None` where it has other values than those that are given.
    fn member(&self, set: &SteadySet, own: &Found) -> Option<(f64, SteadyMotion)> {
        let (g, stated) = (&self.system.graph, self.stated());
        let free = own.free.iter().map(|&(symbol, at)| {
            let variable = self.variable(set, &set.variables[at])?;
            Some((symbol, g.substitute(variable, &stated)))
        });
        let free: Vec<(Expr, Expr)> = free.collect::<Option<_>>()?;
        let conditions = g.substitute_all(&own.conditions, &free);
        let is_real = |&e: &Expr| self.number(e).is_none_or(|x| x >= -SAME);
        let found = own
            .motion
            .as_ref()
            .filter(|_| conditions.iter().all(is_real))?;
        let member = |all: &[Option<Expr>]| -> Vec<Option<Expr>> {
            let put = |e: &Option<Expr>| e.map(|e| g.substitute(e, &free));
            all.iter().map(put).collect()
        };
        let mut distance = 0.0;
        let mut chosen = self.motion.clone();
        let sides = [
            (0, member(&found.positions), &mut chosen.positions),
            (1, member(&found.velocities), &mut chosen.velocities),
        ];
        for (order, values, places) in sides {
            for (j, (place, value)) in places.iter_mut().zip(values).enumerate() {
                let (Some(stated), Some(value)) = (*place, value) else {
                    continue;
                };
                let (a, b) = (self.number(stated)?, self.number(value)?);
                if self.motion.guesses.contains(&(j, order)) {
                    distance += (a - b) * (a - b);
                    *place = Some(value);
                } else if (a - b).abs() > SAME * (1.0 + a.abs()) {
                    return None;
                }
            }
        }
        chosen.guesses.clear();
        Some((distance, chosen))
    }
}
