//! Densities on configurations where an angle returns to itself: ln N has to return too.

use super::{by_brackets, excluded, flag, Flow};
use crate::flag::Flag;
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::{Expr, Node, Verdict};

/// Coordinates that are angles and that no assumption bounds.
pub(super) fn closed_angles(cx: &Context<'_>) -> Vec<usize> {
    let (system, g) = (cx.system, &cx.system.graph);
    let sides: Vec<Expr> = system
        .assumptions
        .iter()
        .flat_map(|a| [a.left, a.right])
        .collect();
    let is_closed = |j: &usize| {
        let c = &system.coordinates[*j];
        system.angles.contains(&c.name) && !g.any_contains_any(&sides, &[c.q_symbol])
    };
    (0..system.n()).filter(is_closed).collect()
}

/// What is proved near almost every place, with what is known of whole turns of the angles.
pub(super) fn around(cx: &Context<'_>, flow: &Flow<'_>, local: Verdict) -> Verdict {
    let angles = closed_angles(cx);
    if angles.is_empty() || matches!(by_brackets(cx, flow, &angles), Verdict::Proved(_)) {
        return local;
    }
    let names: Vec<&str> = angles
        .iter()
        .map(|&j| cx.system.coordinates[j].name.as_str())
        .collect();
    let open = format!(
        "whether it returns to its values after a turn of {} is not decided",
        names.join(", ")
    );
    match turned(cx, flow, &angles) {
        Some(verdict) => verdict,
        // On the states as they are, turns and all, the claim is not decided then.
        None => match local {
            Verdict::Proved(proof) => Verdict::undecided(format!("{}; {open}", proof.detail)),
            other => other,
        },
    }
}

/// Angles after a turn of which a formula does not return.
pub(super) fn open(cx: &Context<'_>, density: Expr) -> Vec<usize> {
    let angles = closed_angles(cx).into_iter();
    angles.filter(|&j| !returns(cx, density, j)).collect()
}

/// A formula that does not return after a turn of an angle is that of a measure near every place only.
pub(super) fn returning(
    cx: &Context<'_>,
    flow: &Flow<'_>,
    density: Expr,
    verdict: Verdict,
) -> Verdict {
    let open = open(cx, density);
    if open.is_empty() {
        return verdict;
    }
    let names: Vec<&str> = open
        .iter()
        .map(|&j| cx.system.coordinates[j].name.as_str())
        .collect();
    let n = super::density_letter(cx);
    turned(cx, flow, &open).unwrap_or_else(|| {
        Verdict::undecided(format!(
            "{n} = {} makes {n} dq dη invariant near every place; whether a density returns to its values after a turn of {} is not decided",
            cx.system.graph.text(density),
            names.join(", ")
        ))
    })
}

/// Coordinates without a unit with which a density does not return although the motion does after a turn of them: the density is right
/// where they are lengths, and a further turn is a further place.
pub(super) fn unrolled(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Vec<String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let motion = [&flow.chart.velocities[..], &flow.rates].concat();
    let is_one = |j: &usize| {
        let c = &system.coordinates[*j];
        !system.angles.contains(&c.name)
            && g.contains_any(density, &[c.q_symbol])
            && !returns(cx, density, *j)
            && g.any_contains_any(&motion, &[c.q_symbol])
            && motion.iter().all(|&e| returns(cx, e, *j))
    };
    let all = (0..system.n()).filter(is_one);
    all.map(|j| system.coordinates[j].name.clone()).collect()
}

/// Whether an expression contains an angle only in sines and the like of whole multiples.
pub(super) fn returns(cx: &Context<'_>, e: Expr, angle: usize) -> bool {
    let g = &cx.system.graph;
    let symbol = cx.system.coordinates[angle].q_symbol;
    let mut replaced: Vec<(Expr, Expr)> = Vec::new();
    for part in g.reachable(&[e]) {
        let arguments = match g.node(part) {
            Node::Apply {
                function,
                arguments,
            } if function.is_circular() => arguments,
            _ => continue,
        };
        let slope = g.diff(arguments[0], symbol);
        if g.as_integer(slope).is_some() {
            replaced.push((part, g.one()));
        }
    }
    !g.contains_any(g.substitute(e, &replaced), &[symbol])
}

/// Averages over so many parts of a turn are formed: of a function that returns they have its mean, and they are constants
/// for sums of sines of few multiples of the angle.
const PARTS: [i64; 4] = [1, 3, 4, 12];

/// A constant that is the mean of a function over a turn of an angle.
fn mean(cx: &Context<'_>, slope: Expr, angle: usize) -> Option<Expr> {
    let (g, own) = (&cx.system.graph, cx.system.coordinates[angle].q);
    if excluded::is_constant(cx, slope) {
        return Some(slope);
    }
    if !returns(cx, slope, angle) {
        return None;
    }
    PARTS.into_iter().find_map(|parts| {
        let share = g.div(g.one(), g.integer(parts));
        let turned = (0..parts).map(|k| {
            let by = g.mul(&[g.integer(2 * k), share, g.pi()]);
            g.substitute(slope, &[(own, g.add(&[own, by]))])
        });
        let mean = g.mul(&[share, g.add(&turned.collect::<Vec<_>>())]);
        excluded::is_constant(cx, mean).then_some(mean)
    })
}

/// A verdict where ln N changes over a turn of an angle.
fn turned(cx: &Context<'_>, flow: &Flow<'_>, angles: &[usize]) -> Option<Verdict> {
    let found = flag(cx, flow, &[], &[]).ok()??;
    let slopes = slopes(cx, flow, &found)?;
    angles.iter().find_map(|&j| {
        let mean = mean(cx, slopes[j], j)?;
        let on = "in the coordinates";
        let verdict = cx
            .prover
            .identity(cx.system, &[mean], &Manifold::default(), on);
        let Verdict::Refuted(mut refuted) = verdict else {
            return None;
        };
        let name = &cx.system.coordinates[j].name;
        let slope = match mean == slopes[j] {
            true => "a constant slope",
            false => "a slope with a mean",
        };
        let what = format!(
            "near every place a density of the coordinates exists, but its logarithm has {slope} that is not zero along the angle {name}, and so does not return after a turn"
        );
        Some(match excluded::fields_at_rest(cx, flow).is_some() {
            true => {
                refuted.detail = format!(
                    "{what}; as the accelerations at rest have neither terms without velocities nor linear ones, the same holds for every smooth positive density; {}",
                    refuted.detail
                );
                Verdict::Refuted(refuted)
            }
            false => Verdict::undecided(format!(
                "{what}; densities that contain velocities are not excluded"
            )),
        })
    })
}

/// The derivatives of ln N by the coordinates, where the brackets determine all of them.
fn slopes(cx: &Context<'_>, flow: &Flow<'_>, flag: &Flag) -> Option<Vec<Expr>> {
    let n = cx.system.n() + flow.masses.len();
    if !flow.autonomous || flag.fields.len() != n {
        return None;
    }
    let entries: Vec<Expr> = flag.fields.iter().flat_map(|f| f.place.clone()).collect();
    let values: Vec<Expr> = flag.fields.iter().map(|f| f.value).collect();
    cx.system.graph.solve(&entries, &values).ok()
}
