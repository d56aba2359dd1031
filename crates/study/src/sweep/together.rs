//! How variations go together: in a product, or walked together.

use super::vary::{Values, Variation, MOST};

/// All variations, and how they go together.
#[derive(Clone, Debug, PartialEq)]
pub struct Variations {
    list: Vec<Variation>,
    /// Variations by axis: those of one axis go together, the axes make a product. The first axis is the slowest.
    axes: Vec<Vec<usize>>,
    seed: u64,
}

/// How the variations of a sweep go together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Together {
    /// Ranges are walked together instead of making a product.
    pub zip: bool,
    /// How many random values are drawn.
    pub count: Option<u64>,
    /// What the random values follow from.
    pub seed: u64,
}

/// Why variations do not go together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VariationError {
    /// Nothing varies.
    #[error("nothing varies: give --vary NAME=FROM:TO:COUNT, --initial NAME=FROM:TO:COUNT or --rows FILE")]
    Nothing,
    /// A quantity is given twice.
    #[error("`{0}` is varied twice")]
    Twice(String),
    /// Ranges of different lengths are to be walked together.
    #[error("ranges that are walked together need the same number of values: `{first}` has {first_count}, `{other}` has {other_count}")]
    Lengths {
        /// One.
        first: String,
        /// Its values.
        first_count: u64,
        /// Another.
        other: String,
        /// Its values.
        other_count: u64,
    },
    /// Random values without a number.
    #[error("`{0}` takes random values: say how many by --count N")]
    NoCount(String),
    /// No random values.
    #[error("--count is 0: no random values would be drawn for `{0}`, so there is no trajectory; give a number of at least one")]
    NoneDrawn(String),
    /// A number of random values that nothing takes.
    #[error("--count says how many random values are drawn, and no range is random: write NAME=FROM:TO:uniform")]
    UnusedCount,
    /// Too many.
    #[error("this makes more than {MOST} trajectories")]
    TooMany,
}

impl Variations {
    /// Puts variations together: a product, in which the first varies slowest; random ones make one axis together, and so do
    /// `rows`, which come first.
    ///
    /// # Errors
    /// [`VariationError`].
    pub fn new(
        rows: Vec<Variation>,
        ranges: Vec<Variation>,
        together: Together,
    ) -> Result<Variations, VariationError> {
        let (of_rows, mut list) = (rows.len(), rows);
        list.extend(ranges);
        if list.is_empty() {
            return Err(VariationError::Nothing);
        }
        for (at, variation) in list.iter().enumerate() {
            if list[..at]
                .iter()
                .any(|other| other.target == variation.target)
            {
                return Err(VariationError::Twice(variation.name.clone()));
            }
        }
        let is_random = |v: &Variation| matches!(v.values, Values::Random(..));
        let random: Vec<usize> = (0..list.len()).filter(|&at| is_random(&list[at])).collect();
        match (random.first(), together.count) {
            (Some(&at), None) => return Err(VariationError::NoCount(list[at].name.clone())),
            (Some(&at), Some(0)) => return Err(VariationError::NoneDrawn(list[at].name.clone())),
            (None, Some(_)) => return Err(VariationError::UnusedCount),
            (_, count) => random
                .iter()
                .for_each(|&at| list[at].count = count.unwrap_or_default()),
        }
        let others = (of_rows..list.len()).filter(|at| !random.contains(at));
        let axes: Vec<Vec<usize>> = match together.zip {
            true => vec![(0..list.len()).collect()],
            false => std::iter::once((0..of_rows).collect())
                .chain(others.map(|at| vec![at]))
                .chain([random.clone()])
                .filter(|axis: &Vec<usize>| !axis.is_empty())
                .collect(),
        };
        let variations = Variations {
            list,
            axes,
            seed: together.seed,
        };
        variations.check()?;
        Ok(variations)
    }

    fn check(&self) -> Result<(), VariationError> {
        let mut count: u64 = 1;
        for axis in &self.axes {
            let first = &self.list[axis[0]];
            for &at in &axis[1..] {
                let other = &self.list[at];
                if other.count != first.count {
                    return Err(VariationError::Lengths {
                        first: first.name.clone(),
                        first_count: first.count,
                        other: other.name.clone(),
                        other_count: other.count,
                    });
                }
            }
            let product = count.checked_mul(first.count).filter(|&all| all <= MOST);
            count = product.ok_or(VariationError::TooMany)?;
        }
        match count {
            0 => Err(VariationError::Nothing),
            _ => Ok(()),
        }
    }

    /// The variations, in the order of their values.
    pub fn list(&self) -> &[Variation] {
        &self.list
    }

    /// Number of trajectories.
    pub fn count(&self) -> u64 {
        self.axes
            .iter()
            .map(|axis| self.list[axis[0]].count)
            .product()
    }

    /// The values of trajectory `index`, one for each variation.
    pub fn values(&self, index: u64) -> Vec<f64> {
        let mut values = vec![0.0; self.list.len()];
        let mut rest = index;
        for axis in self.axes.iter().rev() {
            let count = self.list[axis[0]].count;
            for &at in axis {
                values[at] = self.list[at].value(rest % count, count, self.seed);
            }
            rest /= count;
        }
        values
    }

    /// What was asked for, for a record: enough to tell whether another sweep is the same.
    pub fn describe(&self) -> String {
        let axis = |places: &Vec<usize>| {
            let own = places.iter().map(|&place| self.list[place].describe());
            own.collect::<Vec<String>>().join(" with ")
        };
        let axes: Vec<String> = self.axes.iter().map(axis).collect();
        format!("{}; seed {}", axes.join("; "), self.seed)
    }
}
