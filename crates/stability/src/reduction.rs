//! The smallest closed system of variables: the quasi-velocities, and the coordinates on which their rates depend.
//!
//! `M P' = b` in independent quasi-velocities P; coordinates on which M and b do not depend are ignorable, and a coordinate that is
//! not ignorable brings its own rate, which may depend on further ones. What is left out moves by quadratures.

use crate::problem::LinearizationError;
use crate::singular::least_part;
use chetaev_mechanics::characteristics::Characteristics;
use chetaev_mechanics::mass;
use chetaev_mechanics::reduced_equations::ReducedEquations;
use chetaev_mechanics::regular::{regular, regular_as_stated};
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::{MotionTerms, Selection, System};
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Rational, Symbol, Verdict};
use nalgebra::{DMatrix, RowDVector};
use std::collections::BTreeMap;

/// Which speeds are variables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Speeds {
    /// The quasi-velocities of the model where the velocities by them are finite at the motion; else such as need no division by anything that
    /// changes, where they are found; else independent velocities, if need be those for which the constraints are best conditioned at the motion.
    #[default]
    Suitable,
    /// The velocities that the selection leaves independent.
    Independent,
}

/// The state about which a closed system must serve.
#[derive(Clone, Copy, Debug)]
pub struct OperatingPoint<'a> {
    /// Values of symbols in numbers.
    pub numbers: &'a [(Symbol, f64)],
    /// Coordinates without a position. At the first of these that is not ignorable the system ends as it is: there are no linear equations then.
    pub open: &'a [usize],
}

/// `M P' = b` with the rates of the coordinates that occur.
#[derive(Clone, Debug)]
pub struct ClosedSystem {
    /// The quasi-velocities P.
    pub characteristics: Characteristics,
    /// The coordinates that are not ignorable, ascending.
    pub coordinates: Vec<usize>,
    /// Their rates, functions of the variables.
    pub rates: Vec<Expr>,
    /// M and b.
    pub equations: ReducedEquations,
}

impl ClosedSystem {
    /// The closed system of a system of first order whose masses have no laws of their own, in speeds of choice; `operating` is the state about
    /// which they must serve.
    ///
    /// # Errors
    /// [`LinearizationError`] where there is none.
    pub fn about(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        (speeds, operating): (Speeds, OperatingPoint<'_>),
    ) -> Result<ClosedSystem, LinearizationError> {
        let point = operating.numbers;
        if terms.order > 1 {
            return Err(LinearizationError::OrderTooHigh { order: terms.order });
        }
        if !system.masses.is_empty() || mass::with_velocity(system).is_some() {
            return Err(LinearizationError::MassesMove);
        }
        let serves = |c: &Characteristics| is_finite(&system.graph, c, point);
        let suitable = || {
            let stated = Characteristics::quasi_velocities(system, terms, selection);
            let stated = stated.and_then(Result::ok).filter(serves);
            let rows = &selection.rows;
            stated
                .or_else(|| regular(system, terms, rows))
                .or_else(|| regular_as_stated(system, terms, rows))
        };
        let independent = |selection: &Selection| {
            Characteristics::independent_velocities(system, terms, selection)
        };
        let characteristics = match speeds {
            Speeds::Suitable => match suitable() {
                Some(found) => found,
                None => {
                    let chosen = independent(selection);
                    if chosen.as_ref().is_ok_and(serves) {
                        chosen?
                    } else {
                        independent(
                            &conditioned(system, terms, selection, point)
                                .unwrap_or_else(|| selection.clone()),
                        )?
                    }
                }
            },
            Speeds::Independent => independent(selection)?,
        };
        let equations = ReducedEquations::new(system, &characteristics)
            .unwrap_or_else(|| ReducedEquations::of_terms(system, terms, &characteristics));
        let standing = standing(system, &characteristics, point);
        Ok(ClosedSystem::closed(
            system,
            characteristics,
            &equations,
            (&standing, operating.open),
        ))
    }

    fn closed(
        system: &System,
        characteristics: Characteristics,
        equations: &ReducedEquations,
        (standing, open): (&[usize], &[usize]),
    ) -> ClosedSystem {
        let g = &system.graph;
        let k = characteristics.k();
        let mut entries = equations.entries();
        let mut coordinates: Vec<usize> = standing.to_vec();
        entries.extend(standing.iter().map(|&j| characteristics.velocities[j]));
        while let Some(j) = (0..system.n()).find(|j| {
            !coordinates.contains(j)
                && g.any_contains_any(&entries, &[system.coordinates[*j].q_symbol])
        }) {
            match without(g, &entries, system.coordinates[j].q) {
                Some(free) => entries = free,
                None => {
                    coordinates.push(j);
                    entries.push(characteristics.velocities[j]);
                    if open.contains(&j) {
                        break;
                    }
                }
            }
        }
        let rates = entries.split_off(k * k + k);
        let force = entries.split_off(k * k);
        let mut places: Vec<usize> = (0..coordinates.len()).collect();
        places.sort_by_key(|&at| coordinates[at]);
        ClosedSystem {
            rates: places.iter().map(|&at| rates[at]).collect(),
            coordinates: places.iter().map(|&at| coordinates[at]).collect(),
            equations: ReducedEquations {
                mass: entries.chunks(k.max(1)).map(<[Expr]>::to_vec).collect(),
                force,
            },
            characteristics,
        }
    }

    /// The quasi-velocities with their values where all velocities vanish.
    pub fn speeds_at_rest(&self, system: &System) -> Vec<(Expr, Expr)> {
        let g = &system.graph;
        let zero = |c: &Coordinate| (c.v, g.zero());
        let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(zero).collect();
        let speeds = self.characteristics.parameters.iter();
        let own = speeds.map(|p| {
            (
                g.symbol_expr(p.symbol),
                g.substitute(p.definition, &at_rest),
            )
        });
        own.chain(at_rest.iter().copied()).collect()
    }

    /// The coordinates that are ignorable, ascending.
    pub fn ignorable(&self, system: &System) -> Vec<usize> {
        let all = 0..system.n();
        all.filter(|j| !self.coordinates.contains(j)).collect()
    }
}

/// Coordinates whose rates depend on themselves, as the angle at the hitch of a trailer without mass does: they move by no quadrature, whether
/// forces depend on them or not. Such are those at rest in the motion, and all that run by themselves where the quasi-velocities vanish, as
/// `p' = 1/4 − sin p` does: no symmetry makes that run uniform. The angles of a ball that spins depend on themselves too, and are ignorable: their
/// rates are linear in the quasi-velocities.
fn standing(system: &System, c: &Characteristics, point: &[(Symbol, f64)]) -> Vec<usize> {
    let g = &system.graph;
    let find = |s: Symbol| {
        point
            .iter()
            .find(|(own, _)| *own == s)
            .map(|(_, value)| *value)
    };
    let speeds: Vec<f64> = {
        let definitions: Vec<Expr> = c.parameters.iter().map(|p| p.definition).collect();
        g.evaluate_f64(&definitions, &|s| find(s).or(Some(SOMEWHERE)))
            .unwrap_or_default()
    };
    let value = |s: Symbol| {
        let own = c.parameters.iter().position(|p| p.symbol == s);
        own.and_then(|at| speeds.get(at).copied())
            .or_else(|| find(s))
            .or(Some(SOMEWHERE))
    };
    let still: Vec<(Expr, Expr)> = c.parameters.iter().map(|p| (p.value, g.zero())).collect();
    let drifts = g.substitute_all(&c.velocities, &still);
    let is_standing = |&j: &usize| {
        let coordinate = &system.coordinates[j];
        let rate = c.velocities[j];
        if without(g, &[drifts[j]], coordinate.q).is_none() {
            return true;
        }
        let moved = || {
            g.evaluate_f64(&[rate], &value)
                .map_or(f64::NAN, |found| found[0])
        };
        find(coordinate.q_symbol).is_some()
            && without(g, &[rate], coordinate.q).is_none()
            && moved().abs() < AT_REST
    };
    (0..system.n()).filter(is_standing).collect()
}

/// A rate below this is none; whether it vanishes is decided exactly where the coordinate is a variable.
const AT_REST: f64 = 1e-9;

/// Whether the velocities by these quasi-velocities are finite at a state; coordinates that it does not know are ignorable there, and
/// somewhere.
fn is_finite(g: &Graph, c: &Characteristics, point: &[(Symbol, f64)]) -> bool {
    let known = |s: Symbol| {
        point
            .iter()
            .find(|(own, _)| *own == s)
            .map(|(_, value)| *value)
    };
    let value = |s: Symbol| known(s).or(Some(SOMEWHERE));
    let found = g.evaluate_f64(&c.basis.concat(), &value);
    found.is_ok_and(|found| found.iter().all(|x| x.abs() < LARGEST_SLOPE))
}

/// The dependent velocities for which the constraints are best conditioned at a state: the columns that elimination with exchanges of rows
/// and columns takes first.
pub fn conditioned(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    point: &[(Symbol, f64)],
) -> Option<Selection> {
    let known = |s: Symbol| {
        point
            .iter()
            .find(|(own, _)| *own == s)
            .map(|(_, value)| *value)
    };
    let rows: Vec<Expr> = selection
        .rows
        .iter()
        .flat_map(|&row| terms.jacobian[row].clone())
        .collect();
    let values = system
        .graph
        .evaluate_f64(&rows, &|s| known(s).or(Some(SOMEWHERE)))
        .ok()?;
    let (r, n) = (selection.rows.len(), system.n());
    let mut order = RowDVector::from_iterator(n, (0..n).map(|j| j as f64));
    DMatrix::from_row_slice(r, n, &values)
        .full_piv_lu()
        .q()
        .permute_columns(&mut order);
    let mut dependent: Vec<usize> = order.iter().take(r).map(|&j| j as usize).collect();
    dependent.sort_unstable();
    Some(Selection {
        rows: selection.rows.clone(),
        dependent,
    })
}

/// Whether functions of the velocities are linear in them and with the constraints independent, so that they may serve as speeds, at almost all
/// states.
pub fn may_be_speeds(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    speeds: &[Expr],
) -> bool {
    let (g, n) = (&system.graph, system.n());
    let velocities = system.velocity_symbols();
    let own = g.jacobian(speeds, &velocities);
    if own.iter().any(|row| g.any_contains_any(row, &velocities)) {
        return false;
    }
    let constraints = selection
        .rows
        .iter()
        .map(|&row| terms.jacobian[row].clone());
    let rows: Vec<Vec<Expr>> = constraints.chain(own).collect();
    if rows.len() != n {
        return false;
    }
    let entries = rows.concat();
    let mut generator = Generator::new(0x005b_eed5);
    (0..PLACES_OF_SPEEDS).any(|_| {
        let symbols = g.symbols_in(&entries).into_iter();
        let values: BTreeMap<Symbol, f64> =
            symbols.map(|s| (s, generator.between(0.3, 1.3))).collect();
        let found = g.evaluate_f64(&entries, &|s| values.get(&s).copied());
        found.is_ok_and(|found| least_part(&DMatrix::from_row_slice(n, n, &found)) > SINGULAR)
    })
}

/// States at which speeds are looked at.
const PLACES_OF_SPEEDS: usize = 4;
/// A smaller part of the largest singular value is rounding.
const SINGULAR: f64 = 1e-11;

/// A place of a coordinate on which nothing depends.
const SOMEWHERE: f64 = 0.377;
/// A slope beyond this is taken for a pole that rounding hides.
const LARGEST_SLOPE: f64 = 1e12;

/// The expressions with a number for a symbol on which they are proved not to depend: zero, or one where they have no form at zero, as the
/// velocities of Euler's angles.
pub(crate) fn without(g: &Graph, es: &[Expr], symbol: Expr) -> Option<Vec<Expr>> {
    [0, 1]
        .into_iter()
        .find_map(|value| with_number(g, es, symbol, g.integer(value)))
}

fn with_number(g: &Graph, es: &[Expr], symbol: Expr, number: Expr) -> Option<Vec<Expr>> {
    if changes(g, es, symbol) {
        return None;
    }
    let at_zero = g.substitute_all(es, &[(symbol, number)]);
    let pairs = es.iter().zip(&at_zero);
    let differences: Vec<Expr> = pairs.map(|(&a, &b)| g.sub(a, b)).collect();
    let none = Assumptions::new();
    let test = ZeroTest::everywhere(&differences, &none);
    let options = chetaev_symbolic::zero::Options {
        exact: false,
        refute: false,
        ..test.options
    };
    let verdict = decide_zero(g, &ZeroTest { options, ..test });
    matches!(verdict, Verdict::Proved(_)).then_some(at_zero)
}

/// Whether expressions depend on a symbol, where two places show it: doubles say which one may, and balls prove that it does. Then no proof of
/// the contrary need be sought.
fn changes(g: &Graph, es: &[Expr], symbol: Expr) -> bool {
    let Some(moved) = g.as_symbol(symbol) else {
        return false;
    };
    let mut generator = Generator::new(0x5749_5448);
    let others = g.symbols_in(es).into_iter();
    let others: BTreeMap<Symbol, f64> = others.map(|s| (s, generator.between(0.5, 1.5))).collect();
    let place = |s: Symbol, at: f64| {
        let own = (s == moved).then_some(at);
        own.or_else(|| others.get(&s).copied())
    };
    let numbers = |at: f64| g.evaluate_f64(es, &|s| place(s, at)).ok();
    let [Some(one), Some(other)] = PLACES.map(numbers) else {
        return false;
    };
    let differs = |a: f64, b: f64| {
        let difference = (a - b).abs();
        difference.is_finite() && difference > 1e-6 * (a.abs() + b.abs())
    };
    let pairs = one.iter().zip(&other).enumerate();
    let changed = pairs.filter(|(_, (&a, &b))| differs(a, b));
    let smallest = changed.min_by_key(|&(at, _)| g.reachable(&[es[at]]).len());
    let Some((first, _)) = smallest else {
        return false;
    };
    let precision = Precision::new(64);
    let ball = |at: f64| {
        let exact = |s: Symbol| Some(precision.rational(&Rational::try_from(place(s, at)?).ok()?));
        g.enclose(&[es[first]], &precision, &exact).ok()?.pop()
    };
    let [Some(one), Some(other)] = PLACES.map(ball) else {
        return false;
    };
    precision
        .sub(&one, &other)
        .is_ok_and(|own| own.excludes_zero())
}

/// Two places of a coordinate.
const PLACES: [f64; 2] = [0.4, 1.1];
