//! Time of the processor and of the wall, and the largest memory.

use rustix::time::{clock_gettime, ClockId};
use serde_json::{json, Value};
use std::time::Instant;

/// A start in both times.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    processor: f64,
    wall: Instant,
}

impl Clock {
    /// Now.
    pub fn start() -> Clock {
        Clock {
            processor: processor_time(),
            wall: Instant::now(),
        }
    }

    /// Seconds of the processor and of the wall since the start.
    pub fn seconds(&self) -> (f64, f64) {
        let wall = self.wall.elapsed().as_secs_f64();
        (processor_time() - self.processor, wall)
    }
}

/// Seconds that all threads of this process have used.
fn processor_time() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Shorter measurements are repeated.
const LEAST: f64 = 0.05;

/// Does the work until it has taken long enough to be measured; the time for one of the `units` it consists of.
///
/// # Errors
/// Those of the work.
pub fn per_unit(units: f64, mut work: impl FnMut() -> Result<(), String>) -> Result<Value, String> {
    let mut calls = 1_u64;
    loop {
        let clock = Clock::start();
        for _ in 0..calls {
            work()?;
        }
        let (processor, wall) = clock.seconds();
        if processor >= LEAST || calls > 1 << 24 {
            let share = calls as f64 * units;
            return Ok(json!({"seconds": processor / share, "wall": wall / share}));
        }
        let needed = 1.2 * calls as f64 * LEAST / processor.max(1e-9);
        calls = (2 * calls).max(needed as u64);
    }
}

/// Largest resident memory of this process so far, in bytes; zero where the system does not say.
pub fn peak_memory() -> u64 {
    peak_memory_of("self")
}

/// The same of the process with this number.
pub fn peak_memory_of(process: &str) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let number = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    number.unwrap_or(0) * 1024
}
