//! First integrals of the gallery come out without hints: what the literature knows is a function of what is found.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

mod exponentials;
mod jumps;

use chetaev::geometry::noether::found::Found;
use chetaev::mechanics::Context;
use chetaev::symbolic::{Expr, Function, Verdict};
use chetaev_tests::searched::{in_context, made_up, rank, within};
use chetaev_tests::studied::{gallery_path, loaded};
use chetaev_tests::words::{in_parallel, none};

/// Model, number of functionally independent integrals in its families, and stated integrals that hold for derived parameters only.
const SYSTEMS: &[(&str, usize, &[&str])] = &[
    // T3 §8.4: four, and t φ' - φ beside them.
    ("skate-level", 5, &[]),
    // T3 §8.4: four, and t φ' - φ beside them.
    ("skate-incline", 5, &[]),
    // T3 §8.5: the ratio, the energy, the one with the time.
    ("appell-hamel", 5, &[]),
    // T3 §8.2: y', sqrt(1 + y^2) x'.
    ("particle-y-dx", 4, &[]),
    // Chaplygin 1903: the moment of momentum about the contact, and the energy.
    ("chaplygin-sphere", 4, &[]),
    // Hypergeometric integrals are in no elementary family: the energy only.
    ("falling-rolling-disc", 1, &[]),
    // Four free of the time, and the velocity turns at the rate κ Ω/(1 + κ) (2/7 of Ω for a homogeneous ball).
    ("sphere-on-turntable", 5, &["center_x", "center_y"]),
    // m y'/sqrt(1 - v²/c²) - F t beside the energy and the momentum along the constraint.
    ("relativistic-particle", 3, &[]),
    ("suslov", 1, &[]),
    // Euler: the moment of momentum in space, and the energy.
    ("rigid-body", 4, &[]),
    // Lagrange's top.
    ("heavy-top", 3, &[]),
    ("vertical-rolling-disc", 6, &[]),
    // Five free of a phase, and the velocity less the drift E/B turns at the rate B q/m: all that are there.
    ("charged-particle", 6, &[]),
    ("moving-knife-edge", 5, &[]),
    // The logarithm of the mass, and the momentum along the vertical; the thrust is along the velocity, so the path is a straight line:
    // beside y'/x' its places in two planes.
    ("rocket-on-appells-constraint", 5, &[]),
];

fn with<T>(name: &str, ask: impl FnOnce(&Context<'_>, &Found) -> T) -> T {
    let model = loaded(&gallery_path(&format!("{name}/model.toml")), &[]).model;
    within(&model.expect("the model is right"), ask)
}

#[test]
fn known_integrals_are_functions_of_those_found() {
    let failures = in_parallel(SYSTEMS, |&(name, count, except)| {
        with(name, |cx, found| {
            let mut wrong = Vec::new();
            let mut values: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
            if (found.integrals.len(), found.open) != (count, 0) {
                wrong.push(format!(
                    "{name}: {} integrals, {} open",
                    values.len(),
                    found.open
                ));
            }
            if found
                .integrals
                .iter()
                .any(|i| !matches!(i.verdict, Verdict::Proved(_)))
            {
                wrong.push(format!("{name}: an integral without proof"));
            }
            if rank(cx, &values) != count {
                wrong.push(format!("{name}: not independent"));
            }
            for (stated, value) in &cx.system.integrals {
                values.push(*value);
                if !except.contains(&stated.as_str()) && rank(cx, &values) != count {
                    wrong.push(format!("{name}: {stated} is not among those found"));
                }
                values.pop();
            }
            wrong
        })
    });
    none(failures.into_iter().flatten().collect());
}

/// Models of the gallery with up to four coordinates, constraints of first order, and where the search is made.
const SMALL: &[&str] = &[
    "appell-hamel",
    "chaplygin-sleigh",
    "charged-particle",
    "double-pendulum",
    "heavy-top",
    "isokinetic-particle",
    "moving-knife-edge",
    "particle-y-dx",
    "pendulum-particle",
    "relativistic-particle",
    "rigid-body",
    "rocket-on-appells-constraint",
    "roller-racer",
    "skate-incline",
    "skate-level",
    "suslov",
    "vertical-rolling-disc",
];

/// What the search of the usual work may cost: the unknowns of one family, of all together, and the multiplications of the
/// eliminations, u²(u + 6) for u unknowns and six more equations, counted and not timed.
const UNKNOWNS: (usize, usize, usize) = (700, 2_000, 500_000_000);

/// The search of small systems stays within the work stated for it, whatever the machine.
#[test]
fn the_search_of_small_systems_stays_within_its_work() {
    let failures = in_parallel(SMALL, |&name| {
        with(name, |cx, found| {
            let sizes = found.families.iter().map(|f| f.family.members.len());
            let sizes: Vec<usize> = sizes.collect();
            let all = sizes.iter().sum::<usize>();
            let cost = sizes.iter().map(|&u| u * u * (u + 6)).sum::<usize>();
            let components = found.momenta.iter().map(|m| m.functions.len());
            let components = components.max().unwrap_or(0) * cx.system.n();
            let largest = sizes.iter().copied().max().unwrap_or(0);
            println!(
                "{name}: {} coordinates, {sizes:?}, {all}, {cost}, {components}",
                cx.system.n()
            );
            let fits = cx.system.n() <= 4
                && largest <= UNKNOWNS.0
                && all <= UNKNOWNS.1
                && cost <= UNKNOWNS.2
                && components <= 4 * 60;
            (!fits).then(|| format!("{name}: {sizes:?}, {all} unknowns, {cost} multiplications, {components} components"))
        })
    });
    none(failures.into_iter().flatten().collect());
}

/// What a model made up states is a function of at most so many integrals that are found.
fn contains(text: &str, count: usize) {
    within(&made_up(text), |cx, found| {
        let g = &cx.system.graph;
        let shown: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
        assert_eq!((found.integrals.len(), found.open), (count, 0), "{shown:?}");
        let mut values: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
        for (name, value) in &cx.system.integrals {
            values.push(*value);
            assert_eq!(rank(cx, &values), count, "{name} is not among {shown:?}");
            values.pop();
        }
    });
}

/// Veselova 1986: a body that does not turn about a direction fixed in space keeps the two components of its moment of momentum
/// across it, and the energy.
#[test]
fn veselova() {
    contains(
        r#"
name = "veselova"
assumptions = ["0 < theta < pi"]
[coordinates]
phi = { unit = "rad" }
theta = { unit = "rad" }
psi = { unit = "rad" }
[parameters]
I1 = { value = 2, unit = "kg m^2" }
I2 = { value = 3, unit = "kg m^2" }
I3 = { value = 5, unit = "kg m^2" }
[define]
k1 = "I1 w1"
k2 = "I2 w2"
k3 = "I3 w3"
[lagrangian]
L = "(I1 w1^2 + I2 w2^2 + I3 w3^2)/2"
[quasi_velocities]
w1 = { value = "phi' sin(theta) sin(psi) + theta' cos(psi)", unit = "rad/s" }
w2 = { value = "phi' sin(theta) cos(psi) - theta' sin(psi)", unit = "rad/s" }
w3 = { value = "phi' cos(theta) + psi'", unit = "rad/s" }
[constraints]
no_spin = "phi' + psi' cos(theta) = 0"
[integrals]
energy = "(I1 w1^2 + I2 w2^2 + I3 w3^2)/2"
across = "k1 (cos(phi) cos(psi) - sin(phi) cos(theta) sin(psi)) - k2 (cos(phi) sin(psi) + sin(phi) cos(theta) cos(psi)) + k3 sin(phi) sin(theta)"
"#,
        3,
    );
}

/// Jellett 1872: a sphere whose mass centre lies on its axis of symmetry, beside the geometric one, rolls on a plane. Jellett's
/// integral is linear with polynomial coefficients; Routh's (Dynamics of a System of Rigid Bodies II, 1884) has the root of a factor of
/// the determinant of the mass matrix.
#[test]
fn tippe_top() {
    contains(
        r#"
name = "tippe-top"
coordinates = ["x", "y", "phi", "theta", "psi"]
assumptions = ["0 < theta < pi", "A > 0", "C > 0", "m > 0", "R > 0"]
[parameters]
A = 1
C = 1.2
m = 1
R = 1
a = 0.2
g = 9.81
[define]
gx = "x - a sin(theta) sin(phi)"
gy = "y + a sin(theta) cos(phi)"
gz = "-a cos(theta)"
[lagrangian]
T = "m (gx'^2 + gy'^2 + gz'^2)/2 + A (theta'^2 + phi'^2 sin(theta)^2)/2 + C (psi' + phi' cos(theta))^2/2"
V = "m g gz"
[constraints]
roll_x = "x' = R (theta' sin(phi) - psi' sin(theta) cos(phi))"
roll_y = "y' = -R (theta' cos(phi) + psi' sin(theta) sin(phi))"
[integrals]
jellett = "C (psi' + phi' cos(theta)) (a - R cos(theta)) - A R phi' sin(theta)^2"
routh = "(psi' + phi' cos(theta)) sqrt(A C + m A R^2 sin(theta)^2 + m C (a - R cos(theta))^2)"
"#,
        3,
    );
}

/// Closed forms of T3 §8, each among the integrals that are found: the ratio and the one with the time of Appell's machine, the
/// free sled's four, Euler's top.
#[test]
fn closed_forms() {
    contains(
        r#"
name = "appell"
coordinates = ["x", "y", "z"]
assumptions = ["sqrt(x'^2 + y'^2) > 0", "m > 0"]
[parameters]
m = 1
a = 2
g = 9.81
[define]
rho = "sqrt(x'^2 + y'^2)"
[lagrangian]
L = "m (x'^2 + y'^2 + z'^2)/2 - m g z"
[constraints]
cone = "z' = a rho"
[integrals]
ratio = "y'/x'"
slowing = "rho + g a t/(1 + a^2)"
energy = "m (1 + a^2) rho^2/2 + m g z"
"#,
        5,
    );
    contains(
        r#"
name = "sled"
coordinates = ["x", "y", "phi"]
[parameters]
m = 2
J = 3
[lagrangian]
L = "m (x'^2 + y'^2)/2 + J phi'^2/2"
[constraints]
blade = "x' sin(phi) - y' cos(phi) = 0"
[integrals]
forward = "x' cos(phi) + y' sin(phi)"
turning = "phi'"
along = "phi' x - (x' cos(phi) + y' sin(phi)) sin(phi)"
across = "phi' y + (x' cos(phi) + y' sin(phi)) cos(phi)"
"#,
        5,
    );
}

/// Hyperbolic functions that occur are letters of the families. Two potentials that separate; and the surface of revolution
/// dx² + cosh² x dy², whose moment is kept on the level and beside a field along it.
#[test]
fn hyperbolic_functions() {
    contains(
        r#"
name = "separated"
coordinates = ["x", "y", "z"]
[lagrangian]
L = "(x'^2 + y'^2 + z'^2)/2 - 3 cosh(x)^2 - sinh(2 y)"
[constraints]
c = "z' = 2 y' sinh(2 y)"
[integrals]
along_x = "x'^2/2 + 3 cosh(x)^2"
along_y = "y'^2 (1 + 4 sinh(2 y)^2)/2 + sinh(2 y)"
position = "z - cosh(2 y)"
"#,
        3,
    );
    contains(
        r#"
name = "catenoid"
coordinates = ["u", "phi"]
[parameters]
c = 2
[lagrangian]
L = "cosh(u/c)^2 (u'^2 + c^2 phi'^2)/2 - tanh(u/c)"
[integrals]
moment = "cosh(u/c)^2 phi'"
energy = "cosh(u/c)^2 (u'^2 + c^2 phi'^2)/2 + tanh(u/c)"
"#,
        2,
    );
}

/// All five integrals of a rocket on Appell's cone, by hand. Gravity and jet have their parts along the velocity and, for gravity, along
/// the reaction, so the horizontal path is straight: `y'/x'`, `y - x y'/x'` and, with `z' = a s` along it, `z - x z'/x'` (that is
/// `z ∓ a x √(1 + (y'/x')²)`). The reaction does no work, as `f = z' - a s` is homogeneous; hence `z' = κ v`, `κ = a/√(1 + a²)`, and
/// `m v' = b c - m g κ` with `m = m0 - b t` for the speed v. So `(m z')' = -b z' + κ b c - m g κ²`, which is integrated at sight, and
/// once more `z' = S - g κ² t - κ c log m`, where the integral of `log m` is `(m - m log m)/b`.
fn rocket_by_hand(cx: &Context<'_>) -> Vec<Expr> {
    let g = &cx.system.graph;
    let name = |name: &str, order: u32| g.symbol(name, order);
    let (a, b, c, t) = (name("a", 0), name("b", 0), name("c", 0), name("t", 0));
    let (m0, z, rise) = (name("m0", 0), name("z", 0), name("z", 1));
    let square = g.add(&[g.one(), g.powi(a, 2)]);
    let slope = g.div(g.mul(&[name("g", 0), g.powi(a, 2)]), square);
    let jet = g.div(g.mul(&[a, c]), g.sqrt(square));
    let mass = g.sub(m0, g.mul(&[b, t]));

    let direction = g.div(name("y", 1), name("x", 1));
    let line = g.sub(name("y", 0), g.mul(&[name("x", 0), direction]));
    let along = g.sub(z, g.div(g.mul(&[name("x", 0), rise]), name("x", 1)));
    let weight = g.mul(&[slope, t, g.sub(m0, g.div(g.mul(&[b, t]), g.integer(2)))]);
    let thrust = g.mul(&[jet, b, t]);
    let momentum = g.add(&[g.mul(&[mass, rise]), g.mul(&[b, z]), weight, g.neg(thrust)]);
    let burnt = g.sub(g.mul(&[m0, g.apply(Function::Log, &[mass])]), mass);
    let fall = g.div(g.mul(&[slope, g.powi(t, 2)]), g.integer(2));
    let driven = g.div(g.mul(&[jet, burnt]), b);
    let position = g.sub(g.sub(z, g.mul(&[t, rise])), g.add(&[fall, driven]));
    vec![direction, line, along, momentum, position]
}

/// The motion of the rocket has six variables with the time, so five independent integrals are all: those by hand are five, as many
/// are found, and each of those by hand is a function of those found.
#[test]
fn constant_roots_in_coefficients() {
    with("rocket-on-appells-constraint", |cx, found| {
        let by_hand = rocket_by_hand(cx);
        assert_eq!(rank(cx, &by_hand), 5);
        let mut values: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
        assert_eq!((values.len(), rank(cx, &values)), (5, 5));
        for wanted in by_hand {
            values.push(wanted);
            assert_eq!(rank(cx, &values), 5, "{}", cx.system.graph.text(wanted));
            values.pop();
        }
    });
}

/// The center of a ball on a turntable keeps its speed (Earnshaw 1844): what is found is a square less that of a linear integral.
#[test]
fn integrals_are_shortened_by_products_of_others() {
    with("sphere-on-turntable", |cx, found| {
        let g = &cx.system.graph;
        let shown: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
        assert!(shown.contains(&"x'^2 + y'^2".to_owned()), "{shown:?}");
    });
}

/// Tsiolkovsky 1903: with the relative velocity u of what is burnt, `v - u log m + g t` keeps its value, and so does the momentum with
/// what left it. A mass with a law of its own is a state: `m + k t` is an integral, and so is `m² (g - k z'²)` for a drop that grows
/// as it falls through a fog at rest, as `(m z')' = m g` and `m' = k m z'` give.
#[test]
fn masses_with_a_law_of_their_own() {
    contains(
        r#"
name = "rocket"
coordinates = ["x", "y"]
parameters = { k = 0.1, c = 2, g = 9.8 }
masses = { m = { rate = "-k", initial = 5 } }
[particles.rocket]
mass = "m"
position = ["x", "y"]
thrust = { relative_velocity = [0, "-c"] }
force = [0, "-m g"]
[integrals]
tsiolkovsky = "y' + c log(m) + g t"
burnt = "m + k t"
sideways = "x'"
shed = "m x' + k x"
"#,
        5,
    );
    contains(
        r#"
name = "drop"
coordinates = ["z"]
parameters = { k = 0.1, g = 9.8 }
masses = { m = { rate = "k m z'", initial = 1 } }
[particles.drop]
mass = "m"
position = ["z"]
force = ["m g"]
thrust = { absolute_velocity = [0] }
[integrals]
speed = "m^2 (g - k z'^2)"
gathered = "log(m) - k z"
"#,
        // With the time a third one: m z' is m times the speed, whose two exponentials are known, and this is one of them.
        3,
    );
}

/// Integrals quadratic in the velocities that turn with a polar angle, which occurs nowhere: those of Laplace, Runge and Lenz, and
/// Fradkin's tensor (1965), written in polar coordinates.
#[test]
fn integrals_that_turn_with_a_polar_angle() {
    let [plain, unit] = ["", " = { unit = \"rad\" }"].map(|unit| match unit {
        "" => "coordinates = [\"r\", \"phi\"]".to_owned(),
        _ => format!("[coordinates]\nr = {{ unit = \"m\" }}\nphi{unit}"),
    });
    for coordinates in [plain, unit] {
        let stated = |potential: &str, integrals: &str| {
            format!(
                "name = \"polar\"\nassumptions = [\"r > 0\"]\n{coordinates}\n[parameters]\nm = 1\nk = 2\n[lagrangian]\nL = \"m (r'^2 + r^2 phi'^2)/2 {potential}\"\n[integrals]\n{integrals}"
            )
        };
        contains(
            &stated(
                "+ k/r",
                r#"lenz_x = "m r^2 phi' (r' sin(phi) + r phi' cos(phi)) - k cos(phi)"
lenz_y = "m r^2 phi' (r' cos(phi) - r phi' sin(phi)) + k sin(phi)"
"#,
            ),
            3,
        );
        contains(
            &stated(
                "- k r^2/2",
                r#"fradkin_xx = "m (r' cos(phi) - r phi' sin(phi))^2 + k r^2 cos(phi)^2"
fradkin_xy = "m (r' cos(phi) - r phi' sin(phi)) (r' sin(phi) + r phi' cos(phi)) + k r^2 cos(phi) sin(phi)"
"#,
            ),
            3,
        );
    }
}

/// The momentum of a coordinate that L does not contain is known whatever functions it is made of, and a holonomic constraint is no
/// integral of the motion on it.
#[test]
fn momenta_and_what_constraints_fix() {
    contains(
        r#"
name = "logarithm"
coordinates = ["x", "y"]
assumptions = ["x > 1"]
[parameters]
a = 2
[lagrangian]
L = "x'^2/2 + (3 + log(x)) y'^2/2 - a x"
[integrals]
momentum = "(3 + log(x)) y'"
"#,
        2,
    );
    contains(
        r#"
name = "spherical pendulum"
coordinates = ["x", "y", "z"]
[parameters]
g = 9.81
[lagrangian]
L = "(x'^2 + y'^2 + z'^2)/2 - g z"
[constraints]
sphere = "x^2 + y^2 + z^2 = 1"
[integrals]
area = "x y' - y x'"
energy = "(x'^2 + y'^2 + z'^2)/2 + g z"
"#,
        2,
    );
}

/// Veselova's body again, where no unit says that φ is an angle, which occurs in no sine.
#[test]
fn angles_without_units() {
    contains(
        r#"
name = "veselova"
coordinates = ["phi", "theta", "psi"]
assumptions = ["0 < theta < pi"]
[parameters]
I1 = 2
I2 = 3
I3 = 5
[lagrangian]
L = "(I1 w1^2 + I2 w2^2 + I3 w3^2)/2"
[quasi_velocities]
w1 = "phi' sin(theta) sin(psi) + theta' cos(psi)"
w2 = "phi' sin(theta) cos(psi) - theta' sin(psi)"
w3 = "phi' cos(theta) + psi'"
[constraints]
no_spin = "phi' + psi' cos(theta) = 0"
[integrals]
across = "I1 w1 (cos(phi) cos(psi) - sin(phi) cos(theta) sin(psi)) - I2 w2 (cos(phi) sin(psi) + sin(phi) cos(theta) cos(psi)) + I3 w3 sin(phi) sin(theta)"
"#,
        3,
    );
}

/// Lagrange's top by the values of a model for tops in general: the spin is an integral for these values and for no others nearby.
#[test]
fn values_that_a_model_states() {
    let top = made_up(
        r#"
name = "top"
coordinates = ["phi", "theta", "psi"]
assumptions = ["0 < theta < pi"]
[parameters]
A = 1
B = 1
C = 2
P = 3
[lagrangian]
T = "(A w1^2 + B w2^2 + C w3^2)/2"
V = "P cos(theta)"
[quasi_velocities]
w1 = "phi' sin(theta) sin(psi) + theta' cos(psi)"
w2 = "phi' sin(theta) cos(psi) - theta' sin(psi)"
w3 = "phi' cos(theta) + psi'"
[integrals]
spin = "w3"
tilt = "theta'"
"#,
    );
    in_context(&top, |cx| {
        let family = cx.finding("noether.family");
        let detail = family.verdict.detail();
        assert!(
            detail.contains("where A = B, as the model states: w3"),
            "{detail}"
        );
        let spin = cx.finding("noether.inverse#spin");
        let Verdict::Conditional { condition, .. } = &spin.verdict else {
            panic!("{:?}", spin.verdict);
        };
        // Whatever the two are, as long as they are equal.
        assert!(
            condition.contains("B = A") && !condition.contains('1'),
            "{condition}"
        );
        let tilt = cx.finding("noether.inverse#tilt");
        assert!(matches!(tilt.verdict, Verdict::Refuted(_)));
    });
}

/// A free particle in the five-dimensional Heisenberg group: the reaction vanishes, E = 0 extends the forces, and ∂f/∂x = -y'/2 keeps
/// its value.
#[test]
fn extensions_in_five_dimensions() {
    let heisenberg = made_up(
        r#"
name = "heisenberg"
coordinates = ["x", "y", "u", "v", "z"]
[lagrangian]
L = "(x'^2 + y'^2 + u'^2 + v'^2 + z'^2)/2"
[constraints]
contact = "z' = (x y' - y x' + u v' - v u')/2"
"#,
    );
    in_context(&heisenberg, |cx| {
        let finding = cx.finding("noether.reduced-symmetry#1");
        assert!(
            matches!(finding.verdict, Verdict::Proved(_)),
            "{:?}",
            finding.verdict
        );
    });
}

/// Veselova's system as by hand, in the rates of Euler's angles: the components of the moment of momentum across the direction are
/// momenta with coefficients that contain 1/sin θ.
#[test]
fn veselova_without_quasi_velocities() {
    let rates = [
        "(phi' sin(theta) sin(psi) + theta' cos(psi))",
        "(phi' sin(theta) cos(psi) - theta' sin(psi))",
        "(phi' cos(theta) + psi')",
    ];
    let [w1, w2, w3] = rates;
    let across = format!(
        "2 {w1} (cos(phi) cos(psi) - sin(phi) cos(theta) sin(psi)) - 3 {w2} (cos(phi) sin(psi) + sin(phi) cos(theta) cos(psi)) + 5 {w3} sin(phi) sin(theta)"
    );
    contains(
        &format!(
            "name = \"veselova\"\nlagrangian = \"{w1}^2 + 3 {w2}^2/2 + 5 {w3}^2/2\"\n[coordinates]\nphi = {{ unit = \"rad\" }}\ntheta = {{ unit = \"rad\" }}\npsi = {{ unit = \"rad\" }}\n[constraints]\nno_spin = \"phi' + psi' cos(theta) = 0\"\n[integrals]\nacross = \"{across}\"\n"
        ),
        3,
    );
}

/// x' √(1 + 2 K y + y²) with K free: near K = 0 the root is real.
#[test]
fn roots_are_real_near_the_origin_of_free_parameters() {
    let text = "name = \"roots\"\ncoordinates = [\"x\", \"y\", \"z\"]\nparameters = [\"K\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2 + K x' z'\"\n[constraints]\nc = \"z' = y x'\"\n";
    within(&made_up(text), |cx, found| {
        let g = &cx.system.graph;
        let shown: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
        assert!(shown.iter().any(|e| e.contains("sqrt(1 + ")), "{shown:?}");
    });
}

/// The energy of a relativistic particle, and of a body in its angular velocities, as a person writes them.
#[test]
fn energies_as_they_are_written() {
    let shown = |name: &str| {
        with(name, |cx, found| {
            let own = found.integrals.iter();
            own.map(|i| cx.system.graph.text(i.shown))
                .collect::<Vec<String>>()
        })
    };
    let relativistic = shown("relativistic-particle");
    let energy = "m c^2/sqrt(1 - (s^2 + u^2)/c^2) - F y".to_owned();
    assert!(relativistic.contains(&energy), "{relativistic:?}");
    let sphere = shown("chaplygin-sphere");
    let energy = "1/2 m (x'^2 + y'^2) + 1/2 I1 w1^2 + 1/2 I2 w2^2 + 1/2 I3 w3^2".to_owned();
    assert!(sphere.contains(&energy), "{sphere:?}");
}

/// Under z' = y x' + x y' free motion on z = x y keeps x' y' (1 + x² + y²) (by hand), which is shorter without z'.
#[test]
fn integrals_in_independent_velocities_where_these_are_shorter() {
    let text = "name = \"saddle\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\nc = \"z' = y x' + x y'\"\n";
    within(&made_up(text), |cx, found| {
        let g = &cx.system.graph;
        let shown: Vec<String> = found.integrals.iter().map(|i| g.text(i.shown)).collect();
        let own = shown.iter().find(|e| e.contains("x' y'"));
        assert!(own.is_some_and(|e| !e.contains("z'")), "{shown:?}");
    });
}

/// A sphere that rolls and does not spin is Veselova's body with J = I + m r² (Koiller, Ehlers, Rios and Cabral 2005): its moment of
/// momentum keeps two components. The model's quasi-velocities are tied by its constraints.
#[test]
fn a_sphere_that_does_not_spin() {
    let text = r#"
name = "rubber"
assumptions = ["0 < theta < pi"]
parameters = { I1 = 1, I2 = 2, I3 = 3, m = 0.7, r = 1 }
[coordinates]
x = { unit = "m" }
y = { unit = "m" }
phi = { unit = "rad" }
theta = { unit = "rad" }
psi = { unit = "rad" }
[quasi_velocities]
w1 = "phi' sin(theta) sin(psi) + theta' cos(psi)"
w2 = "phi' sin(theta) cos(psi) - theta' sin(psi)"
w3 = "phi' cos(theta) + psi'"
[lagrangian]
T = "1/2 m (x'^2 + y'^2) + 1/2 (I1 w1^2 + I2 w2^2 + I3 w3^2)"
[constraints]
rx = "x' = r (theta' sin(phi) - psi' sin(theta) cos(phi))"
ry = "y' = -r (theta' cos(phi) + psi' sin(theta) sin(phi))"
rub = "phi' + psi' cos(theta) = 0"
[integrals]
Mx = "(I1 + m r^2) w1 (cos(psi) cos(phi) - cos(theta) sin(phi) sin(psi)) - (I2 + m r^2) w2 (sin(psi) cos(phi) + cos(theta) sin(phi) cos(psi)) + (I3 + m r^2) w3 sin(theta) sin(phi)"
My = "(I1 + m r^2) w1 (cos(psi) sin(phi) + cos(theta) cos(phi) sin(psi)) + (I2 + m r^2) w2 (cos(theta) cos(phi) cos(psi) - sin(psi) sin(phi)) - (I3 + m r^2) w3 sin(theta) cos(phi)"
"#;
    contains(text, 3);
}

/// A bicycle's energy stands for itself in the place of a root of it that is linear in the velocities, as it is shorter.
#[test]
fn the_energy_in_the_place_of_its_roots() {
    let text = r#"
name = "bicycle"
coordinates = ["x", "y", "th", "be"]
parameters = ["m", "J", "I", "l"]
[lagrangian]
T = "1/2 m (x'^2 + y'^2) + 1/2 J th'^2 + 1/2 I (th' + be')^2"
[constraints]
r1 = "x' sin(th) = y' cos(th)"
r2 = "x' sin(th + be) - y' cos(th + be) - l th' cos(be) = 0"
"#;
    within(&made_up(text), |_, found| {
        let names = found.integrals.iter().map(|i| i.name.as_deref());
        let names: Vec<Option<&str>> = names.collect();
        assert!(names.contains(&Some("the energy")), "{names:?}");
    });
    // Of the level skate both speeds are kept, and the energy is a function of these.
    with("skate-level", |cx, found| {
        let family = cx.finding("noether.family");
        let said = family.verdict.detail();
        assert!(said.contains("the energy is a function of these"), "{said}");
        assert!(found
            .integrals
            .iter()
            .all(|i| i.name.as_deref() != Some("the energy")));
    });
}
