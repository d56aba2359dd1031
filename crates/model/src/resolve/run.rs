//! The motion asked for: initial data, simulation, and what is expected of it.

use chetaev_symbolic::{Expr, Rational};

use super::declare::Instance;
use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{
    Constraint, Expect, ExpectedStop, ExpectedVerdict, ExtraInitialValue, Initial, InitialValue,
    Output, Precision, Simulation, StateKind,
};
use crate::raw::{Kind, Raw, Table};
use crate::text::Text;

/// Words of the catalogue of verdicts.
const VERDICTS: [&str; 6] = [
    "proved",
    "numerical",
    "refuted",
    "conditional",
    "not-applicable",
    "undecided",
];

/// What may occur in initial data.
const INITIAL: Context = Context::constant("the initial data");

impl Resolver {
    // ---- initial data

    pub(crate) fn initial(&mut self, root: &Table, constraints: &[Constraint]) -> Initial {
        let mut initial = Initial::default();
        let Some(table) = self.section(root, "initial") else {
            return initial;
        };
        for (key, raw) in &table.entries {
            if key.content == "project" && !self.names.contains_key("project") {
                initial.project = self.optional_truth(table, "project").unwrap_or(false);
                continue;
            }
            if key.content == "branch" && !self.names.contains_key("branch") {
                let branch = self.count(raw, "the number of a branch");
                initial.branch = branch.map(|branch| branch as usize);
                continue;
            }
            let Some((value, is_guess)) = self.value_or_guess(raw, "an initial value") else {
                continue;
            };
            let Some(text) = self.expression_text(value, "an initial value") else {
                continue;
            };
            for instance in self.instances(key, "an initial value", &[]) {
                let stated = (&text, is_guess);
                if !self.initial_value(key, stated, &instance, constraints, &mut initial) {
                    break;
                }
            }
        }
        initial
    }

    /// A value, or the one in `{ guess = -1.8 }`, and whether it is a guess.
    pub(super) fn value_or_guess<'r>(
        &mut self,
        raw: &'r Raw,
        what: &str,
    ) -> Option<(&'r Raw, bool)> {
        let Kind::Table(table) = &raw.kind else {
            return Some((raw, false));
        };
        self.known_keys(table, &["guess"], &format!("of {what}"));
        let guess = table.get("guess");
        if guess.is_none() {
            self.push(Diagnostic::error(
                "missing-value",
                raw.place,
                format!("{what} is a number, an expression of parameters, or `{{ guess = … }}`, near which it is searched for"),
            ));
        }
        guess.map(|guess| (guess, true))
    }

    /// Whether the other instances of the key are worth looking at.
    fn initial_value(
        &mut self,
        key: &Text,
        (text, is_guess): (&Text, bool),
        instance: &Instance,
        constraints: &[Constraint],
        initial: &mut Initial,
    ) -> bool {
        let name = &instance.name;
        let coordinate = self.coordinates.iter().position(|own| own.name == *name);
        if let Some(coordinate) = coordinate {
            return self.initial_coordinate(key, (text, is_guess), instance, coordinate, initial);
        }
        let multiplier = name
            .strip_prefix("lambda_")
            .or_else(|| name.strip_prefix("kappa_"));
        if let Some(of) = multiplier {
            if is_guess {
                let message = "a guess can be given for coordinates and velocities only";
                self.push(Diagnostic::error("not-a-guess", key.place, message));
            } else if constraints.iter().any(|constraint| constraint.name == of) {
                self.initial_multiplier(key, text, instance, initial);
            } else {
                let message = format!("there is no constraint `{of}` with such a multiplier");
                self.push(Diagnostic::error("unknown-name", key.place, message));
            }
            return true;
        }
        let because = "initial data are those of coordinates and their derivatives";
        self.no_coordinate(key, name, because);
        false
    }

    pub(super) fn initial_coordinate(
        &mut self,
        key: &Text,
        (text, is_guess): (&Text, bool),
        instance: &Instance,
        coordinate: usize,
        initial: &mut Initial,
    ) -> bool {
        let at = (coordinate, instance.order);
        if let Some(earlier) = initial.values.get(&at).map(|earlier| earlier.place) {
            let message = format!("the initial value of `{}` is given twice", key.content);
            self.push(
                Diagnostic::error("stated-twice", key.place, message)
                    .related(earlier, "first here"),
            );
            return false;
        }
        if is_guess && instance.order > 1 {
            let message = "a guess can be given for coordinates and velocities only";
            self.push(Diagnostic::error("not-a-guess", key.place, message));
            return false;
        }
        let expected = Expected::Quantity(instance.name.clone(), instance.order);
        if let Some(value) = self.expression(text, &instance.bindings, INITIAL, expected) {
            let text = text.content.clone();
            let place = key.place;
            let stated = InitialValue {
                value,
                text,
                is_guess,
                place,
            };
            initial.values.insert(at, stated);
        }
        true
    }

    fn initial_multiplier(
        &mut self,
        key: &Text,
        text: &Text,
        instance: &Instance,
        initial: &mut Initial,
    ) {
        let value = self.expression(text, &instance.bindings, INITIAL, Expected::Anything);
        if let Some(value) = value {
            initial.extra.push(ExtraInitialValue {
                name: instance.name.clone(),
                order: instance.order,
                value,
                place: key.place,
            });
        }
    }

    // ---- simulation

    pub(crate) fn simulation(&mut self, root: &Table) -> Simulation {
        const KEYS: &[&str] = &[
            "t_start",
            "t_end",
            "tolerance",
            "absolute_tolerance",
            "step",
            "method",
            "precision",
            "output",
            "max_steps",
            "state",
            "project",
            "keep_integrals",
            "crossings",
        ];
        let mut simulation = Simulation::default();
        let Some(table) = self.section(root, "simulation") else {
            return simulation;
        };
        self.known_keys(table, KEYS, "of [simulation]");
        let given = KEYS
            .iter()
            .filter_map(|key| table.get(key).map(|raw| (*key, raw.place)));
        simulation.places = given.collect();
        simulation.t_start = self.time_value(table.get("t_start"), "the start of the run");
        simulation.t_end = self.time_value(table.get("t_end"), "the end of the run");
        let words = Precision::WORDS.map(|(word, _)| word);
        let precision = self.word_of(table, "precision", &words);
        let precision = precision.and_then(|word| {
            let mut known = Precision::WORDS.into_iter();
            known.find(|(known, _)| *known == word)
        });
        simulation.precision = precision.map(|(_, precision)| precision);
        simulation.tolerance = self.tolerance(table, "tolerance", "the tolerance");
        simulation.absolute_tolerance =
            self.tolerance(table, "absolute_tolerance", "the absolute tolerance");
        simulation.step = self.time_value(table.get("step"), "the step");
        simulation.method = self.optional_text(table, "method").map(|text| text.content);
        simulation.output = table.get("output").and_then(|raw| self.output(raw));
        if let (Some(raw), Some(Output::Times(times))) = (table.get("output"), &simulation.output) {
            self.check_times(raw, times, &simulation);
        }
        simulation.project = self.optional_truth(table, "project");
        simulation.keep_integrals = self.optional_truth(table, "keep_integrals");
        simulation.crossings = match table.get("crossings") {
            Some(raw) => self.crossings(raw),
            None => Vec::new(),
        };
        simulation.max_steps = table
            .get("max_steps")
            .and_then(|raw| self.count(raw, "the number of steps"));
        simulation.state =
            self.word_of(table, "state", &["reduced", "full"])
                .map(|word| match word {
                    "full" => StateKind::Full,
                    _ => StateKind::Reduced,
                });
        simulation
    }

    /// `crossings = ["y = 0", "y = x^2"]`.
    fn crossings(&mut self, raw: &Raw) -> Vec<(String, Expr)> {
        let context = Context::state("where a motion goes on");
        let equations = self.equations_of_list(raw, "`crossings`", &Vec::new(), context);
        let g = &self.graph;
        let difference = |(text, left, right)| (text, g.sub(left, right));
        equations.into_iter().map(difference).collect()
    }

    fn time_value(
        &mut self,
        raw: Option<&Raw>,
        what: &'static str,
    ) -> Option<chetaev_symbolic::Expr> {
        let text = self.expression_text(raw?, what)?;
        self.expression(&text, &Vec::new(), Context::constant(what), Expected::Time)
    }

    fn tolerance(&mut self, table: &Table, key: &str, what: &'static str) -> Option<Rational> {
        let raw = table.get(key)?;
        let value = self.rational(raw, what)?;
        if value <= Rational::ZERO {
            self.push(Diagnostic::error(
                "not-positive",
                raw.place,
                format!("{what} must be positive"),
            ));
            return None;
        }
        let number = chetaev_symbolic::rational::to_f64(&value);
        let of_series = table.get("method").is_some_and(|raw| {
            matches!(&raw.kind, Kind::Text(text) if text.content.eq_ignore_ascii_case("taylor"))
        });
        let of_precise = table.get("precision").is_some_and(
            |raw| matches!(&raw.kind, Kind::Text(text) if text.content == "double-double"),
        );
        let (sharpest, arithmetic) = match (of_precise, of_series) {
            (true, _) => (1e-28, "double-double arithmetic"),
            (false, true) => (2.3e-16, "double precision"),
            (false, false) => (2.3e-14, "double precision"),
        };
        // An absolute tolerance has units: no number is too small or too large for it by itself.
        let has_units = key == "absolute_tolerance" && !of_precise;
        if !has_units && !(sharpest..=0.1).contains(&number) {
            let message = format!(
                "{what} is out of range: it must lie between {sharpest:e} ({arithmetic}) and 0.1"
            );
            let mut problem = Diagnostic::error("out-of-range", raw.place, message);
            if !of_precise {
                problem = problem.hint(match of_series {
                    true => "`precision = \"double-double\"` goes down to 1e-28",
                    false => "`method = \"taylor\"` goes down to 2.3e-16, with `precision = \"double-double\"` to 1e-28",
                });
            }
            self.push(problem);
            return None;
        }
        Some(value)
    }

    pub(crate) fn count(&mut self, raw: &Raw, what: &'static str) -> Option<u64> {
        let value = self.integer(raw, what)?;
        let count = u64::try_from(value).ok().filter(|count| *count > 0);
        if count.is_none() {
            self.push(Diagnostic::error(
                "not-positive",
                raw.place,
                format!("{what} must be positive"),
            ));
        }
        count
    }

    fn output(&mut self, raw: &Raw) -> Option<Output> {
        const ADVICE: &str = "`output` is a number of intervals, or one of { step = … }, { times = […] }, { points = … }";
        let points = |resolver: &mut Self, raw: &Raw| {
            let count = resolver.count(raw, "the number of output intervals")?;
            u32::try_from(count).ok().map(Output::Points)
        };
        let Some(table) = raw.table() else {
            return points(self, raw);
        };
        self.known_keys(table, &["points", "times", "step"], "of `output`");
        match table.entries.as_slice() {
            [(key, raw)] if key.content == "points" => points(self, raw),
            [(key, raw)] if key.content == "step" => self
                .time_value(Some(raw), "the output step")
                .map(Output::Step),
            [(
                key,
                Raw {
                    kind: Kind::Array(items),
                    ..
                },
            )] if key.content == "times" => {
                let times: Vec<_> = items
                    .iter()
                    .map(|item| self.time_value(Some(item), "an output time"))
                    .collect();
                times
                    .into_iter()
                    .collect::<Option<Vec<_>>>()
                    .map(Output::Times)
            }
            _ => {
                self.push(Diagnostic::error("wrong-kind", raw.place, ADVICE));
                None
            }
        }
    }

    /// Output times follow each other in the direction of the run and lie within it, as far as all are known.
    fn check_times(&mut self, raw: &Raw, times: &[Expr], simulation: &Simulation) {
        let Some(Raw {
            kind: Kind::Array(items),
            ..
        }) = raw.table().and_then(|table| table.get("times"))
        else {
            return;
        };
        let Some(values) = self.known_values(times) else {
            return;
        };
        let ends = simulation
            .t_end
            .and_then(|end| self.known_values(&[end]))
            .map(|end| end[0]);
        let start = match simulation.t_start {
            None => Some(0.0),
            Some(start) => self.known_values(&[start]).map(|start| start[0]),
        };
        let is_backward = matches!((start, ends), (Some(start), Some(end)) if end < start);
        let sign = if is_backward { -1.0 } else { 1.0 };
        for (i, (item, &time)) in items.iter().zip(&values).enumerate() {
            let message = if i > 0 && sign * time <= sign * values[i - 1] {
                let before = values[i - 1];
                format!("the output times must follow each other in the direction of the run, and {time} follows {before}")
            } else if start.is_some_and(|start| sign * time < sign * start) {
                format!("the output time {time} lies before the start of the run")
            } else if ends.is_some_and(|end| sign * time > sign * end) {
                format!("the output time {time} lies after the end of the run")
            } else {
                continue;
            };
            self.push(Diagnostic::error("out-of-range", item.place, message));
        }
    }

    // ---- expectations

    pub(crate) fn expect(&mut self, root: &Table) -> Expect {
        let mut expect = Expect::default();
        let Some(table) = self.section(root, "expect") else {
            return expect;
        };
        // Dotted keys are tables within tables; the claim id is put together again.
        let mut open: Vec<(String, &Text, &Raw)> = table
            .entries
            .iter()
            .rev()
            .map(|(key, raw)| (key.content.clone(), key, raw))
            .collect();
        while let Some((claim, key, raw)) = open.pop() {
            if claim == "stop" {
                expect.stop = self.expected_stop(raw);
                continue;
            }
            if let Kind::Table(inner) = &raw.kind {
                let longer = inner
                    .entries
                    .iter()
                    .rev()
                    .map(|(key, raw)| (format!("{claim}.{}", key.content), key, raw));
                open.extend(longer);
                continue;
            }
            let verdicts = self.verdicts(raw);
            if verdicts.is_empty() {
                continue;
            }
            let (id, subject) = match claim.split_once('#') {
                Some((id, subject)) => (id.to_owned(), Some(subject.to_owned())),
                None => (claim, None),
            };
            expect.verdicts.push(ExpectedVerdict {
                claim: id,
                subject,
                verdicts,
                place: key.place,
            });
        }
        expect
    }

    fn verdicts(&mut self, raw: &Raw) -> Vec<String> {
        let items: Vec<&Raw> = match &raw.kind {
            Kind::Array(items) => items.iter().collect(),
            _ => vec![raw],
        };
        let mut verdicts = Vec::new();
        for item in items {
            match &item.kind {
                Kind::Text(text) if VERDICTS.contains(&text.content.as_str()) => {
                    verdicts.push(text.content.clone())
                }
                Kind::Text(text) => {
                    let message = format!("`{}` is no verdict", text.content);
                    let mut diagnostic = Diagnostic::error("unknown-value", text.place, message);
                    diagnostic =
                        match chetaev_symbolic::syntax::names::closest(&text.content, VERDICTS) {
                            Some(near) => diagnostic.hint(format!("did you mean \"{near}\"?")),
                            None => diagnostic.hint(format!("one of {}", VERDICTS.join(", "))),
                        };
                    self.push(diagnostic);
                }
                _ => self.wrong_kind(item, "an expected verdict", "a text such as \"proved\""),
            }
        }
        verdicts
    }

    fn expected_stop(&mut self, raw: &Raw) -> Option<ExpectedStop> {
        let place = raw.place;
        match &raw.kind {
            Kind::Truth(true) => Some(ExpectedStop {
                at: None,
                reason: String::new(),
                place,
            }),
            Kind::Truth(false) => None,
            Kind::Text(text) => Some(ExpectedStop {
                at: None,
                reason: text.content.clone(),
                place,
            }),
            Kind::Table(table) => {
                self.known_keys(table, &["at", "reason"], "of an expected stop");
                let at = self.time_value(table.get("at"), "the time of the stop");
                let reason = self
                    .optional_text(table, "reason")
                    .map_or_else(String::new, |text| text.content);
                Some(ExpectedStop { at, reason, place })
            }
            _ => {
                self.wrong_kind(
                    raw,
                    "`stop`",
                    "true, a word of the reason, or a table with `at` and `reason`",
                );
                None
            }
        }
    }
}
