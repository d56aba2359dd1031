//! Names that mean something in every functional, and names that are declared twice.

use super::Reader;
use crate::boundary::CURVATURE;
use crate::notation::Names;
use crate::tensors::{Scope, DETERMINANT};
use chetaev_model::{Diagnostic, Place, Text};
use chetaev_symbolic::Function;

/// What a name means in every functional; `None` where it is free.
fn meaning(name: &str) -> Option<String> {
    let own = match name {
        "n" => "the outward normal",
        "delta" => "the unit tensor",
        "epsilon" => "the permutation symbol",
        CURVATURE => "the curvature of the boundary",
        DETERMINANT => "the determinant of a tensor",
        "pi" => "the number π",
        "sum" => "the sign of a sum",
        "sqrt" => "the square root",
        "ln" => "the natural logarithm",
        _ => {
            let function = Function::ALL.into_iter().find(|f| f.name() == name)?;
            return Some(format!("the function {}", function.name()));
        }
    };
    Some(own.to_owned())
}

/// What a name means in this one, as its space is stated.
fn meaning_in(scope: &Scope, name: &str) -> Option<String> {
    let is_family = |letter: &str| {
        let first = scope.space.coordinates.first();
        first.is_some_and(|c| c.name == format!("{letter}_1"))
    };
    if let Some(axis) = scope.coordinate(name) {
        let is_time = scope.space.coordinates[axis].is_time;
        let kind = if is_time { "the time" } else { "a coordinate" };
        return Some(kind.to_owned());
    }
    if name == "d" && scope.sizes.contains_key(name) {
        return Some("the number of dimensions".to_owned());
    }
    if scope.sizes.contains_key(name) {
        return Some("a size".to_owned());
    }
    is_family(name).then(|| "the place".to_owned())
}

impl Reader<'_> {
    /// Whether a name that a file declares means nothing yet; else what it means is said.
    pub(super) fn is_unknown(&mut self, scope: &Scope, name: &str, place: Place) -> bool {
        if let Some(own) = meaning(name).or_else(|| meaning_in(scope, name)) {
            self.is_reserved(name, place, &own);
            return false;
        }
        let is_declared = scope.rank(name).is_some();
        if is_declared {
            self.is_twice(name, place);
        }
        !is_declared
    }

    pub(super) fn is_twice(&mut self, name: &str, place: Place) {
        let message = format!("`{name}` is declared twice");
        self.push(Diagnostic::error("declared-twice", place, message));
    }

    /// Sizes and independent variables have no names that mean something already.
    pub(super) fn is_free(&mut self, key: &Text) -> bool {
        let own = meaning(&key.content);
        if let Some(own) = &own {
            self.is_reserved(&key.content, key.place, own);
        }
        own.is_none()
    }

    fn is_reserved(&mut self, name: &str, place: Place, meaning: &str) {
        self.push(
            Diagnostic::error(
                "reserved-name",
                place,
                format!("`{name}` is {meaning}; choose another name"),
            )
            .hint("a name never means two things"),
        );
    }

    /// Whether a name was refused since: what is written with it would be misread.
    pub(super) fn has_refused_names(&self, since: usize) -> bool {
        let mut own = self.problems.iter().skip(since);
        own.any(|d| matches!(d.code, "reserved-name" | "declared-twice"))
    }
}
