//! Equilibria and steady motions as solutions of `f(z, p) = 0`.

use crate::branch::{Equations, Kind, Linearized, FAMILY};
use crate::error::OrbitError;
use crate::flow::Flow;
use crate::hopf::first_lyapunov;
use crate::multipliers::{eigenvalues, errors, Spectrum};
use crate::solution::solution;
use crate::subspace::{complement, nullity, nullity_below};
use chetaev_motion::functions::Functions;
use chetaev_stability::eigenvalues::{balanced, beside_zeros, Balanced};
use chetaev_symbolic::Symbol;
use nalgebra::{Complex, DMatrix, DVector};

/// The equations of steady motions.
#[derive(Debug)]
pub struct Equilibria<'f> {
    flow: &'f Flow,
    /// The place of the parameter that is varied.
    place: Option<usize>,
    functions: Functions,
    values: Vec<f64>,
    /// The dimension of the family of solutions that was asked of last.
    family: usize,
    /// How many eigenvalues are zero along the whole curve that is followed.
    zeros: usize,
}

/// Pairs whose sum is a smaller part of the largest eigenvalue vanish by structure, as in systems with an energy.
const STRUCTURAL: f64 = 1e-9;

impl<'f> Equilibria<'f> {
    /// The steady motions of a flow, a parameter being varied.
    ///
    /// # Errors
    /// [`OrbitError::NotAutonomous`], [`OrbitError::NoValue`] for what is no parameter, [`OrbitError::Functions`].
    pub fn new(flow: &'f Flow, parameter: Option<Symbol>) -> Result<Equilibria<'f>, OrbitError> {
        if !flow.is_autonomous() {
            return Err(OrbitError::NotAutonomous);
        }
        let g = &flow.graph;
        let place = parameter.map(|s| {
            flow.place(s).ok_or_else(|| OrbitError::NoValue {
                name: g.symbol_text(s),
            })
        });
        let place = place.transpose()?;
        let by: Vec<Symbol> = parameter.into_iter().collect();
        let all = [flow.rates.clone(), flow.finite.clone()].concat();
        let groups = [
            ("values", all.clone()),
            ("slopes", g.jacobian(&all, &flow.variables).concat()),
            ("by parameter", g.jacobian(&all, &by).concat()),
        ];
        Ok(Equilibria {
            functions: flow.functions(&groups)?,
            values: flow.parameters.iter().map(|own| own.1).collect(),
            flow,
            place,
            family: 0,
            zeros: 0,
        })
    }

    fn set(&mut self, x: &[f64], p: f64) -> Result<(), OrbitError> {
        let place = self
            .place
            .filter(|&at| self.values[at].to_bits() != p.to_bits());
        if let Some(place) = place {
            self.values[place] = p;
            self.functions.set_parameters(&self.values)?;
        }
        Ok(self.functions.evaluate(0.0, &[x])?)
    }

    /// ∂f/∂z.
    fn slopes(&self) -> DMatrix<f64> {
        let n = self.flow.n();
        DMatrix::from_row_slice(n, n, &self.functions.group(1)[..n * n])
    }

    /// ∂f/∂z on what the finite constraints leave, in suitable units of the variables: subspaces are found to rounding of the largest entry.
    fn on_constraints(&self) -> DMatrix<f64> {
        let n = self.flow.n();
        let Balanced {
            matrix,
            unit,
            scale,
        } = balanced(&self.slopes());
        let slopes = matrix * unit;
        let rows = &self.functions.group(1)[n * n..];
        let gradients = DMatrix::from_fn(n, rows.len() / n.max(1), |variable, constraint| {
            rows[constraint * n + variable] * scale[variable]
        });
        if gradients.is_empty() {
            return slopes;
        }
        let kept = complement(n, &gradients);
        kept.tr_mul(&(slopes * &kept))
    }

    /// How many eigenvalues are zero at a solution, as ranks say: a zero of a chain is none to rounding.
    fn zeros(&mut self, x: &[f64], p: f64) -> Result<usize, OrbitError> {
        self.set(x, p)?;
        let mut matrix = self.on_constraints();
        let least = ZERO * matrix.norm();
        let mut found = 0;
        while nullity_below(&matrix, least) > 0 {
            matrix = beside_zeros(&matrix, 1).ok_or(OrbitError::NoEigenvalues)?;
            found += 1;
        }
        Ok(found)
    }
}

/// Singular values below this part of the matrix are those of a zero eigenvalue.
const ZERO: f64 = 1e-12;

impl Equations for Equilibria<'_> {
    fn what(&self) -> &'static str {
        "steady motion"
    }

    fn evaluate(&mut self, x: &[f64], p: f64) -> Result<Linearized, OrbitError> {
        self.set(x, p)?;
        let rows = self.functions.group(0).len();
        Ok(Linearized {
            residual: DVector::from_column_slice(self.functions.group(0)),
            by_unknowns: DMatrix::from_row_slice(rows, self.flow.n(), self.functions.group(1)),
            by_parameter: match self.place {
                Some(_) => DVector::from_column_slice(self.functions.group(2)),
                None => DVector::zeros(rows),
            },
        })
    }

    /// Judged in suitable units of the variables, whose rates have the same; finite constraints in units of their own.
    fn family(&self, by_unknowns: &DMatrix<f64>, _: &[f64]) -> usize {
        let n = self.flow.n();
        let Balanced { scale, unit, .. } = balanced(&by_unknowns.rows(0, n).into());
        let mut own = by_unknowns.clone();
        for (mut column, d) in own.column_iter_mut().zip(&scale) {
            column *= *d;
        }
        for (at, mut row) in own.row_iter_mut().enumerate() {
            let size = scale.get(at).map_or_else(|| row.norm(), |d| d * unit);
            row /= size.max(f64::MIN_POSITIVE);
        }
        nullity(&own, FAMILY)
    }

    /// What is zero at solutions on both sides of the start is zero along the curve: at the start itself more may be.
    fn begin(&mut self, x: &[f64], p: f64, aside: &[f64]) -> Result<(), OrbitError> {
        let mut found = self.zeros(x, p)?;
        for &q in aside {
            if let Ok((beside, _)) = solution(self, x, q) {
                found = found.min(self.zeros(&beside.unknowns, q)?);
            }
        }
        self.zeros = found;
        Ok(())
    }

    /// Where finite constraints leave nothing, and beside the zeros of the family and those that are so along the whole curve.
    fn spectrum(&mut self, x: &[f64], p: f64, family: usize) -> Result<Spectrum, OrbitError> {
        self.set(x, p)?;
        self.family = family;
        let zeros = self.zeros.max(family);
        let kept = beside_zeros(&self.on_constraints(), zeros).ok_or(OrbitError::NoEigenvalues)?;
        let trivial = [
            ("a finite constraint", self.flow.finite.len()),
            ("the family of steady motions", family),
        ];
        let names = trivial.into_iter();
        let names = names.flat_map(|(name, count)| std::iter::repeat_n(name.to_owned(), count));
        let values = eigenvalues(&kept)?;
        Ok(Spectrum {
            errors: errors(&kept, &values),
            values,
            trivial: names.collect(),
            zeros: zeros - family,
        })
    }

    fn beyond(&self, value: Complex<f64>, size: f64) -> Option<f64> {
        Some(value.re / size)
    }

    fn tests(&self, values: &[Complex<f64>], unit: f64) -> Vec<f64> {
        let part = |l: Complex<f64>, size: f64| l / size.max(unit);
        let zero: Complex<f64> = values.iter().map(|l| part(*l, l.norm())).product();
        let pairs: Complex<f64> = pairs(values)
            .map(|(a, b)| part(a + b, a.norm() + b.norm()))
            .product();
        vec![zero.re, pairs.re]
    }

    fn vanish(&self, values: &[Complex<f64>]) -> Vec<bool> {
        let size = values.iter().map(|l| l.norm()).fold(0.0, f64::max);
        let mut pairs = pairs(values);
        vec![
            false,
            pairs.any(|(a, b)| (a + b).norm() <= STRUCTURAL * size),
        ]
    }

    fn kind(
        &mut self,
        test: usize,
        (x, p): (&[f64], f64),
        spectrum: &Spectrum,
        turns: bool,
    ) -> Result<Option<Kind>, OrbitError> {
        if test == 0 {
            return Ok(Some(if turns { Kind::Fold } else { Kind::BranchPoint }));
        }
        let size = spectrum.values.iter().map(|l| l.norm()).fold(0.0, f64::max);
        // Real eigenvalues that are opposite pass no axis.
        let is_pair = |l: &&Complex<f64>| l.im > 1e-9 * size && l.re.abs() < 1e-6 * size;
        let pair = spectrum.values.iter().filter(is_pair);
        let Some(pair) = pair.min_by(|a, b| a.re.abs().total_cmp(&b.re.abs())) else {
            return Ok(None);
        };
        self.set(x, p)?;
        let about = (&self.slopes(), self.family);
        let found = first_lyapunov(self.flow, (x, &self.values), about);
        Ok(Some(Kind::Hopf {
            frequency: pair.im,
            first_lyapunov: found.map(|own| own.coefficient),
        }))
    }
}

/// All pairs of eigenvalues.
fn pairs(values: &[Complex<f64>]) -> impl Iterator<Item = (Complex<f64>, Complex<f64>)> + '_ {
    let beside = |i: usize| values[i + 1..].iter().copied();
    let all = values.iter().enumerate();
    all.flat_map(move |(i, a)| beside(i).map(move |b| (*a, b)))
}
