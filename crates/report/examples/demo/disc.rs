//! A disc rolling steadily on a circle, for the picture in space.

use chetaev_report::data::*;

pub(crate) fn report() -> Report {
    // A disc of radius r, inclined by theta, whose contact runs on a circle of radius R.
    let (r, theta, big, rate) = (0.5_f64, 0.35_f64, 1.6_f64, 0.9_f64);
    let times: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.03).collect();
    let mut wheel = Vec::new();
    let mut contact = Vec::new();
    let mut center = Vec::new();
    for t in &times {
        let (s, c) = (rate * t).sin_cos();
        // Radial direction, tangent, and the direction up in the disc.
        let up = [-theta.sin() * c, -theta.sin() * s, theta.cos()];
        let axis = [theta.cos() * c, theta.cos() * s, theta.sin()];
        let at = [big * c, big * s, 0.0];
        let middle = [0, 1, 2].map(|i| at[i] + r * up[i]);
        wheel.extend(middle);
        wheel.extend(axis);
        wheel.extend([r, -(big / r) * rate * t]);
        contact.extend(at);
        center.extend(middle);
    }
    let element = |name: &str, shape: Shape, tint: Tint, values: Vec<f64>| Element {
        name: name.into(),
        shape,
        tint,
        values,
    };
    let last = times.last().copied().unwrap_or(1.0);
    let ball = times
        .iter()
        .flat_map(|t| [0.4 * (t / last), 0.0, 0.3, 0.3])
        .collect();
    Report {
        title: "Rolling disc".into(),
        description: vec!["A disc in steady motion on a circle.".into()],
        animation: Some(Animation {
            spatial: true,
            times,
            elements: vec![
                element("contact", Shape::Trail, Tint::Blue, contact.clone()),
                element("disc", Shape::Wheel, Tint::Ink, wheel),
                element("", Shape::Point, Tint::Red, contact),
                element("path of the center", Shape::Trail, Tint::Amber, center),
                element("ball", Shape::Sphere, Tint::Green, ball),
            ],
            ground: true,
            unit: Some("m".into()),
            ..Animation::default()
        }),
        ..Report::default()
    }
}
