//! Numbers of one list in print: six places, or a power of ten where all of them are large or small.

/// How the numbers of a list are printed: what is rounding beside the largest is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decimals {
    largest: f64,
}

/// Sizes of the largest number of a list that are printed with six places.
const USUAL: std::ops::Range<f64> = 1e-3..1e7;
/// What is smaller than this part of the largest number is rounding.
const ROUNDED: f64 = 5e-13;
/// What is zero in six places.
const ZERO: f64 = 5e-7;

impl Decimals {
    /// For complex numbers.
    pub(crate) fn of(list: impl IntoIterator<Item = (f64, f64)>) -> Decimals {
        let sizes = list.into_iter().map(|(re, im)| re.abs().max(im.abs()));
        Decimals {
            largest: sizes.fold(0.0, f64::max),
        }
    }

    /// A complex number.
    pub(crate) fn complex(self, (re, im): (f64, f64)) -> String {
        let (re, im) = (self.plain(re), self.plain(im));
        match (self.is_usual(), im == 0.0) {
            (true, true) => format!("{re:.6}"),
            (true, false) => format!("{re:.6}{im:+.6}i"),
            (false, true) => format!("{re:.6e}"),
            (false, false) => format!("{re:.6e}{im:+.6e}i"),
        }
    }

    fn is_usual(self) -> bool {
        self.largest == 0.0 || USUAL.contains(&self.largest)
    }

    /// No minus before what is zero as it is printed.
    fn plain(self, x: f64) -> f64 {
        let least = if self.is_usual() {
            ZERO
        } else {
            ROUNDED * self.largest
        };
        if x.abs() < least {
            0.0
        } else {
            x
        }
    }
}

/// A real number with so many places, or with a power of ten where these would not show it.
pub(crate) fn real(x: f64, places: usize) -> String {
    if x == 0.0 || USUAL.contains(&x.abs()) {
        format!("{x:.places$}")
    } else {
        format!("{x:.places$e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_those_of_the_largest() {
        let text = |list: &[(f64, f64)]| -> Vec<String> {
            let own = Decimals::of(list.iter().copied());
            list.iter().map(|l| own.complex(*l)).collect()
        };
        assert_eq!(
            text(&[(0.0, 1.0), (-1e-17, 0.0)]),
            ["0.000000+1.000000i", "0.000000"]
        );
        assert_eq!(
            text(&[(1e-40, 1.15e-20), (-2e-20, 0.0)]),
            ["0.000000e0+1.150000e-20i", "-2.000000e-20"]
        );
        assert_eq!(text(&[(-5e-4, -1e10)]), ["0.000000e0-1.000000e10i"]);
    }
}
