//! Zeros of an enclosed function of one variable, isolated: none is left out, and each interval holds exactly one.
//!
//! An interval over which the function is enclosed away from zero holds no zero; one over which the derivative is, and at whose ends the signs
//! differ, exactly one; others are halved (R. E. Moore, Interval Analysis, 1966).

use chetaev_symbolic::number::ball::Precision;
use dashu_int::IBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Bits of the ends as they are printed.
const BITS: usize = 256;

/// An interval with exactly one zero, or the zero itself where both ends are equal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    /// The lower end.
    pub low: RBig,
    /// The upper end.
    pub high: RBig,
}

/// Enclosures in order, those that overlap as one.
pub(crate) fn joined(roots: impl IntoIterator<Item = Root>) -> Vec<Root> {
    let mut all: Vec<Root> = roots.into_iter().collect();
    all.sort_by(|a, b| a.low.cmp(&b.low));
    let mut found: Vec<Root> = Vec::new();
    for own in all {
        match found.last_mut() {
            Some(last) if own.low <= last.high => last.high = own.high.max(last.high.clone()),
            _ => found.push(own),
        }
    }
    found
}

impl Root {
    /// Decimal bounds with 20 digits, rounded outwards.
    pub fn decimal_bounds(&self) -> (String, String) {
        let end = |at: &RBig| Precision::new(BITS).rational(at).to_decimal_interval(20);
        let ((low, _), (_, high)) = (end(&self.low), end(&self.high));
        (low, high)
    }

    /// Where a quantity of this name has it: `p = 2`, or `p in [1.41, 1.42]` where the zero itself is not known.
    pub fn place_of(&self, name: &str) -> String {
        if self.low == self.high {
            return format!("{name} = {}", self.low);
        }
        let (low, high) = self.decimal_bounds();
        format!(
            "{name} in [{}, {}]",
            without_power(&low),
            without_power(&high)
        )
    }
}

/// A decimal number of usual size without a power of ten: `4.2924e0` as 4.2924, `4.6e-1` as 0.46.
pub(crate) fn without_power(decimal: &str) -> String {
    let parts = decimal.split_once('e');
    let parts = parts.and_then(|(digits, power)| Some((digits, power.parse::<i32>().ok()?)));
    let Some((digits, power)) = parts.filter(|(_, power)| (-4..=9).contains(power)) else {
        return decimal.into();
    };
    let (sign, digits) = match digits.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", digits),
    };
    let (whole, rest) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{whole}{rest}");
    let point = whole.len() as i32 + power;
    if point <= 0 {
        return format!("{sign}0.{}{all}", "0".repeat(point.unsigned_abs() as usize));
    }
    let point = point.unsigned_abs() as usize;
    if all.len() <= point {
        format!("{sign}{all}{}", "0".repeat(point - all.len()))
    } else {
        format!("{sign}{}.{}", &all[..point], &all[point..])
    }
}

/// What is known of a function over an interval.
pub(crate) enum Look {
    /// It has no zero there.
    Empty,
    /// Its derivative has none.
    Monotonic,
    /// Nothing.
    Open,
}

/// A function that can be enclosed.
pub(crate) trait Enclosed {
    /// Its sign at a number; `None` where it is not decided.
    fn sign(&self, at: &RBig) -> Option<Ordering>;

    /// What is known of it between two numbers.
    fn between(&self, low: &RBig, high: &RBig) -> Look;
}

/// The zeros between two numbers, not counted those at the ends; each interval is halved so often, and on until it is as small a part of the
/// zero itself, however wide the range. `None` where more intervals would have to be
/// looked at, or a sign is not decided, as at a multiple zero.
pub(crate) fn isolated(
    function: &impl Enclosed,
    low: &RBig,
    high: &RBig,
    intervals: usize,
    halvings: usize,
) -> Option<Vec<Root>> {
    let mut found = Vec::new();
    let mut open = vec![(low.clone(), high.clone())];
    let mut looked = 0;
    while let Some((a, b)) = open.pop() {
        looked += 1;
        if looked > intervals {
            return None;
        }
        match function.between(&a, &b) {
            Look::Empty => {}
            Look::Monotonic => {
                let (left, right) = (function.sign(&a)?, function.sign(&b)?);
                if left != Ordering::Equal && right != Ordering::Equal && left != right {
                    found.push(refined(function, a, b, left, halvings)?);
                }
            }
            Look::Open => {
                let middle = beside_zeros(function, &a, &b)?;
                open.push((a, middle.clone()));
                open.push((middle, b));
            }
        }
    }
    Some(found)
}

/// A place near the middle where the function does not vanish: zeros lie inside of intervals.
fn beside_zeros(function: &impl Enclosed, a: &RBig, b: &RBig) -> Option<RBig> {
    let at = |part: u8| a + (b - a) * RBig::from(part) / RBig::from(64_u8);
    let mut places = [32, 31, 35, 27].into_iter().map(at);
    places.find(|place| function.sign(place).is_some_and(|s| s != Ordering::Equal))
}

/// Halvings for zeros that are small against the range: 2^−1000 of it at least.
const FURTHER: usize = 1_000;

/// Whether an interval is at most the part 2^−n of the numbers in it.
fn is_small(a: &RBig, b: &RBig, halvings: usize) -> bool {
    let size = |x: &RBig| x.clone().max(-x.clone());
    let smallest = size(a).min(size(b));
    (b - a) * RBig::from(IBig::ONE << halvings) <= smallest
}

/// The zero between two places with different signs, `left` being that of the lower one; as close as signs are decided. A rational zero is found
/// itself: between two close places it is the number with the smallest denominator.
fn refined(
    function: &impl Enclosed,
    mut a: RBig,
    mut b: RBig,
    left: Ordering,
    halvings: usize,
) -> Option<Root> {
    for step in 0..halvings + FURTHER {
        if step >= halvings && is_small(&a, &b, halvings) {
            break;
        }
        let middle = (&a + &b) / RBig::from(2_u8);
        // Where the zero is the middle itself its sign may be undecided.
        let place = match function.sign(&middle) {
            Some(_) => Some(middle),
            None => beside_zeros(function, &a, &b),
        };
        let Some(place) = place else { break };
        match function.sign(&place)? {
            Ordering::Equal => {
                return Some(Root {
                    low: place.clone(),
                    high: place,
                })
            }
            own if own == left => a = place,
            _ => b = place,
        }
    }
    let simplest = RBig::simplest_in(a.clone(), b.clone());
    if function.sign(&simplest) == Some(Ordering::Equal) {
        (a, b) = (simplest.clone(), simplest);
    }
    Some(Root { low: a, high: b })
}

#[cfg(test)]
mod tests {
    use super::without_power;

    #[test]
    fn numbers_of_usual_size_have_no_power() {
        let pairs = [
            ("4.2924e0", "4.2924"),
            ("-4.6475e-1", "-0.46475"),
            ("1.5e3", "1500"),
            ("1.2345e2", "123.45"),
            ("2e-3", "0.002"),
            ("1e0", "1"),
            ("3.1e-12", "3.1e-12"),
            ("3.1e12", "3.1e12"),
            ("0", "0"),
        ];
        for (written, plain) in pairs {
            assert_eq!(without_power(written), plain);
        }
    }
}
