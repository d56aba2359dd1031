//! The linear equations in all variables, `E z' = A z + B u` with z = (q, v, λ): Lagrange's equations with multipliers beside the constraints.
//!
//! Along the motion `W a − Jᵀλ = b` with its accelerations a and multipliers λ, so that
//! `W δv' = ∂(b + Jᵀλ − W a) + Jᵀ δλ`, the derivatives by q, v and u taken with a and λ kept. Beside them stand `δq' = δv` and the linear
//! constraints, a finite one as `h_q δq = 0`. E is singular: each constraint on velocities makes two eigenvalues infinite, each finite
//! constraint three, and each ignorable coordinate that moves by a quadrature is a zero beside the eigenvalues of the independent variables.

use crate::expansion::Expansion;
use crate::multiplicity::product;
use crate::state_space::{StateSpace, StateSpaceError};
use crate::steady::{at_point, solution};
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_symbolic::{Expr, Symbol};

/// The equations with their outputs, exact in the parameters that were left in.
#[derive(Clone, Debug)]
pub struct Descriptor {
    /// E, row by row; n rows of velocities, n of accelerations, one for each independent constraint.
    pub left: Vec<Vec<Expr>>,
    /// The states q, v, λ, inputs and outputs, with A, B, C, D.
    pub space: StateSpace,
    /// How many finite eigenvalues there are beside those of the independent variables: all are zero, by quadratures of ignorable coordinates;
    /// `None` where some of these turn about each other.
    pub zeros: Option<usize>,
}

/// Why there are none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DescriptorError {
    /// Entries change along the motion.
    #[error("in all variables the linear equations about `{motion}` have no constant coefficients: they depend on `{coordinate}`, which runs on along the motion; those in independent variables do not, and `linearize --along` takes the motion as it goes")]
    Runs {
        /// The motion.
        motion: String,
        /// A coordinate, or the time.
        coordinate: String,
    },
    /// The position of an ignorable coordinate is missing.
    #[error("the motion `{motion}` does not say where `{coordinate}` is, and in all variables the linear equations depend on it: add it to the motion")]
    PositionMissing {
        /// The motion.
        motion: String,
        /// The coordinate.
        coordinate: String,
    },
    /// Velocities that the constraints give only implicitly.
    #[error("constraints that are not solved for velocities in closed form have no linear equations in all variables")]
    Implicit,
    /// An output that has no linear form.
    #[error(transparent)]
    Output(#[from] StateSpaceError),
    /// No multipliers carry the motion.
    #[error("the multipliers along the motion were not found in closed form")]
    Multipliers,
}

/// The motion in all variables, the coordinates that run on left in as symbols.
struct Point {
    /// What is put in, one list after the other.
    lists: [Vec<(Expr, Expr)>; 2],
    /// The quasi-velocities with their values.
    speeds: Vec<(Expr, Expr)>,
    /// Coordinates that stand.
    standing: Vec<usize>,
    accelerations: Vec<Expr>,
}

impl Expansion<'_> {
    /// The equations in all variables, with outputs as functions of coordinates, velocities and controls; without any the variables are the
    /// outputs.
    ///
    /// # Errors
    /// [`DescriptorError`].
    pub fn descriptor(&self, outputs: &[(String, Expr)]) -> Result<Descriptor, DescriptorError> {
        let (g, n) = (self.graph(), self.system.n());
        let point = self.in_all_variables()?;
        let (conditions, names) = self.conditions();
        let rows = &self.selection.rows;
        let jacobian: Vec<Vec<Expr>> = rows
            .iter()
            .map(|&row| self.terms.jacobian[row].clone())
            .collect();
        let multipliers = self.multipliers(&point, &jacobian)?;
        let motion = self.equations_of_motion(&point.accelerations, &jacobian, &multipliers);
        let stated: Vec<Expr> = outputs.iter().map(|(_, e)| *e).collect();
        self.are_determined(&stated)?;
        let unknown: Vec<Expr> = rows.iter().map(|&row| self.multiplier(row)).collect();
        let stated = self.with_accelerations(&stated, &jacobian, &unknown)?;
        let by_unknown = self.by_multipliers(&point, &stated, (&unknown, &multipliers))?;
        let along: Vec<(Expr, Expr)> = unknown.iter().copied().zip(multipliers).collect();
        let stated = g.substitute_all(&stated, &along);
        let named = outputs.iter().map(|(name, _)| name).zip(&stated);
        let stated = named.map(|(name, &e)| self.with_slopes(name, e, &[]));
        let stated: Vec<Expr> = stated.collect::<Result<_, _>>()?;
        let whole: Vec<Expr> = motion.into_iter().chain(conditions).chain(stated).collect();
        let inputs = self.inputs_of(&whole);
        let whole = self.flat(&whole, 1).functions;
        let coordinates = &self.system.coordinates;
        let variables: Vec<Symbol> = (coordinates.iter().map(|c| c.q_symbol))
            .chain(coordinates.iter().map(|c| c.v_symbol))
            .collect();
        let slopes = self.constant(&point, &g.jacobian(&whole, &variables))?;
        let by_inputs = self.constant(&point, &g.jacobian(&whole, &inputs))?;
        let mass = self.constant(&point, &self.terms.mass_matrix)?;
        let by_multipliers = self.constant(&point, &transposed(&jacobian, n))?;
        let (zero, size, m) = (g.zero(), 2 * n + rows.len(), rows.len());
        let mut left = vec![vec![zero; size]; size];
        let mut a = left.clone();
        for i in 0..n {
            (left[i][i], a[i][n + i]) = (g.one(), g.one());
            left[n + i][n..2 * n].copy_from_slice(&mass[i]);
            a[n + i][2 * n..].copy_from_slice(&by_multipliers[i]);
        }
        for (row, own) in slopes[..n + m].iter().enumerate() {
            a[n + row][..2 * n].copy_from_slice(own);
        }
        let none = vec![zero; inputs.len()];
        let b = std::iter::repeat_n(none.clone(), n).chain(by_inputs[..n + m].iter().cloned());
        let velocities = coordinates.iter().map(|c| g.text(c.v));
        let states = coordinates.iter().map(|c| c.name.clone()).chain(velocities);
        let states: Vec<String> = states
            .chain(names.into_iter().map(|name| format!("lambda_{name}")))
            .collect();
        let rows_of_outputs = slopes[n + m..].iter().zip(&by_unknown);
        let c = rows_of_outputs.map(|(own, by)| [own.clone(), by.clone()].concat());
        let mut space = StateSpace {
            outputs: outputs.iter().map(|(name, _)| name.clone()).collect(),
            inputs: inputs.iter().map(|&s| g.symbol_text(s)).collect(),
            a,
            b: b.collect(),
            c: c.collect(),
            d: by_inputs[n + m..].to_vec(),
            states,
        };
        if outputs.is_empty() {
            space.show_states(g);
        }
        Ok(Descriptor {
            zeros: self.zeros(&point),
            left,
            space,
        })
    }

    /// Outputs with the accelerations of the equations of motion, `W a = b + Jᵀλ`, where some occur.
    fn with_accelerations(
        &self,
        outputs: &[Expr],
        jacobian: &[Vec<Expr>],
        multipliers: &[Expr],
    ) -> Result<Vec<Expr>, DescriptorError> {
        let (g, coordinates) = (self.graph(), &self.system.coordinates);
        let symbols: Vec<Symbol> = coordinates
            .iter()
            .filter_map(|c| g.as_symbol(c.a))
            .collect();
        if !g.any_contains_any(outputs, &symbols) {
            return Ok(outputs.to_vec());
        }
        let still = vec![g.zero(); coordinates.len()];
        let right = self.equations_of_motion(&still, jacobian, multipliers);
        let found = g.solve(&self.terms.mass_matrix.concat(), &right);
        let found = found.map_err(StateSpaceError::SingularMass)?;
        let pairs: Vec<(Expr, Expr)> = coordinates.iter().map(|c| c.a).zip(found).collect();
        Ok(g.substitute_all(outputs, &pairs))
    }

    /// The slopes of outputs by the multipliers at the motion.
    fn by_multipliers(
        &self,
        point: &Point,
        outputs: &[Expr],
        (unknown, values): (&[Expr], &[Expr]),
    ) -> Result<Vec<Vec<Expr>>, DescriptorError> {
        let g = self.graph();
        let symbols: Vec<Symbol> = unknown.iter().filter_map(|&e| g.as_symbol(e)).collect();
        let along: Vec<(Expr, Expr)> = unknown.iter().copied().zip(values.to_vec()).collect();
        let slopes = g.jacobian(outputs, &symbols);
        let slopes: Vec<Vec<Expr>> = slopes
            .iter()
            .map(|row| g.substitute_all(row, &along))
            .collect();
        self.constant(point, &slopes)
    }

    /// The eigenvalues that ignorable coordinates add, where their rates depend on each other in a row only.
    fn zeros(&self, point: &Point) -> Option<usize> {
        let (g, n) = (self.graph(), self.system.n());
        let ignorable = self.own.ignorable(self.system);
        let symbol = |&j: &usize| self.system.coordinates[j].q_symbol;
        let symbols: Vec<Symbol> = ignorable.iter().map(symbol).collect();
        let rates: Vec<Expr> = ignorable
            .iter()
            .map(|&j| self.own.characteristics.velocities[j])
            .collect();
        let slopes = point.rows(
            self,
            &g.jacobian(&g.substitute_all(&rates, &point.speeds), &symbols),
        );
        let power =
            (1..ignorable.len()).fold(slopes.clone(), |power, _| product(g, &power, &slopes));
        let is_nilpotent = power.iter().flatten().all(|&e| g.is_zero(e));
        let rows = self.selection.rows.iter();
        let finite = rows.filter(|&&row| {
            self.system.constraints[self.terms.constraint_index[row]].kind
                == ConstraintKind::Holonomic
        });
        let whole = 2 * n - self.selection.rows.len() - finite.count();
        let own = self.reduction().kept.len() + self.own.characteristics.k();
        is_nilpotent.then(|| whole.saturating_sub(own))
    }

    /// `b + Jᵀλ − W a` with a and λ as they are along the motion.
    fn equations_of_motion(
        &self,
        accelerations: &[Expr],
        jacobian: &[Vec<Expr>],
        multipliers: &[Expr],
    ) -> Vec<Expr> {
        let g = self.graph();
        let equation = |i: usize| {
            let inertia = self.terms.mass_matrix[i]
                .iter()
                .zip(accelerations)
                .map(|(&w, &a)| g.neg(g.mul(&[w, a])));
            let reaction = jacobian
                .iter()
                .zip(multipliers)
                .map(|(row, &own)| g.mul(&[row[i], own]));
            let all: Vec<Expr> = inertia
                .chain(reaction)
                .chain([self.terms.force[i]])
                .collect();
            g.add(&all)
        };
        (0..self.system.n()).map(equation).collect()
    }

    /// The independent constraints as functions that vanish, the finite ones as they are stated, and their names.
    fn conditions(&self) -> (Vec<Expr>, Vec<String>) {
        let of = |&row: &usize| {
            let own = &self.system.constraints[self.terms.constraint_index[row]];
            let condition = match own.kind {
                ConstraintKind::Holonomic => own.stated,
                _ => self.terms.constraints[row],
            };
            (condition, own.name.clone())
        };
        self.selection.rows.iter().map(of).unzip()
    }

    /// The multipliers along the motion.
    fn multipliers(
        &self,
        point: &Point,
        jacobian: &[Vec<Expr>],
    ) -> Result<Vec<Expr>, DescriptorError> {
        let (g, n) = (self.graph(), self.system.n());
        let none = vec![g.zero(); jacobian.len()];
        let open = self.equations_of_motion(&point.accelerations, jacobian, &none);
        let matrix = point.rows(self, &transposed(jacobian, n));
        let right: Vec<Expr> = point
            .rows(self, &[open])
            .concat()
            .into_iter()
            .map(|e| g.neg(e))
            .collect();
        let found = solution(g, (&matrix, jacobian.len()), &right);
        found
            .map(|own| own.values)
            .ok_or(DescriptorError::Multipliers)
    }

    /// Positions that stand, velocities and accelerations along the motion, as functions of the coordinates that run on.
    fn in_all_variables(&self) -> Result<Point, DescriptorError> {
        let g = self.graph();
        let c = &self.own.characteristics;
        if !c.manifold.implicit.is_empty() {
            return Err(DescriptorError::Implicit);
        }
        let coordinates = &self.system.coordinates;
        let definitions: Vec<Expr> = c.parameters.iter().map(|p| p.definition).collect();
        let speeds = self.at(&definitions).into_iter();
        let speeds: Vec<(Expr, Expr)> = c
            .parameters
            .iter()
            .map(|p| g.symbol_expr(p.symbol))
            .zip(speeds)
            .collect();
        let now = self.at(&coordinates.iter().map(|own| own.v).collect::<Vec<_>>());
        let mut standing: Vec<usize> = (0..now.len()).filter(|&j| g.is_zero(now[j])).collect();
        let position = |&j: &usize| Some((coordinates[j].q, self.motion.positions[j]?));
        let (positions, velocities) = loop {
            let positions: Vec<(Expr, Expr)> = standing.iter().filter_map(position).collect();
            let controls = self.controls(&c.velocities);
            let lists: [&[(Expr, Expr)]; 4] = [&speeds, &positions, &controls, &self.values];
            let velocities = at_point(g, &c.velocities, &lists);
            // What stands now may move as soon as what runs on has moved.
            let count = standing.len();
            standing.retain(|&j| g.is_zero(velocities[j]));
            if standing.len() == count {
                break (positions, velocities);
            }
        };
        let rate = |&e: &Expr| -> Expr {
            let terms: Vec<Expr> = coordinates
                .iter()
                .map(|own| own.q_symbol)
                .zip(&velocities)
                .map(|(q, &v)| g.mul(&[g.diff(e, q), v]))
                .collect();
            g.add(&terms)
        };
        let accelerations = velocities.iter().map(rate).collect();
        let moving = coordinates
            .iter()
            .map(|own| own.v)
            .zip(velocities.iter().copied());
        Ok(Point {
            lists: [moving.collect(), positions],
            speeds,
            standing,
            accelerations,
        })
    }

    /// The entries of a matrix at the motion, which must not change along it.
    fn constant(
        &self,
        point: &Point,
        rows: &[Vec<Expr>],
    ) -> Result<Vec<Vec<Expr>>, DescriptorError> {
        let g = self.graph();
        let found = point.rows(self, rows);
        let occurring = g.symbols_in(&found.concat());
        let motion = || self.motion.name.clone();
        let mut coordinates = self.system.coordinates.iter();
        match coordinates.position(|own| occurring.contains(&own.q_symbol)) {
            _ if occurring.contains(&g.intern_symbol("t", 0)) => Err(DescriptorError::Runs {
                motion: motion(),
                coordinate: "t".into(),
            }),
            None => Ok(found),
            Some(j) => {
                let own = &self.system.coordinates[j];
                let coordinate = own.name.clone();
                Err(if point.standing.contains(&j) {
                    DescriptorError::PositionMissing {
                        motion: motion(),
                        coordinate,
                    }
                } else {
                    DescriptorError::Runs {
                        motion: motion(),
                        coordinate,
                    }
                })
            }
        }
    }
}

impl Point {
    /// The entries of a matrix along the motion.
    fn rows(&self, about: &Expansion<'_>, rows: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
        let all = rows.concat();
        let [moving, standing] = &self.lists;
        let mut values = at_point(
            about.graph(),
            &all,
            &[moving, standing, &about.controls(&all), &about.values],
        )
        .into_iter();
        let row = |row: &Vec<Expr>| values.by_ref().take(row.len()).collect();
        rows.iter().map(row).collect()
    }
}

/// The transposed of a matrix with so many columns.
fn transposed(rows: &[Vec<Expr>], columns: usize) -> Vec<Vec<Expr>> {
    (0..columns)
        .map(|c| rows.iter().map(|row| row[c]).collect())
        .collect()
}
