//! Where fields and data live: one that is declared on a piece of the boundary has no values anywhere else.

use super::Reader;
use crate::functional::{Equation, Field, Piece, Side};
use crate::space::Space;
use crate::tensors::Scope;
use chetaev_model::raw::Table;
use chetaev_model::{Diagnostic, Place, Text};
use chetaev_symbolic::syntax::names::closest;
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

/// The fields and data of pieces of the boundary.
pub(super) struct Living<'s> {
    space: &'s Space,
    /// The names with their pieces.
    pieces: BTreeMap<String, String>,
    /// The variables that are constant on flat pieces.
    across: BTreeMap<String, usize>,
}

impl<'s> Living<'s> {
    pub(super) fn of(
        scope: &'s Scope,
        data: &[Field],
        fields: &[Field],
        pieces: &[Piece],
    ) -> Living<'s> {
        let all = data.iter().chain(fields);
        let across = pieces.iter().filter_map(|piece| match piece.side {
            Side::Flat { axis, .. } => Some((piece.name.clone(), axis)),
            Side::Curved => None,
        });
        Living {
            across: across.collect(),
            space: &scope.space,
            pieces: all
                .filter_map(|own| Some((own.name.clone(), own.on.clone()?)))
                .collect(),
        }
    }

    /// A field or data of a flat piece that is differentiated across it: its name, and its piece.
    fn without_slope(&self, es: &[Expr]) -> Option<(&str, &str)> {
        let jets = self.space.jets_in(es);
        jets.iter().find_map(|jet| {
            let tensor = self.space.component_at(jet.component).tensor;
            let (name, on) = self.pieces.get_key_value(&tensor)?;
            let axis = self.across.get(on)?;
            jet.by
                .contains(axis)
                .then_some((name.as_str(), on.as_str()))
        })
    }

    /// A field or data in the expressions that has no values there: its name and its piece. Two pieces with a comma are where they meet.
    fn stranger(&self, es: &[Expr], there: Option<&str>) -> Option<(&str, &str)> {
        let names = there.into_iter().flat_map(|on| on.split(','));
        let there: Vec<&str> = names.map(str::trim).collect();
        let jets = self.space.jets_in(es);
        jets.iter().find_map(|jet| {
            let tensor = self.space.component_at(jet.component).tensor;
            let (name, on) = self.pieces.get_key_value(&tensor)?;
            (!there.contains(&on.as_str())).then_some((name.as_str(), on.as_str()))
        })
    }
}

impl Reader<'_> {
    /// The pieces on which fields and data are declared are pieces.
    pub(super) fn pieces_exist(&mut self, table: &Table, living: &Living<'_>, pieces: &[Piece]) {
        for (name, on) in &living.pieces {
            if pieces.iter().any(|piece| piece.name == *on) {
                continue;
            }
            let message =
                format!("`{on}`, on which `{name}` is declared, is not a piece of the boundary");
            let place = declaration(table, name).unwrap_or_default();
            let diagnostic = Diagnostic::error("unknown-piece", place, message);
            let near = closest(on, pieces.iter().map(|piece| piece.name.as_str()));
            self.push(match near {
                Some(near) => diagnostic.hint(format!("did you mean `{near}`?")),
                None => diagnostic.hint("[boundary] states the pieces"),
            });
        }
    }

    /// What stands in a text has values there: in the interior, or on a piece.
    pub(super) fn lives_there(
        &mut self,
        living: &Living<'_>,
        es: &[Expr],
        there: Option<&str>,
        text: &Text,
    ) {
        let Some((name, on)) = living.stranger(es, there) else {
            if let Some((name, on)) = living.without_slope(es) {
                let message =
                    format!("`{name}` lives on {on} only, and has no derivative across it");
                self.push(
                    Diagnostic::error("lives-elsewhere", within(text, name), message).hint(
                        format!("declare `{name}` without `on`, so that it lives everywhere"),
                    ),
                );
            }
            return;
        };
        let here = there.map_or_else(
            || "in the interior".to_owned(),
            |piece| format!("on {piece}"),
        );
        let message = format!("`{name}` lives on {on} only, and has no values {here}");
        let place = within(text, name);
        self.push(Diagnostic::error("lives-elsewhere", place, message).hint(format!(
            "declare `{name}` without `on`, so that it lives everywhere, or use it in what stands for {on}"
        )));
    }

    /// The densities of the pieces, and what is given on them.
    pub(super) fn boundary_lives(&mut self, table: &Table, living: &Living<'_>, pieces: &[Piece]) {
        let section = table.get("boundary").and_then(|raw| raw.table());
        for piece in pieces {
            let raw = section.and_then(|own| own.get(&piece.name));
            let density = raw.and_then(|raw| match raw.table() {
                Some(own) => own.get("density")?.expression(),
                None => raw.expression(),
            });
            if let Some(text) = density {
                self.lives_there(living, &[piece.density], Some(&piece.name), text);
            }
            let fixed = raw.and_then(|raw| raw.table()?.get("fixed"));
            let fixed = fixed.map_or(Vec::new(), |raw| self.texts(raw, "fixed"));
            for text in fixed {
                let name = text.content.split([',', '_']).next().unwrap_or_default();
                let own = |c: &usize| living.space.component_at(*c).tensor == name;
                let given = piece.fixed.iter().map(|(component, _)| *component);
                let given: Vec<Expr> = given
                    .filter(own)
                    .map(|component| living.space.jet(component, &[]))
                    .collect();
                self.lives_there(living, &given, Some(&piece.name), &text);
            }
        }
    }

    /// A stated equation, and its multiplier.
    pub(super) fn equation_lives(
        &mut self,
        table: &Table,
        living: &Living<'_>,
        equation: &Equation,
        raw: &chetaev_model::raw::Raw,
    ) {
        let text = match raw.table() {
            Some(own) => own.get("equation").and_then(|own| own.expression()),
            None => raw.expression(),
        };
        let on = equation.on.as_deref();
        if let Some(text) = text {
            self.lives_there(living, &equation.residuals, on, text);
        }
        let multipliers = table.get("multipliers").and_then(|raw| raw.table());
        let stated = multipliers.and_then(|own| own.get(&equation.label)?.expression());
        if let (Some((_, values)), Some(text)) = (&equation.multiplier, stated) {
            self.lives_there(living, values, on, text);
        }
    }
}

/// The place of a declaration under [data] or [fields].
fn declaration(table: &Table, name: &str) -> Option<Place> {
    let mut sections = ["fields", "data"].into_iter();
    sections.find_map(|key| {
        let entries = &table.get(key)?.table()?.entries;
        let (key, raw) = entries.iter().find(|(own, _)| own.content == name)?;
        let on = raw.table().and_then(|own| own.get("on"));
        Some(on.map_or(key.place, |on| on.place))
    })
}

/// The place of a name in a text; the whole text where a definition brings it in.
fn within(text: &Text, name: &str) -> Place {
    let is_part = |c: char| c.is_alphanumeric();
    let found = text.content.match_indices(name).find(|(at, _)| {
        let before = text.content[..*at].chars().next_back();
        let after = text.content[at + name.len()..].chars().next();
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    });
    match found {
        Some((at, own)) => text.place_of(Span::new(at, at + own.len())),
        None => text.place,
    }
}
