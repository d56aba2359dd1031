//! `functional.degeneration`: special values turn the functional into another stated one.

use super::modulo::{equations, labels, vanishing};
use super::{Claim, Context, Finding};
use crate::functional::{Functional, Relation, Special, SpecialKind};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

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
        "The values that a section [degenerations.NAME] states are put in for parameters, fields and constitutive functions; the \
         densities of the interior and of every piece of the boundary must then be those of the functional that it names. Where a \
         boundary density agrees only because of field equations, the verdict names the fewest that are needed."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let all = cx.problem.relations.iter().filter_map(|r| match r {
            Relation::Degeneration { name, .. } => Some(Some(name.clone())),
            _ => None,
        });
        all.collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let found = cx.problem.relations.iter().find_map(|r| match r {
            Relation::Degeneration {
                name,
                other,
                values,
            } if Some(name.as_str()) == subject => Some((other, values)),
            _ => None,
        });
        match found {
            Some((other, values)) => {
                if let Some(stated) = other_value(cx.functional(), values) {
                    return Verdict::not_applicable("parameters", stated).into();
                }
                let told: Vec<&str> = values.iter().map(|v| v.written.as_str()).collect();
                let how = format!("with {}", told.join(", "));
                compared(cx.functional(), other, &how, &|e| {
                    put_in(cx.functional(), values, e)
                })
                .into()
            }
            None => Verdict::undecided("there is no such degeneration").into(),
        }
    }
}

/// The value that is stated for a parameter for which another one is to be put in.
pub(super) fn other_value(functional: &Functional, values: &[Special]) -> Option<String> {
    let g = &functional.space.graph;
    let stated = functional.values();
    let pairs = values.iter().flat_map(|special| match &special.what {
        SpecialKind::Symbols(pairs) => pairs.as_slice(),
        SpecialKind::Function { .. } => &[],
    });
    let mut other = pairs.filter_map(|(symbol, special)| {
        let (_, value) = stated.iter().find(|(own, _)| own == symbol)?;
        let differs = !g.is_zero(g.sub(*value, *special));
        differs.then(|| format!("{} = {} is stated", g.text(*symbol), g.text(*value)))
    });
    other.next()
}

/// An expression with special values.
pub(super) fn put_in(functional: &Functional, values: &[Special], e: Expr) -> Expr {
    let space = &*functional.space;
    values.iter().fold(e, |e, special| match &special.what {
        SpecialKind::Symbols(pairs) => space.replace(e, &|symbol| {
            let own = space.graph.symbol_expr(symbol);
            pairs.iter().find(|(l, _)| *l == own).map(|(_, r)| *r)
        }),
        SpecialKind::Function { function, value } => {
            let slots = space.slots(*function);
            space.replace_function(e, *function, &|arguments| {
                space.replace(*value, &|symbol| {
                    let own = space.graph.symbol_expr(symbol);
                    let at = slots.iter().position(|&s| s == own)?;
                    arguments.get(at).copied()
                })
            })
        }
    })
}

/// Compares all densities of two functionals, those of the first changed by `change`.
pub(super) fn compared(
    functional: &Functional,
    other: &Functional,
    how: &str,
    change: &dyn Fn(Expr) -> Expr,
) -> Verdict {
    let g = &functional.space.graph;
    let mut notes = Vec::new();
    let inside = g.sub(change(functional.density), other.density);
    let mut all = match vanishing(functional, &[inside], &equations(other, None)) {
        Ok((proof, needed)) => {
            if !needed.is_empty() {
                notes.push(format!("in the interior modulo {}", labels(&needed)));
            }
            Verdict::Proved(proof)
        }
        Err(verdict) => return differs(other, "the densities of the interior", *verdict),
    };
    for piece in &other.pieces {
        let Some(own) = functional.piece(&piece.name) else {
            return Verdict::undecided(format!(
                "`{}` has no piece {}",
                functional.name, piece.name
            ));
        };
        let difference = g.sub(change(own.density), piece.density);
        let available = equations(other, Some(&piece.name));
        match vanishing(functional, &[difference], &available) {
            Ok((proof, needed)) => {
                if !needed.is_empty() {
                    notes.push(format!("on {} modulo {}", piece.name, labels(&needed)));
                }
                all = all.and(Verdict::Proved(proof));
            }
            Err(verdict) => {
                return differs(other, &format!("the densities on {}", piece.name), *verdict)
            }
        }
    }
    match all {
        Verdict::Proved(proof) => Verdict::Proved(Proof {
            on: if notes.is_empty() {
                "all fields".into()
            } else {
                format!("all fields; {}", notes.join(", "))
            },
            detail: if notes.is_empty() {
                format!("{how} the densities are those of {}", other.name)
            } else {
                format!(
                    "{how} the densities are those of {}, {}",
                    other.name,
                    notes.join(", ")
                )
            },
            ..proof
        }),
        other => other,
    }
}

fn differs(other: &Functional, what: &str, verdict: Verdict) -> Verdict {
    verdict.prefixed(&format!("{what} differ from those of {}", other.name))
}
