//! First integrals `F e^(-λt)` from functions with `X̄F = λF`, as (x + y) e^(-t) for x' = y, y' = x.
//!
//! Among the functions `c_0 + c_i u_i` of coordinates, functions of the time, and velocities u, then among their products two by two,
//! those whose rates are such functions again are looked for, and of these the largest space that X̄ maps into itself. On it X̄ is a matrix of constants: its eigenvalues λ that are in the
//! parameter field or roots of quadratics over it are formed, with eigenvectors and principal vectors of height two, for which
//! `X̄F = λF + F_1` and `(F - t F_1) e^(-λt)` keeps its value; other quadratic factors λ² + b λ + c give quadratic forms times e^(bt), of one function and of two, and for complex roots
//! functions that turn with the time. For polynomials F these are Darboux polynomials of degree one with
//! constant cofactors (Goriely 2001, ch. 2).

use super::ansatz::Ansatz;
use super::letters::Letters;
use super::motion::Motion;
use super::search::Integral;
use super::shown::{is_constant, readable};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::Context;
use chetaev_symbolic::factors::{coefficients, factored, factors};
use chetaev_symbolic::matrix::{determinant, null_space};
use chetaev_symbolic::quadratic_factors::linear_and_quadratic;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Symbol, Verdict};

/// Characteristic polynomials of larger matrices are not formed.
const LARGEST: usize = 10;

/// Longer eigenvalues, in nodes, make no integrals that a person would read.
const LONGEST: usize = 40;

/// An integral with a function of it that has values over prime fields.
pub(super) struct Eigenfunction {
    pub(super) integral: Integral,
    pub(super) rational: Expr,
}

/// What was found, and where it was looked for.
pub(super) struct Eigenfunctions {
    /// The integrals, each proved.
    pub(super) found: Vec<Eigenfunction>,
    /// Whether products of two coordinates and velocities were members too.
    pub(super) quadratic: bool,
}

/// The integrals of this form, each proved; those with λ = 0 belong to other families. `None` where they could not be searched.
pub(super) fn eigenfunctions(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
) -> Option<Eigenfunctions> {
    let linear = members(cx, motion, letters)?;
    let mut found = of_members(cx, motion, linear.clone())?;
    let products = products(cx, motion, &linear);
    let quadratic = products.and_then(|members| of_members(cx, motion, members));
    let is_searched = quadratic.is_some();
    found.extend(quadratic.unwrap_or_default());
    Some(Eigenfunctions {
        found,
        quadratic: is_searched,
    })
}

fn of_members(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    members: Vec<Expr>,
) -> Option<Vec<Eigenfunction>> {
    let space = Invariant::of(cx, motion, members)?;
    let values = space.eigenvalues(cx)?.into_iter();
    let found: Option<Vec<Vec<Eigenfunction>>> = values
        .map(|value| match value {
            Eigenvalue::Real(value) => space.with_eigenvalue(cx, motion, value),
            Eigenvalue::Pair(b, c) => space.with_pair(cx, motion, (b, c)),
        })
        .collect();
    Some(found?.into_iter().flatten().collect())
}

/// What a factor of the characteristic polynomial gives.
enum Eigenvalue {
    Real(Expr),
    /// The roots of `λ² + b λ + c`, which are not seen to be real.
    Pair(Expr, Expr),
}

/// Functions that X̄ maps into their own span.
struct Invariant {
    members: Vec<Expr>,
    /// Their coefficients.
    functions: Vec<Vec<Expr>>,
    /// X̄ of each is the combination of all with the coefficients of its row.
    rows: Vec<Vec<Expr>>,
}

impl Invariant {
    fn of(cx: &Context<'_>, motion: &Motion<'_>, members: Vec<Expr>) -> Option<Invariant> {
        let g = &cx.system.graph;
        let rates = motion.derivatives(&members);
        let columns: Vec<Vec<Expr>> = rates.iter().chain(&members).map(|&e| vec![e]).collect();
        let seed = cx.prover.points_seed();
        let ansatz = Ansatz::new(motion, &columns, &motion.manifold, &[], seed).ok()?;
        // Σ c_i X̄u_i + Σ d_i u_i = 0: the combination c has the rate -d.
        let found = ansatz.all()?;
        let split = |own: &Vec<Expr>| {
            let (c, d) = own.split_at(members.len());
            (c.to_vec(), d.iter().map(|&e| g.neg(e)).collect())
        };
        let mut pairs: Vec<(Vec<Expr>, Vec<Expr>)> = found.iter().map(split).collect();
        loop {
            if pairs.is_empty() || pairs.len() > 2 * LARGEST {
                return None;
            }
            let (next, rows) = mapped_inside(g, &pairs)?;
            if next.len() == pairs.len() {
                return (pairs.len() <= LARGEST).then(|| Invariant {
                    members,
                    functions: pairs.into_iter().map(|(c, _)| c).collect(),
                    rows,
                });
            }
            pairs = next;
        }
    }

    /// The eigenvalues that are not zero, as far as the characteristic polynomial has factors of degree one and two.
    fn eigenvalues(&self, cx: &Context<'_>) -> Option<Vec<Eigenvalue>> {
        let g = &cx.system.graph;
        // No name of a model contains a bracket.
        let unknown = g.symbol("eigenvalue[]", 0);
        let symbol = g.as_symbol(unknown)?;
        let characteristic = determinant(g, &less(g, &self.rows, unknown));
        let own = factors(g, characteristic, &[symbol])?;
        let own = own.into_iter().flat_map(|(f, _)| split(g, f, symbol));
        let own = own.flat_map(|f| roots(cx, f, symbol));
        let is_wanted = |e: Expr| !g.is_zero(e) && g.reachable(&[e]).len() <= LONGEST;
        let own = own.filter(|value| match value {
            Eigenvalue::Real(value) => is_wanted(*value),
            Eigenvalue::Pair(_, c) => is_wanted(*c),
        });
        Some(own.collect())
    }

    fn with_eigenvalue(
        &self,
        cx: &Context<'_>,
        motion: &Motion<'_>,
        value: Expr,
    ) -> Option<Vec<Eigenfunction>> {
        let g = &cx.system.graph;
        let once = transposed(&less(g, &self.rows, value));
        let twice = product(g, &once, &once);
        let size = self.functions.len();
        // Eigenvectors first, so that principal vectors are new beside them.
        let vectors: Result<Vec<Vec<Vec<Expr>>>, _> = [&once, &twice]
            .into_iter()
            .map(|m| null_space(g, m, size))
            .collect();
        let found = vectors.ok()?.into_iter().flatten().map(|vector| {
            let lower = self.coefficients(g, &times(g, &once, &vector));
            let own = self.coefficients(g, &vector);
            let leading = self.leading(g, &own)?;
            let function = |own: Vec<Expr>| {
                let scaled = own.into_iter().map(|e| readable(g, g.div(e, leading)));
                combined(g, &scaled.collect::<Vec<Expr>>(), &self.members)
            };
            proved(cx, motion, value, (function(own), function(lower)))
        });
        found.collect()
    }

    /// For functions F_1 and F_2 = X̄F_1 with `X̄F_2 = -b F_2 - c F_1`: `(F_2² + b F_1 F_2 + c F_1²) e^(b t)` keeps its value, for real
    /// roots and for others. Where the roots are complex, α ± iω, so does `e^(-αt) ((F_2 - αF_1) cos ωt + ωF_1 sin ωt)`.
    fn with_pair(
        &self,
        cx: &Context<'_>,
        motion: &Motion<'_>,
        (b, c): (Expr, Expr),
    ) -> Option<Vec<Eigenfunction>> {
        let g = &cx.system.graph;
        let map = transposed(&self.rows);
        let mut polynomial = product(g, &map, &map);
        for (i, row) in polynomial.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let constant = if i == j { c } else { g.zero() };
                *entry = g.add(&[*entry, g.mul(&[b, map[i][j]]), constant]);
            }
        }
        let vectors = null_space(g, &polynomial, self.functions.len()).ok()?;
        let functions = vectors.iter().map(|vector| {
            let own = self.coefficients(g, vector);
            let rate = self.coefficients(g, &times(g, &map, vector));
            // The leading coefficient may be that of the rate, where F_1 contains no velocity.
            let leading = self.leading(g, &own).or_else(|| self.leading(g, &rate))?;
            let function = |own: Vec<Expr>| {
                let scaled = own.into_iter().map(|e| readable(g, g.div(e, leading)));
                combined(g, &scaled.collect::<Vec<Expr>>(), &self.members)
            };
            Some((function(own), function(rate)))
        });
        let functions: Vec<(Expr, Expr)> = functions.collect::<Option<_>>()?;
        let mut found = Vec::new();
        for &own in &functions {
            found.extend(pair(cx, motion, (b, c), own)?);
        }
        if functions.len() <= MOST_PAIRED {
            for (i, &own) in functions.iter().enumerate() {
                let others = functions[..i].iter();
                found.extend(others.filter_map(|&other| moment(cx, motion, b, (other, own))));
            }
        }
        Some(found)
    }

    /// The coefficient of the first velocity, or of the first coordinate where there is none.
    fn leading(&self, g: &Graph, own: &[Expr]) -> Option<Expr> {
        let is_velocity = |e: Expr| g.symbols_in(&[e]).iter().any(|&s| g.symbol_order(s) > 0);
        let used = own.iter().zip(&self.members);
        let used = used.filter(|(&c, &e)| !g.is_zero(c) && !g.is_one(e));
        let (first, velocity) = (
            used.clone().next(),
            used.clone().find(|(_, &e)| is_velocity(e)),
        );
        velocity.or(first).map(|(&c, _)| c)
    }

    /// The coefficients of a combination of the functions.
    fn coefficients(&self, g: &Graph, weights: &[Expr]) -> Vec<Expr> {
        let columns = 0..self.members.len();
        let entry = |i: usize| {
            let own: Vec<Expr> = self.functions.iter().map(|c| c[i]).collect();
            combined(g, weights, &own)
        };
        columns.map(entry).collect()
    }
}

/// One, coordinates that are no angles, functions of the time that occur, and velocities, as far as they are linearly independent on
/// the constraint manifold.
fn members(cx: &Context<'_>, motion: &Motion<'_>, letters: &Letters) -> Option<Vec<Expr>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let angles = &letters.coefficients[..letters.circular];
    let is_angle = |q: Expr| angles.iter().any(|c| c.letter.value == g.sin(q));
    let places = system.coordinates.iter().map(|c| c.q);
    let places = places.filter(|&q| !is_angle(q));
    let velocities = letters.velocities.iter().map(|l| l.value);
    let own = system.coordinate_symbols();
    let time = g.symbols_in(&[g.symbol("t", 0)]);
    let timed = letters.coefficients.iter().map(|c| c.letter.value);
    let timed = timed.filter(|&e| g.contains_any(e, &time) && !g.contains_any(e, &own));
    let all = std::iter::once(g.one()).chain(timed).chain(places);
    independent(cx, motion, all.chain(velocities).collect())
}

/// Of more functions with one quadratic factor no two are taken together.
const MOST_PAIRED: usize = 6;

/// The most products of two members.
const PRODUCTS: usize = 30;

/// Products of two members but the time, where there are not too many.
fn products(cx: &Context<'_>, motion: &Motion<'_>, members: &[Expr]) -> Option<Vec<Expr>> {
    let g = &cx.system.graph;
    let time = g.symbol("t", 0);
    let members: Vec<Expr> = members.iter().copied().filter(|&e| e != time).collect();
    if members.len() * (members.len() + 1) / 2 > PRODUCTS {
        return None;
    }
    let pairs = members.iter().enumerate();
    let all = pairs.flat_map(|(i, &a)| members[..=i].iter().map(move |&b| g.mul(&[a, b])));
    independent(cx, motion, all.collect())
}

/// Functions without those that are combinations of others on the constraint manifold.
fn independent(cx: &Context<'_>, motion: &Motion<'_>, all: Vec<Expr>) -> Option<Vec<Expr>> {
    let columns: Vec<Vec<Expr>> = all.iter().map(|&e| vec![e]).collect();
    let seed = cx.prover.points_seed();
    let ansatz = Ansatz::new(motion, &columns, &motion.manifold, &[], seed).ok()?;
    let independent = ansatz.independent()?;
    Some(independent.into_iter().map(|i| all[i]).collect())
}

/// Combinations with their rates, both in the same functions.
type Pairs = Vec<Pair>;

/// A combination with its rate.
type Pair = (Vec<Expr>, Vec<Expr>);

/// Those of the span of combinations whose rates are in it, and their rates by all combinations given.
fn mapped_inside(g: &Graph, pairs: &Pairs) -> Option<(Pairs, Vec<Vec<Expr>>)> {
    let size = pairs.first()?.0.len();
    let count = pairs.len();
    let rows: Vec<Vec<Expr>> = (0..size)
        .map(|i| {
            let own = pairs.iter().map(|(c, _)| c[i]);
            own.chain(pairs.iter().map(|(_, d)| d[i])).collect()
        })
        .collect();
    let found = null_space(g, &rows, 2 * count).ok()?;
    let sum = |weights: &[Expr], of: fn(&Pair) -> &Vec<Expr>| -> Vec<Expr> {
        let entry = |i: usize| {
            let own = weights
                .iter()
                .zip(pairs)
                .map(|(&w, pair)| g.mul(&[w, of(pair)[i]]));
            readable(g, g.add(&own.collect::<Vec<Expr>>()))
        };
        (0..size).map(entry).collect()
    };
    let next = found.iter().map(|own| {
        let weights = &own[count..];
        (sum(weights, |pair| &pair.0), sum(weights, |pair| &pair.1))
    });
    let by_all = found.iter().map(|own| {
        let own = own[..count].iter().map(|&e| readable(g, g.neg(e)));
        own.collect::<Vec<Expr>>()
    });
    Some((next.collect(), by_all.collect()))
}

/// The factors of `a λ⁴ + b λ² + c` whose discriminant as a polynomial in λ² is a square: λ² - w² and λ² + w² of λ⁴ - w⁴.
fn biquadratic(g: &Graph, polynomial: Expr, symbol: Symbol) -> Option<Vec<Expr>> {
    let own = coefficients(g, polynomial, symbol)?;
    let &[c, odd, b, other, a] = own.as_slice() else {
        return None;
    };
    if !g.is_zero(odd) || !g.is_zero(other) {
        return None;
    }
    let square = readable(g, g.sub(g.powi(b, 2), g.mul(&[g.integer(4), a, c])));
    let root = root_or_negative(g, square);
    let is_root = |&e: &Expr| g.as_integer(g.base_exponent(e).1).is_none();
    if g.reachable(&[root]).iter().any(is_root) {
        return None;
    }
    let unknown = g.powi(g.symbol_expr(symbol), 2);
    let below = g.mul(&[g.integer(2), a]);
    let factor = |root: Expr| {
        let value = readable(g, g.div(g.sub(root, b), below));
        g.sub(unknown, value)
    };
    Some(vec![factor(root), factor(g.neg(root))])
}

/// The factors of degree one and two of a polynomial of a higher degree with numbers as coefficients, or in even powers up to the fourth;
/// others as they are.
fn split(g: &Graph, polynomial: Expr, symbol: Symbol) -> Vec<Expr> {
    let numbers = coefficients(g, polynomial, symbol).and_then(|own| {
        let numbers = own.iter().map(|&c| g.as_number(c).cloned());
        numbers.collect::<Option<Vec<_>>>()
    });
    let unknown = g.symbol_expr(symbol);
    match numbers.filter(|own| own.len() > 3) {
        None => biquadratic(g, polynomial, symbol).unwrap_or_else(|| vec![polynomial]),
        Some(own) => linear_and_quadratic(&own)
            .into_iter()
            .map(|factor| {
                let terms = factor.into_iter().zip(0..);
                let terms = terms.map(|(c, n)| g.mul(&[g.number(c), g.powi(unknown, n)]));
                g.add(&terms.collect::<Vec<Expr>>())
            })
            .collect(),
    }
}

/// What the roots of a polynomial of degree one or two are.
fn roots(cx: &Context<'_>, polynomial: Expr, symbol: Symbol) -> Vec<Eigenvalue> {
    let g = &cx.system.graph;
    match coefficients(g, polynomial, symbol).as_deref() {
        Some(&[b, a]) => vec![Eigenvalue::Real(readable(g, g.neg(g.div(b, a))))],
        Some(&[c, b, a]) => {
            let square = g.sub(g.powi(b, 2), g.mul(&[g.integer(4), a, c]));
            let square = readable(g, square);
            if !is_nonnegative(cx, square) {
                let [b, c] = [b, c].map(|e| readable(g, g.div(e, a)));
                return vec![Eigenvalue::Pair(b, c)];
            }
            let root = root_or_negative(g, square);
            let below = g.mul(&[g.integer(2), a]);
            let own = [root, g.neg(root)].map(|root| g.div(g.sub(root, b), below));
            own.map(|e| Eigenvalue::Real(readable(g, e))).into()
        }
        _ => Vec::new(),
    }
}

/// Whether a function of the parameters is seen to be nowhere negative, under the assumptions or for the values that the model states.
fn is_nonnegative(cx: &Context<'_>, e: Expr) -> bool {
    let g = &cx.system.graph;
    let valued = g.substitute(e, &cx.system.parameter_values());
    let stated = assumptions(cx.system);
    // Where it is zero only for the values stated, what is made of its root may have no value there.
    known_sign(g, e, &stated).is_nonnegative() || known_sign(g, valued, &stated).is_positive()
}

/// √e or its negative: squares stand before the root.
fn root_or_negative(g: &Graph, e: Expr) -> Expr {
    let Some(own) = factored(g, e) else {
        return g.sqrt(e);
    };
    let (mut outside, mut inside) = (Vec::new(), vec![g.number(own.coefficient)]);
    for (factor, power) in own.factors {
        outside.push(g.powi(factor, power.div_euclid(2)));
        inside.push(g.powi(factor, power.rem_euclid(2)));
    }
    outside.push(g.sqrt(g.mul(&inside)));
    g.mul(&outside)
}

/// The integral of a function with `X̄F = λF + F_1`, where that and `X̄F_1 = λF_1` are proved; F_1 may be zero.
fn proved(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
    (function, lower): (Expr, Expr),
) -> Option<Eigenfunction> {
    let g = &cx.system.graph;
    let (function, lower) = (readable(g, function), readable(g, lower));
    let rates = motion.derivatives(&[function, lower]);
    let residuals = [
        g.sub(rates[0], g.add(&[g.mul(&[value, function]), lower])),
        g.sub(rates[1], g.mul(&[value, lower])),
    ];
    let on = "on the constraint manifold";
    let verdict = cx
        .prover
        .identity(cx.system, &residuals, &motion.manifold, on);
    if !matches!(verdict, Verdict::Proved(_)) {
        return None;
    }
    let time = g.symbol("t", 0);
    let decay = g.exp(g.neg(g.mul(&[value, time])));
    let verdict = real_where(cx, verdict, &[value, function, lower]);
    let (integral, rational) = match g.is_zero(lower) {
        true => (
            g.mul(&[function, decay]),
            g.sub(g.apply(Function::Log, &[function]), g.mul(&[value, time])),
        ),
        false => (
            g.mul(&[g.sub(function, g.mul(&[time, lower])), decay]),
            g.sub(g.div(function, lower), time),
        ),
    };
    Some(Eigenfunction {
        integral: Integral {
            value: integral,
            shown: integral,
            verdict: verdict.prefixed(match g.is_zero(lower) {
                true => "what stands before the exponential grows or decays at its inverse rate",
                false => "the rate of what stands before the exponential is a multiple of it",
            }),
            independent: true,
            name: None,
        },
        rational,
    })
}

/// For functions F and H with `X̄²F = -b X̄F - c F` and the same of H, `(F X̄H - H X̄F) e^(b t)` keeps its value, as the moment of momentum
/// of an oscillator in the plane does times e^(b t) when it is damped; `None` where it is zero or not proved.
fn moment(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    b: Expr,
    (own, other): ((Expr, Expr), (Expr, Expr)),
) -> Option<Eigenfunction> {
    let g = &cx.system.graph;
    let moment = g.sub(g.mul(&[own.0, other.1]), g.mul(&[other.0, own.1]));
    let moment = readable(g, moment);
    match g.is_zero(moment) {
        true => None,
        false => proved(cx, motion, g.neg(b), (moment, g.zero())),
    }
}

/// What follows from `X̄F_1 = F_2` and `X̄F_2 = -b F_2 - c F_1`, where these are proved.
fn pair(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    (b, c): (Expr, Expr),
    (first, second): (Expr, Expr),
) -> Option<Vec<Eigenfunction>> {
    let g = &cx.system.graph;
    let (first, second) = (readable(g, first), readable(g, second));
    let rates = motion.derivatives(&[first, second]);
    let residuals = [
        g.sub(rates[0], second),
        g.add(&[rates[1], g.mul(&[b, second]), g.mul(&[c, first])]),
    ];
    let on = "on the constraint manifold";
    let verdict = cx
        .prover
        .identity(cx.system, &residuals, &motion.manifold, on);
    if !matches!(verdict, Verdict::Proved(_)) {
        return None;
    }
    let verdict =
        verdict.prefixed("it is made of two functions whose rates are combinations of both");
    let integral = |value: Expr| Integral {
        value,
        shown: value,
        verdict: verdict.clone(),
        independent: true,
        name: None,
    };
    let time = g.symbol("t", 0);
    let form = g.add(&[
        g.powi(second, 2),
        g.mul(&[b, first, second]),
        g.mul(&[c, g.powi(first, 2)]),
    ]);
    let form = readable(g, form);
    let growth = g.exp(g.mul(&[b, time]));
    let mut found = vec![Eigenfunction {
        integral: integral(g.mul(&[form, growth])),
        rational: g.add(&[g.apply(Function::Log, &[form]), g.mul(&[b, time])]),
    }];
    let square = g.sub(c, g.div(g.powi(b, 2), g.integer(4)));
    let square = readable(g, square);
    if is_nonnegative(cx, square) {
        let frequency = readable(g, root_or_negative(g, square));
        let decay = readable(g, g.neg(g.div(b, g.integer(2))));
        let other = readable(g, g.sub(second, g.mul(&[decay, first])));
        let angle = g.mul(&[frequency, time]);
        let turned = g.add(&[
            g.mul(&[other, g.cos(angle)]),
            g.mul(&[frequency, first, g.sin(angle)]),
        ]);
        let turned = readable(g, turned);
        let slope = g.div(other, g.mul(&[frequency, first]));
        let value = g.mul(&[turned, g.exp(g.neg(g.mul(&[decay, time])))]);
        let verdict = real_where(cx, verdict.clone(), &[value]);
        found.push(Eigenfunction {
            integral: Integral {
                verdict,
                ..integral(value)
            },
            rational: g.add(&[g.apply(Function::Atan, &[slope]), angle]),
        });
    }
    Some(found)
}

/// A verdict on what contains roots of functions of the parameters that are seen to be positive for the stated values only: it says where
/// they are real.
fn real_where(cx: &Context<'_>, mut verdict: Verdict, es: &[Expr]) -> Verdict {
    let (system, g) = (cx.system, &cx.system.graph);
    let stated = assumptions(system);
    let mut under_roots: Vec<String> = Vec::new();
    for e in g.reachable(es) {
        let (base, exponent) = g.base_exponent(e);
        let is_root = g.as_number(exponent).is_some_and(|n| !n.is_int());
        if is_root && is_constant(system, base) && !known_sign(g, base, &stated).is_nonnegative() {
            let text = format!("{} > 0", g.text(base));
            if !under_roots.contains(&text) {
                under_roots.push(text);
            }
        }
    }
    if let (Verdict::Proved(proof), false) = (&mut verdict, under_roots.is_empty()) {
        let texts = under_roots.join(" and ");
        proof.on = format!("{}, where {texts}", proof.on);
        proof.detail = format!(
            "it is real where {texts}, as for the values that the model states; {}",
            proof.detail
        );
    }
    verdict
}

/// A square matrix less a multiple of the unit matrix.
fn less(g: &Graph, matrix: &[Vec<Expr>], value: Expr) -> Vec<Vec<Expr>> {
    let mut less = matrix.to_vec();
    for (i, row) in less.iter_mut().enumerate() {
        row[i] = g.sub(row[i], value);
    }
    less
}

fn transposed(matrix: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let columns = 0..matrix.len();
    columns
        .map(|j| matrix.iter().map(|row| row[j]).collect())
        .collect()
}

fn product(g: &Graph, a: &[Vec<Expr>], b: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let columns = transposed(b);
    let row = |own: &Vec<Expr>| columns.iter().map(|c| combined(g, own, c)).collect();
    a.iter().map(row).collect()
}

fn times(g: &Graph, matrix: &[Vec<Expr>], vector: &[Expr]) -> Vec<Expr> {
    matrix.iter().map(|row| combined(g, row, vector)).collect()
}

/// Σ c_i f_i.
fn combined(g: &Graph, c: &[Expr], f: &[Expr]) -> Expr {
    let parts = c.iter().zip(f).map(|(&c, &f)| g.mul(&[c, f]));
    readable(g, g.add(&parts.collect::<Vec<Expr>>()))
}
