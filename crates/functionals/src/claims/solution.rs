//! `functional.solution`: stated fields make the functional stationary, and give it the stated value.

use super::on_box::on_box;
use super::reduction::{admitted, reduced, restricted};
use super::special_values::{put_in, unfit, where_settled};
use super::traces::{traces, Traces};
use super::{Claim, Context, Finding};
use crate::functional::{names_in, Functional, Role, Side, Solution, Special, SpecialKind};
use crate::integral::{coefficients, over_box, over_face};
use crate::read::on_side;
use crate::smoothness::{guards, Guard, Region};
use crate::variation::Variation;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::assumptions::{Assumptions, Relation};
use chetaev_symbolic::{rational, Expr, Verdict};

/// `functional.solution#NAME`.
pub(super) struct Stated;

/// Degree of the polynomials that variations are made of.
const DEGREE: usize = 3;

impl Claim for Stated {
    fn id(&self) -> &'static str {
        "functional.solution"
    }

    fn title(&self) -> &'static str {
        "The stated fields make the functional stationary and give it the stated value"
    }

    fn explanation(&self) -> &'static str {
        "A section [solutions.NAME] states fields in closed form, data, parameters and constitutive functions on a box, and where the \
         pieces of the boundary lie. They are put into what is imposed, into every Euler equation and every natural condition, \
         which must vanish identically. The fields, and the densities at them, have to be smooth on the whole box with its boundary: where \
         that is not shown, the claim is undecided. A piece without a shape is the faces that are stated for it, with the conditions where \
         two of them meet. In one dimension the functional itself is then varied, without its Euler equations: every admissible \
         variation by polynomials up to the third degree must leave it unchanged to the first order. Admissible are variations that keep what is \
         imposed; how many there are is said, as for some functionals there are none. The value is integrated exactly."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let all = cx.problem.solutions.iter();
        all.map(|solution| Some(solution.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let mut all = cx.problem.solutions.iter();
        let own = all.find(|solution| Some(solution.name.as_str()) == subject);
        match (own, &cx.variation) {
            (Some(own), Ok(variation)) => {
                if let Some(unfit) = unfit(cx.functional(), &own.values, &own.intervals) {
                    return unfit.into();
                }
                match on_box(cx.functional(), own) {
                    Some((functional, own)) => match crate::variation::variation(&functional) {
                        Ok(variation) => Inserted::decided(&functional, &own, &variation).into(),
                        Err(problem) => Verdict::undecided(problem.to_string()).into(),
                    },
                    None => Inserted::decided(cx.functional(), own, variation).into(),
                }
            }
            (None, _) => Verdict::undecided("there is no such solution").into(),
            (_, Err(problem)) => Verdict::undecided(problem.to_string()).into(),
        }
    }
}

/// Why natural conditions may hold only taken together.
fn bound(functional: &Functional, variation: &Variation) -> Option<String> {
    match traces(functional, variation) {
        Traces::Arbitrary => None,
        Traces::Where(condition) => Some(format!(
            "the natural conditions hold one by one where {condition}"
        )),
        Traces::Open(why) => Some(why),
    }
}

struct Inserted<'f> {
    functional: &'f Functional,
    solution: &'f Solution,
}

impl<'f> Inserted<'f> {
    fn decided(
        functional: &'f Functional,
        solution: &'f Solution,
        variation: &Variation,
    ) -> Verdict {
        let inserted = Inserted {
            functional,
            solution,
        };
        let reduced = reduced(functional).functional;
        match admitted(&reduced) {
            Ok(own) => match restricted(&reduced, &own) {
                None => inserted.verdict(&own, bound(&reduced, &own).as_deref()),
                some => inserted.verdict(variation, some.as_deref()),
            },
            Err(_) => inserted.verdict(variation, None),
        }
    }

    /// The verdict by the equations of a variation that is free, or restricted for the reason that is given.
    fn verdict(&self, variation: &Variation, restricted: Option<&str>) -> Verdict {
        let space = &*self.functional.space;
        if let Some(piece) = self.unplaced(variation) {
            return Verdict::undecided(format!(
                "where {piece} lies is not stated, so that the conditions on it were not looked at: [solutions.{}.pieces] says it, on the box of its intervals",
                self.solution.name
            ));
        }
        if let Some(name) = self.circular() {
            return Verdict::undecided(format!(
                "the stated value of {name} needs itself, so that it is none"
            ));
        }
        if let Some((what, where_rough)) = self.rough() {
            return Verdict::undecided(format!(
                "{what} was not shown to be smooth on the body: {where_rough}, and where it is not, the equations say nothing"
            ));
        }
        if let Err(verdict) = self.hold(self.imposed()) {
            return *verdict;
        }
        if let Err(verdict) = self.hold(self.residuals(variation)) {
            return match restricted {
                Some(why) => self.of_restricted(why),
                None => *verdict,
            };
        }
        let inside = self.inside();
        let mut told = vec![
            "the stated fields satisfy what is imposed, every Euler equation and every natural condition"
                .to_owned(),
        ];
        if space.coordinates.len() == 1 {
            match self.varied() {
                Ok(sentence) => told.push(sentence),
                Err(verdict) => return *verdict,
            }
        }
        if let Some((written, wanted)) = &self.solution.value {
            let Some(value) = self.value() else {
                return Verdict::undecided("the densities are no polynomials at the stated fields, so the value was not integrated");
            };
            let difference = space.graph.sub(value, self.at(*wanted));
            match space.vanishing_under(&[difference], true, &inside) {
                Verdict::Proved(_) => told.push(format!("the value is {written}")),
                other => {
                    let values = &self.solution.values;
                    let other = where_settled(self.functional, values, &[difference], other);
                    let own = space.graph.text(value);
                    return other.prefixed(&format!("the value is {own}, not {written}"));
                }
            }
        }
        Verdict::Proved(Proof::exact("the stated fields", told.join("; ")))
    }

    /// Whether all of these vanish at the stated fields.
    fn hold(&self, residuals: Vec<(String, Expr)>) -> Result<(), Box<Verdict>> {
        let inside = self.inside();
        for (what, e) in residuals {
            match self.functional.space.vanishing_under(&[e], true, &inside) {
                Verdict::Proved(_) => {}
                other => {
                    let values = &self.solution.values;
                    let other = where_settled(self.functional, values, &[e], other);
                    let what = format!("{what} does not hold for the stated fields");
                    return Err(Box::new(other.prefixed(&what)));
                }
            }
        }
        Ok(())
    }

    /// Where fewer variations are admitted than those from which the Euler equations follow, the fields may be stationary though these do not hold: an
    /// admissible variation with a first variation that is not zero refutes.
    fn of_restricted(&self, why: &str) -> Verdict {
        let space = &*self.functional.space;
        let varied = (space.coordinates.len() == 1).then(|| self.varied());
        match varied {
            Some(Err(verdict)) if matches!(*verdict, Verdict::Refuted(_)) => *verdict,
            _ => Verdict::undecided(format!(
                "{why}; not all Euler equations and natural conditions hold for the stated fields, and whether the first variation vanishes for the variations that are \
                 admitted was not decided"
            )),
        }
    }

    /// Places inside of the box of the solution.
    fn inside(&self) -> Assumptions {
        let space = &*self.functional.space;
        let mut found = space.assumptions();
        for own in &self.solution.intervals {
            if let Some(place) = space.coordinates.get(own.axis).map(|c| c.expr) {
                found.assume(own.lower, Relation::Less, own.upper);
                found.assume(own.lower, Relation::Less, place);
                found.assume(place, Relation::Less, own.upper);
            }
        }
        found
    }

    /// What may not be smooth on the body, its boundary included: a stated field, or a density at the stated fields; and why.
    fn rough(&self) -> Option<(String, String)> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let region = Region::new(space, self.solution.intervals.clone(), true);
        let shown = |(inner, wanted): Guard| {
            let is_open = region.holds((inner, wanted)) != Some(true);
            is_open.then(|| {
                format!(
                    "{} {} 0 was not shown there",
                    g.text(inner),
                    wanted.symbol()
                )
            })
        };
        for (field, value) in self.pairs() {
            let mut own = guards(g, value)
                .into_iter()
                .filter(|own| space.is_of_place(&[own.0]));
            if let Some(why) = own.find_map(shown) {
                return Some((format!("{} = {}", g.text(field), g.text(value)), why));
            }
        }
        // What stands in a guard is put in after it was found: |u| is no kink of 0 only after u = 0 is.
        let is_of_fields =
            |own: &Guard| !space.jets_in(&[own.0]).is_empty() || space.is_of_place(&[own.0]);
        let inside = guards(g, space.explicit(self.functional.density)).into_iter();
        let inside = inside
            .filter(is_of_fields)
            .map(|own| (self.at(own.0), own.1));
        let on_pieces = self.functional.pieces.iter().flat_map(|piece| {
            let own = guards(g, space.explicit(piece.density)).into_iter();
            own.filter(is_of_fields).flat_map(|(inner, wanted)| {
                let on = self.on(&piece.name, inner).into_iter();
                on.map(move |e| (e, wanted))
            })
        });
        let why = inside.chain(on_pieces).find_map(shown)?;
        Some(("a density at the stated fields".to_owned(), why))
    }

    /// The stated values put in; fields with their derivatives.
    fn at(&self, e: Expr) -> Expr {
        let functions: Vec<Special> = self.some(|s| matches!(s.what, SpecialKind::Function { .. }));
        let space = &*self.functional.space;
        let e = put_in(self.functional, &functions, e);
        space.put(space.explicit(e), &self.pairs())
    }

    /// The stated values with each other put in.
    fn pairs(&self) -> Vec<(Expr, Expr)> {
        let space = &*self.functional.space;
        let own = self.solution.values.iter();
        let own = own.filter_map(|special| match &special.what {
            SpecialKind::Symbols(pairs) => Some(pairs.clone()),
            SpecialKind::Size | SpecialKind::Function { .. } => None,
        });
        let stated: Vec<(Expr, Expr)> = own.flatten().collect();
        let mut pairs = stated.clone();
        // So many at most stand between a value and what it needs.
        for _ in 0..stated.len() {
            for (_, value) in &mut pairs {
                *value = space.put(space.explicit(*value), &stated);
            }
        }
        pairs
    }

    /// A stated value that needs itself.
    fn circular(&self) -> Option<String> {
        let space = &*self.functional.space;
        let pairs = self.pairs();
        let is_open =
            |value: &Expr| space.put(space.explicit(*value), &pairs) != space.explicit(*value);
        let (own, _) = pairs.iter().find(|(_, value)| is_open(value))?;
        Some(space.graph.text(*own))
    }

    fn some(&self, wanted: impl Fn(&Special) -> bool) -> Vec<Special> {
        let own = self.solution.values.iter();
        own.filter(|s| wanted(s)).cloned().collect()
    }

    /// The faces of the box that a piece is.
    fn sides<'s>(&'s self, piece: &'s str) -> impl Iterator<Item = &'s Side> + 's {
        let own = self.solution.pieces.iter();
        own.filter(move |(name, _)| name == piece)
            .map(|(_, side)| side)
    }

    /// An expression on each face of a piece: the normal, and the variable that is constant there.
    fn on(&self, piece: &str, e: Expr) -> Vec<Expr> {
        let own = self.sides(piece);
        own.filter_map(|side| self.on_face(side, e)).collect()
    }

    fn on_face(&self, side: &Side, e: Expr) -> Option<Expr> {
        let Side::Flat { axis, at, .. } = side else {
            return None;
        };
        let space = &*self.functional.space;
        let own = self.at(on_side(&self.functional.scope, side, e));
        let place = space.coordinates.get(*axis)?.expr;
        Some(space.graph.substitute(own, &[(place, *at)]))
    }

    /// A piece with conditions whose place is not stated.
    fn unplaced(&self, variation: &Variation) -> Option<String> {
        let is_placed = |name: &str| {
            let own = self.functional.piece(name);
            let is_known = self.solution.has_pieces
                || own.is_some_and(|piece| matches!(piece.side, Side::Flat { .. }));
            is_known
                && self
                    .sides(name)
                    .all(|side| matches!(side, Side::Flat { .. }))
        };
        let imposed = self.functional.with_role(Role::Imposed);
        let imposed = imposed.filter_map(|e| e.on.clone());
        let imposed = imposed.flat_map(|on| {
            let names = names_in(&on).into_iter();
            names.map(str::to_owned).collect::<Vec<_>>()
        });
        let free = variation
            .pieces
            .iter()
            .filter(|on| !on.conditions.is_empty());
        let mut all = imposed.chain(free.map(|on| on.piece.clone()));
        all.find(|name| !is_placed(name))
    }

    /// An expression wherever faces of all these pieces meet.
    fn meeting(&self, names: &[&str], e: Expr) -> Vec<Expr> {
        let space = &*self.functional.space;
        let mut places: Vec<Vec<&Side>> = vec![Vec::new()];
        for name in names {
            let mut longer = Vec::new();
            for place in &places {
                let meets = |side: &&Side| place.iter().all(|own| own.meets(side));
                let own = self.sides(name).filter(meets);
                longer.extend(own.map(|side| [place.as_slice(), &[side]].concat()));
            }
            places = longer;
        }
        let at = |place: Vec<&Side>| {
            let (first, others) = place.split_first()?;
            let own = self.on_face(first, e)?;
            let value = |side: &&Side| match side {
                Side::Flat { axis, at, .. } => Some((space.coordinates.get(*axis)?.expr, *at)),
                Side::Curved => None,
            };
            let values: Option<Vec<(Expr, Expr)>> = others.iter().map(value).collect();
            Some(space.graph.substitute(own, &values?))
        };
        places.into_iter().filter_map(at).collect()
    }

    /// What vanishes by what is imposed.
    fn imposed(&self) -> Vec<(String, Expr)> {
        let mut found = Vec::new();
        for equation in self.functional.with_role(Role::Imposed) {
            let what = format!("the imposed equation ({})", equation.label);
            for &e in &equation.residuals {
                let own = match &equation.on {
                    None => vec![self.at(e)],
                    Some(on) => match names_in(on)[..] {
                        [_] => self.on(on, e),
                        ref names => self.meeting(names, e),
                    },
                };
                found.extend(own.into_iter().map(|e| (what.clone(), e)));
            }
        }
        found
    }

    /// What vanishes by the Euler equations and the natural conditions.
    fn residuals(&self, variation: &Variation) -> Vec<(String, Expr)> {
        let space = &*self.functional.space;
        let mut found = Vec::new();
        for &(component, value) in &variation.euler {
            let name = space.component_at(component).name;
            found.push((format!("the Euler equation of {name}"), self.at(value)));
        }
        for on in &variation.pieces {
            for condition in &on.conditions {
                let name = space.component_at(condition.component).name;
                let what = format!("the natural condition of {name} on {}", on.piece);
                let own = self.on(&on.piece, condition.value).into_iter();
                found.extend(own.map(|e| (what.clone(), e)));
            }
        }
        for corner in &variation.corners {
            let (one, other) = (corner.pieces.0.as_str(), corner.pieces.1.as_str());
            let name = space.component_at(corner.component).name;
            let what = format!("the condition of {name} where {one} and {other} meet");
            let own = self.meeting(&[one, other], corner.value).into_iter();
            found.extend(own.map(|e| (what.clone(), e)));
        }
        found
    }

    fn value(&self) -> Option<Expr> {
        let space = &*self.functional.space;
        let mut terms = vec![over_box(
            space,
            self.at(self.functional.density),
            &self.solution.intervals,
        )?];
        for piece in &self.functional.pieces {
            for side in self.sides(&piece.name) {
                let own = self.at(on_side(&self.functional.scope, side, piece.density));
                terms.push(over_face(space, own, side, &self.solution.intervals)?);
            }
        }
        Some(space.graph.add(&terms))
    }

    /// The first variation of the functional itself by all admissible polynomials.
    fn varied(&self) -> Result<String, Box<Verdict>> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let undecided = |why: &str| Box::new(Verdict::undecided(why));
        let ansatz = self.ansatz();
        let unknowns: Vec<Expr> = ansatz.iter().flat_map(|(_, own)| own.clone()).collect();
        // The Euler equations and natural conditions hold already: this is a second way, for polynomials only.
        let (Some(conditions), Some(first)) = (self.kept(&ansatz), self.first(&ansatz)) else {
            return Ok(
                "the functional itself was not varied, as it is no polynomial at them".to_owned(),
            );
        };
        let slopes = |e: Expr| -> Vec<Expr> {
            let one = g.one();
            let own = unknowns.iter().filter_map(|&c| g.as_symbol(c));
            own.map(|c| g.derive(&[e], &|s| (s == c).then_some(one)).swap_remove(0))
                .collect()
        };
        let rows: Vec<Vec<Expr>> = conditions.iter().map(|&e| slopes(e)).collect();
        let kernel = kernel(self.functional, &rows, unknowns.len())
            .ok_or_else(|| undecided("the conditions on admissible variations were not solved"))?;
        let gradient = slopes(first);
        for vector in &kernel {
            let terms: Vec<Expr> = vector
                .iter()
                .zip(&gradient)
                .map(|(&a, &b)| g.mul(&[a, b]))
                .collect();
            match space.vanishing(&[g.add(&terms)], true) {
                Verdict::Proved(_) => {}
                other => {
                    return Err(Box::new(other.prefixed(
                        "the first variation of the functional does not vanish for an admissible variation",
                    )))
                }
            }
        }
        Ok(self.told(&ansatz, &kernel))
    }

    fn told(&self, ansatz: &[(usize, Vec<Expr>)], kernel: &[Vec<Expr>]) -> String {
        let g = &self.functional.space.graph;
        let mut at = 0;
        let mut fields: Vec<String> = Vec::new();
        let mut idle: Vec<String> = Vec::new();
        for (component, own) in ansatz {
            let range = at..at + own.len();
            at += own.len();
            let moves = kernel.iter().any(|vector| {
                range
                    .clone()
                    .any(|i| vector.get(i).is_some_and(|&e| !g.is_zero(e)))
            });
            let name = self.functional.space.component_at(*component).name;
            if moves {
                fields.push(name)
            } else {
                idle.push(name)
            }
        }
        let all: usize = ansatz.iter().map(|(_, own)| own.len()).sum();
        if kernel.is_empty() {
            return format!("no variation by polynomials of degree {DEGREE} is admissible, so that there is nothing to vary");
        }
        let mut free = match kernel {
            [only] => format!(
                "1 of {all} coefficients is free: {}",
                self.written(ansatz, only).join(", ")
            ),
            many => format!("{} of {all} coefficients are free", many.len()),
        };
        if !idle.is_empty() {
            free.push_str(&format!(", which does not vary {}", idle.join(", ")));
        }
        format!(
            "the first variation vanishes for all admissible variations of {} by polynomials of degree {DEGREE} ({free})",
            fields.join(", "),
        )
    }

    /// `δu_1 = c x_1` for each component that a vector of coefficients varies.
    fn written(&self, ansatz: &[(usize, Vec<Expr>)], vector: &[Expr]) -> Vec<String> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let variable = space.coordinates.first().map(|c| c.expr);
        let mut coefficients = vector.iter().copied();
        let varied = ansatz.iter().map(|(component, own)| {
            let powers = coefficients.by_ref().take(own.len()).enumerate();
            let terms: Vec<Expr> = powers
                .filter_map(|(k, e)| Some(g.mul(&[e, g.powi(variable?, k as i64)])))
                .collect();
            (space.component_at(*component).name, g.add(&terms))
        });
        varied
            .filter(|(_, e)| !g.is_zero(*e))
            .map(|(name, e)| {
                let scaled = g.mul(&[g.symbol("c", 0), e]);
                format!("δ{name} = {}", g.text(scaled))
            })
            .collect()
    }

    /// Every component that is varied with the coefficients of its polynomial; on a piece it is a number.
    fn ansatz(&self) -> Vec<(usize, Vec<Expr>)> {
        let g = &self.functional.space.graph;
        let mut found = Vec::new();
        for field in &self.functional.fields {
            let count = if field.on.is_some() { 1 } else { DEGREE + 1 };
            for &component in &field.components {
                let own = (0..count)
                    .map(|k| g.symbol(&format!("variation {component} {k}"), 0))
                    .collect();
                found.push((component, own));
            }
        }
        found
    }

    /// The change of an expression to the first order, at the stated fields.
    fn change(&self, e: Expr, ansatz: &[(usize, Vec<Expr>)]) -> Expr {
        let space = &*self.functional.space;
        let g = &space.graph;
        let variable = space.coordinates.first().map(|c| c.expr);
        let mut terms = Vec::new();
        for jet in space.jets_in(&[e]) {
            let Some((_, own)) = ansatz.iter().find(|(c, _)| *c == jet.component) else {
                continue;
            };
            let powers = own
                .iter()
                .enumerate()
                .filter_map(|(k, &c)| Some(g.mul(&[c, g.powi(variable?, k as i64)])));
            let varied = g.add(&powers.collect::<Vec<_>>());
            let slope = self.at(space.partial(e, &jet));
            terms.push(g.mul(&[slope, space.totals(varied, &jet.by)]));
        }
        g.add(&terms)
    }

    /// The first variation, linear in the coefficients.
    fn first(&self, ansatz: &[(usize, Vec<Expr>)]) -> Option<Expr> {
        let space = &*self.functional.space;
        let inside = self.change(self.functional.density, ansatz);
        let mut terms = vec![over_box(space, inside, &self.solution.intervals)?];
        for piece in &self.functional.pieces {
            terms.extend(self.change_on(&piece.name, piece.density, ansatz)?);
        }
        Some(space.graph.add(&terms))
    }

    /// The same over each face of a piece.
    fn change_on(&self, piece: &str, e: Expr, ansatz: &[(usize, Vec<Expr>)]) -> Option<Vec<Expr>> {
        let over = |side: &Side| {
            let own = self.change(on_side(&self.functional.scope, side, e), ansatz);
            over_face(&self.functional.space, own, side, &self.solution.intervals)
        };
        self.sides(piece).map(over).collect()
    }

    /// What keeps the imposed equations to the first order, and what is given on a piece.
    fn kept(&self, ansatz: &[(usize, Vec<Expr>)]) -> Option<Vec<Expr>> {
        let space = &*self.functional.space;
        let mut found = Vec::new();
        for equation in self.functional.with_role(Role::Imposed) {
            for &e in &equation.residuals {
                match &equation.on {
                    None => found.extend(coefficients(space, self.change(e, ansatz), 0)?),
                    Some(piece) => found.extend(self.change_on(piece, e, ansatz)?),
                }
            }
        }
        for piece in &self.functional.pieces {
            for &(component, is_normal) in &piece.fixed {
                let by: &[usize] = if is_normal { &[0] } else { &[] };
                found.extend(self.change_on(&piece.name, space.jet(component, by), ansatz)?);
            }
        }
        Some(found)
    }
}

/// What may not be smooth on the body at a solution, and why.
pub(super) fn rough(functional: &Functional, solution: &Solution) -> Option<(String, String)> {
    let inserted = Inserted {
        functional,
        solution,
    };
    inserted.rough()
}

/// A basis of the solutions of linear homogeneous equations with constant coefficients.
fn kernel(functional: &Functional, rows: &[Vec<Expr>], columns: usize) -> Option<Vec<Vec<Expr>>> {
    let space = &*functional.space;
    let g = &space.graph;
    let is_zero = |e: Expr| g.is_zero(e) || space.vanish(&[e]);
    let mut rows: Vec<Vec<Expr>> = rows.to_vec();
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    let mut next = 0;
    for column in 0..columns {
        let found = (next..rows.len()).find(|&r| rows[r].get(column).is_some_and(|&e| !is_zero(e)));
        let Some(found) = found else { continue };
        rows.swap(next, found);
        let pivot = *rows.get(next)?.get(column)?;
        let own: Vec<Expr> = rows[next].iter().map(|&e| g.div(e, pivot)).collect();
        for (r, row) in rows.iter_mut().enumerate() {
            let factor = *row.get(column)?;
            if r == next || g.is_zero(factor) {
                continue;
            }
            for (e, &o) in row.iter_mut().zip(&own) {
                let new = g.sub(*e, g.mul(&[factor, o]));
                *e = if is_zero(new) { g.zero() } else { new };
            }
        }
        rows[next] = own;
        pivots.push((next, column));
        next += 1;
    }
    let free = (0..columns).filter(|c| pivots.iter().all(|(_, own)| own != c));
    let basis = free.map(|column| {
        let mut vector = vec![g.zero(); columns];
        vector[column] = g.number(rational::integer(1));
        for &(row, own) in &pivots {
            vector[own] = g.neg(rows[row][column]);
        }
        vector
    });
    Some(basis.collect())
}
