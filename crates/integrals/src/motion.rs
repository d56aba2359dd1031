//! The field X̄ of the motion on the constraint manifold N, and derivatives of functions on N.
//!
//! `X̄ = ∂/∂t + v ∂/∂q + a(q, v, t) ∂/∂v` with the accelerations of Routh's equations; restricted to N it is the field of T3
//! (6), and a function G of (t, q, v) is a first integral exactly when `X̄G = 0` on N.

use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::claims::formulation::{derive, manifold, REFERENCE};
use chetaev_mechanics::prover;
use chetaev_mechanics::{Characteristics, Context, Manifold, System};
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::zero::points::{Draw, Points, PointsOf};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// Why functions could not be compared.
pub const NO_POINTS: &str =
    "no velocities that satisfy the constraints were found modulo a prime, where functions are compared";

/// How many draws are tried until one has points.
pub const DRAWS: usize = 12;

/// A draw that has points: where a root of parameters alone must be rational, as √(1 + a²) on Appell's cone, half of all draws
/// have none.
pub fn draw_with_points(points: &Points, random: &mut Random) -> Option<Draw> {
    (0..DRAWS).find_map(|_| {
        let draw = points.draw(random)?;
        let mut probe = random.clone();
        points.at(&draw, &mut probe).map(|_| draw)
    })
}

/// Other values of what does not move, for which there are points too.
pub fn redraw_with_points(points: &Points, draw: &Draw, random: &mut Random) -> Option<Draw> {
    (0..DRAWS).find_map(|_| {
        let next = points.redraw(draw, random)?;
        let mut probe = random.clone();
        points.at(&next, &mut probe).map(|_| next)
    })
}

/// The motion of a system on its constraint manifold.
#[derive(Debug)]
pub struct Motion<'a> {
    /// The system.
    pub system: &'a System,
    /// q'' as functions of (q, v, t).
    pub accelerations: Vec<Expr>,
    /// The constraint manifold.
    pub manifold: Manifold,
    chart: Characteristics,
}

impl<'a> Motion<'a> {
    /// The motion of the context's system.
    ///
    /// # Errors
    /// A sentence that says why its accelerations are not known.
    pub fn of(cx: &Context<'a>) -> Result<Motion<'a>, String> {
        let equations = derive(cx, REFERENCE).map_err(|problem| problem.to_string())?;
        let chart = Characteristics::independent_velocities(cx.system, cx.terms, cx.selection);
        Ok(Motion {
            accelerations: equations.in_natural_state(cx.system, &equations.accelerations),
            manifold: manifold(cx),
            chart: chart.map_err(|problem| problem.to_string())?,
            system: cx.system,
        })
    }

    /// X̄ of functions of (t, q, v).
    pub fn derivatives(&self, es: &[Expr]) -> Vec<Expr> {
        let g = &self.system.graph;
        let pairs: Vec<(Expr, Expr)> = self
            .system
            .coordinates
            .iter()
            .zip(&self.accelerations)
            .map(|(c, &a)| (c.a, a))
            .collect();
        let rates: Vec<Expr> = es
            .iter()
            .map(|&e| self.system.total_derivative(e))
            .collect();
        g.substitute_all(&rates, &pairs)
    }

    /// The derivatives of functions of (t, q, v) along t, each coordinate, each independent velocity and each mass with a law of its
    /// own on N: one row for each function.
    pub fn gradients(&self, es: &[Expr]) -> Vec<Vec<Expr>> {
        let (g, n, k) = (&self.system.graph, self.system.n(), self.chart.k());
        let restricted = self.chart.restrict(self.system, es);
        let unit = |size: usize, place: Option<usize>| -> Vec<Expr> {
            let entry = |i| if Some(i) == place { g.one() } else { g.zero() };
            (0..size).map(entry).collect()
        };
        let directions = (0..=n + k).map(|d| Direction {
            time: if d == 0 { g.one() } else { g.zero() },
            coordinates: unit(n, d.checked_sub(1).filter(|&i| i < n)),
            parameters: unit(k, d.checked_sub(1 + n)),
        });
        let mut columns: Vec<Vec<Expr>> = directions
            .map(|direction| self.chart.along(self.system, &restricted, &direction))
            .collect();
        // No constraint contains a mass.
        let masses = self.system.masses.iter();
        columns.extend(masses.map(|mass| {
            let by_mass = restricted.iter().map(|&e| g.diff(e, mass.symbol));
            by_mass.collect::<Vec<Expr>>()
        }));
        (0..es.len())
            .map(|i| columns.iter().map(|column| column[i]).collect())
            .collect()
    }

    /// Which functions of (t, q, v) are functionally independent on N of those before them, by what is seen at one point over a prime
    /// field; `None` where there is no point.
    pub fn independent_functions(&self, es: &[Expr], seed: u64) -> Option<Vec<usize>> {
        let gradients = self.gradients(es);
        let directions = gradients.first().map_or(0, Vec::len);
        let points = self.points(&gradients.concat()).ok()?;
        let mut random = Random::stream(seed, 1 << 23);
        let draw = draw_with_points(&points, &mut random)?;
        let at = points.at(&draw, &mut random)?;
        let rows = (0..directions).flat_map(|d| at.chunks(directions).map(move |row| row[d]));
        Some(null_space(&draw.field, es.len(), rows.collect()).pivots)
    }

    /// Names of the independent velocities of the chart of N.
    pub fn independent(&self) -> Vec<String> {
        self.chart
            .parameters
            .iter()
            .map(|p| p.name.clone())
            .collect()
    }

    /// Whether a symbol moves.
    pub fn moves(&self, symbol: Symbol) -> bool {
        let name = self.system.graph.symbol_name(symbol);
        name == "t" || self.system.moves(name)
    }

    /// Functions of (t, q, v) ready to be evaluated at points of N.
    ///
    /// # Errors
    /// A sentence that says why they cannot be.
    pub fn points(&self, outputs: &[Expr]) -> Result<Points, String> {
        self.points_with(outputs, &[])
    }

    /// The same for given values of parameters.
    ///
    /// # Errors
    /// A sentence that says why they cannot be.
    pub fn points_with(&self, outputs: &[Expr], values: &[(Expr, Expr)]) -> Result<Points, String> {
        let g = &self.system.graph;
        let manifold = self.manifold.substituted(g, values);
        Points::new(
            g,
            &PointsOf {
                outputs: &g.substitute_all(outputs, values),
                solved: &manifold.solved,
                implicit: &manifold.implicit,
                assumptions: &prover::assumptions(self.system),
                moves: &|symbol| self.moves(symbol),
            },
        )
    }

    /// Decides whether G is a first integral: `X̄G = 0` on N.
    pub fn is_integral(&self, cx: &Context<'_>, integral: Expr) -> Verdict {
        let rate = self.derivatives(&[integral]);
        let on = if self.system.constraints.is_empty() {
            "everywhere outside the singular set of the mass matrix"
        } else {
            "on the constraint manifold outside the singular set of the linear systems"
        };
        let named: Vec<(String, Expr)> = rate.iter().map(|&e| ("its rate".into(), e)).collect();
        cx.prover
            .named_identity(self.system, &named, &self.manifold, on)
    }
}
