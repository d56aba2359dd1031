//! The Killing-type search (T3 §7, 2) and the search for generalized momenta (T3 §7, 3; §8.2): fields and gauges are unknown instead
//! of integrals.
//!
//! With δ = 0 the equations (14a), (14b) are linear in ξ^i and g and contain no accelerations. With ξ^i and g from families they
//! are linear equations for constants, and every solution gives the integral `G = g - p_i ξ^i` (13). With families of functions of
//! (t, q) these are the generalized momenta `ψ^i p_i` with ξ = -ψ. Solutions without G do not exist: δ = 0 and G = 0 leave
//! ξ = 0, as W̄ is regular.

use super::ansatz::Ansatz;
use super::embedded::{dot, Embedded};
use super::generator::Generator;
use super::motion::{Motion, NO_POINTS};
use super::shown::readable;
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// A field and a gauge that solve the Killing-type equations.
#[derive(Clone, Debug)]
pub struct Solution {
    /// ξ^i as functions of (t, q, η).
    pub xi: Vec<Expr>,
    /// g.
    pub gauge: Expr,
    /// G as a function of (t, q, v).
    pub integral: Expr,
    /// (14a), (14b), and `X̄G = 0` on the constraint manifold.
    pub verdict: Verdict,
}

/// All solutions with ξ^i among the combinations of `fields` and g among those of `gauges`, functions of (t, q, v); constant
/// gauges are left out.
///
/// # Errors
/// A sentence that says why they were not found.
pub fn solutions(
    cx: &Context<'_>,
    n: &Embedded<'_>,
    fields: &[Expr],
    gauges: &[Expr],
) -> Result<Vec<Solution>, String> {
    let search = Search {
        cx,
        n,
        motion: Motion::of(cx)?,
    };
    let fields = search.independent(fields, false)?;
    let gauges = search.independent(gauges, true)?;
    let mut columns = Vec::new();
    for i in 0..n.k() {
        columns.extend(fields.iter().map(|&e| search.column(Some((i, e)), None)));
    }
    columns.extend(gauges.iter().map(|&e| search.column(None, Some(e))));
    let found = match columns.is_empty() {
        true => Vec::new(),
        false => search
            .ansatz(&columns)?
            .all()
            .ok_or("the coefficients of a solution were not found")?,
    };
    Ok(found
        .iter()
        .map(|c| search.solution(&fields, &gauges, c))
        .collect())
}

struct Search<'s, 'a> {
    cx: &'s Context<'a>,
    n: &'s Embedded<'a>,
    motion: Motion<'a>,
}

impl Search<'_, '_> {
    fn ansatz(&self, columns: &[Vec<Expr>]) -> Result<Ansatz<'_>, String> {
        let parameters = self.n.embedding.chart.parameters.iter();
        let own: Vec<Symbol> = parameters.map(|p| p.symbol).collect();
        let seed = self.cx.prover.points_seed();
        Ansatz::new(&self.motion, columns, self.n.manifold(), &own, seed)
    }

    /// Functions on N that are no combinations of those before them, and of the constants where these do not count.
    fn independent(&self, es: &[Expr], but_constants: bool) -> Result<Vec<Expr>, String> {
        let g = &self.n.system.graph;
        let mut all: Vec<Expr> = but_constants.then(|| g.one()).into_iter().collect();
        all.extend(es.iter().map(|&e| self.n.restricted(e)));
        if all.is_empty() {
            return Ok(all);
        }
        let columns: Vec<Vec<Expr>> = all.iter().map(|&e| vec![e]).collect();
        let places = self.ansatz(&columns)?.independent().ok_or(NO_POINTS)?;
        let kept = places.into_iter().filter(|&i| !but_constants || i > 0);
        Ok(kept.map(|i| all[i]).collect())
    }

    /// The field and the gauge as a generator with δ = 0.
    fn generator(&self, xi: Vec<Expr>, gauge: Expr) -> Generator {
        let (g, n) = (&self.n.system.graph, self.n);
        Generator {
            integral: g.sub(gauge, dot(g, &n.terms.momenta, &xi)),
            delta: g.zero(),
            chi: xi.clone(),
            zeta: vec![g.zero(); n.k()],
            xi,
            gauge,
        }
    }

    /// What (14a) and (14b) are for one component of the field, or for a gauge.
    fn column(&self, field: Option<(usize, Expr)>, gauge: Option<Expr>) -> Vec<Expr> {
        let zero = self.n.system.graph.zero();
        let mut xi = vec![zero; self.n.k()];
        if let Some((i, e)) = field {
            xi[i] = e;
        }
        self.residuals(&self.generator(xi, gauge.unwrap_or(zero)))
    }

    fn residuals(&self, generator: &Generator) -> Vec<Expr> {
        let mut residuals = generator.killing_speeds(self.n);
        residuals.push(generator.killing_drift(self.n));
        residuals
    }

    fn solution(&self, fields: &[Expr], gauges: &[Expr], coefficients: &[Expr]) -> Solution {
        let (system, g) = (self.n.system, &self.n.system.graph);
        let (of_fields, of_gauge) = coefficients.split_at(fields.len() * self.n.k());
        let xi = of_fields.chunks(fields.len().max(1));
        let mut xi: Vec<Expr> = xi.map(|own| dot(g, own, fields)).collect();
        xi.resize(self.n.k(), g.zero());
        let generator = self.generator(xi, dot(g, of_gauge, gauges));
        let parameters = self.n.embedding.chart.parameters.iter();
        let pairs: Vec<(Expr, Expr)> = parameters.map(|p| (p.value, p.definition)).collect();
        let integral = g.substitute(generator.integral, &pairs);
        let residuals = self.residuals(&generator);
        let on = "on the constraint manifold";
        let equations = self
            .cx
            .prover
            .identity(system, &residuals, self.n.manifold(), on);
        Solution {
            verdict: equations.and(self.motion.is_integral(self.cx, integral)),
            integral: readable(g, integral),
            gauge: readable(g, generator.gauge),
            xi: generator.xi.iter().map(|&e| readable(g, e)).collect(),
        }
    }
}
