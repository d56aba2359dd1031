//! Drift along a family of steady motions: a Jordan chain of zero that ends in the family.
//!
//! The family has dimension d, zero has multiplicity d + 1 and all other eigenvalues lie left of the axis, so that a centre manifold of dimension
//! d + 1 contains the family. An integral F is constant on the family and changes along the chain: it is a coordinate across the family in
//! that manifold, on which the motion is `F' = 0`, `y' = (F − F⁰) b` with `b ≠ 0` at the motion. Where F differs from its value, however little,
//! y leaves a neighbourhood: the motion is unstable. (Liebscher 2015, ch. 2 and 4, on manifolds of equilibria that lose their normal hyperbolicity.)

use crate::about::About;
use crate::integrals::Jet;
use crate::question::Place;
use crate::real_roots::bounds_at;
use crate::steady::{closed, kernel, times};
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Neighbours of the motion run along its family.
pub(crate) struct Drift;

/// `y' = (F − F⁰) b`.
struct Running {
    integral: String,
    variable: String,
    /// A component of b.
    rate: Expr,
    nonzero: Vec<Expr>,
}

impl Method for Drift {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        let running = about.once(|| running(about));
        let own = (*running).as_ref();
        own.map_or_else(Vec::new, |own| {
            [own.nonzero.clone(), vec![own.rate]].concat()
        })
    }

    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        if place != Place::OnAxis {
            return Answer::NotApplicable;
        }
        let running = about.once(|| running(about));
        let Some(own) = (*running).as_ref() else {
            return Answer::NotApplicable;
        };
        let g = about.graph();
        let sign = |&e: &Expr| about.question.sign(g, e, at);
        let is_apart = |e: &Expr| sign(e).is_some_and(|s| s != Ordering::Equal);
        if !own.nonzero.iter().chain([&own.rate]).all(is_apart) {
            return Answer::NotApplicable;
        }
        let (integral, variable) = (&own.integral, &own.variable);
        Answer::Unstable(Instability {
            quantity: format!("the rate of {variable} by a unit of {integral}"),
            bounds: bounds_at(g, own.rate, about.question.over.zip(at)).unwrap_or_default(),
            why: format!("the motion drifts along its family: {integral} is constant on the family, and where it has another value, however near, {variable} runs on at a rate that is proportional to the difference, on the centre manifold, which is what all near motions tend to"),
        })
    }
}

fn running(about: &About<'_>) -> Option<Running> {
    let (g, own, question) = (about.graph(), &about.expansion, &about.question);
    let family = question.linear.family;
    let is_alone = question.spectrum.paired.is_none() && question.zeros() == family + 1;
    if !is_alone || !own.own.characteristics.manifold.implicit.is_empty() || !own.is_smooth() {
        return None;
    }
    let slopes = own.slopes();
    let finite = own.finite_equations().into_iter().map(|(_, row)| row);
    let matrix: Vec<Vec<Expr>> = slopes.iter().cloned().chain(finite).collect();
    let n = slopes.len();
    let (tangents, nonzero) = kernel(g, &matrix, n);
    if tangents.len() != family || !own.is_steady_along(&tangents) {
        return None;
    }
    let masses = own.masses();
    // The tangent at which the chain ends is a combination of those of the basis: `A h = E Σ κ v` for h and κ.
    let images: Vec<Vec<Expr>> = tangents.iter().map(|v| times(g, &masses, v)).collect();
    let padded = |row: usize| {
        images
            .iter()
            .map(move |image| image.get(row).map_or(g.zero(), |&e| g.neg(e)))
    };
    let wide: Vec<Vec<Expr>> = matrix
        .iter()
        .enumerate()
        .map(|(at, row)| row.iter().copied().chain(padded(at)).collect())
        .collect();
    let (chains, further) = kernel(g, &wide, n + family);
    let moves = |chain: &&Vec<Expr>| chain[n..].iter().any(|&e| !g.is_zero(e));
    let chain = chains.iter().find(moves)?;
    let along = |gradient: &[Expr]| times(g, &[gradient.to_vec()], &chain[..n])[0];
    let integrals = about.integrals();
    let serves = |jet: &&Jet| {
        !jet.falls && !g.is_zero(along(&jet.gradient)) && is_constant(about, jet, &tangents)
    };
    let integral = integrals.iter().find(serves)?;
    let slope = along(&integral.gradient);
    // b is what A makes of the chain, by a unit of F.
    let mut ends = (0..n).map(|c| {
        let terms = tangents.iter().zip(&chain[n..]);
        let sum: Vec<Expr> = terms.map(|(v, &k)| g.mul(&[k, v[c]])).collect();
        closed(g, g.div(g.add(&sum), slope))
    });
    let names = own.variables();
    let (place, rate) = ends.by_ref().enumerate().find(|(_, e)| !g.is_zero(*e))?;
    Some(Running {
        integral: integral.name.clone(),
        variable: own.name_of(place, names[place]),
        rate,
        nonzero: [nonzero, further, vec![slope]].concat(),
    })
}

/// Whether an integral has one value on all of a straight family.
fn is_constant(about: &About<'_>, jet: &Jet, tangents: &[Vec<Expr>]) -> bool {
    let (g, own) = (about.graph(), &about.expansion);
    let Some(value) = jet.value else {
        return false;
    };
    let n = tangents.first().map_or(0, Vec::len);
    // No name of a model contains a space.
    let parts = |c: usize| {
        let along =
            |(i, v): (usize, &Vec<Expr>)| g.mul(&[g.symbol(&format!("along {i}"), 0), v[c]]);
        g.add(&tangents.iter().enumerate().map(along).collect::<Vec<_>>())
    };
    let deviations: Vec<Expr> = (0..n).map(parts).collect();
    let there = own.beside(&[value], &deviations)[0];
    g.is_zero(closed(g, g.sub(there, own.at(&[value])[0])))
}
