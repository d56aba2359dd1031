//! `functional.descent`: a level follows from the one above by imposing one more group of equations.

use super::degeneration::Comparison;
use super::modulo::{conditions, labels};
use super::{Claim, Context, Finding};
use crate::elimination::{Group, Solved};
use crate::functional::{Functional, Relation, Special, SpecialKind};
use chetaev_symbolic::{Expr, Verdict};

/// `functional.descent#NAME`.
pub(super) struct Descent;

impl Claim for Descent {
    fn id(&self) -> &'static str {
        "functional.descent"
    }

    fn title(&self) -> &'static str {
        "The functional follows from the one a level above by imposing one more group of equations"
    }

    fn explanation(&self) -> &'static str {
        "The equations that [descent] names are imposed on the functional of the level above: they are solved for one of its fields, \
         whose place the solution takes in all densities. What comes out must be the functional of this model, for all fields that it \
         admits, and admit the same: an equation that says something of the fields that are left is imposed on them too. On the boundary the densities may differ by a product of what two of its equations say is zero, since such a term changes \
         neither the value of the functional nor its first variation where they hold: the verdict names them."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let is = |r: &Relation| matches!(r, Relation::Descent { .. });
        let has_none = cx.missing(self.id()).next().is_some();
        if has_none || cx.problem.relations.iter().any(is) {
            vec![cx.own()]
        } else {
            Vec::new()
        }
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        if let Some(verdict) = cx.not_defined(self.id(), None) {
            return verdict.into();
        }
        let found = cx.problem.relations.iter().find_map(|r| match r {
            Relation::Descent {
                own,
                other,
                imposed,
                ..
            } => Some((own, other, imposed)),
            _ => None,
        });
        match found {
            Some((own, above, imposed)) => descended(own, above, imposed),
            None => Verdict::undecided("no level above is stated").into(),
        }
    }
}

/// Whether the level above with these of its equations imposed is the functional.
pub(super) fn descended(
    functional: &Functional,
    above: &Functional,
    imposed: &[String],
) -> Finding {
    let space = &*functional.space;
    let group = |label: &String| {
        let own = above.equations.iter().find(|e| e.label == *label)?;
        Some((
            own.on.clone(),
            Group {
                label: label.clone(),
                equations: own.residuals.clone(),
            },
        ))
    };
    let groups: Vec<(Option<String>, Group)> = imposed.iter().filter_map(group).collect();
    let inside: Vec<Group> = groups
        .iter()
        .filter(|(on, _)| on.is_none())
        .map(|(_, g)| g.clone())
        .collect();
    // What is eliminated is the field that the lower functional does not have.
    let fields: Vec<String> = above
        .fields
        .iter()
        .map(|field| field.name.clone())
        .filter(|name| functional.fields.iter().all(|own| own.name != *name))
        .collect();
    let solved = Solved::new(space).preferring(&fields).with(&inside);
    if !solved.left.is_empty() {
        return Verdict::undecided(
            "the equations that are imposed could not be solved for a field",
        )
        .into();
    }
    let stands = eliminated(above, &fields, &solved);
    // What holds on one piece says nothing of the others.
    let on_piece = |piece: &str| {
        let here = groups
            .iter()
            .filter(|(on, _)| on.as_deref().is_none_or(|on| on == piece));
        let here: Vec<Group> = here.map(|(_, group)| group.clone()).collect();
        Solved::new(space).preferring(&fields).with(&here)
    };
    let how = match imposed {
        [] => format!("{} as it stands:", above.name),
        imposed => {
            let conditions = conditions(&solved).join(" and ");
            let where_solved = match conditions.as_str() {
                "" => String::new(),
                some => format!(" where {some}"),
            };
            let labels = labels(imposed);
            format!("imposing {labels} on {}{where_solved},", above.name)
        }
    };
    let comparison = Comparison {
        functional: above,
        other: functional,
        how: &how,
        values: &[],
        besides: imposed,
        stands: &[stands],
        is_descent: true,
    };
    comparison.decided(&|on: Option<&str>, e: Expr| match on {
        None => solved.normal(e),
        Some(piece) => on_piece(piece).normal(e),
    })
}

/// What stands for the components of fields where equations are solved for them.
fn eliminated(above: &Functional, fields: &[String], solved: &Solved<'_>) -> Special {
    let space = &*above.space;
    let of_fields = above.fields.iter().filter(|own| fields.contains(&own.name));
    let components = of_fields.flat_map(|own| own.components.iter());
    let pairs = components.filter_map(|&component| {
        let own = space.jet(component, &[]);
        let value = solved.normal(own);
        (value != own).then_some((own, value))
    });
    Special {
        written: String::new(),
        what: SpecialKind::Symbols(pairs.collect()),
    }
}
