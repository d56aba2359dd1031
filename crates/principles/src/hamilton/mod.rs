//! Hamilton's principle in four forms (T1 §3; Rumyantsev 1982).
//!
//! All have virtual displacements with δq = 0 at the ends. Each form is built by its own rule for δv, integrated by parts, and
//! its local equations are compared with the formulation that it gives:
//!
//! | form | statement | gives |
//! |---|---|---|
//! | Hölder | `∫(δL + Σ Q δq) dt = 0`, `δv = D(δq)` | Maggi's equations, Routh's with multipliers |
//! | Voronets | `∫(δL* + Σ θ (δv_d − δφ) + Σ Q δq) dt = 0`, `δv = D(δq)` | Voronets' |
//! | Suslov | `∫(δL + Σ θ A δq + Σ Q δq) dt = 0`, `δf = 0` | Voronets', Chaplygin's where they apply |
//! | Helmholtz–Poincaré | `∫(δ(Σ p q' − H) + Σ Q δq) dt = 0`, δp free | canonical with multipliers |

mod central_identity;
mod constants;
mod endpoints;
mod forms_equivalent;
mod helmholtz_poincare;
pub mod hoelder;
mod kerner;
pub(crate) mod phase;
pub mod suslov;
mod told;
pub mod voronets;

pub use central_identity::CentralIdentity;
pub use constants::Constants;
pub use endpoints::Endpoints;
pub use forms_equivalent::FormsEquivalent;
pub use helmholtz_poincare::HelmholtzPoincare;
pub use hoelder::Hoelder;
pub use kerner::Kerner;
pub use suslov::Suslov;
pub use voronets::Voronets;

use crate::variations::{Displacements, Variation};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Context, Finding, Formula};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::{formulation, Basis};
use chetaev_symbolic::{Expr, Verdict};

/// Where the local equations of a form are compared with a formulation: before any equation of motion is used.
const ON_JET: &str = "at all admissible states, for all accelerations";
/// Where they hold.
const ON_MOTIONS: &str = "on every motion, outside the singular set of the linear systems";

/// A form of the principle on the jet of independent velocities.
struct Form {
    /// "Hölder's".
    whose: &'static str,
    /// The formulation whose equations are its local equations.
    gives: &'static str,
    /// The words for these.
    equations: &'static str,
    /// The integrand without the work of the forces.
    integrand: fn(&Displacements<'_>) -> Variation,
    /// The statement for the system, given the work of the forces.
    told: fn(&Context<'_>, &Displacements<'_>, &Variation) -> Vec<Formula>,
}

impl Form {
    /// Decides that the form gives its equations and holds on the motions.
    fn decide(&self, cx: &Context<'_>) -> Finding {
        self.checked(cx).unwrap_or_else(Finding::from)
    }

    fn checked(&self, cx: &Context<'_>) -> Result<Finding, DeriveError> {
        let d = Displacements::new(cx)?;
        let integrand = (self.integrand)(&d);
        let local = with_forces(cx, &d, &d.reduced(&integrand));
        let stated = stated_by(cx, &d, self.gives)?;
        let g = &cx.system.graph;
        let pairs = local.iter().zip(stated);
        let differences: Vec<Expr> = pairs.map(|(&a, b)| g.add(&[a, b])).collect();
        let same = cx
            .prover
            .identity(cx.system, &differences, d.manifold(), ON_JET);
        let holds = holds_on_motions(cx, &d, &local)?;
        let mut verdict = same.and(holds);
        let sentence = match &verdict {
            Verdict::Proved(_) => format!(
                "{} form of Hamilton's principle holds on every motion; integrated by parts it gives {}, for all accelerations",
                self.whose, self.equations
            ),
            Verdict::Refuted(_) => format!("{} form does not hold on the motions", self.whose),
            _ => format!("{} form of Hamilton's principle", self.whose),
        };
        verdict.prefix(&sentence);
        let mut formulas = (self.told)(cx, &d, &work(cx, &d));
        formulas.extend(told::local(cx, &d, &local));
        Ok(Finding { verdict, formulas })
    }
}

/// `Σ Q δq` by the independent displacements.
fn work(cx: &Context<'_>, d: &Displacements<'_>) -> Variation {
    let zero = cx.system.graph.zero();
    Variation {
        value: works(cx, d),
        rate: vec![zero; d.chart.k()],
    }
}

/// `Σ_i Q_i B_is`.
fn works(cx: &Context<'_>, d: &Displacements<'_>) -> Vec<Expr> {
    let forces = d.chart.restrict(cx.system, &cx.system.forces);
    d.chart.contract(cx.system, &forces)
}

/// The covector of a form with the work of the forces.
fn with_forces(cx: &Context<'_>, d: &Displacements<'_>, reduced: &[Expr]) -> Vec<Expr> {
    let g = &cx.system.graph;
    let pairs = reduced.iter().zip(works(cx, d));
    pairs.map(|(&e, q)| g.add(&[e, q])).collect()
}

/// Left minus right sides of a formulation's equations of motion in the chart of `d`.
fn stated_by(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    name: &str,
) -> Result<Vec<Expr>, DeriveError> {
    let basis = Basis {
        characteristics: Some(d.chart.clone()),
        ..basis(cx)
    };
    let known = formulation(name).ok_or(DeriveError::NotStated("the formulation"))?;
    let equations = known.equations(&basis)?;
    let motion = equations.groups.first().map(|group| &group.equations);
    let g = &cx.system.graph;
    Ok(motion
        .into_iter()
        .flatten()
        .map(|e| g.sub(e.left, e.right))
        .collect())
}

/// Whether a covector vanishes with the accelerations of Routh's equations.
///
/// # Errors
/// [`DeriveError`].
pub fn holds_on_motions(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    covector: &[Expr],
) -> Result<Verdict, DeriveError> {
    let residuals = d.on_motion(cx, covector)?;
    let names = d.chart.independent.iter().map(|&i| {
        let name = &cx.system.coordinates[i].name;
        format!("the factor of δ{name} with the accelerations of the motion put in")
    });
    let named: Vec<(String, Expr)> = names.zip(residuals).collect();
    Ok(cx
        .prover
        .named_identity(cx.system, &named, d.manifold(), ON_MOTIONS))
}

/// The covector `E` of a form `∫(integrand + Σ Q δq) dt = Σ ∫ E_s δ_s dt + end terms`, one component for each independent
/// displacement, on the jet (t, q, P, P').
pub fn local_equations(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    integrand: &Variation,
) -> Vec<Expr> {
    with_forces(cx, d, &d.reduced(integrand))
}

/// `Σ_l θ_l · w^l`, as the forms of Voronets and Suslov have it.
fn by_dependent_momenta(d: &Displacements<'_>, variations: &[Variation]) -> Variation {
    let dependent: Vec<Variation> = d
        .chart
        .dependent
        .iter()
        .map(|&i| variations[i].clone())
        .collect();
    d.combination(&d.dependent_momenta(), &dependent)
}

/// What all forms require.
fn requirements() -> Vec<String> {
    vec![
        "model.accelerations-unique".into(),
        "model.masses-free-of-velocity".into(),
    ]
}
