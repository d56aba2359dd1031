//! MJCF against energies by hand.

use crate::{model, value};

const CART: &str = r#"
<mujoco model="cart">
  <compiler angle="degree"/>
  <option gravity="0 0 -9.5" timestep="0.01"/>
  <worldbody>
    <light pos="0 0 1"/>
    <body name="cart" pos="0 0 0.2">
      <joint name="x" type="slide" axis="1 0 0" damping="0.3"/>
      <inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/>
      <body name="pole" pos="0 0 0.1" euler="0 90 0">
        <joint name="hinge" axis="0 1 0" pos="0 0 0.05" range="-90 90"/>
        <inertial pos="0 0 0.55" mass="0.5" fullinertia="0.02 0.02 0.001 0 0 0"/>
        <geom type="capsule" size="0.02 0.5"/>
      </body>
    </body>
    <body name="wheel">
      <joint name="a"/>
      <joint name="b" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.2 0.3"/>
    </body>
  </worldbody>
  <equality><joint joint1="a" joint2="b" polycoef="0.5 2 0 0 0"/></equality>
  <actuator/>
</mujoco>
"#;

#[test]
fn a_cart_with_a_pole_has_its_energies() {
    let (imported, model) = model(CART);
    let names: Vec<&str> = model
        .coordinates
        .iter()
        .map(|own| own.name.as_str())
        .collect();
    assert_eq!(names, ["x", "hinge", "a", "b"], "{}", imported.text);
    // The hinge is 0.05 above the origin of the pole, which points along x at first; the centre is half a metre from the hinge.
    let q: f64 = 0.3;
    let mut state = vec![("x", 0.7), ("hinge", q), ("a", 0.2), ("b", 0.4)];
    let height = -0.5 * q.sin();
    let g = value(&model, model.potential.expect("a weight"), &state);
    let at = |angle: f64| {
        let mut state = state.clone();
        state[1].1 = angle;
        value(&model, model.potential.expect("a weight"), &state)
    };
    assert!((g - at(0.0) - 0.5 * 9.5 * height).abs() < 1e-9, "{g}");
    state.extend([("x'", 1.0), ("hinge'", 2.0), ("a'", 0.5), ("b'", 0.25)]);
    // The centre of the pole moves with x' − l q' sin q along x and −l q' cos q along z.
    let (vx, vz) = (1.0 - 0.5 * 2.0 * q.sin(), -0.5 * 2.0 * q.cos());
    let pole = 0.5 * 0.5 * (vx * vx + vz * vz) + 0.5 * 0.02 * 4.0;
    // The wheel turns about its x, and about the z before that turn.
    let b: f64 = 0.4;
    let (x, y, z) = (0.25, 0.5 * b.sin(), 0.5 * b.cos());
    let wheel = 0.5 * (0.1 * x * x + 0.2 * y * y + 0.3 * z * z);
    let found = value(&model, model.kinetic.expect("an energy"), &state);
    assert!(
        (found - (1.5 + pole + wheel)).abs() < 1e-9,
        "{found}, not {}\n{}",
        1.5 + pole + wheel,
        imported.text
    );
    let gear = value(&model, model.constraints[0].f, &state);
    assert!((gear - (0.2 - (2.0 * 0.4 + 0.5))).abs() < 1e-12, "{gear}");
    assert_eq!(model.events.len(), 2);
    for word in ["<light>", "<geom>", "<actuator>", "`timestep`"] {
        assert!(
            imported.notes.iter().any(|own| own.message.contains(word)),
            "{word}: {:?}",
            imported.notes
        );
    }
}

const LOOP: &str = r#"
<mujoco model="loop">
  <compiler angle="radian"/>
  <default>
    <joint axis="0 1 0" damping="0.2"/>
    <geom rgba="1 0 0 1"/>
    <default class="stiff"><joint stiffness="7" springref="0.1"/></default>
  </default>
  <worldbody>
    <body name="crank" pos="0 0 1" childclass="stiff">
      <joint name="a"/>
      <inertial pos="0.5 0 0" mass="2" diaginertia="0.1 0.1 0.1"/>
      <body name="rod" pos="1 0 0" euler="0 0 0.5">
        <joint name="b" class="main" damping="0.3"/>
        <inertial pos="0.2 0 0" mass="1" diaginertia="0.1 0.2 0.3"/>
      </body>
    </body>
    <body name="slab" pos="0 2 0" euler="0.3 0 0">
      <freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.2 0.3"/>
    </body>
  </worldbody>
  <equality>
    <connect body1="rod" anchor="0.4 0 0"/>
    <weld body1="crank" body2="slab"/>
    <connect body1="rod" body2="slab" anchor="0 0 0" active="false"/>
  </equality>
</mujoco>
"#;

/// Joints have what their classes say, and the two constraints hold as the bodies stand, and no longer where they are moved.
#[test]
fn classes_and_closed_chains_are_taken_over() {
    let (imported, model) = model(LOOP);
    // The slab begins at zero in its own frame.
    let value_at = |moved: &[(&str, f64)], e| {
        let still = model.coordinates.iter().map(|own| (own.name.as_str(), 0.0));
        let stated = moved.iter().copied();
        let state: Vec<(&str, f64)> = stated.chain(still).collect();
        value(&model, e, &state)
    };
    let at = |moved: &[(&str, f64)], name: &str| {
        let own = model.constraints.iter().find(|own| own.name == name);
        value_at(moved, own.expect("a constraint of that name").f)
    };
    let closed: Vec<_> = model
        .constraints
        .iter()
        .filter(|own| own.name.starts_with("connect") || own.name.starts_with("weld"))
        .collect();
    assert_eq!(closed.len(), 9, "{}", imported.text);
    for own in &closed {
        let zero = value_at(&[], own.f);
        assert!(
            zero.abs() < 1e-12,
            "{} = {zero}\n{}",
            own.name,
            imported.text
        );
    }
    // The end of the rod is at (1, 0, 1) + Rz(1/2) (0.4, 0, 0); the crank by an angle q about y takes all of it along.
    let q: f64 = 0.3;
    let (x, z) = (1.0 + 0.4 * 0.5_f64.cos(), 0.0);
    let expected = [x * q.cos() - x, 0.0, -x * q.sin() - z];
    for (axis, expected) in ["x", "y", "z"].into_iter().zip(expected) {
        let found = at(&[("a", q)], &format!("connect_{axis}"));
        assert!(
            (found.abs() - expected.abs()).abs() < 1e-12,
            "{axis}: {found}, not {expected}"
        );
    }
    // The weld holds the slab where it is beside the crank.
    let moved = at(&[("slab_joint_y", 0.5)], "weld_z");
    assert!((moved.abs() - 0.5 * 0.3_f64.sin()).abs() < 1e-12, "{moved}");
    for line in ["stiffness = 7, rest = 0.1", "damper = 0.2", "damper = 0.3"] {
        assert!(imported.text.contains(line), "{line}\n{}", imported.text);
    }
    let rod = imported.text.lines().find(|line| line.starts_with("b = "));
    assert!(
        !rod.expect("the joint").contains("spring"),
        "{}",
        imported.text
    );
    for word in ["<geom>", "not active"] {
        assert!(
            imported.notes.iter().any(|own| own.message.contains(word)),
            "{word}: {:?}",
            imported.notes
        );
    }
}

#[test]
fn a_chain_that_names_no_body_is_refused() {
    let text = LOOP.replace("body2=\"slab\"/>", "body2=\"slap\"/>");
    let refused = chetaev_import::import(&text).expect_err("there is no such body");
    assert!(refused.to_string().contains("body `slap`"), "{refused}");
}
