//! Rational linear combinations: is one form in the ℚ-span of others?

use dashu_int::IBig;

use super::super::monomial::Monomial;
use super::super::rational_function::RationalFunction;
use super::super::sparse::Polynomial;
use super::field::Field;
use super::Stop;
use crate::rational::Rational;

/// A polynomial with rational coefficients, descending.
type Row = Vec<(Monomial, Rational)>;

impl Field<'_> {
    /// Rational coefficients r with `target = Σ r_i basis_i`, for a basis that is independent over ℚ.
    pub(super) fn combination(
        &self,
        target: &RationalFunction,
        basis: &[RationalFunction],
    ) -> Result<Option<Vec<Rational>>, Stop> {
        let mut common = target.denominator().clone();
        for b in basis {
            common = common.lcm(b.denominator(), &self.meter)?;
        }
        let over = |f: &RationalFunction| -> Result<Polynomial, Stop> {
            let cofactor = common.exact_quotient(f.denominator(), &self.meter)?;
            let cofactor = cofactor.unwrap_or_else(Polynomial::one);
            self.reduce(f.numerator().mul(&cofactor, &self.meter)?)
        };
        let mut rest: Row = rational_terms(&over(target)?);
        let mut rows: Vec<(Row, Vec<Rational>)> = Vec::new();
        for (i, b) in basis.iter().enumerate() {
            let mut combination = vec![Rational::ZERO; basis.len()];
            combination[i] = Rational::ONE;
            let mut row = rational_terms(&over(b)?);
            for (other, weights) in &rows {
                eliminate(&mut row, &mut combination, other, weights);
            }
            if !row.is_empty() {
                rows.push((row, combination));
            }
        }
        let mut solution = vec![Rational::ZERO; basis.len()];
        for (row, weights) in &rows {
            eliminate(&mut rest, &mut solution, row, weights);
        }
        // Elimination subtracted the combination from the target.
        Ok(rest
            .is_empty()
            .then(|| solution.into_iter().map(|r| -r).collect()))
    }
}

fn rational_terms(p: &Polynomial) -> Row {
    let term = |(m, c): &(Monomial, IBig)| (m.clone(), Rational::from(c.clone()));
    p.terms().iter().map(term).collect()
}

/// Subtracts the multiple of `other` that removes its leading monomial from `row`, and the same multiple of the weights.
fn eliminate(
    row: &mut Row,
    weights: &mut [Rational],
    other: &[(Monomial, Rational)],
    other_weights: &[Rational],
) {
    let Some((pivot, lead)) = other.first() else {
        return;
    };
    let Some((_, value)) = row.iter().find(|(m, _)| m == pivot) else {
        return;
    };
    let factor = value / lead;
    for (weight, other) in weights.iter_mut().zip(other_weights) {
        *weight -= &factor * other;
    }
    for (monomial, value) in other {
        let change = &factor * value;
        match row.iter_mut().find(|(m, _)| m == monomial) {
            Some((_, old)) => *old -= change,
            None => row.push((monomial.clone(), -change)),
        }
    }
    row.retain(|(_, value)| !value.is_zero());
    row.sort_by(|a, b| b.0.cmp(&a.0));
}
