//! XML within bounds, and readers of attributes.

use roxmltree::{Document, Node, ParsingOptions};

use crate::robot::{line, Robot};

/// Largest text, in bytes.
const MOST_BYTES: usize = 16 << 20;
/// Most elements, attributes and texts.
const MOST_NODES: u32 = 200_000;
/// Deepest element.
const MOST_LEVELS: usize = 256;

/// Why a description cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImportError {
    /// It is larger than what is read.
    #[error("the description has {0} bytes; up to {MOST_BYTES} are read")]
    TooLarge(usize),
    /// Its elements stand in each other more deeply than what is read.
    #[error("elements stand in each other more than {MOST_LEVELS} deep in line {0}")]
    TooDeep(u32),
    /// It is no XML, or contains what is refused: a document type with entities.
    #[error("{said}")]
    NotXml {
        /// The line.
        line: u32,
        /// What is wrong.
        said: String,
    },
    /// The first element is that of neither format.
    #[error(
        "`<{0}>` begins no description of a robot: `<robot>` (URDF) and `<mujoco>` (MJCF) are read"
    )]
    UnknownFormat(String),
    /// There is no body in it.
    #[error("there is no body in the description")]
    Empty,
    /// A number, or several, could not be read.
    #[error("line {line}: `{attribute}` of <{element}> must be {wanted}, not \"{found}\"")]
    NoNumber {
        /// The line.
        line: u32,
        /// The element.
        element: String,
        /// The attribute.
        attribute: String,
        /// What it must be.
        wanted: String,
        /// What it is.
        found: String,
    },
    /// An attribute or an element without which nothing can be said.
    #[error("line {line}: <{element}> has no {missing}")]
    Missing {
        /// The line.
        line: u32,
        /// The element.
        element: String,
        /// What it lacks.
        missing: String,
    },
}

impl ImportError {
    /// The line, from 1, where one is at fault.
    pub fn line(&self) -> Option<u32> {
        match self {
            ImportError::TooDeep(line)
            | ImportError::NotXml { line, .. }
            | ImportError::NoNumber { line, .. }
            | ImportError::Missing { line, .. } => Some(*line),
            ImportError::TooLarge(_) | ImportError::UnknownFormat(_) | ImportError::Empty => None,
        }
    }
}

/// Reads XML. A document type, and entities with it, is refused; no file is opened.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, ImportError> {
    if text.len() > MOST_BYTES {
        return Err(ImportError::TooLarge(text.len()));
    }
    deep(text)?;
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(|problem| ImportError::NotXml {
        line: problem.pos().row,
        said: problem.to_string(),
    })
}

/// Bounds the depth before anything is built: opening tags less closing ones.
fn deep(text: &str) -> Result<(), ImportError> {
    let mut depth = 0_usize;
    let mut rest = text;
    let mut line = 1;
    while let Some(at) = rest.find('<') {
        line += rest[..at].matches('\n').count() as u32;
        rest = &rest[at..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        let skipped = skipped
            .into_iter()
            .find(|(begin, _)| rest.starts_with(begin));
        let end = match skipped {
            Some((_, end)) => rest.find(end).map(|at| at + end.len()),
            None => end_of_tag(rest),
        };
        let Some(end) = end else { break };
        let tag = &rest[..end];
        if skipped.is_none() {
            match (tag.starts_with("</"), tag.ends_with("/>")) {
                (true, _) => depth = depth.saturating_sub(1),
                (false, true) => {}
                (false, false) => depth += 1,
            }
        }
        if depth > MOST_LEVELS {
            return Err(ImportError::TooDeep(line));
        }
        line += tag.matches('\n').count() as u32;
        rest = &rest[end..];
    }
    Ok(())
}

/// Behind the `>` of a tag; one in quotation marks is a part of a value.
fn end_of_tag(tag: &str) -> Option<usize> {
    let mut quote = None;
    for (at, c) in tag.char_indices() {
        match (quote, c) {
            (None, '>') => return Some(at + 1),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if open == c => quote = None,
            _ => {}
        }
    }
    None
}

/// The first child of a name.
pub(crate) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|own| own.has_tag_name(name))
}

/// An attribute that must be there.
pub(crate) fn required<'a>(node: Node<'a, '_>, attribute: &str) -> Result<&'a str, ImportError> {
    node.attribute(attribute)
        .ok_or_else(|| ImportError::Missing {
            line: line(node),
            element: node.tag_name().name().to_owned(),
            missing: format!("`{attribute}`"),
        })
}

/// Numbers of an attribute as they are written; `None` where it is left out.
pub(crate) fn numbers<'a>(
    node: Node<'a, '_>,
    attribute: &str,
    count: usize,
) -> Result<Option<Vec<&'a str>>, ImportError> {
    numbers_of(node, attribute, node.attribute(attribute), count)
}

/// Numbers of a text that stands for an attribute of an element.
pub(crate) fn numbers_of<'a>(
    node: Node<'_, '_>,
    attribute: &str,
    text: Option<&'a str>,
    count: usize,
) -> Result<Option<Vec<&'a str>>, ImportError> {
    let Some(text) = text else {
        return Ok(None);
    };
    let all: Vec<&str> = text.split_whitespace().collect();
    let is_number = |text: &&str| text.parse::<f64>().is_ok_and(f64::is_finite);
    if all.len() == count && all.iter().all(is_number) {
        return Ok(Some(all));
    }
    Err(ImportError::NoNumber {
        line: line(node),
        element: node.tag_name().name().to_owned(),
        attribute: attribute.to_owned(),
        wanted: match count {
            1 => "a number".to_owned(),
            count => format!("{count} numbers"),
        },
        found: text.to_owned(),
    })
}

/// Three numbers; `None` where the attribute is left out or all are zero.
pub(crate) fn three(node: Node<'_, '_>, attribute: &str) -> Result<Option<[f64; 3]>, ImportError> {
    let own = numbers(node, attribute, 3)?;
    Ok(own.map(|own| {
        let mut values = own.iter().filter_map(|text| text.parse::<f64>().ok());
        std::array::from_fn(|_| values.next().unwrap_or(0.0))
    }))
}

/// One number.
pub(crate) fn one(node: Node<'_, '_>, attribute: &str) -> Result<Option<f64>, ImportError> {
    let own = numbers(node, attribute, 1)?;
    Ok(own.and_then(|own| own.first().and_then(|text| text.parse().ok())))
}

/// Notes every child that is none of these.
pub(crate) fn note_others(robot: &mut Robot, node: Node<'_, '_>, known: &[&str]) {
    let of = node
        .attribute("name")
        .map_or(String::new(), |name| format!(" of `{name}`"));
    for own in node.children().filter(Node::is_element) {
        let name = own.tag_name().name();
        if !known.contains(&name) {
            robot.note(own, format!("<{name}>{of} is not taken over"));
        }
    }
}

/// Notes every attribute that is none of these.
pub(crate) fn note_attributes(robot: &mut Robot, node: Node<'_, '_>, known: &[&str]) {
    let element = node.tag_name().name();
    for own in node.attributes().filter(|own| !known.contains(&own.name())) {
        let message = format!("`{}` of <{element}> is not taken over", own.name());
        robot.note(node, message);
    }
}
