//! What a system is known to keep is found where it lies in a family that was searched, and nothing else is reported.
//!
//! Every integral reported is followed along a motion computed in double precision from W, b, J, g as they are, without any of
//! the formulas that the search starts from.

use super::{Expected, Kind, Sampled, Subject, Trial};
use chetaev_geometry::noether::family::Member;
use chetaev_geometry::noether::found::{found, Found};
use chetaev_geometry::noether::motion::Motion;
use chetaev_integrate::{integrate, try_from_fn, EvaluationFailure, Options};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::sample::Point;
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Graph, Node, Symbol, Verdict};
use std::time::Instant;

/// More points than unknowns.
const SURPLUS: usize = 8;

/// Local error of the motion computed.
const TOLERANCE: f64 = 1e-12;

/// An integral that changes by more, of its size, is none.
const DRIFT: f64 = 1e-8;

/// How long motions are followed, unless they become fast: many run away in finite time.
const DURATION: f64 = 0.6;

/// Where a coordinate or velocity has so many times the size that it may have at first, a motion is not followed further.
const FAST: f64 = 30.0;

/// How many motions are followed.
const RUNS: usize = 2;

/// At most so many steps.
const STEPS: u64 = 400;

/// Tries what concerns the integrals that a system states.
///
/// # Errors
/// [`DeriveError`] where the accelerations could not be derived.
pub(crate) fn all(sampled: Sampled<'_>) -> Result<Vec<Trial>, DeriveError> {
    let subject = Subject::new(sampled)?;
    Ok(vec![
        conserved(&subject),
        stated(&subject),
        spoilt(&subject),
    ])
}

fn trial(law: &'static str, expected: Expected, about: String, verdict: Verdict) -> Trial {
    Trial {
        kind: match expected {
            Expected::Refuted => Kind::Mutant,
            _ => Kind::Other,
        },
        formulation: "",
        law,
        about,
        expected,
        verdict,
        seconds: 0.0,
    }
}

fn conserved(subject: &Subject<'_>) -> Trial {
    let start = Instant::now();
    let (verdict, about) = match looked_at(subject) {
        Ok(about) => (Verdict::Proved(Proof::exact("", "")), about),
        Err(problem) => (Verdict::undecided(problem), String::new()),
    };
    let law = "known integrals are found, and no others but true ones";
    Trial {
        seconds: start.elapsed().as_secs_f64(),
        ..trial(law, Expected::Proved, about, verdict)
    }
}

/// Whether X̄G = 0 for a function.
fn kept(subject: &Subject<'_>, value: Expr) -> Verdict {
    match Motion::of(subject.cx) {
        Ok(motion) => motion.is_integral(subject.cx, value),
        Err(problem) => Verdict::undecided(problem),
    }
}

fn known(subject: &Subject<'_>) -> Expr {
    let stated = subject.cx.system.integrals.first();
    stated.map_or(subject.cx.system.graph.zero(), |(_, value)| *value)
}

fn stated(subject: &Subject<'_>) -> Trial {
    let verdict = kept(subject, known(subject));
    trial(
        "known integrals are proved",
        Expected::Proved,
        String::new(),
        verdict,
    )
}

/// With the square of a coordinate the function is kept no more.
fn spoilt(subject: &Subject<'_>) -> Trial {
    let (system, g) = (subject.cx.system, &subject.cx.system.graph);
    let extra = g.powi(system.coordinates[0].q, 2);
    let verdict = kept(subject, g.add(&[known(subject), extra]));
    let about = format!("with {}", g.text(extra));
    trial(
        "another function is refuted",
        Expected::Refuted,
        about,
        verdict,
    )
}

/// Says of a known integral that a family contains it.
pub const CONTAINED: &str = "is in a family";

fn looked_at(subject: &Subject<'_>) -> Result<String, String> {
    let cx = subject.cx;
    let motion = Motion::of(cx)?;
    let found = found(cx);
    let found = found.as_ref().as_ref().map_err(Clone::clone)?;
    if found.open > 0 {
        return Err("an integral that was seen was not found".into());
    }
    let reported: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
    let mut words = Vec::new();
    for (name, value) in &cx.system.integrals {
        let contained = is_contained(subject, &motion, found, *value)?;
        if contained && !is_function_of(subject, &motion, &reported, *value)? {
            return Err(format!("`{name}` is in a family and was not found"));
        }
        words.push(match contained {
            true => format!("`{name}` {CONTAINED}"),
            false => format!("`{name}` is in no family"),
        });
    }
    let stated = cx.system.integrals.iter().map(|(_, value)| *value);
    let all: Vec<Expr> = reported.iter().copied().chain(stated).collect();
    followed(subject, &all)?;
    words.push(format!("{} found", reported.len()));
    Ok(words.join(", "))
}

/// Whether a family contains the function: whether it is a combination of the members at points over a prime field.
fn is_contained(
    subject: &Subject<'_>,
    motion: &Motion<'_>,
    found: &Found,
    value: Expr,
) -> Result<bool, String> {
    for searched in &found.families {
        let family = &searched.family;
        let mut outputs: Vec<Expr> = family.letters.iter().map(|l| l.value).collect();
        outputs.push(value);
        let points = motion.points(&outputs)?;
        let none = "no points over a prime field";
        let mut random = Random::stream(subject.seed, 0x1a6);
        let draw = points.draw(&mut random).ok_or(none)?;
        let field = &draw.field;
        let columns = family.members.len() + 1;
        let mut matrix = Vec::new();
        for _ in 0..columns + SURPLUS {
            let at = points.at(&draw, &mut random).ok_or(none)?;
            let member = |m: &Member| product(field, m, &at);
            let row: Option<Vec<Residue>> = family.members.iter().map(member).collect();
            matrix.extend(row.ok_or("a letter is zero")?);
            matrix.extend(at.last());
        }
        let space = null_space(field, columns, matrix);
        if space.vectors.iter().any(|(free, _)| *free == columns - 1) {
            return Ok(true);
        }
    }
    Ok(false)
}

fn product(field: &PrimeField, member: &Member, letters: &[Residue]) -> Option<Residue> {
    member.iter().try_fold(field.one(), |value, &(letter, e)| {
        let x = match e < 0 {
            true => field.inv(letters[letter])?,
            false => letters[letter],
        };
        let power = field.pow(x, u64::from(e.unsigned_abs()));
        Some(field.mul(value, power))
    })
}

/// Whether a function is one of those before it: the rank of the derivatives on the constraint manifold does not grow.
fn is_function_of(
    subject: &Subject<'_>,
    motion: &Motion<'_>,
    before: &[Expr],
    value: Expr,
) -> Result<bool, String> {
    let cx = subject.cx;
    let mut all = before.to_vec();
    all.push(value);
    let rank = cx
        .prover
        .rank(cx.system, &motion.gradients(&all), &motion.manifold);
    rank.map(|rank| rank.maximum <= before.len())
        .map_err(|problem| format!("the rank was not found: {}", problem.detail()))
}

/// The parts of a sum, whose sizes are the scale of rounding.
fn parts(g: &Graph, e: Expr) -> Vec<Expr> {
    match g.node(e) {
        Node::Sum { terms, .. } => terms.iter().map(|(part, c)| g.scale(c, *part)).collect(),
        _ => vec![e],
    }
}

/// Follows functions along the motions from some of the states.
fn followed(subject: &Subject<'_>, functions: &[Expr]) -> Result<(), String> {
    let g = &subject.cx.system.graph;
    let split: Vec<Vec<Expr>> = functions.iter().map(|&e| parts(g, e)).collect();
    let mut runs = 0;
    for state in &subject.states {
        if runs == RUNS {
            break;
        }
        let rows = along(subject, state, &split.concat())?;
        runs += usize::from(rows.len() > 2);
        let mut place = 0;
        for (&function, parts) in functions.iter().zip(&split) {
            let own = place..place + parts.len();
            place = own.end;
            let values = rows.iter().map(|row| row[own.clone()].iter().sum::<f64>());
            let (least, most) = values.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
            let sizes = rows.iter().flat_map(|row| &row[own.clone()]);
            let scale = sizes.fold(1.0_f64, |scale, x| scale.max(x.abs()));
            if most - least > DRIFT * scale {
                let text = g.text(function);
                return Err(format!(
                    "{text} lies between {least} and {most} along a motion"
                ));
            }
        }
    }
    match runs {
        0 => Err("no motion could be computed".into()),
        _ => Ok(()),
    }
}

/// The values of functions along the motion from a state.
fn along(
    subject: &Subject<'_>,
    start: &Point,
    functions: &[Expr],
) -> Result<Vec<Vec<f64>>, String> {
    let (system, terms) = (subject.cx.system, subject.cx.terms);
    let (g, n) = (&system.graph, system.n());
    let rows = &subject.cx.selection.rows;
    let mut outputs = terms.mass_matrix.concat();
    outputs.extend(&terms.force);
    rows.iter()
        .for_each(|&l| outputs.extend(&terms.jacobian[l]));
    outputs.extend(rows.iter().map(|&l| terms.constraint_rate[l]));
    let time = g.intern_symbol("t", 0);
    let state: Vec<Symbol> = system
        .coordinates
        .iter()
        .map(|c| c.q_symbol)
        .chain(system.coordinates.iter().map(|c| c.v_symbol))
        .collect();
    let at = |es: &[Expr], t: f64, y: &[f64]| {
        let value = |s: Symbol| match state.iter().position(|&own| own == s) {
            Some(place) => Some(y[place]),
            None if s == time => Some(t),
            None => start.get(&s).copied(),
        };
        g.evaluate_f64(es, &value).ok()
    };
    let domain = EvaluationFailure::Domain { operation: 0 };
    let y0: Option<Vec<f64>> = state.iter().map(|s| start.get(s).copied()).collect();
    let y0 = y0.ok_or("a state without values")?;
    let fast = y0.iter().fold(FAST, |fast, x| fast.max(FAST * x.abs()));
    let mut flow = try_from_fn(2 * n, |t: f64, y: &[f64], rate: &mut [f64]| {
        if y.iter().any(|x| x.abs() > 10.0 * fast) {
            return Err(domain);
        }
        let values = at(&outputs, t, y).ok_or(domain)?;
        let a = accelerations(&values, n, rows.len()).ok_or(domain)?;
        rate[..n].copy_from_slice(&y[n..]);
        rate[n..].copy_from_slice(&a);
        Ok(())
    });
    let t0 = start.get(&time).copied().unwrap_or(0.0);
    let mut options = Options::tolerance(TOLERANCE);
    options.step_limit = STEPS;
    let solution = integrate(&mut flow, (t0, t0 + DURATION), &y0, &mut [], options)
        .map_err(|problem| problem.to_string())?;
    let states = solution.times.iter().zip(solution.rows.chunks(2 * n));
    Ok(states
        .take_while(|(_, y)| y.iter().all(|x| x.abs() < fast))
        .filter_map(|(&t, y)| at(functions, t, y))
        .filter(|values| values.iter().all(|x| x.is_finite()))
        .collect())
}

/// q'' of `[[W, -Jᵀ], [J, 0]] (q'', λ) = (b, g)` by elimination with pivots; `None` where it is singular.
fn accelerations(values: &[f64], n: usize, r: usize) -> Option<Vec<f64>> {
    let (mass, rest) = values.split_at(n * n);
    let (force, rest) = rest.split_at(n);
    let (jacobian, right) = rest.split_at(r * n);
    let size = n + r;
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(size);
    for i in 0..n {
        let reaction = (0..r).map(|l| -jacobian[l * n + i]);
        let row = mass[i * n..(i + 1) * n].iter().copied();
        rows.push(row.chain(reaction).chain([force[i]]).collect());
    }
    for l in 0..r {
        let row = jacobian[l * n..(l + 1) * n].iter().copied();
        let zeros = std::iter::repeat_n(0.0, r);
        rows.push(row.chain(zeros).chain([right[l]]).collect());
    }
    for step in 0..size {
        let best = (step..size).max_by(|&a, &b| {
            let (a, b) = (rows[a][step].abs(), rows[b][step].abs());
            a.total_cmp(&b)
        })?;
        rows.swap(step, best);
        if rows[step][step].abs() < 1e-10 {
            return None;
        }
        let pivot = rows[step].clone();
        for row in rows.iter_mut().skip(step + 1) {
            let factor = row[step] / pivot[step];
            let pairs = row.iter_mut().zip(&pivot).skip(step);
            pairs.for_each(|(x, p)| *x -= factor * p);
        }
    }
    let mut solution = vec![0.0; size];
    for i in (0..size).rev() {
        let known: f64 = (i + 1..size).map(|j| rows[i][j] * solution[j]).sum();
        solution[i] = (rows[i][size] - known) / rows[i][i];
    }
    solution.truncate(n);
    Some(solution)
}
