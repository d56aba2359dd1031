//! Which fields a functional admits: whether what is imposed can hold at all, for which data, and what of it is said twice.

use super::modulo::labels;
use crate::elimination::{Group, Solved};
use crate::functional::{Functional, Piece, Role};
use chetaev_symbolic::{Expr, Verdict};

/// What is known of what is imposed.
#[derive(Debug, Default)]
pub struct Admission {
    /// Why no field is admitted.
    pub none: Option<String>,
    /// What data and parameters have to satisfy so that there are fields.
    pub only_where: Vec<String>,
    /// Labels of equations that follow from those imposed before.
    pub redundant: Vec<String>,
}

impl Admission {
    /// Of a functional: in the interior, on every piece of its boundary, and where two faces meet.
    pub fn of(functional: &Functional) -> Admission {
        let mut own = Admission::default();
        if functional.with_role(Role::Imposed).next().is_none() {
            return own;
        }
        let inside = own.extended(Solved::new(&functional.space), functional, &[]);
        own.restricted(functional, &inside);
        for (at, piece) in functional.pieces.iter().enumerate() {
            let here = own.extended(inside.clone(), functional, &[piece]);
            for other in &functional.pieces[at + 1..] {
                if piece.meets(other) && own.none.is_none() {
                    let _ = own.extended(here.clone(), functional, &[piece, other]);
                }
            }
        }
        own
    }

    /// The equations of a place solved with those known, one after the other: of the interior, of a piece, or where two pieces meet,
    /// of the second. What follows from the others there only is not said twice.
    fn extended<'f>(
        &mut self,
        solved: Solved<'f>,
        functional: &'f Functional,
        place: &[&Piece],
    ) -> Solved<'f> {
        let piece = place.last().copied();
        let name = piece.map(|piece| piece.name.as_str());
        let stated = functional.with_role(Role::Imposed);
        let here = stated.filter(|e| e.on.as_deref() == name);
        let groups: Vec<Group> = here
            .map(|e| Group {
                label: format!("({})", e.label),
                equations: e.residuals.clone(),
            })
            .collect();
        if groups.is_empty() {
            return solved;
        }
        let mut known = solved.clone();
        for (count, group) in groups.iter().enumerate() {
            let is_trivial = functional.space.vanish(&group.equations);
            let is_first = count == 0 && piece.is_none();
            let is_everywhere = place.len() < 2;
            if is_everywhere && !is_trivial && !is_first && known.follows(&group.equations) {
                let label = group.label.trim_matches(['(', ')']).to_owned();
                if !self.redundant.contains(&label) {
                    self.redundant.push(label);
                }
            }
            if count + 1 < groups.len() {
                known = with(&known, piece, std::slice::from_ref(group));
            }
        }
        let all = with(&solved, piece, &groups);
        if let (None, Some((label, left))) = (&self.none, all.contradiction()) {
            let place = match place {
                [] => String::new(),
                [piece] => format!(" on {}", piece.name),
                [one, other, ..] => format!(" where {} and {} meet", one.name, other.name),
            };
            let text = functional.space.graph.text(left);
            self.none = Some(format!(
                "no field satisfies what is imposed{place}: with the rest {label} says {text} = 0, which is never so"
            ));
        }
        all
    }

    /// Relations between data and parameters that what is imposed asks for.
    fn restricted(&mut self, functional: &Functional, solved: &Solved<'_>) {
        let g = &functional.space.graph;
        let found: Vec<Expr> = solved.restrictions();
        let texts = found.into_iter().map(|e| format!("{} = 0", g.text(e)));
        self.only_where = texts.collect();
    }

    /// A verdict on a claim that speaks of the fields that are admitted.
    pub(super) fn applied(&self, verdict: Verdict) -> Verdict {
        if let Some(why) = &self.none {
            return Verdict::not_applicable("imposed", why.clone());
        }
        match verdict {
            Verdict::Proved(proof) if !self.only_where.is_empty() => {
                let condition = self.only_where.join(" and ");
                let verdict = Verdict::Conditional {
                    condition: condition.clone(),
                    proof,
                    counterexample: None,
                };
                verdict.prefixed(&format!(
                    "fields that satisfy what is imposed exist only where {condition}"
                ))
            }
            other => other,
        }
    }

    /// What is said of equations that are imposed without need.
    pub(super) fn of_redundant(&self) -> Option<String> {
        if self.redundant.is_empty() {
            return None;
        }
        Some(format!(
            "{} imposed besides, which follows from the others",
            labels(&self.redundant)
        ))
    }
}

fn with<'f>(solved: &Solved<'f>, piece: Option<&Piece>, groups: &[Group]) -> Solved<'f> {
    match piece {
        None => solved.with(groups),
        Some(piece) => solved.with_on(&piece.side, groups),
    }
}
