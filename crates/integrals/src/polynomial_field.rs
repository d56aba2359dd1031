//! A flow as a polynomial vector field in the functions that occur.
//!
//! Letters are the variables that occur outside of functions, and the functions of variables that occur: sines and cosines of
//! angles, exponentials, square roots, logarithms and arctangents. The derivation maps the rational functions of the letters and
//! constants into themselves, `X l = N_l/D`; with the common denominator D the field `D X` is polynomial. Polynomials that it maps
//! into multiples of themselves are those of X.

use crate::flow::Flow;
use chetaev_symbolic::polynomial::normal_form::{normal_forms, Field, Kind, Options};
use chetaev_symbolic::polynomial::{Budget, Polynomial, RationalFunction};
use chetaev_symbolic::{Expr, Node};
use thiserror::Error;

/// Room for the rates as rational functions: those of bodies that roll take some hundred terms.
const BUDGET: Budget = Budget {
    terms: 3_000,
    degree: 60,
    bits: 2_000,
    work: 3_000_000,
};

/// Derivatives of the functions that occur may contain others, as the sine has the cosine; so many rounds close them.
const ROUNDS: usize = 4;

/// How the values of a letter are related to those of others.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tie {
    /// Any value.
    Free,
    /// With the letter or constant of this number on a circle, or on a hyperbola.
    Circle {
        /// The number of the other generator.
        partner: usize,
        /// Whether this one is the sine.
        is_sine: bool,
        /// `s² + c² = 1` rather than `c² - s² = 1`.
        circular: bool,
    },
    /// The square root of a polynomial in generators.
    Root(Polynomial),
}

/// A generator of the field of rational functions.
#[derive(Clone, Debug)]
pub(crate) struct Letter {
    /// What it stands for.
    pub(crate) value: Expr,
    /// Its relation to others.
    pub(crate) tie: Tie,
    /// Whether it contains a variable.
    pub(crate) moves: bool,
}

/// The polynomial field `D X`.
#[derive(Clone, Debug)]
pub(crate) struct PolynomialField {
    /// All generators, constants too, in the order of their relations.
    pub(crate) letters: Vec<Letter>,
    /// `D X l` for each letter l; zero for constants.
    pub(crate) rates: Vec<Polynomial>,
    /// The common denominator D.
    pub(crate) denominator: Polynomial,
}

/// Why rates are not rational in functions that are closed under differentiation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub(crate) enum NotRational {
    /// The rational forms are too large.
    #[error("the rates are too large")]
    TooLarge,
    /// Functions without rational derivatives, or roots of higher order.
    #[error("the rates contain functions that are not treated")]
    Function,
}

impl PolynomialField {
    /// The field of a flow in the letters that occur in its rates, with its variables as letters as far as they are no arguments
    /// of sines alone.
    ///
    /// # Errors
    /// [`NotRational`].
    pub(crate) fn of(flow: &Flow<'_>) -> Result<PolynomialField, NotRational> {
        let g = flow.graph;
        let mut functions: Vec<Expr> = Vec::new();
        for _ in 0..ROUNDS {
            let mut all: Vec<Expr> = flow.variables.iter().map(|v| v.rate).collect();
            all.extend(flow.derivatives(&functions));
            all.extend(unused_variables(flow, &all));
            let options = Options {
                expand_angles: true,
                expand_solves: true,
                ..Options::display(BUDGET)
            };
            let (field, forms) =
                normal_forms(g, &all, &options).map_err(|_| NotRational::TooLarge)?;
            let own = field.generators().iter().map(|generator| generator.expr);
            let moving: Vec<Expr> = own
                .filter(|&e| g.as_symbol(e).is_none() && flow.contains_variable(e))
                .collect();
            if moving.iter().all(|e| functions.contains(e)) {
                return PolynomialField::from_forms(flow, &field, &functions, &forms);
            }
            functions.extend(
                moving
                    .into_iter()
                    .filter(|e| !functions.contains(e))
                    .collect::<Vec<_>>(),
            );
        }
        Err(NotRational::Function)
    }

    fn from_forms(
        flow: &Flow<'_>,
        field: &Field<'_>,
        functions: &[Expr],
        forms: &[RationalFunction],
    ) -> Result<PolynomialField, NotRational> {
        let g = flow.graph;
        let meter = field.meter();
        let mut letters = Vec::new();
        for (place, generator) in field.generators().iter().enumerate() {
            letters.push(Letter {
                value: generator.expr,
                tie: tie(field, place)?,
                moves: flow.contains_variable(generator.expr),
            });
        }
        let form = |letter: &Letter| {
            let variable = |v: &crate::flow::Variable| g.symbol_expr(v.symbol) == letter.value;
            let place = flow.variables.iter().position(variable).or_else(|| {
                let place = functions.iter().position(|&e| e == letter.value)?;
                Some(flow.variables.len() + place)
            });
            place.map(|place| &forms[place])
        };
        let mut denominator = Polynomial::one();
        for form in letters.iter().filter_map(form) {
            denominator = denominator
                .lcm(form.denominator(), meter)
                .map_err(|_| NotRational::TooLarge)?;
        }
        let cleared = |letter: &Letter| -> Option<Polynomial> {
            let Some(form) = form(letter) else {
                return Some(Polynomial::zero());
            };
            let factor = denominator
                .exact_quotient(form.denominator(), meter)
                .ok()??;
            form.numerator().mul(&factor, meter).ok()
        };
        let rates = letters.iter().map(cleared).collect::<Option<_>>();
        Ok(PolynomialField {
            rates: rates.ok_or(NotRational::TooLarge)?,
            letters,
            denominator,
        })
    }

    /// The numbers of the letters that move.
    pub(crate) fn moving(&self) -> Vec<usize> {
        (0..self.letters.len())
            .filter(|&i| self.letters[i].moves)
            .collect()
    }

    /// The numbers of those that do not.
    pub(crate) fn constants(&self) -> Vec<usize> {
        (0..self.letters.len())
            .filter(|&i| !self.letters[i].moves)
            .collect()
    }

    /// The highest power of a letter in a polynomial reduced by the relations.
    pub(crate) fn highest_power(&self, letter: usize) -> Option<u32> {
        match &self.letters[letter].tie {
            Tie::Free => None,
            Tie::Circle { is_sine, .. } => is_sine.then_some(1),
            Tie::Root(_) => Some(1),
        }
    }

    /// Whether constants are related, or a root contains some: then they cannot be changed along a line.
    pub(crate) fn binds_constants(&self) -> bool {
        self.letters.iter().any(|letter| match &letter.tie {
            Tie::Free => false,
            Tie::Circle { .. } => !letter.moves,
            Tie::Root(square) => {
                !letter.moves || square.generators().iter().any(|&i| !self.letters[i].moves)
            }
        })
    }
}

/// Variables of which no rate contains anything: they are letters all the same.
fn unused_variables(flow: &Flow<'_>, rates: &[Expr]) -> Vec<Expr> {
    let g = flow.graph;
    let used = g.symbols_in(rates);
    let own = flow.variables.iter().filter(|v| !used.contains(&v.symbol));
    own.map(|v| g.symbol_expr(v.symbol)).collect()
}

fn tie(field: &Field<'_>, place: usize) -> Result<Tie, NotRational> {
    let generator = &field.generators()[place];
    let circular = |partner: usize| {
        let pairs = field.pythagoras();
        let own = pairs.iter().find(|p| p.sine == place || p.cosine == place);
        own.is_some_and(|p| p.circular && (p.sine == partner || p.cosine == partner))
    };
    match generator.kind {
        Kind::Free | Kind::Exponential => match field.graph().node(generator.expr) {
            Node::Symbol(_) | Node::Pi | Node::Apply { .. } => Ok(Tie::Free),
            _ if generator.kind == Kind::Exponential => Ok(Tie::Free),
            _ => Err(NotRational::Function),
        },
        Kind::Sine { partner } => Ok(Tie::Circle {
            partner,
            is_sine: true,
            circular: circular(partner),
        }),
        Kind::Cosine { partner } => Ok(Tie::Circle {
            partner,
            is_sine: false,
            circular: circular(partner),
        }),
        Kind::Radical { order: 2 } => match field.square_of(place) {
            Some(square) => Ok(Tie::Root(square.clone())),
            None => Err(NotRational::Function),
        },
        Kind::Radical { .. } | Kind::Absolute | Kind::Algebraic => Err(NotRational::Function),
    }
}
