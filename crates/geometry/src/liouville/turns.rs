//! Turns of two coordinates against each other together with shifts of others, `q_i ∂_j - q_j ∂_i + Σ κ_c ∂_c`, that carry motions into
//! motions: where a body moves in a plane, those of the plane with the angle of the body. In velocities x', y' the rates contain the
//! angle then, in those along and across the body they do not; counted is what does not depend on this choice, the orbits of the turns.

use super::is_free;
use crate::noether::ansatz::Ansatz;
use crate::noether::motion::Motion;
use crate::noether::shown::readable;
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::{Characteristics, Context};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// In larger systems none are looked for.
const COORDINATES: usize = 12;

/// A field on the coordinates, carried over to the velocities, that commutes with the motion.
#[derive(Clone, Debug)]
pub(super) struct Turn {
    /// Rates of the coordinates.
    pub(super) coordinates: Vec<Expr>,
    /// Rates of the independent velocities.
    pub(super) speeds: Vec<Expr>,
    /// The divergence of the rates of the independent velocities.
    pub(super) divergence: Expr,
    /// What it turns, in words.
    pub(super) words: String,
}

impl Turn {
    pub(super) fn direction(&self, cx: &Context<'_>) -> Direction {
        Direction {
            time: cx.system.graph.zero(),
            coordinates: self.coordinates.clone(),
            parameters: self.speeds.clone(),
        }
    }
}

/// The motion in a chart, and the places of the coordinates that are left out.
pub(super) struct Around<'a> {
    pub(super) motion: &'a Motion<'a>,
    pub(super) chart: &'a Characteristics,
    pub(super) rates: &'a [Expr],
    pub(super) ignorable: &'a [usize],
}

/// The turns of pairs of coordinates, none of which occurs twice, that carry motions into motions.
pub(super) fn turns(cx: &Context<'_>, around: &Around<'_>) -> Vec<Turn> {
    let (system, n) = (cx.system, cx.system.n());
    let is_length = |i: &usize| !system.angles.contains(&system.coordinates[*i].name);
    let own: Vec<usize> = (0..n).filter(is_length).collect();
    let mut taken: Vec<usize> = Vec::new();
    let mut found = Vec::new();
    if n > COORDINATES || around.chart.k() == 0 || around.chart.implicit().next().is_some() {
        return found;
    }
    for (place, &i) in own.iter().enumerate() {
        for &j in &own[place + 1..] {
            if taken.contains(&i) || taken.contains(&j) || cx.is_out_of_time() {
                continue;
            }
            if let Some(turn) = around.turn(cx, i, j) {
                taken.extend([i, j]);
                found.push(turn);
            }
        }
    }
    found
}

impl Around<'_> {
    /// The turn of two coordinates with whatever shifts of others make it commute with the motion.
    fn turn(&self, cx: &Context<'_>, i: usize, j: usize) -> Option<Turn> {
        let (system, g) = (cx.system, &cx.system.graph);
        let (a, b) = (&system.coordinates[i], &system.coordinates[j]);
        let others = (0..system.n()).filter(|c| ![i, j].contains(c));
        let others: Vec<usize> = others.filter(|c| !self.ignorable.contains(c)).collect();
        let zero = || vec![g.zero(); system.n()];
        let mut fields: Vec<Vec<Expr>> = Vec::new();
        for &c in &others {
            let mut shift = zero();
            shift[c] = g.one();
            fields.push(shift);
        }
        let mut turn = zero();
        (turn[i], turn[j]) = (g.neg(b.q), a.q);
        fields.push(turn);
        let columns: Vec<Vec<Expr>> = fields.iter().map(|f| self.defects(cx, f)).collect();
        let seed = cx.prover.points_seed();
        let (manifold, own) = (&self.chart.manifold, self.speeds());
        let ansatz = Ansatz::new(self.motion, &columns, manifold, &own, seed).ok()?;
        let found = ansatz.with_last()?;
        let (&last, shifts) = found.split_last()?;
        let mut field = fields.pop()?;
        let mut with: Vec<&str> = Vec::new();
        for (&c, &shift) in others.iter().zip(shifts).filter(|(_, &e)| !g.is_zero(e)) {
            field[c] = readable(g, g.div(shift, last));
            with.push(&system.coordinates[c].name);
        }
        let mut words = format!("the turns of ({}, {})", a.name, b.name);
        if !with.is_empty() {
            words.push_str(&format!(" with {}", with.join(", ")));
        }
        self.proved(cx, field, words)
    }

    fn proved(&self, cx: &Context<'_>, field: Vec<Expr>, words: String) -> Option<Turn> {
        let (system, g) = (cx.system, &cx.system.graph);
        let defects = self.defects(cx, &field);
        let verdict = cx
            .prover
            .identity(system, &defects, &self.chart.manifold, "");
        if !matches!(verdict, Verdict::Proved(_)) {
            return None;
        }
        let speeds = self.along(cx, &field);
        let slopes = self.chart.by_parameters(system, &speeds);
        let divergence = g.add(&(0..speeds.len()).map(|s| slopes[s][s]).collect::<Vec<_>>());
        // On what is left nothing of what is left out is seen.
        let left_out = self.ignorable.iter().filter(|&&i| i < system.n());
        let left_out: Vec<Symbol> = left_out.map(|&i| system.coordinates[i].q_symbol).collect();
        let is_kept = |&e: &Expr| left_out.iter().all(|&s| is_free(cx, e, s));
        let is_one = speeds.iter().all(is_kept) && !g.contains_any(divergence, &self.speeds());
        is_one.then_some(Turn {
            coordinates: field,
            speeds,
            divergence,
            words,
        })
    }

    fn speeds(&self) -> Vec<Symbol> {
        self.chart.parameters.iter().map(|p| p.symbol).collect()
    }

    /// The rates of the independent velocities when the coordinates move along a field that is linear in them, and the velocities with
    /// them.
    fn along(&self, cx: &Context<'_>, field: &[Expr]) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let of_velocities: Vec<Expr> = field.iter().map(|&e| system.total_derivative(e)).collect();
        let definitions = self.chart.parameters.iter().map(|p| {
            let parts = system.coordinates.iter().enumerate().flat_map(|(i, c)| {
                [
                    g.mul(&[g.diff(p.definition, c.q_symbol), field[i]]),
                    g.mul(&[g.diff(p.definition, c.v_symbol), of_velocities[i]]),
                ]
            });
            g.add(&parts.collect::<Vec<Expr>>())
        });
        self.chart
            .restrict(system, &definitions.collect::<Vec<_>>())
    }

    /// What vanishes where the field keeps the constraints and commutes with the motion; linear in the field.
    fn defects(&self, cx: &Context<'_>, field: &[Expr]) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let speeds = self.along(cx, field);
        let own = Direction {
            time: g.zero(),
            coordinates: field.to_vec(),
            parameters: speeds.clone(),
        };
        let motion = Direction {
            time: g.one(),
            coordinates: self.chart.velocities.clone(),
            parameters: self.rates.to_vec(),
        };
        let masses = system.mass_rates(&self.chart.velocities);
        let mut all = self.chart.velocities.clone();
        all.extend(self.rates);
        all.extend(masses.iter().map(|(_, rate)| *rate));
        let turned = self.chart.along(system, &all, &own);
        let mut moved: Vec<Expr> = field.iter().map(|&e| system.total_derivative(e)).collect();
        moved = self.chart.restrict(system, &moved);
        moved.extend(self.chart.along(system, &speeds, &motion));
        moved.extend(masses.iter().map(|_| g.zero()));
        let pairs = turned.into_iter().zip(moved);
        pairs.map(|(a, b)| g.sub(a, b)).collect()
    }
}
