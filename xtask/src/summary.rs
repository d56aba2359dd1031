//! The results of several test programs, added up.

use std::fmt;

/// What the lines `test result: …` say together.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Summary {
    passed: u64,
    failed: u64,
    ignored: u64,
    measured: u64,
    filtered: u64,
    seconds: f64,
    /// A program failed that counts no tests, or a build did.
    pub(crate) failed_elsewhere: bool,
}

impl Summary {
    /// Adds a line if it is a result.
    pub(crate) fn read(&mut self, line: &str) {
        let Some(result) = line.trim().strip_prefix("test result: ") else {
            return;
        };
        let Some((verdict, counts)) = result.split_once(". ") else {
            return;
        };
        self.failed_elsewhere |= verdict != "ok";
        for part in counts.split(';').map(str::trim) {
            if let Some(time) = part.strip_prefix("finished in ") {
                self.seconds += time.trim_end_matches('s').parse().unwrap_or(0.0);
            } else if let Some((number, what)) = part.split_once(' ') {
                self.count(number.parse().unwrap_or(0), what);
            }
        }
    }

    fn count(&mut self, number: u64, what: &str) {
        match what {
            "passed" => self.passed += number,
            "failed" => self.failed += number,
            "ignored" => self.ignored += number,
            "measured" => self.measured += number,
            "filtered out" => self.filtered += number,
            _ => {}
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ok = self.failed == 0 && !self.failed_elsewhere;
        write!(
            f,
            "test result: {}. {} passed; {} failed; {} ignored; {} measured; {} filtered out; finished in {:.2}s",
            if ok { "ok" } else { "FAILED" },
            self.passed,
            self.failed,
            self.ignored,
            self.measured,
            self.filtered,
            self.seconds
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_add_up() {
        let mut summary = Summary::default();
        for line in [
            "running 3 tests",
            "test it ... ok",
            "test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 2 filtered out; finished in 1.25s\n",
            "test result: ok. 4 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.50s",
        ] {
            summary.read(line);
        }
        assert_eq!(
            summary.to_string(),
            "test result: ok. 7 passed; 0 failed; 1 ignored; 0 measured; 2 filtered out; finished in 1.75s"
        );
        summary.read("test result: FAILED. 1 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.00s");
        assert_eq!(
            summary.to_string(),
            "test result: FAILED. 8 passed; 2 failed; 1 ignored; 0 measured; 2 filtered out; finished in 1.75s"
        );
    }

    #[test]
    fn a_broken_build_is_no_success() {
        let summary = Summary {
            failed_elsewhere: true,
            ..Summary::default()
        };
        assert!(summary
            .to_string()
            .starts_with("test result: FAILED. 0 passed"));
    }
}
