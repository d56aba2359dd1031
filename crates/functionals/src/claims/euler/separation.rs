//! Fields that satisfy one of two systems and not the other: polynomials with rational coefficients, found by linear algebra.
//!
//! They hold everywhere, in the body and on its boundary, so that they refute what is said of the systems as wholes. A body of any shape is
//! taken to be a box.

use super::super::on_box::on_box;
use super::super::special_values::put_in;
use super::comparison::System;
use super::extension::jet_factors;
use crate::functional::{Functional, Interval, Piece, Role, Side, Solution, Special};
use crate::linear;
use crate::notation::denominators;
use crate::polynomial::Polynomial;
use crate::read::on_side;
use crate::smoothness::{guards, Guard, Region};
use crate::space::Jet;
use crate::variation::{variation, Variation};
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::verdict::{Counterexample, PointValue};
use chetaev_symbolic::zero::assumptions::{is_contradicted, is_implied, SignSet};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Rational, Symbol, Verdict};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// The degrees of the polynomials that are tried.
const DEGREES: [u32; 4] = [1, 3, 6, 9];
/// More coefficients are not looked for.
const MOST: usize = 120;
/// Bits with which what is assumed of numbers is checked.
const BITS: usize = 128;
/// So many choices of values for parameters are tried.
const CHOICES: i64 = 2;

/// More choices of factors of products are not tried.
const MOST_PRODUCTS: usize = 8;
/// Of more fields no one is chosen alone.
const MOST_FIELDS: usize = 6;

/// A condition with the values of the variables that are constant where it holds.
#[derive(Clone)]
pub(super) struct Holds {
    what: String,
    pub(super) residual: Expr,
    /// The variables that are constant where it holds.
    pub(super) at: Vec<(usize, Rational)>,
    pub(super) is_imposed: bool,
}

/// A linear condition: what it is without fields, and the factors of their jets.
struct Linear {
    constant: Polynomial,
    factors: Vec<(Jet, Polynomial)>,
}

/// Polynomials by component.
pub(super) type Fields = BTreeMap<usize, Polynomial>;

/// What has to hold of fields so that something is defined and smooth, with the values of the variables that are constant where it is asked for.
struct Asked {
    guard: Guard,
    at: Vec<(usize, Rational)>,
}

/// Two systems with numbers for parameters.
pub(super) struct Search<'f> {
    pub(super) functional: &'f Functional,
    pub(super) values: Vec<(Symbol, Rational)>,
    /// What is put in for constitutive functions.
    energies: Vec<Special>,
    /// What is imposed with what is derived, and with what is stated.
    pub(super) systems: [Vec<Holds>; 2],
    /// Where the densities and both systems are defined and smooth.
    asked: Vec<Asked>,
    /// Whether the body has no shape, and was put on the box.
    is_placed: bool,
}

/// A refutation of the equivalence of what is derived and what is stated, by fields that satisfy the one and not the other.
pub(super) fn separated(functional: &Functional, own: &Variation) -> Option<Verdict> {
    let space = &*functional.space;
    let assumed = space.assumptions();
    let of_fields = |e: Expr| !space.jets_in(&[e]).is_empty();
    let mut all = assumed.list().iter();
    // Fields would have to keep to what is assumed of them.
    if all.any(|own| of_fields(own.left) || of_fields(own.right)) {
        return None;
    }
    let is_curved = |piece: &Piece| piece.side == Side::Curved;
    if !functional.pieces.iter().any(is_curved) {
        return searched(functional, own, false);
    }
    let placed = placed(functional, Faces::InTurn)?;
    let own = variation(&placed).ok()?;
    searched(&placed, &own, true)
}

/// How the faces of a box are shared out among the pieces.
pub(super) enum Faces {
    /// To one piece after the other.
    InTurn,
    /// One to each, and all others to the last.
    MostToLast,
}

/// A functional on the unit box, where its pieces have no shape.
pub(super) fn placed(functional: &Functional, faces: Faces) -> Option<Functional> {
    let unit = unit_box(functional, faces);
    let (placed, _) = on_box(functional, &unit)?;
    Some(Functional {
        intervals: unit.intervals,
        ..placed
    })
}

/// The unit box, its faces shared out among the pieces.
fn unit_box(functional: &Functional, faces: Faces) -> Solution {
    let space = &*functional.space;
    let g = &space.graph;
    let places = space.coordinates.iter().enumerate();
    let axes: Vec<usize> = places.filter(|(_, c)| !c.is_time).map(|(i, _)| i).collect();
    let sides = axes.iter().flat_map(|&axis| {
        [false, true].map(|is_upper| Side::Flat {
            axis,
            is_upper,
            at: if is_upper { g.one() } else { g.zero() },
        })
    });
    let names = functional.pieces.iter().map(|piece| piece.name.clone());
    let pieces = match (faces, functional.pieces.last()) {
        (Faces::MostToLast, Some(last)) => {
            let others = std::iter::repeat(last.name.clone());
            names.chain(others).zip(sides).collect()
        }
        _ => names.cycle().zip(sides).collect(),
    };
    let intervals = axes.iter().map(|&axis| Interval {
        axis,
        lower: g.zero(),
        upper: g.one(),
    });
    Solution {
        name: String::new(),
        description: String::new(),
        parameters: Vec::new(),
        values: Vec::new(),
        intervals: intervals.collect(),
        pieces,
        has_pieces: true,
        value: None,
    }
}

fn searched(functional: &Functional, own: &Variation, is_placed: bool) -> Option<Verdict> {
    (0..CHOICES).find_map(|choice| {
        let values = values(functional, choice)?;
        let search = Search::new(functional, own, (values, Vec::new()))?.placed(is_placed);
        let both = [
            (System::Derived, System::Stated),
            (System::Stated, System::Derived),
        ];
        both.into_iter()
            .find_map(|(one, other)| search.separating(one, other))
    })
}

/// Numbers for the parameters that have no value, with which what is assumed of them holds.
pub(super) fn values(functional: &Functional, choice: i64) -> Option<Vec<(Symbol, Rational)>> {
    let space = &*functional.space;
    let g = &space.graph;
    let mut symbols = BTreeSet::new();
    let densities = functional.pieces.iter().map(|piece| piece.density);
    let residuals = functional
        .equations
        .iter()
        .flat_map(|e| e.residuals.clone());
    let all: Vec<Expr> = densities
        .chain(residuals)
        .chain([functional.density])
        .map(|e| space.explicit(e))
        .collect();
    for symbol in space.symbols_in(&all) {
        let is_place = |c: &crate::space::Coordinate| g.as_symbol(c.expr) == Some(symbol);
        let is_known = space.as_jet(symbol).is_some()
            || space.coordinates.iter().any(is_place)
            || space.normals().contains(&symbol);
        if !is_known {
            symbols.insert(symbol);
        }
    }
    let number = |k: usize| rational::ratio(2 * k as i64 + 3 + choice, 2 * choice + 2);
    let values = symbols.into_iter().enumerate();
    let values = values.map(|(k, symbol)| Some((symbol, number(k)?)));
    let values: Vec<(Symbol, Rational)> = values.collect::<Option<_>>()?;
    let put = |e: Expr| with(functional, &values, e);
    let assumed = space.assumptions();
    let mut all = assumed.list().iter();
    let is_violated = all.any(|own| {
        let difference = put(g.sub(own.left, own.right));
        // What is assumed of fields is looked at where these are chosen.
        if !space.jets_in(&[difference]).is_empty() {
            return false;
        }
        // Of the place nothing is chosen.
        if space.is_of_place(&[difference]) {
            return is_contradicted(own.relation, known_sign(g, difference, &Default::default()));
        }
        let enclosed = g.enclose(&[difference], &Precision::new(BITS), &|_| None);
        let sign = enclosed.ok().and_then(|found| found.first()?.sign());
        let sign = sign.map(|sign| match sign {
            Ordering::Less => SignSet::NEGATIVE,
            Ordering::Equal => SignSet::ZERO,
            Ordering::Greater => SignSet::POSITIVE,
        });
        let sign = sign.unwrap_or_else(|| known_sign(g, difference, &Default::default()));
        !is_implied(own.relation, sign)
    });
    (!is_violated).then_some(values)
}

fn with(functional: &Functional, values: &[(Symbol, Rational)], e: Expr) -> Expr {
    let space = &*functional.space;
    let known = functional.values();
    let stated = |symbol: Symbol| {
        let own = space.graph.symbol_expr(symbol);
        known.iter().find(|(l, _)| *l == own).map(|(_, r)| *r)
    };
    let e = space.replace(space.explicit(e), &stated);
    space.replace(e, &|symbol| {
        let own = values.iter().find(|(own, _)| *own == symbol)?;
        Some(space.graph.number(own.1.clone()))
    })
}

impl<'f> Search<'f> {
    pub(super) fn new(
        functional: &'f Functional,
        own: &Variation,
        (values, energies): (Vec<(Symbol, Rational)>, Vec<Special>),
    ) -> Option<Search<'f>> {
        let mut search = Search {
            functional,
            values,
            energies,
            systems: Default::default(),
            asked: Vec::new(),
            is_placed: false,
        };
        let mut derived = search.stated(Role::Imposed)?;
        let mut stated = search.stated(Role::Imposed)?;
        derived.extend(search.derived(own)?);
        stated.extend(search.stated(Role::Yielded)?);
        search.systems = [derived, stated];
        search.asked = search.guards()?;
        Some(search)
    }

    /// What densities, conditions and equations ask for, found before fields are put in: of 0/0 nothing would be left.
    fn guards(&self) -> Option<Vec<Asked>> {
        let functional = self.functional;
        let g = &functional.space.graph;
        let pieces = functional.pieces.iter().map(|piece| {
            let on = Some(piece.name.as_str());
            Some((self.on(on, piece.density), self.place(on)?))
        });
        let mut all: Vec<(Expr, Vec<(usize, Rational)>)> = pieces.collect::<Option<_>>()?;
        all.push((functional.density, Vec::new()));
        let written = denominators(functional).into_iter();
        all.extend(written.map(|e| (g.powi(e, -1), Vec::new())));
        let systems = self.systems.iter().flatten();
        all.extend(systems.map(|own| (own.residual, own.at.clone())));
        let asked = all.into_iter().flat_map(|(e, at)| {
            let own = guards(g, self.put(e)).into_iter();
            own.map(move |guard| Asked {
                guard,
                at: at.clone(),
            })
        });
        Some(asked.collect())
    }

    /// Whether everything is known to be defined and smooth for some fields, on the body and on its boundary.
    pub(super) fn is_smooth(&self, fields: &Fields) -> bool {
        let space = &*self.functional.space;
        let g = &space.graph;
        let region = Region::new(space, self.intervals(), true);
        self.asked.iter().all(|own| {
            let (e, relation) = own.guard;
            let places = own.at.iter();
            let places =
                places.map(|(axis, x)| (space.coordinates[*axis].expr, g.number(x.clone())));
            let places: Vec<(Expr, Expr)> = places.collect();
            let e = g.substitute(self.for_fields(e, fields), &places);
            region.holds((e, relation)) == Some(true)
        })
    }

    /// The box with what is put in for parameters.
    pub(super) fn intervals(&self) -> Vec<Interval> {
        let own = self.functional.intervals.iter().map(|own| Interval {
            axis: own.axis,
            lower: self.put(own.lower),
            upper: self.put(own.upper),
        });
        own.collect()
    }

    /// An expression with what is put in for parameters and constitutive functions.
    pub(super) fn put(&self, e: Expr) -> Expr {
        let e = put_in(self.functional, &self.energies, e);
        with(self.functional, &self.values, e)
    }

    fn placed(self, is_placed: bool) -> Search<'f> {
        Search { is_placed, ..self }
    }

    fn number(&self, e: Expr) -> Option<Rational> {
        let g = &self.functional.space.graph;
        g.as_number(self.put(e)).cloned()
    }

    /// Where a piece lies, or where two meet.
    pub(super) fn place(&self, on: Option<&str>) -> Option<Vec<(usize, Rational)>> {
        let names = on.into_iter().flat_map(|on| on.split(','));
        let at = names.map(|name| match &self.functional.piece(name.trim())?.side {
            Side::Flat { axis, at, .. } => Some((*axis, self.number(*at)?)),
            Side::Curved => None,
        });
        at.collect()
    }

    /// A condition with the normal of the piece.
    pub(super) fn on(&self, on: Option<&str>, e: Expr) -> Expr {
        let names = on.into_iter().flat_map(|on| on.split(','));
        let pieces = names.filter_map(|name| self.functional.piece(name.trim()));
        pieces.fold(e, |e, piece| {
            on_side(&self.functional.scope, &piece.side, e)
        })
    }

    pub(super) fn stated(&self, role: Role) -> Option<Vec<Holds>> {
        let mut found = Vec::new();
        for equation in self.functional.with_role(role) {
            for &residual in &equation.residuals {
                let on = equation.on.as_deref();
                found.push(Holds {
                    what: format!("the stated equation ({})", equation.label),
                    residual: self.on(on, residual),
                    at: self.place(on)?,
                    is_imposed: role == Role::Imposed,
                });
            }
        }
        Some(found)
    }

    fn derived(&self, own: &Variation) -> Option<Vec<Holds>> {
        let name = |component: usize| self.functional.space.component_at(component).name;
        let mut found = Vec::new();
        let mut add = |what: String, residual: Expr, on: Option<&str>| {
            found.push(Holds {
                what,
                residual: self.on(on, residual),
                at: self.place(on)?,
                is_imposed: false,
            });
            Some(())
        };
        for (component, e) in &own.euler {
            add(
                format!("the Euler equation of {}", name(*component)),
                *e,
                None,
            )?;
        }
        for piece in &own.pieces {
            for condition in &piece.conditions {
                let what = format!(
                    "the natural condition of {} on {}",
                    name(condition.component),
                    piece.piece
                );
                add(what, condition.value, Some(&piece.piece))?;
            }
        }
        for corner in &own.corners {
            let on = format!("{}, {}", corner.pieces.0, corner.pieces.1);
            let what = format!(
                "the condition of {} where {} and {} meet",
                name(corner.component),
                corner.pieces.0,
                corner.pieces.1
            );
            add(what, corner.value, Some(&on))?;
        }
        Some(found)
    }

    fn system(&self, system: System) -> &[Holds] {
        match system {
            System::Derived => &self.systems[0],
            System::Stated => &self.systems[1],
        }
    }

    /// Fields that satisfy one system and not the other.
    fn separating(&self, one: System, other: System) -> Option<Verdict> {
        let all = self.system(one);
        // A piece without a shape has no corners: what holds at those of the box is not claimed of it.
        let is_claimed = |own: &&Holds| !own.is_imposed && (!self.is_placed || own.at.len() < 2);
        let violated = self.system(other).iter().filter(is_claimed);
        let violated: Vec<&Holds> = violated.collect();
        let choices = self.choices_of_factors(all);
        DEGREES.iter().find_map(|&degree| {
            let mut all = choices.iter().flat_map(|all| self.fields_of(all, degree));
            all.find_map(|fields| {
                violated.iter().find_map(|own| {
                    let value = self.value(own, &fields)?;
                    let is_witness = !value.is_zero() && self.is_smooth(&fields);
                    is_witness.then(|| self.refuted(own, one, &fields, &value))
                })
            })
        })
    }

    /// The conditions with one factor of each product: where it vanishes the product does.
    fn choices_of_factors(&self, all: &[Holds]) -> Vec<Vec<Holds>> {
        let space = &*self.functional.space;
        let mut found: Vec<Vec<Holds>> = vec![Vec::new()];
        for own in all {
            let mut factors = jet_factors(space, self.put(own.residual));
            if found.len() * factors.len() > MOST_PRODUCTS {
                factors = vec![own.residual];
            }
            found = found
                .iter()
                .flat_map(|before| {
                    factors.iter().map(|&residual| {
                        let mut next = before.clone();
                        next.push(Holds {
                            residual,
                            ..own.clone()
                        });
                        next
                    })
                })
                .collect();
        }
        found
    }

    /// Polynomials with which a system holds. Where it is not linear in the fields some of them are chosen: zero, or linear functions.
    fn fields_of(&self, all: &[Holds], degree: u32) -> Vec<Fields> {
        let space = &*self.functional.space;
        let residuals: Vec<Expr> = all.iter().map(|own| own.residual).collect();
        let residuals: Vec<Expr> = residuals.iter().map(|&e| self.put(e)).collect();
        let jets = space.jets_in(&residuals);
        let components: BTreeSet<usize> = jets.iter().map(|jet| jet.component).collect();
        let interior: BTreeSet<usize> = self
            .functional
            .interior()
            .flat_map(|field| field.components.clone())
            .collect();
        let solved = |known: Fields| {
            let open = components.iter().filter(|own| !known.contains_key(own));
            let open: Vec<usize> = open.copied().collect();
            self.solved(all, (&open, degree), known)
        };
        if let Some(found) = solved(Fields::new()) {
            return vec![found];
        }
        self.known_fields(&interior)
            .into_iter()
            .filter_map(solved)
            .collect()
    }

    /// Choices of fields with which equations may be linear in the others: all zero, one of them zero, all constant, or linear in the place, and one of
    /// them linear where the others are zero.
    fn known_fields(&self, interior: &BTreeSet<usize>) -> Vec<Fields> {
        let space = &*self.functional.space;
        let d = space.coordinates.len();
        let zero = |&component: &usize| (component, Polynomial::default());
        let mut found: Vec<Fields> = vec![interior.iter().map(zero).collect()];
        if interior.len() > MOST_FIELDS {
            return found;
        }
        found.extend(interior.iter().map(|own| Fields::from([zero(own)])));
        let linear = |(at, &component): (usize, &usize)| {
            let mut own = Polynomial::constant(Rational::from(at + 2));
            for axis in 0..d {
                let mut exponents = vec![0; d];
                exponents[axis] = 1;
                let slope = Rational::from(at + axis + 1);
                own.add(&Polynomial::monomial(exponents, slope), &Rational::ONE);
            }
            (component, own)
        };
        let constant = |(at, &component): (usize, &usize)| {
            (component, Polynomial::constant(Rational::from(at + 1)))
        };
        found.push(interior.iter().enumerate().map(constant).collect());
        found.push(interior.iter().enumerate().map(linear).collect());
        if interior.len() > 1 {
            found.extend(interior.iter().enumerate().map(|one| {
                let mut own: Fields = interior.iter().map(zero).collect();
                own.extend([linear(one)]);
                own
            }));
        }
        found
    }

    pub(super) fn solved(
        &self,
        all: &[Holds],
        (open, degree): (&[usize], u32),
        known: Fields,
    ) -> Option<Fields> {
        let space = &*self.functional.space;
        let d = space.coordinates.len();
        // Each with the products of powers of the variables on which it depends.
        let terms: Vec<(usize, Polynomial)> = open
            .iter()
            .flat_map(|&component| {
                let varies = |axis: usize| space.varies_along(component, axis);
                let own = monomials(d, degree, &varies).into_iter();
                own.map(move |monomial| (component, monomial))
            })
            .collect();
        if terms.len() > MOST {
            return None;
        }
        let mut rows: Vec<(BTreeMap<usize, Rational>, Rational)> = Vec::new();
        for own in all {
            let linear = self.linear(own, &known)?;
            let mut found: BTreeMap<Vec<u32>, (BTreeMap<usize, Rational>, Rational)> =
                BTreeMap::new();
            for (exponents, value) in linear.constant.at(&own.at).terms() {
                found.entry(exponents.to_vec()).or_default().1 = -value.clone();
            }
            for (jet, factor) in &linear.factors {
                let unknowns = terms.iter().enumerate();
                let unknowns = unknowns.filter(|(_, (own, _))| *own == jet.component);
                for (number, (_, monomial)) in unknowns {
                    let term = factor.times(&monomial.slopes(&jet.by)).at(&own.at);
                    for (exponents, value) in term.terms() {
                        let row = &mut found.entry(exponents.to_vec()).or_default().0;
                        let entry = row.entry(number).or_insert(Rational::ZERO);
                        *entry = rational::sum(entry, value);
                    }
                }
            }
            rows.extend(found.into_values());
        }
        let values = linear::some_solution(terms.len(), rows)?;
        let mut fields = known;
        for ((component, monomial), value) in terms.iter().zip(&values) {
            let own = fields.entry(*component).or_default();
            own.add(monomial, value);
        }
        Some(fields)
    }

    /// A condition as a linear one in the fields that are not known; `None` where it is not linear with polynomials for factors.
    fn linear(&self, own: &Holds, known: &Fields) -> Option<Linear> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let put = |symbol: Symbol| {
            let jet = space.as_jet(symbol)?;
            let value = known.get(&jet.component)?;
            Some(value.slopes(&jet.by).expr(space))
        };
        let e = space.replace(self.put(own.residual), &put);
        let zero = |e: Expr| space.replace(e, &|symbol| space.as_jet(symbol).map(|_| g.zero()));
        let mut factors = Vec::new();
        for jet in space.jets_in(&[e]) {
            let slope = space.partial(e, &jet);
            if !space.jets_in(&[slope]).is_empty() {
                return None;
            }
            factors.push((jet, Polynomial::of(space, slope)?));
        }
        Some(Linear {
            constant: Polynomial::of(space, zero(e))?,
            factors,
        })
    }

    /// What a condition is for some fields, those that are not among them being zero.
    pub(super) fn value(&self, own: &Holds, fields: &Fields) -> Option<Polynomial> {
        let e = self.put(own.residual);
        let e = self.for_fields(e, fields);
        Some(Polynomial::of(&self.functional.space, e)?.at(&own.at))
    }

    pub(super) fn for_fields(&self, e: Expr, fields: &Fields) -> Expr {
        let space = &*self.functional.space;
        space.replace(e, &|symbol| {
            let jet = space.as_jet(symbol)?;
            Some(match fields.get(&jet.component) {
                Some(value) => value.slopes(&jet.by).expr(space),
                None => space.graph.zero(),
            })
        })
    }

    fn refuted(&self, own: &Holds, one: System, fields: &Fields, value: &Polynomial) -> Verdict {
        let space = &*self.functional.space;
        let g = &space.graph;
        let shown = fields.iter().map(|(&component, polynomial)| {
            let name = space.component_at(component).name;
            format!("{name} = {}", g.text(polynomial.expr(space)))
        });
        let shown: Vec<String> = shown.collect();
        let system = match one {
            System::Derived => "the Euler equations and natural conditions",
            System::Stated => "what is stated",
        };
        let parameters = self.values.iter().map(|(symbol, value)| PointValue {
            name: g.symbol_name(*symbol).to_owned(),
            exact: Some(value.clone()),
            enclosure: None,
        });
        let place: Vec<Rational> = place_of(value, space.coordinates.len());
        let coordinates = space
            .coordinates
            .iter()
            .zip(&place)
            .map(|(c, x)| PointValue {
                name: c.name.clone(),
                exact: Some(x.clone()),
                enclosure: None,
            });
        let residual = rational::to_f64(&value.exact(&place)).to_string();
        let of = if self.values.is_empty() {
            ""
        } else {
            " with the values stated of the parameters"
        };
        Verdict::Refuted(Counterexample {
            detail: format!(
                "{} does not follow from the other system: {}{of} satisfy {system} everywhere, and its residual for them is {}",
                own.what,
                shown.join(", "),
                g.text(value.expr(space))
            ),
            quantity: own.what.clone(),
            residual: (residual.clone(), residual),
            point: parameters.chain(coordinates).collect(),
        })
    }
}

/// A place where a polynomial that is not zero does not vanish.
fn place_of(value: &Polynomial, d: usize) -> Vec<Rational> {
    let at = |k: i64| {
        let along = |i: usize| rational::ratio(1 + k % (2 + i as i64), 2 + k + i as i64);
        let place: Option<Vec<Rational>> = (0..d).map(along).collect();
        place.unwrap_or_default()
    };
    let mut all = (0..64).map(at);
    let found = all.find(|place| value.exact(place) != Rational::ZERO);
    found.unwrap_or_else(|| at(0))
}

/// All products of powers up to a degree of the variables along which something varies.
pub(super) fn monomials(d: usize, degree: u32, varies: &dyn Fn(usize) -> bool) -> Vec<Polynomial> {
    let mut all: Vec<Vec<u32>> = vec![Vec::new()];
    for axis in 0..d {
        let longer = all.into_iter().flat_map(|own| {
            let used: u32 = own.iter().sum();
            let most = if varies(axis) { degree - used } else { 0 };
            (0..=most).map(move |n| [own.clone(), vec![n]].concat())
        });
        all = longer.collect();
    }
    all.into_iter()
        .map(|own| Polynomial::monomial(own, rational::integer(1)))
        .collect()
}
