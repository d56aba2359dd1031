//! From the text of a model to what is measured.

use chetaev::mechanics::{Equations, Formulation, MotionTerms, Selection, System};
use chetaev::model::{Model, NoFiles, Style};
use chetaev::motion::{consistent_state, Binding, ConsistentState, InitialData, NumericSystem};
use std::path::Path;

/// The text of a system's model and its overrides.
#[derive(Clone, Debug)]
pub struct Source {
    path: String,
    text: String,
    overrides: Vec<(String, String)>,
}

/// Where the models are that are not named as their system.
const MODELS: &[(&str, &str)] = &[
    ("sleigh", "gallery/chaplygin-sleigh/model.toml"),
    ("disc", "gallery/falling-rolling-disc/model.toml"),
    ("rattleback", "gallery/rattleback/model.toml"),
    ("bicycle", "gallery/whipple-bicycle/model.toml"),
    ("appell-hamel", "gallery/appell-hamel/model.toml"),
];

impl Source {
    /// Reads the text.
    ///
    /// # Errors
    /// An unknown system, or what the disk says.
    pub fn of(root: &str, system: &str) -> Result<Source, String> {
        let stated = MODELS.iter().find(|(name, _)| *name == system);
        let (path, overrides) = match (stated, system.strip_prefix("snake-")) {
            (Some((_, path)), _) => (*path, Vec::new()),
            (None, Some(size)) => (
                "bench/models/snake.toml",
                vec![("n".to_string(), size.to_string())],
            ),
            (None, None) => return Err(format!("there is no system `{system}`")),
        };
        let text = std::fs::read_to_string(Path::new(root).join(path));
        Ok(Source {
            text: text.map_err(|problem| format!("{path}: {problem}"))?,
            path: path.into(),
            overrides,
        })
    }

    /// The model, read anew.
    ///
    /// # Errors
    /// Its diagnostics.
    pub fn model(&self) -> Result<Model, String> {
        let loaded = chetaev::model::load(&self.path, &self.text, &NoFiles, &self.overrides);
        let read = loaded.into_result();
        Ok(read.map_err(|problems| problems.render(Style::Plain))?.0)
    }
}

/// A system with numbers and a start.
#[derive(Debug)]
pub struct Prepared {
    /// The system.
    pub system: System,
    /// Its terms.
    pub terms: MotionTerms,
    /// Values of its parameters.
    pub binding: Binding,
    /// Its compiled terms.
    pub numeric: NumericSystem,
    /// Where a motion starts.
    pub start: ConsistentState,
    /// Independent constraints and dependent velocities there.
    pub selection: Selection,
}

/// A problem in words.
pub fn words(problem: impl std::fmt::Display) -> String {
    problem.to_string()
}

impl Prepared {
    /// Derives and compiles the terms; the motion starts at (q, v) = `start`.
    ///
    /// # Errors
    /// What is wrong with the model or the start.
    pub fn new(source: &Source, start: &[f64]) -> Result<Prepared, String> {
        let model = source.model()?;
        let system = System::from_model(&model).map_err(words)?;
        let terms = MotionTerms::new(&system);
        let binding = Binding::new(&system).map_err(words)?;
        let mut numeric = NumericSystem::new(&system, &terms, &binding).map_err(words)?;
        let start = consistent(&mut numeric, start)?;
        let selection = Selection {
            rows: start.chart.rows.clone(),
            dependent: start.chart.dependent.clone(),
        };
        Ok(Prepared {
            system,
            terms,
            binding,
            numeric,
            start,
            selection,
        })
    }

    /// The equations of a formulation.
    ///
    /// # Errors
    /// Why there are none.
    pub fn equations(&self, name: &str) -> Result<Equations, String> {
        let formulation = by_name(name)?;
        let basis = chetaev::mechanics::Basis {
            system: &self.system,
            terms: &self.terms,
            selection: &self.selection,
            characteristics: None,
        };
        formulation.equations(&basis).map_err(words)
    }
}

fn by_name(name: &str) -> Result<&'static dyn Formulation, String> {
    let found = chetaev::mechanics::formulation(name);
    found.ok_or_else(|| format!("there is no formulation `{name}`"))
}

/// The state (q, v), which satisfies the constraints up to rounding.
///
/// # Errors
/// Where it does not.
pub fn consistent(numeric: &mut NumericSystem, state: &[f64]) -> Result<ConsistentState, String> {
    let n = numeric.n;
    if state.len() != 2 * n {
        return Err(format!(
            "a state has {} numbers, not {}",
            2 * n,
            state.len()
        ));
    }
    let data = InitialData {
        t: 0.0,
        q: state[..n].to_vec(),
        v: state[n..].to_vec(),
        q_fixed: vec![true; n],
        v_fixed: vec![true; n],
        project: true,
    };
    consistent_state(numeric, &data).map_err(words)
}
