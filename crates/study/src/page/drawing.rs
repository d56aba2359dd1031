//! The moving picture: the drawing of the model evaluated along the motion.

use super::default_drawing::drawn_by_itself;
use crate::study::{Motion, Study};
use chetaev_model::drawing::{Drawing, Element as Stated, Shape as Drawn};
use chetaev_motion::observe::Observer;
use chetaev_motion::Run;
use chetaev_report::data::{Animation, Element, Shape, Tint};
use chetaev_symbolic::{rational, Expr};

/// The moving picture of a study: the drawing of its model, or one that follows from its particles and coordinates; `None` where no motion
/// was computed.
pub fn scene(study: &Study) -> Option<Animation> {
    let motion = study.motion.as_ref()?;
    animation(study, motion, &of_study(study)?)
}

/// The drawing of a model, or one that follows from its particles and coordinates.
pub(super) fn of_study(study: &Study) -> Option<Drawing> {
    let stated = study.model.drawing.clone();
    stated.or_else(|| drawn_by_itself(study))
}

/// A drawing evaluated along the motion.
fn animation(study: &Study, motion: &Motion, drawing: &Drawing) -> Option<Animation> {
    let run = &motion.evidence.run;
    let expressions: Vec<Expr> = drawing
        .elements
        .iter()
        .flat_map(|e| e.shape.expressions())
        .collect();
    let along = |run: &Run| -> Option<Vec<Vec<f64>>> {
        let parts = (&study.system, &study.prepared.terms, &motion.binding);
        let mut observer = Observer::new(parts.0, parts.1, parts.2, &expressions).ok()?;
        Some(observer.along(run))
    };
    let mut elements = Vec::new();
    if let Some(found) = motion.extremum().filter(|found| !found.run.is_empty()) {
        let series = along(&found.run)?;
        let moving = |shape: &Drawn| {
            matches!(
                shape,
                Drawn::Trail { .. }
                    | Drawn::Polyline { .. }
                    | Drawn::Point { .. }
                    | Drawn::Sphere { .. }
                    | Drawn::Wheel { .. }
                    | Drawn::Blade { .. }
            )
        };
        let drawn = drawn(&drawing.elements, &series, run.len());
        elements.extend(
            drawn
                .into_iter()
                .zip(&drawing.elements)
                .filter(|(_, stated)| moving(&stated.shape))
                .enumerate()
                .map(|(place, (element, _))| Element {
                    name: match place {
                        0 => "constrained extremum".into(),
                        _ => String::new(),
                    },
                    tint: Tint::Teal,
                    ..element
                }),
        );
    }
    elements.extend(drawn(&drawing.elements, &along(run)?, run.len()));
    Some(pictured(drawing, run.times.clone(), elements))
}

/// A moving picture with the frame that the drawing states.
pub(super) fn pictured(drawing: &Drawing, times: Vec<f64>, elements: Vec<Element>) -> Animation {
    Animation {
        spatial: drawing.spatial,
        times,
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
    }
}

/// Elements with their values at so many rows; a run that ended earlier stays where it ended.
pub(super) fn drawn(stated: &[Stated], series: &[Vec<f64>], rows: usize) -> Vec<Element> {
    let mut start = 0;
    let mut elements = Vec::new();
    for element in stated {
        let width = element.shape.expressions().len();
        let columns = &series[start..start + width];
        start += width;
        let value = |c: &Vec<f64>, j: usize| c.get(j).or(c.last()).copied().unwrap_or(f64::NAN);
        elements.push(Element {
            name: element.name.clone(),
            shape: shape(&element.shape),
            tint: tint(&element.color),
            values: (0..rows)
                .flat_map(|j| columns.iter().map(move |c| value(c, j)))
                .collect(),
        });
    }
    elements
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
