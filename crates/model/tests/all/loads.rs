//! What acts on bodies, couples them and is measured of them, against formulas of textbooks.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use crate::common::{model, same, vanishes};
use chetaev_model::{load, Model, NoFiles};
use chetaev_symbolic::Expr;

fn force(model: &Model, coordinate: &str) -> Expr {
    let place = model
        .coordinates
        .iter()
        .position(|own| own.name == coordinate);
    let own = model
        .forces
        .iter()
        .find(|own| Some(own.coordinate) == place);
    own.unwrap_or_else(|| panic!("no force on {coordinate}"))
        .value
}

fn sensor(model: &Model, name: &str) -> Expr {
    let own = model.sensors.iter().find(|own| own.name == name);
    own.unwrap_or_else(|| panic!("no sensor {name}")).value
}

fn constraint(model: &Model, name: &str) -> Expr {
    let own = model.constraints.iter().find(|own| own.name == name);
    own.unwrap_or_else(|| panic!("no constraint {name}")).f
}

#[test]
fn a_force_at_a_point_has_its_power() {
    let text = r#"
gravity = 0
parameters = { a = 0.3, F = 2, M = 1 }
bodies.sled = { mass = 2, inertia = 0.5 }
joints.plane = { type = "planar", child = "sled", coordinates = ["x", "y", "phi"] }
[forces]
push = { body = "sled", at = [0, "a", 0], in = "sled", force = ["F", 0, 0], torque = [0, 0, "M"] }
phi = "-phi'"
"#;
    let own = model(text);
    same(&own, force(&own, "x"), "F cos(phi)");
    same(&own, force(&own, "y"), "F sin(phi)");
    same(&own, force(&own, "phi"), "M - a F - phi'");
    // In the axes of the ground, at a point that the body carries.
    let own = model(&text.replace("in = \"sled\", ", ""));
    same(&own, force(&own, "x"), "F");
    same(&own, force(&own, "phi"), "M - a F cos(phi) - phi'");
    // A force that follows the motion is no potential: it is not differentiated.
    let own = model(&text.replace("[\"F\", 0, 0]", "[\"-F x'\", 0, 0]"));
    same(&own, force(&own, "x"), "-F x' cos(phi)");
}

#[test]
fn springs_and_dampers_pull_along_their_line() {
    let text = r#"
gravity = 0
parameters = { h = 0.5 }
bodies.bead = { mass = 1 }
joints.s = { type = "prismatic", child = "bead" }
[forces]
strut = { body = "bead", to = "ground", to_at = [0, 0, "h"], spring = { stiffness = 20, rest = 0.6 }, damper = 3, force = "2*s" }
"#;
    let own = model(text);
    let length = "sqrt(s^2 + h^2)";
    let energy = format!("1/2 strut_spring ({length} - strut_rest)^2");
    same(&own, own.potential.expect("a potential"), &energy);
    let hand = format!("2 s s/{length} - strut_damper s' s^2/(s^2 + h^2)");
    same(&own, force(&own, "s"), &hand);
    let own = model(&text.replace("{ stiffness = 20, rest = 0.6 }", "20"));
    same(
        &own,
        own.potential.expect("a potential"),
        "1/2 strut_spring (s^2 + h^2)",
    );
}

#[test]
fn friction_is_that_of_coulomb_but_for_small_velocities() {
    let text = r#"
gravity = 0
parameters = { N = 4 }
bodies.block = { mass = 2 }
joints.plane = { type = "planar", child = "block", coordinates = ["x", "y", "phi"] }
contacts.foot = { type = "sliding", body = "block", friction = { viscous = 0.7, coefficient = 0.3, load = "N", speed = 0.01 } }
"#;
    let own = model(text);
    let size = "sqrt(x'^2 + y'^2 + foot_friction_speed^2)";
    let law = format!("(foot_friction_viscous + foot_friction_coefficient N/{size})");
    // The velocity is measured along the body, the force does not depend on it.
    same(&own, force(&own, "x"), &format!("-{law} x'"));
    same(&own, force(&own, "y"), &format!("-{law} y'"));
    let text = r#"
bodies.arm = { mass = 1, inertia = 1 }
joints.q = { child = "arm", friction = { coefficient = 0.1, load = 3, speed = 0.01 } }
"#;
    let own = model(text);
    let hand = "-q_friction_coefficient q_friction_load q'/sqrt(q'^2 + q_friction_speed^2)";
    same(&own, force(&own, "q"), hand);
}

#[test]
fn limits_are_assumptions_and_events() {
    let text = r#"
bodies.arm = { mass = 1, inertia = 1 }
joints.q = { child = "arm", limits = [-1, "pi/2"] }
"#;
    let own = model(text);
    let names: Vec<&str> = own.events.iter().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["q_least", "q_most"]);
    assert!(own.events.iter().all(|own| own.stops));
    same(&own, own.events[1].value, "q - q_most");
    assert!(own.assumptions.len() >= 2);
}

#[test]
fn gears_and_differentials_couple_coordinates() {
    let text = r#"
gravity = 0
indices = { i = "1..4" }
bodies."wheel_{i}" = { inertia = 1 }
joints."q_{i}" = { child = "wheel_{i}" }
[joints.train]
type = "gear"
coordinates = ["q_1", "q_2"]
ratio = -3
[joints.axle]
type = "differential"
coordinates = ["q_2", "q_3", "q_4"]
"#;
    let own = model(text);
    same(&own, constraint(&own, "train"), "q_2 - train_ratio q_1");
    same(&own, constraint(&own, "axle"), "q_2 + q_3 - 2 q_4");
}

#[test]
fn a_chain_is_closed_on_the_ground_from_either_side() {
    let chain = r#"
bodies.a = { mass = 1, inertia = 1 }
bodies.b = { mass = 1, inertia = 1 }
joints.p = { child = "a", axis = "y" }
joints.q = { parent = "a", child = "b", axis = "y", at = [1, 0, 0] }
"#;
    let one = model(&format!("{chain}joints.loop = {{ child = \"b\", axis = \"y\", at = [2, 0, 0], child_at = [1, 0, 1] }}\n"));
    let other = model(&format!("{chain}joints.loop = {{ parent = \"b\", child = \"ground\", axis = \"y\", at = [1, 0, 1], child_at = [2, 0, 0] }}\n"));
    let texts = |own: &Model| {
        own.constraints
            .iter()
            .map(|c| own.graph.text(c.f))
            .collect::<Vec<_>>()
    };
    let (one, other) = (texts(&one), texts(&other));
    let renamed: Vec<String> = other
        .iter()
        .map(|text| {
            text.replace("loop_at", "loop_AT")
                .replace("loop_child_at", "loop_at")
                .replace("loop_AT", "loop_child_at")
        })
        .collect();
    assert_eq!(one.len(), 2);
    assert_eq!(one, renamed);
}

const PENDULUM: &str = r#"
bodies.bob = { mass = 2, center = [0, 0, "-l"], inertia = "J" }
joints.a = { child = "bob", axis = "-y" }
parameters = { l = 0.7, J = 0.1 }
[sensors]
double = "2 a'"
tip = { type = "position", body = "bob", at = [0, 0, "-l"] }
speed = { type = "velocity", body = "bob", at = [0, 0, "-l"], in = "bob" }
felt = { type = "acceleration", body = "bob", at = [0, 0, "-l"], in = "bob" }
turn = { type = "angular-velocity", body = "bob" }
lean = { type = "angle", body = "bob" }
T = { type = "kinetic-energy", body = "bob" }
E = { type = "energy", body = "bob" }
pin = { type = "reaction", of = "a", in = "bob" }
[events.up]
when = "tip_z - double"
"#;

#[test]
fn sensors_measure_points_bodies_and_joints() {
    let own = model(PENDULUM);
    let at = |name: &str| sensor(&own, name);
    same(&own, at("double"), "2 a'");
    same(&own, at("tip_x"), "l sin(a)");
    same(&own, at("tip_z"), "-l cos(a)");
    same(&own, at("speed_x"), "l a'");
    same(&own, at("felt_x"), "l a''");
    same(&own, at("felt_z"), "l a'^2");
    same(&own, at("turn_y"), "-a'");
    same(&own, at("T"), "1/2 (bob_mass l^2 + J) a'^2");
    same(
        &own,
        at("E"),
        "1/2 (bob_mass l^2 + J) a'^2 - bob_mass g l cos(a)",
    );
    // The pull of the hinge (E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, 1905, § 110).
    same(
        &own,
        at("pin_force_z"),
        "bob_mass l a'^2 + bob_mass g cos(a)",
    );
    same(
        &own,
        at("pin_force_x"),
        "bob_mass l a'' + bob_mass g sin(a)",
    );
    same(
        &own,
        at("pin_torque_y"),
        "-(bob_mass l^2 + J) a'' - bob_mass g l sin(a)",
    );
    vanishes(&own, at("pin_force_y"));
    same(&own, own.events[0].value, "-l cos(a) - 2 a'");
    let lean = own.graph.text(at("lean"));
    assert!(lean.contains("atan2"), "{lean}");
}

/// A block on a plane that pulls a block beside it: the joint between them carries the mass times the acceleration of the second.
#[test]
fn a_reaction_knows_what_else_acts() {
    let text = r#"
gravity = 9.81
parameters = { F = 3 }
bodies.one = { mass = 2 }
bodies.two = { mass = 5 }
joints.s = { type = "prismatic", child = "one" }
joints.link = { type = "fixed", parent = "one", child = "two", at = [1, 0, 0] }
[forces]
push = { body = "two", force = ["F", 0, 0] }
[sensors]
link = { type = "reaction", of = "link" }
guide = { type = "reaction", of = "s", body = "one" }
"#;
    let own = model(text);
    same(&own, sensor(&own, "link_force_x"), "two_mass s'' - F");
    same(&own, sensor(&own, "link_force_z"), "two_mass g");
    same(
        &own,
        sensor(&own, "guide_force_x"),
        "(one_mass + two_mass) s'' - F",
    );
    // The second block stands 1 before the first: its weight turns about y.
    same(
        &own,
        sensor(&own, "guide_torque_y"),
        "-two_mass g link_at_x",
    );
}

#[test]
fn the_reaction_of_a_contact_is_that_of_its_multipliers() {
    let text = r#"
bodies.ball = { mass = 1, inertia = 0.1 }
joints.free = { child = "ball", type = "free", coordinates = ["x", "y", "z", "a", "b", "c"] }
contacts.foot = { type = "rolling", body = "ball", radius = 0.2 }
[sensors]
foot = { type = "reaction", of = "foot" }
"#;
    let own = model(text);
    let text = |name: &str| own.graph.text(sensor(&own, name));
    assert_eq!(text("foot_force_z"), "lambda_foot_touch");
    assert!(text("foot_force_x").contains("lambda_foot_"));
}

#[test]
fn what_makes_no_sense_of_forces_and_sensors_is_said() {
    let bodies = "bodies.b = { mass = 1 }\njoints.q = { child = \"b\", type = \"prismatic\" }\n";
    for (text, word) in [
        ("forces.f = { body = \"c\", force = [1, 0, 0] }\n", "no such body or frame"),
        ("forces.f = { body = \"ground\", force = [1, 0, 0] }\n", "which is no body"),
        ("forces.f = { body = \"b\", force = [1, 0] }\n", "has 3 components"),
        ("forces.power = [{ force = \"1\" }]\n", "needs `along`"),
        ("sensors.s = { type = \"position\" }\n", "needs the `body`"),
        ("sensors.s = { type = \"positon\", body = \"b\" }\n", "did you mean \"position\""),
        ("sensors.s = { type = \"reaction\", of = \"r\" }\n", "no joint or contact `r`"),
        ("sensors.s = \"lambda_nothing\"\n", "no constraint `nothing`"),
        ("constraints.c = \"q' = 1\"\nsensors.s = \"lambda_c\"\n[lagrangian]\nV = \"s\"\n", "lambda_c"),
        ("forces.q = \"1\"\nsensors.s = { type = \"reaction\", of = \"q\" }\n", "is not determined"),
        (
            "bodies.c = { mass = 1 }\nbodies.d = { mass = 1 }\njoints.r = { parent = \"c\", child = \"d\" }\njoints.s = { parent = \"d\", child = \"c\" }\nsensors.p = { type = \"reaction\", of = \"q\" }\n",
            "hang on each other",
        ),
        ("joints.g = { type = \"gear\", coordinates = [\"q\", \"r\"] }\n", "no joint has such a coordinate"),
        (
            "contacts.c = { type = \"sliding\", body = \"b\", friction = { coefficient = 1, load = \"lambda_c_touch\", speed = 1 } }\n",
            "known with the motion only",
        ),
    ] {
        let loaded = load("model.toml", &format!("{bodies}{text}"), &NoFiles, &[]);
        let message = loaded.diagnostics.to_string();
        assert!(loaded.model.is_none(), "accepted: {text}");
        assert!(message.contains(word), "`{word}` is missing in\n{message}");
    }
}

/// Nothing rises and falls, and yet the load of a friction may be a weight.
#[test]
fn gravity_has_its_name_where_a_formula_says_it() {
    let text = r#"
bodies.block = { mass = 2 }
joints.s = { type = "prismatic", child = "block", friction = { coefficient = 0.3, load = "block_mass g", speed = 0.01 } }
"#;
    let own = model(text);
    let hand = "-s_friction_coefficient block_mass g s'/sqrt(s'^2 + s_friction_speed^2)";
    same(&own, force(&own, "s"), hand);
    let still = model(&text.replace("block_mass g", "3"));
    assert!(still
        .parameters
        .iter()
        .all(|parameter| parameter.name != "g"));
}

const IN_BOWL: &str = r#"
parameters = { R = 1, r = 0.1 }
bodies.ball = { mass = 1, inertia = 0.004 }
joints.free = { child = "ball", type = "free", sequence = "zyx", coordinates = ["x", "y", "z", "a", "b", "c"] }
contacts.foot = { type = "rolling", body = "ball", radius = "r", surface = { shape = "sphere", radius = "R", inside = true } }
"#;

/// The middle of a ball in a bowl moves on a sphere, and the point that touches does not move: written with the normal −c/(R − r).
#[test]
fn a_ball_in_a_bowl_touches_it() {
    let own = model(IN_BOWL);
    let touch = constraint(&own, "foot_touch");
    same(&own, touch, "-(x^2 + y^2 + z^2 - (R - r)^2)/(2 (R - r))");
    // At the lowest point the tangents are the axes x and y, and the slip is that on a plane: v + ω × (−r k).
    let g = &own.graph;
    let lowest: Vec<(Expr, Expr)> = [("x", "0"), ("y", "0"), ("z", "-(R - r)")]
        .map(|(name, value)| {
            (
                own.expression(name).unwrap(),
                own.expression(value).unwrap(),
            )
        })
        .to_vec();
    let at = |name: &str| g.substitute(constraint(&own, name), &lowest);
    // The angular velocity along fixed axes, of turns about z, y, x.
    let (wx, wy) = (
        "(c' cos(b) cos(a) - b' sin(a))",
        "(c' cos(b) sin(a) + b' cos(a))",
    );
    same(&own, at("foot_forward"), &format!("x' - r {wy}"));
    same(&own, at("foot_side"), &format!("y' + r {wx}"));
}

/// The sphere as a surface of heights: where the middle of the ball lies on the sphere R − r, the point of contact lies on the radius through
/// it, and the constraints of both descriptions are the same there.
#[test]
fn a_bowl_of_heights_is_the_bowl() {
    let text = IN_BOWL.replace(
        "{ shape = \"sphere\", radius = \"R\", inside = true }",
        "{ coordinates = [\"u\", \"w\"], height = \"-sqrt(R^2 - u^2 - w^2)\" }",
    );
    let (one, other) = (model(IN_BOWL), model(&text));
    let names: Vec<&str> = other
        .coordinates
        .iter()
        .map(|own| own.name.as_str())
        .collect();
    assert_eq!(names, ["x", "y", "z", "a", "b", "c", "u", "w"]);
    let (radius, ball): (f64, f64) = (1.0, 0.1);
    let state = [
        ("x", 0.3),
        ("y", -0.4),
        ("a", 0.2),
        ("b", 0.5),
        ("c", -0.7),
        ("a'", 1.1),
        ("b'", -0.6),
        ("c'", 0.8),
        ("x'", 0.4),
        ("y'", 0.9),
    ];
    let reach = radius - ball;
    let z = -(reach * reach - 0.3_f64 * 0.3 - 0.4 * 0.4).sqrt();
    // The middle stays on its sphere.
    let rate = -(0.3 * 0.4 - 0.4 * 0.9) / z;
    let touching = [
        ("z", z),
        ("z'", rate),
        ("u", 0.3 * radius / reach),
        ("w", -0.4 * radius / reach),
    ];
    let value = |model: &Model, name: &str| {
        let g = &model.graph;
        let of = |symbol| {
            let text = g.symbol_text(symbol);
            let sizes = [("R", radius), ("r", ball)];
            let all = [&state[..], &touching[..], &sizes[..]].concat();
            let own = all.into_iter().find(|(own, _)| *own == text);
            own.map(|(_, x)| x)
        };
        g.evaluate_f64(&[constraint(model, name)], &of).unwrap()[0]
    };
    for name in ["foot_touch_x", "foot_touch_y", "foot_touch_z"] {
        assert!(value(&other, name).abs() < 1e-14, "{name}");
    }
    assert!(value(&one, "foot_touch").abs() < 1e-14);
    for name in ["foot_forward", "foot_side"] {
        let (one, other) = (value(&one, name), value(&other, name));
        assert!(
            (one - other).abs() < 1e-13 && one.abs() > 0.1,
            "{name}: {one}, {other}"
        );
    }
}

#[test]
fn a_ball_on_a_cylinder_touches_it() {
    let text = IN_BOWL.replace(
        "\"sphere\", radius = \"R\", inside = true",
        "\"cylinder\", axis = \"x\", radius = \"R\"",
    );
    let own = model(&text);
    same(
        &own,
        constraint(&own, "foot_touch"),
        "(y^2 + z^2 - (R + r)^2)/(2 (R + r))",
    );
    // Above the axis the slip is that on a plane.
    let g = &own.graph;
    let highest: Vec<(Expr, Expr)> = [("y", "0"), ("z", "R + r")]
        .map(|(name, value)| {
            (
                own.expression(name).unwrap(),
                own.expression(value).unwrap(),
            )
        })
        .to_vec();
    let side = g.substitute(constraint(&own, "foot_side"), &highest);
    same(&own, side, "y' + r (c' cos(b) cos(a) - b' sin(a))");
}

#[test]
fn surfaces_that_make_no_sense_are_refused() {
    for (from, to, word) in [
        ("\"sphere\"", "\"spher\"", "did you mean \"sphere\""),
        (", radius = \"R\", inside", ", inside", "needs its `radius`"),
        (
            "shape = \"sphere\", radius = \"R\", inside = true",
            "height = \"x^2\"",
            "not on `x`",
        ),
        (
            "shape = \"sphere\", radius = \"R\", inside = true",
            "radius = 1",
            "needs its `shape`",
        ),
        ("inside = true", "inside = 1", "true or false"),
        (
            "radius = \"r\", surface = { shape = \"sphere\", radius = \"R\", inside = true }",
            "axis = \"y\", radius = \"r\", surface = { shape = \"rail\" }",
            "two lines",
        ),
        (
            "radius = \"r\", surface = { shape = \"sphere\", radius = \"R\", inside = true }",
            "figure = { equation = \"R\" }",
            "contains none of its coordinates",
        ),
        (
            "radius = \"r\", surface = { shape = \"sphere\", radius = \"R\", inside = true }",
            "radius = \"r\", taper = 0.1",
            "along a line",
        ),
        ("radius = \"r\", surface", "radius = 0, surface", "is zero"),
        (
            "shape = \"sphere\", radius = \"R\", inside = true",
            "curve = [1, 0, 2]",
            "does not depend on its coordinate",
        ),
    ] {
        let loaded = load("model.toml", &IN_BOWL.replace(from, to), &NoFiles, &[]);
        let message = loaded.diagnostics.to_string();
        assert!(loaded.model.is_none(), "accepted: {to}");
        assert!(message.contains(word), "`{word}` is missing in\n{message}");
    }
}

/// Friction belongs to what a contact exerts, another force on the body does not.
#[test]
fn the_reaction_of_a_contact_contains_its_friction() {
    let text = r#"
bodies.block = { mass = 2, inertia = 1 }
joints.plane = { type = "free", child = "block", coordinates = ["x", "y", "z", "a", "b", "c"] }
contacts.foot = { type = "sliding", body = "block", at = [0, 0, 0], friction = { viscous = 0.7 } }
forces.push = { body = "block", force = [5, 0, 0] }
sensors.foot = { type = "reaction", of = "foot" }
"#;
    let own = model(text);
    let g = &own.graph;
    let level: Vec<(Expr, Expr)> = ["a", "b", "c"]
        .map(|name| (own.expression(name).unwrap(), g.zero()))
        .to_vec();
    let found = g.substitute(sensor(&own, "foot_force_x"), &level);
    same(&own, found, "-foot_friction_viscous x'");
}

/// A ball on a rope is a pendulum as long as the rope pulls: its tension is the multiplier with the other sign.
#[test]
fn a_rope_keeps_its_length_while_it_is_taut() {
    let text = r#"
bodies.ball = { mass = 2 }
joints.x = { type = "prismatic", axis = "x", child = "seat" }
bodies.seat = {}
joints.z = { type = "prismatic", axis = "z", parent = "seat", child = "ball" }
joints.cord = { type = "rope", body = "ball", to = "ground", to_at = [0, 0, 1], length = 0.8 }
sensors.pull = { type = "reaction", of = "cord" }
"#;
    let own = model(text);
    let span = "sqrt(x^2 + (cord_to_at_z - z)^2)";
    same(
        &own,
        constraint(&own, "cord"),
        &format!("{span} - cord_length"),
    );
    assert_eq!(
        (own.events[0].name.as_str(), own.events[0].stops),
        ("cord_slack", true)
    );
    // The force is the gradient of the constraint times the multiplier.
    let g = &own.graph;
    let pull = g.substitute(
        sensor(&own, "pull_force_x"),
        &[(g.symbol("lambda_cord", 0), g.one())],
    );
    same(&own, pull, &format!("x/{span}"));
    let loaded = load(
        "model.toml",
        &text.replace(", length = 0.8", ""),
        &NoFiles,
        &[],
    );
    assert!(loaded
        .diagnostics
        .to_string()
        .contains("needs its `length`"));
}
