//! Still pictures and films of a scene, drawn as the page draws it: SVG, PNG, GIF.

mod camera;
mod marks;
mod raster;
mod svg;

use crate::scene::Animation;
use marks::marks;

/// How a scene is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Width in pixels; at most [`LARGEST`].
    pub width: u32,
    /// The greatest height; a flat scene takes less.
    pub height: u32,
    /// The time that is shown; the end where there is none.
    pub time: Option<f64>,
    /// Pictures of the bodies at so many earlier times, drawn faintly.
    pub ghosts: usize,
}

/// Pixels of a side.
pub const LARGEST: u32 = 8192;

impl Default for View {
    fn default() -> View {
        View {
            width: 960,
            height: 540,
            time: None,
            ghosts: 0,
        }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PictureError {
    /// The scene has no frame.
    Empty,
    /// Numbers of an element are missing, or more than its frames have.
    Numbers {
        /// The name of the element, or its place.
        element: String,
    },
    /// The size is zero or larger than [`LARGEST`].
    Size {
        /// Width.
        width: u32,
        /// Height.
        height: u32,
    },
    /// A time at which nothing is known.
    Time {
        /// As asked.
        time: f64,
        /// The first of the scene.
        first: f64,
        /// The last.
        last: f64,
    },
    /// The encoder of the file failed.
    Encoding(String),
}

impl std::fmt::Display for PictureError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            PictureError::Empty => write!(f, "the scene has no frames"),
            PictureError::Numbers { element } => {
                write!(f, "element {element} does not have the numbers of each frame")
            }
            PictureError::Size { width, height } => write!(
                f,
                "a picture of {width} by {height} pixels cannot be drawn: sides are from 1 to {LARGEST}"
            ),
            PictureError::Time { time, first, last } => write!(
                f,
                "nothing is known at t = {time}: the scene goes from t = {first} to {last}"
            ),
            PictureError::Encoding(problem) => write!(f, "the picture was not encoded: {problem}"),
        }
    }
}

impl std::error::Error for PictureError {}

/// One picture as an SVG document.
///
/// # Errors
/// [`PictureError`] where the scene or the size is not possible.
pub fn svg(scene: &Animation, view: &View) -> Result<String, PictureError> {
    check(scene, view)?;
    let height = camera::height(scene, view);
    Ok(svg::document(
        &marks(scene, view, height),
        [view.width, height],
        scene.description.as_deref(),
    ))
}

/// One picture as a PNG file, without its labels.
///
/// # Errors
/// [`PictureError`].
pub fn png(scene: &Animation, view: &View) -> Result<Vec<u8>, PictureError> {
    check(scene, view)?;
    let height = camera::height(scene, view);
    raster::png(&marks(scene, view, height), [view.width, height])
}

/// The whole motion as a GIF file of so many seconds, repeated without end.
///
/// # Errors
/// [`PictureError`].
pub fn gif(scene: &Animation, view: &View, seconds: f64) -> Result<Vec<u8>, PictureError> {
    film(scene, view, seconds, &mut |_| {})
}

/// The same; `tell` hears before each frame which part of the film is drawn, in [0, 1].
///
/// # Errors
/// [`PictureError`].
pub fn film(
    scene: &Animation,
    view: &View,
    seconds: f64,
    tell: &mut dyn FnMut(f64),
) -> Result<Vec<u8>, PictureError> {
    check(scene, view)?;
    let (Some(first), Some(last)) = (scene.times.first(), scene.times.last()) else {
        return Err(PictureError::Empty);
    };
    let height = camera::height(scene, view);
    let count = ((seconds * raster::RATE).round() as usize).clamp(2, 1500);
    let frames = (0..count).map(|frame| {
        let part = frame as f64 / (count - 1) as f64;
        tell(part);
        let view = View {
            time: Some(first + (last - first) * part),
            ..*view
        };
        marks(scene, &view, height)
    });
    raster::gif(frames, [view.width, height])
}

fn check(scene: &Animation, view: &View) -> Result<(), PictureError> {
    let is_possible = |side: u32| (1..=LARGEST).contains(&side);
    if !is_possible(view.width) || !is_possible(view.height) {
        return Err(PictureError::Size {
            width: view.width,
            height: view.height,
        });
    }
    let (Some(&first), Some(&last)) = (scene.times.first(), scene.times.last()) else {
        return Err(PictureError::Empty);
    };
    let is_known = |time: f64| (first.min(last)..=first.max(last)).contains(&time);
    if let Some(time) = view.time.filter(|&time| !is_known(time)) {
        return Err(PictureError::Time { time, first, last });
    }
    for (place, element) in scene.elements.iter().enumerate() {
        let expected = element.shape.stride(scene.spatial) * scene.times.len();
        if element.values.len() != expected {
            return Err(PictureError::Numbers {
                element: if element.name.is_empty() {
                    (place + 1).to_string()
                } else {
                    element.name.clone()
                },
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{gif, png, svg, PictureError, View};
    use crate::scene::{Animation, Element, Shape, Tint};

    /// A point that runs along the first axis from 0 to 10 while a wheel turns at the origin.
    fn scene() -> Animation {
        let times: Vec<f64> = (0..=10).map(f64::from).collect();
        Animation {
            elements: vec![
                Element {
                    shape: Shape::Trail,
                    values: times.iter().flat_map(|t| [*t, 0.0]).collect(),
                    ..Element::default()
                },
                Element {
                    shape: Shape::Point,
                    tint: Tint::Red,
                    values: times.iter().flat_map(|t| [*t, 0.0]).collect(),
                    ..Element::default()
                },
                Element {
                    shape: Shape::Wheel,
                    values: times.iter().flat_map(|t| [0.0, 0.0, 1.0, *t]).collect(),
                    ..Element::default()
                },
            ],
            times,
            ..Animation::default()
        }
    }

    /// The box from −1 to 10 fills the width but for a margin of 35 pixels at each side: a length is (960 − 70)/11 pixels.
    #[test]
    fn the_picture_is_filled_and_shows_the_time_asked_for() {
        let at = |time| {
            let view = View {
                time: Some(time),
                ..View::default()
            };
            let text = svg(&scene(), &view).unwrap_or_default();
            let (_, rest) = text.split_once("class=\"red\"").unwrap_or_default();
            let (_, rest) = rest.split_once("cx=\"").unwrap_or_default();
            let (place, _) = rest.split_once('"').unwrap_or_default();
            place.parse::<f64>().unwrap_or(f64::NAN)
        };
        let scale = 890.0 / 11.0;
        assert!((at(10.0) - 925.0).abs() < 0.1, "{}", at(10.0));
        assert!((at(2.5) - (35.0 + 3.5 * scale)).abs() < 0.1, "{}", at(2.5));
        // A scene of 11 by 2 lengths is as high as it needs.
        let text = svg(&scene(), &View::default()).unwrap_or_default();
        assert!(text.contains("height=\"232\""), "{}", &text[..200]);
    }

    #[test]
    fn files_are_what_they_are_said_to_be() {
        let view = View {
            width: 120,
            height: 90,
            ..View::default()
        };
        let still = png(&scene(), &view).unwrap_or_default();
        assert!(still.starts_with(b"\x89PNG\r\n"), "{} bytes", still.len());
        let film = gif(&scene(), &view, 1.0).unwrap_or_default();
        assert!(film.starts_with(b"GIF89a") && film.len() > 1000);
        assert_eq!(film.last(), Some(&0x3b));
    }

    #[test]
    fn times_outside_of_the_scene_are_refused() {
        for time in [11.0, -0.5, f64::NAN] {
            let view = View {
                time: Some(time),
                ..View::default()
            };
            let refused = svg(&scene(), &view);
            assert!(
                matches!(
                    refused,
                    Err(PictureError::Time {
                        first: 0.0,
                        last: 10.0,
                        ..
                    })
                ),
                "{refused:?}"
            );
        }
    }

    #[test]
    fn scenes_with_missing_numbers_are_refused() {
        let mut wrong = scene();
        wrong.elements[1].values.pop();
        let refused = svg(&wrong, &View::default());
        let element = "2".to_owned();
        assert_eq!(refused, Err(PictureError::Numbers { element }));
        let view = View {
            width: 0,
            ..View::default()
        };
        assert!(matches!(
            svg(&scene(), &view),
            Err(PictureError::Size { .. })
        ));
        assert_eq!(
            svg(&Animation::default(), &View::default()),
            Err(PictureError::Empty)
        );
    }
}
