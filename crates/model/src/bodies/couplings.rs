//! Gears and differentials: fixed ratios between the coordinates of joints.

use super::lowering::Lowering;
use super::reading::Object;
use super::sections::{table, text, word};
use crate::raw::{Kind, Raw};

/// A coupling.
struct Coupling {
    word: &'static str,
    /// Its coordinates, for messages.
    coordinates: &'static [&'static str],
}

/// Every coupling.
const COUPLINGS: &[Coupling] = &[
    Coupling {
        word: "gear",
        coordinates: &["driving", "driven"],
    },
    Coupling {
        word: "differential",
        coordinates: &["left", "right", "case"],
    },
];

/// The word of a rope, which couples two points and not coordinates.
const ROPE: &str = "rope";

const KEYS: &[&str] = &["type", "coordinates", "ratio", "offset", "description"];

/// Whether an entry of `[joints]` couples others.
pub(crate) fn is_coupling(object: &Object<'_>) -> bool {
    let kind = object.get("type").and_then(Raw::expression);
    kind.is_some_and(|kind| {
        kind.content == ROPE || COUPLINGS.iter().any(|own| own.word == kind.content)
    })
}

impl<'r> Lowering<'r> {
    /// Writes the constraint of a gear, a differential or a rope.
    pub(crate) fn couple(&mut self, object: &Object<'r>) {
        let kind = object.get("type").and_then(Raw::expression);
        if kind.is_some_and(|kind| kind.content == ROPE) {
            return self.tie(object);
        }
        self.known_keys(object, KEYS);
        let Some(kind) = COUPLINGS
            .iter()
            .find(|own| kind.is_some_and(|kind| kind.content == own.word))
        else {
            return;
        };
        let Some(names) = self.coupled(object, kind) else {
            return;
        };
        let number = |lowering: &mut Self, key: &str, unit| {
            let raw = object.get(key)?;
            lowering.number(&object.slot(key, unit), raw)
        };
        let ratio = number(self, "ratio", "1");
        let offset = number(self, "offset", "rad");
        let graph = &self.algebra.graph;
        let ratio = graph.text(ratio.unwrap_or(graph.one()));
        let offset = graph.text(offset.unwrap_or(graph.zero()));
        let equation = match names.as_slice() {
            [driving, driven] => format!("{driven} = ({ratio}) {driving} + {offset}"),
            [left, right, case] => {
                format!("{left} + ({ratio}) {right} = (1 + {ratio}) {case} + {offset}")
            }
            _ => return,
        };
        let about = format!("{} couples {}", object.words(), names.join(", "));
        let entries = vec![
            ("equation", text(equation, object.place)),
            ("description", text(about, object.place)),
        ];
        let name = word(object.name(), object.place);
        let value = table(entries, object.place);
        self.written.constraints.entries.push((name, value));
    }

    fn coupled(&mut self, object: &Object<'r>, kind: &Coupling) -> Option<Vec<String>> {
        let wanted = format!("the coordinates of joints: {}", kind.coordinates.join(", "));
        let Some(raw) = object.get("coordinates") else {
            let message = format!("{} needs `coordinates`, {wanted}", object.words());
            self.error("missing-value", object.place, message);
            return None;
        };
        let items = match &raw.kind {
            Kind::Array(items) => items.iter().filter_map(Raw::expression).collect(),
            _ => Vec::new(),
        };
        if items.len() != kind.coordinates.len() {
            let message = format!("{} couples {wanted}", object.words());
            self.error("wrong-length", raw.place, message);
            return None;
        }
        let known = |name: &str| {
            let mut all = self.written.coordinates.entries.iter();
            all.any(|(key, _)| key.content == name) || self.taken.contains(name)
        };
        let unknown = items.iter().find(|own| !known(&own.content)).copied();
        if let Some(unknown) = unknown {
            let message = format!(
                "{} names `{}`, and no joint has such a coordinate",
                object.words(),
                unknown.content
            );
            self.error("not-a-coordinate", unknown.place, message);
            return None;
        }
        Some(items.into_iter().map(|own| own.content.clone()).collect())
    }
}
