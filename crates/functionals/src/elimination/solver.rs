//! Groups of equations solved one after the other: for which tensor, by which rows, and what is divided by.

use super::ranking::Ranking;
use super::{rest, Adopted, Entries, Open, Pivot, Rule, Solved, MOST_ROUNDS};
use crate::boundary::CURVATURE;
use crate::space::Jet;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::zero::{generic_rank, Options, Pivots, RankTest};
use chetaev_symbolic::{rational, Expr, Graph, Node};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// A way to solve a group.
struct Choice {
    cost: Cost,
    group: usize,
    jets: Vec<Jet>,
    rows: Vec<usize>,
    matrix: Vec<Vec<Expr>>,
    rest: Vec<Expr>,
    /// Whether its columns are independent everywhere.
    is_regular: bool,
}

/// A group of equations in which the gradient of a function was undone by its conjugate.
struct Undone {
    group: usize,
    equations: Vec<Expr>,
    function: String,
    /// What stood before the gradient.
    matrix: Vec<Vec<Expr>>,
}

/// How dear a way is: its class, whether another tensor is preferred, whether components stay open, how the jets lie among the derivatives,
/// how hard the solution is, and the place of the group.
type Cost = (u8, bool, bool, Place, u8, usize);

/// Whether no ranking has them above what they are given by; whether other derivatives of a component have rules, with which these have to
/// agree; and how many times is differentiated: a leading derivative is solved for, so that few of its derivatives are needed.
type Place = (bool, bool, Reverse<usize>);

/// Classes: data and fields without derivatives go first, those with constant coefficients before others, then conjugates.
const CONSTANT_DATA: u8 = 0;
const CONSTANT_FIELD: u8 = 1;
const PLAIN: u8 = 2;
const CONJUGATE: u8 = 3;
const CONSTANT_DERIVATIVE: u8 = 4;
const HOMOGENEOUS: u8 = 5;
const DERIVATIVE: u8 = 6;
const PLAIN_DATA: u8 = 7;

/// Rules are taken back so many times.
const MOST_TAKEN_BACK: usize = 4;

/// Determinants of matrices with more rows are not written out.
const LARGEST_DETERMINANT: usize = 3;

impl Solved<'_> {
    pub(super) fn solve(&mut self) {
        let mut undone: BTreeSet<(String, String)> = BTreeSet::new();
        for _ in 0..MOST_ROUNDS {
            if self.is_circular() {
                return;
            }
            let mut groups = std::mem::take(&mut self.left);
            for group in &mut groups {
                let parts = group
                    .equations
                    .iter()
                    .flat_map(|&e| self.parts(self.here_on(e, group.stratum)));
                group.equations = parts.map(|e| self.stripped(e)).collect();
                group.equations.retain(|&e| !self.space.vanishes(e));
            }
            groups.retain(|group| !group.equations.is_empty());
            self.left = groups;
            // Where one says that a number is zero, the others need no solution.
            if self.says_that_a_number_vanishes() {
                return;
            }
            let best = self.best();
            let conjugate = match &best {
                Some(choice) if choice.cost.0 < CONJUGATE => None,
                _ => self.conjugated(&undone),
            };
            match (conjugate, best) {
                (Some(own), _) => {
                    let label = self.left[own.group].label.clone();
                    undone.insert((label, own.function.clone()));
                    self.note_divisors(&own.matrix, &own.function);
                    self.inverted.insert(own.function);
                    self.left[own.group].equations = own.equations;
                }
                (None, Some(choice)) => {
                    if !self.adopt(choice) {
                        return;
                    }
                }
                (None, None) if self.cleaned() => {}
                (None, None) => match self.crossing() {
                    Some(group) => self.left.push(group),
                    None => return,
                },
            }
        }
    }

    fn says_that_a_number_vanishes(&self) -> bool {
        let mut all = self.left.iter().flat_map(|group| &group.equations);
        all.any(|&e| {
            let number = self.space.graph.as_number(e);
            number.is_some_and(|number| !number.is_zero())
        })
    }

    /// What a positive power is of: both vanish together.
    pub(super) fn base(&self, e: Expr) -> Expr {
        base(&self.space.graph, e)
    }

    /// The terms of a sum of which none is negative, or none positive: each vanishes where the sum does.
    fn parts(&self, e: Expr) -> Vec<Expr> {
        let g = &self.space.graph;
        let Node::Sum { constant, terms } = g.node(e) else {
            return vec![e];
        };
        let parts = terms
            .iter()
            .map(|(term, coefficient)| g.mul(&[g.number(coefficient.clone()), *term]));
        let parts: Vec<Expr> = parts.collect();
        let signs: Vec<_> = parts.iter().map(|&part| self.space.sign(part)).collect();
        let is_split = constant.is_zero()
            && (signs.iter().all(|sign| sign.is_nonnegative())
                || signs.iter().all(|sign| sign.is_nonpositive()));
        if is_split {
            parts
        } else {
            vec![e]
        }
    }

    /// An equation without factors that never vanish, and without positive powers, which vanish where what they are of does.
    pub(super) fn stripped(&self, e: Expr) -> Expr {
        let g = &self.space.graph;
        let is_product = matches!(g.node(e), Node::Product { .. });
        if !is_product && !self.may_have_assumed_factors(e) {
            return self.base(e);
        }
        let all = self.factors(e);
        let is_open = |&&factor: &&Expr| !self.space.sign(factor).is_nonzero();
        let kept: Vec<Expr> = all.iter().filter(is_open).copied().collect();
        if is_product || kept.len() < all.len() {
            g.mul(&kept)
        } else {
            self.base(e)
        }
    }

    /// Whether something assumed may be a factor of an expression, as this vanishes where that does.
    fn may_have_assumed_factors(&self, e: Expr) -> bool {
        let own = self.space.jets_in(&[e]);
        let assumptions = self.space.assumptions();
        let mut assumed = assumptions.list().iter();
        assumed.any(|assumed| {
            let difference = self.space.graph.sub(assumed.left, assumed.right);
            let difference = self.normal(difference);
            let jets = self.space.jets_in(&[difference]);
            !jets.is_empty() && jets.is_subset(&own) && self.vanishes_with(e, difference, &jets)
        })
    }

    /// Whether an expression vanishes where another does that is linear in a jet; taken to be so where it is linear in none.
    fn vanishes_with(&self, e: Expr, other: Expr, jets: &BTreeSet<Jet>) -> bool {
        if let Some(&known) = self.together.borrow().get(&(e, other)) {
            return known;
        }
        let found = self.vanishes_at_root(e, other, jets);
        self.together.borrow_mut().insert((e, other), found);
        found
    }

    fn vanishes_at_root(&self, e: Expr, other: Expr, jets: &BTreeSet<Jet>) -> bool {
        let space = self.space;
        let g = &space.graph;
        let slope = |jet: &Jet| space.partial(other, jet);
        let Some(jet) = jets
            .iter()
            .find(|jet| !space.jets_in(&[slope(jet)]).contains(jet))
        else {
            return true;
        };
        let at = |value: Expr, e: Expr| {
            space.replace(e, &|symbol| {
                (space.as_jet(symbol).as_ref() == Some(jet)).then_some(value)
            })
        };
        let root = g.neg(g.div(at(g.zero(), other), slope(jet)));
        space.seems_to_vanish(at(root, e))
    }

    /// Leaves out jets that occur in what is left although nothing depends on them; whether there were any.
    fn cleaned(&mut self) -> bool {
        let mut has_changed = false;
        for at in 0..self.left.len() {
            for k in 0..self.left[at].equations.len() {
                let mut e = self.left[at].equations[k];
                for jet in self.space.jets_in(&[e]) {
                    if !self.space.vanishes(self.space.partial(e, &jet)) {
                        continue;
                    }
                    let zero = self.space.graph.zero();
                    e = self.space.replace(e, &|symbol| {
                        (self.space.as_jet(symbol).as_ref() == Some(&jet)).then_some(zero)
                    });
                    has_changed = true;
                }
                self.left[at].equations[k] = e;
            }
        }
        has_changed
    }

    fn best(&self) -> Option<Choice> {
        let mut best: Option<Choice> = None;
        for (at, group) in self.left.iter().enumerate() {
            for jets in self.blocks(&group.equations) {
                let cost = match &best {
                    Some(best) => best.cost,
                    None => (u8::MAX, true, true, (true, true, Reverse(0)), u8::MAX, 0),
                };
                if let Some(choice) = self.choice(at, &group.equations, jets, cost) {
                    best = Some(choice);
                }
            }
        }
        best
    }

    /// Jets that are components of one tensor, or of one derivative of it.
    fn blocks(&self, equations: &[Expr]) -> Vec<Vec<Jet>> {
        let mut blocks: BTreeMap<(String, Vec<usize>), Vec<Jet>> = BTreeMap::new();
        for jet in self.space.jets_in(equations) {
            let component = self.space.component_at(jet.component);
            // Data of some variables alone say something of the others by their derivatives, which are zero and would be lost.
            if component.tensor == CURVATURE || !self.space.varies_everywhere(jet.component) {
                continue;
            }
            let tensor = component.tensor;
            blocks
                .entry((tensor, jet.by.clone()))
                .or_default()
                .push(jet);
        }
        blocks.into_values().collect()
    }

    fn choice(
        &self,
        group: usize,
        equations: &[Expr],
        jets: Vec<Jet>,
        least: Cost,
    ) -> Option<Choice> {
        let space = self.space;
        let g = &space.graph;
        let first = jets.first()?;
        let component = space.component_at(first.component);
        // The best that can come of it, before anything is computed.
        let is_given = !component.is_varied && !component.is_of_boundary;
        let hoped = match (first.by.is_empty(), component.is_varied) {
            (true, false) => CONSTANT_DATA,
            (true, true) => CONSTANT_FIELD,
            (false, _) => CONSTANT_DERIVATIVE,
        };
        let is_other = !self.preferred.is_empty() && !self.preferred.contains(&component.tensor);
        let has_rule = |jet: &Jet| self.rules.iter().any(|r| r.jet.component == jet.component);
        let place = (false, jets.iter().any(has_rule), Reverse(first.by.len()));
        if (hoped, is_other, false, place, 0, group) >= least {
            return None;
        }
        // Where derivatives stand beside them only the solution zero is one.
        let has_derivatives = self.has_derivatives(equations, &jets);
        if has_derivatives && !self.are_homogeneous(equations, &jets) {
            return None;
        }
        let occurs = |es: &[Expr]| space.jets_in(es).iter().any(|jet| jets.contains(jet));
        let mut matrix = Vec::new();
        for &e in equations {
            let row: Vec<Expr> = jets.iter().map(|jet| space.partial(e, jet)).collect();
            if occurs(&row) {
                return None;
            }
            matrix.push(row);
        }
        let is_constant = matrix
            .iter()
            .all(|row| space.jets_in(row).is_empty() && self.is_free(row));
        let Pivots { rows, columns } = self.pivots_of(&matrix)?;
        if !is_constant && self.meets_product(equations, &rows) {
            return None;
        }
        let class = match (hoped, is_constant) {
            _ if has_derivatives => HOMOGENEOUS,
            (class, true) => class,
            (CONSTANT_DERIVATIVE, false) => DERIVATIVE,
            // Given data are solved for by numbers only: else where a coefficient vanishes something false would follow.
            (_, false) if is_given => PLAIN_DATA,
            (_, false) => PLAIN,
        };
        let is_open = columns.len() < jets.len();
        if columns.is_empty()
            || (has_derivatives && is_open)
            || (class, is_other, is_open, place, 0, group) >= least
        {
            return None;
        }
        let chosen: Vec<Jet> = columns.iter().map(|&c| jets[c].clone()).collect();
        let zero = |symbol| {
            let jet = space.as_jet(symbol)?;
            chosen.contains(&jet).then(|| g.zero())
        };
        let rest: Vec<Expr> = rows
            .iter()
            .map(|&r| space.replace(equations[r], &zero))
            .collect();
        let all = matrix;
        let own: Vec<Vec<Expr>> = rows.iter().map(|&r| all[r].clone()).collect();
        let matrix = columns_of(&own, &columns);
        let are_numbers = matrix.iter().flatten().all(|&e| g.as_number(e).is_some());
        let effort = if are_numbers {
            0
        } else if self.recognized(&matrix, &rest).is_some() {
            1
        } else {
            2
        };
        if (class, is_other, is_open, place, effort, group) >= least {
            return None;
        }
        let place = (!self.may_lead(&chosen, &matrix, &rest), place.1, place.2);
        let cost = (class, is_other, is_open, place, effort, group);
        if cost >= least {
            return None;
        }
        let is_regular = is_constant || self.has_full_rank(&columns_of(&all, &columns));
        if !is_regular && chosen.len() > LARGEST_DETERMINANT {
            return None;
        }
        Some(Choice {
            cost,
            group,
            jets: chosen,
            rows,
            matrix,
            rest,
            is_regular,
        })
    }

    /// Whether jets may be above all others in their equations.
    fn may_lead(&self, chosen: &[Jet], matrix: &[Vec<Expr>], rest: &[Expr]) -> bool {
        let mut others = self.space.jets_in(rest);
        others.extend(self.space.jets_in(&matrix.concat()));
        let all = chosen.iter().map(|jet| (jet.clone(), others.clone()));
        self.ranking_with(all.collect()).is_some()
    }

    /// Whether what would be divided by may vanish in a case of a product that is left: what such a one says is known in each case only.
    /// Of several equations that are solved together the determinant is named instead, unless they are products themselves.
    fn meets_product(&self, equations: &[Expr], rows: &[usize]) -> bool {
        let g = &self.space.graph;
        if rows.len() == 1 {
            let mut left = self.left.iter().flat_map(|group| &group.equations);
            return left.any(|&e| self.is_product(e));
        }
        let is_written_so = |e: Expr| matches!(g.node(e), Node::Product { .. });
        let mut own = rows.iter().map(|&row| equations[row]);
        own.any(|e| is_written_so(e) && self.is_product(e))
    }

    /// Whether coefficients are free of the normal too, whose components may vanish.
    pub(super) fn is_free(&self, row: &[Expr]) -> bool {
        let g = &self.space.graph;
        let symbols = self.space.symbols_in(row);
        symbols.iter().all(|&s| !self.space.is_of_surface(s))
            && g.symbols_in(row)
                .iter()
                .all(|&s| !self.space.is_application(s))
    }

    /// Whether a derivative of one of the jets occurs beside them.
    fn has_derivatives(&self, equations: &[Expr], jets: &[Jet]) -> bool {
        self.space.jets_in(equations).iter().any(|other| {
            jets.iter().any(|jet| {
                other.component == jet.component
                    && other.by.len() > jet.by.len()
                    && rest(&other.by, &jet.by).is_some()
            })
        })
    }

    /// Whether equations hold where the jets vanish.
    fn are_homogeneous(&self, equations: &[Expr], jets: &[Jet]) -> bool {
        let space = self.space;
        let zero = |symbol| {
            let jet = space.as_jet(symbol)?;
            jets.contains(&jet).then(|| space.graph.zero())
        };
        let mut rests = equations.iter().map(|&e| space.replace(e, &zero));
        rests.all(|e| self.space.vanishes(e))
    }

    pub(super) fn pivots_of(&self, matrix: &[Vec<Expr>]) -> Option<Pivots> {
        let assumptions = self.space.assumptions();
        let columns = matrix.first()?.len();
        let entries: Vec<Expr> = matrix
            .iter()
            .flatten()
            .map(|&e| self.space.on_sphere(e))
            .collect();
        let test = RankTest {
            rows: matrix.len(),
            columns,
            entries: &entries,
            solved: &[],
            implicit: &[],
            assumptions: &assumptions,
            options: Options::default(),
        };
        let rank = generic_rank(&self.space.graph, &test).ok()?;
        (rank.minimum == rank.maximum).then_some(rank.pivots)
    }

    /// The solution of `matrix x + rest = 0`: one that is recognized, else by elimination.
    fn solution(&self, matrix: &[Vec<Expr>], rest: &[Expr]) -> Option<Vec<Expr>> {
        let g = &self.space.graph;
        if let Some(found) = self.recognized(matrix, rest) {
            return Some(found);
        }
        let right: Vec<Expr> = rest.iter().map(|&e| g.neg(e)).collect();
        g.solve(&matrix.concat(), &right).ok()
    }

    fn recognized(&self, matrix: &[Vec<Expr>], rest: &[Expr]) -> Option<Vec<Expr>> {
        let candidates = self.candidates(rest).into_iter();
        let mut fitting = candidates.filter(|candidate| candidate.len() == matrix.len());
        fitting.find(|candidate| self.solves(matrix, rest, candidate))
    }

    /// Tensors that a solution may be: gradients that occur, tensors that have a name.
    fn candidates(&self, rest: &[Expr]) -> Vec<Vec<Expr>> {
        let mut found = Vec::new();
        for (function, arguments) in self.space.gradients_in(rest) {
            found.push(self.space.gradient(function, &arguments));
            found.push(arguments);
        }
        for named in self.space.named_arguments() {
            found.push(named.iter().map(|&e| self.normal(e)).collect());
        }
        found
    }

    fn solves(&self, matrix: &[Vec<Expr>], rest: &[Expr], x: &[Expr]) -> bool {
        let g = &self.space.graph;
        matrix.iter().zip(rest).all(|(row, &rest)| {
            let mut terms: Vec<Expr> = row.iter().zip(x).map(|(&a, &x)| g.mul(&[a, x])).collect();
            terms.push(rest);
            let e = g.add(&terms);
            // Most candidates are none, which one point of a prime field tells.
            let mut forms = [e, self.space.explicit(e)].into_iter();
            forms.any(|e| self.space.seems_to_vanish(self.space.on_sphere(e)))
                && self.space.vanishes(e)
        })
    }

    fn adopt(&mut self, choice: Choice) -> bool {
        let Some(values) = self.solution(&choice.matrix, &choice.rest) else {
            return false;
        };
        if let Some(jet) = choice.jets.first() {
            let tensor = self.space.component_at(jet.component).tensor;
            self.note_divisors(&choice.matrix, &tensor);
        }
        let divisor = (choice.matrix.len() <= LARGEST_DETERMINANT)
            .then(|| determinant(&self.space.graph, &choice.matrix));
        let of = |jet: &Jet| self.space.component_at(jet.component).tensor;
        let tensor = choice.jets.first().map(of).unwrap_or_default();
        let group = &self.left[choice.group];
        let stratum = group.stratum;
        self.adopted.push(Adopted {
            first_rule: self.rules.len(),
            equations: Open {
                label: group.label.clone(),
                equations: choice
                    .rows
                    .iter()
                    .map(|&row| group.equations[row])
                    .collect(),
                stratum,
            },
            singular: match divisor {
                Some(divisor) if !choice.is_regular => self.singular_factors(divisor),
                _ => Vec::new(),
            },
            tensor,
            divisor,
        });
        for (jet, value) in choice.jets.into_iter().zip(values) {
            let across = self.across(&jet, stratum);
            self.rules.push(Rule {
                jet,
                value,
                stratum,
                across,
            });
        }
        self.ranking = self.ranking_with(Vec::new());
        self.known.borrow_mut().clear();
        let group = &mut self.left[choice.group];
        let mut row = 0;
        group.equations.retain(|_| {
            row += 1;
            !choice.rows.contains(&(row - 1))
        });
        true
    }

    /// Takes back rules that were found by dividing by what vanishes in the case at hand, with all that came after them: their equations
    /// are left again.
    pub(super) fn take_back(&mut self) {
        for _ in 0..MOST_TAKEN_BACK {
            let has_vanished = |own: &Adopted| {
                let divisor = own
                    .divisor
                    .filter(|&e| self.space.graph.as_number(e).is_none());
                divisor.is_some_and(|e| self.space.vanishes(self.here(e)))
            };
            let Some(at) = self.adopted.iter().position(has_vanished) else {
                return;
            };
            self.take_back_from(at);
            self.solve();
        }
        self.give_up();
    }

    /// Takes back the rules that were found at some step and later.
    pub(super) fn take_back_from(&mut self, at: usize) {
        let taken = self.adopted.split_off(at);
        let first = taken.first().map_or(self.rules.len(), |own| own.first_rule);
        self.rules.truncate(first);
        for mut own in taken.into_iter().rev().map(|own| own.equations) {
            own.stratum = self.narrowed(own.stratum, self.everywhere());
            self.left.push(own);
        }
        self.crossed.clear();
        self.known.borrow_mut().clear();
        self.ranking = Some(Ranking::by_order(self.space));
        self.ranking = self.ranking_with(Vec::new());
    }

    /// Forgets all equations: where rules are found again and again by dividing by what vanishes, as one makes the divisor of another zero,
    /// nothing that was made of them is known to hold.
    fn give_up(&mut self) {
        self.rules.clear();
        self.adopted.clear();
        self.left.clear();
        self.crossed.clear();
        self.known.borrow_mut().clear();
        self.is_circular.set(true);
    }

    /// `B'(Y) = X` as `Y = A'(X)` in a group that was not changed yet.
    fn conjugated(&self, undone: &BTreeSet<(String, String)>) -> Option<Undone> {
        let space = self.space;
        let g = &space.graph;
        for (at, group) in self.left.iter().enumerate() {
            for (function, arguments) in space.gradients_in(&group.equations) {
                let own = space.function_at(function);
                if undone.contains(&(group.label.clone(), own.name.clone())) {
                    continue;
                }
                let Some(conjugate) = space.undoing(function) else {
                    continue;
                };
                let gradient = space.gradient(function, &arguments);
                let symbols: Vec<_> = gradient.iter().filter_map(|&e| g.as_symbol(e)).collect();
                if symbols.len() != gradient.len() || group.equations.len() != gradient.len() {
                    continue;
                }
                let one = g.one();
                let matrix: Vec<Vec<Expr>> = group
                    .equations
                    .iter()
                    .map(|&e| {
                        let slope = |&own| {
                            g.derive(&[e], &|s| (s == own).then_some(one))
                                .swap_remove(0)
                        };
                        symbols.iter().map(slope).collect()
                    })
                    .collect();
                if g.any_contains_any(&matrix.concat(), &symbols) {
                    continue;
                }
                let full = self
                    .pivots_of(&matrix)
                    .is_some_and(|p| p.rows.len() == gradient.len())
                    && self.has_full_rank(&matrix);
                let rows: Vec<usize> = (0..group.equations.len()).collect();
                let divides_product = self.has_fields(&matrix.concat())
                    && self.meets_product(&group.equations, &rows);
                if !full || divides_product {
                    continue;
                }
                let zeros: Vec<(Expr, Expr)> = gradient.iter().map(|&e| (e, g.zero())).collect();
                let rest = g.substitute_all(&group.equations, &zeros);
                let Some(x) = self.solution(&matrix, &rest) else {
                    continue;
                };
                let image = space.gradient(conjugate, &x);
                let equations = arguments
                    .iter()
                    .zip(image)
                    .map(|(&y, a)| g.sub(y, a))
                    .collect();
                return Some(Undone {
                    group: at,
                    equations,
                    function: own.name,
                    matrix,
                });
            }
        }
        None
    }

    /// What must not vanish so that a matrix is regular, with functions as their formulas.
    fn note_divisors(&mut self, matrix: &[Vec<Expr>], tensor: &str) {
        let of_row = |row: &Vec<Expr>| row.iter().map(|&e| self.space.explicit(e)).collect();
        let matrix: Vec<Vec<Expr>> = matrix.iter().map(of_row).collect();
        let g = &self.space.graph;
        let is_small = matrix.len() <= LARGEST_DETERMINANT;
        let divisor = is_small.then(|| determinant(g, &matrix));
        if let Some(divisor) = divisor.filter(|&e| g.as_number(e).is_none()) {
            self.divisors.insert(divisor);
        }
        if divisor.is_some_and(|e| self.space.sign(e).is_nonzero()) {
            return;
        }
        let entries = if self.has_functions(&matrix.concat()) {
            Entries::Functions
        } else if self.has_fields(&matrix.concat()) {
            Entries::Fields
        } else if matrix.iter().all(|row| self.is_free(row)) {
            return self.note_nonzero(&matrix, tensor);
        } else {
            Entries::Normal
        };
        if let Some(divisor) = divisor {
            self.note_parameters(divisor);
        }
        let tensor = tensor.to_owned();
        self.note_pivot(Pivot {
            tensor,
            entries,
            divisor: None,
        });
    }

    /// The factors without fields and the normal of what was divided by.
    fn note_parameters(&mut self, divisor: Expr) {
        let g = &self.space.graph;
        let symbols = g.symbols_in(&[divisor]);
        let factors = chetaev_symbolic::factors::factors(g, divisor, &symbols).unwrap_or_default();
        for (factor, _) in factors {
            let is_open = g.as_number(factor).is_none() && !self.space.sign(factor).is_nonzero();
            if is_open && self.is_free(&[factor]) && !self.has_fields(&[factor]) {
                self.nonzero.insert(factor);
            }
        }
    }

    fn note_pivot(&mut self, pivot: Pivot) {
        if !self.pivots.contains(&pivot) {
            self.pivots.push(pivot);
        }
    }

    /// Whether fields, data or functions of them occur; the curvature is none.
    pub(super) fn has_fields(&self, es: &[Expr]) -> bool {
        let space = self.space;
        let mut jets = space.jets_in(es).into_iter();
        let symbols = space.graph.symbols_in(es);
        jets.any(|jet| !space.is_curvature(jet.component))
            || symbols.into_iter().any(|s| space.is_application(s))
    }

    /// What must not vanish so that a matrix without fields is regular: the factors of its determinant in which something occurs that
    /// has no value. A large matrix is named by what was solved for.
    fn note_nonzero(&mut self, matrix: &[Vec<Expr>], tensor: &str) {
        let g = &self.space.graph;
        let symbols = g.symbols_in(&matrix.concat());
        if symbols.is_empty() {
            return;
        }
        let entry = |i: usize, j: usize| matrix.get(i).and_then(|row| row.get(j));
        let size = matrix.len();
        let is_diagonal = (0..size)
            .all(|i| (0..size).all(|j| i == j || entry(i, j).is_some_and(|&e| g.is_zero(e))));
        let divisors: Vec<Expr> = if is_diagonal {
            (0..size).filter_map(|i| entry(i, i).copied()).collect()
        } else if size <= LARGEST_DETERMINANT {
            vec![determinant(g, matrix)]
        } else {
            self.note_pivot(Pivot {
                tensor: tensor.to_owned(),
                entries: Entries::Parameters,
                divisor: None,
            });
            return;
        };
        let divisors: BTreeSet<Expr> = divisors.into_iter().collect();
        for divisor in divisors {
            let factors = chetaev_symbolic::factors::factors(g, divisor, &symbols);
            let factors = factors.unwrap_or_else(|| vec![(divisor, 1)]);
            for (factor, _) in factors {
                let is_open =
                    g.as_number(factor).is_none() && !self.space.sign(factor).is_nonzero();
                if is_open {
                    self.nonzero.insert(factor);
                }
            }
        }
    }
}

/// Columns of a matrix.
fn columns_of(matrix: &[Vec<Expr>], columns: &[usize]) -> Vec<Vec<Expr>> {
    let of = |row: &Vec<Expr>| columns.iter().map(|&c| row[c]).collect();
    matrix.iter().map(of).collect()
}

/// What a positive power is of: both vanish together.
pub(super) fn base(g: &Graph, e: Expr) -> Expr {
    match g.node(e) {
        Node::Power { base, exponent } => {
            let exponent = g.as_number(*exponent);
            let is_positive = exponent.is_some_and(|n| !rational::is_negative(n));
            if is_positive {
                *base
            } else {
                e
            }
        }
        _ => e,
    }
}
