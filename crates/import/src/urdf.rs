//! The Unified Robot Description Format of ROS: links, and joints between them.
//!
//! The frame of a child link is that of its joint, which stands in the parent's at `xyz`, turned by `rpy`: about the fixed axes x, y, z, which is z, y,
//! x one after the other. Lengths are metres, angles radians, whatever the file says of itself.

use std::collections::HashMap;

use roxmltree::Node;

use crate::document::{child, note_attributes, note_others, one, required, three, ImportError};
use crate::numbers::{is_rounded, turned, Rotation, Vector, STILL};
use crate::robot::{Body, Gear, Joint, Kind, Robot};

/// Names of the description with those of the model.
#[derive(Default)]
struct Names {
    links: HashMap<String, String>,
    joints: HashMap<String, String>,
}

pub(crate) fn read(root: Node<'_, '_>) -> Result<Robot, ImportError> {
    let mut robot = Robot::new(root.attribute("name"), "URDF");
    note_others(&mut robot, root, &["link", "joint"]);
    let mut names = Names::default();
    let children: Vec<&str> = root
        .children()
        .filter(|own| own.has_tag_name("joint"))
        .filter_map(|own| child(own, "child")?.attribute("link"))
        .collect();
    for link in root.children().filter(|own| own.has_tag_name("link")) {
        let stated = required(link, "name")?;
        let is_world = stated == "world" && child(link, "inertial").is_none();
        if is_world && !children.contains(&stated) {
            names.links.insert(stated.to_owned(), "ground".to_owned());
            continue;
        }
        let name = robot.name(stated, link);
        names.links.insert(stated.to_owned(), name.clone());
        let body = body(&mut robot, link, name.clone())?;
        robot.bodies.push(body);
        if !children.contains(&stated) {
            let message = format!(
                "`{name}` stands on the ground; let `base` be of the type \"free\" where it moves"
            );
            robot.note(link, message);
            let base = robot.name("base", link);
            let joint = Joint::fixed(base, "ground".to_owned(), name);
            robot.joints.push(joint);
        }
    }
    if robot.bodies.is_empty() {
        return Err(ImportError::Empty);
    }
    let joints = root.children().filter(|own| own.has_tag_name("joint"));
    let joints: Vec<Node<'_, '_>> = joints.collect();
    for own in &joints {
        let stated = required(*own, "name")?;
        let name = robot.name(stated, *own);
        names.joints.insert(stated.to_owned(), name.clone());
        let joint = joint(&mut robot, *own, name, &names)?;
        robot.add_joint(joint, *own);
    }
    for own in joints {
        mimic(&mut robot, own, &names)?;
    }
    Ok(robot)
}

fn body(robot: &mut Robot, link: Node<'_, '_>, name: String) -> Result<Body, ImportError> {
    note_others(robot, link, &["inertial"]);
    let mut body = Body {
        name,
        ..Body::default()
    };
    let Some(inertial) = child(link, "inertial") else {
        return Ok(body);
    };
    let (center, rotation) = origin(robot, inertial)?;
    body.center = center;
    body.inertia_axes = (rotation != STILL).then_some(rotation);
    if let Some(mass) = child(inertial, "mass") {
        body.mass = one(mass, "value")?.unwrap_or(0.0);
    }
    if let Some(inertia) = child(inertial, "inertia") {
        let keys = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
        for (own, key) in body.inertia.iter_mut().zip(keys) {
            *own = one(inertia, key)?.unwrap_or(0.0);
        }
    }
    Ok(body)
}

/// `<origin xyz rpy>`.
fn origin(robot: &mut Robot, node: Node<'_, '_>) -> Result<(Vector, Rotation), ImportError> {
    let Some(origin) = child(node, "origin") else {
        return Ok(([0.0; 3], STILL));
    };
    let at = three(origin, "xyz")?.unwrap_or_default();
    let [roll, pitch, yaw] = three(origin, "rpy")?.unwrap_or_default();
    if [roll, pitch, yaw].into_iter().any(is_rounded) {
        let message = "an angle within 1e-5 of a multiple of pi/12 is taken for that".to_owned();
        robot.note(origin, message);
    }
    Ok((at, turned(&[(2, yaw), (1, pitch), (0, roll)])))
}

fn joint(
    robot: &mut Robot,
    node: Node<'_, '_>,
    name: String,
    names: &Names,
) -> Result<Joint, ImportError> {
    let known = [
        "origin", "parent", "child", "axis", "limit", "dynamics", "mimic",
    ];
    note_others(robot, node, &known);
    let kind = match required(node, "type")? {
        "fixed" => Kind::Fixed,
        "prismatic" => Kind::Prismatic,
        "floating" => Kind::Free,
        "planar" => Kind::Planar,
        "revolute" | "continuous" => Kind::Revolute,
        other => {
            robot.note(
                node,
                format!("`{name}` is `{other}`, which is not known: it is taken for fixed"),
            );
            Kind::Fixed
        }
    };
    let link = |key: &str| {
        let own = child(node, key).ok_or_else(|| missing(node, &format!("<{key}>")))?;
        let stated = required(own, "link")?;
        let known = names.links.get(stated).cloned();
        known.ok_or_else(|| missing(own, &format!("link `{stated}`")))
    };
    let (parent, below) = (link("parent")?, link("child")?);
    let (at, rotation) = origin(robot, node)?;
    let axis = match child(node, "axis") {
        Some(axis) => three(axis, "xyz")?.unwrap_or([1.0, 0.0, 0.0]),
        None => [1.0, 0.0, 0.0],
    };
    let mut joint = Joint {
        kind,
        at,
        rotation,
        axis,
        ..Joint::fixed(name, parent, below)
    };
    if let Some(dynamics) = child(node, "dynamics") {
        joint.damping = one(dynamics, "damping")?.unwrap_or(0.0);
        if one(dynamics, "friction")?.is_some_and(|friction| friction != 0.0) {
            let message = format!("the friction of `{}` is not taken over: state it as `friction = {{ coefficient = 1, load = …, speed = … }}`", joint.name);
            robot.note(dynamics, message);
        }
    }
    limits(robot, node, &mut joint)?;
    Ok(joint)
}

fn limits(robot: &mut Robot, node: Node<'_, '_>, joint: &mut Joint) -> Result<(), ImportError> {
    let Some(limit) = child(node, "limit") else {
        return Ok(());
    };
    note_attributes(robot, limit, &["lower", "upper"]);
    let has_limits = node.attribute("type") != Some("continuous");
    let ends = [one(limit, "lower")?, one(limit, "upper")?];
    let (true, true) = (has_limits, ends.iter().any(Option::is_some)) else {
        return Ok(());
    };
    let [least, most] = ends.map(|end| end.unwrap_or(0.0));
    if least <= 0.0 && 0.0 <= most && least < most {
        joint.limits = Some([least, most]);
    } else {
        let message = format!(
            "the limits of `{}` leave out 0, at which it begins: they are not taken over",
            joint.name
        );
        robot.note(limit, message);
    }
    Ok(())
}

/// `<mimic>`: a gear.
fn mimic(robot: &mut Robot, node: Node<'_, '_>, names: &Names) -> Result<(), ImportError> {
    let Some(mimic) = child(node, "mimic") else {
        return Ok(());
    };
    let of = |stated: &str| names.joints.get(stated).cloned();
    let (stated, driving) = (required(node, "name")?, required(mimic, "joint")?);
    let (Some(driven), Some(driving)) = (of(stated), of(driving)) else {
        return Err(missing(mimic, &format!("joint `{driving}`")));
    };
    let gear = Gear {
        name: robot.name(&format!("{driven}_gear"), mimic),
        driving,
        driven,
        ratio: one(mimic, "multiplier")?.unwrap_or(1.0),
        offset: one(mimic, "offset")?.unwrap_or(0.0),
    };
    robot.gears.push(gear);
    Ok(())
}

fn missing(node: Node<'_, '_>, what: &str) -> ImportError {
    ImportError::Missing {
        line: crate::robot::line(node),
        element: node.tag_name().name().to_owned(),
        missing: what.to_owned(),
    }
}
