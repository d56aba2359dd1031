//! A derivation as text, and as a document of LaTeX.

use super::{options, words, Board, BoardStep};
use crate::written::latex::{document, escaped};
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
                text.push_str(&document.latex_display());
            }
        }
    }
    text.push('\n');
    text
}

/// A sentence whose formulas are typeset: words with an index, a prime, a sign or a Greek letter.
fn prose(words: &str) -> String {
    let words: Vec<&str> = words.split(' ').collect();
    let groups = words.chunk_by(|a, b| is_formula(a) == is_formula(b) && !ends_a_clause(a));
    let groups = groups.map(|group| {
        let all = group.join(" ");
        if !is_formula(group[0]) {
            return escaped(&all);
        }
        let own = all.trim_end_matches(PUNCTUATION);
        format!("${}${}", mathematics(own), &all[own.len()..])
    });
    groups.collect::<Vec<_>>().join(" ")
}

const PUNCTUATION: [char; 4] = ['.', ',', ';', ':'];

fn ends_a_clause(word: &str) -> bool {
    word.ends_with(PUNCTUATION)
}

fn is_formula(word: &str) -> bool {
    let own = word.trim_end_matches(PUNCTUATION);
    let is_greek = |sign: char| ('α'..='ω').contains(&sign) || ('Α'..='Ω').contains(&sign);
    let has_sign = own.contains(['^', '_', '=', '∂', '−', '*']) || own.ends_with('\'');
    let is_letter = own.chars().count() == 1 && own != "a" && own != "I";
    has_sign || own.contains(is_greek) || is_letter
}

/// A formula written on one line, with indices of one letter.
fn mathematics(words: &str) -> String {
    let letter = |sign: char| match sign {
        '\'' | '(' | ')' => sign.to_string(),
        '*' => "^*".to_owned(),
        ' ' => " ".to_owned(),
        sign => format!("{{{}}}", escaped(&sign.to_string()).replace('$', "")),
    };
    let mut out = String::new();
    for sign in words.chars() {
        match sign {
            '^' | '_' => out.push(sign),
            sign => out.push_str(&letter(sign)),
        }
    }
    out
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
    fn formulas_in_sentences_are_typeset() {
        let own = prose("It is Σ B^i_σ of P'.");
        assert_eq!(own, "It is ${\\Sigma} {B}^{i}_{\\sigma}$ of ${P}'$.");
        assert_eq!(prose("no formula, Lagrange's"), "no formula, Lagrange's");
    }
}
