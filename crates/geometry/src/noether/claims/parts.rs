//! The parts of the states on which further equations hold, solved for as many symbols as possible.
//!
//! The formulas by which independent velocities give the others on all of the constraints may be undefined on a part, as
//! `y' = x' tan(phi)` at `phi = pi/2`; there the constraints themselves are solved anew, after what the part prescribes.

use crate::noether::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::{prover, Manifold};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};

/// Where the equations hold and the gradients of the constraints do not vanish.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    /// The factors of products that vanish on it, as equations; none where there are no products.
    pub(super) chosen: Vec<String>,
    /// Symbols solved for, and equations that stay implicit.
    pub(super) manifold: Manifold,
}

/// More parts than this are not looked at.
const MOST: usize = 16;

/// The parts of the states that satisfy the constraints, the holonomic ones themselves too, and the `conditions`; none where no
/// admissible state does. `resolved` replaces parameters that the model defines by others.
///
/// # Errors
/// A sentence that says why they are not known.
pub(super) fn parts(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    conditions: &[Expr],
    resolved: &dyn Fn(Expr) -> Expr,
) -> Result<Vec<Part>, String> {
    let system = cx.system;
    let mut equations = conditions.to_vec();
    equations.extend(system.fixed_functions());
    equations.extend(&cx.terms.constraints);
    let parting = Parting { cx, motion };
    let mut found = Vec::new();
    let mut open = vec![(
        Part::default(),
        equations.into_iter().map(resolved).collect(),
    )];
    while let Some((part, equations)) = open.pop() {
        if found.len() + open.len() > MOST {
            return Err(format!("there are more than {MOST} parts"));
        }
        match parting.step(part, equations)? {
            Step::Done(part) if parting.is_regular(&part) => found.push(part),
            Step::Done(_) => {}
            Step::Open(next) => open.extend(next.into_iter().rev()),
        }
    }
    Ok(found)
}

/// What it costs at least to divide by what may vanish.
const DIVIDING: usize = 2000;

/// What one equation more brings.
enum Step {
    Done(Part),
    Open(Vec<(Part, Vec<Expr>)>),
}

struct Parting<'p, 'a> {
    cx: &'p Context<'a>,
    motion: &'p Motion<'a>,
}

impl Parting<'_, '_> {
    fn graph(&self) -> &Graph {
        &self.cx.system.graph
    }

    /// Solves the first equation that is left.
    fn step(&self, part: Part, mut equations: Vec<Expr>) -> Result<Step, String> {
        if let Some(&e) = equations.iter().find(|&&e| self.is_undefined(e)) {
            return Err(format!("{} is not defined there", self.graph().text(e)));
        }
        equations.retain(|&e| !self.vanishes(e, &part));
        if equations.iter().any(|&e| self.vanishes_nowhere(e)) {
            return Ok(Step::Open(Vec::new()));
        }
        if equations.is_empty() {
            return Ok(Step::Done(part));
        }
        let moving = |e: Expr| -> Vec<Symbol> {
            let mut symbols = self.graph().symbols_in(&[e]);
            symbols.retain(|&s| self.motion.moves(s) && self.graph().symbol_name(s) != "t");
            symbols
        };
        if let Some(&fixed) = equations.iter().find(|&&e| moving(e).is_empty()) {
            // An equation of the time and parameters, which does not hold.
            return match self.graph().as_number(fixed) {
                Some(_) => Ok(Step::Open(Vec::new())),
                None => Err(format!(
                    "the equations demand {} = 0",
                    self.graph().text(fixed)
                )),
            };
        }
        // What gives a symbol by itself first; it makes the others shorter. Then products: one of their factors may be that by which
        // another equation would have to be divided.
        let rank = |e: Expr| moving(e).into_iter().filter_map(|s| self.cost(e, s)).min();
        let costs = equations.iter().map(|&e| rank(e).unwrap_or(usize::MAX));
        let least = costs.enumerate().min_by_key(|&(i, cost)| (cost, i));
        let place = match least {
            Some((place, cost)) if cost < DIVIDING => place,
            least => {
                let is_product = |&e: &Expr| self.several(e, &moving(e)).is_some();
                let product = equations.iter().position(is_product);
                product.or(least.map(|(place, _)| place)).unwrap_or(0)
            }
        };
        let equation = equations.remove(place);
        let symbols = moving(equation);
        if let Some(several) = self.several(equation, &symbols) {
            let next = several.into_iter().map(|factor| {
                let mut part = part.clone();
                part.chosen
                    .push(format!("{} = 0", self.graph().text(factor)));
                let mut rest = vec![factor];
                rest.extend(&equations);
                (part, rest)
            });
            return Ok(Step::Open(next.collect()));
        }
        Ok(Step::Open(vec![
            self.solved(part, equation, &symbols, equations)
        ]))
    }

    /// The factors of a product.
    fn several(&self, equation: Expr, symbols: &[Symbol]) -> Option<Vec<Expr>> {
        let several = factors(self.graph(), equation, symbols).unwrap_or_default();
        (several.len() > 1).then(|| several.into_iter().map(|(factor, _)| factor).collect())
    }

    /// What it costs to solve for a symbol in which the equation is affine: from [`DIVIDING`] on its slope may vanish.
    fn cost(&self, equation: Expr, symbol: Symbol) -> Option<usize> {
        let g = self.graph();
        let slope = g.diff(equation, symbol);
        if g.contains_any(slope, &[symbol]) || g.is_zero(slope) {
            return None;
        }
        let is_fixed = g.as_number(slope).is_some() || self.vanishes_nowhere(slope);
        let kind = match (is_fixed, g.symbol_order(symbol)) {
            (true, 0) => 0,
            (true, _) => 1,
            (false, 0) => 3,
            (false, _) => 2,
        };
        Some(DIVIDING / 2 * kind + g.reachable(&[equation]).len().min(999))
    }

    /// The part with the equation solved for the symbol that costs least, or kept.
    fn solved(
        &self,
        mut part: Part,
        equation: Expr,
        symbols: &[Symbol],
        rest: Vec<Expr>,
    ) -> (Part, Vec<Expr>) {
        let g = self.graph();
        let costs = symbols.iter();
        let best = costs
            .filter_map(|&s| Some((self.cost(equation, s)?, s)))
            .min();
        let Some((_, symbol)) = best else {
            if let Some(&symbol) = symbols.last() {
                part.manifold.implicit.push((equation, symbol));
            }
            return (part, rest);
        };
        let own = g.symbol_expr(symbol);
        let at_zero = g.substitute(equation, &[(own, g.zero())]);
        let value = g.neg(g.div(at_zero, g.diff(equation, symbol)));
        let by = [(own, value)];
        for (f, _) in &mut part.manifold.implicit {
            *f = g.substitute(*f, &by);
        }
        for (_, e) in &mut part.manifold.solved {
            *e = g.substitute(*e, &by);
        }
        part.manifold.solved.push((symbol, value));
        let rest = rest.into_iter().map(|e| g.substitute(e, &by)).collect();
        (part, rest)
    }

    /// Whether an expression has a pole whatever moves, as `x' tan(phi)` once phi is π/2.
    fn is_undefined(&self, e: Expr) -> bool {
        let g = self.graph();
        let everywhere = Part::default();
        let is_pole =
            |x: Expr| g.is_free_of(x, &|s| self.motion.moves(s)) && self.vanishes(x, &everywhere);
        g.reachable(&[e]).into_iter().any(|e| match g.node(e) {
            Node::Power { base, exponent } => {
                g.as_integer(*exponent).is_some_and(|n| n < 0) && is_pole(*base)
            }
            Node::Apply {
                function,
                arguments,
            } => match (function, &**arguments) {
                (Function::Tan | Function::Sec, &[x]) => is_pole(g.cos(x)),
                (Function::Cot | Function::Csc, &[x]) => is_pole(g.sin(x)),
                (Function::Log, &[x]) => is_pole(x),
                _ => false,
            },
            _ => false,
        })
    }

    /// Whether an equation has no real solution by the signs that its structure allows, as 1 + x² = 0.
    fn vanishes_nowhere(&self, e: Expr) -> bool {
        let assumptions = prover::assumptions(self.cx.system);
        known_sign(self.graph(), e, &assumptions).is_nonzero()
    }

    fn vanishes(&self, e: Expr, part: &Part) -> bool {
        let verdict = self
            .cx
            .prover
            .identity(self.cx.system, &[e], &part.manifold, "");
        matches!(verdict, Verdict::Proved(_))
    }

    /// Whether no gradient of a constraint vanishes on the part: the motion is not determined where one does.
    fn is_regular(&self, part: &Part) -> bool {
        let rows = &self.cx.terms.jacobian;
        rows.iter()
            .all(|row| row.iter().any(|&entry| !self.vanishes(entry, part)))
    }
}
