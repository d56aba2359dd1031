//! κ along the computed motion: by the conditions that determine it, or from the κ(0) that the model states.

use super::algebra::null_space;
use super::evidence;
use super::samples::{rows, Samples};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::formulations::kappa_symbols;
use chetaev_mechanics::words;
use chetaev_mechanics::Context;
use chetaev_principles::stationarity::{Closure, Transport};
use chetaev_symbolic::{Expr, Verdict};

/// With a larger residual of (12), over the sizes of its terms, the motion is no extremal for these κ.
const EXTREMAL: f64 = 1e-6;

/// κ at the rows.
#[derive(Clone, Debug)]
pub(super) struct Kappa {
    rows: Vec<Vec<f64>>,
    /// κ(0) by name, where it was stated.
    pub(super) given: Vec<(String, f64)>,
}

impl Kappa {
    /// κ of the selected constraints at a row.
    pub(super) fn at(&self, row: usize) -> &[f64] {
        &self.rows[row]
    }
}

/// κ of every motion, or of those on the set that the computed one lies on; where these are not unique, those of the κ(0) that the
/// model states.
///
/// # Errors
/// That κ is not known, or not unique.
pub(super) fn multipliers(cx: &Context<'_>) -> Result<Kappa, String> {
    let free = match determined(cx) {
        Ok(functions) => {
            let samples = Samples::new(cx, &[&functions])?;
            let count = samples.times.len();
            return Ok(Kappa {
                rows: (0..count).map(|row| samples.at(0, row).to_vec()).collect(),
                given: Vec::new(),
            });
        }
        Err(Unknown::Other(why)) => return Err(why),
        Err(Unknown::Free(why)) => why,
    };
    match stated(cx) {
        Ok(given) => from_start(cx, given),
        Err(missing) => Err(format!("{free}{missing}")),
    }
}

/// Why κ is no function of the state.
pub(super) enum Unknown {
    /// It is not unique.
    Free(String),
    /// It is not known.
    Other(String),
}

/// κ as functions of the state.
fn determined(cx: &Context<'_>) -> Result<Vec<Expr>, Unknown> {
    if cx.selection.rows.is_empty() {
        return Ok(Vec::new());
    }
    if matches!(
        cx.finding("hamilton.stationary").verdict,
        Verdict::Conditional { .. }
    ) {
        return super::subset::multipliers(cx);
    }
    let closure = Closure::of(cx);
    let Ok(closure) = closure.as_ref() else {
        return Err(Unknown::Other("κ is not known".into()));
    };
    let kappa: Option<Vec<Expr>> = closure.kappa.iter().copied().collect();
    let why = "κ is not unique; an index belongs to a κ, not to the curve";
    let kappa = kappa.ok_or_else(|| Unknown::Free(why.into()))?;
    match loses_rank(cx) {
        true => Err(Unknown::Free(
            "the conditions on κ lose their rank along this motion, and do not determine κ".into(),
        )),
        false => Ok(kappa),
    }
}

/// Coefficients below this part of the largest count as zero.
const DEPENDENT: f64 = 1e-8;

/// Whether the conditions on κ have a lower rank all along the computed motion than along almost every motion: what is proved of almost
/// every motion is then not said of this one.
pub(super) fn loses_rank(cx: &Context<'_>) -> bool {
    let closure = Closure::of(cx);
    let Ok(closure) = closure.as_ref() else {
        return false;
    };
    let (count, r) = (closure.conditions.len(), cx.selection.rows.len());
    let rows = closure.conditions.iter();
    let rows: Vec<Expr> = rows.flat_map(|c| c.coefficients.clone()).collect();
    let Ok(samples) = Samples::new(cx, &[&rows]) else {
        return false;
    };
    let is_less = |row: usize| {
        let free = null_space(samples.at(0, row), count, r, DEPENDENT).len();
        free + count > r
    };
    count > 0 && (0..samples.times.len()).all(is_less)
}

/// κ(0) of all selected constraints as the model states it, or what is missing, as the end of a sentence.
fn stated(cx: &Context<'_>) -> Result<Vec<(String, f64)>, String> {
    let g = &cx.system.graph;
    let names = kappa_symbols(&basis(cx));
    let names: Vec<String> = names.into_iter().map(|e| g.text(e)).collect();
    let evidence = evidence(cx).ok_or("")?;
    let value = |name: &String| {
        let own = evidence.given.iter().find(|(known, _)| known == name);
        own.cloned()
    };
    let found: Option<Vec<(String, f64)>> = names.iter().map(value).collect();
    found.ok_or_else(|| match names.is_empty() {
        true => String::new(),
        false => format!(
            ": for that of one κ state {} under [initial]",
            names.join(" and ")
        ),
    })
}

/// `κ' = Φ κ − λ` from κ(0) along the motion.
///
/// # Errors
/// That the motion is no extremal with these κ.
fn from_start(cx: &Context<'_>, given: Vec<(String, f64)>) -> Result<Kappa, String> {
    let transport = Transport::new(cx).map_err(|problem| problem.to_string())?;
    let (conditions, r) = (transport.conditions.concat(), given.len());
    let matrix = transport.matrix.concat();
    let samples = Samples::new(cx, &[&conditions, &matrix, &transport.multipliers])?;
    let rate = |row: usize, kappa: &[f64]| -> Vec<f64> {
        let moved = super::algebra::times(samples.at(1, row), r, kappa);
        moved
            .iter()
            .zip(samples.at(2, row))
            .map(|(a, b)| a - b)
            .collect()
    };
    let start: Vec<f64> = given.iter().map(|(_, value)| *value).collect();
    let count = rows(cx)?.1;
    let found = integrated(&samples.times, count, &start, &rate);
    for (row, kappa) in found.iter().enumerate() {
        for condition in samples.at(0, row).chunks(r) {
            let terms = condition.iter().zip(kappa).map(|(a, b)| a * b);
            let (sum, size) = terms.fold((0.0, 1.0), |all, x: f64| (all.0 + x, all.1 + x.abs()));
            // Comparisons are false for what is no number.
            let holds = f64::abs(sum) <= EXTREMAL * size;
            if !holds {
                let texts: Vec<String> =
                    given.iter().map(|(n, x)| format!("{n}(0) = {x}")).collect();
                return Err(format!(
                    "with {} this motion is no extremal: Σ κ E[f]·δq = {sum:.1e} for a virtual δq at t = {}",
                    texts.join(", "),
                    words::number(samples.times[row])
                ));
            }
        }
    }
    Ok(Kappa { rows: found, given })
}

/// By the rule of Runge and Kutta over two rows, and between them by Hermite's interpolation, both of the fourth order.
fn integrated(
    times: &[f64],
    count: usize,
    start: &[f64],
    rate: &dyn Fn(usize, &[f64]) -> Vec<f64>,
) -> Vec<Vec<f64>> {
    let moved = |x: &[f64], k: &[f64], by: f64| -> Vec<f64> {
        x.iter().zip(k).map(|(x, k)| x + by * k).collect()
    };
    let mut found = vec![start.to_vec()];
    while found.len() < count {
        let row = found.len() - 1;
        let own = found[row].clone();
        let k1 = rate(row, &own);
        if row + 2 >= count {
            // The last row alone: by the rule of Euler and Heun.
            let h = times[row + 1] - times[row];
            let k2 = rate(row + 1, &moved(&own, &k1, h));
            found.push(moved(&moved(&own, &k1, h / 2.0), &k2, h / 2.0));
            continue;
        }
        let h = times[row + 2] - times[row];
        let k2 = rate(row + 1, &moved(&own, &k1, h / 2.0));
        let k3 = rate(row + 1, &moved(&own, &k2, h / 2.0));
        let k4 = rate(row + 2, &moved(&own, &k3, h));
        let next: Vec<f64> = (0..own.len())
            .map(|l| own[l] + h / 6.0 * (k1[l] + 2.0 * (k2[l] + k3[l]) + k4[l]))
            .collect();
        let last = rate(row + 2, &next);
        let middle = (0..own.len())
            .map(|l| (own[l] + next[l]) / 2.0 + h / 8.0 * (k1[l] - last[l]))
            .collect();
        found.push(middle);
        found.push(next);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::integrated;

    /// κ' = κ − 2 has κ = 2 + (κ(0) − 2) e^t. A step of length h loses h⁵/120 of what grows, whence t h⁴/120 until t, Hermite's
    /// interpolation h⁴/384 once, and the last row, alone, (h/2)³/6.
    #[test]
    fn multipliers_from_their_start() {
        let times: Vec<f64> = (0..102).map(|j| f64::from(j) * 0.01).collect();
        let found = integrated(&times, 102, &[5.0], &|_, kappa| vec![kappa[0] - 2.0]);
        for (t, kappa) in times.iter().zip(found) {
            let (growing, h) = (3.0 * t.exp(), 0.02_f64);
            let last = if *t > 1.005 {
                0.01_f64.powi(3) / 6.0
            } else {
                0.0
            };
            let within = growing * (h.powi(4) * (t / 120.0 + 1.0 / 384.0) + last);
            assert!(
                (kappa[0] - 2.0 - growing).abs() < 1.05 * within,
                "{t} {kappa:?}"
            );
        }
    }
}
