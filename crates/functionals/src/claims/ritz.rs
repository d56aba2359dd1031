//! `functional.ritz`: Ritz's method gives the closed solution, or comes near to it.

use super::special_values::{unfit, violated};
use super::{Claim, Context, Finding, Formula};
use crate::functional::{Functional, Special, SpecialKind};
use crate::ritz::{approximation, with_values, Approximation, Asked, Point, RitzError};
use crate::variation::Variation;
use chetaev_symbolic::verdict::{Counterexample, Evidence, Proof};
use chetaev_symbolic::{rational, Expr, Rational, Verdict};

/// `functional.ritz#NAME`.
pub(super) struct Ritz;

/// Decimal digits that are looked at.
const DIGITS: usize = 40;
/// Largest relative error at a point that counts as agreement.
const NEAR: f64 = 1e-3;

impl Claim for Ritz {
    fn id(&self) -> &'static str {
        "functional.ritz"
    }

    fn title(&self) -> &'static str {
        "Ritz's method gives the closed solution"
    }

    fn explanation(&self) -> &'static str {
        "W. Ritz (1909): in the place of all fields, polynomials are admitted that satisfy what is given on the faces of a box; the \
         functional is then a quadratic function of their coefficients, whose integrals are exact rational numbers, and its stationary \
         point is found by exact elimination. Where the polynomial satisfies the Euler equations and all natural conditions it is the solution: \
         proved, or refuted where the solution has other values than those that [ritz] states. Else its values are compared with those of a closed solution that [ritz] states: numerical, with the error for each degree."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match &cx.problem.ritz {
            Some(_) => vec![cx.own()],
            None => Vec::new(),
        }
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        let (Some(asked), Ok(variation)) = (&cx.problem.ritz, &cx.variation) else {
            return Verdict::undecided("the first variation was not derived").into();
        };
        let special = Special {
            written: String::new(),
            what: SpecialKind::Symbols(asked.values.clone()),
        };
        if let Some(unfit) = unfit(cx.functional(), &[special], &cx.functional().intervals) {
            return unfit.into();
        }
        let (mut all, mut singular) = (Vec::new(), None);
        for &degree in &asked.degrees {
            match approximation(cx.functional(), asked, degree) {
                Ok(own) => all.push(own),
                // Of another degree there may be one stationary polynomial.
                Err(problem @ RitzError::Singular { .. }) => singular = Some(problem),
                Err(problem) => return Verdict::undecided(problem.to_string()).into(),
            }
        }
        let Some(last) = all.last() else {
            let said = singular.map_or("no degree is asked for".to_owned(), |own| own.to_string());
            return Verdict::undecided(said).into();
        };
        let verdict = verdict(cx.functional(), variation, asked, &all, last);
        let formulas = formulas(cx.functional(), last);
        cx.approximations.replace(all);
        Finding { verdict, formulas }
    }
}

/// The values that are asked for and the fields that were found.
fn with_fields(functional: &Functional, asked: &Asked, last: &Approximation) -> Special {
    let space = &*functional.space;
    let fields = last.fields.iter();
    let fields = fields.map(|(c, polynomial)| (space.jet(*c, &[]), polynomial.expr(space)));
    Special {
        written: String::new(),
        what: SpecialKind::Symbols(asked.values.iter().copied().chain(fields).collect()),
    }
}

fn formulas(functional: &Functional, last: &Approximation) -> Vec<Formula> {
    let space = &*functional.space;
    let own = last.fields.iter().map(|(component, polynomial)| {
        Formula::new(
            format!(
                "{} of degree {}",
                space.component_at(*component).name,
                last.degree
            ),
            polynomial.expr(space),
        )
    });
    own.collect()
}

/// Largest relative error at the points.
pub(crate) fn error(asked: &Asked, own: &Approximation) -> Option<f64> {
    let errors = asked.points.iter().filter_map(|point| {
        let (_, polynomial) = own.fields.iter().find(|(c, _)| *c == point.component)?;
        let value = polynomial.exact(&point.at);
        let wanted = rational::to_f64(&point.value);
        let difference = rational::to_f64(&(value - &point.value)).abs();
        Some(if wanted == 0.0 {
            difference
        } else {
            difference / wanted.abs()
        })
    });
    errors.max_by(f64::total_cmp)
}

fn verdict(
    functional: &Functional,
    variation: &Variation,
    asked: &Asked,
    all: &[Approximation],
    last: &Approximation,
) -> Verdict {
    let space = &*functional.space;
    let told: Vec<String> = all
        .iter()
        .map(|own| match error(asked, own) {
            Some(error) => format!("degree {}: {error:.1e}", own.degree),
            None => format!(
                "degree {}: value {:.6}",
                own.degree,
                rational::to_f64(&own.value)
            ),
        })
        .collect();
    let kind = if last.is_minimum {
        "a minimum among these polynomials"
    } else {
        "no minimum"
    };
    let exact = residuals(functional, variation, asked, last);
    let is_exact = exact.iter().all(|&e| space.vanish(&[e]));
    let found = with_fields(functional, asked, last);
    if let Some(violated) = violated(functional, &[found], &functional.intervals) {
        let degree = last.degree;
        return if is_exact {
            let said = format!("the polynomial of degree {degree} is the solution, and violates what the model assumes, {violated}");
            Verdict::not_applicable("assumptions", said)
        } else {
            Verdict::undecided(format!(
                "the polynomial of degree {degree} violates what the model assumes, {violated}, which the solution need not: another degree may come nearer"
            ))
        };
    }
    if is_exact {
        let mut stated = asked.points.iter();
        if let Some(found) = stated.find_map(|point| otherwise(point, last)) {
            return Verdict::Refuted(found);
        }
        return Verdict::Proved(Proof::exact(
            "the box with the stated numbers",
            format!(
                "the polynomial of degree {} with {} unknowns satisfies the Euler equations and all natural conditions; the value is {}, {kind}",
                last.degree, last.unknowns, last.value
            ),
        ));
    }
    match error(asked, last) {
        Some(largest) if largest <= NEAR => Verdict::Numerical(Evidence {
            samples: all.len() as u32,
            region: format!(
                "polynomials up to the degree {} by each variable; {kind}",
                last.degree
            ),
            digits: 16,
            residual: largest,
            seed: None,
            why_no_proof: format!(
                "no polynomial of these degrees is the solution; relative errors at the points: {}",
                told.join(", ")
            ),
        }),
        Some(_) => Verdict::undecided(format!(
            "the values are not those of the closed solution; relative errors: {}",
            told.join(", ")
        )),
        None => Verdict::undecided(format!(
            "no closed solution is stated, and the polynomial is none: {}",
            told.join(", ")
        )),
    }
}

/// A stated value that the solution does not have, within a unit of the last digit where it is a decimal fraction of the value.
fn otherwise(point: &Point, own: &Approximation) -> Option<Counterexample> {
    let (_, polynomial) = own.fields.iter().find(|(c, _)| *c == point.component)?;
    let value = polynomial.exact(&point.at);
    let distance = &value - &point.value;
    let is_far = if point.is_exact {
        distance != Rational::ZERO
    } else {
        rational::abs(&distance) >= last_digit(&point.value)
    };
    let difference = format!("{:.9e}", rational::to_f64(&distance));
    is_far.then(|| Counterexample {
        point: Vec::new(),
        quantity: point.written.clone(),
        residual: (difference.clone(), difference),
        detail: format!(
            "the polynomial of degree {} is the solution, and its value {} is {value}, where {} is stated",
            own.degree, point.written, point.value
        ),
    })
}

/// A unit of the last decimal digit of a number; of the fortieth where it has no last one.
fn last_digit(value: &Rational) -> Rational {
    let tenth = rational::ratio(1, 10).unwrap_or(Rational::ZERO);
    let mut unit = rational::integer(1);
    for _ in 0..DIGITS {
        let whole = value / &unit;
        if whole.is_int() {
            break;
        }
        unit = rational::product(&unit, &tenth);
    }
    unit
}

/// Euler expressions and natural conditions at the polynomial.
fn residuals(
    functional: &Functional,
    variation: &Variation,
    asked: &Asked,
    own: &Approximation,
) -> Vec<Expr> {
    let space = &*functional.space;
    let put = |e: Expr| {
        space.replace(with_values(functional, asked, e), &|symbol| {
            let jet = space.as_jet(symbol)?;
            let (_, polynomial) = own.fields.iter().find(|(c, _)| *c == jet.component)?;
            Some(polynomial.slopes(&jet.by).expr(space))
        })
    };
    let mut found: Vec<Expr> = variation.euler.iter().map(|(_, e)| put(*e)).collect();
    let on = |name: &str, e: Expr| {
        let side = functional.piece(name).map(|piece| &piece.side);
        match side {
            Some(crate::functional::Side::Flat { axis, at, .. }) => {
                let at = with_values(functional, asked, *at);
                space
                    .graph
                    .substitute(put(e), &[(space.coordinates[*axis].expr, at)])
            }
            _ => put(e),
        }
    };
    for piece in &variation.pieces {
        found.extend(piece.conditions.iter().map(|c| on(&piece.piece, c.value)));
    }
    for corner in &variation.corners {
        let both = on(&corner.pieces.0, corner.value);
        let other = functional.piece(&corner.pieces.1).map(|piece| &piece.side);
        found.push(match other {
            Some(crate::functional::Side::Flat { axis, at, .. }) => {
                let at = with_values(functional, asked, *at);
                space
                    .graph
                    .substitute(both, &[(space.coordinates[*axis].expr, at)])
            }
            _ => both,
        });
    }
    found
}
