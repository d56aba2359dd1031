//! Marks as pixels: PNG and GIF. Words need a font and are left to SVG.

use super::marks::Mark;
use super::svg::COLORS;
use super::PictureError;
use crate::scene::Tint;
use gif::{Encoder, Frame, Repeat};
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform,
};

/// Frames of a film in a second.
pub(super) const RATE: f64 = 25.0;

fn encoding(problem: impl std::fmt::Display) -> PictureError {
    PictureError::Encoding(problem.to_string())
}

/// A picture on white.
pub(super) fn png(marks: &[Mark], size: [u32; 2]) -> Result<Vec<u8>, PictureError> {
    painted(marks, size)?.encode_png().map_err(encoding)
}

/// A film on white.
pub(super) fn gif(
    frames: impl Iterator<Item = Vec<Mark>>,
    [width, height]: [u32; 2],
) -> Result<Vec<u8>, PictureError> {
    let side = |size: u32| u16::try_from(size).map_err(encoding);
    let (w, h) = (side(width)?, side(height)?);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, w, h, &palette()).map_err(encoding)?;
    encoder.set_repeat(Repeat::Infinite).map_err(encoding)?;
    for marks in frames {
        let pixels = painted(&marks, [width, height])?;
        let indices: Vec<u8> = pixels
            .pixels()
            .iter()
            .map(|p| nearest([p.red(), p.green(), p.blue()]))
            .collect();
        let frame = Frame {
            delay: (100.0 / RATE) as u16,
            width: w,
            height: h,
            buffer: indices.into(),
            ..Frame::default()
        };
        encoder.write_frame(&frame).map_err(encoding)?;
    }
    drop(encoder);
    Ok(bytes)
}

/// Steps of each of the three colors in the palette of a film.
const STEPS: u32 = 6;

/// All colors of so many steps.
fn palette() -> Vec<u8> {
    let value = |step: u32| (step * 255 / (STEPS - 1)) as u8;
    let mut all = Vec::new();
    for red in 0..STEPS {
        for green in 0..STEPS {
            for blue in 0..STEPS {
                all.extend([value(red), value(green), value(blue)]);
            }
        }
    }
    all
}

fn nearest(color: [u8; 3]) -> u8 {
    let step = |x: u8| (u32::from(x) * (STEPS - 1) + 127) / 255;
    let [red, green, blue] = color.map(step);
    ((red * STEPS + green) * STEPS + blue) as u8
}

fn color(tint: Tint, alpha: f64) -> Color {
    let found = COLORS.iter().find(|(own, ..)| *own == tint);
    let light = found.map_or("#000000", |(_, _, light, _)| light);
    let part = |at: usize| {
        let digits = light.get(at..at + 2).unwrap_or("00");
        u8::from_str_radix(digits, 16).unwrap_or(0)
    };
    let opacity = (alpha.clamp(0.0, 1.0) * 255.0).round() as u8;
    Color::from_rgba8(part(1), part(3), part(5), opacity)
}

fn painted(marks: &[Mark], [width, height]: [u32; 2]) -> Result<Pixmap, PictureError> {
    let mut pixels = Pixmap::new(width, height).ok_or(PictureError::Size { width, height })?;
    pixels.fill(Color::WHITE);
    for mark in marks {
        paint(&mut pixels, mark);
    }
    Ok(pixels)
}

fn ink(tint: Tint, alpha: f64) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    paint.set_color(color(tint, alpha));
    paint
}

fn paint(pixels: &mut Pixmap, mark: &Mark) {
    let here = Transform::identity();
    match mark {
        Mark::Line {
            points,
            close,
            fill,
            width,
            alpha,
            tint,
        } => {
            let mut builder = PathBuilder::new();
            for (place, [x, y]) in points.iter().enumerate() {
                match place {
                    0 => builder.move_to(*x as f32, *y as f32),
                    _ => builder.line_to(*x as f32, *y as f32),
                }
            }
            if *close {
                builder.close();
            }
            let Some(path) = builder.finish() else { return };
            if *fill > 0.0 {
                pixels.fill_path(&path, &ink(*tint, *fill), FillRule::Winding, here, None);
            }
            let stroke = Stroke {
                width: *width as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                ..Stroke::default()
            };
            pixels.stroke_path(&path, &ink(*tint, *alpha), &stroke, here, None);
        }
        Mark::Disc {
            at: [x, y],
            radius,
            alpha,
            tint,
        } => {
            if let Some(path) = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32) {
                pixels.fill_path(&path, &ink(*tint, *alpha), FillRule::Winding, here, None);
            }
        }
        Mark::Words { .. } => {}
    }
}
