//! Momentum along a moving direction and moment of momentum about a moving axis, for particles (T3 §8.3).
//!
//! With the forces `F_a = m_a r_a''` on the particles, reactions among them, `K = Σ m r'`, `H_A = Σ (r - r_A) × m r'`:
//! `d/dt (K·e) = K·e' + F·e` (18a) and `d/dt (H_A·e) = K·(r_A' × e) + H_A·e' + M_A·e` (18), for any e and A that are functions of the
//! state. Directions e are searched among the axes, the directions that turn with an angle that occurs in sines and cosines, as φ or ωt,
//! and those from particle to particle; points A among the origin, the particles, the centre of mass and the point whose coordinates
//! carry all particles along, as that of contact of a blade. All other fixed directions and axes come from linear equations.

use super::fixed::{Axis, Fixed};
use super::motion::{draw_with_points, Motion, NO_POINTS};
use super::shown::readable;
use super::vectors::{axis_of, cross, difference, dot, is_zero, padded, text, Vector};
use chetaev_mechanics::{mass, particles, Context, Manifold, System};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};

/// A direction or an axis with what is kept.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The direction in words.
    pub direction: String,
    /// The point in words, for an axis.
    pub point: Option<String>,
    /// K·e or H_A·e.
    pub value: Expr,
    /// The same as a person writes it.
    pub shown: Expr,
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
    /// The direction, and the point of an axis.
    pub(crate) fn names(&self) -> (&str, Option<&str>) {
        (&self.direction, self.point.as_deref())
    }

    /// Names another candidate that is a multiple of this one; the one that is written shorter stands first.
    fn beside(&mut self, system: &System, mut other: Kept) {
        let size = |kept: &Kept| length(&system.graph, kept.shown);
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
    /// Those that the constraints make constant, where nothing is kept otherwise.
    pub constant: Vec<Kept>,
    /// How many were tried.
    pub tried: usize,
    /// Whether all other fixed directions or axes were looked at too.
    pub all_fixed: bool,
}

/// Names what is moved.
struct Named<T> {
    words: String,
    value: T,
}

const AXES: [&str; 3] = ["the x axis", "the y axis", "the z axis"];
const ACROSS: &str = "the axis across the plane";
const ORIGIN: &str = "the origin";

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
                    words: AXES[i].into(),
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
                words: ACROSS.into(),
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
        let is_new = given > 1 && !self.positions.contains(&value);
        is_new.then(|| Named {
            words: format!("the point {}", text(g, &value, self.dimension(motion))),
            value,
        })
    }

    fn points(&self) -> Vec<Named<Vector>> {
        let g = self.g;
        let mut found = vec![Named {
            words: ORIGIN.into(),
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

    /// All fixed directions and axes.
    fn fixed(&self, cx: &Context<'_>, motion: &Motion<'_>) -> Fixed {
        let own = self.positions.iter().zip(&self.forces);
        let moment = self.sum(own.map(|(r, f)| cross(self.g, r, f)));
        let force = self.sum(self.forces.iter().copied());
        Fixed::of(cx, motion, &force, &moment, self.dimension(motion))
    }

    /// The moment about a fixed axis, with what belongs to it in a screw; `None` for one that is among the candidates anyway.
    fn about_fixed(&self, motion: &Motion<'_>, axis: &Axis) -> Option<Kept> {
        let (g, dimension) = (self.g, self.dimension(motion));
        let own = axis_of(g, &axis.direction);
        let (at_origin, is_screw) = (is_zero(g, &axis.point), !g.is_zero(axis.pitch));
        if own.is_some() && at_origin && !is_screw {
            return None;
        }
        let e = Named {
            words: match own {
                Some(_) if dimension == 2 => ACROSS.to_owned(),
                Some(i) => AXES[i].to_owned(),
                None => text(g, &axis.direction, dimension),
            },
            value: axis.direction,
        };
        let a = Named {
            words: match at_origin {
                true => ORIGIN.to_owned(),
                false => format!("the point {}", text(g, &axis.point, dimension)),
            },
            value: axis.point,
        };
        let moment = self.about(motion, &e, &a);
        Some(match is_screw {
            true => self.screw(moment, &self.along(motion, e), axis.pitch),
            false => moment,
        })
    }

    /// A moment with a multiple of the momentum along its axis.
    fn screw(&self, moment: Kept, momentum: &Kept, pitch: Expr) -> Kept {
        let g = self.g;
        let times = match g.is_one(pitch) {
            true => String::new(),
            false => format!("{} times ", g.text(pitch)),
        };
        let with = |own: Expr, more: Expr| g.add(&[own, g.mul(&[pitch, more])]);
        let value = with(moment.value, momentum.value);
        let point = moment
            .point
            .map(|a| format!("{a} with {times}the momentum along it (a screw)"));
        Kept {
            point,
            value,
            shown: readable(g, value),
            rate: with(moment.rate, momentum.rate),
            ..moment
        }
    }

    /// K·e with the left side of (18a).
    fn along(&self, motion: &Motion<'_>, e: Named<Vector>) -> Kept {
        let g = self.g;
        let momentum = self.weighted(&self.velocities);
        let force = self.sum(self.forces.iter().copied());
        let turned = padded(g, &motion.derivatives(&e.value));
        let value = dot(g, &momentum, &e.value);
        Kept {
            value,
            shown: readable(g, value),
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
        let value = dot(g, &moment, &e.value);
        Kept {
            direction: e.words.clone(),
            point: Some(a.words.clone()),
            as_stated: false,
            rooted: is_rooted(g, &e.value),
            also: Vec::new(),
            value,
            shown: readable(g, value),
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
    let fixed = swarm.fixed(cx, &motion);
    let oblique = fixed.directions.into_iter();
    let oblique = oblique.filter(|e| axis_of(swarm.g, e).is_none());
    let named = oblique.map(|value| Named {
        words: text(swarm.g, &value, swarm.dimension(&motion)),
        value,
    });
    let beside = named.map(|e| swarm.along(&motion, e)).collect();
    kept(cx, &motion, candidates, (beside, fixed.is_all))
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
    let candidates = pairs
        .take(CANDIDATES)
        .map(|(e, a)| swarm.about(&motion, e, a))
        .collect();
    let fixed = swarm.fixed(cx, &motion);
    let beside = fixed.axes.iter();
    let beside = beside.filter_map(|axis| swarm.about_fixed(&motion, axis));
    kept(cx, &motion, candidates, (beside.collect(), fixed.is_all))
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

/// The candidates, and the fixed ones found beside them, which may be all of these, that are kept in general; then those that are for the
/// values of parameters that the model states.
fn kept(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    mut candidates: Vec<Kept>,
    (fixed, all_fixed): (Vec<Kept>, bool),
) -> Result<Searched, String> {
    let tried = candidates.len();
    candidates.extend(fixed);
    let found = kept_with(cx, motion, candidates.clone(), &[])?;
    let mut searched = Searched {
        constant: Vec::new(),
        kept: found.moving,
        tried,
        all_fixed,
    };
    let stated = as_stated(cx, motion, &searched, candidates);
    searched.kept.extend(stated);
    if searched.kept.is_empty() {
        searched.constant = by_constraints(cx, motion, found.constant);
    }
    Ok(searched)
}

/// The candidates that are kept for the values of parameters that the model states, beside those that are in general.
fn as_stated(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    general: &Searched,
    candidates: Vec<Kept>,
) -> Vec<Kept> {
    let values = stated_values(cx);
    if values.is_empty() {
        return Vec::new();
    }
    let is_new = |c: &Kept| {
        let is_same = |k: &Kept| {
            let mut also = k.also.iter();
            k.names() == c.names() || also.any(|(e, a)| (&e[..], a.as_deref()) == c.names())
        };
        !general.kept.iter().any(is_same)
    };
    let others = candidates.into_iter().filter(is_new).collect();
    // Where the stated values leave no points nothing is said of them.
    let stated = kept_with(cx, motion, others, &values).unwrap_or_default();
    let own = stated.moving.into_iter();
    own.map(|kept| Kept {
        as_stated: true,
        ..kept
    })
    .collect()
}

/// Those of some candidates constant on the constraint manifold that contain velocities elsewhere, each value once.
fn by_constraints(cx: &Context<'_>, motion: &Motion<'_>, constant: Vec<Kept>) -> Vec<Kept> {
    let g = &motion.system.graph;
    if motion.system.constraints.is_empty() {
        return Vec::new();
    }
    let solved = motion.manifold.solved.iter();
    let solved: Vec<(Expr, Expr)> = solved.map(|&(s, e)| (g.symbol_expr(s), e)).collect();
    let is_still = |value: Expr| {
        let velocities = motion.system.velocity_symbols().into_iter();
        let slopes: Vec<Expr> = velocities.map(|v| g.diff(value, v)).collect();
        let everywhere = Manifold::default();
        let verdict = cx.prover.identity(motion.system, &slopes, &everywhere, "");
        matches!(verdict, Verdict::Proved(_))
    };
    let mut different: Vec<Kept> = Vec::new();
    for mut candidate in constant {
        if is_still(candidate.value) {
            continue;
        }
        candidate.shown = readable(g, g.substitute(candidate.value, &solved));
        let same = different.iter_mut().find(|own| {
            let sum = readable(g, g.add(&[own.shown, candidate.shown]));
            own.shown == candidate.shown || g.is_zero(sum)
        });
        match same {
            Some(own) => own.beside(motion.system, candidate),
            None => different.push(candidate),
        }
    }
    different
}

/// The values of parameters that the model states as numbers.
fn stated_values(cx: &Context<'_>) -> Vec<(Expr, Expr)> {
    let mut values = cx.system.parameter_values();
    values.retain(|(_, value)| cx.system.graph.symbols_in(&[*value]).is_empty());
    values
}

/// Candidates whose rate vanishes at points of the manifold.
#[derive(Default)]
struct Found {
    /// Those whose value is not the same at all points.
    moving: Vec<Kept>,
    /// The others.
    constant: Vec<Kept>,
}

/// The candidates whose rate vanishes at points of the manifold, for given values of parameters; of those whose value is not the same at
/// all of them, those that are multiples of one before them are named beside it. Few points have a square under each of many roots, so
/// directions with roots are looked at one by one.
fn kept_with(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    candidates: Vec<Kept>,
    stated: &[(Expr, Expr)],
) -> Result<Found, String> {
    let (single, together): (Vec<Kept>, Vec<Kept>) = candidates.into_iter().partition(|c| c.rooted);
    let mut different: Vec<WithValues> = Vec::new();
    let mut constant = Vec::new();
    let is_constant = |values: &[Residue]| values.iter().all(|&value| value == values[0]);
    let (field, found) = kept_together(cx, motion, together, stated)?;
    let is_multiple = |a: &[Residue], b: &[Residue]| {
        let mut pairs = a.iter().zip(b);
        pairs.all(|(&x, &y)| field.mul(x, b[0]) == field.mul(y, a[0]))
    };
    for (candidate, values) in found {
        if is_constant(&values) {
            constant.push(candidate);
            continue;
        }
        let same = different
            .iter_mut()
            .find(|(_, own)| is_multiple(own, &values));
        match same {
            Some((first, _)) => first.beside(motion.system, candidate),
            None => different.push((candidate, values)),
        }
    }
    let mut moving: Vec<Kept> = different.into_iter().map(|(kept, _)| kept).collect();
    for candidate in single {
        // Where there are no points for a direction nothing is said of it.
        let Ok((_, found)) = kept_together(cx, motion, vec![candidate], stated) else {
            continue;
        };
        for (kept, values) in found {
            match is_constant(&values) {
                true => constant.push(kept),
                false => moving.push(kept),
            }
        }
    }
    Ok(Found { moving, constant })
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
    let draw = draw_with_points(&points, &mut random).ok_or(NO_POINTS)?;
    let mut all = Vec::new();
    for _ in 0..3 {
        all.push(points.at(&draw, &mut random).ok_or(NO_POINTS)?);
    }
    let numbered = candidates.into_iter().enumerate();
    let kept = numbered.filter_map(|(i, candidate)| {
        let vanishes = all.iter().all(|at| at[2 * i].is_zero());
        let values: Vec<Residue> = all.iter().map(|at| at[2 * i + 1]).collect();
        vanishes.then_some((candidate, values))
    });
    Ok((draw.field, kept.collect()))
}
