//! Initial data beyond coordinates and velocities for constraints of order m ≥ 2 (T2 §5): higher derivatives, multipliers that
//! are variables of the state, and the branch where the constraints are nonlinear in the highest derivatives.

use super::forms::{is_singular, kind, rank};
use crate::dense::Lu;
use crate::functions::{Functions, FunctionsError};
use crate::least_norm::{identity, least_step};
use crate::numeric::Binding;
use chetaev_mechanics::formulations::{DeriveError, Routh};
use chetaev_mechanics::sample::Generator;
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

/// A state on the jet that satisfies constraints and equations of motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JetStart {
    /// Derivatives of orders 2..m and the multipliers in the state, by symbol.
    pub values: Vec<(Symbol, f64)>,
    /// Names of what was completed, with the values found.
    pub completed: Vec<(String, f64)>,
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

/// How many starting points a search for branches has.
const STARTS: usize = 400;
const STEPS: usize = 80;
/// Solutions nearer than this to each other, relative to their size, are one.
const SAME: f64 = 1e-6;

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
    let stated: Vec<Expr> = basis.system.constraints.iter().map(|c| c.stated).collect();
    let conditions = equations.conditions.iter();
    start.conditions = conditions
        .filter(|c| !stated.contains(&c.value))
        .map(|c| (c.name.clone(), c.value))
        .collect();
    Ok(start)
}

struct Search<'a> {
    system: &'a System,
    basis: &'a Basis<'a>,
    binding: &'a Binding,
    equations: &'a Equations,
    at: (f64, &'a [f64], &'a [f64]),
    data: &'a JetData,
}

impl Search<'_> {
    fn text(&self, symbol: Symbol) -> String {
        self.system.graph.symbol_text(symbol)
    }

    fn texts(&self, symbols: &[Symbol]) -> String {
        let names = symbols.iter().map(|&s| self.text(s));
        chetaev_mechanics::words::quoted(names)
    }

    fn given(&self, symbol: Symbol) -> Option<f64> {
        let found = self.data.given.iter().find(|(own, _)| *own == symbol);
        found.map(|(_, value)| *value)
    }

    /// The unknowns that stay implicit.
    fn implicit(&self) -> Vec<Symbol> {
        self.equations.relations.iter().map(|(_, s)| *s).collect()
    }

    /// Variables beyond (q, v) that are no implicit unknowns.
    fn beyond(&self) -> Vec<Symbol> {
        let implicit = self.implicit();
        let own = self.equations.variables.iter().map(|x| x.symbol);
        own.filter(|s| !implicit.contains(s) && !self.binding.variables.contains(s))
            .collect()
    }

    fn functions(
        &self,
        further: &[Symbol],
        groups: &[(&str, Vec<Expr>)],
    ) -> Result<Functions, FunctionsError> {
        let variables = [&self.binding.variables[..], further].concat();
        Functions::new(&self.system.graph, self.binding, &variables, groups)
    }

    /// The variables beyond (q, v) from what is given and the conditions on them.
    fn conditions(&self) -> Result<Vec<(Symbol, f64)>, JetError> {
        let (t, q, v) = self.at;
        let g = &self.system.graph;
        let beyond = self.beyond();
        let conditions: Vec<&chetaev_mechanics::equations::NamedExpr> = self
            .equations
            .conditions
            .iter()
            .filter(|c| g.contains_any(c.value, &beyond))
            .collect();
        let values: Vec<Expr> = conditions.iter().map(|c| c.value).collect();
        let gradient = g.jacobian(&values, &beyond).concat();
        let mut functions =
            self.functions(&beyond, &[("values", values), ("gradient", gradient)])?;
        let fixed: Vec<bool> = beyond.iter().map(|&s| self.given(s).is_some()).collect();
        let free: Vec<usize> = (0..beyond.len()).filter(|&i| !fixed[i]).collect();
        let not_finite = || JetError::NotFinite {
            unknowns: self.texts(&beyond),
        };
        let start: Vec<f64> = beyond
            .iter()
            .map(|&s| self.given(s).unwrap_or(0.0))
            .collect();
        let mut newton = |x: &mut Vec<f64>, movable: &[usize]| -> Result<f64, JetError> {
            let mut residual = f64::INFINITY;
            for _ in 0..STEPS {
                functions
                    .evaluate(t, &[q, v, x])
                    .map_err(|_| not_finite())?;
                let f = functions.group(0).to_vec();
                residual = f.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
                let step = least_step(functions.group(1), &f, x.len(), movable, &identity(x.len()));
                x.iter_mut().zip(&step).for_each(|(x, dx)| *x -= dx);
                let size = step.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
                if size <= 1e-15 * (1.0 + largest(x)) {
                    break;
                }
            }
            Ok(residual)
        };
        let mut x = start.clone();
        let mut residual = newton(&mut x, &free)?;
        if residual > 1e-9 * (1.0 + largest(&x)) && self.data.project {
            let all: Vec<usize> = (0..beyond.len()).collect();
            x.clone_from(&start);
            residual = newton(&mut x, &all)?;
        }
        functions
            .evaluate(t, &[q, v, &x])
            .map_err(|_| not_finite())?;
        self.check_number(&beyond, &free, functions.group(1), conditions.len())?;
        if residual > 1e-9 * (1.0 + largest(&x)) || residual.is_nan() {
            let values = functions.group(0).iter().zip(&conditions);
            let violated: Vec<String> = values
                .filter(|(f, _)| f.abs() > 1e-9)
                .map(|(f, c)| format!("{} leaves {f:.3e}", c.meaning))
                .collect();
            let given = beyond.iter().zip(&fixed).filter(|(_, &fixed)| fixed);
            return Err(JetError::Inconsistent {
                given: self.texts(&given.map(|(&s, _)| s).collect::<Vec<_>>()),
                violated: violated.join(", "),
            });
        }
        Ok(beyond.into_iter().zip(x).collect())
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

    /// All real solutions that a search from many starting points finds, least constraint first.
    fn branches(&self, state: &[(Symbol, f64)]) -> Result<Vec<Branch>, JetError> {
        let (t, q, v) = self.at;
        let g = &self.system.graph;
        let (symbols, known): (Vec<Symbol>, Vec<f64>) = state.iter().copied().unzip();
        let unknowns = self.implicit();
        let size = unknowns.len();
        let values: Vec<Expr> = self.equations.relations.iter().map(|(f, _)| *f).collect();
        let jacobian = g.jacobian(&values, &unknowns).concat();
        let further = [&symbols[..], &unknowns[..]].concat();
        let groups = [("values", values), ("jacobian", jacobian)];
        let mut functions = self.functions(&further, &groups)?;
        let mut generator = Generator::new(7);
        let mut found: Vec<Vec<f64>> = Vec::new();
        let mut best = f64::INFINITY;
        let mut degenerate = 0;
        for start in 0..STARTS {
            let reach = 10f64.powi((start % 5) as i32 - 1);
            let x: Vec<f64> = (0..size)
                .map(|_| generator.between(-reach, reach))
                .collect();
            let Some((x, residual)) = newton(&mut functions, (t, q, v, &known), x, size) else {
                continue;
            };
            best = best.min(residual);
            if residual > 1e-10 * (1.0 + largest(&x)) {
                continue;
            }
            if functions.evaluate(t, &[q, v, &known, &x]).is_err() {
                continue;
            }
            if is_singular(functions.group(1), size) {
                degenerate += 1;
                continue;
            }
            let distance = |other: &Vec<f64>| {
                let pairs = other.iter().zip(&x);
                pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
            };
            if found
                .iter()
                .all(|other| distance(other) > SAME * (1.0 + largest(&x)))
            {
                found.push(x);
            }
        }
        if found.is_empty() {
            return Err(match degenerate {
                0 => JetError::NoRealSolution {
                    unknowns: self.texts(&unknowns),
                    residual: best,
                    starts: STARTS,
                },
                _ => JetError::Degenerate {
                    unknowns: self.texts(&unknowns),
                    hint: ", so that the motion could go on in more than one way; another initial state or a force that is not zero there determines it".into(),
                },
            });
        }
        let mut branches = Vec::new();
        for x in found {
            branches.push(self.branch(state, unknowns.iter().copied().zip(x).collect())?);
        }
        let key = |b: &Branch| b.constraint_function.unwrap_or(f64::INFINITY);
        let order = |a: &Branch, b: &Branch| {
            let values =
                |branch: &Branch| -> Vec<f64> { branch.values.iter().map(|(_, x)| -x).collect() };
            let close = (key(a) - key(b)).abs() <= 1e-9 * (key(a).abs() + key(b).abs());
            match close {
                true => values(a).partial_cmp(&values(b)),
                false => key(a).partial_cmp(&key(b)),
            }
            .unwrap_or(std::cmp::Ordering::Equal)
        };
        branches.sort_by(order);
        Ok(branches)
    }

    /// Gauss's function and its kind at a solution.
    fn branch(
        &self,
        state: &[(Symbol, f64)],
        values: Vec<(Symbol, f64)>,
    ) -> Result<Branch, JetError> {
        let (t, q, v) = self.at;
        let (system, terms, g) = (self.system, self.basis.terms, &self.system.graph);
        let n = system.n();
        let all = [state, &values[..]].concat();
        let (symbols, numbers): (Vec<Symbol>, Vec<f64>) = all.into_iter().unzip();
        let w = system.motion_left_sides();
        let jets: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
        let balance: Vec<Expr> = self
            .equations
            .relations
            .iter()
            .take(n)
            .map(|(f, _)| *f)
            .collect();
        let rows = self.basis.selection.rows.iter();
        let gradient: Vec<Expr> = rows.flat_map(|&row| terms.jacobian[row].clone()).collect();
        let groups = [
            ("w", w),
            ("mass", terms.mass_matrix.concat()),
            ("form", g.jacobian(&balance, &jets).concat()),
            ("gradient", gradient),
        ];
        let mut functions = self.functions(&symbols, &groups)?;
        let mut branch = Branch {
            values,
            constraint_function: None,
            kind: None,
        };
        if functions.evaluate(t, &[q, v, &numbers]).is_err() {
            return Ok(branch);
        }
        let mut lu = Lu::default();
        if lu.factor(n, functions.group(1)).is_ok() {
            let mut x = functions.group(0).to_vec();
            lu.solve(&mut x);
            let pairs = x.iter().zip(functions.group(0));
            branch.constraint_function = Some(pairs.map(|(a, b)| 0.5 * a * b).sum());
        }
        if terms.order == 2 {
            branch.kind = kind(functions.group(2), functions.group(3), n);
        }
        Ok(branch)
    }

    fn choose(&self, branches: &[Branch]) -> Result<usize, JetError> {
        let listed = || -> Vec<String> {
            let numbered = branches.iter().enumerate();
            numbered.map(|(i, b)| describe(self.system, i, b)).collect()
        };
        let jets: Vec<Symbol> = self.basis.terms.jets.iter().map(|c| c.v_symbol).collect();
        let given: Vec<(Symbol, f64)> = jets
            .iter()
            .filter_map(|&s| Some((s, self.given(s)?)))
            .collect();
        if !given.is_empty() {
            let fits = |branch: &&Branch| {
                given.iter().all(|(symbol, value)| {
                    let own = branch.values.iter().find(|(s, _)| s == symbol);
                    own.is_some_and(|(_, x)| (x - value).abs() <= 1e-6 * (1.0 + x.abs()))
                })
            };
            let fitting: Vec<&Branch> = branches.iter().filter(fits).collect();
            let position = branches.iter().position(|b| fitting.first() == Some(&b));
            return match (fitting.len(), position) {
                (1, Some(position)) => Ok(position),
                (0, _) | (_, None) => Err(JetError::NotOnABranch {
                    given: self.texts(&given.iter().map(|(s, _)| *s).collect::<Vec<_>>()),
                    branches: listed(),
                }),
                _ => Err(JetError::Choose { branches: listed() }),
            };
        }
        if let Some(wanted) = self.data.branch {
            return match wanted {
                0 => None,
                wanted => (wanted <= branches.len()).then(|| wanted - 1),
            }
            .ok_or_else(|| JetError::NoSuchBranch {
                wanted,
                branches: listed(),
            });
        }
        match branches {
            [_] => Ok(0),
            [first, second, ..] => match (first.constraint_function, second.constraint_function) {
                (Some(a), Some(b))
                    if a < b - 1e-9 * (a.abs() + b.abs()) && first.kind == Some("minimum") =>
                {
                    Ok(0)
                }
                _ => Err(JetError::Choose { branches: listed() }),
            },
            [] => Err(JetError::NoRealSolution {
                unknowns: self.texts(&jets),
                residual: f64::NAN,
                starts: STARTS,
            }),
        }
    }
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

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, x| m.max(x.abs()))
}
