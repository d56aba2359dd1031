//! How to draw the system: shapes placed by expressions of the coordinates.

use chetaev_symbolic::{Expr, Rational};

/// A moving picture, stated by expressions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Three coordinates for each point instead of two; the third axis points up.
    pub spatial: bool,
    /// In space: draw a grid on the plane z = 0.
    pub ground: bool,
    /// In space: first azimuth and elevation of the camera, in degrees.
    pub camera: Option<(Rational, Rational)>,
    /// What must be visible, a pair of ends for each axis; found from the motion where absent.
    pub bounds: Option<Vec<(Rational, Rational)>>,
    /// What the picture shows, for readers who do not see it; may be empty.
    pub description: String,
    /// What is drawn, the furthest back first.
    pub elements: Vec<Element>,
}

/// One thing drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Its name in the key of the picture; empty for none.
    pub name: String,
    /// Its color by role: `ink`, `muted`, `blue`, `red`, `green`, `amber` or `violet`.
    pub color: String,
    /// What it is, with its expressions.
    pub shape: Shape,
}

/// A vector of two expressions, or three in space.
pub type Point = Vec<Expr>;

/// A shape. Vectors have two expressions in the plane and three in space.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A dot.
    Point {
        /// Where.
        at: Point,
    },
    /// A straight line.
    Segment {
        /// One end.
        from: Point,
        /// The other end.
        to: Point,
    },
    /// An arrow.
    Arrow {
        /// Tail.
        from: Point,
        /// Tip.
        to: Point,
    },
    /// A ring.
    Circle {
        /// Its center.
        center: Point,
        /// In space, the normal of its plane.
        axis: Option<Point>,
        /// Its radius.
        radius: Expr,
    },
    /// A ball.
    Sphere {
        /// Its center.
        center: Point,
        /// Its radius.
        radius: Expr,
    },
    /// A wheel with a spoke.
    Wheel {
        /// Its center.
        center: Point,
        /// In space, its axis.
        axis: Option<Point>,
        /// Its radius.
        radius: Expr,
        /// The angle through which it has turned.
        angle: Expr,
    },
    /// A blade, runner, or wheel seen from above: a bar about a point.
    Blade {
        /// Its middle.
        at: Point,
        /// In the plane one angle from the first axis, in space a vector.
        direction: Vec<Expr>,
        /// Its length.
        length: Expr,
    },
    /// A broken line.
    Polyline {
        /// Its corners, two at least.
        points: Vec<Point>,
        /// Joined at the ends.
        closed: bool,
        /// Filled, for bodies.
        filled: bool,
    },
    /// The path of a point up to the present.
    Trail {
        /// The point.
        at: Point,
    },
    /// Words beside a point.
    Label {
        /// The point.
        at: Point,
        /// The words.
        text: String,
    },
}

impl Shape {
    /// All expressions of the shape in the order in which a frame lists their values: points, axis or direction,
    /// radius or length, angle.
    pub fn expressions(&self) -> Vec<Expr> {
        match self {
            Shape::Point { at } | Shape::Trail { at } | Shape::Label { at, .. } => at.clone(),
            Shape::Segment { from, to } | Shape::Arrow { from, to } => {
                [from.as_slice(), to].concat()
            }
            Shape::Circle {
                center,
                axis,
                radius,
            } => [
                center.as_slice(),
                axis.as_deref().unwrap_or(&[]),
                &[*radius],
            ]
            .concat(),
            Shape::Sphere { center, radius } => [center.as_slice(), &[*radius]].concat(),
            Shape::Wheel {
                center,
                axis,
                radius,
                angle,
            } => [
                center.as_slice(),
                axis.as_deref().unwrap_or(&[]),
                &[*radius, *angle],
            ]
            .concat(),
            Shape::Blade {
                at,
                direction,
                length,
            } => [at.as_slice(), direction, &[*length]].concat(),
            Shape::Polyline { points, .. } => points.concat(),
        }
    }
}
