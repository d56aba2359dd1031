//! Robot descriptions of other programs as model texts that a person can read and go on with.
//!
//! `document` reads XML within bounds, `urdf` and `mjcf` take bodies, joints and couplings out of it, `robot` is what both give, and `writing`
//! makes a model text of it. What is not understood is a [`Note`] with its line; nothing is left out silently.

mod classes;
mod document;
mod mjcf;
mod model_text;
mod numbers;
mod robot;
mod urdf;

pub use document::ImportError;

/// Something that was not taken over as it stands, or was taken in a way that a reader should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The line of the description, from 1.
    pub line: u32,
    /// What it says.
    pub message: String,
}

/// A description that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Imported {
    /// The model text, in SI units.
    pub text: String,
    /// What was not taken over, in the order of the lines.
    pub notes: Vec<Note>,
}

/// Reads a description in URDF (`<robot>`) or MJCF (`<mujoco>`).
///
/// # Errors
/// [`ImportError`]: the text is too large or too deep, is no XML, declares entities, or describes no robot.
pub fn import(text: &str) -> Result<Imported, ImportError> {
    let document = document::parse(text)?;
    let root = document.root_element();
    let mut robot = match root.tag_name().name() {
        "robot" => urdf::read(root)?,
        "mujoco" => mjcf::read(root)?,
        other => return Err(ImportError::UnknownFormat(other.to_owned())),
    };
    robot.notes.sort_by_key(|note| note.line);
    Ok(Imported {
        text: model_text::written(&robot),
        notes: robot.notes,
    })
}
