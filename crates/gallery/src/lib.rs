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

impl Entry {
    /// The description.
    pub fn readme(&self) -> &'static str {
        let readme = self.files.iter().find(|(file, _)| *file == "README.md");
        readme.map_or("no description\n", |(_, text)| text)
    }

    /// The first line of the description.
    pub fn title(&self) -> &'static str {
        let first = self.readme().lines().next().unwrap_or("");
        first.trim_start_matches('#').trim()
    }

    /// Whether it has a model, and not only what others include.
    pub fn is_model(&self) -> bool {
        self.files.iter().any(|(file, _)| *file == "model.toml")
    }

    /// The group that it belongs to, and its name in it.
    pub fn group(&self) -> Option<(&'static str, &'static str)> {
        self.name.split_once('/')
    }

    /// Name, title and names of the files.
    pub fn to_json(&self) -> serde_json::Value {
        let files: Vec<&str> = self.files.iter().map(|(file, _)| *file).collect();
        serde_json::json!({"name": self.name, "title": self.title(), "files": files})
    }

    /// What a copy consists of, paths and contents: models of a group name each other's files, and so all of the group is.
    pub fn copied(&self) -> Vec<(String, &'static str)> {
        let Some((group, _)) = self.group() else {
            let own = self.files.iter();
            return own
                .map(|(name, text)| ((*name).to_owned(), *text))
                .collect();
        };
        let members = ENTRIES.iter().filter_map(|e| Some((e, e.group()?)));
        members
            .filter(|(_, (own, _))| *own == group)
            .flat_map(|(e, (_, member))| {
                e.files
                    .iter()
                    .map(move |(name, text)| (format!("{member}/{name}"), *text))
            })
            .collect()
    }
}
