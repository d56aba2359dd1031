//! `witness.action#…`: actions of curves beside the computed motion, at varied times and at its energy.
//!
//! The motion is moved to `q + ε Δq`, and the action of the moved curve is evaluated as it stands, for several ε on both sides; nothing
//! is varied by formulas. Lagrange's principle: the moved curve runs with the energy h of the motion, which at each of its points
//! is solved for its speed. Jacobi's: P is evaluated on the moved path. With a parameter: the times move too, `t + ε Δt`.

use super::algebra::times;
use super::claims::{elsewhere, is_fixed, nothing_varies, vanishing};
use super::common::Common;
use super::neighbours::{Admissible, Neighbours, COORDINATES};
use super::refined::{longest, worst, Refined, Rule, Span, Term};
use super::states::{Change, States};
use super::wave::Wave;
use super::{evidence, show, Figure};
use chetaev_mechanics::claims::{full_id, Claim, Context, Finding, Group, Scope};
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::sample::Generator;
use chetaev_symbolic::{Expr, Verdict};
use std::sync::Arc;

/// A principle of least action, or the identity behind them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Action {
    /// `Δ∫L dt + ∫Σ Q δq dt = [−H Δt + Σ p Δq]`, nothing asked of the ends.
    Identity,
    /// `Δ∫Σ p v dt = 0` at fixed energy.
    Lagrange,
    /// `δ∫P dτ = 0`.
    Jacobi,
    /// `δ∫Λ dτ + ∫Σ Q (δq − v δt) dt = 0` in (q, t).
    Parametric,
}

impl Action {
    /// All of them.
    pub(super) const ALL: [Action; 4] = [
        Action::Identity,
        Action::Lagrange,
        Action::Jacobi,
        Action::Parametric,
    ];

    /// The subject of its claim, which is that of `action.…`.
    pub(super) fn word(self) -> &'static str {
        match self {
            Action::Identity => "identity",
            Action::Lagrange => "lagrange",
            Action::Jacobi => "jacobi",
            Action::Parametric => "parametric",
        }
    }

    /// What is integrated.
    pub(super) fn whose(self) -> &'static str {
        match self {
            Action::Identity => "the action at varied times less its end terms",
            Action::Lagrange => "Lagrange's action at the energy of the motion",
            Action::Jacobi => "Jacobi's action",
            Action::Parametric => "the action with a parameter",
        }
    }

    pub(super) fn rule(self) -> Rule {
        match self {
            Action::Identity => Rule::Open,
            _ => Rule::Vanishing,
        }
    }
}

/// `witness.action#PRINCIPLE`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfLeastAction;

impl Claim for WitnessOfLeastAction {
    fn id(&self) -> &'static str {
        "witness.action"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "The action of curves beside the computed motion does not change to first order"
    }

    fn explanation(&self) -> &'static str {
        "The computed motion is moved to q + ε Δq, with random virtual Δq, and the action of the moved curve is evaluated as it stands for ε on both sides of zero; its derivative by ε is the first variation. \
         `lagrange`: the moved curve has the same ends and the energy h of the motion, which is solved for its speed at each point: ∫Σ p v dt with its own times. `jacobi`: ∫(√(2(h + L₀)) √(2F) + L₁) dτ of the moved path, \
         whatever τ is, on the longest stretch without rest. `parametric`: the time is moved too, t + ε Δt, Δq − v Δt virtual and all zero at the ends: ∫Λ dτ and the work of the forces. \
         `identity`: the same with ends that move: the change is [−H Δt + Σ p Δq]. Each is taken over the sizes of its terms and must vanish as the step of the quadrature is halved; `refuted` means that it does not. Terms of L linear in the velocities stay under the integrals. \
         Example: x = t from 0 to 1, L = x'²/2, moved to t + ε t (1 − t) at the energy 1/2: x' = 1 again, and ∫x' x' dt = ∫x' dx = 1 for every ε."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        vec![full_id(&proved_by(subject), None)]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if evidence(cx).is_none() || cx.terms.order != 1 || cx.system.n() > COORDINATES {
            return Vec::new();
        }
        Action::ALL.map(|a| Some(a.word().to_string())).to_vec()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let action = Action::ALL.into_iter().find(|a| Some(a.word()) == subject);
        let Some(action) = action else {
            return Verdict::undecided("there is no such principle").into();
        };
        let proof = proved_by(subject);
        if !matches!(cx.finding(&proof).verdict, Verdict::Proved(_)) {
            let detail = "the principle is not proved of this system";
            return Verdict::not_applicable(proof, detail).into();
        }
        if is_fixed(cx) && action != Action::Identity && action != Action::Parametric {
            return nothing_varies("virtual displacements").into();
        }
        match compute(cx, action) {
            Ok(found) => {
                let verdict = vanishing(&found, action.whose(), "first variation");
                show(cx, Figure::Action, (action.word(), action.whose()), found);
                verdict.into()
            }
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

/// The claim that proves what is witnessed.
fn proved_by(subject: Option<&str>) -> String {
    format!("action.{}", subject.unwrap_or("identity"))
}

/// What the action of curves beside the motion that satisfy the constraints and have its ends changes by.
///
/// # Errors
/// That it was not computed.
pub(super) fn among_admissible(cx: &Context<'_>, action: Action) -> Result<Neighbours, String> {
    let mut varied = Varied::new(cx, action)?;
    let span = varied.span()?;
    let admissible = Admissible::new(cx, Some(span.first..span.first + span.count + 1))?;
    admissible.changes(&mut |row, eta, rate| {
        let moved = Moved {
            displacement: eta.to_vec(),
            change: Change {
                coordinates: eta.to_vec(),
                velocities: rate.to_vec(),
                ..Change::default()
            },
            time_rate: 0.0,
            size: 0.0,
        };
        varied.change(row, &moved)
    })
}

/// Near rest, where `Σ ∂H/∂v·v` is below this part of its largest value, the energy does not determine the speed.
const REST: f64 = 0.05;
/// Steps of Newton for the speed.
const STEPS: usize = 12;
/// A speed is found when a step changes it by less, or the last one by not much more.
const FOUND: f64 = 1e-13;
const NEARLY: f64 = 1e-10;

fn compute(cx: &Context<'_>, action: Action) -> Result<Refined, String> {
    let mut varied = Varied::new(cx, action)?;
    let span = varied.span()?;
    let n = cx.system.n();
    worst(|generator| {
        let wave = |generator: &mut Generator| match action.rule() {
            Rule::Vanishing => Wave::vanishing(generator),
            Rule::Open => Wave::free(generator),
        };
        let waves: Vec<Wave> = (0..=n).map(|_| wave(generator)).collect();
        varied.integral(&span, &waves)
    })
}

/// The functions of the state that an action consists of, and what its variation is measured by.
pub(super) struct Varied {
    action: Action,
    n: usize,
    common: Arc<Common>,
    states: States,
    /// The energy of the motion.
    pub(super) energy: f64,
    /// Whether the ends are left out of the identity, which is wrong: for tests.
    pub(super) without_ends: bool,
    /// Whether the moved curve keeps the times of the motion instead of its energy, which is wrong: for tests.
    pub(super) keeps_times: bool,
}

impl Varied {
    pub(super) fn new(cx: &Context<'_>, action: Action) -> Result<Varied, String> {
        let common = Common::of(cx)?;
        Ok(Varied {
            action,
            n: common.n,
            states: match functions(cx, action) {
                Some(functions) => States::new(cx, &functions)?,
                None => common.lagrangian.clone(),
            },
            energy: common.energy(0),
            common,
            without_ends: false,
            keeps_times: false,
        })
    }

    /// The rows that are integrated over: all, or those of the longest stretch without rest.
    pub(super) fn span(&self) -> Result<Span, String> {
        let count = self.common.times().len();
        let stretch = |row: usize| self.common.stretch(row);
        let largest = (0..count).fold(0.0_f64, |m, row| m.max(stretch(row).abs()));
        let sign = |row: usize| stretch(row).signum();
        let rows = match self.action {
            Action::Identity | Action::Parametric => 0..count,
            Action::Lagrange | Action::Jacobi => longest(count, |row| {
                stretch(row).abs() > REST * largest && (row == 0 || sign(row) == sign(row - 1))
            }),
        };
        let what = "the motion is not at rest";
        Span::new(self.common.times(), &rows, (self.action.rule(), what))
    }

    /// The integral for one variation: virtual displacements from the first n functions, Δt from the last.
    pub(super) fn integral(&mut self, span: &Span, waves: &[Wave]) -> Result<Refined, String> {
        let mut terms: Vec<Term> = Vec::new();
        let mut ends = (0.0, 0.0);
        let last = span.first + span.count;
        for (row, share) in span.rows() {
            let of: Vec<(f64, f64)> = waves.iter().map(|w| w.at(share, span.length())).collect();
            let moved = self
                .moved(row, &of)
                .ok_or("the gradients of the constraints are dependent at a row")?;
            let value = self
                .change(row, &moved)
                .ok_or("the action of a curve beside the motion has no value")?;
            terms.push((value, moved.size));
            if (row == span.first || row == last) && self.action == Action::Identity {
                let (at, size) = self.end(row, &moved);
                ends.0 += if row == last { at } else { -at };
                ends.1 += size;
            }
        }
        if self.without_ends {
            ends.0 = 0.0;
        }
        span.integral(self.action.rule(), |_| Some(terms.clone()), ends)
    }

    /// The variation of the state at a row.
    fn moved(&self, row: usize, of: &[(f64, f64)]) -> Option<Moved> {
        let (free, time) = of.split_at(self.n);
        let common = &self.common;
        let (displacement, moved) = common.projected(row, free)?;
        let mut size = common.central(row, &displacement, &moved).1;
        let (time, time_rate) = match self.action {
            Action::Lagrange | Action::Jacobi => (0.0, 0.0),
            Action::Identity | Action::Parametric => {
                let natural = common.natural_time();
                (time[0].0 * natural, time[0].1 * natural)
            }
        };
        // Δq = δq + v Δt, D(Δq) = D(δq) + a Δt + v D(Δt).
        let speeds = common.velocities(row);
        let velocities = speeds.iter().zip(common.accelerations(row));
        let coordinates = displacement
            .iter()
            .zip(speeds)
            .map(|(d, v)| d + v * time)
            .collect();
        let rates: Vec<f64> = moved
            .iter()
            .zip(velocities)
            .map(|(d, (v, a))| d + a * time + v * time_rate)
            .collect();
        let of_time = common.energy(row).abs() + common.lagrangian(row).abs();
        size += (of_time * time_rate).abs() + common.noise(row);
        Some(Moved {
            displacement,
            change: Change {
                coordinates,
                velocities: rates,
                masses: common
                    .mass_rates(row)
                    .iter()
                    .map(|rate| rate * time)
                    .collect(),
                time,
            },
            time_rate,
            size,
        })
    }

    /// `−H Δt + Σ p Δq` at a row, and the sizes of its terms.
    fn end(&self, row: usize, moved: &Moved) -> Term {
        let of_time = -self.common.energy(row) * moved.change.time;
        let momenta = self.common.momenta(row).iter();
        let pairs = momenta.zip(&moved.change.coordinates);
        let parts: Vec<f64> = pairs.map(|(p, d)| p * d).collect();
        let sizes: f64 = parts.iter().map(|x| x.abs()).sum();
        (of_time + parts.iter().sum::<f64>(), of_time.abs() + sizes)
    }

    /// The derivative by ε of what stands under the integral, as one by the time of the motion.
    fn change(&mut self, row: usize, moved: &Moved) -> Option<f64> {
        let velocities = self.common.velocities(row).to_vec();
        let (action, energy) = (self.action, self.energy);
        let keeps_times = self.keeps_times;
        let change = self.states.derivative(|states, e| match action {
            Action::Lagrange if keeps_times => {
                let pairs = velocities.iter().zip(&moved.change.velocities);
                let speeds: Vec<f64> = pairs.map(|(v, d)| v + e * d).collect();
                let of = states.at(row, e, &moved.change);
                Some(of_speeds(&of, &speeds).0)
            }
            Action::Lagrange => at_energy(states, (row, e), (&velocities, &moved.change), energy),
            Action::Jacobi => {
                let of = states.at(row, e, &moved.change);
                let root = (2.0 * (energy + of[0])).sqrt() * (2.0 * of[1]).sqrt();
                Some(root + of[2]).filter(|x| x.is_finite())
            }
            Action::Identity | Action::Parametric => {
                let slower = 1.0 + e * moved.time_rate;
                let pairs = velocities.iter().zip(&moved.change.velocities);
                // (v + ε D(Δq))/(1 + ε D(Δt)) as a change of v times ε.
                let scaled = Change {
                    velocities: pairs
                        .map(|(v, d)| (d - v * moved.time_rate) / slower)
                        .collect(),
                    ..moved.change.clone()
                };
                Some(states.at(row, e, &scaled)[0] * slower).filter(|x| x.is_finite())
            }
        })?;
        let work = self.common.forces(row).iter().zip(&moved.displacement);
        Some(change + work.map(|(a, b)| a * b).sum::<f64>())
    }
}

/// A variation at a row.
struct Moved {
    /// δq.
    displacement: Vec<f64>,
    change: Change,
    /// D(Δt).
    time_rate: f64,
    /// The sizes of the terms of the first variation.
    size: f64,
}

/// What has to be known beside the motion, where it is not L.
fn functions(cx: &Context<'_>, action: Action) -> Option<Vec<Expr>> {
    let (system, g) = (cx.system, &cx.system.graph);
    match action {
        Action::Identity | Action::Parametric => None,
        Action::Lagrange => {
            // Σ p v and v·W v are formed of numbers: as expressions they would grow.
            let mut all = vec![system.lagrangian];
            all.extend(g.gradient(system.lagrangian, &system.velocity_symbols()));
            all.extend(cx.terms.mass_matrix.concat());
            Some(all)
        }
        Action::Jacobi => {
            let coordinates = system.coordinates.iter();
            let rest: Vec<(Expr, Expr)> = coordinates.clone().map(|c| (c.v, g.zero())).collect();
            let at_rest = g.substitute(system.lagrangian, &rest);
            let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
            let momenta = g.substitute_all(&momenta, &rest);
            let linear = dot(g, &momenta, coordinates.map(|c| &c.v));
            let quadratic = g.sub(system.lagrangian, g.add(&[at_rest, linear]));
            Some(vec![at_rest, quadratic, linear])
        }
    }
}

/// `Σ p v`, `H` and `v·W v` of L, p and W at a velocity.
fn of_speeds(of: &[f64], speeds: &[f64]) -> (f64, f64, f64) {
    let n = speeds.len();
    let dot = |a: &[f64]| a.iter().zip(speeds).map(|(a, b)| a * b).sum::<f64>();
    let integrand = dot(&of[1..=n]);
    let stretch = dot(&times(&of[1 + n..], n, speeds));
    (integrand, integrand - of[0], stretch)
}

/// `Σ p v` of the moved curve at the speed that gives it the energy, times the time it takes by the time of the motion: with
/// v = s (v + ε D(Δq)) its time runs 1/s times as fast.
fn at_energy(
    states: &mut States,
    (row, e): (usize, f64),
    (velocities, varied): (&[f64], &Change),
    energy: f64,
) -> Option<f64> {
    let mut speed = 1.0_f64;
    for step in 1..=STEPS {
        // s (v + ε d) is v moved by ε times (s d + (s − 1) v/ε).
        let pairs = velocities.iter().zip(&varied.velocities);
        let moved = Change {
            velocities: pairs
                .clone()
                .map(|(v, d)| speed * d + (speed - 1.0) * v / e)
                .collect(),
            ..varied.clone()
        };
        let speeds: Vec<f64> = pairs.map(|(v, d)| speed * (v + e * d)).collect();
        let (integrand, own, stretch) = of_speeds(&states.at(row, e, &moved), &speeds);
        // Exact where H is quadratic in the speed, Newton's step otherwise to first order.
        let change = speed * ((1.0 + 2.0 * (energy - own) / stretch).sqrt() - 1.0);
        if !change.is_finite() {
            return None;
        }
        if change.abs() < if step < STEPS { FOUND } else { NEARLY } {
            return Some(integrand / speed);
        }
        speed += change;
        if speed <= 0.0 {
            return None;
        }
    }
    None
}
