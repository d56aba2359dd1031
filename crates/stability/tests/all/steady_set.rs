//! Complete sets of steady motions against the literature.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::Case;
use chetaev_stability::expansion::Expansion;
use chetaev_stability::guess::near;
use chetaev_stability::problem::LinearizationError;
use chetaev_stability::real_roots::sign_of;
use chetaev_stability::steady_set::{steady_set, Found, SteadySet, SteadySetError, Value};
use std::cmp::Ordering;

/// The steady motions for the values that the model states; each with a closed form is steady by the check that linearization makes, or refused
/// where something that is assumed does not hold.
fn found(case: &Case) -> SteadySet {
    let own = set(case).unwrap();
    let (terms, selection) = (&case.prepared.terms, &case.prepared.selection);
    for found in &own.found {
        let Some(motion) = &found.motion else {
            continue;
        };
        let values = case.system.parameter_values();
        let problem = Expansion::new(&case.system, terms, selection, motion, &values).err();
        let is_refused = matches!(problem, Some(LinearizationError::NotAssumed { .. }));
        assert!(problem.is_none() || is_refused, "{motion:?}: {problem:?}");
        assert_eq!(is_refused, !found.is_assumed, "{motion:?}");
    }
    own
}

fn set(case: &Case) -> Result<SteadySet, SteadySetError> {
    let (terms, selection) = (&case.prepared.terms, &case.prepared.selection);
    steady_set(
        &case.system,
        terms,
        selection,
        &case.system.parameter_values(),
    )
}

fn numbers(found: &Found) -> Vec<f64> {
    let number = |value: &Value| match value {
        Value::Number { ball, .. } => ball.to_f64(),
        _ => f64::NAN,
    };
    found.values.iter().map(number).collect()
}

/// Each row is among the isolated motions, and there are no others.
fn are(own: &SteadySet, expected: &[&[f64]]) {
    let points: Vec<Vec<f64>> = own.found.iter().map(numbers).collect();
    assert_eq!(points.len(), expected.len(), "{points:?}");
    for row in expected {
        let near = |point: &Vec<f64>| {
            let mut pairs = point.iter().zip(*row);
            pairs.all(|(a, b)| (a - b).abs() < 1e-14)
        };
        assert!(points.iter().any(near), "{row:?} is not in {points:?}");
    }
}

/// Numbers that are zero though no form shows it leave (x, x) at rest for all x: cos(2π/7) + cos(4π/7) + cos(6π/7) = −1/2,
/// cos 20° cos 40° cos 80° = 1/8, √2 + √3 = √(5 + 2√6). Where that is not decided nothing is said, as of Machin's 16 atan(1/5) − 4 atan(1/239) = π.
/// A number that is none leaves the origin.
#[test]
fn numbers_that_are_zero_by_no_form_leave_a_family() {
    let set_of = |number: &str| {
        set(&Case::new(&format!(
            r#"
coordinates = ["x", "y"]
lagrangian = "(x'^2 + y'^2)/2 - (x - y)^2 - ({number}) x y"
forces = {{ x = "-x'", y = "-y'" }}
"#
        )))
    };
    for zero in [
        "cos(2 pi/7) + cos(4 pi/7) + cos(6 pi/7) + 1/2",
        "cos(pi/9) cos(2 pi/9) cos(4 pi/9) - 1/8",
        "sqrt(2) + sqrt(3) - sqrt(5 + 2 sqrt(6))",
    ] {
        let found = set_of(zero).unwrap().found;
        let dimensions: Vec<usize> = found.iter().map(Found::dimension).collect();
        assert_eq!(dimensions, [1], "{zero}");
    }
    for open in [
        "16 atan(1/5) - 4 atan(1/239) - pi",
        "log(6) - log(2) - log(3)",
    ] {
        let said = set_of(open);
        assert!(
            matches!(said, Err(SteadySetError::Undecided { .. })),
            "{open}: {said:?}"
        );
    }
    for other in [
        "cos(2 pi/7) + cos(4 pi/7) + cos(6 pi/7) + 1/3",
        "sqrt(2) + sqrt(3) - sqrt(5 + 2 sqrt(7))",
        "sin(1) + cos(1) - pi/3",
    ] {
        let found = set_of(other).unwrap().found;
        let dimensions: Vec<usize> = found.iter().map(Found::dimension).collect();
        assert_eq!(dimensions, [0], "{other}");
    }
}

#[test]
fn a_double_pendulum_hangs_and_stands_in_four_ways() {
    let own = found(&Case::gallery("double-pendulum"));
    let pi = std::f64::consts::PI;
    let expected = [[0.0, 0.0], [0.0, pi], [pi, 0.0], [pi, pi]];
    let expected: Vec<Vec<f64>> = expected
        .iter()
        .map(|[a, b]| vec![*a, *b, 0.0, 0.0])
        .collect();
    let rows: Vec<&[f64]> = expected.iter().map(Vec::as_slice).collect();
    are(&own, &rows);
    assert!(own.ignorable.is_empty());
}

/// A pendulum whose plane turns with ω: beside hanging and standing it stays at cos θ = g/(l ω²) where that is below 1.
const TURNING: &str = r#"
coordinates = ["theta"]
[parameters]
l = 0.5
W = 6
g = 9.81
[lagrangian]
T = "1/2 l^2 (theta'^2 + W^2 sin(theta)^2)"
V = "-g l cos(theta)"
[initial]
theta = 1
"theta'" = 0
"#;

#[test]
fn a_turning_pendulum_has_four_equilibria_beyond_a_rate() {
    let own = found(&Case::new(TURNING));
    let (pi, lean) = (std::f64::consts::PI, (9.81_f64 / (0.5 * 36.0)).acos());
    are(
        &own,
        &[&[0.0, 0.0], &[pi, 0.0], &[lean, 0.0], &[-lean, 0.0]],
    );
    let slow = found(&Case::new(&TURNING.replace("W = 6", "W = 4")));
    are(&slow, &[&[0.0, 0.0], &[pi, 0.0]]);
}

/// x³ − 3x + 1 vanishes at 2 cos 40°, 2 cos 80° and −2 cos 20°.
#[test]
fn zeros_of_higher_degree_are_enclosed() {
    let own = found(&Case::new(
        r#"
coordinates = ["x"]
[lagrangian]
T = "1/2 x'^2"
V = "x^4/4 - 3/2 x^2 + x"
[initial]
x = 1
"x'" = 0
"#,
    ));
    let zero = |degrees: f64| 2.0 * degrees.to_radians().cos();
    are(
        &own,
        &[&[zero(40.0), 0.0], &[zero(80.0), 0.0], &[-zero(20.0), 0.0]],
    );
    // They are exact as algebraic numbers: the equation holds, and x³ − 3x + 1 itself vanishes, which no enclosure says.
    let case = Case::new(
        "coordinates = [\"x\"]\n[lagrangian]\nT = \"1/2 x'^2\"\nV = \"x^4/4 - 3/2 x^2 + x\"\n",
    );
    let g = &case.system.graph;
    for found in &found(&case).found {
        let x = found.motion.as_ref().unwrap().positions[0].unwrap();
        let cubic = g.substitute(case.read("x^3 - 3 x + 1"), &[(case.read("x"), x)]);
        assert_eq!(sign_of(g, cubic), Some(Ordering::Equal));
        let other = g.substitute(
            case.read("x^3 - 3 x + 1.0000000001"),
            &[(case.read("x"), x)],
        );
        assert_eq!(sign_of(g, other), Some(Ordering::Greater));
    }
}

#[test]
fn the_sleigh_goes_straight_on_at_any_speed() {
    let own = found(&Case::gallery("chaplygin-sleigh"));
    assert_eq!(own.found.len(), 1, "{:?}", own.found);
    assert_eq!(own.found[0].dimension(), 1);
    let motion = own.found[0].motion.as_ref().unwrap();
    let case = Case::gallery("chaplygin-sleigh");
    let turn = case.system.coordinates.iter().position(|c| c.name == "phi");
    assert!(motion.velocities[turn.unwrap()].is_some_and(|v| case.system.graph.is_zero(v)));
}

/// The axis of the top is vertical, up or down, with any two rates, or leans and precesses with A cos θ φ'² − C ω₃ φ' + m g l = 0
/// (Goldstein, Classical Mechanics, sec. 5.7).
#[test]
fn a_top_sleeps_hangs_or_precesses() {
    let case = Case::gallery("heavy-top");
    let own = found(&case);
    assert_eq!(own.found.len(), 3, "{:?}", own.found);
    assert!(own
        .found
        .iter()
        .all(|found| found.dimension() == 2 && found.is_real));
}

/// A disc rolls straight on upright, or leans at θ and goes round with Ω, with (C + m r²) ω₂ Ω cos θ = A Ω² sin θ cos θ − m g r sin θ and
/// ω₂ = ψ' + Ω sin θ (Routh, Advanced rigid dynamics, 1905, art. 244).
#[test]
fn a_disc_rolls_straight_on_or_in_circles() {
    let case = Case::gallery("falling-rolling-disc");
    let own = found(&case);
    assert!(own.has_full_rank);
    let dimensions: Vec<usize> = own.found.iter().map(Found::dimension).collect();
    // Upright with the rim below, and above the floor as the equations do not know of it.
    assert_eq!(dimensions, [1, 1, 2]);
    let circle = own.found[2].motion.as_ref().unwrap();
    let place = |name: &str| {
        let mut names = case.system.coordinates.iter();
        names.position(|c| c.name == name).unwrap()
    };
    let of = |name: &str| {
        let own = case.system.parameters.iter().find(|p| p.name == name);
        case.number(own.unwrap().value.unwrap(), &[])
    };
    let ([m, g, r], [a, c]) = (["m", "g", "r"].map(of), ["A", "Cc"].map(of));
    for (theta, turn) in [(0.3_f64, 2.0_f64), (-0.7, 5.0), (1.1, -3.0)] {
        let free = [("theta_0", theta), ("phi_rate_0", turn)];
        let spin = case.number(circle.velocities[place("psi")].unwrap(), &free);
        let along_axle = spin + turn * theta.sin();
        let left = (c + m * r * r) * along_axle * turn * theta.cos();
        let right = a * turn * turn * theta.sin() * theta.cos() - m * g * r * theta.sin();
        assert!((left - right).abs() < 1e-12 * right.abs(), "{left} {right}");
    }
}

/// A ball in a vertical cylinder neither rises nor sinks where its spin about the normal balances gravity; its orientation is no matter.
#[test]
fn the_orientation_of_a_ball_is_no_variable() {
    let own = found(&Case::gallery("ball-in-cylinder"));
    assert_eq!(own.variables, ["u", "v", "N"]);
    assert!(own
        .found
        .iter()
        .any(|found| found.dimension() == 1 && found.is_real));
}

/// A particle in a potential like a hat rests on the top, or anywhere on the brim, a circle.
#[test]
fn a_hat_has_a_circle_of_equilibria() {
    let own = found(&Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
V = "1/2 (x^2 + y^2 - 1)^2"
[initial]
x = 1
y = 0
"x'" = 0
"y'" = 0
"#,
    ));
    // A circle of equilibria beside the one in its center.
    let dimensions: Vec<usize> = own.found.iter().map(Found::dimension).collect();
    assert_eq!(dimensions.first(), Some(&0));
    assert!(dimensions[1..].iter().all(|&d| d == 1), "{dimensions:?}");
}

/// Potentials that are least at points, though over the complex numbers they are so on curves: x² + y² = 0 has one real point, ((x − 1)² + x² y²)²
/// is least at (1, 0), ((1 − cos θ)² + x²)² at (0, 0), and beside it the potential has a saddle at (0, π). V = ((x − y)² + (y − z)²)² is least on the
/// line x = y = z.
#[test]
fn points_of_complex_families_are_found_as_points() {
    let of = |coordinates: &str, squares: &str, potential: &str| {
        let case = Case::new(&format!(
            r#"
coordinates = [{coordinates}]
[lagrangian]
T = "1/2 ({squares})"
V = "{potential}"
"#
        ));
        found(&case)
    };
    let plane = |potential| of("\"x\", \"y\"", "x'^2 + y'^2", potential);
    are(&plane("(x^2 + y^2)^2"), &[&[0.0; 4]]);
    are(&plane("(x^2 + x y + y^2)^3"), &[&[0.0; 4]]);
    are(&plane("((x - 1)^2 + x^2 y^2)^2"), &[&[1.0, 0.0, 0.0, 0.0]]);
    let pi = std::f64::consts::PI;
    let turning = of("\"x\", \"th\"", "x'^2 + th'^2", "((1 - cos(th))^2 + x^2)^2");
    are(&turning, &[&[0.0; 4], &[0.0, pi, 0.0, 0.0]]);
    let quadratic = of("\"x\", \"th\"", "x'^2 + th'^2", "(1 - cos(th) + x^2)^2");
    are(&quadratic, &[&[0.0; 4], &[0.0, pi, 0.0, 0.0]]);
    let space = |potential| {
        let own = of("\"x\", \"y\", \"z\"", "x'^2 + y'^2 + z'^2", potential);
        own.found.iter().map(Found::dimension).collect::<Vec<_>>()
    };
    assert_eq!(space("(x^2 + y^2 + z^2)^2"), [0]);
    assert_eq!(space("((x - y)^2 + (y - z)^2)^2"), [1]);
    assert_eq!(space("(x^2 + y^2 - z^2)^2"), [2, 2]);
}

/// The motion that is meant by guesses, in numbers: positions, then velocities.
fn meant(case: &Case) -> Result<Vec<f64>, String> {
    let (terms, selection) = (&case.prepared.terms, &case.prepared.selection);
    let values = case.system.parameter_values();
    let motion = &case.system.steady[0];
    let found = near(&case.system, terms, selection, (motion, &values));
    let found = found.map_err(|problem| problem.to_string())?;
    assert!(found.guesses.is_empty());
    let about = Expansion::new(&case.system, terms, selection, motion, &values);
    assert!(about.is_ok(), "{:?}", about.err());
    let all = found.positions.iter().chain(&found.velocities);
    let all = all.map(|e| case.system.graph.substitute(e.unwrap(), &values));
    let number = |e| case.system.graph.evaluate_f64(&[e], &|_| None).unwrap()[0];
    Ok(all.map(number).collect())
}

/// The turning pendulum stays at cos θ = g/(l ω²) on both sides, hangs and stands: each is found from a guess nearer to it than to the others.
#[test]
fn the_motion_nearest_to_a_guess_is_meant() {
    let with = |theta: &str| {
        Case::new(&format!(
            "{TURNING}[steady.aside]\ntheta = {theta}\n\"theta'\" = 0\n"
        ))
    };
    let lean = (9.81_f64 / (0.5 * 36.0)).acos();
    let pi = std::f64::consts::PI;
    for (guess, expected) in [(0.9, lean), (-0.6, -lean), (0.3, 0.0), (3.0, pi)] {
        let found = meant(&with(&format!("{{ guess = {guess} }}"))).unwrap();
        assert!((found[0] - expected).abs() < 1e-14, "{guess}: {found:?}");
    }
    // What is given is no guess: there is no steady motion at 0.9.
    let stated = with("0.9");
    let (terms, selection) = (&stated.prepared.terms, &stated.prepared.selection);
    let values = stated.system.parameter_values();
    let motion = &stated.system.steady[0];
    assert!(Expansion::new(&stated.system, terms, selection, motion, &values).is_err());
    // The zeros of x³ − 3x + 1 have no closed form here, and are exact as algebraic numbers: the largest is 2 cos 40°.
    let cubic = Case::new("coordinates = [\"x\"]\n[lagrangian]\nT = \"1/2 x'^2\"\nV = \"x^4/4 - 3/2 x^2 + x\"\n[steady.low]\nx = { guess = 1.5 }\n\"x'\" = 0\n");
    let found = meant(&cubic).unwrap();
    assert!(
        (found[0] - 2.0 * 40_f64.to_radians().cos()).abs() < 1e-14,
        "{found:?}"
    );
    // A cubic over the numbers of another one is not solved.
    let over = Case::new("coordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\n[forces]\nx = \"1 + x - x^3\"\ny = \"x + y - y^3\"\n[steady.far]\nx = { guess = 1.3 }\ny = { guess = 1.4 }\n\"x'\" = 0\n\"y'\" = 0\n");
    assert!(meant(&over).unwrap_err().contains("closed form"));
}

/// A family takes what is given for its parameter: the sleigh at a speed that is stated, the turning guessed.
#[test]
fn a_member_of_a_family_is_meant() {
    let own = "coordinates = [\"x\", \"y\", \"phi\"]\n[lagrangian]\nL = \"1/2 ((x' - phi' sin(phi))^2 + (y' + phi' cos(phi))^2)\"\n[constraints]\nblade = \"x' sin(phi) = y' cos(phi)\"\n[steady.straight]\nx = 0\ny = 0\nphi = 0\n\"x'\" = 3/2\n\"y'\" = 0\n\"phi'\" = { guess = 0.2 }\n";
    let found = meant(&Case::new(&own.replace("= 3/2", "= \"3/2\""))).unwrap();
    assert_eq!(found, [0.0, 0.0, 0.0, 1.5, 0.0, 0.0]);
}

/// What is given of a member of a family is put into the equations: a conical pendulum of the turning rate 4 with g/l = 9 hangs at cos θ = 9/16, and a
/// top precesses with the rates ½(C ψ' ± √…) of which the slow one is guessed: 10 − √94 for A = 2, C = 1, P = 3, ψ' = 10, θ = π/3, where
/// (A − C) cos θ φ'² − C ψ' φ' + P = 0 (Goldstein 1980, § 5-7).
#[test]
fn what_is_given_chooses_the_member_of_a_family() {
    let cone = Case::new("coordinates = [\"th\", \"ph\"]\nparameters = { g = 9, w = 4 }\n[lagrangian]\nL = \"1/2 (th'^2 + sin(th)^2 ph'^2) + g cos(th)\"\n[steady.cone]\nph = 0\nth = { guess = 1 }\n\"th'\" = 0\n\"ph'\" = \"w\"\n");
    let found = meant(&cone).unwrap();
    assert!(
        (found[0] - (9.0_f64 / 16.0).acos()).abs() < 1e-14,
        "{found:?}"
    );
    assert_eq!(found[2..], [0.0, 4.0]);
    let top = Case::new("coordinates = [\"phi\", \"th\", \"psi\"]\nparameters = { A = 2, C = 1, P = 3, n = 10 }\n[lagrangian]\nT = \"1/2 A (th'^2 + phi'^2 sin(th)^2) + 1/2 C (psi' + phi' cos(th))^2\"\nV = \"P cos(th)\"\n[steady.slow]\nth = \"pi/3\"\n\"th'\" = 0\n\"psi'\" = \"n\"\n\"phi'\" = { guess = 0.5 }\n");
    let (terms, selection) = (&top.prepared.terms, &top.prepared.selection);
    let values = top.system.parameter_values();
    let motion = &top.system.steady[0];
    let found = near(&top.system, terms, selection, (motion, &values)).unwrap();
    let slow = found.velocities[0].unwrap();
    let slow = top.system.graph.substitute(slow, &values);
    let slow = top.system.graph.evaluate_f64(&[slow], &|_| None).unwrap()[0];
    assert!((slow - (10.0 - 94.0_f64.sqrt())).abs() < 1e-14, "{slow}");
}

/// A bead on a vertical circle or ellipse rests at its lowest and at its highest place, whichever of its coordinates is named first.
#[test]
fn the_order_of_coordinates_hides_no_rest() {
    for (coordinates, constraint) in [
        (r#"["x", "y"]"#, "x^2 + y^2 = 1"),
        (r#"["y", "x"]"#, "x^2 + y^2 = 1"),
        (r#"["x", "y"]"#, "x^2/4 + y^2 = 1"),
    ] {
        let case = Case::new(&format!(
            r#"
coordinates = {coordinates}
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
V = "y"
[constraints]
wire = "{constraint}"
"#
        ));
        let own = set(&case).unwrap();
        let place = |name: &str| own.variables.iter().position(|own| own == name).unwrap();
        let (x, y) = (place("x"), place("y"));
        let points = own.found.iter().map(numbers);
        let mut points: Vec<[f64; 2]> = points.map(|own| [own[x], own[y]]).collect();
        points.sort_by(|a, b| a[1].total_cmp(&b[1]));
        assert_eq!(
            points,
            [[0.0, -1.0], [0.0, 1.0]],
            "{coordinates} {constraint}"
        );
    }
}

/// Where β = ±π/2 the first two angles of a top turn about one axis and the mass matrix, with det = cos²β, is singular: that is
/// said, as is what lies outside of the assumptions of a model.
#[test]
fn singular_places_of_angles_are_no_motions() {
    let top = |assumed: &str| {
        let case = Case::new(&format!(
            r#"
coordinates = ["al", "be", "ga"]
assumptions = [{assumed}]
parameters = {{ n = 3 }}
[lagrangian]
T = "1/2 (al'^2 cos(be)^2 + be'^2) + 1/2 (ga' + al' sin(be))^2"
V = "cos(al) cos(be)"
"#
        ));
        let own = set(&case).unwrap();
        let place = own.variables.iter().position(|own| own == "be").unwrap();
        let values = own
            .found
            .iter()
            .filter_map(|found| match &found.values[place] {
                Value::Number { ball, .. } => Some(ball.to_f64()),
                Value::Function(e) => case
                    .system
                    .graph
                    .evaluate_f64(&[*e], &|_| None)
                    .ok()
                    .map(|x| x[0]),
                Value::Tied => None,
            });
        let marks = own
            .found
            .iter()
            .map(|found| (found.is_singular, found.is_assumed));
        values.zip(marks).collect::<Vec<(f64, (bool, bool))>>()
    };
    let half = std::f64::consts::FRAC_PI_2;
    let is_place = |be: f64| (be.abs() - half).abs() < 1e-9;
    let all = top("");
    assert!(all.iter().any(|own| is_place(own.0)), "{all:?}");
    assert!(
        all.iter().all(|own| own.1 == (is_place(own.0), true)),
        "{all:?}"
    );
    let narrow = top(r#""-pi/2 < be < pi/2""#);
    assert_eq!(narrow.len(), all.len());
    assert!(
        narrow.iter().all(|own| own.1 .1 == (own.0.abs() < 1.0)),
        "{narrow:?}"
    );
}

/// States of rest and steady motions are told with their number; the expected ones are read off the equations.
#[test]
fn all_states_of_rest_are_claimed() {
    let said = |case: &Case, claim: &str| {
        let found = case.verdict_of_all(claim);
        format!("{}: {}", found.word(), found.detail())
    };
    let starts = |case: &Case, claim: &str, expected: &str| {
        let found = said(case, claim);
        assert!(found.starts_with(expected), "{found}");
    };
    let rest = "equilibrium.states";
    let pendulum = Case::gallery("double-pendulum");
    starts(&pendulum, rest, "proved: 4 states of rest: a = 0, b = 0;");
    let disc = Case::gallery("falling-rolling-disc");
    starts(&disc, rest, "proved: one state of rest: theta = 0; ");
    starts(&disc, "steady.motions", "proved: 2 families: ");
    let sleigh = Case::gallery("chaplygin-sleigh");
    starts(&sleigh, rest, "proved: the system rests in every position");
    // The shaft of the governor turns, and only so its arms stand.
    let governor = Case::gallery("watt-governor");
    starts(&governor, rest, "proved: there is no state of rest");
    starts(&governor, "steady.motions", "proved: 4 steady motions: ");
    // A bead on a hoop that turns with W² = 2 g/R: sin θ (cos θ W² − g/R) = 0.
    let bead = one("1/2 (th'^2 + 2 sin(th)^2) + cos(th)", "0", "");
    starts(
        &bead,
        rest,
        "proved: 4 states of rest: th = -pi/3 = -1.0471975",
    );
    // Where x' = y the system rests for y = 0 only.
    let carried = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
L = "1/2 (x'^2 + y'^2)"
[constraints]
carried = "x' = y"
"#,
    );
    starts(
        &carried,
        rest,
        "proved: one state of rest: y = 0; nothing depends on x",
    );
    // A constraint that no rest satisfies.
    let driven = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
L = "1/2 (x'^2 + y'^2)"
[constraints]
driven = "x' = 1"
"#,
    );
    starts(&driven, rest, "proved: there is no state of rest");
    // Dry friction holds it anywhere near the middle.
    let rubbed = one("1/2 th'^2 - 1/2 th^2", "-1/10 sign(th')", "");
    starts(&rubbed, rest, "undecided: ");
    // An exponential is no polynomial.
    let steep = one("1/2 th'^2 - exp(th) - th", "0", "");
    starts(
        &steep,
        rest,
        "undecided: the equations of steady motion are not polynomial",
    );
    // With the time in its force nothing stays.
    let shaken = one("1/2 th'^2 - 1/2 th^2", "cos(t)", "");
    starts(
        &shaken,
        rest,
        "undecided: the equations contain the time explicitly",
    );
    // What the model assumes is told apart.
    let one_side = one(
        "1/2 th'^2 + cos(th)",
        "0",
        "assumptions = [\"cos(th) < 0\"]",
    );
    starts(&one_side, rest, "proved: one state of rest: th = pi = 3.14");
    assert!(said(&one_side, rest).ends_with(
        "; one more lies where the mass matrix is singular, or outside of what the model assumes"
    ));
}

/// Where the equations are not defined although the system is, it may rest: √(x⁴) and r³ do in the origin, and so does what a constraint holds
/// there that crosses itself. What has no value there, as the attraction by a centre, is no state at all.
#[test]
fn rest_where_the_equations_are_not_defined_is_not_denied() {
    let said = |potential: &str, constraint: &str| {
        let case = Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"{potential}\"\n[constraints]\n{constraint}\n"
        ));
        let found = case.verdict_of_all("equilibrium.states");
        format!("{}: {}", found.word(), found.detail())
    };
    for potential in ["sqrt(x^4) + y^2", "(x^2 + y^2)^(3/2)", "(x^2)^(2/3) + y^2"] {
        let found = said(potential, "");
        assert!(found.starts_with("undecided"), "{potential}: {found}");
        assert!(
            found.contains("nothing is said where"),
            "{potential}: {found}"
        );
    }
    let crossing = said("1/2 (x^2 + y^2)", "c = \"x^2 = y^2 + y^4\"");
    assert!(crossing.starts_with("undecided"), "{crossing}");
    for potential in ["-1/sqrt(x^2 + y^2)", "log(x^2 + y^2)"] {
        let found = said(potential, "");
        assert_eq!(found, "proved: there is no state of rest", "{potential}");
    }
    // Off the circle nothing is a state, and on it the gradient (x, y) does not vanish.
    let circle = said("y", "c = \"x^2 + y^2 = 1\"");
    assert!(circle.starts_with("proved: 2 states of rest"), "{circle}");
    // y' = x' x: the gradient (x, −1) vanishes nowhere.
    let slope = said("1/2 (x^2 + y^2)", "c = \"y' = x x'\"");
    assert!(slope.starts_with("proved"), "{slope}");
}

/// Values of roots, absolute values and angles, by hand: √x = 2, |x| = 1, √(1 + x²) = 2; sin a = sin b has b = a and b = π − a; √(x²) = x
/// for x ≥ 0 alone.
#[test]
fn what_stands_under_a_root_is_solved_for() {
    let set_of = |force: &str| set(&one("1/2 th'^2", force, "")).unwrap();
    let values = |force: &str| -> Vec<f64> {
        let found = set_of(force).found;
        found.iter().map(|own| numbers(own)[0]).collect()
    };
    assert_eq!(values("sqrt(th) - 2"), [4.0]);
    assert_eq!(values("abs(th) - 1"), [-1.0, 1.0]);
    assert_eq!(values("1 - th^(1/3)"), [1.0]);
    assert_eq!(values("abs(abs(th) - 2) - 1"), [-3.0, -1.0, 1.0, 3.0]);
    let root = 3_f64.sqrt();
    let found = values("sqrt(1 + th^2) - 2");
    assert!((found[0] + root).abs() < 1e-15 && (found[1] - root).abs() < 1e-15);
    let half = set_of("sqrt(th^2) - th").found;
    let texts = |own: &Found, case: &Case| -> Vec<String> {
        let g = &case.system.graph;
        own.conditions.iter().map(|&e| g.text(e)).collect()
    };
    let case = one("1/2 th'^2", "sqrt(th^2) - th", "");
    assert_eq!(texts(&set(&case).unwrap().found[0], &case), ["th_0"]);
    assert_eq!(half.len(), 1);
}

/// Two rotors that turn each other by sin a − sin b and its opposite: they stand for b = a and b = π − a, whatever the sign of sin a.
#[test]
fn angles_of_a_family_have_either_sign() {
    let case = Case::new(
        r#"
coordinates = ["a", "b"]
[lagrangian]
L = "1/2 (a'^2 + b'^2)"
[forces]
a = "sin(a) - sin(b)"
b = "sin(b) - sin(a)"
"#,
    );
    let own = set(&case).unwrap();
    let g = &case.system.graph;
    let value = |found: &Found, a: f64| {
        let at = |e| g.evaluate_f64(&[e], &|_| Some(a)).unwrap()[0];
        match (&found.values[0], &found.values[1]) {
            (Value::Function(x), Value::Function(y)) => (at(*x), at(*y)),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(own.found.len(), 2);
    for a in [1.0, -1.0, 2.5, -2.5] {
        let found: Vec<(f64, f64)> = own.found.iter().map(|own| value(own, a)).collect();
        for (x, y) in &found {
            assert!((x.sin() - y.sin()).abs() < 1e-12, "{found:?}");
        }
        let difference = (found[0].1 - found[1].1).rem_euclid(std::f64::consts::TAU);
        assert!(difference > 1e-3, "{found:?}");
    }
}

/// With x'² + y'² = 9 under gravity a particle falls or rises steadily: there x' determines no velocity, and y' does.
#[test]
fn steady_motions_of_a_constraint_that_is_not_linear_are_found_by_other_velocities() {
    let own = set(&Case::gallery("isokinetic-particle")).unwrap();
    let mut found: Vec<Vec<f64>> = own.found.iter().map(numbers).collect();
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let speed = found[0][0].abs();
    assert_eq!(own.variables, ["y'", "x'"]);
    assert_eq!(found, [[-speed, 0.0], [speed, 0.0]]);
}

/// On which factor of a product a motion lies is not asked, and that is said.
#[test]
fn products_of_constraints_are_not_solved() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
L = "1/2 (x'^2 + y'^2) - 1/2 (x^2 + y^2)"
[constraints]
either = "x' (y' - 1) = 0"
"#,
    );
    assert!(matches!(set(&case), Err(SteadySetError::Product { .. })));
}

/// One coordinate with a force.
fn one(lagrangian: &str, force: &str, further: &str) -> Case {
    Case::new(&format!(
        r#"
{further}
coordinates = ["th"]
[lagrangian]
L = "{lagrangian}"
[forces]
th = "{force}"
"#
    ))
}

/// On the circle x² + y² = 1 the force (3 (1 + y), −2) has no part along it where −3 y (1 + y) = 2 x: at (0, −1), where one chart of velocities fails, and
/// where (1 − y) = 9/4 y² (1 + y), of which one zero is real and none has a closed form by roots of second degree. Both charts together see all.
#[test]
fn a_motion_without_closed_form_hides_none_of_another_chart() {
    let case = Case::new(
        "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 x'^2 + 1/2 y'^2 - 2 y\"\nforces = { x = \"3 (1 + y)\" }\nconstraints = { circle = \"x^2 + y^2 = 1\" }\n[initial]\ny = -1\n",
    );
    let own = found(&case);
    assert_eq!(own.found.len(), 2, "{:?}", own.found);
    assert!(own.is_complete(), "{:?}", own.excluded);
    let of = |name: &str| own.variables.iter().position(|known| known == name);
    let places: Vec<(f64, f64)> = own
        .found
        .iter()
        .map(numbers)
        .map(|all| (all[of("x").unwrap()], all[of("y").unwrap()]))
        .collect();
    let lowest = |(x, y): &(f64, f64)| x.abs() + (y + 1.0).abs() < 1e-14;
    let other = |(x, y): &(f64, f64)| {
        let rest = (1.0 - y) - 2.25 * y * y * (1.0 + y);
        rest.abs() < 1e-14 && (x + 1.5 * y * (1.0 + y)).abs() < 1e-14 && *x < 0.0
    };
    assert!(
        places.iter().any(lowest) && places.iter().any(other),
        "{places:?}"
    );
}

/// A coordinate that runs by itself, p' = 1/4 − sin p, rests where sin p = 1/4 alone, though no force depends on it; x' = v runs uniformly. So p = 0 is
/// no steady motion, and there is one of them for each of the two zeros.
#[test]
fn what_runs_by_itself_is_no_ignorable_coordinate() {
    let case = Case::new(
        r#"
coordinates = ["x", "p"]
parameters = { v = 2 }
[lagrangian]
T = "1/2 x'^2 + 1/2 p'^2"
[constraints]
drive = "x' = v"
first = "p' = 1/4 - sin(p)"
[steady.here]
p = "asin(1/4)"
[steady.fast]
p = 0
"#,
    );
    let own = found(&case);
    assert_eq!(own.ignorable.len(), 1, "{:?}", own.ignorable);
    let angle = 0.25_f64.asin();
    are(&own, &[&[angle], &[std::f64::consts::PI - angle]]);
    let said = case.said("stability.spectral", "fast");
    assert!(said.contains("not steady"), "{said}");
    // δp' = −cos p δp.
    assert_eq!(case.said("stability.asymptotic", "here"), "proved");
}

/// No chart serves where 2 z² = 1 and z = 0 at once, which is nowhere: nothing is left out.
#[test]
fn what_vanishes_nowhere_is_not_left_out() {
    let own = found(&Case::new(
        r#"
coordinates = ["z", "x", "s"]
[lagrangian]
T = "1/2 (x'^2 + z'^2 + s'^2)"
V = "1/2 x^2 + 1/2 s^2"
[forces]
z = "-z'"
[constraints]
c = "s + x z/2 - 2 z^2 s = 0"
"#,
    ));
    assert!(own.is_complete(), "{:?}", own.excluded);
}
