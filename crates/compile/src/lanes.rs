//! Many states side by side: one number for each of them.

/// How many states a block holds.
pub const LANES: usize = 32;

const CHUNK: usize = 8;

/// One number for each state of a block.
#[derive(Clone, Copy, PartialEq, Debug)]
#[repr(align(64))]
pub struct Lanes([[f64; CHUNK]; LANES / CHUNK]);

impl Lanes {
    /// The same number for every state.
    pub fn splat(value: f64) -> Lanes {
        Lanes([[value; CHUNK]; LANES / CHUNK])
    }

    /// The number `value(l)` for state l.
    pub fn from_fn(mut value: impl FnMut(usize) -> f64) -> Lanes {
        let mut lanes = Lanes::splat(0.0);
        for (l, slot) in lanes.0.as_flattened_mut().iter_mut().enumerate() {
            *slot = value(l);
        }
        lanes
    }

    /// The numbers of all states, in order.
    pub fn as_slice(&self) -> &[f64] {
        self.0.as_flattened()
    }

    /// The numbers of all states, in order.
    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        self.0.as_flattened_mut()
    }
}

impl Default for Lanes {
    fn default() -> Self {
        Lanes::splat(0.0)
    }
}

/// What a register holds: one number, or one for each state of a block.
///
/// The interpreter and the linear algebra are written once over this trait, so that a block computes bit for bit
/// what single states compute. Operations read whole registers before they write, so registers may coincide.
pub(crate) trait Word: Copy + Default {
    /// How many states.
    const LANES: usize;

    fn splat(value: f64) -> Self;
    fn lane(&self, l: usize) -> f64;
    fn set_lane(&mut self, l: usize, value: f64);

    fn unary(file: &mut [Self], out: usize, a: usize, f: impl Fn(f64) -> f64);
    fn binary(file: &mut [Self], out: usize, a: usize, b: usize, f: impl Fn(f64, f64) -> f64);
    fn ternary(
        file: &mut [Self],
        out: usize,
        abc: (usize, usize, usize),
        f: impl Fn(f64, f64, f64) -> f64,
    );
    /// Writes the result of `f`, where `f` says by `false` that `slow` has to be used instead.
    fn guarded(
        file: &mut [Self],
        out: usize,
        a: usize,
        f: impl Fn(f64) -> (f64, bool),
        slow: impl Fn(f64) -> f64,
    );
    /// Writes both results of `f`, where `f` says by `false` that `slow` has to be used instead.
    fn pair(
        file: &mut [Self],
        out: (usize, usize),
        a: usize,
        f: impl Fn(f64) -> (f64, f64, bool),
        slow: impl Fn(f64) -> (f64, f64),
    );
    /// `self ← f(self, a, b)`.
    fn update(&mut self, a: &Self, b: &Self, f: impl Fn(f64, f64, f64) -> f64);
}

impl Word for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn lane(&self, _: usize) -> f64 {
        *self
    }
    #[inline(always)]
    fn set_lane(&mut self, _: usize, value: f64) {
        *self = value;
    }
    #[inline(always)]
    fn unary(file: &mut [f64], out: usize, a: usize, f: impl Fn(f64) -> f64) {
        file[out] = f(file[a]);
    }
    #[inline(always)]
    fn binary(file: &mut [f64], out: usize, a: usize, b: usize, f: impl Fn(f64, f64) -> f64) {
        file[out] = f(file[a], file[b]);
    }
    #[inline(always)]
    fn ternary(
        file: &mut [f64],
        out: usize,
        (a, b, c): (usize, usize, usize),
        f: impl Fn(f64, f64, f64) -> f64,
    ) {
        file[out] = f(file[a], file[b], file[c]);
    }
    #[inline(always)]
    fn guarded(
        file: &mut [f64],
        out: usize,
        a: usize,
        f: impl Fn(f64) -> (f64, bool),
        slow: impl Fn(f64) -> f64,
    ) {
        let x = file[a];
        let (value, is_good) = f(x);
        file[out] = if is_good { value } else { slow(x) };
    }
    #[inline(always)]
    fn pair(
        file: &mut [f64],
        out: (usize, usize),
        a: usize,
        f: impl Fn(f64) -> (f64, f64, bool),
        slow: impl Fn(f64) -> (f64, f64),
    ) {
        let x = file[a];
        let (mut first, mut second, is_good) = f(x);
        if !is_good {
            (first, second) = slow(x);
        }
        file[out.0] = first;
        file[out.1] = second;
    }
    #[inline(always)]
    fn update(&mut self, a: &f64, b: &f64, f: impl Fn(f64, f64, f64) -> f64) {
        *self = f(*self, *a, *b);
    }
}

impl Word for Lanes {
    const LANES: usize = LANES;

    #[inline(always)]
    fn splat(value: f64) -> Lanes {
        Lanes::splat(value)
    }
    #[inline(always)]
    fn lane(&self, l: usize) -> f64 {
        self.0[l / CHUNK][l % CHUNK]
    }
    #[inline(always)]
    fn set_lane(&mut self, l: usize, value: f64) {
        self.0[l / CHUNK][l % CHUNK] = value;
    }
    #[inline(always)]
    fn unary(file: &mut [Lanes], out: usize, a: usize, f: impl Fn(f64) -> f64) {
        for chunk in 0..LANES / CHUNK {
            let a = file[a].0[chunk];
            file[out].0[chunk] = std::array::from_fn(|l| f(a[l]));
        }
    }
    #[inline(always)]
    fn binary(file: &mut [Lanes], out: usize, a: usize, b: usize, f: impl Fn(f64, f64) -> f64) {
        for chunk in 0..LANES / CHUNK {
            let (a, b) = (file[a].0[chunk], file[b].0[chunk]);
            file[out].0[chunk] = std::array::from_fn(|l| f(a[l], b[l]));
        }
    }
    #[inline(always)]
    fn ternary(
        file: &mut [Lanes],
        out: usize,
        (a, b, c): (usize, usize, usize),
        f: impl Fn(f64, f64, f64) -> f64,
    ) {
        for chunk in 0..LANES / CHUNK {
            let (a, b, c) = (file[a].0[chunk], file[b].0[chunk], file[c].0[chunk]);
            file[out].0[chunk] = std::array::from_fn(|l| f(a[l], b[l], c[l]));
        }
    }
    #[inline(always)]
    fn guarded(
        file: &mut [Lanes],
        out: usize,
        a: usize,
        f: impl Fn(f64) -> (f64, bool),
        slow: impl Fn(f64) -> f64,
    ) {
        for chunk in 0..LANES / CHUNK {
            let a = file[a].0[chunk];
            let values: [(f64, bool); CHUNK] = std::array::from_fn(|l| f(a[l]));
            file[out].0[chunk] = std::array::from_fn(|l| values[l].0);
            if values.iter().all(|value| value.1) {
                continue;
            }
            for l in (0..CHUNK).filter(|&l| !values[l].1) {
                file[out].0[chunk][l] = slow(a[l]);
            }
        }
    }
    #[inline(always)]
    fn pair(
        file: &mut [Lanes],
        out: (usize, usize),
        a: usize,
        f: impl Fn(f64) -> (f64, f64, bool),
        slow: impl Fn(f64) -> (f64, f64),
    ) {
        for chunk in 0..LANES / CHUNK {
            let a = file[a].0[chunk];
            let mut first = [0.0; CHUNK];
            let mut second = [0.0; CHUNK];
            let mut is_good = true;
            for l in 0..CHUNK {
                let good;
                (first[l], second[l], good) = f(a[l]);
                is_good &= good;
            }
            if !is_good {
                for l in 0..CHUNK {
                    if !f(a[l]).2 {
                        (first[l], second[l]) = slow(a[l]);
                    }
                }
            }
            file[out.0].0[chunk] = first;
            file[out.1].0[chunk] = second;
        }
    }
    #[inline(always)]
    fn update(&mut self, a: &Lanes, b: &Lanes, f: impl Fn(f64, f64, f64) -> f64) {
        for chunk in 0..LANES / CHUNK {
            let (a, b) = (&a.0[chunk], &b.0[chunk]);
            let old = self.0[chunk];
            self.0[chunk] = std::array::from_fn(|l| f(old[l], a[l], b[l]));
        }
    }
}
