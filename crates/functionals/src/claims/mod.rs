//! The claims about functionals, one file each, in a registry.
//!
//! What several of them ask is decided in one place each:
//!
//! * `admission`, `reduction`, `variations`: which fields are admitted, and whether what is imposed restricts the variations;
//! * `traces`: whether what is imposed leaves values on the boundary arbitrary, or the model states so (`solvable`), so that natural conditions are taken
//!   one by one;
//! * `special_values`: claims for values that the model states, which keep to what is assumed;
//! * `euler/extension`: a jet refutes only where it is that of a solution; else `euler/separation` looks for fields for which one system holds and not the
//!   other, and `euler/sufficiency`, where variations are restricted, for an admitted one that changes the functional;
//! * `potential`: what an expression is the divergence of.

pub mod admission;

mod branches;
mod degeneration;
mod descent;
mod duality;
mod euler;
mod flux;
mod given;
mod legendre;
mod modulo;
mod multipliers;
pub mod noether;
mod on_box;
mod potential;
pub mod reduction;
pub(crate) mod ritz;
mod second_variation;
mod solution;
mod special_values;
mod traces;
mod variations;

use self::admission::Admission;
use crate::functional::{Functional, Missing, Problem, Relation};
use crate::notation::{written, Node};
use crate::ritz::Approximation;
use crate::smoothness::Coefficients;
use crate::tensors::Scope;
use crate::variation::{variation, Variation, VariationError};
use chetaev_model::decision::Found;
use chetaev_symbolic::print::Format;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};
use std::cell::RefCell;

/// A formula shown with a verdict.
#[derive(Clone, Debug)]
pub struct Formula {
    /// What it is.
    pub caption: String,
    /// The expression; where it is an equation, it vanishes.
    pub value: Expr,
    /// The same in index notation, where it has such a form.
    pub indexed: Option<Printed>,
}

impl Formula {
    /// A formula that is shown in components.
    pub fn new(caption: impl Into<String>, value: Expr) -> Formula {
        Formula {
            caption: caption.into(),
            value,
            indexed: None,
        }
    }

    /// The same, shown as a tree in the names of a scope.
    #[must_use]
    pub fn written(mut self, tree: &Node, scope: &Scope) -> Formula {
        let of = |format| written(tree, scope, format);
        self.indexed = Some(Printed {
            text: of(Format::Text),
            mathml: of(Format::Mathml),
            latex: of(Format::Latex),
        });
        self
    }
}

/// Index notation in every notation of a page.
#[derive(Clone, Debug)]
pub struct Printed {
    /// As a model file writes it.
    pub text: String,
    /// MathML.
    pub mathml: String,
    /// LaTeX.
    pub latex: String,
}

/// A verdict with the formulas that support it.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What is known.
    pub verdict: Verdict,
    /// Formulas to show.
    pub formulas: Vec<Formula>,
}

impl Found for Finding {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }
}

impl From<Verdict> for Finding {
    fn from(verdict: Verdict) -> Finding {
        let formulas = Vec::new();
        Finding { verdict, formulas }
    }
}

/// What claims are decided about.
#[derive(Debug)]
pub struct Context<'p> {
    /// The problem.
    pub problem: &'p Problem,
    /// The first variation of its functional.
    pub variation: Result<Variation, VariationError>,
    /// Which fields are admitted.
    pub admission: Admission,
    /// How far the coefficients of its densities are smooth.
    coefficients: Coefficients,
    /// What Ritz's method found, by degree, for the report.
    pub approximations: RefCell<Vec<Approximation>>,
}

impl<'p> Context<'p> {
    /// The first variation is taken once, and what is imposed is looked at once.
    pub fn new(problem: &'p Problem) -> Context<'p> {
        let variation = variation(&problem.functional);
        Context {
            problem,
            variation,
            admission: Admission::of(&problem.functional),
            coefficients: Coefficients::of(&problem.functional),
            approximations: RefCell::default(),
        }
    }

    /// The functional.
    pub fn functional(&self) -> &'p Functional {
        &self.problem.functional
    }

    /// The relations of a claim whose other functional is not defined here.
    fn missing<'c>(&'c self, claim: &'c str) -> impl Iterator<Item = &'c Missing> {
        let all = self.problem.relations.iter();
        all.filter_map(move |relation| match relation {
            Relation::Without(missing) => (missing.claim == claim).then_some(missing),
            _ => None,
        })
    }

    /// The verdict on a relation whose other functional is not defined here.
    fn not_defined(&self, claim: &str, name: Option<&str>) -> Option<Verdict> {
        let mut all = self.missing(claim);
        let Missing { other, why, .. } = all.find(|own| own.name.as_deref() == name)?;
        Some(Verdict::not_applicable(
            format!("{other} is defined for these values"),
            format!("{other} is read with the values that are stated here, and then: {why}"),
        ))
    }

    /// The subject of claims about the functional itself.
    fn own(&self) -> Option<String> {
        Some(self.functional().name.clone())
    }
}

/// A statement about functionals.
pub trait Claim: Sync {
    /// The stable id, without subject.
    fn id(&self) -> &'static str;
    /// A short title for people.
    fn title(&self) -> &'static str;
    /// What is claimed, how it is decided, and what the verdicts mean.
    fn explanation(&self) -> &'static str;
    /// The subjects for this problem; empty where there is nothing to claim.
    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>>;
    /// Whether it speaks of the fields that the functional admits, so that it says nothing where there are none.
    fn is_of_fields(&self) -> bool {
        true
    }
    /// Whether densities are differentiated by place or integrated by parts for it, so that it speaks of smooth ones.
    fn differentiates(&self) -> bool {
        false
    }
    /// Decides it.
    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding;
}

/// Decides a claim: where it speaks of admitted fields, for those that there are.
pub(crate) fn decided(claim: &dyn Claim, cx: &Context<'_>, subject: Option<&str>) -> Finding {
    let is_of_none = claim.is_of_fields() && cx.admission.none.is_some();
    if is_of_none {
        return cx.admission.applied(Verdict::undecided("")).into();
    }
    let Finding { verdict, formulas } = claim.decide(cx, subject);
    let verdict = if claim.is_of_fields() {
        cx.admission.applied(verdict)
    } else {
        verdict
    };
    let verdict = if claim.differentiates() {
        where_smooth(&cx.coefficients, verdict)
    } else {
        verdict
    };
    let verdict = under(&cx.functional().assumptions, verdict);
    Finding { verdict, formulas }
}

fn broken(why: &str) -> String {
    format!(
        "the density is not smooth in the body, where {why} does not hold everywhere: at such places conditions hold that are not derived"
    )
}

fn undecided(why: &str) -> String {
    format!("whether the density is smooth in the body was not decided: {why} would have to hold everywhere in it")
}

/// What is to be said of equations that are derived from densities with these coefficients, where these are not known to be smooth.
fn on_smoothness(coefficients: &Coefficients) -> Option<String> {
    match coefficients {
        Coefficients::Broken(why) => Some(broken(why)),
        Coefficients::Undecided(why) => Some(undecided(why)),
        Coefficients::Smooth(_) => None,
    }
}

/// A proof by differentiation holds where the coefficients of the densities are smooth; with a jump or a kink inside the body it is none.
fn where_smooth(coefficients: &Coefficients, verdict: Verdict) -> Verdict {
    match (coefficients, verdict) {
        (Coefficients::Broken(why), Verdict::Proved(_) | Verdict::Conditional { .. }) => {
            Verdict::not_applicable(
                "smooth densities",
                format!(
                    "{}. One model for each part of the body says what holds in it",
                    broken(why)
                ),
            )
        }
        (Coefficients::Undecided(why), Verdict::Proved(_) | Verdict::Conditional { .. }) => {
            Verdict::undecided(undecided(why))
        }
        (Coefficients::Smooth(open), Verdict::Proved(mut proof)) if !open.is_empty() => {
            let own = open.iter().map(String::as_str);
            let new: Vec<&str> = own.filter(|own| !proof.on.contains(own)).collect();
            if !new.is_empty() {
                let said = format!(", where {}", new.join(" and "));
                proof.on.push_str(&said);
                proof.detail.push_str(&said);
            }
            Verdict::Proved(proof)
        }
        (_, verdict) => verdict,
    }
}

/// A proof names what the model assumes.
fn under(assumptions: &[String], verdict: Verdict) -> Verdict {
    if assumptions.is_empty() {
        return verdict;
    }
    let said = format!("assuming {}", assumptions.join(" and "));
    let with = |mut proof: Proof| {
        proof.on = if proof.on.is_empty() {
            said.clone()
        } else {
            format!("{}, {said}", proof.on)
        };
        proof
    };
    match verdict {
        Verdict::Proved(proof) => Verdict::Proved(with(proof)),
        Verdict::Conditional {
            condition,
            proof,
            counterexample,
        } => Verdict::Conditional {
            condition,
            proof: with(proof),
            counterexample,
        },
        other => other,
    }
}

/// All claims about functionals, in the order of the catalogue.
pub const CLAIMS: &[&dyn Claim] = &[
    &legendre::Legendre,
    &euler::Euler,
    &degeneration::Degeneration,
    &duality::Duality,
    &descent::Descent,
    &multipliers::Multipliers,
    &noether::Noether,
    &solution::Stated,
    &second_variation::SecondVariation,
    &ritz::Ritz,
];
