//! Admissible velocities without singular places: quasi-velocities P with `v = φ(q, P, t)` that needs no division by anything
//! that changes.
//!
//! Constraints are taken one by one. Where one has a velocity with a constant coefficient, it gives that velocity (a disc that
//! rolls: `x' = r ψ' cos φ`). Where it has two velocities with coefficients p, q and `p² + q²` constant, as the blade of a
//! skate, `x' sin φ = y' cos φ`, the speed u along it takes their place, `x' = u cos φ`, `y' = u sin φ`. Independent velocities
//! are singular wherever their chart ends; these quasi-velocities serve everywhere (Chaplygin 1911; Maruskin, Bloch 2011).

use crate::characteristics::{Characteristics, Parameter};
use crate::constraint::ConstraintKind;
use crate::prover::assumptions;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::simplify::{simplify_all, Options};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};

/// Larger systems are not looked at.
const LARGEST: usize = 40;

/// Characteristics by such quasi-velocities for the constraints of `rows`, each with the definition of P in the velocities;
/// `None` where none are found in this way.
pub fn regular(system: &System, terms: &MotionTerms, rows: &[usize]) -> Option<Characteristics> {
    let is_affine = rows.iter().all(|&row| terms.affine[row]);
    if terms.order != 1 || !is_affine || system.n() > LARGEST || !system.masses.is_empty() {
        return None;
    }
    let is_holonomic = |&row: &usize| {
        system.constraints[terms.constraint_index[row]].kind == ConstraintKind::Holonomic
    };
    if rows.iter().any(is_holonomic) {
        return None;
    }
    let size = |e: &Elimination<'_>| system.graph.reachable(&e.velocities).len();
    let found = [Writing::Coefficients, Writing::Stated]
        .into_iter()
        .filter_map(|writing| Elimination::of(system, terms, rows, writing));
    let Elimination {
        velocities, speeds, ..
    } = found.min_by_key(size)?;
    let is_regular = velocities
        .iter()
        .chain(speeds.iter().map(|p| &p.definition))
        .all(|&e| has_no_poles(system, e));
    is_regular.then(|| Characteristics::by_formulas(system, terms, rows, speeds, velocities))
}

/// How velocities that are known already stand in a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Writing {
    /// With their coefficients made short: best for a single body.
    Coefficients,
    /// As the constraint is written: sums that go on from body to body along a chain stay the same from row to row.
    Stated,
}

struct Elimination<'a> {
    writing: Writing,
    system: &'a System,
    g: &'a Graph,
    assumptions: Assumptions,
    /// v in the speeds.
    velocities: Vec<Expr>,
    speeds: Vec<Parameter>,
}

/// A constraint in the speeds: coefficients, and what is left without them.
struct Row {
    coefficients: Vec<Expr>,
    /// Speeds that also occur in `rest`.
    doubled: Vec<usize>,
    rest: Expr,
}

impl<'a> Elimination<'a> {
    /// Of all rows; `None` where one offers nothing.
    fn of(
        system: &'a System,
        terms: &MotionTerms,
        rows: &[usize],
        writing: Writing,
    ) -> Option<Elimination<'a>> {
        let mut own = Elimination::new(system, writing);
        let mut left: Vec<usize> = rows.to_vec();
        while !left.is_empty() {
            // A row that offers nothing may do so when others are solved.
            let place = left
                .iter()
                .position(|&row| own.solve(terms.constraints[row]))?;
            left.remove(place);
        }
        Some(own)
    }

    fn new(system: &'a System, writing: Writing) -> Elimination<'a> {
        let speed = |c: &crate::system::Coordinate| Parameter {
            name: format!("{}'", c.name),
            value: c.v,
            rate: c.a,
            symbol: c.v_symbol,
            rate_symbol: c.a_symbol,
            definition: c.v,
        };
        Elimination {
            writing,
            system,
            g: &system.graph,
            assumptions: assumptions(system),
            velocities: system.coordinates.iter().map(|c| c.v).collect(),
            speeds: system.coordinates.iter().map(speed).collect(),
        }
    }

    /// Eliminates one speed by the constraint `f = 0`; false where none can be.
    fn solve(&mut self, f: Expr) -> bool {
        let row = self.row(f);
        match self.pivot(&row) {
            Some(place) => self.eliminate(&row, place),
            None => match self.rotation(&row) {
                Some((places, square)) => self.rotate(&row, places, square),
                None => return false,
            },
        }
        true
    }

    /// A constraint in the speeds that are left. What was eliminated before stays as it is written, unless it contains a speed
    /// whose coefficient is then the sum of several.
    fn row(&self, f: Expr) -> Row {
        let g = self.g;
        let velocities = &self.system.coordinates;
        let symbols: Vec<Symbol> = velocities.iter().map(|c| c.v_symbol).collect();
        let stated = simplify_all(g, &g.gradient(f, &symbols), &Options::default());
        let mut coefficients = vec![g.zero(); self.speeds.len()];
        let speeds: Vec<Symbol> = self.speeds.iter().map(|p| p.symbol).collect();
        // What every velocity is without the speeds that have a coefficient here.
        let mut known: Vec<(Expr, Expr)> = velocities.iter().map(|c| (c.v, g.zero())).collect();
        let mut composed = Vec::new();
        for (i, &coefficient) in stated.iter().enumerate().filter(|(_, &c)| !g.is_zero(c)) {
            let value = self.velocities[i];
            match speeds.iter().position(|&s| g.as_symbol(value) == Some(s)) {
                Some(place) => coefficients[place] = coefficient,
                None => {
                    known[i].1 = value;
                    composed.push(g.mul(&[coefficient, value]));
                }
            }
        }
        let doubled: Vec<usize> = (0..speeds.len())
            .filter(|&s| g.any_contains_any(&composed, &[speeds[s]]))
            .collect();
        let rest = match self.writing {
            Writing::Stated => g.substitute(f, &known),
            Writing::Coefficients => {
                let at_rest: Vec<(Expr, Expr)> =
                    known.iter().map(|&(v, _)| (v, g.zero())).collect();
                composed.push(g.substitute(f, &at_rest));
                g.add(&composed)
            }
        };
        Row {
            coefficients,
            doubled,
            rest,
        }
    }

    /// A speed whose coefficient is constant and not zero: rather a number than a parameter, and none that the user wants to be
    /// independent.
    fn pivot(&self, row: &Row) -> Option<usize> {
        let g = self.g;
        let wanted = |s: usize| {
            self.system
                .coordinates
                .iter()
                .position(|c| c.v == self.speeds[s].value)
                .is_some_and(|i| self.system.independent.contains(&i))
        };
        let single = (0..row.coefficients.len()).filter(|s| !row.doubled.contains(s));
        let constant = single.filter(|&s| self.is_constant(row.coefficients[s]));
        constant.min_by_key(|&s| {
            (
                wanted(s),
                g.as_number(row.coefficients[s]).is_none(),
                std::cmp::Reverse(s),
            )
        })
    }

    /// Whether the expression is a constant other than zero.
    fn is_constant(&self, e: Expr) -> bool {
        let g = self.g;
        let is_parameter = |s: &Symbol| {
            self.system
                .parameters
                .iter()
                .any(|p| g.as_symbol(p.expr) == Some(*s))
        };
        g.symbols_in(&[e]).iter().all(is_parameter)
            && known_sign(g, e, &self.assumptions).is_nonzero()
    }

    fn eliminate(&mut self, row: &Row, place: usize) {
        let g = self.g;
        let mut terms = vec![row.rest];
        for (s, &c) in row
            .coefficients
            .iter()
            .enumerate()
            .filter(|(s, _)| *s != place)
        {
            terms.push(g.mul(&[c, self.speeds[s].value]));
        }
        let value = g.neg(g.div(g.add(&terms), row.coefficients[place]));
        let pairs = [(self.speeds[place].value, value)];
        self.velocities = g.substitute_all(&self.velocities, &pairs);
        self.speeds.remove(place);
    }

    /// Two speeds whose coefficients p, q change, with `p² + q²` constant, and that constant.
    fn rotation(&self, row: &Row) -> Option<([usize; 2], Expr)> {
        let g = self.g;
        let own: Vec<usize> = (0..row.coefficients.len())
            .filter(|s| !row.doubled.contains(s) && !g.is_zero(row.coefficients[*s]))
            .collect();
        let pairs = own
            .iter()
            .enumerate()
            .flat_map(|(k, &i)| own[k + 1..].iter().map(move |&j| [i, j]));
        for [i, j] in pairs {
            let square = g.add(&[i, j].map(|s| g.powi(row.coefficients[s], 2)));
            let square = simplify_all(g, &[square], &Options::default())[0];
            if self.is_constant(square) {
                return Some(([i, j], square));
            }
        }
        None
    }

    /// `P_i = −q u − p h`, `P_j = p u − q h` with `h = (what is left of f)/(p² + q²)`.
    fn rotate(&mut self, row: &Row, [i, j]: [usize; 2], square: Expr) {
        let g = self.g;
        let (p, q) = (row.coefficients[i], row.coefficients[j]);
        let mut terms = vec![row.rest];
        for (s, &c) in row
            .coefficients
            .iter()
            .enumerate()
            .filter(|(s, _)| ![i, j].contains(s))
        {
            terms.push(g.mul(&[c, self.speeds[s].value]));
        }
        let h = g.div(g.add(&terms), square);
        let (one, other) = (&self.speeds[i], &self.speeds[j]);
        // No name of a model contains a space.
        let name = format!("speed along {} {}", one.name, other.name);
        let definition = g.sub(g.mul(&[p, other.definition]), g.mul(&[q, one.definition]));
        let speed = Parameter {
            value: g.symbol(&name, 0),
            rate: g.symbol(&name, 1),
            symbol: g.intern_symbol(&name, 0),
            rate_symbol: g.intern_symbol(&name, 1),
            definition: g.div(definition, square),
            name,
        };
        let along = |a: Expr, b: Expr| g.sub(g.mul(&[a, speed.value]), g.mul(&[b, h]));
        let pairs = [(one.value, along(g.neg(q), p)), (other.value, along(p, q))];
        self.velocities = g.substitute_all(&self.velocities, &pairs);
        self.speeds[i] = speed;
        self.speeds.remove(j);
    }
}

/// Whether nothing is divided by that may vanish, but roots, whose radicands are assumed to be positive where they stand in a
/// constraint.
fn has_no_poles(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    let is_parameter = |s: &Symbol| {
        system
            .parameters
            .iter()
            .any(|p| g.as_symbol(p.expr) == Some(*s))
    };
    let stays = |e: Expr| g.symbols_in(&[e]).iter().all(is_parameter);
    g.reachable(&[e]).into_iter().all(|own| match g.node(own) {
        Node::Power { base, exponent } => match g.as_number(*exponent) {
            Some(number) => {
                !chetaev_symbolic::rational::is_negative(number)
                    || g.as_integer(*exponent).is_none()
                    || stays(*base)
            }
            None => false,
        },
        Node::Apply { function, .. } => {
            matches!(function, Function::Sin | Function::Cos | Function::Exp)
        }
        Node::Solve { .. } | Node::Matrix { .. } => false,
        _ => true,
    })
}
