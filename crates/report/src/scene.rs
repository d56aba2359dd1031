//! The moving picture as plain data: elements, and for each frame the numbers that place them.

use serde::{Deserialize, Serialize};

/// A moving picture of the system.
///
/// All coordinates are in one right-handed Cartesian system; in three dimensions the third axis
/// points up. Lengths share one unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Animation {
    /// Two (`false`) or three (`true`) coordinates per point.
    pub spatial: bool,
    /// Time of each frame, in the unit of the trajectory; one unit is shown as one second at
    /// speed 1.
    #[serde(with = "crate::number::vector")]
    pub times: Vec<f64>,
    /// What is drawn, the first element first (furthest back in two dimensions).
    pub elements: Vec<Element>,
    /// `[[min, max]; 2 or 3]` of what must be visible; found from the elements where absent.
    pub bounds: Option<Vec<[f64; 2]>>,
    /// In three dimensions: draw a grid on the plane z = 0.
    pub ground: bool,
    /// In three dimensions: first azimuth and elevation of the camera, in degrees.
    pub camera: Option<[f64; 2]>,
    /// Unit of length, for the scale bar.
    pub unit: Option<String>,
    /// What the picture shows, for readers who do not see it.
    pub description: Option<String>,
}

/// One thing drawn, over all frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Element {
    /// Its name, shown in the key of the picture; empty for none.
    pub name: String,
    /// What it is and how many numbers a frame has.
    pub shape: Shape,
    /// Its color.
    pub tint: Tint,
    /// The numbers of frame 0, then of frame 1, …: `stride × frames` in all. A frame with a
    /// number that is not finite is not drawn.
    #[serde(with = "crate::number::vector")]
    pub values: Vec<f64>,
}

/// A kind of element; d is 2 or 3, the numbers of one frame are listed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Shape {
    /// A dot: position (d).
    #[default]
    Point,
    /// A straight line: two ends (2d).
    Segment,
    /// An arrow: tail and tip (2d).
    Arrow,
    /// A ring: center (d), then in space its axis (3), then its radius (1).
    Circle,
    /// A ball: center (d), radius (1).
    Sphere,
    /// A wheel with a spoke: center (d), then in space its axis (3), then radius (1), then the
    /// angle of rotation (1). In the plane the wheel is seen from the side and the angle is
    /// counted from the first axis, counterclockwise. In space it is counted from e₁ towards
    /// axis × e₁, where e₁ is the horizontal direction (vertical × axis) in the wheel, or the
    /// first axis for a horizontal wheel.
    Wheel,
    /// A blade or runner, drawn as a bar about its position: position (d), then its direction —
    /// in the plane an angle (1), in space a vector (3) — then its length (1).
    Blade,
    /// A broken line of a fixed number of points (points × d).
    Polyline {
        /// Number of points.
        points: usize,
        /// Joined at the ends.
        closed: bool,
        /// Filled, for bodies.
        filled: bool,
    },
    /// The path of a point up to the present frame: position (d).
    Trail,
    /// Text beside a point: position (d).
    Label {
        /// The text.
        text: String,
    },
}

impl Shape {
    /// How many numbers one frame of the element has, in the plane or in space.
    #[must_use]
    pub fn stride(&self, spatial: bool) -> usize {
        let d = if spatial { 3 } else { 2 };
        let axis = if spatial { 3 } else { 0 };
        match self {
            Shape::Point | Shape::Trail | Shape::Label { .. } => d,
            Shape::Segment | Shape::Arrow => 2 * d,
            Shape::Circle => d + axis + 1,
            Shape::Sphere => d + 1,
            Shape::Wheel => d + axis + 2,
            Shape::Blade => d + if spatial { 3 } else { 1 } + 1,
            Shape::Polyline { points, .. } => points * d,
        }
    }
}

/// Colors that read well on light and dark ground; chosen by role.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tint {
    /// The color of text.
    #[default]
    Ink,
    /// Pale: scaffolding, ground, axes.
    Muted,
    /// First color.
    Blue,
    /// Second color.
    Red,
    /// Third color.
    Green,
    /// Fourth color.
    Amber,
    /// Fifth color.
    Violet,
    /// Sixth color, which no model can ask for: a second motion beside the first.
    Teal,
}
