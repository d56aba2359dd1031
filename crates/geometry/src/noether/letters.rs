//! The letters of a system, and the families that are made of them (T3 §7): letters of the velocities, and functions of (t, q) for the
//! coefficients.

use super::conjugate;
use super::family::{coefficients, monomials, product, CoefficientLetter, Family, Letter, Member};
use super::motion::{draw_with_points, Motion, NO_POINTS};
use super::occurring::Occurring;
use super::written::{as_stated, degree, in_quasi_velocities};
use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::{Context, Frame, System};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{Expr, Node, Symbol};

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
    pub(super) circular: usize,
    /// Places in `coefficients` of functions that the model states for the search and that are no letters otherwise.
    pub stated: Vec<usize>,
    /// Places at the end of `coefficients` of the sines and cosines of coordinates that occur nowhere and may be angles, where the model
    /// gives no units; they stand in a family of their own.
    pub perhaps_turning: Vec<usize>,
    /// Polar angles with the places in `coefficients` of sines and cosines of their multiples, which stand in a family of their own
    /// and have no powers elsewhere.
    pub polar: Vec<Polar>,
    /// Functions that are members by themselves, with their names: the energy, and the momenta of coordinates that L does not
    /// contain.
    pub known: Vec<(String, Letter)>,
    /// Momenta ∂L/∂v with the coordinates that they belong to, for families of their own.
    pub momenta: Vec<(Symbol, Letter)>,
}

/// A coordinate that occurs nowhere and whose velocity counts more the farther out others are, as φ of `r'² + r² φ'²`: by turns of
/// it integrals go over into integrals, so they are sums of those with cos kφ and sin kφ for one k each.
#[derive(Clone, Debug)]
pub struct Polar {
    /// The coordinate.
    pub coordinate: Expr,
    /// Places of cos kφ and sin kφ for k up to 2.
    pub places: Vec<usize>,
}

/// The name of the energy among the known functions.
pub const ENERGY: &str = "the energy";

/// What the names of fixed coordinates among the known functions begin with.
pub(super) const FIXED: &str = "the coordinate";

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
        let momenta = conjugate::momenta(cx).into_iter();
        Letters {
            velocities,
            known: known(cx),
            momenta: momenta.map(|(q, p)| (q, Letter::plain(p))).collect(),
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

    /// The polynomials of degree up to two in the velocities whose terms contain the sine or cosine of a multiple of a polar angle,
    /// and the angle and the time not otherwise; weights as in [`polynomials`](Letters::polynomials).
    pub fn waves(&self, system: &System, polar: &Polar, weight: u32) -> Family {
        let (g, count) = (&system.graph, self.velocities.len());
        let mut others = self.usual();
        let own = g.symbols_in(&[polar.coordinate, g.symbol("t", 0)]);
        for letter in &mut others {
            if g.contains_any(letter.letter.value, &own) {
                letter.exponents = (0, 0);
            }
        }
        let mut members: Vec<Member> = vec![Vec::new()];
        for d in 0..=2 {
            let functions = coefficients(&others, count, weight + 2 - d);
            for monomial in monomials(count, d) {
                for (_, function) in &functions {
                    let rest = product(&monomial, function);
                    let waves = polar.places.iter().map(|&place| vec![(count + place, 1)]);
                    members.extend(waves.map(|wave| product(&rest, &wave)));
                }
            }
        }
        Family {
            letters: self.all(),
            members,
            words: String::new(),
        }
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
        self.retained(|place| {
            let (_, exponent) = system
                .graph
                .base_exponent(self.coefficients[place].letter.value);
            system.graph.as_integer(exponent).is_some()
        })
    }

    /// The letters without the functions that the model states for the search.
    #[must_use]
    pub fn without_stated(&self) -> Letters {
        self.retained(|place| !self.stated.contains(&place))
    }

    /// The letters of the coefficients at some places, all that are sines and cosines among them, with the others.
    fn retained(&self, keeps: impl Fn(usize) -> bool) -> Letters {
        let mut without = self.clone();
        let mut place = 0..self.coefficients.len();
        without
            .coefficients
            .retain(|_| place.next().is_none_or(&keeps));
        let moved = |place: usize| (0..place).filter(|&i| keeps(i)).count();
        without.stated.retain(|&place| keeps(place));
        let waves = without.polar.iter_mut().flat_map(|polar| &mut polar.places);
        let own = without.perhaps_turning.iter_mut().chain(waves);
        let own = own.chain(&mut without.stated);
        own.for_each(|place| *place = moved(*place));
        without
    }

    /// The same letters, with no powers of the functions that the model states for the search: the families of a model without them.
    #[must_use]
    pub fn usual_only(&self) -> Letters {
        let mut usual = self.clone();
        for &place in &self.stated {
            usual.coefficients[place].exponents = (0, 0);
        }
        usual
    }

    /// The letters with no powers of those that contain the time.
    #[must_use]
    pub fn without_time(&self, system: &System) -> Letters {
        let mut without = self.clone();
        let own = system.graph.symbols_in(&[system.graph.symbol("t", 0)]);
        for letter in &mut without.coefficients {
            if system.graph.contains_any(letter.letter.value, &own) {
                letter.exponents = (0, 0);
            }
        }
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
        let momenta = self.momenta.iter().map(|(_, letter)| letter.value);
        let values: Vec<Expr> = velocities.chain(known).chain(momenta).collect();
        let points = motion.points(&values)?;
        let mut random = Random::stream(seed, 1 << 21);
        let at = draw_with_points(&points, &mut random)
            .and_then(|draw| points.at(&draw, &mut random))
            .ok_or(NO_POINTS)?;
        let mut without = self.clone();
        let mut kept = at.iter().map(|value| !value.is_zero());
        without.velocities.retain(|_| kept.next().unwrap_or(true));
        without.known.retain(|_| kept.next().unwrap_or(true));
        without.momenta.retain(|_| kept.next().unwrap_or(true));
        Ok(without)
    }

    /// All letters, velocities first, then functions of (t, q), known functions, and momenta.
    pub fn all(&self) -> Vec<Letter> {
        let coefficients = self.coefficients.iter().map(|c| c.letter.clone());
        let known = self.known.iter().map(|(_, letter)| letter.clone());
        let velocities = self.velocities.iter().cloned();
        let momenta = self.momenta.iter().map(|(_, letter)| letter.clone());
        let functions = velocities.chain(coefficients);
        functions.chain(known).chain(momenta).collect()
    }

    /// The polynomials of degree up to `degree` in the velocities whose coefficients have weight up to `weight` in the terms of
    /// that degree, and one more for each degree less; at the end the known functions.
    pub fn polynomials(&self, degree: u32, weight: u32) -> Family {
        self.stepped(degree, weight, 1)
    }

    /// The same with coefficients whose weight is `step` more for each degree less.
    pub fn stepped(&self, degree: u32, weight: u32, step: u32) -> Family {
        let count = self.velocities.len();
        let mut members: Vec<(u32, Member)> = Vec::new();
        for d in 0..=degree {
            // The terms without velocities of an integral linear in these need nothing more than the others.
            let more = if degree == 1 { 0 } else { step * (degree - d) };
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

    /// Adds t, t² and t times each velocity to a family, as in t P - Σ m x; its words say so where it did not contain them.
    pub fn push_timed(&self, system: &System, family: &mut Family) {
        let time = system.graph.symbol("t", 0);
        let is_time = |c: &CoefficientLetter| c.letter.value == time && c.exponents != (0, 0);
        let Some(place) = self.coefficients.iter().position(is_time) else {
            return;
        };
        let count = self.velocities.len();
        let (time, before) = (count + place, family.members.len());
        let own = (0..count).map(|v| vec![(v, 1), (time, 1)]);
        let powers = [1, 2].map(|power| vec![(time, power)]);
        own.chain(powers).for_each(|member| family.push(member));
        if family.members.len() > before {
            family
                .words
                .push_str(", also t, t^2 and t times velocities");
        }
    }

    /// The known functions alone, for a system too large for polynomials of this degree.
    pub fn known_only(&self, degree: u32) -> Family {
        let first = self.velocities.len() + self.coefficients.len();
        let names: Vec<&str> = self.known.iter().map(|(name, _)| name.as_str()).collect();
        let mut members = vec![Vec::new()];
        members.extend((0..self.known.len()).map(|i| vec![(first + i, 1)]));
        Family {
            letters: self.all(),
            members,
            words: format!(
                "only {}, as polynomials of degree {degree} in the velocities are too many",
                names.join(", ")
            ),
        }
    }

    /// Quotients of two velocities, times functions of the coordinates of weight up to `weight`; with such functions, these alone too.
    pub fn quotients(&self, system: &System, weight: u32) -> Family {
        let count = self.velocities.len();
        let own = self.without_time(system).usual();
        let functions = coefficients(&own, count, weight);
        let mut members: Vec<Member> = functions.iter().map(|(_, f)| f.clone()).collect();
        for (_, function) in &functions {
            for a in 0..count {
                for b in (0..count).filter(|&b| b != a) {
                    let quotient = product(&vec![(a, 1)], &vec![(b, -1)]);
                    members.push(product(&quotient, function));
                }
            }
        }
        Family {
            letters: self.all(),
            members,
            words: String::new(),
        }
    }

    /// Reciprocals of velocities times functions of weight up to `weight`, and these functions, as `1/v - k t` where drag grows with v².
    pub fn reciprocals(&self, weight: u32) -> Family {
        let count = self.velocities.len();
        let functions = coefficients(&self.usual(), count, weight);
        let mut members: Vec<Member> = functions.iter().map(|(_, f)| f.clone()).collect();
        for (_, function) in &functions {
            members.extend((0..count).map(|a| product(&vec![(a, -1)], function)));
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
            l if l >= known + self.known.len() => u32::from(exponent.unsigned_abs()),
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
        // Some of them are tied by the constraints: integrals may be short in them all the same.
        _ => tied(system),
    };
    if quasi.is_empty() {
        let mut all: Vec<Letter> = cx
            .selection
            .independent(system.n())
            .into_iter()
            .map(natural)
            .collect();
        all.extend(cx.selection.dependent.iter().map(|&d| natural(d)));
        all.extend(speeds(system));
        return all;
    }
    let mut all = quasi;
    if all.len() < system.n() {
        all.extend(cx.selection.dependent.iter().map(|&d| natural(d)));
    }
    all.extend(speeds(system));
    let mut seen: Vec<Expr> = Vec::new();
    all.retain(|letter| {
        let is_new = !seen.contains(&letter.value);
        seen.push(letter.value);
        is_new
    });
    all
}

/// The quasi-velocities of a model that are no independent velocities.
fn tied(system: &System) -> Vec<Letter> {
    let all = system.quasi_velocities.iter().map(|quasi| Letter {
        value: quasi.definition,
        shown: system.graph.symbol(&quasi.name, 0),
    });
    all.collect()
}

/// Roots of quadratic forms in the velocities that occur in forces, as the speed does in drag.
fn speeds(system: &System) -> Vec<Letter> {
    let (g, velocities) = (&system.graph, system.velocity_symbols());
    let mut found: Vec<Letter> = Vec::new();
    for e in g.reachable(&system.forces) {
        let Node::Power { base, exponent } = g.node(e) else {
            continue;
        };
        let is_root = g.as_integer(*exponent).is_none()
            && g.as_integer(g.mul(&[*exponent, g.integer(2)])).is_some();
        let root = Letter::plain(g.sqrt(*base));
        if is_root && degree(g, *base, &velocities) == Some(2) && !found.contains(&root) {
            found.push(root);
        }
    }
    found
}

/// The quasi-velocities that the model states, by their definitions in (q, v, t).
pub(super) fn definitions(system: &System, frame: &Frame) -> Vec<Letter> {
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

/// The coordinates whose velocities the constraints forbid.
pub(crate) fn fixed_coordinates<'a>(cx: &Context<'a>) -> Vec<&'a Coordinate> {
    let solved = manifold(cx).solved;
    let is_fixed = |c: &&Coordinate| {
        let mut own = solved.iter().filter(|(symbol, _)| *symbol == c.v_symbol);
        own.any(|(_, value)| cx.system.graph.is_zero(*value))
    };
    cx.system.coordinates.iter().filter(is_fixed).collect()
}

/// The energy, the momenta of the coordinates that L does not contain, and the coordinates whose velocities the constraints forbid,
/// with their names.
fn known(cx: &Context<'_>) -> Vec<(String, Letter)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let moves = |s: Symbol| g.symbol_name(s) == "t" || system.moves(g.symbol_name(s));
    let mut values = vec![(ENERGY.to_owned(), system.energy())];
    let fixed = fixed_coordinates(cx).into_iter();
    values.extend(fixed.map(|c| (format!("{FIXED} {}", c.name), c.q)));
    for c in &system.coordinates {
        if !g.contains_any(system.lagrangian, &[c.q_symbol]) {
            let momentum = g.diff(system.lagrangian, c.v_symbol);
            values.push((format!("the momentum of {}", c.name), momentum));
        }
    }
    values.retain(|(_, value)| !g.is_free_of(*value, &moves));
    let plain: Vec<Expr> = values.iter().map(|(_, value)| *value).collect();
    let mut shown = in_quasi_velocities(cx, &plain);
    for ((name, _), shown) in values.iter().zip(&mut shown) {
        if name == ENERGY {
            *shown = as_stated(cx, *shown);
        }
    }
    let letters = values.into_iter().zip(shown);
    letters
        .map(|((name, value), shown)| (name, Letter { value, shown }))
        .collect()
}
