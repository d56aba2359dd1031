//! `functional.multipliers`: the level above follows by Lagrange multipliers that become fields, and by the semi-inverse method.

use super::descent::descended;
use super::modulo::{self, equations, labels, vanishing, STATED};
use super::{Claim, Context, Finding, Formula};
use crate::elimination::{Group, Solved};
use crate::functional::{Equation, Field, Functional, Relation, Release};
use crate::notation::{parse_sides, Kind, Node};
use crate::read::on_side;
use crate::variation::{euler_expression, euler_with, variation, Held, Variation};
use chetaev_symbolic::syntax::Span;
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
        "Courant's method: what is imposed, X = Φ, is released. Where X is a field of the level above, it gets a place of its own in the \
         density (`released` in [descent]); else the density stays as it is. The term λ (X − Φ) is added, in the interior or on the piece of \
         the boundary where the equation is imposed. The Euler equation of X, or the natural condition there, determines the multiplier. Put back, \
         it gives the density of the level above. First the level above with the equations imposed must be this functional (`functional.descent`). Three steps are proved then: the released density is that of this functional where X = Φ; the \
         stated multiplier, held fixed, makes the variation vanish modulo the equations that are named; the released density and the \
         multiplier's term make the density of the level above. The semi-inverse method (He 1997) builds the same density field by field: \
         to the terms of the fields before an unknown function F of the others is added, and the Euler equation of the next field \
         shows what F contains of it. Each step is proved: what is left has none of the field, and the Euler equation of the field follows from \
         the equations named; an Euler equation that the level above does not state is said to be none of them."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match released(cx) {
            Some(_) => vec![cx.own()],
            None => Vec::new(),
        }
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        let Some((functional, above, imposed, release)) = released(cx) else {
            return Verdict::undecided("nothing is released").into();
        };
        let own = above.equations.iter().find(|e| imposed.contains(&e.label));
        let Some(equation) = own else {
            return Verdict::undecided("the equation that is imposed is not stated").into();
        };
        let again = descended(functional, above, imposed).verdict;
        if !matches!(again, Verdict::Proved(_)) {
            let what = format!(
                "imposing {} on {} was not shown to give this functional",
                labels(imposed),
                above.name
            );
            return again.prefixed(&what).into();
        }
        let way = Way {
            functional,
            above,
            equation,
            release,
        };
        let mut formulas = Vec::new();
        let verdict = match way.proved(&mut formulas) {
            Ok(detail) => Verdict::Proved(Proof::exact("all fields", detail)),
            Err(verdict) => *verdict,
        };
        Finding { verdict, formulas }
    }
}

/// The functional, the one above, what is imposed on that, and how it is released.
type Released<'p> = (&'p Functional, &'p Functional, &'p [String], &'p Release);

fn released<'p>(cx: &'p Context<'_>) -> Option<Released<'p>> {
    cx.problem
        .relations
        .iter()
        .find_map(|relation| match relation {
            Relation::Descent {
                own,
                other,
                imposed,
                release: Some(release),
            } => Some((&**own, other, imposed.as_slice(), release)),
            _ => None,
        })
}

/// The way from a functional to the level above.
struct Way<'p> {
    functional: &'p Functional,
    above: &'p Functional,
    equation: &'p Equation,
    release: &'p Release,
}

type Step<T> = Result<T, Box<Verdict>>;

impl Way<'_> {
    /// All steps; the formulas are printed, the sentence says what they show.
    fn proved(&self, formulas: &mut Vec<Formula>) -> Step<String> {
        let (label, written) = (&self.equation.label, &self.release.written);
        let above = &self.above.name;
        let determined = match &self.equation.on {
            None => self.inside(formulas)?,
            Some(piece) => self.on(piece, formulas)?,
        };
        let built = self.semi_inverse(formulas)?;
        Ok(format!(
            "({label}) is released with the multiplier {written}; {determined}, and with it the density is that of {above}; \
             the semi-inverse method builds it from {built}"
        ))
    }

    /// The term of the multiplier.
    fn term(&self) -> Step<Expr> {
        let g = &self.above.space.graph;
        let (residuals, multiplier) = (&self.equation.residuals, &self.release.multiplier);
        if residuals.len() != multiplier.len() {
            return Err(Box::new(Verdict::undecided(
                "the multiplier has another number of components than the equation",
            )));
        }
        let own = residuals.iter().zip(multiplier);
        let terms: Vec<Expr> = own.map(|(&r, &m)| g.mul(&[r, m])).collect();
        Ok(g.add(&terms))
    }

    /// The term of the multiplier, shown by the equation that it multiplies.
    fn paired(&self, caption: String, term: Expr) -> Formula {
        let scope = &self.above.scope;
        let shown = Formula::new(caption, term);
        let sides = parse_sides(&self.equation.written, scope, &mut Vec::new());
        let Some((left, right)) = sides else {
            return shown;
        };
        let span = left.span;
        let mut parts = vec![(false, left)];
        parts.extend(right.map(|right| (true, right)));
        let kind = Kind::Sum(parts);
        shown.written(&Node { kind, span }, scope)
    }

    /// The fields of the level above that this one does not have.
    fn dropped(&self) -> Vec<&Field> {
        let own = |name: &String| self.functional.fields.iter().any(|own| own.name == *name);
        let interior = self.above.interior();
        interior.filter(|field| !own(&field.name)).collect()
    }

    fn inside(&self, formulas: &mut Vec<Formula>) -> Step<String> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let density = self.release.density.unwrap_or(self.functional.density);
        let term = self.term()?;
        let caption = format!("1. ({}) is released", self.equation.label);
        let released = Formula::new(caption, density);
        formulas.push(match &self.release.tree {
            Some(tree) => released.written(tree, &self.above.scope),
            None => released.written(&self.functional.tree, &self.functional.scope),
        });
        let caption = format!("2. the multiplier {} times", self.release.written);
        formulas.push(self.paired(caption, term));
        let names: Vec<String> = self.dropped().iter().map(|f| f.name.clone()).collect();
        let group = Group {
            label: self.equation.label.clone(),
            equations: self.equation.residuals.clone(),
        };
        let solved = Solved::new(space).preferring(&names).with(&[group]);
        self.vanishes(
            solved.normal(g.sub(density, self.functional.density)),
            "the released density is not that of this functional where the equation holds",
        )?;
        self.vanishes(
            g.sub(g.add(&[density, term]), self.above.density),
            "with the multiplier's term the released density is not that of the level above",
        )?;
        let (fields, needed) = self.determined(density)?;
        Ok(format!(
            "the Euler equation of {} determines it{}",
            fields.join(" and "),
            clause(&needed)
        ))
    }

    /// Courant's rule: the variation of the new fields in `released + λ (X − Φ)`, with λ held, gives the multiplier; where nothing was
    /// dropped, that of the fields in the equation. The fewest equations of the level above that are needed are named.
    fn determined(&self, density: Expr) -> Step<(Vec<String>, modulo::Needed)> {
        let space = &*self.above.space;
        let jets = space.jets_in(&self.equation.residuals);
        let occurs = |field: &&Field| {
            let mut own = jets.iter();
            own.any(|jet| field.components.contains(&jet.component))
        };
        let dropped = self.dropped();
        let fields: Vec<&Field> = if dropped.is_empty() {
            self.above.interior().filter(occurs).collect()
        } else {
            dropped
        };
        let held = Held {
            label: &self.equation.label,
            residuals: &self.equation.residuals,
            multiplier: &self.release.multiplier,
        };
        let components = fields.iter().flat_map(|field| &field.components);
        let es: Vec<Expr> = components
            .map(|&component| euler_with(space, density, held, component))
            .collect();
        let (_, needed) = vanishing(self.above, &es, &equations(self.above, None, STATED))?;
        let names = fields.iter().map(|field| field.name.clone()).collect();
        Ok((names, needed))
    }

    /// The equation is imposed on a piece of the boundary: the multiplier is a field of the level above.
    fn on(&self, name: &str, formulas: &mut Vec<Formula>) -> Step<String> {
        let g = &self.functional.space.graph;
        let (Some(own), Some(above)) = (self.functional.piece(name), self.above.piece(name)) else {
            let said = format!("one of the functionals has no piece {name}");
            return Err(Box::new(Verdict::undecided(said)));
        };
        let term = on_side(&self.above.scope, &above.side, self.term()?);
        let caption = format!("1. ({}) is released on {name}", self.equation.label);
        let none = Node::number(0, Span::new(0, 0));
        let tree = own.tree.as_ref().unwrap_or(&none);
        formulas.push(Formula::new(caption, own.density).written(tree, &self.functional.scope));
        let caption = format!("2. on {name} the multiplier {} times", self.release.written);
        formulas.push(self.paired(caption, term));
        self.vanishes(
            g.sub(g.add(&[own.density, term]), above.density),
            &format!(
                "with the multiplier's term the density on {name} is not that of the level above"
            ),
        )?;
        let varied = self.varied()?;
        let here = varied.pieces.iter().filter(|piece| piece.piece == name);
        let conditions: Vec<_> = here
            .flat_map(|piece| &piece.conditions)
            .filter(|own| {
                let mut fields = self.above.interior();
                fields.any(|field| field.components.contains(&own.component))
            })
            .collect();
        let es: Vec<Expr> = conditions.iter().map(|own| own.value).collect();
        let (_, needed) = vanishing(self.above, &es, &equations(self.above, Some(name), STATED))?;
        let mut fields: Vec<String> = conditions
            .iter()
            .map(|own| self.above.space.component_at(own.component).tensor)
            .collect();
        fields.dedup();
        Ok(format!(
            "the natural condition of {} on {name} determines it{}",
            fields.join(" and "),
            clause(&needed)
        ))
    }

    /// The semi-inverse method: the terms of the density field by field, those with derivatives first, and for each field the equations from
    /// which its Euler equation follows.
    fn semi_inverse(&self, formulas: &mut Vec<Formula>) -> Step<String> {
        let above = self.above;
        let space = &*above.space;
        let g = &space.graph;
        let jets = space.jets_in(&[above.density]);
        let order = |field: &&Field| {
            let own = jets.iter();
            let own = own.filter(|jet| field.components.contains(&jet.component));
            own.map(|jet| jet.by.len()).max()
        };
        let mut fields: Vec<&Field> = above.interior().filter(|f| order(f).is_some()).collect();
        fields.sort_by_key(|field| std::cmp::Reverse(order(field)));
        let mut left = terms(above);
        let varied = self.varied()?;
        let mut said = Vec::new();
        for field in fields {
            let contains = |own: &Term| {
                let jets = space.jets_in(&[own.value]);
                let mut own = jets.iter();
                own.any(|jet| field.components.contains(&jet.component))
            };
            let (own, rest): (Vec<Term>, Vec<Term>) = left.into_iter().partition(contains);
            left = rest;
            let (values, trees): (Vec<Expr>, Vec<(bool, Node)>) =
                own.into_iter().map(|own| (own.value, own.part)).unzip();
            let rest = g.add(&left.iter().map(|own| own.value).collect::<Vec<_>>());
            for &component in &field.components {
                let e = euler_expression(space, rest, component);
                self.vanishes(e, &format!("what is left contains {}", field.name))?;
            }
            let of_field = varied.euler.iter();
            let of_field = of_field.filter(|(c, _)| field.components.contains(c));
            let euler: Vec<Expr> = of_field.map(|(_, value)| *value).collect();
            let found = vanishing(above, &euler, &equations(above, None, STATED));
            let needed = match found {
                Ok((_, needed)) if needed.is_empty() => Needed::Nothing,
                Ok((_, needed)) => Needed::Stated(needed.to_string()),
                // What is stated decides nothing here: the equation holds where the functional is stationary.
                Err(verdict) if matches!(*verdict, Verdict::Refuted(_)) => Needed::Own,
                Err(verdict) => {
                    let what = format!("whether the Euler equation of {} follows", field.name);
                    return Err(Box::new(verdict.prefixed(&what)));
                }
            };
            let step = formulas.len() + 1;
            let from = match &needed {
                Needed::Nothing => "vanishes identically".to_owned(),
                Needed::Stated(labels) => format!("follows from {labels}"),
                Needed::Own => "follows from none of the equations stated there".to_owned(),
            };
            let caption = format!(
                "{step}. what {} adds for {}, whose Euler equation {from}",
                above.name, field.name
            );
            let kind = Kind::Sum(trees);
            let span = above.tree.span;
            let added = Formula::new(caption, g.add(&values));
            formulas.push(added.written(&Node { kind, span }, &above.scope));
            said.push(match &needed {
                Needed::Nothing => field.name.clone(),
                Needed::Stated(labels) => format!("{} with {labels}", field.name),
                Needed::Own => format!(
                    "{} with its Euler equation, which {} does not state",
                    field.name, above.name
                ),
            });
        }
        Ok(said.join(", "))
    }

    /// The first variation of the level above.
    fn varied(&self) -> Step<Variation> {
        variation(self.above).map_err(|e| Box::new(Verdict::undecided(e.to_string())))
    }

    fn vanishes(&self, e: Expr, what: &str) -> Step<()> {
        match self.above.space.vanishing(&[e], true) {
            Verdict::Proved(_) => Ok(()),
            other => Err(Box::new(other.prefixed(what))),
        }
    }
}

/// `, modulo (3)`.
fn clause(needed: &modulo::Needed) -> String {
    if needed.is_empty() {
        String::new()
    } else {
        format!(", modulo {needed}")
    }
}

/// From what the Euler equation of a field follows.
enum Needed {
    Nothing,
    /// The labels of equations.
    Stated(String),
    /// From no equation that is stated.
    Own,
}

/// A term of a density with its sign.
struct Term {
    part: (bool, Node),
    value: Expr,
}

/// The terms of a density.
fn terms(functional: &Functional) -> Vec<Term> {
    let g = &functional.space.graph;
    let Kind::Sum(parts) = &functional.tree.kind else {
        return vec![Term {
            part: (false, functional.tree.clone()),
            value: functional.density,
        }];
    };
    let term = |part: &(bool, Node)| {
        let value = functional.scope.value(&part.1, &Default::default());
        Term {
            part: part.clone(),
            value: if part.0 { g.neg(value) } else { value },
        }
    };
    parts.iter().map(term).collect()
}
