//! Where points of a scene lie in a picture.

use super::View;
use crate::scene::{Animation, Element, Shape};

/// Pixels that stay free at each side.
const MARGIN: f64 = 35.0;

/// The least height of a picture.
const FLATTEST: f64 = 120.0;

/// A parallel projection.
pub(super) struct Camera {
    right: Vec<f64>,
    up: Vec<f64>,
    toward: Vec<f64>,
    target: Vec<f64>,
    center: [f64; 2],
    /// Pixels of a unit of length.
    pub(super) scale: f64,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl Camera {
    /// The projection in which the bounds of a scene fill a picture.
    pub(super) fn new(scene: &Animation, [width, height]: [f64; 2]) -> Camera {
        let bounds = bounds(scene);
        let (right, up, toward) = axes(scene);
        let [w, h] = [&right, &up].map(|axis| extent(&bounds, axis));
        let room = |size: f64| (size - 2.0 * MARGIN).max(10.0);
        let scale = (room(width) / w.max(1e-12)).min(room(height) / h.max(1e-12));
        Camera {
            right,
            up,
            toward,
            target: bounds
                .iter()
                .map(|[low, high]| (low + high) / 2.0)
                .collect(),
            center: [width / 2.0, height / 2.0],
            scale,
        }
    }

    /// A point in pixels.
    pub(super) fn to(&self, point: &[f64]) -> [f64; 2] {
        let from: Vec<f64> = point.iter().zip(&self.target).map(|(a, b)| a - b).collect();
        [
            self.center[0] + self.scale * dot(&from, &self.right),
            self.center[1] - self.scale * dot(&from, &self.up),
        ]
    }

    /// How near a point is to who looks.
    pub(super) fn depth(&self, point: &[f64]) -> f64 {
        dot(point, &self.toward)
    }
}

/// The height that a picture of this width needs, as high as the view allows at most.
pub(super) fn height(scene: &Animation, view: &View) -> u32 {
    let bounds = bounds(scene);
    let (right, up, _) = axes(scene);
    let [w, h] = [&right, &up].map(|axis| extent(&bounds, axis));
    let scale = (f64::from(view.width) - 2.0 * MARGIN).max(10.0) / w.max(1e-12);
    let needed = (h * scale + 2.0 * MARGIN).max(FLATTEST);
    (needed.min(f64::from(view.height)).round() as u32).max(1)
}

/// The directions to the right, up, and toward who looks.
fn axes(scene: &Animation) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    if !scene.spatial {
        return (vec![1.0, 0.0], vec![0.0, 1.0], vec![0.0, 0.0]);
    }
    let [azimuth, elevation] = scene.camera.unwrap_or([-60.0, 25.0]).map(f64::to_radians);
    let (sa, ca) = azimuth.sin_cos();
    let (se, ce) = elevation.sin_cos();
    (
        vec![-sa, ca, 0.0],
        vec![-se * ca, -se * sa, ce],
        vec![ce * ca, ce * sa, se],
    )
}

/// The extent of a box along a direction.
fn extent(bounds: &[[f64; 2]], axis: &[f64]) -> f64 {
    let sides = bounds.iter().zip(axis);
    sides.map(|([low, high], a)| (high - low) * a.abs()).sum()
}

/// What must be visible: as stated, or found from all frames.
fn bounds(scene: &Animation) -> Vec<[f64; 2]> {
    if let Some(stated) = &scene.bounds {
        return stated.clone();
    }
    let d = if scene.spatial { 3 } else { 2 };
    let mut bounds = vec![[f64::INFINITY, f64::NEG_INFINITY]; d];
    for element in &scene.elements {
        let stride = element.shape.stride(scene.spatial);
        for values in element.values.chunks(stride.max(1)) {
            for point in hull(element, values, d) {
                for (side, x) in bounds.iter_mut().zip(point) {
                    if x.is_finite() {
                        *side = [side[0].min(x), side[1].max(x)];
                    }
                }
            }
        }
    }
    let is_met = |side: &[f64; 2]| side[0] <= side[1];
    let sides = bounds.into_iter();
    sides
        .map(|side| if is_met(&side) { side } else { [-1.0, 1.0] })
        .collect()
}

/// Points whose hull contains an element.
pub(super) fn hull(element: &Element, values: &[f64], d: usize) -> Vec<Vec<f64>> {
    let last = |place: usize| values.len().checked_sub(place).map_or(0.0, |i| values[i]);
    let center = &values[..d.min(values.len())];
    let around = |radius: f64| {
        let shifted = |sign: f64| center.iter().map(|c| c + sign * radius).collect();
        vec![shifted(-1.0), shifted(1.0)]
    };
    match element.shape {
        Shape::Circle | Shape::Sphere => around(last(1)),
        Shape::Wheel => around(last(2)),
        Shape::Blade => around(last(1) / 2.0),
        _ => values.chunks_exact(d).map(<[f64]>::to_vec).collect(),
    }
}
