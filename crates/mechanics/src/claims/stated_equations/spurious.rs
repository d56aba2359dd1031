//! Further solutions of equations that are not linear in the accelerations.

use super::{
    coefficients, null_space, vanish, Counterexample, Expr, OnMotion, Question, Symbol, Verdict,
};
use chetaev_symbolic::simplify::{simplify, Options};

impl Question<'_, '_> {
    /// Whether unknowns other than those of the motion satisfy the equations: those that are linear leave one direction, along
    /// which the one that is not is a polynomial with the motion as a root.
    pub(super) fn other_solutions(
        &self,
        on_motion: &OnMotion,
        columns: &[Symbol],
    ) -> Result<(), Box<Verdict>> {
        let g = &self.system().graph;
        let open = |why: &str| {
            Box::new(Verdict::undecided(format!(
                "the motion satisfies the equations, and no accelerations near it do; whether others do was not decided: {why}"
            )))
        };
        let rows = g.jacobian(&self.equations, columns);
        let is_linear = |row: &Vec<Expr>| !g.any_contains_any(row, columns);
        let linear: Vec<Vec<Expr>> = rows.iter().filter(|row| is_linear(row)).cloned().collect();
        let curved = self
            .equations
            .iter()
            .zip(&rows)
            .filter(|(_, row)| !is_linear(row));
        let curved: Vec<Expr> = curved.map(|(&e, _)| e).collect();
        let others = columns.len() - self.system().n();
        let linear = self.with_constraints(linear, others);
        let kernel = null_space(g, &linear, columns.len())
            .map_err(|_| open("a linear system was not solved"))?;
        let ([direction], [equation]) = (&kernel[..], &curved[..]) else {
            return Err(open("several equations are not linear in the unknowns"));
        };
        let tau = g.symbol("tau_solutions", 0);
        let tau_symbol = g.intern_symbol("tau_solutions", 0);
        let mut motion = self.of_motion(true);
        motion.extend(on_motion.values.iter().copied());
        let along: Vec<(Expr, Expr)> = columns
            .iter()
            .zip(direction)
            .map(|(&u, &w)| {
                (
                    g.symbol_expr(u),
                    g.add(&[g.symbol_expr(u), g.mul(&[tau, w])]),
                )
            })
            .collect();
        let options = Options::default();
        let moved = g.substitute(*equation, &along);
        let Some(polynomial) = coefficients(g, moved, tau_symbol) else {
            return Err(open("an equation is no polynomial in the unknowns"));
        };
        // The constant one is the equation itself, which the motion satisfies.
        let polynomial: Vec<Expr> = polynomial[1..]
            .iter()
            .map(|&e| simplify(g, g.substitute(e, &motion), &options))
            .collect();
        let root = match polynomial[..] {
            [] | [_] => return Ok(()),
            [constant, slope] => g.neg(g.div(constant, slope)),
            [a, b, c] => {
                let square = g.sub(g.powi(b, 2), g.mul(&[g.integer(4), a, c]));
                g.div(g.sub(g.sqrt(square), b), g.mul(&[g.integer(2), c]))
            }
            _ => return Err(open("an equation is of too high a degree in the unknowns")),
        };
        let names = self.system().coordinates.iter().zip(direction);
        let further: Vec<(String, Expr)> = names
            .filter(|(_, w)| !g.is_zero(**w))
            .map(|(c, &w)| {
                (
                    format!("{}'' of another solution minus that of the motion", c.name),
                    g.mul(&[root, w]),
                )
            })
            .collect();
        match vanish(self.cx, &further, &[]) {
            Verdict::Proved(_) => Ok(()),
            Verdict::Refuted(found) => Err(Box::new(Verdict::Refuted(Counterexample {
                detail: format!("too many solutions: the motion satisfies the equations, and so do other accelerations; {}", found.detail),
                ..found
            }))),
            _ => Err(open("the further roots of an equation are perhaps not real")),
        }
    }
}
