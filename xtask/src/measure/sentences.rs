//! Sentences for users: string literals of several words.

use super::source::{ModulePath, Modules, Source};

/// Fewer words may be a name, a heading or a key.
const WORDS: usize = 4;

/// The one place for what a user reads, in whichever crate.
const PLACE: &str = "words";

/// Numbers of sentences and of their characters outside the place for them.
pub(crate) fn outside(modules: &Modules) -> (usize, usize) {
    let is_outside = |path: &ModulePath| !path.iter().any(|name| name == PLACE);
    let sources = modules.iter().filter(|(path, _)| is_outside(path));
    let found: Vec<usize> = sources.flat_map(|(_, source)| of(source)).collect();
    (found.len(), found.iter().sum())
}

/// The lengths of the sentences of a source.
fn of(source: &Source) -> impl Iterator<Item = usize> + '_ {
    let sentences = source.literals.iter().filter(|text| words(text) >= WORDS);
    sentences.map(|text| text.chars().count())
}

/// Words are of two letters at least and of nothing else, with signs of punctuation around them.
fn words(text: &str) -> usize {
    let is_word = |word: &&str| {
        let word = word.trim_matches(|c: char| ",.:;()`?!".contains(c));
        let letters = word.chars().filter(|c| c.is_alphabetic()).count();
        letters > 1 && word.chars().all(|c| c.is_alphabetic() || "-'".contains(c))
    };
    text.split_whitespace().filter(is_word).count()
}

#[cfg(test)]
mod tests {
    use super::super::source::read;
    use super::*;

    #[test]
    fn sentences_are_told_from_names_and_formulas() {
        let text = "fn f() { g(\"the motion stops at {t}, as the constraint ends\", \"x + y - a b\", \"model.toml\", \"model\") }";
        let modules = Modules::from([
            (vec!["a".to_owned()], read(text).0),
            (vec!["words".to_owned()], read(text).0),
        ]);
        assert_eq!(outside(&modules), (1, 47));
    }
}
