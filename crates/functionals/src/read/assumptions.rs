//! What a file assumes of fields, data and parameters: `assumptions = ["E > 0", "det(delta_ij + u_i,j) > 0"]`.

use super::Reader;
use crate::notation::{check, parse_comparison};
use crate::tensors::Scope;
use chetaev_model::raw::Table;
use chetaev_model::{Diagnostic, Text};
use chetaev_symbolic::zero::assumptions::{is_contradicted, Assumption, Assumptions};
use chetaev_symbolic::zero::known_sign;
use std::collections::BTreeMap;

impl Reader<'_> {
    /// The comparisons as written; the space assumes them.
    pub(super) fn assumptions(&mut self, table: &Table, scope: &Scope) -> Vec<String> {
        let stated = table.get("assumptions");
        let stated = stated.map_or(Vec::new(), |raw| self.texts(raw, "assumptions"));
        let own = stated.into_iter();
        own.filter(|text| self.assumption(scope, text))
            .map(|text| text.content)
            .collect()
    }

    /// Whether a comparison says something about what is not known.
    fn assumption(&mut self, scope: &Scope, text: &Text) -> bool {
        let mut found = Vec::new();
        let read = parse_comparison(&text.content, scope, &mut found);
        if let (Some((sides, _)), true) = (&read, found.is_empty()) {
            for side in sides {
                check(side, &[], scope, &mut found);
                super::symmetry::check(scope, side, &mut found);
            }
        }
        if !self.add(text, &found) {
            return false;
        }
        let Some((sides, relations)) = read else {
            return false;
        };
        let nowhere = BTreeMap::new();
        let sides: Vec<_> = sides.iter().map(|s| scope.value(s, &nowhere)).collect();
        if !self.is_real(scope, &sides, text) {
            return false;
        }
        let mut says = false;
        for (pair, &relation) in sides.windows(2).zip(&relations) {
            let (left, right) = (pair[0], pair[1]);
            let g = &scope.space.graph;
            let sign = known_sign(g, g.sub(left, right), &Assumptions::new());
            if is_contradicted(relation, sign) {
                let message = format!("`{}` is false for the values of this model", text.content);
                self.push(
                    Diagnostic::error("false-assumption", text.place, message)
                        .hint("change the value, or the assumption"),
                );
                return false;
            }
            if is_contradicted(relation, scope.space.sign(g.sub(left, right))) {
                let message = format!("`{}` contradicts what is assumed before it", text.content);
                self.push(
                    Diagnostic::error("false-assumption", text.place, message)
                        .hint("the box of [domain] intervals is assumed too"),
                );
                return false;
            }
            if !scope.space.symbols_in(&[left, right]).is_empty() {
                says = true;
                scope.space.assume(Assumption {
                    left,
                    relation,
                    right,
                });
            }
        }
        says
    }
}
