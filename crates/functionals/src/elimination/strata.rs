//! Where equations hold: in the body, on a face, or where faces meet.
//!
//! What holds on a face may be differentiated along it, and what follows from equations of two faces holds where these meet, and there alone:
//! it may be differentiated along the edge only. So each equation carries the faces on which it holds, and is solved with such others alone as
//! hold wherever it does.

use super::{Rule, Solved};
use crate::functional::Side;
use crate::space::{Component, Jet};
use chetaev_symbolic::Expr;

/// All of these faces at once, by their places among those of [`Solved`]; the body where there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Stratum(u32);

impl Stratum {
    fn of(face: usize) -> Stratum {
        Stratum(1 << face)
    }

    /// Where both are.
    pub(super) fn meeting(self, other: Stratum) -> Stratum {
        Stratum(self.0 | other.0)
    }

    /// Whether it lies in the other.
    pub(super) fn lies_in(self, other: Stratum) -> bool {
        self.0 & other.0 == other.0
    }

    fn has(self, face: usize) -> bool {
        self.lies_in(Stratum::of(face))
    }

    fn count(self) -> u32 {
        self.0.count_ones()
    }
}

/// What keeps a place from moving in all directions.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Face {
    /// An independent variable is constant.
    Flat {
        /// Which.
        axis: usize,
        /// Its value.
        at: Expr,
    },
    /// Any smooth piece.
    Curved,
    /// It does not move at all.
    Point,
}

impl Face {
    fn of(side: &Side) -> Face {
        match side {
            Side::Flat { axis, at, .. } => Face::Flat {
                axis: *axis,
                at: *at,
            },
            Side::Curved => Face::Curved,
        }
    }
}

impl Solved<'_> {
    /// Goes on to a face, where new equations hold; those that were not solved are looked at there.
    pub(super) fn enter(&mut self, side: &Side) {
        let face = Face::of(side);
        let known = match face {
            Face::Flat { .. } => self.faces.iter().position(|own| *own == face),
            Face::Curved | Face::Point => None,
        };
        let at = known.unwrap_or(self.faces.len());
        if known.is_none() {
            self.faces.push(face);
        }
        self.stratum = Stratum::of(at);
        self.move_open();
    }

    /// Looks at what is not solved where new equations hold.
    fn move_open(&mut self) {
        for at in 0..self.left.len() {
            let own = self.left[at].stratum;
            self.left[at].stratum = self.narrowed(own, own.meeting(self.stratum));
        }
    }

    /// Goes on to where all faces meet; where fewer than two are known, to a single place.
    pub(super) fn enter_meeting(&mut self) {
        if self.faces.len() < 2 {
            return self.enter_point();
        }
        self.stratum = self.everywhere();
        self.move_open();
    }

    /// Goes on to a single place.
    pub(super) fn enter_point(&mut self) {
        self.faces.push(Face::Point);
        self.stratum = self.everywhere();
        self.move_open();
    }

    /// Where all faces meet.
    pub(super) fn everywhere(&self) -> Stratum {
        let own = (0..self.faces.len()).map(Stratum::of);
        own.fold(Stratum::default(), Stratum::meeting)
    }

    /// A part of a stratum to which an equation is restricted. Where faces meet its derivatives along one of them are lost: what
    /// does not follow then may follow all the same.
    pub(super) fn narrowed(&mut self, from: Stratum, to: Stratum) -> Stratum {
        self.is_narrowed |= from != to && to.count() > 1;
        to
    }

    fn faces_of(&self, stratum: Stratum) -> impl Iterator<Item = &Face> {
        let all = self.faces.iter().enumerate();
        all.filter(move |(at, _)| stratum.has(*at))
            .map(|(_, face)| face)
    }

    /// Whether a stratum is part of a curved piece.
    pub(super) fn is_curved(&self, stratum: Stratum) -> bool {
        self.faces_of(stratum).any(|face| *face == Face::Curved)
    }

    /// Whether it is on the boundary, and not a single place of the body.
    pub(super) fn is_on_boundary(&self) -> bool {
        self.faces.iter().any(|face| *face != Face::Point)
    }

    /// The variables that are constant on a stratum, with their values.
    pub(super) fn constant_on(&self, stratum: Stratum) -> impl Iterator<Item = (usize, Expr)> + '_ {
        self.faces_of(stratum).filter_map(|face| match face {
            Face::Flat { axis, at } => Some((*axis, *at)),
            Face::Curved | Face::Point => None,
        })
    }

    /// Whether a rule may be differentiated so: along the faces on which it holds, and off a curved one as it is continued. Data and
    /// fields of the boundary live on their piece only, so that they are continued off it as the rule says; where another face
    /// meets it they have values on that one, too.
    pub(super) fn may_differentiate(&self, rule: &Rule, by: &[usize]) -> bool {
        if by.is_empty() || (self.is_one_face() && self.is_of_boundary(&rule.jet)) {
            return true;
        }
        let is_alone = rule.stratum.count() == 1;
        self.faces_of(rule.stratum).all(|face| match face {
            Face::Flat { axis, .. } => !by.contains(axis),
            Face::Curved => is_alone && rule.across.is_some(),
            Face::Point => false,
        })
    }

    fn is_one_face(&self) -> bool {
        matches!(&self.faces[..], [Face::Flat { .. } | Face::Curved])
    }

    fn is_of_boundary(&self, jet: &Jet) -> bool {
        self.space.component_at(jet.component).is_of_boundary
    }

    /// The component that the distance from a curved piece is multiplied with, for a jet that is known on it and on no other.
    pub(super) fn across(&self, jet: &Jet, stratum: Stratum) -> Option<usize> {
        let of = self.space.component_at(jet.component);
        let is_on_one = self.is_curved(stratum) && stratum.count() == 1;
        (is_on_one && !of.is_of_boundary).then(|| self.normal_derivative(jet, stratum, &of))
    }

    fn normal_derivative(&self, jet: &Jet, stratum: Stratum, of: &Component) -> usize {
        let g = &self.space.graph;
        let name = g.text(self.space.jet(jet.component, &jet.by));
        let by: String = name.chars().skip_while(|c| *c != ',').collect();
        // Each piece has a normal derivative of its own, as each continues what is known on it in its own way.
        let before = self.faces.iter().enumerate();
        let before = before.take_while(|(at, _)| !stratum.has(*at));
        let primes = "'".repeat(before.filter(|(_, own)| **own == Face::Curved).count());
        self.space.component(Component {
            name: format!("∂{name}/∂n{primes}"),
            tensor: format!("∂{}{by}/∂n{primes}", of.tensor),
            constant_along: Vec::new(),
            ..of.clone()
        })
    }
}
