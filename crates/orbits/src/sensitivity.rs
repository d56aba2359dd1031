//! Sensitivities of coordinates and velocities to parameters and to initial values, by their names in the model.
//!
//! The initial state depends on parameters too ([`crate::beginning`]).

use crate::beginning::{Beginning, Start};
use crate::error::OrbitError;
use crate::flow::{Coordinates, Flow};
use crate::variational::{derivatives, variables, Column, Order, Symbols, Variational};
use chetaev_integrate::Output;
use chetaev_mechanics::{MotionTerms, Selection, System};
use chetaev_symbolic::{Expr, Symbol};

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
    let mut beginning = beginning.clone();
    let symbols: Vec<Symbol> = by
        .iter()
        .map(|name| varied(system, flow, &mut beginning.given, name))
        .collect::<Result<_, _>>()?;
    let columns: Vec<Column> = symbols.iter().map(|&s| Column::Parameter(s)).collect();
    let mut motion = Variational::new(flow, columns, order)?;
    let start = Start {
        system,
        flow,
        terms,
        selection,
        beginning: &beginning,
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
