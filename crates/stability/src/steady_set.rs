//! All steady motions of a system: the common zeros of what changes the variables of its smallest closed system.
//!
//! Sines and cosines of coordinates, and roots, are unknowns of their own with the relations that they satisfy, so that the equations are
//! polynomials; their zeros are a union of triangular systems, in which each equation determines one unknown by those before it. Where no unknown
//! is free the motions are isolated, and every real one is enclosed; else they are a family with the free unknowns as parameters. States of rest
//! are sought in the same way, with all velocities zero: fewer unknowns.

use crate::branch::{Branch, Chain};
use crate::charts::{is_assumed, other_charts, union};
use crate::left_out::{is_pole, vanish_nowhere};
use crate::reduction::Speeds;
use crate::semidefinite::RealParts;
use crate::steady::closed;
pub use crate::steady_equations::Sought;
use crate::steady_equations::{choices, Asked, Equations};
pub use crate::steady_motions::{Found, SteadySet};
use crate::steady_value::{Generators, Unknown};
pub use crate::steady_value::{SteadySetError, Value};
use chetaev_mechanics::constraint::{Constraint, ConstraintKind};
use chetaev_mechanics::{MotionTerms, Selection, System};
use chetaev_symbolic::common_zeros::{angles, needed_relations, Numbers};
use chetaev_symbolic::factors::{factored, irreducible_factors};
use chetaev_symbolic::polynomial::normal_form::{normal_forms, Field, Kind, Options};
use chetaev_symbolic::polynomial::{triangular_systems, Budget, Polynomial, TooLarge};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Graph, Symbol};

/// The steady motions of a system with these values of parameters; others stay symbols in general position.
///
/// # Errors
/// [`SteadySetError`] where they cannot all be found so.
pub fn steady_set(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    values: &[(Expr, Expr)],
) -> Result<SteadySet, SteadySetError> {
    all_of(Sought::SteadyMotions, (system, terms, selection), values)
}

/// Those with values of positions and velocities that are given: these are put into the equations before they are solved.
///
/// # Errors
/// [`SteadySetError`] where they cannot all be found so.
pub fn with_given(
    (system, terms, selection): (&System, &MotionTerms, &Selection),
    values: &[(Expr, Expr)],
    given: &[(Expr, Expr)],
) -> Result<SteadySet, SteadySetError> {
    let which = (Sought::SteadyMotions, given);
    all_with(which, (system, terms, selection), values)
}

/// The states of rest, or all steady motions.
///
/// # Errors
/// [`SteadySetError`] where they cannot all be found so.
pub fn all_of(
    sought: Sought,
    system: (&System, &MotionTerms, &Selection),
    values: &[(Expr, Expr)],
) -> Result<SteadySet, SteadySetError> {
    all_with((sought, &[]), system, values)
}

fn all_with(
    (sought, given): (Sought, &[(Expr, Expr)]),
    (system, terms, selection): (&System, &MotionTerms, &Selection),
    values: &[(Expr, Expr)],
) -> Result<SteadySet, SteadySetError> {
    if let Some(constraint) = system
        .constraints
        .iter()
        .find(|own| is_product(system, own))
    {
        return Err(SteadySetError::Product {
            constraint: constraint.name.clone(),
        });
    }
    let in_chart = |chart: &Selection, speeds| {
        let asked = Asked {
            sought,
            values,
            given,
            speeds,
        };
        in_chart(system, terms, chart, asked)
    };
    // What is no state that the constraints allow is not left out.
    let is_state = |e: &Expr| !vanish_nowhere(system, &[*e], values);
    let mut set = in_chart(selection, Speeds::Suitable)?;
    set.excluded.retain(is_state);
    for chart in other_charts(selection, choices(system.n(), selection.rows.len())) {
        if set.excluded.is_empty() {
            break;
        }
        let other = in_chart(&chart, Speeds::Independent);
        if let Some(other) = other.ok().filter(|other| other.ignorable == set.ignorable) {
            union(system, &mut set, &other);
            set.excluded.retain(is_state);
        }
    }
    sort(&mut set.found);
    let excluded = std::mem::take(&mut set.excluded).into_iter();
    (set.poles, set.excluded) = excluded.partition(|&e| is_pole(system, e, values));
    Ok(set)
}

/// Whether a constraint is a product, of which motions keep one factor or another at zero.
fn is_product(system: &System, constraint: &Constraint) -> bool {
    let g = &system.graph;
    let e = match constraint.kind {
        ConstraintKind::Holonomic => constraint.stated,
        _ => constraint.f,
    };
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    irreducible_factors(g, e, &symbols).is_some_and(|all| all.len() > 1)
}

/// The steady motions where the speeds of one choice serve.
fn in_chart(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    asked: Asked<'_>,
) -> Result<SteadySet, SteadySetError> {
    let g = &system.graph;
    let equations = Equations::new(system, terms, selection, asked)?;
    let symbols: Vec<Symbol> = equations.unknowns.iter().map(|(s, _)| *s).collect();
    let mut options = Options::proof(Budget::PROOF);
    let all = [
        equations.vanishing.clone(),
        equations.slopes.clone(),
        equations.regular.clone(),
    ]
    .concat();
    options.base_angles = angles(g, &all, &symbols);
    let (field, forms) = normal_forms(g, &all, &options)?;
    let vanishing = forms.iter().take(equations.vanishing.len());
    let numerators: Vec<Polynomial> = vanishing.map(|f| f.numerator().clone()).collect();
    let count = numerators.len();
    let mut denominators: Vec<Polynomial> = forms.iter().map(|f| f.denominator().clone()).collect();
    // By these was divided to solve constraints for dependent velocities.
    let regular = forms.iter().skip(count + equations.slopes.len());
    denominators.extend(regular.map(|f| f.numerator().clone()));
    let polynomials = [numerators, denominators.clone()].concat();
    let relations = needed_relations(&field, &polynomials)?;
    // What stands under a root alone is an unknown too.
    let related = [polynomials.clone(), relations.clone()].concat();
    let unknowns = unknowns(&field, &equations, &related)?;
    let order = order(&field, &unknowns, &related);
    let meter = field.meter();
    let vanishing = &polynomials[..count];
    let vanishing: Vec<Polynomial> = vanishing.iter().chain(&relations).cloned().collect();
    let numbers = Numbers::new(&field);
    let vanish = |p: &Polynomial| numbers.vanish(p);
    if denominators.iter().any(|p| vanish(p) == Some(true)) {
        return Err(SteadySetError::Undefined);
    }
    let chains = triangular_systems(&vanishing, &denominators, &order, (&vanish, meter))?;
    let elimination = RealParts {
        vanishing: &vanishing,
        unknowns: &unknowns,
        order: &order,
        vanish: &vanish,
    };
    let chains = elimination.of(chains);
    if let Some(number) = numbers.undecided() {
        return Err(SteadySetError::Undecided { number });
    }
    let anywhere = equations.others().into_iter();
    let anywhere: Vec<Symbol> = anywhere.map(|j| system.coordinates[j].q_symbol).collect();
    let mut found = Vec::new();
    for system_of_chain in &chains {
        let chain = Chain {
            system,
            field: &field,
            unknowns: &unknowns,
            order: &order,
            relations: &relations,
            equations: system_of_chain,
        };
        for branch in chain.branches()? {
            let own = found_of(&chain, &equations, branch);
            let is_assumed = is_assumed(system, &own, (asked.values, &anywhere));
            found.push(Found { is_assumed, ..own });
        }
    }
    distinct(&mut found);
    sort(&mut found);
    Ok(SteadySet {
        variables: unknowns.iter().map(|u| u.name.clone()).collect(),
        speeds: equations.speeds(),
        ignorable: equations.ignorable(),
        found,
        excluded: excluded(&field, &denominators, &symbols)?,
        poles: Vec::new(),
        has_full_rank: equations.has_full_rank(terms, selection),
    })
}

/// The unknowns with the generators that stand for them.
fn unknowns(
    field: &Field<'_>,
    equations: &Equations<'_>,
    polynomials: &[Polynomial],
) -> Result<Vec<Unknown>, SteadySetError> {
    let g = field.graph();
    let own: Vec<Symbol> = equations.unknowns.iter().map(|(s, _)| *s).collect();
    let occurs = |generator: usize| polynomials.iter().any(|p| p.degree_in(generator) > 0);
    let mut found: Vec<Unknown> = Vec::new();
    for (at, (symbol, name)) in equations.unknowns.iter().enumerate() {
        let plain = field.generator_of(g.symbol_expr(*symbol));
        let mut by = plain
            .filter(|&generator| occurs(generator))
            .map_or(Generators::None, Generators::Own);
        for pair in field.pythagoras().iter().filter(|pair| pair.circular) {
            if !occurs(pair.sine) && !occurs(pair.cosine) {
                continue;
            }
            let argument = field.argument_of(pair.sine);
            let Some(times) = argument.and_then(|e| multiple(g, e, *symbol)) else {
                continue;
            };
            if !matches!(by, Generators::None) {
                return Err(not_polynomial(field, pair.sine));
            }
            by = Generators::Angle {
                cosine: pair.cosine,
                sine: pair.sine,
                times,
            };
        }
        found.push(Unknown {
            symbol: *symbol,
            name: name.clone(),
            is_speed: at >= equations.coordinates.len(),
            by,
        });
    }
    let is_known = |generator: usize| {
        let own = &field.generators()[generator];
        let mut all = found.iter();
        let is_of = |u: &Unknown| match u.by {
            Generators::Own(own) => own == generator,
            Generators::Angle { cosine, sine, .. } => cosine == generator || sine == generator,
            Generators::None => false,
        };
        let is_root = matches!(own.kind, Kind::Absolute | Kind::Radical { .. });
        is_root || all.any(is_of)
    };
    let count = field.generators().len();
    let mut odd = (0..count).filter(|&at| occurs(at) && !is_known(at));
    let strange = odd.find(|&at| g.contains_any(field.generators()[at].expr, &own));
    match strange {
        Some(at) => Err(not_polynomial(field, at)),
        None => Ok(found),
    }
}

fn not_polynomial(field: &Field<'_>, generator: usize) -> SteadySetError {
    SteadySetError::NotPolynomial {
        what: field.graph().text(field.generators()[generator].expr),
    }
}

/// The rational number by which a symbol is multiplied to give an expression.
fn multiple(g: &Graph, e: Expr, symbol: Symbol) -> Option<(i64, i64)> {
    let slope = g.diff(e, symbol);
    let own = g.as_number(slope)?.clone();
    let rest = closed(g, g.sub(e, g.mul(&[slope, g.symbol_expr(symbol)])));
    if !g.is_zero(rest) || g.is_zero(slope) {
        return None;
    }
    let (above, below) = own.into_parts();
    Some((i64::try_from(above).ok()?, i64::try_from(below).ok()?))
}

/// The generators to be determined, those that are eliminated last first: numbers, then angles, coordinates, velocities (those of lower degree
/// are solved for first), roots.
fn order(field: &Field<'_>, unknowns: &[Unknown], polynomials: &[Polynomial]) -> Vec<usize> {
    let g = field.graph();
    let symbols: Vec<Symbol> = unknowns.iter().map(|u| u.symbol).collect();
    let depends = |at: usize| g.contains_any(field.generators()[at].expr, &symbols);
    let relations = field.relations().unwrap_or_default();
    let related = || relations.iter().map(|(generator, _)| *generator);
    let mut all: Vec<usize> = related().filter(|&at| !depends(at)).collect();
    for own in unknowns {
        if let Generators::Angle { cosine, sine, .. } = own.by {
            all.extend([cosine, sine]);
        }
    }
    let degree = |at: usize| polynomials.iter().map(|p| p.degree_in(at)).max();
    let plain = unknowns.iter().filter_map(|u| match u.by {
        Generators::Own(at) => Some((u.is_speed, std::cmp::Reverse(degree(at)), at)),
        _ => None,
    });
    let mut plain: Vec<_> = plain.collect();
    plain.sort_unstable();
    all.extend(plain.into_iter().map(|(_, _, at)| at));
    let roots: Vec<usize> = related()
        .filter(|&at| depends(at) && !all.contains(&at))
        .collect();
    all.extend(roots);
    all
}

/// The denominators in which unknowns occur.
fn excluded(
    field: &Field<'_>,
    denominators: &[Polynomial],
    symbols: &[Symbol],
) -> Result<Vec<Expr>, TooLarge> {
    let g = field.graph();
    let mut all = Vec::new();
    for p in denominators {
        for (factor, _) in p.factorize(field.meter())?.factors {
            let e = field.polynomial_expression(&factor);
            let is_nonzero = known_sign(g, closed(g, e), &Assumptions::new()).is_nonzero();
            if g.contains_any(e, symbols) && !is_nonzero && !all.contains(&e) {
                all.push(e);
            }
        }
    }
    Ok(all)
}

fn found_of(chain: &Chain<'_, '_>, equations: &Equations<'_>, branch: Branch) -> Found {
    let g = chain.field.graph();
    let values: Vec<Value> = chain.values(&branch);
    let exact = |value: &Value| match value {
        Value::Number { exact, .. } => *exact,
        Value::Function(e) => Some(*e),
        Value::Tied => None,
    };
    let all: Option<Vec<Expr>> = values.iter().map(exact).collect();
    Found {
        name: String::new(),
        motion: all.map(|all| equations.motion("", &all)),
        is_singular: equations.is_singular_along(&values),
        is_assumed: true,
        is_real: branch.free.is_empty() || chain.has_real_point(),
        equations: chain.open_equations(&branch),
        conditions: branch
            .conditions
            .iter()
            .filter_map(|&e| restriction(g, closed(g, e)))
            .collect(),
        free: branch.free,
        values,
    }
}

/// What must not be negative, without its positive numerical factor; `None` where it never is.
fn restriction(g: &Graph, e: Expr) -> Option<Expr> {
    let Some(parts) = factored(g, e) else {
        return g.as_number(e).is_none().then_some(e);
    };
    let is_even = parts.factors.iter().all(|(_, power)| power % 2 == 0);
    if is_even && !rational::is_negative(&parts.coefficient) {
        return None;
    }
    let positive = g.number(rational::abs(&parts.coefficient));
    Some(closed(g, g.div(e, positive)))
}

/// Single motions whose values are enclosed by the same small intervals are one: different branches of a root or an absolute value meet there.
fn distinct(found: &mut Vec<Found>) {
    let is_same = |a: &Found, b: &Found| {
        let mut pairs = a.values.iter().zip(&b.values);
        pairs.all(|pair| match pair {
            (Value::Number { ball: a, .. }, Value::Number { ball: b, .. }) => a.overlaps(b),
            _ => false,
        })
    };
    let mut at = 1;
    while at < found.len() {
        let is_single = found[at].dimension() == 0 && !found[at].values.is_empty();
        if is_single && found[..at].iter().any(|own| is_same(own, &found[at])) {
            found.remove(at);
        } else {
            at += 1;
        }
    }
}

/// Isolated motions first, by their values, then families by their dimension; each gets its number.
fn sort(found: &mut [Found]) {
    let key = |own: &Found| -> (usize, Vec<f64>) {
        let values = own.values.iter().map(|value| match value {
            Value::Number { ball, .. } => ball.to_f64(),
            _ => f64::INFINITY,
        });
        (own.dimension(), values.collect())
    };
    found.sort_by(|a, b| {
        let ((m, a), (n, b)) = (key(a), key(b));
        let pairs = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b));
        m.cmp(&n)
            .then(pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then))
    });
    for (at, own) in found.iter_mut().enumerate() {
        own.name = (at + 1).to_string();
        if let Some(motion) = &mut own.motion {
            motion.name = own.name.clone();
        }
    }
}
