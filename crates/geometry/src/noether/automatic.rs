//! The families that are chosen for a system, as large as the budget allows.

use super::conjugate;
use super::family::{Family, ANY};
use super::letters::{Letters, Polar};
use super::plain;
use chetaev_mechanics::Context;
use chetaev_symbolic::Expr;

/// The most members of a family of degree one in the velocities, and of degree two for a system of up to four coordinates and for
/// a larger one, for the usual work.
const MEMBERS: [usize; 3] = [620, 400, 700];

/// The same of a family with multiples of a polar angle.
const WAVES: usize = 520;

/// The same of a family of the degree that the model asks for.
const ASKED: usize = 900;

/// No more work than so many times the usual makes families larger.
const MOST_WORK: f64 = 100.0;

/// So many entries of a list for the work that is allowed: no fewer than for the usual work, and more as its root, since that of linear
/// algebra grows with the cube of their number and a search usually takes little of its time.
pub(super) fn allowed(cx: &Context<'_>, usual: usize) -> usize {
    let times = cx.work().min(MOST_WORK).sqrt();
    (usual as f64 * times) as usize
}

/// No letter counts more: a family that so many weights leave as it is has all its members.
const HEAVIEST: u32 = 3;

/// The largest weight for which a list that grows with it has at most so many entries, with that list; `None` where it has more from
/// the first weight on. What limits it is the work that the list will cost, counted by its entries, so that the result is the same on
/// every machine.
pub(super) fn grown<T>(
    most: usize,
    first: u32,
    make: impl Fn(u32) -> T,
    size: impl Fn(&T) -> usize,
) -> Option<(u32, T)> {
    let mut largest = None;
    let mut same = 0;
    for weight in first.. {
        let next = make(weight);
        if size(&next) > most || same > HEAVIEST {
            break;
        }
        let before = largest.as_ref().map(|(_, list)| size(list));
        same = if before == Some(size(&next)) {
            same + 1
        } else {
            0
        };
        largest = Some((weight, next));
    }
    largest
}

pub(super) fn members(family: &Family) -> usize {
    family.members.len()
}

/// The most quotients of velocities with coefficients, for the usual work.
const QUOTIENTS: usize = 60;

/// The largest families for the work allowed: polynomials of degree one and two in the velocities, of degree two with polynomials in the
/// coordinates as coefficients, of the degree that the model asks for, and quotients. Functions that the model states for the search
/// take nothing away from these: polynomials of degree one and two with them are families of their own.
pub(super) fn families(cx: &Context<'_>, letters: &Letters) -> Vec<Family> {
    let mut families = usual_families(cx, &letters.usual_only());
    if !letters.stated.is_empty() {
        families.extend([1, 2].map(|degree| of_degree(cx, letters, degree)));
    }
    families
}

fn usual_families(cx: &Context<'_>, letters: &Letters) -> Vec<Family> {
    let asked = cx.system.search_degree.filter(|&degree| degree > 2);
    let mut families: Vec<Family> = [1, 2]
        .into_iter()
        .chain(asked)
        .map(|degree| of_degree(cx, letters, degree))
        .collect();
    families.extend(plain::largest(cx, letters));
    families.extend(turned(cx, letters));
    families.extend(conjugate::families(cx, letters));
    let polar = letters.polar.iter();
    families.extend(polar.map(|polar| waves(cx, letters, polar, allowed(cx, WAVES))));
    if letters.velocities.len() > 1 {
        let smallest = || letters.quotients(cx.system, 0);
        let own = quotients(cx, letters, allowed(cx, QUOTIENTS));
        families.push(own.unwrap_or_else(|| without_coefficients(smallest())));
    }
    families.extend(reciprocals(cx, letters));
    families
}

fn without_coefficients(quotients: Family) -> Family {
    Family {
        words: "quotients of two velocities".into(),
        ..quotients
    }
}

/// The largest family of quotients of velocities with at most so many members.
pub(super) fn quotients(cx: &Context<'_>, letters: &Letters, most: usize) -> Option<Family> {
    let make = |weight| letters.quotients(cx.system, weight);
    let (weight, mut quotients) = grown(most, 0, make, members)?;
    if weight == 0 {
        return Some(without_coefficients(quotients));
    }
    quotients.words = format!(
        "quotients of two velocities times coefficients free of the time of weight up to {weight}"
    );
    Some(quotients)
}

/// Reciprocals of velocities with the largest coefficients for the work allowed.
fn reciprocals(cx: &Context<'_>, letters: &Letters) -> Option<Family> {
    let make = |weight| letters.reciprocals(weight);
    let (weight, mut family) = grown(allowed(cx, QUOTIENTS), 0, make, members)?;
    family.words = match weight {
        0 => "reciprocals of velocities".into(),
        _ => format!("reciprocals of velocities times coefficients of weight up to {weight}"),
    };
    Some(family)
}

/// The largest family of polynomials of a degree in the velocities: with heavier coefficients where there are fewer velocities; where that
/// is too much, with the same ones everywhere.
fn of_degree(cx: &Context<'_>, letters: &Letters, degree: u32) -> Family {
    let most = match (degree, cx.system.n()) {
        (1, _) => MEMBERS[0],
        (2, 0..=4) => MEMBERS[1],
        (2, _) => MEMBERS[2],
        _ => ASKED,
    };
    let most = allowed(cx, most);
    // Not even formed where the terms of the highest degree alone are too many.
    let steps: &[u32] = match degree {
        0..=2 => &[1],
        _ if monomials_of_degree(letters.velocities.len(), degree) > 2 * most => &[],
        _ => &[1, 0],
    };
    for &step in steps {
        let make = |weight| letters.stepped(degree, weight, step);
        let smallest = || Some((0, make(0)));
        let fits = |(_, family): &(u32, Family)| family.members.len() <= 2 * most;
        let grown = grown(most, 0, make, members);
        if let Some((weight, mut largest)) = grown.or_else(smallest).filter(fits) {
            largest.words = words(cx, letters, (degree, step), weight);
            if degree == 1 {
                letters.push_timed(cx.system, &mut largest);
            }
            return largest;
        }
    }
    letters.known_only(degree)
}

fn monomials_of_degree(count: usize, degree: u32) -> usize {
    (1..=degree as usize).fold(1, |n: usize, i| n.saturating_mul(count + i - 1) / i)
}

/// Which powers of a letter are formed, where not all of them. A cosine stands with its first power only because of the sine.
fn powers((least, most): (i8, i8)) -> String {
    match (least, most) {
        (0, 1 | ANY) => String::new(),
        (least, ANY) => format!(" to the powers from {least} on"),
        (least, most) => format!(" to the powers {least} to {most}"),
    }
}

/// The family with sines and cosines of coordinates that may be angles.
fn turned(cx: &Context<'_>, letters: &Letters) -> Option<Family> {
    let g = &cx.system.graph;
    letters.turned(1)?;
    let make = |weight| {
        letters
            .turned(weight)
            .unwrap_or_else(|| letters.known_only(1))
    };
    let (weight, mut family) = grown(allowed(cx, MEMBERS[0]), 1, make, members)?;
    let places = 0..letters.coefficients.len();
    let used = places.filter(|&i| letters.is_turned(i));
    let names: Vec<String> = used
        .map(|i| g.text(letters.coefficients[i].letter.shown))
        .collect();
    let velocities: Vec<String> = letters.velocities.iter().map(|l| g.text(l.shown)).collect();
    family.words = format!(
        "polynomials of degree up to 1 in the velocities {}, with products of up to {weight} of {} as coefficients",
        velocities.join(", "),
        names.join(", ")
    );
    Some(family)
}

/// The family with sines and cosines of multiples of a polar angle.
pub(super) fn waves(cx: &Context<'_>, letters: &Letters, polar: &Polar, most: usize) -> Family {
    let g = &cx.system.graph;
    let make = |weight| letters.waves(cx.system, polar, weight);
    let grown = grown(most, 0, make, members);
    let (weight, mut family) = grown.unwrap_or_else(|| (0, make(0)));
    let list = |es: Vec<Expr>| {
        es.iter()
            .map(|&e| g.text(e))
            .collect::<Vec<String>>()
            .join(", ")
    };
    let velocities = letters.velocities.iter().map(|l| l.shown).collect();
    let used = |place: &usize| {
        family
            .members
            .iter()
            .flatten()
            .any(|(letter, _)| letter == place)
    };
    let first = letters.velocities.len();
    let own = letters.coefficients.iter().enumerate();
    let own = own.filter(|(i, _)| used(&(first + i)) && !polar.places.contains(i));
    let built = list(own.map(|(_, c)| c.letter.shown).collect());
    let waves = polar
        .places
        .iter()
        .map(|&i| letters.coefficients[i].letter.shown);
    family.words = format!(
        "polynomials of degree up to 2 in the velocities {} whose terms contain one of {}, with coefficients of weight up to {weight} in the quadratic terms and one more for each velocity less, built of {built}",
        list(velocities),
        list(waves.collect())
    );
    family
}

pub(super) fn words(
    cx: &Context<'_>,
    letters: &Letters,
    (degree, step): (u32, u32),
    weight: u32,
) -> String {
    let g = &cx.system.graph;
    let list = |weight: u32| {
        let numbered = letters.coefficients.iter().enumerate();
        let own = numbered.filter(|(i, c)| {
            c.weight == weight
                && !letters.perhaps_turning.contains(i)
                && c.exponents != (0, 0)
                && (degree == 1 || !letters.turning.contains(i))
        });
        own.map(|(_, c)| format!("{}{}", g.text(c.letter.shown), powers(c.exponents)))
            .collect::<Vec<String>>()
    };
    let velocities: Vec<String> = letters.velocities.iter().map(|l| g.text(l.shown)).collect();
    let weights: Vec<String> = (1..=3)
        .filter(|&w| !list(w).is_empty())
        .map(|w| format!("{} ({w} each)", list(w).join(", ")))
        .collect();
    let more = match (degree, step) {
        (1, _) | (_, 0) => String::new(),
        (2, _) => " in the quadratic terms and one more for each velocity less".into(),
        _ => format!(" in the terms of degree {degree} and one more for each velocity less"),
    };
    let known = match degree >= 2 && !letters.known.is_empty() {
        true => {
            let names: Vec<&str> = letters
                .known
                .iter()
                .map(|(name, _)| name.as_str())
                .collect();
            format!(", and {}", names.join(", "))
        }
        false => String::new(),
    };
    format!(
        "polynomials of degree up to {degree} in the velocities {}, with coefficients of weight up to {weight}{more}, built of {}{known}",
        velocities.join(", "),
        weights.join("; ")
    )
}
