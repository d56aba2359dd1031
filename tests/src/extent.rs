//! How much of the long tests a run takes: all, or one of five parts, so that five runs of different commits take all of them.
//!
//! Plain standard library: the task runner reads the same file, and says which part it is.

use std::path::Path;
use std::process::Command;

/// Number of parts.
pub const PARTS: u64 = 5;

/// The variable that says what is taken: [`ALL`], or the number of a part.
pub const VARIABLE: &str = "CHETAEV_TESTS";

/// Value of the variable for all parts, and more random cases.
pub const ALL: &str = "full";

/// What a run takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Everything, and more random cases.
    Full,
    /// The items of this part, from 0 to [`PARTS`] − 1.
    Part(u64),
}

impl Extent {
    /// What this run takes: as the variable says, otherwise the part that follows from the commit that is checked out, so that
    /// the same commit is always tested alike. Part 0 where there is no commit.
    pub fn of_run(root: &Path) -> Extent {
        let said = std::env::var(VARIABLE).ok();
        said.and_then(|value| Extent::named(&value))
            .or_else(|| commit(root).map(|commit| Extent::of_commit(&commit)))
            .unwrap_or(Extent::Part(0))
    }

    /// What a value of the variable means.
    pub fn named(value: &str) -> Option<Extent> {
        if value == ALL {
            return Some(Extent::Full);
        }
        let number: u64 = value.parse().ok()?;
        (number < PARTS).then_some(Extent::Part(number))
    }

    /// The part of a commit: its first eight digits as a number, modulo the number of parts.
    pub fn of_commit(commit: &str) -> Extent {
        let digits = commit.get(..8).unwrap_or(commit);
        Extent::Part(u64::from_str_radix(digits, 16).unwrap_or(0) % PARTS)
    }

    /// Whether item `number` of a list is taken.
    pub fn takes(self, number: u64) -> bool {
        match self {
            Extent::Full => true,
            Extent::Part(part) => number % PARTS == part,
        }
    }

    /// The items of a list that are taken.
    pub fn of<T>(self, list: &[T]) -> Vec<&T> {
        let numbered = (0..).zip(list);
        let taken = numbered.filter(|(number, _)| self.takes(*number));
        taken.map(|(_, item)| item).collect()
    }
}

/// The commit that is checked out, in hexadecimal digits.
pub fn commit(root: &Path) -> Option<String> {
    let mut git = Command::new("git");
    let asked = git.args(["rev-parse", "HEAD"]).current_dir(root).output();
    let answer = String::from_utf8(asked.ok()?.stdout).ok()?;
    let commit = answer.trim();
    (commit.len() >= 8).then(|| commit.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_are_disjoint_and_together_everything() {
        let list: Vec<u64> = (0..23).collect();
        let parts = (0..PARTS).flat_map(|part| Extent::Part(part).of(&list));
        let mut all: Vec<u64> = parts.copied().collect();
        all.sort_unstable();
        assert_eq!(all, list);
        assert_eq!(Extent::Full.of(&list).len(), list.len());
    }

    #[test]
    fn a_part_is_named_or_follows_from_the_commit() {
        assert_eq!(Extent::named("full"), Some(Extent::Full));
        assert_eq!(Extent::named("4"), Some(Extent::Part(4)));
        assert_eq!(Extent::named("5"), None);
        // 0x0000000b = 11.
        assert_eq!(Extent::of_commit("0000000bffff"), Extent::Part(1));
    }
}
