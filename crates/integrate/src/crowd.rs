//! Events that repeat without end: the motion grazes a zero, or chatters across it, at every one of very short steps.

use crate::event::EventRecord;

/// So many steps in a row, each with a zero of the same function, are looked at.
const ROW: u64 = 50;
/// Steps in such a row are on the average shorter than this part of the longest step of the run: a function that merely oscillates fast has
/// many zeros in steps of ordinary length.
const SHORT: f64 = 1e-2;

/// The present row of one function.
#[derive(Debug, Clone, Copy)]
struct Row {
    steps: u64,
    since: f64,
}

/// What is remembered of all functions.
#[derive(Debug)]
pub(crate) struct Crowd {
    rows: Vec<Row>,
    longest: f64,
    seen: usize,
}

impl Crowd {
    pub(crate) fn new(events: usize) -> Crowd {
        let row = Row {
            steps: 0,
            since: 0.0,
        };
        Crowd {
            rows: vec![row; events],
            longest: 0.0,
            seen: 0,
        }
    }

    /// Takes a step from time t of length h and all records so far into account; the function whose zeros repeat without end, if
    /// there is one, and in how many steps they were met.
    pub(crate) fn after(
        &mut self,
        (t, h): (f64, f64),
        all: &[EventRecord],
    ) -> Option<(usize, u64)> {
        self.longest = self.longest.max(h.abs());
        let recent = &all[self.seen.min(all.len())..];
        self.seen = all.len();
        for (index, row) in self.rows.iter_mut().enumerate() {
            if recent.iter().all(|record| record.index != index) {
                row.steps = 0;
                continue;
            }
            if row.steps == 0 {
                row.since = t;
            }
            row.steps += 1;
        }
        let end = t + h;
        let mut rows = self.rows.iter().enumerate();
        rows.find_map(|(index, row)| {
            let length = (end - row.since).abs() / row.steps.max(1) as f64;
            (row.steps >= ROW && length < SHORT * self.longest).then_some((index, row.steps))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::event::EventKind;

    fn steps(lengths: impl Iterator<Item = f64>) -> Option<(usize, u64)> {
        let (mut crowd, mut all, mut t) = (Crowd::new(1), Vec::new(), 0.0);
        for h in lengths {
            all.push(EventRecord {
                t,
                index: 0,
                kind: EventKind::Grazing,
                row: Vec::new(),
            });
            if let Some(found) = crowd.after((t, h), &all) {
                return Some(found);
            }
            t += h;
        }
        None
    }

    #[test]
    fn short_steps_with_an_event_each_are_a_crowd() {
        let shrinking = std::iter::once(1.0)
            .chain(std::iter::repeat(1e-5))
            .take(500);
        assert!(steps(shrinking).is_some_and(|(_, count)| count < 200));
        // A zero in every step of ordinary length is an oscillation.
        assert_eq!(steps(std::iter::repeat_n(1.0, 500)), None);
        assert_eq!(steps((0..500).map(|j| 0.1 + f64::from(j % 7))), None);
    }
}
