//! First integrals, written.

use super::Found;
use crate::study::{Decided, Study};
use crate::typeset;
use chetaev_mechanics::words::counted;

/// Integrals that are written out; all are in the record and the report.
const WRITTEN: usize = 4;

/// Characters of a formula that fits in two lines behind its number.
const FORMULA: usize = 150;

/// The first integrals, and where there are more.
pub(super) fn found(study: &Study) -> Option<Found> {
    let mut all = study.verdicts.iter();
    let family = all.find(|d| d.claim == "noether.family")?;
    if !matches!(family.finding.verdict.word(), "proved" | "conditional") {
        return None;
    }
    let integrals: Vec<&Decided> = (study.verdicts.iter())
        .filter(|d| d.claim == "noether.integral")
        .collect();
    let mut sentences: Vec<String> = integrals
        .iter()
        .take(WRITTEN)
        .map(|integral| written(study, integral))
        .collect();
    match integrals.len() {
        0 => sentences.push("none in the families searched".into()),
        n if n > WRITTEN => sentences.push(format!(
            "{} (--show integrals)",
            counted(n - WRITTEN, "more", "more")
        )),
        _ => {}
    }
    let special = special(family.finding.verdict.detail());
    if !special.is_empty() {
        sentences.push(format!("more of them where {}", special.join(", or ")));
    }
    let claims = Some(&family).into_iter().chain(&integrals);
    Some(Found {
        subject: "integrals",
        sentences,
        claims: claims.map(|d| d.full_id()).collect(),
    })
}

/// An integral as a formula; the energy is one.
fn written(study: &Study, integral: &Decided) -> String {
    let number = integral.subject.as_deref().unwrap_or_default();
    let motion = study.motion.as_ref();
    let energy = motion.and_then(|m| m.found.energy.as_ref());
    let name = if energy.is_some_and(|own| own.name == number) {
        format!("{number}, the energy")
    } else {
        number.to_owned()
    };
    let Some(formula) = integral.finding.formulas.first() else {
        return name;
    };
    let g = &study.system.graph;
    if !typeset::is_legible(g, formula.right) {
        return format!("{name}: a formula that is too long for a terminal");
    }
    let text = g.text(typeset::simplified(&study.system, &[formula.right])[0]);
    match text.chars().count() {
        n if n > FORMULA => format!("{name}: a formula of {n} characters (--show integrals)"),
        _ => format!("{name}: {text}"),
    }
}

/// The special values of parameters at which there are more integrals, as the claim states them.
fn special(detail: &str) -> Vec<String> {
    let Some((_, rest)) = detail.split_once("there are further or simpler ones ") else {
        return Vec::new();
    };
    let parts = rest.split("; ");
    let stated = parts.map_while(|part| part.strip_prefix("where ")?.split_once(':'));
    stated.map(|(values, _)| values.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::special;

    #[test]
    fn special_values_are_read_from_the_claim() {
        let detail = "1 first integral; there are further or simpler ones where a = 0: u, w; where J = 3 m a^2: u y'; each is proved";
        assert_eq!(special(detail), ["a = 0", "J = 3 m a^2"]);
        assert!(special("no more were found").is_empty());
    }
}
