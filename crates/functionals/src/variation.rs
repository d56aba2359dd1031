//! The first variation: Euler equations, conditions on each piece of the boundary, and conditions at corners.
//!
//! For densities with derivatives up to the second order. Derivatives of variations along a piece are moved off the variation: on
//! a face of a box by parts, which leaves terms where faces meet (Kirchhoff 1850); on a curved piece by the divergence
//! theorem on the surface, ∫ q·∇δu = ∫ (n·q) ∂δu/∂n − ∫ (Π:∇q − (n·q) div n) δu, where Π projects on the tangent plane, which
//! brings in the curvature and leaves terms at the edges of the piece. What comes out are the coefficients of independent variations.

use crate::functional::{place_of, Functional, Piece, Side};
use crate::read::on_side;
use crate::space::{Jet, Multi, Space};
use chetaev_symbolic::Expr;
use std::collections::{BTreeMap, BTreeSet};

/// A variation that a density has no room for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VariationError {
    /// Derivatives of higher order than two in the interior.
    Order {
        /// The field.
        component: String,
        /// The order.
        order: usize,
    },
    /// Derivatives that a curved piece, or a face, has no conditions for.
    Piece {
        /// The piece.
        piece: String,
        /// The derivative of the field that is varied, as it is written.
        derivative: String,
    },
}

impl std::fmt::Display for VariationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            VariationError::Order { component, order } => write!(
                f,
                "the density contains a derivative of `{component}` of order {order}; up to order 2 the conditions on the boundary are derived"
            ),
            VariationError::Piece { piece, derivative } => write!(
                f,
                "the density on `{piece}` contains `{derivative}`; conditions are derived for densities there with first derivatives by place, and \
                 any by the time"
            ),
        }
    }
}

impl std::error::Error for VariationError {}

/// What is varied in a condition.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Trace {
    /// The component.
    Value,
    /// Its derivative across the piece: along the normal of a curved one, by the variable that is constant on a face.
    Normal,
}

/// The coefficient of a variation; it vanishes.
#[derive(Clone, Debug)]
pub struct Condition {
    /// The component that is varied.
    pub component: usize,
    /// What of it.
    pub trace: Trace,
    /// The coefficient, divided by how often the component occurs in its tensor.
    pub value: Expr,
}

/// The conditions on a piece.
#[derive(Clone, Debug)]
pub struct OnPiece {
    /// The piece.
    pub piece: String,
    /// Its conditions.
    pub conditions: Vec<Condition>,
    /// On a curved piece: coefficients of the gradients of variations, whose part along the piece acts at its edges too.
    pub slopes: Vec<(usize, Vec<Expr>)>,
}

/// The condition at an edge where two faces meet; in two dimensions a corner.
#[derive(Clone, Debug)]
pub struct Corner {
    /// Names of the pieces that meet.
    pub pieces: (String, String),
    /// The component.
    pub component: usize,
    /// The coefficient of its variation.
    pub value: Expr,
}

impl Corner {
    /// The name of the place, as an equation has it.
    pub fn place(&self) -> String {
        place_of(&[&self.pieces.0, &self.pieces.1])
    }
}

/// The first variation.
#[derive(Clone, Debug)]
pub struct Variation {
    /// Euler expressions of the components of the fields of the interior.
    pub euler: Vec<(usize, Expr)>,
    /// Conditions on the boundary.
    pub pieces: Vec<OnPiece>,
    /// Conditions where faces meet.
    pub corners: Vec<Corner>,
}

/// Coefficients of variations with derivatives.
pub(crate) type Form = BTreeMap<Jet, Expr>;

fn add(space: &Space, form: &mut Form, jet: Jet, term: Expr) {
    let g = &space.graph;
    let entry = form.entry(jet).or_insert_with(|| g.zero());
    *entry = g.add(&[*entry, term]);
}

/// The first variation of a functional; equations imposed with multipliers are added to it.
///
/// # Errors
/// Orders that are not treated.
pub fn variation(functional: &Functional) -> Result<Variation, VariationError> {
    let lagrange = Multipliers::of(functional);
    let space = &*functional.space;
    let density = lagrange.density;
    let varied: Vec<usize> = functional
        .interior()
        .flat_map(|f| f.components.clone())
        .collect();
    let euler = varied
        .iter()
        .map(|&component| {
            let whole = euler_expression(space, density, component);
            (
                component,
                lagrange.settled(space, by_multiplicity(space, component, whole)),
            )
        })
        .collect();
    let flux = flux(space, density, &varied)?;
    let mut pieces = Vec::new();
    let mut corners: Vec<Corner> = Vec::new();
    for (at, piece) in functional.pieces.iter().enumerate() {
        let form = boundary_form(functional, piece, lagrange.pieces[at], &flux);
        let settled: Form = form
            .into_iter()
            .map(|(jet, value)| (jet, lagrange.settled(space, value)))
            .filter(|(_, value)| !space.graph.is_zero(*value))
            .collect();
        let (own, ends) = conditions(functional, piece, &settled)?;
        pieces.push(own);
        for corner in ends {
            let swapped = (corner.pieces.1.clone(), corner.pieces.0.clone());
            let same = corners.iter_mut().find(|c| {
                c.component == corner.component
                    && (c.pieces == corner.pieces || c.pieces == swapped)
            });
            match same {
                Some(own) => own.value = space.graph.add(&[own.value, corner.value]),
                None => corners.push(corner),
            }
        }
    }
    let mut found = Variation {
        euler,
        pieces,
        corners,
    };
    found.put_in_places(functional);
    Ok(found)
}

impl Variation {
    /// On a face the variable across it has its value; conditions that say nothing then are none.
    fn put_in_places(&mut self, functional: &Functional) {
        let space = &*functional.space;
        let placed = |e: Expr, name: &str| match functional.piece(name).map(|piece| &piece.side) {
            Some(Side::Flat { axis, at, .. }) => space.at(e, *axis, *at),
            _ => e,
        };
        for on in &mut self.pieces {
            for condition in &mut on.conditions {
                condition.value = placed(condition.value, &on.piece);
            }
            on.conditions.retain(|own| !space.graph.is_zero(own.value));
        }
        for corner in &mut self.corners {
            corner.value = placed(placed(corner.value, &corner.pieces.0), &corner.pieces.1);
        }
        self.corners.retain(|own| !space.graph.is_zero(own.value));
    }
}

/// The densities with multipliers, and what the multipliers are.
struct Multipliers {
    density: Expr,
    pieces: Vec<Expr>,
    values: Vec<(usize, Expr)>,
}

impl Multipliers {
    fn of(functional: &Functional) -> Multipliers {
        let space = &*functional.space;
        let g = &space.graph;
        let mut own = Multipliers {
            density: functional.density,
            pieces: functional.pieces.iter().map(|p| p.density).collect(),
            values: Vec::new(),
        };
        for equation in &functional.equations {
            let (Some((_, values)), crate::functional::Role::Imposed) =
                (&equation.multiplier, equation.role)
            else {
                continue;
            };
            let term = own.term(space, &equation.label, &equation.residuals, values);
            match &equation.on {
                None => own.density = g.add(&[own.density, term]),
                Some(name) => {
                    let at = functional.pieces.iter().position(|p| p.name == *name);
                    if let Some(density) = at.and_then(|at| own.pieces.get_mut(at)) {
                        *density = g.add(&[*density, term]);
                    }
                }
            }
        }
        own
    }

    /// `λ R` with multipliers that are functions of place and are not varied.
    fn term(&mut self, space: &Space, label: &str, residuals: &[Expr], values: &[Expr]) -> Expr {
        let g = &space.graph;
        let mut terms = Vec::new();
        for (k, (&residual, &value)) in residuals.iter().zip(values).enumerate() {
            let component = space.component(crate::space::Component {
                name: format!("multiplier_{label}_{}", k + 1),
                tensor: format!("multiplier_{label}"),
                multiplicity: 1,
                is_varied: false,
                is_of_boundary: false,
                constant_along: Vec::new(),
            });
            self.values.push((component, value));
            terms.push(g.mul(&[space.jet(component, &[]), residual]));
        }
        g.add(&terms)
    }

    /// The multipliers replaced by what is stated for them.
    fn settled(&self, space: &Space, e: Expr) -> Expr {
        if self.values.is_empty() {
            return e;
        }
        let settled = space.replace(e, &|symbol| {
            let jet = space.as_jet(symbol)?;
            let (_, value) = self.values.iter().find(|(c, _)| *c == jet.component)?;
            Some(space.totals(*value, &jet.by))
        });
        if space.vanish(&[settled]) {
            space.graph.zero()
        } else {
            settled
        }
    }
}

/// An equation with its multiplier.
#[derive(Clone, Copy, Debug)]
pub struct Held<'e> {
    /// Its label.
    pub label: &'e str,
    /// What vanishes, all components.
    pub residuals: &'e [Expr],
    /// The multipliers, all components.
    pub multiplier: &'e [Expr],
}

/// The Euler expression of a component for the density with a term `λ R`, in which λ is not varied and takes its value afterwards.
pub fn euler_with(space: &Space, density: Expr, held: Held<'_>, component: usize) -> Expr {
    let mut own = Multipliers {
        density,
        pieces: Vec::new(),
        values: Vec::new(),
    };
    let term = own.term(space, held.label, held.residuals, held.multiplier);
    let whole = space.graph.add(&[density, term]);
    own.settled(space, euler_expression(space, whole, component))
}

/// Whether a density has no Euler expressions of these components: for them it is a divergence.
pub(crate) fn is_divergence(
    space: &Space,
    density: Expr,
    components: impl IntoIterator<Item = usize>,
) -> bool {
    components.into_iter().all(|component| {
        let own = euler_expression(space, density, component);
        space.graph.is_zero(own) || space.vanish(&[own])
    })
}

/// `Σ (−D)^α ∂L/∂c_α`.
pub fn euler_expression(space: &Space, density: Expr, component: usize) -> Expr {
    let g = &space.graph;
    let jets = space.jets_in(&[density]);
    let own = jets.into_iter().filter(|jet| jet.component == component);
    let terms: Vec<Expr> = own
        .map(|jet| {
            let moved = space.totals(space.partial(density, &jet), &jet.by);
            match jet.by.len() % 2 {
                0 => moved,
                _ => g.neg(moved),
            }
        })
        .collect();
    g.add(&terms)
}

fn by_multiplicity(space: &Space, component: usize, value: Expr) -> Expr {
    let g = &space.graph;
    match space.component_at(component).multiplicity {
        1 => value,
        many => g.div(value, g.integer(many)),
    }
}

/// The vector W with δL = Σ E δc + D_i W_i, for each independent variable.
pub(crate) fn flux(
    space: &Space,
    density: Expr,
    varied: &[usize],
) -> Result<Vec<Form>, VariationError> {
    let g = &space.graph;
    let mut flux = vec![Form::new(); space.coordinates.len()];
    for jet in space.jets_in(&[density]) {
        if !varied.contains(&jet.component) {
            continue;
        }
        let component = jet.component;
        let at = |by: Multi| Jet { component, by };
        let slope = || space.partial(density, &jet);
        match jet.by[..] {
            [] => {}
            [i] => add(space, &mut flux[i], at(Vec::new()), slope()),
            [i, j] => {
                let momentum = slope();
                let half = if i == j {
                    momentum
                } else {
                    g.div(momentum, g.integer(2))
                };
                let ways: &[(usize, usize)] = if i == j { &[(i, i)] } else { &[(i, j), (j, i)] };
                for &(first, second) in ways {
                    add(space, &mut flux[first], at(vec![second]), half);
                    let moved = g.neg(space.total(half, first));
                    add(space, &mut flux[second], at(Vec::new()), moved);
                }
            }
            _ => {
                return Err(VariationError::Order {
                    component: space.component_at(component).name,
                    order: jet.by.len(),
                })
            }
        }
    }
    Ok(flux)
}

/// The coefficients of independent variations on a piece, and what is left where it ends.
fn conditions(
    functional: &Functional,
    piece: &Piece,
    form: &Form,
) -> Result<(OnPiece, Vec<Corner>), VariationError> {
    match piece.side {
        Side::Curved => Ok((curved(functional, piece, form)?, Vec::new())),
        Side::Flat { axis, .. } => flat(functional, piece, axis, form),
    }
}

/// Whether a form has no coefficient of an independent variation on a piece: it vanishes up to a divergence along the piece.
pub(crate) fn vanishes_on(functional: &Functional, piece: &Piece, form: &Form) -> bool {
    let space = &*functional.space;
    let Ok((on, _)) = conditions(functional, piece, form) else {
        return false;
    };
    on.conditions.iter().all(|own| {
        let value = on_side(&functional.scope, &piece.side, own.value);
        space.graph.is_zero(value) || space.vanish(&[value])
    })
}

/// The coefficients of the variations and their derivatives on a piece, before anything is moved off them.
pub(crate) fn piece_form(functional: &Functional, name: &str) -> Option<BTreeMap<Jet, Expr>> {
    let space = &*functional.space;
    let lagrange = Multipliers::of(functional);
    let at = functional.pieces.iter().position(|p| p.name == name)?;
    let varied: Vec<usize> = functional
        .interior()
        .flat_map(|f| f.components.clone())
        .collect();
    let flux = flux(space, lagrange.density, &varied).ok()?;
    let form = boundary_form(
        functional,
        &functional.pieces[at],
        lagrange.pieces[at],
        &flux,
    );
    let settled = form.into_iter();
    Some(
        settled
            .map(|(jet, value)| (jet, lagrange.settled(space, value)))
            .collect(),
    )
}

/// `n_i W_i + δb` on a piece.
fn boundary_form(functional: &Functional, piece: &Piece, density: Expr, flux: &[Form]) -> Form {
    let space = &*functional.space;
    let g = &space.graph;
    let mut form = Form::new();
    let normal = space.normal();
    for (i, own) in flux.iter().enumerate() {
        if space.coordinates[i].is_time {
            continue;
        }
        let factor = match piece.side {
            Side::Curved => normal[i],
            Side::Flat { axis, is_upper, .. } => match (axis == i, is_upper) {
                (true, true) => g.one(),
                (true, false) => g.integer(-1),
                (false, _) => continue,
            },
        };
        for (jet, &value) in own {
            add(space, &mut form, jet.clone(), g.mul(&[factor, value]));
        }
    }
    let varied: Vec<usize> = functional
        .fields
        .iter()
        .filter(|f| f.on.as_ref().is_none_or(|on| *on == piece.name))
        .flat_map(|f| f.components.clone())
        .collect();
    for jet in space.jets_in(&[density]) {
        if varied.contains(&jet.component) {
            let slope = space.partial(density, &jet);
            add(space, &mut form, jet, slope);
        }
    }
    form
}

/// A term of the variation on a piece without derivatives by the time: the time runs along the piece, and variations vanish at its ends.
fn off_the_time(space: &Space, jet: &Jet, value: Expr) -> (Multi, Expr) {
    let g = &space.graph;
    let is_time = |&&axis: &&usize| space.coordinates[axis].is_time;
    let times: Multi = jet.by.iter().filter(is_time).copied().collect();
    let places: Multi = jet
        .by
        .iter()
        .filter(|axis| !is_time(axis))
        .copied()
        .collect();
    let moved = space.totals(value, &times);
    match times.len() % 2 {
        0 => (places, moved),
        _ => (places, g.neg(moved)),
    }
}

/// A derivative that a piece has no conditions for.
fn too_high(space: &Space, piece: &Piece, jet: &Jet) -> VariationError {
    VariationError::Piece {
        piece: piece.name.clone(),
        derivative: space.graph.text(space.jet(jet.component, &jet.by)),
    }
}

/// Conditions on a curved piece.
fn curved(functional: &Functional, piece: &Piece, form: &Form) -> Result<OnPiece, VariationError> {
    let space = &*functional.space;
    let g = &space.graph;
    let d = space.dimensions();
    let surface = Surface::new(functional);
    let mut values: BTreeMap<usize, Vec<Expr>> = BTreeMap::new();
    let mut slopes: BTreeMap<usize, Vec<Expr>> = BTreeMap::new();
    for (jet, &value) in form {
        let (by, value) = off_the_time(space, jet, value);
        match by[..] {
            [] => values.entry(jet.component).or_default().push(value),
            [i] => {
                let own = slopes
                    .entry(jet.component)
                    .or_insert_with(|| vec![g.zero(); d]);
                own[i] = g.add(&[own[i], value]);
            }
            _ => return Err(too_high(space, piece, jet)),
        }
    }
    let mut conditions = Vec::new();
    let mut push = |component: usize, trace: Trace, value: Expr| {
        let is_given = piece.fixed.contains(&(component, trace == Trace::Normal));
        if !g.is_zero(value) && !is_given {
            let value = by_multiplicity(space, component, value);
            conditions.push(Condition {
                component,
                trace,
                value,
            });
        }
    };
    for (&component, q) in &slopes {
        push(component, Trace::Normal, surface.through(q));
        let moved = g.neg(surface.divergence(q));
        values.entry(component).or_default().push(moved);
    }
    for (component, terms) in values {
        push(component, Trace::Value, g.add(&terms));
    }
    conditions.sort_by_key(|c| (c.component, c.trace.clone()));
    Ok(OnPiece {
        piece: piece.name.clone(),
        conditions,
        slopes: slopes.into_iter().collect(),
    })
}

/// Calculus on a curved surface with the normal n, whose derivative is the curvature: a symmetric tensor in the tangent plane.
struct Surface<'f> {
    space: &'f Space,
    normal: Vec<Expr>,
}

impl<'f> Surface<'f> {
    fn new(functional: &'f Functional) -> Surface<'f> {
        let space = &*functional.space;
        Surface {
            space,
            normal: space.normal(),
        }
    }

    /// `n·q`.
    fn through(&self, q: &[Expr]) -> Expr {
        let g = &self.space.graph;
        let terms: Vec<Expr> = self
            .normal
            .iter()
            .zip(q)
            .map(|(&n, &q)| g.mul(&[n, q]))
            .collect();
        g.add(&terms)
    }

    /// The divergence of the part of q along the surface.
    fn divergence(&self, q: &[Expr]) -> Expr {
        let g = &self.space.graph;
        let d = self.normal.len();
        if d == 1 {
            return g.zero();
        }
        let mut terms = Vec::new();
        for (j, &own) in q.iter().enumerate() {
            for k in 0..d {
                let slope = self.space.total(own, k);
                terms.push(g.mul(&[self.space.projector(j, k), slope]));
            }
        }
        let mean: Vec<Expr> = (0..d).map(|i| self.space.curvature(i, i)).collect();
        terms.push(g.neg(g.mul(&[self.through(q), g.add(&mean)])));
        g.add(&terms)
    }
}

/// Conditions on a face of a box: derivatives along it are moved off the variation, which leaves terms where faces meet.
fn flat(
    functional: &Functional,
    piece: &Piece,
    axis: usize,
    form: &Form,
) -> Result<(OnPiece, Vec<Corner>), VariationError> {
    let space = &*functional.space;
    let g = &space.graph;
    let mut coefficients: BTreeMap<(usize, usize), Expr> = BTreeMap::new();
    let mut corners = Vec::new();
    for (jet, &value) in form {
        let (by, value) = off_the_time(space, jet, value);
        let (own, across) = match by[..] {
            [] => (value, 0),
            [i] if i == axis => (value, 1),
            [i] => {
                corners.extend(ends(functional, piece, jet.component, i, value));
                (g.neg(space.total(value, i)), 0)
            }
            _ => return Err(too_high(space, piece, jet)),
        };
        let entry = coefficients
            .entry((jet.component, across))
            .or_insert_with(|| g.zero());
        *entry = g.add(&[*entry, own]);
    }
    let mut found = Vec::new();
    for ((component, across), value) in coefficients {
        let is_given = piece.fixed.contains(&(component, across == 1));
        if g.is_zero(value) || is_given {
            continue;
        }
        let value = by_multiplicity(space, component, value);
        let trace = if across == 1 {
            Trace::Normal
        } else {
            Trace::Value
        };
        found.push(Condition {
            component,
            trace,
            value,
        });
    }
    let on = OnPiece {
        piece: piece.name.clone(),
        conditions: found,
        slopes: Vec::new(),
    };
    Ok((on, corners))
}

/// The terms at the two ends of a face in the direction of an independent variable.
fn ends(
    functional: &Functional,
    piece: &Piece,
    component: usize,
    along: usize,
    value: Expr,
) -> Vec<Corner> {
    let g = &functional.space.graph;
    let mut found = Vec::new();
    for other in &functional.pieces {
        let Side::Flat { axis, is_upper, .. } = other.side else {
            continue;
        };
        let is_fixed = |p: &Piece| p.fixed.contains(&(component, false));
        if axis != along || is_fixed(other) || is_fixed(piece) {
            continue;
        }
        found.push(Corner {
            pieces: (piece.name.clone(), other.name.clone()),
            component,
            value: if is_upper { value } else { g.neg(value) },
        });
    }
    found
}

/// The components whose variations act where two curved pieces meet.
pub(crate) fn acting_at_edge(one: &OnPiece, other: &OnPiece) -> BTreeSet<usize> {
    let both = one.slopes.iter().chain(&other.slopes);
    both.map(|(component, _)| *component).collect()
}

/// What has to vanish for a component where two curved pieces meet with a common tangent plane: the part along it of the difference of the
/// coefficients of the gradient of its variation on the two.
pub(crate) fn at_edge(
    functional: &Functional,
    one: &OnPiece,
    other: &OnPiece,
    component: usize,
) -> Vec<Expr> {
    let space = &*functional.space;
    let g = &space.graph;
    let normal = space.normal();
    if normal.len() == 1 {
        return Vec::new();
    }
    let of = |on: &OnPiece| {
        let mut own = on.slopes.iter();
        let own = own.find(|(c, _)| *c == component).map(|(_, q)| q.clone());
        own.unwrap_or_else(|| vec![g.zero(); space.dimensions()])
    };
    let q: Vec<Expr> = of(one)
        .iter()
        .zip(&of(other))
        .map(|(&a, &b)| g.sub(a, b))
        .collect();
    let through: Vec<Expr> = normal
        .iter()
        .zip(&q)
        .map(|(&n, &q)| g.mul(&[n, q]))
        .collect();
    let through = g.add(&through);
    let own = normal.iter().zip(&q);
    own.map(|(&n, &q)| g.sub(q, g.mul(&[n, through]))).collect()
}
