//! The first integrals of a system in the families that are chosen for it, computed once for all claims about them.

use super::embedded::Embedded;
use super::family::{Family, Member};
use super::killing::solutions;
use super::motion::Motion;
use super::occurring::{Letters, ENERGY};
use super::search::{Integral, Special, Table, Tie};
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::number::prime_field::Residue;
use chetaev_symbolic::simplify::{length, simplify, Options};
use chetaev_symbolic::{Expr, Graph, Node, Rational, Symbol, Verdict};
use std::sync::Arc;

/// The most members of a family of degree one in the velocities, and of degree two for a system of up to four coordinates and for
/// a larger one.
const MEMBERS: [usize; 3] = [620, 400, 700];

/// Larger expressions, in nodes, are shown as they are.
const READABLE: usize = 90;

/// Families do not grow beyond this weight of the coefficients.
const WEIGHT: u32 = 6;

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
    /// The generalized momenta ψ^i p_i that were searched, where these were not too many.
    pub momenta: Option<Momenta>,
    /// Functionally independent first integrals, each proved.
    pub integrals: Vec<Integral>,
    /// Further integrals that are functions of `integrals`, linearly independent ones: products of two of these, and others.
    pub dependent: (usize, usize),
    /// What there is more of at special values of the parameters, in small families.
    pub special: Vec<Special>,
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
    /// Whether it contains the time, then the degree in the velocities of the leading member; a known function goes before others
    /// of its degree, and what contains neither roots nor reciprocals before what does.
    order: (bool, u32, bool, u8, usize),
    name: Option<String>,
}

/// What the search finds for the context's system; a sentence where it cannot be made.
pub fn found(cx: &Context<'_>) -> Arc<Result<Found, String>> {
    cx.shared(|cx| search(cx))
}

/// The same, where some claim has asked for it already.
pub fn if_searched(cx: &Context<'_>) -> Option<Arc<Result<Found, String>>> {
    cx.known::<Result<Found, String>>()
}

fn search(cx: &Context<'_>) -> Result<Found, String> {
    if cx.is_out_of_time() {
        return Err("the time for claims was spent before the search".into());
    }
    let motion = Motion::of(cx)?;
    let letters = Letters::of(cx);
    in_letters(cx, &motion, &letters)
        .or_else(|_| in_letters(cx, &motion, &letters.without_roots(cx.system)))
}

fn in_letters(cx: &Context<'_>, motion: &Motion<'_>, letters: &Letters) -> Result<Found, String> {
    let letters = &letters.without_zeros(motion, cx.prover.points_seed())?;
    let families = families(cx, letters);
    let table = Table::new(motion, &letters.all(), cx.prover.points_seed())?;
    let mut candidates: Vec<Candidate<'_>> = Vec::new();
    let mut searched = Vec::new();
    for (place, family) in families.iter().enumerate() {
        let space = table.space(family)?;
        searched.push(Searched {
            family: family.clone(),
            relations: space.relations.len(),
            dimension: space.integrals.len(),
            error_bound_log2: space.error_bound_log2,
            draws: space.draws,
        });
        for vector in space.integrals {
            let leading = vector.last().map_or(0, |&(member, _)| member);
            let degree = letters.degree(&family.members[leading]);
            let timed = vector
                .iter()
                .any(|&(m, _)| letters.is_timed(cx.system, &family.members[m]));
            let awkward = vector
                .iter()
                .map(|&(m, _)| awkwardness(cx, family, &family.members[m]))
                .max()
                .unwrap_or(0);
            candidates.push(Candidate {
                order: (timed, degree, true, awkward, place),
                family,
                vector,
                name: None,
            });
        }
    }
    candidates.extend(known(&table, letters, &families));
    candidates.sort_by_key(|c| c.order);
    let (mut integrals, dependent, open) = chosen(cx, &table, &candidates);
    let momenta = momenta(cx, motion, letters, &mut integrals);
    Ok(Found {
        families: searched,
        momenta,
        integrals,
        special: special(cx, &table, letters),
        dependent,
        open,
    })
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

/// The most members of a family that is searched at special values, and the most special values.
const SMALL: (usize, usize) = (130, 36);

/// Further integrals in small families where two parameters are equal, or one is zero that is not assumed otherwise, and for the
/// values that the model states.
fn special(cx: &Context<'_>, table: &Table<'_>, letters: &Letters) -> Vec<Special> {
    let family = [
        letters.polynomials(2, 1),
        letters.polynomials(2, 0),
        letters.polynomials(1, 0),
    ]
    .into_iter()
    .find(|family| family.members.len() <= SMALL.0);
    let Some(family) = family else {
        return Vec::new();
    };
    let parameters = table.free_parameters();
    let mut found = table.special(cx, &family, &ties(cx, &parameters));
    let values: Vec<(Symbol, Rational)> = parameters
        .iter()
        .filter_map(|&s| Some((s, stated(cx, s)?)))
        .collect();
    let seen = found.iter().any(|special| is_stated(cx, &special.tie));
    if !seen && !values.is_empty() {
        found.extend(table.special(cx, &family, &[Tie::Values(values)]));
    }
    found
}

/// The special values that are looked at, those that the model states first.
fn ties(cx: &Context<'_>, parameters: &[Symbol]) -> Vec<Tie> {
    let mut ties: Vec<Tie> = Vec::new();
    for (i, &parameter) in parameters.iter().enumerate() {
        let others = parameters[..i].iter();
        ties.extend(others.map(|&other| Tie::Equal(parameter, other)));
    }
    let g = &cx.system.graph;
    let zeros = parameters.iter().copied();
    ties.extend(zeros.map(Tie::Zero).filter(|tie| match tie {
        Tie::Zero(s) => is_stated(cx, tie) || !is_assumed(cx, g.symbol_expr(*s)),
        _ => true,
    }));
    ties.sort_by_key(|tie| !is_stated(cx, tie));
    ties.truncate(SMALL.1);
    ties
}

/// The value that the model states for a parameter, where it is rational.
fn stated(cx: &Context<'_>, symbol: Symbol) -> Option<Rational> {
    let (system, g) = (cx.system, &cx.system.graph);
    let name = g.symbol_name(symbol);
    let parameter = system.parameters.iter().find(|p| p.name == name)?;
    g.as_number(parameter.value?).cloned()
}

/// Whether parameters are tied so by the values that the model states.
pub(crate) fn is_stated(cx: &Context<'_>, tie: &Tie) -> bool {
    match tie {
        Tie::Equal(a, b) => stated(cx, *a).is_some_and(|value| stated(cx, *b) == Some(value)),
        Tie::Zero(s) => stated(cx, *s).is_some_and(|value| value == Rational::ZERO),
        Tie::Values(_) => true,
    }
}

/// Whether the model assumes something of a parameter, by which it may not vanish.
fn is_assumed(cx: &Context<'_>, parameter: Expr) -> bool {
    let assumptions = cx.system.assumptions.iter();
    let mut sides = assumptions.flat_map(|a| [a.left, a.right]);
    sides.any(|side| side == parameter)
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
            let degree = if name == ENERGY { 2 } else { 1 };
            found.push(Candidate {
                family,
                vector: vec![(place, one)],
                order: (false, degree, false, 0, 0),
                name: Some(name.clone()),
            });
        }
    }
    found
}

/// The most components of fields of generalized momenta.
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
    let most = COMPONENTS / n.k().max(1);
    let (weight, functions) = (0..=WEIGHT)
        .map(|weight| (weight, letters.functions(cx.system, weight)))
        .take_while(|(_, functions)| functions.len() <= most)
        .last()?;
    let found = solutions(cx, &n, &functions, &[]).ok()?;
    for solution in &found {
        let mut all: Vec<Expr> = cx.system.fixed_functions();
        all.extend(integrals.iter().map(|i| i.value));
        all.push(solution.integral);
        let is_new = motion
            .independent_functions(&all, cx.prover.points_seed())
            .is_some_and(|kept| kept.contains(&(all.len() - 1)));
        if is_new && matches!(solution.verdict, Verdict::Proved(_)) {
            let integral = Integral {
                value: solution.integral,
                shown: solution.integral,
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

/// The functionally independent candidates, lifted and proved; how many depend on them, and how many stay open.
fn chosen(
    cx: &Context<'_>,
    table: &Table<'_>,
    candidates: &[Candidate<'_>],
) -> (Vec<Integral>, (usize, usize), usize) {
    let vectors: Vec<(&Family, &[(usize, Residue)])> = candidates
        .iter()
        .map(|c| (c.family, &c.vector[..]))
        .collect();
    let independent = table.independent(&vectors).unwrap_or_default();
    let mut integrals = Vec::new();
    let mut open = 0;
    for &i in &independent {
        let candidate = &candidates[i];
        match table.proved(cx, candidate.family, &candidate.vector) {
            Some(integral) => {
                let integral = Integral {
                    shown: shortest(&cx.system.graph, &integral),
                    name: candidate.name.clone(),
                    ..integral
                };
                integrals.push(match integral.name.as_deref() {
                    Some(ENERGY) => integral,
                    _ => without_constant_factor(cx, integral),
                });
            }
            None => open += 1,
        }
    }
    let others = table.others(&vectors, &independent);
    (integrals, others.unwrap_or_default(), open)
}

/// Whether nothing but parameters occurs; what is shown may contain names of quasi-velocities.
pub(crate) fn is_constant(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    let is_parameter = |s: Symbol| system.parameters.iter().any(|p| p.name == g.symbol_name(s));
    g.symbols_in(&[e]).into_iter().all(is_parameter)
}

/// An integral in the letters of its family or in velocities, whichever is shorter: letters may be related.
fn shortest(g: &Graph, integral: &Integral) -> Expr {
    let [shown, value] = [integral.shown, integral.value].map(|e| readable(g, e));
    match length(g, value) < length(g, shown) {
        true => value,
        false => shown,
    }
}

/// The integral divided by what all its terms share and nothing moves, as (1 + a²)^(3/2).
fn without_constant_factor(cx: &Context<'_>, integral: Integral) -> Integral {
    let g = &cx.system.graph;
    let Node::Product {
        coefficient,
        factors,
    } = g.node(integral.shown)
    else {
        return without_first_minus(g, integral);
    };
    let constant = factors.iter().copied();
    let constant: Vec<Expr> = constant.filter(|&f| is_constant(cx.system, f)).collect();
    if constant.is_empty() && *coefficient == Rational::ONE {
        return without_first_minus(g, integral);
    }
    let by = g.mul(&[&[g.number(coefficient.clone())], &constant[..]].concat());
    let divided = Integral {
        value: g.div(integral.value, by),
        shown: g.div(integral.shown, by),
        name: None,
        ..integral
    };
    without_first_minus(g, divided)
}

/// The integral or its negative, whichever is not written with a minus in front.
fn without_first_minus(g: &Graph, integral: Integral) -> Integral {
    let negative = g.neg(integral.shown);
    let begins = |e: Expr| g.text(e).starts_with('-');
    match begins(integral.shown) && !begins(negative) {
        true => Integral {
            value: g.neg(integral.value),
            shown: negative,
            name: None,
            ..integral
        },
        false => integral,
    }
}

/// An expression as a person would write it, where that does not take long.
pub(crate) fn readable(g: &Graph, e: Expr) -> Expr {
    match g.reachable(&[e]).len() <= READABLE {
        true => simplify(g, e, &Options::default()),
        false => e,
    }
}

/// The largest families within the budget: polynomials of degree one and two in the velocities, and quotients.
fn families(cx: &Context<'_>, letters: &Letters) -> Vec<Family> {
    let mut families: Vec<Family> = [1, 2]
        .into_iter()
        .map(|degree| {
            let most = match (degree, cx.system.n()) {
                (1, _) => MEMBERS[0],
                (_, 0..=4) => MEMBERS[1],
                _ => MEMBERS[2],
            };
            let mut weight = 0;
            let mut largest = letters.polynomials(degree, 0);
            if largest.members.len() > 2 * most {
                return letters.known_only();
            }
            while weight < WEIGHT {
                let next = letters.polynomials(degree, weight + 1);
                if next.members.len() > most {
                    break;
                }
                weight += 1;
                largest = next;
            }
            largest.words = words(cx, letters, degree, weight);
            largest
        })
        .collect();
    families.extend(turned(cx, letters));
    if letters.velocities.len() > 1 {
        let mut quotients = letters.quotients();
        quotients.words = "quotients of two velocities".into();
        families.push(quotients);
    }
    families
}

/// Which powers of a letter are formed, where not all of them. A cosine stands with its first power only because of the sine.
fn powers((least, most): (i8, i8)) -> String {
    match (least, most) {
        (0, 1 | 9) => String::new(),
        (least, most) => format!(" to the powers {least} to {most}"),
    }
}

/// The family with sines and cosines of coordinates that may be angles.
fn turned(cx: &Context<'_>, letters: &Letters) -> Option<Family> {
    let g = &cx.system.graph;
    let families = (1..=WEIGHT).map_while(|weight| Some((weight, letters.turned(weight)?)));
    let (weight, mut family) = families
        .take_while(|(_, family)| family.members.len() <= MEMBERS[0])
        .last()?;
    let places = 0..letters.coefficients.len();
    let used = places.filter(|&i| letters.is_turned(i));
    let names: Vec<String> = used
        .map(|i| g.text(letters.coefficients[i].letter.shown))
        .collect();
    let velocities: Vec<String> = letters.velocities.iter().map(|l| g.text(l.shown)).collect();
    family.words = format!(
        "polynomials of degree up to 1 in the velocities {}, with products of up to {weight} of {} as coefficients",
        velocities.join(", "),
        names.join(", ")
    );
    Some(family)
}

fn words(cx: &Context<'_>, letters: &Letters, degree: u32, weight: u32) -> String {
    let g = &cx.system.graph;
    let list = |weight: u32| {
        let numbered = letters.coefficients.iter().enumerate();
        let own = numbered.filter(|(i, c)| {
            c.weight == weight
                && !letters.perhaps_turning.contains(i)
                && (degree == 1 || !letters.turning.contains(i))
        });
        own.map(|(_, c)| format!("{}{}", g.text(c.letter.shown), powers(c.exponents)))
            .collect::<Vec<String>>()
    };
    let velocities: Vec<String> = letters.velocities.iter().map(|l| g.text(l.shown)).collect();
    let weights: Vec<String> = (1..=3)
        .filter(|&w| !list(w).is_empty())
        .map(|w| format!("{} ({w} each)", list(w).join(", ")))
        .collect();
    let more = match degree {
        1 => "",
        _ => " in the quadratic terms and one more for each velocity less",
    };
    let known = match degree >= 2 && !letters.known.is_empty() {
        true => {
            let names: Vec<&str> = letters
                .known
                .iter()
                .map(|(name, _)| name.as_str())
                .collect();
            format!(", and {}", names.join(", "))
        }
        false => String::new(),
    };
    format!(
        "polynomials of degree up to {degree} in the velocities {}, with coefficients of weight up to {weight}{more}, built of {}{known}",
        velocities.join(", "),
        weights.join("; ")
    )
}
