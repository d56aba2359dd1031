//! A participant: a process that answers one JSON line for each line it is asked.

use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{channel, Receiver, RecvTimeoutError};
use std::time::Duration;

/// Why a participant gave no answer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Silence {
    /// Its time is over; it has been ended.
    Late(f64),
    /// It refused, with a reason.
    Refused(String),
    /// It is gone.
    Gone(String),
}

/// A running participant.
pub(crate) struct Talk {
    child: Child,
    input: Option<ChildStdin>,
    lines: Receiver<String>,
}

impl Talk {
    /// Starts the process; what it writes to standard error goes to `log`.
    pub(crate) fn start(mut command: Command, log: std::fs::File) -> Result<Talk, Silence> {
        let gone = |problem: std::io::Error| Silence::Gone(problem.to_string());
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(log)
            .spawn()
            .map_err(gone)?;
        let (sender, lines) = channel();
        if let Some(stdout) = child.stdout.take() {
            std::thread::spawn(move || {
                for line in BufReader::new(stdout).lines().map_while(Result::ok) {
                    if sender.send(line).is_err() {
                        return;
                    }
                }
            });
        }
        Ok(Talk {
            input: child.stdin.take(),
            child,
            lines,
        })
    }

    /// Asks, and waits for the answer no longer than `seconds`.
    pub(crate) fn ask(&mut self, question: &Value, seconds: f64) -> Result<Value, Silence> {
        let asked = match &mut self.input {
            Some(input) => writeln!(input, "{question}").and_then(|()| input.flush()),
            None => Ok(()),
        };
        if asked.is_err() {
            return Err(self.gone());
        }
        match self.lines.recv_timeout(Duration::from_secs_f64(seconds)) {
            Ok(line) => match serde_json::from_str::<Value>(&line) {
                Ok(answer) if answer["ok"] == true => Ok(answer),
                Ok(answer) => {
                    let reason = answer["reason"].as_str().unwrap_or("no reason given");
                    Err(Silence::Refused(reason.into()))
                }
                Err(_) => Err(Silence::Refused(format!("no JSON: {line:.80}"))),
            },
            Err(RecvTimeoutError::Timeout) => {
                self.end();
                Err(Silence::Late(seconds))
            }
            Err(RecvTimeoutError::Disconnected) => Err(self.gone()),
        }
    }

    fn gone(&mut self) -> Silence {
        match self.child.wait() {
            Ok(status) => Silence::Gone(format!("it ended by itself: {status}")),
            Err(problem) => Silence::Gone(problem.to_string()),
        }
    }

    /// Ends it.
    pub(crate) fn end(&mut self) {
        self.input = None;
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Talk {
    fn drop(&mut self) {
        self.end();
    }
}
