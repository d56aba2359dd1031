//! Special values of parameters at which a family contains more integrals.

use super::family::Family;
use super::letters::Letters;
use super::motion::Motion;
use super::search::{Integral, Table};
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::number::prime_field::Residue;
use chetaev_symbolic::zero::points::{Draw, Points};
use chetaev_symbolic::{Expr, Graph, Rational, Symbol, Verdict};

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

    /// What a family has more of at special values of the parameters, each integral proved there.
    pub fn special(&self, cx: &Context<'_>, family: &Family, ties: &[Tie]) -> Vec<Special> {
        let Some((general, _)) = self.vectors(family) else {
            return Vec::new();
        };
        let mut found: Vec<Special> = Vec::new();
        for tie in ties {
            let Some((draw, mut random)) = self.draw(0) else {
                continue;
            };
            let Some(draw) = self.tied(&draw, tie) else {
                continue;
            };
            let Some((vectors, _)) = self.vectors_at(family, &draw, &mut random) else {
                continue;
            };
            if vectors.len() <= general.len() {
                continue;
            }
            let candidates: Vec<(&Family, &[(usize, Residue)])> =
                vectors.iter().map(|v| (family, &v[..])).collect();
            let independent = self.new_or_simpler(&draw, &candidates).unwrap_or_default();
            let integrals: Vec<Expr> = independent
                .iter()
                .filter_map(|&i| self.proved_on(cx, family, &vectors[i], tie))
                .collect();
            if !integrals.is_empty() {
                found.push(Special {
                    tie: tie.clone(),
                    integrals,
                });
            }
        }
        found
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
        let rate: Vec<Expr> = self
            .motion
            .derivatives(&[value])
            .into_iter()
            .map(replaced)
            .collect();
        let verdict = cx
            .prover
            .identity(system, &rate, &manifold, "at a special value");
        matches!(verdict, Verdict::Proved(_)).then(|| replaced(shown))
    }
}

/// The most members of a family that is searched at special values, and the most special values.
const SMALL: (usize, usize) = (130, 36);

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
    let ties = ties(cx, &parameters);
    let mut found = special_at(cx, table, letters, &parameters, &ties);
    let g = &cx.system.graph;
    let mut parameters = parameters;
    parameters.sort_by_key(|&s| g.symbol_name(s).to_owned());
    let (further, critical) = critical(cx, table, letters, &parameters, &ties);
    found.extend(further);
    Ok(Specials { found, critical })
}

/// What there is more of at special values.
#[derive(Clone, Debug, Default)]
pub struct Specials {
    /// The values that add something.
    pub found: Vec<Special>,
    /// The parameters of which all special values were looked for, and among how many functions.
    pub critical: (Vec<Symbol>, usize),
}

/// The most members of a family whose equations are looked at as functions of a parameter.
const CRITICAL: usize = 60;

/// The multiplications that are spent on it.
const WORK: u64 = 60_000_000;

/// Further integrals, quadratic in the velocities and free of the time, at special values of one parameter each.
fn critical(
    cx: &Context<'_>,
    table: &Table<'_>,
    letters: &Letters,
    parameters: &[Symbol],
    known: &[Tie],
) -> (Vec<Special>, (Vec<Symbol>, usize)) {
    let letters = letters.without_time(cx.system);
    let families = (0..=4).map(|weight| letters.polynomials(2, weight));
    let family = families
        .take_while(|family| family.members.len() <= CRITICAL)
        .last();
    let Some(family) = family else {
        return Default::default();
    };
    let (mut work, mut looked) = (WORK, Vec::new());
    let mut ties: Vec<Tie> = Vec::new();
    for &parameter in parameters {
        let others: Vec<Symbol> = parameters
            .iter()
            .copied()
            .filter(|&s| s != parameter)
            .collect();
        let Some(found) = table.critical(&family, parameter, &others, &mut work) else {
            continue;
        };
        looked.push(parameter);
        for tie in found {
            let tied = table.draw(0).and_then(|(draw, _)| table.tied(&draw, &tie));
            let is_known = |draw: &Draw| known.iter().chain(&ties).any(|t| table.holds(draw, t));
            if tied.is_some_and(|draw| !is_known(&draw)) && is_admitted(cx, &tie) {
                ties.push(tie);
            }
        }
    }
    let size = family.members.len() - 1;
    (table.special(cx, &family, &ties), (looked, size))
}

/// Whether what the model assumes of parameters alone does not exclude a special value, all others as the model states them.
fn is_admitted(cx: &Context<'_>, tie: &Tie) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let values = system.parameter_values();
    system.assumptions.iter().all(|a| {
        let tied = g.substitute(g.sub(a.right, a.left), &tie.pairs(g));
        let Ok(found) = g.evaluate_f64(&[g.substitute(tied, &values)], &|_| None) else {
            return true;
        };
        let difference = found.first().copied().unwrap_or(f64::NAN);
        match a.relation {
            Relation::NotEqual => difference != 0.0,
            Relation::Less => difference > 0.0,
            Relation::LessOrEqual => difference >= 0.0,
        }
    })
}

/// At the special values listed.
fn special_at(
    cx: &Context<'_>,
    table: &Table<'_>,
    letters: &Letters,
    parameters: &[Symbol],
    ties: &[Tie],
) -> Vec<Special> {
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
    let mut found = table.special(cx, &family, ties);
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
    ties.retain(|tie| is_stated(cx, tie) || is_admitted(cx, tie));
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
