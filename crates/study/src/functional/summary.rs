//! The text for a terminal.

use super::{boundary, euler, indexed_euler, indexed_natural, labels, table, Indexed, Shown};
use crate::summary::{bold, coloured, Style};
use chetaev_functionals::functional::Role;
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
            let _ = writeln!(text, "  not derived: {problem}");
            return;
        }
    };
    both(
        text,
        study,
        &indexed_euler(f, variation),
        &euler(f, variation),
    );
    let _ = writeln!(text, "\n{}", bold(style, "boundary conditions"));
    for (piece, conditions) in boundary(f, variation) {
        let _ = writeln!(text, "  on {piece}");
        let given = given(study, &piece);
        if !given.is_empty() {
            let _ = writeln!(text, "    given: {}", given.join(", "));
        }
        let indexed = indexed_natural(f, &piece).unwrap_or_default();
        both(text, study, &indexed, &conditions);
    }
}

/// In index notation, then in components; one of them where both are the same.
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
    let is_scalar = indexed.len() == shown.len() && indexed.iter().all(|own| !own.of.contains('_'));
    for own in indexed {
        let line = written_equation(&own.value, &f.scope, Format::Text);
        let _ = writeln!(text, "    {:<12} {line}", own.of);
    }
    let is_short = |own: &Shown| simplify::length(g, own.value) <= WRITTEN;
    if indexed.is_empty() || is_scalar && f.space.dimensions() > 1 {
        equations(text, study, shown);
    } else if !is_scalar && shown.iter().all(is_short) {
        let _ = writeln!(text, "   in components");
        equations(text, study, shown);
    } else if !is_scalar {
        let _ = writeln!(text, "   in components: in the report");
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
        let on = field
            .on
            .as_ref()
            .map_or(String::new(), |on| format!(" on {on}"));
        let _ = writeln!(
            text,
            "  varied        {} ({}{on}) {}",
            field.name,
            field.shape.word(),
            field.description
        );
    }
    let _ = writeln!(text, "  density       {}", f.written);
    for piece in &f.pieces {
        let _ = writeln!(text, "  on {:<10} {}", piece.name, piece.written);
    }
}

fn stated(text: &mut String, study: &Study, style: Style) {
    let f = &study.problem.functional;
    for (role, title) in [
        (Role::Imposed, "imposed"),
        (Role::Yielded, "stated to follow"),
    ] {
        if labels(f, role).is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", bold(style, title));
        for equation in f.with_role(role) {
            let on = equation
                .on
                .as_ref()
                .map_or(String::new(), |on| format!(" on {on}"));
            let multiplier = equation.multiplier.as_ref();
            let multiplier = multiplier.map_or(String::new(), |(m, _)| format!(", multiplier {m}"));
            let _ = writeln!(
                text,
                "  ({}) {}{on}  {}{multiplier}",
                equation.label, equation.written, equation.title
            );
        }
    }
}

fn given(study: &Study, piece: &str) -> Vec<String> {
    let f = &study.problem.functional;
    let own = f.piece(piece).map_or(&[][..], |own| &own.fixed);
    let name = |&(component, is_normal): &(usize, bool)| {
        let name = f.space.component_at(component).name;
        format!("{name}{}", if is_normal { ",n" } else { "" })
    };
    own.iter().map(name).collect()
}

fn equations(text: &mut String, study: &Study, all: &[Shown]) {
    let g = &study.problem.functional.space.graph;
    for shown in all {
        let signs = simplify::length(g, shown.value);
        let written = if signs > WRITTEN {
            format!("an expression of {signs} signs, in the report")
        } else {
            format!("{} = 0", g.text(shown.value))
        };
        let _ = writeln!(text, "    {:<12} {written}", shown.of);
    }
}

fn claims(text: &mut String, study: &Study, style: Style) {
    let ids = study.verdicts.iter().map(|d| d.full_id().chars().count());
    let width = ids.max().unwrap_or(0);
    for decided in &study.verdicts {
        let mark = if decided.is_as_expected() { " " } else { "!" };
        let verdict = &decided.finding.verdict;
        let _ = writeln!(
            text,
            "{mark} {:<width$} {}  {}",
            decided.full_id(),
            coloured(style, verdict.word()),
            verdict.detail()
        );
        for formula in &decided.finding.formulas {
            if let Some(own) = &formula.indexed {
                let _ = writeln!(text, "    {}: {}", formula.caption, own.text);
            }
        }
        if !decided.is_as_expected() {
            let _ = writeln!(
                text,
                "    the model expects: {}",
                decided.expected.join(" or ")
            );
        }
    }
}
