//! Zero testing: is an expression identically zero, everywhere or on the constraints of a model?
//!
//! [`decide_zero`] combines the ways of T6: expressions that cancel in canonical form are zero by exact arithmetic;
//! the *modular proof* evaluates a program over the field of §6.1 at random points of random prime fields and states
//! its bound on the probability of error; what is not zero is *refuted* by a verified enclosure at a point with small
//! rational data. What can be neither proved nor refuted is `numerical` or `undecided`, never called proved.
//!
//! * [`assumptions`]: what a model assumes of signs and ranges.
//! * [`rank`]: generic ranks and regularity of matrices, by the same means.
//! * [`points`]: values at random points of prime fields, for linear algebra over functions.
//! * [`enclose`]: evaluation in balls, also for its own sake.
//! * [`separation`]: is a number of roots and algebraic numbers zero?

mod approach;
pub mod assumptions;
mod branches;
mod coupling;
mod decide;
mod eliminate;
pub mod enclose;
mod evaluate;
mod exact;
mod expand;
mod modular;
mod newton;
pub mod points;
mod polynomials;
mod prepare;
mod program;
pub mod rank;
mod refute;
mod ring;
pub mod separation;
mod signs;
mod size;
mod straighten;
mod tower;
mod variety;

pub use decide::{decide_zero, Options, ZeroTest};
pub use rank::{generic_determinant_nonzero, generic_rank, GenericRank, Pivots, RankTest};

/// The signs that an expression can have under assumptions, as far as its structure tells.
pub fn known_sign(
    graph: &crate::Graph,
    e: crate::Expr,
    assumptions: &assumptions::Assumptions,
) -> assumptions::SignSet {
    signs::Signs::new(graph, assumptions).sign(e)
}

/// A point near a given one at which `constraints`, each with the symbol it determines, hold under `assumptions` and the residual does
/// not vanish. That there is one solution near is proved by the interval Newton operator, and the residual is enclosed away from
/// zero; all other symbols are rounded to multiples of 1/1024. `None` where that fails.
pub fn refuted_near(
    graph: &crate::Graph,
    residual: crate::Expr,
    constraints: &[(crate::Expr, crate::Symbol)],
    assumptions: &assumptions::Assumptions,
    near: &dyn Fn(crate::Symbol) -> Option<f64>,
) -> Option<crate::verdict::Counterexample> {
    let claim = refute::Claim {
        residuals: &[residual],
        constraints,
        solved: &[],
        assumptions,
    };
    refute::near(graph, &claim, near)
}

#[cfg(test)]
mod tests;
