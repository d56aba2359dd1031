//! `measure.invariant`: an invariant measure with a smooth density in the coordinates.
//!
//! In the chart (t, q, η) of the constraint manifold the measure `N dq dη` is kept by the motion when `X̄ ln N = -div X̄`. For N(q), or
//! N(t, q) where the motion contains the time, the left side is `Z σ`, σ = ln N, affine in η for constraints affine in the velocities;
//! hence `div X̄ = d_0 + d_i η^i` is necessary, and then `Y_i σ = -d_i`, `Y_0 σ = -d_0`. These have a solution near almost every
//! place exactly when the values forced on brackets agree ([`crate::flag`]). For constraints with roots of velocities, densities that
//! contain powers of these are searched too. In a frame of left-invariant fields on a group
//! that is Kozlov's condition for Suslov's problem (1988), generalized by Jovanović (1998); for Chaplygin's systems it is that of
//! Stanchenko (1989) and of Cantrijn, Cortés, de León and Martín de Diego (2002).

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
}

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
        let autonomous = g
            .symbols_in(&all)
            .into_iter()
            .all(|s| Some(s) != time && system.prescribed_rate(s).is_none());
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
    fn density(&self, cx: &Context<'_>) -> Option<Expr> {
        let letters = self.letters(cx);
        self.density_in(cx, &letters).or_else(|| {
            let mut more = letters.clone();
            more.push(self.root_of_mass(cx)?);
            self.density_in(cx, &more)
        })
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
        let found = ansatz.first()?;
        let parts: Vec<Expr> = found
            .iter()
            .zip(&candidates)
            .filter(|(c, _)| !g.is_zero(**c))
            .map(|(&c, &n)| g.mul(&[c, n]))
            .collect();
        Some(without_constants(&self.motion, readable(g, g.add(&parts))))
    }

    /// The functions of (t, q) that occur; of q where the motion does not contain the time.
    fn letters(&self, cx: &Context<'_>) -> Vec<CoefficientLetter> {
        let g = &cx.system.graph;
        let time = g.symbol("t", 0);
        let mut letters = Letters::of(cx).coefficients;
        letters.retain(|c| {
            !self.autonomous || !g.contains_any(c.letter.value, &g.symbols_in(&[time]))
        });
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
        if !g.contains_any(det, &self.symbols()) {
            return None;
        }
        let defect = self.full_defects(system, &[det]);
        let (manifold, on) = (&self.chart.manifold, "on the constraint manifold");
        let verdict = cx.prover.identity(system, &defect, manifold, on);
        let density = without_constants(&self.motion, readable(g, det));
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
        let candidates = self.candidates(cx, &[&roots[..], &self.letters(cx)].concat());
        let columns: Vec<Vec<Expr>> = self
            .full_defects(system, &candidates)
            .into_iter()
            .map(|defect| vec![defect])
            .collect();
        let ansatz = Ansatz::new(&self.motion, &columns, manifold, &own, seed).ok()?;
        let found = ansatz.first()?;
        let pairs = found.iter().zip(&candidates);
        let parts: Vec<Expr> = pairs.map(|(&c, &n)| g.mul(&[c, n])).collect();
        let density = without_constants(&self.motion, readable(g, g.add(&parts)));
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
        let letters = roots.into_iter().map(|root| CoefficientLetter {
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
        let wanted = !g.contains_any(det, &self.symbols()) && !g.is_free_of(det, &moves);
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

/// A product without the factors that do not move.
fn without_constants(motion: &Motion<'_>, e: Expr) -> Expr {
    let g = &motion.system.graph;
    match g.node(e) {
        Node::Product { factors, .. } => {
            let moving = factors.iter().copied();
            let moving: Vec<Expr> = moving
                .filter(|&f| !g.is_free_of(f, &|s| motion.moves(s)))
                .collect();
            g.mul(&moving)
        }
        _ if g.is_free_of(e, &|s| motion.moves(s)) => g.one(),
        _ => e,
    }
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
    let system = cx.system;
    let manifold = &flow.chart.manifold;
    let on = "on the constraint manifold";
    if let Some(density) = flow.density(cx) {
        let defect = flow.defects(system, &[density]);
        let verdict = cx.prover.identity(system, &defect, manifold, on);
        if matches!(verdict, Verdict::Proved(_)) {
            return Measure {
                density: Some(density),
                verdict,
                divergence: Some(flow.divergence),
            };
        }
    }
    if let Some((density, verdict)) = flow.liouville(cx).or_else(|| flow.with_roots(cx)) {
        return Measure {
            density: Some(density),
            verdict,
            divergence: Some(flow.divergence),
        };
    }
    Measure {
        density: None,
        verdict: by_brackets(cx, flow, &[]),
        divergence: Some(flow.divergence),
    }
}

/// Whether a density exists that does not contain some of the coordinates.
///
/// # Errors
/// A sentence that says why the motion is not known.
pub fn free_of(cx: &Context<'_>, coordinates: &[usize]) -> Result<Verdict, String> {
    Ok(by_brackets(cx, &Flow::of(cx)?, coordinates))
}

/// Whether a density exists, without its formula; free of the coordinates with these indices.
fn by_brackets(cx: &Context<'_>, flow: &Flow<'_>, free: &[usize]) -> Verdict {
    let (system, g) = (cx.system, &cx.system.graph);
    let (mut fields, mut drift) = match horizontal(system, &flow.chart) {
        Ok(found) => found,
        Err(why) => return not_affine(cx, flow, &why),
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
            return Verdict::Refuted(found);
        }
        other => return other,
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
    closed(cx, flow, &fields)
}

/// For constraints nonlinear in the velocities: only a divergence that vanishes, or a density of the family.
fn not_affine(cx: &Context<'_>, flow: &Flow<'_>, why: &str) -> Verdict {
    let on = "on the constraint manifold";
    let manifold = &flow.chart.manifold;
    let zero = cx
        .prover
        .identity(cx.system, &[flow.divergence], manifold, on);
    match zero {
        Verdict::Proved(_) => zero,
        _ => Verdict::undecided(format!(
            "{why}; no density was found among the functions of the coordinates that occur and their products with powers of the roots that contain velocities"
        )),
    }
}

/// Whether the values on the brackets agree.
fn closed(cx: &Context<'_>, flow: &Flow<'_>, fields: &[Directed]) -> Verdict {
    let g = &cx.system.graph;
    match Flag::of(cx, fields, !flow.autonomous, true) {
        Ok(flag) => match flag.verdict {
            Verdict::Proved(mut proof) => {
                proof.on = "near almost every place".into();
                proof.detail = "a density exists, as the values that its logarithm has along the admissible fields and their brackets agree; its formula is not among the functions searched".into();
                Verdict::Proved(proof)
            }
            other => other,
        },
        Err(Obstacle::Undecided(tried)) => Verdict::undecided(tried),
        Err(Obstacle::Contradiction(verdict)) => match *verdict {
            Verdict::Refuted(mut found) => {
                let free = flow
                    .rates
                    .iter()
                    .all(|&rate| g.is_zero(flow.at(cx.system, rate, None)));
                let more = match free && flow.autonomous {
                    true => "; as no force acts on a body at rest, no other smooth positive density exists either",
                    false => "",
                };
                found.detail = format!(
                    "no density depends on the coordinates only: what the divergence asks of its logarithm along admissible fields contradicts their brackets{more}; {}",
                    found.detail
                );
                Verdict::Refuted(found)
            }
            other => other,
        },
    }
}

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
        "On the constraint manifold with coordinates q and (quasi-)velocities η the measure N dq dη is invariant when X̄ ln N = -div X̄. A density N(q), N(t, q) for motions that contain the time, is searched among functions that occur in the model, by linear equations, and proved. Without a formula the claim is decided by brackets: the divergence must be affine in the velocities, it then prescribes the derivatives of ln N along the admissible fields, and a density exists near almost every place exactly when these values agree on all brackets. For Suslov's problem this is Kozlov's condition (1988; Jovanović 1998), for Chaplygin's systems that of Stanchenko (1989) and of Cantrijn, Cortés, de León and Martín de Diego (2002). Where no force acts at rest, a refutation excludes every smooth positive density, as the terms linear in the velocities of its equation are those for N at rest."
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
        let mut formulas = Vec::new();
        let mut verdict = measure.verdict.clone();
        if let Some(density) = measure.density {
            formulas.push(Formula {
                caption: "the density N of the invariant measure N dq dη".into(),
                left: None,
                right: density,
            });
            if let Verdict::Proved(proof) = &mut verdict {
                let text = g.text(density);
                let what = match text.chars().count() <= LONGEST {
                    true => format!("for N = {text}"),
                    false => "for N with the root of the determinant of the mass matrix on admissible velocities".into(),
                };
                proof.detail = format!("N dq dη is invariant {what}; {}", proof.detail);
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
