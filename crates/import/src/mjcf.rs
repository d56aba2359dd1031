//! MuJoCo's format: bodies in bodies, with the joints by which they hang in them.
//!
//! A body stands in the one around it at `pos`, turned by `quat`, `euler` or `axisangle`; its joints are at `pos` in its own axes. Angles are degrees
//! unless `<compiler>` says otherwise. Joints have the values of their classes of defaults. `<connect>` and `<weld>` close chains as the bodies stand at the
//! beginning. Inertias that follow from geometries alone are noted.

use std::collections::HashMap;

use roxmltree::Node;

use crate::classes::Classes;
use crate::document::{note_others, numbers, one, required, three, ImportError};
use crate::numbers::{after, image, of_quaternion, transposed, turned, Rotation, Vector, STILL};
use crate::robot::{line, Body, Gear, Joint, Kind, Robot};

/// How angles are written.
#[derive(Clone, Copy)]
struct Angles {
    /// Radians for one unit.
    unit: f64,
}

/// A body that is to be read, and the one around it.
type Waiting<'a, 'i> = (Node<'a, 'i>, String);

/// Where a body stands at the beginning, against the ground.
#[derive(Clone, Copy)]
struct Stand {
    at: Vector,
    axes: Rotation,
}

const GROUND: Stand = Stand {
    at: [0.0; 3],
    axes: STILL,
};

/// What is known of names: joints by theirs, bodies by theirs with their names in the model, and where each stands by that name.
struct Known {
    angles: Angles,
    classes: Classes,
    joints: HashMap<String, String>,
    bodies: HashMap<String, String>,
    stands: HashMap<String, Stand>,
}

impl Known {
    fn stand(&self, name: &str) -> Stand {
        self.stands.get(name).copied().unwrap_or(GROUND)
    }
}

pub(crate) fn read(root: Node<'_, '_>) -> Result<Robot, ImportError> {
    let mut robot = Robot::new(root.attribute("model"), "MJCF");
    note_others(
        &mut robot,
        root,
        &["worldbody", "compiler", "option", "equality", "default"],
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
    let classes = Classes::read(&mut robot, root);
    let mut known = Known {
        angles,
        classes,
        joints: HashMap::new(),
        bodies: HashMap::from([("world".to_owned(), "ground".to_owned())]),
        stands: HashMap::new(),
    };
    let worlds = root.children().filter(|own| own.has_tag_name("worldbody"));
    let mut open: Vec<Waiting<'_, '_>> = Vec::new();
    for world in worlds {
        note_others(&mut robot, world, &["body"]);
        push(&mut open, world, "ground");
    }
    while let Some((node, parent)) = open.pop() {
        let name = body(&mut robot, (node, parent), &mut known)?;
        push(&mut open, node, &name);
    }
    if robot.bodies.is_empty() {
        return Err(ImportError::Empty);
    }
    for equality in root.children().filter(|own| own.has_tag_name("equality")) {
        couple(&mut robot, equality, &known.joints)?;
        close(&mut robot, equality, &known)?;
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
    known: &mut Known,
) -> Result<String, ImportError> {
    let angles = known.angles;
    note_others(robot, node, &["body", "inertial", "joint", "freejoint"]);
    for key in ["xyaxes", "zaxis"] {
        if node.attribute(key).is_some() {
            robot.note(node, format!("`{key}` of <body> is not taken over"));
        }
    }
    let wished = node.attribute("name").unwrap_or("body").to_owned();
    let name = robot.name(&wished, node);
    let stated = node.attribute("name");
    known
        .bodies
        .extend(stated.map(|stated| (stated.to_owned(), name.clone())));
    let own = inertial(robot, node, name.clone(), angles)?;
    let at = three(node, "pos")?.unwrap_or_default();
    let turned = rotation(node, angles)?;
    let around = known.stand(&parent);
    let moved = image(&around.axes, at);
    let stand = Stand {
        at: std::array::from_fn(|i| around.at[i] + moved[i]),
        axes: after(&around.axes, &turned),
    };
    known.stands.insert(name.clone(), stand);
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
        let mut joint = joint(robot, node, (parent, child.clone()), known)?;
        let (at, turned) = place.take().unwrap_or(([0.0; 3], STILL));
        let moved = image(&turned, joint.child_at);
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
    known: &mut Known,
) -> Result<Joint, ImportError> {
    let read = [
        "name",
        "type",
        "pos",
        "axis",
        "range",
        "limited",
        "damping",
        "stiffness",
        "springref",
        "class",
    ];
    crate::document::note_attributes(robot, node, &read);
    let (angles, classes) = (known.angles, &known.classes);
    let stated = node.attribute("name");
    let name = robot.name(stated.unwrap_or(&format!("{child}_joint")), node);
    known
        .joints
        .extend(stated.map(|stated| (stated.to_owned(), name.clone())));
    let kind = match (
        node.has_tag_name("freejoint"),
        classes.attribute(node, "type").unwrap_or("hinge"),
    ) {
        (true, _) | (_, "free") => Kind::Free,
        (_, "slide") => Kind::Prismatic,
        (_, "ball") => Kind::Spherical,
        _ => Kind::Revolute,
    };
    let mut joint = Joint::fixed(name, parent, child);
    joint.kind = kind;
    joint.child_at = classes.three(node, "pos")?.unwrap_or_default();
    joint.axis = classes.three(node, "axis")?.unwrap_or([0.0, 0.0, 1.0]);
    joint.damping = classes.one(node, "damping")?.unwrap_or(0.0);
    let unit = match kind {
        Kind::Revolute => angles.unit,
        _ => 1.0,
    };
    if let Some(stiffness) = classes.one(node, "stiffness")?.filter(|own| *own != 0.0) {
        joint.spring = Some([
            stiffness,
            unit * classes.one(node, "springref")?.unwrap_or(0.0),
        ]);
    }
    let range = classes.numbers(node, "range", 2)?;
    let is_limited = classes.attribute(node, "limited") != Some("false");
    if let Some(range) = range.filter(|_| is_limited) {
        let [least, most] = std::array::from_fn(|i| unit * range.get(i).copied().unwrap_or(0.0));
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
    note_others(robot, equality, &["joint", "connect", "weld"]);
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

/// `<connect>` and `<weld>`: chains that are closed where the bodies stand at the beginning. MuJoCo's are a little soft; these are not.
fn close(robot: &mut Robot, equality: Node<'_, '_>, known: &Known) -> Result<(), ImportError> {
    let is_closing = |own: &Node<'_, '_>| own.has_tag_name("connect") || own.has_tag_name("weld");
    for node in equality.children().filter(is_closing) {
        if node.attribute("active") == Some("false") {
            robot.note(
                node,
                "a constraint that is not active is not taken over".to_owned(),
            );
            continue;
        }
        let read = ["name", "class", "active", "body1", "body2", "anchor"];
        crate::document::note_attributes(robot, node, &read);
        if node.attribute("body1").is_none() {
            robot.note(
                node,
                "a constraint between sites is not taken over".to_owned(),
            );
            continue;
        }
        let first = body_of(node, required(node, "body1")?, known)?;
        let second = body_of(node, node.attribute("body2").unwrap_or("world"), known)?;
        let anchor = three(node, "anchor")?.unwrap_or_default();
        let is_weld = node.has_tag_name("weld");
        // The anchor of a weld is a point of the second body, that of a connection one of the first.
        let stands = [&first, &second].map(|name| known.stand(name));
        let [own, other] = if is_weld {
            [stands[1], stands[0]]
        } else {
            stands
        };
        let turned = image(&own.axes, anchor);
        let apart: Vector = std::array::from_fn(|i| own.at[i] + turned[i] - other.at[i]);
        let opposite = image(&transposed(&other.axes), apart);
        let [at, child_at] = if is_weld {
            [opposite, anchor]
        } else {
            [anchor, opposite]
        };
        let wished = node
            .attribute("name")
            .unwrap_or(if is_weld { "weld" } else { "connect" });
        let name = robot.name(wished, node);
        let mut joint = Joint::fixed(name, first, second);
        (joint.at, joint.child_at) = (at, child_at);
        if is_weld {
            joint.rotation = after(&transposed(&stands[0].axes), &stands[1].axes);
        } else {
            joint.kind = Kind::Spherical;
        }
        if joint.child == "ground" {
            joint = turned_round(joint);
        }
        robot.joints.push(joint);
    }
    Ok(())
}

/// The same joint with the ground as the parent.
fn turned_round(joint: Joint) -> Joint {
    let back = transposed(&joint.rotation);
    Joint {
        parent: joint.child,
        child: joint.parent,
        at: joint.child_at,
        child_at: joint.at,
        rotation: back,
        ..joint
    }
}

fn body_of(node: Node<'_, '_>, stated: &str, known: &Known) -> Result<String, ImportError> {
    known
        .bodies
        .get(stated)
        .cloned()
        .ok_or_else(|| ImportError::Missing {
            line: line(node),
            element: node.tag_name().name().to_owned(),
            missing: format!("body `{stated}`"),
        })
}
