//! The text for a terminal.

use super::equations::{
    absent, boundary, dependence, euler, given, in_order, indexed_euler, indexed_natural,
    is_without_indices, joined, kind, restricting, used, without_indices, Indexed, Shown,
    NO_INDICES,
};
use super::page::LEGIBLE;
use super::substitution::substituted;
use super::table;
use crate::layout::{hanging, terms};
use crate::summary::{bold, coloured, Style};
use chetaev_functionals::functional::{Field, Functional, Role};
use chetaev_functionals::notation::written_equation;
use chetaev_functionals::Study;
use chetaev_symbolic::print::Format;
use chetaev_symbolic::simplify;
use std::fmt::Write;

/// Longer equations are counted, not written out; the report and the record have them.
const WRITTEN: u64 = 400;

/// What is known about a functional.
pub fn summary(study: &Study, style: Style) -> String {
    let mut text = String::new();
    heading(&mut text, study, style);
    stated(&mut text, study, style);
    derived(&mut text, study, style);
    with_imposed(&mut text, study, style);
    levels(&mut text, study, style);
    let _ = writeln!(text, "\n{}", bold(style, "claims"));
    claims(&mut text, study, style);
    for notice in &study.notices {
        let _ = writeln!(text, "\nnote: {notice}");
    }
    text
}

fn derived(text: &mut String, study: &Study, style: Style) {
    let f = &study.problem.functional;
    let _ = writeln!(text, "\n{}", bold(style, "Euler equations"));
    let variation = match &study.variation {
        Ok(variation) => variation,
        Err(problem) => {
            text.push_str(&hanging("  not derived: ", &problem.to_string()));
            return;
        }
    };
    let restricting = restricting(f);
    if !restricting.is_empty() {
        let said = format!("where all are varied freely; {restricting} restricts that");
        text.push_str(&hanging("    ", &said));
    }
    for name in absent(f, variation) {
        let of = format!("δ{name}");
        let _ = writeln!(text, "    {of:<12} vanishes identically");
    }
    both(
        text,
        study,
        &indexed_euler(f, variation),
        &euler(f, variation),
    );
    let open = without_indices(f, variation);
    if !open.is_empty() {
        let said = format!("{} {NO_INDICES}", open.join(", "));
        text.push_str(&hanging("    ", &said));
    }
    let _ = writeln!(text, "\n{}", bold(style, "boundary conditions"));
    for (pieces, conditions) in joined(f, boundary(f, variation)) {
        text.push_str(&hanging("  on ", &pieces.join(", ")));
        let piece = pieces.first().map_or("", String::as_str);
        let given = given(f, piece);
        if !given.is_empty() {
            let _ = writeln!(text, "    given: {}", given.join(", "));
        }
        let indexed = indexed_natural(f, piece).unwrap_or_default();
        if !given.is_empty() && indexed.is_empty() && conditions.is_empty() {
            let _ = writeln!(text, "    nothing else is free");
        } else {
            both(text, study, &indexed, &conditions);
        }
        if is_without_indices(f, piece, &conditions) {
            let said = format!("the conditions here {NO_INDICES}");
            text.push_str(&hanging("    ", &said));
        }
    }
}

/// What follows where what is imposed is put in.
fn with_imposed(text: &mut String, study: &Study, style: Style) {
    let f = &study.problem.functional;
    let Some(own) = substituted(f) else { return };
    let _ = writeln!(text, "\n{}", bold(style, "with what is imposed put in"));
    text.push_str(&hanging("    ", &own.texts().join(", ")));
    let g = &f.space.graph;
    let is_written = |own: &Shown| simplify::length(g, own.value) <= WRITTEN;
    let mut shown = |own: Vec<Shown>| {
        let (short, long): (Vec<Shown>, Vec<Shown>) = own.into_iter().partition(is_written);
        equations(text, study, &short);
        for own in long {
            let signs = simplify::length(g, own.value);
            let _ = writeln!(text, "    {:<12} an expression of {signs} signs", own.of);
        }
    };
    shown(own.euler);
    for (pieces, conditions) in joined(&own.functional, own.boundary) {
        if conditions.is_empty() {
            continue;
        }
        shown(
            conditions
                .into_iter()
                .map(|own| Shown {
                    of: format!("{} on {}", own.of, pieces.join(", ")),
                    ..own
                })
                .collect(),
        );
    }
}

/// In index notation, then in components.
fn both(text: &mut String, study: &Study, indexed: &[Indexed], shown: &[Shown]) {
    let f = &study.problem.functional;
    let g = &f.space.graph;
    if indexed.is_empty() && shown.is_empty() {
        let _ = writeln!(
            text,
            "    nothing is free, or every coefficient vanishes identically"
        );
        return;
    }
    for own in indexed {
        let line = written_equation(&own.value, &f.scope, Format::Text);
        text.push_str(&terms(&format!("    {:<12} ", own.of), &line));
        if let Some(only_where) = &own.only_where {
            let _ = writeln!(text, "{:17}{only_where}", "");
        }
    }
    let longest = shown.iter().map(|own| simplify::length(g, own.value));
    let longest = longest.max().unwrap_or(0);
    if indexed.is_empty() {
        equations(text, study, shown);
    } else if longest <= WRITTEN {
        let _ = writeln!(text, "   in components");
        equations(text, study, shown);
    } else {
        let _ = writeln!(text, "   in components: in {}", place_of(longest));
    }
}

/// Where an expression stands that is too long for the terminal.
fn place_of(signs: u64) -> &'static str {
    if signs <= LEGIBLE {
        "the report"
    } else {
        "study.json"
    }
}

/// The levels of the family.
fn levels(text: &mut String, study: &Study, style: Style) {
    if study.problem.family.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{}", bold(style, "levels"));
    let rows = table::rows(&study.problem);
    let head = table::HEADINGS.map(str::to_lowercase);
    let widths: Vec<usize> = (0..head.len())
        .map(|k| {
            let own = rows.iter().map(|row| row.cells[k].chars().count());
            own.chain([head[k].chars().count()]).max().unwrap_or(0)
        })
        .collect();
    let mut line = |mark: &str, cells: &[String]| {
        let all: Vec<String> = cells
            .iter()
            .zip(&widths)
            .map(|(cell, &width)| format!("{cell:<width$}"))
            .collect();
        let _ = writeln!(text, "{mark} {}", all.join("  ").trim_end());
    };
    line(" ", &head);
    for row in &rows {
        line(if row.is_own { ">" } else { " " }, &row.cells);
    }
}

fn heading(text: &mut String, study: &Study, style: Style) {
    let f = &study.problem.functional;
    let level = f
        .level
        .as_ref()
        .map_or(String::new(), |level| format!(", level {level}"));
    let d = f.space.dimensions();
    let _ = writeln!(
        text,
        "{}: a functional in {d} dimension{}{level}",
        bold(style, &f.name),
        if d == 1 { "" } else { "s" }
    );
    for field in &f.fields {
        line(text, "varied", &described(f, field));
    }
    text.push_str(&terms("  density       ", &f.written));
    for piece in f.pieces.iter().filter(|piece| piece.written != "0") {
        text.push_str(&terms(&format!("  on {:<10} ", piece.name), &piece.written));
    }
    for own in used(f) {
        let formula = format!("{} = {}", own.name, own.written);
        text.push_str(&terms("  where         ", &formula));
    }
    for field in &f.data {
        line(text, "given", &described(f, field));
    }
    if let Some(values) = values(f) {
        line(text, "values", &values);
    }
    for own in &f.assumptions {
        line(text, "assumed", own);
    }
    for own in f.functions.iter().filter(|own| !own.description.is_empty()) {
        line(
            text,
            "function",
            &format!("{}: {}", own.name, own.description),
        );
    }
}

/// The values that the model gives parameters: claims are decided for them.
fn values(f: &Functional) -> Option<String> {
    let valued = f.parameters.iter().filter_map(|own| {
        let value = f.space.graph.text(own.value?);
        Some(format!("{} = {value}", own.name))
    });
    let values: Vec<String> = valued.collect();
    (!values.is_empty()).then(|| values.join(", "))
}

fn line(text: &mut String, label: &str, words: &str) {
    text.push_str(&hanging(&format!("  {label:<13} "), words));
}

/// A field in words: `u, a vector: displacement`.
fn described(f: &Functional, field: &Field) -> String {
    let on = field.on.as_ref();
    let on = on.map_or(String::new(), |on| format!(" on {on}"));
    let colon = if field.description.is_empty() {
        ""
    } else {
        ": "
    };
    let (name, kind, of) = (&field.name, kind(field.shape), dependence(f, field));
    format!("{name}, {kind}{of}{on}{colon}{}", field.description)
}

fn stated(text: &mut String, study: &Study, style: Style) {
    let f = &study.problem.functional;
    for (role, title) in [
        (Role::Imposed, "imposed"),
        (Role::Yielded, "stated to follow"),
    ] {
        let own = in_order(f, role);
        if own.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", bold(style, title));
        let widths = own.iter().map(|own| own.label.chars().count() + 2);
        let width = widths.max().unwrap_or(0);
        for equation in own {
            let on = equation
                .on
                .as_ref()
                .map_or(String::new(), |on| format!(" on {on}"));
            let multiplier = equation.multiplier.as_ref();
            let multiplier = multiplier.map_or(String::new(), |(m, _)| format!(", multiplier {m}"));
            let title = match equation.title.as_str() {
                "" => String::new(),
                title => format!(" ({title})"),
            };
            let first = format!("  {:<width$} ", format!("({})", equation.label));
            let whole = format!("{}{on}{title}{multiplier}", equation.written);
            text.push_str(&terms(&first, &whole));
        }
    }
}

fn equations(text: &mut String, study: &Study, all: &[Shown]) {
    let g = &study.problem.functional.space.graph;
    for shown in all {
        let signs = simplify::length(g, shown.value);
        let written = if signs > WRITTEN {
            format!("an expression of {signs} signs, in {}", place_of(signs))
        } else {
            format!("{} = 0", g.text(shown.value))
        };
        text.push_str(&terms(&format!("    {:<12} ", shown.of), &written));
    }
}

fn claims(text: &mut String, study: &Study, style: Style) {
    for decided in &study.verdicts {
        let mark = if decided.is_as_expected() { " " } else { "!" };
        let verdict = &decided.finding.verdict;
        let word = coloured(style, verdict.word());
        let line = format!("{mark} {}  {word}", decided.full_id());
        let _ = writeln!(text, "{}", line.trim_end());
        text.push_str(&hanging("      ", verdict.detail()));
        for formula in &decided.finding.formulas {
            if let Some(own) = &formula.indexed {
                let nothing = if own.text.is_empty() { "nothing" } else { "" };
                let line = format!("{}: {}{nothing}", formula.caption, own.text);
                text.push_str(&terms("      ", &line));
            }
        }
        if !decided.is_as_expected() {
            let expected = decided.expected.join(" or ");
            let _ = writeln!(text, "      the model expects: {expected}");
        }
    }
}
