//! Expressions of a finished model: what a check, a command line or a report asks about.

use chetaev_symbolic::syntax::{lower, parse_expression, Resolution, Scope, Span};
use chetaev_symbolic::Expr;

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::model::Model;
use crate::source::{Place, Sources};
use crate::text::Text;
use crate::where_clause::{self, Defined};

/// Highest derivative of a definition that is taken.
const MOST_DERIVATIVES: u32 = 8;

/// All names of a model: every quantity with its derivatives, definitions, and the multipliers of the constraints; and variables of a state that
/// is not the model's.
struct WholeModel<'m> {
    model: &'m Model,
    variables: &'m [String],
}

impl Scope for WholeModel<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        let model = self.model;
        let refused = |message: String| Resolution::Refused {
            code: "derivative-of-constant",
            message,
            hint: String::new(),
        };
        let multiplier = name
            .strip_prefix("lambda_")
            .or_else(|| name.strip_prefix("kappa_"));
        let is_multiplier = multiplier.is_some_and(|of| {
            model
                .constraints
                .iter()
                .any(|constraint| constraint.name == of)
        });
        let characteristics = model.characteristics.iter();
        let is_characteristic = characteristics
            .flat_map(|c| &c.parameters)
            .any(|own| own == name);
        if model.varies(name) || is_multiplier || is_characteristic {
            return Resolution::Known(model.graph.symbol(name, order));
        }
        if model.mass_rate(name).is_some() {
            let mass = model.graph.symbol(name, 0);
            let derived = (0..order).fold(mass, |value, _| model.total_derivative(value));
            return Resolution::Known(derived);
        }
        if name == "t"
            || model
                .parameters
                .iter()
                .any(|parameter| parameter.name == name)
        {
            return match order {
                0 => Resolution::Known(model.graph.symbol(name, 0)),
                _ => refused(format!("`{name}` has no derivative")),
            };
        }
        if let Some((_, value)) = model.sizes.iter().find(|(size, _)| size == name) {
            return match order {
                0 => Resolution::Known(model.graph.integer(*value)),
                _ => refused(format!("`{name}` is an integer and has no derivative")),
            };
        }
        let define = model
            .defines
            .iter()
            .chain(&model.quasi_velocities)
            .chain(&model.sensors)
            .find(|define| define.name == name);
        match define {
            Some(_) if order > MOST_DERIVATIVES => refused(format!(
                "derivatives of a definition are taken up to order {MOST_DERIVATIVES}"
            )),
            Some(define) => Resolution::Known(
                (0..order).fold(define.value, |value, _| model.total_derivative(value)),
            ),
            None if self.variables.iter().any(|own| own == name) => {
                Resolution::Known(model.graph.symbol(name, order))
            }
            None => Resolution::Unknown,
        }
    }

    fn names(&self) -> Vec<String> {
        let model = self.model;
        let coordinates = model.coordinates.iter().map(|own| &own.name);
        let parameters = model.parameters.iter().map(|own| &own.name);
        let defines = model
            .defines
            .iter()
            .chain(&model.quasi_velocities)
            .chain(&model.sensors)
            .map(|own| &own.name);
        let controls = model.controls.iter().map(|own| &own.name);
        let masses = model.masses.iter().map(|own| &own.name);
        let sizes = model.sizes.iter().map(|own| &own.0);
        let multipliers =
            (0..model.constraints.len()).map(|constraint| model.multiplier(constraint));
        coordinates
            .chain(parameters)
            .chain(defines)
            .chain(controls)
            .chain(masses)
            .chain(sizes)
            .chain(self.variables)
            .cloned()
            .chain(multipliers)
            .collect()
    }
}

impl Model {
    /// Reads an expression in which every name of the model may occur, with derivatives of any order; the multiplier
    /// `lambda_NAME` of a constraint is the symbol of that name. What is long may be written as it is printed, with names for its
    /// parts and their definitions, or the linear systems that determine them, below a line `where`.
    ///
    /// # Errors
    /// Everything that is wrong with the text, each at its place; the text is shown under the name `expression`.
    pub fn expression(&self, text: &str) -> Result<Expr, Diagnostics> {
        self.expression_in(text, &[])
    }

    /// The same, in which the variables of a state may occur that is not the model's, with derivatives of any order: quasi-velocities that were
    /// chosen, momenta. What the model calls by such a name is what it says.
    ///
    /// # Errors
    /// As [`expression`](Model::expression).
    pub fn expression_in(&self, text: &str, variables: &[String]) -> Result<Expr, Diagnostics> {
        self.labelled_expression("expression", text, variables)
    }

    fn labelled_expression(
        &self,
        label: &str,
        text: &str,
        variables: &[String],
    ) -> Result<Expr, Diagnostics> {
        let whole = WholeModel {
            model: self,
            variables,
        };
        match where_clause::split(text) {
            None => self.one_expression(label, text, &whole),
            Some((text, definitions)) => {
                let defined = Defined::new(&self.graph, &whole, &definitions)?;
                self.one_expression(label, &text, &defined)
            }
        }
    }

    fn one_expression(
        &self,
        label: &str,
        text: &str,
        scope: &dyn Scope,
    ) -> Result<Expr, Diagnostics> {
        let mut sources = Sources::default();
        let source = sources.add(label, text);
        let located = Text::verbatim(text, source, 0);
        let parsed = parse_expression(text);
        let mut found = parsed.diagnostics.clone();
        let value = lower(
            &self.graph,
            &parsed.tree,
            parsed.root(),
            scope,
            &[],
            &mut found,
        );
        let list = found
            .iter()
            .map(|diagnostic| Diagnostic::of_expression(diagnostic, &located))
            .collect();
        let diagnostics = Diagnostics { sources, list };
        match value {
            Some(value) if !diagnostics.has_errors() => Ok(value),
            _ => Err(diagnostics),
        }
    }

    /// The value of an expression of numbers and parameters, as the command line takes it: `2 pi`, `10 sqrt(l/g)`.
    ///
    /// # Errors
    /// Everything that is wrong with the text, at its place and under the name `label`: unknown names, names without a
    /// value, a value that is not finite.
    pub fn constant_value(&self, label: &str, text: &str) -> Result<f64, Diagnostics> {
        self.constant(label, text).map(|(_, value)| value)
    }

    /// The same with the expression itself, free of symbols, before its value.
    ///
    /// # Errors
    /// As [`constant_value`](Model::constant_value).
    pub fn constant(&self, label: &str, text: &str) -> Result<(Expr, f64), Diagnostics> {
        let value = self.labelled_expression(label, text, &[])?;
        let closed = self.graph.substitute(value, &self.parameter_values());
        let open: Vec<String> = self
            .graph
            .symbols_in(&[closed])
            .into_iter()
            .map(|symbol| format!("`{}`", self.graph.symbol_text(symbol)))
            .collect();
        let message = if open.is_empty() {
            match self.graph.evaluate_f64(&[closed], &|_| None) {
                Ok(values) if values[0].is_finite() => return Ok((closed, values[0])),
                _ => "this is not a finite real number".to_owned(),
            }
        } else {
            format!(
                "a number is needed here, and {} {} no value",
                open.join(", "),
                if open.len() == 1 { "has" } else { "have" }
            )
        };
        let mut sources = Sources::default();
        let source = sources.add(label, text);
        let place = Place {
            source,
            span: Span::new(0, text.len()),
        };
        let list = vec![Diagnostic::error("not-a-number", place, message)
            .hint("numbers, pi, functions and parameters with a value may stand here")];
        Err(Diagnostics { sources, list })
    }

    /// The total derivative with respect to the time of an expression of coordinates, controls, masses and t: a mass with a
    /// law of its own changes by its rate.
    pub fn total_derivative(&self, value: Expr) -> Expr {
        let graph = &self.graph;
        let rate = |symbol| {
            let (name, order) = (graph.symbol_name(symbol), graph.symbol_order(symbol));
            match order {
                0 if name == "t" => Some(graph.one()),
                _ if self.varies(name) => Some(graph.symbol(name, order + 1)),
                0 => self.mass_rate(name),
                _ => None,
            }
        };
        graph.derive(&[value], &rate).swap_remove(0)
    }

    /// What a computation of the motion needs and the model leaves open: values of parameters, laws of controls.
    ///
    /// A symbolic model is complete for derivations; these errors are for those who integrate.
    pub fn missing_for_motion(&self) -> Vec<Diagnostic> {
        let parameters = self
            .parameters
            .iter()
            .filter(|parameter| parameter.value.is_none())
            .map(|parameter| {
                let name = &parameter.name;
                let message =
                    format!("the parameter `{name}` has no value, and the motion needs one");
                Diagnostic::error("missing-value", parameter.place, message).hint(format!(
                    "state it under [parameters], or run with --set {name}=1"
                ))
            });
        let controls = self
            .controls
            .iter()
            .filter(|control| control.law.is_none())
            .map(|control| {
                let message = format!(
                    "the control `{}` has no law, and the motion needs one",
                    control.name
                );
                Diagnostic::error("missing-value", control.place, message)
                    .hint("state it under [controls] as a function of t")
            });
        parameters.chain(controls).collect()
    }
}
