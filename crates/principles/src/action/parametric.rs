//! `action.parametric`: coordinates and time as functions of a parameter (T1 §6.3, §6.4).
//!
//! The formulations `parametric` and `parametric-canonical` state the equations; here is decided what the theory says of them:
//! the identity among the n + 1 equations, the energy equation as the last, `μ = t'² λ`, the relation `K(x, y) = 0` to which the
//! momenta `y = ∂Λ/∂x'` are tied and its invariance, and the passage to the principles of Lagrange and Jacobi by removing t'.

use crate::words::formula;
use chetaev_mechanics::claims::formulation::{basis, derive, manifold, REFERENCE};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::legendre::Legendre;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{formulation, Equations, Manifold};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `action.parametric`.
#[derive(Clone, Copy, Debug)]
pub struct Parametric;

impl Claim for Parametric {
    fn id(&self) -> &'static str {
        "action.parametric"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Coordinates and time as functions of a parameter"
    }

    fn explanation(&self) -> &'static str {
        "With x = (q, t) as functions of τ, Λ(x, x') = L(q, q'/t', t) t' and F(x, x') = f(q, q'/t', t), the principle δ∫Λ dτ = 0 has n + 1 equations \
         d/dτ(∂Λ/∂x') − ∂Λ/∂x = Q + Σ μ ∂F/∂x'. Decided are: they give the motion, with μ = t'² λ; their contraction with x' vanishes for every curve \
         and all μ, so that τ is free; the equation of t is the energy equation, a consequence of the others. The momenta y = ∂Λ/∂x' = (p, −H) are tied by one relation \
         K(x, y) = p_t + H(q, p, t) = 0, found by eliminating x'; K is an integral of the canonical equations of extended phase space for arbitrary μ, also where L and f contain the time: there every system is conservative. \
         K may be replaced by any function with the same zeros and dK ≠ 0 there; K² is none, since its differential vanishes where K = 0. Where t is cyclic, Λ − ∂Λ/∂t' t' = (Σ p v) t' is the \
         integrand of Lagrange's principle, and with t' from H = h that of Jacobi's; K may then be ½ b (p − a)(p − a)/(h + L₀) − 1. Example: L = v²/2 has Λ = q'²/(2 t'), y = (q'/t', −q'²/(2 t'²)), K = p_t + p²/2."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

/// One thing after another: what is to vanish, what other claims have proved, and the words for both.
struct Story {
    residuals: Vec<Expr>,
    /// Verdicts of other claims that are no proofs.
    open: Vec<Verdict>,
    said: Vec<String>,
    formulas: Vec<Option<Formula>>,
}

impl Story {
    /// A function that vanishes for all curves, and what it says.
    fn vanishes(&mut self, residual: Expr, said: impl Into<String>) {
        self.residuals.push(residual);
        self.said.push(said.into());
    }

    /// What another claim says, which is cited where it is proved.
    fn cites(&mut self, cx: &Context<'_>, id: &str, said: &str) {
        let verdict = cx.finding(id).verdict.clone();
        match verdict {
            Verdict::Proved(_) => self.said.push(format!("{said} (`{id}`)")),
            other => self.open.push(other),
        }
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let extended = Extended::new(cx)?;
    let mut story = Story {
        residuals: Vec::new(),
        open: Vec::new(),
        said: Vec::new(),
        formulas: vec![formula(cx, "Λ(x, x')", None, extended.lagrangian)],
    };
    story.cites(
        cx,
        "formulation.equivalent#parametric",
        "the n + 1 equations in τ give the motion",
    );
    story.cites(
        cx,
        "formulation.identity#parametric",
        "one identity holds among them",
    );
    story.vanishes(
        extended.energy_equation(cx),
        "that of t is the energy equation",
    );
    let without_hamiltonian = matches!(
        cx.finding("model.hessian-regular").verdict,
        Verdict::Refuted(_)
    );
    let mut multipliers = None;
    if !cx.selection.rows.is_empty() {
        multipliers = Some(extended.multipliers(cx)?);
        story.said.push("μ = t'² λ".into());
    }
    if without_hamiltonian {
        let text = "the momenta are tied by more than one relation, as ∂²L/∂v∂v is singular";
        story.said.push(text.into());
    } else {
        in_phase_space(cx, &extended, &mut story)?;
    }
    passage(cx, &extended, &mut story, without_hamiltonian)?;
    let on = "for all curves in τ and all μ";
    let free = Manifold::default();
    let identities = cx.prover.identity(cx.system, &story.residuals, &free, on);
    let further = multipliers.into_iter().chain(story.open);
    let mut verdict = further.fold(identities, Verdict::and);
    let sentence = match &verdict {
        Verdict::Proved(_) => story.said.join("; "),
        _ => "the equations with a parameter and what follows from them".into(),
    };
    verdict.prefix(&sentence);
    Ok(Finding {
        verdict,
        formulas: story.formulas.into_iter().flatten().collect(),
    })
}

/// The extended configuration space, as the formulation delivers it.
pub(super) struct Extended {
    equations: Equations,
    /// Λ.
    pub(super) lagrangian: Expr,
    /// x'_a with their derivatives, a = 1..n+1.
    pub(super) rates: Vec<Expr>,
    seconds: Vec<Expr>,
    symbols: Vec<Symbol>,
}

impl Extended {
    pub(super) fn new(cx: &Context<'_>) -> Result<Extended, DeriveError> {
        let g = &cx.system.graph;
        let equations = derive(cx, "parametric")?;
        let meaning = "Lagrangian in extended configuration space";
        let lagrangian = equations.objects.iter().find(|o| o.meaning == meaning);
        let lagrangian = lagrangian.ok_or(DeriveError::NotStated("the extended Lagrangian"))?;
        let variables = equations.variables.iter();
        Ok(Extended {
            lagrangian: lagrangian.value,
            rates: variables.clone().map(|x| x.value).collect(),
            seconds: variables.clone().map(|x| g.symbol(&x.name, 1)).collect(),
            symbols: variables.map(|x| x.symbol).collect(),
            equations,
        })
    }

    /// q', and t'.
    fn parts(&self) -> (&[Expr], Expr) {
        let n = self.rates.len() - 1;
        (&self.rates[..n], self.rates[n])
    }

    /// v as `q'/t'`.
    fn velocities(&self, cx: &Context<'_>) -> Vec<(Expr, Expr)> {
        let (rates, time) = self.parts();
        let pairs = cx.system.coordinates.iter().zip(rates);
        pairs
            .map(|(c, &w)| (c.v, cx.system.graph.div(w, time)))
            .collect()
    }

    /// y = ∂Λ/∂x'.
    pub(super) fn momenta(&self, cx: &Context<'_>) -> Vec<Expr> {
        cx.system.graph.gradient(self.lagrangian, &self.symbols)
    }

    /// The equation of t at τ = t, left minus right side, plus `DH + ∂L/∂t − Σ Q v − Σ μ ∂f/∂v·v`.
    fn energy_equation(&self, cx: &Context<'_>) -> Expr {
        let (system, g) = (cx.system, &cx.system.graph);
        let group = self.equations.groups.first();
        let Some(last) = group.and_then(|group| group.equations.last()) else {
            return g.one();
        };
        let mut at_time: Vec<(Expr, Expr)> = Vec::new();
        let (rates, time) = self.parts();
        for (i, c) in system.coordinates.iter().enumerate() {
            at_time.push((rates[i], c.v));
            at_time.push((self.seconds[i], c.a));
        }
        at_time.push((time, g.one()));
        at_time.push((self.seconds[rates.len()], g.zero()));
        let stated = g.substitute(g.sub(last.left, last.right), &at_time);
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let basis = basis(cx);
        let names = basis.constraint_names().into_iter();
        let mu = names.map(|name| {
            let wanted = format!("mu_{name}");
            g.symbol(
                &chetaev_mechanics::equations::unused_name(system, &wanted),
                0,
            )
        });
        let mut parts = vec![
            stated,
            system.total_derivative(system.energy()),
            system.time_derivative(system.lagrangian),
            g.neg(dot(g, &system.forces, &velocities)),
        ];
        for (mu, row) in mu.zip(basis.jacobian()) {
            parts.push(g.neg(g.mul(&[mu, dot(g, &row, &velocities)])));
        }
        g.add(&parts)
    }

    /// λ by `μ/t'²` against those of Routh's equations.
    fn multipliers(&self, cx: &Context<'_>) -> Result<Verdict, DeriveError> {
        let (system, g) = (cx.system, &cx.system.graph);
        let routh = derive(cx, REFERENCE)?;
        let values: Vec<Expr> = self.equations.multipliers.iter().map(|&(_, e)| e).collect();
        let natural = self.equations.in_natural_state(system, &values);
        let pairs = natural.into_iter().zip(&routh.multipliers);
        let residuals: Vec<Expr> = pairs.map(|(a, &(_, b))| g.sub(a, b)).collect();
        let on = "on the constraint manifold";
        Ok(cx.prover.identity(system, &residuals, &manifold(cx), on))
    }
}

/// The relation among the momenta, `K = p_t + H`, and that it is kept.
fn in_phase_space(
    cx: &Context<'_>,
    extended: &Extended,
    story: &mut Story,
) -> Result<(), DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let canonical = derive(cx, "parametric-canonical")?;
    let meaning = "relation among the momenta of extended phase space";
    let relation = canonical.objects.iter().find(|o| o.meaning == meaning);
    let relation = relation.ok_or(DeriveError::NotStated("K"))?.value;
    let legendre = Legendre::new(system)?;
    let time = canonical.variables.last().map(|x| x.value);
    let momenta = legendre.momenta.iter().map(|p| p.value).chain(time);
    let mut pairs: Vec<(Expr, Expr)> = momenta.zip(extended.momenta(cx)).collect();
    // Where H stays implicit in p, its velocities are those of the curve.
    pairs.extend(extended.velocities(cx));
    let eliminated = g.substitute(relation, &pairs);
    let form = match legendre.is_explicit {
        true => "the elimination of x' from y = ∂Λ/∂x' gives K = p_t + H(q, p, t) = 0",
        false => "y = ∂Λ/∂x' is tied by K = p_t + H = 0, with the velocities implicit functions of (q, p, t)",
    };
    story.vanishes(eliminated, form);
    story.cites(
        cx,
        "formulation.identity#parametric-canonical",
        "K is an integral for all μ",
    );
    story.cites(
        cx,
        "formulation.equivalent#parametric-canonical",
        "its canonical equations give the motion",
    );
    if legendre.is_explicit {
        story.formulas.push(formula(cx, "K(x, y)", None, relation));
    }
    Ok(())
}

/// Λ without the cyclic t, Lagrange's integrand; with t' by H = h, Jacobi's; and K for it.
fn passage(
    cx: &Context<'_>,
    extended: &Extended,
    story: &mut Story,
    without_hamiltonian: bool,
) -> Result<(), DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let jacobi = formulation("jacobi").map(|f| f.card());
    if let Some(obstacle) = jacobi.and_then(|card| cx.obstacle_of(card)) {
        let Verdict::NotApplicable { hypothesis, .. } = obstacle else {
            return Ok(());
        };
        let text =
            format!("the passage to the principles of Lagrange and Jacobi stops at `{hypothesis}`");
        story.said.push(text);
        return Ok(());
    }
    let path = derive(cx, "jacobi")?;
    let energy = path.variables.last().map_or(g.zero(), |x| x.value);
    let found = |meaning: &str| {
        let object = path.objects.iter().find(|o| o.meaning == meaning);
        object
            .map(|o| o.value)
            .ok_or(DeriveError::NotStated("Jacobi's integrand"))
    };
    let integrand = found("integrand of Jacobi's principle")?;
    let metric = found("half the square of the arc length element")?;
    let (rates, time) = extended.parts();
    let momenta = extended.momenta(cx);
    // Σ p q', which is Λ − ∂Λ/∂t' t'.
    let lagrange = dot(g, &momenta[..rates.len()], rates);
    let routhian = g.sub(extended.lagrangian, g.mul(&[momenta[rates.len()], time]));
    story.vanishes(
        g.sub(routhian, lagrange),
        "without the cyclic t, Λ − ∂Λ/∂t' t' = (Σ p v) t' is the integrand of Lagrange's principle",
    );
    let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
    let kinetic = g.add(&[energy, g.substitute(system.lagrangian, &at_rest)]);
    let twice = |e: Expr| g.sqrt(g.mul(&[g.integer(2), e]));
    let rate = g.div(twice(metric), twice(kinetic));
    let at_energy = g.substitute(lagrange, &[(time, rate)]);
    story.vanishes(
        g.sub(at_energy, integrand),
        "with t' by H = h it is that of Jacobi's",
    );
    // Where ∂²L/∂v∂v is singular there is no H(q, p), whatever form the solution for v takes.
    let legendre = Legendre::new(system).ok().filter(|_| !without_hamiltonian);
    if let Some(legendre) = legendre.filter(|l| l.is_explicit) {
        let by_path = g.gradient(integrand, &extended.symbols[..rates.len()]);
        let pairs: Vec<(Expr, Expr)> = legendre
            .momenta
            .iter()
            .map(|p| p.value)
            .zip(by_path)
            .collect();
        let kept = g.sub(legendre.hamiltonian, energy);
        let relation = g.div(kept, kinetic);
        story.vanishes(g.substitute(kept, &pairs), "and K may be (H − h)/(h + L₀)");
        let caption = "K of the paths of energy h";
        story.formulas.push(formula(cx, caption, None, relation));
    }
    Ok(())
}
