//! Vector fields by their components.

use super::space::Space;
use crate::cartan::JetField;
use chetaev_symbolic::Expr;

/// `Σ X^i ∂/∂x^i`, one component for each coordinate of the space.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The components.
    pub components: Vec<Expr>,
}

impl Field {
    /// ∂/∂x of one coordinate.
    pub fn unit(space: &Space<'_>, place: usize) -> Field {
        let g = space.graph();
        let entry = |i| if i == place { g.one() } else { g.zero() };
        Field {
            components: (0..space.dimension()).map(entry).collect(),
        }
    }

    /// A field on J¹.
    pub fn of_jet(field: &JetField) -> Field {
        let first = std::iter::once(&field.t);
        let all = first.chain(&field.q).chain(&field.v);
        Field {
            components: all.copied().collect(),
        }
    }

    /// X of functions.
    pub fn derivatives(&self, space: &Space<'_>, es: &[Expr]) -> Vec<Expr> {
        let g = space.graph();
        let rows = space.partials(es);
        rows.iter()
            .map(|row| {
                let pairs = row.iter().zip(&self.components);
                let parts: Vec<Expr> = pairs
                    .filter(|(a, b)| !g.is_zero(**a) && !g.is_zero(**b))
                    .map(|(&a, &b)| g.mul(&[a, b]))
                    .collect();
                g.add(&parts)
            })
            .collect()
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, space: &Space<'_>, other: &Field) -> Field {
        let pairs = self.components.iter().zip(&other.components);
        let sums = pairs.map(|(&a, &b)| space.graph().add(&[a, b]));
        Field {
            components: sums.collect(),
        }
    }

    /// [X, Y].
    #[must_use]
    pub fn bracket(&self, space: &Space<'_>, other: &Field) -> Field {
        let g = space.graph();
        let forward = self.derivatives(space, &other.components);
        let backward = other.derivatives(space, &self.components);
        let pairs = forward.into_iter().zip(backward);
        Field {
            components: pairs.map(|(a, b)| g.sub(a, b)).collect(),
        }
    }
}
