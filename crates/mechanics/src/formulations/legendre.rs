//! The Legendre transform: momenta `pᵢ = ∂L/∂vⁱ`, velocities as functions of (q, p, t), and the Hamiltonian.
//!
//! For L quadratic in the velocities, `v = W⁻¹ (p − L₁)` is one solve node and `H = ½ (p − L₁)·v − L₀` is closed; so it is
//! for some functions of a quadratic form (`inversion`). The derivatives are then those of that expression.
//! For any other L the velocities stay symbols tied by `p − ∂L/∂v = 0`, and a
//! function of (q, p, t) changes along a direction with `v' = W⁻¹ (p' − L_vq q' − L_vt t')`; there
//! `∂H/∂p = v`, `∂H/∂q = −∂L/∂q`, `∂H/∂t = −∂L/∂t`, since `H = p·v − L` is stationary in v (T1 §6.1, §7.3).

use super::inversion::{Inverse, Transform};
use super::DeriveError;
use crate::characteristics::derive_along;
use crate::equations::unused_name;
use crate::equations::{Equation, NamedExpr, StateVariable};
use crate::system::System;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Symbol};

/// A momentum.
#[derive(Clone, Debug)]
pub struct Momentum {
    /// `p_x`.
    pub name: String,
    /// It as an expression.
    pub value: Expr,
    /// Its symbol.
    pub symbol: Symbol,
    /// Its rate as a symbol.
    pub rate: Expr,
    /// `∂L/∂v` as a function of (q, v, t).
    pub definition: Expr,
}

/// A direction in the space of (t, q, p).
#[derive(Clone, Debug)]
pub struct PhaseDirection {
    /// The rate of t.
    pub time: Expr,
    /// The rates of q.
    pub coordinates: Vec<Expr>,
    /// The rates of p.
    pub momenta: Vec<Expr>,
}

/// The Legendre transform of a system's Lagrangian.
#[derive(Clone, Debug)]
pub struct Legendre {
    /// The momenta, one for each coordinate.
    pub momenta: Vec<Momentum>,
    /// H(q, p, t), with the velocities as symbols where they are implicit.
    pub hamiltonian: Expr,
    /// `∂H/∂p`.
    pub by_momenta: Vec<Expr>,
    /// `∂H/∂q`.
    pub by_coordinates: Vec<Expr>,
    /// `∂H/∂t`; controls and masses with a law of their own count as time.
    pub by_time: Expr,
    /// Whether the velocities are functions of (q, p, t) in closed form.
    pub is_explicit: bool,
    /// W, row by row.
    mass_matrix: Vec<Expr>,
}

impl Legendre {
    /// Transforms the Lagrangian of a system.
    ///
    /// # Errors
    /// [`DeriveError::Singular`] where `∂²L/∂v∂v` is singular by its form.
    pub fn new(system: &System) -> Result<Legendre, DeriveError> {
        let g = &system.graph;
        let velocities = system.velocity_symbols();
        let definitions = g.gradient(system.lagrangian, &velocities);
        let mass_matrix = g.jacobian(&definitions, &velocities).concat();
        let momenta: Vec<Momentum> = system
            .coordinates
            .iter()
            .zip(&definitions)
            .map(|(c, &definition)| {
                let name = unused_name(system, &format!("p_{}", c.name));
                Momentum {
                    value: g.symbol(&name, 0),
                    symbol: g.intern_symbol(&name, 0),
                    rate: g.symbol(&name, 1),
                    name,
                    definition,
                }
            })
            .collect();
        let mut legendre = Legendre {
            hamiltonian: g.zero(),
            by_momenta: Vec::new(),
            by_coordinates: Vec::new(),
            by_time: g.zero(),
            is_explicit: false,
            mass_matrix,
            momenta,
        };
        match legendre.inverse(system)? {
            Some(inverse) => legendre.close(system, inverse),
            None => legendre.keep_implicit(system)?,
        }
        Ok(legendre)
    }

    /// The velocities as closed functions of the momenta, where they are found.
    fn inverse(&self, system: &System) -> Result<Option<Inverse>, SolveError> {
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let definitions: Vec<Expr> = self.momenta.iter().map(|p| p.definition).collect();
        let momenta: Vec<Expr> = self.momenta.iter().map(|p| p.value).collect();
        let transform = Transform {
            lagrangian: system.lagrangian,
            velocities: &velocities,
            definitions: &definitions,
            hessian: &self.mass_matrix,
            momenta: &momenta,
        };
        transform.closed(system)
    }

    /// H in closed form, and its derivatives by differentiating it.
    fn close(&mut self, system: &System, inverse: Inverse) {
        let g = &system.graph;
        self.is_explicit = true;
        self.hamiltonian = inverse.hamiltonian;
        self.by_momenta = inverse.velocities;
        self.by_coordinates = g.gradient(self.hamiltonian, &system.coordinate_symbols());
        let still = vec![g.zero(); system.n()];
        let masses = system.mass_rates(&self.by_momenta);
        let moved = derive_along(system, &[self.hamiltonian], &still, g.one(), &masses);
        self.by_time = moved[0];
    }

    /// `H = p·v − L` with v tied by the momenta.
    fn keep_implicit(&mut self, system: &System) -> Result<(), DeriveError> {
        let g = &system.graph;
        // A first solution shows that the matrix is nonsingular by form.
        g.solve(&self.mass_matrix, &vec![g.one(); system.n()])?;
        let mut parts = vec![g.neg(system.lagrangian)];
        for (c, p) in system.coordinates.iter().zip(&self.momenta) {
            parts.push(g.mul(&[p.value, c.v]));
        }
        self.hamiltonian = g.add(&parts);
        self.by_momenta = system.coordinates.iter().map(|c| c.v).collect();
        self.by_coordinates = g
            .gradient(system.lagrangian, &system.coordinate_symbols())
            .into_iter()
            .map(|slope| g.neg(slope))
            .collect();
        self.by_time = g.neg(system.time_derivative(system.lagrangian));
        Ok(())
    }

    /// The rates of functions of (q, p, t) along a direction.
    pub fn along(&self, system: &System, es: &[Expr], direction: &PhaseDirection) -> Vec<Expr> {
        let mut rates: Vec<(Symbol, Expr)> = self
            .momenta
            .iter()
            .zip(&direction.momenta)
            .map(|(p, &rate)| (p.symbol, rate))
            .collect();
        if !self.is_explicit {
            let symbols = system.velocity_symbols();
            rates.extend(
                symbols
                    .into_iter()
                    .zip(self.velocity_rates(system, direction)),
            );
        }
        derive_along(system, es, &direction.coordinates, direction.time, &rates)
    }

    /// `v' = W⁻¹ (p' − L_vq q' − L_vt t')`.
    fn velocity_rates(&self, system: &System, direction: &PhaseDirection) -> Vec<Expr> {
        let g = &system.graph;
        let definitions: Vec<Expr> = self.momenta.iter().map(|p| p.definition).collect();
        let (coordinates, time) = (&direction.coordinates, direction.time);
        let right: Vec<Expr> = derive_along(system, &definitions, coordinates, time, &[])
            .into_iter()
            .zip(&direction.momenta)
            .map(|(frozen, &rate)| g.sub(rate, frozen))
            .collect();
        // The matrix is nonsingular by form: `keep_implicit` has solved with it.
        g.solve(&self.mass_matrix, &right).unwrap_or_default()
    }

    /// The direction in which p alone moves.
    pub fn momentum_direction(&self, system: &System, momenta: &[Expr]) -> PhaseDirection {
        let zero = system.graph.zero();
        PhaseDirection {
            time: zero,
            coordinates: vec![zero; system.n()],
            momenta: momenta.to_vec(),
        }
    }

    /// `∂e/∂p_j`: one row per expression, one column per momentum.
    pub fn jacobian(&self, system: &System, es: &[Expr]) -> Vec<Vec<Expr>> {
        let g = &system.graph;
        if self.is_explicit {
            let symbols: Vec<Symbol> = self.momenta.iter().map(|p| p.symbol).collect();
            return g.jacobian(es, &symbols);
        }
        let columns: Vec<Vec<Expr>> = (0..system.n())
            .map(|j| {
                let mut unit = vec![g.zero(); system.n()];
                unit[j] = g.one();
                self.along(system, es, &self.momentum_direction(system, &unit))
            })
            .collect();
        (0..es.len())
            .map(|i| columns.iter().map(|column| column[i]).collect())
            .collect()
    }

    /// Functions of (q, v, t) as functions of (q, p, t), `v = ∂H/∂p`.
    pub fn restrict(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        if !self.is_explicit {
            return es.to_vec();
        }
        let pairs: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&self.by_momenta)
            .map(|(c, &v)| (c.v, v))
            .collect();
        system.graph.substitute_all(es, &pairs)
    }

    /// The state beside q: the momenta with these rates, and the velocities where they are implicit.
    pub fn state(
        &self,
        system: &System,
        velocities: &[Expr],
        rates: &[Expr],
    ) -> Vec<StateVariable> {
        let mut variables: Vec<StateVariable> = self
            .momenta
            .iter()
            .zip(rates)
            .map(|(p, &rate)| StateVariable {
                name: p.name.clone(),
                value: p.value,
                symbol: p.symbol,
                rate,
                definition: Some(p.definition),
            })
            .collect();
        if !self.is_explicit {
            let direction = PhaseDirection {
                time: system.graph.one(),
                coordinates: velocities.to_vec(),
                momenta: rates.to_vec(),
            };
            let rates = self.velocity_rates(system, &direction);
            let implicit = system.coordinates.iter().zip(rates);
            variables.extend(implicit.map(|(c, rate)| StateVariable::of_velocity(c, rate)));
        }
        variables
    }

    /// `p − ∂L/∂v = 0` with the velocities they determine, where these are implicit.
    pub fn relations(&self, system: &System) -> Vec<(Expr, Symbol)> {
        if self.is_explicit {
            return Vec::new();
        }
        let pairs = self.momenta.iter().zip(system.velocity_symbols());
        pairs
            .map(|(p, v)| (system.graph.sub(p.value, p.definition), v))
            .collect()
    }

    /// `p = ∂L/∂v` as equations, where the velocities are implicit.
    pub fn momentum_equations(&self) -> Vec<Equation> {
        let momenta = self.momenta.iter().filter(|_| !self.is_explicit);
        momenta
            .map(|p| Equation {
                label: p.name.clone(),
                left: p.value,
                right: p.definition,
            })
            .collect()
    }

    /// The momenta and H as named objects.
    pub fn objects(&self, system: &System) -> Vec<NamedExpr> {
        let momenta = self.momenta.iter().zip(&system.coordinates).map(|(p, c)| {
            NamedExpr::new(
                p.name.clone(),
                p.definition,
                format!("momentum ∂L/∂{}' as a function of (q, v, t)", c.name),
            )
        });
        let meaning = match self.is_explicit {
            true => "Hamiltonian as a function of (q, p, t)",
            false => "Hamiltonian, with the velocities as implicit functions of (q, p, t)",
        };
        let hamiltonian = NamedExpr::new(unused_name(system, "H"), self.hamiltonian, meaning);
        momenta.chain([hamiltonian]).collect()
    }
}
