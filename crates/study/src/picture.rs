//! The moving picture of a study as a file of its own, and still pictures and films of it.
//!
//! `scene.json` is the one description of a picture (schema in `docs/scene-json.md`): the page, `chetaev plot` and `chetaev film` draw it
//! and nothing else.

pub use crate::page::scene;
pub use chetaev_report::data::Animation as Scene;
pub use chetaev_report::picture::{film, gif, png, svg, PictureError, View};

use serde::{Deserialize, Serialize};

/// Version of the schema; fields may be added, none renamed.
pub const SCHEMA: &str = "chetaev-scene-1";

#[derive(Deserialize, Serialize)]
struct SceneFile {
    schema: String,
    #[serde(flatten)]
    scene: Scene,
}

/// Why a text is no scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// It is not the JSON of a scene.
    #[error("this is no scene: {0}")]
    Json(String),
    /// It has another schema.
    #[error("the schema is `{found}`, and only `{SCHEMA}` is read")]
    Schema {
        /// What it states.
        found: String,
    },
}

/// A scene as the content of `scene.json`.
pub fn to_json(scene: &Scene) -> String {
    let file = SceneFile {
        schema: SCHEMA.into(),
        scene: scene.clone(),
    };
    // Serialising plain data to a string does not fail; an empty text would be visible.
    let mut text = serde_json::to_string(&file).unwrap_or_default();
    text.push('\n');
    text
}

/// The scene of a `scene.json`.
///
/// # Errors
/// [`SceneError`].
pub fn from_json(text: &str) -> Result<Scene, SceneError> {
    let file: SceneFile =
        serde_json::from_str(text).map_err(|problem| SceneError::Json(problem.to_string()))?;
    if file.schema == SCHEMA {
        Ok(file.scene)
    } else {
        Err(SceneError::Schema { found: file.schema })
    }
}

#[cfg(test)]
mod tests {
    use super::{from_json, to_json, Scene, SceneError};

    #[test]
    fn scenes_survive_their_file() {
        let scene = Scene {
            times: vec![0.0, 0.5],
            ground: true,
            ..Scene::default()
        };
        assert_eq!(from_json(&to_json(&scene)), Ok(scene));
        assert!(matches!(from_json("{}"), Err(SceneError::Json(_))));
        let other = to_json(&Scene::default()).replace("scene-1", "scene-9");
        assert!(matches!(from_json(&other), Err(SceneError::Schema { .. })));
    }
}
