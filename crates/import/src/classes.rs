//! MuJoCo's classes of defaults: attributes that an element has where it does not state them.
//!
//! `<default class="NAME">` holds elements with attributes, and classes that begin with its own. An element belongs to the class that its `class` names, else to that
//! of the nearest body around it with a `childclass`, else to the outermost one.

use std::collections::HashMap;

use roxmltree::Node;

use crate::document::{note_others, numbers_of, ImportError};
use crate::robot::Robot;

/// The class of everything that names none.
const OUTERMOST: &str = "main";

/// Attributes by element and name.
type Values = HashMap<(String, String), String>;

/// All classes by their names.
#[derive(Debug, Default)]
pub(crate) struct Classes {
    all: HashMap<String, Values>,
}

impl Classes {
    /// Reads the defaults of a description; what belongs to elements that are not taken over is noted.
    pub(crate) fn read(robot: &mut Robot, root: Node<'_, '_>) -> Classes {
        let mut classes = Classes::default();
        let mut open: Vec<(Node<'_, '_>, Values)> = Vec::new();
        let outermost = root.children().filter(|own| own.has_tag_name("default"));
        open.extend(outermost.map(|own| (own, Values::new())));
        while let Some((node, mut values)) = open.pop() {
            note_others(robot, node, &["default", "joint"]);
            for own in node.children().filter(|own| own.has_tag_name("joint")) {
                values.extend(own.attributes().map(|attribute| {
                    let key = ("joint".to_owned(), attribute.name().to_owned());
                    (key, attribute.value().to_owned())
                }));
            }
            let inner = node.children().filter(|own| own.has_tag_name("default"));
            open.extend(inner.map(|own| (own, values.clone())));
            let name = node.attribute("class").unwrap_or(OUTERMOST);
            classes
                .all
                .entry(name.to_owned())
                .or_default()
                .extend(values);
        }
        classes
    }

    /// An attribute of an element, its own or that of its class.
    pub(crate) fn attribute<'a>(&'a self, node: Node<'a, '_>, name: &str) -> Option<&'a str> {
        if let Some(own) = node.attribute(name) {
            return Some(own);
        }
        let around = node
            .ancestors()
            .filter_map(|own| own.attribute("childclass"))
            .next();
        let class = node.attribute("class").or(around).unwrap_or(OUTERMOST);
        let values = self.all.get(class)?;
        let key = (node.tag_name().name().to_owned(), name.to_owned());
        values.get(&key).map(String::as_str)
    }

    /// Numbers of such an attribute.
    pub(crate) fn numbers(
        &self,
        node: Node<'_, '_>,
        name: &str,
        count: usize,
    ) -> Result<Option<Vec<f64>>, ImportError> {
        let found = numbers_of(node, name, self.attribute(node, name), count)?;
        Ok(found.map(|own| own.iter().filter_map(|text| text.parse().ok()).collect()))
    }

    /// One number.
    pub(crate) fn one(&self, node: Node<'_, '_>, name: &str) -> Result<Option<f64>, ImportError> {
        Ok(self
            .numbers(node, name, 1)?
            .and_then(|own| own.first().copied()))
    }

    /// Three numbers.
    pub(crate) fn three(
        &self,
        node: Node<'_, '_>,
        name: &str,
    ) -> Result<Option<[f64; 3]>, ImportError> {
        let own = self.numbers(node, name, 3)?;
        Ok(own.map(|own| std::array::from_fn(|i| own.get(i).copied().unwrap_or(0.0))))
    }
}
