//! Where expressions are smooth: at what places of a box, and what has to be known for it.
//!
//! Euler equations and natural conditions are derived by parts, which needs densities and fields that are smooth on the body: where one
//! jumps or has a kink, a condition holds besides that no derivation by parts shows (Weierstrass and Erdmann, 1877).

use crate::elimination::factors_of;
use crate::functional::{Functional, Interval};
use crate::notation::denominators;
use crate::polynomial::Polynomial;
use crate::signs::{enclosure, on_interval, Sign};
use crate::space::Space;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::zero::assumptions::{
    is_contradicted, is_implied, Assumptions, Relation, SignSet,
};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Function, Graph, Node, Rational};
use std::cmp::Ordering;

/// An expression that has to compare with zero so that another one is smooth.
pub(crate) type Guard = (Expr, Relation);

/// What has to be so that a node is defined and smooth in what stands in it.
pub(crate) fn guard_of(g: &Graph, e: Expr) -> Option<Guard> {
    match g.node(e) {
        Node::Power { base, exponent } => match g.as_number(*exponent).and_then(rational::to_i64) {
            None => Some((*base, Relation::Greater)),
            Some(n) => (n < 0).then_some((*base, Relation::NotEqual)),
        },
        Node::Apply {
            function,
            arguments,
        } => of_function(g, *function, arguments),
        _ => None,
    }
}

fn of_function(g: &Graph, function: Function, arguments: &[Expr]) -> Option<Guard> {
    let inner = *arguments.first()?;
    let below_one = || g.sub(g.one(), g.powi(inner, 2));
    Some(match function {
        Function::Abs | Function::Sign => (inner, Relation::NotEqual),
        Function::Log => (inner, Relation::Greater),
        Function::Asin | Function::Acos | Function::Atanh => (below_one(), Relation::Greater),
        Function::Acosh => (g.sub(inner, g.one()), Relation::Greater),
        Function::Tan | Function::Sec => (g.apply(Function::Cos, &[inner]), Relation::NotEqual),
        Function::Cot | Function::Csc => (g.apply(Function::Sin, &[inner]), Relation::NotEqual),
        // The angle jumps across the negative half of the axis.
        Function::Atan2 => {
            let along = *arguments.get(1)?;
            let radius = g.sqrt(g.add(&[g.powi(inner, 2), g.powi(along, 2)]));
            (g.add(&[radius, along]), Relation::Greater)
        }
        _ => return None,
    })
}

/// All guards of an expression.
pub(crate) fn guards(g: &Graph, e: Expr) -> Vec<Guard> {
    let all = g.reachable(&[e]).into_iter();
    let mut found: Vec<Guard> = Vec::new();
    for (inner, relation) in all.filter_map(|e| guard_of(g, e)) {
        // A product is not zero where none of its factors is.
        let factors = match g.node(inner) {
            Node::Product { factors, .. } if relation == Relation::NotEqual => factors.to_vec(),
            _ => vec![inner],
        };
        for factor in factors {
            if !found.contains(&(factor, relation)) {
                found.push((factor, relation));
            }
        }
    }
    found
}

/// A box, with its boundary or without.
pub(crate) struct Region<'s> {
    space: &'s Space,
    intervals: Vec<Interval>,
    is_closed: bool,
    assumed: Assumptions,
}

impl<'s> Region<'s> {
    /// The box of these intervals.
    pub(crate) fn new(space: &'s Space, intervals: Vec<Interval>, is_closed: bool) -> Region<'s> {
        let mut assumed = Assumptions::new();
        for own in space.assumptions().list() {
            let relation = if is_closed && space.is_of_place(&[own.left, own.right]) {
                with_equality(own.relation)
            } else {
                own.relation
            };
            assumed.assume(own.left, relation, own.right);
        }
        let relation = if is_closed {
            Relation::LessOrEqual
        } else {
            Relation::Less
        };
        for own in &intervals {
            if let Some(place) = space.coordinates.get(own.axis).map(|c| c.expr) {
                assumed.assume(own.lower, Relation::Less, own.upper);
                assumed.assume(own.lower, relation, place);
                assumed.assume(place, relation, own.upper);
                // What lies above something positive is positive.
                let zero = space.graph.zero();
                if space.sign(own.lower).is_positive() {
                    assumed.assume(place, Relation::Greater, zero);
                } else if space.sign(own.upper) == SignSet::NEGATIVE {
                    assumed.assume(place, Relation::Less, zero);
                }
            }
        }
        Region {
            space,
            intervals,
            is_closed,
            assumed,
        }
    }

    /// Whether a guard holds everywhere in the region; nothing where that is not known.
    pub(crate) fn holds(&self, (e, relation): Guard) -> Option<bool> {
        let sign = known_sign(&self.space.graph, e, &self.assumed);
        if is_implied(relation, sign) {
            return Some(true);
        }
        if is_contradicted(relation, sign) || self.is_violated(e, relation) {
            return Some(false);
        }
        self.decided_by_signs(e, relation)
            .or_else(|| self.holds_at_corners(e, relation).then_some(true))
            .or_else(|| self.holds_by_terms(e, relation).then_some(true))
    }

    /// Whether a polynomial on a box with numbers for its ends is kept away from zero by the bounds of its terms.
    fn holds_by_terms(&self, e: Expr, relation: Relation) -> bool {
        let number = |e: Expr| self.space.graph.as_number(e).cloned();
        let own = self.intervals.iter();
        let own = own.map(|own| Some((own.axis, number(own.lower)?, number(own.upper)?)));
        let Some(intervals) = own.collect::<Option<Vec<_>>>() else {
            return false;
        };
        let polynomial = Polynomial::of(self.space, e);
        let bounds = polynomial.and_then(|own| own.bounds(&intervals));
        bounds.is_some_and(|(lower, upper)| {
            let is_below = relation == Relation::NotEqual && upper < Rational::ZERO;
            lower > Rational::ZERO || is_below
        })
    }

    /// What the signs on an interval say; zeros at its ends belong to a closed region alone.
    fn decided_by_signs(&self, e: Expr, relation: Relation) -> Option<bool> {
        let (own, opposite) = self.signs_on_interval(e);
        let is_positive = |sign: &Sign| match sign {
            Sign::Positive => true,
            Sign::PositiveInside => !self.is_closed,
            _ => false,
        };
        let is_never_negative = own.as_ref().is_some_and(Sign::is_nonnegative);
        let is_somewhere_negative = matches!(own, Some(Sign::Negative(_)));
        let is_somewhere_positive = matches!(opposite, Some(Sign::Negative(_)));
        let is_above = own.as_ref().is_some_and(is_positive);
        let is_below = opposite.as_ref().is_some_and(is_positive);
        let is_known = is_never_negative || opposite.as_ref().is_some_and(Sign::is_nonnegative);
        match relation {
            Relation::GreaterOrEqual if is_never_negative => Some(true),
            Relation::GreaterOrEqual | Relation::Greater if is_somewhere_negative => Some(false),
            Relation::Greater | Relation::NotEqual if is_above => Some(true),
            Relation::NotEqual if is_below => Some(true),
            Relation::Greater if is_never_negative => Some(false),
            Relation::NotEqual if is_known || (is_somewhere_negative && is_somewhere_positive) => {
                Some(false)
            }
            _ => None,
        }
    }

    /// Whether a comparison with zero is known to be false somewhere in the region.
    pub(crate) fn contradicts(&self, e: Expr, relation: Relation) -> bool {
        let opposite = || self.space.graph.neg(e);
        let guard = match relation {
            Relation::Less => (opposite(), Relation::Greater),
            Relation::LessOrEqual => (opposite(), Relation::GreaterOrEqual),
            Relation::Greater | Relation::GreaterOrEqual | Relation::NotEqual => (e, relation),
        };
        self.holds(guard) == Some(false)
    }

    /// Whether a guard fails at a probe, or between two of them: the region is connected, so that what has both signs is zero between.
    fn is_violated(&self, e: Expr, relation: Relation) -> bool {
        let signs: Vec<SignSet> = self
            .probes()
            .into_iter()
            .map(|at| self.sign_at(e, &at))
            .collect();
        let has = |wanted: SignSet| signs.contains(&wanted);
        let fails = signs.iter().any(|&sign| is_contradicted(relation, sign));
        fails || (has(SignSet::POSITIVE) && has(SignSet::NEGATIVE))
    }

    fn sign_at(&self, e: Expr, at: &[(Expr, Expr)]) -> SignSet {
        let g = &self.space.graph;
        let e = g.substitute(e, at);
        match enclosure(self.space, e).and_then(|own| own.sign()) {
            Some(Ordering::Less) => SignSet::NEGATIVE,
            Some(Ordering::Greater) => SignSet::POSITIVE,
            _ => known_sign(g, e, &self.space.assumptions()),
        }
    }

    /// Places of the region where its ends are numbers.
    fn probes(&self) -> Vec<Vec<(Expr, Expr)>> {
        let g = &self.space.graph;
        let mut all: Vec<Vec<(Expr, Expr)>> = vec![Vec::new()];
        for own in &self.intervals {
            let Some(place) = self.space.coordinates.get(own.axis).map(|c| c.expr) else {
                return Vec::new();
            };
            let parts = if self.is_closed {
                [(0, 1), (1, 3), (1, 2), (4, 5), (1, 1)]
            } else {
                [(1, 100), (1, 3), (1, 2), (4, 5), (99, 100)]
            };
            let values = parts.iter().map(|&(over, under)| {
                let part = g.number(Rational::from(over) / Rational::from(under));
                let length = g.sub(own.upper, own.lower);
                let at = g.add(&[own.lower, g.mul(&[length, part])]);
                simplify(g, at, &Options::default())
            });
            let values: Vec<Expr> = values.collect();
            all = all
                .into_iter()
                .flat_map(|at| {
                    values
                        .iter()
                        .map(move |&v| [at.clone(), vec![(place, v)]].concat())
                })
                .collect();
        }
        all
    }

    /// The signs of an expression and of its negative in one dimension with numbers for its ends, by enclosures of parts of the closed interval.
    fn signs_on_interval(&self, e: Expr) -> (Option<Sign>, Option<Sign>) {
        let g = &self.space.graph;
        let [own] = &self.intervals[..] else {
            return (None, None);
        };
        let (Some(lower), Some(upper)) = (g.as_number(own.lower), g.as_number(own.upper)) else {
            return (None, None);
        };
        let place = g.as_symbol(self.space.coordinates[own.axis].expr);
        let symbols = self.space.symbols_in(&[e]);
        if own.axis != 0 || symbols.iter().any(|&symbol| Some(symbol) != place) {
            return (None, None);
        }
        let sign = |e: Expr| Some(on_interval(self.space, e, (lower, upper)));
        (sign(e), sign(g.neg(e)))
    }

    /// A function that is linear in each variable is largest and smallest at corners of a box: of one sign at all, it has that everywhere.
    fn holds_at_corners(&self, e: Expr, relation: Relation) -> bool {
        let g = &self.space.graph;
        let mut corners = vec![e];
        for own in &self.intervals {
            let place = self.space.coordinates[own.axis].expr;
            let Some(symbol) = g.as_symbol(place) else {
                return false;
            };
            let slope = |e: Expr| self.space.derive(e, &|s| (s == symbol).then_some(g.one()));
            if !self.space.vanish(&[slope(slope(e))]) {
                return false;
            }
            corners = corners
                .into_iter()
                .flat_map(|e| [own.lower, own.upper].map(|at| g.substitute(e, &[(place, at)])))
                .collect();
        }
        let signs = corners
            .into_iter()
            .map(|e| self.sign_at(simplify(g, e, &Options::default()), &[]));
        let signs: Vec<SignSet> = signs.collect();
        let all = |wanted: SignSet| signs.iter().all(|&own| own == wanted);
        all(SignSet::POSITIVE) || (relation == Relation::NotEqual && all(SignSet::NEGATIVE))
    }
}

/// What holds on the boundary of where a comparison holds, too.
pub(crate) fn with_equality(relation: Relation) -> Relation {
    match relation {
        Relation::Less => Relation::LessOrEqual,
        Relation::Greater => Relation::GreaterOrEqual,
        other => other,
    }
}

/// How far the coefficients of the densities, which depend on the place alone, are smooth inside the body.
#[derive(Debug)]
pub(crate) enum Coefficients {
    /// Everywhere, as far as these guards hold.
    Smooth(Vec<String>),
    /// There are places inside where they are not.
    Broken(String),
    /// Whether there are was not decided: what would have to hold at all places of a box.
    Undecided(String),
}

impl Coefficients {
    /// Those of a functional on its box, or on any body.
    pub(crate) fn of(functional: &Functional) -> Coefficients {
        let space = &*functional.space;
        let g = &space.graph;
        let region = Region::new(space, functional.intervals.clone(), false);
        let mut open = Vec::new();
        let mut undecided = None;
        let on_pieces = functional.pieces.iter().map(|piece| piece.density);
        let densities = std::iter::once(functional.density).chain(on_pieces);
        let all = densities.flat_map(|e| guards(g, space.explicit(e)));
        let of_place = all.filter(|guard| space.is_of_place(&[guard.0]));
        let written = denominators(functional).into_iter();
        let written = written.flat_map(|e| factors_of(space, space.explicit(e)));
        for guard in of_place.chain(written.map(|e| (e, Relation::NotEqual))) {
            let guard = without_squares(g, guard);
            let is_number = g.as_number(guard.0).is_some();
            if is_number || !space.jets_in(&[guard.0]).is_empty() {
                continue;
            }
            let said = |relation: Relation| {
                let symbol = match relation {
                    Relation::NotEqual => "≠",
                    other => other.symbol(),
                };
                format!("{} {symbol} 0", g.text(guard.0))
            };
            match region.holds(guard) {
                Some(true) => {}
                Some(false) => return Coefficients::Broken(said(guard.1)),
                None if is_of_box(functional, guard.0) => {
                    undecided.get_or_insert_with(|| said(guard.1));
                }
                None if !open.contains(&said(guard.1)) => open.push(said(guard.1)),
                None => {}
            }
        }
        undecided.map_or(Coefficients::Smooth(open), Coefficients::Undecided)
    }
}

/// A guard with what is squared in it alone: a square is positive where its base is not zero.
fn without_squares(g: &Graph, (e, relation): Guard) -> Guard {
    let own = simplify(g, e, &Options::default());
    match g.node(own) {
        Node::Power { base, exponent } if relation != Relation::GreaterOrEqual => {
            let is_even = g.as_integer(*exponent).is_some_and(|n| n > 0 && n % 2 == 0);
            if is_even {
                (*base, Relation::NotEqual)
            } else {
                (e, relation)
            }
        }
        _ => (e, relation),
    }
}

/// Whether an expression is one of places alone, in a box: that it does not vanish is then no condition on the body.
fn is_of_box(functional: &Functional, e: Expr) -> bool {
    let space = &*functional.space;
    let places: Vec<_> = space
        .coordinates
        .iter()
        .filter_map(|c| space.graph.as_symbol(c.expr))
        .collect();
    let mut symbols = space.symbols_in(&[e]).into_iter();
    !functional.intervals.is_empty() && symbols.all(|s| places.contains(&s))
}
