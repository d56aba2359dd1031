//! Values of expressions at random points of a prime field, on the constraints: for linear algebra over functions.
//!
//! A *draw* fixes a prime and values of everything that does not move; each of its points has its own values of the rest.
//! Every point is the image of a homomorphism from the ring in which the expressions live, so a linear combination that
//! vanishes there vanishes at every point, and a minor that is not zero at some points is not zero.

use super::assumptions::Assumptions;
use super::eliminate::{eliminate_all, Eliminated};
use super::evaluate::{Parametrization, Point, Run};
use super::modular::bound::{self, Norm};
use super::prepare::{prepare, Question};
use super::program::{Generator, Operation, Program};
use super::ring::Scalars;
use super::size::{Sizes, SLACK};
use super::tower::{Element, Tower};
use super::variety::{Solution, Variety};
use rustc_hash::FxHashMap;

use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use crate::number::modular_polynomial::random_root;
use crate::number::prime::{random_prime, LOG2_PRIME_COUNT};
use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;

/// What is to be evaluated.
#[derive(Clone, Copy)]
pub struct PointsOf<'a> {
    /// The expressions.
    pub outputs: &'a [Expr],
    /// Symbols determined exactly; see [`ZeroTest::solved`](super::ZeroTest::solved).
    pub solved: &'a [(Symbol, Expr)],
    /// Nonlinear constraints, each with the symbol it determines.
    pub implicit: &'a [(Expr, Symbol)],
    /// Signs and ranges that may be used.
    pub assumptions: &'a Assumptions,
    /// Which symbols move; the others keep their values in one draw.
    pub moves: &'a dyn Fn(Symbol) -> bool,
}

impl std::fmt::Debug for PointsOf<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "PointsOf({} outputs)", self.outputs.len())
    }
}

/// Expressions ready to be evaluated.
#[derive(Debug)]
pub struct Points {
    program: Program,
    /// The part of it that the constraints need.
    solving: Program,
    /// Which generators keep their values in one draw.
    fixed_generators: Vec<bool>,
    fixed_circles: Vec<bool>,
    /// Which operations depend on nothing that moves.
    fixed_operations: Vec<bool>,
    /// The symbols that are generators of their own.
    symbols: Vec<Option<Symbol>>,
}

/// A prime, and values of what does not move.
#[derive(Clone, Debug)]
pub struct Draw {
    /// The prime field.
    pub field: PrimeField,
    constants: Point,
    negative: Vec<bool>,
}

/// At most so many points are refused one after the other.
const REFUSED: u32 = 4000;

/// At most so many are refused where there are constraints: a draw without points is found out by its refusals, and each costs more.
const REFUSED_ON_CONSTRAINTS: u32 = 400;

/// Values of the dependent symbols, and of the circles of dependent angles.
type Determined = (Vec<Residue>, FxHashMap<u32, (Residue, Residue)>);

/// A tower is taken apart at most so often.
const DEEPEST: usize = 24;

impl Points {
    /// Prepares the expressions.
    ///
    /// # Errors
    /// A sentence that says why they cannot be evaluated.
    pub fn new(graph: &Graph, question: &PointsOf<'_>) -> Result<Points, String> {
        let Eliminated {
            roots,
            implicit,
            assumptions,
            ..
        } = eliminate_all(
            graph,
            question.solved,
            question.outputs,
            question.implicit,
            question.assumptions,
        )?;
        let program = prepare(
            graph,
            &Question {
                outputs: &roots,
                constraints: &implicit,
                assumptions: &assumptions,
            },
        );
        if let Some(q) = program.odd_roots.first() {
            if program.order_of_unity.is_multiple_of(*q) {
                return Err(format!(
                    "roots of degree {q} occur with angles of a {q}-th of π"
                ));
            }
        }
        let is_fixed = |e: Expr| graph.is_free_of(e, question.moves);
        let fixed_generators = program.generators.iter().map(|generator| match generator {
            Generator::Symbol(symbol) => !(question.moves)(*symbol),
            Generator::Dependent(_) => false,
            Generator::Transcendental { of, .. } => is_fixed(*of),
        });
        let symbols = program.generators.iter().map(|generator| match generator {
            Generator::Symbol(symbol) => Some(*symbol),
            _ => None,
        });
        let fixed_generators: Vec<bool> = fixed_generators.collect();
        let angles = program.circle_angles.iter();
        let fixed_circles: Vec<bool> = angles.map(|&e| is_fixed(e)).collect();
        Ok(Points {
            fixed_operations: fixed_operations(&program, &fixed_generators, &fixed_circles),
            fixed_generators,
            fixed_circles,
            symbols: symbols.collect(),
            solving: program.of_constraints(),
            program,
        })
    }

    /// The number of operations of one evaluation.
    pub fn cost(&self) -> usize {
        self.program.operations.len()
    }

    /// log2 of a bound on the probability that a minor of `size` rows vanishes at random points of one random draw although it does
    /// not vanish identically, where the entries are polynomials of degree up to `degree` in the first `outputs` expressions.
    ///
    /// As in the modular proof: a non-zero integer below 2^h has at most h/61 prime divisors of 62 bits, and a non-zero polynomial of
    /// degree d vanishes at a random point with probability d/2^60.9 at most, twice that for points of circles; norms
    /// over the algebraic elements multiply degree and height, refused points the probability.
    pub fn miss_log2(&self, outputs: usize, degree: u32, size: usize) -> f64 {
        let program = &self.program;
        let variety = Variety::new(program, 1, 0);
        let sizes = Sizes::of(program, &bound::weights(program, variety.coupled()), None);
        let (mut largest, mut divisors) = ((0.0_f64, 0.0_f64), (0.0, 0.0));
        for &output in program.outputs.iter().take(outputs) {
            let (own, divisor) = (sizes.get(output), sizes.denominator(output));
            largest = (largest.0.max(own.degree), largest.1.max(own.height));
            divisors = (divisors.0 + divisor.degree, divisors.1 + divisor.height);
        }
        let factor = f64::from(degree) * size.max(1) as f64 * SLACK;
        let rows = (
            factor * (largest.0 + divisors.0),
            factor * (largest.1 + divisors.1 + 8.0),
        );
        let over = Norm::of(program, variety.coupled());
        let norm = (f64::from(program.radicals) + over.log2).exp2();
        let rows = (rows.0, rows.1 + rows.0 * over.height);
        let prime = norm * rows.1 / 61.0 / (LOG2_PRIME_COUNT - 4.0).exp2();
        let point = 2.0 * norm * rows.0 / 60.9_f64.exp2();
        (prime + point).log2() + f64::from(REFUSED).log2()
    }

    /// Draws a prime and values of what does not move; `None` when no suitable prime is found.
    pub fn draw(&self, random: &mut Random) -> Option<Draw> {
        let program = &self.program;
        let suits = |p: u64| {
            let mut roots = program.odd_roots.iter();
            roots.all(|q| !(p - 1).is_multiple_of(*q))
        };
        (0..16).find_map(|_| {
            let p = random_prime(random, program.order_of_unity, 1 << 16, suits)?;
            let field = PrimeField::new(p)?;
            let negative = (0..program.radicals).map(|_| random.next_u64() & 1 == 1);
            let negative: Vec<bool> = negative.collect();
            Some(Draw {
                constants: self.constants(&field, &negative, random)?,
                negative,
                field,
            })
        })
    }

    /// The same prime with other values of what does not move.
    pub fn redraw(&self, draw: &Draw, random: &mut Random) -> Option<Draw> {
        Some(Draw {
            constants: self.constants(&draw.field, &draw.negative, random)?,
            ..draw.clone()
        })
    }

    /// Values of what does not move, with a root of each of its radicands: without one no point of the draw would do.
    fn constants(
        &self,
        field: &PrimeField,
        negative: &[bool],
        random: &mut Random,
    ) -> Option<Point> {
        let ring = Scalars {
            field: *field,
            negative,
        };
        (0..REFUSED).find_map(|_| {
            let point = self.random_point(field, random)?;
            let mut run = Run::new(&self.program, &point, Vec::new());
            let is_fixed = |operation: usize| self.fixed_operations[operation];
            let ends = run.advance_over(&ring, self.program.prefix, is_fixed);
            ends.is_ok().then_some(point)
        })
    }

    /// Whether the expressions are rational functions of the generators: the same random numbers then give the same point
    /// whatever does not move.
    pub fn are_rational(&self) -> bool {
        self.program.radicals == 0 && self.program.constraints.is_empty()
    }

    /// Gives symbols that do not move values of choice.
    pub fn set(&self, draw: &mut Draw, values: &[(Symbol, Residue)]) {
        for (generator, symbol) in self.symbols.iter().enumerate() {
            let value = values.iter().find(|(s, _)| Some(*s) == *symbol);
            if let Some((_, value)) = value {
                draw.constants.generators[generator] = *value;
            }
        }
    }

    /// The value of a symbol that does not move; `None` where the expressions do not contain it.
    pub fn value(&self, draw: &Draw, symbol: Symbol) -> Option<Residue> {
        let generator = self.symbols.iter().position(|s| *s == Some(symbol))?;
        Some(draw.constants.generators[generator])
    }

    fn random_point(&self, field: &PrimeField, random: &mut Random) -> Option<Point> {
        let parametrization = Parametrization { rotation: None };
        Point::random(&self.program, field, random, &[], parametrization)
    }

    /// The values of the expressions at one more random point of the draw; `None` when so many points are refused that there
    /// seem to be none.
    pub fn at(&self, draw: &Draw, random: &mut Random) -> Option<Vec<Residue>> {
        let most = match self.program.constraints.is_empty() {
            true => REFUSED,
            false => REFUSED_ON_CONSTRAINTS,
        };
        (0..most).find_map(|_| {
            let mut point = self.random_point(&draw.field, random)?;
            for (i, fixed) in self.fixed_generators.iter().enumerate() {
                if *fixed {
                    point.generators[i] = draw.constants.generators[i];
                }
            }
            for (i, fixed) in self.fixed_circles.iter().enumerate() {
                if *fixed {
                    point.circles[i] = draw.constants.circles[i];
                }
            }
            point.share_unity(&draw.constants);
            match self.program.constraints.is_empty() {
                true => self.free(draw, &point),
                false => self.constrained(draw, &point, random),
            }
        })
    }

    fn free(&self, draw: &Draw, point: &Point) -> Option<Vec<Residue>> {
        let ring = Scalars {
            field: draw.field,
            negative: &draw.negative,
        };
        let mut run = Run::new(&self.program, point, Vec::new());
        // Radicands first: where one is no square the rest is not computed.
        run.advance(&ring, self.program.prefix).ok()?;
        run.advance(&ring, self.program.operations.len()).ok()?;
        let outputs = self.program.outputs.iter();
        Some(outputs.map(|&output| *run.get(output)).collect())
    }

    /// A point of the constraints with coordinates in the prime field.
    fn constrained(&self, draw: &Draw, point: &Point, random: &mut Random) -> Option<Vec<Residue>> {
        let program = &self.program;
        let ring = Scalars {
            field: draw.field,
            negative: &draw.negative,
        };
        let (dependent, circles) = self.dependent(draw, point, random)?;
        let mut run = Run::new(program, point, dependent).with_circles(circles);
        run.advance(&ring, program.operations.len()).ok()?;
        // The equation of a symbol has more solutions than the constraint where roots contain it.
        let mut constraints = program.constraints.iter();
        let hold = constraints.all(|&constraint| run.get(constraint).is_zero());
        let outputs = program.outputs.iter();
        hold.then(|| outputs.map(|&output| *run.get(output)).collect())
    }

    /// Values of the dependent symbols: in the ring of all solutions a root of each equation is chosen, until one solution is left.
    fn dependent(&self, draw: &Draw, point: &Point, random: &mut Random) -> Option<Determined> {
        let variety = Variety::new(&self.solving, 1, 0);
        let scalar = |e: &Element| e.first().copied().unwrap_or(Residue::ZERO);
        let mut prescribed: Vec<Option<Vec<Element>>> = Vec::new();
        for _ in 0..DEEPEST {
            let tower = Tower::new(draw.field, &draw.negative, &prescribed);
            let (level, equation) = match variety.solutions(&tower, point, &draw.negative) {
                Solution::None => return None,
                Solution::Split(split) => {
                    let [first, second] = split.factors;
                    let is_first = random.next_u64() & 1 == 0;
                    (split.level, if is_first { first } else { second })
                }
                Solution::Dependent(values) => match tower.first_extension() {
                    None => {
                        let circles = values.circles.iter();
                        let circles =
                            circles.map(|(&c, (cos, sin))| (c, (scalar(cos), scalar(sin))));
                        let dependent = values.dependent.iter().map(scalar).collect();
                        return Some((dependent, circles.collect()));
                    }
                    Some((level, equation)) => {
                        let coefficients: Vec<Residue> = equation.iter().map(scalar).collect();
                        let root = random_root(&draw.field, &coefficients, random)?;
                        (level, vec![vec![draw.field.neg(root)]])
                    }
                },
            };
            let mut next = tower.equations(level);
            next.push(Some(equation));
            prescribed = next;
        }
        None
    }
}

/// Which operations depend on nothing that moves.
fn fixed_operations(program: &Program, generators: &[bool], circles: &[bool]) -> Vec<bool> {
    let mut fixed: Vec<bool> = Vec::with_capacity(program.operations.len());
    for operation in &program.operations {
        let own = match operation {
            Operation::Generator(index) => generators[*index as usize],
            Operation::CircleCos(circle) | Operation::CircleSin(circle) => {
                circles[*circle as usize]
            }
            _ => true,
        };
        let mut all = own;
        operation.for_each_operand(|operand| all &= fixed[operand as usize]);
        fixed.push(all);
    }
    fixed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_on_the_constraint_and_constants_stay() {
        let g = Graph::new();
        let (x, y, a) = (g.symbol("x", 0), g.symbol("y", 0), g.symbol("a", 0));
        let f = g.add(&[g.powi(x, 2), g.powi(y, 2), g.neg(g.powi(a, 2))]);
        let angle = g.sin(a);
        let implicit = [(f, g.intern_symbol("y", 0))];
        let a_symbol = g.intern_symbol("a", 0);
        let points = Points::new(
            &g,
            &PointsOf {
                outputs: &[f, a, angle, x, y],
                solved: &[],
                implicit: &implicit,
                assumptions: &Assumptions::new(),
                moves: &|s| s != a_symbol,
            },
        )
        .unwrap();
        let mut random = Random::new(1);
        let draw = points.draw(&mut random).unwrap();
        let first = points.at(&draw, &mut random).unwrap();
        let second = points.at(&draw, &mut random).unwrap();
        assert!(first[0].is_zero() && second[0].is_zero());
        assert_eq!(first[1..3], second[1..3]);
        assert_ne!(first[3], second[3]);
        assert!(!first[4].is_zero());
    }
}
