//! All real solutions for the highest derivatives, which of them is followed, and where it ends (T2 E3, E4).

use super::{by, follows, keeps, refused, run, says, stops, ALL_FORMS};
use chetaev_tests::runs::ended_text;

/// E3: m = 2, F = -(x, y), α = 3/2.
pub(super) fn magnitude(start: &str) -> String {
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
pub(super) fn jerk(start: &str) -> String {
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
