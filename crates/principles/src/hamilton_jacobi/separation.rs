//! Separation of variables in the coordinates given: the conditions of Levi-Civita (1904) on H₁, and a complete integral by
//! quadratures.
//!
//! The conditions are divided by Hⁱ Hʲ where they are derived. Where Hⁱ = ∂H₁/∂π_i vanishes identically, as it does for a coordinate that
//! a constraint holds, `H₁(q, S_q) = E` differentiated by q_i leaves H_i = 0, for the open set of π that a complete integral reaches: then H₁
//! must not contain q_i at all.
//!
//! Where the conditions hold `dπ_i = −(H_i/Hⁱ) dq_i` is integrable, and along a line on which q_i alone changes H₁ is constant. So π_i,
//! a function of q_i and constants, is the root of `H₁(c, q_i; π°, π_i) = E` with the other coordinates at any values c and their momenta
//! π° there: no Stäckel matrix is needed. Constants are E, the momenta of cyclic coordinates, and of the others the squares of
//! their momenta at c; all radicands are then linear in E and these squares.

use super::applicable::{
    checked, fixed, free, momenta_on_motions, momenta_with, multipliers, no_closed_form, told,
};
use super::complete::verified;
use super::extremum::Extremum;
use chetaev_mechanics::claims::formulation::{basis, manifold};
use chetaev_mechanics::claims::{Context, Finding};
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::{kappa_symbols, DeriveError};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::system::CompleteIntegral;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Graph, Node, Symbol, Verdict};

/// Larger H₁, in nodes, are not differentiated twice.
const LARGEST: usize = 2_000;
/// At most so many points are tried.
const POINTS: usize = 256;
/// A smaller value is zero.
const VANISHING: f64 = 1e-9;

/// For each pair i < j, what vanishes where `H₁(q, S_q) = E` separates additively in the coordinates:
/// `Hⁱ Hʲ H_ij − Hⁱ H_j H_iʲ − H_i Hʲ Hⁱ_j + H_i H_j Hⁱʲ`, with lower indices for ∂/∂q, upper ones for ∂/∂π.
pub fn levi_civita(cx: &Context<'_>, extremum: &Extremum) -> Vec<Expr> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let coordinates = system.coordinate_symbols();
    let lower = g.gradient(extremum.hamiltonian, &coordinates);
    let upper = g.gradient(extremum.hamiltonian, &extremum.symbols);
    let mut conditions = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            let (q, p) = (coordinates[j], extremum.symbols[j]);
            let second = |e: Expr, s: Symbol| g.diff(e, s);
            conditions.push(g.add(&[
                g.mul(&[upper[i], upper[j], second(lower[i], q)]),
                g.neg(g.mul(&[upper[i], lower[j], second(lower[i], p)])),
                g.neg(g.mul(&[lower[i], upper[j], second(upper[i], q)])),
                g.mul(&[lower[i], lower[j], second(upper[i], p)]),
            ]));
        }
    }
    conditions
}

pub(super) fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let g = &cx.system.graph;
    let Some(mut extremum) = Extremum::new(cx) else {
        return Ok(no_closed_form(cx).into());
    };
    if g.reachable(&[extremum.hamiltonian]).len() > LARGEST {
        return Ok(Verdict::undecided("H₁ is too large for the conditions of Levi-Civita").into());
    }
    // A factor that cancels would leave coordinates in H₁ that it does not depend on.
    extremum.hamiltonian = short(cx, extremum.hamiltonian);
    if essential(cx, &extremum).len() <= 1 {
        if let Some(integral) = separated(cx, &extremum) {
            let what = "H₁ depends on one coordinate at most; separated by that, S is";
            let found = checked(cx, &extremum, &integral, what)?;
            if matches!(found.verdict, Verdict::Proved(_)) {
                return Ok(found);
            }
        }
    }
    let on = "for all q and π";
    if let Some(refuted) = without_momentum(cx, &extremum, on) {
        return Ok(refuted.into());
    }
    let conditions = levi_civita(cx, &extremum);
    let named: Vec<(String, Expr)> = conditions
        .iter()
        .map(|&e| ("an expression of Levi-Civita".to_string(), e))
        .collect();
    let mut verdict = cx.prover.named_identity(cx.system, &named, &free(), on);
    let sentence = match &verdict {
        Verdict::Proved(_) => {
            "S_t + H₁ = 0 separates in these coordinates, S = −E t + Σ S_i(q_i): the conditions of Levi-Civita hold"
        }
        Verdict::Refuted(_) => {
            "S_t + H₁ = 0 does not separate in these coordinates; it may in others"
        }
        _ => "the conditions of Levi-Civita on H₁",
    };
    verdict.prefix(sentence);
    if !matches!(verdict, Verdict::Proved(_)) {
        return Ok(verdict.into());
    }
    let integral = match quadratures(cx, &extremum) {
        Ok(integral) => integral,
        Err(why) => {
            verdict.prefix(&format!("the quadratures are not written: {why}"));
            return Ok(verdict.into());
        }
    };
    let checks = verified(cx, &extremum, &integral)?;
    let what = "the conditions of Levi-Civita hold; separated in these coordinates S is";
    let found = told(cx, &integral, checks.clone(), what);
    if matches!(found.verdict, Verdict::Proved(_)) {
        return Ok(Finding {
            verdict: verdict.and(found.verdict),
            formulas: found.formulas,
        });
    }
    let proved = |v: &Verdict| matches!(v, Verdict::Proved(_));
    let complete = [&checks.equation, &checks.nondegenerate, &checks.theorem];
    let rest = match &found.verdict {
        Verdict::Refuted(_) if complete.into_iter().all(proved) => {
            of_extremals(cx, &extremum, &integral)?
        }
        Verdict::Refuted(_) => {
            "S as these quadratures give it is not confirmed as a complete integral".into()
        }
        other => format!(
            "whether the quadratures give motions was not decided: {}",
            other.detail()
        ),
    };
    verdict.prefix(&rest);
    Ok(Finding {
        verdict,
        formulas: found.formulas,
    })
}

/// What the curves of a complete integral are, not all of which are motions.
fn of_extremals(
    cx: &Context<'_>,
    extremum: &Extremum,
    integral: &CompleteIntegral,
) -> Result<String, DeriveError> {
    let mut sentence = "S as these quadratures give it is a complete integral of S_t + H₁ = 0, and β = ∂S/∂α are constant along its curves, which are \
        extremals; not all of them are motions"
        .to_string();
    let method = cx.finding("hamilton-jacobi.applicable");
    match &method.verdict {
        Verdict::Conditional { condition, .. } => {
            sentence.push_str(&format!(" (motions are those with {condition})"));
        }
        _ => sentence.push_str(
            ", and `motion = { … }` in [complete_integral] can state the constants that motions have",
        ),
    }
    for (place, motion) in on_sets(cx, integral) {
        let own = CompleteIntegral {
            motion,
            ..integral.clone()
        };
        if matches!(verified(cx, extremum, &own)?.motion, Verdict::Proved(_)) {
            let fixed = fixed(cx, &own);
            sentence.push_str(&format!("; those{fixed} are motions with {place}"));
        }
    }
    Ok(sentence)
}

/// Constants of cyclic coordinates that are zero on the sets of motions that make the action stationary, with the equations of each set.
fn on_sets(cx: &Context<'_>, integral: &CompleteIntegral) -> Vec<(String, Vec<(Symbol, Expr)>)> {
    let g = &cx.system.graph;
    let constants = integral.constants.iter().copied();
    let slopes = g.gradient(integral.action, &cx.system.coordinate_symbols());
    let cyclic: Vec<(usize, Symbol)> = constants
        .filter_map(|alpha| {
            Some((
                slopes.iter().position(|&e| e == g.symbol_expr(alpha))?,
                alpha,
            ))
        })
        .collect();
    let kappa = kappa_symbols(&basis(cx));
    let momenta = momenta_with(cx, &kappa);
    let zero_on = |(place, values): (String, Vec<Expr>)| {
        let zero = cyclic.iter().filter(|(i, _)| g.is_zero(values[*i]));
        let zero: Vec<(Symbol, Expr)> = zero.map(|&(_, alpha)| (alpha, g.zero())).collect();
        (!zero.is_empty()).then_some((place, zero))
    };
    let on = crate::stationarity::on_sets(cx, &momenta, &kappa);
    on.into_iter().filter_map(zero_on).collect()
}

/// That a coordinate occurs in H₁ without its momentum, so that no S of the form separates.
fn without_momentum(cx: &Context<'_>, extremum: &Extremum, on: &str) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    let identity = |named: &[(String, Expr)]| cx.prover.named_identity(system, named, &free(), on);
    let alone = system.coordinates.iter().enumerate().find_map(|(i, c)| {
        let slope = g.diff(extremum.hamiltonian, c.q_symbol);
        let speed = g.diff(extremum.hamiltonian, extremum.symbols[i]);
        let absent = identity(&[("∂H₁/∂π".into(), speed)]);
        let contains = || identity(&[(format!("∂H₁/∂{}", c.name), slope)]);
        if !matches!(absent, Verdict::Proved(_)) {
            return None;
        }
        Some((&c.name, contains())).filter(|(_, v)| !matches!(v, Verdict::Proved(_)))
    });
    let (name, mut verdict) = alone?;
    let sentence = match &verdict {
        Verdict::Refuted(_) => format!(
            "S_t + H₁ = 0 does not separate in these coordinates: H₁ contains {name} and not π_{name}, so that H₁(q, S_q) = E with \
             S = −E t + Σ S_i(q_i) cannot hold for all {name}; it may in other coordinates"
        ),
        _ => format!("whether H₁, which does not contain π_{name}, contains {name}"),
    };
    verdict.prefix(&sentence);
    Some(verdict)
}

/// The coordinates that occur in H₁.
fn essential(cx: &Context<'_>, extremum: &Extremum) -> Vec<usize> {
    let coordinates = cx.system.coordinate_symbols();
    let occurs = |i: &usize| {
        cx.system
            .graph
            .contains_any(extremum.hamiltonian, &[coordinates[*i]])
    };
    (0..cx.system.n()).filter(occurs).collect()
}

/// The complete integral `S = −E t + Σ α q + Σ ∫π_i dq_i`: α for the coordinates that are cyclic in H₁, a quadrature for each of the
/// others. Where these are two or more, H₁ must be even in their momenta, and S is one only under the conditions of Levi-Civita.
/// `None` where H₁ gives no quadratures of this form.
pub fn separated(cx: &Context<'_>, extremum: &Extremum) -> Option<CompleteIntegral> {
    quadratures(cx, extremum).ok()
}

/// [`separated`], or what prevents it, in words.
fn quadratures(cx: &Context<'_>, extremum: &Extremum) -> Result<CompleteIntegral, &'static str> {
    let (system, g) = (cx.system, &cx.system.graph);
    let time = g.intern_symbol("t", 0);
    if system.is_rheonomic(extremum.hamiltonian) {
        return Err("H₁ contains the time");
    }
    let mut own = essential(cx, extremum);
    if own.is_empty() {
        // Where every coordinate is cyclic, the last one whose momentum occurs gives its constant to E.
        let occurs = |&i: &usize| g.contains_any(extremum.hamiltonian, &[extremum.symbols[i]]);
        let last = (0..system.n()).rev().find(occurs);
        own.push(last.ok_or("H₁ contains no momentum")?);
    }
    let named = |name: &str| g.intern_symbol(&unused_name(system, name), 0);
    let energy = named("E");
    let mut constants = vec![energy];
    let mut momenta = extremum.momenta.clone();
    let mut parts = vec![g.neg(g.mul(&[g.symbol_expr(energy), g.symbol_expr(time)]))];
    let mut cyclic = Vec::new();
    let coordinates = system.coordinates.iter().enumerate();
    for (i, c) in coordinates.filter(|(i, _)| !own.contains(i)) {
        let alpha = named(&format!("alpha_{}", c.name));
        constants.push(alpha);
        cyclic.push((i, alpha));
        momenta[i] = g.symbol_expr(alpha);
        parts.push(g.mul(&[momenta[i], c.q]));
    }
    let quadratures = match own.as_slice() {
        [only] => {
            let root = momentum(cx, extremum, *only, &momenta, energy);
            let why = "H₁ = E is no quadratic equation for the momentum of the one coordinate that H₁ contains";
            vec![(*only, root.ok_or(why)?)]
        }
        several => {
            let squares = several[1..].iter();
            let squares: Vec<Symbol> = squares
                .map(|&i| named(&format!("alpha_{}", system.coordinates[i].name)))
                .collect();
            constants.extend(&squares);
            let of = extremum.at(cx, extremum.hamiltonian, &momenta);
            let momenta = Squares::new(cx, extremum, several, of)?.momenta(cx, energy, &squares);
            momenta.ok_or(
                "a momentum from H₁ = E at fixed other coordinates is not seen to be free of these",
            )?
        }
    };
    Ok(CompleteIntegral {
        action: g.add(&parts),
        constants,
        quadratures,
        motion: on_motions(cx, &cyclic),
    })
}

/// `H₁ = h₀ + ½ Σ h_e π_e²` over the coordinates e that it contains, and values c of these at which h₀ and h_e have finite values,
/// h_e ≠ 0.
struct Squares {
    own: Vec<usize>,
    rest: Expr,
    factors: Vec<Expr>,
    base: Vec<(Expr, Expr)>,
}

impl Squares {
    fn new(
        cx: &Context<'_>,
        extremum: &Extremum,
        own: &[usize],
        of: Expr,
    ) -> Result<Squares, &'static str> {
        let g = &cx.system.graph;
        let zero: Vec<(Expr, Expr)> = own
            .iter()
            .map(|&i| (extremum.momenta[i], g.zero()))
            .collect();
        let symbols: Vec<Symbol> = own.iter().map(|&i| extremum.symbols[i]).collect();
        let slopes = g.gradient(of, &symbols);
        let mut factors = Vec::new();
        for (place, (&slope, &symbol)) in slopes.iter().zip(&symbols).enumerate() {
            let factor = short(cx, g.diff(slope, symbol));
            let momentum = extremum.momenta[own[place]];
            let odd = short(cx, g.sub(slope, g.mul(&[factor, momentum])));
            if g.contains_any(factor, &symbols) || !g.is_zero(odd) {
                return Err("H₁ is not even in the momenta of the coordinates it contains");
            }
            if g.is_zero(factor) {
                return Err("H₁ contains a coordinate without the square of its momentum");
            }
            factors.push(factor);
        }
        let rest = short(cx, g.substitute(of, &zero));
        let base = regular_point(cx, own, &factors, rest);
        let base = base.ok_or("no simple position was found at which H₁ is regular")?;
        Ok(Squares {
            own: own.to_vec(),
            rest,
            factors,
            base,
        })
    }

    /// `π_e = √(2 (E − h₀ − ½ Σ h_f A_f)/h_e)` at c but q_e, with A_f = π_f² at c: constants for all but the first, whose A follows from E.
    fn momenta(
        &self,
        cx: &Context<'_>,
        energy: Symbol,
        squares: &[Symbol],
    ) -> Option<Vec<(usize, Expr)>> {
        let (system, g) = (cx.system, &cx.system.graph);
        let minus_half = g.div(g.integer(-1), g.integer(2));
        let mut known: Vec<Option<Expr>> = vec![None];
        known.extend(squares.iter().map(|&s| Some(g.symbol_expr(s))));
        let square = |place: usize, known: &[Option<Expr>], at: &[(Expr, Expr)]| {
            let mut parts = vec![g.symbol_expr(energy), g.neg(self.rest)];
            for (f, (&factor, value)) in self.factors.iter().zip(known).enumerate() {
                if let Some(value) = value.filter(|_| f != place) {
                    parts.push(g.mul(&[minus_half, factor, value]));
                }
            }
            let value = g.div(g.mul(&[g.integer(2), g.add(&parts)]), self.factors[place]);
            short(cx, g.substitute(value, at))
        };
        known[0] = Some(square(0, &known, &self.base));
        let pairs = self.own.iter().enumerate().map(|(place, &i)| {
            let own = system.coordinates[i].q;
            let others: Vec<(Expr, Expr)> = self
                .base
                .iter()
                .copied()
                .filter(|(q, _)| *q != own)
                .collect();
            let radicand = square(place, &known, &others);
            let alone = self.base.iter().all(|&(q, _)| {
                q == own
                    || g.as_symbol(q)
                        .is_some_and(|q| !g.contains_any(radicand, &[q]))
            });
            alone.then(|| (i, g.sqrt(radicand)))
        });
        pairs.collect()
    }
}

/// Simple values of coordinates at which functions are finite and factors do not vanish, seen in double precision.
fn regular_point(
    cx: &Context<'_>,
    own: &[usize],
    factors: &[Expr],
    rest: Expr,
) -> Option<Vec<(Expr, Expr)>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let half = g.div(g.one(), g.integer(2));
    let candidates = [
        g.zero(),
        g.mul(&[half, g.pi()]),
        g.one(),
        half,
        g.integer(2),
    ];
    let mut all = factors.to_vec();
    all.push(rest);
    let angles = angles(g, &all);
    let allowed = |i: usize| -> Vec<Expr> {
        let is_angle = angles.contains(&system.coordinates[i].q_symbol);
        let kept = |e: &&Expr| is_angle || **e != candidates[1];
        candidates.iter().filter(kept).copied().collect()
    };
    let lists: Vec<Vec<Expr>> = own.iter().map(|&i| allowed(i)).collect();
    let count = lists.iter().map(Vec::len).product::<usize>().min(POINTS);
    (0..count).find_map(|number| {
        let mut left = number;
        let mut point = Vec::new();
        for (&i, list) in own.iter().zip(&lists) {
            point.push((system.coordinates[i].q, list[left % list.len()]));
            left /= list.len();
        }
        let values = g.substitute_all(&all, &point);
        let mut state = 0.37_f64;
        let symbols = g.symbols_in(&values);
        let drawn: Vec<f64> = symbols
            .iter()
            .map(|_| {
                state = (state * 7.13 + 0.29).fract();
                0.4 + state
            })
            .collect();
        let value = |s: Symbol| symbols.iter().position(|&own| own == s).map(|i| drawn[i]);
        let numbers = g.evaluate_f64(&values, &value).ok()?;
        let (last, first) = numbers.split_last()?;
        let regular =
            last.is_finite() && first.iter().all(|x| x.is_finite() && x.abs() > VANISHING);
        regular.then_some(point)
    })
}

/// Symbols of the arguments of sines, cosines and their quotients.
fn angles(g: &Graph, es: &[Expr]) -> Vec<Symbol> {
    let arguments = g.reachable(es).into_iter().filter_map(|e| match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } if function.is_circular() => Some(arguments[0]),
        _ => None,
    });
    let arguments: Vec<Expr> = arguments.collect();
    g.symbols_in(&arguments).into_iter().collect()
}

/// π of the one coordinate from `H₁ = E`: a quadratic equation, with the positive root, or a linear one.
fn momentum(
    cx: &Context<'_>,
    extremum: &Extremum,
    own: usize,
    momenta: &[Expr],
    energy: Symbol,
) -> Option<Expr> {
    let g = &cx.system.graph;
    let symbol = extremum.symbols[own];
    let of = extremum.at(cx, extremum.hamiltonian, momenta);
    let of = g.sub(of, g.symbol_expr(energy));
    let zero = [(extremum.momenta[own], g.zero())];
    let slope = g.diff(of, symbol);
    let curvature = g.diff(slope, symbol);
    let curvature = short(cx, curvature);
    if g.contains_any(curvature, &[symbol]) {
        return None;
    }
    let (rest, slope) = (g.substitute(of, &zero), g.substitute(slope, &zero));
    let (rest, slope) = (short(cx, rest), short(cx, slope));
    if g.is_zero(curvature) {
        return (!g.is_zero(slope)).then(|| g.neg(g.div(rest, slope)));
    }
    // ½ c π² + b π + a = 0.
    let radicand = g.sub(
        g.mul(&[slope, slope]),
        g.mul(&[g.integer(2), curvature, rest]),
    );
    // √R/c is one root where c > 0.
    if known_sign(g, curvature, &assumptions(cx.system)).is_positive() {
        let square = short(cx, g.div(radicand, g.mul(&[curvature, curvature])));
        return Some(g.sub(g.sqrt(square), short(cx, g.div(slope, curvature))));
    }
    Some(g.div(g.sub(g.sqrt(short(cx, radicand)), slope), curvature))
}

fn short(cx: &Context<'_>, e: Expr) -> Expr {
    crate::stationarity::by_sines(&cx.system.graph, e)
}

/// What ties the constants of cyclic coordinates on all motions: of the momenta `p + Σ κ ∂f/∂v`, with the κ of the motions, those that are zero
/// or a constant multiple of an earlier one.
fn on_motions(cx: &Context<'_>, cyclic: &[(usize, Symbol)]) -> Vec<(Symbol, Expr)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let has_kappa = multipliers(cx).is_some_and(|kappa| !kappa.is_empty());
    let Some(momenta) = momenta_on_motions(cx).filter(|_| has_kappa) else {
        return Vec::new();
    };
    let vanishes = |e: Expr| {
        let verdict = cx.prover.identity(system, &[e], &manifold(cx), "");
        matches!(verdict, Verdict::Proved(_))
    };
    let mut tied = Vec::new();
    let mut free: Vec<(usize, Symbol)> = Vec::new();
    for &(i, alpha) in cyclic {
        if vanishes(momenta[i]) {
            tied.push((alpha, g.zero()));
            continue;
        }
        let multiple = free.iter().find_map(|&(j, earlier)| {
            let ratio = constant_ratio(cx, momenta[i], momenta[j])?;
            let rest = g.sub(momenta[i], g.mul(&[ratio, momenta[j]]));
            vanishes(rest).then(|| g.mul(&[ratio, g.symbol_expr(earlier)]))
        });
        match multiple {
            Some(value) => tied.push((alpha, value)),
            None => free.push((i, alpha)),
        }
    }
    tied
}

/// The ratio of two functions on the constraint manifold, where it is seen to contain nothing that moves.
fn constant_ratio(cx: &Context<'_>, e: Expr, of: Expr) -> Option<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let solved: Vec<(Expr, Expr)> = manifold(cx)
        .solved
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    let ratio = short(cx, g.substitute(g.div(e, of), &solved));
    let mut moving = system.coordinate_symbols();
    moving.extend(system.velocity_symbols());
    moving.push(g.intern_symbol("t", 0));
    (!g.contains_any(ratio, &moving)).then_some(ratio)
}
