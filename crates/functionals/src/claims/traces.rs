//! Whether the variations that imposed equations leave have arbitrary values on the boundary, so that each natural condition holds by itself.
//!
//! Where `u' = 0` is imposed on a line the variations are constants, and of −p δu(0) − q δu(2) = 0 follows p + q = 0 alone. On a line, of
//! equations that are linear with polynomials for solutions, these decide. Else the question is the problem of Dirichlet, which as many equations
//! as fields may have, all of an order 2k and with a symbol that is regular for the normal and of one sign: values and derivatives across the
//! boundary below the k-th are prescribed. It is solvable but in critical states (L. Hörmander, The Analysis of Linear Partial Differential
//! Operators III, 1985, ch. 20). That is not decided here: `solvable` in the model states it, and a proof says so; of equations that are linear, with
//! terms of lower order, none is given, as every state is critical for u'' + π² u = 0 on 0 < x < 1.

use super::given::{is_given, Given};
use crate::elimination::{Group, Solved};
use crate::functional::{Equation, Functional, Piece, Role, Side};
use crate::space::{Jet, Space};
use crate::variation::{Trace, Variation};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::zero::assumptions::{Relation, SignSet};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr};
use std::collections::BTreeSet;

/// Derivatives of a solution that may be a polynomial are taken up to this order.
const MOST: usize = 8;

/// Directions in which a symbol is looked at besides the axes.
const DIRECTIONS: [[i64; 3]; 4] = [[1, 2, 3], [2, -1, 1], [-3, 1, 2], [1, 1, -1]];

/// How conditions hold whose variations are not arbitrary, and what helps.
const TOGETHER: &str = "only taken together; a multiplier under [multipliers] makes them single";

/// What is known of the values on the boundary.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Traces {
    /// They are arbitrary.
    Arbitrary,
    /// They are arbitrary where this holds.
    Where(String),
    /// They are bound to each other, or it was not decided whether they are: why.
    Open(String),
}

/// What is known of the values on the boundary of the variations of a functional in which fields that are imposed are put in.
pub(super) fn traces(functional: &Functional, variation: &Variation) -> Traces {
    let own = Bound::of(functional);
    let Some(needed) = own.needed(variation).filter(|needed| !needed.is_empty()) else {
        return Traces::Arbitrary;
    };
    if own.is_bound_on_pieces() || functional.space.coordinates.iter().any(|c| c.is_time) {
        return own.open();
    }
    let on_line = own.on_line(&needed);
    on_line.unwrap_or_else(|| own.by_dirichlet(&needed))
}

/// The value of a variation on a piece, or its derivative across it; or its value where pieces meet.
struct Value<'f> {
    /// The piece; a meeting where there is none.
    piece: Option<&'f Piece>,
    component: usize,
    is_slope: bool,
}

/// The equations imposed inside that restrict variations.
struct Bound<'f> {
    functional: &'f Functional,
    equations: Vec<&'f Equation>,
    /// The components that they are about.
    components: BTreeSet<usize>,
}

impl<'f> Bound<'f> {
    fn of(functional: &'f Functional) -> Bound<'f> {
        let inside = functional.restricting().filter(|e| e.on.is_none());
        let equations: Vec<&Equation> = inside.collect();
        let residuals = equations.iter().flat_map(|e| &e.residuals);
        let residuals: Vec<Expr> = residuals.copied().collect();
        let jets = functional.space.jets_in(&residuals).into_iter();
        let components = jets.map(|jet| jet.component);
        Bound {
            functional,
            components: components.filter(|&c| functional.varies(c)).collect(),
            equations,
        }
    }

    fn space(&self) -> &'f Space {
        &self.functional.space
    }

    fn residuals(&self) -> impl Iterator<Item = Expr> + '_ {
        self.equations
            .iter()
            .flat_map(|e| e.residuals.iter().copied())
    }

    /// The values in the first variation whose coefficients do not vanish because of what is imposed.
    fn needed(&self, variation: &Variation) -> Option<Vec<Value<'f>>> {
        if self.components.is_empty() {
            return None;
        }
        let imposed = |on: Option<&str>| -> Vec<Group> {
            let all = self.functional.with_role(Role::Imposed);
            let here = all.filter(|e| e.on.as_deref() == on);
            here.map(|e| Group {
                label: format!("({})", e.label),
                equations: e.residuals.clone(),
            })
            .collect()
        };
        let inside = Solved::new(self.space()).with(&imposed(None));
        let mut found = Vec::new();
        for on in &variation.pieces {
            let piece = self.functional.piece(&on.piece)?;
            let own = on.conditions.iter();
            let own = own.filter(|own| self.components.contains(&own.component));
            let mut own: Vec<_> = own.collect();
            if own.is_empty() {
                continue;
            }
            let here = inside.with_on(&piece.side, &imposed(Some(&on.piece)));
            own.retain(|own| !here.follows(&[own.value]));
            found.extend(own.into_iter().map(|own| Value {
                piece: Some(piece),
                component: own.component,
                is_slope: own.trace == Trace::Normal,
            }));
        }
        let corners = variation.corners.iter();
        let corners = corners.filter(|own| self.components.contains(&own.component));
        let corners = corners.filter(|own| !inside.follows(&[own.value]));
        found.extend(corners.map(|own| Value {
            piece: None,
            component: own.component,
            is_slope: false,
        }));
        Some(found)
    }

    /// Whether something is imposed on a piece on these components that is not a value given there.
    fn is_bound_on_pieces(&self) -> bool {
        let mut all = self.functional.restricting();
        all.any(|equation| {
            let Some(on) = equation.on.as_deref() else {
                return false;
            };
            let jets = self.space().jets_in(&equation.residuals);
            let mut own = jets.iter().filter(|jet| self.is_about(jet));
            own.any(|jet| {
                let piece = self.functional.piece(on);
                piece.is_none_or(|piece| {
                    let given: Given = piece.fixed.iter().copied().collect();
                    !is_given(self.space(), piece, &given, jet)
                })
            })
        })
    }

    fn is_about(&self, jet: &Jet) -> bool {
        self.components.contains(&jet.component)
    }

    /// The values that are given on the boundary.
    fn given(&self) -> Vec<Value<'f>> {
        let pieces = self.functional.pieces.iter();
        let all = pieces.flat_map(|piece| piece.fixed.iter().map(move |own| (piece, own)));
        let own = all.filter(|(_, (component, _))| self.components.contains(component));
        own.map(|(piece, &(component, is_slope))| Value {
            piece: Some(piece),
            component,
            is_slope,
        })
        .collect()
    }

    fn labels(&self) -> String {
        let all = self.equations.iter().map(|e| format!("({})", e.label));
        all.collect::<Vec<_>>().join(" and ")
    }

    fn open(&self) -> Traces {
        Traces::Open(format!(
            "whether the variations that are left by {} have arbitrary values on the boundary was not decided: where they have not, the natural \
             conditions hold {TOGETHER}",
            self.labels()
        ))
    }

    /// Whether the equations are linear in what is varied.
    fn are_linear(&self) -> bool {
        let space = self.space();
        self.residuals().all(|e| {
            let jets = space.jets_in(&[e]);
            let mut own = jets.iter().filter(|jet| self.is_about(jet));
            own.all(|jet| {
                let slope = space.jets_in(&[space.partial(e, jet)]);
                !slope
                    .iter()
                    .any(|jet| self.functional.varies(jet.component))
            })
        })
    }

    /// The verdict by the solutions of linear equations on a line, where they are polynomials.
    fn on_line(&self, needed: &[Value<'f>]) -> Option<Traces> {
        let space = self.space();
        let g = &space.graph;
        if space.coordinates.len() != 1 || !self.are_linear() {
            return None;
        }
        let interval = self.functional.intervals.first()?;
        let varied = |e: Expr| {
            let jets = space.jets_in(&[e]).into_iter();
            let terms = jets.filter(|jet| self.is_about(jet)).map(|jet| {
                let symbol = space.jet(jet.component, &jet.by);
                g.mul(&[space.partial(e, &jet), symbol])
            });
            g.add(&terms.collect::<Vec<_>>())
        };
        let group = Group {
            label: self.labels(),
            equations: self.residuals().map(varied).collect(),
        };
        let solved = Solved::new(space).with(&[group]);
        let is_regular = |&e: &Expr| !space.is_of_place(&[e]) && space.sign(e).is_nonzero();
        if !solved.left.is_empty() || !solved.divisors.iter().all(is_regular) {
            return None;
        }
        let rows = |values: &[Value<'f>]| -> Option<Vec<Expr>> {
            let all = values.iter();
            all.map(|value| self.at_lower_end(value, &solved, interval.lower))
                .collect()
        };
        let (given, free) = (rows(&self.given())?, rows(needed)?);
        let all: Vec<Expr> = given.iter().chain(&free).copied().collect();
        let columns = space.jets_in(&all).into_iter();
        let columns: Vec<Jet> = columns.filter(|jet| self.is_about(jet)).collect();
        let row = |&e: &Expr| columns.iter().map(|jet| space.partial(e, jet)).collect();
        let mut echelon = Echelon::new(space);
        given.iter().for_each(|e| {
            echelon.takes(row(e));
        });
        for (value, e) in needed.iter().zip(&free) {
            if !echelon.takes(row(e)) {
                return Some(self.tied(value));
            }
        }
        let mut known = space.assumptions();
        known.assume(interval.lower, Relation::Less, interval.upper);
        let open = echelon
            .pivots
            .iter()
            .filter(|&&e| !known_sign(g, e, &known).is_nonzero());
        let open: Vec<String> = open.map(|&e| format!("{} ≠ 0", g.text(e))).collect();
        Some(if open.is_empty() {
            Traces::Arbitrary
        } else {
            Traces::Where(open.join(" and "))
        })
    }

    /// A value at an end by the derivatives of the solution at the lower end, where their series ends.
    fn at_lower_end(&self, value: &Value<'f>, solved: &Solved<'f>, lower: Expr) -> Option<Expr> {
        let space = self.space();
        let g = &space.graph;
        let Side::Flat { axis, at, .. } = value.piece?.side else {
            return None;
        };
        let by: &[usize] = if value.is_slope { &[axis] } else { &[] };
        let step = g.sub(at, lower);
        let mut rate = solved.normal(space.jet(value.component, by));
        let mut factor = g.one();
        let mut terms = Vec::new();
        for k in 1..=MOST as i64 {
            terms.push(g.mul(&[factor, space.at(rate, axis, lower)]));
            factor = g.mul(&[factor, step, g.number(rational::ratio(1, k)?)]);
            rate = solved.normal(space.total(rate, axis));
            if g.is_zero(factor) || space.vanishes(rate) {
                return Some(g.add(&terms));
            }
        }
        None
    }

    fn tied(&self, value: &Value<'f>) -> Traces {
        let component = self.space().component_at(value.component).name;
        let slope = if value.is_slope {
            "the derivative of "
        } else {
            ""
        };
        let on = value.piece.map_or("", |piece| piece.name.as_str());
        Traces::Open(format!(
            "by {}, {slope}the variation of {component} on {on} is determined by those that are free elsewhere on the boundary, so that the \
             natural conditions hold {TOGETHER}",
            self.labels()
        ))
    }

    /// The verdict by the problem of Dirichlet.
    fn by_dirichlet(&self, needed: &[Value<'f>]) -> Traces {
        let space = self.space();
        let jets = space.jets_in(&self.residuals().collect::<Vec<_>>());
        let own = || jets.iter().filter(|jet| self.is_about(jet));
        let order = own().map(|jet| jet.by.len()).max().unwrap_or(0);
        let has_lower = own().any(|jet| jet.by.len() < order);
        let given = self.given();
        let is_of_problem = |value: &Value<'f>| match value.piece {
            Some(_) => order >= 4 || !value.is_slope,
            None => order >= 4,
        };
        let is_square = self.residuals().count() == self.components.len();
        let is_posed = order > 0
            && order % 2 == 0
            && is_square
            && needed.iter().chain(&given).all(is_of_problem)
            && self.is_elliptic(order, needed.iter().chain(&given));
        if !is_posed || self.are_linear() && has_lower {
            return self.open();
        }
        if self.is_coercive() {
            return Traces::Arbitrary;
        }
        let labels = self.labels();
        if !self.equations.iter().all(|e| e.is_solvable) {
            let named: Vec<String> = self
                .equations
                .iter()
                .map(|e| format!("{:?}", e.label))
                .collect();
            return Traces::Open(format!(
                "whether the problem of Dirichlet of {labels}, linearised, is solvable for any values on the boundary was not decided: where it is not, the \
                 natural conditions hold {TOGETHER}, and where it is, solvable = [{}] states it",
                named.join(", ")
            ));
        }
        Traces::Where(format!(
            "the problem of Dirichlet of {labels}, linearised, is solvable for any values on the boundary, as the model states"
        ))
    }

    /// Whether it is one linear equation a_ij u,ij = f with constants a_ij that are definite, so that there is one solution for any values on the
    /// boundary (P. D. Lax, A. N. Milgram, 1954).
    fn is_coercive(&self) -> bool {
        let space = self.space();
        let g = &space.graph;
        let residuals: Vec<Expr> = self.residuals().collect();
        let [e] = residuals[..] else {
            return false;
        };
        let jets = space.jets_in(&[e]).into_iter();
        let own: Vec<Jet> = jets.filter(|jet| self.is_about(jet)).collect();
        let slopes: Vec<Expr> = own.iter().map(|jet| space.partial(e, jet)).collect();
        let are_constant = space.jets_in(&slopes).is_empty() && !space.is_of_place(&slopes);
        if self.components.len() != 1 || !are_constant || own.iter().any(|jet| jet.by.len() != 2) {
            return false;
        }
        let dimensions = space.coordinates.len();
        let entry = |i: usize, j: usize| {
            let here = own.iter().zip(&slopes);
            let mut here = here.filter(|(jet, _)| jet.by == [i.min(j), i.max(j)]);
            let slope = here.next().map_or(g.zero(), |(_, &slope)| slope);
            let part = if i == j { 1 } else { 2 };
            g.div(slope, g.integer(part))
        };
        let minor = |size: usize, sign: i64| {
            let row = |i: usize| {
                (0..size)
                    .map(|j| g.mul(&[g.integer(sign), entry(i, j)]))
                    .collect()
            };
            determinant(g, &(0..size).map(row).collect::<Vec<Vec<Expr>>>())
        };
        [1, -1]
            .into_iter()
            .any(|sign| (1..=dimensions).all(|size| space.sign(minor(size, sign)).is_positive()))
    }

    /// Whether the principal symbol does not vanish in general, nor across plane pieces on which values are free or given, and is not seen to
    /// change its sign.
    fn is_elliptic<'v>(&self, order: usize, values: impl Iterator<Item = &'v Value<'f>>) -> bool
    where
        'f: 'v,
    {
        let space = self.space();
        let dimensions = space.coordinates.len();
        let along = |axis: usize| (0..dimensions).map(|i| i64::from(i == axis)).collect();
        let across: BTreeSet<usize> = values
            .filter_map(|value| match value.piece?.side {
                Side::Flat { axis, .. } => Some(axis),
                Side::Curved => None,
            })
            .collect();
        let normals: Vec<Vec<i64>> = across.into_iter().map(along).collect();
        let general: Vec<i64> = DIRECTIONS[0][..dimensions.min(3)].to_vec();
        let mut regular = normals.iter().chain([&general]);
        if !regular.all(|direction| self.is_regular_in(order, direction)) {
            return false;
        }
        let others = DIRECTIONS
            .iter()
            .map(|own| own[..dimensions.min(3)].to_vec());
        let all = others.chain((0..dimensions).map(along));
        let signs: Vec<_> = all
            .map(|direction| space.sign(self.symbol(order, &direction, false)))
            .collect();
        let is_positive = signs.iter().any(|own| own.is_positive());
        let is_negative = signs.iter().any(|own| own.negated().is_positive());
        let changes_sign = is_positive && is_negative;
        !changes_sign && !signs.contains(&SignSet::ZERO)
    }

    /// Whether the principal symbol does not vanish in a direction: where the fields vanish, or in general.
    fn is_regular_in(&self, order: usize, direction: &[i64]) -> bool {
        let mut both = [true, false].into_iter();
        both.any(|at_rest| {
            !self
                .space()
                .vanishes(self.symbol(order, direction, at_rest))
        })
    }

    /// The determinant of the principal symbol in a direction.
    fn symbol(&self, order: usize, direction: &[i64], at_rest: bool) -> Expr {
        let space = self.space();
        let g = &space.graph;
        let entry = |e: Expr, component: usize| {
            let jets = space.jets_in(&[e]).into_iter();
            let own = jets.filter(|jet| jet.component == component && jet.by.len() == order);
            let terms = own.map(|jet| {
                let factor: i64 = jet.by.iter().map(|&axis| direction[axis]).product();
                let slope = space.partial(e, &jet);
                let slope = if at_rest { self.at_rest(slope) } else { slope };
                g.mul(&[g.integer(factor), slope])
            });
            g.add(&terms.collect::<Vec<_>>())
        };
        let row = |e: Expr| self.components.iter().map(|&c| entry(e, c)).collect();
        let matrix: Vec<Vec<Expr>> = self.residuals().map(row).collect();
        determinant(g, &matrix)
    }

    fn at_rest(&self, e: Expr) -> Expr {
        let space = self.space();
        let zero = space.graph.zero();
        space.replace(space.explicit(e), &|symbol| {
            space.as_jet(symbol).map(|_| zero)
        })
    }
}

/// Rows that are independent of each other, each with the column in which those after it are made zero.
struct Echelon<'s> {
    space: &'s Space,
    rows: Vec<(usize, Vec<Expr>)>,
    /// What was divided by.
    pivots: Vec<Expr>,
}

impl<'s> Echelon<'s> {
    fn new(space: &'s Space) -> Echelon<'s> {
        Echelon {
            space,
            rows: Vec::new(),
            pivots: Vec::new(),
        }
    }

    /// Takes a row; whether it is independent of those before.
    fn takes(&mut self, row: Vec<Expr>) -> bool {
        let g = &self.space.graph;
        let mut row = row;
        for (column, known) in &self.rows {
            let factor = g.div(row[*column], known[*column]);
            let pairs = row.iter().zip(known);
            row = pairs
                .map(|(&e, &k)| g.sub(e, g.mul(&[factor, k])))
                .collect();
        }
        let is_number = |&column: &usize| g.as_number(row[column]).is_some();
        let open = (0..row.len()).filter(|&column| !self.space.vanishes(row[column]));
        let open: Vec<usize> = open.collect();
        let pivot = open
            .iter()
            .copied()
            .find(is_number)
            .or(open.first().copied());
        let Some(column) = pivot else {
            return false;
        };
        self.pivots.push(row[column]);
        self.rows.push((column, row));
        true
    }
}
