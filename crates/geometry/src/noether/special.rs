//! Special values of parameters at which a family contains more integrals.

mod put_in;

pub use put_in::PutIn;

use super::automatic::{grown, members, quotients, waves, words};
use super::conjugate;
use super::family::Family;
use super::letters::{Letters, Polar};
use super::motion::Motion;
use super::occurring::congruent;
use super::parallel::in_parallel;
use super::search::{Integral, Table, Vector};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{Characteristics, Context, Manifold};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::number::prime_field::Residue;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::zero::points::{Draw, Points};
use chetaev_symbolic::{Expr, Graph, Node, Rational, Symbol, Verdict};

/// Special values of parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Tie {
    /// A parameter equals another one.
    Equal(Symbol, Symbol),
    /// A parameter is zero.
    Zero(Symbol),
    /// Parameters have these values.
    Values(Vec<(Symbol, Rational)>),
    /// A parameter is a sum of products of powers of others.
    Is(Symbol, Vec<Term>),
    /// Both; neither contains what the other gives.
    Both(Box<Tie>, Box<Tie>),
}

/// A rational multiple of a product of powers of parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// The factor.
    pub coefficient: Rational,
    /// Parameters with their exponents.
    pub powers: Vec<(Symbol, i8)>,
}

impl Term {
    fn expression(&self, g: &Graph) -> Expr {
        let powers = self.powers.iter();
        let powers = powers.map(|&(s, e)| g.powi(g.symbol_expr(s), i64::from(e)));
        let factors: Vec<Expr> = powers.chain([g.number(self.coefficient.clone())]).collect();
        g.mul(&factors)
    }

    fn value(&self, points: &Points, draw: &Draw) -> Option<Residue> {
        let field = &draw.field;
        let mut product = field.from_rational(&self.coefficient)?;
        for &(s, e) in &self.powers {
            let power = field.pow(points.value(draw, s)?, u64::from(e.unsigned_abs()));
            let power = if e < 0 { field.inv(power)? } else { power };
            product = field.mul(product, power);
        }
        Some(product)
    }
}

impl Tie {
    /// The parameters with what they are.
    pub fn pairs(&self, g: &Graph) -> Vec<(Expr, Expr)> {
        match self {
            Tie::Equal(parameter, other) => {
                vec![(g.symbol_expr(*parameter), g.symbol_expr(*other))]
            }
            Tie::Zero(parameter) => vec![(g.symbol_expr(*parameter), g.zero())],
            Tie::Values(values) => values
                .iter()
                .map(|(s, value)| (g.symbol_expr(*s), g.number(value.clone())))
                .collect(),
            Tie::Is(parameter, terms) => {
                let terms: Vec<Expr> = terms.iter().map(|t| t.expression(g)).collect();
                vec![(g.symbol_expr(*parameter), g.add(&terms))]
            }
            Tie::Both(a, b) => [a.pairs(g), b.pairs(g)].concat(),
        }
    }
}

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
            match leaves_no_motion(cx, tie) || !put_in::has_motions(cx, tie) {
                true => missed.push(tie.clone()),
                false => found.push(Special {
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

/// Whether the mass matrix on admissible velocities is singular at a special value: the accelerations for all others say nothing there.
fn leaves_no_motion(cx: &Context<'_>, tie: &Tie) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let chart = Characteristics::independent_velocities(system, cx.terms, cx.selection);
    let Ok(chart) = chart else {
        return false;
    };
    let pairs = tie.pairs(g);
    let symbols: Vec<Symbol> = pairs.iter().filter_map(|&(s, _)| g.as_symbol(s)).collect();
    let mut mass = congruent(system, &cx.terms.mass_matrix, &chart.basis);
    if !g.any_contains_any(&mass.concat(), &symbols) {
        return false;
    }
    for entry in mass.iter_mut().flatten() {
        *entry = g.substitute(*entry, &pairs);
    }
    let det = determinant(g, &mass);
    let verdict = cx.prover.identity(system, &[det], &chart.manifold, "");
    matches!(verdict, Verdict::Proved(_))
}

/// The most special values that are looked at one by one.
const TIES: usize = 36;

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
    let (mut found, mut missed) = at.unwrap_or_default();
    let mut left_out = missed.clone();
    // Where the mass matrix is singular there are no motions to speak of.
    missed.retain(|tie| !leaves_no_motion(cx, tie));
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

/// Whether what the model assumes of parameters alone does not exclude a special value, all others as the model states them; of those
/// without values the assumptions tell the signs.
fn is_admitted(cx: &Context<'_>, tie: &Tie) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let (values, pairs) = (system.parameter_values(), tie.pairs(g));
    system.assumptions.iter().enumerate().all(|(i, a)| {
        // The others hold for what is put in too: M = -m is excluded where both are positive.
        let mut others = system.clone();
        others.assumptions.remove(i);
        for a in &mut others.assumptions {
            (a.left, a.right) = (g.substitute(a.left, &pairs), g.substitute(a.right, &pairs));
        }
        let tied = g.substitute(g.sub(a.right, a.left), &pairs);
        let Ok(found) = g.evaluate_f64(&[g.substitute(tied, &values)], &|_| None) else {
            let sign = known_sign(g, tied, &assumptions(&others));
            return match a.relation {
                Relation::NotEqual => true,
                Relation::Less => !sign.is_nonpositive(),
                Relation::LessOrEqual => !(sign.is_nonpositive() && sign.is_nonzero()),
            };
        };
        let difference = found.first().copied().unwrap_or(f64::NAN);
        match a.relation {
            Relation::NotEqual => difference != 0.0,
            Relation::Less => difference > 0.0,
            Relation::LessOrEqual => difference >= 0.0,
        }
    })
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

/// The special values that are looked at, those that the model states first, and whether these are all.
fn ties(cx: &Context<'_>, parameters: &[Symbol]) -> (Vec<Tie>, bool) {
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
    ties.retain(|tie| is_stated(cx, tie) || is_admitted(cx, tie));
    ties.retain(|tie| !leaves_no_motion(cx, tie));
    ties.sort_by_key(|tie| !is_stated(cx, tie));
    let all = ties.len() <= TIES;
    ties.truncate(TIES);
    (ties, all)
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
        Tie::Both(a, b) => is_stated(cx, a) && is_stated(cx, b),
        Tie::Is(parameter, _) => {
            let (system, g) = (cx.system, &cx.system.graph);
            let pairs = tie.pairs(g);
            let value = g.substitute(pairs[0].1, &system.parameter_values());
            stated(cx, *parameter).is_some_and(|own| g.as_number(value) == Some(&own))
        }
    }
}

/// Whether the model assumes something of a parameter, by which it may not vanish.
fn is_assumed(cx: &Context<'_>, parameter: Expr) -> bool {
    let assumptions = cx.system.assumptions.iter();
    let mut sides = assumptions.flat_map(|a| [a.left, a.right]);
    sides.any(|side| side == parameter)
}
