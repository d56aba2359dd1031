//! The distribution annihilated by the Chetaev Pfaff system `𝒫 = span{Θ(f¹), …, Θ(f^r)}`, by a basis of fields.
//!
//! With dependent velocities `v_d` (r of them, `J_d = ∂f/∂v_d` nonsingular), `C = -J_d⁻¹ J_i` and
//! `c = -J_d⁻¹ (f - J v)`, the common kernel of the forms on J¹, of dimension 2n + 1 - r, is spanned by
//!
//! * `∂/∂v^s`, all n of them,
//! * `Y_i = ∂/∂q^i + C^α_i ∂/∂q^α` for the k = n - r independent coordinates,
//! * `Y_0 = ∂/∂t + c^α ∂/∂q^α`.
//!
//! Its part tangent to the constraint manifold `N = {f = 0}`, of dimension 2k + 1, is spanned at points of N by
//! `b_i = ∂/∂v^i + C^α_i ∂/∂v^α` and by `Y_i`, `Y_0` with `-J_d⁻¹ (Y f)` added in the dependent velocities (T3 §5).

use crate::cartan::{CartanForm, JetField};
use chetaev_mechanics::{MotionTerms, Selection, System};
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::Expr;

/// A basis of fields, in the order in which output names them.
#[derive(Clone, Debug)]
pub struct Distribution {
    /// `∂/∂v` directions: all of them on J¹, the b_i on N.
    pub vertical: Vec<JetField>,
    /// Y_i, one for each independent coordinate.
    pub horizontal: Vec<JetField>,
    /// Y_0.
    pub time: JetField,
}

impl Distribution {
    /// The kernel of 𝒫 on all of J¹.
    ///
    /// # Errors
    /// [`SolveError`] when `J_d` is structurally singular.
    pub fn on_jet_space(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<Distribution, SolveError> {
        let g = &system.graph;
        let chart = Chart::new(system, terms, selection);
        let vertical = (0..system.n())
            .map(|s| {
                let mut field =
                    JetField::zero(system, format!("∂/∂{}'", system.coordinates[s].name));
                field.v[s] = g.one();
                field
            })
            .collect();
        Ok(Distribution {
            vertical,
            horizontal: chart.horizontal()?,
            time: chart.time()?,
        })
    }

    /// The fields tangent to N that annihilate 𝒫; a basis at points of N.
    ///
    /// # Errors
    /// [`SolveError`] when `J_d` is structurally singular.
    pub fn on_constraint_manifold(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<Distribution, SolveError> {
        let g = &system.graph;
        let chart = Chart::new(system, terms, selection);
        let mut horizontal = chart.horizontal()?;
        let vertical = horizontal
            .iter()
            .zip(chart.independent())
            .map(|(y, i)| JetField {
                name: format!("b_{}", system.coordinates[i].name),
                t: g.zero(),
                q: vec![g.zero(); system.n()],
                v: y.q.clone(),
            })
            .collect();
        let mut time = chart.time()?;
        for field in horizontal.iter_mut().chain([&mut time]) {
            chart.lift(field)?;
        }
        Ok(Distribution {
            vertical,
            horizontal,
            time,
        })
    }

    /// All fields: vertical, horizontal, time.
    pub fn fields(&self) -> impl Iterator<Item = &JetField> {
        self.vertical
            .iter()
            .chain(&self.horizontal)
            .chain([&self.time])
    }
}

/// The dependent velocities and what is solved for them.
struct Chart<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    selection: &'a Selection,
    /// J_d row by row.
    block: Vec<Expr>,
}

impl<'a> Chart<'a> {
    fn new(system: &'a System, terms: &'a MotionTerms, selection: &'a Selection) -> Chart<'a> {
        let block = selection
            .rows
            .iter()
            .flat_map(|&row| {
                selection
                    .dependent
                    .iter()
                    .map(move |&d| terms.jacobian[row][d])
            })
            .collect();
        Chart {
            system,
            terms,
            selection,
            block,
        }
    }

    fn independent(&self) -> Vec<usize> {
        self.selection.independent(self.system.n())
    }

    /// `-J_d⁻¹ rhs`.
    fn solve(&self, rhs: &[Expr]) -> Result<Vec<Expr>, SolveError> {
        let negated: Vec<Expr> = rhs.iter().map(|&e| self.system.graph.neg(e)).collect();
        self.system.graph.solve(&self.block, &negated)
    }

    fn horizontal(&self) -> Result<Vec<JetField>, SolveError> {
        self.independent()
            .into_iter()
            .map(|i| {
                let column: Vec<Expr> = self
                    .selection
                    .rows
                    .iter()
                    .map(|&row| self.terms.jacobian[row][i])
                    .collect();
                let name = format!("Y_{}", self.system.coordinates[i].name);
                let mut field = JetField::zero(self.system, name);
                field.q[i] = self.system.graph.one();
                for (&d, slope) in self.selection.dependent.iter().zip(self.solve(&column)?) {
                    field.q[d] = slope;
                }
                Ok(field)
            })
            .collect()
    }

    fn time(&self) -> Result<JetField, SolveError> {
        let offsets: Vec<Expr> = self
            .selection
            .rows
            .iter()
            .map(|&row| CartanForm::of(self.system, self.terms.constraints[row]).dt)
            .collect();
        let mut field = JetField::zero(self.system, "Y_0");
        field.t = self.system.graph.one();
        for (&d, slope) in self.selection.dependent.iter().zip(self.solve(&offsets)?) {
            field.q[d] = slope;
        }
        Ok(field)
    }

    /// Adds what makes the field tangent to f = 0.
    fn lift(&self, field: &mut JetField) -> Result<(), SolveError> {
        let constraints: Vec<Expr> = self
            .selection
            .rows
            .iter()
            .map(|&row| self.terms.constraints[row])
            .collect();
        let rates = field.derivatives(self.system, &constraints);
        for (&d, value) in self.selection.dependent.iter().zip(self.solve(&rates)?) {
            field.v[d] = value;
        }
        Ok(())
    }
}
