//! The first Lyapunov coefficient of a pair of eigenvalues on the imaginary axis (Kuznetsov 2004, § 5.4, (5.62)).
//!
//! `l₁ = Re c₁/ω`, `c₁ = ½ ⟨p, C(q, q, q̄) − 2 B(q, A⁻¹ B(q, q̄)) + B(q̄, (2iω − A)⁻¹ B(q, q))⟩` with `A q = iω q`, `Aᵀ p = −iω p`,
//! `⟨q, q⟩ = 1`, `⟨p, q⟩ = 1`; B and C are the second and third derivatives of f. They are taken along straight lines only, and polarized
//! (Kuznetsov 2004, § 10.2): the exact derivatives of f along a line stay small where those by all variables do not.

use crate::flow::Flow;
use crate::multipliers::eigenvalues;
use crate::subspace::decomposed;
use chetaev_symbolic::{Expr, Symbol};
use nalgebra::{Complex, DMatrix, DVector};

/// What decides whether the orbits that are born are stable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstLyapunov {
    /// ω.
    pub frequency: f64,
    /// l₁: negative, and stable orbits are born where the motion loses its stability; positive, and unstable ones vanish there.
    pub coefficient: f64,
}

type ComplexVector = DVector<Complex<f64>>;

/// f's derivatives along lines through a point.
struct Lines<'f> {
    flow: &'f Flow,
    directions: Vec<Symbol>,
    second: Vec<Expr>,
    third: Vec<Expr>,
    at: (&'f [f64], &'f [f64]),
}

impl<'f> Lines<'f> {
    fn new(flow: &'f Flow, at: (&'f [f64], &'f [f64])) -> Lines<'f> {
        let g = &flow.graph;
        // No name of a model contains a space.
        let symbol = |i: usize| g.intern_symbol(&format!("along line {i}"), 0);
        let directions: Vec<Symbol> = (0..flow.n()).map(symbol).collect();
        let moved = |s: Symbol| {
            let place = flow.variables.iter().position(|own| *own == s)?;
            Some(g.symbol_expr(directions[place]))
        };
        let first = g.derive(&flow.rates, &moved);
        let second = g.derive(&first, &moved);
        let third = g.derive(&second, &moved);
        Lines {
            flow,
            directions,
            second,
            third,
            at,
        }
    }

    fn value(&self, es: &[Expr], direction: &DVector<f64>) -> Option<DVector<f64>> {
        let place = |all: &[Symbol], s| all.iter().position(|own| *own == s);
        let value = |s: Symbol| {
            let variable = place(&self.flow.variables, s).map(|i| self.at.0[i]);
            let along = || place(&self.directions, s).map(|i| direction[i]);
            let parameter = || self.flow.place(s).map(|i| self.at.1[i]);
            variable.or_else(along).or_else(parameter)
        };
        let found = self.flow.graph.evaluate_f64(es, &value).ok()?;
        Some(DVector::from_vec(found))
    }

    /// B(a, b) by `4 B(a, b) = B(a + b, a + b) − B(a − b, a − b)`.
    fn twice(&self, a: &DVector<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
        let (sum, difference) = (a + b, a - b);
        Some((self.value(&self.second, &sum)? - self.value(&self.second, &difference)?) / 4.0)
    }

    /// C(a, a, b) by `6 C(a, a, b) = C(a + b)³ − C(a − b)³ − 2 C(b)³`.
    fn thrice(&self, a: &DVector<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
        let (sum, difference) = (a + b, a - b);
        let own = self.value(&self.third, b)?;
        let both = self.value(&self.third, &sum)? - self.value(&self.third, &difference)?;
        Some((both - own * 2.0) / 6.0)
    }

    /// B of complex vectors.
    fn complex(&self, u: &ComplexVector, w: &ComplexVector) -> Option<ComplexVector> {
        let (a, b) = (u.map(|z| z.re), u.map(|z| z.im));
        let (c, d) = (w.map(|z| z.re), w.map(|z| z.im));
        let real = self.twice(&a, &c)? - self.twice(&b, &d)?;
        let imaginary = self.twice(&a, &d)? + self.twice(&b, &c)?;
        Some(real.zip_map(&imaginary, Complex::new))
    }
}

/// The first Lyapunov coefficient of the pair nearest to the axis at a steady motion; `slopes` is ∂f/∂z there. `None` where there is no pair, or
/// the matrix has the eigenvalue zero.
pub fn first_lyapunov(
    flow: &Flow,
    at: (&[f64], &[f64]),
    slopes: &DMatrix<f64>,
) -> Option<FirstLyapunov> {
    let all = eigenvalues(slopes).ok()?;
    let pairs = all.iter().filter(|l| l.im > 0.0);
    let omega = pairs.min_by(|a, b| a.re.abs().total_cmp(&b.re.abs()))?.im;
    let complex = slopes.map(|x| Complex::new(x, 0.0));
    let n = slopes.nrows();
    let minus = |factor: f64, m: &DMatrix<Complex<f64>>| {
        m - DMatrix::identity(n, n) * Complex::new(0.0, factor * omega)
    };
    let q = null_vector(&minus(1.0, &complex))?;
    let p = null_vector(&minus(-1.0, &complex.transpose()))?;
    // ⟨p, q⟩ = Σ p̄ q.
    let product = p.dotc(&q);
    let p = p / product.conj();
    let lines = Lines::new(flow, at);
    let (a, b) = (q.map(|z| z.re), q.map(|z| z.im));
    let real = lines.value(&lines.third, &a)? + lines.thrice(&b, &a)?;
    let imaginary = lines.thrice(&a, &b)? + lines.value(&lines.third, &b)?;
    let cubic = real.zip_map(&imaginary, Complex::new);
    let conjugate = q.conjugate();
    let constant = complex
        .clone()
        .lu()
        .solve(&lines.complex(&q, &conjugate)?)?;
    let doubled = (-minus(2.0, &complex))
        .lu()
        .solve(&lines.complex(&q, &q)?)?;
    let sum = cubic - lines.complex(&q, &constant)? * Complex::new(2.0, 0.0)
        + lines.complex(&conjugate, &doubled)?;
    let coefficient = 0.5 * p.dotc(&sum).re / omega;
    let is_regular = decomposed(slopes)?.s.last()? > &(1e-10 * slopes.norm());
    (coefficient.is_finite() && is_regular).then_some(FirstLyapunov {
        frequency: omega,
        coefficient,
    })
}

/// The vector of unit length that a matrix shrinks most.
fn null_vector(m: &DMatrix<Complex<f64>>) -> Option<ComplexVector> {
    let found = m.clone().try_svd(false, true, f64::EPSILON, 10_000)?;
    let values = found.singular_values.iter().enumerate();
    let smallest = values.min_by(|a, b| a.1.total_cmp(b.1))?.0;
    let rows = found.v_t?;
    Some(rows.row(smallest).adjoint())
}
