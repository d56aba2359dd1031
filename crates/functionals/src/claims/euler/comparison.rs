//! The comparison of what follows from the first variation with what is stated, both ways: in the interior, on every piece of the boundary,
//! and where pieces meet.

use super::squares;
use crate::elimination::{Entries, Group, Pivot, Solved};
use crate::functional::{Equation, Functional, Piece, Role, Side};
use crate::variation::{acting_at_edge, at_edge, Condition, Corner, OnPiece, Trace, Variation};
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Verdict};
use std::cell::{Cell, OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

/// Which of the two systems that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum System {
    /// What is imposed, and what follows from the first variation.
    Derived,
    /// What is imposed, and what is stated.
    Stated,
}

/// The two systems, solved.
pub(super) struct Comparison<'f> {
    pub(super) functional: &'f Functional,
    pub(super) variation: &'f Variation,
    pub(super) planes: &'f [Plane],
    /// What holds because it is imposed or derived.
    pub(super) derived: Solved<'f>,
    /// What holds because it is imposed.
    imposed: Solved<'f>,
    /// What holds because it is imposed or stated, once it was asked for.
    stated: OnceCell<Solved<'f>>,
    /// What is derived on pieces, by name.
    on_pieces: RefCell<BTreeMap<String, Solved<'f>>>,
    /// What was divided by and has no value.
    pub(super) nonzero: RefCell<BTreeSet<Expr>>,
    /// Whether a counterexample is looked for.
    pub(super) refutes: bool,
    /// Whether the conditions where two faces meet contradict each other.
    contradicts_at_corner: Cell<bool>,
    /// Whether what is stated where these meet never holds either.
    states_nothing: Cell<bool>,
    /// Whether jets of a system are those of solutions, as far as that was asked.
    pub(super) extended: RefCell<BTreeMap<System, bool>>,
}

/// A functional with one plane piece of boundary, and its first variation.
pub(super) struct Plane {
    pub(super) functional: Functional,
    pub(super) variation: Variation,
}

/// What holds on a piece of the boundary.
pub(super) type AtEnd<'a, 'f> = dyn Fn(&OnPiece, &Piece) -> Solved<'f> + 'a;

/// An equation that was compared.
pub(super) struct Judged {
    pub(super) what: String,
    pub(super) verdict: Verdict,
    /// What could not be solved for.
    pub(super) open: Vec<String>,
    /// What was solved for where a coefficient does not vanish.
    pub(super) pivots: Vec<Pivot>,
}

impl<'f> Comparison<'f> {
    /// Where some expressions are known not to be negative at the place that is looked at.
    pub(super) fn new(
        functional: &'f Functional,
        variation: &'f Variation,
        planes: &'f [Plane],
        nonnegative: &[Expr],
    ) -> Comparison<'f> {
        let space = &*functional.space;
        let inside = |role: Role| groups(functional, role, None);
        let imposed = Solved::new(space).where_nonnegative(nonnegative);
        let imposed = imposed.with(&inside(Role::Imposed));
        let mut derived = euler_groups(functional, variation);
        derived.extend(squares::inside(functional));
        Comparison {
            functional,
            variation,
            planes,
            derived: imposed.with(&derived),
            imposed,
            stated: OnceCell::new(),
            on_pieces: RefCell::default(),
            nonzero: RefCell::default(),
            refutes: true,
            contradicts_at_corner: Cell::new(false),
            states_nothing: Cell::new(false),
            extended: RefCell::default(),
        }
    }

    /// What holds because it is imposed or stated. Where a stated equation does not follow nobody asks.
    pub(super) fn stated(&self) -> &Solved<'f> {
        let groups = || groups(self.functional, Role::Yielded, None);
        self.stated.get_or_init(|| self.imposed.with(&groups()))
    }

    /// The comparison of another functional with the same interior.
    pub(super) fn of_another(
        &self,
        functional: &'f Functional,
        variation: &'f Variation,
    ) -> Comparison<'f> {
        Comparison {
            functional,
            variation,
            planes: &[],
            derived: self.derived.clone(),
            imposed: self.imposed.clone(),
            stated: self.stated.clone(),
            on_pieces: RefCell::default(),
            nonzero: RefCell::default(),
            refutes: self.refutes,
            contradicts_at_corner: Cell::new(false),
            states_nothing: Cell::new(false),
            extended: RefCell::default(),
        }
    }

    /// The verdict where all that is divided by does not vanish.
    pub(super) fn compared(&self) -> Verdict {
        let mut judged = Vec::new();
        let mut pivots: BTreeSet<Pivot> = BTreeSet::new();
        let mut inverted: BTreeSet<String> = BTreeSet::new();
        // One equation that fails is enough, whatever else is to be said.
        if let Some(refuted) = self.refuted_inside(&mut judged) {
            return refuted;
        }
        let stated = self.residuals(None);
        for &(component, value) in &self.variation.euler {
            let name = self.functional.space.component_at(component).name;
            let what = format!("the Euler equation of {name}");
            let own = self.judge(what, &[value], self.stated(), &stated);
            judged.push(self.as_whole(own, &[value], System::Stated, None));
        }
        let mut notes = |solved: &Solved<'_>| {
            pivots.extend(solved.pivots.iter().cloned());
            inverted.extend(solved.inverted.iter().cloned());
        };
        notes(&self.derived);
        notes(self.stated());
        for on in &self.variation.pieces {
            let (derived, stated) = self.piece(on, &mut judged);
            notes(&derived);
            notes(&stated);
        }
        self.edges(&mut judged);
        self.corners(&mut judged);
        self.joined(judged, &pivots, &inverted)
    }

    /// That an equation stated inside does not follow there; they are judged.
    pub(super) fn refuted_inside(&self, judged: &mut Vec<Judged>) -> Option<Verdict> {
        let euler: Vec<Expr> = self.variation.euler.iter().map(|(_, e)| *e).collect();
        let stated = self.functional.with_role(Role::Yielded);
        for equation in stated.filter(|e| e.on.is_none()) {
            judged.push(self.equation(equation, &self.derived, &euler));
        }
        refutation(judged)
    }

    /// Where two faces meet: the conditions there, both ways.
    fn corners(&self, judged: &mut Vec<Judged>) {
        let functional = self.functional;
        let stated = functional
            .with_role(Role::Yielded)
            .filter_map(|e| e.on.as_deref());
        let derived = self.variation.corners.iter().map(Corner::place);
        let mut places: Vec<Vec<&Piece>> = Vec::new();
        for place in stated.map(str::to_owned).chain(derived) {
            let own = functional.meeting(&place);
            if let Some(own) = own.filter(|own| !places.iter().any(|known| are_same(known, own))) {
                places.push(own);
            }
        }
        for place in places {
            self.corner(&place, judged);
        }
    }

    /// The conditions where faces meet: those of this place are judged, and those of the faces and of the edges that end there hold too.
    fn corner(&self, place: &[&Piece], judged: &mut Vec<Judged>) {
        let functional = self.functional;
        let is_here = |on: &str| {
            let own = functional.meeting(on);
            own.is_some_and(|own| are_same(&own, place))
        };
        let holds_here = |on: &str| {
            let own = functional.meeting(on);
            own.is_some_and(|own| own.iter().all(|one| is_among(one, place)))
        };
        let corners = self.variation.corners.iter();
        let (here, ending): (Vec<&Corner>, Vec<&Corner>) = corners
            .filter(|c| holds_here(&c.place()))
            .partition(|c| is_here(&c.place()));
        let (mut derived, mut stated) = (self.derived.clone(), self.stated().clone());
        for piece in place {
            let mut known = self.variation.pieces.iter();
            let Some(on) = known.find(|own| own.piece == piece.name) else {
                continue;
            };
            let name = Some(piece.name.as_str());
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
        let conditions: Vec<Group> = here
            .iter()
            .chain(&ending)
            .map(|c| Group {
                label: "corner".into(),
                equations: vec![c.value],
            })
            .collect();
        let groups_of = |role: Role| -> Vec<Group> {
            let own = functional.with_role(role);
            let own = own.filter(|e| e.on.as_deref().is_some_and(holds_here));
            let all = own.map(|e| Group {
                label: e.label.clone(),
                equations: e.residuals.clone(),
            });
            all.collect()
        };
        let imposed = groups_of(Role::Imposed);
        let equations = functional.with_role(Role::Yielded);
        let equations: Vec<&Equation> = equations
            .filter(|e| e.on.as_deref().is_some_and(is_here))
            .collect();
        derived = derived.with_where_meeting(&[imposed.clone(), conditions].concat());
        stated = stated.with_where_meeting(&[imposed, groups_of(Role::Yielded)].concat());
        let values: Vec<Expr> = here.iter().map(|corner| corner.value).collect();
        let residuals = equations.iter().flat_map(|e| e.residuals.clone());
        let residuals: Vec<Expr> = residuals.collect();
        if self.never_hold(&values) || derived.contradiction().is_some() {
            self.contradicts_at_corner.set(true);
            if self.never_hold(&residuals) {
                self.states_nothing.set(true);
            }
        }
        for equation in equations {
            judged.push(self.equation(equation, &derived, &values));
        }
        for corner in here {
            let name = functional.space.component_at(corner.component).name;
            let (one, other) = &corner.pieces;
            let what = format!("the condition of {name} where {one} and {other} meet");
            let own = self.judge(what, &[corner.value], &stated, &residuals);
            let on = corner.place();
            judged.push(self.as_whole(own, &[corner.value], System::Stated, Some(&on)));
        }
    }

    /// Whether one of these is a number that is not zero, whatever the fields are.
    fn never_hold(&self, es: &[Expr]) -> bool {
        let space = &*self.functional.space;
        let mut all = es.iter();
        all.any(|&e| space.jets_in(&[e]).is_empty() && space.sign(e).is_nonzero())
    }

    /// Where two curved pieces meet, what acts along them at the edge has to cancel.
    fn edges(&self, judged: &mut Vec<Judged>) {
        let functional = self.functional;
        let pieces = &self.variation.pieces;
        for (at, one) in pieces.iter().enumerate() {
            for other in &pieces[at + 1..] {
                // What is given on one of them is not varied where they meet.
                let mut components = acting_at_edge(one, other);
                components.retain(|&component| {
                    ![one, other].iter().any(|on| self.is_given(on, component))
                });
                if components.is_empty() || functional.space.dimensions() == 1 {
                    continue;
                }
                let mut stated = self.stated().clone();
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
                    let own = at_edge(functional, one, other, component);
                    let found = self.judge(what, &own, &stated, &[]);
                    let on = format!("{}, {}", one.piece, other.piece);
                    judged.push(self.as_whole(found, &own, System::Stated, Some(&on)));
                }
            }
        }
    }

    fn is_given(&self, on: &OnPiece, component: usize) -> bool {
        let piece = self.functional.piece(&on.piece);
        piece.is_some_and(|own| own.fixed.contains(&(component, false)))
    }

    fn equation(&self, equation: &Equation, where_holds: &Solved<'f>, derived: &[Expr]) -> Judged {
        let what = format!("the stated equation ({})", equation.label);
        let own = self.judge(what, &equation.residuals, where_holds, derived);
        self.as_whole(
            own,
            &equation.residuals,
            System::Derived,
            equation.on.as_deref(),
        )
    }

    /// What was refuted at one place, where the system is taken as a whole: the jet has to be that of a solution, and what the system carries
    /// along follows.
    fn as_whole(&self, own: Judged, es: &[Expr], system: System, on: Option<&str>) -> Judged {
        let is_refuted = matches!(own.verdict, Verdict::Refuted(_));
        if !is_refuted || self.extends(es, system, on) {
            return own;
        }
        let carried = match system {
            System::Derived => {
                let at_end: &AtEnd<'_, 'f> = &|on, piece| self.derived_on(on, piece);
                self.is_carried(es, &self.derived, at_end, on)
            }
            System::Stated => {
                let at_end: &AtEnd<'_, 'f> = &|on, piece| self.stated_on(on, piece);
                self.is_carried(es, self.stated(), at_end, on)
            }
        };
        let (verdict, open) = if carried {
            (Verdict::Proved(Proof::exact("", "")), Vec::new())
        } else {
            (Verdict::undecided(NOT_AS_WHOLE), own.open)
        };
        Judged {
            verdict,
            open,
            ..own
        }
    }

    /// Keeps what a system was divided by.
    pub(super) fn divided_by(&self, solved: &Solved<'f>) {
        let divided = solved.nonzero.iter().cloned();
        self.nonzero.borrow_mut().extend(divided);
    }

    /// The verdict on expressions where a system holds, also where something vanishes that was divided by.
    fn judge(&self, what: String, es: &[Expr], solved: &Solved<'f>, equations: &[Expr]) -> Judged {
        let mut own = self.judge_in_general(what, es, solved, equations);
        let is_proved = matches!(own.verdict, Verdict::Proved(_));
        if !is_proved || !self.refutes || self.are_among(es, equations).is_some() {
            return own;
        }
        own.pivots.retain(|pivot| pivot.entries != Entries::Fields);
        match solved.where_singular(es) {
            Ok(open) => own.pivots.extend(open),
            Err(found) => own.verdict = Verdict::Refuted(*found),
        }
        own
    }

    /// The verdict on expressions where a system holds; those that are among its equations as they are need no solution of it.
    fn judge_in_general(
        &self,
        what: String,
        es: &[Expr],
        solved: &Solved<'f>,
        equations: &[Expr],
    ) -> Judged {
        if let Some(verdict) = self.are_among(es, equations) {
            return Judged {
                what,
                verdict,
                open: Vec::new(),
                pivots: Vec::new(),
            };
        }
        self.divided_by(solved);
        let whole = if self.refutes {
            of_all(es, solved)
        } else if solved.follows(es) {
            Verdict::Proved(Proof::exact("", ""))
        } else {
            Verdict::undecided("")
        };
        let is_decided = !self.refutes || matches!(whole, Verdict::Proved(_));
        let cases = (!is_decided).then(|| solved.cases()).flatten();
        let Some(cases) = cases.filter(|all| !all.is_empty()) else {
            let labels = solved.left.iter().filter(|_| !solved.is_circular());
            return Judged {
                what,
                verdict: whole,
                open: labels.map(|group| solved.named(group)).collect(),
                pivots: Vec::new(),
            };
        };
        let mut all = Verdict::Proved(Proof::exact("", ""));
        let mut open = Vec::new();
        let mut pivots = Vec::new();
        for case in cases {
            self.divided_by(&case);
            let verdict = of_all(es, &case);
            let labels = case.left.iter().filter(|_| !case.is_circular());
            let labels: Vec<String> = labels.map(|group| case.named(group)).collect();
            // One case in which it is false is enough, whatever is open about others.
            if let (Verdict::Refuted(_), true) = (&verdict, labels.is_empty()) {
                let g = &self.functional.space.graph;
                let zeros = case.case.iter().map(|&e| format!("{} = 0", g.text(e)));
                let zeros: Vec<String> = zeros.collect();
                all = verdict.prefixed(&format!("where {}", zeros.join(" and ")));
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

    /// That each expression is one of the equations, up to its sign.
    fn are_among(&self, es: &[Expr], equations: &[Expr]) -> Option<Verdict> {
        let space = &*self.functional.space;
        let g = &space.graph;
        let same = |e: Expr, own: Expr| {
            let both = [g.sub(e, own), g.add(&[e, own])];
            let seen = both.into_iter().find(|&own| space.seems_to_vanish(own))?;
            match space.vanishing(&[seen], false) {
                Verdict::Proved(proof) => Some(Verdict::Proved(proof)),
                _ => None,
            }
        };
        es.iter()
            .try_fold(Verdict::Proved(Proof::exact("", "")), |all, &e| {
                let own = equations.iter().find_map(|&own| same(e, own))?;
                Some(all.and(own))
            })
    }

    /// The residuals of stated equations at a place.
    pub(super) fn residuals(&self, on: Option<&str>) -> Vec<Expr> {
        let stated = self.functional.with_role(Role::Yielded);
        let here = stated.filter(|e| e.on.as_deref() == on);
        here.flat_map(|e| e.residuals.clone()).collect()
    }

    /// Both directions on a piece of the boundary.
    pub(super) fn piece(&self, on: &OnPiece, judged: &mut Vec<Judged>) -> (Solved<'f>, Solved<'f>) {
        let functional = self.functional;
        let name = Some(on.piece.as_str());
        let Some(piece) = functional.piece(&on.piece) else {
            return (self.derived.clone(), self.stated().clone());
        };
        let (derived, stated) = (self.derived_on(on, piece), self.stated_on(on, piece));
        let conditions: Vec<Expr> = on.conditions.iter().map(|own| own.value).collect();
        for equation in functional
            .with_role(Role::Yielded)
            .filter(|e| e.on.as_deref() == name)
        {
            judged.push(self.equation(equation, &derived, &conditions));
        }
        let residuals = self.residuals(name);
        for condition in &on.conditions {
            let component = functional.space.component_at(condition.component).name;
            let what = format!("the natural condition of {component} on {}", on.piece);
            let own = self.judge(what, &[condition.value], &stated, &residuals);
            judged.push(self.as_whole(own, &[condition.value], System::Stated, name));
        }
        (derived, stated)
    }

    fn joined(
        &self,
        judged: Vec<Judged>,
        pivots: &BTreeSet<Pivot>,
        inverted: &BTreeSet<String>,
    ) -> Verdict {
        let mut all = Verdict::Proved(Proof::exact("", ""));
        if self.states_nothing.get() {
            return nothing_holds();
        }
        if let Some(refuted) = refutation(&judged) {
            return refuted;
        }
        // Where coefficients made of fields vanish is a case that was looked at.
        let mut pivots = pivots.clone();
        pivots.retain(|pivot| pivot.entries != Entries::Fields);
        for own in judged {
            match own.verdict {
                Verdict::Proved(proof) => {
                    pivots.extend(own.pivots);
                    all = all.and(Verdict::Proved(proof));
                }
                other => {
                    let mut named = BTreeSet::new();
                    let mut open = own.open;
                    open.retain(|one| named.insert(one.clone()));
                    let why = if !open.is_empty() {
                        format!("{} could not be solved for any field", open.join(" and "))
                    } else {
                        other.detail().to_owned()
                    };
                    let unused = self.unrelated();
                    if why == NOT_AS_WHOLE {
                        return Verdict::undecided(format!("{} {why}{unused}", own.what));
                    }
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
            return nothing_holds();
        }
        proof.on = on(&pivots, inverted);
        proof.detail = self.detail();
        if let Some(said) = self.on_smooth_pieces() {
            proof.on.push_str(&format!("; {said}"));
            proof.detail.push_str(&format!(", where {said}"));
        }
        for pivot in &pivots {
            if pivot.entries != Entries::Normal {
                proof.detail.push_str(&pivot.said());
            }
        }
        for more in self.traces().into_iter().chain(self.undetermined()) {
            proof.detail.push_str(&format!(", {more}"));
        }
        Verdict::Proved(proof)
    }

    /// What is taken of curved pieces whose edges matter: of one with derivatives along it, and of two where something is stated at their meeting.
    fn on_smooth_pieces(&self) -> Option<&'static str> {
        let functional = self.functional;
        let is_curved = |own: &&Piece| matches!(own.side, Side::Curved);
        let bent = self
            .variation
            .pieces
            .iter()
            .filter(|own| !own.slopes.is_empty());
        let bent = bent
            .filter_map(|own| functional.piece(&own.piece))
            .filter(is_curved)
            .count();
        let places = functional
            .equations
            .iter()
            .filter_map(|own| functional.meeting(own.on.as_deref()?));
        let meets = places
            .into_iter()
            .any(|own| own.iter().copied().filter(is_curved).count() > 1);
        if functional.space.dimensions() == 1 {
            return None;
        }
        match (bent, meets) {
            (0, false) => None,
            (1, false) => Some("the curved piece is smooth, without corners"),
            _ => Some("curved pieces are smooth and meet with a common tangent plane"),
        }
    }

    /// Whether the Euler equations and natural conditions contradict each other, so that there is nothing to compare.
    fn is_contradictory(&self) -> bool {
        let mut pieces = self.variation.pieces.iter();
        self.derived.contradiction().is_some()
            || self.contradicts_at_corner.get()
            || pieces.any(|on| self.is_contradictory_on(on))
    }

    /// The same on a piece. What contradicts itself there does so where the piece is plane, which is soon seen.
    pub(super) fn is_contradictory_on(&self, on: &OnPiece) -> bool {
        let Some(piece) = self.functional.piece(&on.piece) else {
            return false;
        };
        self.is_contradictory_where_plane(&on.piece) != Some(false)
            && self.derived_on(on, piece).contradiction().is_some()
    }

    /// What holds on a piece because it is imposed or stated.
    pub(super) fn stated_on(&self, on: &OnPiece, piece: &Piece) -> Solved<'f> {
        let name = Some(on.piece.as_str());
        let imposed = groups(self.functional, Role::Imposed, name);
        let here = self.stated().with_on(&piece.side, &imposed);
        here.with(&groups(self.functional, Role::Yielded, name))
    }

    /// What holds on a piece because it is imposed or derived.
    pub(super) fn derived_on(&self, on: &OnPiece, piece: &Piece) -> Solved<'f> {
        if let Some(known) = self.on_pieces.borrow().get(&on.piece) {
            return known.clone();
        }
        let functional = self.functional;
        let imposed = groups(functional, Role::Imposed, Some(&on.piece));
        let here = self.derived.with_on(&piece.side, &imposed);
        let mut conditions = condition_groups(functional, on, &on.conditions);
        conditions.extend(squares::on_piece(functional, piece));
        let own = here.with(&conditions);
        let mut known = self.on_pieces.borrow_mut();
        known.entry(on.piece.clone()).or_insert(own).clone()
    }
}

fn is_among(piece: &Piece, place: &[&Piece]) -> bool {
    place.iter().any(|own| own.name == piece.name)
}

/// Whether these are the same pieces.
fn are_same(one: &[&Piece], other: &[&Piece]) -> bool {
    one.len() == other.len() && one.iter().all(|own| is_among(own, other))
}

/// Why what is refuted at one place is not refuted of the systems.
const NOT_AS_WHOLE: &str = "does not follow from the other system at its place alone, but conditions without data of their own hold for few \
     fields, and together they may enforce it; no polynomials were found that satisfy one system and not the other";

fn nothing_holds() -> Verdict {
    Verdict::not_applicable(
        "functional.euler",
        "no field makes the functional stationary, and none satisfies what is stated",
    )
}

/// The verdict on several expressions where equations hold.
fn of_all(es: &[Expr], solved: &Solved<'_>) -> Verdict {
    let mut verdict = Verdict::Proved(Proof::exact("", ""));
    for &e in es {
        let own = solved.verdict_as_solved(e);
        let is_proved = matches!(own, Verdict::Proved(_));
        verdict = verdict.and(own);
        if !is_proved {
            break;
        }
    }
    verdict
}

pub(super) fn refuted(what: &str, found: Counterexample) -> Verdict {
    let (lower, upper) = &found.residual;
    let size = if lower == upper {
        format!("is {lower}")
    } else {
        format!("lies between {lower} and {upper}")
    };
    Verdict::Refuted(Counterexample {
        detail: format!(
            "{what} does not follow from the other system at the same place: its residual {size} at the jet stated"
        ),
        quantity: what.to_owned(),
        ..found
    })
}

/// The first equation that fails and was compared with a system that is solved.
fn refutation(judged: &[Judged]) -> Option<Verdict> {
    judged
        .iter()
        .find_map(|own| match (&own.verdict, own.open.is_empty()) {
            (Verdict::Refuted(found), true) => Some(refuted(&own.what, found.clone())),
            _ => None,
        })
}

/// Where a proof holds.
fn on(pivots: &BTreeSet<Pivot>, inverted: &BTreeSet<String>) -> String {
    let mut place = String::from("all jets");
    if !pivots.is_empty() {
        let names: BTreeSet<&str> = pivots.iter().map(|pivot| pivot.tensor.as_str()).collect();
        let names: Vec<&str> = names.into_iter().collect();
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

pub(super) fn groups(functional: &Functional, role: Role, on: Option<&str>) -> Vec<Group> {
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
pub(super) fn euler_groups(functional: &Functional, variation: &Variation) -> Vec<Group> {
    let own = functional.interior().map(|field| Group {
        label: format!("the Euler equation of {}", field.name),
        equations: variation
            .euler
            .iter()
            .filter(|(component, _)| field.components.contains(component))
            .map(|(_, value)| *value)
            .collect(),
    });
    own.collect()
}

pub(super) fn condition_groups(
    functional: &Functional,
    on: &OnPiece,
    conditions: &[Condition],
) -> Vec<Group> {
    let mut found: Vec<Group> = Vec::new();
    for condition in conditions {
        let tensor = functional.space.component_at(condition.component).tensor;
        let of = match condition.trace {
            Trace::Value => "",
            Trace::Normal => "the normal derivative of ",
        };
        let label = format!("the natural condition of {of}{tensor} on {}", on.piece);
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
