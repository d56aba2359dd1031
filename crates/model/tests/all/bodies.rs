//! Bodies, joints and contacts: the energies and constraints that they give, against those of textbooks, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused, same};
use chetaev_model::{load, lowered, Model, NoFiles};

/// The potential energy of a model.
fn potential(model: &Model) -> chetaev_symbolic::Expr {
    model.potential.expect("a potential energy")
}

fn kinetic(model: &Model) -> chetaev_symbolic::Expr {
    model.kinetic.expect("a kinetic energy")
}

fn names(model: &Model) -> Vec<&str> {
    let coordinates = model.coordinates.iter();
    coordinates.map(|own| own.name.as_str()).collect()
}

#[test]
fn a_rolling_disc_has_the_energies_of_routh_and_appell() {
    let text = r#"
bodies.disc = { shape = "disc", mass = 1.5, radius = 0.4 }
contacts.rim = { type = "rolling", body = "disc", coordinates = ["x", "y", "phi", "theta", "psi"] }
"#;
    let model = model(text);
    assert_eq!(names(&model), ["x", "y", "phi", "theta", "psi"]);
    // E. J. Routh 1884, § 244; the centre from the point of contact (x, y).
    let m = "disc_mass";
    let r = "disc_radius";
    let cx = format!("(x' + {r} (phi' cos(phi) sin(theta) + theta' sin(phi) cos(theta)))");
    let cy = format!("(y' + {r} (phi' sin(phi) sin(theta) - theta' cos(phi) cos(theta)))");
    let cz = format!("({r} theta' sin(theta))");
    let hand = format!(
        "1/2 {m} ({cx}^2 + {cy}^2 + {cz}^2) + 1/8 {m} {r}^2 (theta'^2 + phi'^2 cos(theta)^2) + 1/4 {m} {r}^2 (psi' + phi' sin(theta))^2"
    );
    same(&model, kinetic(&model), &hand);
    same(&model, potential(&model), &format!("{m} g {r} cos(theta)"));
    let forward = format!("x' cos(phi) + y' sin(phi) - {r} psi'");
    same(&model, model.constraints[0].f, &forward);
    same(&model, model.constraints[1].f, "y' cos(phi) - x' sin(phi)");
    assert_eq!(model.constraints.len(), 2);
    let drawing = model.drawing.as_ref().expect("a drawing");
    assert!(drawing.spatial && drawing.elements.len() == 2);
}

#[test]
fn euler_angles_of_every_sequence_keep_the_length_of_the_angular_velocity() {
    // T of a body with three equal moments does not depend on the axes; T of one about a fixed point by Euler 1758 for zxz.
    let text = r#"
bodies.top = { mass = 2, center = [0, 0, "l"], inertia = ["A", "A", "C"] }
joints.foot = { child = "top", type = "spherical", coordinates = ["phi", "theta", "psi"] }
parameters = { A = 1, C = 1.2, l = 0.3 }
"#;
    let top = model(text);
    same(
        &top,
        kinetic(&top),
        "1/2 (A + top_mass l^2) (theta'^2 + phi'^2 sin(theta)^2) + 1/2 C (psi' + phi' cos(theta))^2",
    );
    same(&top, potential(&top), "top_mass g l cos(theta)");
    for sequence in ["xyz", "zyx", "zyz", "yxz", "xzx"] {
        let text = format!(
            "bodies.top = {{ inertia = \"A\" }}\nparameters = {{ A = 1 }}\n\
             joints.foot = {{ child = \"top\", type = \"spherical\", sequence = \"{sequence}\", coordinates = [\"a\", \"b\", \"c\"] }}\n"
        );
        let model = model(&text);
        let first: Vec<char> = sequence.chars().collect();
        let sine = match (first[0] == first[2], sequence) {
            (true, _) => "cos(b)",
            // Cyclic sequences have e1·e3 = sin b, the others − sin b.
            (false, "xyz") => "sin(b)",
            (false, _) => "-sin(b)",
        };
        let hand = format!("1/2 A (a'^2 + b'^2 + c'^2 + 2 a' c' ({sine}))");
        same(&model, kinetic(&model), &hand);
    }
}

#[test]
fn an_inertia_may_be_stated_about_another_point_and_in_other_axes() {
    // A rod of length 2 l, about its end: 4/3 m l², in axes turned by 30 degrees.
    let text = r#"
bodies.rod = { mass = "m", center = ["l cos(a)", 0, "-l sin(a)"], inertia = { yy = "4/3 m l^2", zz = "4/3 m l^2", turn = { y = "a" }, at = [0, 0, 0] } }
joints.pin = { child = "rod", axis = "y" }
parameters = { m = 1, l = 2, a = 0.5 }
"#;
    let model = model(text);
    same(&model, kinetic(&model), "2/3 m l^2 pin'^2");
    same(&model, potential(&model), "-m g l sin(a + pin)");
}

#[test]
fn solids_have_the_moments_of_the_tables() {
    for (shape, sizes, axis, moment) in [
        ("disc", "radius = \"r\"", "y", "m r^2/2"),
        ("disc", "radius = \"r\"", "x", "m r^2/4"),
        ("ring", "radius = \"r\"", "y", "m r^2"),
        ("ball", "radius = \"r\"", "z", "2/5 m r^2"),
        ("shell", "radius = \"r\"", "z", "2/3 m r^2"),
        (
            "cylinder",
            "radius = \"r\", length = \"l\"",
            "x",
            "m (3 r^2 + l^2)/12",
        ),
        (
            "box",
            "size = [\"r\", \"l\", \"h\"]",
            "z",
            "m (r^2 + l^2)/12",
        ),
        (
            "box",
            "size = [\"r\", \"l\", \"h\"]",
            "y",
            "m (r^2 + h^2)/12",
        ),
        ("rod", "length = \"l\"", "z", "m l^2/12"),
        ("cone", "radius = \"r\", length = \"l\"", "z", "3/10 m r^2"),
        (
            "cone",
            "radius = \"r\", length = \"l\"",
            "x",
            "m (3/20 r^2 + 3/80 l^2)",
        ),
    ] {
        let text = format!(
            "bodies.b = {{ shape = \"{shape}\", mass = \"m\", {sizes} }}\njoints.q = {{ child = \"b\", axis = \"{axis}\" }}\n\
             parameters = {{ m = 1, r = 0.2, l = 0.7, h = 0.4 }}\n"
        );
        let loaded = load("model.toml", &text, &NoFiles, &[]);
        let (model, _) = loaded
            .into_result()
            .unwrap_or_else(|problems| panic!("{problems}"));
        same(&model, kinetic(&model), &format!("1/2 ({moment}) q'^2"));
    }
}

#[test]
fn a_chain_hangs_together_and_has_its_springs_and_dampers() {
    let text = r#"
bodies.upper = { mass = "1 kg", center = [0, 0, "-l"] }
bodies.lower = { mass = "500 g", center = [0, 0, "-l"] }
joints.a = { child = "upper", axis = "-y", spring = "2 N m/rad", damper = 0.1 }
joints.c = { parent = "upper", child = "lower", axis = "-y", at = [0, 0, "-l"], torque = "-k c'" }
parameters = { l = { value = 1, unit = "m" }, k = { value = 1, unit = "N m s" } }
"#;
    let model = model(text);
    assert!(model.has_units);
    same(
        &model,
        kinetic(&model),
        "1/2 upper_mass l^2 a'^2 + 1/2 lower_mass l^2 (a'^2 + (a' + c')^2 + 2 a' (a' + c') cos(c))",
    );
    same(
        &model,
        potential(&model),
        "1/2 a_spring a^2 - upper_mass g l cos(a) - lower_mass g l (cos(a) + cos(a + c))",
    );
    same(
        &model,
        model.rayleigh.expect("a damper"),
        "1/2 a_damper a'^2",
    );
    same(&model, model.forces[0].value, "-k c'");
    let mass = model
        .parameters
        .iter()
        .find(|own| own.name == "lower_mass")
        .expect("a parameter");
    assert_eq!(model.graph.text(mass.value.expect("a value")), "1/2");
}

#[test]
fn a_family_of_links_is_a_chain_of_the_size_asked_for() {
    let text = r#"
sizes = { n = 2 }
indices = { i = "1..n", k = "2..n" }
bodies."link_{i}" = { mass = "i m", center = ["l", 0, 0] }
joints.q_1 = { child = "link_1", axis = "y" }
joints."q_{k}" = { parent = "link_{k-1}", child = "link_{k}", axis = "y", at = ["l", 0, 0] }
parameters = { l = 1, m = 1 }
"#;
    let set = [("n".to_owned(), "4".to_owned())];
    let loaded = load("model.toml", text, &NoFiles, &set);
    let (model, _) = loaded
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    assert_eq!(names(&model), ["q_1", "q_2", "q_3", "q_4"]);
    let height = |n: usize| {
        let terms = (1..=n).map(|k| {
            let angles: Vec<String> = (1..=k).map(|j| format!("q_{j}")).collect();
            format!("sin({})", angles.join(" + "))
        });
        terms.collect::<Vec<_>>().join(" + ")
    };
    let weights: Vec<String> = (1..=4).map(|n| format!("{n} ({})", height(n))).collect();
    same(
        &model,
        potential(&model),
        &format!("-m g l ({})", weights.join(" + ")),
    );
}

#[test]
fn a_closed_chain_becomes_constraints_and_what_says_nothing_is_left_out() {
    let text = r#"
bodies.crank = { mass = 1, inertia = 0.1 }
bodies.rod = { mass = 1, inertia = 0.1 }
bodies.slider = { mass = 2 }
joints.a = { child = "crank", axis = "-y" }
joints.b = { parent = "crank", child = "rod", axis = "-y", at = [1, 0, 0] }
joints.s = { child = "slider", type = "prismatic", axis = "x" }
joints.pin = { parent = "rod", child = "slider", axis = "y", at = [3, 0, 0] }
"#;
    let model = model(text);
    let of = |name: &str| {
        model
            .constraints
            .iter()
            .find(|own| own.name == name)
            .map(|own| own.f)
    };
    same(
        &model,
        of("pin_x").expect("x"),
        "s - b_at_x cos(a) - pin_at_x cos(a + b)",
    );
    same(
        &model,
        of("pin_z").expect("z"),
        "-b_at_x sin(a) - pin_at_x sin(a + b)",
    );
    assert_eq!(model.constraints.len(), 2);
}

#[test]
fn a_table_that_turns_carries_what_rolls_on_it() {
    let text = r#"
parameters = { W = 2 }
frames.table = { turn = { z = "W t" } }
bodies.ball = { shape = "ball", mass = 1, radius = 0.1 }
contacts.foot = { type = "rolling-without-spinning", body = "ball", on = "table", coordinates = ["x", "y", "a", "b", "c"] }
"#;
    let model = model(text);
    same(&model, model.constraints[2].f, "a' + c' sin(b)");
    let moment = "1/5 ball_mass ball_radius^2";
    let omega = "b'^2 + c'^2 + (a' + W)^2 + 2 (a' + W) c' sin(b)";
    let hand = format!("1/2 ball_mass ((x' - W y)^2 + (y' + W x)^2) + {moment} ({omega})");
    same(&model, kinetic(&model), &hand);
    assert!(model.potential.is_none());
}

#[test]
fn what_is_written_beside_bodies_is_added() {
    let text = r#"
coordinates = ["z"]
bodies.b = { mass = 1 }
joints.q = { child = "b", type = "prismatic", axis = "x" }
[lagrangian]
T = "1/2 z'^2"
V = "1/2 (z - q)^2"
[forces]
z = "1"
rayleigh = "1/2 z'^2"
"#;
    let stated = model(text);
    assert_eq!(names(&stated), ["z", "q"]);
    same(&stated, kinetic(&stated), "1/2 z'^2 + 1/2 b_mass q'^2");
    same(&stated, potential(&stated), "1/2 (z - q)^2");
    let text = text.replace("T = \"1/2 z'^2\"\nV = \"1/2 (z - q)^2\"", "L = \"z' q\"");
    let whole = model(&text);
    same(&whole, whole.lagrangian, "z' q + 1/2 b_mass q'^2");
}

/// A bead of a rotor, at the distance b from its axle: its moment of inertia is increased by m b².
#[test]
fn particles_beside_bodies_have_their_energies_too() {
    let text = r#"
gravity = 0
bodies.rotor = { shape = "disc", mass = 2, radius = 0.3 }
joints.a = { child = "rotor", axis = "y" }
sizes = { n = 2 }
indices = { i = "1..n" }
parameters = { b = 0.2, m_1 = 1, m_2 = 3 }
[particles]
"bead_{i}" = { mass = "m_{i}", position = ["i b cos(a)", "-i b sin(a)"] }
"#;
    let own = model(text);
    let hand = "1/4 rotor_mass rotor_radius^2 a'^2 + 1/2 (m_1 b^2 + 4 m_2 b^2) a'^2";
    same(&own, kinetic(&own), hand);
    assert_eq!(own.particles.len(), 2);
    let stated = format!("{text}\n[lagrangian]\nT = \"1/2 (m_1 + m_2) b^2 a'^2\"\n");
    // As without bodies, an energy that is stated is that of the particles too.
    let own = model(&stated);
    let hand = "1/4 rotor_mass rotor_radius^2 a'^2 + 1/2 (m_1 + m_2) b^2 a'^2";
    same(&own, kinetic(&own), hand);
}

#[test]
fn the_lowered_text_is_the_same_model() {
    let text = "name = \"disc\"\nbodies.disc = { shape = \"disc\", mass = \"2 kg\", radius = \"30 cm\" }\ncontacts.rim = { type = \"rolling\", body = \"disc\" }\ninitial = { \"disc_pitch'\" = 3 }\n";
    let written = lowered("model.toml", text, &NoFiles, &[]).unwrap();
    assert!(
        !written.contains("bodies.") && written.contains("[coordinates]"),
        "{written}"
    );
    let (own, again) = (model(text), model(&written));
    let in_words = |model: &Model| {
        let constraints = model.constraints.iter().map(|own| model.graph.text(own.f));
        let mut all: Vec<String> = constraints.collect();
        all.push(model.graph.text(model.lagrangian));
        all
    };
    assert_eq!(in_words(&own), in_words(&again));
    let set = [("disc_mass".to_owned(), "5".to_owned())];
    let written = lowered("model.toml", text, &NoFiles, &set).unwrap();
    assert!(written.contains("value = \"5\""), "{written}");
}

#[test]
fn the_old_heading_of_moving_frames_is_read_with_a_warning() {
    let text = "coordinates = [\"x\"]\nlagrangian = \"x'^2\"\n[frame.fields]\nu = { x = 2 }\n";
    let (model, found) = load("model.toml", text, &NoFiles, &[])
        .into_result()
        .unwrap();
    assert!(model.frame.is_some());
    assert_eq!(found.list[0].code, "renamed");
}

#[test]
fn what_makes_no_sense_is_said_of_the_object() {
    for (text, words) in [
        ("bodies.b = { mass = 1 }\n", vec!["the body `b` hangs nowhere", "joints"]),
        (
            "bodies.a = { mass = 1 }\nbodies.b = { mass = 1 }\njoints.p = { parent = \"a\", child = \"b\" }\njoints.q = { parent = \"b\", child = \"a\" }\n",
            vec!["hang on each other"],
        ),
        (
            "bodies.b = { mass = 1 }\njoints.q = { child = \"c\" }\n",
            vec!["names the body `c`", "state it under [bodies]"],
        ),
        (
            "bodies.b = { mass = 1, inertia = [1, 1, 3] }\njoints.q = { child = \"b\" }\n",
            vec!["b_inertia_xx + b_inertia_yy >= b_inertia_zz", "inertia = [1, 1, 3]"],
        ),
        (
            "bodies.b = { mass = 1, inertia = { xx = 1, yy = 1, zz = 1, xy = 2 } }\njoints.q = { child = \"b\" }\n",
            vec!["does not hold"],
        ),
        (
            "bodies.w = { shape = \"disc\", mass = 1, radius = 0.3 }\njoints.q = { child = \"w\", axis = \"y\", at = [0, 0, 0.5] }\ncontacts.c = { type = \"rolling\", body = \"w\" }\n",
            vec!["the contact `c` does not touch its plane"],
        ),
        (
            "bodies.w = { mass = 1 }\njoints.q = { child = \"w\", type = \"free\" }\ncontacts.c = { type = \"rolling\", body = \"w\" }\n",
            vec!["has no rim and no sphere"],
        ),
        (
            "bodies.b = { mass = 1 }\nframes.b = {}\njoints.q = { child = \"b\", axis = \"y\" }\n",
            vec!["`b` is a body already"],
        ),
        (
            "bodies.b = { mass = \"3 m\" }\njoints.q = { child = \"b\" }\n",
            vec!["mass of the body `b` is measured in kg, not in m"],
        ),
        (
            "bodies.b = { mass = \"3 kg\" }\njoints.q = { child = \"b\" }\nparameters = { kg = 1 }\n",
            vec!["`kg` is a unit and a name of this model"],
        ),
        (
            "bodies.b = { mas = 1 }\njoints.q = { child = \"b\" }\n",
            vec!["`mas` is no key of the body `b`", "did you mean `mass`"],
        ),
        (
            "bodies.a = { mass = 1, inertia = 1 }\nbodies.b = { mass = 1, inertia = 1 }\njoints.q = { child = \"a\", axis = \"y\" }\njoints.p = { child = \"b\", axis = \"y\" }\njoints.weld = { parent = \"a\", child = \"b\", at = [0, 1, 0] }\n",
            vec!["cannot close the chain"],
        ),
    ] {
        let loaded = load("model.toml", text, &NoFiles, &[]);
        let message = loaded.diagnostics.to_string();
        assert!(loaded.model.is_none(), "accepted: {text}");
        for word in words {
            assert!(message.contains(word), "`{word}` is missing in\n{message}");
        }
    }
    refused("bodies = 3\n", 1, &["`bodies` must be a table"]);
}

#[path = "../../../../tests/src/lines.rs"]
#[allow(dead_code, unreachable_pub, reason = "public where it belongs to")]
mod lines;

#[test]
fn models_of_bodies_are_as_short_as_promised_and_read_without_a_word() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery/bodies");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|own| own.unwrap().path())
        .collect();
    files.sort();
    assert!(files.len() >= lines::MOST.len());
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap();
        let own = model(&text);
        assert!(
            own.unused.is_empty(),
            "{}: {:?}",
            path.display(),
            own.unused
        );
        let name = path.file_stem().unwrap().to_str().unwrap();
        let Some((_, most)) = lines::MOST.iter().find(|(known, _)| *known == name) else {
            continue;
        };
        let counted = lines::lines(&text);
        assert!(
            counted.len() <= *most,
            "{name} has {} lines, and may have {most}",
            counted.len()
        );
        for line in counted {
            assert!(line.chars().count() <= lines::LONGEST, "{name}: {line}");
        }
    }
}

#[test]
fn names_of_motions_are_those_of_the_body() {
    let text = r#"
bodies.disc = { shape = "disc", mass = 1, radius = 0.5 }
contacts.rim = { type = "rolling", body = "disc", coordinates = ["x", "y", "phi", "theta", "psi"] }
[define]
hub = "disc_v_x cos(psi) + disc_v_z sin(psi)"
up = "disc_Z_z"
plain = "disc_omega_y"
"#;
    let text = format!("{text}[integrals]\na = \"hub\"\nb = \"up\"\nc = \"plain\"\n");
    let model = model(&text);
    // The hub moves along the heading as the contact does, and as the wheel leans while it turns.
    let hub = "x' cos(phi) + y' sin(phi) + disc_radius phi' sin(theta)";
    same(&model, model.integrals[0].value, hub);
    same(&model, model.integrals[1].value, "cos(theta) cos(psi)");
    same(&model, model.integrals[2].value, "psi' + phi' sin(theta)");
}

#[test]
fn a_roller_slides_across_its_axis() {
    let text = r#"
bodies.cart = { mass = 1, inertia = 1 }
bodies.wheel = { shape = "disc", mass = 1, radius = "r" }
joints.plane = { child = "cart", type = "planar", coordinates = ["x", "y", "a"] }
joints.q = { parent = "cart", child = "wheel", axis = "y", at = [0, 0, "r"] }
contacts.wheel = { type = "roller", angle = "g" }
parameters = { r = 0.1, g = 0.5 }
"#;
    let model = model(text);
    let forward = "(x' cos(a) + y' sin(a) - r q')";
    let side = "(y' cos(a) - x' sin(a))";
    same(
        &model,
        model.constraints[0].f,
        &format!("cos(g) {side} + sin(g) {forward}"),
    );
}

#[test]
fn a_height_that_depends_on_values_is_looked_at_with_them() {
    let text = "bodies.cart = { mass = 1, inertia = 1 }\nbodies.w = { shape = \"disc\", mass = 1, radius = 0.1 }\njoints.plane = { child = \"cart\", type = \"planar\" }\n\
         joints.q = { parent = \"cart\", child = \"w\", axis = \"y\", at = [0, 0, 0.1] }\ncontacts.w = { type = \"rolling\" }\n";
    assert_eq!(model(text).constraints.len(), 2);
    let set = [("w_radius".to_owned(), "0.2".to_owned())];
    let message = load("model.toml", text, &NoFiles, &set)
        .diagnostics
        .to_string();
    assert!(
        message.contains("the contact `w` does not touch its plane for the values"),
        "{message}"
    );
}

#[test]
fn a_torus_of_a_thin_tube_touches_as_its_rim() {
    let of = |shape: &str| {
        let text = format!(
            "bodies.w = {{ {shape}, mass = 1, inertia = [1, 2], radius = \"r\" }}\nparameters = {{ r = 0.3 }}\n\
             joints.f = {{ child = \"w\", type = \"free\", at = [0, 0, 0], coordinates = [\"x\", \"y\", \"z\", \"a\", \"b\", \"c\"] }}\ncontacts.t = {{ type = \"rolling\", body = \"w\" }}\n"
        );
        model(&text)
    };
    let (rim, tyre) = (of("shape = \"disc\""), of("shape = \"torus\", tube = 0.05"));
    for (own, other) in rim.constraints.iter().zip(&tyre.constraints) {
        let text = rim.graph.text(own.f);
        let thin = tyre.expression("w_tube").unwrap();
        let found = tyre.graph.substitute(other.f, &[(thin, tyre.graph.zero())]);
        same(&tyre, found, &text);
    }
    // Upright the tube lifts the wheel, and rolling turns about the outer radius.
    let upright = |e| {
        let pairs = ["a", "b", "c", "b'", "a'"]
            .map(|name| (tyre.expression(name).unwrap(), tyre.graph.zero()));
        tyre.graph.substitute(e, &pairs)
    };
    same(
        &tyre,
        upright(tyre.constraints[0].f),
        "x' - (r + w_tube) c'",
    );
    same(&tyre, upright(tyre.constraints[2].f), "z - r - w_tube");
}
