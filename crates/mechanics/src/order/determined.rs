//! From equations of motion under constraints of order m to a determined system for the derivatives of that order (T2 §5).
//!
//! Each equation `G = 0` of a formulation has an order s of its own, that of the forces and of the directions of the
//! reactions. Where s < m it is differentiated m - s times; with the constraints they then determine `q^(m)`. What was
//! passed over, `G, D G, …, D^(m-s-1) G`, and the constraints of lower order with their derivatives, are conditions on the
//! initial data and integrals of the motion. Where equations share multipliers, how often each is differentiated follows from
//! the structure of the whole system.

use super::{highest_derivative, lifting, structure};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, Equations, NamedExpr, StateVariable};
use crate::formulations::{Basis, DeriveError};
use crate::linear::{solve_linear, solve_with_multipliers};
use crate::system::System;
use crate::words::differentiated_so;
use chetaev_symbolic::{Expr, Symbol};
use rustc_hash::FxHashMap;

/// The equations that determine the derivatives of order m, as many as unknowns.
#[derive(Clone, Debug)]
pub struct Determined {
    /// m.
    pub order: u32,
    /// How often each equation of motion was differentiated.
    pub times: Vec<u32>,
    /// The orders of the derivatives of the multipliers that are solved for; `None` for equations without multipliers.
    pub multiplier_orders: Option<Vec<u32>>,
    /// What is solved for: parameters of the derivatives of order m, or these and derivatives of the multipliers.
    pub unknowns: Vec<Symbol>,
    /// The equations, differentiated, and constraints; functions of t, of derivatives of orders below m, and the unknowns.
    pub equations: Vec<Expr>,
    /// `q^(m)` as functions of t, of derivatives of orders below m, and the unknowns; length n.
    pub highest: Vec<Expr>,
    /// Whether the equations are affine in the unknowns.
    pub linear: bool,
    /// What was passed over: conditions on a state.
    pub conditions: Vec<NamedExpr>,
}

impl Determined {
    /// How often the equations of motion were differentiated at most.
    pub fn differentiations(&self) -> u32 {
        self.times.iter().copied().max().unwrap_or(0)
    }
}

/// The multiplier form `w_s = Σ_l λ_l A^l_s`, `f^l = 0` for `q^(m)` and, where the equations are differentiated, derivatives of the
/// multipliers; lower ones are variables of the state (T2 (5)).
pub fn with_multipliers(basis: &Basis<'_>) -> Determined {
    let (system, terms) = (basis.system, basis.terms);
    let (g, m) = (&system.graph, terms.order);
    let names = basis.multiplier_names();
    let balance = basis.balance();
    let (times, multiplier_orders) = differentiations(basis, &balance);
    let labels = system.coordinates.iter().map(|c| c.name.as_str());
    let (mut equations, conditions) = differentiated(labels, &balance, &times, &|es| {
        es.iter()
            .map(|&e| system.total_derivative_with(e, &names))
            .collect()
    });
    let mut unknowns: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    let multipliers = names.iter().zip(&multiplier_orders);
    unknowns.extend(multipliers.map(|(name, &order)| g.intern_symbol(name, order)));
    equations.extend(basis.constraints());
    Determined {
        order: m,
        times,
        multiplier_orders: Some(multiplier_orders),
        linear: basis.selection.rows.iter().all(|&row| terms.affine[row]),
        highest: terms.jets.iter().map(|c| c.v).collect(),
        unknowns,
        equations,
        conditions,
    }
}

/// How often each equation with multipliers is differentiated, and the orders of the derivatives of the multipliers that are
/// solved for.
fn differentiations(basis: &Basis<'_>, balance: &[Expr]) -> (Vec<u32>, Vec<u32>) {
    let (system, m) = (basis.system, basis.terms.order);
    let g = &system.graph;
    let names = basis.multiplier_names();
    let orders: Vec<Vec<Option<u32>>> = balance
        .iter()
        .chain(&basis.constraints())
        .map(|&e| orders_in(system, &names, e))
        .collect();
    let n = system.n();
    let least: Vec<u32> = (0..n + names.len())
        .map(|j| if j < n { m } else { 0 })
        .collect();
    if let Some(found) = structure::offsets(&orders, &least) {
        if found.unknowns[..n] == least[..n] && found.equations[n..].iter().all(|&c| c == 0) {
            return (found.equations[..n].to_vec(), found.unknowns[n..].to_vec());
        }
    }
    // Structurally singular: all that contain multipliers alike, so that what is missing can be said.
    let times_of = |es: &[Expr]| m - highest_derivative(system, es).unwrap_or(0).min(m);
    let lambdas: Vec<Symbol> = names.iter().map(|name| g.intern_symbol(name, 0)).collect();
    let reacts = |e: &Expr| g.contains_any(*e, &lambdas);
    let reacting: Vec<Expr> = balance.iter().copied().filter(|e| reacts(e)).collect();
    let together = times_of(&reacting);
    let times = balance.iter().map(|e| match reacts(e) {
        true => together,
        false => times_of(&[*e]),
    });
    (times.collect(), vec![together; names.len()])
}

/// The orders of the highest derivatives of the coordinates and of the multipliers in an equation.
fn orders_in(system: &System, multipliers: &[String], e: Expr) -> Vec<Option<u32>> {
    let g = &system.graph;
    let n = system.n();
    let mut orders = vec![None; n + multipliers.len()];
    for symbol in g.symbols_in(&[e]) {
        let name = g.symbol_name(symbol);
        let multiplier = || {
            multipliers
                .iter()
                .position(|own| own == name)
                .map(|l| n + l)
        };
        if let Some(j) = system.coordinate_index(name).or_else(multiplier) {
            orders[j] = orders[j].max(Some(g.symbol_order(symbol)));
        }
    }
    orders
}

/// Each equation differentiated as often as asked, and what was passed over.
fn differentiated<'a>(
    labels: impl Iterator<Item = &'a str>,
    equations: &[Expr],
    times: &[u32],
    derive: &dyn Fn(&[Expr]) -> Vec<Expr>,
) -> (Vec<Expr>, Vec<NamedExpr>) {
    let labels: Vec<&str> = labels.collect();
    let mut level = equations.to_vec();
    let mut found = equations.to_vec();
    let mut conditions = Vec::new();
    for done in 0..times.iter().copied().max().unwrap_or(0) {
        for ((label, &value), &times) in labels.iter().zip(&level).zip(times) {
            if done < times {
                conditions.push(balance_condition(label, done, value));
            }
        }
        level = derive(&level);
        for ((found, &next), &times) in found.iter_mut().zip(&level).zip(times) {
            if done < times {
                *found = next;
            }
        }
    }
    (found, conditions)
}

/// Equations `G_σ = 0` on the jet (t, q, …, q^(m-1), P) of characteristics, for P, each of which is differentiated so many
/// `times`. G does not depend on P', which may be left in it by its form; neither do those depend on P that are
/// differentiated.
pub fn for_parameters(
    system: &System,
    characteristics: &Characteristics,
    motion: &[Expr],
    times: Vec<u32>,
) -> Determined {
    let (g, c) = (&system.graph, characteristics);
    let frozen: Vec<(Expr, Expr)> = c.parameters.iter().map(|p| (p.rate, g.zero())).collect();
    let mut motion = g.substitute_all(motion, &frozen);
    let unknowns: Vec<Symbol> = c.parameters.iter().map(|p| p.symbol).collect();
    let implicit: Vec<(Expr, Symbol)> = c.implicit().map(|(f, s)| (f, s.symbol)).collect();
    let linear = implicit.is_empty() && !g.any_contains_any(&c.basis.concat(), &unknowns);
    if linear {
        let any: Vec<(Expr, Expr)> = unknowns
            .iter()
            .map(|&s| (g.symbol_expr(s), g.zero()))
            .collect();
        for (equation, _) in motion
            .iter_mut()
            .zip(&times)
            .filter(|(_, &times)| times > 0)
        {
            *equation = g.substitute(*equation, &any);
        }
    }
    let labels = c.parameters.iter().map(|p| p.name.as_str());
    let (mut equations, conditions) = differentiated(labels, &motion, &times, &|es| {
        g.substitute_all(&c.total_derivative(system, es), &frozen)
    });
    let mut unknowns = unknowns;
    unknowns.extend(implicit.iter().map(|(_, symbol)| *symbol));
    equations.extend(implicit.iter().map(|(f, _)| *f));
    Determined {
        order: c.order,
        times,
        multiplier_orders: None,
        unknowns,
        equations,
        highest: c.velocities.clone(),
        linear,
        conditions,
    }
}

/// The equations of motion of a formulation in characteristics: for the rates P' of parameters of the velocities, or for
/// parameters P of the derivatives of order m.
///
/// # Errors
/// [`DeriveError`].
pub(crate) fn in_characteristics(
    name: &'static str,
    basis: &Basis<'_>,
    characteristics: &Characteristics,
    motion: &[Equation],
) -> Result<Equations, DeriveError> {
    let (system, c) = (basis.system, characteristics);
    let residuals: Vec<Expr> = motion
        .iter()
        .map(|e| system.graph.sub(e.left, e.right))
        .collect();
    let mut equations = if c.order == 1 {
        let rates = c.rates_from(system, &residuals)?;
        Equations::in_characteristics(name, system, c, &rates)
    } else {
        let times = times_of(system, c);
        let determined = for_parameters(system, c, &residuals, times);
        on_jets(name, basis, &determined)?
    };
    if system.characteristics.is_some() {
        // No formula gives the parameters from the velocities.
        let own = parameters(c);
        let open = equations.variables.iter_mut();
        open.filter(|x| own.contains(&x.symbol))
            .filter(|x| {
                x.definition == Some(x.value)
                    && system.coordinates.iter().all(|c| c.v_symbol != x.symbol)
            })
            .for_each(|x| x.definition = None);
    }
    equations.on_characteristics = Some((c.clone(), residuals));
    Ok(equations)
}

/// How often equations that are Maggi's must be differentiated to contain the parameters.
fn times_of(system: &System, c: &Characteristics) -> Vec<u32> {
    let own = parameters(c);
    let maggi = crate::formulations::maggi_left_sides(system, c).into_iter();
    maggi
        .map(|e| match system.graph.contains_any(e, &own) {
            true => 0,
            false => c.order - highest_derivative(system, &[e]).unwrap_or(0).min(c.order),
        })
        .collect()
}

fn parameters(c: &Characteristics) -> Vec<Symbol> {
    let own = c.parameters.iter().map(|p| p.symbol);
    own.chain(c.implicit().map(|(_, s)| s.symbol)).collect()
}

/// A determined system as equations with the state (q, q', …, q^(m-1)), further multipliers, and unknowns that are not given
/// explicitly.
///
/// # Errors
/// [`DeriveError::Singular`] where the equations are structurally dependent.
pub fn on_jets(
    name: &'static str,
    basis: &Basis<'_>,
    determined: &Determined,
) -> Result<Equations, DeriveError> {
    let (system, m) = (basis.system, determined.order);
    let g = &system.graph;
    let solved = match determined.linear {
        true => Some(solve(basis, determined)?),
        false => None,
    };
    let in_state = |e: Expr| match &solved {
        Some(values) => {
            let unknowns = determined.unknowns.iter().map(|&s| g.symbol_expr(s));
            g.substitute(e, &unknowns.zip(values.iter().copied()).collect::<Vec<_>>())
        }
        None => e,
    };
    let highest: Vec<Expr> = determined.highest.iter().map(|&e| in_state(e)).collect();
    let mut variables = jet_variables(system, m, &highest);
    variables.extend(multiplier_variables(basis, determined, &in_state));
    if solved.is_none() {
        let unknowns = unknown_variables(system, determined, &variables)?;
        variables.extend(unknowns);
    }
    let accelerations = match m {
        2 => highest.clone(),
        _ => system.coordinates.iter().map(|c| c.a).collect(),
    };
    let mut equations = Equations::in_velocities(name, system, accelerations);
    equations.variables = variables;
    equations.highest = highest;
    equations.conditions = lifted_conditions(system, m);
    equations
        .conditions
        .extend(determined.conditions.iter().cloned());
    if solved.is_none() {
        let pairs = determined.equations.iter().copied();
        equations.relations = pairs.zip(determined.unknowns.iter().copied()).collect();
    }
    Ok(equations)
}

fn solve(basis: &Basis<'_>, determined: &Determined) -> Result<Vec<Expr>, DeriveError> {
    let g = &basis.system.graph;
    let n = basis.system.n();
    if let Some(orders) = &determined.multiplier_orders {
        // What multiplies the multipliers is known, and free of the unknowns. An equation that is differentiated less often
        // than a multiplier does not contain the derivative that is solved for.
        let mut jacobian = basis.jacobian();
        for (row, &order) in jacobian.iter_mut().zip(orders) {
            let entries = row.iter_mut().zip(&determined.times);
            entries
                .filter(|(_, &times)| times < order)
                .for_each(|(entry, _)| *entry = g.zero());
        }
        let multipliers: Vec<(Expr, Expr)> = determined.unknowns[n..]
            .iter()
            .map(|&s| (g.symbol_expr(s), g.zero()))
            .collect();
        let equations = g.substitute_all(&determined.equations, &multipliers);
        let (mut found, values) =
            solve_with_multipliers(g, &equations, &determined.unknowns[..n], &jacobian)?;
        found.extend(values);
        return Ok(found);
    }
    Ok(solve_linear(
        g,
        &determined.equations,
        &determined.unknowns,
    )?)
}

/// q', …, q^(m-1) with their rates.
fn jet_variables(system: &System, m: u32, highest: &[Expr]) -> Vec<StateVariable> {
    let g = &system.graph;
    let mut variables = Vec::new();
    for order in 1..m {
        for (c, &last) in system.coordinates.iter().zip(highest) {
            let value = g.symbol(&c.name, order);
            variables.push(StateVariable {
                name: g.symbol_text(g.intern_symbol(&c.name, order)),
                value,
                symbol: g.intern_symbol(&c.name, order),
                rate: match order + 1 == m {
                    true => last,
                    false => g.symbol(&c.name, order + 1),
                },
                definition: (order == 1).then_some(value),
            });
        }
    }
    variables
}

/// λ, λ', … of orders below those solved for.
fn multiplier_variables(
    basis: &Basis<'_>,
    determined: &Determined,
    in_state: &dyn Fn(Expr) -> Expr,
) -> Vec<StateVariable> {
    let g = &basis.system.graph;
    let names = basis.multiplier_names();
    let orders = determined.multiplier_orders.iter().flatten();
    let pairs: Vec<(&String, u32)> = names.iter().zip(orders.copied()).collect();
    let highest = pairs.iter().map(|(_, order)| *order).max().unwrap_or(0);
    let mut variables = Vec::new();
    for order in 0..highest {
        for (name, _) in pairs.iter().filter(|(_, own)| order < *own) {
            let symbol = g.intern_symbol(name, order);
            variables.push(StateVariable {
                name: g.symbol_text(symbol),
                value: g.symbol_expr(symbol),
                symbol,
                rate: in_state(g.symbol(name, order + 1)),
                definition: None,
            });
        }
    }
    variables
}

/// Unknowns u that stay implicit, `E(t, y, u) = 0`, as variables: `∂E/∂u u' = -(∂E/∂t + ∂E/∂y y')`.
fn unknown_variables(
    system: &System,
    determined: &Determined,
    known: &[StateVariable],
) -> Result<Vec<StateVariable>, DeriveError> {
    let g = &system.graph;
    let mut rates: FxHashMap<Symbol, Expr> = known.iter().map(|x| (x.symbol, x.rate)).collect();
    rates.extend(system.coordinates.iter().map(|c| (c.q_symbol, c.v)));
    let moved = g.derive(&determined.equations, &|s| {
        if let Some(&rate) = rates.get(&s) {
            Some(rate)
        } else {
            system.prescribed_rate(s)
        }
    });
    let matrix = g
        .jacobian(&determined.equations, &determined.unknowns)
        .concat();
    let right: Vec<Expr> = moved.into_iter().map(|e| g.neg(e)).collect();
    let values = g.solve(&matrix, &right)?;
    let pairs = determined.unknowns.iter().zip(values);
    Ok(pairs
        .map(|(&symbol, rate)| StateVariable {
            name: g.symbol_text(symbol),
            value: g.symbol_expr(symbol),
            symbol,
            rate,
            definition: None,
        })
        .collect())
}

/// Constraints of lower order, and their derivatives below m.
fn lifted_conditions(system: &System, m: u32) -> Vec<NamedExpr> {
    lifting::conditions(system, m)
        .into_iter()
        .map(|condition| {
            let name = &system.constraints[condition.constraint].name;
            let what = format!("the constraint `{name}`");
            let meaning = differentiated_so(&what, condition.derivatives);
            let primes = "'".repeat(condition.derivatives as usize);
            NamedExpr::new(format!("{name}{primes}"), condition.value, meaning)
        })
        .collect()
}

pub(super) fn balance_condition(label: &str, times: u32, value: Expr) -> NamedExpr {
    let meaning = differentiated_so(&format!("the equation of motion of {label}"), times);
    let name = format!("balance of {label}{}", "'".repeat(times as usize));
    NamedExpr::new(name, value, meaning)
}
