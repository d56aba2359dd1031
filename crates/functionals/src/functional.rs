//! A functional of fields over space as plain data: densities, boundary pieces, what is imposed and what is stated.

use crate::notation::Node;
use crate::space::Space;
use crate::tensors::{Scope, Shape};
use chetaev_model::model::ModelText;
use chetaev_model::Place;
use chetaev_symbolic::{Expr, Rational, Symbol};
use std::rc::Rc;

/// A field, or data that depend on place.
#[derive(Clone, Debug)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub shape: Shape,
    /// Its independent components.
    pub components: Vec<usize>,
    /// What it is.
    pub description: String,
    /// The boundary piece on which alone it lives.
    pub on: Option<String>,
}

/// Where a piece of the boundary lies.
#[derive(Clone, Debug, PartialEq)]
pub enum Side {
    /// Any smooth piece, with the normal n.
    Curved,
    /// A face of a box: the independent variable that is constant, whether its larger value, and the value.
    Flat {
        /// The place of the variable.
        axis: usize,
        /// Whether the outward normal points forward.
        is_upper: bool,
        /// The value.
        at: Expr,
    },
}

impl Side {
    /// Whether two faces of a box meet at an edge.
    pub fn meets(&self, other: &Side) -> bool {
        match (self, other) {
            (Side::Flat { axis: one, .. }, Side::Flat { axis: two, .. }) => one != two,
            _ => false,
        }
    }
}

/// A piece of the boundary.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Its name.
    pub name: String,
    /// Where it lies.
    pub side: Side,
    /// The density over it.
    pub density: Expr,
    /// The density in index notation, where one is stated.
    pub tree: Option<Node>,
    /// The density as written.
    pub written: String,
    /// What is given on it: components, and whether their normal derivatives.
    pub fixed: Vec<(usize, bool)>,
}

impl Piece {
    /// Whether two faces of a box meet at an edge.
    pub fn meets(&self, other: &Piece) -> bool {
        self.side.meets(&other.side)
    }
}

/// The pieces that a place names.
pub(crate) fn names_in(on: &str) -> Vec<&str> {
    on.split(',').map(str::trim).collect()
}

/// The name of the place where pieces meet.
pub(crate) fn place_of(names: &[&str]) -> String {
    names.join(", ")
}

/// What a stated equation is for the functional.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Imposed before the variation.
    Imposed,
    /// Claimed to follow from it.
    Yielded,
    /// Neither.
    Other,
}

/// A stated equation.
#[derive(Clone, Debug)]
pub struct Equation {
    /// Its number or name.
    pub label: String,
    /// As written.
    pub written: String,
    /// What it says.
    pub title: String,
    /// The piece on which it holds, or those with commas, in the order of the boundary, where it holds at their meeting; the interior where `None`.
    pub on: Option<String>,
    /// Left minus right, all components.
    pub residuals: Vec<Expr>,
    /// What it is for the functional.
    pub role: Role,
    /// Whether the model states that its problem of Dirichlet, linearised, is solvable for any values on the boundary.
    pub is_solvable: bool,
    /// The multiplier stated for it, all components, as written and as an expression.
    pub multiplier: Option<(String, Vec<Expr>)>,
    /// Where it is written.
    pub place: Place,
}

impl Equation {
    /// As written, with the piece on which it holds.
    pub fn statement(&self) -> String {
        statement(&self.written, self.on.as_deref())
    }
}

/// `u_k = ubar_k on S_u`.
pub(crate) fn statement(written: &str, on: Option<&str>) -> String {
    match on {
        Some(on) => format!("{written} on {on}"),
        None => written.to_owned(),
    }
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub shape: Shape,
    /// Its value, if stated.
    pub value: Option<Expr>,
    /// What it is.
    pub description: String,
}

/// A definition.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The left side as written.
    pub name: String,
    /// The right side as written.
    pub written: String,
    /// What it is.
    pub description: String,
}

/// A constitutive function as it is stated.
#[derive(Clone, Debug)]
pub struct Constitutive {
    /// Its name.
    pub name: String,
    /// Its place among the functions of the space.
    pub function: usize,
    /// Its value as written, if stated.
    pub value: Option<String>,
    /// Its gradient as written, if stated.
    pub gradient: Option<String>,
    /// Its conjugate, if stated.
    pub conjugate: Option<String>,
    /// What it is.
    pub description: String,
}

/// The closed interval of an independent variable.
#[derive(Clone, Debug)]
pub struct Interval {
    /// The place of the variable.
    pub axis: usize,
    /// The smaller end.
    pub lower: Expr,
    /// The larger end.
    pub upper: Expr,
}

/// A functional with everything stated about it.
#[derive(Clone, Debug)]
pub struct Functional {
    /// Its name.
    pub name: String,
    /// Its level in a hierarchy, as written.
    pub level: Option<String>,
    /// What it is.
    pub description: String,
    /// Where it comes from.
    pub sources: Vec<String>,
    /// Its symbols.
    pub space: Rc<Space>,
    /// Its names.
    pub scope: Scope,
    /// Intervals of a box, empty for any domain.
    pub intervals: Vec<Interval>,
    /// Fields.
    pub fields: Vec<Field>,
    /// Data.
    pub data: Vec<Field>,
    /// Parameters.
    pub parameters: Vec<Parameter>,
    /// Constitutive functions.
    pub functions: Vec<Constitutive>,
    /// Definitions.
    pub definitions: Vec<Definition>,
    /// What is assumed of fields, data and parameters, as written.
    pub assumptions: Vec<String>,
    /// The density.
    pub density: Expr,
    /// The density in index notation.
    pub tree: Node,
    /// The density as written.
    pub written: String,
    /// The pieces of the boundary.
    pub pieces: Vec<Piece>,
    /// Stated equations.
    pub equations: Vec<Equation>,
    /// Kinds of symmetries that are asked for: `translations`, `rotations`, `scaling`.
    pub symmetries: Vec<String>,
}

impl Functional {
    /// The fields of the interior that are varied.
    pub fn interior(&self) -> impl Iterator<Item = &Field> {
        self.fields.iter().filter(|field| field.on.is_none())
    }

    /// Whether a component is one of a field that is varied, in the interior or on a piece.
    pub fn varies(&self, component: usize) -> bool {
        let mut fields = self.fields.iter();
        fields.any(|field| field.components.contains(&component))
    }

    /// The names of the variables on which data depend, where these are not all.
    pub fn variables_of(&self, field: &Field) -> Option<Vec<&str>> {
        let space = &*self.space;
        let varies = |axis: usize| {
            let mut own = field.components.iter();
            own.any(|&component| space.varies_along(component, axis))
        };
        let all = space.coordinates.iter().enumerate();
        let own: Vec<&str> = all
            .filter(|(axis, _)| varies(*axis))
            .map(|(_, c)| c.name.as_str())
            .collect();
        (own.len() < space.coordinates.len()).then_some(own)
    }

    /// The piece of a name.
    pub fn piece(&self, name: &str) -> Option<&Piece> {
        self.pieces.iter().find(|piece| piece.name == name)
    }

    /// The pieces that `a, b` or `a, b, c` names, where they meet; `None` for one piece.
    pub fn meeting(&self, on: &str) -> Option<Vec<&Piece>> {
        let names = names_in(on);
        if names.len() < 2 {
            return None;
        }
        names.into_iter().map(|name| self.piece(name)).collect()
    }

    /// Equations with a role.
    pub fn with_role(&self, role: Role) -> impl Iterator<Item = &Equation> {
        self.equations.iter().filter(move |e| e.role == role)
    }

    /// What is imposed without a multiplier, and restricts the variations of fields.
    pub fn restricting(&self) -> impl Iterator<Item = &Equation> {
        let imposed = self.with_role(Role::Imposed);
        imposed.filter(|e| e.multiplier.is_none() && !self.space.vanish(&e.residuals))
    }

    /// Puts values in for symbols in all densities, equations and multipliers.
    pub fn put(&mut self, value: &dyn Fn(Symbol) -> Option<Expr>) {
        let space = self.space.clone();
        let equations = self.equations.iter_mut().flat_map(|own| {
            let multiplier = own.multiplier.iter_mut().flat_map(|own| &mut own.1);
            own.residuals.iter_mut().chain(multiplier)
        });
        let pieces = self.pieces.iter_mut().map(|piece| &mut piece.density);
        let all = std::iter::once(&mut self.density)
            .chain(pieces)
            .chain(equations);
        all.for_each(|e| *e = space.replace(*e, value));
    }

    /// Known values of parameters: symbols with expressions.
    pub fn values(&self) -> Vec<(Expr, Expr)> {
        let g = &self.space.graph;
        let known = self.parameters.iter();
        known
            .filter_map(|p| Some((g.symbol(&p.name, 0), p.value?)))
            .collect()
    }

    /// Whether another functional is one over the same body, with the values that each states: where one is stated over any body it is.
    pub fn is_over_the_body_of(&self, other: &Functional) -> bool {
        let g = &self.space.graph;
        let ends = |own: &Functional| -> Vec<(usize, Expr, Expr)> {
            let values = own.values();
            let at = |e: Expr| g.substitute(e, &values);
            let all = own.intervals.iter();
            let mut ends: Vec<_> = all.map(|i| (i.axis, at(i.lower), at(i.upper))).collect();
            ends.sort_by_key(|(axis, ..)| *axis);
            ends
        };
        let (here, there) = (ends(self), ends(other));
        let is_same = |(a, b): (&(usize, Expr, Expr), &(usize, Expr, Expr))| {
            a.0 == b.0 && self.space.vanish(&[g.sub(a.1, b.1), g.sub(a.2, b.2)])
        };
        here.is_empty()
            || there.is_empty()
            || here.len() == there.len() && here.iter().zip(&there).all(is_same)
    }
}

/// A relation to another functional. Both are read onto symbols of their own: what the other file states is nothing that is known of the
/// functional for itself.
#[derive(Debug)]
pub enum Relation {
    /// The sum with the other is a divergence.
    Duality {
        /// The functional itself, on the symbols of both.
        own: Box<Functional>,
        /// The other.
        other: Functional,
        /// The vector whose divergence the sum of the densities is.
        flux: Option<(String, Vec<Expr>)>,
    },
    /// The functional follows from the other by imposing some of its equations.
    Descent {
        /// The functional itself, on the symbols of both.
        own: Box<Functional>,
        /// The other, one level above.
        other: Functional,
        /// Labels of the equations that are imposed on it.
        imposed: Vec<String>,
        /// How the way back begins, if that is stated.
        release: Option<Release>,
    },
    /// The functional becomes the other for special values.
    Degeneration {
        /// What is special.
        name: String,
        /// The functional itself, on the symbols of both, with special sizes where there are some.
        own: Box<Functional>,
        /// The other.
        other: Functional,
        /// Values put in.
        values: Vec<Special>,
    },
    /// The other is not there.
    Without(Missing),
}

/// A functional that is not defined for the values that are stated here, or that assumes what contradicts this file.
#[derive(Debug)]
pub struct Missing {
    /// The claim that the relation to it is about.
    pub claim: &'static str,
    /// The name of the relation where it has one.
    pub name: Option<String>,
    /// Its file.
    pub other: String,
    /// What is in the way, and where.
    pub why: String,
}

/// The density in which an imposed equation is released, with the multiplier.
#[derive(Clone, Debug)]
pub struct Release {
    /// The density of the interior; the functional's own where none is stated.
    pub density: Option<Expr>,
    /// The density as written.
    pub tree: Option<Node>,
    /// The multiplier as written.
    pub written: String,
    /// All its components.
    pub multiplier: Vec<Expr>,
}

/// A special value.
#[derive(Clone, Debug)]
pub struct Special {
    /// As written.
    pub written: String,
    /// What is replaced.
    pub what: SpecialKind,
}

/// What a special value replaces.
#[derive(Clone, Debug)]
pub enum SpecialKind {
    /// A size, which is put in where the functional is read.
    Size,
    /// Symbols by expressions.
    Symbols(Vec<(Expr, Expr)>),
    /// A constitutive function by an expression in its place-holders.
    Function {
        /// Which.
        function: usize,
        /// Its value in the place-holders.
        value: Expr,
    },
}

/// What another functional of the same family is about, as its file states it.
#[derive(Clone, Debug, Default)]
pub struct Relative {
    /// Its name.
    pub name: String,
    /// Its level.
    pub level: Option<String>,
    /// Its density.
    pub density: String,
    /// Its fields, those of the boundary too.
    pub fields: Vec<String>,
    /// Labels of what it imposes.
    pub imposed: Vec<String>,
    /// Labels of what it yields.
    pub yields: Vec<String>,
    /// The equations that it states: label, and as it is written with the piece on which it holds.
    pub equations: Vec<(String, String)>,
}

/// Fields that are stated to make the functional stationary.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// Names of its own constants.
    pub parameters: Vec<String>,
    /// Fields, data, parameters and constitutive functions with their values.
    pub values: Vec<Special>,
    /// The box.
    pub intervals: Vec<Interval>,
    /// Where the pieces of the boundary lie on it: each with every face that it is.
    pub pieces: Vec<(String, Side)>,
    /// Whether that is stated for the solution itself.
    pub has_pieces: bool,
    /// The value of the functional, as written and as an expression.
    pub value: Option<(String, Expr)>,
}

/// What `[ritz]` asks for.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Degrees by each variable, ascending.
    pub degrees: Vec<u32>,
    /// Values of parameters and data.
    pub values: Vec<(Expr, Expr)>,
    /// Points at which a field is compared.
    pub points: Vec<Point>,
}

/// A value that a field has at a point.
#[derive(Clone, Debug)]
pub struct Point {
    /// As written: `w at x = 1/2, y = 1/2`.
    pub written: String,
    /// The component.
    pub component: usize,
    /// One rational number for each independent variable.
    pub at: Vec<Rational>,
    /// The value of the closed solution.
    pub value: Rational,
    /// Whether it is exact, and not a decimal fraction of a series.
    pub is_exact: bool,
}

/// What a model file of a functional states.
#[derive(Debug)]
pub struct Problem {
    /// The functional.
    pub functional: Functional,
    /// Its relations to others.
    pub relations: Vec<Relation>,
    /// Solutions that are stated.
    pub solutions: Vec<Solution>,
    /// What is asked of Ritz's method.
    pub ritz: Option<Asked>,
    /// The family that the functional belongs to.
    pub family: Vec<Relative>,
    /// The texts.
    pub text: ModelText,
    /// Verdicts that the file expects: claim with subject, and the words that are accepted.
    pub expected: Vec<(String, Vec<String>)>,
    /// The same with the values that are stated for parameters, where there are some: claims are decided of it, as what is true of general
    /// ones may be false of these.
    pub valued: Option<Box<Problem>>,
}

impl Problem {
    /// Whether values are stated for parameters.
    pub fn has_values(&self) -> bool {
        self.functional.parameters.iter().any(|p| p.value.is_some())
    }

    /// What claims are decided of.
    pub fn of_claims(&self) -> &Problem {
        self.valued.as_deref().unwrap_or(self)
    }
}
