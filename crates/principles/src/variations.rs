//! Variations of the velocity, and what they do to the constraints (T1 §2; Rumyantsev 1982).
//!
//! Chetaev's condition `Σ ∂f/∂vⁱ δqⁱ = 0` fixes the virtual displacements; what δv is has to be agreed upon:
//!
//! - Hölder: `δv = D(δq)`. Varied curves are curves, but in general they violate the constraints, by
//!   `δf^l = Σ E_i[f^l] δqⁱ` (T1 (5)).
//! - Suslov: `δv = D(δq)` for the independent velocities, and `δf = 0`, so that `δv = D(δq) − Σ A δq` for the dependent ones
//!   (T1 (8)). Varied states are admissible, but they are no states of varied curves unless A = 0.
//!
//! Everything is written by the independent displacements δ_s on the jet (t, q, P, P') of independent velocities P.

mod hoelder;
mod suslov;

pub use hoelder::Hoelder;
pub use suslov::Suslov;

use chetaev_mechanics::claims::formulation::{basis, derive, REFERENCE};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::curvature::curvature;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{Characteristics, Manifold, System};
use chetaev_symbolic::{Expr, Symbol};

/// A linear form `Σ_s value_s δ_s + rate_s D(δ_s)` in the independent displacements.
#[derive(Clone, Debug)]
pub struct Variation {
    /// The coefficients of δ_s, length k.
    pub value: Vec<Expr>,
    /// The coefficients of D(δ_s), length k.
    pub rate: Vec<Expr>,
}

/// How the variation of the velocity is defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// `δv = D(δq)`.
    Hoelder,
    /// `δv = D(δq)` for the independent velocities, `δf = 0`.
    Suslov,
}

/// The virtual displacements of a system by those of its independent coordinates.
#[derive(Debug)]
pub struct Displacements<'a> {
    system: &'a System,
    /// Independent velocities.
    pub chart: Characteristics,
    /// `delta_x` for each independent coordinate.
    pub free: Vec<Expr>,
    /// Their derivatives D(δ_s).
    pub rates: Vec<Expr>,
    /// ∂L/∂q on the constraint manifold, length n.
    pub slopes: Vec<Expr>,
    /// ∂L/∂v of the full Lagrangian on the constraint manifold, length n.
    pub momenta: Vec<Expr>,
}

impl<'a> Displacements<'a> {
    /// The displacements of the context's system.
    ///
    /// # Errors
    /// [`DeriveError`] where the dependent velocities cannot be solved for.
    pub fn new(cx: &Context<'a>) -> Result<Displacements<'a>, DeriveError> {
        let (system, g) = (cx.system, &cx.system.graph);
        let chart = basis(cx).independent_velocities()?;
        let symbols = |order: u32| -> Vec<Expr> {
            let independent = chart.independent.iter();
            independent
                .map(|&i| g.symbol(&delta_name(system, i), order))
                .collect()
        };
        let mut functions = g.gradient(system.lagrangian, &system.coordinate_symbols());
        functions.extend(g.gradient(system.lagrangian, &system.velocity_symbols()));
        let mut slopes = chart.restrict(system, &functions);
        let momenta = slopes.split_off(system.n());
        Ok(Displacements {
            system,
            free: symbols(0),
            rates: symbols(1),
            slopes,
            momenta,
            chart,
        })
    }

    /// δqⁱ, length n: `Σ_s B_is δ_s`.
    pub fn displacements(&self) -> Vec<Variation> {
        let zero = vec![self.system.graph.zero(); self.chart.k()];
        let rows = self.chart.basis.iter();
        rows.map(|row| Variation {
            value: row.clone(),
            rate: zero.clone(),
        })
        .collect()
    }

    /// D(δqⁱ), length n: `Σ_s (D B_is) δ_s + B_is D(δ_s)`.
    pub fn moved_displacements(&self) -> Vec<Variation> {
        let k = self.chart.k();
        let moved = self
            .chart
            .total_derivative(self.system, &self.chart.basis.concat());
        let rows = self.chart.basis.iter().enumerate();
        rows.map(|(i, row)| Variation {
            value: moved[i * k..(i + 1) * k].to_vec(),
            rate: row.clone(),
        })
        .collect()
    }

    /// The variations of functions of (q, P, t): q varied by δq, P by D(δ_s), as both rules have it.
    pub fn vary(&self, es: &[Expr]) -> Vec<Variation> {
        let by_displacements = self.chart.by_quasi_coordinates(self.system, es);
        let by_velocities = self.chart.by_parameters(self.system, es);
        let pairs = by_displacements.into_iter().zip(by_velocities);
        pairs
            .map(|(value, rate)| Variation { value, rate })
            .collect()
    }

    /// δvⁱ by a rule, length n.
    pub fn velocities(&self, rule: Rule) -> Vec<Variation> {
        match rule {
            Rule::Hoelder => self.moved_displacements(),
            Rule::Suslov => self.vary(&self.chart.velocities),
        }
    }

    /// `Σ weights · variations`.
    pub fn combination(&self, weights: &[Expr], variations: &[Variation]) -> Variation {
        let g = &self.system.graph;
        let sum = |s: usize, part: fn(&Variation) -> &Vec<Expr>| {
            dot(g, weights, variations.iter().map(|v| &part(v)[s]))
        };
        let k = self.chart.k();
        Variation {
            value: (0..k).map(|s| sum(s, |v| &v.value)).collect(),
            rate: (0..k).map(|s| sum(s, |v| &v.rate)).collect(),
        }
    }

    /// The sum of two forms.
    pub fn sum(&self, a: &Variation, b: &Variation) -> Variation {
        self.both(a, b, |x, y| self.system.graph.add(&[x, y]))
    }

    /// The difference of two forms.
    pub fn difference(&self, a: &Variation, b: &Variation) -> Variation {
        self.both(a, b, |x, y| self.system.graph.sub(x, y))
    }

    fn both(&self, a: &Variation, b: &Variation, join: impl Fn(Expr, Expr) -> Expr) -> Variation {
        let joined = |a: &[Expr], b: &[Expr]| -> Vec<Expr> {
            a.iter().zip(b).map(|(&x, &y)| join(x, y)).collect()
        };
        Variation {
            value: joined(&a.value, &b.value),
            rate: joined(&a.rate, &b.rate),
        }
    }

    /// δL by a rule: `Σ ∂L/∂q δq + ∂L/∂v δv` with the full Lagrangian.
    pub fn of_lagrangian(&self, rule: Rule) -> Variation {
        let by_displacements = self.combination(&self.slopes, &self.displacements());
        let by_velocities = self.combination(&self.momenta, &self.velocities(rule));
        self.sum(&by_displacements, &by_velocities)
    }

    /// What multiplies δ_s when the integral of a form is integrated by parts, `value − D(rate)`; the end terms are
    /// `Σ rate_s δ_s`.
    pub fn reduced(&self, form: &Variation) -> Vec<Expr> {
        let g = &self.system.graph;
        let moved = self.chart.total_derivative(self.system, &form.rate);
        let pairs = form.value.iter().zip(moved);
        pairs.map(|(&value, moved)| g.sub(value, moved)).collect()
    }

    /// The form as an expression in the symbols δ_s, D(δ_s).
    pub fn written(&self, form: &Variation) -> Expr {
        let g = &self.system.graph;
        let value = dot(g, &form.value, &self.free);
        g.add(&[value, dot(g, &form.rate, &self.rates)])
    }

    /// `δf^l = Σ_i E_i[f^l] δqⁱ` by Hölder's rule (T1 (5)) of the selected constraints: r × k.
    pub fn of_constraints(&self, cx: &Context<'_>) -> Vec<Vec<Expr>> {
        let (system, g) = (self.system, &self.system.graph);
        let basis = basis(cx);
        let slopes = g.jacobian(&basis.constraints(), &system.coordinate_symbols());
        let rows = basis.jacobian().into_iter().zip(slopes);
        rows.map(|(jacobian, slopes)| {
            let pairs = jacobian.into_iter().zip(slopes);
            let euler: Vec<Expr> = pairs
                .map(|(by_velocity, slope)| g.sub(slope, system.total_derivative(by_velocity)))
                .collect();
            let euler = self.chart.on_jet(system, &euler);
            self.chart.contract(system, &euler)
        })
        .collect()
    }

    /// The curvature coefficients A^l_s (T1 (7)), r × k, in the order of the dependent velocities.
    pub fn curvature(&self) -> Vec<Vec<Expr>> {
        curvature(self.system, &self.chart)
    }

    /// θ_l, the momenta of the dependent velocities.
    pub fn dependent_momenta(&self) -> Vec<Expr> {
        let dependent = self.chart.dependent.iter();
        dependent.map(|&d| self.momenta[d]).collect()
    }

    /// `Σ_l θ_l A^l_s δ_s`.
    pub fn gyroscopic(&self) -> Variation {
        let g = &self.system.graph;
        let (momenta, curvature) = (self.dependent_momenta(), self.curvature());
        Variation {
            value: (0..self.chart.k())
                .map(|s| dot(g, &momenta, curvature.iter().map(|row| &row[s])))
                .collect(),
            rate: vec![g.zero(); self.chart.k()],
        }
    }

    /// L*, the Lagrangian on the constraint manifold.
    pub fn restricted_lagrangian(&self) -> Expr {
        let lagrangian = self.system.lagrangian;
        self.chart.restrict(self.system, &[lagrangian])[0]
    }

    /// Functions on the jet where P' is that of Routh's equations: functions of (q, P, t).
    ///
    /// # Errors
    /// [`DeriveError`].
    pub fn on_motion(&self, cx: &Context<'_>, es: &[Expr]) -> Result<Vec<Expr>, DeriveError> {
        let rates = self.motion(cx)?;
        let pairs: Vec<(Expr, Expr)> = self
            .chart
            .parameters
            .iter()
            .zip(rates)
            .map(|(p, rate)| (p.rate, rate))
            .collect();
        Ok(self.system.graph.substitute_all(es, &pairs))
    }

    /// Whether P' occurs, as it does for constraints nonlinear in the velocities.
    pub fn has_accelerations(&self, es: &[Expr]) -> bool {
        let rates = self.chart.parameters.iter().map(|p| p.rate_symbol);
        let rates: Vec<Symbol> = rates.collect();
        self.system.graph.any_contains_any(es, &rates)
    }

    /// P' of Routh's equations, as functions of (q, P, t).
    fn motion(&self, cx: &Context<'_>) -> Result<Vec<Expr>, DeriveError> {
        let routh = derive(cx, REFERENCE)?;
        let independent = self.chart.independent.iter();
        let rates: Vec<Expr> = independent.map(|&i| routh.accelerations[i]).collect();
        Ok(self.chart.restrict(self.system, &rates))
    }

    /// What ties the symbols.
    pub fn manifold(&self) -> &Manifold {
        &self.chart.manifold
    }

    /// The symbols of δ_s.
    pub fn symbols(&self) -> Vec<Symbol> {
        let g = &self.system.graph;
        self.free.iter().filter_map(|&e| g.as_symbol(e)).collect()
    }
}

/// The name of the displacement of a coordinate.
pub fn delta_name(system: &System, coordinate: usize) -> String {
    unused_name(
        system,
        &format!("delta_{}", system.coordinates[coordinate].name),
    )
}
