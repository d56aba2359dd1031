//! The claims: each compares integrals over the motion with what the proofs say.

use super::first::Form;
use super::refined::{Refined, CLEARLY};
use super::{evidence, first, kappa, linear, neighbours, refined};
use crate::motion_claims::of_another_system;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group, Scope};
use chetaev_mechanics::words;
use chetaev_mechanics::words::counted;
use chetaev_symbolic::verdict::{Counterexample, Evidence, PointValue, Proof};
use chetaev_symbolic::Verdict;

/// The claims of this module.
pub static CLAIMS: &[&dyn Claim] = &[
    &WitnessOfForms,
    &WitnessOfAction,
    &WitnessOfEnds,
    &WitnessOfIndex,
    &super::of_quadratures::WitnessOfQuadratures,
    &super::least_action::WitnessOfLeastAction,
    &super::of_stationary_action::WitnessOfStationaryAction,
    &super::second_kind::WitnessOfSecondKind,
    &super::operators::WitnessOfOperators,
    &super::other_time::WitnessOfOtherTime,
];

/// A first variation below this part of its terms is rounding and the error of the motion.
const ROUNDING: f64 = 1e-8;
/// Where doubled steps change the action by more, the quadrature says nothing.
const COARSE: f64 = 1e-2;
/// A change of the action beyond this part of its terms, ten times what the motion leaves open, and beyond the error of the steps,
/// is one.
const CHANGED: f64 = 10.0 * ROUNDING;
/// What is to contradict a proof is larger still.
const CONTRADICTING: f64 = 100.0 * ROUNDING;

pub(super) fn subjects_if_motion(cx: &Context<'_>, all: &[&str]) -> Vec<Option<String>> {
    let applies = evidence(cx).is_some() && cx.terms.order == 1;
    let subjects = all.iter().filter(|_| applies);
    subjects.map(|s| Some((*s).to_string())).collect()
}

/// Once for a motion of a system with so many coordinates at most.
pub(super) fn once_up_to(cx: &Context<'_>, coordinates: usize) -> Vec<Option<String>> {
    let is_small = cx.system.n() <= coordinates;
    match evidence(cx).is_some() && cx.terms.order == 1 && is_small {
        true => vec![None],
        false => Vec::new(),
    }
}

/// The verdict that a motion of another system gives.
pub(super) fn elsewhere(cx: &Context<'_>) -> Option<Finding> {
    match evidence(cx) {
        Some(evidence) => of_another_system(&evidence),
        None => Some(Verdict::undecided("no motion was computed").into()),
    }
}

pub(super) fn numerical(
    samples: u32,
    interval: (f64, f64),
    residual: f64,
    sentence: String,
) -> Verdict {
    Verdict::Numerical(Evidence {
        samples,
        region: format!(
            "along the computed motion from t = {} to {}",
            words::number(interval.0),
            words::number(interval.1)
        ),
        digits: 16,
        residual,
        seed: Some(refined::SEED),
        why_no_proof: sentence,
    })
}

pub(super) fn refuted(quantity: &str, t: f64, value: f64, detail: String) -> Verdict {
    let text = |x: f64| (format!("{x:e}"), format!("{x:e}"));
    Verdict::Refuted(Counterexample {
        point: vec![PointValue {
            name: "t".into(),
            exact: None,
            enclosure: Some((format!("{t}"), format!("{t}"))),
        }],
        quantity: quantity.into(),
        residual: text(value),
        detail,
    })
}

/// Whether the constraints leave no velocity free: then every variation with fixed ends vanishes, and quotients of integrals are noise.
pub(super) fn is_fixed(cx: &Context<'_>) -> bool {
    cx.system.n() == cx.selection.rows.len()
}

pub(super) fn nothing_varies(what: &str) -> Verdict {
    let detail = format!("as many independent constraints as coordinates: there are no {what} but zero, and every first variation vanishes");
    Verdict::Proved(Proof::structural("for every motion", detail))
}

/// `witness.first-variation#FORM`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfForms;

impl Claim for WitnessOfForms {
    fn id(&self) -> &'static str {
        "witness.first-variation"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "The first variation of a form vanishes along the computed motion"
    }

    fn explanation(&self) -> &'static str {
        "Along the computed motion each form of Hamilton's principle is integrated for random virtual displacements that vanish at the ends: the integrand of Hölder and that of \
         Helmholtz and Poincaré (with random δp) for displacements projected on the constraints, those of Voronets and Suslov by their own rules in independent velocities, where these stay independent. \
         The trapezoidal rule is repeated with doubled steps. The integral, over that of the sizes of its terms, must vanish as the step is refined, down to the error of the motion; \
         `refuted` means that it does not, so motion or form is wrong. It is a witness, not a proof: numbers of one motion. \
         Example: a free particle x = t from 0 to 1 with δx = t (1 − t): ∫x' D(δx) dt = ∫(1 − 2 t) dt = 0. For x = \
         t², which is no motion, it is ∫2 t (1 − 2 t) dt = −1/3."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let mut hypotheses = vec![
            "model.accelerations-unique".to_string(),
            "model.masses-free-of-velocity".into(),
        ];
        // There is no H where velocities are no functions of momenta.
        if subject == Some(Form::HelmholtzPoincare.word()) {
            hypotheses.push("model.hessian-regular".into());
        }
        hypotheses
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let words: Vec<&str> = Form::of(cx).into_iter().map(Form::word).collect();
        subjects_if_motion(cx, &words)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let form = Form::ALL.into_iter().find(|f| Some(f.word()) == subject);
        let Some(form) = form else {
            return Verdict::undecided("there is no such form").into();
        };
        if is_fixed(cx) {
            return nothing_varies("virtual displacements").into();
        }
        match first::of(cx, form) {
            Ok(found) => of_form(&found).into(),
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

fn of_form(found: &first::FirstVariation) -> Verdict {
    vanishing(&found.refined, found.form.whose(), "first variation")
}

/// The verdict on an integral that a principle says is zero: `whose` is integrated, `quantity` would be refuted.
pub(super) fn vanishing(found: &Refined, whose: &str, quantity: &str) -> Verdict {
    let sentence = format!(
        "{whose} over {} random variations: |∫ δ dt| over the sizes of its terms is",
        found.variations
    );
    judged(found, &sentence, quantity)
}

/// The verdict on numbers that must vanish as the step is refined, which the sentence ends with.
pub(super) fn judged(found: &Refined, sentence: &str, quantity: &str) -> Verdict {
    let shown: Vec<String> = found
        .residuals
        .iter()
        .rev()
        .map(|r| format!("{r:.1e}"))
        .collect();
    let sentence = format!(
        "{sentence} {} with steps {:.2e} to {:.2e}",
        shown.join(", "),
        found.steps[found.steps.len() - 1],
        found.steps[0],
    );
    let value = found.residuals[0];
    let open = 3.0 * found.change + ROUNDING;
    if value <= open && found.change <= CLEARLY {
        return numerical(found.variations, found.interval, value, sentence);
    }
    if value > 3.0 * open + CLEARLY {
        return refuted(quantity, found.interval.1, value, sentence);
    }
    Verdict::undecided(format!(
        "{sentence}; the output is too coarse for a quadrature"
    ))
}

/// `witness.stationary`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfAction;

impl Claim for WitnessOfAction {
    fn id(&self) -> &'static str {
        super::STATIONARY
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "The action of admissible neighbours changes as hamilton.stationary says"
    }

    fn explanation(&self) -> &'static str {
        "Neighbours of the computed motion that satisfy the constraints to first order and have the same ends, f_q η + ∂f/∂v·η' = 0, are integrated along it, and δ∫L dt = ∫(∂L/∂q η + p η') dt \
         is taken for several of them. It vanishes exactly where the motion makes the action stationary. The number, over the integral of the sizes of its terms, is stated with its change when the steps are doubled, and \
         compared with the verdict of hamilton.stationary: where every motion is stationary it must be zero; where no motion is, or those on a subset, the number says whether this one is. \
         Example: a rolling disc has zero although δf ≠ 0 for virtual δq; the cycloid of a skate on an incline has not."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.forces-absent".into(),
            "model.accelerations-unique".into(),
            "model.masses-of-time".into(),
        ]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_up_to(cx, neighbours::COORDINATES)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        if is_fixed(cx) {
            return nothing_varies("admissible neighbours with the same ends").into();
        }
        match neighbours::of(cx) {
            Ok(found) => of_action(cx, &found, "δ∫L dt").into(),
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

/// The verdict on the change of an action among admissible neighbours.
pub(super) fn of_action(
    cx: &Context<'_>,
    found: &neighbours::Neighbours,
    quantity: &str,
) -> Verdict {
    let stationary = "hamilton.stationary";
    let verdict = cx.finding(stationary).verdict.clone();
    let vanishes = found.change <= 3.0 * found.error + ROUNDING;
    let sentence = format!(
        "largest |{quantity}| over the sizes of its terms, for {} admissible neighbours with the same ends: {:.2e}, and {:.1e} of it by the steps; `{stationary}` is {}",
        found.variations,
        found.change,
        found.error,
        verdict.word()
    );
    if found.error > COARSE {
        return Verdict::undecided(format!(
            "{sentence}; the output is too coarse for a quadrature"
        ));
    }
    // Doubled steps have sixteen times the error: what is left is a fifteenth of the difference, or not much more.
    let differs = !vanishes && found.change > CHANGED + 2.0 * found.error;
    let contradicts = found.change > CONTRADICTING + 30.0 * found.error;
    let (said, residual) = match (&verdict, vanishes) {
        (Verdict::Proved(_), true) => ("the action is stationary", found.change),
        (Verdict::Proved(_), false) if differs && kappa::loses_rank(cx) => (
            "of this motion, on which the conditions on κ have a lower rank than on others, the action is not stationary",
            found.error,
        ),
        (Verdict::Proved(_), false) if contradicts => {
            return refuted(quantity, found.interval.1, found.change, sentence)
        }
        (_, true) => (
            "of this motion the action is stationary to the accuracy of the quadrature",
            found.change,
        ),
        (_, false) if differs && !matches!(verdict, Verdict::Proved(_)) => {
            ("of this motion the action is not stationary", found.error)
        }
        _ => {
            let tried = format!("{sentence}; too small to be told from zero");
            return Verdict::undecided(tried);
        }
    };
    let sentence = format!("{said}: {sentence}");
    numerical(found.variations, found.interval, residual, sentence)
}

/// `witness.endpoints`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfEnds;

impl Claim for WitnessOfEnds {
    fn id(&self) -> &'static str {
        "witness.endpoints"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "Motions from the start reach a set of dimension n − r at later times too"
    }

    fn explanation(&self) -> &'static str {
        "What hamilton.endpoints says for small times is followed along the computed motion: the derivatives of q(t) by the n − r admissible initial velocities, from the variational equations. \
         The share of positions, √(2^k det Q / det(Q + τ² V)) with the Gram matrices Q and V of the derivatives of positions and velocities and τ the ratio of their largest lengths so far, is about 1 for small times and 0 where a change of the initial velocity moves no position: at such focal times the rank drops, and neighbouring motions meet to first order. \
         Example: an oscillator q'' = −q has ∂q/∂v(0) = sin t, which is 0 at t = π: all motions from one point \
         meet again there."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.masses-of-time".into(),
        ]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_up_to(cx, linear::COORDINATES)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        match linear::reach(cx) {
            Ok(found) => of_ends(&found).into(),
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

fn of_ends(found: &linear::Reach) -> Verdict {
    let (least, t) = found.least;
    let rank = match linear::is_flat(found.at_end) {
        true => format!("less than {}", found.dimension),
        false => found.dimension.to_string(),
    };
    let sentence = format!(
        "the derivative of q(t) by {} has the rank {rank} at the end; the least share of positions is {least:.1e}, at t = {t:.6}",
        counted(
            found.dimension,
            "admissible initial velocity",
            "admissible initial velocities"
        )
    );
    numerical(1, found.interval, least, sentence)
}

/// `witness.index`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfIndex;

impl Claim for WitnessOfIndex {
    fn id(&self) -> &'static str {
        "witness.index"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "Conjugate times of the computed motion, and the index of its action"
    }

    fn explanation(&self) -> &'static str {
        "Where the computed motion makes the action stationary with a unique κ, the second variation ∫(η' F_vv η' + 2 η F_qv η' + η F_qq η) dt, F = L + Σ κ f, for admissible η that vanish at the ends, says of which kind the stationary value is: \
         with F_vv positive on the null space of ∂f/∂v it has as many negative directions as there are conjugate times, and the action is a (weak) minimum up to the first. Conjugate times are found from the linearized equations of the extremum with η = 0 at the start. \
         It is a property of the motion, of κ and of the interval, never of the system alone. Where κ is not unique an index belongs to κ, not to the curve: it is that of the κ(0) stated as kappa_NAME under [initial], and none without, unless the constraints are integrable and affine in the velocities: \
         then κ adds nothing to the second variation on the leaf, and conjugate times are those at which motions from one point meet again to first order. \
         Where κ may change without any coordinate the extremal is abnormal (the multiplier ν₀ of L may be zero): a minimum by one κ is one, but a negative direction by one κ proves nothing. Example: an oscillator q'' = −w² q has them every π/w."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "hamilton.stationary".into(),
            "model.constrained-extremum-regular".into(),
        ]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_up_to(cx, linear::COORDINATES)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        let stationary = cx.finding("hamilton.stationary");
        let of_all = matches!(stationary.verdict, Verdict::Proved(_));
        let leaf = linear::on_leaf(cx);
        match kappa::multipliers(cx) {
            Err(why) if !of_all => {
                return Verdict::not_applicable("hamilton.stationary", why).into();
            }
            Err(why) if !leaf => return Verdict::undecided(why).into(),
            _ => {}
        }
        let where_ = match (leaf, of_all) {
            (true, _) => "among the curves on the leaf of the integrable constraints, where κ takes no part: ",
            (_, false) => "on the set of stationary motions that this one lies on: ",
            _ => "",
        };
        match linear::conjugate(cx) {
            Ok(found) => of_index(&found, where_).into(),
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

fn of_index(found: &linear::Conjugate, where_: &str) -> Verdict {
    let (from, to) = found.interval;
    let sentence = match (&found.legendre, found.times.as_slice()) {
        (Err(t), _) if found.abnormal > 0 => format!(
            "with this κ F_vv is not positive on the null space of ∂f/∂v at t = {t:.6}, and the second variation has negative directions on every interval; of the curve that says nothing, as it is abnormal and has other κ"
        ),
        (Err(t), _) => format!(
            "F_vv is not positive on the null space of ∂f/∂v at t = {t:.6}: the action is no minimum, however short the interval"
        ),
        (Ok(()), []) if found.at_end => format!(
            "the end {to:.6} is the first conjugate time from {from:.6} on, to the accuracy of the run: the action is a weak minimum on any shorter interval, and degenerate on this one"
        ),
        (Ok(()), []) => format!("no conjugate time from {from:.6} to {to:.6}: the action is a weak minimum, its index 0"),
        (Ok(()), times) => {
            let shown: Vec<String> = times.iter().take(5).map(|t| format!("{t:.6}")).collect();
            let more = if times.len() > 5 { ", …" } else { "" };
            let end = match found.at_end {
                true => ", which is one more, to the accuracy of the run",
                false => "",
            };
            format!(
                "conjugate times {}{more}: the action is a weak minimum up to the first, and has the index {} at the end{end}",
                shown.join(", "),
                times.len()
            )
        }
    };
    let given: Vec<String> = found
        .given
        .iter()
        .map(|(name, value)| format!("{name}(0) = {value}"))
        .collect();
    let given = match given.is_empty() {
        true => String::new(),
        false => format!("with {} as stated: ", given.join(", ")),
    };
    let abnormal = match found.abnormal {
        0 => String::new(),
        many => format!(
            "; the extremal is abnormal: {} of κ move{} no coordinate (ν₀ = 0)",
            counted(many, "independent variation", "independent variations"),
            if many == 1 { "s" } else { "" }
        ),
    };
    let sentence = format!("{where_}{given}{sentence}{abnormal}");
    numerical(1, found.interval, 0.0, sentence)
}
