//! Bodies: mass, centre, inertia, shape, and their energies.

use chetaev_symbolic::Expr;

use super::algebra::Vector;
use super::lowering::{Body, FrameId, Lowering, GROUND};
use super::reading::Object;
use super::shapes::{Shape, Sizes, SHAPES};
use crate::raw::{Kind, Raw};
use crate::source::Place;

const KEYS: &[&str] = &[
    "mass",
    "density",
    "center",
    "inertia",
    "shape",
    "axis",
    "radius",
    "tube",
    "length",
    "size",
    "semiaxes",
    "description",
];

/// The entries of an inertia matrix that a user states, row and column.
const ENTRIES: [(&str, usize, usize); 6] = [
    ("xx", 0, 0),
    ("yy", 1, 1),
    ("zz", 2, 2),
    ("xy", 0, 1),
    ("xz", 0, 2),
    ("yz", 1, 2),
];

impl<'r> Lowering<'r> {
    pub(crate) fn read_body(&mut self, object: &Object<'r>) {
        self.known_keys(object, KEYS);
        let shape = self.shape(object);
        let mass = self.mass_of(object, shape.as_ref());
        let center = self
            .vector(object, "center", "m", false)
            .unwrap_or(self.algebra.zero());
        let inertia = self.inertia(object, mass, center, shape.as_ref());
        self.bodies.push(Body {
            name: object.name().to_owned(),
            place: object.place,
            mass,
            center,
            inertia,
            shape,
            is_homogeneous: object.get("inertia").is_none(),
        });
    }

    fn shape(&mut self, object: &Object<'r>) -> Option<(&'static Shape, Sizes)> {
        let shape = self.choice(object, "shape", SHAPES, |shape| shape.word)?;
        let mut lengths = Vec::new();
        for &key in shape.sizes {
            let Some(raw) = object.get(key) else {
                let message = format!(
                    "{} is a {} and needs its `{key}`",
                    object.words(),
                    shape.word
                );
                self.error("missing-value", object.place, message);
                return None;
            };
            let slot = object.slot(key, "m");
            match key {
                "size" | "semiaxes" => lengths.extend(self.vector_of(&slot, raw, false)?),
                _ => lengths.push(self.number(&slot, raw)?),
            }
        }
        for length in &lengths {
            self.assume_positive(*length, object.place);
        }
        let axis = match self.word(object, "axis") {
            Some(text) => self.axis_of(text)?.0,
            None => shape.axis,
        };
        Some((shape, Sizes { lengths, axis }))
    }

    fn mass_of(
        &mut self,
        object: &Object<'r>,
        shape: Option<&(&'static Shape, Sizes)>,
    ) -> Option<Expr> {
        if let (Some(raw), Some(other)) = (object.get("density"), object.get("mass")) {
            let message = format!("{} has both a mass and a density", object.words());
            let problem = crate::Diagnostic::error("stated-twice", raw.place, message);
            self.problems.push(problem.related(other.place, "the mass"));
            return None;
        }
        let mass = match (object.get("mass"), object.get("density"), shape) {
            (Some(raw), ..) => self.number(&object.slot("mass", "kg"), raw)?,
            (None, Some(raw), Some((shape, sizes))) => {
                let density = self.number(&object.slot("density", shape.density), raw)?;
                let content = (shape.content)(&self.algebra, sizes);
                let mass = self.algebra.graph.mul(&[density, content]);
                self.name(&format!("{}_mass", object.name()), mass, object.place)
            }
            (None, Some(raw), None) => {
                let message = format!(
                    "{} has a density, and no shape that it could fill",
                    object.words()
                );
                self.error("missing-value", raw.place, message);
                return None;
            }
            (None, None, _) => return None,
        };
        if self.algebra.graph.is_zero(mass) {
            return None;
        }
        self.assume_positive(mass, object.place);
        Some(mass)
    }

    // ---- inertia

    /// About the centre of mass in the axes of the body; `None` for a point, or for a body without mass.
    fn inertia(
        &mut self,
        object: &Object<'r>,
        mass: Option<Expr>,
        center: Vector,
        shape: Option<&(&'static Shape, Sizes)>,
    ) -> Option<[Vector; 3]> {
        let Some(raw) = object.get("inertia") else {
            let (mass, (shape, sizes)) = (mass?, shape?);
            let moments = (shape.moments)(&self.algebra, sizes);
            return Some(self.diagonal(moments.map(|e| self.algebra.graph.mul(&[mass, e]))));
        };
        let slot = object.slot("inertia", "kg m^2");
        match &raw.kind {
            Kind::Array(items) if items.len() == 2 && shape.is_some() => {
                let across = self.number(&slot.component("across"), &items[0])?;
                let along = self.number(&slot.component("along"), &items[1])?;
                let (_, sizes) = shape?;
                self.moments(sizes.revolved(across, along), raw.place)
            }
            Kind::Array(items) if items.len() == 3 => {
                let mut moments = self.algebra.zero();
                for ((own, item), end) in moments.iter_mut().zip(items).zip(["xx", "yy", "zz"]) {
                    *own = self.number(&slot.component(end), item)?;
                }
                self.moments(moments, raw.place)
            }
            Kind::Array(_) => {
                let message = format!("the inertia of {} is one number, [about x, about y, about z], or a table of entries", object.words());
                let problem = crate::Diagnostic::error("wrong-length", raw.place, message);
                let hint = "with a shape of revolution it may be [across the axis, along the axis]";
                self.problems.push(problem.hint(hint));
                None
            }
            Kind::Table(table) if table.get("value").is_none() => {
                let inner = Object { table, ..*object };
                self.inertia_entries(&inner, mass, center, raw)
            }
            _ => {
                let moment = self.number(&slot, raw)?;
                self.moments([moment; 3], raw.place)
            }
        }
    }

    fn diagonal(&self, moments: Vector) -> [Vector; 3] {
        let mut matrix = [self.algebra.zero(); 3];
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] = moments[i];
        }
        matrix
    }

    /// Principal moments: none is negative, and none is more than the other two together.
    fn moments(&mut self, moments: Vector, place: Place) -> Option<[Vector; 3]> {
        let graph = &self.algebra.graph;
        let zero = graph.zero();
        let sums = [(1, 2, 0), (2, 0, 1), (0, 1, 2)]
            .map(|(i, j, k)| (graph.add(&[moments[i], moments[j]]), moments[k]));
        for moment in moments {
            self.assume(moment, ">=", zero, place);
        }
        // Where all moments are one number, or one alone turns a body in the plane, nothing is left to say.
        if moments
            .iter()
            .filter(|e| !self.algebra.graph.is_zero(**e))
            .count()
            > 1
        {
            for (sum, moment) in sums {
                if sum != moment && !self.is_obvious(sum, moment) {
                    self.assume(sum, ">=", moment, place);
                }
            }
        }
        Some(self.diagonal(moments))
    }

    /// a + b ≥ c where c is a or b, as no moment is negative.
    fn is_obvious(&self, sum: Expr, moment: Expr) -> bool {
        let rest = self.algebra.graph.sub(sum, moment);
        self.algebra.graph.reachable(&[rest]).len() == 1
    }

    /// `{ xx, yy, zz, xy, xz, yz, at, turn }`: entries of the matrix, about a point, in turned axes.
    fn inertia_entries(
        &mut self,
        object: &Object<'_>,
        mass: Option<Expr>,
        center: Vector,
        raw: &Raw,
    ) -> Option<[Vector; 3]> {
        let place = raw.place;
        let known: Vec<&str> = ENTRIES
            .iter()
            .map(|(key, ..)| *key)
            .chain(["at", "turn"])
            .collect();
        self.known_keys(object, &known);
        let mut matrix = [self.algebra.zero(); 3];
        let prefixed = object.slot("inertia", "kg m^2");
        for (key, i, j) in ENTRIES {
            if let Some(raw) = object.get(key) {
                let entry = self.number(&prefixed.component(key), raw)?;
                matrix[i][j] = entry;
                matrix[j][i] = entry;
            }
        }
        for turn in self.turns(object, "turn", false).into_iter().rev() {
            matrix = self.turned_matrix(turn, matrix);
        }
        if let Some(raw) = object.get("at") {
            let slot = object.slot("inertia_at", "m");
            let at = self.vector_of(&slot, raw, false)?;
            let Some(mass) = mass else {
                let message = format!(
                    "{} has no mass, and its inertia does not depend on a point",
                    object.words()
                );
                self.error("missing-value", place, message);
                return None;
            };
            matrix = self.moved_to_center(matrix, mass, self.algebra.minus(center, at));
        }
        let name = format!("{}_central", object.name());
        for i in 0..3 {
            for j in i..3 {
                let end = format!("{name}_{}{}", ["x", "y", "z"][i], ["x", "y", "z"][j]);
                matrix[i][j] = self.name(&end, matrix[i][j], place);
                matrix[j][i] = matrix[i][j];
            }
        }
        self.assume_real(&matrix, place);
        Some(matrix)
    }

    /// R I Rᵀ.
    fn turned_matrix(&self, turn: super::algebra::Turn, matrix: [Vector; 3]) -> [Vector; 3] {
        let a = &self.algebra;
        let rows = matrix.map(|row| a.before(turn, row));
        let columns = transposed(rows).map(|column| a.before(turn, column));
        transposed(columns)
    }

    /// Steiner's theorem: from a point to the centre of mass, which lies at d from it.
    fn moved_to_center(&self, matrix: [Vector; 3], mass: Expr, d: Vector) -> [Vector; 3] {
        let a = &self.algebra;
        let square = a.dot(d, d);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let product = a.graph.mul(&[d[i], d[j]]);
                let steiner = if i == j {
                    a.graph.sub(square, product)
                } else {
                    a.graph.neg(product)
                };
                a.graph.sub(matrix[i][j], a.graph.mul(&[mass, steiner]))
            })
        })
    }

    /// A real body has ∫ r rᵀ dm = ½ tr(I) 1 − I without a negative direction: its principal minors are not negative. This is
    /// the triangle inequality of the principal moments.
    fn assume_real(&mut self, matrix: &[Vector; 3], place: Place) {
        let graph = &self.algebra.graph;
        let trace = graph.add(&[matrix[0][0], matrix[1][1], matrix[2][2]]);
        let half = graph.mul(&[self.algebra.ratio(1, 2), trace]);
        let second: [Vector; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                if i == j {
                    graph.sub(half, matrix[i][i])
                } else {
                    graph.neg(matrix[i][j])
                }
            })
        });
        let minor = |i: usize, j: usize| {
            graph.sub(
                graph.mul(&[second[i][i], second[j][j]]),
                graph.powi(second[i][j], 2),
            )
        };
        let columns: Vec<Expr> = (0..3)
            .map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let cofactor = graph.sub(
                    graph.mul(&[second[1][j], second[2][k]]),
                    graph.mul(&[second[1][k], second[2][j]]),
                );
                graph.mul(&[second[0][i], cofactor])
            })
            .collect();
        let determinant = graph.add(&columns);
        let mut all = vec![second[0][0], second[1][1], second[2][2]];
        if (0..3).any(|i| (0..i).any(|j| !graph.is_zero(matrix[i][j]))) {
            all.extend([minor(0, 1), minor(0, 2), minor(1, 2), determinant]);
        }
        let zero = graph.zero();
        for e in all {
            self.assume(e, ">=", zero, place);
        }
    }

    // ---- energies

    /// T and V = m g h of a placed body.
    pub(crate) fn energies(&mut self, number: usize, gravity: Option<Expr>) {
        let body = &self.bodies[number];
        let (name, place, mass, center) = (body.name.clone(), body.place, body.mass, body.center);
        let Some(&frame) = self.placed.get(&name) else {
            return;
        };
        if let (Some(mass), Some(g)) = (mass, gravity) {
            self.weigh(&name, place, frame, [mass, g], center);
        }
        let energy = self.kinetic(number);
        if !self.algebra.graph.is_zero(energy) {
            self.written.kinetic.push(self.algebra.graph.text(energy));
        }
    }

    /// T = ½ m v² + ½ ω·I ω, by its name.
    pub(crate) fn kinetic(&mut self, number: usize) -> Expr {
        let body = &self.bodies[number];
        let (name, place) = (body.name.clone(), body.place);
        let (mass, center, inertia) = (body.mass, body.center, body.inertia);
        let zero = self.algebra.graph.zero();
        let Some(&frame) = self.placed.get(&name) else {
            return zero;
        };
        let mut terms = Vec::new();
        if let Some(mass) = mass {
            let velocity = self.center_velocity(frame, center, &name, place);
            let square = self.algebra.dot(velocity, velocity);
            terms.push(self.algebra.graph.mul(&[mass, square]));
        }
        if let Some(inertia) = inertia {
            let omega = self.turning(frame, &inertia, &name, place);
            let momentum = inertia.map(|row| self.algebra.dot(row, omega));
            terms.push(self.algebra.dot(omega, momentum));
        }
        let graph = &self.algebra.graph;
        let double = graph.add(&terms);
        let energy = graph.mul(&[self.algebra.ratio(1, 2), double]);
        self.name(&format!("{name}_T"), energy, place)
    }

    /// The velocity of the centre of mass, in axes that do not turn about it where that is shorter.
    pub(crate) fn center_velocity(
        &mut self,
        frame: FrameId,
        center: Vector,
        name: &str,
        place: Place,
    ) -> Vector {
        let axes = self.unturned(frame, center);
        let rates = self.rates(GROUND, axes);
        let carried = self.algebra.cross(rates.omega, center);
        let velocity = self.algebra.plus(rates.velocity, carried);
        self.name_vector(&format!("{name}_center_v"), velocity, place)
    }

    /// The angular velocity in axes in which the inertia is constant, and that spin as little as possible.
    pub(crate) fn turning(
        &mut self,
        frame: FrameId,
        inertia: &[Vector; 3],
        name: &str,
        place: Place,
    ) -> Vector {
        let axes = self.inertia_axes(frame, inertia);
        let omega = self.omega_in(GROUND, axes, frame);
        self.name_vector(&format!("{name}_omega"), omega, place)
    }

    /// The frame in whose axes the inertia is constant, and that spins as little as possible.
    pub(crate) fn inertia_axes(&self, frame: FrameId, inertia: &[Vector; 3]) -> FrameId {
        let graph = &self.algebra.graph;
        let is_same = |axis: usize| {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let zero = |a: usize, b: usize| graph.is_zero(inertia[a][b]);
            inertia[i][i] == inertia[j][j] && zero(i, j) && zero(i, axis) && zero(j, axis)
        };
        self.unspun(frame, is_same)
    }

    fn weigh(
        &mut self,
        name: &str,
        place: Place,
        frame: FrameId,
        weight: [Expr; 2],
        center: Vector,
    ) {
        let axes = self.unturned(frame, center);
        let height = self.height(axes, center);
        if self.algebra.is_constant(height) {
            return;
        }
        let height = self.name(&format!("{name}_height"), height, place);
        let [mass, g] = weight;
        let potential = self.algebra.graph.mul(&[mass, g, height]);
        self.written
            .potential
            .push(self.algebra.graph.text(potential));
    }

    /// How high a point of a frame is.
    pub(crate) fn height(&mut self, frame: FrameId, point: Vector) -> Expr {
        let height = self.point(GROUND, frame, point)[self.up.axis];
        if self.up.is_backward {
            self.algebra.graph.neg(height)
        } else {
            height
        }
    }
}

fn transposed(matrix: [Vector; 3]) -> [Vector; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[j][i]))
}
