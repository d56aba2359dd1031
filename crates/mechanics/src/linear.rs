//! Linear algebra over expressions that the derivations share: contractions, and equations linear in their unknowns.

use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// `Σ_i a_i b_i`; terms with a factor zero are left out.
pub fn dot<'a>(
    g: &Graph,
    a: impl IntoIterator<Item = &'a Expr>,
    b: impl IntoIterator<Item = &'a Expr>,
) -> Expr {
    let pairs = a.into_iter().zip(b);
    let parts: Vec<Expr> = pairs
        .filter(|(&a, &b)| !g.is_zero(a) && !g.is_zero(b))
        .map(|(&a, &b)| g.mul(&[a, b]))
        .collect();
    g.add(&parts)
}

/// The unknowns from as many equations `e = 0`, linear in them: `(∂e/∂x) x = −e(0)`.
///
/// # Errors
/// A matrix that is singular by its form.
pub fn solve_linear(
    g: &Graph,
    equations: &[Expr],
    unknowns: &[Symbol],
) -> Result<Vec<Expr>, SolveError> {
    let matrix = g.jacobian(equations, unknowns).concat();
    g.solve(&matrix, &at_zero(g, equations, unknowns))
}

/// Unknowns x and multipliers λ from equations `e_i = Σ_l λ_l c_li`, as many as both together, linear in x; row l of
/// `reactions` holds c_l of the first equations, the further ones are free of λ.
///
/// # Errors
/// A matrix that is singular by its form.
pub fn solve_with_multipliers(
    g: &Graph,
    equations: &[Expr],
    unknowns: &[Symbol],
    reactions: &[Vec<Expr>],
) -> Result<(Vec<Expr>, Vec<Expr>), SolveError> {
    let size = equations.len();
    let mut matrix = vec![g.zero(); size * size];
    for (i, row) in g.jacobian(equations, unknowns).iter().enumerate() {
        matrix[i * size..i * size + row.len()].copy_from_slice(row);
    }
    for (l, row) in reactions.iter().enumerate() {
        for (i, &slope) in row.iter().enumerate() {
            matrix[i * size + unknowns.len() + l] = g.neg(slope);
        }
    }
    let mut found = g.solve(&matrix, &at_zero(g, equations, unknowns))?;
    let multipliers = found.split_off(unknowns.len());
    Ok((found, multipliers))
}

/// `−e` where the unknowns vanish.
fn at_zero(g: &Graph, equations: &[Expr], unknowns: &[Symbol]) -> Vec<Expr> {
    let vanishing: Vec<(Expr, Expr)> = unknowns
        .iter()
        .map(|&symbol| (g.symbol_expr(symbol), g.zero()))
        .collect();
    let values = g.substitute_all(equations, &vanishing);
    values.into_iter().map(|e| g.neg(e)).collect()
}
