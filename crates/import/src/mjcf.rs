//! MuJoCo's format: bodies in bodies, with the joints by which they hang in them.
//!
//! A body stands in the one around it at `pos`, turned by `quat`, `euler` or `axisangle`; its joints are at `pos` in its own axes. Angles are degrees
//! unless `<compiler>` says otherwise. Values that come from classes of defaults, and inertias that follow from geometries alone, are noted.

use std::collections::HashMap;

use roxmltree::Node;

use crate::document::{note_others, numbers, one, required, three, ImportError};
use crate::numbers::{of_quaternion, turned, Rotation, STILL};
use crate::robot::{line, Body, Gear, Joint, Kind, Robot};

/// How angles are written.
#[derive(Clone, Copy)]
struct Angles {
    /// Radians for one unit.
    unit: f64,
}

/// A body that is to be read, and the one around it.
type Waiting<'a, 'i> = (Node<'a, 'i>, String);

pub(crate) fn read(root: Node<'_, '_>) -> Result<Robot, ImportError> {
    let mut robot = Robot::new(root.attribute("model"), "MJCF");
    note_others(
        &mut robot,
        root,
        &["worldbody", "compiler", "option", "equality"],
    );
    let mut angles = Angles {
        unit: std::f64::consts::PI / 180.0,
    };
    for own in root.children().filter(Node::is_element) {
        match own.tag_name().name() {
            "compiler" => {
                crate::document::note_attributes(&mut robot, own, &["angle"]);
                if own.attribute("angle") == Some("radian") {
                    angles.unit = 1.0;
                }
            }
            "option" => gravity(&mut robot, own)?,
            _ => {}
        }
    }
    let mut joints = HashMap::new();
    let worlds = root.children().filter(|own| own.has_tag_name("worldbody"));
    let mut open: Vec<Waiting<'_, '_>> = Vec::new();
    for world in worlds {
        note_others(&mut robot, world, &["body"]);
        push(&mut open, world, "ground");
    }
    while let Some((node, parent)) = open.pop() {
        let name = body(&mut robot, (node, parent), angles, &mut joints)?;
        push(&mut open, node, &name);
    }
    if robot.bodies.is_empty() {
        return Err(ImportError::Empty);
    }
    for equality in root.children().filter(|own| own.has_tag_name("equality")) {
        couple(&mut robot, equality, &joints)?;
    }
    Ok(robot)
}

/// The bodies in a body, the first one last, so that it is read first.
fn push<'a, 'i>(open: &mut Vec<Waiting<'a, 'i>>, around: Node<'a, 'i>, name: &str) {
    let inner: Vec<_> = around
        .children()
        .filter(|own| own.has_tag_name("body"))
        .collect();
    open.extend(inner.into_iter().rev().map(|own| (own, name.to_owned())));
}

fn gravity(robot: &mut Robot, option: Node<'_, '_>) -> Result<(), ImportError> {
    crate::document::note_attributes(robot, option, &["gravity"]);
    match three(option, "gravity")? {
        Some([x, y, z]) if x == 0.0 && y == 0.0 && z <= 0.0 => robot.gravity = Some(-z),
        Some(_) => robot.note(
            option,
            "gravity does not point along -z: it is not taken over".to_owned(),
        ),
        None => {}
    }
    Ok(())
}

/// How a frame is turned.
fn rotation(node: Node<'_, '_>, angles: Angles) -> Result<Rotation, ImportError> {
    if let Some(own) = numbers(node, "quat", 4)? {
        let mut values = own.iter().filter_map(|text| text.parse().ok());
        return Ok(of_quaternion(std::array::from_fn(|_| {
            values.next().unwrap_or(0.0)
        })));
    }
    if let Some(own) = three(node, "euler")? {
        // Intrinsic about x, y, z, as where the compiler says nothing else.
        let turns: Vec<(usize, f64)> = own.iter().map(|x| x * angles.unit).enumerate().collect();
        return Ok(turned(&turns));
    }
    if let Some(own) = numbers(node, "axisangle", 4)? {
        let mut values = own.iter().filter_map(|text| text.parse::<f64>().ok());
        let [x, y, z, angle] = std::array::from_fn(|_| values.next().unwrap_or(0.0));
        let size = (x * x + y * y + z * z).sqrt();
        let (sin, cos) = (angle * angles.unit / 2.0).sin_cos();
        return Ok(of_quaternion([cos * size, sin * x, sin * y, sin * z]));
    }
    Ok(STILL)
}

/// Reads a body with its joints; returns its name.
fn body(
    robot: &mut Robot,
    (node, parent): Waiting<'_, '_>,
    angles: Angles,
    joints: &mut HashMap<String, String>,
) -> Result<String, ImportError> {
    note_others(robot, node, &["body", "inertial", "joint", "freejoint"]);
    for key in ["xyaxes", "zaxis", "childclass"] {
        if node.attribute(key).is_some() {
            robot.note(node, format!("`{key}` of <body> is not taken over"));
        }
    }
    let wished = node.attribute("name").unwrap_or("body").to_owned();
    let name = robot.name(&wished, node);
    let own = inertial(robot, node, name.clone(), angles)?;
    let at = three(node, "pos")?.unwrap_or_default();
    let turned = rotation(node, angles)?;
    let all: Vec<_> = node
        .children()
        .filter(|own| own.has_tag_name("joint") || own.has_tag_name("freejoint"))
        .collect();
    if all.is_empty() {
        let weld = robot.name(&format!("{name}_seat"), node);
        let mut joint = Joint::fixed(weld, parent.clone(), name.clone());
        (joint.at, joint.rotation) = (at, turned);
        robot.joints.push(joint);
    }
    // Several joints of one body stand one after the other, with massless bodies between them.
    let (mut parent, mut place) = (parent, Some((at, turned)));
    let count = all.len();
    for (number, node) in all.into_iter().enumerate() {
        let child = if number + 1 == count {
            name.clone()
        } else {
            let between = robot.name(&format!("{name}_link_{}", number + 1), node);
            robot.bodies.push(Body {
                name: between.clone(),
                ..Body::default()
            });
            between
        };
        let mut joint = joint(robot, node, (parent, child.clone()), angles, joints)?;
        let (at, turned) = place.take().unwrap_or(([0.0; 3], STILL));
        let moved = crate::numbers::image(&turned, joint.child_at);
        joint.at = std::array::from_fn(|i| at[i] + moved[i]);
        joint.rotation = turned;
        robot.add_joint(joint, node);
        parent = child;
    }
    robot.bodies.push(own);
    Ok(name)
}

fn inertial(
    robot: &mut Robot,
    node: Node<'_, '_>,
    name: String,
    angles: Angles,
) -> Result<Body, ImportError> {
    let mut body = Body {
        name,
        ..Body::default()
    };
    let Some(own) = crate::document::child(node, "inertial") else {
        if node.children().any(|own| own.has_tag_name("geom")) {
            let message = format!("the inertia of `{}` follows from its geometries alone, and is not computed: state `mass` and `inertia`", body.name);
            robot.note(node, message);
        }
        return Ok(body);
    };
    body.mass = one(own, "mass")?.unwrap_or(0.0);
    body.center = three(own, "pos")?.unwrap_or_default();
    let turned = rotation(own, angles)?;
    body.inertia_axes = (turned != STILL).then_some(turned);
    if let Some([xx, yy, zz]) = three(own, "diaginertia")? {
        body.inertia = [xx, yy, zz, 0.0, 0.0, 0.0];
    }
    if let Some(full) = numbers(own, "fullinertia", 6)? {
        let mut values = full.iter().filter_map(|text| text.parse().ok());
        body.inertia = std::array::from_fn(|_| values.next().unwrap_or(0.0));
    }
    Ok(body)
}

fn joint(
    robot: &mut Robot,
    node: Node<'_, '_>,
    (parent, child): (String, String),
    angles: Angles,
    joints: &mut HashMap<String, String>,
) -> Result<Joint, ImportError> {
    let known = [
        "name",
        "type",
        "pos",
        "axis",
        "range",
        "limited",
        "damping",
        "stiffness",
        "springref",
    ];
    crate::document::note_attributes(robot, node, &known);
    let stated = node.attribute("name");
    let name = robot.name(stated.unwrap_or(&format!("{child}_joint")), node);
    joints.extend(stated.map(|stated| (stated.to_owned(), name.clone())));
    let kind = match (
        node.has_tag_name("freejoint"),
        node.attribute("type").unwrap_or("hinge"),
    ) {
        (true, _) | (_, "free") => Kind::Free,
        (_, "slide") => Kind::Prismatic,
        (_, "ball") => Kind::Spherical,
        _ => Kind::Revolute,
    };
    let mut joint = Joint::fixed(name, parent, child);
    joint.kind = kind;
    joint.child_at = three(node, "pos")?.unwrap_or_default();
    joint.axis = three(node, "axis")?.unwrap_or([0.0, 0.0, 1.0]);
    joint.damping = one(node, "damping")?.unwrap_or(0.0);
    let unit = match kind {
        Kind::Revolute => angles.unit,
        _ => 1.0,
    };
    if let Some(stiffness) = one(node, "stiffness")?.filter(|own| *own != 0.0) {
        joint.spring = Some([stiffness, unit * one(node, "springref")?.unwrap_or(0.0)]);
    }
    if let Some(range) = numbers(node, "range", 2)? {
        let mut values = range.iter().filter_map(|text| text.parse::<f64>().ok());
        let [least, most] = std::array::from_fn(|_| unit * values.next().unwrap_or(0.0));
        if least <= 0.0 && 0.0 <= most && least < most {
            joint.limits = Some([least, most]);
        } else {
            let message = format!(
                "the range of `{}` leaves out 0, at which it begins: it is not taken over",
                joint.name
            );
            robot.note(node, message);
        }
    }
    Ok(joint)
}

/// `<equality>`: joints in a ratio. Others are noted.
fn couple(
    robot: &mut Robot,
    equality: Node<'_, '_>,
    joints: &HashMap<String, String>,
) -> Result<(), ImportError> {
    note_others(robot, equality, &["joint"]);
    for node in equality.children().filter(|own| own.has_tag_name("joint")) {
        let stated = required(node, "joint1")?;
        let of = |stated: &str| joints.get(stated).cloned();
        let Some(driven) = of(stated) else {
            return Err(ImportError::Missing {
                line: line(node),
                element: "joint".to_owned(),
                missing: format!("joint `{stated}`"),
            });
        };
        let coefficients = match node.attribute("polycoef") {
            Some(text) => text
                .split_whitespace()
                .map(|x| x.parse().unwrap_or(f64::NAN))
                .collect(),
            None => vec![0.0, 1.0],
        };
        let is_line = coefficients.iter().skip(2).all(|c: &f64| *c == 0.0)
            && coefficients.iter().all(|c| c.is_finite());
        let driving = node.attribute("joint2").and_then(of);
        let (Some(driving), true) = (driving, is_line) else {
            robot.note(
                node,
                "this equality of joints is no fixed ratio: it is not taken over".to_owned(),
            );
            continue;
        };
        let name = robot.name(&format!("{driven}_gear"), node);
        robot.gears.push(Gear {
            name,
            driving,
            driven,
            ratio: coefficients.get(1).copied().unwrap_or(1.0),
            offset: coefficients.first().copied().unwrap_or(0.0),
        });
    }
    Ok(())
}
