//! A model stated in Rust: the same content as the file, through the same reader.

use toml_edit::{value, Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

use crate::load::{load, Loaded};
use crate::source::NoFiles;

/// States a model piece by piece; every expression is a text as in the model file.
///
/// The builder writes the file that a person would have written, and [`ModelBuilder::build`] reads it, so that both
/// ways have the same meaning and the same diagnostics, and a study can keep the text.
///
/// ```
/// use chetaev_model::ModelBuilder;
///
/// let loaded = ModelBuilder::new("skate")
///     .coordinates(["x", "y", "phi"])
///     .parameter("m", "1")
///     .parameter("J", "2/5")
///     .assumption("m > 0")
///     .kinetic("1/2 m (x'^2 + y'^2) + 1/2 J phi'^2")
///     .constraint("blade", "y' cos(phi) = x' sin(phi)")
///     .initial("x'", "1")
///     .end("10")
///     .build();
/// let (model, _) = loaded.into_result().unwrap();
/// assert_eq!(model.constraints[0].name, "blade");
/// ```
#[derive(Clone, Debug)]
pub struct ModelBuilder {
    document: DocumentMut,
    overrides: Vec<(String, String)>,
}

impl ModelBuilder {
    /// A model of this name without any content.
    pub fn new(name: &str) -> Self {
        let mut document = DocumentMut::new();
        document.insert("name", value(name));
        ModelBuilder {
            document,
            overrides: Vec::new(),
        }
    }

    fn set(mut self, section: &str, key: &str, item: impl Into<Value>) -> Self {
        let table = self
            .document
            .entry(section)
            .or_insert_with(|| Item::Table(Table::new()));
        if let Some(table) = table.as_table_mut() {
            table.insert(key, Item::Value(item.into()));
        }
        self
    }

    /// A table in a section, written as `[section.table]`.
    fn set_below(mut self, section: &str, table: &str, key: &str, item: impl Into<Value>) -> Self {
        let implicit = || {
            let mut own = Table::new();
            own.set_implicit(true);
            Item::Table(own)
        };
        let outer = self.document.entry(section).or_insert_with(implicit);
        let inner = outer.as_table_mut().map(|outer| {
            outer
                .entry(table)
                .or_insert_with(|| Item::Table(Table::new()))
        });
        if let Some(inner) = inner.and_then(Item::as_table_mut) {
            inner.insert(key, Item::Value(item.into()));
        }
        self
    }

    fn append(mut self, key: &str, items: impl IntoIterator<Item = impl AsRef<str>>) -> Self {
        let array = self
            .document
            .entry(key)
            .or_insert_with(|| value(Array::new()));
        if let Some(array) = array.as_array_mut() {
            for item in items {
                array.push(item.as_ref());
            }
        }
        self
    }

    /// One paragraph about the system.
    #[must_use]
    pub fn description(mut self, text: &str) -> Self {
        self.document.insert("description", value(text));
        self
    }

    /// A reference.
    #[must_use]
    pub fn source(self, reference: &str) -> Self {
        self.append("source", [reference])
    }

    /// Its short history.
    #[must_use]
    pub fn history(mut self, text: &str) -> Self {
        self.document.insert("history", value(text));
        self
    }

    /// Coordinates without units.
    #[must_use]
    pub fn coordinates(self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Self {
        self.append("coordinates", names)
    }

    /// A coordinate with its unit; all coordinates are then stated in this way.
    #[must_use]
    pub fn coordinate(self, name: &str, unit: &str) -> Self {
        self.set("coordinates", name, unit)
    }

    /// A parameter with its value, an exact expression.
    #[must_use]
    pub fn parameter(self, name: &str, value: &str) -> Self {
        self.set("parameters", name, value)
    }

    /// A parameter with its value and unit.
    #[must_use]
    pub fn parameter_with_unit(self, name: &str, value: &str, unit: &str) -> Self {
        self.set(
            "parameters",
            name,
            InlineTable::from_iter([("value", value), ("unit", unit)]),
        )
    }

    /// A parameter without value: it stays a symbol.
    #[must_use]
    pub fn symbolic_parameter(self, name: &str) -> Self {
        self.set("parameters", name, InlineTable::new())
    }

    /// An assumption such as `m > 0`.
    #[must_use]
    pub fn assumption(self, comparison: &str) -> Self {
        self.append("assumptions", [comparison])
    }

    /// A named sub-expression.
    #[must_use]
    pub fn define(self, name: &str, expression: &str) -> Self {
        self.set("define", name, expression)
    }

    /// The kinetic energy.
    #[must_use]
    pub fn kinetic(self, expression: &str) -> Self {
        self.set("lagrangian", "T", expression)
    }

    /// The potential energy.
    #[must_use]
    pub fn potential(self, expression: &str) -> Self {
        self.set("lagrangian", "V", expression)
    }

    /// The Lagrangian itself.
    #[must_use]
    pub fn lagrangian(self, expression: &str) -> Self {
        self.set("lagrangian", "L", expression)
    }

    /// A particle with its mass and the components of its position, one to three.
    #[must_use]
    pub fn particle(
        self,
        name: &str,
        mass: &str,
        position: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Self {
        self.set_below("particles", name, "mass", mass).set_below(
            "particles",
            name,
            "position",
            array_of(position),
        )
    }

    /// The applied force on a particle, as many components as its position has.
    #[must_use]
    pub fn particle_force(
        self,
        name: &str,
        force: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Self {
        self.set_below("particles", name, "force", array_of(force))
    }

    /// The thrust of a particle, as a TOML value: `{ exhaust_speed = "c" }`, or a word.
    ///
    /// A value that is no TOML is taken as a word.
    #[must_use]
    pub fn particle_thrust(self, name: &str, thrust: &str) -> Self {
        let value = thrust.parse::<Value>();
        let value = value.unwrap_or_else(|_| Value::from(thrust));
        self.set_below("particles", name, "thrust", value)
    }

    /// A definition that counts as a mass.
    #[must_use]
    pub fn mass(self, name: &str, expression: &str) -> Self {
        self.set("masses", name, expression)
    }

    /// A mass with a law of its own, its rate, and its value at the start.
    #[must_use]
    pub fn mass_with_law(self, name: &str, rate: &str, initial: &str) -> Self {
        let law = InlineTable::from_iter([("rate", rate), ("initial", initial)]);
        self.set("masses", name, law)
    }

    /// The reactive force on a coordinate, for a model that states T.
    #[must_use]
    pub fn reactive_force(self, coordinate: &str, expression: &str) -> Self {
        self.set("reactive_forces", coordinate, expression)
    }

    /// The generalized force on a coordinate.
    #[must_use]
    pub fn force(self, coordinate: &str, expression: &str) -> Self {
        self.set("forces", coordinate, expression)
    }

    /// Rayleigh's dissipation function.
    #[must_use]
    pub fn rayleigh(self, expression: &str) -> Self {
        self.set("forces", "rayleigh", expression)
    }

    /// A named constraint `left = right`.
    #[must_use]
    pub fn constraint(self, name: &str, equation: &str) -> Self {
        self.set("constraints", name, equation)
    }

    /// The coordinates whose velocities are to be the independent ones.
    #[must_use]
    pub fn independent(self, velocities: impl IntoIterator<Item = impl AsRef<str>>) -> Self {
        self.set("velocities", "independent", array_of(velocities))
    }

    /// A quasi-velocity.
    #[must_use]
    pub fn quasi_velocity(self, name: &str, expression: &str) -> Self {
        self.set("quasi_velocities", name, expression)
    }

    /// A field of the frame, named by its quasi-velocity, from pairs of a coordinate and the component along it.
    #[must_use]
    pub fn frame_field(self, name: &str, components: &[(&str, &str)]) -> Self {
        let field: InlineTable = components.iter().copied().collect();
        self.set_below("moving_frame", "fields", name, field)
    }

    /// The drift of the frame, from pairs of a coordinate and the component along it.
    #[must_use]
    pub fn frame_drift(self, components: &[(&str, &str)]) -> Self {
        let drift: InlineTable = components.iter().copied().collect();
        self.set("moving_frame", "drift", drift)
    }

    /// A control, a function of the time.
    #[must_use]
    pub fn control(self, name: &str, law: &str) -> Self {
        self.set("controls", name, law)
    }

    /// A given initial value, as in `initial("phi'", "2.1")`.
    #[must_use]
    pub fn initial(self, name: &str, value: &str) -> Self {
        self.set("initial", name, value)
    }

    /// Whether an inadmissible initial state may be projected.
    #[must_use]
    pub fn project_initial(self, project: bool) -> Self {
        self.set("initial", "project", project)
    }

    /// The end of the run.
    #[must_use]
    pub fn end(self, t_end: &str) -> Self {
        self.set("simulation", "t_end", t_end)
    }

    /// Any other text of `[simulation]`, such as `method`, or an expression, such as `tolerance`.
    #[must_use]
    pub fn simulation(self, key: &str, text: &str) -> Self {
        self.set("simulation", key, text)
    }

    /// A candidate first integral.
    #[must_use]
    pub fn integral(self, name: &str, expression: &str) -> Self {
        self.set("integrals", name, expression)
    }

    /// An expected verdict, as in `expect("energy.integral", "proved")`.
    #[must_use]
    pub fn expect(self, claim: &str, verdict: &str) -> Self {
        self.set("expect", claim, verdict)
    }

    /// A size.
    #[must_use]
    pub fn size(self, name: &str, size: i64) -> Self {
        self.set("sizes", name, size)
    }

    /// An index with its range, as in `index("i", "1..n")`.
    #[must_use]
    pub fn index(self, name: &str, range: &str) -> Self {
        self.set("indices", name, range)
    }

    /// A drawing element from pairs of a key and a TOML value, as in `("at", "[\"x\", \"y\"]")`.
    ///
    /// A value that is no TOML is taken as an expression or a word.
    #[must_use]
    pub fn draw(mut self, kind: &str, values: &[(&str, &str)]) -> Self {
        let drawing = self
            .document
            .entry("drawing")
            .or_insert_with(|| Item::Table(Table::new()));
        let mut element = Table::new();
        element.insert("kind", value(kind));
        for (key, text) in values {
            let parsed = text.parse::<Value>().unwrap_or_else(|_| Value::from(*text));
            element.insert(key, Item::Value(parsed));
        }
        if let Some(drawing) = drawing.as_table_mut() {
            let elements = drawing
                .entry("element")
                .or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
            if let Some(elements) = elements.as_array_of_tables_mut() {
                elements.push(element);
            }
        }
        self
    }

    /// Overrides a parameter or a size, as the command line does.
    #[must_use]
    pub fn with_override(mut self, name: &str, value: &str) -> Self {
        self.overrides.push((name.to_owned(), value.to_owned()));
        self
    }

    /// The text of the model file.
    pub fn to_toml(&self) -> String {
        self.document.to_string()
    }

    /// Reads the model that was stated.
    pub fn build(&self) -> Loaded {
        let name = self
            .document
            .get("name")
            .and_then(Item::as_str)
            .unwrap_or("model");
        load(
            &format!("{name}.toml"),
            &self.to_toml(),
            &NoFiles,
            &self.overrides,
        )
    }
}

fn array_of(texts: impl IntoIterator<Item = impl AsRef<str>>) -> Array {
    texts
        .into_iter()
        .map(|text| text.as_ref().to_owned())
        .collect()
}
