//! The constraint manifold with its fields, its 2-form and the motion on it (T3 §5).

use crate::formulations::common::Case;
use chetaev_mechanics::claims::formulation::{basis, derive};
use chetaev_mechanics::formulations::boltzmann_hamel::{Embedding, Terms};
use chetaev_symbolic::Expr;

/// Which independent quasi-velocities an embedding uses.
#[derive(Clone, Copy)]
pub(super) enum Chart {
    /// Those of the frame that is adapted to the system.
    Adapted,
    /// Velocities.
    Natural,
}

/// The constraint manifold N with the motion on it: functions of (t, q, η^i), and of dependent velocities that f = 0 ties.
pub(super) struct OnManifold<'a> {
    pub(super) case: &'a Case,
    pub(super) embedding: &'a Embedding<'a>,
    pub(super) terms: Terms,
    /// A^i, from Routh's equations.
    pub(super) rates: Vec<(Expr, Expr)>,
    /// λ_α = D(∂L/∂v^α) - ∂L/∂q^α - Q_α along the motion, in the natural frame.
    pub(super) reactions: Vec<Expr>,
    /// W̄_ij = ∂_jp_i - (∂_jC^α_i) L_α.
    pub(super) mass: Vec<Vec<Expr>>,
}

pub(super) fn on_manifold(text: &str, chart: Chart, look: impl Fn(&OnManifold<'_>)) {
    let case = Case::new(text);
    let cx = case.context();
    let mut basis = basis(&cx);
    if let Chart::Natural = chart {
        basis.characteristics = Some(basis.independent_velocities().unwrap());
    }
    let embedding = Embedding::of(&basis).unwrap();
    let terms = embedding.terms();
    let (g, system, chart) = (&case.system.graph, &case.system, &embedding.chart);
    let motion = derive(&cx, "routh").unwrap();
    let known: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .zip(&motion.accelerations)
        .map(|(c, &a)| (c.a, a))
        .collect();
    let along_motion = |e: Expr| {
        let e = g.substitute_all(&[e], &known);
        chart.restrict(system, &e)[0]
    };
    let rates = chart
        .parameters
        .iter()
        .map(|p| (p.rate, along_motion(system.total_derivative(p.definition))))
        .collect();
    let lagrange = system.lagrange_left_sides();
    let reactions = chart
        .dependent
        .iter()
        .map(|&d| along_motion(g.sub(lagrange[d], system.forces[d])))
        .collect();
    let slopes = embedding.slopes.iter();
    let turned: Vec<Vec<Vec<Expr>>> = slopes.map(|row| chart.by_parameters(system, row)).collect();
    let of_momenta = chart.by_parameters(system, &terms.momenta);
    let entry = |i: usize, j: usize| {
        let lost = turned.iter().zip(&terms.dependent_momenta);
        let lost: Vec<Expr> = lost.map(|(t, &l)| g.mul(&[t[i][j], l])).collect();
        g.sub(of_momenta[i][j], g.add(&lost))
    };
    let k = embedding.k();
    let mass = (0..k)
        .map(|i| (0..k).map(|j| entry(i, j)).collect())
        .collect();
    look(&OnManifold {
        case: &case,
        embedding: &embedding,
        terms,
        rates,
        reactions,
        mass,
    });
}

impl OnManifold<'_> {
    pub(super) fn k(&self) -> usize {
        self.embedding.k()
    }

    pub(super) fn read(&self, text: &str) -> Expr {
        self.case.read(text)
    }

    pub(super) fn sub(&self, a: Expr, b: Expr) -> Expr {
        self.case.system.graph.sub(a, b)
    }

    pub(super) fn dot(&self, a: &[Expr], b: &[Expr]) -> Expr {
        let g = &self.case.system.graph;
        let parts: Vec<Expr> = a.iter().zip(b).map(|(&a, &b)| g.mul(&[a, b])).collect();
        g.add(&parts)
    }

    /// Puts the accelerations of the motion in the place of η'.
    pub(super) fn moving(&self, e: Expr) -> Expr {
        self.case.system.graph.substitute_all(&[e], &self.rates)[0]
    }

    /// X̄e.
    pub(super) fn along(&self, e: Expr) -> Expr {
        let rates = self
            .embedding
            .chart
            .total_derivative(&self.case.system, &[e]);
        self.moving(rates[0])
    }

    /// Ze = Y_0e + η^iY_ie.
    pub(super) fn frozen(&self, e: Expr) -> Expr {
        let chart = &self.embedding.chart;
        chart.frozen_derivative(&self.case.system, &[e])[0]
    }

    /// Y_ie for every i.
    pub(super) fn by_fields(&self, e: Expr) -> Vec<Expr> {
        let chart = &self.embedding.chart;
        (0..self.k())
            .map(|i| chart.by_coordinates(&self.case.system, &[e], &self.embedding.field(i))[0])
            .collect()
    }

    /// ∂_ie for every i.
    pub(super) fn by_speeds(&self, e: Expr) -> Vec<Expr> {
        let chart = &self.embedding.chart;
        chart.by_parameters(&self.case.system, &[e]).swap_remove(0)
    }

    /// The accelerations A^i.
    pub(super) fn accelerations(&self) -> Vec<Expr> {
        self.rates.iter().map(|&(_, a)| a).collect()
    }

    /// `G^α_i + A^m ∂_mC^α_i` for every α, with A free.
    pub(super) fn turning(&self, i: usize) -> Vec<Expr> {
        let g = &self.case.system.graph;
        let curvature = self.terms.g[i].iter().zip(&self.terms.turning);
        curvature.map(|(&c, row)| g.add(&[c, row[i]])).collect()
    }

    /// N_i of (11).
    pub(super) fn slope(&self, i: usize) -> Expr {
        let g = &self.case.system.graph;
        g.add(&[
            self.dot(&self.terms.k[i], &self.terms.momenta),
            self.terms.slopes[i],
            self.dot(&self.terms.g[i], &self.terms.dependent_momenta),
            self.terms.forces[i],
        ])
    }

    /// S_ji = K^l_ji p_l + G^α_ji L_α, from the bracket [Y_j, Y_i] with η frozen.
    pub(super) fn gyroscopic(&self, j: usize, i: usize) -> Expr {
        let (g, system) = (&self.case.system.graph, &self.case.system);
        let (chart, embedding) = (&self.embedding.chart, self.embedding);
        let (of_j, of_i) = (embedding.field(j), embedding.field(i));
        let forward = chart.by_coordinates(system, &of_i, &of_j);
        let backward = chart.by_coordinates(system, &of_j, &of_i);
        let pairs = forward.iter().zip(&backward);
        let bracket: Vec<Expr> = pairs.map(|(&a, &b)| g.sub(a, b)).collect();
        let along = chart.frame.components(system, &bracket);
        let k: Vec<Expr> = chart.independent.iter().map(|&l| along[l]).collect();
        let rest = chart.dependent.iter().zip(&embedding.slopes);
        let rest: Vec<Expr> = rest
            .map(|(&alpha, row)| g.sub(along[alpha], self.dot(row, &k)))
            .collect();
        g.add(&[
            self.dot(&k, &self.terms.momenta),
            self.dot(&rest, &self.terms.dependent_momenta),
        ])
    }

    /// Ω̄ of (11) in the basis (dt, θ^i, dη^i), an antisymmetric matrix of 2k + 1 rows.
    pub(super) fn two_form(&self) -> Vec<Vec<Expr>> {
        let g = &self.case.system.graph;
        let k = self.k();
        let mut form = vec![vec![g.zero(); 2 * k + 1]; 2 * k + 1];
        let mut put = |a: usize, b: usize, e: Expr| {
            form[a][b] = e;
            form[b][a] = g.neg(e);
        };
        for i in 0..k {
            let momentum = self.terms.momenta[i];
            put(0, 1 + i, g.sub(self.frozen(momentum), self.slope(i)));
            let of_i = self.by_fields(momentum);
            for (j, &slope) in of_i.iter().enumerate() {
                put(1 + k + j, 1 + i, self.mass[i][j]);
                if j < i {
                    let of_j = self.by_fields(self.terms.momenta[j])[i];
                    let curl = g.sub(slope, of_j);
                    put(1 + j, 1 + i, g.sub(curl, self.gyroscopic(j, i)));
                }
            }
        }
        form
    }

    /// The components of Ȳ ⌟ Ω̄ for the components of Ȳ along (dt, θ^i, dη^i).
    pub(super) fn contracted(&self, field: &[Expr]) -> Vec<Expr> {
        let form = self.two_form();
        let column = |b: usize| form.iter().map(|row| row[b]).collect::<Vec<_>>();
        (0..form.len())
            .map(|b| self.dot(field, &column(b)))
            .collect()
    }

    /// dG in the basis (dt, θ^i, dη^i).
    pub(super) fn differential(&self, e: Expr) -> Vec<Expr> {
        let mut parts = vec![self.frozen(e)];
        parts.extend(self.by_fields(e));
        parts.extend(self.by_speeds(e));
        parts
    }

    pub(super) fn word(&self, e: Expr) -> &'static str {
        let cx = self.case.context();
        let (system, manifold) = (&self.case.system, &self.embedding.chart.manifold);
        let verdict = cx.prover.identity(system, &[e], manifold, "");
        verdict.word()
    }

    #[track_caller]
    pub(super) fn vanishes(&self, e: Expr) {
        assert_eq!(self.word(e), "proved");
    }

    #[track_caller]
    pub(super) fn equal(&self, e: Expr, text: &str) {
        assert_eq!(self.word(self.sub(e, self.read(text))), "proved", "{text}");
    }

    /// Refuted, or true on a subset only.
    #[track_caller]
    pub(super) fn fails(&self, e: Expr) {
        let word = self.word(e);
        assert!(matches!(word, "refuted" | "conditional"), "{word}");
    }
}
