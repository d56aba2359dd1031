//! Every pair of figures that touch, against the second order of the contact: along the motion with the accelerations of the model the
//! smallest distance of the two and the velocity of the point that touches stay zero. Both are computed here from points of the one figure and distances
//! from the other, by a search for the least distance, which knows nothing of how the contact was lowered.

use super::bodies::accelerations;

type Vector = [f64; 3];

/// The coordinates of the point of contact that a model has, by the place of the body, the point, and the parameters of the points here.
type Own = fn(&Place, Vector, [f64; 2]) -> Vec<(&'static str, f64)>;

fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn times(k: f64, a: Vector) -> Vector {
    a.map(|x| k * x)
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn turned(axis: usize, angle: f64, v: Vector) -> Vector {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let (sin, cos) = angle.sin_cos();
    let mut out = v;
    out[i] = cos * v[i] - sin * v[j];
    out[j] = sin * v[i] + cos * v[j];
    out
}

/// x, y, z, heading, lean and pitch of the body.
type Place = [f64; 6];

/// A vector of the body along the axes of the ground.
fn outward(q: &Place, v: Vector) -> Vector {
    turned(2, q[3], turned(0, q[4], turned(1, q[5], v)))
}

/// A point of the ground along the axes of the body, from its middle.
fn inward(q: &Place, x: Vector) -> Vector {
    let apart = [x[0] - q[0], x[1] - q[1], x[2] - q[2]];
    turned(1, -q[5], turned(0, -q[4], turned(2, -q[3], apart)))
}

fn angular_velocity(q: &Place, v: &Place) -> Vector {
    let lean = turned(2, q[3], [v[4], 0.0, 0.0]);
    let pitch = turned(2, q[3], turned(0, q[4], [0.0, v[5], 0.0]));
    plus([0.0, 0.0, v[3]], plus(lean, pitch))
}

// ---- bodies and grounds, each as points and as a distance

const RADIUS: f64 = 0.3;
const TUBE: f64 = 0.08;
const TAPER: f64 = 0.1;
const SEMIAXES: Vector = [0.35, 0.25, 0.3];

/// Points of a body by two parameters, in its own axes.
fn body_point(body: &str, p: [f64; 2]) -> Vector {
    let ([s0, c0], [s1, c1]) = ([p[0].sin(), p[0].cos()], [p[1].sin(), p[1].cos()]);
    match body {
        "tip" => [0.1, 0.05, -0.2],
        "rim" => [RADIUS * s0, 0.0, -RADIUS * c0],
        "torus" => {
            let reach = RADIUS + TUBE * c1;
            [reach * s0, TUBE * s1, -reach * c0]
        }
        "cone" => {
            let reach = RADIUS + TAPER * p[1];
            [reach * s0, p[1], -reach * c0]
        }
        "ellipsoid" => [
            SEMIAXES[0] * s0 * c1,
            SEMIAXES[1] * s1,
            -SEMIAXES[2] * c0 * c1,
        ],
        "ball" => [RADIUS * s0 * c1, RADIUS * s1, -RADIUS * c0 * c1],
        _ => [f64::NAN; 3],
    }
}

/// A function of a point in the axes of the body that is negative within it.
fn body_distance(body: &str, head: f64, x: Vector) -> f64 {
    let across = x[0].hypot(x[2]);
    match body {
        "rim" => (across - RADIUS).hypot(x[1]) - head,
        "torus" => (across - RADIUS).hypot(x[1]) - TUBE - head,
        "cone" => (across - RADIUS - TAPER * x[1]) / 1f64.hypot(TAPER) - head,
        "ball" => dot(x, x).sqrt() - RADIUS - head,
        "ellipsoid" => (0..3).map(|i| (x[i] / SEMIAXES[i]).powi(2)).sum::<f64>() - 1.0,
        "egg" => {
            x[0].powi(2) / 0.09 + x[1].powi(2) / 0.04 + x[2].powi(4) / 0.01 + x[2] * x[2] - 1.0
        }
        _ => f64::NAN,
    }
}

fn height(x: f64, y: f64) -> f64 {
    0.2 * x * x + 0.1 * (2.0 * y).sin() - 0.1 * x * y - 0.5 * y * y
}

/// A function of a point that is positive on the free side of a ground.
fn ground_distance(ground: &str, x: Vector) -> f64 {
    match ground {
        "plane" => x[2],
        "sphere" => dot(x, x).sqrt() - 1.3,
        "bowl" => 1.3 - dot(x, x).sqrt(),
        "cylinder" => x[1].hypot(x[2]) - 1.3,
        "tunnel" => 1.3 - x[1].hypot(x[2]),
        "heights" => x[2] - height(x[0], x[1]),
        "equation" => x[2] - 0.3 * (x[0] * x[0] + 2.0 * x[1] * x[1]),
        _ => f64::NAN,
    }
}

/// Points of a ground.
fn ground_point(ground: &str, p: [f64; 2]) -> Vector {
    match ground {
        "plane" => [p[0], p[1], 0.0],
        "sphere" => times(
            1.3,
            [p[0].sin() * p[1].cos(), p[1].sin(), p[0].cos() * p[1].cos()],
        ),
        "cylinder" => [p[1], 1.3 * p[0].sin(), 1.3 * p[0].cos()],
        "heights" => [p[0], p[1], height(p[0], p[1])],
        "rail" | "head" => [p[0], 0.1, 0.0],
        "curve" | "curved head" => [1.5 * p[0].sin(), 1.5 - 1.5 * p[0].cos(), 0.1 * p[0]],
        _ => [f64::NAN; 3],
    }
}

/// Points of one of both, and the distance from the other.
struct Pair {
    body: &'static str,
    ground: &'static str,
    /// How many parameters the points have, whether they are those of the ground, and where the search for the least distance begins.
    count: usize,
    by_ground: bool,
    start: [f64; 2],
    own: Own,
}

impl Pair {
    fn head(&self) -> f64 {
        match self.ground {
            "head" | "curved head" => 0.05,
            _ => 0.0,
        }
    }

    fn distance(&self, q: &Place, p: [f64; 2]) -> f64 {
        if self.by_ground {
            let x = inward(q, ground_point(self.ground, p));
            body_distance(self.body, self.head(), x)
        } else {
            let x = plus([q[0], q[1], q[2]], outward(q, body_point(self.body, p)));
            ground_distance(self.ground, x)
        }
    }

    /// The parameters at which the distance is least: Newton's method with differences.
    fn nearest(&self, q: &Place, mut p: [f64; 2]) -> [f64; 2] {
        const H: f64 = 1e-4;
        for _ in 0..60 {
            let at = |i: f64, j: f64| self.distance(q, [p[0] + i * H, p[1] + j * H]);
            let (here, slope) = (
                at(0.0, 0.0),
                [at(1.0, 0.0) - at(-1.0, 0.0), at(0.0, 1.0) - at(0.0, -1.0)],
            );
            let slope = slope.map(|d| d / (2.0 * H));
            let bend = [
                (at(1.0, 0.0) + at(-1.0, 0.0) - 2.0 * here) / (H * H),
                (at(0.0, 1.0) + at(0.0, -1.0) - 2.0 * here) / (H * H),
            ];
            let mixed =
                (at(1.0, 1.0) + at(-1.0, -1.0) - at(1.0, -1.0) - at(-1.0, 1.0)) / (4.0 * H * H);
            let step = match self.count {
                0 => return p,
                1 => [slope[0] / bend[0], 0.0],
                _ => {
                    let det = bend[0] * bend[1] - mixed * mixed;
                    [
                        (slope[0] * bend[1] - slope[1] * mixed) / det,
                        (slope[1] * bend[0] - slope[0] * mixed) / det,
                    ]
                }
            };
            p = [
                p[0] - step[0].clamp(-0.3, 0.3),
                p[1] - step[1].clamp(-0.3, 0.3),
            ];
        }
        p
    }

    /// The least distance, and the point that touches: of a rail with a head on the figure of the body.
    fn touch(&self, q: &Place) -> (f64, Vector) {
        let p = self.nearest(q, self.start);
        let point = if self.by_ground {
            let at = ground_point(self.ground, p);
            let slope = |i: usize| {
                let mut e = [0.0; 3];
                e[i] = 1e-5;
                let value = |k: f64| {
                    body_distance(self.body, self.head(), inward(q, plus(at, times(k, e))))
                };
                (value(1.0) - value(-1.0)) / 2e-5
            };
            let out = [slope(0), slope(1), slope(2)];
            // From the line to the body.
            plus(at, times(-self.head() / dot(out, out).sqrt(), out))
        } else {
            plus([q[0], q[1], q[2]], outward(q, body_point(self.body, p)))
        };
        (self.distance(q, p), point)
    }

    /// Moves the body up or down until it touches.
    fn settled(&self, mut q: Place) -> Place {
        let mut before = (q[2], self.touch(&q).0);
        q[2] += 0.01;
        for _ in 0..60 {
            let now = (q[2], self.touch(&q).0);
            if (now.1 - before.1).abs() < 1e-15 {
                break;
            }
            let step = now.1 * (now.0 - before.0) / (now.1 - before.1);
            before = now;
            q[2] -= step.clamp(-0.2, 0.2);
        }
        q
    }

    fn slip(&self, q: &Place, v: &Place) -> Vector {
        let (_, point) = self.touch(q);
        let arm = [point[0] - q[0], point[1] - q[1], point[2] - q[2]];
        plus([v[0], v[1], v[2]], cross(angular_velocity(q, v), arm))
    }

    fn text(&self, kind: &str) -> String {
        let shape = match self.body {
            "rim" | "cone" => format!("shape = \"disc\", radius = {RADIUS}, "),
            "torus" => format!("shape = \"torus\", radius = {RADIUS}, tube = {TUBE}, "),
            "ball" => format!("shape = \"ball\", radius = {RADIUS}, "),
            "ellipsoid" => format!("shape = \"ellipsoid\", semiaxes = {SEMIAXES:?}, "),
            _ => String::new(),
        };
        let figure = match self.body {
            "tip" => "at = [0.1, 0.05, -0.2]".to_owned(),
            "cone" => format!("taper = {TAPER}"),
            "egg" => "figure = { equation = \"u^2/0.09 + v^2/0.04 + w^4/0.01 + w^2 - 1\", coordinates = [\"u\", \"v\", \"w\"] }".to_owned(),
            _ => String::new(),
        };
        let surface = match self.ground {
            "plane" => String::new(),
            "sphere" => "shape = \"sphere\", radius = 1.3".to_owned(),
            "bowl" => "shape = \"sphere\", radius = 1.3, inside = true".to_owned(),
            "cylinder" => "shape = \"cylinder\", radius = 1.3, axis = \"x\"".to_owned(),
            "tunnel" => {
                "shape = \"cylinder\", radius = 1.3, axis = \"x\", inside = true".to_owned()
            }
            "heights" => {
                "height = \"0.2 u^2 + 0.1 sin(2 w) - 0.1 u w - 0.5 w^2\", coordinates = [\"u\", \"w\"]"
                    .to_owned()
            }
            "equation" => "equation = \"z - 0.3 (x^2 + 2 y^2)\"".to_owned(),
            "rail" => "shape = \"rail\", at = [0, 0.1, 0]".to_owned(),
            "head" => "shape = \"rail\", at = [0, 0.1, 0], radius = 0.05".to_owned(),
            _ => {
                let head = if self.head() > 0.0 {
                    ", radius = 0.05"
                } else {
                    ""
                };
                format!("curve = [\"1.5 sin(s)\", \"1.5 - 1.5 cos(s)\", \"0.1 s\"], coordinate = \"s\"{head}")
            }
        };
        let surface = match surface.as_str() {
            "" => surface,
            _ => format!("surface = {{ {surface} }}"),
        };
        // A joint with a place of its own keeps the contact a constraint.
        let parts = [format!("type = \"{kind}\", body = \"b\""), figure, surface];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        format!(
            "bodies.b = {{ {shape}mass = 0.7, inertia = [0.02, 0.03, 0.04] }}\n\
             joints.free = {{ type = \"free\", child = \"b\", at = [0, 0, 0], coordinates = [\"x\", \"y\", \"z\", \"a\", \"b_\", \"c\"] }}\n\
             contacts.foot = {{ {} }}\n",
            parts.join(", ")
        )
    }
}

const NAMES: [&str; 6] = ["x", "y", "z", "a", "b_", "c"];

fn none(_: &Place, _: Vector, _: [f64; 2]) -> Vec<(&'static str, f64)> {
    Vec::new()
}

/// Where the body is before it is settled, and how it turns.
const ANGLES: [f64; 3] = [0.3, 0.25, 0.2];
const RATES: [f64; 3] = [0.7, -0.4, 1.9];

fn moved(q: &Place, v: &Place, a: &Place, t: f64) -> Place {
    std::array::from_fn(|i| q[i] + v[i] * t + a[i] * t * t / 2.0)
}

/// The limit of a difference with an error of second order in its step (L. F. Richardson, 1911).
fn extrapolated(difference: &dyn Fn(f64) -> f64) -> f64 {
    const H: f64 = 1e-3;
    (4.0 * difference(H) - difference(2.0 * H)) / 3.0
}

fn check(pair: &Pair, at: [f64; 3]) {
    let name = format!("{} on {}", pair.body, pair.ground);
    let q = pair.settled([at[0], at[1], at[2], ANGLES[0], ANGLES[1], ANGLES[2]]);
    assert!(
        pair.touch(&q).0.abs() < 1e-12,
        "{name}: {:?}",
        pair.touch(&q)
    );
    // The point that touches is at rest.
    let turning = [0.0, 0.0, 0.0, RATES[0], RATES[1], RATES[2]];
    let slip = pair.slip(&q, &turning);
    let v = [-slip[0], -slip[1], -slip[2], RATES[0], RATES[1], RATES[2]];
    let still = [0.0; 6];
    let own = |t: f64| {
        let q = moved(&q, &v, &still, t);
        (pair.own)(&q, pair.touch(&q).1, pair.nearest(&q, pair.start))
    };
    let mut state: Vec<(String, String)> = Vec::new();
    for i in 0..6 {
        state.push((NAMES[i].to_owned(), format!("{:.17}", q[i])));
        state.push((format!("{}'", NAMES[i]), format!("{:.17}", v[i])));
    }
    for ((own, before), after) in own(0.0).iter().zip(own(-1e-4)).zip(own(1e-4)) {
        state.push((own.0.to_owned(), format!("{:.17}", own.1)));
        state.push((
            format!("{}'", own.0),
            format!("{:.17}", (after.1 - before.1) / 2e-4),
        ));
    }
    let state: Vec<(&str, &str)> = state
        .iter()
        .map(|(a, b)| (a.as_str(), b.as_str()))
        .collect();
    let asked: Vec<String> = NAMES.iter().map(|name| format!("{name}''")).collect();
    let asked: Vec<&str> = asked.iter().map(String::as_str).collect();
    for kind in ["rolling", "sliding"] {
        if (kind, pair.body) == ("rolling", "tip") {
            continue;
        }
        let text = pair.text(kind);
        let found = accelerations(&text, "routh", &state, &asked);
        let balanced = accelerations(&text, "newton-euler", &state, &asked);
        for (one, other) in found.iter().zip(&balanced) {
            assert!(
                (one - other).abs() < 1e-5 * (1.0 + one.abs()),
                "{name}, {kind}: {found:?} and {balanced:?}"
            );
        }
        let a: Place = std::array::from_fn(|i| found[i]);
        let distance = |t: f64| pair.touch(&moved(&q, &v, &a, t)).0;
        let bend = |h: f64| (distance(h) + distance(-h) - 2.0 * distance(0.0)) / (h * h);
        let bend = extrapolated(&bend);
        assert!(
            bend.abs() < 2e-4,
            "{name}, {kind}: the distance bends by {bend}"
        );
        if kind == "sliding" {
            continue;
        }
        let slip = |t: f64| {
            let now: Place = std::array::from_fn(|i| v[i] + a[i] * t);
            pair.slip(&moved(&q, &v, &a, t), &now)
        };
        for i in 0..3 {
            let gained = extrapolated(&|h: f64| (slip(h)[i] - slip(-h)[i]) / (2.0 * h));
            assert!(
                gained.abs() < 2e-4,
                "{name}: the point that touches gains {gained}"
            );
        }
    }
}

fn pair(body: &'static str, ground: &'static str, by_ground: bool, count: usize) -> Pair {
    Pair {
        body,
        ground,
        count,
        by_ground,
        start: [0.0; 2],
        own: none,
    }
}

#[test]
fn figures_on_a_plane() {
    for body in ["rim", "torus", "ellipsoid", "ball"] {
        let count = if body == "rim" { 1 } else { 2 };
        check(&pair(body, "plane", false, count), [0.2, 0.1, 0.3]);
    }
    let egg = Pair {
        own: |q, x, _| vec![("foot_u", x[0] - q[0]), ("foot_w", x[1] - q[1])],
        ..pair("egg", "plane", true, 2)
    };
    let egg = Pair {
        start: [0.2, 0.1],
        ..egg
    };
    check(&egg, [0.2, 0.1, 0.3]);
}

#[test]
fn figures_that_are_stated_by_an_equation() {
    let at = [0.2, 0.1, 1.6];
    let sphere: Own = |_, _, p| vec![("foot_u", p[0]), ("foot_w", p[1])];
    let cylinder: Own = |q, _, p| vec![("foot_angle", p[0]), ("foot_w", p[1] - q[0])];
    let heights: Own = |_, _, p| vec![("u", p[0]), ("w", p[1])];
    let rail: Own = |q, _, p| vec![("foot_u", p[0] - q[0])];
    let curve: Own = |_, _, p| vec![("s", p[0])];
    check(
        &Pair {
            own: sphere,
            start: [0.15, 0.08],
            ..pair("egg", "sphere", true, 2)
        },
        at,
    );
    check(
        &Pair {
            own: cylinder,
            start: [0.08, 0.2],
            ..pair("egg", "cylinder", true, 2)
        },
        at,
    );
    let at = [0.2, 0.1, 0.3];
    check(
        &Pair {
            own: heights,
            start: [0.2, 0.1],
            ..pair("egg", "heights", true, 2)
        },
        at,
    );
    check(
        &Pair {
            own: rail,
            start: [0.2, 0.0],
            ..pair("egg", "rail", true, 1)
        },
        at,
    );
    check(
        &Pair {
            own: curve,
            start: [0.2, 0.0],
            ..pair("egg", "curve", true, 1)
        },
        [0.3, 0.05, 0.3],
    );
}

#[test]
fn figures_on_spheres_and_cylinders() {
    let rim_angle: Own = |q, x, _| {
        let own = turned(1, q[5], inward(q, x));
        vec![("foot_angle", own[0].atan2(-own[2]))]
    };
    for (ground, at) in [("sphere", [0.2, 0.1, 1.6]), ("bowl", [0.2, 0.1, -1.0])] {
        check(&pair("tip", ground, false, 0), at);
        check(&pair("rim", ground, false, 1), at);
        check(&pair("torus", ground, false, 2), at);
        let angles: Own = match ground {
            "sphere" => |_, x, _| {
                vec![
                    ("foot_u", x[0].atan2(x[2])),
                    ("foot_w", (x[1] / 1.3).asin()),
                ]
            },
            _ => |_, x, _| {
                vec![
                    ("foot_u", x[0].atan2(-x[2])),
                    ("foot_w", (x[1] / 1.3).asin()),
                ]
            },
        };
        check(
            &Pair {
                own: angles,
                ..pair("ellipsoid", ground, false, 2)
            },
            at,
        );
        if ground == "sphere" {
            check(
                &Pair {
                    own: angles,
                    ..pair("cone", ground, false, 2)
                },
                at,
            );
        }
    }
    for (ground, at) in [("cylinder", [0.2, 0.1, 1.6]), ("tunnel", [0.2, 0.1, -1.0])] {
        check(&pair("tip", ground, false, 0), at);
        check(
            &Pair {
                own: rim_angle,
                ..pair("rim", ground, false, 1)
            },
            at,
        );
        // The middle of the tube lies under the axle as the point of a rim does.
        let torus: Own = |q, x, _| {
            let own = turned(1, q[5], inward(q, x));
            vec![("foot_angle", own[0].atan2(-own[2]))]
        };
        check(
            &Pair {
                own: torus,
                ..pair("torus", ground, false, 2)
            },
            at,
        );
        let around: Own = match ground {
            "cylinder" => |_, x, _| vec![("foot_angle", x[1].atan2(x[2]))],
            _ => |_, x, _| vec![("foot_angle", x[1].atan2(-x[2]))],
        };
        check(
            &Pair {
                own: around,
                ..pair("ellipsoid", ground, false, 2)
            },
            at,
        );
        if ground == "cylinder" {
            check(
                &Pair {
                    own: around,
                    ..pair("cone", ground, false, 2)
                },
                at,
            );
        }
    }
}

#[test]
fn figures_on_heights() {
    let rim_angle: Own = |q, x, _| {
        let own = turned(1, q[5], inward(q, x));
        vec![("foot_angle", own[0].atan2(-own[2]))]
    };
    let level: Own = |_, x, _| vec![("u", x[0]), ("w", x[1])];
    let at = [0.2, 0.1, 0.3];
    check(&pair("tip", "heights", false, 0), at);
    check(&pair("tip", "equation", false, 0), at);
    for ground in ["heights", "equation"] {
        check(
            &Pair {
                own: rim_angle,
                ..pair("rim", ground, false, 1)
            },
            at,
        );
    }
    for body in ["torus", "ellipsoid", "ball"] {
        check(
            &Pair {
                own: level,
                ..pair(body, "heights", false, 2)
            },
            at,
        );
    }
    // The cone touches along a line but for how the ground bends across.
    let cone = Pair {
        own: level,
        ..pair("cone", "heights", false, 2)
    };
    check(&cone, [0.2, 0.05, 0.35]);
}

#[test]
fn figures_on_rails() {
    let at = [0.2, 0.1, 0.3];
    for ground in ["rail", "head"] {
        for body in ["ball", "cone"] {
            check(&pair(body, ground, true, 1), at);
        }
        let line: Own = |q, _, p| vec![("foot_u", p[0] - q[0])];
        check(
            &Pair {
                own: line,
                ..pair("torus", ground, true, 1)
            },
            at,
        );
    }
    check(&pair("ellipsoid", "rail", true, 1), at);
    check(
        &Pair {
            own: |q, _, p| vec![("foot_u", p[0] - q[0])],
            ..pair("rim", "head", true, 1)
        },
        at,
    );
    let at = [0.25, -0.05, 0.39];
    let along: Own = |_, _, p| vec![("s", p[0])];
    for body in ["ball", "torus", "cone", "ellipsoid"] {
        check(
            &Pair {
                own: along,
                start: [0.2, 0.0],
                ..pair(body, "curve", true, 1)
            },
            at,
        );
    }
    for body in ["ball", "torus", "cone", "rim"] {
        check(
            &Pair {
                own: along,
                start: [0.2, 0.0],
                ..pair(body, "curved head", true, 1)
            },
            at,
        );
    }
}

/// Near the middle of the track y'' = −γ v²/(r s) y and ψ'' = −γ v²/(r s) ψ with the slope γ of the wheels, half the gauge s and the speed v: the wave
/// length is 2π √(r s/γ) (J. Klingel, Über den Lauf der Eisenbahnwagen auf gerader Bahn, 1883). By hand: the wheel set turns about the line through both
/// points of contact, which yaws with the axle by ψ (1 − γ r/s), and the axle leans by γ y/(s − γ r); the two corrections cancel each other.
#[test]
fn a_wheel_set_has_the_wave_length_of_klingel() {
    let text = super::bodies::stated("wheel-set");
    let (r, s, slope, turn) = (0.46, 0.75, 0.05, 20.0);
    let small = 1e-5;
    let lean = slope / (s - slope * r);
    let rate = slope * turn * turn * r / s;
    let sideways = [
        ("y", small),
        ("roll", lean * small),
        ("yaw'", -lean * turn * small),
    ];
    let askew = [
        ("yaw", small),
        ("y'", turn * r * (1.0 - slope * r / s) * small),
        ("roll'", lean * turn * r * (1.0 - slope * r / s) * small),
    ];
    for (own, asked) in [(sideways, "y''"), (askew, "yaw''")] {
        let state = [&own[..], &[("z", r), ("x'", turn * r), ("pitch'", turn)]].concat();
        let state: Vec<(&str, String)> = state
            .iter()
            .map(|(name, x)| (*name, format!("{x:.17}")))
            .collect();
        let state: Vec<(&str, &str)> = state.iter().map(|(name, x)| (*name, x.as_str())).collect();
        for form in ["routh", "newton-euler"] {
            let found = accelerations(&text, form, &state, &[asked])[0];
            let expected = -rate * small;
            assert!(
                (found - expected).abs() < 1e-3 * expected.abs(),
                "{form}: {asked} = {found}, not {expected}"
            );
        }
    }
}
