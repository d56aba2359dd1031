//! Texts a model is made of, and places in them.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use chetaev_symbolic::syntax::Span;

/// Number of a text in its [`Sources`].
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceId(pub(crate) usize);

/// One text: the model file, an included file, or an override given on the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The path as it was given, or a stand-in such as `--set a=0.3`.
    pub name: String,
    /// The whole text.
    pub text: String,
}

/// All texts of one model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    list: Vec<Source>,
    lines: Vec<Lines>,
}

/// Where the lines of a text begin, found when it is first asked for.
#[derive(Clone, Debug, Default)]
struct Lines(OnceLock<Vec<usize>>);

/// It follows from the text.
impl PartialEq for Lines {
    fn eq(&self, _: &Lines) -> bool {
        true
    }
}

impl Eq for Lines {}

impl Lines {
    fn of(&self, text: &str) -> &[usize] {
        self.0.get_or_init(|| {
            let after = text.match_indices('\n').map(|(at, _)| at + 1);
            std::iter::once(0).chain(after).collect()
        })
    }
}

/// A range of bytes of one text.
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Which text.
    pub source: SourceId,
    /// Where in it.
    pub span: Span,
}

/// A position as a person counts it: both from 1, columns in characters.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LineColumn {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl Sources {
    /// Adds a text.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> SourceId {
        self.list.push(Source {
            name: name.into(),
            text: text.into(),
        });
        self.lines.push(Lines::default());
        SourceId(self.list.len() - 1)
    }

    /// The text of a number; the empty text where there is none.
    pub fn get(&self, id: SourceId) -> &Source {
        const EMPTY: &Source = &Source {
            name: String::new(),
            text: String::new(),
        };
        self.list.get(id.0).unwrap_or(EMPTY)
    }

    /// All texts, in the order in which they were read.
    pub fn iter(&self) -> impl Iterator<Item = &Source> {
        self.list.iter()
    }

    /// The words at a place.
    pub fn text(&self, place: Place) -> &str {
        place.span.text(&self.get(place.source).text)
    }

    /// Line and column of a byte of a text.
    pub fn line_column(&self, source: SourceId, byte: usize) -> LineColumn {
        let text = &self.get(source).text;
        let none = Lines::default();
        let lines = self.lines.get(source.0).unwrap_or(&none).of(text);
        let line = lines.partition_point(|&start| start <= byte.min(text.len()));
        let start = lines.get(line.saturating_sub(1)).copied().unwrap_or(0);
        let before = text.get(start..byte.min(text.len())).unwrap_or("");
        LineColumn {
            line: line.max(1),
            column: before.chars().count() + 1,
        }
    }
}

/// Where included files come from. The crate itself touches no file system.
pub trait Files {
    /// The text of a file. The path is that of the including file joined with the one it names, `/` between parts.
    ///
    /// # Errors
    /// What prevented it, in words for a person.
    fn read(&self, path: &str) -> Result<String, String>;
}

/// No files at all: every include is an error.
#[derive(Copy, Clone, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _path: &str) -> Result<String, String> {
        Err("no other files can be read here".to_owned())
    }
}

impl Files for BTreeMap<String, String> {
    fn read(&self, path: &str) -> Result<String, String> {
        self.get(path)
            .cloned()
            .ok_or_else(|| "there is no such file".to_owned())
    }
}

/// The path of a file named in another: relative to the folder of that file, with `.` and `..` worked out.
pub fn joined(including: &str, named: &str) -> String {
    let named = named.replace('\\', "/");
    if named.starts_with('/') || named.get(1..3) == Some(":/") {
        return named;
    }
    let including = including.replace('\\', "/");
    let rooted = including.starts_with('/');
    let mut parts: Vec<&str> = including
        .split('/')
        .filter(|part| !part.is_empty() && *part != ".")
        .collect();
    parts.pop();
    for part in named.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    format!("{}{}", if rooted { "/" } else { "" }, parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_to_the_including_file() {
        assert_eq!(
            joined("gallery/trailer/model.toml", "base.toml"),
            "gallery/trailer/base.toml"
        );
        assert_eq!(
            joined("gallery/trailer/model.toml", "../common/base.toml"),
            "gallery/common/base.toml"
        );
        assert_eq!(joined("model.toml", "./base.toml"), "base.toml");
        assert_eq!(joined("/a/model.toml", "../base.toml"), "/base.toml");
        assert_eq!(joined("model.toml", "../base.toml"), "../base.toml");
        assert_eq!(joined("a/model.toml", "/b.toml"), "/b.toml");
    }

    #[test]
    fn lines_and_columns_count_characters() {
        let mut sources = Sources::default();
        let id = sources.add("m", "aθ'b\nx");
        assert_eq!(
            sources.line_column(id, 4),
            LineColumn { line: 1, column: 4 }
        );
        assert_eq!(
            sources.line_column(id, 6),
            LineColumn { line: 2, column: 1 }
        );
    }
}
