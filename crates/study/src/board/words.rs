//! The words of a derivation: titles, general forms and reasons of its steps.

use super::{Board, Checked};
use chetaev_mechanics::equations::Schema;
use chetaev_mechanics::steps::StepKind;
use chetaev_symbolic::Verdict;

/// What a person reads of a kind of steps.
pub(super) struct StepWords {
    /// Its heading.
    pub(super) title: &'static str,
    /// Its general form.
    pub(super) schema: Option<Schema>,
    /// Why it holds.
    pub(super) reason: &'static str,
}

const fn words(
    title: &'static str,
    (text, latex): (&'static str, &'static str),
    reason: &'static str,
) -> StepWords {
    StepWords {
        title,
        schema: Some(Schema { text, latex }),
        reason,
    }
}

const fn stated(title: &'static str, reason: &'static str) -> StepWords {
    StepWords {
        title,
        schema: None,
        reason,
    }
}

/// The words of a kind of steps.
pub(super) fn of(kind: StepKind) -> StepWords {
    of_all_coordinates(kind)
        .or_else(|| of_restriction(kind))
        .unwrap_or_else(|| of_equations(kind))
}

/// What is stated, and the parts of Lagrange's left sides.
fn of_all_coordinates(kind: StepKind) -> Option<StepWords> {
    Some(match kind {
        StepKind::Lagrangian => stated("The Lagrangian", "The model states it."),
        StepKind::Forces => stated(
            "The forces that the Lagrangian does not contain",
            "The model states them.",
        ),
        StepKind::Constraints => stated("The constraints", "The model states them."),
        StepKind::QuasiVelocities => stated(
            "Quasi-velocities",
            "There are as many as degrees of freedom in velocity; they name the motions that the constraints allow.",
        ),
        StepKind::FullMomenta => words(
            "The derivatives by the velocities",
            ("p_i = ∂L/∂v^i", r"p_i = \frac{\partial L}{\partial \dot q^i}"),
            "All coordinates and velocities are independent here.",
        ),
        StepKind::FullRates => words(
            "Their rates",
            ("D p_i", r"\dot p_i = \frac{d}{dt}\frac{\partial L}{\partial \dot q^i}"),
            "The chain rule along the motion: q changes at the rate q', and q' at the rate q''.",
        ),
        StepKind::FullSlopes => words(
            "The derivatives by the coordinates",
            ("L_i = ∂L/∂q^i", r"L_i = \frac{\partial L}{\partial q^i}"),
            "Coordinates that do not occur in L are left out.",
        ),
        StepKind::LeftSides => words(
            "Lagrange's left sides",
            (
                "E_i = D(∂L/∂v^i) − ∂L/∂q^i − Q_i",
                r"E_i = \frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} - Q_i",
            ),
            "They would vanish if nothing were constrained.",
        ),
        StepKind::WithMultipliers => words(
            "The equations of motion",
            (
                "D(∂L/∂v^i) − ∂L/∂q^i = Q_i + Σ_l λ_l ∂f^l/∂v^i",
                r"\frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} = Q_i + \sum_l \lambda_l \frac{\partial f^l}{\partial \dot q^i}",
            ),
            "By the principle of d'Alembert and Lagrange; reactions do no work on virtual displacements, which by Chetaev's condition satisfy Σ ∂f/∂v δq = 0.",
        ),
        StepKind::ConstraintsDifferentiated => words(
            "The constraints, differentiated once",
            ("D f = 0", r"\frac{d}{dt} f = 0"),
            "A constraint that holds at all times has no rate; this gives as many equations as there are multipliers.",
        ),
        StepKind::SolvedForAll => stated(
            "Solved for accelerations and multipliers",
            "The last equations are linear in them; what is found satisfies all of them.",
        ),
        _ => return None,
    })
}

/// The restricted Lagrangian and its derivatives.
fn of_restriction(kind: StepKind) -> Option<StepWords> {
    Some(match kind {
        StepKind::AdmissibleVelocities => words(
            "The velocities that the constraints allow",
            ("q' = φ(t, q, P)", r"\dot q = \varphi(t, q, P)"),
            "Put into the constraints they satisfy them identically.",
        ),
        StepKind::VirtualDisplacements => words(
            "Virtual displacements",
            (
                "δq^i = Σ_σ B^i_σ δπ_σ,  B^i_σ = ∂φ^i/∂P_σ",
                r"\delta q^i = \sum_\sigma B^i_\sigma\, \delta\pi_\sigma, \quad B^i_\sigma = \frac{\partial \varphi^i}{\partial P_\sigma}",
            ),
            "Σ ∂f/∂v^i B^i_σ = 0: the reactions do no work on them.",
        ),
        StepKind::RestrictedLagrangian => words(
            "The Lagrangian on the constraints",
            ("L* = L(t, q, φ)", r"L^* = L(t, q, \varphi)"),
            "The velocities of the last step are put in the place of q'.",
        ),
        StepKind::Momenta => words(
            "Its derivatives by the quasi-velocities",
            ("p_σ = ∂L*/∂P_σ", r"p_\sigma = \frac{\partial L^*}{\partial P_\sigma}"),
            "By the chain rule they are Σ ∂L/∂v^i B^i_σ, too.",
        ),
        StepKind::Rates => words(
            "The rates of these",
            ("D p_σ", r"\dot p_\sigma"),
            "The chain rule along the motion: q changes at the rate φ, and P at the rate P'.",
        ),
        StepKind::Slopes => words(
            "Its derivatives along the quasi-velocities",
            (
                "S_σ = ∂L*/∂π_σ = Σ_i ∂L*/∂q^i B^i_σ",
                r"S_\sigma = \frac{\partial L^*}{\partial \pi_\sigma} = \sum_i \frac{\partial L^*}{\partial q^i} B^i_\sigma",
            ),
            "The virtual displacement that belongs to P_σ changes every coordinate.",
        ),
        StepKind::DependentMomenta => words(
            "The derivatives of the full Lagrangian, on the constraints",
            (
                "θ_i = ∂L/∂v^i at v = φ",
                r"\theta_i = \left.\frac{\partial L}{\partial \dot q^i}\right|_{\dot q = \varphi}",
            ),
            "They are taken of L before the constraints are used, because L* no longer contains these velocities.",
        ),
        StepKind::Brackets => words(
            "The curvature of the constraints",
            (
                "A^i_σ = D B^i_σ − ∂φ^i/∂π_σ",
                r"A^i_\sigma = \frac{d}{dt} B^i_\sigma - \frac{\partial \varphi^i}{\partial \pi_\sigma}",
            ),
            "Variation and rate do not commute: with δP = (δπ)', (δq^i)' − δ(q'^i) = Σ A^i_σ δπ_σ.",
        ),
        StepKind::CurvatureTerms => words(
            "The curvature terms",
            ("C_σ = Σ_i θ_i A^i_σ", r"C_\sigma = \sum_i \theta_i A^i_\sigma"),
            "This is what Lagrange's equations of L* alone would miss.",
        ),
        StepKind::ForcesAlong => words(
            "The forces along the quasi-velocities",
            ("R_σ = Σ_i Q_i B^i_σ", r"R_\sigma = \sum_i Q_i B^i_\sigma"),
            "Their work on the virtual displacements is Σ R_σ δπ_σ.",
        ),
        _ => return None,
    })
}

/// What is collected, and the reactions.
fn of_equations(kind: StepKind) -> StepWords {
    match kind {
        StepKind::Contracted => words(
            "Contracted with the virtual displacements",
            (
                "Σ_i E_i B^i_σ = 0",
                r"\sum_i E_i B^i_\sigma = 0",
            ),
            "By the principle of d'Alembert and Lagrange Σ E_i δq^i = 0 for all virtual displacements; velocities and accelerations are those on the constraints.",
        ),
        StepKind::Shortened => stated(
            "In the fewest terms",
            "Solved for the rates or divided by factors that never vanish; the rates of the last equations satisfy these.",
        ),
        StepKind::ReactionEquations => words(
            "What the reactions balance",
            (
                "Σ_l λ_l ∂f^l/∂v^i = D(∂L/∂v^i) − ∂L/∂q^i − Q_i",
                r"\sum_l \lambda_l \frac{\partial f^l}{\partial \dot q^i} = \frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} - Q_i",
            ),
            "Lagrange's equations with multipliers, of as many coordinates as there are constraints, on the constraints.",
        ),
        StepKind::Reactions => stated(
            "The reactions",
            "With the rates that were found; the equations of the other coordinates give the same.",
        ),
        _ => words(
            "Collected",
            (
                "D p_σ − S_σ − C_σ = R_σ",
                r"\dot p_\sigma - S_\sigma - C_\sigma = R_\sigma",
            ),
            "The left side is Σ ( D(∂L/∂v^i) − ∂L/∂q^i ) B^i_σ identically, which the principle of d'Alembert and Lagrange makes equal to the work of the forces.",
        ),
    }
}

/// What stands in the place of formulas that are not written.
pub(super) fn not_written(checked: &Checked) -> Option<String> {
    match checked {
        Checked::Stated | Checked::Proved => None,
        Checked::NotProved(verdict) => Some(format!(
            "This step is not written, because its formulas were not proved ({}): {}.",
            verdict.word(),
            verdict.detail()
        )),
        Checked::TooLong(signs) => Some(format!(
            "This step is not written: its formulas have {}.",
            crate::typeset::length_in_words(*signs)
        )),
    }
}

/// What is said where all formulas of a step are zero.
pub(super) const ALL_VANISH: &str = "All of them vanish.";

/// What is said where a formulation offers no steps, with the names of those that do.
pub(super) fn offering(names: &str) -> String {
    match names {
        "" => "no formulation writes steps of this system: they are for constraints of first order and masses free of velocity".into(),
        names => format!("those that do are {names}"),
    }
}

/// How it is said that steps are checked, and that some are not written.
pub(super) fn checked(board: &Board) -> String {
    let proved = "What follows from the model is proved by the zero test, as it is written here.";
    let written = board.steps.iter().filter(|step| step.is_written()).count();
    match board.steps.len() - written {
        0 => proved.into(),
        1 => format!("{proved} One step is not written: it says why."),
        left => format!("{proved} {left} steps are not written: they say why."),
    }
}

/// What a reader is asked to do.
pub(super) fn exercise(title: &str) -> String {
    format!("Exercise: derive these equations ({title}) by hand from the Lagrangian and the constraints, and find the reactions. The solution is folded below.")
}

/// The heading of the solution.
pub(super) const SOLUTION: &str = "Solution, step by step";

/// A step whose check took too long.
pub(super) fn out_of_work() -> Verdict {
    Verdict::undecided("simplifying and deciding took more work than is allowed")
}
