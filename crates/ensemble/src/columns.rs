//! A batch of trajectories as bytes: their numbers, then the columns, every number with eight bytes, little-endian; behind them the
//! reasons of failures.

use crate::outcome::{Outcome, Shape};
use std::collections::HashMap;

/// What the numbers of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Double precision.
    Float,
    /// Signed integers of 64 bits.
    Integer,
}

/// A column: one number for each trajectory, or one for each sample of each trajectory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name: letters, digits and underscores.
    pub name: String,
    /// What the numbers are.
    pub kind: Kind,
    /// Samples for each trajectory; `None` for one number.
    pub samples: Option<usize>,
}

impl Column {
    fn float(name: String) -> Column {
        Column {
            name,
            kind: Kind::Float,
            samples: None,
        }
    }

    fn integer(name: &str) -> Column {
        Column {
            name: name.to_owned(),
            kind: Kind::Integer,
            samples: None,
        }
    }

    /// Numbers for each trajectory.
    pub fn width(&self) -> usize {
        self.samples.unwrap_or(1)
    }
}

/// The columns of an ensemble.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// In order.
    pub list: Vec<Column>,
    shape: Shape,
}

/// Names of what an ensemble consists of.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    /// What varies.
    pub varied: &'a [String],
    /// The components of a state: q, masses with a law of their own, v.
    pub state: &'a [String],
    /// Energy and the stated integrals.
    pub kept: &'a [String],
    /// Events of the model.
    pub events: &'a [String],
    /// Samples along each trajectory.
    pub samples: usize,
}

impl Columns {
    /// `vary_…`; `stop`; `t_start`, `t`, `t_stop`; `steps`, `rejected`; `start_…`; `end_…`; `drift_…`, `drift_constraints`; `count_…`
    /// and `first_…` of events; with samples `sample_t` and `sample_…`. The velocity `x'` is written `x_d`, by [`array_names`].
    pub fn new(names: Names<'_>) -> Columns {
        let quantities: Vec<&String> = names.varied.iter().chain(names.state).collect();
        let written = array_names(&quantities);
        let of: HashMap<&String, &String> = quantities.into_iter().zip(&written).collect();
        let float = |prefix: &str, name: &String| {
            let written = of.get(name).copied().unwrap_or(name);
            Column::float(format!("{prefix}_{written}"))
        };
        let mut list: Vec<Column> = names.varied.iter().map(|n| float("vary", n)).collect();
        list.push(Column::integer("stop"));
        list.extend(["t_start", "t", "t_stop"].map(|name| Column::float(name.into())));
        list.extend(["steps", "rejected"].map(Column::integer));
        for prefix in ["start", "end"] {
            list.extend(names.state.iter().map(|n| float(prefix, n)));
        }
        list.extend(names.kept.iter().map(|n| float("drift", n)));
        list.push(Column::float("drift_constraints".into()));
        for name in names.events {
            list.push(Column::integer(&format!("count_{name}")));
            list.push(float("first", name));
        }
        if names.samples > 0 {
            let sampled = |column: Column| Column {
                samples: Some(names.samples),
                ..column
            };
            list.push(sampled(Column::float("sample_t".into())));
            list.extend(names.state.iter().map(|n| sampled(float("sample", n))));
        }
        Columns {
            list,
            shape: Shape {
                state: names.state.len(),
                kept: names.kept.len(),
                events: names.events.len(),
                samples: names.samples,
            },
        }
    }

    /// How many numbers of each kind an outcome has.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Numbers for each trajectory.
    pub fn width(&self) -> usize {
        self.list.iter().map(Column::width).sum()
    }

    /// A batch as bytes: the numbers of its trajectories; column after column, each of all trajectories; then the failures. A row is
    /// the number of a trajectory, the values of what varies, and what is kept of it.
    pub fn encode(&self, rows: &[(u64, Vec<f64>, Outcome)]) -> Vec<u8> {
        let width = self.width();
        let words: Vec<Vec<u64>> = rows.iter().map(|(_, v, o)| self.words(v, o)).collect();
        let mut bytes = Vec::with_capacity(8 * (1 + width) * rows.len());
        bytes.extend(rows.iter().flat_map(|(index, ..)| index.to_le_bytes()));
        let mut start = 0;
        for column in &self.list {
            let range = start..start + column.width();
            start = range.end;
            for row in &words {
                bytes.extend(row[range.clone()].iter().flat_map(|w| w.to_le_bytes()));
            }
        }
        for (index, _, outcome) in rows {
            if let Some(reason) = &outcome.reason {
                bytes.extend(index.to_le_bytes());
                bytes.extend((reason.len() as u64).to_le_bytes());
                bytes.extend(reason.as_bytes());
            }
        }
        bytes
    }

    /// The numbers of one trajectory, in the order of the columns.
    fn words(&self, varied: &[f64], outcome: &Outcome) -> Vec<u64> {
        let mut words: Vec<u64> = varied.iter().map(|x| x.to_bits()).collect();
        words.push(outcome.stop.number() as u64);
        words.extend([outcome.t_start, outcome.t, outcome.t_stop].map(f64::to_bits));
        words.extend([outcome.steps, outcome.rejected]);
        let floats = outcome.start.iter().chain(&outcome.end);
        words.extend(floats.chain(&outcome.drift).map(|x| x.to_bits()));
        words.push(outcome.constraint_drift.to_bits());
        for seen in &outcome.events {
            words.extend([seen.count, seen.first.to_bits()]);
        }
        // Samples are kept time by time, and written component by component.
        let step = 1 + self.shape.state;
        for i in 0..if outcome.samples.is_empty() { 0 } else { step } {
            words.extend(
                outcome
                    .samples
                    .iter()
                    .skip(i)
                    .step_by(step)
                    .map(|x| x.to_bits()),
            );
        }
        debug_assert_eq!(words.len(), self.width());
        words
    }

    /// Whose a batch of `count` trajectories is: the numbers at its beginning, in the order of the rows.
    pub fn indices(count: usize, bytes: &[u8]) -> Vec<u64> {
        let words = bytes.chunks_exact(8).take(count);
        words.filter_map(|w| Some(word(w)?.0)).collect()
    }

    /// Where the numbers of column `index` lie in a batch of `count` trajectories.
    pub fn range(&self, index: usize, count: usize) -> std::ops::Range<usize> {
        let before = 1 + self.list[..index].iter().map(Column::width).sum::<usize>();
        8 * before * count..8 * (before + self.list[index].width()) * count
    }

    /// The failures in a batch of `count` trajectories: number and reason.
    pub fn failures(&self, count: usize, bytes: &[u8]) -> Vec<(u64, String)> {
        let mut rest = bytes
            .get(8 * (1 + self.width()) * count..)
            .unwrap_or_default();
        let mut found = Vec::new();
        while let Some((index, after)) = word(rest) {
            let Some((length, after)) = word(after) else {
                break;
            };
            let length = (length as usize).min(after.len());
            let (text, after) = after.split_at(length);
            found.push((index, String::from_utf8_lossy(text).into_owned()));
            rest = after;
        }
        found
    }
}

fn word(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (first, rest) = bytes.split_first_chunk::<8>()?;
    Some((u64::from_le_bytes(*first), rest))
}

/// Names as NumPy, and any file system, takes them, no two different names the same: `x'` is `x_d`, `x''` is `x_dd`. A name without
/// primes is kept; where one with primes would be that of another, a number is put behind it: beside a coordinate `x_d` the
/// velocity `x'` is `x_d_2`.
pub fn array_names<S: AsRef<str>>(names: &[S]) -> Vec<String> {
    let kept = names.iter().map(AsRef::as_ref);
    let mut taken: HashMap<String, &str> = kept
        .filter(|name| !name.ends_with('\''))
        .map(|name| (name.to_owned(), name))
        .collect();
    let mut written = Vec::with_capacity(names.len());
    for name in names.iter().map(AsRef::as_ref) {
        let own = numbered(plain(name), |wish| {
            taken.get(wish).is_some_and(|owner| *owner != name)
        });
        taken.insert(own.clone(), name);
        written.push(own);
    }
    written
}

/// A name, with the first number from 2 behind it under which it is not taken.
pub fn numbered(name: String, is_taken: impl Fn(&str) -> bool) -> String {
    let mut own = name.clone();
    for number in 2_u64.. {
        if !is_taken(&own) {
            break;
        }
        own = format!("{name}_{number}");
    }
    own
}

/// `x'` as `x_d`, `x''` as `x_dd`.
fn plain(name: &str) -> String {
    let base = name.trim_end_matches('\'');
    match name.len() - base.len() {
        0 => base.to_string(),
        order => format!("{base}_{}", "d".repeat(order)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_quantities_share_an_array() {
        let state = ["x", "x_d", "x'", "x_d'", "x_d_2'"].map(String::from);
        // What is written without primes keeps its name, in whatever order it stands.
        assert_eq!(
            array_names(&["x'", "x_d", "x_d_2", "x", "x'"]),
            ["x_d_3", "x_d", "x_d_2", "x", "x_d_3"]
        );
        let names = Names {
            varied: &["x'".into(), "a".into()],
            state: &state,
            kept: &["energy".into()],
            events: &["touch".into()],
            samples: 2,
        };
        let list = Columns::new(names).list;
        let mut seen: Vec<&str> = list.iter().map(|c| c.name.as_str()).collect();
        // One quantity has one name in all columns.
        for expected in [
            "vary_x_d_2",
            "start_x_d_2",
            "end_x_d_2",
            "sample_x_d_2",
            "end_x_d",
            "count_touch",
        ] {
            assert!(seen.contains(&expected), "{expected} in {seen:?}");
        }
        let all = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), all);
    }
}
