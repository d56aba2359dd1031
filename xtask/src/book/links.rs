//! Links of the pages: those that lead out of the book have no page in a browser, and only their words are kept.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

/// Keeps of links to what is not in the book the words alone.
pub(crate) fn keep_inside(pages: &mut [(PathBuf, String)], others: &[PathBuf]) {
    let mut known: BTreeSet<PathBuf> = others.iter().cloned().collect();
    known.extend(pages.iter().map(|(path, _)| path.clone()));
    known.insert("bibliography.md".into());
    for (path, text) in pages {
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        *text = inside(text, |target| known.contains(&joined(&folder, target)));
    }
}

fn inside(text: &str, is_known: impl Fn(&str) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("](") {
        let Some(end) = rest[at..].find(')').map(|end| at + end) else {
            break;
        };
        let target = &rest[at + 2..end];
        let page = target.split('#').next().unwrap_or(target);
        let is_kept = page.is_empty() || page.contains(':') || is_known(page);
        // Where the words of the link begin; what is no link has no beginning.
        let words = rest[..at].rfind('[').filter(|_| !is_kept);
        match words {
            Some(begin) => {
                out.push_str(&rest[..begin]);
                out.push_str(&rest[begin + 1..at]);
            }
            None => out.push_str(&rest[..=end]),
        }
        rest = &rest[end + 1..];
    }
    out.push_str(rest);
    out
}

/// A path relative to a folder, without steps up.
fn joined(folder: &Path, target: &str) -> PathBuf {
    let mut path = PathBuf::new();
    for part in folder.join(target).components() {
        match part {
            Component::ParentDir => {
                if !path.pop() {
                    return PathBuf::from("..");
                }
            }
            Component::CurDir => {}
            part => path.push(part),
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::inside;

    #[test]
    fn links_that_lead_out_keep_their_words() {
        let text = "See [a](a.md#b), [the checker](../checker/x.py) and [c](https://c.org) f(x).";
        let found = inside(text, |target| target == "a.md");
        assert_eq!(
            found,
            "See [a](a.md#b), the checker and [c](https://c.org) f(x)."
        );
    }
}
