//! Special values of parameters at which a family contains more integrals.

mod put_in;
mod ties;

pub use put_in::PutIn;
pub(crate) use ties::is_stated;
pub use ties::{Term, Tie};

use super::automatic::{grown, members, quotients, waves, words};
use super::conjugate;
use super::family::Family;
use super::letters::{Letters, Polar};
use super::motion::Motion;
use super::search::{Integral, Table, Vector};
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::number::prime_field::Residue;
use chetaev_symbolic::parallel::in_parallel;
use chetaev_symbolic::zero::points::Draw;
use chetaev_symbolic::{Expr, Node, Rational, Symbol, Verdict};
use ties::{is_admitted, stated, ties};

/// What a family has more of at a special value of a parameter.
#[derive(Clone, Debug)]
pub struct Special {
    /// The special value.
    pub tie: Tie,
    /// The further or simpler integrals, as they are shown, none of them a function of simpler ones and of those of no higher degree
    /// that exist for all values, as these are at the special value.
    pub integrals: Vec<Expr>,
}

impl Table<'_> {
    /// The draw with the values of parameters that a tie gives.
    pub(super) fn tied(&self, draw: &Draw, tie: &Tie) -> Option<Draw> {
        let mut tied = draw.clone();
        self.points.set(&mut tied, &self.values(draw, tie)?);
        Some(tied)
    }

    /// Whether the values of a draw are tied so.
    fn holds(&self, draw: &Draw, tie: &Tie) -> bool {
        let values = self.values(draw, tie).unwrap_or_default();
        let is_so = |&(s, value): &(Symbol, Residue)| self.points.value(draw, s) == Some(value);
        !values.is_empty() && values.iter().all(is_so)
    }

    /// What a tie makes of parameters in a draw.
    fn values(&self, draw: &Draw, tie: &Tie) -> Option<Vec<(Symbol, Residue)>> {
        Some(match tie {
            Tie::Equal(parameter, other) => vec![(*parameter, self.points.value(draw, *other)?)],
            Tie::Zero(parameter) => vec![(*parameter, Residue::ZERO)],
            Tie::Values(values) => values
                .iter()
                .map(|(s, value)| Some((*s, draw.field.from_rational(value)?)))
                .collect::<Option<Vec<_>>>()?,
            Tie::Is(parameter, terms) => {
                let mut sum = Residue::ZERO;
                for term in terms {
                    sum = draw.field.add(sum, term.value(&self.points, draw)?);
                }
                vec![(*parameter, sum)]
            }
            Tie::Both(a, b) => [self.values(draw, a)?, self.values(draw, b)?].concat(),
        })
    }

    /// The parameters that the motion contains as symbols of their own.
    pub fn free_parameters(&self) -> Vec<Symbol> {
        let g = &self.motion.system.graph;
        let symbols = self.parameters.iter().filter_map(|&e| g.as_symbol(e));
        let (draw, _) = match self.draw(0) {
            Some(draw) => draw,
            None => return Vec::new(),
        };
        symbols
            .filter(|&s| self.points.value(&draw, s).is_some())
            .collect()
    }

    /// What families have more of at special values of the parameters, each integral proved there, and at which of these they could not
    /// be looked at, as nothing has a value there.
    /// Beside two conditions at once those count too that add something by themselves and follow from both.
    pub fn special(
        &self,
        cx: &Context<'_>,
        families: &[Family],
        ties: &[Tie],
        adding: &[Tie],
    ) -> (Vec<Special>, Vec<Tie>) {
        let general = families.iter().map(|family| {
            let (vectors, relations) = self.vectors(family)?;
            Some((vectors.len(), relations.len()))
        });
        let Some(general) = general.collect::<Option<Vec<(usize, usize)>>>() else {
            return (Vec::new(), ties.to_vec());
        };
        let mut found: Vec<Special> = Vec::new();
        let mut missed = Vec::new();
        let inside = self.inside_functions();
        let at = in_parallel(ties.len(), |i| {
            let each = families.iter();
            let each = each.map(|family| self.vectors_on(family, &ties[i], &inside));
            each.collect::<Option<Vec<_>>>()
        });
        for (tie, at) in ties.iter().zip(at) {
            let Some(at) = at else {
                missed.push(tie.clone());
                continue;
            };
            let mut candidates: Vec<(&Family, &[(usize, Residue)])> = Vec::new();
            for ((family, (draw, vectors, relations)), &(general, related)) in
                families.iter().zip(&at).zip(&general)
            {
                // Where letters fall together there are fewer functions of them, and as many integrals may be others.
                let collapses = *relations > related && !matches!(tie, Tie::Both(..));
                if collapses || vectors.len() > self.without(family, draw, tie, (general, adding)) {
                    candidates.extend(vectors.iter().map(|v| (family, &v[..])));
                }
            }
            let Some((draw, ..)) = at.first().filter(|_| !candidates.is_empty()) else {
                continue;
            };
            let independent = self.new_or_simpler(draw, &candidates).unwrap_or_default();
            let integrals: Vec<Expr> = independent
                .iter()
                .filter_map(|&i| self.proved_on(cx, candidates[i].0, candidates[i].1, tie))
                .collect();
            if integrals.is_empty() {
                continue;
            }
            match put_in::has_motions(cx, tie) {
                false => missed.push(tie.clone()),
                true => found.push(Special {
                    tie: tie.clone(),
                    integrals,
                }),
            }
        }
        (found, missed)
    }

    /// How many integrals of a family a special value has to exceed: those for all values, and those of each of two conditions.
    fn without(
        &self,
        family: &Family,
        draw: &Draw,
        tie: &Tie,
        (general, adding): (usize, &[Tie]),
    ) -> usize {
        let Tie::Both(first, second) = tie else {
            return general;
        };
        let follow = adding.iter().filter(|tie| self.holds(draw, tie));
        let all = follow.chain([&**first, &**second]);
        let alone = |tie: &Tie| self.dimension_at(family, tie).unwrap_or(usize::MAX);
        all.map(alone).max().unwrap_or(usize::MAX)
    }

    /// The integrals of a family at a special value, modulo the prime of the draw that is given too, and how many relations its members have there;
    /// `None` where it has no points.
    fn vectors_on(
        &self,
        family: &Family,
        tie: &Tie,
        inside: &[Expr],
    ) -> Option<(Draw, Vec<Vector>, usize)> {
        // Points where w is zero and sin(w t) is not are none.
        let pairs = tie.pairs(&self.motion.system.graph);
        if pairs.iter().any(|(s, _)| inside.contains(s)) {
            return None;
        }
        let (draw, mut random) = self.draw(0)?;
        let draw = self.tied(&draw, tie)?;
        let (vectors, relations) = self.vectors_at(family, &draw, &mut random)?;
        Some((draw, vectors, relations.len()))
    }

    /// The parameters in arguments of functions, which are letters of their own at points over prime fields.
    fn inside_functions(&self) -> Vec<Expr> {
        let g = &self.motion.system.graph;
        let mut all: Vec<Expr> = self.letters.iter().map(|l| l.value).collect();
        all.extend(&self.motion.accelerations);
        let arguments = g
            .reachable(&all)
            .into_iter()
            .filter_map(|e| match g.node(e) {
                Node::Apply { arguments, .. } => Some(arguments.to_vec()),
                Node::Power { exponent, .. } => Some(vec![*exponent]),
                _ => None,
            });
        let arguments: Vec<Expr> = arguments.flatten().collect();
        let own = self.parameters.iter().copied();
        let is_inside = |&e: &Expr| {
            let symbol = g.as_symbol(e);
            symbol.is_some_and(|s| g.any_contains_any(&arguments, &[s]))
        };
        own.filter(is_inside).collect()
    }

    /// How many integrals a family contains at a special value.
    fn dimension_at(&self, family: &Family, tie: &Tie) -> Option<usize> {
        let (draw, mut random) = self.draw(0)?;
        let (vectors, _) = self.vectors_at(family, &self.tied(&draw, tie)?, &mut random)?;
        Some(vectors.len())
    }

    /// An integral at a special value, lifted and proved there.
    fn proved_on(
        &self,
        cx: &Context<'_>,
        family: &Family,
        vector: &[(usize, Residue)],
        tie: &Tie,
    ) -> Option<Expr> {
        let (system, g) = (self.motion.system, &self.motion.system.graph);
        let (value, shown) = self.lifted_on(family, vector, Some(tie))?;
        let pairs = tie.pairs(g);
        let replaced = |e: Expr| g.substitute(e, &pairs);
        let manifold = &self.motion.manifold;
        let manifold = Manifold {
            solved: manifold
                .solved
                .iter()
                .map(|&(s, e)| (s, replaced(e)))
                .collect(),
            implicit: manifold
                .implicit
                .iter()
                .map(|&(f, s)| (replaced(f), s))
                .collect(),
        };
        let general = self.motion.derivatives(&[value]);
        let always = cx
            .prover
            .identity(system, &general, &self.motion.manifold, "");
        // What is kept for all values is none of this one.
        if matches!(always, Verdict::Proved(_)) {
            return None;
        }
        let rate: Vec<Expr> = general.into_iter().map(replaced).collect();
        let verdict = cx
            .prover
            .identity(system, &rate, &manifold, "at a special value");
        matches!(verdict, Verdict::Proved(_)).then(|| replaced(shown))
    }
}

/// The multiplications that are spent on all of them in a family, and the least and the largest size of one.
const SPENT: usize = 200_000_000;
const SIZES: (usize, usize) = (130, 320);

/// The most quotients of velocities with coefficients at special values.
const QUOTIENTS: usize = 40;

/// Further integrals in small families where two parameters are equal, or one is zero that is not assumed otherwise, and for the
/// values that the model states.
/// They are told apart from the `integrals` for all values.
///
/// # Errors
/// A sentence that says why they cannot be evaluated.
pub(super) fn special(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
    integrals: &[Integral],
) -> Result<Specials, String> {
    let known: Vec<Expr> = integrals.iter().map(|i| i.value).collect();
    let table = &Table::beside(motion, &letters.all(), cx.prover.points_seed(), &known)?;
    let parameters = table.free_parameters();
    if parameters.is_empty() {
        return Ok(Specials {
            looked: Looked::Nothing,
            ..Specials::default()
        });
    }
    let (mut ties, all) = ties(cx, &parameters);
    let own = families_at(cx, letters, ties.len());
    let at = special_at(cx, table, &own, &parameters, &ties);
    let words = at.iter().flat_map(|_| own.iter().map(in_words)).collect();
    let is_made = at.is_some();
    let (mut found, missed) = at.unwrap_or_default();
    let mut left_out = missed.clone();
    let (own, put_in, missed) = put_in::put_in(cx, missed, integrals, ties.len());
    found.extend(own);
    let looked = match (is_made, all && left_out.is_empty()) {
        (false, _) => Looked::Not,
        (true, true) => Looked::All,
        (true, false) => {
            ties.retain(|tie| !left_out.contains(tie));
            left_out.retain(|tie| !put_in.iter().any(|own| own.tie == *tie));
            Looked::Some {
                others: !all || !left_out.is_empty(),
                ties: ties.clone(),
            }
        }
    };
    let g = &cx.system.graph;
    let mut parameters = parameters;
    parameters.sort_by_key(|&s| g.symbol_name(s).to_owned());
    let plain = letters.without_roots(cx.system);
    let without_roots = match table.are_rational() {
        true => None,
        false => Table::new(motion, &plain.all(), cx.prover.points_seed()).ok(),
    };
    let looked_at = match &without_roots {
        Some(own) => (own, &plain),
        None => (table, letters),
    };
    let (further, critical) = critical(
        cx,
        table,
        letters,
        looked_at,
        &parameters,
        (&ties, &found),
        integrals,
    );
    // A relation that the values stated satisfy says more than these.
    if further.iter().any(|special| is_stated(cx, &special.tie)) {
        found.retain(|special| !matches!(special.tie, Tie::Values(_)));
    }
    found.extend(further);
    Ok(Specials {
        found,
        critical,
        looked,
        put_in,
        missed,
        families: words,
    })
}

/// What there is more of at special values.
#[derive(Clone, Debug, Default)]
pub struct Specials {
    /// The values that add something.
    pub found: Vec<Special>,
    /// Of what all simple special values were looked for.
    pub critical: Critical,
    /// Whether parameters that are equal or zero or as stated were looked at.
    pub looked: Looked,
    /// At which of these nothing has a value in the velocities chosen, so that the system with these values was searched by itself.
    pub put_in: Vec<PutIn>,
    /// At which of these that could not be done either.
    pub missed: Vec<Tie>,
    /// The families that were looked at there, in words.
    pub families: Vec<String>,
}

/// Which special values of parameters were looked at.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Looked {
    /// None, as the families are too large for it, or have no points over prime fields.
    #[default]
    Not,
    /// The motion contains no parameters.
    Nothing,
    /// Some of those where two parameters are equal or one is zero.
    Some {
        /// These, beside those that were put into the system.
        ties: Vec<Tie>,
        /// Whether there are others.
        others: bool,
    },
    /// All of those.
    All,
}

/// What the search for all simple special values was made for.
#[derive(Clone, Debug, Default)]
pub struct Critical {
    /// The parameters whose values were looked for, one at a time.
    pub parameters: Vec<Symbol>,
    /// Whether those were too that need the equality of two further parameters.
    pub equal: bool,
    /// Among which functions integrals were searched, in words.
    pub words: String,
}

/// The most members of a family whose equations are looked at as functions of a parameter.
const CRITICAL: usize = 60;

/// The multiplications that are spent on it.
const WORK: u64 = 60_000_000;

/// The family whose equations are looked at as functions of a parameter: free of the time, of degree two in the velocities, and its weight.
fn critical_family(cx: &Context<'_>, letters: &Letters) -> Option<(u32, Family)> {
    let letters = letters.without_time(cx.system);
    let families = (0..=4).map(|weight| (weight, letters.polynomials(2, weight)));
    let (weight, mut family) = families
        .take_while(|(_, family)| family.members.len() <= CRITICAL)
        .last()?;
    family.words = words(cx, &letters, (2, 1), weight);
    Some((weight, family))
}

/// Further integrals, quadratic in the velocities and free of the time, at special values of one parameter each. The values are found with
/// letters that have no roots, and a table of these.
fn critical(
    cx: &Context<'_>,
    table: &Table<'_>,
    letters: &Letters,
    (rational, plain): (&Table<'_>, &Letters),
    parameters: &[Symbol],
    (known, at): (&[Tie], &[Special]),
    integrals: &[Integral],
) -> (Vec<Special>, Critical) {
    let Some((_, family)) = critical_family(cx, plain) else {
        return Default::default();
    };
    let mut search = CriticalSearch {
        cx,
        table: rational,
        family: &family,
        parameters,
        work: WORK,
        known: known.to_vec(),
        ties: Vec::new(),
    };
    let mut looked = parameters.to_vec();
    let (inside, g) = (rational.inside_functions(), &cx.system.graph);
    looked.retain(|&parameter| {
        !inside.contains(&g.symbol_expr(parameter)) && search.looked_at(None, parameter)
    });
    let mut families = vec![family.clone()];
    if plain.velocities.len() > 1 {
        families.extend(quotients(cx, plain, CRITICAL));
    }
    // Quotients may be kept where no polynomial is, as where two velocities fade alike.
    if let [_, quotients] = &families[..] {
        search.family = quotients;
        looked.retain(|&parameter| search.looked_at(None, parameter));
        search.family = &family;
    }
    // With roots among the letters more may be found than that for which the values were looked for.
    let searched = match table.are_rational() {
        true => families.clone(),
        false => families_at(cx, letters, known.len()),
    };
    let (mut found, missed) = table.special(cx, &searched, &search.ties, &[]);
    let (own, ..) = put_in::put_in(cx, missed, integrals, search.ties.len());
    found.extend(own);
    // Two conditions at once: an equality that adds nothing by itself, and a value of another parameter.
    let alone = search.ties.len();
    let mut pairs: Vec<Tie> = known.to_vec();
    pairs.retain(|tie| matches!(tie, Tie::Equal(..)) && !at.iter().any(|s| s.tie == *tie));
    let all = pairs.iter().all(|pair| search.looked_beside(pair));
    let adding: Vec<Tie> = at.iter().chain(&found).map(|s| s.tie.clone()).collect();
    found.extend(
        table
            .special(cx, &searched, &search.ties[alone..], &adding)
            .0,
    );
    let critical = Critical {
        equal: all && !pairs.is_empty() && parameters.len() > 2,
        words: families
            .iter()
            .map(in_words)
            .collect::<Vec<String>>()
            .join(", "),
        parameters: looked,
    };
    (found, critical)
}

/// A search for special values of one parameter each.
struct CriticalSearch<'s, 'a> {
    cx: &'s Context<'a>,
    table: &'s Table<'s>,
    family: &'s Family,
    parameters: &'s [Symbol],
    /// The multiplications that are left.
    work: u64,
    known: Vec<Tie>,
    /// What was found.
    ties: Vec<Tie>,
}

impl CriticalSearch<'_, '_> {
    /// Looks at all parameters that do not occur in an equality while this holds; whether the work sufficed.
    fn looked_beside(&mut self, pair: &Tie) -> bool {
        let Tie::Equal(a, b) = pair else {
            return true;
        };
        let others = self.parameters.iter().filter(|s| ![a, b].contains(s));
        others
            .into_iter()
            .all(|&parameter| self.looked_at(Some(pair), parameter))
    }

    /// Looks at one parameter, while a tie holds; whether the work sufficed.
    fn looked_at(&mut self, first: Option<&Tie>, parameter: Symbol) -> bool {
        let tied = |s: Symbol| matches!(first, Some(Tie::Equal(a, _)) if *a == s);
        let others = self.parameters.iter().copied();
        let others: Vec<Symbol> = others.filter(|&s| s != parameter && !tied(s)).collect();
        let table = self.table;
        let Some(found) = table.critical(self.family, first, parameter, &others, &mut self.work)
        else {
            return false;
        };
        for tie in found {
            let tie = match first {
                Some(first) => Tie::Both(Box::new(first.clone()), Box::new(tie)),
                None => tie,
            };
            let draw = table.draw(0).and_then(|(draw, _)| table.tied(&draw, &tie));
            // What adds nothing by itself may add something beside an equality: there only pairs count as known.
            let counts = |t: &&Tie| first.is_none() || matches!(t, Tie::Both(..));
            let mut known = self.known.iter().chain(&self.ties).filter(counts);
            let is_new = draw.is_some_and(|draw| !known.any(|t| table.holds(&draw, t)));
            if is_new && is_admitted(self.cx, &tie) {
                self.ties.push(tie);
            }
        }
        true
    }
}

/// A family with its size.
fn in_words(family: &Family) -> String {
    format!("{} ({} functions)", family.words, family.members.len() - 1)
}

/// The families for so many special values: polynomials of degree two in the velocities as large as the work allows, quotients, and those
/// with multiples of a polar angle; none where the smallest is too large.
fn families_at(cx: &Context<'_>, letters: &Letters, ties: usize) -> Vec<Family> {
    let most = (SPENT as f64 / (ties + 1) as f64).cbrt() as usize;
    let most = most.clamp(SIZES.0, SIZES.1);
    let make = |weight| letters.polynomials(2, weight);
    let (mut all, weight) = match grown(most, 0, make, members) {
        Some((weight, mut family)) => {
            family.words = words(cx, letters, (2, 1), weight);
            (vec![family], Some(weight))
        }
        None => {
            let mut family = letters.polynomials(1, 0);
            family.words = words(cx, letters, (1, 1), 0);
            (vec![family], None)
        }
    };
    if weight.is_none() && members(&all[0]) > SIZES.0 {
        return Vec::new();
    }
    let heavier = critical_family(cx, letters);
    all.extend(
        heavier
            .filter(|(own, _)| Some(*own) > weight)
            .map(|(_, family)| family),
    );
    if letters.velocities.len() > 1 {
        all.extend(quotients(cx, letters, QUOTIENTS));
    }
    // The sine and the cosine of the angle, without those of its double.
    let polar = letters.polar.iter().map(|polar| Polar {
        places: polar.places.iter().copied().take(2).collect(),
        ..polar.clone()
    });
    all.extend(polar.map(|polar| waves(cx, letters, &polar, most)));
    all.extend(conjugate::families(cx, letters));
    all.retain(|family| family.members.len() <= SIZES.1);
    all
}

/// At the special values listed; `None` where no family is small enough for it, or nothing is to be looked at.
fn special_at(
    cx: &Context<'_>,
    table: &Table<'_>,
    families: &[Family],
    parameters: &[Symbol],
    ties: &[Tie],
) -> Option<(Vec<Special>, Vec<Tie>)> {
    let values: Vec<(Symbol, Rational)> = parameters
        .iter()
        .filter_map(|&s| Some((s, stated(cx, s)?)))
        .collect();
    if families.is_empty() || (ties.is_empty() && values.is_empty()) {
        return None;
    }
    let (mut found, mut missed) = table.special(cx, families, ties, &[]);
    let seen = found.iter().any(|special| is_stated(cx, &special.tie));
    if !seen && !values.is_empty() {
        let (own, left_out) = table.special(cx, families, &[Tie::Values(values.clone())], &[]);
        found.extend(
            own.into_iter()
                .map(|special| with_fewest(cx, table, families, special, values.clone())),
        );
        missed.extend(left_out);
    }
    Some((found, missed))
}

/// Of more values none are tried to be left out.
const STATED: usize = 8;

/// The same with the fewest of the stated values that as many integrals need.
fn with_fewest(
    cx: &Context<'_>,
    table: &Table<'_>,
    families: &[Family],
    mut special: Special,
    mut values: Vec<(Symbol, Rational)>,
) -> Special {
    if values.len() > STATED {
        return special;
    }
    for place in (0..values.len()).rev() {
        let mut fewer = values.clone();
        fewer.remove(place);
        let (found, _) = table.special(cx, families, &[Tie::Values(fewer.clone())], &[]);
        let enough = |found: &Special| found.integrals.len() >= special.integrals.len();
        if let Some(found) = found.into_iter().find(enough) {
            (special, values) = (found, fewer);
        }
    }
    special
}
