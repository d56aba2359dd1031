//! The functions of the positions that integrable constraints keep.
//!
//! They are searched among combinations of functions of (t, q) that occur in the model, of logarithms of these, and of arctangents whose derivatives have their denominators. A combination with
//! logarithms is shown by its exponential: `ln y - k x` as `y exp(-k x)`, `ln y - k ln x` as `y x^(-k)`. So integrating factors
//! that are functions of one coordinate, and separable constraints, are covered where their quadratures are in the family.

use super::arctangents::arctangents;
use super::components::components;
use super::presented::presented;
use super::quadrature::{Fields, Variable};
use super::subsystems;
use crate::flag::{horizontal, Directed};
use crate::growth::generated;
use crate::noether::ansatz::Ansatz;
use crate::noether::family::coefficients;
use crate::noether::letters::{fixed_coordinates, Letters};
use crate::noether::motion::Motion;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::components::Stratum;
use chetaev_mechanics::{Characteristics, Context, Formula, Manifold, Prepared, System};
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::rational::content;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Function, Node, Rational, Verdict};

/// The most functions combined, without logarithms.
const MEMBERS: usize = 90;

/// Their highest weight.
const WEIGHT: u32 = 4;

/// The coefficients of constraints that are larger together, in nodes, are not factored.
const JACOBIAN: usize = 200;

/// Larger results of quadratures, in nodes, are not proved.
const QUADRATURE: usize = 600;

/// The most factors of coefficients.
const FACTORS: usize = 20;

/// A function in the combination.
#[derive(Clone, Copy)]
enum Member {
    /// As it is.
    Plain(Expr),
    /// The logarithm of it.
    Logarithm(Expr),
}

/// So many combinations are looked at for each constraint: functions of those before them are among them.
const LOOKED_AT: usize = 12;

/// What constraints keep.
pub(super) struct Kept {
    /// On which component of constraints that are products, or on which side of their corners, where it is kept there only.
    pub(super) place: Option<String>,
    /// Functions of (t, q).
    pub(super) functions: Vec<Expr>,
    /// How many there are, where that is known.
    pub(super) count: Option<usize>,
}

/// Longer functions are not printed within a sentence, in signs.
const SHOWN: u64 = 160;

/// What the context's constraints keep, on each component where they are products, on each side of corners; constraints that are
/// functions of simpler ones are replaced by these.
pub(super) fn kept(cx: &Context<'_>) -> Vec<Kept> {
    let components = components(cx);
    if !components.is_empty() {
        return on_each(cx, components, "on the component ");
    }
    let sides = cx.system.sides();
    if !sides.is_empty() {
        return on_each(cx, sides, "where ");
    }
    vec![own(cx, None)]
}

/// Whether it is known that smooth constraints keep nothing, or nothing can be known of their brackets.
pub(super) fn is_nothing(cx: &Context<'_>) -> bool {
    let divided = !cx.system.components().is_empty() || !cx.system.sides().is_empty();
    !divided
        && match &*generated(cx) {
            Ok(generated) => generated.kept(cx) == Some(0),
            Err(_) => cx.system.fixed_functions().is_empty(),
        }
}

/// The same on each of several systems in the place of this one.
fn on_each(cx: &Context<'_>, systems: Vec<Stratum>, words: &str) -> Vec<Kept> {
    let on = systems.into_iter().map(|on| {
        let place = on.condition.map(|condition| format!("{words}{condition}"));
        let unknown = || Kept {
            place: place.clone(),
            functions: Vec::new(),
            count: None,
        };
        on_its_own(cx, &on.system, |own| self::own(own, place.clone())).unwrap_or_else(unknown)
    });
    on.collect()
}

/// What smooth constraints keep.
fn own(cx: &Context<'_>, place: Option<String>) -> Kept {
    let count = match &*generated(cx) {
        Ok(generated) => generated.kept(cx),
        Err(_) => None,
    };
    Kept {
        place,
        functions: found(cx, count).0.clone(),
        count,
    }
}

/// Kept functions, found once for all claims.
struct FoundFunctions(Vec<Expr>);

fn found(cx: &Context<'_>, count: Option<usize>) -> std::sync::Arc<FoundFunctions> {
    cx.shared(|cx| FoundFunctions(functions(cx, count)))
}

/// What is kept of so many functions in words, and as formulas.
pub(crate) fn named(cx: &Context<'_>, count: usize) -> (String, Vec<Formula>) {
    let kept = own(cx, None);
    (said(cx, &kept.functions, Some(count)), formulas(&kept))
}

/// Functions with what is missing of a number of them.
pub(super) fn said(cx: &Context<'_>, functions: &[Expr], count: Option<usize>) -> String {
    let g = &cx.system.graph;
    let text = |&e: &Expr| {
        let text = g.text(e);
        match text.chars().count() as u64 > SHOWN {
            true => "one that is too long for a sentence and stands with the formulas".to_owned(),
            false => text,
        }
    };
    let texts: Vec<String> = functions.iter().map(text).collect();
    let missing = count.map_or(0, |count| count.saturating_sub(functions.len()));
    let not_found = "not found among the functions that occur, their logarithms and arctangents, and by quadratures";
    match (texts.is_empty(), missing) {
        (true, _) => not_found.to_owned(),
        (false, 0) => texts.join(", "),
        (false, missing) => format!("{}, and {missing} more, {not_found}", texts.join(", ")),
    }
}

/// Functions as formulas.
pub(super) fn formulas(kept: &Kept) -> Vec<Formula> {
    let place = kept.place.iter().map(|place| format!(" {place}"));
    let place: String = place.collect();
    let caption = format!("a function of the positions that the constraints keep{place}");
    let formula = |&right: &Expr| Formula {
        caption: caption.clone(),
        left: None,
        right,
    };
    kept.functions.iter().map(formula).collect()
}

/// What is known of another system than the context's, with the work and the prover of this; `None` where it has no independent velocities.
pub(crate) fn on_its_own<T>(
    cx: &Context<'_>,
    system: &System,
    ask: impl FnOnce(&Context<'_>) -> T,
) -> Option<T> {
    let prepared = Prepared::new(system).ok()?;
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let own = Context::new(system, terms, selection, cx.registry(), cx.prover.clone());
    if cx.is_out_of_time() {
        own.spend_time();
    }
    Some(ask(&own.allowing(cx.work())))
}

/// Functions of (t, q) that the context's constraints keep, each proved, none a function of those before it: what holonomic
/// constraints fix, then what is found among combinations, then what quadratures give.
fn functions(cx: &Context<'_>, count: Option<usize>) -> Vec<Expr> {
    let most = count.unwrap_or(cx.selection.rows.len());
    let mut kept = cx.system.fixed_functions();
    let motion = match Motion::of(cx) {
        Ok(motion) if kept.len() < most && !cx.is_out_of_time() => motion,
        _ => return kept,
    };
    let fixed = fixed_coordinates(cx).into_iter().map(|c| c.q);
    let combined = fixed.chain(candidates(cx, &motion).unwrap_or_default());
    add(cx, &motion, &mut kept, most, combined);
    if kept.len() < most && !cx.is_out_of_time() {
        let found = by_quadratures(cx, cx, &motion);
        add(cx, &motion, &mut kept, most, found.into_iter());
    }
    for (terms, selection) in subsystems::small(cx) {
        if kept.len() >= most || cx.is_out_of_time() {
            break;
        }
        let prover = cx.prover.clone();
        let own = Context::new(cx.system, &terms, &selection, cx.registry(), prover);
        let found = by_quadratures(cx, &own.allowing(cx.work()), &motion);
        add(cx, &motion, &mut kept, most, found.into_iter());
    }
    kept
}

/// What quadratures give for the fields that the displacements generate which some of the constraints admit.
fn by_quadratures(cx: &Context<'_>, own: &Context<'_>, motion: &Motion<'_>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let generated = generated(own);
    let Ok(generated) = &*generated else {
        return Vec::new();
    };
    let Ok(flag) = &generated.flag else {
        return Vec::new();
    };
    let time = generated.with_time.then_some(Variable::Time);
    let places = system.coordinates.iter();
    let places: Vec<Variable> = places.map(|c| Variable::Place(c.q_symbol)).collect();
    let row = |field: &Directed| {
        let time = generated.with_time.then_some(field.time);
        time.into_iter()
            .chain(field.place.iter().copied())
            .collect()
    };
    // What was solved for is dependent, then what stands last.
    let dependent = own.selection.dependent.iter().map(|&i| places[i]);
    let mut preferred: Vec<Variable> = dependent.collect();
    let others = places.iter().rev().chain(&time).copied();
    let others: Vec<Variable> = others.filter(|v| !preferred.contains(v)).collect();
    preferred.extend(others);
    let fields = Fields {
        motion,
        seed: cx.prover.points_seed(),
        is_out_of_time: &|| cx.is_out_of_time(),
        variables: time.into_iter().chain(places).collect(),
        rows: flag.fields.iter().map(row).collect(),
        preferred,
    };
    let is_short = |e: Expr| g.reachable(&[e]).len() <= QUADRATURE;
    fields.integrals(&|e| is_short(e) && is_kept(cx, e).unwrap_or(false))
}

/// Adds candidates that are proved and no functions of those before them, up to so many.
fn add(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    kept: &mut Vec<Expr>,
    most: usize,
    candidates: impl Iterator<Item = Expr>,
) {
    for candidate in candidates {
        kept.push(candidate);
        let seed = cx.prover.points_seed();
        let independent = motion.independent_functions(kept, seed);
        let is_new = independent.is_some_and(|own| own.len() == kept.len());
        if !is_new || !is_kept(cx, candidate).unwrap_or(false) {
            kept.pop();
        }
        if kept.len() == most {
            break;
        }
    }
}

/// Combinations that are kept at the points looked at.
fn candidates(cx: &Context<'_>, motion: &Motion<'_>) -> Option<Vec<Expr>> {
    let g = &cx.system.graph;
    let members = members(cx, motion)?;
    let values: Vec<Expr> = members
        .iter()
        .map(|member| match *member {
            Member::Plain(e) => e,
            Member::Logarithm(e) => g.apply(Function::Log, &[e]),
        })
        .collect();
    let columns = rates(cx, &values)?;
    let seed = cx.prover.points_seed();
    let ansatz = Ansatz::new(motion, &columns, &Manifold::default(), &[], seed).ok()?;
    let found = ansatz.up_to(LOOKED_AT * cx.selection.rows.len())?;
    let shown = found.iter().map(|c| {
        let combined = combined(cx, &members, c);
        presented(cx.system, combined)
    });
    Some(shown.collect())
}

/// Whether a function of (t, q) is no constant, and proved to be kept along all admissible velocities.
fn is_kept(cx: &Context<'_>, integral: Expr) -> Option<bool> {
    let (system, g) = (cx.system, &cx.system.graph);
    let rates = rates(cx, &[integral])?.concat();
    let is = |e: &[Expr]| cx.prover.identity(system, e, &Manifold::default(), "");
    let slopes: Vec<Expr> = system
        .coordinates
        .iter()
        .map(|c| g.diff(integral, c.q_symbol))
        .collect();
    let moves = matches!(is(&slopes), Verdict::Refuted(_));
    Some(moves && matches!(is(&rates), Verdict::Proved(_)))
}

/// Independent functions of (t, q) that occur, and the coordinates, constants not among them, then logarithms of what they are built of.
fn members(cx: &Context<'_>, motion: &Motion<'_>) -> Option<Vec<Member>> {
    let g = &cx.system.graph;
    let letters = Letters::of(cx).coefficients;
    let mut monomials = coefficients(&letters, 0, 1);
    for weight in 2..=WEIGHT {
        let next = coefficients(&letters, 0, weight);
        if next.len() > MEMBERS {
            break;
        }
        monomials = next;
    }
    // Without roots first: where √(x² + y²)/y is kept so is x/y.
    let is_root = |&(l, _): &(usize, i8)| {
        let (_, exponent) = g.base_exponent(letters[l].letter.value);
        g.as_integer(exponent).is_none()
    };
    monomials.sort_by_key(|(weight, member)| (*weight, member.iter().any(is_root)));
    let value = |member: &[(usize, i8)]| {
        let powers = member.iter();
        let powers = powers.map(|&(l, e)| g.powi(letters[l].letter.value, i64::from(e)));
        g.mul(&powers.collect::<Vec<_>>())
    };
    // The constant stands first, so what is independent of it follows.
    let mut values: Vec<Expr> = monomials.iter().map(|(_, member)| value(member)).collect();
    let places = cx.system.coordinates.iter().map(|c| c.q);
    let places: Vec<Expr> = places.filter(|e| !values.contains(e)).collect();
    values.splice(values.len().min(1)..values.len().min(1), places);
    let columns: Vec<Vec<Expr>> = values.iter().map(|&e| vec![e]).collect();
    let seed = cx.prover.points_seed();
    let ansatz = Ansatz::new(motion, &columns, &Manifold::default(), &[], seed).ok()?;
    let independent = ansatz.independent()?;
    let plain = independent.into_iter().filter(|&i| !g.is_one(values[i]));
    let mut members: Vec<Member> = plain.map(|i| Member::Plain(values[i])).collect();
    let mut bases: Vec<Expr> = Vec::new();
    for letter in &letters {
        let (base, _) = g.base_exponent(letter.letter.value);
        let is_exponential = matches!(
            g.node(base),
            Node::Apply {
                function: Function::Exp,
                ..
            }
        );
        if !is_exponential && !bases.contains(&base) {
            bases.push(base);
        }
    }
    for factor in coefficient_factors(cx) {
        if !bases.contains(&factor) {
            bases.push(factor);
        }
    }
    members.extend(arctangents(cx, &bases).into_iter().map(Member::Plain));
    // Short ones first: combinations use those before them, and x/y is wanted where √(x² + y²)/y is kept too.
    bases.sort_by_key(|&e| length(g, e));
    members.extend(bases.into_iter().map(Member::Logarithm));
    Some(members)
}

/// Factors of the coefficients of velocities in the constraints: what is solved for one of them is divided by these.
fn coefficient_factors(cx: &Context<'_>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let velocities = system.velocity_symbols();
    let entries = cx.terms.jacobian.concat();
    if g.reachable(&entries).len() > JACOBIAN {
        return Vec::new();
    }
    let all = entries.into_iter().filter_map(|e| factored(g, e));
    let mut found: Vec<Expr> = Vec::new();
    for (factor, _) in all.flat_map(|e| e.factors) {
        let is_of_place = !is_free(cx, factor) && !g.contains_any(factor, &velocities);
        if is_of_place && found.len() < FACTORS && !found.contains(&factor) {
            found.push(factor);
        }
    }
    found
}

/// Whether nothing but parameters occurs.
pub(super) fn is_free(cx: &Context<'_>, e: Expr) -> bool {
    let g = &cx.system.graph;
    g.is_free_of(e, &|s| {
        g.symbol_name(s) == "t" || cx.system.moves(g.symbol_name(s))
    })
}

/// The derivatives of functions of (t, q) along all admissible velocities: one row for each function.
fn rates(cx: &Context<'_>, functions: &[Expr]) -> Option<Vec<Vec<Expr>>> {
    let system = cx.system;
    let chart = Characteristics::independent_velocities(system, cx.terms, cx.selection).ok()?;
    let (mut fields, drift) = horizontal(system, &chart).ok()?;
    fields.push(drift);
    let columns: Vec<Vec<Expr>> = fields
        .iter()
        .map(|field| derive_along(system, functions, &field.place, field.time, &[]))
        .collect();
    let row = |i: usize| columns.iter().map(|column| column[i]).collect();
    Some((0..functions.len()).map(row).collect())
}

/// The combination, or its exponential where logarithms occur in it.
fn combined(cx: &Context<'_>, members: &[Member], found: &[Expr]) -> Expr {
    let g = &cx.system.graph;
    let used = || {
        let pairs = members.iter().zip(found);
        pairs.filter(|(_, &c)| !g.is_zero(c))
    };
    let leading = used()
        .rfind(|(member, _)| matches!(member, Member::Logarithm(_)))
        .map(|(_, &c)| c);
    let plain = |by: Expr| -> Expr {
        let parts: Vec<Expr> = used()
            .filter_map(|(member, &c)| match *member {
                Member::Plain(e) => Some(g.mul(&[c, e, by])),
                Member::Logarithm(_) => None,
            })
            .collect();
        g.add(&parts)
    };
    let Some(leading) = leading else {
        return plain(g.one());
    };
    // Whole exponents where that is possible: x y² z³.
    let ratios: Option<Vec<Rational>> = used()
        .filter(|(member, _)| matches!(member, Member::Logarithm(_)))
        .map(|(_, &c)| g.as_number(g.div(c, leading)).cloned())
        .collect();
    let unit = ratios.map_or(Rational::ONE, |ratios| content(ratios.iter()));
    let by = g.div(g.number(Rational::ONE / unit), leading);
    let mut factors = vec![g.exp(plain(by))];
    factors.extend(used().filter_map(|(member, &c)| match *member {
        Member::Logarithm(e) => Some(g.pow(e, g.mul(&[c, by]))),
        Member::Plain(_) => None,
    }));
    g.mul(&factors)
}
