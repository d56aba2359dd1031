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

mod arctangents;
pub(crate) mod components;
mod eigenvectors;
pub(crate) mod integral;
mod presented;
mod primitive;
mod quadrature;
mod solved;
mod substitution;
mod subsystems;
pub(crate) use integral::on_its_own;

use crate::cartan::{exterior_derivative, CartanForm, JetField};
use crate::distribution::Distribution;
use crate::parameters;
use chetaev_mechanics::characteristics::Manifold;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::words::counted;
use chetaev_mechanics::{sample, Characteristics, ConstraintKind, MotionTerms, Selection, System};
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Node, Verdict};
use std::collections::BTreeSet;

/// The most residuals tested pair by pair.
const PAIRWISE_BUDGET: usize = 3000;

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

    fn is_for_any_controls(&self) -> bool {
        false
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
         Constraints that are not integrable one by one may be so together, and the detail tells which sub-systems were looked at and \
         which of them are integrable by themselves. Constraints that are not integrable may keep functions of position and time \
         all the same, as many as the brackets of the admissible displacements leave directions out. \
         Where constraints have corners, as abs and sign of velocities or of the place make them, the condition is asked on each side by itself: \
         paths over a corner need not keep what each side does. Parameters that a model defines by others are put in before \
         anything is decided; otherwise the verdict is for general values of the parameters, and where those stated make a difference it says so."
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
        parameters::with_definitions(cx, |cx| decided(cx, strength))
    }
}

fn decided(cx: &Context<'_>, strength: Strength) -> Finding {
    let pfaff = PfaffSystem::new(cx.system, cx.terms, cx.selection.clone());
    let mut finding = answered(cx, strength);
    let mut sentences = vec![summary(&pfaff, strength, &finding.verdict).to_owned()];
    if matches!(finding.verdict, Verdict::Refuted(_)) {
        sentences.extend(sides_apart(cx, strength));
    }
    if strength == Strength::Weak {
        let (said, formulas) = what_is_kept(cx, &finding.verdict);
        sentences.extend(said);
        finding.formulas.extend(formulas);
    }
    if strength == Strength::Strong || !components::are_apart(cx) {
        sentences.extend(subsystems::told(cx, strength));
    }
    finding.verdict = finding.verdict.prefixed(&sentences.join("; "));
    finding
}

/// Frobenius' condition for all constraints, on each of their components and each side of their corners.
fn answered(cx: &Context<'_>, strength: Strength) -> Finding {
    let on_components = match strength {
        Strength::Weak => components::on_components(cx),
        Strength::Strong => None,
    };
    if let Some(verdict) = on_components {
        return verdict.into();
    }
    let pfaff = PfaffSystem::new(cx.system, cx.terms, cx.selection.clone());
    let mut finding = decide(cx, &pfaff, strength);
    finding.verdict = on_each_side(cx, &cx.selection.rows, finding.verdict);
    match (strength, &finding.verdict) {
        (Strength::Weak, Verdict::Conditional { .. }) => on_real_points(cx).unwrap_or(finding),
        _ => finding,
    }
}

/// The verdict on the one component that has real points, as `z' = y x'` of `(z' − y x')(1 + x'²) = 0`.
fn on_real_points(cx: &Context<'_>) -> Option<Finding> {
    let [on] = &components::components(cx)[..] else {
        return None;
    };
    let mut found = on_its_own(cx, &on.system, |own| answered(own, Strength::Weak))?;
    found.verdict.prefix(&on.sentence);
    Some(found)
}

/// On which sides of corners the condition holds, where it does not hold on all: what vanishes on one side may not on another.
fn sides_apart(cx: &Context<'_>, strength: Strength) -> Option<String> {
    let sides = cx.system.sides().into_iter().filter_map(|side| {
        let own = on_its_own(cx, &side.system, |own| answered(own, strength));
        let holds = matches!(own?.verdict, Verdict::Proved(_));
        holds.then_some(side.condition?)
    });
    let places: Vec<String> = sides.collect();
    let told = match strength {
        Strength::Weak => "the constraints are integrable",
        Strength::Strong => "the condition holds",
    };
    let places = places.join(" or where ");
    (!places.is_empty()).then(|| format!("{told} where {places} by itself"))
}

/// What constraints keep, in words and as formulas: all that integrable ones do, and what others keep in spite of it.
fn what_is_kept(cx: &Context<'_>, verdict: &Verdict) -> (Vec<String>, Vec<Formula>) {
    let integrable = matches!(verdict, Verdict::Proved(_));
    // A product may be integrable on one of its components only.
    let partly = matches!(verdict, Verdict::Conditional { .. });
    if matches!(verdict, Verdict::Refuted(_)) && integral::is_nothing(cx) {
        return (Vec::new(), Vec::new());
    }
    let (mut sentences, mut formulas) = (Vec::new(), Vec::new());
    let all = integral::kept(cx);
    let has_none = |kept: &integral::Kept| kept.functions.is_empty() && kept.count.is_none();
    if integrable && all.iter().all(has_none) {
        let said = integral::said(cx, &[], None);
        return (vec![format!("what they keep: {said}")], formulas);
    }
    for kept in all {
        let whole = integrable.then_some(cx.selection.rows.len());
        let count = kept.count.or(whole.filter(|_| kept.place.is_none()));
        let unknown = kept.functions.is_empty() && count.is_none();
        if count == Some(0) || unknown {
            continue;
        }
        let place = kept.place.iter().map(|place| format!(" {place}"));
        let place: String = place.collect();
        let said = integral::said(cx, &kept.functions, count);
        sentences.push(match (integrable || partly, count) {
            (false, Some(count)) => {
                let many = counted(count, "function is", "functions are");
                format!("{many} kept in spite of it{place}: {said}")
            }
            _ => format!("what they keep{place}: {said}"),
        });
        formulas.extend(integral::formulas(&kept));
    }
    (sentences, formulas)
}

/// Frobenius' condition speaks of smooth constraints: where one has a corner, as `abs(x') = y'` and `z' = sign(y) x'` have, it says nothing,
/// and curves that pass from one side to the other may keep no function.
fn on_each_side(cx: &Context<'_>, rows: &[usize], verdict: Verdict) -> Verdict {
    let corners = corners(cx, rows);
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

/// What is not zero where these constraints are smooth: insides of absolute values and signs, and in the velocities of roots.
fn corners(cx: &Context<'_>, rows: &[usize]) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let kind = |l: usize| system.constraints[cx.terms.constraint_index[l]].kind;
    let rows = rows.iter().copied();
    let rows = rows.filter(|&l| kind(l) != ConstraintKind::Holonomic);
    let constraints: Vec<Expr> = rows.map(|l| cx.terms.constraints[l]).collect();
    let (velocities, stated) = (system.velocity_symbols(), assumptions(system));
    let roots = g.reachable(&constraints).into_iter().filter_map(|e| {
        let Node::Power { base, exponent } = g.node(e) else {
            return None;
        };
        let is_whole = g.as_number(*exponent).is_some_and(|n| n.is_int());
        // A root of what vanishes nowhere has no corner, and that of a square is an absolute value.
        let vanishes = !known_sign(g, *base, &stated).is_nonzero();
        let is_root = !is_whole && vanishes && g.contains_any(*base, &velocities);
        (is_root && system.corners_of(&[e]).is_empty()).then_some(*base)
    });
    let corners: BTreeSet<Expr> = roots.chain(system.corners_of(&constraints)).collect();
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
            .identity(pfaff.system, &[plainest.value], &manifold, on);
        if matches!(verdict, Verdict::Refuted(_)) {
            return Finding {
                verdict,
                formulas: vec![formula(cx.system, plainest)],
            };
        }
    }
    let values: Vec<Expr> = residuals.iter().map(|residual| residual.value).collect();
    let verdict = cx.prover.identity(pfaff.system, &values, &manifold, on);
    verdict.into()
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
        (Verdict::Conditional { .. }, Strength::Weak, _) => {
            "on the condition stated the constraints restrict positions, not only velocities: they are integrable there"
        }
        (Verdict::Conditional { .. }, Strength::Strong, _) => {
            "on the condition stated Frobenius' condition holds, also where f is not zero"
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
