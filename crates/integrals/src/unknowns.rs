//! Stated forms of first integrals with unknown constants and functions, `a x'^2 + b y'^2 + h(x)`.
//!
//! The unknowns enter linearly, so `X̄G = 0` is linear in the constants and in the coefficients of the unknown functions, which are
//! looked for among products of powers of their arguments and of the functions of these that occur in the motion. The family of such
//! products grows by weight as far as the equations stay small.

use crate::ansatz::Ansatz;
use crate::motion::Motion;
use chetaev_mechanics::system::{IntegralForm, Unknown};
use chetaev_mechanics::Context;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};

/// At most so many products stand for one unknown function: their equations take about a second.
const PRODUCTS: usize = 60;

/// The range of powers of an argument: potentials such as `1/r²` and `x⁶` are among them.
const POWERS: std::ops::RangeInclusive<i64> = -3..=6;

/// What a form contains.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The solutions of a basis: an integral with what its unknowns are, in the order of the form.
    pub integrals: Vec<Solution>,
    /// Whether every integral of the form is a combination of these: so where no function is unknown.
    pub complete: bool,
}

/// One integral of a form.
#[derive(Clone, Debug)]
pub struct Solution {
    /// G.
    pub integral: Expr,
    /// The values of the unknowns.
    pub unknowns: Vec<(Symbol, Expr)>,
    /// The proof of `X̄G = 0`.
    pub verdict: Verdict,
}

/// Why a form was not solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotSolved {
    /// A product or a function of unknowns.
    #[error("the unknowns do not enter linearly")]
    NotLinear,
    /// No points over a prime field.
    #[error("the equations for the unknowns could not be solved")]
    Equations,
}

/// A product of powers that an unknown is a combination of.
struct Member {
    unknown: usize,
    function: Expr,
}

/// The integrals of a form.
///
/// # Errors
/// [`NotSolved`].
pub fn solved(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    form: &IntegralForm,
) -> Result<Solved, NotSolved> {
    let g = &cx.system.graph;
    let symbols: Vec<Symbol> = form
        .unknowns
        .iter()
        .filter_map(|unknown| g.as_symbol(unknown.symbol))
        .collect();
    let slopes = g.gradient(form.value, &symbols);
    if g.any_contains_any(&slopes, &symbols) {
        return Err(NotSolved::NotLinear);
    }
    let zeros: Vec<(Expr, Expr)> = form.unknowns.iter().map(|u| (u.symbol, g.zero())).collect();
    let rest = g.substitute(form.value, &zeros);
    let members: Vec<Member> = form
        .unknowns
        .iter()
        .enumerate()
        .flat_map(|(unknown, own)| {
            let functions = functions(g, motion, own).into_iter();
            functions.map(move |function| Member { unknown, function })
        })
        .collect();
    let term = |m: &Member| g.mul(&[slopes[m.unknown], m.function]);
    let mut terms: Vec<Expr> = members.iter().map(term).collect();
    let is_inhomogeneous = !g.is_zero(rest);
    if is_inhomogeneous {
        terms.push(rest);
    }
    let seed = cx.prover.points_seed();
    let columns = |es: Vec<Expr>| es.into_iter().map(|e| vec![e]).collect::<Vec<_>>();
    // Products that are combinations of others on the constraints would give integrals that are zero.
    let values = [&[g.one()][..], &terms].concat();
    let independent = Ansatz::new(motion, &columns(values), &motion.manifold, &[], seed)
        .map_err(|_| NotSolved::Equations)?
        .independent()
        .ok_or(NotSolved::Equations)?;
    let kept: Vec<usize> = independent
        .into_iter()
        .filter_map(|i| i.checked_sub(1))
        .collect();
    let rates = motion.derivatives(&kept.iter().map(|&i| terms[i]).collect::<Vec<Expr>>());
    let found = Ansatz::new(motion, &columns(rates), &motion.manifold, &[], seed)
        .map_err(|_| NotSolved::Equations)?
        .all()
        .ok_or(NotSolved::Equations)?;
    let whole = |coefficients: Vec<Expr>| -> Option<Solution> {
        let mut values = vec![g.zero(); form.unknowns.len()];
        let mut scale = g.one();
        if is_inhomogeneous {
            let place = kept.iter().position(|&i| i + 1 == terms.len())?;
            scale = coefficients[place];
            if g.is_zero(scale) {
                return None;
            }
        }
        for (&c, &i) in coefficients.iter().zip(&kept) {
            if let Some(member) = members.get(i) {
                let part = g.mul(&[g.div(c, scale), member.function]);
                values[member.unknown] = g.add(&[values[member.unknown], part]);
            }
        }
        let values: Vec<Expr> = values.into_iter().map(|e| readable(g, e)).collect();
        let pairs = form.unknowns.iter().zip(&values);
        let pairs: Vec<(Expr, Expr)> = pairs.map(|(u, &e)| (u.symbol, e)).collect();
        let integral = readable(g, g.substitute(form.value, &pairs));
        let verdict = motion.is_integral(cx, integral);
        matches!(verdict, Verdict::Proved(_)).then(|| Solution {
            integral,
            unknowns: symbols.iter().copied().zip(values).collect(),
            verdict,
        })
    };
    Ok(Solved {
        integrals: found.into_iter().filter_map(whole).collect(),
        complete: form.unknowns.iter().all(|u| u.arguments.is_empty()),
    })
}

fn readable(g: &Graph, e: Expr) -> Expr {
    simplify(g, e, &Options::default())
}

/// What an unknown may be: 1 for a constant, products of powers for a function, light ones first.
fn functions(g: &Graph, motion: &Motion<'_>, unknown: &Unknown) -> Vec<Expr> {
    let mut products = vec![(0, g.one())];
    let letters = letters(g, motion, unknown);
    for letter in letters {
        let before = products.clone();
        for (weight, product) in before {
            for exponent in letter.powers.clone().filter(|&e| e != 0) {
                let heavier = weight + exponent.unsigned_abs();
                products.push((heavier, g.mul(&[product, g.powi(letter.value, exponent)])));
            }
        }
        products.sort_by_key(|&(weight, _)| weight);
        products.truncate(PRODUCTS);
    }
    products.into_iter().map(|(_, e)| e).collect()
}

struct Letter {
    value: Expr,
    powers: std::ops::RangeInclusive<i64>,
}

/// The arguments, and the functions of them alone that occur in the motion.
fn letters(g: &Graph, motion: &Motion<'_>, unknown: &Unknown) -> Vec<Letter> {
    let own: Vec<Symbol> = unknown
        .arguments
        .iter()
        .filter_map(|&e| g.as_symbol(e))
        .collect();
    let mut all: Vec<Letter> = Vec::new();
    if own.is_empty() {
        return all;
    }
    let mut add = |value: Expr, powers: std::ops::RangeInclusive<i64>| {
        if !all.iter().any(|letter| letter.value == value) {
            all.push(Letter { value, powers });
        }
    };
    let is_own = |e: Expr| {
        g.contains_any(e, &own) && g.is_free_of(e, &|s| motion.moves(s) && !own.contains(&s))
    };
    for e in g
        .reachable(&motion.accelerations)
        .into_iter()
        .filter(|&e| is_own(e))
    {
        match g.node(e) {
            Node::Apply {
                function: Function::Sin | Function::Cos,
                arguments,
            } => {
                add(g.cos(arguments[0]), -2..=3);
                add(g.sin(arguments[0]), 0..=1);
            }
            Node::Apply { .. } => add(e, -2..=2),
            Node::Power { base, exponent } if g.as_integer(*exponent).is_none() => {
                add(e, -1..=1);
                add(*base, -1..=2);
            }
            Node::Power { base, exponent } if g.as_integer(*exponent).is_some_and(|n| n < 0) => {
                add(*base, -3..=1);
            }
            _ => {}
        }
    }
    for &argument in &unknown.arguments {
        add(argument, POWERS);
    }
    all
}
