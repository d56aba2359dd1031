//! The family of polynomials in velocities and coordinates, where other functions take the place of these in the family of degree two:
//! integrals as Neumann's and Joachimsthal's, or with the time as those of scaling symmetries.

use super::automatic::{allowed, grown, members};
use super::family::{coefficients, monomials, product, CoefficientLetter, Family, Member, ANY};
use super::letters::Letters;
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::Expr;

/// The most members for the usual work.
const MEMBERS: usize = 440;

/// The highest power of the time in integrals of scaling symmetries: `t² E - t Σ x x' + Σ x²/2`.
const TIMES: i8 = 2;

/// The letters of the family.
struct Plain<'l> {
    letters: &'l Letters,
    /// The coefficients, of which only coordinates have powers, each of weight one.
    own: Vec<CoefficientLetter>,
    /// The number of the time among all letters.
    time: usize,
}

/// The largest family for the work allowed; `None` where all functions that occur are such polynomials, and where there are angles.
pub(super) fn largest(cx: &Context<'_>, letters: &Letters) -> Option<Family> {
    let plain = Plain::of(cx.system, letters)?;
    let most = allowed(cx, MEMBERS);
    let (weight, mut family) = grown(most, 0, |weight| plain.family(weight), members)?;
    family.words = words(cx, letters, weight);
    Some(family)
}

fn words(cx: &Context<'_>, letters: &Letters, weight: u32) -> String {
    let g = &cx.system.graph;
    let velocities: Vec<String> = letters.velocities.iter().map(|l| g.text(l.shown)).collect();
    let own: Vec<&str> = cx.system.coordinates.iter().map(|c| &c.name[..]).collect();
    let known: Vec<&str> = letters.known.iter().map(|(name, _)| &name[..]).collect();
    let known = match known.is_empty() {
        true => String::new(),
        false => format!(", and {}", known.join(", ")),
    };
    format!(
        "polynomials of degree up to 2 in the velocities {} with polynomials in {} as coefficients, of degree up to {weight} in the quadratic terms and one more for each velocity less, also times t and t^2 those of up to first degree in velocities and coordinates or second in the coordinates{known}",
        velocities.join(", "),
        own.join(", "),
    )
}

impl<'l> Plain<'l> {
    fn of(system: &System, letters: &'l Letters) -> Option<Plain<'l>> {
        let time = system.graph.symbol("t", 0);
        let is_coordinate = |e: Expr| system.coordinates.iter().any(|q| q.q == e);
        let values = letters.coefficients.iter().map(|c| c.letter.value);
        let place = values.clone().position(|e| e == time)?;
        let others = letters.coefficients.iter().any(|c| {
            let e = c.letter.value;
            !is_coordinate(e) && e != time && c.exponents != (0, 0)
        });
        if !others || letters.circular > 0 {
            return None;
        }
        let mut own = letters.coefficients.clone();
        for c in &mut own {
            let is_plain = is_coordinate(c.letter.value);
            c.exponents = if is_plain { (0, ANY) } else { (0, 0) };
            c.weight = 1;
        }
        Some(Plain {
            letters,
            own,
            time: letters.velocities.len() + place,
        })
    }

    /// Coefficients of degree up to `weight` in the quadratic terms, and one more for each velocity less; t and t² times terms of up to
    /// first degree in velocities and in coordinates, or of second in the coordinates, and times the known functions.
    fn family(&self, weight: u32) -> Family {
        let mut members: Vec<(u32, Member)> = Vec::new();
        for d in 0..=2 {
            members.extend(self.terms(d, weight + 2 - d));
        }
        for power in 1..=TIMES {
            let timed: Member = vec![(self.time, power)];
            let own = self.terms(0, 2).into_iter().chain(self.terms(1, 1));
            let heavier = 2 * u32::from(power.unsigned_abs());
            members.extend(own.map(|(w, member)| (w + heavier, product(&member, &timed))));
        }
        members.sort_by_key(|(weight, member)| (*weight, self.letters.degree(member)));
        let mut members: Vec<Member> = members.into_iter().map(|(_, member)| member).collect();
        let first = self.letters.velocities.len() + self.letters.coefficients.len();
        for power in 0..=TIMES {
            let timed: Member = (power > 0)
                .then_some((self.time, power))
                .into_iter()
                .collect();
            let known = 0..self.letters.known.len();
            members.extend(known.map(|i| product(&vec![(first + i, 1)], &timed)));
        }
        Family {
            letters: self.letters.all(),
            members,
            words: String::new(),
        }
    }

    /// Terms of degree d in the velocities and up to `most` in the coordinates, with their degrees in both.
    fn terms(&self, d: u32, most: u32) -> Vec<(u32, Member)> {
        let count = self.letters.velocities.len();
        let functions = coefficients(&self.own, count, most);
        let mut terms = Vec::new();
        for monomial in monomials(count, d) {
            let own = functions.iter();
            terms.extend(own.map(|(w, f)| (d + w, product(&monomial, f))));
        }
        terms
    }
}
