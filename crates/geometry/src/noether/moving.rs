//! Momentum along a moving direction and moment of momentum about a moving axis, for particles (T3 §8.3).
//!
//! With the forces `F_a = m_a r_a''` on the particles, reactions among them, `K = Σ m r'`, `H_A = Σ (r - r_A) × m r'`:
//! `d/dt (K·e) = K·e' + F·e` (18a) and `d/dt (H_A·e) = K·(r_A' × e) + H_A·e' + M_A·e` (18), for any e and A that are functions of the
//! state. Directions e are searched among the axes, the directions that turn with an angle that occurs in sines and cosines, as φ or ωt,
//! and those from particle to particle; points A among the origin, the particles, the centre of mass, the point whose coordinates carry
//! all particles along, as that of contact of a blade, and all points at rest.

use super::ansatz::Ansatz;
use super::motion::{draw_with_points, Motion};
use super::shown::readable;
use chetaev_mechanics::{mass, particles, Context, System};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};

/// Three components.
type Vector = [Expr; 3];

/// A direction or an axis with what is kept.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The direction in words.
    pub direction: String,
    /// The point in words, for an axis.
    pub point: Option<String>,
    /// K·e or H_A·e.
    pub value: Expr,
    /// The left side of (18a) or (18) on the motion.
    pub rate: Expr,
    /// Whether it is kept for the values of parameters that the model states, and not in general.
    pub as_stated: bool,
    /// Whether its direction contains a root.
    rooted: bool,
    /// Other directions, and points of axes, for which it is the same up to a constant factor.
    pub also: Vec<(String, Option<String>)>,
}

impl Kept {
    /// Names another candidate that is a multiple of this one; the one that is written shorter stands first.
    fn beside(&mut self, system: &System, mut other: Kept) {
        let g = &system.graph;
        let size = |kept: &Kept| length(g, readable(g, kept.value));
        if size(&other) < size(self) {
            std::mem::swap(self, &mut other);
            std::mem::swap(&mut self.also, &mut other.also);
        }
        self.also.push((other.direction, other.point));
    }
}

/// What the search found.
#[derive(Clone, Debug)]
pub struct Searched {
    /// Directions or axes with an integral, not proved yet.
    pub kept: Vec<Kept>,
    /// How many were tried.
    pub tried: usize,
}

/// Names what is moved.
struct Named<T> {
    words: String,
    value: T,
}

/// The particles of a system with their motion.
struct Swarm<'a> {
    g: &'a Graph,
    masses: Vec<Expr>,
    positions: Vec<Vector>,
    velocities: Vec<Vector>,
    /// m r''.
    forces: Vec<Vector>,
    names: Vec<String>,
}

fn padded(g: &Graph, components: &[Expr]) -> Vector {
    [0, 1, 2].map(|i| components.get(i).copied().unwrap_or(g.zero()))
}

fn dot(g: &Graph, a: &Vector, b: &Vector) -> Expr {
    let parts: Vec<Expr> = (0..3).map(|i| g.mul(&[a[i], b[i]])).collect();
    g.add(&parts)
}

fn cross(g: &Graph, a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| g.sub(g.mul(&[a[i], b[j]]), g.mul(&[a[j], b[i]])))
}

fn difference(g: &Graph, a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| g.sub(a[i], b[i]))
}

impl<'a> Swarm<'a> {
    fn of(motion: &Motion<'a>) -> Swarm<'a> {
        let (system, g) = (motion.system, &motion.system.graph);
        let all = &system.particles;
        let velocities: Vec<Vec<Expr>> =
            all.iter().map(|p| particles::velocity(system, p)).collect();
        let forces = all.iter().zip(&velocities).map(|(p, v)| {
            let a = motion.derivatives(v);
            let force: Vec<Expr> = a.iter().map(|&a| g.mul(&[p.mass, a])).collect();
            padded(g, &force)
        });
        Swarm {
            g,
            masses: all.iter().map(|p| p.mass).collect(),
            positions: all.iter().map(|p| padded(g, &p.position)).collect(),
            forces: forces.collect(),
            velocities: velocities.iter().map(|v| padded(g, v)).collect(),
            names: all.iter().map(|p| p.name.clone()).collect(),
        }
    }

    /// Σ m r', or Σ of other vectors with the masses.
    fn weighted(&self, vectors: &[Vector]) -> Vector {
        [0, 1, 2].map(|i| {
            let parts = self.masses.iter().zip(vectors);
            let parts: Vec<Expr> = parts.map(|(&m, r)| self.g.mul(&[m, r[i]])).collect();
            self.g.add(&parts)
        })
    }

    fn sum(&self, vectors: impl Iterator<Item = Vector>) -> Vector {
        let all: Vec<Vector> = vectors.collect();
        [0, 1, 2].map(|i| self.g.add(&all.iter().map(|v| v[i]).collect::<Vec<_>>()))
    }

    fn dimension(&self, motion: &Motion<'_>) -> usize {
        let sizes = motion.system.particles.iter().map(|p| p.position.len());
        sizes.max().unwrap_or(0)
    }

    fn directions(&self, motion: &Motion<'_>) -> Vec<Named<Vector>> {
        let g = self.g;
        let (one, zero) = (g.one(), g.zero());
        let dimension = self.dimension(motion);
        let mut found: Vec<Named<Vector>> = (0..dimension)
            .map(|i| {
                let mut e = [zero; 3];
                e[i] = one;
                Named {
                    words: format!("the {} axis", ["x", "y", "z"][i]),
                    value: e,
                }
            })
            .collect();
        if dimension > 1 {
            for angle in angles(motion) {
                let (s, c) = (g.sin(angle), g.cos(angle));
                let text = g.text(angle);
                found.push(Named {
                    words: format!("(cos({text}), sin({text}))"),
                    value: [c, s, zero],
                });
                found.push(Named {
                    words: format!("(-sin({text}), cos({text}))"),
                    value: [g.neg(s), c, zero],
                });
            }
        }
        for (b, end) in self.positions.iter().enumerate() {
            for (a, start) in self.positions[..b].iter().enumerate() {
                let words = format!("the line from {} to {}", self.names[a], self.names[b]);
                let value = unit(g, &difference(g, end, start));
                found.extend(value.map(|value| Named { words, value }));
            }
        }
        found
    }

    /// Axes: in the plane only the one across it.
    fn axes(&self, motion: &Motion<'_>) -> Vec<Named<Vector>> {
        let g = self.g;
        match self.dimension(motion) {
            0 | 1 => Vec::new(),
            2 => vec![Named {
                words: "the axis across the plane".into(),
                value: [g.zero(), g.zero(), g.one()],
            }],
            _ => self.directions(motion),
        }
    }

    /// The point with those coordinates for which every particle moves along one of the axes as fast as they do.
    fn carried(&self, motion: &Motion<'_>) -> Option<Named<Vector>> {
        let (g, system) = (self.g, motion.system);
        let carries = |symbol: Symbol, axis: usize| {
            self.positions.iter().all(|r| {
                let slopes = r.iter().map(|&x| g.diff(x, symbol)).enumerate();
                let unit = |i| if i == axis { g.one() } else { g.zero() };
                slopes.into_iter().all(|(i, slope)| slope == unit(i))
            })
        };
        let mut value = [g.zero(); 3];
        for (axis, component) in value.iter_mut().enumerate() {
            let mut own = system.coordinates.iter();
            if let Some(c) = own.find(|c| carries(c.q_symbol, axis)) {
                *component = c.q;
            }
        }
        let given = value.iter().filter(|&&x| !g.is_zero(x)).count();
        let texts: Vec<String> = value[..self.dimension(motion)]
            .iter()
            .map(|&x| g.text(x))
            .collect();
        let is_new = given > 1 && !self.positions.contains(&value);
        is_new.then(|| Named {
            words: format!("the point ({})", texts.join(", ")),
            value,
        })
    }

    fn points(&self) -> Vec<Named<Vector>> {
        let g = self.g;
        let mut found = vec![Named {
            words: "the origin".into(),
            value: [g.zero(); 3],
        }];
        let named = self.names.iter().zip(&self.positions);
        found.extend(named.map(|(name, &value)| Named {
            words: name.clone(),
            value,
        }));
        if self.names.len() > 1 {
            let whole = g.add(&self.masses);
            let sum = self.weighted(&self.positions);
            found.push(Named {
                words: "the centre of mass".into(),
                value: sum.map(|x| g.div(x, whole)),
            });
        }
        found
    }

    /// A point at rest about which the moment along a fixed direction is kept, where it is not the origin: for points A at rest
    /// (18) is `(Σ r × F)·e = A·(F × e)`, linear in A.
    fn at_rest(
        &self,
        cx: &Context<'_>,
        motion: &Motion<'_>,
        e: &Named<Vector>,
    ) -> Option<Named<Vector>> {
        let g = self.g;
        let moves = |s| motion.moves(s);
        if !e.value.iter().all(|&x| g.is_free_of(x, &moves)) {
            return None;
        }
        let own = self.positions.iter().zip(&self.forces);
        let moment = self.sum(own.map(|(r, f)| cross(g, r, f)));
        let force = self.sum(self.forces.iter().copied());
        let across = cross(g, &force, &e.value);
        let used: Vec<usize> = (0..3).filter(|&i| !g.is_zero(across[i])).collect();
        let mut columns: Vec<Vec<Expr>> = used.iter().map(|&i| vec![across[i]]).collect();
        columns.push(vec![dot(g, &moment, &e.value)]);
        let seed = cx.prover.points_seed();
        let ansatz = Ansatz::new(motion, &columns, &motion.manifold, &[], seed).ok()?;
        let found = ansatz.with_last()?;
        let (&last, others) = found.split_last()?;
        let mut value = [g.zero(); 3];
        for (&i, &c) in used.iter().zip(others) {
            value[i] = readable(g, g.neg(g.div(c, last)));
        }
        let texts: Vec<String> = (0..self.dimension(motion))
            .map(|i| g.text(value[i]))
            .collect();
        value.iter().any(|&x| !g.is_zero(x)).then(|| Named {
            words: format!("the point ({})", texts.join(", ")),
            value,
        })
    }

    /// K·e with the left side of (18a).
    fn along(&self, motion: &Motion<'_>, e: Named<Vector>) -> Kept {
        let g = self.g;
        let momentum = self.weighted(&self.velocities);
        let force = self.sum(self.forces.iter().copied());
        let turned = padded(g, &motion.derivatives(&e.value));
        Kept {
            value: dot(g, &momentum, &e.value),
            rate: g.add(&[dot(g, &momentum, &turned), dot(g, &force, &e.value)]),
            direction: e.words,
            point: None,
            as_stated: false,
            rooted: is_rooted(g, &e.value),
            also: Vec::new(),
        }
    }

    /// H_A·e with the left side of (18).
    fn about(&self, motion: &Motion<'_>, e: &Named<Vector>, a: &Named<Vector>) -> Kept {
        let g = self.g;
        let arms: Vec<Vector> = self
            .positions
            .iter()
            .map(|r| difference(g, r, &a.value))
            .collect();
        let moment = self.sum(
            arms.iter()
                .zip(&self.velocities)
                .zip(&self.masses)
                .map(|((arm, v), &m)| cross(g, arm, v).map(|x| g.mul(&[m, x]))),
        );
        let of_forces = self.sum(
            arms.iter()
                .zip(&self.forces)
                .map(|(arm, f)| cross(g, arm, f)),
        );
        let momentum = self.weighted(&self.velocities);
        let turned = padded(g, &motion.derivatives(&e.value));
        let moved = padded(g, &motion.derivatives(&a.value));
        Kept {
            direction: e.words.clone(),
            point: Some(a.words.clone()),
            as_stated: false,
            rooted: is_rooted(g, &e.value),
            also: Vec::new(),
            value: dot(g, &moment, &e.value),
            rate: g.add(&[
                dot(g, &momentum, &cross(g, &moved, &e.value)),
                dot(g, &moment, &turned),
                dot(g, &of_forces, &e.value),
            ]),
        }
    }
}

/// The vector of length one along another, up to its sign; `None` for the vector zero.
fn unit(g: &Graph, d: &Vector) -> Option<Vector> {
    let square = readable(g, dot(g, d, d));
    if g.is_zero(square) {
        return None;
    }
    let length = root_of_square(g, square).unwrap_or_else(|| g.sqrt(square));
    Some(d.map(|x| g.div(x, length)))
}

fn is_rooted(g: &Graph, e: &Vector) -> bool {
    let is_root = |e: Expr| g.as_integer(g.base_exponent(e).1).is_none();
    g.reachable(e).into_iter().any(is_root)
}

/// The root of what is written as a square, with one sign or the other.
fn root_of_square(g: &Graph, e: Expr) -> Option<Expr> {
    let half = |e: Expr| {
        let (base, exponent) = g.base_exponent(e);
        let exponent = g.as_integer(exponent).filter(|n| n % 2 == 0)?;
        Some(g.powi(base, exponent / 2))
    };
    if let Some(number) = g.as_number(e) {
        return Some(g.sqrt(g.number(number.clone())));
    }
    match g.node(e) {
        Node::Product {
            coefficient,
            factors,
        } => {
            let halves: Option<Vec<Expr>> = factors.iter().map(|&f| half(f)).collect();
            let root = g.sqrt(g.number(coefficient.clone()));
            Some(g.mul(&[&halves?[..], &[root]].concat()))
        }
        _ => half(e),
    }
}

/// The angles, functions of the place and the time, whose sine or cosine occurs.
fn angles(motion: &Motion<'_>) -> Vec<Expr> {
    let (system, g) = (motion.system, &motion.system.graph);
    let mut roots = vec![system.lagrangian];
    roots.extend(&system.forces);
    roots.extend(system.constraints.iter().map(|c| c.f));
    roots.extend(system.particles.iter().flat_map(|p| p.position.clone()));
    let velocities = system.velocity_symbols();
    let mut found = Vec::new();
    for e in g.reachable(&roots) {
        if let Node::Apply {
            function: Function::Sin | Function::Cos | Function::Tan,
            arguments,
        } = g.node(e)
        {
            let own = arguments.iter().copied();
            found.extend(own.filter(|&angle| {
                !g.is_free_of(angle, &|s| motion.moves(s)) && !g.contains_any(angle, &velocities)
            }));
        }
    }
    found.sort_by(|&a, &b| g.compare(a, b));
    found.dedup();
    found
}

/// At most so many candidates.
const CANDIDATES: usize = 120;

/// Momenta along directions that are kept, as far as points over a prime field tell.
///
/// # Errors
/// A sentence that says why the search could not be made.
pub fn directions(cx: &Context<'_>) -> Result<Searched, String> {
    let motion = Motion::of(cx)?;
    let swarm = Swarm::of(&motion);
    let all = swarm.directions(&motion).into_iter().take(CANDIDATES);
    let candidates = all.map(|e| swarm.along(&motion, e)).collect();
    kept(cx, &motion, candidates)
}

/// Moments of momentum about axes that are kept, likewise.
///
/// # Errors
/// A sentence that says why the search could not be made.
pub fn axes(cx: &Context<'_>) -> Result<Searched, String> {
    let motion = Motion::of(cx)?;
    let swarm = Swarm::of(&motion);
    let (axes, mut points) = (swarm.axes(&motion), swarm.points());
    points.extend(swarm.carried(&motion));
    let pairs = axes.iter().flat_map(|e| points.iter().map(move |a| (e, a)));
    let mut candidates: Vec<Kept> = pairs
        .take(CANDIDATES)
        .map(|(e, a)| swarm.about(&motion, e, a))
        .collect();
    for e in &axes {
        let point = swarm.at_rest(cx, &motion, e);
        candidates.extend(point.map(|a| swarm.about(&motion, e, &a)));
    }
    kept(cx, &motion, candidates)
}

/// Whether the masses are constant, as the theorems on momenta suppose.
pub(crate) fn masses_are_constant(cx: &Context<'_>) -> bool {
    let g = &cx.system.graph;
    let is_constant = |e: Expr| {
        g.is_free_of(e, &|s| {
            g.symbol_name(s) == "t" || cx.system.moves(g.symbol_name(s))
        })
    };
    mass::with_velocity(cx.system).is_none()
        && cx.system.particles.iter().all(|p| is_constant(p.mass))
}

/// The candidates that are kept in general, then those that are for the values of parameters that the model states.
fn kept(cx: &Context<'_>, motion: &Motion<'_>, candidates: Vec<Kept>) -> Result<Searched, String> {
    let tried = candidates.len();
    let mut all = kept_with(cx, motion, candidates.clone(), &[])?;
    let values = stated_values(cx);
    if values.is_empty() {
        return Ok(Searched { kept: all, tried });
    }
    let is_new = |c: &Kept| {
        let name = (&c.direction, &c.point);
        let is_same = |k: &Kept| {
            (&k.direction, &k.point) == name || k.also.iter().any(|(e, a)| (e, a) == name)
        };
        !all.iter().any(is_same)
    };
    let others = candidates.into_iter().filter(is_new).collect();
    // Where the stated values leave no points nothing is said of them.
    let stated = kept_with(cx, motion, others, &values).unwrap_or_default();
    all.extend(stated.into_iter().map(|kept| Kept {
        as_stated: true,
        ..kept
    }));
    Ok(Searched { kept: all, tried })
}

/// The values of parameters that the model states as numbers.
fn stated_values(cx: &Context<'_>) -> Vec<(Expr, Expr)> {
    let mut values = cx.system.parameter_values();
    values.retain(|(_, value)| cx.system.graph.symbols_in(&[*value]).is_empty());
    values
}

/// The candidates whose rate vanishes at points of the manifold, for given values of parameters, and whose value is not the same at all of
/// them; those that are multiples of one before them are named beside it. Few points have a square under each of many roots, so directions
/// with roots are looked at one by one.
fn kept_with(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    candidates: Vec<Kept>,
    stated: &[(Expr, Expr)],
) -> Result<Vec<Kept>, String> {
    let (single, together): (Vec<Kept>, Vec<Kept>) = candidates.into_iter().partition(|c| c.rooted);
    let mut different: Vec<WithValues> = Vec::new();
    let (field, found) = kept_together(cx, motion, together, stated)?;
    let is_multiple = |a: &[Residue], b: &[Residue]| {
        let mut pairs = a.iter().zip(b);
        pairs.all(|(&x, &y)| field.mul(x, b[0]) == field.mul(y, a[0]))
    };
    for (candidate, values) in found {
        let same = different
            .iter_mut()
            .find(|(_, own)| is_multiple(own, &values));
        match same {
            Some((first, _)) => first.beside(motion.system, candidate),
            None => different.push((candidate, values)),
        }
    }
    let mut kept: Vec<Kept> = different.into_iter().map(|(kept, _)| kept).collect();
    for candidate in single {
        // Where there are no points for a direction nothing is said of it.
        if let Ok((_, found)) = kept_together(cx, motion, vec![candidate], stated) {
            kept.extend(found.into_iter().map(|(kept, _)| kept));
        }
    }
    Ok(kept)
}

/// What is kept, with its values at some points.
type WithValues = (Kept, Vec<Residue>);

/// Those of some candidates that are kept, with their values at the same points of a field.
fn kept_together(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    candidates: Vec<Kept>,
    stated: &[(Expr, Expr)],
) -> Result<(PrimeField, Vec<WithValues>), String> {
    let outputs: Vec<Expr> = candidates.iter().flat_map(|c| [c.rate, c.value]).collect();
    let points = motion.points_with(&outputs, stated)?;
    let mut random = Random::stream(cx.prover.points_seed(), 1 << 22);
    let none = "no points of the constraint manifold were found over a prime field";
    let draw = draw_with_points(&points, &mut random).ok_or(none)?;
    let mut all = Vec::new();
    for _ in 0..3 {
        all.push(points.at(&draw, &mut random).ok_or(none)?);
    }
    let numbered = candidates.into_iter().enumerate();
    let kept = numbered.filter_map(|(i, candidate)| {
        let vanishes = all.iter().all(|at| at[2 * i].is_zero());
        let values: Vec<Residue> = all.iter().map(|at| at[2 * i + 1]).collect();
        let moves = values.iter().any(|&value| value != values[0]);
        (vanishes && moves).then_some((candidate, values))
    });
    Ok((draw.field, kept.collect()))
}
