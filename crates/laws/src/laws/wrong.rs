//! Maggi's equations with a term forgotten or of the wrong sign are not the equations of the system.

use super::numbers::{differ, Size};
use super::rewrite::{places, slipped, Slip};
use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::Equations;
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::Expr;

/// Terms tried until one makes a difference: some vanish on the constraints, or in all but their name.
const ATTEMPTS: usize = 12;

/// A term is forgotten.
pub(super) fn dropped_term(subject: &Subject<'_>) -> Option<Trial> {
    trial(subject, Slip::Drop, "a forgotten term is found")
}

/// A term has the wrong sign.
pub(super) fn wrong_sign(subject: &Subject<'_>) -> Option<Trial> {
    trial(subject, Slip::Flip, "a wrong sign is found")
}

/// `None` when no slip that was tried changes the accelerations.
fn trial(subject: &Subject<'_>, slip: Slip, law: &'static str) -> Option<Trial> {
    let mut random = Random::stream(subject.seed, 0x0bad + slip as u64);
    (0..ATTEMPTS).find_map(|_| {
        let (wrong, about) = slip_of(subject, slip, &mut random)?;
        let right = &subject.maggi.accelerations;
        let seen = differ(
            subject,
            &wrong.in_natural_state(subject.cx.system, &wrong.accelerations),
            &subject.maggi.in_natural_state(subject.cx.system, right),
        );
        (seen == Size::NotZero).then(|| Trial {
            kind: Kind::Mutant,
            formulation: "maggi",
            law,
            about,
            expected: Expected::Refuted,
            verdict: subject.compared(&wrong),
            seconds: 0.0,
        })
    })
}

/// The equations with a slip at a random place, and what it is.
fn slip_of(subject: &Subject<'_>, slip: Slip, random: &mut Random) -> Option<(Equations, String)> {
    let g = &subject.cx.system.graph;
    let stated = &subject.maggi.groups.first()?.equations;
    let mut equations: Vec<Expr> = stated.iter().map(|e| g.sub(e.left, e.right)).collect();
    let sigma = random.below(equations.len() as u64) as usize;
    let found = places(g, equations[sigma]);
    let place = *found.get(random.below(found.len() as u64) as usize)?;
    equations[sigma] = slipped(g, &[equations[sigma]], place, slip)[0];
    let what = match slip {
        Slip::Drop => "without the term",
        Slip::Flip => "with the wrong sign of",
    };
    let label = &stated[sigma].label;
    let about = format!("equation of {label} {what} {}", g.text(place.term));
    Some((subject.motion_of(&subject.chart, &equations)?, about))
}
