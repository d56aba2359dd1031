//! Integrals as a Lyapunov function where their second variation is degenerate: a term of higher order decides.
//!
//! A combination V of integrals has no first variation, and a second one that is semidefinite where no integral changes. By the splitting lemma
//! (Gromoll and Meyer 1969) V is there the sum of a definite form and of a function W on the kernel of the second variation, and of the same kind as
//! the first term `W_m` of W: where that is definite of the same sign, V has a strict extremum, and the motion is stable (Lyapunov 1892;
//! Lagrange and Dirichlet where V is the energy). For a natural system at rest, with forces of a potential only, it is unstable where `W_m` takes
//! negative values: there are motions that leave the equilibrium (Kozlov and Palamodov 1982, Dokl. 263; Arnold, Kozlov, Neishtadt 2006, § 6.6).

use crate::about::About;
use crate::branching::{Branching, Leading};
use crate::bundle::{is_negative, is_positive, minors, Bundle};
use crate::integrals::{Jet, ENERGY, FINITE};
use crate::levels::Levels;
use crate::question::{bound_of, Place};
use crate::real_roots::{bounds_at, real_roots, sign_at, sign_of};
use crate::steady::{closed, echelon, kernel};
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// The first term beyond the second variation decides.
pub(crate) struct HigherVariation;

/// A combination with a degenerate second variation.
struct Degenerate {
    text: String,
    falls: bool,
    /// Minors of the second variation beside its kernel.
    minors: Vec<Expr>,
    nonzero: Vec<Expr>,
    first: Term,
    /// Whether it is the energy of a natural system at rest.
    is_potential: bool,
}

/// `W_m` on the kernel of the second variation.
struct Term {
    order: usize,
    values: Values,
}

enum Values {
    /// `c xᵐ`.
    Line(Expr),
    /// `p(s) xᵐ` in the directions (1, s), p of degree m, the constant first.
    Plane(Vec<Expr>),
}

/// Which values a term takes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sense {
    Positive,
    Negative,
    Both,
}

impl Method for HigherVariation {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        let found = about.once(|| degenerate(about));
        let of = |own: &Degenerate| {
            let line = match &own.first.values {
                Values::Line(e) => vec![*e],
                Values::Plane(_) => Vec::new(),
            };
            [own.minors.clone(), own.nonzero.clone(), line].concat()
        };
        found.iter().flat_map(of).collect()
    }

    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        if matches!(place, Place::Right | Place::Left) {
            return Answer::NotApplicable;
        }
        let found = about.once(|| degenerate(about));
        let mut answers = found.iter().map(|own| own.answer(about, at));
        let is_known = |own: &Answer| !matches!(own, Answer::NotApplicable);
        answers.find(is_known).unwrap_or(Answer::NotApplicable)
    }
}

impl Degenerate {
    fn answer(&self, about: &About<'_>, at: Option<&RBig>) -> Answer {
        let g = about.graph();
        let sign = |e: &Expr| about.question.sign(g, *e, at);
        let is_apart = |e: &Expr| sign(e).is_some_and(|s| s != Ordering::Equal);
        let signs: Option<Vec<Ordering>> = self.minors.iter().map(sign).collect();
        let (Some(signs), true) = (signs, self.nonzero.iter().all(is_apart)) else {
            return Answer::NotApplicable;
        };
        let Some(sense) = self.first.sense(g, &sign) else {
            return Answer::NotApplicable;
        };
        let m = self.first.order;
        let is_lowest = is_positive(&signs) && sense == Sense::Positive;
        let is_highest = !self.falls && is_negative(&signs) && sense == Sense::Negative;
        if is_lowest || is_highest {
            return Answer::Stable(format!("by integrals as a Lyapunov function: with {}, whose first variation vanishes and whose second is semidefinite where no integral changes, the term of order {m} is definite on the kernel of the second (Lyapunov; splitting lemma)", self.text));
        }
        if self.is_potential && is_positive(&signs) && sense != Sense::Positive {
            let size = match &self.first.values {
                Values::Line(e) => bounds_at(g, *e, about.question.over.zip(at)),
                Values::Plane(_) => None,
            };
            return Answer::Unstable(Instability {
                quantity: format!("the term of order {m} of the potential energy on the kernel of its second variation"),
                bounds: size.unwrap_or_else(|| ("-1".into(), "-1".into())),
                why: format!("the potential energy has no minimum: on the kernel of its second variation the first term that is not zero is of order {m} and takes negative values, so that motions leave the equilibrium (Kozlov and Palamodov)"),
            });
        }
        Answer::NotApplicable
    }
}

impl Term {
    fn sense(&self, g: &Graph, sign: &dyn Fn(&Expr) -> Option<Ordering>) -> Option<Sense> {
        let of = |sign: Ordering| match sign {
            Ordering::Greater => Some(Sense::Positive),
            Ordering::Less => Some(Sense::Negative),
            Ordering::Equal => None,
        };
        match &self.values {
            Values::Line(e) => {
                let found = of(sign(e)?)?;
                Some(if self.order % 2 == 1 {
                    Sense::Both
                } else {
                    found
                })
            }
            Values::Plane(polynomial) => sense_of_plane(g, self.order, polynomial),
        }
    }
}

/// The slope of a direction in the kernel. No name of a model contains a space.
fn slope(g: &Graph) -> Symbol {
    g.intern_symbol("across branch", 0)
}

/// The values of a form of two variables; `None` where it is semidefinite, or was not decided.
fn sense_of_plane(g: &Graph, order: usize, polynomial: &[Expr]) -> Option<Sense> {
    if order % 2 == 1 {
        return Some(Sense::Both);
    }
    let symbol = slope(g);
    let whole = crate::spectrum::expression(g, symbol, polynomial);
    // In the direction (0, 1) the form is its last coefficient.
    let last = polynomial
        .get(order)
        .map_or(Some(Ordering::Equal), |&e| sign_of(g, e))?;
    if !g.symbols_in(polynomial).is_empty() {
        return None;
    }
    let bound = bound_of(g, &[whole], symbol)?;
    let roots = real_roots(g, whole, symbol, &-bound.clone(), &bound)?;
    let lows = std::iter::once(-bound.clone()).chain(roots.iter().map(|r| r.high.clone()));
    let highs = roots.iter().map(|r| r.low.clone()).chain([bound.clone()]);
    let samples = lows.zip(highs).map(|(a, b)| (a + b) / RBig::from(2));
    let mut signs: Vec<Ordering> = samples
        .map(|at| sign_at(g, whole, symbol, &at))
        .collect::<Option<_>>()?;
    signs.push(last);
    let has = |sign: Ordering| signs.contains(&sign);
    match (has(Ordering::Greater), has(Ordering::Less)) {
        (true, true) => Some(Sense::Both),
        // Where the form vanishes in some direction it is not definite.
        _ if !roots.is_empty() || has(Ordering::Equal) => {
            has(Ordering::Less).then_some(Sense::Both)
        }
        (true, false) => Some(Sense::Positive),
        (false, true) => Some(Sense::Negative),
        (false, false) => None,
    }
}

fn degenerate(about: &About<'_>) -> Vec<Degenerate> {
    let own = &about.expansion;
    if !own.own.characteristics.manifold.implicit.is_empty() || !own.is_smooth() {
        return Vec::new();
    }
    let jets = about.integrals();
    let levels = Levels::of(own, jets);
    let bundles = about.finite_bundles(jets);
    let of = |bundle: &Bundle| of_bundle(about, (jets, &levels), bundle);
    bundles.iter().filter_map(of).collect()
}

fn of_bundle(
    about: &About<'_>,
    (jets, levels): (&[Jet], &Levels),
    bundle: &Bundle,
) -> Option<Degenerate> {
    let (g, own) = (about.graph(), &about.expansion);
    let size = bundle.form.len();
    let mut rows = bundle.form.clone();
    let pivots = echelon(g, &mut rows, size);
    let mut columns = pivots.columns.clone();
    columns.sort_unstable();
    // A form that is not degenerate is decided by itself; one that has a negative direction beside a positive one decides nothing.
    let is_small = (1..=2).contains(&(size - columns.len()));
    if size == 0 || !is_small || bundle.weights.len() != jets.len() {
        return None;
    }
    let beside: Vec<Vec<Expr>> = columns
        .iter()
        .map(|&r| columns.iter().map(|&c| bundle.form[r][c]).collect())
        .collect();
    let minors = minors(g, &beside);
    let is_semidefinite = |minors: &[Expr]| {
        let signs: Option<Vec<Ordering>> = minors.iter().map(|&e| sign_of(g, e)).collect();
        signs.is_none_or(|signs| is_positive(&signs) || is_negative(&signs))
    };
    if !is_semidefinite(&minors) {
        return None;
    }
    let (first, further) = first_term(about, (jets, levels), bundle)?;
    // On finite constraints the potential energy is looked at where they hold.
    let is_energy = |(jet, &w): (&Jet, &Expr)| match jet.name.as_str() {
        ENERGY => sign_of(g, w) == Some(Ordering::Greater),
        FINITE => true,
        _ => g.is_zero(w),
    };
    Some(Degenerate {
        text: bundle.text.clone(),
        falls: bundle.falls,
        nonzero: [bundle.nonzero.clone(), pivots.values, further].concat(),
        minors,
        first,
        is_potential: jets.iter().zip(&bundle.weights).all(is_energy) && own.is_natural_at_rest(),
    })
}

/// `W_m`, and what was divided by.
fn first_term(
    about: &About<'_>,
    (jets, levels): (&[Jet], &Levels),
    bundle: &Bundle,
) -> Option<(Term, Vec<Expr>)> {
    let (g, own) = (about.graph(), &about.expansion);
    let n = own.variables().len();
    let weighted = jets.iter().zip(&bundle.weights);
    let weighted: Vec<Expr> = weighted
        .filter(|(_, &w)| !g.is_zero(w))
        .map(|(jet, &w)| Some(g.mul(&[w, jet.value?])))
        .collect::<Option<_>>()?;
    let of_levels: Vec<Expr> = levels
        .jets
        .iter()
        .map(|jet| jet.value)
        .collect::<Option<_>>()?;
    let gradient = own.derivatives(g.add(&weighted));
    let of_integrals: Vec<Vec<Expr>> = of_levels.iter().map(|&e| own.derivatives(e)).collect();
    let start = own.at(&of_levels);
    // Stationary points on the levels: ∇V + Σ μ ∇F = 0 and F = F⁰.
    let equations = |deviations: &[Expr]| -> Vec<Expr> {
        let (z, multipliers) = deviations.split_at(n);
        let there = own.beside(&gradient, z);
        let slopes: Vec<Vec<Expr>> = of_integrals.iter().map(|row| own.beside(row, z)).collect();
        let row = |c: usize| {
            let terms = multipliers
                .iter()
                .zip(&slopes)
                .map(|(&m, own)| g.mul(&[m, own[c]]));
            g.add(&std::iter::once(there[c]).chain(terms).collect::<Vec<_>>())
        };
        let values = own.beside(&of_levels, z).into_iter().zip(&start);
        let changes = values.map(|(there, &here)| g.sub(there, here));
        (0..n).map(row).chain(changes).collect()
    };
    let jacobian = jacobian_of(g, (jets, levels), &bundle.weights, n);
    let (vectors, mut nonzero) = kernel(g, &jacobian, jacobian.len());
    let direction: Vec<Expr> = match vectors.as_slice() {
        [one] => one.clone(),
        [one, other] => {
            let s = g.symbol_expr(slope(g));
            let sum = |(&a, &b): (&Expr, &Expr)| g.add(&[a, g.mul(&[s, b])]);
            one.iter().zip(other).map(sum).collect()
        }
        _ => return None,
    };
    let branching = Branching {
        graph: g,
        equations: &equations,
        jacobian: &jacobian,
        direction: &direction,
        weights: &direction,
    };
    let Leading {
        order,
        coefficient,
        nonzero: further,
    } = branching.leading()?;
    nonzero.extend(further);
    // The equation is the slope of W.
    let order = order + 1;
    let values = match vectors.len() {
        1 => Values::Line(closed(g, g.div(coefficient, g.integer(order as i64)))),
        _ => Values::Plane(coefficients(g, coefficient, slope(g))?),
    };
    Some((Term { order, values }, nonzero))
}

/// The second derivatives of `V + Σ μ F` by the variables and μ.
fn jacobian_of(
    g: &Graph,
    (jets, levels): (&[Jet], &Levels),
    weights: &[Expr],
    n: usize,
) -> Vec<Vec<Expr>> {
    let count = levels.jets.len();
    let second = |r: usize, c: usize| {
        let terms = jets.iter().zip(weights);
        let terms = terms.map(|(jet, &w)| g.mul(&[w, jet.hessian[r][c]]));
        closed(g, g.add(&terms.collect::<Vec<_>>()))
    };
    let entry = |r: usize, c: usize| match (r.checked_sub(n), c.checked_sub(n)) {
        (None, None) => second(r, c),
        (None, Some(i)) => levels.jets[i].gradient[r],
        (Some(i), None) => levels.jets[i].gradient[c],
        (Some(_), Some(_)) => g.zero(),
    };
    let all = 0..n + count;
    let row = |r: usize| all.clone().map(|c| entry(r, c)).collect();
    all.clone().map(row).collect()
}
