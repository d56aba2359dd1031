//! Differential forms by their components.

use super::field::Field;
use super::space::Space;
use chetaev_symbolic::{Expr, Graph};
use std::collections::BTreeMap;

/// `Σ ω_I dx^I` over ascending places I; components that are zero as written are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    degree: usize,
    terms: BTreeMap<Vec<usize>, Expr>,
}

/// Two ascending lists as one with the sign of the permutation; `None` where a place occurs twice.
fn merged(a: &[usize], b: &[usize]) -> Option<(Vec<usize>, bool)> {
    let mut all = a.to_vec();
    let mut odd = false;
    for &place in b {
        let after = all.iter().rev().take_while(|&&own| own > place).count();
        let at = all.len() - after;
        if at > 0 && all[at - 1] == place {
            return None;
        }
        all.insert(at, place);
        odd ^= after % 2 == 1;
    }
    Some((all, odd))
}

impl Form {
    /// A form by its components at ascending places.
    pub fn new(degree: usize, terms: BTreeMap<Vec<usize>, Expr>, g: &Graph) -> Form {
        let terms = terms.into_iter().filter(|(_, e)| !g.is_zero(*e)).collect();
        Form { degree, terms }
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The components that are not zero as written.
    pub fn terms(&self) -> &BTreeMap<Vec<usize>, Expr> {
        &self.terms
    }

    /// All components that are not zero as written: what must vanish where the form does.
    pub fn residuals(&self) -> Vec<Expr> {
        self.terms.values().copied().collect()
    }

    fn collected(degree: usize, parts: Vec<(Vec<usize>, Expr)>, g: &Graph) -> Form {
        let mut lists: BTreeMap<Vec<usize>, Vec<Expr>> = BTreeMap::new();
        for (places, e) in parts {
            lists.entry(places).or_default().push(e);
        }
        let terms = lists.into_iter().map(|(places, es)| (places, g.add(&es)));
        Form::new(degree, terms.collect(), g)
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, g: &Graph, other: &Form) -> Form {
        let own = self.terms.iter().chain(&other.terms);
        let parts = own.map(|(places, &e)| (places.clone(), e)).collect();
        Form::collected(self.degree, parts, g)
    }

    /// The form times a function.
    #[must_use]
    pub fn times(&self, g: &Graph, factor: Expr) -> Form {
        let own = self.terms.iter();
        let terms = own.map(|(places, &e)| (places.clone(), g.mul(&[factor, e])));
        Form::new(self.degree, terms.collect(), g)
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, g: &Graph, other: &Form) -> Form {
        self.plus(g, &other.times(g, g.integer(-1)))
    }

    /// ω ∧ τ.
    #[must_use]
    pub fn wedge(&self, g: &Graph, other: &Form) -> Form {
        let mut parts = Vec::new();
        for (a, &x) in &self.terms {
            for (b, &y) in &other.terms {
                if let Some((places, odd)) = merged(a, b) {
                    let product = g.mul(&[x, y]);
                    parts.push((places, if odd { g.neg(product) } else { product }));
                }
            }
        }
        Form::collected(self.degree + other.degree, parts, g)
    }

    /// dω.
    #[must_use]
    pub fn d(&self, space: &Space<'_>) -> Form {
        let g = space.graph();
        let coefficients: Vec<Expr> = self.terms.values().copied().collect();
        let partials = space.partials(&coefficients);
        let mut parts = Vec::new();
        for (places, row) in self.terms.keys().zip(partials) {
            for (place, slope) in row.into_iter().enumerate() {
                if g.is_zero(slope) {
                    continue;
                }
                if let Some((all, odd)) = merged(&[place], places) {
                    parts.push((all, if odd { g.neg(slope) } else { slope }));
                }
            }
        }
        Form::collected(self.degree + 1, parts, g)
    }

    /// X ⌟ ω.
    #[must_use]
    pub fn contracted(&self, g: &Graph, field: &Field) -> Form {
        let mut parts = Vec::new();
        for (places, &e) in &self.terms {
            for (number, &place) in places.iter().enumerate() {
                let component = field.components[place];
                if g.is_zero(component) {
                    continue;
                }
                let mut rest = places.clone();
                rest.remove(number);
                let product = g.mul(&[component, e]);
                let signed = if number % 2 == 1 {
                    g.neg(product)
                } else {
                    product
                };
                parts.push((rest, signed));
            }
        }
        Form::collected(self.degree.saturating_sub(1), parts, g)
    }

    /// ω(X_1, …, X_p); fields fewer or more than the degree give zero.
    pub fn on(&self, g: &Graph, fields: &[&Field]) -> Expr {
        if fields.len() != self.degree {
            return g.zero();
        }
        let rest = fields
            .iter()
            .fold(self.clone(), |form, field| form.contracted(g, field));
        rest.terms.get(&Vec::new()).copied().unwrap_or(g.zero())
    }

    /// L_X ω by its definition on components, `X(ω_I) dx^I + ω_I Σ dx^{i_1} ∧ … dX^{i_k} … ∧ dx^{i_p}`; that it is
    /// `d(X ⌟ ω) + X ⌟ dω` is Cartan's formula.
    #[must_use]
    pub fn lie(&self, space: &Space<'_>, field: &Field) -> Form {
        let g = space.graph();
        let coefficients: Vec<Expr> = self.terms.values().copied().collect();
        let rates = field.derivatives(space, &coefficients);
        let own = self.terms.keys().cloned().zip(rates);
        let mut sum = Form::collected(self.degree, own.collect(), g);
        let moved: Vec<Form> = space
            .partials(&field.components)
            .iter()
            .map(|row| space.one_form(row))
            .collect();
        for (places, &e) in &self.terms {
            for number in 0..places.len() {
                let mut part = space.function(e);
                for (at, &place) in places.iter().enumerate() {
                    let factor = match at == number {
                        true => moved[place].clone(),
                        false => space.differential(place),
                    };
                    part = part.wedge(g, &factor);
                }
                sum = sum.plus(g, &part);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::merged;

    #[test]
    fn signs_of_permutations() {
        assert_eq!(merged(&[1], &[0]), Some((vec![0, 1], true)));
        assert_eq!(merged(&[0, 2], &[1]), Some((vec![0, 1, 2], true)));
        assert_eq!(merged(&[2], &[0, 1]), Some((vec![0, 1, 2], false)));
        assert_eq!(merged(&[0, 1], &[1]), None);
    }
}
