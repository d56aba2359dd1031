//! What a participant is asked.

use serde_json::Value;

/// The request `prepare`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// `derive`, `rhs`, `trajectory`, `ensemble`, `drift`, `main-job` or `table`.
    pub item: String,
    /// `disc`, `snake-8`, …; of `table` a row, as `p4p`.
    pub system: String,
    /// What of ours is measured: a formulation, `flow` for the product's own right-hand side; the method of a trajectory.
    pub variant: String,
    /// Whether many states are evaluated at once.
    pub batch: bool,
    /// Tolerance of an integration.
    pub tolerance: f64,
    /// States (q, v), to be answered for.
    pub states: Vec<Vec<f64>>,
    /// The state (q, v) where a trajectory starts.
    pub start: Vec<f64>,
    /// Where it ends.
    pub t_end: f64,
    /// Trajectories of an ensemble.
    pub count: usize,
    /// Steps of a long run.
    pub steps: u64,
    /// The folder of the repository.
    pub root: String,
    /// The command line of Chetaev.
    pub program: String,
    /// A folder for output that nobody reads.
    pub scratch: String,
}

impl Question {
    /// Reads a request; what is missing is empty.
    ///
    /// # Errors
    /// A request without item and system.
    pub fn read(asked: &Value) -> Result<Question, String> {
        let text = |key: &str| asked[key].as_str().unwrap_or_default().to_string();
        let (item, system) = (text("item"), text("system"));
        if item.is_empty() || system.is_empty() {
            return Err("a request needs `item` and `system`".into());
        }
        let whole = text("variant");
        let (variant, batch) = match whole.strip_suffix(" batch") {
            Some(stem) => (stem.to_string(), true),
            None => (whole, false),
        };
        let rows = asked["states"].as_array().map(Vec::as_slice);
        Ok(Question {
            item,
            system,
            variant,
            batch,
            tolerance: asked["tolerance"].as_f64().unwrap_or(1e-9),
            states: rows.unwrap_or_default().iter().map(numbers).collect(),
            start: numbers(&asked["start"]),
            t_end: asked["t_end"].as_f64().unwrap_or(1.0),
            count: asked["count"].as_u64().unwrap_or(1) as usize,
            steps: asked["steps"].as_u64().unwrap_or(1000),
            program: text("program"),
            scratch: text("scratch"),
            root: match text("root") {
                root if root.is_empty() => ".".into(),
                root => root,
            },
        })
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().map(Vec::as_slice).unwrap_or_default();
    list.iter().filter_map(Value::as_f64).collect()
}
