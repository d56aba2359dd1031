//! The comparison in words: what is compared, with which κ(0), how far apart the curves run, and what follows.

use super::{Beside, Gap};
use crate::page::unit;
use crate::study::{Motion, Study};
use chetaev_mechanics::words::counted;
use chetaev_symbolic::Verdict;

/// Paragraphs of one or a few sentences each.
pub(crate) fn told(study: &Study, motion: &Motion, found: &Beside) -> Vec<String> {
    let mut paragraphs = vec![compared(found), with_multipliers(found)];
    paragraphs.retain(|text| !text.is_empty());
    paragraphs.push(distances(study, motion, found));
    paragraphs.push(what_follows(study, motion, found));
    for (name, run) in [("motion", &motion.evidence.run), ("extremum", &found.run)] {
        if !run.ending.finished {
            paragraphs.push(format!("The {name} ended early: {}.", run.ending.reason));
        }
    }
    paragraphs
}

fn compared(found: &Beside) -> String {
    match found.kappa.is_empty() {
        true => "There are no constraints: the curve that makes the action ∫L dt stationary is the motion itself. Both were \
                 integrated, each from its own equations, from the same position and with the same velocities."
            .into(),
        false => "Two curves start from the same position with the same velocities, and both satisfy the constraints: the \
                  motion, by the principle of d'Alembert and Lagrange; and the constrained extremum (the vakonomic motion), \
                  which makes the action ∫L dt stationary among the curves that satisfy the constraints."
            .into(),
    }
}

fn with_multipliers(found: &Beside) -> String {
    if found.kappa.is_empty() {
        return String::new();
    }
    let values: Vec<String> = found
        .kappa
        .iter()
        .map(|(name, value)| format!("{name}(0) = {}", number(*value)))
        .collect();
    let reason = match (found.is_of_motion, found.is_stated) {
        (true, _) => "With these values every motion is an extremum.".to_string(),
        (false, true) => "These values were asked for.".into(),
        (false, false) => format!(
            "No values were asked for and the motion singles out none, so they are zero; `--kappa {}=1/2` takes another.",
            found.kappa[0].0
        ),
    };
    format!(
        "The state does not determine the extremum: it needs {} of its {} too, here {}. {reason}",
        match values.len() {
            1 => "the initial value",
            _ => "the initial values",
        },
        match values.len() {
            1 => "multiplier κ",
            _ => "multipliers κ",
        },
        values.join(", ")
    )
}

/// Coordinates that are named one by one.
const NAMED: usize = 6;

fn distances(study: &Study, motion: &Motion, found: &Beside) -> String {
    let mut gaps: Vec<&Gap> = found.gaps.iter().collect();
    gaps.sort_by(|a, b| b.largest().1.total_cmp(&a.largest().1));
    let Some(most) = gaps.first() else {
        let run = &motion.evidence.run;
        return match run.times.first() == run.times.last() {
            true => "The interval of time has no length: there is nothing to compare but the start, which is the same.",
            false => "One of the curves has no point beyond the start, so no distance is known.",
        }
        .into();
    };
    let tolerance = motion.settings.tolerance;
    if found.agree(tolerance) {
        return format!(
            "The curves agree: the largest difference is {}, with a tolerance of {tolerance:e} for each step.",
            reading(study, motion, most)
        );
    }
    let named: Vec<String> = gaps
        .iter()
        .take(NAMED)
        .map(|gap| reading(study, motion, gap))
        .collect();
    let rest = match gaps.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(
            "; in {} it is less",
            counted(more, "coordinate", "coordinates")
        ),
    };
    format!(
        "The curves part. The largest differences are {}{rest}.",
        named.join(", ")
    )
}

/// "14.94 m in y at t = 9.96 s".
fn reading(study: &Study, motion: &Motion, gap: &Gap) -> String {
    let (row, distance) = gap.largest();
    let spaced = |unit: Option<String>| unit.map_or(String::new(), |u| format!(" {u}"));
    let second = study.model.has_units.then(|| "s".to_string());
    format!(
        "{}{} in {} at t = {}{}",
        number(distance),
        spaced(unit(study, gap.coordinate, 0)),
        study.system.coordinates[gap.coordinate].name,
        number(motion.evidence.run.times[row]),
        spaced(second)
    )
}

/// Four significant digits; powers of ten for what is small or large.
pub(crate) fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&x.abs()) {
        return format!("{x:.1e}");
    }
    let decimals = (3 - x.abs().log10().floor() as i32).max(0) as usize;
    let text = format!("{x:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text,
    }
}

/// The verdict on stationary action, and what it says of the two curves.
fn what_follows(study: &Study, motion: &Motion, found: &Beside) -> String {
    let agree = found.agree(motion.settings.tolerance);
    let decided = study
        .verdicts
        .iter()
        .find(|d| d.claim == "hamilton.stationary");
    let verdict = decided.map(|d| &d.finding.verdict);
    if found.kappa.is_empty() {
        return "So it must be: without constraints Hamilton's principle is one of stationary action.".into();
    }
    let neighbours = match neighbours(motion) {
        Some(sentence) => format!(" {sentence}"),
        None => String::new(),
    };
    if found.gaps.is_empty() {
        return match verdict {
            Some(verdict) => format!(
                "`hamilton.stationary` is {}; the curves do not bear on it.",
                verdict.word()
            ),
            None => "Nothing follows for `hamilton.stationary`.".into(),
        };
    }
    match (verdict, agree) {
        (Some(Verdict::Proved(_)), true) => "So it must be: `hamilton.stationary` is proved, every motion of this system makes \
             the action stationary among the curves that satisfy the constraints."
            .into(),
        (Some(Verdict::Proved(_)), false) => "`hamilton.stationary` is proved: every motion of this system makes the action \
             stationary, but with a κ(0) of its own. With the one used here the extremum is another curve, and no motion."
            .into(),
        (Some(found @ Verdict::Conditional { .. }), _) => format!(
            "`hamilton.stationary` is conditional: {}.{neighbours}{}",
            crate::plain::told(found.detail()).0,
            parted(agree)
        ),
        (Some(Verdict::Refuted(_)), _) => format!(
            "`hamilton.stationary` is refuted: there are motions that no κ makes extrema of the action.{neighbours}{}",
            parted(agree)
        ),
        (Some(Verdict::NotApplicable { detail, .. }), _) => {
            format!(
                "`hamilton.stationary` is not applicable: {}.{}",
                crate::plain::told(detail).0,
                parted(agree)
            )
        }
        _ => format!(
            "Whether motions make the action stationary was not decided (`hamilton.stationary`).{neighbours}{}",
            parted(agree)
        ),
    }
}

fn parted(agree: bool) -> &'static str {
    match agree {
        true => " From this state and with this κ(0) the extremum does not leave the motion.",
        false => " With this κ(0) the extremum is another curve, and no motion.",
    }
}

/// A first variation of the action beyond this part of its terms is not zero.
const CLEARLY: f64 = 1e-3;

/// What the neighbours of the computed motion say.
fn neighbours(motion: &Motion) -> Option<String> {
    let found = motion.witness.neighbours.as_ref()?;
    (found.change > CLEARLY && found.error < found.change / 10.0).then(|| {
        format!(
            "This motion does not make it stationary: among neighbours that satisfy the constraints and have the same ends, \
             δ∫L dt reaches {} of the sizes of its terms, so no κ(0) makes it an extremum (`witness.stationary`, by numbers).",
            number(found.change)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_are_read_not_counted() {
        assert_eq!(number(14.943037), "14.94");
        assert_eq!(number(-2.4), "-2.4");
        assert_eq!(number(10.0), "10");
        assert_eq!(number(3.1e-10), "3.1e-10");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(12345.6), "12346");
    }
}
