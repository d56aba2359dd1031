//! Initial data beyond coordinates and velocities for constraints of order m ≥ 2 (T2 §5): higher derivatives, multipliers that
//! are variables of the state, and the branch where the constraints are nonlinear in the highest derivatives.

use super::branches::{largest, Branch};
use super::forms::rank;
use crate::functions::{Functions, FunctionsError};
use crate::least_norm::{identity, least_step};
use crate::numeric::Binding;
use chetaev_mechanics::equations::NamedExpr;
use chetaev_mechanics::formulations::{DeriveError, Routh};
use chetaev_mechanics::order::reduced::observable_conditions;
use chetaev_mechanics::{Basis, Equations, Formulation, System};
use chetaev_symbolic::{Expr, Symbol};

/// What is given beyond coordinates and velocities.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JetData {
    /// Values of higher derivatives and of multipliers, `x''` and `lambda_NAME`, by symbol.
    pub given: Vec<(Symbol, f64)>,
    /// The branch wanted, counted from 1 as they are listed.
    pub branch: Option<usize>,
    /// Whether what is given may be moved where it contradicts the equations.
    pub project: bool,
}

/// A state on the jet that satisfies constraints and equations of motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JetStart {
    /// Derivatives of orders 2..m and the multipliers in the state, by symbol.
    pub values: Vec<(Symbol, f64)>,
    /// Names of what was completed, with the values found.
    pub completed: Vec<(String, f64)>,
    /// Names of what was given although the other data determine it: multipliers that are no variables of the state.
    pub unused: Vec<String>,
    /// All real branches found, least constraint first; one where the equations are linear.
    pub branches: Vec<Branch>,
    /// The branch taken.
    pub taken: usize,
    /// What must vanish along the motion beside the constraints as stated: their derivatives, and equations of motion that
    /// were differentiated; with names.
    pub conditions: Vec<(String, Expr)>,
}

/// Why there is no start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JetError {
    /// The equations cannot be derived.
    #[error(transparent)]
    Derive(#[from] DeriveError),
    /// The equations cannot be compiled.
    #[error(transparent)]
    Functions(#[from] FunctionsError),
    /// Too few data.
    #[error("the motion needs {count} more initial {datum} beside coordinates and velocities: give {count} of {names} in [initial]", datum = if *count == 1 { "value" } else { "values" })]
    Missing {
        /// How many.
        count: usize,
        /// Candidates, in quotes.
        names: String,
    },
    /// What is given contradicts the equations.
    #[error("the initial values of {given} contradict the equations: {violated}; correct them, or let them be moved with `project = true`")]
    Inconsistent {
        /// What was given, in quotes.
        given: String,
        /// Conditions with their residuals.
        violated: String,
    },
    /// A function has no finite value at the start.
    #[error(
        "the initial state is singular: the equations for {unknowns} have no finite value there"
    )]
    NotFinite {
        /// What is solved for.
        unknowns: String,
    },
    /// No real solution.
    #[error("no real {unknowns} satisfies the constraints and the equations of motion at the initial state: the best of {starts} searches leaves the residual {residual:.3e}")]
    NoRealSolution {
        /// What is solved for.
        unknowns: String,
        /// The residual left.
        residual: f64,
        /// How many starting points.
        starts: usize,
    },
    /// A degenerate start.
    #[error("the equations do not determine {unknowns} at the initial state: the determinant of the system for them vanishes there{hint}")]
    Degenerate {
        /// What is solved for.
        unknowns: String,
        /// What that means.
        hint: String,
    },
    /// Several branches and no rule to choose.
    #[error("there are {} branches of the motion and none has the least constraint; choose one with --branch N or `branch = N` in [initial], or give the highest derivatives:\n{}", branches.len(), branches.join("\n"))]
    Choose {
        /// As they are listed.
        branches: Vec<String>,
    },
    /// A branch that does not exist.
    #[error("there is no branch {wanted}; the branches are:\n{}", branches.join("\n"))]
    NoSuchBranch {
        /// Asked for.
        wanted: usize,
        /// As they are listed.
        branches: Vec<String>,
    },
    /// Given highest derivatives that lie on no branch.
    #[error("the given {given} lies on no branch of the motion; the branches are:\n{}", branches.join("\n"))]
    NotOnABranch {
        /// As given.
        given: String,
        /// As they are listed.
        branches: Vec<String>,
    },
}

/// What it costs to move a value that is not given, beside one that is.
const FREE: f64 = 1e-10;

/// The most steps of Newton's method.
pub(super) const STEPS: usize = 80;

/// Completes and checks the data beyond coordinates and velocities.
///
/// # Errors
/// [`JetError`].
pub fn jet_start(
    basis: &Basis<'_>,
    binding: &Binding,
    (t, q, v): (f64, &[f64], &[f64]),
    data: &JetData,
) -> Result<JetStart, JetError> {
    let equations = Routh.equations(basis)?;
    let search = Search {
        system: basis.system,
        basis,
        binding,
        equations: &equations,
        at: (t, q, v),
        data,
    };
    let state = search.conditions()?;
    let mut start = search.highest(state)?;
    start.unused = search.unused();
    let stated: Vec<Expr> = basis.system.constraints.iter().map(|c| c.stated).collect();
    let conditions = observable_conditions(basis, &equations.conditions).into_iter();
    start.conditions = conditions
        .filter(|c| !stated.contains(&c.value))
        .map(|c| (c.name, c.value))
        .collect();
    Ok(start)
}

pub(super) struct Search<'a> {
    pub(super) system: &'a System,
    pub(super) basis: &'a Basis<'a>,
    binding: &'a Binding,
    pub(super) equations: &'a Equations,
    pub(super) at: (f64, &'a [f64], &'a [f64]),
    pub(super) data: &'a JetData,
}

impl Search<'_> {
    fn text(&self, symbol: Symbol) -> String {
        self.system.graph.symbol_text(symbol)
    }

    pub(super) fn texts(&self, symbols: &[Symbol]) -> String {
        let names = symbols.iter().map(|&s| self.text(s));
        chetaev_mechanics::words::quoted(names)
    }

    pub(super) fn given(&self, symbol: Symbol) -> Option<f64> {
        let found = self.data.given.iter().find(|(own, _)| *own == symbol);
        found.map(|(_, value)| *value)
    }

    /// The unknowns that stay implicit.
    pub(super) fn implicit(&self) -> Vec<Symbol> {
        self.equations.relations.iter().map(|(_, s)| *s).collect()
    }

    /// Variables beyond (q, v) that are no implicit unknowns.
    fn beyond(&self) -> Vec<Symbol> {
        let implicit = self.implicit();
        let own = self.equations.variables.iter().map(|x| x.symbol);
        own.filter(|s| !implicit.contains(s) && !self.binding.variables.contains(s))
            .collect()
    }

    fn unused(&self) -> Vec<String> {
        let mut data = self.beyond();
        data.extend(self.basis.terms.jets.iter().map(|c| c.v_symbol));
        let given = self.data.given.iter().map(|&(symbol, _)| symbol);
        given
            .filter(|symbol| !data.contains(symbol))
            .map(|symbol| self.text(symbol))
            .collect()
    }

    pub(super) fn functions(
        &self,
        further: &[Symbol],
        groups: &[(&str, Vec<Expr>)],
    ) -> Result<Functions, FunctionsError> {
        let variables = [&self.binding.variables[..], further].concat();
        Functions::new(&self.system.graph, self.binding, &variables, groups)
    }

    /// The variables beyond (q, v) from what is given and the conditions on them.
    fn conditions(&self) -> Result<Vec<(Symbol, f64)>, JetError> {
        let g = &self.system.graph;
        let beyond = self.beyond();
        let conditions: Vec<&NamedExpr> = self
            .equations
            .conditions
            .iter()
            .filter(|c| g.contains_any(c.value, &beyond))
            .collect();
        let values: Vec<Expr> = conditions.iter().map(|c| c.value).collect();
        let gradient = g.jacobian(&values, &beyond).concat();
        let mut functions =
            self.functions(&beyond, &[("values", values), ("gradient", gradient)])?;
        let free: Vec<usize> = (0..beyond.len())
            .filter(|&i| self.given(beyond[i]).is_none())
            .collect();
        let start: Vec<f64> = beyond
            .iter()
            .map(|&s| self.given(s).unwrap_or(0.0))
            .collect();
        let (mut x, mut residual) = self.satisfied(&mut functions, start.clone(), &free)?;
        let tolerated = |x: &[f64]| 1e-9 * (1.0 + largest(x));
        if residual > tolerated(&x) && self.data.project {
            let all: Vec<usize> = (0..beyond.len()).collect();
            (x, residual) = self.satisfied(&mut functions, start, &all)?;
        }
        self.check_number(&beyond, &free, functions.group(1), conditions.len())?;
        if residual > tolerated(&x) || residual.is_nan() {
            return Err(self.contradicted(&beyond, &conditions, functions.group(0)));
        }
        Ok(beyond.into_iter().zip(x).collect())
    }

    /// Newton's method with the least change of the movable values; the point and its largest residual, at which
    /// `functions` stays evaluated.
    fn satisfied(
        &self,
        functions: &mut Functions,
        mut x: Vec<f64>,
        movable: &[usize],
    ) -> Result<(Vec<f64>, f64), JetError> {
        let (t, q, v) = self.at;
        let evaluate = |functions: &mut Functions, x: &[f64]| {
            let values = functions.evaluate(t, &[q, v, x]);
            values.map_err(|_| JetError::NotFinite {
                unknowns: self.texts(&self.beyond()),
            })
        };
        let metric = self.metric();
        for _ in 0..STEPS {
            evaluate(functions, &x)?;
            let (f, gradient) = (functions.group(0), functions.group(1));
            let step = least_step(gradient, f, x.len(), movable, &metric);
            x.iter_mut().zip(&step).for_each(|(x, dx)| *x -= dx);
            if largest(&step) <= 1e-15 * (1.0 + largest(&x)) {
                break;
            }
        }
        evaluate(functions, &x)?;
        Ok((x, largest(functions.group(0))))
    }

    /// What is given moves as little as it can, and what is free follows it.
    fn metric(&self) -> Vec<f64> {
        let beyond = self.beyond();
        let mut metric = identity(beyond.len());
        for (i, &symbol) in beyond.iter().enumerate() {
            if self.given(symbol).is_none() {
                metric[i * beyond.len() + i] = FREE;
            }
        }
        metric
    }

    fn contradicted(&self, beyond: &[Symbol], conditions: &[&NamedExpr], left: &[f64]) -> JetError {
        let violated: Vec<String> = left
            .iter()
            .zip(conditions)
            .filter(|(f, _)| f.abs() > 1e-9)
            .map(|(f, c)| format!("{} leaves {f:.3e}", c.meaning))
            .collect();
        let given = beyond.iter().filter(|&&s| self.given(s).is_some());
        JetError::Inconsistent {
            given: self.texts(&given.copied().collect::<Vec<_>>()),
            violated: violated.join(", "),
        }
    }

    /// As many data as the conditions leave free.
    fn check_number(
        &self,
        beyond: &[Symbol],
        free: &[usize],
        gradient: &[f64],
        rows: usize,
    ) -> Result<(), JetError> {
        let n = beyond.len();
        let columns = |kept: &[usize]| -> usize {
            let matrix: Vec<Vec<f64>> = (0..rows)
                .map(|row| kept.iter().map(|&i| gradient[row * n + i]).collect())
                .collect();
            rank(matrix)
        };
        let determined = columns(free);
        if determined >= free.len() {
            return Ok(());
        }
        let open: Vec<Symbol> = free
            .iter()
            .copied()
            .filter(|&i| {
                let others: Vec<usize> = free.iter().copied().filter(|&o| o != i).collect();
                columns(&others) == determined
            })
            .map(|i| beyond[i])
            .collect();
        Err(JetError::Missing {
            count: free.len() - determined,
            names: self.texts(&open),
        })
    }

    /// The derivatives of order m and the implicit unknowns.
    fn highest(&self, state: Vec<(Symbol, f64)>) -> Result<JetStart, JetError> {
        let (t, q, v) = self.at;
        let (symbols, values): (Vec<Symbol>, Vec<f64>) = state.iter().copied().unzip();
        let completed = state
            .iter()
            .filter(|(s, _)| self.given(*s).is_none())
            .map(|&(s, x)| (self.text(s), x))
            .collect();
        let jets: Vec<Symbol> = self.basis.terms.jets.iter().map(|c| c.v_symbol).collect();
        if self.equations.relations.is_empty() {
            let groups = [("highest", self.equations.highest.clone())];
            let mut functions = self.functions(&symbols, &groups)?;
            functions
                .evaluate(t, &[q, v, &values])
                .map_err(|_| JetError::Degenerate {
                    unknowns: self.texts(&jets),
                    hint: String::new(),
                })?;
            let highest: Vec<(Symbol, f64)> =
                jets.into_iter().zip(functions.group(0).to_vec()).collect();
            self.check_given(&highest)?;
            return Ok(JetStart {
                values: state.into_iter().chain(highest.iter().copied()).collect(),
                completed,
                unused: Vec::new(),
                branches: vec![Branch {
                    values: highest,
                    constraint_function: None,
                    kind: None,
                }],
                taken: 0,
                conditions: Vec::new(),
            });
        }
        let branches = self.branches(&state)?;
        let taken = self.choose(&branches)?;
        Ok(JetStart {
            values: state
                .into_iter()
                .chain(branches[taken].values.iter().copied())
                .collect(),
            completed,
            unused: Vec::new(),
            taken,
            branches,
            conditions: Vec::new(),
        })
    }

    /// Given highest derivatives of linear equations are those the equations give.
    fn check_given(&self, highest: &[(Symbol, f64)]) -> Result<(), JetError> {
        for &(symbol, value) in highest {
            let Some(given) = self.given(symbol) else {
                continue;
            };
            if (given - value).abs() > 1e-8 * (1.0 + value.abs()) {
                return Err(JetError::Inconsistent {
                    given: self.texts(&[symbol]),
                    violated: format!("the equations give {} = {value}", self.text(symbol)),
                });
            }
        }
        Ok(())
    }
}
