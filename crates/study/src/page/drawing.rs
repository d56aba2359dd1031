//! The moving picture: the drawing of the model evaluated along the motion.

use crate::study::{Motion, Study};
use chetaev_model::drawing::Shape as Drawn;
use chetaev_motion::observe::Observer;
use chetaev_report::data::{Animation, Element, Shape, Tint};
use chetaev_symbolic::{rational, Expr};

/// The drawing of the model evaluated along the motion.
pub(super) fn animation(study: &Study, motion: &Motion) -> Option<Animation> {
    let drawing = study.model.drawing.as_ref()?;
    let run = &motion.evidence.run;
    let expressions: Vec<Expr> = drawing
        .elements
        .iter()
        .flat_map(|e| e.shape.expressions())
        .collect();
    let mut observer = Observer::new(
        &study.system,
        &study.prepared.terms,
        &motion.binding,
        &expressions,
    )
    .ok()?;
    let series = observer.along(run);
    let mut start = 0;
    let elements = drawing
        .elements
        .iter()
        .map(|element| {
            let width = element.shape.expressions().len();
            let columns = &series[start..start + width];
            start += width;
            Element {
                name: element.name.clone(),
                shape: shape(&element.shape),
                tint: tint(&element.color),
                values: (0..run.len())
                    .flat_map(|j| columns.iter().map(move |c| c[j]))
                    .collect(),
            }
        })
        .collect();
    Some(Animation {
        spatial: drawing.spatial,
        times: run.times.clone(),
        elements,
        bounds: drawing.bounds.as_ref().map(|b| {
            b.iter()
                .map(|(low, high)| [rational::to_f64(low), rational::to_f64(high)])
                .collect()
        }),
        ground: drawing.ground,
        camera: drawing
            .camera
            .as_ref()
            .map(|(a, b)| [rational::to_f64(a), rational::to_f64(b)]),
        unit: None,
        description: (!drawing.description.is_empty()).then(|| drawing.description.clone()),
    })
}

fn shape(drawn: &Drawn) -> Shape {
    match drawn {
        Drawn::Point { .. } => Shape::Point,
        Drawn::Segment { .. } => Shape::Segment,
        Drawn::Arrow { .. } => Shape::Arrow,
        Drawn::Circle { .. } => Shape::Circle,
        Drawn::Sphere { .. } => Shape::Sphere,
        Drawn::Wheel { .. } => Shape::Wheel,
        Drawn::Blade { .. } => Shape::Blade,
        Drawn::Polyline {
            points,
            closed,
            filled,
        } => Shape::Polyline {
            points: points.len(),
            closed: *closed,
            filled: *filled,
        },
        Drawn::Trail { .. } => Shape::Trail,
        Drawn::Label { text, .. } => Shape::Label { text: text.clone() },
    }
}

fn tint(name: &str) -> Tint {
    match name {
        "muted" => Tint::Muted,
        "blue" => Tint::Blue,
        "red" => Tint::Red,
        "green" => Tint::Green,
        "amber" => Tint::Amber,
        "violet" => Tint::Violet,
        _ => Tint::Ink,
    }
}
