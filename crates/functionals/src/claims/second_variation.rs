//! `functional.second-variation`: Legendre's and Jacobi's conditions in one dimension.

use super::{Claim, Context, Finding, Formula};
use crate::functional::{Functional, Interval, Solution, SpecialKind};
use crate::linear::System;
use crate::polynomial::{Domain, Polynomial};
use crate::space::Component;
use chetaev_integrate::{from_fn, integrate, Event, Options};
use chetaev_symbolic::verdict::{Counterexample, Evidence, Proof};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Rational, Verdict};

/// `functional.second-variation#SOLUTION`.
pub(super) struct SecondVariation;

/// Highest degree of the polynomials in which a negative second variation is searched.
const HIGHEST: u32 = 8;

impl Claim for SecondVariation {
    fn id(&self) -> &'static str {
        "functional.second-variation"
    }

    fn title(&self) -> &'static str {
        "The second variation at the stated solution is positive for all variations that vanish at the ends"
    }

    fn explanation(&self) -> &'static str {
        "For one field u(x) and a density L(x, u, u') the second variation at a solution is ½ ∫ (P v'² + R v²) dx with P = ∂²L/∂u'² and \
         R = ∂²L/∂u² − d/dx ∂²L/∂u ∂u' (I. M. Gelfand, S. V. Fomin, Calculus of Variations, 1963, ch. 5). Legendre's condition is P > 0; \
         Jacobi's, that the solution of (P v')' = R v with v = 0 at the left end has no further zero, a conjugate point, up to the right \
         one. With P > 0 and R ≥ 0 by their signs it is proved. A conjugate point inside is confirmed by a polynomial v for which \
         the second variation is negative, computed exactly: refuted. Else the zero is looked for by numerical integration."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if field(cx.functional()).is_none() {
            return Vec::new();
        }
        let all = cx.problem.solutions.iter();
        all.map(|solution| Some(solution.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let mut all = cx.problem.solutions.iter();
        let own = all.find(|solution| Some(solution.name.as_str()) == subject);
        match (own, field(cx.functional())) {
            (Some(own), Some(component)) => decided(cx.functional(), own, component),
            _ => Verdict::undecided("there is no such solution").into(),
        }
    }
}

/// The field, where there is one component with first derivatives of one independent variable, held at both ends.
fn field(functional: &Functional) -> Option<usize> {
    let space = &*functional.space;
    if space.coordinates.len() != 1 {
        return None;
    }
    let mut all = functional.fields.iter().flat_map(|f| f.components.clone());
    let only = all.next().filter(|_| all.next().is_none())?;
    let jets = space.jets_in(&[functional.density]);
    let is_held = functional
        .pieces
        .iter()
        .all(|p| p.fixed.contains(&(only, false)));
    (is_held && jets.iter().all(|jet| jet.by.len() <= 1)).then_some(only)
}

/// The second variation at a solution.
struct Quadratic<'f> {
    functional: &'f Functional,
    leading: Expr,
    rest: Expr,
    interval: Interval,
}

fn decided(functional: &Functional, solution: &Solution, component: usize) -> Finding {
    let space = &*functional.space;
    let g = &space.graph;
    let [interval] = &solution.intervals[..] else {
        return Verdict::undecided("the ends of the interval are not stated").into();
    };
    let at = |e: Expr| with_values(functional, solution, e);
    let (u, slope) = (
        crate::space::Jet {
            component,
            by: Vec::new(),
        },
        crate::space::Jet {
            component,
            by: vec![0],
        },
    );
    let density = functional.density;
    let (by_u, by_slope) = (space.partial(density, &u), space.partial(density, &slope));
    let mixed = space.partial(by_u, &slope);
    let rest = g.sub(space.partial(by_u, &u), space.total(mixed, 0));
    let end = |e: Expr| at(e);
    let own = Quadratic {
        functional,
        leading: at(space.partial(by_slope, &slope)),
        rest: at(rest),
        interval: Interval {
            axis: 0,
            lower: end(interval.lower),
            upper: end(interval.upper),
        },
    };
    let v = space.component(Component {
        name: format!("δ{}", space.component_at(component).name),
        tensor: "δ".into(),
        multiplicity: 1,
        is_varied: false,
        is_of_boundary: false,
    });
    let jacobi = g.sub(
        space.total(g.mul(&[own.leading, space.jet(v, &[0])]), 0),
        g.mul(&[own.rest, space.jet(v, &[])]),
    );
    Finding {
        verdict: own.verdict(),
        formulas: vec![
            Formula::new("Legendre: what has to be positive", own.leading),
            Formula::new("Jacobi's equation, left side minus right side", jacobi),
        ],
    }
}

/// Stated values put in.
fn with_values(functional: &Functional, solution: &Solution, e: Expr) -> Expr {
    let space = &*functional.space;
    let mut pairs = functional.values();
    for special in &solution.values {
        if let SpecialKind::Symbols(own) = &special.what {
            pairs.extend(own.iter().copied());
        }
    }
    space.replace(space.explicit(e), &|symbol| {
        let find = |e: Expr| pairs.iter().find(|(l, _)| *l == e).map(|(_, r)| *r);
        match space.as_jet(symbol) {
            Some(jet) => Some(space.totals(find(space.jet(jet.component, &[]))?, &jet.by)),
            None => find(space.graph.symbol_expr(symbol)),
        }
    })
}

impl Quadratic<'_> {
    fn verdict(&self) -> Verdict {
        let g = &self.functional.space.graph;
        let assumptions = Assumptions::new();
        let (p, r) = (
            known_sign(g, self.leading, &assumptions),
            known_sign(g, self.rest, &assumptions),
        );
        if p.is_positive() && (g.is_zero(self.rest) || r.is_positive()) {
            return Verdict::Proved(Proof::exact(
                "all variations that vanish at the ends",
                "Legendre's P is positive and R is not negative, so that the second variation is a sum of squares",
            ));
        }
        let ends = (
            self.number(self.interval.lower),
            self.number(self.interval.upper),
        );
        let (Some(lower), Some(upper)) = ends else {
            return Verdict::undecided("the ends or the coefficients are no numbers: Jacobi's equation is printed, and not solved");
        };
        match self.conjugate_point(lower, upper) {
            Err(verdict) => *verdict,
            Ok(None) => Verdict::Numerical(Evidence {
                samples: 1,
                region: format!("Jacobi's field from x = {lower} to x = {upper}"),
                digits: 12,
                residual: 0.0,
                seed: None,
                why_no_proof: "Legendre's P is positive at all points met, and Jacobi's field, integrated numerically, has no zero up to the right end".into(),
            }),
            Ok(Some(point)) => self.negative().map_or_else(
                || Verdict::undecided(format!("Jacobi's field vanishes at x = {point:.10}, and no polynomial of low degree makes the second variation negative")),
                |value| refuted(point, &value),
            ),
        }
    }

    fn number(&self, e: Expr) -> Option<f64> {
        let own = self.functional.space.graph.evaluate_f64(&[e], &|_| None);
        own.ok()?.first().copied()
    }

    /// The first zero of Jacobi's field behind the left end.
    fn conjugate_point(&self, lower: f64, upper: f64) -> Result<Option<f64>, Box<Verdict>> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let x = g.as_symbol(space.coordinates[0].expr);
        let coefficients = |at: f64| {
            let own = g.evaluate_f64(&[self.leading, self.rest], &|s| {
                (Some(s) == x).then_some(at)
            });
            own.ok()
        };
        let undecided = |why: &str| Box::new(Verdict::undecided(why));
        let Some(start) = coefficients(lower) else {
            return Err(undecided(
                "parameters have no values: Jacobi's equation is printed, and not solved",
            ));
        };
        if start[0] <= 0.0 {
            return Err(undecided("Legendre's P is not positive at the left end"));
        }
        let mut is_regular = true;
        let mut system = from_fn(2, |at: f64, y: &[f64], dy: &mut [f64]| {
            let own = coefficients(at).unwrap_or_else(|| vec![f64::NAN; 2]);
            is_regular &= own[0] > 0.0;
            dy[0] = y[1] / own[0];
            dy[1] = own[1] * y[0];
        });
        // Divided by the distance from the left end, where the field itself vanishes.
        let quotient = move |at: f64, y: &[f64]| if at > lower { y[0] / (at - lower) } else { 1.0 };
        let mut events = [Event::new(quotient).terminal()];
        let run = integrate(
            &mut system,
            (lower, upper),
            &[0.0, 1.0],
            &mut events,
            Options::tolerance(1e-13),
        );
        let run = run.map_err(|problem| undecided(&problem.to_string()))?;
        if !is_regular {
            return Err(undecided("Legendre's P is not positive everywhere"));
        }
        Ok(run
            .events
            .first()
            .map(|event| event.t)
            .filter(|t| *t < upper))
    }

    /// A negative value of the second variation for a polynomial that vanishes at the ends.
    fn negative(&self) -> Option<(Rational, Polynomial)> {
        let space = &*self.functional.space;
        let one = rational::integer(1);
        let domain = Domain::of(space, std::slice::from_ref(&self.interval), &|e| e)?;
        let (p, r) = (
            Polynomial::of(space, self.leading)?,
            Polynomial::of(space, self.rest)?,
        );
        let (_, lower, upper) = domain.intervals.first()?.clone();
        let line = |at: &Rational| {
            let mut own = Polynomial::monomial(vec![1], one.clone());
            own.add(&Polynomial::constant(at.clone()), &rational::integer(-1));
            own
        };
        let factor = line(&lower).times(&line(&upper));
        let base: Vec<Polynomial> = (0..=HIGHEST)
            .map(|n| factor.times(&Polynomial::monomial(vec![n], one.clone())))
            .collect();
        let entry = |a: &Polynomial, b: &Polynomial| {
            let mut own = p.times(&a.slope(0)).times(&b.slope(0));
            own.add(&r.times(a).times(b), &one);
            own.integral(&domain)
        };
        let matrix: Vec<Vec<Rational>> = base
            .iter()
            .map(|a| base.iter().map(|b| entry(a, b)).collect())
            .collect();
        let x = descending(matrix)?;
        let mut v = Polynomial::default();
        for (own, coefficient) in base.iter().zip(&x) {
            v.add(own, coefficient);
        }
        let value = entry(&v, &v);
        rational::is_negative(&value).then_some((value, v))
    }
}

/// A vector with a negative value of the quadratic form, by completing squares.
fn descending(mut matrix: Vec<Vec<Rational>>) -> Option<Vec<Rational>> {
    let n = matrix.len();
    let original = matrix.clone();
    for k in 0..n {
        let pivot = matrix[k][k].clone();
        if rational::is_negative(&pivot) {
            // The first k components follow from the condition that their rows vanish.
            let mut block = System::new(k);
            for (r, row) in original.iter().enumerate().take(k) {
                for (c, value) in row.iter().enumerate().take(k) {
                    block.add(r, c, value);
                }
                block.add_right(r, &-row[k].clone());
            }
            let mut x = block.solution()?.values;
            x.push(rational::integer(1));
            x.resize(n, Rational::ZERO);
            return Some(x);
        }
        if pivot == Rational::ZERO {
            return None;
        }
        for r in k + 1..n {
            let factor = &matrix[r][k] / &pivot;
            let pivot_row = matrix[k].clone();
            for (own, above) in matrix[r].iter_mut().zip(&pivot_row).skip(k) {
                let term = rational::product(&factor, above);
                *own = &*own - &term;
            }
        }
    }
    None
}

fn refuted(point: f64, (value, _): &(Rational, Polynomial)) -> Verdict {
    let decimal = format!("{:.9}", rational::to_f64(value));
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        quantity: "the second variation".into(),
        residual: (decimal.clone(), decimal.clone()),
        detail: format!(
            "Jacobi's field vanishes at x = {point:.12}, inside the interval, and for a polynomial v that vanishes at the ends the second variation is {decimal}, by exact integration"
        ),
    })
}
