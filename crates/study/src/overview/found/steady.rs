//! Steady motions and their stability.

use super::{condition, lead, verdict, Found};
use crate::study::{Decided, Study};
use chetaev_symbolic::Verdict;

/// What is asked of a steady motion: of itself, then of the eigenvalues about it, from the stronger to the weaker.
const ASKED: [(&str, &str); 3] = [
    ("stability.nonlinear", "stable"),
    ("stability.asymptotic", "asymptotically stable"),
    ("stability.spectral", "spectrally stable"),
];

/// Characters of a sentence on one line.
const ONE_LINE: usize = 80;

/// How many steady motions there are that stand alone, of a model that names none.
pub(super) fn sets(study: &Study) -> Option<Found> {
    let proved = |claim: &str| {
        let decided = verdict(study, claim, None)?;
        matches!(decided.finding.verdict, Verdict::Proved(_)).then_some(decided)
    };
    // Of a motion that the model names its stability is told.
    if !study.system.steady.is_empty() {
        return None;
    }
    let decided = proved("steady.motions")?;
    let all = lead(study, decided.finding.verdict.detail());
    // Families say little in a line; `chetaev steady` writes them.
    let (counts, _) = all.split_once(": ")?;
    counts.contains("steady motion").then_some(())?;
    let sentence = if all.chars().count() > ONE_LINE {
        format!("{counts}: `chetaev steady` writes them")
    } else {
        all
    };
    Some(Found::new("steady", sentence, &[decided]))
}

/// Each stated steady motion with what is known of its stability.
pub(super) fn found(study: &Study) -> Option<Found> {
    let stated: Vec<&Decided> = (study.verdicts.iter())
        .filter(|d| d.claim == "steady.stated" && d.subject.is_some())
        .collect();
    if stated.is_empty() {
        return None;
    }
    let mut claims = Vec::new();
    let mut sentences = Vec::new();
    for steady in stated {
        let name = steady.subject.as_deref();
        claims.push(steady.full_id());
        let mut parts = Vec::new();
        if !matches!(steady.finding.verdict, Verdict::Proved(_)) {
            parts.push(match condition(steady) {
                "" => format!("steady: {}", steady.finding.verdict.word()),
                condition => format!("steady where {condition}"),
            });
        }
        for (claim, words) in ASKED {
            if let Some(decided) = verdict(study, claim, name) {
                claims.push(decided.full_id());
                parts.extend(stability(decided, words));
            }
        }
        let name = name.unwrap_or_default();
        sentences.push(if parts.is_empty() {
            format!("{name}: steady")
        } else {
            format!("{name}: {}", parts.join("; "))
        });
    }
    Some(Found {
        subject: "stability",
        sentences,
        claims,
    })
}

fn stability(decided: &Decided, words: &str) -> Option<String> {
    match &decided.finding.verdict {
        Verdict::Proved(_) => Some(words.to_owned()),
        Verdict::Refuted(_) => Some(format!("not {words}")),
        Verdict::Conditional { condition, .. } => {
            Some(format!("{words} where {}", rounded(condition)))
        }
        _ => None,
    }
}

/// Numbers of many digits with six of them: the claim encloses them.
pub(crate) fn rounded(text: &str) -> String {
    let is_number = |word: &str| word.len() > 9 && word.parse::<f64>().is_ok();
    let words = text.split(' ').map(|word| {
        if is_number(word) {
            word.parse::<f64>().map_or(word.to_owned(), |x| {
                let text = format!("{x:.5}");
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            })
        } else {
            word.to_owned()
        }
    });
    words.collect::<Vec<String>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn enclosed_numbers_are_rounded() {
        assert_eq!(
            rounded("4.292382536341104 < v < 6.024262015388359"),
            "4.29238 < v < 6.02426"
        );
        assert_eq!(rounded("ahead >= 0"), "ahead >= 0");
    }
}
