//! The motion in a chart of the constraint manifold, and densities in the families of functions that occur.

use super::{formula, products, WORDS};
use crate::noether::ansatz::Ansatz;
use crate::noether::family::{coefficients, CoefficientLetter, Letter, ANY};
use crate::noether::letters::Letters;
use crate::noether::motion::Motion;
use crate::noether::occurring::congruent;
use crate::noether::shown::readable;
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::{Characteristics, Context, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::simplify::{length, simplify, Options};
use chetaev_symbolic::{Expr, Node, Symbol, Verdict};
use std::cell::{Cell, OnceCell};

/// Determinants of larger matrices are not formed.
const DETERMINANT: usize = 8;

/// The highest weight of these functions.
const WEIGHT: u32 = 4;

/// The most functions among which a density is looked for.
const MEMBERS: usize = 260;

/// The motion in a chart of the constraint manifold, with its divergence.
pub(super) struct Flow<'a> {
    pub(super) motion: Motion<'a>,
    pub(super) chart: Characteristics,
    /// Rates of η.
    pub(super) rates: Vec<Expr>,
    /// Rates of the masses with a law of their own, which are states beside q and η.
    pub(super) masses: Vec<(Symbol, Expr)>,
    pub(super) divergence: Expr,
    pub(super) autonomous: bool,
    /// What states of rest and steady motions refute, once it was asked.
    pub(super) at_states: OnceCell<Option<Verdict>>,
    /// Whether what is refuted is so for the values of parameters that the model states.
    pub(super) refuted_as_stated: Cell<bool>,
}

impl<'a> Flow<'a> {
    pub(super) fn of(cx: &Context<'a>) -> Result<Flow<'a>, String> {
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
        let masses = system.mass_rates(&chart.velocities);
        parts.extend(masses.iter().map(|&(mass, rate)| g.diff(rate, mass)));
        let divergence = g.add(&parts);
        let mut all = rates.clone();
        all.extend(&chart.velocities);
        all.extend(masses.iter().map(|(_, rate)| *rate));
        let time = g.symbol("t", 0);
        let time = g.as_symbol(time);
        // The time may cancel in the equations: what counts is the motion.
        let autonomous = g
            .symbols_in(&all)
            .into_iter()
            .all(|s| match Some(s) == time {
                true => all.iter().all(|&e| is_free(cx, e, s)),
                false => system.prescribed_rate(s).is_none() || masses.iter().any(|m| m.0 == s),
            });
        Ok(Flow {
            motion,
            chart,
            rates,
            masses,
            divergence,
            autonomous,
            at_states: OnceCell::new(),
            refuted_as_stated: Cell::new(false),
        })
    }

    /// The rates of all variables.
    pub(super) fn field(&self) -> Vec<Expr> {
        let masses = self.masses.iter().map(|(_, rate)| *rate);
        let own = self.chart.velocities.iter().chain(&self.rates).copied();
        own.chain(masses).collect()
    }

    pub(super) fn symbols(&self) -> Vec<Symbol> {
        self.chart.parameters.iter().map(|p| p.symbol).collect()
    }

    pub(super) fn at(&self, system: &System, e: Expr, one: Option<usize>) -> Expr {
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
    pub(super) fn defects(&self, system: &System, densities: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let rates = self.chart.frozen_derivative(system, densities);
        let pairs = rates.into_iter().zip(densities);
        pairs
            .map(|(rate, &n)| g.add(&[rate, g.mul(&[n, self.divergence])]))
            .collect()
    }

    /// A density of the family that is kept, not proved yet.
    pub(super) fn density(&self, cx: &Context<'_>) -> Option<(Expr, &'static str)> {
        let letters = self.letters(cx, self.autonomous);
        let plain = self.density_in(cx, &letters).map(|n| (n, WORDS[0]));
        let found = plain.or_else(|| {
            let mut more = letters.clone();
            more.push(self.root_of_mass(cx)?);
            Some((self.density_in(cx, &more)?, WORDS[2]))
        });
        found.map(|found| self.by_determinant(cx, found.0).unwrap_or(found))
    }

    /// The determinant of the mass matrix, where it is a density that is written shorter than another one.
    fn by_determinant(&self, cx: &Context<'_>, than: Expr) -> Option<(Expr, &'static str)> {
        let (system, g) = (cx.system, &cx.system.graph);
        let det = formula::plain(cx, self, self.determinant(cx)?);
        if length(g, det) >= length(g, than) || !self.is_wanted(det) {
            return None;
        }
        let defect = self.full_defects(system, &[det]);
        let verdict = cx
            .prover
            .identity(system, &defect, &self.chart.manifold, "");
        matches!(verdict, Verdict::Proved(_)).then_some((det, WORDS[1]))
    }

    /// A density that contains the time, for a motion free of it, where functions of the time occur or are stated.
    /// With its proof.
    pub(super) fn density_in_time(&self, cx: &Context<'_>) -> Option<(Expr, Verdict)> {
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
        matches!(verdict, Verdict::Proved(_)).then_some((density, verdict))
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
    pub(super) fn letters(&self, cx: &Context<'_>, timeless: bool) -> Vec<CoefficientLetter> {
        let g = &cx.system.graph;
        let time = g.symbol("t", 0);
        let mut letters = Letters::of(cx).coefficients;
        letters.retain(|c| c.exponents != (0, 0));
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
    pub(super) fn liouville(&self, cx: &Context<'_>) -> Option<(Expr, Verdict)> {
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
    pub(super) fn with_roots(&self, cx: &Context<'_>) -> Option<(Expr, Verdict)> {
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
    pub(super) fn is_wanted(&self, e: Expr) -> bool {
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

    /// A density `N = √(det W det W̄) exp(σ)` with a σ(q, η) for which `X̄ ln N = -div X̄`, that is a combination of products of
    /// velocities with functions that occur: such a density is smooth and positive wherever these and the mass matrices are, whatever
    /// the variables. With the proof that it is kept. Without the root where that is not found.
    pub(super) fn exponential(&self, cx: &Context<'_>) -> Option<(Expr, Verdict)> {
        let (g, own) = (&cx.system.graph, self.symbols());
        let moves = |e: Expr| !g.is_free_of(e, &|s| self.motion.moves(s) || own.contains(&s));
        let masses = self.masses_of_states(cx);
        let masses = masses.filter(|&e| moves(e) && self.is_wanted(e));
        let with = masses.and_then(|masses| self.exponential_by(cx, masses));
        with.or_else(|| self.exponential_by(cx, g.one()))
    }

    /// As [`Flow::exponential`], with the root of a function for that of the determinants.
    fn exponential_by(&self, cx: &Context<'_>, square: Expr) -> Option<(Expr, Verdict)> {
        let (system, g) = (cx.system, &cx.system.graph);
        let members = self.with_velocities(cx);
        let mut columns: Vec<Vec<Expr>> = self
            .rates_of(system, &members)
            .into_iter()
            .map(|e| vec![e])
            .collect();
        let rate = self.rates_of(system, &[square])[0];
        let missing = g.add(&[self.divergence, g.div(rate, g.mul(&[g.integer(2), square]))]);
        columns.push(vec![missing]);
        let (manifold, own) = (&self.chart.manifold, self.symbols());
        let seed = cx.prover.points_seed();
        let ansatz = Ansatz::new(&self.motion, &columns, manifold, &own, seed).ok()?;
        let found = ansatz.with_last()?;
        let (&last, found) = found.split_last()?;
        let parts = found.iter().zip(&members).filter(|(&c, _)| !g.is_zero(c));
        let parts: Vec<Expr> = parts
            .map(|(&c, &e)| g.mul(&[readable(g, g.div(c, last)), e]))
            .collect();
        let exponent = g.add(&parts);
        let defect = g.add(&[self.rates_of(system, &[exponent])[0], missing]);
        let on = "on the constraint manifold";
        let verdict = cx.prover.identity(system, &[defect], manifold, on);
        let verdict = verdict.prefixed("the rate of its logarithm is the negative divergence");
        let density = g.mul(&[g.sqrt(square), g.exp(exponent)]);
        let density = match g.is_one(square) {
            true => density,
            false => formula::plain(cx, self, density),
        };
        matches!(verdict, Verdict::Proved(_)).then_some((density, verdict))
    }

    /// Products of velocities η and functions of the coordinates that occur, simple ones first.
    fn with_velocities(&self, cx: &Context<'_>) -> Vec<Expr> {
        let g = &cx.system.graph;
        let mut letters = self.letters(cx, true);
        for own in &mut letters {
            own.exponents.0 = 0;
        }
        let own = self.chart.parameters.iter().map(|p| CoefficientLetter {
            letter: Letter::plain(p.value),
            exponents: (0, ANY),
            weight: 1,
        });
        letters.extend(own);
        let mut members = coefficients(&letters, 0, 1);
        for weight in 2..=WEIGHT {
            let next = coefficients(&letters, 0, weight);
            if next.len() > MEMBERS {
                break;
            }
            members = next;
        }
        members.retain(|(_, member)| !member.is_empty());
        let value = |member: &[(usize, i8)]| {
            let powers = member.iter();
            let powers = powers.map(|&(l, e)| g.powi(letters[l].letter.value, i64::from(e)));
            g.mul(&powers.collect::<Vec<_>>())
        };
        members.iter().map(|(_, member)| value(member)).collect()
    }

    /// X̄ of functions on N.
    pub(super) fn rates_of(&self, system: &System, functions: &[Expr]) -> Vec<Expr> {
        let direction = Direction {
            time: system.graph.one(),
            coordinates: self.chart.velocities.clone(),
            parameters: self.rates.clone(),
        };
        self.chart.along(system, functions, &direction)
    }

    /// `X̄ N + N div X̄` for functions on N.
    fn full_defects(&self, system: &System, densities: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let rates = self.rates_of(system, densities);
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

    /// How many independent ones of functions on N contain no velocities.
    pub(super) fn independent_of_velocities(&self, cx: &Context<'_>, all: &[Expr]) -> usize {
        let (system, g) = (cx.system, &cx.system.graph);
        let own = self.symbols();
        let places = g.symbols_in(all).into_iter();
        let places: Vec<Symbol> = places
            .filter(|&s| self.motion.moves(s) && !own.contains(&s))
            .collect();
        let free = all.iter().filter(|&&e| !g.contains_any(e, &own));
        let slopes: Vec<Vec<Expr>> = free.map(|&e| g.gradient(e, &places)).collect();
        if slopes.is_empty() || places.is_empty() || self.chart.implicit().next().is_some() {
            return 0;
        }
        let rank = cx.prover.rank(system, &slopes, &self.chart.manifold);
        rank.map_or(0, |rank| match rank.at_least {
            Verdict::Proved(_) => rank.minimum,
            _ => 0,
        })
    }

    /// det W det W̄ on N, where it is regular and small.
    pub(super) fn masses_of_states(&self, cx: &Context<'_>) -> Option<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        if system.n() > DETERMINANT {
            return None;
        }
        let whole = determinant(g, &cx.terms.mass_matrix);
        let whole = self.chart.restrict(system, &[whole])[0];
        let restricted = match self.chart.k() {
            0 => g.one(),
            _ => self.determinant(cx)?,
        };
        let both =
            [whole, restricted].map(|e| products::shorter(g, simplify(g, e, &Options::default())));
        let vanishes = |e: Expr| {
            let verdict = cx.prover.identity(system, &[e], &self.chart.manifold, "");
            !matches!(verdict, Verdict::Refuted(_))
        };
        (!both.iter().any(|&e| vanishes(e))).then(|| g.mul(&both))
    }

    /// det Bᵀ W B, of few velocities.
    pub(super) fn determinant(&self, cx: &Context<'_>) -> Option<Expr> {
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
