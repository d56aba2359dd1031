//! A robot as a model text, one object a line.

use std::fmt::Write as _;

use crate::numbers::{angle, angles, coordinate_axis, decimal, towards, Rotation, Vector, STILL};
use crate::robot::{Body, Joint, Kind, Robot};

/// The text.
pub(crate) fn written(robot: &Robot) -> String {
    let mut out = String::new();
    // Writing to a string does not fail.
    let _ = writeln!(
        out,
        "# A robot that was described in {}. Add contacts, motors and a start.\n",
        robot.format
    );
    let _ = writeln!(out, "name = \"{}\"", quoted(&robot.name));
    if let Some(gravity) = robot.gravity {
        let _ = writeln!(out, "gravity = {}", decimal(gravity));
    }
    out.push_str("\n[bodies]\n");
    for body in &robot.bodies {
        let _ = writeln!(out, "{} = {}", body.name, table(&body_entries(body)));
    }
    let seats: Vec<(String, String)> = robot.joints.iter().filter_map(seat).collect();
    if !seats.is_empty() {
        out.push_str("\n[frames]\n");
        for (name, value) in seats {
            let _ = writeln!(out, "{name} = {value}");
        }
    }
    out.push_str("\n[joints]\n");
    for joint in &robot.joints {
        let _ = writeln!(out, "{} = {}", joint.name, table(&joint_entries(joint)));
    }
    for gear in &robot.gears {
        let mut entries = vec![
            ("type", "\"gear\"".to_owned()),
            (
                "coordinates",
                format!("[\"{}\", \"{}\"]", gear.driving, gear.driven),
            ),
            ("ratio", decimal(gear.ratio)),
        ];
        if gear.offset != 0.0 {
            entries.push(("offset", decimal(gear.offset)));
        }
        let _ = writeln!(out, "{} = {}", gear.name, table(&entries));
    }
    out
}

fn quoted(text: &str) -> String {
    let plain = text.chars().map(|c| match c {
        '"' | '\\' => '\'',
        c if c.is_control() => ' ',
        c => c,
    });
    plain.collect()
}

fn table(entries: &[(&str, String)]) -> String {
    if entries.is_empty() {
        return "{}".to_owned();
    }
    let all: Vec<String> = entries
        .iter()
        .map(|(key, value)| format!("{key} = {value}"))
        .collect();
    format!("{{ {} }}", all.join(", "))
}

fn vector(v: Vector) -> String {
    format!("[{}]", v.map(decimal).join(", "))
}

fn turns(rotation: &Rotation) -> String {
    let named = ["z", "y", "x"].into_iter().zip(angles(rotation));
    let named = named.map(|(axis, own)| (axis, angle(own)));
    let turned: Vec<(&str, String)> = named.filter(|(_, own)| own != "0").collect();
    table(&turned)
}

fn is_zero(v: Vector) -> bool {
    v == [0.0; 3]
}

fn body_entries(body: &Body) -> Vec<(&'static str, String)> {
    let mut entries = Vec::new();
    if let Some(shape) = &body.shape {
        entries.push(("shape", format!("\"{}\"", shape.word)));
        entries.extend(shape.sizes.iter().cloned());
    }
    if body.mass != 0.0 {
        entries.push(("mass", decimal(body.mass)));
        if !is_zero(body.center) {
            entries.push(("center", vector(body.center)));
        }
    }
    if body.inertia != [0.0; 6] {
        entries.push(("inertia", inertia(body)));
    }
    entries
}

fn inertia(body: &Body) -> String {
    let keys = ["xx", "yy", "zz", "xy", "xz", "yz"];
    let is_diagonal = body.inertia[3..] == [0.0; 3] && body.inertia_axes.is_none();
    if is_diagonal {
        let [xx, yy, zz, ..] = body.inertia;
        return vector([xx, yy, zz]);
    }
    let own = keys
        .into_iter()
        .zip(body.inertia)
        .filter(|(_, e)| *e != 0.0);
    let mut entries: Vec<(&str, String)> = own.map(|(key, e)| (key, decimal(e))).collect();
    if let Some(axes) = &body.inertia_axes {
        entries.push(("turn", turns(axes)));
    }
    table(&entries)
}

/// The frame in which a turned child stands.
fn seat(joint: &Joint) -> Option<(String, String)> {
    if joint.rotation == STILL || turns(&joint.rotation) == "{}" {
        return None;
    }
    let mut entries = vec![("parent", format!("\"{}\"", joint.parent))];
    if !is_zero(joint.at) {
        entries.push(("at", vector(joint.at)));
    }
    entries.push(("turn", turns(&joint.rotation)));
    Some((format!("{}_frame", joint.name), table(&entries)))
}

fn joint_entries(joint: &Joint) -> Vec<(&'static str, String)> {
    let mut entries = Vec::new();
    if joint.kind != Kind::Revolute {
        entries.push(("type", format!("\"{}\"", joint.kind.word())));
    }
    let (parent, at) = match seat(joint) {
        Some((name, _)) => (name, [0.0; 3]),
        None => (joint.parent.clone(), joint.at),
    };
    if parent != "ground" {
        entries.push(("parent", format!("\"{parent}\"")));
    }
    entries.push(("child", format!("\"{}\"", joint.child)));
    if !is_zero(at) {
        entries.push(("at", vector(at)));
    }
    if !is_zero(joint.child_at) {
        entries.push(("child_at", vector(joint.child_at)));
    }
    if matches!(joint.kind, Kind::Revolute | Kind::Prismatic | Kind::Planar) {
        entries.extend(axis(joint.axis));
    }
    if joint.damping != 0.0 {
        entries.push(("damper", decimal(joint.damping)));
    }
    if let Some([stiffness, rest]) = joint.spring {
        let own = [("stiffness", decimal(stiffness)), ("rest", decimal(rest))];
        entries.push(("spring", table(&own)));
    }
    if let Some([least, most]) = joint.limits {
        entries.push((
            "limits",
            format!(
                "[{}, {}]",
                angle_or_length(joint, least),
                angle_or_length(joint, most)
            ),
        ));
    }
    entries
}

fn angle_or_length(joint: &Joint, x: f64) -> String {
    match joint.kind {
        Kind::Revolute => angle(x),
        _ => decimal(x),
    }
}

/// A coordinate axis, or the third axis turned into the direction.
fn axis(direction: Vector) -> Vec<(&'static str, String)> {
    if let Some((axis, is_backward)) = coordinate_axis(direction) {
        let sign = if is_backward { "-" } else { "" };
        let letter = ["x", "y", "z"][axis];
        return vec![("axis", format!("\"{sign}{letter}\""))];
    }
    let [z, y] = towards(direction).map(angle);
    let turned = [("z", z), ("y", y)];
    let turned: Vec<(&str, String)> = turned.into_iter().filter(|(_, own)| own != "0").collect();
    vec![("axis", "\"z\"".to_owned()), ("tilt", table(&turned))]
}
