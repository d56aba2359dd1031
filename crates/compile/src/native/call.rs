//! Functions of this crate that native code calls: what is rare, or too large to be written out.
//!
//! They work on cells of the frame, lane by lane, so that a state has the same result alone and in a block.
#![allow(unsafe_code)] // Cells come as a pointer from native code.

use super::assembler::Width;
use super::code::SCRATCH_CELL;
use super::dense;
use crate::kernel::sin_cos_library;
use crate::program::Factorization;
use chetaev_symbolic::evaluate::apply;
use chetaev_symbolic::Function;

/// A function that native code may call.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Helper {
    /// Where the mask of a guard is set: sine and cosine.
    SinCos,
    /// Where the mask of a guard is set: the logarithm.
    Log,
    /// A function of one argument.
    Function(Function),
    /// The power of two arguments.
    Pow,
    /// The angle of the point (second, first) argument.
    Atan2,
    /// Factorizes the matrix in the cells, in place.
    Factor {
        size: u16,
        factorization: Factorization,
    },
    /// Solves for the right-hand side in the cells, in place.
    Solve {
        size: u16,
        /// Bytes from the cells to those of the factorized matrix.
        distance: i32,
    },
}

/// Cells of the frame, what `detail` says, and the states that have no result, as bits.
type Called = unsafe extern "sysv64" fn(*mut f64, u64) -> u64;

impl Helper {
    /// Where the function is.
    pub(crate) fn address(self) -> u64 {
        let called: Called = match self {
            Helper::SinCos => sin_cos,
            Helper::Log => log,
            Helper::Function(_) => function,
            Helper::Pow => pow,
            Helper::Atan2 => atan2,
            Helper::Factor { .. } => factor,
            Helper::Solve { .. } => solve,
        };
        called as usize as u64
    }

    /// What the function needs to know, as its second argument: the number of lanes in the low byte.
    pub(crate) fn detail(self, width: Width) -> u64 {
        let lanes = width.lanes() as u64;
        match self {
            Helper::SinCos | Helper::Log | Helper::Pow | Helper::Atan2 => lanes,
            Helper::Function(function) => lanes | (function as u64) << 8,
            Helper::Factor {
                size,
                factorization,
            } => lanes | (factorization as u64) << 8 | u64::from(size) << 16,
            Helper::Solve { size, distance } => {
                lanes | u64::from(size) << 16 | u64::from(distance as u32) << 32
            }
        }
    }
}

/// `x ← x + a · b`, rounded once, as one instruction: left to itself the compiler shuffles lanes around.
#[inline]
#[target_feature(enable = "avx2,fma")]
pub(crate) fn add_product(x: &mut [f64; 4], a: &[f64; 4], b: &[f64; 4]) {
    use std::arch::x86_64::{_mm256_fmadd_pd, _mm256_loadu_pd, _mm256_storeu_pd};
    // SAFETY: each pointer is to four numbers, and no alignment is asked for.
    unsafe {
        let (a, b) = (_mm256_loadu_pd(a.as_ptr()), _mm256_loadu_pd(b.as_ptr()));
        let sum = _mm256_fmadd_pd(a, b, _mm256_loadu_pd(x.as_ptr()));
        _mm256_storeu_pd(x.as_mut_ptr(), sum);
    }
}

fn lanes(detail: u64) -> usize {
    (detail & 0xFF) as usize
}

/// Calls `replace` with an argument and its two results wherever the mask of a guard is set.
///
/// # Safety
/// `cells` are the four scratch cells of a frame, and nothing else refers to them.
unsafe fn repair(cells: *mut f64, detail: u64, replace: impl Fn(f64, &mut f64, &mut f64)) -> u64 {
    const CELL: usize = SCRATCH_CELL as usize / 8;
    // SAFETY: the caller hands over the four scratch cells.
    let cells = unsafe { std::slice::from_raw_parts_mut(cells, 4 * CELL) };
    let (arguments, rest) = cells.split_at_mut(CELL);
    let (first, rest) = rest.split_at_mut(CELL);
    let (second, masks) = rest.split_at_mut(CELL);
    for l in 0..lanes(detail) {
        if masks[l].is_sign_negative() {
            replace(arguments[l], &mut first[l], &mut second[l]);
        }
    }
    0
}

/// # Safety
/// As [`repair`].
unsafe extern "sysv64" fn sin_cos(cells: *mut f64, detail: u64) -> u64 {
    // SAFETY: the same condition.
    unsafe {
        repair(cells, detail, |x, sin, cos| {
            (*sin, *cos) = sin_cos_library(x)
        })
    }
}

/// # Safety
/// As [`repair`].
unsafe extern "sysv64" fn log(cells: *mut f64, detail: u64) -> u64 {
    // SAFETY: the same condition.
    unsafe { repair(cells, detail, |x, log, _| *log = libm::log(x)) }
}

/// # Safety
/// `cells` is a cell of a frame, and nothing else refers to it.
unsafe extern "sysv64" fn function(cells: *mut f64, detail: u64) -> u64 {
    // SAFETY: a cell has as many numbers as there are lanes.
    let cells = unsafe { std::slice::from_raw_parts_mut(cells, lanes(detail)) };
    if let Some(&function) = Function::ALL.get((detail >> 8) as usize) {
        cells.iter_mut().for_each(|x| *x = apply(function, *x));
    }
    0
}

/// # Safety
/// `cells` are two cells of a frame, and nothing else refers to them.
unsafe fn of_two(cells: *mut f64, detail: u64, f: impl Fn(f64, f64) -> f64) -> u64 {
    let lanes = lanes(detail);
    // SAFETY: a cell has as many numbers as there are lanes.
    let cells = unsafe { std::slice::from_raw_parts_mut(cells, 2 * lanes) };
    let (first, second) = cells.split_at_mut(lanes);
    for (a, b) in first.iter_mut().zip(second) {
        *a = f(*a, *b);
    }
    0
}

/// # Safety
/// As [`of_two`].
unsafe extern "sysv64" fn pow(cells: *mut f64, detail: u64) -> u64 {
    // SAFETY: the same condition.
    unsafe { of_two(cells, detail, libm::pow) }
}

/// # Safety
/// As [`of_two`].
unsafe extern "sysv64" fn atan2(cells: *mut f64, detail: u64) -> u64 {
    // SAFETY: the same condition.
    unsafe { of_two(cells, detail, libm::atan2) }
}

/// # Safety
/// `cells` are those of a matrix ([`dense::cells`]), nothing else refers to them, and the processor has AVX2 and FMA.
unsafe extern "sysv64" fn factor(cells: *mut f64, detail: u64) -> u64 {
    let (lanes, size) = (lanes(detail), (detail >> 16 & 0xFFFF) as usize);
    let is_definite = detail >> 8 & 0xFF == Factorization::Ldlt as u64;
    // SAFETY: the caller hands over the cells of a matrix of this size.
    let cells = unsafe { std::slice::from_raw_parts_mut(cells, dense::cells(size) * lanes) };
    // SAFETY: native code runs only on processors with these features.
    unsafe {
        match lanes {
            1 => dense::factor::<1>(size, is_definite, cells),
            8 => dense::factor::<8>(size, is_definite, cells),
            _ => dense::factor::<4>(size, is_definite, cells),
        }
    }
}

/// # Safety
/// `cells` are as many as the system has unknowns, those of its matrix are where `detail` says and do not overlap,
/// nothing else refers to either, and the processor has AVX2 and FMA.
unsafe extern "sysv64" fn solve(cells: *mut f64, detail: u64) -> u64 {
    let (lanes, size) = (lanes(detail), (detail >> 16 & 0xFFFF) as usize);
    let distance = (detail >> 32) as u32 as i32;
    // SAFETY: the matrix is in the same frame, at this distance.
    let matrix = unsafe { cells.byte_offset(distance as isize) };
    // SAFETY: its cells do not overlap those of the right-hand side.
    let matrix = unsafe { std::slice::from_raw_parts(matrix, dense::cells(size) * lanes) };
    // SAFETY: the caller hands over the cells of the right-hand side.
    let x = unsafe { std::slice::from_raw_parts_mut(cells, size * lanes) };
    // SAFETY: native code runs only on processors with these features.
    unsafe {
        match lanes {
            1 => dense::solve::<1>(size, matrix, x),
            8 => dense::solve::<8>(size, matrix, x),
            _ => dense::solve::<4>(size, matrix, x),
        }
    }
    0
}
