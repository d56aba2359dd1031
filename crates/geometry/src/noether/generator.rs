//! The field and the gauge of a first integral: the inverse of Noether's theorem (T3 §6).
//!
//! For a function G on N and any δ: `χ = -W̄⁻¹ ∂G`, `ξ = χ + η δ`, `g = G + L̄ δ + p_i χ^i`, and ζ from the structure equation
//! (15b). Then the Killing-type equations (14a,b), the structure equations (15a–c) and `Ȳ ⌟ Ω̄ = dG` hold if and only if
//! `X̄G = 0`; here each is stated by itself, to be proved by itself.

use super::embedded::{dot, Embedded};
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::Expr;

/// `Ȳ = δ Y_0 + ξ^i Y_i + ζ^i ∂_i` with the gauge function g.
#[derive(Clone, Debug)]
pub struct Generator {
    /// G on N.
    pub integral: Expr,
    /// δ.
    pub delta: Expr,
    /// ξ.
    pub xi: Vec<Expr>,
    /// `χ = ξ - η δ`.
    pub chi: Vec<Expr>,
    /// ζ.
    pub zeta: Vec<Expr>,
    /// g.
    pub gauge: Expr,
}

impl Generator {
    /// The generator of a function G of (t, q, v) with a given δ(t, q, η).
    ///
    /// # Errors
    /// Where W̄ is singular by its form.
    pub fn of(n: &Embedded<'_>, integral: Expr, delta: Expr) -> Result<Generator, SolveError> {
        let g = &n.system.graph;
        let integral = n.restricted(integral);
        let slopes = n.by_speeds(&[integral]).concat();
        let right: Vec<Expr> = slopes.iter().map(|&e| g.neg(e)).collect();
        let chi = n.solve(&right)?;
        let speeds = n.speeds();
        let xi = chi
            .iter()
            .zip(&speeds)
            .map(|(&chi, &eta)| g.add(&[chi, g.mul(&[eta, delta])]))
            .collect();
        let gauge = g.add(&[
            integral,
            g.mul(&[n.terms.lagrangian, delta]),
            dot(g, &n.terms.momenta, &chi),
        ]);
        let mut generator = Generator {
            integral,
            delta,
            xi,
            chi,
            zeta: vec![g.zero(); n.k()],
            gauge,
        };
        // (15b) is linear in ζ with the matrix W̄; what remains of it at ζ = 0 goes to the right.
        let rest: Vec<Expr> = generator
            .along_fields(n)
            .into_iter()
            .map(|e| g.neg(e))
            .collect();
        generator.zeta = n.solve(&rest)?;
        Ok(generator)
    }

    /// Left minus right side of (14a), one for each i.
    pub fn killing_speeds(&self, n: &Embedded<'_>) -> Vec<Expr> {
        let (g, k) = (&n.system.graph, n.k());
        let (speeds, p) = (n.speeds(), &n.terms.momenta);
        let delta = n.by_speeds(&[self.delta]).concat();
        let xi = n.by_speeds(&self.xi);
        let gauge = n.by_speeds(&[self.gauge]).concat();
        (0..k)
            .map(|i| {
                let moved: Vec<Expr> = (0..k)
                    .map(|j| g.sub(xi[j][i], g.mul(&[speeds[j], delta[i]])))
                    .collect();
                let turning: Vec<Expr> = (0..k).map(|j| n.turning[j][i]).collect();
                g.add(&[
                    g.mul(&[n.terms.lagrangian, delta[i]]),
                    dot(g, p, &moved),
                    dot(g, &turning, &self.chi),
                    g.neg(gauge[i]),
                ])
            })
            .collect()
    }

    /// Left minus right side of (14b).
    pub fn killing_drift(&self, n: &Embedded<'_>) -> Expr {
        let g = &n.system.graph;
        let (speeds, p, lagrangian) = (n.speeds(), &n.terms.momenta, n.terms.lagrangian);
        let delta = n.drift(&[self.delta]);
        let moved: Vec<Expr> = n
            .drift(&self.xi)
            .into_iter()
            .zip(&speeds)
            .map(|(xi, &eta)| g.sub(xi, g.mul(&[eta, delta[0]])))
            .collect();
        // K^l_i p_l + G^α_i L_α + P_i is N_i - Y_iL̄.
        let turn: Vec<Expr> = n
            .right
            .iter()
            .zip(&n.terms.slopes)
            .map(|(&right, &slope)| g.sub(right, slope))
            .collect();
        g.add(&[
            g.mul(&[lagrangian, delta[0]]),
            g.mul(&[n.along_time(&[lagrangian])[0], self.delta]),
            dot(g, &n.terms.slopes, &self.xi),
            dot(g, p, &moved),
            dot(g, &turn, &self.chi),
            g.neg(n.drift(&[self.gauge])[0]),
        ])
    }

    /// Left minus right side of (15b), one for each i.
    pub fn along_fields(&self, n: &Embedded<'_>) -> Vec<Expr> {
        let (g, k) = (&n.system.graph, n.k());
        let (speeds, p) = (n.speeds(), &n.terms.momenta);
        let delta = n.along_fields(&[self.delta]);
        let xi = n.along_fields(&self.xi);
        let gauge = n.along_fields(&[self.gauge]);
        let momenta_time = n.along_time(p);
        (0..k)
            .map(|i| {
                let moved: Vec<Expr> = (0..k)
                    .map(|j| g.sub(xi[i][j], g.mul(&[speeds[j], delta[i][0]])))
                    .collect();
                let carried: Vec<Expr> = (0..k)
                    .map(|j| g.sub(n.momenta_along[j][i], n.gyro[j][i]))
                    .collect();
                let in_time = g.add(&[
                    momenta_time[i],
                    g.neg(n.gyro_time[i]),
                    g.neg(n.terms.forces[i]),
                ]);
                g.add(&[
                    g.mul(&[n.terms.lagrangian, delta[i][0]]),
                    dot(g, p, &moved),
                    dot(g, &n.mass[i], &self.zeta),
                    dot(g, &carried, &self.xi),
                    g.mul(&[in_time, self.delta]),
                    g.neg(gauge[i][0]),
                ])
            })
            .collect()
    }

    /// Left minus right side of (15c).
    pub fn along_time(&self, n: &Embedded<'_>) -> Expr {
        let (g, k) = (&n.system.graph, n.k());
        let (speeds, p, lagrangian) = (n.speeds(), &n.terms.momenta, n.terms.lagrangian);
        let delta = n.along_time(&[self.delta])[0];
        let xi = n.along_time(&self.xi);
        let moved: Vec<Expr> = (0..k)
            .map(|i| g.sub(xi[i], g.mul(&[speeds[i], delta])))
            .collect();
        let momenta_time = n.along_time(p);
        let turned: Vec<Expr> = (0..k).map(|i| dot(g, &n.turning[i], &self.zeta)).collect();
        let pushed: Vec<Expr> = (0..k)
            .map(|i| g.add(&[n.gyro_time[i], n.terms.slopes[i], n.terms.forces[i]]))
            .collect();
        let changed: Vec<Expr> = (0..k)
            .map(|i| {
                let along: Vec<Expr> = (0..k).map(|j| n.momenta_along[j][i]).collect();
                g.add(&[
                    dot(g, &n.hessian[i], &self.zeta),
                    dot(g, &along, &self.xi),
                    g.mul(&[momenta_time[i], self.delta]),
                ])
            })
            .collect();
        g.add(&[
            g.mul(&[lagrangian, delta]),
            dot(g, p, &moved),
            g.mul(&[n.along_time(&[lagrangian])[0], self.delta]),
            dot(g, &speeds, &turned),
            dot(g, &pushed, &self.xi),
            g.neg(dot(g, &speeds, &changed)),
            g.neg(n.along_time(&[self.gauge])[0]),
        ])
    }

    /// The components of `Ȳ ⌟ Ω̄ - dG` along dt, θ^i and dη^i, where `dG = (ZG) dt + (Y_iG) θ^i + (∂_iG) dη^i`.
    pub fn contraction(&self, n: &Embedded<'_>) -> Vec<Expr> {
        let g = &n.system.graph;
        let (time, along, speeds) = n.contraction(self.delta, &self.chi, &self.zeta);
        let mut residuals = vec![g.sub(time, n.drift(&[self.integral])[0])];
        let of_fields = n.along_fields(&[self.integral]).concat();
        residuals.extend(along.iter().zip(of_fields).map(|(&a, b)| g.sub(a, b)));
        let of_speeds = n.by_speeds(&[self.integral]).concat();
        residuals.extend(speeds.iter().zip(of_speeds).map(|(&a, b)| g.sub(a, b)));
        residuals
    }
}
