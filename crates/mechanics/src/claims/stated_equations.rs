//! `equations.stated#NAME`: equations of a paper, a student or another program are compared with the motion.
//!
//! The equations are functions of the state, of the accelerations, of the multipliers of the constraints and of unknowns of their
//! own. Two questions are asked on the constraint set: whether the motion satisfies them (with some value of the unknowns), and
//! whether nothing else does.

use super::formulation::{derive, REFERENCE};
use super::on_set::{self, constraint_set, vanish, State};
use super::{Claim, Context, Finding, Formula, Group};
use crate::equations::Equations;
use crate::prover::assumptions;
use crate::system::{StatedEquations, System};
use crate::words::counted;
use crate::words::number;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::matrix::null_space;
use chetaev_symbolic::real_factors::zero_set;
use chetaev_symbolic::simplify::{length, simplify, Options};
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::zero::GenericRank;
use chetaev_symbolic::{Expr, Symbol, Verdict};

mod singular;
mod spurious;

/// `equations.stated#NAME`.
#[derive(Clone, Copy, Debug)]
pub struct Stated;

impl Claim for Stated {
    fn id(&self) -> &'static str {
        "equations.stated"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "The equations stated give exactly the motion"
    }

    fn explanation(&self) -> &'static str {
        "The equations of a paper, a student or another program, stated under [equations.NAME], are compared with the motion of \
         this model. They may contain coordinates, velocities, accelerations, `lambda_NAME` (the multiplier of the constraint NAME \
         as this model defines it) and unknowns of their own; the constraints count with them. `proved`: at almost every state \
         that satisfies the constraints, the accelerations of the motion satisfy them, and no others do. `refuted`: at the state \
         stated the motion does not satisfy them, with the accelerations that they give there and those of the motion, and the \
         difference of both sides in short form; or they leave accelerations undetermined (too few equations), or others satisfy \
         them too (too many solutions), or nothing does. `conditional`: they are right for the parameters stated only, or \
         everywhere but at states at which they say less than the motion does."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.accelerations-unique".into()]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let sets = cx.system.equations.iter();
        sets.map(|set| Some(set.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let name = subject.unwrap_or_default();
        let Some(set) = cx.system.equations.iter().find(|set| set.name == name) else {
            return Verdict::undecided(format!("there are no equations `{name}`")).into();
        };
        match derive(cx, REFERENCE) {
            Ok(motion) => Question::new(cx, set, &motion).decide(),
            Err(problem) => problem.into(),
        }
    }
}

/// The equations beside the motion.
struct Question<'a, 'c> {
    cx: &'a Context<'c>,
    set: &'a StatedEquations,
    /// What vanishes where they hold: left minus right, or simpler functions.
    equations: Vec<Expr>,
    /// What each is, in words.
    names: Vec<String>,
    /// Multipliers that occur, with their values on the motion; none where redundant constraints leave them undetermined.
    known: Vec<(Symbol, Expr)>,
    /// Unknowns that are none of the motion.
    free: Vec<Symbol>,
    accelerations: Vec<Symbol>,
    motion: &'a Equations,
}

/// What the motion makes of the equations.
struct OnMotion {
    /// Left minus right with what was solved for put in; functions of the state.
    residuals: Vec<(String, Expr)>,
    /// The unknowns that were solved for.
    values: Vec<(Expr, Expr)>,
}

impl<'a, 'c> Question<'a, 'c> {
    fn new(cx: &'a Context<'c>, set: &'a StatedEquations, motion: &'a Equations) -> Self {
        let (system, g) = (cx.system, &cx.system.graph);
        let sides = set.equations.iter();
        let stated: Vec<Expr> = sides.map(|&(_, left, right)| g.sub(left, right)).collect();
        let occurring = g.symbols_in(&stated);
        let multiplier = |name: &str| g.intern_symbol(&format!("lambda_{name}"), 0);
        let all = system.constraints.iter().map(|c| multiplier(&c.name));
        let all: Vec<Symbol> = all.filter(|s| occurring.contains(s)).collect();
        let is_determined = cx.selection.rows.len() == cx.terms.constraints.len();
        let known: Vec<(Symbol, Expr)> = if is_determined {
            motion
                .multipliers
                .iter()
                .map(|&(l, value)| (multiplier(&system.constraints[l].name), value))
                .filter(|(s, _)| all.contains(s))
                .collect()
        } else {
            Vec::new()
        };
        let mut free: Vec<Symbol> = set.unknowns.clone();
        free.extend(
            all.iter()
                .filter(|s| !known.iter().any(|(own, _)| own == *s)),
        );
        let accelerations: Vec<Symbol> = system.coordinates.iter().map(|c| c.a_symbol).collect();
        let unknowns = accelerations.iter().chain(&all).chain(&set.unknowns);
        let unknowns: Vec<Symbol> = unknowns.copied().collect();
        let names = set.equations.iter().map(|(name, ..)| name);
        let (names, equations) = names
            .zip(stated)
            .flat_map(|(name, e)| vanishing(system, name, e, &unknowns))
            .unzip();
        Question {
            cx,
            set,
            equations,
            names,
            known,
            free,
            accelerations,
            motion,
        }
    }

    fn system(&self) -> &'c System {
        self.cx.system
    }

    /// Accelerations of the motion, and multipliers where they count.
    fn of_motion(&self, with_multipliers: bool) -> Vec<(Expr, Expr)> {
        let g = &self.system().graph;
        let accelerations = self.system().coordinates.iter().map(|c| c.a);
        let own = accelerations.zip(self.motion.accelerations.iter().copied());
        let mut pairs: Vec<(Expr, Expr)> = own.collect();
        if with_multipliers {
            pairs.extend(self.known.iter().map(|&(s, e)| (g.symbol_expr(s), e)));
        }
        pairs
    }

    fn decide(&self) -> Finding {
        let on_motion = match self.on_motion(true) {
            Ok(on_motion) => on_motion,
            Err(verdict) => return (*verdict).into(),
        };
        let what = "the motion satisfies the equations";
        match on_set::hold(self.cx, &on_motion.residuals, what) {
            Verdict::Refuted(found) => self.wrong(&on_motion, found),
            verdict
            @ (Verdict::Proved(_) | Verdict::Conditional { .. } | Verdict::Numerical(_)) => {
                self.alone(&on_motion, verdict).into()
            }
            other => other
                .prefixed("whether the motion satisfies the equations was not decided")
                .into(),
        }
    }

    /// The equations on the motion, unknowns of their own solved for from as many of them as they can be.
    fn on_motion(&self, with_multipliers: bool) -> Result<OnMotion, Box<Verdict>> {
        let g = &self.system().graph;
        let pairs = self.of_motion(with_multipliers);
        let mut unknowns = self.free.clone();
        if !with_multipliers {
            unknowns.extend(self.known.iter().map(|(s, _)| *s));
        }
        let es = g.substitute_all(&self.equations, &pairs);
        let names = self.names.clone();
        let occurring = g.symbols_in(&es);
        unknowns.retain(|u| occurring.contains(u));
        if unknowns.is_empty() {
            return Ok(OnMotion {
                residuals: names.into_iter().zip(es).collect(),
                values: Vec::new(),
            });
        }
        let matrix = g.jacobian(&es, &unknowns);
        if g.any_contains_any(&matrix.concat(), &unknowns) {
            return Err(Box::new(Verdict::undecided(
                "the equations are not linear in their own unknowns, which were not solved for",
            )));
        }
        let rank = self.rank(&matrix)?;
        let (rows, columns) = (&rank.pivots.rows, &rank.pivots.columns);
        let zeros: Vec<(Expr, Expr)> = unknowns
            .iter()
            .map(|&u| (g.symbol_expr(u), g.zero()))
            .collect();
        let rest = g.substitute_all(&es, &zeros);
        let entries: Vec<Expr> = rows
            .iter()
            .flat_map(|&row| columns.iter().map(move |&column| (row, column)))
            .map(|(row, column)| matrix[row][column])
            .collect();
        let rhs: Vec<Expr> = rows.iter().map(|&row| g.neg(rest[row])).collect();
        let solved = g.solve(&entries, &rhs).map_err(|problem| {
            Box::new(Verdict::undecided(format!(
                "the equations were not solved for their own unknowns: {problem}"
            )))
        })?;
        let mut values = zeros;
        for (&column, &value) in columns.iter().zip(&solved) {
            values[column].1 = value;
        }
        let put_in = g.substitute_all(&es, &values);
        let left = names.into_iter().zip(put_in).enumerate();
        // Those that were solved hold by that.
        let residuals = left.filter(|(row, _)| !rows.contains(row)).map(|(_, e)| e);
        Ok(OnMotion {
            residuals: residuals.collect(),
            values,
        })
    }

    fn rank(&self, matrix: &[Vec<Expr>]) -> Result<GenericRank, Box<Verdict>> {
        let set = constraint_set(self.cx);
        let found = self.cx.prover.rank(self.system(), matrix, &set);
        found.or_else(|_| {
            let wide = super::formulation::manifold(self.cx);
            self.cx.prover.rank(self.system(), matrix, &wide)
        })
    }

    fn short(&self, e: Expr) -> Option<Expr> {
        on_set::short(self.cx, e)
    }

    /// The equations that the motion satisfies: does nothing else satisfy them?
    fn alone(&self, on_motion: &OnMotion, holds: Verdict) -> Verdict {
        let (g, n) = (&self.system().graph, self.system().n());
        let multipliers = self.known.iter().map(|(s, _)| *s);
        let others: Vec<Symbol> = multipliers.chain(self.free.iter().copied()).collect();
        let columns: Vec<Symbol> = self.accelerations.iter().chain(&others).copied().collect();
        let stated = g.jacobian(&self.equations, &columns);
        let is_linear = !g.any_contains_any(&stated.concat(), &columns);
        let mut pairs = self.of_motion(true);
        pairs.extend(on_motion.values.iter().copied());
        let at_motion: Vec<Vec<Expr>> = stated
            .iter()
            .map(|row| g.substitute_all(row, &pairs))
            .collect();
        let matrix = self.with_constraints(at_motion, others.len());
        let (all, own) = match (self.rank(&matrix), self.rank_of_others(&matrix)) {
            (Ok(all), Ok(own)) => (all, own),
            (Err(verdict), _) | (_, Err(verdict)) => {
                return verdict.prefixed(
                    "the motion satisfies the equations; whether other accelerations do too was not decided",
                )
            }
        };
        let (own_least, own_most) = own;
        if all.minimum >= n + own_most {
            let counted = match self.set.equations.len() {
                1 => "equation".to_owned(),
                many => format!("{many} equations"),
            };
            let with = if self.cx.terms.constraints.is_empty() {
                ""
            } else {
                " and the constraints"
            };
            let sentence = format!("the motion satisfies the {counted} stated, and the equations{with} determine all accelerations");
            let holds = match (is_linear, all.at_least.clone()) {
                (true, Verdict::Proved(at_least)) => {
                    let detail = format!("the rank: {}", at_least.detail);
                    holds.and(Verdict::Proved(Proof { detail, ..at_least }))
                }
                (true, other) => return other.prefixed("the motion satisfies the equations; that no other accelerations do was not proved"),
                (false, _) => match self.other_solutions(on_motion, &columns) {
                    Ok(()) => holds,
                    Err(verdict) => return *verdict,
                },
            };
            return self.but_for_singular_states(&matrix, holds.prefixed(&sentence));
        }
        if all.maximum < n + own_least {
            return self.too_few(&matrix, n + own_least - all.maximum, &all);
        }
        Verdict::undecided("the equations determine the accelerations on some components of the constraints and not on others")
    }

    /// The derivatives of the constraints below the matrix of the equations.
    fn with_constraints(&self, mut rows: Vec<Vec<Expr>>, others: usize) -> Vec<Vec<Expr>> {
        let g = &self.system().graph;
        for &row in &self.cx.selection.rows {
            let mut line = self.cx.terms.jacobian[row].clone();
            line.extend(std::iter::repeat_n(g.zero(), others));
            rows.push(line);
        }
        rows
    }

    /// The least and the largest rank of the columns of unknowns other than accelerations.
    fn rank_of_others(&self, matrix: &[Vec<Expr>]) -> Result<(usize, usize), Box<Verdict>> {
        let n = self.system().n();
        let rows: Vec<Vec<Expr>> = matrix.iter().map(|row| row[n..].to_vec()).collect();
        if rows.iter().all(Vec::is_empty) {
            return Ok((0, 0));
        }
        self.rank(&rows).map(|rank| (rank.minimum, rank.maximum))
    }

    fn too_few(&self, matrix: &[Vec<Expr>], missing: usize, all: &GenericRank) -> Verdict {
        let g = &self.system().graph;
        let columns = matrix.first().map_or(0, Vec::len);
        let names = self.system().coordinates.iter().enumerate();
        let open: Vec<String> = names
            .filter(|(i, _)| {
                let mut wider = matrix.to_vec();
                let unit = (0..columns).map(|j| if j == *i { g.one() } else { g.zero() });
                wider.push(unit.collect());
                self.rank(&wider)
                    .is_ok_and(|rank| rank.minimum > all.maximum)
            })
            .map(|(_, c)| format!("{}''", c.name))
            .collect();
        let open = if open.is_empty() {
            String::new()
        } else {
            format!(": {} may have any of many values", open.join(", "))
        };
        let more = counted(missing, "equation is missing", "equations are missing");
        let with = if self.cx.terms.constraints.is_empty() {
            ""
        } else {
            ", with the constraints,"
        };
        Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "accelerations that the equations leave undetermined, at every state".into(),
            residual: (missing.to_string(), missing.to_string()),
            detail: format!(
                "too few equations: the motion satisfies them, but{with} they do not determine the accelerations at any state{open}; {more}"
            ),
        })
    }

    /// The equations that the motion does not satisfy at a state.
    fn wrong(&self, on_motion: &OnMotion, mut found: Counterexample) -> Finding {
        if let Some(verdict) = self.other_multipliers() {
            return verdict.into();
        }
        let g = &self.system().graph;
        let mut formulas = Vec::new();
        let mut sentences = Vec::new();
        for (name, residual) in &on_motion.residuals {
            let Some(short) = self.short_difference(name, *residual) else {
                continue;
            };
            if g.is_zero(short) {
                continue;
            }
            if length(g, short) <= WRITTEN {
                sentences.push(format!("{name} is {} on the motion", g.text(short)));
            }
            formulas.push(Formula {
                caption: format!("{name}, on the motion"),
                left: None,
                right: short,
            });
        }
        sentences.push(found.detail.clone());
        sentences.extend(self.accelerations_at(&found));
        found.detail = format!(
            "the motion does not satisfy the equations: {}",
            sentences.join("; ")
        );
        Finding {
            verdict: Verdict::Refuted(found),
            formulas,
        }
    }

    /// The difference of both sides, from the equation of motion with the same accelerations and multipliers where there is one.
    fn short_difference(&self, name: &str, residual: Expr) -> Option<Expr> {
        let g = &self.system().graph;
        let place = self.names.iter().position(|own| own == name);
        let term = place.and_then(|k| self.wrong_term(self.equations[k]));
        let short = self.short(residual);
        let forms = term.into_iter().chain(short);
        forms.min_by_key(|&e| length(g, e))
    }

    /// What an equation has more than c times an equation of motion, if that contains no unknown.
    fn wrong_term(&self, equation: Expr) -> Option<Expr> {
        let (system, g) = (self.system(), &self.system().graph);
        let lefts = system.motion_left_sides();
        let options = Options::default();
        let unknowns: Vec<Symbol> = self
            .known
            .iter()
            .map(|(s, _)| *s)
            .chain(self.free.iter().copied())
            .chain(self.accelerations.iter().copied())
            .collect();
        let rows = system.coordinates.iter().enumerate().zip(lefts);
        let found = rows.filter_map(|((i, _), left)| {
            let reaction = self.cx.selection.rows.iter().map(|&row| {
                let name = &system.constraints[self.cx.terms.constraint_index[row]].name;
                let lambda = g.symbol(&format!("lambda_{name}"), 0);
                g.mul(&[lambda, self.cx.terms.jacobian[row][i]])
            });
            let true_one = g.sub(left, g.add(&reaction.collect::<Vec<Expr>>()));
            let symbol = self
                .accelerations
                .iter()
                .copied()
                .find(|&a| g.contains_any(equation, &[a]) && g.contains_any(true_one, &[a]))?;
            let factor = g.div(g.diff(equation, symbol), g.diff(true_one, symbol));
            let factor = simplify(g, factor, &options);
            let difference = g.sub(equation, g.mul(&[factor, true_one]));
            let difference = simplify(g, difference, &options);
            (!g.contains_any(difference, &unknowns)).then_some(difference)
        });
        found.min_by_key(|&e| length(g, e))
    }

    /// What the equations give at a state beside what the motion does.
    fn accelerations_at(&self, found: &Counterexample) -> Option<String> {
        let (system, g, n) = (self.system(), &self.system().graph, self.system().n());
        let state = State::of(self.cx, found)?;
        let motion = state.evaluate(&self.motion.accelerations)?;
        let multipliers = self.known.iter().map(|(s, _)| *s);
        let others: Vec<Symbol> = multipliers.chain(self.free.iter().copied()).collect();
        let columns: Vec<Symbol> = self.accelerations.iter().chain(&others).copied().collect();
        let stated = g.jacobian(&self.equations, &columns);
        if g.any_contains_any(&stated.concat(), &columns) {
            return None;
        }
        let zeros: Vec<(Expr, Expr)> = columns
            .iter()
            .map(|&u| (g.symbol_expr(u), g.zero()))
            .collect();
        let mut rhs = g.substitute_all(&self.equations, &zeros);
        let rates = self.cx.selection.rows.iter();
        rhs.extend(rates.map(|&row| g.neg(self.cx.terms.constraint_rate[row])));
        let matrix = self.with_constraints(stated, others.len());
        let entries = state.evaluate(&matrix.concat())?;
        let rhs = state.evaluate(&rhs)?;
        let rows: Vec<Vec<f64>> = entries
            .chunks(columns.len())
            .zip(&rhs)
            .map(|(row, b)| row.iter().copied().chain([-b]).collect())
            .collect();
        match solved(rows, columns.len(), n) {
            Solved::Nothing => {
                Some("no accelerations satisfy all the equations and the constraints there".into())
            }
            Solved::Many => None,
            Solved::One(own) => {
                let names = system.coordinates.iter().zip(own.iter().zip(&motion));
                let differing: Vec<String> = names
                    .filter(|(_, (a, b))| (**a - **b).abs() > 1e-9 * (a.abs() + b.abs()))
                    .map(|(c, (a, b))| {
                        format!(
                            "{0}'' = {1}, and the motion has {0}'' = {2}",
                            c.name,
                            number(*a),
                            number(*b)
                        )
                    })
                    .collect();
                (!differing.is_empty()).then(|| format!("there they give {}", differing.join("; ")))
            }
        }
    }

    /// Where the accelerations are right and multipliers are not.
    fn other_multipliers(&self) -> Option<Verdict> {
        if self.known.is_empty() {
            return None;
        }
        let g = &self.system().graph;
        let on_motion = self.on_motion(false).ok()?;
        if !matches!(
            vanish(self.cx, &on_motion.residuals, &[]),
            Verdict::Proved(_)
        ) {
            return None;
        }
        let differences: Vec<(String, Expr)> = self
            .known
            .iter()
            .map(|&(s, value)| {
                let own = g.substitute(g.symbol_expr(s), &on_motion.values);
                (
                    format!(
                        "{} of these equations minus the multiplier of this model",
                        g.symbol_name(s)
                    ),
                    g.sub(own, value),
                )
            })
            .collect();
        let opposite = self.known.iter().all(|&(s, value)| {
            let own = g.substitute(g.symbol_expr(s), &on_motion.values);
            let sum = [("sum".to_owned(), g.add(&[own, value]))];
            matches!(vanish(self.cx, &sum, &[]), Verdict::Proved(_))
        });
        let Verdict::Refuted(mut found) = vanish(self.cx, &differences, &[]) else {
            return None;
        };
        let what = if opposite {
            "the motion satisfies the equations only with multipliers of the opposite sign: the accelerations are right, and `lambda_…` is the negative of the multiplier of this model"
        } else {
            "the accelerations of the motion satisfy the equations, but with other multipliers than those of this model, which `lambda_…` is"
        };
        found.detail = format!(
            "{what}; state an unknown of its own under `unknowns` in its place; {}",
            found.detail
        );
        Some(Verdict::Refuted(found))
    }
}

/// Longer formulas are shown, not written in a sentence.
const WRITTEN: u64 = 80;

/// What vanishes where an equation holds, with words for it: left minus right where that is linear in the unknowns, or nothing simpler
/// is known. `E² = 0` is `E = 0`, and the rank of its Jacobian does not count solutions.
fn vanishing(system: &System, name: &str, e: Expr, unknowns: &[Symbol]) -> Vec<(String, Expr)> {
    let g = &system.graph;
    let difference = || vec![(format!("left minus right of equation `{name}`"), e)];
    if !g.any_contains_any(&g.gradient(e, unknowns), unknowns) {
        return difference();
    }
    match zero_set(g, e, unknowns, &assumptions(system)) {
        Some(all) => {
            let what = |own: Expr| {
                format!(
                    "{}, which vanishes where equation `{name}` holds,",
                    g.text(own)
                )
            };
            all.into_iter().map(|own| (what(own), own)).collect()
        }
        None => difference(),
    }
}

/// What a linear system gives for its first unknowns.
enum Solved {
    Nothing,
    Many,
    One(Vec<f64>),
}

/// Gauss–Jordan elimination of rows (coefficients, right side) in doubles, for numbers beside a refutation.
fn solved(mut rows: Vec<Vec<f64>>, columns: usize, wanted: usize) -> Solved {
    for row in &mut rows {
        let scale = row[..columns].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if scale > 0.0 {
            row.iter_mut().for_each(|x| *x /= scale);
        }
    }
    let mut pivots: Vec<usize> = Vec::new();
    // Unknowns that are not wanted are eliminated first.
    for column in (wanted..columns).chain(0..wanted) {
        let from = pivots.len();
        let size = |row: &Vec<f64>| row[column].abs();
        let Some(best) =
            (from..rows.len()).max_by(|&a, &b| size(&rows[a]).total_cmp(&size(&rows[b])))
        else {
            break;
        };
        if size(&rows[best]) < 1e-9 {
            continue;
        }
        rows.swap(from, best);
        let pivot = rows[from].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != from {
                let factor = row[column] / pivot[column];
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(x, p)| *x -= factor * p);
            }
        }
        pivots.push(column);
    }
    if rows[pivots.len()..]
        .iter()
        .any(|row| row[columns].abs() > 1e-7)
    {
        return Solved::Nothing;
    }
    let value = |j: usize| {
        let row = &rows[pivots.iter().position(|&p| p == j)?];
        let free = (0..columns).any(|c| c != j && row[c].abs() > 1e-9 && !pivots.contains(&c));
        (!free).then(|| row[columns] / row[j])
    };
    match (0..wanted).map(value).collect() {
        Some(values) => Solved::One(values),
        None => Solved::Many,
    }
}
