//! What two functionals admit to variation: with other variations they are two, whatever their densities.

use super::given::{given_by, is_given, is_regular, Given};
use super::special_values::{instance, put_in};
use crate::elimination::{Group, Solved};
use crate::functional::{Equation, Field, Functional, Piece, Role, Side, Special, SpecialKind};
use crate::space::Jet;
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::{Expr, Verdict};

/// A functional with special values put in, and with further equations imposed.
pub(super) struct Variations<'f> {
    /// The functional.
    pub functional: &'f Functional,
    /// The special values.
    pub values: &'f [Special],
    /// Labels of equations that are imposed besides.
    pub besides: &'f [String],
}

impl Variations<'_> {
    /// Why it has other variations than another functional; nothing where it has the same.
    pub(super) fn differs_from(&self, other: &Functional) -> Option<Verdict> {
        self.data(other)
            .or_else(|| self.equations(other))
            .or_else(|| self.pieces(other))
    }

    /// What is a field of one functional, and data of the other.
    fn data(&self, other: &Functional) -> Option<Verdict> {
        let own = self.functional;
        let both = |fields: &[Field], data: &[Field], is_kept: bool| {
            let is_data = |field: &&Field| data.iter().any(|own| own.name == field.name);
            let is_left = |field: &&Field| !is_kept || !self.is_put_in(field);
            let found = fields.iter().filter(is_left).find(is_data);
            found.map(|field| field.name.clone())
        };
        let (one, two) = self.names(other);
        let here = both(&own.fields, &other.data, true)
            .map(|name| format!("{name} is varied in {one}, and given in {two}"));
        let there = || {
            both(&other.fields, &own.data, false)
                .map(|name| format!("{name} is given in {one}, and varied in {two}"))
        };
        here.or_else(there)
            .map(|said| refuted("what is varied".into(), &said))
    }

    /// What both are called.
    fn names(&self, other: &Functional) -> (String, String) {
        let (own, name) = (&self.functional.name, &other.name);
        if own == name {
            return (own.clone(), format!("the other {name}"));
        }
        (own.clone(), name.clone())
    }

    /// Whether something is put in for all of a field.
    fn is_put_in(&self, field: &Field) -> bool {
        let is_put_in = |&component: &usize| self.value(component).is_some();
        field.components.iter().all(is_put_in)
    }

    /// What is put in for a component.
    fn value(&self, component: usize) -> Option<Expr> {
        let own = self.functional.space.jet(component, &[]);
        let mut pairs = self.values.iter().flat_map(|special| match &special.what {
            SpecialKind::Symbols(pairs) => pairs.as_slice(),
            SpecialKind::Size | SpecialKind::Function { .. } => &[],
        });
        pairs
            .find(|(left, _)| *left == own)
            .map(|(_, right)| *right)
    }

    /// What is imposed on one functional, and does not follow from what is imposed on the other.
    fn equations(&self, other: &Functional) -> Option<Verdict> {
        let own = self.functional;
        let (name, other_name) = self.names(other);
        let here: Vec<(&Equation, Vec<Expr>)> = self.imposed();
        let instance = |e: &Expr| instance((own, self.values), other, *e);
        let there: Vec<(&Equation, Vec<Expr>)> = other
            .with_role(Role::Imposed)
            .map(|equation| (equation, equation.residuals.iter().map(instance).collect()))
            .collect();
        let mut common = there
            .iter()
            .filter(|(_, es)| !self.is_beyond(es, other, own));
        let beyond = common.find_map(|one| {
            let verdict = self.follows(one, &here, own)?;
            Some((one.0, verdict, (&other_name, &name)))
        });
        let beyond = beyond.or_else(|| {
            let mut common = here
                .iter()
                .filter(|(_, es)| !self.is_beyond(es, own, other));
            common.find_map(|one| {
                let verdict = self.follows(one, &there, other)?;
                Some((one.0, verdict, (&name, &other_name)))
            })
        });
        let (equation, verdict, (one, without)) = beyond?;
        let label = &equation.label;
        Some(if matches!(verdict, Verdict::Refuted(_)) {
            let said = format!("({label}) is imposed in {one}, and does not follow from what is imposed in {without}");
            refuted(format!("({label})"), &said)
        } else {
            Verdict::undecided(format!("whether ({label}), which is imposed in {one}, follows from what is imposed in {without} was not decided"))
        })
    }

    /// The equations imposed here, with the special values.
    fn imposed(&self) -> Vec<(&Equation, Vec<Expr>)> {
        let own = self.functional;
        let is_imposed = |equation: &&Equation| {
            equation.role == Role::Imposed || self.besides.contains(&equation.label)
        };
        let put = |e: &Expr| put_in(own, self.values, *e);
        let all = own.equations.iter().filter(is_imposed);
        all.map(|equation| (equation, equation.residuals.iter().map(put).collect()))
            .collect()
    }

    /// Whether equations are about fields that one functional has and the other does not: they determine these.
    fn is_beyond(&self, es: &[Expr], one: &Functional, other: &Functional) -> bool {
        let jets = self.functional.space.jets_in(es);
        one.fields.iter().any(|field| {
            let has = |own: &Field| own.name == field.name;
            let is_there = other.fields.iter().chain(&other.data).any(has);
            !is_there
                && jets
                    .iter()
                    .any(|jet| field.components.contains(&jet.component))
        })
    }

    /// The verdict on an equation where others hold; nothing where it follows, also from what is given on the piece.
    fn follows(
        &self,
        (equation, residuals): &(&Equation, Vec<Expr>),
        others: &[(&Equation, Vec<Expr>)],
        of: &Functional,
    ) -> Option<Verdict> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let same = others.iter().find(|(own, _)| own.label == equation.label);
        if same.is_some_and(|(_, own)| {
            let differences = own.iter().zip(residuals).map(|(a, b)| g.sub(*a, *b));
            own.len() == residuals.len() && space.vanish(&differences.collect::<Vec<_>>())
        }) {
            return None;
        }
        let piece = equation.on.as_deref().and_then(|on| of.piece(on));
        if piece.is_some_and(|piece| residuals.iter().all(|&e| self.are_given(of, piece, e)))
            && !others.iter().any(|(own, _)| own.on == equation.on)
        {
            return Some(Verdict::undecided(
                "a value that is given without being stated was not compared",
            ));
        }
        let groups = others
            .iter()
            .filter(|(own, _)| own.on.is_none() || own.on == equation.on)
            .map(|(own, es)| Group {
                label: own.label.clone(),
                equations: es.clone(),
            });
        let solved = Solved::new(space).with(&groups.collect::<Vec<_>>());
        let mut verdicts = residuals.iter().map(|&e| solved.verdict(e));
        verdicts.find(|verdict| !matches!(verdict, Verdict::Proved(_)))
    }

    /// Whether all fields in an expression are given on a piece.
    fn are_given(&self, of: &Functional, piece: &Piece, e: Expr) -> bool {
        let space = &*self.functional.space;
        let given: Given = piece.fixed.iter().copied().collect();
        let mut jets = space.jets_in(&[e]).into_iter().peekable();
        jets.peek().is_some()
            && jets.all(|jet| !of.varies(jet.component) || is_given(space, piece, &given, &jet))
    }

    /// What is given on a piece by one functional only.
    fn pieces(&self, other: &Functional) -> Option<Verdict> {
        for own in &self.functional.pieces {
            let Some(piece) = other.piece(&own.name) else {
                let said = format!("`{}` has no piece {}", other.name, own.name);
                return Some(Verdict::undecided(said));
            };
            let Some(here) = self.given(own) else {
                return Some(Verdict::undecided(format!(
                    "what is given on {} was not compared: other fields stand for those that are given",
                    own.name
                )));
            };
            let there: Given = piece.fixed.iter().copied().collect();
            let is_of_other = |component: usize| {
                let mut fields = other.fields.iter();
                fields.any(|field| field.components.contains(&component))
            };
            let mut here_only = here
                .difference(&there)
                .filter(|own| is_of_other(own.0) && !self.is_imposed_on(piece, **own, other));
            let mut there_only = there
                .difference(&here)
                .filter(|given| !self.is_imposed_here(own, **given));
            let (one, two) = self.names(other);
            if let Some(given) = here_only.next() {
                return Some(self.given_otherwise(own, *given, (&one, &two)));
            }
            if let Some(given) = there_only.next() {
                return Some(self.given_otherwise(own, *given, (&two, &one)));
            }
        }
        None
    }

    fn given_otherwise(
        &self,
        piece: &Piece,
        (component, is_slope): (usize, bool),
        (one, two): (&str, &str),
    ) -> Verdict {
        let name = self.functional.space.component_at(component).name;
        let slope = if is_slope {
            "the normal derivative of "
        } else {
            ""
        };
        let quantity = format!("{slope}{name} on {}", piece.name);
        let said = format!("{quantity} is given in {one}, and not in {two}");
        refuted(quantity, &said)
    }

    /// What is given on a piece of this functional when the special values are put in; nothing where that is another condition.
    fn given(&self, piece: &Piece) -> Option<Given> {
        let (values, kept): (Given, Given) = piece
            .fixed
            .iter()
            .partition(|(component, _)| self.value(*component).is_some());
        let mut found = kept;
        let is_varied = |component: usize| self.functional.varies(component);
        for (component, is_slope) in values {
            let value = (self.value(component)?, is_slope);
            let space = &self.functional.space;
            found.extend(given_by(space, piece, value, &found, &is_varied)?);
        }
        Some(found)
    }

    /// Whether an equation that another functional imposes on a piece says what is given.
    fn is_imposed_on(&self, piece: &Piece, given: (usize, bool), other: &Functional) -> bool {
        let mut all = other.with_role(Role::Imposed);
        all.any(|own| {
            own.on.as_deref() == Some(&piece.name) && self.says(other, piece, &own.residuals, given)
        })
    }

    /// Whether an equation that is imposed here says what is given.
    fn is_imposed_here(&self, piece: &Piece, given: (usize, bool)) -> bool {
        let mut all = self.imposed().into_iter();
        all.any(|(own, es)| {
            own.on.as_deref() == Some(&piece.name) && self.says(self.functional, piece, &es, given)
        })
    }

    /// Whether a component, or its slope across the piece, minus data is among expressions.
    fn says(
        &self,
        of: &Functional,
        piece: &Piece,
        es: &[Expr],
        (component, is_slope): (usize, bool),
    ) -> bool {
        let space = &*self.functional.space;
        let by = match (is_slope, &piece.side) {
            (false, _) => Vec::new(),
            (true, Side::Flat { axis, .. }) => vec![*axis],
            (true, Side::Curved) => return false,
        };
        es.iter().any(|&e| {
            let jets = space.jets_in(&[e]);
            let jets: Vec<&Jet> = jets.iter().filter(|jet| of.varies(jet.component)).collect();
            match jets[..] {
                [jet] => {
                    let is_own = jet.component == component && jet.by == by;
                    is_own && is_regular(space, e, jet)
                }
                _ => false,
            }
        })
    }
}

fn refuted(quantity: String, said: &str) -> Verdict {
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        residual: ("1".into(), "1".into()),
        quantity,
        detail: format!("{said}, so that the variations are others"),
    })
}
