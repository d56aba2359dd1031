//! The families of a system, from what occurs in it (T3 §7): letters of the velocities, and functions of (t, q) for the
//! coefficients.

use super::family::{coefficients, monomials, product, CoefficientLetter, Family, Letter, Member};
use super::motion::{draw_with_points, Motion};
use chetaev_mechanics::{sample, Characteristics, Context, Frame, System};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{simplify, Expr, Function, Node, Symbol};

/// The letters of a system.
#[derive(Clone, Debug)]
pub struct Letters {
    /// Of degree one in the velocities: independent (quasi-)velocities first.
    pub velocities: Vec<Letter>,
    /// Functions of (t, q).
    pub coefficients: Vec<CoefficientLetter>,
    /// Places in `coefficients` of the sines and cosines of angles that occur nowhere, which stand in linear integrals only.
    pub turning: Vec<usize>,
    /// So many of `coefficients` at the beginning are sines and cosines.
    circular: usize,
    /// Places at the end of `coefficients` of the sines and cosines of coordinates that occur nowhere and may be angles, where the model
    /// gives no units; they stand in a family of their own.
    pub perhaps_turning: Vec<usize>,
    /// Functions that are members by themselves, with their names: the energy, and the momenta of coordinates that L does not
    /// contain.
    pub known: Vec<(String, Letter)>,
}

/// The name of the energy among the known functions.
pub const ENERGY: &str = "the energy";

/// The largest order of a mass matrix whose determinant is looked at.
const DETERMINANT: usize = 4;

/// The largest factor of a determinant, in nodes, whose root is a letter.
const FACTOR: usize = 30;

/// Its longest, as it is written.
const LENGTH: u64 = 40;

impl Letters {
    /// The letters of the context's system.
    pub fn of(cx: &Context<'_>) -> Letters {
        let system = cx.system;
        let velocities = velocities(cx);
        let mut roots = vec![system.lagrangian];
        roots.extend(&system.forces);
        roots.extend(system.constraints.iter().map(|c| c.f));
        roots.extend(velocities.iter().map(|l| l.value));
        let mut found = Occurring::in_roots(system, &roots);
        found.roots_of_measure(cx);
        found.divisors(cx);
        Letters {
            velocities,
            known: known(cx),
            ..found.letters()
        }
    }

    /// The letters of the coefficients, those of another family with no power but 0.
    fn usual(&self) -> Vec<CoefficientLetter> {
        let mut usual = self.coefficients.clone();
        for &place in &self.perhaps_turning {
            usual[place].exponents = (0, 0);
        }
        usual
    }

    /// The polynomials of degree one in the velocities whose coefficients are made of sines and cosines, those of coordinates that
    /// may be angles too, of weight up to `weight`; `None` where there are no such coordinates.
    pub fn turned(&self, weight: u32) -> Option<Family> {
        let (&first, count) = (self.perhaps_turning.first()?, self.velocities.len());
        let mut letters = self.coefficients.clone();
        for letter in &mut letters[self.circular..first] {
            letter.exponents = (0, 0);
        }
        let functions = coefficients(&letters, count, weight);
        let mut members: Vec<Member> = functions.iter().map(|(_, f)| f.clone()).collect();
        for (_, function) in &functions {
            let own = monomials(count, 1).into_iter();
            members.extend(own.map(|monomial| product(&monomial, function)));
        }
        Some(Family {
            letters: self.all(),
            members,
            words: String::new(),
        })
    }

    /// Functions of (t, q): monomials of weight up to `weight`.
    pub fn functions(&self, system: &System, weight: u32) -> Vec<Expr> {
        let g = &system.graph;
        let value = |&(letter, exponent): &(usize, i8)| {
            let base = self.coefficients[letter].letter.value;
            g.powi(base, i64::from(exponent))
        };
        coefficients(&self.usual(), 0, weight)
            .iter()
            .map(|(_, member)| g.mul(&member.iter().map(value).collect::<Vec<Expr>>()))
            .collect()
    }

    /// Whether a letter of the coefficients belongs to the family of [`turned`](Letters::turned).
    pub fn is_turned(&self, place: usize) -> bool {
        place < self.circular || self.perhaps_turning.contains(&place)
    }

    /// The letters without roots, where these leave no points over a prime field.
    #[must_use]
    pub fn without_roots(&self, system: &System) -> Letters {
        let mut without = self.clone();
        let before = self.coefficients.len();
        without.coefficients.retain(|c| {
            let (_, exponent) = system.graph.base_exponent(c.letter.value);
            system.graph.as_integer(exponent).is_some()
        });
        // Roots stand after the first sines and cosines, and before the last ones.
        let gone = before - without.coefficients.len();
        without
            .perhaps_turning
            .iter_mut()
            .for_each(|place| *place -= gone);
        without
    }

    /// The letters without velocities and known functions that vanish on the constraints, as a quasi-velocity that is a constraint
    /// does.
    ///
    /// # Errors
    /// A sentence that says why no points were found.
    pub fn without_zeros(&self, motion: &Motion<'_>, seed: u64) -> Result<Letters, String> {
        let known = self.known.iter().map(|(_, letter)| letter.value);
        let velocities = self.velocities.iter().map(|l| l.value);
        let values: Vec<Expr> = velocities.chain(known).collect();
        let points = motion.points(&values)?;
        let mut random = Random::stream(seed, 1 << 21);
        let at = draw_with_points(&points, &mut random)
            .and_then(|draw| points.at(&draw, &mut random))
            .ok_or("no points of the constraint manifold were found over a prime field")?;
        let mut without = self.clone();
        let mut kept = at.iter().map(|value| !value.is_zero());
        without.velocities.retain(|_| kept.next().unwrap_or(true));
        without.known.retain(|_| kept.next().unwrap_or(true));
        Ok(without)
    }

    /// All letters, velocities first, known functions last.
    pub fn all(&self) -> Vec<Letter> {
        let coefficients = self.coefficients.iter().map(|c| c.letter.clone());
        let known = self.known.iter().map(|(_, letter)| letter.clone());
        let velocities = self.velocities.iter().cloned();
        velocities.chain(coefficients).chain(known).collect()
    }

    /// The polynomials of degree up to `degree` in the velocities whose coefficients have weight up to `weight` in the terms of
    /// that degree, and one more for each degree less; at the end the known functions.
    pub fn polynomials(&self, degree: u32, weight: u32) -> Family {
        let count = self.velocities.len();
        let mut members: Vec<(u32, Member)> = Vec::new();
        for d in 0..=degree {
            // The terms without velocities of an integral linear in these need nothing more than the others.
            let more = if degree == 1 { 0 } else { degree - d };
            let usual = coefficients(&self.usual(), count, weight + more);
            let is_used = |(_, member): &(u32, Member)| degree == 1 || !self.is_turning(member);
            let functions: Vec<(u32, Member)> = usual.into_iter().filter(is_used).collect();
            for monomial in monomials(count, d) {
                let own = functions.iter();
                members.extend(own.map(|(w, f)| (d + w, product(&monomial, f))));
            }
        }
        // Light ones first; among these, those with fewer velocities.
        members.sort_by_key(|(weight, member)| (*weight, self.degree(member)));
        let mut members: Vec<Member> = members.into_iter().map(|(_, member)| member).collect();
        let known = count + self.coefficients.len();
        if degree >= 2 {
            members.extend((0..self.known.len()).map(|i| vec![(known + i, 1)]));
        }
        Family {
            letters: self.all(),
            members,
            words: String::new(),
        }
    }

    /// The known functions alone, for a system too large for polynomials.
    pub fn known_only(&self) -> Family {
        let first = self.velocities.len() + self.coefficients.len();
        let names: Vec<&str> = self.known.iter().map(|(name, _)| name.as_str()).collect();
        let mut members = vec![Vec::new()];
        members.extend((0..self.known.len()).map(|i| vec![(first + i, 1)]));
        Family {
            letters: self.all(),
            members,
            words: format!(
                "only {}, as polynomials in the velocities are too many",
                names.join(", ")
            ),
        }
    }

    /// Quotients of two velocities.
    pub fn quotients(&self) -> Family {
        let count = self.velocities.len();
        let mut members = vec![Vec::new()];
        for a in 0..count {
            for b in (0..count).filter(|&b| b != a) {
                members.push(product(&vec![(a, 1)], &vec![(b, -1)]));
            }
        }
        Family {
            letters: self.all(),
            members,
            words: String::new(),
        }
    }

    /// Whether a member contains the sine or cosine of a coordinate that occurs nowhere.
    fn is_turning(&self, member: &Member) -> bool {
        let first = self.velocities.len();
        let mut own = member
            .iter()
            .filter_map(|&(letter, _)| letter.checked_sub(first));
        own.any(|place| self.turning.contains(&place))
    }

    /// Whether a member contains the time.
    pub fn is_timed(&self, system: &System, member: &Member) -> bool {
        let g = &system.graph;
        let first = self.velocities.len();
        let own = member.iter().filter_map(|&(letter, _)| {
            let coefficient = letter.checked_sub(first)?;
            self.coefficients.get(coefficient)
        });
        own.into_iter()
            .any(|c| system.is_rheonomic(c.letter.value) || g.text(c.letter.value) == "t")
    }

    /// The degree of a member in the velocities.
    pub fn degree(&self, member: &Member) -> u32 {
        let known = self.velocities.len() + self.coefficients.len();
        let of_letter = |&(letter, exponent): &(usize, i8)| match letter {
            l if l < self.velocities.len() => u32::from(exponent.unsigned_abs()),
            l if l >= known => 2,
            _ => 0,
        };
        member.iter().map(of_letter).sum()
    }
}

/// The quasi-velocities of the model, or independent velocities; then the dependent velocities, in which an integral may be
/// simpler.
fn velocities(cx: &Context<'_>) -> Vec<Letter> {
    let system = cx.system;
    let natural = |i: usize| Letter::plain(system.coordinates[i].v);
    let quasi = match Frame::stated(system, cx.terms, cx.selection) {
        Some(Ok((frame, _))) => definitions(system, &frame),
        _ => Vec::new(),
    };
    if quasi.is_empty() {
        let mut all: Vec<Letter> = cx
            .selection
            .independent(system.n())
            .into_iter()
            .map(natural)
            .collect();
        all.extend(cx.selection.dependent.iter().map(|&d| natural(d)));
        return all;
    }
    let mut all = quasi;
    if all.len() < system.n() {
        all.extend(cx.selection.dependent.iter().map(|&d| natural(d)));
    }
    let mut seen: Vec<Expr> = Vec::new();
    all.retain(|letter| {
        let is_new = !seen.contains(&letter.value);
        seen.push(letter.value);
        is_new
    });
    all
}

/// The quasi-velocities that the model states, by their definitions in (q, v, t).
fn definitions(system: &System, frame: &Frame) -> Vec<Letter> {
    let stated = frame.speeds.iter().take(system.quasi_velocities.len());
    let mut letters = Vec::new();
    for (speed, quasi) in stated.zip(&system.quasi_velocities) {
        letters.push(Letter {
            value: quasi.definition,
            shown: speed.value,
        });
    }
    letters
}

/// What occurs in a system, apart from velocities.
struct Occurring<'a> {
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
    fn in_roots(system: &'a System, roots: &[Expr]) -> Occurring<'a> {
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
    fn roots_of_measure(&mut self, cx: &Context<'_>) {
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
    fn divisors(&mut self, cx: &Context<'_>) {
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

    /// The factor or its negative, whichever is positive at a sampled state.
    fn positive(&self, cx: &Context<'_>, factor: Expr) -> Expr {
        let g = &self.system.graph;
        let value = sample::admissible_point(self.system, cx.terms, 0x6e_6f_65).and_then(|point| {
            let values = g.evaluate_f64(&[factor], &|s| point.get(&s).copied());
            values.ok()?.first().copied()
        });
        match value.is_some_and(|v| v < 0.0) {
            true => g.neg(factor),
            false => factor,
        }
    }

    /// The letters of the coefficients; velocities and known functions are left empty.
    fn letters(&self) -> Letters {
        let g = &self.system.graph;
        let letter = |e: Expr, exponents: (i8, i8), weight: u32| CoefficientLetter {
            letter: Letter::plain(e),
            exponents,
            weight,
        };
        let circle = |angle: Expr| {
            [
                letter(g.sin(angle), (0, 9), 1),
                letter(g.cos(angle), (0, 1), 1),
            ]
        };
        let plain_weight = match self.angles.is_empty() && self.hyperbolic.is_empty() {
            true => 1,
            false => 2,
        };
        let mut all: Vec<CoefficientLetter> = Vec::new();
        self.angles
            .iter()
            .for_each(|&angle| all.extend(circle(angle)));
        for &x in &self.hyperbolic {
            let value = |function| g.apply(function, &[x]);
            all.push(letter(value(Function::Sinh), (0, 9), 1));
            all.push(letter(value(Function::Cosh), (0, 1), 1));
        }
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
        let moves = |s: Symbol| g.symbol_name(s) == "t" || self.system.moves(g.symbol_name(s));
        for &e in &self.system.search_functions {
            // A constant says nothing, and the powers of zero have no values.
            let is_constant = g.is_free_of(e, &moves);
            if !is_constant && !all.iter().any(|own| own.letter.value == e) {
                all.push(letter(e, (-1, 2), 1));
            }
        }
        for &e in &self.exponentials {
            all.push(letter(e, (-2, 2), 1));
        }
        for &e in &self.others {
            all.push(letter(e, (0, 2), 1));
        }
        for c in &self.system.coordinates {
            match self.angles.contains(&c.q) {
                true => all.push(letter(c.q, (0, 1), 3)),
                false => all.push(letter(c.q, (0, 9), plain_weight)),
            }
        }
        for &e in &self.reciprocals {
            all.push(letter(g.powi(e, -1), (0, 9), 1));
        }
        all.push(letter(g.symbol("t", 0), (0, 9), 2));
        let usual = all.len();
        self.perhaps_angles()
            .into_iter()
            .for_each(|q| all.extend(circle(q)));
        Letters {
            velocities: Vec::new(),
            turning: (first_turning..circular).collect(),
            circular,
            perhaps_turning: (usual..all.len()).collect(),
            coefficients: all,
            known: Vec::new(),
        }
    }

    /// Coordinates that occur nowhere, where others occur in sines and the model gives no unit of an angle.
    fn perhaps_angles(&self) -> Vec<Expr> {
        let g = &self.system.graph;
        let turns = !(self.angles.is_empty() && self.hyperbolic.is_empty());
        if !turns || !self.system.angles.is_empty() {
            return Vec::new();
        }
        let mut roots = vec![self.system.lagrangian];
        roots.extend(&self.system.forces);
        roots.extend(self.system.constraints.iter().map(|c| c.f));
        let all = self.system.coordinates.iter();
        all.filter(|c| !g.any_contains_any(&roots, &[c.q_symbol]))
            .map(|c| c.q)
            .collect()
    }
}

/// The energy, and the momenta of the coordinates that L does not contain, with their names.
fn known(cx: &Context<'_>) -> Vec<(String, Letter)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let moves = |s: Symbol| g.symbol_name(s) == "t" || system.moves(g.symbol_name(s));
    let mut values = vec![(ENERGY.to_owned(), system.energy())];
    for c in &system.coordinates {
        if !g.contains_any(system.lagrangian, &[c.q_symbol]) {
            let momentum = g.diff(system.lagrangian, c.v_symbol);
            values.push((format!("the momentum of {}", c.name), momentum));
        }
    }
    values.retain(|(_, value)| !g.is_free_of(*value, &moves));
    let shown = in_quasi_velocities(cx, &values);
    let letters = values.into_iter().zip(shown);
    letters
        .map(|((name, value), shown)| (name, Letter { value, shown }))
        .collect()
}

/// Larger functions, in nodes, are not rewritten in quasi-velocities.
const REWRITTEN: usize = 400;

/// Functions of the state as they are shown: in the quasi-velocities that the model states where that is not longer.
fn in_quasi_velocities(cx: &Context<'_>, values: &[(String, Expr)]) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let as_they_are = || values.iter().map(|(_, value)| *value).collect();
    let Some(Ok((frame, _))) = Frame::stated(system, cx.terms, cx.selection) else {
        return as_they_are();
    };
    let is_adapted = |s: usize| frame.adapted.iter().any(|&(_, speed)| speed == s);
    let speeds = frame.speeds.iter().enumerate();
    let speeds: Vec<Expr> = speeds
        .map(|(s, speed)| if is_adapted(s) { g.zero() } else { speed.value })
        .collect();
    let velocities = frame.velocities(system, &speeds);
    let own = system.coordinates.iter().map(|c| c.v);
    let pairs: Vec<(Expr, Expr)> = own.zip(velocities).collect();
    let shorter = |value: Expr| {
        let rewritten = g.substitute(value, &pairs);
        if g.reachable(&[rewritten]).len() > REWRITTEN {
            return value;
        }
        let rewritten = simplify::simplify(g, rewritten, &simplify::Options::default());
        match simplify::length(g, rewritten) <= simplify::length(g, value) {
            true => rewritten,
            false => value,
        }
    };
    values.iter().map(|(_, value)| shorter(*value)).collect()
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
