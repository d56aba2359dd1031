//! The functions of the positions that integrable constraints keep.
//!
//! They are searched among combinations of functions of (t, q) that occur in the model and of logarithms of these. A combination with
//! logarithms is shown by its exponential: `ln y - k x` as `y exp(-k x)`, `ln y - k ln x` as `y x^(-k)`. So integrating factors
//! that are functions of one coordinate, and separable constraints, are covered where their quadratures are in the family.

use crate::flag::horizontal;
use crate::noether::ansatz::Ansatz;
use crate::noether::family::coefficients;
use crate::noether::letters::{fixed_coordinates, Letters};
use crate::noether::motion::Motion;
use crate::noether::shown::readable;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::{Characteristics, Context, Manifold};
use chetaev_symbolic::rational::content;
use chetaev_symbolic::{Expr, Function, Node, Rational, Verdict};

/// The most functions combined, without logarithms.
const MEMBERS: usize = 90;

/// Their highest weight.
const WEIGHT: u32 = 4;

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

/// Functions of (t, q) that the context's constraints keep, each proved, none a function of those before it: what holonomic
/// constraints fix, then what is found.
pub(super) fn kept(cx: &Context<'_>) -> Vec<Expr> {
    let (most, mut kept) = (cx.selection.rows.len(), cx.system.fixed_functions());
    let motion = match Motion::of(cx) {
        Ok(motion) if kept.len() < most && !cx.is_out_of_time() => motion,
        _ => return kept,
    };
    let fixed = fixed_coordinates(cx).into_iter().map(|c| c.q);
    for candidate in fixed.chain(candidates(cx, &motion).unwrap_or_default()) {
        kept.push(candidate);
        let seed = cx.prover.points_seed();
        let independent = motion.independent_functions(&kept, seed);
        let is_new = independent.is_some_and(|own| own.len() == kept.len());
        if !is_new || !is_kept(cx, candidate).unwrap_or(false) {
            kept.pop();
        }
        if kept.len() == most {
            break;
        }
    }
    kept
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
        readable(g, without_power(cx, combined))
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

/// The base of a power with a constant exponent, which is kept as well: x² + y² for 1/√(x² + y²).
fn without_power(cx: &Context<'_>, e: Expr) -> Expr {
    let g = &cx.system.graph;
    let (base, exponent) = g.base_exponent(e);
    match g.as_number(exponent) {
        Some(_) => base,
        None => e,
    }
}

/// Independent functions of (t, q) that occur, constants not among them, then logarithms of what they are built of.
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
    let value = |member: &[(usize, i8)]| {
        let powers = member.iter();
        let powers = powers.map(|&(l, e)| g.powi(letters[l].letter.value, i64::from(e)));
        g.mul(&powers.collect::<Vec<_>>())
    };
    // The constant stands first, so what is independent of it follows.
    let values: Vec<Expr> = monomials.iter().map(|(_, member)| value(member)).collect();
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
    members.extend(bases.into_iter().map(Member::Logarithm));
    Some(members)
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
