//! Angles of many turns: a sine sees the absolute error of its angle, which grows with the angle. Where the equations
//! depend on a coordinate only through trigonometric functions of whole multiples of it, whole turns may be left out.

use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// What 2π is beyond its double.
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// Less than half a turn.
const HALF: f64 = 3.0;

/// Which coordinates are angles of this kind.
#[derive(Clone, Debug, Default)]
pub struct Turns(Vec<bool>);

impl Turns {
    /// Of the coordinates in the expressions.
    pub fn of(g: &Graph, coordinates: &[Symbol], expressions: &[Expr]) -> Turns {
        let (free, angles) = outside_angles(g, expressions);
        let whole = |argument: &Expr, symbol: Symbol| {
            let slope = g.diff(*argument, symbol);
            g.as_integer(slope).is_some()
        };
        let turns = |&symbol: &Symbol| {
            let mut own = angles
                .iter()
                .filter(|&&argument| g.symbols_in(&[argument]).contains(&symbol))
                .peekable();
            own.peek().is_some()
                && !free.contains(&symbol)
                && own.all(|argument| whole(argument, symbol))
        };
        Turns(coordinates.iter().map(turns).collect())
    }

    /// Whether the coordinate at a place is an angle of this kind.
    pub fn is_turning(&self, place: usize) -> bool {
        self.0.get(place).copied().unwrap_or(false)
    }

    /// The state y + carry without whole turns of its angles, to the rounding of an angle of one turn.
    pub(crate) fn reduced(&self, y: &[f64], carry: &[f64]) -> Vec<f64> {
        let mut reduced = Vec::with_capacity(y.len());
        self.reduce(y, carry, &mut reduced);
        reduced
    }

    /// The same into `reduced`.
    pub(crate) fn reduce(&self, y: &[f64], carry: &[f64], reduced: &mut Vec<f64>) {
        reduced.clear();
        reduced.extend_from_slice(y);
        for i in 0..self.0.len().min(y.len()) {
            // Within half a turn nothing is left out.
            if !self.0[i] || y[i].abs() < HALF {
                continue;
            }
            let turns = (y[i] / TAU).round();
            let high = turns * TAU;
            let low = turns.mul_add(TAU, -high);
            reduced[i] = (y[i] - high) - (low + turns * TAU_LOW - carry[i]);
        }
    }

    /// Writes the state as coefficients of order 0, and gives the state in which a series is expanded: without whole turns,
    /// except where constraints jump; these are followed in the coordinates as they are.
    pub(crate) fn center(
        &self,
        jumps: bool,
        (y, carry): (&[f64], &[f64]),
        coefficients: &mut [f64],
    ) -> Vec<f64> {
        coefficients[..y.len()].copy_from_slice(y);
        match jumps {
            true => y.to_vec(),
            false => self.reduced(y, carry),
        }
    }
}

/// The symbols of which expressions depend otherwise than through trigonometric functions, and the arguments of these.
pub fn outside_angles(g: &Graph, roots: &[Expr]) -> (Vec<Symbol>, Vec<Expr>) {
    use Function::{Cos, Cot, Csc, Sec, Sin, Tan};
    let (mut open, mut seen) = (roots.to_vec(), BTreeSet::new());
    let (mut found, mut angles) = (Vec::new(), Vec::new());
    while let Some(e) = open.pop() {
        if !seen.insert(e) {
            continue;
        }
        match g.node(e) {
            Node::Symbol(symbol) => found.push(*symbol),
            Node::Apply {
                function: Sin | Cos | Tan | Cot | Sec | Csc,
                arguments,
            } => angles.extend(arguments.iter()),
            node => node.for_each_child(|child| open.push(child)),
        }
    }
    (found, angles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_turns_are_left_out() {
        let turns = Turns(vec![true, false]);
        // 10⁶ turns and a quarter: the double nearest to them, and what it leaves out.
        let exact = (1_000_000.25f64, TAU, TAU_LOW);
        let y = exact.0 * exact.1;
        let carry = exact.0.mul_add(exact.1, -y) + exact.0 * exact.2;
        let reduced = turns.reduced(&[y, y], &[carry, carry]);
        assert!(
            (reduced[0] - std::f64::consts::FRAC_PI_2).abs() < 4e-16,
            "{reduced:?}"
        );
        assert_eq!(reduced[1], y);
        assert_eq!(turns.reduced(&[1.0, 2.0], &[1e-17, 0.0]), [1.0, 2.0]);
    }

    #[test]
    fn angles_are_recognized() {
        let g = Graph::new();
        let names = ["a", "b", "c", "d"].map(|name| g.intern_symbol(name, 0));
        let [a, b, c, d] = names.map(|s| g.symbol_expr(s));
        let half = chetaev_symbolic::rational::ratio(1, 2).unwrap();
        let expressions = [
            g.sin(g.add(&[a, g.neg(b)])),
            g.mul(&[b, g.cos(a)]),
            g.cos(g.scale(&half, c)),
        ];
        let _ = d;
        assert_eq!(
            Turns::of(&g, &names, &expressions).0,
            [true, false, false, false]
        );
    }
}
