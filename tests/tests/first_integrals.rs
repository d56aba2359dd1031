//! First integrals of the gallery come out without hints: what the literature knows is a function of what is found.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use chetaev::geometry::noether::found::{found, Found};
use chetaev::geometry::noether::motion::Motion;
use chetaev::mechanics::{Context, Prepared, Prover, System};
use chetaev::model::{load, Model, NoFiles, Style};
use chetaev::study::registry;
use chetaev::symbolic::{Expr, Verdict};
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
    ("sphere-on-turntable", 4, &["center_x", "center_y"]),
    ("suslov", 1, &[]),
    // Euler: the moment of momentum in space, and the energy.
    ("rigid-body", 4, &[]),
    // Lagrange's top.
    ("heavy-top", 3, &[]),
    ("vertical-rolling-disc", 6, &[]),
    ("charged-particle", 5, &[]),
    ("moving-knife-edge", 5, &[]),
];

fn with<T>(name: &str, ask: impl FnOnce(&Context<'_>, &Found) -> T) -> T {
    let model = loaded(&gallery_path(&format!("{name}/model.toml")), &[]).model;
    within(&model.expect("the model is right"), ask)
}

fn within<T>(model: &Model, ask: impl FnOnce(&Context<'_>, &Found) -> T) -> T {
    let system = System::from_model(model).expect("a system");
    let prepared = Prepared::new(&system).expect("independent velocities");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    let found = found(&cx);
    ask(&cx, found.as_ref().as_ref().expect("a search"))
}

/// The rank of the derivatives of functions along the constraint manifold.
fn rank(cx: &Context<'_>, functions: &[Expr]) -> usize {
    let motion = Motion::of(cx).expect("accelerations");
    let matrix = motion.gradients(functions);
    let rank = cx.prover.rank(cx.system, &matrix, &motion.manifold);
    rank.expect("a rank").maximum
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

/// What a model made up states is a function of at most so many integrals that are found.
fn contains(text: &str, count: usize) {
    let loaded = load("model.toml", text, &NoFiles, &[]).into_result();
    let model = match loaded {
        Ok((model, _)) => model,
        Err(problems) => panic!("{text}{}", problems.render(Style::Plain)),
    };
    within(&model, |cx, found| {
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
/// integral is linear with polynomial coefficients. Routh's third one has the root of a long expression, which is no letter.
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
"#,
        2,
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
