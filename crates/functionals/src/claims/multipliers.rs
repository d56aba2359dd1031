//! `functional.multipliers`: a level follows from the one below by Lagrange multipliers that become fields.

use super::{Claim, Context, Finding, Formula};
use crate::elimination::{Group, Solved};
use crate::functional::{Functional, Relation, Release};
use crate::notation::Kind;
use crate::variation::euler_expression;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// `functional.multipliers#NAME`.
pub(super) struct Multipliers;

impl Claim for Multipliers {
    fn id(&self) -> &'static str {
        "functional.multipliers"
    }

    fn title(&self) -> &'static str {
        "The level above follows by Lagrange multipliers that become fields, and this one by imposing their equations again"
    }

    fn explanation(&self) -> &'static str {
        "Courant's method: what is imposed, X = Φ, is released; X becomes a field of its own in the density (`released` in \
         [descent]), and λ (X − Φ) is added. The Euler equation of X determines the multiplier. Put back, it gives the density of the level \
         above. Three steps are proved: the released density is that of this functional where X = Φ; the Euler equation of X gives the stated \
         multiplier, modulo the equations that are named; the released density and the multiplier's term make the density of the level above. \
         The terms of that density are printed field by field, as the semi-inverse method begins (He 1997); that its equations follow \
         is `functional.euler` of that level."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match released(cx) {
            Some(_) => vec![cx.own()],
            None => Vec::new(),
        }
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        match released(cx) {
            Some((above, imposed, release)) => steps(cx.functional(), above, imposed, release),
            None => Verdict::undecided("nothing is released").into(),
        }
    }
}

fn released<'p>(cx: &'p Context<'_>) -> Option<(&'p Functional, &'p [String], &'p Release)> {
    cx.problem
        .relations
        .iter()
        .find_map(|relation| match relation {
            Relation::Descent {
                other,
                imposed,
                release: Some(release),
            } => Some((other, imposed.as_slice(), release)),
            _ => None,
        })
}

fn steps(
    functional: &Functional,
    above: &Functional,
    imposed: &[String],
    release: &Release,
) -> Finding {
    let space = &*functional.space;
    let g = &space.graph;
    let equation = above
        .equations
        .iter()
        .find(|e| imposed.contains(&e.label) && e.on.is_none());
    let Some(equation) = equation else {
        return Verdict::undecided("the equation that is imposed is not stated in the interior")
            .into();
    };
    let group = Group {
        label: equation.label.clone(),
        equations: equation.residuals.clone(),
    };
    let fields: Vec<String> = above
        .fields
        .iter()
        .map(|field| field.name.clone())
        .filter(|name| functional.fields.iter().all(|own| own.name != *name))
        .collect();
    let solved = Solved::new(space).preferring(&fields).with(&[group]);
    let pairing = pairing(above, equation.residuals.as_slice(), &release.multiplier);
    let Some(term) = pairing.map(|terms| g.add(&terms)) else {
        return Verdict::undecided(
            "the multiplier has another number of components than the equation",
        )
        .into();
    };
    let mut formulas = vec![
        Formula {
            caption: format!("1. ({}) is released", equation.label),
            value: release.density,
        },
        Formula {
            caption: "2. the term of the multiplier".into(),
            value: term,
        },
    ];
    let checks = [
        (
            "the released density is not that of this functional where the equation holds",
            solved.normal(g.sub(release.density, functional.density)),
        ),
        (
            "with the multiplier's term the released density is not that of the level above",
            g.sub(g.add(&[release.density, term]), above.density),
        ),
    ];
    for (what, e) in checks {
        if let Some(verdict) = failed(space, e, what) {
            return Finding { verdict, formulas };
        }
    }
    let determined = determined(above, equation.residuals.as_slice(), release, &fields);
    let modulo = match determined {
        Ok(modulo) => modulo,
        Err(verdict) => {
            return Finding {
                verdict: *verdict,
                formulas,
            }
        }
    };
    for (caption, value) in by_field(above) {
        formulas.push(Formula { caption, value });
    }
    let named = if modulo.is_empty() {
        String::new()
    } else {
        format!(", modulo {}", super::modulo::labels(&modulo))
    };
    let detail = format!(
        "({}) is released with the multiplier {}; the Euler equation of {} determines it{named}, and with it the density is that of {}",
        equation.label, release.written, fields.join(", "), above.name
    );
    Finding {
        verdict: Verdict::Proved(Proof::exact("all fields", detail)),
        formulas,
    }
}

fn failed(space: &crate::space::Space, e: Expr, what: &str) -> Option<Verdict> {
    match space.vanishing(&[e], true) {
        Verdict::Proved(_) => None,
        other => Some(other.prefixed(what)),
    }
}

/// `λ_ij (X − Φ)_ij` with all components.
fn pairing(above: &Functional, residuals: &[Expr], multiplier: &[Expr]) -> Option<Vec<Expr>> {
    let g = &above.space.graph;
    (residuals.len() == multiplier.len()).then(|| {
        let own = residuals.iter().zip(multiplier);
        own.map(|(&r, &m)| g.mul(&[r, m])).collect()
    })
}

/// Courant's rule: the variation of the new field in `released + λ (X − Φ)` with λ as an unknown gives the multiplier. The fewest
/// equations of the level above that are needed are named.
fn determined(
    above: &Functional,
    residuals: &[Expr],
    release: &Release,
    fields: &[String],
) -> Result<Vec<String>, Box<Verdict>> {
    let space = &*above.space;
    let g = &space.graph;
    let mut es = Vec::new();
    for field in above
        .fields
        .iter()
        .filter(|field| fields.contains(&field.name))
    {
        for &component in &field.components {
            let mut terms = vec![euler_expression(space, release.density, component)];
            for (&r, &m) in residuals.iter().zip(&release.multiplier) {
                // λ is not varied: only the equation contains the field.
                let slope = euler_expression(space, r, component);
                terms.push(g.mul(&[m, slope]));
            }
            es.push(g.add(&terms));
        }
    }
    let available = super::modulo::equations(above, None);
    let (_, needed) = super::modulo::vanishing(above, &es, &available)?;
    Ok(needed)
}

/// The terms of the density field by field: those with derivatives first, then what contains the next field and none of the earlier ones.
fn by_field(above: &Functional) -> Vec<(String, Expr)> {
    let space = &*above.space;
    let g = &space.graph;
    let mut fields: Vec<_> = above.interior().collect();
    let order = |components: &[usize]| {
        let jets = space.jets_in(&[above.density]);
        let own = jets
            .iter()
            .filter(|jet| components.contains(&jet.component));
        own.map(|jet| jet.by.len()).max().unwrap_or(0)
    };
    fields.sort_by_key(|field| std::cmp::Reverse(order(&field.components)));
    let parts: Vec<Expr> = match &above.tree.kind {
        Kind::Sum(parts) => {
            let own = parts.iter().map(|(minus, part)| {
                let value = above.scope.value(part, &Default::default());
                if *minus {
                    g.neg(value)
                } else {
                    value
                }
            });
            own.collect()
        }
        _ => vec![above.density],
    };
    let mut found = Vec::new();
    let mut left = parts;
    for (k, field) in fields.iter().enumerate() {
        let contains = |e: &Expr| {
            let jets = space.jets_in(&[*e]);
            jets.iter()
                .any(|jet| field.components.contains(&jet.component))
        };
        let (own, rest): (Vec<Expr>, Vec<Expr>) = left.into_iter().partition(contains);
        let caption = format!(
            "{}. the terms of {} with {}, which its Euler equation asks for",
            k + 3,
            above.name,
            field.name
        );
        found.push((caption, g.add(&own)));
        left = rest;
    }
    found.retain(|(_, e)| !g.is_zero(*e));
    found
}
