//! `hamilton.stationary`: whether Hamilton's principle is one of stationary action.

use super::cases::{confirmed, joined, Found, Leaf};
use super::closed_form::short;
use super::kappa::{integrated, integrated_on};
use super::motion::Motion;
use super::{sets, Closure, Exceptions};
use crate::words::{conditional, for_general_controls, formula, listed};
use chetaev_mechanics::claims::formulation::{basis, manifold};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::kappa_symbols;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// `hamilton.stationary`.
#[derive(Clone, Copy, Debug)]
pub struct Stationary;

impl Claim for Stationary {
    fn id(&self) -> &'static str {
        "hamilton.stationary"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Hamilton's principle is one of stationary action"
    }

    fn explanation(&self) -> &'static str {
        "Whether a motion makes the action ∫L dt stationary among the curves that satisfy the constraints. ∫δL dt = 0 for \
         virtual δq (hamilton.hoelder) does not say so, since the curves varied by it violate the constraints in general. \
         Curves that make the action stationary solve the equations of the constrained extremum for L + Σ κ f with multipliers \
         κ(t). A motion with the reactions λ is among them exactly where κ exists with (a) Σ κ E[f]·δq = 0 for every virtual δq and (b) κ' = ρ − λ, \
         where Σ κ E[f] = Σ ρ ∂f/∂v. These linear conditions are differentiated along the motion until nothing new comes; then \
         they hold for every motion (`proved`, with κ), for motions on an invariant subset given by equations (`conditional`), or for no such \
         subset that was found (`refuted`: for no motion, for none but rest, or for almost none, where others were not followed; the sentence says which). Example: a particle z' = y x' has E[f]·δq = y' δx − x' δy, so (a) \
         demands κ = 0 unless x' = y' = 0, and then (b) demands λ = x' y'/(1 + y²) = 0: only motions with x' = 0 or y' = 0 are stationary. \
         A rolling disc, which is not integrable either, has κ = (−m x', −m y') for every motion. κ = 0 alone would need all \
         reactions to vanish. Where κ is not unique, the difference of two satisfies the conditions with λ = 0: the motion is an extremal of ∫Σ κ f dt, without L, and called abnormal (its multiplier ν₀ of L may be zero). Parameters are taken as general; particular values with more such motions are named where they were found."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if cx.selection.rows.is_empty() {
            let detail = "without constraints Hamilton's principle is one of stationary action";
            return Verdict::Proved(Proof::structural("for every motion", detail)).into();
        }
        match &*Closure::of(cx) {
            Ok(closure) => decide(cx, closure),
            Err(problem) => Verdict::from(problem).into(),
        }
    }
}

/// What stationarity requires: an action, and a motion.
pub(super) fn requirements() -> Vec<String> {
    [
        "model.forces-absent",
        "model.accelerations-unique",
        "model.masses-of-time",
    ]
    .map(String::from)
    .to_vec()
}

fn decide(cx: &Context<'_>, closure: &Closure) -> Finding {
    let mut verdict = closure.verdict.clone();
    match &verdict {
        Verdict::Proved(_) => {
            let (kappa, formulas) = multipliers(cx, closure);
            let exceptions = Exceptions::of(cx, closure);
            verdict.prefix(&format!(
                "{} makes the action stationary among admissible curves{}; {kappa}",
                exceptions.every, exceptions.others
            ));
            Finding { verdict, formulas }
        }
        Verdict::Refuted(_) => match &*Motion::of(cx) {
            Ok(motion) => on_subsets(cx, motion, verdict),
            Err(why) => {
                verdict.prefix(&format!(
                    "{ALMOST_NONE}; their equations were not found: {why}"
                ));
                verdict.into()
            }
        },
        _ => {
            verdict.prefix("conditions on κ along the motion");
            verdict.into()
        }
    }
}

/// Of which motions `hamilton.stationary` is proved: "every motion", or those on which the conditions on κ keep their rank.
pub(crate) fn every_motion(cx: &Context<'_>) -> String {
    let closure = (!cx.selection.rows.is_empty()).then(|| Closure::of(cx));
    let known = closure
        .as_ref()
        .and_then(|found| found.as_ref().as_ref().ok());
    known.map_or("every motion".into(), |closure| {
        Exceptions::of(cx, closure).every.clone()
    })
}

/// κ in words and formulas where every motion is an extremal.
fn multipliers(cx: &Context<'_>, closure: &Closure) -> (String, Vec<Formula>) {
    let g = &cx.system.graph;
    let basis = basis(cx);
    let symbols = kappa_symbols(&basis);
    let solved: Vec<(Expr, Expr)> = manifold(cx)
        .solved
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    let motion = (closure.free > 0).then(|| Motion::of(cx));
    let unknown_motion = motion
        .as_ref()
        .and_then(|motion| motion.as_ref().as_ref().err());
    let motion = motion
        .as_ref()
        .and_then(|motion| motion.as_ref().as_ref().ok());
    let integrated = motion.map(|motion| integrated(cx, motion, closure));
    let mut formulas = Vec::new();
    let (mut known, mut unknown) = (Vec::new(), Vec::new());
    for (l, name) in basis.constraint_names().into_iter().enumerate() {
        let value = match closure.kappa[l] {
            Some(value) => Some(g.substitute(value, &solved)),
            None => integrated.as_ref().and_then(|values| values[l]),
        };
        let caption = format!("multiplier κ of `{name}`, along every motion");
        let shown = value.and_then(|value| formula(cx, caption, Some(symbols[l]), value));
        let text = g.text(symbols[l]);
        match &shown {
            Some(shown) => known.push(format!("{text} = {}", g.text(shown.right))),
            None => unknown.push(not_shown(&text, value.is_some(), unknown_motion)),
        }
        formulas.extend(shown);
    }
    let free = match closure.free {
        0 => "κ is unique".to_string(),
        1 if closure.kappa.len() == 1 => "every κ(0) serves".into(),
        1 => "1 constant of κ(0) is free".into(),
        free => format!("{free} constants of κ(0) are free"),
    };
    let values = match known.is_empty() {
        true => String::new(),
        false => format!("{}{}; ", known.join(", "), speeds(cx, motion, &formulas)),
    };
    let open: Vec<String> = unknown.iter().map(|text| format!("; {text}")).collect();
    let abnormal = match closure.free {
        0 => "",
        _ => "; as κ is not unique every motion is an abnormal extremal too: one of ∫Σ κ f dt without L (ν₀ = 0)",
    };
    (
        format!("{values}{free}{abnormal}{}", open.concat()),
        formulas,
    )
}

/// Why a multiplier is not written.
fn not_shown(symbol: &str, is_known: bool, motion: Option<&String>) -> String {
    match (is_known, motion) {
        (true, _) => format!("{symbol} is too long to be written here"),
        (false, Some(why)) => {
            format!("no closed form of {symbol} was looked for ({why}); it solves κ' = Φ κ − λ")
        }
        (false, None) => format!(
            "no closed form of {symbol} was found: κ' = Φ κ − λ was not integrated by the functions tried (momenta, velocities, coordinates, \
             roots of the constraints, the time, and their powers as factors)"
        ),
    }
}

/// What the speeds are that occur in formulas and that the model does not name.
fn speeds(cx: &Context<'_>, motion: Option<&Motion>, formulas: &[Formula]) -> String {
    let g = &cx.system.graph;
    let values: Vec<Expr> = formulas.iter().map(|f| f.right).collect();
    let occurring = g.symbols_in(&values);
    let own = motion.filter(|motion| motion.speeds.iter().any(|s| occurring.contains(s)));
    own.map_or(String::new(), |motion| legend(cx, motion))
}

/// The motions for which κ exists although it does not for all.
fn on_subsets(cx: &Context<'_>, motion: &Motion, mut refuted: Verdict) -> Finding {
    let found = sets::found(cx, motion);
    let found = &found.0;
    let open = not_followed(found);
    let all = moving_first(found);
    if all.first().is_none_or(|leaf| leaf.at_rest) {
        let sentence = match NoneBut::of(found) {
            NoneBut::Nothing => format!(
                "no motion makes the action stationary among admissible curves{}",
                general(cx, found)
            ),
            NoneBut::Rest => format!(
                "no motion makes the action stationary among admissible curves{}, except rest where {}",
                general(cx, found),
                alternatives(&all)
            ),
            NoneBut::Open => ALMOST_NONE.into(),
        };
        let particular = particular(cx, found);
        refuted.prefix(&format!("{sentence}{particular}{open}"));
        return refuted.into();
    }
    let legend = legend(cx, motion);
    let stated = format!("{}{legend}", alternatives(&all));
    let controls = for_general_controls(cx);
    let condition = format!("{stated}{controls}{open}");
    let how = "the conditions on κ were differentiated along the motion in every case, exactly";
    let proof = Proof::exact(place(cx, motion), how);
    let is_free = |leaf: &&Leaf| !leaf.at_rest && leaf.kappa.iter().any(Option::is_none);
    let free: Vec<&Leaf> = all.iter().copied().filter(is_free).collect();
    let (mut formulas, mut unknown) = (Vec::new(), String::new());
    if !free.is_empty() {
        unknown = format!(
            "; κ is not unique where {}, and these motions are abnormal extremals too (ν₀ = 0)",
            alternatives(&free)
        );
    }
    for leaf in &all {
        let (shown, missing) = of_leaf(cx, motion, leaf);
        formulas.extend(shown);
        unknown.push_str(&missing);
    }
    let mut verdict = conditional(condition, proof, refuted);
    let particular = particular(cx, found);
    verdict.prefix(&format!(
        "motions make the action stationary {}where {stated}{controls}{particular}{open}{unknown}",
        only(found)
    ));
    Finding { verdict, formulas }
}

/// What particular values of parameters change, as the end of a sentence.
fn particular(cx: &Context<'_>, found: &Found) -> String {
    let g = &cx.system.graph;
    let mut sentence = String::new();
    let stated = cx.system.parameter_values();
    for (values, leaves) in &found.special.found {
        let texts: Vec<String> = values
            .iter()
            .map(|&(parameter, value)| format!("{} = {}", g.text(parameter), g.text(value)))
            .collect();
        let (Some(own), Some((parameter, value))) = (texts.first(), values.first()) else {
            continue;
        };
        // Verdicts are those of all values, and a reader wants to know that his own are particular ones.
        let residual = g.substitute(g.sub(*parameter, *value), &stated);
        let by_model = match g.is_zero(short(g, residual)) {
            true => ", as by the values of the model",
            false => "",
        };
        let mut sets: Vec<Leaf> = leaves.clone();
        for leaf in &mut sets {
            leaf.equations.retain(|equation| !texts.contains(equation));
        }
        let sets: Vec<&Leaf> = sets.iter().collect();
        let more = match sets.iter().any(|leaf| leaf.equations.is_empty()) {
            true => "every motion does".to_string(),
            false => format!("also those do where {}", alternatives(&sets)),
        };
        sentence.push_str(&format!("; where {own}{by_model}, {more}"));
    }
    sentence
}

/// Of which parameters the verdict of `hamilton.stationary` is said, and what particular ones change: parts of a sentence, empty
/// where every motion is stationary, or nothing is left open.
pub(crate) fn of_parameters(cx: &Context<'_>) -> (&'static str, String) {
    match cx.known::<sets::Sets>() {
        Some(sets) => (for_general(&sets.0), particular(cx, &sets.0)),
        None => ("", String::new()),
    }
}

/// The sets, those of rest last.
pub(super) fn moving_first(found: &Found) -> Vec<&Leaf> {
    let (rest, moving): (Vec<&Leaf>, Vec<&Leaf>) =
        found.leaves.iter().partition(|leaf| leaf.at_rest);
    moving.into_iter().chain(rest).collect()
}

/// What a refutation of `hamilton.stationary` leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoneBut {
    /// No motion is stationary.
    Nothing,
    /// None but rest.
    Rest,
    /// Almost none; others were not followed.
    Open,
}

impl NoneBut {
    /// For sets without one that moves.
    fn of(found: &Found) -> NoneBut {
        match (found.leaves.is_empty(), found.open.is_empty()) {
            (true, true) => NoneBut::Nothing,
            (false, true) => NoneBut::Rest,
            _ => NoneBut::Open,
        }
    }

    /// For the context's system, where the verdict is `refuted`.
    pub(crate) fn refuted(cx: &Context<'_>) -> NoneBut {
        cx.known::<sets::Sets>()
            .map_or(NoneBut::Open, |sets| NoneBut::of(&sets.0))
    }
}

/// Sets that the zero test does not confirm are no longer among those found.
pub(super) fn set_aside_unconfirmed(cx: &Context<'_>, motion: &Motion, found: &mut Found) {
    let is_confirmed = |leaf: &Leaf| matches!(confirmed(cx, motion, leaf), Verdict::Proved(_));
    let (known, others): (Vec<Leaf>, Vec<Leaf>) =
        found.leaves.drain(..).partition(|leaf| is_confirmed(leaf));
    found.leaves = joined(&cx.system.graph, known);
    for (_, leaves) in &mut found.special.found {
        let count = leaves.len();
        leaves.retain(&is_confirmed);
        found.special.open |= leaves.len() < count;
        *leaves = joined(&cx.system.graph, std::mem::take(leaves));
    }
    found.special.found.retain(|(_, leaves)| !leaves.is_empty());
    let others = others.iter().map(|leaf| listed(&leaf.equations));
    found.open.extend(others);
}

/// The conditions are consistent at no state at which a function, analytic where the motion is and not zero at the counterexample,
/// differs from zero, and the ranks of the others are the greatest.
const ALMOST_NONE: &str = "almost no motion makes the action stationary: those that do pass through a set of states of lower dimension, on which a function vanishes that does not at the point stated";

/// κ on a subset: those that the conditions determine, and the others with their constants, where they have a closed form; and of which
/// no such form was found, as the end of a sentence.
fn of_leaf(cx: &Context<'_>, motion: &Motion, leaf: &Leaf) -> (Vec<Formula>, String) {
    let g = &cx.system.graph;
    let basis = basis(cx);
    let symbols = kappa_symbols(&basis);
    let names = basis.constraint_names().into_iter().zip(symbols);
    let values = match leaf.kappa.iter().all(Option::is_some) {
        true => leaf.kappa.clone(),
        false => integrated_on(cx, motion, leaf),
    };
    let (mut formulas, mut missing) = (Vec::new(), Vec::new());
    for ((name, symbol), (value, determined)) in names.zip(values.iter().zip(&leaf.kappa)) {
        let caption = format!("multiplier κ of `{name}` where {}", listed(&leaf.equations));
        let shown = determined
            .or(*value)
            .and_then(|value| formula(cx, caption, Some(symbol), value));
        if shown.is_none() {
            missing.push(g.text(symbol));
        }
        formulas.extend(shown);
    }
    let mut sentence = String::new();
    if leaf.at_rest {
        return (formulas, sentence);
    }
    let on = listed(&leaf.equations);
    if !missing.is_empty() {
        let missing = listed(&missing);
        sentence.push_str(&format!(
            "; of {missing} no short closed form was found where {on}"
        ));
    }
    (formulas, sentence)
}

/// "x' = 0, or y' = 0 and z = 1".
pub(super) fn alternatives(leaves: &[&Leaf]) -> String {
    let mut all: Vec<&Vec<String>> = Vec::new();
    for leaf in leaves {
        let own = leaf.without_branch.as_ref().unwrap_or(&leaf.equations);
        if !all.contains(&own) {
            all.push(own);
        }
    }
    let texts: Vec<String> = all.iter().map(|equations| listed(equations)).collect();
    if all.iter().any(|equations| equations.len() > 1) {
        texts.join(", or ")
    } else {
        texts.join(" or ")
    }
}

/// Longer conditions of cases that were not followed are not printed.
const FOLLOWED: usize = 120;
/// At most so many are.
const NAMED: usize = 6;

/// "only " where every case was followed.
pub(super) fn only(found: &Found) -> &'static str {
    match (found.open.is_empty(), found.special.open) {
        (true, true) => "(for general values of the parameters only) ",
        (true, false) => "only ",
        (false, _) => "",
    }
}

/// Of which parameters and controls a sentence is said.
fn general(cx: &Context<'_>, found: &Found) -> String {
    format!("{}{}", for_general(found), for_general_controls(cx))
}

/// Of which parameters a sentence is said, where particular ones were not followed.
fn for_general(found: &Found) -> &'static str {
    match found.special.open {
        true => ", for general values of the parameters",
        false => "",
    }
}

/// Where the cases were distinguished.
pub(super) fn place(cx: &Context<'_>, motion: &Motion) -> String {
    let g = &cx.system.graph;
    let poles: Vec<String> = motion
        .poles
        .iter()
        .map(|&e| format!("{} ≠ 0", g.text(e)))
        .collect();
    match poles.is_empty() {
        true => "for general values of the parameters".into(),
        false => format!(
            "for general values of the parameters, where {}",
            listed(&poles)
        ),
    }
}

/// What was not followed, as the end of a sentence.
pub(super) fn not_followed(found: &Found) -> String {
    let perhaps = match found.leaves.iter().any(|leaf| !leaf.at_rest) {
        true => "perhaps also",
        false => "whether it is so elsewhere is open,",
    };
    let is_short = |text: &&String| text.chars().count() < FOLLOWED;
    let (short, long): (Vec<&String>, Vec<&String>) = found.open.iter().partition(is_short);
    let named: Vec<&str> = short.iter().take(NAMED).map(|text| text.as_str()).collect();
    let others = long.len() + short.len() - named.len();
    match (named.as_slice(), others) {
        ([], 0) => String::new(),
        ([], 1) => format!("; {perhaps} in one case, too long to be followed"),
        ([], many) => format!("; {perhaps} in {many} cases, too long to be followed"),
        (named, 0) => format!(
            "; {perhaps} in cases that were not followed: {}",
            named.join(", or ")
        ),
        (named, others) => format!(
            "; {perhaps} in cases that were not followed: {}, and in {others} more, too long or too many to be written",
            named.join(", or ")
        ),
    }
}

/// What the speeds are that the model does not name.
pub(super) fn legend(cx: &Context<'_>, motion: &Motion) -> String {
    let g = &cx.system.graph;
    let pairs = motion.legend.iter();
    let pairs: Vec<String> = pairs
        .map(|&(v, e)| format!("{} = {}", g.text(v), g.text(e)))
        .collect();
    match pairs.is_empty() {
        true => String::new(),
        false => format!(" (with {})", pairs.join(", ")),
    }
}
