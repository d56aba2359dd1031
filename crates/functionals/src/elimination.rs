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
//! Which jet of an equation is solved for is chosen by what it costs, not by a ranking of all jets (C. Riquier 1910), so that rules may
//! lead back to each other. Such a circle is cut where it closes: what is proved remains so, since a rule that is not used takes nothing
//! away, but what is left over is no normal form, and nothing is refuted with it.
//!
//! A field that is known on a curved piece of the boundary is what is known plus the distance from the piece times a new free field
//! (see [`boundary`](crate::boundary)): so the derivatives along the piece are known, and the one across it is not.

use crate::boundary::CURVATURE;
use crate::functional::Side;
use crate::space::{Component, Jet, Space};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{generic_rank, known_sign, Options, Pivots, RankTest};
use chetaev_symbolic::{rational, Expr, Node, Verdict};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Equations that belong together: the components of one.
#[derive(Clone, Debug)]
pub struct Group {
    /// What they are called.
    pub label: String,
    /// Expressions that vanish.
    pub equations: Vec<Expr>,
}

/// Equations solved as far as possible.
#[derive(Clone, Debug)]
pub struct Solved<'s> {
    space: &'s Space,
    rules: Vec<Rule>,
    place: Option<Side>,
    /// Variables that are constant where the equations hold, with their values.
    constant: Vec<(usize, Expr)>,
    is_corner: bool,
    preferred: BTreeSet<String>,
    /// Expressions that are not negative, as is known besides: a counterexample keeps to them.
    nonnegative: Vec<Expr>,
    /// Pairs of rules that were compared.
    crossed: BTreeSet<(usize, usize)>,
    /// Up to which order conditions of integrability that raise the order are taken; none of them where it is `None`.
    order: Option<usize>,
    /// Whether there are conditions beyond that order.
    is_cut: bool,
    prolonged: RefCell<Option<Rc<Solved<'s>>>>,
    known: RefCell<BTreeMap<Jet, Expr>>,
    /// The jets whose values are being computed, each for that of the one before.
    open: RefCell<Vec<Jet>>,
    /// Whether rules led back to each other.
    is_circular: Cell<bool>,
    judged: RefCell<BTreeMap<Expr, bool>>,
    /// Equations that are left, with their labels.
    pub left: Vec<Group>,
    /// Matrices that were inverted and depend on the fields: the tensors solved for.
    pub pivots: Vec<String>,
    /// Functions undone by their conjugates.
    pub inverted: BTreeSet<String>,
    /// Expressions in parameters and data that were divided by.
    pub nonzero: BTreeSet<String>,
}

/// A jet with its value.
#[derive(Clone, Debug)]
struct Rule {
    jet: Jet,
    value: Expr,
    reach: Reach,
}

/// Where a rule holds, and so by what it may be differentiated.
#[derive(Clone, Debug, PartialEq)]
enum Reach {
    /// In the interior, or wherever it is continued to: data and fields of a piece are continued off it as the rule says.
    Everywhere,
    /// On a face: by the other variables.
    Face(usize),
    /// On a curved piece: the value is continued by the distance times this component.
    Piece(usize),
    /// At a corner only.
    Corner,
}

impl Reach {
    /// Whether a rule may be differentiated so.
    fn allows(&self, by: &[usize]) -> bool {
        match self {
            Reach::Everywhere | Reach::Piece(_) => true,
            Reach::Face(axis) => !by.contains(axis),
            Reach::Corner => by.is_empty(),
        }
    }
}

/// A way to solve a group.
struct Choice {
    cost: Cost,
    group: usize,
    jets: Vec<Jet>,
    rows: Vec<usize>,
    matrix: Vec<Vec<Expr>>,
    rest: Vec<Expr>,
    is_constant: bool,
}

/// A group of equations in which the gradient of a function was undone by its conjugate.
struct Undone {
    group: usize,
    equations: Vec<Expr>,
    function: String,
    /// What stood before the gradient.
    matrix: Vec<Vec<Expr>>,
}

/// How dear a way is: its class, whether another tensor is preferred, whether components stay open, how hard the solution is,
/// and the place of the group.
type Cost = (u8, bool, bool, u8, usize);

/// Classes: data and fields without derivatives go first, those with constant coefficients before others, then conjugates.
const CONSTANT_DATA: u8 = 0;
const CONSTANT_FIELD: u8 = 1;
const PLAIN: u8 = 2;
const CONJUGATE: u8 = 3;
const CONSTANT_DERIVATIVE: u8 = 4;
const HOMOGENEOUS: u8 = 5;
const DERIVATIVE: u8 = 6;
const PLAIN_DATA: u8 = 7;

/// At so many points a factor between two equations is looked for.
const MOST_POINTS: usize = 4;

/// So many products one after the other are taken apart.
const MOST_PRODUCTS: usize = 4;

/// Determinants of matrices with more rows are not written out.
const LARGEST_DETERMINANT: usize = 3;

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
            place: None,
            constant: Vec::new(),
            is_corner: false,
            preferred: BTreeSet::new(),
            nonnegative: Vec::new(),
            crossed: BTreeSet::new(),
            order: None,
            is_cut: false,
            prolonged: RefCell::default(),
            known: RefCell::default(),
            open: RefCell::default(),
            is_circular: Cell::new(false),
            judged: RefCell::default(),
            left: Vec::new(),
            pivots: Vec::new(),
            inverted: BTreeSet::new(),
            nonzero: BTreeSet::new(),
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
        own.place = Some(side.clone());
        if let Side::Flat { axis, at, .. } = side {
            own.constant.push((*axis, *at));
        }
        own.with(groups)
    }

    /// The same with more equations, which hold at a corner and may not be differentiated.
    #[must_use]
    pub fn with_at_corner(&self, groups: &[Group]) -> Solved<'s> {
        let mut own = self.clone();
        own.is_corner = true;
        own.with(groups)
    }

    /// Where a new rule for a jet holds. Data and fields of the boundary live on a piece only, so that they may be continued off it as
    /// the rule says; of a field the derivative across the piece is not known.
    fn reach(&self, jet: &Jet) -> Reach {
        let component = self.space.component_at(jet.component);
        match &self.place {
            _ if self.is_corner => Reach::Corner,
            None => Reach::Everywhere,
            Some(_) if component.is_of_boundary => Reach::Everywhere,
            Some(Side::Flat { axis, .. }) => Reach::Face(*axis),
            Some(Side::Curved) => Reach::Piece(self.across(jet, &component)),
        }
    }

    /// The component that the distance from the piece is multiplied with.
    fn across(&self, jet: &Jet, of: &Component) -> usize {
        let g = &self.space.graph;
        let name = g.text(self.space.jet(jet.component, &jet.by));
        let by: String = name.chars().skip_while(|c| *c != ',').collect();
        self.space.component(Component {
            name: format!("∂{name}/∂n"),
            tensor: format!("∂{}{by}/∂n", of.tensor),
            ..of.clone()
        })
    }

    /// The same with more equations.
    #[must_use]
    pub fn with(&self, groups: &[Group]) -> Solved<'s> {
        let mut own = self.clone();
        own.left.extend(groups.iter().cloned());
        own.prolonged = RefCell::default();
        own.solve();
        own
    }

    /// The order up to which conditions of integrability are looked at before something is refuted: two derivatives of the highest order
    /// meet at the latest at twice that order, and what comes of it may be differentiated once more.
    pub fn highest(&self) -> usize {
        let orders = self.rules.iter().map(|rule| rule.jet.by.len());
        2 * orders.max().unwrap_or(0) + 1
    }

    /// The same with the conditions of integrability that raise the order.
    fn prolonged(&self) -> Rc<Solved<'s>> {
        let known = self.prolonged.borrow().clone();
        if let Some(known) = known {
            return known;
        }
        let mut own = self.clone();
        own.order = Some(self.highest());
        own.is_cut = false;
        own.crossed.clear();
        own.solve();
        let made = Rc::new(own);
        *self.prolonged.borrow_mut() = Some(Rc::clone(&made));
        made
    }

    /// An expression where the equations hold: rules and their derivatives put in.
    pub fn normal(&self, e: Expr) -> Expr {
        let mut e = e;
        // A function undone by its conjugate may bring back a jet that has a rule.
        for _ in 0..MOST_ROUNDS {
            let ruled = |jet: &Jet| self.rule(jet).is_some();
            if !self.space.jets_in(&[e]).iter().any(ruled) {
                return e;
            }
            e = self.space.replace(e, &|symbol| {
                let jet = self.space.as_jet(symbol)?;
                self.rule(&jet)?;
                Some(self.value(&jet))
            });
            if self.is_circular() {
                return e;
            }
        }
        e
    }

    fn rule(&self, jet: &Jet) -> Option<(&Rule, Vec<usize>)> {
        self.rules.iter().find_map(|rule| {
            if rule.jet.component != jet.component {
                return None;
            }
            let rest = rest(&jet.by, &rule.jet.by)?;
            rule.reach.allows(&rest).then_some((rule, rest))
        })
    }

    fn value(&self, jet: &Jet) -> Expr {
        if let Some(&known) = self.known.borrow().get(jet) {
            return known;
        }
        let own = self.space.jet(jet.component, &jet.by);
        let value = match self.rule(jet) {
            Some(_) if self.closes_circle(jet) => {
                self.is_circular.set(true);
                return own;
            }
            Some((rule, rest)) => {
                self.open.borrow_mut().push(jet.clone());
                let value = self.normal(self.derived(rule, &rest));
                self.open.borrow_mut().pop();
                value
            }
            None => own,
        };
        self.known.borrow_mut().insert(jet.clone(), value);
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
        match rule.reach {
            Reach::Piece(across) if !by.is_empty() => {
                let moved = space.of_distance_times(space.jet(across, &[]), by);
                space.graph.add(&[own, moved])
            }
            _ => own,
        }
    }

    /// The next pair of rules that give the same derivative of a component: what each gives has to agree.
    fn crossing(&mut self) -> Option<Group> {
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
                if !a.reach.allows(&by_a) || !b.reach.allows(&by_b) {
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
                return Some(Group {
                    label: format!("integrability of {name}"),
                    equations: vec![difference],
                });
            }
        }
        None
    }

    /// Whether an expression is proved to vanish identically.
    fn vanishes(&self, e: Expr) -> bool {
        if self.space.graph.is_zero(e) {
            return true;
        }
        if let Some(&known) = self.judged.borrow().get(&e) {
            return known;
        }
        let found = self.space.vanish(&[e]);
        self.judged.borrow_mut().insert(e, found);
        found
    }

    /// Whether expressions vanish where the equations hold.
    pub fn follows(&self, es: &[Expr]) -> bool {
        es.iter().all(|&e| self.vanishes(self.normal(e)))
    }

    /// The same as a verdict, with a counterexample where one is found.
    pub fn verdict(&self, e: Expr) -> Verdict {
        let own = self.normal(e);
        match self.space.vanishing(&[own], false) {
            Verdict::Proved(proof) => Verdict::Proved(proof),
            _ if self.is_multiple(own) => Verdict::Proved(Proof::exact(
                "",
                "it is a multiple of an equation that holds, by a factor without fields",
            )),
            _ if self.is_circular() => circular(),
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
        let full = self.prolonged();
        let own = full.normal(e);
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
            _ if full.is_circular() => return circular(),
            _ => {}
        }
        let is_settled = self
            .space
            .jets_in(&[own])
            .iter()
            .all(|jet| full.rule(jet).is_none());
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
        let known = |y: &Expr| space.on_plane(space.explicit(self.normal(*y)));
        let known: Vec<Expr> = self.nonnegative.iter().map(known).collect();
        if plane == e {
            return space.vanishing_where(&[e], true, &known);
        }
        match space.vanishing_where(&[plane], true, &known) {
            Verdict::Refuted(found) => Verdict::Refuted(found),
            _ if space.has_curvature_derivatives(e) => Verdict::undecided(
                "it vanishes where the boundary is plane, and contains derivatives of the curvature elsewhere",
            ),
            _ => space.vanishing(&[e], true),
        }
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
                is_somewhere && self.vanishes(g.sub(g.mul(&[e, two]), g.mul(&[one, other])))
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

    /// What cannot be where all equations hold: an equation that is left although it never holds, with its label.
    pub fn contradiction(&self) -> Option<(String, Expr)> {
        let own = self.impossible();
        if own.is_some() || !self.is_cut || self.is_circular() {
            return own;
        }
        self.prolonged().impossible()
    }

    fn impossible(&self) -> Option<(String, Expr)> {
        self.left.iter().find_map(|group| {
            let mut own = group.equations.iter().copied();
            let found = own.find(|&e| self.never_holds(e))?;
            Some((group.label.clone(), found))
        })
    }

    /// Whether an expression is known to vanish nowhere, or not to vanish identically although nothing but the place occurs in it.
    fn never_holds(&self, e: Expr) -> bool {
        let space = self.space;
        let g = &space.graph;
        let e = self.placed(space.explicit(e));
        if known_sign(g, e, &Assumptions::new()).is_nonzero() {
            return true;
        }
        let is_place = |symbol| {
            space
                .coordinates
                .iter()
                .any(|c| g.as_symbol(c.expr) == Some(symbol))
        };
        let is_curved = self.place == Some(Side::Curved);
        let is_of_place = g.symbols_in(&[e]).into_iter().all(is_place);
        !is_curved && is_of_place && matches!(space.vanishing(&[e], true), Verdict::Refuted(_))
    }

    /// On a face the variable across it has its value.
    fn placed(&self, e: Expr) -> Expr {
        let g = &self.space.graph;
        self.space.replace(e, &|symbol| {
            let is_own = |(axis, _): &&(usize, Expr)| {
                let own = self.space.coordinates.get(*axis);
                own.is_some_and(|c| g.as_symbol(c.expr) == Some(symbol))
            };
            self.constant.iter().find(is_own).map(|(_, at)| *at)
        })
    }

    /// What the equations ask of what is given, so that there are fields for some of it only: relations between data and parameters,
    /// which vanish.
    pub fn restrictions(&self) -> Vec<Expr> {
        let space = self.space;
        let is_given = |component: usize| {
            let own = space.component_at(component);
            !own.is_varied && !own.is_of_boundary
        };
        let of_rules = self
            .rules
            .iter()
            .filter(|rule| is_given(rule.jet.component));
        let of_rules = of_rules.map(|rule| {
            let own = space.jet(rule.jet.component, &rule.jet.by);
            space.graph.sub(own, self.normal(rule.value))
        });
        let left = self
            .left
            .iter()
            .flat_map(|group| group.equations.iter().copied());
        let is_of_given = |e: &Expr| {
            let jets = space.jets_in(&[*e]);
            jets.iter().all(|jet| is_given(jet.component)) && !space.symbols_in(&[*e]).is_empty()
        };
        of_rules.chain(left).filter(is_of_given).collect()
    }

    /// The cases of which one holds wherever the equations do: one for each factor of an equation that is left and is a product.
    pub fn alternatives(&self) -> Vec<Solved<'s>> {
        let mut found = Vec::new();
        let mut open = vec![(self.clone(), 0)];
        while let Some((own, depth)) = open.pop() {
            let product = (depth < MOST_PRODUCTS).then(|| own.product()).flatten();
            let Some((group, at, factors)) = product else {
                found.push(own);
                continue;
            };
            for factor in factors {
                let mut case = own.clone();
                case.left[group].equations[at] = factor;
                case.prolonged = RefCell::default();
                case.known.borrow_mut().clear();
                case.solve();
                open.push((case, depth + 1));
            }
        }
        found
    }

    /// The first equation that is left and is a product of several factors with jets.
    fn product(&self) -> Option<(usize, usize, Vec<Expr>)> {
        let g = &self.space.graph;
        let groups = self.left.iter().enumerate();
        let mut all = groups.flat_map(|(k, group)| {
            let own = group.equations.iter().enumerate();
            own.map(move |(at, &e)| (k, at, e))
        });
        all.find_map(|(group, at, e)| {
            let jets = self.space.jets_in(&[e]).into_iter();
            let symbols: Vec<_> = jets
                .filter_map(|jet| g.as_symbol(self.space.jet(jet.component, &jet.by)))
                .collect();
            let found: Vec<Expr> = match g.node(e) {
                Node::Product { factors, .. } => {
                    let own = factors.iter().copied();
                    own.filter(|&factor| g.contains_any(factor, &symbols))
                        .collect()
                }
                _ => {
                    let own = chetaev_symbolic::factors::factors(g, e, &symbols)?;
                    own.into_iter().map(|(factor, _)| factor).collect()
                }
            };
            (found.len() > 1).then_some((group, at, found))
        })
    }

    fn solve(&mut self) {
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
                    .flat_map(|&e| self.parts(self.normal(e)));
                group.equations = parts.map(|e| self.stripped(e)).collect();
                group.equations.retain(|&e| !self.vanishes(e));
            }
            groups.retain(|group| !group.equations.is_empty());
            self.left = groups;
            let best = self.best();
            let conjugate = match &best {
                Some(choice) if choice.cost.0 < CONJUGATE => None,
                _ => self.conjugated(&undone),
            };
            match (conjugate, best) {
                (Some(own), _) => {
                    let label = self.left[own.group].label.clone();
                    undone.insert((label, own.function.clone()));
                    self.note_nonzero(&own.matrix, None);
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

    /// What a positive power is of: both vanish together.
    fn base(&self, e: Expr) -> Expr {
        let g = &self.space.graph;
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

    /// The terms of a sum of which none is negative, or none positive: each vanishes where the sum does.
    fn parts(&self, e: Expr) -> Vec<Expr> {
        let g = &self.space.graph;
        let Node::Sum { constant, terms } = g.node(e) else {
            return vec![e];
        };
        let assumptions = Assumptions::new();
        let parts = terms
            .iter()
            .map(|(term, coefficient)| g.mul(&[g.number(coefficient.clone()), *term]));
        let parts: Vec<Expr> = parts.collect();
        let signs: Vec<_> = parts
            .iter()
            .map(|&part| known_sign(g, part, &assumptions))
            .collect();
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
    fn stripped(&self, e: Expr) -> Expr {
        let g = &self.space.graph;
        let Node::Product { factors, .. } = g.node(e) else {
            return self.base(e);
        };
        let assumptions = Assumptions::new();
        let vanishes = |&&factor: &&Expr| !known_sign(g, factor, &assumptions).is_nonzero();
        let kept: Vec<Expr> = factors
            .iter()
            .filter(vanishes)
            .map(|&e| self.base(e))
            .collect();
        g.mul(&kept)
    }

    /// Leaves out jets that occur in what is left although nothing depends on them; whether there were any.
    fn cleaned(&mut self) -> bool {
        let mut has_changed = false;
        for at in 0..self.left.len() {
            for k in 0..self.left[at].equations.len() {
                let mut e = self.left[at].equations[k];
                for jet in self.space.jets_in(&[e]) {
                    if !self.vanishes(self.space.partial(e, &jet)) {
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
                    None => (u8::MAX, true, true, u8::MAX, 0),
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
            let tensor = self.space.component_at(jet.component).tensor;
            if tensor == CURVATURE {
                continue;
            }
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
        if (hoped, is_other, false, 0, group) >= least {
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
            || (class, is_other, is_open, 0, group) >= least
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
        let matrix: Vec<Vec<Expr>> = rows
            .iter()
            .map(|&r| columns.iter().map(|&c| matrix[r][c]).collect())
            .collect();
        let are_numbers = matrix.iter().flatten().all(|&e| g.as_number(e).is_some());
        let effort = match are_numbers {
            true => 0,
            false if self.recognized(&matrix, &rest).is_some() => 1,
            false => 2,
        };
        let cost = (class, is_other, is_open, effort, group);
        if cost >= least {
            return None;
        }
        Some(Choice {
            cost,
            group,
            jets: chosen,
            rows,
            matrix,
            rest,
            is_constant,
        })
    }

    /// Whether coefficients are free of the normal too, whose components may vanish.
    fn is_free(&self, row: &[Expr]) -> bool {
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
        rests.all(|e| self.vanishes(e))
    }

    fn pivots_of(&self, matrix: &[Vec<Expr>]) -> Option<Pivots> {
        let assumptions = Assumptions::new();
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
            self.vanishes(g.add(&terms))
        })
    }

    fn adopt(&mut self, choice: Choice) -> bool {
        let Some(values) = self.solution(&choice.matrix, &choice.rest) else {
            return false;
        };
        if let (true, Some(jet)) = (choice.is_constant, choice.jets.first()) {
            self.note_nonzero(&choice.matrix, Some(jet.component));
        }
        if !choice.is_constant {
            if let Some(jet) = choice.jets.first() {
                let tensor = self.space.component_at(jet.component).tensor;
                if !self.pivots.contains(&tensor) {
                    self.pivots.push(tensor);
                }
            }
        }
        for (jet, value) in choice.jets.into_iter().zip(values) {
            let reach = self.reach(&jet);
            self.rules.push(Rule { jet, value, reach });
        }
        self.known.borrow_mut().clear();
        let group = &mut self.left[choice.group];
        let mut row = 0;
        group.equations.retain(|_| {
            row += 1;
            !choice.rows.contains(&(row - 1))
        });
        true
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
                    .is_some_and(|p| p.rows.len() == gradient.len());
                if !full {
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

    /// How many components of a tensor may be changed by any functions, all else being kept, so that expressions keep their values
    /// where the equations hold: the components less the rank of the slopes by all their jets. `None` where the rank is not known.
    pub fn free_components(&self, components: &[usize], es: &[Expr]) -> Option<usize> {
        let space = self.space;
        let jets = space.jets_in(es);
        let own: BTreeSet<Vec<usize>> = jets
            .into_iter()
            .filter(|jet| components.contains(&jet.component))
            .map(|jet| jet.by)
            .collect();
        let mut matrix = Vec::new();
        for &e in es {
            for by in &own {
                let slope = |&component: &usize| {
                    let by = by.clone();
                    self.normal(space.partial(e, &Jet { component, by }))
                };
                matrix.push(components.iter().map(slope).collect::<Vec<Expr>>());
            }
        }
        if matrix.is_empty() {
            return Some(components.len());
        }
        Some(components.len() - self.pivots_of(&matrix)?.columns.len())
    }

    /// What must not vanish so that a matrix without fields is regular: the factors of its determinant in which something occurs that
    /// has no value. A large matrix is named by what was solved for.
    fn note_nonzero(&mut self, matrix: &[Vec<Expr>], component: Option<usize>) {
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
            let tensor = component.map(|c| self.space.component_at(c).tensor);
            if let Some(tensor) = tensor.filter(|tensor| !self.pivots.contains(tensor)) {
                self.pivots.push(tensor);
            }
            return;
        };
        let divisors: BTreeSet<Expr> = divisors.into_iter().collect();
        let assumptions = Assumptions::new();
        for divisor in divisors {
            let factors = chetaev_symbolic::factors::factors(g, divisor, &symbols);
            let factors = factors.unwrap_or_else(|| vec![(divisor, 1)]);
            for (factor, _) in factors {
                let is_open = g.as_number(factor).is_none()
                    && !known_sign(g, factor, &assumptions).is_nonzero();
                if is_open {
                    self.nonzero.insert(g.text(factor));
                }
            }
        }
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

/// By what one derivative is differentiated to give another.
fn rest(more: &[usize], less: &[usize]) -> Option<Vec<usize>> {
    let mut rest = more.to_vec();
    for axis in less {
        let at = rest.iter().position(|own| own == axis)?;
        rest.remove(at);
    }
    Some(rest)
}
