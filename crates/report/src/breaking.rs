//! Long formulas in pieces that a browser may set on several lines.
//!
//! Browsers do not break lines within `<math>`. A long formula therefore becomes a sequence of
//! `<math>` elements, each beginning with a relation or with the sign of a term, and flows like
//! the words of a sentence: on any width, and on paper.

/// Signs of a formula that fits into a line of any screen, of a phone too.
const LINE: usize = 28;

/// The pieces of the content of a `<math>` element that [`filter`](crate::mathml) has balanced;
/// one piece where it is short or cannot be broken.
pub(crate) fn pieces(content: &str) -> Vec<String> {
    let mut out = vec![String::new()];
    if width(content) <= LINE {
        out[0].push_str(content);
    } else {
        spread(content, 0, &mut out);
    }
    out.retain(|piece| !piece.is_empty());
    out
}

/// Appends the content, beginning a new piece before each relation and each sign between terms.
fn spread(content: &str, depth: usize, out: &mut Vec<String>) {
    let parts = children(content);
    let is_fenced = parts.first().copied() == Some("<mo>(</mo>");
    let has_fraction = content.contains("<mfrac>");
    for (place, part) in parts.iter().enumerate() {
        let is_sign = matches!(*part, "<mo>+</mo>" | "<mo>−</mo>");
        if place > 0 && (is_sign || *part == "<mo>=</mo>") {
            let sign = part.replace("<mo>", "<mo form=\"infix\">");
            out.push(sign);
            continue;
        }
        let inner = part
            .strip_prefix("<mrow>")
            .and_then(|rest| rest.strip_suffix("</mrow>"));
        // A product that goes on and on may also break before a factor in parentheses.
        let before = out.last().map_or(0, |last| width(last));
        if before > LINE / 2 && part.starts_with("<mrow><mo>(</mo>") && before + width(part) > LINE
        {
            out.push(String::new());
        }
        match (inner, wide_fraction(part)) {
            (Some(inner), _) if width(inner) > LINE && depth < 12 => spread(inner, depth + 1, out),
            (_, Some((numerator, denominator))) if depth < 12 => {
                append(out, &format!("<mfrac><mn>1</mn>{denominator}</mfrac>"));
                spread(&grouped(numerator), depth + 1, out);
            }
            _ => append(out, &fence(part, is_fenced, has_fraction)),
        }
    }
}

/// Numerator and denominator of a fraction that does not fit into a line, but would without its
/// numerator.
fn wide_fraction(part: &str) -> Option<(&str, &str)> {
    let inner = part.strip_prefix("<mfrac>")?.strip_suffix("</mfrac>")?;
    match children(inner)[..] {
        [numerator, denominator]
            if width(numerator) > 2 * LINE && width(denominator) <= 2 * LINE =>
        {
            Some((numerator, denominator))
        }
        _ => None,
    }
}

/// A numerator as a factor: a sum in parentheses, a product as it is.
fn grouped(numerator: &str) -> String {
    let inner = numerator
        .strip_prefix("<mrow>")
        .and_then(|rest| rest.strip_suffix("</mrow>"))
        .unwrap_or(numerator);
    let is_sum = children(inner)
        .iter()
        .any(|part| matches!(*part, "<mo>+</mo>" | "<mo>−</mo>"));
    if is_sum {
        format!("<mo>(</mo><mrow>{inner}</mrow><mo>)</mo>")
    } else {
        format!("<mo>&#x2062;</mo>{inner}")
    }
}

/// Parentheses that end up in different pieces cannot stretch to the same height by themselves.
fn fence(part: &str, is_fenced: bool, has_fraction: bool) -> String {
    if !is_fenced || !matches!(part, "<mo>(</mo>" | "<mo>)</mo>") {
        return part.to_owned();
    }
    if has_fraction {
        part.replace("<mo>", "<mo minsize=\"2.2em\" maxsize=\"2.2em\">")
    } else {
        part.replace("<mo>", "<mo minsize=\"1.5em\" maxsize=\"1.5em\">")
    }
}

fn append(out: &mut Vec<String>, part: &str) {
    match out.last_mut() {
        Some(last) => last.push_str(part),
        None => out.push(part.to_owned()),
    }
}

/// The elements and texts side by side in balanced markup.
fn children(content: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut start, mut depth) = (0, 0usize);
    let mut at = 0;
    while let Some(open) = content[at..].find('<').map(|i| at + i) {
        let Some(end) = content[open..].find('>').map(|i| open + i + 1) else {
            break;
        };
        if depth == 0 && open > start {
            found.push(&content[start..open]);
            start = open;
        }
        if content[open..].starts_with("</") {
            depth = depth.saturating_sub(1);
            if depth == 0 {
                found.push(&content[start..end]);
                start = end;
            }
        } else {
            depth += 1;
        }
        at = end;
    }
    if start < content.len() {
        found.push(&content[start..]);
    }
    found
}

/// The number of signs that are seen.
fn width(content: &str) -> usize {
    let (mut count, mut in_tag, mut in_reference) = (0, false, false);
    for c in content.chars() {
        match c {
            '<' => in_tag = true,
            '>' if in_tag => in_tag = false,
            _ if in_tag => {}
            '&' => in_reference = true,
            ';' if in_reference => in_reference = false,
            _ if in_reference => {}
            _ => count += 1,
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::{children, pieces, width};

    fn sum(terms: usize) -> String {
        let term = "<mi>a</mi><mo>&#x2062;</mo><mi>b</mi>".to_owned();
        vec![format!("<mrow>{term}</mrow>"); terms].join("<mo>+</mo>")
    }

    #[test]
    fn markup_is_split_side_by_side() {
        assert_eq!(
            children("<mi>a</mi><mo>=</mo><mrow><mi>b</mi><mn>2</mn></mrow>x"),
            [
                "<mi>a</mi>",
                "<mo>=</mo>",
                "<mrow><mi>b</mi><mn>2</mn></mrow>",
                "x"
            ]
        );
        assert_eq!(width("<mi>ab</mi><mo>&#x2062;</mo><mn>3</mn>"), 3);
    }

    #[test]
    fn short_formulas_stay_whole() {
        let formula = format!("<mi>T</mi><mo>=</mo><mrow>{}</mrow>", sum(4));
        assert_eq!(pieces(&formula), [formula]);
    }

    #[test]
    fn long_formulas_break_at_relations_and_terms_and_lose_nothing() {
        let formula = format!("<mrow><mi>T</mi><mo>=</mo><mrow>{}</mrow></mrow>", sum(30));
        let broken = pieces(&formula);
        assert_eq!(broken.len(), 31);
        assert_eq!(broken[0], "<mi>T</mi>");
        assert!(broken[1].starts_with("<mo form=\"infix\">=</mo><mrow>"));
        assert!(broken[2].starts_with("<mo form=\"infix\">+</mo><mrow>"));
        assert_eq!(
            broken.iter().map(|p| width(p)).sum::<usize>(),
            width(&formula)
        );
    }

    #[test]
    fn a_long_group_breaks_within_its_parentheses() {
        let group = format!("<mrow><mo>(</mo><mrow>{}</mrow><mo>)</mo></mrow>", sum(30));
        let broken = pieces(&format!("<mrow><mi>m</mi><mo>&#x2062;</mo>{group}</mrow>"));
        assert_eq!(broken.len(), 30);
        assert!(broken[0].contains("<mo minsize=\"1.5em\" maxsize=\"1.5em\">(</mo>"));
        assert!(broken[29].ends_with("<mo minsize=\"1.5em\" maxsize=\"1.5em\">)</mo>"));
    }

    #[test]
    fn a_wide_fraction_becomes_a_factor() {
        let fraction = format!("<mfrac><mrow>{}</mrow><mi>D</mi></mfrac>", sum(60));
        let broken = pieces(&format!("<mi>x</mi><mo>=</mo>{fraction}"));
        assert_eq!(broken.len(), 61);
        assert!(
            broken[1].starts_with("<mo form=\"infix\">=</mo><mfrac><mn>1</mn><mi>D</mi></mfrac>")
        );
    }
}
