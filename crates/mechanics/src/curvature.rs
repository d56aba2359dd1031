//! Curvature (non-commutation) coefficients of the constraints in kinematic characteristics.

use crate::characteristics::Characteristics;
use crate::system::System;
use chetaev_symbolic::Expr;

/// The components along the coordinates of the bracket of the motion with the fields `Y_σ = Σ_i B_iσ ∂/∂q^i`:
/// `D B_iσ - ∂φ^i/∂π_σ`, n × k, row by row, on the jet (t, q, P, P') (T3 (11a); the brackets of Volterra's second form,
/// T2 (V2q) with m = 1).
///
/// In the natural frame the rows of the independent velocities vanish, and those of the dependent ones are
/// [`curvature`].
pub fn brackets(system: &System, characteristics: &Characteristics) -> Vec<Vec<Expr>> {
    let slopes = characteristics.basis.concat();
    bracket(
        system,
        characteristics,
        &slopes,
        &characteristics.velocities,
    )
}

/// `A^l_s = D(∂φ^l/∂v^s) - ∂φ^l/∂q^s - Σ_m ∂φ^l/∂q^{k+m} ∂φ^m/∂v^s`, r × k, row by row, on the jet (t, q, P, P')
/// (Rumyantsev 1982; T1 (7)), for characteristics in the natural frame: rows in the order of
/// [`Characteristics::dependent`], columns in that of the parameters.
///
/// With them `Σ_s A^l_s δq^s = δf^l` for `f^l = v^{k+l} - φ^l` under Hölder's rule `δv = D(δq)`; for constraints linear in the
/// velocities all vanish exactly where these are completely integrable.
pub fn curvature(system: &System, characteristics: &Characteristics) -> Vec<Vec<Expr>> {
    let solved = &characteristics.solved;
    let slopes = characteristics.by_parameters(system, solved).concat();
    bracket(system, characteristics, &slopes, solved)
}

/// `D(∂F/∂P_σ) - ∂F/∂π_σ` of functions F with their slopes by the parameters, row by row.
fn bracket(
    system: &System,
    characteristics: &Characteristics,
    slopes: &[Expr],
    functions: &[Expr],
) -> Vec<Vec<Expr>> {
    let (g, k) = (&system.graph, characteristics.k());
    let rates = characteristics.total_derivative(system, slopes);
    let along = characteristics.by_quasi_coordinates(system, functions);
    along
        .iter()
        .enumerate()
        .map(|(i, row)| (0..k).map(|s| g.sub(rates[i * k + s], row[s])).collect())
        .collect()
}
