//! `cargo xtask python`: the Python package beside a virtual environment, its tests, and the stub of its native part.

use crate::extent::VARIABLE;
use crate::stub::stub;
use crate::{cargo, err, out, refuse, status_of};
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str = "\
The Python package and its tests

Usage: cargo xtask python [ARGUMENTS OF PYTEST]
       cargo xtask python --stub

Builds the native part as the Rust tests do, puts it beside the Python files in target/python, makes a virtual environment there
and installs what the tests need by pip, once. Without Python 3.10 and pip nothing is done, and that is said.

  --stub    writes python/chetaev/chetaev_native.pyi, the types of the native part, as its library states them, and runs no test;
            a test fails where that file is another one
";

/// What the tests import.
const NEEDED: [&str; 19] = [
    "numpy",
    "scipy",
    "sympy",
    "pytest",
    "hypothesis",
    "mypy",
    "tqdm",
    "pandas",
    "xarray",
    "pyarrow",
    "distributed",
    "casadi",
    "jax",
    "matplotlib",
    "numba",
    "anywidget",
    "pyright[nodejs]",
    "nbclient",
    "myst-nb",
];

/// The stub of the native part.
const STUB: &str = "chetaev_native.pyi";

/// What is built where nothing is built yet: the native part, and the command line that it is compared with.
const ALONE: &[&str] = &["build", "-p", "chetaev-python", "-p", "chetaev-cli"];
/// The same after the Rust tests. Which features the libraries have depends on all that is built at once, and where they are the same
/// nothing but the native part is left to build.
const AFTER_TESTS: &[&str] = &["build", "--workspace", "--lib", "--bins", "--tests"];

/// Runs the task; the exit status is that of the first program that fails.
pub(crate) fn run(words: &[String]) -> u8 {
    if words == ["--stub"] {
        return write_stub();
    }
    run_built(ALONE, words, None)
}

/// Writes the stub of the native part beside the Python files.
fn write_stub() -> u8 {
    let root = root();
    let built = build(&root, ALONE);
    if built != 0 {
        return built;
    }
    let place = root.join("python").join("chetaev").join(STUB);
    let made = stub(&library(&root)).map_err(std::io::Error::other);
    let written = made.and_then(|text| std::fs::write(place, text));
    match written {
        Ok(()) => 0,
        Err(problem) => {
            err(&format!("error: {STUB}: {problem}\n"));
            1
        }
    }
}

/// Runs the Python tests after those of Rust, to the same extent.
pub(crate) fn after_tests(extent: &str) -> u8 {
    run_built(AFTER_TESTS, &[], Some(extent))
}

fn run_built(what: &[&str], words: &[String], extent: Option<&str>) -> u8 {
    if words.iter().any(|word| word == "--help" || word == "-h") {
        out(HELP);
        return 0;
    }
    let root = root();
    let Some(python) = python() else {
        out("The Python package is not tested: Python 3.10 or newer with venv and pip was not found.\n");
        return 0;
    };
    let built = build(&root, what);
    if built != 0 {
        return built;
    }
    let folder = root.join("target").join("python");
    let prepared = environment(&python, &folder).and_then(|own| {
        package(&root, &folder)?;
        Ok(own)
    });
    let own = match prepared {
        Ok(own) => own,
        Err(problem) => {
            err(&format!("error: the Python package: {problem}\n"));
            return 1;
        }
    };
    let mut tests = Command::new(own);
    if let Some(extent) = extent {
        tests.env(VARIABLE, extent);
    }
    let tests = tests
        .args(["-m", "pytest", "-q", "-p", "no:cacheprovider"])
        .args(words)
        .env("PYTHONPATH", folder.join("package"))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .current_dir(&root)
        .status();
    match tests {
        Ok(status) => status_of(status),
        Err(problem) => refuse(&format!("Python could not be run: {problem}")),
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Runs cargo; the status is 0 where all is built.
fn build(root: &Path, what: &[&str]) -> u8 {
    match cargo().args(what).current_dir(root).status() {
        Ok(status) => status_of(status),
        Err(problem) => refuse(&format!("cargo could not be run: {problem}")),
    }
}

/// An interpreter that is new enough and can make virtual environments.
fn python() -> Option<PathBuf> {
    let named = std::env::var_os("PYTHON").map(PathBuf::from);
    let usual = ["python3", "python"].map(PathBuf::from);
    let test = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))";
    let serves = |path: &PathBuf| {
        let done = Command::new(path).args(["-c", test]).output();
        done.is_ok_and(|done| done.status.success())
    };
    named.into_iter().chain(usual).find(serves)
}

/// The interpreter of an environment that has what the tests need.
fn environment(python: &Path, folder: &Path) -> std::io::Result<PathBuf> {
    let own = folder.join("environment");
    let inside = if cfg!(windows) {
        own.join("Scripts").join("python.exe")
    } else {
        own.join("bin").join("python")
    };
    let (stamp, needed) = (own.join("needed"), NEEDED.join("\n"));
    if inside.exists() && std::fs::read_to_string(&stamp).is_ok_and(|known| known == needed) {
        return Ok(inside);
    }
    let made = Command::new(python)
        .args(["-m", "venv"])
        .arg(&own)
        .status()?;
    let install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ];
    let installed = Command::new(&inside).args(install).args(NEEDED).status()?;
    if !(made.success() && installed.success()) {
        return Err(std::io::Error::other(
            "the virtual environment could not be made",
        ));
    }
    std::fs::write(stamp, needed)?;
    Ok(inside)
}

/// Puts the Python files and the native part together.
fn package(root: &Path, folder: &Path) -> std::io::Result<()> {
    let own = folder.join("package").join("chetaev");
    if own.exists() {
        std::fs::remove_dir_all(&own)?;
    }
    std::fs::create_dir_all(&own)?;
    for entry in std::fs::read_dir(root.join("python").join("chetaev"))? {
        let path = entry?.path();
        if let (true, Some(name)) = (path.is_file(), path.file_name()) {
            std::fs::copy(&path, own.join(name))?;
        }
    }
    let built = library(root);
    let named = if cfg!(windows) {
        "chetaev_native.pyd"
    } else {
        "chetaev_native.abi3.so"
    };
    std::fs::copy(&built, own.join(named))?;
    // The tests see what the library states, and hold the file that is kept against it.
    match stub(&built) {
        Ok(text) => std::fs::write(own.join(STUB), text),
        // What PyO3 cannot read yet: libraries as the linker of macOS writes them.
        Err(problem) if cfg!(target_os = "macos") => {
            out(&format!("{STUB} is not compared: {problem}\n"));
            Ok(())
        }
        Err(problem) => Err(std::io::Error::other(problem)),
    }
}

/// The native part as cargo builds it.
fn library(root: &Path) -> PathBuf {
    let named = match std::env::consts::OS {
        "windows" => "chetaev_native.dll",
        "macos" => "libchetaev_native.dylib",
        _ => "libchetaev_native.so",
    };
    root.join("target").join("debug").join(named)
}
