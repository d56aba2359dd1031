//! Steady motions that the user names: `[steady.NAME]` with positions and velocities, `phi = 0`, `"x'" = "v"`, `theta = { guess = 1 }`.

use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Initial, SteadyStated};
use crate::raw::{Kind, Table};

impl Resolver {
    /// Every steady motion that is stated, in the order of the file.
    pub(crate) fn steady(&mut self, root: &Table) -> Vec<SteadyStated> {
        let mut motions: Vec<SteadyStated> = Vec::new();
        let Some(table) = self.section(root, "steady") else {
            return motions;
        };
        for (key, raw) in &table.entries {
            let Kind::Table(stated) = &raw.kind else {
                let wanted = "a table of positions and velocities by coordinate";
                self.wrong_kind(raw, &format!("`steady.{}`", key.content), wanted);
                continue;
            };
            for instance in self.own_names(key, "a steady motion") {
                let values = self.state(stated);
                motions.push(SteadyStated {
                    name: instance.name,
                    values: values.values,
                    place: key.place,
                });
            }
        }
        motions
    }

    /// Positions and velocities, as initial data are given.
    fn state(&mut self, table: &Table) -> Initial {
        let mut state = Initial::default();
        let what = "a value of a steady motion";
        for (key, raw) in &table.entries {
            let Some((value, is_guess)) = self.value_or_guess(raw, what) else {
                continue;
            };
            let Some(text) = self.expression_text(value, what) else {
                continue;
            };
            for instance in self.instances(key, what, &[]) {
                let own = self
                    .coordinates
                    .iter()
                    .position(|c| c.name == instance.name);
                match own.filter(|_| instance.order <= 1) {
                    Some(coordinate) => {
                        self.initial_coordinate(
                            key,
                            (&text, is_guess),
                            &instance,
                            coordinate,
                            &mut state,
                        );
                    }
                    None => {
                        let message =
                            format!("`{}` is neither a coordinate nor a velocity", key.content);
                        self.push(
                            Diagnostic::error("unknown-name", key.place, message)
                                .hint("a steady motion is given by positions and velocities, as phi = 0 and \"x'\" = \"v\""),
                        );
                    }
                }
            }
        }
        state
    }
}
