//! Constraints that hold with multiplicity: wherever they hold their gradients are dependent, although one of them does not follow from the
//! others. Two spheres that touch, `z = x² + y²` with `z = 2 x y`, and a sum of squares are such; multipliers then determine no motion.
//!
//! The common zeros are written by irreducible equations without powers (Wu's triangular systems), sums of squares by their terms as the
//! states are real. Where the gradients of the constraints as they are stated have a lower rank on each part than it has equations, the
//! constraints have a multiple zero, and these equations have the same points and a simple one.
//!
//! Constraints of velocities may leave positions only on which a further condition holds: `x' = 0` and `y x' = z` hold where `z = 0` alone.
//! Its rate then holds too, and where that is no combination of the constraints, their gradients miss a direction in which the motion is held.

use crate::characteristics::{CharacteristicsError, Manifold};
use crate::claims::{Degenerate, Prepared};
use crate::prover::{assumptions, Prover};
use crate::sample;
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words::quoted;
use chetaev_symbolic::common_zeros::{real_common_zeros, Zeros};
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::{Expr, Symbol};

/// Constraints with dependent gradients at all states that satisfy them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Multiplicity {
    /// The constraints.
    pub names: Vec<String>,
    /// The rank of their gradients at almost all states that satisfy them, the largest of all parts.
    pub rank: usize,
    /// Simpler functions that vanish at the same states, for each part of the set.
    pub simpler: Vec<Vec<Expr>>,
    /// For each part all conditions on the positions, where they are more than the constraints state; else none.
    pub hidden: Vec<Vec<Expr>>,
    /// Parameters with their values, where it is so for these and not for others.
    pub values: Vec<(Expr, Expr)>,
}

/// Rates of conditions that rates demand are followed so deep.
const DEPTH: usize = 8;
/// It is asked where a motion cannot begin, and the answer is one sentence: a tenth of a proof's work.
const BUDGET: Budget = Budget {
    work: 20_000_000,
    ..Budget::PROOF
};

impl Multiplicity {
    /// That of a system of constraints of positions and velocities, for any values of the parameters or for those that the model states; `None`
    /// where the gradients are independent at some states, or nothing is known.
    pub fn find(system: &System, terms: &MotionTerms, prover: &Prover) -> Option<Multiplicity> {
        if terms.order > 1 {
            return None;
        }
        let mut stated = system.parameter_values();
        let all = [terms.constraints.clone(), terms.jacobian.concat()].concat();
        let occurring = system.graph.reachable(&all);
        stated.retain(|(parameter, _)| occurring.contains(parameter));
        let asked = |values: &[(Expr, Expr)]| {
            [true, false].into_iter().find_map(|of_positions| {
                Question::new(system, terms, of_positions, values)?.decide(prover)
            })
        };
        asked(&[]).or_else(|| (!stated.is_empty()).then(|| asked(&stated)).flatten())
    }

    /// What it says of independence.
    pub fn degenerate(&self, system: &System) -> Degenerate {
        let missing = (self.names.len() - self.rank).to_string();
        Degenerate {
            rank: self.rank,
            found: Counterexample {
                point: Vec::new(),
                quantity: "constraints minus rank, wherever they hold".into(),
                residual: (missing.clone(), missing),
                detail: self.sentence(system),
            },
        }
    }

    /// What is wrong, in a sentence that names simpler constraints.
    pub fn sentence(&self, system: &System) -> String {
        let g = &system.graph;
        let part = |all: &Vec<Expr>| {
            let texts: Vec<String> = all.iter().map(|&e| format!("{} = 0", g.text(e))).collect();
            texts.join(", ")
        };
        let parts = |all: &[Vec<Expr>]| all.iter().map(part).collect::<Vec<_>>().join(" or ");
        let (rank, names) = (self.rank, quoted(&self.names));
        let equal = |&(parameter, value): &(Expr, Expr)| {
            format!("{} = {}", g.text(parameter), g.text(value))
        };
        let values: Vec<String> = self.values.iter().map(equal).collect();
        let values = match &values[..] {
            [] => String::new(),
            all => format!("for {}, as the model states it, ", all.join(", ")),
        };
        let gradients = match self.names.len() {
            1 => format!("the gradient of {names} vanishes wherever it holds"),
            _ => format!("the gradients of {names} have the rank {rank} wherever these hold, although none follows from the others"),
        };
        let why = if self.hidden.iter().all(|own| !own.is_empty()) {
            let only = parts(&self.hidden);
            format!("{names} hold only where {only}, which is more than they state of the positions, and their gradients have the rank {rank} there")
        } else if self.hidden.iter().any(|own| !own.is_empty()) {
            gradients
        } else {
            let they = if self.names.len() == 1 {
                "it has"
            } else {
                "they have"
            };
            format!("{gradients}: {they} a multiple zero there")
        };
        format!(
            "{values}{why}, and multipliers determine no motion; the same states satisfy {}, which can be stated instead",
            parts(&self.simpler)
        )
    }
}

/// Terms and selection of a system that has motions.
///
/// # Errors
/// [`CharacteristicsError::Multiplicity`] where the constraints hold with multiplicity, and when no admissible state exists.
pub fn prepared(system: &System) -> Result<Prepared, CharacteristicsError> {
    let prepared = Prepared::new(system);
    let is_regular = |own: &Prepared| sample::is_regular(system, &own.terms);
    if prepared.as_ref().is_ok_and(is_regular) {
        return prepared;
    }
    let terms = MotionTerms::new(system);
    match Multiplicity::find(system, &terms, &Prover::default()) {
        Some(own) => Err(own.degenerate(system).error()),
        None => prepared,
    }
}

/// Constraints, of positions alone or all.
struct Question<'a> {
    system: &'a System,
    names: Vec<String>,
    /// What vanishes: those of positions, and with velocities their rates too.
    functions: Vec<Expr>,
    /// The gradients by the velocities.
    gradients: Vec<Vec<Expr>>,
    /// What is to be determined, coordinates first.
    symbols: Vec<Symbol>,
    /// Values of parameters.
    values: Vec<(Expr, Expr)>,
    /// How many constraints are of positions.
    finite: usize,
    /// Whether it is asked of these alone.
    is_of_positions: bool,
}

impl<'a> Question<'a> {
    /// With values of parameters; `None` where there are no such constraints.
    fn new(
        system: &'a System,
        terms: &MotionTerms,
        is_of_positions: bool,
        values: &[(Expr, Expr)],
    ) -> Option<Question<'a>> {
        let g = &system.graph;
        let stated = terms
            .constraint_index
            .iter()
            .map(|&l| &system.constraints[l]);
        let own = stated.zip(&terms.jacobian).zip(&terms.constraints);
        let own = own.filter(|((c, _), _)| !is_of_positions || c.order == 0);
        let mut found = Question {
            system,
            names: Vec::new(),
            functions: Vec::new(),
            gradients: Vec::new(),
            symbols: system.coordinate_symbols(),
            values: values.to_vec(),
            finite: 0,
            is_of_positions,
        };
        for ((constraint, gradient), &f) in own {
            found.names.push(constraint.name.clone());
            if constraint.order == 0 {
                found
                    .functions
                    .push(g.substitute(constraint.stated, values));
                found.finite += 1;
            }
            if !is_of_positions {
                found.functions.push(g.substitute(f, values));
            }
            found.gradients.push(g.substitute_all(gradient, values));
        }
        if !is_of_positions {
            found.symbols.extend(system.velocity_symbols());
        }
        (!found.names.is_empty()).then_some(found)
    }

    fn decide(&self, prover: &Prover) -> Option<Multiplicity> {
        let mut parts = Vec::new();
        self.complete_parts(&self.functions, self.finite, DEPTH, &mut parts)?;
        let mut rank = 0;
        for part in &parts {
            let manifold = Manifold {
                solved: Vec::new(),
                implicit: part.equations.clone(),
            };
            let own = prover.rank(self.system, &self.gradients, &manifold).ok()?;
            if own.maximum >= self.expected(part) {
                return None;
            }
            rank = rank.max(own.maximum);
        }
        let hidden = parts.iter().map(|part| self.hidden(part)).collect();
        let simpler = parts.iter().map(|part| self.without_rates(part)).collect();
        (!parts.is_empty()).then(|| Multiplicity {
            names: self.names.clone(),
            rank,
            simpler,
            hidden,
            values: self.values.clone(),
        })
    }

    /// The rank that regular constraints have on a part: its codimension among positions, or among velocities over them.
    fn expected(&self, part: &Zeros) -> usize {
        if self.is_of_positions {
            part.codimension
        } else {
            part.codimension - self.positions(part).len()
        }
    }

    /// The equations of a part that contain no velocities.
    fn positions(&self, part: &Zeros) -> Vec<Expr> {
        let (g, velocities) = (&self.system.graph, self.system.velocity_symbols());
        let own = part.equations.iter().map(|(e, _)| *e);
        own.filter(|&e| !g.contains_any(e, &velocities)).collect()
    }

    /// These, where they are more than the constraints state.
    fn hidden(&self, part: &Zeros) -> Vec<Expr> {
        let found = self.positions(part);
        if self.is_of_positions || found.len() <= self.finite {
            return Vec::new();
        }
        found
    }

    /// The equations of a part but for those that are rates of others, which the others imply.
    fn without_rates(&self, part: &Zeros) -> Vec<Expr> {
        let g = &self.system.graph;
        let positions = self.positions(part);
        let rates: Vec<Expr> = positions
            .iter()
            .map(|&e| self.system.total_derivative(e))
            .collect();
        let is_rate = |e: Expr| {
            let mut ratios = rates.iter().map(|&rate| g.div(e, rate));
            ratios.any(|ratio| {
                g.as_number(simplify(g, ratio, &Options::default()))
                    .is_some()
            })
        };
        let own = part.equations.iter().map(|(e, _)| *e);
        own.filter(|&e| !is_rate(e)).collect()
    }

    /// The parts of the common zeros with the rates of what they demand of the positions, which a motion on them satisfies too. `stated` of these
    /// demands have their rates among the functions.
    fn complete_parts(
        &self,
        functions: &[Expr],
        stated: usize,
        depth: usize,
        found: &mut Vec<Zeros>,
    ) -> Option<()> {
        let deeper = depth.checked_sub(1)?;
        let known = assumptions(self.system);
        let of = (&known, BUDGET);
        let parts = real_common_zeros(&self.system.graph, functions, &self.symbols, of)?;
        for part in parts {
            let positions = self.positions(&part);
            if self.is_of_positions || positions.len() <= stated {
                found.push(part);
                continue;
            }
            let rates = positions.iter().map(|&e| self.system.total_derivative(e));
            let own = part.equations.iter().map(|(e, _)| *e);
            let all: Vec<Expr> = own.chain(rates).collect();
            self.complete_parts(&all, positions.len(), deeper, found)?;
        }
        Some(())
    }
}
