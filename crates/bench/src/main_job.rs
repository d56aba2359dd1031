//! Studies as whole processes: the main job, `chetaev study` of a model with proofs, motion and report; and a row of the table of multi-level
//! principles of elasticity in three dimensions, with all its claims.

use crate::prepared::words;
use crate::question::Question;
use crate::Ready;
use serde_json::{json, Value};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const MODEL: &str = "gallery/chaplygin-sleigh/model.toml";
const CLAIMS: &str = "model,formulations,motion";

/// The process, timed by the wall; the memory is that of a run before, looked at while it runs.
///
/// # Errors
/// Where it does not succeed.
pub fn main_job(question: &Question) -> Result<Ready, String> {
    let question = question.clone();
    let memory = memory(&question)?;
    Ok(Ready {
        answer: Value::Null,
        info: json!({"memory": memory, "claims": claims(&question)}),
        measure: Box::new(move || {
            let clock = Instant::now();
            let status = command(&question).status().map_err(words)?;
            let wall = clock.elapsed().as_secs_f64();
            match status.success() {
                true => Ok(json!({"seconds": wall, "wall": wall, "parts": {"memory": memory}})),
                false => Err(format!("the study ended with {status}")),
            }
        }),
    })
}

/// The claims that are asked for.
fn claims(question: &Question) -> &'static str {
    match question.item.as_str() {
        "table" => "all",
        _ => CLAIMS,
    }
}

/// The model and its options.
fn asked(question: &Question) -> Vec<String> {
    match question.item.as_str() {
        "table" => {
            let model = format!("gallery/elasticity/{}/model.toml", question.system);
            vec![model, "--set".into(), "d=3".into()]
        }
        _ => [MODEL, "--claims", CLAIMS].map(str::to_owned).to_vec(),
    }
}

fn command(question: &Question) -> Command {
    let mut command = Command::new(&question.program);
    command
        .arg("study")
        .args(asked(question))
        .arg("--out")
        .arg(&question.scratch)
        .current_dir(&question.root)
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command
}

/// Largest resident memory of the process in bytes.
fn memory(question: &Question) -> Result<u64, String> {
    let mut child = command(question).spawn().map_err(words)?;
    let mut largest = 0;
    loop {
        largest = largest.max(crate::clock::peak_memory_of(&child.id().to_string()));
        match child.try_wait().map_err(words)? {
            Some(status) if status.success() => return Ok(largest),
            Some(status) => return Err(format!("the study ended with {status}")),
            None => std::thread::sleep(Duration::from_millis(1)),
        }
    }
}
