//! The quasi-velocities that a person would choose where a model names none: the speed along a blade, the rates of wheels, the
//! components of the angular velocity.
//!
//! Every way of solving the constraints gives admissible velocities `v = φ(q, P, t)`: by constant coefficients, along blades, in axes that
//! turn with a body (`bases`). The [`CANDIDATES`], a registry, propose speeds to put in the place of the P: the rates of the coordinates,
//! and the linear forms in which the kinetic energy is written. What is asked of all of them: no pole where the motion starts; then the
//! fewest operations in `M P' = b` and in `q' = φ` as they are printed, poles elsewhere and new names counting as some. The search goes
//! through a fixed list, and takes the first of the best: the same model has the same speeds always. Quasi-velocities of the user are never
//! touched.

mod bases;
mod candidates;

pub use candidates::{Candidate, Proposal, CANDIDATES};

use crate::characteristics::{Characteristics, Parameter};
use crate::elimination::{new_speed, Start};
use crate::equations::unused_name;
use crate::mass;
use crate::prover::assumptions;
use crate::reduced_equations::ReducedEquations;
use crate::regular::denominators;
use crate::system::System;
use crate::terms::MotionTerms;
use bases::{Basis, SEARCHED};
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::print::{Document, Options as Printing};
use chetaev_symbolic::simplify::{simplify_all, Options};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Symbol};

/// Larger systems are not looked at.
const LARGEST: usize = 40;

/// How many replacements are made.
const ROUNDS: usize = 4;

/// How many sets of speeds are tried.
const TRIALS: usize = 60;

/// Nodes of the Lagrangian and the constraints from which on nothing is chosen: it would take longer than all that follows.
const LARGE: usize = 200;

/// What the search may cost, in counted work.
const SECONDS: f64 = 1.0;

/// What a name that has to be learnt counts, in operations.
const NAME: usize = 4;

/// What a pole counts, in operations, where nothing excludes it but the start.
const POLE: usize = 12;

/// Speeds that were chosen, with what they are.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The admissible velocities in them.
    pub characteristics: Characteristics,
    /// What each is, in a few words; empty for the velocity of a coordinate.
    pub meanings: Vec<String>,
}

/// The quasi-velocities chosen for the constraints of `rows`; `None` where the rates of independent coordinates serve as well, or
/// where this is not made for the system: constraints of positions or of higher order, or nonlinear ones.
pub fn chosen(system: &System, terms: &MotionTerms, rows: &[usize]) -> Option<Choice> {
    let is_affine = rows.iter().all(|&row| terms.affine[row]);
    let is_stated = !system.independent.is_empty()
        || !system.quasi_velocities.is_empty()
        || system.characteristics.is_some();
    let is_open = terms.order == 1 && is_affine && !is_stated && system.n() <= LARGEST;
    if !is_open || mass::with_velocity(system).is_some() || !system.fixed_functions().is_empty() {
        return None;
    }
    let known = terms.memo.shared(|| Known {
        rows: rows.to_vec(),
        choice: searched(system, terms, rows),
    });
    if known.rows == rows {
        known.choice.clone()
    } else {
        searched(system, terms, rows)
    }
}

/// What was chosen for rows.
struct Known {
    rows: Vec<usize>,
    choice: Option<Choice>,
}

fn searched(system: &System, terms: &MotionTerms, rows: &[usize]) -> Option<Choice> {
    let g = &system.graph;
    let stated = rows.iter().map(|&row| terms.constraints[row]);
    let stated: Vec<Expr> = stated.chain([system.lagrangian]).collect();
    if g.reachable(&stated).len() > LARGE {
        return None;
    }
    let search = || {
        let search = Search {
            system,
            terms,
            rows,
            start: Start::of(system),
        };
        let best = search.best()?;
        let is_new = |p: &Parameter| p.definition != p.value;
        let is_chosen = best.speeds.iter().any(is_new);
        is_chosen.then(|| search.named(&best))
    };
    within(&Work::of_seconds(SECONDS), search).ok().flatten()
}

struct Search<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    rows: &'a [usize],
    start: Start,
}

impl Search<'_> {
    /// The basis with the fewest operations.
    fn best(&self) -> Option<Basis> {
        let bases = bases::all(self.system, self.terms, self.rows, &self.start);
        if self.system.n() > SEARCHED {
            return bases.into_iter().next();
        }
        let mut trials = 0;
        let mut best: Option<(usize, Basis)> = None;
        for basis in bases {
            trials += 1;
            let cost = self.cost(&basis);
            if cost.is_some_and(|cost| best.as_ref().is_none_or(|(least, _)| cost < *least)) {
                best = cost.map(|cost| (cost, basis));
            }
        }
        let proposals: Vec<Proposal> = CANDIDATES
            .iter()
            .flat_map(|candidate| candidate.proposals(self.system))
            .collect();
        for _ in 0..ROUNDS {
            let Some((least, basis)) = best.clone() else {
                break;
            };
            for (proposal, place) in proposals
                .iter()
                .flat_map(|p| (0..basis.speeds.len()).map(move |place| (p, place)))
            {
                if trials >= TRIALS {
                    break;
                }
                let Some(other) = self.replaced(&basis, proposal, place) else {
                    continue;
                };
                trials += 1;
                if let Some(cost) = self.cost(&other) {
                    if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                        best = Some((cost, other));
                    }
                }
            }
            if best.as_ref().is_none_or(|(now, _)| *now == least) {
                break;
            }
        }
        best.map(|(_, basis)| basis)
    }

    /// The basis with a proposed speed in the place of one; `None` where that is singular at the start, or nothing new.
    fn replaced(&self, basis: &Basis, proposal: &Proposal, place: usize) -> Option<Basis> {
        let g = &self.system.graph;
        let own = self.in_speeds(basis, proposal.value);
        let symbols: Vec<Symbol> = basis.speeds.iter().map(|p| p.symbol).collect();
        let slopes = simplify_all(g, &g.gradient(own, &symbols), &Options::default());
        let others = slopes.iter().filter(|&&e| !g.is_zero(e)).count();
        let slope = slopes[place];
        let is_same = others == 1 && g.is_one(slope);
        // A pole that nothing excludes would cost more than one speed ever saves.
        let is_safe = known_sign(g, slope, &assumptions(self.system)).is_nonzero();
        if !is_safe || is_same || !self.start.is_nonzero(g, slope) {
            return None;
        }
        let speed = proposal.speed(g);
        let replaced = basis.speeds[place].value;
        let rest = g.substitute(own, &[(replaced, g.zero())]);
        let value = g.div(g.sub(speed.value, rest), slope);
        let velocities = g.substitute_all(&basis.velocities, &[(replaced, value)]);
        let mut new = basis.clone();
        new.velocities = simplify_all(g, &velocities, &Options::default());
        new.speeds[place] = speed;
        new.meanings[place] = proposal.meaning.to_owned();
        Some(new)
    }

    /// A linear form of the velocities in the speeds.
    fn in_speeds(&self, basis: &Basis, form: Expr) -> Expr {
        let places = self.system.coordinates.iter().zip(&basis.velocities);
        let pairs: Vec<(Expr, Expr)> = places.map(|(c, &v)| (c.v, v)).collect();
        self.system.graph.substitute(form, &pairs)
    }

    /// Operations of the equations of motion and of the kinematics; `None` where one has a pole at the start.
    fn cost(&self, basis: &Basis) -> Option<usize> {
        let (g, system) = (&self.system.graph, self.system);
        let c = Characteristics::by_formulas(
            system,
            self.terms,
            self.rows,
            basis.speeds.clone(),
            basis.velocities.clone(),
        );
        let short = ReducedEquations::short(system, &c);
        let is_short = short.is_some();
        let equations = short.unwrap_or_else(|| ReducedEquations::of_terms(system, self.terms, &c));
        let k = c.k();
        let lower = (0..k).flat_map(|s| (0..=s).map(move |t| (s, t)));
        let mut entries: Vec<Expr> = lower.map(|(s, t)| equations.mass[s][t]).collect();
        entries.extend(&equations.force);
        if !is_short && g.reachable(&entries).len() <= SHORTENED {
            entries = simplify_all(g, &entries, &Options::default());
        }
        let products = entries[..k * (k + 1) / 2].iter();
        let products = products.filter(|&&e| !g.is_zero(e)).count();
        let rates = basis
            .velocities
            .iter()
            .filter(|&&v| g.as_symbol(v).is_none());
        entries.extend(rates);
        let assumptions = assumptions(system);
        let mut poles = 0;
        for below in denominators(system, &entries) {
            if !self.start.is_nonzero(g, below) {
                return None;
            }
            poles += usize::from(!known_sign(g, below, &assumptions).is_nonzero());
        }
        let printed = Document::expressions(g, &entries, &Printing::default()).operations();
        let new = basis.speeds.iter().filter(|p| p.definition != p.value);
        Some(printed.total() + 2 * products + POLE * poles + NAME * new.count())
    }

    /// With names in the place of those with spaces.
    fn named(&self, basis: &Basis) -> Choice {
        let (g, system) = (&self.system.graph, self.system);
        let mut taken: Vec<String> = Vec::new();
        let mut pairs = Vec::new();
        let turns = basis.speeds.iter().filter(|p| is_turn(&p.name)).count();
        let mut speeds = basis.speeds.clone();
        let mut seen = 0;
        for speed in &mut speeds {
            if speed.definition == speed.value {
                continue;
            }
            seen += usize::from(is_turn(&speed.name));
            let numbered = format!("w_{seen}");
            let wanted: &[&str] = match (is_turn(&speed.name), turns) {
                (true, 1) => &["w", "n"],
                (true, _) => &[&numbered],
                _ => &["u", "v", "s"],
            };
            let is_free = |name: &&&str| {
                unused_name(system, name) == **name && !taken.iter().any(|own| own == **name)
            };
            let name = match wanted.iter().find(is_free) {
                Some(name) => (*name).to_owned(),
                None => unused_name(system, &format!("u_{}", taken.len() + 1)),
            };
            let own = new_speed(g, &name, speed.definition);
            pairs.push((speed.value, own.value));
            taken.push(name);
            *speed = own;
        }
        let velocities = g.substitute_all(&basis.velocities, &pairs);
        Choice {
            characteristics: Characteristics::by_formulas(
                system, self.terms, self.rows, speeds, velocities,
            ),
            meanings: basis.meanings.clone(),
        }
    }
}

/// Entries of more nodes than this are counted as they are.
const SHORTENED: usize = 600;

/// Whether a speed is one of the forms of the kinetic energy, of which there may be several of a kind.
fn is_turn(name: &str) -> bool {
    name.starts_with(candidates::FORM)
}
