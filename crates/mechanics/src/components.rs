//! Components of constraints that are products: `(z' - x') (y' - 1) = 0` holds where one of the factors vanishes.
//!
//! A chart that gives a dependent velocity by the others covers the components in whose factor that velocity occurs; where
//! another factor vanishes, the equation says nothing of it.

mod distinct;
mod together;

pub use self::distinct::{distinct, of_start};

use self::together::{covered_by_choice, on_affine};
use crate::constraint::{Constraint, ConstraintKind};
use crate::prover::assumptions;
use crate::selection::Selection;
use crate::system::{Assumption, Relation, System};
use crate::terms::MotionTerms;
use chetaev_symbolic::factors::{factored, irreducible_factors};
use chetaev_symbolic::one_to_one::innermost;
use chetaev_symbolic::real_factors::{real_factors, RealFactors};
use chetaev_symbolic::zero::assumptions::{Assumptions, SignSet};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Function, Graph, Node, Rational, Symbol};

/// The factors of a constraint function in which velocities of the highest order occur, where there are several.
pub(crate) fn factors_of(system: &System, terms: &MotionTerms, row: usize) -> Vec<Expr> {
    let velocities: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    let g = &system.graph;
    let gradient = &terms.jacobian[row];
    // What is affine in them has one such factor.
    if !g.any_contains_any(gradient, &velocities) {
        return Vec::new();
    }
    several(irreducible_factors(g, terms.constraints[row], &velocities))
}

/// Factors where there is more than one.
fn several(list: Option<Vec<(Expr, u32)>>) -> Vec<Expr> {
    let list = list.unwrap_or_default();
    match list.len() {
        0 | 1 => Vec::new(),
        _ => list.into_iter().map(|(factor, _)| factor).collect(),
    }
}

/// The components that the independent velocities of a selection describe, as equations, where they leave others out:
/// `y' = z' + x` of `(y' - z' - x) z' = 0` solved for y'.
pub fn covered(system: &System, terms: &MotionTerms, selection: &Selection) -> Option<String> {
    let g = &system.graph;
    let rows = || selection.rows.iter().zip(&selection.dependent);
    let velocities: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    let affine = rows().filter(|(&row, _)| !g.any_contains_any(&terms.jacobian[row], &velocities));
    let (affine, solved): (Vec<Expr>, Vec<Symbol>) = affine
        .filter_map(|(&row, &j)| Some((terms.constraints[row], terms.jets.get(j)?.v_symbol)))
        .unzip();
    let covered: Vec<String> = rows()
        .filter_map(|(&row, &dependent)| {
            if affine.contains(&terms.constraints[row]) {
                return None;
            }
            let all = match on_affine(g, terms.constraints[row], &affine, &solved) {
                Some(f) => several(irreducible_factors(g, f, &velocities)),
                None => factors_of(system, terms, row),
            };
            let own = terms.jets.get(dependent)?.v_symbol;
            let with = all.iter().filter(|&&f| g.contains_any(f, &[own]));
            let with: Vec<String> = with.map(|&f| format!("{} = 0", g.text(f))).collect();
            (!with.is_empty() && with.len() < all.len()).then(|| with.join(" or "))
        })
        .collect();
    match covered.is_empty() {
        true => covered_by_choice(system, terms, selection),
        false => Some(covered.join(", ")),
    }
}

/// A part of the states of a system, as a system of its own: a component of constraints that are products, or functions of simpler ones,
/// or a side of their corners.
#[derive(Clone, Debug)]
pub struct Stratum {
    /// The system with each such constraint replaced by the factor chosen, or written without corners.
    pub system: System,
    /// What was replaced, in words.
    pub sentence: String,
    /// The equations of the component or signs of the side, where there are others.
    pub condition: Option<String>,
    /// The factors that were chosen: they vanish on the component.
    pub equations: Vec<Expr>,
}

/// More components are not looked at one by one.
const COMPONENTS: usize = 8;

/// A constraint for which there are simpler functions, one of which vanishes where it does.
struct Simpler {
    row: usize,
    /// On each component one.
    equations: Vec<Expr>,
    /// Where they vanish with it.
    assumptions: Vec<Assumption>,
}

/// A function at whose zeros constraints have a corner.
struct Corner {
    inside: Expr,
    /// What is a whole power of its absolute value; the power 0 stands for its sign.
    written: Vec<(Expr, i64)>,
}

/// What an expression is the sign or a power of the absolute value of.
fn corner(g: &Graph, e: Expr) -> Option<(Expr, i64)> {
    match g.node(e) {
        Node::Apply {
            function: Function::Abs,
            arguments,
        } => Some((arguments[0], 1)),
        Node::Apply {
            function: Function::Sign,
            arguments,
        } => Some((arguments[0], 0)),
        Node::Power { base, exponent } if g.as_integer(*exponent).is_none() => {
            let (inside, square) = g.base_exponent(*base);
            let (inside, square) = match g.as_integer(square) {
                Some(n) if n % 2 == 0 => (inside, square),
                _ => (root_of_square(g, *base)?, g.integer(2)),
            };
            let power = g.as_integer(g.mul(&[square, *exponent]))?;
            (power != 0).then_some((inside, power))
        }
        _ => None,
    }
}

/// What a sum is the square of, as `x - 1` of `x² - 2 x + 1`.
fn root_of_square(g: &Graph, base: Expr) -> Option<Expr> {
    if !matches!(g.node(base), Node::Sum { .. }) {
        return None;
    }
    let parts = factored(g, base)?;
    let root = rational::exact_root(&parts.coefficient, 2)?;
    let is_square = parts.factors.iter().all(|(_, n)| n % 2 == 0);
    let halves = parts.factors.iter().map(|&(f, n)| g.powi(f, n / 2));
    is_square.then(|| g.scale(&root, g.mul(&halves.collect::<Vec<Expr>>())))
}

impl System {
    /// The systems on all components of constraints nonlinear in the velocities that are products, `z'² = y² x'²`, each with a choice of factors.
    /// Constraints `F(u) = c` and `F(u) = F(w)` with a function F that takes no value twice, `exp(z' − y x') = 1`, are `u = F⁻¹(c)` and
    /// `u = w`. None where there are no such constraints, or too many.
    ///
    /// What is said of motions depends on the set of admissible states, not on the function that vanishes on it, as long as its
    /// gradient does not vanish there; on the factor it is the gradient of the product but for a multiplier.
    pub fn components(&self) -> Vec<Stratum> {
        let list = self.simpler();
        let many = list
            .iter()
            .map(|own| own.equations.len())
            .product::<usize>();
        if list.is_empty() || many > COMPONENTS {
            return Vec::new();
        }
        let places = |number: usize| -> Vec<usize> {
            let mut rest = number;
            let digits = list.iter().map(|own| {
                let digit = rest % own.equations.len();
                rest /= own.equations.len();
                digit
            });
            digits.collect()
        };
        let found = (0..many).map(|number| self.with_equations(&list, &places(number)));
        found.collect::<Option<Vec<_>>>().unwrap_or_default()
    }

    /// The systems on all sides of the corners of constraints, where an absolute value or a sign is written without it:
    /// for `abs(x') = y'` those with x' = y' and x' > 0, and with -x' = y' and x' < 0; for `z' = abs(y) x'` those with y > 0 and with
    /// y < 0. Sides that the assumptions exclude are left out. None where there are no corners, or too many.
    pub fn sides(&self) -> Vec<Stratum> {
        self.sides_of(&self.corners())
    }

    /// As [`sides`](System::sides), with the corners of functions of the place that constraints keep at their values too.
    pub fn all_sides(&self) -> Vec<Stratum> {
        let constraints = self.constraints.iter();
        let all = constraints.flat_map(|c| [c.f, c.stated]);
        self.sides_of(&self.all_corners(&all.collect::<Vec<Expr>>()))
    }

    fn sides_of(&self, corners: &[Corner]) -> Vec<Stratum> {
        if corners.is_empty() || 1 << corners.len() > COMPONENTS {
            return Vec::new();
        }
        let stated = assumptions(self);
        let signs_known = corners
            .iter()
            .map(|c| known_sign(&self.graph, c.inside, &stated));
        let known: Vec<_> = signs_known.collect();
        let all = 0..1_usize << corners.len();
        let found = all.filter_map(|number| {
            let signs: Vec<bool> = (0..corners.len()).map(|i| number >> i & 1 == 0).collect();
            let is_excluded = |(&is_positive, sign): (&bool, &SignSet)| match is_positive {
                true => sign.is_nonpositive(),
                false => sign.is_nonnegative(),
            };
            let is_empty = signs.iter().zip(&known).any(is_excluded);
            let pairs = || {
                corners
                    .iter()
                    .zip(signs.iter().copied())
                    .collect::<Vec<_>>()
            };
            (!is_empty).then(|| self.with_signs(&pairs()))
        });
        found.collect::<Option<Vec<_>>>().unwrap_or_default()
    }

    /// At the zeros of which functions some expressions have a corner, in velocities or in the place: absolute values, signs, and
    /// roots of squares. What the assumptions keep from zero is not among them.
    pub fn corners_of(&self, es: &[Expr]) -> Vec<Expr> {
        let stated = assumptions(self);
        let own = self.all_corners(es).into_iter().map(|c| c.inside);
        own.filter(|&e| !known_sign(&self.graph, e, &stated).is_nonzero())
            .collect()
    }

    /// The corners of the constraints; a function of the place that one keeps at its value is kept over its corners.
    fn corners(&self) -> Vec<Corner> {
        let constraints = self.constraints.iter();
        let on_velocities = constraints.filter(|c| c.kind != ConstraintKind::Holonomic);
        self.all_corners(&on_velocities.map(|c| c.f).collect::<Vec<Expr>>())
    }

    fn all_corners(&self, es: &[Expr]) -> Vec<Corner> {
        let g = &self.graph;
        let moves = |s: Symbol| self.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
        let mut found: Vec<Corner> = Vec::new();
        for e in g.reachable(es) {
            let Some((inside, power)) = corner(g, e) else {
                continue;
            };
            if g.is_free_of(inside, &moves) {
                continue;
            }
            match found.iter_mut().find(|own| own.inside == inside) {
                Some(own) => own.written.push((e, power)),
                None => found.push(Corner {
                    inside,
                    written: vec![(e, power)],
                }),
            }
        }
        found
    }

    /// The system where the insides of corners are positive, or negative.
    fn with_signs(&self, signs: &[(&Corner, bool)]) -> Option<Stratum> {
        let (g, mut system) = (&self.graph, self.clone());
        let mut pairs = Vec::new();
        for &(corner, is_positive) in signs {
            let inside = corner.inside;
            let own = if is_positive { inside } else { g.neg(inside) };
            for &(e, power) in &corner.written {
                pairs.push((
                    e,
                    match power {
                        0 if is_positive => g.one(),
                        0 => g.neg(g.one()),
                        _ => g.powi(own, power),
                    },
                ));
            }
        }
        // The inside of a corner may contain another one.
        let smooth = |e: Expr| signs.iter().fold(e, |e, _| g.substitute(e, &pairs));
        let mut conditions = Vec::new();
        for &(corner, is_positive) in signs {
            let inside = smooth(corner.inside);
            let own = if is_positive { inside } else { g.neg(inside) };
            let own = assumption(g, g.zero(), Relation::Less, own);
            system.assumptions.push(own);
            let relation = if is_positive { ">" } else { "<" };
            conditions.push(format!("{} {relation} 0", g.text(inside)));
        }
        for constraint in &mut system.constraints {
            let name = constraint.name.clone();
            *constraint = Constraint::classify(self, name, smooth(constraint.stated)).ok()?;
        }
        let condition = conditions.join(" and ");
        Some(Stratum {
            system,
            sentence: format!("where {condition}"),
            condition: Some(condition),
            equations: Vec::new(),
        })
    }

    /// The constraints nonlinear in the velocities for which there are simpler functions, and holonomic ones that are products.
    fn simpler(&self) -> Vec<Simpler> {
        let (g, known) = (&self.graph, assumptions(self));
        let mut found = Vec::new();
        for (row, constraint) in self.constraints.iter().enumerate() {
            if constraint.kind == ConstraintKind::Holonomic {
                let equations = self.factors_of_position(constraint);
                if equations.len() > 1 {
                    found.push(Simpler {
                        row,
                        equations,
                        assumptions: Vec::new(),
                    });
                }
                continue;
            }
            if constraint.kind != ConstraintKind::Nonlinear {
                continue;
            }
            let simple = unwrapped(g, constraint.f, &self.velocity_symbols());
            let mut real = real_factors(g, simple.function, &self.velocity_symbols(), &known);
            if real.factors.len() < 2 {
                let on_others = self.factors_on_affine(simple.function, &known);
                real = on_others.unwrap_or(real);
            }
            let same = simple.function == constraint.f;
            let equations = match real.factors.len() {
                0 if same => continue,
                0 => vec![simple.function],
                _ => real.factors,
            };
            // A denominator that is cleared makes nothing simpler where f stays nonlinear.
            if same && equations.len() == 1 && !self.is_affine(constraint, equations[0]) {
                continue;
            }
            let unequal = real.denominators.into_iter();
            let unequal = unequal.map(|e| assumption(g, e, Relation::NotEqual, g.zero()));
            found.push(Simpler {
                row,
                equations,
                assumptions: simple.assumptions.into_iter().chain(unequal).collect(),
            });
        }
        found
    }

    /// The factors of a function that is a product on the constraints affine in the velocities.
    fn factors_on_affine(&self, f: Expr, known: &Assumptions) -> Option<RealFactors> {
        let (g, velocities) = (&self.graph, self.velocity_symbols());
        let first_order = |c: &Constraint| c.kind != ConstraintKind::HigherOrder;
        if !self.constraints.iter().all(first_order) {
            return None;
        }
        let affine = self.constraints.iter();
        let affine = affine.filter(|c| c.is_affine_in_velocities());
        let affine: Vec<Expr> = affine.map(|c| c.f).collect();
        let f = on_affine(g, f, &affine, &velocities)?;
        let real = real_factors(g, f, &velocities, known);
        (real.factors.len() > 1).then_some(real)
    }

    /// The factors of a holonomic constraint that may vanish: `x y = 0` holds on two components, `x y = 1` on others of which no product
    /// says anything.
    fn factors_of_position(&self, constraint: &Constraint) -> Vec<Expr> {
        let (g, known) = (&self.graph, assumptions(self));
        let factors = irreducible_factors(g, constraint.stated, &self.coordinate_symbols());
        let all = factors.unwrap_or_default().into_iter().map(|(e, _)| e);
        all.filter(|&e| !known_sign(g, e, &known).is_nonzero())
            .collect()
    }

    /// Whether a holonomic constraint is a product, so that integrals of the motions that its derivative allows say nothing of it.
    pub fn has_positions_apart(&self) -> bool {
        let holonomic = |c: &&Constraint| c.kind == ConstraintKind::Holonomic;
        let mut all = self.constraints.iter().filter(holonomic);
        all.any(|c| self.factors_of_position(c).len() > 1)
    }

    /// The constraints that may hold on several components, quoted: nonlinear ones, and holonomic ones that are products.
    pub fn constraints_apart(&self) -> String {
        let may_be_apart = |c: &&Constraint| match c.kind {
            ConstraintKind::Nonlinear => true,
            ConstraintKind::Holonomic => self.factors_of_position(c).len() > 1,
            _ => false,
        };
        let names = self.constraints.iter().filter(may_be_apart);
        let names: Vec<String> = names.map(|c| format!("`{}`", c.name)).collect();
        names.join(" or ")
    }

    /// Whether another function in the place of a constraint's is affine in the velocities.
    fn is_affine(&self, constraint: &Constraint, f: Expr) -> bool {
        let own = Constraint::classify(self, constraint.name.clone(), f);
        own.is_ok_and(|own| own.kind != ConstraintKind::Nonlinear)
    }

    /// The system with one of the simpler functions in the place of each such constraint.
    fn with_equations(&self, list: &[Simpler], places: &[usize]) -> Option<Stratum> {
        let g = &self.graph;
        let (mut system, mut sentences, mut conditions) = (self.clone(), Vec::new(), Vec::new());
        let mut chosen = Vec::new();
        for (simpler, &place) in list.iter().zip(places) {
            let factor = simpler.equations[place];
            let name = self.constraints[simpler.row].name.clone();
            let Ok(own) = Constraint::classify(self, name.clone(), factor) else {
                continue;
            };
            let text = format!("{} = 0", g.text(factor));
            let mut sentence = match simpler.equations.len() {
                1 => format!("with `{name}` written as {text}"),
                _ => format!("on the component {text} of `{name}`"),
            };
            if !simpler.assumptions.is_empty() {
                let texts = simpler.assumptions.iter().map(|a| a.text.as_str());
                let texts: Vec<&str> = texts.collect();
                sentence.push_str(&format!(" where {}", texts.join(" and ")));
            }
            sentences.push(sentence);
            system.assumptions.extend(simpler.assumptions.clone());
            system.constraints[simpler.row] = own;
            if simpler.equations.len() > 1 && !conditions.contains(&text) {
                conditions.push(text);
                chosen.push(factor);
            }
        }
        (!sentences.is_empty()).then(|| Stratum {
            system,
            sentence: sentences.join(" and "),
            condition: (!conditions.is_empty()).then(|| conditions.join(" and ")),
            equations: chosen,
        })
    }
}

/// `left REL right` as an assumption.
fn assumption(g: &Graph, left: Expr, relation: Relation, right: Expr) -> Assumption {
    let sign = match relation {
        Relation::Less => "<",
        Relation::LessOrEqual => "≤",
        Relation::NotEqual => "≠",
    };
    Assumption {
        left,
        relation,
        right,
        text: format!("{} {sign} {}", g.text(left), g.text(right)),
    }
}

/// A function that vanishes where another does, with what holds there besides.
struct Unwrapped {
    function: Expr,
    assumptions: Vec<Assumption>,
}

/// A function that vanishes where another does and its gradient does not: arguments of functions that take no value twice.
fn unwrapped(g: &Graph, f: Expr, velocities: &[Symbol]) -> Unwrapped {
    let e = innermost(g, f);
    let simple = by_logarithms(g, e, velocities);
    let simple = simple.or_else(|| solved_for_argument(g, e, velocities));
    simple.unwrap_or(Unwrapped {
        function: e,
        assumptions: Vec::new(),
    })
}

/// `Π u^n − exp(−w)` of `Σ n log u + w`, for whole n and w free of velocities, with the factors of negative powers on the other side,
/// where every u is positive: `z' − x' y` of `log z' − log x' − log y`.
fn by_logarithms(g: &Graph, e: Expr, velocities: &[Symbol]) -> Option<Unwrapped> {
    let Node::Sum { constant, terms } = g.node(e) else {
        return None;
    };
    let (constant, terms) = (constant.clone(), terms.to_vec());
    let logarithm = |term: Expr| match g.node(term) {
        Node::Apply {
            function: Function::Log,
            arguments,
        } => Some(arguments[0]),
        _ => None,
    };
    let all = terms.iter().map(|(term, c)| (logarithm(*term), *term, c));
    let (logarithms, others): (Vec<_>, Vec<_>) = all.partition(|(u, ..)| u.is_some());
    let moves = |(_, term, _): &(Option<Expr>, Expr, &Rational)| g.contains_any(*term, velocities);
    if logarithms.iter().filter(|l| moves(l)).count() < 2 || others.iter().any(moves) {
        return None;
    }
    let one = Rational::from(1);
    let multiple = logarithms.iter().fold(one, |multiple, &(_, _, c)| {
        let over = (multiple.clone() * c.clone()).denominator().clone();
        multiple * Rational::from(over)
    });
    let (mut sides, mut assumptions) = ([Vec::new(), Vec::new()], Vec::new());
    for (u, _, c) in logarithms {
        let (u, power) = (u?, multiple.clone() * c.clone());
        let is_below = power < Rational::from(0);
        let power = if is_below { -power } else { power };
        sides[usize::from(is_below)].push(g.pow(u, g.scale(&power, g.one())));
        assumptions.push(assumption(g, g.zero(), Relation::Less, u));
    }
    let mut rest: Vec<Expr> = others
        .iter()
        .map(|(_, term, c)| g.scale(c, *term))
        .collect();
    rest.push(g.scale(&constant, g.one()));
    let w = g.scale(&-multiple, g.add(&rest));
    sides[1].push(g.apply(Function::Exp, &[w]));
    Some(Unwrapped {
        function: g.sub(g.mul(&sides[0]), g.mul(&sides[1])),
        assumptions,
    })
}

/// `u − F⁻¹(w)` of `F(u) − w`, for w free of velocities: `a cos w − b sin w` of `atan2(a, b) − w` with `−π < w < π` and `b cos w + a sin w > 0`,
/// `u cos w − sin w` of `atan u − w` with `|w| < π/2`.
fn solved_for_argument(g: &Graph, e: Expr, velocities: &[Symbol]) -> Option<Unwrapped> {
    let Node::Sum { constant, terms } = g.node(e) else {
        return None;
    };
    let (constant, terms) = (constant.clone(), terms.to_vec());
    let place = terms
        .iter()
        .position(|(term, _)| g.contains_any(*term, velocities))?;
    let (term, weight) = terms[place].clone();
    let others = terms.iter().enumerate().filter(|(i, _)| *i != place);
    let mut parts: Vec<Expr> = others.map(|(_, (e, c))| g.scale(c, *e)).collect();
    parts.push(g.scale(&constant, g.one()));
    let w = g.scale(&(-Rational::from(1) / weight), g.add(&parts));
    if g.contains_any(w, velocities) {
        return None;
    }
    let Node::Apply {
        function,
        arguments,
    } = g.node(term)
    else {
        return None;
    };
    let (sin, cos) = (g.sin(w), g.cos(w));
    let less = |a: Expr, b: Expr| assumption(g, a, Relation::Less, b);
    let within = |bound: Expr| vec![less(g.neg(bound), w), less(w, bound)];
    let half_turn = || g.div(g.pi(), g.integer(2));
    let by = |inverse: Function, u: Expr| g.sub(u, g.apply(inverse, &[w]));
    let (function, assumptions) = match (function, arguments.as_ref()) {
        (Function::Atan2, &[a, b]) => {
            let along = g.add(&[g.mul(&[b, cos]), g.mul(&[a, sin])]);
            let mut assumptions = within(g.pi());
            assumptions.push(less(g.zero(), along));
            (g.sub(g.mul(&[a, cos]), g.mul(&[b, sin])), assumptions)
        }
        (Function::Atan, &[u]) => (g.sub(g.mul(&[u, cos]), sin), within(half_turn())),
        (Function::Asin, &[u]) => (g.sub(u, sin), within(half_turn())),
        (Function::Exp, &[u]) => (by(Function::Log, u), vec![less(g.zero(), w)]),
        (Function::Log, &[u]) => (by(Function::Exp, u), Vec::new()),
        (Function::Sinh, &[u]) => (by(Function::Asinh, u), Vec::new()),
        (Function::Asinh, &[u]) => (by(Function::Sinh, u), Vec::new()),
        (Function::Tanh, &[u]) => (by(Function::Atanh, u), within(g.one())),
        (Function::Atanh, &[u]) => (by(Function::Tanh, u), Vec::new()),
        _ => return None,
    };
    Some(Unwrapped {
        function,
        assumptions,
    })
}
