//! Families of functions in which first integrals are searched (T3 §7).
//!
//! A family is a list of *letters*, functions of (t, q, v), and a list of monomials in them. Monomials may depend on each
//! other, as s², c² and 1 do, or by the constraints: relations are found by the search and never counted.

use chetaev_mechanics::System;
use chetaev_symbolic::Expr;
use std::collections::BTreeSet;

/// A function of which monomials are formed.
#[derive(Clone, Debug, PartialEq)]
pub struct Letter {
    /// The function of (t, q, v).
    pub value: Expr,
    /// How it is shown: the name of a quasi-velocity in the place of its definition.
    pub shown: Expr,
}

impl Letter {
    /// A function shown as it is.
    pub fn plain(value: Expr) -> Letter {
        Letter {
            value,
            shown: value,
        }
    }
}

/// A product of powers: pairs (letter, exponent), letters ascending, no exponent zero.
pub type Member = Vec<(usize, i8)>;

/// A family of functions.
#[derive(Clone, Debug)]
pub struct Family {
    /// The letters.
    pub letters: Vec<Letter>,
    /// The monomials, simple ones first; the constant is the first.
    pub members: Vec<Member>,
    /// What it consists of, in words.
    pub words: String,
}

impl Family {
    /// Monomials of degree up to `degree` in the velocities `velocities`, each times one of `functions` of (t, q).
    pub fn over(velocities: &[Letter], functions: &[Letter], degree: u32) -> Family {
        let one = functions.first().map(|_| Vec::new());
        let coefficients: Vec<Member> = one
            .into_iter()
            .chain((0..functions.len()).map(|f| vec![(velocities.len() + f, 1)]))
            .collect();
        let mut letters = velocities.to_vec();
        letters.extend(functions.iter().cloned());
        let mut family = Family {
            letters,
            members: vec![Vec::new()],
            words: String::new(),
        };
        for d in 0..=degree {
            for monomial in monomials(velocities.len(), d) {
                for coefficient in &coefficients {
                    family.push(product(&monomial, coefficient));
                }
                family.push(monomial);
            }
        }
        family
    }

    /// Adds a monomial that is not there yet.
    pub fn push(&mut self, member: Member) {
        if !self.members.contains(&member) {
            self.members.push(member);
        }
    }

    /// The member as an expression in (t, q, v), or as it is shown.
    pub fn expression(&self, system: &System, member: &Member, shown: bool) -> Expr {
        let g = &system.graph;
        let powers: Vec<Expr> = member
            .iter()
            .map(|&(letter, exponent)| {
                let letter = &self.letters[letter];
                let base = if shown { letter.shown } else { letter.value };
                g.powi(base, i64::from(exponent))
            })
            .collect();
        g.mul(&powers)
    }
}

/// The monomials of degree d in the first `count` letters, in the order of the first letters first.
pub fn monomials(count: usize, d: u32) -> Vec<Member> {
    let mut found: Vec<Member> = vec![Vec::new()];
    for _ in 0..d {
        let mut next = Vec::new();
        for member in &found {
            let first = member.last().map_or(0, |&(letter, _)| letter);
            next.extend((first..count).map(|letter| product(member, &vec![(letter, 1)])));
        }
        found = next;
    }
    found
}

/// The product of two monomials.
pub fn product(a: &Member, b: &Member) -> Member {
    let mut letters: Vec<usize> = a.iter().chain(b).map(|&(letter, _)| letter).collect();
    letters.sort_unstable();
    letters.dedup();
    let exponent = |member: &Member, wanted: usize| {
        let found = member.iter().find(|(letter, _)| *letter == wanted);
        found.map_or(0, |&(_, exponent)| exponent)
    };
    letters
        .into_iter()
        .map(|letter| (letter, exponent(a, letter) + exponent(b, letter)))
        .filter(|&(_, exponent)| exponent != 0)
        .collect()
}

/// The greatest exponent of a letter of which all powers are formed that the weight admits.
pub const ANY: i8 = i8::MAX;

/// A letter of the coefficients with the powers that are formed of it.
#[derive(Clone, Debug)]
pub struct CoefficientLetter {
    /// The function of (t, q).
    pub letter: Letter,
    /// Least and greatest exponent.
    pub exponents: (i8, i8),
    /// What one power counts.
    pub weight: u32,
}

/// Monomials in coefficient letters, with numbers from `first` on, of weight up to `most`, light ones first.
pub fn coefficients(letters: &[CoefficientLetter], first: usize, most: u32) -> Vec<(u32, Member)> {
    let mut found: BTreeSet<(u32, Member)> = BTreeSet::from([(0, Vec::new())]);
    for (number, letter) in letters.iter().enumerate() {
        let mut more = Vec::new();
        for (weight, member) in &found {
            let most_factors = i8::try_from((most - weight) / letter.weight.max(1)).unwrap_or(ANY);
            let (least, greatest) = letter.exponents;
            for exponent in least.max(-most_factors)..=greatest.min(most_factors) {
                let heavier = weight + letter.weight * u32::from(exponent.unsigned_abs());
                if exponent != 0 && heavier <= most {
                    more.push((heavier, product(member, &vec![(first + number, exponent)])));
                }
            }
        }
        found.extend(more);
    }
    let mut found: Vec<(u32, Member)> = found.into_iter().collect();
    let is_quotient = |member: &Member| member.iter().any(|&(_, e)| e < 0);
    found.sort_by_key(|(weight, member)| (*weight, is_quotient(member)));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_monomials() {
        assert_eq!(monomials(3, 2).len(), 6);
        assert_eq!(monomials(2, 0), vec![Vec::new()]);
        assert_eq!(monomials(0, 1), Vec::<Member>::new());
        assert_eq!(product(&vec![(0, 1), (2, -1)], &vec![(2, 1)]), vec![(0, 1)]);
    }
}
