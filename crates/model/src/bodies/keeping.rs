//! The objects are kept: what a body, a joint or a contact is, in the names of the lowered model.

use chetaev_symbolic::Expr;

use super::algebra::Vector;
use super::lowering::{FrameId, Lowering, GROUND};
use super::objects::{Kept, KeptBody, KeptReaction};
use super::placing::Built;
use super::tree::Tree;
use crate::raw::{Raw, Table};

impl Kept {
    /// All texts.
    pub(crate) fn texts(&self) -> impl Iterator<Item = &String> {
        let bodies = self.bodies.iter().flat_map(|b| {
            let vectors = [
                &b.center,
                &b.velocity,
                &b.turning,
                &b.omega,
                &b.weight,
                &b.point,
            ];
            let matrices = b.inertia.iter().chain(&b.rotation).flatten();
            matrices
                .chain(vectors.into_iter().flatten())
                .chain([&b.mass])
        });
        let reactions = self.reactions.iter().chain(&self.loads).flat_map(|own| {
            let points = own.point.iter().chain(&own.other_point);
            points.chain(&own.force).chain(&own.torque)
        });
        bodies.chain(reactions).chain(&self.springs)
    }
}

impl Lowering<'_> {
    /// Notes the reaction of a constraint; all vectors along the axes of the ground.
    pub(crate) fn keep_reaction(&mut self, own: KeptReaction<Expr>) {
        self.reactions.push(own);
    }

    /// Everything that is kept, after all is placed and lowered.
    pub(crate) fn keep_all(
        &mut self,
        tree: &Tree<'_>,
        built: &[Built],
        gravity: Option<Expr>,
    ) -> Kept {
        let mut order: Vec<String> = Vec::new();
        let bodies: Vec<String> = self.bodies.iter().map(|body| body.name.clone()).collect();
        let touched = tree.contacts.iter().map(|contact| contact.on.clone());
        let touched = touched.filter(|name| tree.frames.contains_key(name));
        for name in bodies.into_iter().chain(touched) {
            self.after_parents(&name, tree, built, &mut order);
        }
        let mut kept = Vec::new();
        for name in &order {
            let own = self.keep(name, tree, built, gravity);
            let parent = self.carrier(&own.1, tree, &order);
            kept.extend(own.0.map(|body| KeptBody { parent, ..body }));
        }
        let graph = &self.algebra.graph;
        let text = |e: Expr| graph.text(e);
        let [mut reactions, mut loads] = [&self.reactions, &self.loads].map(|all| {
            let texts = all.iter().map(|own| own.texts(&text));
            texts.collect::<Vec<KeptReaction<String>>>()
        });
        // What a frame carries that nothing touches is carried by the body before it.
        for own in reactions.iter_mut().chain(&mut loads) {
            let number = self.carrier(&own.other, tree, &order);
            own.other = number.map_or("ground".to_owned(), |number| order[number].clone());
        }
        let energies = self.root.get("lagrangian");
        let table = energies.and_then(Raw::table);
        let has = |key: &str| table.is_some_and(|table| table.get(key).is_some());
        let beside = match () {
            _ if energies.is_some() && table.is_none() || has("L") => Some("L"),
            _ if has("T") => Some("T"),
            _ => None,
        };
        Kept {
            define: Table::default(),
            bodies: kept.into_iter().map(|body| body.texts(&text)).collect(),
            reactions,
            loads,
            springs: self.springs.clone(),
            stated: table.and_then(|table| table.get("V")).cloned(),
            beside,
        }
    }

    /// The order in which each comes after what it hangs on; frames that nothing touches are passed over.
    fn after_parents(&self, name: &str, tree: &Tree<'_>, built: &[Built], order: &mut Vec<String>) {
        let mut chain = Vec::new();
        let mut at = name.to_owned();
        while at != "ground" && !chain.contains(&at) {
            let is_touched = tree.contacts.iter().any(|contact| contact.on == at);
            if !tree.frames.contains_key(&at) || is_touched {
                chain.push(at.clone());
            }
            at = self.hangs_on(&at, tree, built).0;
        }
        for own in chain.into_iter().rev() {
            if !order.contains(&own) {
                order.push(own);
            }
        }
    }

    /// What something hangs on, and by which joint or contact.
    pub(crate) fn hangs_on(
        &self,
        name: &str,
        tree: &Tree<'_>,
        built: &[Built],
    ) -> (String, String) {
        if let Some(object) = tree.frames.get(name) {
            let parent = object.get("parent").and_then(Raw::expression);
            let parent = parent.map_or("ground".to_owned(), |text| text.content.clone());
            return (parent, name.to_owned());
        }
        if let Some(joint) = tree.placing.get(name) {
            let joint = &tree.joints[*joint];
            return (joint.parent.clone(), joint.object.name().to_owned());
        }
        let own = built.iter().find(|own| own.body == name);
        match own.map(|own| &tree.contacts[own.contact]) {
            Some(contact) => (contact.on.clone(), contact.object.name().to_owned()),
            None => ("ground".to_owned(), name.to_owned()),
        }
    }

    /// The body or touched frame of that name, or the one that carries it.
    fn carrier(&self, name: &str, tree: &Tree<'_>, order: &[String]) -> Option<usize> {
        let mut at = name.to_owned();
        for _ in 0..=tree.frames.len() {
            if let Some(number) = order.iter().position(|own| *own == at) {
                return Some(number);
            }
            let object = tree.frames.get(&at)?;
            at = object.get("parent")?.expression()?.content.clone();
        }
        None
    }

    /// A body or frame, and the name of what it hangs on.
    fn keep(
        &mut self,
        name: &str,
        tree: &Tree<'_>,
        built: &[Built],
        gravity: Option<Expr>,
    ) -> (Option<KeptBody<Expr>>, String) {
        let (parent, joint) = self.hangs_on(name, tree, built);
        let Some(&frame) = self.placed.get(name) else {
            return (None, parent);
        };
        let zero = self.algebra.graph.zero();
        let body = self.bodies.iter().find(|body| body.name == name);
        let mass = body.and_then(|body| body.mass).unwrap_or(zero);
        let center = body.map_or([zero; 3], |body| body.center);
        let inertia = body.and_then(|body| body.inertia);
        let inertia = inertia.unwrap_or([[zero; 3]; 3]);
        let place = self.frames[frame].place;
        let place = body.map_or(place, |body| body.place);
        let axes = self.inertia_axes(frame, &inertia);
        let point = self.hinge(name, frame, tree, built);
        let stands = built.iter().find(|own| own.body == name);
        let hinged = stands.map_or(name, |own| &tree.contacts[own.contact].body);
        let hinged = hinged.to_owned();
        let still = self.unturned(frame, center);
        let weight = gravity.map_or([zero; 3], |g| {
            let load = self.algebra.graph.mul(&[mass, g]);
            self.algebra
                .times(self.algebra.graph.neg(load), self.up_vector())
        });
        let body = KeptBody {
            name: name.to_owned(),
            place,
            mass,
            inertia,
            rotation: self.axes(GROUND, axes),
            center: self.point(GROUND, still, center),
            velocity: self.center_velocity(frame, center, name, place),
            turning: self.rates(GROUND, axes).omega,
            omega: self.turning(frame, &inertia, name, place),
            weight,
            point,
            parent: None,
            joint,
            hinged,
        };
        (Some(body), parent)
    }

    /// The point of the joint by which something hangs, along the axes of the ground.
    pub(crate) fn hinge(
        &mut self,
        name: &str,
        frame: FrameId,
        tree: &Tree<'_>,
        built: &[Built],
    ) -> Vector {
        if let Some(own) = built.iter().find(|own| own.body == name) {
            return self.position(GROUND, own.heading);
        }
        let joint = tree
            .placing
            .get(name)
            .map(|joint| tree.joints[*joint].object);
        let back = joint.and_then(|object| self.vector(&object, "child_at", "m", false));
        self.point(GROUND, frame, back.unwrap_or(self.algebra.zero()))
    }
}
