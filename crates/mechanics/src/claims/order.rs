//! Claims about constraints of order m (catalogue of claims, §5, T2 §2 and §5).

use super::formulation::basis;
use super::{stating, Claim, Context, Finding, Group};
use crate::characteristics::{Characteristics, Manifold};
use crate::equations::Equations;
use crate::formulations::{Formulation, Routh};
use crate::linear::{dot, solve_linear};
use crate::order::determined::{self, Determined};
use crate::order::lifting;
use crate::order::reduced::without_multipliers;
use crate::order::structure::assignment;
use crate::words::differentiated_so;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};

/// `order.lifting`.
#[derive(Clone, Copy, Debug)]
pub struct Lifting;

/// `order.determined`.
#[derive(Clone, Copy, Debug)]
pub struct OrderDetermined;

/// `order.characteristics`.
#[derive(Clone, Copy, Debug)]
pub struct OrderCharacteristics;

/// Subjects of a claim that exists for constraints of order two and more.
fn of_higher_order(cx: &Context<'_>) -> Vec<Option<String>> {
    match cx.terms.order > 1 {
        true => vec![None],
        false => Vec::new(),
    }
}

impl Claim for Lifting {
    fn id(&self) -> &'static str {
        "order.lifting"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "A constraint may be replaced by its total derivative"
    }

    fn explanation(&self) -> &'static str {
        "The total derivative D f of a constraint of order m is a constraint of order m + 1 with the same gradient: \
         ∂(D f)/∂q^(m+1) ≡ ∂f/∂q^(m), identically. So the directions of the reactions and with them the equations of motion \
         are the same; only more initial states are admissible, and f becomes an integral. By this constraints of different \
         orders are brought to the highest one."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        of_higher_order(cx)
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let (system, g) = (cx.system, &cx.system.graph);
        let mut residuals = Vec::new();
        for constraint in &system.constraints {
            let symbols = |order| -> Vec<_> {
                let names = system.coordinates.iter();
                names.map(|c| g.intern_symbol(&c.name, order)).collect()
            };
            let lifted = lifting::derivative(system, constraint.stated, 1);
            let above = g.gradient(lifted, &symbols(constraint.order + 1));
            let own = g.gradient(constraint.stated, &symbols(constraint.order));
            residuals.extend(above.into_iter().zip(own).map(|(a, b)| g.sub(a, b)));
        }
        residuals.retain(|&e| !g.is_zero(e));
        let on = "identically in all derivatives";
        if residuals.is_empty() {
            let detail =
                "∂(D f)/∂q^(m+1) and ∂f/∂q^(m) are the same expressions for every constraint";
            return Verdict::Proved(Proof::structural(on, detail)).into();
        }
        cx.prover
            .identity(system, &residuals, &Manifold::default(), on)
            .into()
    }
}

impl Claim for OrderCharacteristics {
    fn id(&self) -> &'static str {
        "order.characteristics"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The kinematic characteristics parametrize what the constraints admit"
    }

    fn explanation(&self) -> &'static str {
        "For q^(m) = φ(t, q, …, q^(m-1), P) and B = ∂φ/∂P: the constraints hold identically, f(φ) ≡ 0; the columns of B are \
         virtual displacements, A B ≡ 0 with A = ∂f/∂q^(m); and B has the rank k = n - r, so that nothing admissible is left \
         out. Another choice of P multiplies the equations of motion by a matrix that is not singular. Decided for the \
         characteristics that the model states, else for independent components of q^(m)."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match cx.system.characteristics.is_some() {
            true => vec![None],
            false => of_higher_order(cx),
        }
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if self.subjects(cx).is_empty() {
            // Nothing is claimed then; only formulations ask.
            let detail = "the model states no formulas, and independent velocities are taken";
            return Verdict::Proved(Proof::structural("everywhere", detail)).into();
        }
        let basis = basis(cx);
        match basis.kinematic_characteristics() {
            Ok(c) => admissible(cx, &c).into(),
            Err(problem) => Verdict::undecided(problem.to_string()).into(),
        }
    }
}

/// f(φ) ≡ 0, A B ≡ 0, rank B = k.
pub(crate) fn admissible(cx: &Context<'_>, c: &Characteristics) -> Verdict {
    let (system, terms, g) = (cx.system, cx.terms, &cx.system.graph);
    let rows = &cx.selection.rows;
    let constraints: Vec<Expr> = rows.iter().map(|&row| terms.constraints[row]).collect();
    let gradients: Vec<Expr> = rows
        .iter()
        .flat_map(|&row| terms.jacobian[row].clone())
        .collect();
    let on = "on the jet (t, q, …, P)";
    for (&row, residual) in rows.iter().zip(c.restrict(system, &constraints)) {
        if let Verdict::Refuted(found) = cx.prover.identity(system, &[residual], &c.manifold, on) {
            return Verdict::Refuted(violated(cx, row, found));
        }
    }
    let mut residuals = c.restrict(system, &constraints);
    let gradients = c.restrict(system, &gradients);
    for row in gradients.chunks(system.n()) {
        residuals.extend(c.contract(system, row));
    }
    residuals.retain(|&e| !g.is_zero(e));
    let holds = match residuals.is_empty() {
        true => Verdict::Proved(Proof::structural(on, "f(φ) ≡ 0 and A B ≡ 0 by their form")),
        false => cx.prover.identity(system, &residuals, &c.manifold, on),
    };
    if c.k() == 0 {
        return holds;
    }
    let rank = match cx.prover.rank(system, &c.basis, &c.manifold) {
        Ok(found) if found.minimum == c.k() => found.at_least,
        Ok(found) => match found.at_most {
            Verdict::Proved(proof) => Verdict::Refuted(Counterexample {
                point: Vec::new(),
                quantity: "k minus the rank of B, at every state at least".into(),
                residual: (
                    (c.k() - found.maximum).to_string(),
                    (c.k() - found.maximum).to_string(),
                ),
                detail: format!(
                    "B has the rank {} and not k = {} ({})",
                    found.maximum,
                    c.k(),
                    proof.detail
                ),
            }),
            other => other,
        },
        Err(verdict) => *verdict,
    };
    let names: Vec<&str> = c.parameters.iter().map(|p| p.name.as_str()).collect();
    let detail = format!(
        "P = ({}): f(φ) ≡ 0, A B ≡ 0, rank B = {}",
        names.join(", "),
        c.k()
    );
    stating(holds.and(rank), &detail)
}

/// The formulas do not satisfy a constraint.
fn violated(cx: &Context<'_>, row: usize, mut found: Counterexample) -> Counterexample {
    let name = &cx.system.constraints[cx.terms.constraint_index[row]].name;
    found.detail = format!(
        "the characteristics do not satisfy the constraint `{name}`, which {}",
        match found.residual.0 == found.residual.1 {
            true => format!(
                "is {} and not zero for them at the state found",
                found.residual.0
            ),
            false => format!(
                "lies between {} and {} and is not zero for them at the state found",
                found.residual.0, found.residual.1
            ),
        }
    );
    found
}

impl Claim for OrderDetermined {
    fn id(&self) -> &'static str {
        "order.determined"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "Constraints and equations of motion determine the derivatives of order m"
    }

    fn explanation(&self) -> &'static str {
        "The equations of motion have an order s of their own. Where s is below the order m of the constraints they are \
         differentiated m - s times; with the constraints they then are as many equations as there are unknowns, q^(m) and \
         the derivatives of order m - s of the multipliers. Their Jacobian by the unknowns must not vanish identically. The \
         verdict states the dimension of the state, the initial data, and the integrals that the motion carries: the \
         equations that were differentiated, and constraints of lower order. Where the Jacobian vanishes the structure \
         changes, and a run stops there. For constraints nonlinear in q^(m) there may be several branches."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        of_higher_order(cx)
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let determined = determined::with_multipliers(&basis(cx));
        let detail = description(cx, &determined);
        stating(regular(cx, &determined), &detail).into()
    }
}

/// Whether the Jacobian of the equations by the unknowns is nonsingular.
pub(crate) fn regular(cx: &Context<'_>, determined: &Determined) -> Verdict {
    let g = &cx.system.graph;
    let matrix = g.jacobian(&determined.equations, &determined.unknowns);
    let manifold = match determined.linear {
        true => Manifold::default(),
        false => states(cx, determined),
    };
    let what = "the Jacobian of the equations by the unknowns";
    cx.prover.nonsingular(cx.system, &matrix, &manifold, what)
}

/// The jets that satisfy equations nonlinear in the unknowns, as exact data for a zero test: where the reactions have
/// directions free of accelerations, and m ≥ 3, the accelerations are those of the equations of motion, and each constraint
/// determines a derivative of order m.
fn states(cx: &Context<'_>, determined: &Determined) -> Manifold {
    let (system, g) = (cx.system, &cx.system.graph);
    let pairs = determined.equations.iter().zip(&determined.unknowns);
    let all = Manifold {
        solved: Vec::new(),
        implicit: pairs.map(|(&e, &s)| (e, s)).collect(),
    };
    let basis = basis(cx);
    let accelerations: Vec<_> = system.coordinates.iter().map(|c| c.a_symbol).collect();
    if determined.order < 3 || g.any_contains_any(&basis.reactions(), &accelerations) {
        return all;
    }
    let Ok(values) = solve_linear(g, &basis.balance(), &accelerations) else {
        return all;
    };
    let solved: Vec<_> = accelerations.into_iter().zip(values).collect();
    let n = system.n();
    let differentiated: Vec<usize> = (0..n).filter(|&i| determined.times[i] > 0).collect();
    if let Some(further) = linear_part(g, determined, &differentiated) {
        return Manifold {
            implicit: Vec::new(),
            solved: [solved, further].concat(),
        };
    }
    let constraints = determined.equations[n..].iter();
    let differentiated = differentiated.iter().map(|&i| &determined.equations[i]);
    let equations: Vec<Expr> = constraints.chain(differentiated).copied().collect();
    let implicit = with_symbols(cx, &equations, &determined.unknowns);
    Manifold { implicit, solved }
}

/// Each equation with a symbol of its own that occurs in it, for the constraints, which come first, preferably the dependent
/// derivative chosen. Equations for which there are not enough symbols have a singular Jacobian wherever they hold.
fn with_symbols(cx: &Context<'_>, equations: &[Expr], symbols: &[Symbol]) -> Vec<(Expr, Symbol)> {
    let g = &cx.system.graph;
    let chosen = |row: usize| cx.selection.dependent.get(row).copied();
    let occurs: Vec<Vec<Option<u32>>> = equations
        .iter()
        .enumerate()
        .map(|(row, &e)| {
            let preferred = |j: usize| u32::from(chosen(row) == Some(j));
            (0..symbols.len())
                .map(|j| {
                    g.any_contains_any(&[e], &[symbols[j]])
                        .then(|| preferred(j))
                })
                .collect()
        })
        .collect();
    let partners = assignment(&occurs).unwrap_or_default();
    let pairs = equations.iter().zip(partners);
    pairs.map(|(&e, j)| (e, symbols[j])).collect()
}

/// The differentiated equations and the constraints solved for the unknowns in which they are affine together, where these
/// are as many.
fn linear_part(
    g: &Graph,
    determined: &Determined,
    differentiated: &[usize],
) -> Option<Vec<(Symbol, Expr)>> {
    let n = determined.times.len();
    let mut equations: Vec<Expr> = differentiated
        .iter()
        .map(|&i| determined.equations[i])
        .collect();
    equations.extend(&determined.equations[n..]);
    let mut unknowns = determined.unknowns.clone();
    // What stands in the slopes by the others enters nonlinearly.
    let slopes = g.jacobian(&equations, &unknowns).concat();
    unknowns.retain(|symbol| {
        g.any_contains_any(&equations, &[*symbol]) && !g.any_contains_any(&slopes, &[*symbol])
    });
    if differentiated.is_empty() || unknowns.len() != equations.len() {
        return None;
    }
    let values = solve_linear(g, &equations, &unknowns).ok()?;
    Some(unknowns.into_iter().zip(values).collect())
}

/// What is solved for, the dimension, the data and the integrals, in words.
fn description(cx: &Context<'_>, determined: &Determined) -> String {
    let (system, g) = (cx.system, &cx.system.graph);
    let unknowns: Vec<String> = determined
        .unknowns
        .iter()
        .map(|&s| g.symbol_text(s))
        .collect();
    let mut parts = vec![format!(
        "constraints of order {}, {}, solved for {}",
        determined.order,
        differentiated_so("equations of motion", determined.differentiations()),
        unknowns.join(", ")
    )];
    if let Ok(equations) = Routh.equations(&basis(cx)) {
        let (dimension, free) = dimension(cx, &equations);
        parts.push(format!("a state of dimension {dimension}"));
        if free > 0 {
            let data = data_beyond_velocities(system, &equations);
            parts.push(format!(
                "beside coordinates and velocities {free} of the data {} are free",
                data.join(", ")
            ));
        }
        let kept: Vec<String> = equations
            .conditions
            .iter()
            .map(|c| c.name.clone())
            .collect();
        if !kept.is_empty() {
            parts.push(format!("integrals that vanish: {}", kept.join(", ")));
        }
    }
    parts.join("; ")
}

/// The names of the variables of the state beyond q and q' that are not tied to the others as unknowns.
pub fn data_beyond_velocities(
    system: &crate::system::System,
    equations: &Equations,
) -> Vec<String> {
    let tied = |symbol| equations.relations.iter().any(|(_, own)| *own == symbol);
    let variables = equations.variables.iter();
    variables
        .filter(|x| !tied(x.symbol))
        .filter(|x| system.coordinates.iter().all(|c| c.v_symbol != x.symbol))
        .map(|x| x.name.clone())
        .collect()
}

/// The dimension of the manifold of states, and how many of its data lie beyond coordinates and velocities: the number of
/// variables less the generic rank of the conditions.
pub fn dimension(cx: &Context<'_>, equations: &Equations) -> (usize, usize) {
    let (system, g) = (cx.system, &cx.system.graph);
    let tied = |symbol| equations.relations.iter().any(|(_, own)| *own == symbol);
    let own = equations.variables.iter().map(|x| x.symbol);
    let own: Vec<_> = own.filter(|&symbol| !tied(symbol)).collect();
    let mut symbols = system.coordinate_symbols();
    symbols.extend(&own);
    let conditions: Vec<Expr> = equations.conditions.iter().map(|c| c.value).collect();
    let rank_by = |symbols: &[_]| match conditions.is_empty() || symbols.is_empty() {
        true => 0,
        false => {
            let matrix = g.jacobian(&conditions, symbols);
            let found = cx.prover.rank(system, &matrix, &Manifold::default());
            found.map_or(0, |rank| rank.minimum)
        }
    };
    let beyond: Vec<_> = own
        .iter()
        .copied()
        .filter(|s| system.coordinates.iter().all(|c| c.v_symbol != *s))
        .collect();
    let dimension = symbols.len() - rank_by(&symbols);
    (dimension, beyond.len() - rank_by(&beyond).min(beyond.len()))
}

/// Proves or refutes that equations on the jet of characteristics are those with multipliers, the multipliers eliminated:
/// `G_σ ≡ Σ_i (∂φ_i/∂P_σ) (w_i - Σ_l λ_l A^l_i)` over the independent i, with λ from the dependent ones. Where B has the
/// rank k the two have the same solutions, also after differentiation.
pub(crate) fn equivalence(cx: &Context<'_>, c: &Characteristics, residuals: &[Expr]) -> Verdict {
    let (system, g) = (cx.system, &cx.system.graph);
    let reduced = match without_multipliers(&basis(cx)) {
        Ok(reduced) => c.on_jet(system, &reduced),
        Err(problem) => return Verdict::undecided(problem.to_string()),
    };
    let independent = cx.selection.independent(system.n());
    let differences: Vec<Expr> = (0..c.k())
        .map(|sigma| {
            let column: Vec<Expr> = independent.iter().map(|&i| c.basis[i][sigma]).collect();
            g.sub(residuals[sigma], dot(g, &column, &reduced))
        })
        .filter(|&e| !g.is_zero(e))
        .collect();
    let on = match cx.terms.order {
        1 => "on the jet (t, q, P, P')",
        _ => "on the jet (t, q, …, P) of the characteristics",
    };
    let same = match differences.is_empty() {
        true => Verdict::Proved(Proof::structural(on, "the same expressions")),
        false => cx.prover.identity(system, &differences, &c.manifold, on),
    };
    let detail = "the left sides are combinations, with a matrix that is not singular, of the equations with multipliers after the multipliers are eliminated";
    stating(same, detail).and(admissible(cx, c))
}
