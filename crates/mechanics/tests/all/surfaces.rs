//! Balls on curved surfaces: accelerations by every form against the second order of the contact, derived by hand from the momentum of the ball.

use super::bodies::{accelerations, FORMS};

const R: f64 = 1.3;
const BALL: f64 = 0.2;
const G: f64 = 9.81;

/// A homogeneous ball whose axes are those of the ground at the state that is looked at.
fn text(surface: &str) -> String {
    format!(
        "bodies.ball = {{ shape = \"ball\", mass = 0.7, radius = {BALL} }}\n\
         joints.free = {{ type = \"free\", child = \"ball\", sequence = \"zyx\", coordinates = [\"x\", \"y\", \"z\", \"a\", \"b\", \"c\"] }}\n\
         contacts.foot = {{ type = \"rolling\", body = \"ball\", surface = {{ {surface} }} }}\n"
    )
}

#[track_caller]
fn check(surface: &str, state: &[(&str, f64)], expected: [f64; 3]) {
    let written: Vec<(&str, String)> = state
        .iter()
        .map(|(name, x)| (*name, format!("{x:.17}")))
        .collect();
    let state: Vec<(&str, &str)> = written
        .iter()
        .map(|(name, x)| (*name, x.as_str()))
        .collect();
    for form in FORMS {
        let found = accelerations(&text(surface), form, &state, &["x''", "y''", "z''"]);
        for (own, hand) in found.iter().zip(expected) {
            assert!(
                (own - hand).abs() < 1e-9,
                "{form}: {found:?}, not {expected:?}, on {surface}"
            );
        }
    }
}

/// With the radius ρ = R − r of the path, the angle φ and the spin s about the normal, φ'' = 0 and z'' = −5/7 g − 2/7 r φ' s: moments about the
/// point of contact (E. J. Routh, Dynamics of a System of Rigid Bodies, Advanced Part, 1905, ch. V).
#[test]
fn a_ball_in_an_upright_cylinder() {
    let (reach, turn, rise, spin) = (R - BALL, 1.7, 0.6, 2.3);
    let state = [
        ("x", reach),
        ("z", 0.4),
        ("y'", reach * turn),
        ("z'", rise),
        ("a'", -reach * turn / BALL),
        ("b'", rise / BALL),
        ("c'", spin),
    ];
    let up = -5.0 / 7.0 * G - 2.0 / 7.0 * BALL * turn * spin;
    let surface = format!("shape = \"cylinder\", radius = {R}, inside = true");
    check(&surface, &state, [-reach * turn * turn, 0.0, up]);
}

/// A ball that rolls along a meridian without spin: the middle gains 5/7 g sin θ along it, and −v²/ρ across.
fn meridian(
    reach: f64,
    angle: f64,
    speed: f64,
    is_inside: bool,
) -> ([(&'static str, f64); 5], [f64; 3]) {
    let (sin, cos) = angle.sin_cos();
    // Downwards along the meridian.
    let along = [cos, -sin];
    let gained = 5.0 / 7.0 * G * sin;
    let across = -speed * speed / reach;
    // The point that touches lies towards the middle of the sphere outside, away from it inside.
    let turn = if is_inside {
        -speed / BALL
    } else {
        speed / BALL
    };
    let state = [
        ("x", reach * sin),
        ("z", reach * cos),
        ("x'", speed * along[0]),
        ("z'", speed * along[1]),
        ("b'", turn),
    ];
    let x = gained * along[0] + across * sin;
    let z = gained * along[1] + across * cos;
    (state, [x, 0.0, z])
}

#[test]
fn a_ball_on_a_sphere_outside_and_inside() {
    let (state, expected) = meridian(R + BALL, 0.6, 0.9, false);
    check(
        &format!("shape = \"sphere\", radius = {R}"),
        &state,
        expected,
    );
    let (state, expected) = meridian(R - BALL, 2.3, 0.9, true);
    check(
        &format!("shape = \"sphere\", radius = {R}, inside = true"),
        &state,
        expected,
    );
}

/// The same sphere as a surface of heights, with the point of contact on the radius through the middle.
#[test]
fn a_ball_on_heights() {
    let (state, expected) = meridian(R - BALL, 2.3, 0.9, true);
    let share = R / (R - BALL);
    let touching = [
        ("foot_u", state[0].1 * share),
        ("foot_u'", state[2].1 * share),
    ];
    let state = [&state[..], &touching[..]].concat();
    let height = format!(
        "height = \"-sqrt({}/100 - foot_u^2 - foot_w^2)\"",
        (R * R * 100.0).round()
    );
    check(&height, &state, expected);
}
