//! Equations between jets solved one group after the other, and what follows from them.
//!
//! A group of equations that is linear in the components of one tensor, or of one derivative of it, gives rules
//! for these; the gradient of a function with a conjugate is undone by the conjugate. Rules are differentiated as needed. What is
//! solved is triangular, so that an expression in which no rule applies any more is a function of free jets, and vanishes
//! where the equations hold exactly when it vanishes identically. For that, two rules that give the same derivative of a component have to
//! agree: their difference is one more equation. While equations are solved, these are the integrability conditions of Riquier and Janet
//! that do not raise the order. Before something is said not to follow, the others are taken too, up to [`Solved::highest`]: what
//! follows by differentiation and elimination is no counterexample, and where conditions beyond that order are left nothing is refuted.
//!
//! Which jet of an equation is solved for is chosen by what it costs, and so that there is a ranking of all jets (C. Riquier 1910) in which
//! it is the highest (`ranking`). Where there is none, rules may lead back to each other, or hide a condition. A circle is cut where it
//! closes: what is proved remains so, since a rule that is not used takes nothing away, but what is left over is no normal form, and nothing
//! is refuted with it.
//!
//! A product is not solved: it vanishes where one of its factors does, and on open sets that are dense together one factor does
//! identically, so that each is a case of its own ([`Solved::cases`]).
//!
//! An equation of a face is solved with those of the body and of the face alone, so that its rules may be differentiated along it; what
//! follows from two faces together holds where they meet (`strata`).
//!
//! A field that is known on a curved piece of the boundary is what is known plus the distance from the piece times a new free field
//! (see [`boundary`](crate::boundary)): so the derivatives along the piece are known, and the one across it is not.

mod consequences;
mod rank;
mod ranking;
mod solver;
mod strata;

pub(crate) use self::consequences::factors_of;

pub(crate) use self::rank::choices;
use self::ranking::Ranking;
use self::strata::{Face, Stratum};
use crate::functional::Side;
use crate::space::{rest, Jet, Space};
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::verdict::{Counterexample, PointValue, Proof};
use chetaev_symbolic::zero::assumptions::{Assumptions, Relation};
use chetaev_symbolic::{rational, Expr, Node, Rational, Verdict};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Seconds of work for conditions of integrability that raise the order: they decide whether something is refuted, and products of many
/// derivatives have so many that the rest of a study would wait for them.
const PROLONGING: f64 = 3.0;

/// Cases in which something vanishes that was divided by are followed so far into each other.
const MOST_SINGULAR: usize = 3;

/// Equations that belong together: the components of one.
#[derive(Clone, Debug)]
pub struct Group {
    /// What they are called.
    pub label: String,
    /// Expressions that vanish.
    pub equations: Vec<Expr>,
}

/// Equations that are not solved, and where they hold.
#[derive(Clone, Debug)]
pub struct Open {
    /// What they are called.
    pub label: String,
    /// Expressions that vanish.
    pub equations: Vec<Expr>,
    stratum: Stratum,
}

impl Open {
    fn of(group: Group, stratum: Stratum) -> Open {
        let Group { label, equations } = group;
        Open {
            label,
            equations,
            stratum,
        }
    }
}

/// Equations solved as far as possible.
#[derive(Clone, Debug)]
pub struct Solved<'s> {
    pub(crate) space: &'s Space,
    rules: Vec<Rule>,
    adopted: Vec<Adopted>,
    /// The faces on which equations hold.
    faces: Vec<Face>,
    /// Where new equations hold.
    stratum: Stratum,
    /// Whether equations are looked at where faces meet, although they hold elsewhere too.
    is_narrowed: bool,
    preferred: BTreeSet<String>,
    /// Expressions that are not negative, as is known besides: a counterexample keeps to them.
    nonnegative: Vec<Expr>,
    /// Pairs of rules that were compared.
    crossed: BTreeSet<(usize, usize)>,
    /// Up to which order conditions of integrability that raise the order are taken; none of them where it is `None`.
    order: Option<usize>,
    /// Whether there are conditions beyond that order.
    is_cut: bool,
    /// With further conditions, once they were asked for; nothing where they are too much work.
    prolonged: RefCell<Option<Option<Rc<Solved<'s>>>>>,
    /// Values of jets on strata.
    known: RefCell<BTreeMap<(Stratum, Jet), Expr>>,
    /// The jets whose values are being computed, each for that of the one before.
    open: RefCell<Vec<Jet>>,
    /// In which every rule gives a jet by lower ones; none where there is no such ranking.
    ranking: Option<Ranking>,
    /// Whether rules led back to each other.
    is_circular: Cell<bool>,
    /// Whether expressions vanish where others do.
    together: RefCell<BTreeMap<(Expr, Expr), bool>>,
    /// Whether matrices have independent columns everywhere.
    ranks: RefCell<BTreeMap<Vec<Vec<Expr>>, bool>>,
    /// The factors of equations.
    factors: RefCell<BTreeMap<Expr, Vec<Expr>>>,
    /// Factors that vanish in the case at hand.
    pub case: Vec<Expr>,
    /// Equations that are left, with their labels.
    pub left: Vec<Open>,
    /// Matrices that were inverted and are no numbers.
    pub pivots: Vec<Pivot>,
    /// Functions undone by their conjugates.
    pub inverted: BTreeSet<String>,
    /// Expressions in parameters and data that were divided by.
    pub nonzero: BTreeSet<Expr>,
    /// All that was divided by and is no number, also what is known not to vanish inside.
    pub divisors: BTreeSet<Expr>,
}

/// A matrix that has to be regular where equations are solved.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pivot {
    /// The tensor solved for.
    pub tensor: String,
    /// What its entries depend on.
    pub entries: Entries,
    /// What must not vanish so that it is regular, where that is short.
    pub divisor: Option<String>,
}

impl Pivot {
    /// `, where v^2 + w^2 ≠ 0`.
    pub fn said(&self) -> String {
        match (&self.divisor, self.entries) {
            (Some(divisor), _) => format!(", where {divisor} ≠ 0"),
            (None, Entries::Parameters) => format!(", where the matrix of the coefficients of {}, in which parameters stand, is regular", self.tensor),
            (None, Entries::Functions) => format!(", where the coefficients of {}, in which functions of fields occur, are regular", self.tensor),
            (None, _) => format!(", where the coefficients of {}, in which fields occur, are regular", self.tensor),
        }
    }
}

/// On what the entries of a matrix depend: the first of these that occurs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entries {
    /// Functions of fields or data of which no formula is known.
    Functions,
    /// Fields or data; where they vanish that is a case of its own.
    Fields,
    /// The normal.
    Normal,
    /// Parameters only; the matrix is too large for its determinant to be printed.
    Parameters,
}

/// A jet with its value.
#[derive(Clone, Debug)]
struct Rule {
    jet: Jet,
    value: Expr,
    /// Where it holds, and so by what it may be differentiated.
    stratum: Stratum,
    /// On a curved piece the value is continued by the distance times this component.
    across: Option<usize>,
}

/// Equations that gave rules, with the first of these and what was divided by.
#[derive(Clone, Debug)]
struct Adopted {
    first_rule: usize,
    equations: Open,
    divisor: Option<Expr>,
    /// Factors of it whose zeros are cases of their own.
    singular: Vec<Expr>,
    /// What was solved for.
    tensor: String,
}

/// At so many points a factor between two equations is looked for.
const MOST_POINTS: usize = 4;

/// An equation that is left, and what was divided by, is printed up to so many signs.
const LONGEST_NAMED: usize = 60;

/// Most rounds; each solves one group or changes its form.
const MOST_ROUNDS: usize = 200;

/// How often the value of a jet may need that of a derivative of it, one for the other, before this is called a circle.
const MOST_RISES: usize = 3;

impl<'s> Solved<'s> {
    /// Nothing solved yet.
    pub fn new(space: &'s Space) -> Solved<'s> {
        Solved {
            space,
            rules: Vec::new(),
            adopted: Vec::new(),
            faces: Vec::new(),
            stratum: Stratum::default(),
            is_narrowed: false,
            preferred: BTreeSet::new(),
            nonnegative: Vec::new(),
            crossed: BTreeSet::new(),
            order: None,
            is_cut: false,
            prolonged: RefCell::default(),
            known: RefCell::default(),
            open: RefCell::default(),
            ranking: Some(Ranking::by_order(space)),
            is_circular: Cell::new(false),
            together: RefCell::default(),
            ranks: RefCell::default(),
            factors: RefCell::default(),
            case: Vec::new(),
            left: Vec::new(),
            pivots: Vec::new(),
            inverted: BTreeSet::new(),
            nonzero: BTreeSet::new(),
            divisors: BTreeSet::new(),
        }
    }

    /// Solves for these tensors before others.
    #[must_use]
    pub fn preferring(mut self, tensors: &[String]) -> Solved<'s> {
        self.preferred = tensors.iter().cloned().collect();
        self
    }

    /// The same where expressions are not negative.
    #[must_use]
    pub fn where_nonnegative(mut self, es: &[Expr]) -> Solved<'s> {
        self.nonnegative.extend(es);
        self
    }

    /// The same with more equations, which hold on a piece of the boundary and may be differentiated along it only.
    #[must_use]
    pub fn with_on(&self, side: &Side, groups: &[Group]) -> Solved<'s> {
        let mut own = self.clone();
        own.enter(side);
        own.with(groups)
    }

    /// The same with more equations, which hold where all faces meet.
    #[must_use]
    pub fn with_where_meeting(&self, groups: &[Group]) -> Solved<'s> {
        let mut own = self.clone();
        own.enter_meeting();
        own.with(groups)
    }

    /// The same with more equations, which hold at a single place and may not be differentiated.
    #[must_use]
    pub fn with_at_point(&self, groups: &[Group]) -> Solved<'s> {
        let mut own = self.clone();
        own.enter_point();
        own.with(groups)
    }

    /// The same with more equations.
    #[must_use]
    pub fn with(&self, groups: &[Group]) -> Solved<'s> {
        let mut own = self.clone();
        let new = groups.iter().cloned();
        own.left
            .extend(new.map(|group| Open::of(group, self.stratum)));
        own.prolonged = RefCell::default();
        own.solve();
        if own.is_on_boundary() {
            // What was divided by in the interior may vanish on the boundary.
            own.take_back();
        }
        own
    }

    /// An expression where the equations hold, and at the place where they do.
    pub fn here(&self, e: Expr) -> Expr {
        self.here_on(e, self.everywhere())
    }

    /// The same on a stratum, by what holds on all of it.
    fn here_on(&self, e: Expr, stratum: Stratum) -> Expr {
        self.placed(self.normal_on(e, stratum), stratum)
    }

    /// The order up to which conditions of integrability are looked at before something is refuted: two derivatives of the highest order
    /// meet at the latest at twice that order, and what comes of it may be differentiated once more.
    pub fn highest(&self) -> usize {
        let orders = self.rules.iter().map(|rule| rule.jet.by.len());
        2 * orders.max().unwrap_or(0) + 1
    }

    /// The same with the conditions of integrability that raise the order; nothing where these are too much work.
    fn prolonged(&self) -> Option<Rc<Solved<'s>>> {
        let known = self.prolonged.borrow().clone();
        if let Some(known) = known {
            return known;
        }
        let mut own = self.clone();
        own.order = Some(self.highest());
        own.is_cut = false;
        own.crossed.clear();
        let solved = within(&Work::of_seconds(PROLONGING), move || {
            own.solve();
            own
        });
        let made = solved.ok().map(Rc::new);
        *self.prolonged.borrow_mut() = Some(made.clone());
        made
    }

    /// An expression where the equations hold: rules and their derivatives put in.
    pub fn normal(&self, e: Expr) -> Expr {
        self.normal_on(e, self.everywhere())
    }

    fn normal_on(&self, e: Expr, stratum: Stratum) -> Expr {
        let mut e = e;
        // A function undone by its conjugate may bring back a jet that has a rule.
        for _ in 0..MOST_ROUNDS {
            let ruled = |jet: &Jet| self.rule(jet, stratum).is_some();
            if !self.space.jets_in(&[e]).iter().any(ruled) {
                return e;
            }
            e = self.space.replace(e, &|symbol| {
                let jet = self.space.as_jet(symbol)?;
                self.rule(&jet, stratum)?;
                Some(self.value(&jet, stratum))
            });
            if self.is_circular() {
                return e;
            }
        }
        e
    }

    /// The rule that gives a jet on a stratum, and by what it is differentiated for that.
    fn rule(&self, jet: &Jet, stratum: Stratum) -> Option<(&Rule, Vec<usize>)> {
        self.rules.iter().find_map(|rule| {
            if rule.jet.component != jet.component || !stratum.lies_in(rule.stratum) {
                return None;
            }
            let rest = rest(&jet.by, &rule.jet.by)?;
            self.may_differentiate(rule, &rest).then_some((rule, rest))
        })
    }

    fn value(&self, jet: &Jet, stratum: Stratum) -> Expr {
        let key = (stratum, jet.clone());
        if let Some(&known) = self.known.borrow().get(&key) {
            return known;
        }
        let own = self.space.jet(jet.component, &jet.by);
        let value = match self.rule(jet, stratum) {
            Some(_) if self.closes_circle(jet) => {
                self.is_circular.set(true);
                return own;
            }
            Some((rule, rest)) => {
                self.open.borrow_mut().push(jet.clone());
                let value = self.normal_on(self.derived(rule, &rest), stratum);
                self.open.borrow_mut().pop();
                value
            }
            None => own,
        };
        self.known.borrow_mut().insert(key, value);
        value
    }

    /// Whether the value of a jet is needed for itself, or again and again for derivatives of itself: of infinitely many jets of finitely
    /// many components there are always such (L. E. Dickson 1913), so that every chain of rules without an end is met.
    fn closes_circle(&self, jet: &Jet) -> bool {
        let open = self.open.borrow();
        let is_below =
            |own: &&Jet| own.component == jet.component && rest(&jet.by, &own.by).is_some();
        open.contains(jet) || open.iter().filter(is_below).count() > MOST_RISES
    }

    /// Whether rules led back to each other, so that nothing can be refuted.
    pub fn is_circular(&self) -> bool {
        self.is_circular.get()
    }

    /// What a rule gives for a derivative of its jet.
    fn derived(&self, rule: &Rule, by: &[usize]) -> Expr {
        let space = self.space;
        let own = space.totals(rule.value, by);
        match rule.across {
            Some(across) if !by.is_empty() => {
                let moved = space.of_distance_times(space.jet(across, &[]), by);
                space.graph.add(&[own, moved])
            }
            _ => own,
        }
    }

    /// The next pair of rules that give the same derivative of a component: what each gives has to agree.
    fn crossing(&mut self) -> Option<Open> {
        for later in 0..self.rules.len() {
            for earlier in 0..later {
                if self.crossed.contains(&(earlier, later)) {
                    continue;
                }
                self.crossed.insert((earlier, later));
                let (a, b) = (&self.rules[earlier], &self.rules[later]);
                if a.jet.component != b.jet.component {
                    continue;
                }
                let (by_a, by_b) = (missing(&b.jet.by, &a.jet.by), missing(&a.jet.by, &b.jet.by));
                if !self.may_differentiate(a, &by_a) || !self.may_differentiate(b, &by_b) {
                    continue;
                }
                // Where neither is a derivative of the other, what follows is of higher order than both.
                let is_above = !by_a.is_empty() && !by_b.is_empty();
                if is_above
                    && self
                        .order
                        .is_none_or(|most| a.jet.by.len() + by_a.len() > most)
                {
                    self.is_cut = true;
                    continue;
                }
                let g = &self.space.graph;
                let difference = g.sub(self.derived(a, &by_a), self.derived(b, &by_b));
                let name = self.space.component_at(a.jet.component).name;
                return Some(Open {
                    label: format!("integrability of {name}"),
                    equations: vec![difference],
                    stratum: a.stratum.meeting(b.stratum),
                });
            }
        }
        None
    }

    /// The verdict on an expression where the equations hold, with a counterexample where one is found. Of equations that could not be solved no
    /// counterexample is sought.
    pub fn verdict(&self, e: Expr) -> Verdict {
        let mut proof = match self.verdict_in_general(e) {
            Verdict::Proved(proof) => proof,
            other => return other,
        };
        match self.where_singular(&[e]) {
            Err(found) => Verdict::Refuted(*found),
            Ok(open) => {
                for own in open.iter().map(Pivot::said) {
                    proof.on.push_str(&own);
                    proof.detail.push_str(&own);
                }
                Verdict::Proved(proof)
            }
        }
    }

    fn verdict_in_general(&self, e: Expr) -> Verdict {
        let whole = self.verdict_as_solved(e);
        if matches!(whole, Verdict::Proved(_)) {
            return whole;
        }
        let Some(cases) = self.cases() else {
            return self.without_refutation(whole);
        };
        let mut all = Verdict::Proved(Proof::exact("", ""));
        for case in cases {
            let own = case.without_refutation(case.verdict_as_solved(e));
            if let Verdict::Refuted(found) = own {
                return Verdict::Refuted(case.with_case(found));
            }
            all = all.and(own);
        }
        all
    }

    /// A counterexample with the factors that vanish in the case at hand.
    fn with_case(&self, mut found: Counterexample) -> Counterexample {
        let vanishing = self.case.iter().map(|&factor| PointValue {
            name: self.space.graph.text(factor),
            exact: Some(Rational::ZERO),
            enclosure: None,
        });
        found.point.extend(vanishing);
        found
    }

    /// What is known not to be negative at the place that is looked at, and may be so elsewhere: the branch of a root or an absolute value.
    pub fn nonnegative(&self) -> &[Expr] {
        &self.nonnegative
    }

    /// Whether fields or data, or functions of them, occur in what was divided by.
    pub fn is_divided_by_jets(&self) -> bool {
        let has_jets = |e: &Expr| !self.space.jets_in(&[*e]).is_empty();
        let of_fields =
            |pivot: &Pivot| matches!(pivot.entries, Entries::Fields | Entries::Functions);
        self.divisors.iter().any(has_jets) || self.pivots.iter().any(of_fields)
    }

    /// The same in any case where an equation that is left is a product.
    pub fn is_divided_by_jets_in_a_case(&self) -> bool {
        let cases = self.cases().into_iter().flatten();
        self.is_divided_by_jets() || cases.into_iter().any(|case| case.is_divided_by_jets())
    }

    /// What the equations say beyond others: jets less their values, and what could not be solved.
    pub fn beyond(&self, others: &Solved<'_>) -> Vec<Expr> {
        let space = self.space;
        let is_new = |rule: &&Rule| !others.rules.iter().any(|own| own.jet == rule.jet);
        let equation = |rule: &Rule| {
            let jet = space.jet(rule.jet.component, &rule.jet.by);
            space.graph.sub(jet, self.normal(rule.value))
        };
        let known: BTreeSet<Expr> = others.open_equations().collect();
        let left = self.open_equations().filter(|e| !known.contains(e));
        let rules = self.rules.iter().filter(is_new).map(equation);
        rules.chain(left).collect()
    }

    /// The jets that the equations give beyond others.
    pub fn jets_beyond(&self, others: &Solved<'_>) -> Vec<Jet> {
        let is_known = |jet: &Jet| others.rules.iter().any(|own| own.jet == *jet);
        let all = self.rules.iter().map(|rule| rule.jet.clone());
        all.filter(|jet| !is_known(jet)).collect()
    }

    fn open_equations(&self) -> impl Iterator<Item = Expr> + '_ {
        self.left
            .iter()
            .flat_map(|group| group.equations.iter().copied())
    }

    /// A group that is left by its label, and what is left of it where that is short.
    pub fn named(&self, group: &Open) -> String {
        let texts = group.equations.iter().map(|&e| self.space.graph.text(e));
        let label = if group.label.starts_with("the ") {
            group.label.clone()
        } else {
            format!("`{}`", group.label)
        };
        match texts.collect::<Vec<_>>().as_slice() {
            [text] if text.len() <= LONGEST_NAMED && !self.divides_by_zero(&group.equations) => {
                format!("{label}, of which {text} = 0 is left,")
            }
            _ => label,
        }
    }

    /// Whether something is divided by zero: what was solved for does not go with what it is put into.
    fn divides_by_zero(&self, es: &[Expr]) -> bool {
        let g = &self.space.graph;
        let mut all = g.reachable(es).into_iter();
        all.any(|e| match g.node(e) {
            Node::Power { base, exponent } => {
                let is_negative = g.as_number(*exponent).is_some_and(rational::is_negative);
                g.is_zero(*base) && is_negative
            }
            _ => false,
        })
    }

    /// A verdict, but that nothing is refuted while an equation is left that could not be solved.
    fn without_refutation(&self, verdict: Verdict) -> Verdict {
        match (&verdict, self.left.first()) {
            (Verdict::Refuted(_), Some(left)) => Verdict::undecided(format!(
                "{} could not be solved for any field",
                self.named(left)
            )),
            _ => verdict,
        }
    }

    /// The verdict with what is solved alone, whatever is left.
    pub fn verdict_as_solved(&self, e: Expr) -> Verdict {
        let own = self.here(e);
        match self.space.vanishing(&[own], false) {
            Verdict::Proved(proof) => Verdict::Proved(proof),
            _ if self.is_multiple(own) => Verdict::Proved(Proof::exact(
                "",
                "it is a multiple of an equation that holds, by a factor without fields",
            )),
            _ if self.is_circular() || !self.is_ranked() => circular(),
            _ if self.is_narrowed => Verdict::undecided(
                "it does not follow from the equations as they were solved; some could be solved only where the faces meet, without their \
                 derivatives along these, so that no counterexample was confirmed",
            ),
            _ => match self.contradicted(self.space.explicit(own)) {
                Verdict::Refuted(found) => self.confirmed(e, found),
                other => other,
            },
        }
    }

    /// A counterexample holds where no consequence of the equations speaks against it: they are differentiated, and what all derivatives
    /// together say of jets of lower order is put in.
    fn confirmed(&self, e: Expr, found: Counterexample) -> Verdict {
        if !self.is_cut {
            return Verdict::Refuted(found);
        }
        let Some(full) = self.prolonged() else {
            return Verdict::undecided(format!(
                "it does not follow from the equations as they are solved; conditions of integrability up to order {} were too much work",
                self.highest()
            ));
        };
        let own = full.here(e);
        if full.pivots != self.pivots {
            return Verdict::undecided(format!(
                "conditions of integrability up to order {} can be solved only where a coefficient that depends on fields does not vanish",
                self.highest()
            ));
        }
        match self.space.vanishing(&[own], false) {
            Verdict::Proved(_) => {
                return Verdict::Proved(Proof::exact(
                    "",
                    "it follows by differentiation and elimination",
                ))
            }
            _ if full.is_multiple(own) => {
                return Verdict::Proved(Proof::exact(
                    "",
                    "it is a multiple of a condition of integrability",
                ))
            }
            _ if full.is_circular() || !full.is_ranked() => return circular(),
            _ => {}
        }
        let is_settled = self
            .space
            .jets_in(&[own])
            .iter()
            .all(|jet| full.rule(jet, full.everywhere()).is_none());
        if full.is_cut || full.left.len() > self.left.len() || !is_settled {
            return Verdict::undecided(format!(
                "it does not follow from the equations and their conditions of integrability up to order {}; conditions beyond that, or such \
                 that cannot be solved for a derivative, were not used",
                self.highest()
            ));
        }
        full.contradicted(self.space.explicit(own))
    }

    /// A counterexample, where the boundary is plane if there is one: there the derivatives of the curvature are consistent.
    fn contradicted(&self, e: Expr) -> Verdict {
        let space = self.space;
        let plane = space.on_plane(e);
        let known = self.assumed_here();
        if plane == e {
            return space.vanishing_under(&[e], true, &known);
        }
        match space.vanishing_under(&[plane], true, &known) {
            Verdict::Refuted(found) => Verdict::Refuted(found),
            _ if space.has_curvature_derivatives(e) => Verdict::undecided(
                "it vanishes where the boundary is plane, and contains derivatives of the curvature elsewhere",
            ),
            _ => space.vanishing(&[e], true),
        }
    }

    /// What is assumed, where the equations hold: a counterexample satisfies both.
    pub(super) fn assumed_here(&self) -> Assumptions {
        let space = self.space;
        let everywhere = self.everywhere();
        let here =
            |e: Expr| self.placed(space.on_plane(space.explicit(self.normal(e))), everywhere);
        let mut found = Assumptions::new();
        let is_across = |e: Expr| {
            let mut constant = self.constant_on(everywhere);
            constant.any(|(axis, _)| space.coordinates.get(axis).is_some_and(|c| c.expr == e))
        };
        for own in space.assumptions().list() {
            // On a face the variable across it is at the end of its interval, and not inside.
            if is_across(own.left) || is_across(own.right) {
                continue;
            }
            found.assume(here(own.left), own.relation, here(own.right));
        }
        for &e in &self.nonnegative {
            found.assume(here(e), Relation::GreaterOrEqual, space.graph.zero());
        }
        found
    }

    /// Whether an expression e is an equation f that is left times a factor without fields: then `e f₀ = e₀ f` for all jets, with the
    /// values at some at which f₀ does not vanish.
    fn is_multiple(&self, e: Expr) -> bool {
        let g = &self.space.graph;
        if let Node::Product { factors, .. } = g.node(e) {
            let jets = |factor: &&Expr| !self.space.jets_in(&[**factor]).is_empty();
            let several: Vec<Expr> = factors.iter().filter(jets).copied().collect();
            return several.len() > 1
                && several
                    .into_iter()
                    .any(|factor| self.is_multiple(self.base(factor)))
                || self.is_constant_multiple(e);
        }
        self.is_constant_multiple(e)
    }

    fn is_constant_multiple(&self, e: Expr) -> bool {
        let g = &self.space.graph;
        let left = self.left.iter();
        let mut all = left.flat_map(|group| group.equations.iter().copied());
        all.any(|other| {
            (1..=MOST_POINTS).any(|seed| {
                let jets = self
                    .space
                    .jets_in(&[e, other])
                    .into_iter()
                    .collect::<Vec<_>>();
                let [one, two] = [e, other].map(|e| self.at_point(e, &jets, seed));
                let is_somewhere = !g.is_zero(two)
                    && matches!(self.space.vanishing(&[two], true), Verdict::Refuted(_));
                is_somewhere
                    && self
                        .space
                        .vanishes(g.sub(g.mul(&[e, two]), g.mul(&[one, other])))
            })
        })
    }

    /// An expression with rational values for jets: all of one sign, of the other, or by turns.
    fn at_point(&self, e: Expr, jets: &[Jet], seed: usize) -> Expr {
        let space = self.space;
        space.replace(e, &|symbol| {
            let jet = space.as_jet(symbol)?;
            let at = jets.iter().position(|own| *own == jet)?;
            let is_positive = match seed {
                1 => true,
                2 => false,
                _ => (at + seed).is_multiple_of(2),
            };
            let size = (2 * at + 2 + seed) as i64;
            let value = rational::ratio(if is_positive { size } else { -size }, 2)?;
            Some(space.graph.number(value))
        })
    }
}

/// What is said where rules lead back to each other.
fn circular() -> Verdict {
    Verdict::undecided(
        "it does not follow from the equations as they were solved; their conditions of integrability give derivatives by each other in a \
         circle, so that no counterexample was confirmed",
    )
}

/// By what the second derivative has to be differentiated so that it contains the first.
fn missing(wanted: &[usize], own: &[usize]) -> Vec<usize> {
    let mut left = own.to_vec();
    let mut missing = Vec::new();
    for axis in wanted {
        match left.iter().position(|known| known == axis) {
            Some(at) => {
                left.remove(at);
            }
            None => missing.push(*axis),
        }
    }
    missing
}
