//! Chaplygin's equations.
//!
//! `D(∂L*/∂v^s) - ∂L*/∂q^s = Σ_l θ_l A^l_s + Q_s + Σ_m Q_{k+m} ∂φ^m/∂v^s`, where neither L nor the constraints depend on
//! the dependent coordinates (T1 (9), Chaplygin 1897).

use super::voronets::{natural, Restricted};
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::{Characteristics, Selection};
use crate::claims::model::{chaplygin_choice, is_absent};
use crate::equations::{Equations, RegularMatrix, Schema};
use chetaev_symbolic::Expr;

/// Chaplygin's equations.
#[derive(Clone, Copy, Debug)]
pub struct Chaplygin;

static CARD: Card = Card {
    name: "chaplygin",
    title: "Chaplygin's equations",
    statement: "Lagrange's equations of the independent coordinates for the restricted Lagrangian with Chaplygin's correction; where the forces contain no dependent coordinates either, they are closed.",
    principle: Principle::Hamilton,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.chaplygin", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "accelerations of the k independent coordinates",
    highest_order: 1,
    sources: &[
        Source { key: "chaplygin1897", place: "§ 1" },
        Source { key: "rumyantsev1982", place: "Hamilton's principle in the form of Voronets; T1 (9)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D(∂L*/∂v^s) − ∂L*/∂q^s = Σ_l θ_l A^l_s + Q_s + Σ_m Q_{k+m} ∂φ^m/∂v^s",
    latex: r"\frac{d}{dt}\frac{\partial L^*}{\partial \dot q^s} - \frac{\partial L^*}{\partial q^s} = \sum_l \theta_l A^l_s + Q_s + \sum_m Q_{k+m} \frac{\partial \varphi^m}{\partial \dot q^s}",
};

impl Formulation for Chaplygin {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let characteristics = ignorable(basis)?;
        let restricted = Restricted::new(system, &characteristics);
        let slopes: Vec<Expr> = characteristics
            .independent
            .iter()
            .map(|&s| {
                let mut unit = vec![g.zero(); system.n()];
                unit[s] = g.one();
                characteristics.by_coordinates(system, &[restricted.lagrangian], &unit)[0]
            })
            .collect();
        let mut equations =
            restricted.equations((CARD.name, SCHEMA), basis, &characteristics, &slopes)?;
        equations.regular = solved_for(basis, &characteristics);
        Ok(equations)
    }
}

/// `∂f/∂v` of the dependent velocities, where these are not the ones that are chosen anew along a motion and it may vanish.
fn solved_for(basis: &Basis<'_>, c: &Characteristics) -> Option<RegularMatrix> {
    let (system, rows) = (basis.system, &basis.selection.rows);
    if c.dependent == basis.selection.dependent {
        return None;
    }
    let slopes = |&row: &usize| -> Vec<Expr> {
        let gradient = &basis.terms.jacobian[row];
        c.restrict(
            system,
            &c.dependent.iter().map(|&d| gradient[d]).collect::<Vec<_>>(),
        )
    };
    let rows: Vec<Vec<Expr>> = rows.iter().map(slopes).collect();
    let g = &system.graph;
    let moves = |e: Expr| !g.is_free_of(e, &|s| system.moves(g.symbol_name(s)));
    rows.concat()
        .into_iter()
        .any(moves)
        .then_some(RegularMatrix {
            name: "∂f/∂v of the dependent velocities, those of the coordinates that occur nowhere",
            rows,
        })
}

/// Independent velocities whose dependent coordinates occur nowhere: those of the selection where they are of this kind,
/// else the choice of `model.chaplygin`.
///
/// # Errors
/// [`DeriveError`] where the dependent velocities cannot be solved for.
pub fn ignorable(basis: &Basis<'_>) -> Result<Characteristics, DeriveError> {
    let (system, terms) = (basis.system, basis.terms);
    let rows = &basis.selection.rows;
    let given = natural(basis)?;
    let absent = |&d: &usize| is_absent(system, terms, rows, d);
    if given.dependent.iter().all(absent) {
        return Ok(given);
    }
    match chaplygin_choice(system, terms, rows) {
        Some(dependent) => {
            let rows = rows.clone();
            let selection = Selection { rows, dependent };
            let chosen = Characteristics::independent_velocities(system, terms, &selection);
            Ok(chosen?)
        }
        None => Ok(given),
    }
}
