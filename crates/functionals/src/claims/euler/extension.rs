//! Whether a jet at one place is that of a solution: then what does not hold at the jet does not follow.
//!
//! Data may be chosen: an equation that alone contains one holds for any fields, with the data that it gives. Where each equation of the body does
//! (a load in every equation of equilibrium), fields are bound by nothing but conditions at single places, and what holds at one
//! place is continued anyhow; where each condition on the boundary does, those where its pieces meet included, nothing but the equations of the body restricts a jet. Conditions
//! without data (an end that is free, or on a spring) hold for few fields, and together they may enforce what no equation says at
//! its place: u'' = 0 with u'(0) = 0 and u(1) = 0 leaves u = 0 alone.

use super::comparison::{euler_groups, groups, Comparison, System};
use crate::elimination::{factors_of, Solved};
use crate::functional::{Piece, Role, Side};
use crate::smoothness::{guards, Guard, Region};
use crate::space::{Jet, Space};
use crate::variation::{acting_at_edge, at_edge};
use chetaev_symbolic::zero::assumptions::{is_implied, Relation};
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeSet;

/// What an expression depends on that may be chosen at will.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Datum {
    Component(usize),
    Parameter(Symbol),
}

/// An equation that holds somewhere.
#[derive(Clone)]
struct Bound {
    e: Expr,
    /// What occurs in it.
    data: BTreeSet<Datum>,
    is_inside: bool,
}

/// A system as a whole.
struct Whole {
    /// The equations of the body as they are solved.
    inside: Vec<Bound>,
    /// The same as they are written.
    written: Vec<Bound>,
    /// The conditions that hold at the jet.
    here: Vec<Bound>,
    /// Those at other places.
    elsewhere: Vec<Bound>,
    /// What occurs in what is looked at, and in the conditions that hold there.
    looked_at: BTreeSet<Datum>,
}

impl Whole {
    fn conditions(&self) -> impl Iterator<Item = &Bound> {
        self.here.iter().chain(&self.elsewhere)
    }

    /// Whether a condition on the boundary speaks of a field of which the body says by a product what it may be: fields are continuous, so that
    /// the factor that vanishes on the boundary may vanish everywhere.
    fn products_meet(&self, space: &Space) -> bool {
        let of = |e: Expr| {
            let jets = space.jets_in(&[space.explicit(e)]).into_iter();
            jets.map(|jet| jet.component).collect::<BTreeSet<usize>>()
        };
        let is_product = |own: &&Bound| jet_factors(space, own.e).len() > 1;
        let products = self.written.iter().filter(is_product);
        let bound: BTreeSet<usize> = products.flat_map(|own| of(own.e)).collect();
        let meets = |own: &Bound| !of(own.e).is_disjoint(&bound);
        self.conditions().any(meets)
    }
}

impl<'f> Comparison<'f> {
    /// Whether any jet at a place at which a system holds there is that of fields with which it holds everywhere, for some data; for
    /// expressions that are looked at there.
    pub(super) fn extends(&self, es: &[Expr], system: System, on: Option<&str>) -> bool {
        let solved = self.inside(system);
        // What is left of the equations of the body may be differentiated across a piece, and was not there.
        let is_solved = on.is_none() || solved.left.is_empty();
        is_solved && self.is_regular(solved) && self.has_data(es, system, on)
    }

    /// Fields and data of which something is assumed, or whose signs a branch has.
    fn signed(&self) -> BTreeSet<usize> {
        let space = &*self.functional.space;
        let assumed = space.assumptions();
        let sides = assumed.list().iter().flat_map(|own| [own.left, own.right]);
        let all: Vec<Expr> = sides
            .chain(self.derived.nonnegative().iter().copied())
            .collect();
        let jets = space.jets_in(&all).into_iter();
        jets.map(|jet| jet.component).collect()
    }

    /// Whether fields with a jet at a place can keep to what is assumed of them, and to the signs of a branch, everywhere: either no condition
    /// on the boundary without data of its own speaks of these fields; or what is assumed holds strictly where all fields vanish, and so do the
    /// conditions, so that it holds for small fields, among which are some that refute.
    fn keeps_signs(&self, own: &Whole) -> bool {
        let signed = self.signed();
        if signed.is_empty() {
            return true;
        }
        let space = &*self.functional.space;
        let bare = self.without_data(own.conditions().cloned().collect(), &own.looked_at);
        let speaks = |own: &Bound| {
            let jets = space.jets_in(&[own.e]);
            jets.iter().any(|jet| signed.contains(&jet.component))
        };
        (self.assumes_jets_alone() && !bare.iter().any(speaks))
            || (bare.iter().all(|own| is_linear(space, own.e))
                && bare.iter().all(|own| self.is_zero_at_rest(own.e))
                && self.assumes_strictly_at_rest())
    }

    /// Whether each thing that is assumed of fields, and each sign of a branch, speaks of one jet, and nothing else of the same component: then a
    /// jet inside of what is assumed is that of a function that stays there.
    fn assumes_jets_alone(&self) -> bool {
        let space = &*self.functional.space;
        let assumed = space.assumptions();
        let sides = assumed.list().iter().map(|own| vec![own.left, own.right]);
        let signs = self.derived.nonnegative().iter().map(|&e| vec![e]);
        let mut known: BTreeSet<Jet> = BTreeSet::new();
        let are_single = sides.chain(signs).all(|es| {
            let jets = space.jets_in(&es);
            let is_single = jets.len() <= 1 && (jets.is_empty() || !space.is_of_place(&es));
            known.extend(jets);
            is_single
        });
        let components: BTreeSet<usize> = known.iter().map(|jet| jet.component).collect();
        are_single && components.len() == known.len()
    }

    fn at_rest(&self, e: Expr) -> Expr {
        let space = &*self.functional.space;
        let zero = space.graph.zero();
        space.replace(space.explicit(e), &|symbol| {
            space.as_jet(symbol).map(|_| zero)
        })
    }

    fn is_zero_at_rest(&self, e: Expr) -> bool {
        self.functional.space.vanishes(self.at_rest(e))
    }

    fn assumes_strictly_at_rest(&self) -> bool {
        let space = &*self.functional.space;
        let g = &space.graph;
        let assumed = space.assumptions();
        let mut all = assumed.list().iter();
        self.derived.nonnegative().is_empty()
            && all.all(|own| {
                let difference = g.sub(own.left, own.right);
                let is_of_fields = !space.jets_in(&[difference]).is_empty();
                let strict = match own.relation {
                    Relation::GreaterOrEqual => Relation::Greater,
                    Relation::LessOrEqual => Relation::Less,
                    other => other,
                };
                !is_of_fields || is_implied(strict, space.sign(self.at_rest(difference)))
            })
    }

    /// The equations of the body as they are written, by nothing divided.
    fn as_written(&self, system: System) -> Vec<Expr> {
        let functional = self.functional;
        let own = match system {
            System::Derived => euler_groups(functional, self.variation),
            System::Stated => groups(functional, Role::Yielded, None),
        };
        let imposed = groups(functional, Role::Imposed, None).into_iter();
        let all = imposed.chain(own).flat_map(|group| group.equations);
        all.filter(|&e| !functional.space.vanishes(e)).collect()
    }

    /// Whether equations have solutions with any jets that satisfy them at one place: those that are linear have, as their solutions go on to
    /// the ends of the body; of others, as u' = 1 + u², they may end before. In more than one dimension the coefficients have to be
    /// constant (Ehrenpreis and Malgrange, 1955).
    fn have_solutions(&self, equations: &[Bound]) -> bool {
        let space = &*self.functional.space;
        let is_line = space.coordinates.len() == 1;
        let factors = equations.iter().flat_map(|own| jet_factors(space, own.e));
        factors.into_iter().all(|e| {
            space.jets_in(&[e]).iter().all(|jet| {
                let slope = [space.partial(e, jet)];
                space.jets_in(&slope).is_empty() && (is_line || !space.is_of_place(&slope))
            })
        })
    }

    /// Whether what is divided by to solve the equations of the body for derivatives vanishes nowhere, its ends included, and their coefficients
    /// are smooth there.
    pub(super) fn is_regular(&self, solved: &Solved<'f>) -> bool {
        let space = &*self.functional.space;
        let g = &space.graph;
        let region = Region::new(space, self.functional.intervals.clone(), true);
        let divisors = solved.divisors.iter().map(|&e| (e, Relation::NotEqual));
        let equations = solved.beyond(&Solved::new(space)).into_iter();
        let coefficients = equations.flat_map(|e| guards(g, space.explicit(e)));
        let is_of_place = |own: &Guard| space.is_of_place(&[own.0]);
        let mut all = divisors.chain(coefficients).filter(is_of_place);
        all.all(|guard| region.holds(guard) == Some(true))
    }

    /// Whether all equations of the body, or all conditions on its boundary, contain data by which they hold. On a line the conditions at the
    /// end where a jet is hold at it.
    fn has_data(&self, es: &[Expr], system: System, on: Option<&str>) -> bool {
        let functional = self.functional;
        let is_line = functional.space.coordinates.len() == 1;
        let meet = |on: &str| on.contains(',');
        let mut equations = functional.equations.iter();
        let has_corners = equations.any(|own| own.on.as_deref().is_some_and(meet));
        if has_corners && on.is_some_and(meet) {
            return false;
        }
        let known = self.extended.borrow().get(&system).copied();
        if let Some(known) = known.filter(|_| !is_line) {
            return known;
        }
        let own = self.whole(system, es, on);
        // What restricts parameters somewhere restricts them everywhere.
        let restricts = |own: &Bound| functional.space.jets_in(&[own.e]).is_empty();
        if own.inside.iter().chain(own.conditions()).any(restricts) {
            return false;
        }
        let found = self.is_local(system, &own) || self.is_continued(system, &own);
        self.extended.borrow_mut().insert(system, found);
        found
    }

    /// The conditions of a system where two pieces meet.
    fn where_meeting(&self, system: System) -> Vec<Expr> {
        let functional = self.functional;
        let stated = |role: Role| {
            let own = functional.with_role(role);
            let own = own.filter(|own| own.on.as_ref().is_some_and(|on| on.contains(',')));
            own.flat_map(|own| own.residuals.iter().copied())
        };
        let mut found: Vec<Expr> = stated(Role::Imposed).collect();
        match system {
            System::Stated => found.extend(stated(Role::Yielded)),
            System::Derived => {
                let corners = self.variation.corners.iter();
                found.extend(corners.map(|corner| corner.value));
                found.extend(self.at_edges());
            }
        }
        found.retain(|&e| !functional.space.vanishes(e));
        found
    }

    /// What the first variation asks for where curved pieces meet.
    fn at_edges(&self) -> Vec<Expr> {
        let pieces = &self.variation.pieces;
        if self.functional.space.dimensions() == 1 {
            return Vec::new();
        }
        let pairs = pieces.iter().enumerate();
        let pairs =
            pairs.flat_map(|(at, one)| pieces[at + 1..].iter().map(move |other| (one, other)));
        let all = pairs.flat_map(|(one, other)| {
            let own = acting_at_edge(one, other).into_iter();
            own.flat_map(|component| at_edge(self.functional, one, other, component))
        });
        all.collect()
    }

    /// Whether what holds where two pieces meet does not matter at other places. In general it is carried along the pieces; where it holds at rest,
    /// and so do all conditions, fields that vanish but near one place satisfy it.
    fn is_apart_from_corners(&self, system: System, own: &Whole) -> bool {
        let has_none = self.where_meeting(system).is_empty();
        has_none || own.conditions().all(|own| self.is_zero_at_rest(own.e))
    }

    /// Whether a condition at another place, without data of its own, speaks of what does not depend on all variables: then it says the same
    /// of it at the jet.
    fn reaches(&self, own: &Whole) -> bool {
        let space = &*self.functional.space;
        let bare = self.without_data(own.elsewhere.clone(), &own.looked_at);
        bare.iter().any(|own| {
            let jets = space.jets_in(&[space.explicit(own.e)]).into_iter();
            jets.into_iter()
                .any(|jet| !space.varies_everywhere(jet.component))
        })
    }

    /// The equations and conditions of a system, where expressions are looked at on a piece, or inside.
    fn whole(&self, system: System, es: &[Expr], on: Option<&str>) -> Whole {
        let functional = self.functional;
        let space = &*functional.space;
        let is_line = space.coordinates.len() == 1;
        let solved = self.inside(system);
        let bound = |es: Vec<Expr>, is_inside: bool| -> Vec<Bound> {
            let of = |e: Expr| Bound {
                e,
                data: self.data_in(e),
                is_inside,
            };
            es.into_iter().map(of).collect()
        };
        let (mut here, mut elsewhere) = (Vec::new(), Vec::new());
        for piece in &functional.pieces {
            let Some(own) = self.on(piece, system) else {
                continue;
            };
            let conditions = bound(own.beyond(solved), false);
            // On a line the conditions at the end where a jet is hold at it.
            if is_line && on == Some(&piece.name) {
                here.extend(conditions);
            } else {
                elsewhere.extend(conditions);
            }
        }
        // Where two pieces meet conditions hold that are those of neither.
        elsewhere.extend(bound(self.where_meeting(system), false));
        // A parameter is the same number everywhere, so also in what is looked at, and in the conditions that hold there.
        let looked_at = es.iter().flat_map(|&e| self.data_in(e));
        let of_here = here.iter().flat_map(|own: &Bound| own.data.clone());
        Whole {
            looked_at: looked_at.chain(of_here).collect(),
            inside: bound(solved.beyond(&Solved::new(space)), true),
            written: bound(self.as_written(system), true),
            here,
            elsewhere,
        }
    }

    /// Whether the equations of the body hold by data of their own, so that fields are bound by nothing but conditions at single places.
    fn is_local(&self, system: System, own: &Whole) -> bool {
        let functional = self.functional;
        let is_line = functional.space.coordinates.len() == 1;
        let hold = |all: &[Bound]| self.without_data(all.to_vec(), &own.looked_at).is_empty();
        let mut pieces = functional.pieces.iter();
        (hold(&own.written)
            || (self.is_regular_everywhere(self.inside(system)) && hold(&own.inside)))
            && self.is_apart_from_corners(system, own)
            && !self.reaches(own)
            && self.keeps_signs(own)
            && !own.products_meet(&functional.space)
            && (is_line || pieces.all(|piece| self.is_free_along(piece, system)))
    }

    /// Whether the conditions hold by data of their own, so that nothing but the equations of the body restricts a jet.
    fn is_continued(&self, system: System, own: &Whole) -> bool {
        let all = [own.inside.clone(), own.elsewhere.clone()].concat();
        let left = self.without_data(all, &own.looked_at);
        self.signed().is_empty()
            && self.is_regular_everywhere(self.inside(system))
            && left.iter().all(|own| own.is_inside)
            && self.have_solutions(&left)
    }

    /// Whether the conditions on a piece give fields and their derivatives across it, so that they are no differential equations along it; of
    /// a curved piece with second derivatives, whether they do where it is plane.
    fn is_free_along(&self, piece: &Piece, system: System) -> bool {
        let mut planes = self.planes.iter();
        let plane = planes.find(|own| own.functional.piece(&piece.name).is_some());
        if let Some(plane) = plane {
            let there = self.where_plane(plane);
            let mut pieces = plane.functional.pieces.iter();
            return pieces.all(|piece| there.is_free_along(piece, system));
        }
        let Some(on) = self.on(piece, system) else {
            return true;
        };
        let space = &*self.functional.space;
        let is_of_boundary = |jet: &Jet| space.component_at(jet.component).is_of_boundary;
        let mut given = on.jets_beyond(self.inside(system)).into_iter();
        given.all(|jet| match piece.side {
            Side::Flat { axis, .. } => jet.by.iter().all(|by| *by == axis),
            Side::Curved => jet.by.is_empty() || (jet.by.len() == 1 && !is_of_boundary(&jet)),
        })
    }

    /// The equations that are left when those are left out, one after the other, that alone contain something by which they hold.
    fn without_data(&self, mut open: Vec<Bound>, looked_at: &BTreeSet<Datum>) -> Vec<Bound> {
        let is_number = |datum: &Datum| matches!(datum, Datum::Parameter(_));
        let holds_by_own = |at: usize, open: &[Bound]| {
            let own = &open[at];
            let stands_elsewhere = |datum: &Datum| {
                let mut others = open.iter().enumerate().filter(|(other, _)| *other != at);
                others.any(|(_, own)| own.data.contains(datum))
            };
            // Of a product one factor vanishes at the jet, and is to vanish everywhere.
            jet_factors(&self.functional.space, own.e)
                .into_iter()
                .all(|factor| {
                    own.data.iter().any(|datum| {
                        let is_bound =
                            is_number(datum) && (own.is_inside || looked_at.contains(datum));
                        !is_bound && !stands_elsewhere(datum) && self.solves(factor, datum)
                    })
                })
        };
        while let Some(at) = (0..open.len()).find(|&at| holds_by_own(at, &open)) {
            open.remove(at);
        }
        open
    }

    fn inside(&self, system: System) -> &Solved<'f> {
        match system {
            System::Derived => &self.derived,
            System::Stated => self.stated(),
        }
    }

    /// What holds on a piece.
    fn on(&self, piece: &Piece, system: System) -> Option<Solved<'f>> {
        let mut all = self.variation.pieces.iter();
        let on = all.find(|on| on.piece == piece.name)?;
        Some(match system {
            System::Derived => self.derived_on(on, piece),
            System::Stated => self.stated_on(on, piece),
        })
    }

    /// What an equation may be solved for: data and fields, and on a line parameters; not what the model assumes something of.
    fn data_in(&self, e: Expr) -> BTreeSet<Datum> {
        let functional = self.functional;
        let space = &*functional.space;
        let g = &space.graph;
        let e = space.explicit(e);
        let jets = space.jets_in(&[e]).into_iter();
        let mut found: BTreeSet<Datum> = jets.map(|jet| Datum::Component(jet.component)).collect();
        if space.coordinates.len() == 1 {
            let names = functional.parameters.iter().map(|p| g.symbol(&p.name, 0));
            let parameters: Vec<Symbol> = names.filter_map(|e| g.as_symbol(e)).collect();
            let symbols = space.symbols_in(&[e]);
            let used = parameters.into_iter().filter(|s| symbols.contains(s));
            found.extend(used.map(Datum::Parameter));
        }
        let assumed = space.assumptions();
        let sides = assumed.list().iter().flat_map(|own| [own.left, own.right]);
        let symbols = space.symbols_in(&sides.collect::<Vec<Expr>>());
        let signed = self.signed();
        // Data of some variables alone are no load at one place.
        found.retain(|datum| match datum {
            Datum::Component(own) => !signed.contains(own) && space.varies_everywhere(*own),
            Datum::Parameter(own) => !symbols.contains(own),
        });
        found
    }

    /// Whether an equation is solved for a datum at each place: it is linear in it, with a factor of numbers and parameters.
    fn solves(&self, e: Expr, datum: &Datum) -> bool {
        let space = &*self.functional.space;
        let g = &space.graph;
        let e = space.explicit(e);
        let slope = match datum {
            Datum::Component(component) => {
                let jets = space.jets_in(&[e]).into_iter();
                let mut own = jets.filter(|jet| jet.component == *component);
                match (own.next(), own.next()) {
                    (Some(jet), None) if jet.by.is_empty() => space.partial(e, &jet),
                    _ => return false,
                }
            }
            Datum::Parameter(symbol) => space.derive(e, &|s| (s == *symbol).then(|| g.one())),
        };
        let is_constant = space.jets_in(&[slope]).is_empty() && !space.is_of_place(&[slope]);
        is_constant && !space.vanishes(slope)
    }
}

/// The factors of an expression in which jets occur, without powers: it vanishes where one of them does.
pub(super) fn jet_factors(space: &Space, e: Expr) -> Vec<Expr> {
    let e = space.explicit(e);
    let mut found = factors_of(space, e);
    found.retain(|&e| !space.jets_in(&[e]).is_empty());
    if found.is_empty() {
        found.push(e);
    }
    found
}

/// Whether an equation is linear in the jets.
fn is_linear(space: &Space, e: Expr) -> bool {
    let e = space.explicit(e);
    let jets = space.jets_in(&[e]);
    jets.iter()
        .all(|jet| space.jets_in(&[space.partial(e, jet)]).is_empty())
}
