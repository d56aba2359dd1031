//! Functions that are constant along all motions, with independent gradients at a steady one: motions stay on their common levels.

use crate::expansion::Expansion;
use crate::family::independent_rows;
use crate::integrals::{Jet, FINITE};
use chetaev_symbolic::Expr;

/// The functions, finite constraints among them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Levels {
    pub(crate) jets: Vec<Jet>,
}

impl Levels {
    /// Those of these functions that do not fall and whose gradients are independent.
    pub(crate) fn of(about: &Expansion<'_>, jets: &[Jet]) -> Levels {
        let constant: Vec<&Jet> = jets.iter().filter(|jet| !jet.falls).collect();
        let rows: Vec<Vec<Expr>> = constant.iter().map(|jet| jet.gradient.clone()).collect();
        let chosen = independent_rows(about.graph(), &rows);
        Levels {
            jets: chosen
                .iter()
                .map(|&(row, _)| constant[row].clone())
                .collect(),
        }
    }

    /// The gradients.
    pub(crate) fn gradients(&self) -> Vec<Vec<Expr>> {
        self.jets.iter().map(|jet| jet.gradient.clone()).collect()
    }

    /// The names of those that are no finite constraints, as they are read.
    pub(crate) fn text(&self) -> String {
        let names = self.jets.iter().map(|jet| jet.name.as_str());
        let names: Vec<&str> = names.filter(|name| *name != FINITE).collect();
        if names.is_empty() {
            String::new()
        } else {
            format!(" on the level of {}", names.join(" and "))
        }
    }
}
