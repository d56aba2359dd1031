//! `witness.universal-relation#…`: the principle of the first and intermediate kind along the computed motion, with δv by an operator.
//!
//! δL is the change of L itself between varied states (q + ε δq, v + ε δv), for several ε on both sides, with δv = A(δq) for some of
//! the velocities and random functions for the others. So δv does not cancel in formulas: the integrals are computed with
//! each choice and compared.

use super::algebra::{determinant, gram, times};
use super::claims::{elsewhere, numerical, vanishing};
use super::common::Common;
use super::first::INDEPENDENT;
use super::neighbours::COORDINATES;
use super::refined::{longest, worst, Refined, Rule, Span, Term};
use super::samples::Samples;
use super::states::{Change, States};
use super::wave::Wave;
use super::{evidence, show, Figure};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{full_id, Claim, Context, Finding, Group, Scope};
use chetaev_principles::universal_relation::{operator, Operator, UniversalRelation};
use chetaev_principles::variations::{delta_name, Displacements};
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::ops::Range;
use std::sync::Arc;

/// What proves it.
const RELATION: &str = "universal-relation";
/// Near a pole of an operator the momentum is below this part of its largest value.
const POLE: f64 = 0.05;
/// Integrals with different operators agree where they differ by less.
const AGREE: f64 = 1e-8;

/// `witness.universal-relation#OPERATOR`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfOperators;

impl Claim for WitnessOfOperators {
    fn id(&self) -> &'static str {
        "witness.universal-relation"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "The relation δv = A(δq) does not matter along the computed motion"
    }

    fn explanation(&self) -> &'static str {
        "∫{δL + Σ p (D(δq) − δv) + Σ Q δq} dt is computed along the motion with δv = A(δq) by the operator, for random virtual δq that vanish at the ends: once on all velocities, then on random subsets of them, with random δv for the others. \
         δL is the difference of L at varied states, not its derivative by formulas. The integral, over the sizes of its terms, must vanish as the step is halved, and must be that with δv = D(δq), to the accuracy of the differences. \
         Where an operator has poles, or the independent velocities of Suslov's rule become dependent, the longest stretch without them is taken. Without the second sum it is no principle but for operators made for that. \
         Example: a free particle x = t with δx = t (1 − t): with A = 0, δL = 0, and ∫x' D(δx) dt = ∫(1 − 2 t) dt = 0 is left; with A = D(δx) it is all in δL."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        vec![full_id(RELATION, subject)]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match evidence(cx).is_some() && cx.terms.order == 1 && cx.system.n() <= COORDINATES {
            true => UniversalRelation.subjects(cx),
            false => Vec::new(),
        }
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let proof = full_id(RELATION, subject);
        if !matches!(cx.finding(&proof).verdict, Verdict::Proved(_)) {
            let detail = "the relation is not proved of this system";
            return Verdict::not_applicable(proof, detail).into();
        }
        let name = subject.unwrap_or_default();
        let operator = match operator(cx, name) {
            Ok(Ok(operator)) => operator,
            Ok(Err(verdict)) => return (*verdict).into(),
            Err(problem) => return problem.into(),
        };
        let found = Imposed::new(cx, name, &operator).and_then(|mut imposed| {
            let found = imposed.found()?;
            Ok((found, imposed.spread))
        });
        match found {
            Ok((found, spread)) => {
                let verdict = judged(&found, name, spread);
                show(
                    cx,
                    Figure::Operators,
                    (name, &format!("operator {name}")),
                    found,
                );
                verdict.into()
            }
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

fn judged(found: &Refined, name: &str, spread: f64) -> Verdict {
    let whose = format!("the principle with the operator `{name}`, on all and on some velocities,");
    let verdict = vanishing(found, &whose, "first variation");
    let said = format!("; with other δv it differs by {spread:.1e}");
    match verdict {
        Verdict::Numerical(evidence) if spread <= AGREE => numerical(
            evidence.samples,
            found.interval,
            evidence.residual,
            format!("{}{said}", evidence.why_no_proof),
        ),
        Verdict::Numerical(evidence) => {
            Verdict::undecided(format!("{}{said}", evidence.why_no_proof))
        }
        other => other,
    }
}

/// An operator along the motion.
pub(super) struct Imposed {
    common: Arc<Common>,
    /// The coefficients of δq and of D(δq), momenta that are divided by, and the minor of the dependent velocities.
    samples: Samples,
    states: States,
    rows: Range<usize>,
    /// Which velocities the operator says something of.
    stated: Vec<bool>,
    /// The largest difference to the integral with δv = D(δq), over the sizes of the terms.
    pub(super) spread: f64,
    /// Whether Σ p (D(δq) − δv) is left out, which is wrong: for tests.
    pub(super) bare: bool,
}

const BY_DISPLACEMENTS: usize = 0;
const BY_MOVED: usize = 1;
const POLES: usize = 2;
const MINOR: usize = 3;

impl Imposed {
    pub(super) fn new(
        cx: &Context<'_>,
        name: &str,
        operator: &Operator,
    ) -> Result<Imposed, String> {
        let common = Common::of(cx)?;
        let (by_displacements, by_moved) = coefficients(cx, operator)?;
        let poles: Vec<Expr> = operator.poles.iter().map(|(_, p)| *p).collect();
        let dependent = match name {
            "suslov" => {
                Displacements::new(cx)
                    .map_err(|problem| problem.to_string())?
                    .chart
                    .dependent
            }
            _ => Vec::new(),
        };
        let jacobian = basis(cx).jacobian();
        let rows = jacobian.iter();
        let minor = rows.flat_map(|row| dependent.iter().map(|&i| row[i]));
        let minor: Vec<Expr> = minor.collect();
        let samples = Samples::new(cx, &[&by_displacements, &by_moved, &poles, &minor])?;
        Ok(Imposed {
            rows: without_poles(&samples, &common, dependent.len()),
            samples,
            states: common.lagrangian.clone(),
            common,
            stated: operator.relations.iter().map(Option::is_some).collect(),
            spread: 0.0,
            bare: false,
        })
    }

    /// The integral for the variation at which it is largest.
    pub(super) fn found(&mut self) -> Result<Refined, String> {
        let rule = Rule::Vanishing;
        let what = match self.samples.at(MINOR, 0) {
            [] => "the operator has no pole",
            _ => "the velocities taken as independent are so",
        };
        let span = Span::new(self.common.times(), &self.rows, (rule, what))?;
        let mut is_first = true;
        let n = self.common.n;
        worst(|generator| {
            let mut waves: Vec<Wave> = (0..n).map(|_| Wave::vanishing(generator)).collect();
            waves.extend((0..n).map(|_| Wave::vanishing(generator)));
            let on: Vec<bool> = (0..n)
                .map(|i| self.stated[i] && (generator.between(0.0, 1.0) < 0.5 || is_first))
                .collect();
            is_first = false;
            let own = self.integral(&span, &waves, Some(&on))?;
            let other = self.integral(&span, &waves, None)?;
            let gap = (own.1 - other.1).abs();
            self.spread = self
                .spread
                .max(if own.2 == 0.0 { 0.0 } else { gap / own.2 });
            Ok(own.0)
        })
    }

    /// The integral with the operator on some velocities, or with δv = D(δq); the value with the smallest step, and its scale.
    fn integral(
        &mut self,
        span: &Span,
        waves: &[Wave],
        on: Option<&[bool]>,
    ) -> Result<(Refined, f64, f64), String> {
        let mut terms: Vec<Term> = Vec::new();
        for (row, share) in span.rows() {
            let of: Vec<(f64, f64)> = waves.iter().map(|w| w.at(share, span.length())).collect();
            let term = self.term(row, &of, on);
            terms.push(term.ok_or("the principle has no value at a row")?);
        }
        let sum = |part: fn(&Term) -> f64| terms.iter().map(part).sum::<f64>();
        let (value, scale) = (sum(|t| t.0), sum(|t| t.1));
        let found = span.integral(Rule::Vanishing, |_| Some(terms.clone()), (0.0, 0.0))?;
        Ok((found, value, scale))
    }

    /// `δL + Σ p (D(δq) − δv) + Σ Q δq` at a row.
    fn term(&mut self, row: usize, of: &[(f64, f64)], on: Option<&[bool]>) -> Option<Term> {
        let (common, n) = (&self.common, self.common.n);
        let (free, own) = of.split_at(n);
        let (value, moved) = common.projected(row, free)?;
        let velocities: Vec<f64> = match on {
            None => moved.clone(),
            Some(on) => {
                let a = times(self.samples.at(BY_DISPLACEMENTS, row), n, &value);
                let b = times(self.samples.at(BY_MOVED, row), n, &moved);
                (0..n)
                    .map(|i| {
                        if on[i] {
                            a[i] + b[i]
                        } else {
                            own[i].0 * common.speed(i)
                        }
                    })
                    .collect()
            }
        };
        let (slopes, forces, momenta) =
            (common.slopes(row), common.forces(row), common.momenta(row));
        let mut parts: Vec<f64> = Vec::new();
        for i in 0..n {
            parts.push(forces[i] * value[i]);
            if !self.bare {
                parts.push(momenta[i] * (moved[i] - velocities[i]));
            }
        }
        let sizes =
            (0..n).map(|i| (slopes[i] * value[i]).abs() + (momenta[i] * velocities[i]).abs());
        let size = sizes.sum::<f64>() + parts.iter().map(|x| x.abs()).sum::<f64>();
        let size = size + common.noise(row);
        let change = Change {
            coordinates: value,
            velocities,
            ..Change::default()
        };
        let varied = self.states.derivative(|states, e| {
            let lagrangian = states.at(row, e, &change)[0];
            lagrangian.is_finite().then_some(lagrangian)
        })?;
        Some((varied + parts.iter().sum::<f64>(), size))
    }
}

/// The coefficients of δq and of D(δq) in δv, n × n each, zero for velocities of which nothing is said.
fn coefficients(cx: &Context<'_>, operator: &Operator) -> Result<(Vec<Expr>, Vec<Expr>), String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let names: Vec<String> = (0..system.n()).map(|i| delta_name(system, i)).collect();
    let symbols = |order: u32| -> Vec<Symbol> {
        names
            .iter()
            .map(|name| g.intern_symbol(name, order))
            .collect()
    };
    let relations: Vec<Expr> = operator
        .relations
        .iter()
        .map(|relation| relation.unwrap_or(g.zero()))
        .collect();
    let is_higher =
        |s: &Symbol| g.symbol_order(*s) > 1 && names.iter().any(|name| name == g.symbol_name(*s));
    if g.symbols_in(&relations).iter().any(is_higher) {
        return Err(
            "the operator contains higher derivatives of δq, which are not computed".into(),
        );
    }
    Ok((
        g.jacobian(&relations, &symbols(0)).concat(),
        g.jacobian(&relations, &symbols(1)).concat(),
    ))
}

/// The longest stretch on which no momentum that the operator divides by comes near zero, and the velocities that Suslov's rule
/// takes as independent are.
fn without_poles(samples: &Samples, common: &Common, dependent: usize) -> Range<usize> {
    let count = samples.times.len();
    let poles = samples.at(POLES, 0).len();
    let largest: Vec<f64> = (0..poles)
        .map(|j| (0..count).fold(0.0_f64, |m, row| m.max(samples.at(POLES, row)[j].abs())))
        .collect();
    longest(count, |row| {
        let here = samples.at(POLES, row);
        let is_clear = (0..poles).all(|j| {
            let before = samples.at(POLES, row.saturating_sub(1))[j];
            here[j].abs() > POLE * largest[j] && here[j] * before > 0.0
        });
        let is_independent = dependent == 0 || {
            let whole =
                determinant(common.r, &gram(common.jacobian(row), common.r, common.n)).sqrt();
            determinant(common.r, samples.at(MINOR, row)).abs() >= INDEPENDENT * whole
        };
        is_clear && is_independent
    })
}
