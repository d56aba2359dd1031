//! Systems that are singular, redundant, contradictory or out of bounds in one way each, and what must be said of them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_tests::runs::{ended_text, Ask, Ended};

fn study(text: &str) -> Ended {
    ended_text(text, &Ask::default())
}

fn verdict(ended: &Ended, claim: &str) -> &'static str {
    ended.verdict(claim).word()
}

fn system(body: &str) -> String {
    format!("coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n{body}")
}

/// The derivative of |x'| by x' is constant almost everywhere, and yet |x'| is not linear.
#[test]
fn a_corner_is_not_linear() {
    let ended = study(&system(
        "constraints = [\"z' = sqrt(x'^2)\"]\n[initial]\n\"x'\" = 1\n",
    ));
    assert_eq!(verdict(&ended, "model.constraints-linear"), "refuted");
}

/// Nothing is proved of a system as if a constraint on accelerations were not there.
#[test]
fn a_constraint_of_higher_order_is_not_forgotten() {
    let ended = study(&system("constraints = [\"x''' = -y'\"]\n"));
    // It makes another system of it, of which the theory of the first order says nothing.
    for (claim, word) in [
        ("energy.integral", "not-applicable"),
        ("formulation.equivalent#nielsen", "not-applicable"),
        ("formulation.equivalent#maggi", "proved"),
        ("order.determined", "proved"),
    ] {
        assert_eq!(verdict(&ended, claim), word, "{claim}");
    }
}

/// On |v|² = 1 the height changes: H = 1/2 + z.
#[test]
fn energy_on_a_bounded_variety() {
    let text = "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2 - z\"\n\
        constraints = [\"x'^2 + y'^2 + z'^2 = 1\"]\n[initial]\n\"x'\" = 0.6\n\"z'\" = 0.8\n\"y'\" = 0\n";
    assert_eq!(verdict(&study(text), "energy.integral"), "refuted");
}

/// A root of a square is the other branch where the motion begins.
#[test]
fn the_other_branch_of_a_root_is_looked_at() {
    let constraint = "constraints = [\"z' = (sqrt(x^2 + 2 x + 1) - (x + 1)) y x'\"]\n";
    let ended = study(&system(&format!(
        "{constraint}[initial]\nx = -3\ny = 1\n\"x'\" = 1\n"
    )));
    assert_eq!(
        verdict(&ended, "model.constraints-integrable#weak"),
        "refuted"
    );
}

/// Branches meet, and a gradient vanishes, between two steps.
#[test]
fn a_vanishing_gradient_between_steps_stops_the_run() {
    let meeting = "constraints = [\"(y' - 1) (y' - t) = 0\"]\n[initial]\n\"x'\" = -1\n\"y'\" = 0\n";
    let factor =
        "constraints = [\"x (z' - y x') = 0\"]\n[initial]\nx = -1\n\"x'\" = 1\n\"y'\" = 1\n";
    // √(1 + y²) x' is an integral and y = t, so x = arsinh t − 1 vanishes at t = sinh 1.
    let when = [1.0, 1.0_f64.sinh()];
    let words = ["the components", "gradient"];
    for ((body, when), words) in [meeting, factor].into_iter().zip(when).zip(words) {
        let ended = study(&system(body));
        assert_eq!(ended.exit, 3, "{body}: {}", ended.text);
        let study = ended.study.as_ref().expect("a study");
        let stopped = study
            .motion
            .as_ref()
            .expect("a motion")
            .evidence
            .run
            .ending
            .t;
        assert!((stopped - when).abs() < 1e-6, "{body}: {stopped}");
        assert!(ended.text.contains(words), "{}", ended.text);
    }
}

fn run_of(ended: &Ended) -> &chetaev::motion::Run {
    let study = ended.study.as_ref().expect("a study");
    &study.motion.as_ref().expect("a motion").evidence.run
}

/// Two planes cross; the velocity lies in one of them, and the motion stays there.
#[test]
fn a_motion_in_one_of_two_planes_passes_the_other() {
    let ended = study(&system(
        "constraints = [\"x y = 0\"]\n[initial]\ny = 1\n\"y'\" = -1\n\"z'\" = 1\n[simulation]\nt_end = 3\n",
    ));
    let run = run_of(&ended);
    assert!(run.ending.finished, "{}", ended.text);
    let last = run.row(run.len() - 1);
    assert!(last[0].abs() < 1e-12 && (last[1] + 2.0).abs() < 1e-9 && (last[2] - 3.0).abs() < 1e-9);
    assert!(
        (run.crossings[0].t - 1.0).abs() < 1e-6,
        "{:?}",
        run.crossings
    );
    assert!(ended.text.contains("exactly one branch"), "{}", ended.text);
}

/// z (3 + sin x) = 0 says z = 0 once more, which shows on the set z = 0 alone: elsewhere the gradients are independent.
#[test]
fn what_is_redundant_on_the_constraint_set_alone_is_left_out() {
    let ended = study(&system(
        "constraints = { flat = \"z = 0\", again = \"z (3 + sin(x)) = 0\" }\n[initial]\nx = 0.4\n\"x'\" = 2\n[simulation]\nt_end = 1\n",
    ));
    let run = run_of(&ended);
    assert!(run.ending.finished, "{}", ended.text);
    assert!((run.row(run.len() - 1)[0] - 2.4).abs() < 1e-12);
    let independent = ended.verdict("model.constraints-independent");
    assert_eq!(independent.word(), "refuted", "{independent:?}");
    assert!(
        ended.text.contains("(sin(x) + 3)") || ended.text.contains("lambda_again"),
        "{}",
        ended.text
    );
}

/// A plank on three cranks of length 2 at distances of 3: six equations of rank five wherever they hold, as equal cranks allow no
/// turning of the plank. With a the angle of all, 7 a'' = −2 cos a.
#[test]
fn a_plank_on_three_cranks_moves() {
    let text = "coordinates = [\"alpha\", \"beta\", \"gamma\", \"px\", \"py\", \"tilt\"]\n\
        lagrangian = \"1/2 (alpha'^2 + beta'^2 + gamma'^2 + px'^2 + py'^2 + tilt'^2) - py\"\n\
        [constraints]\nox = \"px = 2 cos(alpha)\"\noy = \"py = 2 sin(alpha)\"\n\
        mx = \"px + 3 cos(tilt) = 3 + 2 cos(beta)\"\nmy = \"py + 3 sin(tilt) = 2 sin(beta)\"\n\
        ex = \"px + 6 cos(tilt) = 6 + 2 cos(gamma)\"\ney = \"py + 6 sin(tilt) = 2 sin(gamma)\"\n\
        [initial]\nalpha = 1\nbeta = 1\ngamma = 1\npx = \"2 cos(1)\"\npy = \"2 sin(1)\"\ntilt = 0\n[simulation]\nt_end = 2\n";
    let ask = Ask {
        claims: vec!["motion.constraint-drift", "model.constraints-independent"],
        ..Ask::default()
    };
    let ended = ended_text(text, &ask);
    let run = run_of(&ended);
    assert!(run.ending.finished, "{}", ended.text);
    assert_ne!(verdict(&ended, "model.constraints-independent"), "proved");
    assert!(ended.text.contains("are not determined"), "{}", ended.text);
    let (mut a, mut w, h) = (1.0_f64, 0.0_f64, 1e-3);
    let f = |a: f64| -2.0 * a.cos() / 7.0;
    for _ in 0..2000 {
        let (k1, l1) = (w, f(a));
        let (k2, l2) = (w + 0.5 * h * l1, f(a + 0.5 * h * k1));
        let (k3, l3) = (w + 0.5 * h * l2, f(a + 0.5 * h * k2));
        let (k4, l4) = (w + h * l3, f(a + h * k3));
        a += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        w += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
    }
    let last = run.row(run.len() - 1);
    for angle in &last[..3] {
        assert!((angle - a).abs() < 1e-8, "{last:?} {a}");
    }
    assert!(last[5].abs() < 1e-10, "{last:?}");
}

/// Constraints that others imply may lose their gradients on the way: the rank is that of the others.
#[test]
fn a_constraint_left_out_stops_nothing() {
    let ended = study(&system(
        "constraints = { rim = \"z' = (1 + y) x'\", copy = \"cos(x) z' = cos(x) (1 + y) x'\" }\n[initial]\n\"x'\" = 1\n\"y'\" = 0.1\n[simulation]\nt_end = 9\n",
    ));
    let run = run_of(&ended);
    assert!(run.ending.finished, "{}", ended.text);
    // y' and √(1 + (1 + y)²) x' are constant, so x = √2 (arsinh(1 + t/10) − arsinh 1)/0.1, beyond π/2.
    let x = 2.0_f64.sqrt() * (1.9_f64.asinh() - 1.0_f64.asinh()) / 0.1;
    assert!((run.row(run.len() - 1)[0] - x).abs() < 1e-7, "{x}");
    assert!(
        ended.text.contains("lambda_rim + ") || ended.text.contains("lambda_copy"),
        "{}",
        ended.text
    );
}

/// Redundant at the start only: neither dropped for good nor passed over.
#[test]
fn rank_deficiency_at_the_start_is_refused() {
    let text = "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2 + x\"\n\
        constraints = [\"x' = y'\", \"x' cos(x) - y' = 0\"]\n[initial]\nx = 0\n";
    let ended = study(text);
    assert_eq!(ended.exit, 2);
    assert!(ended.text.contains("rank"), "{}", ended.text);
}

/// The free part is found although the constraint has no gradient where the search begins.
#[test]
fn what_is_free_is_found_from_other_starts() {
    for constraint in [
        "x'^2 + y'^2 + z'^2 = 3",
        "x'^2 + y'^2 - z'^2 = 0",
        "x'^2 = y'^2",
    ] {
        let ended = study(&system(&format!(
            "constraints = [\"{constraint}\"]\n[initial]\n\"x'\" = 1\n"
        )));
        let study = ended
            .study
            .as_ref()
            .unwrap_or_else(|| panic!("{constraint}: {}", ended.text));
        let start = &study.motion.as_ref().expect("a motion").start;
        assert_eq!(start.v[0], 1.0, "{constraint}");
        assert!(
            start.v[1].abs() + start.v[2].abs() > 1e-3,
            "{constraint}: {:?}",
            start.v
        );
    }
}

#[test]
fn contradictory_positions_are_called_so() {
    let ended = study(&system("constraints = [\"x = 1\", \"x = 2\"]\n"));
    assert_eq!(ended.exit, 2);
    assert!(ended.text.contains("contradict"), "{}", ended.text);
}

/// A run that loses everything does not pass by the size of what it reached.
#[test]
fn a_blown_up_run_is_refuted() {
    let text = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2 - x^2\"\n[initial]\n\"x'\" = 1\n\
        [simulation]\nt_end = 1000\ntolerance = 0.1\n";
    assert_eq!(verdict(&study(text), "motion.energy-drift"), "refuted");
    let wide = text.replace("tolerance = 0.1", "tolerance = 1000");
    assert_eq!(study(&wide).exit, 2);
}

#[test]
fn assumptions_hold_where_the_motion_is() {
    let body = |x: &str| {
        system(&format!(
            "assumptions = [\"x > 0\"]\n[initial]\nx = {x}\n\"x'\" = -1\n[simulation]\nt_end = 5\n"
        ))
    };
    let refused = study(&body("-2"));
    assert_eq!(refused.exit, 2);
    assert!(refused.text.contains("x > 0"), "{}", refused.text);
    let left = study(&body("2"));
    assert_eq!(left.exit, 0);
    assert!(left.text.contains("leaves the assumption"), "{}", left.text);
}

#[test]
fn too_many_rows_are_refused_not_cut() {
    let ended = study(&system(
        "[simulation]\nt_end = 10\noutput = { step = 1e-9 }\n",
    ));
    assert_eq!(ended.exit, 2);
    assert!(ended.text.contains("rows"), "{}", ended.text);
}

/// The classical method of order 4 has no error estimate: it asks for a step, and shows its order with one.
#[test]
fn a_fixed_step_is_asked_for_and_used() {
    let text = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2 + cos(x)\"\n[initial]\nx = 1\n\
        [simulation]\nt_end = 5\nmethod = \"runge-kutta-4\"\n";
    let refused = study(text);
    assert_eq!(refused.exit, 2);
    assert!(refused.text.contains("step"), "{}", refused.text);
    let ended = study(&format!("{text}step = 0.01\n"));
    assert_eq!(ended.exit, 0, "{}", ended.text);
    let study = ended.study.as_ref().expect("a study");
    let evidence = &study.motion.as_ref().expect("a motion").evidence;
    let observed = evidence
        .orders
        .as_ref()
        .and_then(|o| o.observed)
        .expect("an order");
    assert!((observed - 4.0).abs() < 0.5, "{observed}");
    assert_eq!(evidence.run.statistics.steps, 500);
}

/// The coordinates x and y occur nowhere, z does in V; so Chaplygin's equations are solved for x' although z' would be the
/// better choice. Where y' = 0 the constraint cannot be solved for x': the run ends there and does not step across.
#[test]
fn chaplygins_equations_end_where_their_velocities_are_not_determined() {
    let text = "coordinates = [\"x\", \"y\", \"z\"]\n\
        lagrangian = { T = \"x'^2 + y'^2 + z'^2\", V = \"6 z\" }\n\
        constraints = { a = \"z'^3 + z' = x' y'\" }\n\
        [initial]\n\"x'\" = 2\n\"y'\" = 1\n\"z'\" = 1\n[simulation]\nt_end = 1\n";
    let by = |formulation: &'static str| {
        let ask = Ask {
            formulation: Some(formulation),
            ..Ask::default()
        };
        ended_text(text, &ask)
    };
    assert_eq!(by("maggi").exit, 0);
    let ended = by("chaplygin");
    assert_eq!(ended.exit, 3, "{}", ended.text);
    assert!(
        ended.text.contains("dependent velocities"),
        "{}",
        ended.text
    );
}

/// Where the direction of a jerk ceases to be determined the residual of its constraint is 0/0: no violation, and said. The closed
/// form: the acceleration shrinks by 1/2 in a unit of time, from 1 at the start.
#[test]
fn a_constraint_without_a_value_at_the_singular_end_is_not_violated() {
    let folder = chetaev_tests::places::scratch("singular-end");
    let out = chetaev_tests::program::text(&folder);
    for method in ["taylor", "tsit5", "dop853"] {
        let model = "gallery/fixed-jerk/stop.toml";
        let claim = "motion.constraint-drift";
        let ended = chetaev_tests::program::ok(&[
            "study", model, "--claims", claim, "--method", method, "--out", out,
        ]);
        let lines = ended.both();
        let line = lines
            .lines()
            .find(|line| line.contains("motion.constraint-drift"));
        let line = line.expect("the claim");
        assert!(line.contains("numerical"), "{method}: {line}");
        // A method may end a rounding beyond the place, where all is finite again.
        let rows = std::fs::read_to_string(folder.join("trajectory.csv")).unwrap();
        let is_without = rows.lines().last().unwrap().contains("NaN");
        let says = line.contains("without a finite value at the end, t = 2,");
        assert_eq!(says, is_without, "{method}: {line}");
        assert!(!lines.contains("inf"), "{method}: {lines}");
    }
}
