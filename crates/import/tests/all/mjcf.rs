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
