//! The bridge between claims about systems and zero tests of expressions.

use crate::characteristics::Manifold;
use crate::counterexample;
use crate::redundancy::LeftOut;
use crate::system::{Relation, System};
use crate::words;
use chetaev_symbolic::factors::irreducible_factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::{Counterexample, PointValue, Proof};
use chetaev_symbolic::zero::assumptions::{Assumptions, Relation as Sign};
use chetaev_symbolic::zero::{decide_zero, generic_rank, GenericRank, Options, RankTest, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

/// Values of parameters at which a question was answered otherwise than at general ones: there the strata of the question split. Clones
/// share what is noticed, so that it is known which claim asked.
#[derive(Clone, Debug, Default)]
pub struct Exceptional(Arc<Mutex<Noticed>>);

/// What was noticed: how the stated values of parameters are exceptional, and what else may be.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Noticed {
    /// (Parameter, what it is) for the values stated: a number, or a function of others such as b for a = b.
    pub stated: BTreeSet<(Expr, Expr)>,
    /// (Parameter, what it is), where what vanishes for the values stated vanishes too.
    pub others: BTreeSet<(Expr, Expr)>,
}

impl Noticed {
    /// Both together.
    pub fn extend(&mut self, other: Noticed) {
        self.stated.extend(other.stated);
        self.others.extend(other.others);
    }
}

impl Exceptional {
    /// What was noticed since the last time, which is forgotten.
    pub fn take(&self) -> Noticed {
        std::mem::take(&mut *self.lock())
    }

    /// Notices values.
    pub fn add(&self, noticed: Noticed) {
        self.lock().extend(noticed);
    }

    /// Notices how the stated values of parameters are exceptional.
    pub fn add_stated(&self, conditions: impl IntoIterator<Item = (Expr, Expr)>) {
        self.lock().stated.extend(conditions);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Noticed> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// How hard to try, and with which random choices.
#[derive(Clone, Debug)]
pub struct Prover {
    /// Seed of all random choices; stated in the verdicts.
    pub seed: u64,
    /// Replay with another parametrization of the circle and other primes (T6 §6.6).
    pub replay: bool,
    /// At most so many field operations for one proof.
    pub budget: u64,
    /// Where the values that the model states are exceptional.
    pub exceptional: Exceptional,
}

impl Default for Prover {
    fn default() -> Prover {
        Prover {
            seed: 0x43_68_65_74_61_65_76,
            replay: false,
            budget: 2_000_000_000,
            exceptional: Exceptional::default(),
        }
    }
}

/// The assumptions of a system as the zero test wants them.
pub fn assumptions(system: &System) -> Assumptions {
    let mut list = Assumptions::new();
    for assumption in &system.assumptions {
        let relation = match assumption.relation {
            Relation::Less => Sign::Less,
            Relation::LessOrEqual => Sign::LessOrEqual,
            Relation::NotEqual => Sign::NotEqual,
        };
        list.assume(assumption.left, relation, assumption.right);
    }
    list
}

/// The assumptions with values for parameters: a point is then drawn for the others as these values allow.
fn assumptions_at(system: &System, values: &[(Expr, Expr)]) -> Assumptions {
    let g = &system.graph;
    let mut list = Assumptions::new();
    for own in assumptions(system).list() {
        let at = |e: Expr| g.substitute(e, values);
        list.assume(at(own.left), own.relation, at(own.right));
    }
    list
}

impl Prover {
    fn options(&self) -> Options {
        let options = Options {
            seed: self.seed,
            budget: self.budget,
            ..Options::default()
        };
        if self.replay {
            options.replay()
        } else {
            options
        }
    }

    /// The seed of random points that no verdict states by itself; another one for a replay.
    pub fn points_seed(&self) -> u64 {
        match self.replay {
            false => self.seed,
            true => self.seed.rotate_left(23) ^ 0x5eed,
        }
    }

    /// Decides whether every residual vanishes on `manifold`; `on` says in words where that is. Parameters are arbitrary, but a
    /// counterexample has the values that the model states, where one with them exists; where none does, these values are
    /// exceptional.
    pub fn identity(
        &self,
        system: &System,
        residuals: &[Expr],
        manifold: &Manifold,
        on: &str,
    ) -> Verdict {
        let manifold = &*system.with_names(residuals, manifold);
        let verdict = self.consequence(system, residuals, manifold, on);
        checked(system, residuals, manifold, verdict)
    }

    /// As [`identity`](Prover::identity), of constraints that may contradict the others: a counterexample satisfies the others only, so
    /// that it is no admissible state of the system, and is not asked to be one.
    pub(crate) fn consequence(
        &self,
        system: &System,
        residuals: &[Expr],
        manifold: &Manifold,
        on: &str,
    ) -> Verdict {
        match self.vanish(system, residuals, manifold, &assumptions(system)) {
            Verdict::Refuted(found) => {
                let occurring = [residuals, &manifold.expressions()[..]].concat();
                let values = stated_among(system, &occurring);
                self.refuted_as_stated(system, residuals, manifold, &values, found)
            }
            Verdict::Proved(mut proof) => {
                proof.on = located(&proof.on, on, system);
                Verdict::Proved(proof)
            }
            // A constraint that is a product: claims put their sentence before this one.
            Verdict::Conditional {
                condition,
                proof,
                counterexample,
            } => Verdict::Conditional {
                proof: Proof {
                    detail: format!(
                        "this is so on the component {condition} alone; {}",
                        proof.detail
                    ),
                    ..proof
                },
                condition,
                counterexample,
            },
            other => other,
        }
    }

    /// Whether residuals vanish, for all values of the symbols that occur that these assumptions allow.
    fn vanish(
        &self,
        system: &System,
        residuals: &[Expr],
        manifold: &Manifold,
        assumptions: &Assumptions,
    ) -> Verdict {
        let test = ZeroTest {
            residuals,
            solved: &manifold.solved,
            implicit: &manifold.implicit,
            assumptions,
            options: self.options(),
        };
        decide_zero(&system.graph, &test)
    }

    /// A refutation with the values of parameters that the model states; that for others where there is none with them.
    fn refuted_as_stated(
        &self,
        system: &System,
        residuals: &[Expr],
        manifold: &Manifold,
        values: &[(Expr, Expr)],
        found: Counterexample,
    ) -> Verdict {
        let g = &system.graph;
        // Of parameters that only assumptions mention a point says nothing: they have the values stated.
        let mut beside = system.parameter_values();
        beside.retain(|pair| !values.contains(pair));
        let at = |values: &[(Expr, Expr)]| {
            let own = g.substitute_all(residuals, values);
            let manifold = manifold.substituted(g, values);
            let values = [values, &beside[..]].concat();
            self.vanish(system, &own, &manifold, &assumptions_at(system, &values))
        };
        if values.is_empty() {
            return Verdict::Refuted(found);
        }
        match at(values) {
            Verdict::Refuted(mut own) => {
                own.point.extend(values.iter().map(|pair| stated(g, pair)));
                return Verdict::Refuted(own);
            }
            Verdict::Proved(_) | Verdict::Numerical(_) => {
                let is_as_before =
                    |values: &[(Expr, Expr)]| !matches!(at(values), Verdict::Refuted(_));
                let zeros = |own: &[Expr]| common_zeros(system, residuals, manifold, own);
                let stated = conditions_that_matter(g, values, zeros, is_as_before);
                if let &[(parameter, value)] = stated.as_slice() {
                    let symbols = g.symbols_in(&[parameter, value]);
                    let own: Vec<Expr> = symbols.into_iter().map(|s| g.symbol_expr(s)).collect();
                    self.exceptional.lock().others.extend(zeros(&own));
                }
                self.exceptional.add_stated(stated);
            }
            _ => {}
        }
        Verdict::Refuted(found)
    }

    /// [`identity`](Prover::identity) for residuals with names: a refutation says which one does not vanish, what it is, and
    /// where.
    pub fn named_identity(
        &self,
        system: &System,
        residuals: &[(String, Expr)],
        manifold: &Manifold,
        on: &str,
    ) -> Verdict {
        let g = &system.graph;
        let values: Vec<Expr> = residuals.iter().map(|(_, value)| *value).collect();
        match self.identity(system, &values, manifold, on) {
            Verdict::Refuted(mut found) => {
                if let Some((name, value)) = residuals.get(place_of(&found)) {
                    let mut symbols = g.symbols_in(&[*value]);
                    symbols.extend(parameters_of(system, manifold, &symbols));
                    let symbols = symbols.into_iter().map(|s| g.symbol_text(s));
                    let symbols: Vec<String> = symbols.collect();
                    found.quantity = quantity(g, name, *value);
                    found.detail = not_zero(&found, |name| symbols.iter().any(|s| s == name));
                }
                Verdict::Refuted(found)
            }
            other => other,
        }
    }

    /// The generic rank of a matrix with at least one row on `manifold`, with independent rows and columns and the verdicts
    /// on both bounds.
    ///
    /// # Errors
    /// The verdict `undecided` that says what was tried.
    pub fn rank(
        &self,
        system: &System,
        matrix: &[Vec<Expr>],
        manifold: &Manifold,
    ) -> Result<GenericRank, Box<Verdict>> {
        let (g, entries) = (&system.graph, matrix.concat());
        let manifold = &*system.with_names(&entries, manifold);
        let assumptions = assumptions(system);
        let rank = |entries: &[Expr], manifold: &Manifold| {
            let test = RankTest {
                rows: matrix.len(),
                columns: matrix.first().map_or(0, Vec::len),
                entries,
                solved: &manifold.solved,
                implicit: &manifold.implicit,
                assumptions: &assumptions,
                options: self.options(),
            };
            generic_rank(g, &test)
        };
        let found = rank(&entries, manifold)?;
        let values = stated_among(system, &[&entries[..], &manifold.expressions()].concat());
        let falls = |values: &[(Expr, Expr)]| {
            let own = rank(
                &g.substitute_all(&entries, values),
                &manifold.substituted(g, values),
            );
            own.is_ok_and(|own| (own.minimum, own.maximum) != (found.minimum, found.maximum))
        };
        if !values.is_empty() && falls(&values) {
            let pivots = &found.pivots;
            let zeros = |own: &[Expr]| {
                let row = |&i: &usize| pivots.columns.iter().map(|&j| matrix[i][j]).collect();
                let minor: Vec<Vec<Expr>> = pivots.rows.iter().map(row).collect();
                match minor.len() {
                    0 => Vec::new(),
                    size if size > LARGEST_DETERMINANT => Vec::new(),
                    _ => common_zeros(system, &[determinant(g, &minor)], manifold, own),
                }
            };
            self.exceptional
                .add_stated(conditions_that_matter(g, &values, zeros, falls));
        }
        Ok(found)
    }

    /// Decides whether a square matrix is nonsingular at almost every point of `manifold`; `what` names its determinant.
    /// Parameters are arbitrary but where the model gives them the value zero: a matrix that is singular for it is.
    pub fn nonsingular(
        &self,
        system: &System,
        matrix: &[Vec<Expr>],
        manifold: &Manifold,
        what: &str,
    ) -> Verdict {
        let size = matrix.len();
        let rank = match self.rank(system, matrix, manifold) {
            Ok(rank) => rank,
            Err(verdict) => {
                let found = self.determinant_at_a_point(system, matrix, manifold, what);
                return found.unwrap_or(*verdict);
            }
        };
        if rank.minimum == size {
            if let Some(refuted) = self.singular_as_stated(system, matrix, manifold, what) {
                return refuted;
            }
            return match rank.at_least {
                Verdict::Proved(mut proof) => {
                    proof.on = located("outside its zeros", "almost everywhere", system);
                    proof.detail = format!("{what} does not vanish identically: {}", proof.detail);
                    Verdict::Proved(proof)
                }
                // Not zero in a field whose generators may be related, as exp of a dependent velocity is to others.
                other => self
                    .determinant_at_a_point(system, matrix, manifold, what)
                    .unwrap_or(other),
            };
        }
        match rank.at_most {
            Verdict::Proved(_) if rank.maximum == size => self
                .determinant_at_a_point(system, matrix, manifold, what)
                .map_or_else(
                    || differing(what, &rank),
                    |found| on_components(what, &rank, found),
                ),
            Verdict::Proved(proof) => rank_counterexample(what, size, rank.maximum, &proof.detail),
            other => other,
        }
    }

    /// A matrix that is singular for the parameters whose stated value is zero, as a mass may be.
    fn singular_as_stated(
        &self,
        system: &System,
        matrix: &[Vec<Expr>],
        manifold: &Manifold,
        what: &str,
    ) -> Option<Verdict> {
        let g = &system.graph;
        let occurring = g.reachable(&matrix.concat());
        let mut zeros = system.parameter_values();
        zeros.retain(|(parameter, value)| g.is_zero(*value) && occurring.contains(parameter));
        if zeros.is_empty() {
            return None;
        }
        let rows: Vec<Vec<Expr>> = matrix
            .iter()
            .map(|row| g.substitute_all(row, &zeros))
            .collect();
        let rank = self
            .rank(system, &rows, &manifold.substituted(g, &zeros))
            .ok()?;
        let proof = match rank.at_most {
            Verdict::Proved(proof) if rank.maximum < matrix.len() => proof,
            _ => return None,
        };
        let names: Vec<String> = zeros
            .iter()
            .map(|&(p, _)| format!("{} = 0", g.text(p)))
            .collect();
        let what = format!("{what} with {}, as the model states it,", names.join(", "));
        Some(rank_counterexample(
            &what,
            matrix.len(),
            rank.maximum,
            &proof.detail,
        ))
    }

    /// Where points in a prime field say nothing, as the constraints have none (they are transcendental) or the generators
    /// of the matrix may be related: `proved` by a real point at which the determinant is enclosed away from zero, for the
    /// component of the constraints on which it lies. `None` where no such point was found.
    pub fn determinant_at_a_point(
        &self,
        system: &System,
        matrix: &[Vec<Expr>],
        manifold: &Manifold,
        what: &str,
    ) -> Option<Verdict> {
        if matrix.len() > LARGEST_DETERMINANT {
            return None;
        }
        let determinant = determinant(&system.graph, matrix);
        match self.identity(system, &[determinant], manifold, "") {
            Verdict::Refuted(found)
            | Verdict::Conditional {
                counterexample: Some(found),
                ..
            } => {
                let mut proof = Proof::exact(
                    located(
                        "outside its zeros",
                        "almost everywhere on the component of a point found",
                        system,
                    ),
                    format!("{what} does not vanish identically: {}", found.detail),
                );
                proof.detail = proof.detail.replace("the residual", "its value");
                Some(Verdict::Proved(proof))
            }
            _ => None,
        }
    }

    /// The verdict on independence when some constraints were left out and `rank` independent ones kept.
    pub fn dependent_rows(&self, left_out: LeftOut, rank: usize) -> Verdict {
        let names = left_out.quoted();
        let (follow, are, do_not) = if left_out.names.len() == 1 {
            ("follows", "is", "does not")
        } else {
            ("follow", "are", "do not")
        };
        match left_out.follows {
            Verdict::Proved(proof) => Verdict::Refuted(Counterexample {
                point: Vec::new(),
                quantity: "constraints minus rank".into(),
                residual: (left_out.names.len().to_string(), left_out.names.len().to_string()),
                detail: format!(
                    "the rank is {rank}: {names} {follow} from the other constraints and {are} left out ({})",
                    proof.detail
                ),
            }),
            Verdict::Refuted(counterexample) => Verdict::Refuted(Counterexample {
                detail: format!(
                    "the gradients of {names} depend on those of the other constraints, but {names} {do_not} vanish where those do: they contradict each other except on a subset"
                ),
                ..counterexample
            }),
            Verdict::Numerical(evidence) => Verdict::undecided(format!(
                "at {} computed states the rank is {rank}, and {names} {follow} from the other constraints there to {:.0e}; this is no proof",
                evidence.samples, evidence.residual
            )),
            other => other,
        }
    }
}

/// The parameters by which dependent velocities follow from the others: with other values the point would not be admissible.
fn parameters_of(system: &System, manifold: &Manifold, symbols: &[Symbol]) -> Vec<Symbol> {
    let g = &system.graph;
    let own = |s: &Symbol| symbols.contains(s);
    let solved = manifold.solved.iter().filter(|(s, _)| own(s));
    let all: Vec<Expr> = solved
        .map(|(_, e)| *e)
        .chain(manifold.implicit.iter().map(|(f, _)| *f))
        .collect();
    let parameters = system.parameters.iter().filter_map(|p| g.as_symbol(p.expr));
    let occurring = g.symbols_in(&all);
    let parameters = parameters.filter(|s| occurring.contains(s) && !own(s));
    parameters.collect()
}

/// A refutation whose point is one, by substitution into the system as it is written.
fn checked(system: &System, residuals: &[Expr], manifold: &Manifold, verdict: Verdict) -> Verdict {
    let Verdict::Refuted(found) = &verdict else {
        return verdict;
    };
    let is_admissible = !manifold.solved.is_empty() || !manifold.implicit.is_empty();
    match counterexample::check(system, residuals, found, is_admissible) {
        Ok(()) => verdict,
        Err(violation) => Verdict::undecided(format!(
            "{}; but where that was found {violation}",
            found.detail
        )),
    }
}

/// The parameters with the values that the model states for them, of those that occur.
fn stated_among(system: &System, es: &[Expr]) -> Vec<(Expr, Expr)> {
    let occurring = system.graph.symbols_in(es);
    let mut values = system.parameter_values();
    values.retain(|&(p, _)| {
        system
            .graph
            .as_symbol(p)
            .is_some_and(|s| occurring.contains(&s))
    });
    values
}

/// Of the values at which something is so those without which it is not; where they are several, the condition on parameters in their
/// place for which it is so already, if one is found: a = b where 2 is stated for both. Tried are the `candidates` for the parameters that
/// matter, and for two of them the ratio of their values.
pub fn conditions_that_matter(
    g: &Graph,
    values: &[(Expr, Expr)],
    candidates: impl Fn(&[Expr]) -> Vec<(Expr, Expr)>,
    is_so: impl Fn(&[(Expr, Expr)]) -> bool,
) -> Vec<(Expr, Expr)> {
    let mut own = values.to_vec();
    for pair in values {
        let fewer: Vec<(Expr, Expr)> = own.iter().copied().filter(|other| other != pair).collect();
        if !fewer.is_empty() && is_so(&fewer) {
            own = fewer;
        }
    }
    if own.len() < 2 {
        return own;
    }
    let parameters: Vec<Expr> = own.iter().map(|&(parameter, _)| parameter).collect();
    let mut all = candidates(&parameters);
    match own.as_slice() {
        &[(a, of_a), (b, of_b)] if !g.is_zero(of_b) => {
            all.push((a, g.mul(&[g.div(of_a, of_b), b])));
        }
        _ => {}
    }
    let holds = |pair: &&(Expr, Expr)| is_stated(g, values, pair);
    let found = all.iter().filter(holds).find(|pair| is_so(&[**pair]));
    found.map_or(own, |pair| vec![*pair])
}

/// Whether a condition on parameters holds for the values stated.
pub fn is_stated(g: &Graph, values: &[(Expr, Expr)], &(parameter, value): &(Expr, Expr)) -> bool {
    let difference = g.substitute(g.sub(parameter, value), values);
    g.is_zero(difference)
}

/// Conditions (parameter, what it is) for which all functions vanish whatever else has which value, as k = 0, 1 and −1 for (k² − 1) k x y
/// and a = b for (a − b) x: the common factors that contain these parameters alone, where they are of first degree in one.
fn common_zeros(
    system: &System,
    residuals: &[Expr],
    manifold: &Manifold,
    parameters: &[Expr],
) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let solved: Vec<(Expr, Expr)> = manifold
        .solved
        .iter()
        .map(|&(s, e)| (g.symbol_expr(s), e))
        .collect();
    let symbols: Vec<Symbol> = parameters.iter().filter_map(|&p| g.as_symbol(p)).collect();
    let is_own = |f: &Expr| g.symbols_in(&[*f]).iter().all(|s| symbols.contains(s));
    let factors = |e: Expr| -> Option<BTreeSet<Expr>> {
        // What is solved for may occur in what others are solved by.
        let e = solved.iter().fold(e, |e, _| g.substitute(e, &solved));
        let list = irreducible_factors(g, e, &symbols)?.into_iter();
        Some(list.map(|(f, _)| f).filter(is_own).collect())
    };
    let zero = |factor: Expr| -> Option<(Expr, Expr)> {
        symbols.iter().find_map(|&symbol| {
            let parameter = g.symbol_expr(symbol);
            let slope = g.diff(factor, symbol);
            let rest = g.substitute(factor, &[(parameter, g.zero())]);
            g.as_number(slope)?;
            Some((parameter, g.neg(g.div(rest, slope))))
        })
    };
    let nonzero = residuals.iter().filter(|&&e| !g.is_zero(e));
    let all = nonzero.map(|&e| factors(e).unwrap_or_default());
    let common = all.reduce(|a, b| a.intersection(&b).copied().collect());
    common
        .unwrap_or_default()
        .into_iter()
        .filter_map(zero)
        .collect()
}

/// The value of a parameter at a point: as it is stated where that is rational, else between bounds in double precision.
fn stated(g: &Graph, &(parameter, value): &(Expr, Expr)) -> PointValue {
    let exact = g.as_number(value).cloned();
    let number = g.evaluate_f64(&[value], &|_| None).ok();
    let enclosure = number.and_then(|x| x.first().copied()).map(|x| {
        let width = 4.0 * f64::EPSILON * x.abs();
        (format!("{:e}", x - width), format!("{:e}", x + width))
    });
    PointValue {
        name: g.text(parameter),
        enclosure: enclosure.filter(|_| exact.is_none()),
        exact,
    }
}

/// Formulas of more signs are named, not written out.
const WRITTEN: usize = 120;

/// `Q_x = -2 x'`.
fn quantity(g: &Graph, name: &str, value: Expr) -> String {
    let text = g.text(value);
    // A linear system that is only stated takes lines of its own.
    match text.chars().count() <= WRITTEN && !text.contains('\n') {
        true => format!("{name} = {text}"),
        false => name.to_owned(),
    }
}

/// Which of several residuals a counterexample is about: the zero test numbers them from 1.
fn place_of(found: &Counterexample) -> usize {
    let number = found.quantity.strip_prefix("residual ");
    let number = number.and_then(|rest| rest.split(' ').next()?.parse::<usize>().ok());
    number.map_or(0, |number| number - 1)
}

/// What a counterexample shows, with its point as far as `is_relevant` says.
fn not_zero(found: &Counterexample, is_relevant: impl Fn(&str) -> bool) -> String {
    let (lower, upper) = &found.residual;
    let size = match lower == upper {
        true => format!("is {lower}"),
        false => format!("lies between {lower} and {upper}"),
    };
    let point = words::point(found, is_relevant);
    let place = match point.is_empty() {
        true => "everywhere".into(),
        false => format!("at {point}"),
    };
    format!("{} does not vanish: it {size} {place}", found.quantity)
}

/// Cofactors of a larger matrix are too many.
const LARGEST_DETERMINANT: usize = 8;

/// Where a proof holds: the product's words first, then what the zero test adds, then the model's assumptions.
pub(crate) fn located(found: &str, on: &str, system: &System) -> String {
    let mut place = on.to_string();
    if let Some((_, conditions)) = found.split_once("that is ") {
        place.push_str(", where ");
        place.push_str(conditions);
    } else if found == "outside its zeros" {
        place.push_str(", outside the zeros of the determinant");
    } else {
        place.push_str(", wherever both sides are defined");
    }
    if !system.assumptions.is_empty() {
        let texts = system.assumption_texts();
        place.push_str(&format!("; assuming {}", texts.join(", ")));
    }
    place
}

/// A matrix whose determinant vanishes identically: every state is a counterexample.
/// The constraints have components, and a matrix is regular on some of them only.
fn on_components(what: &str, rank: &GenericRank, found: Verdict) -> Verdict {
    match found {
        Verdict::Proved(proof) => Verdict::Conditional {
            condition: format!(
                "on those components of the constraints on which {what} does not vanish; on others the rank is {} of {}",
                rank.minimum, rank.maximum
            ),
            proof,
            counterexample: None,
        },
        _ => differing(what, rank),
    }
}

fn differing(what: &str, rank: &GenericRank) -> Verdict {
    Verdict::undecided(format!(
        "{what} vanishes on some components of the constraints and not on others: ranks from {} to {} were found modulo primes",
        rank.minimum, rank.maximum
    ))
}

fn rank_counterexample(what: &str, size: usize, rank: usize, detail: &str) -> Verdict {
    let missing = (size - rank).to_string();
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        quantity: "size of the matrix minus its rank, at every state".into(),
        residual: (missing.clone(), missing),
        detail: format!("{what} vanishes identically: rank {rank} of {size} ({detail})"),
    })
}
