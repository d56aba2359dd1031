//! `universal-relation#…`: principles of the first and of the intermediate kind (T1 §7.4; Zhu 1998).
//!
//! With Dq = v on the true path the principle of the second kind is
//! `∫{δL + Σ ∂L/∂v (D(δq) − δv) + Σ Q δq} dt = 0` (T1 (41)), in which every δv cancels. So any linear relation δv = A(δq)
//! may be imposed on any of the velocities: on all, first kind; on some, intermediate. The theorem is computed for each
//! operator: its principle (T1 (43)) is built with A inserted, and has the coefficients of the central form.

use crate::variations::{delta_name, Displacements};
use crate::words::listed;
use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{Manifold, System};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `universal-relation`.
#[derive(Clone, Copy, Debug)]
pub struct UniversalRelation;

/// The classical operators.
const ZERO: &str = "zero";
const HOELDER: &str = "hoelder";
const SUSLOV: &str = "suslov";
const VUJANOVIC: &str = "vujanovic";

/// δv = A(δq): the variation of each velocity as a linear form in `delta_x` and their derivatives; `None` where it stays free.
#[derive(Clone, Debug)]
pub struct Operator {
    /// By coordinate, length n.
    pub relations: Vec<Option<Expr>>,
    /// What ties the symbols in them.
    pub manifold: Manifold,
    /// Momenta by which the operator divides, with the names of their coordinates.
    pub poles: Vec<(String, Expr)>,
}

impl Claim for UniversalRelation {
    fn id(&self) -> &'static str {
        "universal-relation"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The relation δv = A(δq) does not matter"
    }

    fn explanation(&self) -> &'static str {
        "∫{δL + Σ ∂L/∂v (D(δq) − δv) + Σ Q δq} dt = 0 with Dq = v on the true path gives the equations of motion whatever δv is, as δv cancels. \
         Each classical principle imposes a linear relation δv = A(δq) in it: `zero`: A = 0, the central form; `hoelder`: A = D(δq), \
         Hölder's form; `suslov`: δf = 0, Suslov's form; `vujanovic`: A = D(δq) + Q (∂L/∂v)⁻¹ δq, with which ∫δL dt = 0 also for forces Q. A model may \
         state more under [variation.NAME], for some or all velocities, as x = \"delta_x' - g/m delta_x\"; those without a \
         formula keep a free δv. For each the integrand is built with A inserted, and shown to have the coefficients ∂L/∂q + Q of δq, ∂L/∂v of D(δq), \
         and none of δv or higher derivatives; then its equations hold on the motions. Coefficients may depend on q, v, t and need not respect the \
         constraints. Vujanović's operator has poles where ∂L/∂v = 0 but Q ≠ 0: dry friction at rest, turning points; these are stated. \
         Example: a damped oscillator L = (m v² − c q²)/2, Q = −g v, has δv = D(δq) − (g/m) δq."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if cx.terms.order > 1 {
            return Vec::new();
        }
        let own = cx.system.variations.iter().map(|v| v.name.as_str());
        let all = [ZERO, HOELDER, SUSLOV, VUJANOVIC].into_iter().chain(own);
        all.map(|name| Some(name.to_string())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let name = subject.unwrap_or(ZERO);
        match operator(cx, name) {
            Ok(Ok(operator)) => decide(cx, name, &operator).unwrap_or_else(Finding::from),
            Ok(Err(verdict)) => (*verdict).into(),
            Err(problem) => problem.into(),
        }
    }
}

/// `delta_x` of each coordinate, or a derivative of it.
fn deltas(system: &System, order: u32) -> Vec<Expr> {
    let places = 0..system.n();
    places
        .map(|i| system.graph.symbol(&delta_name(system, i), order))
        .collect()
}

/// The operator called `name`, or why it does not exist for this system.
///
/// # Errors
/// [`DeriveError`] where the curvature of the constraints is needed and cannot be derived.
pub fn operator(
    cx: &Context<'_>,
    name: &str,
) -> Result<Result<Operator, Box<Verdict>>, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let moved = deltas(system, 1);
    let plain = |relations: Vec<Expr>| Operator {
        relations: relations.into_iter().map(Some).collect(),
        manifold: Manifold::default(),
        poles: Vec::new(),
    };
    Ok(match name {
        ZERO => Ok(plain(vec![g.zero(); system.n()])),
        HOELDER => Ok(plain(moved)),
        SUSLOV => Ok(suslov(cx)?),
        VUJANOVIC => vujanovic(cx),
        own => match system.variations.iter().find(|v| v.name == own) {
            Some(stated) => {
                let mut relations = vec![None; system.n()];
                for &(i, value) in &stated.relations {
                    relations[i] = Some(value);
                }
                Ok(Operator {
                    relations,
                    manifold: Manifold::default(),
                    poles: Vec::new(),
                })
            }
            None => Err(Box::new(Verdict::undecided(format!(
                "the model states no operator `{own}`"
            )))),
        },
    })
}

/// `D(δq_s)` for independent velocities, `D(δq_d) − Σ A δq` for dependent ones.
fn suslov(cx: &Context<'_>) -> Result<Operator, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let d = Displacements::new(cx)?;
    let mut relations = deltas(system, 1);
    let displacements = deltas(system, 0);
    let independent: Vec<Expr> = d
        .chart
        .independent
        .iter()
        .map(|&i| displacements[i])
        .collect();
    for (&l, row) in d.chart.dependent.iter().zip(d.curvature()) {
        relations[l] = g.sub(relations[l], dot(g, &row, &independent));
    }
    Ok(Operator {
        relations: relations.into_iter().map(Some).collect(),
        manifold: d.manifold().clone(),
        poles: Vec::new(),
    })
}

/// `D(δq) + Q (∂L/∂v)⁻¹ δq`.
fn vujanovic(cx: &Context<'_>) -> Result<Operator, Box<Verdict>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let (displacements, moved) = (deltas(system, 0), deltas(system, 1));
    let mut relations = Vec::new();
    let mut poles = Vec::new();
    for (i, c) in system.coordinates.iter().enumerate() {
        let force = system.forces[i];
        if g.is_zero(force) {
            relations.push(Some(moved[i]));
            continue;
        }
        let vanishes = cx.prover.identity(system, &[momenta[i]], &manifold(cx), "");
        if matches!(vanishes, Verdict::Proved(_)) {
            let detail = format!(
                "Vujanović's operator divides by ∂L/∂{0}', which vanishes at all admissible states, where Q_{0} does not",
                c.name
            );
            return Err(Box::new(Verdict::not_applicable(
                "model.forces-absent",
                detail,
            )));
        }
        let added = g.mul(&[g.div(force, momenta[i]), displacements[i]]);
        relations.push(Some(g.add(&[moved[i], added])));
        poles.push((c.name.clone(), momenta[i]));
    }
    Ok(Operator {
        relations,
        manifold: Manifold::default(),
        poles,
    })
}

/// What an integrand has: coefficients of δq, of D(δq), and of everything else that must not occur.
struct Coefficients {
    by_displacements: Vec<Expr>,
    by_moved: Vec<Expr>,
    others: Vec<Expr>,
}

/// `δL|_{δv = A} + Σ ∂L/∂v (D(δq) − A) + Σ Q δq`, with free δv as symbols (T1 (43)); without the second sum where `bare`.
fn integrand(cx: &Context<'_>, operator: &Operator, bare: bool) -> (Expr, Vec<Expr>) {
    let (system, g) = (cx.system, &cx.system.graph);
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let (displacements, moved) = (deltas(system, 0), deltas(system, 1));
    let mut free = Vec::new();
    let velocities: Vec<Expr> = operator
        .relations
        .iter()
        .zip(&system.coordinates)
        .map(|(relation, c)| {
            relation.unwrap_or_else(|| {
                let symbol = g.symbol(&unused_name(system, &format!("delta_v_{}", c.name)), 0);
                free.push(symbol);
                symbol
            })
        })
        .collect();
    let mut parts = vec![
        dot(g, &slopes, &displacements),
        dot(g, &momenta, &velocities),
    ];
    if !bare {
        let pairs = moved.iter().zip(&velocities);
        let gap: Vec<Expr> = pairs.map(|(&d, &v)| g.sub(d, v)).collect();
        parts.push(dot(g, &momenta, &gap));
        parts.push(dot(g, &system.forces, &displacements));
    }
    (g.add(&parts), free)
}

fn coefficients(cx: &Context<'_>, form: Expr, free: &[Expr]) -> Coefficients {
    let (system, g) = (cx.system, &cx.system.graph);
    let symbols =
        |es: &[Expr]| -> Vec<Symbol> { es.iter().filter_map(|&e| g.as_symbol(e)).collect() };
    let names: Vec<String> = (0..system.n()).map(|i| delta_name(system, i)).collect();
    let mut others = symbols(free);
    others.extend(
        g.symbols_in(&[form]).into_iter().filter(|&s| {
            g.symbol_order(s) > 1 && names.iter().any(|name| name == g.symbol_name(s))
        }),
    );
    Coefficients {
        by_displacements: g.gradient(form, &symbols(&deltas(system, 0))),
        by_moved: g.gradient(form, &symbols(&deltas(system, 1))),
        others: g.gradient(form, &others),
    }
}

fn decide(cx: &Context<'_>, name: &str, operator: &Operator) -> Result<Finding, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let (form, free) = integrand(cx, operator, false);
    let found = coefficients(cx, form, &free);
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let central = slopes
        .iter()
        .zip(&system.forces)
        .map(|(&l, &q)| g.add(&[l, q]));
    let mut residuals: Vec<Expr> = found
        .by_displacements
        .iter()
        .zip(central)
        .map(|(&a, b)| g.sub(a, b))
        .collect();
    let moved = found.by_moved.iter().zip(&momenta);
    residuals.extend(moved.map(|(&a, &p)| g.sub(a, p)));
    residuals.extend(found.others);
    let on = match operator.poles.is_empty() {
        true => "for all curves and all δq".to_string(),
        false => format!("for all curves and all δq, where {}", poles(operator)),
    };
    let cancels = cx
        .prover
        .identity(system, &residuals, &operator.manifold, &on);
    let mut verdict = cancels.and(on_motion(cx, &found.by_displacements, &found.by_moved)?);
    let sentence = match &verdict {
        Verdict::Proved(_) => sentence(cx, name, operator),
        _ => format!("the principle with the operator `{name}`"),
    };
    verdict.prefix(&sentence);
    Ok(Finding {
        verdict,
        formulas: relations(cx, operator),
    })
}

/// Whether `(by_displacements − D by_moved)·B` vanishes on the motions.
fn on_motion(
    cx: &Context<'_>,
    by_displacements: &[Expr],
    by_moved: &[Expr],
) -> Result<Verdict, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let d = Displacements::new(cx)?;
    let pairs = by_displacements.iter().zip(by_moved);
    let covector: Vec<Expr> = pairs
        .map(|(&e, &p)| g.sub(e, system.total_derivative(p)))
        .collect();
    let covector = d.chart.on_jet(system, &covector);
    let covector = d.chart.contract(system, &covector);
    crate::hamilton::holds_on_motions(cx, &d, &covector)
}

/// "∂L/∂x' ≠ 0 and ∂L/∂y' ≠ 0".
fn poles(operator: &Operator) -> String {
    let poles = operator.poles.iter();
    let poles: Vec<String> = poles.map(|(name, _)| format!("∂L/∂{name}' ≠ 0")).collect();
    listed(&poles)
}

fn sentence(cx: &Context<'_>, name: &str, operator: &Operator) -> String {
    let (system, g) = (cx.system, &cx.system.graph);
    let free: Vec<String> = operator
        .relations
        .iter()
        .zip(&system.coordinates)
        .filter(|(relation, _)| relation.is_none())
        .map(|(_, c)| format!("δ{}'", c.name))
        .collect();
    let kind = match free.len() {
        0 => "first kind".to_string(),
        all if all == system.n() => "second kind".into(),
        _ => format!("intermediate kind, {} free", listed(&free)),
    };
    let unforced = system.forces.iter().all(|&q| g.is_zero(q));
    let becomes = match name {
        ZERO => "; with A = 0 it is the central form",
        HOELDER => "; with A = D(δq) it is Hölder's form",
        SUSLOV => "; with δf = 0 it is Suslov's form",
        VUJANOVIC if unforced => "; without forces Vujanović's operator is Hölder's",
        VUJANOVIC => "; with Vujanović's operator it is ∫δL dt = 0 although Q ≠ 0",
        _ => "",
    };
    let poles = match operator.poles.is_empty() {
        true => String::new(),
        false => {
            let poles = operator.poles.iter();
            let texts: Vec<String> = poles.filter_map(|(_, p)| zeros(cx, *p)).collect();
            match texts.is_empty() {
                true => "; it has poles where these momenta vanish".into(),
                false => format!("; it fails where {}", texts.join(" or ")),
            }
        }
    };
    format!("δv cancels, and the principle gives the equations of motion ({kind}){becomes}{poles}")
}

/// "q' = 0": where a momentum vanishes, without factors that are parameters; `None` where that is too long.
fn zeros(cx: &Context<'_>, momentum: Expr) -> Option<String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut moving = system.velocity_symbols();
    moving.extend(system.coordinate_symbols());
    let short = crate::words::readable(cx, momentum)?;
    let factors = chetaev_symbolic::factors::factors(g, short, &moving)?;
    let factors = factors.into_iter().map(|(factor, _)| factor);
    let texts: Vec<String> = factors
        .map(|factor| {
            format!(
                "{} = 0",
                g.text(crate::words::readable(cx, factor).unwrap_or(factor))
            )
        })
        .collect();
    (!texts.is_empty()).then(|| texts.join(" or "))
}

/// δv by the operator, where it is neither zero nor D(δq).
fn relations(cx: &Context<'_>, operator: &Operator) -> Vec<Formula> {
    let moved = deltas(cx.system, 1);
    operator
        .relations
        .iter()
        .zip(&cx.system.coordinates)
        .zip(moved)
        .filter_map(|((relation, c), moved)| {
            let value = relation.filter(|&value| value != moved)?;
            crate::words::formula(cx, format!("δ{}' by the operator", c.name), None, value)
        })
        .collect()
}

/// Whether `∫δL dt = 0` with δv = A(δq) alone, without the further sum of (43), gives the equations of motion: so it is for
/// Vujanović's operator, and for Hölder's without forces.
///
/// # Errors
/// [`DeriveError`].
pub fn bare_principle(cx: &Context<'_>, operator: &Operator) -> Result<Verdict, DeriveError> {
    let (form, free) = integrand(cx, operator, true);
    let found = coefficients(cx, form, &free);
    on_motion(cx, &found.by_displacements, &found.by_moved)
}
