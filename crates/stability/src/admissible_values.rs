//! Which values of a parameter the model admits: what it assumes, along the motion and with the values of the other parameters, and those for
//! which the motion and what the model states of forces and constraints are real.

use crate::growth::flattened;
use crate::isolation::Root;
use crate::parameter_values::values_but;
use crate::real_roots::{bound_of, decimal, real_roots, sign_at, sign_of, sign_over};
use crate::real_values::{conditions, corners, Condition};
use crate::steady::closed;
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{SteadyMotion, System};
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// What is assumed of one parameter.
#[derive(Clone, Debug)]
pub(crate) struct AdmissibleValues {
    symbol: Symbol,
    /// Functions of the parameter with how they are to compare with zero.
    conditions: Vec<Condition>,
    /// Functions of the parameter at whose zeros the model is not smooth about the motion.
    corners: Vec<Expr>,
}

/// Values of several parameters for which a motion is: it and what the model states are real, and nothing that is assumed fails.
#[derive(Clone, Debug)]
pub struct AdmissiblePlaces {
    conditions: Vec<Condition>,
}

impl AdmissiblePlaces {
    /// Those of a motion with these values of the other parameters.
    pub fn new(
        system: &System,
        motion: &SteadyMotion,
        values: &[(Expr, Expr)],
    ) -> AdmissiblePlaces {
        let (real, assumed) = conditions_along(system, motion, values);
        let is_open = |own: &Condition| !system.graph.symbols_in(&[own.function]).is_empty();
        let all = real.into_iter().chain(assumed).filter(is_open);
        AdmissiblePlaces {
            conditions: all.collect(),
        }
    }

    /// Whether the motion is at these values, in double precision. What contains other symbols is not looked at.
    pub fn contain(&self, g: &Graph, value: &dyn Fn(Symbol) -> Option<f64>) -> bool {
        self.conditions.iter().all(|own| {
            let is_known = |symbol: &Symbol| value(*symbol).is_some();
            if !g.symbols_in(&[own.function]).iter().all(is_known) {
                return true;
            }
            let found = g.evaluate_f64(&[own.function], value).ok();
            let sign = found.and_then(|found| found.first()?.partial_cmp(&0.0));
            sign.is_some_and(|sign| own.holds(sign))
        })
    }
}

/// Values of a parameter for which the model makes sense, and what it assumes in addition or leaves out.
pub(crate) struct Reality {
    /// Where all values are real.
    pub(crate) real: AdmissibleValues,
    /// What is assumed.
    pub(crate) assumed: AdmissibleValues,
}

impl Reality {
    /// In words where the model is real, where it is not for all values that are assumed; `None` where it is, or that was not decided.
    pub(crate) fn restriction(&self, g: &Graph) -> Option<String> {
        let functions = [self.real.functions(), self.assumed.functions()].concat();
        if self.real.conditions.is_empty() {
            return None;
        }
        match self.intervals(g, &functions) {
            Some(Intervals {
                is_everywhere: true,
                ..
            }) => None,
            Some(found) if !found.words.is_empty() => Some(found.words.join(" or ")),
            _ => {
                let all: Vec<String> = self.real.conditions.iter().map(|own| own.text(g)).collect();
                Some(all.join(" and "))
            }
        }
    }

    /// Where both hold, and whether the model is real for all values that are assumed; `None` where that was not decided.
    fn intervals(&self, g: &Graph, functions: &[Expr]) -> Option<Intervals> {
        let symbol = self.real.symbol;
        let bound = bound_of(g, functions, symbol)?;
        let low = -bound.clone();
        let mut roots: Vec<Root> = Vec::new();
        for &e in functions {
            roots.extend(real_roots(g, e, symbol, &low, &bound)?);
        }
        roots.sort_by(|a, b| a.low.cmp(&b.low));
        roots.dedup();
        let lows = std::iter::once(&low).chain(roots.iter().map(|r| &r.high));
        let highs = roots.iter().map(|r| &r.low).chain([&bound]);
        // Intervals and the roots between them, in turn.
        let mut admitted = Vec::new();
        let mut is_everywhere = true;
        for (at, (low, high)) in lows.zip(highs).enumerate() {
            let sample = (low + high) / RBig::from(2);
            let is_assumed = self.assumed.contains(g, &sample)?;
            let is_real = self.real.contains(g, &sample)?;
            is_everywhere &= is_real || !is_assumed;
            admitted.push(is_assumed && is_real);
            if let Some(root) = roots.get(at) {
                let of = |own: &AdmissibleValues| own.contains_root(g, root, &[]);
                admitted.push(of(&self.assumed)? && of(&self.real)?);
            }
        }
        let name = g.symbol_text(symbol);
        Some(Intervals {
            is_everywhere,
            words: runs(&admitted)
                .into_iter()
                .map(|run| between(&name, run, &roots))
                .collect(),
        })
    }
}

/// Where a model is real and what it assumes holds.
struct Intervals {
    /// Whether it is real for all values that are assumed.
    is_everywhere: bool,
    /// Each interval in words.
    words: Vec<String>,
}

/// The first and the last place of each run of what is so.
fn runs(all: &[bool]) -> Vec<(usize, usize)> {
    let mut found: Vec<(usize, usize)> = Vec::new();
    for at in (0..all.len()).filter(|&at| all[at]) {
        match found.last_mut() {
            Some(last) if last.1 + 1 == at => last.1 = at,
            _ => found.push((at, at)),
        }
    }
    found
}

/// `1 <= W < 2`: a run in the list of intervals and the roots between them, which have the odd places.
fn between(name: &str, (first, last): (usize, usize), roots: &[Root]) -> String {
    let number = |at: usize| roots.get(at).map(|root| decimal(&root.low));
    let (starts_at_root, ends_at_root) = (first % 2 == 1, last % 2 == 1);
    let low = (first + 1)
        .checked_div(2)
        .and_then(|own| own.checked_sub(1));
    let (low, high) = (low.and_then(number), number(last / 2));
    let sign = |is_in: bool| if is_in { "<=" } else { "<" };
    match (low, high) {
        (Some(a), Some(_)) if first == last && starts_at_root => format!("{name} = {a}"),
        (Some(a), Some(b)) => {
            let (from, to) = (sign(starts_at_root), sign(ends_at_root));
            format!("{a} {from} {name} {to} {b}")
        }
        (Some(a), None) if starts_at_root => format!("{name} >= {a}"),
        (Some(a), None) => format!("{name} > {a}"),
        (None, Some(b)) => format!("{name} {} {b}", sign(ends_at_root)),
        (None, None) => format!("{name} is any number"),
    }
}

impl AdmissibleValues {
    /// The assumptions in which nothing but this parameter is left, and where all values are real.
    pub(crate) fn new(system: &System, motion: &SteadyMotion, symbol: Symbol) -> AdmissibleValues {
        let Reality { real, assumed } = AdmissibleValues::reality(system, motion, symbol);
        let corners = corners_along(system, motion, &values_but(system, Some(symbol)));
        let corners = AdmissibleValues::of(system, symbol, corners);
        AdmissibleValues {
            symbol,
            conditions: [assumed.conditions, real.conditions].concat(),
            corners: corners.functions(),
        }
    }

    /// The same apart.
    pub(crate) fn reality(system: &System, motion: &SteadyMotion, symbol: Symbol) -> Reality {
        let (real, assumed) = conditions_along(system, motion, &values_but(system, Some(symbol)));
        Reality {
            real: AdmissibleValues::of(system, symbol, real),
            assumed: AdmissibleValues::of(system, symbol, assumed),
        }
    }

    /// Those of some conditions in which nothing but this parameter is left.
    fn of(system: &System, symbol: Symbol, all: Vec<Condition>) -> AdmissibleValues {
        let g = &system.graph;
        let is_own = |own: &Condition| g.symbols_in(&[own.function]).into_iter().eq([symbol]);
        let all = all.into_iter().filter(is_own);
        let parts = all.flat_map(|own| own.without_poles(g)).filter(is_own);
        let mut conditions: Vec<Condition> = Vec::new();
        for own in parts {
            if !conditions.contains(&own) {
                conditions.push(own);
            }
        }
        AdmissibleValues {
            symbol,
            conditions,
            corners: Vec::new(),
        }
    }

    /// The functions at whose zeros something that is assumed begins or ceases to hold, or the model is not smooth.
    pub(crate) fn functions(&self) -> Vec<Expr> {
        let conditions = self.conditions.iter().map(|own| own.function);
        conditions.chain(self.corners.iter().copied()).collect()
    }

    /// Whether the model may not be smooth about the motion at the value that an interval encloses: then linear equations say nothing.
    pub(crate) fn has_corner(&self, g: &Graph, root: &Root) -> bool {
        let is_open = |&e: &Expr| {
            let sign = if root.low == root.high {
                sign_at(g, e, self.symbol, &root.low)
            } else {
                sign_over(g, e, self.symbol, root)
            };
            !matches!(sign, Some(Ordering::Less | Ordering::Greater))
        };
        self.corners.iter().any(is_open)
    }

    /// Where something that is assumed begins or ceases to hold; `None` where that was not decided.
    pub(crate) fn ends(&self, g: &Graph) -> Option<Vec<Root>> {
        let of = |e: Expr| {
            let bound = bound_of(g, &[e], self.symbol)?;
            real_roots(g, e, self.symbol, &-bound.clone(), &bound)
        };
        let all: Option<Vec<Vec<Root>>> = self.functions().into_iter().map(of).collect();
        Some(all?.concat())
    }

    /// Whether a value satisfies everything; `None` where that was not decided.
    pub(crate) fn contains(&self, g: &Graph, at: &RBig) -> Option<bool> {
        self.all(|e| sign_at(g, e, self.symbol, at))
    }

    /// Whether the value that an interval encloses satisfies everything; `None` where that was not decided. It is a zero of one of the
    /// [`functions`](AdmissibleValues::functions) or of these others.
    pub(crate) fn contains_root(&self, g: &Graph, root: &Root, others: &[Expr]) -> Option<bool> {
        if root.low == root.high {
            return self.contains(g, &root.low);
        }
        let sign = |e: Expr| sign_over(g, e, self.symbol, root);
        let mut open = self
            .conditions
            .iter()
            .filter(|own| sign(own.function).is_none());
        let is_of_one = open.next().is_some() && open.next().is_none();
        let is_of_no_other = || others.iter().all(|&e| sign(e).is_some());
        let is_own = is_of_one && is_of_no_other();
        self.all(|e| sign(e).or_else(|| is_own.then_some(Ordering::Equal)))
    }

    fn all(&self, sign: impl Fn(Expr) -> Option<Ordering>) -> Option<bool> {
        let holds = |own: &Condition| Some(own.holds(sign(own.function)?));
        let found: Vec<Option<bool>> = self.conditions.iter().map(holds).collect();
        if found.contains(&Some(false)) {
            return Some(false);
        }
        let all: Option<Vec<bool>> = found.into_iter().collect();
        all.map(|_| true)
    }
}

/// Where a motion and what the model states of forces and constraints are real, and what is assumed: along the motion, with these values of
/// parameters.
fn conditions_along(
    system: &System,
    motion: &SteadyMotion,
    values: &[(Expr, Expr)],
) -> (Vec<Condition>, Vec<Condition>) {
    let g = &system.graph;
    let place = place_of(system, motion);
    let put = |own: Condition| Condition {
        function: closed(g, g.substitute(g.substitute(own.function, &place), values)),
        ..own
    };
    let mut stated: Vec<Expr> = place.iter().map(|(_, value)| *value).collect();
    stated.extend(values.iter().map(|(_, value)| *value));
    stated.push(system.lagrangian);
    stated.extend(&system.forces);
    stated.extend(system.constraints.iter().map(|own| own.stated));
    let assumed = system.assumptions.iter().map(|own| Condition {
        function: g.sub(own.left, own.right),
        relation: own.relation,
    });
    (
        conditions(g, &stated).into_iter().map(put).collect(),
        assumed.map(put).collect(),
    )
}

/// Positions and velocities of a motion.
pub(crate) fn place_of(system: &System, motion: &SteadyMotion) -> Vec<(Expr, Expr)> {
    let coordinates = system.coordinates.iter();
    let positions = coordinates.clone().map(|own| own.q).zip(&motion.positions);
    let velocities = coordinates.map(|own| own.v).zip(&motion.velocities);
    let stated = positions.chain(velocities);
    stated
        .filter_map(|(own, value)| value.map(|value| (own, value)))
        .collect()
}

/// What may not vanish along a motion, so that what the model states is smooth about it: there the linear equations say nothing.
fn corners_along(
    system: &System,
    motion: &SteadyMotion,
    values: &[(Expr, Expr)],
) -> Vec<Condition> {
    let g = &system.graph;
    let place = place_of(system, motion);
    let put = |e: Expr| closed(g, g.substitute(g.substitute(e, &place), values));
    let vanishes = |e: Expr| Some(g.is_zero(put(e)));
    let mut stated = system.forces.clone();
    stated.extend(system.constraints.iter().map(|own| own.stated));
    stated.extend(system.controls.iter().filter_map(|own| own.law));
    let mut left = flattened(g, &stated, 1, &vanishes).functions;
    left.extend(flattened(g, &[system.lagrangian], 2, &vanishes).functions);
    // A root of a parameter has no corner in the state.
    let state = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    let all = corners(g, &left).into_iter().map(|(_, inside)| inside);
    let all = all.filter(|&inside| g.contains_any(inside, &state));
    all.map(|inside| Condition {
        function: put(inside),
        relation: Relation::NotEqual,
    })
    .collect()
}

/// The first of these numbers that is proved not to be real.
pub(crate) fn not_real(g: &Graph, es: &[Expr]) -> Option<Expr> {
    let fails = |own: &Condition| {
        g.symbols_in(&[own.function]).is_empty()
            && sign_of(g, own.function).is_some_and(|sign| !own.holds(sign))
    };
    let mut es = es.iter().copied();
    es.find(|&e| conditions(g, &[e]).iter().any(fails))
}
