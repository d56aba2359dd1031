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
        if advice(name).is_some() {
            return not_a_function(name, span);
        }
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
    if let Some((hint, replacement)) = derivative(name, &known) {
        let base = base.hint(hint);
        return match replacement {
            Some(replacement) => base.suggest(span, replacement),
            None => base,
        };
    }
    if matches!(name, "then" | "else") {
        return base.hint(advice("if").unwrap_or_default());
    }
    let is_call_elsewhere = matches!(
        name,
        "if" | "ifelse" | "piecewise" | "Piecewise" | "heaviside" | "Heaviside" | "min" | "max"
    );
    if let Some(advice) = advice(name).filter(|_| is_call_elsewhere) {
        return base.hint(advice);
    }
    if matches!(name, "np" | "numpy" | "math" | "sp" | "sympy" | "Math") {
        return base.hint("functions stand by themselves: write sin(x), sqrt(x), pi");
    }
    if matches!(name, "deg" | "degree" | "degrees" | "grad") {
        return base.hint("angles are in radians: 30 degrees are 30 pi/180; or state a parameter with its unit, as in slope = { value = 30, unit = \"deg\" }");
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

/// What to write in the place of something that other languages have as a function and expressions here do not.
pub(crate) fn advice(name: &str) -> Option<&'static str> {
    Some(match name {
        "min" | "max" => "a larger or smaller of two has a corner, at which the equations have no derivatives; write a smooth one, max(a, b) ≈ (a + b + sqrt((a - b)^2 + eps^2))/2, or let the run stop where they are equal, under [events]",
        "if" | "ifelse" | "piecewise" | "Piecewise" | "where" | "when" | "cases" | "heaviside" | "Heaviside" | "step" => {
            "there are no distinctions of cases: join the cases smoothly, as by (1 + tanh(x/eps))/2 for a step at x = 0, or let the run stop where they meet, under [events]"
        }
        "sat" | "saturate" | "saturation" | "clip" | "clamp" => "write a smooth saturation, as L tanh(x/L)",
        "table" | "lookup" | "interp" | "interp1" | "interpolate" | "spline" => "there are no tables: write a formula that fits the numbers",
        "sech" => "write 1/cosh(x)",
        "csch" => "write 1/sinh(x)",
        "coth" => "write cosh(x)/sinh(x)",
        "acot" | "arccot" => "write atan(1/x), with values between -pi/2 and pi/2; or pi/2 - atan(x), with values between 0 and pi",
        "asec" | "arcsec" => "write acos(1/x)",
        "acsc" | "arccsc" => "write asin(1/x)",
        "asech" | "arcsech" | "arsech" => "write acosh(1/x)",
        "acsch" | "arccsch" | "arcsch" => "write asinh(1/x)",
        "acoth" | "arccoth" | "arcoth" => "write atanh(1/x)",
        "cbrt" => "write x^(1/3)",
        "hypot" => "write sqrt(x^2 + y^2)",
        "log2" => "write log(x)/log(2)",
        "log10" => "write log(x)/log(10)",
        "log1p" => "write log(1 + x)",
        "expm1" => "write exp(x) - 1",
        "pow" | "power" => "write x^y",
        "floor" | "ceil" | "round" | "mod" | "fmod" | "rem" => "functions with jumps are not available",
        "diff" | "Derivative" | "derivative" | "der" | "deriv" | "ddt" | "Dt" | "D" | "d" => "derivatives with respect to the time are written by primes: x', x''",
        _ => return None,
    })
}

/// The diagnostic for it.
pub(crate) fn not_a_function(name: &str, span: Span) -> Diagnostic {
    let message = format!("`{name}` is not available in expressions");
    let diagnostic =
        Diagnostic::error("no-such-function", span, message).label("not a function here");
    match advice(name) {
        Some(advice) => diagnostic.hint(advice),
        None => diagnostic,
    }
}

/// A name that stands for a derivative elsewhere: `xdot`, `x_dot`, `dx` of dx/dt, `dt`; with what to write in its place.
fn derivative(name: &str, known: &dyn Fn(&str) -> bool) -> Option<(String, Option<String>)> {
    let dots = [("dddot", 3), ("ddot", 2), ("dot", 1)];
    let dotted = dots.iter().find_map(|(end, order)| {
        let stem = name.strip_suffix(end)?;
        let stem = stem.strip_suffix('_').unwrap_or(stem);
        known(stem).then(|| format!("{stem}{}", "'".repeat(*order)))
    });
    if let Some(written) = dotted {
        return Some((
            format!("write `{written}`: primes are derivatives with respect to the time"),
            Some(written),
        ));
    }
    let stem = name.strip_prefix('d').filter(|stem| known(stem))?;
    Some(match stem {
        "t" => (
            "primes are derivatives with respect to the time: write x' for dx/dt".into(),
            None,
        ),
        stem => (
            format!("write `{stem}'` for the derivative d{stem}/dt"),
            None,
        ),
    })
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
