//! Contacts of balls with curved surfaces.
//!
//! With the unit normal n at the point of contact, which points to the ball, the middle c of the ball moves with c' and the body turns with ω against the
//! surface; the point that touches has the velocity c' − r ω × n. The middle lies on the parallel surface at the distance r: of a sphere or cylinder with
//! the radius R that is one with the radius R ± r, and n = ±c/(R ± r). Of a surface z = h(u, w) the point of contact (u, w, h) has two coordinates
//! of its own, and c = (u, w, h) + r n (H. R. Hertz, Principles of Mechanics, 1894; R. M. Murray, Z. Li and S. S. Sastry, A Mathematical
//! Introduction to Robotic Manipulation, 1994, § 5.6).

use chetaev_symbolic::syntax::names;
use chetaev_symbolic::Expr;

use super::algebra::Vector;
use super::lowering::{FrameId, Lowering};
use super::reading::Object;
use super::sections::word;
use super::surfaces::{Figure, SURFACES};
use super::touching::Found;
use super::tree::ContactStated;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::source::Place;

const KEYS: &[&str] = &["shape", "radius", "axis", "inside", "height", "coordinates"];

/// A ball on a surface.
pub(crate) struct Ball {
    pub(crate) body: FrameId,
    pub(crate) plane: FrameId,
    pub(crate) radius: Expr,
    pub(crate) middle: Vector,
}

/// What vanishes, with the end of its name and the direction of its force.
pub(crate) struct Held {
    pub(crate) end: &'static str,
    pub(crate) vanishes: Expr,
    pub(crate) force: Vector,
}

/// A contact with a curved surface.
pub(crate) struct Curved {
    pub(crate) found: Found,
    pub(crate) held: Vec<Held>,
}

impl<'r> Lowering<'r> {
    /// The contact of a ball with the surface that is stated; nothing where it cannot be read, which is reported.
    pub(crate) fn curved(&mut self, contact: &ContactStated<'r>, ball: &Ball) -> Option<Curved> {
        let object = &contact.object;
        let raw = object.get("surface")?;
        let Some(table) = raw.table() else {
            let wanted = "a table, as in { shape = \"sphere\", radius = 1, inside = true }";
            self.wrong_kind(raw, &format!("the surface of {}", object.words()), wanted);
            return None;
        };
        let stated = Object { table, ..*object };
        self.known_keys(&stated, KEYS);
        let middle = self.point(ball.plane, ball.body, ball.middle);
        let name = object.name().to_owned();
        let middle = self.name_vector(&format!("{name}_middle"), middle, object.place);
        if table.get("height").is_some() {
            return self.over_plane(&stated, ball, middle);
        }
        let surface = self.choice(&stated, "shape", SURFACES, |own| own.word);
        let Some(surface) = surface else {
            if table.get("shape").is_none() {
                let message = format!(
                    "the surface of {} needs its `shape`, or its `height`",
                    object.words()
                );
                self.error("missing-value", raw.place, message);
            }
            return None;
        };
        let figure = self.surface_figure(&stated)?;
        let a = &self.algebra;
        let reach = figure.reach(a, ball.radius);
        let away = (surface.away)(a, &figure, middle);
        let outward = away.map(|e| a.graph.div(e, reach));
        let normal = figure.towards(a, outward);
        // Half of (c² − ρ²)/ρ has the unit normal as its gradient where it vanishes.
        let excess = a.graph.sub(a.dot(away, away), a.graph.powi(reach, 2));
        let double = a.graph.mul(&[a.graph.integer(2), reach]);
        let height = a.graph.div(excess, double);
        let height = if figure.is_inside {
            a.graph.neg(height)
        } else {
            height
        };
        self.assume_positive(reach, raw.place);
        let found = self.slip_on(&name, ball, middle, normal, object.place);
        let held = vec![Held {
            end: "touch",
            vanishes: height,
            force: normal,
        }];
        Some(Curved { found, held })
    }

    fn surface_figure(&mut self, stated: &Object<'r>) -> Option<Figure> {
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
        let up = self.up_vector();
        let level = self.level();
        let a = &self.algebra;
        let velocity = middle.map(|e| a.rate(e));
        let arm = a.times(a.graph.neg(ball.radius), normal);
        let slip = a.plus(velocity, a.cross(omega, arm));
        let below = a.graph.add(&[a.graph.one(), a.dot(normal, up)]);
        let tangent = |axis: usize| -> Vector {
            let share = a.graph.div(normal[axis], below);
            let turned = a.minus(a.unit(axis), a.times(share, normal));
            a.minus(turned, a.times(share, up))
        };
        let directions = [tangent(level[0]), tangent(level[1]), normal];
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

    /// The axes that are level.
    fn level(&self) -> [usize; 2] {
        match self.up.axis {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }

    /// A surface of heights: the point of contact has coordinates of its own, and the middle of the ball is given by three constraints.
    fn over_plane(&mut self, stated: &Object<'r>, ball: &Ball, middle: Vector) -> Option<Curved> {
        let name = stated.name().to_owned();
        let place = stated.place;
        let [u, w] = self.contact_coordinates(stated)?;
        let height = stated.get("height")?;
        let height = self.height_over(stated, height, [u, w])?;
        let level = self.level();
        let up = self.up_vector();
        let graph = &self.algebra.graph;
        let variables = [u, w].map(|e| graph.as_symbol(e));
        let [Some(u_symbol), Some(w_symbol)] = variables else {
            return None;
        };
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
        });
        let held: Vec<Held> = held.collect();
        let found = self.slip_on(&name, ball, middle, normal, place);
        Some(Curved { found, held })
    }

    /// The two coordinates of the point of contact, named by the user or after the contact.
    fn contact_coordinates(&mut self, stated: &Object<'r>) -> Option<[Expr; 2]> {
        let name = stated.name();
        let mut names = [
            word(format!("{name}_u"), stated.place),
            word(format!("{name}_w"), stated.place),
        ];
        if let Some(raw) = stated.get("coordinates") {
            let items = match &raw.kind {
                Kind::Array(items) => items.iter().filter_map(Raw::expression).collect(),
                _ => Vec::new(),
            };
            let [first, second] = items[..] else {
                self.wrong_kind(raw, "`coordinates` of a surface", "an array of two names");
                return None;
            };
            names = [first.clone(), second.clone()];
        }
        let about = format!("point of contact of {}", stated.words());
        Some(names.map(|name| self.coordinate(&name, "m", about.clone())))
    }

    /// A height as a function of the point of contact, the time and parameters: it is differentiated here, so that all that moves in it must be seen.
    fn height_over(&mut self, stated: &Object<'r>, raw: &Raw, own: [Expr; 2]) -> Option<Expr> {
        let Some(text) = raw.expression() else {
            self.wrong_kind(raw, "`height`", "an expression of the point of contact");
            return None;
        };
        let value = self.read_symbols(text)?;
        let graph = &self.algebra.graph;
        let strange = graph.symbols_in(&[value]).into_iter().find(|&symbol| {
            let name = names::normalized(graph.symbol_name(symbol));
            let is_own = own.contains(&graph.symbol_expr(symbol));
            !is_own && name != "t" && !self.parameters.contains(&name)
        });
        if let Some(strange) = strange {
            let message = format!(
                "the height of {} may depend on the coordinates of its point of contact, the time and parameters, not on `{}`",
                stated.words(),
                graph.symbol_text(strange)
            );
            let problem = Diagnostic::error("not-allowed-here", raw.place, message);
            let hint = "name these coordinates by `coordinates = [\"u\", \"w\"]` of the surface";
            self.problems.push(problem.hint(hint));
            return None;
        }
        Some(value)
    }
}
