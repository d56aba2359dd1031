//! A participant: a process that answers one JSON line for each line it is asked.

use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{channel, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// How many seconds of the wall may pass for one of the processor: other work, and programs that the participant runs.
const PATIENCE: f64 = 4.0;

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

    /// Asks, and waits for the answer until the process has used `seconds` of the processor; on a machine with other work
    /// the wall may show more, but not more than [`PATIENCE`] times as many.
    pub(crate) fn ask(&mut self, question: &Value, seconds: f64) -> Result<Value, Silence> {
        let asked = match &mut self.input {
            Some(input) => writeln!(input, "{question}").and_then(|()| input.flush()),
            None => Ok(()),
        };
        if asked.is_err() {
            return Err(self.gone());
        }
        let (start, used) = (Instant::now(), self.processor());
        let line = loop {
            match self.lines.recv_timeout(Duration::from_millis(500)) {
                Ok(line) => break line,
                Err(RecvTimeoutError::Disconnected) => return Err(self.gone()),
                Err(RecvTimeoutError::Timeout) => {
                    let wall = start.elapsed().as_secs_f64();
                    if self.processor() - used > seconds || wall > PATIENCE * seconds {
                        self.end();
                        return Err(Silence::Late(wall));
                    }
                }
            }
        };
        match serde_json::from_str::<Value>(&line) {
            Ok(answer) if answer["ok"] == true => Ok(answer),
            Ok(answer) => {
                let reason = answer["reason"].as_str().unwrap_or("no reason given");
                Err(Silence::Refused(reason.into()))
            }
            Err(_) => Err(Silence::Refused(format!("no JSON: {line:.80}"))),
        }
    }

    /// Seconds of the processor that it and its children that have ended have used so far; zero where the system does not say.
    pub(crate) fn processor(&self) -> f64 {
        let path = format!("/proc/{}/stat", self.child.id());
        let text = std::fs::read_to_string(path).unwrap_or_default();
        // The name in parentheses may contain anything; fields 14 to 17 of the whole are times in hundredths of a second.
        let fields = text.rsplit(") ").next().unwrap_or_default();
        let times = fields.split(' ').skip(11).take(4);
        times.filter_map(|x| x.parse::<f64>().ok()).sum::<f64>() / 100.0
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

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn talk(script: &str) -> Talk {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        let log = std::fs::File::open("/dev/null").expect("a log");
        Talk::start(command, log).expect("a shell")
    }

    #[test]
    fn who_does_not_answer_in_time_is_ended() {
        let late = talk("sleep 60").ask(&json!({}), 0.1);
        assert!(matches!(late, Err(Silence::Late(_))), "{late:?}");
    }

    #[test]
    fn answers_and_refusals_are_told_apart() {
        let answer =
            talk("read x; echo '{\"ok\": true, \"seconds\": 2}'; sleep 5").ask(&json!({}), 20.0);
        assert_eq!(answer, Ok(json!({"ok": true, "seconds": 2})));
        let refusal = talk("read x; echo '{\"ok\": false, \"reason\": \"no\"}'; sleep 5")
            .ask(&json!({}), 20.0);
        assert_eq!(refusal, Err(Silence::Refused("no".into())));
        let nonsense = talk("read x; echo no; sleep 5").ask(&json!({}), 20.0);
        assert!(matches!(nonsense, Err(Silence::Refused(_))), "{nonsense:?}");
        let gone = talk("read x; exit 3").ask(&json!({}), 20.0);
        assert!(matches!(gone, Err(Silence::Gone(_))), "{gone:?}");
    }
}
