//! `functional.euler`: stationarity is equivalent to the stated equations.

use super::branches::{branches, Branch};
use super::modulo::{all_subsets as subsets, labels};
use super::reduction::{reduced, restricted};
use super::{Claim, Context, Finding};
use crate::elimination::{Group, Solved};
use crate::functional::{Constitutive, Equation, Functional, Role};
use crate::variation::{variation, Condition, OnPiece, Variation};
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Function, Node, Verdict};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// `functional.euler#NAME`.
pub(super) struct Euler;

impl Claim for Euler {
    fn id(&self) -> &'static str {
        "functional.euler"
    }

    fn title(&self) -> &'static str {
        "The functional is stationary exactly where the stated field equations and boundary conditions hold"
    }

    fn explanation(&self) -> &'static str {
        "The Euler equations and the natural conditions on each piece of the boundary are derived from the densities, and compared \
         with the equations that `yields` names, together with those that `imposed` names. Both systems are solved, one group of \
         equations after the other, for data, fields or their derivatives (a gradient B'(s) = e of a function with a Legendre \
         conjugate as s = A'(e)), and rules are differentiated as needed; then every equation of one system must vanish where the \
         other holds, both ways. Constitutive functions stay symbols with their derivatives, so that a proof holds for every \
         energy. What is solved for with a matrix that depends on the fields is named under \"on\": there the matrix must be \
         regular. Equations with a stated multiplier are added to the density with it before the variation. A refutation shows a \
         jet at which one system holds and the other does not."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        vec![cx.own()]
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        let functional = cx.functional();
        if functional.with_role(Role::Yielded).next().is_none() {
            return Verdict::not_applicable(
                "functional.euler",
                "the model states no field equations under `yields`, so the Euler equations are only printed",
            )
            .into();
        }
        let own = reduced(functional);
        let verdict = match branches(&own) {
            Some(all) => on_branches(&all),
            None => on_branch(&own, &[]),
        };
        match verdict {
            Verdict::Proved(mut proof) => {
                if let Some(said) = cx.admission.of_redundant() {
                    proof.detail.push_str(&format!(", with {said}"));
                }
                proof.on.push_str(&where_defined(functional));
                Verdict::Proved(proof).into()
            }
            other => other.into(),
        }
    }
}

/// The verdict where some expressions are known not to be negative.
fn on_branch(functional: &Functional, nonnegative: &[Expr]) -> Verdict {
    let own = match variation(functional) {
        Ok(own) => own,
        Err(problem) => return Verdict::undecided(problem.to_string()),
    };
    match restricted(functional, &own) {
        Some(why) => Verdict::undecided(why),
        None => Comparison::new(functional, &own, nonnegative).verdict(),
    }
}

/// The verdicts on all branches in one: true on some only, it is true where these are.
fn on_branches(all: &[Branch]) -> Verdict {
    let decided = all
        .iter()
        .map(|branch| on_branch(&branch.functional, &branch.nonnegative));
    let mut proved: Vec<(&str, Proof)> = Vec::new();
    let mut refuted: Option<Verdict> = None;
    let mut open: Option<Verdict> = None;
    for (branch, verdict) in all.iter().zip(decided) {
        match verdict {
            Verdict::Proved(proof) => proved.push((&branch.words, proof)),
            Verdict::Refuted(_) if refuted.is_none() => {
                refuted = Some(verdict.prefixed(&format!("where {}", branch.words)));
            }
            Verdict::Refuted(_) => {}
            other if open.is_none() => {
                open = Some(other.prefixed(&format!("where {}", branch.words)));
            }
            _ => {}
        }
    }
    let Some((words, mut proof)) = proved.first().cloned() else {
        return refuted
            .or(open)
            .unwrap_or_else(|| Verdict::undecided("there are no branches"));
    };
    match (refuted, open) {
        (None, Some(open)) => open,
        (Some(refuted), Some(_)) => refuted,
        (None, None) => {
            let joined = proved.into_iter().map(|(_, proof)| Verdict::Proved(proof));
            joined.fold(Verdict::Proved(proof), Verdict::and)
        }
        (Some(Verdict::Refuted(counterexample)), None) => {
            let each = proved.iter().map(|(words, _)| format!("({words})"));
            let condition = match &proved[..] {
                [_] => words.to_owned(),
                _ => each.collect::<Vec<_>>().join(" or "),
            };
            proof.detail = format!(
                "where {condition} {}; elsewhere not: {}",
                proof.detail, counterexample.detail
            );
            Verdict::Conditional {
                condition,
                proof,
                counterexample: Some(counterexample),
            }
        }
        (Some(other), None) => other,
    }
}

struct Comparison<'f> {
    functional: &'f Functional,
    variation: &'f Variation,
    /// What holds because it is imposed or derived.
    derived: Solved<'f>,
    /// What holds because it is imposed or stated.
    stated: Solved<'f>,
    /// What was divided by and has no value.
    nonzero: RefCell<BTreeSet<String>>,
}

/// An equation that was compared.
struct Judged {
    what: String,
    verdict: Verdict,
    /// What could not be solved for.
    open: Vec<String>,
    /// What was solved for where a coefficient does not vanish.
    pivots: Vec<String>,
}

impl<'f> Comparison<'f> {
    /// Where some expressions are known not to be negative.
    fn new(
        functional: &'f Functional,
        variation: &'f Variation,
        nonnegative: &[Expr],
    ) -> Comparison<'f> {
        let space = &*functional.space;
        let inside = |role: Role| groups(functional, role, None);
        let imposed = Solved::new(space).where_nonnegative(nonnegative);
        let imposed = imposed.with(&inside(Role::Imposed));
        Comparison {
            functional,
            variation,
            derived: imposed.with(&euler_groups(functional, variation)),
            stated: imposed.with(&inside(Role::Yielded)),
            nonzero: RefCell::default(),
        }
    }

    fn verdict(&self) -> Verdict {
        let mut judged = Vec::new();
        let mut pivots: BTreeSet<String> = BTreeSet::new();
        let mut inverted: BTreeSet<String> = BTreeSet::new();
        for equation in self
            .functional
            .with_role(Role::Yielded)
            .filter(|e| e.on.is_none())
        {
            judged.push(self.equation(equation, &self.derived));
        }
        for &(component, value) in &self.variation.euler {
            let name = self.functional.space.component_at(component).name;
            judged.push(self.judge(
                format!("the Euler equation of {name}"),
                &[value],
                &self.stated,
            ));
        }
        let mut notes = |solved: &Solved<'_>| {
            pivots.extend(solved.pivots.iter().cloned());
            inverted.extend(solved.inverted.iter().cloned());
        };
        notes(&self.derived);
        notes(&self.stated);
        for on in &self.variation.pieces {
            let (derived, stated) = self.piece(on, &mut judged);
            notes(&derived);
            notes(&stated);
        }
        self.edges(&mut judged);
        self.corners(&mut judged);
        where_nonzero(
            self.joined(judged, &pivots, &inverted),
            &self.nonzero.borrow(),
        )
    }

    /// Where two faces meet: the conditions there, both ways.
    fn corners(&self, judged: &mut Vec<Judged>) {
        let functional = self.functional;
        let stated = functional
            .with_role(Role::Yielded)
            .filter_map(|e| e.on.as_deref());
        let derived = self
            .variation
            .corners
            .iter()
            .map(|c| format!("{}, {}", c.pieces.0, c.pieces.1));
        let mut places: Vec<(String, String)> = Vec::new();
        for place in stated.map(str::to_owned).chain(derived) {
            let Some((one, other)) = functional.meeting(&place) else {
                continue;
            };
            let pair = (one.name.clone(), other.name.clone());
            let swapped = (pair.1.clone(), pair.0.clone());
            if !places.contains(&pair) && !places.contains(&swapped) {
                places.push(pair);
            }
        }
        for pair in places {
            self.corner(&pair, judged);
        }
    }

    fn corner(&self, pair: &(String, String), judged: &mut Vec<Judged>) {
        let functional = self.functional;
        let is_here = |on: &str| {
            functional.meeting(on).is_some_and(|(a, b)| {
                (a.name == pair.0 && b.name == pair.1) || (a.name == pair.1 && b.name == pair.0)
            })
        };
        let here: Vec<&crate::variation::Corner> = self
            .variation
            .corners
            .iter()
            .filter(|c| is_here(&format!("{}, {}", c.pieces.0, c.pieces.1)))
            .collect();
        let equations: Vec<&Equation> = functional
            .with_role(Role::Yielded)
            .filter(|e| e.on.as_deref().is_some_and(is_here))
            .collect();
        let (mut derived, mut stated) = (self.derived.clone(), self.stated.clone());
        for name in [&pair.0, &pair.1] {
            let (Some(piece), Some(on)) = (
                functional.piece(name),
                self.variation.pieces.iter().find(|p| p.piece == *name),
            ) else {
                continue;
            };
            let name = Some(name.as_str());
            let imposed = groups(functional, Role::Imposed, name);
            derived = derived
                .with_on(&piece.side, &imposed)
                .with(&condition_groups(functional, on, &on.conditions));
            stated = stated.with_on(&piece.side, &imposed).with(&groups(
                functional,
                Role::Yielded,
                name,
            ));
        }
        // At a corner nothing may be differentiated.
        let conditions: Vec<Group> = here
            .iter()
            .map(|c| Group {
                label: "corner".into(),
                equations: vec![c.value],
            })
            .collect();
        let own: Vec<Group> = equations
            .iter()
            .map(|e| Group {
                label: e.label.clone(),
                equations: e.residuals.clone(),
            })
            .collect();
        derived = derived.with_at_corner(&conditions);
        stated = stated.with_at_corner(&own);
        for equation in equations {
            judged.push(self.equation(equation, &derived));
        }
        for corner in here {
            let name = functional.space.component_at(corner.component).name;
            let what = format!(
                "the condition of {name} where {} and {} meet",
                pair.0, pair.1
            );
            judged.push(self.judge(what, &[corner.value], &stated));
        }
    }

    /// Where two curved pieces meet, what acts along them at the edge has to cancel.
    fn edges(&self, judged: &mut Vec<Judged>) {
        let functional = self.functional;
        let pieces = &self.variation.pieces;
        for (at, one) in pieces.iter().enumerate() {
            for other in &pieces[at + 1..] {
                let components: BTreeSet<usize> = one
                    .slopes
                    .iter()
                    .chain(&other.slopes)
                    .map(|(c, _)| *c)
                    .collect();
                if components.is_empty() || functional.space.dimensions() == 1 {
                    continue;
                }
                let mut stated = self.stated.clone();
                for piece in [one, other] {
                    let name = Some(piece.piece.as_str());
                    if let Some(own) = functional.piece(&piece.piece) {
                        stated = stated
                            .with_on(&own.side, &groups(functional, Role::Imposed, name))
                            .with(&groups(functional, Role::Yielded, name));
                    }
                }
                for component in components {
                    let name = functional.space.component_at(component).name;
                    let what = format!(
                        "the condition of {name} where {} and {} meet",
                        one.piece, other.piece
                    );
                    let difference = edge(functional, one, other, component);
                    judged.push(self.judge(what, &along(functional, &difference), &stated));
                }
            }
        }
    }

    fn equation(&self, equation: &Equation, where_holds: &Solved<'f>) -> Judged {
        let what = format!("the stated equation ({})", equation.label);
        self.judge(what, &equation.residuals, where_holds)
    }

    fn judge(&self, what: String, es: &[Expr], solved: &Solved<'f>) -> Judged {
        let divided = solved.nonzero.iter().cloned();
        self.nonzero.borrow_mut().extend(divided);
        let whole = of_all(es, solved);
        let is_proved = matches!(whole, Verdict::Proved(_));
        let cases = if solved.left.is_empty() || is_proved {
            Vec::new()
        } else {
            solved.alternatives()
        };
        if cases.len() < 2 {
            let labels = solved.left.iter().filter(|_| !solved.is_circular());
            return Judged {
                what,
                verdict: whole,
                open: labels.map(|group| format!("`{}`", group.label)).collect(),
                pivots: Vec::new(),
            };
        }
        let mut all = Verdict::Proved(Proof::exact("", ""));
        let mut open = Vec::new();
        let mut pivots = Vec::new();
        for case in cases {
            let divided = case.nonzero.iter().cloned();
            self.nonzero.borrow_mut().extend(divided);
            let verdict = of_all(es, &case);
            let labels = case.left.iter().filter(|_| !case.is_circular());
            let labels: Vec<String> = labels.map(|group| format!("`{}`", group.label)).collect();
            // One case in which it is false is enough, whatever is open about others.
            if let (Verdict::Refuted(_), true) = (&verdict, labels.is_empty()) {
                all = verdict;
                open.clear();
                break;
            }
            all = all.and(verdict);
            open.extend(labels);
            pivots.extend(case.pivots.iter().cloned());
        }
        Judged {
            what,
            verdict: all,
            open,
            pivots,
        }
    }

    /// Both directions on a piece of the boundary.
    fn piece(&self, on: &OnPiece, judged: &mut Vec<Judged>) -> (Solved<'f>, Solved<'f>) {
        let functional = self.functional;
        let name = Some(on.piece.as_str());
        let imposed = groups(functional, Role::Imposed, name);
        let Some(piece) = functional.piece(&on.piece) else {
            return (self.derived.clone(), self.stated.clone());
        };
        let derived = self
            .derived
            .with_on(&piece.side, &imposed)
            .with(&condition_groups(functional, on, &on.conditions));
        let stated = self.stated.with_on(&piece.side, &imposed).with(&groups(
            functional,
            Role::Yielded,
            name,
        ));
        for equation in functional
            .with_role(Role::Yielded)
            .filter(|e| e.on.as_deref() == name)
        {
            judged.push(self.equation(equation, &derived));
        }
        for condition in &on.conditions {
            let component = functional.space.component_at(condition.component).name;
            let what = format!("the natural condition of {component} on {}", on.piece);
            judged.push(self.judge(what, &[condition.value], &stated));
        }
        (derived, stated)
    }

    fn joined(
        &self,
        judged: Vec<Judged>,
        pivots: &BTreeSet<String>,
        inverted: &BTreeSet<String>,
    ) -> Verdict {
        let mut all = Verdict::Proved(Proof::exact("", ""));
        // One equation that fails is enough, whatever is open about others.
        for own in &judged {
            if let (Verdict::Refuted(found), true) = (&own.verdict, own.open.is_empty()) {
                return refuted(&own.what, found.clone());
            }
        }
        let mut pivots = pivots.clone();
        for own in judged {
            match own.verdict {
                Verdict::Proved(proof) => {
                    pivots.extend(own.pivots);
                    all = all.and(Verdict::Proved(proof));
                }
                other => {
                    let why = if !own.open.is_empty() {
                        format!(
                            "{} could not be solved for any field",
                            own.open.join(" and ")
                        )
                    } else {
                        other.detail().to_owned()
                    };
                    let unused = self.unrelated();
                    return Verdict::undecided(format!(
                        "{} was not compared: {why}{unused}",
                        own.what
                    ));
                }
            }
        }
        let Verdict::Proved(mut proof) = all else {
            return all;
        };
        if self.is_contradictory() {
            return Verdict::not_applicable(
                "functional.euler",
                "no field makes the functional stationary, and none satisfies what is stated",
            );
        }
        proof.on = on(&pivots, inverted);
        if self
            .variation
            .pieces
            .iter()
            .filter(|p| !p.slopes.is_empty())
            .count()
            > 1
        {
            proof
                .on
                .push_str("; curved pieces meet with a common tangent plane");
        }
        proof.detail = self.detail();
        for more in self.traces().into_iter().chain(self.undetermined()) {
            proof.detail.push_str(&format!(", {more}"));
        }
        Verdict::Proved(proof)
    }

    /// Whether the Euler equations and natural conditions contradict each other, so that there is nothing to compare.
    fn is_contradictory(&self) -> bool {
        let is_so = |on: &OnPiece| {
            let functional = self.functional;
            let Some(piece) = functional.piece(&on.piece) else {
                return false;
            };
            let imposed = groups(functional, Role::Imposed, Some(&on.piece));
            let here = self.derived.with_on(&piece.side, &imposed);
            let here = here.with(&condition_groups(functional, on, &on.conditions));
            here.contradiction().is_some()
        };
        self.derived.contradiction().is_some() || self.variation.pieces.iter().any(is_so)
    }

    /// Functions stated as conjugates whose formulas are not proved to be so: no gradient of them was undone.
    fn unrelated(&self) -> String {
        let functional = self.functional;
        let space = &*functional.space;
        let is_unrelated =
            |f: &&Constitutive| f.conjugate.is_some() && space.undoing(f.function).is_none();
        let own = functional.functions.iter().filter(is_unrelated);
        let names: Vec<&str> = own.map(|f| f.name.as_str()).collect();
        if names.is_empty() {
            return String::new();
        }
        format!(
            "; that {} are Legendre conjugates is not proved (functional.legendre), so that it was not used",
            names.join(" and ")
        )
    }

    /// Fields without derivatives of which the Euler equations leave components free.
    fn undetermined(&self) -> Vec<String> {
        let functional = self.functional;
        let jets = functional.space.jets_in(&[functional.density]);
        let is_algebraic = |components: &[usize]| {
            let mut own = jets
                .iter()
                .filter(|jet| components.contains(&jet.component));
            own.all(|jet| jet.by.is_empty())
        };
        let algebraic = functional
            .interior()
            .filter(|f| is_algebraic(&f.components));
        let euler = self.variation.euler.iter().map(|(_, value)| *value);
        let imposed = functional
            .with_role(Role::Imposed)
            .filter(|e| e.on.is_none())
            .flat_map(|e| e.residuals.iter().copied());
        let equations: Vec<Expr> = euler.chain(imposed).collect();
        let found = algebraic.filter_map(|field| {
            let free = self
                .derived
                .free_components(&field.components, &equations)?;
            (free > 0).then(|| {
                let all = field.components.len();
                format!(
                    "while {} is not determined: {free} of its {all} components are left free",
                    field.name
                )
            })
        });
        found.collect()
    }

    /// On which pieces the conditions are the stated ones only with traces of equations that hold inside: the fewest are named.
    fn traces(&self) -> Vec<String> {
        let mut found: Vec<(String, Vec<String>)> = Vec::new();
        for on in &self.variation.pieces {
            if let Some(needed) = self.trace_on(on).filter(|needed| !needed.is_empty()) {
                let needed = labels(&needed);
                match found.iter_mut().find(|(own, _)| *own == needed) {
                    Some((_, pieces)) => pieces.push(on.piece.clone()),
                    None => found.push((needed, vec![on.piece.clone()])),
                }
            }
        }
        let told = |(needed, pieces): (String, Vec<String>)| {
            format!("on {} with the trace of {needed}", pieces.join(" and "))
        };
        found.into_iter().map(told).collect()
    }

    fn trace_on(&self, on: &OnPiece) -> Option<Vec<String>> {
        let functional = self.functional;
        let inside: Vec<Group> = functional
            .with_role(Role::Yielded)
            .filter(|e| e.on.is_none())
            .map(|e| Group {
                label: e.label.clone(),
                equations: e.residuals.clone(),
            })
            .collect();
        let imposed = Solved::new(&functional.space).with(&groups(functional, Role::Imposed, None));
        let found = subsets(inside.len()).into_iter().find(|chosen| {
            let own: Vec<Group> = chosen.iter().map(|&i| inside[i].clone()).collect();
            self.holds_on(on, &imposed.with(&own))
        })?;
        Some(found.iter().map(|&i| inside[i].label.clone()).collect())
    }

    /// Whether the conditions on a piece are the stated ones where `inside` holds.
    fn holds_on(&self, on: &OnPiece, inside: &Solved<'f>) -> bool {
        let functional = self.functional;
        let name = Some(on.piece.as_str());
        let Some(piece) = functional.piece(&on.piece) else {
            return false;
        };
        let here = inside.with_on(&piece.side, &groups(functional, Role::Imposed, name));
        let stated = here.with(&groups(functional, Role::Yielded, name));
        let mut conditions = on.conditions.iter();
        if !conditions.all(|condition| stated.follows(&[condition.value])) {
            return false;
        }
        let derived = here.with(&condition_groups(functional, on, &on.conditions));
        let mut equations = functional
            .with_role(Role::Yielded)
            .filter(|e| e.on.as_deref() == name);
        equations.all(|equation| derived.follows(&equation.residuals))
    }

    fn detail(&self) -> String {
        let functional = self.functional;
        let label = |role: Role| -> Vec<String> {
            functional
                .with_role(role)
                .map(|e| e.label.clone())
                .collect()
        };
        let (imposed, yielded) = (label(Role::Imposed), label(Role::Yielded));
        let mut detail = format!(
            "the Euler equations and natural conditions are equivalent to {}",
            labels(&yielded)
        );
        if !imposed.is_empty() {
            detail.push_str(&format!(", where {} hold beforehand", labels(&imposed)));
        }
        let multipliers: Vec<String> = functional
            .equations
            .iter()
            .filter(|e| e.role == Role::Imposed)
            .filter_map(|e| Some(format!("{} of ({})", e.multiplier.as_ref()?.0, e.label)))
            .collect();
        if !multipliers.is_empty() {
            detail.push_str(&format!(
                ", with the multipliers {}",
                multipliers.join(", ")
            ));
        }
        detail
    }
}

/// The verdict on several expressions where equations hold.
fn of_all(es: &[Expr], solved: &Solved<'_>) -> Verdict {
    let mut verdict = Verdict::Proved(Proof::exact("", ""));
    for &e in es {
        let own = solved.verdict(e);
        let is_proved = matches!(own, Verdict::Proved(_));
        verdict = verdict.and(own);
        if !is_proved {
            break;
        }
    }
    verdict
}

fn refuted(what: &str, found: Counterexample) -> Verdict {
    let (lower, upper) = &found.residual;
    let size = if lower == upper {
        format!("is {lower}")
    } else {
        format!("lies between {lower} and {upper}")
    };
    Verdict::Refuted(Counterexample {
        detail: format!(
            "{what} does not hold where the other system does: its residual {size} at the jet stated"
        ),
        quantity: what.to_owned(),
        ..found
    })
}

/// Where the densities can be differentiated and the stated equations are defined: roots, logarithms and denominators say it.
fn where_defined(functional: &Functional) -> String {
    let stated = functional.equations.iter();
    let stated = stated.filter(|e| e.role != Role::Other);
    let stated: Vec<Expr> = stated.flat_map(|e| e.residuals.iter().copied()).collect();
    let mut densities: Vec<Expr> = vec![functional.density];
    densities.extend(functional.pieces.iter().map(|piece| piece.density));
    let mut all = conditions(functional, &densities, Need::Slope);
    all.extend(conditions(functional, &stated, Need::Value));
    if all.is_empty() {
        return String::new();
    }
    let all: Vec<String> = all.into_iter().collect();
    format!(", where {}", all.join(", "))
}

/// What an expression is needed for.
#[derive(Clone, Copy, PartialEq)]
enum Need {
    /// It has to have a value.
    Value,
    /// It has to have derivatives.
    Slope,
}

/// Conditions under which expressions have values, or derivatives.
fn conditions(functional: &Functional, es: &[Expr], need: Need) -> BTreeSet<String> {
    let g = &functional.space.graph;
    let is_smooth = need == Need::Slope;
    let condition = |e: Expr| {
        let (inner, relation) = match g.node(e) {
            Node::Power { base, exponent } => {
                let number = g.as_number(*exponent);
                let is_whole = number.and_then(rational::to_i64).is_some();
                let is_negative = number.is_some_and(rational::is_negative);
                let is_even_root =
                    number.is_none_or(|n| n.denominator().trailing_zeros() != Some(0));
                match (is_whole, is_even_root) {
                    (true, _) if is_negative => (*base, "!="),
                    (true, _) => return None,
                    (false, true) if is_smooth || is_negative => (*base, ">"),
                    (false, true) => (*base, ">="),
                    (false, false) if is_smooth || is_negative => (*base, "!="),
                    (false, false) => return None,
                }
            }
            Node::Apply {
                function,
                arguments,
            } => match function {
                Function::Log => (*arguments.first()?, ">"),
                Function::Abs if is_smooth => (*arguments.first()?, "!="),
                _ => return None,
            },
            _ => return None,
        };
        let sign = known_sign(g, inner, &Assumptions::new());
        let is_known = match relation {
            ">" => sign.is_positive(),
            ">=" => sign.is_nonnegative(),
            _ => sign.is_nonzero(),
        };
        let has_jets = !functional.space.jets_in(&[inner]).is_empty();
        (has_jets && !is_known).then(|| format!("{} {relation} 0", g.text(inner)))
    };
    g.reachable(es).into_iter().filter_map(condition).collect()
}

/// A proof that divides by something without a value holds where that does not vanish.
fn where_nonzero(verdict: Verdict, nonzero: &BTreeSet<String>) -> Verdict {
    match verdict {
        Verdict::Proved(mut proof) if !nonzero.is_empty() => {
            let all: Vec<String> = nonzero.iter().map(|e| format!("{e} ≠ 0")).collect();
            let said = format!(", where {}", all.join(" and "));
            proof.on.push_str(&said);
            proof.detail.push_str(&said);
            Verdict::Proved(proof)
        }
        other => other,
    }
}

/// Where a proof holds.
fn on(pivots: &BTreeSet<String>, inverted: &BTreeSet<String>) -> String {
    let mut place = String::from("all jets");
    if !pivots.is_empty() {
        let names: Vec<&str> = pivots.iter().map(String::as_str).collect();
        place.push_str(&format!(
            " at which the equations can be solved for {}, whose coefficients depend on the fields, the normal or parameters",
            names.join(", ")
        ));
    }
    if !inverted.is_empty() {
        let names: Vec<&str> = inverted.iter().map(String::as_str).collect();
        place.push_str(&format!(
            ", assuming that the gradient of {} is undone by that of its Legendre conjugate",
            names.join(" and of ")
        ));
    }
    place
}

/// The difference of the coefficients of the gradient of a component on two pieces.
fn edge(functional: &Functional, one: &OnPiece, other: &OnPiece, component: usize) -> Vec<Expr> {
    let g = &functional.space.graph;
    let of = |on: &OnPiece| {
        on.slopes
            .iter()
            .find(|(c, _)| *c == component)
            .map(|(_, q)| q.clone())
    };
    let zeros = vec![g.zero(); functional.space.dimensions()];
    let (a, b) = (
        of(one).unwrap_or_else(|| zeros.clone()),
        of(other).unwrap_or(zeros),
    );
    a.iter().zip(&b).map(|(&a, &b)| g.sub(a, b)).collect()
}

/// The part of the coefficient of a gradient along a curved piece: at its edges it has to vanish.
fn along(functional: &Functional, q: &[Expr]) -> Vec<Expr> {
    let g = &functional.space.graph;
    let normal = functional.space.normal();
    if normal.len() == 1 {
        return Vec::new();
    }
    let through: Vec<Expr> = normal
        .iter()
        .zip(q)
        .map(|(&n, &q)| g.mul(&[n, q]))
        .collect();
    let through = g.add(&through);
    let own = normal.iter().zip(q);
    own.map(|(&n, &q)| g.sub(q, g.mul(&[n, through]))).collect()
}

fn groups(functional: &Functional, role: Role, on: Option<&str>) -> Vec<Group> {
    functional
        .with_role(role)
        .filter(|e| e.on.as_deref() == on)
        .map(|e| Group {
            label: format!("({})", e.label),
            equations: e.residuals.clone(),
        })
        .collect()
}

/// The Euler equations, those of one field together.
fn euler_groups(functional: &Functional, variation: &Variation) -> Vec<Group> {
    let own = functional.interior().map(|field| Group {
        label: field.name.clone(),
        equations: variation
            .euler
            .iter()
            .filter(|(component, _)| field.components.contains(component))
            .map(|(_, value)| *value)
            .collect(),
    });
    own.collect()
}

fn condition_groups(functional: &Functional, on: &OnPiece, conditions: &[Condition]) -> Vec<Group> {
    let mut found: Vec<Group> = Vec::new();
    for condition in conditions {
        let tensor = functional.space.component_at(condition.component).tensor;
        let label = format!("{tensor} on {} {:?}", on.piece, condition.trace);
        match found.iter_mut().find(|group| group.label == label) {
            Some(group) => group.equations.push(condition.value),
            None => found.push(Group {
                label,
                equations: vec![condition.value],
            }),
        }
    }
    found
}
