//! Our side of the benchmark (`cargo xtask bench`).
//!
//! One process is one participant. Questions and answers are JSON, one object a line; what they are is written in
//! `bench/peers/protocol.py`, which the peers share. Everything starts from the text of a model.

pub mod clock;
pub mod drift;
pub mod ensemble;
pub mod evaluation;
pub mod main_job;
pub mod prepared;
pub mod question;
pub mod trajectory;

use question::Question;
use serde_json::{json, Value};
use std::io::{BufRead, Write};

/// What a participant has ready: an answer to be checked, remarks, and the work to be timed.
pub struct Ready {
    /// Values to be compared with the reference, `null` where the measurement gives them.
    pub answer: Value,
    /// Remarks.
    pub info: Value,
    /// Makes one measurement: an object with `seconds` and `wall`.
    pub measure: Box<dyn FnMut() -> Result<Value, String>>,
}

/// Prepares an item.
///
/// # Errors
/// Why this participant cannot.
pub fn prepare(question: &Question) -> Result<Ready, String> {
    match question.item.as_str() {
        "derive" => evaluation::derive(question),
        "rhs" => evaluation::right_hand_side(question),
        "trajectory" => trajectory::trajectory(question),
        "ensemble" => ensemble::ensemble(question),
        "main-job" | "table" => main_job::main_job(question),
        "drift" => drift::drift(question),
        other => Err(format!("there is no item `{other}`")),
    }
}

/// Answers questions until told to quit or the input ends.
///
/// # Errors
/// What the streams say.
pub fn serve(input: impl BufRead, mut output: impl Write) -> std::io::Result<()> {
    let mut ready: Option<Ready> = None;
    for line in input.lines() {
        let line = line?;
        let asked: Value = serde_json::from_str(&line).unwrap_or(Value::Null);
        let reply = match asked["do"].as_str() {
            Some("prepare") => Question::read(&asked)
                .and_then(|question| prepare(&question))
                .map(|found| {
                    let reply = json!({"ok": true, "answer": found.answer, "info": found.info});
                    ready = Some(found);
                    reply
                }),
            Some("measure") => match &mut ready {
                Some(ready) => (ready.measure)().map(|mut found| {
                    found["ok"] = Value::Bool(true);
                    found
                }),
                None => Err("nothing is prepared".into()),
            },
            _ => {
                let memory = clock::peak_memory();
                writeln!(
                    output,
                    "{}",
                    json!({"ok": true, "memory": memory, "before": 0, "children": 0})
                )?;
                return output.flush();
            }
        };
        let reply = reply.unwrap_or_else(|reason| json!({"ok": false, "reason": reason}));
        writeln!(output, "{reply}")?;
        output.flush()?;
    }
    Ok(())
}
