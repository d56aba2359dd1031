//! `liouville.integrable`: enough first integrals and an invariant measure for integration by quadratures (Euler, Jacobi).
//!
//! A motion of m variables with m - 2 independent integrals and an invariant measure is integrated by quadratures (Jacobi's last
//! multiplier); m - 1 integrals need no measure. Coordinates on which neither the rates of the others nor their own depend are
//! left out first (Routh's ignorable coordinates, also where their momenta are no integrals, as for rolling bodies); they
//! follow by quadratures at the end, and so do turns of coordinates under which the motion is symmetric (`turns`). Masses
//! with a law of their own are variables like the coordinates.

mod involution;
mod kept;
mod turns;

use crate::integrability::on_its_own;
use crate::measure::{at_stated_values, measure};
use crate::noether::cyclic::cyclic;
use crate::noether::embedded::Embedded;
use crate::noether::found::{found, Found};
use crate::noether::motion::Motion;
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::prover::is_stated;
use chetaev_mechanics::words::counted;
use chetaev_mechanics::Characteristics;
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::Pivots;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};
use involution::{in_involution, Involution};
use kept::Kept;
use turns::{turns, Around, Turn};

/// `liouville.integrable`.
#[derive(Clone, Copy, Debug)]
pub struct Liouville;

/// The motion without the coordinates that can be left out.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// Indices of the coordinates left out, and of masses with a law of their own, which count from n on.
    pub ignorable: Vec<usize>,
    /// The independent (quasi-)velocities that keep their values.
    pub constant: Vec<String>,
    /// The independent (quasi-)velocities whose momenta keep their values, since nothing drives them.
    pub cyclic: Vec<String>,
    /// m.
    pub variables: usize,
    /// Whether the time is one of them.
    pub timed: bool,
    /// Whether a measure counts whose density is zero or infinite at some states: one near each of the others.
    pub near_states: bool,
    /// Turns that are left out besides, of which this many are independent on the rest.
    turns: Vec<Turn>,
    chart: Characteristics,
    /// Rates of the independent velocities.
    rates: Vec<Expr>,
}

impl Reduced {
    /// What can be left out of the context's system.
    ///
    /// # Errors
    /// A sentence that says why the motion is not known.
    pub fn of(cx: &Context<'_>) -> Result<Reduced, String> {
        let (system, g) = (cx.system, &cx.system.graph);
        let motion = Motion::of(cx)?;
        let chart: Characteristics = basis(cx)
            .characteristics()
            .map_err(|problem| problem.to_string())?;
        let definitions: Vec<Expr> = chart.parameters.iter().map(|p| p.definition).collect();
        let rates = chart.restrict(system, &motion.derivatives(&definitions));
        // Velocities that stay implicit are functions of what their constraints contain.
        let ties: Vec<Expr> = chart.implicit().map(|(f, _)| f).collect();
        let free = |e: Expr, s: Symbol| is_free(cx, e, s);
        let symbols = system.coordinate_symbols().into_iter();
        let mut moving: Vec<(Symbol, Expr)> = symbols.zip(chart.velocities.clone()).collect();
        moving.extend(system.mass_rates(&chart.velocities));
        let mut ignorable: Vec<usize> = Vec::new();
        loop {
            let kept = |i: &usize| !ignorable.contains(i);
            let rest: Vec<usize> = (0..moving.len()).filter(kept).collect();
            let next = rest.iter().copied().find(|&i| {
                let s = moving[i].0;
                // Its own rate too: y' = y^2 + x asks for a Riccati equation, not for a quadrature.
                rates.iter().chain(&ties).all(|&e| free(e, s))
                    && rest.iter().all(|&j| free(moving[j].1, s))
            });
            match next {
                Some(i) => ignorable.push(i),
                None => break,
            }
        }
        let constant = chart
            .parameters
            .iter()
            .zip(&rates)
            .filter(|(_, &rate)| vanishes(cx, &chart, rate))
            .map(|(p, _)| p.name.clone())
            .collect();
        let cyclic = cyclic_velocities(cx).unwrap_or_default();
        let mut all = rates.clone();
        let rest = (0..moving.len()).filter(|i| !ignorable.contains(i));
        all.extend(rest.map(|i| moving[i].1).chain(ties));
        let is_state = |s: Symbol| moving.iter().any(|(own, _)| *own == s);
        let timed = g.as_symbol(g.symbol("t", 0)).is_some_and(|t| {
            let own = g.symbols_in(&all).into_iter();
            let mut prescribed =
                own.filter(|&s| s != t && system.prescribed_rate(s).is_some() && !is_state(s));
            prescribed.next().is_some() || !all.iter().all(|&e| free(e, t))
        });
        Ok(Reduced {
            variables: moving.len() - ignorable.len() + chart.k() + usize::from(timed),
            ignorable,
            constant,
            cyclic,
            timed,
            near_states: false,
            turns: Vec::new(),
            chart,
            rates,
        })
    }

    /// The same without turns under which the motion is symmetric, where there are any.
    fn without_turns(&self, cx: &Context<'_>) -> Option<Reduced> {
        let (system, g) = (cx.system, &cx.system.graph);
        let motion = Motion::of(cx).ok()?;
        let around = Around {
            motion: &motion,
            chart: &self.chart,
            rates: &self.rates,
            ignorable: &self.ignorable,
        };
        let turns = turns(cx, &around);
        let rest = (0..system.n()).filter(|i| !self.ignorable.contains(i));
        let rest: Vec<usize> = rest.collect();
        let row = |turn: &Turn| -> Vec<Expr> {
            let places = rest.iter().map(|&i| turn.coordinates[i]);
            places.chain(turn.speeds.iter().copied()).collect()
        };
        let rows: Vec<Vec<Expr>> = turns.iter().map(row).collect();
        if rows.iter().all(|row| row.iter().all(|&e| g.is_zero(e))) {
            return None;
        }
        let rank = cx.prover.rank(system, &rows, &self.chart.manifold).ok()?;
        let is_full = matches!(rank.at_least, Verdict::Proved(_)) && rank.minimum == turns.len();
        is_full.then(|| Reduced {
            variables: self.variables - turns.len(),
            turns,
            ..self.clone()
        })
    }

    /// How functions on the constraint manifold change along a turn.
    fn turned(&self, cx: &Context<'_>, es: &[Expr], turn: &Turn) -> Vec<Expr> {
        self.chart.along(cx.system, es, &turn.direction(cx))
    }
}

/// The names of the cyclic velocities; a system without an embedded form names none.
fn cyclic_velocities(cx: &Context<'_>) -> Result<Vec<String>, String> {
    let embedded = Embedded::of(cx)?;
    let speeds = &embedded.embedding.chart.parameters;
    let all = cyclic(cx, &embedded)?.into_iter();
    Ok(all.map(|i| speeds[i].name.clone()).collect())
}

/// The name and the symbol of a coordinate, or of a mass, which count from n on.
fn variable<'a>(cx: &Context<'a>, place: usize) -> (&'a str, Symbol) {
    let system = cx.system;
    match place.checked_sub(system.n()) {
        None => {
            let coordinate = &system.coordinates[place];
            (&coordinate.name, coordinate.q_symbol)
        }
        Some(place) => (&system.masses[place].name, system.masses[place].symbol),
    }
}

/// Whether an expression does not depend on a symbol, by its form or by its derivative; what jumps with it depends on it,
/// although its derivative vanishes almost everywhere.
fn is_free(cx: &Context<'_>, e: Expr, s: Symbol) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    if !g.contains_any(e, &[s]) {
        return true;
    }
    let jumps = |e: &Expr| match g.node(*e) {
        Node::Apply { function, .. } => *function == Function::Sign && g.contains_any(*e, &[s]),
        _ => false,
    };
    if g.reachable(&[e]).iter().any(jumps) {
        return false;
    }
    let slope = g.diff(e, s);
    let manifold = chetaev_mechanics::Manifold::default();
    let verdict = cx.prover.identity(system, &[slope], &manifold, "");
    matches!(verdict, Verdict::Proved(_))
}

fn vanishes(cx: &Context<'_>, chart: &Characteristics, e: Expr) -> bool {
    let verdict = cx.prover.identity(cx.system, &[e], &chart.manifold, "");
    matches!(verdict, Verdict::Proved(_))
}

impl Claim for Liouville {
    fn id(&self) -> &'static str {
        "liouville.integrable"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "Integrals and an invariant measure suffice for quadratures"
    }

    fn explanation(&self) -> &'static str {
        "A motion of m variables with m - 2 independent first integrals and an invariant measure is integrated by quadratures (Euler, Jacobi's last multiplier); with m - 1 integrals the measure is not needed. Where there are no constraints and no forces beside those of a Lagrangian free of the time, as many independent integrals in involution as there are coordinates suffice (Liouville). Coordinates on which no rate depends are left out before, and follow by quadratures at the end; so are turns of two coordinates, with shifts of others, that carry motions into motions, where the integrals do not suffice without, as those of the plane with the angle of a sleigh, whatever the velocities in which the motion is stated; independent velocities are called cyclic where nothing drives their momenta, which are integrals then, as those of ignorable coordinates are. The integrals counted are the functions of those that the search found which contain neither these coordinates nor, for a motion free of it, the time. Where they do not suffice for arbitrary parameters and more is kept for the values that the model states, all is counted for these, and the verdict is conditional on them. What is missing is stated; that no more integrals exist is never said."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.frame-regular".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        match counted_out(cx) {
            Ok(verdict) => verdict.into(),
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

/// The count for arbitrary parameters, or, where it does not suffice and the model states values for which more is kept, for these.
fn counted_out(cx: &Context<'_>) -> Result<Verdict, String> {
    let general = counted_for_all(cx)?;
    let is_open = matches!(general, Verdict::Undecided { .. });
    if !is_open || cx.is_out_of_time() || !says_more_as_stated(cx) {
        return Ok(general);
    }
    let Some((texts, Ok(valued))) = at_stated_values(cx, counted_for_all) else {
        return Ok(general);
    };
    // Where the integrals do not suffice for the values they do not for more.
    let suffice = matches!(valued, Verdict::Proved(_));
    let wider = suffice.then(|| at_a_condition(cx)).flatten();
    let (texts, valued) = wider.unwrap_or((texts, valued));
    let as_stated = format!("for {texts}, as the model states, ");
    let otherwise = format!("for arbitrary values {}", general.detail());
    Ok(match valued {
        Verdict::Proved(mut proof) | Verdict::Conditional { mut proof, .. } => {
            proof.detail = format!("{as_stated}{}; {otherwise}", proof.detail);
            Verdict::Conditional {
                condition: texts,
                proof,
                counterexample: None,
            }
        }
        other => Verdict::undecided(format!("{as_stated}{}; {otherwise}", other.detail())),
    })
}

/// The count for all parameters that satisfy one condition for which more integrals were found, as A = B, where the values that the model
/// states satisfy it and the integrals suffice: this says more than a count for these values.
fn at_a_condition(cx: &Context<'_>) -> Option<(String, Verdict)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let values = system.parameter_values();
    let found = found(cx);
    let special = &found.as_ref().as_ref().ok()?.special.found;
    let mut conditions: Vec<Vec<(Expr, Expr)>> = Vec::new();
    for own in special.iter().map(|special| special.tie.pairs(g)) {
        let holds = own.iter().all(|pair| is_stated(g, &values, pair));
        if holds && !conditions.contains(&own) {
            conditions.push(own);
        }
    }
    conditions.into_iter().find_map(|pairs| {
        let own = system.with_parameters(&pairs)?;
        let verdict = on_its_own(cx, &own, counted_for_all)?.ok()?;
        let texts = pairs.iter();
        let texts = texts.map(|&(p, value)| format!("{} = {}", g.text(p), g.text(value)));
        let texts = texts.collect::<Vec<String>>().join(" and ");
        matches!(verdict, Verdict::Proved(_)).then_some((texts, verdict))
    })
}

/// Whether an integral or a measure was found that only the values of parameters that the model states have.
fn says_more_as_stated(cx: &Context<'_>) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let measure = measure(cx);
    let by_measure = measure.as_ref().as_ref().is_ok_and(|m| m.as_stated);
    let values = system.parameter_values();
    let is_so = |pair: &(Expr, Expr)| is_stated(g, &values, pair);
    let more = |found: &Found| {
        let mut all = found.special.found.iter();
        all.any(|special| special.tie.pairs(g).iter().all(is_so))
    };
    by_measure || found(cx).as_ref().as_ref().is_ok_and(more)
}

/// The count with whatever is left out; what is said is of the fewest variables.
fn counted_for_all(cx: &Context<'_>) -> Result<Verdict, String> {
    let reduced = Reduced::of(cx)?;
    let mut verdict = counted_with_turns(cx, &reduced)?;
    if matches!(verdict, Verdict::Undecided { .. }) {
        let near_states = Reduced {
            near_states: true,
            ..reduced
        };
        let other = counted_with_turns(cx, &near_states)?;
        if !matches!(other, Verdict::Undecided { .. }) {
            verdict = other;
        }
    }
    Ok(match verdict {
        Verdict::Undecided { tried } => match in_involution(cx) {
            Some(Involution::Suffice(verdict)) => *verdict,
            Some(Involution::Missing(more)) => Verdict::undecided(format!("{tried}; {more}")),
            None => Verdict::Undecided { tried },
        },
        other => other,
    })
}

/// The count as it is, or, where that does not suffice, without turns.
fn counted_with_turns(cx: &Context<'_>, reduced: &Reduced) -> Result<Verdict, String> {
    let verdict = counted_with_time(cx, reduced)?;
    if matches!(verdict, Verdict::Proved(_)) {
        return Ok(verdict);
    }
    match reduced.without_turns(cx) {
        Some(turned) => counted_with_time(cx, &turned),
        None => Ok(verdict),
    }
}

fn counted_with_time(cx: &Context<'_>, reduced: &Reduced) -> Result<Verdict, String> {
    let verdict = counted_for(cx, reduced)?;
    if reduced.timed || matches!(verdict, Verdict::Proved(_)) {
        return Ok(verdict);
    }
    // Integrals and a density that contain the time are those of a motion with one variable more.
    let extended = Reduced {
        timed: true,
        variables: reduced.variables + 1,
        ..reduced.clone()
    };
    Ok(match counted_for(cx, &extended)? {
        Verdict::Proved(proof) => Verdict::Proved(proof),
        _ => verdict,
    })
}

fn counted_for(cx: &Context<'_>, reduced: &Reduced) -> Result<Verdict, String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let found = found(cx);
    let found = found.as_ref().as_ref().map_err(Clone::clone)?;
    let mut excluded: Vec<Symbol> = reduced
        .ignorable
        .iter()
        .map(|&i| variable(cx, i).1)
        .collect();
    if !reduced.timed {
        excluded.extend(g.as_symbol(g.symbol("t", 0)));
    }
    let counts = |e: Expr| excluded.iter().all(|&s| is_free(cx, e, s));
    // What holonomic constraints fix keeps its value as integrals do.
    let mut values = system.fixed_functions();
    values.extend(found.integrals.iter().map(|i| i.value));
    let values = reduced.chart.restrict(system, &values);
    let is_kept = |e: Expr| {
        let mut turns = reduced.turns.iter();
        turns.all(|turn| vanishes(cx, &reduced.chart, reduced.turned(cx, &[e], turn)[0]))
    };
    let free = values.iter().filter(|&&e| counts(e) && is_kept(e)).count();
    let constant = match reduced.turns.is_empty() {
        true => reduced.constant.len(),
        false => 0,
    };
    let themselves = free.max(constant);
    let many = invariant(cx, reduced, &values).unwrap_or(0).max(themselves);
    let m = reduced.variables;
    // The path of two oscillators with the ratio √2 is dense in a torus: what leaves the time out has no single value there.
    let local = match many > themselves {
        true => ", as functions of those found that exist near each general state",
        false => "",
    };
    let about = format!("{}{local}", about(cx, reduced, many));
    if many + 1 >= m {
        let detail = match many {
            0 => format!("{about}; a single variable needs neither integrals nor a measure"),
            _ => format!("{about}; these determine the path without a measure"),
        };
        let on = "where the integrals are independent";
        return Ok(Verdict::Proved(Proof::exact(on, detail)));
    }
    let kept = Kept::of(cx, reduced, &values, &counts)?;
    let missing = m - 2 - many.min(m - 2);
    Ok(kept.concluded(&about, missing))
}

/// How many functions of the integrals do not contain what is left out: those of the values of the integrals whose derivatives vanish
/// along the directions in which shifts of it change these. Where the directions depend on the values alone, as those of shifts that
/// carry motions into motions do, there are as many as values less directions: fields that commute have such directions in
/// involution (Frobenius).
fn invariant(cx: &Context<'_>, reduced: &Reduced, values: &[Expr]) -> Option<usize> {
    let (system, chart) = (cx.system, &reduced.chart);
    let g = &system.graph;
    if values.is_empty() {
        return Some(0);
    }
    let unit = |size: usize, place: Option<usize>| -> Vec<Expr> {
        let entry = |i| if Some(i) == place { g.one() } else { g.zero() };
        (0..size).map(entry).collect()
    };
    let (n, k) = (system.n(), chart.k());
    let masses = system.mass_rates(&chart.velocities);
    let along = |es: &[Expr], place: usize| -> Vec<Expr> {
        if let Some(mass) = place.checked_sub(n + k + 1) {
            return es.iter().map(|&e| g.diff(e, masses[mass].0)).collect();
        }
        let direction = Direction {
            time: if place == 0 { g.one() } else { g.zero() },
            coordinates: unit(n, place.checked_sub(1).filter(|&i| i < n)),
            parameters: unit(k, place.checked_sub(1 + n)),
        };
        let rates = chart.along(system, es, &direction).into_iter();
        // Along the time alone masses stay as they are.
        let held = |(e, rate): (&Expr, Expr)| {
            let own = masses.iter().filter(|_| place == 0);
            let own = own.map(|&(mass, phi)| g.neg(g.mul(&[phi, g.diff(*e, mass)])));
            g.add(&own.chain([rate]).collect::<Vec<Expr>>())
        };
        es.iter().zip(rates).map(held).collect()
    };
    let shift = |&i: &usize| if i < n { i + 1 } else { i + k + 1 };
    let mut shifts: Vec<usize> = reduced.ignorable.iter().map(shift).collect();
    if !reduced.timed {
        shifts.push(0);
    }
    let mut columns: Vec<Vec<Expr>> = shifts.iter().map(|&place| along(values, place)).collect();
    let turns = reduced.turns.iter();
    columns.extend(turns.map(|turn| reduced.turned(cx, values, turn)));
    let moved: Vec<Expr> = columns
        .concat()
        .into_iter()
        .filter(|&e| !g.is_zero(e))
        .collect();
    if moved.is_empty() {
        return Some(values.len());
    }
    let rank = |matrix: &[Vec<Expr>]| {
        let rank = cx.prover.rank(system, matrix, &chart.manifold).ok()?;
        matches!(rank.at_most, Verdict::Proved(_)).then_some(rank)
    };
    let places = 0..=n + k + masses.len();
    let depend_on_values = |more: &[Expr]| {
        let all = [values, more].concat();
        let gradients: Vec<Vec<Expr>> = places.clone().map(|place| along(&all, place)).collect();
        rank(&gradients).is_some_and(|rank| rank.maximum == values.len())
    };
    let orbit = rank(&columns)?;
    let is_closed = depend_on_values(&moved)
        || reduced.turns.is_empty() && {
            // With multiples of each other the directions may depend on the values alone: t ∂/∂G does.
            let directions = echelon(g, &columns, &orbit.pivots)?;
            depend_on_values(&directions.concat())
        };
    is_closed.then(|| values.len() - orbit.maximum)
}

/// The rows of a matrix that span all, with the unit matrix in the columns of the pivots.
fn echelon(g: &Graph, matrix: &[Vec<Expr>], pivots: &Pivots) -> Option<Vec<Vec<Expr>>> {
    let own: Vec<&Vec<Expr>> = pivots.rows.iter().map(|&i| &matrix[i]).collect();
    let square = own.iter();
    let square = square.map(|row| pivots.columns.iter().map(|&j| row[j]).collect());
    let inverse = inverse(g, &square.collect::<Vec<Vec<Expr>>>()).ok()?;
    let columns = own.first()?.len();
    let entry = |factors: &Vec<Expr>, j: usize| {
        let parts = factors.iter().zip(&own);
        let parts: Vec<Expr> = parts.map(|(&a, row)| g.mul(&[a, row[j]])).collect();
        g.add(&parts)
    };
    let row = |factors: &Vec<Expr>| (0..columns).map(|j| entry(factors, j)).collect();
    Some(inverse.iter().map(row).collect())
}

fn about(cx: &Context<'_>, reduced: &Reduced, many: usize) -> String {
    let names: Vec<&str> = reduced
        .ignorable
        .iter()
        .map(|&i| variable(cx, i).0)
        .collect();
    let turns: Vec<&str> = reduced.turns.iter().map(|turn| &turn.words[..]).collect();
    let turned = match turns.is_empty() {
        true => String::new(),
        false => format!(
            "{}, under which the motion is symmetric,",
            turns.join(" and ")
        ),
    };
    let names = names.join(", ");
    let left_out = match (names.is_empty(), turned.is_empty()) {
        (true, true) => String::new(),
        (false, true) if reduced.ignorable.len() == 1 => format!(" after {names} is left out"),
        (false, true) => format!(" after {names} are left out"),
        (true, false) => format!(" after {turned} are left out"),
        (false, false) => format!(" after {names} and {turned} are left out"),
    };
    let of_cyclic = reduced
        .constant
        .iter()
        .filter(|&c| !reduced.cyclic.contains(c));
    let constant: Vec<&str> = of_cyclic.map(String::as_str).collect();
    let keeps = match &constant[..] {
        [] => None,
        [one] => Some(format!("{one} keeps its value by itself")),
        all => Some(format!(
            "{} keep their values by themselves",
            all.join(", ")
        )),
    };
    let cyclic = match &reduced.cyclic[..] {
        [] => None,
        [one] => Some(format!("the independent velocity {one} is cyclic")),
        all => Some(format!(
            "the independent velocities {} are cyclic",
            all.join(", ")
        )),
    };
    let kept: Vec<String> = cyclic.into_iter().chain(keeps).collect();
    let kept = match kept.is_empty() {
        true => String::new(),
        false => format!(" ({})", kept.join("; ")),
    };
    let found = match many {
        1 => "1 integral".to_owned(),
        _ => counted(many, "independent integral", "independent integrals"),
    };
    let fixed = match cx.system.fixed_functions().is_empty() {
        true => "",
        false => ", what the constraints fix among these",
    };
    let time = match reduced.timed {
        true => " (the time is one of them)",
        false => "",
    };
    format!(
        "the motion has {}{time}{left_out}{kept}, with {found} of them{fixed}",
        counted(reduced.variables, "variable", "variables"),
    )
}
