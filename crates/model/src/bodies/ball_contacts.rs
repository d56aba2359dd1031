//! Contacts of balls with curved surfaces.
//!
//! With the unit normal n at the point of contact, which points to the ball, the middle c of the ball moves with c' and the body turns with ω against the
//! surface; the point that touches has the velocity c' − r ω × n. The middle lies on the parallel surface at the distance r: of a sphere or cylinder with
//! the radius R that is one with the radius R ± r, and n = ±c/(R ± r). Of a surface z = h(u, w) the point of contact (u, w, h) has two coordinates
//! of its own, and c = (u, w, h) + r n (H. R. Hertz, Principles of Mechanics, 1894; R. M. Murray, Z. Li and S. S. Sastry, A Mathematical
//! Introduction to Robotic Manipulation, 1994, § 5.6).

use chetaev_symbolic::Expr;

use super::algebra::Vector;
use super::figures::{Curved, Found, Held};
use super::grounds::Ground;
use super::lowering::{FrameId, Lowering};
use super::reading::Object;
use super::surfaces::{Away, Figure};
use super::tree::ContactStated;
use crate::raw::Kind;
use crate::source::Place;

/// A ball on a surface.
pub(crate) struct Ball {
    pub(crate) body: FrameId,
    pub(crate) plane: FrameId,
    pub(crate) radius: Expr,
    pub(crate) middle: Vector,
}

impl<'r> Lowering<'r> {
    /// The middle of a ball, with names for its components.
    fn ball_middle(&mut self, object: &Object<'r>, ball: &Ball) -> Vector {
        let middle = self.point(ball.plane, ball.body, ball.middle);
        self.name_vector(&format!("{}_middle", object.name()), middle, object.place)
    }

    /// The contact of a ball with a sphere or a cylinder.
    pub(crate) fn ball_on_round(
        &mut self,
        contact: &ContactStated<'r>,
        ball: &Ball,
        own_away: Away,
        figure: &Figure,
    ) -> Curved {
        let object = &contact.object;
        let name = object.name().to_owned();
        let middle = self.ball_middle(object, ball);
        let a = &self.algebra;
        let reach = figure.reach(a, ball.radius);
        let away = own_away(a, figure, middle);
        let outward = away.map(|e| a.graph.div(e, reach));
        let normal = figure.towards(a, outward);
        let height = figure.height(a, away, reach);
        let place = object.get("surface").map_or(object.place, |raw| raw.place);
        self.assume_positive(reach, place);
        let found = self.slip_on(&name, ball, middle, normal, object.place);
        let held = vec![Held {
            end: "touch",
            vanishes: height,
            force: normal,
            torque: self.algebra.zero(),
        }];
        Curved { found, held }
    }

    pub(crate) fn surface_figure(&mut self, stated: &Object<'r>) -> Option<Figure> {
        let Some(radius) = stated.get("radius") else {
            let message = format!("the surface of {} needs its `radius`", stated.words());
            self.error("missing-value", stated.place, message);
            return None;
        };
        let radius = self.number(&stated.slot("surface_radius", "m"), radius)?;
        let axis = match self.word(stated, "axis") {
            Some(text) => self.axis_of(text)?.0,
            None => 2,
        };
        let is_inside = match stated.get("inside").map(|raw| (&raw.kind, raw)) {
            None => false,
            Some((Kind::Truth(inside), _)) => *inside,
            Some((_, raw)) => {
                self.wrong_kind(raw, "`inside`", "true or false");
                return None;
            }
        };
        Some(Figure {
            radius,
            axis,
            is_inside,
        })
    }

    /// The velocity of the point that touches, along two unit tangents, which are the first two axes turned with the third into the normal.
    fn slip_on(
        &mut self,
        name: &str,
        ball: &Ball,
        middle: Vector,
        normal: Vector,
        place: Place,
    ) -> Found {
        let normal = self.name_vector(&format!("{name}_normal"), normal, place);
        let rates = self.rates(ball.plane, ball.body);
        let omega = self.in_base(ball.plane, ball.body, rates.omega);
        let [forward, side] = self.level_tangents(normal);
        let a = &self.algebra;
        let velocity = middle.map(|e| a.rate(e));
        let arm = a.times(a.graph.neg(ball.radius), normal);
        let slip = a.plus(velocity, a.cross(omega, arm));
        let directions = [forward, side, normal];
        let velocities = [
            a.dot(slip, directions[0]),
            a.dot(slip, directions[1]),
            a.dot(omega, normal),
        ];
        Found {
            velocities,
            height: a.graph.zero(),
            axes: ball.plane,
            point: a.plus(middle, arm),
            directions,
        }
    }

    /// Two unit tangents: the level axes, turned with the vertical into the normal.
    pub(crate) fn level_tangents(&self, normal: Vector) -> [Vector; 2] {
        let up = self.up_vector();
        let a = &self.algebra;
        let below = a.graph.add(&[a.graph.one(), a.dot(normal, up)]);
        self.level().map(|axis| {
            let share = a.graph.div(normal[axis], below);
            let turned = a.minus(a.unit(axis), a.times(share, normal));
            a.minus(turned, a.times(share, up))
        })
    }

    /// The axes that are level.
    pub(crate) fn level(&self) -> [usize; 2] {
        match self.up.axis {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }

    /// A surface of heights: the point of contact has coordinates of its own, and the middle of the ball is given by three constraints.
    pub(crate) fn ball_on_heights(
        &mut self,
        contact: &ContactStated<'r>,
        ball: &Ball,
        ground: &Ground,
    ) -> Option<Curved> {
        let Ground::Heights {
            height,
            variables: [u_symbol, w_symbol],
            names,
        } = ground
        else {
            return None;
        };
        let object = &contact.object;
        let (name, place) = (object.name().to_owned(), object.place);
        let middle = self.ball_middle(object, ball);
        let (height, u_symbol, w_symbol) = (*height, *u_symbol, *w_symbol);
        let about = format!("point of contact of {}", object.words());
        let [u, w] = [0, 1].map(|i| self.coordinate(&names[i], "m", about.clone()));
        let level = self.level();
        let up = self.up_vector();
        let graph = &self.algebra.graph;
        let slopes = graph.gradient(height, &[u_symbol, w_symbol]);
        let a = &self.algebra;
        let mut steep = up;
        steep[level[0]] = a.graph.neg(slopes[0]);
        steep[level[1]] = a.graph.neg(slopes[1]);
        let length = a.graph.sqrt(a.dot(steep, steep));
        let length = self.name(&format!("{name}_steepness"), length, place);
        let a = &self.algebra;
        let normal = steep.map(|e| a.graph.div(e, length));
        let mut point = a.times(height, up);
        point[level[0]] = u;
        point[level[1]] = w;
        let own = a.plus(point, a.times(ball.radius, normal));
        let apart = a.minus(middle, own);
        let ends = ["touch_x", "touch_y", "touch_z"];
        let held = (0..3).map(|axis| Held {
            end: ends[axis],
            vanishes: apart[axis],
            force: a.unit(axis),
            torque: a.zero(),
        });
        let held: Vec<Held> = held.collect();
        let found = self.slip_on(&name, ball, middle, normal, place);
        Some(Curved { found, held })
    }
}
