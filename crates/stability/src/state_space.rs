//! The linear equations as control theory writes them: `z' = A z + B u`, `y = C z + D u`, and their transfer functions.

use crate::expansion::Expansion;
use crate::growth::flattened;
use crate::linearization::Linearization;
use crate::multiplicity::product;
use crate::steady::{closed, echelon};
use chetaev_mechanics::redundancy::Reactions;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::matrix::{determinant, inverse};
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// Bits with which it is seen whether a number has a value.
const BITS: usize = 128;

/// Larger systems have no transfer functions in closed form.
const LARGEST: usize = 10;

/// A, B, C, D, exact in the parameters that were left in.
#[derive(Clone, Debug)]
pub struct StateSpace {
    /// The names of z.
    pub states: Vec<String>,
    /// The names of u: controls of the model and the derivatives of them that occur, deviations from their values along the motion.
    pub inputs: Vec<String>,
    /// The names of y.
    pub outputs: Vec<String>,
    /// A, row by row.
    pub a: Vec<Vec<Expr>>,
    /// B.
    pub b: Vec<Vec<Expr>>,
    /// C.
    pub c: Vec<Vec<Expr>>,
    /// D.
    pub d: Vec<Vec<Expr>>,
}

/// Why there is no such form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateSpaceError {
    /// An output that has no derivative at the motion.
    #[error(
        "the output `{name}` has no derivative at the motion, so that it has no linear form there"
    )]
    NotSmooth {
        /// The output.
        name: String,
    },
    /// An output contains a multiplier that the motion does not determine.
    #[error("the multiplier `{multiplier}` in an output is not determined: constraints that follow from each other share their reactions")]
    Undetermined {
        /// The multiplier.
        multiplier: String,
    },
    /// The mass matrix is singular at the motion.
    #[error("the mass matrix is singular at the motion: {0}")]
    SingularMass(#[from] SolveError),
    /// An output that is no function of the variables.
    #[error("the output `{name}` depends on `{coordinate}`, which is none of the independent variables {variables}; in all variables, by --all, it is one")]
    NoOutput {
        /// The output.
        name: String,
        /// What it depends on.
        coordinate: String,
        /// The variables.
        variables: String,
    },
}

impl Expansion<'_> {
    /// The form in state space with outputs as functions of coordinates, velocities, accelerations, controls and multipliers; without any the
    /// variables are the outputs. Accelerations and multipliers are those of the equations of motion, so that they add to C and to D.
    ///
    /// # Errors
    /// [`StateSpaceError`].
    pub fn state_space(
        &self,
        linear: &Linearization,
        outputs: &[(String, Expr)],
    ) -> Result<StateSpace, StateSpaceError> {
        let g = self.graph();
        let stated: Vec<Expr> = outputs.iter().map(|(_, e)| *e).collect();
        let stated = self.on_motion(&stated)?;
        let inputs = self.inputs(&stated);
        let inverse = self.inverse(linear)?;
        let direct = self.by_inputs(&inputs);
        let mut found = StateSpace {
            states: linear.names.clone(),
            inputs: inputs.iter().map(|&s| g.symbol_text(s)).collect(),
            outputs: outputs.iter().map(|(name, _)| name.clone()).collect(),
            a: product(g, &inverse, &linear.right),
            b: product(g, &inverse, &direct),
            c: Vec::new(),
            d: Vec::new(),
        };
        for ((name, _), own) in outputs.iter().zip(stated) {
            let (row, by) = self.output(&found, name, own, &inputs)?;
            found.c.push(row);
            found.d.push(by);
        }
        if outputs.is_empty() {
            found.show_states(g);
        }
        Ok(found)
    }

    /// E⁻¹; only the mass matrix in it is no unit matrix.
    fn inverse(&self, linear: &Linearization) -> Result<Vec<Vec<Expr>>, SolveError> {
        let g = self.graph();
        let (size, k) = (linear.names.len(), self.own.characteristics.k());
        let first = size - k;
        let mass: Vec<Vec<Expr>> = linear.left[first..]
            .iter()
            .map(|row| row[first..].to_vec())
            .collect();
        let of_mass = match inverse_of_numbers(g, &mass) {
            Some(found) => found,
            None => inverse(g, &mass)?,
        };
        let entry = |r: usize, c: usize| match (r.checked_sub(first), c.checked_sub(first)) {
            (Some(r), Some(c)) => closed(g, of_mass[r][c]),
            (None, None) if r == c => g.one(),
            _ => g.zero(),
        };
        Ok((0..size)
            .map(|r| (0..size).map(|c| entry(r, c)).collect())
            .collect())
    }

    /// The controls and derivatives of controls that occur in the equations of motion or in outputs.
    fn inputs(&self, outputs: &[Expr]) -> Vec<Symbol> {
        let mut all = [self.own.rates.clone(), self.own.equations.force.clone()].concat();
        all.extend(outputs);
        self.inputs_of(&all)
    }

    /// Outputs as functions of coordinates, independent velocities and their rates, and controls: multipliers are solved for from the equations of
    /// as many coordinates.
    fn on_motion(&self, outputs: &[Expr]) -> Result<Vec<Expr>, StateSpaceError> {
        let (g, selection) = (self.graph(), self.selection);
        self.are_determined(outputs)?;
        let names: Vec<Expr> = selection
            .rows
            .iter()
            .map(|&row| self.multiplier(row))
            .collect();
        let symbols: Vec<Symbol> = names.iter().filter_map(|&e| g.as_symbol(e)).collect();
        let mut outputs = outputs.to_vec();
        if g.any_contains_any(&outputs, &symbols) {
            let multipliers = self.multipliers_of_state()?;
            let pairs: Vec<(Expr, Expr)> = names.into_iter().zip(multipliers).collect();
            outputs = g.substitute_all(&outputs, &pairs);
        }
        Ok(self.own.characteristics.on_jet(self.system, &outputs))
    }

    /// The multiplier of a constraint, by its row.
    pub(crate) fn multiplier(&self, row: usize) -> Expr {
        let own = &self.system.constraints[self.terms.constraint_index[row]];
        self.graph().symbol(&format!("lambda_{}", own.name), 0)
    }

    /// Whether the motion determines all multipliers in outputs.
    pub(crate) fn are_determined(&self, outputs: &[Expr]) -> Result<(), StateSpaceError> {
        let g = self.graph();
        let occurring = g.symbols_in(outputs);
        let reactions = Reactions::of(self.system, self.terms, self.selection);
        let mut open = reactions.undetermined.iter();
        let own = open.find_map(|&row| {
            let symbol = g.as_symbol(self.multiplier(row))?;
            occurring.contains(&symbol).then(|| g.symbol_text(symbol))
        });
        match own {
            Some(multiplier) => Err(StateSpaceError::Undetermined { multiplier }),
            None => Ok(()),
        }
    }

    /// λ with `Jᵀλ = W a − Q`, of as many equations as there are: `J Jᵀ λ = J (W a − Q)`, which is regular wherever the gradients are independent.
    fn multipliers_of_state(&self) -> Result<Vec<Expr>, SolveError> {
        let (g, terms, rows) = (self.graph(), self.terms, &self.selection.rows);
        let accelerations: Vec<Expr> = self.system.coordinates.iter().map(|c| c.a).collect();
        let dot = |a: &[Expr], b: &[Expr]| {
            let products: Vec<Expr> = a.iter().zip(b).map(|(&a, &b)| g.mul(&[a, b])).collect();
            g.add(&products)
        };
        let inertia = terms.mass_matrix.iter().map(|row| dot(row, &accelerations));
        let reactions = inertia.zip(&terms.force).map(|(w, &q)| g.sub(w, q));
        let reactions: Vec<Expr> = reactions.collect();
        let gradient = |row: &usize| &terms.jacobian[*row][..];
        let pairs = rows.iter().flat_map(|a| rows.iter().map(move |b| (a, b)));
        let matrix = pairs.map(|(a, b)| dot(gradient(a), gradient(b)));
        let matrix: Vec<Expr> = matrix.collect();
        let right: Vec<Expr> = rows
            .iter()
            .map(|row| dot(gradient(row), &reactions))
            .collect();
        g.solve(&matrix, &right)
    }

    /// The controls and derivatives of controls that occur in expressions.
    pub(crate) fn inputs_of(&self, all: &[Expr]) -> Vec<Symbol> {
        let g = self.graph();
        let occurring = g.symbols_in(all);
        let mut found = Vec::new();
        for control in &self.system.controls {
            let mut own: Vec<Symbol> = occurring
                .iter()
                .copied()
                .filter(|&s| g.symbol_name(s) == control.name)
                .collect();
            own.sort_by_key(|&s| g.symbol_order(s));
            found.extend(own);
        }
        found
    }

    /// The derivatives of the rates and of b by the inputs at the motion, for the independent variables.
    fn by_inputs(&self, inputs: &[Symbol]) -> Vec<Vec<Expr>> {
        let g = self.graph();
        let kept = self.reduction().kept;
        let rates = kept.iter().map(|&at| self.own.rates[at]);
        let rows: Vec<Expr> = rates
            .chain(self.own.equations.force.iter().copied())
            .collect();
        let rows = self.flat(&rows, 1).functions;
        self.at_rows(&g.jacobian(&rows, inputs))
    }

    /// The rows of C and D of an output; what the rates of the speeds add, which vanish along the motion, goes through A and B.
    fn output(
        &self,
        space: &StateSpace,
        name: &str,
        own: Expr,
        inputs: &[Symbol],
    ) -> Result<(Vec<Expr>, Vec<Expr>), StateSpaceError> {
        let g = self.graph();
        let no_output = |coordinate: String| StateSpaceError::NoOutput {
            name: name.into(),
            coordinate,
            variables: space.states.join(", "),
        };
        let Some(own) = self.without_ignorable(own) else {
            let ignorable = self.own.ignorable(self.system).into_iter();
            let mut occurring =
                ignorable.filter(|&j| g.contains_any(own, &[self.system.coordinates[j].q_symbol]));
            let first = occurring
                .next()
                .map(|j| self.system.coordinates[j].name.clone());
            return Err(no_output(first.unwrap_or_else(|| "t".into())));
        };
        let speeds = self.own.characteristics.parameters.iter();
        let rates: Vec<Expr> = speeds.map(|own| own.rate).collect();
        let symbols: Vec<Symbol> = rates.iter().filter_map(|&e| g.as_symbol(e)).collect();
        let still: Vec<(Expr, Expr)> = rates.iter().map(|&rate| (rate, g.zero())).collect();
        let own = self.with_slopes(name, own, &still)?;
        let by_rates = g.substitute_all(&g.gradient(own, &symbols), &still);
        let by_rates = self.at(&by_rates);
        let own = g.substitute(own, &still);
        let row = self.at(&self.derivatives(own));
        let mut row = self.reduced(&self.reduction(), &row);
        let mut by = self.at(&g.gradient(own, inputs));
        let entries = [row.clone(), by.clone(), by_rates.clone()].concat();
        if !entries.iter().all(|&e| has_value(g, e)) {
            return Err(StateSpaceError::NotSmooth { name: name.into() });
        }
        let first = space.states.len() - by_rates.len();
        for (at, &weight) in by_rates.iter().enumerate() {
            for (sums, parts) in [(&mut row, &space.a), (&mut by, &space.b)] {
                for (sum, &part) in sums.iter_mut().zip(&parts[first + at]) {
                    *sum = closed(g, g.add(&[*sum, g.mul(&[weight, part])]));
                }
            }
        }
        Ok((row, by))
    }
}

impl Expansion<'_> {
    /// An output without what has the slope 0 beside the motion; `known` are the values of what no motion gives.
    ///
    /// # Errors
    /// [`StateSpaceError::NotSmooth`] where it has a corner at the motion.
    pub(crate) fn with_slopes(
        &self,
        name: &str,
        output: Expr,
        known: &[(Expr, Expr)],
    ) -> Result<Expr, StateSpaceError> {
        let g = self.graph();
        let vanishes = |e: Expr| self.vanishes(g.substitute(e, known));
        let flat = flattened(g, &[output], 1, &vanishes);
        match (flat.corner, &flat.functions[..]) {
            (None, &[own]) => Ok(own),
            _ => Err(StateSpaceError::NotSmooth { name: name.into() }),
        }
    }
}

/// Whether an expression has a value: it contains parameters, or it is a number.
fn has_value(g: &Graph, e: Expr) -> bool {
    let precision = Precision::new(BITS);
    !g.symbols_in(&[e]).is_empty() || g.enclose(&[e], &precision, &|_| None).is_ok()
}

/// The inverse of a matrix of numbers, by one elimination; `None` where an entry is none, or the matrix is singular.
fn inverse_of_numbers(g: &Graph, matrix: &[Vec<Expr>]) -> Option<Vec<Vec<Expr>>> {
    let n = matrix.len();
    if matrix.iter().flatten().any(|&e| g.as_number(e).is_none()) {
        return None;
    }
    let unit = |r: usize, c: usize| if r == c { g.one() } else { g.zero() };
    let beside = |(r, row): (usize, &Vec<Expr>)| -> Vec<Expr> {
        row.iter()
            .copied()
            .chain((0..n).map(|c| unit(r, c)))
            .collect()
    };
    let mut rows: Vec<Vec<Expr>> = matrix.iter().enumerate().map(beside).collect();
    let columns = echelon(g, &mut rows, n).columns;
    // The row with a one in a column says what its unknown is.
    let row = |column: usize| {
        let at = columns.iter().position(|&own| own == column)?;
        Some(rows[at][n..].to_vec())
    };
    (0..n).map(row).collect()
}

/// The symbol s of transfer functions.
fn s(g: &Graph) -> Symbol {
    g.intern_symbol("s", 0)
}

impl StateSpace {
    /// Makes the states the outputs.
    pub(crate) fn show_states(&mut self, g: &Graph) {
        let size = self.states.len();
        let unit = |r: usize| {
            (0..size)
                .map(|c| if r == c { g.one() } else { g.zero() })
                .collect()
        };
        self.outputs.clone_from(&self.states);
        self.c = (0..size).map(unit).collect();
        self.d = vec![vec![g.zero(); self.inputs.len()]; size];
    }

    /// The controls among the inputs: of one that occurs with its derivatives they are inputs too, of the same control.
    pub fn controls(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for input in &self.inputs {
            let name = input.trim_end_matches('\'');
            if !names.iter().any(|own| own == name) {
                names.push(name.to_owned());
            }
        }
        names
    }

    /// The transfer functions from each control (column) to each output (row), rational functions of `s`; `None` where the system is large. The
    /// k-th derivative of a control is s^k times it.
    pub fn transfer(&self, g: &Graph) -> Option<Vec<Vec<Expr>>> {
        let by_inputs = self.transfer_of_inputs(g)?;
        let s = g.symbol_expr(s(g));
        let of = |row: &[Expr], name: &String| {
            let terms = self.inputs.iter().zip(row).filter_map(|(input, &e)| {
                let primes = input.strip_prefix(name.as_str())?;
                let order = primes.chars().all(|c| c == '\'').then_some(primes.len())?;
                Some(g.mul(&[g.powi(s, order as i64), e]))
            });
            closed(g, g.add(&terms.collect::<Vec<Expr>>()))
        };
        let controls = self.controls();
        let row = |row: &Vec<Expr>| controls.iter().map(|name| of(row, name)).collect();
        Some(by_inputs.iter().map(row).collect())
    }

    fn transfer_of_inputs(&self, g: &Graph) -> Option<Vec<Vec<Expr>>> {
        let n = self.states.len();
        if n > LARGEST {
            return None;
        }
        let s = g.symbol_expr(s(g));
        let resolvent = |r: usize, c: usize| {
            if r == c {
                g.sub(s, self.a[r][c])
            } else {
                g.neg(self.a[r][c])
            }
        };
        let square: Vec<Vec<Expr>> = (0..n)
            .map(|r| (0..n).map(|c| resolvent(r, c)).collect())
            .collect();
        let below = determinant(g, &square);
        let entry = |output: usize, input: usize| {
            let mut bordered = square.clone();
            for (row, own) in bordered.iter_mut().zip(&self.b) {
                row.push(g.neg(own[input]));
            }
            let last = self.c[output]
                .iter()
                .copied()
                .chain([self.d[output][input]]);
            bordered.push(last.collect());
            closed(g, g.div(determinant(g, &bordered), below))
        };
        let rows = 0..self.outputs.len();
        Some(
            rows.map(|output| {
                (0..self.inputs.len())
                    .map(|input| entry(output, input))
                    .collect()
            })
            .collect(),
        )
    }

    /// The rank of Kalman's matrix `(B, A B, …)` is the dimension of what the inputs reach, that of its transpose with C of what the outputs
    /// show: both exact for general values of the parameters that were left in.
    pub fn ranks(&self, g: &Graph) -> (usize, usize) {
        let transposed = |m: &[Vec<Expr>], columns: usize| -> Vec<Vec<Expr>> {
            (0..columns)
                .map(|c| m.iter().map(|row| row[c]).collect())
                .collect()
        };
        let n = self.states.len();
        let reached = krylov_rank(g, &self.a, &transposed(&self.b, self.inputs.len()));
        let seen = krylov_rank(g, &transposed(&self.a, n), &self.c);
        (reached, seen)
    }
}

/// The dimension of the smallest subspace that holds some vectors and their images under a matrix.
fn krylov_rank(g: &Graph, matrix: &[Vec<Expr>], vectors: &[Vec<Expr>]) -> usize {
    let n = matrix.len();
    let mut rows: Vec<Vec<Expr>> = Vec::new();
    let mut last = vectors.to_vec();
    for _ in 0..n {
        rows.extend(last.iter().cloned());
        let image = |v: &Vec<Expr>| -> Vec<Expr> {
            let entry = |row: &Vec<Expr>| {
                let terms: Vec<Expr> = row.iter().zip(v).map(|(&a, &x)| g.mul(&[a, x])).collect();
                closed(g, g.add(&terms))
            };
            matrix.iter().map(entry).collect()
        };
        last = last.iter().map(image).collect();
    }
    let (kernel, _) = crate::steady::kernel(g, &rows, n);
    n - kernel.len()
}
