//! Motions that the differentiated equations determine, against closed forms (T2 §5).

use super::{by, follows, moves_in_every_form, refused, ALL_FORMS};
use chetaev_tests::runs::{ended_text, Ask};

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
        moves_in_every_form(&text, &[("x", "1 + 0.15 t^2 + t^3/30")]);
        moves_in_every_form(&text, &[("y", "t + 0.15 t^2 + t^3/30")]);
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
    moves_in_every_form(text, &[("x''^2/2 + y''^2", kept)]);
    moves_in_every_form(text, &[("2 y'' (x'' + x) - x'' (y'' + y)", "0")]);
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
    moves_in_every_form(&both, &[("x", "0.3 t^2 + 0.2 t^3")]);
    // u'' + u = w'' + w = λ and (u + w)''' = 0 give u'' - w'' = -(u - w), u'' + w'' = c = 2 λ0 - (u0 + w0).
    moves_in_every_form(&both, &[("u - w", "cos(t)")]);
    moves_in_every_form(&both, &[("u + w", "1 - t^2/4")]);
}

/// The kinetic energy is singular, and regular on what the constraint admits: Bᵀ M B = 1.
#[test]
fn an_inertia_that_only_the_constraint_of_order_two_supplies() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 x'^2 - y\"\n[constraints]\nf = \"x'' = y''\"\n\
        [initial]\n\"x'\" = 1\ny = 2\n[simulation]\nt_end = 1\n";
    moves_in_every_form(text, &[("x", "t - t^2/2")]);
    moves_in_every_form(text, &[("y", "2 - t^2/2")]);
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

/// The constraint itself, its rate and its second rate prescribe the same motion from data that satisfy all three; for the
/// last the reaction at the start is one of the data.
#[test]
fn the_knife_edge_moves_the_same_whatever_the_order_of_its_constraint() {
    for order in 1..=3 {
        let reaction = match order {
            3 => "lambda_blade = \"-m W u0\"",
            _ => "",
        };
        moves_in_every_form(&knife_edge(order, reaction), &SKATE_ON_INCLINE);
    }
}

/// With another reaction at the start the second rate stays zero, but not the lateral velocity.
#[test]
fn a_knife_edge_of_order_three_slips_by_the_reaction_it_starts_with() {
    let text = knife_edge(3, "lambda_blade = \"m (1/10 - W u0)\"");
    moves_in_every_form(&text, &[("x' sin(phi) - y' cos(phi)", "t/10")]);
}

fn knife_edge(order: usize, reaction: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y", "phi"]
parameters = {{ m = 1.2, J = 0.3, gs = 4, W = 1.3, u0 = 0.7 }}
lagrangian = {{ T = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2", V = "-m gs x" }}
[constraints]
blade = {{ equation = "x' sin(phi) = y' cos(phi)", lifted = {order} }}
[initial]
"x'" = "u0"
"phi'" = "W"
{reaction}
[simulation]
t_end = 4
tolerance = 1e-11
output = 40
"#
    )
}

/// The skate on an incline that starts along the slope (Neimark and Fufaev 1972, ch. II): u' = gs cos(W t).
const SKATE_ON_INCLINE: [(&str, &str); 3] = [
    ("x", "u0/W sin(W t) + gs/(2 W^2) sin(W t)^2"),
    ("y", "u0/W (1 - cos(W t)) + gs/W^2 (W t/2 - sin(2 W t)/4)"),
    ("phi", "W t"),
];
