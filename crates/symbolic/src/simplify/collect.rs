//! Equations ordered by accelerations, then velocities.

use super::measure::written_length as length;
use super::{contains_solve, is_hopeless, simplify, Arrangers, Fields, Options, Written};
use crate::polynomial::normal_form::{Field, Options as Reading};
use crate::polynomial::{Budget, Monomial, Polynomial, RationalFunction};
use crate::{Expr, Graph};

/// Polynomials with more terms than this are only ordered: no shorter form of the whole is looked for.
const MOST_WHOLE: usize = 150;
/// Nodes and polynomials of what is ordered only, which costs little more than reading it.
const MOST_NODES: usize = 20_000;
const ORDERED: Budget = Budget {
    terms: 20_000,
    work: 20_000_000,
    ..Budget::DISPLAY
};

/// The expression as a sum over the first group (accelerations, say), each with its simplified coefficient, plus a rest
/// that is ordered by the second group, and so on. Groups in which the expression is not polynomial are left alone.
///
/// Returns the [simplified](simplify) expression instead when that is shorter by a third, as where a factor common to
/// all terms comes out, and the input when nothing shorter than it was found.
pub fn collect(g: &Graph, e: Expr, groups: &[&[Expr]], options: &Options) -> Expr {
    let nodes = g.reachable(&[e]).len();
    if nodes > options.max_nodes.max(MOST_NODES) || is_hopeless(g, &[e]) {
        return e;
    }
    if let Some(ordered) = large(g, e, groups) {
        return ordered;
    }
    let simple = simplify(g, e, options);
    let reading = Reading::display(options.budget);
    let Some(collected) = Fields::read(g, &[simple], &reading).and_then(|(fields, values)| {
        let arrangers = Arrangers::new(&fields, Written::of(g, &[simple]));
        Ordered::new(&fields.plain, &arrangers, groups, false).shortest(values.first()?)
    }) else {
        return simple;
    };
    let (long, short) = (length(g, collected), length(g, simple));
    // Lengths with and without solutions of linear systems cannot be compared.
    let comparable = contains_solve(g, e) == contains_solve(g, collected);
    if (comparable && long > length(g, e)) || 3 * short < 2 * long {
        simple
    } else {
        collected
    }
}

/// What is too large to be arranged as a whole, ordered; `None` for what is not, or is beyond every budget.
fn large(g: &Graph, e: Expr, groups: &[&[Expr]]) -> Option<Expr> {
    // Multiplying out solutions of linear systems lengthens: their products are shared.
    if g.tree_size(e) <= MOST_WHOLE as u64 || contains_solve(g, e) {
        return None;
    }
    let (fields, values) = Fields::read_once(g, e, &Reading::display(ORDERED))?;
    let value = values.first()?;
    if value.numerator().len() <= MOST_WHOLE || value.denominator().len() > MOST_WHOLE {
        return None;
    }
    let arrangers = Arrangers::quick(&fields, Written::of(g, &[e]));
    let ordered = Ordered::new(&fields.plain, &arrangers, groups, true).separate(value)?;
    (length(g, ordered) <= length(g, e)).then_some(ordered)
}

/// [`collect`] for several expressions.
pub fn collect_all(g: &Graph, es: &[Expr], groups: &[&[Expr]], options: &Options) -> Vec<Expr> {
    es.iter().map(|&e| collect(g, e, groups, options)).collect()
}

/// Orders values of a field by groups of generators.
struct Ordered<'a, 'b, 'g> {
    field: &'a Field<'g>,
    arrangers: &'a Arrangers<'b, 'g>,
    groups: &'a [&'a [Expr]],
    /// Whether the rest is always written term by term.
    large: bool,
}

impl<'a, 'b, 'g> Ordered<'a, 'b, 'g> {
    fn new(
        field: &'a Field<'g>,
        arrangers: &'a Arrangers<'b, 'g>,
        groups: &'a [&'a [Expr]],
        large: bool,
    ) -> Self {
        Ordered {
            field,
            arrangers,
            groups,
            large,
        }
    }

    /// Each coefficient with its own denominator, or one denominator below all.
    fn shortest(&self, value: &RationalFunction) -> Option<Expr> {
        let g = self.field.graph();
        let forms = [self.separate(value), self.over_one_denominator(value)];
        forms.into_iter().flatten().min_by_key(|&e| length(g, e))
    }

    /// `M (Σ …)/D` with the numerator ordered and M a product of generators; `None` where some term needs less than D.
    fn over_one_denominator(&self, value: &RationalFunction) -> Option<Expr> {
        let (n, d) = (value.numerator(), value.denominator());
        let inside = polynomial_generators(self.field, value, self.groups.first()?)?;
        let needs_less = |(_, c): &(Monomial, Polynomial)| {
            RationalFunction::new(c.clone(), d.clone(), self.field.meter())
                .is_ok_and(|part| part.is_some_and(|part| part.denominator() != d))
        };
        if d.is_constant() || n.coefficients(&inside).iter().any(needs_less) {
            return None;
        }
        let common = n.monomial_content();
        let sum = self.separate(&n.quotient_by_monomial(&common)?.into())?;
        let outside = Polynomial::term(common, 1.into());
        let outside = RationalFunction::new(outside, d.clone(), self.field.meter()).ok()??;
        self.arrangers.fraction_times(&outside, sum)
    }

    fn separate(&self, value: &RationalFunction) -> Option<Expr> {
        let mut rest = value.clone();
        let mut parts = Vec::new();
        for (level, group) in self.groups.iter().enumerate() {
            let Some(inside) = polynomial_generators(self.field, &rest, group) else {
                continue;
            };
            if inside.is_empty() {
                continue;
            }
            let (terms, free) = self.terms(&rest, &inside)?;
            if level + 1 == self.groups.len() {
                parts.push(self.last(&rest, terms, &free)?);
                rest = RationalFunction::zero();
                break;
            }
            parts.extend(terms);
            rest = free;
        }
        if !rest.is_zero() {
            parts.push(self.arrangers.fraction(&rest)?);
        }
        Some(self.field.graph().add(&parts))
    }

    /// Velocities: term by term, unless shared factors make the arrangement of the whole much shorter.
    fn last(
        &self,
        rest: &RationalFunction,
        mut terms: Vec<Expr>,
        free: &RationalFunction,
    ) -> Option<Expr> {
        let g = self.field.graph();
        if !free.is_zero() {
            terms.push(self.arrangers.fraction(free)?);
        }
        let separate = g.add(&terms);
        if self.large {
            return Some(separate);
        }
        let whole = self.arrangers.fraction(rest)?;
        let worth = 5 * length(g, separate) <= 6 * length(g, whole);
        Some(if worth { separate } else { whole })
    }

    /// The terms with their coefficients, and what is free of the generators.
    fn terms(
        &self,
        value: &RationalFunction,
        inside: &[usize],
    ) -> Option<(Vec<Expr>, RationalFunction)> {
        let mut free = RationalFunction::zero();
        let mut terms = Vec::new();
        for (monomial, coefficient) in value.numerator().coefficients(inside) {
            let below = value.denominator().clone();
            let part = RationalFunction::new(coefficient, below, self.field.meter()).ok()??;
            if monomial.is_one() {
                free = part;
            } else {
                let factor = self.field.monomial_expression(&monomial);
                terms.push(self.arrangers.fraction_times(&part, factor)?);
            }
        }
        Some((terms, free))
    }
}

/// The generators of the group, when the value is a polynomial in them: they occur neither below the bar nor inside
/// other generators.
pub(super) fn polynomial_generators(
    field: &Field<'_>,
    value: &RationalFunction,
    group: &[Expr],
) -> Option<Vec<usize>> {
    let g = field.graph();
    let symbols: Vec<_> = group.iter().filter_map(|&e| g.as_symbol(e)).collect();
    let mut inside: Vec<usize> = Vec::with_capacity(group.len());
    for &e in group {
        // Named twice, a generator would be divided out twice.
        if let Some(i) = field.generator_of(e).filter(|i| !inside.contains(i)) {
            inside.push(i);
        }
    }
    let occurs = |p: &Polynomial, generator: usize| p.degree_in(generator) > 0;
    for (i, generator) in field.generators().iter().enumerate() {
        if inside.contains(&i) {
            if occurs(value.denominator(), i) {
                return None;
            }
        } else if (occurs(value.numerator(), i) || occurs(value.denominator(), i))
            && g.contains_any(generator.expr, &symbols)
        {
            return None;
        }
    }
    Some(
        inside
            .into_iter()
            .filter(|&i| occurs(value.numerator(), i))
            .collect(),
    )
}
