//! The few functions that generated code calls and neither language has.

use super::language::Language;

/// Which helpers are called.
#[derive(Default)]
pub(super) struct Helpers {
    pub(super) pi: bool,
    pub(super) sign: bool,
    pub(super) power: bool,
    pub(super) solve: bool,
}

impl Helpers {
    /// What stands before the functions.
    pub(super) fn text(&self, language: Language) -> String {
        let wanted: &[(bool, &str)] = match language {
            Language::C => &[
                (true, "#include <math.h>\n"),
                (self.pi, C_PI),
                (self.sign, C_SIGN),
                (self.power, C_POWER),
                (self.solve, C_SOLVE),
            ],
            Language::Rust => &[
                (self.pi, "use std::f64::consts::PI;\n"),
                (true, RUST_SINGULAR),
                (self.sign, RUST_SIGN),
                (self.solve, RUST_SOLVE),
            ],
        };
        let mut out = String::new();
        for (_, text) in wanted.iter().filter(|(is_called, _)| *is_called) {
            out.push('\n');
            out.push_str(text);
        }
        out
    }
}

const C_PI: &str = "\
static const double PI = 3.141592653589793;
";

const C_SIGN: &str = "\
/* 1 for positive x, -1 for negative x, else 0. */
static double chetaev_sign(double x)
{
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}
";

const C_POWER: &str = "\
/* The power of x with a whole exponent n >= 0. */
static double chetaev_power(double x, int n)
{
    double power = 1.0;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) {
            power *= x;
        }
        x *= x;
    }
    return power;
}
";

const C_SOLVE: &str = "\
/*
 * Solves a system of n linear equations by Gaussian elimination with partial pivoting.
 * matrix: n*n entries, row by row; work: room for as many; b: the right side, which becomes the solution.
 * Returns 0, or 1 if the matrix is singular.
 */
static int chetaev_solve(int n, const double *matrix, double *work, double *b)
{
    for (int i = 0; i < n*n; i++) {
        work[i] = matrix[i];
    }
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++) {
            if (fabs(work[i*n + k]) > fabs(work[pivot*n + k])) {
                pivot = i;
            }
        }
        if (work[pivot*n + k] == 0.0) {
            return 1;
        }
        if (pivot != k) {
            for (int j = k; j < n; j++) {
                const double entry = work[k*n + j];
                work[k*n + j] = work[pivot*n + j];
                work[pivot*n + j] = entry;
            }
            const double right = b[k];
            b[k] = b[pivot];
            b[pivot] = right;
        }
        for (int i = k + 1; i < n; i++) {
            const double factor = work[i*n + k]/work[k*n + k];
            for (int j = k + 1; j < n; j++) {
                work[i*n + j] -= factor*work[k*n + j];
            }
            b[i] -= factor*b[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++) {
            b[k] -= work[k*n + j]*b[j];
        }
        b[k] /= work[k*n + k];
    }
    return 0;
}
";

const RUST_SINGULAR: &str = "\
/// A system of linear equations has a singular matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular;
";

const RUST_SIGN: &str = "\
/// 1 for positive x, -1 for negative x, else 0.
fn chetaev_sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        0.0
    }
}
";

const RUST_SOLVE: &str = "\
/// Solves a system of n linear equations by Gaussian elimination with partial pivoting.
/// matrix: n*n entries, row by row; work: room for as many; b: the right side, which becomes the solution.
fn chetaev_solve(matrix: &[f64], work: &mut [f64], b: &mut [f64]) -> Result<(), Singular> {
    let n = b.len();
    work.copy_from_slice(matrix);
    for k in 0..n {
        let mut pivot = k;
        for i in k + 1..n {
            if work[i*n + k].abs() > work[pivot*n + k].abs() {
                pivot = i;
            }
        }
        if work[pivot*n + k] == 0.0 {
            return Err(Singular);
        }
        if pivot != k {
            for j in k..n {
                work.swap(k*n + j, pivot*n + j);
            }
            b.swap(k, pivot);
        }
        for i in k + 1..n {
            let factor = work[i*n + k]/work[k*n + k];
            for j in k + 1..n {
                work[i*n + j] -= factor*work[k*n + j];
            }
            b[i] -= factor*b[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            b[k] -= work[k*n + j]*b[j];
        }
        b[k] /= work[k*n + k];
    }
    Ok(())
}
";
