//! Lagrange's equations for L*, the Lagrangian with the dependent velocities substituted, are wrong by Voronets' term.
//!
//! With `v_d = φ_d(q, v, t)` and `B = ∂φ/∂v` the equations of motion are (T1 (7), (10) for constraints of any form)
//! `D(∂L*/∂v_s) - ∂L*/∂q_s - Σ_d B_ds ∂L*/∂q_d - Q*_s = Σ_d p_d ( D B_ds - ∂φ_d/∂q_s - Σ_e B_es ∂φ_d/∂q_e )`.
//! The right side is evaluated from φ alone. Where it vanishes, as for an integrable constraint, the equations without
//! it are right and must be proved; elsewhere they must be refuted. So must the equations with `p_s = ∂L/∂v_s` in the place of
//! `∂L*/∂v_s`: momenta from L instead of L*, which differ by `Σ_d p_d B_ds`.

use super::hypotheses::{regular, restricted_hessian, Seen};
use super::numbers::{differ, Size};
use super::{Expected, Kind, Subject, Trial};
use chetaev_symbolic::{Expr, Symbol, Verdict};

const LAW: &str = "Lagrange's equations of the reduced L*";
const FULL: &str = "momenta from L instead of L*";

/// The trial; `None` without constraints.
pub(super) fn lagrange_of_restricted(subject: &Subject<'_>) -> Option<Trial> {
    // Where a mass contains velocities, Lagrange's equations take no Ψ without accelerations.
    let lagrangian = chetaev_mechanics::mass::with_velocity(subject.cx.system).is_none();
    if subject.natural.dependent.is_empty() || !lagrangian {
        return None;
    }
    // A singular L* has no equations of motion, right or wrong.
    if restricted_hessian(subject, &subject.natural) == Seen::Fails {
        return None;
    }
    let reduction = Reduction::new(subject)?;
    let missing = subject.on_jet(&reduction.voronets());
    let zeros = vec![subject.cx.system.graph.zero(); missing.len()];
    let term = differ(subject, &missing, &zeros);
    let wrong = subject.on_jet(&reduction.equations());
    let about = match term {
        Size::Zero => "Voronets' term vanishes",
        _ => "Voronets' term is missing",
    };
    Some(trial(subject, LAW, about, term, &wrong))
}

/// Voronets' equations with the momenta of L in the place of those of L*; `None` without constraints.
pub(super) fn momenta_of_full(subject: &Subject<'_>) -> Option<Trial> {
    let lagrangian = chetaev_mechanics::mass::with_velocity(subject.cx.system).is_none();
    if subject.natural.dependent.is_empty() || !lagrangian {
        return None;
    }
    let g = &subject.cx.system.graph;
    let reduction = Reduction::new(subject)?;
    let moved = reduction.moved_momenta();
    let wrong: Vec<Expr> = reduction
        .equations()
        .into_iter()
        .zip(reduction.voronets())
        .zip(&moved)
        .map(|((left, term), &moved)| g.add(&[left, g.neg(term), g.neg(moved)]))
        .collect();
    let wrong = subject.on_jet(&wrong);
    // Where the momenta of L alone do not determine the motion, there is nothing to compare.
    let parameters = subject.natural.parameters.iter();
    let rates: Vec<Symbol> = parameters.filter_map(|p| g.as_symbol(p.rate)).collect();
    if regular(subject, &g.jacobian(&wrong, &rates), &subject.states) == Seen::Fails {
        return None;
    }
    let motion = subject.motion_of(&subject.natural, &wrong)?;
    let seen = differ(
        subject,
        &motion.in_natural_state(subject.cx.system, &motion.accelerations),
        &subject.routh.accelerations,
    );
    let about = match seen {
        Size::Zero => "both are equal on the motion",
        _ => "∂L/∂v for ∂L*/∂v",
    };
    Some(trial(subject, FULL, about, seen, &wrong))
}

/// Whether the curvature of the constraints vanishes, and whether `Σ θ A` does along the motion.
pub(super) fn curvature_and_terms(subject: &Subject<'_>) -> Option<(Size, Size)> {
    let reduction = Reduction::new(subject)?;
    let size = |es: &[Expr]| {
        let zeros = vec![subject.cx.system.graph.zero(); es.len()];
        differ(subject, es, &zeros)
    };
    let curvature = subject.on_jet(&reduction.curvature());
    let accelerations = subject.cx.system.coordinates.iter().map(|c| c.a);
    let motion: Vec<(Expr, Expr)> = accelerations
        .zip(subject.routh.accelerations.iter().copied())
        .collect();
    let terms = subject
        .cx
        .system
        .graph
        .substitute_all(&reduction.voronets(), &motion);
    let terms = subject.natural.restrict(subject.cx.system, &terms);
    Some((size(&curvature), size(&terms)))
}

/// Wrong equations, refuted unless what they miss is zero.
fn trial(
    subject: &Subject<'_>,
    law: &'static str,
    about: &str,
    term: Size,
    equations: &[Expr],
) -> Trial {
    let expected = match term {
        Size::Zero => Expected::Proved,
        _ => Expected::Refuted,
    };
    let verdict = match (term, subject.motion_of(&subject.natural, equations)) {
        (Size::Unclear, _) => Verdict::undecided("numbers cannot tell what is missing from zero"),
        (_, None) => Verdict::undecided("the wrong equations do not determine the accelerations"),
        (_, Some(wrong)) => subject.compared(&wrong),
    };
    Trial {
        kind: match expected {
            Expected::Refuted => Kind::Mutant,
            _ => Kind::Other,
        },
        formulation: "voronets",
        law,
        about: about.to_string(),
        expected,
        verdict,
        seconds: 0.0,
    }
}

/// The derivatives of φ and L, as functions of (q, v, t) on the constraints.
struct Reduction<'a> {
    subject: &'a Subject<'a>,
    /// Indices of the independent velocities.
    independent: Vec<usize>,
    /// ∂L/∂v, length n.
    momentum: Vec<Expr>,
    /// ∂φ_d/∂q_j for each dependent velocity and each of the n coordinates.
    slope: Vec<Vec<Expr>>,
}

impl<'a> Reduction<'a> {
    fn new(subject: &'a Subject<'a>) -> Option<Reduction<'a>> {
        let system = subject.cx.system;
        let g = &system.graph;
        Some(Reduction {
            subject,
            independent: subject.independent(),
            momentum: g.gradient(system.lagrangian, &system.velocity_symbols()),
            slope: slopes(subject)?,
        })
    }

    /// `D(∂L*/∂v_s) - ∂L*/∂q_s - Σ_d B_ds ∂L*/∂q_d - Q*_s`.
    fn equations(&self) -> Vec<Expr> {
        let system = self.subject.cx.system;
        let g = &system.graph;
        let basis = &self.subject.natural.basis;
        let gradient: Vec<Expr> = (0..system.n())
            .map(|j| self.restricted_gradient(j))
            .collect();
        (0..self.independent.len())
            .map(|sigma| {
                let momentum: Vec<Expr> = (0..system.n())
                    .map(|i| g.mul(&[self.momentum[i], basis[i][sigma]]))
                    .collect();
                let mut parts = vec![system.total_derivative(g.add(&momentum))];
                for i in 0..system.n() {
                    let along = g.add(&[gradient[i], system.forces[i]]);
                    parts.push(g.neg(g.mul(&[along, basis[i][sigma]])));
                }
                g.add(&parts)
            })
            .collect()
    }

    /// `D(Σ_d p_d B_ds)`, by which the momenta of L* differ from those of L.
    fn moved_momenta(&self) -> Vec<Expr> {
        let system = self.subject.cx.system;
        let g = &system.graph;
        let chart = &self.subject.natural;
        (0..self.independent.len())
            .map(|sigma| {
                let dependent = chart.dependent.iter();
                let parts: Vec<Expr> = dependent
                    .map(|&d| g.mul(&[self.momentum[d], chart.basis[d][sigma]]))
                    .collect();
                system.total_derivative(g.add(&parts))
            })
            .collect()
    }

    /// `∂L*/∂q_j = ∂L/∂q_j + Σ_d p_d ∂φ_d/∂q_j`.
    fn restricted_gradient(&self, j: usize) -> Expr {
        let system = self.subject.cx.system;
        let g = &system.graph;
        let mut parts = vec![g.diff(system.lagrangian, system.coordinates[j].q_symbol)];
        for (&d, slope) in self.subject.natural.dependent.iter().zip(&self.slope) {
            parts.push(g.mul(&[self.momentum[d], slope[j]]));
        }
        g.add(&parts)
    }

    /// `D B_ds - ∂φ_d/∂q_s - Σ_e B_es ∂φ_d/∂q_e`, d by d.
    fn curvature(&self) -> Vec<Expr> {
        let system = self.subject.cx.system;
        let g = &system.graph;
        let chart = &self.subject.natural;
        let mut all = Vec::new();
        for (&d, slope) in chart.dependent.iter().zip(&self.slope) {
            for sigma in 0..self.independent.len() {
                let mut curvature = vec![system.total_derivative(chart.basis[d][sigma])];
                for (row, &slope) in chart.basis.iter().zip(slope) {
                    curvature.push(g.neg(g.mul(&[row[sigma], slope])));
                }
                all.push(g.add(&curvature));
            }
        }
        all
    }

    /// `Σ_d p_d ( D B_ds - ∂φ_d/∂q_s - Σ_e B_es ∂φ_d/∂q_e )`.
    fn voronets(&self) -> Vec<Expr> {
        let system = self.subject.cx.system;
        let g = &system.graph;
        let chart = &self.subject.natural;
        (0..self.independent.len())
            .map(|sigma| {
                let mut parts = Vec::new();
                for (&d, slope) in chart.dependent.iter().zip(&self.slope) {
                    let mut curvature = vec![system.total_derivative(chart.basis[d][sigma])];
                    for (row, &slope) in chart.basis.iter().zip(slope) {
                        curvature.push(g.neg(g.mul(&[row[sigma], slope])));
                    }
                    parts.push(g.mul(&[self.momentum[d], g.add(&curvature)]));
                }
                g.add(&parts)
            })
            .collect()
    }
}

/// `∂φ/∂q = -J_d⁻¹ ∂f/∂q`, from f(q, φ, t) = 0.
fn slopes(subject: &Subject<'_>) -> Option<Vec<Vec<Expr>>> {
    let (cx, system) = (subject.cx, subject.cx.system);
    let g = &system.graph;
    let chart = &subject.natural;
    let f: Vec<Expr> = chart
        .rows
        .iter()
        .map(|&row| cx.terms.constraints[row])
        .collect();
    let dependent: Vec<Symbol> = chart
        .dependent
        .iter()
        .map(|&d| system.coordinates[d].v_symbol)
        .collect();
    let matrix = g.jacobian(&f, &dependent).concat();
    let mut slopes = vec![Vec::new(); dependent.len()];
    for c in &system.coordinates {
        let rhs: Vec<Expr> = f.iter().map(|&f| g.neg(g.diff(f, c.q_symbol))).collect();
        for (row, value) in slopes.iter_mut().zip(g.solve(&matrix, &rhs).ok()?) {
            row.push(value);
        }
    }
    Some(slopes)
}
