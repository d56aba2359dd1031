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
//! `excluded`. What is known on formulas is in `formula`, densities that are products of any powers in `products`.

mod angles;
mod classes;
mod dissipated;
mod edges;
mod excluded;
mod flow;
mod formula;
mod jumps;
mod products;
mod states;
mod told;
mod valued;

use crate::flag::{horizontal, Directed, Flag, Obstacle};
use crate::noether::shown::readable;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::equations::unused_letter;
use chetaev_symbolic::{Expr, Verdict};
use flow::Flow;
pub(crate) use formula::on_both_sides;
pub(crate) use jumps::arguments_of_signs;
use std::sync::Arc;
pub(crate) use valued::at_stated_values;

/// `measure.invariant`.
#[derive(Clone, Copy, Debug)]
pub struct InvariantMeasure;

/// What is known of the measure.
#[derive(Clone, Debug)]
pub struct Measure {
    /// The density N, where it has a formula in the family.
    pub density: Option<Expr>,
    /// That N dq dη is kept near every place where N is neither zero nor infinite.
    pub kept: Option<Verdict>,
    /// Where N may be zero, infinite or not smooth.
    pub edges: edges::Edges,
    /// Coordinates that may be angles of which the model does not say so, and after a turn of which N does not return.
    pub unrolled: Vec<String>,
    /// A density N(t, q) of `N dt dq dη`, for a motion free of the time that keeps one with the time although none without was found,
    /// with its proof.
    pub with_time: Option<(Expr, Verdict)>,
    /// A density that contains velocities and is kept near every state where it is neither zero nor infinite, where none was found that
    /// is smooth and positive everywhere, with its proof.
    pub local: Option<(Expr, Verdict)>,
    /// Whether there is one, with evidence.
    pub verdict: Verdict,
    /// The divergence of X̄.
    pub divergence: Option<Expr>,
    /// Names of the velocities η.
    pub velocities: Vec<String>,
    /// Whether it is one for the values of parameters alone that the model states.
    pub as_stated: bool,
    /// What a formula too long for a sentence contains, in words.
    words: &'static str,
}

/// Of densities of functions that occur, of `det W̄`, of its root, and of powers of factors.
const WORDS: [&str; 4] = [
    "",
    ", the determinant of the mass matrix on admissible velocities",
    " with the root of the determinant of the mass matrix on admissible velocities",
    ", a product of powers of functions that occur and of factors of the determinant of the mass matrix on admissible velocities",
];

/// What is known of the invariant measure of the context's system, computed once; a sentence where it cannot be.
pub fn measure(cx: &Context<'_>) -> Arc<Result<Measure, String>> {
    cx.shared(|cx| {
        if cx.is_out_of_time() {
            return Err("the time for claims was spent before it".into());
        }
        let flow = Flow::of(cx)?;
        let measure = jumps::limited(cx, &flow, decided(cx, &flow));
        Ok(valued::as_stated(cx, &flow, measure))
    })
}

/// What the search finds, unless states exclude a density that is smooth and positive there, since what was found is singular
/// then, or it does not return after the turn of an angle.
fn decided(cx: &Context<'_>, flow: &Flow<'_>) -> Measure {
    let (mut measure, g) = (searched(cx, flow), &cx.system.graph);
    let (Some(density), Some(kept)) = (measure.density, measure.kept.clone()) else {
        // Brackets tell of almost every place, and the states may be the others.
        let is_local = matches!(measure.verdict, Verdict::Proved(_));
        if let Some(verdict) = excluded::at_states(cx, flow).filter(|_| is_local) {
            measure.verdict = verdict;
        }
        return measure.or_exponential(cx, flow).or_local(cx, flow);
    };
    if let Some(mut verdict) = excluded::at_states(cx, flow) {
        if let Verdict::Refuted(found) = &mut verdict {
            let (n, text) = (density_letter(cx), g.text(density));
            let more = format!(
                "; {n} = {text} is kept near places only where it is neither zero nor infinite"
            );
            found.detail.push_str(&more);
        }
        measure.density = None;
        measure.verdict = verdict;
        return measure;
    }
    let (density, kept) = measure.returning(cx, flow, density, kept);
    measure.edges = edges::edges(cx, flow, density);
    let density = formula::positive_beyond(cx, density);
    measure.density = Some(density);
    measure.unrolled = angles::unrolled(cx, flow, density);
    measure.verdict = angles::returning(cx, flow, density, kept);
    match measure.edges.ends() {
        false => measure,
        true => measure.or_exponential(cx, flow),
    }
}

impl Measure {
    /// The density found, or, where it does not return after a turn of an angle, another one that does: a wheel that rolls keeps
    /// functions of the way x = R a and of its angle a, and the way may stand for the angle.
    fn returning(
        &mut self,
        cx: &Context<'_>,
        flow: &Flow<'_>,
        density: Expr,
        kept: Verdict,
    ) -> (Expr, Verdict) {
        let open = angles::open(cx, density);
        if open.is_empty() {
            return (density, kept);
        }
        match products::density(cx, flow, &open) {
            Some(found) if angles::open(cx, found.0).is_empty() => {
                self.words = WORDS[3];
                self.kept = Some(found.1.clone());
                found
            }
            _ => (density, kept),
        }
    }

    /// With a product of powers of Darboux polynomials that contains velocities, where no density was found.
    fn or_local(mut self, cx: &Context<'_>, flow: &Flow<'_>) -> Measure {
        if self.density.is_some() || !flow.autonomous {
            return self;
        }
        let local = products::density_with_velocities(cx, flow);
        self.local = local.map(|(density, proof)| (formula::positive_beyond(cx, density), proof));
        if let Some((density, _)) = &self.local {
            let more = format!(
                "; {} dq dη with {0} = {} is kept near every state where {0} is neither zero nor infinite",
                density_letter(cx),
                cx.system.graph.text(readable(&cx.system.graph, *density))
            );
            match &mut self.verdict {
                Verdict::Refuted(found) => found.detail.push_str(&more),
                Verdict::Undecided { tried } => tried.push_str(&more),
                _ => {}
            }
        }
        self
    }

    /// With a density that contains velocities in an exponential, where one is found and nothing is decided, or where the density
    /// found ends.
    fn or_exponential(mut self, cx: &Context<'_>, flow: &Flow<'_>) -> Measure {
        if !flow.autonomous || matches!(self.verdict, Verdict::Refuted(_)) {
            return self;
        }
        if let Some((density, kept)) = flow.exponential(cx) {
            let edges = edges::edges(cx, flow, density);
            // Another density that ends says no more than the one found.
            if self.density.is_some() && edges.ends() {
                return self;
            }
            self.verdict = angles::returning(cx, flow, density, kept.clone());
            self.kept = Some(kept);
            self.density = Some(density);
            self.edges = edges;
            self.unrolled = angles::unrolled(cx, flow, density);
            self.words = WORDS[0];
        }
        self
    }
}

fn searched(cx: &Context<'_>, flow: &Flow<'_>) -> Measure {
    let known = |density: Option<Expr>, verdict: Verdict, words| Measure {
        density,
        kept: density.map(|_| verdict.clone()),
        edges: edges::Edges::default(),
        unrolled: Vec::new(),
        with_time: None,
        local: None,
        verdict,
        divergence: Some(flow.divergence),
        velocities: flow
            .chart
            .parameters
            .iter()
            .map(|p| p.name.clone())
            .collect(),
        as_stated: false,
        words,
    };
    let (system, manifold) = (cx.system, &flow.chart.manifold);
    if let Some((density, words)) = flow.density(cx) {
        let verdict = match products::proved(cx, flow, density) {
            Some(verdict) => verdict,
            None => {
                let defect = flow.defects(system, &[density]);
                let on = "on the constraint manifold";
                cx.prover.identity(system, &defect, manifold, on)
            }
        };
        if matches!(verdict, Verdict::Proved(_)) {
            return known(Some(density), verdict, words);
        }
    }
    if let Some((density, verdict)) = flow.liouville(cx) {
        return known(Some(density), verdict, WORDS[1]);
    }
    if let Some((density, verdict)) = flow.with_roots(cx) {
        return known(Some(density), verdict, WORDS[0]);
    }
    // Products of powers may be singular: none is looked for where a smooth density is excluded.
    let by_brackets = by_brackets(cx, flow, &[]);
    let excluded = match by_brackets {
        Verdict::Proved(_) => None,
        _ => excluded::excluded(cx, flow),
    };
    if excluded.is_none() && !matches!(by_brackets, Verdict::Refuted(_)) {
        if let Some((density, verdict)) = products::density(cx, flow, &[]) {
            return known(Some(density), verdict, WORDS[3]);
        }
    }
    let with_time = flow.density_in_time(cx);
    let text = with_time.as_ref().map(|(n, _)| cx.system.graph.text(*n));
    Measure {
        with_time,
        ..known(
            None,
            without_formula(cx, flow, (by_brackets, excluded), text),
            WORDS[0],
        )
    }
}

/// The verdict where no formula was found, but perhaps one `with_time`.
fn without_formula(
    cx: &Context<'_>,
    flow: &Flow<'_>,
    (by_brackets, excluded): (Verdict, Option<Verdict>),
    with_time: Option<String>,
) -> Verdict {
    if let Verdict::Proved(mut proof) = by_brackets {
        proof.detail.push_str(classes::sources(cx, flow));
        return angles::around(cx, flow, Verdict::Proved(proof));
    }
    let mut verdict = excluded.unwrap_or_else(|| match by_brackets {
        Verdict::Refuted(found) => Verdict::undecided(format!(
            "{}; densities that contain velocities are not excluded",
            found.detail
        )),
        other => other,
    });
    if let Some(text) = with_time {
        let n = density_letter(cx);
        let more = format!(
            "; {n} dt dq dη is kept for {n} = {text}, which changes with the time, and so is no measure on the states of a motion free of it"
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
/// their brackets have to give the derivatives of its logarithm in all directions along which `integrals` without velocities are
/// kept. Along further fields on the coordinates, `turns`, its logarithm has the rates stated.
///
/// # Errors
/// A sentence that says why the motion is not known.
pub fn free_of(
    cx: &Context<'_>,
    coordinates: &[usize],
    turns: &[(Vec<Expr>, Expr)],
    integrals: &[Expr],
) -> Result<Verdict, String> {
    let flow = Flow::of(cx)?;
    // Integrals without velocities are kept along all fields: on their levels so many directions less are missing.
    let leaves = flow.independent_of_velocities(cx, integrals);
    let full =
        (cx.system.n() + flow.masses.len() + usize::from(!flow.autonomous)).saturating_sub(leaves);
    let verdict = match flag(cx, &flow, coordinates, turns) {
        Ok(Some(flag)) if flag.fields.len() >= full => exists(flag),
        Ok(Some(_)) => Verdict::undecided("the brackets do not determine the density"),
        Ok(None) => not_affine(cx, &flow),
        Err(verdict) => *verdict,
    };
    Ok(jumps::beside_all(cx, &flow, verdict))
}

/// Whether a density exists, without its formula; free of the coordinates with these indices.
fn by_brackets(cx: &Context<'_>, flow: &Flow<'_>, free: &[usize]) -> Verdict {
    match flag(cx, flow, free, &[]) {
        Ok(Some(flag)) => exists(flag),
        Ok(None) => not_affine(cx, flow),
        Err(verdict) => *verdict,
    }
}

/// What the derivatives of ln N along admissible fields generate; none for constraints nonlinear in the velocities; a verdict
/// where there is no density of the coordinates, or where that is not known.
fn flag(
    cx: &Context<'_>,
    flow: &Flow<'_>,
    free: &[usize],
    turns: &[(Vec<Expr>, Expr)],
) -> Result<Option<Flag>, Box<Verdict>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let Ok((mut fields, mut drift)) = horizontal(system, &flow.chart) else {
        return Ok(None);
    };
    affine(cx, flow)?;
    let rates = flow.masses.iter().map(|(_, rate)| *rate);
    let all: Vec<Expr> = rates.chain([flow.divergence]).collect();
    let rest: Vec<Expr> = all.iter().map(|&e| flow.at(system, e, None)).collect();
    let directed = |field: &mut Directed, parts: Vec<Expr>| {
        field.place.extend(&parts[..parts.len() - 1]);
        field.value = g.neg(parts[parts.len() - 1]);
    };
    for (i, field) in fields.iter_mut().enumerate() {
        let pairs = all.iter().zip(&rest);
        let slopes = pairs.map(|(&e, &rest)| g.sub(flow.at(system, e, Some(i)), rest));
        directed(field, slopes.collect());
    }
    directed(&mut drift, rest);
    let drift_matters = !flow.autonomous || drift.place.iter().any(|&e| !g.is_zero(e));
    let is_steady = g.is_zero(drift.value) && !drift_matters;
    if flow.autonomous && !is_steady {
        drift.time = g.zero();
    }
    if !is_steady {
        fields.push(drift);
    }
    fields.extend(free.iter().map(|&i| {
        let size = system.n() + flow.masses.len();
        let unit = (0..size).map(|j| if i == j { g.one() } else { g.zero() });
        Directed {
            time: g.zero(),
            place: unit.collect(),
            value: g.zero(),
        }
    }));
    fields.extend(turns.iter().map(|(coordinates, value)| {
        let masses = flow.masses.iter().map(|_| g.zero());
        Directed {
            time: g.zero(),
            place: coordinates.iter().copied().chain(masses).collect(),
            value: *value,
        }
    }));
    closed(cx, flow, &fields).map(Some)
}

/// Whether rates of masses and the divergence are affine in the velocities η.
fn affine(cx: &Context<'_>, flow: &Flow<'_>) -> Result<(), Box<Verdict>> {
    for &(mass, rate) in &flow.masses {
        if !matches!(is_affine(cx, flow, rate), Verdict::Proved(_)) {
            return Err(Box::new(Verdict::undecided(format!(
                "the rate of {} is not seen to be affine in the velocities",
                cx.system.graph.symbol_name(mass)
            ))));
        }
    }
    match is_affine(cx, flow, flow.divergence) {
        Verdict::Proved(_) => Ok(()),
        Verdict::Refuted(mut found) => {
            found.detail = format!(
                "the divergence of the motion is not affine in the velocities, so no density depends on the coordinates only; {}",
                found.detail
            );
            Err(Box::new(Verdict::Refuted(found)))
        }
        other => Err(Box::new(other)),
    }
}

/// Whether a function is affine in the velocities η: it is what its values at rest and at units make of it, or, where it is not
/// defined at rest, its second derivatives vanish.
fn is_affine(cx: &Context<'_>, flow: &Flow<'_>, e: Expr) -> Verdict {
    let (system, g) = (cx.system, &cx.system.graph);
    let (manifold, on) = (&flow.chart.manifold, "on the constraint manifold");
    let rest = flow.at(system, e, None);
    let mut parts = vec![e, g.neg(rest)];
    for (i, p) in flow.chart.parameters.iter().enumerate() {
        let slope = g.sub(flow.at(system, e, Some(i)), rest);
        parts.push(g.neg(g.mul(&[slope, p.value])));
    }
    let verdict = cx.prover.identity(system, &[g.add(&parts)], manifold, on);
    if matches!(verdict, Verdict::Proved(_) | Verdict::Refuted(_)) {
        return verdict;
    }
    let own = flow.symbols();
    let second = own.iter().enumerate().flat_map(|(i, &s)| {
        let slope = g.diff(e, s);
        own[..=i].iter().map(move |&other| g.diff(slope, other))
    });
    let second: Vec<Expr> = second.collect();
    cx.prover.identity(system, &second, manifold, on)
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
            zero.prefixed("dq dη is invariant, as the divergence of the motion vanishes")
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

/// The letter of the density, which nothing in the model is called.
fn density_letter(cx: &Context<'_>) -> String {
    unused_letter(cx.system, &["N", "D", "F", "W"])
}

/// What contradicting brackets say.
const CONTRADICTION: &str = "no density depends on the coordinates only: the slopes that its logarithm would need along the admissible directions fit no function, as they contradict each other on brackets of these directions";

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
        "On the constraint manifold with coordinates q and independent (quasi-)velocities η, which the verdict names, the measure N dq dη is invariant when X̄ ln N = -div X̄ (N dq dη dM with masses M that have a law of their own). For a motion free of the time N is free of it too, as a density that changes with the time can always be carried along. A density N(q), N(t, q) for motions that contain the time, is searched among functions that occur in the model, by linear equations, and proved; then among products of powers of these and of the factors of det W̄, the determinant of the mass matrix on admissible velocities, whose exponents are solved for; where such a factor may be negative and its exponent is not whole its absolute value stands in N. Where none of these is smooth and positive everywhere an exponential of polynomials in the velocities with such coefficients is looked for, by itself and times the root of det W det W̄. Where N may be zero or infinite, or a function in it has a pole or jumps, is stated. N²/(det W det W̄) is the same function whatever the variables: where it is neither zero nor infinite though N is, these variables end and N in others does not; elsewhere N is a density on each side by itself. Where the mass matrices are singular or infinite the masses may not determine the motion, as where a mass vanishes or a constraint has no gradient; where they do, seen by W bordered with the gradients of the constraints, only the variables end, and in others N is zero or infinite. A density that changes with the time only tells at which rate the motion contracts volumes; it counts for motions that contain the time. Where the rates jump, as by dry friction -sign(x'), what is proved is conditional: a continuous density is kept across only where its flux is the same from both sides. Without a formula the claim is decided by brackets: the divergence must be affine in the velocities, it then prescribes the derivatives of ln N along the admissible fields, and a density exists near almost every place exactly when these values agree on all brackets. For Suslov's problem this is Kozlov's condition (1988; Jovanović 1998), for Chaplygin's systems that of Stanchenko (1989) and of Cantrijn, Cortés, de León and Martín de Diego (2002). The claim is refuted only where no smooth positive density N(q, η) exists at all, rest included: where the divergence does not vanish at states of rest or on a steady motion that only turns angles, whatever formula holds elsewhere (such states are looked for by Newton's iteration for the values that the model states, and proved to exist by its interval form); where ln N would change over a turn of an angle; where the energy has a strict minimum at rest at the origin of the coordinates and its rate keeps one sign without being zero, so that motions carry small neighbourhoods into smaller ones; and where rest is admissible, the accelerations have there neither terms without velocities nor linear ones, and the brackets contradict each other: then the terms of its equation that are linear in the velocities are those for N at rest. Where brackets contradict each other otherwise, densities that contain velocities are not excluded, and the claim is undecided. Parameters are arbitrary, but those that others define; where the values that the model states decide otherwise the verdict is conditional on them."
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
        let (mut formulas, mut verdict) = (Vec::new(), measure.verdict.clone());
        if let Some(density) = measure.density {
            formulas.push(told::formula(cx, measure, density));
            if let Verdict::Proved(proof) | Verdict::Conditional { proof, .. } = &mut verdict {
                told::tell(cx, measure, density, proof);
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

/// Larger divergences, in nodes, are not shown.
const SHOWN: usize = 80;
