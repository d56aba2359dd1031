//! First integrals that are products of powers, `Π F_i^{e_i} exp(Σ c_j h_j)`, as `x' y^k`: for given F_i and h_j the exponents enter
//! `X̄ ln G = Σ e_i X̄F_i/F_i + Σ c_j X̄h_j = 0` linearly, so they are solved for, whatever numbers or functions of the parameters they
//! are. Where F may be negative and e is not whole it stands by its absolute value, whose logarithm has the same derivative.
//! The F are velocities, functions that occur and Darboux polynomials of the motion: with one velocity and the density N of an
//! invariant measure this is `N η_i`. The h are coordinates, the time and the arguments of complex Darboux polynomials.

use super::ansatz::Ansatz;
use super::letters::Letters;
use super::motion::Motion;
use super::search::Integral;
use super::shown::readable;
use crate::measure::on_both_sides;
use chetaev_integrals::factors::{factors as darboux, Factors as Darboux};
use chetaev_mechanics::Context;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::{Expr, Function, Node, Verdict};

/// More factors are not looked at.
const FACTORS: usize = 30;

/// Larger rates, in nodes, are not factored.
const FACTORED: usize = 40;

/// A product of powers that keeps its value, with its logarithm.
pub(super) struct Product {
    pub(super) integral: Integral,
    pub(super) logarithm: Expr,
}

/// The products of powers of letters that are proved to keep their values, with what they are made of; those without velocity are
/// constants of the constraints, and left out. `None` where they are too many, or something stayed without proof: nothing is said of a
/// family then.
pub(super) fn products(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    letters: &Letters,
) -> Option<(Factors, Vec<Product>)> {
    let g = &cx.system.graph;
    let mut factors = Factors::of(cx, letters);
    let plain = factors.all().len();
    if plain > FACTORS {
        return None;
    }
    factors.extend(cx, motion, FACTORS - plain);
    factors.join(cx, &darboux(cx, motion));
    let all = factors.all();
    let rates: Vec<Expr> = motion
        .derivatives(&all)
        .into_iter()
        .zip(&all)
        .enumerate()
        .map(|(i, (rate, &e))| match factors.is_exponent(i) {
            true => rate,
            false => g.div(rate, e),
        })
        .collect();
    let columns: Vec<Vec<Expr>> = rates.iter().map(|&e| vec![e]).collect();
    let seed = cx.prover.points_seed();
    let ansatz = Ansatz::new(motion, &columns, &motion.manifold, &[], seed);
    let solved = ansatz.ok().and_then(|ansatz| ansatz.all())?;
    let first = factors.places.len() + factors.exponents.len();
    let leading = |own: &Vec<Expr>| own[first..].iter().rev().copied().find(|&e| !g.is_zero(e));
    let with_velocity = solved
        .into_iter()
        .filter_map(|own| Some((leading(&own)?, own)));
    let found: Option<Vec<Product>> = with_velocity
        .map(|(leading, own)| {
            let own = own.into_iter().map(|e| readable(g, g.div(e, leading)));
            factors.proved(cx, motion, &own.collect::<Vec<Expr>>(), &rates)
        })
        .collect();
    Some((factors, found?))
}

/// What products are made of. Velocities stand last, so that solutions have few of them.
pub(super) struct Factors {
    places: Vec<Expr>,
    pub(super) exponents: Vec<Expr>,
    velocities: Vec<Expr>,
    /// Arguments of complex functions; they stand in the exponent too.
    arguments: Vec<Expr>,
}

impl Factors {
    fn of(cx: &Context<'_>, letters: &Letters) -> Factors {
        let (system, g) = (cx.system, &cx.system.graph);
        let angles = &letters.coefficients[..letters.circular];
        let is_angle = |q: Expr| angles.iter().any(|c| c.letter.value == g.sin(q));
        let plain = system.coordinates.iter().map(|c| c.q);
        let plain = plain.filter(|&q| !is_angle(q));
        Factors {
            places: places(cx, letters),
            exponents: plain.chain([g.symbol("t", 0)]).collect(),
            velocities: letters.velocities.iter().map(|l| l.value).collect(),
            arguments: Vec::new(),
        }
    }

    /// Adds the Darboux functions of the motion, as far as there is room.
    fn join(&mut self, cx: &Context<'_>, darboux: &Darboux) {
        let g = &cx.system.graph;
        let known = |own: &Factors, e: Expr| {
            let mut all = own.velocities.iter().chain(&own.places);
            all.any(|&other| other == e || other == g.neg(e))
        };
        let mut room = (2 * FACTORS).saturating_sub(self.all().len());
        for &e in &darboux.bases {
            if room > 0 && !known(self, e) {
                self.velocities.push(e);
                room -= 1;
            }
        }
        self.arguments = darboux.arguments.iter().copied().take(room).collect();
    }

    /// Adds products of two coordinates to the exponents, and to the velocities what their rates vanish with, as k x'² - g of
    /// `x'' = k x'² - g`; none of both where they are more than `most`.
    fn extend(&mut self, cx: &Context<'_>, motion: &Motion<'_>, most: usize) {
        let g = &cx.system.graph;
        let own = cx.system.velocity_symbols();
        let plain = self.exponents[..self.exponents.len() - 1].to_vec();
        let pairs = plain.iter().enumerate();
        let pairs = pairs.flat_map(|(i, &a)| plain[..=i].iter().map(move |&b| g.mul(&[a, b])));
        let pairs: Vec<Expr> = pairs.collect();
        let mut vanishing: Vec<Expr> = Vec::new();
        for rate in motion.derivatives(&self.velocities) {
            let parts = g.reachable(&[rate]);
            let is_solved = |&e: &Expr| matches!(g.node(e), Node::Solve { .. });
            if parts.len() > FACTORED || parts.iter().any(is_solved) {
                continue;
            }
            let list = factors(g, rate, &own).unwrap_or_default();
            for (factor, _) in list {
                let known = [&self.velocities[..], &vanishing].concat();
                if !known.iter().any(|&e| e == factor || e == g.neg(factor)) {
                    vanishing.push(factor);
                }
            }
        }
        let room = most.saturating_sub(vanishing.len());
        if vanishing.len() <= most {
            vanishing.append(&mut self.velocities);
            self.velocities = vanishing;
        }
        if pairs.len() <= room {
            // The time stays last.
            let time = self.exponents.pop();
            self.exponents.extend(pairs);
            self.exponents.extend(time);
        }
    }

    /// The functions that are raised to powers.
    pub(super) fn bases(&self) -> Vec<Expr> {
        [&self.velocities[..], &self.places].concat()
    }

    fn all(&self) -> Vec<Expr> {
        let exponents = [&self.exponents[..], &self.velocities].concat();
        [&self.places[..], &exponents, &self.arguments].concat()
    }

    fn is_exponent(&self, i: usize) -> bool {
        let first = self.places.len();
        let velocities = first + self.exponents.len();
        (first..velocities).contains(&i) || i >= velocities + self.velocities.len()
    }

    /// The product with these exponents, where its logarithm is proved to keep its value.
    fn proved(
        &self,
        cx: &Context<'_>,
        motion: &Motion<'_>,
        own: &[Expr],
        rates: &[Expr],
    ) -> Option<Product> {
        let g = &cx.system.graph;
        let (mut parts, mut logarithms) = (Vec::new(), Vec::new());
        for (i, (&e, factor)) in own.iter().zip(self.all()).enumerate() {
            if self.is_exponent(i) {
                parts.push(g.exp(g.mul(&[e, factor])));
                logarithms.push(g.mul(&[e, factor]));
                continue;
            }
            parts.push(g.pow(factor, e));
            logarithms.push(g.mul(&[e, g.apply(Function::Log, &[factor])]));
        }
        let terms = own.iter().zip(rates).map(|(&e, &rate)| g.mul(&[e, rate]));
        let residual = g.add(&terms.collect::<Vec<Expr>>());
        let (manifold, on) = (&motion.manifold, "on the constraint manifold");
        let verdict = cx.prover.identity(cx.system, &[residual], manifold, on);
        let logarithm = g.add(&logarithms);
        let is_exponent = |i: usize| self.is_exponent(i) || g.is_zero(own[i]);
        // An exponential alone keeps its value as its exponent does.
        let value = if (0..own.len()).all(is_exponent) {
            logarithm
        } else {
            on_both_sides(cx, g.mul(&parts))
        };
        matches!(verdict, Verdict::Proved(_)).then_some(Product {
            integral: Integral {
                value,
                shown: value,
                verdict: verdict.prefixed("the rate of its logarithm vanishes"),
                independent: true,
                name: None,
            },
            logarithm,
        })
    }
}

/// What occurs: roots by what is under them, exponentials and the time not.
fn places(cx: &Context<'_>, letters: &Letters) -> Vec<Expr> {
    let g = &cx.system.graph;
    let time = g.symbols_in(&[g.symbol("t", 0)]);
    let mut found: Vec<Expr> = Vec::new();
    for (place, c) in letters.coefficients.iter().enumerate() {
        let base = g.base_exponent(c.letter.value).0;
        let is_other = c.exponents == (0, 0)
            || letters.perhaps_turning.contains(&place)
            || letters.turning.contains(&place)
            || g.contains_any(base, &time)
            || matches!(
                g.node(base),
                Node::Apply {
                    function: Function::Exp,
                    ..
                }
            );
        if !is_other && !found.contains(&base) {
            found.push(base);
        }
    }
    found
}
