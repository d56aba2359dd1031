//! Which times are recorded.

use crate::integrate::Output;
use crate::IntegrateError;

/// Rows more than this are refused before the run rather than after the memory is gone.
const MOST_ROWS: f64 = 1e8;

/// The output times still ahead.
#[derive(Debug)]
pub(crate) enum Schedule {
    EndOnly,
    Steps,
    Every {
        t0: f64,
        dt: f64,
        count: u64,
        next: u64,
        end: f64,
    },
    Times {
        times: Vec<f64>,
        next: usize,
    },
}

impl Schedule {
    pub(crate) fn new(
        output: &Output,
        (t0, t_end): (f64, f64),
    ) -> Result<Schedule, IntegrateError> {
        match output {
            Output::End => Ok(Schedule::EndOnly),
            Output::Steps => Ok(Schedule::Steps),
            Output::Every(dt) => {
                let span = t_end - t0;
                let count = (span.abs() / dt * (1.0 + 4.0 * f64::EPSILON)).floor();
                if !(*dt > 0.0 && dt.is_finite() && count < MOST_ROWS) {
                    return Err(IntegrateError::InvalidInterval {
                        what: "the output interval",
                        found: *dt,
                    });
                }
                Ok(Schedule::Every {
                    t0,
                    dt: dt.copysign(span),
                    count: count as u64,
                    next: 0,
                    end: t_end,
                })
            }
            Output::Times(times) => {
                let direction = if t_end < t0 { -1.0 } else { 1.0 };
                let mut last = t0;
                for (index, time) in times.iter().enumerate() {
                    let inside = (t_end - time) * direction >= 0.0;
                    if !(inside && (time - last) * direction >= 0.0) {
                        return Err(IntegrateError::InvalidOutputTime { index, time: *time });
                    }
                    last = *time;
                }
                Ok(Schedule::Times {
                    times: times.clone(),
                    next: 0,
                })
            }
        }
    }

    /// The next time to record, if it is known in advance. Grid times are t0 + j·dt, never accumulated; one that
    /// equals the end of the span up to rounding is the end of the span.
    pub(crate) fn next(&self) -> Option<f64> {
        match self {
            Schedule::EndOnly | Schedule::Steps => None,
            Schedule::Every { next, count, .. } if next > count => None,
            Schedule::Every {
                t0, dt, next, end, ..
            } => {
                let time = t0 + *next as f64 * dt;
                let beyond = (time - end) * dt.signum();
                let near = 8.0 * f64::EPSILON * end.abs().max(t0.abs());
                Some(if beyond > -near { *end } else { time })
            }
            Schedule::Times { times, next } => times.get(*next).copied(),
        }
    }

    /// Marks the time last returned by [`next`](Schedule::next) as recorded.
    pub(crate) fn advance(&mut self) {
        match self {
            Schedule::Every { next, .. } => *next += 1,
            Schedule::Times { next, .. } => *next += 1,
            Schedule::EndOnly | Schedule::Steps => {}
        }
    }

    /// Whether the end of every step is recorded.
    pub(crate) fn every_step(&self) -> bool {
        matches!(self, Schedule::Steps)
    }

    /// Whether the last state of the run is recorded although its time was not asked for.
    pub(crate) fn with_last(&self) -> bool {
        !matches!(self, Schedule::Times { .. })
    }

    /// Whether the initial state is recorded although its time was not asked for.
    pub(crate) fn with_first(&self) -> bool {
        matches!(self, Schedule::Steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(output: &Output, span: (f64, f64)) -> Vec<f64> {
        let mut schedule = Schedule::new(output, span).unwrap();
        let mut times = Vec::new();
        while let Some(t) = schedule.next() {
            times.push(t);
            schedule.advance();
        }
        times
    }

    #[test]
    fn grids_are_not_accumulated_and_end_on_the_end() {
        let times = grid(&Output::Every(0.1), (0.0, 1.0));
        assert_eq!(times.len(), 11);
        assert_eq!(times[3], 3.0 * 0.1);
        assert_eq!(times[10], 1.0);
        let times = grid(&Output::Every(0.1), (0.0, 0.3));
        assert_eq!(times.last(), Some(&0.3));
        let times = grid(&Output::Every(0.4), (1.0, 0.0));
        assert_eq!(times, [1.0, 1.0 - 0.4, 1.0 - 0.8]);
        assert_eq!(grid(&Output::Every(0.4), (2.0, 2.0)), [2.0]);
    }

    #[test]
    fn bad_times_are_refused() {
        let bad =
            |times: &[f64]| Schedule::new(&Output::Times(times.to_vec()), (0.0, 1.0)).is_err();
        assert!(bad(&[0.5, 0.2]));
        assert!(bad(&[1.5]));
        assert!(bad(&[f64::NAN]));
        assert!(!bad(&[0.0, 0.5, 1.0]));
        assert!(Schedule::new(&Output::Every(0.0), (0.0, 1.0)).is_err());
        assert!(Schedule::new(&Output::Every(1e-300), (0.0, 1.0)).is_err());
    }
}
