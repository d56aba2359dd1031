//! States at which the highest derivatives are those of the motion.

use super::{least_norm_step, values, Generator, Point};
use crate::equations::unused_name;
use crate::linear::dot;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::{Expr, Symbol};

/// Starts of Newton's method, and its steps from each.
const STARTS: usize = 8;
const STEPS: usize = 60;

/// The state of a point with accelerations that constraints nonlinear in them and the equations of motion, `W a − b = Σ λ ∂f/∂a`, give:
/// there ∂f/∂a has the direction of what the reactions must bring about, and entries that vanish on every motion although they do not
/// at other admissible accelerations. `None` for other constraints, and where none were found.
pub fn on_motion(system: &System, terms: &MotionTerms, point: &Point) -> Option<Point> {
    if terms.order != 2 || terms.affine.iter().all(|&affine| affine) {
        return None;
    }
    let g = &system.graph;
    let reactions: Vec<Symbol> = (0..terms.constraints.len())
        .map(|l| g.intern_symbol(&unused_name(system, &format!("reaction_{l}")), 0))
        .collect();
    let accelerations: Vec<Expr> = terms.jets.iter().map(|c| c.v).collect();
    let lambda: Vec<Expr> = reactions.iter().map(|&s| g.symbol_expr(s)).collect();
    let balance = |i: usize| {
        let reaction = dot(g, &lambda, terms.jacobian.iter().map(|row| &row[i]));
        let left = dot(g, &terms.mass_matrix[i], &accelerations);
        g.sub(g.sub(left, terms.force[i]), reaction)
    };
    let mut equations: Vec<Expr> = (0..system.n()).map(balance).collect();
    equations.extend(&terms.constraints);
    let mut unknowns: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    unknowns.extend(reactions);
    let all = [
        equations.clone(),
        g.jacobian(&equations, &unknowns).concat(),
    ]
    .concat();
    let mut generator = Generator::new(0x6d07_1043);
    (0..STARTS).find_map(|_| {
        let mut point = point.clone();
        for &s in &unknowns {
            point.insert(s, generator.between(-2.0, 2.0));
        }
        for _ in 0..STEPS {
            let found = values(system, &all, &point)?;
            let (f, jacobian) = found.split_at(equations.len());
            if f.iter().all(|x| x.abs() < 1e-11) {
                return Some(point);
            }
            let step = least_norm_step(jacobian, f, unknowns.len());
            for (s, dx) in unknowns.iter().zip(step) {
                point.entry(*s).and_modify(|x| *x -= dx);
            }
        }
        None
    })
}
