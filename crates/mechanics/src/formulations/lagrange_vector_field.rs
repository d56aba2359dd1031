//! The Lagrange vector field: `X ⌟ Ω = 0`, `dt(X) = 1`, with `Ω = dΘ(L) + Q_s θ^s ∧ dt + λ_l Θ(f^l) ∧ dt`.
//!
//! Θ(F) = F dt + (∂F/∂η^s) θ^s is the Cartan form, θ^s = ω^s - η^s dt the contact forms of the frame (T3 §2, §4; Cartan 1922,
//! Klein 1962). Ω is built as an antisymmetric matrix in the basis (dt, dq, dη) by differentiating the components of Θ; the
//! components of X ⌟ Ω along dq are linear in (η', λ).

use super::poincare_chetaev::frame_objects;
use super::routh::multiplier_objects;
use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::derive_along;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use crate::frame::Frame;
use crate::linear::dot;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// The field whose contraction with the dynamical 2-form vanishes.
#[derive(Clone, Copy, Debug)]
pub struct LagrangeVectorField;

static CARD: Card = Card {
    name: "lagrange-vector-field",
    title: "Lagrange vector field",
    statement: "The motion is the field X of the space (t, q, η) with dt(X) = 1 whose contraction with the dynamical 2-form vanishes.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.frame-regular", "model.masses-free-of-velocity"],
    identity: Some("every component of X ⌟ Ω vanishes on the constraints, that along dt and those along dη included"),
    unknowns: "the components of X along the quasi-velocities and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[
        Source { key: "cartan1922", place: "" },
        Source { key: "zhao", place: "(3)–(7)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "X ⌟ ( dΘ(L) + Q_s θ^s ∧ dt + λ_l Θ(f^l) ∧ dt ) = 0,  dt(X) = 1,  X f^l = 0",
    latex: r"X \lrcorner \bigl( d\Theta(L) + Q_s \theta^s \wedge dt + \lambda_l \Theta(f^l) \wedge dt \bigr) = 0, \quad dt(X) = 1, \quad X f^l = 0",
};

impl Formulation for LagrangeVectorField {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let form = TwoForm::new(basis)?;
        let (rates, multipliers) = form.solve(basis)?;
        let objects = multiplier_objects(basis, &multipliers);
        let indices = basis.constraint_indices();
        let mut equations = form
            .state(&rates)
            .with_group("components of X ⌟ Ω along dq", Some(SCHEMA), form.stated())
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects(frame_objects(basis.system, &form.frame))
            .with_objects(form.cartan_objects())
            .with_objects(form.two_form_objects())
            .with_objects(form.field_objects(&rates))
            .with_objects(objects);
        equations.multipliers = indices.into_iter().zip(multipliers).collect();
        Ok(equations)
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let form = TwoForm::new(basis)?;
        let (rates, multipliers) = form.solve(basis)?;
        let equations = form.state(&rates);
        let residuals = form.contraction(&rates, &multipliers);
        let chart = basis.independent_velocities()?;
        Ok(vec![Identity {
            statement: "X ⌟ Ω = 0 in every component".into(),
            residuals: equations.in_natural_state(basis.system, &residuals),
            manifold: chart.manifold,
            on: "on the constraint manifold",
        }])
    }
}

/// Components of the 2-form, and of the field, are written out for so many coordinates.
const MOST_COMPONENTS: usize = 4;

/// Ω without its multipliers, and the forms Θ(f^l) ∧ dt, in the basis (dt, dq^1..dq^n, dη^1..dη^n).
struct TwoForm<'a> {
    system: &'a System,
    frame: Frame,
    velocities: Vec<Expr>,
    /// Components of Θ(L).
    cartan: Vec<Expr>,
    /// The antisymmetric matrix of dΘ(L) + Q_s θ^s ∧ dt: entry (a, b) with Ω = Σ_{a<b} Ω_ab dx^a ∧ dx^b.
    matrix: Vec<Vec<Expr>>,
    /// Components of the Θ(f^l).
    pfaff: Vec<Vec<Expr>>,
    constraints: Vec<Expr>,
    lambdas: Vec<Expr>,
}

impl<'a> TwoForm<'a> {
    fn new(basis: &Basis<'a>) -> Result<TwoForm<'a>, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let frame = match Frame::stated(system, basis.terms, basis.selection) {
            Some(stated) => stated?.0,
            None => Frame::natural(system),
        };
        let speeds: Vec<Expr> = frame.speeds.iter().map(|s| s.value).collect();
        let velocities = frame.velocities(system, &speeds);
        let pairs: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&velocities)
            .filter(|(c, v)| c.v != **v)
            .map(|(c, &v)| (c.v, v))
            .collect();
        let lagrangian = g.substitute(system.lagrangian, &pairs);
        let constraints = g.substitute_all(&basis.constraints(), &pairs);
        let forces = g.substitute_all(&system.forces, &pairs);
        let mut form = TwoForm {
            lambdas: basis.lambda_symbols(),
            cartan: Vec::new(),
            matrix: Vec::new(),
            pfaff: Vec::new(),
            constraints,
            velocities,
            frame,
            system,
        };
        form.cartan = form.cartan_form(lagrangian);
        form.matrix = form.exterior_derivative(&form.cartan);
        form.pfaff = form
            .constraints
            .iter()
            .map(|&f| form.cartan_form(f))
            .collect();
        form.add_forces(&forces);
        Ok(form)
    }

    /// `Θ(F) = F dt + (∂F/∂η^s)(ω^s - η^s dt)`: its components along dt, dq, dη. With `ω^s = a^s_u dq^u + a^s_0 dt` and
    /// `v = X_0 + η^s X_s` the component along dt is `F - Σ_u c_u v^u`, c_u those along dq.
    fn cartan_form(&self, f: Expr) -> Vec<Expr> {
        let (system, g) = (self.system, &self.system.graph);
        let symbols: Vec<Symbol> = self.frame.speeds.iter().map(|s| s.symbol).collect();
        let slopes = g.gradient(f, &symbols);
        let along: Vec<Expr> = (0..system.n())
            .map(|u| {
                let column: Vec<Expr> = self.frame.forms.iter().map(|form| form[u]).collect();
                dot(g, &slopes, &column)
            })
            .collect();
        let mut components = vec![g.sub(f, dot(g, &along, &self.velocities))];
        components.extend(along);
        components.extend(std::iter::repeat_n(g.zero(), system.n()));
        components
    }

    /// `(dΘ)_ab = ∂_aΘ_b - ∂_bΘ_a`.
    fn exterior_derivative(&self, components: &[Expr]) -> Vec<Vec<Expr>> {
        let (system, g) = (self.system, &self.system.graph);
        let mut symbols = system.coordinate_symbols();
        symbols.extend(self.frame.speeds.iter().map(|s| s.symbol));
        // Rows: components; columns: derivatives by (t, q, η).
        let by_state = g.jacobian(components, &symbols);
        let still = vec![g.zero(); system.n()];
        let masses = system.mass_rates(&self.velocities);
        let by_time = derive_along(system, components, &still, g.one(), &masses);
        let derivative = |b: usize, a: usize| match a {
            0 => by_time[b],
            a => by_state[b][a - 1],
        };
        let size = components.len();
        let mut matrix = vec![vec![g.zero(); size]; size];
        for (a, b) in (0..size).flat_map(|a| (a + 1..size).map(move |b| (a, b))) {
            let entry = g.sub(derivative(b, a), derivative(a, b));
            matrix[a][b] = entry;
            matrix[b][a] = g.neg(entry);
        }
        matrix
    }

    /// `Q_s θ^s ∧ dt = Q_u (dq^u - v^u dt) ∧ dt = Q_u dq^u ∧ dt`.
    fn add_forces(&mut self, forces: &[Expr]) {
        let g = &self.system.graph;
        for (u, &force) in forces.iter().enumerate() {
            self.matrix[u + 1][0] = g.add(&[self.matrix[u + 1][0], force]);
            self.matrix[0][u + 1] = g.sub(self.matrix[0][u + 1], force);
        }
    }

    /// The components of X.
    fn field(&self, rates: &[Expr]) -> Vec<Expr> {
        let mut field = vec![self.system.graph.one()];
        field.extend(&self.velocities);
        field.extend(rates);
        field
    }

    /// The components of X ⌟ Ω, `Σ_a X^a Ω_ab`, with `X ⌟ (Θ(f) ∧ dt) = Θ(f)(X) dt - Θ(f)`.
    fn contraction(&self, rates: &[Expr], multipliers: &[Expr]) -> Vec<Expr> {
        let g = &self.system.graph;
        let field = self.field(rates);
        (0..field.len())
            .map(|b| {
                let column: Vec<Expr> = self.matrix.iter().map(|row| row[b]).collect();
                let mut parts = vec![dot(g, &field, &column)];
                for (&lambda, pfaff) in multipliers.iter().zip(&self.pfaff) {
                    let reaction = match b {
                        0 => g.sub(dot(g, pfaff, &field), pfaff[0]),
                        b => g.neg(pfaff[b]),
                    };
                    parts.push(g.mul(&[lambda, reaction]));
                }
                g.add(&parts)
            })
            .collect()
    }

    /// η' and λ from the components along dq and `X f = 0`.
    fn solve(&self, basis: &Basis<'_>) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
        let (system, g) = (self.system, &self.system.graph);
        let (n, r) = (system.n(), self.constraints.len());
        let size = n + r;
        let mut matrix = vec![g.zero(); size * size];
        let mut right = Vec::with_capacity(size);
        let still = self.contraction(&vec![g.zero(); n], &[]);
        for u in 0..n {
            for s in 0..n {
                matrix[u * size + s] = self.matrix[n + 1 + s][u + 1];
            }
            for (l, pfaff) in self.pfaff.iter().enumerate() {
                matrix[u * size + n + l] = g.neg(pfaff[u + 1]);
            }
            right.push(g.neg(still[u + 1]));
        }
        let symbols: Vec<Symbol> = self.frame.speeds.iter().map(|s| s.symbol).collect();
        let gradient = g.jacobian(&self.constraints, &symbols);
        let one = g.one();
        let frozen = derive_along(system, &self.constraints, &self.velocities, one, &[]);
        for (l, row) in gradient.iter().enumerate() {
            matrix[(n + l) * size..(n + l) * size + n].copy_from_slice(row);
            right.push(g.neg(frozen[l]));
        }
        debug_assert_eq!(basis.selection.rows.len(), r);
        let mut solution = g.solve(&matrix, &right)?;
        let multipliers = solution.split_off(n);
        Ok((solution, multipliers))
    }

    fn state(&self, rates: &[Expr]) -> Equations {
        let variables = self
            .frame
            .speeds
            .iter()
            .zip(rates)
            .map(|(speed, &rate)| StateVariable::of_speed(speed, rate))
            .collect();
        Equations::in_state(CARD.name, self.system, variables, self.velocities.clone())
    }

    fn stated(&self) -> Vec<Equation> {
        let zero = self.system.graph.zero();
        let rates: Vec<Expr> = self.frame.speeds.iter().map(|s| s.rate).collect();
        let components = self.contraction(&rates, &self.lambdas);
        let coordinates = self.system.coordinates.iter();
        coordinates
            .zip(&components[1..])
            .map(|(c, &left)| Equation {
                label: c.name.clone(),
                left,
                right: zero,
            })
            .collect()
    }

    /// The components of Θ(L) that do not vanish.
    /// The components of dΘ(L) + Q_s θ^s ∧ dt that do not vanish; nothing where they are too many to read.
    fn two_form_objects(&self) -> Vec<NamedExpr> {
        let (system, g) = (self.system, &self.system.graph);
        if system.n() > MOST_COMPONENTS {
            return Vec::new();
        }
        let mut names = vec!["t".to_string()];
        names.extend(system.coordinates.iter().map(|c| c.name.clone()));
        let bare = |name: &str| super::bare(name).to_string();
        names.extend(
            self.frame
                .speeds
                .iter()
                .map(|s| match self.frame.is_natural(system) {
                    true => format!("v_{}", bare(&s.name)),
                    false => bare(&s.name),
                }),
        );
        let mut objects = Vec::new();
        for (a, first) in names.iter().enumerate() {
            for (b, second) in names.iter().enumerate().skip(a + 1) {
                if !g.is_zero(self.matrix[a][b]) {
                    objects.push(NamedExpr::component(
                        format!("Omega_{first}_{second}"),
                        self.matrix[a][b],
                        format!("component of dΘ(L) + Q ∧ dt along d{first} ∧ d{second}"),
                    ));
                }
            }
        }
        objects
    }

    /// The components of X along ∂/∂η.
    fn field_objects(&self, rates: &[Expr]) -> Vec<NamedExpr> {
        if self.system.n() > MOST_COMPONENTS {
            return Vec::new();
        }
        let pairs = self.frame.speeds.iter().zip(rates);
        pairs
            .map(|(speed, &rate)| {
                let name = format!("A_{}", super::bare(&speed.name));
                let meaning = format!("component of X along ∂/∂{}", speed.name);
                NamedExpr::new(name, rate, meaning)
            })
            .collect()
    }

    fn cartan_objects(&self) -> Vec<NamedExpr> {
        let g = &self.system.graph;
        let mut names = vec!["t".to_string()];
        names.extend(self.system.coordinates.iter().map(|c| c.name.clone()));
        names
            .iter()
            .zip(&self.cartan)
            .filter(|(_, &value)| !g.is_zero(value))
            .map(|(name, &value)| {
                NamedExpr::new(
                    format!("Theta_{name}"),
                    value,
                    format!("component of the Cartan form Θ(L) along d{name}"),
                )
            })
            .collect()
    }
}
