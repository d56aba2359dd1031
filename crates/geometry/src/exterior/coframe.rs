//! Other bases than that of the coordinates.

use super::field::Field;
use super::form::Form;
use super::space::Space;
use chetaev_mechanics::Frame;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

/// 1-forms e^a, as many as coordinates, with their dual fields.
#[derive(Clone, Debug)]
pub struct Coframe {
    /// The forms.
    pub forms: Vec<Form>,
    /// The fields E_a with e^a(E_b) = δ.
    pub fields: Vec<Field>,
}

impl Coframe {
    /// The basis {dt, θ^s, dη^s} of J¹ with `θ^s = ω^s - η^s dt` and `ω^s = a^s_u dq^u + a^s_0 dt` of a frame; its dual fields are the
    /// motion with frozen η, X_s, and ∂/∂η^s.
    ///
    /// # Errors
    /// Where the forms are dependent as written.
    pub fn contact(space: &Space<'_>, frame: &Frame) -> Result<Coframe, SolveError> {
        let (system, g) = (space.system(), space.graph());
        let n = system.n();
        let mut forms = vec![space.differential(0)];
        let mut speeds = Vec::new();
        for row in &frame.forms {
            let products = |with: &dyn Fn(usize) -> Expr| {
                let parts: Vec<Expr> = (0..n).map(|u| g.mul(&[row[u], with(u)])).collect();
                g.add(&parts)
            };
            let shift = g.neg(products(&|u| frame.drift[u]));
            let moving = products(&|u| system.coordinates[u].v);
            let speed = g.add(&[moving, shift]);
            speeds.push(speed);
            let mut components = vec![g.zero(); space.dimension()];
            components[0] = g.sub(shift, speed);
            components[1..=n].copy_from_slice(row);
            forms.push(space.one_form(&components));
        }
        let rows = space.partials(&speeds);
        forms.extend(rows.iter().map(|row| space.one_form(row)));
        Coframe::of(space, forms)
    }

    /// A basis by its forms.
    ///
    /// # Errors
    /// Where they are dependent as written.
    pub fn of(space: &Space<'_>, forms: Vec<Form>) -> Result<Coframe, SolveError> {
        let (g, size) = (space.graph(), space.dimension());
        let component = |form: &Form, place: usize| {
            let found = form.terms().get(&vec![place]);
            found.copied().unwrap_or(g.zero())
        };
        let matrix: Vec<Expr> = forms
            .iter()
            .flat_map(|form| (0..size).map(move |place| component(form, place)))
            .collect();
        let fields: Result<Vec<Field>, SolveError> = (0..forms.len())
            .map(|b| {
                let entry = |a| if a == b { g.one() } else { g.zero() };
                let unit: Vec<Expr> = (0..forms.len()).map(entry).collect();
                let components = g.solve(&matrix, &unit)?;
                Ok(Field { components })
            })
            .collect();
        Ok(Coframe {
            fields: fields?,
            forms,
        })
    }

    /// The components of a form in this basis, at ascending places.
    pub fn components(&self, space: &Space<'_>, form: &Form) -> BTreeMap<Vec<usize>, Expr> {
        let g = space.graph();
        let mut found = BTreeMap::new();
        for places in ascending(self.fields.len(), form.degree()) {
            let fields: Vec<&Field> = places.iter().map(|&a| &self.fields[a]).collect();
            let value = form.on(g, &fields);
            if !g.is_zero(value) {
                found.insert(places, value);
            }
        }
        found
    }

    /// The components `e^a(X)` of a field along the fields of this basis.
    pub fn field_components(&self, space: &Space<'_>, field: &Field) -> Vec<Expr> {
        let g = space.graph();
        let forms = self.forms.iter();
        forms.map(|form| form.on(g, &[field])).collect()
    }

    /// The field with given components along the fields of this basis.
    pub fn field(&self, space: &Space<'_>, components: &[Expr]) -> Field {
        let g = space.graph();
        let along = |place: usize| {
            let pairs = components.iter().zip(&self.fields);
            let parts = pairs.map(|(&c, field)| g.mul(&[c, field.components[place]]));
            g.add(&parts.collect::<Vec<Expr>>())
        };
        Field {
            components: (0..space.dimension()).map(along).collect(),
        }
    }

    /// The form with given components in this basis.
    pub fn form(
        &self,
        space: &Space<'_>,
        degree: usize,
        components: &BTreeMap<Vec<usize>, Expr>,
    ) -> Form {
        let g = space.graph();
        let mut sum = Form::new(degree, BTreeMap::new(), g);
        for (places, &e) in components {
            let part = places
                .iter()
                .fold(space.function(e), |form, &a| form.wedge(g, &self.forms[a]));
            sum = sum.plus(g, &part);
        }
        sum
    }
}

/// Ascending lists of `length` places below `size`.
fn ascending(size: usize, length: usize) -> Vec<Vec<usize>> {
    let mut found = vec![Vec::new()];
    for _ in 0..length {
        found = found
            .into_iter()
            .flat_map(|list: Vec<usize>| {
                let next = list.last().map_or(0, |&last| last + 1);
                (next..size).map(move |place| {
                    let mut longer = list.clone();
                    longer.push(place);
                    longer
                })
            })
            .collect();
    }
    found
}
