//! The models that come with Chetaev, as texts: they are built into the program.

/// A model, or files that several models include, with all texts of its folder.
#[derive(Debug)]
pub struct Entry {
    /// Its folder below `gallery`.
    pub name: &'static str,
    /// Name and content of each file.
    pub files: &'static [(&'static str, &'static str)],
}

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));

/// All folders with texts, models or what they include, in the order of their names.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    ENTRIES.iter()
}

/// All models, in the order of their names.
pub fn models() -> impl Iterator<Item = &'static Entry> {
    entries().filter(|entry| entry.is_model())
}

/// The model of a name.
pub fn find(name: &str) -> Option<&'static Entry> {
    models().find(|entry| entry.name == name)
}

/// What a model is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A mechanical system that moves.
    Motion,
    /// A functional of fields over space.
    Functional,
}

impl Kind {
    /// `motion`, `functional`.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Motion => "motion",
            Kind::Functional => "functional",
        }
    }
}

impl Entry {
    /// The description: its own file, or the comment that the model begins with.
    pub fn readme(&self) -> &'static str {
        let text = |name: &str| {
            let found = self.files.iter().find(|(file, _)| *file == name);
            found.map(|(_, text)| *text)
        };
        let comment = || {
            let model = text("model.toml")?;
            let lines = model.split_inclusive('\n');
            let end: usize = lines
                .take_while(|line| line.starts_with('#'))
                .map(str::len)
                .sum();
            model.get(..end).filter(|comment| !comment.is_empty())
        };
        text("README.md")
            .or_else(comment)
            .unwrap_or("no description\n")
    }

    /// The first line of the description; of several sentences the first.
    pub fn title(&self) -> &'static str {
        let first = self.readme().lines().next().unwrap_or("");
        let title = first.trim_start_matches('#').trim();
        let sentence = title.split(". ").next().unwrap_or(title);
        sentence.strip_suffix('.').unwrap_or(sentence)
    }

    /// Whether it has a model, and not only what others include.
    pub fn is_model(&self) -> bool {
        self.files.iter().any(|(file, _)| *file == "model.toml")
    }

    /// What it is about, as it says or as a file says that its group shares.
    pub fn kind(&self) -> Kind {
        let says = |(_, text): &(String, &str)| {
            let mut lines = text.lines();
            lines.any(|line| line.replace(' ', "") == "kind=\"functional\"")
        };
        if self.copied().iter().any(says) {
            Kind::Functional
        } else {
            Kind::Motion
        }
    }

    /// The group that it belongs to, and its name in it.
    pub fn group(&self) -> Option<(&'static str, &'static str)> {
        self.name.split_once('/')
    }

    /// Name, title, kind and names of the files.
    pub fn to_json(&self) -> serde_json::Value {
        let files: Vec<&str> = self.files.iter().map(|(file, _)| *file).collect();
        let kind = self.kind().word();
        serde_json::json!({"name": self.name, "title": self.title(), "kind": kind, "files": files})
    }

    /// The group whose files it names.
    fn needed(&self) -> Option<&'static str> {
        let (group, _) = self.group()?;
        let is_outside = |(_, text): &(&str, &str)| text.contains("\"../");
        self.files.iter().any(is_outside).then_some(group)
    }

    /// Where its model stands among the files of a copy.
    pub fn model_path(&self) -> String {
        match (self.needed(), self.group()) {
            (Some(_), Some((_, member))) => format!("{member}/model.toml"),
            _ => "model.toml".to_owned(),
        }
    }

    /// What a copy consists of, paths and contents: all of its group where it names files of others.
    pub fn copied(&self) -> Vec<(String, &'static str)> {
        let Some(group) = self.needed() else {
            let own = self.files.iter();
            return own
                .map(|(name, text)| ((*name).to_owned(), *text))
                .collect();
        };
        let mut all = Vec::new();
        for entry in ENTRIES {
            let folder = match entry.group() {
                Some((own, member)) if own == group => format!("{member}/"),
                None if entry.name == group => String::new(),
                _ => continue,
            };
            let own = entry.files.iter();
            all.extend(own.map(|(name, text)| (format!("{folder}{name}"), *text)));
        }
        all
    }
}
