//! Canonical equations on the constraint manifold.
//!
//! `p̃_s = ∂L̄/∂v^s`, `H̃(q, p̃, t) = Σ p̃_s v^s − L̄` for the restricted Lagrangian L̄, and (T1 (44)–(46))
//! `q'^s = ∂H̃/∂p̃_s`, `q'^{k+l} = φ^l`,
//! `p̃'_s = −∂H̃/∂q^s − Σ_l φ^l_s ∂H̃/∂q^{k+l} + Σ_l θ_l A^l_s + Q_s + Σ_l Q_{k+l} φ^l_s`,
//! with `θ_l = ∂L/∂v^{k+l}` of the full L. It needs that `∂²L̄/∂v∂v` is regular, which is not the restricted Hessian `Bᵀ W B`;
//! where it is not by the usual independent velocities, but is by others, those are taken.
//! For φ nonlinear in the velocities A contains v', hence p̃': the equations are linear in v' and are solved for it.

use super::canonical::IMPLICIT;
use super::inversion::Transform;
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::{derive_along, Characteristics};
use crate::equations::unused_name;
use crate::equations::{Equation, Equations, NamedExpr, Schema, StateVariable};
use crate::linear::solve_linear;
use crate::radicals::split_roots;
use crate::restricted::regular_choice;
use crate::sample::radicands;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// Canonical equations on the constraint manifold.
#[derive(Clone, Copy, Debug)]
pub struct CanonicalReduced;

static CARD: Card = Card {
    name: "canonical-reduced",
    title: "Canonical equations on the constraint manifold",
    statement: "Hamilton's equations for the momenta of the restricted Lagrangian, with the curvature of the constraints and the momenta of the dependent velocities on the right.",
    principle: Principle::Hamilton,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.restricted-hessian-regular", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "rates of the k momenta of the independent velocities",
    highest_order: 1,
    sources: &[
        Source { key: "rumyantsev1982", place: "canonical equations without multipliers; T1 (44)–(46)" },
        Source { key: "bates1993", place: "the bracket of linear constraints; T1 (47)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "q'^s = ∂H̃/∂p̃_s, q'^{k+l} = φ^l, p̃'_s = −∂H̃/∂q^s − Σ_l φ^l_s ∂H̃/∂q^{k+l} + Σ_l θ_l A^l_s + Q_s + Σ_l Q_{k+l} φ^l_s",
    latex: r"\dot q^s = \frac{\partial \tilde H}{\partial \tilde p_s}, \quad \dot q^{k+l} = \varphi^l, \quad \dot{\tilde p}_s = -\frac{\partial \tilde H}{\partial q^s} - \sum_l \varphi^l_s \frac{\partial \tilde H}{\partial q^{k+l}} + \sum_l \theta_l A^l_s + Q_s + \sum_l Q_{k+l} \varphi^l_s",
};

impl Formulation for CanonicalReduced {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let reduced = Reduced::new(basis)?;
        match ReducedLegendre::new(basis.system, &reduced)? {
            Some(legendre) => explicit_equations(basis, &reduced, &legendre),
            None => implicit_equations(basis, &reduced),
        }
    }
}

/// What the equations are built from, as functions of (q, v^s, t) on the constraint manifold.
struct Reduced {
    characteristics: Characteristics,
    /// L̄.
    lagrangian: Expr,
    /// Names of p̃.
    names: Vec<String>,
    /// Symbols of p̃ as expressions.
    momenta: Vec<Expr>,
    /// `∂L̄/∂v^s`.
    definitions: Vec<Expr>,
    /// `∂²L̄/∂v∂v`, row by row.
    hessian: Vec<Expr>,
    /// θ_l, one for each dependent velocity.
    theta: Vec<Expr>,
    /// `A^l_s` with the rates v' as symbols, one row for each dependent velocity.
    curvature: Vec<Vec<Expr>>,
    /// `Q_s + Σ_l Q_{k+l} φ^l_s`.
    forces: Vec<Expr>,
}

impl Reduced {
    fn new(basis: &Basis<'_>) -> Result<Reduced, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let characteristics = regular_choice(system, basis.terms, basis.selection)?.characteristics;
        let lagrangian = characteristics.restrict(system, &[system.lagrangian])[0];
        let definitions = characteristics
            .by_parameters(system, &[lagrangian])
            .concat();
        let hessian = characteristics.by_parameters(system, &definitions).concat();
        let slopes = g.gradient(system.lagrangian, &system.velocity_symbols());
        let full: Vec<Expr> = characteristics
            .dependent
            .iter()
            .map(|&d| slopes[d])
            .collect();
        let names: Vec<String> = characteristics
            .independent
            .iter()
            .map(|&s| unused_name(system, &format!("ptilde_{}", system.coordinates[s].name)))
            .collect();
        let forces = characteristics.restrict(system, &system.forces);
        Ok(Reduced {
            lagrangian,
            momenta: names.iter().map(|name| g.symbol(name, 0)).collect(),
            names,
            definitions,
            hessian,
            theta: characteristics.restrict(system, &full),
            curvature: curvature(system, &characteristics),
            forces: characteristics.contract(system, &forces),
            characteristics,
        })
    }

    /// `Σ_l θ_l A^l_s`.
    fn gyroscopic(&self, system: &System) -> Vec<Expr> {
        let g = &system.graph;
        (0..self.characteristics.k())
            .map(|s| {
                let terms = self.theta.iter().zip(&self.curvature);
                let parts: Vec<Expr> = terms.map(|(&theta, row)| g.mul(&[theta, row[s]])).collect();
                g.add(&parts)
            })
            .collect()
    }

    /// θ, A and, where φ is linear and homogeneous, R, with the velocities replaced by `restrict`.
    fn objects(&self, system: &System, restrict: impl Fn(&[Expr]) -> Vec<Expr>) -> Vec<NamedExpr> {
        let g = &system.graph;
        let coordinate = |i: usize| system.coordinates[i].name.as_str();
        let mut objects = Vec::new();
        let theta = restrict(&self.theta);
        for (l, &d) in self.characteristics.dependent.iter().enumerate() {
            let dependent = coordinate(d);
            objects.push(NamedExpr::new(
                unused_name(system, &format!("theta_{dependent}")),
                theta[l],
                format!("∂L/∂{dependent}' on the constraints"),
            ));
            let row = restrict(&self.curvature[l]);
            for (&s, value) in self.characteristics.independent.iter().zip(row) {
                if !g.is_zero(value) {
                    let independent = coordinate(s);
                    let name = unused_name(system, &format!("A_{dependent}_{independent}"));
                    let meaning = "curvature coefficient of the constraints";
                    let object = NamedExpr::new(name, value, meaning);
                    objects.push(object.with_indices("A", &[dependent], &[independent]));
                }
            }
        }
        objects
    }

    /// The definitions of the momenta as objects.
    fn definition_objects(&self) -> Vec<NamedExpr> {
        let names = self.names.iter().zip(&self.definitions);
        names
            .map(|(name, &value)| {
                let meaning = "momentum of the restricted Lagrangian";
                NamedExpr::new(name.clone(), value, meaning)
            })
            .collect()
    }

    fn momentum_variables(&self, system: &System, rates: &[Expr]) -> Vec<StateVariable> {
        let names = self.names.iter().zip(&self.definitions).zip(rates);
        names
            .map(|((name, &definition), &rate)| StateVariable {
                name: name.clone(),
                value: system.graph.symbol(name, 0),
                symbol: system.graph.intern_symbol(name, 0),
                rate,
                definition: Some(definition),
            })
            .collect()
    }
}

/// `A^l_s = D(∂φ^l/∂v^s) − ∂φ^l/∂q^s − Σ_m ∂φ^l/∂q^{k+m} ∂φ^m/∂v^s` (T1 (7)) on the jet (q, v, v', t).
fn curvature(system: &System, characteristics: &Characteristics) -> Vec<Vec<Expr>> {
    let g = &system.graph;
    let k = characteristics.k();
    let dependent = &characteristics.dependent;
    let solved: Vec<Expr> = dependent
        .iter()
        .map(|&d| characteristics.velocities[d])
        .collect();
    let slopes: Vec<Expr> = dependent
        .iter()
        .flat_map(|&d| characteristics.basis[d].clone())
        .collect();
    let moved = characteristics.total_derivative(system, &slopes);
    characteristics
        .by_quasi_coordinates(system, &solved)
        .into_iter()
        .enumerate()
        .map(|(l, row)| {
            let entries = row.into_iter().enumerate();
            entries
                .map(|(s, frozen)| g.sub(moved[l * k + s], frozen))
                .collect()
        })
        .collect()
}

/// The transform in closed form.
struct ReducedLegendre {
    /// H̃(q, p̃, t).
    hamiltonian: Expr,
    /// Pairs (v^s, ∂H̃/∂p̃_s).
    velocities: Vec<(Expr, Expr)>,
    /// `∂H̃/∂q^i`, all i.
    by_coordinates: Vec<Expr>,
    /// The radicands of φ and L*, as functions of (q, v^s, t).
    radicands: Vec<Expr>,
}

impl ReducedLegendre {
    /// `None` where the velocities have to stay symbols.
    fn new(system: &System, reduced: &Reduced) -> Result<Option<ReducedLegendre>, DeriveError> {
        let g = &system.graph;
        let ch = &reduced.characteristics;
        if ch.implicit().next().is_some() {
            return Ok(None);
        }
        let parameters: Vec<Expr> = ch.parameters.iter().map(|p| p.value).collect();
        let transform = Transform {
            lagrangian: reduced.lagrangian,
            velocities: &parameters,
            definitions: &reduced.definitions,
            hessian: &reduced.hessian,
            momenta: &reduced.momenta,
        };
        Ok(transform.closed(system)?.map(|inverse| ReducedLegendre {
            by_coordinates: g.gradient(inverse.hamiltonian, &system.coordinate_symbols()),
            velocities: parameters.into_iter().zip(inverse.velocities).collect(),
            hamiltonian: inverse.hamiltonian,
            radicands: radicands(g, &[&ch.velocities[..], &[reduced.lagrangian]].concat()),
        }))
    }

    fn restrict(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        self.substituted(system, es, &self.velocities)
    }

    /// The expressions with roots of φ and L* split, so that those which depend on each other meet; not where H̃ has no others,
    /// and no roots of the forces, which meet those of the model as they are.
    fn substituted(&self, system: &System, es: &[Expr], pairs: &[(Expr, Expr)]) -> Vec<Expr> {
        let g = &system.graph;
        let known = radicands(g, &[self.hamiltonian]);
        let is_known = |e: Expr| radicands(g, &[e]).iter().all(|root| known.contains(root));
        let meets = |e: Expr| {
            let mut roots = radicands(g, &[e]).into_iter();
            roots.any(|root| self.radicands.contains(&root))
        };
        let after = g.substitute_all(es, pairs);
        es.iter()
            .zip(after)
            .map(|(&before, after)| match meets(before) && !is_known(after) {
                true => split_roots(system, &[after])[0],
                false => after,
            })
            .collect()
    }

    /// Pairs of v'^s and `D(∂H̃/∂p̃_s)`, with the rates of the momenta as symbols.
    fn rates(&self, system: &System, reduced: &Reduced) -> Vec<(Expr, Expr)> {
        let g = &system.graph;
        let parameters = &reduced.characteristics.parameters;
        let momenta = reduced.momenta.iter().zip(&reduced.names);
        let rates: Vec<(Symbol, Expr)> = momenta
            .filter_map(|(&p, name)| Some((g.as_symbol(p)?, g.symbol(name, 1))))
            .collect();
        let velocities = self.restrict(system, &reduced.characteristics.velocities);
        let closed: Vec<Expr> = self.velocities.iter().map(|(_, v)| *v).collect();
        let moved = derive_along(system, &closed, &velocities, g.one(), &rates);
        parameters.iter().map(|p| p.rate).zip(moved).collect()
    }

    /// Functions on the jet (q, v, v', t) as functions of (q, p̃, p̃', t).
    fn restrict_jet(&self, system: &System, reduced: &Reduced, es: &[Expr]) -> Vec<Expr> {
        let mut pairs = self.velocities.clone();
        pairs.extend(self.rates(system, reduced));
        self.substituted(system, es, &pairs)
    }
}

/// (46) with H̃ in closed form. A contains p̃' where φ is nonlinear: the equations are linear in it and are solved for it.
fn explicit_equations(
    basis: &Basis<'_>,
    reduced: &Reduced,
    legendre: &ReducedLegendre,
) -> Result<Equations, DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let ch = &reduced.characteristics;
    let velocities = legendre.restrict(system, &ch.velocities);
    let slopes = legendre.restrict(system, &ch.contract(system, &legendre.by_coordinates));
    let gyroscopic = legendre.restrict_jet(system, reduced, &reduced.gyroscopic(system));
    let forces = legendre.restrict(system, &reduced.forces);
    let rights: Vec<Expr> = slopes
        .into_iter()
        .zip(gyroscopic)
        .zip(forces)
        .map(|((slope, gyroscopic), force)| g.add(&[g.neg(slope), gyroscopic, force]))
        .collect();
    let rates = solved_for_rates(system, reduced, rights)?;
    let mut stated: Vec<Equation> = system
        .coordinates
        .iter()
        .zip(&velocities)
        .map(|(c, &right)| Equation {
            label: c.name.clone(),
            left: c.v,
            right,
        })
        .collect();
    stated.extend(momentum_equations(system, reduced, &rates));
    let variables = reduced.momentum_variables(system, &rates);
    let mut equations = Equations::in_state(CARD.name, system, variables, velocities)
        .with_group("equations of motion", Some(SCHEMA), stated)
        .with_objects([NamedExpr::new(
            unused_name(system, "Htilde"),
            legendre.hamiltonian,
            "Hamiltonian of the restricted Lagrangian",
        )])
        .with_objects(reduced.definition_objects())
        .with_objects(reduced.objects(system, |es| legendre.restrict_jet(system, reduced, es)));
    if let Some(curvature) = linear_curvature(system, ch) {
        equations = equations.with_objects(curvature_objects(system, ch, &curvature));
    }
    equations.is_chart = true;
    Ok(equations)
}

/// p̃' from `p̃' = right(q, p̃, p̃', t)`, linear in it.
fn solved_for_rates(
    system: &System,
    reduced: &Reduced,
    rights: Vec<Expr>,
) -> Result<Vec<Expr>, DeriveError> {
    let g = &system.graph;
    let names = reduced.names.iter();
    let symbols: Vec<Symbol> = names.map(|name| g.intern_symbol(name, 1)).collect();
    if !g.any_contains_any(&rights, &symbols) {
        return Ok(rights);
    }
    let residuals: Vec<Expr> = symbols
        .iter()
        .zip(rights)
        .map(|(&rate, right)| g.sub(g.symbol_expr(rate), right))
        .collect();
    Ok(solve_linear(g, &residuals, &symbols)?)
}

fn momentum_equations(system: &System, reduced: &Reduced, rights: &[Expr]) -> Vec<Equation> {
    let names = reduced.names.iter().zip(rights);
    names
        .map(|(name, &right)| Equation {
            label: name.clone(),
            left: system.graph.symbol(name, 1),
            right,
        })
        .collect()
}

/// (46) with velocities tied by `p̃ = ∂L̄/∂v`; `∂H̃/∂q = −∂L̄/∂q` on the constraint manifold.
///
/// With `p̃' = ∂²L̄/∂v∂v v' + …` and `A = A₀ + A₁ v'` the equations give v'; the matrix is `Bᵀ W B`.
fn implicit_equations(basis: &Basis<'_>, reduced: &Reduced) -> Result<Equations, DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let ch = &reduced.characteristics;
    let slopes = ch
        .by_quasi_coordinates(system, &[reduced.lagrangian])
        .concat();
    let right: Vec<Expr> = slopes
        .into_iter()
        .zip(reduced.gyroscopic(system))
        .zip(&reduced.forces)
        .map(|((slope, gyroscopic), &force)| g.add(&[slope, gyroscopic, force]))
        .collect();
    let symbols: Vec<Symbol> = ch.parameters.iter().map(|p| p.rate_symbol).collect();
    let by_rates = g.jacobian(&right, &symbols).concat();
    let matrix: Vec<Expr> = reduced
        .hessian
        .iter()
        .zip(by_rates)
        .map(|(&h, a)| g.sub(h, a))
        .collect();
    let at_zero: Vec<(Expr, Expr)> = ch.parameters.iter().map(|p| (p.rate, g.zero())).collect();
    let drift = ch.frozen_derivative(system, &reduced.definitions);
    let load: Vec<Expr> = g
        .substitute_all(&right, &at_zero)
        .into_iter()
        .zip(drift)
        .map(|(e, drift)| g.sub(e, drift))
        .collect();
    let known: Vec<(Expr, Expr)> = ch
        .parameters
        .iter()
        .map(|p| p.rate)
        .zip(g.solve(&matrix, &load)?)
        .collect();
    let rates = g.substitute_all(&right, &known);
    let motion: Vec<Expr> = known.iter().map(|(_, rate)| *rate).collect();
    Ok(implicit_state(basis, reduced, &motion, &rates)
        .with_group(
            "equations of motion",
            Some(SCHEMA),
            momentum_equations(system, reduced, &right),
        )
        .with_group(IMPLICIT, None, definition_equations(system, reduced))
        .with_group("constraints", None, basis.constraint_equations())
        .with_objects([implicit_hamiltonian(system, reduced)])
        .with_objects(reduced.definition_objects())
        .with_objects(reduced.objects(system, |es| es.to_vec())))
}

/// The state (p̃, v^s, implicit dependent velocities).
fn implicit_state(
    basis: &Basis<'_>,
    reduced: &Reduced,
    motion: &[Expr],
    rates: &[Expr],
) -> Equations {
    let system = basis.system;
    let ch = &reduced.characteristics;
    let mut equations = Equations::in_characteristics(CARD.name, system, ch, motion);
    let mut variables = reduced.momentum_variables(system, rates);
    variables.append(&mut equations.variables);
    equations.variables = variables;
    let momenta = reduced.momenta.iter().zip(&reduced.definitions);
    let relations = momenta
        .zip(&ch.parameters)
        .map(|((&p, &definition), v)| (system.graph.sub(p, definition), v.symbol));
    equations.relations.extend(relations);
    equations.is_chart = true;
    equations
}

fn definition_equations(system: &System, reduced: &Reduced) -> Vec<Equation> {
    let names = reduced.names.iter().zip(&reduced.definitions);
    names
        .map(|(name, &right)| Equation {
            label: name.clone(),
            left: system.graph.symbol(name, 0),
            right,
        })
        .collect()
}

fn implicit_hamiltonian(system: &System, reduced: &Reduced) -> NamedExpr {
    let g = &system.graph;
    let mut parts = vec![g.neg(reduced.lagrangian)];
    for (&p, v) in reduced
        .momenta
        .iter()
        .zip(&reduced.characteristics.parameters)
    {
        parts.push(g.mul(&[p, v.value]));
    }
    let name = unused_name(system, "Htilde");
    NamedExpr::new(
        name,
        g.add(&parts),
        "Hamiltonian of the restricted Lagrangian, with the velocities as implicit functions of (q, p̃, t)",
    )
}

/// `R^l_su = Y_u a^l_s − Y_s a^l_u` for `φ^l = a^l_s(q) v^s`; `None` where φ is not of this form. Indices l, s, u.
fn linear_curvature(
    system: &System,
    characteristics: &Characteristics,
) -> Option<Vec<Vec<Vec<Expr>>>> {
    let g = &system.graph;
    let ch = characteristics;
    let parameters: Vec<Symbol> = ch.parameters.iter().map(|p| p.symbol).collect();
    let slopes: Vec<Expr> = ch
        .dependent
        .iter()
        .flat_map(|&d| ch.basis[d].clone())
        .collect();
    let at_rest: Vec<(Expr, Expr)> = ch.parameters.iter().map(|p| (p.value, g.zero())).collect();
    let solved: Vec<Expr> = ch.dependent.iter().map(|&d| ch.velocities[d]).collect();
    let is_linear = ch.implicit().next().is_none()
        && !g.any_contains_any(&slopes, &parameters)
        && !slopes.iter().any(|&e| system.is_rheonomic(e))
        && g.substitute_all(&solved, &at_rest)
            .iter()
            .all(|&e| g.is_zero(e));
    if !is_linear {
        return None;
    }
    let k = ch.k();
    let along = ch.by_quasi_coordinates(system, &slopes);
    let entry = |l: usize, s: usize, u: usize| g.sub(along[l * k + s][u], along[l * k + u][s]);
    let rows = (0..ch.dependent.len()).map(|l| {
        let columns = (0..k).map(|s| (0..k).map(|u| entry(l, s, u)).collect());
        columns.collect()
    });
    Some(rows.collect())
}

fn curvature_objects(
    system: &System,
    characteristics: &Characteristics,
    curvature: &[Vec<Vec<Expr>>],
) -> Vec<NamedExpr> {
    let name = |i: usize| system.coordinates[i].name.as_str();
    let independent = &characteristics.independent;
    let mut objects = Vec::new();
    for (&d, table) in characteristics.dependent.iter().zip(curvature) {
        for (s, row) in table.iter().enumerate() {
            for (u, &value) in row.iter().enumerate().skip(s + 1) {
                if !system.graph.is_zero(value) {
                    let (d, s, u) = (name(d), name(independent[s]), name(independent[u]));
                    let meaning = "curvature of the linear constraints";
                    let object = NamedExpr::new(format!("R_{d}_{s}_{u}"), value, meaning);
                    objects.push(object.with_indices("R", &[d], &[s, u]));
                }
            }
        }
    }
    objects
}

/// The bracket of the reduced equations for linear homogeneous constraints, `F' = {F, H̃}` (T1 (47)).
///
/// It is antisymmetric; Jacobi's identity holds where the constraints are integrable only.
#[derive(Clone, Debug)]
pub struct ReducedBracket {
    /// The variables: q^1..q^n, then p̃_1..p̃_k.
    pub variables: Vec<Symbol>,
    /// `{x_a, x_b}` as functions of (q, p̃), (n + k) × (n + k).
    pub table: Vec<Vec<Expr>>,
    /// H̃(q, p̃, t).
    pub hamiltonian: Expr,
}

impl ReducedBracket {
    /// The bracket of a system; `None` where the constraints are not linear and homogeneous with coefficients a(q), or the
    /// velocities are no closed functions of the momenta.
    ///
    /// # Errors
    /// [`DeriveError`].
    pub fn new(basis: &Basis<'_>) -> Result<Option<ReducedBracket>, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let reduced = Reduced::new(basis)?;
        let ch = &reduced.characteristics;
        let legendre = ReducedLegendre::new(system, &reduced)?;
        let (Some(legendre), Some(curvature)) = (legendre, linear_curvature(system, ch)) else {
            return Ok(None);
        };
        let (n, k) = (system.n(), ch.k());
        let theta = legendre.restrict(system, &reduced.theta);
        let mut table = vec![vec![g.zero(); n + k]; n + k];
        for (i, row) in ch.basis.iter().enumerate() {
            for (s, &entry) in row.iter().enumerate() {
                table[i][n + s] = entry;
                table[n + s][i] = g.neg(entry);
            }
        }
        for s in 0..k {
            for u in 0..k {
                let terms = theta.iter().zip(&curvature);
                let parts: Vec<Expr> = terms.map(|(&theta, r)| g.mul(&[theta, r[s][u]])).collect();
                table[n + s][n + u] = g.add(&parts);
            }
        }
        let mut variables = system.coordinate_symbols();
        variables.extend(reduced.momenta.iter().filter_map(|&p| g.as_symbol(p)));
        Ok(Some(ReducedBracket {
            variables,
            table,
            hamiltonian: legendre.hamiltonian,
        }))
    }

    /// `{F, x_b}` for all b.
    pub fn with_variables(&self, system: &System, f: Expr) -> Vec<Expr> {
        let g = &system.graph;
        let slopes = g.gradient(f, &self.variables);
        (0..self.variables.len())
            .map(|b| {
                let terms = slopes.iter().zip(&self.table);
                let parts: Vec<Expr> = terms.map(|(&slope, row)| g.mul(&[slope, row[b]])).collect();
                g.add(&parts)
            })
            .collect()
    }

    /// `{F, G}`.
    pub fn of(&self, system: &System, f: Expr, other: Expr) -> Expr {
        let g = &system.graph;
        let slopes = g.gradient(other, &self.variables);
        let parts: Vec<Expr> = self
            .with_variables(system, f)
            .into_iter()
            .zip(slopes)
            .map(|(a, b)| g.mul(&[a, b]))
            .collect();
        g.add(&parts)
    }

    /// Jacobi's sum `{x_a, {x_b, x_c}} + {x_b, {x_c, x_a}} + {x_c, {x_a, x_b}}` of three variables by their places; zero
    /// where a place is beyond the variables.
    pub fn jacobi_sum(&self, system: &System, places: [usize; 3]) -> Expr {
        let g = &system.graph;
        let [a, b, c] = places;
        let parts: Vec<Expr> = [(a, b, c), (b, c, a), (c, a, b)]
            .into_iter()
            .filter_map(|(a, b, c)| {
                let outer = g.symbol_expr(*self.variables.get(a)?);
                let inner = *self.table.get(b)?.get(c)?;
                Some(self.of(system, outer, inner))
            })
            .collect();
        g.add(&parts)
    }
}
