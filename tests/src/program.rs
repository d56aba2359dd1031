//! The program `chetaev` as a user has it: a process with arguments, streams and an exit status.

use crate::places;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// The longest that any call of these tests may take.
const LIMIT: Duration = Duration::from_secs(300);

/// What a finished process left.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Exit status; `None` when a signal ended it.
    pub status: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Finished {
    /// Both streams, for messages of failing tests.
    pub fn both(&self) -> String {
        format!(
            "exit {:?}\n--- stdout\n{}\n--- stderr\n{}",
            self.status, self.out, self.err
        )
    }

    /// Whether a thread panicked.
    pub fn panicked(&self) -> bool {
        self.err.contains("panicked at") || self.status == Some(101)
    }

    /// Standard output as JSON.
    ///
    /// # Panics
    /// When it is not JSON.
    pub fn json(&self) -> serde_json::Value {
        match serde_json::from_str(&self.out) {
            Ok(value) => value,
            Err(problem) => panic!("not JSON: {problem}\n{}", self.both()),
        }
    }
}

/// Path of the program, built from the present sources in the profile of the running test.
///
/// # Panics
/// When it cannot be built.
pub fn path() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(build)
}

fn build() -> PathBuf {
    let folder = places::executable_folder();
    let target = folder.parent().expect("the profile is in a target folder");
    let profile = match folder.file_name().and_then(|name| name.to_str()) {
        Some("debug") | None => "dev",
        Some(name) => name,
    };
    let built = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--workspace", "--bin", "chetaev"])
        .args(["--profile", profile, "--target-dir"])
        .arg(target)
        .current_dir(places::root())
        .output()
        .expect("cargo runs");
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    folder.join(format!("chetaev{}", std::env::consts::EXE_SUFFIX))
}

/// The program with arguments, to be started in `folder`, with pipes for its streams and without colours.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(path());
    command
        .args(arguments)
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// Runs the program in `folder` to its end.
///
/// # Panics
/// When it cannot be started or runs longer than two minutes.
pub fn run_in(folder: &Path, arguments: &[&str]) -> Finished {
    let child = command(folder, arguments).spawn();
    finish(child.expect("the program starts"), arguments)
}

/// Runs the program in the root of the repository, as the README does.
pub fn run(arguments: &[&str]) -> Finished {
    run_in(&places::root(), arguments)
}

/// Runs the program in the root of the repository to success.
///
/// # Panics
/// When its exit status is not zero.
pub fn ok(arguments: &[&str]) -> Finished {
    let finished = run(arguments);
    assert_eq!(
        finished.status,
        Some(0),
        "{arguments:?}: {}",
        finished.both()
    );
    finished
}

/// Waits for a started process and reads its streams.
///
/// # Panics
/// When it runs longer than five minutes.
pub fn finish(mut child: Child, arguments: &[&str]) -> Finished {
    let out = child.stdout.take().map(reader);
    let err = child.stderr.take().map(reader);
    let began = Instant::now();
    let status = loop {
        match child.try_wait().expect("the process can be waited for") {
            Some(status) => break status,
            None if began.elapsed() > LIMIT => {
                let _ = child.kill();
                panic!("`chetaev {}` does not end", arguments.join(" "));
            }
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    };
    let text = |thread: Option<std::thread::JoinHandle<String>>| {
        thread.map_or(String::new(), |t| t.join().expect("the stream is read"))
    };
    Finished {
        status: status.code(),
        out: text(out),
        err: text(err),
    }
}

fn reader(mut stream: impl std::io::Read + Send + 'static) -> std::thread::JoinHandle<String> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        String::from_utf8(bytes).expect("the program writes UTF-8")
    })
}

/// A path as an argument.
///
/// # Panics
/// When it is not UTF-8.
pub fn text(path: &Path) -> &str {
    path.to_str().expect("scratch folders have UTF-8 names")
}
