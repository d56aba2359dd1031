//! The first integrals of a system in the families that are chosen for it, computed once for all claims about them.

use super::automatic::{allowed, families, grown};
use super::dependence::Dependent;
use super::eigenfunctions::eigenfunctions;
use super::embedded::Embedded;
use super::family::{Family, Member};
use super::killing::solutions;
use super::letters::{Letters, ENERGY, FIXED};
use super::motion::Motion;
use super::powers::products;
use super::search::{Integral, Table};
use super::shorter::shorter;
use super::shown::{on_constraints, readable, shortest, with_power, without_constant_factor};
use super::special::{special, Specials};
use super::written::in_quasi_velocities;
use chetaev_integrals::factors::factors;
use chetaev_mechanics::Context;
use chetaev_symbolic::number::prime_field::Residue;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Node, Verdict};
use std::sync::Arc;

/// A family that was searched, and what was found there.
#[derive(Clone, Debug)]
pub struct Searched {
    /// Its members, and what it consists of in words.
    pub family: Family,
    /// Members that are combinations of others on the constraint manifold.
    pub relations: usize,
    /// The dimension of the space of its first integrals, constants not counted.
    pub dimension: usize,
    /// log2 of a bound on the probability that the dimension is larger.
    pub error_bound_log2: f64,
    /// At how many draws of primes and parameters the relations were looked at.
    pub draws: u32,
}

/// What the search found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The families, each exhausted.
    pub families: Vec<Searched>,
    /// The generalized momenta ψ^i p_i that were searched, where these were not too many; those with functions that the model states for
    /// the search stand last.
    pub momenta: Vec<Momenta>,
    /// The functions of whose powers products were searched; none where these were too many.
    pub powers: Vec<Expr>,
    /// Where Darboux polynomials were searched for these products, in words; nothing where they were not.
    pub darboux: Option<String>,
    /// The functions of whose combinations exponentials are factors of these products.
    pub exponents: Vec<Expr>,
    /// The degree in coordinates and velocities up to which functions times exponentials of the time were searched; 0 for none.
    pub exponentials: u8,
    /// Functionally independent first integrals, each proved.
    pub integrals: Vec<Integral>,
    /// Further integrals that are functions of `integrals`, linearly independent ones; products by the places of their factors in
    /// `integrals`.
    pub dependent: Dependent,
    /// Whether the energy is kept and stands for itself among none of them, being a function of these.
    pub energy_depends: bool,
    /// What there is more of at special values of the parameters.
    pub special: Specials,
    /// Independent integrals modulo p that could not be lifted or proved.
    pub open: usize,
}

/// Generalized momenta: fields along which the Killing-type equations were solved without a gauge.
#[derive(Clone, Debug)]
pub struct Momenta {
    /// The functions of (t, q) of which ψ^i are combinations: products of the letters of the coefficients.
    pub functions: Vec<Expr>,
    /// Their weight at most.
    pub weight: u32,
    /// How many there are.
    pub dimension: usize,
}

/// A combination of members, with its leading one last.
struct Candidate<'f> {
    family: &'f Family,
    vector: Vec<(usize, Residue)>,
    /// Whether it contains the time, then its degree in the velocities; a known function goes before others
    /// of its degree, and what contains neither roots nor reciprocals before what does.
    order: (bool, u32, bool, u8, usize),
    /// Whether no member is of higher degree in the velocities than one.
    is_linear: bool,
    name: Option<String>,
}

/// What the search finds for the context's system; a sentence where it cannot be made.
pub fn found(cx: &Context<'_>) -> Arc<Result<Found, String>> {
    cx.shared(|cx| search(cx))
}

/// The same, where some claim has asked for it already.
pub fn if_searched(cx: &Context<'_>) -> Option<Arc<Result<Found, String>>> {
    cx.of_motions().known::<Result<Found, String>>()
}

fn search(cx: &Context<'_>) -> Result<Found, String> {
    if cx.is_out_of_time() {
        return Err("the time for claims was spent before the search".into());
    }
    let motion = Motion::of(cx)?;
    let letters = Letters::of(cx);
    // Functions of the model's own may leave no points over a prime field: what is found without them is not lost.
    let usual = letters.without_stated();
    in_letters(cx, &motion, &letters)
        .or_else(|_| in_letters(cx, &motion, &usual))
        .or_else(|_| in_letters(cx, &motion, &usual.without_roots(cx.system)))
}

fn in_letters(cx: &Context<'_>, motion: &Motion<'_>, letters: &Letters) -> Result<Found, String> {
    let letters = &letters.without_zeros(motion, cx.prover.points_seed())?;
    let families = families(cx, letters);
    let table = Table::new(motion, &letters.all(), cx.prover.points_seed())?;
    let (searched, candidates) = candidates(cx, &table, letters, &families)?;
    let (mut integrals, dependent, open) = chosen(cx, motion, &table, &candidates);
    kept_by_constraints(cx, motion, &mut integrals);
    let is_energy = |name: Option<&str>| name == Some(ENERGY);
    let energy_depends = candidates.iter().any(|c| is_energy(c.name.as_deref()))
        && !integrals.iter().any(|i| is_energy(i.name.as_deref()));
    let usual = letters.usual_only();
    let mut all_momenta: Vec<Momenta> = Vec::new();
    all_momenta.extend(momenta(cx, motion, &usual, &mut integrals));
    if !letters.stated.is_empty() {
        all_momenta.extend(momenta(cx, motion, letters, &mut integrals));
    }
    // Where the integrals cannot be told apart over prime fields nothing is said of special values.
    let special = special(cx, motion, &usual, &integrals).unwrap_or_default();
    let (powers, exponents) = add_products(cx, motion, &usual, &mut integrals);
    let exponentials = add_eigenfunctions(cx, motion, &usual, &mut integrals);
    Ok(Found {
        families: searched,
        momenta: all_momenta,
        powers,
        darboux: factors(cx, motion).exhausted(&cx.system.graph),
        exponents,
        exponentials,
        integrals,
        special,
        dependent,
        energy_depends,
        open,
    })
}

/// Each family exhausted, and what was found in all of them with the known integrals, the simplest first.
fn candidates<'f>(
    cx: &Context<'_>,
    table: &Table<'_>,
    letters: &Letters,
    families: &'f [Family],
) -> Result<(Vec<Searched>, Vec<Candidate<'f>>), String> {
    let mut candidates: Vec<Candidate<'f>> = Vec::new();
    let mut searched = Vec::new();
    let spaces = table.spaces(families)?;
    for (place, (family, space)) in families.iter().zip(spaces).enumerate() {
        searched.push(Searched {
            family: family.clone(),
            relations: space.relations.len(),
            dimension: space.integrals.len(),
            error_bound_log2: space.error_bound_log2,
            draws: space.draws,
        });
        for vector in space.integrals {
            let degrees = vector
                .iter()
                .map(|&(m, _)| letters.degree(&family.members[m]));
            let degree = degrees.max().unwrap_or(0);
            let timed = vector
                .iter()
                .any(|&(m, _)| letters.is_timed(cx.system, &family.members[m]));
            let awkward = vector
                .iter()
                .map(|&(m, _)| awkwardness(cx, family, &family.members[m]))
                .max()
                .unwrap_or(0);
            candidates.push(Candidate {
                is_linear: degree <= 1,
                order: (timed, degree, true, awkward, place),
                family,
                vector,
                name: None,
            });
        }
    }
    candidates.extend(known(table, letters, families));
    candidates.sort_by_key(|c| c.order);
    Ok((searched, candidates))
}

/// Functionally independent integrals in these families alone, and what integrable constraints keep, each proved.
///
/// # Errors
/// A sentence that says why they cannot be evaluated.
pub(super) fn in_families(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
    families: &[Family],
) -> Result<Vec<Integral>, String> {
    let table = Table::new(motion, &letters.all(), cx.prover.points_seed())?;
    let (_, candidates) = candidates(cx, &table, letters, families)?;
    let (mut integrals, ..) = chosen(cx, motion, &table, &candidates);
    kept_by_constraints(cx, motion, &mut integrals);
    Ok(integrals)
}

/// 2 for a member with reciprocals, 1 for one with roots.
fn awkwardness(cx: &Context<'_>, family: &Family, member: &Member) -> u8 {
    let g = &cx.system.graph;
    let is_root = |letter: usize| {
        let (_, exponent) = g.base_exponent(family.letters[letter].value);
        g.as_integer(exponent).is_none()
    };
    match member {
        _ if member.iter().any(|&(_, e)| e < 0) => 2,
        _ if member.iter().any(|&(letter, _)| is_root(letter)) => 1,
        _ => 0,
    }
}

/// Known functions that are integrals, as candidates.
fn known<'f>(table: &Table<'_>, letters: &Letters, families: &'f [Family]) -> Vec<Candidate<'f>> {
    let first = letters.velocities.len() + letters.coefficients.len();
    let mut found = Vec::new();
    for (i, (name, _)) in letters.known.iter().enumerate() {
        let member = vec![(first + i, 1)];
        let place = families.iter().find_map(|family| {
            let place = family.members.iter().position(|m| *m == member)?;
            Some((family, place))
        });
        let Some((family, place)) = place else {
            continue;
        };
        if let Some(one) = table.rate_vanishes(family, place) {
            let degree = match name.as_str() {
                ENERGY => 2,
                _ if name.starts_with(FIXED) => 0,
                _ => 1,
            };
            found.push(Candidate {
                family,
                vector: vec![(place, one)],
                order: (false, degree, false, 0, 0),
                is_linear: name != ENERGY,
                name: Some(name.clone()),
            });
        }
    }
    found
}

/// The claim that finds what integrable constraints keep.
const INTEGRABLE: &str = "model.constraints-integrable#weak";

/// Adds what integrable constraints keep, which need not be in a family: x y² z³ where the logarithms of its factors are combined.
fn kept_by_constraints(cx: &Context<'_>, motion: &Motion<'_>, integrals: &mut Vec<Integral>) {
    let kept = cx.finding(INTEGRABLE);
    for formula in &kept.formulas {
        let value = formula.right;
        if !is_new(cx, motion, integrals, value) {
            continue;
        }
        let rate = motion.derivatives(&[value]);
        let verdict = cx.prover.identity(
            cx.system,
            &rate,
            &motion.manifold,
            "on the constraint manifold",
        );
        if matches!(verdict, Verdict::Proved(_)) {
            integrals.push(Integral {
                value,
                shown: value,
                verdict,
                independent: true,
                name: None,
            });
        }
    }
}

/// Whether a function is independent of what holonomic constraints fix and of the integrals at hand.
fn is_new(cx: &Context<'_>, motion: &Motion<'_>, integrals: &[Integral], value: Expr) -> bool {
    let known: Vec<Expr> = integrals.iter().map(|i| i.value).collect();
    is_independent(cx, motion, &known, value).unwrap_or(false)
}

/// The same, of any functions; `None` where it cannot be told over a prime field.
pub(super) fn is_independent(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    known: &[Expr],
    value: Expr,
) -> Option<bool> {
    let all = [&cx.system.fixed_functions()[..], known, &[value]].concat();
    let kept = motion.independent_functions(&all, cx.prover.points_seed())?;
    Some(kept.contains(&(all.len() - 1)))
}

/// Whether a function of the state is one of the functions `known` on the constraints, so that it is constant where these are;
/// false also where that cannot be told.
pub fn is_function_of(cx: &Context<'_>, known: &[Expr], value: Expr) -> bool {
    let is_dependent =
        |motion: &Motion<'_>| is_independent(cx, motion, known, value) == Some(false);
    known.contains(&value) || Motion::of(cx).is_ok_and(|motion| is_dependent(&motion))
}

/// Adds products of powers that are no functions of the integrals found; the functions of which these are made, and those of whose
/// combinations exponentials are factors. They are told apart by
/// their logarithms, as powers with parameters as exponents have no values over a prime field.
fn add_products(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
    integrals: &mut Vec<Integral>,
) -> (Vec<Expr>, Vec<Expr>) {
    let Some((factors, found)) = products(cx, motion, letters) else {
        return (Vec::new(), Vec::new());
    };
    let mut known = integrals.clone();
    for product in found {
        if is_new(cx, motion, &known, product.logarithm) {
            known.push(Integral {
                value: product.logarithm,
                ..product.integral.clone()
            });
            let shown = shortest(cx, &product.integral);
            integrals.push(Integral {
                shown,
                ..product.integral
            });
        }
    }
    (factors.bases(), factors.exponents)
}

/// Adds functions times exponentials of the time that are no functions of the integrals found; up to which degree in coordinates and
/// velocities these were searched.
fn add_eigenfunctions(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
    integrals: &mut Vec<Integral>,
) -> u8 {
    let Some(all) = eigenfunctions(cx, motion, letters) else {
        return 0;
    };
    let mut known = integrals.clone();
    for own in all.found {
        if is_new(cx, motion, &known, own.rational) {
            known.push(Integral {
                value: own.rational,
                ..own.integral.clone()
            });
            integrals.push(without_constant_factor(cx, own.integral));
        }
    }
    if all.quadratic {
        2
    } else {
        1
    }
}

/// The most components of fields of generalized momenta, for the usual work.
const COMPONENTS: usize = 60;

/// Searches generalized momenta and adds those that are no functions of the integrals found. Their coefficients are the momenta, which
/// are in no family where they are long.
fn momenta(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
    integrals: &mut Vec<Integral>,
) -> Option<Momenta> {
    let n = Embedded::of(cx).ok()?;
    let most = allowed(cx, COMPONENTS) / n.k().max(1);
    let make = |weight| letters.functions(cx.system, weight);
    let (weight, functions) = grown(most, 0, make, Vec::len)?;
    let found = solutions(cx, &n, &functions, &[]).ok()?;
    for solution in &found {
        let is_new = is_new(cx, motion, integrals, solution.integral);
        if is_new && matches!(solution.verdict, Verdict::Proved(_)) {
            let short = readable(&cx.system.graph, solution.integral);
            let shown = in_quasi_velocities(cx, &[short]);
            let integral = Integral {
                value: solution.integral,
                shown: shown.first().copied().unwrap_or(short),
                verdict: solution.verdict.clone(),
                independent: true,
                name: None,
            };
            integrals.push(without_constant_factor(cx, integral));
        }
    }
    Some(Momenta {
        dimension: found.len(),
        weight,
        functions,
    })
}

/// Puts the energy in the place of the longest integral that is longer and a function of it and the others: a root of it, as it is
/// linear in the velocities where these have one direction, need not be what a person writes. Returns its place.
fn with_energy(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    table: &Table<'_>,
    candidates: &[Candidate<'_>],
    integrals: &mut [Integral],
) -> Option<usize> {
    let is_energy = |name: &Option<String>| name.as_deref() == Some(ENERGY);
    let energy = candidates.iter().find(|c| is_energy(&c.name));
    let energy = energy.filter(|_| !integrals.iter().any(|i| is_energy(&i.name)))?;
    let energy = table.proved(cx, energy.family, &energy.vector)?;
    let energy = Integral {
        shown: shortest(cx, &energy),
        name: Some(ENERGY.into()),
        ..energy
    };
    let g = &cx.system.graph;
    let size = |i: &Integral| length(g, i.shown);
    let is_root = |e: &Expr| match g.node(*e) {
        Node::Power { exponent, .. } => g.as_integer(*exponent).is_none(),
        _ => false,
    };
    // Linear ones without roots are worth more: the moments of a body on a sphere.
    let allowed = |i: &Integral| match g.reachable(&[i.shown]).iter().any(is_root) {
        true => size(&energy),
        false => 2 * size(&energy),
    };
    let longer = (0..integrals.len()).filter(|&i| size(&integrals[i]) > allowed(&integrals[i]));
    let mut longer: Vec<usize> = longer.filter(|&i| integrals[i].name.is_none()).collect();
    longer.sort_by_key(|&i| std::cmp::Reverse(size(&integrals[i])));
    for place in longer {
        let mut others = integrals.to_vec();
        others.remove(place);
        if is_new(cx, motion, &others, energy.value) {
            integrals[place] = energy;
            return Some(place);
        }
    }
    None
}

/// The functionally independent candidates, lifted and proved; how many depend on them, and how many stay open.
fn chosen(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    table: &Table<'_>,
    candidates: &[Candidate<'_>],
) -> (Vec<Integral>, Dependent, usize) {
    let vectors: Vec<(&Family, &[(usize, Residue)])> = candidates
        .iter()
        .map(|c| (c.family, &c.vector[..]))
        .collect();
    let independent = table.independent(&vectors).unwrap_or_default();
    let mut integrals = Vec::new();
    let mut linear: Vec<Integral> = Vec::new();
    // The places of integrals that are those of the family, up to factors and constants.
    let mut same: Vec<Option<usize>> = Vec::new();
    let mut open = 0;
    for &i in &independent {
        let candidate = &candidates[i];
        match table.proved(cx, candidate.family, &candidate.vector) {
            Some(integral) => {
                let integral = Integral {
                    shown: shortest(cx, &integral),
                    name: candidate.name.clone(),
                    ..integral
                };
                let integral = match integral.name.as_deref() {
                    Some(ENERGY) => integral,
                    _ => without_constant_factor(cx, integral),
                };
                let integral = match integral.name.is_none() {
                    true => on_constraints(cx, motion, integral),
                    false => integral,
                };
                if candidate.is_linear {
                    linear.push(integral.clone());
                }
                let value = integral.value;
                let integral = match integral.name.is_none() && !candidate.is_linear {
                    true => shorter(cx, motion, integral, &linear),
                    false => integral,
                };
                same.push((integral.value == value).then_some(integrals.len()));
                integrals.push(match integral.name.is_none() {
                    true => with_power(cx, motion, integral),
                    false => integral,
                });
            }
            None => {
                same.push(None);
                open += 1;
            }
        }
    }
    if let Some(replaced) = with_energy(cx, motion, table, candidates, &mut integrals) {
        for place in &mut same {
            *place = place.filter(|&i| i != replaced);
        }
    }
    let mut others = table.others(&vectors, &independent).unwrap_or_default();
    let products = others.products.into_iter();
    others.products = products
        .filter_map(|(i, j)| Some((same[i]?, same[j]?)))
        .collect();
    (integrals, others, open)
}
