//! Constraints solved one by one for speeds: by a constant coefficient, by turning two velocities into the speed along a blade, by
//! the direction that a constraint between two speeds leaves, or by a coefficient that does not vanish where the motion starts.

use crate::characteristics::Parameter;
use crate::prover::assumptions;
use crate::sample::Generator;
use crate::selection::eliminate;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::simplify::{simplify_all, Options};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Graph, Node, Symbol};
use std::collections::BTreeMap;

/// Numbers for parameters and for the place where the motion starts.
pub(crate) struct Start(BTreeMap<Symbol, f64>);

impl Start {
    /// Of a system: coordinates without a stated value are zero, parameters without one are drawn.
    pub(crate) fn of(system: &System) -> Start {
        let g = &system.graph;
        let mut generator = Generator::new(0x5354_4152);
        let mut known: BTreeMap<Symbol, f64> = BTreeMap::new();
        for p in &system.parameters {
            let stated = p.value.and_then(|e| g.evaluate_f64(&[e], &|_| None).ok());
            let value = stated.and_then(|values| values.first().copied());
            let drawn = generator.between(0.5, 1.5);
            known.extend(g.as_symbol(p.expr).map(|s| (s, value.unwrap_or(drawn))));
        }
        for &(symbol, e) in &system.start {
            if let Ok(values) = g.evaluate_f64(&[e], &|s| known.get(&s).copied()) {
                known.extend(values.first().map(|&value| (symbol, value)));
            }
        }
        for c in &system.coordinates {
            known.entry(c.q_symbol).or_insert(0.0);
        }
        Start(known)
    }

    /// Whether a function of the place has a value there that is not zero.
    pub(crate) fn is_nonzero(&self, g: &Graph, e: Expr) -> bool {
        // What is not known, such as a control, is not looked at.
        let value = g.evaluate_f64(&[e], &|s| Some(self.0.get(&s).copied().unwrap_or(0.7)));
        value.is_ok_and(|values| values.iter().all(|x| x.is_finite() && x.abs() > 1e-9))
    }

    /// Whether the rows of a matrix are independent there.
    pub(crate) fn is_independent(&self, g: &Graph, rows: &[Vec<Expr>]) -> bool {
        let point = |s: Symbol| Some(self.0.get(&s).copied().unwrap_or(0.7));
        let Ok(values) = g.evaluate_f64(&rows.concat(), &point) else {
            return false;
        };
        let n = rows.first().map_or(0, Vec::len);
        let cost = vec![vec![0; n]; rows.len()];
        eliminate(values, cost, n).rows.len() == rows.len()
    }
}

/// How a speed is taken by a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// A speed whose coefficient is constant.
    Constant,
    /// Two speeds with coefficients whose squares have a constant sum: the speed along the blade that they describe.
    Rotation,
    /// Two speeds and nothing else: the direction that is left.
    Along,
    /// A speed whose coefficient does not vanish where the motion starts.
    Nonvanishing,
}

/// How velocities that are known already stand in a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Writing {
    /// With their coefficients made short: best for a single body.
    Coefficients,
    /// As the constraint is written: sums that go on from body to body along a chain stay the same from row to row.
    Stated,
}

/// By which functions of parameters a constraint may be divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Dividing {
    /// By those that the assumptions keep from zero.
    Nonzero,
    /// Also by those that are not zero at the stated values.
    NonzeroAsStated,
}

/// The admissible velocities in speeds, of which each constraint takes one.
pub(crate) struct Elimination<'a> {
    writing: Writing,
    system: &'a System,
    g: &'a Graph,
    assumptions: Assumptions,
    /// Where what only contains parameters is not zero, it is divided by; `None` where only what is never zero is.
    stated: Option<Start>,
    /// v in the speeds.
    pub(crate) velocities: Vec<Expr>,
    /// The speeds that are left.
    pub(crate) speeds: Vec<Parameter>,
}

/// A constraint in the speeds: coefficients, and what is left without them.
pub(crate) struct Row {
    pub(crate) coefficients: Vec<Expr>,
    /// Speeds that also occur in `rest`.
    pub(crate) doubled: Vec<usize>,
    /// What does not contain the speeds with a coefficient.
    pub(crate) rest: Expr,
}

impl<'a> Elimination<'a> {
    /// Of all rows by the first of the steps that one of them offers, again and again; `None` where none does.
    pub(crate) fn by_steps(
        mut self,
        constraints: &[Expr],
        steps: &[Step],
        start: &Start,
    ) -> Option<Elimination<'a>> {
        let mut left: Vec<Expr> = constraints.to_vec();
        while !left.is_empty() {
            let rows: Vec<Row> = left.iter().map(|&f| self.full_row(f)).collect();
            let offered = steps.iter().find_map(|&step| {
                let taken = |row: &Row| self.offer(row, step, start);
                let found = rows.iter().enumerate();
                found.filter_map(|(at, row)| Some((at, taken(row)?))).next()
            });
            let (at, speeds) = match offered {
                Some(found) => found,
                // What is satisfied already takes nothing.
                None => {
                    let is_satisfied = |row: &Row| {
                        let mut all = row.coefficients.iter().chain([&row.rest]);
                        all.all(|&e| self.g.is_zero(e))
                    };
                    left.remove(rows.iter().position(is_satisfied)?);
                    continue;
                }
            };
            self.take(&rows[at], speeds);
            left.remove(at);
        }
        Some(self)
    }

    /// The velocities of two coordinates along and across the direction `angle` in the place of both.
    pub(crate) fn turned(mut self, [i, j]: [usize; 2], angle: Expr) -> Elimination<'a> {
        let g = self.g;
        let (s, c) = (g.sin(angle), g.cos(angle));
        let (one, other) = (self.speeds[i].definition, self.speeds[j].definition);
        let names = ["along", "across"].map(|way| format!("speed {way} {}", g.text(angle)));
        let forms = [[c, s], [g.neg(s), c]];
        let speeds = names.iter().zip(forms).map(|(name, [a, b])| {
            let definition = g.add(&[g.mul(&[a, one]), g.mul(&[b, other])]);
            new_speed(g, name, definition)
        });
        let speeds: Vec<Parameter> = speeds.collect();
        let (u, w) = (speeds[0].value, speeds[1].value);
        self.velocities[i] = g.sub(g.mul(&[c, u]), g.mul(&[s, w]));
        self.velocities[j] = g.add(&[g.mul(&[s, u]), g.mul(&[c, w])]);
        for (at, speed) in [i, j].into_iter().zip(speeds) {
            self.speeds[at] = speed;
        }
        self
    }

    /// A constraint with the coefficients of all speeds made short.
    fn full_row(&self, f: Expr) -> Row {
        let g = self.g;
        let places = self.system.coordinates.iter().zip(&self.velocities);
        let pairs: Vec<(Expr, Expr)> = places.map(|(c, &v)| (c.v, v)).collect();
        let own = g.substitute(f, &pairs);
        let symbols: Vec<Symbol> = self.speeds.iter().map(|p| p.symbol).collect();
        let at_rest: Vec<(Expr, Expr)> = self.speeds.iter().map(|p| (p.value, g.zero())).collect();
        let mut all = g.gradient(own, &symbols);
        all.push(g.substitute(own, &at_rest));
        let mut short = simplify_all(g, &all, &Options::default());
        let rest = short.pop().unwrap_or(g.zero());
        Row {
            coefficients: short,
            doubled: Vec::new(),
            rest,
        }
    }

    fn offer(&self, row: &Row, step: Step, start: &Start) -> Option<Taken> {
        match step {
            Step::Constant => self.pivot(row).map(Taken::One),
            Step::Rotation => {
                let (places, square) = self.rotation(row)?;
                Some(Taken::Turned(places, square))
            }
            Step::Along => self.direction(row, start),
            Step::Nonvanishing => self.nonvanishing(row, start).map(Taken::One),
        }
    }

    fn take(&mut self, row: &Row, taken: Taken) {
        match taken {
            Taken::One(place) => self.eliminate(row, place),
            Taken::Turned(places, square) => self.rotate(row, places, square),
            Taken::Along(places, parts) => self.go_along(places, parts),
        }
        self.velocities = simplify_all(self.g, &self.velocities, &Options::default());
    }

    /// `p P_i + q P_j = 0` with `p/q = n/d`: the direction (d, −n), where both change and do not vanish together at the start.
    fn direction(&self, row: &Row, start: &Start) -> Option<Taken> {
        let g = self.g;
        let own: Vec<usize> = (0..row.coefficients.len())
            .filter(|&s| !g.is_zero(row.coefficients[s]))
            .collect();
        let [i, j] = own[..] else { return None };
        if !g.is_zero(row.rest) {
            return None;
        }
        let ratio = g.div(row.coefficients[i], row.coefficients[j]);
        let ratio = simplify_all(g, &[ratio], &Options::default())[0];
        let (n, d) = self.fraction(ratio);
        let square = g.add(&[g.powi(n, 2), g.powi(d, 2)]);
        let changes = ![n, d].iter().any(|&e| self.is_constant(e));
        (changes && start.is_nonzero(g, square)).then_some(Taken::Along([i, j], [d, g.neg(n)]))
    }

    /// Numerator and denominator as they are written.
    fn fraction(&self, e: Expr) -> (Expr, Expr) {
        let g = self.g;
        let is_below = |e: &Expr| {
            let exponent = g.as_number(g.base_exponent(*e).1);
            exponent.is_some_and(rational::is_negative)
        };
        let factors = match g.node(e) {
            Node::Product { factors, .. } => factors.to_vec(),
            _ => vec![e],
        };
        let below: Vec<Expr> = factors.into_iter().filter(is_below).collect();
        let d = g.div(g.one(), g.mul(&below));
        (g.mul(&[e, d]), d)
    }

    /// The speed whose coefficient does not vanish at the start and leaves the shortest formulas.
    fn nonvanishing(&self, row: &Row, start: &Start) -> Option<usize> {
        let g = self.g;
        let own = (0..row.coefficients.len()).filter(|&s| {
            !g.is_zero(row.coefficients[s]) && start.is_nonzero(g, row.coefficients[s])
        });
        own.min_by_key(|&s| {
            let others = row.coefficients.iter().filter(|&&e| !g.is_zero(e));
            let quotients: Vec<Expr> = others.map(|&e| g.div(e, row.coefficients[s])).collect();
            let short = simplify_all(g, &quotients, &Options::default());
            let length = short
                .iter()
                .map(|&e| chetaev_symbolic::simplify::length(g, e));
            (length.sum::<u64>(), std::cmp::Reverse(s))
        })
    }

    /// `P_i = a P`, `P_j = b P`.
    fn go_along(&mut self, [i, j]: [usize; 2], [a, b]: [Expr; 2]) {
        let g = self.g;
        let (one, other) = (&self.speeds[i], &self.speeds[j]);
        let name = format!("rate along {} {}", one.name, other.name);
        let square = g.add(&[g.powi(a, 2), g.powi(b, 2)]);
        let square = simplify_all(g, &[square], &Options::default())[0];
        let along = g.add(&[g.mul(&[a, one.definition]), g.mul(&[b, other.definition])]);
        let speed = new_speed(g, &name, g.div(along, square));
        let pairs = [
            (one.value, g.mul(&[a, speed.value])),
            (other.value, g.mul(&[b, speed.value])),
        ];
        self.velocities = g.substitute_all(&self.velocities, &pairs);
        self.speeds[i] = speed;
        self.speeds.remove(j);
    }

    /// Of all rows; `None` where one offers nothing.
    pub(crate) fn of(
        system: &'a System,
        terms: &MotionTerms,
        rows: &[usize],
        (writing, dividing): (Writing, Dividing),
    ) -> Option<Elimination<'a>> {
        let mut own = Elimination::new(system, writing);
        own.stated = match dividing {
            Dividing::Nonzero => None,
            Dividing::NonzeroAsStated => Some(Start::of(system)),
        };
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

    pub(crate) fn new(system: &'a System, writing: Writing) -> Elimination<'a> {
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
            stated: None,
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
                // Several velocities may be one speed: after x' = y', both are.
                Some(place) => {
                    let sum = g.add(&[coefficients[place], coefficient]);
                    coefficients[place] = simplify_all(g, &[sum], &Options::default())[0];
                }
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
    pub(crate) fn pivot(&self, row: &Row) -> Option<usize> {
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
    pub(crate) fn is_constant(&self, e: Expr) -> bool {
        let g = self.g;
        let is_parameter = |s: &Symbol| {
            self.system
                .parameters
                .iter()
                .any(|p| g.as_symbol(p.expr) == Some(*s))
        };
        let is_stated = || self.stated.as_ref().is_some_and(|own| own.is_nonzero(g, e));
        g.symbols_in(&[e]).iter().all(is_parameter)
            && (known_sign(g, e, &self.assumptions).is_nonzero() || is_stated())
    }

    pub(crate) fn eliminate(&mut self, row: &Row, place: usize) {
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
    pub(crate) fn rotation(&self, row: &Row) -> Option<([usize; 2], Expr)> {
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
            if self.changes_by_sample(square) {
                continue;
            }
            let square = simplify_all(g, &[square], &Options::default())[0];
            if self.is_constant(square) {
                return Some(([i, j], square));
            }
        }
        None
    }

    /// Whether values at two places differ by more than rounding. The sums of a long chain are not simplified to see that they change.
    fn changes_by_sample(&self, e: Expr) -> bool {
        let g = self.g;
        let symbols = g.symbols_in(&[e]);
        let mut generator = Generator::new(0x524f_5441);
        let parameters = self.system.parameters.iter();
        let parameters: Vec<Symbol> = parameters.filter_map(|p| g.as_symbol(p.expr)).collect();
        let mut drawn = || -> BTreeMap<Symbol, f64> {
            let own = symbols.iter();
            own.map(|&s| (s, generator.between(0.5, 1.5))).collect()
        };
        let (first, mut second) = (drawn(), drawn());
        for s in &parameters {
            second.extend(first.get(s).map(|&value| (*s, value)));
        }
        let value = |at: &BTreeMap<Symbol, f64>| {
            let found = g.evaluate_f64(&[e], &|s| at.get(&s).copied()).ok()?;
            found.first().copied().filter(|x| x.is_finite())
        };
        let values = value(&first).zip(value(&second));
        values.is_some_and(|(a, b)| (a - b).abs() > 1e-6 * (a.abs() + b.abs()))
    }

    /// `P_i = −q u − p h`, `P_j = p u − q h` with `h = (what is left of f)/(p² + q²)`.
    pub(crate) fn rotate(&mut self, row: &Row, [i, j]: [usize; 2], square: Expr) {
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
        let name = format!("speed along {} {}", one.name, other.name);
        let definition = g.sub(g.mul(&[p, other.definition]), g.mul(&[q, one.definition]));
        let speed = new_speed(g, &name, g.div(definition, square));
        let along = |a: Expr, b: Expr| g.sub(g.mul(&[a, speed.value]), g.mul(&[b, h]));
        let pairs = [(one.value, along(g.neg(q), p)), (other.value, along(p, q))];
        self.velocities = g.substitute_all(&self.velocities, &pairs);
        self.speeds[i] = speed;
        self.speeds.remove(j);
    }
}

/// What a constraint takes.
enum Taken {
    One(usize),
    Turned([usize; 2], Expr),
    Along([usize; 2], [Expr; 2]),
}

/// A speed with a name that contains a space, as no name of a model does.
pub(crate) fn new_speed(g: &Graph, name: &str, definition: Expr) -> Parameter {
    Parameter {
        name: name.to_owned(),
        value: g.symbol(name, 0),
        rate: g.symbol(name, 1),
        symbol: g.intern_symbol(name, 0),
        rate_symbol: g.intern_symbol(name, 1),
        definition,
    }
}
