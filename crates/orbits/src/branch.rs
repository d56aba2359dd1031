//! What is followed in a parameter, and what is found: equations, points, what happens at some, the curve. [`continuation`](crate::continuation) follows it.

use crate::error::OrbitError;
use crate::hopf::WithoutLyapunov;
use crate::multipliers::Spectrum;
use crate::subspace::nullity;
use crate::units::Units;
use nalgebra::{Complex, DMatrix, DVector};

/// `F` with its derivatives at (x, p).
#[derive(Clone, Debug)]
pub struct Linearized {
    /// F.
    pub residual: DVector<f64>,
    /// ∂F/∂x.
    pub by_unknowns: DMatrix<f64>,
    /// ∂F/∂p.
    pub by_parameter: DVector<f64>,
}

/// What is followed.
pub trait Equations {
    /// What a solution is called.
    fn what(&self) -> &'static str;

    /// `F` at (x, p).
    ///
    /// # Errors
    /// [`OrbitError`] where it has no value.
    fn evaluate(&mut self, x: &[f64], p: f64) -> Result<Linearized, OrbitError>;

    /// Told where a curve begins, with values of the parameter beside it, before eigenvalues along it are asked for.
    ///
    /// # Errors
    /// [`OrbitError`] where there is no value.
    fn begin(&mut self, x: &[f64], p: f64, aside: &[f64]) -> Result<(), OrbitError> {
        let _ = (x, p, aside);
        Ok(())
    }

    /// The eigenvalues at a solution; `family` is the dimension of the family of solutions at the same p.
    ///
    /// # Errors
    /// [`OrbitError`].
    fn spectrum(&mut self, x: &[f64], p: f64, family: usize) -> Result<Spectrum, OrbitError>;

    /// How far right of the axis an eigenvalue is, in parts of the largest; `None` where it is a multiplier.
    fn beyond(&self, _value: Complex<f64>, _size: f64) -> Option<f64> {
        None
    }

    /// What changes its sign where the kind of motion may change, by zeros and by poles of eigenvalues; below `unit` their sizes count, above
    /// their directions alone, so that no product of them overflows.
    fn tests(&self, values: &[Complex<f64>], unit: f64) -> Vec<f64>;

    /// Which of the tests vanish to rounding: where they do beside what happens they vanish identically, by structure, as in systems with an energy.
    fn vanish(&self, values: &[Complex<f64>]) -> Vec<bool>;

    /// What the zero of test number `test` at a solution is, `None` where it is nothing; `turns` says whether the curve turns back there.
    ///
    /// # Errors
    /// [`OrbitError`].
    fn kind(
        &mut self,
        test: usize,
        at: (&[f64], f64),
        spectrum: &Spectrum,
        turns: bool,
    ) -> Result<Option<Kind>, OrbitError>;

    /// The dimension of the family of solutions at the same p, from ∂F/∂x at one of them.
    fn family(&self, by_unknowns: &DMatrix<f64>, scale: &[f64]) -> usize {
        nullity(&scaled(by_unknowns, scale), FAMILY)
    }

    /// Whether between two solutions next to each other the curve passes a solution from which on it runs back, as where an orbit shrinks to
    /// a steady motion and is followed half a period later.
    ///
    /// # Errors
    /// [`OrbitError`] where there is no value.
    fn runs_back(
        &mut self,
        before: (&[f64], f64),
        after: (&[f64], f64),
    ) -> Result<bool, OrbitError> {
        let _ = (before, after);
        Ok(false)
    }

    /// Told after each point that was accepted.
    fn accepted(&mut self, x: &[f64], p: f64) -> Result<(), OrbitError> {
        let _ = (x, p);
        Ok(())
    }
}

/// What happens at a point of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// The branch turns back.
    Fold,
    /// An eigenvalue passes through zero, or a multiplier through 1, and the branch goes on: another one may cross.
    BranchPoint,
    /// The branch turns back where another one crosses it, as at a pitchfork.
    Pitchfork,
    /// An eigenvalue goes to infinity, and comes back from its other side.
    Infinity,
    /// A pair of eigenvalues passes the imaginary axis.
    Hopf {
        /// ω.
        frequency: f64,
        /// The first Lyapunov coefficient, or why there is none.
        first_lyapunov: Result<f64, WithoutLyapunov>,
    },
    /// A multiplier passes −1.
    PeriodDoubling,
    /// A pair of multipliers passes the unit circle.
    Torus {
        /// Its angle.
        angle: f64,
    },
}

impl Kind {
    /// Whether both are one, found in two ways.
    pub(crate) fn is_like(self, other: Kind) -> bool {
        match (self, other) {
            (Kind::Hopf { frequency: a, .. }, Kind::Hopf { frequency: b, .. }) => {
                (a - b).abs() <= 1e-5 * a
            }
            _ => std::mem::discriminant(&self) == std::mem::discriminant(&other),
        }
    }
}

/// A point of a branch.
#[derive(Clone, Debug)]
pub struct Point {
    /// p.
    pub parameter: f64,
    /// x.
    pub unknowns: Vec<f64>,
    /// The eigenvalues.
    pub spectrum: Spectrum,
}

impl Point {
    /// The point as it is, where it was found in these units; the unknowns of an orbit have its period last.
    pub fn restored(mut self, units: &Units, is_orbit: bool) -> Point {
        let scales = units.scale.iter().copied().chain([units.rate.recip()]);
        let unknowns = self.unknowns.iter_mut().zip(scales);
        unknowns.for_each(|(x, s)| *x *= s);
        if !is_orbit {
            let spectrum = &mut self.spectrum;
            spectrum.values.iter_mut().for_each(|l| *l *= units.rate);
            spectrum.errors.iter_mut().for_each(|e| *e *= units.rate);
        }
        self
    }
}

/// A point at which something happens.
#[derive(Clone, Debug)]
pub struct Special {
    /// What.
    pub kind: Kind,
    /// Where.
    pub point: Point,
}

/// Solutions over a range of the parameter.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Along the curve, from the end below the start to the one above.
    pub points: Vec<Point>,
    /// Where something happens, along the curve.
    pub special: Vec<Special>,
    /// The dimension of the family of solutions at the same p.
    pub family: usize,
    /// Why the curve ends, at its first and at its last point.
    pub ends: [End; 2],
}

impl Branch {
    /// The curve as it is, where it was found in these units; the unknowns of an orbit have its period last.
    pub fn restored(self, units: &Units, is_orbit: bool) -> Branch {
        let point = |own: Point| own.restored(units, is_orbit);
        let special = self.special.into_iter().map(|mut own| {
            if let Kind::Hopf { frequency, .. } = &mut own.kind {
                *frequency *= units.rate;
            }
            own.point = point(own.point);
            own
        });
        Branch {
            special: special.collect(),
            points: self.points.into_iter().map(point).collect(),
            ..self
        }
    }
}

/// Why a curve ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At an end of the range.
    Range,
    /// After as many points as were asked for.
    Points,
    /// No next point was found.
    Lost,
    /// At the start again: the curve is closed.
    Closed,
    /// Where orbits shrink to a steady motion.
    Steady,
}

/// Singular values below this part of the largest belong to a family.
pub(crate) const FAMILY: f64 = 1e-7;

/// A matrix by unknowns in units of their scales.
pub(crate) fn scaled(matrix: &DMatrix<f64>, scale: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), scale.len(), |r, c| {
        matrix[(r, c)] * scale[c]
    })
}
