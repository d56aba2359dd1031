//! Names: Greek letters, subscripts, and the nearest known name to a misspelt one.

/// Greek letters that are read as their names, with the variants that fonts and keyboards produce.
const GREEK: &[(char, &str)] = &[
    ('α', "alpha"),
    ('β', "beta"),
    ('ϐ', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "epsilon"),
    ('ϵ', "epsilon"),
    ('ζ', "zeta"),
    ('η', "eta"),
    ('θ', "theta"),
    ('ϑ', "theta"),
    ('ι', "iota"),
    ('κ', "kappa"),
    ('ϰ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('µ', "mu"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('ο', "omicron"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('ϱ', "rho"),
    ('σ', "sigma"),
    ('ς', "sigma"),
    ('τ', "tau"),
    ('υ', "upsilon"),
    ('φ', "phi"),
    ('ϕ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('Γ', "Gamma"),
    ('Δ', "Delta"),
    ('Θ', "Theta"),
    ('Λ', "Lambda"),
    ('Ξ', "Xi"),
    ('Π', "Pi"),
    ('Σ', "Sigma"),
    ('Υ', "Upsilon"),
    ('Φ', "Phi"),
    ('Ψ', "Psi"),
    ('Ω', "Omega"),
];

/// The name of a Greek letter, `theta` for `θ` and for `ϑ`.
pub fn greek_name(letter: char) -> Option<&'static str> {
    GREEK
        .iter()
        .find(|(sign, _)| *sign == letter)
        .map(|(_, name)| *name)
}

/// The Greek letter of a name, `θ` for `theta`; printers use it.
pub fn greek_letter(name: &str) -> Option<char> {
    GREEK
        .iter()
        .find(|(_, word)| *word == name)
        .map(|(sign, _)| *sign)
}

/// The digit of a subscript sign, 2 for `₂`.
pub(crate) fn subscript_digit(sign: char) -> Option<char> {
    digit_after(sign, '₀')
}

/// The digit of a superscript sign, 2 for `²`.
pub(crate) fn superscript_digit(sign: char) -> Option<char> {
    match sign {
        '¹' => Some('1'),
        '²' => Some('2'),
        '³' => Some('3'),
        _ => digit_after(sign, '⁰'),
    }
}

fn digit_after(sign: char, zero: char) -> Option<char> {
    let distance = (sign as u32).checked_sub(zero as u32)?;
    if distance < 10 {
        char::from_digit(distance, 10)
    } else {
        None
    }
}

/// Whether a character may begin a name.
pub(crate) fn begins_name(sign: char) -> bool {
    sign.is_ascii_alphabetic() || sign == '_' || greek_name(sign).is_some()
}

/// Whether a character may go on with a name.
pub(crate) fn continues_name(sign: char) -> bool {
    begins_name(sign) || sign.is_ascii_digit() || subscript_digit(sign).is_some()
}

/// A name with Greek letters and subscript digits written out: `θ₁` becomes `theta_1`.
pub fn normalized(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    let mut in_subscript = false;
    for sign in name.chars() {
        if let Some(digit) = subscript_digit(sign) {
            if !in_subscript && !out.ends_with('_') {
                out.push('_');
            }
            out.push(digit);
            in_subscript = true;
            continue;
        }
        in_subscript = false;
        match greek_name(sign) {
            Some(word) => out.push_str(word),
            None => out.push(sign),
        }
    }
    out
}

/// The candidate nearest to a misspelt name, if one is near enough to be meant.
///
/// Nearness is the number of letters inserted, deleted, replaced or swapped with a neighbour; a difference of case
/// alone is nearest. Ties go to the earlier candidate.
pub fn closest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = name.chars().count();
    if length > 64 {
        return None;
    }
    let allowed = match length {
        0..=1 => 0,
        2..=4 => 1,
        5..=8 => 2,
        _ => 3,
    };
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        if candidate == name || candidate.len() > 64 {
            continue;
        }
        let distance = if candidate.eq_ignore_ascii_case(name) {
            0
        } else {
            distance(name, candidate)
        };
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Optimal string alignment distance (Damerau 1964; each piece of text edited at most once).
fn distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greek_letters_and_subscripts_are_written_out() {
        assert_eq!(normalized("θ₁"), "theta_1");
        assert_eq!(normalized("ϑ_12"), "theta_12");
        assert_eq!(normalized("Ωx"), "Omegax");
        assert_eq!(normalized("q_₁₂"), "q_12");
        assert_eq!(greek_letter("theta"), Some('θ'));
    }

    #[test]
    fn nearest_names() {
        assert_eq!(closest("thta", ["x", "theta", "phi"]), Some("theta"));
        assert_eq!(closest("tehta", ["x", "theta", "phi"]), Some("theta"));
        assert_eq!(closest("Phi", ["x", "theta", "phi"]), Some("phi"));
        assert_eq!(closest("z", ["x", "y"]), None);
        assert_eq!(
            closest("lagrangain", ["coordinates", "lagrangian"]),
            Some("lagrangian")
        );
        assert_eq!(distance("abc", "abc"), 0);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("ab", "ba"), 1);
    }
}
