//! The equations of motion in quasi-velocities, in as few operations as were found.
//!
//! `Σ_ρ M_σρ P'_ρ = b_σ` from the kinetic energy as it is written, a form of linear forms of the velocities
//! ([`ReducedEquations`]; Gibbs 1879, Appell 1900; Hamel 1904), with factors that vanish nowhere cancelled. The P are those of the model;
//! where it names none, those that a person would choose ([`crate::speeds`]).

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, Equations, Schema};
use crate::mass;
use crate::prover::assumptions;
use crate::reduced_equations::ReducedEquations;
use crate::speeds;
use crate::system::System;
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::print::{Document, Options as Printing};
use chetaev_symbolic::simplify::{length, simplify, Options};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Node, Symbol};

/// The shortest form.
#[derive(Clone, Copy, Debug)]
pub struct Reduced;

static CARD: Card = Card {
    name: "reduced",
    title: "Equations in quasi-velocities",
    statement: "As many equations as degrees of freedom in velocity, in the quasi-velocities of the model or in those that make them shortest: speeds along blades, rates of wheels, angular velocities.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique"],
    identity: None,
    unknowns: "rates of the k quasi-velocities",
    highest_order: 1,
    sources: &[
        Source { key: "gibbs1879", place: "" },
        Source { key: "appell1900", place: "" },
        Source { key: "hamel1904", place: "" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "Σ_ρ M_σρ P_ρ' = b_σ",
    latex: r"\sum_\rho M_{\sigma\rho} \dot P_\rho = b_\sigma",
};

impl Formulation for Reduced {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let system = basis.system;
        let g = &system.graph;
        let (c, is_chosen) = characteristics(basis)?;
        let is_explicit = c.implicit().next().is_none();
        let of_lagrangian = is_explicit && mass::with_velocity(system).is_none();
        let own = of_lagrangian.then(|| short(system, &c));
        let own = own.flatten().unwrap_or_else(|| {
            ReducedEquations::of_terms(system, basis.terms, &c).without_ignorable(system)
        });
        let rates = own
            .rates(g)
            .ok_or(DeriveError::NotStated("a regular mass matrix"))?;
        let motion = (c.parameters.iter().enumerate())
            .map(|(s, p)| {
                let (left, right) = row(system, &c, &own, s);
                Equation {
                    label: p.name.clone(),
                    left,
                    right,
                }
            })
            .collect();
        let speeds = (c.parameters.iter())
            .filter(|p| is_chosen && p.definition != p.value)
            .map(|p| Equation {
                label: p.name.clone(),
                left: p.value,
                right: p.definition,
            })
            .collect();
        let mut equations = Equations::in_characteristics(CARD.name, system, &c, &rates)
            .with_group("equations of motion", Some(SCHEMA), motion)
            .with_group("kinematics", None, basis.kinematics(&c))
            .with_group(DEFINITIONS, None, speeds);
        if system.characteristics.is_some() {
            equations
                .variables
                .iter_mut()
                .for_each(|x| x.definition = None);
        }
        Ok(equations)
    }
}

/// The heading of the definitions of quasi-velocities that were chosen.
pub const DEFINITIONS: &str = "quasi-velocities";

/// The characteristics the caller insists on, those of the model, those chosen, or independent velocities; with whether they are chosen.
pub(crate) fn characteristics(basis: &Basis<'_>) -> Result<(Characteristics, bool), DeriveError> {
    let system = basis.system;
    let is_given = basis.characteristics.is_some()
        || system.characteristics.is_some()
        || !system.quasi_velocities.is_empty();
    if !is_given {
        let rows = &basis.selection.rows;
        if let Some(choice) = speeds::chosen(system, basis.terms, rows) {
            return Ok((choice.characteristics, true));
        }
    }
    Ok((basis.kinematic_characteristics()?, false))
}

/// The Lagrangian of more nodes is taken as it is written.
const LARGE: usize = 200;

/// What making the equations short may cost, in counted work.
const SECONDS: f64 = 0.5;

/// The equations made short, where that does not take longer than reading them.
fn short(system: &System, c: &Characteristics) -> Option<ReducedEquations> {
    let all = [vec![system.lagrangian], c.velocities.clone()].concat();
    let as_written = || ReducedEquations::new(system, c);
    if system.graph.reachable(&all).len() > LARGE {
        return as_written();
    }
    let short = || ReducedEquations::short(system, c);
    within(&Work::of_seconds(SECONDS), short).unwrap_or_else(|_| as_written())
}

/// Longer equations are left as they were derived.
const SHORTENED: u64 = 1_500;

/// `Σ_ρ M_σρ P'_ρ` and `b_σ`, without factors that vanish nowhere.
fn row(system: &System, c: &Characteristics, own: &ReducedEquations, s: usize) -> (Expr, Expr) {
    let g = &system.graph;
    let terms = own.mass[s].iter().zip(&c.parameters);
    let terms = terms.filter(|(&m, _)| !g.is_zero(m));
    let left = g.add(&terms.map(|(&m, p)| g.mul(&[m, p.rate])).collect::<Vec<_>>());
    let difference = g.sub(left, own.force[s]);
    if length(g, difference) > SHORTENED {
        return (left, own.force[s]);
    }
    let options = Options::default();
    let whole = without_factors(system, c, simplify(g, difference, &options));
    let short = match sides(system, c, whole) {
        // No equation begins with a minus.
        (left, _) if g.text(left).starts_with('-') => sides(system, c, g.neg(whole)),
        short => short,
    };
    let stated = (left, own.force[s]);
    let count = |(left, right): (Expr, Expr)| {
        let printed = Document::equations(g, &[(left, right)], &Printing::default());
        printed.operations().total()
    };
    if count(stated) < count(short) {
        stated
    } else {
        short
    }
}

/// What is linear in the rates and vanishes, with the rates on the left.
fn sides(system: &System, c: &Characteristics, whole: Expr) -> (Expr, Expr) {
    let (g, options) = (&system.graph, Options::default());
    let at_rest: Vec<(Expr, Expr)> = c.parameters.iter().map(|p| (p.rate, g.zero())).collect();
    let right = simplify(g, g.neg(g.substitute(whole, &at_rest)), &options);
    let symbols: Vec<Symbol> = c.parameters.iter().map(|p| p.rate_symbol).collect();
    let slopes = g.gradient(whole, &symbols).into_iter().zip(&c.parameters);
    let slopes = slopes.filter(|(m, _)| !g.is_zero(*m));
    let left: Vec<Expr> = slopes
        .map(|(m, p)| g.mul(&[simplify(g, m, &options), p.rate]))
        .collect();
    (g.add(&left), right)
}

/// A product without the factors that contain no rate and vanish nowhere, and without what is below it.
fn without_factors(system: &System, c: &Characteristics, e: Expr) -> Expr {
    let g = &system.graph;
    let assumptions = assumptions(system);
    let rates: Vec<Symbol> = c.parameters.iter().map(|p| p.rate_symbol).collect();
    let Node::Product { factors, .. } = g.node(e) else {
        return e;
    };
    let is_needed = |factor: &&Expr| {
        let exponent = g.as_number(g.base_exponent(**factor).1);
        let is_below = exponent.is_some_and(rational::is_negative);
        let is_nonzero = || known_sign(g, **factor, &assumptions).is_nonzero();
        g.contains_any(**factor, &rates) || !(is_below || is_nonzero())
    };
    let kept: Vec<Expr> = factors.iter().filter(is_needed).copied().collect();
    g.mul(&kept)
}
