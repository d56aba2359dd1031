//! Names that both languages accept, so that the same model gives the same names in each.

use crate::graph::Graph;
use crate::node::Symbol;
use crate::syntax::names::normalized;
use rustc_hash::FxHashSet;

/// Words that C99, C++ or Rust reserve, and what a local variable would hide or be replaced by.
const RESERVED: [&str; 6] = [
    // C99 (ISO/IEC 9899:1999, 6.4.1).
    "auto break case char const continue default do double else enum extern float for goto if inline int \
     long register restrict return short signed sizeof static struct switch typedef union unsigned void \
     volatile while",
    // Later C and C++.
    "alignas alignof and and_eq asm bitand bitor bool catch class compl concept const_cast consteval \
     constexpr constinit co_await co_return co_yield decltype delete dynamic_cast explicit export false \
     friend mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
     reinterpret_cast requires static_assert static_cast template this thread_local throw true try typeid \
     typename typeof using virtual wchar_t xor xor_eq",
    // Rust (The Rust Reference, Keywords).
    "Self abstract as async await become box crate dyn final fn gen impl in let loop macro macro_rules \
     match mod move mut override priv pub ref self super trait type unsafe unsized use where yield",
    // What the written code calls.
    "Err None Ok PI Result Singular Some chetaev_power chetaev_sign chetaev_solve f64 std usize acos \
     acosh asin asinh atan atan2 atanh cos cosh exp fabs log pow sin sinh sqrt tan tanh",
    // Other functions of <math.h>.
    "cbrt ceil copysign erf erfc exp2 expm1 fdim floor fma fmax fmin fmod frexp hypot ilogb ldexp lgamma \
     llrint llround log10 log1p log2 logb lrint lround modf nan nearbyint nextafter nexttoward remainder \
     remquo rint round scalbln scalbn tgamma trunc",
    // Macros of usual compilers and of <math.h>.
    "HUGE_VAL HUGE_VALF HUGE_VALL INFINITY NAN FP_INFINITE FP_NAN FP_NORMAL FP_SUBNORMAL FP_ZERO \
     FP_ILOGB0 FP_ILOGBNAN FP_FAST_FMA FP_FAST_FMAF FP_FAST_FMAL MATH_ERRNO MATH_ERREXCEPT \
     math_errhandling MAXFLOAT M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI \
     M_2_SQRTPI M_SQRT2 M_SQRT1_2 DOMAIN SING OVERFLOW UNDERFLOW PLOSS TLOSS linux unix i386 main",
];

/// The names in use in one scope.
pub(super) struct Names {
    taken: FxHashSet<String>,
}

impl Names {
    /// A scope in which nothing is in use but the reserved words.
    pub(super) fn reserved() -> Names {
        Names {
            taken: RESERVED
                .iter()
                .flat_map(|words| words.split_whitespace())
                .map(str::to_string)
                .collect(),
        }
    }

    /// An identifier like `name` that is not in use yet; it then is.
    pub(super) fn free(&mut self, name: &str) -> String {
        let name = identifier(name);
        if self.taken.insert(name.clone()) {
            return name;
        }
        if self.taken.insert(format!("{name}_")) {
            return format!("{name}_");
        }
        self.numbered(&format!("{name}_"), &mut 1)
    }

    /// `stem` with the first number after `count` that is not in use; `count` becomes this number.
    pub(super) fn numbered(&mut self, stem: &str, count: &mut usize) -> String {
        loop {
            *count += 1;
            let name = format!("{stem}{count}");
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// The name of a symbol as it is wished: `x_d` for `x'`, `x_dd` for `x''`, `x_d3` for `x'''`.
pub(super) fn wished(g: &Graph, symbol: Symbol) -> String {
    let name = g.symbol_name(symbol);
    match g.symbol_order(symbol) {
        0 => name.to_string(),
        1 => format!("{name}_d"),
        2 => format!("{name}_dd"),
        order => format!("{name}_d{order}"),
    }
}

/// Letters, digits and underscores, with a letter first: a leading underscore may be reserved in C.
fn identifier(name: &str) -> String {
    let mut out: String = normalized(name)
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    if !out.starts_with(|c: char| c.is_ascii_alphabetic()) {
        out.insert(0, 'v');
    }
    out
}
