//! Diagnostics as text for a person and as data for a program.

use std::fmt::Write;

use chetaev_symbolic::syntax::Severity;
use serde::Serialize;

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::source::{Place, Sources};

/// How text is decorated.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Style {
    /// Letters only.
    Plain,
    /// With the color codes of a terminal (ECMA-48).
    Ansi,
}

impl Style {
    fn paint(self, code: &str, words: &str) -> String {
        match self {
            Style::Plain => words.to_owned(),
            Style::Ansi => format!("\u{1b}[{code}m{words}\u{1b}[0m"),
        }
    }

    fn severity(self, severity: Severity, words: &str) -> String {
        let code = match severity {
            Severity::Error => "1;31",
            Severity::Warning => "1;33",
            Severity::Note => "1;36",
        };
        self.paint(code, words)
    }
}

/// Every problem, and a last line that counts them.
pub(crate) fn all(diagnostics: &Diagnostics, style: Style) -> String {
    let mut out = String::new();
    for diagnostic in &diagnostics.list {
        out += &one(diagnostic, &diagnostics.sources, style);
        out.push('\n');
    }
    let count = |severity| {
        diagnostics
            .list
            .iter()
            .filter(|diagnostic| diagnostic.severity == severity)
            .count()
    };
    let mut parts = Vec::new();
    for severity in [Severity::Error, Severity::Warning, Severity::Note] {
        match count(severity) {
            0 => {}
            1 => parts.push(format!("1 {}", severity.word())),
            many => parts.push(format!("{many} {}s", severity.word())),
        }
    }
    out += &parts.join(", ");
    out
}

/// One problem: its message, the line with the offending text underlined, other places, advice.
fn one(diagnostic: &Diagnostic, sources: &Sources, style: Style) -> String {
    let mut out = String::new();
    let head = format!("{}[{}]", diagnostic.severity.word(), diagnostic.code);
    let _ = writeln!(
        out,
        "{}: {}",
        style.severity(diagnostic.severity, &head),
        style.paint("1", &diagnostic.message)
    );
    let last_line = diagnostic
        .related
        .iter()
        .map(|(place, _)| *place)
        .chain([diagnostic.place])
        .map(|place| sources.line_column(place.source, place.span.start).line)
        .max()
        .unwrap_or(1);
    let width = last_line.to_string().len();
    excerpt(
        &mut out,
        diagnostic.place,
        &diagnostic.label,
        '^',
        width,
        sources,
        style,
        diagnostic.severity,
    );
    for (place, words) in &diagnostic.related {
        excerpt(
            &mut out,
            *place,
            words,
            '-',
            width,
            sources,
            style,
            Severity::Note,
        );
    }
    for hint in &diagnostic.hints {
        let _ = writeln!(
            out,
            "{:width$} {} {hint}",
            "",
            style.paint("1;36", "= help:")
        );
    }
    if let Some(fixed) = fixed_line(diagnostic, sources) {
        let _ = writeln!(
            out,
            "{:width$} {} {fixed}",
            "",
            style.paint("1;36", "= try: ")
        );
    }
    out
}

#[allow(clippy::too_many_arguments)] // one private helper, called twice
fn excerpt(
    out: &mut String,
    place: Place,
    label: &str,
    mark: char,
    width: usize,
    sources: &Sources,
    style: Style,
    severity: Severity,
) {
    let source = sources.get(place.source);
    let at = sources.line_column(place.source, place.span.start);
    let arrow = if mark == '^' { "-->" } else { ":::" };
    let _ = writeln!(
        out,
        "{:width$}{} {}:{}:{}",
        "",
        style.paint("1;34", arrow),
        source.name,
        at.line,
        at.column
    );
    let line = pictured(line_around(&source.text, place.span.start));
    let marked = place.span.text(&source.text).lines().next().unwrap_or("");
    let window = Window::around(&line, at.column - 1, columns(marked).max(1));
    let marks: String = std::iter::repeat_n(mark, window.marks).collect();
    let bar = style.paint("1;34", "|");
    let number = style.paint("1;34", &format!("{:>width$}", at.line));
    let _ = writeln!(out, "{:width$} {bar}", "");
    let _ = writeln!(out, "{number} {bar} {}", window.text);
    let under = format!("{marks} {label}");
    let blank = " ".repeat(columns(&window.before));
    let _ = writeln!(
        out,
        "{:width$} {bar} {blank}{}",
        "",
        style.severity(severity, under.trim_end())
    );
}

/// The part of a line that is shown: all of it, or what is around the mark.
struct Window {
    text: String,
    /// What stands before the mark.
    before: String,
    marks: usize,
}

impl Window {
    /// `start` counts characters.
    fn around(line: &str, start: usize, marks: usize) -> Window {
        const MOST: usize = 200;
        const BEFORE: usize = 60;
        let length = line.chars().count();
        let first = if length <= MOST {
            0
        } else {
            start.saturating_sub(BEFORE).min(length - MOST)
        };
        let cut = if first > 0 { "…" } else { "" };
        let more = if first + MOST < length { "…" } else { "" };
        let shown: String = line.chars().skip(first).take(MOST).collect();
        let before: String = line.chars().skip(first).take(start - first).collect();
        Window {
            before: format!("{cut}{before}"),
            marks: marks.min(MOST - (start - first).min(MOST - 1)),
            text: format!("{cut}{shown}{more}"),
        }
    }
}

/// The line with the suggestion carried out, where it stands on one line.
fn fixed_line(diagnostic: &Diagnostic, sources: &Sources) -> Option<String> {
    let suggestion = diagnostic.suggestion.as_ref()?;
    let text = &sources.get(suggestion.place.source).text;
    let span = suggestion.place.span;
    let start = text.get(..span.start)?.rfind('\n').map_or(0, |at| at + 1);
    let end = span.end
        + text
            .get(span.end..)?
            .find('\n')
            .unwrap_or(text.len() - span.end);
    if span.text(text).contains('\n') {
        return None;
    }
    Some(
        format!(
            "{}{}{}",
            &text[start..span.start],
            suggestion.replacement,
            &text[span.end..end]
        )
        .trim()
        .to_owned(),
    )
}

fn line_around(text: &str, at: usize) -> &str {
    let at = at.min(text.len());
    let start = text
        .get(..at)
        .and_then(|before| before.rfind('\n'))
        .map_or(0, |newline| newline + 1);
    text.get(start..)
        .and_then(|rest| rest.lines().next())
        .unwrap_or("")
}

/// A line with a blank for each tab and a picture for every other control character, which a terminal would obey.
fn pictured(line: &str) -> String {
    line.chars()
        .map(|sign| match sign {
            '\t' => ' ',
            '\0'..='\u{1f}' => char::from_u32(0x2400 + sign as u32).unwrap_or(' '),
            '\u{7f}' => '\u{2421}',
            '\u{80}'..='\u{9f}' => '\u{fffd}',
            sign => sign,
        })
        .collect()
}

/// Columns of a terminal: combining signs take none, East Asian wide letters two.
fn columns(text: &str) -> usize {
    text.chars()
        .map(|sign| match sign as u32 {
            0x300..=0x36f | 0x200b..=0x200f | 0x20d0..=0x20ff | 0xfe00..=0xfe0f => 0,
            0x1100..=0x115f
            | 0x2e80..=0xa4cf
            | 0xac00..=0xd7a3
            | 0xf900..=0xfaff
            | 0xfe30..=0xfe6f
            | 0xff00..=0xff60
            | 0x1f300..=0x1faff => 2,
            _ => 1,
        })
        .sum()
}

/// A diagnostic as plain data, lines and columns from 1, for `--json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct DiagnosticData {
    /// `error`, `warning` or `note`.
    pub severity: &'static str,
    /// Stable identifier.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// Where.
    pub at: PlaceData,
    /// The words under the offending text.
    pub label: String,
    /// Other places, with their words.
    pub related: Vec<RelatedData>,
    /// Advice.
    pub hints: Vec<String>,
    /// A replacement that would solve the problem.
    pub suggestion: Option<SuggestionData>,
}

/// A place as plain data. Lines and columns are from 1 and columns count characters; the end is one past the last.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PlaceData {
    /// Name of the file.
    pub file: String,
    /// Line of the first character.
    pub line: usize,
    /// Column of the first character.
    pub column: usize,
    /// Line of the end.
    pub end_line: usize,
    /// Column of the end.
    pub end_column: usize,
    /// First byte, from 0.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// The text there.
    pub text: String,
}

/// Another place that matters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RelatedData {
    /// Where.
    pub at: PlaceData,
    /// What about it.
    pub message: String,
}

/// A replacement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SuggestionData {
    /// What to replace.
    pub at: PlaceData,
    /// What to write there.
    pub replacement: String,
}

impl Diagnostics {
    /// The problems as plain data.
    pub fn to_data(&self) -> Vec<DiagnosticData> {
        self.list
            .iter()
            .map(|diagnostic| DiagnosticData {
                severity: diagnostic.severity.word(),
                code: diagnostic.code,
                message: diagnostic.message.clone(),
                at: place_data(diagnostic.place, &self.sources),
                label: diagnostic.label.clone(),
                related: diagnostic
                    .related
                    .iter()
                    .map(|(place, words)| RelatedData {
                        at: place_data(*place, &self.sources),
                        message: words.clone(),
                    })
                    .collect(),
                hints: diagnostic.hints.clone(),
                suggestion: diagnostic
                    .suggestion
                    .as_ref()
                    .map(|suggestion| SuggestionData {
                        at: place_data(suggestion.place, &self.sources),
                        replacement: suggestion.replacement.clone(),
                    }),
            })
            .collect()
    }
}

fn place_data(place: Place, sources: &Sources) -> PlaceData {
    let start = sources.line_column(place.source, place.span.start);
    let end = sources.line_column(place.source, place.span.end);
    PlaceData {
        file: sources.get(place.source).name.clone(),
        line: start.line,
        column: start.column,
        end_line: end.line,
        end_column: end.column,
        start: place.span.start,
        end: place.span.end,
        text: sources.text(place).to_owned(),
    }
}
