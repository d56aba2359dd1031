//! The forms of Hamilton's principle written out for a system: what is put into the integral, what is substituted, and the
//! factors that must vanish. Nothing is decided here.

use super::phase::Phase;
use crate::variations::{delta_name, Displacements, Rule, Variation};
use crate::words::{formula, listed};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{Context, Formula};
use chetaev_mechanics::linear::dot;
use chetaev_symbolic::{Expr, Symbol};

/// "+ Σ Q δq" where there are forces outside L.
fn forces(cx: &Context<'_>) -> &'static str {
    let g = &cx.system.graph;
    match cx.system.forces.iter().all(|&q| g.is_zero(q)) {
        true => "",
        false => " + Σ Q δq",
    }
}

/// The names of the independent displacements, "δy, δphi".
fn free(cx: &Context<'_>, d: &Displacements<'_>) -> String {
    let names = d.chart.independent.iter();
    let names: Vec<String> = names
        .map(|&i| format!("δ{}", cx.system.coordinates[i].name))
        .collect();
    listed(&names)
}

/// δq of the dependent coordinates by those of the others.
fn virtual_displacements(cx: &Context<'_>, d: &Displacements<'_>) -> Vec<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    let all = d.displacements();
    let dependent = d.chart.dependent.iter();
    dependent
        .filter_map(|&i| {
            let name = &system.coordinates[i].name;
            let left = g.symbol(&delta_name(system, i), 0);
            let caption = format!("Chetaev's condition substitutes δ{name}");
            formula(cx, caption, Some(left), d.written(&all[i]))
        })
        .collect()
}

/// The factors of the independent displacements after integration by parts.
pub(super) fn local(cx: &Context<'_>, d: &Displacements<'_>, factors: &[Expr]) -> Vec<Formula> {
    let g = &cx.system.graph;
    let pairs = d.chart.independent.iter().zip(factors);
    pairs
        .filter_map(|(&i, &factor)| {
            let name = &cx.system.coordinates[i].name;
            let caption = format!("integrated by parts, the factor of δ{name} must vanish");
            let shown = formula(cx, caption, None, factor)?;
            Some(Formula {
                left: Some(shown.right),
                right: g.zero(),
                ..shown
            })
        })
        .collect()
}

/// Hölder's form: δL by all δq and D(δq), then Chetaev's condition, then the integrand.
pub(super) fn hoelder(cx: &Context<'_>, d: &Displacements<'_>, work: &Variation) -> Vec<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    let symbols = |order: u32| -> Vec<Expr> {
        let places = 0..system.n();
        places
            .map(|i| g.symbol(&delta_name(system, i), order))
            .collect()
    };
    let (dq, rates) = (symbols(0), symbols(1));
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let varied = [
        dot(g, &slopes, &dq),
        dot(g, &momenta, &rates),
        dot(g, &system.forces, &dq),
    ];
    let what = format!("δL{}", forces(cx));
    let integral = match forces(cx) {
        "" => what.clone(),
        _ => format!("({what})"),
    };
    let caption = format!("the statement is ∫{integral} dt = 0 with δv = D(δq); here {what}");
    let mut formulas: Vec<Formula> = formula(cx, caption, None, g.add(&varied))
        .into_iter()
        .collect();
    formulas.extend(virtual_displacements(cx, d));
    let integrand = d.sum(&d.of_lagrangian(Rule::Hoelder), work);
    let caption = format!("so ∫ of this by the time is zero for all {}", free(cx, d));
    formulas.extend(formula(cx, caption, None, d.written(&integrand)));
    formulas
}

/// L* and the momenta θ, which both other forms in the independent velocities need.
fn eliminated(cx: &Context<'_>, d: &Displacements<'_>) -> Vec<Formula> {
    let names = d.chart.dependent.iter();
    let names: Vec<String> = names
        .map(|&i| format!("{}'", cx.system.coordinates[i].name))
        .collect();
    let caption = match names.is_empty() {
        true => "L*, which is L as nothing is eliminated".into(),
        false => format!("L*, the Lagrangian with {} eliminated", listed(&names)),
    };
    let mut formulas: Vec<Formula> = formula(cx, caption, None, d.restricted_lagrangian())
        .into_iter()
        .collect();
    let momenta = names.iter().zip(d.dependent_momenta());
    formulas.extend(momenta.filter_map(|(name, theta)| {
        let caption = format!("θ of {name}, the momentum ∂L/∂{name} of the full L");
        formula(cx, caption, None, theta)
    }));
    formulas
}

/// Voronets' form: L*, θ, what varied curves miss of the constraints.
pub(super) fn voronets(cx: &Context<'_>, d: &Displacements<'_>, work: &Variation) -> Vec<Formula> {
    let mut formulas = eliminated(cx, d);
    let pairs = d.velocities(Rule::Hoelder).into_iter();
    let missed: Vec<Variation> = pairs
        .zip(d.velocities(Rule::Suslov))
        .map(|(curve, state)| d.difference(&curve, &state))
        .collect();
    formulas.extend(d.chart.dependent.iter().filter_map(|&i| {
        let name = &cx.system.coordinates[i].name;
        let caption = format!("δ{name}' − δφ of varied curves, with {name}' = φ on the motion");
        formula(cx, caption, None, d.written(&missed[i]))
    }));
    let caption = format!(
        "the statement is ∫(δL* + Σ θ (δv − δφ){}) dt = 0 with δv = D(δq), for all {}; here δL*{}",
        forces(cx),
        free(cx, d),
        forces(cx)
    );
    formulas.extend(statement(cx, d, work, [&caption, "and Σ θ (δv − δφ)"]));
    formulas
}

/// Suslov's form: L*, θ, the terms Σ θ A δq.
pub(super) fn suslov(cx: &Context<'_>, d: &Displacements<'_>, work: &Variation) -> Vec<Formula> {
    let mut formulas = eliminated(cx, d);
    let caption = format!(
        "the statement is ∫(δL + Σ θ A δq{}) dt = 0 with δf = 0, for all {}; here δL{}, which is δL*{0}",
        forces(cx),
        free(cx, d),
        forces(cx)
    );
    let more = "and Σ θ A δq, with the curvature coefficients A of `variation.hoelder`";
    formulas.extend(statement(cx, d, work, [&caption, more]));
    formulas
}

/// What stands under the integral of a form with L*: δL* with the work of the forces, and Σ θ (δv − δφ) where velocities are
/// dependent.
fn statement(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    work: &Variation,
    [caption, more]: [&str; 2],
) -> Vec<Formula> {
    let varied = d.sum(&d.of_lagrangian(Rule::Suslov), work);
    let mut formulas: Vec<Formula> = formula(cx, caption, None, d.written(&varied))
        .into_iter()
        .collect();
    if !d.chart.dependent.is_empty() {
        formulas.extend(formula(cx, more, None, d.written(&d.gyroscopic())));
    }
    formulas
}

/// The form of Helmholtz and Poincaré: H, the integrand, and the factors of δp and of the virtual δq.
pub(super) fn helmholtz_poincare(cx: &Context<'_>, phase: &Phase) -> Vec<Formula> {
    if !phase.legendre.is_explicit {
        return Vec::new();
    }
    let (system, g) = (cx.system, &cx.system.graph);
    let hamiltonian = phase.legendre.hamiltonian;
    let mut formulas: Vec<Option<Formula>> =
        vec![formula(cx, "the Hamiltonian H(q, p, t)", None, hamiltonian)];
    let work = dot(g, &system.forces, &phase.displacements);
    let integral = match forces(cx) {
        "" => "δ(Σ p Dq − H)".to_string(),
        forces => format!("(δ(Σ p Dq − H){forces})"),
    };
    let caption = format!("the statement is ∫{integral} dt = 0; its integrand");
    let integrand = g.add(&[phase.varied(cx), work]);
    formulas.push(formula(cx, caption, None, integrand));
    let rates = phase.rates.iter().zip(&phase.legendre.by_momenta);
    formulas.extend(rates.zip(&phase.legendre.momenta).map(|((&rate, &v), p)| {
        let caption = format!("δ{} is free, so", p.name);
        formula(cx, caption, Some(rate), v)
    }));
    formulas.extend(factors(cx, phase));
    formulas.into_iter().flatten().collect()
}

/// `Σ_i (p_i' + ∂H/∂q_i − Q_i) B_is = 0`.
fn factors(cx: &Context<'_>, phase: &Phase) -> Vec<Option<Formula>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let Ok(chart) = basis(cx).independent_velocities() else {
        return Vec::new();
    };
    let displacements = phase.displacements.iter();
    let symbols: Vec<Symbol> = displacements.filter_map(|&e| g.as_symbol(e)).collect();
    let slopes = g.gradient(phase.varied(cx), &symbols);
    let parts = phase.legendre.momenta.iter().zip(slopes);
    let covector: Vec<Expr> = parts
        .zip(&system.forces)
        .map(|((p, slope), &force)| g.add(&[p.rate, g.neg(slope), g.neg(force)]))
        .collect();
    let columns = chart.independent.iter().enumerate();
    columns
        .map(|(s, &i)| {
            let name = &system.coordinates[i].name;
            let caption = format!("integrated by parts, the factor of δ{name} must vanish");
            let shown = formula(cx, caption, None, dot(g, &covector, &chart.column(s)))?;
            Some(Formula {
                left: Some(shown.right),
                right: g.zero(),
                ..shown
            })
        })
        .collect()
}
