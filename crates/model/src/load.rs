//! From text to model: includes followed, overrides laid over.

use std::collections::BTreeMap;

use chetaev_symbolic::syntax::Span;

use crate::bodies;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::format;
use crate::model::{Model, ModelText};
use crate::raw::{self, Kind, Raw, Table};
use crate::resolve::{self, Override};
use crate::source::{joined, Files, Place, SourceId, Sources};
use crate::text::Text;
use crate::toml;

/// Most files that one model reads; one that is included twice counts twice.
const MOST_FILES: usize = 100;
/// Most bytes of all of them together.
const MOST_BYTES: usize = 16 << 20;

/// What reading a model gives: the model where it has no error, and everything there is to say about it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The model; none where there is an error.
    pub model: Option<Model>,
    /// Errors, warnings and notes with the texts they are about.
    pub diagnostics: Diagnostics,
}

impl Loaded {
    /// The model with its warnings.
    ///
    /// # Errors
    /// All problems, where one of them is an error.
    pub fn into_result(self) -> Result<(Model, Diagnostics), Diagnostics> {
        match self.model {
            Some(model) => Ok((model, self.diagnostics)),
            None => Err(self.diagnostics),
        }
    }
}

/// Reads a model.
///
/// `path` names the text in diagnostics, and included files are sought relative to it. `overrides` are pairs of the
/// name of a parameter or size and its new value, an exact expression such as `0.3` or `1/3`; `initial.x'` names the initial value of `x'`.
pub fn load(path: &str, text: &str, files: &dyn Files, overrides: &[(String, String)]) -> Loaded {
    let mut loader = Loader::new(path, text, files, overrides);
    let source = loader.sources.add(path, text);
    let mut table = loader.file(path, text, source);
    if let Some(kind) = table.as_mut().and_then(|table| table.remove("kind")) {
        if let Some(problem) = other_kind(&kind) {
            loader.fail(problem);
        }
    }
    let others = match &table {
        Some(table) => loader.others(path, table),
        None => BTreeMap::new(),
    };
    let overrides = loader.overrides(overrides);
    let Loader {
        sources,
        mut diagnostics,
        kept,
        failed,
        ..
    } = loader;
    let file = Place {
        source,
        span: Span::new(0, text.len()),
    };
    let mut model = None;
    if let Some(mut table) = table.filter(|_| !failed) {
        rename_frame(&mut table, &mut diagnostics);
        let overrides = into_initial(&mut table, file, overrides);
        let before = diagnostics.len();
        let mut conditions = bodies::lower(&mut table, file, &overrides, &mut diagnostics);
        let is_whole = diagnostics.len() == before;
        let objects = conditions.kept.take();
        let (resolved, mut found) = resolve::resolve(
            &table,
            file,
            sources.clone(),
            kept,
            overrides,
            others,
            objects,
        );
        conditions.explain(&mut found);
        // What bodies that could not be placed would have given is not missed.
        found.retain(|problem| is_whole || problem.code != "missing-section");
        diagnostics.extend(found);
        model = resolved;
        if let Some(model) = &mut model {
            conditions.excuse(&mut model.unused);
        }
    }
    let mut all = Diagnostics::once(sources, diagnostics);
    all.sort();
    if all.has_errors() {
        model = None;
    }
    Loaded {
        model,
        diagnostics: all,
    }
}

/// `[frame]` is the old heading of `[moving_frame]`; it is still read.
fn rename_frame(table: &mut Table, problems: &mut Vec<Diagnostic>) {
    if table.get("moving_frame").is_some() {
        return;
    }
    let mut entries = table.entries.iter_mut();
    if let Some((key, _)) = entries.find(|(key, _)| key.content == "frame") {
        let message = "`frame` is called `moving_frame` now";
        problems.push(
            Diagnostic::warning("renamed", key.place, message)
                .hint("[frames] states frames of reference; quasi-velocities by their fields are stated under [moving_frame]"),
        );
        let place = key.place;
        *key = Text::of_toml("moving_frame", "", place);
    }
}

/// What is wrong with a file of another kind than a motion.
fn other_kind(kind: &Raw) -> Option<Diagnostic> {
    let word = kind.expression().map(|text| text.content.as_str());
    match word {
        Some("motion") => None,
        Some(FUNCTIONAL) => Some(
            Diagnostic::error(
                "wrong-kind-of-model",
                kind.place,
                "this file states a functional, not a motion",
            )
            .hint("`chetaev study` and `chetaev check` read functionals"),
        ),
        _ => Some(
            Diagnostic::error("unknown-value", kind.place, "this is no kind of model")
                .hint("`kind` is \"motion\", which may be left out, or \"functional\""),
        ),
    }
}

/// The word for functionals of fields over space under the key `kind`.
pub const FUNCTIONAL: &str = "functional";

/// A model file with its includes laid below it, before anything is given a meaning.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The keys; none where a file could not be read.
    pub table: Option<Table>,
    /// The word under `kind`, in a file whose includes could not be read too.
    pub kind: Option<String>,
    /// The main text.
    pub source: SourceId,
    /// All texts.
    pub sources: Sources,
    /// What is wrong with the syntax of the TOML or with includes.
    pub diagnostics: Vec<Diagnostic>,
    /// The texts as a record keeps them.
    pub text: ModelText,
    /// Overrides: name and value.
    pub overrides: Vec<(Text, Text)>,
}

impl Tables {
    /// Whether the file states a functional of fields over space.
    pub fn is_functional(&self) -> bool {
        self.kind.as_deref() == Some(FUNCTIONAL)
    }
}

/// Reads a model file of any kind as a tree of values with their places; `sources` are texts read before.
pub fn tables(
    path: &str,
    text: &str,
    files: &dyn Files,
    overrides: &[(String, String)],
    sources: Sources,
) -> Tables {
    let mut loader = Loader::new(path, text, files, overrides);
    loader.sources = sources;
    let source = loader.sources.add(path, text);
    let table = loader.file(path, text, source);
    let read = loader.overrides(overrides);
    let kind = table.as_ref().and_then(|table| table.get("kind"));
    let kind = kind
        .and_then(Raw::expression)
        .map(|own| own.content.clone());
    Tables {
        kind,
        table: table.filter(|_| !loader.failed),
        source,
        overrides: read.into_iter().map(|o| (o.name, o.value)).collect(),
        sources: loader.sources,
        diagnostics: loader.diagnostics,
        text: loader.kept,
    }
}

/// The text of a model whose bodies, joints and contacts are lowered to ordinary sections; a model without any keeps its sections.
/// Overrides are written in.
///
/// # Errors
/// What is wrong with the syntax, the includes, or the bodies.
pub fn lowered(
    path: &str,
    text: &str,
    files: &dyn Files,
    overrides: &[(String, String)],
) -> Result<String, Diagnostics> {
    let mut loader = Loader::new(path, text, files, overrides);
    let source = loader.sources.add(path, text);
    let table = loader.file(path, text, source);
    let outside = loader.overrides(overrides);
    let mut problems = loader.diagnostics;
    let file = Place {
        source,
        span: Span::new(0, text.len()),
    };
    let mut written = String::new();
    if let Some(mut table) = table.filter(|_| !loader.failed) {
        let outside = into_initial(&mut table, file, outside);
        bodies::lower(&mut table, file, &outside, &mut problems);
        for own in &outside {
            set(&mut table, own);
        }
        written = toml::text(&table);
    }
    let mut all = Diagnostics::once(loader.sources, problems);
    all.sort();
    if all.has_errors() {
        Err(all)
    } else {
        Ok(written)
    }
}

/// Writes the values of `initial.NAME` into the initial data, in the place of what the file states there, and leaves the other overrides.
fn into_initial(table: &mut Table, file: Place, overrides: Vec<Override>) -> Vec<Override> {
    use chetaev_symbolic::syntax::names::normalized;
    const HEADING: &str = "initial";
    const PREFIX: &str = "initial.";
    let (initial, others): (Vec<_>, Vec<_>) = overrides
        .into_iter()
        .partition(|own| own.name.content.starts_with(PREFIX));
    for own in initial {
        let source = own.value.place.source;
        let name = Text::verbatim(&own.name.content[PREFIX.len()..], source, PREFIX.len());
        let value = Raw {
            place: own.value.place,
            kind: Kind::Text(own.value),
        };
        if table.get(HEADING).is_none() {
            let kind = Kind::Table(Table::default());
            let key = Text::verbatim(HEADING, source, 0);
            table.entries.push((key, Raw { place: file, kind }));
        }
        let Some(Kind::Table(section)) = table.get_mut(HEADING).map(|raw| &mut raw.kind) else {
            continue;
        };
        let wanted = normalized(&name.content);
        section
            .entries
            .retain(|(key, _)| normalized(&key.content) != wanted);
        section.entries.push((name, value));
    }
    others
}

/// Writes an override into the section that declares its name.
fn set(table: &mut Table, own: &Override) {
    use chetaev_symbolic::syntax::names::normalized;
    let name = normalized(&own.name.content);
    for section in ["parameters", "sizes"] {
        let Some(Kind::Table(entries)) = table.get_mut(section).map(|raw| &mut raw.kind) else {
            continue;
        };
        let mut more = Table::default();
        let known = entries
            .entries
            .iter()
            .find(|(key, _)| normalized(&key.content) == name);
        if let Some((key, _)) = known {
            let kind = Kind::Text(own.value.clone());
            let place = own.value.place;
            more.entries.push((key.clone(), Raw { place, kind }));
        }
        entries.overlay(more);
    }
}

/// Reads a model again from the texts that were kept with it.
pub fn reload(text: &ModelText) -> Loaded {
    let files: std::collections::BTreeMap<String, String> = text.includes.iter().cloned().collect();
    load(&text.path, &text.text, &files, &text.overrides)
}

struct Loader<'f> {
    files: &'f dyn Files,
    sources: Sources,
    diagnostics: Vec<Diagnostic>,
    kept: ModelText,
    /// Paths of the files that are being read, each including the next.
    open: Vec<String>,
    /// Whether a file could not be read at all; what it would have declared is then unknown.
    failed: bool,
    files_read: usize,
    bytes_read: usize,
    is_too_large: bool,
}

impl<'f> Loader<'f> {
    fn new(
        path: &str,
        text: &str,
        files: &'f dyn Files,
        overrides: &[(String, String)],
    ) -> Loader<'f> {
        Loader {
            files,
            sources: Sources::default(),
            diagnostics: Vec::new(),
            kept: ModelText {
                path: path.to_owned(),
                text: text.to_owned(),
                includes: Vec::new(),
                overrides: overrides.to_vec(),
            },
            open: Vec::new(),
            failed: false,
            files_read: 0,
            bytes_read: text.len(),
            is_too_large: false,
        }
    }

    /// The table of a file with its includes below it. The depth of includes is bounded by the number of files.
    fn file(&mut self, path: &str, text: &str, source: SourceId) -> Option<Table> {
        let mut found = Vec::new();
        let table = raw::read(text, source, &mut found);
        self.diagnostics.extend(found);
        let Some(mut table) = table else {
            self.failed = true;
            return None;
        };
        if let Some(problem) = format::taken(&mut table) {
            self.fail(problem);
            return None;
        }
        let Some(include) = table.remove("include") else {
            return Some(table);
        };
        self.open.push(path.to_owned());
        let mut base = Table::default();
        for item in self.include_paths(&include) {
            if self.is_too_large {
                break;
            }
            if let Some(included) = self.include(path, &item) {
                base.overlay(included);
            }
        }
        self.open.pop();
        base.overlay(table);
        Some(base)
    }

    /// The models that `[twin.NAME]` names, each by the place of its path. What they say of equations and twins themselves is left out.
    fn others(&mut self, path: &str, table: &Table) -> BTreeMap<Place, Option<Model>> {
        let mut others = BTreeMap::new();
        let twins = table.get("twin").and_then(Raw::table);
        for (_, raw) in twins.iter().flat_map(|table| &table.entries) {
            let named = raw.table().and_then(|table| table.get("model"));
            if let Some(Kind::Text(named)) = named.map(|raw| &raw.kind) {
                let other = self.other(path, named);
                others.insert(named.place, other);
            }
        }
        others
    }

    fn other(&mut self, from: &str, named: &Text) -> Option<Model> {
        let path = joined(from, &named.content);
        let text = if path == self.kept.path {
            self.kept.text.clone()
        } else {
            self.read(&path, named)?
        };
        let source = self.sources.add(path.clone(), text.clone());
        let open = std::mem::take(&mut self.open);
        let table = self.file(&path, &text, source);
        self.open = open;
        let mut table = table?;
        for section in [
            "twin",
            "equations",
            "expect",
            "events",
            "drawing",
            "initial",
        ] {
            table.remove(section);
        }
        let file = Place {
            source,
            span: Span::new(0, text.len()),
        };
        let kept = ModelText {
            path,
            text,
            ..ModelText::default()
        };
        let sources = self.sources.clone();
        rename_frame(&mut table, &mut Vec::new());
        let mut conditions = bodies::lower(&mut table, file, &[], &mut self.diagnostics);
        let objects = conditions.kept.take();
        let others = BTreeMap::new();
        let (model, mut found) =
            resolve::resolve(&table, file, sources, kept, Vec::new(), others, objects);
        conditions.explain(&mut found);
        let is_error = |d: &&Diagnostic| d.severity == chetaev_symbolic::syntax::Severity::Error;
        // Warnings are those of the other file.
        let errors = found.iter().filter(is_error).cloned();
        self.diagnostics.extend(errors);
        model
    }

    fn include_paths(&mut self, raw: &Raw) -> Vec<Text> {
        let items: Vec<&Raw> = match &raw.kind {
            Kind::Array(items) => items.iter().collect(),
            _ => vec![raw],
        };
        let mut paths = Vec::new();
        for item in items {
            match &item.kind {
                Kind::Text(text) => paths.push(text.clone()),
                other => {
                    let message =
                        format!("`include` must be the path of a file, not {}", other.word());
                    self.diagnostics
                        .push(Diagnostic::error("wrong-kind", item.place, message));
                }
            }
        }
        paths
    }

    fn include(&mut self, from: &str, named: &Text) -> Option<Table> {
        let path = joined(from, &named.content);
        if self.open.contains(&path) {
            let message = format!("`{}` includes itself", named.content);
            self.fail(Diagnostic::error("circular-include", named.place, message));
            return None;
        }
        let text = self.read(&path, named)?;
        let source = self.sources.add(path.clone(), text.clone());
        self.file(&path, &text, source)
    }

    /// The text of another file, which is kept.
    fn read(&mut self, path: &str, named: &Text) -> Option<String> {
        self.files_read += 1;
        if self.files_read > MOST_FILES {
            // Said once, however many more there are.
            if !self.is_too_large {
                let message = format!("a model is made of {MOST_FILES} files at most, counting each as often as it is included");
                self.fail(Diagnostic::error("too-large", named.place, message));
            }
            self.is_too_large = true;
            return None;
        }
        match self.files.read(path) {
            Ok(text) => {
                self.bytes_read = self.bytes_read.saturating_add(text.len());
                if self.bytes_read > MOST_BYTES {
                    let message = format!(
                        "the files of a model have at most {} MiB together",
                        MOST_BYTES >> 20
                    );
                    self.fail(Diagnostic::error("too-large", named.place, message));
                    return None;
                }
                if self.kept.includes.iter().all(|(own, _)| own != path) {
                    self.kept.includes.push((path.to_owned(), text.clone()));
                }
                Some(text)
            }
            Err(reason) => {
                let message = format!("`{path}` cannot be read: {reason}");
                self.fail(Diagnostic::error(
                    "unreadable-include",
                    named.place,
                    message,
                ));
                None
            }
        }
    }

    fn fail(&mut self, diagnostic: Diagnostic) {
        self.failed = true;
        self.diagnostics.push(diagnostic);
    }

    /// Overrides are texts of their own, so that a mistake in one is shown like any other.
    fn overrides(&mut self, overrides: &[(String, String)]) -> Vec<Override> {
        overrides
            .iter()
            .map(|(name, value)| {
                let line = format!("{name}={value}");
                let source = self.sources.add(format!("--set {line}"), line);
                Override {
                    name: Text::verbatim(name.clone(), source, 0),
                    value: Text::verbatim(value.clone(), source, name.len() + 1),
                    used: false,
                }
            })
            .collect()
    }
}
