//! The branches of the motion where the constraints of order m are nonlinear in the highest derivatives (T2 §5): all real
//! solutions of the equations for them, Gauss's function at each, and the choice among them.

use super::forms::{is_singular, kind};
use super::jets::{JetError, Search, STEPS};
use crate::dense::Lu;
use crate::functions::Functions;
use crate::least_norm::{identity, least_step};
use chetaev_mechanics::mass::with_velocity;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Symbol};

/// A real solution of the equations for the highest derivatives at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Derivatives of order m and multipliers.
    pub values: Vec<(Symbol, f64)>,
    /// Gauss's function `½ wᵀ M⁻¹ w`, where M is regular.
    pub constraint_function: Option<f64>,
    /// "minimum", "maximum" or "saddle" of Gauss's function among what the constraints admit (m = 2).
    pub kind: Option<&'static str>,
}

/// How many starting points a search for branches has.
const STARTS: usize = 400;
/// Solutions nearer than this to each other, relative to their size, are one.
const SAME: f64 = 1e-6;

/// What a search from many starting points came to.
struct Solutions {
    found: Vec<Vec<f64>>,
    /// The least residual of all searches.
    best: f64,
    /// How many searches ended where the system for the unknowns is singular.
    degenerate: usize,
}

impl Default for Solutions {
    fn default() -> Solutions {
        Solutions {
            found: Vec::new(),
            best: f64::INFINITY,
            degenerate: 0,
        }
    }
}

impl Solutions {
    fn take(&mut self, x: Vec<f64>, is_singular: bool) {
        if is_singular {
            self.degenerate += 1;
            return;
        }
        let distance = |other: &Vec<f64>| {
            let pairs = other.iter().zip(&x);
            pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        };
        let reach = SAME * (1.0 + largest(&x));
        if self.found.iter().all(|other| distance(other) > reach) {
            self.found.push(x);
        }
    }

    /// Why there is none.
    fn none(&self, unknowns: String) -> JetError {
        match self.degenerate {
            0 => JetError::NoRealSolution {
                unknowns,
                residual: self.best,
                starts: STARTS,
            },
            _ => JetError::Degenerate {
                unknowns,
                hint: ", so that the motion could go on in more than one way; another initial state or a force that is not zero there determines it".into(),
            },
        }
    }
}

/// By Gauss's function; where it is the same, by the values, larger ones first.
fn least_first(a: &Branch, b: &Branch) -> std::cmp::Ordering {
    let key = |b: &Branch| b.constraint_function.unwrap_or(f64::INFINITY);
    let values = |branch: &Branch| -> Vec<f64> { branch.values.iter().map(|(_, x)| -x).collect() };
    let close = (key(a) - key(b)).abs() <= 1e-9 * (key(a).abs() + key(b).abs());
    match close {
        true => values(a).partial_cmp(&values(b)),
        false => key(a).partial_cmp(&key(b)),
    }
    .unwrap_or(std::cmp::Ordering::Equal)
}

impl Search<'_> {
    /// All real solutions that a search from many starting points finds, least constraint first.
    pub(super) fn branches(&self, state: &[(Symbol, f64)]) -> Result<Vec<Branch>, JetError> {
        let unknowns = self.implicit();
        let solutions = self.solutions(state, &unknowns)?;
        if solutions.found.is_empty() {
            return Err(solutions.none(self.texts(&unknowns)));
        }
        let mut branches = Vec::new();
        for x in solutions.found {
            branches.push(self.branch(state, unknowns.iter().copied().zip(x).collect())?);
        }
        branches.sort_by(least_first);
        Ok(branches)
    }

    fn solutions(
        &self,
        state: &[(Symbol, f64)],
        unknowns: &[Symbol],
    ) -> Result<Solutions, JetError> {
        let (t, q, v) = self.at;
        let (symbols, known): (Vec<Symbol>, Vec<f64>) = state.iter().copied().unzip();
        let size = unknowns.len();
        let values: Vec<Expr> = self.equations.relations.iter().map(|(f, _)| *f).collect();
        let jacobian = self.system.graph.jacobian(&values, unknowns).concat();
        let further = [&symbols[..], unknowns].concat();
        let groups = [("values", values), ("jacobian", jacobian)];
        let mut functions = self.functions(&further, &groups)?;
        let mut generator = Generator::new(7);
        let mut solutions = Solutions::default();
        for start in 0..STARTS {
            let reach = 10f64.powi((start % 5) as i32 - 1);
            let x: Vec<f64> = (0..size)
                .map(|_| generator.between(-reach, reach))
                .collect();
            let Some((x, residual)) = newton(&mut functions, (t, q, v, &known), x, size) else {
                continue;
            };
            solutions.best = solutions.best.min(residual);
            let is_solution = residual <= 1e-10 * (1.0 + largest(&x));
            if is_solution && functions.evaluate(t, &[q, v, &known, &x]).is_ok() {
                solutions.take(x, is_singular(functions.group(1), size));
            }
        }
        Ok(solutions)
    }

    /// Gauss's function and its kind at a solution.
    fn branch(
        &self,
        state: &[(Symbol, f64)],
        values: Vec<(Symbol, f64)>,
    ) -> Result<Branch, JetError> {
        let (t, q, v) = self.at;
        let n = self.system.n();
        let all = [state, &values[..]].concat();
        let (symbols, numbers): (Vec<Symbol>, Vec<f64>) = all.into_iter().unzip();
        let mut functions = self.functions(&symbols, &self.constraint_function())?;
        let mut branch = Branch {
            values,
            constraint_function: None,
            kind: None,
        };
        if functions.evaluate(t, &[q, v, &numbers]).is_err() {
            return Ok(branch);
        }
        let mut lu = Lu::default();
        // Where a mass contains velocities M is not symmetric, and nothing is least.
        let is_symmetric = with_velocity(self.system).is_none();
        if is_symmetric && lu.factor(n, functions.group(1)).is_ok() {
            let mut x = functions.group(0).to_vec();
            lu.solve(&mut x);
            let pairs = x.iter().zip(functions.group(0));
            branch.constraint_function = Some(pairs.map(|(a, b)| 0.5 * a * b).sum());
        }
        if is_symmetric && self.basis.terms.order == 2 {
            branch.kind = kind(functions.group(2), functions.group(3), n);
        }
        Ok(branch)
    }

    /// What Gauss's function and its kind are computed from: w, M, the form of second variations, the gradients of the
    /// constraints.
    fn constraint_function(&self) -> [(&'static str, Vec<Expr>); 4] {
        let (terms, relations) = (self.basis.terms, &self.equations.relations);
        let jets: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
        let balance: Vec<Expr> = relations
            .iter()
            .take(self.system.n())
            .map(|r| r.0)
            .collect();
        let rows = self.basis.selection.rows.iter();
        let gradient: Vec<Expr> = rows.flat_map(|&row| terms.jacobian[row].clone()).collect();
        [
            ("w", self.system.motion_left_sides()),
            ("mass", terms.mass_matrix.concat()),
            ("form", self.system.graph.jacobian(&balance, &jets).concat()),
            ("gradient", gradient),
        ]
    }

    /// By given derivatives, by number, else the least constraint.
    pub(super) fn choose(&self, branches: &[Branch]) -> Result<usize, JetError> {
        let listed = || -> Vec<String> {
            let numbered = branches.iter().enumerate();
            numbered.map(|(i, b)| describe(self.system, i, b)).collect()
        };
        let jets = self.basis.terms.jets.iter().map(|c| c.v_symbol);
        let given: Vec<(Symbol, f64)> = jets.filter_map(|s| Some((s, self.given(s)?))).collect();
        if !given.is_empty() {
            return match fitting(branches, &given)[..] {
                [one] => Ok(one),
                [] => Err(JetError::NotOnABranch {
                    given: self.texts(&given.iter().map(|(s, _)| *s).collect::<Vec<_>>()),
                    branches: listed(),
                }),
                _ => Err(JetError::Choose { branches: listed() }),
            };
        }
        if let Some(wanted) = self.data.branch {
            let index = wanted.checked_sub(1).filter(|&i| i < branches.len());
            return index.ok_or_else(|| JetError::NoSuchBranch {
                wanted,
                branches: listed(),
            });
        }
        least(branches).ok_or_else(|| JetError::Choose { branches: listed() })
    }
}

/// The branches with these highest derivatives.
fn fitting(branches: &[Branch], given: &[(Symbol, f64)]) -> Vec<usize> {
    let fits = |branch: &Branch| {
        given.iter().all(|(symbol, value)| {
            let own = branch.values.iter().find(|(s, _)| s == symbol);
            own.is_some_and(|(_, x)| (x - value).abs() <= 1e-6 * (1.0 + x.abs()))
        })
    };
    (0..branches.len())
        .filter(|&i| fits(&branches[i]))
        .collect()
}

/// The first, if it is the only one or strictly Gauss's minimum.
fn least(branches: &[Branch]) -> Option<usize> {
    let [first, second, ..] = branches else {
        return (branches.len() == 1).then_some(0);
    };
    let (a, b) = (first.constraint_function?, second.constraint_function?);
    (a < b - 1e-9 * (a.abs() + b.abs()) && first.kind == Some("minimum")).then_some(0)
}

/// "1: x'' = 0.5, …; Gauss's function 0.1, minimum".
pub fn describe(system: &System, index: usize, branch: &Branch) -> String {
    let g = &system.graph;
    let values: Vec<String> = branch
        .values
        .iter()
        .map(|(s, x)| format!("{} = {}", g.symbol_text(*s), rounded(*x)))
        .collect();
    let mut text = format!("{}: {}", index + 1, values.join(", "));
    if let Some(z) = branch.constraint_function {
        text.push_str(&format!("; Gauss's function {}", rounded(z)));
    }
    if let Some(kind) = branch.kind {
        text.push_str(&format!(", {kind}"));
    }
    text
}

/// Without the digits that a search leaves, and without the sign of zero.
fn rounded(x: f64) -> f64 {
    (x * 1e9).round() / 1e9 + 0.0
}

/// Damped Newton steps; the last point with its largest residual, `None` where a value is not finite at the start.
fn newton(
    functions: &mut Functions,
    (t, q, v, known): (f64, &[f64], &[f64], &[f64]),
    mut x: Vec<f64>,
    size: usize,
) -> Option<(Vec<f64>, f64)> {
    let residual = |functions: &Functions| largest(functions.group(0));
    functions.evaluate(t, &[q, v, known, &x]).ok()?;
    let mut present = residual(functions);
    for _ in 0..STEPS {
        let all: Vec<usize> = (0..size).collect();
        let step = least_step(
            functions.group(1),
            functions.group(0),
            size,
            &all,
            &identity(size),
        );
        let next = (0..8).find_map(|halving| {
            let factor = 0.5f64.powi(halving);
            let next: Vec<f64> = x.iter().zip(&step).map(|(x, d)| x - factor * d).collect();
            functions.evaluate(t, &[q, v, known, &next]).ok()?;
            let found = residual(functions);
            (found < present || found <= 1e-14 * (1.0 + largest(&next))).then_some((next, found))
        });
        let Some((next, found)) = next else { break };
        let moved = x
            .iter()
            .zip(&next)
            .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        (x, present) = (next, found);
        if moved <= 4.0 * f64::EPSILON * (1.0 + largest(&x)) {
            break;
        }
    }
    Some((x, present))
}

pub(super) fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, x| m.max(x.abs()))
}
