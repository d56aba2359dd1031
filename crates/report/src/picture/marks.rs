//! A scene at a time as lines, discs and words of a picture, the furthest back first.

use super::camera::{hull, Camera};
use super::View;
use crate::scene::{Animation, Element, Shape, Tint};

/// One thing that is painted.
pub(super) enum Mark {
    /// A broken line, filled where `fill` is positive.
    Line {
        points: Vec<[f64; 2]>,
        close: bool,
        /// Opacity of the inside.
        fill: f64,
        width: f64,
        alpha: f64,
        tint: Tint,
    },
    /// A disc.
    Disc {
        at: [f64; 2],
        radius: f64,
        alpha: f64,
        tint: Tint,
    },
    /// Words beside a point.
    Words {
        at: [f64; 2],
        text: String,
        tint: Tint,
    },
}

/// Everything that is painted of a scene.
pub(super) fn marks(scene: &Animation, view: &View, height: u32) -> Vec<Mark> {
    let size = [f64::from(view.width), f64::from(height)];
    let first = scene.times.first().copied().unwrap_or(0.0);
    let last = scene.times.last().copied().unwrap_or(0.0);
    let time = view
        .time
        .unwrap_or(last)
        .clamp(first.min(last), last.max(first));
    let mut painter = Painter {
        scene,
        camera: Camera::new(scene, size),
        fade: 1.0,
        marks: Vec::new(),
    };
    painter.trails(time);
    for ghost in 0..view.ghosts {
        painter.fade = 0.22;
        painter.bodies(first + (time - first) * ghost as f64 / view.ghosts as f64);
    }
    painter.fade = 1.0;
    painter.bodies(time);
    painter.labels(time);
    painter.marks
}

struct Painter<'a> {
    scene: &'a Animation,
    camera: Camera,
    fade: f64,
    marks: Vec<Mark>,
}

impl Painter<'_> {
    fn dimension(&self) -> usize {
        if self.scene.spatial {
            3
        } else {
            2
        }
    }

    /// The numbers of an element at a time, between two frames in proportion; `None` where it is not drawn.
    fn at(&self, element: &Element, time: f64) -> Option<Vec<f64>> {
        let times = &self.scene.times;
        let stride = element.shape.stride(self.scene.spatial);
        let next = times
            .partition_point(|t| *t < time)
            .clamp(1, times.len().max(2) - 1);
        let next = next.min(times.len() - 1);
        let here = next.saturating_sub(1);
        let span = times[next] - times[here];
        let part = if span > 0.0 {
            ((time - times[here]) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let row = |frame: usize| &element.values[frame * stride..(frame + 1) * stride];
        let mixed = row(here).iter().zip(row(next));
        let values: Vec<f64> = mixed
            .map(|(a, b)| if part == 0.0 { *a } else { a + (b - a) * part })
            .collect();
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    /// The paths: the whole faintly, what was run in full.
    fn trails(&mut self, time: f64) {
        let scene = self.scene;
        let d = self.dimension();
        for element in &scene.elements {
            if element.shape != Shape::Trail {
                continue;
            }
            let all = || scene.times.iter().zip(element.values.chunks_exact(d));
            let whole: Vec<&[f64]> = all().map(|(_, p)| p).collect();
            let mut past: Vec<Vec<f64>> = all()
                .filter(|(t, _)| **t <= time)
                .map(|(_, p)| p.to_vec())
                .collect();
            past.extend(self.at(element, time));
            let past: Vec<&[f64]> = past.iter().map(Vec::as_slice).collect();
            let faint = Pen {
                width: 1.2,
                alpha: 0.28,
                ..Pen::of(element)
            };
            self.line(&whole, &faint);
            let full = Pen {
                width: 1.8,
                alpha: 0.9,
                ..Pen::of(element)
            };
            self.line(&past, &full);
        }
    }

    /// Everything but paths and words.
    fn bodies(&mut self, time: f64) {
        let scene = self.scene;
        let d = self.dimension();
        let is_body = |e: &&Element| !matches!(e.shape, Shape::Trail | Shape::Label { .. });
        // What does not move needs no ghost.
        let is_shown = |e: &&Element| self.fade == 1.0 || e.tint != Tint::Muted;
        let elements = scene.elements.iter().filter(is_body).filter(is_shown);
        let mut placed: Vec<(f64, &Element, Vec<f64>)> = elements
            .filter_map(|element| {
                let values = self.at(element, time)?;
                let points = hull(element, &values, d);
                let depths = points.iter().map(|p| self.camera.depth(p));
                let depth = depths.sum::<f64>() / points.len().max(1) as f64;
                Some((depth, element, values))
            })
            .collect();
        if scene.spatial {
            placed.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        }
        for (_, element, values) in placed {
            self.body(element, &values);
        }
    }

    fn labels(&mut self, time: f64) {
        let scene = self.scene;
        for element in &scene.elements {
            let Shape::Label { text } = &element.shape else {
                continue;
            };
            if let Some(values) = self.at(element, time) {
                let [x, y] = self.camera.to(&values);
                self.marks.push(Mark::Words {
                    at: [x + 8.0, y - 8.0],
                    text: text.clone(),
                    tint: element.tint,
                });
            }
        }
    }

    fn body(&mut self, element: &Element, v: &[f64]) {
        let d = self.dimension();
        let pen = Pen::of(element);
        let (a, rest) = v.split_at(d);
        match &element.shape {
            Shape::Point => self.disc(a, 4.5, element.tint),
            Shape::Segment => self.line(&[a, rest], &pen),
            Shape::Arrow => self.arrow(a, rest, &pen),
            Shape::Circle => {
                let (axis, radius) = rest.split_at(rest.len() - 1);
                let ring = self.ring(a, axis, radius[0]);
                self.ring_line(&ring, &pen);
            }
            Shape::Sphere => {
                let radius = rest[0] * self.camera.scale;
                let at = self.camera.to(a);
                self.marks.push(Mark::Disc {
                    at,
                    radius,
                    alpha: 0.55 * self.fade,
                    tint: element.tint,
                });
            }
            Shape::Wheel => {
                let (axis, numbers) = rest.split_at(rest.len() - 2);
                let ring = self.ring(a, axis, numbers[0]);
                let pen = Pen {
                    width: 2.5,
                    fill: 0.16,
                    ..pen
                };
                self.ring_line(&ring, &pen);
                let end = ring.on(numbers[1]);
                self.line(&[a, &end], &Pen { fill: 0.0, ..pen });
                self.disc(a, 3.0, element.tint);
            }
            Shape::Blade => {
                let (direction, length) = rest.split_at(rest.len() - 1);
                let along = if self.scene.spatial {
                    unit(direction)
                } else {
                    vec![direction[0].cos(), direction[0].sin()]
                };
                let end = |sign: f64| plus(a, &along, sign * length[0] / 2.0);
                let pen = Pen { width: 5.0, ..pen };
                self.line(&[&end(-1.0), &end(1.0)], &pen);
            }
            Shape::Polyline { closed, filled, .. } => {
                let points: Vec<&[f64]> = v.chunks_exact(d).collect();
                let pen = Pen {
                    close: *closed,
                    fill: if *filled { 0.18 } else { 0.0 },
                    ..pen
                };
                self.line(&points, &pen);
            }
            Shape::Trail | Shape::Label { .. } => {}
        }
    }

    fn disc(&mut self, at: &[f64], radius: f64, tint: Tint) {
        let at = self.camera.to(at);
        self.marks.push(Mark::Disc {
            at,
            radius,
            alpha: self.fade,
            tint,
        });
    }

    fn line(&mut self, points: &[&[f64]], pen: &Pen) {
        let points: Vec<[f64; 2]> = points.iter().map(|p| self.camera.to(p)).collect();
        self.push(points, pen);
    }

    fn push(&mut self, points: Vec<[f64; 2]>, pen: &Pen) {
        // Points that are not finite leave a gap.
        let pieces = points.split(|p| !p[0].is_finite() || !p[1].is_finite());
        for piece in pieces.filter(|piece| piece.len() > 1) {
            self.marks.push(Mark::Line {
                points: piece.to_vec(),
                close: pen.close,
                fill: pen.fill * self.fade,
                width: pen.width,
                alpha: pen.alpha * self.fade,
                tint: pen.tint,
            });
        }
    }

    fn arrow(&mut self, tail: &[f64], tip: &[f64], pen: &Pen) {
        self.line(&[tail, tip], pen);
        let (a, b) = (self.camera.to(tail), self.camera.to(tip));
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        if length < 2.0 {
            return;
        }
        let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let head = (length / 2.0).min(9.0);
        let side = |sign: f64| {
            [
                b[0] - head * along[0] + sign * head * 0.45 * along[1],
                b[1] - head * along[1] - sign * head * 0.45 * along[0],
            ]
        };
        let pen = Pen {
            close: true,
            fill: 1.0,
            width: 1.0,
            ..*pen
        };
        self.push(vec![b, side(-1.0), side(1.0)], &pen);
    }

    fn ring(&self, center: &[f64], axis: &[f64], radius: f64) -> Ring {
        let (e1, e2) = if self.scene.spatial {
            let n = unit(axis);
            let level = [-n[1], n[0], 0.0];
            let e1 = if level[0].hypot(level[1]) > 1e-9 {
                unit(&level)
            } else {
                vec![1.0, 0.0, 0.0]
            };
            let e2 = cross(&n, &e1);
            (e1, e2)
        } else {
            (vec![1.0, 0.0], vec![0.0, 1.0])
        };
        Ring {
            center: center.to_vec(),
            e1,
            e2,
            radius,
        }
    }

    fn ring_line(&mut self, ring: &Ring, pen: &Pen) {
        let step = std::f64::consts::TAU / 64.0;
        let points: Vec<Vec<f64>> = (0..64).map(|i| ring.on(f64::from(i) * step)).collect();
        let points: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
        self.line(
            &points,
            &Pen {
                close: true,
                ..*pen
            },
        );
    }
}

/// How a line is drawn.
#[derive(Clone, Copy)]
struct Pen {
    close: bool,
    fill: f64,
    width: f64,
    alpha: f64,
    tint: Tint,
}

impl Pen {
    fn of(element: &Element) -> Pen {
        Pen {
            close: false,
            fill: 0.0,
            width: 2.0,
            alpha: 1.0,
            tint: element.tint,
        }
    }
}

/// A circle with the two directions that span it.
struct Ring {
    center: Vec<f64>,
    e1: Vec<f64>,
    e2: Vec<f64>,
    radius: f64,
}

impl Ring {
    fn on(&self, angle: f64) -> Vec<f64> {
        let one = plus(&self.center, &self.e1, self.radius * angle.cos());
        plus(&one, &self.e2, self.radius * angle.sin())
    }
}

fn plus(a: &[f64], b: &[f64], factor: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x + factor * y).collect()
}

fn unit(a: &[f64]) -> Vec<f64> {
    let size = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    let size = if size > 0.0 { size } else { 1.0 };
    a.iter().map(|x| x / size).collect()
}

fn cross(a: &[f64], b: &[f64]) -> Vec<f64> {
    vec![
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
