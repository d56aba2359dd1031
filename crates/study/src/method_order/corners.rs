//! Places where a motion crosses a corner or a jump of its equations of motion.

use chetaev_mechanics::{MotionTerms, System};
use chetaev_motion::observe::Observer;
use chetaev_motion::{Binding, Run};
use chetaev_symbolic::{Expr, Function, Graph, Node};

/// A crossing of a corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// What is not smooth there, as printed.
    pub text: String,
    /// Time of the crossing, to the accuracy of the rows.
    pub t: f64,
}

/// A function that is smooth except where `argument` vanishes, for atan2 except where `side` is negative there too.
struct Bend {
    text: String,
    argument: Expr,
    side: Option<Expr>,
}

/// The first place along the rows where the argument of an absolute value or a sign in the equations changes sign, or an
/// angle crosses its branch cut.
pub(crate) fn first(
    system: &System,
    terms: &MotionTerms,
    binding: &Binding,
    run: &Run,
) -> Option<Corner> {
    let g = &system.graph;
    let bends = bends(g, terms, binding);
    let mut expressions: Vec<Expr> = bends.iter().map(|b| b.argument).collect();
    expressions.extend(bends.iter().map(|b| b.side.unwrap_or(g.integer(-1))));
    if bends.is_empty() {
        return None;
    }
    let mut observer = Observer::new(system, terms, binding, &expressions).ok()?;
    let series = observer.along(run);
    let (arguments, sides) = series.split_at(bends.len());
    let mut found: Option<Corner> = None;
    for (bend, (values, side)) in bends.iter().zip(arguments.iter().zip(sides)) {
        let Some(j) = crossing(values, side) else {
            continue;
        };
        let part = values[j] / (values[j] - values[j + 1]);
        let t = run.times[j] + part * (run.times[j + 1] - run.times[j]);
        let earlier = |c: &Corner| (t - c.t) * (run.t - run.times[0]) < 0.0;
        if found.as_ref().is_none_or(earlier) {
            found = Some(Corner {
                text: bend.text.clone(),
                t,
            });
        }
    }
    found
}

/// The first row after which the value has the opposite sign.
fn crossing(values: &[f64], side: &[f64]) -> Option<usize> {
    (0..values.len().saturating_sub(1))
        .find(|&j| values[j] * values[j + 1] < 0.0 && side[j] < 0.0 && side[j + 1] < 0.0)
}

fn bends(g: &Graph, terms: &MotionTerms, binding: &Binding) -> Vec<Bend> {
    let mut roots = terms.mass_matrix.concat();
    roots.extend(terms.jacobian.concat());
    roots.extend(&terms.force);
    roots.extend(&terms.constraint_rate);
    let roots = g.substitute_all(&roots, &binding.controls);
    let mut bends = Vec::new();
    for e in g.reachable(&roots) {
        let Node::Apply {
            function,
            arguments,
        } = g.node(e)
        else {
            continue;
        };
        let (argument, side) = match (function, &**arguments) {
            (Function::Abs | Function::Sign, [x]) => (*x, None),
            (Function::Atan2, [y, x]) => (*y, Some(*x)),
            _ => continue,
        };
        bends.push(Bend {
            text: g.text(e),
            argument,
            side,
        });
    }
    bends
}
