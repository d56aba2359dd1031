//! Particles: masses at positions r(q, t), with applied forces and thrust; the kinetic energy is their sum.

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::{Expr, Rational};

use super::formula::Expected;
use super::scope::{Context, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Particle, Thrust};
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;

/// The parts of a particle as they are written; what is missing or of the wrong kind is none, and reported.
struct Parts {
    mass: Option<Text>,
    position: Option<Vec<Text>>,
    force: Force,
    thrust: Option<ThrustText>,
    description: String,
}

/// The thrust as it is written, with its place; what is wrong with it is reported.
struct ThrustText {
    place: Place,
    mode: Mode,
}

enum Mode {
    Isotropic,
    Velocity(Vec<Text>),
    Absolute(Vec<Text>),
    Exhaust(Text),
    Force(Vec<Text>),
}

/// The keys of a thrust, one of which is stated.
const MODES: &[&str] = &[
    "relative_velocity",
    "exhaust_speed",
    "absolute_velocity",
    "force",
];

/// The applied force as it is written.
enum Force {
    NotStated,
    Unreadable,
    Stated(Vec<Text>),
}

impl Resolver {
    /// Reads the particles; those with errors are left out.
    pub(crate) fn particles(&mut self, root: &Table) -> Vec<Particle> {
        let mut particles: Vec<Particle> = Vec::new();
        let Some(table) = self.section(root, "particles") else {
            return particles;
        };
        for (key, raw) in &table.entries {
            let Some(parts) = self.parts_of_particle(key, raw) else {
                continue;
            };
            for instance in self.own_names(key, "a particle") {
                if let Some(earlier) = particles.iter().find(|own| own.name == instance.name) {
                    let message = format!("two particles are called `{}`", instance.name);
                    let diagnostic = Diagnostic::error("declared-twice", key.place, message);
                    self.push(diagnostic.related(earlier.place, "first here"));
                    break;
                }
                let particle = self.particle(instance.name, &parts, &instance.bindings, key.place);
                particles.extend(particle);
            }
        }
        particles
    }

    fn parts_of_particle(&mut self, key: &Text, raw: &Raw) -> Option<Parts> {
        let Kind::Table(table) = &raw.kind else {
            self.wrong_kind(raw, "a particle", "a table with `mass` and `position`");
            return None;
        };
        let known = ["mass", "position", "force", "thrust", "description"];
        self.known_keys(table, &known, "of a particle");
        let description = self.prose(table, "description");
        for part in ["mass", "position"] {
            if table.get(part).is_none() {
                let message = format!("the particle `{}` needs its `{part}`", key.content);
                self.push(Diagnostic::error("missing-value", key.place, message));
            }
        }
        let mass = table.get("mass").and_then(|raw| {
            let text = self.expression_text(raw, "the mass of a particle")?;
            self.parse(&text, parse_expression);
            Some(text)
        });
        let position = table
            .get("position")
            .and_then(|raw| self.components_of(raw, "the position of a particle"));
        let force = match table.get("force") {
            None => Force::NotStated,
            Some(raw) => match self.components_of(raw, "the force on a particle") {
                None => Force::Unreadable,
                Some(force) => {
                    self.same_length("force", position.as_deref(), &force, raw.place);
                    Force::Stated(force)
                }
            },
        };
        let thrust = table
            .get("thrust")
            .and_then(|raw| self.thrust_text(raw, position.as_deref()));
        Some(Parts {
            mass,
            position,
            force,
            thrust,
            description,
        })
    }

    /// An array of one to three expressions.
    fn components_of(&mut self, raw: &Raw, what: &str) -> Option<Vec<Text>> {
        let Kind::Array(items) = &raw.kind else {
            let message = format!(
                "{what} must be an array of 1 to 3 expressions, not {}",
                raw.kind.word()
            );
            let mut diagnostic = Diagnostic::error("wrong-kind", raw.place, message);
            if let Some(text) = raw.expression() {
                diagnostic = diagnostic.suggest(raw.place, format!("[\"{}\"]", text.content));
            }
            self.push(diagnostic);
            return None;
        };
        if !(1..=3).contains(&items.len()) {
            let message = format!("{what} has 1 to 3 components, not {}", items.len());
            self.push(Diagnostic::error("wrong-length", raw.place, message));
            return None;
        }
        let mut texts = Vec::new();
        for item in items {
            let text = self.expression_text(item, "a component");
            if let Some(text) = &text {
                self.parse(text, parse_expression);
            }
            texts.push(text);
        }
        texts.into_iter().collect()
    }

    fn same_length(
        &mut self,
        word: &str,
        position: Option<&[Text]>,
        vector: &[Text],
        place: Place,
    ) {
        let wanted = position.map_or(vector.len(), <[Text]>::len);
        if wanted != vector.len() {
            let message = format!(
                "the {word} on a particle has as many components as its position, {wanted}, not {}",
                vector.len()
            );
            self.push(Diagnostic::error("wrong-length", place, message));
        }
    }

    /// A table with one key, or the word `isotropic`.
    fn thrust_text(&mut self, raw: &Raw, position: Option<&[Text]>) -> Option<ThrustText> {
        let place = raw.place;
        let table = match &raw.kind {
            Kind::Text(text) if text.content == "isotropic" => {
                let mode = Mode::Isotropic;
                return Some(ThrustText { place, mode });
            }
            Kind::Table(table) => table,
            _ => {
                let message = "the thrust on a particle is \"isotropic\", or a table with one key";
                let hint = format!("one of {}", MODES.join(", "));
                self.push(Diagnostic::error("wrong-kind", place, message).hint(hint));
                return None;
            }
        };
        self.known_keys(table, MODES, "of a thrust");
        let mut stated = table
            .entries
            .iter()
            .filter(|(key, _)| MODES.contains(&key.content.as_str()));
        let Some((key, value)) = stated.next() else {
            if table.entries.is_empty() {
                let message = "the thrust of a particle is empty";
                let hint = format!("state one of {}", MODES.join(", "));
                self.push(Diagnostic::error("missing-value", place, message).hint(hint));
            }
            return None;
        };
        if let Some((other, _)) = stated.next() {
            let message = format!(
                "the thrust is stated twice, by `{}` and by `{}`",
                key.content, other.content
            );
            self.push(
                Diagnostic::error("stated-twice", other.place, message)
                    .related(key.place, "first here")
                    .hint("leave one of them"),
            );
            return None;
        }
        let mode = self.mode(&key.content, value, position)?;
        Some(ThrustText { place, mode })
    }

    fn mode(&mut self, key: &str, raw: &Raw, position: Option<&[Text]>) -> Option<Mode> {
        if key == "exhaust_speed" {
            let text = self.expression_text(raw, "the exhaust speed")?;
            self.parse(&text, parse_expression);
            return Some(Mode::Exhaust(text));
        }
        let (what, word) = match key {
            "force" => ("the thrust on a particle", "thrust"),
            _ => ("a velocity of matter", "velocity of matter"),
        };
        let components = self.components_of(raw, what)?;
        self.same_length(word, position, &components, raw.place);
        Some(match key {
            "relative_velocity" => Mode::Velocity(components),
            "absolute_velocity" => Mode::Absolute(components),
            _ => Mode::Force(components),
        })
    }

    /// The thrust of one particle; `None` where it cannot be understood.
    fn thrust(
        &mut self,
        parts: &Parts,
        bindings: &Bindings,
        (name, mass): (&str, Option<Expr>),
    ) -> Option<Thrust> {
        let Some(stated) = &parts.thrust else {
            return Some(Thrust::Isotropic);
        };
        let velocity = Context::state("a velocity of matter");
        let expected = Expected::VelocityOfParticle;
        let thrust = match &stated.mode {
            Mode::Isotropic => Thrust::Isotropic,
            Mode::Velocity(texts) => {
                Thrust::RelativeVelocity(self.all_of(texts, bindings, velocity, &expected)?)
            }
            Mode::Absolute(texts) => {
                Thrust::AbsoluteVelocity(self.all_of(texts, bindings, velocity, &expected)?)
            }
            Mode::Exhaust(text) => {
                Thrust::ExhaustSpeed(self.expression(text, bindings, velocity, expected)?)
            }
            Mode::Force(texts) => {
                let context = Context::state("the thrust on a particle");
                Thrust::Force(self.all_of(texts, bindings, context, &Expected::ForceOnParticle)?)
            }
        };
        if mass.is_some_and(|mass| self.is_constant(mass)) {
            self.idle_thrust(name, &thrust, stated.place);
        }
        Some(thrust)
    }

    /// Matter with a velocity acts by the rate of the mass only.
    fn idle_thrust(&mut self, name: &str, thrust: &Thrust, place: Place) {
        if !matches!(thrust, Thrust::Isotropic | Thrust::Force(_)) {
            let message =
                format!("the mass of the particle `{name}` is constant: its thrust has no effect");
            self.push(
                Diagnostic::warning("no-effect", place, message)
                    .hint("let the mass vary, or state the thrust itself by `force`"),
            );
        }
    }

    /// Whether nothing that moves occurs.
    fn is_constant(&self, e: Expr) -> bool {
        let symbols = self.graph.symbols_in(&[e]);
        symbols.into_iter().all(|symbol| {
            let kind = self.names.get(self.graph.symbol_name(symbol));
            matches!(kind.map(|named| named.kind), Some(NamedKind::Parameter))
        })
    }

    fn particle(
        &mut self,
        name: String,
        parts: &Parts,
        bindings: &Bindings,
        place: Place,
    ) -> Option<Particle> {
        let mass = parts
            .mass
            .as_ref()
            .and_then(|text| self.mass(&name, text, bindings));
        let position = parts.position.as_ref().and_then(|texts| {
            let context = Context::position("the position of a particle");
            self.all_of(texts, bindings, context, &Expected::Length)
        });
        let force = match &parts.force {
            Force::Unreadable => None,
            Force::NotStated => position
                .as_ref()
                .map(|position| vec![self.graph.zero(); position.len()]),
            Force::Stated(texts) => {
                let context = Context::state("the force on a particle");
                self.all_of(texts, bindings, context, &Expected::ForceOnParticle)
            }
        };
        let thrust = self.thrust(parts, bindings, (&name, mass));
        let (position, force) = (position?, force?);
        (force.len() == position.len()).then_some(Particle {
            name,
            mass: mass?,
            position,
            force,
            thrust: thrust?,
            description: parts.description.clone(),
            place,
        })
    }

    /// Every component is read, also after one with errors.
    fn all_of(
        &mut self,
        texts: &[Text],
        bindings: &Bindings,
        context: Context,
        expected: &Expected,
    ) -> Option<Vec<Expr>> {
        let values: Vec<Option<Expr>> = texts
            .iter()
            .map(|text| self.expression(text, bindings, context, expected.clone()))
            .collect();
        values.into_iter().collect()
    }

    /// An expression that is not zero; where its value is known and negative, a warning.
    fn mass(&mut self, name: &str, text: &Text, bindings: &Bindings) -> Option<Expr> {
        let context = Context::state("the mass of a particle");
        let mass = self.expression(text, bindings, context, Expected::Mass)?;
        let value = self.with_parameters(mass);
        if self.graph.is_zero(value) {
            let message = format!("the mass of the particle `{name}` is zero");
            self.push(
                Diagnostic::error("zero-mass", text.place, message)
                    .hint("a point without mass needs no particle"),
            );
            return None;
        }
        let negative = self
            .graph
            .as_number(value)
            .is_some_and(|number| *number < Rational::from(0));
        if negative {
            let message = format!("the mass of the particle `{name}` is negative");
            self.push(Diagnostic::warning("negative-mass", text.place, message));
        }
        Some(mass)
    }

    /// T = Σ ½ m r'·r'.
    pub(crate) fn kinetic_of(&self, particles: &[Particle]) -> Expr {
        let graph = &self.graph;
        let half = graph.number(Rational::ONE / Rational::from(2));
        let mut terms = Vec::new();
        for particle in particles {
            let squares: Vec<Expr> = particle
                .position
                .iter()
                .map(|&r| graph.powi(self.total_derivative(r), 2))
                .collect();
            terms.push(graph.mul(&[half, particle.mass, graph.add(&squares)]));
        }
        graph.add(&terms)
    }
}
