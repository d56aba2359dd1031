//! `model.same-motion#NAME`: another model, mapped to this one, has corresponding admissible states and the same accelerations.
//!
//! With Q = F(q, t), the other's coordinates by ours, its velocities are D F and its accelerations along our motion D D F. Admissible
//! states correspond if the image of ours satisfies its constraints, if the sets have the same dimension, and if the map does not
//! lose any direction of ours.
#![allow(
    clippy::result_large_err,
    reason = "a verdict is made once, and told at once"
)]

use super::formulation::{derive, REFERENCE};
use super::on_set::{constraint_set, hold, State};
use super::{Claim, Context, Finding, Group, Prepared};
use crate::constraint::ConstraintKind;
use crate::equations::Equations;
use crate::system::{System, Twin};
use crate::terms::MotionTerms;
use crate::words::number;
use crate::Selection;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `model.same-motion#NAME`.
#[derive(Clone, Copy, Debug)]
pub struct SameMotion;

impl Claim for SameMotion {
    fn id(&self) -> &'static str {
        "model.same-motion"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "Another model has the same motion"
    }

    fn explanation(&self) -> &'static str {
        "The model that [twin.NAME] names, whose coordinates `map` gives by those of this one, is compared with it. Proved are: the \
         image of every admissible state satisfies the constraints of the other model, positions included; the admissible states \
         of both form sets of the same dimension, and the map loses no direction at almost every state, so that states correspond \
         one to one near each other; the accelerations of the other model there are those of this one, mapped. `refuted` comes with \
         a state at which one of these fails, with the numbers of both models."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.accelerations-unique".into()]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let twins = cx.system.twins.iter();
        twins.map(|twin| Some(twin.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let name = subject.unwrap_or_default();
        let Some(twin) = cx.system.twins.iter().find(|twin| twin.name == name) else {
            return Verdict::undecided(format!("there is no twin `{name}`")).into();
        };
        match same_motion(cx, twin) {
            Ok(verdict) | Err(verdict) => verdict.into(),
        }
    }
}

/// Conclusions that end the matter are errors.
fn same_motion(cx: &Context<'_>, twin: &Twin) -> Result<Verdict, Verdict> {
    let other = &*twin.system;
    if other.order() > 1 {
        return Err(Verdict::not_applicable(
            "model.constraints-first-order",
            "a constraint of the other model is of order two or more",
        ));
    }
    if !cx.system.masses.is_empty() {
        return Err(Verdict::undecided(
            "a mass has a law of its own; such models are not compared",
        ));
    }
    let prepared = Prepared::new(other)
        .map_err(|problem| Verdict::undecided(format!("the other model: {problem}")))?;
    let theirs = Context::new(
        other,
        &prepared.terms,
        &prepared.selection,
        cx.registry(),
        cx.prover.clone(),
    );
    let unique = &theirs.finding("model.accelerations-unique").verdict;
    if let Verdict::Refuted(found) = unique {
        let detail = format!("of the other model: {}", found.detail);
        return Err(Verdict::not_applicable(
            "model.accelerations-unique",
            detail,
        ));
    }
    let underived =
        |problem| Verdict::undecided(format!("the equations could not be derived: {problem}"));
    let own_motion = derive(cx, REFERENCE).map_err(underived)?;
    let their_motion = derive(&theirs, REFERENCE).map_err(underived)?;
    let image = Image::new(cx.system, twin, &own_motion);
    let admissible = image.admissible(cx);
    let matter = "the admissible states of this model are none of the other";
    let admissible = match admissible {
        Verdict::Refuted(found) => return Err(Verdict::Refuted(found).prefixed(matter)),
        other => other,
    };
    let (own, their) = (
        dimension(cx.system, cx.terms, cx.selection),
        dimension(other, &prepared.terms, &prepared.selection),
    );
    if own != their {
        return Err(Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "dimension of the admissible states of the other model minus that of this one".into(),
            residual: ((their as i64 - own as i64).to_string(), (their as i64 - own as i64).to_string()),
            detail: format!("states do not correspond: at a time the admissible states of this model form a set of dimension {own}, those of the other one of dimension {their}"),
        }));
    }
    let one_to_one = image.one_to_one(cx)?;
    let accelerations = image.same_accelerations(cx, &their_motion);
    Ok(match accelerations {
        Verdict::Refuted(found) => Verdict::Refuted(found),
        accelerations => {
            let verdict = admissible.and(one_to_one).and(accelerations);
            match verdict {
                Verdict::Proved(proof) => Verdict::Proved(proof).prefixed(&format!(
                    "admissible states of both models, of dimension {own}, correspond to each other, and the accelerations agree"
                )),
                other => other,
            }
        }
    })
}

/// The dimension of the admissible states (q, v) at a time: each holonomic constraint takes two.
fn dimension(system: &System, terms: &MotionTerms, selection: &Selection) -> usize {
    let taken = selection.rows.iter().map(|&row| {
        let constraint = &system.constraints[terms.constraint_index[row]];
        match constraint.kind {
            ConstraintKind::Holonomic => 2,
            _ => 1,
        }
    });
    2 * system.n() - taken.sum::<usize>()
}

/// The other model seen from ours.
struct Image<'a> {
    system: &'a System,
    twin: &'a Twin,
    /// Q, Q', and Q'' along our motion.
    jets: [Vec<Expr>; 3],
}

impl<'a> Image<'a> {
    fn new(system: &'a System, twin: &'a Twin, motion: &Equations) -> Image<'a> {
        let g = &system.graph;
        let derived =
            |es: &[Expr]| -> Vec<Expr> { es.iter().map(|&e| system.total_derivative(e)).collect() };
        let velocities = derived(&twin.map);
        let pairs = system
            .coordinates
            .iter()
            .map(|c| c.a)
            .zip(motion.accelerations.iter().copied());
        let accelerations = g.substitute_all(&derived(&velocities), &pairs.collect::<Vec<_>>());
        Image {
            system,
            twin,
            jets: [twin.map.clone(), velocities, accelerations],
        }
    }

    /// Functions of the other's states as functions of ours.
    fn of(&self, es: &[Expr]) -> Vec<Expr> {
        let (g, other) = (&self.system.graph, &*self.twin.system);
        let theirs = &other.graph;
        let es = theirs.substitute_all(es, &self.of_its_own());
        g.copied(theirs, &es, &mut |symbol| {
            let (name, order) = (theirs.symbol_name(symbol), theirs.symbol_order(symbol));
            if let (Some(i), Some(jet)) =
                (other.coordinate_index(name), self.jets.get(order as usize))
            {
                return jet[i];
            }
            let ours = self.twin.symbols.iter().find(|(own, _)| own == name);
            ours.map_or_else(
                || g.symbol(name, order),
                |&(_, e)| match order {
                    0 => e,
                    order => g.symbol(name, order),
                },
            )
        })
    }

    /// What the other model says of parameters and controls that we do not.
    fn of_its_own(&self) -> Vec<(Expr, Expr)> {
        let other = &*self.twin.system;
        let g = &other.graph;
        let is_ours = |name: &str| self.twin.symbols.iter().any(|(own, _)| own == name);
        let mut values: Vec<(Expr, Expr)> = Vec::new();
        for parameter in other.parameters.iter().filter(|p| !is_ours(&p.name)) {
            let defined = other.definitions.iter().find(|(s, _)| *s == parameter.expr);
            let value = defined.map(|(_, e)| *e).or(parameter.value);
            values.extend(value.map(|value| (parameter.expr, value)));
        }
        let time = g.intern_symbol("t", 0);
        for control in other.controls.iter().filter(|u| !is_ours(&u.name)) {
            let mut law = control.law;
            for order in 0..=2 {
                values.extend(law.map(|law| (g.symbol(&control.name, order), law)));
                law = law.map(|law| g.diff(law, time));
            }
        }
        // Definitions and laws may contain parameters that have their own.
        let inner = values.clone();
        for (_, value) in &mut values {
            *value = (0..inner.len()).fold(*value, |e, _| g.substitute(e, &inner));
        }
        values
    }

    /// Whether the image of admissible states is admissible.
    fn admissible(&self, cx: &Context<'_>) -> Verdict {
        let other = &self.twin.system;
        let all = other.constraints.iter();
        let mut names = Vec::new();
        let mut stated = Vec::new();
        for constraint in all {
            names.push(format!(
                "constraint `{}` of the other model, left minus right,",
                constraint.name
            ));
            stated.push(constraint.stated);
            if constraint.kind == ConstraintKind::Holonomic {
                names.push(format!(
                    "the rate of constraint `{}` of the other model",
                    constraint.name
                ));
                stated.push(constraint.f);
            }
        }
        let residuals: Vec<(String, Expr)> = names.into_iter().zip(self.of(&stated)).collect();
        if residuals.is_empty() {
            return Verdict::Proved(Proof::structural(
                "everywhere",
                "the other model has no constraints",
            ));
        }
        hold(
            cx,
            &residuals,
            "admissible states of this model are such of the other",
        )
    }

    /// Whether states near each other have different images.
    fn one_to_one(&self, cx: &Context<'_>) -> Result<Verdict, Verdict> {
        let (system, g) = (self.system, &self.system.graph);
        let symbols: Vec<Symbol> =
            [system.coordinate_symbols(), system.velocity_symbols()].concat();
        let mut functions = [self.jets[0].clone(), self.jets[1].clone()].concat();
        for constraint in &system.constraints {
            functions.push(constraint.f);
            if constraint.kind == ConstraintKind::Holonomic {
                functions.push(constraint.stated);
            }
        }
        let matrix = g.jacobian(&functions, &symbols);
        let set = constraint_set(cx);
        let rank = cx
            .prover
            .rank(system, &matrix, &set)
            .map_err(|verdict| *verdict)?;
        if rank.minimum == symbols.len() {
            return Ok(rank.at_least);
        }
        if rank.maximum == symbols.len() {
            return Err(Verdict::undecided(
                "the map loses directions on some components of the constraints and not on others",
            ));
        }
        let lost = symbols.len() - rank.maximum;
        Err(match rank.at_most {
            Verdict::Proved(proof) => Verdict::Refuted(Counterexample {
                point: Vec::new(),
                quantity: "directions of admissible states that the map loses, at every state".into(),
                residual: (lost.to_string(), lost.to_string()),
                detail: format!("states do not correspond: different states of this model, in {lost} of the directions of its admissible states, have the same image ({})", proof.detail),
            }),
            other => other,
        })
    }

    fn same_accelerations(&self, cx: &Context<'_>, their_motion: &Equations) -> Verdict {
        let g = &self.system.graph;
        let theirs = self.of(&their_motion.accelerations);
        let names = self.twin.system.coordinates.iter();
        let names: Vec<&str> = names.map(|c| c.name.as_str()).collect();
        let pairs = || names.iter().zip(theirs.iter().zip(&self.jets[2]));
        let residuals: Vec<(String, Expr)> = pairs()
            .map(|(name, (&a, &b))| {
                (
                    format!(
                        "{name}'' of the other model minus {name}'' along the motion of this one"
                    ),
                    g.sub(a, b),
                )
            })
            .collect();
        let verdict = hold(cx, &residuals, "the accelerations agree");
        let Verdict::Refuted(mut found) = verdict else {
            return verdict;
        };
        let numbers = State::of(cx, &found).and_then(|state| {
            let (a, b) = (state.evaluate(&theirs)?, state.evaluate(&self.jets[2])?);
            let own = names.iter().zip(a.iter().zip(&b));
            let differing: Vec<String> = own
                .filter(|(_, (a, b))| (**a - **b).abs() > 1e-9 * (a.abs() + b.abs()))
                .map(|(name, (a, b))| {
                    format!(
                        "there the other model has {name}'' = {}, and this one {}",
                        number(*a),
                        number(*b)
                    )
                })
                .collect();
            (!differing.is_empty()).then(|| differing.join("; "))
        });
        found.detail = match numbers {
            Some(numbers) => format!("the accelerations differ: {}; {numbers}", found.detail),
            None => format!("the accelerations differ: {}", found.detail),
        };
        Verdict::Refuted(found)
    }
}
