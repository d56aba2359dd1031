//! The equations of motion made short, to be computed: `M P' = b` in independent quasi-velocities P.
//!
//! The kinetic energy is taken as it is written, a quadratic form `½ Σ C_kl e_k e_l` of linear forms e of the velocities.
//! With `E = ∂e/∂P` on the constraints, `M = Eᵀ C E` and, with P' = 0 in the derivatives D,
//! `b_σ = R_σ − Σ E_kσ D(C_kl e_l) − Σ C_kl e_l ε_kσ + ½ Σ ∂C_kl/∂π_σ e_k e_l`, where
//! `ε_kσ = Σ_i B_iσ (D ∂e_k/∂v_i − ∂e_k/∂q_i)` vanishes where e is a rate (Gibbs 1879, Appell 1900; for quasi-velocities
//! Hamel 1904). R collects the forces and what is left of the Lagrangian. Nothing is expanded: a body costs what its
//! velocities cost.
//!
//! Coordinates that occur in M and b although these do not depend on them, as the heading of a body on a plane without
//! a preferred direction, are ignorable there, and a number is put in their place.

use crate::characteristics::Characteristics;
use crate::linear::dot;
use crate::mass;
use crate::quadratic_forms::{in_linear_forms, terms_of_degree};
use crate::regular::regular;
use crate::system::System;
use crate::terms::{force, freeze_accelerations, MotionTerms};
use chetaev_symbolic::print::{Document, Options as Printing};
use chetaev_symbolic::simplify::{simplify, simplify_all, Options};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};

/// The motion in quasi-velocities without singular places.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The quasi-velocities P.
    pub characteristics: Characteristics,
    /// P' as functions of (t, q, P).
    pub rates: Vec<Expr>,
    /// q'' as functions of (t, q, P).
    pub accelerations: Vec<Expr>,
}

/// The motion on the constraints of `rows` in quasi-velocities without singular places ([`regular`]); `None` where none are found.
pub fn reduced(system: &System, terms: &MotionTerms, rows: &[usize]) -> Option<Reduced> {
    let g = &system.graph;
    let c = regular(system, terms, rows)?;
    // Where a mass contains velocities the equations are not those of the Lagrangian.
    let of_lagrangian = mass::with_velocity(system).is_none();
    let own = of_lagrangian.then(|| ReducedEquations::new(system, &c));
    let own = own
        .flatten()
        .unwrap_or_else(|| ReducedEquations::of_terms(system, terms, &c));
    let rates = own.without_ignorable(system).shortened(system).rates(g)?;
    let of_rates: Vec<(Expr, Expr)> = c
        .parameters
        .iter()
        .zip(&rates)
        .map(|(p, &rate)| (p.rate, rate))
        .collect();
    Some(Reduced {
        accelerations: g.substitute_all(&c.accelerations, &of_rates),
        rates,
        characteristics: c,
    })
}

/// The accelerations as functions of (t, q, v) on the constraints of `rows`, by quasi-velocities without singular places; `None`
/// where none are found.
pub fn accelerations(system: &System, terms: &MotionTerms, rows: &[usize]) -> Option<Vec<Expr>> {
    let found = reduced(system, terms, rows)?;
    let of_speeds = found.characteristics.parameters.iter();
    let of_speeds = of_speeds.map(|p| (p.value, p.definition));
    let of_speeds: Vec<(Expr, Expr)> = of_speeds.filter(|(speed, own)| speed != own).collect();
    Some(
        system
            .graph
            .substitute_all(&found.accelerations, &of_speeds),
    )
}

/// `M P' = b`.
#[derive(Clone, Debug)]
pub struct ReducedEquations {
    /// M, k × k.
    pub mass: Vec<Vec<Expr>>,
    /// b, length k.
    pub force: Vec<Expr>,
}

impl ReducedEquations {
    /// From the Lagrangian with the kinetic energy as it is written; `None` where that is no such form beside what is linear in the velocities.
    pub fn new(system: &System, c: &Characteristics) -> Option<ReducedEquations> {
        let g = &system.graph;
        let (kinetic, rest) = terms_of_degree(system, system.lagrangian, 2);
        // What is left may be linear in the velocities, and has no inertia then.
        let momenta = g.gradient(rest, &system.velocity_symbols());
        if g.any_contains_any(&momenta, &system.velocity_symbols()) {
            return None;
        }
        let forms = Forms::of(system, c, kinetic)?;
        let k = c.k();
        let entry = |s: usize, t: usize| {
            let terms = forms.weights.iter();
            let terms = terms.map(|&(c, i, j)| g.mul(&[c, forms.slope[i][s], forms.slope[j][t]]));
            g.add(&terms.collect::<Vec<_>>())
        };
        let lower: Vec<Vec<Expr>> = (0..k)
            .map(|s| (0..=s).map(|t| entry(s, t)).collect())
            .collect();
        let row = |s: usize| (0..k).map(|t| lower[s.max(t)][s.min(t)]).collect();
        let mass = (0..k).map(row).collect();
        let applied = c.contract(system, &c.restrict(system, &force(system, rest, &momenta)));
        let inertia = forms.inertia(system, c);
        let force = applied.iter().zip(&inertia);
        let force = force
            .map(|(&applied, &inertia)| g.sub(applied, inertia))
            .collect();
        Some(ReducedEquations { mass, force })
    }

    /// As [`new`](ReducedEquations::new), made short to be read: the linear forms are simplified, and what belongs to one weight of the
    /// kinetic energy is put together before the whole is. Coordinates on which nothing depends are left out.
    pub fn short(system: &System, c: &Characteristics) -> Option<ReducedEquations> {
        let g = &system.graph;
        let (kinetic, rest) = terms_of_degree(system, system.lagrangian, 2);
        let momenta = g.gradient(rest, &system.velocity_symbols());
        if g.any_contains_any(&momenta, &system.velocity_symbols()) {
            return None;
        }
        let forms = Forms::of(system, c, kinetic)?.simplified(g).turned(system);
        let k = c.k();
        let mut sums = Vec::new();
        for s in 0..k {
            sums.extend((0..=s).map(|t| forms.inertia_of(g, s, t)));
        }
        let applied = c.contract(system, &c.restrict(system, &force(system, rest, &momenta)));
        let inertia = forms.inertia_terms(system, c);
        for (applied, inertia) in applied.into_iter().zip(inertia) {
            let turned = |(weight, e): (Expr, Expr)| (weight, g.neg(e));
            let mut all: Vec<(Expr, Expr)> = inertia.into_iter().map(turned).collect();
            all.push((g.one(), applied));
            sums.push(WeightedSum(all));
        }
        without_ignorable(system, &mut sums);
        let entries: Vec<Expr> = sums.iter().map(|sum| sum.short(g)).collect();
        let (lower, force) = entries.split_at(k * (k + 1) / 2);
        let place = |s: usize, t: usize| s.max(t) * (s.max(t) + 1) / 2 + s.min(t);
        let row = |s: usize| (0..k).map(|t| lower[place(s, t)]).collect();
        Some(ReducedEquations {
            mass: (0..k).map(row).collect(),
            force: force.to_vec(),
        })
    }

    /// From the terms of the multiplier form: `Bᵀ W B` and `Bᵀ (b − W a*)`.
    pub fn of_terms(system: &System, terms: &MotionTerms, c: &Characteristics) -> ReducedEquations {
        let g = &system.graph;
        let columns: Vec<Vec<Expr>> = (0..c.k()).map(|s| c.column(s)).collect();
        let on = |es: &[Expr]| c.restrict(system, es);
        let rows: Vec<Vec<Expr>> = terms.mass_matrix.iter().map(|row| on(row)).collect();
        let times = |v: &[Expr]| -> Vec<Expr> { rows.iter().map(|row| dot(g, row, v)).collect() };
        let along = |column: &Vec<Expr>| c.contract(system, &times(column));
        let mass: Vec<Vec<Expr>> = columns.iter().map(along).collect();
        let inertia = times(&c.acceleration_offset);
        let left = on(&terms.force).into_iter().zip(inertia);
        let left: Vec<Expr> = left.map(|(force, inertia)| g.sub(force, inertia)).collect();
        ReducedEquations {
            // M is not symmetric where a mass contains velocities.
            mass: (0..c.k())
                .map(|s| mass.iter().map(|own| own[s]).collect())
                .collect(),
            force: c.contract(system, &left),
        }
    }

    /// P', as one linear system.
    pub fn rates(&self, g: &Graph) -> Option<Vec<Expr>> {
        match self.force[..] {
            [] => Some(Vec::new()),
            _ => g.solve(&self.mass.concat(), &self.force).ok(),
        }
    }

    /// The same with numbers for the coordinates on which it does not depend.
    #[must_use]
    pub fn without_ignorable(&self, system: &System) -> ReducedEquations {
        let g = &system.graph;
        let mut own = self.clone();
        for c in &system.coordinates {
            let all = own.entries();
            if !g.any_contains_any(&all, &[c.q_symbol]) {
                continue;
            }
            let at_zero = g.substitute_all(&all, &[(c.q, g.zero())]);
            let differences: Vec<Expr> = all
                .iter()
                .zip(&at_zero)
                .map(|(&a, &b)| g.sub(a, b))
                .collect();
            if vanish(system, &differences) {
                own = own.with(&at_zero);
            }
        }
        own
    }

    /// The same with shorter entries, where it is short enough for that to be worth its time.
    #[must_use]
    pub fn shortened(&self, system: &System) -> ReducedEquations {
        let g = &system.graph;
        let entries = self.entries();
        let size = |es: &[Expr]| g.reachable(es).len();
        if size(&entries) > SHORT {
            return self.clone();
        }
        let shorter = simplify_all(g, &entries, &Options::default());
        match size(&shorter) < size(&entries) {
            true => self.with(&shorter),
            false => self.clone(),
        }
    }

    /// M by rows, then b.
    pub fn entries(&self) -> Vec<Expr> {
        [self.mass.concat(), self.force.clone()].concat()
    }

    fn with(&self, entries: &[Expr]) -> ReducedEquations {
        let k = self.force.len();
        ReducedEquations {
            mass: entries[..k * k]
                .chunks(k.max(1))
                .map(<[Expr]>::to_vec)
                .collect(),
            force: entries[k * k..].to_vec(),
        }
    }
}

/// `Σ w e` with weights w of the kinetic energy.
struct WeightedSum(Vec<(Expr, Expr)>);

impl WeightedSum {
    fn value(&self, g: &Graph) -> Expr {
        let terms = self.0.iter().map(|&(weight, e)| g.mul(&[weight, e]));
        g.add(&terms.collect::<Vec<_>>())
    }

    /// The fewest operations of: as it is, with what belongs to one weight made short, and all made short.
    fn short(&self, g: &Graph) -> Expr {
        let plain = self.value(g);
        if g.reachable(&[plain]).len() > READ {
            return plain;
        }
        let mut by_weight: Vec<(Expr, Vec<Expr>)> = Vec::new();
        for &(weight, e) in &self.0 {
            match by_weight.iter_mut().find(|(own, _)| *own == weight) {
                Some((_, all)) => all.push(e),
                None => by_weight.push((weight, vec![e])),
            }
        }
        let options = Options::default();
        let terms = by_weight.iter().map(|(weight, all)| {
            let sum = g.add(all);
            g.mul(&[*weight, fewest(g, [simplify(g, sum, &options), sum])])
        });
        let apart = g.add(&terms.collect::<Vec<_>>());
        fewest(g, [simplify(g, apart, &options), apart, plain])
    }
}

/// The first of those with the fewest operations as they are printed.
fn fewest<const N: usize>(g: &Graph, es: [Expr; N]) -> Expr {
    let least = es.into_iter().min_by_key(|&e| operations(g, &[e]));
    least.unwrap_or(g.zero())
}

fn operations(g: &Graph, es: &[Expr]) -> usize {
    let printed = Document::expressions(g, es, &Printing::default());
    printed.operations().total()
}

/// Components along and across the direction of an angle, made short.
fn turned(g: &Graph, [a, b]: [Expr; 2], angle: Expr) -> [Expr; 2] {
    let (s, c) = (g.sin(angle), g.cos(angle));
    let along = g.add(&[g.mul(&[c, a]), g.mul(&[s, b])]);
    let across = g.sub(g.mul(&[c, b]), g.mul(&[s, a]));
    [along, across].map(|e| simplify(g, e, &Options::default()))
}

/// Puts a number in the place of coordinates on which the sums do not depend.
fn without_ignorable(system: &System, sums: &mut [WeightedSum]) {
    let g = &system.graph;
    for c in &system.coordinates {
        let values: Vec<Expr> = sums.iter().map(|sum| sum.value(g)).collect();
        if !g.any_contains_any(&values, &[c.q_symbol]) {
            continue;
        }
        let at_zero = g.substitute_all(&values, &[(c.q, g.zero())]);
        let pairs = values.iter().zip(&at_zero);
        let differences: Vec<Expr> = pairs.map(|(&a, &b)| g.sub(a, b)).collect();
        if vanish(system, &differences) {
            for (_, e) in sums.iter_mut().flat_map(|sum| &mut sum.0) {
                *e = g.substitute(*e, &[(c.q, g.zero())]);
            }
        }
    }
}

/// Sums of more nodes than this are not made short to be read.
const READ: usize = 300;

/// Linear forms of more nodes than this are left as they are.
const FORM: usize = 120;

/// Larger equations are not simplified: that takes a quarter of a second and seldom leaves them shorter.
const SHORT: usize = 100;

/// Linear forms of the velocities on the constraints.
struct Forms {
    /// The entries of C that do not vanish, with their places.
    weights: Vec<(Expr, usize, usize)>,
    /// e.
    value: Vec<Expr>,
    /// E, a row for each form.
    slope: Vec<Vec<Expr>>,
    /// ė with P' = 0.
    frozen: Vec<Expr>,
    /// ε, a row for each form.
    turn: Vec<Vec<Expr>>,
}

impl Forms {
    /// `None` where C contains velocities.
    fn of(system: &System, c: &Characteristics, kinetic: Expr) -> Option<Forms> {
        let g = &system.graph;
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let (written, variables, forms) = in_linear_forms(g, kinetic, &velocities)?;
        let symbols: Vec<Symbol> = variables.iter().filter_map(|&e| g.as_symbol(e)).collect();
        let matrix = g.jacobian(&g.gradient(written, &symbols), &symbols);
        let moving = [&symbols[..], &system.velocity_symbols()].concat();
        if g.any_contains_any(&matrix.concat(), &moving) {
            return None;
        }
        let n = forms.len();
        let entries = matrix.concat().into_iter().enumerate();
        let weights = entries.filter(|(_, c)| !g.is_zero(*c));
        let value = c.restrict(system, &forms);
        Some(Forms {
            weights: weights.map(|(at, c)| (c, at / n, at % n)).collect(),
            slope: c.by_parameters(system, &value),
            frozen: c.frozen_derivative(system, &value),
            turn: turns(system, c, &forms),
            value,
        })
    }

    /// Two forms of equal weight that nothing couples, such as the components of a velocity, along the axis and across it that make them
    /// shortest: turned by an angle that occurs in them, all that is made of them has the same value.
    fn turned(mut self, system: &System) -> Forms {
        let g = &system.graph;
        let alone = |own: usize| {
            let of_own = self
                .weights
                .iter()
                .filter(|&&(_, i, j)| i == own || j == own);
            let found: Vec<&(Expr, usize, usize)> = of_own.collect();
            match found[..] {
                [&(weight, i, j)] if i == j => Some(weight),
                _ => None,
            }
        };
        let weights: Vec<Option<Expr>> = (0..self.value.len()).map(alone).collect();
        let mut left: Vec<usize> = (0..weights.len())
            .filter(|&i| weights[i].is_some())
            .collect();
        while let Some(i) = left.first().copied() {
            left.remove(0);
            let Some(at) = left.iter().position(|&j| weights[j] == weights[i]) else {
                continue;
            };
            let j = left[at];
            if let Some(angle) = self.best_angle(system, i, j) {
                self.turn_pair(g, i, j, angle);
                left.remove(at);
            }
        }
        self
    }

    /// The angle by which two forms become shorter.
    fn best_angle(&self, system: &System, i: usize, j: usize) -> Option<Expr> {
        let g = &system.graph;
        let now = operations(g, &[self.value[i], self.value[j]]);
        let both = [self.value[i], self.value[j]];
        if g.reachable(&both).len() > FORM {
            return None;
        }
        let angles = system.coordinates.iter().map(|c| c.q);
        let angles = angles.filter(|&q| {
            g.reachable(&both)
                .into_iter()
                .any(|e| e == g.sin(q) || e == g.cos(q))
        });
        let turned = angles.map(|angle| (operations(g, &turned(g, both, angle)), angle));
        let best = turned.min_by_key(|(count, _)| *count)?;
        (best.0 < now).then_some(best.1)
    }

    fn turn_pair(&mut self, g: &Graph, i: usize, j: usize, angle: Expr) {
        let turn = |list: &mut [Expr]| {
            let [a, b] = turned(g, [list[i], list[j]], angle);
            (list[i], list[j]) = (a, b);
        };
        turn(&mut self.value);
        turn(&mut self.frozen);
        for rows in [&mut self.slope, &mut self.turn] {
            for s in 0..rows[i].len() {
                let [a, b] = turned(g, [rows[i][s], rows[j][s]], angle);
                (rows[i][s], rows[j][s]) = (a, b);
            }
        }
    }

    /// With everything made short.
    fn simplified(self, g: &Graph) -> Forms {
        let short = |es: &[Expr]| -> Vec<Expr> {
            let options = Options::default();
            let is_small = |e: Expr| g.reachable(&[e]).len() <= FORM;
            let one = |&e: &Expr| {
                if is_small(e) {
                    simplify(g, e, &options)
                } else {
                    e
                }
            };
            es.iter().map(one).collect()
        };
        Forms {
            value: short(&self.value),
            slope: self.slope.iter().map(|row| short(row)).collect(),
            frozen: short(&self.frozen),
            turn: self.turn.iter().map(|row| short(row)).collect(),
            weights: self.weights,
        }
    }

    /// An entry of M.
    fn inertia_of(&self, g: &Graph, s: usize, t: usize) -> WeightedSum {
        let terms = self.weights.iter();
        let terms =
            terms.map(|&(weight, i, j)| (weight, g.mul(&[self.slope[i][s], self.slope[j][t]])));
        WeightedSum(terms.filter(|(_, e)| !g.is_zero(*e)).collect())
    }

    /// What of the inertia does not contain P': `Σ E_kσ D(C_kl e_l) + Σ C_kl e_l ε_kσ − ½ Σ ∂C_kl/∂π_σ e_k e_l`.
    fn inertia(&self, system: &System, c: &Characteristics) -> Vec<Expr> {
        let sums = self.inertia_terms(system, c).into_iter();
        sums.map(|sum| WeightedSum(sum).value(&system.graph))
            .collect()
    }

    /// The same by weights.
    fn inertia_terms(&self, system: &System, c: &Characteristics) -> Vec<Vec<(Expr, Expr)>> {
        let g = &system.graph;
        let entries: Vec<Expr> = self.weights.iter().map(|own| own.0).collect();
        let rates = c.frozen_derivative(system, &entries);
        let by_position = c.by_quasi_coordinates(system, &entries);
        let half = g.div(g.one(), g.integer(2));
        let of = |s: usize| {
            let terms = self.weights.iter().enumerate();
            let terms = terms.flat_map(|(at, &(weight, i, j))| {
                let along = g.mul(&[self.slope[i][s], self.frozen[j]]);
                let turning = g.mul(&[self.value[j], self.turn[i][s]]);
                let rate = g.mul(&[self.slope[i][s], rates[at], self.value[j]]);
                let change = g.mul(&[half, by_position[at][s], self.value[i], self.value[j]]);
                [
                    (weight, g.add(&[along, turning])),
                    (g.one(), g.sub(rate, change)),
                ]
            });
            terms.filter(|(_, e)| !g.is_zero(*e)).collect()
        };
        (0..c.k()).map(of).collect()
    }
}

/// ε of forms in the velocities.
fn turns(system: &System, c: &Characteristics, forms: &[Expr]) -> Vec<Vec<Expr>> {
    let g = &system.graph;
    forms
        .iter()
        .map(|&form| {
            let slopes = g.gradient(form, &system.velocity_symbols());
            let rates = freeze_accelerations(system, &slopes);
            let by_position = g.gradient(form, &system.coordinate_symbols());
            let own: Vec<Expr> = rates
                .iter()
                .zip(&by_position)
                .map(|(&a, &b)| g.sub(a, b))
                .collect();
            let own: Vec<Expr> = own
                .iter()
                .map(|&e| {
                    if !g.is_zero(e) && vanish(system, &[e]) {
                        g.zero()
                    } else {
                        e
                    }
                })
                .collect();
            c.contract(system, &c.restrict(system, &own))
        })
        .collect()
}

/// Whether expressions are proved to vanish, modularly.
fn vanish(system: &System, es: &[Expr]) -> bool {
    let none = Assumptions::new();
    let test = ZeroTest::everywhere(es, &none);
    let options = chetaev_symbolic::zero::Options {
        exact: false,
        refute: false,
        ..test.options
    };
    let test = ZeroTest { options, ..test };
    matches!(decide_zero(&system.graph, &test), Verdict::Proved(_))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::SystemParts;
    use std::sync::Arc;

    /// A wheel that rolls upright, x' = ψ' cos φ, y' = ψ' sin φ, with unit mass, inertia and radius: whatever the heading φ, it
    /// has the inertia 2 against rolling, and nothing accelerates it.
    #[test]
    fn the_heading_of_a_wheel_is_ignorable() {
        let g = Arc::new(Graph::new());
        let [vx, vy, turn, roll] = ["x", "y", "phi", "psi"].map(|name| g.symbol(name, 1));
        let phi = g.symbol("phi", 0);
        let squares = [vx, vy, turn, roll].map(|v| g.powi(v, 2));
        let rolls = |v: Expr, along: Expr| g.sub(v, g.mul(&[roll, along]));
        let parts = SystemParts {
            coordinates: ["x", "y", "phi", "psi"].map(String::from).to_vec(),
            lagrangian: Some(g.div(g.add(&squares), g.integer(2))),
            constraints: vec![
                ("along".into(), rolls(vx, g.cos(phi))),
                ("across".into(), rolls(vy, g.sin(phi))),
            ],
            ..SystemParts::default()
        };
        let system = System::new(g.clone(), parts).unwrap();
        let terms = MotionTerms::new(&system);
        let c = regular(&system, &terms, &[0, 1]).unwrap();
        let own = ReducedEquations::new(&system, &c).unwrap();
        let stated = ReducedEquations::of_terms(&system, &terms, &c);
        for found in [own, stated].map(|own| own.without_ignorable(&system)) {
            assert_eq!(found.mass, [[g.one(), g.zero()], [g.zero(), g.integer(2)]]);
            assert_eq!(found.force, [g.zero(), g.zero()]);
        }
    }
}
