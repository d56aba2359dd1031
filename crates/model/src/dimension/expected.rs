//! What the dimension of a whole expression must be, after the place where it stands.

use super::{mismatch, over_time, Checker, Kind};
use crate::diagnostic::Diagnostic;
use crate::resolve::formula::Expected;
use crate::source::Place;
use crate::units::Dimension;

/// An expression whose nodes have been looked at.
pub(super) struct Checked<'f> {
    /// The dimension of its first side.
    pub(super) kind: Kind,
    /// Where that side is.
    pub(super) place: Place,
    /// Whether it is a bare number, which stands for a value in the unit of the quantity.
    pub(super) bare: bool,
    /// All sides of a relation.
    pub(super) sides: &'f [(Kind, Place)],
}

/// A dimension that the first of several expressions decides for the others.
#[derive(Clone, Debug)]
pub(super) struct Decided {
    pub(super) kind: Dimension,
    pub(super) place: Place,
    /// What is said about that place.
    pub(super) label: String,
}

impl Decided {
    fn by(kind: Dimension, place: Place) -> Self {
        let label = format!("this has {kind}");
        Decided { kind, place, label }
    }
}

impl Checker<'_> {
    pub(super) fn expectation(&mut self, expected: &Expected, checked: &Checked<'_>) {
        match expected {
            Expected::Anything => {}
            Expected::EqualSides => self.equal_sides(checked.sides),
            Expected::Quantity(name, order) => self.quantity(name, *order, checked),
            Expected::Energy => self.energy(checked),
            Expected::Force(coordinate) => self.force(coordinate, checked),
            Expected::Power => self.rate_of_energy(checked),
            Expected::Mass => self.mass(checked),
            Expected::Length => self.length(checked),
            Expected::ForceOnParticle => self.force_on_particle(checked),
            Expected::VelocityOfParticle => self.velocity_of_particle(checked),
            Expected::FieldComponent { define, coordinate } => {
                self.field_component(*define, coordinate, checked)
            }
            Expected::Time | Expected::Number if checked.bare => {}
            Expected::Time => {
                self.compare_kind(checked, &Dimension::time(), "a time has the dimension")
            }
            Expected::Number => self.compare_kind(
                checked,
                &Dimension::none(),
                "a pure number has the dimension",
            ),
        }
    }

    /// The value of a quantity or of its derivative.
    fn quantity(&mut self, name: &str, order: u32, checked: &Checked<'_>) {
        let Some(unit) = self.unit_of(name).cloned() else {
            return;
        };
        if checked.bare {
            return;
        }
        if order == 0 && !unit.is_coherent() {
            let message = format!(
                "a value computed from other quantities is in SI base units, not in `{}`",
                unit.text
            );
            let hint = format!("state the unit of `{name}` as \"{}\"", unit.dimension);
            self.found
                .push(Diagnostic::error("incoherent-unit", checked.place, message).hint(hint));
            return;
        }
        let wanted = over_time(unit.dimension, order);
        let primes = "'".repeat(order as usize);
        self.compare_kind(
            checked,
            &wanted,
            &format!("`{name}{primes}` has the dimension"),
        );
    }

    /// A part of the Lagrangian: the first one decides for the others.
    fn energy(&mut self, checked: &Checked<'_>) {
        let Some(own) = checked.kind.clone() else {
            return;
        };
        match self.energy.clone() {
            None => self.energy = Some(Decided::by(own, checked.place)),
            Some(energy) if own != energy.kind => {
                let message = format!(
                    "this has the dimension {own}, and the rest of the Lagrangian has {}",
                    energy.kind
                );
                self.found
                    .push(mismatch(checked.place, message).related(energy.place, energy.label));
            }
            Some(_) => {}
        }
    }

    // ---- particles

    /// A bare number is a mass in the unit of the others.
    fn mass(&mut self, checked: &Checked<'_>) {
        if checked.bare {
            return;
        }
        match (&checked.kind, self.mass.clone()) {
            (Some(own), None) => {
                self.mass = Some(Decided::by(own.clone(), checked.place));
                self.energy_of_particles();
            }
            (Some(own), Some(first)) => self.like_the_first(own, &first, checked, "mass"),
            (None, _) => {}
        }
    }

    fn length(&mut self, checked: &Checked<'_>) {
        let Some(own) = &checked.kind else { return };
        if let Some(first) = self.length.clone() {
            self.like_the_first(own, &first, checked, "length");
            return;
        }
        self.length = Some(Decided::by(own.clone(), checked.place));
        self.energy_of_particles();
    }

    /// The kinetic energy has a mass times the square of a velocity.
    fn energy_of_particles(&mut self) {
        let (Some(mass), Some(length), None) = (&self.mass, &self.length, &self.energy) else {
            return;
        };
        let square = length.kind.times(&length.kind);
        let kind = mass.kind.times(&square).over(&square_of_time());
        let (place, label) = (
            length.place,
            format!("the kinetic energy of the particles has {kind}"),
        );
        self.energy = Some(Decided { kind, place, label });
    }

    fn like_the_first(
        &mut self,
        own: &Dimension,
        first: &Decided,
        checked: &Checked<'_>,
        word: &str,
    ) {
        if *own != first.kind {
            let message = format!(
                "this {word} has the dimension {own}, and another one has {}",
                first.kind
            );
            let diagnostic = mismatch(checked.place, message).label(format!("this has {own}"));
            self.found
                .push(diagnostic.related(first.place, first.label.clone()));
        }
    }

    fn force_on_particle(&mut self, checked: &Checked<'_>) {
        let (Some(mass), Some(length)) = (&self.mass, &self.length) else {
            return;
        };
        let wanted = mass.kind.times(&length.kind).over(&square_of_time());
        self.compare_kind(
            checked,
            &wanted,
            "the force on a particle has the dimension",
        );
    }

    fn velocity_of_particle(&mut self, checked: &Checked<'_>) {
        let Some(length) = &self.length else { return };
        let wanted = length.kind.over(&Dimension::time());
        self.compare_kind(checked, &wanted, "a velocity of matter has the dimension");
    }

    // ---- frames

    /// The component along q^i is the velocity of q^i over the quasi-velocity.
    fn field_component(&mut self, define: usize, coordinate: &str, checked: &Checked<'_>) {
        let (Some(own), Some(unit)) = (&checked.kind, self.unit_of(coordinate)) else {
            return;
        };
        let kind = over_time(unit.dimension.clone(), 1).over(own);
        let name = &self.resolver.defines[define].name;
        let label = format!("this makes it {kind}");
        match self.speeds.get(&define) {
            None => {
                self.defines[define] = Some(kind.clone());
                let (place, label) = (checked.place, label);
                self.speeds.insert(define, Decided { kind, place, label });
            }
            Some(first) if first.kind != kind => {
                let message = format!(
                    "the components of a field give `{name}` different dimensions, {} and {kind}",
                    first.kind
                );
                let diagnostic = mismatch(checked.place, message).label(label);
                self.found
                    .push(diagnostic.related(first.place, first.label.clone()));
            }
            Some(_) => {}
        }
    }

    fn force(&mut self, coordinate: &str, checked: &Checked<'_>) {
        let (Some(energy), Some(unit)) = (&self.energy, self.unit_of(coordinate)) else {
            return;
        };
        let wanted = energy.kind.over(&unit.dimension);
        self.compare_kind(
            checked,
            &wanted,
            &format!("the force on `{coordinate}` has the dimension of L/{coordinate},"),
        );
    }

    /// Rayleigh's function.
    fn rate_of_energy(&mut self, checked: &Checked<'_>) {
        let Some(energy) = &self.energy else {
            return;
        };
        let wanted = energy.kind.over(&Dimension::time());
        self.compare_kind(
            checked,
            &wanted,
            "a power, as Rayleigh's function, has the dimension of L/t,",
        );
    }

    fn equal_sides(&mut self, sides: &[(Kind, Place)]) {
        let mut known = sides
            .iter()
            .filter_map(|(kind, place)| Some((kind.as_ref()?, *place)));
        let Some((first, first_place)) = known.next() else {
            return;
        };
        if let Some((other, place)) = known.find(|(kind, _)| *kind != first) {
            let message = format!("one side has the dimension {first}, the other {other}");
            self.found.push(
                mismatch(place, message)
                    .label(format!("this has {other}"))
                    .related(first_place, format!("this has {first}")),
            );
        }
    }

    fn compare_kind(&mut self, checked: &Checked<'_>, wanted: &Dimension, words: &str) {
        if let Some(kind) = &checked.kind {
            self.compare(kind, wanted, checked.place, words);
        }
    }

    pub(super) fn compare(
        &mut self,
        kind: &Dimension,
        wanted: &Dimension,
        place: Place,
        words: &str,
    ) {
        if kind != wanted {
            self.found.push(
                mismatch(place, format!("{words} {wanted}, and this has {kind}"))
                    .label(format!("this has {kind}")),
            );
        }
    }
}

fn square_of_time() -> Dimension {
    let time = Dimension::time();
    time.times(&time)
}
