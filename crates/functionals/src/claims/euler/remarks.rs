//! What is said besides that the equations are equivalent: with which traces, which fields stay free, what was not used.

use super::comparison::{condition_groups, groups, Comparison};
use crate::claims::modulo::{all_subsets as subsets, labels};
use crate::elimination::{Group, Solved};
use crate::functional::{Constitutive, Field, Role};
use crate::variation::OnPiece;
use chetaev_symbolic::Expr;

impl<'f> Comparison<'f> {
    /// Functions stated as conjugates whose formulas are not proved to be so: no gradient of them was undone.
    pub(super) fn unrelated(&self) -> String {
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
    pub(super) fn undetermined(&self) -> Vec<String> {
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
        let algebraic: Vec<&Field> = algebraic.collect();
        let free = |components: &[usize]| self.derived.free_components(components, &equations);
        let mut found = Vec::new();
        let mut one_by_one = 0;
        for field in &algebraic {
            let Some(own) = free(&field.components).filter(|own| *own > 0) else {
                continue;
            };
            one_by_one += own;
            let all = field.components.len();
            found.push(format!(
                "while {} is not determined: {own} of its {all} components are left free",
                field.name
            ));
        }
        let together: Vec<usize> = algebraic
            .iter()
            .flat_map(|field| field.components.clone())
            .collect();
        let more = free(&together).and_then(|all| all.checked_sub(one_by_one));
        if let (Some(more @ 1..), true) = (more, algebraic.len() > 1) {
            let names: Vec<&str> = algebraic.iter().map(|field| field.name.as_str()).collect();
            let names = names.join(" and ");
            let words = match more {
                1 => "1 combination of their components is".to_owned(),
                _ => format!("{more} combinations of their components are"),
            };
            found.push(format!(
                "while {names} are not determined together: {words} left free"
            ));
        }
        found
    }

    /// On which pieces the conditions are the stated ones only with traces of equations that hold inside: the fewest are named.
    pub(super) fn traces(&self) -> Vec<String> {
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

    pub(super) fn detail(&self) -> String {
        let functional = self.functional;
        let label = |role: Role| -> Vec<String> {
            let own = functional.with_role(role);
            let mut all: Vec<String> = own.map(|e| e.label.clone()).collect();
            // Equations that several files state come in the order of the files.
            if all.iter().all(|label| label.parse::<u64>().is_ok()) {
                all.sort_by_key(|label| label.parse::<u64>().ok());
            }
            all
        };
        let (imposed, yielded) = (label(Role::Imposed), label(Role::Yielded));
        let mut detail = format!(
            "the Euler equations and natural conditions are equivalent to {}",
            labels(&yielded)
        );
        if !imposed.is_empty() {
            let verb = if imposed.len() == 1 { "holds" } else { "hold" };
            detail.push_str(&format!(", where {} {verb} beforehand", labels(&imposed)));
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
