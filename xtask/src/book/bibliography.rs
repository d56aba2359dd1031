//! The sources of the book: `references.bib` as a page, and citations `[@key]` as links into it.

use std::collections::BTreeMap;

/// A work by its fields.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Work {
    fields: BTreeMap<String, String>,
}

/// Works by their keys.
pub(crate) type Works = BTreeMap<String, Work>;

/// Reads entries `@kind{key, field = {text}, …}`.
pub(crate) fn read(text: &str) -> Works {
    let mut works = Works::new();
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with('%'));
    let text: String = lines.flat_map(|line| [line, "\n"]).collect();
    for entry in text.split("\n@").map(|entry| entry.trim_start_matches('@')) {
        let Some((_, inside)) = entry.split_once('{') else {
            continue;
        };
        let Some((key, mut rest)) = inside.split_once(',') else {
            continue;
        };
        let mut work = Work::default();
        while let Some((name, value, after)) = field(rest) {
            work.fields.insert(name, value);
            rest = after;
        }
        works.insert(key.trim().to_owned(), work);
    }
    works
}

/// The next field, its text in letters, and what follows.
fn field(text: &str) -> Option<(String, String, &str)> {
    let (name, rest) = text.split_once('=')?;
    let name = name.trim().trim_start_matches(',').trim();
    let inside = rest.trim_start().strip_prefix('{')?;
    let mut depth = 1;
    let end = inside.char_indices().find_map(|(at, sign)| {
        match sign {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at)
    })?;
    Some((name.to_owned(), letters(&inside[..end]), &inside[end + 1..]))
}

/// Accents of TeX as letters, without braces.
fn letters(text: &str) -> String {
    const ACCENTS: &[(&str, &str)] = &[
        ("\\\"U", "Ü"),
        ("\\\"a", "ä"),
        ("\\\"o", "ö"),
        ("\\\"u", "ü"),
        ("\\'E", "É"),
        ("\\'S", "Ś"),
        ("\\'\\i", "í"),
        ("\\'a", "á"),
        ("\\'c", "ć"),
        ("\\'e", "é"),
        ("\\'o", "ó"),
        ("\\^e", "ê"),
        ("\\`a", "à"),
        ("\\`e", "è"),
        ("\\`o", "ò"),
        ("\\c c", "ç"),
        ("\\o", "ø"),
        ("--", "–"),
        ("\\&", "&"),
        ("{", ""),
        ("}", ""),
    ];
    let mut out = text.to_owned();
    for (written, letter) in ACCENTS {
        out = out.replace(written, letter);
    }
    out.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl Work {
    fn get(&self, field: &str) -> Option<&str> {
        self.fields.get(field).map(String::as_str)
    }

    /// "Maggi 1896", "Neimark and Fufaev 1972", "Bloch and others 2003".
    fn short(&self) -> String {
        let authors = self
            .get("author")
            .or(self.get("editor"))
            .unwrap_or("Unknown");
        let families: Vec<&str> = authors
            .split(" and ")
            .map(|name| name.split(',').next().unwrap_or(name).trim())
            .collect();
        let named = match families.as_slice() {
            [one] => (*one).to_owned(),
            [one, two] => format!("{one} and {two}"),
            [one, ..] => format!("{one} and others"),
            [] => "Unknown".into(),
        };
        match self.get("year") {
            Some(year) => format!("{named} {year}"),
            None => named,
        }
    }

    fn line(&self) -> String {
        let named = self
            .get("author")
            .or(self.get("editor"))
            .unwrap_or("Unknown");
        let mut parts = vec![named.replace(" and ", "; ")];
        parts.extend(self.get("title").map(|title| format!("*{title}*")));
        for field in ["journal", "booktitle", "school", "publisher", "edition"] {
            parts.extend(self.get(field).map(str::to_owned));
        }
        let volume = self.get("volume").map(|volume| format!("vol. {volume}"));
        parts.extend(volume);
        parts.extend(self.get("pages").map(|pages| format!("pp. {pages}")));
        parts.extend(self.get("year").map(str::to_owned));
        let mut line = parts.join(", ");
        if let Some(note) = self.get("note") {
            line.push_str(&format!(". {note}"));
        }
        line
    }
}

/// The page of all works.
pub(crate) fn page(works: &Works) -> String {
    let mut text = String::from("# Bibliography\n\n");
    for (key, work) in works {
        text.push_str(&format!("- <a id=\"{key}\"></a>{}\n", work.line()));
    }
    text
}

/// A text with its citations as links to the page at `place`, and the keys that are not known.
pub(crate) fn cited(text: &str, works: &Works, place: &str) -> (String, Vec<String>) {
    let (mut out, mut unknown) = (String::with_capacity(text.len()), Vec::new());
    let mut rest = text;
    while let Some(at) = rest.find("[@") {
        out.push_str(&rest[..at]);
        let inside = &rest[at + 1..];
        let Some(end) = inside.find(']') else {
            out.push_str(&rest[at..]);
            return (out, unknown);
        };
        let keys = inside[..end]
            .split(';')
            .map(|key| key.trim().trim_start_matches('@'));
        let links = keys.map(|key| match works.get(key) {
            Some(work) => format!("[{}]({place}#{key})", work.short()),
            None => {
                unknown.push(key.to_owned());
                format!("\\[{key}\\]")
            }
        });
        out.push_str(&links.collect::<Vec<_>>().join("; "));
        rest = &inside[end + 1..];
    }
    out.push_str(rest);
    (out, unknown)
}

#[cfg(test)]
mod tests {
    use super::{cited, page, read};

    #[test]
    fn sources_are_read_shown_and_linked() {
        let text = "% a remark\n\n@article{routh1905,\n  author = {Routh, E. J. and Voss, {\\\"U}.},\n  title = {Sur l'int{\\'e}gration},\n  pages = {1--6},\n  year = {1905},\n}\n";
        let works = read(text);
        let own = page(&works);
        assert!(own.contains("<a id=\"routh1905\"></a>Routh, E. J.; Voss, Ü., *Sur l'intégration*, pp. 1–6, 1905"), "{own}");
        let (linked, unknown) = cited("See [@routh1905] and [@nobody].", &works, "../b.md");
        assert_eq!(
            linked,
            "See [Routh and Voss 1905](../b.md#routh1905) and \\[nobody\\]."
        );
        assert_eq!(unknown, ["nobody"]);
    }
}
