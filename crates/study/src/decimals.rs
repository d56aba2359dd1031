//! Numbers in print: some places, or a power of ten where they are large or small.

/// How the numbers of a list are printed: what is rounding beside the largest is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decimals {
    largest: f64,
    places: usize,
    is_exact: bool,
}

/// Sizes of the largest number of a list that are printed without a power of ten.
const USUAL: std::ops::Range<f64> = 1e-3..1e7;
/// What is smaller than this part of the largest number is rounding.
const ROUNDED: f64 = 5e-13;
/// States are known to this part of one.
pub(crate) const KNOWN: f64 = 1e-12;

impl Decimals {
    /// For complex numbers, with six places.
    pub(crate) fn of(list: impl IntoIterator<Item = (f64, f64)>) -> Decimals {
        let sizes = list.into_iter().map(|(re, im)| re.abs().max(im.abs()));
        Decimals {
            largest: sizes.fold(0.0, f64::max),
            places: 6,
            is_exact: false,
        }
    }

    /// For numbers that are known however small they are beside the others.
    pub(crate) fn exact_if(self, is_exact: bool) -> Decimals {
        Decimals { is_exact, ..self }
    }

    pub(crate) fn with_places(self, places: usize) -> Decimals {
        Decimals { places, ..self }
    }

    /// A complex number.
    pub(crate) fn complex(self, z: (f64, f64)) -> String {
        self.known(z, self.error())
    }

    /// Parts that are not printed are smaller than this.
    fn error(self) -> f64 {
        if self.is_exact {
            0.0
        } else {
            f64::INFINITY
        }
    }

    /// A complex number that is known to an error: parts that are larger are no zeros, however small they are.
    pub(crate) fn known(self, (re, im): (f64, f64), error: f64) -> String {
        let sign = if im < 0.0 { '-' } else { '+' };
        let real = self.part(re, error).unwrap_or_else(|| self.text(0.0));
        match self.part(im.abs(), error) {
            None => real,
            Some(im) => format!("{real}{sign}{im}i"),
        }
    }

    /// A complex number as it is typeset: `−0.33 + 2.1 i`.
    pub(crate) fn typeset(self, (re, im): (f64, f64)) -> String {
        let sign = if im < 0.0 { '−' } else { '+' };
        let part = |x: f64| Some(self.part(x, self.error())?.replace('-', "−"));
        let real = part(re).unwrap_or_else(|| self.text(0.0));
        match part(im.abs()) {
            None => real,
            Some(im) => format!("{real} {sign} {im} i"),
        }
    }

    /// A real number; `None` where it is zero to an error, or as it would be printed.
    fn part(self, x: f64, error: f64) -> Option<String> {
        match (self.is_zero_in_print(x), x == 0.0 || x.abs() <= error) {
            (false, _) => Some(self.text(x)),
            (true, true) => None,
            (true, false) if self.is_usual() => Some(format!("{x:.2e}")),
            (true, false) => Some(self.text(x)),
        }
    }

    fn text(self, x: f64) -> String {
        let places = self.places;
        if self.is_usual() {
            format!("{x:.places$}")
        } else {
            format!("{x:.places$e}")
        }
    }

    fn is_usual(self) -> bool {
        self.largest == 0.0 || USUAL.contains(&self.largest)
    }

    /// Whether a number has no digit in print but zeros.
    fn is_zero_in_print(self, x: f64) -> bool {
        let least = if self.is_usual() {
            0.5 * 0.1_f64.powi(self.places as i32)
        } else {
            ROUNDED * self.largest
        };
        x.abs() < least
    }
}

/// A component of a state that was solved for, which is zero to rounding or has so many places.
pub(crate) fn of_state(x: f64, places: usize) -> String {
    if x.abs() < KNOWN {
        real(0.0, places)
    } else {
        real(x, places)
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
        let own = Decimals::of([(-0.25, 1.5)]).with_places(2);
        assert_eq!(own.typeset((-0.25, -1.5)), "−0.25 − 1.50 i");
        assert_eq!(own.typeset((0.001, 0.0)), "0.00");
        let own = Decimals::of([(-2e-20, 3e-20)]).with_places(1);
        assert_eq!(own.typeset((-2e-20, 3e-20)), "−2.0e−20 + 3.0e−20 i");
    }

    #[test]
    fn small_numbers_beside_large_ones() {
        let own = Decimals::of([(1.0, 0.0)]);
        assert_eq!(own.known((1e-9, 0.0), 1e-14), "1.00e-9");
        assert_eq!(own.known((-1e-9, -2.0), 1e-14), "-1.00e-9-2.000000i");
        assert_eq!(own.known((1e-16, -2.0), 1e-14), "0.000000-2.000000i");
        let own = own.exact_if(true);
        assert_eq!(own.complex((1e-16, -2.0)), "1.00e-16-2.000000i");
        assert_eq!(own.complex((0.0, 1e-20)), "0.000000+1.00e-20i");
        assert_eq!(own.typeset((-1e-16, 0.0)), "−1.00e−16");
        let own = Decimals::of([(1e8, 0.0)]).exact_if(true);
        assert_eq!(own.complex((-1e-9, 0.0)), "-1.000000e-9");
        assert_eq!(own.complex((-1e8, 0.0)), "-1.000000e8");
    }

    #[test]
    fn states_of_all_sizes() {
        assert_eq!(of_state(3e-17, 6), "0.000000");
        assert_eq!(of_state(-2.5e-9, 6), "-2.500000e-9");
        assert_eq!(of_state(0.25, 3), "0.250");
    }
}
