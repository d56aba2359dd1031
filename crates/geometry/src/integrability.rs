//! `model.constraints-integrable`: Frobenius' condition for the Chetaev Pfaff system.
//!
//! The condition is `dΘ(f^l) ∧ Θ(f¹) ∧ … ∧ Θ(f^r) = 0` for all l (T3 (5)). The forms are independent (rank f_v = r), so
//! at a point they extend to a basis of 1-forms, and a 2-form ω has `ω ∧ Θ¹ ∧ … ∧ Θ^r = 0` exactly when every term of
//! ω in that basis contains some Θ, that is when `ω(U, V) = 0` for all U, V in their common kernel. By bilinearity a
//! basis of the kernel suffices; it is that of [`Distribution`]. What remains of the pairs:
//!
//! **Weak**, pulled back to N = {f = 0}: the kernel in TN has the basis b_i, Y_i, Y_0. Fields b have neither t nor q
//! components, hence `dΘ(b_i, b_j) = 0` and `dΘ(b_i, Y_j) = b_iᵀ f_vv b_j`; on N `c - v = -Σ v^j b_j`, hence
//! `dΘ(b_i, Y_0) = b_iᵀ f_vv (c - v)` follows from these. Left: `b_iᵀ f_vv b_j` (i ≤ j), `dΘ(Y_i, Y_j)`, `dΘ(Y_0, Y_i)`.
//! On N a change f → H f gives Θ → HΘ, so the ideal and the condition do not change.
//!
//! **Strong**, identically on J¹: besides `dΘ(Y_i, Y_j)`, `dΘ(Y_0, Y_i)` the pairs `dΘ(∂_v, Y_j) = f_vv B_j` and
//! `dΘ(∂_v, Y_0) = f_vv (c - v)`. The B_j span ker J and `J (c - v) = -f`, so with one constraint f_vv = 0 wherever
//! f ≠ 0; that f_vv = 0 follows for any number of constraints is Zhao's remark.
//!
//! Where the pairs are too many, `dΘ(U, V) = 0` is tested for U and V with indeterminate coefficients in the basis: an
//! identity in these coefficients is the same statement, one residual for each constraint.

mod integral;
pub(crate) use integral::on_its_own;

use crate::cartan::{exterior_derivative, CartanForm, JetField};
use crate::distribution::Distribution;
use chetaev_mechanics::characteristics::{self, Manifold};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::{sample, Characteristics, MotionTerms, Selection, System};
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Node, Verdict};
use std::collections::BTreeSet;

/// The most residuals tested pair by pair.
const PAIRWISE_BUDGET: usize = 3000;

/// The most constraints whose sub-systems of every size are looked at; above, single constraints only.
const ALL_SUBSETS: usize = 3;

/// The most sub-systems named one by one.
const LISTED: usize = 6;

/// Which of the two conditions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strength {
    /// Pulled back to the constraint manifold: holonomic in disguise.
    Weak,
    /// Identically on the jet space: a property of f as it is written.
    Strong,
}

/// One component of Frobenius' condition.
#[derive(Clone, Debug)]
pub struct Residual {
    /// Index of the constraint in the system.
    pub constraint: usize,
    /// The names of the two fields.
    pub fields: (String, String),
    /// dΘ(U, V).
    pub value: Expr,
}

/// Constraints to test together: terms with independent rows only, and dependent velocities for them.
#[derive(Debug)]
pub struct PfaffSystem<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    selection: Selection,
}

impl<'a> PfaffSystem<'a> {
    /// The Pfaff system of the selected constraints.
    pub fn new(
        system: &'a System,
        terms: &'a MotionTerms,
        selection: Selection,
    ) -> PfaffSystem<'a> {
        PfaffSystem {
            system,
            terms,
            selection,
        }
    }

    /// The components of Frobenius' condition that do not vanish as they are written.
    ///
    /// # Errors
    /// [`SolveError`] when the dependent velocities cannot be solved for.
    pub fn residuals(&self, strength: Strength) -> Result<Vec<Residual>, SolveError> {
        let distribution = match strength {
            Strength::Weak => Distribution::on_constraint_manifold,
            Strength::Strong => Distribution::on_jet_space,
        }(self.system, self.terms, &self.selection)?;
        let g = &self.system.graph;
        let mut residuals = if self.pairs(strength) > PAIRWISE_BUDGET {
            self.contracted(&distribution)
        } else {
            self.pairwise(&distribution, strength)
        };
        residuals.retain(|residual| !g.is_zero(residual.value));
        Ok(residuals)
    }

    /// The constraint manifold of these constraints.
    pub fn manifold(&self) -> Manifold {
        Characteristics::independent_velocities(self.system, self.terms, &self.selection)
            .map(|c| c.manifold)
            .unwrap_or_default()
    }

    fn pairs(&self, strength: Strength) -> usize {
        let (n, r) = (self.system.n(), self.selection.rows.len());
        let k = n - r;
        let curved = self.selection.rows.iter().any(|&row| self.is_curved(row));
        let vertical = match (curved, strength) {
            (false, _) => 0,
            (true, Strength::Weak) => k * (k + 1) / 2,
            (true, Strength::Strong) => n * (k + 1),
        };
        r * (vertical + k * (k + 1) / 2)
    }

    /// Whether the gradient of the constraint contains velocities as it is written.
    fn is_curved(&self, row: usize) -> bool {
        !self.system.constraints[self.terms.constraint_index[row]].gradient_constant
    }

    fn pairwise(&self, distribution: &Distribution, strength: Strength) -> Vec<Residual> {
        let horizontal: Vec<&JetField> = distribution
            .horizontal
            .iter()
            .chain([&distribution.time])
            .collect();
        let mut residuals = Vec::new();
        for &row in &self.selection.rows {
            let form = CartanForm::of(self.system, self.terms.constraints[row]);
            let rates: Vec<CartanForm> = horizontal
                .iter()
                .map(|field| form.rate(self.system, field))
                .collect();
            let mut push = |u: (&JetField, &CartanForm), v: (&JetField, &CartanForm)| {
                residuals.push(Residual {
                    constraint: self.terms.constraint_index[row],
                    fields: (u.0.name.clone(), v.0.name.clone()),
                    value: exterior_derivative(self.system, u, v),
                });
            };
            for i in 0..horizontal.len() {
                for j in 0..i {
                    push((horizontal[j], &rates[j]), (horizontal[i], &rates[i]));
                }
            }
            if !self.is_curved(row) {
                continue;
            }
            for (i, b) in distribution.vertical.iter().enumerate() {
                let rate = form.rate(self.system, b);
                // On N the pairs with Y_0 and half of the others follow; see the head of this file.
                let partners = match strength {
                    Strength::Weak => i..horizontal.len() - 1,
                    Strength::Strong => 0..horizontal.len(),
                };
                for j in partners {
                    push((b, &rate), (horizontal[j], &rates[j]));
                }
            }
        }
        residuals
    }

    /// dΘ(U, V) for two combinations of all fields with indeterminate coefficients.
    fn contracted(&self, distribution: &Distribution) -> Vec<Residual> {
        let (u, v) = (
            self.combination(distribution, "U"),
            self.combination(distribution, "V"),
        );
        self.selection
            .rows
            .iter()
            .map(|&row| {
                let form = CartanForm::of(self.system, self.terms.constraints[row]);
                let (along_u, along_v) = (form.rate(self.system, &u), form.rate(self.system, &v));
                Residual {
                    constraint: self.terms.constraint_index[row],
                    fields: ("U".into(), "V".into()),
                    value: exterior_derivative(self.system, (&u, &along_u), (&v, &along_v)),
                }
            })
            .collect()
    }

    /// `Σ U[Y] Y` over the basis; the bracket keeps the name of the coefficient apart from every name of a model.
    fn combination(&self, distribution: &Distribution, name: &str) -> JetField {
        let g = &self.system.graph;
        let weighted: Vec<(Expr, &JetField)> = distribution
            .fields()
            .map(|field| (g.symbol(&format!("{name}[{}]", field.name), 0), field))
            .collect();
        let sum = |component: &dyn Fn(&JetField) -> Expr| {
            let parts: Vec<Expr> = weighted
                .iter()
                .map(|(weight, field)| g.mul(&[*weight, component(field)]))
                .collect();
            g.add(&parts)
        };
        let n = self.system.n();
        JetField {
            name: name.into(),
            t: sum(&|field| field.t),
            q: (0..n).map(|s| sum(&|field| field.q[s])).collect(),
            v: (0..n).map(|s| sum(&|field| field.v[s])).collect(),
        }
    }
}

/// `model.constraints-integrable`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintsIntegrable;

impl Claim for ConstraintsIntegrable {
    fn id(&self) -> &'static str {
        "model.constraints-integrable"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn speaks_of_motions(&self) -> bool {
        true
    }

    fn title(&self) -> &'static str {
        "The constraints are integrable"
    }

    fn explanation(&self) -> &'static str {
        "Constraints on velocities are integrable when they only say that some functions of position and time keep their \
         values: then the system is holonomic in disguise. Each constraint f gives the Cartan form \
         Θ(f) = (f - fᵥ·v) dt + fᵥ·dq, and Frobenius' theorem asks whether dΘ(f) vanishes on all pairs of directions \
         that the forms Θ annihilate. `weak` asks this at the states that satisfy the constraints; it does not depend on \
         how the constraints are written and is the verdict on the mechanics. `strong` asks it at all states; it fails \
         for every f that is not linear in the velocities, so its failure alone says nothing about the mechanics. \
         Constraints that are not integrable one by one may be so together, and the detail tells which sub-systems are \
         integrable by themselves."
    }

    fn subjects(&self, _: &Context<'_>) -> Vec<Option<String>> {
        vec![Some("weak".into()), Some("strong".into())]
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let strength = match subject {
            Some("strong") => Strength::Strong,
            _ => Strength::Weak,
        };
        if cx.terms.constraints.is_empty() {
            let detail = "the system has no constraints on its velocities";
            return Verdict::Proved(Proof::structural("everywhere", detail)).into();
        }
        if cx.selection.rows.is_empty() {
            return Verdict::not_applicable(
                "model.constraints-independent",
                "no constraint has a gradient by the velocities where it holds",
            )
            .into();
        }
        let pfaff = PfaffSystem::new(cx.system, cx.terms, cx.selection.clone());
        let mut finding = decide(cx, &pfaff, strength);
        finding.verdict = on_each_side(cx, finding.verdict);
        let mut sentence = summary(&pfaff, strength, &finding.verdict).to_string();
        let integrable = matches!(finding.verdict, Verdict::Proved(_));
        let subsystems = subsystems(cx, strength);
        // A product may be integrable on one of its components only.
        let partly = matches!(finding.verdict, Verdict::Conditional { .. });
        let some = integrable || partly || subsystems.as_ref().is_some_and(|(_, some)| *some);
        if some && strength == Strength::Weak {
            let all = integral::kept(cx).into_iter();
            for kept in all.filter(|kept| !partly || !kept.functions.is_empty()) {
                let texts = kept.functions.iter().map(|&e| cx.system.graph.text(e));
                let texts = texts.collect::<Vec<String>>().join(", ");
                let place = match &kept.place {
                    Some(place) => format!(" {place}"),
                    None => String::new(),
                };
                let missing = cx.selection.rows.len().saturating_sub(kept.functions.len());
                sentence = match texts.is_empty() {
                    true => format!("{sentence}; what they keep{place} was not found among the functions that occur, their logarithms and arctangents"),
                    false if integrable && kept.place.is_none() && missing > 0 => {
                        format!("{sentence}; what they keep: {texts}, and {missing} more, not found")
                    }
                    false => format!("{sentence}; what they keep{place}: {texts}"),
                };
                let caption =
                    format!("a function of the positions that the constraints keep{place}");
                let formulas = kept.functions.into_iter().map(|right| Formula {
                    caption: caption.clone(),
                    left: None,
                    right,
                });
                finding.formulas.extend(formulas);
            }
        }
        if let Some((parts, _)) = subsystems {
            sentence = format!("{sentence}; {parts}");
        }
        finding.verdict = finding.verdict.prefixed(&sentence);
        finding
    }
}

/// Frobenius' condition speaks of smooth constraints: where a constraint has a corner in the velocities, as `abs(x') = y'` has,
/// it says nothing, and curves that pass from one side to the other keep no function.
fn on_each_side(cx: &Context<'_>, verdict: Verdict) -> Verdict {
    let corners = corners(cx);
    match verdict {
        Verdict::Proved(proof) if !corners.is_empty() => {
            let g = &cx.system.graph;
            let texts = corners.iter().map(|&e| format!("{} ≠ 0", g.text(e)));
            let condition = texts.collect::<Vec<String>>().join(" and ");
            Verdict::Conditional {
                condition: format!("{condition}, on each side by itself"),
                proof,
                counterexample: None,
            }
        }
        other => other,
    }
}

/// What is not zero where the independent constraints are smooth in the velocities.
fn corners(cx: &Context<'_>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let rows = cx.selection.rows.iter();
    let constraints: Vec<Expr> = rows.map(|&l| cx.terms.constraints[l]).collect();
    let (velocities, stated) = (system.velocity_symbols(), assumptions(system));
    let corners = g.reachable(&constraints).into_iter().filter_map(|e| {
        let inside = match g.node(e) {
            Node::Apply {
                function: Function::Abs | Function::Sign,
                arguments,
            } => arguments.first().copied(),
            Node::Power { base, exponent } => {
                let is_whole = g.as_number(*exponent).is_some_and(|n| n.is_int());
                (!is_whole).then_some(*base)
            }
            _ => None,
        };
        // A root of what vanishes nowhere has no corner.
        let vanishes = |x: Expr| !known_sign(g, x, &stated).is_nonzero();
        inside.filter(|&x| g.any_contains_any(&[x], &velocities) && vanishes(x))
    });
    let corners: BTreeSet<Expr> = corners.collect();
    corners.into_iter().collect()
}

/// Decides Frobenius' condition: first the plainest component that a sampled state shows to be nonzero, for a
/// counterexample that a person can follow, then all of them.
fn decide(cx: &Context<'_>, pfaff: &PfaffSystem<'_>, strength: Strength) -> Finding {
    let residuals = match pfaff.residuals(strength) {
        Ok(residuals) => residuals,
        Err(problem) => {
            let tried = format!("the dependent velocities could not be solved for: {problem}");
            return Verdict::undecided(tried).into();
        }
    };
    let (manifold, on) = match strength {
        Strength::Weak => (pfaff.manifold(), "on the constraint manifold"),
        Strength::Strong => (Manifold::default(), "identically in q, v, t"),
    };
    if let Some(plainest) = plainest_nonzero(pfaff, &residuals) {
        let verdict = cx
            .prover
            .identity(cx.system, &[plainest.value], &manifold, on);
        if matches!(verdict, Verdict::Refuted(_)) {
            return Finding {
                verdict,
                formulas: vec![formula(cx.system, plainest)],
            };
        }
    }
    let values: Vec<Expr> = residuals.iter().map(|residual| residual.value).collect();
    cx.prover.identity(cx.system, &values, &manifold, on).into()
}

/// The smallest residual that is clearly not zero at a sampled admissible state. A heuristic: what it finds is proved.
fn plainest_nonzero<'r>(
    pfaff: &PfaffSystem<'_>,
    residuals: &'r [Residual],
) -> Option<&'r Residual> {
    let g = &pfaff.system.graph;
    let values: Vec<Expr> = residuals.iter().map(|residual| residual.value).collect();
    let point = sample::admissible_point(pfaff.system, pfaff.terms, 0x66_72_6f_62)?;
    let mut generator = sample::Generator::new(29);
    let mut extra = std::collections::BTreeMap::new();
    for symbol in g.symbols_in(&values) {
        extra.insert(symbol, generator.between(0.4, 1.6));
    }
    let found = g
        .evaluate_f64(&values, &|s| {
            point.get(&s).or_else(|| extra.get(&s)).copied()
        })
        .ok()?;
    residuals
        .iter()
        .zip(found)
        .filter(|(_, value)| value.is_finite() && value.abs() > 1e-7)
        .min_by_key(|(residual, _)| g.reachable(&[residual.value]).len())
        .map(|(residual, _)| residual)
}

fn formula(system: &System, residual: &Residual) -> Formula {
    Formula {
        caption: format!(
            "dΘ of `{}` on the fields {} and {}, which would vanish for integrable constraints",
            system.constraints[residual.constraint].name, residual.fields.0, residual.fields.1
        ),
        left: None,
        right: residual.value,
    }
}

fn summary(pfaff: &PfaffSystem<'_>, strength: Strength, verdict: &Verdict) -> &'static str {
    let several = pfaff.selection.rows.len() > 1;
    match (verdict, strength, several) {
        (Verdict::Proved(_), Strength::Weak, false) => {
            "the constraint restricts positions, not only velocities: it is integrable"
        }
        (Verdict::Proved(_), Strength::Weak, true) => {
            "the constraints together restrict positions, not only velocities: they are integrable"
        }
        (Verdict::Refuted(_), Strength::Weak, false) => "the constraint is nonholonomic",
        (Verdict::Refuted(_), Strength::Weak, true) => "the constraints together are nonholonomic",
        (Verdict::Proved(_), Strength::Strong, _) => {
            "Frobenius' condition holds at all states, also where f is not zero"
        }
        (Verdict::Refuted(_), Strength::Strong, _) => {
            "Frobenius' condition fails for the functions f as they are written"
        }
        _ => "Frobenius' condition for the constraints",
    }
}

/// Which sub-systems of several constraints are integrable by themselves, in words.
fn subsystems(cx: &Context<'_>, strength: Strength) -> Option<(String, bool)> {
    let rows = &cx.selection.rows;
    let r = rows.len();
    if r < 2 {
        return None;
    }
    let subsets: Vec<Vec<usize>> = if r <= ALL_SUBSETS {
        proper_subsets(rows)
    } else {
        rows.iter().map(|&row| vec![row]).collect()
    };
    let (mut integrable, mut not, mut open) = (Vec::new(), Vec::new(), Vec::new());
    for subset in subsets {
        let names = names(cx.system, cx.terms, &subset);
        let verdict = subset_verdict(cx, &subset, strength);
        match verdict {
            Verdict::Proved(_) => integrable.push(names),
            Verdict::Refuted(_) => not.push(names),
            _ => open.push(names),
        }
    }
    let some = !integrable.is_empty();
    let parts: Vec<String> = [
        (integrable, "integrable by themselves"),
        (not, "not integrable by themselves"),
        (open, "not decided by themselves"),
    ]
    .into_iter()
    .filter(|(names, _)| !names.is_empty())
    .map(|(names, word)| format!("{word}: {}", listed(&names)))
    .collect();
    Some((parts.join("; "), some))
}

/// All names of a short list, the first few of a long one.
fn listed(names: &[String]) -> String {
    match names.get(..LISTED) {
        Some(first) if names.len() > LISTED + 1 => {
            let more = names.len() - LISTED;
            format!("{} and {more} more", first.join(", "))
        }
        _ => names.join(", "),
    }
}

/// Single constraints first, then pairs; never all of them.
fn proper_subsets(rows: &[usize]) -> Vec<Vec<usize>> {
    let mut subsets: Vec<Vec<usize>> = (1..(1usize << rows.len()) - 1)
        .map(|mask| {
            rows.iter()
                .enumerate()
                .filter(|(bit, _)| mask >> bit & 1 == 1)
                .map(|(_, &row)| row)
                .collect()
        })
        .collect();
    subsets.sort_by_key(|subset: &Vec<usize>| (subset.len(), subset.clone()));
    subsets
}

fn names(system: &System, terms: &MotionTerms, rows: &[usize]) -> String {
    let names: Vec<String> = rows
        .iter()
        .map(|&row| format!("`{}`", system.constraints[terms.constraint_index[row]].name))
        .collect();
    if names.len() == 1 {
        names.concat()
    } else {
        format!("{{{}}}", names.join(", "))
    }
}

fn subset_verdict(cx: &Context<'_>, rows: &[usize], strength: Strength) -> Verdict {
    let terms = restricted_terms(cx.terms, rows);
    match characteristics::select(cx.system, &terms) {
        Ok(selection) => {
            let pfaff = PfaffSystem::new(cx.system, &terms, selection);
            decide(cx, &pfaff, strength).verdict
        }
        Err(problem) => Verdict::undecided(problem.to_string()),
    }
}

/// The terms with some of the constraints only.
fn restricted_terms(terms: &MotionTerms, rows: &[usize]) -> MotionTerms {
    MotionTerms {
        order: terms.order,
        jets: terms.jets.clone(),
        mass_matrix: terms.mass_matrix.clone(),
        force: terms.force.clone(),
        affine: rows.iter().map(|&row| terms.affine[row]).collect(),
        constraints: rows.iter().map(|&row| terms.constraints[row]).collect(),
        jacobian: rows
            .iter()
            .map(|&row| terms.jacobian[row].clone())
            .collect(),
        constraint_rate: rows.iter().map(|&row| terms.constraint_rate[row]).collect(),
        constraint_index: rows
            .iter()
            .map(|&row| terms.constraint_index[row])
            .collect(),
    }
}
