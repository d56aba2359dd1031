//! `cargo xtask web`: the playground, built from the crates and the page, and its tests in a browser.

use crate::{browser, cargo, err, out, refuse, status_of};
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str = "\
The playground

Usage: cargo xtask web [--test [ARGUMENTS OF THE TESTS]]

Builds web/dist, a folder that any server of files can serve: the crates for the browser, the glue around them, and the page. Installs the
target wasm32-unknown-unknown by rustup where it is missing, and what the page is made of by npm, as web/package-lock.json pins it.

  --test    then drives the page in Chromium as a person would; `--full` takes all models and mutants
  --help    this text

Without Node.js 20 and npm nothing is done, and that is said.
";

const TARGET: &str = "wasm32-unknown-unknown";

/// Bytes that the module may take altogether: more ends the work with a sentence, and not the browser.
const MEMORY: u32 = 1 << 30;

/// Bytes of its stack.
const STACK: u32 = 8 << 20;

/// Runs the task; the exit status is that of the first program that fails.
pub(crate) fn run(words: &[String]) -> u8 {
    if words.iter().any(|word| word == "--help" || word == "-h") {
        out(HELP);
        return 0;
    }
    let tests = match words.split_first() {
        None => None,
        Some((word, rest)) if word == "--test" => Some(rest),
        Some((word, _)) => {
            return refuse(&format!(
                "unknown argument `{word}`; `cargo xtask web` takes `--test`"
            ))
        }
    };
    if !has_node() {
        out("The playground is not built: Node.js 20 or newer with npm was not found.\n");
        return 0;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let done = build(&root).and_then(|()| match tests {
        None => Ok(()),
        Some(words) => test(&root, words),
    });
    match done {
        Ok(()) => 0,
        Err(Failed::Status(status)) => status,
        Err(Failed::Words(words)) => {
            err(&format!("error: the playground: {words}\n"));
            1
        }
    }
}

/// Why it is not done.
enum Failed {
    /// A program failed and has said why.
    Status(u8),
    /// In words.
    Words(String),
}

fn done(command: &mut Command) -> Result<(), Failed> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(Failed::Status(status_of(status).max(1))),
        Err(problem) => Err(Failed::Words(format!(
            "{} could not be run: {problem}",
            command.get_program().to_string_lossy()
        ))),
    }
}

/// The module, the glue, the page.
fn build(root: &Path) -> Result<(), Failed> {
    // Where there is no rustup the compiler has its targets otherwise, and says what it misses.
    let _ = Command::new("rustup")
        .args(["target", "add", TARGET])
        .output();
    let built =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let link = format!("-C link-arg=--max-memory={MEMORY} -C link-arg=-zstack-size={STACK}");
    done(
        cargo()
            .args([
                "rustc",
                "-p",
                "chetaev-web",
                "--lib",
                "--crate-type",
                "cdylib",
            ])
            .args(["--target", TARGET, "--profile", "web"])
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", link)
            .current_dir(root),
    )?;
    let web = root.join("web");
    let module = built.join(TARGET).join("web").join("chetaev_web.wasm");
    done(
        cargo()
            .args(["run", "--quiet", "--locked", "--manifest-path"])
            .arg(web.join("bindgen").join("Cargo.toml"))
            .arg("--")
            .arg(&module)
            .arg(web.join("pkg"))
            .env_remove("CARGO_TARGET_DIR"),
    )?;
    if !is_installed(&web) {
        done(
            npm()
                .args(["ci", "--no-fund", "--no-audit"])
                .current_dir(&web),
        )?;
    }
    done(npm().args(["run", "--silent", "build"]).current_dir(&web))
}

/// Whether the packages are those of the lock file.
fn is_installed(web: &Path) -> bool {
    let time = |path: PathBuf| path.metadata().and_then(|known| known.modified()).ok();
    let installed = time(web.join("node_modules").join(".package-lock.json"));
    matches!((installed, time(web.join("package-lock.json"))), (Some(installed), Some(wanted)) if installed >= wanted)
}

fn test(root: &Path, words: &[String]) -> Result<(), Failed> {
    browser::ensure().map_err(Failed::Words)?;
    // The words and the numbers of the page are compared with those of the command.
    done(
        cargo()
            .args(["build", "-p", "chetaev-cli"])
            .current_dir(root),
    )?;
    let mut tests = Command::new("node");
    done(
        tests
            .arg("tests/run.mjs")
            .args(words)
            .current_dir(root.join("web")),
    )
}

fn npm() -> Command {
    Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" })
}

fn has_node() -> bool {
    let version = Command::new("node").arg("--version").output();
    let version = version
        .ok()
        .and_then(|found| String::from_utf8(found.stdout).ok());
    let major = version.and_then(|text| {
        text.trim()
            .strip_prefix('v')?
            .split('.')
            .next()?
            .parse::<u32>()
            .ok()
    });
    major.is_some_and(|major| major >= 20) && npm().arg("--version").output().is_ok()
}
