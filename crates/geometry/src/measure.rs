//! `measure.invariant`: an invariant measure with a smooth density in the coordinates.
//!
//! In the chart (t, q, η) of the constraint manifold the measure `N dq dη` is kept by the motion when `X̄ ln N = -div X̄`. Where the
//! motion is free of the time so is N: with the time any density can be carried along. For N(q), or
//! N(t, q) where the motion contains the time, the left side is `Z σ`, σ = ln N, affine in η for constraints affine in the velocities;
//! hence `div X̄ = d_0 + d_i η^i` is necessary, and then `Y_i σ = -d_i`, `Y_0 σ = -d_0`. These have a solution near almost every
//! place exactly when the values forced on brackets agree ([`crate::flag`]). For constraints with roots of velocities, densities that
//! contain powers of these are searched too. In a frame of left-invariant fields on a group
//! that is Kozlov's condition for Suslov's problem (1988), generalized by Jovanović (1998); for Chaplygin's systems it is that of
//! Stanchenko (1989) and of Cantrijn, Cortés, de León and Martín de Diego (2002).
//!
//! A contradiction excludes densities of the coordinates only; when no smooth positive density exists at all is the matter of
//! `excluded`. What is known on formulas is in `formula`.

mod angles;
mod excluded;
mod formula;

use crate::flag::{horizontal, Directed, Flag, Obstacle};
use crate::noether::ansatz::Ansatz;
use crate::noether::family::{coefficients, CoefficientLetter, Letter};
use crate::noether::found::readable;
use crate::noether::motion::Motion;
use crate::noether::occurring::{congruent, Letters};
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::{Characteristics, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Node, Symbol, Verdict};
use std::sync::Arc;

/// `measure.invariant`.
#[derive(Clone, Copy, Debug)]
pub struct InvariantMeasure;

/// The most functions among which a density is looked for.
const MEMBERS: usize = 260;

/// The highest weight of these functions.
const WEIGHT: u32 = 4;

/// Determinants of larger matrices are not formed.
const DETERMINANT: usize = 4;

/// What is known of the measure.
#[derive(Clone, Debug)]
pub struct Measure {
    /// The density N, where it has a formula in the family.
    pub density: Option<Expr>,
    /// Whether there is one, with evidence.
    pub verdict: Verdict,
    /// The divergence of X̄.
    pub divergence: Option<Expr>,
    /// Names of the velocities η.
    pub velocities: Vec<String>,
    /// What a formula too long for a sentence contains, in words.
    words: &'static str,
}

/// Of densities of functions that occur, of `det W̄`, and of its root.
const WORDS: [&str; 3] = [
    "",
    ", the determinant of the mass matrix on admissible velocities",
    " with the root of the determinant of the mass matrix on admissible velocities",
];

/// The motion in a chart of the constraint manifold, with its divergence.
struct Flow<'a> {
    motion: Motion<'a>,
    chart: Characteristics,
    /// Rates of η.
    rates: Vec<Expr>,
    divergence: Expr,
    autonomous: bool,
}

impl<'a> Flow<'a> {
    fn of(cx: &Context<'a>) -> Result<Flow<'a>, String> {
        let (system, g) = (cx.system, &cx.system.graph);
        let motion = Motion::of(cx)?;
        let chart = basis(cx)
            .characteristics()
            .map_err(|problem| problem.to_string())?;
        let definitions: Vec<Expr> = chart.parameters.iter().map(|p| p.definition).collect();
        let rates = chart.restrict(system, &motion.derivatives(&definitions));
        let mut parts: Vec<Expr> = (0..system.n())
            .map(|s| {
                let mut unit = vec![g.zero(); system.n()];
                unit[s] = g.one();
                chart.by_coordinates(system, &chart.velocities[s..=s], &unit)[0]
            })
            .collect();
        let slopes = chart.by_parameters(system, &rates);
        parts.extend((0..chart.k()).map(|i| slopes[i][i]));
        let divergence = g.add(&parts);
        let mut all = rates.clone();
        all.extend(&chart.velocities);
        let time = g.symbol("t", 0);
        let time = g.as_symbol(time);
        // The time may cancel in the equations: what counts is the motion.
        let autonomous = g
            .symbols_in(&all)
            .into_iter()
            .all(|s| match Some(s) == time {
                true => all.iter().all(|&e| is_free(cx, e, s)),
                false => system.prescribed_rate(s).is_none(),
            });
        Ok(Flow {
            motion,
            chart,
            rates,
            divergence,
            autonomous,
        })
    }

    fn symbols(&self) -> Vec<Symbol> {
        self.chart.parameters.iter().map(|p| p.symbol).collect()
    }

    fn at(&self, system: &System, e: Expr, one: Option<usize>) -> Expr {
        let g = &system.graph;
        let pairs: Vec<(Expr, Expr)> = self
            .chart
            .parameters
            .iter()
            .enumerate()
            .map(|(i, p)| (p.value, if Some(i) == one { g.one() } else { g.zero() }))
            .collect();
        g.substitute(e, &pairs)
    }

    /// `Z N + N div X̄` for functions N(t, q).
    fn defects(&self, system: &System, densities: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let rates = self.chart.frozen_derivative(system, densities);
        let pairs = rates.into_iter().zip(densities);
        pairs
            .map(|(rate, &n)| g.add(&[rate, g.mul(&[n, self.divergence])]))
            .collect()
    }

    /// A density of the family that is kept, not proved yet.
    fn density(&self, cx: &Context<'_>) -> Option<(Expr, &'static str)> {
        let letters = self.letters(cx, self.autonomous);
        let plain = self.density_in(cx, &letters).map(|n| (n, WORDS[0]));
        plain.or_else(|| {
            let mut more = letters.clone();
            more.push(self.root_of_mass(cx)?);
            Some((self.density_in(cx, &more)?, WORDS[2]))
        })
    }

    /// A density that contains the time, for a motion free of it, where functions of the time occur or are stated.
    fn density_in_time(&self, cx: &Context<'_>) -> Option<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let time = g.symbol("t", 0);
        let letters = self.letters(cx, false);
        let own = g.symbols_in(&[time]);
        let is_timed =
            |c: &CoefficientLetter| c.letter.value != time && g.contains_any(c.letter.value, &own);
        if !self.autonomous || !letters.iter().any(is_timed) {
            return None;
        }
        let density = self.density_in(cx, &letters)?;
        let defect = self.defects(system, &[density]);
        let on = "on the constraint manifold";
        let verdict = cx
            .prover
            .identity(system, &defect, &self.chart.manifold, on);
        matches!(verdict, Verdict::Proved(_)).then_some(density)
    }

    fn density_in(&self, cx: &Context<'_>, letters: &[CoefficientLetter]) -> Option<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let (manifold, own) = (&self.chart.manifold, self.symbols());
        let seed = cx.prover.points_seed();
        let candidates = self.candidates(cx, letters);
        let values: Vec<Vec<Expr>> = candidates.iter().map(|&n| vec![n]).collect();
        let ansatz = Ansatz::new(&self.motion, &values, manifold, &own, seed).ok()?;
        let independent = ansatz.independent()?;
        let candidates: Vec<Expr> = independent.iter().map(|&i| candidates[i]).collect();
        let columns: Vec<Vec<Expr>> = self
            .defects(system, &candidates)
            .into_iter()
            .map(|defect| vec![defect])
            .collect();
        let ansatz = Ansatz::new(&self.motion, &columns, manifold, &own, seed).ok()?;
        let found = ansatz.up_to(1)?.pop()?;
        let parts: Vec<Expr> = found
            .iter()
            .zip(&candidates)
            .filter(|(c, _)| !g.is_zero(**c))
            .map(|(&c, &n)| g.mul(&[c, n]))
            .collect();
        Some(formula::plain(cx, self, readable(g, g.add(&parts))))
    }

    /// The functions of (t, q) that occur; of q only where densities free of the time are asked for.
    fn letters(&self, cx: &Context<'_>, timeless: bool) -> Vec<CoefficientLetter> {
        let g = &cx.system.graph;
        let time = g.symbol("t", 0);
        let mut letters = Letters::of(cx).coefficients;
        letters.retain(|c| !timeless || !g.contains_any(c.letter.value, &g.symbols_in(&[time])));
        for own in &mut letters {
            // Velocities as quasi-velocities have such factors.
            own.exponents.0 = match g.node(own.letter.value) {
                Node::Apply { .. } => -2,
                _ => -1,
            };
        }
        letters
    }

    /// Monomials in letters, simple ones first.
    fn candidates(&self, cx: &Context<'_>, letters: &[CoefficientLetter]) -> Vec<Expr> {
        let g = &cx.system.graph;
        let mut members = coefficients(letters, 0, 1);
        for weight in 2..=WEIGHT {
            let next = coefficients(letters, 0, weight);
            if next.len() > MEMBERS {
                break;
            }
            members = next;
        }
        members.truncate(MEMBERS);
        let value = |member: &[(usize, i8)]| {
            let powers = member.iter();
            let powers = powers.map(|&(l, e)| g.powi(letters[l].letter.value, i64::from(e)));
            g.mul(&powers.collect::<Vec<_>>())
        };
        members.iter().map(|(_, member)| value(member)).collect()
    }

    /// det W̄ where it contains velocities, for Lagrangians that are not quadratic, with the proof that it is kept: Liouville's
    /// theorem where the constraints are integrable.
    fn liouville(&self, cx: &Context<'_>) -> Option<(Expr, Verdict)> {
        let (system, g) = (cx.system, &cx.system.graph);
        let det = self.determinant(cx)?;
        if !g.contains_any(det, &self.symbols()) || !self.is_wanted(det) {
            return None;
        }
        let defect = self.full_defects(system, &[det]);
        let (manifold, on) = (&self.chart.manifold, "on the constraint manifold");
        let verdict = cx.prover.identity(system, &defect, manifold, on);
        let density = formula::plain(cx, self, readable(g, det));
        matches!(verdict, Verdict::Proved(_)).then_some((density, verdict))
    }

    /// A density of products of functions of (t, q) with powers of the roots that contain velocities, as ρ of a cone: these vanish
    /// only where the constraints are singular. With the proof that it is kept.
    fn with_roots(&self, cx: &Context<'_>) -> Option<(Expr, Verdict)> {
        let (system, g) = (cx.system, &cx.system.graph);
        let roots = self.roots(cx);
        if roots.is_empty() {
            return None;
        }
        let (manifold, own) = (&self.chart.manifold, self.symbols());
        let seed = cx.prover.points_seed();
        let candidates = self.candidates(
            cx,
            &[&roots[..], &self.letters(cx, self.autonomous)].concat(),
        );
        let columns: Vec<Vec<Expr>> = self
            .full_defects(system, &candidates)
            .into_iter()
            .map(|defect| vec![defect])
            .collect();
        let ansatz = Ansatz::new(&self.motion, &columns, manifold, &own, seed).ok()?;
        let found = ansatz.up_to(1)?.pop()?;
        let pairs = found.iter().zip(&candidates);
        let parts: Vec<Expr> = pairs.map(|(&c, &n)| g.mul(&[c, n])).collect();
        let density = formula::plain(cx, self, readable(g, g.add(&parts)));
        // Members may depend on each other, and a combination may vanish.
        if g.is_free_of(density, &|s| self.motion.moves(s) || own.contains(&s)) {
            return None;
        }
        let defect = self.full_defects(system, &[density]);
        let on = "on the constraint manifold";
        let verdict = cx.prover.identity(system, &defect, manifold, on);
        let vanishes = cx.prover.identity(system, &[density], manifold, on);
        let is_one =
            matches!(verdict, Verdict::Proved(_)) && matches!(vanishes, Verdict::Refuted(_));
        is_one.then_some((density, verdict))
    }

    /// Whether densities may contain an expression: the time only where the motion does.
    fn is_wanted(&self, e: Expr) -> bool {
        let g = &self.motion.system.graph;
        !self.autonomous || !g.contains_any(e, &g.symbols_in(&[g.symbol("t", 0)]))
    }

    /// Roots with velocities in L and the constraints, as functions on N.
    fn roots(&self, cx: &Context<'_>) -> Vec<CoefficientLetter> {
        let (system, g) = (cx.system, &cx.system.graph);
        let mut all = vec![system.lagrangian];
        all.extend(system.constraints.iter().map(|c| c.f));
        let velocities = system.velocity_symbols();
        let is_root = |&e: &Expr| match g.node(e) {
            Node::Power { base, exponent } => {
                g.as_integer(*exponent).is_none() && g.contains_any(*base, &velocities)
            }
            _ => false,
        };
        let roots: Vec<Expr> = g.reachable(&all).into_iter().filter(is_root).collect();
        let roots = self.chart.restrict(system, &roots);
        let letters = roots
            .into_iter()
            .filter(|&e| self.is_wanted(e))
            .map(|root| CoefficientLetter {
                letter: Letter::plain(root),
                exponents: (-3, 2),
                weight: 1,
            });
        letters.collect()
    }

    /// `X̄ N + N div X̄` for functions on N.
    fn full_defects(&self, system: &System, densities: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let direction = Direction {
            time: g.one(),
            coordinates: self.chart.velocities.clone(),
            parameters: self.rates.clone(),
        };
        let rates = self.chart.along(system, densities, &direction);
        let pairs = rates.into_iter().zip(densities);
        pairs
            .map(|(rate, &n)| g.add(&[rate, g.mul(&[n, self.divergence])]))
            .collect()
    }

    /// The root of the determinant of the restricted mass matrix: its square is Liouville's density in these variables where the
    /// constraints are integrable, itself is a factor of Chaplygin's for his sphere.
    fn root_of_mass(&self, cx: &Context<'_>) -> Option<CoefficientLetter> {
        let g = &cx.system.graph;
        let det = self.determinant(cx)?;
        let moves = |s: Symbol| self.motion.moves(s);
        let is_of_place = !g.contains_any(det, &self.symbols()) && !g.is_free_of(det, &moves);
        let wanted = is_of_place && self.is_wanted(det);
        wanted.then(|| CoefficientLetter {
            letter: Letter::plain(g.sqrt(det)),
            exponents: (-1, 2),
            weight: 1,
        })
    }

    /// det Bᵀ W B, of few velocities.
    fn determinant(&self, cx: &Context<'_>) -> Option<Expr> {
        let (system, n, k) = (cx.system, cx.system.n(), self.chart.k());
        if k > DETERMINANT || k == 0 {
            return None;
        }
        let mass = self.chart.restrict(system, &cx.terms.mass_matrix.concat());
        let mass: Vec<Vec<Expr>> = mass.chunks(n).map(<[Expr]>::to_vec).collect();
        let restricted = congruent(system, &mass, &self.chart.basis);
        Some(determinant(&system.graph, &restricted))
    }
}

/// Whether an expression does not depend on a symbol, by its form or by its derivative.
fn is_free(cx: &Context<'_>, e: Expr, s: Symbol) -> bool {
    let g = &cx.system.graph;
    let nowhere = chetaev_mechanics::Manifold::default();
    let slope = |e: Expr| cx.prover.identity(cx.system, &[g.diff(e, s)], &nowhere, "");
    !g.contains_any(e, &[s]) || matches!(slope(e), Verdict::Proved(_))
}

/// What is known of the invariant measure of the context's system, computed once; a sentence where it cannot be.
pub fn measure(cx: &Context<'_>) -> Arc<Result<Measure, String>> {
    cx.shared(|cx| {
        if cx.is_out_of_time() {
            return Err("the time for claims was spent before it".into());
        }
        let flow = Flow::of(cx)?;
        Ok(decided(cx, &flow))
    })
}

fn decided(cx: &Context<'_>, flow: &Flow<'_>) -> Measure {
    let known = |density, verdict, words| Measure {
        density,
        verdict,
        divergence: Some(flow.divergence),
        velocities: flow
            .chart
            .parameters
            .iter()
            .map(|p| p.name.clone())
            .collect(),
        words,
    };
    let (system, manifold) = (cx.system, &flow.chart.manifold);
    if let Some((density, words)) = flow.density(cx) {
        let defect = flow.defects(system, &[density]);
        let on = "on the constraint manifold";
        let verdict = cx.prover.identity(system, &defect, manifold, on);
        if matches!(verdict, Verdict::Proved(_)) {
            let verdict = angles::returning(cx, flow, density, verdict);
            return known(Some(density), verdict, words);
        }
    }
    if let Some((density, verdict)) = flow.liouville(cx) {
        return known(Some(density), verdict, WORDS[1]);
    }
    if let Some((density, verdict)) = flow.with_roots(cx) {
        return known(Some(density), verdict, WORDS[0]);
    }
    known(None, without_formula(cx, flow), WORDS[0])
}

/// The verdict where no formula was found.
fn without_formula(cx: &Context<'_>, flow: &Flow<'_>) -> Verdict {
    let by_brackets = by_brackets(cx, flow, &[]);
    if matches!(by_brackets, Verdict::Proved(_)) {
        return angles::around(cx, flow, by_brackets);
    }
    let mut verdict = excluded::excluded(cx, flow).unwrap_or_else(|| match by_brackets {
        Verdict::Refuted(found) => Verdict::undecided(format!(
            "{}; densities that contain velocities are not excluded",
            found.detail
        )),
        other => other,
    });
    if let Some(density) = flow.density_in_time(cx) {
        let text = cx.system.graph.text(density);
        let more = format!(
            "; N dt dq dη is kept for N = {text}, which changes with the time, and so is no measure on the states of a motion free of it"
        );
        match &mut verdict {
            Verdict::Refuted(found) => found.detail.push_str(&more),
            Verdict::Undecided { tried } => tried.push_str(&more),
            _ => {}
        }
    }
    verdict
}

/// Whether a density exists that does not contain some of the coordinates, and follows by a quadrature: the admissible fields and
/// their brackets have to give the derivatives of its logarithm in all directions.
///
/// # Errors
/// A sentence that says why the motion is not known.
pub fn free_of(cx: &Context<'_>, coordinates: &[usize]) -> Result<Verdict, String> {
    let flow = Flow::of(cx)?;
    let full = cx.system.n() + usize::from(!flow.autonomous);
    Ok(match flag(cx, &flow, coordinates) {
        Ok(Some(flag)) if flag.fields.len() == full => exists(flag),
        Ok(Some(_)) => Verdict::undecided("the brackets do not determine the density"),
        Ok(None) => not_affine(cx, &flow),
        Err(verdict) => *verdict,
    })
}

/// Whether a density exists, without its formula; free of the coordinates with these indices.
fn by_brackets(cx: &Context<'_>, flow: &Flow<'_>, free: &[usize]) -> Verdict {
    match flag(cx, flow, free) {
        Ok(Some(flag)) => exists(flag),
        Ok(None) => not_affine(cx, flow),
        Err(verdict) => *verdict,
    }
}

/// What the derivatives of ln N along admissible fields generate; none for constraints nonlinear in the velocities; a verdict
/// where there is no density of the coordinates, or where that is not known.
fn flag(cx: &Context<'_>, flow: &Flow<'_>, free: &[usize]) -> Result<Option<Flag>, Box<Verdict>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let Ok((mut fields, mut drift)) = horizontal(system, &flow.chart) else {
        return Ok(None);
    };
    let rest = flow.at(system, flow.divergence, None);
    drift.value = g.neg(rest);
    let mut affine = vec![flow.divergence, drift.value];
    for (i, (field, p)) in fields.iter_mut().zip(&flow.chart.parameters).enumerate() {
        let slope = g.sub(flow.at(system, flow.divergence, Some(i)), rest);
        field.value = g.neg(slope);
        affine.push(g.mul(&[field.value, p.value]));
    }
    let residual = g.add(&affine);
    let on = "on the constraint manifold";
    let linear = cx
        .prover
        .identity(system, &[residual], &flow.chart.manifold, on);
    match linear {
        Verdict::Proved(_) => {}
        Verdict::Refuted(mut found) => {
            found.detail = format!(
                "the divergence of the motion is not affine in the velocities, so no density depends on the coordinates only; {}",
                found.detail
            );
            return Err(Box::new(Verdict::Refuted(found)));
        }
        other => return Err(Box::new(other)),
    }
    let drift_matters = !flow.autonomous || drift.place.iter().any(|&e| !g.is_zero(e));
    let is_steady = g.is_zero(drift.value) && !drift_matters;
    if flow.autonomous && !is_steady {
        drift.time = g.zero();
    }
    if !is_steady {
        fields.push(drift);
    }
    fields.extend(free.iter().map(|&i| {
        let unit = (0..system.n()).map(|j| if i == j { g.one() } else { g.zero() });
        Directed {
            time: g.zero(),
            place: unit.collect(),
            value: g.zero(),
        }
    }));
    closed(cx, flow, &fields).map(Some)
}

/// For constraints nonlinear in the velocities: only a divergence that vanishes, or a density of the family.
fn not_affine(cx: &Context<'_>, flow: &Flow<'_>) -> Verdict {
    let on = "on the constraint manifold";
    let manifold = &flow.chart.manifold;
    let zero = cx
        .prover
        .identity(cx.system, &[flow.divergence], manifold, on);
    match zero {
        Verdict::Proved(_) => {
            zero.prefixed("dq dη is invariant, N = 1, as the divergence of the motion vanishes")
        }
        _ => Verdict::undecided(
            "the constraints are not affine in the velocities; no density was found among the functions of the coordinates that occur and their products with powers of the roots that contain velocities"
        ),
    }
}

/// Where the values on the brackets agree.
fn exists(flag: Flag) -> Verdict {
    match flag.verdict {
        Verdict::Proved(mut proof) => {
            proof.on = "near almost every place".into();
            proof.detail = "near almost every place a density exists, as the values that its logarithm has along the admissible fields and their brackets agree; its formula is not among the functions searched".into();
            Verdict::Proved(proof)
        }
        other => other,
    }
}

/// Whether the values on the brackets agree; a contradiction refutes densities of the coordinates.
fn closed(cx: &Context<'_>, flow: &Flow<'_>, fields: &[Directed]) -> Result<Flag, Box<Verdict>> {
    match Flag::of(cx, fields, !flow.autonomous, true) {
        Ok(flag) => Ok(flag),
        Err(Obstacle::Undecided(tried)) => Err(Box::new(Verdict::undecided(tried))),
        Err(Obstacle::Contradiction(verdict)) => Err(Box::new(match *verdict {
            Verdict::Refuted(mut found) => {
                found.detail = format!("{CONTRADICTION}; {}", found.detail);
                Verdict::Refuted(found)
            }
            other => other,
        })),
    }
}

/// What contradicting brackets say.
const CONTRADICTION: &str = "no density depends on the coordinates only: what the divergence asks of its logarithm along admissible fields contradicts their brackets";

impl Claim for InvariantMeasure {
    fn id(&self) -> &'static str {
        "measure.invariant"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "A smooth measure is invariant"
    }

    fn explanation(&self) -> &'static str {
        "On the constraint manifold with coordinates q and independent (quasi-)velocities η, which the verdict names, the measure N dq dη is invariant when X̄ ln N = -div X̄. For a motion free of the time N is free of it too, as a density that changes with the time can always be carried along. A density N(q), N(t, q) for motions that contain the time, is searched among functions that occur in the model, by linear equations, and proved. Without a formula the claim is decided by brackets: the divergence must be affine in the velocities, it then prescribes the derivatives of ln N along the admissible fields, and a density exists near almost every place exactly when these values agree on all brackets. For Suslov's problem this is Kozlov's condition (1988; Jovanović 1998), for Chaplygin's systems that of Stanchenko (1989) and of Cantrijn, Cortés, de León and Martín de Diego (2002). The claim is refuted only where no smooth positive density N(q, η) exists at all, rest included: where the divergence does not vanish at states of rest or on a steady motion that only turns angles; where ln N would change over a turn of an angle; and where rest is admissible, the accelerations have there neither terms without velocities nor linear ones, and the brackets contradict each other: then the terms of its equation that are linear in the velocities are those for N at rest. Where brackets contradict each other otherwise, densities that contain velocities are not excluded, and the claim is undecided."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.frame-regular".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let measure = measure(cx);
        let measure = match measure.as_ref() {
            Ok(measure) => measure,
            Err(why) => return Verdict::undecided(why.clone()).into(),
        };
        let g = &cx.system.graph;
        let all = match cx.system.fixed_functions().is_empty() {
            true => "",
            false => " and dq that of all coordinates, without the holonomic constraints, whose derivatives alone are imposed",
        };
        let with = format!("with η = ({}){all}", measure.velocities.join(", "));
        let mut formulas = Vec::new();
        let mut verdict = measure.verdict.clone();
        if let Some(density) = measure.density {
            formulas.push(Formula {
                caption: format!("the density N of the invariant measure N dq dη, {with}"),
                left: None,
                right: density,
            });
            if let Verdict::Proved(proof) = &mut verdict {
                let text = g.text(density);
                let what = match text.chars().count() <= LONGEST {
                    true => format!("for N = {text}"),
                    false => format!("for the N stated{}", measure.words),
                };
                proof.detail = format!("N dq dη, {with}, is invariant {what}; {}", proof.detail);
            }
        }
        if let Some(divergence) = measure.divergence {
            let shown = readable(g, divergence);
            if g.reachable(&[shown]).len() <= SHOWN {
                formulas.push(Formula {
                    caption: "the divergence of the motion".into(),
                    left: None,
                    right: shown,
                });
            }
        }
        Finding { verdict, formulas }
    }
}

/// Longer densities are shown as formulas only.
const LONGEST: usize = 160;

/// Larger divergences, in nodes, are not shown.
const SHOWN: usize = 80;
