//! Symmetries of the reduced system (T3 §6, theorem C): with the forces extended off the constraints so that every f keeps its
//! value everywhere, a field Z with `L_Z Ω̃ = 0` makes `Z f` a first integral.
//!
//! Here `Z = ∂/∂q^j` for coordinates that L does not contain; Ω̃ = dΘ(L) + E_s θ^s∧dt has `L_Z Ω̃ = (∂E_s/∂q^j) θ^s∧dt` then, so the
//! extension E must be free of q^j. It is found by linear equations: on f = 0 it is the force with the reaction,
//! `E_s = Q_s + λ_l ∂_s f^l`, and with it `X f = 0` holds at all states. The theorem depends on the extension: λ ∂f as it stands
//! is none for the sled.

use super::ansatz::Ansatz;
use super::family::{coefficients, monomials, product, CoefficientLetter, Letter};
use super::letters::Letters;
use super::motion::Motion;
use super::shown::readable;
use chetaev_mechanics::claims::formulation::{derive, manifold, REFERENCE};
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// A symmetry with its extension.
#[derive(Clone, Debug)]
pub struct Symmetry {
    /// Index of the coordinate q^j.
    pub coordinate: usize,
    /// Z f, one for each constraint of which it is not zero, with the name of the constraint.
    pub integrals: Vec<(String, Expr)>,
    /// E, length n, with the verdict that X f vanishes everywhere, that E is the force on f = 0, and that E is free of q^j; a
    /// sentence that says what was searched where no extension was found.
    pub extension: Result<(Vec<Expr>, Verdict), String>,
}

/// The most unknowns.
const UNKNOWNS: usize = 320;

/// The parts of the equations of motion off the constraints.
struct Setting<'c, 'a> {
    cx: &'c Context<'a>,
    motion: Motion<'a>,
    /// Rows of the independent constraints.
    rows: Vec<usize>,
    /// W⁻¹ ∂f, one for each row.
    gradients: Vec<Vec<Expr>>,
    /// X f without the extension, one for each row.
    free: Vec<Expr>,
    /// Q + λ ∂f on f = 0.
    forces: Vec<Expr>,
    /// Symbols given on f = 0.
    solved: Vec<(Expr, Expr)>,
}

impl<'c, 'a> Setting<'c, 'a> {
    fn of(cx: &'c Context<'a>) -> Result<Setting<'c, 'a>, String> {
        let (system, terms, g) = (cx.system, cx.terms, &cx.system.graph);
        let motion = Motion::of(cx)?;
        if !motion.manifold.implicit.is_empty() {
            return Err("the dependent velocities stay implicit".into());
        }
        let rows = cx.selection.rows.clone();
        let mass = terms.mass_matrix.concat();
        let solve = |right: &[Expr]| g.solve(&mass, right).map_err(|p| p.to_string());
        let gradients: Result<Vec<Vec<Expr>>, String> =
            rows.iter().map(|&l| solve(&terms.jacobian[l])).collect();
        let gradients = gradients?;
        let own: Vec<Expr> = terms
            .force
            .iter()
            .zip(&system.forces)
            .map(|(&b, &q)| g.sub(b, q))
            .collect();
        let free = rows
            .iter()
            .zip(&gradients)
            .map(|(&l, z)| {
                let mut parts: Vec<Expr> =
                    z.iter().zip(&own).map(|(&z, &b)| g.mul(&[z, b])).collect();
                parts.push(g.neg(terms.constraint_rate[l]));
                g.add(&parts)
            })
            .collect();
        let solved: Vec<(Expr, Expr)> = motion
            .manifold
            .solved
            .iter()
            .map(|&(s, e)| (g.symbol_expr(s), e))
            .collect();
        let routh = derive(cx, REFERENCE).map_err(|p| p.to_string())?;
        let lambdas: Vec<Expr> = routh.multipliers.iter().map(|(_, e)| *e).collect();
        let lambdas = routh.in_natural_state(system, &lambdas);
        let forces: Vec<Expr> = (0..system.n())
            .map(|s| {
                let mut parts = vec![system.forces[s]];
                for ((l, _), &lambda) in routh.multipliers.iter().zip(&lambdas) {
                    let row = terms.constraint_index.iter().position(|i| i == l);
                    parts.extend(row.map(|row| g.mul(&[lambda, terms.jacobian[row][s]])));
                }
                g.add(&parts)
            })
            .collect();
        Ok(Setting {
            forces: g.substitute_all(&forces, &solved),
            cx,
            motion,
            rows,
            gradients,
            free,
            solved,
        })
    }

    /// Functions free of q^j: velocities to the second degree, with functions of the place of weight up to `weight`.
    fn family(&self, symbol: Symbol, weight: u32) -> Vec<Expr> {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let mut letters = Letters::of(self.cx).coefficients;
        letters.retain(|c| !g.contains_any(c.letter.value, &[symbol]));
        // What a control turns, it turns at its rate.
        letters.extend(system.controls.iter().map(|u| CoefficientLetter {
            letter: Letter::plain(g.symbol(&u.name, 1)),
            exponents: (0, 1),
            weight: 1,
        }));
        let first = velocities.len();
        let functions = coefficients(&letters, first, weight);
        let value = |(letter, e): &(usize, i8)| {
            let base = match letter.checked_sub(first) {
                None => velocities[*letter],
                Some(place) => letters[place].letter.value,
            };
            g.powi(base, i64::from(*e))
        };
        let mut all = Vec::new();
        for (_, function) in &functions {
            for degree in 0..=2 {
                for monomial in monomials(first, degree) {
                    let member = product(&monomial, function);
                    all.push(g.mul(&member.iter().map(value).collect::<Vec<_>>()));
                }
            }
        }
        all
    }

    /// The extension that is free of q^j, or a sentence that says where none was found.
    fn extension(&self, symbol: Symbol) -> Result<Vec<Expr>, String> {
        let n = self.cx.system.n();
        let mut searched = None;
        for (weight, words) in [
            (0, "with constant coefficients"),
            (1, "with coefficients that occur in the model"),
        ] {
            let family = self.family(symbol, weight);
            if family.len() * n > UNKNOWNS {
                break;
            }
            if let Some(found) = self.extension_in(&family) {
                return Ok(found);
            }
            searched = Some(words);
        }
        Err(match searched {
            Some(words) => format!("no extension of the forces was found among polynomials of the second degree in the velocities {words}"),
            None => "polynomials of the second degree in so many velocities are too many to be searched".into(),
        })
    }

    /// The extension in a family of functions.
    fn extension_in(&self, family: &[Expr]) -> Option<Vec<Expr>> {
        let g = &self.cx.system.graph;
        let n = self.cx.system.n();
        let on = g.substitute_all(family, &self.solved);
        let mut columns: Vec<Vec<Expr>> = Vec::new();
        for s in 0..n {
            for (&everywhere, &there) in family.iter().zip(&on) {
                let mut column = vec![g.zero(); n];
                column[s] = there;
                let own = self.gradients.iter();
                column.extend(own.map(|z| g.mul(&[z[s], everywhere])));
                columns.push(column);
            }
        }
        let mut right: Vec<Expr> = self.forces.iter().map(|&e| g.neg(e)).collect();
        right.extend(&self.free);
        columns.push(right);
        let seed = self.cx.prover.points_seed();
        let none = Manifold::default();
        let ansatz = Ansatz::new(&self.motion, &columns, &none, &[], seed).ok()?;
        let found = ansatz.with_last()?;
        let (&last, rest) = found.split_last()?;
        let extension = (0..n).map(|s| {
            let own = rest[s * family.len()..(s + 1) * family.len()].iter();
            let parts: Vec<Expr> = own
                .zip(family)
                .filter(|(c, _)| !g.is_zero(**c))
                .map(|(&c, &f)| g.mul(&[g.div(c, last), f]))
                .collect();
            readable(g, g.add(&parts))
        });
        Some(extension.collect())
    }

    /// What makes an extension one for which Z is a symmetry.
    fn verdict(&self, symbol: Symbol, extension: &[Expr]) -> Verdict {
        let (system, g) = (self.cx.system, &self.cx.system.graph);
        let none = Manifold::default();
        let mut residuals: Vec<Expr> = self
            .gradients
            .iter()
            .zip(&self.free)
            .map(|(z, &free)| {
                let own = z.iter().zip(extension);
                let mut parts: Vec<Expr> = own.map(|(&z, &e)| g.mul(&[z, e])).collect();
                parts.push(free);
                g.add(&parts)
            })
            .collect();
        let there = g.substitute_all(extension, &self.solved);
        let pairs = there.iter().zip(&self.forces);
        residuals.extend(pairs.map(|(&a, &b)| g.sub(a, b)));
        residuals.extend(extension.iter().map(|&e| g.diff(e, symbol)));
        residuals.push(g.diff(system.lagrangian, symbol));
        let on = "at all states";
        self.cx.prover.identity(system, &residuals, &none, on)
    }
}

/// Searches the coordinates of [`candidates`].
///
/// # Errors
/// A sentence that says why the search could not be made.
pub fn symmetries(cx: &Context<'_>) -> Result<Vec<Symmetry>, String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut found = Vec::new();
    let candidates: Vec<usize> = candidates(cx);
    if candidates.is_empty() {
        return Ok(found);
    }
    let setting = Setting::of(cx)?;
    for coordinate in candidates {
        let symbol = system.coordinates[coordinate].q_symbol;
        let extension = setting.extension(symbol).map(|extension| {
            let verdict = setting.verdict(symbol, &extension);
            (extension, verdict)
        });
        let integrals: Vec<(String, Expr)> = setting
            .rows
            .iter()
            .map(|&l| {
                let constraint = &system.constraints[cx.terms.constraint_index[l]];
                let along = g.diff(cx.terms.constraints[l], symbol);
                (constraint.name.clone(), along)
            })
            .filter(|(_, e)| !vanishes(cx, *e))
            .collect();
        found.push(Symmetry {
            coordinate,
            integrals,
            extension,
        });
    }
    Ok(found)
}

/// Whether a function vanishes on the constraints: multiples of f are no integrals.
fn vanishes(cx: &Context<'_>, e: Expr) -> bool {
    let verdict = cx.prover.identity(cx.system, &[e], &manifold(cx), "");
    matches!(verdict, Verdict::Proved(_))
}

/// Coordinates that L and the forces do not contain, and some constraint does, so that its derivative is no constant: that would be
/// an integral of every motion.
pub fn candidates(cx: &Context<'_>) -> Vec<usize> {
    let (system, g) = (cx.system, &cx.system.graph);
    let is_absent = |s: Symbol| {
        !g.contains_any(system.lagrangian, &[s]) && !g.any_contains_any(&system.forces, &[s])
    };
    let own = cx.selection.rows.iter();
    let constraints: Vec<Expr> = own.map(|&l| cx.terms.constraints[l]).collect();
    let moves = |s: Symbol| g.symbol_name(s) == "t" || system.moves(g.symbol_name(s));
    (0..system.n())
        .filter(|&i| {
            let s = system.coordinates[i].q_symbol;
            let slopes = constraints.iter().map(|&f| g.diff(f, s));
            let mut slopes = slopes.filter(|slope| !g.is_free_of(*slope, &moves));
            is_absent(s) && slopes.any(|slope| !vanishes(cx, slope))
        })
        .collect()
}
