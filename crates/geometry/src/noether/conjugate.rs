//! Families in the momenta p = ∂L/∂v, where the mass matrix depends on the place or on the velocities.
//!
//! In curvilinear coordinates integrals are short in the momenta and long in the velocities. A moment of momentum is
//! `p_θ sin φ + p_φ cot θ cos φ` in spherical coordinates, in Euler's angles and in any others in which θ and φ are such angles. A
//! system whose equation of Hamilton and Jacobi separates (Liouville, Stäckel 1891) has integrals `Σ φ_ij(q) p_i p_j + φ(q) H + ψ(q)`:
//! `p_u²/2m + p_φ²/(2 m u²) - u² H + …` in parabolic coordinates, `p_θ² + p_φ²/sin² θ` in spherical ones. Where L is not quadratic in
//! the velocities momenta take their place beside the time too: `p - F t` and `x H - c² t p` of a relativistic particle.

use super::automatic::{allowed, grown, members};
use super::family::{coefficients, monomials, product, CoefficientLetter, Family, Member};
use super::letters::{Letters, ENERGY};
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};

/// Larger systems have too many products of momenta.
const COORDINATES: usize = 4;

/// The most members of the family linear in the momenta, and of the quadratic one, for the usual work.
const MEMBERS: [usize; 2] = [260, 260];

/// Whether the mass matrix contains velocities, as where L is not quadratic in them.
fn is_of_velocities(cx: &Context<'_>) -> bool {
    let own = cx.system.velocity_symbols();
    let g = &cx.system.graph;
    g.any_contains_any(&cx.terms.mass_matrix.concat(), &own)
}

/// The momenta of the coordinates, where the mass matrix depends on the place or on the velocities.
pub(super) fn momenta(cx: &Context<'_>) -> Vec<(Symbol, Expr)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let own = system.coordinate_symbols();
    let is_curvilinear = g.any_contains_any(&cx.terms.mass_matrix.concat(), &own);
    if system.n() > COORDINATES || !(is_curvilinear || is_of_velocities(cx)) {
        return Vec::new();
    }
    let all = system.coordinates.iter();
    let all = all.map(|c| (c.q_symbol, g.diff(system.lagrangian, c.v_symbol)));
    all.filter(|(_, p)| !g.is_zero(*p)).collect()
}

/// The families linear and quadratic in the momenta, as large as the work allows.
pub(super) fn families(cx: &Context<'_>, letters: &Letters) -> Vec<Family> {
    if letters.momenta.is_empty() {
        return Vec::new();
    }
    let own = Own::of(cx, letters);
    let sizes = MEMBERS.map(|usual| allowed(cx, usual));
    let linear = grown(sizes[0], 0, |weight| own.linear(weight), members);
    // Nothing separates where constraints tie the momenta; moments of momentum are kept there too, as Veselova's.
    let is_free = cx.system.constraints.is_empty();
    let quadratic = is_free.then(|| grown(sizes[1], 0, |weight| own.quadratic(weight), members));
    let quadratic = quadratic.flatten();
    let linear = linear.map(|(weight, family)| Family {
        words: own.words(&own.turning, 1, weight),
        ..family
    });
    let quadratic = quadratic.map(|(weight, family)| Family {
        words: own.words(&own.plain, 2, weight),
        ..family
    });
    linear.into_iter().chain(quadratic).collect()
}

/// The letters of these families.
struct Own<'l> {
    system: &'l System,
    letters: &'l Letters,
    /// Letters of the quadratic family: what occurs, with negative powers of what the determinant of the mass matrix vanishes with.
    plain: Vec<CoefficientLetter>,
    /// The same with sines and cosines of coordinates that occur nowhere.
    turning: Vec<CoefficientLetter>,
    /// The number of the first momentum and of the energy among all letters.
    first: usize,
    energy: Option<usize>,
    /// Which momenta belong to coordinates that L does not contain.
    cyclic: Vec<bool>,
    /// Whether the time and products with the energy are in the linear family.
    is_timed: bool,
}

impl<'l> Own<'l> {
    fn of(cx: &Context<'l>, letters: &'l Letters) -> Own<'l> {
        let (system, g) = (cx.system, &cx.system.graph);
        let below = divisors(cx);
        let known = letters.velocities.len() + letters.coefficients.len();
        let energy = letters.known.iter().position(|(name, _)| name == ENERGY);
        let contains = |&q: &Symbol| g.contains_any(system.lagrangian, &[q]);
        let mut plain = letters.coefficients.clone();
        for (place, c) in plain.iter_mut().enumerate() {
            c.exponents = exponents(system, letters, (place, c), &below);
            c.weight = 1;
        }
        let mut turning = plain.clone();
        // Coordinates that occur nowhere stand in linear integrals, by themselves or by their sines; fields are of low degree.
        for (place, c) in turning.iter_mut().enumerate() {
            let turns = |q: Expr| {
                let perhaps = letters.perhaps_turning.iter();
                let mut values = perhaps.map(|&i| letters.coefficients[i].letter.value);
                letters.polar.iter().any(|p| p.coordinate == q) || values.any(|e| e == g.cos(q))
            };
            let (least, most) = c.exponents;
            // Roots that stand in densities are in no momentum about an axis.
            let (_, power) = g.base_exponent(c.letter.value);
            let is_root = !system.constraints.is_empty() && g.as_integer(power).is_none();
            c.exponents = match is_root || turns(letters.coefficients[place].letter.value) {
                true => (0, 0),
                false => (least.max(-1), most.min(1)),
            };
        }
        for c in &mut plain {
            let own = letters.momenta.iter();
            let mut absent = own.filter(|(q, _)| !contains(q));
            if absent.any(|(q, _)| g.symbol_expr(*q) == c.letter.value) {
                c.exponents = (0, 0);
            }
        }
        for &place in &letters.perhaps_turning {
            turning[place].exponents = (0, 1);
        }
        for polar in &letters.polar {
            let cosine = g.cos(polar.coordinate);
            let mut perhaps = letters.perhaps_turning.iter();
            if perhaps.any(|&i| letters.coefficients[i].letter.value == cosine) {
                continue;
            }
            for &place in polar.places.iter().take(2) {
                turning[place].exponents = (0, 1);
            }
        }
        let is_timed = is_of_velocities(cx);
        if is_timed {
            let time = g.symbol("t", 0);
            let mut own = turning.iter_mut();
            if let Some(c) = own.find(|c| c.letter.value == time) {
                c.exponents = (0, 1);
            }
        }
        Own {
            is_timed,
            system,
            letters,
            plain,
            turning,
            first: known + letters.known.len(),
            energy: energy.map(|i| known + i),
            cyclic: letters.momenta.iter().map(|(q, _)| !contains(q)).collect(),
        }
    }

    fn family(&self, members: Vec<Member>) -> Family {
        let mut family = Family {
            letters: self.letters.all(),
            members: vec![Vec::new()],
            words: String::new(),
        };
        members.into_iter().for_each(|member| family.push(member));
        family
    }

    /// Momenta times functions of weight up to `weight`, and these functions; where L is not quadratic the energy too.
    fn linear(&self, weight: u32) -> Family {
        let functions = coefficients(&self.turning, self.letters.velocities.len(), weight);
        let mut members = Vec::new();
        for (_, function) in functions {
            let momenta = 0..self.letters.momenta.len();
            let own = momenta.map(|i| product(&vec![(self.first + i, 1)], &function));
            members.extend(own.collect::<Vec<Member>>());
            let energy = self.energy.filter(|_| self.is_timed);
            members.extend(energy.map(|i| product(&vec![(i, 1)], &function)));
            members.push(function);
        }
        self.family(members)
    }

    /// Products of two momenta, the energy, and 1, times functions: of weight up to `weight` for two different momenta, of one more for
    /// squares and the energy, of three more for 1 and for squares of momenta that keep their values.
    fn quadratic(&self, weight: u32) -> Family {
        let mut leading: Vec<(u32, Member)> = Vec::new();
        for pair in monomials(self.letters.momenta.len(), 2) {
            let more = match pair[..] {
                [(i, _)] if self.cyclic[i] => 3,
                [_] => 1,
                _ => 0,
            };
            let shifted = pair.into_iter().map(|(i, e)| (self.first + i, e));
            leading.push((more, shifted.collect()));
        }
        leading.extend(self.energy.map(|i| (1, vec![(i, 1)])));
        leading.push((3, Vec::new()));
        let mut weighed: Vec<(u32, Member)> = Vec::new();
        for (more, member) in leading {
            let own = coefficients(&self.plain, self.letters.velocities.len(), weight + more);
            weighed.extend(own.iter().map(|(w, f)| (*w, product(&member, f))));
        }
        weighed.sort_by_key(|(weight, _)| *weight);
        self.family(weighed.into_iter().map(|(_, member)| member).collect())
    }

    fn words(&self, own: &[CoefficientLetter], degree: u32, weight: u32) -> String {
        let g = &self.system.graph;
        let names: Vec<String> = self
            .letters
            .momenta
            .iter()
            .map(|(q, _)| momentum(g, *q))
            .collect();
        let built = own.iter().filter(|c| c.exponents != (0, 0)).map(|c| {
            let text = g.text(c.letter.shown);
            match c.exponents.0 {
                0 => text,
                least => format!("{text} to the powers from {least} on"),
            }
        });
        let built = built.collect::<Vec<String>>().join(", ");
        let more = match degree {
            1 => "",
            _ => ", one more in squares and with the energy, three more in squares of momenta that keep their values and in terms without momenta",
        };
        format!(
            "polynomials of degree up to {degree} in the momenta {}{} with coefficients of weight up to {weight}{more}, built of {built}",
            names.join(", "),
            match degree {
                1 if !self.is_timed => "",
                _ => ", and in the energy,",
            },
        )
    }
}

/// The name of a momentum.
fn momentum(g: &Graph, coordinate: Symbol) -> String {
    format!("p_{}", g.symbol_name(coordinate))
}

/// Sines, cosines and coordinates of which a power divides the inverse of the mass matrix.
fn divisors(cx: &Context<'_>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let own = system.coordinate_symbols();
    let det = determinant(g, &cx.terms.mass_matrix);
    let list = factors(g, det, &own).unwrap_or_default();
    let mut found: Vec<Expr> = list.into_iter().map(|(factor, _)| factor).collect();
    // 1 - c² = s² may be there by its factors.
    for e in g.reachable(&found) {
        if let Node::Apply {
            function,
            arguments,
        } = g.node(e)
        {
            let other = match function {
                Function::Cos => g.sin(arguments[0]),
                Function::Sin => g.cos(arguments[0]),
                _ => continue,
            };
            let halves = [g.sub(e, g.one()), g.add(&[e, g.one()])];
            if halves.iter().any(|h| found.contains(h)) {
                found.push(other);
            }
        }
    }
    found
}

/// The least and the greatest power of a letter in these families.
fn exponents(
    system: &System,
    letters: &Letters,
    (place, c): (usize, &CoefficientLetter),
    below: &[Expr],
) -> (i8, i8) {
    let g = &system.graph;
    let value = c.letter.value;
    let is_timed = g.contains_any(value, &g.symbols_in(&[g.symbol("t", 0)]));
    let is_coordinate = system.coordinates.iter().any(|own| own.q == value);
    let has_waves = |e: Expr| {
        let own = &letters.coefficients[..letters.circular];
        own.iter().any(|c| c.letter.value == g.sin(e))
    };
    let (base, exponent) = g.base_exponent(value);
    let is_inverse = g.as_integer(exponent).is_some_and(|n| n < 0) && below.contains(&base);
    let left_out = letters.perhaps_turning.contains(&place)
        || letters.polar.iter().any(|p| p.places.contains(&place))
        || letters.stated.contains(&place)
        || system.is_rheonomic(value)
        || is_timed
        || is_inverse
        || is_coordinate && has_waves(value);
    match left_out {
        true => (0, 0),
        false if below.contains(&value) => (-2, c.exponents.1),
        false => c.exponents,
    }
}
