//! Chromium for the tests that look at the report.

use crate::err;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// Where the tests look, in this order, unless the environment variable `CHROMIUM` says.
const NAMES: [&str; 6] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
];

const HOW: &str = "\
the tests of the report look at its page in Chromium or Chrome, and none was found.
  Debian, Ubuntu:  sudo apt-get install chromium
  Fedora:          sudo dnf install chromium
  macOS:           brew install --cask chromium
  elsewhere:       install either and let the environment variable CHROMIUM name the program
Then repeat `cargo xtask test`.";

/// Makes sure that a browser is there: finds one, or installs it where that needs no password.
///
/// # Errors
/// What to do by hand.
pub(crate) fn ensure() -> Result<(), String> {
    if let Some(program) = std::env::var_os("CHROMIUM") {
        return if answers(&program) {
            Ok(())
        } else {
            Err(format!(
                "the environment variable CHROMIUM names {}, which does not start as a browser",
                program.to_string_lossy()
            ))
        };
    }
    if found() {
        return Ok(());
    }
    if !may_install() {
        return Err(HOW.to_string());
    }
    err("No Chromium was found; installing it by apt-get ...\n");
    // The lists of a fresh container are empty, so they are fetched when the first attempt fails.
    let installed = apt_get(&["install", "--yes", "--no-install-recommends", "chromium"])
        || (apt_get(&["update"])
            && apt_get(&["install", "--yes", "--no-install-recommends", "chromium"]));
    if installed && found() {
        Ok(())
    } else {
        Err(format!(
            "apt-get could not install a working Chromium; {HOW}"
        ))
    }
}

/// Whether the first program in `PATH` that the tests would take starts.
fn found() -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    NAMES
        .iter()
        .flat_map(|name| std::env::split_paths(&path).map(move |folder| folder.join(name)))
        .find(|candidate| candidate.is_file())
        .is_some_and(|program: PathBuf| answers(&program.into_os_string()))
}

/// A placeholder that only says how to install the browser does not answer.
fn answers(program: &OsString) -> bool {
    Command::new(program)
        .arg("--version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// Whether this is a system of Debian's kind and its administrator.
fn may_install() -> bool {
    let user = Command::new("id").arg("-u").output();
    let is_root = user.is_ok_and(|output| output.stdout.trim_ascii() == b"0");
    is_root && Command::new("apt-get").arg("--version").output().is_ok()
}

fn apt_get(arguments: &[&str]) -> bool {
    Command::new("apt-get")
        .args(arguments)
        .env("DEBIAN_FRONTEND", "noninteractive")
        // The output of the tests belongs to whoever reads it; this is progress.
        .stdout(std::io::stderr())
        .status()
        .is_ok_and(|status| status.success())
}
