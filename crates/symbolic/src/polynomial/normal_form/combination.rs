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
        let all: Vec<&RationalFunction> = std::iter::once(target).chain(basis).collect();
        let numerators = self.numerators(&all)?;
        let mut rest: Row = rational_terms(&numerators[0]);
        let mut rows: Vec<(Row, Vec<Rational>)> = Vec::new();
        for (i, numerator) in numerators[1..].iter().enumerate() {
            let mut combination = vec![Rational::ZERO; basis.len()];
            combination[i] = Rational::ONE;
            let mut row = rational_terms(numerator);
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

    /// The numerators over the least common denominator, modulo the relations between the generators: without that sin² and 1 − cos²
    /// would be two vectors for one function.
    fn numerators(&self, values: &[&RationalFunction]) -> Result<Vec<Polynomial>, Stop> {
        let mut common = Polynomial::one();
        for value in values {
            common = common.lcm(value.denominator(), &self.meter)?;
        }
        let over = |value: &&RationalFunction| -> Result<Polynomial, Stop> {
            let cofactor = common.exact_quotient(value.denominator(), &self.meter)?;
            let cofactor = cofactor.unwrap_or_else(Polynomial::one);
            self.reduce(value.numerator().mul(&cofactor, &self.meter)?)
        };
        values.iter().map(over).collect()
    }

    /// The numerators of forms over their least common denominator, in normal form; `None` where they are too large.
    pub fn over_common_denominator(&self, values: &[RationalFunction]) -> Option<Vec<Polynomial>> {
        let values: Vec<&RationalFunction> = values.iter().collect();
        self.numerators(&values).ok()
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
