//! Where the sign of a function decides a force and both sides drive the motion back to its zero: it sticks there (A. F. Filippov 1988,
//! Differential Equations with Discontinuous Righthand Sides, § 4), and steps would chatter across it without end. Both sides are asked at the
//! first step that reaches the zero, whose length the jump has made as short as the tolerance.

use crate::functions::{Functions, FunctionsError};
use crate::numeric::Binding;
use chetaev_integrate::{Control, System};
use chetaev_mechanics::terms::freeze_accelerations;
use chetaev_mechanics::MotionTerms;
use chetaev_symbolic::{Expr, Function, Node};

/// The reason of a halt where the motion sticks on a zero of what is under a sign.
pub(crate) const STUCK: u32 = u32::MAX;

/// Coordinates, velocities and accelerations.
pub(crate) type Place<'a> = (&'a [f64], &'a [f64], &'a [f64]);

/// A flow whose accelerations are asked at states beside the motion.
pub(crate) trait Sides: System {
    /// At a state y; `None` where they have no value.
    fn state(&mut self, t: f64, y: &[f64]) -> Option<Place<'_>>;

    /// What looks for where the motion sticks, where forces contain a sign.
    fn looks(&mut self) -> &mut Option<Sticking>;
}

/// Whether a motion sticks at an accepted state, after which the flow goes on as `control` says.
pub(crate) fn sticks<F: Sides>(flow: &mut F, at: (f64, &[f64]), control: &Control) -> bool {
    let Some(mut sticking) = flow.looks().take() else {
        return false;
    };
    let is_same = !matches!(control, Control::ChartSwitched(_));
    let sticks = sticking.holds(flow, at, is_same);
    *flow.looks() = Some(sticking);
    sticks
}

/// Functions under a sign in the forces, with their rates.
#[derive(Clone, Debug)]
pub(crate) struct Sticking {
    functions: Functions,
    n: usize,
    count: usize,
    /// One for each, once a state was accepted.
    seen: Vec<Seen>,
    /// What was seen one state before.
    before: Vec<Seen>,
    /// As printed.
    texts: Vec<String>,
    /// The last accepted state with its time.
    last: Option<(f64, Vec<f64>)>,
    found: Option<Found>,
}

/// A zero on which the motion sticks.
#[derive(Clone, Debug)]
struct Found {
    index: usize,
    /// The accepted state before it.
    before: Option<Before>,
    /// The rate near the zero on the side from which the motion comes.
    arriving: f64,
}

/// An accepted state before a zero.
#[derive(Clone, Debug)]
pub(crate) struct Before {
    pub(crate) t: f64,
    pub(crate) y: Vec<f64>,
    /// The time to the zero.
    pub(crate) rest: f64,
}

/// What was seen of a function at the last accepted state.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    t: f64,
    value: f64,
    /// Along the motion.
    rate: f64,
}

/// A zero that the last step reached.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Zero {
    /// Of which function.
    index: usize,
    /// The function and its rate along the motion, at the accepted state.
    here: (f64, f64),
}

/// Parts of the way to the zero at which both sides are asked: near it on this side, near it and as far beyond it.
const PLACES: [f64; 3] = [0.875, 1.125, 2.0];

impl Zero {
    /// The times after which the motion would be at these places by its rate now, with the sign of the run.
    fn times(&self) -> [f64; 3] {
        PLACES.map(|part| -part * self.here.0 / self.here.1)
    }

    /// Whether the motion is driven back from both sides, by the function and its rate at the three places. A rate that vanishes with the
    /// function, as that of a drag, brings it to rest without a jump; one that changes on the way says nothing yet of the zero.
    fn holds(&self, at: [(f64, f64); 3]) -> bool {
        let [near, beyond, far] = at;
        let is_here = near.0 * self.here.0 > 0.0;
        let is_beyond = beyond.0 * self.here.0 < 0.0 && far.0 * self.here.0 < 0.0;
        let opposes = |a: f64, b: f64| a * b < 0.0;
        let is_back =
            opposes(near.1, beyond.1) && opposes(near.1, far.1) && near.1 * self.here.1 > 0.0;
        let is_same = |a: f64, b: f64| (a - b).abs() <= UNIFORM * a.abs();
        let is_uniform = is_same(self.here.1, near.1) && is_same(far.1, beyond.1);
        is_here && is_beyond && is_back && is_uniform
    }
}

/// The rate on each side changes by no more than this part of it, so close to the zero is the motion.
const UNIFORM: f64 = 0.1;

impl Sticking {
    /// The functions of the state under a sign, or between the two sides of an absolute value that is differentiated, in the forces; `None` where there are none.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn new(
        system: &chetaev_mechanics::System,
        terms: &MotionTerms,
        binding: &Binding,
    ) -> Result<Option<Sticking>, FunctionsError> {
        let g = &system.graph;
        let moving = |e: &Expr| !g.is_free_of(*e, &|s| system.moves(g.symbol_name(s)));
        let mut values: Vec<Expr> = Vec::new();
        for part in g.reachable(&terms.force) {
            let Node::Apply {
                function: Function::Sign,
                arguments,
            } = g.node(part)
            else {
                continue;
            };
            values.extend(arguments.iter().filter(|e| moving(e)));
        }
        values.dedup();
        if values.is_empty() {
            return Ok(None);
        }
        let texts = values.iter().map(|&e| g.text(e)).collect();
        let drift = freeze_accelerations(system, &values);
        let slopes = g.jacobian(&values, &system.velocity_symbols()).concat();
        let groups = [
            ("value", values.clone()),
            ("drift", drift),
            ("slope", slopes),
        ];
        Ok(Some(Sticking {
            functions: Functions::new(g, binding, &binding.variables, &groups)?,
            n: system.n(),
            seen: Vec::new(),
            before: Vec::new(),
            count: values.len(),
            texts,
            last: None,
            found: None,
        }))
    }

    /// Forgets what was seen, for a run from (t, q, v).
    pub(crate) fn begin(&mut self, t: f64, q: &[f64], v: &[f64]) {
        self.seen.clear();
        if self.functions.evaluate(t, &[q, v]).is_ok() {
            let at_start = |&value: &f64| Seen {
                t,
                value,
                ..Seen::default()
            };
            self.seen
                .extend(self.functions.group(0).iter().map(at_start));
        }
        self.last = None;
        self.found = None;
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.functions.set_parameters(values)
    }

    /// Whether the motion sticks at an accepted state; where it does not the state is kept, unless what follows is in other variables.
    fn holds<F: Sides>(&mut self, flow: &mut F, (t, y): (f64, &[f64]), is_same: bool) -> bool {
        if !is_same {
            self.last = None;
        }
        let sticks = self.is_driven_back(flow, t, y);
        if !sticks {
            self.last = Some((t, y.to_vec()));
        }
        sticks
    }

    /// Whether an accepted state lies beside a zero to which both sides lead back.
    fn is_driven_back<F: Sides>(&mut self, flow: &mut F, t: f64, y: &[f64]) -> bool {
        let mut rates = vec![0.0; y.len()];
        if flow.derivative(t, y, &mut rates).is_err() {
            return false;
        }
        let here = flow.state(t, y);
        let Some(zero) = here.and_then(|state| self.look(t, state)) else {
            return false;
        };
        let at = zero.times().map(|after| {
            let there = y.iter().zip(&rates).map(|(y, rate)| y + after * rate);
            let state = flow.state(t + after, &there.collect::<Vec<f64>>())?;
            self.at(zero.index, t + after, state)
        });
        // The flow is at the accepted state again.
        let is_back = flow.state(t, y).is_some();
        match at {
            [Some(near), Some(beyond), Some(far)] if is_back => {
                self.sticks(zero, [near, beyond, far])
            }
            _ => false,
        }
    }

    /// Takes an accepted state with its accelerations into account: the zero of a function that the last step reached, where the motion is
    /// driven back to it. What is under a sign decides there between two accelerations, and Filippov's condition for the motion to stay is that
    /// both lead to the zero.
    fn look(&mut self, t: f64, state: Place<'_>) -> Option<Zero> {
        let rates = (0..self.count).map(|index| self.at(index, t, state));
        let now: Vec<(f64, f64)> = rates.collect::<Option<_>>()?;
        self.before = std::mem::take(&mut self.seen);
        let mut found = None;
        for (index, (value, rate)) in now.into_iter().enumerate() {
            let last = self.before.get(index);
            self.seen.push(Seen { t, value, rate });
            if let (Some(last), None) = (last, found) {
                let forward = (t - last.t).signum();
                let is_back = value * rate * forward < 0.0;
                if is_back && last.reaches_zero(t, value) {
                    let here = (value, rate);
                    found = Some(Zero { index, here });
                }
            }
        }
        found
    }

    /// Whether the motion sticks on a zero, by what was found at its three places.
    fn sticks(&mut self, zero: Zero, at: [(f64, f64); 3]) -> bool {
        if !zero.holds(at) {
            return false;
        }
        let [near, beyond, _] = at;
        let from = self.before.get(zero.index).copied().unwrap_or_default();
        let arriving = if from.value * near.0 > 0.0 {
            near.1
        } else {
            beyond.1
        };
        let before = self.last.take().map(|(t, y)| Before {
            t,
            y,
            rest: from.time_to_zero(arriving),
        });
        self.found = Some(Found {
            index: zero.index,
            before,
            arriving,
        });
        true
    }

    /// The accepted state before the zero on which the motion sticks, where its variables are those of now.
    pub(crate) fn before(&mut self) -> Option<Before> {
        let before = self.found.as_mut()?.before.take()?;
        // The motion goes on from there.
        self.seen = std::mem::take(&mut self.before);
        Some(before)
    }

    /// The time from the last accepted state to the zero on which the motion was seen to stick.
    pub(crate) fn rest(&self) -> Option<f64> {
        let found = self.found.as_ref()?;
        let seen = self.seen.get(found.index)?;
        Some(seen.time_to_zero(found.arriving))
    }

    /// A function with its rate at a state.
    fn at(&mut self, index: usize, t: f64, (q, v, a): Place<'_>) -> Option<(f64, f64)> {
        self.functions.evaluate(t, &[q, v]).ok()?;
        let slopes = &self.functions.group(2)[index * self.n..(index + 1) * self.n];
        let along: f64 = slopes.iter().zip(a).map(|(s, a)| s * a).sum();
        let rate = self.functions.group(1)[index] + along;
        Some((self.functions.group(0)[index], rate))
    }

    /// The function on whose zero the motion sticks.
    pub(crate) fn text(&self) -> Option<&str> {
        self.found
            .as_ref()
            .map(|found| &self.texts[found.index][..])
    }
}

impl Seen {
    /// When a function with this rate now and the other at its zero vanishes, its rate changing uniformly.
    fn time_to_zero(&self, arriving: f64) -> f64 {
        -2.0 * self.value / (self.rate + arriving)
    }

    /// Whether the step from here to a time with another value reached the zero: it changed the sign, or had to by its rate.
    fn reaches_zero(&self, t: f64, value: f64) -> bool {
        let covered = self.value + self.rate * (t - self.t);
        self.value == 0.0 || self.value * value < 0.0 || self.value * covered < 0.0
    }
}
