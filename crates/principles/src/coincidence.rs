//! `formulation.vakonomic-coincides`: the constrained extremum beside the equations of motion (T1 §4.1–4.3).
//!
//! The equations of the extremum, `D(∂L/∂v) − ∂L/∂q = Σ κ E[f] − Σ κ' ∂f/∂v`, have r constants κ(0) more than the equations
//! of motion. Two questions are kept apart: whether the two *systems* are equal, that is, the accelerations for all κ, and
//! whether every motion is *among* the extremals, that is, for some κ(t). The second is decided by [`Closure`].

use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::formulation::{basis, derive, manifold, residuals, REFERENCE};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::{extremum_matrix, kappa_symbols, Basis, DeriveError};
use chetaev_mechanics::{Equations, Manifold};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};

/// `formulation.vakonomic-coincides`.
#[derive(Clone, Copy, Debug)]
pub struct VakonomicCoincides;

/// The subject: every solution of each system solves the other one.
const SYSTEM: &str = "system";
/// The subject: every motion is an extremal.
const INCLUSION: &str = "inclusion";
/// The formulation.
const VAKONOMIC: &str = "vakonomic";

impl Claim for VakonomicCoincides {
    fn id(&self) -> &'static str {
        "formulation.vakonomic-coincides"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "Motions are extremals of the action under the constraints"
    }

    fn explanation(&self) -> &'static str {
        "The equations of the constrained extremum (\"vakonomic\") make ∫(L + Σ κ f) dt stationary; they are not the equations of \
         motion in general. `system`: the accelerations of both agree for all multipliers κ at every admissible state, outside \
         the set where the extremum does not determine them. For constraints linear or affine in the velocities this is so \
         exactly where the constraints are integrable (Kerner). `inclusion`: every motion solves the equations of the extremum \
         with some κ(t). It demands Σ κ E[f]·δq = 0 for virtual δq and κ' = ρ − λ; these linear conditions are \
         differentiated along the motion until no new ones appear. `proved` says how many constants of κ(0) stay free, and κ \
         where it is unique; `refuted` comes with a state at which the conditions contradict each other. Inclusion is weaker \
         than equality: κ = 0 alone would need all reactions to vanish."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let mut hypotheses = vec![
            "model.forces-absent",
            "model.accelerations-unique",
            "model.masses-of-time",
        ];
        if subject == Some(SYSTEM) {
            hypotheses.push("model.constrained-extremum-regular");
        }
        hypotheses.into_iter().map(String::from).collect()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let subjects: &[&str] = if cx.terms.constraints.is_empty() {
            &[]
        } else {
            &[SYSTEM, INCLUSION]
        };
        subjects.iter().map(|s| Some((*s).to_string())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        match subject {
            _ if cx.terms.constraints.is_empty() => {
                let detail = "without constraints both are Lagrange's equations";
                Verdict::Proved(Proof::structural("everywhere", detail)).into()
            }
            Some(SYSTEM) => systems_agree(cx),
            Some(INCLUSION) => motions_are_extremals(cx),
            other => {
                let asked = other.unwrap_or("no subject");
                Verdict::undecided(format!("`{asked}` is neither `{SYSTEM}` nor `{INCLUSION}`"))
                    .into()
            }
        }
    }
}

/// Accelerations of both systems for all κ.
fn systems_agree(cx: &Context<'_>) -> Finding {
    let derived = derive(cx, REFERENCE).and_then(|a| Ok((a, derive(cx, VAKONOMIC)?)));
    let (routh, extremum) = match derived {
        Ok(pair) => pair,
        Err(problem) => return underived(&problem),
    };
    let on = "on the constraint manifold for all κ outside the singular set of the bordered matrix";
    let differences = residuals(cx, &routh, &extremum);
    let mut verdict = cx
        .prover
        .identity(cx.system, &differences, &manifold(cx), on);
    let sentence = match &verdict {
        Verdict::Proved(_) => format!("the extremals are the motions, for {}", every_kappa(cx)),
        Verdict::Refuted(_) => "the extremals are other curves than the motions for some κ".into(),
        _ => "accelerations of the extremum against those of the motion".into(),
    };
    let sentence = format!("{sentence}{}", kerner(cx, &verdict));
    prepend(&mut verdict, &sentence);
    verdict.into()
}

/// Determinants of larger matrices are not written out.
const LARGEST_DETERMINANT: usize = 8;

/// Longer equations are not printed in a sentence.
const LONGEST_EQUATION: usize = 200;

/// "every κ", less the set where the bordered matrix of the extremum (R5) is singular.
fn every_kappa(cx: &Context<'_>) -> String {
    let basis = basis(cx);
    let g = &cx.system.graph;
    let names = kappa_symbols(&basis);
    let symbols: Vec<Symbol> = names.iter().filter_map(|&e| g.as_symbol(e)).collect();
    let matrix = extremum_matrix(&basis);
    if !g.any_contains_any(&matrix.concat(), &symbols) {
        return "every κ".into();
    }
    match singular_set(cx, &matrix, &symbols) {
        None => "every κ off the singular set of [[W + Σ κ f_vv, fᵥᵀ], [fᵥ, 0]]".into(),
        Some(equations) if equations.is_empty() => "every κ".into(),
        Some(equations) => format!("every κ off the singular set {}", equations.join(" and ")),
    }
}

/// The equations with κ under which the determinant vanishes; `None` where they are too long to be read.
fn singular_set(cx: &Context<'_>, matrix: &[Vec<Expr>], symbols: &[Symbol]) -> Option<Vec<String>> {
    let g = &cx.system.graph;
    if matrix.len() > LARGEST_DETERMINANT {
        return None;
    }
    let solved: Vec<(Expr, Expr)> = manifold(cx)
        .solved
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    let value = g.substitute(determinant(g, matrix), &solved);
    let short = simplify::simplify(g, value, &simplify::Options::default());
    let equations = factors(g, short, symbols)?;
    let texts = equations
        .into_iter()
        .map(|(factor, _)| simplify::simplify(g, factor, &simplify::Options::default()))
        .map(|factor| format!("{} = 0", g.text(factor)));
    let texts: Vec<String> = texts.collect();
    let is_short = texts
        .iter()
        .all(|text| text.chars().count() <= LONGEST_EQUATION);
    is_short.then_some(texts)
}

/// What Kerner's theorem says: about linear and affine constraints only.
fn kerner(cx: &Context<'_>, verdict: &Verdict) -> String {
    let mut rows = cx.selection.rows.iter();
    let affine = rows.all(|&row| {
        cx.system.constraints[cx.terms.constraint_index[row]].is_affine_in_velocities()
    });
    match verdict {
        _ if !affine => {
            "; Kerner's theorem does not apply, since a constraint is nonlinear in the \
                         velocities"
                .into()
        }
        Verdict::Proved(_) => {
            "; by Kerner's theorem the constraints, which are linear or affine in the \
                               velocities, are completely integrable"
                .into()
        }
        Verdict::Refuted(_) => {
            "; by Kerner's theorem the constraints, which are linear or affine in the \
                                velocities, are not completely integrable"
                .into()
        }
        _ => String::new(),
    }
}

fn underived(problem: &DeriveError) -> Finding {
    Verdict::undecided(format!("the equations could not be derived: {problem}")).into()
}

/// The closure, in words.
fn motions_are_extremals(cx: &Context<'_>) -> Finding {
    let closure = match Closure::new(cx) {
        Ok(closure) => closure,
        Err(problem) => return underived(&problem),
    };
    let mut verdict = closure.verdict.clone();
    let sentence = match &verdict {
        Verdict::Proved(_) => format!(
            "every motion is an extremal for suitable κ; {}",
            free_constants(&closure)
        ),
        Verdict::Refuted(_) => {
            "through this state runs a motion for which no κ satisfies the conditions".into()
        }
        _ => "conditions on κ along the motion".to_string(),
    };
    prepend(&mut verdict, &sentence);
    Finding {
        formulas: formulas(cx, &closure),
        verdict,
    }
}

fn free_constants(closure: &Closure) -> String {
    match closure.free {
        0 => "κ is unique".into(),
        1 => "1 constant of κ(0) is free".into(),
        free => format!("{free} constants of κ(0) are free"),
    }
}

fn formulas(cx: &Context<'_>, closure: &Closure) -> Vec<Formula> {
    let basis = basis(cx);
    let g = &cx.system.graph;
    let options = simplify::Options::default();
    let solved: Vec<(Expr, Expr)> = manifold(cx)
        .solved
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    closure
        .kappa
        .iter()
        .zip(kappa_symbols(&basis))
        .zip(basis.constraint_names())
        .filter_map(|((value, symbol), name)| {
            let restricted = g.substitute((*value)?, &solved);
            Some(Formula {
                caption: format!("multiplier κ of `{name}` in the extremum, along every motion"),
                left: Some(symbol),
                right: simplify::simplify(g, restricted, &options),
            })
        })
        .collect()
}

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

/// More nodes than this are not made by one closure.
const LARGEST_GROWTH: usize = 100_000;

impl Closure {
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
            closure.append(cx, &flow.manifold, fresh)?;
            if !matches!(closure.verdict, Verdict::Proved(_)) {
                return Ok(closure);
            }
            fresh = flow.derive(cx, &closure.conditions[known..]);
        }
        closure.free = cx.selection.rows.len() - closure.conditions.len();
        closure.kappa = determined(cx, &flow.manifold, &closure.conditions, &closure.columns)?;
        Ok(closure)
    }

    /// Keeps the new conditions that are independent of the known ones, and decides whether the others follow.
    fn append(
        &mut self,
        cx: &Context<'_>,
        manifold: &Manifold,
        fresh: Vec<Condition>,
    ) -> Result<(), DeriveError> {
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
        let follow = cx.prover.identity(cx.system, &differences, manifold, on);
        let ranks = rank.at_least.and(rank.at_most);
        self.verdict = match (follow, ranks) {
            // The rank is that at almost every state: its place is contained in the other one.
            (Verdict::Proved(follow), Verdict::Proved(mut ranks)) => {
                ranks.on.clone_from(&follow.on);
                Verdict::Proved(follow).and(Verdict::Proved(ranks))
            }
            (follow, ranks) => follow.and(ranks),
        };
        self.conditions = independent;
        self.columns = rank.pivots.columns;
        Ok(())
    }
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
struct Flow {
    routh: Equations,
    manifold: Manifold,
    /// `E_i[f^l]` with the accelerations of the motion, one row for each selected constraint.
    euler: Vec<Vec<Expr>>,
    /// B, row by row.
    admissible: Vec<Vec<Expr>>,
    /// Φ, row by row.
    transport: Vec<Vec<Expr>>,
    /// λ of the selected constraints.
    multipliers: Vec<Expr>,
}

impl Flow {
    fn new(cx: &Context<'_>) -> Result<Flow, DeriveError> {
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

/// Puts a sentence before the detail of any verdict.
fn prepend(verdict: &mut Verdict, sentence: &str) {
    let detail = match verdict {
        Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => &mut proof.detail,
        Verdict::Numerical(evidence) => &mut evidence.why_no_proof,
        Verdict::Refuted(counterexample) => &mut counterexample.detail,
        Verdict::NotApplicable { detail, .. } => detail,
        Verdict::Undecided { tried } => tried,
    };
    *detail = if detail.is_empty() {
        sentence.to_string()
    } else {
        format!("{sentence}; {detail}")
    };
}
