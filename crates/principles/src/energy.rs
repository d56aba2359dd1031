//! `energy.integral`: the energy `H = Σ pᵢ vⁱ - L` along the motion (T1 §5.1).
//!
//! Along every motion of Routh's equations
//!
//! `dH/dt = -∂L/∂t + Σ Qᵢ vⁱ + Σ λ_l (∂f^l/∂v · v)` (T1 (16)):
//!
//! contract `W a = b + Jᵀ λ` with v and insert `DH = vᵀ W a + …`. H is an integral when each of the three terms vanishes
//! on the constraint manifold, and only when their sum does; what decides is therefore DH = 0 with the accelerations of
//! the motion, and the three hypotheses explain the result.

use chetaev_mechanics::claims::formulation::{derive, manifold, REFERENCE};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::equations::Equations;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{Manifold, System};
use chetaev_symbolic::{simplify, Expr, Node, Rational, Verdict};

/// The longest dH/dt that is printed with the multipliers inserted.
const PRINTED: u64 = 120;

/// `energy.integral`.
#[derive(Clone, Copy, Debug)]
pub struct EnergyIntegral;

impl Claim for EnergyIntegral {
    fn id(&self) -> &'static str {
        "energy.integral"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The energy is a first integral"
    }

    fn explanation(&self) -> &'static str {
        "The energy H = Σ p v - L, with p = ∂L/∂v of the unconstrained Lagrangian, keeps its value along every motion. \
         Its rate is dH/dt = -∂L/∂t + Σ Q v + Σ λ (∂f/∂v · v): the explicit time in the Lagrangian, the power of the \
         forces that are not in the Lagrangian, among them the reactive forces of masses that vary, and the power of the reactions. The last one vanishes when ∂f/∂v · v = 0 \
         at all states that satisfy the constraints, for example when every constraint is homogeneous in the velocities, \
         of any degree; the constraints may contain the time. The claim is decided by dH/dt = 0 with the accelerations \
         of the motion; the three hypotheses, each decided by itself, say why. `refuted` comes with a state at which \
         the rate is not zero and with the power balance. \
         Example: a particle z' = y x' + b has λ = x' y'/(1 + y²) and dH/dt = b λ, which is 1/2 at b = y = x' = y' \
         = 1; with b = 0 the energy is conserved."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let equations = match derive(cx, REFERENCE) {
            Ok(equations) => equations,
            Err(problem) => {
                let tried = format!("the accelerations could not be derived: {problem}");
                return Verdict::undecided(tried).into();
            }
        };
        let rate = energy_rate(cx.system, &equations.accelerations);
        let hypotheses = hypotheses(cx);
        let mut verdict = on_motion(cx, "dH/dt along the motion", rate);
        let sentence = match &verdict {
            Verdict::Proved(_) => why_conserved(&hypotheses),
            Verdict::Refuted(_) => format!(
                "the energy is not conserved: {}",
                phrases(&hypotheses, |h| !h.holds())
            ),
            _ => format!(
                "known of the hypotheses: {}",
                phrases(&hypotheses, |_| true)
            ),
        };
        verdict = verdict.prefixed(&sentence);
        let mut formulas = vec![Formula {
            caption: "the energy H = Σ p v - L".into(),
            left: None,
            right: written(cx),
        }];
        if !matches!(verdict, Verdict::Proved(_)) {
            formulas.extend(power_balance(cx.system, &hypotheses, &equations));
        }
        Finding { verdict, formulas }
    }
}

/// H as it is read: of a term of L that is homogeneous of degree k in the velocities it contains k − 1 times the term, `T + V` for natural
/// systems with T as it is written; of any other term `Σ v ∂/∂v` of it less the term.
fn written(cx: &Context<'_>) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let (coefficients, terms): (Vec<Rational>, Vec<Expr>) = match g.node(system.lagrangian) {
        Node::Sum { terms, constant } => {
            let own = terms.iter().map(|(e, c)| (c.clone(), *e));
            own.chain([(constant.clone(), g.one())]).unzip()
        }
        _ => (vec![Rational::from(1)], vec![system.lagrangian]),
    };
    let parts = coefficients
        .iter()
        .zip(terms)
        .map(|(c, e)| g.scale(c, of_term(cx, e)));
    g.add(&parts.collect::<Vec<Expr>>())
}

/// Degrees in the velocities that are looked for.
const DEGREES: [i64; 4] = [0, 1, 2, 3];

/// `Σ v ∂e/∂v − e`, as a multiple of e where e is homogeneous.
fn of_term(cx: &Context<'_>, e: Expr) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let slopes = g.gradient(e, &system.velocity_symbols());
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let moved = dot(g, &slopes, &velocities);
    let is_of = |degree: &&i64| {
        let residual = g.sub(moved, g.mul(&[g.integer(**degree), e]));
        let verdict = cx
            .prover
            .identity(system, &[residual], &Manifold::default(), "");
        matches!(verdict, Verdict::Proved(_))
    };
    let degree = match g.any_contains_any(&[e], &system.velocity_symbols()) {
        false => Some(&0),
        true => DEGREES[1..].iter().find(is_of),
    };
    match degree {
        Some(degree) => g.mul(&[g.integer(degree - 1), e]),
        None => g.sub(moved, e),
    }
}

/// DH with the accelerations given: a function of (q, v, t).
pub fn energy_rate(system: &System, accelerations: &[Expr]) -> Expr {
    let g = &system.graph;
    let motion: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .zip(accelerations)
        .map(|(c, &a)| (c.a, a))
        .collect();
    g.substitute(system.total_derivative(system.energy()), &motion)
}

/// `∂f/∂v · v` for a row of the terms, brought by f = 0 to a form free of velocities where f is affine in them.
pub fn reaction_speed(cx: &Context<'_>, row: usize) -> Expr {
    let (g, system) = (&cx.system.graph, cx.system);
    let f = cx.terms.constraints[row];
    if system.constraints[cx.terms.constraint_index[row]].gradient_constant {
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        return g.neg(g.substitute(f, &at_rest));
    }
    let products: Vec<Expr> = system
        .coordinates
        .iter()
        .zip(&cx.terms.jacobian[row])
        .map(|(c, &df)| g.mul(&[c.v, df]))
        .collect();
    g.add(&products)
}

/// The power `Σ Qᵢ vⁱ` of the forces that are not in L.
pub fn force_power(system: &System) -> Expr {
    let g = &system.graph;
    let products: Vec<Expr> = system
        .coordinates
        .iter()
        .zip(&system.forces)
        .map(|(c, &force)| g.mul(&[force, c.v]))
        .collect();
    g.add(&products)
}

/// One of the three hypotheses, as it is for this system; `{}` in the words stands for the constraints it is about.
struct Hypothesis {
    /// Its term of the power balance.
    term: Expr,
    holding: String,
    failing: String,
    constraint: Option<String>,
    verdict: Verdict,
}

impl Hypothesis {
    fn holds(&self) -> bool {
        matches!(self.verdict, Verdict::Proved(_))
    }

    fn phrase(&self) -> String {
        match &self.verdict {
            Verdict::Proved(_) => self.holding.clone(),
            Verdict::Refuted(_) => self.failing.clone(),
            other => format!("whether {} is {}", self.holding, other.word()),
        }
    }
}

fn on_motion(cx: &Context<'_>, name: &str, residual: Expr) -> Verdict {
    let on = if cx.terms.constraints.is_empty() {
        "everywhere outside the singular set of the mass matrix"
    } else {
        "on the constraint manifold outside the singular set of the linear systems"
    };
    let named = [(name.to_string(), residual)];
    cx.prover
        .named_identity(cx.system, &named, &manifold(cx), on)
}

/// ∂L/∂t = 0, ΣQv = 0, and ∂f/∂v · v = 0 on f = 0 for each constraint.
fn hypotheses(cx: &Context<'_>) -> Vec<Hypothesis> {
    let (g, system) = (&cx.system.graph, cx.system);
    let explicit = g.neg(system.time_derivative(system.lagrangian));
    let mut all = vec![Hypothesis {
        term: explicit,
        holding: "∂L/∂t = 0".into(),
        failing: match system.masses.is_empty() {
            true => "L depends on the time".into(),
            false => "L depends on the time, or on masses that change".into(),
        },
        constraint: None,
        verdict: cx.prover.identity(
            system,
            &[explicit],
            &Manifold::default(),
            "identically in q, v, t",
        ),
    }];
    let without_forces = system.forces.iter().all(|&force| g.is_zero(force));
    let power = force_power(system);
    all.push(Hypothesis {
        term: power,
        holding: if without_forces {
            "Q = 0".into()
        } else {
            "the forces Q do no work, Σ Q v = 0".into()
        },
        failing: match system.reactive_forces.iter().all(|&e| g.is_zero(e)) {
            true => "the forces Q do work".into(),
            false => "the forces Q and the reactive forces Ψ do work".into(),
        },
        constraint: None,
        verdict: on_motion(cx, "the power Σ Q v of the forces", power),
    });
    for &row in &cx.selection.rows {
        let constraint = &system.constraints[cx.terms.constraint_index[row]];
        let time = if constraint.rheonomic {
            ", although the time occurs there"
        } else {
            ""
        };
        let speed = reaction_speed(cx, row);
        all.push(Hypothesis {
            term: g.mul(&[multiplier_symbol(system, &constraint.name), speed]),
            holding: format!("∂f/∂v · v = 0 where f = 0 for {{}}{time}"),
            failing: "∂f/∂v · v does not vanish for {}, so the reaction can do work".into(),
            constraint: Some(format!("`{}`", constraint.name)),
            verdict: on_motion(cx, "∂f/∂v · v", speed),
        });
    }
    all
}

/// The words for some of the hypotheses; constraints of which the same is said are named together.
fn phrases(hypotheses: &[Hypothesis], which: impl Fn(&Hypothesis) -> bool) -> String {
    let mut said: Vec<(String, Vec<&str>)> = Vec::new();
    for hypothesis in hypotheses.iter().filter(|h| which(h)) {
        let phrase = hypothesis.phrase();
        let name = hypothesis.constraint.as_deref();
        match said.iter_mut().find(|(known, _)| *known == phrase) {
            Some((_, names)) => names.extend(name),
            None => said.push((phrase, name.into_iter().collect())),
        }
    }
    let said: Vec<String> = said
        .into_iter()
        .map(|(phrase, names)| phrase.replace("{}", &names.join(", ")))
        .collect();
    said.join("; ")
}

fn why_conserved(hypotheses: &[Hypothesis]) -> String {
    let holding = phrases(hypotheses, Hypothesis::holds);
    if hypotheses.iter().all(Hypothesis::holds) {
        return format!("the energy is conserved: {holding}");
    }
    let others = phrases(hypotheses, |h| !h.holds());
    format!("dH/dt = 0 on the motion although not every hypothesis holds: {others}; of the others: {holding}")
}

fn multiplier_symbol(system: &System, constraint: &str) -> Expr {
    system.graph.symbol(&format!("lambda_{constraint}"), 0)
}

/// `dH/dt = -∂L/∂t + Σ Q v + Σ λ (∂f/∂v · v)` without the terms known to vanish; the multipliers as symbols, and with
/// their values where that is short.
fn power_balance(
    system: &System,
    hypotheses: &[Hypothesis],
    equations: &Equations,
) -> Vec<Formula> {
    let g = &system.graph;
    let terms: Vec<Expr> = hypotheses
        .iter()
        .filter(|h| !h.holds())
        .map(|h| h.term)
        .collect();
    let stated = g.add(&terms);
    let mut formulas = vec![Formula {
        caption: "the power balance, dH/dt along the motion".into(),
        left: None,
        right: stated,
    }];
    let values: Vec<(Expr, Expr)> = equations
        .multipliers
        .iter()
        .map(|&(l, value)| {
            (
                multiplier_symbol(system, &system.constraints[l].name),
                value,
            )
        })
        .collect();
    let options = simplify::Options::default();
    let inserted = simplify::simplify(g, g.substitute(stated, &values), &options);
    if inserted != stated && simplify::length(g, inserted) <= PRINTED {
        formulas.push(Formula {
            caption: "dH/dt with the multipliers inserted".into(),
            left: None,
            right: inserted,
        });
    }
    formulas
}
