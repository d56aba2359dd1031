//! `cartan.form#F`: Θ(F) is the Cartan form of the Lagrangian and of each constraint (T3 §2).
//!
//! Two conditions determine it: `Θ(F) - F dt` lies in the span of the contact forms θ^s, and `dΘ(F)` in their ideal. The common
//! kernel of the θ^s is spanned by `D = ∂/∂t + v ∂/∂q` and the `∂/∂v`, so these are `Θ(D) = F`, `Θ(∂_v) = 0` and
//! `dΘ(D, ∂_v) = 0`, `dΘ(∂_v, ∂_v) = 0`.

use crate::cartan::{CartanForm, JetField};
use crate::exterior::{Field, Space};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::{Manifold, System};
use chetaev_symbolic::{Expr, Verdict};

/// `cartan.form#F`.
#[derive(Clone, Copy, Debug)]
pub struct Cartan;

/// The subject of the Lagrangian.
const LAGRANGIAN: &str = "L";

impl Claim for Cartan {
    fn id(&self) -> &'static str {
        "cartan.form"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "Θ(F) is the Cartan form of F"
    }

    fn explanation(&self) -> &'static str {
        "Every function F of (t, q, v) has one 1-form Θ(F) that differs from F dt by contact forms θ = dq - v dt and whose differential \
         vanishes where these vanish: Θ(F) = F dt + ∂F/∂v θ. The claim checks both conditions for the Lagrangian (subject \
         L) and for each constraint function: Θ(F) on the direction of motion is F, on ∂/∂v it is zero, and dΘ(F) is zero on all pairs of \
         these directions."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let constraints = cx.system.constraints.iter().filter(|c| c.order == 1);
        std::iter::once(LAGRANGIAN.to_owned())
            .chain(constraints.map(|c| c.name.clone()))
            .map(Some)
            .collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let system = cx.system;
        let mut constraints = system.constraints.iter();
        let function = match subject {
            Some(LAGRANGIAN) | None => system.lagrangian,
            Some(name) => match constraints.find(|c| c.name == name) {
                Some(constraint) => constraint.f,
                None => return Verdict::undecided(format!("there is no function `{name}`")).into(),
            },
        };
        let form = CartanForm::of(system, function);
        let residuals = conditions(system, function, &form);
        let on = "identically in t, q, v";
        Finding {
            verdict: cx
                .prover
                .identity(system, &residuals, &Manifold::default(), on),
            formulas: formulas(system, &form),
        }
    }
}

/// Θ(D) = F and Θ(∂/∂v) = 0, and dΘ vanishes on pairs of the motion D with frozen velocities and the ∂/∂v.
fn conditions(system: &System, function: Expr, form: &CartanForm) -> Vec<Expr> {
    let (g, n) = (&system.graph, system.n());
    let space = Space::Jet(system);
    let mut motion = JetField::zero(system, "D");
    motion.t = g.one();
    motion.q = system.coordinates.iter().map(|c| c.v).collect();
    let theta = form.form(&space);
    let change = theta.d(&space);
    let mut fields = vec![Field::of_jet(&motion)];
    fields.extend((0..n).map(|s| Field::unit(&space, 1 + n + s)));
    let mut residuals = vec![g.sub(theta.on(g, &[&fields[0]]), function)];
    for (b, second) in fields.iter().enumerate() {
        if b > 0 {
            residuals.push(theta.on(g, &[second]));
        }
        let pairs = fields[..b].iter();
        residuals.extend(pairs.map(|first| change.on(g, &[first, second])));
    }
    residuals
}

fn formulas(system: &System, form: &CartanForm) -> Vec<Formula> {
    let g = &system.graph;
    let names = system.coordinates.iter().map(|c| c.name.clone());
    std::iter::once("t".to_owned())
        .chain(names)
        .zip(std::iter::once(form.dt).chain(form.dq.iter().copied()))
        .filter(|(_, e)| !g.is_zero(*e) && g.reachable(&[*e]).len() <= LARGEST)
        .map(|(name, right)| Formula {
            caption: format!("component of Θ along d{name}"),
            left: None,
            right,
        })
        .collect()
}

/// Larger components, in nodes, are not shown.
const LARGEST: usize = 80;
