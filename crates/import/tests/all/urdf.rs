//! URDF against rotations by Rodrigues's formula and energies of textbooks.

use crate::{model, plus, turned, value};

const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <material name="grey"/>
  <link name="world"/>
  <link name="upper-link">
    <visual><geometry><mesh filename="package://arm/upper.stl"/></geometry></visual>
    <inertial>
      <origin xyz="0.1 0.2 0.3" rpy="0 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.3" iyy="0.4" izz="0.5" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="lower">
    <inertial>
      <origin xyz="0 0 -0.4" rpy="0.1 0.2 0.3"/>
      <mass value="1.5"/>
      <inertia ixx="0.03" iyy="0.04" izz="0.05" ixy="0.001" ixz="0.002" iyz="0.003"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="world"/><child link="upper-link"/>
    <origin xyz="0.5 0.6 0.7" rpy="0.3 0.4 0.5"/>
    <axis xyz="1 2 2"/>
    <limit lower="-1" upper="2" effort="10" velocity="3"/>
    <dynamics damping="0.2" friction="0.1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper-link"/><child link="lower"/>
    <origin xyz="0 0 0.9"/>
    <axis xyz="0 -1 0"/>
    <mimic joint="shoulder" multiplier="-2" offset="0.25"/>
  </joint>
  <transmission name="t1"/>
</robot>
"#;

#[test]
fn a_chain_stands_where_rodrigues_puts_it() {
    let (imported, model) = model(ARM);
    let (shoulder, elbow) = (0.7, -0.4);
    let roll_pitch_yaw = |v| {
        let v = turned([1.0, 0.0, 0.0], 0.3, v);
        turned([0.0, 0.0, 1.0], 0.5, turned([0.0, 1.0, 0.0], 0.4, v))
    };
    let upper = |v| {
        plus(
            [0.5, 0.6, 0.7],
            roll_pitch_yaw(turned([1.0, 2.0, 2.0], shoulder, v)),
        )
    };
    let lower = |v| upper(plus([0.0, 0.0, 0.9], turned([0.0, -1.0, 0.0], elbow, v)));
    let height = 2.0 * upper([0.1, 0.2, 0.3])[2] + 1.5 * lower([0.0, 0.0, -0.4])[2];
    // Heights that do not change have no energy; here all change.
    let state = [("shoulder", shoulder), ("elbow", elbow)];
    let found = value(&model, model.potential.expect("weights"), &state);
    assert!(
        (found - 9.81 * height).abs() < 1e-9,
        "{found}, not {}\n{}",
        9.81 * height,
        imported.text
    );
    // The second link turns about its own axis alone: the moment about it, with Steiner's term.
    let still = [
        ("shoulder", shoulder),
        ("elbow", elbow),
        ("shoulder'", 0.0),
        ("elbow'", 1.0),
    ];
    let axis = [0.1, 0.2, 0.3];
    let into = |v| {
        turned(
            [0.0, 0.0, 1.0],
            axis[2],
            turned(
                [0.0, 1.0, 0.0],
                axis[1],
                turned([1.0, 0.0, 0.0], axis[0], v),
            ),
        )
    };
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(into);
    let y = columns.map(|column| column[1]);
    let matrix = [
        [0.03, 0.001, 0.002],
        [0.001, 0.04, 0.003],
        [0.002, 0.003, 0.05],
    ];
    let central: f64 = (0..3)
        .map(|i| (0..3).map(|j| y[i] * matrix[i][j] * y[j]).sum::<f64>())
        .sum();
    let moment = central + 1.5 * 0.4 * 0.4;
    let found = value(&model, model.kinetic.expect("an energy"), &still);
    assert!(
        (found - 0.5 * moment).abs() < 1e-12,
        "{found}, not {}",
        0.5 * moment
    );
}

#[test]
fn mimics_are_gears_and_what_is_left_out_is_named() {
    let (imported, model) = model(ARM);
    let gear = &model.constraints[0];
    let found = value(&model, gear.f, &[("shoulder", 0.3), ("elbow", 0.1)]);
    assert!(
        (found - (0.1 - (-2.0 * 0.3 + 0.25))).abs() < 1e-12,
        "{found}"
    );
    assert_eq!(model.events.len(), 2, "the limits of the shoulder");
    let notes: Vec<(u32, &str)> = imported
        .notes
        .iter()
        .map(|own| (own.line, own.message.as_str()))
        .collect();
    for (line, word) in [
        (3, "<material>"),
        (5, "`upper-link` is called `upper_link`"),
        (6, "<visual>"),
        (24, "`effort`"),
        (24, "`velocity`"),
        (25, "friction"),
        (33, "<transmission>"),
    ] {
        let is_there = notes
            .iter()
            .any(|(own, message)| (*own, message.contains(word)) == (line, true));
        assert!(is_there, "line {line}: {word} is missing in {notes:?}");
    }
}

#[test]
fn right_angles_are_right() {
    let text = ARM.replace("rpy=\"0.3 0.4 0.5\"", "rpy=\"1.5707963 0 -3.14159265\"");
    let (imported, _) = model(&text);
    assert!(
        imported
            .text
            .contains("turn = { z = \"-pi\", x = \"pi/2\" }"),
        "{}",
        imported.text
    );
    assert!(imported
        .notes
        .iter()
        .any(|own| own.message.contains("1e-5")));
}

/// A tree of thirty joints.
#[test]
fn a_robot_of_thirty_joints_is_read() {
    let mut text = "<robot name=\"tree\"><link name=\"l0\"/>".to_owned();
    for i in 1..=30 {
        let parent = (i - 1) / 2;
        text += &format!(
            "<link name=\"l{i}\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\
             <joint name=\"j{i}\" type=\"continuous\"><parent link=\"l{parent}\"/><child link=\"l{i}\"/><origin xyz=\"0.1 0 0.2\" rpy=\"0 0.3 0\"/><axis xyz=\"0 0 1\"/></joint>"
        );
    }
    let (_, model) = model(&(text + "</robot>"));
    assert_eq!(model.n(), 30);
}
