//! Kinematic characteristics: a parametrization of the admissible velocities, and with it the virtual displacements.
//!
//! `v = φ(q, P, t)` with `f(q, φ, t) ≡ 0`, `B = ∂φ/∂P` (n × k), `J B = 0` (T2 §2, order 1). The parameters P are k
//! independent velocities, or quasi-velocities of the user. For a constraint nonlinear in the velocities the dependent
//! velocity stays a symbol, tied to the others by f = 0 (implicit embedding, T1 §9.6).

use crate::sample;
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words::quoted;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Symbol};

/// A parameter P of the admissible velocities.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name: a velocity such as `x'`, or a quasi-velocity.
    pub name: String,
    /// P.
    pub value: Expr,
    /// P'.
    pub rate: Expr,
    /// The symbol of P.
    pub symbol: Symbol,
    /// The symbol of P'.
    pub rate_symbol: Symbol,
    /// What P is as a function of (q, v, t); for an independent velocity the velocity itself.
    pub definition: Expr,
}

/// The constraint manifold as exact data for a zero test.
#[derive(Clone, Debug, Default)]
pub struct Manifold {
    /// Symbols given exactly by the others.
    pub solved: Vec<(Symbol, Expr)>,
    /// Pairs (f, dependent velocity) of constraints that stay implicit.
    pub implicit: Vec<(Expr, Symbol)>,
}

/// A parametrization of the admissible velocities.
#[derive(Clone, Debug)]
pub struct Characteristics {
    /// P, length k.
    pub parameters: Vec<Parameter>,
    /// φ, the velocities as functions of (q, P, t); length n.
    pub velocities: Vec<Expr>,
    /// B = ∂φ/∂P, n × k, row by row.
    pub basis: Vec<Vec<Expr>>,
    /// Dφ on the jet (q, P, P', t), length n.
    pub accelerations: Vec<Expr>,
    /// The part of the accelerations free of P': `a = B P' + a*`; length n.
    pub acceleration_offset: Vec<Expr>,
    /// Indices of the dependent velocities where P are velocities.
    pub dependent: Vec<usize>,
    /// Rows of the terms that were used (independent constraints).
    pub rows: Vec<usize>,
    /// The constraint manifold in these variables.
    pub manifold: Manifold,
}

/// Why no characteristics can be formed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CharacteristicsError {
    /// The dependent velocities chosen cannot be solved for.
    #[error("the velocities {dependent} cannot be solved from the constraints: {source}")]
    NotSolvable {
        /// The velocities.
        dependent: String,
        /// Why.
        source: SolveError,
    },
    /// No state satisfies the constraints.
    #[error("no real state was found that satisfies the constraints {names} and at which their gradients by the velocities do not vanish")]
    NoAdmissibleState {
        /// The constraints.
        names: String,
    },
    /// Constraints with dependent gradients that do not follow from the others.
    #[error("the constraints contradict each other, or hide a condition that is not stated: the gradients of {names} depend on those of the others, and where the others hold {names} demand{s} {demands}; state that as a constraint of its own, or leave {names} out", s = if names.contains(',') { "" } else { "s" })]
    Contradiction {
        /// Names in quotes.
        names: String,
        /// What they demand, as equations.
        demands: String,
    },
    /// The wrong number of independent velocities.
    #[error("{found} independent velocities were chosen, the system has {expected}")]
    WrongNumber {
        /// k.
        expected: usize,
        /// Given.
        found: usize,
    },
}

/// The rows of independent constraints and the dependent velocities to solve them for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Independent rows of the terms.
    pub rows: Vec<usize>,
    /// Dependent velocities, one per row.
    pub dependent: Vec<usize>,
}

impl Selection {
    /// The independent velocities of n coordinates.
    pub fn independent(&self, n: usize) -> Vec<usize> {
        (0..n).filter(|i| !self.dependent.contains(i)).collect()
    }
}

/// Chooses independent rows and dependent velocities: those the user wants independent stay so where possible, then
/// pivots that are numbers are preferred to parameters, parameters to functions of the state.
///
/// The choice is heuristic (one sampled state); that it is regular is a claim of its own.
///
/// # Errors
/// [`CharacteristicsError::NoAdmissibleState`].
pub fn select(system: &System, terms: &MotionTerms) -> Result<Selection, CharacteristicsError> {
    let n = system.n();
    let r = terms.constraints.len();
    if r == 0 {
        return Ok(Selection {
            rows: Vec::new(),
            dependent: Vec::new(),
        });
    }
    let point = sample::admissible_point(system, terms, 0x0c4e_7ae5).ok_or_else(|| {
        CharacteristicsError::NoAdmissibleState {
            names: constraint_names(system, terms),
        }
    })?;
    let values = system
        .graph
        .evaluate_f64(&terms.jacobian.concat(), &|s| point.get(&s).copied())
        .unwrap_or_else(|_| vec![f64::NAN; n * r]);
    let cost: Vec<Vec<usize>> = terms
        .jacobian
        .iter()
        .map(|row| (0..n).map(|j| pivot_cost(system, row[j], j)).collect())
        .collect();
    Ok(eliminate(values, cost, n))
}

fn constraint_names(system: &System, terms: &MotionTerms) -> String {
    quoted(
        terms
            .constraint_index
            .iter()
            .map(|&l| &system.constraints[l].name),
    )
}

fn pivot_cost(system: &System, entry: Expr, j: usize) -> usize {
    let g = &system.graph;
    let wanted = if system.independent.contains(&j) {
        1_000_000
    } else {
        0
    };
    let size = g.reachable(&[entry]).len().min(900);
    let kind = if g.as_number(entry).is_some() {
        0
    } else if g.is_free_of(entry, &|s| {
        system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t"
    }) {
        1000
    } else {
        2000
    };
    // A velocity in which the constraint is affine can always be solved for; a root may not be real.
    let nonlinear = if g.contains_any(entry, &[system.coordinates[j].v_symbol]) {
        100_000
    } else {
        0
    };
    wanted + nonlinear + kind + size
}

/// Gaussian elimination that takes, among pivots that are not small, the cheapest.
fn eliminate(mut a: Vec<f64>, cost: Vec<Vec<usize>>, n: usize) -> Selection {
    let r = cost.len();
    let scale: Vec<f64> = (0..r)
        .map(|i| {
            a[i * n..(i + 1) * n]
                .iter()
                .fold(0.0, |m: f64, x| m.max(x.abs()))
        })
        .collect();
    let mut selection = Selection {
        rows: Vec::new(),
        dependent: Vec::new(),
    };
    let mut open: Vec<usize> = (0..r).collect();
    while !open.is_empty() {
        let mut best: Option<(usize, usize, usize)> = None;
        for &i in &open {
            for j in (0..n).filter(|j| !selection.dependent.contains(j)) {
                let usable = a[i * n + j].abs() > 1e-9 * scale[i].max(1e-300);
                let better = best.is_none_or(|(c, _, _)| cost[i][j] < c);
                if usable && better {
                    best = Some((cost[i][j], i, j));
                }
            }
        }
        let Some((_, i, j)) = best else { break };
        selection.rows.push(i);
        selection.dependent.push(j);
        open.retain(|&o| o != i);
        for &o in &open {
            let factor = a[o * n + j] / a[i * n + j];
            for c in 0..n {
                a[o * n + c] -= factor * a[i * n + c];
            }
            a[o * n + j] = 0.0;
        }
    }
    sort_pairs(&mut selection);
    selection
}

/// Rows ascending, so that output follows the order of the model.
fn sort_pairs(selection: &mut Selection) {
    let mut pairs: Vec<(usize, usize)> = selection
        .rows
        .iter()
        .copied()
        .zip(selection.dependent.iter().copied())
        .collect();
    pairs.sort_unstable();
    (selection.rows, selection.dependent) = pairs.into_iter().unzip();
}

impl Characteristics {
    /// Characteristics by independent velocities.
    ///
    /// # Errors
    /// [`CharacteristicsError::NotSolvable`] when the dependent velocities are structurally no unknowns.
    pub fn independent_velocities(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<Characteristics, CharacteristicsError> {
        let independent = selection.independent(system.n());
        let parameters: Vec<Parameter> = independent
            .iter()
            .map(|&i| {
                let c = &system.coordinates[i];
                Parameter {
                    name: format!("{}'", c.name),
                    value: c.v,
                    rate: c.a,
                    symbol: c.v_symbol,
                    rate_symbol: c.a_symbol,
                    definition: c.v,
                }
            })
            .collect();
        Builder {
            system,
            terms,
            selection,
            independent,
        }
        .by_velocities(parameters)
        .map_err(|source| not_solvable(system, selection, source))
    }

    /// Characteristics by the quasi-velocities of the user; `None` when they do not fit: their number is not k, or they
    /// or the constraints are not affine in the velocities.
    ///
    /// # Errors
    /// [`CharacteristicsError::NotSolvable`].
    pub fn quasi_velocities(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Option<Result<Characteristics, CharacteristicsError>> {
        let k = system.n() - selection.rows.len();
        let affine = selection
            .rows
            .iter()
            .all(|&row| system.constraints[terms.constraint_index[row]].is_affine_in_velocities());
        if system.quasi_velocities.len() != k || k == 0 || !affine {
            return None;
        }
        let builder = Builder {
            system,
            terms,
            selection,
            independent: selection.independent(system.n()),
        };
        let result = builder.by_quasi_velocities()?;
        Some(result.map_err(|source| not_solvable(system, selection, source)))
    }

    /// k, the number of independent velocities.
    pub fn k(&self) -> usize {
        self.parameters.len()
    }

    /// Replaces the velocities by φ and leaves the rest.
    pub fn restrict(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let pairs: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&self.velocities)
            .filter(|(c, phi)| c.v != **phi)
            .map(|(c, phi)| (c.v, *phi))
            .collect();
        system.graph.substitute_all(es, &pairs)
    }
}

fn not_solvable(
    system: &System,
    selection: &Selection,
    source: SolveError,
) -> CharacteristicsError {
    let names: Vec<String> = selection
        .dependent
        .iter()
        .map(|&j| format!("{}'", system.coordinates[j].name))
        .collect();
    CharacteristicsError::NotSolvable {
        dependent: names.join(", "),
        source,
    }
}

struct Builder<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    selection: &'a Selection,
    independent: Vec<usize>,
}

impl Builder<'_> {
    fn is_affine(&self) -> bool {
        self.selection.rows.iter().all(|&row| {
            self.system.constraints[self.terms.constraint_index[row]].is_affine_in_velocities()
        })
    }

    /// J restricted to the selected rows and dependent columns, row by row.
    fn dependent_jacobian(&self) -> Vec<Expr> {
        let mut entries = Vec::new();
        for &row in &self.selection.rows {
            for &j in &self.selection.dependent {
                entries.push(self.terms.jacobian[row][j]);
            }
        }
        entries
    }

    fn by_velocities(&self, parameters: Vec<Parameter>) -> Result<Characteristics, SolveError> {
        let g = &self.system.graph;
        let n = self.system.n();
        let matrix = self.dependent_jacobian();
        let mut basis = vec![vec![g.zero(); parameters.len()]; n];
        for (sigma, &i) in self.independent.iter().enumerate() {
            basis[i][sigma] = g.one();
            let rhs: Vec<Expr> = self
                .selection
                .rows
                .iter()
                .map(|&row| g.neg(self.terms.jacobian[row][i]))
                .collect();
            for (&d, value) in self.selection.dependent.iter().zip(g.solve(&matrix, &rhs)?) {
                basis[d][sigma] = value;
            }
        }
        let mut velocities: Vec<Expr> = self.system.coordinates.iter().map(|c| c.v).collect();
        let mut manifold = Manifold::default();
        if self.is_affine() {
            for (&d, phi) in self
                .selection
                .dependent
                .iter()
                .zip(self.solved_velocities(&matrix)?)
            {
                velocities[d] = phi;
                manifold
                    .solved
                    .push((self.system.coordinates[d].v_symbol, phi));
            }
        } else {
            for (&row, &d) in self.selection.rows.iter().zip(&self.selection.dependent) {
                let symbol = self.system.coordinates[d].v_symbol;
                manifold
                    .implicit
                    .push((self.terms.constraints[row], symbol));
            }
        }
        self.finish(parameters, velocities, basis, manifold)
    }

    /// `v_d = -J_d⁻¹ (J_i v_i + f₀)` for affine constraints.
    fn solved_velocities(&self, matrix: &[Expr]) -> Result<Vec<Expr>, SolveError> {
        let g = &self.system.graph;
        let at_rest: Vec<(Expr, Expr)> = self
            .selection
            .dependent
            .iter()
            .map(|&d| (self.system.coordinates[d].v, g.zero()))
            .collect();
        let rhs: Vec<Expr> = self
            .selection
            .rows
            .iter()
            .map(|&row| g.neg(g.substitute(self.terms.constraints[row], &at_rest)))
            .collect();
        g.solve(matrix, &rhs)
    }

    /// Solves constraints and definitions of quasi-velocities together for the velocities.
    fn by_quasi_velocities(&self) -> Option<Result<Characteristics, SolveError>> {
        let (system, g) = (self.system, &self.system.graph);
        let n = system.n();
        let velocity_symbols = system.velocity_symbols();
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        let mut matrix = Vec::new();
        let mut rhs = Vec::new();
        for &row in &self.selection.rows {
            matrix.extend(&self.terms.jacobian[row]);
            rhs.push(g.neg(g.substitute(self.terms.constraints[row], &at_rest)));
        }
        let mut parameters = Vec::new();
        for quasi in &system.quasi_velocities {
            let gradient = g.gradient(quasi.definition, &velocity_symbols);
            if gradient
                .iter()
                .any(|&e| g.contains_any(e, &velocity_symbols))
            {
                return None;
            }
            matrix.extend(gradient);
            let value = g.symbol(&quasi.name, 0);
            rhs.push(g.sub(value, g.substitute(quasi.definition, &at_rest)));
            parameters.push(Parameter {
                name: quasi.name.clone(),
                value,
                rate: g.symbol(&quasi.name, 1),
                symbol: g.intern_symbol(&quasi.name, 0),
                rate_symbol: g.intern_symbol(&quasi.name, 1),
                definition: quasi.definition,
            });
        }
        Some(self.solve_for_velocities(n, &matrix, &rhs, parameters))
    }

    fn solve_for_velocities(
        &self,
        n: usize,
        matrix: &[Expr],
        rhs: &[Expr],
        parameters: Vec<Parameter>,
    ) -> Result<Characteristics, SolveError> {
        let g = &self.system.graph;
        let velocities = g.solve(matrix, rhs)?;
        let mut basis = vec![Vec::new(); n];
        for sigma in 0..parameters.len() {
            let mut unit = vec![g.zero(); n];
            unit[self.selection.rows.len() + sigma] = g.one();
            for (row, value) in basis.iter_mut().zip(g.solve(matrix, &unit)?) {
                row.push(value);
            }
        }
        let solved = self
            .system
            .coordinates
            .iter()
            .zip(&velocities)
            .map(|(c, &phi)| (c.v_symbol, phi))
            .collect();
        let manifold = Manifold {
            solved,
            implicit: Vec::new(),
        };
        self.finish(parameters, velocities, basis, manifold)
    }

    /// Accelerations as total derivatives of φ on the jet (q, P, P', t).
    fn finish(
        &self,
        parameters: Vec<Parameter>,
        velocities: Vec<Expr>,
        basis: Vec<Vec<Expr>>,
        manifold: Manifold,
    ) -> Result<Characteristics, SolveError> {
        let (system, g) = (self.system, &self.system.graph);
        let mut characteristics = Characteristics {
            parameters,
            accelerations: Vec::new(),
            acceleration_offset: Vec::new(),
            velocities,
            basis,
            dependent: self.selection.dependent.clone(),
            rows: self.selection.rows.clone(),
            manifold,
        };
        characteristics.accelerations = if characteristics.manifold.implicit.is_empty() {
            total_derivative_on_jet(system, &characteristics)
        } else {
            self.implicit_accelerations()?
        };
        let at_zero: Vec<(Expr, Expr)> = characteristics
            .parameters
            .iter()
            .map(|p| (p.rate, g.zero()))
            .collect();
        characteristics.acceleration_offset =
            g.substitute_all(&characteristics.accelerations, &at_zero);
        Ok(characteristics)
    }

    /// `a_d = J_d⁻¹ (g - J_i a_i)`: f differentiated once (T1 (54)).
    fn implicit_accelerations(&self) -> Result<Vec<Expr>, SolveError> {
        let (system, g) = (self.system, &self.system.graph);
        let mut accelerations: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
        let rhs: Vec<Expr> = self
            .selection
            .rows
            .iter()
            .map(|&row| {
                let mut parts = vec![self.terms.constraint_rate[row]];
                for &i in &self.independent {
                    let term = g.mul(&[self.terms.jacobian[row][i], system.coordinates[i].a]);
                    parts.push(g.neg(term));
                }
                g.add(&parts)
            })
            .collect();
        let values = g.solve(&self.dependent_jacobian(), &rhs)?;
        for (&d, value) in self.selection.dependent.iter().zip(values) {
            accelerations[d] = value;
        }
        Ok(accelerations)
    }
}

/// Dφ with q' = φ and P' free.
fn total_derivative_on_jet(system: &System, characteristics: &Characteristics) -> Vec<Expr> {
    let g = &system.graph;
    let one = g.one();
    g.derive(&characteristics.velocities, &|s| {
        if let Some(i) = system.coordinates.iter().position(|c| c.q_symbol == s) {
            return Some(characteristics.velocities[i]);
        }
        if let Some(p) = characteristics.parameters.iter().find(|p| p.symbol == s) {
            return Some(p.rate);
        }
        let (name, order) = (g.symbol_name(s), g.symbol_order(s));
        if name == "t" && order == 0 {
            Some(one)
        } else if system.controls.iter().any(|u| u.name == name) {
            Some(g.symbol(name, order + 1))
        } else {
            None
        }
    })
}
