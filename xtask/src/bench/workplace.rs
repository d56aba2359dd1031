//! Where the benchmark is made: folders, programs, the Python environment, the references.

use super::machine::{core, said};
use super::results::write_whole;
use crate::{cargo, err};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Packages whose versions are written down.
const PACKAGES: &[&str] = &[
    "sympy", "casadi", "heyoka", "symjit", "diffrax", "jax", "scipy", "numba", "numpy", "mpmath",
];

/// The workplace.
pub(crate) struct Workplace {
    root: PathBuf,
    target: PathBuf,
    references: Map<String, Value>,
    core: Option<String>,
}

/// The folder of the repository.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

impl Workplace {
    /// The folders, and the references that are there.
    pub(crate) fn new() -> Result<Workplace, String> {
        let root = root();
        let target =
            std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
        std::fs::create_dir_all(target.join("bench")).map_err(|p| p.to_string())?;
        let references = match std::fs::read_to_string(root.join("bench/reference.json")) {
            Ok(text) => serde_json::from_str(&text).map_err(|p| format!("reference.json: {p}"))?,
            Err(_) => Map::new(),
        };
        Ok(Workplace {
            root,
            target,
            references,
            core: core().filter(|_| said("taskset", &["--version"]).is_some()),
        })
    }

    /// The repository, for questions.
    pub(crate) fn root(&self) -> String {
        self.root.display().to_string()
    }

    /// The command line of Chetaev.
    pub(crate) fn program(&self) -> String {
        self.target.join("release/chetaev").display().to_string()
    }

    /// A folder for what is thrown away.
    pub(crate) fn scratch(&self) -> String {
        self.bench().join("scratch").display().to_string()
    }

    /// The folder in which the benchmark works.
    pub(crate) fn bench(&self) -> PathBuf {
        self.target.join("bench")
    }

    /// What is known of a system.
    pub(crate) fn reference(&self, system: &str) -> Value {
        self.references.get(system).cloned().unwrap_or(Value::Null)
    }

    /// How the ends of trajectories were computed, by system.
    pub(crate) fn reference_words(&self) -> BTreeMap<String, String> {
        let words = |(system, found): (&String, &Value)| {
            let by = found["end_by"].as_str()?;
            let closeness = found["end_uncertainty"].as_f64();
            let closeness = closeness.map_or(String::new(), |u| {
                format!("; long double differs by {u:.0e}")
            });
            Some((system.clone(), format!("{by}{closeness}")))
        };
        self.references.iter().filter_map(words).collect()
    }

    /// Where the log of participants goes.
    pub(crate) fn log(&self) -> Result<File, String> {
        let path = self.bench().join("log");
        let file = OpenOptions::new().create(true).append(true).open(&path);
        file.map_err(|problem| format!("{}: {problem}", path.display()))
    }

    fn python(&self) -> PathBuf {
        self.bench().join("python/bin/python")
    }

    /// The command of a participant, bound to one processor.
    pub(crate) fn command(&self, peer: &str) -> Result<Command, String> {
        let program = match peer {
            "chetaev" => vec![self.target.join("release/chetaev-bench")],
            _ => {
                let file = self.root.join(format!("bench/peers/{peer}_peer.py"));
                vec![self.python(), file]
            }
        };
        let bind = self.core.iter().flat_map(|core| ["taskset", "-c", core]);
        let words: Vec<PathBuf> = bind.map(PathBuf::from).chain(program).collect();
        let (first, rest) = words.split_first().ok_or("no program")?;
        let mut command = Command::new(first);
        command.args(rest).current_dir(&self.root);
        for threads in [
            "OMP_NUM_THREADS",
            "OPENBLAS_NUM_THREADS",
            "NUMBA_NUM_THREADS",
        ] {
            command.env(threads, "1");
        }
        Ok(command)
    }

    /// Builds our side.
    pub(crate) fn build(&self) -> Result<(), String> {
        let mut build = cargo();
        build.args([
            "build",
            "--release",
            "-p",
            "chetaev-cli",
            "-p",
            "chetaev-bench",
        ]);
        done(build.current_dir(&self.root))
    }

    /// Makes the Python environment where there is none with these versions.
    pub(crate) fn environment(&self) -> Result<(), String> {
        let wanted = self.root.join("bench/requirements.txt");
        let text = std::fs::read_to_string(&wanted).map_err(|p| p.to_string())?;
        let made = self.bench().join("python/made-from");
        if std::fs::read_to_string(&made).is_ok_and(|before| before == text) {
            return Ok(());
        }
        err("making a Python environment with the peers\n");
        let folder = self.bench().join("python");
        let python = ["python3.11", "python3"]
            .into_iter()
            .find(|name| said(name, &["--version"]).is_some())
            .ok_or("the peers need Python 3.11; none was found")?;
        done(Command::new(python).args(["-m", "venv"]).arg(&folder))?;
        let mut install = Command::new(self.python());
        install.args(["-m", "pip", "install", "--quiet", "--requirement"]);
        done(install.arg(&wanted))?;
        write_whole(&made, &text)
    }

    /// Computes the references of systems that have none, or of all where `again`.
    pub(crate) fn compute_references(
        &mut self,
        systems: &[&str],
        again: bool,
    ) -> Result<(), String> {
        for system in systems {
            if self.references.contains_key(*system) && !again {
                continue;
            }
            err(&format!("reference of {system}\n"));
            let output = Command::new(self.python())
                .arg(self.root.join("bench/reference.py"))
                .arg(system)
                .stderr(self.log()?)
                .output()
                .map_err(|problem| problem.to_string())?;
            let found = serde_json::from_slice::<Value>(&output.stdout);
            let found =
                found.map_err(|_| format!("the reference of {system} failed; see the log"))?;
            self.references.insert((*system).into(), found);
            let lines = self
                .references
                .iter()
                .map(|(name, value)| format!("\"{name}\": {value}"));
            let lines: Vec<String> = lines.collect();
            let text = format!("{{\n{}\n}}\n", lines.join(",\n"));
            write_whole(&self.root.join("bench/reference.json"), &text)?;
        }
        Ok(())
    }

    /// Versions of everything that was used.
    pub(crate) fn versions(&self, peers: bool) -> BTreeMap<String, String> {
        let mut found =
            BTreeMap::from([("chetaev".to_string(), env!("CARGO_PKG_VERSION").to_string())]);
        let mut add = |name: &str, version: Option<String>| {
            found.extend(version.map(|version| (name.to_string(), version)));
        };
        add("rustc", said("rustc", &["--version"]));
        if peers {
            add("gcc", said("gcc", &["--version"]));
            let python = self.python().display().to_string();
            add("python", said(&python, &["--version"]));
            for package in PACKAGES {
                let ask = format!("import importlib.metadata as m; print(m.version('{package}'))");
                add(package, said(&python, &["-c", &ask]));
            }
        }
        found
    }
}

fn done(command: &mut Command) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{:?} ended with {status}", command.get_program())),
        Err(problem) => Err(format!("{:?}: {problem}", command.get_program())),
    }
}
