//! Data of the start beyond velocities: in any of their shapes, too few, contradictory (T2 E4b, E5).

use super::branches::{jerk, magnitude};
use super::{by, follows, keeps, refused, run, says, stops, ALL_FORMS};
use chetaev_tests::runs::ended_text;

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
