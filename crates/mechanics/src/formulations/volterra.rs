//! What both forms of Volterra's equations share, in generalized and in Cartesian coordinates.
//!
//! For characteristics `q^s(m) = φ^s(t, q, …, P)` with `B = ∂φ/∂P` (Volterra 1898; Qiao; T2 §4), with T the kinetic energy
//! and its derivative of order m - 1:
//!
//! - first form `m D ∂T̃/∂P_σ - m Σ_s p_s D B_sσ - Σ_s (∂T/∂q^s(m-1)) B_sσ = Ẽ_σ` (V1q),
//! - second form `m D ∂T̃/∂P_σ - ∂T̃/∂π_σ - Σ_s p_s ( m D B_sσ - ∂q^s(m)/∂π_σ ) = Ẽ_σ` (V2q).
//!
//! In Cartesian coordinates the second form is the same, and the first is `D ∂T̃/∂P_σ - Σ_i μ_i ξ_i' D B_iσ = Ẽ_σ` (V1): the
//! kinetic energy has no slopes there, and (m - 1) times the lemma (2.10) is left out.

use super::{bare, maggi, Basis, DeriveError, Identity};
use crate::characteristics::{Characteristics, Manifold};
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::mass;
use crate::order::determined::in_characteristics;
use crate::order::lifting;
use crate::particles;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// Which of the two forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    First,
    Second,
}

/// T̃, its partial derivatives before the restriction, and the forces, for characteristics of order m.
pub(crate) struct Volterra<'a> {
    system: &'a System,
    characteristics: Characteristics,
    /// m.
    order: i64,
    /// Whether the coordinates are Cartesian.
    cartesian: bool,
    /// T.
    kinetic: Expr,
    /// T̃^(m-1), a function on the jet (t, q, P).
    restricted: Expr,
    /// p_s = ∂T^(m-1)/∂q^s(m) before the restriction, then restricted; length n.
    momenta: Vec<Expr>,
    /// ∂T^(m-1)/∂q^s(m-1) before the restriction, then restricted; length n.
    slopes: Vec<Expr>,
    /// ∂T/∂q^s, restricted; length n.
    kinetic_slopes: Vec<Expr>,
    /// Ẽ_σ, length k.
    forces: Vec<Expr>,
    /// Ψ̃_σ, length k.
    reactive: Vec<Expr>,
    /// What T is.
    meaning: &'static str,
}

impl<'a> Volterra<'a> {
    /// In generalized coordinates: T and the forces Q - ∂V/∂q where the model states T and V apart, else L in the place of
    /// T.
    pub(crate) fn generalized(basis: &Basis<'a>) -> Result<Volterra<'a>, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let characteristics = basis.kinematic_characteristics()?;
        let (kinetic, forces, meaning) = match stated_apart(system) {
            Some((kinetic, potential)) => {
                let slopes = g.gradient(potential, &system.coordinate_symbols());
                let pairs = system.applied_forces().into_iter().zip(slopes);
                let forces = pairs.map(|(force, slope)| g.sub(force, slope)).collect();
                let meaning = "kinetic energy with the velocities of the characteristics";
                (kinetic, forces, meaning)
            }
            None => (
                system.lagrangian,
                system.applied_forces(),
                "Lagrangian, in the place of the kinetic energy, with the velocities of the characteristics",
            ),
        };
        let of = (kinetic, &forces[..], &system.reactive_forces[..]);
        Ok(Volterra::new(system, characteristics, of, meaning))
    }

    fn new(
        system: &'a System,
        characteristics: Characteristics,
        (kinetic, forces, reactive): (Expr, &[Expr], &[Expr]),
        meaning: &'static str,
    ) -> Volterra<'a> {
        let (g, c) = (&system.graph, &characteristics);
        let derivative = lifting::derivative(system, kinetic, c.order - 1);
        let highest: Vec<Symbol> = c.jets.iter().map(|c| c.v_symbol).collect();
        let lower: Vec<Symbol> = c.jets.iter().map(|c| c.q_symbol).collect();
        let mut functions = vec![derivative];
        functions.extend(g.gradient(derivative, &highest));
        functions.extend(g.gradient(derivative, &lower));
        functions.extend(g.gradient(kinetic, &system.coordinate_symbols()));
        functions.extend(forces);
        functions.extend(reactive);
        let n = system.n();
        let mut restricted = c.restrict(system, &functions);
        let reactive = restricted.split_off(1 + 4 * n);
        let forces = restricted.split_off(1 + 3 * n);
        let kinetic_slopes = restricted.split_off(1 + 2 * n);
        let slopes = restricted.split_off(1 + n);
        let momenta = restricted.split_off(1);
        Volterra {
            system,
            order: i64::from(c.order),
            cartesian: false,
            kinetic,
            restricted: restricted[0],
            momenta,
            slopes,
            kinetic_slopes,
            forces: c.contract(system, &forces),
            reactive: c.contract(system, &reactive),
            characteristics,
            meaning,
        }
    }

    /// In Cartesian coordinates, where the positions of the particles are the coordinates: `T = ½ Σ μ_i ξ_i'²`, the momenta
    /// are `μ_i ξ_i'`, and T does not depend on the coordinates (V1), (V2).
    pub(crate) fn cartesian(basis: &Basis<'a>) -> Result<Volterra<'a>, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let masses = particles::coordinate_masses(system).ok_or(DeriveError::NotStated(
            "particles whose positions are the coordinates",
        ))?;
        let squares = masses.iter().zip(&system.coordinates);
        let doubled: Vec<Expr> = squares.map(|(&mass, c)| g.mul(&[mass, c.v, c.v])).collect();
        let kinetic = g.div(g.add(&doubled), g.integer(2));
        let forces: Vec<Expr> = particles::applied_forces(system)
            .into_iter()
            .zip(particles::further_forces(system))
            .map(|(applied, further)| g.add(&[applied, further]))
            .collect();
        let reactive = mass::reactive_forces(system);
        let meaning = "kinetic energy of the particles with the velocities of the characteristics";
        let of = (kinetic, &forces[..], &reactive[..]);
        Ok(Volterra {
            cartesian: true,
            ..Volterra::new(system, basis.kinematic_characteristics()?, of, meaning)
        })
    }

    /// The left sides of one of the forms, σ = 1..k, on the jet (t, q, P, P').
    pub(crate) fn left_sides(&self, form: Form) -> Vec<Expr> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let m = g.integer(self.factor(form));
        let (rates, turned) = (self.momentum_rates(), self.turned(form));
        let slopes = match form {
            Form::First if self.cartesian => vec![g.zero(); c.k()],
            Form::First => c.contract(system, &self.slopes),
            Form::Second => c.by_quasi_coordinates(system, &[self.restricted]).concat(),
        };
        (0..c.k())
            .map(|sigma| {
                let rate = g.mul(&[m, rates[sigma]]);
                g.add(&[rate, g.neg(turned[sigma]), g.neg(slopes[sigma])])
            })
            .collect()
    }

    /// `D ∂T̃/∂P_σ`, length k.
    fn momentum_rates(&self) -> Vec<Expr> {
        let (system, c) = (self.system, &self.characteristics);
        let momenta = c.by_parameters(system, &[self.restricted]).concat();
        c.total_derivative(system, &momenta)
    }

    /// `Σ_s p_s m D B_sσ`, in the second form minus `Σ_s p_s ∂q^s(m)/∂π_σ`; length k.
    fn turned(&self, form: Form) -> Vec<Expr> {
        let g = &self.system.graph;
        let turning = self.turning(form);
        let summand = |(&p, row): (&Expr, &Vec<Expr>), sigma: usize| g.mul(&[p, row[sigma]]);
        let rows = || self.momenta.iter().zip(&turning);
        (0..self.characteristics.k())
            .map(|sigma| g.add(&rows().map(|row| summand(row, sigma)).collect::<Vec<_>>()))
            .collect()
    }

    /// The terms of the equations that are no forces and no slopes.
    fn terms(&self, form: Form) -> Vec<NamedExpr> {
        let parameters = &self.characteristics.parameters;
        let turned = match form {
            Form::First => "Σ p DB, the momenta times the rates of the basis",
            Form::Second => "Σ p (DB − ∂v/∂π), the momenta times what the basis turns",
        };
        let named = |name: &str, meaning: &str, values: Vec<Expr>| -> Vec<NamedExpr> {
            let pairs = parameters.iter().zip(values);
            pairs
                .filter(|(_, value)| !self.system.graph.is_zero(*value))
                .map(|(p, value)| {
                    let name = format!("{name}_{}", bare(&p.name));
                    NamedExpr::new(name, value, format!("{meaning}, along {}", p.name))
                })
                .collect()
        };
        let mut terms = named(
            "DTtilde",
            "D(∂T̃/∂P), the rate of the momentum after the restriction",
            self.momentum_rates(),
        );
        terms.extend(named("pDB", turned, self.turned(form)));
        terms
    }

    /// m, and 1 in the first form in Cartesian coordinates.
    fn factor(&self, form: Form) -> i64 {
        match form {
            Form::First if self.cartesian => 1,
            _ => self.order,
        }
    }

    /// `m D B_sσ`, in the second form minus `∂q^s(m)/∂π_σ`; n × k.
    fn turning(&self, form: Form) -> Vec<Vec<Expr>> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let m = g.integer(self.factor(form));
        let rates = c.total_derivative(system, &c.basis.concat());
        let mut rows: Vec<Vec<Expr>> = rates
            .chunks(c.k().max(1))
            .map(|row| row.iter().map(|&rate| g.mul(&[m, rate])).collect())
            .collect();
        if form == Form::Second {
            let slopes = c.by_quasi_coordinates(system, &c.velocities);
            for (row, slopes) in rows.iter_mut().zip(&slopes) {
                for (entry, &slope) in row.iter_mut().zip(slopes) {
                    *entry = g.sub(*entry, slope);
                }
            }
        }
        rows
    }

    pub(crate) fn equations(
        &self,
        (name, [first_order, higher_order], form): (&'static str, [Schema; 2], Form),
        basis: &Basis<'_>,
    ) -> Result<Equations, DeriveError> {
        let c = &self.characteristics;
        let schema = match c.order {
            1 => first_order,
            _ => higher_order,
        };
        let motion: Vec<Equation> = self
            .left_sides(form)
            .into_iter()
            .zip(self.right_sides())
            .zip(&c.parameters)
            .map(|((left, right), p)| Equation {
                label: p.name.clone(),
                left,
                right,
            })
            .collect();
        Ok(in_characteristics(name, basis, c, &motion)?
            .with_group("equations of motion", Some(schema), motion)
            .with_group("kinematics", None, basis.kinematics(c))
            .with_objects(self.objects(form)))
    }

    /// Ẽ_σ + Ψ̃_σ.
    fn right_sides(&self) -> Vec<Expr> {
        let g = &self.system.graph;
        let pairs = self.forces.iter().zip(&self.reactive);
        pairs
            .map(|(&force, &reactive)| g.add(&[force, reactive]))
            .collect()
    }

    fn objects(&self, form: Form) -> Vec<NamedExpr> {
        let (system, c) = (self.system, &self.characteristics);
        let mut objects = vec![NamedExpr::new("Ttilde", self.restricted, self.meaning)];
        for (coordinate, &p) in system.coordinates.iter().zip(&self.momenta) {
            let meaning = format!("momentum of {} before the restriction", coordinate.name);
            objects.push(NamedExpr::new(format!("p_{}", coordinate.name), p, meaning));
        }
        for (name, word, values) in [
            ("Etilde", "force", &self.forces),
            ("Psitilde", "reactive force", &self.reactive),
        ] {
            for (p, &value) in c.parameters.iter().zip(values) {
                if !system.graph.is_zero(value) {
                    let meaning = format!("{word} along {}", p.name);
                    let name = format!("{name}_{}", bare(&p.name));
                    objects.push(NamedExpr::new(name, value, meaning));
                }
            }
        }
        objects.extend(maggi::virtual_basis(system, c));
        objects.extend(self.terms(form));
        if form == Form::Second {
            objects.extend(self.slopes_by_quasi_coordinates());
        }
        objects
    }

    /// `∂T̃/∂π_σ` and those of `∂q^s(m)/∂π_σ` that do not vanish.
    fn slopes_by_quasi_coordinates(&self) -> Vec<NamedExpr> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let mut objects = quasi_slopes(system, c, ("Ttilde", "T̃"), self.restricted);
        let rows = c.by_quasi_coordinates(system, &c.velocities);
        for (i, (coordinate, row)) in system.coordinates.iter().zip(&rows).enumerate() {
            for (p, &slope) in c.parameters.iter().zip(row).filter(|(_, &e)| !g.is_zero(e)) {
                let (s, sigma) = (&coordinate.name, bare(&p.name));
                let highest = g.symbol_text(c.jets[i].v_symbol);
                let meaning = format!("∂{highest}/∂π of {}, with the parameters fixed", p.name);
                let letter = if self.order == 1 { "v" } else { "phi" };
                objects.push(NamedExpr::new(
                    format!("{letter}_{s}_pi_{sigma}"),
                    slope,
                    meaning,
                ));
            }
        }
        objects
    }

    /// The form minus Maggi's equations, and the lemma on which the form rests, on the jet (t, q, P, P').
    pub(crate) fn identities(&self, form: Form) -> Vec<Identity> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let maggi = maggi::left_sides(system, c);
        let residuals = self
            .left_sides(form)
            .into_iter()
            .zip(self.right_sides())
            .zip(maggi)
            .map(|((left, force), maggi)| g.add(&[left, g.neg(force), g.neg(maggi)]))
            .collect();
        let (lemma, statement) = match form {
            Form::First => (
                self.momentum_lemma(),
                "∂T̃/∂P_σ = Σ_s p_s B_sσ (lemma of the first form)",
            ),
            Form::Second => (
                self.slope_lemma(),
                "∂T̃/∂π_σ = Σ_s p_s ∂q'^s/∂π_σ + (m − 1)( D ∂T̃/∂P_σ − Σ_s p_s D B_sσ ) + Σ_s ∂T/∂q^s B_sσ (lemma between the forms)",
            ),
        };
        let identity = |statement: &str, residuals| Identity {
            statement: statement.into(),
            residuals,
            manifold: c.manifold.clone(),
            on: "on the jet (t, q, P, P')",
        };
        vec![
            identity("Volterra's left sides minus forces are Maggi's", residuals),
            identity(statement, lemma),
        ]
    }

    /// The lemmas on which the forms rest, by their numbers in the source, and for m = 1 the special cases, in which the two
    /// forms are the same equations.
    pub(crate) fn special_identities(&self, form: Form) -> Vec<Identity> {
        let (g, c) = (&self.system.graph, &self.characteristics);
        let on_jet = |statement: &str, residuals| Identity {
            statement: statement.into(),
            residuals,
            manifold: c.manifold.clone(),
            on: "on the jet (t, q, …, P, P')",
        };
        let lemma = match (form, self.cartesian) {
            (Form::First, true) => on_jet(
                "Σ D(μ_i ξ_i') B_iσ = D ∂T/∂P_σ − Σ μ_i ξ_i' D B_iσ (2.10)",
                self.rate_lemma(),
            ),
            (Form::First, false) => on_jet(
                "Σ_s (D p_s − ∂T/∂q^s) B_sσ = m D ∂T̃/∂P_σ − m Σ_s p_s D B_sσ − Σ_s ∂T^(m−1)/∂q^s(m−1) B_sσ (3.16)",
                self.rate_lemma(),
            ),
            (Form::Second, true) => on_jet(
                "∂T/∂π_σ = Σ μ_i ξ_i' ∂ξ_i^(m)/∂π_σ + (m − 1)( D ∂T/∂P_σ − Σ μ_i ξ_i' D B_iσ ) (2.18)",
                self.slope_lemma(),
            ),
            (Form::Second, false) => on_jet(
                "∂T̃/∂π_σ = Σ_s p_s ∂q^s(m)/∂π_σ + (m − 1)( D ∂T̃/∂P_σ − Σ_s p_s D B_sσ ) + Σ_s ∂T/∂q^s B_sσ (3.26)",
                self.slope_lemma(),
            ),
        };
        let derivative = Identity {
            statement: "∂T^(m−1)/∂q^s(m) = p_s and ∂T^(m−1)/∂q^s(m−1) = (m − 1) D p_s + ∂T/∂q^s"
                .into(),
            residuals: self.derivative_lemma(),
            manifold: Manifold::default(),
            on: "identically in all derivatives",
        };
        let mut identities = vec![derivative, lemma];
        if self.order == 1 {
            let first = self.left_sides(Form::First);
            let second = self.left_sides(Form::Second);
            let pairs = first.into_iter().zip(second);
            identities.push(on_jet(
                match self.cartesian {
                    true => "for m = 1 the forms (2.13) and (2.20) are the same",
                    false => "for m = 1 the forms (3.19) and (3.28) are the same",
                },
                pairs.map(|(a, b)| g.sub(a, b)).collect(),
            ));
        }
        identities
    }

    /// `Σ_s (D p_s - ∂T/∂q^s) B_sσ` minus the left sides of the first form.
    fn rate_lemma(&self) -> Vec<Expr> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let momenta = g.gradient(self.kinetic, &system.velocity_symbols());
        let slopes = g.gradient(self.kinetic, &system.coordinate_symbols());
        let lagrange: Vec<Expr> = momenta
            .iter()
            .zip(&slopes)
            .map(|(&p, &slope)| g.sub(system.total_derivative(p), slope))
            .collect();
        let left = c.contract(system, &c.on_jet(system, &lagrange));
        let right = self.left_sides(Form::First);
        let pairs = left.into_iter().zip(right);
        pairs.map(|(a, b)| g.sub(a, b)).collect()
    }

    /// `∂T^(m-1)/∂q^s(m) - p_s` and `∂T^(m-1)/∂q^s(m-1) - (m - 1) D p_s - ∂T/∂q^s`, before the restriction.
    fn derivative_lemma(&self) -> Vec<Expr> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let highest: Vec<Symbol> = c.jets.iter().map(|c| c.v_symbol).collect();
        let lower: Vec<Symbol> = c.jets.iter().map(|c| c.q_symbol).collect();
        let derivative = lifting::derivative(system, self.kinetic, c.order - 1);
        let momenta = g.gradient(self.kinetic, &system.velocity_symbols());
        let slopes = g.gradient(self.kinetic, &system.coordinate_symbols());
        let more = g.integer(1 - self.order);
        let by_highest = g.gradient(derivative, &highest).into_iter().zip(&momenta);
        let mut residuals: Vec<Expr> = by_highest.map(|(a, &p)| g.sub(a, p)).collect();
        let by_lower = g.gradient(derivative, &lower).into_iter();
        for ((slope, &p), own) in by_lower.zip(&momenta).zip(slopes) {
            let rate = g.mul(&[more, system.total_derivative(p)]);
            residuals.push(g.add(&[slope, rate, g.neg(own)]));
        }
        residuals
    }

    /// `∂T̃/∂P_σ - Σ_s p_s B_sσ`.
    fn momentum_lemma(&self) -> Vec<Expr> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let left = c.by_parameters(system, &[self.restricted]).concat();
        let right = c.contract(system, &self.momenta);
        left.into_iter()
            .zip(right)
            .map(|(a, b)| g.sub(a, b))
            .collect()
    }

    /// `∂T̃/∂π_σ - Σ_s p_s ∂φ^s/∂π_σ - (m - 1)( D ∂T̃/∂P_σ - Σ_s p_s D B_sσ ) - Σ_s ∂T/∂q^s B_sσ`.
    fn slope_lemma(&self) -> Vec<Expr> {
        let (system, g, c) = (self.system, &self.system.graph, &self.characteristics);
        let left = c.by_quasi_coordinates(system, &[self.restricted]).concat();
        let slopes = c.contract(system, &self.kinetic_slopes);
        let inner = c.by_quasi_coordinates(system, &c.velocities);
        let momenta = c.by_parameters(system, &[self.restricted]).concat();
        let momentum_rates = c.total_derivative(system, &momenta);
        let rates = c.total_derivative(system, &c.basis.concat());
        let more = g.integer(1 - self.order);
        (0..c.k())
            .map(|s| {
                let mut parts = vec![left[s], g.neg(slopes[s]), g.mul(&[more, momentum_rates[s]])];
                for (i, &p) in self.momenta.iter().enumerate() {
                    parts.push(g.neg(g.mul(&[p, inner[i][s]])));
                    parts.push(g.neg(g.mul(&[more, p, rates[i * c.k() + s]])));
                }
                g.add(&parts)
            })
            .collect()
    }
}

/// `∂F/∂π_σ` with the parameters fixed, σ = 1..k, of a function F on the jet (t, q, P) with a name for the program and one
/// for readers.
pub(crate) fn quasi_slopes(
    system: &System,
    c: &Characteristics,
    (name, written): (&str, &str),
    function: Expr,
) -> Vec<NamedExpr> {
    let slopes = c.by_quasi_coordinates(system, &[function]).concat();
    let named = c.parameters.iter().zip(slopes);
    named
        .map(|(p, slope)| {
            let meaning = format!("∂{written}/∂π of {}, with the parameters fixed", p.name);
            NamedExpr::new(format!("{name}_pi_{}", bare(&p.name)), slope, meaning)
        })
        .collect()
}

/// `-∂V/∂qⁱ` where T and V are stated apart, else zeros: what gravity and springs do, as forces.
pub(crate) fn potential_forces(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    match stated_apart(system) {
        Some((_, potential)) => {
            let slopes = g.gradient(potential, &system.coordinate_symbols());
            slopes.into_iter().map(|slope| g.neg(slope)).collect()
        }
        None => vec![g.zero(); system.n()],
    }
}

/// T and V where `L = T - V` with V free of velocities.
pub(crate) fn stated_apart(system: &System) -> Option<(Expr, Expr)> {
    let g = &system.graph;
    let kinetic = system.kinetic?;
    let potential = system.potential.unwrap_or_else(|| g.zero());
    let free = !g.contains_any(potential, &system.velocity_symbols());
    (free && g.sub(kinetic, potential) == system.lagrangian).then_some((kinetic, potential))
}
