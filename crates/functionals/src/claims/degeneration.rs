//! `functional.degeneration`: special values turn the functional into another stated one.

use super::modulo::{equations, other_body, vanishing_difference, STATED};
use super::special_values::{instance, put_in, unfit};
use super::variations::Variations;
use super::{Claim, Context, Finding, Formula};
use crate::functional::{Functional, Relation, Role, Special};
use crate::variation::is_divergence;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};
use std::collections::BTreeSet;

/// `functional.degeneration#NAME`.
pub(super) struct Degeneration;

impl Claim for Degeneration {
    fn id(&self) -> &'static str {
        "functional.degeneration"
    }

    fn title(&self) -> &'static str {
        "For special values the functional becomes the stated one"
    }

    fn explanation(&self) -> &'static str {
        "The values that a section [degenerations.NAME] states are put in for parameters, sizes, fields and constitutive functions; the \
         densities of the interior and of every piece of the boundary must then be those of the functional that it names, for all fields \
         that both admit. Both must vary the same: what one imposes, or gives on the boundary, the other one does too, with the values put in. \
         Where the densities agree only because of what is imposed, the verdict names it. Field equations that follow from a functional are \
         not used: by these it would be equal to many others. Where the densities differ the claim is refuted, and the difference is shown."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let all = cx.problem.relations.iter().filter_map(|r| match r {
            Relation::Degeneration { name, .. } => Some(Some(name.clone())),
            _ => None,
        });
        let without = cx.missing(self.id()).map(|own| own.name.clone());
        all.chain(without).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(verdict) = cx.not_defined(self.id(), subject) {
            return verdict.into();
        }
        let found = cx.problem.relations.iter().find_map(|r| match r {
            Relation::Degeneration {
                name,
                own,
                other,
                values,
            } if Some(name.as_str()) == subject => Some((&**own, other, values)),
            _ => None,
        });
        match found {
            Some((functional, other, values)) => {
                if let Some(unfit) = unfit(functional, values, &functional.intervals) {
                    return unfit.into();
                }
                let told: Vec<&str> = values.iter().map(|v| v.written.as_str()).collect();
                let how = match told.as_slice() {
                    [] => "without special values".to_owned(),
                    told => format!("with {}", told.join(", ")),
                };
                let comparison = Comparison {
                    functional,
                    other,
                    how: &how,
                    values,
                    besides: &[],
                    stands: values,
                    is_descent: false,
                };
                comparison.decided(&|_, e| put_in(functional, values, e))
            }
            None => Verdict::undecided("there is no such degeneration").into(),
        }
    }
}

/// How the densities of two functionals are to agree.
pub(super) struct Comparison<'f> {
    /// The functional whose densities are changed.
    pub functional: &'f Functional,
    /// The one they are to be those of.
    pub other: &'f Functional,
    /// What was done, in words.
    pub how: &'f str,
    /// The special values that were put in.
    pub values: &'f [Special],
    /// Labels of equations that were imposed besides.
    pub besides: &'f [String],
    /// What stands for fields that are not there any more.
    pub stands: &'f [Special],
    /// Whether the other functional is one level below: what it imposes is then said in the fields of the first, and on the boundary a
    /// difference may be of second order in stated equations, so that neither the value of the functional where they hold nor its first
    /// variation there depends on it.
    pub is_descent: bool,
}

impl Comparison<'_> {
    /// Compares all densities, those of the first changed by `change`, which is told the piece. They have to agree for all fields that the other functional
    /// admits: where what it imposes holds. What it yields is no help: with that a functional would be equal to many.
    pub(super) fn decided(&self, change: &dyn Fn(Option<&str>, Expr) -> Expr) -> Finding {
        let (functional, other) = (self.functional, self.other);
        if let Some(verdict) = other_body(functional, other) {
            return verdict.into();
        }
        let space = &*functional.space;
        let g = &space.graph;
        let mut notes = Vec::new();
        let mut all = Verdict::Proved(Proof::exact("", ""));
        let own = Variations {
            functional,
            values: self.stands,
            besides: self.besides,
        };
        if let Some(verdict) = own.differs_from(other) {
            return verdict.into();
        }
        let mut places = vec![(None, functional.density, other.density)];
        for piece in &other.pieces {
            let Some(own) = functional.piece(&piece.name) else {
                let said = format!("`{}` has no piece {}", functional.name, piece.name);
                return Verdict::undecided(said).into();
            };
            places.push((Some(piece.name.as_str()), own.density, piece.density));
        }
        for (on, own, wanted) in places {
            let wanted = instance((functional, self.values), other, wanted);
            let difference = space.unified(g.sub(change(on, own), wanted));
            let place =
                on.map_or_else(|| "in the interior".to_owned(), |name| format!("on {name}"));
            match self.place(on, difference) {
                Ok((proof, note)) => {
                    all = all.and(Verdict::Proved(proof));
                    notes.extend(note.map(|note| format!("{place} {note}")));
                }
                Err(verdict) => {
                    let of_all = || {
                        space
                            .jets_in(&[difference])
                            .into_iter()
                            .map(|jet| jet.component)
                            .collect::<BTreeSet<_>>()
                    };
                    let verdict = match *verdict {
                        Verdict::Refuted(_) if on.is_none() && is_divergence(space, difference, of_all()) => {
                            Verdict::undecided("by a divergence, and what that leaves on the boundary was not compared")
                        }
                        other => other,
                    };
                    let what = match on {
                        None => "the densities of the interior".to_owned(),
                        Some(name) => format!("the densities on {name}"),
                    };
                    let verdict =
                        verdict.prefixed(&format!("{what} differ from those of {}", other.name));
                    let mut finding = Finding::from(verdict);
                    finding.formulas =
                        vec![Formula::new(format!("the difference {place}"), difference)];
                    return finding;
                }
            }
        }
        self.told(all, &notes).into()
    }

    /// A proof that a difference vanishes for all admitted fields, and what is to be said of it.
    fn place(
        &self,
        on: Option<&str>,
        difference: Expr,
    ) -> Result<(Proof, Option<String>), Box<Verdict>> {
        let mut imposed = equations(self.other, on, &[Role::Imposed]);
        if self.is_descent {
            // What the lower functional says of fields that it does not have any more.
            let labels: Vec<String> = imposed.iter().map(|own| own.label.clone()).collect();
            let above = equations(self.functional, on, STATED).into_iter();
            imposed.extend(above.filter(|own| labels.contains(&own.label)));
        } else {
            let labels: Vec<String> = imposed.iter().map(|own| own.label.clone()).collect();
            let own = equations(self.functional, on, &[Role::Imposed]).into_iter();
            let own = own.filter(|own| !labels.contains(&own.label));
            imposed.extend(own.map(|mut group| {
                let put = |e: &mut Expr| *e = put_in(self.functional, self.values, *e);
                group.equations.iter_mut().for_each(put);
                group
            }));
        }
        let stated = if self.is_descent && on.is_some() {
            equations(self.other, on, &[Role::Imposed, Role::Yielded])
        } else {
            Vec::new()
        };
        vanishing_difference(self.functional, difference, &imposed, &stated)
    }

    fn told(&self, all: Verdict, notes: &[String]) -> Verdict {
        let (how, other) = (self.how, &self.other.name);
        match all {
            Verdict::Proved(proof) if notes.is_empty() => Verdict::Proved(Proof {
                on: "all fields".into(),
                detail: format!("{how} the densities are those of {other}"),
                ..proof
            }),
            Verdict::Proved(proof) => {
                let notes = notes.join(", ");
                Verdict::Proved(Proof {
                    on: format!("all fields; {notes}"),
                    detail: format!("{how} the densities are those of {other}, {notes}"),
                    ..proof
                })
            }
            other => other,
        }
    }
}
