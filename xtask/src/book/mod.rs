//! `cargo xtask book`: the book, the page of the model file and the theory as pages for a browser.
//!
//! mdBook makes the pages. What it does not know is done before, on a copy of the texts: mathematics becomes MathML, which browsers
//! show without a script and without a network, and citations become links into a bibliography.

mod bibliography;
mod links;
mod mathematics;

use crate::{cargo, err, out, refuse, status_of};
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str = "\
The book

Usage: cargo xtask book [--check]

Makes target/book/html of docs: the book, the page of the model file, the theory and the bibliography. Formulas are typeset as MathML when the
pages are made, so that nothing is loaded from a network when they are read. Installs mdBook into target/tools where it is missing.

  --check   only says what could not be typeset or cited; makes no pages, and needs no mdBook
  --help    this text
";

/// mdBook, which makes the pages. Its licence is MPL-2.0; it is a tool and no part of what is built.
const MDBOOK: &str = "0.5.4";

/// Runs the task.
pub(crate) fn run(words: &[String]) -> u8 {
    let is_check = match words {
        [] => false,
        [word] if word == "--check" => true,
        [word, ..] if word == "--help" || word == "-h" => {
            out(HELP);
            return 0;
        }
        [word, ..] => {
            return refuse(&format!(
                "unknown argument `{word}`; `cargo xtask book` takes `--check`"
            ))
        }
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let book = match Book::read(&root.join("docs")) {
        Ok(book) => book,
        Err(problem) => {
            err(&format!("error: the book: {problem}\n"));
            return 1;
        }
    };
    for problem in &book.problems {
        err(&format!("error: {problem}\n"));
    }
    if is_check || !book.problems.is_empty() {
        let pages = book.pages.len();
        out(&format!(
            "{pages} pages, {} problems\n",
            book.problems.len()
        ));
        return u8::from(!book.problems.is_empty());
    }
    match made(&root, &book) {
        Ok(page) => {
            out(&format!("{}\n", page.display()));
            0
        }
        Err(status) => status,
    }
}

/// The texts of the book, ready for mdBook.
pub(crate) struct Book {
    /// Paths relative to `docs`, with their texts.
    pub(crate) pages: Vec<(PathBuf, String)>,
    /// Pictures and other files, as they are.
    pub(crate) others: Vec<PathBuf>,
    /// What could not be typeset or cited, with its place.
    pub(crate) problems: Vec<String>,
    docs: PathBuf,
}

/// Folders and files of `docs` that are read.
const PARTS: [&str; 6] = [
    "book",
    "theory",
    "model-file.md",
    "study-json.md",
    "scene-json.md",
    "checked.md",
];

/// A file or folder that could not be read.
#[derive(Debug)]
pub(crate) struct Unreadable {
    path: PathBuf,
    problem: std::io::Error,
}

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.problem)
    }
}

impl Book {
    pub(crate) fn read(docs: &Path) -> Result<Book, Unreadable> {
        let mut book = Book {
            pages: Vec::new(),
            others: Vec::new(),
            problems: Vec::new(),
            docs: docs.to_path_buf(),
        };
        let unreadable = |path: &Path, problem| Unreadable {
            path: path.to_path_buf(),
            problem,
        };
        let of_file = |path: &Path| std::fs::read_to_string(path).map_err(|e| unreadable(path, e));
        let works = bibliography::read(&of_file(&docs.join("references.bib"))?);
        let mut open: Vec<PathBuf> = PARTS.iter().map(PathBuf::from).collect();
        while let Some(part) = open.pop() {
            let path = docs.join(&part);
            if path.is_dir() {
                let entries = std::fs::read_dir(&path).map_err(|e| unreadable(&path, e))?;
                open.extend(
                    entries
                        .filter_map(Result::ok)
                        .map(|entry| part.join(entry.file_name())),
                );
            } else if part.extension().is_some_and(|e| e == "md") {
                let text = of_file(&path)?;
                if part != Path::new("book/SUMMARY.md") {
                    book.add(part, &text, &works);
                }
            } else {
                book.others.push(part);
            }
        }
        let summary = contents(&of_file(&docs.join("book/SUMMARY.md"))?, &book.theory());
        book.pages.push(("index.md".into(), FIRST_PAGE.to_owned()));
        links::keep_inside(&mut book.pages, &book.others);
        book.pages.push(("SUMMARY.md".into(), summary));
        book.pages
            .push(("bibliography.md".into(), bibliography::page(&works)));
        book.pages.sort();
        Ok(book)
    }

    /// A page, typeset and with its citations resolved.
    fn add(&mut self, path: PathBuf, text: &str, works: &bibliography::Works) {
        let (typeset, mut problems) = mathematics::typeset(text);
        let depth = path.components().count() - 1;
        let place = format!("{}bibliography.md", "../".repeat(depth));
        let (cited, unknown) = bibliography::cited(&typeset, works, &place);
        problems.extend(
            unknown
                .into_iter()
                .map(|key| format!("`{key}` is not in references.bib")),
        );
        let named = problems.into_iter();
        self.problems
            .extend(named.map(|problem| format!("docs/{}: {problem}", path.display())));
        self.pages.push((path, cited));
    }

    /// The pages of theory in order, with their titles.
    fn theory(&self) -> Vec<(String, String)> {
        let pages = self.pages.iter();
        let mut own: Vec<(String, String)> = pages
            .filter(|(path, _)| path.starts_with("theory"))
            .filter_map(|(path, text)| {
                let title = text.lines().find_map(|line| line.strip_prefix("# "))?;
                Some((path.display().to_string(), title.to_owned()))
            })
            .collect();
        own.sort();
        own
    }

    fn write(&self, folder: &Path) -> std::io::Result<()> {
        for (path, text) in &self.pages {
            let own = folder.join(path);
            own.parent().map_or(Ok(()), std::fs::create_dir_all)?;
            std::fs::write(own, text)?;
        }
        for path in &self.others {
            let own = folder.join(path);
            own.parent().map_or(Ok(()), std::fs::create_dir_all)?;
            std::fs::copy(self.docs.join(path), own)?;
        }
        Ok(())
    }
}

/// The page that a browser opens first.
const FIRST_PAGE: &str = "# Chetaev

A model file goes in. Equations of motion in every classical form come out, proved equal, with verdicts on claims, trajectories and a report.

- [The first hour](book/first-hour.md) is the place to begin, or, with bodies and wheels, [From a wheel to its equations](book/from-a-wheel-to-its-equations.md).
- [The model file](model-file.md) has every part of a model with an example.
- [Formulations](book/formulations.md) has every form of the equations with its rule.
- [The theory](theory/README.md) has what the program cites.
";

/// The contents: the book with its chapters below its folder, then the model file, the theory and the bibliography.
fn contents(summary: &str, theory: &[(String, String)]) -> String {
    let chapters = summary.replace("](", "](book/");
    let chapters = chapters.trim_end();
    let mut text = match chapters.split_once("\n\n") {
        Some((title, chapters)) => format!("{title}\n\n[Chetaev](index.md)\n\n{chapters}"),
        None => chapters.to_owned(),
    };
    text.push_str("\n\n# Reference\n\n- [The model file](model-file.md)\n- [The record of a study](study-json.md)\n- [The picture as data](scene-json.md)\n- [What an independent checker confirms](checked.md)\n\n# Theory\n\n");
    for (path, title) in theory {
        text.push_str(&format!("- [{title}]({path})\n"));
    }
    text.push_str("\n# Sources\n\n- [Bibliography](bibliography.md)\n");
    text
}

/// Writes the texts beside each other and lets mdBook make the pages; the first of them.
fn made(root: &Path, book: &Book) -> Result<PathBuf, u8> {
    let failed = |problem: std::io::Error| {
        err(&format!("error: the book: {problem}\n"));
        1
    };
    let folder = root.join("target/book");
    // What a page was called before is not left beside the others.
    let _ = std::fs::remove_dir_all(folder.join("src"));
    book.write(&folder.join("src")).map_err(failed)?;
    std::fs::write(folder.join("book.toml"), CONFIGURATION).map_err(failed)?;
    let program = mdbook(root)?;
    match Command::new(program).arg("build").arg(&folder).status() {
        Ok(status) if status.success() => Ok(folder.join("html/index.html")),
        Ok(status) => Err(status_of(status).max(1)),
        Err(problem) => Err(failed(problem)),
    }
}

/// No script of another server, no search index to be fetched by a page that lies on a disk.
const CONFIGURATION: &str = "\
[book]
title = \"Chetaev\"
language = \"en\"
src = \"src\"

[build]
build-dir = \"html\"
create-missing = false

[output.html]
mathjax-support = false
";

/// The program, installed where it is missing.
fn mdbook(root: &Path) -> Result<PathBuf, u8> {
    let tools = root.join("target/tools");
    let program = tools.join(format!("bin/mdbook{}", std::env::consts::EXE_SUFFIX));
    let version = Command::new(&program).arg("--version").output();
    let is_there = version.is_ok_and(|o| String::from_utf8_lossy(&o.stdout).contains(MDBOOK));
    if is_there {
        return Ok(program);
    }
    let mut install = cargo();
    install.args([
        "install",
        "mdbook",
        "--locked",
        "--no-default-features",
        "--features",
        "search",
    ]);
    install.args(["--version", MDBOOK, "--root"]).arg(&tools);
    match install.status() {
        Ok(status) if status.success() => Ok(program),
        Ok(status) => {
            err(&format!("error: mdBook {MDBOOK} was not installed into {}; `cargo xtask book --check` needs none\n", tools.display()));
            Err(status_of(status).max(1))
        }
        Err(problem) => {
            err(&format!("error: cargo could not be run: {problem}\n"));
            Err(1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Book;
    use std::path::Path;

    /// Every formula of the book is typeset, and every source that it cites is in the bibliography.
    #[test]
    fn the_book_is_typeset_and_its_sources_are_there() {
        let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
        let book = Book::read(&docs).unwrap_or_else(|problem| panic!("{problem}"));
        assert_eq!(book.problems, Vec::<String>::new());
        let page = |name: &str| {
            let found = book.pages.iter().find(|(path, _)| path == Path::new(name));
            &found.unwrap_or_else(|| panic!("{name} is missing")).1
        };
        let maggi = page("book/formulations/maggi.md");
        assert!(maggi.contains("<math") && !maggi.contains("$$"));
        assert!(maggi.contains("](../../bibliography.md#maggi1896)"));
        assert!(page("bibliography.md").contains("<a id=\"maggi1896\"></a>"));
        let contents = page("SUMMARY.md");
        for own in [
            "book/formulations/maggi.md",
            "model-file.md",
            "theory/0-notation.md",
        ] {
            assert!(contents.contains(&format!("]({own})")), "{own}");
        }
        // Nothing is loaded from elsewhere.
        for (path, text) in &book.pages {
            assert!(!text.contains("<script"), "{}", path.display());
        }
    }
}
