//! Velocities, axes and positions of frames, each from those of the frame before it.
//!
//! ω and v are kept in the axes of the frame itself: a shift by d adds ω × d + d', a turn by α about a turns the
//! components and adds a α' (E. T. Whittaker, Analytical Dynamics, 1937, §§ 14, 17).

use super::algebra::Vector;
use super::lowering::{Frame, FrameId, Lowering, Rates, Step, GROUND};
use crate::source::Place;

impl Lowering<'_> {
    // ---- making frames

    /// The frame after a step; steps of one kind that follow each other are one.
    pub(crate) fn step(&mut self, from: FrameId, step: Step, name: &str, place: Place) -> FrameId {
        let graph = &self.algebra.graph;
        let before = &self.frames[from];
        let (parent, step) = match (before.step, step) {
            _ if before.is_kept => (from, step),
            (Step::Shift(a), Step::Shift(b)) => {
                (before.parent, Step::Shift(self.algebra.plus(a, b)))
            }
            (Step::Turn(a), Step::Turn(mut b)) if a.axis == b.axis => {
                b.angle = graph.add(&[a.angle, b.angle]);
                (before.parent, Step::Turn(b))
            }
            _ => (from, step),
        };
        let is_idle = match step {
            Step::Shift(v) => self.algebra.is_zero(v),
            Step::Turn(turn) => graph.is_zero(turn.angle),
            Step::Ground => true,
        };
        if is_idle {
            return parent;
        }
        self.add(parent, step, name, place)
    }

    /// A frame of its own, whatever the step is.
    pub(crate) fn add(&mut self, parent: FrameId, step: Step, name: &str, place: Place) -> FrameId {
        self.frames.push(Frame {
            parent,
            step,
            name: name.to_owned(),
            place,
            is_kept: false,
        });
        self.frames.len() - 1
    }

    // ---- from frame to frame

    /// The frames below `base` down to `frame`; nothing where `frame` is not below it.
    pub(crate) fn path(&self, base: FrameId, frame: FrameId) -> Option<Vec<FrameId>> {
        let mut path = Vec::new();
        let mut at = frame;
        while at != base {
            if at == GROUND {
                return None;
            }
            path.push(at);
            at = self.frames[at].parent;
        }
        path.reverse();
        Some(path)
    }

    /// How a quantity of a frame against another is called.
    fn called(&self, base: FrameId, frame: FrameId, what: &str) -> String {
        let name = &self.frames[frame].name;
        match base {
            GROUND => format!("{name}_{what}"),
            _ => format!("{name}_in_{}_{what}", self.frames[base].name),
        }
    }

    /// ω and v of a frame against a frame that carries it.
    pub(crate) fn rates(&mut self, base: FrameId, frame: FrameId) -> Rates {
        let still = Rates {
            omega: self.algebra.zero(),
            velocity: self.algebra.zero(),
        };
        let mut now = still;
        for at in self.path(base, frame).unwrap_or_default() {
            if let Some(known) = self.rates.get(&(base, at)) {
                now = *known;
                continue;
            }
            let a = &self.algebra;
            now = match self.frames[at].step {
                Step::Ground => now,
                Step::Shift(d) => {
                    let carried = a.cross(now.omega, d);
                    let own = d.map(|component| a.rate(component));
                    let velocity = a.plus(now.velocity, a.plus(carried, own));
                    Rates { velocity, ..now }
                }
                Step::Turn(turn) => {
                    let spin = a.times(a.rate(turn.angle), a.unit(turn.axis));
                    Rates {
                        omega: a.plus(a.after(turn, now.omega), spin),
                        velocity: a.after(turn, now.velocity),
                    }
                }
            };
            let place = self.frames[at].place;
            let omega = self.called(base, at, "omega");
            let velocity = self.called(base, at, "v");
            now = Rates {
                omega: self.name_vector(&omega, now.omega, place),
                velocity: self.name_vector(&velocity, now.velocity, place),
            };
            self.rates.insert((base, at), now);
        }
        now
    }

    /// Row i: the axis i of `base` in the axes of `frame`. Together they are the rotation matrix from `frame` to `base`.
    pub(crate) fn axes(&mut self, base: FrameId, frame: FrameId) -> [Vector; 3] {
        let mut now = [0, 1, 2].map(|i| self.algebra.unit(i));
        for at in self.path(base, frame).unwrap_or_default() {
            if let Some(known) = self.axes.get(&(base, at)) {
                now = *known;
                continue;
            }
            if let Step::Turn(turn) = self.frames[at].step {
                now = now.map(|row| self.algebra.after(turn, row));
                let place = self.frames[at].place;
                for (row, end) in ["X", "Y", "Z"].iter().enumerate() {
                    let wanted = self.called(base, at, end);
                    now[row] = self.name_vector(&wanted, now[row], place);
                }
            }
            self.axes.insert((base, at), now);
        }
        now
    }

    /// Where the origin of `frame` is, in the axes of `base`.
    pub(crate) fn position(&mut self, base: FrameId, frame: FrameId) -> Vector {
        let mut now = self.algebra.zero();
        for at in self.path(base, frame).unwrap_or_default() {
            if let Some(known) = self.positions.get(&(base, at)) {
                now = *known;
                continue;
            }
            if let Step::Shift(d) = self.frames[at].step {
                let moved = self.in_base(base, at, d);
                let wanted = self.called(base, at, "p");
                let place = self.frames[at].place;
                now = self.name_vector(&wanted, self.algebra.plus(now, moved), place);
            }
            self.positions.insert((base, at), now);
        }
        now
    }

    /// The components along the axes of `base` of a vector given in the axes of `frame`.
    pub(crate) fn in_base(&mut self, base: FrameId, frame: FrameId, v: Vector) -> Vector {
        self.axes(base, frame).map(|row| self.algebra.dot(row, v))
    }

    /// Where a point of `frame` is, in the axes of `base`.
    pub(crate) fn point(&mut self, base: FrameId, frame: FrameId, d: Vector) -> Vector {
        let origin = self.position(base, frame);
        let moved = self.in_base(base, frame, d);
        self.algebra.plus(origin, moved)
    }

    // ---- frames that do not spin along

    /// The frame before those turns that leave a point where it is, with the point in its axes.
    pub(crate) fn unturned(&self, mut frame: FrameId, point: Vector) -> FrameId {
        while let Step::Turn(turn) = self.frames[frame].step {
            if !self.algebra.is_along(point, turn.axis) {
                break;
            }
            frame = self.frames[frame].parent;
        }
        frame
    }

    /// The frame before the last turns of those that leave a figure as it looks, which `is_same` names by their axes.
    pub(crate) fn unspun(&self, frame: FrameId, is_same: impl Fn(usize) -> bool) -> FrameId {
        let mut at = frame;
        while let Step::Shift(_) = self.frames[at].step {
            at = self.frames[at].parent;
        }
        let turned = at;
        while let Step::Turn(turn) = self.frames[at].step {
            if !is_same(turn.axis) {
                break;
            }
            at = self.frames[at].parent;
        }
        if at == turned {
            frame
        } else {
            at
        }
    }

    /// The angular velocity of `frame` against `base`, in the axes of a frame between them.
    pub(crate) fn omega_in(&mut self, base: FrameId, between: FrameId, frame: FrameId) -> Vector {
        let mut own = self.algebra.zero();
        for at in self
            .path(between, frame)
            .unwrap_or_default()
            .into_iter()
            .rev()
        {
            if let Step::Turn(turn) = self.frames[at].step {
                let a = &self.algebra;
                let spin = a.times(a.rate(turn.angle), a.unit(turn.axis));
                own = a.plus(a.before(turn, own), spin);
            }
        }
        let carried = self.rates(base, between).omega;
        self.algebra.plus(carried, own)
    }
}
