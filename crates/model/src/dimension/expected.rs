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

impl Checker<'_> {
    pub(super) fn expectation(&mut self, expected: &Expected, checked: &Checked<'_>) {
        match expected {
            Expected::Anything => {}
            Expected::EqualSides => self.equal_sides(checked.sides),
            Expected::Quantity(name, order) => self.quantity(name, *order, checked),
            Expected::Energy => self.energy(checked),
            Expected::Force(coordinate) => self.force(coordinate, checked),
            Expected::Power => self.rate_of_energy(checked),
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
        let (Some(own), place) = (checked.kind.clone(), checked.place) else {
            return;
        };
        match self.energy.clone() {
            None => self.energy = Some((own, place)),
            Some((energy, first)) if own != energy => {
                let message = format!(
                    "this has the dimension {own}, and the rest of the Lagrangian has {energy}"
                );
                self.found
                    .push(mismatch(place, message).related(first, format!("this has {energy}")));
            }
            Some(_) => {}
        }
    }

    fn force(&mut self, coordinate: &str, checked: &Checked<'_>) {
        let (Some((energy, _)), Some(unit)) = (self.energy.clone(), self.unit_of(coordinate))
        else {
            return;
        };
        let wanted = energy.over(&unit.dimension);
        self.compare_kind(
            checked,
            &wanted,
            &format!("the force on `{coordinate}` has the dimension of L/{coordinate},"),
        );
    }

    /// Rayleigh's function.
    fn rate_of_energy(&mut self, checked: &Checked<'_>) {
        let Some((energy, _)) = self.energy.clone() else {
            return;
        };
        let wanted = energy.over(&Dimension::time());
        self.compare_kind(
            checked,
            &wanted,
            "Rayleigh's function has the dimension of L/t,",
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
