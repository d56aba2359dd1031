//! What is proposed as a quasi-velocity.

use crate::characteristics::Parameter;
use crate::elimination::new_speed;
use crate::quadratic_forms::{in_linear_forms, terms_of_degree};
use crate::system::System;
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// A speed that is proposed.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// A name for it; one with a space is replaced by a letter.
    pub name: String,
    /// A linear form of the velocities.
    pub value: Expr,
    /// What it is, in a few words; empty for the velocity of a coordinate.
    pub meaning: &'static str,
}

impl Proposal {
    /// With its symbols.
    pub(super) fn speed(&self, g: &Graph) -> Parameter {
        match g.as_symbol(self.value) {
            Some(symbol) => Parameter {
                name: self.name.clone(),
                value: self.value,
                rate: g.symbol(g.symbol_name(symbol), g.symbol_order(symbol) + 1),
                symbol,
                rate_symbol: g.intern_symbol(g.symbol_name(symbol), g.symbol_order(symbol) + 1),
                definition: self.value,
            },
            None => new_speed(g, &self.name, self.value),
        }
    }
}

/// A kind of speeds that a person might take.
pub trait Candidate: Sync {
    /// Those of a system, in a fixed order.
    fn proposals(&self, system: &System) -> Vec<Proposal>;
}

/// The registry.
pub static CANDIDATES: &[&dyn Candidate] = &[&Rates, &Forms];

/// The rates of the coordinates: of wheels, of angles.
struct Rates;

impl Candidate for Rates {
    fn proposals(&self, system: &System) -> Vec<Proposal> {
        let rates = system.coordinates.iter().map(|c| Proposal {
            name: format!("{}'", c.name),
            value: c.v,
            meaning: "",
        });
        rates.collect()
    }
}

/// The linear forms in which the kinetic energy is written: components of the angular velocity of a body, of the velocity of its mass
/// centre.
struct Forms;

/// What begins the name of such a form.
pub(super) const FORM: &str = "form ";

/// So many of them are looked at.
const MOST_FORMS: usize = 6;

impl Candidate for Forms {
    fn proposals(&self, system: &System) -> Vec<Proposal> {
        let g = &system.graph;
        let forms = forms(system).into_iter().enumerate();
        let own = forms.map(|(i, value)| Proposal {
            name: format!("{FORM}{i}"),
            value,
            meaning: "as the kinetic energy is written",
        });
        own.filter(|p| matches!(g.node(p.value), Node::Sum { .. }))
            .take(MOST_FORMS)
            .collect()
    }
}

/// The linear forms of the kinetic energy, those that are one velocity last, else in the order of the parameters that are their weights.
pub(super) fn forms(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let kinetic = terms_of_degree(system, system.lagrangian, 2).0;
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let Some((written, variables, forms)) = in_linear_forms(g, kinetic, &velocities) else {
        return Vec::new();
    };
    let symbols: Vec<Symbol> = variables.iter().filter_map(|&e| g.as_symbol(e)).collect();
    let weights = g.gradient(written, &symbols);
    let place = |weight: Expr| {
        let mut parameters = system.parameters.iter();
        parameters.position(|p| {
            g.as_symbol(p.expr)
                .is_some_and(|s| g.contains_any(weight, &[s]))
        })
    };
    let mut all: Vec<(bool, Option<usize>, Expr)> = forms
        .into_iter()
        .zip(weights)
        .map(|(form, weight)| (g.as_symbol(form).is_some(), place(weight), form))
        .collect();
    all.sort_by(|a, b| {
        let of_structure = || g.compare(a.2, b.2);
        (a.0, a.1).cmp(&(b.0, b.1)).then_with(of_structure)
    });
    all.into_iter().map(|(_, _, form)| form).collect()
}
