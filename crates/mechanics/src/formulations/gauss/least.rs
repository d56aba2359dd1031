//! Whether the motion makes Gauss's function least or only stationary: the sign of `Bᵀ W B`.

use super::super::lagrange_dalembert::VirtualDisplacements;
use super::super::stated_apart;
use super::super::voronets::natural;
use super::super::Basis;
use crate::characteristics::Manifold;
use crate::linear::dot;
use crate::prover::{located, Prover};
use crate::quadratic_forms::{is_convex_in_one_form, nonnegative, positive_in_linear_forms};
use crate::sample;
use crate::system::System;
use crate::words::counted;
use chetaev_symbolic::matrix::{ldlt, Ldlt};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::verdict::{Counterexample, Evidence, Proof};
use chetaev_symbolic::{Expr, Graph, Node, Verdict};

/// What the motion is among the accelerations that the constraints allow.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// `Bᵀ W B` is positive definite almost everywhere: Z is least.
    Least(Proof),
    /// Z is stationary only: a virtual displacement δq with `δqᵀ W δq < 0` at the state of the counterexample.
    Stationary {
        /// δq as a function of (q, v, t), length n.
        direction: Vec<Expr>,
        /// The state.
        counterexample: Counterexample,
    },
    /// Neither was shown; `Bᵀ W B` is positive definite at sampled states.
    Sampled(Evidence),
    /// Neither was shown.
    Unknown {
        /// What was tried.
        tried: String,
    },
}

const ON: &str = "on the constraint manifold";

/// Decides whether the constraint is least; the accelerations must be unique, so that `Bᵀ W B` is regular.
///
/// Positive: the stated kinetic energy is a quadratic form that the assumptions make positive, or all pivots of the
/// factorization `L D Lᵀ` of W or of `Bᵀ W B` are (G. H. Golub, C. F. Van Loan, *Matrix Computations*, § 4.2); where that
/// is not so for all parameters, with the values of the model. Not positive: a virtual displacement, found at sampled
/// states, along which the form is enclosed below zero at a state.
pub fn kind(basis: &Basis<'_>, prover: &Prover) -> Kind {
    // Signs that need more than this are not found by trying longer.
    let prover = &Prover {
        budget: prover.budget.min(BUDGET),
        ..prover.clone()
    };
    let system = basis.system;
    if let Some(proof) = positive_energy(system, prover, &[]) {
        return Kind::Least(proof);
    }
    if is_convex_in_one_form(system) {
        return Kind::Least(Proof::structural(
            located("wherever both sides are defined", "at every state", system),
            "the Lagrangian is a function of one quadratic form in the velocities, and the signs of its two derivatives and \
             of the form make the mass matrix nowhere negative; it is regular on the virtual displacements",
        ));
    }
    let Ok(displacements) = VirtualDisplacements::new(basis) else {
        return unknown("the virtual displacements cannot be solved for");
    };
    let form = Form::new(basis, displacements);
    if form.matrix.is_empty() {
        let detail = "no virtual displacement is left: the constraints give the accelerations";
        return Kind::Least(Proof::structural(ON, detail));
    }
    // A sampled state may violate an assumption, so it only says what to try first.
    if let Some(combination) = form.negative_combination(basis) {
        if let Some(found) = form.refute(system, prover, &combination) {
            return found;
        }
    }
    let proof = form.prove(basis, prover, &[]);
    match proof.or_else(|why| form.prove_with_values(basis, prover).ok_or(why)) {
        Ok(proof) => Kind::Least(proof),
        Err(Unproved::Negative {
            combination,
            counterexample,
        }) => Kind::Stationary {
            direction: form.direction(system, &combination),
            counterexample: *counterexample,
        },
        Err(Unproved::Open(tried)) => match form.sampled(basis, &tried) {
            Some(evidence) => Kind::Sampled(evidence),
            None => unknown(tried),
        },
    }
}

/// Why a form was not proved to be nowhere negative.
enum Unproved {
    /// A pivot is negative at a state: the form is, along this combination of its directions.
    Negative {
        combination: Vec<Expr>,
        counterexample: Box<Counterexample>,
    },
    /// What was tried.
    Open(String),
}

fn unknown(tried: impl Into<String>) -> Kind {
    Kind::Unknown {
        tried: tried.into(),
    }
}

/// The stated kinetic energy, with these values of parameters, where it is a quadratic form in the velocities that is
/// nowhere negative: `δqᵀ W δq = 2T(δq)`.
fn positive_energy(system: &System, prover: &Prover, values: &[(Expr, Expr)]) -> Option<Proof> {
    let g = &system.graph;
    let kinetic = g.substitute(stated_apart(system)?.0, values);
    let velocities = system.velocity_symbols();
    let momenta = g.gradient(kinetic, &velocities);
    let hessian = g.jacobian(&momenta, &velocities).concat();
    let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
    let mut linear = momenta;
    linear.push(kinetic);
    let linear = g.substitute_all(&linear, &at_rest);
    if g.any_contains_any(&hessian, &velocities) || linear.iter().any(|&e| !g.is_zero(e)) {
        return None;
    }
    if let Some(count) = positive_in_linear_forms(system, kinetic) {
        return Some(Proof::structural(
            located("wherever both sides are defined", "at every state", system),
            format!(
                "the kinetic energy is a quadratic form in {} that is nowhere negative by its leading minors, and regular on \
                 the virtual displacements",
                counted(count, "linear form of the velocities", "linear forms of the velocities")
            ),
        ));
    }
    match nonnegative(system, prover, &Manifold::default(), kinetic, ON) {
        Verdict::Proved(mut proof) => {
            proof.detail = format!(
                "the kinetic energy is a quadratic form that is nowhere negative, and regular on the virtual displacements: {}",
                proof.detail
            );
            Some(proof)
        }
        _ => None,
    }
}

/// `Bᵀ W B` for a basis B of virtual displacements.
struct Form {
    displacements: VirtualDisplacements,
    /// k × k.
    matrix: Vec<Vec<Expr>>,
    manifold: Manifold,
}

/// States at which the form is sampled where its sign is not proved.
const SAMPLES: u32 = 32;

/// The first seed of these states.
const SEED: u64 = 0x6a55_0000;

/// Larger forms are not factored.
const LARGEST: usize = 6;

/// Field operations for one sign.
const BUDGET: u64 = 20_000_000;

/// Nor are forms with more distinct nodes times the square of the size: elimination multiplies them.
const MOST_WORK: usize = 250;

/// Distinct nodes of a pivot whose sign is still asked for: it must be seen from its form.
const LONGEST_PIVOT: usize = 24;

impl Form {
    fn new(basis: &Basis<'_>, displacements: VirtualDisplacements) -> Form {
        let (system, mass) = (basis.system, &basis.terms.mass_matrix);
        let g = &system.graph;
        let matrix = displacements
            .columns
            .iter()
            .map(|column| {
                let momentum: Vec<Expr> = mass.iter().map(|row| dot(g, row, column)).collect();
                displacements.contract(system, &momentum)
            })
            .collect();
        Form {
            displacements,
            matrix,
            manifold: natural(basis).map(|c| c.manifold).unwrap_or_default(),
        }
    }

    /// Constant rational coefficients of a displacement along which the form is negative at a sampled state.
    fn negative_combination(&self, basis: &Basis<'_>) -> Option<Vec<(i64, i64)>> {
        let g = &basis.system.graph;
        (0..4).find_map(|seed| {
            let point = sample::admissible_point(basis.system, basis.terms, 0x6a55 + seed)?;
            let entries = self.matrix.concat();
            let values = g.evaluate_f64(&entries, &|s| point.get(&s).copied()).ok()?;
            negative_vector(&values, self.matrix.len())
        })
    }

    /// The smallest pivot of the form at sampled states, over its largest entry; `None` where one is not clearly positive.
    fn sampled(&self, basis: &Basis<'_>, tried: &str) -> Option<Evidence> {
        let g = &basis.system.graph;
        let entries = self.matrix.concat();
        // A state may lie where a root of the Lagrangian is not real.
        let values = (0..8 * u64::from(SAMPLES)).filter_map(|seed| {
            let point = sample::admissible_point(basis.system, basis.terms, SEED + seed)?;
            let values = g.evaluate_f64(&entries, &|s| point.get(&s).copied()).ok()?;
            values.iter().all(|x| x.is_finite()).then_some(values)
        });
        let pivots: Vec<f64> = values
            .take(SAMPLES as usize)
            .map(|values| smallest_pivot(&values, self.matrix.len()))
            .collect();
        if pivots.len() < SAMPLES as usize {
            return None;
        }
        let smallest = pivots.iter().fold(f64::INFINITY, |m, &x| m.min(x));
        (smallest > 1e-9).then(|| Evidence {
            samples: SAMPLES,
            region: format!("sampled states {ON}; the smallest pivot of BᵀWB is {smallest:.1e} of its largest entry"),
            digits: 15,
            residual: 0.0,
            // The states are the same whatever the seed of the study.
            seed: None,
            why_no_proof: tried.to_owned(),
        })
    }

    fn refute(&self, system: &System, prover: &Prover, combination: &[(i64, i64)]) -> Option<Kind> {
        let g = &system.graph;
        let coefficients: Vec<Expr> = combination
            .iter()
            .map(|&(p, q)| ratio(p, q).map_or(g.zero(), |r| g.number(r)))
            .collect();
        let rows = self.matrix.iter();
        let image: Vec<Expr> = rows.map(|row| dot(g, row, &coefficients)).collect();
        let value = dot(g, &coefficients, &image);
        match nonnegative(system, prover, &self.manifold, value, ON) {
            Verdict::Refuted(counterexample)
            | Verdict::Conditional {
                counterexample: Some(counterexample),
                ..
            } => Some(Kind::Stationary {
                direction: self.direction(system, &coefficients),
                counterexample,
            }),
            _ => None,
        }
    }

    /// The virtual displacement with these coefficients.
    fn direction(&self, system: &System, coefficients: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let along = |i: usize| {
            let columns = self.displacements.columns.iter();
            let entries: Vec<Expr> = columns.map(|column| column[i]).collect();
            dot(g, coefficients, &entries)
        };
        (0..system.n()).map(along).collect()
    }

    /// By the pivots of W, in both orders of the coordinates, and of `Bᵀ W B`; else what was tried.
    fn prove(
        &self,
        basis: &Basis<'_>,
        prover: &Prover,
        values: &[(Expr, Expr)],
    ) -> Result<Proof, Unproved> {
        let (system, mass) = (basis.system, &basis.terms.mass_matrix);
        let whole = "the mass matrix";
        let restricted = "the mass matrix restricted to the virtual displacements";
        let everywhere = Manifold::default();
        pivots_are_positive(system, prover, (mass, &everywhere, whole), values)
            .or_else(|_| {
                let backwards = reversed(mass);
                pivots_are_positive(system, prover, (&backwards, &everywhere, whole), values)
            })
            .or_else(|_| {
                let of = (&self.matrix, &self.manifold, restricted);
                pivots_are_positive(system, prover, of, values)
            })
    }

    /// With the values that the model gives its parameters.
    fn prove_with_values(&self, basis: &Basis<'_>, prover: &Prover) -> Option<Proof> {
        let values = basis.system.parameter_values();
        let mut proof = positive_energy(basis.system, prover, &values)
            .or_else(|| self.prove(basis, prover, &values).ok())?;
        proof.detail = format!("for the values of the parameters {}", proof.detail);
        Some(proof)
    }
}

/// Rows and columns in the opposite order.
fn reversed(matrix: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let rows = matrix.iter().rev();
    rows.map(|row| row.iter().rev().copied().collect())
        .collect()
}

/// Proves that no pivot of a symmetric matrix is negative, with these values of parameters.
fn pivots_are_positive(
    system: &System,
    prover: &Prover,
    (matrix, manifold, name): (&Vec<Vec<Expr>>, &Manifold, &str),
    values: &[(Expr, Expr)],
) -> Result<Proof, Unproved> {
    let open = |tried: String| Err(Unproved::Open(tried));
    let size = matrix.len();
    if size > LARGEST {
        return open(format!(
            "the pivots of {name} are not computed: it has {size} rows, more than {LARGEST}"
        ));
    }
    let g = &system.graph;
    let rows = matrix.iter().map(|row| g.substitute_all(row, values));
    let rows: Vec<Vec<Expr>> = rows.collect();
    let reachable = g.reachable(&rows.concat());
    let nodes = reachable.len();
    // Zero tests of pivots with sines and cosines take long.
    let heavy = |e: &Expr| matches!(g.node(*e), Node::Apply { .. } | Node::Solve { .. });
    let is_heavy = size > 1 && reachable.iter().any(heavy);
    if is_heavy || nodes * size * size > MOST_WORK {
        return open(format!(
            "the pivots of {name} are not computed: it has {size} rows and its entries {nodes} distinct nodes"
        ));
    }
    let factors = match ldlt(g, &rows) {
        Ok(factors) => factors,
        Err(problem) => return open(format!("{name} was not factored: {problem}")),
    };
    let mut all: Option<Verdict> = None;
    for (place, &pivot) in factors.diagonal.iter().enumerate() {
        if g.reachable(&[pivot]).len() > LONGEST_PIVOT {
            return open(format!(
                "a pivot of {name} is too long for its sign to be seen"
            ));
        }
        let verdict = nonnegative(system, prover, manifold, pivot, ON);
        match &verdict {
            Verdict::Proved(_) => {}
            Verdict::Refuted(found) => {
                return Err(Unproved::Negative {
                    combination: direction_of_pivot(g, &factors, place),
                    counterexample: Box::new(found.clone()),
                })
            }
            other => {
                let why = other.detail();
                return open(format!(
                    "the sign of a pivot of {name} was not proved: {why}"
                ));
            }
        }
        all = Some(match all {
            Some(earlier) => earlier.and(verdict),
            None => verdict,
        });
    }
    match all {
        Some(Verdict::Proved(mut proof)) => {
            proof.detail = format!("all pivots of {name} are positive: {}", proof.detail);
            Ok(proof)
        }
        _ => open(format!("{name} has no pivots")),
    }
}

/// `L⁻ᵀ e_j`: along it the form `L D Lᵀ` has the value of its pivot j.
fn direction_of_pivot(g: &Graph, factors: &Ldlt, j: usize) -> Vec<Expr> {
    let size = factors.diagonal.len();
    let mut x = vec![g.zero(); size];
    x[j] = g.one();
    for i in (0..j).rev() {
        let column: Vec<Expr> = factors.lower.iter().map(|row| row[i]).collect();
        x[i] = g.neg(dot(g, &column[i + 1..], &x[i + 1..]));
    }
    x
}

/// A vector with small rational components along which a symmetric matrix is negative beyond rounding: a unit vector, a sum
/// or difference of two, or one of the factorization without exchanges.
fn negative_vector(matrix: &[f64], size: usize) -> Option<Vec<(i64, i64)>> {
    let largest = matrix.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let value = |c: &[(i64, i64)]| -> f64 {
        let x: Vec<f64> = c.iter().map(|&(p, q)| p as f64 / q as f64).collect();
        (0..size)
            .flat_map(|i| (0..size).map(move |j| (i, j)))
            .map(|(i, j)| x[i] * matrix[i * size + j] * x[j])
            .sum()
    };
    let unit = |i: usize, sign: i64, j: usize| {
        let mut c = vec![(0, 1); size];
        c[i] = (1, 1);
        if j != i {
            c[j] = (sign, 1);
        }
        c
    };
    let singles = (0..size).map(|i| unit(i, 1, i));
    let pairs = (0..size).flat_map(|i| (i + 1..size).map(move |j| (i, j)));
    let pairs = pairs.flat_map(|(i, j)| [unit(i, 1, j), unit(i, -1, j)]);
    let factored = pivot_vectors(matrix, size).into_iter();
    singles
        .chain(pairs)
        .chain(factored)
        .find(|c| value(c) < -1e-6 * largest)
}

/// The smallest pivot of a symmetric matrix over its largest entry; not positive where one is not, or is no number.
fn smallest_pivot(matrix: &[f64], size: usize) -> f64 {
    let mut reduced = matrix.to_vec();
    let largest = matrix.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut smallest = f64::INFINITY;
    for j in 0..size {
        let pivot = reduced[j * size + j];
        if pivot.is_nan() || pivot <= 0.0 {
            return f64::NEG_INFINITY;
        }
        smallest = smallest.min(pivot / largest);
        for i in j + 1..size {
            let factor = reduced[i * size + j] / pivot;
            for k in j + 1..size {
                reduced[i * size + k] -= factor * reduced[j * size + k];
            }
        }
    }
    smallest
}

/// The vectors `L⁻ᵀ e_j` of `A = L D Lᵀ`, rounded to sixteenths: along them the form takes its pivots.
fn pivot_vectors(matrix: &[f64], size: usize) -> Vec<Vec<(i64, i64)>> {
    let mut reduced = matrix.to_vec();
    let mut vectors: Vec<Vec<f64>> = Vec::new();
    for j in 0..size {
        let mut x = vec![0.0; size];
        x[j] = 1.0;
        for earlier in 0..j {
            let pivot = reduced[earlier * size + earlier];
            if pivot.abs() < 1e-12 {
                return rounded(&vectors);
            }
            let factor = reduced[earlier * size + j] / pivot;
            for (x, &y) in x.iter_mut().zip(&vectors[earlier]) {
                *x -= factor * y;
            }
        }
        vectors.push(x);
        let pivot = reduced[j * size + j];
        for i in j + 1..size {
            let factor = if pivot.abs() < 1e-12 {
                0.0
            } else {
                reduced[i * size + j] / pivot
            };
            for k in j + 1..size {
                reduced[i * size + k] -= factor * reduced[j * size + k];
            }
        }
    }
    rounded(&vectors)
}

fn rounded(vectors: &[Vec<f64>]) -> Vec<Vec<(i64, i64)>> {
    let sixteenths = |x: &f64| ((x * 16.0).round().clamp(-1e6, 1e6) as i64, 16);
    vectors
        .iter()
        .map(|x| x.iter().map(sixteenths).collect())
        .collect()
}
