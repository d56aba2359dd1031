//! Which motions satisfy conditions that most do not: the closure with a distinction of cases.
//!
//! A case is a subset of the states, given by symbols that others determine (`x' = 0`, `phi = 0`) and by quantities that do not
//! vanish there. On it the linear conditions on κ are brought to echelon form; a pivot that may vanish splits the case. What is
//! left without κ must vanish, by one of its factors; every equation must be kept by the motion, and every condition
//! differentiated along it must follow. Parameters are general: what contains only parameters does not vanish; where it does is
//! looked at apart (`parameters`). Equations that are not solved stay beside the case (`implicit`), or wait (`pending`).

mod angles;
mod cleared;
mod confirm;
mod conjugate;
mod constants;
mod exclusion;
mod factors;
mod implicit;
mod parameters;
mod roots;

pub(crate) use angles::joined;
pub(crate) use confirm::confirmed;
pub(crate) use parameters::Special;

use self::angles::Angle;
use self::cleared::Cleared;
use self::roots::Root;
use super::closed_form::short;
use super::closure::Condition;
use super::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::system::Relation;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::{simplify, Expr, Graph, Symbol};
use std::cell::{Cell, RefCell};

/// At most so many cases.
const CASES: usize = 120;
/// At most so many signs are simplified for one question.
const SIGNS: u64 = 150_000;
/// Longer equations are not followed.
const LONGEST: u64 = 600;

/// `Σ coefficients_l κ_l = right`.
#[derive(Clone, Debug)]
struct Row {
    coefficients: Vec<Expr>,
    right: Expr,
}

/// A subset of the states with conditions on κ there.
#[derive(Clone, Debug, Default)]
struct Case {
    /// Symbols with their values, free of all these symbols.
    solved: Vec<(Expr, Expr)>,
    /// What angles were found from, `sin(phi)` for φ = 0 and φ = π.
    angles: Vec<Angle>,
    /// Polynomials that vanish, each with a symbol in which it has a degree of two or more.
    implicit: Vec<(Expr, Symbol)>,
    /// What vanishes and is too long to be followed by itself: what else vanishes may make it shorter, or the case impossible.
    pending: Vec<Expr>,
    /// Symbols whose rates were required to vanish.
    constant: Vec<Symbol>,
    /// Factors that do not vanish.
    nonzero: Vec<Expr>,
    /// What vanishes, as it was found.
    stated: Vec<Expr>,
    /// Factors that were taken apart, and how much was known of the case then: with no more it leads nowhere to do so again.
    taken: Vec<(Expr, usize)>,
    /// Roots that are given by the others.
    roots: Vec<Root>,
    rows: Vec<Row>,
}

/// A set of motions for which κ exists.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    /// The equations of the set, symbol and value.
    pub(crate) solved: Vec<(Expr, Expr)>,
    /// Equations that are not solved: what vanishes, with the symbol that it determines.
    pub(crate) implicit: Vec<(Expr, Symbol)>,
    /// The equations as they are written: `x' = 0`, `sin(phi) = 0`, with `≠` last.
    pub(crate) equations: Vec<String>,
    /// The equations that it shares with the set on another branch of the constraints, where all branches are there.
    pub(crate) without_branch: Option<Vec<String>>,
    /// κ where the conditions determine it.
    pub(crate) kappa: Vec<Option<Expr>>,
    /// Whether all velocities vanish.
    pub(crate) at_rest: bool,
    /// The conditions on κ in echelon form, with their pivots; `None` where no multipliers are asked for.
    rows: Option<Vec<(usize, Row)>>,
    nonzero: Vec<Expr>,
    /// What stands in the place of equations with poles.
    cleared: Option<Cleared>,
    roots: Vec<Root>,
    angles: Vec<Angle>,
}

impl Leaf {
    /// What holds on the set, for substitution: values of symbols, and that a sine or cosine is zero where that is true at several angles
    /// which give the same.
    pub(crate) fn substitutions(&self, g: &Graph) -> Vec<(Expr, Expr)> {
        let whole = self.angles.iter().filter(|angle| angle.whole);
        let whole: Vec<(Expr, Expr)> = whole.map(|a| (a.symbol, a.factor)).collect();
        let is_whole = |s: Expr| whole.iter().any(|(symbol, _)| *symbol == s);
        let solved = self.solved.iter().copied().filter(|(s, _)| !is_whole(*s));
        solved
            .chain(whole.iter().map(|&(_, factor)| (factor, g.zero())))
            .collect()
    }

    /// What vanishes where a symbol has its value, at an angle up to full turns.
    fn residual(&self, g: &Graph, symbol: Expr, value: Expr) -> Expr {
        let angle = self.angles.iter().find(|angle| angle.symbol == symbol);
        match angle.map(|angle| (angle.whole, angle.period, angle.factor)) {
            Some((true, _, factor)) => factor,
            Some((false, Some(d), _)) => g.sin(g.div(g.sub(symbol, value), g.integer(2 * d))),
            _ => g.sub(symbol, value),
        }
    }

    /// What vanishes on the set.
    pub(crate) fn vanishing(&self, g: &Graph) -> Vec<Expr> {
        let cleared = self.cleared.as_ref();
        let is_cleared = |s: Expr| cleared.is_some_and(|cleared| cleared.symbols.contains(&s));
        let solved = self.solved.iter().filter(|(s, _)| !is_cleared(*s));
        let solved = solved.map(|&(s, value)| self.residual(g, s, value));
        let implicit = self.implicit.iter().map(|&(e, _)| e);
        let others: Vec<Expr> = match cleared {
            Some(cleared) => cleared.equations.clone(),
            None => implicit.collect(),
        };
        let roots = self.roots.iter().map(|root| root.equation);
        solved.chain(others).chain(roots).collect()
    }

    /// Whether the set is given by more than equations: of two roots one has the sign.
    pub(crate) fn has_roots(&self) -> bool {
        !self.roots.is_empty()
    }

    /// The conditions on κ, each with the place of the multiplier for which it is solved.
    pub(crate) fn conditions(&self) -> Vec<(usize, Condition)> {
        let condition = |row: &Row| Condition {
            coefficients: row.coefficients.clone(),
            right: row.right,
        };
        let rows = self.rows.iter().flatten();
        rows.map(|(column, row)| (*column, condition(row)))
            .collect()
    }
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    /// The sets of motions.
    pub(crate) leaves: Vec<Leaf>,
    /// What was not followed, in words.
    pub(crate) open: Vec<String>,
    /// Functions of parameters alone that were taken not to vanish.
    pub(crate) regular: Vec<Expr>,
    /// What more is found where some of these vanish, and those of which that is not known.
    pub(crate) special: Special,
}

impl Found {
    /// Whether every case was followed, and no value of a parameter is particular.
    pub(crate) fn is_complete(&self) -> bool {
        self.open.is_empty() && !self.special.open && self.special.found.is_empty()
    }
}

/// The motions along which κ exists with (12) and (13).
pub(crate) fn with_multipliers(cx: &Context<'_>, motion: &Motion) -> Found {
    let zero = cx.system.graph.zero();
    let rows = motion.conditions.iter().map(|row| Row {
        coefficients: row.clone(),
        right: zero,
    });
    let case = Case {
        rows: rows.collect(),
        nonzero: assumed(cx, motion),
        ..Case::default()
    };
    let mut found = Search::new(cx, motion, true).on_constraints(case.clone(), &[]);
    found.special = parameters::special(cx, motion, &found, |at| {
        let case = Case {
            solved: at,
            ..case.clone()
        };
        Search::new(cx, motion, true).on_constraints(case, &[])
    });
    found
}

/// The motions along which κ exists and functions of the state vanish; particular parameters are not looked at.
pub(crate) fn where_multipliers(cx: &Context<'_>, motion: &Motion, functions: &[Expr]) -> Found {
    let zero = cx.system.graph.zero();
    let rows = motion.conditions.iter().map(|row| Row {
        coefficients: row.clone(),
        right: zero,
    });
    let case = Case {
        rows: rows.collect(),
        nonzero: assumed(cx, motion),
        ..Case::default()
    };
    Search::new(cx, motion, true).on_constraints(case, functions)
}

/// The motions along which functions of the state vanish that are written with the dependent velocities of the system.
/// `slopes` are those by which these velocities are divided.
pub(crate) fn where_zero(
    cx: &Context<'_>,
    motion: &Motion,
    functions: &[Expr],
    slopes: &[Expr],
) -> Found {
    let case = Case {
        nonzero: [slopes.to_vec(), assumed(cx, motion)].concat(),
        ..Case::default()
    };
    Search::new(cx, motion, false).on_constraints(case, functions)
}

/// Functions of the velocities that do not vanish by the assumptions of the system, on the states of the motion.
fn assumed(cx: &Context<'_>, motion: &Motion) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let strict = system.assumptions.iter();
    let strict = strict.filter(|a| a.relation != Relation::LessOrEqual);
    let differences = strict.map(|a| g.sub(a.left, a.right));
    let moving = differences.filter(|&e| g.contains_any(e, &system.velocity_symbols()));
    let factors = moving.flat_map(|e| {
        let list = factored(g, motion.on_states(g, e)).map(|parts| parts.factors);
        let above = list.into_iter().flatten().filter(|(_, n)| *n > 0);
        above.map(|(f, _)| f).collect::<Vec<Expr>>()
    });
    let state = motion.state();
    factors.filter(|&f| g.contains_any(f, &state)).collect()
}

/// What one step with a case gives.
enum Step {
    Cases(Vec<Case>),
    Leaf(Box<Leaf>),
}

struct Search<'a, 'b> {
    cx: &'b Context<'a>,
    g: &'b Graph,
    motion: &'b Motion,
    state: Vec<Symbol>,
    with_multipliers: bool,
    spent: Cell<u64>,
    regular: RefCell<Vec<Expr>>,
    /// The equations of each case that was not followed, with what is said of it.
    left: RefCell<Vec<(String, Case)>>,
}

impl<'a, 'b> Search<'a, 'b> {
    fn new(cx: &'b Context<'a>, motion: &'b Motion, with_multipliers: bool) -> Search<'a, 'b> {
        Search {
            cx,
            g: &cx.system.graph,
            motion,
            state: motion.state(),
            with_multipliers,
            spent: Cell::new(0),
            regular: RefCell::default(),
            left: RefCell::default(),
        }
    }

    /// The cases in which the constraints that stay implicit hold and functions vanish, followed.
    fn on_constraints(&self, case: Case, functions: &[Expr]) -> Found {
        let mut found = Found::default();
        let all = [&self.motion.implicit, functions].concat();
        let cases = self.require_all(&mut found, case, &all);
        self.run(cases, found)
    }

    fn run(&self, mut queue: Vec<Case>, mut found: Found) -> Found {
        for _ in 0..CASES {
            let Some(case) = queue.pop() else {
                break;
            };
            if self.spent.get() > SIGNS {
                let text = format!("{} (the budget was spent)", self.place(&case));
                self.leave(&mut found, &case, text);
                continue;
            }
            match self.advance(&mut found, case) {
                Step::Cases(cases) => queue.extend(cases),
                Step::Leaf(leaf) => found.leaves.push(*leaf),
            }
        }
        let rest = queue
            .iter()
            .map(|case| format!("{} (too many cases)", self.place(case)));
        found.open.extend(rest);
        found.regular.clone_from(&self.regular.borrow());
        self.arranged(found)
    }

    /// Leaves a case that is not followed, with what is said of it.
    fn leave(&self, found: &mut Found, case: &Case, text: String) {
        self.left.borrow_mut().push((text.clone(), case.clone()));
        found.open.push(text);
    }

    /// The state of a case in words.
    fn place(&self, case: &Case) -> String {
        let equations = self.equations(case);
        match equations.is_empty() {
            true => "states in general position".into(),
            false => equations.join(" and "),
        }
    }

    /// An expression on the subset of a case.
    fn on(&self, case: &Case, e: Expr) -> Expr {
        if self.g.as_number(e).is_some() {
            return e;
        }
        let restricted = self.g.substitute(e, &case.solved);
        self.spent
            .set(self.spent.get() + simplify::length(self.g, restricted));
        let root = |e, root: &Root| short(self.g, root.replaced(self.g, e));
        let e = case.roots.iter().fold(short(self.g, restricted), root);
        match self.remainder(case, e) {
            rest if self.g.is_zero(rest) => rest,
            _ => e,
        }
    }

    /// Makes equations kept by the motion and conditions closed, as far as one step goes.
    fn advance(&self, found: &mut Found, mut case: Case) -> Step {
        if let Some(cases) = self.made_explicit(found, &case) {
            return Step::Cases(cases);
        }
        for &(symbol, value) in &case.solved {
            let rate = self
                .g
                .as_symbol(symbol)
                .map(|s| self.motion.rate(self.g, s));
            let moved = self.motion.along(self.cx, value);
            let residual = self.on(&case, self.g.sub(rate.unwrap_or(self.g.zero()), moved));
            if !self.g.is_zero(residual) {
                return Step::Cases(self.require(found, &case, residual));
            }
        }
        for &(polynomial, _) in &case.implicit {
            let moved = self.on(&case, self.motion.along(self.cx, polynomial));
            if !self.g.is_zero(moved) {
                return Step::Cases(self.require(found, &case, moved));
            }
        }
        if let Some(cases) = self.no_longer_pending(found, &case) {
            return Step::Cases(cases);
        }
        let mut echelon: Vec<(usize, Row)> = Vec::new();
        for row in &case.rows {
            let row = self.reduced(&case, row, &echelon);
            match self.pivot(&case, &row) {
                Pivot::None if self.g.is_zero(row.right) => {}
                Pivot::None => return Step::Cases(self.require(found, &case, row.right)),
                Pivot::Certain(column) => self.enter(&case, &mut echelon, column, &row),
                Pivot::Open(column) => {
                    return Step::Cases(self.split(found, &case, row.coefficients[column]))
                }
            }
        }
        let fresh: Vec<Row> = echelon
            .iter()
            .map(|(_, row)| self.reduced(&case, &self.derived(row), &echelon))
            .filter(|row| !self.is_zero(row))
            .collect();
        if fresh.is_empty() {
            return Step::Leaf(Box::new(self.leaf(found, case, &echelon)));
        }
        case.rows = echelon
            .into_iter()
            .map(|(_, row)| row)
            .chain(fresh)
            .collect();
        Step::Cases(vec![case])
    }

    /// The cases that something pending gives which has become shorter.
    fn no_longer_pending(&self, found: &mut Found, case: &Case) -> Option<Vec<Case>> {
        let place = case.pending.iter().position(|&e| self.on(case, e) != e)?;
        let mut case = case.clone();
        let e = case.pending.remove(place);
        let rest = self.on(&case, e);
        Some(match self.g.is_zero(rest) {
            true => vec![case],
            false => self.require(found, &case, rest),
        })
    }

    fn is_zero(&self, row: &Row) -> bool {
        let mut all = row.coefficients.iter().chain([&row.right]);
        all.all(|&e| self.g.is_zero(e))
    }

    /// `(X n + n Φ) κ = X b + n·λ`.
    fn derived(&self, row: &Row) -> Row {
        let g = self.g;
        let coefficients = (0..row.coefficients.len())
            .map(|l| {
                let mut parts = vec![self.motion.along(self.cx, row.coefficients[l])];
                for (&n, transport) in row.coefficients.iter().zip(&self.motion.transport) {
                    parts.push(g.mul(&[n, transport[l]]));
                }
                g.add(&parts)
            })
            .collect();
        let mut right = vec![self.motion.along(self.cx, row.right)];
        for (&n, &lambda) in row.coefficients.iter().zip(&self.motion.multipliers) {
            right.push(g.mul(&[n, lambda]));
        }
        Row {
            coefficients,
            right: g.add(&right),
        }
    }

    /// A row on the subset, with the pivots of the echelon form eliminated.
    fn reduced(&self, case: &Case, row: &Row, echelon: &[(usize, Row)]) -> Row {
        let g = self.g;
        let mut row = row.clone();
        for (column, pivot) in echelon {
            let factor = row.coefficients[*column];
            if g.is_zero(factor) {
                continue;
            }
            let less = |e: Expr, p: Expr| g.sub(e, g.mul(&[factor, p]));
            let pairs = row.coefficients.iter().zip(&pivot.coefficients);
            row.coefficients = pairs.map(|(&e, &p)| less(e, p)).collect();
            row.right = less(row.right, pivot.right);
        }
        for e in row.coefficients.iter_mut().chain([&mut row.right]) {
            *e = self.on(case, *e);
        }
        row
    }

    /// Enters a row with a pivot that does not vanish, and eliminates it from the others.
    fn enter(&self, case: &Case, echelon: &mut Vec<(usize, Row)>, column: usize, row: &Row) {
        let pivot = row.coefficients[column];
        self.take_as_regular(pivot);
        let over = |e: Expr| self.on(case, self.g.div(e, pivot));
        let row = Row {
            coefficients: row.coefficients.iter().map(|&e| over(e)).collect(),
            right: over(row.right),
        };
        let entered = [(column, row)];
        for (_, known) in echelon.iter_mut() {
            *known = self.reduced(case, known, &entered);
        }
        echelon.extend(entered);
    }

    fn pivot(&self, case: &Case, row: &Row) -> Pivot {
        let entries = row.coefficients.iter().enumerate();
        let nonzero: Vec<(usize, Expr)> = entries
            .map(|(l, &e)| (l, e))
            .filter(|(_, e)| !self.g.is_zero(*e))
            .collect();
        let shortest = |list: &[(usize, Expr)]| {
            let shortest = list
                .iter()
                .min_by_key(|(_, e)| simplify::length(self.g, *e));
            shortest.map(|(l, _)| *l)
        };
        let certain: Vec<(usize, Expr)> = nonzero
            .iter()
            .copied()
            .filter(|&(_, e)| {
                self.vanishing_factors(case, e)
                    .is_some_and(|f| f.is_empty())
            })
            .collect();
        match (shortest(&certain), shortest(&nonzero)) {
            (Some(column), _) => Pivot::Certain(column),
            (None, Some(column)) => Pivot::Open(column),
            (None, None) => Pivot::None,
        }
    }

    /// The case where an expression does not vanish, and those where it does.
    fn split(&self, found: &mut Found, case: &Case, e: Expr) -> Vec<Case> {
        let mut cases = self.require(found, case, e);
        let mut off = case.clone();
        off.nonzero
            .extend(self.vanishing_factors(case, e).unwrap_or_else(|| vec![e]));
        cases.push(off);
        cases
    }

    fn leaf(&self, found: &mut Found, case: Case, echelon: &[(usize, Row)]) -> Leaf {
        let g = self.g;
        let r = self.motion.multipliers.len();
        let columns: Vec<usize> = echelon.iter().map(|(column, _)| *column).collect();
        let mut kappa = vec![None; r];
        for (column, row) in echelon {
            let free = (0..r).filter(|l| !columns.contains(l));
            if free.clone().all(|l| g.is_zero(row.coefficients[l])) {
                kappa[*column] = Some(row.right);
            }
        }
        // Where the constraints drift, a body without independent speeds moves.
        let at_rest = self.cx.system.coordinates.iter().all(|c| {
            let rate = self.motion.rate(g, c.q_symbol);
            g.is_zero(self.on(&case, rate))
        });
        let mut leaf = Leaf {
            equations: Vec::new(),
            without_branch: None,
            solved: case.solved.clone(),
            implicit: case.implicit.clone(),
            kappa,
            at_rest,
            rows: self.with_multipliers.then(|| echelon.to_vec()),
            nonzero: Vec::new(),
            cleared: None,
            roots: case.roots.clone(),
            angles: case.angles.clone(),
        };
        leaf.nonzero = self.needed(&leaf, &case.nonzero);
        let leading = self.leading(&case);
        let fresh = leading.iter().filter(|e| !leaf.nonzero.contains(e));
        let fresh: Vec<Expr> = fresh.copied().collect();
        leaf.nonzero.extend(fresh);
        for text in self.clear(&mut leaf, &case, &leading) {
            self.leave(found, &case, text);
        }
        leaf.equations = self.written(&case, leaf.cleared.as_ref());
        leaf
    }

    /// Of what does not vanish, that by which κ or the equations are divided: elsewhere they hold in the limit too, as they are
    /// identities of continuous functions.
    fn needed(&self, leaf: &Leaf, nonzero: &[Expr]) -> Vec<Expr> {
        let values = leaf.kappa.iter().flatten().copied();
        let values = values.chain(leaf.solved.iter().map(|(_, value)| *value));
        let mut poles = Vec::new();
        for value in values {
            match factored(self.g, value) {
                Some(parts) => poles.extend(
                    parts
                        .factors
                        .iter()
                        .filter(|(_, n)| *n < 0)
                        .map(|(f, _)| *f),
                ),
                None => return nonzero.to_vec(),
            }
        }
        let mut needed: Vec<Expr> = Vec::new();
        for &e in nonzero {
            if poles.contains(&e) && !needed.contains(&e) {
                needed.push(e);
            }
        }
        needed
    }

    /// The equations of a case as they are written, speeds first.
    fn equations(&self, case: &Case) -> Vec<String> {
        self.written(case, None)
    }

    fn written(&self, case: &Case, cleared: Option<&Cleared>) -> Vec<String> {
        let g = self.g;
        let mut solved = case.solved.clone();
        solved.retain(|(s, _)| cleared.is_none_or(|cleared| !cleared.symbols.contains(s)));
        solved.sort_by_key(|&(symbol, _)| {
            let is = |s: &Symbol| g.as_symbol(symbol) == Some(*s);
            let speed = self.motion.speeds.iter().position(is);
            (
                speed.is_none(),
                speed.or_else(|| self.state.iter().position(is)),
            )
        });
        let pairs = solved.iter().map(|&(symbol, value)| {
            let angle = case.angles.iter().find(|angle| angle.symbol == symbol);
            Leaf::written(g, angle, symbol, value)
        });
        // What holds on all states needs no mention.
        let holds = |e: &Expr| {
            let ratio = |f: &Expr| short(g, g.div(*e, *f));
            let mut all = self.motion.implicit.iter();
            all.any(|f| g.as_number(ratio(f)).is_some())
        };
        let implicit: Vec<Expr> = match cleared {
            Some(cleared) => cleared.equations.clone(),
            None => case.implicit.iter().map(|&(e, _)| e).collect(),
        };
        // The equation of a root says more than its square.
        let is_square = |e: &Expr| {
            let ratio = |root: &Root| short(g, g.div(*e, root.squared));
            let mut roots = case.roots.iter();
            roots.any(|root| g.as_number(ratio(root)).is_some())
        };
        let implicit = implicit.iter().filter(|e| !holds(e) && !is_square(e));
        let roots = case.roots.iter().map(|root| &root.equation);
        let implicit = implicit.chain(roots);
        let implicit = implicit.map(|e| format!("{} = 0", g.text(*e)));
        pairs.chain(implicit).collect()
    }

    /// Sets contained in others are left out, and what must not vanish is added to the equations.
    fn arranged(&self, mut found: Found) -> Found {
        let mut leaves = std::mem::take(&mut found.leaves);
        leaves.retain(|leaf| !self.is_excluded(leaf));
        self.join_branches(&mut leaves);
        for (place, leaf) in leaves.iter().enumerate() {
            let contained = leaves.iter().enumerate().any(|(earlier, other)| {
                let equal = || self.contains(leaf, other) && leaf.nonzero == other.nonzero;
                earlier != place
                    && other
                        .nonzero
                        .iter()
                        .all(|&e| self.vanishes_nowhere_on(leaf, e))
                    && self.contains(other, leaf)
                    && (earlier < place || !equal())
            });
            let mut written = leaf.clone();
            let poles = self.motion.chart_poles.iter();
            let poles = poles.filter(|e| !leaf.nonzero.contains(e));
            let unequal = leaf.nonzero.iter().chain(poles);
            let unequal = unequal.map(|&e| format!("{} ≠ 0", self.g.text(e)));
            let unequal: Vec<String> = unequal.collect();
            if let Some(shared) = &mut written.without_branch {
                shared.extend(unequal.iter().cloned());
            }
            written.equations.extend(unequal);
            let repeated = found
                .leaves
                .iter()
                .any(|known| known.equations == written.equations);
            if !contained && !repeated {
                found.leaves.push(written);
            }
        }
        // Motions of a case that lie in a set found are known, whatever else holds for them.
        for (text, case) in self.left.borrow().iter() {
            let mut leaves = found.leaves.iter();
            if leaves.any(|leaf| leaf.nonzero.is_empty() && self.holds_on(leaf, case)) {
                found.open.retain(|open| open != text);
            }
        }
        found.open.extend(self.motion.gaps.iter().cloned());
        found.open.sort();
        found.open.dedup();
        found
    }

    /// Whether the equations of `large` hold on `small`.
    fn contains(&self, large: &Leaf, small: &Leaf) -> bool {
        let case = Case {
            solved: small.solved.clone(),
            implicit: small.implicit.clone(),
            roots: small.roots.clone(),
            ..Case::default()
        };
        self.holds_on(large, &case)
    }

    /// Whether the equations of a set hold on a case.
    fn holds_on(&self, large: &Leaf, case: &Case) -> bool {
        let mut all = large.vanishing(self.g).into_iter();
        all.all(|residual| {
            let rest = self.on(case, residual);
            self.g.is_zero(rest) || self.is_zero_constant(rest)
        })
    }
}

/// What a row offers as a pivot.
enum Pivot {
    /// All coefficients vanish.
    None,
    /// A coefficient that does not vanish on the subset.
    Certain(usize),
    /// A coefficient that may vanish.
    Open(usize),
}
