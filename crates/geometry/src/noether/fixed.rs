//! Fixed directions and axes (T3 §8.3): combinations `a·K + b·H_O` with constants a and b that keep their values on motions.
//!
//! Their rates are `a·F + b·M_O` with the sum F of the forces and their moment M_O about the origin, so all of them are found by linear
//! equations for a and b. Those with b = 0 are momenta along a. As `H_A·b = H_O·b + K·(r_A × b)`, those with `a·b = 0` are moments about
//! the direction b through `r_A = b × a/b²`, and in others `a·b/b²` times the momentum along b stands beside such a moment: a screw.

use super::ansatz::Ansatz;
use super::motion::Motion;
use super::shown::readable;
use super::vectors::{cross, dot, is_zero, scale, times, Vector};
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Graph};

/// A moment of momentum about a fixed direction through a fixed point, with a multiple of the momentum along it.
#[derive(Debug)]
pub(super) struct Axis {
    pub(super) direction: Vector,
    pub(super) point: Vector,
    /// How many times the momentum along it is added; zero unless it is a screw.
    pub(super) pitch: Expr,
}

/// A basis of all fixed directions, and of all fixed axes up to these.
#[derive(Debug, Default)]
pub(super) struct Fixed {
    pub(super) directions: Vec<Vector>,
    pub(super) axes: Vec<Axis>,
    /// Whether none is missing.
    pub(super) is_all: bool,
}

/// The components in the order of the columns: with the middle one before its neighbours the two directions across (1, 1, 1) are (1, -1, 0)
/// and (0, 1, -1).
const ORDER: [usize; 3] = [1, 0, 2];

/// A component of the moment about the origin, or of the momentum.
type Place = (bool, usize);

/// The components in the plane or in space, momenta first, so that no more of them stands beside a moment than is needed.
fn places(dimension: usize) -> Vec<Place> {
    let along = ORDER.into_iter().filter(|&i| i < dimension);
    let about = ORDER.into_iter().filter(|&i| match dimension {
        2 => i == 2,
        _ => dimension > 2,
    });
    let along = along.map(|i| (false, i));
    along.chain(about.map(|i| (true, i))).collect()
}

impl Fixed {
    /// Those that are kept, from the sum of the forces and their moment about the origin.
    pub(super) fn of(
        cx: &Context<'_>,
        motion: &Motion<'_>,
        force: &Vector,
        moment: &Vector,
        dimension: usize,
    ) -> Fixed {
        let g = &motion.system.graph;
        let places = places(dimension);
        let column = |&(turns, i): &Place| vec![if turns { moment[i] } else { force[i] }];
        let columns: Vec<Vec<Expr>> = places.iter().map(column).collect();
        let seed = cx.prover.points_seed();
        let Ok(ansatz) = Ansatz::new(motion, &columns, &motion.manifold, &[], seed) else {
            return Fixed::default();
        };
        let (all, most) = (ansatz.all(), places.len());
        let is_all = all.is_some();
        let solutions = all.or_else(|| ansatz.up_to(most)).unwrap_or_default();
        let pairs = solutions.iter().map(|solution| {
            let mut pair = [[g.zero(); 3]; 2];
            for (&(turns, i), &c) in places.iter().zip(solution) {
                pair[usize::from(turns)][i] = c;
            }
            pair
        });
        Fixed {
            is_all,
            ..Fixed::sorted(g, pairs.collect())
        }
    }

    fn sorted(g: &Graph, pairs: Vec<[Vector; 2]>) -> Fixed {
        let (straight, turning): (Vec<_>, Vec<_>) =
            pairs.into_iter().partition(|[_, b]| is_zero(g, b));
        let straight = straight.into_iter();
        let directions: Vec<Vector> = straight
            .map(|[a, _]| times(g, &a, g.powi(scale(g, &a), -1)))
            .collect();
        let turning = turning.iter();
        let axes = turning
            .map(|[a, b]| Axis::of(g, a, b, &directions))
            .collect();
        Fixed {
            directions,
            axes,
            is_all: true,
        }
    }
}

impl Axis {
    /// What a·K + b·H_O is, where momenta along some directions are kept as well and may be taken off.
    fn of(g: &Graph, a: &Vector, b: &Vector, kept: &[Vector]) -> Axis {
        let by = g.powi(scale(g, b), -1);
        let (mut a, b) = (times(g, a, by), times(g, b, by));
        let along = |a: &Vector| readable(g, dot(g, a, &b));
        if let Some(d) = kept.iter().find(|d| !g.is_zero(along(d))) {
            let excess = g.div(along(&a), along(d));
            a = [0, 1, 2].map(|i| readable(g, g.sub(a[i], g.mul(&[excess, d[i]]))));
        }
        let by = g.powi(dot(g, &b, &b), -1);
        Axis {
            point: times(g, &cross(g, &b, &a), by),
            pitch: readable(g, g.mul(&[dot(g, &a, &b), by])),
            direction: b,
        }
    }
}
