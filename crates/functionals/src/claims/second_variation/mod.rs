//! `functional.second-variation`: Legendre's and Jacobi's conditions in one dimension.

mod constant;
mod form;
mod jacobi;
mod trial;

use super::{Claim, Context, Finding, Formula};
use crate::functional::{Functional, Solution};
use crate::polynomial::Polynomial;
use crate::signs::{enclosure, on_interval, Sign};
use crate::space::{Component, Space};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::verdict::{Counterexample, Evidence, PointValue, Proof};
use chetaev_symbolic::{rational, Expr, Rational, Verdict};
use form::{Form, CLAIM};
use jacobi::Shown;
use std::cmp::Ordering;
use trial::Negative;

/// `functional.second-variation#SOLUTION`.
pub(super) struct SecondVariation;

impl Claim for SecondVariation {
    fn id(&self) -> &'static str {
        "functional.second-variation"
    }

    fn title(&self) -> &'static str {
        "The second variation at the stated solution is positive for all admitted variations that do not vanish"
    }

    fn explanation(&self) -> &'static str {
        "For fields u(x) and a density L(x, u, u') with densities at the ends the second variation at a solution is \
         ∫ (v'ᵀ P v' + 2 v'ᵀ Q v + vᵀ R v) dx + Σ vᵀ B v over the ends, with P, Q, R, B the second derivatives: half of it is what the functional \
         changes by to second order (I. M. Gelfand, S. V. Fomin, \
         Calculus of Variations, 1963, ch. 5). Where a field is given at an end, v vanishes there. Legendre's condition is that P is \
         positive: its sign on the whole interval is decided exactly for polynomials (Sturm), by enclosures for others. Jacobi's is that the \
         determinant of a conjoined basis of Jacobi's equations has no zero, a conjugate point, up to the right end; a free end \
         enters with its natural condition. It is proved where the integrand is positive, and for one field by a polynomial that is \
         positive and lies above Jacobi's equation. It is refuted by a polynomial v, computed exactly, or by a place where P is not positive. \
         A conjugate point exactly at the right end makes the second variation zero for Jacobi's field: that is the condition \
         stated. Else the determinant is followed numerically."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if cx.functional().space.coordinates.len() != 1 {
            return Vec::new();
        }
        let all = cx.problem.solutions.iter();
        all.map(|solution| Some(solution.name.clone())).collect()
    }

    fn differentiates(&self) -> bool {
        true
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let mut all = cx.problem.solutions.iter();
        let own = all.find(|solution| Some(solution.name.as_str()) == subject);
        match own {
            Some(own) => decided(cx.functional(), own),
            None => Verdict::undecided("there is no such solution").into(),
        }
    }
}

fn decided(functional: &Functional, solution: &Solution) -> Finding {
    match Form::of(functional, solution) {
        Err(verdict) => (*verdict).into(),
        Ok(form) => Finding {
            verdict: verdict(&form),
            formulas: formulas(&form),
        },
    }
}

/// Whether a number is proved not to be negative.
fn is_not_negative(space: &Space, e: Expr) -> bool {
    let is_positive = || enclosure(space, e).and_then(|own| own.sign()) == Some(Ordering::Greater);
    is_positive() || space.graph.is_zero(e) || space.vanish(&[e])
}

/// The places between which the form is looked at.
struct Places {
    /// Rational places at or outside the ends.
    outer: [Rational; 2],
    /// Rational places at or inside them.
    inner: [Rational; 2],
}

impl Places {
    fn of(form: &Form<'_>) -> Option<Places> {
        let (lower, upper) = (form.interval.lower, form.interval.upper);
        let [below, above] = around(form, lower)?;
        let [under, over] = around(form, upper)?;
        (above < under).then(|| Places {
            outer: [below, over],
            inner: [above, under],
        })
    }

    fn numbers(&self) -> (f64, f64) {
        (
            rational::to_f64(&self.outer[0]),
            rational::to_f64(&self.outer[1]),
        )
    }
}

/// Rational numbers on both sides of a number, which are itself where it is rational.
fn around(form: &Form<'_>, e: Expr) -> Option<[Rational; 2]> {
    let space = &*form.functional.space;
    if let Some(own) = space.graph.as_number(e) {
        return Some([own.clone(), own.clone()]);
    }
    let own = enclosure(space, e)?;
    let scale = 2_f64.powi(36);
    let of = |x: f64| rational::ratio(x as i64, 1 << 36);
    let (low, high) = (own.lower().to_f64() * scale, own.upper().to_f64() * scale);
    (low.abs().max(high.abs()) < 9e15).then_some(())?;
    Some([of(low.floor() - 1.0)?, of(high.ceil() + 1.0)?])
}

fn verdict(form: &Form<'_>) -> Verdict {
    if let Some(proof) = by_signs(form) {
        return Verdict::Proved(proof);
    }
    if form.is_zero() {
        return vanishing();
    }
    let Some(places) = Places::of(form) else {
        if form.is_singular() {
            return Verdict::not_applicable(
                CLAIM,
                "Legendre's P is singular: where some combination of fields has no derivative in it a principle is one of stationarity",
            );
        }
        return Verdict::undecided(
            "the ends of the interval are no numbers: Jacobi's equation is printed, and not solved",
        );
    };
    match legendre(form, &places) {
        Legendre::Holds => {}
        Legendre::Fails(verdict) | Legendre::Open(verdict) => return *verdict,
    }
    if let Some(proof) = by_integrand(form, &places) {
        return Verdict::Proved(proof);
    }
    // What refutes is cheap and exact: it comes before what follows the basis by small steps.
    if let Some(found) = negative(form, &places) {
        return refuted(form, &found, followed(form, &places, NAMING));
    }
    let shown = followed(form, &places, FOLLOWING);
    if matches!(shown, Some(Shown::Positive)) {
        if let Some(w) = jacobi::certificate(form, (&places.outer[0], &places.outer[1])) {
            return proved_by(form, w);
        }
    }
    if let (Some(Shown::Degenerate), Some(field)) = (shown, constant::degenerate(form)) {
        return degenerate(form, field);
    }
    by_numbers(shown, places.numbers(), trial::is_exact(form))
}

/// What a conjoined basis shows, as far as that is no more work than is allowed: beside a small P it oscillates fast.
fn followed(form: &Form<'_>, places: &Places, seconds: f64) -> Option<Shown> {
    let work = Work::of_seconds(seconds);
    within(&work, || jacobi::shown(form, places.numbers()))
        .ok()
        .flatten()
}

/// Seconds of work for a conjoined basis, where something may depend on it, and where it only names the conjugate point of what is refuted.
const FOLLOWING: f64 = 4.0;
const NAMING: f64 = 0.2;

const POSITIVE: &str = "all variations that are admitted and do not vanish";

fn proved_by(form: &Form<'_>, w: Expr) -> Verdict {
    let g = &form.functional.space.graph;
    let size = chetaev_symbolic::simplify::length(g, w);
    Verdict::Proved(Proof::exact(
        POSITIVE,
        format!("Legendre's P is positive, and a positive polynomial ({size} operations) lies above Jacobi's equation on the whole interval, so that no point is conjugate to the left end: the second variation is a sum of squares"),
    ))
}

/// Positive by the signs of its coefficients, whatever the interval.
fn by_signs(form: &Form<'_>) -> Option<Proof> {
    let g = &form.functional.space.graph;
    if form.count() != 1 {
        return None;
    }
    let rest = g.sub(form.r[0][0], form.functional.space.total(form.q[0][0], 0));
    let sign = |e: Expr| form.functional.space.sign(e);
    let is_held = form.ends.iter().all(|end| end.fixed[0]);
    let is_rest = g.is_zero(rest) || sign(rest).is_nonnegative();
    (is_held && sign(form.p[0][0]).is_positive() && is_rest).then(|| {
        Proof::exact(
            POSITIVE,
            "Legendre's P is positive inside of the interval and R − Q' is not negative, so that the second variation is a sum of squares",
        )
    })
}

/// What vanishes for all variations is positive for none.
fn vanishing() -> Verdict {
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        quantity: "the second variation".into(),
        residual: ("0".into(), "0".into()),
        detail: "the second variation vanishes for all variations, so that it is positive for none: whether the solution is a minimum is not decided by it".into(),
    })
}

enum Legendre {
    Holds,
    Fails(Box<Verdict>),
    Open(Box<Verdict>),
}

/// Whether P is positive definite on the whole interval: by its leading minors. A negative principal minor at a place refutes.
fn legendre(form: &Form<'_>, places: &Places) -> Legendre {
    let space = &*form.functional.space;
    let outer = (&places.outer[0], &places.outer[1]);
    let inner = (&places.inner[0], &places.inner[1]);
    let mut is_positive = true;
    for chosen in subsets(form.count()) {
        let minor = minor(form, &form.p, &chosen);
        let is_leading = chosen.iter().enumerate().all(|(k, &own)| k == own);
        match on_interval(space, minor, if is_leading { outer } else { inner }) {
            Sign::Negative(x) if x > places.inner[0] && x < places.inner[1] => {
                return Legendre::Fails(Box::new(no_minimum(form, &x, minor)))
            }
            Sign::Positive => {}
            _ if is_leading => is_positive = false,
            _ => {}
        }
    }
    if is_positive {
        return Legendre::Holds;
    }
    let negative = negative(form, places).map(|found| refuted(form, &found, None));
    Legendre::Open(Box::new(negative.unwrap_or_else(|| {
        if let Some(proof) = by_integrand(form, places) {
            return Verdict::Proved(proof);
        }
        Verdict::undecided("Legendre's P is not proved to be positive on the whole interval: it has zeros there, where Jacobi's equation is singular, or its sign was not found")
    })))
}

fn no_minimum(form: &Form<'_>, x: &Rational, minor: Expr) -> Verdict {
    let space = &*form.functional.space;
    let g = &space.graph;
    let variable = space.coordinates.first().map(|c| c.expr);
    let value = variable.map_or(minor, |own| {
        g.substitute(minor, &[(own, g.number(x.clone()))])
    });
    let bounds = enclosure(space, value).map_or_else(
        || ("-0".to_owned(), "-0".to_owned()),
        |own| {
            let text = |v: f64| format!("{v:.9e}");
            (text(own.lower().to_f64()), text(own.upper().to_f64()))
        },
    );
    Verdict::Refuted(Counterexample {
        point: vec![PointValue {
            name: "x".into(),
            exact: Some(x.clone()),
            enclosure: None,
        }],
        quantity: "a principal minor of Legendre's P".into(),
        residual: bounds,
        detail: format!(
            "Legendre's condition fails: at x = {x} P is not positive, so that the second variation is negative for variations that oscillate fast there"
        ),
    })
}

/// All subsets of 0, …, n − 1 but the empty one.
fn subsets(n: usize) -> Vec<Vec<usize>> {
    let all = 1..1usize << n.min(6);
    all.map(|bits| (0..n).filter(|k| bits >> k & 1 == 1).collect())
        .collect()
}

fn minor(form: &Form<'_>, matrix: &[Vec<Expr>], chosen: &[usize]) -> Expr {
    let g = &form.functional.space.graph;
    let row = |&a: &usize| chosen.iter().map(|&b| matrix[a][b]).collect();
    let rows: Vec<Vec<Expr>> = chosen.iter().map(row).collect();
    determinant(g, &rows)
}

/// Positive because the integrand is, and what stands at free ends.
fn by_integrand(form: &Form<'_>, places: &Places) -> Option<Proof> {
    let space = &*form.functional.space;
    let g = &space.graph;
    let n = form.count();
    let outer = (&places.outer[0], &places.outer[1]);
    let detail = "the integrand of the second variation is positive, and nothing negative stands at the ends";
    if n == 1 {
        // 2 Q v v' is (Q v²)' − Q' v².
        let rest = on_interval(
            space,
            g.sub(form.r[0][0], space.total(form.q[0][0], 0)),
            outer,
        );
        let leading = on_interval(space, form.p[0][0], outer);
        let x = space.coordinates.first()?.expr;
        let at = |e: Expr, place: Expr| g.substitute(e, &[(x, place)]);
        let (q, ends) = (form.q[0][0], &form.ends);
        let left = g.sub(ends[0].b[0][0], at(q, form.interval.lower));
        let right = g.add(&[ends[1].b[0][0], at(q, form.interval.upper)]);
        let is_fine = |k: usize, e: Expr| ends[k].fixed[0] || is_not_negative(space, e);
        let is_held = ends.iter().any(|end| end.fixed[0])
            || enclosure(space, left).and_then(|own| own.sign()) == Some(Ordering::Greater)
            || enclosure(space, right).and_then(|own| own.sign()) == Some(Ordering::Greater);
        let is_strict = match rest {
            Sign::Positive | Sign::PositiveInside | Sign::Nonnegative => true,
            Sign::Zero => is_held && leading != Sign::Zero && leading.is_nonnegative(),
            _ => false,
        };
        let is_positive =
            leading.is_nonnegative() && is_strict && is_fine(0, left) && is_fine(1, right);
        let is_strict = leading == Sign::Positive && rest == Sign::Positive;
        let told = if is_strict {
            detail
        } else {
            "the integrand of the second variation and what stands at the ends are nowhere negative, and all of it vanishes for v = 0 only"
        };
        return is_positive.then(|| Proof::exact(POSITIVE, told));
    }
    let is_free = |end: &form::End| !end.fixed.iter().all(|fixed| *fixed);
    let has_ends = form
        .ends
        .iter()
        .any(|end| is_free(end) && !end.b.iter().flatten().all(|&e| g.is_zero(e)));
    if has_ends {
        return None;
    }
    let is_plain = form
        .q
        .iter()
        .chain(&form.r)
        .flatten()
        .all(|&e| g.is_zero(e));
    if is_plain {
        let is_held = (0..n).all(|k| form.ends.iter().any(|end| end.fixed[k]));
        let is_leading = (1..=n).all(|count| {
            let chosen: Vec<usize> = (0..count).collect();
            on_interval(space, minor(form, &form.p, &chosen), outer) == Sign::Positive
        });
        return (is_held && is_leading).then(|| Proof::exact(POSITIVE, detail));
    }
    // The matrix [[P, Q], [Qᵀ, R]].
    let entry = |a: usize, b: usize| match (a < n, b < n) {
        (true, true) => form.p[a][b],
        (true, false) => form.q[a][b - n],
        (false, true) => form.q[b][a - n],
        (false, false) => form.r[a - n][b - n],
    };
    let is_positive = (1..=2 * n).all(|count| {
        let row = |a: usize| (0..count).map(|b| entry(a, b)).collect();
        let rows: Vec<Vec<Expr>> = (0..count).map(row).collect();
        on_interval(space, determinant(g, &rows), outer) == Sign::Positive
    });
    is_positive.then(|| Proof::exact(POSITIVE, detail))
}

/// A number with so many digits: as a person writes it, with a power of ten where it is small or large.
fn decimal(x: f64, digits: usize) -> String {
    match x.abs() {
        size if size != 0.0 && !(1e-3..1e6).contains(&size) => format!("{x:.0$e}", digits - 1),
        _ => format!("{x:.digits$}"),
    }
}

/// A negative second variation for polynomials.
fn negative(form: &Form<'_>, places: &Places) -> Option<Negative> {
    let whole = trial::negative(form, &places.inner);
    whole.or_else(|| trial::negative_on_part(form, &places.inner))
}

/// Variations of more characters are not written out.
const LONGEST: usize = 120;

/// `u: x^2 - 2 x`, for several fields with their names, where it is short.
fn written(form: &Form<'_>, variation: &[Polynomial]) -> String {
    let space = &*form.functional.space;
    let names = form.components.iter().map(|&c| space.component_at(c).name);
    let each = names
        .zip(variation)
        .map(|(name, own)| format!("{name}: {}", space.graph.text(own.expr(space))));
    let all = each.collect::<Vec<_>>().join(", ");
    if all.chars().count() <= LONGEST {
        format!(", as for the variation of {all},")
    } else {
        String::new()
    }
}

fn refuted(form: &Form<'_>, found: &Negative, shown: Option<Shown>) -> Verdict {
    let [size, upper] = found.bounds.map(|value| decimal(value, 9));
    let why = match shown {
        Some(Shown::Conjugate(x)) => {
            let x = decimal(x, 12);
            format!("Jacobi's field vanishes at x = {x}, inside the interval, and ")
        }
        _ => String::new(),
    };
    let which = match &found.part {
        Some([from, to]) => {
            format!("that are zero outside of the part between x = {from} and x = {to}")
        }
        None => "that are admitted".to_owned(),
    };
    let detail = format!(
        "{why}for polynomials v {which}{} the second variation is {size}, by exact integration",
        written(form, &found.variation)
    );
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        quantity: "the second variation".into(),
        residual: (size, upper),
        detail,
    })
}

fn degenerate(form: &Form<'_>, field: Expr) -> Verdict {
    let text = form.functional.space.graph.text(field);
    Verdict::Conditional {
        condition: format!("v is no multiple of {text}"),
        proof: Proof::exact(
            "variations that are no multiples of Jacobi's field",
            format!("the second variation is nowhere negative, and zero for the multiples of Jacobi's field v = {text}, whose condition holds exactly at the right end: whether the solution is a minimum is not decided by it"),
        ),
        counterexample: None,
    }
}

fn by_numbers(shown: Option<Shown>, (lower, upper): (f64, f64), is_tried: bool) -> Verdict {
    let tried = if is_tried {
        "no polynomial of low degree makes the second variation negative"
    } else {
        "the coefficients are no polynomials with numbers, for which polynomial variations are integrated exactly"
    };
    match shown {
        None => Verdict::undecided("Jacobi's equations have no numbers as coefficients, or could not be integrated with the work that is allowed: they are printed"),
        Some(Shown::Positive) => Verdict::Numerical(Evidence {
            samples: 1,
            region: format!("a conjoined basis from x = {lower} to x = {upper}"),
            digits: 12,
            residual: 0.0,
            seed: None,
            why_no_proof: "Legendre's P is positive, and the determinant of a conjoined basis, integrated numerically, has no zero up to the right end; no function was found that proves it".into(),
        }),
        Some(Shown::Conjugate(x)) => Verdict::undecided(format!(
            "the determinant of a conjoined basis vanishes at x = {x:.10}, and {tried}"
        )),
        Some(Shown::NegativeAtEnd) => Verdict::undecided(format!(
            "at the free end the condition fails numerically, and {tried}"
        )),
        Some(Shown::Degenerate) => Verdict::undecided(
            "as far as numbers tell Jacobi's field satisfies the condition at the right end, and no closed form of it shows whether it does so exactly",
        ),
    }
}

fn formulas(form: &Form<'_>) -> Vec<Formula> {
    let space = &*form.functional.space;
    let g = &space.graph;
    let mut found = Vec::new();
    let names: Vec<String> = form
        .components
        .iter()
        .map(|&c| space.component_at(c).name)
        .collect();
    let variations: Vec<usize> = names
        .iter()
        .map(|name| {
            space.component(Component {
                name: format!("δ{name}"),
                tensor: "δ".into(),
                multiplicity: 1,
                is_varied: false,
                is_of_boundary: false,
                constant_along: Vec::new(),
            })
        })
        .collect();
    let all: Vec<usize> = (0..form.count()).collect();
    let caption = "Legendre: what has to be positive";
    found.push(Formula::new(caption, minor(form, &form.p, &all)));
    for (a, name) in names.iter().enumerate() {
        let (mut momentum, mut rest) = (Vec::new(), Vec::new());
        for (b, &v) in variations.iter().enumerate() {
            let (value, slope) = (space.jet(v, &[]), space.jet(v, &[0]));
            momentum.push(g.mul(&[form.p[a][b], slope]));
            momentum.push(g.mul(&[form.q[a][b], value]));
            rest.push(g.mul(&[form.r[a][b], value]));
            rest.push(g.mul(&[form.q[b][a], slope]));
        }
        let jacobi = g.sub(space.total(g.add(&momentum), 0), g.add(&rest));
        let caption = match form.count() {
            1 => "Jacobi's equation, left side minus right side".to_owned(),
            _ => format!("Jacobi's equation of {name}, left side minus right side"),
        };
        found.push(Formula::new(caption, jacobi));
    }
    found
}
