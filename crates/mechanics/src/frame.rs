//! Moving frames: quasi-velocities, the fields dual to their forms, and the brackets of these.
//!
//! Forms `ω^s = a^s_u dq^u + a^s_0 dt`, quasi-velocities `η^s = a^s_u v^u + a^s_0`, dual fields `X_s` and `X_0`, so that
//! `v = X_0 + η^s X_s` (T3 §1; Poincaré 1901, Boltzmann 1902). The natural frame has `η = v`.

use crate::equations::unused_name;
use crate::linear::dot;
use crate::sample;
use crate::selection::{eliminate, pivot_cost, Selection};
use crate::system::{Coordinate, System};
use crate::terms::MotionTerms;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::{Expr, Symbol};

/// A quasi-velocity: its name, its symbol and the symbol of its rate.
#[derive(Clone, Debug)]
pub struct Speed {
    /// The name: `u`, or `x'` in the natural frame.
    pub name: String,
    /// η.
    pub value: Expr,
    /// η'.
    pub rate: Expr,
    /// The symbol of η.
    pub symbol: Symbol,
    /// The symbol of η'.
    pub rate_symbol: Symbol,
    /// η as a function of (q, v, t).
    pub definition: Expr,
}

/// A frame of the configuration space, which may move with the time.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The n quasi-velocities η^s.
    pub speeds: Vec<Speed>,
    /// `a[s][u]`, the forms.
    pub forms: Vec<Vec<Expr>>,
    /// `X[s][i]`, component of the field X_s along coordinate i.
    pub fields: Vec<Vec<Expr>>,
    /// The components of X_0 along the coordinates: the velocity where all η vanish.
    pub drift: Vec<Expr>,
    /// Quasi-velocities that are constraint functions, η^s = f^l: pairs (row of the terms, s).
    pub adapted: Vec<(usize, usize)>,
}

/// Where the quasi-velocities of a frame come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOrigin {
    /// All n are stated by the model.
    Stated,
    /// k are stated; the constraint functions complete them.
    CompletedByConstraints,
    /// k are stated; dependent velocities complete them.
    CompletedByVelocities,
    /// None are stated: velocities, and constraint functions for the dependent ones.
    AdaptedVelocities,
    /// None are stated: the velocities.
    Natural,
}

/// Quasi-velocities given by forms, before the fields are known.
struct Forms {
    speeds: Vec<Speed>,
    adapted: Vec<(usize, usize)>,
}

impl Frame {
    /// The natural frame: η = v, X_s = ∂/∂q^s.
    pub fn natural(system: &System) -> Frame {
        Frame::natural_of(system, &system.coordinates)
    }

    /// The natural frame of derivatives of any order: η = q^(m), for coordinates with q^(m-1) in the place of q.
    pub fn natural_of(system: &System, jets: &[Coordinate]) -> Frame {
        let g = &system.graph;
        let unit = |i: usize| -> Vec<Expr> {
            let entry = |j| if i == j { g.one() } else { g.zero() };
            (0..system.n()).map(entry).collect()
        };
        Frame {
            speeds: jets.iter().map(|c| derivative(system, c)).collect(),
            forms: (0..system.n()).map(unit).collect(),
            fields: (0..system.n()).map(unit).collect(),
            drift: vec![g.zero(); system.n()],
            adapted: Vec::new(),
        }
    }

    /// The frame of a model: its own n quasi-velocities; or its k quasi-velocities completed by the constraint functions
    /// where these are affine, by dependent velocities where not; else `None`.
    ///
    /// # Errors
    /// [`SolveError`] where the forms are structurally dependent.
    pub fn stated(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Option<Result<(Frame, FrameOrigin), SolveError>> {
        let (n, r) = (system.n(), selection.rows.len());
        if let Some(fields) = &system.frame {
            let frame = Frame::from_fields(system, fields.fields.clone(), fields.drift.clone());
            return Some(frame.map(|frame| (frame, FrameOrigin::Stated)));
        }
        let count = system.quasi_velocities.len();
        if count == 0 || !are_affine(system) || (count != n && count + r != n) {
            return None;
        }
        let mut forms = Forms {
            speeds: (0..count).map(|s| stated(system, s)).collect(),
            adapted: Vec::new(),
        };
        let origin = if count == n {
            FrameOrigin::Stated
        } else if constraints_are_affine(system, terms, selection) {
            forms.complete_by_constraints(system, terms, selection);
            FrameOrigin::CompletedByConstraints
        } else {
            let rest = completing(system, terms, selection, &forms);
            forms
                .speeds
                .extend(rest.iter().map(|&d| velocity(system, d)));
            FrameOrigin::CompletedByVelocities
        };
        Some(forms.into_frame(system).map(|frame| (frame, origin)))
    }

    /// The frame of a model, or independent velocities completed by the constraint functions where these are affine, or
    /// the natural frame.
    ///
    /// # Errors
    /// [`SolveError`] where the forms are structurally dependent.
    pub fn adapted(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<(Frame, FrameOrigin), SolveError> {
        if let Some(stated) = Frame::stated(system, terms, selection) {
            return stated;
        }
        if selection.rows.is_empty() || !constraints_are_affine(system, terms, selection) {
            return Ok((Frame::natural(system), FrameOrigin::Natural));
        }
        let independent = selection.independent(system.n());
        let mut forms = Forms {
            speeds: independent.iter().map(|&i| velocity(system, i)).collect(),
            adapted: Vec::new(),
        };
        forms.complete_by_constraints(system, terms, selection);
        let frame = forms.into_frame(system)?;
        Ok((frame, FrameOrigin::AdaptedVelocities))
    }

    /// The frame of given fields: `fields[s][i]` is the component of X_s along coordinate i.
    ///
    /// # Errors
    /// [`SolveError`] where the fields are structurally dependent.
    pub fn from_fields(
        system: &System,
        fields: Vec<Vec<Expr>>,
        drift: Vec<Expr>,
    ) -> Result<Frame, SolveError> {
        let (g, n) = (&system.graph, system.n());
        let transposed: Vec<Vec<Expr>> = (0..n)
            .map(|i| fields.iter().map(|field| field[i]).collect())
            .collect();
        Ok(Frame {
            speeds: (0..n).map(|s| stated(system, s)).collect(),
            forms: inverse(g, &transposed)?,
            fields,
            drift,
            adapted: Vec::new(),
        })
    }

    /// Whether η = v.
    pub fn is_natural(&self, system: &System) -> bool {
        self.is_natural_of(&system.coordinates)
    }

    /// Whether η = q^(m), for coordinates with q^(m-1) in the place of q.
    pub fn is_natural_of(&self, jets: &[Coordinate]) -> bool {
        let of_velocity = |(speed, c): (&Speed, &Coordinate)| speed.value == c.v;
        self.speeds.len() == jets.len() && self.speeds.iter().zip(jets).all(of_velocity)
    }

    /// The velocities `X_0 + η^s X_s` for quasi-velocities with these values.
    pub fn velocities(&self, system: &System, speeds: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        (0..system.n())
            .map(|i| {
                let mut parts = vec![self.drift[i]];
                for (field, &speed) in self.fields.iter().zip(speeds) {
                    if !g.is_zero(field[i]) {
                        parts.push(g.mul(&[field[i], speed]));
                    }
                }
                g.add(&parts)
            })
            .collect()
    }

    /// The components of a vector along the fields X_s: `ω^s` without its part along dt.
    pub fn components(&self, system: &System, vector: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let forms = self.forms.iter();
        forms.map(|form| dot(g, form, vector)).collect()
    }

    /// The structure coefficients `[X_s, X_u] = C^w_su X_w` as (w, s, u, C), those with s < u that are not zero by their
    /// form; index 0 of s stands for X_0, so that s, u, w count from 1 (T3 (1)).
    pub fn structure_coefficients(&self, system: &System) -> Vec<(usize, usize, usize, Expr)> {
        let (g, n) = (&system.graph, system.n());
        let field = |s: usize| {
            if s == 0 {
                &self.drift
            } else {
                &self.fields[s - 1]
            }
        };
        let mut found = Vec::new();
        for s in 0..n {
            for u in s + 1..=n {
                let one = |index| if index == 0 { g.one() } else { g.zero() };
                let (x, y) = (field(s), field(u));
                let forward = self.derivative(system, x, one(s), y);
                let backward = self.derivative(system, y, one(u), x);
                let bracket: Vec<Expr> = forward
                    .into_iter()
                    .zip(backward)
                    .map(|(a, b)| g.sub(a, b))
                    .collect();
                for (w, c) in self.components(system, &bracket).into_iter().enumerate() {
                    if !g.is_zero(c) {
                        found.push((w + 1, s, u, c));
                    }
                }
            }
        }
        found
    }

    /// The derivative of functions of (q, t) along the field with these components.
    fn derivative(&self, system: &System, along: &[Expr], time: Expr, es: &[Expr]) -> Vec<Expr> {
        crate::characteristics::derive_along(system, es, along, time, &[])
    }
}

impl Forms {
    fn complete_by_constraints(
        &mut self,
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) {
        let g = &system.graph;
        for &row in &selection.rows {
            let constraint = &system.constraints[terms.constraint_index[row]];
            let name = unused_name(system, &format!("eta_{}", constraint.name));
            self.adapted.push((row, self.speeds.len()));
            self.speeds.push(Speed {
                value: g.symbol(&name, 0),
                rate: g.symbol(&name, 1),
                symbol: g.intern_symbol(&name, 0),
                rate_symbol: g.intern_symbol(&name, 1),
                definition: terms.constraints[row],
                name,
            });
        }
    }

    /// The fields are the columns of the inverse of the matrix of the forms.
    fn into_frame(self, system: &System) -> Result<Frame, SolveError> {
        let (g, n) = (&system.graph, system.n());
        let velocities = system.velocity_symbols();
        let definitions: Vec<Expr> = self.speeds.iter().map(|s| s.definition).collect();
        let forms = g.jacobian(&definitions, &velocities);
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        let offsets = g.substitute_all(&definitions, &at_rest);
        let negative: Vec<Expr> = offsets.iter().map(|&a| g.neg(a)).collect();
        let inverse = inverse(g, &forms)?;
        Ok(Frame {
            drift: inverse.iter().map(|row| dot(g, row, &negative)).collect(),
            speeds: self.speeds,
            fields: (0..n)
                .map(|s| inverse.iter().map(|row| row[s]).collect())
                .collect(),
            forms,
            adapted: self.adapted,
        })
    }
}

/// Velocities that complete the stated forms to a frame: those of the columns that the forms leave free at a sampled state,
/// the dependent ones of the selection where possible.
fn completing(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    forms: &Forms,
) -> Vec<usize> {
    let (g, n) = (&system.graph, system.n());
    let definitions: Vec<Expr> = forms.speeds.iter().map(|s| s.definition).collect();
    let slopes = g.jacobian(&definitions, &system.velocity_symbols());
    let values = sample::admissible_point(system, terms, 0x0c4e_7ae5).and_then(|point| {
        g.evaluate_f64(&slopes.concat(), &|s| point.get(&s).copied())
            .ok()
    });
    let Some(values) = values else {
        return selection.dependent.clone();
    };
    let cost: Vec<Vec<usize>> = slopes
        .iter()
        .map(|row| {
            let kept = |i| {
                if selection.dependent.contains(&i) {
                    10_000_000
                } else {
                    0
                }
            };
            (0..n)
                .map(|i| kept(i) + pivot_cost(system, row[i], usize::MAX))
                .collect()
        })
        .collect();
    let taken = eliminate(values, cost, n).dependent;
    match taken.len() == definitions.len() {
        true => (0..n).filter(|i| !taken.contains(i)).collect(),
        false => selection.dependent.clone(),
    }
}

/// The velocity of a coordinate as a quasi-velocity.
fn velocity(system: &System, i: usize) -> Speed {
    derivative(system, &system.coordinates[i])
}

/// What stands in the place of the velocity.
fn derivative(system: &System, c: &Coordinate) -> Speed {
    Speed {
        name: system.graph.symbol_text(c.v_symbol),
        value: c.v,
        rate: c.a,
        symbol: c.v_symbol,
        rate_symbol: c.a_symbol,
        definition: c.v,
    }
}

/// A quasi-velocity of the model.
fn stated(system: &System, s: usize) -> Speed {
    let (g, quasi) = (&system.graph, &system.quasi_velocities[s]);
    Speed {
        name: quasi.name.clone(),
        value: g.symbol(&quasi.name, 0),
        rate: g.symbol(&quasi.name, 1),
        symbol: g.intern_symbol(&quasi.name, 0),
        rate_symbol: g.intern_symbol(&quasi.name, 1),
        definition: quasi.definition,
    }
}

/// Whether the quasi-velocities of the model are affine in the velocities.
fn are_affine(system: &System) -> bool {
    let (g, symbols) = (&system.graph, system.velocity_symbols());
    system.quasi_velocities.iter().all(|quasi| {
        let slopes = g.gradient(quasi.definition, &symbols);
        !g.any_contains_any(&slopes, &symbols)
    })
}

fn constraints_are_affine(system: &System, terms: &MotionTerms, selection: &Selection) -> bool {
    selection
        .rows
        .iter()
        .all(|&row| system.constraints[terms.constraint_index[row]].is_affine_in_velocities())
}
