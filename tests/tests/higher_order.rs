//! Motions under constraints of order two and three: branches, data of the start beyond velocities, and where a run ends
//! (theory 2 §5, E3, E4, E4b and E5).
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_tests::runs::{along, ended_text, Ask, Ended};

const ALL_FORMS: [&str; 4] = ["routh", "maggi", "volterra-first", "volterra-second"];

fn by(formulation: &'static str) -> Ask {
    Ask {
        claims: vec!["motion.constraint-drift"],
        formulation: Some(formulation),
        tolerance: Some(1e-12),
        ..Ask::default()
    }
}

fn run(text: &str) -> Ended {
    ended_text(text, &by("routh"))
}

/// Each expression equals its formula along the whole run, which reaches its end.
#[track_caller]
fn follows(ended: &Ended, forms: &[(&str, &str)]) {
    assert_eq!(ended.exit, 0, "{}", ended.text);
    keeps(ended, forms);
}

/// Each expression equals its formula as far as the run goes.
#[track_caller]
fn keeps(ended: &Ended, forms: &[(&str, &str)]) {
    let study = ended
        .study
        .as_ref()
        .unwrap_or_else(|| panic!("{}", ended.text));
    let run = &study.motion.as_ref().expect("a motion").evidence.run;
    for (expression, formula) in forms {
        let distance = along(study, run, &format!("({expression}) - ({formula})")).unwrap();
        assert!(distance.len() > 5, "{}", ended.text);
        let largest = distance.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let finite = distance.iter().all(|d| d.is_finite());
        assert!(finite && largest < 1e-8, "{expression}: {largest:e}");
    }
}

#[track_caller]
fn says(ended: &Ended, words: &[&str]) {
    for word in words {
        assert!(ended.text.contains(word), "no `{word}` in: {}", ended.text);
    }
}

#[track_caller]
fn refused(text: &str, words: &[&str]) {
    let ended = run(text);
    assert_eq!(ended.exit, 2, "{}", ended.text);
    assert!(ended.study.is_none_or(|s| s.motion.is_none()));
    says(&run(text), words);
}

/// The run ends early, at this time and with these words.
#[track_caller]
fn stops(ended: &Ended, t: f64, words: &[&str]) {
    assert_eq!(ended.exit, 3, "{}", ended.text);
    says(ended, words);
    let motion = ended.study.as_ref().unwrap().motion.as_ref().unwrap();
    let at = motion.evidence.run.ending.t;
    assert!((at - t).abs() < 1e-3, "{at} instead of {t}: {}", ended.text);
}

/// E3: m = 2, F = -(x, y), α = 3/2.
fn magnitude(start: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y"]
parameters = {{ m = 2, k = 1, alpha = 1.5 }}
assumptions = ["alpha > 0"]
lagrangian = {{ T = "1/2 m (x'^2 + y'^2)", V = "1/2 k (x^2 + y^2)" }}
constraints = {{ push = "x''^2 + y''^2 = alpha^2" }}
define = {{ r = "sqrt(x^2 + y^2)" }}
[initial]
x = 1
{start}
[simulation]
t_end = 1
output = 20
"#
    )
}

/// On ±α F/|F| the multiplier is (m ∓ |F|/α)/2, the area law holds, and so does v²/2 ± α r.
#[test]
fn both_branches_of_the_acceleration_of_fixed_magnitude() {
    let first = [
        ("x''", "-alpha x/r"),
        ("lambda_push", "(m - k r/alpha)/2"),
        ("x y' - y x'", "4/5"),
        ("(x'^2 + y'^2)/2 + alpha r", "8/25 + alpha"),
    ];
    let second = [
        ("x''", "alpha x/r"),
        ("lambda_push", "(m + k r/alpha)/2"),
        ("x y' - y x'", "4/5"),
        ("(x'^2 + y'^2)/2 - alpha r", "8/25 - alpha"),
    ];
    for formulation in ALL_FORMS {
        let of = |data: &str| {
            let start = format!("\"y'\" = \"4/5\"\n{data}");
            ended_text(&magnitude(&start), &by(formulation))
        };
        follows(&of(""), &first);
        follows(&of("\"x''\" = \"-alpha\""), &first);
        for data in [
            "\"x''\" = \"alpha\"\n\"y''\" = 0",
            "\"x''\" = \"alpha\"",
            "branch = 2",
        ] {
            follows(&of(data), &second);
        }
        // What is given goes before a number, and that is said.
        let contradicting = of("\"x''\" = \"alpha\"\nbranch = 1");
        follows(&contradicting, &second);
        let said = "branch 1 is asked for and not used: the derivatives given lie on branch 2";
        assert!(contradicting.text.contains(said), "{}", contradicting.text);
    }
}

/// Z = (m α ∓ |F|)²/(2 m) with |F| = 1: 1, the least, and 4.
#[test]
fn the_branches_are_listed_with_gausss_function() {
    let ended = run(&magnitude("\"y'\" = \"4/5\""));
    says(&ended, &["1: x'' = -1.5", "Gauss's function 1, minimum"]);
    says(&ended, &["2: x'' = 1.5", "Gauss's function 4, maximum"]);
}

/// From rest the particle falls along the radius, x = 1 - α t²/2, until the force vanishes at t = sqrt(2/α), where every direction
/// of the acceleration would do. Pushed against the force it never comes there: x = 1 + α t²/2.
#[test]
fn a_force_that_vanishes_ends_the_motion() {
    let far = magnitude("").replace("t_end = 1\n", "t_end = 3\n");
    let outwards = far.replace("x = 1\n", "x = 1\nbranch = 2\n");
    for formulation in ALL_FORMS {
        let inwards = ended_text(&far, &by(formulation));
        keeps(&inwards, &[("y", "0")]);
        let words = ["determinant", "vanish", "structure changes", "push"];
        stops(&inwards, (2.0_f64 / 1.5).sqrt(), &words);
        let outwards = ended_text(&outwards, &by(formulation));
        follows(&outwards, &[("x", "1 + alpha t^2/2"), ("y", "0")]);
    }
}

/// At x = y = 0 the force vanishes from the start.
#[test]
fn a_start_without_force_is_refused() {
    refused(
        &magnitude("").replace("x = 1", "x = 0"),
        &["do not determine", "x''", "determinant"],
    );
}

/// Nothing pushes along y, and y'' = ±2 are equally good: the reaction is λ 2 y'' = y'', so λ = 1/2 and Z = 2 on both.
fn tie(start: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2)", V = "-x" }}
constraints = {{ climb = "y''^2 = 4" }}
[initial]
x = 0
{start}
[simulation]
t_end = 1
output = 20
"#
    )
}

#[test]
fn of_two_equal_branches_the_user_must_choose() {
    let both = ["1: ", "2: ", "Gauss's function 2"];
    refused(&tie(""), &["choose", "--branch", "`branch = N`"]);
    refused(&tie(""), &both);
    refused(&tie("branch = 3"), &["no branch 3"]);
    refused(&tie("branch = 3"), &both);
    for formulation in ALL_FORMS {
        for (data, y) in [
            ("branch = 1", "t^2"),
            ("branch = 2", "-t^2"),
            ("\"y''\" = 2", "t^2"),
            ("\"y''\" = -2", "-t^2"),
        ] {
            let ended = ended_text(&tie(data), &by(formulation));
            follows(&ended, &[("x", "t^2/2"), ("y", y), ("lambda_climb", "1/2")]);
        }
    }
}

#[test]
fn accelerations_on_no_branch_are_refused() {
    for data in ["\"x''\" = 1", "\"x''\" = \"alpha\"\n\"y''\" = 1"] {
        let listed = ["x''", "lies on no branch", "1: x'' = -1.5", "2: x'' = 1.5"];
        refused(&magnitude(data), &listed);
    }
    refused(
        &tie("\"y''\" = 1"),
        &["`y''` lies on no branch", "1: ", "2: "],
    );
    let jerk = jerk("\"x''\" = \"3/5\"\n\"y''\" = \"4/5\"\n\"x'''\" = \"1/10\"");
    refused(
        &jerk,
        &["`x'''` lies on no branch", "x''' = 0.3", "x''' = -0.3"],
    );
}

/// E5: a free particle with j = 1/2.
fn jerk(start: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2)" }}
constraints = {{ drive = "x'''^2 + y'''^2 = 1/4" }}
[initial]
x = 0
{start}
[simulation]
t_end = 1
output = 20
"#
    )
}

/// q'' = (1 ± j t/|a0|) a0.
#[test]
fn given_third_derivatives_choose_the_branch_of_the_jerk() {
    let accelerations = "\"x''\" = \"3/5\"\n\"y''\" = \"4/5\"";
    refused(
        &jerk(accelerations),
        &["choose", "x''' = 0.3", "x''' = -0.3"],
    );
    for formulation in ALL_FORMS {
        for (third, sign) in [("\"3/10\"", "+"), ("\"-3/10\"", "-")] {
            let text = jerk(&format!("{accelerations}\n\"x'''\" = {third}"));
            let x = format!("3/5 (t^2/2 {sign} t^3/12)");
            let y = format!("4/5 (t^2/2 {sign} t^3/12)");
            let ended = ended_text(&text, &by(formulation));
            follows(&ended, &[("x", &x), ("y", &y)]);
        }
    }
}

/// E4 with γ = 2, from x = 1, y = 0, y' = 1.
fn sum(start: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2)", V = "x^2 + y^2" }}
constraints = {{ sum = "x''' + y''' = 0" }}
[initial]
x = 1
"y'" = 1
{start}
[simulation]
t_end = 1
output = 20
"#
    )
}

/// x'' = λ - 2 x = λ - 2, y'' = λ at the start: one datum is needed, λ = 1/2 or x'' = -3/2 or y'' = 1/2, and more must agree.
#[test]
fn one_datum_of_the_start_in_any_of_its_shapes() {
    for formulation in ALL_FORMS {
        for data in [
            "lambda_sum = \"1/2\"",
            "\"x''\" = \"-3/2\"",
            "\"y''\" = \"1/2\"",
            "\"x''\" = \"-3/2\"\n\"y''\" = \"1/2\"\nlambda_sum = \"1/2\"",
        ] {
            let ended = ended_text(&sum(data), &by(formulation));
            // s = x + y has s'' = 2 λ - 2 s = -1, and d = x - y swings with ω² = 2 from d = 1, d' = -1.
            let sum_and_difference = [
                ("x + y", "1 + t - t^2/2"),
                ("x - y", "cos(sqrt(2) t) - sin(sqrt(2) t)/sqrt(2)"),
                ("lambda_sum", "1/2 + t - t^2/2"),
            ];
            follows(&ended, &sum_and_difference);
        }
    }
}

#[test]
fn too_few_data_are_asked_for_by_name() {
    refused(
        &sum(""),
        &["needs 1 more", "`x''`", "`y''`", "`lambda_sum`"],
    );
    refused(&jerk(""), &["needs 2 more", "`x''`", "`y''`"]);
    refused(&jerk("\"x''\" = 1"), &["needs 1 more", "`y''`"]);
    refused(&reaction("x = 0"), &["needs 1 more", "`lambda_c`"]);
}

/// x'' - y'' = -2 (x - y) = -2 at the start.
#[test]
fn data_that_contradict_the_equations_are_refused_with_the_residual() {
    let both = "\"x''\" = 0\n\"y''\" = 0";
    refused(&sum(both), &["`x''`", "`y''`", "contradict", "2.000e0"]);
    let three = "\"x''\" = \"-3/2\"\n\"y''\" = \"1/2\"\nlambda_sum = \"3/4\"";
    refused(&sum(three), &["`lambda_sum`", "contradict", "2.500e-1"]);
    // x''' = -y''' and x''' - y''' = -2 (x' - y') = 2.
    let third = "lambda_sum = \"1/2\"\n\"x'''\" = 3";
    refused(&sum(third), &["`x'''`", "contradict", "x''' = 1"]);
    let right = run(&sum("lambda_sum = \"1/2\"\n\"x'''\" = 1"));
    follows(&right, &[("x + y", "1 + t - t^2/2")]);
}

/// The nearest accelerations to (0, 0) with x'' - y'' = -2 are (-1, 1), and λ = y''.
#[test]
fn projection_moves_what_contradicts_to_the_nearest() {
    for formulation in ALL_FORMS {
        let text = sum("\"x''\" = 0\n\"y''\" = 0\nproject = true");
        let ended = ended_text(&text, &by(formulation));
        follows(&ended, &[("x + y", "1 + t"), ("lambda_sum", "1 + t")]);
    }
}

/// E4b: the reaction is λ q', and q''' = 0.
fn reaction(start: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2)" }}
constraints = {{ c = "x' x''' + y' y''' = 0" }}
[initial]
"x'" = "3/5"
"y'" = "4/5"
{start}
[simulation]
t_end = 3
output = 30
"#
    )
}

/// q = q0 + q0' (t + λ0 t²/2) and λ = λ0/(1 + λ0 t), from λ0 or from one acceleration.
#[test]
fn the_reaction_falls_off_by_its_own_square() {
    for formulation in ALL_FORMS {
        for data in [
            "lambda_c = \"1/2\"",
            "\"x''\" = \"3/10\"",
            "\"y''\" = \"2/5\"",
        ] {
            let ended = ended_text(&reaction(data), &by(formulation));
            let expected = [
                ("x", "3/5 (t + t^2/4)"),
                ("y", "4/5 (t + t^2/4)"),
                ("lambda_c", "1/(2 + t)"),
            ];
            follows(&ended, &expected);
        }
    }
}

/// With λ0 = -1/2 the particle comes to rest at t = 2, where the gradient (x', y') vanishes.
#[test]
fn the_motion_ends_where_the_reaction_grows_without_bound() {
    for formulation in ALL_FORMS {
        let ended = ended_text(&reaction("lambda_c = \"-1/2\""), &by(formulation));
        keeps(&ended, &[("x", "3/5 (t - t^2/4)")]);
        stops(&ended, 2.0, &["`c`"]);
    }
}

/// q'' = (1/2, 1/4) is not parallel to q' = (3/5, 4/5): its part along q' is (3/10, 2/5), with λ = 1/2, and λ is free to follow.
#[test]
fn an_acceleration_across_the_velocity_is_refused_or_projected() {
    let across = "\"x''\" = \"1/2\"\n\"y''\" = \"1/4\"";
    refused(
        &reaction(across),
        &["`x''`", "`y''`", "contradict", "leaves"],
    );
    let along_x = reaction("\"x''\" = \"1/2\"\n\"y''\" = \"1/5\"")
        .replace("\"3/5\"", "1")
        .replace("\"4/5\"", "0");
    // x' y'' - y' x'' = 1/5.
    refused(&along_x, &["`x''`", "`y''`", "contradict", "2.000e-1"]);
    for formulation in ALL_FORMS {
        let text = reaction(&format!("{across}\nproject = true"));
        let ended = ended_text(&text, &by(formulation));
        follows(
            &ended,
            &[("x''", "3/10"), ("y''", "2/5"), ("lambda_c", "1/(2 + t)")],
        );
    }
}

/// The multiplier is none of the data where the equations determine it: for m = 2, and for nonlinear constraints of any order.
#[test]
fn a_multiplier_that_is_no_datum_is_said() {
    let unused = |name: &str| format!("initial values not used: `{name}`");
    let fixed = |data: &str| run(&magnitude(&format!("\"y'\" = \"4/5\"\n{data}")));
    let ended = fixed("lambda_push = 1");
    assert_eq!(ended.exit, 0, "{}", ended.text);
    says(&ended, &[&unused("lambda_push")]);
    let jerked = "\"x''\" = \"3/5\"\n\"y''\" = \"4/5\"\nlambda_drive = 1\nbranch = 1";
    says(&run(&jerk(jerked)), &[&unused("lambda_drive")]);
    for used in [fixed(""), run(&sum("lambda_sum = 1"))] {
        assert!(!used.text.contains("not used"), "{}", used.text);
    }
}

fn accelerated(constraints: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2)", V = "-y" }}
constraints = {{ {constraints} }}
[initial]
x = 0
[simulation]
t_end = 1
output = 20
"#
    )
}

#[test]
fn contradictory_constraints_of_order_two_are_refused() {
    for (constraints, names) in [
        ("one = \"x'' = 1\", two = \"x'' = 2\"", ["one", "two"]),
        (
            "one = \"x'' + y'' = 1\", two = \"2 x'' + 2 y'' = 3 + t\"",
            ["one", "two"],
        ),
        // D (x' - t) = x'' - 1.
        ("speed = \"x' = t\", push = \"x'' = 2\"", ["speed", "push"]),
    ] {
        let words = ["contradict", names[0], names[1]];
        refused(&accelerated(constraints), &words);
    }
}

/// A constraint beside its own derivative, or twice, takes nothing away.
#[test]
fn redundant_constraints_of_order_two_move_on() {
    for constraints in [
        "one = \"x'' = 1\", two = \"3 x'' = 3\"",
        "speed = \"x' = t\", push = \"x'' = 1\"",
    ] {
        for formulation in ALL_FORMS {
            let ended = ended_text(&accelerated(constraints), &by(formulation));
            follows(&ended, &[("x", "t^2/2"), ("y", "t^2/2")]);
        }
    }
}

/// No real acceleration.
#[test]
fn a_constraint_without_real_accelerations_is_refused() {
    let text = accelerated("none = \"x''^2 + y''^2 + 1 = 0\"");
    refused(&text, &["no real", "`none`"]);
}

/// The largest distance of a quantity from what it should be along the motion in every form of the equations.
fn stays(text: &str, quantity: &str, value: &str) {
    for formulation in ["routh", "maggi", "volterra-first", "volterra-second"] {
        let ask = Ask {
            claims: vec!["motion.constraint-drift"],
            formulation: Some(formulation),
            ..Ask::default()
        };
        let ended = ended_text(text, &ask);
        let study = ended.study.as_ref();
        let study = study.unwrap_or_else(|| panic!("{formulation}: {}", ended.text));
        let run = &study.motion.as_ref().unwrap().evidence.run;
        assert!(run.ending.finished, "{formulation}: {}", ended.text);
        let distance = along(study, run, &format!("{quantity} - ({value})")).unwrap();
        let largest = distance.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        assert!(
            largest < 1e-9,
            "{formulation}: {quantity} is off by {largest:e}"
        );
    }
}

/// m = 4, free mass: w = (x'', y'') = λ (1, 1), so x'' = y'' = λ and f = 0 gives λ'' = 0: x = x0 + x1 t + λ0 t²/2 + λ1 t³/6.
#[test]
fn order_four_with_the_reaction_and_its_rate_in_the_state() {
    for data in [
        "\"x''\" = 0.3\n\"x'''\" = 0.2",
        "lambda_f = 0.3\n\"lambda_f'\" = 0.2",
    ] {
        let text = format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 (x'^2 + y'^2)\"\n[constraints]\nf = \"x'''' + y'''' = 0\"\n\
             [initial]\nx = 1\n\"y'\" = 1\n{data}\n[simulation]\nt_end = 2\n"
        );
        stays(&text, "x", "1 + 0.15 t^2 + t^3/30");
        stays(&text, "y", "t + 0.15 t^2 + t^3/30");
    }
}

/// The directions of the reaction contain accelerations: x'' = -x + λ x'', y'' = -y + 2 λ y'' with the integral
/// x''²/2 + y''² = c + t + t²/2 of the constraint.
#[test]
fn reactions_along_accelerations() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 (x'^2 + y'^2) - 1/2 (x^2 + y^2)\"\n\
        [constraints]\nf = \"x'' x''' + 2 y'' y''' = 1 + t\"\n[initial]\nx = 1\ny = 0.5\n\"y'\" = 0.5\n\"x'\" = 0.7\nlambda_f = 0.4\n\
        [simulation]\nt_end = 0.3\n";
    // At the start x'' = -1/(1 - 0.4), y'' = -0.5/(1 - 0.8).
    let kept = "25/18 + 25/4 + t + t^2/2";
    stays(text, "x''^2/2 + y''^2", kept);
    stays(text, "2 y'' (x'' + x) - x'' (y'' + y)", "0");
}

/// Two systems side by side, one with a nonlinear constraint, whose equations contain the third derivatives, and one with a
/// linear constraint, whose equations must be differentiated once: each moves as it does alone.
#[test]
fn nonlinear_and_linear_constraints_of_order_three_side_by_side() {
    let model = |coordinates: &str, t: &str, constraints: &str, initial: &str| {
        format!(
            "coordinates = [{coordinates}]\nlagrangian = \"{t}\"\n[constraints]\n{constraints}\n[initial]\n{initial}\n\
             [simulation]\nt_end = 0.5\n"
        )
    };
    // x'' = λ 2 x''' and y'' = λ 2 y''' with |q'''| = 2: the third derivative stays along q'', so all is on a line.
    let jerk = "\"x''\" = 0.6\n\"y''\" = 0.8\n\"x'''\" = 1.2\n\"y'''\" = 1.6";
    let both = model(
        "\"x\", \"y\", \"u\", \"w\"",
        "1/2 (x'^2 + y'^2 + u'^2 + w'^2) - 1/2 (u^2 + w^2)",
        "f = \"x'''^2 + y'''^2 = 4\"\ng = \"u''' + w''' = 0\"",
        &format!("{jerk}\nu = 1\nlambda_g = 0.25"),
    );
    stays(&both, "x", "0.3 t^2 + 0.2 t^3");
    // u'' + u = w'' + w = λ and (u + w)''' = 0 give u'' - w'' = -(u - w), u'' + w'' = c = 2 λ0 - (u0 + w0).
    stays(&both, "u - w", "cos(t)");
    stays(&both, "u + w", "1 - t^2/4");
}

/// The kinetic energy is singular, and regular on what the constraint admits: Bᵀ M B = 1.
#[test]
fn an_inertia_that_only_the_constraint_of_order_two_supplies() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 x'^2 - y\"\n[constraints]\nf = \"x'' = y''\"\n\
        [initial]\n\"x'\" = 1\ny = 2\n[simulation]\nt_end = 1\n";
    stays(text, "x", "t - t^2/2");
    stays(text, "y", "2 - t^2/2");
}

/// A motion that nothing determines is refused by the claim that says so.
#[test]
fn constraints_that_determine_no_motion() {
    for text in [
        "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 (x'^2 - y'^2) - y\"\n[constraints]\nf = \"x'' = y''\"\n[simulation]\nt_end = 1\n",
        "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"1/2 (x'^2 + y'^2 + z'^2)\"\n[constraints]\nf = \"x'''^2 + y'''^2 = z'''^2\"\n\
         [initial]\n\"x''\" = 1\n\"y''\" = 0\n\"z''\" = 0.5\n[simulation]\nt_end = 1\n",
    ] {
        let ended = ended_text(text, &Ask::default());
        assert_eq!(ended.exit, 2);
        assert!(
            ended.text.contains("do not determine the motion at any state") && ended.text.contains("order.determined"),
            "{}",
            ended.text
        );
    }
}

/// Formulas that violate a constraint are not used.
#[test]
fn characteristics_that_violate_the_constraint() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 (x'^2 + y'^2) - 1/2 (x^2 + 4 y^2)\"\n[constraints]\nf = \"x''' + y''' = 0\"\n\
        [characteristics]\nparameters = [\"P\"]\n\"x'''\" = \"P\"\n\"y'''\" = \"2 P + t\"\n[initial]\nx = 1\n\"y'\" = 1\nlambda_f = 0.3\n\
        [simulation]\nt_end = 1\n";
    let said = "the characteristics do not satisfy the constraint `f`";
    let maggi = Ask {
        formulation: Some("maggi"),
        ..Ask::default()
    };
    let refused = ended_text(text, &maggi);
    assert!(
        refused.exit == 2 && refused.text.contains(said),
        "{}",
        refused.text
    );
    let noticed = ended_text(text, &Ask::default());
    assert!(noticed.text.contains(said), "{}", noticed.text);
    assert_eq!(noticed.verdict("order.characteristics").word(), "refuted");
    assert_eq!(
        noticed.verdict("formulation.equivalent#maggi").word(),
        "not-applicable"
    );
}
