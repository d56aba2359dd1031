//! Linear equations for unknown constants: `Σ c_ν e_ν = 0` in several equations, with columns e_ν that are functions on a manifold.
//!
//! Solved as the search for first integrals is: modulo a prime at random points with random parameters, then lifted to functions
//! of the parameters. Nothing found here is believed: whoever asks proves what it is for.

use crate::constants::constants;
use crate::lift::{self, Sample};
use crate::motion::{draw_with_points, redraw_with_points, Motion};
use chetaev_mechanics::prover;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::zero::points::{Draw, Points, PointsOf};
use chetaev_symbolic::{Expr, Symbol};

/// More equations than unknowns.
const SURPLUS: usize = 6;

/// A leading column with coefficient one, and the coefficients of the others.
type NullVector = (usize, Vec<(usize, Residue)>);

/// Columns with one entry for each equation.
#[derive(Debug)]
pub struct Ansatz<'a> {
    motion: &'a Motion<'a>,
    points: Points,
    columns: usize,
    equations: usize,
    parameters: Vec<Expr>,
    seed: u64,
}

impl<'a> Ansatz<'a> {
    /// Columns as functions on a manifold; `further` symbols move beside those of the system.
    ///
    /// # Errors
    /// A sentence that says why they cannot be evaluated.
    pub fn new(
        motion: &'a Motion<'a>,
        columns: &[Vec<Expr>],
        manifold: &Manifold,
        further: &[Symbol],
        seed: u64,
    ) -> Result<Ansatz<'a>, String> {
        let mut outputs = columns.concat();
        let mut parameters = constants(motion, manifold, &outputs);
        let g = &motion.system.graph;
        parameters.retain(|&e| g.as_symbol(e).is_none_or(|s| !further.contains(&s)));
        outputs.extend(&parameters);
        let moves = |symbol: Symbol| motion.moves(symbol) || further.contains(&symbol);
        let points = Points::new(
            g,
            &PointsOf {
                outputs: &outputs,
                solved: &manifold.solved,
                implicit: &manifold.implicit,
                assumptions: &prover::assumptions(motion.system),
                moves: &moves,
            },
        )?;
        Ok(Ansatz {
            motion,
            points,
            columns: columns.len(),
            equations: columns.first().map_or(0, Vec::len),
            parameters,
            seed,
        })
    }

    /// Columns that are no combinations of those before them.
    pub fn independent(&self) -> Option<Vec<usize>> {
        let all: Vec<usize> = (0..self.columns).collect();
        let mut random = Random::stream(self.seed, 0);
        let draw = draw_with_points(&self.points, &mut random)?;
        let space = self.space(&draw, &mut random, &all)?;
        let is_free = |place: &usize| space.iter().any(|(free, _)| free == place);
        Some(all.into_iter().filter(|place| !is_free(place)).collect())
    }

    /// Up to `most` solutions of a basis, those first whose last nonzero coefficient stands at an early column; those that could not
    /// be lifted are missing.
    pub fn up_to(&self, most: usize) -> Option<Vec<Vec<Expr>>> {
        let all: Vec<usize> = (0..self.columns).collect();
        let mut random = Random::stream(self.seed, 0);
        let draw = draw_with_points(&self.points, &mut random)?;
        let space = self.space(&draw, &mut random, &all)?;
        let first = space.iter().take(most);
        let lifted = first.filter_map(|(leading, rest)| {
            self.lifted(draw.clone(), random.clone(), *leading, rest)
        });
        Some(lifted.collect())
    }

    /// A solution in which the last column has the coefficient one.
    pub fn with_last(&self) -> Option<Vec<Expr>> {
        let all: Vec<usize> = (0..self.columns).collect();
        let mut random = Random::stream(self.seed, 0);
        let draw = draw_with_points(&self.points, &mut random)?;
        let space = self.space(&draw, &mut random, &all)?;
        let last = self.columns.checked_sub(1)?;
        let (leading, rest) = space.into_iter().find(|(leading, _)| *leading == last)?;
        self.lifted(draw, random, leading, &rest)
    }

    /// A basis of all solutions, in each of which the last coefficient that is not zero leads.
    pub fn all(&self) -> Option<Vec<Vec<Expr>>> {
        let all: Vec<usize> = (0..self.columns).collect();
        let mut random = Random::stream(self.seed, 0);
        let draw = draw_with_points(&self.points, &mut random)?;
        let space = self.space(&draw, &mut random, &all)?;
        let lifted = space
            .iter()
            .map(|(leading, rest)| self.lifted(draw.clone(), random.clone(), *leading, rest));
        lifted.collect()
    }

    fn lifted(
        &self,
        draw: Draw,
        random: Random,
        leading: usize,
        rest: &[(usize, Residue)],
    ) -> Option<Vec<Expr>> {
        let g = &self.motion.system.graph;
        let support: Vec<usize> = rest.iter().map(|&(place, _)| place).collect();
        let mut source = Restricted {
            ansatz: self,
            used: support.iter().copied().chain([leading]).collect(),
            draw,
            random,
        };
        let entries = match support.is_empty() {
            true => Vec::new(),
            false => lift::entries(&mut source, support.len())?,
        };
        let polynomials = lift::cleared(&entries)?;
        let mut coefficients = vec![g.zero(); self.columns];
        for (place, polynomial) in std::iter::once(leading).chain(support).zip(&polynomials) {
            coefficients[place] = lift::expression(g, polynomial, &self.parameters);
        }
        Some(coefficients)
    }

    /// Null vectors among some columns: the leading column with the rest of each. Equations may say less than their number, so
    /// points are added until what is found holds at further ones.
    fn space(&self, draw: &Draw, random: &mut Random, used: &[usize]) -> Option<Vec<NullVector>> {
        let field = &draw.field;
        let mut points = (used.len() + SURPLUS).div_ceil(self.equations.max(1)) + 2;
        let mut matrix = self.rows(draw, random, used, points)?;
        loop {
            let space = null_space(field, used.len(), matrix.clone());
            let more = self.rows(draw, random, used, 2)?;
            let holds = |row: &[Residue]| {
                space.vectors.iter().all(|(free, rest)| {
                    let sum = rest.iter().fold(row[*free], |sum, &(i, c)| {
                        field.add(sum, field.mul(c, row[i]))
                    });
                    sum.is_zero()
                })
            };
            // As many points as unknowns are always enough.
            if points > used.len() + SURPLUS || more.chunks(used.len().max(1)).all(holds) {
                let named = space.vectors.into_iter().map(|(free, rest)| {
                    let rest = rest.into_iter().map(|(i, c)| (used[i], c)).collect();
                    (used[free], rest)
                });
                return Some(named.collect());
            }
            matrix.extend(more);
            matrix.extend(self.rows(draw, random, used, points)?);
            points = 2 * points + 2;
        }
    }

    /// The equations at so many points, restricted to some columns.
    fn rows(
        &self,
        draw: &Draw,
        random: &mut Random,
        used: &[usize],
        points: usize,
    ) -> Option<Vec<Residue>> {
        let mut rows = Vec::with_capacity(points * self.equations * used.len());
        for _ in 0..points {
            let at = self.points.at(draw, random)?;
            for equation in 0..self.equations {
                rows.extend(used.iter().map(|&c| at[c * self.equations + equation]));
            }
        }
        Some(rows)
    }

    fn parameters_at(&self, draw: &Draw, random: &mut Random) -> Option<Vec<Residue>> {
        let at = self.points.at(draw, random)?;
        Some(at[self.columns * self.equations..].to_vec())
    }
}

/// The equations of one solution, restricted to the columns it uses, the leading one last.
struct Restricted<'a> {
    ansatz: &'a Ansatz<'a>,
    used: Vec<usize>,
    draw: Draw,
    random: Random,
}

impl Restricted<'_> {
    fn solve(&mut self, draw: &Draw) -> Option<Sample> {
        let space = self.ansatz.space(draw, &mut self.random, &self.used)?;
        let leading = *self.used.last()?;
        let [(found, rest)] = &space[..] else {
            return None;
        };
        if *found != leading {
            return None;
        }
        let entries = self.used[..self.used.len() - 1]
            .iter()
            .map(|place| {
                let own = rest.iter().find(|(i, _)| i == place);
                own.map_or(Residue::ZERO, |&(_, c)| c)
            })
            .collect();
        Some(Sample {
            parameters: self.ansatz.parameters_at(draw, &mut self.random)?,
            entries,
        })
    }
}

impl lift::Source for Restricted<'_> {
    fn field(&self) -> PrimeField {
        self.draw.field
    }

    fn sample(&mut self) -> Option<Sample> {
        if !self.ansatz.parameters.is_empty() {
            let (points, random) = (&self.ansatz.points, &mut self.random);
            self.draw = redraw_with_points(points, &self.draw, random)?;
        }
        let draw = self.draw.clone();
        self.solve(&draw)
    }

    fn roots(&self) -> Vec<(usize, u32)> {
        lift::roots_of_numbers(&self.ansatz.motion.system.graph, &self.ansatz.parameters)
    }

    fn varied(&mut self, parameter: usize) -> Option<Sample> {
        let g = &self.ansatz.motion.system.graph;
        let symbol = g.as_symbol(self.ansatz.parameters[parameter])?;
        let mut draw = self.draw.clone();
        let value = self.draw.field.random(&mut self.random);
        self.ansatz.points.set(&mut draw, &[(symbol, value)]);
        self.solve(&draw)
    }
}
