//! An integral modulo p with its coefficients as functions of the parameters.

use super::family::Family;
use super::lift::{self, Sample};
use super::motion::redraw_with_points;
use super::search::{Integral, Table};
use super::special::Tie;
use chetaev_mechanics::Context;
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::zero::points::Draw;
use chetaev_symbolic::{Expr, Symbol, Verdict};

impl Table<'_> {
    /// An integral with its coefficients as functions of the parameters: as (value, shown); `None` where they are none of
    /// moderate degree.
    pub fn lifted(&self, family: &Family, vector: &[(usize, Residue)]) -> Option<(Expr, Expr)> {
        self.lifted_on(family, vector, None)
    }

    pub(super) fn lifted_on(
        &self,
        family: &Family,
        vector: &[(usize, Residue)],
        tie: Option<&Tie>,
    ) -> Option<(Expr, Expr)> {
        let g = &self.motion.system.graph;
        let (&(leading, _), rest) = vector.split_last()?;
        let support: Vec<usize> = rest.iter().map(|&(member, _)| member).collect();
        let (draw, random) = self.draw(0)?;
        let mut source = Restricted {
            table: self,
            family,
            leading,
            support: &support,
            draw,
            random,
            tie,
        };
        let entries = match support.is_empty() {
            true => Vec::new(),
            false => lift::entries(&mut source, support.len())?,
        };
        let polynomials = lift::cleared(&entries)?;
        let members = std::iter::once(leading).chain(support);
        let (mut value, mut shown) = (Vec::new(), Vec::new());
        for (member, polynomial) in members.zip(&polynomials) {
            let coefficient = lift::expression(g, polynomial, &self.parameters);
            let member = &family.members[member];
            let system = self.motion.system;
            value.push(g.mul(&[coefficient, family.expression(system, member, false)]));
            shown.push(g.mul(&[coefficient, family.expression(system, member, true)]));
        }
        Some((g.add(&value), g.add(&shown)))
    }

    /// Lifts and proves an integral; `None` where that fails.
    pub fn proved(
        &self,
        cx: &Context<'_>,
        family: &Family,
        vector: &[(usize, Residue)],
    ) -> Option<Integral> {
        let (value, shown) = self.lifted(family, vector)?;
        let verdict = self.motion.is_integral(cx, value);
        matches!(verdict, Verdict::Proved(_)).then_some(Integral {
            value,
            shown,
            verdict,
            independent: true,
            name: None,
        })
    }
}

/// The linear system of one integral, restricted to the members it uses.
struct Restricted<'a> {
    table: &'a Table<'a>,
    family: &'a Family,
    leading: usize,
    support: &'a [usize],
    draw: Draw,
    random: Random,
    tie: Option<&'a Tie>,
}

impl Restricted<'_> {
    fn solve(&mut self, draw: &Draw) -> Option<Sample> {
        let field = draw.field;
        let columns = self.support.len() + 1;
        let mut matrix = Vec::new();
        let mut parameters = Vec::new();
        for _ in 0..columns + 2 {
            let at = self.table.at(draw, &mut self.random)?;
            let members = self.support.iter().chain([&self.leading]);
            matrix.extend(
                members.map(|&m| self.table.member(&field, &at, &self.family.members[m]).1),
            );
            parameters = at.parameters;
        }
        let space = null_space(&field, columns, matrix);
        let (_, rest) = space
            .vectors
            .iter()
            .find(|(free, _)| *free == columns - 1)?;
        if space.vectors.len() != 1 {
            return None;
        }
        let mut entries = vec![Residue::ZERO; self.support.len()];
        rest.iter().for_each(|&(i, c)| entries[i] = c);
        Some(Sample {
            parameters,
            entries,
        })
    }
}

impl lift::Source for Restricted<'_> {
    fn field(&self) -> PrimeField {
        self.draw.field
    }

    fn sample(&mut self) -> Option<Sample> {
        let draw = match self.table.parameters.is_empty() {
            true => self.draw.clone(),
            false => redraw_with_points(&self.table.points, &self.draw, &mut self.random)?,
        };
        let draw = match self.tie {
            Some(tie) => self.table.tied(&draw, tie)?,
            None => draw,
        };
        // The first sample is the one that others are compared with.
        self.draw = draw.clone();
        self.solve(&draw)
    }

    fn roots(&self) -> Vec<(usize, u32)> {
        lift::roots_of_numbers(&self.table.motion.system.graph, &self.table.parameters)
    }

    fn varied(&mut self, parameter: usize) -> Option<Sample> {
        let g = &self.table.motion.system.graph;
        let symbol: Symbol = g.as_symbol(self.table.parameters[parameter])?;
        let mut draw = self.draw.clone();
        let value = self.draw.field.random(&mut self.random);
        self.table.points.set(&mut draw, &[(symbol, value)]);
        match self.tie {
            // The other follows, so what depends on either is seen to depend on this one.
            Some(tie) => {
                let draw = self.table.tied(&draw, tie)?;
                self.solve(&draw)
            }
            None => self.solve(&draw),
        }
    }
}
