//! Special values of parameters, and which of them are looked at.

use crate::noether::occurring::congruent;
use chetaev_mechanics::prover::{assumptions, Exceptional, Prover};
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{Characteristics, Context};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::number::prime_field::Residue;
use chetaev_symbolic::zero::known_sign;
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

    pub(super) fn value(&self, points: &Points, draw: &Draw) -> Option<Residue> {
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

/// The most special values that are looked at one by one.
const TIES: usize = 36;

/// The special values that are looked at, those that the model states first, and whether these are all.
pub(super) fn ties(cx: &Context<'_>, parameters: &[Symbol]) -> (Vec<Tie>, bool) {
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
    // No more are asked than are looked at: the pairs of n parameters are n².
    let moving = ties.into_iter().filter(|tie| !leaves_no_motion(cx, tie));
    let mut ties: Vec<Tie> = moving.take(TIES + 1).collect();
    let all = ties.len() <= TIES;
    ties.truncate(TIES);
    (ties, all)
}

/// The value that the model states for a parameter, where it is rational.
pub(super) fn stated(cx: &Context<'_>, symbol: Symbol) -> Option<Rational> {
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

/// Whether what the model assumes of parameters alone does not exclude a special value, all others as the model states them; of those
/// without values the assumptions tell the signs.
pub(super) fn is_admitted(cx: &Context<'_>, tie: &Tie) -> bool {
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

/// Whether the mass matrix on admissible velocities is singular at a special value: the accelerations for all others say nothing there.
pub(super) fn leaves_no_motion(cx: &Context<'_>, tie: &Tie) -> bool {
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
    // What is exceptional among these values is so for no claim.
    let prover = Prover {
        exceptional: Exceptional::default(),
        ..cx.prover.clone()
    };
    // At a point of a prime field it is seen at once where it is regular.
    let rank = prover.rank(system, &mass, &chart.manifold);
    if rank.is_ok_and(|rank| rank.minimum == mass.len()) {
        return false;
    }
    let det = determinant(g, &mass);
    let verdict = prover.identity(system, &[det], &chart.manifold, "");
    matches!(verdict, Verdict::Proved(_))
}
