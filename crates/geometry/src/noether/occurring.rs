//! What occurs in a system: angles, roots, exponentials, reciprocals, the roots of what divides accelerations, and the functions of
//! (t, q) that are letters because of them.

use super::family::{CoefficientLetter, Letter, ANY};
use super::letters::{Letters, Polar};
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::{sample, Characteristics, Context, System};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{simplify, Expr, Function, Node, Symbol};

/// Integrals quadratic in the velocities of a particle in Cartesian coordinates contain no higher multiples of a polar angle.
const MULTIPLES: i64 = 2;

/// What the logarithm of a mass counts: integrals without logarithms come before those with them.
const LOGARITHM: u32 = 3;

/// The largest order of a mass matrix whose determinant is looked at.
const DETERMINANT: usize = 4;

/// The largest factor of a determinant, in nodes, whose root is a letter.
const FACTOR: usize = 60;

/// Its longest, as it is written.
const LENGTH: u64 = 100;

/// What occurs in a system, apart from velocities.
pub(super) struct Occurring<'a> {
    system: &'a System,
    angles: Vec<Expr>,
    /// Arguments of hyperbolic functions.
    hyperbolic: Vec<Expr>,
    /// Tangents, circular and hyperbolic, and logarithms.
    others: Vec<Expr>,
    roots: Vec<Expr>,
    /// Roots of the factors of the determinant of the mass matrix.
    measure: Vec<Expr>,
    exponentials: Vec<Expr>,
    reciprocals: Vec<Expr>,
}

impl<'a> Occurring<'a> {
    pub(super) fn in_roots(system: &'a System, roots: &[Expr]) -> Occurring<'a> {
        let g = &system.graph;
        let mut found = Occurring {
            system,
            angles: Vec::new(),
            hyperbolic: Vec::new(),
            others: Vec::new(),
            roots: Vec::new(),
            measure: Vec::new(),
            exponentials: Vec::new(),
            reciprocals: Vec::new(),
        };
        for e in g.reachable(roots) {
            match g.node(e) {
                Node::Apply {
                    function,
                    arguments,
                } => match (function, &**arguments) {
                    (function, &[angle]) if function.is_circular() && found.is_of_place(angle) => {
                        if matches!(function, Function::Tan | Function::Cot) {
                            insert(&mut found.others, e);
                        }
                        found.angle(angle)
                    }
                    (Function::Sinh | Function::Cosh | Function::Tanh, &[x])
                        if found.is_of_place(x) =>
                    {
                        if matches!(function, Function::Tanh) {
                            insert(&mut found.others, e);
                        }
                        insert(&mut found.hyperbolic, x)
                    }
                    (Function::Log, &[x]) if found.is_of_place(x) => insert(&mut found.others, e),
                    (Function::Exp, &[x]) if found.is_of_place(x) => {
                        insert(&mut found.exponentials, e)
                    }
                    _ => {}
                },
                Node::Power { base, exponent } if found.is_of_place(*base) => {
                    match g.as_number(*exponent) {
                        Some(r) if !r.is_int() => {
                            let root = Chosen::root(system, *base, e);
                            insert(&mut found.roots, root);
                        }
                        Some(_) if g.as_integer(*exponent).is_some_and(|n| n < 0) => {
                            insert(&mut found.reciprocals, *base);
                        }
                        _ => {}
                    }
                }
                _ => {}
            }
        }
        found.order();
        found
    }

    fn order(&mut self) {
        let g = &self.system.graph;
        for list in [
            &mut self.angles,
            &mut self.hyperbolic,
            &mut self.others,
            &mut self.roots,
            &mut self.exponentials,
            &mut self.reciprocals,
        ] {
            list.sort_by_key(|&e| g.text(e));
        }
    }

    /// Whether an expression depends on (t, q) and on no velocity.
    fn is_of_place(&self, e: Expr) -> bool {
        let g = &self.system.graph;
        let moves = |s: Symbol| g.symbol_name(s) == "t" || self.system.moves(g.symbol_name(s));
        !g.is_free_of(e, &moves)
            && g.is_free_of(e, &|s| {
                self.system.coordinate_index(g.symbol_name(s)).is_some() && g.symbol_order(s) > 0
            })
    }

    /// An argument of a sine: the coordinates of an integer combination are angles by themselves.
    fn angle(&mut self, argument: Expr) {
        let g = &self.system.graph;
        let is_coordinate = |e: Expr| {
            let symbol = g.as_symbol(e);
            symbol.is_some_and(|s| self.system.coordinate_index(g.symbol_name(s)).is_some())
        };
        let parts: Vec<Expr> = match g.node(argument) {
            Node::Sum { terms, .. }
                if terms.iter().all(|(e, c)| is_coordinate(*e) && c.is_int()) =>
            {
                terms.iter().map(|(e, _)| *e).collect()
            }
            Node::Product {
                coefficient,
                factors,
            } if coefficient.is_int() && factors.len() == 1 && is_coordinate(factors[0]) => {
                factors.to_vec()
            }
            _ => vec![argument],
        };
        parts
            .into_iter()
            .for_each(|part| insert(&mut self.angles, part));
    }

    /// The roots of the factors of the determinant of the restricted mass matrix: denominators of the accelerations, whose
    /// roots occur in integrals linear in the velocities as in the densities of invariant measures.
    pub(super) fn roots_of_measure(&mut self, cx: &Context<'_>) {
        let (system, g) = (cx.system, &cx.system.graph);
        let chart = Characteristics::independent_velocities(system, cx.terms, cx.selection);
        let Ok(chart) = chart else { return };
        let velocities = system.velocity_symbols();
        let mass = &cx.terms.mass_matrix;
        if chart.k() > DETERMINANT || g.any_contains_any(&chart.basis.concat(), &velocities) {
            return;
        }
        let restricted = congruent(system, mass, &chart.basis);
        let det = determinant(g, &restricted);
        let Some(list) = factors(g, det, &system.coordinate_symbols()) else {
            return;
        };
        for (factor, power) in list {
            let simple = matches!(g.node(factor), Node::Symbol(_) | Node::Apply { .. });
            let small =
                g.reachable(&[factor]).len() <= FACTOR && simplify::length(g, factor) <= LENGTH;
            let wanted = power % 2 == 1 && !simple && small && self.is_of_place(factor);
            if wanted && !self.vanishes_at_a_corner(factor) {
                let root = g.sqrt(self.positive(cx, factor));
                insert(&mut self.measure, root);
            }
        }
    }

    /// Coordinates by which the constraints divide when they are solved, as x in `x z' = z x'` of z/x = c.
    pub(super) fn divisors(&mut self, cx: &Context<'_>) {
        let (system, g) = (cx.system, &cx.system.graph);
        let chart = Characteristics::independent_velocities(system, cx.terms, cx.selection);
        let Ok(chart) = chart else { return };
        for e in g.reachable(&chart.velocities) {
            let Node::Power { base, exponent } = g.node(e) else {
                continue;
            };
            let divides = g.as_integer(*exponent).is_some_and(|n| n < 0);
            let is_coordinate = system.coordinates.iter().any(|c| c.q == *base);
            if divides && is_coordinate && !self.angles.contains(base) {
                insert(&mut self.reciprocals, *base);
            }
        }
    }

    /// Whether a factor vanishes where all angles are multiples of a right angle, as 1 - cos θ does, half of sin² θ: such
    /// factors come in pairs whose product is a square.
    fn vanishes_at_a_corner(&self, factor: Expr) -> bool {
        let g = &self.system.graph;
        [(0, 1), (1, 0), (0, -1), (-1, 0)]
            .iter()
            .any(|&(sin, cos)| {
                let pairs: Vec<(Expr, Expr)> = self
                    .angles
                    .iter()
                    .flat_map(|&a| [(g.sin(a), g.integer(sin)), (g.cos(a), g.integer(cos))])
                    .collect();
                g.is_zero(g.substitute(factor, &pairs))
            })
    }

    /// The factor or its negative, whichever is positive at a sampled state; where parameters have no values, for small ones near the
    /// origin.
    fn positive(&self, cx: &Context<'_>, factor: Expr) -> Expr {
        let g = &cx.system.graph;
        let at = |value: &dyn Fn(Symbol) -> Option<f64>| {
            let values = g.evaluate_f64(&[factor], value);
            values.ok()?.first().copied()
        };
        let valued = g.substitute(factor, &self.system.parameter_values());
        let parameters = self.system.parameters.iter();
        let mut parameters = parameters.filter_map(|p| g.as_symbol(g.symbol(&p.name, 0)));
        let is_free = parameters.any(|s| g.contains_any(valued, &[s]));
        let value = match is_free {
            true => at(&|s| Some(SMALL / (1.0 + g.symbol_name(s).len() as f64))),
            false => sample::admissible_point(self.system, cx.terms, 0x6e_6f_65)
                .and_then(|point| at(&|s| point.get(&s).copied())),
        };
        match value.is_some_and(|v| v < 0.0) {
            true => g.neg(factor),
            false => factor,
        }
    }

    /// The letters of the coefficients; velocities and known functions are left empty.
    pub(super) fn letters(&self) -> Letters {
        let g = &self.system.graph;
        let letter = |e: Expr, exponents: (i8, i8), weight: u32| CoefficientLetter {
            letter: Letter::plain(e),
            exponents,
            weight,
        };
        let circle = |angle: Expr| {
            [
                letter(g.sin(angle), (0, ANY), 1),
                letter(g.cos(angle), (0, 1), 1),
            ]
        };
        let plain_weight = match self.angles.is_empty() && self.hyperbolic.is_empty() {
            true => 1,
            false => 2,
        };
        let hyperbola = |x: Expr| {
            let value = |function| g.apply(function, &[x]);
            [
                letter(value(Function::Sinh), (0, ANY), 1),
                letter(value(Function::Cosh), (0, 1), 1),
            ]
        };
        let mut all: Vec<CoefficientLetter> = Vec::new();
        self.angles
            .iter()
            .for_each(|&angle| all.extend(circle(angle)));
        self.hyperbolic
            .iter()
            .for_each(|&x| all.extend(hyperbola(x)));
        let first_turning = all.len();
        for c in &self.system.coordinates {
            if self.system.angles.contains(&c.name) && !self.angles.contains(&c.q) {
                all.extend(circle(c.q));
            }
        }
        let circular = all.len();
        for &root in self.roots.iter().chain(&self.measure) {
            all.push(letter(root, (-1, 1), 1));
        }
        let first_stated = all.len();
        let moves = |s: Symbol| g.symbol_name(s) == "t" || self.system.moves(g.symbol_name(s));
        for &e in &self.system.search_functions {
            // A constant says nothing, and the powers of zero have no values.
            let is_constant = g.is_free_of(e, &moves);
            let is_known = all.iter().any(|own| own.letter.value == e)
                || self.exponentials.contains(&e)
                || self.others.contains(&e);
            if !is_constant && !is_known {
                all.push(letter(e, (-1, 2), 1));
            }
        }
        let stated = first_stated..all.len();
        for &e in &self.exponentials {
            all.push(letter(e, (-2, 2), 1));
        }
        for &e in &self.others {
            all.push(letter(e, (0, 2), 1));
        }
        for control in &self.system.controls {
            all.push(letter(g.symbol(&control.name, 0), (0, 2), 1));
        }
        for c in &self.system.coordinates {
            match self.angles.contains(&c.q) {
                true => all.push(letter(c.q, (0, 1), 3)),
                false => all.push(letter(c.q, (0, ANY), plain_weight)),
            }
        }
        for &e in &self.reciprocals {
            all.push(letter(g.powi(e, -1), (0, ANY), 1));
        }
        for mass in &self.system.masses {
            all.push(letter(mass.expr, (-1, ANY), 1));
        }
        for mass in self.varying_masses() {
            all.push(letter(g.apply(Function::Log, &[mass]), (0, 1), LOGARITHM));
        }
        all.push(letter(g.symbol("t", 0), (0, ANY), 2));
        let usual = all.len();
        self.perhaps_angles()
            .into_iter()
            .for_each(|q| all.extend(circle(q)));
        // Where hyperbolic functions of one coordinate occur, fields may grow with others: exp(±x) in the hyperbolic plane.
        if !self.hyperbolic.is_empty() {
            let free = self.absent().map(|c| (&c.name, c.q));
            let free = free.filter(|(name, _)| !self.system.angles.contains(*name));
            free.for_each(|(_, q)| all.extend(hyperbola(q)));
        }
        let turning_end = all.len();
        let mut polar = Vec::new();
        for coordinate in self.polar_angles() {
            let first = all.len();
            for k in 1..=MULTIPLES {
                let angle = g.mul(&[g.integer(k), coordinate]);
                all.extend([g.cos(angle), g.sin(angle)].map(|e| letter(e, (0, 0), 1)));
            }
            polar.push(Polar {
                coordinate,
                places: (first..all.len()).collect(),
            });
        }
        Letters {
            velocities: Vec::new(),
            polar,
            turning: (first_turning..circular).collect(),
            circular,
            stated: stated.collect(),
            perhaps_turning: (usual..turning_end).collect(),
            coefficients: all,
            known: Vec::new(),
            momenta: Vec::new(),
        }
    }

    /// Masses that change with the time, by a law of their own too. Their logarithms occur in integrals as in Tsiolkovsky's: a
    /// relative velocity u gives `v' = u m'/m`.
    fn varying_masses(&self) -> Vec<Expr> {
        let own = self.system.masses.iter().map(|m| m.expr);
        let named = self.system.mass_functions.iter().map(|(_, value)| *value);
        let mut masses = Vec::new();
        for mass in own
            .chain(named)
            .chain(self.system.particles.iter().map(|p| p.mass))
        {
            let own = self.system.coordinate_symbols();
            if self.is_of_place(mass) && !self.system.graph.contains_any(mass, &own) {
                insert(&mut masses, mass);
            }
        }
        masses
    }

    /// Coordinates that occur nowhere, where others occur in sines and the model gives no unit of an angle.
    fn perhaps_angles(&self) -> Vec<Expr> {
        let turns = !(self.angles.is_empty() && self.hyperbolic.is_empty());
        if !turns || !self.system.angles.is_empty() {
            return Vec::new();
        }
        self.absent().map(|c| c.q).collect()
    }

    /// Coordinates that neither L nor forces nor constraints contain.
    fn absent(&self) -> impl Iterator<Item = &Coordinate> {
        let (system, g) = (self.system, &self.system.graph);
        let mut roots = vec![system.lagrangian];
        roots.extend(&system.forces);
        roots.extend(system.constraints.iter().map(|c| c.f));
        let all = system.coordinates.iter();
        all.filter(move |c| !g.any_contains_any(&roots, &[c.q_symbol]))
    }

    /// Those of them that are polar angles: ∂²L/∂v² contains a coordinate that is no angle. Where the model says by units which
    /// coordinates are angles, only these.
    fn polar_angles(&self) -> Vec<Expr> {
        let (system, g) = (self.system, &self.system.graph);
        let lengths = system
            .coordinates
            .iter()
            .filter(|c| !self.angles.contains(&c.q));
        let lengths: Vec<Symbol> = lengths.map(|c| c.q_symbol).collect();
        let is_polar = |c: &&Coordinate| {
            let inertia = g.diff(g.diff(system.lagrangian, c.v_symbol), c.v_symbol);
            let is_angle = system.angles.is_empty() || system.angles.contains(&c.name);
            is_angle && g.contains_any(inertia, &lengths)
        };
        self.absent().filter(is_polar).map(|c| c.q).collect()
    }
}

/// Bᵀ W B.
pub(crate) fn congruent(
    system: &System,
    mass: &[Vec<Expr>],
    basis: &[Vec<Expr>],
) -> Vec<Vec<Expr>> {
    let g = &system.graph;
    let (n, k) = (basis.len(), basis.first().map_or(0, Vec::len));
    let entry = |s: usize, u: usize| {
        let mut parts = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let product = [basis[i][s], mass[i][j], basis[j][u]];
                if product.iter().all(|&e| !g.is_zero(e)) {
                    parts.push(g.mul(&product));
                }
            }
        }
        g.add(&parts)
    };
    (0..k)
        .map(|s| (0..k).map(|u| entry(s, u)).collect())
        .collect()
}

fn insert(list: &mut Vec<Expr>, e: Expr) {
    if !list.contains(&e) {
        list.push(e);
    }
}

/// The size of numbers near zero for parameters without values.
const SMALL: f64 = 0.1;

/// What stands for a power with a fraction as exponent.
struct Chosen;

impl Chosen {
    /// base^(1/q) for base^(p/q).
    fn root(system: &System, base: Expr, power: Expr) -> Expr {
        let g = &system.graph;
        let (_, exponent) = g.base_exponent(power);
        let denominator = g.as_number(exponent).map(|r| r.denominator().clone());
        match denominator {
            Some(d) => g.pow(
                base,
                g.number(chetaev_symbolic::Rational::from_parts(1.into(), d)),
            ),
            None => power,
        }
    }
}
