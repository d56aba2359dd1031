//! `witness.other-time#…`: equations that principles give in another time τ, integrated there and compared with the motion.
//!
//! The state and the time itself are integrated over τ by the rule of Runge and Kutta of the fourth order, with doubled steps. At each
//! node the positions are compared with those of the computed motion at the time that came out.

use super::algebra::solved;
use super::claims::{elsewhere, is_fixed, judged, nothing_varies};
use super::neighbours::COORDINATES;
use super::refined::{longest, Refined, Rule, Span, STRIDES};
use super::samples::{rows, Samples};
use super::{evidence, show, Figure};
use crate::motion_evidence::MotionEvidence;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::formulation::{basis, derive};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group, Scope};
use chetaev_mechanics::equations::{unused_name, EquationGroup};
use chetaev_mechanics::Equations;
use chetaev_motion::observe::Observer;
use chetaev_principles::chaplygin_multiplier::{reducer, Reducer};
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A time that is not t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Time {
    /// `dτ = N dt` with Chaplygin's multiplier.
    Chaplygin,
    /// The arc length of the kinetic metric.
    Jacobi,
    /// A parameter with `dt/dτ = 1 + ½ sin(2π τ/T)`.
    Parametric,
}

impl Time {
    /// All of them.
    pub(super) const ALL: [Time; 3] = [Time::Chaplygin, Time::Jacobi, Time::Parametric];

    /// The subject of the claim.
    pub(super) fn word(self) -> &'static str {
        match self {
            Time::Chaplygin => "chaplygin",
            Time::Jacobi => "jacobi",
            Time::Parametric => "parametric",
        }
    }

    /// Whether the equations in τ are others than those in t: N = 1 without two independent velocities of a constraint. Masses with
    /// a law of their own are not integrated in τ.
    fn differs(self, cx: &Context<'_>) -> bool {
        let r = cx.selection.rows.len();
        match self {
            Time::Chaplygin => r > 0 && cx.system.n() >= r + 2,
            Time::Jacobi => true,
            Time::Parametric => cx.system.masses.is_empty(),
        }
    }

    /// The claim that proves it.
    fn proved_by(self) -> &'static str {
        match self {
            Time::Chaplygin => "chaplygin.multiplier",
            Time::Jacobi => "action.jacobi",
            Time::Parametric => "action.parametric",
        }
    }

    /// Which equations are integrated.
    pub(super) fn whose(self) -> &'static str {
        match self {
            Time::Chaplygin => "Hamilton's equations in τ, dτ = N dt",
            Time::Jacobi => "Jacobi's equations in the arc length τ",
            Time::Parametric => "the parametric equations, dt/dτ = 1 + ½ sin(2π τ/T)",
        }
    }
}

/// `witness.other-time#TIME`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfOtherTime;

impl Claim for WitnessOfOtherTime {
    fn id(&self) -> &'static str {
        "witness.other-time"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "Equations integrated in another time give the computed motion"
    }

    fn explanation(&self) -> &'static str {
        "The equations that a principle gives in another time τ are integrated in τ, from a state of the computed motion, together with the time t(τ), and the positions that come out are compared with those of the motion at that time. \
         `chaplygin`: Hamilton's equations for H(q, p) = ½ p (N² G)⁻¹ p − U with dt = dτ/N, N Chaplygin's multiplier, in the independent coordinates. `jacobi`: Jacobi's equations of the path of energy h in its arc length, dt = dτ/√(2 (h + L₀)), \
         on the longest stretch without rest. `parametric`: the n + 1 equations as stated, with dt/dτ = 1 + ½ sin(2π τ/T), which any positive function may replace. The largest distance, over 1 + the largest coordinate, must fall with the fourth power of the step; `refuted` means that it stays. \
         Example: a free particle x = t in the time dτ = dt/2 has dx/dτ = 2 and t = 2 τ: at τ = 1 both give x = 2."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let time = Time::ALL.into_iter().find(|t| Some(t.word()) == subject);
        time.map(|t| t.proved_by().to_string())
            .into_iter()
            .collect()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if evidence(cx).is_none() || cx.terms.order != 1 || cx.system.n() > COORDINATES {
            return Vec::new();
        }
        let all = Time::ALL.into_iter().filter(|time| time.differs(cx));
        all.map(|t| Some(t.word().to_string())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let time = Time::ALL.into_iter().find(|t| Some(t.word()) == subject);
        let Some(time) = time else {
            return Verdict::undecided("there is no such time").into();
        };
        if !matches!(cx.finding(time.proved_by()).verdict, Verdict::Proved(_)) {
            let detail = "the equations in τ are not proved of this system";
            return Verdict::not_applicable(time.proved_by(), detail).into();
        }
        if is_fixed(cx) && time != Time::Parametric {
            return nothing_varies("motions from one position").into();
        }
        let found = match time {
            Time::Chaplygin => chaplygin(cx, 1.0),
            Time::Jacobi => jacobi(cx, 1.0),
            Time::Parametric => parametric(cx, 1.0),
        };
        match found {
            Ok(found) => {
                let sentence = "the largest distance of the positions from the motion, over 1 + the largest of each";
                let sentence = format!("{} integrated there: {sentence}, is", time.whose());
                let verdict = judged(&found, &sentence, "distance from the motion");
                show(cx, Figure::OtherTime, (time.word(), time.whose()), found);
                verdict.into()
            }
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

/// Near a zero N is below this part of its largest value, near rest L₂: there 1/N and 1/√L₂ are steep in τ.
const SMALL: f64 = 0.2;

/// Steps for each row: the rule is of a lower order than that of the rows.
const STEPS_OF_ROW: usize = 4;
/// More steps than so many times those expected are not taken.
const MOST: usize = 8;
/// A step is not taken where so many times its length would pass the end.
const LAST: f64 = 1.5;

/// The rates of a state by τ at a value of τ; the time is its last entry.
type Rate<'a> = dyn FnMut(f64, &[f64]) -> Option<Vec<f64>> + 'a;

/// A run in τ beside the rows of the motion.
struct Course {
    evidence: Arc<MotionEvidence>,
    span: Span,
    /// The coordinates that the state begins with.
    compared: Vec<usize>,
    /// The length in τ of a row on average.
    step: f64,
}

impl Course {
    /// The distances from the motion with each step.
    fn compared(&self, start: &[f64], rate: &mut Rate<'_>) -> Result<Refined, String> {
        let mut largest = Vec::new();
        for stride in STRIDES {
            largest.push((self.distance(start, rate, stride)?, 1.0));
        }
        let mut found = self.span.of_largest(&largest);
        found.variations = 1;
        let steps = found.steps.iter_mut();
        steps.for_each(|step| *step /= STEPS_OF_ROW as f64);
        Ok(found)
    }

    /// The largest distance with steps of so many rows.
    fn distance(&self, start: &[f64], rate: &mut Rate<'_>, stride: usize) -> Result<f64, String> {
        let failed = "the equations in τ have no value beside the motion";
        let h = self.step * stride as f64 / STEPS_OF_ROW as f64;
        let mut state = start.to_vec();
        let mut largest = 0.0_f64;
        for step in 0..MOST * self.span.count * STEPS_OF_ROW / stride {
            let slopes = rate(step as f64 * h, &state).ok_or(failed)?;
            if self.is_last(state.last(), slopes.last().map(|slope| slope * h)) {
                return Ok(largest);
            }
            state = stepped(rate, step as f64 * h, h, &state).ok_or(failed)?;
            let t = *state.last().ok_or(failed)?;
            largest = largest.max(self.apart(t, &state));
        }
        Err("the equations in τ do not reach the end of the motion".into())
    }

    /// Whether a step of so much time from a time on may pass the end of the rows.
    fn is_last(&self, t: Option<&f64>, step: Option<f64>) -> bool {
        let (Some(t), Some(step)) = (t, step) else {
            return true;
        };
        (t + LAST * step - self.span.interval.1) * self.span.length() > 0.0
    }

    /// The largest distance of the positions from those of the motion at a time.
    fn apart(&self, t: f64, state: &[f64]) -> f64 {
        let run = self.evidence.rows();
        let spacing = self.span.length() / self.span.count as f64;
        let place = (t - self.span.interval.0) / spacing;
        let last = self.span.first + self.span.count;
        let middle = self.span.first as f64 + place;
        let first = (middle as usize)
            .saturating_sub(NODES / 2)
            .min(last + 1 - NODES);
        let at = middle - first as f64;
        let one = |(&i, x): (&usize, &f64)| {
            let value = interpolated(at, |j| run.row(first + j)[i]);
            let size = run.row(self.span.first)[i].abs().max(value.abs());
            let natural = run.scales.get(i).copied().unwrap_or(1.0);
            (x - value).abs() / (natural + size)
        };
        self.compared.iter().zip(state).map(one).fold(0.0, f64::max)
    }
}

/// Rows between which positions are interpolated.
const NODES: usize = 9;

/// The polynomial through the values at 0, 1, …, 8.
fn interpolated(x: f64, value: impl Fn(usize) -> f64) -> f64 {
    let product = |j: usize| -> f64 {
        let others = (0..NODES).filter(|&m| m != j);
        others
            .map(|m| (x - m as f64) / (j as f64 - m as f64))
            .product()
    };
    (0..NODES).map(|j| product(j) * value(j)).sum()
}

fn stepped(rate: &mut Rate<'_>, at: f64, h: f64, y: &[f64]) -> Option<Vec<f64>> {
    let moved =
        |k: &[f64], by: f64| -> Vec<f64> { y.iter().zip(k).map(|(x, k)| x + by * k).collect() };
    let k1 = rate(at, y)?;
    let k2 = rate(at + h / 2.0, &moved(&k1, h / 2.0))?;
    let k3 = rate(at + h / 2.0, &moved(&k2, h / 2.0))?;
    let k4 = rate(at + h, &moved(&k3, h))?;
    let next = (0..y.len()).map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    let next: Vec<f64> = next.collect();
    next.iter().all(|x| x.is_finite()).then_some(next)
}

/// The course from the first row of a span, on which τ runs with the rates given against the time.
fn course(
    cx: &Context<'_>,
    span: Span,
    compared: Vec<usize>,
    rates: &[f64],
) -> Result<Course, String> {
    let mean = rates.iter().sum::<f64>() / rates.len().max(1) as f64;
    Ok(Course {
        evidence: rows(cx)?.0,
        step: mean * span.length() / span.count as f64,
        span,
        compared,
    })
}

/// The rows where a positive factor is not small.
fn where_large(samples: &Samples, group: usize, what: &str) -> Result<Span, String> {
    let count = samples.times.len();
    let value = |row: usize| samples.at(group, row)[0];
    let largest = (0..count).fold(0.0_f64, |m, row| m.max(value(row).abs()));
    let rows = longest(count, |row| {
        value(row).abs() > SMALL * largest && (row == 0 || value(row) * value(row - 1) > 0.0)
    });
    Span::new(&samples.times, &rows, (Rule::Vanishing, what))
}

/// Hamilton's equations in τ with Chaplygin's multiplier; `wrong` multiplies dt/dτ, and is 1 but in tests.
pub(super) fn chaplygin(cx: &Context<'_>, wrong: f64) -> Result<Refined, String> {
    let reducer =
        reducer(cx).ok_or("the multiplier N was not written, as its quadrature was not found")?;
    let functions = Reduced::functions(cx, &reducer);
    let samples = Samples::new(cx, &[&functions, &[reducer.multiplier]])?;
    let span = where_large(&samples, 1, "the multiplier N is not small")?;
    let (evidence, _) = rows(cx)?;
    let row = evidence.rows().row(span.first).to_vec();
    let sign = samples.at(1, span.first)[0].signum();
    let rates: Vec<f64> = span
        .rows()
        .map(|(row, _)| samples.at(1, row)[0] * sign)
        .collect();
    let observer = Observer::new(cx.system, cx.terms, &evidence.binding, &functions)
        .map_err(|problem| problem.to_string())?;
    let layout = evidence.rows().layout;
    let mut reduced = Reduced {
        observer,
        speeds: reducer
            .independent
            .iter()
            .map(|&i| layout.v().start + i)
            .collect(),
        positions: reducer.independent.clone(),
        row,
        sign,
    };
    let course = course(cx, span, reducer.independent.clone(), &rates)?;
    let start = reduced.start(span.interval.0);
    course.compared(&start, &mut |_, state: &[f64]| reduced.rate(state, wrong))
}

/// The reduced system: (q, p, t) with p the momenta in τ.
struct Reduced {
    observer: Observer,
    positions: Vec<usize>,
    speeds: Vec<usize>,
    row: Vec<f64>,
    /// That of N as it is written.
    sign: f64,
}

/// Values of the functions of a reduced system at a state.
struct Values {
    multiplier: f64,
    by_position: Vec<f64>,
    momenta: Vec<f64>,
    slopes: Vec<f64>,
    metric: Vec<f64>,
}

impl Reduced {
    /// N, ∂N/∂q, P, ∂L*/∂q, G.
    fn functions(cx: &Context<'_>, reducer: &Reducer) -> Vec<Expr> {
        let g = &cx.system.graph;
        let momenta = g.gradient(reducer.lagrangian, &reducer.speeds);
        let mut all = vec![reducer.multiplier];
        all.extend(g.gradient(reducer.multiplier, &reducer.coordinates));
        all.extend(momenta.iter().copied());
        all.extend(g.gradient(reducer.lagrangian, &reducer.coordinates));
        all.extend(g.jacobian(&momenta, &reducer.speeds).concat());
        all
    }

    fn at(&mut self, t: f64, positions: &[f64], speeds: &[f64]) -> Values {
        for (&i, x) in self.positions.iter().zip(positions) {
            self.row[i] = *x;
        }
        for (&i, x) in self.speeds.iter().zip(speeds) {
            self.row[i] = *x;
        }
        let k = self.positions.len();
        let all = self.observer.at(t, &self.row);
        let part = |from: usize| all[1 + from * k..1 + (from + 1) * k].to_vec();
        Values {
            multiplier: self.sign * all[0],
            by_position: part(0).into_iter().map(|x| self.sign * x).collect(),
            momenta: part(1),
            slopes: part(2),
            metric: all[1 + 3 * k..].to_vec(),
        }
    }

    /// `p = N G v` at the row that it begins with.
    fn start(&mut self, t: f64) -> Vec<f64> {
        let of = |places: &[usize], row: &[f64]| -> Vec<f64> {
            places.iter().map(|&i| row[i]).collect()
        };
        let (positions, speeds) = (of(&self.positions, &self.row), of(&self.speeds, &self.row));
        let values = self.at(t, &positions, &speeds);
        let momenta = values.momenta.iter().map(|p| values.multiplier * p);
        let mut state = positions.clone();
        state.extend(momenta);
        state.push(t);
        state
    }

    /// `q' = u = (N² G)⁻¹ p`, `p' = ∂L*/∂q + ∂N/∂q Σ u P` at v = N u, `t' = 1/N`.
    fn rate(&mut self, state: &[f64], wrong: f64) -> Option<Vec<f64>> {
        let k = self.positions.len();
        let (positions, momenta, t) = (&state[..k], &state[k..2 * k], state[2 * k]);
        let rest = self.at(t, positions, &vec![0.0; k]);
        let n = rest.multiplier;
        if !n.is_finite() || n <= 0.0 {
            return None;
        }
        let scaled: Vec<f64> = momenta.iter().map(|p| p / (n * n)).collect();
        let u = solved(k, &rest.metric, &scaled)?;
        let speeds: Vec<f64> = u.iter().map(|u| n * u).collect();
        let values = self.at(t, positions, &speeds);
        let work: f64 = u.iter().zip(&values.momenta).map(|(u, p)| u * p).sum();
        let forces = values.slopes.iter().zip(&values.by_position);
        let forces: Vec<f64> = forces.map(|(l, n)| l + n * work).collect();
        let mut rates = u;
        rates.extend(forces);
        rates.push(wrong / n);
        Some(rates)
    }
}

/// Functions of the variables of a formulation and of (q, t), compiled.
struct InVariables {
    observer: Observer,
    /// A row without variables of its own.
    row: Vec<f64>,
    n: usize,
}

impl InVariables {
    fn new(
        cx: &Context<'_>,
        equations: &Equations,
        functions: &[Expr],
    ) -> Result<InVariables, String> {
        let (evidence, _) = rows(cx)?;
        let own: Vec<String> = equations.variables.iter().map(|v| v.name.clone()).collect();
        let observer = Observer::with_own(cx.system, cx.terms, &evidence.binding, &own, functions)
            .map_err(|problem| problem.to_string())?;
        let layout = evidence.rows().layout;
        Ok(InVariables {
            observer,
            row: vec![0.0; layout.lambda().end],
            n: cx.system.n(),
        })
    }

    /// Values at (q, variables, t).
    fn at(&mut self, t: f64, positions: &[f64], variables: &[f64]) -> Vec<f64> {
        self.row[..self.n].copy_from_slice(positions);
        let row = [self.row.as_slice(), variables].concat();
        self.observer.at(t, &row)
    }
}

/// The values of the variables of a formulation at each row, by their definitions.
fn definitions(equations: &Equations) -> Result<Vec<Expr>, String> {
    let variables = equations.variables.iter();
    variables
        .map(|v| v.definition)
        .collect::<Option<Vec<Expr>>>()
        .ok_or_else(|| "a variable of the equations in τ is not defined".into())
}

/// Jacobi's equations in the arc length; `wrong` multiplies dt/dτ, and is 1 but in tests.
pub(super) fn jacobi(cx: &Context<'_>, wrong: f64) -> Result<Refined, String> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let equations = derive(cx, "jacobi").map_err(|problem| problem.to_string())?;
    let rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
    let at_rest = g.substitute(system.lagrangian, &rest);
    let energy = equations.variables.last().map_or(g.zero(), |h| h.value);
    let twice = |e: Expr| g.mul(&[g.integer(2), e]);
    let speed = g.sqrt(twice(g.add(&[energy, at_rest])));
    // Where it is, L₂ is h + L₀.
    let kinetic = g.add(&[system.energy(), at_rest]);
    let positions: Vec<Expr> = system.coordinates.iter().map(|c| c.q).collect();
    let start = definitions(&equations)?;
    let samples = Samples::new(cx, &[&[kinetic], &positions, &start])?;
    let span = where_large(&samples, 0, "the motion is not at rest")?;
    let rates: Vec<f64> = span
        .rows()
        .map(|(row, _)| (2.0 * samples.at(0, row)[0]).sqrt())
        .collect();
    let mut functions = vec![speed];
    functions.extend(equations.variables.iter().map(|v| v.rate));
    let mut compiled = InVariables::new(cx, &equations, &functions)?;
    let course = course(cx, span, (0..n).collect(), &rates)?;
    let start = [
        samples.at(1, span.first),
        samples.at(2, span.first),
        &[span.interval.0],
    ]
    .concat();
    course.compared(&start, &mut |_, state: &[f64]| {
        let (positions, rest) = state.split_at(n);
        let (variables, t) = rest.split_at(n + 1);
        let values = compiled.at(t[0], positions, variables);
        // What the formulation states by t is by τ over dτ/dt.
        let moved = values[1..].iter().map(|rate| rate / values[0]);
        let mut rates = variables[..n].to_vec();
        rates.extend(moved);
        rates.push(wrong / values[0]);
        Some(rates)
    })
}

/// The n + 1 equations with dt/dτ = 1 + ½ sin(2π τ/T); `wrong` multiplies d²t/dτ² in the equations of the coordinates, and is 1 but
/// in tests.
pub(super) fn parametric(cx: &Context<'_>, wrong: f64) -> Result<Refined, String> {
    let (system, n) = (cx.system, cx.system.n());
    let equations = derive(cx, "parametric").map_err(|problem| problem.to_string())?;
    let linear = Linear::new(cx, &equations)?;
    let positions: Vec<Expr> = system.coordinates.iter().map(|c| c.q).collect();
    let start = definitions(&equations)?;
    let samples = Samples::new(cx, &[&positions, &start])?;
    let all = 0..samples.times.len();
    let span = Span::new(&samples.times, &all, (Rule::Vanishing, "there are rows"))?;
    let mut compiled = InVariables::new(cx, &equations, &linear.functions)?;
    let course = course(cx, span, (0..n).collect(), &[1.0])?;
    let start = [samples.at(0, 0), samples.at(1, 0), &[span.interval.0]].concat();
    let wave = TAU / span.length();
    course.compared(&start, &mut |tau, state: &[f64]| {
        let (positions, rest) = state.split_at(n);
        let (variables, t) = rest.split_at(n + 1);
        let values = compiled.at(t[0], positions, variables);
        let second = 0.5 * wave * (wave * tau).cos();
        let seconds = linear.solved(&values, wrong * second)?;
        let mut rates = variables[..n].to_vec();
        rates.extend(seconds);
        rates.push(second);
        rates.push(variables[n]);
        Some(rates)
    })
}

/// The stated equations of the coordinates and the derivatives of the constraints by τ, linear in x'' and μ.
struct Linear {
    /// Coefficients of (q'', t'', μ), row after row, and then what is left without them.
    functions: Vec<Expr>,
    n: usize,
    r: usize,
}

impl Linear {
    fn new(cx: &Context<'_>, equations: &Equations) -> Result<Linear, String> {
        let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
        let group = |title: &str| -> Vec<Expr> {
            let own = |group: &&EquationGroup| group.title == title;
            let all = equations.groups.iter().find(own);
            let all = all.into_iter().flat_map(|group| &group.equations);
            all.map(|e| g.sub(e.left, e.right)).collect()
        };
        let mut stated: Vec<Expr> = group("equations of motion").into_iter().take(n).collect();
        if stated.len() < n {
            return Err("the parametric equations are not stated".into());
        }
        let rates: Vec<Expr> = equations.variables.iter().map(|v| v.value).collect();
        let seconds: Vec<Symbol> = equations
            .variables
            .iter()
            .map(|v| g.intern_symbol(&v.name, 1))
            .collect();
        let further: Vec<(Symbol, Expr)> = equations
            .variables
            .iter()
            .zip(&seconds)
            .map(|(v, &second)| (v.symbol, g.symbol_expr(second)))
            .collect();
        let constraints = group("constraints");
        stated.extend(derive_along(
            system,
            &constraints,
            &rates[..n],
            rates[n],
            &further,
        ));
        let basis = basis(cx);
        let multipliers: Vec<Symbol> = basis
            .constraint_names()
            .into_iter()
            .map(|name| g.intern_symbol(&unused_name(system, &format!("mu_{name}")), 0))
            .collect();
        let r = multipliers.len();
        let unknowns: Vec<Symbol> = seconds.into_iter().chain(multipliers).collect();
        let at_zero: Vec<(Expr, Expr)> = unknowns
            .iter()
            .map(|&s| (g.symbol_expr(s), g.zero()))
            .collect();
        let mut functions = g.jacobian(&stated, &unknowns).concat();
        functions.extend(g.substitute_all(&stated, &at_zero));
        Ok(Linear { functions, n, r })
    }

    /// q'' for a given t''.
    fn solved(&self, values: &[f64], second: f64) -> Option<Vec<f64>> {
        let (n, size, width) = (self.n, self.n + self.r, self.n + self.r + 1);
        let (coefficients, left) = values.split_at(size * width);
        let mut matrix = Vec::with_capacity(size * size);
        let mut right = Vec::with_capacity(size);
        for (row, left) in coefficients.chunks(width).zip(left) {
            matrix.extend(row[..n].iter().chain(&row[n + 1..]));
            right.push(-left - row[n] * second);
        }
        let mut all = solved(size, &matrix, &right)?;
        all.truncate(n);
        Some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of degree eight are met between the values.
    #[test]
    fn polynomials_are_interpolated() {
        for degree in 0..=8 {
            let value = |x: f64| (x / 4.0 - 0.9).powi(degree);
            for x in [0.0, 0.3, 3.7, 7.99] {
                let found = interpolated(x, |j| value(j as f64));
                assert!((found - value(x)).abs() < 1e-12, "{degree} {x}");
            }
        }
    }

    /// y' = y by one step of Runge and Kutta is its series up to the fourth power.
    #[test]
    fn a_step_is_of_the_fourth_order() {
        let h = 0.1;
        let next = stepped(&mut |_, y: &[f64]| Some(y.to_vec()), 0.0, h, &[1.0]).expect("a step");
        let series = 1.0 + h + h * h / 2.0 + h.powi(3) / 6.0 + h.powi(4) / 24.0;
        assert!((next[0] - series).abs() < 1e-15);
    }
}
