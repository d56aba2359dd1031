//! The first variation of each form of Hamilton's principle along the computed motion, for random virtual displacements that
//! vanish at the ends.
//!
//! Virtual displacements are projections of free ones, `δq = η − fᵥᵀ (fᵥ fᵥᵀ)⁻¹ fᵥ η`, for the forms of Hölder and of
//! Helmholtz and Poincaré; those of Voronets and Suslov are taken by their own rules in the independent velocities, on the longest
//! stretch on which these are independent, in others where that is too short. The trapezoidal rule shows its order in halved steps, as the variations vanish at the
//! ends with their derivatives.

use super::algebra::{determinant, gram, solved, times, transposed_times};
use super::evidence;
use super::refined::{longest, worst, Refined, Rule, Span, Term};
use super::samples::Samples;
use super::wave::Wave;
use chetaev_mechanics::characteristics::Selection;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::formulations::legendre::Legendre;
use chetaev_mechanics::Context;
use chetaev_motion::follow::magnitude;
use chetaev_principles::hamilton::{suslov, voronets};
use chetaev_principles::variations::Displacements;
use chetaev_symbolic::Expr;
use std::ops::Range;

/// A form of Hamilton's principle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `∫(δL + Σ Q δq) dt`, δv = D(δq).
    Hoelder,
    /// `∫(δL* + Σ θ (δv − δφ) + Σ Q δq) dt`.
    Voronets,
    /// `∫(δL + Σ θ A δq + Σ Q δq) dt`, δf = 0.
    Suslov,
    /// `∫(δ(Σ p q' − H) + Σ Q δq) dt`, δp free.
    HelmholtzPoincare,
}

impl Form {
    /// All forms.
    pub const ALL: [Form; 4] = [
        Form::Hoelder,
        Form::Voronets,
        Form::Suslov,
        Form::HelmholtzPoincare,
    ];

    /// Those that differ for this system: without constraints those of Voronets and Suslov are Hölder's.
    pub fn of(cx: &Context<'_>) -> Vec<Form> {
        let has_constraints = !cx.selection.rows.is_empty();
        let in_chart = [Form::Voronets, Form::Suslov];
        let all = Form::ALL.into_iter();
        all.filter(|form| has_constraints || !in_chart.contains(form))
            .collect()
    }

    /// The subject of its claim.
    pub fn word(self) -> &'static str {
        match self {
            Form::Hoelder => "hoelder",
            Form::Voronets => "voronets",
            Form::Suslov => "suslov",
            Form::HelmholtzPoincare => "helmholtz-poincare",
        }
    }

    /// "Hölder's form".
    pub fn whose(self) -> &'static str {
        match self {
            Form::Hoelder => "Hölder's form",
            Form::Voronets => "Voronets' form",
            Form::Suslov => "Suslov's form",
            Form::HelmholtzPoincare => "the form of Helmholtz and Poincaré",
        }
    }
}

/// The first variation of a form for the random variation at which it is largest.
#[derive(Clone, Debug)]
pub struct FirstVariation {
    /// The form.
    pub form: Form,
    /// Its integral.
    pub refined: Refined,
}

/// Where a minor of the constraints is less than this part of its largest possible value the velocities count as dependent.
pub(super) const INDEPENDENT: f64 = 0.25;

/// Of systems with more coordinates no other independent velocities are tried.
const MOST_COORDINATES: usize = 10;
/// At most so many others.
const CHARTS: usize = 3;

/// All forms, computed once.
pub(super) struct Found(Vec<(Form, Result<FirstVariation, String>)>);

/// The first variation of a form, or why it was not computed.
pub(super) fn of(cx: &Context<'_>, form: Form) -> Result<FirstVariation, String> {
    let found = cx.shared(|cx| {
        let forms = Form::of(cx).into_iter();
        Found(forms.map(|form| (form, compute(cx, form))).collect())
    });
    let own = found.0.iter().find(|(own, _)| *own == form);
    own.map_or_else(|| Err("no such form".into()), |(_, found)| found.clone())
}

/// Those that claims have computed.
pub(super) fn known(cx: &Context<'_>) -> Vec<FirstVariation> {
    let found = cx.known::<Found>();
    let all = found.iter().flat_map(|found| &found.0);
    all.filter_map(|(_, found)| found.clone().ok()).collect()
}

fn compute(cx: &Context<'_>, form: Form) -> Result<FirstVariation, String> {
    match form {
        Form::Hoelder => projected(cx, form, None),
        Form::HelmholtzPoincare => {
            let legendre = Legendre::new(cx.system).map_err(|problem| problem.to_string())?;
            projected(cx, form, Some(&legendre))
        }
        Form::Voronets | Form::Suslov => in_chart(cx, form),
    }
}

/// Quadratures over rows for several variations that vanish at the ends; the one with the largest result.
fn quadratures(
    form: Form,
    samples: &Samples,
    rows: &Range<usize>,
    width: usize,
    integrand: impl Fn(usize, &[(f64, f64)]) -> Option<Term>,
) -> Result<FirstVariation, String> {
    let rule = Rule::Vanishing;
    let what = "the velocities taken as independent are so";
    let span = Span::new(&samples.times, rows, (rule, what))?;
    let refined = worst(|generator| {
        let waves: Vec<Wave> = (0..width).map(|_| Wave::vanishing(generator)).collect();
        let at = |(row, share): (usize, f64)| {
            let eta: Vec<(f64, f64)> = waves.iter().map(|w| w.at(share, span.length())).collect();
            integrand(row, &eta)
        };
        let terms: Option<Vec<Term>> = span.rows().map(at).collect();
        let terms = terms.ok_or("the gradients of the constraints are dependent at a row")?;
        span.integral(rule, |_| Some(terms.clone()), (0.0, 0.0))
    })?;
    Ok(FirstVariation { form, refined })
}

/// `Σ (L_q + Q) δq + p D(δq)` with projected δq; with H, `Σ (Q − H_q) δq + p D(δq) + δp (v − ∂H/∂p)`.
fn projected(
    cx: &Context<'_>,
    form: Form,
    legendre: Option<&Legendre>,
) -> Result<FirstVariation, String> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let basis = basis(cx);
    let r = cx.selection.rows.len();
    let jacobian = basis.jacobian().concat();
    let moved: Vec<Expr> = jacobian
        .iter()
        .map(|&e| system.total_derivative(e))
        .collect();
    let mut slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let mut lag = Vec::new();
    if let Some(legendre) = legendre {
        let definitions: Vec<(Expr, Expr)> = legendre
            .momenta
            .iter()
            .map(|p| (p.value, p.definition))
            .collect();
        let at_momenta = |es: &[Expr]| g.substitute_all(es, &definitions);
        let velocities = system.coordinates.iter().map(|c| c.v);
        let by_momenta = at_momenta(&legendre.by_momenta).into_iter();
        lag = velocities.chain(by_momenta.map(|v| g.neg(v))).collect();
        let by_coordinates = at_momenta(&legendre.by_coordinates);
        slopes = by_coordinates.into_iter().map(|e| g.neg(e)).collect();
    }
    let forces = slopes.iter().zip(&system.forces);
    let forces: Vec<Expr> = forces.map(|(&a, &b)| g.add(&[a, b])).collect();
    let samples = Samples::new(cx, &[&forces, &momenta, &jacobian, &moved, &lag])?;
    let rows = 0..samples.times.len();
    let sizes = sizes_of_momenta(&samples, n);
    let width = n + lag.len() / 2;
    quadratures(form, &samples, &rows, width, |row, waves| {
        let (eta, free) = waves.split_at(n);
        let eta: (Vec<f64>, Vec<f64>) = eta.iter().copied().unzip();
        let of = |group: usize| samples.at(group, row);
        let (value, rate) = projection(r, n, of(2), of(3), &eta.0, &eta.1)?;
        let parts = of(0).iter().zip(&value).chain(of(1).iter().zip(&rate));
        let parts = parts.map(|(a, b)| a * b);
        // δp is measured by what δp v has in common with p D(δq).
        let moved = free.iter().zip(&sizes).map(|(wave, size)| wave.0 * size);
        let moved: Vec<f64> = moved.collect();
        let lag = of(4).iter().zip(moved.iter().cycle()).map(|(a, b)| a * b);
        let all: Vec<f64> = parts.chain(lag).collect();
        Some((all.iter().sum(), all.iter().map(|x| x.abs()).sum()))
    })
}

/// The largest momenta over the lengths of the ways that their coordinates go: units of δp for δq of the unit that has the coordinate.
fn sizes_of_momenta(samples: &Samples, n: usize) -> Vec<f64> {
    let rows = samples.times.len();
    let length = (samples.times[rows - 1] - samples.times[0]).abs();
    let largest = |group: usize, i: usize| {
        let values = (0..rows).filter_map(|row| samples.at(group, row).get(i));
        values.fold(0.0, |m: f64, x| m.max(x.abs()))
    };
    let size = |i: usize| match (largest(1, i), largest(4, i) * length) {
        (p, way) if p > 0.0 && way > 0.0 => p / way,
        _ => 1.0,
    };
    (0..n).map(size).collect()
}

/// `δq = η − fᵥᵀ G⁻¹ fᵥ η`, `G = fᵥ fᵥᵀ`, and D(δq), from fᵥ and its rate.
pub(super) fn projection(
    r: usize,
    n: usize,
    jacobian: &[f64],
    moved: &[f64],
    eta: &[f64],
    rate: &[f64],
) -> Option<(Vec<f64>, Vec<f64>)> {
    if r == 0 {
        return Some((eta.to_vec(), rate.to_vec()));
    }
    let matrix = gram(jacobian, r, n);
    let multipliers = solved(r, &matrix, &times(jacobian, n, eta))?;
    // G' z + G z' = fᵥ' η + fᵥ η'.
    let back = transposed_times(jacobian, n, &multipliers);
    let moved_back = transposed_times(moved, n, &multipliers);
    let right: Vec<f64> = times(moved, n, eta)
        .into_iter()
        .zip(times(jacobian, n, rate))
        .zip(times(moved, n, &back))
        .zip(times(jacobian, n, &moved_back))
        .map(|(((a, b), c), d)| a + b - c - d)
        .collect();
    let rates = solved(r, &matrix, &right)?;
    let forth = transposed_times(jacobian, n, &rates);
    let value = eta.iter().zip(&back).map(|(a, b)| sum_of(&[*a, -b]));
    let parts = rate.iter().zip(&moved_back).zip(&forth);
    let moved = parts.map(|((a, b), c)| sum_of(&[*a, -b, -c]));
    Some((value.collect(), moved.collect()))
}

/// A sum whose terms cancel but for their rounding is zero: a quotient of rounding by rounding would be no evidence.
fn sum_of(terms: &[f64]) -> f64 {
    let size: f64 = terms.iter().map(|x| x.abs()).sum();
    let sum: f64 = terms.iter().sum();
    if sum.abs() <= CANCELLED * size {
        0.0
    } else {
        sum
    }
}

/// What rounding leaves of terms that cancel, which come from small linear systems.
const CANCELLED: f64 = 1e3 * f64::EPSILON;

/// The forms in independent velocities, each by its own rule: in those of the system, or in others where these are dependent along too
/// much of the motion.
fn in_chart(cx: &Context<'_>, form: Form) -> Result<FirstVariation, String> {
    let own = along_chart(cx, form);
    if own.is_ok() {
        return own;
    }
    let others = other_selections(cx).into_iter();
    let mut found = others.filter_map(|selection| {
        let evidence = evidence(cx)?;
        let prover = cx.prover.clone();
        let other = Context::new(cx.system, cx.terms, &selection, cx.registry(), prover);
        along_chart(&other.with(evidence), form).ok()
    });
    found.next().map_or(own, Ok)
}

/// Other dependent velocities for the same constraints, those first that are best determined at the middle of the motion.
fn other_selections(cx: &Context<'_>) -> Vec<Selection> {
    let (n, r) = (cx.system.n(), cx.selection.rows.len());
    let jacobian = basis(cx).jacobian().concat();
    if n > MOST_COORDINATES {
        return Vec::new();
    }
    let Ok(samples) = Samples::new(cx, &[&jacobian]) else {
        return Vec::new();
    };
    let middle = samples.at(0, samples.times.len() / 2);
    let sets = (0..1_usize << n).filter(|set| set.count_ones() as usize == r);
    let columns = sets.map(|set| (0..n).filter(|i| set >> i & 1 == 1).collect());
    let size = |dependent: &Vec<usize>| {
        let rows = middle.chunks(n);
        let minor: Vec<f64> = rows
            .flat_map(|row| dependent.iter().map(|&i| row[i]))
            .collect();
        determinant(r, &minor).abs()
    };
    let mut all: Vec<Vec<usize>> = columns.collect();
    all.retain(|dependent| *dependent != cx.selection.dependent && size(dependent) > 0.0);
    all.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let rows = &cx.selection.rows;
    let selection = |dependent| Selection {
        rows: rows.clone(),
        dependent,
    };
    all.into_iter().take(CHARTS).map(selection).collect()
}

/// A form in the independent velocities of the context, on the longest stretch on which these are independent.
fn along_chart(cx: &Context<'_>, form: Form) -> Result<FirstVariation, String> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let r = cx.selection.rows.len();
    let d = Displacements::new(cx).map_err(|problem| problem.to_string())?;
    let integrand = match form {
        Form::Suslov => suslov::integrand(&d),
        _ => voronets::integrand(&d),
    };
    let forces = d.chart.restrict(system, &system.forces);
    let work = d.chart.contract(system, &forces);
    let value: Vec<Expr> = integrand
        .value
        .iter()
        .zip(&work)
        .map(|(&a, &b)| g.add(&[a, b]))
        .collect();
    let jacobian = basis(cx).jacobian();
    let minor: Vec<Expr> = jacobian
        .iter()
        .flat_map(|row| d.chart.dependent.iter().map(|&i| row[i]))
        .collect();
    let jacobian = jacobian.concat();
    // Coefficients may vanish on a motion by cancellation: their sizes are those of their terms.
    let coefficients = value.iter().chain(&integrand.rate);
    let sizes: Vec<Expr> = coefficients.map(|&e| magnitude(g, e)).collect();
    let groups: [&[Expr]; 5] = [&value, &integrand.rate, &minor, &jacobian, &sizes];
    let samples = Samples::new(cx, &groups)?;
    let independent = |row: usize| {
        let whole = determinant(r, &gram(samples.at(3, row), r, n)).sqrt();
        determinant(r, samples.at(2, row)).abs() >= INDEPENDENT * whole
    };
    let rows = longest(samples.times.len(), independent);
    quadratures(form, &samples, &rows, d.chart.k(), |row, waves| {
        let of = |group: usize| samples.at(group, row);
        let waves = || waves.iter().map(|w| w.0).chain(waves.iter().map(|w| w.1));
        let all = of(0).iter().chain(of(1)).zip(waves());
        let sizes = of(4).iter().zip(waves());
        Some((
            all.map(|(a, w)| a * w).sum(),
            sizes.map(|(a, w)| (a * w).abs()).sum(),
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// z' = y x' at y(t) = sin t: the projection is virtual, and its rate is the difference quotient.
    #[test]
    fn projections_are_virtual() {
        let row = |t: f64| [-t.sin(), 0.0, 1.0];
        let rate = |t: f64| [-t.cos(), 0.0, 0.0];
        let eta = |t: f64| [t.cos(), t * t, 1.0 + t];
        let slope = |t: f64| [-t.sin(), 2.0 * t, 1.0];
        let at = |t: f64| projection(1, 3, &row(t), &rate(t), &eta(t), &slope(t));
        let (h, t) = (1e-5, 0.7);
        let (Some(low), Some(here), Some(high)) = (at(t - h), at(t), at(t + h)) else {
            unreachable!()
        };
        let virtual_part: f64 = row(t).iter().zip(&here.0).map(|(a, b)| a * b).sum();
        assert!(virtual_part.abs() < 1e-14);
        for i in 0..3 {
            let quotient = (high.0[i] - low.0[i]) / (2.0 * h);
            assert!((quotient - here.1[i]).abs() < 1e-8);
        }
    }
}
