//! The closure algorithm of T1 §4.3: all linear conditions on the multipliers κ of the constrained extremum under which a motion
//! is an extremal.

use super::closed_form::short;
use crate::words::{listed, readable};
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::formulation::{basis, derive, REFERENCE};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::formulations::{kappa_symbols, Basis, DeriveError};
use chetaev_mechanics::{Equations, Manifold};
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::zero::{GenericRank, Pivots};
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};
use std::sync::Arc;

/// A condition `Σ coefficient_l κ_l = right` on the multipliers of the extremum at a state.
#[derive(Clone, Debug)]
pub struct Condition {
    /// One coefficient for each selected constraint, functions of (q, v, t).
    pub coefficients: Vec<Expr>,
    /// The right side.
    pub right: Expr,
}

/// The closure algorithm of T1 §4.3: all linear conditions on κ under which a motion is an extremal.
///
/// The conditions (12), `Σ_l κ_l Σ_i E_i[f^l] B_is = 0` with the accelerations of the motion, are differentiated along it with
/// (13), `κ' = Φ κ − λ`, where `Σ_l κ_l E_i[f^l] = Σ_m (Φ κ)_m ∂f^m/∂vⁱ` on the dependent velocities: a row (n, b) gives
/// `(X n + n Φ) κ = X b + n·λ`. Only independent rows are differentiated, since derivatives of the others follow. It ends when
/// the rank does not grow, after at most r steps that increase it.
#[derive(Clone, Debug)]
pub struct Closure {
    /// Independent conditions that imply all others, where consistent.
    pub conditions: Vec<Condition>,
    /// Places of as many multipliers, for which the conditions can be solved; the others may be chosen.
    pub columns: Vec<usize>,
    /// The number of constants of κ(0) that the conditions leave free.
    pub free: usize,
    /// κ of the selected constraints as functions of (q, v, t), those that the conditions determine.
    pub kappa: Vec<Option<Expr>>,
    /// `proved`: consistent at almost every admissible state. `refuted`: a state at which they contradict each other.
    pub verdict: Verdict,
}

/// What κ satisfies along a motion that is an extremal: `Σ_l κ_l E[f^l]·δq = 0` (12) and `κ' = Φ κ − λ` (13), functions of (q, v, t).
#[derive(Clone, Debug)]
pub struct Transport {
    /// The coefficients of κ in (12), one row for each independent virtual displacement.
    pub conditions: Vec<Vec<Expr>>,
    /// Φ, row by row.
    pub matrix: Vec<Vec<Expr>>,
    /// λ of the selected constraints.
    pub multipliers: Vec<Expr>,
}

impl Transport {
    /// (12) and (13) for the context's system.
    ///
    /// # Errors
    /// [`DeriveError`] when the equations of motion or the virtual displacements cannot be derived.
    pub fn new(cx: &Context<'_>) -> Result<Transport, DeriveError> {
        let flow = Flow::new(cx)?;
        let conditions = flow.first_conditions(cx).into_iter();
        Ok(Transport {
            conditions: conditions.map(|c| c.coefficients).collect(),
            matrix: flow.transport,
            multipliers: flow.multipliers,
        })
    }
}

/// More nodes than this are not made by one closure.
const LARGEST_GROWTH: usize = 100_000;

/// A condition that is to follow from others, with its place.
const MORE: &str = "condition ";
/// Functions of more signs are not simplified for a sentence.
const LARGEST_SHOWN: u64 = 1_000;
/// Longer functions are not written in a sentence.
const LONGEST_SHOWN: usize = 160;

/// The closure of a system, found once for all claims.
type Found = Result<Closure, DeriveError>;

impl Closure {
    /// The closure for the context's system, found once for all claims; it may be a [`DeriveError`], as [`Closure::new`].
    pub fn of(cx: &Context<'_>) -> Arc<Found> {
        cx.shared(|cx| Closure::new(cx))
    }

    /// Closes the conditions for the context's system.
    ///
    /// # Errors
    /// [`DeriveError`] when the equations of motion or the virtual displacements cannot be derived.
    pub fn new(cx: &Context<'_>) -> Result<Closure, DeriveError> {
        let flow = Flow::new(cx)?;
        let mut closure = Closure {
            conditions: Vec::new(),
            columns: Vec::new(),
            free: cx.selection.rows.len(),
            kappa: vec![None; cx.selection.rows.len()],
            verdict: nothing_to_show(),
        };
        let limit = cx.system.graph.node_count() + LARGEST_GROWTH;
        let mut fresh = flow.first_conditions(cx);
        while !fresh.is_empty() {
            if cx.system.graph.node_count() > limit {
                closure.verdict =
                    Verdict::undecided("derivatives of the conditions on κ grow too large");
                return Ok(closure);
            }
            let known = closure.conditions.len();
            closure.append(cx, &flow, fresh)?;
            if !matches!(closure.verdict, Verdict::Proved(_)) {
                return Ok(closure);
            }
            fresh = flow.derive(cx, &closure.conditions[known..]);
        }
        closure.free = cx.selection.rows.len() - closure.conditions.len();
        closure.kappa = determined(cx, &flow.manifold, &closure.conditions, &closure.columns)?;
        Ok(closure)
    }

    /// The conditions solved for the multipliers at [`columns`](Closure::columns): `κ_l = right − Σ coefficient κ` over the others, with
    /// the coefficient 1 of κ_l itself.
    ///
    /// # Errors
    /// [`DeriveError`] where the linear system cannot be written.
    pub(crate) fn solved(&self, cx: &Context<'_>) -> Result<Vec<(usize, Condition)>, DeriveError> {
        let g = &cx.system.graph;
        let r = cx.selection.rows.len();
        let mut solved: Vec<(usize, Condition)> = Vec::new();
        let values = solve(cx, &self.conditions, &self.columns)?;
        for (&l, right) in self.columns.iter().zip(values) {
            let mut coefficients = vec![g.zero(); r];
            coefficients[l] = g.one();
            let condition = Condition {
                coefficients,
                right,
            };
            solved.push((l, condition));
        }
        for free in (0..r).filter(|l| !self.columns.contains(l)) {
            let right: Vec<Expr> = self
                .conditions
                .iter()
                .map(|c| c.coefficients[free])
                .collect();
            let slopes = solve_for(cx, &self.conditions, &self.columns, &right)?;
            for ((_, condition), slope) in solved.iter_mut().zip(slopes) {
                condition.coefficients[free] = slope;
            }
        }
        Ok(solved)
    }

    /// Keeps the new conditions that are independent of the known ones, and decides whether the others follow.
    fn append(
        &mut self,
        cx: &Context<'_>,
        flow: &Flow,
        fresh: Vec<Condition>,
    ) -> Result<(), DeriveError> {
        let manifold = &flow.manifold;
        let known = self.conditions.len();
        let mut all = std::mem::take(&mut self.conditions);
        all.extend(fresh);
        let matrix: Vec<Vec<Expr>> = all.iter().map(|c| c.coefficients.clone()).collect();
        let rank = match cx.prover.rank(cx.system, &matrix, manifold) {
            Ok(rank) if rank.minimum == rank.maximum => rank,
            Ok(_) => {
                self.verdict = Verdict::undecided(
                    "the conditions on κ have different ranks on the components of the constraints",
                );
                return Ok(());
            }
            Err(verdict) => {
                self.verdict = *verdict;
                return Ok(());
            }
        };
        let independent: Vec<Condition> = rank
            .pivots
            .rows
            .iter()
            .map(|&row| all[row].clone())
            .collect();
        let values = solve(cx, &independent, &rank.pivots.columns)?;
        let dependent = (known..all.len()).filter(|row| !rank.pivots.rows.contains(row));
        let differences: Vec<Expr> = dependent
            .map(|row| difference(cx, &all[row], &rank.pivots.columns, &values))
            .collect();
        let on = "on the constraint manifold, for almost every motion";
        let named = differences.iter().enumerate();
        let named: Vec<(String, Expr)> = named
            .map(|(place, &difference)| (format!("{MORE}{place}"), difference))
            .collect();
        let mut follow = cx.prover.named_identity(cx.system, &named, manifold, on);
        if let Verdict::Refuted(found) = &mut follow {
            let kappa: Vec<(usize, Expr)> =
                rank.pivots.columns.iter().copied().zip(values).collect();
            flow.explain(cx, found, &differences, &kappa);
        }
        self.verdict = match (follow, full_rank(cx, manifold, &matrix, &rank)) {
            (Verdict::Proved(mut follow), Verdict::Proved(mut ranks)) => {
                let generic = matches!(rank.at_least, Verdict::Proved(_));
                // The rank is that at almost every state: its place is contained in the other one. One found at a point is
                // that on the component of the point, and so is what follows.
                match generic {
                    true => ranks.on.clone_from(&follow.on),
                    false => follow.on.clone_from(&ranks.on),
                }
                Verdict::Proved(follow).and(Verdict::Proved(ranks))
            }
            (follow, ranks) => follow.and(ranks),
        };
        self.conditions = independent;
        self.columns = rank.pivots.columns;
        Ok(())
    }
}

/// That the pivots are independent, and that no other rows are. Where functions like cosh of a dependent velocity leave the first
/// open, since it may be related to others, a state is looked for at which the minor is enclosed away from zero.
fn full_rank(
    cx: &Context<'_>,
    manifold: &Manifold,
    matrix: &[Vec<Expr>],
    rank: &GenericRank,
) -> Verdict {
    let generic = rank.at_least.clone();
    let at_least = match generic {
        Verdict::Undecided { .. } => {
            let Pivots { rows, columns } = &rank.pivots;
            let entries = |&row: &usize| columns.iter().map(|&l| matrix[row][l]).collect();
            let minor: Vec<Vec<Expr>> = rows.iter().map(entries).collect();
            let what = "a minor of the conditions on κ";
            cx.prover
                .determinant_at_a_point(cx.system, &minor, manifold, what)
                .unwrap_or(generic)
        }
        known => known,
    };
    at_least.and(rank.at_most.clone())
}

fn nothing_to_show() -> Verdict {
    Verdict::Proved(Proof::structural(
        "on the constraint manifold",
        "there are no virtual displacements, so nothing is demanded of κ",
    ))
}

/// κ at the columns given, the others zero, from as many conditions.
fn solve(
    cx: &Context<'_>,
    conditions: &[Condition],
    columns: &[usize],
) -> Result<Vec<Expr>, DeriveError> {
    let right: Vec<Expr> = conditions.iter().map(|c| c.right).collect();
    solve_for(cx, conditions, columns, &right)
}

/// The square system of conditions at the columns given, with other right sides.
fn solve_for(
    cx: &Context<'_>,
    conditions: &[Condition],
    columns: &[usize],
    right: &[Expr],
) -> Result<Vec<Expr>, DeriveError> {
    let matrix: Vec<Expr> = conditions
        .iter()
        .flat_map(|c| columns.iter().map(|&l| c.coefficients[l]))
        .collect();
    Ok(cx.system.graph.solve(&matrix, right)?)
}

/// The multipliers that the conditions determine: those that do not change with the free ones.
fn determined(
    cx: &Context<'_>,
    manifold: &Manifold,
    conditions: &[Condition],
    columns: &[usize],
) -> Result<Vec<Option<Expr>>, DeriveError> {
    let r = cx.selection.rows.len();
    let mut kappa = vec![None; r];
    let mut slopes: Vec<Vec<Expr>> = vec![Vec::new(); columns.len()];
    for free in (0..r).filter(|l| !columns.contains(l)) {
        let right: Vec<Expr> = conditions.iter().map(|c| c.coefficients[free]).collect();
        for (row, slope) in slopes
            .iter_mut()
            .zip(solve_for(cx, conditions, columns, &right)?)
        {
            row.push(slope);
        }
    }
    let values = solve(cx, conditions, columns)?;
    for ((&l, value), slopes) in columns.iter().zip(values).zip(slopes) {
        let verdict = cx.prover.identity(cx.system, &slopes, manifold, "");
        if matches!(verdict, Verdict::Proved(_)) {
            kappa[l] = Some(value);
        }
    }
    Ok(kappa)
}

/// Left minus right side of a condition.
fn difference(cx: &Context<'_>, condition: &Condition, columns: &[usize], values: &[Expr]) -> Expr {
    let g = &cx.system.graph;
    let mut parts = vec![g.neg(condition.right)];
    for (&l, &value) in columns.iter().zip(values) {
        parts.push(g.mul(&[condition.coefficients[l], value]));
    }
    g.add(&parts)
}

/// The flow of the motions with what (12) and (13) need along it.
pub(crate) struct Flow {
    pub(crate) routh: Equations,
    manifold: Manifold,
    /// `E_i[f^l]` with the accelerations of the motion, one row for each selected constraint.
    pub(crate) euler: Vec<Vec<Expr>>,
    /// B, row by row.
    admissible: Vec<Vec<Expr>>,
    /// Φ, row by row.
    transport: Vec<Vec<Expr>>,
    /// λ of the selected constraints.
    pub(crate) multipliers: Vec<Expr>,
}

impl Flow {
    pub(crate) fn new(cx: &Context<'_>) -> Result<Flow, DeriveError> {
        let basis = basis(cx);
        let routh = derive(cx, REFERENCE)?;
        let characteristics = basis.independent_velocities()?;
        let euler = euler(&basis, &routh);
        let transport = transport(&basis, &euler, &characteristics.dependent)?;
        Ok(Flow {
            multipliers: routh.multipliers.iter().map(|&(_, value)| value).collect(),
            admissible: characteristics.basis,
            manifold: characteristics.manifold,
            euler,
            transport,
            routh,
        })
    }

    /// (12), one condition for each independent virtual displacement.
    fn first_conditions(&self, cx: &Context<'_>) -> Vec<Condition> {
        let g = &cx.system.graph;
        let k = self.admissible.first().map_or(0, Vec::len);
        (0..k)
            .map(|s| Condition {
                coefficients: self
                    .euler
                    .iter()
                    .map(|row| {
                        let terms = row.iter().zip(&self.admissible);
                        let parts: Vec<Expr> = terms.map(|(&e, b)| g.mul(&[e, b[s]])).collect();
                        g.add(&parts)
                    })
                    .collect(),
                right: g.zero(),
            })
            .collect()
    }

    /// Says of a contradiction which function would have to vanish, with the κ and λ that were used, as far as they are short.
    fn explain(
        &self,
        cx: &Context<'_>,
        found: &mut Counterexample,
        differences: &[Expr],
        kappa: &[(usize, Expr)],
    ) {
        let g = &cx.system.graph;
        let place = found.quantity.strip_prefix(MORE);
        let place = place.and_then(|rest| rest.split(' ').next()?.parse::<usize>().ok());
        let solved: Vec<(Expr, Expr)> = self
            .manifold
            .solved
            .iter()
            .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
            .collect();
        let text = |e: Expr| -> Option<String> {
            let on_states = g.substitute(e, &solved);
            if simplify::length(g, on_states) > LARGEST_SHOWN {
                return None;
            }
            let text = g.text(readable(cx, short(g, on_states))?);
            (text.chars().count() <= LONGEST_SHOWN && !text.contains('\n')).then_some(text)
        };
        let basis = basis(cx);
        let symbols = kappa_symbols(&basis);
        let names = basis.constraint_names();
        let mut used: Vec<String> = kappa
            .iter()
            .filter_map(|&(l, value)| Some(format!("{} = {}", g.text(symbols[l]), text(value)?)))
            .collect();
        let reactions = names.into_iter().zip(&self.multipliers);
        used.extend(reactions.filter_map(|(name, &value)| {
            let value = text(value)?;
            Some(format!("the reaction λ of `{name}` = {value}"))
        }));
        let with = match used.is_empty() {
            true => "the κ that the others demand".to_string(),
            false => format!("{} by the others and the motion", listed(&used)),
        };
        let function = place.and_then(|place| text(*differences.get(place)?));
        let quantity = match function {
            Some(function) => format!(
                "{function}, the left side less the right side of one more condition on κ with {with},"
            ),
            None => format!("the left side less the right side of one more condition on κ, with {with},"),
        };
        found.detail = found.detail.replacen(&found.quantity, &quantity, 1);
        found.quantity = quantity;
    }

    /// The derivatives of conditions along the motion.
    fn derive(&self, cx: &Context<'_>, conditions: &[Condition]) -> Vec<Condition> {
        let g = &cx.system.graph;
        let r = self.multipliers.len();
        let flat: Vec<Expr> = conditions
            .iter()
            .flat_map(|c| c.coefficients.iter().copied().chain([c.right]))
            .collect();
        let moved = self.along(cx, &flat);
        conditions
            .iter()
            .zip(moved.chunks(r + 1))
            .map(|(condition, moved)| {
                let n = &condition.coefficients;
                let coefficients = (0..r)
                    .map(|l| {
                        let mut parts = vec![moved[l]];
                        for (&n_m, row) in n.iter().zip(&self.transport) {
                            parts.push(g.mul(&[n_m, row[l]]));
                        }
                        g.add(&parts)
                    })
                    .collect();
                let mut right = vec![moved[r]];
                for (&n_m, &lambda) in n.iter().zip(&self.multipliers) {
                    right.push(g.mul(&[n_m, lambda]));
                }
                Condition {
                    coefficients,
                    right: g.add(&right),
                }
            })
            .collect()
    }

    /// Rates along the motion of functions of (q, v, t).
    fn along(&self, cx: &Context<'_>, es: &[Expr]) -> Vec<Expr> {
        let symbols = cx.system.velocity_symbols().into_iter();
        let rates: Vec<(Symbol, Expr)> = symbols
            .zip(self.routh.accelerations.iter().copied())
            .collect();
        let one = cx.system.graph.one();
        derive_along(cx.system, es, &self.routh.velocities, one, &rates)
    }
}

/// `E_i[f^l] = ∂f^l/∂qⁱ − D ∂f^l/∂vⁱ` with the accelerations of the motion.
fn euler(basis: &Basis<'_>, routh: &Equations) -> Vec<Vec<Expr>> {
    let (system, g) = (basis.system, &basis.system.graph);
    let slopes = g.jacobian(&basis.constraints(), &system.coordinate_symbols());
    let jacobian = basis.jacobian();
    let symbols = system.velocity_symbols().into_iter();
    let rates: Vec<(Symbol, Expr)> = symbols.zip(routh.accelerations.iter().copied()).collect();
    let flat = jacobian.concat();
    let moved = derive_along(system, &flat, &routh.velocities, g.one(), &rates);
    slopes
        .iter()
        .zip(moved.chunks(system.n()))
        .map(|(slopes, moved)| {
            let entries = slopes.iter().zip(moved);
            entries
                .map(|(&slope, &moved)| g.sub(slope, moved))
                .collect()
        })
        .collect()
}

/// Φ: `Σ_m ∂f^m/∂v_d Φ_ml = E_d[f^l]` for the dependent velocities d.
fn transport(
    basis: &Basis<'_>,
    euler: &[Vec<Expr>],
    dependent: &[usize],
) -> Result<Vec<Vec<Expr>>, DeriveError> {
    let g = &basis.system.graph;
    let jacobian = basis.jacobian();
    let matrix: Vec<Expr> = dependent
        .iter()
        .flat_map(|&d| jacobian.iter().map(move |row| row[d]))
        .collect();
    let columns = euler
        .iter()
        .map(|row| {
            let right: Vec<Expr> = dependent.iter().map(|&d| row[d]).collect();
            Ok(g.solve(&matrix, &right)?)
        })
        .collect::<Result<Vec<Vec<Expr>>, DeriveError>>()?;
    Ok((0..jacobian.len())
        .map(|m| columns.iter().map(|column| column[m]).collect())
        .collect())
}
