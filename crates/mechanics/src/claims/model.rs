//! The claims of the catalogue, §1, that need no geometry: regularity and the form of the constraints.

use super::{order, stating, Claim, Context, Degenerate, Finding, Formula, Group};
use crate::characteristics::Manifold;
use crate::claims::formulation::{basis, manifold};
use crate::constraint::Constraint;
use crate::frame::{Frame, FrameOrigin};
use crate::mass;
use crate::order::determined::with_multipliers;
use crate::redundancy::LeftOut;
use crate::sample;
use crate::system::{Assumption, System};
use crate::terms::MotionTerms;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Graph, Rational, Verdict};
use std::collections::BTreeSet;

/// `model.hessian-regular`.
#[derive(Clone, Copy, Debug)]
pub struct HessianRegular;

impl Claim for HessianRegular {
    fn id(&self) -> &'static str {
        "model.hessian-regular"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The Lagrangian is regular"
    }

    fn explanation(&self) -> &'static str {
        "The Hessian W = ∂²L/∂v∂v of the Lagrangian by the velocities has a determinant that is not identically zero. \
         Then velocities can be expressed by momenta, and the formulations that need W⁻¹ apply. A singular W may still \
         give unique accelerations once the constraints are used: that is `model.accelerations-unique`."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let hessian = hessian(cx);
        let verdict =
            cx.prover
                .nonsingular(cx.system, &hessian, &Manifold::default(), "det ∂²L/∂v∂v");
        Finding {
            verdict,
            formulas: hessian_formula(cx, &hessian).into_iter().collect(),
        }
    }
}

/// ∂²L/∂v∂v, which is the matrix of the terms unless a mass contains velocities.
fn hessian(cx: &Context<'_>) -> Vec<Vec<Expr>> {
    if mass::with_velocity(cx.system).is_none() {
        return cx.terms.mass_matrix.clone();
    }
    let (g, velocities) = (&cx.system.graph, cx.system.velocity_symbols());
    g.jacobian(&g.gradient(cx.system.lagrangian, &velocities), &velocities)
}

/// det W where it is short enough to read: a diagonal matrix, or one of two coordinates.
fn hessian_formula(cx: &Context<'_>, w: &[Vec<Expr>]) -> Option<Formula> {
    let g = &cx.system.graph;
    let n = w.len();
    let diagonal = (0..n).all(|i| (0..n).all(|j| i == j || g.is_zero(w[i][j])));
    let right = if diagonal {
        let entries: Vec<Expr> = (0..n).map(|i| w[i][i]).collect();
        g.mul(&entries)
    } else if n == 2 {
        g.sub(g.mul(&[w[0][0], w[1][1]]), g.mul(&[w[0][1], w[1][0]]))
    } else {
        return None;
    };
    Some(Formula {
        caption: "det ∂²L/∂v∂v; where it vanishes the Lagrangian is singular".into(),
        left: None,
        right,
    })
}

/// `model.constraints-independent`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintsIndependent;

impl Claim for ConstraintsIndependent {
    fn id(&self) -> &'static str {
        "model.constraints-independent"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The constraints are independent"
    }

    fn explanation(&self) -> &'static str {
        "The Jacobian ∂f/∂v of the constraints by the velocities has rank r, the number of constraints, at almost every \
         state that satisfies them. If not, the verdict names the constraints that follow from the others (they are left \
         out, the motion does not change) or contradict them, or that hold with multiplicity: where two spheres touch, or a \
         sum of squares vanishes, the gradients are dependent wherever the constraints hold. Multipliers then determine \
         no motion, and simpler constraints with the same states are named. Of constraints of order m it is the Jacobian by the derivatives of order m."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.terms.constraints.is_empty() {
            return no_constraints().into();
        }
        if let Some(degenerate) = cx.extension::<Degenerate>() {
            return Verdict::Refuted(degenerate.found.clone()).into();
        }
        let left_out = LeftOut::find(cx.system, cx.terms, cx.selection, &cx.prover);
        let verdict = match left_out {
            None => cx.prover.nonsingular(
                cx.system,
                &dependent_block(cx),
                &manifold(cx),
                "the minor of the constraint gradients by the dependent derivatives",
            ),
            Some(left_out) => cx.prover.dependent_rows(left_out, cx.selection.rows.len()),
        };
        verdict.into()
    }
}

/// J restricted to the selected rows and dependent columns.
fn dependent_block(cx: &Context<'_>) -> Vec<Vec<Expr>> {
    cx.selection
        .rows
        .iter()
        .map(|&row| {
            let jacobian = &cx.terms.jacobian[row];
            cx.selection
                .dependent
                .iter()
                .map(|&d| jacobian[d])
                .collect()
        })
        .collect()
}

/// `model.accelerations-unique`.
#[derive(Clone, Copy, Debug)]
pub struct AccelerationsUnique;

impl Claim for AccelerationsUnique {
    fn id(&self) -> &'static str {
        "model.accelerations-unique"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "Accelerations and reactions are unique"
    }

    fn explanation(&self) -> &'static str {
        "The bordered matrix [[W, fᵥᵀ], [fᵥ, 0]] of mass matrix and constraint gradients is nonsingular at almost every \
         admissible state, redundant constraints removed. This, and not the regularity of W alone, is the condition for \
         unique accelerations and multipliers. For constraints of order m it is the Jacobian of `order.determined`."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.terms.order > 1 {
            return order::regular(cx, &with_multipliers(&basis(cx))).into();
        }
        let verdict = cx.prover.nonsingular(
            cx.system,
            &bordered(cx),
            &manifold(cx),
            "the determinant of the bordered matrix [[W, fᵥᵀ], [fᵥ, 0]]",
        );
        verdict.into()
    }
}

fn bordered(cx: &Context<'_>) -> Vec<Vec<Expr>> {
    let (g, terms, rows) = (&cx.system.graph, cx.terms, &cx.selection.rows);
    let n = cx.system.n();
    let mut matrix = Vec::with_capacity(n + rows.len());
    for i in 0..n {
        let mut line = terms.mass_matrix[i].clone();
        line.extend(rows.iter().map(|&row| terms.jacobian[row][i]));
        matrix.push(line);
    }
    for &row in rows {
        let mut line = terms.jacobian[row].clone();
        line.extend(std::iter::repeat_n(g.zero(), rows.len()));
        matrix.push(line);
    }
    matrix
}

/// `model.frame-regular`.
#[derive(Clone, Copy, Debug)]
pub struct FrameRegular;

impl Claim for FrameRegular {
    fn id(&self) -> &'static str {
        "model.frame-regular"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The quasi-velocities form a frame"
    }

    fn explanation(&self) -> &'static str {
        "The forms ω^s of the quasi-velocities, those of the model or independent velocities completed by the constraint \
         functions, have a matrix whose determinant does not vanish identically: quasi-velocities and velocities determine \
         each other. Where it vanishes the frame is singular, and the equations in it have no meaning there."
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let frame = match Frame::adapted(cx.system, cx.terms, cx.selection) {
            Ok((frame, FrameOrigin::Natural)) if frame.is_natural(cx.system) => {
                let proof =
                    Proof::structural("everywhere", "the quasi-velocities are the velocities");
                return Verdict::Proved(proof).into();
            }
            Ok((frame, _)) => frame,
            // Elimination with exact entries has met a row or column without entries.
            Err(problem) => {
                return Verdict::Refuted(Counterexample {
                    point: Vec::new(),
                    quantity: "the determinant of the frame, at every state".into(),
                    residual: ("0".into(), "0".into()),
                    detail: format!("the quasi-velocities depend on each other: {problem}"),
                })
                .into()
            }
        };
        // The fields of a frame stated by fields are its exact data; the forms are their inverse.
        let matrix = match cx.system.frame {
            Some(_) => &frame.fields,
            None => &frame.forms,
        };
        cx.prover
            .nonsingular(
                cx.system,
                matrix,
                &manifold(cx),
                "the determinant of the frame",
            )
            .into()
    }
}

fn no_constraints() -> Verdict {
    Verdict::Proved(Proof::structural(
        "everywhere",
        "the system has no constraints",
    ))
}

/// `model.constraints-linear`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintsLinear;

impl Claim for ConstraintsLinear {
    fn id(&self) -> &'static str {
        "model.constraints-linear"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The constraints are linear in the velocities"
    }

    fn explanation(&self) -> &'static str {
        "Every constraint has the form a(q,t)·v + a₀(q,t) = 0: its derivatives by the velocities contain no velocities, or \
         f(v) + f(w) = 2 f((v + w)/2) identically. A constraint of order m is linear if it is so in its derivatives of \
         order m. \
         Affine constraints (a₀ ≠ 0) count as linear here; `model.constraints-homogeneous` tells them apart."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.system.constraints.is_empty() {
            return no_constraints().into();
        }
        let name = |c: &Constraint| format!("f(v) + f(w) − 2 f((v + w)/2) of `{}`", c.name);
        let residuals: Vec<(String, Expr)> = cx
            .system
            .constraints
            .iter()
            .filter(|constraint| !constraint.is_affine_in_velocities())
            .map(|constraint| (name(constraint), bend(cx, constraint)))
            .filter(|(_, e)| !cx.system.graph.is_zero(*e))
            .collect();
        if residuals.is_empty() {
            let proof = Proof::structural(
                "identically in q, v, t",
                "no derivative of a constraint by a velocity contains velocities",
            );
            return Verdict::Proved(proof).into();
        }
        let system = assuming_of_others(cx);
        cx.prover
            .named_identity(
                &system,
                &residuals,
                &Manifold::default(),
                "identically in q, v, t",
            )
            .into()
    }
}

/// The system with its assumptions on the highest derivatives v made of w too.
fn assuming_of_others(cx: &Context<'_>) -> System {
    let g = &cx.system.graph;
    let mut system = cx.system.clone();
    let orders: BTreeSet<u32> = (cx.system.constraints.iter())
        .map(|constraint| constraint.order.max(1))
        .collect();
    for order in orders {
        let coordinates = cx.system.coordinates.iter();
        let pairs: Vec<(Expr, Expr)> = coordinates
            .map(|c| (g.symbol(&c.name, order), other(g, &c.name, order)))
            .collect();
        let own = cx.system.assumptions.iter();
        let of_others = own.map(|a| Assumption {
            left: g.substitute(a.left, &pairs),
            right: g.substitute(a.right, &pairs),
            ..a.clone()
        });
        let is_new = |a: &Assumption| !cx.system.assumptions.contains(a);
        system.assumptions.extend(of_others.filter(is_new));
    }
    system
}

/// The component of w beside that of v.
fn other(g: &Graph, name: &str, order: u32) -> Expr {
    g.symbol(&format!("w_{name}"), order)
}

/// `f(v) + f(w) - 2 f((v + w)/2)` in the highest derivatives v, which vanishes for affine functions only (Jensen's
/// equation); unlike second derivatives it sees the corner of |x'|, and unlike f(v + w) and f(0) it asks for f between
/// the two only.
fn bend(cx: &Context<'_>, constraint: &Constraint) -> Expr {
    let (g, f) = (&cx.system.graph, constraint.f);
    let order = constraint.order.max(1);
    let half = g.number(Rational::ONE / Rational::from(2));
    let at = |value: &dyn Fn(Expr, &str) -> Expr| {
        let pairs: Vec<(Expr, Expr)> = cx
            .system
            .coordinates
            .iter()
            .map(|c| {
                let highest = g.symbol(&c.name, order);
                (highest, value(highest, &c.name))
            })
            .collect();
        g.substitute(f, &pairs)
    };
    let of_other = at(&|_, name| other(g, name, order));
    let between = at(&|v, name| g.mul(&[half, g.add(&[v, other(g, name, order)])]));
    g.add(&[f, of_other, g.neg(between), g.neg(between)])
}

/// `model.constraints-homogeneous`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintsHomogeneous;

impl Claim for ConstraintsHomogeneous {
    fn id(&self) -> &'static str {
        "model.constraints-homogeneous"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The constraints are homogeneous in the velocities"
    }

    fn explanation(&self) -> &'static str {
        "Euler's identity Σ vⁱ ∂f/∂vⁱ = d·f holds identically in the velocities for every constraint f, with a degree d \
         of its own. Then the actual displacement is a virtual one, the reactions do no work, and energy is conserved \
         when nothing else spoils it."
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.terms.constraints.is_empty() {
            return no_constraints().into();
        }
        let g = &cx.system.graph;
        let mut residuals = Vec::new();
        let mut degrees = Vec::new();
        for (row, &f) in cx.terms.constraints.iter().enumerate() {
            let name = &cx.system.constraints[cx.terms.constraint_index[row]].name;
            let products: Vec<Expr> = cx
                .system
                .coordinates
                .iter()
                .zip(&cx.terms.jacobian[row])
                .map(|(c, &df)| g.mul(&[c.v, df]))
                .collect();
            let euler = g.add(&products);
            let degree = guess_degree(cx, f, euler);
            residuals.push((
                format!("Σ v ∂f/∂v − {degree} f of `{name}`"),
                g.sub(euler, g.scale(&degree, f)),
            ));
            degrees.push(format!("{degree} for `{name}`"));
        }
        let verdict = cx.prover.named_identity(
            cx.system,
            &residuals,
            &Manifold::default(),
            "identically in q, v, t",
        );
        stating(verdict, &format!("degree {}", degrees.join(", "))).into()
    }
}

/// The degree from one sampled state; a wrong guess only makes the identity fail. Tries small denominators.
fn guess_degree(cx: &Context<'_>, f: Expr, euler: Expr) -> Rational {
    let one = Rational::ONE;
    let g = &cx.system.graph;
    let mut generator = sample::Generator::new(11);
    for _ in 0..20 {
        let point: std::collections::BTreeMap<_, f64> = g
            .symbols_in(&[f, euler])
            .into_iter()
            .map(|s| (s, generator.between(0.3, 1.7)))
            .collect();
        let Ok(values) = g.evaluate_f64(&[f, euler], &|s| point.get(&s).copied()) else {
            continue;
        };
        let ratio = values[1] / values[0];
        for denominator in 1..=6i64 {
            let scaled = ratio * denominator as f64;
            if (scaled - scaled.round()).abs() < 1e-7 && scaled.abs() < 1e6 {
                let guess = chetaev_symbolic::rational::ratio(scaled.round() as i64, denominator);
                return guess.unwrap_or(one);
            }
        }
    }
    one
}

/// `model.constraints-scleronomic`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintsScleronomic;

impl Claim for ConstraintsScleronomic {
    fn id(&self) -> &'static str {
        "model.constraints-scleronomic"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The constraints do not contain the time"
    }

    fn explanation(&self) -> &'static str {
        "∂f/∂t vanishes identically for every constraint as it is stated, for a holonomic one g(q, t) = 0 that of g; controls \
         u(t) count as explicit time."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.system.constraints.is_empty() {
            return no_constraints().into();
        }
        let rate = |c: &Constraint| cx.system.time_derivative(c.stated);
        let residuals: Vec<(String, Expr)> = cx
            .system
            .constraints
            .iter()
            .map(|constraint| (format!("∂f/∂t of `{}`", constraint.name), rate(constraint)))
            .filter(|(_, e)| !cx.system.graph.is_zero(*e))
            .collect();
        if residuals.is_empty() {
            let proof = Proof::structural("identically", "no constraint contains the time");
            return Verdict::Proved(proof).into();
        }
        cx.prover
            .named_identity(
                cx.system,
                &residuals,
                &Manifold::default(),
                "identically in q, v, t",
            )
            .into()
    }
}

/// `model.chaplygin`.
#[derive(Clone, Copy, Debug)]
pub struct Chaplygin;

impl Claim for Chaplygin {
    fn id(&self) -> &'static str {
        "model.chaplygin"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The system is of Chaplygin's type"
    }

    fn explanation(&self) -> &'static str {
        "Neither the Lagrangian nor the solved constraints v_d = φ(q, v, t) depend on the dependent coordinates. Then \
         Chaplygin's equations close in the independent coordinates. The property belongs to a choice of dependent \
         coordinates; choices are tried until one fits, and the verdict names it."
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.terms.constraints.is_empty() {
            return no_constraints().into();
        }
        let (terms, rows) = (cx.terms, &cx.selection.rows);
        // The choice of the equations, where that fits.
        let own = &cx.selection.dependent;
        let fits = own.iter().all(|&d| is_absent(cx.system, terms, rows, d));
        let other = (!fits).then(|| chaplygin_choice(cx.system, terms, rows));
        let chosen = other.flatten();
        let dependent = chosen.as_ref().unwrap_or(own);
        let names: Vec<&str> = dependent
            .iter()
            .map(|&d| cx.system.coordinates[d].name.as_str())
            .collect();
        let residuals = chaplygin_residuals(cx.system, cx.terms, &cx.selection.rows, dependent);
        let verdict = if residuals.is_empty() {
            let detail = format!(
                "L and the constraints do not contain the dependent coordinates {}",
                names.join(", ")
            );
            Verdict::Proved(Proof::structural("everywhere", detail))
        } else {
            let (system, manifold) = (cx.system, manifold(cx));
            let on = "on the constraint manifold";
            let mut verdict = cx.prover.named_identity(system, &residuals, &manifold, on);
            if matches!(verdict, Verdict::Proved(_)) {
                verdict.prefix(&format!(
                    "L and the solved constraints do not depend on the dependent coordinates {}",
                    names.join(", ")
                ));
            }
            verdict
        };
        verdict.into()
    }
}

/// Derivatives that must vanish: of L by the dependent coordinates, and of φ (by the implicit function theorem, of f).
fn chaplygin_residuals(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    dependent: &[usize],
) -> Vec<(String, Expr)> {
    let g = &system.graph;
    let mut residuals = Vec::new();
    for &d in dependent {
        let (symbol, name) = (system.coordinates[d].q_symbol, &system.coordinates[d].name);
        residuals.push((format!("∂L/∂{name}"), g.diff(system.lagrangian, symbol)));
        for &row in rows {
            let constraint = &system.constraints[terms.constraint_index[row]].name;
            let slope = g.diff(terms.constraints[row], symbol);
            residuals.push((format!("∂f/∂{name} of `{constraint}`"), slope));
        }
    }
    residuals.retain(|(_, e)| !g.is_zero(*e));
    residuals
}

/// Whether neither L nor a constraint contains the coordinate `d`, by their form.
pub(crate) fn is_absent(system: &System, terms: &MotionTerms, rows: &[usize], d: usize) -> bool {
    chaplygin_residuals(system, terms, rows, &[d]).is_empty()
}

/// Whether the coordinate `d` does not act on the constraint manifold, as far as samples show: a positive factor of a
/// constraint may contain it.
fn seems_absent(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    d: usize,
    points: &[sample::Point],
) -> bool {
    let residuals = chaplygin_residuals(system, terms, rows, &[d]);
    let slopes: Vec<Expr> = residuals.into_iter().map(|(_, e)| e).collect();
    points.iter().all(|point| {
        let values = system
            .graph
            .evaluate_f64(&slopes, &|s| point.get(&s).copied());
        values.is_ok_and(|values| values.iter().all(|x| x.abs() < 1e-9))
    })
}

/// A choice of r coordinates that occur nowhere, or act nowhere on the constraints as far as samples show, and whose velocities
/// can be solved for at a sampled state.
pub(crate) fn chaplygin_choice(
    system: &System,
    terms: &MotionTerms,
    selected: &[usize],
) -> Option<Vec<usize>> {
    let all = 0..system.n();
    let absent = all
        .clone()
        .filter(|&d| is_absent(system, terms, selected, d));
    let point = sample::admissible_point(system, terms, 5)?;
    solvable(system, terms, selected, absent.collect(), &point).or_else(|| {
        let more = (6..9).filter_map(|seed| sample::admissible_point(system, terms, seed));
        let points: Vec<sample::Point> = more.chain([point.clone()]).collect();
        let absent = all.filter(|&d| seems_absent(system, terms, selected, d, &points));
        solvable(system, terms, selected, absent.collect(), &point)
    })
}

/// As many of the coordinates as there are constraints, whose velocities can be solved for at the state.
fn solvable(
    system: &System,
    terms: &MotionTerms,
    selected: &[usize],
    absent: Vec<usize>,
    point: &sample::Point,
) -> Option<Vec<usize>> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for &row in selected {
        let entries: Vec<Expr> = absent.iter().map(|&d| terms.jacobian[row][d]).collect();
        rows.push(
            system
                .graph
                .evaluate_f64(&entries, &|s| point.get(&s).copied())
                .ok()?,
        );
    }
    let columns = pivot_columns(rows)?;
    Some(columns.into_iter().map(|c| absent[c]).collect())
}

/// One pivot column per row by elimination with row-wise largest pivot; `None` when the rank is short.
fn pivot_columns(mut rows: Vec<Vec<f64>>) -> Option<Vec<usize>> {
    let mut columns = Vec::new();
    // Each row in its own units.
    let largest = |row: &Vec<f64>| row.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scales: Vec<f64> = rows.iter().map(largest).collect();
    for i in 0..rows.len() {
        let (column, value) = rows[i]
            .iter()
            .enumerate()
            .map(|(j, x)| (j, x.abs()))
            .max_by(|a, b| a.1.total_cmp(&b.1))?;
        if value <= 1e-9 * scales[i] {
            return None;
        }
        columns.push(column);
        for o in i + 1..rows.len() {
            let factor = rows[o][column] / rows[i][column];
            for j in 0..rows[o].len() {
                let step = factor * rows[i][j];
                rows[o][j] -= step;
            }
        }
    }
    columns.sort_unstable();
    Some(columns)
}
