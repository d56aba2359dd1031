//! Steady motions that the user names: `[steady.NAME]` with positions and velocities, `phi = 0`, `"x'" = "v"`, `theta = { guess = 1 }`,
//! and the parameter over whose values they are judged, `over = "eps"`.

use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Initial, SteadyStated};
use crate::raw::{Kind, Table};
use crate::text::Text;
use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::Expr;

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
                let over = self.over(stated, &instance.bindings);
                motions.push(SteadyStated {
                    name: instance.name,
                    values: values.values,
                    over,
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
            if self.is_over(key) {
                continue;
            }
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

    /// Whether a key names the parameter over which a motion is judged, and is not the coordinate of that name.
    fn is_over(&self, key: &Text) -> bool {
        let mut coordinates = self.coordinates.iter();
        key.content == OVER && coordinates.all(|own| own.name != OVER)
    }

    /// The parameter over which a motion is judged.
    fn over(&mut self, table: &Table, bindings: &Bindings) -> Option<Expr> {
        let (_, raw) = table.entries.iter().find(|(key, _)| self.is_over(key))?;
        let Kind::Text(text) = &raw.kind else {
            self.wrong_kind(raw, "`over`", "the name of a parameter");
            return None;
        };
        let value = self.expression(
            text,
            bindings,
            Context::constant("`over`"),
            Expected::Anything,
        )?;
        let own = self.parameters.iter().find(|own| own.symbol == value);
        if let Some(parameter) = own {
            return Some(parameter.symbol);
        }
        let message = format!("`{}` is not the name of a parameter", text.content);
        self.push(Diagnostic::error("unknown-name", text.place, message));
        None
    }
}

/// The key of the parameter over which a motion is judged.
const OVER: &str = "over";
