//! Bodies, joints and contacts as expressions of the model.

use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::Expr;

use super::define::DefineKind;
use super::scope::Context;
use super::Resolver;
use crate::bodies::objects::{Kept, KeptBody, KeptReaction};
use crate::mechanism::{Body, Mechanism, Reaction, Vector};
use crate::source::Place;
use crate::text::Text;

impl Resolver {
    /// Declares the definitions that only the objects name.
    pub(crate) fn declare_objects(&mut self, kept: Option<&Kept>) {
        for (key, raw) in kept.iter().flat_map(|kept| &kept.define.entries) {
            self.declare_define(key, raw, DefineKind::Object);
        }
    }

    /// Nothing where a part of the objects could not be read, which was said elsewhere.
    pub(crate) fn mechanism(&mut self, kept: &Kept) -> Option<Mechanism> {
        let mut bodies = Vec::new();
        for own in &kept.bodies {
            let hinged = kept
                .bodies
                .iter()
                .position(|other| other.name == own.hinged);
            bodies.push(self.body(own, hinged?)?);
        }
        let mut reactions = Vec::new();
        for own in &kept.reactions {
            reactions.push(self.reaction(own, &bodies)?);
        }
        let mut loads = Vec::new();
        for own in &kept.loads {
            loads.push(self.reaction(own, &bodies)?);
        }
        let place = kept.bodies.first()?.place;
        let mut terms = Vec::new();
        for spring in &kept.springs {
            terms.push(self.object(spring, place)?);
        }
        if let Some(text) = kept.stated.as_ref().and_then(|raw| raw.expression()) {
            terms.push(self.object(&text.content, text.place)?);
        }
        Some(Mechanism {
            bodies,
            reactions,
            loads,
            potential: self.graph.add(&terms),
            beside: kept.beside,
        })
    }

    fn body(&mut self, own: &KeptBody<String>, hinged: usize) -> Option<Body> {
        let mut all = |v: &[String; 3]| self.object_vector(v, own.place);
        Some(Body {
            inertia: matrix(&own.inertia, &mut all)?,
            rotation: matrix(&own.rotation, &mut all)?,
            center: all(&own.center)?,
            velocity: all(&own.velocity)?,
            turning: all(&own.turning)?,
            omega: all(&own.omega)?,
            weight: all(&own.weight)?,
            point: all(&own.point)?,
            mass: self.object(&own.mass, own.place)?,
            name: own.name.clone(),
            place: own.place,
            parent: own.parent,
            hinged,
            joint: own.joint.clone(),
        })
    }

    fn reaction(&mut self, own: &KeptReaction<String>, bodies: &[Body]) -> Option<Reaction> {
        let number = |name: &str| bodies.iter().position(|body| body.name == name);
        Some(Reaction {
            constraint: own.constraint.clone(),
            object: own.object.clone(),
            body: number(&own.body)?,
            other: number(&own.other),
            force: self.object_vector(&own.force, own.place)?,
            point: self.object_vector(&own.point, own.place)?,
            other_point: self.object_vector(&own.other_point, own.place)?,
            torque: self.object_vector(&own.torque, own.place)?,
        })
    }

    fn object_vector(&mut self, v: &[String; 3], place: Place) -> Option<Vector> {
        let [x, y, z] = v;
        Some([
            self.object(x, place)?,
            self.object(y, place)?,
            self.object(z, place)?,
        ])
    }

    /// A text of the lowering: what is wrong with its names was said where they are defined.
    fn object(&mut self, own: &str, place: Place) -> Option<Expr> {
        let text = Text::of_toml(own, "", place);
        let parsed = parse_expression(own);
        let (context, root) = (Context::jet("an object"), parsed.root());
        self.lower(&text, &parsed, root, &Vec::new(), context)
    }
}

fn matrix(
    rows: &[[String; 3]; 3],
    all: &mut impl FnMut(&[String; 3]) -> Option<Vector>,
) -> Option<[Vector; 3]> {
    let [x, y, z] = rows;
    Some([all(x)?, all(y)?, all(z)?])
}
