//! The common zeros of functions that are polynomials in some symbols and in sines and cosines of these.
//!
//! They are a union of sets, each given by equations of which each determines one symbol by those before it, irreducible and without powers:
//! the zeros of `x² + y² − 1` and `x − 1` are those of `x − 1` and `y`. See [`triangular_systems`].

use crate::number::ball::Precision;
use crate::polynomial::normal_form::{
    normal_form, normal_forms, Field, Kind, NormalFormError, Options,
};
use crate::polynomial::{triangular_systems, Budget, Polynomial, TooLarge};
use crate::real_factors::zero_set;
use crate::zero::assumptions::Assumptions;
use crate::zero::known_sign;
use crate::zero::separation::vanishes;
use crate::{Expr, Graph, Node, Symbol};
use std::cell::RefCell;

/// A part of the common zeros.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Zeros {
    /// Functions that vanish, each with the symbol that it determines.
    pub equations: Vec<(Expr, Symbol)>,
    /// How many symbols they determine: the codimension. A sine and a cosine that are given determine one angle.
    pub codimension: usize,
}

/// Why common zeros are not known.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CommonZerosError {
    /// A function is no polynomial in the symbols and their sines and cosines.
    #[error("{what} is no polynomial")]
    NotPolynomial {
        /// What it contains.
        what: String,
    },
    /// A number that was divided by may be zero.
    #[error("whether {number} is zero was not decided")]
    Undecided {
        /// The number.
        number: String,
    },
    /// The functions are too large, or nowhere defined.
    #[error(transparent)]
    Form(#[from] NormalFormError),
    /// Their elimination is too large.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
}

/// Simpler functions are put in so often.
const DEPTH: usize = 8;

/// The parts of the common zeros that may have real points: a sum of squares vanishes where its terms do, and a part with an equation that has no
/// real zero, by its sign under what is known, has no points. Nothing where they are not found.
pub fn real_common_zeros(
    g: &Graph,
    functions: &[Expr],
    symbols: &[Symbol],
    (known, budget): (&Assumptions, Budget),
) -> Option<Vec<Zeros>> {
    let simpler = |&e: &Expr| zero_set(g, e, symbols, known).unwrap_or_else(|| vec![e]);
    let mut open: Vec<(Vec<Expr>, usize)> =
        vec![(functions.iter().flat_map(simpler).collect(), DEPTH)];
    let mut found = Vec::new();
    while let Some((functions, depth)) = open.pop() {
        let deeper = depth.checked_sub(1)?;
        for part in common_zeros(g, &functions, symbols, budget).ok()? {
            let own = || part.equations.iter().map(|(e, _)| *e);
            if own().any(|e| known_sign(g, e, known).is_nonzero()) {
                continue;
            }
            let simpler = own()
                .enumerate()
                .find_map(|(at, e)| Some((at, zero_set(g, e, symbols, known)?)));
            match simpler {
                None => found.push(part),
                Some((at, simpler)) => {
                    let others = own().enumerate().filter(|(other, _)| *other != at);
                    let all = others.map(|(_, e)| e).chain(simpler);
                    open.push((all.collect(), deeper));
                }
            }
        }
    }
    Some(found)
}

/// The common zeros of functions where these are defined; other symbols than the given ones are parameters in general position. Symbols
/// that stand last are determined first.
///
/// # Errors
/// [`CommonZerosError`].
///
/// ```
/// use chetaev_symbolic::{common_zeros::common_zeros, polynomial::Budget, Graph};
/// let g = Graph::new();
/// let (x, y) = (g.intern_symbol("x", 0), g.intern_symbol("y", 0));
/// let circle = g.sub(g.add(&[g.powi(g.symbol_expr(x), 2), g.powi(g.symbol_expr(y), 2)]), g.one());
/// let tangent = g.sub(g.symbol_expr(x), g.one());
/// let found = common_zeros(&g, &[circle, tangent], &[x, y], Budget::PROOF).unwrap();
/// assert_eq!(found[0].equations, [(tangent, x), (g.symbol_expr(y), y)]);
/// ```
pub fn common_zeros(
    g: &Graph,
    functions: &[Expr],
    symbols: &[Symbol],
    budget: Budget,
) -> Result<Vec<Zeros>, CommonZerosError> {
    let mut options = Options::proof(budget);
    options.base_angles = angles(g, functions, symbols);
    let (field, forms) = normal_forms(g, functions, &options)?;
    let mut vanishing: Vec<Polynomial> = forms.iter().map(|f| f.numerator().clone()).collect();
    let nonzero: Vec<Polynomial> = forms.iter().map(|f| f.denominator().clone()).collect();
    let relations = needed_relations(&field, &[&vanishing[..], &nonzero].concat())?;
    let order = order(&field, symbols, &vanishing)?;
    vanishing.extend(relations.iter().cloned());
    let generators: Vec<usize> = order.iter().map(|&(generator, _)| generator).collect();
    let numbers = Numbers::new(&field);
    let vanish = |p: &Polynomial| numbers.vanish(p);
    let found = triangular_systems(&vanishing, &nonzero, &generators, (&vanish, field.meter()))?;
    if let Some(number) = numbers.undecided() {
        return Err(CommonZerosError::Undecided { number });
    }
    let symbol_of = |generator: usize| {
        let mut own = order.iter().filter(|(own, _)| *own == generator);
        own.next().map(|(_, symbol)| *symbol)
    };
    let part = |equations: Vec<(usize, Polynomial)>| {
        let codimension = equations.len().saturating_sub(relations.len());
        let is_relation = |p: &Polynomial| relations.iter().any(|r| r == p || *r == p.neg());
        let own = equations.iter().filter(|(_, p)| !is_relation(p));
        let own = own.filter_map(|(generator, p)| {
            Some((field.polynomial_expression(p), symbol_of(*generator)?))
        });
        Zeros {
            equations: own.collect(),
            codimension,
        }
    };
    Ok(found.into_iter().map(|s| part(s.equations)).collect())
}

/// Polynomials in generators that stand for numbers, as √2, π and cos 1: which of them are zero. Generators are independent by their relations
/// only, and numbers need not be: cos(2π/7) + cos(4π/7) + cos(6π/7) = −1/2.
pub struct Numbers<'a, 'g> {
    field: &'a Field<'g>,
    undecided: RefCell<Option<String>>,
}

/// Bits of the enclosures of numbers that are no algebraic ones.
const BITS: usize = 512;
/// Bits of the first one.
const FEW_BITS: usize = 96;

impl<'a, 'g> Numbers<'a, 'g> {
    /// Of this field.
    pub fn new(field: &'a Field<'g>) -> Self {
        Numbers {
            field,
            undecided: RefCell::new(None),
        }
    }

    /// Whether a polynomial is zero; `None` where a symbol occurs in it. One of which that is not decided is kept.
    pub fn vanish(&self, p: &Polynomial) -> Option<bool> {
        let g = self.field.graph();
        let holds_symbol = |&at: &usize| {
            let own = self.field.generators()[at].expr;
            !g.symbols_in(&[own]).is_empty()
        };
        if p.generators().iter().any(holds_symbol) {
            return None;
        }
        let e = self.field.polynomial_expression(p);
        let is_apart = |bits: usize| {
            let found = g.enclose(&[e], &Precision::new(bits), &|_| None);
            found.is_ok_and(|found| found[0].excludes_zero())
        };
        // Most numbers are far from zero, which costs little to see.
        if g.as_number(e).is_some_and(|own| !own.is_zero()) || is_apart(FEW_BITS) {
            return Some(false);
        }
        // By its form, as sin² 1 + cos² 1 − 1, or else by its size.
        if normal_form(g, e, &Budget::PROOF).is_ok_and(|form| form.is_zero()) {
            return Some(true);
        }
        vanishes(g, e).or_else(|| {
            let is_apart = is_apart(BITS);
            if !is_apart {
                let mut undecided = self.undecided.borrow_mut();
                undecided.get_or_insert_with(|| g.text(e));
            }
            is_apart.then_some(false)
        })
    }

    /// A number of which was not decided whether it is zero.
    pub fn undecided(&self) -> Option<String> {
        self.undecided.borrow().clone()
    }
}

/// The symbols that stand inside of functions: their sines and cosines are unknowns.
pub fn angles(g: &Graph, es: &[Expr], symbols: &[Symbol]) -> Vec<Expr> {
    let is_function = |e: &Expr| matches!(g.node(*e), Node::Apply { .. });
    let functions: Vec<Expr> = g.reachable(es).into_iter().filter(is_function).collect();
    let occurring = symbols
        .iter()
        .filter(|&&s| g.any_contains_any(&functions, &[s]));
    occurring.map(|&s| g.symbol_expr(s)).collect()
}

/// The relations of all generators that occur in polynomials, and of those that occur in these relations; a sine always brings its cosine.
///
/// # Errors
/// [`TooLarge`] when they exceed the budget.
pub fn needed_relations(
    field: &Field<'_>,
    polynomials: &[Polynomial],
) -> Result<Vec<Polynomial>, TooLarge> {
    let all = field.relations()?;
    let mut kept: Vec<Polynomial> = Vec::new();
    loop {
        let occurs = |generator: usize| {
            let mut own = polynomials.iter().chain(&kept);
            own.any(|p| p.degree_in(generator) > 0)
        };
        let partner = |generator: usize| match field.generators()[generator].kind {
            Kind::Sine { partner } => occurs(partner),
            _ => false,
        };
        let next = all.iter().find(|(generator, p)| {
            !kept.contains(p) && (occurs(*generator) || partner(*generator))
        });
        match next {
            Some((_, p)) => kept.push(p.clone()),
            None => return Ok(kept),
        }
    }
}

/// The generators that stand for the symbols, in the order of these: each itself, or the cosine and the sine of a part of it.
fn order(
    field: &Field<'_>,
    symbols: &[Symbol],
    polynomials: &[Polynomial],
) -> Result<Vec<(usize, Symbol)>, CommonZerosError> {
    let g = field.graph();
    let occurs = |at: usize| polynomials.iter().any(|p| p.degree_in(at) > 0);
    let strange = |e: Expr| CommonZerosError::NotPolynomial { what: g.text(e) };
    let mut found: Vec<(usize, Symbol)> = Vec::new();
    for &symbol in symbols {
        let others = symbols.iter().copied().filter(|s| *s != symbol);
        let others: Vec<Symbol> = others.collect();
        let is_of = |e: Expr| g.contains_any(e, &[symbol]) && !g.contains_any(e, &others);
        let plain = field.generator_of(g.symbol_expr(symbol));
        let pairs = field.pythagoras().into_iter().filter(|p| p.circular);
        let pairs = pairs.filter(|p| field.argument_of(p.sine).is_some_and(is_of));
        let pairs: Vec<usize> = pairs.flat_map(|p| [p.cosine, p.sine]).collect();
        if let (Some(plain), true) = (plain, pairs.iter().any(|&at| occurs(at))) {
            // An angle and its sine are no polynomials in each other.
            if occurs(plain) {
                return Err(strange(field.generators()[pairs[1]].expr));
            }
        }
        let own = plain.into_iter().chain(pairs);
        found.extend(own.map(|generator| (generator, symbol)));
    }
    let is_known = |at: usize| found.iter().any(|(generator, _)| *generator == at);
    let mut generators = field.generators().iter().enumerate();
    let unknown = generators.find(|(at, own)| !is_known(*at) && g.contains_any(own.expr, symbols));
    match unknown {
        None => Ok(found),
        Some((_, own)) => Err(strange(own.expr)),
    }
}
