//! Contacts of rims, spheres and points with a plane, as constraints.
//!
//! With the normal n, the axle a and the radius r, the lowest point of a rim lies at ρ = −r (n − (n·a) a)/N from its middle,
//! N = |n − (n·a) a|, and the middle is r N above the plane. Its velocity v + ω × ρ is v·(a × n)/N − r ω·a along the rim and
//! v·(a − (a·n) n)/N + r ω·(a × n) across it. A sphere has ρ = −r n; a torus whose
//! tube has the radius t adds −t n to that of the rim; an ellipsoid with the semi-axes D has ρ = −D² n/√(n·D² n), and its middle is as
//! high as that root.

use chetaev_symbolic::Expr;

use super::algebra::Vector;
use super::ball_contacts::Ball;
use super::figures::{Curved, Figure, Found};
use super::grounds::Ground;
use super::lowering::{FrameId, Lowering, GROUND};
use super::objects::KeptReaction;
use super::placing::Built;
use super::reading::Object;
use super::sections::{table, text, word};
use super::shapes::Outline;
use super::tree::{ContactStated, Tree};
use crate::diagnostic::Diagnostic;
use crate::source::Place;

impl<'r> Lowering<'r> {
    /// Writes the constraints of all contacts.
    pub(crate) fn touch_all(&mut self, tree: &Tree<'r>, built: &[Built]) {
        for (number, contact) in tree.contacts.iter().enumerate() {
            let own = built.iter().find(|own| own.contact == number);
            self.touch(contact, own);
        }
    }

    fn touch(&mut self, contact: &ContactStated<'r>, built: Option<&Built>) {
        let (Some(&body), Some(&plane)) =
            (self.placed.get(&contact.body), self.placed.get(&contact.on))
        else {
            return;
        };
        let object = &contact.object;
        if self.path(plane, body).is_none() {
            let message = format!(
                "the body `{}` does not hang on `{}`, whose plane it touches",
                contact.body, contact.on
            );
            self.problems.push(
                Diagnostic::error("not-carried", object.place, message)
                    .hint("count its coordinates from that frame: let the first joint of the tree have it as its parent"),
            );
            return;
        }
        let Some(figure) = self.figure(contact) else {
            return;
        };
        let place = object.place;
        let name = object.name().to_owned();
        let is_own = matches!(figure.outline, Outline::Stated | Outline::Tapered);
        if object.get("surface").is_some() || is_own {
            let curved = self.on_ground(contact, &figure, [plane, body]);
            return self.touch_curved(contact, curved);
        }
        let found = match (figure.outline, built) {
            (Outline::Rim, Some(built)) => self.rim_built(&figure, built, plane, body),
            (Outline::Rim | Outline::Torus, _) => self.rim(&figure, plane, body, &name, place),
            (Outline::Sphere, _) => self.sphere(&figure, plane, body),
            (Outline::Ellipsoid, _) => self.ellipsoid(&figure, plane, body, &name, place),
            _ => self.tip(&figure, plane, body),
        };
        self.hold(contact, &found);
        self.react_normally(contact, &format!("{name}_touch"), &found);
        self.stay(&name, found.height, &object.words(), place);
    }

    /// Where the middle of a ball moves on a surface of the same kind, in closed form; else by where the two figures touch.
    fn on_ground(
        &mut self,
        contact: &ContactStated<'r>,
        figure: &Figure,
        frames: [FrameId; 2],
    ) -> Option<Curved> {
        let ground = self.ground_of(contact)?;
        if let Some(radius) = figure.lengths.first() {
            let object = &contact.object;
            if self.algebra.graph.is_zero(*radius) {
                let message = format!("the radius of {} is zero", object.words());
                let problem = Diagnostic::error("not-allowed-here", object.place, message);
                self.problems
                    .push(problem.hint("a point of the body is stated by `at` alone"));
                return None;
            }
            self.assume_positive(*radius, object.place);
        }
        let [plane, body] = frames;
        let ball = Ball {
            body,
            plane,
            radius: figure
                .lengths
                .first()
                .copied()
                .unwrap_or(self.algebra.graph.zero()),
            middle: figure.middle,
        };
        match ground {
            Ground::Round {
                away, figure: own, ..
            } if figure.outline == Outline::Sphere => {
                Some(self.ball_on_round(contact, &ball, away, &own))
            }
            Ground::Heights { .. } if figure.outline == Outline::Sphere => {
                self.ball_on_heights(contact, &ball, &ground)
            }
            _ => self.tangent(contact, figure, frames, &ground),
        }
    }

    /// On a surface that is no plane, or with a figure of any kind; nothing where it could not be read, which is reported.
    fn touch_curved(&mut self, contact: &ContactStated<'r>, curved: Option<Curved>) {
        let Some(curved) = curved else {
            return;
        };
        self.hold(contact, &curved.found);
        let object = &contact.object;
        for held in curved.held {
            let own = format!("{}_{}", object.name(), held.end);
            let wrench = [held.force, held.torque];
            self.react_by(contact, &own, &curved.found, wrench);
            let about = format!("{} stays on its surface", object.words());
            self.constrain(&own, held.vanishes, about, object.place);
        }
    }

    /// What the kind of contact says of velocities, and friction.
    fn hold(&mut self, contact: &ContactStated<'r>, found: &Found) {
        let object = &contact.object;
        let (name, place) = (object.name(), object.place);
        let angle = match object.get("angle") {
            Some(raw) => self.number(&object.slot("angle", "rad"), raw),
            None => None,
        };
        let angle = angle.unwrap_or(self.algebra.graph.zero());
        let statements = (contact.kind.statements)(&self.algebra, angle);
        for statement in statements {
            let about = format!("{} {}", object.words(), statement.says);
            let vanishes = self.algebra.dot(statement.along, found.velocities);
            let own = format!("{name}{}", statement.suffix);
            self.react(contact, &own, found, statement.along);
            self.constrain(&own, vanishes, about, place);
        }
        self.rub_contact(contact, found);
    }

    /// The reaction of a statement: a force along and across, and a torque about the normal.
    fn react(
        &mut self,
        contact: &ContactStated<'r>,
        constraint: &str,
        found: &Found,
        along: [Expr; 3],
    ) {
        let a = &self.algebra;
        let [forward, side, normal] = found.directions;
        let force = a.plus(a.times(along[0], forward), a.times(along[1], side));
        let torque = a.times(along[2], normal);
        self.react_by(contact, constraint, found, [force, torque]);
    }

    /// The force along the normal.
    fn react_normally(&mut self, contact: &ContactStated<'r>, constraint: &str, found: &Found) {
        let wrench = [found.directions[2], self.algebra.zero()];
        self.react_by(contact, constraint, found, wrench);
    }

    fn react_by(
        &mut self,
        contact: &ContactStated<'r>,
        constraint: &str,
        found: &Found,
        wrench: [Vector; 2],
    ) {
        let [force, torque] = wrench.map(|v| self.in_base(GROUND, found.axes, v));
        let point = self.point(GROUND, found.axes, found.point);
        self.keep_reaction(KeptReaction {
            constraint: constraint.to_owned(),
            object: contact.object.name().to_owned(),
            place: contact.object.place,
            body: contact.body.clone(),
            other: contact.on.clone(),
            force,
            point,
            other_point: point,
            torque,
        });
    }

    /// The lowest point stays on the plane: a constraint, or nothing where its height does not change.
    fn stay(&mut self, name: &str, height: Expr, words: &str, place: Place) {
        let graph = &self.algebra.graph;
        if graph.is_zero(height) {
            return;
        }
        if !self.algebra.is_constant(height) {
            let about = format!("{words} stays on the plane");
            return self.constrain(&format!("{name}_touch"), height, about, place);
        }
        if graph.as_number(height).is_some() {
            let message = format!(
                "{words} does not touch its plane: its lowest point is {} above it",
                graph.text(height)
            );
            return self.error("not-touching", place, message);
        }
        let zero = graph.zero();
        self.assume(height, "=", zero, place);
        self.touching.push((place, words.to_owned()));
    }

    pub(crate) fn constrain(&mut self, name: &str, vanishes: Expr, about: String, place: Place) {
        if self.algebra.graph.is_zero(vanishes) {
            return;
        }
        let equation = format!("{} = 0", self.algebra.graph.text(vanishes));
        let value = table(
            vec![
                ("equation", text(equation, place)),
                ("description", text(about, place)),
            ],
            place,
        );
        self.written
            .constraints
            .entries
            .push((word(name, place), value));
    }

    fn figure(&mut self, contact: &ContactStated<'r>) -> Option<Figure> {
        let object = &contact.object;
        let body = self.bodies.iter().find(|body| body.name == contact.body)?;
        let usual = body.shape.as_ref();
        let usual = usual.map(|(shape, sizes)| (shape.outline, sizes.axis, sizes.lengths.clone()));
        let mut middle = self.outline_center(body);
        if object.get("at").is_some() {
            middle = self.vector(object, "at", "m", false)?;
        }
        let radius = self.stated_number(object, "radius", "m")?;
        let taper = self.stated_number(object, "taper", "1")?;
        let axis = match self.word(object, "axis") {
            Some(text) => Some(self.axis_of(text)?.0),
            None => None,
        };
        let direction = match self.word(object, "direction") {
            Some(text) => Some(self.axis_of(text)?.0),
            None => None,
        };
        let is_tip = object.get("at").is_some() && radius.is_none() && taper.is_none();
        let figure = |outline, axis, lengths| Figure {
            outline,
            axis,
            lengths,
            middle,
            stated: None,
        };
        if let Some(raw) = object.get("figure") {
            let stated = self.stated_figure(contact, raw)?;
            return Some(Figure {
                stated: Some(stated),
                ..figure(Outline::Stated, 2, Vec::new())
            });
        }
        let on_plane = object.get("surface").is_none();
        let has_outline = |outline| match outline {
            Outline::None => false,
            Outline::Cone | Outline::Cylinder => !on_plane,
            _ => true,
        };
        Some(match (radius, usual) {
            (Some(radius), own) if taper.is_some() => {
                let own = own.map_or(1, |(_, own, _)| own);
                let lengths = [Some(radius), taper].into_iter().flatten().collect();
                figure(Outline::Tapered, axis.unwrap_or(own), lengths)
            }
            (Some(radius), _) => {
                let outline = match axis {
                    Some(_) => Outline::Rim,
                    None => Outline::Sphere,
                };
                figure(outline, axis.unwrap_or(1), vec![radius])
            }
            (None, Some((Outline::Rim, own, lengths))) if taper.is_some() => {
                let lengths = lengths.into_iter().take(1).chain(taper).collect();
                figure(Outline::Tapered, axis.unwrap_or(own), lengths)
            }
            (None, Some((outline, own, lengths))) if !is_tip && has_outline(outline) => {
                let (outline, lengths) = outline.touching(&self.algebra, lengths);
                figure(outline, axis.unwrap_or(own), lengths)
            }
            _ if ["blade", "sliding"].contains(&contact.kind.word) => {
                figure(Outline::None, direction.unwrap_or(0), Vec::new())
            }
            _ => {
                let message = format!(
                    "{} rolls, and `{}` has no rim and no sphere that could",
                    object.words(),
                    contact.body
                );
                let hint = "give the body the shape \"disc\", \"ring\", \"ball\" or \"shell\", or the contact a `radius`, and an `axis` where it is a rim";
                self.problems
                    .push(Diagnostic::error("missing-value", object.place, message).hint(hint));
                return None;
            }
        })
    }

    /// A number under a key: nothing where it is not stated; the outer nothing where it cannot be read.
    fn stated_number(
        &mut self,
        object: &Object<'r>,
        key: &str,
        unit: &'static str,
    ) -> Option<Option<Expr>> {
        match object.get(key) {
            Some(raw) => self.number(&object.slot(key, unit), raw).map(Some),
            None => Some(None),
        }
    }

    /// The normal of a plane in the axes of a frame that it carries.
    pub(crate) fn normal(&mut self, plane: FrameId, frame: FrameId) -> Vector {
        let row = self.axes(plane, frame)[self.up.axis];
        if self.up.is_backward {
            self.algebra.minus(self.algebra.zero(), row)
        } else {
            row
        }
    }

    /// How high the origin of a frame is above a plane.
    fn rise(&mut self, plane: FrameId, frame: FrameId) -> Expr {
        let height = self.position(plane, frame)[self.up.axis];
        if self.up.is_backward {
            self.algebra.graph.neg(height)
        } else {
            height
        }
    }

    /// The frame that does not spin along, with the middle of the figure in its axes.
    pub(crate) fn still_axes(
        &mut self,
        body: FrameId,
        figure: &Figure,
        is_same: impl Fn(usize) -> bool,
    ) -> (FrameId, Vector) {
        let axes = self.unspun(body, is_same);
        let middle = self.point(axes, body, figure.middle);
        if middle.iter().all(|e| self.algebra.is_constant(*e)) {
            (axes, middle)
        } else {
            (body, figure.middle)
        }
    }

    fn rim(
        &mut self,
        figure: &Figure,
        plane: FrameId,
        body: FrameId,
        name: &str,
        place: Place,
    ) -> Found {
        let axle = figure.axis;
        let (axes, middle) = self.still_axes(body, figure, |axis| axis == axle);
        let normal = self.normal(plane, axes);
        let rates = self.rates(plane, axes);
        let turning = self.omega_in(plane, axes, body);
        let turning = self.name_vector(&format!("{name}_omega"), turning, place);
        let rise = self.rise(plane, axes);
        let graph = &self.algebra.graph;
        let mut flat = normal;
        flat[axle] = graph.zero();
        let length = graph.sqrt(self.algebra.dot(flat, flat));
        let length = self.name(&format!("{name}_N"), length, place);
        let a = &self.algebra;
        let carried = a.plus(rates.velocity, a.cross(rates.omega, middle));
        let along = a.cross(a.unit(axle), normal);
        let across = a.minus(a.unit(axle), a.times(normal[axle], normal));
        let over = |direction| a.graph.div(a.dot(carried, direction), length);
        let swept = |e| a.graph.mul(&[figure.radius(), e]);
        let spin = a.dot(turning, normal);
        let mut forward = vec![over(along), a.graph.neg(swept(turning[axle]))];
        let mut side = vec![over(across), swept(a.dot(turning, along))];
        let mut level = vec![rise, a.dot(normal, middle), a.graph.neg(swept(length))];
        if let Some(&tube) = figure
            .lengths
            .get(1)
            .filter(|_| figure.outline == Outline::Torus)
        {
            let about = a
                .graph
                .sub(turning[axle], a.graph.mul(&[spin, normal[axle]]));
            let share = a.graph.div(tube, length);
            forward.push(a.graph.neg(a.graph.mul(&[share, about])));
            side.push(a.graph.mul(&[share, a.dot(turning, along)]));
            level.push(a.graph.neg(tube));
        }
        let share = |v: Vector| v.map(|e| a.graph.div(e, length));
        let mut down = a.times(a.graph.neg(figure.radius()), share(flat));
        if figure.outline == Outline::Torus {
            let tube = figure.lengths.get(1).copied();
            let tube = tube.unwrap_or(a.graph.zero());
            down = a.minus(down, a.times(tube, normal));
        }
        Found {
            velocities: [a.graph.add(&forward), a.graph.add(&side), spin],
            height: a.graph.add(&level),
            axes,
            point: a.plus(middle, down),
            directions: [share(along), share(across), normal],
        }
    }

    fn ellipsoid(
        &mut self,
        figure: &Figure,
        plane: FrameId,
        body: FrameId,
        name: &str,
        place: Place,
    ) -> Found {
        let normal = self.normal(plane, body);
        let rates = self.rates(plane, body);
        let rows = self.axes(plane, body);
        let rise = self.rise(plane, body);
        let graph = &self.algebra.graph;
        let squared: Vector =
            std::array::from_fn(|i| graph.mul(&[graph.powi(figure.lengths[i], 2), normal[i]]));
        let root = graph.sqrt(self.algebra.dot(normal, squared));
        let root = self.name(&format!("{name}_N"), root, place);
        let a = &self.algebra;
        let down = squared.map(|e| a.graph.neg(a.graph.div(e, root)));
        let arm = a.plus(figure.middle, down);
        let arm = self.name_vector(&format!("{name}_arm"), arm, place);
        let a = &self.algebra;
        let slip = a.plus(rates.velocity, a.cross(rates.omega, arm));
        let slip = self.name_vector(&format!("{name}_slip"), slip, place);
        let a = &self.algebra;
        let level = a.graph.add(&[rise, a.dot(normal, figure.middle)]);
        let [forward, side] = self.level_axes(&rows);
        Found {
            velocities: [
                a.dot(slip, forward),
                a.dot(slip, side),
                a.dot(rates.omega, normal),
            ],
            height: a.graph.sub(level, root),
            axes: body,
            point: arm,
            directions: [forward, side, normal],
        }
    }

    /// The axes of a plane that lie in it.
    fn level_axes(&self, rows: &[Vector; 3]) -> [Vector; 2] {
        [
            rows[if self.up.axis == 0 { 1 } else { 0 }],
            rows[if self.up.axis == 2 { 1 } else { 2 }],
        ]
    }

    /// A rim whose point of contact is the origin of the heading frame.
    fn rim_built(
        &mut self,
        figure: &Figure,
        built: &Built,
        plane: FrameId,
        body: FrameId,
    ) -> Found {
        let rates = self.rates(plane, built.heading);
        let turning = self.omega_in(plane, built.heading, body);
        let rolling = self.omega_in(built.leaning, built.leaning, body);
        let normal = self.up_vector();
        let a = &self.algebra;
        let down = a.times(a.graph.neg(figure.radius()), normal);
        let axle = a.unit(figure.axis);
        let slip = a.plus(rates.velocity, a.cross(rolling, down));
        let along = a.cross(axle, normal);
        Found {
            velocities: [
                a.dot(slip, along),
                a.dot(slip, axle),
                a.dot(turning, normal),
            ],
            height: a.graph.zero(),
            axes: built.heading,
            point: a.zero(),
            directions: [along, axle, normal],
        }
    }

    fn sphere(&mut self, figure: &Figure, plane: FrameId, body: FrameId) -> Found {
        let (axes, middle) = self.still_axes(body, figure, |_| true);
        let normal = self.normal(plane, axes);
        let rates = self.rates(plane, axes);
        let turning = self.omega_in(plane, axes, body);
        let rows = self.axes(plane, axes);
        let rise = self.rise(plane, axes);
        let a = &self.algebra;
        let down = a.times(a.graph.neg(figure.radius()), normal);
        let carried = a.plus(rates.velocity, a.cross(rates.omega, middle));
        let slip = a.plus(carried, a.cross(turning, down));
        let level = a.graph.add(&[rise, a.dot(normal, middle)]);
        let [forward, side] = self.level_axes(&rows);
        Found {
            velocities: [
                a.dot(slip, forward),
                a.dot(slip, side),
                a.dot(turning, normal),
            ],
            height: a.graph.sub(level, figure.radius()),
            axes,
            point: a.plus(middle, down),
            directions: [forward, side, normal],
        }
    }

    /// A point of the body, with the direction of a blade.
    fn tip(&mut self, figure: &Figure, plane: FrameId, body: FrameId) -> Found {
        let normal = self.normal(plane, body);
        let rates = self.rates(plane, body);
        let rise = self.rise(plane, body);
        let a = &self.algebra;
        let forward = a.unit(figure.axis);
        let slip = a.plus(rates.velocity, a.cross(rates.omega, figure.middle));
        let side = a.cross(normal, forward);
        Found {
            velocities: [
                a.dot(slip, forward),
                a.dot(slip, side),
                a.dot(rates.omega, normal),
            ],
            height: a.graph.add(&[rise, a.dot(normal, figure.middle)]),
            axes: body,
            point: figure.middle,
            directions: [forward, side, normal],
        }
    }
}
