//! The machine and its load.

use super::results::Machine;
use std::process::Command;

fn file(path: &str) -> String {
    std::fs::read_to_string(path).unwrap_or_default()
}

/// Load average of the last minute; zero where the system does not say.
pub(crate) fn load() -> f64 {
    let text = file("/proc/loadavg");
    let first = text.split_whitespace().next();
    first.and_then(|x| x.parse().ok()).unwrap_or(0.0)
}

/// What runs the benchmark.
pub(crate) fn machine() -> Machine {
    let processor = file("/proc/cpuinfo");
    let value = |key: &str| {
        let line = processor.lines().find(|line| line.starts_with(key));
        line.and_then(|line| Some(line.split_once(':')?.1.trim().to_string()))
    };
    let flags = value("flags").unwrap_or_default();
    let has = |flag: &str| flags.split(' ').any(|f| f == flag);
    let vectors = [("avx2", "AVX2"), ("fma", "FMA"), ("avx512f", "AVX-512")];
    let vectors: Vec<&str> = vectors
        .iter()
        .filter(|(flag, _)| has(flag))
        .map(|(_, name)| *name)
        .collect();
    let memory = file("/proc/meminfo");
    let total = memory
        .lines()
        .find_map(|line| line.strip_prefix("MemTotal:"));
    let kilobytes = total.and_then(|t| t.split_whitespace().next()?.parse::<u64>().ok());
    Machine {
        processor: value("model name").unwrap_or_else(|| "unknown".into()),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        vectors: vectors.join(", "),
        memory: kilobytes.unwrap_or(0) * 1024,
        system: said("uname", &["-sr"]).unwrap_or_default(),
    }
}

/// The first line a program prints, where it succeeds.
pub(crate) fn said(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output
        .status
        .success()
        .then(|| text.lines().next().unwrap_or_default().trim().to_string())
}

/// The processor to which every participant is bound: the last one this process may use.
pub(crate) fn core() -> Option<String> {
    let status = file("/proc/self/status");
    let list = status
        .lines()
        .find_map(|line| line.strip_prefix("Cpus_allowed_list:"))?;
    let last = list.trim().rsplit([',', '-']).next()?;
    Some(last.to_string())
}
