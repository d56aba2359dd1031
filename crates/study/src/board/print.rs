//! A derivation as text, and as a document of LaTeX.

use super::{options, words, Board, BoardStep};
use crate::written::latex::{document, escaped, numbered};
use crate::written::{NotWritten, Notation};
use chetaev_mechanics::System;
use chetaev_symbolic::print::{Document, Format};

/// The derivations of several formulations.
pub(super) fn text(
    system: &System,
    boards: &[Board],
    notation: Notation,
) -> Result<String, NotWritten> {
    match notation {
        Notation::Text => Ok(boards.iter().map(|board| plain(system, board)).collect()),
        Notation::Latex => {
            let parts: String = boards.iter().map(|board| typeset(system, board)).collect();
            Ok(document(system, &parts))
        }
        _ => Err(NotWritten::StepsAsText),
    }
}

fn plain(system: &System, board: &Board) -> String {
    let options = options(system, board);
    let mut text = format!(
        "{}, step by step\n{}\n",
        board.card.title,
        words::checked(board)
    );
    for (number, step) in board.steps.iter().enumerate() {
        let own = words::of(step.kind);
        text.push_str(&format!("\n{}. {}\n", number + 1, own.title));
        if let Some(schema) = own.schema {
            text.push_str(&format!("   [{}]\n", schema.text));
        }
        let lines = match said(step) {
            Some(sentence) => sentence,
            None => {
                let document = Document::equations(&system.graph, &step.pairs, &options);
                document.render(Format::Text).trim_end().to_owned()
            }
        };
        for line in lines.lines() {
            text.push_str(&format!("     {line}\n"));
        }
        text.push_str(&format!("   {}\n", own.reason));
    }
    text.push('\n');
    text
}

fn typeset(system: &System, board: &Board) -> String {
    let options = options(system, board);
    let mut text = format!(
        "\\section*{{{}, step by step}}\n{}\n",
        escaped(board.card.title),
        escaped(&words::checked(board))
    );
    for (number, step) in board.steps.iter().enumerate() {
        let own = words::of(step.kind);
        text.push_str(&format!(
            "\n\\paragraph{{{}. {}}}\n{}\n",
            number + 1,
            escaped(own.title),
            prose(own.reason)
        ));
        if let Some(schema) = own.schema {
            text.push_str(&format!("General form:\n\\[ {} \\]\n", schema.latex));
        }
        match said(step) {
            Some(sentence) => text.push_str(&format!("{}\n", escaped(&sentence))),
            None => {
                let document = Document::equations(&system.graph, &step.pairs, &options);
                text.push_str(&numbered(document.render(Format::Latex).trim_end()));
            }
        }
    }
    text.push('\n');
    text
}

/// A sentence with indices of one letter, `B^i_σ`, set as such.
fn prose(words: &str) -> String {
    let mut out = String::new();
    let mut rest = words;
    while let Some(at) = rest.find(['^', '_']) {
        let (sign, index) = (&rest[at..=at], rest[at + 1..].chars().next());
        let Some(index) = index.filter(|c| c.is_alphabetic()) else {
            break;
        };
        let letter = escaped(&index.to_string()).replace('$', "");
        out.push_str(&format!("{}${sign}{{{letter}}}$", escaped(&rest[..at])));
        rest = &rest[at + 1 + index.len_utf8()..];
    }
    out + &escaped(rest)
}

/// The sentence in the place of formulas.
pub(super) fn said(step: &BoardStep) -> Option<String> {
    words::not_written(&step.checked)
        .or_else(|| step.pairs.is_empty().then(|| words::ALL_VANISH.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::prose;

    #[test]
    fn indices_in_sentences_are_typeset() {
        let own = prose("Σ B^i_σ of P'");
        assert_eq!(own, "$\\Sigma$ B$^{i}$$_{\\sigma}$ of P'");
        assert_eq!(prose("no index: 2^3"), "no index: 2\\^{}3");
    }
}
