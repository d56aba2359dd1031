//! What to say about a name that nothing is called.

use super::diagnostic::Diagnostic;
use super::functions::Builtin;
use super::lower::Scope;
use super::names::closest;
use super::span::Span;

/// The diagnostic for a name that nothing is called; `span` is the name without its primes.
pub(crate) fn unknown_name(
    name: &str,
    before_parenthesis: bool,
    span: Span,
    scope: &dyn Scope,
    bindings: &[(String, i64)],
) -> Diagnostic {
    let base = Diagnostic::error("unknown-name", span, format!("unknown name `{name}`"))
        .label("not defined");
    if before_parenthesis {
        let function = Builtin::of_any_name(name)
            .map(Builtin::name)
            .or_else(|| closest(name, Builtin::all_names()));
        if let Some(function) = function {
            return base
                .hint(format!("did you mean the function `{function}`?"))
                .suggest(span, function);
        }
    }
    let mut names = scope.names();
    names.extend(bindings.iter().map(|(index, _)| index.clone()));
    let known = |part: &str| names.iter().any(|other| other == part) || part == "pi" || part == "t";
    if let Some(factors) = product_of_names(name, known) {
        let product = factors.join(" ");
        let hint = format!("write `{product}` for a product: letters together are one name");
        return base.hint(hint).suggest(span, product);
    }
    match closest(name, names.iter().map(String::as_str)) {
        Some(near) => base
            .hint(format!("did you mean `{near}`?"))
            .suggest(span, near),
        None if name == "e" => base.hint("write exp(x) for the exponential function"),
        None if name == "i" || name == "n" => {
            base.hint("sizes are stated under [sizes], indices under [indices]")
        }
        None => base,
    }
}

/// Splits a name that was meant as a product, `mgx` where `m`, `g` and `x` are known, into the fewest factors.
fn product_of_names(name: &str, known: impl Fn(&str) -> bool) -> Option<Vec<&str>> {
    const LONGEST: usize = 24;
    if name.len() > LONGEST || !name.is_ascii() {
        return None;
    }
    // For each length, the fewest factors that the beginning of the name splits into.
    let mut splits: Vec<Option<Vec<&str>>> = vec![Some(Vec::new())];
    for end in 1..=name.len() {
        let mut best: Option<Vec<&str>> = None;
        for start in 0..end {
            let Some(Some(before)) = splits.get(start) else {
                continue;
            };
            let shorter = best
                .as_ref()
                .is_none_or(|best| before.len() + 1 < best.len());
            if shorter && known(&name[start..end]) {
                best = Some(before.iter().copied().chain([&name[start..end]]).collect());
            }
        }
        splits.push(best);
    }
    splits
        .pop()
        .flatten()
        .filter(|factors| (2..=4).contains(&factors.len()))
}
