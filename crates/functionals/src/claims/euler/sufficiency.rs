//! Whether what is stated suffices where imposed equations restrict the variations: it does not where fields satisfy all that is imposed and stated,
//! and a variation that keeps what is imposed changes the functional to the first order.
//!
//! Fields and variations are polynomials with rational coefficients on a box, and the change is integrated exactly. Of a functional that is one for any
//! energy some energies are tried.

use super::super::reduction::admitted;
use super::separation::{monomials, placed, values, Faces, Fields, Holds, Search};
use crate::functional::{Functional, Piece, Role, Side, Special, SpecialKind};
use crate::linear;
use crate::polynomial::{Domain, Polynomial};
use crate::smoothness::Region;
use crate::space::{Jet, Space};
use chetaev_symbolic::verdict::{Counterexample, PointValue};
use chetaev_symbolic::zero::assumptions::Relation;
use chetaev_symbolic::{rational, Expr, Rational, Verdict};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// The degrees of the fields that are tried.
const DEGREES: [u32; 2] = [2, 1];
/// The degrees of data by which the equations hold for them.
const OF_DATA: [u32; 3] = [3, 4, 6];
/// The degrees of the variations.
const OF_VARIATIONS: [u32; 3] = [0, 1, 3];
/// Fields have coefficients of this size, so that maps stay invertible.
const SIZE: i64 = 10_000;

/// A linear form in jets.
type Slopes = Vec<(Jet, Polynomial)>;

/// Variables that are constant, with their values.
type Place = Vec<(usize, Rational)>;

/// Fields on a box, in the interior and on each piece.
struct Trial<'s> {
    search: &'s Search<'s>,
    inside: Fields,
    /// The same with the data of a piece, by its name.
    on_pieces: BTreeMap<String, Fields>,
}

/// Fields for which all that is imposed and stated holds, with an admitted variation that changes the functional.
pub(super) fn insufficient(functional: &Functional) -> Option<Verdict> {
    let space = &*functional.space;
    let is_timed = space.coordinates.iter().any(|own| own.is_time);
    let mut imposed = functional.with_role(Role::Imposed);
    if is_timed || imposed.any(|own| own.multiplier.is_some()) {
        return None;
    }
    let is_curved = |piece: &Piece| piece.side == Side::Curved;
    let is_placed = functional.pieces.iter().any(is_curved);
    let body = if is_placed {
        Cow::Owned(placed(functional, Faces::MostToLast)?)
    } else {
        Cow::Borrowed(functional)
    };
    let own = admitted(&body).ok()?;
    energies(&body).into_iter().find_map(|(words, energies)| {
        let values = values(&body, 0)?;
        let search = Search::new(&body, &own, (values, energies))?;
        let mut all = bases(&search, is_placed).into_iter();
        all.find_map(|known| {
            let trial = Trial::new(&search, known, is_placed)?;
            let variation = trial.changing()?;
            Some(trial.refuted(&variation, &words))
        })
    })
}

/// Constitutive functions that occur in a functional, or in what is imposed and stated.
fn occurring(functional: &Functional) -> BTreeSet<usize> {
    let space = &*functional.space;
    let pieces = functional.pieces.iter().map(|piece| piece.density);
    let equations = functional.equations.iter();
    let equations = equations.filter(|own| own.role != Role::Other);
    let residuals = equations.flat_map(|own| own.residuals.iter().copied());
    let all = pieces.chain(residuals).chain([functional.density]);
    all.flat_map(|e| space.functions_in(space.explicit(e)))
        .collect()
}

/// Energies for functions of which nothing is stated, in words: half the sum of squares, and the trace of a symmetric tensor, with which the stress of a
/// body with finite displacements is linear in their gradients.
fn energies(functional: &Functional) -> Vec<(String, Vec<Special>)> {
    let space = &*functional.space;
    let occurring = occurring(functional);
    let conjugate = |function: usize| space.function_at(function).conjugate;
    let mut own: Vec<usize> = Vec::new();
    for function in functional.functions.iter().map(|own| own.function) {
        // With one of a pair the other is known.
        let is_known = conjugate(function).is_some_and(|other| own.contains(&other));
        if occurring.contains(&function) && !is_known {
            own.push(function);
        }
    }
    if own.is_empty() {
        return vec![(String::new(), Vec::new())];
    }
    let put = |value: &dyn Fn(&Space, usize) -> Expr| {
        let own = own.iter().map(|&function| Special {
            written: String::new(),
            what: SpecialKind::Function {
                function,
                value: value(space, function),
            },
        });
        own.collect::<Vec<Special>>()
    };
    let names = own.iter().map(|&own| space.function_at(own).name);
    let names = names.collect::<Vec<_>>().join(" and ");
    let words = |what: &str| format!(" with {what} of its argument for {names}");
    let squares = words("half the sum of the squares of the components");
    let mut found = vec![(squares, put(&half_squares))];
    // A linear function has no conjugate.
    let is_alone = |&function: &usize| {
        let other = conjugate(function);
        other.is_none_or(|other| !occurring.contains(&other))
    };
    if own.iter().all(is_alone) {
        found.push((words("the trace"), put(&trace)));
    }
    found
}

/// Half the sum of the squares of place-holders.
fn half_squares(space: &Space, function: usize) -> Expr {
    let g = &space.graph;
    let squares = space.slots(function).into_iter();
    let squares: Vec<Expr> = squares.map(|slot| g.powi(slot, 2)).collect();
    g.div(g.add(&squares), g.integer(2))
}

/// The sum of the place-holders that count once in a contraction.
fn trace(space: &Space, function: usize) -> Expr {
    let counts = space.function_at(function).multiplicities;
    let own = space.slots(function).into_iter().zip(counts);
    let own = own.filter(|(_, count)| *count == 1);
    space
        .graph
        .add(&own.map(|(slot, _)| slot).collect::<Vec<_>>())
}

/// Fields of the interior with small coefficients. On a body that is put on a box also those that vanish at its corners, where it has none.
fn bases(search: &Search<'_>, is_placed: bool) -> Vec<Fields> {
    let functional = search.functional;
    let space = &*functional.space;
    let d = space.coordinates.len();
    let components: Vec<usize> = functional
        .interior()
        .flat_map(|own| own.components.clone())
        .collect();
    let of = |degree: u32, factor: &Polynomial| -> Fields {
        let each = components.iter().enumerate().map(|(at, &component)| {
            let mut own = Polynomial::default();
            let varies = |axis: usize| space.varies_along(component, axis);
            for (k, monomial) in monomials(d, degree, &varies).iter().enumerate() {
                let size = rational::ratio(((2 * at + 3 * k) % 5) as i64 + 1, SIZE);
                own.add(monomial, &size.unwrap_or(Rational::ONE));
            }
            (component, own.times(factor))
        });
        each.collect()
    };
    let one = Polynomial::constant(Rational::ONE);
    let mut found: Vec<Fields> = DEGREES.iter().map(|&n| of(n, &one)).collect();
    if is_placed && d > 1 {
        found.push(of(1, &apart_from_corners(d)));
    }
    found
}

/// A polynomial that vanishes where two or more faces of the unit box meet, and not on these.
fn apart_from_corners(d: usize) -> Polynomial {
    let along = |axis: usize| {
        let power = |n: u32| {
            let mut exponents = vec![0; axis + 1];
            exponents[axis] = n;
            Polynomial::monomial(exponents, Rational::ONE)
        };
        let mut own = power(1);
        own.add(&power(2), &rational::integer(-1));
        own
    };
    let mut sum = Polynomial::default();
    for left_out in 0..d {
        let others = (0..d).filter(|&axis| axis != left_out);
        let one = Polynomial::constant(Rational::ONE);
        let product = others.fold(one, |own, axis| own.times(&along(axis)));
        sum.add(&product, &Rational::ONE);
    }
    sum
}

impl<'s> Trial<'s> {
    /// Known fields of the interior with data by which all that is imposed and stated holds; `None` where none are found, or something is not
    /// defined, or assumed otherwise.
    fn new(search: &'s Search<'s>, known: Fields, is_placed: bool) -> Option<Trial<'s>> {
        let functional = search.functional;
        let [derived, stated] = &search.systems;
        let at_corner = |own: &&Holds| own.at.len() > 1;
        if stated.iter().any(|own| at_corner(&own)) {
            return None;
        }
        let inside: Vec<Holds> = stated
            .iter()
            .filter(|own| own.at.is_empty())
            .cloned()
            .collect();
        let inside = with_data(search, &inside, known)?;
        let mut on_pieces = BTreeMap::new();
        for piece in &functional.pieces {
            let at = search.place(Some(&piece.name))?;
            let here = stated.iter().filter(|own| own.at == at);
            let here: Vec<Holds> = here.cloned().collect();
            let own = with_data(search, &here, inside.clone())?;
            on_pieces.insert(piece.name.clone(), own);
        }
        // A body of any shape has no corners: what would act there on a box must not.
        let mut corners = derived
            .iter()
            .filter(at_corner)
            .filter(|own| !own.is_imposed);
        let is_free = |own: &Holds| {
            let e = search.put(own.residual);
            let jets = functional.space.jets_in(&[e]);
            let is_known = jets.iter().all(|jet| inside.contains_key(&jet.component));
            is_known
                && search
                    .value(own, &inside)
                    .is_some_and(|value| value.is_zero())
        };
        if is_placed && !corners.all(is_free) {
            return None;
        }
        let trial = Trial {
            search,
            inside,
            on_pieces,
        };
        (search.is_smooth(&trial.inside) && trial.is_as_assumed()).then_some(trial)
    }

    fn space(&self) -> &'s Space {
        &self.search.functional.space
    }

    /// Whether what is assumed of fields is known to hold for these on the whole box.
    fn is_as_assumed(&self) -> bool {
        let space = self.space();
        let g = &space.graph;
        let region = Region::new(space, self.search.intervals(), true);
        let assumed = space.assumptions();
        let mut all = assumed.list().iter();
        all.all(|own| {
            let (larger, relation) = match own.relation {
                Relation::Less => (g.sub(own.right, own.left), Relation::Greater),
                Relation::LessOrEqual => (g.sub(own.right, own.left), Relation::GreaterOrEqual),
                other => (g.sub(own.left, own.right), other),
            };
            let e = self.search.put(larger);
            let jets = space.jets_in(&[e]);
            let is_known = jets
                .iter()
                .all(|jet| self.inside.contains_key(&jet.component));
            let holds = || region.holds((self.search.for_fields(e, &self.inside), relation));
            jets.is_empty() || (is_known && holds() == Some(true))
        })
    }

    /// The slopes of an expression by the jets of the fields of the interior, at these fields.
    fn slopes(&self, e: Expr, fields: &Fields) -> Option<Slopes> {
        let space = self.space();
        let functional = self.search.functional;
        let e = self.search.put(e);
        let varied: BTreeSet<usize> = functional
            .interior()
            .flat_map(|own| own.components.clone())
            .collect();
        let jets = space.jets_in(&[e]).into_iter();
        let jets = jets.filter(|jet| varied.contains(&jet.component));
        let slopes = jets.map(|jet| {
            let slope = self.search.for_fields(space.partial(e, &jet), fields);
            Some((jet, Polynomial::of(space, slope)?))
        });
        slopes.collect()
    }

    /// What a variation has to satisfy, with the variables that are constant there: imposed equations, to the first order, and what is given.
    fn kept(&self) -> Option<Vec<(Slopes, Place)>> {
        let search = self.search;
        let functional = search.functional;
        let mut found = Vec::new();
        let imposed = search.systems[1].iter().filter(|own| own.is_imposed);
        for own in imposed.filter(|own| own.at.is_empty()) {
            found.push((self.slopes(own.residual, &self.inside)?, Vec::new()));
        }
        for piece in &functional.pieces {
            let at = search.place(Some(&piece.name))?;
            let fields = self.on_pieces.get(&piece.name)?;
            let imposed = search.systems[1].iter().filter(|own| own.is_imposed);
            for own in imposed.filter(|own| own.at == at) {
                found.push((self.slopes(own.residual, fields)?, at.clone()));
            }
            let Side::Flat { axis, .. } = piece.side else {
                return None;
            };
            for &(component, is_slope) in &piece.fixed {
                let by = if is_slope { vec![axis] } else { Vec::new() };
                let one = Polynomial::constant(Rational::ONE);
                found.push((vec![(Jet { component, by }, one)], at.clone()));
            }
        }
        Some(found)
    }

    /// The first variation: slopes of the densities with where they are integrated.
    fn first_variation(&self) -> Option<Vec<(Slopes, Domain)>> {
        let search = self.search;
        let functional = search.functional;
        let whole = Domain::of(self.space(), &functional.intervals, &|e| search.put(e))?;
        let mut found = Vec::new();
        for piece in &functional.pieces {
            let density = search.on(Some(&piece.name), piece.density);
            let fields = self.on_pieces.get(&piece.name)?;
            found.push((self.slopes(density, fields)?, whole.face(&piece.side)?));
        }
        found.push((self.slopes(functional.density, &self.inside)?, whole));
        Some(found)
    }

    /// A variation that keeps what is imposed and changes the functional by one.
    fn changing(&self) -> Option<Fields> {
        let kept = self.kept()?;
        let first = self.first_variation()?;
        OF_VARIATIONS
            .iter()
            .find_map(|&degree| self.changing_of(degree, &kept, &first))
    }

    fn changing_of(
        &self,
        degree: u32,
        kept: &[(Slopes, Place)],
        first: &[(Slopes, Domain)],
    ) -> Option<Fields> {
        let space = self.space();
        let d = space.coordinates.len();
        let components = self
            .search
            .functional
            .interior()
            .flat_map(|own| own.components.clone());
        let unknowns = components.flat_map(|component| {
            let varies = |axis: usize| space.varies_along(component, axis);
            let own = monomials(d, degree, &varies).into_iter();
            own.map(move |monomial| (component, monomial))
        });
        let unknowns: Vec<(usize, Polynomial)> = unknowns.collect();
        let mut rows: Vec<(BTreeMap<usize, Rational>, Rational)> = Vec::new();
        for (slopes, at) in kept {
            let mut found: BTreeMap<Vec<u32>, BTreeMap<usize, Rational>> = BTreeMap::new();
            for (number, unknown) in unknowns.iter().enumerate() {
                for (exponents, value) in along(slopes, unknown).at(at).terms() {
                    let row = found.entry(exponents.to_vec()).or_default();
                    row.insert(number, value.clone());
                }
            }
            rows.extend(found.into_values().map(|row| (row, Rational::ZERO)));
        }
        let change = |unknown: &(usize, Polynomial)| {
            let parts = first.iter();
            let parts = parts.map(|(slopes, domain)| along(slopes, unknown).integral(domain));
            parts.fold(Rational::ZERO, |sum, part| rational::sum(&sum, &part))
        };
        let changes = unknowns.iter().map(change).enumerate();
        let changes = changes.filter(|(_, value)| *value != Rational::ZERO);
        rows.push((changes.collect(), Rational::ONE));
        let solution = linear::some_solution(unknowns.len(), rows)?;
        let mut found = Fields::new();
        for ((component, monomial), value) in unknowns.iter().zip(&solution) {
            found.entry(*component).or_default().add(monomial, value);
        }
        Some(found)
    }

    fn refuted(&self, variation: &Fields, energies: &str) -> Verdict {
        let search = self.search;
        let functional = search.functional;
        let g = &self.space().graph;
        let shown = |fields: &Fields, sign: &str| {
            let own = functional.interior().flat_map(|own| own.components.clone());
            let own = own.filter_map(|component| {
                let name = self.space().component_at(component).name;
                let value = fields.get(&component)?.expr(self.space());
                Some(format!("{sign}{name} = {}", g.text(value)))
            });
            own.collect::<Vec<_>>().join(", ")
        };
        let pieces: Vec<&str> = functional
            .pieces
            .iter()
            .map(|own| own.name.as_str())
            .collect();
        let parameters = search.values.iter().map(|(symbol, value)| PointValue {
            name: g.symbol_name(*symbol).to_owned(),
            exact: Some(value.clone()),
            enclosure: None,
        });
        let quantity = "the first variation".to_owned();
        Verdict::Refuted(Counterexample {
            detail: format!(
                "what is stated does not suffice{energies}: {}, with data by which all that is imposed and stated holds, are changed by {}, which keeps what is \
                 imposed, and {quantity} is then 1, integrated over a box with the faces {}",
                shown(&self.inside, ""),
                shown(variation, "δ"),
                pieces.join(", ")
            ),
            quantity,
            residual: ("1".into(), "1".into()),
            point: parameters.collect(),
        })
    }
}

/// A linear form in jets for a polynomial in the place of a component.
fn along(slopes: &Slopes, (component, value): &(usize, Polynomial)) -> Polynomial {
    let mut sum = Polynomial::default();
    for (jet, slope) in slopes.iter().filter(|(jet, _)| jet.component == *component) {
        sum.add(&slope.times(&value.slopes(&jet.by)), &Rational::ONE);
    }
    sum
}

/// Known fields with what is open in conditions, by which these hold: found for all together, or for one condition after the other.
fn with_data(search: &Search<'_>, all: &[Holds], known: Fields) -> Option<Fields> {
    let together = with_open(search, all, known.clone());
    together.or_else(|| {
        let mut each = all.iter();
        each.try_fold(known, |known, own| {
            with_open(search, std::slice::from_ref(own), known)
        })
    })
}

fn with_open(search: &Search<'_>, all: &[Holds], known: Fields) -> Option<Fields> {
    let space = &*search.functional.space;
    let residuals: Vec<Expr> = all.iter().map(|own| search.put(own.residual)).collect();
    let jets = space.jets_in(&residuals).into_iter();
    let open: BTreeSet<usize> = jets.map(|jet| jet.component).collect();
    let open = open.into_iter().filter(|own| !known.contains_key(own));
    let open: Vec<usize> = open.collect();
    let mut degrees = OF_DATA.iter();
    degrees.find_map(|&degree| search.solved(all, (&open, degree), known.clone()))
}
