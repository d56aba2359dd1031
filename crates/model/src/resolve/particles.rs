//! Particles: constant masses at positions r(q, t), with applied forces; the kinetic energy is their sum.

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::{Expr, Rational};

use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::Particle;
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;

/// The parts of a particle as they are written; what is missing or of the wrong kind is none, and reported.
struct Parts {
    mass: Option<Text>,
    position: Option<Vec<Text>>,
    force: Force,
    description: String,
}

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
        let known = ["mass", "position", "force", "description"];
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
                    self.same_length(position.as_deref(), &force, raw.place);
                    Force::Stated(force)
                }
            },
        };
        Some(Parts {
            mass,
            position,
            force,
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

    fn same_length(&mut self, position: Option<&[Text]>, force: &[Text], place: Place) {
        let wanted = position.map_or(force.len(), <[Text]>::len);
        if wanted != force.len() {
            let message = format!(
                "the force on a particle has as many components as its position, {wanted}, not {}",
                force.len()
            );
            self.push(Diagnostic::error("wrong-length", place, message));
        }
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
        let (position, force) = (position?, force?);
        (force.len() == position.len()).then_some(Particle {
            name,
            mass: mass?,
            position,
            force,
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

    /// A constant that is not zero; where its value is known and negative, a warning.
    fn mass(&mut self, name: &str, text: &Text, bindings: &Bindings) -> Option<Expr> {
        let context = Context::constant("the mass of a particle").hint(
            "the mass of a particle is a constant here; state `T` or `L` instead of the particle where it varies",
        );
        let mass = self.expression(text, bindings, context, Expected::Mass)?;
        let values: Vec<(Expr, Expr)> = self
            .parameters
            .iter()
            .filter_map(|parameter| Some((parameter.symbol, parameter.value?)))
            .collect();
        let value = self.graph.substitute(mass, &values);
        if self.graph.is_zero(value) {
            let message = format!("the mass of the particle `{name}` is zero");
            self.push(
                Diagnostic::error("zero-mass", text.place, message).hint(
                    "the mass of a particle is a constant here, and not zero; a point without mass needs no particle",
                ),
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
                .map(|&r| graph.powi(graph.total_derivative(r, &|name| self.varies(name)), 2))
                .collect();
            terms.push(graph.mul(&[half, particle.mass, graph.add(&squares)]));
        }
        graph.add(&terms)
    }
}
