//! Details of verdicts as a person reads them: what was found, apart from how it was computed.

use chetaev_mechanics::System;

/// How a zero test was made, as parts of details begin.
const TECHNIQUES: [&str; 12] = [
    "the difference cancels",
    "the normal form over",
    "zero at ",
    "vanishes at ",
    "a minor of size",
    "no rank exceeds",
    "no rank is below",
    "larger with probability",
    "wrong with probability",
    "the conditions on κ were differentiated",
    "the terms were differentiated",
    "the equations of motion are solved for as many",
];

/// Where a numbered residual was evaluated; the counterexample says it better.
const RESIDUALS: [&str; 2] = ["the residual lies", "the residual is "];

fn is_technique(part: &str) -> bool {
    let begins = |known: &[&str]| known.iter().any(|begin| part.starts_with(begin));
    let is_numbered = |begin: &str| {
        let rest = part.strip_prefix(begin);
        rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    begins(&TECHNIQUES) || begins(&RESIDUALS) || is_numbered("rank ") || is_numbered("residual ")
}

/// What stands before each part of a detail that is shown in a line of its own.
const LISTED: &str = "; exhausted: ";

/// A detail without the parts that are shown in lines of their own, and these.
pub(crate) fn listed(detail: &str) -> (String, Vec<String>) {
    let detail = detail.replace('\n', " ");
    let mut parts = detail.split(LISTED).map(str::to_owned);
    let first = parts.next().unwrap_or_default();
    let begin = LISTED.trim_start_matches("; ");
    (first, parts.map(|part| format!("{begin}{part}")).collect())
}

/// A detail in two: the sentence for everybody, and how it was computed. A detail that only says how is the sentence.
pub(crate) fn told(detail: &str) -> (String, String) {
    let (detail, _) = listed(detail);
    let (how, told): (Vec<&str>, Vec<&str>) =
        detail.split("; ").partition(|part| is_technique(part));
    // "…: a minor of size 3 is not zero …" within a part.
    let mut how: Vec<String> = how.into_iter().map(str::to_string).collect();
    let told: Vec<&str> = told
        .into_iter()
        .map(|part| match part.split_once(": a minor of size") {
            Some((what, size)) => {
                how.insert(0, format!("a minor of size{size}"));
                what
            }
            None => part,
        })
        .collect();
    match told.is_empty() {
        true => (detail, String::new()),
        false => (told.join("; "), how.join("; ")),
    }
}

/// [`with_deltas`], unless the model has such names of its own.
pub(crate) fn written(system: &System, text: &str) -> String {
    let coordinates = system.coordinates.iter().map(|c| &c.name);
    let mut names = coordinates.chain(system.parameters.iter().map(|p| &p.name));
    match names.any(|name| name.to_lowercase().starts_with("delta_")) {
        true => text.into(),
        false => with_deltas(text),
    }
}

/// `delta_x'` as `D(δx)`, `Delta_t` as `Δt`, where these are variations and no names of a model.
pub(crate) fn with_deltas(text: &str) -> String {
    let mut written = String::new();
    let mut rest = text;
    while let Some((at, letter)) = next_delta(rest) {
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        written.push_str(&rest[..at]);
        let name = &rest[at + "delta_".len()..];
        let end = name.find(|c| !is_name(c)).unwrap_or(name.len());
        let primes = name[end..].chars().take_while(|&c| c == '\'').count();
        let named = &name[..end];
        match primes {
            0 => written.push_str(&format!("{letter}{named}")),
            1 => written.push_str(&format!("D({letter}{named})")),
            order => written.push_str(&format!("D^{order}({letter}{named})")),
        }
        rest = &name[end + primes..];
    }
    written + rest
}

/// Where the next variation begins, at the beginning of a word, and its letter.
fn next_delta(text: &str) -> Option<(usize, char)> {
    let starts = |at: usize| {
        let before = text[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
    };
    let of = |word: &str, letter: char| {
        let mut places = text.match_indices(word).map(|(at, _)| at);
        places.find(|&at| starts(at)).map(|at| (at, letter))
    };
    let found = [of("delta_", 'δ'), of("Delta_", 'Δ')];
    found.into_iter().flatten().min()
}

#[cfg(test)]
mod tests {
    use super::{listed, told, with_deltas};

    #[test]
    fn families_stand_in_lines_of_their_own() {
        let detail = "two in the families; exhausted: polynomials of x (1 each); t (2 each): dimension 2; exhausted: quotients";
        let (sentence, lines) = listed(detail);
        assert_eq!(sentence, "two in the families");
        let expected = [
            "exhausted: polynomials of x (1 each); t (2 each): dimension 2",
            "exhausted: quotients",
        ];
        assert_eq!(lines, expected);
        assert_eq!(told(detail).0, sentence);
    }

    #[test]
    fn what_was_found_stands_apart_from_how() {
        let (sentence, how) = told("δf = 0 everywhere; a minor of size 1 is not zero at a point of a prime field, hence not zero; rank 1 at 2 random points");
        assert_eq!(sentence, "δf = 0 everywhere");
        assert!(how.starts_with("a minor") && how.ends_with("points"));
        let (sentence, how) = told("det does not vanish: a minor of size 4 is not zero");
        assert_eq!(
            (sentence.as_str(), how.as_str()),
            ("det does not vanish", "a minor of size 4 is not zero")
        );
        let (sentence, how) = told("the difference cancels in canonical form");
        assert_eq!(
            (sentence.as_str(), how.as_str()),
            ("the difference cancels in canonical form", "")
        );
        // A rank that is a result stays.
        assert_eq!(told("rank of B; rest").0, "rank of B; rest");
    }

    #[test]
    fn variations_are_written_with_their_letter() {
        assert_eq!(
            with_deltas("m delta_x' x' - Delta_t h"),
            "m D(δx) x' - Δt h"
        );
        assert_eq!(with_deltas("Dq_x delta_p_x"), "Dq_x δp_x");
        assert_eq!(with_deltas("my_delta_x + δ"), "my_delta_x + δ");
    }
}
