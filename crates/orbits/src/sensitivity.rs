//! Sensitivities of coordinates and velocities to parameters and to initial values, by their names in the model.
//!
//! The initial state depends on parameters too: what is given is a function of them, and the rest follows from the constraints. With the equations
//! `R(u, p) = 0` of the initial state u = (q, v), `R_u u_a = −R_a`, and `R_u u_ab` is minus the second derivative of R without u_ab.

use crate::error::OrbitError;
use crate::flow::{plain, Coordinates, Flow};
use crate::subspace::{decomposed, least_squares};
use crate::variational::{derivatives, variables, Column, Extended, Order, Symbols, Variational};
use chetaev_integrate::Output;
use chetaev_mechanics::{ConstraintKind, MotionTerms, Selection, System};
use chetaev_symbolic::{Expr, Graph, Symbol};
use nalgebra::{DMatrix, DVector};

/// Where a motion begins.
#[derive(Clone, Debug)]
pub struct Beginning {
    /// The time.
    pub t: f64,
    /// Coordinates and velocities with their values.
    pub point: Vec<(Symbol, f64)>,
    /// Those that are given, as functions of the parameters.
    pub given: Vec<(Symbol, Expr)>,
}

/// Coordinates and velocities with their derivatives, over the time.
#[derive(Clone, Debug)]
pub struct Sensitivities {
    /// What is differentiated: coordinates, then velocities.
    pub quantities: Vec<String>,
    /// By what.
    pub by: Vec<String>,
    /// Pairs of places in `by`, of the second derivatives.
    pub pairs: Vec<(usize, usize)>,
    /// For each time: the quantities, their first derivatives by each of `by`, and the second ones by each of `pairs`, one after the other.
    pub rows: Vec<(f64, Vec<f64>)>,
}

impl Sensitivities {
    /// Names of the columns: `x`, `d x/d a`, `d2 x/d a d b`.
    pub fn columns(&self) -> Vec<String> {
        let mut all = self.quantities.clone();
        for a in &self.by {
            all.extend(self.quantities.iter().map(|x| format!("d {x}/d {a}")));
        }
        for &(a, b) in &self.pairs {
            let (a, b) = (&self.by[a], &self.by[b]);
            all.extend(
                self.quantities
                    .iter()
                    .map(|x| format!("d2 {x}/d {a} d {b}")),
            );
        }
        all
    }
}

/// The sensitivities of a motion to parameters and initial values, at the times that `output` asks for. Where the independent velocities of the
/// start do not serve to the end all velocities are variables.
///
/// # Errors
/// [`OrbitError`].
pub fn sensitivities(
    system: &System,
    (terms, selection): (&MotionTerms, &Selection),
    beginning: &Beginning,
    asked: (&[String], Order),
    (end, output): (f64, Output),
) -> Result<Sensitivities, OrbitError> {
    let flow = Flow::of_system(
        system,
        terms,
        selection,
        (Coordinates::All, &beginning.point),
    )?;
    let of = (system, terms, selection);
    match of_flow(&flow, of, beginning, asked, (end, output.clone())) {
        Err(OrbitError::EndsEarly { .. }) => {
            let flow = Flow::in_all_velocities(system, terms, selection, Coordinates::All)?;
            of_flow(&flow, of, beginning, asked, (end, output))
        }
        other => other,
    }
}

fn of_flow(
    flow: &Flow,
    (system, terms, selection): (&System, &MotionTerms, &Selection),
    beginning: &Beginning,
    (by, order): (&[String], Order),
    (end, output): (f64, Output),
) -> Result<Sensitivities, OrbitError> {
    let g = &system.graph;
    let mut given = beginning.given.clone();
    let symbols: Vec<Symbol> = by
        .iter()
        .map(|name| varied(system, flow, &mut given, name))
        .collect::<Result<_, _>>()?;
    let columns: Vec<Column> = symbols.iter().map(|&s| Column::Parameter(s)).collect();
    let mut motion = Variational::new(flow, columns, order)?;
    let start = Start {
        system,
        flow,
        terms,
        selection,
        beginning,
        given,
    };
    let from = start.varied(&motion)?;
    let rows = motion.run((beginning.t, end), &from, output)?;
    let coordinates = system.coordinates.iter().map(|c| c.q);
    let quantities: Vec<Expr> = coordinates.chain(flow.velocities.iter().copied()).collect();
    let all = Symbols::new(g, ("varied", flow.n()), motion.columns.len(), &motion.pairs);
    let of = (&flow.variables[..], &all);
    let (first, second) = derivatives(g, &quantities, of, (&motion.columns, &motion.pairs));
    let mut binding = flow.binding();
    binding.variables = [vec![flow.time()], variables(flow, &all)].concat();
    let outputs = [quantities, first.concat(), second.concat()].concat();
    let groups = [("outputs", outputs)];
    let mut functions =
        chetaev_motion::functions::Functions::new(g, &binding, &binding.variables, &groups)?;
    let mut found = Vec::with_capacity(rows.len());
    for (t, own) in rows {
        functions.evaluate(t, &[&own.row()])?;
        found.push((t, functions.group(0).to_vec()));
    }
    let names = system.coordinates.iter();
    let rates = names.clone().map(|c| format!("{}'", c.name));
    Ok(Sensitivities {
        quantities: names.map(|c| c.name.clone()).chain(rates).collect(),
        by: by.to_vec(),
        pairs: motion.pairs.clone(),
        rows: found,
    })
}

/// The symbol that is varied: a parameter, or what is added to a given initial value.
fn varied(
    system: &System,
    flow: &Flow,
    given: &mut [(Symbol, Expr)],
    name: &str,
) -> Result<Symbol, OrbitError> {
    let g = &system.graph;
    let parameter = flow.parameters.iter().map(|own| own.0);
    if let Some(own) = parameter.clone().find(|&s| g.symbol_text(s) == name) {
        return Ok(own);
    }
    match given.iter_mut().find(|(s, _)| g.symbol_text(*s) == name) {
        Some((_, value)) => {
            // No name of a model contains a space.
            let shift = g.intern_symbol(&format!("shift of {name}"), 0);
            *value = g.add(&[*value, g.symbol_expr(shift)]);
            Ok(shift)
        }
        None => Err(OrbitError::UnknownVariation {
            name: name.into(),
            known: parameter
                .chain(given.iter().map(|own| own.0))
                .map(|s| g.symbol_text(s))
                .collect(),
        }),
    }
}

/// The equations of the initial state.
struct Start<'a> {
    system: &'a System,
    flow: &'a Flow,
    terms: &'a MotionTerms,
    selection: &'a Selection,
    beginning: &'a Beginning,
    given: Vec<(Symbol, Expr)>,
}

/// What is left undetermined: singular values below this part of the largest.
const UNDETERMINED: f64 = 1e-9;

impl Start<'_> {
    fn jet(&self) -> Vec<Symbol> {
        let symbols = self.system.coordinate_symbols();
        [symbols, self.system.velocity_symbols()].concat()
    }

    /// R: what is given, the constraints, and that what neither gives nor contains stays.
    fn equations(&self) -> Vec<Expr> {
        let (g, system) = (&self.system.graph, self.system);
        let rows = self.selection.rows.iter();
        let mut all: Vec<Expr> = rows
            .clone()
            .map(|&row| self.terms.constraints[row])
            .collect();
        let stated = rows.map(|&row| &system.constraints[self.terms.constraint_index[row]]);
        let finite = stated.filter(|own| own.kind == ConstraintKind::Holonomic);
        all.extend(finite.map(|own| own.stated));
        let all = plain(system, &all);
        let free = self.jet().into_iter();
        let free = free.filter(|s| !self.given.iter().any(|(own, _)| own == s));
        let free = free.filter(|&s| !g.any_contains_any(&all, &[s]));
        let value = |s: Symbol| {
            let own = self.beginning.point.iter().find(|(own, _)| *own == s);
            own.and_then(|own| chetaev_symbolic::Rational::try_from(own.1).ok())
        };
        let free = free.map(|s| (s, value(s).map_or(g.zero(), |x| g.number(x))));
        let given = self.given.iter().copied().chain(free);
        let given: Vec<Expr> = given.map(|(s, e)| g.sub(g.symbol_expr(s), e)).collect();
        [plain(system, &given), all].concat()
    }

    /// The extended state at the start.
    fn varied(&self, motion: &Variational) -> Result<Extended, OrbitError> {
        let g = &self.system.graph;
        let jet = self.jet();
        let equations = self.equations();
        let count = motion.columns.len();
        let symbols = Symbols::new(g, ("initial", jet.len()), count, &motion.pairs);
        let both = (&motion.columns[..], &motion.pairs[..]);
        let of = (&jet[..], &symbols);
        let (first, second) = derivatives(g, &equations, of, both);
        let mut numbers = Numbers {
            g,
            known: [self.beginning.point.clone(), self.flow.parameters.clone()].concat(),
            t: (self.flow.time(), self.beginning.t),
        };
        let matrix = g.jacobian(&equations, &jet).concat();
        let matrix = numbers.values(&matrix)?;
        let matrix = DMatrix::from_row_slice(equations.len(), jet.len(), &matrix);
        self.check_determined(&matrix, &jet)?;
        let unknown = symbols.first.iter().zip(&first);
        for (own, row) in unknown.chain(symbols.second.iter().zip(&second)) {
            // Without the derivative itself, which is a factor of the matrix.
            numbers.set(own, &vec![0.0; own.len()]);
            let rest = DVector::from_vec(numbers.values(row)?);
            let found = least_squares(&matrix, &-rest, UNDETERMINED);
            let found = found.ok_or(OrbitError::NoEigenvalues)?;
            numbers.set(own, found.as_slice());
        }
        let (first, second) = derivatives(g, &self.flow.definitions, of, both);
        let n = self.flow.n();
        let first = numbers.values(&first.concat())?;
        let second = numbers.values(&second.concat())?;
        Ok(Extended {
            state: self.flow.state(&self.beginning.point)?,
            first: DMatrix::from_column_slice(n, count, &first),
            second: DMatrix::from_column_slice(n, motion.pairs.len(), &second),
        })
    }

    fn check_determined(&self, matrix: &DMatrix<f64>, jet: &[Symbol]) -> Result<(), OrbitError> {
        let g = &self.system.graph;
        let found = decomposed(matrix).ok_or(OrbitError::NoEigenvalues)?;
        let limit = UNDETERMINED * found.s[0];
        let loose = (0..jet.len()).filter(|&i| {
            let mut directions = found.s.iter().zip(found.v.column_iter());
            directions.any(|(s, v)| *s <= limit && v[i].abs() > 1e-6)
        });
        let names: Vec<String> = loose.map(|i| g.symbol_text(jet[i])).collect();
        if names.is_empty() {
            Ok(())
        } else {
            let names = names.join(", ");
            Err(OrbitError::NotDetermined { names })
        }
    }
}

/// Values of symbols.
struct Numbers<'a> {
    g: &'a Graph,
    known: Vec<(Symbol, f64)>,
    t: (Symbol, f64),
}

impl Numbers<'_> {
    fn set(&mut self, symbols: &[Symbol], values: &[f64]) {
        self.known.retain(|(s, _)| !symbols.contains(s));
        self.known
            .extend(symbols.iter().copied().zip(values.iter().copied()));
    }

    fn values(&self, es: &[Expr]) -> Result<Vec<f64>, OrbitError> {
        let value = |s: Symbol| {
            let mut all = self.known.iter().chain([&self.t]);
            // What is added to initial values is zero.
            all.find(|(own, _)| *own == s)
                .map_or(Some(0.0), |own| Some(own.1))
        };
        let found = self.g.evaluate_f64(es, &value);
        found.map_err(|_| OrbitError::NoValue {
            name: "the initial state".into(),
        })
    }
}
