//! The motion does not depend on the coordinates that describe it.

use super::{Expected, Kind, Subject, Trial};
use crate::generate::change;
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::formulations::{Basis, Formulation, Routh};
use chetaev_mechanics::particles;
use chetaev_mechanics::sample::radicands;
use chetaev_mechanics::system::{Particle, Thrust};
use chetaev_mechanics::{
    Characteristics, Context, Prepared, Registry, System, SystemParts, FORMULATIONS,
};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// Accelerations and multipliers of the system in new coordinates s, `q = Φ(s, t)`, are those of the system itself:
/// `D²Φ = a(Φ, DΦ, t)` and equal λ, as f is only rewritten, not multiplied.
pub(super) fn invariance(subject: &Subject<'_>) -> Option<Trial> {
    let change = Change::new(
        subject,
        subject.cx.system.is_rheonomic(subject.cx.system.lagrangian),
    );
    let verdict = match change.verdict(subject) {
        Ok(verdict) => verdict,
        Err(problem) => Verdict::undecided(problem),
    };
    Some(Trial {
        kind: Kind::Other,
        formulation: "",
        law: "the motion is the same in other coordinates",
        about: change.text(subject),
        expected: Expected::Proved,
        verdict,
        seconds: 0.0,
    })
}

/// Every how many systems the verdicts are compared: it takes as long as all other laws together.
const VERDICTS_EVERY: u64 = 10;

/// Frobenius' condition under roots takes a minute where there are more coordinates.
const INTEGRABLE_UP_TO: usize = 3;

/// What is said of a system in coordinates s, `q = Φ(s)`, is what is said of it in q; properties of the coordinates
/// themselves, of Chaplygin's kind and Cartesian, excepted.
pub(super) fn same_verdicts(subject: &Subject<'_>) -> Option<Trial> {
    if !subject.seed.is_multiple_of(VERDICTS_EVERY) {
        return None;
    }
    let change = Change::new(subject, false);
    Some(Trial {
        kind: Kind::Other,
        formulation: "",
        law: "no verdict changes with the coordinates",
        about: change.text(subject),
        expected: Expected::Proved,
        verdict: change.changed(subject).unwrap_or_else(Verdict::undecided),
        seconds: 0.0,
    })
}

/// The claims that are compared.
fn compared(system: &System) -> Vec<String> {
    let mut claims = vec![
        "model.accelerations-unique",
        "model.hessian-regular",
        "model.constraints-linear",
        "model.constraints-homogeneous",
    ];
    let stated: Vec<Expr> = system.constraints.iter().map(|c| c.f).collect();
    if system.n() <= INTEGRABLE_UP_TO || radicands(&system.graph, &stated).is_empty() {
        claims.push("model.constraints-integrable");
    }
    let of_coordinates = ["model.chaplygin", "model.cartesian-coordinates"];
    let formulations = FORMULATIONS
        .iter()
        .map(|f| f.card())
        .filter(|card| card.relation == Relation::Equivalent)
        .filter(|card| !card.requires.iter().any(|id| of_coordinates.contains(id)))
        .map(|card| format!("formulation.equivalent#{}", card.name));
    claims
        .iter()
        .map(|id| id.to_string())
        .chain(formulations)
        .collect()
}

/// A change of coordinates that is invertible everywhere.
struct Change {
    names: Vec<String>,
    /// Φ(s, t).
    q: Vec<Expr>,
    /// DΦ.
    v: Vec<Expr>,
}

impl Change {
    /// With t where `moving`.
    fn new(subject: &Subject<'_>, moving: bool) -> Change {
        let system = subject.cx.system;
        let g = &system.graph;
        let n = system.n();
        let mut random = Random::stream(subject.seed, 0xc00d);
        let names: Vec<String> = (1..=n).map(|i| format!("s_{i}")).collect();
        let s: Vec<Expr> = names.iter().map(|name| g.symbol(name, 0)).collect();
        let t = moving.then(|| g.symbol("t", 0));
        let q = change(g, &mut random, &s, t, false);
        let moves = |name: &str| names.iter().any(|s| s == name);
        let v = q.iter().map(|&e| g.total_derivative(e, &moves)).collect();
        Change { names, q, v }
    }

    /// Rewrites functions of (q, v, t).
    fn rewrite(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let mut pairs = Vec::new();
        for (i, c) in system.coordinates.iter().enumerate() {
            pairs.push((c.q, self.q[i]));
            pairs.push((c.v, self.v[i]));
        }
        system.graph.substitute_all(es, &pairs)
    }

    /// The system in the new coordinates: forces are covectors.
    fn system(&self, system: &System) -> Result<System, String> {
        let g = &system.graph;
        let forces = self.rewrite(system, &own_forces(system));
        let forces = self
            .names
            .iter()
            .map(|name| {
                let symbol = g.intern_symbol(name, 0);
                let parts: Vec<Expr> = forces
                    .iter()
                    .zip(&self.q)
                    .map(|(&force, &q)| g.mul(&[force, g.diff(q, symbol)]))
                    .collect();
                (name.clone(), g.add(&parts))
            })
            .collect();
        let stated: Vec<Expr> = system.constraints.iter().map(|c| c.f).collect();
        let parts = SystemParts {
            name: system.name.clone(),
            coordinates: self.names.clone(),
            parameters: system
                .parameters
                .iter()
                .map(|p| (p.name.clone(), p.value))
                .collect(),
            lagrangian: Some(self.rewrite(system, &[system.lagrangian])[0]),
            forces,
            constraints: system
                .constraints
                .iter()
                .map(|c| c.name.clone())
                .zip(self.rewrite(system, &stated))
                .collect(),
            assumptions: system.assumptions.clone(),
            quasi_velocities: self.quasi_velocities(system),
            particles: self.particles(system),
            masses: system
                .masses
                .iter()
                .map(|m| (m.name.clone(), self.rewrite(system, &[m.rate])[0]))
                .collect(),
            ..SystemParts::default()
        };
        System::new(system.graph.clone(), parts).map_err(|problem| problem.to_string())
    }

    /// Quasi-velocities are the same functions of the state; a frame of fields is given by its forms.
    fn quasi_velocities(&self, system: &System) -> Vec<(String, Expr)> {
        let quasi = system.quasi_velocities.iter();
        quasi
            .map(|quasi| {
                let definition = self.rewrite(system, &[quasi.definition])[0];
                (quasi.name.clone(), definition)
            })
            .collect()
    }

    fn thrust(&self, system: &System, thrust: &Thrust) -> Thrust {
        let all = |es: &[Expr]| self.rewrite(system, es);
        match thrust {
            Thrust::Isotropic => Thrust::Isotropic,
            Thrust::RelativeVelocity(u) => Thrust::RelativeVelocity(all(u)),
            Thrust::ExhaustSpeed(c) => Thrust::ExhaustSpeed(all(&[*c])[0]),
            Thrust::AbsoluteVelocity(w) => Thrust::AbsoluteVelocity(all(w)),
            Thrust::Force(force) => Thrust::Force(all(force)),
        }
    }

    fn particles(&self, system: &System) -> Vec<Particle> {
        let particles = system.particles.iter();
        particles
            .map(|particle| Particle {
                mass: self.rewrite(system, &[particle.mass])[0],
                thrust: self.thrust(system, &particle.thrust),
                position: self.rewrite(system, &particle.position),
                force: self.rewrite(system, &particle.force),
                ..particle.clone()
            })
            .collect()
    }

    /// Proved where all verdicts are the same; else the first that differs.
    fn changed(&self, subject: &Subject<'_>) -> Result<Verdict, String> {
        let new = self.system(subject.cx.system)?;
        let prepared = Prepared::new(&new).map_err(|problem| problem.to_string())?;
        let registry = Registry::new(super::CLAIMS);
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&new, terms, selection, &registry, subject.cx.prover.clone());
        for id in compared(&new) {
            let (before, after) = (subject.cx.finding(&id), cx.finding(&id));
            let words = (before.verdict.word(), after.verdict.word());
            if words.0 != words.1 {
                let detail = after.verdict.detail();
                return Err(format!("`{id}` is {}, then {}: {detail}", words.0, words.1));
            }
        }
        Ok(Verdict::Proved(Proof::exact(
            "",
            "every verdict is the same",
        )))
    }

    fn verdict(&self, subject: &Subject<'_>) -> Result<Verdict, String> {
        let old = subject.cx.system;
        let new = self.system(old)?;
        let prepared = Prepared::new(&new).map_err(|problem| problem.to_string())?;
        let basis = Basis {
            system: &new,
            terms: &prepared.terms,
            selection: &prepared.selection,
            characteristics: None,
        };
        let routh = Routh.equations(&basis).map_err(|p| p.to_string())?;
        let chart =
            Characteristics::independent_velocities(&new, &prepared.terms, &prepared.selection)
                .map_err(|problem| problem.to_string())?;
        let g = &new.graph;
        let motion: Vec<(Expr, Expr)> = new
            .coordinates
            .iter()
            .zip(&routh.accelerations)
            .map(|(c, &a)| (c.a, a))
            .collect();
        let second: Vec<Expr> = self.v.iter().map(|&v| new.total_derivative(v)).collect();
        let mut here = g.substitute_all(&second, &motion);
        let mut there = subject.routh.accelerations.clone();
        for (l, lambda) in &routh.multipliers {
            let same = subject.routh.multipliers.iter().find(|(m, _)| m == l);
            let (_, other) = same.ok_or("another constraint was left out")?;
            here.push(*lambda);
            there.push(*other);
        }
        let there = self.rewrite(old, &there);
        let residuals: Vec<Expr> = here
            .iter()
            .zip(&there)
            .map(|(&a, &b)| g.sub(a, b))
            .collect();
        let residuals = chart.restrict(&new, &residuals);
        let on = "on the constraint manifold in the new coordinates";
        Ok(subject
            .cx
            .prover
            .identity(&new, &residuals, &chart.manifold, on))
    }

    fn text(&self, subject: &Subject<'_>) -> String {
        let system = subject.cx.system;
        let equations: Vec<String> = system
            .coordinates
            .iter()
            .zip(&self.q)
            .map(|(c, &q)| format!("{} = {}", c.name, system.graph.text(q)))
            .collect();
        equations.join(", ")
    }
}

/// The generalized forces beside those of the particles.
fn own_forces(system: &System) -> Vec<Expr> {
    let own = particles::own_forces(system);
    let both = system.forces.iter().zip(own);
    both.map(|(&force, own)| system.graph.sub(force, own))
        .collect()
}
